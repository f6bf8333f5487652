/* SPDX-License-Identifier: MIT */
/* touch.c - obstacles in equilibria: the active set of the points that their springs hold.

   An obstacle holds a point by a one-sided spring k n n per volume, which is nothing before the point touches. So a part that only
   obstacles hold has a singular tangent at an exact touch, or where the nearest point of a lattice lies a little off a roller. Points
   within PERI_GAP of a surface are therefore listed, too. A part that is held with them is not loose; and where those in touch do not
   hold it alone, the next linear solve takes the springs of all that are near as if they held both ways. Then those that pull are let
   go: forces are always those of one-sided springs. A part that never comes to rest on them hangs: its loads pull it off. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_GAP     0.5 /* spacings                                                                                       */
#define PERI_HANGING 10  /* Newton iterations after which a part that touches nothing is given up                          */

struct peri__hold { /* of a point and an obstacle, in ascending order of the points                                     */
    int32_t point, active; /* active: its spring is in the tangent                                                         */
    double  depth, stiffness, normal[3];
};

/* Lists what is in touch or near; active: what is in touch. */
static int32_t peri__list_contacts(peri__solver *s) {
    peri_body *b = s->body;
    const double gap = PERI_GAP * b->model->spacing;
    s->contact_count = 0;
    if (b->obstacle_count > 0 && !s->leaning) {
        s->leaning = (int32_t *)peri__new(&b->scratch, b->model->points, sizeof *s->leaning);
        if (!s->leaning) return peri__fail(b, PERI_ERROR_MEMORY, "peri_solve", -1, 0.0);
        s->bytes += b->model->points * (int64_t)sizeof *s->leaning;
    }
    for (int64_t i = 0; b->obstacle_count > 0 && i < b->model->points; ++i)
        for (int64_t k = 0; k < b->obstacle_count; ++k) {
            const peri__obstacle *o = &b->obstacles[k];
            peri__dip t;
            const int32_t touches = o->kind ? peri__dips(b, o, i, gap, &t) : 0;
            if (touches < 0) return touches;
            if (!o->kind || !(t.depth > -gap)) continue;
            if (!peri__grow(&b->scratch, &s->contacts, &s->contact_capacity, s->contact_count + 1, sizeof *s->contacts))
                return peri__fail(b, PERI_ERROR_MEMORY, "peri_solve", -1, 0.0);
            peri__hold *c = &s->contacts[s->contact_count++];
            c->point = (int32_t)i;
            c->active = touches;
            c->depth = t.depth;
            c->stiffness = o->stiffness;
            memcpy(c->normal, t.normal, sizeof c->normal);
        }
    return PERI_OK;
}

/* The first contact of point i, or of one after it. */
static int64_t peri__first_contact(const peri__solver *s, int64_t i) {
    int64_t low = 0, high = s->contact_count;
    while (low < high) {
        const int64_t middle = (low + high) / 2;
        if (s->contacts[middle].point < i) low = middle + 1;
        else high = middle;
    }
    return low;
}

/* vector += scale V k n (n.p + depth), over the active contacts: p NULL: by the depth of those that are not in touch. Real [dim][stride] as
   the state; forces times volumes where `whole`, else densities. */
static void peri__add_springs(const peri__solver *s, double scale, const void *p, int whole, void *vector) {
    const peri_body *b = s->body;
    const peri__model *m = b->model;
    for (int64_t n = 0; n < s->contact_count; ++n) {
        const peri__hold *c = &s->contacts[n];
        double along = fmin(c->depth, 0.0);
        if (!c->active) continue;
        for (int32_t d = 0; p && d < m->dim; ++d)
            along = (d == 0 ? 0.0 : along) + c->normal[d] * peri__get_real(p, b->f32, d * m->stride + c->point);
        for (int32_t d = 0; d < m->dim; ++d) {
            const int64_t at = d * m->stride + c->point;
            const double force = scale * (whole ? m->volume[c->point] : 1.0) * c->stiffness * along * c->normal[d];
            peri__put_real(vector, b->f32, at, peri__get_real(vector, b->f32, at) + force);
        }
    }
}
