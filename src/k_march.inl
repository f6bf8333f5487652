/* k_march.inl - the pointwise passes of time integration: kicks, drift, kinetic energy. */

/* v = keep*v + kick*f/rho; then, where drift > 0: u += drift*v and f = 0, ready for the loads of the new time.
   sums: b work of damping over the kick, its impulse times the mean velocity: what it takes from the kinetic energy, exactly;
   bad the first point whose motion is not finite. */
static void PERI_FN(kick)(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__step *step = (const peri__step *)context;
    peri_body *b = step->body;
    const peri__model *m = b->model;
    const peri_r keep = (peri_r)step->keep, drift = (peri_r)step->drift;
    const int lossy = step->loss_old != 0.0 || step->loss_new != 0.0;
    for (int64_t i = begin; i < end; ++i) {
        const double rho = m->rho[m->material[i]];
        const peri_r kick = (peri_r)(step->kick / rho);
        double work = 0.0;
        for (int d = 0; d < PERI_D; ++d) {
            int64_t at = d * m->stride + i;
            peri_r *u = (peri_r *)b->u + at, *v = (peri_r *)b->v + at, *f = (peri_r *)b->f + at;
            peri_r old = *v, now = keep * old + kick * *f;
            if (lossy) work += (step->loss_old * (double)old + step->loss_new * (double)now) * 0.5 * ((double)old + (double)now);
            *v = now;
            if (step->drift > 0.0) {
                *u += drift * now;
                *f = 0;
            }
            /* a comparison that NaN fails; the bound is far beyond any speed in inner units */
            if (!(now > (peri_r)-1e9 && now < (peri_r)1e9) && sums->bad < 0) sums->bad = i;
        }
        if (lossy) sums->b += work * rho * m->volume[i];
    }
}

static void PERI_FN(kinetic)(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__step *step = (const peri__step *)context;
    const peri_body *b = step->body;
    const peri__model *m = b->model;
    for (int64_t i = begin; i < end; ++i) {
        double square = 0.0;
        for (int d = 0; d < PERI_D; ++d) square += peri__square((double)((const peri_r *)b->v)[d * m->stride + i]);
        sums->a += 0.5 * m->rho[m->material[i]] * m->volume[i] * square;
    }
}
