/* SPDX-License-Identifier: MIT */
/* pairs.c - two points on a bond: closed forms of steps, damping and densities at their limits; the numbers of a run. */
#include "extremes.h"

#define PI 3.14159265358979323846

static int32_t state_of(const peri_body *b, peri_error *e) {
    memset(e, 0, sizeof *e);
    return peri_get_error(b, e);
}

/* ---- two points --------------------------------------------------------------------------------------------------- */

/* Two points of unit volume a unit apart, E = 1, Poisson's ratio 1/4. f = omega^2 e/2 on each of density 1. */
static double omega2_of(int32_t law, double horizon) {
    const double bulk = 2.0 / 3.0, mu = 0.4;
    if (law == PERI_LAW_BOND_BASED) return 2 * 12 / (PI * pow(horizon, 4)); /* c = 12 E/(pi h^4) */
    if (law == PERI_LAW_CORRESPONDENCE) return 2 * 2 * 15 * mu;            /* the family is collinear: t = B e/m */
    return 2 * 18 * bulk;                                                 /* theta = 3 e: W = 9 K e^2/2 */
}

static peri_body *pair_of(outcome *o, int32_t precision, int32_t law, int32_t geometry, double rho, double other) {
    const double x[6] = {0, 0, 0, 1, 0, 0}, v[2] = {1, 1};
    int32_t materials[2];
    peri_body_desc d;
    peri_material_desc m;
    peri_body *b = NULL;
    extreme_desc(&d, PERI_SPACE_SOLID, precision, 1.5);
    d.geometry = geometry;
    extreme_material(&m, law, 0.25, 0);
    m.density = rho;
    if (extreme_fails(o, NULL, peri_body_create(&d, &b, NULL)) || extreme_fails(o, b, materials[0] = peri_add_material(b, &m))) return b;
    m.density = other;
    if (extreme_fails(o, b, materials[1] = peri_add_material(b, &m)) || extreme_fails(o, b, peri_add_points(b, 2, x, v, materials)))
        return b;
    (void)extreme_fails(o, b, peri_build(b));
    return b;
}

/* Elongation e and its rate, with its centre of mass at rest. */
static void pull(outcome *o, peri_body *b, double e, double rate, double share) {
    const double u[6] = {-e * share, 0, 0, e * (1 - share), 0, 0}, v[6] = {-rate * share, 0, 0, rate * (1 - share), 0, 0};
    if (!extreme_fails(o, b, peri_set_field(b, PERI_FIELD_DISPLACEMENT, u, 6)))
        (void)extreme_fails(o, b, peri_set_field(b, PERI_FIELD_VELOCITY, v, 6));
}

static void elongation(outcome *o, peri_body *b, double *e, double *rate) {
    double u[6] = {0}, v[6] = {0};
    if (!extreme_fails(o, b, peri_get_field(b, PERI_FIELD_DISPLACEMENT, u, 6)))
        (void)extreme_fails(o, b, peri_get_field(b, PERI_FIELD_VELOCITY, v, 6));
    *e = u[3] - u[0];
    *rate = v[3] - v[0];
}

/* From rest e_n = A cos(n theta), theta = 2 asin(s), and from velocity-Verlet v_n = -(A/dt) sin(theta) sin(n theta); s of the true limit.
   A relative error u of omega^2 turns n theta by n u s/sqrt(1 - s^2): errors in units of n u/sqrt(1 - s^2). */
static outcome oscillate(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    const double size = 1e-3;
    int32_t law, geometry, integrator;
    for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law)
        for (geometry = PERI_GEOMETRY_NONLINEAR; geometry < peri__end_geometry; ++geometry)
            for (integrator = PERI_INTEGRATOR_VELOCITY_VERLET; integrator < peri__end_integrator; ++integrator) {
                const double omega = sqrt(omega2_of(law, 1.5)), s = row->value, theta = 2 * asin(s);
                peri_body *b = pair_of(&o, precision, law, geometry, 1, 1);
                peri_advance_desc run;
                int64_t n = 0;
                int turn;
                if (o.status >= 0 && peri_stable_step(b) > 2 / omega * (1 + 8 * extreme_roundoff(precision)))
                    extreme_take(&o, HUGE_VAL, "limit", law, 0, 0);
                pull(&o, b, size, 0, 0.5);
                peri_advance_desc_init(&run);
                run.integrator = integrator;
                run.time_step = s * 2 / omega;
                run.force_step = 1; /* the limit named is below the true one for some */
                for (turn = 1; turn <= 30 && o.status >= 0; ++turn) {
                    double e, rate, off, unit;
                    run.steps = turn;
                    if (extreme_fails(&o, b, peri_advance(b, &run))) break;
                    n += turn;
                    elongation(&o, b, &e, &rate);
                    unit = (double)n * extreme_roundoff(precision) / sqrt(1 - s * s);
                    off = fabs(e - size * cos((double)n * theta)) / size;
                    off = extreme_worst(off, fabs(rate * run.time_step / size + sin(theta) * sin((double)n * theta)));
                    extreme_take(&o, off / unit, "law, geometry, integrator", law, geometry, integrator);
                }
                o = extreme_end(o, b);
                if (o.status < 0) return o;
            }
    return o;
}

/* The bound of the stiffness is sharp for two points on one bond. From rest at the limit e_n = (-1)^n A, where errors grow as n^2; beyond
   it by exp(2 acosh(s)) a step. */
static outcome sharp(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    peri_body *b = pair_of(&o, precision, PERI_LAW_BOND_BASED, PERI_GEOMETRY_LINEAR, 1, 1);
    peri_advance_desc run;
    double e = 0, rate = 0;
    peri_advance_desc_init(&run);
    pull(&o, b, 1e-3, 0, 0.5);
    if (o.status >= 0) run.time_step = row->value * peri_stable_step(b);
    run.force_step = row->value > 1;
    run.steps = row->choice;
    run.integrator = (int32_t)row->other;
    if (o.status >= 0 && !extreme_fails(&o, b, peri_advance(b, &run))) elongation(&o, b, &e, &rate);
    o.error = fabs(e / 1e-3 - 1);
    return extreme_end(o, b);
}

/* Steps without end: the invariant, exact in exact arithmetic, wanders as sqrt(n) roundings at most; the phase drifts by n of them. */
static outcome long_run(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    const double n = extreme_long ? 1e7 : precision == PERI_PRECISION_DOUBLE ? 1e6 : row->value, size = 1e-3, s = 0.9;
    const double omega = sqrt(omega2_of(PERI_LAW_BOND_BASED, 1.5));
    const double theta = 2 * asin(s), unit = extreme_roundoff(precision);
    peri_body *b = pair_of(&o, precision, PERI_LAW_BOND_BASED, PERI_GEOMETRY_LINEAR, 1, 1);
    peri_advance_desc run;
    double e = 0, rate = 0, kept;
    pull(&o, b, size, 0, 0.5);
    peri_advance_desc_init(&run);
    run.time_step = s * 2 / omega;
    run.steps = (int64_t)n;
    run.integrator = row->choice;
    if (o.status >= 0 && !extreme_fails(&o, b, peri_advance(b, &run))) elongation(&o, b, &e, &rate);
    kept = sqrt(rate * rate / (omega * omega * (1 - s * s)) + e * e) / size;
    extreme_take(&o, fabs(kept - 1) / (unit * sqrt(n) / (1 - s * s)), "invariant", 0, 0, 0);
    if (16 * n * unit < 1) extreme_take(&o, fabs(e / size - cos(n * theta)) / (2 * n * unit), "phase", 0, 0, 0);
    if (o.status >= 0 && (peri_step_count(b) != (int64_t)n || !(fabs(peri_time(b) / (n * run.time_step) - 1) < 1e-15)))
        extreme_take(&o, HUGE_VAL, "time", 0, 0, 0);
    return extreme_end(o, b);
}

/* k = c V^2/xi and masses m, r m: omega^2 = k (1/m + 1/(r m)). The lighter point's share of the motion is 1/(1 + r), and the centre
   stays. */
static outcome light(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    const double rho = row->value, ratio = row->other, size = 1e-3;
    const double omega = sqrt(omega2_of(PERI_LAW_BOND_BASED, 1.5) / 2 / rho * (1 + 1 / ratio));
    peri_body *b = pair_of(&o, precision, PERI_LAW_BOND_BASED, PERI_GEOMETRY_LINEAR, rho, rho * ratio);
    peri_advance_desc run;
    double e = 0, rate = 0, s = 0, theta, momentum[3] = {0, 0, 0};
    pull(&o, b, size, 0, ratio / (1 + ratio));
    peri_advance_desc_init(&run);
    run.steps = 50;
    if (o.status >= 0) s = 0.9 * peri_stable_step(b) * omega / 2;
    if (!(s <= 0.9 + 1e-6 && s > 0.3)) extreme_take(&o, HUGE_VAL, "step", 0, 0, 0); /* safe, and sharp to a factor of 3 */
    if (o.status >= 0 && !extreme_fails(&o, b, peri_advance(b, &run))) elongation(&o, b, &e, &rate);
    theta = 2 * asin(s);
    extreme_take(&o, fabs(e / size - cos(50 * theta)), "elongation", 0, 0, 0);
    if (o.status >= 0) (void)extreme_fails(&o, b, peri_get_momentum(b, momentum, NULL));
    extreme_take(&o, fabs(momentum[0]) / (rho * ratio / (1 + ratio) * size * omega), "momentum", 0, 0, 0);
    return extreme_end(o, b);
}

/* a dt = 2 takes all of the velocity in each step: e_n+1 = e_n (1 - omega^2 dt^2/2), whatever the velocity at the start. */
static outcome overdamped(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    const double size = 1e-3, s = row->value;
    int32_t law, integrator;
    for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law)
        for (integrator = PERI_INTEGRATOR_VELOCITY_VERLET; integrator < peri__end_integrator; ++integrator) {
            const double factor = 1 - 2 * s * s;
            peri_body *b = pair_of(&o, precision, law, PERI_GEOMETRY_LINEAR, 1, 1);
            peri_advance_desc run;
            double e = 0, rate = 0;
            peri_advance_desc_init(&run);
            pull(&o, b, size, 0.7, 0.5);
            run.integrator = integrator;
            run.time_step = s * 2 / sqrt(omega2_of(law, 1.5));
            run.force_step = 1;
            run.damping = 2 / run.time_step;
            run.steps = 20;
            if (o.status >= 0 && !extreme_fails(&o, b, peri_advance(b, &run))) elongation(&o, b, &e, &rate);
            extreme_take(&o, fabs(e / size - pow(factor, 20)), "law, integrator", law, integrator, 0);
            if (o.status >= 0) { /* a hair more is refused */
                peri_error record;
                run.damping *= 1 + 1e-15;
                run.damping = run.damping * run.time_step > 2 ? run.damping : 2.0000001 / run.time_step;
                if (peri_advance(b, &run) != PERI_ERROR_RANGE || state_of(b, &record) != PERI_OK || strcmp(record.field, "damping") != 0)
                    extreme_take(&o, HUGE_VAL, "beyond", law, integrator, 0);
            }
            o = extreme_end(o, b);
            if (o.status < 0) return o;
        }
    return o;
}

/* ---- numbers of a run --------------------------------------------------------------------------------------------- */

typedef struct count_calls {
    int calls, stop;
} count_calls;

static int32_t count_call(void *user, peri_body *b) {
    count_calls *c = (count_calls *)user;
    (void)b;
    return ++c->calls == c->stop;
}

/* One number of a run is wrong: row->choice says which, row->value what it is. Nothing may have moved. */
typedef enum number { STEPS_OF, DURATION, TIME_STEP, SAFETY, DAMPING, FRAME_STEPS, BOTH, INTEGRATOR } number;
static outcome wrong_number(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    peri_body *b = pair_of(&o, precision, PERI_LAW_BOND_BASED, PERI_GEOMETRY_LINEAR, row->other, row->other);
    peri_advance_desc run;
    int64_t whole = fabs(row->value) < 9e18 ? (int64_t)row->value : row->value < 0 ? INT64_MIN : INT64_MAX;
    int32_t code;
    peri_advance_desc_init(&run);
    run.steps = row->choice == DURATION ? 0 : 5;
    if (row->choice == STEPS_OF) run.steps = whole;
    if (row->choice == DURATION || row->choice == BOTH) run.duration = row->value;
    if (row->choice == TIME_STEP) run.time_step = row->value;
    if (row->choice == SAFETY) run.safety = row->value;
    if (row->choice == DAMPING) run.damping = row->value;
    if (row->choice == FRAME_STEPS) run.frame_steps = whole;
    if (row->choice == INTEGRATOR) run.integrator = (int32_t)whole;
    pull(&o, b, 1e-3, 0, 0.5);
    if (o.status < 0) return extreme_end(o, b);
    code = peri_advance(b, &run);
    if (peri_time(b) != 0 || peri_step_count(b) != 0) o.error = 1;
    (void)extreme_fails(&o, b, code);
    return extreme_end(o, b);
}

/* Short, but steps: u moves by v t, a force is what the bonds make of u, and the time is the duration. other: density, so the unit of
   time. BOTH: a duration far below the step. */
static outcome brief(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    const int timed = row->choice == DURATION || row->choice == BOTH;
    int32_t integrator;
    for (integrator = PERI_INTEGRATOR_VELOCITY_VERLET; integrator < peri__end_integrator; ++integrator) {
        peri_body *b = pair_of(&o, precision, PERI_LAW_BOND_BASED, PERI_GEOMETRY_LINEAR, row->other, row->other);
        double e, rate, f[6] = {0}, want = 0.5 * omega2_of(PERI_LAW_BOND_BASED, 1.5) * 1e-3;
        peri_advance_desc run;
        peri_advance_desc_init(&run);
        run.integrator = integrator;
        if (timed) run.duration = row->value;
        if (row->choice == BOTH) run.time_step = 100;
        run.force_step = row->choice == BOTH;
        if (row->choice == TIME_STEP) run.time_step = row->value;
        if (row->choice == SAFETY) run.safety = row->value;
        if (!timed) run.steps = 7;
        pull(&o, b, 1e-3, 1e-6, 0.5);
        if (o.status < 0 || extreme_fails(&o, b, peri_advance(b, &run))) return extreme_end(o, b);
        elongation(&o, b, &e, &rate);
        (void)extreme_fails(&o, b, peri_get_field(b, PERI_FIELD_FORCE_DENSITY, f, 6));
        if (timed && peri_time(b) != row->value) extreme_take(&o, HUGE_VAL, "time", integrator, 0, 0);
        if (row->choice == TIME_STEP && !(fabs(peri_time(b) / 7 / row->value - 1) < 1e-15))
            extreme_take(&o, HUGE_VAL, "time", integrator, 0, 0);
        if (peri_step_count(b) != (timed ? 1 : 7) || !(peri_time(b) > 0))
            extreme_take(&o, HUGE_VAL, "steps", integrator, 0, 0);
        extreme_take(&o, fabs(e / 1e-3 - 1), "elongation", integrator, 0, 0);
        extreme_take(&o, fabs(rate / 1e-6 - 1), "rate", integrator, 0, 0);
        extreme_take(&o, fabs(f[0] / want - 1), "force", integrator, 0, 0);
        o = extreme_end(o, b);
    }
    return o;
}

/* A load that no step can take is named; without it the body is as new. */
static outcome overloaded(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    const double force[3] = {row->value, 0, 0};
    int32_t integrator;
    for (integrator = PERI_INTEGRATOR_VELOCITY_VERLET; integrator < peri__end_integrator; ++integrator) {
        peri_body *b = pair_of(&o, precision, PERI_LAW_BOND_BASED, PERI_GEOMETRY_NONLINEAR, 1, 1);
        double u[6] = {0};
        peri_advance_desc run;
        int32_t code, load, k;
        peri_advance_desc_init(&run);
        run.integrator = integrator;
        run.steps = 3;
        if (o.status < 0) return extreme_end(o, b);
        load = peri_apply_body_force(b, PERI_ALL, force, NULL, NULL);
        (void)extreme_fails(&o, b, load);
        code = peri_advance(b, &run);
        if (code != PERI_ERROR_UNSTABLE && code != PERI_ERROR_RANGE) extreme_take(&o, HUGE_VAL, "status, integrator", -code, integrator, 0);
        (void)extreme_fails(&o, b, peri_remove_load(b, load));
        (void)extreme_fails(&o, b, peri_reset(b));
        (void)extreme_fails(&o, b, peri_advance(b, &run));
        (void)extreme_fails(&o, b, peri_get_field(b, PERI_FIELD_DISPLACEMENT, u, 6));
        for (k = 0; k < 6; ++k) extreme_take(&o, fabs(u[k]), "afterwards, integrator", integrator, 0, 0);
        o = extreme_end(o, b);
    }
    return o;
}

/* A run that would take years, stopped by its third frame; frames at every step, at none, and beyond the end. */
static outcome frames(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    static const struct {
        int64_t steps, every, done;
        int     stop, calls;
    } runs[6] = {{INT64_MAX, 4, 12, 3, 3},  {10, 3, 10, 0, 4}, {10, 1, 10, 0, 10}, {10, INT64_MAX, 10, 0, 1},
                 {INT64_MAX, 1, 1, 1, 1}, {10, 10, 10, 1, 1}};
    int k, timed;
    (void)row;
    for (k = 0; k < 6; ++k)
        for (timed = 0; timed < 2; ++timed) {
            peri_body *b = pair_of(&o, precision, PERI_LAW_BOND_BASED, PERI_GEOMETRY_LINEAR, 1, 1);
            count_calls c = {0, 0};
            peri_advance_desc run;
            int32_t code;
            peri_advance_desc_init(&run);
            c.stop = runs[k].stop;
            run.time_step = 0.5;
            if (timed) run.duration = runs[k].steps == INT64_MAX ? 4e18 : 0.5 * (double)runs[k].steps;
            else run.steps = runs[k].steps;
            run.frame_steps = runs[k].every;
            run.on_frame = count_call;
            run.user = &c;
            if (o.status >= 0) {
                code = peri_advance(b, &run);
                (void)extreme_fails(&o, b, code);
                if (code != (c.stop ? PERI_STOPPED : PERI_OK) || c.calls != runs[k].calls || peri_step_count(b) != runs[k].done)
                    extreme_take(&o, 1, "run, timed, calls", k, timed, c.calls);
            }
            o = extreme_end(o, b);
        }
    return o;
}

/* ---- rows --------------------------------------------------------------------------------------------------------- */

#define LIMIT "peri.h: a step beyond the stable one is PERI_ERROR_STEP, names it, and nothing has moved"
#define GROWTH "growth of the fastest mode beyond the limit; peri.h: PERI_ERROR_UNSTABLE beyond 1e9 speeds of sound"
#define CLOSED "closed form of the difference equation of two masses on a spring, the stiffness from the law's constants"
#define SMALL {1e-13, 1e-5, 1e-5}
#define NONE {0, 0, 0}

static const extreme rows[] = {
    {"two points, 0.1 of the limit", CLOSED, oscillate, 0.1, 0, 0, PERI_OK, NULL, {8, 8, 8}},
    {"two points, 0.999 of the limit", CLOSED, oscillate, 0.999, 0, 0, PERI_OK, NULL, {8, 8, 8}},
    {"two points, from rest at the limit, 100 steps", CLOSED, sharp, 1, PERI_INTEGRATOR_VELOCITY_VERLET, 100, PERI_OK, NULL,
     {5e-12, 2.4e-3, 2.4e-3}},
    {"two points, 1.01 of the limit, forced", GROWTH, sharp, 1.01, PERI_INTEGRATOR_VELOCITY_VERLET, 1000, PERI_ERROR_UNSTABLE, "peri_time",
     NONE},
    {"the same, central difference", GROWTH, sharp, 1.01, PERI_INTEGRATOR_CENTRAL_DIFFERENCE, 1000, PERI_ERROR_UNSTABLE, "peri_time", NONE},
    {"two points, 10^6 steps (f32, mixed: 200,000)", CLOSED, long_run, 2e5, 0, PERI_INTEGRATOR_VELOCITY_VERLET, PERI_OK, NULL, {8, 8, 8}},
    {"the same, central difference", CLOSED, long_run, 2e5, 0, PERI_INTEGRATOR_CENTRAL_DIFFERENCE, PERI_OK, NULL, {8, 8, 8}},
    {"masses 1 : 1e-12", CLOSED, light, 1, 1e-12, 0, PERI_OK, NULL, SMALL},
    {"masses 1e-12 : 1", CLOSED, light, 1e-12, 1e12, 0, PERI_OK, NULL, SMALL},
    {"masses 1 : 1e-24", CLOSED, light, 1, 1e-24, 0, PERI_OK, NULL, SMALL},
    {"masses 1 : 1e-24", CLOSED, light, 1, 1e-24, 0, PERI_OK, NULL, SMALL},
    {"masses 1e-24 : 1", CLOSED, light, 1e-24, 1e24, 0, PERI_OK, NULL, SMALL},
    {"density 1e-240", CLOSED, light, 1e-240, 1, 0, PERI_OK, NULL, SMALL},
    {"density 1e240", CLOSED, light, 1e240, 1, 0, PERI_OK, NULL, SMALL},
    {"damping a dt = 2, half of the limit", CLOSED, overdamped, 0.5, 0, 0, PERI_OK, NULL, SMALL},
    {"damping a dt = 2, 0.99 of the limit", CLOSED, overdamped, 0.99, 0, 0, PERI_OK, NULL, SMALL},
    {"frames: every step, none, INT64_MAX steps stopped", "count of calls", frames, 0, 0, 0, PERI_OK, NULL, NONE},
    {"duration of 1e-300", "peri.h: duration > 0", brief, 1e-300, 1, DURATION, PERI_OK, NULL, SMALL},
    {"duration of 5e-324", "peri.h: duration > 0", brief, 4.9406564584124654e-324, 1, DURATION, PERI_OK, NULL, SMALL},
    {"duration of 5e-324 in steps of 100", "peri.h: duration > 0", brief, 4.9406564584124654e-324, 1, BOTH, PERI_OK, NULL, SMALL},
    {"time step of 1e-300", "peri.h: time_step > 0", brief, 1e-300, 1, TIME_STEP, PERI_OK, NULL, SMALL},
    {"time step of 5e-324", "peri.h: time_step > 0", brief, 4.9406564584124654e-324, 1, TIME_STEP, PERI_OK, NULL, SMALL},
    {"a load of 1e30", "peri.h: faster than 1e9 speeds of sound", overloaded, 1e30, 0, 0, PERI_OK, NULL, NONE},
    {"a load of 1e300", "the same, or beyond the range of the precision", overloaded, 1e300, 0, 0, PERI_OK, NULL, NONE},
    {"safety of 1e-300", "peri.h: safety in (0, 1]", brief, 1e-300, 1, SAFETY, PERI_OK, NULL, SMALL},
    {"time step of 1e-320, unit of time 1e10", "no step in the unit of time: its range", brief, 1e-320, 1e20, TIME_STEP, PERI_ERROR_RANGE,
     "time_step", NONE},
    {"duration of 1e-320, unit of time 1e10", "no step in the unit of time: its range", brief, 1e-320, 1e20, DURATION, PERI_ERROR_RANGE,
     "duration", NONE},
    {"neither steps nor duration", "peri.h: one of the two is required", wrong_number, 0, 1, STEPS_OF, PERI_ERROR_ARGUMENT,
     "duration", NONE},
    {"steps and duration", "peri.h: one of the two is required", wrong_number, 1, 1, BOTH, PERI_ERROR_ARGUMENT, "duration", NONE},
    {"steps of -1", "peri.h", wrong_number, -1, 1, STEPS_OF, PERI_ERROR_ARGUMENT, "steps", NONE},
    {"steps of INT64_MIN", "peri.h", wrong_number, -1e19, 1, STEPS_OF, PERI_ERROR_ARGUMENT, "steps", NONE},
    {"duration of 0", "peri.h: required", wrong_number, 0, 1, DURATION, PERI_ERROR_ARGUMENT, "duration", NONE},
    {"duration of -1e-300", "peri.h", wrong_number, -1e-300, 1, DURATION, PERI_ERROR_RANGE, "duration", NONE},
    {"duration of 1e300", "more steps than can be counted", wrong_number, 1e300, 1, DURATION, PERI_ERROR_RANGE, "duration", NONE},
    {"duration of 1e300, unit of time 1e-120", "more steps than can be counted", wrong_number, 1e300, 1e-240, DURATION, PERI_ERROR_RANGE,
     "duration", NONE},
    {"duration of infinity", "peri.h: not finite", wrong_number, HUGE_VAL, 1, DURATION, PERI_ERROR_RANGE, "duration", NONE},
    {"duration of NaN", "peri.h: not finite", wrong_number, NAN, 1, DURATION, PERI_ERROR_RANGE, "duration", NONE},
    {"time step of NaN", "peri.h: not finite", wrong_number, NAN, 1, TIME_STEP, PERI_ERROR_RANGE, "time_step", NONE},
    {"time step of infinity", "peri.h: not finite", wrong_number, HUGE_VAL, 1, TIME_STEP, PERI_ERROR_RANGE, "time_step", NONE},
    {"time step of -1e-320", "peri.h: time_step > 0", wrong_number, -1e-320, 1, TIME_STEP, PERI_ERROR_RANGE, "time_step", NONE},
    {"time step of 1e300", LIMIT, wrong_number, 1e300, 1, TIME_STEP, PERI_ERROR_STEP, "time_step", NONE},
    {"safety of 0", "peri.h: (0, 1]", wrong_number, 0, 1, SAFETY, PERI_ERROR_RANGE, "safety", NONE},
    {"safety of -0.5", "peri.h: (0, 1]", wrong_number, -0.5, 1, SAFETY, PERI_ERROR_RANGE, "safety", NONE},
    {"safety of 1 + 2e-16", "peri.h: (0, 1]", wrong_number, 1 + 2.3e-16, 1, SAFETY, PERI_ERROR_RANGE, "safety", NONE},
    {"safety of NaN", "peri.h: not finite", wrong_number, NAN, 1, SAFETY, PERI_ERROR_RANGE, "safety", NONE},
    {"safety of 5e-324, unit of time 1e-10", "no step in the unit of time: its range", wrong_number, 4.9406564584124654e-324, 1e-20,
     SAFETY, PERI_ERROR_RANGE, "safety", NONE},
    {"damping of -1", "peri.h: a >= 0", wrong_number, -1, 1, DAMPING, PERI_ERROR_RANGE, "damping", NONE},
    {"damping of NaN", "peri.h: not finite", wrong_number, NAN, 1, DAMPING, PERI_ERROR_RANGE, "damping", NONE},
    {"damping of 1e308", "peri.h: a dt <= 2", wrong_number, 1e308, 1, DAMPING, PERI_ERROR_RANGE, "damping", NONE},
    {"damping of 1e308, unit of time 1e10", "peri.h: a dt <= 2", wrong_number, 1e308, 1e20, DAMPING, PERI_ERROR_RANGE, "damping", NONE},
    {"frame_steps of -1", "peri.h", wrong_number, -1, 1, FRAME_STEPS, PERI_ERROR_ARGUMENT, "frame_steps", NONE},
    {"frame_steps of INT64_MIN", "peri.h", wrong_number, -1e19, 1, FRAME_STEPS, PERI_ERROR_ARGUMENT, "frame_steps", NONE},
    {"integrator of 0", "peri.h", wrong_number, 0, 1, INTEGRATOR, PERI_ERROR_CHOICE, "integrator", NONE},
};
const extreme_table extreme_pairs = EXTREME_TABLE("pairs", rows);
