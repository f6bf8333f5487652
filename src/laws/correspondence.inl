/* SPDX-License-Identifier: MIT */
/* correspondence.inl - Saint Venant-Kirchhoff material by the correspondence of F = 1 + H ([T] 1.80, [C] 18-21):

       H = (sum w eta xi V) K^-1,    E = (H + H^T + H^T H)/2,    S = lambda tr(E) + 2 mu E,    P = F S
       half = P K^-1 xi + k (eta - H xi),    so Q = P K^-1 - k H

   k = G B/m is the stabilisation: it vanishes for linear fields and resists what F does not see. Linear geometry: E without H^T H, P = S. A
   family that spans too little has no K^-1 and acts by central bonds, q = B/m. */
#ifdef PERI_LAW_ROLE_TRAITS
enum { PERI__GATHER_correspondence = PERI__GRADIENT, PERI__GAUGE_correspondence = 0, PERI__PAIRWISE_correspondence = 0,
       PERI__BY_A_correspondence = 0 };
#endif

#ifdef PERI_LAW_ROLE_CALIBRATION
static int peri__calibrate_correspondence(const peri__law *law, int32_t dim, const peri__moments *sum, peri__calibration *r) {
    if (peri__invert(dim, sum->shape, PERI_SPAN, r->shape_inverse) == dim) {
        r->stabilization = law->stabilization * law->b / sum->m;
        return 1;
    }
    memset(r->shape_inverse, 0, sizeof r->shape_inverse);
    return 0;
}
#endif

#ifdef PERI_LAW_ROLE_STRESS
/* lambda tr(e) + 2 mu e, in place: S of E, and their changes alike. */
static void PERI_S_FN(hooke_correspondence)(const peri__law *law, int dim, peri_s e[PERI_S_DIM][PERI_S_DIM]) {
    const peri_s lambda = (peri_s)law->lambda, mu2 = (peri_s)(2.0 * law->mu);
    peri_s trace = 0;
    for (int a = 0; a < dim; ++a) trace += e[a][a];
    for (int a = 0; a < dim; ++a)
        for (int d = 0; d < dim; ++d) e[a][d] = mu2 * e[a][d] + (a == d ? lambda * trace : 0);
}

/* P of the strain e, which is lost, at H. */
static void PERI_S_FN(stress_correspondence)(const peri__law *law, int dim, int linear, peri_s h[PERI_S_DIM][PERI_S_DIM],
                              peri_s e[PERI_S_DIM][PERI_S_DIM], peri_s p[PERI_S_DIM][PERI_S_DIM]) {
    PERI_S_FN(hooke_correspondence)(law, dim, e);
    for (int a = 0; a < dim; ++a)
        for (int d = 0; d < dim; ++d) {
            p[a][d] = e[a][d];
            for (int c = 0; !linear && c < dim; ++c) p[a][d] += h[a][c] * e[c][d];
        }
}

/* dP where H changes by dh; e: the strain at H, which is lost. */
static void PERI_S_FN(stress_change_correspondence)(const peri__law *law, int dim, int linear, peri_s h[PERI_S_DIM][PERI_S_DIM],
                                     peri_s e[PERI_S_DIM][PERI_S_DIM], peri_s dh[PERI_S_DIM][PERI_S_DIM],
                                     peri_s dp[PERI_S_DIM][PERI_S_DIM]) {
    peri_s ds[PERI_S_DIM][PERI_S_DIM];
    PERI_S_FN(strain_change)(dim, linear, h, dh, ds);
    PERI_S_FN(hooke_correspondence)(law, dim, e);
    PERI_S_FN(hooke_correspondence)(law, dim, ds);
    for (int a = 0; a < dim; ++a)
        for (int d = 0; d < dim; ++d) {
            dp[a][d] = ds[a][d];
            for (int c = 0; !linear && c < dim; ++c) dp[a][d] += dh[a][c] * e[c][d] + h[a][c] * ds[c][d];
        }
}

/* Energy density W = lambda/2 tr(e)^2 + mu e:e of the strain e. */
PERI_INLINE double PERI_S_FN(strain_energy_correspondence)(const peri__law *law, int dim, peri_s e[PERI_S_DIM][PERI_S_DIM]) {
    double trace = 0.0, norm = 0.0;
    for (int a = 0; a < dim; ++a) {
        trace += (double)e[a][a];
        for (int d = 0; d < dim; ++d) norm += peri__square((double)e[a][d]);
    }
    return 0.5 * law->lambda * trace * trace + law->mu * norm;
}
#endif
