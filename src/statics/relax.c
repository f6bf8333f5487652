/* SPDX-License-Identifier: MIT */
/* relax.c - adaptive dynamic relaxation (Underwood 1983; Kilic, Madenci 2010): the body moves with a made-up mass that makes a step of 1
   stable, under a damping that follows the lowest frequency in the present motion, c = 2 sqrt(u.K u/u.u) with the diagonal K = change of
   force over change of place. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

/* One step of what is free: p is the velocity, q the force before. 0 where it would lead further than 1e15 spacings. */
static int peri__relax_step(peri__solver *s, double unit, int64_t k) {
    peri_body *b = s->body;
    const peri__model *m = b->model;
    double bent = 0.0, square = 0.0, damping = 0.0;
    for (int32_t d = 0; k > 0 && d < m->dim; ++d)
        for (int64_t i = 0; i < m->points; ++i) {
            int64_t at = d * m->stride + i;
            double v = peri__get_real(s->k.p, b->f32, at), u = peri__get_real(b->u, b->f32, at);
            if ((s->constrained[i] >> d & 1) || v == 0.0) continue;
            double stiff = (peri__get_real(s->k.q, b->f32, at) - peri__get_real(s->k.r, b->f32, at)) / v;
            if (stiff > 0.0) bent += stiff * u * u;
            square += peri__mass(b, i) * unit * u * u;
        }
    if (square > 0.0) damping = 2.0 * sqrt(bent / square);
    if (damping > 1.9) damping = 1.9;
    for (int32_t d = 0; d < m->dim; ++d)
        for (int64_t i = 0; i < m->points; ++i) {
            int64_t at = d * m->stride + i;
            double push = peri__get_real(s->k.r, b->f32, at) / (peri__mass(b, i) * unit);
            double v = peri__get_real(s->k.p, b->f32, at);
            if (s->constrained[i] >> d & 1) continue;
            v = k == 0 ? 0.5 * push : ((2.0 - damping) * v + 2.0 * push) / (2.0 + damping);
            if (!(fabs(v) < 1e15)) return 0;
            peri__put_real(s->k.p, b->f32, at, v);
            peri__put_real(b->u, b->f32, at, peri__get_real(b->u, b->f32, at) + v);
        }
    return 1;
}

static int32_t peri__relax(peri__solver *s) {
    peri_body *b = s->body;
    double unit = 1.1 / peri__square(peri__bounded(b));
    double loads, residual;
    s->floor = peri__rounding(b) * s->top;
    if (peri__gap(s)) {
        if (peri__is_far(s)) return peri__fail_step(s, PERI_ERROR_CONVERGENCE, "PERI_FIELD_DISPLACEMENT", -1, 0.0);
        peri__move(s, 1.0);
    }
    memcpy(s->k.d, b->u, peri__vector_bytes(b));
    memset(s->k.p, 0, peri__vector_bytes(b));
    for (int64_t k = 0;; ++k) {
        void *r = s->k.r;
        s->k.r = s->k.q;
        s->k.q = r;
        loads = peri__static_forces(s);
        int32_t status = loads < 0.0 ? (int32_t)loads : k == 0 ? peri__check_small_loads(s) : PERI_OK;
        if (status < 0) return status;
        residual = peri__static_residual(s, loads);
        peri__tell_residual(s, residual);
        peri__note_floor(s);
        if (peri__is_settled(s, residual, loads)) return PERI_OK;
        if (!(residual < HUGE_VAL)) memcpy(b->u, s->k.d, peri__vector_bytes(b)); /* it led out of all numbers: back */
        if (s->left <= 0 || !(residual < HUGE_VAL) || !peri__relax_step(s, unit, k))
            return peri__fail_step(s, PERI_ERROR_CONVERGENCE, "iterations", -1, s->report.residual);
        status = peri__count_iteration(s, s->report.residual);
        if (status != PERI_OK) return status;
    }
}
