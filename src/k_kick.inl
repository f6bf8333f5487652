/* k_kick.inl - kicks and drifts of one component of some points: plain loops, that the compiler turns into the vectors of each instruction
   set. */

/* v = keep v + kick f. Returns how many of v are not numbers of any use: a comparison that NaN fails; the bound is far beyond any speed in
   inner units. */
PERI_LANES_TARGET static int PERI_LANES_FN(kick_some)(int64_t count, peri_r keep, const peri_r *kick, const peri_r *f, peri_r *v) {
    PERI_NO_CONTRACTION
    int wrong = 0;
    for (int64_t k = 0; k < count; ++k) {
        const peri_r now = keep * v[k] + kick[k] * f[k];
        v[k] = now;
        wrong += !(now > -PERI_SPEEDING && now < PERI_SPEEDING);
    }
    return wrong;
}

/* u += drift v */
PERI_LANES_TARGET static void PERI_LANES_FN(drift_some)(int64_t count, peri_r drift, const peri_r *v, peri_r *u) {
    PERI_NO_CONTRACTION
    for (int64_t k = 0; k < count; ++k) u[k] += drift * v[k];
}
