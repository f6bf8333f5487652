/* SPDX-License-Identifier: MIT */
/* tradeoff_motion.c - problems in time: a P wave, and a crack that branches. */
#include "tradeoff.h"

/* ---- P wave ------------------------------------------------------------------------------------------------------- */

/* A packet cos(2 pi x) exp(-x^2/2 bell^2) of plane P waves, wavelength 1, strain 1e-5, goes a way of 2 waves (3D: 1) along x through a
   block so thick that what its free sides send out has not reached the middle. Error: of the speed sqrt((lambda + 2 mu)/rho), by the
   shift at which the rows in the middle match the packet best. Plane strain, and 3D. */
enum { MARGIN = 2 }; /* waves before and behind the packet */
static const double bell = 0.45;

static double packet(double x) { return cos(2 * PI * x) * exp(-0.5 * x * x / (bell * bell)); }
static double packet_slope(double x) {
    return -(2 * PI * sin(2 * PI * x) + x / (bell * bell) * cos(2 * PI * x)) * exp(-0.5 * x * x / (bell * bell));
}

static double wave_way(const knobs *k) { return k->space == PERI_SPACE_SOLID ? 1 : 2; }
static double wave_half(const knobs *k) { return 1.02 * wave_way(k) + 2 * k->m / k->across; } /* of the thickness */

/* Within 0.9 waves of the way; line: u at x. */
static double shift_of(const double *x, const double *line, int n, double way) {
    double best = way, step = 0.009;
    for (int pass = 0; pass < 3; ++pass, step *= 0.02) {
        double most = -HUGE_VAL, tau = best;
        for (int j = -100; j <= 100; ++j) {
            const double at = tau + j * step;
            double sum = 0;
            for (int i = 0; i < n; ++i) sum += line[i] * packet(x[i] - MARGIN - at);
            if (sum > most) {
                most = sum;
                best = at;
            }
        }
    }
    return best;
}

outcome run_wave(const knobs *k) {
    const int dim = dimension_of(k), n = (int)((2 * MARGIN + wave_way(k)) * k->across + 0.5);
    const double h = 1 / k->across, way = wave_way(k), half = ceil(wave_half(k) * k->across) * h, size = 1e-5 / (2 * PI);
    const double lo[3] = { 0, -half, -half }, hi[3] = { 2 * MARGIN + way, half, half };
    const peri_material_desc material = trial_material(k);
    double lambda, mu, speed, shift = way, *x, *u, *v, *place, *line;
    peri_advance_desc run;
    trial t;
    lame_of(k, &lambda, &mu);
    speed = sqrt(lambda + 2 * mu);
    trial_create(&t, k, h, &material);
    trial_build(&t, lo, hi, h, NULL);
    trial_pause(&t);
    x = trial_read(&t, PERI_FIELD_POSITION);
    u = trial_read(&t, PERI_FIELD_DISPLACEMENT);
    v = trial_read(&t, PERI_FIELD_VELOCITY);
    for (int64_t i = 0; v && i < peri_point_count(t.body); ++i) {
        u[dim * i] = size * packet(x[dim * i] - MARGIN);
        v[dim * i] = -size * speed * packet_slope(x[dim * i] - MARGIN);
    }
    if (trial_fine(&t)) trial_note(&t, peri_set_field(t.body, PERI_FIELD_DISPLACEMENT, u, dim * peri_point_count(t.body)));
    if (trial_fine(&t)) trial_note(&t, peri_set_field(t.body, PERI_FIELD_VELOCITY, v, dim * peri_point_count(t.body)));
    peri_advance_desc_init(&run);
    run.duration = way / speed;
    run.safety = k->safety;
    run.integrator = k->integrator;
    trial_resume(&t);
    if (trial_fine(&t)) trial_note(&t, peri_advance(t.body, &run));
    trial_pause(&t);
    free(u);
    free(v);
    u = trial_read(&t, PERI_FIELD_DISPLACEMENT);
    place = (double *)calloc((size_t)n, sizeof *place);
    line = (double *)calloc((size_t)n, sizeof *line);
    if (!place || !line) exit(1);
    for (int64_t i = 0; u && i < peri_point_count(t.body); ++i) {
        const double *at = &x[dim * i];
        const int column = (int)(at[0] * k->across);
        if (fabs(at[1]) > 0.6 * h || (dim == 3 && fabs(at[2]) > 0.6 * h) || column >= n) continue;
        place[column] = at[0];
        line[column] += u[dim * i];
    }
    if (u) shift = shift_of(place, line, n, way);
    free(x);
    free(u);
    free(place);
    free(line);
    return trial_end(&t, shift / way - 1);
}

/* A stable step is about 0.6 spacings over the speed. */
double work_wave(const knobs *k) {
    const int dim = dimension_of(k);
    const double points = (2 * MARGIN + wave_way(k)) * pow(2 * wave_half(k), dim - 1) * pow(k->across, dim);
    return family_of(k) * points * (20 + wave_way(k) * k->across / (0.6 * k->safety));
}

/* ---- a crack in glass branches ------------------------------------------------------------------------------------ */

/* The pane of examples/branching.c, horizon 1 mm, bond-based by nature: Poisson ratio 1/3. Error: distance between the upper tip and that
   of the finest run, mean over the frames of a microsecond from the first break on, over the length of the finest run's path. The finest
   run: bond-based, double, FINEST spacings to the horizon, no correction, half the stable step. The tip: the middle of the foremost bond
   that has broken in the upper half, those along the middle included. The finest run is no limit: 4 and 5 spacings give paths 1.8 and
   3.5 % from it, so less than that says nothing. */
enum { FRAMES = 43, FINEST = 6 };
static const double frame = 1e-6; /* [s] */

typedef struct path {
    const double *x;
    double        tip[FRAMES + 1][2]; /* [m], of each frame                                                              */
    int           first;              /* frame of the first break                                                        */
} path;

static int32_t on_break(void *user, int32_t i, int32_t j, double time, double stretch) {
    path *p = (path *)user;
    const double x = 0.5 * (p->x[2 * i] + p->x[2 * j]), y = 0.5 * (p->x[2 * i + 1] + p->x[2 * j + 1]);
    const int at = (int)ceil(time / frame - 1e-9);
    (void)stretch;
    if (y < -1e-9 || at > FRAMES) return 0;
    if (at < p->first) p->first = at;
    if (x > p->tip[at][0]) {
        p->tip[at][0] = x;
        p->tip[at][1] = y;
    }
    return 0;
}

static outcome branch(const knobs *k, path *p) {
    const double lx = 0.05, ly = 0.02, horizon = 1e-3, h = horizon / k->m, rim = 0.99 * h;
    const double lo[2] = { -lx, -ly }, hi[2] = { lx, ly }, edge[2] = { -lx, 0 }, middle[2] = { 0, 0 };
    peri_material_desc glass = trial_material(k);
    peri_advance_desc run;
    double *x;
    trial t;
    glass.young = 72e9;
    glass.density = 2440;
    glass.fracture_energy = 3.8;
    memset(p, 0, sizeof *p);
    p->first = FRAMES;
    trial_create(&t, k, h, &glass);
    trial_build(&t, lo, hi, h, NULL);
    if (trial_fine(&t)) trial_note(&t, peri_cut_segment(t.body, PERI_CUT_INITIAL, edge, middle));
    for (int side = -1; side <= 1; side += 2) {
        const double pull[2] = { 0, 2e6 * side }, at = side * ly, inner = side * (ly - rim), zone = side * (ly - horizon);
        const int32_t outer = trial_box(&t, -lx, fmin(at, inner), lx, fmax(at, inner));
        const int32_t safe = trial_box(&t, -lx, fmin(at, zone), lx, fmax(at, zone));
        if (trial_fine(&t)) trial_note(&t, peri_apply_layer_traction(t.body, outer, 2 * lx, pull, NULL, NULL));
        if (trial_fine(&t)) trial_note(&t, peri_set_no_fail(t.body, safe, 1));
    }
    trial_pause(&t);
    p->x = x = trial_read(&t, PERI_FIELD_POSITION);
    peri_advance_desc_init(&run);
    run.duration = FRAMES * frame;
    run.safety = k->safety;
    run.integrator = k->integrator;
    trial_resume(&t);
    if (trial_fine(&t)) trial_note(&t, peri_on_break(t.body, on_break, p));
    if (trial_fine(&t)) trial_note(&t, peri_advance(t.body, &run));
    trial_pause(&t);
    for (int f = 1; f <= FRAMES; ++f)
        if (p->tip[f][0] < p->tip[f - 1][0]) memcpy(p->tip[f], p->tip[f - 1], sizeof p->tip[f]);
    free(x);
    p->x = NULL;
    return trial_end(&t, 0);
}

outcome run_branching(const knobs *k) {
    static path finest;
    static int  known;
    path own;
    outcome o;
    double apart = 0, length = 0;
    if (!known) {
        knobs best = *k;
        best.law = PERI_LAW_BOND_BASED;
        best.correction = PERI_CORRECTION_NONE;
        best.influence = PERI_INFLUENCE_CONSTANT;
        best.quadrature = PERI_QUADRATURE_FULL;
        best.precision = PERI_PRECISION_DOUBLE;
        best.geometry = PERI_GEOMETRY_NONLINEAR;
        best.integrator = PERI_INTEGRATOR_VELOCITY_VERLET;
        best.stabilization = -1;
        best.safety = 0.5;
        best.m = best.across = FINEST;
        o = branch(&best, &finest);
        if (o.status != PERI_OK) return o;
        known = 1;
    }
    o = branch(k, &own);
    if (o.status != PERI_OK) return o;
    for (int f = finest.first; f <= FRAMES; ++f) {
        apart += hypot(own.tip[f][0] - finest.tip[f][0], own.tip[f][1] - finest.tip[f][1]) / (FRAMES + 1 - finest.first);
        length += hypot(finest.tip[f][0] - finest.tip[f - 1][0], finest.tip[f][1] - finest.tip[f - 1][1]);
    }
    o.error = apart / length;
    return o;
}

double work_branching(const knobs *k) { return family_of(k) * 4000 * k->m * k->m * (20 + 43e-6 / (110e-9 * 3.33 / k->m * k->safety)); }
