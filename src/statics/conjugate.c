/* SPDX-License-Identifier: MIT */
/* conjugate.c - the preconditioned conjugate gradients of the static solver, and the memory that it takes.

   K is symmetric because forces are taken per point, V_i times the density. Supports are a projection: directions are 0 on constrained
   components, and what K does there is kept in r, out of all scalar products: it is minus the reaction. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_NOTHING(b) ((b)->b32 ? 1e-42 : 1e-140) /* forces that count as none: they, or their squares, underflow; inner units */

static int peri__is_linear(const peri_body *b) {
    for (int64_t k = 0; k < b->obstacle_count; ++k)
        if (b->obstacles[k].kind) return 0;
    return b->desc.geometry == PERI_GEOMETRY_LINEAR && !b->contact && !b->model->law_of && !b->model->inelastic;
}

static double peri__rounding(const peri_body *b) { return b->b32 ? 2.0 * FLT_EPSILON : 2.0 * DBL_EPSILON; }

static void *peri__take(peri__solver *s, int64_t count, size_t size) {
    void *taken = peri__new(&s->body->scratch, count, size);
    if (taken) s->bytes += count * (int64_t)size;
    return taken;
}

static void *peri__take_vector(peri__solver *s) {
    void *taken = peri__new_vector(s->body, &s->body->scratch);
    if (taken) s->bytes += peri__vector_reals(s->body->model) * (int64_t)peri__real(s->body);
    return taken;
}

static void peri__note_bytes(peri__solver *s) {
    if (s->bytes > s->report.bytes) s->report.bytes = s->bytes;
}

static void peri__free_solver(peri__solver *s) {
    const peri_body *b = s->body;
    const peri__model *m = b->model;
    void *vectors[] = { s->k.d, s->k.r, s->k.p, s->k.q, s->k.z, s->before, s->rate, s->from, s->load, s->place };
    for (size_t k = 0; k < sizeof vectors / sizeof *vectors; ++k) peri__delete_vector(b, &b->scratch, vectors[k]);
    if (s->kept) s->kept->pace = s->pace;
    if (s->kept) s->kept->lost = s->lost;
    if (!s->kept) peri__delete(&b->scratch, s->blocks, PERI_PACKED(m->dim) * m->stride, peri__real(b));
    peri__delete(&b->scratch, s->t.moduli, peri__moduli_reals(m), sizeof(double));
    peri__delete(&b->scratch, s->t.change, peri__response_reals(m), peri__bond_real(b));
    peri__delete(&b->scratch, s->constrained, m->points, 1);
    peri__delete(&b->scratch, s->part_of, m->points, sizeof *s->part_of);
    peri__delete(&b->scratch, s->queue, m->points, sizeof *s->queue);
    peri__delete(&b->scratch, s->parts, s->part_capacity, sizeof *s->parts);
    peri__delete(&b->scratch, s->contacts, s->contact_capacity, sizeof *s->contacts);
    peri__delete(&b->scratch, s->leaning, m->points, sizeof *s->leaning);
    if (!s->kept) peri__free_levels(s->levels);
}

/* Runs one of the vector kernels over the body, and sums. */
static peri__sums peri__krylov_pass(peri__solver *s, peri__krylov *k, peri__block_fn kernel) {
    peri__for_points(s->body, s->body->model->points, 4, kernel, k, s->body->sums);
    return peri__total(s->body->sums, s->body->model->points);
}

/* q += scale m k (p - place), force densities of the springs of inertia on what is free: implicit.c. place may be NULL: 0. */
static void peri__add_inertia(const peri__solver *s, double scale, const void *p, const void *place, void *q) {
    const peri_body *b = s->body;
    const peri__model *m = b->model;
    for (int32_t d = 0; s->inertia > 0.0 && d < m->dim; ++d)
        for (int64_t i = 0; i < m->points; ++i) {
            const int64_t at = d * m->stride + i;
            if (s->constrained[i] >> d & 1) continue;
            const double way = peri__get_real(p, b->f32, at) - (place ? peri__get_real(place, b->f32, at) : 0.0);
            peri__put_real(q, b->f32, at, peri__get_real(q, b->f32, at) + scale * peri__density_at(b, i) * s->inertia * way);
        }
}

/* q = K p, as forces; returns p.K p, and p.p to *square. */
static double peri__stiffness_times(peri__solver *s, int at_rest, double *square) {
    s->t.body = s->body;
    s->t.p = s->k.p;
    s->t.q = s->k.q;
    s->t.secant = s->secants;
    peri__apply_tangent(&s->t, at_rest);
    peri__add_springs(s, -1.0, s->k.p, 0, s->k.q);
    peri__add_touch_tangent(s->body, s->t.p, s->t.q);
    peri__add_inertia(s, -1.0, s->k.p, NULL, s->k.q);
    s->report.passes++;
    peri__sums sums = peri__krylov_pass(s, &s->k, s->body->ops->krylov_force);
    /* the tangent of a stressed body answers to turns; p has no part in what is taken out, so p.K p stands */
    peri__balance(s, s->k.q, 1);
    peri__drop_singular(s, s->k.q);
    *square = sums.b;
    return sums.a;
}

/* z = preconditioner times r; returns r.z. */
static double peri__precondition(peri__solver *s) {
    s->k.blocks = s->settings->preconditioner == PERI_PRECONDITIONER_NONE ? NULL : s->blocks;
    (void)peri__krylov_pass(s, &s->k, s->body->ops->krylov_blocks);
    if (s->levels) peri__correct_coarsely(s);
    peri__balance(s, s->k.z, 0);
    peri__drop_singular(s, s->k.z);
    return peri__krylov_pass(s, &s->k, s->body->ops->krylov_dot).a;
}

/* |r| of what is free; the scale by the loads and the reactions in r. */
static double peri__measure(peri__solver *s, peri__sums sums, double loads) {
    double constrained = sqrt(sums.b);
    s->scale = loads > constrained ? loads : constrained;
    if (!(s->scale < HUGE_VAL)) { /* nothing is small beside that */
        s->scale = 0.0;
        return HUGE_VAL;
    }
    if (s->scale > s->top) s->top = s->scale;
    return sqrt(sums.a);
}

/* Is a residual no more than rounding, of the bonds' forces or of what acted before, in a body that nothing loads and no support strains?
   Reactions then fall with it. */
static int peri__is_nothing(const peri__solver *s, double residual, double loads) {
    const double nothing = PERI_NOTHING(s->body);
    return (residual <= nothing && s->scale <= nothing) || (loads == 0.0 && residual <= s->floor && s->scale <= s->floor);
}

/* One more iteration, told to the callback. Here a run ends that it, a load or an obstacle wishes to stop. */
static int32_t peri__count_iteration(peri__solver *s, double residual) {
    const peri_solve_desc *st = s->settings;
    s->report.iterations++;
    s->left--;
    int32_t status = PERI_OK;
    if (st->on_iteration) status = peri__heed(s->body, st->on_iteration(st->user, s->report.iterations, residual), "peri_iteration_fn");
    return status == PERI_OK && s->body->stop ? PERI_STOPPED : status;
}

/* How far to go along p where bonds that soften bend K downwards: as far as springs would that are as soft as the bonds are by now. Their
   energy is nowhere below that of the bonds by more than here, so that the bonds have less there, too. K p is theirs then. */
static double peri__softened_step(peri__solver *s, double rz, double none) {
    const int32_t former = s->secants;
    double square;
    s->secants = 1;
    const double bent = peri__stiffness_times(s, 0, &square);
    s->secants = former;
    return bent > none * square * s->softest ? rz / bent : 0.0;
}

/* Adds to d the solution of K d = r, r becoming what is left, until |r| <= reach*scale. `loads`: that part of the scale which stays.
   PERI_OK, PERI_STOPPED, PERI_ERROR_CONVERGENCE, or PERI_ERROR_INDEFINITE, PERI_ERROR_LOOSE where a direction has negative or no stiffness;
   d then is what was found before it, or that way down. */
static int32_t peri__conjugate(peri__solver *s, double reach, double loads, int at_rest) {
    peri_body *b = s->body;
    /* differences of displacements are exact: rigid motions bend by the square of the rounding unit, others by the unit itself */
    const double none = b->b32 ? 1e-12 : 1e-27, less = b->b32 ? -1e-7 : -1e-14;
    double rz = 0.0, first = 0.0;
    s->slope = 0.0;
    memset(s->k.p, 0, peri__vector_bytes(b));
    double residual = peri__measure(s, peri__krylov_pass(s, &s->k, b->ops->krylov_norm), loads);
    for (int64_t k = 0;; ++k) {
        double before = rz, square, bent;
        if (k == 0) first = residual;
        if (!(residual < HUGE_VAL)) return PERI_ERROR_CONVERGENCE;
        if (residual <= 0.01 * peri__rounding(b) * first) return PERI_OK; /* what is left of r says nothing any more: to be taken anew */
        if (residual <= reach * s->scale || peri__is_nothing(s, residual, residual <= reach * first ? loads : HUGE_VAL)) return PERI_OK;
        if (s->left <= 0) return PERI_ERROR_CONVERGENCE;
        rz = peri__precondition(s);
        if (!(rz > 0.0)) return PERI_ERROR_CONVERGENCE;
        if (s->energy0 == 0.0) s->energy0 = rz;
        if (rz <= peri__square(s->settings->energy_tolerance) * s->energy0) {
            s->energy_done = k == 0 || peri__is_linear(b);
            return PERI_OK;
        }
        s->k.beta = k == 0 ? 0.0 : rz / before;
        (void)peri__krylov_pass(s, &s->k, b->ops->krylov_turn);
        bent = peri__stiffness_times(s, at_rest, &square);
        if (!(bent > none * square * s->softest)) {
            const double soft = b->model->law_of && bent == bent ? peri__softened_step(s, rz, none) : 0.0;
            s->k.alpha = soft > 0.0 ? soft : k == 0 ? 1.0 : 0.0;
            s->slope += s->k.alpha * rz;
            (void)peri__krylov_pass(s, &s->k, b->ops->krylov_step);
            return bent < less * square * s->stiff || soft > 0.0 ? PERI_ERROR_INDEFINITE
                 : bent == bent ? PERI_ERROR_LOOSE : PERI_ERROR_CONVERGENCE;
        }
        s->k.alpha = rz / bent;
        s->slope += s->k.alpha * rz;
        residual = peri__measure(s, peri__krylov_pass(s, &s->k, b->ops->krylov_step), loads);
        int32_t status = peri__count_iteration(s, s->scale > 0.0 ? residual / s->scale : residual);
        if (status != PERI_OK) return status;
    }
}
