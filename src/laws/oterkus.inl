/* SPDX-License-Identifier: MIT */
/* oterkus.inl - Oterkus's law ([C] 16, 17), calibrated on the sums of the family itself:

       theta = D/(sum w |xi| V) sum w e V,    half = (p + q e) M,    q = B/m,    p = (bulk - q m/D^2) d theta

   [C] 16 has q = mu/S, S = sum w xi_a^2 xi_b^2/|xi|^2 V, by the energy of simple shear along the axes. Here S is the mean of that over all
   directions of the shear, m/(D (D + 2)): a family then has the same constants however it lies in the axes. The energy is never negative
   while q + (bulk - q m/D^2) D^2 sum(w V)/(sum w |xi| V)^2 >= 0 (Cauchy-Schwarz): q stays within that. */
#ifdef PERI_LAW_ROLE_TRAITS
enum { PERI__GATHER_oterkus = PERI__DILATATION, PERI__GAUGE_oterkus = 0, PERI__PAIRWISE_oterkus = 0,
       PERI__BY_A_oterkus = 0 };
#endif

#ifdef PERI_LAW_ROLE_CALIBRATION
static int peri__calibrate_oterkus(const peri__law *law, int32_t dim, const peri__moments *sum, peri__calibration *r) {
    const double room = sum->m * sum->plain / (sum->length * sum->length) - 1.0, most = law->bulk * dim * dim * (1.0 + room);
    r->theta_factor = dim / sum->length;
    r->spring = law->b / sum->m;
    if (r->spring * sum->m * room > most) r->spring = most / (room * sum->m);
    r->pressure_factor = (law->bulk - r->spring * sum->m / (dim * dim)) * r->theta_factor;
    return 1;
}
#endif
