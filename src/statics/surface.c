/* SPDX-License-Identifier: MIT */
/* surface.c - tractions and pressures spread over a horizon, so that they pass the patch test.

   Under a uniform strain the bonds give each point a force that vanishes inside and not near a surface: -sigma a_i for correspondence, with
   a_i the point's share of the surface's area vector. The traction that holds this stress in place is the opposite of it. It is found by
   applying the stiffness at rest to the displacements eps x. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

/* The force density of all bonds to t->q, under the strain that makes the uniform stress sigma in a law; inner units. */
static void peri__stress_force(const peri__tangent *t, const peri__law *law, double sigma[3][3]) {
    peri_body *b = t->body;
    const peri__model *m = b->model;
    double trace = 0.0, strain[3][3];
    for (int d = 0; d < m->dim; ++d) trace += sigma[d][d];
    for (int a = 0; a < m->dim; ++a)
        for (int c = 0; c < m->dim; ++c)
            strain[a][c] = (sigma[a][c] - (a == c ? law->lambda * trace / (m->dim * law->lambda + 2.0 * law->mu) : 0.0)) / (2.0 * law->mu);
    for (int64_t i = 0; i < m->points; ++i)
        for (int a = 0; a < m->dim; ++a) {
            double u = 0.0;
            for (int c = 0; c < m->dim; ++c) u += strain[a][c] * peri__get_real(m->x, b->f32, c * m->stride + i);
            peri__put_real((void *)t->p, b->f32, a * m->stride + i, u);
        }
    peri__apply_tangent(t, 1);
}

/* A load on a surface in the making. */
typedef struct peri__surface {
    int32_t       set;
    const double *normal; /* unit; NULL: pressure                                                                        */
    double        area;   /* inner units                                                                                 */
    peri__tangent t;
    double       *spread;
} peri__surface;

/* An orthonormal frame whose first axis is n. */
static void peri__frame(int dim, const double *n, double frame[3][3]) {
    int least = 0;
    memset(frame, 0, 9 * sizeof **frame);
    for (int d = 0; d < dim; ++d) {
        frame[0][d] = n[d];
        if (fabs(n[d]) < fabs(n[least])) least = d;
    }
    if (dim == 2) {
        frame[1][0] = -n[1];
        frame[1][1] = n[0];
        return;
    }
    double along[3] = { 0.0, 0.0, 0.0 }, length;
    along[least] = 1.0;
    peri__cross(n, along, frame[1]);
    length = sqrt(peri__dot(frame[1], frame[1], 3));
    for (int d = 0; d < 3; ++d) frame[1][d] /= length;
    peri__cross(n, frame[1], frame[2]);
}

/* Does the set feel about the area, of which `total` is what it feels? */
static int32_t peri__check_area(peri_body *b, const peri__surface *f, const peri__law *law, double total) {
    const int exact = (law->gather & PERI__GRADIENT) != 0;
    const double felt = total / f->area; /* of uncorrected laws up to twice too much */
    if (felt > (exact ? 0.5 : 0.25) && felt < (exact ? 1.5 : 4.0)) return PERI_OK;
    return peri__fail(b, PERI_ERROR_AREA, "area", -1, total * pow(b->model->length, b->model->dim - 1));
}

/* Adds to f->spread the dyads of the axes first..last of the frame, times the share that place k of the set has: scale times that of
   share[k], or (NULL) of the force along the one axis. */
static void peri__add_shares(peri_body *b, peri__surface *f, double frame[3][3], int first, int last, const double *share, double scale) {
    const peri__model *m = b->model;
    const int dim = m->dim;
    for (int64_t k = 0; k < peri__set_count(b, f->set); ++k) {
        double own = share ? scale * share[k] : 0.0;
        for (int d = 0; !share && d < dim; ++d)
            own += scale * frame[first][d] * peri__get_real(f->t.q, b->f32, d * m->stride + peri__set_point(b, f->set, k));
        for (int c = first; c <= last; ++c)
            for (int p = 0; p < dim; ++p)
                for (int q = 0; q < dim; ++q) f->spread[(k * dim + p) * dim + q] += own * frame[c][p] * frame[c][q];
    }
}

/* The forces of the bonds under the stress t n + n t (n n for n itself), t axis c of the frame of n; what of them lies along t, over the
   set: returned as a total, and added to share[k] unless that is NULL. */
static double peri__feel(peri_body *b, peri__surface *f, const peri__law *law, double frame[3][3], int c, double *share) {
    const peri__model *m = b->model;
    const int dim = m->dim;
    const double *n = frame[0];
    double sigma[3][3] = { { 0.0 } }, total = 0.0;
    for (int p = 0; p < dim; ++p)
        for (int q = 0; q < dim; ++q) sigma[p][q] = c == 0 ? n[p] * n[q] : frame[c][p] * n[q] + n[p] * frame[c][q];
    peri__stress_force(&f->t, law, sigma);
    for (int64_t k = 0; k < peri__set_count(b, f->set); ++k) {
        int64_t i = peri__set_point(b, f->set, k);
        for (int d = 0; d < dim; ++d) {
            const double along = frame[c][d] * peri__get_real(f->t.q, b->f32, d * m->stride + i);
            total -= m->volume[i] * frame[c][d] * peri__get_real(f->t.q, b->f32, d * m->stride + i);
            if (share) share[k] += along;
        }
    }
    return total;
}

/* The share of each point in what holds the stress n n, along n, and t n + n t, along t. Of tangents t in 3D the mean over all directions
   counts, half the trace over two of them: which two the frame has depends on the axes of the coordinates. */
static int32_t peri__fill_traction(peri_body *b, peri__surface *f, const peri__law *law) {
    const int64_t count = peri__set_count(b, f->set);
    const int dim = b->model->dim, exact = (law->gather & PERI__GRADIENT) != 0;
    double frame[3][3], total;
    int32_t status = PERI_OK;
    peri__frame(dim, f->normal, frame);
    for (int c = 0; c < 2 && status == PERI_OK; ++c) {
        double *share = NULL;
        if (c == 1 && dim == 3) {
            share = (double *)peri__new(&b->scratch, count, sizeof *share);
            if (!share) return peri__fail(b, PERI_ERROR_MEMORY, "load", -1, 0.0);
        }
        total = peri__feel(b, f, law, frame, c, share);
        if (share) total = 0.5 * (total + peri__feel(b, f, law, frame, 2, share));
        status = peri__check_area(b, f, law, total);
        if (status == PERI_OK)
            peri__add_shares(b, f, frame, c, share ? 2 : c, share, (share ? 0.5 : 1.0) * (exact ? -1.0 : -f->area / total));
        peri__delete(&b->scratch, share, count, sizeof *share);
    }
    return status;
}

static void peri__fill_pressure(peri_body *b, peri__surface *f, const peri__law *law) {
    const peri__model *m = b->model;
    double sigma[3][3] = { { 0.0 } };
    for (int d = 0; d < m->dim; ++d) sigma[d][d] = 1.0;
    peri__stress_force(&f->t, law, sigma);
    for (int64_t k = 0; k < peri__set_count(b, f->set); ++k)
        for (int d = 0; d < m->dim; ++d)
            f->spread[(k * m->dim + d) * m->dim] = peri__get_real(f->t.q, b->f32, d * m->stride + peri__set_point(b, f->set, k));
}

/* Adds the load whose force density per value, inner units, is `spread`; takes it over, or frees it. */
static int32_t peri__add_spread(peri_body *b, int32_t set, double *spread, const double *value, peri_load_fn fn, void *user) {
    const int64_t count = peri__set_count(b, set) * b->dim * b->dim;
    int32_t load = peri__add_load(b, PERI__FORCE, set, (1 << b->dim) - 1, value, fn, user);
    if (load < 0) {
        peri__delete(&b->memory, spread, count, sizeof *spread);
        return load;
    }
    for (int64_t k = 0; k < count; ++k) spread[k] /= b->model->length;
    b->loads[load].spread = spread;
    return load;
}

static int32_t peri__apply_surface(peri_body *b, peri__surface *f, const double *value, peri_load_fn fn, void *user) {
    const peri__model *m = b->model;
    const int64_t count = peri__set_count(b, f->set) * b->dim * b->dim;
    int32_t status = PERI_OK, material = m->material[peri__set_point(b, f->set, 0)];
    for (int64_t k = 0; k < peri__set_count(b, f->set); ++k) {
        int32_t i = peri__set_point(b, f->set, k);
        if (m->material[i] != material) return peri__fail(b, PERI_ERROR_LAW, "set", i, 0.0);
    }
    if (m->centroid) return peri__fail(b, PERI_ERROR_LAW, "quadrature", -1, b->desc.quadrature);
    (void)peri__ensure(b, PERI__STALE_MASKS | PERI__STALE_CONSTANTS);
    void *p = peri__new_vector(b, &b->memory);
    f->t.body = b;
    f->t.p = p;
    f->t.q = peri__new_vector(b, &b->memory);
    f->t.change = !m->pairwise ? peri__new(&b->memory, peri__response_reals(m), peri__bond_real(b)) : NULL;
    f->spread = (double *)peri__new(&b->memory, count, sizeof *f->spread);
    if (!p || !f->t.q || (!m->pairwise && !f->t.change) || !f->spread) status = peri__fail(b, PERI_ERROR_MEMORY, "load", -1, 0.0);
    else if (f->normal) status = peri__fill_traction(b, f, &m->laws[material]);
    else peri__fill_pressure(b, f, &m->laws[material]);
    peri__delete_vector(b, &b->memory, p);
    peri__delete_vector(b, &b->memory, f->t.q);
    peri__delete(&b->memory, f->t.change, peri__response_reals(m), peri__bond_real(b));
    if (status == PERI_OK) return peri__load_id(b, peri__add_spread(b, f->set, f->spread, value, fn, user));
    peri__delete(&b->memory, f->spread, count, sizeof *f->spread);
    return status;
}

PERI_API int32_t peri_apply_traction(peri_body *b, int32_t id, double area, const double *normal, const double *value,
                                             peri_load_fn fn, void *user) {
    peri__surface f;
    double unit[3];
    PERI_NEED_CHANGEABLE(b);
    PERI_NEED_WHOLE(b, "peri_apply_traction");
    PERI_NEED_NUMBER(b, area > 0.0, area);
    PERI_NEED_VECTOR(b, normal);
    PERI_NEED(b, value || fn, "value");
    const int32_t set = peri__find_set(b, id);
    if (set < 0) return set;
    if (!peri__direction(normal, b->dim, unit)) return peri__fail(b, PERI_ERROR_RANGE, "normal", -1, 0.0);
    memset(&f, 0, sizeof f);
    f.set = set;
    f.normal = unit;
    f.area = area / pow(b->model->length, b->dim - 1);
    return peri__apply_surface(b, &f, value, fn, user);
}

PERI_API int32_t peri_apply_pressure(peri_body *b, int32_t id, double pressure, peri_load_fn fn, void *user) {
    peri__surface f;
    const double value[3] = { pressure, 0.0, 0.0 };
    PERI_NEED_CHANGEABLE(b);
    PERI_NEED_WHOLE(b, "peri_apply_pressure");
    PERI_NEED_NUMBER(b, 1, pressure);
    const int32_t set = peri__find_set(b, id);
    if (set < 0) return set;
    memset(&f, 0, sizeof f);
    f.set = set;
    return peri__apply_surface(b, &f, value, fn, user);
}

PERI_API int32_t peri_apply_bond_pressure_for_comparison(peri_body *b, int32_t id, double pressure, peri_load_fn fn, void *user) {
    const double value[3] = { pressure, 0.0, 0.0 };
    PERI_NEED_CHANGEABLE(b);
    PERI_NEED_WHOLE(b, "peri_apply_bond_pressure_for_comparison");
    PERI_NEED_NUMBER(b, 1, pressure);
    const int32_t set = peri__find_set(b, id);
    if (set < 0) return set;
    int32_t status = PERI_OK;
    const peri__model *m = b->model;
    const int64_t count = peri__set_count(b, set), entries = count * m->dim * m->dim;
    int64_t pairs = 0;
    uint8_t *inside = (uint8_t *)peri__new(&b->memory, m->points, 1);
    double *spread = (double *)peri__new(&b->memory, entries, sizeof *spread);
    if (!inside || !spread) status = peri__fail(b, PERI_ERROR_MEMORY, "load", -1, 0.0);
    for (int64_t k = 0; status == PERI_OK && k < count; ++k) inside[peri__set_point(b, set, k)] = 1;
    for (int64_t k = 0; status == PERI_OK && k < count; ++k) {
        int64_t i = peri__set_point(b, set, k);
        peri__row row;
        peri__read_row(b, i, &row);
        for (int64_t n = 0; n < row.count; ++n) {
            double xi[3] = { 0.0 }, bond = peri__get_real(row.bond, b->b32, n);
            if (peri__is_alive(b, i, n) || !inside[row.ids[n]] || bond > 1.2 * m->spacing) continue;
            peri__bond_of(m, b->f32, i, row.ids[n], xi);
            for (int d = 0; d < m->dim; ++d) spread[(k * m->dim + d) * m->dim] -= xi[d] / (bond * bond); /* face V/|xi|, over V */
            pairs++;
        }
    }
    peri__delete(&b->memory, inside, m->points, 1);
    if (status == PERI_OK && pairs == 0) status = peri__fail(b, PERI_ERROR_EMPTY, "set", id, 0.0);
    if (status == PERI_OK) return peri__load_id(b, peri__add_spread(b, set, spread, value, fn, user));
    peri__delete(&b->memory, spread, entries, sizeof *spread);
    return status;
}
