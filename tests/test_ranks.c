/* SPDX-License-Identifier: MIT */
/* test_ranks.c - a body in parts (ranks.h), whatever the partition, is the same body.

   SOURCE OF TRUTH: what is asked of parts: the same bits of displacement, velocity and damage, the same bonds broken and the same steps as
   of one part; sums of energies to the rounding of sums, 1e-12 of the largest. That one part is right is what the other tests show: on
   a lattice whose spacing is a power of two it has the bits of a body that is no part. A part that fails ends all, within seconds, each
   with the status of the one that failed. Each scene counts that bonds broke, so that no row holds by nothing happening. */
#include "pool.h"
#include "ranks.h"

#define NX 30
#define NY 16
#define COUNT (NX * NY)

typedef enum split { ALONG, ACROSS, BLOCKS, STRIPES, SPLITS } split;
typedef enum cloud { LATTICE, PERTURBED, CLOUD } cloud;

typedef struct scene {
    int32_t law, precision, correction, integrator, timing;
    int     cloud, steps, automatic, damped;
    double  critical;
    int32_t criterion;
    double  thin; /* ghosts are so many horizons less deep than they must be */
} scene;

typedef struct outcome {
    double      u[COUNT * 2], v[COUNT * 2], damage[COUNT];
    peri_energy energy;
    double      linear[2], angular, reaction[2], time, stable, push[2];
    int64_t     broken, cut, steps;
    int32_t     status;
} outcome;

typedef struct job {
    rank          r;
    const scene  *s;
    const int    *part;
    outcome      *out;
    int           fault;
    int32_t       status;
} job;

static double place[COUNT * 2], volume[COUNT];

static void make_cloud(int kind) {
    uint64_t seed = 5;
    const double h = 1.0 / 16;
    for (int i = 0; i < COUNT; ++i) {
        const double off = kind == LATTICE ? 0 : kind == PERTURBED ? 0.1 : 0.3;
        for (int d = 0; d < 2; ++d) place[2 * i + d] = h * ((d ? i / NX : i % NX) + 0.5 + off * (2 * test_random(&seed) - 1));
        volume[i] = h * h * (kind == LATTICE ? 1 : 1 + off * (test_random(&seed) - 0.5));
    }
}

static void make_parts(int *part, int ranks, int how) {
    for (int i = 0; i < COUNT; ++i) {
        const int x = i % NX, y = i / NX;
        part[i] = how == ALONG ? x * ranks / NX : how == ACROSS ? y * ranks / NY : how == STRIPES ? (x + y) * ranks / (NX + NY)
                  : ((x >= 17) + 2 * (y >= 7)) % ranks;
    }
}

typedef struct chosen {
    const uint8_t *take;
} chosen;
static int32_t is_chosen(void *user, int64_t index, const double *x) { return (void)x, ((const chosen *)user)->take[index] != 0; }

static int32_t pull(void *user, double time, int64_t count, const int32_t *points, double *value) {
    const job *j = (const job *)user;
    (void)points;
    for (int64_t k = 0; k < count; ++k) value[2 * k] = 0.02 * sin(3 * time);
    return j->fault == 2 && time > 0.2 ? -7 : 0;
}
static int32_t look(void *user, peri_body *b) {
    const job *j = (const job *)user;
    return j->fault == 3 && peri_step_count(b) > 3 ? -3 : 0;
}
static int32_t listen(void *user, int32_t i, int32_t j, double time, double stretch) {
    (void)i, (void)j, (void)time, (void)stretch;
    return ((const job *)user)->fault == 4 ? -4 : 0;
}

static peri_body *make_part(job *j, uint8_t *take) {
    const scene *s = j->s;
    const double h = 1.0 / 16, lo[2] = {0, 0}, hi[2] = {NX * h, NY * h}, reach = 3.0 * h;
    peri_body *b = NULL;
    peri_body_desc d;
    peri_material_desc m;
    peri_part_desc p;
    peri_error error;
    chosen by = {take};
    peri_body_desc_init(&d);
    d.space = PERI_SPACE_PLANE_STRAIN, d.precision = s->precision, d.horizon = reach, d.threads = 1;
    d.break_timing = s->timing ? s->timing : d.break_timing;
    d.correction = s->correction ? s->correction : d.correction;
    j->status = peri_body_create(&d, &b, NULL);
    if (j->status < 0) return NULL;
    peri_material_desc_init(&m, s->law);
    m.young = 1, m.density = 1, m.critical_stretch = s->critical;
    if (s->law != PERI_LAW_BOND_BASED) m.poisson = 0.2;
    if (s->criterion) m.criterion = s->criterion;
    if (s->criterion == PERI_CRITERION_RATE_STRETCH) m.rate = 10;
    if (s->criterion == PERI_CRITERION_DELAYED_STRETCH) m.delay = 0.05;
    const int32_t glass = peri_add_material(b, &m);
    (void)rank_take(&j->r, place, COUNT, 2, j->part, (peri_ghost_depth(b) + 0.02 - s->thin) * reach, take);
    if (s->cloud == LATTICE) j->status = (int32_t)peri_add_shape(b, glass, lo, hi, h, is_chosen, &by);
    else {
        double *x = (double *)calloc((size_t)j->r.points * 3, sizeof *x), *v = x + 2 * j->r.points;
        for (int64_t k = 0; k < j->r.points; ++k) {
            memcpy(x + 2 * k, place + 2 * j->r.ids[k], 2 * sizeof *x);
            v[k] = volume[j->r.ids[k]];
        }
        j->status = (int32_t)peri_add_points(b, j->r.points, x, v, NULL);
        free(x);
    }
    peri_part_desc_init(&p);
    p.length = h, p.mean_volume = h * h, p.ghost_count = j->r.ghosts, p.ghosts = j->r.ghost, p.ids = j->r.ids;
    p.exchange = rank_exchange, p.reduce = rank_reduce, p.user = j;
    for (int64_t k = 0; j->fault == 8 && k < j->r.points; ++k) j->r.ids[k] += k > j->r.points / 2;
    if (j->fault == 9) p.ids = NULL;
    if (j->status >= 0) j->status = peri_set_part(b, &p);
    if (j->status >= 0 && j->fault == 1) j->status = peri_set_families(b, 1, j->r.ghost);
    if (j->status >= 0) j->status = peri_build(b);
    if (j->fault >= 8 && (peri_get_error(b, &error) != PERI_OK || strcmp(error.field, "ids") != 0)) j->status = -1000;
    return b;
}

/* Cracked, held at the left, drawn to the right by a callback, pulled apart by its own motion, against an obstacle. */
static void load_part(peri_body *b, job *j, int32_t *grip) {
    const double a[2] = {0, 0.5}, z[2] = {0.6, 0.52}, left[2] = {0, 0}, left_hi[2] = {0.15, 1}, right[2] = {1.7, 0}, far2[2] = {2, 1};
    const double base[2] = {0, 0}, up[2] = {0, 1}, force[2] = {0.01, 0.02}, apart[2] = {0, 0.3}, back[2] = {0, -0.3};
    const double low[2] = {0.2, 0}, low_hi[2] = {1.5, 0.49}, high[2] = {0.2, 0.51}, high_hi[2] = {1.5, 1};
    int32_t set;
    if (j->status < 0) return;
    (void)peri_cut_segment(b, PERI_CUT_INITIAL, a, z);
    set = peri_select_box(b, "left", left, left_hi);
    *grip = peri_prescribe_velocity(b, set, PERI_AXIS_XY, NULL, NULL, NULL);
    set = peri_select_box(b, "right", right, far2);
    (void)peri_prescribe_displacement(b, set, PERI_AXIS_X, NULL, pull, j);
    (void)peri_set_no_fail(b, set, 1);
    (void)peri_apply_body_force(b, PERI_ALL, force, NULL, NULL);
    (void)peri_apply_layer_traction(b, set, 0.5, force, NULL, NULL);
    set = peri_select_box(b, "low", low, low_hi);
    (void)peri_add_velocity(b, set, back);
    set = peri_select_box(b, "high", high, high_hi);
    j->status = peri_add_velocity(b, set, apart);
    (void)plane_obstacle(b, base, up, 0, NULL, NULL);
    if (j->status >= 0) j->status = peri_on_break(b, listen, j);
}

/* Own points of a field into the whole. */
static void put_own(peri_body *b, const job *j, int32_t field, int components, double *out) {
    double *all = (double *)calloc((size_t)(j->r.points * components), sizeof *all);
    if (peri_get_field(b, field, all, j->r.points * components) == PERI_OK)
        for (int64_t k = 0; k < j->r.points; ++k)
            if (j->part[j->r.ids[k]] == j->r.rank)
                memcpy(out + j->r.ids[k] * components, all + k * components, (size_t)components * sizeof *out);
    free(all);
}

static void read_part(peri_body *b, job *j, int32_t grip) {
    outcome o;
    put_own(b, j, PERI_FIELD_DISPLACEMENT, 2, j->out->u);
    put_own(b, j, PERI_FIELD_VELOCITY, 2, j->out->v);
    put_own(b, j, PERI_FIELD_DAMAGE, 1, j->out->damage);
    (void)peri_get_energy(b, &o.energy);
    (void)peri_get_momentum(b, o.linear, &o.angular);
    (void)peri_get_reaction(b, grip, o.reaction);
    (void)peri_get_obstacle_force(b, peri_id(b, PERI_KIND_OBSTACLE, 1), o.push, NULL);
    o.broken = peri_broken_count(b), o.cut = peri_cut_count(b), o.steps = peri_step_count(b), o.time = peri_time(b);
    o.stable = peri_stable_step(b);
    if (j->r.rank > 0) return;
    j->out->energy = o.energy, j->out->broken = o.broken, j->out->cut = o.cut, j->out->steps = o.steps, j->out->time = o.time;
    j->out->stable = o.stable, j->out->angular = o.angular;
    memcpy(j->out->linear, o.linear, sizeof o.linear), memcpy(j->out->reaction, o.reaction, sizeof o.reaction);
    memcpy(j->out->push, o.push, sizeof o.push);
}

static void *live(void *user) {
    job *j = (job *)user;
    const scene *s = j->s;
    uint8_t take[COUNT];
    int32_t grip = 0;
    peri_advance_desc a;
    peri_body *b = make_part(j, take);
    load_part(b, j, &grip);
    if (j->fault >= 2) j->r.fail_exchange = j->fault == 5 ? 4 : 0;
    peri_advance_desc_init(&a);
    if (s->automatic) a.duration = 0.02 * s->steps;
    else a.steps = s->steps, a.time_step = 0.02;
    if (j->fault == 6) a.steps = 7, a.duration = 0;
    if (j->fault == 7) a.safety = -1;
    a.damping = s->damped ? 0.1 : 0;
    a.force_step = test_long && !s->automatic; /* broken families may be stiffer */
    a.integrator = s->integrator ? s->integrator : a.integrator;
    a.frame_steps = 5, a.on_frame = look, a.user = j;
    if (j->status >= 0) j->status = peri_advance(b, &a);
    if (j->status >= 0) read_part(b, j, grip);
    peri_body_destroy(b);
    rank_free(&j->r);
    return NULL;
}

/* `fault` happens to the last rank. */
static world run(const scene *s, int ranks, int how, int fault, outcome *out, int32_t *status) {
    static int part[COUNT];
    static world w;
    job jobs[RANKS_MOST];
    memset(&w, 0, sizeof w), memset(jobs, 0, sizeof jobs), memset(out, 0, sizeof *out);
    make_cloud(s->cloud);
    make_parts(part, ranks, how);
    w.ranks = ranks;
    for (int k = 0; k < ranks; ++k)
        jobs[k].r.w = &w, jobs[k].r.rank = k, jobs[k].s = s, jobs[k].part = part, jobs[k].out = out,
        jobs[k].fault = k == ranks - 1 ? fault : 0;
    world_run(&w, &jobs[0].r, sizeof jobs[0], live);
    for (int k = 0; k < ranks; ++k) status[k] = jobs[k].status;
    return w;
}

static void check_same(const outcome *a, const outcome *b, const char *what) {
    const double *e = &a->energy.kinetic, *f = &b->energy.kinetic;
    double most = 0;
    int bad = test_bad;
    CHECK(memcmp(a->u, b->u, sizeof a->u) == 0 && memcmp(a->v, b->v, sizeof a->v) == 0);
    CHECK(memcmp(a->damage, b->damage, sizeof a->damage) == 0);
    CHECK(a->broken == b->broken && a->cut == b->cut && a->steps == b->steps && a->time == b->time && a->stable == b->stable);
    for (int k = 0; k < 9; ++k) most = fmax(most, fabs(e[k]));
    for (int k = 0; k < 9; ++k) CHECK_NEAR(f[k], e[k], 0, 1e-12 * most);
    for (int d = 0; d < 2; ++d) {
        CHECK_NEAR(b->linear[d], a->linear[d], 0, 1e-12);
        CHECK_NEAR(b->reaction[d], a->reaction[d], 1e-12, 1e-13);
        CHECK_NEAR(b->push[d], a->push[d], 1e-12, 1e-13);
    }
    CHECK_NEAR(b->angular, a->angular, 0, 1e-12);
    if (test_bad > bad) {
        int u = 0;
        for (int k = 0; k < 2 * COUNT; ++k) u += a->u[k] != b->u[k];
        printf("    %s: %d displacements differ; %ld and %ld broken, %ld and %ld steps\n", what, u, (long)a->broken, (long)b->broken,
               (long)a->steps, (long)b->steps);
    }
}

static void compare(const scene *s, int most, int splits) {
    static outcome one, other;
    int32_t status[RANKS_MOST];
    char what[160];
    (void)run(s, 1, ALONG, 0, &one, status);
    if (status[0] < 0) printf("    law %d: %s\n", (int)s->law, peri_status_text(status[0]));
    CHECK(status[0] == PERI_OK);
    CHECK(one.broken > 20 && one.cut > 20);
    for (int ranks = 2; ranks <= most; ++ranks)
        for (int how = 0; how < splits; ++how) {
            if (how == BLOCKS && ranks == 3) continue;
            (void)run(s, ranks, how, 0, &other, status);
            for (int k = 0; k < ranks; ++k) CHECK(status[k] == PERI_OK);
            (void)snprintf(what, sizeof what, "law %d precision %d cloud %d correction %d integrator %d criterion %d, %d ranks, split %d",
                           (int)s->law, (int)s->precision, s->cloud, (int)s->correction, (int)s->integrator, (int)s->criterion, ranks, how);
            check_same(&one, &other, what);
        }
}

static const int32_t laws[4] = {PERI_LAW_BOND_BASED, PERI_LAW_LPS, PERI_LAW_OTERKUS, PERI_LAW_CORRESPONDENCE};

static void lattices_of_all_laws(void) {
    for (int law = 0; law < 4; ++law)
        for (int32_t p = 0; p < (test_long ? 3 : 1); ++p) {
            scene s = {laws[law], PERI_PRECISION_DOUBLE + p, 0, 0, 0, LATTICE, test_long ? 300 : 25, 0, 0, 0.01, 0, 0};
            compare(&s, test_long ? 4 : 2, test_long ? SPLITS : law == 1 ? 2 : 1);
        }
}

static void clouds_of_all_laws(void) {
    for (int law = 0; law < 4; ++law)
        for (int32_t p = 0; p < 3; ++p) {
            scene s = {laws[law], PERI_PRECISION_DOUBLE + p, 0, 0, 0, law % 2 ? CLOUD : PERTURBED, test_long ? 300 : 20, 0, 0, 0.01, 0, 0};
            if (!test_long && p != law % 3) continue;
            compare(&s, test_long ? 4 : 2, test_long ? SPLITS : 1);
        }
}

static void corrections_and_criteria(void) {
    const int32_t corrections[3] = {PERI_CORRECTION_VOLUME, PERI_CORRECTION_ENERGY, PERI_CORRECTION_MOMENT};
    const int32_t criteria[2] = {PERI_CRITERION_RATE_STRETCH, PERI_CRITERION_DELAYED_STRETCH};
    for (int k = 0; k < 3; ++k) {
        scene s = {PERI_LAW_BOND_BASED, PERI_PRECISION_DOUBLE + k, corrections[k], 0, 0, k == 1 ? LATTICE : CLOUD, 15, 0, 0, 0.01, 0, 0};
        if (test_long || k == 2) compare(&s, test_long ? 4 : 2, test_long ? SPLITS : 1);
        s.law = PERI_LAW_LPS;
        if (test_long) compare(&s, 4, SPLITS);
    }
    for (int k = 0; k < 2; ++k) {
        scene s = {k ? PERI_LAW_LPS : PERI_LAW_BOND_BASED, PERI_PRECISION_DOUBLE, 0, 0, 0, LATTICE, 30, 0, 0, 0.005, criteria[k], 0};
        compare(&s, test_long ? 4 : 2, test_long ? SPLITS : 1 + k);
    }
}

/* The step follows what breaks; the other integrator; bonds that break after the drift; damping. */
static void automatic_steps_and_other_ways(void) {
    scene s = {PERI_LAW_LPS, PERI_PRECISION_DOUBLE, 0, 0, 0, LATTICE, 15, 1, 0, 0.01, 0, 0};
    compare(&s, test_long ? 4 : 2, test_long ? SPLITS : 1);
    s.law = PERI_LAW_BOND_BASED, s.correction = PERI_CORRECTION_MOMENT, s.cloud = CLOUD;
    if (test_long) compare(&s, 4, SPLITS);
    s.correction = 0, s.integrator = PERI_INTEGRATOR_CENTRAL_DIFFERENCE, s.damped = 1, s.automatic = 0, s.cloud = LATTICE;
    compare(&s, 4, test_long ? SPLITS : 1);
    s.timing = PERI_BREAK_AFTER_DRIFT, s.law = PERI_LAW_LPS;
    compare(&s, test_long ? 4 : 2, test_long ? SPLITS : 1);
}

/* One rank fails; all end, with its status. */
static void one_fails_all_end(void) {
    static const struct {
        int     fault;
        int32_t status;
    } rows[9] = {{1, PERI_ERROR_PART}, {2, PERI_ERROR_CALLBACK}, {3, PERI_ERROR_CALLBACK}, {4, PERI_ERROR_CALLBACK},
                 {5, PERI_ERROR_CALLBACK}, {6, PERI_ERROR_PART}, {7, PERI_ERROR_RANGE}, {8, PERI_ERROR_PART},
                 {9, PERI_ERROR_PART}};
    scene s = {PERI_LAW_LPS, PERI_PRECISION_DOUBLE, 0, 0, 0, LATTICE, 40, 0, 0, 0.01, 0, 0};
    for (int central = 0; central < 2; ++central)
        for (int k = 0; k < 9; ++k) {
            static outcome out;
            int32_t status[RANKS_MOST];
            s.integrator = central ? PERI_INTEGRATOR_CENTRAL_DIFFERENCE : PERI_INTEGRATOR_VELOCITY_VERLET;
            (void)run(&s, 3, ALONG, rows[k].fault, &out, status);
            for (int n = 0; n < 3; ++n) {
                if (status[n] != rows[k].status) printf("    fault %d, rank %d: %s\n", rows[k].fault, n, peri_status_text(status[n]));
                CHECK(status[n] == rows[k].status);
            }
        }
}

/* All parts have ghosts a layer short: families of ghosts are not as large as those of their owners. */
static void thin_ghosts_are_refused(void) {
    scene s = {PERI_LAW_LPS, PERI_PRECISION_SINGLE, 0, 0, 0, LATTICE, 5, 0, 0, 0.01, 0, 0.33};
    for (int law = 0; law < 2; ++law) {
        static outcome out;
        int32_t status[RANKS_MOST];
        s.law = laws[law], s.correction = law ? 0 : PERI_CORRECTION_MOMENT;
        (void)run(&s, 2, ACROSS, 0, &out, status);
        CHECK(status[0] == PERI_ERROR_PART && status[1] == PERI_ERROR_PART);
    }
}

/* A step makes one exchange and one reduction, and each rank hears once from each neighbour: four planes where bonds may break. */
static void messages_are_as_few_as_said(void) {
    scene s = {PERI_LAW_BOND_BASED, PERI_PRECISION_DOUBLE, 0, 0, 0, LATTICE, 10, 0, 0, 0.01, 0, 0};
    static outcome out;
    int32_t status[RANKS_MOST];
    const world few = run(&s, 2, ALONG, 0, &out, status);
    s.steps = 30;
    const world many = run(&s, 2, ALONG, 0, &out, status);
    CHECK(many.exchanges - few.exchanges == 20);
    CHECK(many.messages - few.messages == 2 * 20);
    CHECK(many.reductions - few.reductions == 20 + 2 * 4); /* and two at each of four frames */
    CHECK(many.bytes - few.bytes == 20 * (2 * 3 * NY) * 4 * 8); /* three columns of points each way */
}

/* One part on a lattice of a spacing of 1/16 against the same that is no part: up to the step, which is given. */
static void one_part_is_the_body(void) {
    const double h = 1.0 / 16, lo[2] = {0, 0}, hi[2] = {NX * h, NY * h}, v[2] = {0, 0.3}, half[2] = {2, 0.5};
    const int32_t first[2] = {0, 0}, last[2] = {NX, NY};
    double *u[2] = {NULL, NULL};
    for (int law = 0; law < 4; ++law) {
        for (int k = 0; k < 2; ++k) {
            specimen s = specimen_of(PERI_SPACE_PLANE_STRAIN, laws[law], 0.2, h, 3, NX, NY, 0);
            peri_part_desc p;
            peri_advance_desc a;
            s.material.critical_stretch = law ? 0 : 0.01;
            peri_body *b = specimen_start(&s);
            const int32_t material = peri_id(b, PERI_KIND_MATERIAL, 1);
            CHECK((k ? peri_add_box_part(b, material, lo, hi, h, first, last) : peri_add_box(b, material, lo, hi, h)) == COUNT);
            peri_part_desc_init(&p), p.length = h, p.mean_volume = h * h;
            if (k) MUST(b, peri_set_part(b, &p));
            MUST(b, peri_build(b));
            MUST(b, peri_add_velocity(b, peri_select_box(b, NULL, lo, half), v));
            peri_advance_desc_init(&a), a.steps = 20, a.time_step = 0.02;
            MUST(b, peri_advance(b, &a));
            CHECK(law || peri_broken_count(b) > 0);
            u[k] = (double *)calloc(COUNT * 2, sizeof(double));
            MUST(b, peri_get_field(b, PERI_FIELD_DISPLACEMENT, u[k], COUNT * 2));
            peri_body_destroy(b);
        }
        CHECK(memcmp(u[0], u[1], COUNT * 2 * sizeof(double)) == 0);
        free(u[0]), free(u[1]);
    }
}

/* Ghosts a horizon too thin, or of another place, are seen where families are searched. */
static void wrong_ghosts_are_refused(void) {
    const double h = 1.0 / 16, lo[2] = {0, 0}, hi[2] = {NX * h, NY * h};
    for (int wrong = 0; wrong < 2; ++wrong) {
        specimen s = specimen_of(PERI_SPACE_PLANE_STRAIN, PERI_LAW_LPS, 0.2, h, 3, NX, NY, 0);
        static int32_t ghosts[COUNT], owners[COUNT];
        world w;
        rank  r;
        peri_part_desc p;
        peri_error error;
        memset(&w, 0, sizeof w), memset(&r, 0, sizeof r), w.ranks = 1, r.w = &w;
        (void)pthread_mutex_init(&w.lock, NULL), (void)pthread_cond_init(&w.all, NULL);
        for (int32_t i = 0; i < NX; ++i) ghosts[i] = i, owners[i] = wrong ? (i + 1) % NX : i + NX;
        r.ghosts = NX, r.ghost = ghosts, r.there = owners, r.owner = (int32_t *)calloc(NX, sizeof(int32_t));
        peri_body *b = specimen_start(&s);
        MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo, hi, h));
        peri_part_desc_init(&p), p.length = h, p.mean_volume = h * h, p.ghost_count = NX, p.ghosts = ghosts, p.exchange = rank_exchange,
        p.user = &r;
        MUST(b, peri_set_part(b, &p));
        CHECK(peri_build(b) == PERI_ERROR_PART && peri_get_error(b, &error) == PERI_OK && strcmp(error.field, "ghosts") == 0);
        peri_body_destroy(b);
        free(r.owner);
    }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(lattices_of_all_laws);
    RUN(clouds_of_all_laws);
    RUN(corrections_and_criteria);
    RUN(automatic_steps_and_other_ways);
    RUN(one_fails_all_end);
    RUN(thin_ghosts_are_refused);
    RUN(messages_are_as_few_as_said);
    RUN(one_part_is_the_body);
    RUN(wrong_ghosts_are_refused);
    return test_end("test_ranks");
}
