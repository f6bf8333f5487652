/* SPDX-License-Identifier: MIT */
/* threads.c - threads POINTS_A_SIDE THREADS [hook]: builds and runs a plate, and prints how many threads the process has then (Linux), and
   how its bonds are worked on. For check_promises.sh. */
#include "../../peri.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void one_after_the_other(void *user, int64_t count, peri_task_fn task, void *context) {
    (void)user;
    for (int64_t k = 0; k < count; ++k) task(context, k);
}

int main(int argc, char **argv) {
    const int side = argc > 2 ? atoi(argv[1]) : 10;
    const double lo[2] = {0, 0}, hi[2] = {side, side};
    char line[128];
    int threads = -1;
    peri_body_desc d;
    peri_material_desc m;
    peri_advance_desc a;
    peri_body *b = NULL;
    peri_body_desc_init(&d);
    d.space = PERI_SPACE_PLANE_STRESS;
    d.horizon = 3;
    d.threads = argc > 2 ? atoi(argv[2]) : 1;
    if (argc > 3) d.parallel_for = one_after_the_other;
    if (peri_body_create(&d, &b, NULL) < 0) return 2;
    peri_material_desc_init(&m, PERI_LAW_BOND_BASED);
    m.young = m.density = 1;
    if (peri_add_box(b, peri_add_material(b, &m), lo, hi, 1) < 0 || peri_build(b) < 0) return 3;
    peri_advance_desc_init(&a);
    a.steps = 3;
    if (peri_advance(b, &a) < 0) return 4;
    FILE *status = fopen("/proc/self/status", "r");
    while (status && fgets(line, sizeof line, status))
        if (strncmp(line, "Threads:", 8) == 0) threads = atoi(line + 8);
    if (status) (void)fclose(status);
    printf("%d threads, %s\n", threads, peri_kernel_text(b));
    peri_body_destroy(b);
    return 0;
}
