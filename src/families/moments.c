/* SPDX-License-Identifier: MIT */
/* moments.c - tensors of the directions of bonds, and what bonds weigh in the moments of a family. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_QUARTICS 15 /* components of a symmetric tensor of rank 4 that differ: 5 in 2D, 15 in 3D                       */
#define PERI_FIT_SOFT 0.01 /* weight of |lambda|^2 in a compromise                                                         */

/* Root of how often the component of p times x, q times y and 4 - p - q times z occurs: of 4!/(p! q! r!). */
static const double peri__quartic_root[5][5] = { { 1.0, 2.0, 2.449489742783178, 2.0, 1.0 },
                                                 { 2.0, 3.4641016151377544, 3.4641016151377544, 2.0, 0.0 },
                                                 { 2.449489742783178, 3.4641016151377544, 2.449489742783178, 0.0, 0.0 },
                                                 { 2.0, 2.0, 0.0, 0.0, 0.0 },
                                                 { 1.0, 0.0, 0.0, 0.0, 0.0 } };

/* The tensor n n n n by its components, each times that root: then sums of products are contractions, and no rotation changes them. Returns
   their number. n has three entries. */
static int peri__quartics(int32_t dim, const double *n, double *component) {
    double power[3][5];
    int count = 0;
    for (int d = 0; d < 3; ++d) {
        power[d][0] = 1.0;
        for (int k = 1; k < 5; ++k) power[d][k] = power[d][k - 1] * n[d];
    }
    for (int p = 4; p >= 0; --p)
        for (int q = 4 - p; q >= (dim == 2 ? 4 - p : 0); --q)
            component[count++] = peri__quartic_root[p][q] * power[0][p] * power[1][q] * power[2][4 - p - q];
    return count;
}

/* Its mean over all directions n. */
static void peri__isotropic_quartic(int32_t dim, double *component) {
    for (int p = 4; p >= 0; --p)
        for (int q = 4 - p; q >= (dim == 2 ? 4 - p : 0); --q) {
            const int r = 4 - p - q, odd = p % 2 || q % 2 || r % 2, pure = p == 4 || q == 4 || r == 4;
            *component++ = odd ? 0.0 : peri__quartic_root[p][q] * (pure ? 3.0 : 1.0) / (dim * (dim + 2));
        }
}

typedef struct peri__fitter {
    peri__cloud *cloud;
    double      *factor; /* [entries] of the own half of each bond                                                       */
    double       full;   /* sum w |xi| V over a full horizon                                                             */
    double       whole;  /* its volume                                                                                   */
} peri__fitter;

/* What bond k of point i adds to m, and its direction. */
static double peri__stiff(const peri__fitter *f, int64_t i, int64_t k, double *n) {
    const peri__model *m = f->cloud->model;
    int64_t at = m->start[i] + k, j = m->ids[at];
    double bond = 0.0, weight = peri__weight_of(m, i, m->weight, at);
    for (int32_t d = 0; d < m->dim; ++d) {
        n[d] = f->cloud->x[j * m->dim + d] - f->cloud->x[i * m->dim + d];
        bond += n[d] * n[d];
    }
    bond = sqrt(bond);
    for (int32_t d = 0; d < m->dim; ++d) n[d] /= bond;
    return m->laws[m->material[i]].pairwise ? weight * bond : weight * bond * bond;
}
