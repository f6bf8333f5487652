/* pointwise.inl - what is done alike to one component of `count` points, PERI_BLOCK at most: plain loops, that the compiler turns into
   the vectors of each instruction set. */

/* v = keep v + kick f. Returns how many of v are not numbers of any use: a comparison that NaN fails; the bound is far beyond any speed in
   inner units. */
PERI_LANES_TARGET static int PERI_LANES_FN(kick_some)(int64_t count, peri_r keep, const peri_r *PERI_RESTRICT kick,
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
PERI_LANES_TARGET static void PERI_LANES_FN(drift_some)(int64_t count, peri_r drift, const peri_r *PERI_RESTRICT v,
                                                               peri_r *PERI_RESTRICT u) {
    PERI_NO_CONTRACTION
    for (int64_t k = 0; k < count; ++k) u[k] += drift * v[k];
}

/* Adds the squares of r to loose where the component is free, to fixed where it is held. */
PERI_LANES_TARGET static void PERI_LANES_FN(square_some)(int64_t count, int d, const uint8_t *PERI_RESTRICT held,
                                                         const peri_r *PERI_RESTRICT r, double *PERI_RESTRICT loose,
                                                         double *PERI_RESTRICT fixed) {
    PERI_NO_CONTRACTION
    for (int64_t k = 0; k < count; ++k) {
        const double is_held = held[k] >> d & 1, square = (double)r[k] * (double)r[k];
        loose[k] += (1.0 - is_held) * square;
        fixed[k] += is_held * square;
    }
}

/* x += alpha p, r -= alpha q */
PERI_LANES_TARGET static void PERI_LANES_FN(step_some)(int64_t count, peri_r alpha, const peri_r *PERI_RESTRICT p,
                                                       const peri_r *PERI_RESTRICT q, peri_r *PERI_RESTRICT x, peri_r *PERI_RESTRICT r) {
    PERI_NO_CONTRACTION
    for (int64_t k = 0; k < count; ++k) {
        x[k] += alpha * p[k];
        r[k] -= alpha * q[k];
    }
}

/* q = -volume q; adds p q to bent and p p to square. */
PERI_LANES_TARGET static void PERI_LANES_FN(weigh_some)(int64_t count, const double *PERI_RESTRICT volume, const peri_r *PERI_RESTRICT p,
                                                        peri_r *PERI_RESTRICT q, double *PERI_RESTRICT bent, double *PERI_RESTRICT square) {
    PERI_NO_CONTRACTION
    for (int64_t k = 0; k < count; ++k) {
        q[k] *= -(peri_r)volume[k];
        bent[k] += (double)p[k] * (double)q[k];
        square[k] += (double)p[k] * (double)p[k];
    }
}

/* Adds r z to sum where the component is free. */
PERI_LANES_TARGET static void PERI_LANES_FN(dot_some)(int64_t count, int d, const uint8_t *PERI_RESTRICT held,
                                                      const peri_r *PERI_RESTRICT r, const peri_r *PERI_RESTRICT z,
                                                      double *PERI_RESTRICT sum) {
    PERI_NO_CONTRACTION
    for (int64_t k = 0; k < count; ++k) {
        const double product = (double)r[k] * (double)z[k];
        sum[k] += held[k] >> d & 1 ? 0.0 : product;
    }
}

/* p = z + beta p where the component is free, 0 where it is held. */
PERI_LANES_TARGET static void PERI_LANES_FN(turn_some)(int64_t count, int d, const uint8_t *PERI_RESTRICT held, peri_r beta,
                                                       const peri_r *PERI_RESTRICT z, peri_r *PERI_RESTRICT p) {
    PERI_NO_CONTRACTION
    for (int64_t k = 0; k < count; ++k) {
        const peri_r turned = z[k] + beta * p[k];
        p[k] = held[k] >> d & 1 ? 0 : turned;
    }
}
