/* SPDX-License-Identifier: MIT */
/* held_body.h - small bodies of every law, held, moved and blown at, with the equilibrium that a dense factorisation finds: for
   test_solvers.c and test_methods.c. */
#ifndef HELD_BODY_H
#define HELD_BODY_H

#include "published_laws.h"
#include "equilibrium.h"

#define ALL_LAWS 5 /* laws[], and the four side by side */

static inline int32_t law_of(int k) { return k < LAWS ? laws[k] : 0; }
static inline const char *law_text(int k) { return k < LAWS ? law_name[laws[k] % 100] : "mixed"; }

/* A random body force on all points, from the numbers in user; in statics `time` is the load factor. */
typedef struct wind {
    int    dim;
    double size;
    const double *numbers;
} wind;
static inline int32_t blow(void *user, double time, int64_t count, const int32_t *points, double *value) {
    const wind *w = (const wind *)user;
    int64_t k;
    int d;
    for (k = 0; k < count; ++k)
        for (d = 0; d < w->dim; ++d) value[k * w->dim + d] = time * w->size * w->numbers[points[k] * w->dim + d];
    return 0;
}

/* A small body that is held, moved and blown at; and the same in numbers. */
typedef struct task {
    peri_body     *body;
    int32_t        space, grip, roller, pull, load;
    int64_t        n;
    double        *numbers, *force, *given, soft, *u, *reaction; /* soft, u, reaction: of the dense equilibrium */
    unsigned char *held;
    wind           w;
} task;

/* A grip at the lower end of x, a roller of x moved by a little at the upper end, and a support of y in part of the grip that comes
   later. */
static inline task task_of(peri_body *b, int32_t space, double size) {
    task t;
    double *x = get(b, PERI_FIELD_POSITION), most = 0, moved[3] = {2e-3 * H, 0, 0}, later[3] = {0, -1e-3 * H, 0};
    int dim = peri_dimension(b), d;
    int64_t i, points = peri_point_count(b);
    memset(&t, 0, sizeof t);
    t.body = b;
    t.space = space;
    t.n = points * dim;
    t.numbers = random_field(t.n, 1, 11);
    t.held = (unsigned char *)calloc((size_t)t.n, 1);
    t.given = (double *)calloc((size_t)t.n, sizeof(double));
    t.u = (double *)calloc((size_t)t.n, sizeof(double));
    t.reaction = (double *)calloc((size_t)t.n, sizeof(double));
    for (i = 0; i < points; ++i) most = fmax(most, x[i * dim]);
    t.grip = (int32_t)MUST(b, peri_prescribe_displacement(b, slab(b, 0, -1, 1.3 * H), all_axes(dim), NULL, NULL, NULL));
    t.roller = (int32_t)MUST(b, peri_prescribe_displacement(b, slab(b, 0, most - 0.5 * H, most + H), PERI_AXIS_X, moved, NULL, NULL));
    t.pull = (int32_t)MUST(b, peri_prescribe_displacement(b, slab(b, 0, -1, 0.8 * H), PERI_AXIS_Y, later, NULL, NULL));
    for (i = 0; i < points; ++i) {
        for (d = 0; d < dim && x[i * dim] <= 1.3 * H; ++d) t.held[i * dim + d] = 1;
        if (x[i * dim] >= most - 0.5 * H) {
            t.held[i * dim] = 1;
            t.given[i * dim] = moved[0];
        }
        if (x[i * dim] <= 0.8 * H) t.given[i * dim + 1] = later[1];
    }
    t.force = forces_of(b, t.numbers, space);
    for (i = 0; i < t.n; ++i) t.force[i] *= size;
    free(x);
    return t;
}
static inline void apply_wind(task *t, double size) { /* *t stays where it is from now on */
    t->w.dim = peri_dimension(t->body);
    t->w.size = size;
    t->w.numbers = t->numbers;
    t->load = (int32_t)MUST(t->body, peri_apply_body_force(t->body, PERI_ALL, NULL, blow, &t->w));
}
static inline void end_task(task *t) {
    free(t->numbers);
    free(t->force);
    free(t->given);
    free(t->held);
    free(t->u);
    free(t->reaction);
    peri_body_destroy(t->body);
}
/* One bond in eight, by chance: what is left still holds every point. */
static inline int32_t some(void *user, int32_t i, int32_t j, const double *xi, const double *xj) {
    uint64_t seed = (uint64_t)i * 1009u + (uint64_t)j;
    (void)user;
    (void)xi;
    (void)xj;
    return test_random(&seed) < 0.125;
}
static inline peri_body *held_body(const scene *s, int32_t law, double nu, int lattice, int broken) {
    peri_body *b = lattice ? lattice_body(s, law, nu, 0) : small_body(s, law, nu, -1, 0);
    if (broken) CHECK(MUST(b, peri_cut_if(b, PERI_CUT_INITIAL, some, NULL)) > peri_entry_count(b) / 32);
    return b;
}

#define WIND 1e-3 /* strains of 1e-3 to 1e-2 */

/* The scale of convergence, peri.h: the larger of the loads on what is free and the reactions, as vectors. */
static inline double scale_of(const task *t) {
    double square = 0;
    int64_t k;
    for (k = 0; k < t->n; ++k)
        if (!t->held[k]) square += t->force[k] * t->force[k];
    return fmax(sqrt(square), norm(t->reaction, t->n));
}

static inline void solve_densely(task *t) {
    int64_t n;
    double *k = dense_stiffness(t->body, &n);
    CHECK(n == t->n);
    t->soft = dense_equilibrium(k, n, t->held, t->given, t->force, t->u, t->reaction);
    free(k);
}

#endif
