/* SPDX-License-Identifier: MIT */
/* implicit.c - implicit dynamics: the generalised-alpha method (Chung, Hulbert 1993) on the equilibria of statics.

   With rho the spectral radius at infinite frequency: am = (2 rho - 1)/(rho + 1), af = rho/(rho + 1), w = 1 - af,
   gamma = 1/2 - am + af, beta = (1 - am + af)^2/4. A step of h, of density m, damping c, and f the force density of bonds and loads:
     (1 - am) m a' + am m a  =  w f' + af f - c m (w v' + af v)
     u' = U + h^2 beta a',  v' = V + h gamma a',    U = u + h v + h^2 (1/2 - beta) a,  V = v + h (1 - gamma) a
   Solved for u' it is an equilibrium of the body with a spring m k from each point to a place of its own:
     f' + m k (place - u') = 0,   k = ((1 - am)/w + c h gamma)/(beta h^2),
     place = U - (am/w a + c V + af/w (c v - f/m))/k
   The springs hold what nothing else does: no part is loose. rho = 1 is the average acceleration, which keeps the energy of linear bodies.

   Bonds break at u', which is then sought anew, until none does: over the step they act by half of what they bore at its start. The energy
   of fracture is what that makes of it, the elastic energy that went and was no work of the bonds, (f + f').(u' - u)/2. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

typedef struct peri__implicit {
    peri__solver s;
    double am, af, gamma, beta;
    int32_t broke;  /* 1: in this step, that began with `elastic`                                                       */
    double elastic;
    double step;  /* that the solver is prepared for; 0: none                                                           */
    void  *u, *a, *f, *load; /* real [dim][stride] at the last whole step, f and what of it is of loads; vectors of the solver */
} peri__implicit;

/* a, f and load of the state as it is: a = f/m - c v where nothing is prescribed, else 0. */
static int32_t peri__start_motion(peri__implicit *t, double damping) {
    peri_body *b = t->s.body;
    const peri__model *m = b->model;
    peri__operands operands = peri__operands_of(b);
    (void)peri__ensure(b, PERI__STALE_MASKS | PERI__STALE_CONSTANTS);
    peri__mark_supports(&t->s);
    memset(b->f, 0, peri__vector_bytes(b));
    int32_t status = peri__apply_loads(b, b->now.time, 0.0);
    if (status < 0) return status;
    memcpy(t->load, b->f, peri__vector_bytes(b));
    peri__bond_forces(b, &operands);
    t->s.report.passes++;
    memcpy(t->f, b->f, peri__vector_bytes(b));
    for (int32_t d = 0; d < m->dim; ++d)
        for (int64_t i = 0; i < m->points; ++i) {
            const int64_t at = d * m->stride + i;
            const double a = peri__get_real(t->f, b->f32, at) / peri__density_at(b, i) - damping * peri__get_real(b->v, b->f32, at);
            peri__put_real(t->a, b->f32, at, t->s.constrained[i] >> d & 1 ? 0.0 : a);
        }
    t->step = 0.0;
    b->now.stale &= ~(uint32_t)PERI__STALE_BALANCE;
    return PERI_OK;
}

/* u of the supported components at the end of the step. */
static int32_t peri__carry_supports(peri__implicit *t, double h) {
    peri_body *b = t->s.body;
    const peri__model *m = b->model;
    for (int64_t l = 0; l < b->load_count; ++l) {
        peri__load *load = &b->loads[l];
        if (!load->owned) continue;
        const int32_t status = peri__refresh_load(b, load, b->now.time);
        if (status < 0) return status;
        for (int64_t k = 0; k < load->count; ++k)
            for (int32_t d = 0; d < m->dim; ++d) {
                const int64_t at = peri__dof(b, load, k, d);
                const double value = peri__load_value(b, load, k, d), velocity = value / peri__velocity_unit(m);
                const double before = *peri__support_at(b, load, PERI__SUPPORT_VALUE, k, d);
                if (!(load->owned[k] >> d & 1)) continue;
                peri__put_real(b->u, b->f32, at, load->kind == PERI__DISPLACEMENT ? value / m->length
                                               : peri__get_real(t->u, b->f32, at) + 0.5 * h * (before + velocity));
            }
    }
    return PERI_OK;
}

/* Springs and places for a step, and u' to begin with. */
static int32_t peri__start_step(peri__implicit *t, double h, double damping) {
    peri__solver *s = &t->s;
    peri_body *b = s->body;
    const peri__model *m = b->model;
    const double w = 1.0 - t->af;
    double moving = 0.0;
    s->inertia = ((1.0 - t->am) / w + damping * h * t->gamma) / (t->beta * h * h);
    memcpy(t->u, b->u, peri__vector_bytes(b));
    for (int32_t d = 0; d < m->dim; ++d)
        for (int64_t i = 0; i < m->points; ++i) {
            const int64_t at = d * m->stride + i;
            const double rho = peri__density_at(b, i), u = peri__get_real(b->u, b->f32, at), v = peri__get_real(b->v, b->f32, at);
            const double a = peri__get_real(t->a, b->f32, at), f = peri__get_real(t->f, b->f32, at) / rho;
            const double known = t->am / w * a + damping * (v + h * (1.0 - t->gamma) * a) + t->af / w * (damping * v - f);
            peri__put_real(s->place, b->f32, at, u + h * v + h * h * (0.5 - t->beta) * a - known / s->inertia);
            peri__put_real(b->u, b->f32, at, u + h * v);
            if (!(s->constrained[i] >> d & 1)) moving += peri__square(m->volume[i] * rho * s->inertia * h * v);
        }
    s->strained = sqrt(moving); /* what would stop the motion within the step: residuals are small beside that */
    return peri__carry_supports(t, h);
}

/* What a support has given in the step to component `at` of point i, which it took to u' with the velocity v': the ledger, the reaction. */
static double peri__give_support(peri__implicit *t, const peri__load *load, int64_t k, int32_t d, double h, double damping) {
    peri_body *b = t->s.body;
    const int64_t i = peri__set_point(b, load->set, k), at = peri__dof(b, load, k, d);
    const double rho = peri__density_at(b, i), way = peri__get_real(b->u, b->f32, at) - peri__get_real(t->u, b->f32, at);
    const double v = peri__get_real(b->v, b->f32, at), mean = 0.5 * (peri__get_real(t->f, b->f32, at) + peri__get_real(b->f, b->f32, at));
    const double now = load->kind == PERI__VELOCITY ? peri__load_value(b, load, k, d) / peri__velocity_unit(b->model) : way / h;
    peri__put_real(b->v, b->f32, at, now);
    peri__put_real(t->a, b->f32, at, 0.0);
    *peri__support_at(b, load, PERI__SUPPORT_REACTION, k, d) = rho * (now - v) / h + damping * rho * way / h - mean;
    return b->model->volume[i] * (0.5 * rho * (now * now - v * v) + damping * rho * 0.5 * (v + now) * way - mean * way);
}

/* v', a', f and the ledger at u'. What loads give is in z, both with the springs. */
static int32_t peri__end_step(peri__implicit *t, double h, double damping) {
    peri__solver *s = &t->s;
    peri_body *b = s->body;
    const peri__model *m = b->model;
    double work = 0.0, lost = 0.0, bonds = 0.0, loads = 0.0;
    for (int32_t d = 0; d < m->dim; ++d)
        for (int64_t i = 0; i < m->points; ++i) {
            const int64_t at = d * m->stride + i;
            const double rho = peri__density_at(b, i), before = peri__get_real(t->u, b->f32, at), v = peri__get_real(b->v, b->f32, at);
            const double u = peri__get_real(b->u, b->f32, at), a = peri__get_real(t->a, b->f32, at);
            const int free_ = !(s->constrained[i] >> d & 1);
            const double spring = free_ ? rho * s->inertia * (peri__get_real(s->place, b->f32, at) - u) : 0.0;
            const double load = peri__get_real(s->k.z, b->f32, at) - spring, volume = m->volume[i];
            peri__put_real(b->f, b->f32, at, peri__get_real(b->f, b->f32, at) - spring);
            loads += 0.5 * volume * (load + peri__get_real(t->load, b->f32, at)) * (u - before);
            bonds += 0.5 * volume * (peri__get_real(b->f, b->f32, at) + peri__get_real(t->f, b->f32, at)) * (u - before);
            peri__put_real(t->load, b->f32, at, load);
            if (!free_) {
                lost += damping * rho * volume * v * (u - before); /* the other half with the new velocity, below */
                continue;
            }
            const double next = (u - before - h * v - h * h * (0.5 - t->beta) * a) / (t->beta * h * h);
            const double now = v + h * ((1.0 - t->gamma) * a + t->gamma * next);
            peri__put_real(t->a, b->f32, at, next);
            peri__put_real(b->v, b->f32, at, now);
            lost += damping * rho * volume * 0.5 * (v + now) * (u - before);
        }
    for (int64_t l = 0; l < b->load_count; ++l) {
        peri__load *load = &b->loads[l];
        for (int64_t k = 0; load->owned && k < load->count; ++k)
            for (int32_t d = 0; d < m->dim; ++d) {
                if (!(load->owned[k] >> d & 1)) continue;
                const int64_t at = peri__dof(b, load, k, d), i = peri__set_point(b, load->set, k);
                const double v = peri__get_real(b->v, b->f32, at);
                const double way = peri__get_real(b->u, b->f32, at) - peri__get_real(t->u, b->f32, at);
                work += peri__give_support(t, load, k, d, h, damping);
                lost += damping * peri__mass(b, i) * 0.5 * (peri__get_real(b->v, b->f32, at) - v) * way;
            }
        load->stepped = 1;
    }
    memcpy(t->f, b->f, peri__vector_bytes(b));
    if (t->broke && b->desc.ledger) b->now.ledger.fracture += t->elastic - peri__static_energy(b) - (bonds - loads);
    if (b->desc.ledger) b->now.ledger.external += work + loads;
    if (b->desc.ledger) b->now.ledger.damping += lost;
    s->report.steps++;
    b->now.stale &= ~(uint32_t)(PERI__STALE_FORCE | PERI__STALE_BALANCE);
    return peri__meet_supports(b);
}

/* u' of the bonds as they are; those over their limit break, and it is sought anew, until none is. */
static int32_t peri__settle_step(peri__implicit *t, double h) {
    peri__solver *s = &t->s;
    peri_body *b = s->body;
    int32_t status = PERI_OK;
    t->broke = 0;
    for (int64_t rounds = 0;; ++rounds) {
        if (t->step != h || rounds > 0) status = peri__prepare(s, t->step != h);
        if (status != PERI_OK) return status;
        t->step = h;
        s->left = s->settings->iterations;
        s->energy0 = 0.0;
        status = peri__newton(s);
        if (status != PERI_OK) return status;
        if (b->model->seen_by & PERI__BY_WORK) {
            peri__operands operands = peri__operands_of(b);
            operands.working = 1;
            operands.f = s->k.q; /* b->f stays */
            peri__bond_forces(b, &operands);
            s->report.passes++;
        }
        const double most = peri__may_break(s) ? peri__most_excess(b) : 0.0;
        if (!(most > 1.0)) return PERI_OK;
        if (rounds >= s->settings->breaks) return peri__fail_step(s, PERI_ERROR_CONVERGENCE, "breaks", -1, (double)s->report.broken);
        if (!t->broke && b->desc.ledger) t->elastic = peri__energy_under(b, t->u, NULL);
        t->broke = 1;
        (void)peri__break_static(s, most, 1.0);
        (void)peri__ensure(b, PERI__STALE_MASKS | PERI__STALE_CONSTANTS);
    }
}

static int32_t peri__check_untouched(peri_body *b) {
    if (b->contact) return peri__fail(b, PERI_ERROR_LAW, "contact", -1, 0.0);
    for (int64_t k = 0; k < b->obstacle_count; ++k)
        if (b->obstacles[k].kind) return peri__fail(b, PERI_ERROR_LAW, "obstacle", k, 0.0);
    return PERI_OK;
}

/* A step that fails leaves the body at the one before, less the bonds that broke in it: what these held there is fracture. */
static int32_t peri__implicit_step(void *context, peri_body *b, double h, double next, double damping) {
    peri__implicit *t = (peri__implicit *)context;
    const double time = b->now.time;
    const int changed = t->step == 0.0 || (b->now.stale & PERI__STALE_BALANCE); /* at first, and by on_frame */
    int32_t status = changed ? peri__check_untouched(b) : PERI_OK;
    if (changed && status == PERI_OK) status = peri__start_motion(t, damping);
    if (status < 0) return status;
    b->now.time = next;
    t->broke = 0;
    status = peri__start_step(t, h, damping);
    if (status == PERI_OK) status = peri__settle_step(t, h);
    if (status == PERI_OK) {
        b->now.steps++;
        return peri__end_step(t, h, damping);
    }
    memcpy(b->u, t->u, peri__vector_bytes(b));
    b->now.time = time;
    if (t->broke) peri__withdraw_breaks(b);
    peri__changed(b, PERI__ACTION);
    if (t->broke && b->desc.ledger) {
        (void)peri__ensure(b, PERI__STALE_MASKS | PERI__STALE_CONSTANTS);
        b->now.ledger.fracture += t->elastic - peri__static_energy(b);
    }
    return status;
}

/* Does a criterion go by how long, or how fast? */
static int peri__uses_past(const peri__model *m) {
    const uint32_t rate = 1u << (PERI_CRITERION_RATE_STRETCH - peri__first_criterion);
    const uint32_t delay = 1u << (PERI_CRITERION_DELAYED_STRETCH - peri__first_criterion);
    return (m->criteria & (rate | delay)) != 0;
}

static int32_t peri__check_implicit(peri_body *b, const peri_advance_desc *r, const peri_solve_desc *st, double rho) {
    const peri__model *m = b->model;
    int32_t status = peri__check_length(b, r);
    if (status == PERI_OK) status = peri__check_statics(b, st);
    if (status < 0) return status;
    PERI_NEED_NUMBER(b, r->time_step > 0.0, r->time_step);
    PERI_NEED_NUMBER(b, peri__stored(r->time_step / m->time) > 0.0, r->time_step);
    PERI_NEED_NUMBER(b, rho >= 0.0 && rho <= 1.0, rho);
    if (st->method != PERI_METHOD_NEWTON) return peri__fail(b, PERI_ERROR_LAW, "method", -1, st->method);
    if (st->control != PERI_CONTROL_LOAD) return peri__fail(b, PERI_ERROR_LAW, "control", -1, st->control);
    if (m->law_of || m->inelastic) return peri__fail(b, PERI_ERROR_LAW, "peri_advance_implicit", -1, 0.0);
    status = peri__check_untouched(b);
    if (status == PERI_OK && st->fracture && m->breakable && peri__uses_past(m))
        status = peri__fail(b, PERI_ERROR_LAW, "criterion", -1, 0.0);
    return status == PERI_OK ? peri__check_whole(b) : status;
}

static int32_t peri__take_motion(peri__implicit *t) {
    peri__solver *s = &t->s;
    void **vectors[] = { &s->before, &s->rate, &s->from, &s->load, &s->place };
    int32_t status = peri__take_solver(s);
    for (size_t k = 0; status == PERI_OK && k < sizeof vectors / sizeof *vectors; ++k) {
        if (!*vectors[k]) *vectors[k] = peri__take_vector(s);
        if (!*vectors[k]) status = peri__fail(s->body, PERI_ERROR_MEMORY, "peri_advance_implicit", -1, 0.0);
    }
    t->u = s->before;
    t->a = s->rate;
    t->f = s->from;
    t->load = s->load;
    return status;
}

PERI_API int32_t peri_advance_implicit(peri_body *b, const peri_advance_desc *advance, const peri_solve_desc *solve, double rho,
                                       peri_solve_report *report) {
    peri__implicit t;
    peri_solve_desc settings;
    peri_advance_desc r;
    if (report) memset(report, 0, sizeof *report);
    PERI_NEED_IDLE(b);
    PERI_NEED_WHOLE(b, "peri_advance_implicit");
    peri_solve_desc_init(&settings);
    int32_t status = peri__check_implicit(b, advance, solve ? solve : &settings, rho);
    if (status < 0) return status;
    r = *advance;
    r.integrator = PERI_INTEGRATOR_VELOCITY_VERLET; /* no step is staggered, none too large */
    r.force_step = 1;
    if (solve) settings = *solve;
    settings.keep = 0;
    memset(&t, 0, sizeof t);
    t.s.body = b;
    t.s.settings = &settings;
    t.am = (2.0 * rho - 1.0) / (rho + 1.0);
    t.af = rho / (rho + 1.0);
    t.gamma = 0.5 - t.am + t.af;
    t.beta = 0.25 * peri__square(1.0 - t.am + t.af);
    const int32_t former = peri__begin_run(b);
    status = peri__take_motion(&t);
    if (status == PERI_OK) status = peri__run(b, &r, peri__implicit_step, &t);
    peri__end_run(b, former);
    if (status < 0 && status == t.s.failure.code) b->error = t.s.failure;
    b->now.stale |= PERI__STALE_STRETCH;
    t.s.report.load_factor = b->now.load_factor;
    peri__free_solver(&t.s);
    if (report) *report = t.s.report;
    return status;
}
