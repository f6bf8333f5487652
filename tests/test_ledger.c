/* SPDX-License-Identifier: MIT */
/* test_ledger.c - the energy ledger: initial + external + obstacle = kinetic + elastic + damping + fracture + error.

   Nothing here was recorded from the library. The truth is the first law: the error is what the time step left open, and for
   a second-order scheme it goes with dt^2. Kinetic, elastic and fracture energies are also summed here by brute force. */
#include "scene.h"

#define CRITICAL 0.02 /* stretch, where bonds break */

static int32_t strip(peri_body *b, double from, double to) {
    const double lo[2] = {from, -1e3}, hi[2] = {to, 1e3};
    return (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi));
}

/* A smooth displacement and velocity to begin with: one and a half waves in a body of 1.2 x 0.8. Where `held`, what the
   supports of run_ledger prescribe at t = 0 (no motion in x on the left, none in y on the right): a jump there would not be smooth. */
static void stir(peri_body *b, double amplitude, int held) {
    double *x = get(b, PERI_FIELD_POSITION), *u = get(b, PERI_FIELD_DISPLACEMENT), *v = get(b, PERI_FIELD_VELOCITY);
    int64_t i;
    for (i = 0; i < peri_point_count(b); ++i) {
        u[2 * i] = amplitude * sin(4 * x[2 * i]) * cos(3 * x[2 * i + 1]);
        u[2 * i + 1] = amplitude * cos(3 * x[2 * i] + 1) * sin(2 * x[2 * i + 1]);
        v[2 * i] = amplitude * cos(5 * x[2 * i + 1]);
        v[2 * i + 1] = -2 * amplitude * sin(2 * x[2 * i] + 0.5);
        if (held && x[2 * i] < 2 * H) u[2 * i] = v[2 * i] = 0;
        if (held && x[2 * i] > 10 * H) v[2 * i + 1] = 0;
    }
    put(b, PERI_FIELD_DISPLACEMENT, u);
    put(b, PERI_FIELD_VELOCITY, v);
    free(x);
    free(u);
    free(v);
}

/* ---- entries ------------------------------------------------------------------------------------------------------ */

/* SOURCE OF TRUTH: the definitions: sum of m v^2/2 over points, of c s^2 |xi| V_i V_j/2 over pairs (energy density: half of
   each of a point's bonds), by a loop over all pairs. Random state, so no symmetry hides a factor; 1e-12 for ~1000 terms. */
static void entries(int32_t space, int32_t geometry) {
    peri_body *b = block(space, PERI_PRECISION_DOUBLE, geometry, 5, 4, 3);
    int dim = peri_dimension(b), k, n = (int)peri_point_count(b), i, j;
    double *u = random_field((int64_t)n * dim, 0.1 * H, 5), *v = random_field((int64_t)n * dim, 0.3, 6);
    double *x = get(b, PERI_FIELD_POSITION), *vol = get(b, PERI_FIELD_VOLUME), *w, c = micromodulus(space, YOUNG, 3 * H);
    double kinetic = 0, elastic = 0;
    peri_energy e;
    put(b, PERI_FIELD_DISPLACEMENT, u);
    put(b, PERI_FIELD_VELOCITY, v);
    w = get(b, PERI_FIELD_ENERGY_DENSITY);
    for (i = 0; i < n; ++i) {
        double mine = 0;
        for (k = 0; k < dim; ++k) kinetic += 0.5 * DENSITY * vol[i] * thickness(space) * v[i * dim + k] * v[i * dim + k];
        for (j = 0; j < n; ++j) {
            double len = 0, cur = 0, dot = 0, s;
            for (k = 0; k < dim; ++k) {
                double xi = x[j * dim + k] - x[i * dim + k], eta = u[j * dim + k] - u[i * dim + k];
                len += xi * xi;
                cur += (xi + eta) * (xi + eta);
                dot += xi * eta;
            }
            len = sqrt(len);
            if (j == i || len > 3 * H * (1 + 1e-8)) continue;
            s = geometry == PERI_GEOMETRY_LINEAR ? dot / (len * len) : (sqrt(cur) - len) / len;
            mine += 0.25 * c * s * s * len * vol[j];
        }
        CHECK_NEAR(w[i], mine, 1e-12, 0);
        elastic += mine * vol[i] * thickness(space);
    }
    (void)MUST(b, peri_get_energy(b, &e));
    CHECK_NEAR(e.kinetic, kinetic, 1e-12, 0);
    CHECK_NEAR(e.elastic, elastic, 1e-12, 0);
    CHECK_NEAR(e.initial, kinetic + elastic, 1e-12, 0);
    CHECK_NEAR(e.error, 0, 0, 1e-13 * e.initial);
    CHECK(e.external == 0 && e.obstacle == 0 && e.damping == 0 && e.fracture == 0);
    free(u);
    free(v);
    free(x);
    free(vol);
    free(w);
    peri_body_destroy(b);
}
static void entries_by_brute_force(void) {
    entries(PERI_SPACE_PLANE_STRESS, PERI_GEOMETRY_NONLINEAR);
    entries(PERI_SPACE_PLANE_STRAIN, PERI_GEOMETRY_LINEAR);
    entries(PERI_SPACE_SOLID, PERI_GEOMETRY_NONLINEAR);
    entries(PERI_SPACE_SOLID, PERI_GEOMETRY_LINEAR);
}

/* ---- order -------------------------------------------------------------------------------------------------------- */

/* What acts: any sum of these. FREE: a start in motion; RELEASE: loads and supports are taken away at half time. */
enum { BODY_FORCE = 1, SUPPORT = 2, DAMPED = 4, PLANE = 8, BALL = 16, FREE = 32, RELEASE = 64 };

static int32_t shaking(void *user, double time, int64_t count, const int32_t *points, double *value) {
    int64_t i;
    (void)user;
    (void)points;
    for (i = 0; i < count; ++i) {
        value[2 * i] = 0.05 * sin(3 * time + 0.3);
        value[2 * i + 1] = 0.02 * cos(2 * time);
    }
    return 0;
}
static int32_t swinging(void *user, double time, int64_t count, const int32_t *points, double *value) { /* a displacement */
    int64_t i;
    (void)user;
    (void)points;
    for (i = 0; i < count; ++i) value[2 * i] = 0.02 * (1 - cos(2 * time));
    return 0;
}
static int32_t swaying(void *user, double time, int64_t count, const int32_t *points, double *value) { /* a velocity */
    int64_t i;
    (void)user;
    (void)points;
    for (i = 0; i < count; ++i) value[2 * i + 1] = 0.03 * sin(2.5 * time);
    return 0;
}
static int32_t heaving(void *user, double time, double *place, double *turn) {
    (void)user, (void)turn;
    place[1] = H + 0.01 * sin(2 * time);
    return 0;
}

typedef struct watch {
    double error, total, depth; /* largest |error|, largest energy, least depth of the lowest row in the plane obstacle */
    int    what, failed, loads;
} watch;

static int32_t on_frame(void *user, peri_body *b) {
    watch *w = (watch *)user;
    peri_energy e;
    if (peri_get_energy(b, &e) != PERI_OK) w->failed++;
    w->error = fmax(w->error, fabs(e.error));
    w->total = fmax(w->total, e.kinetic + e.elastic);
    if (fabs(e.error - (e.initial + e.external + e.obstacle - e.kinetic - e.elastic - e.damping - e.fracture)) >
        1e-14 * (e.kinetic + e.elastic + fabs(e.external) + fabs(e.obstacle)))
        w->failed++;
    if (w->what & RELEASE && peri_time(b) > 0.79)
        for (; w->loads > 0; --w->loads)
            if (peri_remove_load(b, peri_id(b, PERI_KIND_LOAD, w->loads)) != PERI_OK) w->failed++;
    if (w->what & PLANE) {
        double *x = get(b, PERI_FIELD_CURRENT_POSITION);
        int i;
        for (i = 0; i < 12; ++i) w->depth = fmin(w->depth, H - 0.01 - x[2 * i + 1]);
        free(x);
    }
    return 0;
}

/* Largest |error| over 16 frames of a run of 1.6 time units in n steps. */
static watch run_ledger(int what, int integrator, int64_t n) {
    peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR, 12, 8, 1);
    const double up[2] = {0, 1}, place[2] = {0, H}, centre[2] = {0.6, -0.5};
    watch w;
    peri_energy e;
    peri_advance_desc r;
    peri_advance_desc_init(&r);
    memset(&w, 0, sizeof w);
    w.what = what;
    w.depth = 1;
    if (what & FREE) stir(b, 0.004, what & SUPPORT);
    w.loads = (what & BODY_FORCE ? 1 : 0) + (what & SUPPORT ? 2 : 0);
    if (what & BODY_FORCE) (void)MUST(b, peri_apply_body_force(b, strip(b, 0.5, 2), NULL, shaking, NULL));
    if (what & SUPPORT) {
        (void)MUST(b, peri_prescribe_displacement(b, strip(b, 0, 2 * H), PERI_AXIS_X, NULL, swinging, NULL));
        (void)MUST(b, peri_prescribe_velocity(b, strip(b, 10 * H, 12 * H), PERI_AXIS_Y, NULL, swaying, NULL));
    }
    if (what & DAMPED) r.damping = 1.5;
    /* a soft plane through the lowest row's cells' upper faces: that row is in it all the time, no other ever is */
    if (what & PLANE) (void)MUST(b, plane_obstacle(b, place, up, 0.5, heaving, NULL));
    if (what & BALL) (void)MUST(b, ball_obstacle(b, centre, 0.6, 0.5, NULL, NULL)); /* some in, some out */
    r.integrator = integrator;
    r.steps = n;
    r.time_step = 1.6 / (double)n;
    r.frame_steps = n / 16;
    r.on_frame = on_frame;
    r.user = &w;
    (void)MUST(b, peri_advance(b, &r));
    (void)MUST(b, peri_get_energy(b, &e));
    CHECK(w.failed == 0 && w.depth > 0);
    if (what & (BODY_FORCE | SUPPORT)) CHECK(fabs(e.external) > 1e-3 * w.total);
    else CHECK(e.external == 0);
    if (what & (PLANE | BALL)) CHECK(fabs(e.obstacle) > 1e-4 * w.total);
    else CHECK(e.obstacle == 0);
    if (what & DAMPED) CHECK(e.damping > 0.1 * w.total);
    else CHECK(e.damping == 0);
    peri_body_destroy(b);
    return w;
}

/* SOURCE OF TRUTH: velocity-Verlet and central difference are of second order and so must be the ledger: halving dt divides
   the error by 4. Order 2.0 +- 0.1 over three halvings, from 64 steps (dt about 0.3 of the stable step). */
static void order(const char *name, int what) {
    int integrator;
    for (integrator = PERI_INTEGRATOR_VELOCITY_VERLET; integrator < peri__end_integrator; ++integrator) {
        double last = 0;
        int64_t n;
        printf("    %-20s %s", name, integrator == PERI_INTEGRATOR_VELOCITY_VERLET ? "verlet " : "central");
        for (n = 64; n <= 512; n *= 2) {
            watch w = run_ledger(what, integrator, n);
            if (n > 64) {
                double p = log2(last / w.error);
                printf("  order %.3f", p);
                if (fabs(p - 2.0) > 0.1) test_bad++;
            } else {
                printf("  |error|/total %.2e", w.error / w.total);
                if (!(w.error > 0 && w.error < 0.05 * w.total)) test_bad++;
            }
            last = w.error;
        }
        printf("\n");
    }
}
static void error_free(void) { order("free", FREE); }
static void error_under_body_force(void) { order("body force", FREE | BODY_FORCE); }
static void error_with_moving_supports(void) {
    order("supports", SUPPORT);
    order("supports, stirred", FREE | SUPPORT);
    order("supports, force", FREE | SUPPORT | BODY_FORCE);
}
static void error_with_damping(void) {
    order("damping", FREE | DAMPED);
    order("damping, force", FREE | DAMPED | BODY_FORCE);
}
static void error_with_damped_supports(void) { order("supports, damping", SUPPORT | DAMPED); }
static void error_with_an_obstacle(void) {
    order("plane", FREE | PLANE);
    order("plane, damping", FREE | PLANE | DAMPED);
    order("plane, supports", FREE | PLANE | SUPPORT);
}
static void error_with_loads_released(void) {
    order("force released", FREE | BODY_FORCE | RELEASE);
    order("supports released", FREE | SUPPORT | RELEASE);
    order("both, damping", FREE | BODY_FORCE | SUPPORT | DAMPED | RELEASE);
}
static void error_with_everything(void) { order("all of these", FREE | BODY_FORCE | SUPPORT | DAMPED | PLANE); }

/* A ball obstacle that points enter and leave: the force has kinks, so the order is 2 in the large only: 8 times the steps
   must give at least 30 times less (64 if smooth). */
static void kinks_do_not_spoil_the_order(void) {
    double coarse = run_ledger(FREE | BALL, PERI_INTEGRATOR_VELOCITY_VERLET, 64).error;
    double fine = run_ledger(FREE | BALL, PERI_INTEGRATOR_VELOCITY_VERLET, 512).error;
    printf("    ball obstacle: error ratio over 8 times the steps %.1f\n", coarse / fine);
    CHECK(coarse / fine > 30);
}

/* SOURCE OF TRUTH: the contract of peri_body_desc.ledger: without it the same motion, bit by bit, and the same kinetic, elastic
   and fracture energy; the rest is not kept. */
static void without_a_ledger(void) {
    peri_energy e[2];
    double *u[2];
    int k;
    for (k = 0; k < 2; ++k) {
        const double corner[2] = {0, 0}, b2[2] = {0.5, -0.2}, up[2] = {0, 1};
        specimen s = specimen_of(PERI_SPACE_PLANE_STRAIN, PERI_LAW_BOND_BASED, 0, H, 3, 12, 6, 1);
        peri_body *b;
        s.desc.ledger = k;
        s.material.young = YOUNG;
        s.material.density = DENSITY;
        s.material.critical_stretch = CRITICAL;
        b = specimen_make(&s);
        (void)MUST(b, peri_apply_body_force(b, strip(b, 6 * H, 12 * H), b2, NULL, NULL));
        (void)MUST(b, peri_prescribe_velocity(b, strip(b, 0, 2 * H), PERI_AXIS_X | PERI_AXIS_Y, NULL, swaying, NULL));
        (void)MUST(b, plane_obstacle(b, corner, up, 0, NULL, NULL));
        (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 60, 0, 0.1);
        CHECK(peri_broken_count(b) > 5);
        (void)MUST(b, peri_get_energy(b, &e[k]));
        u[k] = get(b, PERI_FIELD_DISPLACEMENT);
        peri_body_destroy(b);
    }
    CHECK(memcmp(u[0], u[1], 144 * sizeof(double)) == 0);
    CHECK(e[0].kinetic == e[1].kinetic && e[0].elastic == e[1].elastic && e[0].fracture == e[1].fracture && e[0].fracture > 0);
    CHECK(e[0].external == 0 && e[0].damping == 0 && e[0].obstacle == 0 && e[1].external != 0 && e[1].damping > 0);
    free(u[0]);
    free(u[1]);
}

/* ---- drift -------------------------------------------------------------------------------------------------------- */

typedef struct envelope {
    int    frames;
    double first, last, mean_first, mean_last;
} envelope;

static int32_t on_drift_frame(void *user, peri_body *b) {
    envelope *w = (envelope *)user;
    peri_energy e;
    (void)peri_get_energy(b, &e);
    if (w->frames < 1000) {
        w->first = fmax(w->first, fabs(e.error));
        w->mean_first += e.error / 1000;
    } else if (w->frames >= 9000 && w->frames < 10000) {
        w->last = fmax(w->last, fabs(e.error));
        w->mean_last += e.error / 1000;
    }
    w->frames++;
    return 0;
}

/* SOURCE OF TRUTH: velocity-Verlet is symplectic: its energy error oscillates and does not grow. 16 points, 100,000 steps at
   0.5 of the stable step, small amplitude (so that modes hardly exchange energy); envelope of |error| in the first and last
   tenth within a quarter of each other, the means no further apart than a tenth of the envelope. */
static void no_drift_in_100000_steps(void) {
    peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR, 4, 4, 1);
    envelope w;
    peri_advance_desc r;
    double *u = random_field(32, 1e-4 * H, 12);
    memset(&w, 0, sizeof w);
    put(b, PERI_FIELD_DISPLACEMENT, u);
    peri_advance_desc_init(&r);
    r.steps = 100000;
    r.time_step = 0.5 * peri_stable_step(b);
    r.frame_steps = 10;
    r.on_frame = on_drift_frame;
    r.user = &w;
    (void)MUST(b, peri_advance(b, &r));
    printf("    envelope %.4g, after 100,000 steps %.4g; mean %.4g, %.4g\n", w.first, w.last, w.mean_first, w.mean_last);
    CHECK(w.frames >= 10000 && w.first > 0);
    CHECK(w.last < 1.25 * w.first && w.last > 0.8 * w.first);
    CHECK(fabs(w.mean_last - w.mean_first) < 0.1 * w.first);
    free(u);
    peri_body_destroy(b);
}

/* ---- fracture ----------------------------------------------------------------------------------------------------- */

typedef struct breaks {
    peri_body    *body;
    const double *x, *vol;
    int64_t       count;
    double        energy, last_time;
    int           within; /* 1: bonds break at the critical stretch, 0: at that of the event */
    int32_t       last_i, last_j;
    int           bad;
} breaks;

static int32_t on_break(void *user, int32_t i, int32_t j, double time, double s) {
    breaks *w = (breaks *)user;
    double len = hypot(w->x[2 * j] - w->x[2 * i], w->x[2 * j + 1] - w->x[2 * i + 1]);
    double c = micromodulus(PERI_SPACE_PLANE_STRESS, YOUNG, 3 * H);
    const double at = w->within ? CRITICAL : s;
    w->count++;
    w->energy += 0.5 * c * at * at * len * w->vol[i] * w->vol[j] * THICK;
    if (!(i < j) || !(s > CRITICAL) || time < w->last_time) w->bad++;
    if (time == w->last_time && (i < w->last_i || (i == w->last_i && j <= w->last_j))) w->bad++;
    if (peri_bond_is_intact(w->body, i, j) != 0) w->bad++;
    w->last_time = time;
    w->last_i = i;
    w->last_j = j;
    return 0;
}
static int32_t pull(void *user, double time, int64_t count, const int32_t *points, double *value) {
    double v = time < 2 ? 0.5 - 0.5 * cos(0.5 * PI * time) : 1;
    int64_t i;
    (void)points;
    for (i = 0; i < count; ++i) value[2 * i] = *(const double *)user * v;
    return 0;
}

typedef struct torn {
    double  error, total; /* largest |error| and energy over the run */
    double  end, fracture;
    int64_t broken;
} torn;

typedef struct tearing {
    int32_t timing, integrator, precision, grips; /* grips = 1: bonds near the ends do not break */
    double  speed;
} tearing;

/* A bar of 24 x 5 points, notched from above in the middle, both ends pulled apart with a velocity that rises smoothly. */
static torn tear(tearing how, int64_t n) {
    double left = -how.speed, right = how.speed;
    const double a[2] = {12 * H, 3 * H}, z[2] = {12 * H, 6 * H};
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, H, 3, 24, 5, 1);
    peri_body *b;
    peri_advance_desc r;
    peri_energy e;
    watch w;
    breaks k;
    torn t;
    double *x, *vol;
    memset(&w, 0, sizeof w);
    memset(&k, 0, sizeof k);
    memset(&t, 0, sizeof t);
    s.desc.thickness = THICK;
    s.desc.break_timing = how.timing;
    s.desc.precision = how.precision;
    s.material.young = YOUNG;
    s.material.density = DENSITY;
    s.material.critical_stretch = CRITICAL;
    b = specimen_make(&s);
    CHECK(MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, a, z)) > 0);
    (void)MUST(b, peri_prescribe_velocity(b, strip(b, 0, 3 * H), PERI_AXIS_X, NULL, pull, &left));
    (void)MUST(b, peri_prescribe_velocity(b, strip(b, 21 * H, 24 * H), PERI_AXIS_X, NULL, pull, &right));
    (void)MUST(b, peri_set_no_fail(b, strip(b, 0, 6 * H), how.grips));
    (void)MUST(b, peri_set_no_fail(b, strip(b, 18 * H, 24 * H), how.grips));
    k.body = b;
    k.within = how.timing == PERI_BREAK_WITHIN_STEP;
    k.x = x = get(b, PERI_FIELD_POSITION);
    k.vol = vol = get(b, PERI_FIELD_VOLUME);
    (void)MUST(b, peri_on_break(b, on_break, &k));
    peri_advance_desc_init(&r);
    r.integrator = how.integrator;
    r.steps = n;
    r.time_step = 8.0 / (double)n;
    r.frame_steps = n / 64;
    r.on_frame = on_frame;
    r.user = &w;
    (void)MUST(b, peri_advance(b, &r));
    (void)MUST(b, peri_get_energy(b, &e));
    CHECK(w.failed == 0 && k.bad == 0);
    CHECK(k.count == peri_broken_count(b));
    /* in float the bond's weight and length are rounded too, and the event's stretch comes from other roundings: a few u */
    CHECK_NEAR(e.fracture, k.energy, how.precision == PERI_PRECISION_DOUBLE ? 1e-12 : 16 * ULP32, 0);
    t.error = w.error;
    t.total = w.total;
    t.end = e.error;
    t.fracture = e.fracture;
    t.broken = k.count;
    free(x);
    free(vol);
    peri_body_destroy(b);
    return t;
}

/* The elastic run to compare with, as sharp as the recoil of the torn bar: the same bar, unbreakable, let go from a uniform
   strain equal to the critical stretch. */
static double recoil(int64_t n) {
    peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR, 24, 5, 1);
    double *x = get(b, PERI_FIELD_POSITION), *u = get(b, PERI_FIELD_DISPLACEMENT);
    peri_advance_desc r;
    watch w;
    int i;
    memset(&w, 0, sizeof w);
    for (i = 0; i < 120; ++i) u[2 * i] = CRITICAL * (x[2 * i] - 12 * H);
    put(b, PERI_FIELD_DISPLACEMENT, u);
    peri_advance_desc_init(&r);
    r.steps = n;
    r.time_step = 8.0 / (double)n;
    r.frame_steps = n / 64;
    r.on_frame = on_frame;
    r.user = &w;
    (void)MUST(b, peri_advance(b, &r));
    free(x);
    free(u);
    peri_body_destroy(b);
    return w.error / w.total;
}

/* SOURCE OF TRUTH: the first law, and [T] 1.26: a bond takes with it the energy that it holds at its critical stretch, however long the
   step is. Every |error| relative to the largest energy of its own run. Within the step: as good as the elastic run (within a factor of 3)
   and falling with dt^2 (breaks fall on other steps as dt changes, so the order is asked for over three halvings together: 2.0 +- 0.4). */
static void torn_bar_closes(int32_t integrator, int32_t grips, double speed) {
    tearing how = {PERI_BREAK_WITHIN_STEP, 0, PERI_PRECISION_DOUBLE, 0, 0};
    double first = 0, last = 0;
    int64_t n;
    how.integrator = integrator;
    how.grips = grips;
    how.speed = speed;
    for (n = 256; n <= 2048; n *= 2) {
        torn t = tear(how, n);
        double elastic = recoil(n);
        last = t.error / t.total;
        if (n == 256) first = last;
        printf("    n %4d, %3d bonds, |error|/fracture %.2e, max |error|/energy %.2e, elastic run %.2e\n", (int)n, (int)t.broken,
               fabs(t.end) / t.fracture, last, elastic);
        CHECK(t.broken > 10 && t.fracture > 0.05 * t.total);
        CHECK(last <= 3 * elastic);
    }
    printf("    order over three halvings %.2f\n", log2(first / last) / 3);
    CHECK(fabs(log2(first / last) / 3 - 2) <= 0.4);
}
static void fracture_closes(void) { torn_bar_closes(PERI_INTEGRATOR_VELOCITY_VERLET, 1, 0.02); }
static void fracture_closes_central(void) { torn_bar_closes(PERI_INTEGRATOR_CENTRAL_DIFFERENCE, 1, 0.02); }
static void fracture_at_the_supports_closes(void) { torn_bar_closes(PERI_INTEGRATOR_VELOCITY_VERLET, 0, 0.1); }

/* Float: closes to the same size where that is above rounding: 256 steps of u on the energy, and events sum to the ledger. */
static void fracture_closes_in_float(void) {
    tearing how = {PERI_BREAK_WITHIN_STEP, PERI_INTEGRATOR_VELOCITY_VERLET, PERI_PRECISION_SINGLE, 1, 0.02};
    torn t = tear(how, 256);
    CHECK(t.broken > 10 && t.error / t.total <= 3 * recoil(256) + 256 * ULP32);
}

/* After the drift the broken bond's second half kick is missing: the ledger is open by about dt/2 * force * velocity per bond,
   first order: over three halvings the error falls by 8 (accepted: 4 to 20), and it is worse than within the step. */
static void break_after_drift_is_of_first_order(void) {
    tearing how = {PERI_BREAK_AFTER_DRIFT, PERI_INTEGRATOR_VELOCITY_VERLET, PERI_PRECISION_DOUBLE, 1, 0.02};
    double first = 0, last = 0;
    int64_t n;
    torn end;
    for (n = 256; n <= 2048; n *= 2) {
        torn t = tear(how, n);
        last = t.error / t.total;
        if (n == 256) first = last;
        printf("    n %4d, %3d bonds, |error|/fracture %.2e, max |error|/energy %.2e\n", (int)n, (int)t.broken,
               fabs(t.end) / t.fracture, last);
    }
    CHECK(first / last > 4 && first / last < 20);
    how.timing = PERI_BREAK_WITHIN_STEP;
    end = tear(how, 2048);
    CHECK(last > 2 * end.error / end.total);
}

/* SOURCE OF TRUTH: the contract: PERI_CUT_NOW takes its bonds' energy out of `initial`, counts as broken and is
   whole again after a reset; writing a field puts in what it changes. None of them moves `error`. */
static void interventions_are_accounted(void) {
    peri_body *b = block(PERI_SPACE_PLANE_STRAIN, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR, 12, 8, 1);
    const double a[2] = {6 * H, 0}, z[2] = {6 * H, 5 * H};
    double rest[192], tiny;
    peri_energy e0, e1, e2;
    int64_t cut;
    memset(rest, 0, sizeof rest);
    stir(b, 0.004, 0);
    (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 50, 0, 0);
    (void)MUST(b, peri_get_energy(b, &e0));
    cut = MUST(b, peri_cut_segment(b, PERI_CUT_NOW, a, z));
    (void)MUST(b, peri_get_energy(b, &e1));
    tiny = 1e-12 * (e0.kinetic + e0.elastic);
    CHECK(cut > 0 && peri_broken_count(b) == cut && peri_cut_count(b) == 0);
    CHECK(e1.elastic < e0.elastic && e1.kinetic == e0.kinetic && e1.fracture == 0);
    CHECK_NEAR(e1.initial - e0.initial, e1.elastic - e0.elastic, 0, tiny);
    CHECK_NEAR(e1.error, e0.error, 0, tiny);
    put(b, PERI_FIELD_VELOCITY, rest);
    (void)MUST(b, peri_get_energy(b, &e2));
    CHECK(e2.kinetic == 0 && e2.elastic == e1.elastic);
    CHECK_NEAR(e2.initial - e1.initial, -e1.kinetic, 0, tiny);
    CHECK_NEAR(e2.error, e0.error, 0, tiny);
    (void)MUST(b, peri_reset(b));
    (void)MUST(b, peri_get_energy(b, &e0));
    CHECK(e0.kinetic == 0 && e0.elastic == 0 && e0.initial == 0 && e0.error == 0 && peri_broken_count(b) == 0);
    peri_body_destroy(b);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(entries_by_brute_force);
    RUN(error_free);
    RUN(error_under_body_force);
    RUN(error_with_moving_supports);
    RUN(error_with_damping);
    RUN(error_with_damped_supports);
    RUN(error_with_an_obstacle);
    RUN(error_with_loads_released);
    RUN(error_with_everything);
    RUN(without_a_ledger);
    RUN(kinks_do_not_spoil_the_order);
    RUN(no_drift_in_100000_steps);
    RUN(interventions_are_accounted);
    RUN(fracture_closes);
    RUN(fracture_closes_central);
    RUN(fracture_at_the_supports_closes);
    RUN(fracture_closes_in_float);
    RUN(break_after_drift_is_of_first_order);
    return test_end("test_ledger");
}
