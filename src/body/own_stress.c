/* SPDX-License-Identifier: MIT */
/* own_stress.c - correspondence with the stress of the caller (peri_stress_fn): P of H, and its change by dP/dH.

   Gathers leave H of such points where Q of the others is (peri__past_pass.raw); here the caller makes P of it, run by run of points of one
   material within a block, and Q = P K^-1 - k H takes its place. What the caller makes of the history is a trial: body->past.point takes it
   where the pass is to commit, once per step and per equilibrium. Whoever does not ask for this, as the search for the highest frequency
   and preconditioners do not, has the elasticity that the material was given. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

typedef struct peri__own { /* a pass over the points                                                                     */
    const peri_body *body;
    peri__operands  *operands;
    const void      *u;       /* of energies: where they are asked for                                                   */
    double          *density; /* of energies: [points], or NULL                                                          */
    void            *response;
} peri__own;

/* Points first, first + 1, ... of one material, `count`, and what the caller is given of them. */
typedef struct peri__own_run {
    int64_t first, count;
    double  gradient[PERI_BLOCK * 9], stress[PERI_BLOCK * 9], energy[PERI_BLOCK], dissipation[PERI_BLOCK];
} peri__own_run;

/* The next run from `i` on; 0 where none is left before `end`. */
static int peri__next_run(const peri__model *m, int64_t i, int64_t end, peri__own_run *run) {
    while (i < end && !m->past.raw[m->material[i]]) ++i;
    run->first = i;
    while (i < end && m->material[i] == m->material[run->first]) ++i;
    run->count = i - run->first;
    return run->count > 0;
}

/* Asks the caller for the stresses of a run, H being in run->gradient. sums: bad, n where that failed. */
static void peri__ask_stress(const peri__own *o, peri__own_run *run, double *moduli, peri__sums *sums) {
    const peri_body *b = o->body;
    const peri__model *m = b->model;
    const peri_material_desc *material = &b->materials[m->material[run->first]];
    const int64_t entries = m->dim * m->dim, past = m->past.point, own = material->history;
    double *trial = b->past.trial ? b->past.trial + run->first * past : NULL;
    int32_t points[PERI_BLOCK];
    peri_stress_block block;
    for (int64_t n = 0; n < run->count; ++n) points[n] = (int32_t)(run->first + n);
    for (int64_t n = 0; n < run->count; ++n)
        for (int64_t k = 0; k < own; ++k) trial[n * own + k] = b->past.point[(run->first + n) * past + k];
    memset(run->stress, 0, sizeof run->stress);
    memset(run->energy, 0, sizeof run->energy);
    memset(run->dissipation, 0, sizeof run->dissipation);
    block.count = run->count;
    block.points = points;
    block.gradient = run->gradient;
    block.time_step = o->operands->step * m->time;
    block.history = own > 0 ? trial : NULL;
    block.stress = run->stress;
    block.tangent = moduli;
    block.energy = run->energy;
    block.dissipation = run->dissipation;
    const int32_t said = material->stress(material->stress_user, &block);
    if (said < 0) sums->bad = run->first, sums->n = said;
    for (int64_t n = 0; said >= 0 && sums->bad < 0 && n < run->count; ++n) {
        int finite = peri__finite(run->energy[n]) && peri__finite(run->dissipation[n]);
        for (int64_t k = 0; k < entries; ++k) finite = finite && peri__finite(run->stress[n * entries + k]);
        for (int64_t k = 0; moduli && k < entries * entries; ++k) finite = finite && peri__finite(moduli[n * entries * entries + k]);
        for (int64_t k = 0; k < own; ++k) finite = finite && peri__finite(trial[n * own + k]);
        if (!finite) sums->bad = run->first + n, sums->n = 1;
    }
    if (sums->bad >= 0 || !o->operands->past.commit) return;
    for (int64_t n = 0; n < run->count; ++n) {
        sums->b += run->dissipation[n] / m->stress * m->volume[run->first + n];
        for (int64_t k = 0; k < own; ++k) b->past.point[(run->first + n) * past + k] = trial[n * own + k];
    }
}

/* H of a point, which the last pass left in `response`; and what P makes of it, over `unit`, in its place: Q = P K^-1 - k H. */
static void peri__take_raw(const peri_body *b, const void *response, int64_t i, double *h) {
    const peri__model *m = b->model;
    for (int k = 0; k < m->dim * m->dim; ++k) h[k] = peri__get_real(response, b->b32, (1 + k) * m->stride + i);
}

static void peri__put_stress(const peri_body *b, void *response, int64_t i, const double *h, const double *p, double unit) {
    const peri__model *m = b->model;
    const int dim = m->dim;
    double inverse[3][3];
    const double k = peri__get_constant(b, i, PERI__STABILIZATION);
    for (int a = 0; a < dim; ++a)
        for (int c = a; c < dim; ++c)
            inverse[a][c] = inverse[c][a] = peri__get_constant(b, i, PERI__SHAPE_INVERSE + peri__packed(dim, a, c));
    for (int a = 0; a < dim; ++a)
        for (int d = 0; d < dim; ++d) {
            double q = -k * h[a * dim + d];
            for (int c = 0; c < dim; ++c) q += p[a * dim + c] / unit * inverse[c][d];
            peri__put_real(response, b->b32, (1 + a * dim + d) * m->stride + i, q);
        }
}

static void peri__own_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__own *o = (const peri__own *)context;
    const peri_body *b = o->body;
    const peri__model *m = b->model;
    const int64_t entries = m->dim * m->dim;
    peri__own_run run;
    for (int64_t i = begin; peri__next_run(m, i, end, &run); i = run.first + run.count) {
        double *moduli = o->operands->past.moduli ? o->operands->past.moduli + run.first * entries * entries : NULL;
        for (int64_t n = 0; n < run.count; ++n) peri__take_raw(b, o->response, run.first + n, &run.gradient[n * entries]);
        peri__ask_stress(o, &run, moduli, sums);
        if (sums->bad >= 0) return;
        for (int64_t n = 0; n < run.count; ++n)
            peri__put_stress(b, o->response, run.first + n, &run.gradient[n * entries], &run.stress[n * entries], m->stress);
    }
}

/* The first failure, by block. */
static void peri__note_stress(peri_body *b, const peri__sums *sums) {
    for (int64_t k = 0; b->past.said == 0 && k < b->model->blocks; ++k)
        if (sums[k].bad >= 0) {
            b->past.said = (int32_t)sums[k].n;
            b->past.said_at = sums[k].bad;
        }
}

/* Puts Q where H is. Returns what is dissipated, of a pass that commits. */
static double peri__own_stresses(const peri_body *b, peri__operands *operands) {
    peri__own own = { b, operands, NULL, NULL, operands->response };
    peri_body *told = (peri_body *)b; /* of what went wrong alone */
    const int32_t former = peri__enter(told, PERI__IN_CALLBACK);
    peri__for_points(b, b->model->points, 16, peri__own_block, &own, b->sums);
    peri__leave(told, former);
    peri__note_stress(told, b->sums);
    return peri__total(b->sums, b->model->points).b;
}

/* A failure of a peri_stress_fn since this was last asked. */
static int32_t peri__heed_stress(peri_body *b) {
    const int32_t said = b->past.said;
    b->past.said = 0;
    return said ? peri__fail(b, PERI_ERROR_CALLBACK, "peri_stress_fn", b->past.said_at, said) : PERI_OK;
}

/* ---- the tangent -------------------------------------------------------------------------------------------------- */

static void peri__own_change_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__own *o = (const peri__own *)context;
    const peri_body *b = o->body;
    const peri__model *m = b->model;
    const int entries = m->dim * m->dim;
    (void)sums;
    for (int64_t i = begin; i < end; ++i) {
        const double *moduli = o->operands->past.moduli + i * entries * entries;
        double h[9], p[9];
        if (!m->past.raw[m->material[i]]) continue;
        peri__take_raw(b, o->response, i, h);
        for (int k = 0; k < entries; ++k) {
            p[k] = 0.0;
            for (int l = 0; l < entries; ++l) p[k] += moduli[k * entries + l] * h[l];
        }
        peri__put_stress(b, o->response, i, h, p, m->stress);
    }
}

/* Puts dQ where dH is. */
static void peri__own_changes(const peri_body *b, peri__operands *operands, void *change) {
    peri__own own = { b, operands, NULL, NULL, change };
    peri__for_points(b, b->model->points, 4, peri__own_change_block, &own, NULL);
}

static int64_t peri__moduli_reals(const peri__model *m) {
    return m->inelastic & PERI__OWN_STRESS ? m->points * m->dim * m->dim * m->dim * m->dim : 0;
}

/* ---- energy, and stress by itself --------------------------------------------------------------------------------- */

/* H of a point under the displacements u, as gathers make it. */
static void peri__gradient_under(const peri_body *b, const void *u, int64_t i, double *h) {
    const peri__model *m = b->model;
    const int dim = m->dim;
    double n[9] = { 0.0 };
    peri__row row;
    peri__read_row(b, i, &row);
    for (int64_t k = 0; k < row.count; ++k) {
        double xi[3] = { 0.0, 0.0, 0.0 };
        const double w = peri__weight_of(m, i, row.weight, k);
        if (!peri__is_alive(b, i, k)) continue;
        peri__bond_of(m, b->f32, i, row.ids[k], xi);
        for (int a = 0; a < dim; ++a) {
            const double eta = peri__get_real(u, b->f32, a * m->stride + row.ids[k]) - peri__get_real(u, b->f32, a * m->stride + i);
            for (int d = 0; d < dim; ++d) n[a * dim + d] += w * eta * xi[d];
        }
    }
    for (int a = 0; a < dim; ++a)
        for (int d = 0; d < dim; ++d) {
            h[a * dim + d] = 0.0;
            for (int c = 0; c < dim; ++c)
                h[a * dim + d] += n[a * dim + c] * peri__get_constant(b, i, PERI__SHAPE_INVERSE + peri__packed(dim, c, d));
        }
}

/* sums->a: what the caller says is stored, over what the elasticity of the material would store. */
static void peri__own_energy_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__own *o = (const peri__own *)context;
    const peri_body *b = o->body;
    const peri__model *m = b->model;
    const int dim = m->dim;
    peri__own_run run;
    for (int64_t i = begin; peri__next_run(m, i, end, &run); i = run.first + run.count) {
        for (int64_t n = 0; n < run.count; ++n) peri__gradient_under(b, o->u, run.first + n, &run.gradient[n * dim * dim]);
        peri__ask_stress(o, &run, NULL, sums);
        if (sums->bad >= 0) return;
        for (int64_t n = 0; n < run.count; ++n) {
            double h[3][3] = { { 0.0 } }, strain[3][3];
            for (int a = 0; a < dim; ++a) memcpy(h[a], &run.gradient[(n * dim + a) * dim], (size_t)dim * sizeof(double));
            peri__strain(dim, b->desc.geometry == PERI_GEOMETRY_LINEAR, h, strain);
            const double more = run.energy[n] / m->stress - peri__strain_energy(&m->laws[m->material[run.first]], dim, strain);
            if (o->density) o->density[run.first + n] += more;
            sums->a += more * m->volume[run.first + n];
        }
    }
}

static double peri__own_energy(peri_body *b, const void *u, double *density) {
    peri__operands operands;
    peri__own own = { b, &operands, u, density, NULL };
    memset(&operands, 0, sizeof operands);
    const int32_t former = peri__enter(b, PERI__IN_CALLBACK);
    peri__for_points(b, b->model->points, 4 * b->model->width, peri__own_energy_block, &own, b->sums);
    peri__leave(b, former);
    peri__note_stress(b, b->sums);
    return peri__total(b->sums, b->model->points).a;
}
