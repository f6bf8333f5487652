/* SPDX-License-Identifier: MIT */
/* threads.c - bodies of several threads, and a pool of the caller's, for a thread sanitizer (checks.sh, run.sh): it must see no race.

   SOURCE OF TRUTH: peri.h, "Threads": different bodies, clones included, at once, on any threads; tasks of a job system in any order on any
   threads; and the same bits as one thread gives. Built without OpenMP, whose barriers sanitizers do not know. */
#define _POSIX_C_SOURCE 200809L
#include "scene.h"
#include <pthread.h>

enum { WORKERS = 4 };

/* ---- a body that does much ---------------------------------------------------------------------------------------- */

typedef struct job {
    peri_body *body; /* NULL: builds its own                                                                              */
    int32_t    law;
    int        number;
    uint64_t   bits;
} job;

static uint64_t digest(peri_body *b, uint64_t bits) {
    static const int32_t fields[4] = {PERI_FIELD_DISPLACEMENT, PERI_FIELD_VELOCITY, PERI_FIELD_DAMAGE, PERI_FIELD_STRAIN};
    for (int f = 0; f < 4; ++f) {
        double *x = get(b, fields[f]);
        const int64_t n = peri_size_of_field(b, fields[f]);
        for (int64_t k = 0; k < n; ++k) {
            uint64_t word;
            memcpy(&word, &x[k], sizeof word);
            bits = (bits ^ word) * UINT64_C(0x9E3779B97F4A7C15);
            bits ^= bits >> 29;
        }
        free(x);
    }
    return bits;
}

static specimen plate(int32_t law, int nx, int ny) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, law, 0.2, H, 3, nx, ny, 1);
    s.material.critical_stretch = 0.02;
    if (law == PERI_LAW_OTERKUS) s.scatter = 0.5;
    return s;
}

/* Cuts, loads, steps with breaks, and, where nothing is broken again, an equilibrium. */
static uint64_t use(peri_body *b, int number) {
    const double from[2] = {0.3, 0.2}, to[2] = {0.5, 0.5}, lo[2] = {-1, -1}, hi[2] = {0.31, 9}, push[2] = {0.02, 0.01};
    const double centre[2] = {-0.3, 0.3};
    const int32_t left = (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi));
    peri_solve_desc d;
    double *v = random_field(peri_size_of_field(b, PERI_FIELD_VELOCITY), 0.2, (uint64_t)number);
    MUST(b, peri_cut_segment(b, PERI_CUT_NOW, from, to));
    put(b, PERI_FIELD_VELOCITY, v);
    free(v);
    MUST(b, ball_obstacle(b, centre, 0.35, 0, NULL, NULL));
    (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 3, 0, 0);
    CHECK(peri_broken_count(b) > 0);
    const uint64_t bits = digest(b, 1);
    MUST(b, peri_reset(b));
    MUST(b, peri_prescribe_displacement(b, left, PERI_AXIS_XY, NULL, NULL, NULL));
    MUST(b, peri_apply_body_force(b, PERI_ALL, push, NULL, NULL));
    peri_solve_desc_init(&d);
    d.fracture = 0;
    d.tolerance = 1e-3;
    MUST(b, peri_solve(b, &d, NULL));
    return digest(b, bits);
}

static void *work(void *user) {
    job *j = (job *)user;
    if (!j->body) {
        const specimen s = plate(j->law, 12, 8);
        j->body = specimen_make(&s);
    }
    j->bits = use(j->body, j->number);
    peri_body_destroy(j->body); /* clones give their share of the model back at once                                      */
    return NULL;
}

static void at_once(job *jobs, int count) {
    pthread_t thread[WORKERS];
    for (int k = 0; k < count; ++k) CHECK(pthread_create(&thread[k], NULL, work, &jobs[k]) == 0);
    for (int k = 0; k < count; ++k) CHECK(pthread_join(thread[k], NULL) == 0);
}

/* Each thread a body of its own law, while clones of one body are in use, its points shared. */
static void bodies_at_once(void) {
    for (int32_t law = test_long ? peri__first_law : PERI_LAW_CORRESPONDENCE; law < peri__end_law; ++law) {
        const specimen s = plate(law, 12, 8);
        peri_body *b = specimen_make(&s);
        job jobs[WORKERS], alone[WORKERS];
        for (int k = 0; k < WORKERS; ++k) {
            jobs[k].body = NULL;
            jobs[k].law = law;
            jobs[k].number = k / 2;
            if (k % 2) MUST(b, peri_body_clone(b, &jobs[k].body, NULL));
            alone[k] = jobs[k];
            alone[k].body = NULL;
        }
        peri_body_destroy(b);
        at_once(jobs, WORKERS);
        for (int k = 0; k < WORKERS; k += 2) (void)work(&alone[k]);
        for (int k = 0; k < WORKERS; ++k) CHECK(jobs[k].bits == alone[k - k % 2].bits);
    }
}

/* ---- a job system ------------------------------------------------------------------------------------------------- */

typedef struct pool { /* threads take the next task; the caller's works along                                             */
    pthread_mutex_t lock;
    int64_t         next, count, loops;
    peri_task_fn    task;
    void           *context;
} pool;

static void *take_tasks(void *user) {
    pool *p = (pool *)user;
    for (;;) {
        int64_t k;
        (void)pthread_mutex_lock(&p->lock);
        k = p->next < p->count ? p->next++ : -1;
        (void)pthread_mutex_unlock(&p->lock);
        if (k < 0) return NULL;
        p->task(p->context, k);
    }
}

static void share_out(void *user, int64_t count, peri_task_fn task, void *context) {
    pool *p = (pool *)user;
    pthread_t thread[WORKERS];
    p->next = 0;
    p->count = count;
    p->task = task;
    p->context = context;
    p->loops++;
    for (int k = 0; k < WORKERS - 1; ++k) CHECK(pthread_create(&thread[k], NULL, take_tasks, p) == 0);
    (void)take_tasks(p);
    for (int k = 0; k < WORKERS - 1; ++k) CHECK(pthread_join(thread[k], NULL) == 0);
}

/* 112,000 bonds: enough that loops are shared out. */
static uint64_t big_job(int32_t law, pool *p) {
    specimen s = plate(law, 100, 40);
    if (p) {
        s.desc.parallel_for = share_out;
        s.desc.parallel_user = p;
    }
    peri_body *b = specimen_make(&s);
    const double from[2] = {3, 1}, to[2] = {5, 3};
    double *v = random_field(peri_size_of_field(b, PERI_FIELD_VELOCITY), 0.5, 7);
    peri_energy e;
    MUST(b, peri_cut_segment(b, PERI_CUT_NOW, from, to));
    put(b, PERI_FIELD_VELOCITY, v);
    free(v);
    (void)go(b, PERI_INTEGRATOR_CENTRAL_DIFFERENCE, 1, 0, 0);
    CHECK(peri_broken_count(b) > 0);
    MUST(b, peri_get_energy(b, &e));
    const uint64_t bits = digest(b, 1);
    peri_body_destroy(b);
    return bits;
}

static void pool_of_the_caller(void) {
    for (int32_t law = test_long ? peri__first_law : PERI_LAW_LPS; law < (test_long ? peri__end_law : PERI_LAW_LPS + 1); ++law) {
        pool p;
        memset(&p, 0, sizeof p);
        CHECK(pthread_mutex_init(&p.lock, NULL) == 0);
        const uint64_t bits = big_job(law, &p);
        if (test_long) CHECK(bits == big_job(law, NULL)); /* test_failure compares them without a sanitizer              */
        CHECK(p.loops > 4);
        (void)pthread_mutex_destroy(&p.lock);
    }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(bodies_at_once);
    RUN(pool_of_the_caller);
    return test_end("threads");
}
