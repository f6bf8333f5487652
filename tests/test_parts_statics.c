/* SPDX-License-Identifier: MIT */
/* test_parts_statics.c - products with the stiffness and forces at displacements of the caller's, in parts: what a solver of the caller's
   needs that is distributed.

   SOURCE OF TRUTH: what is asked of parts: the bits of one body's product and of its forces, for any partition, whatever the entries of
   ghosts are in what the caller gives; and, of a break, the same bonds. On a lattice whose spacing is a power of two one part has the bits
   of a body that is no part. A part that fails ends the call of all, with its status. */
#include "pool.h"
#include "ranks.h"

#define NX 30
#define NY 16
#define COUNT (NX * NY)

typedef enum split { ALONG, ACROSS, BLOCKS, SPLITS } split;

typedef struct scene {
    int32_t law, precision, geometry, correction;
    int     cloud;
} scene;

typedef struct outcome {
    double  product[COUNT * 2], there[COUNT * 2], again[COUNT * 2], force[COUNT * 2], after[COUNT * 2], impulse[COUNT * 2], damage[COUNT];
    double  energy[2];
    int64_t broken, counted;
} outcome;

typedef struct job {
    rank         r;
    const scene *s;
    const int   *part; /* NULL: a body that is no part                                                                     */
    outcome     *out;
    int          fault;
    int32_t      status;
    pool         memory;
} job;

static double place[COUNT * 2], volume[COUNT], moved[COUNT * 2], way[COUNT * 2], speed[COUNT * 2];

static void make_fields(int cloud) {
    uint64_t seed = 5;
    const double h = 1.0 / 16;
    for (int i = 0; i < COUNT; ++i) {
        const double off = cloud ? 0.2 : 0;
        for (int d = 0; d < 2; ++d) {
            place[2 * i + d] = h * ((d ? i / NX : i % NX) + 0.5 + off * (2 * test_random(&seed) - 1));
            moved[2 * i + d] = 2e-3 * h * (2 * test_random(&seed) - 1) + (d ? 0.02 * (place[2 * i + d] > 0.5) : 0.004 * place[2 * i]);
            way[2 * i + d] = 1e-3 * (2 * test_random(&seed) - 1);
            speed[2 * i + d] = 0.1 * (2 * test_random(&seed) - 1) + (d && place[2 * i + 1] > 0.5);
        }
        volume[i] = h * h * (cloud ? 1 + off * (test_random(&seed) - 0.5) : 1);
    }
}

static int part_of(int ranks, int how, int i) {
    const int x = i % NX, y = i / NX;
    return how == ALONG ? x * ranks / NX : how == ACROSS ? y * ranks / NY : ((x >= 17) + 2 * (y >= 7)) % ranks;
}

static int32_t is_chosen(void *user, int64_t index, const double *x) { return (void)x, ((const uint8_t *)user)[index] != 0; }

static peri_body *make_body(job *j, uint8_t *take) {
    const scene *s = j->s;
    const double h = 1.0 / 16, lo[2] = {0, 0}, hi[2] = {NX * h, NY * h}, a[2] = {0, 0.5}, z[2] = {0.6, 0.52}, pull[2] = {0.01, 0.02};
    const double right[2] = {1.7, 0}, far_right[2] = {2, 1};
    peri_part_desc p;
    specimen t = specimen_of(PERI_SPACE_PLANE_STRAIN, s->law, 0.2, h, 3, NX, NY, 0);
    t.desc.precision = s->precision, t.desc.geometry = s->geometry;
    if (s->correction) t.desc.correction = s->correction;
    if (!s->cloud || s->law == PERI_LAW_BOND_BASED) t.material.critical_stretch = 0.02;
    hook(&t.desc, &j->memory);
    peri_body *b = specimen_start(&t);
    if (j->part) (void)rank_take(&j->r, place, COUNT, 2, j->part, (peri_ghost_depth(b) + 0.02) * 3 * h, take);
    else memset(take, 1, COUNT), j->r.points = COUNT;
    if (!s->cloud) (void)MUST(b, peri_add_shape(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo, hi, h, is_chosen, take));
    else {
        double *x = (double *)calloc((size_t)j->r.points * 3, sizeof *x), *v = x + 2 * j->r.points;
        for (int64_t k = 0; k < j->r.points; ++k) {
            memcpy(x + 2 * k, place + 2 * j->r.ids[k], 2 * sizeof *x);
            v[k] = volume[j->r.ids[k]];
        }
        (void)MUST(b, peri_add_points(b, j->r.points, x, v, NULL));
        free(x);
    }
    peri_part_desc_init(&p);
    p.length = h, p.mean_volume = h * h, p.ghost_count = j->r.ghosts, p.ghosts = j->r.ghost, p.ids = j->r.ids;
    p.exchange = rank_exchange, p.reduce = rank_reduce, p.user = j;
    if (j->part) (void)MUST(b, peri_set_part(b, &p));
    j->status = peri_build(b);
    if (j->status < 0) return b;
    (void)peri_cut_segment(b, PERI_CUT_INITIAL, a, z);
    j->status = peri_apply_body_force(b, peri_select_box(b, NULL, right, far_right), pull, NULL, NULL);
    return b;
}

static int is_own(const job *j, int64_t k) { return !j->part || j->part[j->r.ids[k]] == j->r.rank; }

/* Entries of ghosts are no numbers. */
static double *own_of(const job *j, const double *all) {
    double *in = (double *)calloc((size_t)j->r.points * 2, sizeof *in);
    for (int64_t k = 0; k < 2 * j->r.points; ++k) in[k] = is_own(j, k / 2) ? all[j->part ? 2 * j->r.ids[k / 2] + k % 2 : k] : (double)NAN;
    return in;
}

static void keep_own(const job *j, const double *in, int components, double *all) {
    for (int64_t k = 0; k < components * j->r.points; ++k)
        if (is_own(j, k / components)) all[j->part ? components * j->r.ids[k / components] + k % components : k] = in[k];
        else if (in[k] != 0 && components == 2) all[0] = (double)NAN; /* ghosts get nothing */
}

static void *live(void *user) {
    job *j = (job *)user;
    uint8_t take[COUNT];
    peri_evaluate_desc e;
    peri_evaluate_report report;
    peri_body *b = make_body(j, take);
    const int64_t n = 2 * j->r.points;
    double *u = own_of(j, moved), *p = own_of(j, way), *v = own_of(j, speed), *out = (double *)calloc((size_t)n, sizeof *out);
    double *impulse = (double *)calloc((size_t)n, sizeof *out), *stored = (double *)calloc((size_t)n, sizeof *out);
    for (int64_t k = 0; k < n; ++k) stored[k] = is_own(j, k / 2) ? u[k] : 0;
    int64_t first = 0;
    while (!is_own(j, first)) ++first;
    if (j->fault == 1) p[2 * first] = (double)NAN;
    if (j->fault == 2) u[2 * first] = HUGE_VAL;
    if (j->fault == 3) j->memory.fail_at = j->memory.calls;
    if (j->fault == 4) j->r.fail_exchange = 2;
    if (j->status >= 0) j->status = peri_multiply_stiffness_at(b, u, p, out, n);
    if (j->status >= 0) keep_own(j, out, 2, j->out->there);
    peri_evaluate_desc_init(&e);
    if (j->fault == 5) u[2 * first] = HUGE_VAL;
    e.displacement = u, e.force = out, e.nodal = 1, e.energy = 1;
    if (j->status >= 0) j->status = peri_evaluate(b, &e, &report);
    if (j->status >= 0) keep_own(j, out, 2, j->out->force), j->out->energy[0] = report.energy;
    if (j->status >= 0) j->status = peri_set_field(b, PERI_FIELD_DISPLACEMENT, stored, n);
    if (j->status >= 0) j->status = peri_multiply_stiffness(b, p, out, n);
    if (j->status >= 0) keep_own(j, out, 2, j->out->product);
    if (j->status >= 0) j->status = peri_get_field(b, PERI_FIELD_DISPLACEMENT, stored, n);
    for (int64_t k = 0; k < n / 2; ++k) /* on one part alone something changes, ghosts are as they were */
        if (is_own(j, k) && (j->part ? j->r.ids[k] : k) == 0) stored[2 * k] += 1e-5;
    if (j->status >= 0) j->status = peri_set_field(b, PERI_FIELD_DISPLACEMENT, stored, n);
    if (j->status >= 0) j->status = peri_multiply_stiffness(b, p, out, n);
    if (j->status >= 0) keep_own(j, out, 2, j->out->again);
    e.fracture = 1, e.velocity = v, e.time_step = 0.01, e.impulse = impulse;
    if (j->status >= 0) j->status = peri_evaluate(b, &e, &report);
    if (j->status >= 0) {
        keep_own(j, out, 2, j->out->after), keep_own(j, impulse, 2, j->out->impulse);
        const int64_t counted = peri_broken_count(b);
        if (j->r.rank == 0) j->out->energy[1] = report.energy, j->out->broken = report.broken, j->out->counted = counted;
        if (peri_get_field(b, PERI_FIELD_DAMAGE, out, n) == PERI_OK) keep_own(j, out, 1, j->out->damage);
    }
    peri_body_destroy(b);
    if (j->memory.blocks != 0 || j->memory.bytes != 0 || j->memory.wrong != 0) j->status = -1000;
    free(u), free(p), free(v), free(out), free(impulse), free(stored);
    rank_free(&j->r);
    return NULL;
}

/* ranks = 0: a body that is no part. `fault` happens to the last. */
static void run(const scene *s, int ranks, int how, int fault, outcome *out, int32_t *status) {
    static int part[COUNT];
    static world w;
    static job jobs[RANKS_MOST];
    memset(&w, 0, sizeof w), memset(jobs, 0, sizeof jobs), memset(out, 0, sizeof *out);
    make_fields(s->cloud);
    for (int i = 0; i < COUNT; ++i) part[i] = part_of(ranks, how, i);
    w.ranks = ranks ? ranks : 1;
    for (int k = 0; k < w.ranks; ++k) {
        jobs[k].r.w = &w, jobs[k].r.rank = k, jobs[k].s = s, jobs[k].part = ranks ? part : NULL, jobs[k].out = out;
        jobs[k].fault = k == w.ranks - 1 ? fault : 0, jobs[k].memory.fail_at = -1;
    }
    world_run(&w, &jobs[0].r, sizeof jobs[0], live);
    for (int k = 0; k < w.ranks; ++k) status[k] = jobs[k].status;
}

static void check_same(const outcome *a, const outcome *b, const scene *s, int ranks, int how) {
    const int bad = test_bad;
    CHECK(memcmp(a->product, b->product, sizeof a->product) == 0 && memcmp(a->again, b->again, sizeof a->again) == 0);
    CHECK(memcmp(a->there, b->there, sizeof a->there) == 0);
    CHECK(memcmp(a->force, b->force, sizeof a->force) == 0);
    CHECK(memcmp(a->after, b->after, sizeof a->after) == 0 && memcmp(a->impulse, b->impulse, sizeof a->impulse) == 0);
    CHECK(memcmp(a->damage, b->damage, sizeof a->damage) == 0);
    CHECK(a->broken == b->broken && a->counted == b->counted && b->counted == b->broken);
    for (int k = 0; k < 2; ++k) CHECK_NEAR(b->energy[k], a->energy[k], s->precision == PERI_PRECISION_SINGLE ? 1e-6 : 1e-12, 0);
    if (test_bad > bad)
        printf("    law %d precision %d geometry %d correction %d cloud %d, %d ranks, split %d\n", (int)s->law, (int)s->precision,
               (int)s->geometry, (int)s->correction, s->cloud, ranks, how);
}

static void compare(const scene *s, int most, int splits) {
    static outcome one, other;
    int32_t status[RANKS_MOST];
    run(s, 1, ALONG, 0, &one, status);
    CHECK(status[0] == PERI_OK);
    CHECK(one.product[0] != 0 && one.there[COUNT] != 0 && one.force[COUNT] != 0);
    if (!s->cloud || s->law == PERI_LAW_BOND_BASED) CHECK(one.broken > 20);
    for (int ranks = 2; ranks <= most; ++ranks)
        for (int how = 0; how < splits; ++how) {
            if (how == BLOCKS && ranks == 3) continue;
            run(s, ranks, how, 0, &other, status);
            for (int k = 0; k < ranks; ++k) CHECK(status[k] == PERI_OK);
            check_same(&one, &other, s, ranks, how);
        }
}

static const int32_t laws[4] = {PERI_LAW_BOND_BASED, PERI_LAW_LPS, PERI_LAW_OTERKUS, PERI_LAW_CORRESPONDENCE};
static const int32_t geometries[2] = {PERI_GEOMETRY_LINEAR, PERI_GEOMETRY_NONLINEAR};

static void products_and_forces_of_all_laws(void) {
    for (int law = 0; law < 4; ++law)
        for (int geometry = 0; geometry < 2; ++geometry)
            for (int cloud = 0; cloud < 2; ++cloud)
                for (int32_t p = 0; p < 3; ++p) {
                    scene s = {laws[law], PERI_PRECISION_DOUBLE + p, geometries[geometry], 0, cloud};
                    if (!test_long && p != (law + geometry + cloud) % 3) continue;
                    compare(&s, test_long ? 4 : 2 + (law == 1), test_long ? SPLITS : 1 + geometry);
                }
}

static void corrected_and_in_blocks(void) {
    scene s = {PERI_LAW_LPS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, PERI_CORRECTION_MOMENT, 1};
    compare(&s, test_long ? 4 : 2, test_long ? SPLITS : 1);
    s.law = PERI_LAW_BOND_BASED, s.geometry = PERI_GEOMETRY_NONLINEAR, s.correction = 0, s.cloud = 0;
    compare(&s, 4, SPLITS);
}

static void one_part_is_the_body(void) {
    for (int law = 0; law < 4; ++law)
        for (int geometry = 0; geometry < 2; ++geometry) {
            static outcome one, whole;
            scene s = {laws[law], PERI_PRECISION_DOUBLE, geometries[geometry], 0, 0};
            int32_t status[RANKS_MOST];
            run(&s, 1, ALONG, 0, &one, status);
            CHECK(status[0] == PERI_OK);
            run(&s, 0, ALONG, 0, &whole, status);
            CHECK(status[0] == PERI_OK);
            CHECK(memcmp(one.product, whole.product, sizeof one.product) == 0 && memcmp(one.there, whole.there, sizeof one.there) == 0);
            CHECK(memcmp(one.force, whole.force, sizeof one.force) == 0 && one.energy[0] == whole.energy[0]);
            CHECK(one.broken == whole.broken && one.counted == whole.counted);
        }
}

/* One rank fails, by what it was given, by memory, by its hook; all end, with its status. */
static void one_fails_all_end(void) {
    static const int32_t expected[6] = {PERI_OK,           PERI_ERROR_RANGE,    PERI_ERROR_RANGE,
                                        PERI_ERROR_MEMORY, PERI_ERROR_CALLBACK, PERI_ERROR_RANGE};
    scene s = {PERI_LAW_LPS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR, 0, 0};
    for (int fault = 1; fault < 6; ++fault) {
        static outcome out;
        int32_t status[RANKS_MOST];
        run(&s, 3, ALONG, fault, &out, status);
        for (int k = 0; k < 3; ++k) CHECK(status[k] == expected[fault]);
    }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(products_and_forces_of_all_laws);
    RUN(corrected_and_in_blocks);
    RUN(one_part_is_the_body);
    RUN(one_fails_all_end);
    return test_end("test_parts_statics");
}
