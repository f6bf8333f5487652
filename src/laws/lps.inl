/* SPDX-License-Identifier: MIT */
/* lps.inl - linear peridynamic solid ([T] 1.54, 1.67, 1.72):

       theta = D/m sum w |xi| e V,    half = (A theta/m |xi| + B/m e) M

   A and B by space: material.c. Where A is 0 (Poisson's ratio of the bond-based law) nothing is gathered. */
#ifdef PERI_LAW_ROLE_TRAITS
enum { PERI__GATHER_lps = PERI__DILATATION, PERI__GAUGE_lps = 1, PERI__PAIRWISE_lps = 0,
       PERI__BY_A_lps = 1 };
#endif

#ifdef PERI_LAW_ROLE_CALIBRATION
static int peri__calibrate_lps(const peri__law *law, int32_t dim, const peri__moments *sum, peri__calibration *r) {
    r->theta_factor = dim / sum->m;
    r->pressure_factor = law->a / dim * r->theta_factor;
    r->spring = law->b / sum->m;
    return 1;
}
#endif
