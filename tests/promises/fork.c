/* SPDX-License-Identifier: MIT */
/* fork.c - fork PARENT CHILD: builds and runs a body of 40,000 points on so many threads, forks, and does the same in the child, which an
   alarm ends after 5 s: prints "hangs" or "runs". Then the parent goes on. For check_promises.sh; POSIX. */
#define _POSIX_C_SOURCE 200112L
#include "../../peri.h"
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

static int work(int threads) {
    const double lo[2] = {0, 0}, hi[2] = {200, 200};
    peri_body_desc d;
    peri_material_desc m;
    peri_advance_desc a;
    peri_body *b = NULL;
    peri_body_desc_init(&d);
    d.space = PERI_SPACE_PLANE_STRESS;
    d.horizon = 3;
    d.threads = threads;
    peri_material_desc_init(&m, PERI_LAW_BOND_BASED);
    m.young = m.density = 1;
    peri_advance_desc_init(&a);
    a.steps = 3;
    if (peri_body_create(&d, &b, NULL) < 0) return 1;
    const int failed = peri_add_box(b, peri_add_material(b, &m), lo, hi, 1) < 0 || peri_build(b) < 0 || peri_advance(b, &a) < 0;
    peri_body_destroy(b);
    return failed;
}

int main(int argc, char **argv) {
    int status = 0;
    if (argc < 3 || work(atoi(argv[1]))) return 2;
    const pid_t child = fork();
    if (child < 0) return 3;
    if (child == 0) {
        (void)alarm(5);
        _exit(work(atoi(argv[2])));
    }
    if (waitpid(child, &status, 0) != child || work(atoi(argv[1]))) return 4;
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM) puts("hangs");
    else if (WIFEXITED(status) && WEXITSTATUS(status) == 0) puts("runs");
    else return 5;
    return 0;
}
