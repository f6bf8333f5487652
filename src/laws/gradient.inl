/* SPDX-License-Identifier: MIT */
/* gradient.inl - strain, and the stress of the laws with a gradient, in reals of type peri_s and matrices of PERI_S_DIM of which `dim` are
   in use; PERI_S_FN names it. Included per precision and dimension by the kernels, and once in double for fields and the assembled
   matrix. */
/* E of H. */
static void PERI_S_FN(strain)(int dim, int linear, peri_s h[PERI_S_DIM][PERI_S_DIM], peri_s strain[PERI_S_DIM][PERI_S_DIM]) {
    for (int a = 0; a < dim; ++a)
        for (int d = 0; d < dim; ++d) {
            strain[a][d] = (peri_s)0.5 * (h[a][d] + h[d][a]);
            for (int c = 0; !linear && c < dim; ++c) strain[a][d] += (peri_s)0.5 * h[c][a] * h[c][d];
        }
}

/* The change of E where H changes by dh. */
static void PERI_S_FN(strain_change)(int dim, int linear, peri_s h[PERI_S_DIM][PERI_S_DIM], peri_s dh[PERI_S_DIM][PERI_S_DIM],
                                     peri_s change[PERI_S_DIM][PERI_S_DIM]) {
    for (int a = 0; a < dim; ++a)
        for (int d = 0; d < dim; ++d) {
            change[a][d] = (peri_s)0.5 * (dh[a][d] + dh[d][a]);
            for (int c = 0; !linear && c < dim; ++c) change[a][d] += (peri_s)0.5 * (dh[c][a] * h[c][d] + h[c][a] * dh[c][d]);
        }
}

#define PERI_LAW_ROLE_STRESS
#include "laws.inl"
#undef PERI_LAW_ROLE_STRESS

/* P of the law of a point, of the strain e (lost) at H; laws without a gradient count as Saint Venant-Kirchhoff's. */
static void PERI_S_FN(stress)(const peri__law *law, int dim, int linear, peri_s h[PERI_S_DIM][PERI_S_DIM],
                              peri_s e[PERI_S_DIM][PERI_S_DIM], peri_s p[PERI_S_DIM][PERI_S_DIM]) {
    switch (law->kind) {
#define PERI_CASE(name, number) case number: PERI_S_FN(stress_##name)(law, dim, linear, h, e, p); break;
    PERI_GRADIENT_LAW_LIST(PERI_CASE)
#undef PERI_CASE
    default: PERI_S_FN(stress_correspondence)(law, dim, linear, h, e, p); break;
    }
}

/* dP where H changes by dh, of the strain e (lost) at H. */
static void PERI_S_FN(stress_change)(const peri__law *law, int dim, int linear, peri_s h[PERI_S_DIM][PERI_S_DIM],
                                     peri_s e[PERI_S_DIM][PERI_S_DIM], peri_s dh[PERI_S_DIM][PERI_S_DIM],
                                     peri_s dp[PERI_S_DIM][PERI_S_DIM]) {
    switch (law->kind) {
#define PERI_CASE(name, number) case number: PERI_S_FN(stress_change_##name)(law, dim, linear, h, e, dh, dp); break;
    PERI_GRADIENT_LAW_LIST(PERI_CASE)
#undef PERI_CASE
    default: break;
    }
}

/* Energy density of the strain e. */
PERI_INLINE double PERI_S_FN(strain_energy)(const peri__law *law, int dim, peri_s e[PERI_S_DIM][PERI_S_DIM]) {
    switch (law->kind) {
#define PERI_CASE(name, number) case number: return PERI_S_FN(strain_energy_##name)(law, dim, e);
    PERI_GRADIENT_LAW_LIST(PERI_CASE)
#undef PERI_CASE
    default: return 0.0;
    }
}
