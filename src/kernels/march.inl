/* SPDX-License-Identifier: MIT */
/* march.inl - the pointwise passes of time integration: kicks, drift, kinetic energy. */

PERI_INLINE double PERI_FN(density)(const peri__operands *s, int64_t i) {
    return s->density ? s->density[i] : s->model->rho[s->model->material[i]];
}

/* v = keep*v + kick*f/rho; then, where drift > 0: u += drift*v and f = 0, ready for the loads of the new time.
   sums: b work of damping over the kick, its impulse times the mean velocity: what it takes from the kinetic energy, exactly;
   bad the first point whose motion is not finite. At most PERI_BLOCK points. */
static void PERI_FN(kick)(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__operands *operands = (const peri__operands *)context;
    const peri__model *m = operands->model;
    const peri_r keep = (peri_r)operands->keep;
    const int64_t count = end - begin;
    const int lossy = operands->loss_old != 0.0 || operands->loss_new != 0.0;
    peri_r kick[PERI_BLOCK], old[PERI_BLOCK], now = 0;
    double work[PERI_BLOCK];
    int32_t last = -1;
    for (int64_t k = 0; operands->density && k < count; ++k) kick[k] = (peri_r)(operands->kick / operands->density[begin + k]);
    for (int64_t k = 0; !operands->density && k < count; ++k) {
        const int32_t material = m->material[begin + k];
        if (material != last) now = (peri_r)(operands->kick / m->rho[last = material]);
        kick[k] = now;
    }
    if (lossy) memset(work, 0, sizeof work);
    for (int d = 0; d < PERI_D; ++d) {
        const int64_t at = d * m->stride + begin;
        peri_r *u = (peri_r *)operands->drifted + at, *v = (peri_r *)operands->v + at, *f = (peri_r *)operands->f + at;
        if (lossy) memcpy(old, v, (size_t)count * sizeof *v);
        if (PERI_BY_VECTORS(m, kick_some)(count, keep, kick, f, v) > 0)
            for (int64_t k = 0; k < count; ++k)
                if (!(v[k] > -PERI_SPEEDING && v[k] < PERI_SPEEDING) && (sums->bad < 0 || begin + k < sums->bad)) sums->bad = begin + k;
        for (int64_t k = 0; lossy && k < count; ++k)
            work[k] += (operands->loss_old * (double)old[k] + operands->loss_new * (double)v[k]) * 0.5 * ((double)old[k] + (double)v[k]);
        if (!(operands->drift > 0.0)) continue;
        PERI_BY_VECTORS(m, drift_some)(count, (peri_r)operands->drift, v, u);
        memset(f, 0, (size_t)count * sizeof *f);
    }
    for (int64_t k = 0; lossy && k < count; ++k) sums->b += work[k] * PERI_FN(density)(operands, begin + k) * m->volume[begin + k];
}

static void PERI_FN(kinetic)(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__operands *operands = (const peri__operands *)context;
    const peri__model *m = operands->model;
    for (int64_t i = begin; i < end; ++i) {
        double square = 0.0;
        if (operands->ghost && operands->ghost[i]) continue;
        for (int d = 0; d < PERI_D; ++d) square += peri__square((double)((const peri_r *)operands->v)[d * m->stride + i]);
        sums->a += 0.5 * PERI_FN(density)(operands, i) * m->volume[i] * square;
    }
}
