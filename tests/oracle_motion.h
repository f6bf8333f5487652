/* SPDX-License-Identifier: MIT */
/* oracle_motion.h - laws of a body in motion, and of one in equilibrium under loads. */
#ifndef ORACLE_MOTION_H
#define ORACLE_MOTION_H

#include "oracle_frames.h"

#define MARCH 8 /* steps                                                                                                 */

typedef struct place { /* of an obstacle: the middle of a ball, a place of a plane; and the velocity of the observer      */
    double at[3], velocity[3];
    int    dim;
} place;

static int32_t ride(void *user, double time, double *where, double *turn) {
    (void)turn;
    const place *own = (const place *)user;
    for (int d = 0; d < own->dim; ++d) where[d] = own->at[d] + time * own->velocity[d];
    return 0;
}

typedef struct march { /* a body under way                                                                               */
    scene     *s;
    peri_body *body;
    double     dt, speed, stiff; /* speed: 1/2 of spacing in a step, about, times 1/50; stiff: with obstacles             */
    double     u[3 * MOST], v[3 * MOST], size;
    int        burst; /* families that lose bonds, and P = F S that is stretched, get stiffer, at times too stiff for the forced step */
    place      ball, plane;
} march;

/* A copy of the scene's body in motion, with obstacles that ride with `velocity`. */
static void set_out(march *m, scene *s, const double *velocity, int obstacles) {
    const frame f = same_frame();
    memset(m, 0, sizeof *m);
    m->s = s;
    MUST(s->fresh, peri_body_clone(s->fresh, &m->body, NULL));
    m->dt = 0.7 * peri_stable_step(m->body);
    m->speed = 0.2 * s->rate;
    m->ball.dim = m->plane.dim = s->dim;
    placed(s, &f, s->ball, m->ball.at);
    placed(s, &f, s->plane, m->plane.at);
    for (int d = 0; velocity && d < s->dim; ++d) m->ball.velocity[d] = m->plane.velocity[d] = velocity[d];
    if (obstacles && s->has_ball)
        MUST(m->body, ball_obstacle(m->body, m->ball.at, s->ball_radius * s->spacing, 0, ride, &m->ball));
    if (obstacles && s->has_plane)
        MUST(m->body, plane_obstacle(m->body, m->plane.at, s->plane_normal, 0, ride, &m->plane));
    m->dt = fmin(m->dt, 0.7 * peri_stable_step(m->body));
    m->stiff = stiffness(m->body);
    for (int64_t k = 0; k < s->dofs; ++k) m->v[k] = m->speed * s->v[k] + (velocity ? velocity[k % s->dim] : 0);
    put(m->body, PERI_FIELD_VELOCITY, m->v);
}

static void march_on(march *m, const peri_advance_desc *r) {
    const int32_t status = peri_advance(m->body, r);
    CHECK(status == PERI_OK || (status == PERI_ERROR_UNSTABLE && (m->s->breakable || (m->s->gradient && !is_linear(m->s)))));
    m->burst |= status != PERI_OK;
    MUST(m->body, peri_get_field(m->body, PERI_FIELD_DISPLACEMENT, m->u, m->s->dofs));
    MUST(m->body, peri_get_field(m->body, PERI_FIELD_VELOCITY, m->v, m->s->dofs));
}

static void go_on(march *m, double damping) {
    peri_advance_desc r;
    peri_advance_desc_init(&r);
    r.integrator = m->s->integrator;
    r.steps = MARCH;
    r.time_step = m->dt;
    r.force_step = 1;
    r.damping = damping;
    march_on(m, &r);
    m->size = fmax(m->size, largest(m->u, m->s->dofs));
    m->stiff = fmax(m->stiff, stiffness(m->body));
}

static void never_break(march *m) {
    if (m->s->breakable) MUST(m->body, peri_set_no_fail(m->body, PERI_ALL, 1));
}

/* Bound of what rounding in so many steps does to displacements: of forces over their scale, and of bonds that are far from where they
   were; it grows no faster than the cube of the steps. Obstacles are up to 8 spacings deep. */
static double drift_of(const march *m, int steps, double far) {
    const scene *s = m->s;
    const double deep = s->has_ball || s->has_plane ? 8 * s->spacing : 0, size = s->size + m->size + deep;
    const double cells = 16 * (state_unit(s) * (far + s->reach) + bond_unit(s) * 2 * s->desc.horizon) * (s->gradient ? 50 : 1);
    return 20.0 * steps * steps * steps * (2 * rounding(s) * size + cells);
}

static double apart(const double *a, const double *b, double sign, int64_t n) {
    double worst = 0;
    for (int64_t k = 0; k < n; ++k)
        if (!(fabs(a[k] - sign * b[k]) <= worst)) worst = fabs(a[k] - sign * b[k]);
    return worst;
}

/* Both integrators are time-reversible: with the velocities turned round the body goes back to where it was. Nothing breaks, nothing is
   damped; obstacles rest. */
static void time_reversal(verdict *v) {
    scene *s = v->s;
    march m;
    double start[3 * MOST], back[3 * MOST];
    set_out(&m, s, NULL, 1);
    never_break(&m);
    memcpy(start, m.v, sizeof start);
    go_on(&m, 0);
    v->idle = m.burst; /* there is no way back */
    if (!m.burst) {
        for (int64_t k = 0; k < s->dofs; ++k) back[k] = -m.v[k];
        put(m.body, PERI_FIELD_VELOCITY, back);
        go_on(&m, 0);
        const double bound = drift_of(&m, 2 * MARCH, 0);
        within(v, apart(m.u, s->u, 1, s->dofs), bound, "displacements after the way back");
        within(v, apart(m.v, start, -1, s->dofs), bound * sqrt(m.stiff), "velocities after the way back");
    }
    peri_body_destroy(m.body);
}

/* An observer who moves along sees the same: bonds break alike, obstacles that ride push alike; only the drift differs. Where precision is
   single whether a bond breaks may hang on rounding. */
static void moving_observer(verdict *v) {
    scene *s = v->s;
    march rest, ride_along;
    double velocity[3] = {0, 0, 0}, far = 0, u[3 * MOST], w[3 * MOST];
    for (int d = 0; d < s->dim; ++d) velocity[d] = 0.1 * s->spacing * s->value[d] * s->rate;
    set_out(&rest, s, NULL, 1);
    set_out(&ride_along, s, velocity, 1);
    if (s->desc.precision != PERI_PRECISION_DOUBLE) never_break(&rest), never_break(&ride_along);
    go_on(&rest, 0);
    go_on(&ride_along, 0);
    for (int64_t k = 0; k < s->dofs; ++k) {
        const double way = velocity[k % s->dim] * MARCH * rest.dt;
        u[k] = rest.u[k] + way;
        w[k] = rest.v[k] + velocity[k % s->dim];
        far = fmax(far, fabs(way));
    }
    const double bound = drift_of(&rest, MARCH, far) * flatness(rest.body);
    within(v, abs(rest.burst - ride_along.burst), 0.5, "status of peri_advance");
    if (!rest.burst) {
        within(v, apart(ride_along.u, u, 1, s->dofs), bound, "displacements of a body that moves along");
        within(v, apart(ride_along.v, w, 1, s->dofs), bound * sqrt(rest.stiff), "velocities of a body that moves along");
    }
    within(v, fabs((double)(peri_broken_count(rest.body) - peri_broken_count(ride_along.body))), 0.5, "broken bonds");
    peri_body_destroy(rest.body);
    peri_body_destroy(ride_along.body);
}

/* sum m v, and sum m y x v about the first point: y where the points are, of linear geometry where they were. */
static void momenta(const march *m, double *linear, double *angular) {
    const scene *s = m->s;
    memset(linear, 0, 3 * sizeof *linear);
    memset(angular, 0, 3 * sizeof *angular);
    for (int64_t i = 0; i < s->count; ++i) {
        double y[3] = {0, 0, 0}, p[3] = {0, 0, 0};
        for (int d = 0; d < s->dim; ++d) {
            y[d] = s->x[i * s->dim + d] - s->x[d] + (is_linear(s) ? 0 : m->u[i * s->dim + d]);
            p[d] = s->rho[i] * cell_of(s, i) * m->v[i * s->dim + d];
            linear[d] += p[d];
        }
        for (int d = 0; d < 3; ++d) angular[d] += y[(d + 1) % 3] * p[(d + 2) % 3] - y[(d + 2) % 3] * p[(d + 1) % 3];
    }
}

/* Momentum and angular momentum of a free body stay, whatever breaks; mass damping takes the part (1-k)/(1+k) of momentum in each step,
   k = a dt/2; a uniform force density adds its total times the time. */
static void free_body(verdict *v) {
    scene *s = v->s;
    march m;
    double p[2][3], l[2][3], scale = 0, volume = 0, force[3];
    const int falls = s->act == ACT_BODY_FORCE && s->damping == 0;
    set_out(&m, s, NULL, 0);
    memcpy(m.u, s->u, sizeof m.u);
    momenta(&m, p[0], l[0]);
    for (int d = 0; d < s->dim; ++d) force[d] = falls ? 0.01 * s->value[d] * young_of(s) / s->spacing : 0;
    if (falls) MUST(m.body, peri_apply_body_force(m.body, PERI_ALL, force, NULL, NULL));
    const double fastest = largest(m.v, s->dofs), damping = s->damping / m.dt, k = 0.5 * damping * m.dt;
    go_on(&m, damping);
    momenta(&m, p[1], l[1]);
    for (int64_t i = 0; i < s->count; ++i) {
        const double own = s->rho[i] * m.stiff * (s->size + m.size) + (falls ? largest(force, s->dim) : 0);
        scale += cell_of(s, i) * (own * m.dt + s->rho[i] * (fastest + largest(m.v, s->dofs)));
        volume += cell_of(s, i);
    }
    v->idle = m.burst;
    const double kept = pow((1 - k) / (1 + k), MARCH), unit = roundings(s) * MARCH;
    for (int d = 0; d < 3; ++d) {
        const double given = d < s->dim ? force[d] * volume * MARCH * m.dt : 0;
        p[1][d] -= kept * p[0][d] + given;
        l[1][d] -= l[0][d];
    }
    if (!m.burst) within(v, largest(p[1], 3), unit * momentum_unit(s) * scale, "momentum");
    if (!m.burst && s->damping == 0 && !falls && is_objective(s))
        within(v, largest(l[1], 3), (unit * bond_unit(s) + 4 * MARCH * ends_of(s, 0)) * scale * (s->reach + m.size), "angular momentum");
    peri_body_destroy(m.body);
}

/* What supports, loads and obstacles give to the body now; of supports the mean of the last step. */
static void force_from_outside(const march *m, const acting *a, double *loads, double *obstacles) {
    double push[3];
    for (int d = 0; d < 3; ++d) loads[d] = obstacles[d] = 0;
    if (a->load > 0) MUST(m->body, peri_get_reaction(m->body, a->load, loads));
    for (int k = 0; k < 2; ++k) {
        const int32_t id = k ? a->plane : a->ball;
        if (!id) continue;
        MUST(m->body, peri_get_obstacle_force(m->body, id, push, NULL));
        for (int d = 0; d < m->s->dim; ++d) obstacles[d] += push[d];
    }
}

/* Each step gives the body the momentum that supports, loads and obstacles have sent into it: the mean of both ends of the step times dt,
   of supports the mean that is told. */
static void impulse(verdict *v) {
    scene *s = v->s;
    const frame f = same_frame();
    march m;
    acting a = {0, 0, 0, {{0}, 0}};
    peri_advance_desc r;
    double p[2][3], l[3], loads[2][3], obstacles[2][3];
    const int supported = s->act == ACT_DISPLACEMENT || s->act == ACT_VELOCITY;
    set_out(&m, s, NULL, 0);
    add_acts(s, m.body, &f, &a);
    memcpy(m.u, s->u, sizeof m.u);
    m.stiff = stiffness(m.body);
    peri_advance_desc_init(&r);
    r.integrator = s->integrator;
    r.steps = 1;
    r.force_step = 1;
    r.time_step = 0.7 * peri_stable_step(m.body);
    for (int step = 0; step < 3; ++step) {
        const double fast = largest(m.v, s->dofs);
        momenta(&m, p[0], l);
        force_from_outside(&m, &a, loads[0], obstacles[0]);
        march_on(&m, &r);
        if (m.burst) break;
        force_from_outside(&m, &a, loads[1], obstacles[1]);
        momenta(&m, p[1], l);
        m.stiff = fmax(m.stiff, stiffness(m.body));
        double scale = 0, off = 0;
        for (int64_t i = 0; i < s->count; ++i) {
            const double own = m.stiff * (size_of_acts_in(s, m.stiff) + largest(m.u, s->dofs)) * r.time_step;
            scale += cell_of(s, i) * s->rho[i] * (own + fast + largest(m.v, s->dofs));
        }
        for (int d = 0; d < s->dim; ++d) {
            const double load = supported ? loads[1][d] : 0.5 * (loads[0][d] + loads[1][d]);
            off = fmax(off, fabs(p[1][d] - p[0][d] - r.time_step * (load + 0.5 * (obstacles[0][d] + obstacles[1][d]))));
        }
        within(v, off, roundings(s) * momentum_unit(s) * scale, "momentum less impulse");
    }
    peri_body_destroy(m.body);
}

/* ---- equilibrium --------------------------------------------------------------------------------------------------- */

static int can_rest(const scene *s) {
    return is_linear(s) && has_stiffness(s) && s->desc.precision == PERI_PRECISION_DOUBLE && s->count < 90;
}

#define TOLERANCE 1e-10 /* of the solves: |residual| over the larger of |loads| and |reactions|                           */

static int is_held(const scene *s, int64_t k) { return k / s->dim % 5 == 0; }

static int32_t give_load(void *user, double time, int64_t count, const int32_t *points, double *value) {
    (void)time, (void)points;
    memcpy(value, ((const scene *)user)->load, (size_t)(count * ((const scene *)user)->dim) * sizeof *value);
    return 0;
}

typedef struct rest { /* an equilibrium                                                                                   */
    double load[3 * MOST], u[3 * MOST], energy, missed; /* force densities; missed: bound of |residual|                   */
    int    found;
} rest;

static double norm_of(const scene *s, const double *f, int forces) {
    double sum = 0;
    for (int64_t k = 0; k < s->dofs; ++k) sum += pow(f[k] * (forces ? cell_of(s, k / s->dim) : 1), 2);
    return sqrt(sum);
}

/* Parts that nothing holds have none. */
static void settle(scene *s, peri_body *b, rest *r) {
    peri_solve_desc d;
    peri_energy e;
    double held[3 * MOST];
    memcpy(s->load, r->load, sizeof s->load);
    const int32_t id = (int32_t)MUST(b, peri_apply_body_force(b, PERI_ALL, NULL, give_load, s));
    peri_solve_desc_init(&d);
    d.tolerance = TOLERANCE;
    d.fracture = 0;
    d.iterations = 2000;
    const int32_t status = peri_solve(b, &d, NULL);
    r->found = status == PERI_OK;
    if (!r->found) CHECK(status == PERI_ERROR_LOOSE || status == PERI_ERROR_INDEFINITE || status == PERI_ERROR_CONVERGENCE);
    MUST(b, peri_get_field(b, PERI_FIELD_DISPLACEMENT, r->u, s->dofs));
    MUST(b, peri_get_field(b, PERI_FIELD_REACTION, held, s->dofs));
    MUST(b, peri_get_energy(b, &e));
    r->energy = e.elastic;
    r->missed = TOLERANCE * fmax(norm_of(s, r->load, 1), norm_of(s, held, 1));
    MUST(b, peri_remove_load(b, id));
}

/* Equilibria under two loads and their sum, of linear geometry: Betti, f.u' = f'.u; the displacements add up, to what the residuals leave
   of K u; the energy is half the work (Clapeyron). */
static void equilibria(verdict *v) {
    scene *s = v->s;
    static rest r[3];
    const double *parts[2] = {s->p, s->q}, unit = 0.01 * young_of(s) / pow(s->spacing, 2);
    int32_t points[MOST];
    int64_t held = 0;
    peri_body *b = NULL;
    MUST(s->fresh, peri_body_clone(s->fresh, &b, NULL));
    for (int64_t i = 0; i < s->count; i += 5) points[held++] = (int32_t)i;
    const int32_t set = (int32_t)MUST(b, peri_select_points(b, NULL, held, points));
    MUST(b, peri_prescribe_displacement(b, set, all_axes(s->dim), NULL, NULL, NULL));
    for (int n = 0; n < 3; ++n) {
        for (int64_t k = 0; k < s->dofs; ++k)
            r[n].load[k] = is_held(s, k) ? 0 : n < 2 ? unit * parts[n][k] : r[0].load[k] + r[1].load[k];
        settle(s, b, &r[n]);
    }
    if (r[0].found && r[1].found && r[2].found) {
        double sum[3 * MOST], resisted[3 * MOST], missed = 0, size = 0;
        for (int n = 0; n < 3; ++n) {
            const double far = norm_of(s, r[n].u, 0);
            const double noise = 4 * rounding(s) * energy_scale(s, largest(r[n].u, s->dofs));
            within(v, fabs(r[n].energy - 0.5 * work_of(s, r[n].load, r[n].u)), r[n].missed * far + noise, "energy less half the work");
            missed += r[n].missed;
            size = fmax(size, largest(r[n].u, s->dofs));
        }
        for (int64_t k = 0; k < s->dofs; ++k) sum[k] = r[2].u[k] - r[0].u[k] - r[1].u[k];
        product(s, sum, resisted);
        for (int64_t k = 0; k < s->dofs; ++k) resisted[k] = is_held(s, k) ? 0 : resisted[k];
        const double noise = 8 * rounding(s) * energy_scale(s, size) / size;
        within(v, norm_of(s, resisted, 0), missed + noise, "loads of the sum");
        const double crossed = r[0].missed * norm_of(s, r[1].u, 0) + r[1].missed * norm_of(s, r[0].u, 0);
        within(v, fabs(work_of(s, r[0].load, r[1].u) - work_of(s, r[1].load, r[0].u)), crossed + noise * size, "f.u' - f'.u");
    }
    v->idle = !(r[0].found && r[1].found && r[2].found);
    peri_body_destroy(b);
}

#endif
