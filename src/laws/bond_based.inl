/* SPDX-License-Identifier: MIT */
/* bond_based.inl - the bond-based law ([T] 1.20-1.23, [P] 1): f = c w s M, s = e/|xi|, so each end gives c/(2 |xi|) e. */
#ifdef PERI_LAW_ROLE_TRAITS
enum { PERI__GATHER_bond_based = PERI__NO_GATHER, PERI__GAUGE_bond_based = 0, PERI__PAIRWISE_bond_based = 1,
       PERI__BY_A_bond_based = 0 };
#endif

#ifdef PERI_LAW_ROLE_CALIBRATION
static int peri__calibrate_bond_based(const peri__law *law, int32_t dim, const peri__moments *sum, peri__calibration *r) {
    (void)law;
    (void)dim;
    (void)sum;
    (void)r;
    return 1; /* no constants of its own */
}
#endif
