/* SPDX-License-Identifier: MIT */
/* equilibrium.c - the equilibrium at one load factor, by Newton's method.

   Find u with r(u) = bonds(u) + loads = 0 on free dofs, u given on constrained ones. Each iteration solves K(u) d = r, with d on
   supports the way that they still have to go; then u += alpha d with alpha such that the slope r.d has fallen. All vectors of forces are
   V times densities. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

static int32_t peri__fail_step(peri__solver *s, int32_t code, const char *field, int64_t index, double value) {
    return peri__set_error(&s->failure, code, field, index, value);
}

static double peri__solve_tolerance(const peri__solver *s) {
    const double fit = s->body->f32 ? 1e-4 : s->body->b32 ? 1e-5 : 1e-8;
    const double tolerance = s->settings->tolerance > 0.0 ? s->settings->tolerance : fit;
    return tolerance > s->rough ? tolerance : s->rough;
}

static int32_t peri__take_solver(peri__solver *s) {
    peri_body *b = s->body;
    const peri__model *m = b->model;
    int ok = 1;
    void **vectors[] = { &s->k.d, &s->k.r, &s->k.p, &s->k.q, &s->k.z };
    for (size_t k = 0; k < sizeof vectors / sizeof *vectors; ++k) ok = ok && (*vectors[k] = peri__take_vector(s)) != NULL;
    const int controlled = s->settings->control == PERI_CONTROL_FRACTURE;
    if (!peri__is_linear(b) || s->settings->steps > 1 || controlled) ok = ok && (s->before = peri__take_vector(s)) != NULL;
    if (controlled) ok = ok && (s->rate = peri__take_vector(s)) != NULL;
    if (b->desc.ledger) {
        s->from = peri__take_vector(s);
        s->load = peri__take_vector(s);
        ok = ok && s->from && s->load;
    }
    if (peri__moduli_reals(m) > 0) ok = ok && (s->t.moduli = (double *)peri__take(s, peri__moduli_reals(m), sizeof(double))) != NULL;
    if (!m->pairwise) ok = ok && (s->t.change = peri__take(s, peri__response_reals(m), peri__bond_real(b))) != NULL;
    s->blocks = peri__take_kept(s) ? s->kept->blocks : peri__take(s, PERI_PACKED(m->dim) * m->stride, peri__real(b));
    s->constrained = (uint8_t *)peri__take(s, m->points, 1);
    s->part_of = (int32_t *)peri__take(s, m->points, sizeof *s->part_of);
    s->queue = (int32_t *)peri__take(s, m->points, sizeof *s->queue);
    s->k.model = b->model;
    s->k.constrained = s->constrained;
    return ok && s->blocks && s->constrained && s->part_of && s->queue ? PERI_OK : peri__fail(b, PERI_ERROR_MEMORY, "peri_solve", -1, 0.0);
}

/* ---- forces ------------------------------------------------------------------------------------------------------- */

/* What eigenstrain does to the body at rest, as a load: a measure of residuals, where nothing else acts. p and q are used up. */
static void peri__note_strained(peri__solver *s) {
    peri_body *b = s->body;
    const peri__model *m = b->model;
    peri__operands operands = peri__operands_of(b);
    double square = 0.0;
    s->strained = 0.0;
    if (!b->eigenstrain) return;
    memset(s->k.p, 0, peri__vector_bytes(b));
    memset(s->k.q, 0, peri__vector_bytes(b));
    operands.u = s->k.p;
    operands.f = s->k.q;
    operands.node = NULL;
    peri__sum_bonds(b, &operands, NULL);
    for (int32_t d = 0; d < m->dim; ++d)
        for (int64_t i = 0; i < m->points; ++i)
            square += s->constrained[i] >> d & 1 ? 0.0 : peri__square(m->volume[i] * peri__get_real(s->k.q, b->f32, d * m->stride + i));
    s->strained = sqrt(square);
}

/* Sets f and r = V f at the present displacements; the loads alone to z. Returns |loads| of what is free, < 0: a status. */
static double peri__static_forces(peri__solver *s) {
    peri_body *b = s->body;
    const peri__model *m = b->model;
    peri__operands operands = peri__operands_of(b);
    double square = 0.0;
    memset(b->f, 0, peri__vector_bytes(b));
    int32_t status = peri__apply_loads(b, peri__load_time(b), 0.0);
    if (status == PERI_OK) status = peri__apply_obstacles(b, peri__load_time(b), 0.0);
    if (status < 0) return status;
    peri__add_inertia(s, -1.0, b->u, s->place, b->f);
    memcpy(s->k.z, b->f, peri__vector_bytes(b));
    for (int32_t d = 0; d < m->dim; ++d)
        for (int64_t i = 0; i < m->points; ++i)
            if (!(s->constrained[i] >> d & 1)) square += peri__square(m->volume[i] * peri__get_real(b->f, b->f32, d * m->stride + i));
    operands.step = s->t.step;
    operands.past.moduli = s->t.moduli;
    peri__bond_forces(b, &operands);
    status = peri__heed_laws(b);
    if (status == PERI_OK) status = peri__touch_now(b);
    if (status < 0) return status;
    s->report.passes++;
    for (int32_t d = 0; d < m->dim; ++d)
        for (int64_t i = 0; i < m->points; ++i) {
            int64_t at = d * m->stride + i;
            peri__put_real(s->k.r, b->f32, at, m->volume[i] * peri__get_real(b->f, b->f32, at));
        }
    if (b->desc.geometry != PERI_GEOMETRY_LINEAR) peri__weigh_modes(s);
    peri__balance(s, s->k.r, 1);
    peri__drop_singular(s, s->k.r);
    return sqrt(square + peri__square(s->strained));
}

/* |r| of what is free, with the scale brought up to date. */
static double peri__static_residual(peri__solver *s, double loads) {
    return peri__measure(s, peri__krylov_pass(s, &s->k, s->body->ops->krylov_norm), loads);
}

/* The rounding of forces: the diagonal of K times that of the displacements, as they are and as supports will make them; the largest of
   this equilibrium. */
static void peri__note_floor(peri__solver *s) {
    const peri_body *b = s->body;
    const peri__model *m = b->model;
    const int inverted = s->settings->method != PERI_METHOD_RELAXATION;
    double square = 0.0, rounding;
    for (int64_t i = 0; i < m->points; ++i) {
        double moved = 0.0, trace = 0.0, stiff = s->stiff;
        int frees = 0;
        for (int32_t d = 0; d < m->dim; ++d) {
            moved += peri__square(fabs(peri__get_real(b->u, b->f32, d * m->stride + i)) + s->widest);
            trace += inverted ? peri__get_real(s->blocks, b->f32, d * m->stride + i) : 0.0;
            frees += !(s->constrained[i] >> d & 1);
        }
        if (frees == 0) continue;
        if (trace > 0.0) stiff = frees / trace;
        square += stiff * stiff * moved;
    }
    rounding = peri__rounding(b) * sqrt(square);
    if (rounding > s->floor) s->floor = rounding;
}

/* Are the loads, and the ways that supports have to go (widest), so small that nothing is left of them beside PERI_NOTHING, where no more
   acts (in z) and the body is displaced by no more? Their equilibrium cannot be told from rest. */
static int32_t peri__check_small_loads(peri__solver *s) {
    peri_body *b = s->body;
    const peri__model *m = b->model;
    const double limit = PERI_NOTHING(b) / fmax(peri__solve_tolerance(s), peri__rounding(b));
    double asked = s->widest, others = 0.0;
    for (int64_t l = 0; l < b->load_count; ++l) { /* as double has them: single precision may hold nothing of them */
        const peri__load *load = &b->loads[l];
        for (int64_t k = 0; load->kind == PERI__FORCE && k < load->count; ++k)
            for (int32_t d = 0; d < m->dim; ++d)
                asked = fmax(asked, m->volume[peri__set_point(b, load->set, k)] * fabs(peri__load_force(b, load, k, d)));
    }
    for (int32_t d = 0; d < m->dim; ++d)
        for (int64_t i = 0; i < m->points; ++i) {
            const int64_t at = d * m->stride + i;
            others = fmax(others, fmax(m->volume[i] * fabs(peri__get_real(s->k.z, b->f32, at)), fabs(peri__get_real(b->u, b->f32, at))));
        }
    return asked > 0.0 && asked < limit && others < limit ? peri__fail(b, PERI_ERROR_RANGE, "value", -1, asked) : PERI_OK;
}

static int peri__is_settled(peri__solver *s, double residual, double loads) {
    if (residual <= peri__solve_tolerance(s) * s->scale) return 1;
    if (!(residual < HUGE_VAL) || !peri__is_nothing(s, residual, loads)) return 0;
    s->report.residual = 0.0; /* rounding over rounding tells nothing */
    return 1;
}

static void peri__tell_residual(peri__solver *s, double residual) {
    s->report.residual = !(residual < HUGE_VAL) ? HUGE_VAL : s->scale > 0.0 ? residual / s->scale : 0.0;
}

/* ---- supports ----------------------------------------------------------------------------------------------------- */

static void peri__mark_supports(peri__solver *s) {
    const peri_body *b = s->body;
    memset(s->constrained, 0, (size_t)b->model->points);
    for (int64_t l = 0; l < b->load_count; ++l) {
        const peri__load *load = &b->loads[l];
        int acts = load->fn != NULL;
        for (int32_t d = 0; d < b->dim; ++d) acts = acts || load->constant[d] != 0.0;
        acts = acts && load->kind == PERI__FORCE;
        for (int64_t k = 0; load->owned && k < load->count; ++k) s->constrained[peri__set_point(b, load->set, k)] |= load->owned[k];
        for (int64_t k = 0; acts && k < load->count; ++k) s->constrained[peri__set_point(b, load->set, k)] |= PERI_LOADED;
    }
}

/* Inertia holds every part. */
static int32_t peri__hold_all(peri__solver *s) {
    for (int64_t i = 0; i < s->body->model->points; ++i) s->part_of[i] = PERI_HELD;
    s->part_count = 0;
    return PERI_OK;
}

/* Returns the mean of what it adds. */
static double peri__add_inertia_blocks(const peri__solver *s) {
    const peri_body *b = s->body;
    const peri__model *m = b->model;
    double sum = 0.0;
    for (int64_t i = 0; i < m->points; ++i) {
        const double spring = peri__mass(b, i) * s->inertia;
        for (int32_t d = 0; d < m->dim; ++d)
            peri__put_real(s->blocks, b->f32, d * m->stride + i, peri__get_real(s->blocks, b->f32, d * m->stride + i) + spring);
        sum += spring;
    }
    return sum / (double)m->points;
}

/* Marks what supports hold, then what else must not move, and makes the preconditioner for the body as it is; its levels only where `anew`,
   or where bonds that broke since have cost more iterations than the levels do. */
static int32_t peri__prepare(peri__solver *s, int anew) {
    peri_body *b = s->body;
    peri__mark_supports(s);
    (void)peri__ensure(b, PERI__STALE_MASKS | PERI__STALE_CONSTANTS);
    const int same = peri__is_as_kept(s);
    if (same && s->kept->ready) return peri__recall(s);
    if (((anew && !same) || s->lost > PERI_LEVELS_WORTH) && s->levels) {
        s->bytes -= s->levels->bytes;
        peri__free_levels(s->levels);
        s->levels = NULL;
        if (s->kept) s->kept->levels = NULL;
    }
    peri__note_bytes(s);
    s->singular = 0;
    int32_t status = s->inertia > 0.0 ? peri__hold_all(s) : peri__find_floating_parts(s);
    if (status < 0) return status;
    s->stiff = peri__fill_diagonal(b, s->blocks);
    if (s->inertia > 0.0) s->stiff += peri__add_inertia_blocks(s);
    if (s->settings->method == PERI_METHOD_RELAXATION) {
        peri__weigh_modes(s);
        return PERI_OK;
    }
    if (!s->levels && s->settings->preconditioner == PERI_PRECONDITIONER_MULTILEVEL && s->settings->method == PERI_METHOD_NEWTON) {
        s->levels = peri__build_levels(s);
        if (!s->levels) return peri__fail(b, PERI_ERROR_MEMORY, "peri_solve", -1, 0.0);
        s->bytes += s->levels->bytes;
        s->pace = s->lost = 0.0;
        if (s->kept) s->kept->levels = s->levels;
    }
    peri__note_bytes(s);
    status = peri__invert_blocks(s);
    if (status == PERI_OK) peri__weigh_modes(s);
    return status == PERI_OK ? peri__keep_solver(s) : status;
}

/* d = the way that constrained components still have to go to what their supports prescribe, 0 elsewhere. Returns 1 where there is any. */
static int peri__gap(peri__solver *s) {
    peri_body *b = s->body;
    const peri__model *m = b->model;
    int gap = 0;
    s->widest = 0.0;
    memset(s->k.d, 0, peri__vector_bytes(b));
    for (int64_t l = 0; l < b->load_count; ++l) {
        const peri__load *load = &b->loads[l];
        if (load->kind != PERI__DISPLACEMENT) continue;
        for (int64_t k = 0; k < load->count; ++k)
            for (int32_t d = 0; d < m->dim; ++d) {
                int64_t at = peri__dof(b, load, k, d);
                double now = peri__get_real(b->u, b->f32, at), way = peri__load_value(b, load, k, d) / m->length - now;
                if (!(load->owned[k] >> d & 1) || !(fabs(way) > (b->f32 ? 2e-7 : 1e-15) * fabs(now))) continue;
                peri__put_real(s->k.d, b->f32, at, way);
                if (fabs(way) > s->widest) s->widest = fabs(way);
                gap = 1;
            }
    }
    return gap;
}

/* Does d lead further than 1e15 spacings, or is it not finite? The body would not come back from there. */
static int peri__is_far(const peri__solver *s) {
    const peri_body *b = s->body;
    const peri__model *m = b->model;
    for (int32_t d = 0; d < m->dim; ++d)
        for (int64_t i = 0; i < m->points; ++i)
            if (!(fabs(peri__get_real(s->k.d, b->f32, d * m->stride + i)) < 1e15)) return 1;
    return 0;
}

static void peri__move(peri__solver *s, double alpha) {
    peri_body *b = s->body;
    const peri__model *m = b->model;
    for (int32_t d = 0; d < m->dim; ++d)
        for (int64_t i = 0; i < m->points; ++i) {
            int64_t at = d * m->stride + i;
            peri__put_real(b->u, b->f32, at, peri__get_real(b->u, b->f32, at) + alpha * peri__get_real(s->k.d, b->f32, at));
        }
}

/* ---- Newton's method ---------------------------------------------------------------------------------------------- */

static int peri__at_rest(const peri_body *b) {
    const peri__model *m = b->model;
    for (int32_t d = 0; d < m->dim; ++d)
        for (int64_t i = 0; i < m->points; ++i)
            if (peri__get_real(b->u, b->f32, d * m->stride + i) != 0.0) return 0;
    return 1;
}

/* The point that the last direction moves most. */
static int64_t peri__most_moved(const peri__solver *s) {
    const peri_body *b = s->body;
    const peri__model *m = b->model;
    double most = 0.0;
    int64_t at = 0;
    for (int32_t d = 0; d < m->dim; ++d)
        for (int64_t i = 0; i < m->points; ++i) {
            double moved = fabs(peri__get_real(s->k.p, b->f32, d * m->stride + i));
            if (moved > most) at = i;
            if (moved > most) most = moved;
        }
    return at;
}

static double peri__slope(peri__solver *s) {
    peri__krylov way = s->k;
    way.z = s->k.d;
    return peri__krylov_pass(s, &way, s->body->ops->krylov_dot).a;
}

/* Moves along d until the slope r.d has fallen to less than 0.8 of what it was. Returns |loads| there, < 0: a status. */
static double peri__search_line(peri__solver *s) {
    double start = s->slope, alpha = 1.0, low = 0.0, high = 0.0, moved = 0.0, loads = 0.0;
    for (int k = 0; k < 25; ++k) {
        peri__move(s, alpha - moved);
        moved = alpha;
        loads = peri__static_forces(s);
        if (loads < 0.0) return loads;
        double slope = peri__slope(s);
        if (fabs(slope) <= 0.8 * fabs(start)) break;
        if (slope > 0.0 && high == 0.0 && k < 8) { /* still downhill: further */
            low = alpha;
            alpha *= 2.0;
            continue;
        }
        if (slope > 0.0) low = alpha;
        else high = alpha; /* past the bottom, or not finite */
        if (high == 0.0) break;
        alpha = 0.5 * (low + high);
    }
    return loads;
}

/* How far the next linear solve is worth going, of the scale: all the way where the problem is linear, else as far as the tangent tells. */
static double peri__newton_reach(const peri__solver *s, double residual, int gap) {
    double tolerance = 0.5 * peri__solve_tolerance(s), share = s->scale > 0.0 ? residual / s->scale : 1.0, reach = tolerance;
    if (peri__is_linear(s->body)) return tolerance;
    if (gap) reach = 1e-3;
    else reach = share > 0.1 ? 0.1 * (share < 1.0 ? share : 1.0) : share * share;
    return reach > tolerance ? reach : tolerance;
}

/* Takes what supports move out of r: d holds it. */
static void peri__lift(peri__solver *s, int at_rest) {
    peri_body *b = s->body;
    double square;
    memcpy(s->k.p, s->k.d, peri__vector_bytes(b));
    (void)peri__stiffness_times(s, at_rest, &square);
    peri__krylov whole = s->k;
    whole.alpha = 1.0;
    whole.d = s->k.z; /* only r is wanted */
    (void)peri__krylov_pass(s, &whole, b->ops->krylov_step);
}

/* The pace of a linear solve that began at `iterations` and was to lessen the residual by `folds` powers of e, with what its levels lose by
   now. */
static void peri__note_pace(peri__solver *s, int64_t iterations, double folds) {
    const double taken = (double)(s->report.iterations - iterations);
    if (!s->levels || !(folds > 1.0)) return;
    if (s->pace == 0.0) s->pace = taken / folds;
    else s->lost = fmax(0.0, s->lost + taken - s->pace * folds);
}

/* Finds the equilibrium at the present load factor. */
static int32_t peri__newton(peri__solver *s) {
    peri_body *b = s->body;
    const int linear = peri__is_linear(b);
    (void)peri__gap(s);
    double last = HUGE_VAL, loads = peri__static_forces(s);
    int32_t too_small = loads < 0.0 ? (int32_t)loads : peri__check_small_loads(s);
    if (too_small < 0) return too_small;
    s->negative = s->energy_done = 0;
    s->floor = peri__rounding(b) * s->top;
    for (int64_t k = 0;; ++k) {
        int32_t status;
        if (loads < 0.0) return (int32_t)loads;
        double residual = peri__static_residual(s, loads), told = s->report.residual;
        const int special = b->model->law_of || b->model->inelastic; /* the force at rest is not that of the elastic body */
        int gap = peri__gap(s), at_rest = b->desc.geometry != PERI_GEOMETRY_LINEAR && !special && peri__at_rest(b);
        peri__tell_residual(s, residual);
        peri__note_floor(s);
        if (!gap && (peri__is_settled(s, residual, loads) || s->energy_done))
            return s->negative && !b->model->law_of ? peri__fail_step(s, PERI_ERROR_INDEFINITE, "peri_solve", -1, 0.0) : PERI_OK;
        if (!(residual < HUGE_VAL) && k > 0) { /* the last way led out of all numbers: back */
            memcpy(b->u, s->k.p, peri__vector_bytes(b));
            s->report.residual = told;
        }
        if (!(residual < HUGE_VAL) || k == s->settings->newton || s->left <= 0 || (linear && k > 3 && residual > 0.5 * last))
            return peri__fail_step(s, PERI_ERROR_CONVERGENCE, linear && k > 3 ? "tolerance" : "iterations", -1, s->report.residual);
        status = peri__choose_contacts(s);
        if (status < 0) return status;
        s->secants = gap && b->model->law_of; /* supports take along all of the way at once */
        if (gap) peri__lift(s, at_rest);
        if (s->bridged) peri__add_springs(s, 1.0, NULL, 1, s->k.r); /* to where what does not touch yet would be held */
        double reach = peri__newton_reach(s, residual, gap || s->bridged);
        last = residual;
        s->report.newton++;
        const int64_t iterations = s->report.iterations;
        s->negative = s->energy_done = 0;
        if (s->settings->method == PERI_METHOD_BICGSTAB) status = peri__solve_assembled(s, reach, loads);
        else status = peri__conjugate(s, reach, loads, at_rest);
        peri__note_pace(s, iterations, log(residual / (reach * s->scale)));
        s->negative = status == PERI_ERROR_INDEFINITE;
        if (status == PERI_ERROR_MEMORY || status == PERI_ERROR_CALLBACK) return status;
        if (status == PERI_ERROR_LOOSE || (linear && s->negative))
            return peri__fail_step(s, status, "peri_solve", peri__most_moved(s), 0.0);
        if (peri__is_far(s)) return peri__fail_step(s, PERI_ERROR_CONVERGENCE, "PERI_FIELD_DISPLACEMENT", -1, s->report.residual);
        memcpy(s->k.p, b->u, peri__vector_bytes(b));
        if (linear || gap || s->bridged) {
            if (linear || status != PERI_STOPPED) peri__move(s, 1.0);
            if (status != PERI_STOPPED) loads = peri__static_forces(s);
        } else if (status != PERI_STOPPED)
            loads = peri__search_line(s);
        if (status == PERI_STOPPED) return status;
    }
}
