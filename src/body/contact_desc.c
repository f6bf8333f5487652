/* SPDX-License-Identifier: MIT */
/* contact_desc.c - contact between materials, as the caller declares it. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_COOKIE_CONTACT (UINT64_C(0x7065726900090000) + sizeof(peri_contact_desc))

PERI_API void peri_contact_desc_init(peri_contact_desc *d) {
    if (!d) return;
    memset(d, 0, sizeof *d);
    d->cookie = PERI_COOKIE_CONTACT;
    d->stiffness = 0.25;
    d->restitution = 1.0;
}

/* ---- what follows from what is declared ----------------------------------------------------------------------------------- */

/* The least and largest volume of the points of each material; 0 where there are none. */
static void peri__volumes_of(const peri__model *m, double *least, double *most) {
    for (int32_t k = 0; k < m->materials; ++k) least[k] = most[k] = 0.0;
    for (int64_t i = 0; i < m->points; ++i) {
        const int32_t k = m->material[i];
        least[k] = most[k] > 0.0 ? fmin(least[k], m->volume[i]) : m->volume[i];
        most[k] = fmax(most[k], m->volume[i]);
    }
}

/* Fills in the numbers of a contact whose ->touch have their desc and distance. 0 where a restitution is out of reach: *wrong, *value. */
static int peri__fit_contact(const peri_body *b, peri__contact *c, const peri__touch **wrong, double *value) {
    const peri__model *m = b->model;
    const int32_t n = m->materials;
    const double bonds = fmax(b->largest_row_sum, m->row_sum);
    double least[PERI_MATERIAL_LIMIT], most[PERI_MATERIAL_LIMIT];
    int resists = 0;
    peri__volumes_of(m, least, most);
    c->distance = c->bound = c->hold = 0.0;
    c->growth = 1.0;
    for (int32_t k = 0; k < n * n; ++k) {
        peri__touch *t = &c->touch[k];
        const int32_t i = k / n, j = k % n;
        if (!t->on || !(most[i] > 0.0) || !(most[j] > 0.0)) continue;
        const double rho = b->density ? peri__least_density(b) : m->rho[i], young = 2.0 / (1.0 / m->laws[i].young + 1.0 / m->laws[j].young);
        t->stiffness = t->desc.stiffness * young / (m->spacing * t->distance);
        c->distance = fmax(c->distance, t->distance);
        c->bound = fmax(c->bound, 2.0 * peri__assumed_touching(m->dim, t->distance, m->spacing) * t->stiffness / rho
                                  * (2.0 * most[j] / (least[i] + most[j])));
        resists = resists || t->desc.friction > 0.0 || t->desc.restitution < 1.0;
    }
    if (!resists) return 1;
    c->hold = PERI_HOLD * sqrt(bonds + c->bound);
    const double step = 0.9 * peri__step_with_contact(c, bonds);
    for (int32_t k = 0; k < n * n; ++k) {
        peri__touch *t = &c->touch[k];
        const int32_t i = k / n;
        const double rho = b->density ? peri__least_density(b) : m->rho[i];
        double reach;
        if (!(t->stiffness > 0.0)) continue;
        t->loss = peri__loss_for(t->desc.restitution, t->stiffness / rho, c->hold, step, &reach);
        *wrong = t;
        *value = reach;
        if (t->loss > 1.0) return 0;
        c->growth = fmax(c->growth, 1.0 + t->loss);
    }
    return 1;
}

/* Records in `error` what is wrong with a description of contact, whose distance is at most `most` [L]. */
static int32_t peri__check_contact(const peri_contact_desc *d, double most, peri_error *error) {
    if (d->cookie != PERI_COOKIE_CONTACT) return peri__set_error(error, PERI_ERROR_DESCRIPTOR, "desc", -1, 0.0);
#define PERI_RANGE_(field, condition)                                                                                  \
    if (!(peri__finite(d->field) && (condition))) return peri__set_error(error, PERI_ERROR_RANGE, #field, -1, d->field)
    PERI_RANGE_(stiffness, d->stiffness > 0.0 && d->stiffness <= 1e3);
    PERI_RANGE_(distance, d->distance >= 0.0 && d->distance <= most);
    PERI_RANGE_(friction, d->friction >= 0.0 && d->friction <= 1e3);
    PERI_RANGE_(friction_speed, d->friction_speed >= 0.0);
    PERI_RANGE_(restitution, d->restitution > 0.0 && d->restitution <= 1.0);
#undef PERI_RANGE_
    return PERI_OK;
}

/* Declares d of materials i and j, each -1 for any, in the table. */
static void peri__declare_contact(const peri_body *b, peri__contact *c, int64_t i, int64_t j, const peri_contact_desc *d) {
    const peri__model *m = b->model;
    for (int32_t p = 0; p < m->materials; ++p)
        for (int32_t q = 0; q < m->materials; ++q) {
            const int those = (i < 0 || i == p) && (j < 0 || j == q), others = (i < 0 || i == q) && (j < 0 || j == p);
            peri__touch *t = &c->touch[p * m->materials + q];
            if (!those && !others) continue;
            memset(t, 0, sizeof *t);
            if (!d) continue;
            t->on = 1;
            t->desc = *d;
            t->distance = d->distance > 0.0 ? d->distance / m->length : m->spacing;
            t->friction = d->friction;
            t->friction_speed = d->friction_speed / peri__velocity_unit(m);
        }
}

/* -1 of PERI_ALL; below that an error. */
static int64_t peri__material_or_all(peri_body *b, int32_t id, const char *field) {
    const int64_t at = id == PERI_ALL ? -1 : peri__find(b, PERI_KIND_MATERIAL, id, field);
    return id != PERI_ALL && at < 0 ? at - 1 : at;
}

/* What the contact of the body is to be: NULL, *failed, where it cannot be so; NULL, not *failed, where there is to be none. */
static peri__contact *peri__next_contact(peri_body *b, int64_t i, int64_t j, const peri_contact_desc *d, int *failed) {
    const int32_t pairs = b->model->materials * b->model->materials;
    peri__contact *c = peri__new_contact(b);
    const peri__touch *wrong = NULL;
    double value = 0.0;
    int ok = c && c->touch && c->mark;
    *failed = 0;
    if (ok && b->contact) memcpy(c->touch, b->contact->touch, (size_t)pairs * sizeof *c->touch);
    if (ok) peri__declare_contact(b, c, i, j, d);
    if (ok && !peri__fit_contact(b, c, &wrong, &value)) {
        (void)peri__fail(b, PERI_ERROR_RANGE, "restitution", -1, value);
        *failed = 1;
    } else if (!ok || (c->hold > 0.0 && !(c->drag = peri__new_drag(b)))) {
        (void)peri__fail(b, PERI_ERROR_MEMORY, "contact", -1, 0.0);
        *failed = 1;
    }
    if (!*failed && c->distance > 0.0) return c;
    peri__free_contact(b, c);
    return NULL;
}

PERI_API int32_t peri_set_contact(peri_body *b, int32_t i, int32_t j, const peri_contact_desc *d) {
    int failed;
    PERI_NEED_CHANGEABLE(b);
    PERI_NEED_WHOLE(b, "peri_set_contact");
    const int64_t p = peri__material_or_all(b, i, "i"), q = p < -1 ? -1 : peri__material_or_all(b, j, "j");
    if (p < -1 || q < -1) return (int32_t)(p < -1 ? p + 1 : q + 1);
    int32_t status = d ? peri__check_contact(d, b->desc.horizon, &b->error) : PERI_OK;
    if (status == PERI_OK) status = peri__note_energy(b);
    if (status < 0) return status;
    peri__contact *next = peri__next_contact(b, p, q, d, &failed);
    if (failed) return b->error.code;
    peri__free_contact(b, b->contact);
    b->contact = next;
    peri__changed(b, PERI__ACTION);
    return PERI_OK;
}
