/* SPDX-License-Identifier: MIT */
/* flow.c - bonds of LPS with an inelastic extension c (Mitchell 2011, SAND2011-3166 and SAND2011-8064): T = w (p g + q (e - c)) M.

   With the deviatoric extension e' = e - theta |xi|/D the stored energy is W = bulk theta^2/2 + q/2 sum w (e' - c)^2 V; T is its derivative
   where c is deviatoric, sum w |xi| c V = 0. It is where the bonds stay; of those left after others broke the part along |xi| is taken out.

   Plastic: x = e' - c of the last step is held to |x|^2 = sum w x^2 V <= R^2 by c -> e' - x R/|x|, so that c grows along T' over w. That is
   Mitchell's t'.t'/2 <= psi_0 for w = 1. In shear e' = gamma xi_1 xi_2/|xi|, so that |x|^2 = gamma^2 m/(D (D + 2)) on the mean over the
   directions of the shear, and tau = mu gamma: R^2 = tau^2 m/(D (D + 2) mu^2), m of the family itself. In the ball of radius h, w = 1, 3D:
   psi_0 = 75 tau^2/(8 pi h^5), Mitchell's 25 Y^2/(8 pi h^5) with tau = Y/sqrt(3); in the plane 4 tau^2/m.
   What it takes, q sum w (x_old + x_new)/2 dc V, is never negative, since |x_old| <= |x_new| and dc is along x_new; by the trapezoidal rule
   the balance of energies is exact.

   Viscous: c = sum of parts times back extensions b, db/dt = (e' - b)/tau. e' is linear in time over a step, and b then known:
       b -> b E + e'_old (1 - E) + (1 - kappa) (e' - e'_old),    E = exp(-r), kappa = (1 - E)/r, r = step/tau
   W has q part/2 sum w (e' - b)^2 V for that part, and what is taken is the integral of q part w (e' - b)^2/tau.

   History per directed bond: e', then c, or the b of each part. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

typedef struct peri__flow { /* a pass over the points                                                                    */
    const peri_body *body;
    const void      *u, *p; /* displacements; a change of them, or NULL                                                  */
    void            *out;   /* real [dim][stride]: force density, to which is added                                      */
    double           step;  /* inner units                                                                               */
    int              commit;
    double          *density; /* of energies: [points], or NULL                                                          */
} peri__flow;

static const peri_material_desc *peri__flowing(const peri_body *b, int64_t i) {
    const peri_material_desc *m = &b->materials[b->model->material[i]];
    return peri__inelastic_of(m) & PERI__FLOWS ? m : NULL;
}

typedef struct peri__flow_bond { /* a bond, deformed                                                                     */
    double length, now, e, along[3]; /* |xi|, |y|, e, M                                                                  */
    double change[3], de;            /* d eta, M.d eta                                                                   */
} peri__flow_bond;

/* dim and f32 are constants where this is inlined. */
PERI_INLINE void peri__flow_deform_as(const peri__flow *f, int64_t i, const peri__row *row, int64_t k, peri__flow_bond *bond, int32_t dim,
                                      int32_t f32) {
    const peri_body *b = f->body;
    const peri__model *m = b->model;
    const int linear = b->desc.geometry == PERI_GEOMETRY_LINEAR;
    const int64_t j = row->ids[k];
    double xi[3] = { 0.0, 0.0, 0.0 }, product = 0.0, square = 0.0;
    for (int d = 0; d < dim; ++d) {
        const int64_t from = d * m->stride + i, to = d * m->stride + j;
        xi[d] = peri__get_real(m->x, f32, to) - peri__get_real(m->x, f32, from);
        const double eta = peri__get_real(f->u, f32, to) - peri__get_real(f->u, f32, from);
        bond->along[d] = linear ? xi[d] : xi[d] + eta;
        bond->change[d] = f->p ? peri__get_real(f->p, f32, to) - peri__get_real(f->p, f32, from) : 0.0;
        product += (linear ? xi[d] : 2.0 * xi[d] + eta) * eta;
        square += bond->along[d] * bond->along[d];
    }
    bond->length = peri__get_real(row->bond, b->b32, k);
    bond->now = sqrt(square) + DBL_MIN;
    bond->e = product / (linear ? bond->length : bond->now + bond->length);
    bond->de = 0.0;
    for (int d = 0; d < dim; ++d) {
        bond->along[d] /= bond->now;
        bond->de += bond->along[d] * bond->change[d];
    }
}

static void peri__flow_deform(const peri__flow *f, int64_t i, const peri__row *row, int64_t k, peri__flow_bond *bond) {
    const int32_t dim = f->body->dim, f32 = f->body->f32;
    if (f32) peri__flow_deform_as(f, i, row, k, bond, dim, 1);
    else if (dim == 2) peri__flow_deform_as(f, i, row, k, bond, 2, 0);
    else peri__flow_deform_as(f, i, row, k, bond, 3, 0);
}

/* The family of a flowing point: m, q, and where its bonds begin in the arrays. */
typedef struct peri__flow_point {
    int64_t   first;
    double    m, live, q; /* live: m of the bonds that are left                                                          */
    peri__row row;
} peri__flow_point;

static void peri__flow_read(const peri__flow *f, int64_t i, peri__flow_point *point) {
    const peri_body *b = f->body;
    peri__read_row(b, i, &point->row);
    point->first = b->past.start[i];
    point->m = b->model->dim / peri__get_constant(b, i, PERI__THETA_FACTOR);
    point->q = peri__get_constant(b, i, PERI__SPRING);
    point->live = point->m;
    if (b->desc.moments == PERI_MOMENTS_LIVE) return;
    point->live = DBL_MIN;
    for (int64_t k = 0; k < point->row.count; ++k)
        if (peri__is_alive(b, i, k))
            point->live += peri__weight_of(b->model, i, point->row.weight, k) * peri__square(peri__get_real(point->row.bond, b->b32, k));
}

/* sum w |xi| a V over the live bonds */
static double peri__flow_dilation(const peri__flow *f, int64_t i, const peri__flow_point *point, const double *a, int64_t step) {
    const peri_body *b = f->body;
    double sum = 0.0;
    for (int64_t k = 0; k < point->row.count; ++k)
        if (peri__is_alive(b, i, k))
            sum += peri__weight_of(b->model, i, point->row.weight, k) * peri__get_real(point->row.bond, b->b32, k) * a[k * step];
    return sum;
}

/* Takes that part out: a -= |xi| sum/m. */
static void peri__flow_project(const peri__flow *f, int64_t i, const peri__flow_point *point, double *a, int64_t step) {
    const double part = peri__flow_dilation(f, i, point, a, step) / point->live;
    for (int64_t k = 0; k < point->row.count; ++k)
        if (peri__is_alive(f->body, i, k)) a[k * step] -= peri__get_real(point->row.bond, f->body->b32, k) * part;
}

/* The deviatoric extensions of the family to out, 0 of bonds that are gone; `change`: their changes. */
static void peri__flow_deviate(const peri__flow *f, int64_t i, const peri__flow_point *point, int change, double *out) {
    for (int64_t k = 0; k < point->row.count; ++k) {
        peri__flow_bond bond;
        out[k] = 0.0;
        if (!peri__is_alive(f->body, i, k)) continue;
        peri__flow_deform(f, i, &point->row, k, &bond);
        out[k] = change ? bond.de : bond.e;
    }
    peri__flow_project(f, i, point, out, 1); /* theta |xi|/D is just that part */
}

/* R of a point. */
static double peri__flow_radius(const peri_body *b, int64_t i, const peri__flow_point *point) {
    const peri__model *m = b->model;
    const double strain = peri__flowing(b, i)->yield_shear / m->stress / m->laws[m->material[i]].mu;
    return strain * sqrt(point->m / (m->dim * (m->dim + 2)));
}

/* ---- what a step makes of a point: sums a: energy over that of e alone, b: what is taken ------------------------------ */

/* body->past.flow holds e', and then c. */
static void peri__flow_plastic(const peri__flow *f, int64_t i, peri__flow_point *point, double *stored, double *taken) {
    const peri_body *b = f->body;
    const int64_t reals = b->model->past.bond;
    double *c = b->past.flow + point->first, *past = b->past.bond + point->first * reals, square = 0.0;
    const double part = peri__flow_dilation(f, i, point, past + 1, reals) / point->live, radius = peri__flow_radius(b, i, point);
    for (int64_t k = 0; k < point->row.count; ++k) {
        const double old = past[k * reals + 1] - part * peri__get_real(point->row.bond, b->b32, k);
        if (peri__is_alive(b, i, k)) square += peri__weight_of(b->model, i, point->row.weight, k) * peri__square(c[k] - old);
    }
    const double keep = square > radius * radius ? radius / sqrt(square) : 1.0;
    for (int64_t k = 0; k < point->row.count; ++k) {
        double *own = past + k * reals;
        if (!peri__is_alive(b, i, k)) continue;
        const double w = peri__weight_of(b->model, i, point->row.weight, k), e = c[k];
        const double old = own[1] - part * peri__get_real(point->row.bond, b->b32, k), x = keep * (e - old);
        const double flowed = keep < 1.0 ? e - x : old;
        *stored += 0.5 * point->q * w * (x * x - e * e);
        *taken += 0.5 * point->q * w * (own[0] - own[1] + x) * (flowed - old);
        c[k] = flowed;
        if (f->commit) own[0] = e, own[1] = flowed;
    }
}

typedef struct peri__relaxing { /* a part of the stiffness over a step                                                    */
    double part, stays, gone, kappa, ratio; /* E, 1 - E, kappa and r of the step                                          */
} peri__relaxing;

static peri__relaxing peri__relaxing_of(const peri_body *b, const peri_material_desc *material, int k, double step) {
    peri__relaxing r;
    r.part = material->relaxation_part[k];
    r.ratio = fmin(step * b->model->time / material->relaxation_time[k], 1e100); /* its inverse has a square */
    r.stays = exp(-r.ratio);
    r.gone = -expm1(-r.ratio);
    r.kappa = r.ratio > 0.0 ? r.gone / r.ratio : 1.0;
    return r;
}

/* b of the old b, e' old and new; what the dashpot takes, over q w, is added to *taken. x = e' - b goes from x0 to x0 E + rise (1 - E). */
static double peri__relax_bond(const peri__relaxing *r, double back, double old, double e, double *taken) {
    if (!(r->ratio > 0.0)) return back;
    const double rise = (e - old) / r->ratio, left = old - back - rise;
    *taken += r->part * (left * left * 0.5 * r->gone * (1.0 + r->stays) + 2.0 * rise * left * r->gone + rise * rise * r->ratio);
    return back * r->stays + old * r->gone + (1.0 - r->kappa) * (e - old);
}

static void peri__flow_viscous(const peri__flow *f, int64_t i, peri__flow_point *point, double *stored, double *taken) {
    const peri_body *b = f->body;
    const peri_material_desc *material = peri__flowing(b, i);
    const int64_t reals = b->model->past.bond;
    double *c = b->past.flow + point->first, *past = b->past.bond + point->first * reals;
    peri__relaxing relaxing[PERI_RELAXATIONS];
    for (int n = 0; n < material->relaxations; ++n) relaxing[n] = peri__relaxing_of(b, material, n, f->step);
    for (int64_t k = 0; k < point->row.count; ++k) {
        double *own = past + k * reals;
        if (!peri__is_alive(b, i, k)) continue;
        const double w = peri__weight_of(b->model, i, point->row.weight, k), e = c[k];
        double sum = 0.0, lost = 0.0;
        for (int n = 0; n < material->relaxations; ++n) {
            const double back = peri__relax_bond(&relaxing[n], own[1 + n], own[0], e, &lost);
            sum += relaxing[n].part * back;
            *stored += 0.5 * point->q * w * relaxing[n].part * (peri__square(e - back) - e * e);
            if (f->commit) own[1 + n] = back;
        }
        *taken += point->q * w * lost;
        c[k] = sum;
        if (f->commit) own[0] = e;
    }
    peri__flow_project(f, i, point, c, 1);
}

static void peri__flow_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__flow *f = (const peri__flow *)context;
    const peri_body *b = f->body;
    peri__flow_point point;
    for (int64_t i = begin; i < end; ++i) {
        const peri_material_desc *material = peri__flowing(b, i);
        double stored = 0.0, taken = 0.0;
        if (!material) continue;
        peri__flow_read(f, i, &point);
        peri__flow_deviate(f, i, &point, 0, b->past.flow + point.first);
        if (material->yield_shear > 0.0) peri__flow_plastic(f, i, &point, &stored, &taken);
        else peri__flow_viscous(f, i, &point, &stored, &taken);
        if (f->density) f->density[i] += stored;
        sums->a += stored * b->model->volume[i];
        sums->b += taken * b->model->volume[i];
    }
}

/* Makes body->past.flow, the inelastic extension under u a step after the history, which takes it where `commit`. */
static peri__sums peri__make_flow(const peri_body *b, const void *u, double step, int commit, double *density) {
    peri__flow f = { b, u, NULL, NULL, step, commit, density };
    peri__for_points(b, b->model->points, 8 * b->model->width, peri__flow_block, &f, b->sums);
    return peri__total(b->sums, b->model->points);
}

/* ---- forces ------------------------------------------------------------------------------------------------------- */

/* Both halves of a bond, over its direction: from either end the same to the last bit. a: [bonds]. */
static double peri__flow_pull(const peri_body *b, int64_t i, const peri__row *row, int64_t k, const double *a) {
    const int64_t j = row->ids[k], at = b->past.start[i] + k, other = b->past.start[j] + b->past.mirror[at];
    double pull = 0.0;
    if (a[at] != 0.0) pull += peri__weight_of(b->model, i, row->weight, k) * peri__get_constant(b, i, PERI__SPRING) * a[at];
    if (a[other] != 0.0) pull += peri__weight_of(b->model, i, row->back, k) * peri__get_constant(b, j, PERI__SPRING) * a[other];
    return pull;
}

static void peri__flow_force_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__flow *f = (const peri__flow *)context;
    const peri_body *b = f->body;
    const peri__model *m = b->model;
    const int linear = b->desc.geometry == PERI_GEOMETRY_LINEAR;
    peri__row row;
    (void)sums;
    for (int64_t i = begin; i < end; ++i) {
        double sum[3] = { 0.0, 0.0, 0.0 };
        peri__read_row(b, i, &row);
        for (int64_t k = 0; k < row.count; ++k) {
            peri__flow_bond bond;
            if (!peri__is_alive(b, i, k)) continue;
            const double pull = peri__flow_pull(b, i, &row, k, b->past.flow);
            const double change = f->p ? peri__flow_pull(b, i, &row, k, b->past.change) : 0.0;
            if (pull == 0.0 && change == 0.0) continue;
            peri__flow_deform(f, i, &row, k, &bond);
            for (int d = 0; d < m->dim; ++d) {
                if (!f->p) sum[d] -= pull * bond.along[d];
                else sum[d] -= change * bond.along[d];
                if (f->p && !linear) sum[d] -= pull / bond.now * (bond.change[d] - bond.along[d] * bond.de);
            }
        }
        for (int d = 0; d < m->dim; ++d) {
            const int64_t at = d * m->stride + i;
            peri__put_real(f->out, b->f32, at, peri__get_real(f->out, b->f32, at) + sum[d]);
        }
    }
}

/* Adds to `force` what body->past.flow, made of u, takes from the elastic force. */
static void peri__add_flow(const peri_body *b, const void *u, void *force) {
    peri__flow f = { b, u, NULL, force, 0.0, 0, NULL };
    peri__for_points(b, b->model->points, 4 * b->model->width, peri__flow_force_block, &f, NULL);
}

/* ---- the tangent: dc of a change of e', to body->past.change ----------------------------------------------------------- */

/* dc = (1 - keep) de' + x (sum w x de' V)/|x|^2 keep of what yields; x that before the return. past.change holds de'. */
static void peri__flow_change_plastic(const peri__flow *f, int64_t i, peri__flow_point *point, double *change) {
    const peri_body *b = f->body;
    const int64_t reals = b->model->past.bond;
    const double *past = b->past.bond + point->first * reals, radius = peri__flow_radius(b, i, point);
    const double part = peri__flow_dilation(f, i, point, past + 1, reals) / point->live;
    double *x = b->past.flow + point->first, square = 0.0, along = 0.0;
    peri__flow_deviate(f, i, point, 0, x);
    for (int64_t k = 0; k < point->row.count; ++k) {
        if (!peri__is_alive(b, i, k)) continue;
        const double w = peri__weight_of(b->model, i, point->row.weight, k);
        x[k] -= past[k * reals + 1] - part * peri__get_real(point->row.bond, b->b32, k);
        square += w * x[k] * x[k];
        along += w * x[k] * change[k];
    }
    const double keep = square > radius * radius ? radius / sqrt(square) : 1.0;
    for (int64_t k = 0; k < point->row.count; ++k) {
        const double old = past[k * reals + 1] - part * peri__get_real(point->row.bond, b->b32, k);
        if (!peri__is_alive(b, i, k)) continue;
        change[k] = keep < 1.0 ? (1.0 - keep) * change[k] + keep * x[k] * along / square : 0.0;
        x[k] = old + (1.0 - keep) * x[k]; /* flow again */
    }
}

static void peri__flow_change_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__flow *f = (const peri__flow *)context;
    const peri_body *b = f->body;
    peri__flow_point point;
    (void)sums;
    for (int64_t i = begin; i < end; ++i) {
        const peri_material_desc *material = peri__flowing(b, i);
        if (!material) continue;
        peri__flow_read(f, i, &point);
        double *change = b->past.change + point.first, grown = 0.0;
        peri__flow_deviate(f, i, &point, 1, change);
        if (material->yield_shear > 0.0) {
            peri__flow_change_plastic(f, i, &point, change);
            continue;
        }
        for (int n = 0; n < material->relaxations; ++n) {
            const peri__relaxing r = peri__relaxing_of(b, material, n, f->step);
            grown += r.part * (1.0 - r.kappa);
        }
        for (int64_t k = 0; k < point.row.count; ++k) change[k] *= grown;
    }
}

/* Adds to q what a change p of the displacements u makes of that force, body->past.flow being that of u. */
static void peri__add_flow_change(const peri_body *b, const void *u, const void *p, double step, void *q) {
    peri__flow f = { b, u, p, q, step, 0, NULL };
    peri__for_points(b, b->model->points, 8 * b->model->width, peri__flow_change_block, &f, NULL);
    peri__for_points(b, b->model->points, 4 * b->model->width, peri__flow_force_block, &f, NULL);
}

/* ---- where bonds are ------------------------------------------------------------------------------------------------ */

static void peri__mirror_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    peri_body *b = (peri_body *)context;
    peri__row row;
    (void)sums;
    for (int64_t i = begin; i < end; ++i) {
        peri__read_row(b, i, &row);
        for (int64_t k = 0; k < row.count; ++k)
            b->past.mirror[b->past.start[i] + k] = (int32_t)peri__find_bond(b->model, row.ids[k], i);
    }
}

static void peri__find_mirrors(peri_body *b) {
    if (!b->past.start) return;
    for (int64_t i = 0; i < b->model->points; ++i) b->past.start[i + 1] = b->past.start[i] + b->model->count[i];
    peri__for_points(b, b->model->points, 8 * b->model->width, peri__mirror_block, b, NULL);
}
