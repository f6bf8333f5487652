/* SPDX-License-Identifier: MIT */
/* test_dynamics.c - motion: conservation laws, rigid motions, both integrators, the stable step, durations, damping. Loads,
   supports and obstacles are in test_loads.c, the energy ledger is in test_ledger.c.

   Nothing here was recorded from the library. Expected values are conservation laws, closed forms, or force loops written
   out below over all pairs (brute_*), with the micromodulus from the closed forms of [P] C.15, C.18 and [T] 1.24. */
#include "scene.h"

/* ---- conservation ------------------------------------------------------------------------------------------------- */

/* Momenta and their scales, summed here from the fields: p[3], l[3] (2D: l[2]), sum |m v|, sum |m x v|. */
static void sum_momenta(peri_body *b, int32_t space, double *p, double *l, double *sp, double *sl) {
    double *x = get(b, PERI_FIELD_CURRENT_POSITION), *v = get(b, PERI_FIELD_VELOCITY), *vol = get(b, PERI_FIELD_VOLUME);
    int dim = peri_dimension(b), k;
    int64_t i;
    for (k = 0; k < 3; ++k) p[k] = l[k] = 0;
    *sp = *sl = 0;
    for (i = 0; i < peri_point_count(b); ++i) {
        double m = DENSITY * thickness(space) * vol[i], a[3] = {0, 0, 0}, w[3] = {0, 0, 0};
        for (k = 0; k < dim; ++k) {
            a[k] = x[i * dim + k];
            w[k] = v[i * dim + k];
        }
        for (k = 0; k < 3; ++k) {
            p[k] += m * w[k];
            l[k] += m * (a[(k + 1) % 3] * w[(k + 2) % 3] - a[(k + 2) % 3] * w[(k + 1) % 3]);
        }
        *sp += m * sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
        *sl += m * sqrt((a[0] * a[0] + a[1] * a[1] + a[2] * a[2]) * (w[0] * w[0] + w[1] * w[1] + w[2] * w[2]));
    }
    free(x);
    free(v);
    free(vol);
}

/* SOURCE OF TRUTH: Newton's third law. Every force lies along its bond, so a free body keeps both momenta, and so does the
   discrete flow of velocity-Verlet, exactly. What is left is rounding. In double 1e-12 is asked for. In float: each of
   the 2*steps kicks rounds every velocity (and sums ~30 forces of the size of velocity/dt) with relative error u; the errors
   are independent, so they add up to u*sqrt(2*steps) times a small factor; 10 is allowed. */
static void momentum(int32_t space, int32_t precision, int32_t integrator) {
    const int64_t steps = 1000;
    double bound = precision == PERI_PRECISION_DOUBLE ? 1e-12 : 10 * ULP32 * sqrt(2.0 * (double)steps);
    peri_body *b = space == PERI_SPACE_SOLID ? block(space, precision, PERI_GEOMETRY_NONLINEAR, 6, 6, 5)
                                       : block(space, precision, PERI_GEOMETRY_NONLINEAR, 14, 12, 1);
    double *v = random_field(peri_size_of_field(b, PERI_FIELD_VELOCITY), 0.02, 7), p0[3], l0[3], p1[3], l1[3], sp, sl, t1, t2;
    double lin[3] = {0, 0, 0}, ang[3] = {0, 0, 0};
    int dim = peri_dimension(b), k;
    put(b, PERI_FIELD_VELOCITY, v);
    sum_momenta(b, space, p0, l0, &sp, &sl);
    (void)go(b, integrator, steps, 0, 0);
    sum_momenta(b, space, p1, l1, &t1, &t2);
    for (k = 0; k < 3; ++k) {
        CHECK_NEAR(p1[k], p0[k], 0, bound * sp);
        CHECK_NEAR(l1[k], l0[k], 0, bound * sl);
    }
    (void)MUST(b, peri_get_momentum(b, lin, ang));
    for (k = 0; k < dim; ++k) CHECK_NEAR(lin[k], p1[k], 0, 1e-13 * sp);
    if (dim == 2) CHECK_NEAR(ang[0], l1[2], 0, 1e-13 * sl);
    else
        for (k = 0; k < 3; ++k) CHECK_NEAR(ang[k], l1[k], 0, 1e-13 * sl);
    CHECK(peri_get_momentum(b, NULL, ang) == PERI_OK && peri_get_momentum(b, lin, NULL) == PERI_OK);
    CHECK(t1 > 0.1 * sp); /* it still moves */
    free(v);
    peri_body_destroy(b);
}
static void momentum_is_kept(void) {
    momentum(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_INTEGRATOR_VELOCITY_VERLET);
    momentum(PERI_SPACE_PLANE_STRAIN, PERI_PRECISION_DOUBLE, PERI_INTEGRATOR_CENTRAL_DIFFERENCE);
    momentum(PERI_SPACE_SOLID, PERI_PRECISION_DOUBLE, PERI_INTEGRATOR_VELOCITY_VERLET);
    momentum(PERI_SPACE_PLANE_STRAIN, PERI_PRECISION_SINGLE, PERI_INTEGRATOR_VELOCITY_VERLET);
    momentum(PERI_SPACE_SOLID, PERI_PRECISION_SINGLE, PERI_INTEGRATOR_CENTRAL_DIFFERENCE);
}

/* ---- rigid motions ------------------------------------------------------------------------------------------------ */

/* Displacement of x under rotation by `angle` about (0.3, 0.2, 0.4) (axis z in 2D, (1,2,3) in 3D) and translation t. */
static void rigid_displacement(int dim, const double *x, double angle, const double *t, double *u) {
    double n[3] = {0, 0, 1}, r[3] = {0, 0, 0}, c = cos(angle), s = sin(angle), dot = 0;
    const double about[3] = {0.3, 0.2, 0.4};
    int k;
    if (dim == 3)
        for (k = 0; k < 3; ++k) n[k] = (k + 1) / sqrt(14.0);
    for (k = 0; k < dim; ++k) r[k] = x[k] - about[k];
    for (k = 0; k < 3; ++k) dot += n[k] * r[k];
    for (k = 0; k < dim; ++k) {
        double cross = n[(k + 1) % 3] * r[(k + 2) % 3] - n[(k + 2) % 3] * r[(k + 1) % 3];
        u[k] = (c - 1) * r[k] + s * cross + (1 - c) * dot * n[k] + t[k];
    }
}

/* SOURCE OF TRUTH: objectivity. The force is zero but for rounding, measured against F1, the force that a stretch of 1 in
   every bond of a point would sum to: c * (sum of the family's volumes). Worst case: displacements are stored with relative
   error u, so a bond's vector is off by 2 u |u|max and its stretch by 2 u |u|max/H; scaling and e = (2 xi.eta + eta.eta)/(..)
   add a few u: together at most 8 u (1 + |u|max/H). The test itself makes the displacement in double. */
static void rigid(int32_t space, int32_t precision, int32_t geometry) {
    const double angles[5] = {0.0, 0.1, 1.0, PI / 2, PI};
    const double shifts[3][3] = {{0, 0, 0}, {0.7, -0.4, 0.3}, {1e3, -2e3, 5e2}};
    int flat = space != PERI_SPACE_SOLID;
    peri_body *b = block(space, precision, geometry, flat ? 12 : 7, flat ? 9 : 6, 5);
    double *x = get(b, PERI_FIELD_POSITION), *fam = get(b, PERI_FIELD_FAMILY_SIZE), *vol = get(b, PERI_FIELD_VOLUME), *f, unit, far, umax;
    int dim = peri_dimension(b), a, s;
    int64_t n = peri_point_count(b), i;
    double *u = (double *)calloc((size_t)(n * dim), sizeof *u), ulp = precision == PERI_PRECISION_DOUBLE ? ULP64 : ULP32;
    unit = micromodulus(space, YOUNG, 3 * H) * vol[0] * largest(fam, n);
    for (a = 0; a < (geometry == PERI_GEOMETRY_LINEAR ? 1 : 5); ++a)
        for (s = 0; s < 3; ++s) {
            for (i = 0; i < n; ++i) rigid_displacement(dim, x + i * dim, angles[a], shifts[s], u + i * dim);
            umax = largest(u, n * dim);
            far = (largest(x, n * dim) + umax) / H;
            put(b, PERI_FIELD_DISPLACEMENT, u);
            f = get(b, PERI_FIELD_FORCE_DENSITY);
            CHECK_NEAR(largest(f, n * dim), 0, 0, 8 * (ulp * (1 + umax / H) + ULP64 * far) * unit);
            free(f);
        }
    for (i = 0; i < n * dim; ++i) u[i] = 1e-2 * x[i]; /* and the probe is alive: a stretch of 1e-2 pulls at the surface, */
    put(b, PERI_FIELD_DISPLACEMENT, u);               /* where about half of a family is missing                         */
    f = get(b, PERI_FIELD_FORCE_DENSITY);
    CHECK(largest(f, n * dim) > 1e-3 * unit && largest(f, n * dim) < 1e-2 * unit);
    free(f);
    free(u);
    free(x);
    free(fam);
    free(vol);
    peri_body_destroy(b);
}
static void rigid_motion_costs_no_force(void) {
    rigid(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR);
    rigid(PERI_SPACE_PLANE_STRAIN, PERI_PRECISION_SINGLE, PERI_GEOMETRY_NONLINEAR);
    rigid(PERI_SPACE_SOLID, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR);
    rigid(PERI_SPACE_SOLID, PERI_PRECISION_SINGLE, PERI_GEOMETRY_NONLINEAR);
}
static void linear_translation_costs_no_force(void) {
    rigid(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR);
    rigid(PERI_SPACE_PLANE_STRAIN, PERI_PRECISION_SINGLE, PERI_GEOMETRY_LINEAR);
    rigid(PERI_SPACE_SOLID, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR);
    rigid(PERI_SPACE_SOLID, PERI_PRECISION_SINGLE, PERI_GEOMETRY_LINEAR);
}

/* ---- brute force -------------------------------------------------------------------------------------------------- */

#define BRUTE_MAX 64
/* Two materials side by side, 2D plane strain or 3D, with their own constants; the interface is the harmonic mean. */
typedef struct brute {
    int     dim, n;
    double *x, *vol, *mat, horizon, c[2][2], density[2];
} brute;

static peri_body *two_halves(int32_t space, int32_t geometry, brute *g) {
    const double young[2] = {3.0, 5.0}, density[2] = {2.0, 1.25};
    double lo[3] = {0, 0, 0}, hi[3] = {4 * H, 6 * H, 3 * H};
    peri_body *b;
    int a;
    g->horizon = 2 * H;
    if (space == PERI_SPACE_SOLID) hi[0] = 3 * H, hi[1] = 3 * H;
    b = empty(space, PERI_PRECISION_DOUBLE, geometry, g->horizon);
    for (a = 0; a < 2; ++a) {
        g->c[a][a] = micromodulus(space, young[a], g->horizon);
        g->density[a] = density[a];
        (void)MUST(b, peri_add_box(b, unbreakable(b, young[a], density[a]), lo, hi, H));
        lo[0] = hi[0];
        hi[0] *= 2;
    }
    g->c[0][1] = g->c[1][0] = 2 * g->c[0][0] * g->c[1][1] / (g->c[0][0] + g->c[1][1]);
    (void)MUST(b, peri_build(b));
    g->dim = peri_dimension(b);
    g->n = (int)peri_point_count(b);
    CHECK(g->n <= BRUTE_MAX);
    g->x = get(b, PERI_FIELD_POSITION);
    g->vol = get(b, PERI_FIELD_VOLUME);
    g->mat = get(b, PERI_FIELD_MATERIAL);
    return b;
}
static void brute_free(brute *g) {
    free(g->x);
    free(g->vol);
    free(g->mat);
}
static double brute_length(const brute *g, int i, int j) {
    double q = 0;
    int k;
    for (k = 0; k < g->dim; ++k) q += pow(g->x[j * g->dim + k] - g->x[i * g->dim + k], 2.0);
    return sqrt(q);
}
static double brute_c(const brute *g, int i, int j) { return g->c[g->mat[i] > 1.5][g->mat[j] > 1.5]; }

/* Accelerations by the definition, over all pairs: f = c s M, s = (|xi+eta|-|xi|)/|xi|, in long double. */
static void brute_acceleration(const brute *g, int linear, const long double *u, long double *a) {
    int i, j, k, dim = g->dim;
    for (i = 0; i < g->n; ++i) {
        for (k = 0; k < dim; ++k) a[i * dim + k] = 0;
        for (j = 0; j < g->n; ++j) {
            long double xi[3], p[3], len = 0, cur = 0, dot = 0, s;
            if (j == i || brute_length(g, i, j) > g->horizon * (1 + 1e-8)) continue;
            for (k = 0; k < dim; ++k) {
                xi[k] = (long double)g->x[j * dim + k] - (long double)g->x[i * dim + k];
                p[k] = xi[k] + u[j * dim + k] - u[i * dim + k];
                len += xi[k] * xi[k];
                cur += p[k] * p[k];
                dot += xi[k] * (u[j * dim + k] - u[i * dim + k]);
            }
            len = sqrtl(len);
            cur = sqrtl(cur);
            s = linear ? dot / (len * len) : (cur - len) / len;
            for (k = 0; k < dim; ++k)
                a[i * dim + k] += (long double)brute_c(g, i, j) * s * (linear ? xi[k] / len : p[k] / cur) *
                                  (long double)g->vol[j] / (long double)g->density[g->mat[i] > 1.5];
        }
    }
}

/* SOURCE OF TRUTH: [T] 2.10, [L]: u(t+dt) = 2u(t) - u(t-dt) + dt^2 a, begun with u(-dt) = u0 - dt v0 + dt^2/2 a0, in long
   double with the pair loop above. v(t) = (u(t+dt) - u(t-dt))/(2dt). The library rounds each step's displacement and velocity
   once or twice: n steps of relative error u each, on amplitude max|u|, at most doubled by the sum of forces: 8 n u max|u|. */
static void recurrence(int32_t space, int32_t geometry, int32_t integrator) {
    enum { STEPS = 100 };
    brute g;
    peri_body *b = two_halves(space, geometry, &g);
    long double old[BRUTE_MAX * 3], now[BRUTE_MAX * 3], next[BRUTE_MAX * 3], acc[BRUTE_MAX * 3];
    int n = g.n * g.dim, k, s, linear = geometry == PERI_GEOMETRY_LINEAR;
    double *u = random_field(n, 0.02 * H, 3), *v = random_field(n, 0.02, 4), *gu, *gv, umax = 0, vmax = 0;
    double dt = 0.8 * peri_stable_step(b);
    long double h = (long double)dt;
    memset(now, 0, sizeof now);
    memset(old, 0, sizeof old);
    memset(next, 0, sizeof next);
    put(b, PERI_FIELD_DISPLACEMENT, u);
    put(b, PERI_FIELD_VELOCITY, v);
    for (k = 0; k < n; ++k) now[k] = (long double)u[k];
    brute_acceleration(&g, linear, now, acc);
    for (k = 0; k < n; ++k) old[k] = now[k] - h * (long double)v[k] + 0.5L * h * h * acc[k];
    for (s = 0; s <= STEPS; ++s) { /* one step further than the library, for the last velocity */
        brute_acceleration(&g, linear, now, acc);
        for (k = 0; k < n; ++k) {
            next[k] = 2 * now[k] - old[k] + h * h * acc[k];
            umax = fmax(umax, fabs((double)now[k]));
            vmax = fmax(vmax, fabs((double)((next[k] - old[k]) / (2 * h))));
        }
        if (s < STEPS)
            for (k = 0; k < n; ++k) {
                old[k] = now[k];
                now[k] = next[k];
            }
    }
    (void)go(b, integrator, STEPS, dt, 0);
    gu = get(b, PERI_FIELD_DISPLACEMENT);
    gv = get(b, PERI_FIELD_VELOCITY);
    for (k = 0; k < n; ++k) {
        CHECK_NEAR(gu[k], (double)now[k], 0, 8 * STEPS * ULP64 * umax);
        CHECK_NEAR(gv[k], (double)((next[k] - old[k]) / (2 * h)), 0, 8 * STEPS * ULP64 * vmax);
    }
    free(u);
    free(v);
    free(gu);
    free(gv);
    brute_free(&g);
    peri_body_destroy(b);
}
static void central_difference_is_the_recurrence(void) {
    recurrence(PERI_SPACE_PLANE_STRAIN, PERI_GEOMETRY_NONLINEAR, PERI_INTEGRATOR_CENTRAL_DIFFERENCE);
    recurrence(PERI_SPACE_SOLID, PERI_GEOMETRY_NONLINEAR, PERI_INTEGRATOR_CENTRAL_DIFFERENCE);
    recurrence(PERI_SPACE_SOLID, PERI_GEOMETRY_LINEAR, PERI_INTEGRATOR_CENTRAL_DIFFERENCE);
}
/* The same truth: in exact arithmetic velocity-Verlet is that recurrence too. */
static void velocity_verlet_is_the_recurrence(void) {
    recurrence(PERI_SPACE_PLANE_STRAIN, PERI_GEOMETRY_NONLINEAR, PERI_INTEGRATOR_VELOCITY_VERLET);
    recurrence(PERI_SPACE_PLANE_STRAIN, PERI_GEOMETRY_LINEAR, PERI_INTEGRATOR_VELOCITY_VERLET);
    recurrence(PERI_SPACE_SOLID, PERI_GEOMETRY_NONLINEAR, PERI_INTEGRATOR_VELOCITY_VERLET);
}

/* SOURCE OF TRUTH: two masses on one bond are an oscillator of k = c V1 V2/|xi| and reduced mass m1 m2/(m1+m2). Verlet from
   rest moves the extension as A cos(n w' dt) with sin(w' dt/2) = w dt/2, exactly. Along the bond the nonlinear extension is
   linear too. Phase error by rounding: 20,000 steps * 1e-15. The centre of mass stays, but for a random walk of its velocity by
   u w A per kick, summed over n steps of dt: n sqrt(2n) u w dt A. */
static void two_points(int32_t geometry, int32_t integrator) {
    const double x[6] = {1, 2, 3, 1.06, 2.08, 3.0}, vol[2] = {1e-3, 1.5e-3}, young[2] = {3, 7}, density[2] = {2, 0.5};
    const double horizon = 0.25, len = 0.1, amplitude = 1e-3, dir[3] = {0.6, 0.8, 0};
    double c0 = micromodulus(PERI_SPACE_SOLID, young[0], horizon), c1 = micromodulus(PERI_SPACE_SOLID, young[1], horizon);
    double m0 = density[0] * vol[0], m1 = density[1] * vol[1], k = 2 * c0 * c1 / (c0 + c1) * vol[0] * vol[1] / len;
    double w = sqrt(k * (m0 + m1) / (m0 * m1)), u[6], dt, wd, *g, e;
    peri_body *b = empty(PERI_SPACE_SOLID, PERI_PRECISION_DOUBLE, geometry, horizon);
    int32_t mat[2];
    int a, n, i;
    for (a = 0; a < 2; ++a) mat[a] = unbreakable(b, young[a], density[a]);
    (void)MUST(b, peri_add_points(b, 2, x, vol, mat));
    (void)MUST(b, peri_build(b));
    for (i = 0; i < 3; ++i) {
        u[i] = -amplitude * dir[i] * m1 / (m0 + m1);
        u[3 + i] = amplitude * dir[i] * m0 / (m0 + m1);
    }
    put(b, PERI_FIELD_DISPLACEMENT, u);
    dt = 0.9 * peri_stable_step(b);
    wd = 2 / dt * asin(w * dt / 2);
    for (n = 1000; n <= 20000; n += 1000) {
        (void)go(b, integrator, 1000, dt, 0);
        g = get(b, PERI_FIELD_DISPLACEMENT);
        for (e = 0, i = 0; i < 3; ++i) e += (g[3 + i] - g[i]) * dir[i];
        CHECK_NEAR(e, amplitude * cos(n * wd * dt), 0, 1e-10 * amplitude);
        for (i = 0; i < 3; ++i)
            CHECK_NEAR((m0 * g[i] + m1 * g[3 + i]) / (m0 + m1), 0, 0, n * sqrt(2.0 * n) * ULP64 * w * dt * amplitude);
        free(g);
    }
    peri_body_destroy(b);
}
static void two_point_frequency(void) {
    two_points(PERI_GEOMETRY_LINEAR, PERI_INTEGRATOR_VELOCITY_VERLET);
    two_points(PERI_GEOMETRY_LINEAR, PERI_INTEGRATOR_CENTRAL_DIFFERENCE);
    two_points(PERI_GEOMETRY_NONLINEAR, PERI_INTEGRATOR_VELOCITY_VERLET);
}

/* ---- the stable step ---------------------------------------------------------------------------------------------- */

/* SOURCE OF TRUTH: an explicit step is stable up to 2/sqrt(L), L the largest eigenvalue of M^-1 K. K u is minus the force of the pair loop
   above, linear; L by the power method, which finds it from below: the limit is no larger than `limit`. The step may be less by 4 %, and
   is no less than [T] 2.11, min over points of sqrt(2 rho/sum_j c V_j/|xi|), which bounds L by row sums. */
static void stable_step_by_brute_force(void) {
    int kind, i, j;
    for (kind = 0; kind < 4; ++kind) {
        brute g;
        peri_body *b = two_halves(kind & 1 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRAIN,
                                  kind & 2 ? PERI_GEOMETRY_LINEAR : PERI_GEOMETRY_NONLINEAR, &g);
        const int n = g.n * g.dim;
        long double u[BRUTE_MAX * 3], a[BRUTE_MAX * 3], square = 0, image = 0;
        double least = HUGE_VAL, limit, *start = random_field(n, 1, 7);
        for (i = 0; i < n; ++i) a[i] = (long double)start[i];
        for (j = 0; j < 300; ++j) {
            square = image = 0;
            for (i = 0; i < n; ++i) square += a[i] * a[i];
            for (i = 0; i < n; ++i) u[i] = a[i] / sqrtl(square);
            brute_acceleration(&g, 1, u, a);
            for (i = 0; i < n; ++i) { /* Rayleigh's quotient in the product of masses */
                const long double mass = (long double)g.density[g.mat[i / g.dim] > 1.5] * (long double)g.vol[i / g.dim];
                image -= mass * u[i] * a[i];
            }
            square = 0;
            for (i = 0; i < n; ++i)
                square += (long double)g.density[g.mat[i / g.dim] > 1.5] * (long double)g.vol[i / g.dim] * u[i] * u[i];
        }
        limit = 2 / sqrt((double)(image / square));
        for (i = 0; i < g.n; ++i) {
            double sum = 0;
            for (j = 0; j < g.n; ++j)
                if (j != i && brute_length(&g, i, j) <= g.horizon * (1 + 1e-8))
                    sum += brute_c(&g, i, j) * g.vol[j] / brute_length(&g, i, j);
            least = fmin(least, sqrt(2 * g.density[g.mat[i] > 1.5] / sum));
        }
        CHECK(peri_stable_step(b) <= limit && peri_stable_step(b) >= limit / 1.04);
        CHECK(peri_stable_step(b) >= least * (1 - 1e-12));
        free(start);
        brute_free(&g);
        peri_body_destroy(b);
    }
}

/* SOURCE OF TRUTH: the contract of peri_advance. A step of 5 times the stable one is beyond any factor (1.04 at most) that the
   estimate is safe by, so the highest mode grows by |g| > 5 a step and leaves the range of a double within 500 steps. */
static void too_large_steps(void) {
    const int32_t precision[2] = {PERI_PRECISION_DOUBLE, PERI_PRECISION_SINGLE};
    int k;
    for (k = 0; k < 2; ++k) {
        peri_body *b = block(PERI_SPACE_PLANE_STRESS, precision[k], PERI_GEOMETRY_NONLINEAR, 8, 8, 1);
        double limit = peri_stable_step(b), *v = random_field(128, 1e-3, 11), *u0, *u1, *v0, *v1;
        peri_error e;
        peri_advance_desc r;
        put(b, PERI_FIELD_VELOCITY, v);
        CHECK(go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 200, 0.999 * limit, 0) == PERI_OK);
        u0 = get(b, PERI_FIELD_DISPLACEMENT);
        v0 = get(b, PERI_FIELD_VELOCITY);
        CHECK(largest(u0, 128) > 0 && largest(u0, 128) < 1);
        peri_advance_desc_init(&r);
        r.steps = 10;
        r.time_step = 1.001 * limit;
        CHECK(peri_advance(b, &r) == PERI_ERROR_STEP);
        CHECK(peri_get_error(b, &e) == PERI_OK && e.code == PERI_ERROR_STEP);
        CHECK_NEAR(e.value, limit, 1e-12, 0);
        CHECK(peri_step_count(b) == 200);
        u1 = get(b, PERI_FIELD_DISPLACEMENT);
        v1 = get(b, PERI_FIELD_VELOCITY);
        CHECK(memcmp(u0, u1, 128 * sizeof *u0) == 0 && memcmp(v0, v1, 128 * sizeof *v0) == 0);
        r.time_step = 5 * limit;
        r.force_step = 1;
        r.steps = 500;
        CHECK(peri_advance(b, &r) == PERI_ERROR_UNSTABLE);
        CHECK(peri_get_error(b, &e) == PERI_OK && e.code == PERI_ERROR_UNSTABLE && e.index >= 0 && e.index < 64);
        CHECK(peri_step_count(b) > 200 && peri_step_count(b) < 700);
        CHECK(peri_reset(b) == PERI_OK && go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 3, 0, 0) == PERI_OK); /* and it recovers */
        free(u0);
        free(u1);
        free(v0);
        free(v1);
        free(v);
        peri_body_destroy(b);
    }
}

/* SOURCE OF TRUTH: arithmetic. */
static void durations_and_steps(void) {
    peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR, 4, 4, 1);
    double dt = 0.7 * peri_stable_step(b);
    peri_advance_desc r;
    int k;
    peri_advance_desc_init(&r);
    r.time_step = dt;
    for (k = 1; k <= 50; ++k) { /* whatever the remainder; to 2 u, one for each change of unit on the way in and out */
        r.duration = (0.37 * k + 0.1) * dt;
        CHECK(peri_reset(b) == PERI_OK && peri_advance(b, &r) == PERI_OK);
        CHECK_NEAR(peri_time(b), r.duration, 2 * ULP64, 0);
        CHECK(peri_step_count(b) == (int64_t)ceil(0.37 * k + 0.1));
    }
    CHECK(peri_reset(b) == PERI_OK);
    r.duration = 7.3 * dt;
    r.time_step = dt;
    CHECK(peri_advance(b, &r) == PERI_OK);
    CHECK(peri_step_count(b) == 8);
    CHECK_NEAR(peri_time(b), 7.3 * dt, 2 * ULP64, 0);
    CHECK(peri_advance(b, &r) == PERI_OK);
    CHECK(peri_step_count(b) == 16);
    CHECK_NEAR(peri_time(b), 14.6 * dt, 1e-14, 0);
    CHECK(peri_reset(b) == PERI_OK && peri_time(b) == 0 && peri_step_count(b) == 0);
    r.duration = 1e-2; /* ten steps of 1e-3, though ten times 1e-3 is not 1e-2 in binary: no eleventh sliver of a step */
    r.time_step = 1e-3;
    CHECK(peri_advance(b, &r) == PERI_OK && peri_step_count(b) == 10);
    CHECK_NEAR(peri_time(b), 1e-2, 2 * ULP64, 0);
    r.duration = 0;
    r.steps = 17;
    CHECK(peri_advance(b, &r) == PERI_OK && peri_step_count(b) == 27);
    CHECK_NEAR(peri_time(b), 27e-3, 1e-14, 0);
    r.steps = 0; /* neither steps nor duration: nothing was asked for */
    CHECK(peri_advance(b, &r) == PERI_ERROR_ARGUMENT && peri_step_count(b) == 27);
    r.steps = 1;
    r.time_step = 0;
    r.safety = 0.5;
    CHECK(peri_reset(b) == PERI_OK && peri_advance(b, &r) == PERI_OK);
    CHECK_NEAR(peri_time(b), 0.5 * peri_stable_step(b), 1e-14, 0);
    peri_body_destroy(b);
}

/* SOURCE OF TRUTH: with force -a rho v alone, Verlet's central velocity gives v(n+1)/v(n) = (1 - a dt/2)/(1 + a dt/2). */
static void damping_decays(void) {
    int k;
    for (k = 0; k < 2; ++k) {
        peri_body *b = block(PERI_SPACE_SOLID, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR, 4, 3, 3);
        double v0[3] = {0.3, -0.2, 0.1}, dt = 0.5 * peri_stable_step(b), a = 0.7 / dt, want, *v;
        int64_t i;
        (void)MUST(b, peri_add_velocity(b, PERI_ALL, v0));
        (void)go(b, k ? PERI_INTEGRATOR_CENTRAL_DIFFERENCE : PERI_INTEGRATOR_VELOCITY_VERLET, 20, dt, a);
        want = pow((1 - 0.35) / (1 + 0.35), 20.0);
        v = get(b, PERI_FIELD_VELOCITY);
        for (i = 0; i < 3 * peri_point_count(b); ++i) CHECK_NEAR(v[i], v0[i % 3] * want, 1e-13, 0);
        free(v);
        peri_body_destroy(b);
    }
}

/* ---- runs in parts, places far away ------------------------------------------------------------------------------- */

/* SOURCE OF TRUTH: the contract: "peri_advance as often as you like"; the state is all there is. One run of 40 steps, or
   1 + 9 + 30: the same bits under velocity-Verlet, the same to rounding under central difference (which goes to half a step and back). */
static void runs_in_parts(void) {
    const double b2[2] = {0.1, -0.05};
    int k, i;
    for (k = PERI_INTEGRATOR_VELOCITY_VERLET; k < peri__end_integrator; ++k) {
        double *u[2], *v = random_field(70, 0.02, 21);
        int part;
        for (part = 0; part < 2; ++part) {
            peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR, 7, 5, 1);
            (void)MUST(b, peri_apply_body_force(b, PERI_ALL, b2, NULL, NULL));
            put(b, PERI_FIELD_VELOCITY, v);
            if (part) {
                (void)go(b, k, 1, 0, 0.3);
                (void)go(b, k, 9, 0, 0.3);
            }
            (void)go(b, k, part ? 30 : 40, 0, 0.3);
            CHECK(peri_step_count(b) == 40);
            u[part] = get(b, PERI_FIELD_DISPLACEMENT);
            peri_body_destroy(b);
        }
        if (k == PERI_INTEGRATOR_VELOCITY_VERLET) CHECK(memcmp(u[0], u[1], 70 * sizeof(double)) == 0);
        for (i = 0; i < 70; ++i) CHECK_NEAR(u[1][i], u[0][i], 0, 8 * 40 * ULP64 * largest(u[0], 70));
        free(u[0]);
        free(u[1]);
        free(v);
    }
}

/* SOURCE OF TRUTH: translation invariance. The same body a million spacings away: coordinates in double are rounded by 1e6 u of a
   spacing there, so stretches of 1e-2 differ by 1e-8 relative, and motions after 100 steps by some of these. In float the
   coordinates within the body must not suffer at all: 100 steps of a few u. */
static void far_from_the_origin(void) {
    int k, i;
    for (k = 0; k < 2; ++k) {
        double *u[2], *v = random_field(70, 0.02, 22), bound = k ? 8 * 100 * ULP32 : 100 * 1e6 * ULP64 * 100;
        int place;
        for (place = 0; place < 2; ++place) {
            const double at = place ? 1e6 * H : 0, lo[2] = {at, -at}, hi[2] = {at + 7 * H, -at + 5 * H};
            peri_body *b = empty(PERI_SPACE_PLANE_STRESS, k ? PERI_PRECISION_SINGLE : PERI_PRECISION_DOUBLE,
                                 PERI_GEOMETRY_NONLINEAR, 3 * H);
            (void)MUST(b, peri_add_box(b, unbreakable(b, YOUNG, DENSITY), lo, hi, H));
            (void)MUST(b, peri_build(b));
            CHECK(peri_point_count(b) == 35);
            put(b, PERI_FIELD_VELOCITY, v);
            (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 100, 0.03, 0);
            u[place] = get(b, PERI_FIELD_DISPLACEMENT);
            peri_body_destroy(b);
        }
        for (i = 0; i < 70; ++i) CHECK_NEAR(u[1][i], u[0][i], 0, bound * largest(u[0], 70));
        free(u[0]);
        free(u[1]);
        free(v);
    }
}

/* ---- callbacks ---------------------------------------------------------------------------------------------------- */

typedef struct meddler {
    int frames, refused, breaks, refused_in_break;
    peri_body *body;
} meddler;

static int32_t meddle(void *user, peri_body *b) {
    meddler *m = (meddler *)user;
    double u[2] = {0, 0};
    peri_advance_desc r;
    peri_advance_desc_init(&r);
    r.steps = 1;
    m->frames++;
    m->refused += peri_advance(b, &r) < 0;
    m->refused += peri_reset(b) < 0;
    return peri_get_momentum(b, u, NULL) != PERI_OK; /* reading is allowed */
}
static int32_t meddle_in_break(void *user, int32_t i, int32_t j, double time, double stretch) {
    meddler *m = (meddler *)user;
    const double a[2] = {0, 0.25}, z[2] = {1, 0.25};
    peri_advance_desc r;
    (void)time, (void)stretch;
    peri_advance_desc_init(&r);
    r.steps = 1;
    m->breaks++;
    m->refused_in_break += peri_bond_is_intact(m->body, i, j) == 0 && peri_cut_segment(m->body, PERI_CUT_NOW, a, z) < 0 &&
                           peri_reset(m->body) < 0 && peri_advance(m->body, &r) < 0;
    return 0;
}

/* SOURCE OF TRUTH: peri.h: a callback may read the body that called it; a frame may also cut and load it, not advance or reset it. Such
   calls are refused and leave no trace: same bits as the run whose callbacks only look. */
static void callbacks_may_not_meddle(void) {
    double *u[2];
    int k;
    for (k = 0; k < 2; ++k) {
        const double lo[2] = {0, 0}, hi[2] = {0.8, 0.5}, half[2] = {0.4, 0.5}, v[2] = {-0.2, 0};
        peri_body *b = empty(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR, 3 * H);
        peri_material_desc m;
        meddler w;
        peri_advance_desc r;
        memset(&w, 0, sizeof w);
        w.body = b;
        peri_material_desc_init(&m, PERI_LAW_BOND_BASED);
        m.young = YOUNG;
        m.density = DENSITY;
        m.critical_stretch = 0.02;
        (void)MUST(b, peri_add_material(b, &m));
        (void)MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo, hi, H));
        (void)MUST(b, peri_build(b));
        (void)MUST(b, peri_add_velocity(b, (int32_t)MUST(b, peri_select_box(b, NULL, lo, half)), v));
        peri_advance_desc_init(&r);
        r.steps = 40;
        if (k) {
            (void)MUST(b, peri_on_break(b, meddle_in_break, &w));
            r.frame_steps = 10;
            r.on_frame = meddle;
            r.user = &w;
        }
        CHECK(peri_advance(b, &r) == PERI_OK && peri_step_count(b) == 40 && peri_broken_count(b) > 0);
        if (k) CHECK(w.frames == 4 && w.refused == 8 && w.breaks > 0 && w.refused_in_break == w.breaks);
        u[k] = get(b, PERI_FIELD_DISPLACEMENT);
        peri_body_destroy(b);
    }
    CHECK(memcmp(u[0], u[1], 80 * sizeof(double)) == 0);
    free(u[0]);
    free(u[1]);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(momentum_is_kept);
    RUN(rigid_motion_costs_no_force);
    RUN(linear_translation_costs_no_force);
    RUN(central_difference_is_the_recurrence);
    RUN(velocity_verlet_is_the_recurrence);
    RUN(two_point_frequency);
    RUN(stable_step_by_brute_force);
    RUN(too_large_steps);
    RUN(durations_and_steps);
    RUN(damping_decays);
    RUN(runs_in_parts);
    RUN(far_from_the_origin);
    RUN(callbacks_may_not_meddle);
    return test_end("test_dynamics");
}
