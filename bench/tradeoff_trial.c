/* SPDX-License-Identifier: MIT */
/* tradeoff_trial.c - one run of a problem: the body that the knobs ask for, its processor time and the bytes that it takes. */
#include "tradeoff.h"

static int64_t bytes_now, bytes_most;

static void *take(void *user, uint64_t bytes) {
    (void)user;
    bytes_now += (int64_t)bytes;
    if (bytes_now > bytes_most) bytes_most = bytes_now;
    return malloc((size_t)bytes);
}

static void give(void *user, void *pointer, uint64_t bytes) {
    (void)user;
    if (pointer) bytes_now -= (int64_t)bytes;
    free(pointer);
}

static double now(void) { return (double)clock() / CLOCKS_PER_SEC; }

int dimension_of(const knobs *k) { return k->space == PERI_SPACE_SOLID ? 3 : 2; }

double family_of(const knobs *k) { return (dimension_of(k) == 3 ? 4.0 / 3.0 * PI * k->m : PI) * k->m * k->m; }

void lame_of(const knobs *k, double *lambda, double *mu) {
    *mu = 0.5 / (1 + k->poisson);
    *lambda = k->poisson / ((1 + k->poisson) * (k->space == PERI_SPACE_PLANE_STRESS ? 1 - k->poisson : 1 - 2 * k->poisson));
}

knobs knobs_of(const problem *p, int32_t law, double m, double across) {
    knobs k;
    memset(&k, 0, sizeof k);
    k.space = p->space;
    k.law = law;
    k.correction = PERI_CORRECTION_NONE;
    k.influence = PERI_INFLUENCE_CONSTANT;
    k.quadrature = PERI_QUADRATURE_FULL;
    k.precision = PERI_PRECISION_DOUBLE;
    k.geometry = p->moves ? PERI_GEOMETRY_NONLINEAR : PERI_GEOMETRY_LINEAR;
    k.integrator = PERI_INTEGRATOR_VELOCITY_VERLET;
    k.m = m;
    k.across = across;
    k.poisson = p->space == PERI_SPACE_PLANE_STRESS ? 1.0 / 3.0 : 0.25;
    k.stabilization = -1;
    k.safety = 0.9;
    return k;
}

peri_material_desc trial_material(const knobs *k) {
    peri_material_desc m;
    peri_material_desc_init(&m, k->law);
    m.young = 1;
    m.density = 1;
    if (k->law != PERI_LAW_BOND_BASED) m.poisson = k->poisson;
    if (k->stabilization >= 0) m.stabilization = k->stabilization;
    return m;
}

void trial_pause(trial *t) { t->out.seconds += now() - t->since; }
void trial_resume(trial *t) { t->since = now(); }
int trial_fine(const trial *t) { return t->out.status == PERI_OK; }

void trial_note(trial *t, int64_t result) {
    peri_error error;
    if (result >= 0 || !trial_fine(t)) return;
    t->out.status = (int32_t)result;
    (void)peri_get_error(t->body, &error);
    (void)peri_format_error(&error, t->out.text, (int64_t)sizeof t->out.text);
}

void trial_create(trial *t, const knobs *k, double spacing, const peri_material_desc *material) {
    peri_body_desc d;
    peri_error error;
    memset(t, 0, sizeof *t);
    t->k = k;
    bytes_now = bytes_most = 0;
    trial_resume(t);
    peri_body_desc_init(&d);
    d.space = k->space;
    d.precision = k->precision;
    d.geometry = k->geometry;
    d.influence = k->influence;
    d.quadrature = k->quadrature;
    d.correction = k->correction;
    d.horizon = k->m * spacing;
    d.threads = 1;
    d.ledger = 0;
    d.allocate = take;
    d.release = give;
    t->out.status = peri_body_create(&d, &t->body, &error);
    if (trial_fine(t)) trial_note(t, peri_add_material(t->body, material));
    else (void)peri_format_error(&error, t->out.text, (int64_t)sizeof t->out.text);
}

void trial_build(trial *t, const double *lo, const double *hi, double spacing, peri_point_fn inside) {
    if (!trial_fine(t)) return;
    if (inside) trial_note(t, peri_add_shape(t->body, peri_id(t->body, PERI_KIND_MATERIAL, 1), lo, hi, spacing, inside, NULL));
    else trial_note(t, peri_add_box(t->body, peri_id(t->body, PERI_KIND_MATERIAL, 1), lo, hi, spacing));
    if (trial_fine(t)) trial_note(t, peri_build(t->body));
}

int32_t trial_box(trial *t, double x0, double y0, double x1, double y1) {
    const double lo[3] = { x0, y0, -1e9 }, hi[3] = { x1, y1, 1e9 };
    int32_t set;
    if (!trial_fine(t)) return -1;
    set = peri_select_box(t->body, NULL, lo, hi);
    trial_note(t, set);
    return set;
}

double *trial_read(trial *t, int32_t field) {
    int64_t n;
    double *x;
    if (!trial_fine(t)) return NULL;
    n = peri_size_of_field(t->body, field);
    x = (double *)calloc((size_t)n, sizeof *x);
    if (!x) exit(1);
    trial_note(t, peri_get_field(t->body, field, x, n));
    return x;
}

void trial_solve(trial *t, int32_t loose, double from) {
    peri_solve_desc s;
    if (!trial_fine(t)) return;
    peri_solve_desc_init(&s);
    s.tolerance = t->k->tolerance;
    s.loose = loose;
    s.load_from = from;
    trial_note(t, peri_solve(t->body, &s, NULL));
}

outcome trial_end(trial *t, double error) {
    t->out.error = trial_fine(t) ? fabs(error) : 0;
    if (trial_fine(t) && !(t->out.error < HUGE_VAL)) {
        t->out.status = PERI_ERROR_RANGE;
        (void)snprintf(t->out.text, sizeof t->out.text, "the result is not finite");
    }
    if (t->body) {
        t->out.points = peri_point_count(t->body);
        t->out.bonds = peri_entry_count(t->body);
    }
    t->out.bytes = bytes_most;
    peri_body_destroy(t->body);
    return t->out;
}
