/* SPDX-License-Identifier: MIT */
/* test_ranks.c - a body in parts (ranks.h), whatever the partition, is the same body.

   SOURCE OF TRUTH: what is asked of parts: the same bits of displacement, velocity and damage, the same bonds broken and the same steps as
   of one part; sums of energies to the rounding of sums, 1e-12 of the largest. That one part is right is what the other tests show: on
   a lattice whose spacing is a power of two it has the bits of a body that is no part. A part that fails ends all, within seconds, each
   with the status of the one that failed. Each scene counts that bonds broke, so that no row holds by nothing happening.
     Periodic cells: Hooke's law holds of uniform strain to rounding, and waves have the frequency of the closed form of the discrete sum,
   rho omega^2 = sum_j K(xi_j) (1 - cos(k.xi_j)), K(xi) = c V xi xi/|xi|^3 for the linear bond-based law. */
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
    if (j->status >= 0) j->status = peri_set_part(b, &p);
    if (j->status >= 0 && j->fault == 1) j->status = peri_set_families(b, 1, j->r.ghost);
    if (j->status >= 0) j->status = peri_build(b);
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
    } rows[7] = {{1, PERI_ERROR_PART}, {2, PERI_ERROR_CALLBACK}, {3, PERI_ERROR_CALLBACK}, {4, PERI_ERROR_CALLBACK},
                 {5, PERI_ERROR_CALLBACK}, {6, PERI_ERROR_PART}, {7, PERI_ERROR_RANGE}};
    scene s = {PERI_LAW_LPS, PERI_PRECISION_DOUBLE, 0, 0, 0, LATTICE, 40, 0, 0, 0.01, 0, 0};
    for (int central = 0; central < 2; ++central)
        for (int k = 0; k < 7; ++k) {
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

/* ---- periodic cells ------------------------------------------------------------------------------------------------- */

#define CELL 12
#define RIM  7 /* layers of images: two horizons of 3 spacings, and one more                                             */
#define WIDE (CELL + 2 * RIM)

static pool *memory_of_cells; /* NULL: malloc                                                                            */
static double critical_stretch;  /* of its bonds, where they break                                                      */
static peri_body *periodic(int32_t law, int32_t correction, int32_t *owned) {
    static int32_t ghosts[WIDE * WIDE], owners[WIDE * WIDE];
    const double h = 1.0 / 8, lo[2] = {0, 0}, hi[2] = {WIDE * h, WIDE * h};
    specimen s = specimen_of(PERI_SPACE_PLANE_STRAIN, law, 0.2, h, 3, WIDE, WIDE, 0);
    peri_part_desc p;
    int64_t count = 0, own = 0;
    s.desc.geometry = PERI_GEOMETRY_LINEAR, s.desc.correction = correction;
    if (critical_stretch > 0) s.material.critical_stretch = critical_stretch;
    if (memory_of_cells) hook(&s.desc, memory_of_cells);
    peri_body *b = specimen_start(&s);
    MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo, hi, h));
    for (int32_t i = 0; i < WIDE * WIDE; ++i) {
        const int x = i % WIDE, y = i / WIDE, at = RIM + (x + CELL - RIM) % CELL, up = RIM + (y + CELL - RIM) % CELL;
        if (at == x && up == y) owned[own++] = i;
        else ghosts[count] = i, owners[count++] = at + WIDE * up;
    }
    peri_part_desc_init(&p), p.length = h, p.mean_volume = h * h;
    p.ghost_count = count, p.ghosts = ghosts, p.owners = owners;
    for (int64_t k = 0, status = PERI_ERROR_MEMORY; memory_of_cells && status == PERI_ERROR_MEMORY; ++k) { /* each allocation fails once */
        const int64_t blocks = memory_of_cells->blocks;
        memory_of_cells->fail_at = memory_of_cells->calls + k;
        status = peri_set_part(b, &p);
        CHECK(status == PERI_OK || (status == PERI_ERROR_MEMORY && memory_of_cells->blocks == blocks));
    }
    for (int64_t k = 0, status = PERI_ERROR_MEMORY; memory_of_cells && status == PERI_ERROR_MEMORY; ++k) {
        const int64_t blocks = memory_of_cells->blocks;
        memory_of_cells->fail_at = memory_of_cells->calls + k;
        status = peri_build(b);
        CHECK(status == PERI_OK || (status == PERI_ERROR_MEMORY && memory_of_cells->blocks == blocks));
    }
    if (memory_of_cells) return b;
    MUST(b, peri_set_part(b, &p));
    MUST(b, peri_build(b));
    return b;
}

/* With weights whose fourth moments are isotropic the energy of any uniform strain is that of Hooke's law, and no point feels a force, as
   there is no surface. */
static void cells_have_no_surface(void) {
    const double strain[4] = {2e-3, 1e-3, 1e-3, -1e-3}, h = 1.0 / 8;
    int32_t owned[CELL * CELL];
    for (int law = 0; law < 4; ++law) {
        static double u[WIDE * WIDE * 2], f[WIDE * WIDE * 2], x[WIDE * WIDE * 2];
        const double nu = law ? 0.2 : 0.25, mu = 0.5 / (1 + nu), lambda = 2 * mu * nu / (1 - 2 * nu); /* bond-based: fixed */
        peri_energy energy;
        peri_body *b = periodic(laws[law], PERI_CORRECTION_MOMENT, owned);
        MUST(b, peri_get_field(b, PERI_FIELD_POSITION, x, WIDE * WIDE * 2));
        MUST(b, peri_set_mean_gradient(b, strain));
        memset(u, 0, sizeof u);
        for (int k = 0; k < CELL * CELL; ++k)
            for (int d = 0; d < 2; ++d)
                u[2 * owned[k] + d] = strain[2 * d] * x[2 * owned[k]] + strain[2 * d + 1] * x[2 * owned[k] + 1];
        MUST(b, peri_set_field(b, PERI_FIELD_DISPLACEMENT, u, WIDE * WIDE * 2));
        MUST(b, peri_get_field(b, PERI_FIELD_FORCE_DENSITY, f, WIDE * WIDE * 2));
        for (int k = 0; k < CELL * CELL; ++k)
            for (int d = 0; d < 2; ++d) CHECK_NEAR(f[2 * owned[k] + d], 0, 0, 1e-13);
        MUST(b, peri_get_energy(b, &energy));
        const double trace = strain[0] + strain[3], square = strain[0] * strain[0] + strain[3] * strain[3] + 2 * strain[1] * strain[2];
        const double hooke = (0.5 * lambda * trace * trace + mu * square) * CELL * CELL * h * h;
        CHECK_NEAR(energy.elastic, hooke, 1e-10, 0);
        peri_body_destroy(b);
    }
}

static void waves_in_cells_disperse(void) {
    const double h = 1.0 / 8, k = 2 * 3.14159265358979323846 * 2 / (CELL * h), a = 1e-6;
    static double u[WIDE * WIDE * 2], f[WIDE * WIDE * 2], x[WIDE * WIDE * 2];
    int32_t owned[CELL * CELL];
    double c = 0, s0, sum = 0;
    peri_body *b = periodic(PERI_LAW_BOND_BASED, PERI_CORRECTION_NONE, owned);
    const int32_t material = peri_id(b, PERI_KIND_MATERIAL, 1);
    MUST(b, peri_get_bond_constants(b, material, material, &c, &s0));
    for (int p = -3; p <= 3; ++p)
        for (int q = -3; q <= 3; ++q) {
            const double r = h * sqrt(p * p + q * q);
            if (p * p + q * q > 0 && p * p + q * q <= 9) sum += c * h * h * (p * h) * (p * h) / (r * r * r) * (1 - cos(k * p * h));
        }
    MUST(b, peri_get_field(b, PERI_FIELD_POSITION, x, WIDE * WIDE * 2));
    memset(u, 0, sizeof u);
    for (int n = 0; n < CELL * CELL; ++n) u[2 * owned[n]] = a * sin(k * x[2 * owned[n]]);
    MUST(b, peri_set_field(b, PERI_FIELD_DISPLACEMENT, u, WIDE * WIDE * 2));
    MUST(b, peri_get_field(b, PERI_FIELD_FORCE_DENSITY, f, WIDE * WIDE * 2));
    for (int n = 0; n < CELL * CELL; ++n) CHECK_NEAR(f[2 * owned[n]], -sum * u[2 * owned[n]], 0, 1e-10 * sum * a);
    peri_body_destroy(b);
}

/* A clone goes on as its body, and so does a body that was reset; all memory is counted, and given back. */
static void cells_live_as_bodies_do(void) {
    static double u[3][WIDE * WIDE * 2];
    const double strain[4] = {2e-3, 1e-3, 1e-3, -1e-3}, v[2] = {0.1, 0.02};
    int32_t owned[CELL * CELL];
    pool memory = {0, 0, 0, 0, -1, 0};
    peri_memory held;
    peri_advance_desc a;
    peri_body *copy = NULL;
    memory_of_cells = &memory;
    peri_body *b = periodic(PERI_LAW_LPS, PERI_CORRECTION_NONE, owned);
    memory_of_cells = NULL, memory.fail_at = -1;
    MUST(b, peri_get_memory(b, &held));
    CHECK(held.total == memory.bytes);
    const int32_t set = (int32_t)MUST(b, peri_select_points(b, NULL, CELL, owned));
    peri_advance_desc_init(&a), a.steps = 10;
    for (int k = 0; k < 3; ++k) {
        peri_body *own = k == 1 ? copy : b;
        if (k == 0) MUST(b, peri_body_clone(b, &copy, NULL));
        if (k == 2) MUST(b, peri_reset(b));
        MUST(own, peri_set_mean_gradient(own, strain));
        MUST(own, peri_add_velocity(own, set, v));
        MUST(own, peri_advance(own, &a));
        MUST(own, peri_get_field(own, PERI_FIELD_DISPLACEMENT, u[k], WIDE * WIDE * 2));
    }
    CHECK(memcmp(u[0], u[1], sizeof u[0]) == 0 && memcmp(u[0], u[2], sizeof u[0]) == 0);
    peri_body_destroy(b), peri_body_destroy(copy);
    CHECK(memory.blocks == 0 && memory.bytes == 0 && memory.wrong == 0);
}

/* ---- what is refused -------------------------------------------------------------------------------------------------- */

static void refused(int32_t status, int64_t got) { CHECK(got == status); }

static void parts_refuse_what_they_cannot(void) {
    static double many[WIDE * WIDE * 4];
    int32_t owned[CELL * CELL], ghosts[2] = {3, 2}, owners[2] = {9, 9};
    int64_t ids[WIDE * WIDE] = {0};
    const double lo[2] = {0, 0}, hi[2] = {1, 1}, huge[4] = {1, 2, 3, 1e9};
    const int32_t first[2] = {0, 0}, last[2] = {4, 9};
    peri_part_desc p;
    peri_solve_desc solve;
    peri_solve_report report;
    peri_evaluate_desc evaluate;
    peri_matrix *matrix = NULL;
    specimen s = specimen_of(PERI_SPACE_PLANE_STRAIN, PERI_LAW_LPS, 0.2, 0.125, 3, 8, 8, 0);
    peri_body *b = specimen_start(&s);
    const int32_t material = peri_id(b, PERI_KIND_MATERIAL, 1);
    peri_part_desc_init(&p), p.length = 1, p.mean_volume = 1;
    refused(PERI_ERROR_EMPTY, peri_set_part(b, &p));
    refused(PERI_ERROR_RANGE, peri_add_box_part(b, material, lo, hi, 0.125, first, last));
    MUST(b, peri_add_box(b, material, lo, hi, 0.125));
    refused(PERI_ERROR_ARGUMENT, peri_set_part(NULL, &p));
    refused(PERI_ERROR_ARGUMENT, peri_set_part(b, NULL));
    p.ghost_count = 64, refused(PERI_ERROR_RANGE, peri_set_part(b, &p));
    p.ghost_count = 2, refused(PERI_ERROR_ARGUMENT, peri_set_part(b, &p));
    p.ghosts = ghosts, refused(PERI_ERROR_INDEX, peri_set_part(b, &p));
    ghosts[1] = 9, p.owners = owners, refused(PERI_ERROR_INDEX, peri_set_part(b, &p));
    owners[0] = owners[1] = -1, refused(PERI_ERROR_ARGUMENT, peri_set_part(b, &p));
    owners[0] = owners[1] = 8, p.ids = ids, refused(PERI_ERROR_INDEX, peri_set_part(b, &p));
    p.ids = NULL, p.length = 0, refused(PERI_ERROR_RANGE, peri_set_part(b, &p));
    p.length = 1e3, refused(PERI_ERROR_RANGE, peri_set_part(b, &p));
    p.length = 1, p.mean_volume = NAN, refused(PERI_ERROR_RANGE, peri_set_part(b, &p));
    p.mean_volume = 1, p.cookie++, refused(PERI_ERROR_DESCRIPTOR, peri_set_part(b, &p));
    CHECK(peri_ghost_depth(b) == 2 && peri_ghost_depth(NULL) == PERI_ERROR_ARGUMENT);
    peri_body_destroy(b);

    b = periodic(PERI_LAW_LPS, PERI_CORRECTION_NONE, owned);
    peri_solve_desc_init(&solve), peri_evaluate_desc_init(&evaluate);
    refused(PERI_ERROR_PART, peri_solve(b, &solve, &report));
    refused(PERI_ERROR_PART, peri_evaluate(b, &evaluate, NULL));
    refused(PERI_ERROR_PART, peri_multiply_stiffness(b, many, many, WIDE * WIDE * 2));
    refused(PERI_ERROR_PART, peri_multiply_stiffness_at(b, many, many, many, WIDE * WIDE * 2));
    refused(PERI_ERROR_PART, peri_matrix_create(b, &matrix));
    refused(PERI_ERROR_PART, peri_find_fragments(b, NULL, 0));
    refused(PERI_ERROR_PART, peri_set_field(b, PERI_FIELD_STIFFNESS, many, WIDE * WIDE));
    refused(PERI_ERROR_PART, peri_set_contact(b, PERI_ALL, PERI_ALL, NULL));
    refused(PERI_ERROR_PART, peri_save_state(b, "build/part.state"));
    refused(PERI_ERROR_ARGUMENT, peri_set_mean_gradient(b, NULL));
    refused(PERI_ERROR_RANGE, peri_set_mean_gradient(b, huge));
    peri_body_destroy(b);
}

static int32_t read_energy(void *user, double time, int64_t count, const int32_t *points, double *value) {
    peri_energy e;
    (void)time, (void)count, (void)points, (void)value;
    return peri_get_energy((peri_body *)user, &e) < 0 ? -1 : 0;
}

/* What a load reads changes nothing; a field of bonds is the same whatever was read before; after a reset, under the mean strain that
   stays, the ledger is closed. */
static void cells_do_not_feel_readers(void) {
    static double u[2][WIDE * WIDE * 2], strain[2][WIDE * WIDE * 3], f[WIDE * WIDE * 2];
    const double mean[4] = {2e-3, 1e-3, 1e-3, -1e-3}, v[2] = {3, 0.02}, none[2] = {0, 0};
    int64_t broken[2];
    critical_stretch = 0.1;
    for (int k = 0; k < 2; ++k) {
        int32_t owned[CELL * CELL];
        peri_energy e;
        peri_advance_desc a;
        peri_body *b = periodic(PERI_LAW_BOND_BASED, PERI_CORRECTION_NONE, owned);
        const int32_t set = (int32_t)MUST(b, peri_select_points(b, NULL, 3, owned));
        MUST(b, peri_set_mean_gradient(b, mean));
        if (k) MUST(b, peri_get_field(b, PERI_FIELD_FORCE_DENSITY, f, WIDE * WIDE * 2));
        MUST(b, peri_get_field(b, PERI_FIELD_STRAIN, strain[k], WIDE * WIDE * 3));
        MUST(b, peri_add_velocity(b, set, v));
        MUST(b, peri_apply_body_force(b, set, none, k ? read_energy : NULL, k ? b : NULL));
        peri_advance_desc_init(&a), a.steps = 10;
        MUST(b, peri_advance(b, &a));
        MUST(b, peri_get_field(b, PERI_FIELD_DISPLACEMENT, u[k], WIDE * WIDE * 2));
        broken[k] = peri_broken_count(b);
        MUST(b, peri_reset(b));
        MUST(b, peri_get_energy(b, &e));
        CHECK(e.elastic > 0 && fabs(e.error) <= 1e-12 * e.elastic);
        peri_body_destroy(b);
    }
    critical_stretch = 0;
    printf("    %ld bonds broken\n", (long)broken[0]);
    CHECK(broken[0] > 0 && broken[0] == broken[1]);
    CHECK(memcmp(u[0], u[1], sizeof u[0]) == 0 && memcmp(strain[0], strain[1], sizeof strain[0]) == 0);
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
    RUN(cells_have_no_surface);
    RUN(waves_in_cells_disperse);
    RUN(cells_live_as_bodies_do);
    RUN(parts_refuse_what_they_cannot);
    RUN(cells_do_not_feel_readers);
    return test_end("test_ranks");
}
