/* SPDX-License-Identifier: MIT */
/* oracle_frames.h - the same scene somewhere else: turned, mirrored, renumbered, shifted, in other units. All that it does, at rest and in
   motion, under loads, against obstacles and while bonds break, must be what the first did, seen from there. */
#ifndef ORACLE_FRAMES_H
#define ORACLE_FRAMES_H

#include "oracle_rest.h"

#define RUN_STEPS 4

/* ---- frames -------------------------------------------------------------------------------------------------------- */

/* The moment correction is fitted to weights, in mixed and single precision rounded to float: near surfaces, where factors are far from 1,
   the fit makes much of that. */
static int can_fit(const scene *s) {
    return s->desc.correction != PERI_CORRECTION_MOMENT || s->desc.precision == PERI_PRECISION_DOUBLE;
}

/* The caller's points have cubes, or squares, for cells: of partial cells only such lattices can be laid again point by point. */
static int has_cubes(const scene *s) {
    return can_fit(s) && (!is_exact(s->desc.quadrature) || (s->origin != ORIGIN_PERTURBED && s->origin != ORIGIN_LONG_CELLS));
}

/* By the rule of centroids the two ends of a bond differ in its stretch, and that of lower number decides (theory.md). */
static int can_renumber(const scene *s) {
    return has_cubes(s) && !(s->breakable && s->desc.quadrature == PERI_QUADRATURE_PARTIAL_CENTROID);
}

/* Those cubes have their edges along the axes (docs/theory.md): cells are not turned. */
static int can_turn(const scene *s) { return can_fit(s) && !is_exact(s->desc.quadrature); }

static frame turned_frame(scene *s) {
    frame f = same_frame();
    some_rotation(s->seed + 2, s->dim, f.turn);
    f.plain = 0;
    return f;
}

/* Axes in another order, and some of them turned round: reflections and quarter turns. */
static frame mirrored_frame(scene *s) {
    frame f = same_frame();
    int axis[3] = {0, 1, 2};
    for (int d = s->dim - 1; d > 0; --d) {
        const int e = below(s, d + 1), former = axis[d];
        axis[d] = axis[e];
        axis[e] = former;
    }
    for (int d = 0; d < 3; ++d)
        for (int e = 0; e < 3; ++e) f.turn[3 * d + e] = axis[d] == e ? (below(s, 2) ? 1 : -1) : 0;
    f.plain = 0;
    return f;
}

static frame renumbered_frame(scene *s) {
    frame f = same_frame();
    for (int k = (int)s->count - 1; k > 0; --k) {
        const int e = below(s, k + 1);
        const int32_t former = f.order[k];
        f.order[k] = f.order[e];
        f.order[e] = former;
    }
    f.plain = 0;
    return f;
}

static frame shifted_frame(scene *s) {
    frame f = same_frame();
    for (int d = 0; d < s->dim; ++d) f.shift[d] = s->spacing * between(s, -1000, 1000);
    return f;
}

static frame rescaled_frame(scene *s) {
    frame f = same_frame();
    f.length = ldexp(1, below(s, 41) - 20);
    f.stress = ldexp(1, below(s, 41) - 20);
    f.density = ldexp(1, below(s, 41) - 20);
    f.thickness = ldexp(1, below(s, 41) - 20);
    return f;
}

/* ---- what acts ----------------------------------------------------------------------------------------------------- */

/* Each point feels its own share: what moves as one has bonds whose stretch is all rounding, and so is then whether they break. */
typedef struct shares {
    double  of[MOST];
    int     dim;
} shares;

static int32_t share_out(void *user, double time, int64_t count, const int32_t *points, double *value) {
    const shares *own = (const shares *)user;
    (void)time;
    for (int64_t k = 0; k < count * own->dim; ++k) value[k] *= own->of[points[k / own->dim]];
    return 0;
}

static void fill_shares(const scene *s, const frame *f, shares *own) {
    uint64_t state = s->seed;
    own->dim = s->dim;
    for (int64_t i = 0; i < s->count; ++i) own->of[f->order[i]] = 0.5 + test_random(&state);
}

typedef struct acting { /* ids; of a load that was refused its status                                                     */
    int32_t load, ball, plane;
    shares  own;
} acting;

static double young_of(const scene *s) {
    double most = 0;
    for (int k = 0; k < s->materials; ++k) most = fmax(most, s->material[k].young);
    return most;
}

static int32_t part_of(const scene *s, peri_body *b, const frame *f) {
    int32_t points[MOST];
    for (int64_t i = 0; i < s->count / 3; ++i) points[i] = f->order[i];
    return (int32_t)MUST(b, peri_select_points(b, NULL, s->count / 3, points));
}

/* Loads of the order of what s->size makes; a displacement of a hundredth of a spacing, a velocity that goes as far in a run. */
static int32_t add_load(const scene *s, peri_body *b, const frame *f, shares *own) {
    const int32_t part = part_of(s, b, f), axes = all_axes(s->dim);
    const double area = 5 * pow(s->spacing * f->length, s->dim - 1), pull = 0.01 * young_of(s) * f->stress;
    const double far = 0.01 * s->spacing * f->length;
    double value[3];
    turned(f, s->dim, 1, s->value, value);
    for (int d = 0; d < s->dim; ++d)
        value[d] *= s->act == ACT_BODY_FORCE ? pull / (s->spacing * f->length)
                  : s->act == ACT_LAYER ? pull
                  : s->act == ACT_VELOCITY ? far * s->rate / time_factor(f)
                                           : far;
    switch (s->act) {
    case ACT_BODY_FORCE: return peri_apply_body_force(b, part, value, share_out, own);
    case ACT_LAYER: return peri_apply_layer_traction(b, part, area, value, NULL, NULL);
    case ACT_PRESSURE: return peri_apply_pressure(b, PERI_ALL, pull, NULL, NULL);
    case ACT_BOND_PRESSURE: return peri_apply_bond_pressure_for_comparison(b, PERI_ALL, pull, NULL, NULL);
    case ACT_DISPLACEMENT: return peri_prescribe_displacement(b, part, axes, value, share_out, own);
    case ACT_VELOCITY: return peri_prescribe_velocity(b, part, axes, value, share_out, own);
    default: return 0;
    }
}

static void add_acts(const scene *s, peri_body *b, const frame *f, acting *a) {
    double place[3], normal[3];
    const double hard = s->value[0] > 0 ? 0 : 0.3 * young_of(s) * f->stress / pow(s->spacing * f->length, 2);
    fill_shares(s, f, &a->own);
    a->load = add_load(s, b, f, &a->own);
    placed(s, f, s->ball, place);
    if (s->has_ball)
        a->ball = (int32_t)MUST(b, ball_obstacle(b, place, s->ball_radius * s->spacing * f->length, hard, NULL, NULL));
    placed(s, f, s->plane, place);
    turned(f, s->dim, 1, s->plane_normal, normal);
    if (s->has_plane) a->plane = (int32_t)MUST(b, plane_obstacle(b, place, normal, hard, NULL, NULL));
}

/* ---- two bodies ---------------------------------------------------------------------------------------------------- */

typedef struct pair {
    verdict  *v;
    scene    *s;
    frame     f;
    peri_body *body, *other;
    acting    acts, other_acts;
    double    stiff;  /* with obstacles                                                                                  */
    double    apart;  /* bound of displacements [L]                                                                      */
    double    bound;  /* of forces over their scale                                                                      */
    double    size;   /* [L] displacements, and depths within obstacles; what a load could move in 1/sqrt(stiff)         */
} pair;

static double density_of(const pair *t) {
    double most = 0;
    for (int64_t i = 0; i < t->s->count; ++i) most = fmax(most, t->s->rho[i]);
    return most;
}

/* A field of both, vectors and tensors turned back, in the units of the first, against a bound. rank: 0, 1, or 2 of tensors. */
static void field_agrees(const pair *t, int32_t field, int rank, double unit, double bound, const char *what) {
    const scene *s = t->s;
    double *a = get(t->body, field), *b = get(t->other, field), worst = 0;
    const int parts = rank == 0 ? 1 : rank == 1 ? s->dim : s->dim == 3 ? 6 : 3;
    for (int64_t i = 0; i < s->count; ++i) {
        const double *own = &a[i * parts], *other = &b[t->f.order[i] * parts];
        for (int k = 0; k < s->dim; ++k)
            for (int l = k; l < s->dim; ++l) {
                double sum = 0;
                for (int c = 0; c < s->dim; ++c)
                    for (int e = 0; rank == 2 && e < s->dim; ++e)
                        sum += t->f.turn[3 * k + c] * t->f.turn[3 * l + e] * own[packed(s->dim, c, e)];
                for (int c = 0; rank == 1 && c < s->dim; ++c) sum += t->f.turn[3 * k + c] * own[c];
                const double want = (rank == 0 ? own[0] : sum) * unit;
                const double off = fabs(want - other[rank == 0 ? 0 : rank == 1 ? k : packed(s->dim, k, l)]) / unit;
                if (!(off <= worst)) worst = off;
            }
    }
    within(t->v, worst, bound, what);
    free(a);
    free(b);
}

static void number_agrees(const pair *t, double a, double b, double unit, double bound, const char *what) {
    within(t->v, fabs(a - b / unit), bound, what);
}

/* A vector that is not a field: turned, too. */
static void vector_agrees(const pair *t, const double *a, const double *b, double unit, double bound, const char *what) {
    double want[3], worst = 0;
    turned(&t->f, t->s->dim, 1, a, want);
    for (int d = 0; d < t->s->dim; ++d)
        if (!(fabs(want[d] - b[d] / unit) <= worst)) worst = fabs(want[d] - b[d] / unit);
    within(t->v, worst, bound, what);
}

static double cell_factor(const pair *t) {
    return t->s->dim == 3 ? pow(t->f.length, 3) : t->f.length * t->f.length * t->f.thickness;
}

static double mass_of(const pair *t) {
    double sum = 0;
    for (int64_t i = 0; i < t->s->count; ++i) sum += t->s->rho[i] * cell_of(t->s, i);
    return sum;
}

static void sums_agree(const pair *t) {
    const frame *f = &t->f;
    const double energy = f->stress * cell_factor(t), mass = mass_of(t);
    const double bound = 2 * (t->bound * t->size + t->apart) * t->size * mass * t->stiff;
    double p[2][3] = {{0}};
    peri_energy a, b;
    MUST(t->body, peri_get_energy(t->body, &a));
    MUST(t->other, peri_get_energy(t->other, &b));
    number_agrees(t, a.elastic, b.elastic, energy, bound, "elastic energy");
    number_agrees(t, a.kinetic, b.kinetic, energy, bound, "kinetic energy");
    number_agrees(t, a.damping, b.damping, energy, RUN_STEPS * bound, "energy of damping");
    number_agrees(t, a.external, b.external, energy, RUN_STEPS * bound, "work of loads");
    number_agrees(t, a.obstacle, b.obstacle, energy, RUN_STEPS * bound, "work of obstacles");
    number_agrees(t, a.fracture, b.fracture, energy, RUN_STEPS * bound, "energy of fracture");
    MUST(t->body, peri_get_momentum(t->body, p[0], NULL));
    MUST(t->other, peri_get_momentum(t->other, p[1], NULL));
    const double momentum = f->density * cell_factor(t) * f->length / time_factor(f), speed = sqrt(t->stiff);
    vector_agrees(t, p[0], p[1], momentum, 2 * mass * speed * (t->apart + t->bound * t->size), "momentum");
}

/* Forces of supports, loads and obstacles. */
static void reactions_agree(const pair *t) {
    const double unit = t->f.stress / t->f.length * cell_factor(t), bound = 4 * mass_of(t) * t->stiff * (t->bound * t->size + t->apart);
    double a[3], b[3];
    if (t->acts.load > 0) {
        MUST(t->body, peri_get_reaction(t->body, t->acts.load, a));
        MUST(t->other, peri_get_reaction(t->other, t->other_acts.load, b));
        vector_agrees(t, a, b, unit, bound, "reaction");
    }
    for (int k = 0; k < 2; ++k) {
        const int32_t own = k ? t->acts.plane : t->acts.ball, other = k ? t->other_acts.plane : t->other_acts.ball;
        if (!own) continue;
        MUST(t->body, peri_get_obstacle_force(t->body, own, a, NULL));
        MUST(t->other, peri_get_obstacle_force(t->other, other, b, NULL));
        vector_agrees(t, a, b, unit, bound, "force of an obstacle");
    }
}

/* Bounds: a strain is a difference of displacements over a bond, by K^-1 of the family; stresses by the largest modulus that a material
   may have. Stresses of nonlinear geometry divide by det F, which has no bound. */
static void fields_agree(const pair *t) {
    const frame *f = &t->f;
    const scene *s = t->s;
    const double force = density_of(t) * t->stiff, off = t->bound * t->size + t->apart, strain = 2 * off / s->shortest;
    const double spanned = strain * (s->gradient ? 1 : 50);
    double modulus = 0;
    for (int k = 0; k < s->materials; ++k) {
        const double nu = isnan(s->material[k].poisson) ? bond_nu(s->desc.space) : s->material[k].poisson;
        modulus = fmax(modulus, 3 * s->material[k].young / ((1 + nu) * (1 - 2 * nu)));
    }
    field_agrees(t, PERI_FIELD_DISPLACEMENT, 1, f->length, t->apart, "displacements");
    field_agrees(t, PERI_FIELD_VELOCITY, 1, f->length / time_factor(f), t->apart * sqrt(t->stiff), "velocities");
    field_agrees(t, PERI_FIELD_FORCE_DENSITY, 1, f->stress / f->length, force * off, "forces");
    field_agrees(t, PERI_FIELD_REACTION, 1, f->stress / f->length, 4 * force * off, "reactions");
    field_agrees(t, PERI_FIELD_ENERGY_DENSITY, 0, f->stress, 2 * force * off * t->size, "energy density");
    field_agrees(t, PERI_FIELD_DILATATION, 0, 1, s->dim * (s->gradient ? spanned : strain), "dilatation");
    field_agrees(t, PERI_FIELD_STRAIN, 2, 1, spanned, "strain");
    field_agrees(t, PERI_FIELD_DAMAGE, 0, 1, 1e-6, "damage");
    field_agrees(t, PERI_FIELD_DAMAGE_GROWN, 0, 1, 1e-6, "grown damage");
    if (!is_linear(s)) return;
    field_agrees(t, PERI_FIELD_STRESS, 2, f->stress, modulus * spanned, "stress");
    field_agrees(t, PERI_FIELD_FORCE_STRESS, 2, f->stress, force * off * 2 * s->desc.horizon, "force stress");
}

static void constants_agree(const pair *t) {
    const frame *f = &t->f;
    const double third = t->s->dim == 3 ? f->length : f->thickness;
    const double all = 1e-12; /* moments by quadrature follow the spacing, which is a root */
    for (int i = 1; i <= t->s->materials; ++i)
        for (int j = 1; j <= t->s->materials; ++j) {
            double c[2] = {0, 0}, s0[2];
            const int32_t m = peri_id(t->body, PERI_KIND_MATERIAL, i), n = peri_id(t->body, PERI_KIND_MATERIAL, j);
            const int bonds = t->s->material[i - 1].law == PERI_LAW_BOND_BASED && t->s->material[j - 1].law == PERI_LAW_BOND_BASED;
            MUST(t->body, peri_get_bond_constants(t->body, m, n, bonds ? &c[0] : NULL, &s0[0]));
            MUST(t->other, peri_get_bond_constants(t->other, m, n, bonds ? &c[1] : NULL, &s0[1]));
            number_agrees(t, c[0], c[1], f->stress / pow(f->length, 3) / third, all * c[0], "micromodulus");
            if (isfinite(s0[0]) || isfinite(s0[1])) number_agrees(t, s0[0], s0[1], 1, all * s0[0], "critical stretch");
        }
}

/* ---- the laws ------------------------------------------------------------------------------------------------------ */

static double lightest(const scene *s) {
    double least = HUGE_VAL;
    for (int64_t i = 0; i < s->count; ++i) least = fmin(least, s->rho[i]);
    return least;
}

/* What the size of displacements needs to be for what acts: obstacles are up to 8 spacings deep; a pressure is a sum over families by K^-1,
   which in the bulk cancels. */
static double size_of_acts_in(const scene *s, double stiff) {
    const double pull = 0.01 * young_of(s) / (lightest(s) * stiff);
    const double pressed = s->act == ACT_PRESSURE || s->act == ACT_BOND_PRESSURE ? 400 : 4;
    return s->size + 0.02 * s->spacing + pressed * pull / s->shortest + (s->has_ball || s->has_plane ? 8 * s->spacing : 0);
}
static double size_of_acts(const pair *t) { return size_of_acts_in(t->s, t->stiff); }

/* Does it hang on rounding whether a bond breaks, or when? In single precision; and where the energy of a node decides about all its bonds
   at once: they are taken by quarters of a step, and one scene in 50,000 has a bond on the border of two. */
static int hangs_on_rounding(const scene *s) {
    int nodes = 0;
    for (int k = 0; k < s->materials; ++k) nodes |= s->material[k].criterion == PERI_CRITERION_NODE_ENERGY;
    return nodes || s->desc.precision != PERI_PRECISION_DOUBLE;
}

static void set_motion(const pair *t, peri_body *b, const frame *f) {
    const scene *s = t->s;
    double u[3 * MOST], v[3 * MOST];
    const double fast = 0.2 * s->rate * f->length / time_factor(f);
    for (int64_t i = 0; i < s->count; ++i) {
        const int64_t from = i * s->dim, to = f->order[i] * s->dim;
        turned(f, s->dim, f->length, &s->u[from], &u[to]);
        turned(f, s->dim, fast, &s->v[from], &v[to]);
    }
    put(b, PERI_FIELD_DISPLACEMENT, u);
    put(b, PERI_FIELD_VELOCITY, v);
    if (s->breakable && hangs_on_rounding(s)) MUST(b, peri_set_no_fail(b, PERI_ALL, 1));
}

/* Families that lose bonds, and P = F S that is stretched, get stiffer, at times so much that the step which is forced bursts them. */
static int32_t run_steps(const pair *t, peri_body *b, double dt) {
    peri_advance_desc r;
    peri_advance_desc_init(&r);
    r.integrator = t->s->integrator;
    r.steps = RUN_STEPS;
    r.time_step = dt;
    r.force_step = 1;
    r.damping = t->s->damping / dt;
    const int32_t status = peri_advance(b, &r);
    CHECK(status == PERI_OK || (status == PERI_ERROR_UNSTABLE && (t->s->breakable || (t->s->gradient && !is_linear(t->s)))));
    return status;
}

static void all_agree(const pair *t) {
    fields_agree(t);
    sums_agree(t);
    reactions_agree(t);
    within(t->v, fabs((double)(peri_cut_count(t->body) - peri_cut_count(t->other))), 0.5, "cut bonds");
    within(t->v, fabs((double)(peri_broken_count(t->body) - peri_broken_count(t->other))), 0.5, "broken bonds");
}

/* The moment within a step at which a bond meets its criterion is a root, as badly conditioned as the criterion is flat there: 1e6 for what
   changes by a millionth of its limit in the step. */
static double flatness(const peri_body *b) { return peri_broken_count(b) > 0 ? 1e6 : 1; }

/* Would all_agree find that something does not? */
static int disagree(const pair *t) {
    const verdict was = *t->v;
    t->v->asked = 1;
    all_agree(t);
    const int bad = t->v->bad > was.bad;
    *t->v = was;
    return bad;
}

/* The body, in its own frame, run from a start that is off by less than frames are. */
static peri_body *nudged(const pair *t, uint64_t dice, double dt) {
    const frame own = same_frame();
    peri_body *b = NULL;
    acting acts;
    MUST(t->s->fresh, peri_body_clone(t->s->fresh, &b, NULL));
    set_motion(t, b, &own);
    add_acts(t->s, b, &own, &acts);
    double *u = get(b, PERI_FIELD_DISPLACEMENT);
    for (int64_t k = 0; k < t->s->dofs; ++k) u[k] += 8 * state_unit(t->s) * t->s->size * (test_random(&dice) - 0.5);
    put(b, PERI_FIELD_DISPLACEMENT, u);
    free(u);
    (void)run_steps(t, b, dt);
    return b;
}

/* What breaks is no continuous function of the start: a bond that comes within rounding of its limit, or of the border between two parts of
   a step, breaks in one frame and not in another. So where bonds broke and frames disagree the scene itself is asked, in its one frame,
   what it makes of roundings: 0 where other bonds break, and there is nothing to compare; else displacements may be apart by as much. */
static int can_compare(pair *t, double dt) {
    double spread = 0, *u = get(t->body, PERI_FIELD_DISPLACEMENT);
    int same = 1;
    for (uint64_t draw = 1; draw <= 8 && same; ++draw) {
        peri_body *b = nudged(t, draw, dt);
        double *w = get(b, PERI_FIELD_DISPLACEMENT);
        for (int64_t k = 0; k < t->s->dofs; ++k) spread = fmax(spread, fabs(u[k] - w[k]));
        same = peri_broken_count(b) == peri_broken_count(t->body);
        free(w);
        peri_body_destroy(b);
    }
    free(u);
    t->apart = fmax(t->apart, 8 * spread);
    return same;
}

static void compare_runs(pair *t) {
    const scene *s = t->s;
    const double dt = 0.4 * peri_stable_step(t->body), unit = time_factor(&t->f);
    /* an estimate has a margin, up to 4 % (accuracy.md), and starts from one vector, which does not turn */
    number_agrees(t, peri_stable_step(t->body), peri_stable_step(t->other), unit, (4 * t->bound + 0.1) * dt, "stable step");
    t->size = size_of_acts(t);
    t->apart = 16 * state_unit(s) * s->size;
    all_agree(t);
    const int32_t status = run_steps(t, t->body, dt), other_status = run_steps(t, t->other, dt * unit);
    within(t->v, fabs((double)(status - other_status)), 0.5, "status of peri_advance");
    if (status != PERI_OK) return;
    /* errors of forces grow no faster than the cube of the steps, 8 for dt^2 stiff and two bodies; bonds that broke may have made it
       stiffer */
    double *u = get(t->body, PERI_FIELD_DISPLACEMENT);
    t->stiff = fmax(t->stiff, stiffness(t->body));
    t->size = size_of_acts(t) + largest(u, s->dofs);
    t->apart = 8 * RUN_STEPS * RUN_STEPS * RUN_STEPS * t->bound * t->size * flatness(t->body);
    free(u);
    const int64_t broken = peri_broken_count(t->body) + peri_broken_count(t->other);
    if (broken == 0 || !disagree(t) || can_compare(t, dt)) all_agree(t);
}

static void seen_from(verdict *v, const frame *f) {
    pair t;
    int32_t status = PERI_OK;
    const frame own = same_frame();
    memset(&t, 0, sizeof t);
    t.v = v;
    t.s = v->s;
    t.f = *f;
    t.other = body_in(v->s, f, &status);
    within(v, fabs((double)status), 0.5, "status of peri_build");
    if (!t.other) return;
    MUST(v->s->fresh, peri_body_clone(v->s->fresh, &t.body, NULL));
    cut_cracks(v->s, t.other, f, 0);
    set_motion(&t, t.other, f);
    cut_cracks(v->s, t.other, f, 1);
    set_motion(&t, t.body, &own);
    add_acts(v->s, t.body, &own, &t.acts);
    add_acts(v->s, t.other, f, &t.other_acts);
    const double own_refused = t.acts.load < 0 ? t.acts.load : 0, other_refused = t.other_acts.load < 0 ? t.other_acts.load : 0;
    within(v, fabs(own_refused - other_refused), 0.5, "status of a load");
    t.stiff = stiffness(t.body);
    t.bound = moving(v->s, largest(f->shift, v->s->dim));
    constants_agree(&t);
    compare_runs(&t);
    peri_body_destroy(t.body);
    peri_body_destroy(t.other);
}

static void turned_scene(verdict *v) {
    const frame f = turned_frame(v->s);
    seen_from(v, &f);
}
static void mirrored_scene(verdict *v) {
    const frame f = mirrored_frame(v->s);
    seen_from(v, &f);
}
static void renumbered_scene(verdict *v) {
    const frame f = renumbered_frame(v->s);
    seen_from(v, &f);
}
static void shifted_scene(verdict *v) {
    const frame f = shifted_frame(v->s);
    seen_from(v, &f);
}
static void rescaled_scene(verdict *v) {
    const frame f = rescaled_frame(v->s);
    seen_from(v, &f);
}

#endif
