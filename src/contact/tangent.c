/* SPDX-License-Identifier: MIT */
/* tangent.c - what equilibria ask of contact: its energy at other displacements, and its tangent: the springs of the pairs that touch at
   the present ones. Their pressure, which the tangent proper lets turn with the pair, is left out: it makes the tangent indefinite and is
   small where the overlap is. So Newton's method converges by the overlap over the distance, and the set of pairs that touch is that of
   each new iterate. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

/* Under the displacements u, laid out as b->u. */
static double peri__contact_energy_under(peri_body *b, void *u) {
    void *own = b->u;
    if (!b->contact) return 0.0;
    b->u = u;
    (void)peri__ready_contact(b);
    const double energy = peri__contact_energy(b);
    b->u = own;
    (void)peri__ready_contact(b);
    return energy;
}

typedef struct peri__touch_tangent { /* p, q: real [dim][stride], a change of the displacements and of the force density       */
    peri_body  *body;
    const void *p;
    void       *q;
} peri__touch_tangent;

static void peri__tangent_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__touch_tangent *s = (const peri__touch_tangent *)context;
    const peri_body *b = s->body;
    const peri__contact *c = b->contact;
    const peri__model *m = b->model;
    (void)sums;
    for (int64_t p = begin; p < end; ++p) {
        const int64_t i = c->member[p];
        double force[3] = { 0.0, 0.0, 0.0 };
        for (int64_t e = c->begin[p]; e < c->begin[p] + c->open[p]; ++e) {
            peri__pair_touch t;
            double apart = 0.0;
            if (!peri__meet(b, p, e, &t)) continue;
            for (int32_t d = 0; d < m->dim; ++d)
                apart += t.n[d] * (peri__get_real(s->p, b->f32, d * m->stride + t.j) - peri__get_real(s->p, b->f32, d * m->stride + i));
            for (int32_t d = 0; d < m->dim; ++d) force[d] += t.stiffness * apart * t.n[d];
        }
        for (int32_t d = 0; d < m->dim; ++d) {
            const int64_t at = d * m->stride + i;
            if (force[d] != 0.0) peri__put_real(s->q, b->f32, at, peri__get_real(s->q, b->f32, at) + force[d] / m->volume[i]);
        }
    }
}

/* Adds what contact makes of the change p to q. */
static void peri__add_touch_tangent(peri_body *b, const void *p, void *q) {
    peri__touch_tangent tangent = { b, p, q };
    if (b->contact) peri__for_points(b, b->contact->members, 4, peri__tangent_block, &tangent, NULL);
}
