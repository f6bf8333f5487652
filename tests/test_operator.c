/* SPDX-License-Identifier: MIT */
/* test_operator.c - forces as derivatives of the energy, objectivity, finite strain, and the linear operator: symmetry and modes.

   Nothing here was recorded from the library. The truth is the principle that a force is -dE/du, conservation of momentum, objectivity,
   and linear algebra on operators assembled column by column. */
#include "published_laws.h"

static double thickness_of(const peri_body *b) { return peri_dimension(b) == 3 ? 1 : THICK; }

/* Forces on the points: density times volume. */
static void read_forces(peri_body *b, const double *volume, double *f) {
    int64_t n = peri_size_of_field(b, PERI_FIELD_FORCE_DENSITY), i;
    (void)MUST(b, peri_get_field(b, PERI_FIELD_FORCE_DENSITY, f, n));
    for (i = 0; i < n; ++i) f[i] *= volume[i / peri_dimension(b)] * thickness_of(b);
}

static double elastic(peri_body *b, const double *u) {
    peri_energy e;
    put(b, PERI_FIELD_DISPLACEMENT, u);
    (void)MUST(b, peri_get_energy(b, &e));
    return e.elastic;
}

/* ---- force = -dE/du ----------------------------------------------------------------------------------------------- */

/* SOURCE OF TRUTH: differences of the elastic energy (whose value test_laws.c and test_ledger.c hold against sums): five points, step
   1e-3 H: error (step/H)^4 and 1e-16 E/step, both below 1e-10 of the largest force. And sum f = 0, sum (x + u) x f = 0 (nonlinear). */
static void derivative(const scene *s, int32_t law, double nu, int broken, int regular) {
    const double step = 1e-3 * H;
    peri_body *b = regular ? lattice_body(s, law, nu, broken) : small_body(s, law, nu, -1, broken);
    int dim = peri_dimension(b), d;
    int64_t n = peri_size_of_field(b, PERI_FIELD_DISPLACEMENT), i;
    double *u = random_field(n, 0.06 * H, 17), *f = random_field(n, 0, 1), *v = get(b, PERI_FIELD_VOLUME);
    double *x = get(b, PERI_FIELD_POSITION), most;
    double total[3] = {0, 0, 0}, torque[3] = {0, 0, 0};
    put(b, PERI_FIELD_DISPLACEMENT, u);
    read_forces(b, v, f);
    most = largest(f, n);
    CHECK(most > 1e-3 * YOUNG * pow(H, dim - 1) * thickness_of(b));
    for (i = 0; i < n; ++i) {
        double keep = u[i], e[4];
        for (d = 0; d < 4; ++d) {
            u[i] = keep + step * (d < 2 ? d - 2 : d - 1);
            e[d] = elastic(b, u);
        }
        u[i] = keep;
        CHECK_NEAR(f[i], -(e[0] - 8 * e[1] + 8 * e[2] - e[3]) / (12 * step), 0, 1e-9 * most);
    }
    for (i = 0; i < n; i += dim) {
        double at[3] = {0, 0, 0}, pull[3] = {0, 0, 0};
        for (d = 0; d < dim; ++d) {
            at[d] = x[i + d] + u[i + d];
            total[d] += pull[d] = f[i + d];
        }
        for (d = 0; d < 3; ++d) torque[d] += at[(d + 1) % 3] * pull[(d + 2) % 3] - at[(d + 2) % 3] * pull[(d + 1) % 3];
    }
    CHECK_NEAR(largest(total, 3), 0, 0, 1e-14 * most * (double)n);
    if (s->geometry == PERI_GEOMETRY_NONLINEAR) CHECK_NEAR(largest(torque, 3), 0, 0, 1e-14 * most * 6 * H * (double)n);
    free(u);
    free(f);
    free(v);
    free(x);
    peri_body_destroy(b);
}

static void derivatives(int32_t space) {
    int32_t geometry, correction;
    int k, broken;
    for (geometry = PERI_GEOMETRY_NONLINEAR; geometry < peri__end_geometry; ++geometry)
        for (correction = PERI_CORRECTION_NONE; correction < peri__end_correction; ++correction)
            for (k = 0; k <= LAWS; ++k)
                for (broken = 0; broken < 2; ++broken) {
                    /* in solids whole and broken by turns; all with --long */
                    if (!test_long && space == PERI_SPACE_SOLID && (geometry + correction + k + broken) % 2) continue;
                    scene s = small_scene(space, geometry, correction);
                    derivative(&s, k ? laws[k - 1] : 0, 0.15 + 0.2 * broken, broken, 0);
                    if (k && correction == PERI_CORRECTION_NONE) derivative(&s, laws[k - 1], 0.15 + 0.2 * broken, broken, 1);
                }
}
static void force_plane_stress(void) { derivatives(PERI_SPACE_PLANE_STRESS); }
static void force_plane_strain(void) { derivatives(PERI_SPACE_PLANE_STRAIN); }
static void force_solid(void) { derivatives(PERI_SPACE_SOLID); }

/* ---- the linear operator ------------------------------------------------------------------------------------------ */

/* -df/du at u = 0, column by column, row-major. Unit displacements where the geometry is linear, else central differences: their error is
   (step/H)^2 times third derivatives and 1e-16 H/step, with 1e-5 H about 1e-10. */
static double *assemble(peri_body *b, int32_t geometry) {
    int64_t n = peri_size_of_field(b, PERI_FIELD_DISPLACEMENT), i, j;
    double *k = (double *)calloc((size_t)(n * n), sizeof *k), *u = (double *)calloc((size_t)n, sizeof *u), *v = get(b, PERI_FIELD_VOLUME);
    double *f = (double *)calloc((size_t)n, sizeof *f), step = geometry == PERI_GEOMETRY_LINEAR ? 1 : 1e-5 * H;
    int sign;
    for (j = 0; j < n; ++j) {
        for (sign = geometry == PERI_GEOMETRY_LINEAR ? 1 : -1; sign < 2; sign += 2) {
            u[j] = sign * step;
            put(b, PERI_FIELD_DISPLACEMENT, u);
            read_forces(b, v, f);
            for (i = 0; i < n; ++i) k[i * n + j] -= f[i] / (geometry == PERI_GEOMETRY_LINEAR ? 1 : 2 * sign * step);
        }
        u[j] = 0;
    }
    free(u);
    free(v);
    free(f);
    return k;
}

/* Eigenvalues of a symmetric matrix, ascending, by Jacobi's rotations; the matrix is destroyed. */
static void eigenvalues(int64_t n, double *a, double *value) {
    int64_t p, q, k;
    int sweep;
    double off = 1, norm = 0;
    for (k = 0; k < n * n; ++k) norm += a[k] * a[k];
    for (sweep = 0; sweep < 40 && off > 1e-30 * norm; ++sweep) {
        for (p = 0; p < n; ++p)
            for (q = p + 1; q < n; ++q) {
                double phi, t, c, s;
                if (fabs(a[p * n + q]) < 1e-300) continue;
                phi = 0.5 * (a[q * n + q] - a[p * n + p]) / a[p * n + q];
                t = (phi < 0 ? -1 : 1) / (fabs(phi) + sqrt(phi * phi + 1));
                c = 1 / sqrt(t * t + 1);
                s = t * c;
                for (k = 0; k < n; ++k) {
                    double x = a[k * n + p], y = a[k * n + q];
                    a[k * n + p] = c * x - s * y;
                    a[k * n + q] = s * x + c * y;
                }
                for (k = 0; k < n; ++k) {
                    double x = a[p * n + k], y = a[q * n + k];
                    a[p * n + k] = c * x - s * y;
                    a[q * n + k] = s * x + c * y;
                }
            }
        for (off = 0, p = 0; p < n; ++p)
            for (q = p + 1; q < n; ++q) off += a[p * n + q] * a[p * n + q];
    }
    CHECK(off <= 1e-30 * norm);
    for (p = 0; p < n; ++p) {
        double x = a[p * n + p];
        for (q = p; q > 0 && value[q - 1] > x; --q) value[q] = value[q - 1];
        value[q] = x;
    }
}

/* How many eigenvalues are zero to rounding: within 1e-12 of the largest (Jacobi's error is some n 1e-16). *least: the smallest of all
   and *next: the smallest of the others, over the largest. */
static int zero_modes(int64_t n, const double *k, double *least, double *next) {
    double *a = (double *)calloc((size_t)(n * n), sizeof *a), *value = (double *)calloc((size_t)n, sizeof *value), most;
    int64_t i, zeros = 0;
    memcpy(a, k, (size_t)(n * n) * sizeof *a);
    eigenvalues(n, a, value);
    most = value[n - 1];
    *least = value[0] / most;
    *next = 1;
    for (i = 0; i < n; ++i) {
        if (fabs(value[i]) < 1e-12 * most) zeros++;
        else *next = fmin(*next, fabs(value[i]) / most);
    }
    free(a);
    free(value);
    return (int)zeros;
}

/* Oterkus: W = a theta^2 + b sum w e^2 V with theta = d sum w e V, and (sum w e V)^2 <= sum w V sum w e^2 V, so W >= (b + a d^2 sum w V)
   sum w e^2 V where a < 0. Constants [C] 12, 16, 17 of every family, 16 on the mean over the directions of shear, of n_1^2 n_2^2: 1/8 and
   1/15. 1: that is positive for all of them, and the body is stable. */
static int oterkus_is_stable(peri_body *b, const scene *s, double nu) {
    int dim = peri_dimension(b), d, stable = 1;
    double *x = get(b, PERI_FIELD_POSITION), *v = get(b, PERI_FIELD_VOLUME);
    moduli e = moduli_of(s->space, nu);
    int64_t n = peri_point_count(b), i, j;
    for (i = 0; i < n; ++i) {
        double total = 0, length = 0, m = 0, ca, cb, cd;
        for (j = 0; j < n; ++j) {
            double xi[3] = {0, 0, 0}, square = 0, w;
            for (d = 0; d < dim; ++d) xi[d] = x[j * dim + d] - x[i * dim + d];
            for (d = 0; d < dim; ++d) square += xi[d] * xi[d];
            if (i == j || sqrt(square) > s->reach * H * (1 + 1e-8)) continue;
            w = influence(s->influence, sqrt(square) / (s->reach * H), 0) * v[j];
            total += w;
            length += w * sqrt(square);
            m += w * square;
        }
        cd = dim / length;
        cb = e.mu / (2 * m / (dim == 3 ? 15 : 8));
        ca = 0.5 * (e.bulk - 2 * cb * m / (dim * dim));
        if (!(cb + fmin(ca, 0) * cd * cd * total > 0)) stable = 0;
    }
    free(x);
    free(v);
    return stable;
}

/* SOURCE OF TRUTH: the derivative of a force that is -dE/du is symmetric, and at u = 0 that of the nonlinear body is the linear one's.
   LPS: W = 1/2 bulk theta^2 + 1/2 B/m sum w (e - theta|xi|/D)^2 V, so for -1 < nu < 1/2 only rigid motion is free; so with stabilized
   correspondence, and for springs; Oterkus where oterkus_is_stable. definite = 0: nothing is known about the modes. */
static void operator_of(const scene *linear, int32_t law, double nu, int broken, int definite) {
    scene s = *linear;
    int32_t rigid = s.space == PERI_SPACE_SOLID ? 6 : 3;
    double *k[2], most, least, next, far = 0, skew = 0;
    int64_t n = 0, i, j;
    int g, zeros;
    for (g = 0; g < 2; ++g) {
        peri_body *b;
        s.geometry = g ? PERI_GEOMETRY_NONLINEAR : PERI_GEOMETRY_LINEAR;
        b = small_body(&s, law, nu, -1, broken);
        n = peri_size_of_field(b, PERI_FIELD_DISPLACEMENT);
        if (law == PERI_LAW_OTERKUS && definite) CHECK(oterkus_is_stable(b, &s, nu));
        k[g] = assemble(b, s.geometry);
        peri_body_destroy(b);
    }
    most = largest(k[0], n * n);
    for (i = 0; i < n; ++i)
        for (j = 0; j < n; ++j) {
            far = fmax(far, fabs(k[0][i * n + j] - k[1][i * n + j]) / most);
            skew = fmax(skew, fabs(k[0][i * n + j] - k[0][j * n + i]) / most);
        }
    CHECK_NEAR(far, 0, 0, 1e-8);
    CHECK_NEAR(skew, 0, 0, 1e-13);
    if (definite) {
        zeros = zero_modes(n, k[0], &least, &next);
        CHECK(zeros == rigid);
        CHECK(least > -1e-12);
        CHECK(next > 1e-6);
        if (test_long) printf("    %-12s %-14s nu %5.2f  skew %.0e  far %.0e  zeros %d  least %8.1e  next %.1e\n",
                              space_name[s.space % 100], law ? law_name[law % 100] : "mixture", nu, skew, far, zeros, least, next);
    }
    free(k[0]);
    free(k[1]);
}

static void operators(int32_t space, int32_t correction) {
    scene s = small_scene(space, PERI_GEOMETRY_LINEAR, correction);
    operator_of(&s, PERI_LAW_LPS, 0.1, 0, 1);
    operator_of(&s, PERI_LAW_LPS, 0.4, 0, 1);
    operator_of(&s, PERI_LAW_LPS, -0.3, 0, 1);
    operator_of(&s, PERI_LAW_OTERKUS, 0.4, 0, 1);
    operator_of(&s, PERI_LAW_OTERKUS, -0.3, 0, 1);
    operator_of(&s, PERI_LAW_CORRESPONDENCE, 0.1, 0, 1);
    operator_of(&s, PERI_LAW_CORRESPONDENCE, 0.4, 0, 1);
    operator_of(&s, PERI_LAW_BOND_BASED, 0, 0, 1);
    operator_of(&s, PERI_LAW_LPS, 0.4, 1, 0);
    operator_of(&s, PERI_LAW_CORRESPONDENCE, 0.1, 1, 0);
    operator_of(&s, PERI_LAW_OTERKUS, 0.1, 1, 0);
    operator_of(&s, 0, 0, 0, 0);
    operator_of(&s, 0, 0, 1, 0);
}
static void operator_plane_stress(void) { operators(PERI_SPACE_PLANE_STRESS, PERI_CORRECTION_NONE); }
static void operator_plane_strain(void) { operators(PERI_SPACE_PLANE_STRAIN, PERI_CORRECTION_MOMENT); }
static void operator_solid(void) { operators(PERI_SPACE_SOLID, PERI_CORRECTION_NONE); }
static void operator_long(void) {
    operators(PERI_SPACE_PLANE_STRESS, PERI_CORRECTION_ENERGY);
    operators(PERI_SPACE_PLANE_STRAIN, PERI_CORRECTION_NONE);
    operators(PERI_SPACE_SOLID, PERI_CORRECTION_MOMENT);
}

/* ---- objectivity -------------------------------------------------------------------------------------------------- */

/* R - 1 about an axis ([Rodrigues]). */
static void rotation(const double *axis, double angle, double grad[3][3]) {
    double n[3], k[3][3] = {{0}}, len = sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
    int a, b, c;
    for (a = 0; a < 3; ++a) n[a] = axis[a] / len;
    k[0][1] = -n[2];
    k[0][2] = n[1];
    k[1][2] = -n[0];
    for (a = 0; a < 3; ++a)
        for (b = 0; b < a; ++b) k[a][b] = -k[b][a];
    for (a = 0; a < 3; ++a)
        for (b = 0; b < 3; ++b) {
            grad[a][b] = sin(angle) * k[a][b];
            for (c = 0; c < 3; ++c) grad[a][b] += (1 - cos(angle)) * k[a][c] * k[c][b];
        }
}

/* SOURCE OF TRUTH: a rigid rotation strains nothing. What is left is the rounding of u, about 1e-16 of |u| < 1 = 10 H: set against
   the force and energy of a random displacement of 1e-3 H = 1e-4, it is smaller by 1e-12, and 100 times that is allowed for sums;
   the energy goes with the square. Strain and stress: 100 roundings of u over H. */
static void rotate(const scene *s, int32_t law, int broken, const double *axis, double angle) {
    static const int32_t fields[4] = {PERI_FIELD_STRAIN, PERI_FIELD_STRESS, PERI_FIELD_FORCE_STRESS, PERI_FIELD_DILATATION};
    peri_body *b = small_body(s, law, 0.1, -1, broken);
    int64_t n = peri_size_of_field(b, PERI_FIELD_DISPLACEMENT);
    double *u = random_field(n, 1e-3 * H, 3), *f, grad[3][3], force, young = YOUNG;
    peri_energy noise, now;
    int k;
    put(b, PERI_FIELD_DISPLACEMENT, u);
    f = get(b, PERI_FIELD_FORCE_DENSITY);
    force = largest(f, n);
    free(f);
    free(u);
    (void)MUST(b, peri_get_energy(b, &noise));
    CHECK(force > 0 && noise.elastic > 0);
    rotation(axis, angle, grad);
    stretch_body(b, grad);
    f = get(b, PERI_FIELD_FORCE_DENSITY);
    CHECK_NEAR(largest(f, n), 0, 0, 1e-10 * force);
    free(f);
    (void)MUST(b, peri_get_energy(b, &now));
    CHECK_NEAR(now.elastic, 0, 0, 1e-20 * noise.elastic);
    for (k = 0; k < 4; ++k) {
        f = get(b, fields[k]);
        CHECK_NEAR(largest(f, peri_size_of_field(b, fields[k])), 0, 0, 1e-13 * (k == 1 || k == 2 ? 10 * young : 1));
        free(f);
    }
    peri_body_destroy(b);
}

static void rigid_rotation(void) {
    static const double up[3] = {0, 0, 1}, skew[3] = {1, -2, 0.5};
    int k, broken;
    int32_t space, correction;
    for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
        for (correction = PERI_CORRECTION_NONE; correction < peri__end_correction; correction += 3)
            for (k = 0; k <= LAWS; ++k)
                for (broken = 0; broken < 2; ++broken) {
                    scene s = small_scene(space, PERI_GEOMETRY_NONLINEAR, correction);
                    rotate(&s, k ? laws[k - 1] : 0, broken, up, PI / 2);
                    rotate(&s, k ? laws[k - 1] : 0, broken, up, 1);
                    if (space == PERI_SPACE_SOLID) rotate(&s, k ? laws[k - 1] : 0, broken, skew, 1);
                }
}

/* ---- finite strain ------------------------------------------------------------------------------------------------ */

static double determinant(int dim, double f[3][3]) {
    if (dim == 2) return f[0][0] * f[1][1] - f[0][1] * f[1][0];
    return f[0][0] * (f[1][1] * f[2][2] - f[1][2] * f[2][1]) - f[0][1] * (f[1][0] * f[2][2] - f[1][2] * f[2][0])
         + f[0][2] * (f[1][0] * f[2][1] - f[1][1] * f[2][0]);
}

/* A uniform F far from 1, on irregular families of every law. SOURCE OF TRUTH: PERI_FIELD_STRAIN is Green-Lagrange E = 1/2 (F^T F - 1); a
   family's collapsed stress sum T xi V is P = dW/dF, here by five-point differences of W with a step of 1e-3, and its Cauchy stress
   the symmetric part of P F^T/det F; for correspondence W = 1/2 lambda (tr E)^2 + mu E:E and P = F S, S = lambda tr(E) + 2 mu E, which is
   PERI_FIELD_STRESS of every law. (In plane stress det F is of the plane.) */
static void finite_of(int32_t space, int32_t law, int32_t correction) {
    const double nu = 0.15, step = 1e-3, f0[3][3] = {{0.2, 0.15, -0.1}, {-0.3, -0.1, 0.2}, {0.05, -0.12, 0.3}};
    scene s = small_scene(space, PERI_GEOMETRY_NONLINEAR, correction);
    peri_body *b = small_body(&s, law, nu, -1, 0);
    int dim = dim_of(space), parts = dim * (dim + 1) / 2, a, c, d, k;
    moduli m = moduli_of(space, law == PERI_LAW_BOND_BASED ? bond_nu(space) : nu);
    int64_t n = peri_point_count(b), i;
    double grad[3][3], f[3][3], e[3][3], second[3][3], trace = 0, w0 = 0, volume, *w, *p, *strain, *stress, *force;
    p = (double *)calloc((size_t)n * 9, sizeof *p); /* [point][3][3] */
    memcpy(grad, f0, sizeof grad);
    for (a = 0; a < dim; ++a)
        for (c = 0; c < dim; ++c)
            for (k = -2; k < 3; ++k) {
                grad[a][c] = f0[a][c] + k * step;
                stretch_body(b, grad);
                w = get(b, PERI_FIELD_ENERGY_DENSITY);
                for (i = 0; i < n; ++i) p[i * 9 + a * 3 + c] += w[i] * (k % 2 ? 8 : -1) * (k > 0 ? 1 : k < 0 ? -1 : 0) / (12 * step);
                free(w);
                grad[a][c] = f0[a][c];
            }
    stretch_body(b, grad);
    for (a = 0; a < 3; ++a)
        for (c = 0; c < 3; ++c) f[a][c] = f0[a][c] + delta(a, c);
    for (a = 0; a < dim; ++a)
        for (c = 0; c < dim; ++c)
            for (d = 0, e[a][c] = -0.5 * delta(a, c); d < dim; ++d) e[a][c] += 0.5 * f[d][a] * f[d][c];
    for (a = 0; a < dim; ++a) trace += e[a][a];
    for (a = 0; a < dim; ++a)
        for (c = 0; c < dim; ++c) {
            second[a][c] = m.lambda * trace * delta(a, c) + 2 * m.mu * e[a][c];
            w0 += 0.5 * second[a][c] * e[a][c];
        }
    volume = determinant(dim, f);
    strain = get(b, PERI_FIELD_STRAIN);
    stress = get(b, PERI_FIELD_STRESS);
    force = get(b, PERI_FIELD_FORCE_STRESS);
    w = get(b, PERI_FIELD_ENERGY_DENSITY);
    for (i = 0; i < n; ++i) {
        if (law == PERI_LAW_CORRESPONDENCE) CHECK_NEAR(w[i], w0, 1e-12, 0);
        for (a = 0; a < dim; ++a)
            for (c = a; c < dim; ++c) {
                double cauchy = 0, pulled = 0;
                for (d = 0; d < dim; ++d) {
                    for (k = 0; k < dim; ++k) cauchy += f[a][d] * second[d][k] * f[c][k] / volume;
                    pulled += 0.5 * (p[i * 9 + a * 3 + d] * f[c][d] + p[i * 9 + c * 3 + d] * f[a][d]) / volume;
                }
                CHECK_NEAR(strain[i * parts + packed(dim, a, c)], e[a][c], 0, 1e-12);
                CHECK_NEAR(stress[i * parts + packed(dim, a, c)], cauchy, 0, 1e-11 * YOUNG);
                CHECK_NEAR(force[i * parts + packed(dim, a, c)], pulled, 0, 1e-8 * YOUNG);
                if (law == PERI_LAW_CORRESPONDENCE) CHECK_NEAR(force[i * parts + packed(dim, a, c)], cauchy, 0, 1e-11 * YOUNG);
            }
    }
    free(p);
    free(w);
    free(strain);
    free(stress);
    free(force);
    peri_body_destroy(b);
}

static void finite_strain(void) {
    int32_t space, correction;
    int k;
    for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
        for (correction = PERI_CORRECTION_NONE; correction < peri__end_correction; correction += 3)
            for (k = 0; k < LAWS; ++k) finite_of(space, laws[k], correction);
}

/* ---- families that do not span the space -------------------------------------------------------------------------- */

/* Five correspondence points on a skew line, one bond cut. SOURCE OF TRUTH: peri.h: they act by central bonds, t = B w e/m0 with m0 of
   the whole family: f_i = sum (B/m0_i + B/m0_j) w e M V, W_i = 1/2 B/m0_i sum w e^2 V over live bonds. */
static void chain(void) {
    static const double n[2][3] = {{0.6, 0.8, 0}, {2.0 / 7, 3.0 / 7, 6.0 / 7}};
    const int32_t pair[2] = {1, 3};
    int32_t space;
    int i, j, d;
    for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space) {
        scene s = scene_of(space, PERI_GEOMETRY_LINEAR, PERI_INFLUENCE_LINEAR, PERI_CORRECTION_NONE, 2.5);
        int dim = dim_of(space);
        const double *line = n[dim - 2];
        double x[15], v[5], m[5] = {0, 0, 0, 0, 0}, cell = pow(H, dim), big = dim * (dim + 2) * moduli_of(space, 0.3).mu, *u, *f, *w;
        peri_body *b = scene_body(&s);
        (void)add_law(b, PERI_LAW_CORRESPONDENCE, 0.3, -1);
        for (i = 0; i < 5; ++i) {
            v[i] = cell;
            for (d = 0; d < dim; ++d) x[i * dim + d] = i * H * line[d];
            for (j = 0; j < 5; ++j)
                if (i != j && abs(i - j) < 3) m[i] += (1 - abs(i - j) / s.reach) * (i - j) * (i - j) * H * H * cell;
        }
        (void)MUST(b, peri_add_points(b, 5, x, v, NULL));
        (void)MUST(b, peri_build(b));
        CHECK(MUST(b, peri_cut_pairs(b, PERI_CUT_INITIAL, 1, pair)) == 1);
        u = random_field(5 * dim, 0.1 * H, 29);
        put(b, PERI_FIELD_DISPLACEMENT, u);
        f = get(b, PERI_FIELD_FORCE_DENSITY);
        w = get(b, PERI_FIELD_ENERGY_DENSITY);
        for (i = 0; i < 5; ++i) {
            double along = 0, energy = 0;
            for (j = 0; j < 5; ++j) {
                double e = 0, weight = (1 - abs(i - j) / s.reach) * cell;
                if (i == j || abs(i - j) > 2 || i + j == 4) continue; /* 1-3 is cut, 0-4 is too long */
                for (d = 0; d < dim; ++d) e += line[d] * (u[j * dim + d] - u[i * dim + d]) * (j > i ? 1 : -1);
                along += big * (1 / m[i] + 1 / m[j]) * weight * e * (j > i ? 1 : -1);
                energy += 0.5 * big / m[i] * weight * e * e;
            }
            for (d = 0; d < dim; ++d) CHECK_NEAR(f[i * dim + d], along * line[d], 0, 1e-11 * YOUNG / H);
            CHECK_NEAR(w[i], energy, 1e-12, 0);
        }
        free(u);
        free(f);
        free(w);
        peri_body_destroy(b);
    }
}

/* ---- single precision --------------------------------------------------------------------------------------------- */

/* SOURCE OF TRUTH: the same body in double precision. Displacements are multiples of 2^-20, exact in both; a force is a sum of some 30
   terms of either sign, each rounded to 6e-8 a few times. */
static void single_precision(void) {
    int32_t space, geometry, correction;
    int k;
    for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
        for (geometry = PERI_GEOMETRY_NONLINEAR; geometry < peri__end_geometry; ++geometry)
            for (correction = PERI_CORRECTION_NONE; correction < peri__end_correction; correction += 3)
                for (k = 0; k <= LAWS; ++k) {
                    double *f[2];
                    int64_t n = 0, i;
                    int p;
                    for (p = 0; p < 2; ++p) {
                        scene s = small_scene(space, geometry, correction);
                        peri_body *b;
                        double *u;
                        s.precision = p ? PERI_PRECISION_SINGLE : PERI_PRECISION_DOUBLE;
                        b = small_body(&s, k ? laws[k - 1] : 0, 0.4, -1, 0);
                        n = peri_size_of_field(b, PERI_FIELD_DISPLACEMENT);
                        u = random_field(n, 0.1 * H, 13);
                        for (i = 0; i < n; ++i) u[i] = floor(u[i] * 1048576) / 1048576;
                        put(b, PERI_FIELD_DISPLACEMENT, u);
                        f[p] = get(b, PERI_FIELD_FORCE_DENSITY);
                        free(u);
                        peri_body_destroy(b);
                    }
                    CHECK(largest(f[0], n) > 0.1 * YOUNG);
                    for (i = 0; i < n; ++i) CHECK_NEAR(f[1][i], f[0][i], 0, 1e-5 * largest(f[0], n));
                    free(f[0]);
                    free(f[1]);
                }
}

/* ---- zero-energy modes of correspondence -------------------------------------------------------------------------- */

/* The Hessian of the energy of the points of the bulk alone (whole families; the rim only carries displacements), from energies of unit
   displacements and of pairs of them. SOURCE OF TRUTH: counting. Without stabilization the energy knows three strains of each of the
   5 x 5 points of the bulk, and they cannot hold the 98 displacements of 7 x 7 points: at least 98 - 75 modes are free. With it, no
   energy means that every family of the bulk moves affinely and without strain; they overlap, and at a horizon of 1.5 spacings every
   point is in one: the three rigid modes are left. (In a whole body the rim, whose families are one-sided, holds the modes.) */
static void bulk_modes(double stable, int *zeros, double *least) {
    scene s = scene_of(PERI_SPACE_PLANE_STRAIN, PERI_GEOMETRY_LINEAR, PERI_INFLUENCE_CONSTANT, PERI_CORRECTION_NONE, 1.5);
    const double lo[2] = {0, 0}, hi[2] = {7 * H, 7 * H};
    peri_body *b = scene_body(&s);
    double *hessian, *u, *w, next;
    int64_t n, i, j, p;
    (void)add_law(b, PERI_LAW_CORRESPONDENCE, 0.2, stable);
    (void)MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo, hi, H));
    (void)MUST(b, peri_build(b));
    n = peri_size_of_field(b, PERI_FIELD_DISPLACEMENT);
    hessian = (double *)calloc((size_t)(n * n), sizeof *hessian);
    u = (double *)calloc((size_t)n, sizeof *u);
    for (i = 0; i < n; ++i)
        for (j = 0; j <= i; ++j) {
            double sum = 0;
            u[i] += H;
            u[j] += H;
            put(b, PERI_FIELD_DISPLACEMENT, u);
            w = get(b, PERI_FIELD_ENERGY_DENSITY);
            for (p = 0; p < 49; ++p)
                if (p % 7 > 0 && p % 7 < 6 && p / 7 > 0 && p / 7 < 6) sum += w[p];
            hessian[i * n + j] = i == j ? sum / 2 : sum; /* W(2u) = 2 K_ii; else W(u_i) + W(u_j) + K_ij */
            u[i] = u[j] = 0;
            free(w);
        }
    for (i = 0; i < n; ++i)
        for (j = 0; j < i; ++j) {
            hessian[i * n + j] -= 0.5 * (hessian[i * n + i] + hessian[j * n + j]);
            hessian[j * n + i] = hessian[i * n + j];
        }
    *zeros = zero_modes(n, hessian, least, &next);
    printf("    bulk modes without energy at stabilization %.2f: %d of %d; next %.1e\n", stable, *zeros, (int)n, next);
    CHECK(next > 1e-6);
    free(hessian);
    free(u);
    peri_body_destroy(b);
}

static void zero_energy_modes(void) {
    double least;
    int zeros;
    bulk_modes(0, &zeros, &least);
    CHECK(zeros >= 98 - 75 && least > -1e-12);
    bulk_modes(0.5, &zeros, &least);
    CHECK(zeros == 3 && least > -1e-12);
}

/* SOURCE OF TRUTH: a linear operator is linear, whatever the size: of a vector of a few units of the smallest number of double the
   product is that of the same vector times 2^1000, over 2^1000. A modulus of 1e20 keeps it among the normal numbers, where that is
   exact. */
static void smallest_vectors(void) {
    int32_t precision;
    for (precision = PERI_PRECISION_DOUBLE; precision < peri__end_precision; ++precision) {
        specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, 0.2, 1, 2, 6, 5, 1);
        double in[60], small[60], out[60], tiny[60];
        peri_body *b;
        int k;
        s.desc.precision = precision;
        s.material.young = 1e20;
        b = specimen_make(&s);
        for (k = 0; k < 60; ++k) {
            small[k] = (k * k % 7 - 3) * 4.9406564584124654e-324;
            in[k] = ldexp(small[k], 1000);
        }
        CHECK(in[0] != 0);
        MUST(b, peri_multiply_stiffness(b, in, out, 60));
        MUST(b, peri_multiply_stiffness(b, small, tiny, 60));
        for (k = 0; k < 60; ++k) CHECK_NEAR(tiny[k], ldexp(out[k], -1000), precision == PERI_PRECISION_SINGLE ? 1e-5 : 1e-13, 0);
        CHECK(largest(tiny, 60) > 1e-304);
        peri_body_destroy(b);
    }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(force_plane_stress);
    RUN(force_plane_strain);
    RUN(force_solid);
    RUN(operator_plane_stress);
    RUN(operator_plane_strain);
    RUN(operator_solid);
    RUN(rigid_rotation);
    RUN(finite_strain);
    RUN(single_precision);
    RUN(zero_energy_modes);
    RUN(chain);
    RUN(smallest_vectors);
    LONG_RUN(operator_long);
    return test_end("test_operator");
}
