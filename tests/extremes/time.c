/* SPDX-License-Identifier: MIT */
/* time.c - bodies of every kind at the limit of the time step and beyond; ends of runs. */
#include "extremes.h"

static int32_t state_of(const peri_body *b, peri_error *e) {
    memset(e, 0, sizeof *e);
    return peri_get_error(b, e);
}

static void randomize(outcome *o, peri_body *b, int32_t field, double amplitude, uint64_t seed) {
    const int64_t n = peri_size_of_field(b, field);
    double *x = (double *)malloc((size_t)n * sizeof *x);
    int64_t k;
    for (k = 0; k < n; ++k) x[k] = amplitude * (2 * test_random(&seed) - 1);
    (void)extreme_fails(o, b, peri_set_field(b, field, x, n));
    free(x);
}

/* ---- bodies of every kind ----------------------------------------------------------------------------------------- */

typedef enum kind { LATTICE, MOVED, CLOUD, MOMENTS, CUT, DAMPED, TRAPPED, KINDS } kind;
static const char *const kind_names[KINDS] = {"lattice", "moved cells", "cloud", "moment correction", "cut", "damped", "obstacles"};

static int32_t cut_some(void *user, int32_t i, int32_t j, const double *xi, const double *xj) {
    (void)user;
    (void)xi;
    (void)xj;
    return (i * 31 + j * 17) % 3 == 0;
}

static const int cells[3] = {6, 4, 2};
#define TRAP 0.5

static peri_body *body_of(outcome *o, int32_t precision, int32_t space, int32_t law, int32_t geometry, kind k) {
    const double lo[3] = {0, 0, 0}, hi[3] = {cells[0], cells[1], cells[2]};
    peri_body_desc d;
    peri_material_desc m;
    peri_body *b = NULL;
    extreme_desc(&d, space, precision, 2.2);
    d.geometry = geometry;
    if (k == MOMENTS) d.correction = PERI_CORRECTION_MOMENT;
    extreme_material(&m, law, 0.3, 0);
    if (extreme_fails(o, NULL, peri_body_create(&d, &b, NULL)) || extreme_fails(o, b, peri_add_material(b, &m))) return b;
    if (k == CLOUD) {
        double x[144], v[48];
        uint64_t seed = 3;
        int n = 0, i, axis, dim = space == PERI_SPACE_SOLID ? 3 : 2;
        for (i = 0; i < 48; ++i) {
            const int at[3] = {i % 6, i / 6 % 4, i / 24};
            if (dim == 2 && at[2]) break;
            for (axis = 0; axis < dim; ++axis) x[n * dim + axis] = at[axis] + 0.6 * test_random(&seed);
            v[n++] = 0.5 + test_random(&seed);
        }
        (void)extreme_fails(o, b, peri_add_points(b, n, x, v, NULL));
    } else if (k == MOVED) (void)extreme_fails(o, b, peri_add_perturbed_box(b, material_id(b, 1), lo, hi, 1, 1, 5));
    else (void)extreme_fails(o, b, peri_add_box(b, material_id(b, 1), lo, hi, 1));
    if (extreme_fails(o, b, peri_build(b))) return b;
    if (k == CUT) (void)extreme_fails(o, b, peri_cut_if(b, PERI_CUT_INITIAL, cut_some, NULL));
    if (k == TRAPPED) { /* from both sides, all points deep in both: springs of twice the stiffness to the middle */
        const double right[3] = {23, 0, 0}, left[3] = {-17, 0, 0}, plus[3] = {1, 0, 0}, minus[3] = {-1, 0, 0};
        (void)extreme_fails(o, b, plane_obstacle(b, right, plus, TRAP, NULL, NULL));
        (void)extreme_fails(o, b, plane_obstacle(b, left, minus, TRAP, NULL, NULL));
    }
    return b;
}

/* Runs a scene over spaces, laws, kinds and integrators. */
typedef void (*each_fn)(outcome *o, peri_body *b, const extreme *row, kind k, peri_advance_desc *run, const char *what);
static outcome each(const extreme *row, int32_t precision, int32_t geometry, each_fn one) {
    outcome o = {PERI_OK, "", 0};
    int32_t space, law, integrator;
    int k;
    for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
        for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law)
            for (k = 0; k < KINDS; ++k) {
                peri_body *b = body_of(&o, precision, space, law, geometry, (kind)k);
                for (integrator = PERI_INTEGRATOR_VELOCITY_VERLET; o.status >= 0 && integrator < peri__end_integrator; ++integrator) {
                    char what[40];
                    outcome part = {PERI_OK, "", 0};
                    peri_advance_desc run;
                    peri_advance_desc_init(&run);
                    run.integrator = integrator;
                    if (k == DAMPED) run.damping = 0.1 / peri_stable_step(b);
                    run.time_step = row->value * peri_stable_step(b);
                    (void)sprintf(what, "%.24s", kind_names[k]);
                    one(&part, b, row, (kind)k, &run, what);
                    if (part.status < 0) o = part;
                    else extreme_take(&o, part.error, what, space, law, integrator);
                    (void)extreme_fails(&o, b, peri_reset(b));
                }
                o = extreme_end(o, b);
                if (o.status < 0) return o;
            }
    return o;
}

typedef struct watch {
    double most, allowed, least; /* largest kinetic energy over what is allowed, least sum with the elastic one */
    int    closed;
} watch;

static int32_t watch_energy(void *user, peri_body *b) {
    watch *w = (watch *)user;
    peri_energy e;
    if (peri_get_energy(b, &e) < 0) return 1;
    w->most = extreme_worst(w->most, e.kinetic / w->allowed);
    if (w->closed) w->least = -extreme_worst(-w->least, -(e.kinetic + e.elastic) / w->allowed);
    return 0;
}

#define STEPS 100

/* The invariant of velocity-Verlet, v.Mv + u.Ku - dt^2/4 u.K M^-1 K u, bounds v.Mv by its start, and that by v.Mv + u.Ku. */
static void bounded(outcome *o, peri_body *b, const extreme *row, kind k, peri_advance_desc *run, const char *what) {
    watch w = {0, 0, 1, 0};
    peri_energy e;
    (void)row;
    (void)what;
    randomize(o, b, PERI_FIELD_VELOCITY, row->other, 11);
    if (extreme_fails(o, b, peri_get_energy(b, &e))) return;
    w.allowed = e.kinetic;
    w.closed = k != DAMPED && k != TRAPPED;
    if (k == TRAPPED) { /* and the energy that the obstacles' springs start with */
        double *x = extreme_read(o, b, PERI_FIELD_POSITION), *v = extreme_read(o, b, PERI_FIELD_VOLUME);
        int64_t i;
        for (i = 0; x && v && i < peri_point_count(b); ++i) {
            const double off = x[i * peri_dimension(b)] - 3;
            w.allowed += TRAP * off * off * v[i];
        }
        free(x);
        free(v);
        if (row->choice == PERI_GEOMETRY_NONLINEAR) return; /* the springs would strain it too far for the bound */
    }
    run->steps = STEPS;
    run->frame_steps = 7;
    run->on_frame = watch_energy;
    run->user = &w;
    if (extreme_fails(o, b, peri_advance(b, run))) return;
    o->error = extreme_worst(w.most - 1, 1 - w.least);
}
static outcome stable(const extreme *row, int32_t precision) { return each(row, precision, row->choice, bounded); }

static void refuse(outcome *o, peri_body *b, const extreme *row, kind k, peri_advance_desc *run, const char *what) {
    peri_error e;
    double *u;
    int64_t i;
    (void)row;
    (void)k;
    (void)what;
    randomize(o, b, PERI_FIELD_VELOCITY, 0.1, 11);
    run->steps = 10;
    if (peri_advance(b, run) != PERI_ERROR_STEP || state_of(b, &e) != PERI_OK || e.code != PERI_ERROR_STEP) o->error = 1;
    else if (strcmp(e.field, "time_step") != 0 || e.value != peri_stable_step(b)) o->error = 2;
    else if (peri_time(b) != 0 || peri_step_count(b) != 0) o->error = 3;
    u = extreme_read(o, b, PERI_FIELD_DISPLACEMENT);
    for (i = 0; u && i < peri_size_of_field(b, PERI_FIELD_DISPLACEMENT); ++i)
        if (u[i] != 0) o->error = 4;
    free(u);
    run->time_step = e.value;
    run->steps = 1; /* strain may ask for another */
    if (extreme_fails(o, b, peri_advance(b, run))) o->error = 5; /* what it named will do */
}
static outcome refused(const extreme *row, int32_t precision) { return each(row, precision, row->choice, refuse); }

/* The stable step is within 3 times the limit, so ten of it make the fastest motion grow by (2*10/3)^2 - 2 = 42 a step, without bound in
   linear geometry: from 1e-3 to 1e9 speeds of sound in 8. A shorter run may end before; then no speed is beyond that. */
static void explode(outcome *o, peri_body *b, const extreme *row, kind k, peri_advance_desc *run, const char *what) {
    int n, detected = 0;
    (void)row;
    (void)k;
    (void)what;
    run->force_step = 1;
    if (k == DAMPED) run->damping = 1.99 / run->time_step;
    for (n = 1; n <= 40 && o->status >= 0; n += n < 11 ? 2 : 19) {
        peri_error e;
        int32_t code;
        (void)extreme_fails(o, b, peri_reset(b));
        randomize(o, b, PERI_FIELD_VELOCITY, 0.1, 11);
        run->steps = n;
        code = peri_advance(b, run);
        if (code == PERI_ERROR_UNSTABLE) {
            detected++;
            if (state_of(b, &e) != PERI_OK || e.index < 0 || e.index >= peri_point_count(b)) o->error = 1;
        } else if (code == PERI_OK) {
            double *v = extreme_read(o, b, PERI_FIELD_VELOCITY);
            int64_t i;
            for (i = 0; v && i < peri_size_of_field(b, PERI_FIELD_VELOCITY); ++i)
                if (!(fabs(v[i]) <= 1.001e9)) o->error = 2;
            free(v);
            if (n > 20 && row->choice == PERI_GEOMETRY_LINEAR) o->error = 3;
        } else o->error = 4;
    }
    if (detected == 0 && row->choice == PERI_GEOMETRY_LINEAR) o->error = 5;
}
static outcome exploded(const extreme *row, int32_t precision) { return each(row, precision, row->choice, explode); }

/* ---- ends of runs ------------------------------------------------------------------------------------------------- */

static int32_t glide(void *user, double time, int64_t count, const int32_t *points, double *value) {
    const int dim = *(const int *)user;
    int64_t k;
    (void)points;
    for (k = 0; k < count; ++k) value[k * dim] = 0.1 + 0.3 * time;
    return 0;
}

typedef struct impulse {
    int32_t grip;
    double  time, given, scale;
} impulse;

static int32_t add_impulse(void *user, peri_body *b) {
    impulse *i = (impulse *)user;
    double force[2] = {0, 0};
    if (peri_get_reaction(b, i->grip, force) < 0) return 1;
    i->given += force[0] * (peri_time(b) - i->time);
    i->scale += fabs(force[0]) * (peri_time(b) - i->time);
    i->time = peri_time(b);
    return 0;
}

/* A held end that stays, or glides at 0.3, while the rest moves: at the end of a run of 3 steps and a part of one the time is the duration,
   the velocity of the end 0, or 0.3; the mean reaction is minus the bonds' force on it to the order of the last step, and reactions times
   steps are the momentum given. Sums of 16 points and 4 steps, of velocities a hundred times what is left: 1e3 roundings. */
static void end_of(outcome *o, int32_t precision, int32_t law, int32_t integrator, int glides, double part, double more) {
    peri_body *b = body_of(o, precision, PERI_SPACE_PLANE_STRESS, law, PERI_GEOMETRY_LINEAR, LATTICE), *free_body = NULL;
    const double lo[2] = {0, 0}, hi[2] = {2, 4}, start[2] = {0.1, 0}, unit = extreme_roundoff(precision);
    const double last = more > 0 ? more : part > 1e-11 ? 0.5 * (1 + part) : 1;
    double dt, reaction[2] = {0, 0}, force = 0, scale = 0, from[2] = {0, 0}, to[2] = {0, 0}, *f = NULL, *v = NULL, *x = NULL;
    impulse sum = {-1, 0, 0, 0};
    int32_t grip = -1, set;
    int dim = 2;
    peri_advance_desc run;
    if (o->status < 0) {
        *o = extreme_end(*o, b);
        return;
    }
    dt = 0.5 * peri_stable_step(b);
    set = peri_select_box(b, NULL, lo, hi);
    randomize(o, b, PERI_FIELD_VELOCITY, 0.01, 17);
    (void)extreme_fails(o, b, peri_add_displacement(b, PERI_ALL, start));
    grip = peri_prescribe_displacement(b, set, PERI_AXIS_XY, start, glides ? glide : NULL, &dim);
    (void)extreme_fails(o, b, grip);
    peri_advance_desc_init(&run);
    run.integrator = integrator;
    run.time_step = dt;
    run.duration = (3 + part) * dt;
    run.frame_steps = 1;
    run.on_frame = add_impulse;
    run.user = &sum;
    sum.grip = grip;
    if (o->status >= 0) (void)extreme_fails(o, b, peri_get_momentum(b, from, NULL));
    if (o->status >= 0) (void)extreme_fails(o, b, peri_advance(b, &run));
    if (o->status >= 0 && (peri_time(b) != run.duration || peri_step_count(b) != (part > 1e-11 ? 4 : 3)))
        extreme_take(o, HUGE_VAL, "time", law, 0, 0);
    if (o->status >= 0 && more > 0) {
        run.duration = more * dt;
        (void)extreme_fails(o, b, peri_advance(b, &run));
    }
    if (o->status >= 0) (void)extreme_fails(o, b, peri_get_momentum(b, to, NULL));
    extreme_take(o, fabs(sum.given - (to[0] - from[0])) / (1e3 * unit * (sum.scale + fabs(to[0]))), "impulse, law, integrator, glides",
                 law, integrator, glides);
    if (o->status >= 0) (void)extreme_fails(o, b, peri_get_reaction(b, grip, reaction));
    if (o->status >= 0) (void)extreme_fails(o, b, peri_body_clone(b, &free_body, NULL));
    if (o->status >= 0) (void)extreme_fails(o, free_body, peri_remove_load(free_body, grip));
    if (o->status >= 0) {
        int64_t i;
        f = extreme_read(o, free_body, PERI_FIELD_FORCE_DENSITY);
        v = extreme_read(o, b, PERI_FIELD_VELOCITY);
        x = extreme_read(o, b, PERI_FIELD_POSITION);
        for (i = 0; f && v && x && i < peri_point_count(b); ++i) {
            scale += fabs(f[2 * i]);
            if (x[2 * i] > 2) continue;
            force += f[2 * i];
            extreme_take(o, fabs(v[2 * i] - (glides ? 0.3 : 0)) * dt / (unit * 16), "velocity, law, integrator, glides", law, integrator,
                         glides);
        }
        /* over a step the force changes by at most dt times its rate, 2/(0.5 dt^2 per displacement) dt v: by its own size */
        extreme_take(o, fabs(reaction[0] + force) / (scale * (last + 1e3 * unit)), "reaction, law, integrator, glides", law, integrator,
                     glides);
    }
    free(f);
    free(v);
    free(x);
    *o = extreme_end(*o, free_body);
    *o = extreme_end(*o, b);
}

static outcome ends(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    int32_t law, integrator;
    int glides;
    for (law = PERI_LAW_BOND_BASED; law < peri__end_law && o.status >= 0; ++law)
        for (integrator = PERI_INTEGRATOR_VELOCITY_VERLET; integrator < peri__end_integrator; ++integrator)
            for (glides = 0; glides < 2 - (row->other > 0) && o.status >= 0; ++glides)
                end_of(&o, precision, law, integrator, glides, row->value, row->other);
    return o;
}

/* The run in pieces is the run: velocity-Verlet to the bit, central difference, which goes to whole steps and back, to rounding. */
static outcome pieces(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    const double pull_by[3] = {0, 1e-3, 0}, lo[3] = {0, 0, 0}, hi[3] = {6, 1, 2}, drive[3] = {0, -0.01, 0};
    int32_t space, law;
    for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
        for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law) {
            double *u[2] = {NULL, NULL};
            int turn;
            for (turn = 0; turn < 2 && o.status >= 0; ++turn) {
                peri_body *b = body_of(&o, precision, space, law, PERI_GEOMETRY_NONLINEAR, MOVED);
                peri_advance_desc run;
                int n;
                peri_advance_desc_init(&run);
                run.integrator = row->choice;
                randomize(&o, b, PERI_FIELD_VELOCITY, 0.01, 23);
                if (o.status >= 0) {
                    (void)extreme_fails(&o, b, peri_prescribe_velocity(b, peri_select_box(b, NULL, lo, hi), PERI_AXIS_Y, drive, NULL,
                                                                       NULL));
                    (void)extreme_fails(&o, b, peri_apply_body_force(b, PERI_ALL, pull_by, NULL, NULL));
                    run.time_step = 0.5 * peri_stable_step(b);
                }
                run.steps = turn ? 1 : 60;
                run.damping = 0.01;
                for (n = 0; n < (turn ? 60 : 1) && o.status >= 0; ++n) (void)extreme_fails(&o, b, peri_advance(b, &run));
                if (o.status >= 0 && !(fabs(peri_time(b) / (60 * run.time_step) - 1) <= 60 * 1.2e-16))
                    extreme_take(&o, HUGE_VAL, "time", 0, 0, 0);
                if (o.status >= 0) u[turn] = extreme_read(&o, b, PERI_FIELD_DISPLACEMENT);
                if (turn && u[0] && u[1]) {
                    double off = 0, most = 0;
                    int64_t k;
                    for (k = 0; k < peri_size_of_field(b, PERI_FIELD_DISPLACEMENT); ++k) {
                        off = extreme_worst(off, fabs(u[1][k] - u[0][k]));
                        most = extreme_worst(most, fabs(u[0][k]));
                    }
                    extreme_take(&o, off / most, "space, law", space, law, 0);
                }
                o = extreme_end(o, b);
            }
            free(u[0]);
            free(u[1]);
            if (o.status < 0) return o;
        }
    return o;
}

/* All bonds cut: points fly on, whatever the step; state-based laws have no family left to divide by. */
static int32_t cut_all(void *user, int32_t i, int32_t j, const double *xi, const double *xj) {
    (void)user;
    (void)xi;
    (void)xj;
    return i < j;
}

static outcome nothing_left(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    int32_t law, integrator;
    (void)row;
    for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law)
        for (integrator = PERI_INTEGRATOR_VELOCITY_VERLET; integrator < peri__end_integrator; ++integrator) {
            peri_body *b = body_of(&o, precision, PERI_SPACE_SOLID, law, PERI_GEOMETRY_NONLINEAR, LATTICE);
            const double v[3] = {0.25, -0.5, 0.125};
            double step = 0, *u = NULL;
            peri_advance_desc run;
            int64_t k;
            peri_advance_desc_init(&run);
            run.integrator = integrator;
            run.steps = 8;
            if (o.status >= 0) (void)extreme_fails(&o, b, peri_cut_if(b, PERI_CUT_INITIAL, cut_all, NULL));
            if (o.status >= 0) step = peri_stable_step(b);
            if (!(step > 0 && step < HUGE_VAL)) extreme_take(&o, HUGE_VAL, "step, law", law, 0, 0);
            if (o.status >= 0) (void)extreme_fails(&o, b, peri_add_velocity(b, PERI_ALL, v));
            if (o.status >= 0 && !extreme_fails(&o, b, peri_advance(b, &run))) u = extreme_read(&o, b, PERI_FIELD_DISPLACEMENT);
            for (k = 0; u && k < peri_size_of_field(b, PERI_FIELD_DISPLACEMENT); ++k)
                extreme_take(&o, fabs(u[k] / (v[k % 3] * peri_time(b)) - 1), "law, integrator", law, integrator, 0);
            free(u);
            o = extreme_end(o, b);
            if (o.status < 0) return o;
        }
    return o;
}

/* ---- rows --------------------------------------------------------------------------------------------------------- */

#define INVARIANT "invariant of velocity-Verlet: kinetic energy from u = 0 stays below its start, its sum with the elastic one above"
#define LIMIT "peri.h: a step beyond the stable one is PERI_ERROR_STEP, names it, and nothing has moved"
#define GROWTH "growth of the fastest mode beyond the limit; peri.h: PERI_ERROR_UNSTABLE beyond 1e9 speeds of sound"
#define DURATION_TRUTH "peri.h: ends exactly there; a held point does not move, its reaction is minus the bonds' force"
#define NONE {0, 0, 0}

static const extreme rows[] = {
    /* 8 roundings a step, all one way, are more than kicks and sums of 40 bonds make */
    {"0.999 of the stable step, linear", INVARIANT, stable, 0.999, 0.1, PERI_GEOMETRY_LINEAR, PERI_OK, NULL, {9e-14, 5e-5, 5e-5}},
    {"the stable step, linear", INVARIANT, stable, 1, 0.1, PERI_GEOMETRY_LINEAR, PERI_OK, NULL, {9e-14, 5e-5, 5e-5}},
    {"the stable step, strains of 1e-3", INVARIANT "; off by the order of strains", stable, 1, 1e-3, PERI_GEOMETRY_NONLINEAR, PERI_OK, NULL,
     {0.03, 0.03, 0.03}},
    {"1.001 of the stable step", LIMIT, refused, 1.001, 0, PERI_GEOMETRY_NONLINEAR, PERI_OK, NULL, NONE},
    {"10 stable steps", LIMIT, refused, 10, 0, PERI_GEOMETRY_LINEAR, PERI_OK, NULL, NONE},
    {"10 stable steps, forced, linear", GROWTH, exploded, 10, 0, PERI_GEOMETRY_LINEAR, PERI_OK, NULL, NONE},
    {"10 stable steps, forced", GROWTH ", or a speed below that", exploded, 10, 0, PERI_GEOMETRY_NONLINEAR, PERI_OK, NULL, NONE},
    {"1e10 stable steps, forced", GROWTH, exploded, 1e10, 0, PERI_GEOMETRY_LINEAR, PERI_OK, NULL, NONE},
    {"a run of 3.5 steps", DURATION_TRUTH, ends, 0.5, 0, 0, PERI_OK, NULL, {1, 1, 1}},
    {"a run of 3 + 1e-3 steps", DURATION_TRUTH, ends, 1e-3, 0, 0, PERI_OK, NULL, {1, 1, 1}},
    {"a run of 3 + 1e-6 steps", DURATION_TRUTH, ends, 1e-6, 0, 0, PERI_OK, NULL, {1, 1, 1}},
    {"a run of 3 + 1e-9 steps", DURATION_TRUTH, ends, 1e-9, 0, 0, PERI_OK, NULL, {1, 1, 1}},
    {"a run of 3 + 1e-14 steps", DURATION_TRUTH, ends, 1e-14, 0, 0, PERI_OK, NULL, {1, 1, 1}},
    {"a run of 3 steps", DURATION_TRUTH, ends, 0, 0, 0, PERI_OK, NULL, {1, 1, 1}},
    {"a run of 3.5 steps, then one of 1e-6", DURATION_TRUTH, ends, 0.5, 1e-6, 0, PERI_OK, NULL, {1, 1, 1}},
    {"a run of 3 steps, then one of 1e-12", DURATION_TRUTH, ends, 0, 1e-12, 0, PERI_OK, NULL, {1, 1, 1}},
    {"60 runs of a step", "the same run in one; velocity-Verlet keeps nothing between steps but the state", pieces, 0, 0,
     PERI_INTEGRATOR_VELOCITY_VERLET, PERI_OK, NULL, NONE},
    {"60 runs of a step, central difference", "the same run in one; half a kick back and forth a step, each rounded", pieces, 0, 0,
     PERI_INTEGRATOR_CENTRAL_DIFFERENCE, PERI_OK, NULL, {1e-13, 1e-5, 1e-5}},
    {"all bonds cut", "Newton's first law", nothing_left, 0, 0, 0, PERI_OK, NULL, {1e-14, 1e-14, 1e-6}},
};
const extreme_table extreme_time = EXTREME_TABLE("time", rows);
