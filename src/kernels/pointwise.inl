/* SPDX-License-Identifier: MIT */
/* pointwise.inl - what is done alike to one component of `count` points, PERI_BLOCK at most: plain loops, that the compiler turns into
   the vectors of each instruction set. */

/* v = keep v + kick f. Returns how many of v are not numbers of any use: a comparison that NaN fails; the bound is far beyond any speed in
   inner units. */
PERI_ISA_TARGET static int PERI_ISA_FN(kick_some)(int64_t count, peri_r keep, const peri_r *PERI_RESTRICT kick,
                                                             const peri_r *PERI_RESTRICT f, peri_r *PERI_RESTRICT v) {
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
PERI_ISA_TARGET static void PERI_ISA_FN(drift_some)(int64_t count, peri_r drift, const peri_r *PERI_RESTRICT v,
                                                               peri_r *PERI_RESTRICT u) {
    PERI_NO_CONTRACTION
    for (int64_t k = 0; k < count; ++k) u[k] += drift * v[k];
}

/* sum = f + portion sum of a group. */
PERI_ISA_TARGET static void PERI_ISA_FN(share_some)(const peri_r *PERI_RESTRICT portion, const peri_r *PERI_RESTRICT f,
                                                               peri_r *PERI_RESTRICT sum) {
    PERI_NO_CONTRACTION
    for (int k = 0; k < PERI_GROUP; ++k) sum[k] = f[k] + portion[k] * sum[k];
}

/* Adds the squares of r to free_sum where the component is free, to constrained_sum where it is constrained. */
PERI_ISA_TARGET static void PERI_ISA_FN(square_some)(int64_t count, int d, const uint8_t *PERI_RESTRICT constrained,
                                                         const peri_r *PERI_RESTRICT r, double *PERI_RESTRICT free_sum,
                                                         double *PERI_RESTRICT constrained_sum) {
    PERI_NO_CONTRACTION
    for (int64_t k = 0; k < count; ++k) {
        const double is_constrained = constrained[k] >> d & 1, square = (double)r[k] * (double)r[k];
        free_sum[k] += (1.0 - is_constrained) * square;
        constrained_sum[k] += is_constrained * square;
    }
}

/* x += alpha p, r -= alpha q */
PERI_ISA_TARGET static void PERI_ISA_FN(step_some)(int64_t count, peri_r alpha, const peri_r *PERI_RESTRICT p,
                                                       const peri_r *PERI_RESTRICT q, peri_r *PERI_RESTRICT x, peri_r *PERI_RESTRICT r) {
    PERI_NO_CONTRACTION
    for (int64_t k = 0; k < count; ++k) {
        x[k] += alpha * p[k];
        r[k] -= alpha * q[k];
    }
}

/* q = -volume q; adds p q to bent and p p to square. */
PERI_ISA_TARGET static void PERI_ISA_FN(weigh_some)(int64_t count, const double *PERI_RESTRICT volume, const peri_r *PERI_RESTRICT p,
                                                        peri_r *PERI_RESTRICT q, double *PERI_RESTRICT bent, double *PERI_RESTRICT square) {
    PERI_NO_CONTRACTION
    for (int64_t k = 0; k < count; ++k) {
        q[k] *= -(peri_r)volume[k];
        bent[k] += (double)p[k] * (double)q[k];
        square[k] += (double)p[k] * (double)p[k];
    }
}

/* Adds r z to sum where the component is free. */
PERI_ISA_TARGET static void PERI_ISA_FN(dot_some)(int64_t count, int d, const uint8_t *PERI_RESTRICT constrained,
                                                      const peri_r *PERI_RESTRICT r, const peri_r *PERI_RESTRICT z,
                                                      double *PERI_RESTRICT sum) {
    PERI_NO_CONTRACTION
    for (int64_t k = 0; k < count; ++k) {
        const double product = (double)r[k] * (double)z[k];
        sum[k] += constrained[k] >> d & 1 ? 0.0 : product;
    }
}

/* p = z + beta p where the component is free, 0 where it is constrained. */
PERI_ISA_TARGET static void PERI_ISA_FN(turn_some)(int64_t count, int d, const uint8_t *PERI_RESTRICT constrained, peri_r beta,
                                                       const peri_r *PERI_RESTRICT z, peri_r *PERI_RESTRICT p) {
    PERI_NO_CONTRACTION
    for (int64_t k = 0; k < count; ++k) {
        const peri_r turned = z[k] + beta * p[k];
        p[k] = constrained[k] >> d & 1 ? 0 : turned;
    }
}
