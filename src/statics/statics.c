/* SPDX-License-Identifier: MIT */
/* statics.c - load steps and quasi-static fracture: equilibrium at a load factor, bonds over their limit broken, equilibrium again, until
   none is; then the next load factor. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_COOKIE_STATICS (UINT64_C(0x7065726900040000) + sizeof(peri_solve_desc))

PERI_API void peri_solve_desc_init(peri_solve_desc *st) {
    if (!st) return;
    memset(st, 0, sizeof *st);
    st->cookie = PERI_COOKIE_STATICS;
    st->method = PERI_METHOD_NEWTON;
    st->preconditioner = PERI_PRECONDITIONER_MULTILEVEL;
    st->loose = PERI_LOOSE_REFUSED;
    st->fracture = 1;
    st->iterations = 20000;
    st->newton = 60;
    st->breaks = 100000;
    st->load_to = 1.0;
    st->steps = 1;
    st->halvings = 8;
    st->load_from = (double)NAN;
}

static int32_t peri__check_statics(peri_body *b, const peri_solve_desc *st) {
    PERI_NEED(b, st, "desc");
    if (st->cookie != PERI_COOKIE_STATICS) return peri__fail(b, PERI_ERROR_DESCRIPTOR, "desc", -1, 0.0);
    PERI_NEED_CHOICE(b, method, st->method);
    PERI_NEED_CHOICE(b, preconditioner, st->preconditioner);
    PERI_NEED_CHOICE(b, loose, st->loose);
    PERI_NEED_FLAG(b, st->fracture);
    PERI_NEED_NUMBER(b, st->criticality >= 0.0 && st->criticality <= 1.0, st->criticality);
    PERI_NEED_NUMBER(b, st->tolerance >= 0.0 && st->tolerance < 1.0, st->tolerance);
    PERI_NEED_NUMBER(b, st->energy_tolerance >= 0.0 && st->energy_tolerance < 1.0, st->energy_tolerance);
    if (!peri__is_nan(st->load_from)) PERI_NEED_NUMBER(b, 1, st->load_from);
    PERI_NEED_NUMBER(b, 1, st->load_to);
    PERI_NEED(b, st->iterations > 0, "iterations");
    PERI_NEED(b, st->newton > 0, "newton");
    PERI_NEED(b, st->breaks >= 0, "breaks");
    PERI_NEED(b, st->steps > 0, "steps");
    PERI_NEED(b, st->halvings >= 0 && st->halvings <= 60, "halvings");
    PERI_NEED(b, st->curve_rows >= 0 && (st->curve || st->curve_rows == 0), "curve");
    if (st->curve_load != 0 || st->curve_rows > 0) {
        const int64_t curve = peri__find(b, PERI_KIND_LOAD, st->curve_load, "curve_load");
        if (curve < 0) return (int32_t)curve;
    }
    if (b->model->centroid) return peri__fail(b, PERI_ERROR_LAW, "quadrature", -1, b->desc.quadrature);
    if (b->contact && st->method == PERI_METHOD_BICGSTAB) return peri__fail(b, PERI_ERROR_LAW, "method", -1, st->method);
    return PERI_OK;
}

/* ---- fracture ----------------------------------------------------------------------------------------------------- */

#define PERI_CRITERION_ROLE_EXCESS
#include "../laws/criteria.inl"
#undef PERI_CRITERION_ROLE_EXCESS

/* By how much the criterion of bond k of row i is passed: its value over its limit, 0 where it is not longer than at rest. */
static double peri__excess(const peri_body *b, const peri__row *row, int64_t i, int64_t k) {
    const int64_t j = row->ids[k];
    const peri__pair *pair = b->point_class ? &b->pairs[b->point_class[i] * b->classes + b->point_class[j]] : b->pairs;
    double excess = 0.0;
    if (!(peri__stretch(b, i, row, k) > 0.0)) return 0.0;
#define PERI_CASE(name, number)                                                                                        \
    if (pair->limit[(number) - peri__first_criterion] < PERI_NEVER)                                                    \
        excess = fmax(excess, peri__excess_##name(b, i, row, k, pair->limit[(number) - peri__first_criterion]));
    PERI_CRITERION_LIST(PERI_CASE)
#undef PERI_CASE
    return excess;
}

/* sums->a: the largest excess, of bonds with j > i. Both directions of a bond are decided by the row of its lower id. */
static void peri__excess_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri_body *b = (const peri_body *)context;
    for (int64_t i = begin; i < end; ++i) {
        peri__row row;
        peri__read_row(b, i, &row);
        for (int64_t k = 0; k < row.count; ++k)
            if (row.ids[k] > i && peri__is_alive(b, i, k)) sums->a = fmax(sums->a, peri__excess(b, &row, i, k));
    }
}

static int peri__may_break(const peri__solver *s) {
    return s->body->alive && s->body->model->breakable && s->settings->fracture;
}

/* Breaks the bonds over their limit; returns their number. The ledger is up to peri__static_step. */
static int64_t peri__break_static(peri__solver *s) {
    peri_body *b = s->body;
    const peri__model *m = b->model;
    double most = 0.0, limit = 1.0;
    int64_t count = 0;
    peri__for_points(b, m->points, 2 * m->width, peri__excess_block, b, b->sums);
    for (int64_t k = 0; k < m->blocks; ++k) most = fmax(most, b->sums[k].a);
    if (!(most > 1.0)) return 0;
    if (s->settings->criticality * most * (1.0 - 1e-6) > limit) limit = s->settings->criticality * most * (1.0 - 1e-6);
    if (b->before) memcpy(b->before, b->alive, (size_t)(m->points * m->words) * sizeof *b->alive);
    for (int64_t i = 0; i < m->points; ++i) {
        peri__row row;
        peri__read_row(b, i, &row);
        for (int64_t k = 0; k < row.count; ++k) {
            int64_t j = row.ids[k], back;
            if (j < i || !peri__is_alive(b, i, k)) continue;
            double excess = peri__excess(b, &row, i, k);
            if (!(excess > 1.0 && excess >= limit)) continue;
            back = peri__find_bond(m, j, i);
            b->alive[i * m->words + k / 32] &= ~((uint32_t)1 << (k % 32));
            b->alive[j * m->words + back / 32] &= ~((uint32_t)1 << (back % 32));
            count++;
        }
    }
    b->now.broken += 2 * count;
    s->report.broken += count;
    peri__changed(b, PERI__BONDS);
    peri__note_breaks(b, peri__load_time(b));
    if (b->before) peri__report_breaks(b);
    return count;
}

/* ---- the ledger --------------------------------------------------------------------------------------------------- */

/* The force density of loads and supports at this equilibrium, to `load`; with the one before and the way since then, their work. */
static void peri__count_work(peri__solver *s, const void *from) {
    peri_body *b = s->body;
    const peri__model *m = b->model;
    double work = 0.0;
    for (int32_t d = 0; s->load && d < m->dim; ++d)
        for (int64_t i = 0; i < m->points; ++i) {
            int64_t at = d * m->stride + i;
            double outer = peri__get_real(s->k.z, b->f32, at), way;
            if (s->constrained[i] >> d & 1) outer -= peri__get_real(b->f, b->f32, at);
            way = from ? peri__get_real(b->u, b->f32, at) - peri__get_real(from, b->f32, at) : 0.0;
            work += 0.5 * (outer + peri__get_real(s->load, b->f32, at)) * way * m->volume[i];
            peri__put_real(s->load, b->f32, at, outer);
        }
    b->now.ledger.external += work;
}

static double peri__static_energy(peri_body *b) {
    if (!b->desc.ledger) return 0.0;
    if (b->contact) (void)peri__ready_contact(b);
    return peri__elastic_energy(b, NULL) + peri__contact_energy(b);
}

/* ---- load steps --------------------------------------------------------------------------------------------------- */

static int32_t peri__static_values(peri_body *b) {
    for (int64_t l = 0; l < b->load_count; ++l)
        if (b->loads[l].kind == PERI__DISPLACEMENT) {
            int32_t status = peri__refresh_load(b, &b->loads[l], b->now.load_factor);
            if (status < 0) return status;
        }
    return PERI_OK;
}

/* What loads and supports do to the body as it stands, for the ledger. */
static int32_t peri__note_forces(peri__solver *s) {
    peri_body *b = s->body;
    int32_t status = peri__static_values(b);
    if (status < 0) return status;
    memset(s->constrained, 0, (size_t)b->model->points);
    s->part_count = s->singular = 0;
    (void)peri__ensure(b, PERI__STALE_MASKS | PERI__STALE_CONSTANTS);
    double loads = peri__static_forces(s);
    if (loads < 0.0) return (int32_t)loads;
    peri__mark_supports(s);
    peri__count_work(s, NULL);
    return PERI_OK;
}

/* Takes the velocities, once: not before the first solve is known to be possible. */
static void peri__stand_still(peri__solver *s) {
    peri_body *b = s->body;
    if (s->begun) return;
    s->begun = 1;
    b->now.loaded = 1;
    if (b->desc.ledger) b->now.ledger.damping += peri__kinetic_energy(b);
    memset(b->v, 0, peri__vector_bytes(b));
}

/* Equilibrium at a load factor, with all that breaks there. */
static int32_t peri__static_step(peri__solver *s, double factor) {
    peri_body *b = s->body;
    const peri__model *m = b->model;
    b->now.load_factor = factor;
    peri__changed(b, PERI__ACTION);
    int32_t status = peri__static_values(b);
    if (status == PERI_OK) status = peri__move_obstacles(b, factor);
    double broken = s->disturbed ? peri__static_energy(b) : 0.0; /* elastic energy after bonds broke, or on_step changed the body */
    for (int64_t round = 0; status == PERI_OK; ++round) {
        status = peri__prepare(s, round == 0);
        if (status == PERI_OK) peri__stand_still(s);
        s->left = s->settings->iterations;
        s->energy0 = 0.0;
        if (s->from) memcpy(s->from, b->u, peri__vector_bytes(b));
        if (status == PERI_OK) status = s->settings->method == PERI_METHOD_RELAXATION ? peri__relax(s) : peri__newton(s);
        if (status != PERI_OK) break;
        if (m->seen_by & PERI__BY_WORK) {
            peri__operands operands = peri__operands_of(b);
            operands.working = 1;
            memcpy(b->f, s->k.z, peri__vector_bytes(b));
            peri__bond_forces(b, &operands);
        }
        double external = b->now.ledger.external, energy = 0.0;
        peri__count_work(s, s->from);
        if (peri__may_break(s) || s->disturbed) energy = peri__static_energy(b);
        if (round > 0 || s->disturbed) b->now.ledger.damping += b->now.ledger.external - external - (energy - broken);
        s->disturbed = 0;
        if (!peri__may_break(s) || peri__break_static(s) == 0) break;
        broken = peri__static_energy(b);
        b->now.ledger.fracture += energy - broken;
        if (round >= s->settings->breaks) status = peri__fail_step(s, PERI_ERROR_CONVERGENCE, "breaks", -1, (double)s->report.broken);
    }
    return status;
}

static int32_t peri__record(peri__solver *s) {
    peri_body *b = s->body;
    const peri_solve_desc *st = s->settings;
    const int32_t dim = b->dim;
    double force[3];
    const int64_t curve = PERI_ID_INDEX(st->curve_load) - 1;
    if (st->curve_load == 0 || b->loads[curve].kind == PERI__FREE) return PERI_OK;
    int32_t status = peri__read_reaction_of(b, curve, force);
    if (status < 0) return status;
    if (s->report.curve_rows < st->curve_rows) {
        double *row = &st->curve[s->report.curve_rows * (2 + 2 * dim)];
        const peri__load *load = &b->loads[curve];
        row[0] = b->now.load_factor;
        for (int32_t d = 0; d < dim; ++d) {
            row[1 + d] = 0.0;
            for (int64_t k = 0; k < load->count; ++k) row[1 + d] += peri__get_real(b->u, b->f32, peri__dof(b, load, k, d));
            row[1 + d] *= b->model->length / (double)load->count;
            row[1 + dim + d] = force[d];
        }
        row[1 + 2 * dim] = (double)(b->now.broken / 2);
    }
    s->report.curve_rows++;
    return PERI_OK;
}

/* Reactions, the record and the callback at an equilibrium. */
static int32_t peri__show_step(peri__solver *s) {
    peri_body *b = s->body;
    b->now.steps++;
    s->report.steps++;
    s->report.load_factor = b->now.load_factor;
    if (s->from) memcpy(s->from, b->u, peri__vector_bytes(b)); /* the way here has been accounted for */
    for (int64_t l = 0; l < b->load_count; ++l) b->loads[l].stepped = 0;
    int32_t status = peri__meet_supports(b);
    if (status == PERI_OK) b->now.stale &= ~(uint32_t)(PERI__STALE_FORCE | PERI__STALE_BALANCE); /* f is that of the equilibrium */
    if (status == PERI_OK) status = peri__record(s);
    if (status == PERI_OK && b->break_said < 0) status = peri__heed_callbacks(b);
    if (status != PERI_OK || !s->settings->on_step) return status;
    const int32_t former = peri__enter(b, PERI__IN_FRAME);
    const int32_t said = peri__heed(b, s->settings->on_step(s->settings->user, b), "peri_frame_fn");
    peri__leave(b, former);
    (void)peri__ensure(b, PERI__STALE_LEDGER);
    s->disturbed = b->desc.ledger && b->now.stale & PERI__STALE_BALANCE;
    if (s->disturbed && said >= 0) status = peri__note_forces(s);
    return status < 0 ? status : said;
}

/* From one planned load factor to the next, in as many steps as it takes. */
static int32_t peri__load_step(peri__solver *s, double from, double to) {
    peri_body *b = s->body;
    double at = 0.0, part = 1.0, least = ldexp(1.0, -(int)s->settings->halvings);
    int32_t status = PERI_OK;
    while (at < 1.0 && status == PERI_OK) {
        int64_t broken = s->report.broken;
        double next = at + part < 1.0 ? at + part : 1.0;
        if (s->before) memcpy(s->before, b->u, peri__vector_bytes(b));
        status = peri__static_step(s, next < 1.0 ? from + next * (to - from) : to);
        if (status == PERI_OK) {
            status = peri__show_step(s);
            if (status == PERI_OK) status = peri__heed_callbacks(b);
            at = next;
            part *= 2.0;
            continue;
        }
        if (s->before && s->report.broken == broken) {
            int halved = status == PERI_ERROR_CONVERGENCE || status == PERI_ERROR_INDEFINITE;
            part *= 0.5;
            halved = halved && part >= least && !peri__is_linear(b);
            if (halved || (s->report.steps > 0 && status != PERI_STOPPED)) memcpy(b->u, s->before, peri__vector_bytes(b));
            if (halved) status = PERI_OK;
        }
    }
    return status;
}

static int32_t peri__load_steps(peri__solver *s) {
    peri_body *b = s->body;
    const peri_solve_desc *st = s->settings;
    int32_t status = peri__take_solver(s);
    if (status < 0) return status;
    double from = s->load_from;
    (void)peri__ensure(b, PERI__STALE_LEDGER);
    b->now.still = 1;
    peri__changed(b, PERI__ACTION);
    b->now.load_factor = from;
    if (s->from) memcpy(s->from, b->u, peri__vector_bytes(b));
    if (s->load) status = peri__note_forces(s);
    for (int64_t k = 1; k <= st->steps && status == PERI_OK; ++k) {
        double to = k < st->steps ? s->load_from + (st->load_to - s->load_from) * (double)k / (double)st->steps : st->load_to;
        status = peri__load_step(s, from, to);
        from = to;
    }
    return status;
}

/* A solve that ended short of an equilibrium has moved the body: like a change by the caller, to `initial`. */
static void peri__count_stray(peri__solver *s) {
    peri_body *b = s->body;
    b->now.ledger.initial += peri__static_energy(b) - peri__energy_under(b, s->from, NULL) - peri__contact_energy_under(b, s->from);
}

PERI_API int32_t peri_solve(peri_body *b, const peri_solve_desc *st, peri_solve_report *report) {
    PERI_NEED_IDLE(b);
    peri__solver s;
    int32_t status = peri__check_statics(b, st);
    if (status == PERI_OK) status = peri__check_whole(b);
    if (report) memset(report, 0, sizeof *report);
    if (status < 0) return status;
    memset(&s, 0, sizeof s);
    s.body = b;
    s.settings = st;
    const double factor = b->now.load_factor;
    const int32_t still = b->now.still;
    s.load_from = !peri__is_nan(st->load_from) ? st->load_from : b->now.loaded ? factor : 0.0;
    if (!peri__finite(peri__stored(st->load_to - s.load_from))) return peri__fail(b, PERI_ERROR_RANGE, "load_to", -1, st->load_to);
    const int32_t former = peri__begin_run(b);
    status = peri__load_steps(&s);
    peri__end_run(b, former);
    if (status < 0 && status == s.failure.code) b->error = s.failure;
    if (status < 0 && b->break_said < 0) status = peri__heed_callbacks(b);
    if (status >= 0) b->now.loaded = 1;
    if (status < 0) {
        b->now.load_factor = s.report.steps > 0 ? s.report.load_factor : s.begun ? s.load_from : factor;
        b->now.still = s.begun ? 1 : still;
        peri__changed(b, PERI__ACTION);
    }
    if (status != PERI_OK && s.from && s.begun) peri__count_stray(&s);
    b->now.stale |= PERI__STALE_STRETCH;
    peri__free_solver(&s);
    if (report) *report = s.report;
    return status;
}
