/* SPDX-License-Identifier: MIT */
/* base.c - the instruction set, constants, small arithmetic. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

/* 2: AVX-512, 1: AVX2, 0: what the compiler takes for granted; no more than `most`, a peri_instructions. */
static int32_t peri__isa(int32_t most) {
#ifdef PERI_ISA
    if (most == PERI_INSTRUCTIONS_BEST) most = PERI_INSTRUCTIONS_AVX512;
    if (most >= PERI_INSTRUCTIONS_AVX512 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl")
        && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw"))
        return 2;
    if (most >= PERI_INSTRUCTIONS_AVX2 && __builtin_cpu_supports("avx2")) return 1;
#endif
    (void)most;
    return 0;
}

#ifdef PERI_ISA
#define PERI_BY_ISA(isa, name, arguments)                                                                              \
    ((isa) == 2 ? name##_avx512 arguments : (isa) == 1 ? name##_avx2 arguments : name##_plain arguments)
#else
#define PERI_BY_ISA(isa, name, arguments) name##_plain arguments
#endif

#define PERI_PI 3.14159265358979323846264338327950288

/* Horizon comparisons: |xi| <= horizon*(1 + PERI_HORIZON_TOLERANCE). Far above the rounding of coordinates a million spacings
   from the origin (2e-10), far below any distance that two lattice shells can differ by. */
#define PERI_HORIZON_TOLERANCE 1e-8

/* Cracks and selections touch what is nearer than this many spacings. */
#define PERI_TOUCH 1e-9

/* a as a double: the registers of the x87 have more digits and a wider range. */
static double peri__stored(double a) {
    volatile double stored = a;
    return stored;
}

/* Is this a choice of an enum that counts from 1? */

/* Finite, without isfinite: -ffast-math compilers may fold isfinite to 1. */
/* As the default of some settings; written out, for compilers that take numbers to be finite. */
static int peri__is_nan(double a) {
    uint64_t bits;
    memcpy(&bits, &a, sizeof bits);
    return (bits & 0x7FFFFFFFFFFFFFFFu) > 0x7FF0000000000000u;
}

static int peri__finite(double a) { return a >= -DBL_MAX && a <= DBL_MAX; }

/* The first entry that is not finite. */
static double peri__not_finite(const double *a, int32_t dim) {
    int32_t d = 0;
    while (d < dim - 1 && peri__finite(a[d])) ++d;
    return a[d];
}

static int peri__finite_vector(const double *a, int32_t dim) {
    for (int32_t d = 0; d < dim; ++d)
        if (!peri__finite(a[d])) return 0;
    return 1;
}

static double peri__dot(const double *a, const double *b, int32_t dim) {
    double sum = 0.0;
    for (int32_t d = 0; d < dim; ++d) sum += a[d] * b[d];
    return sum;
}

/* The direction of a, of length 1; scaled by a power of 2 first, so that squares stay in range. 0 where it has none. */
static int peri__direction(const double *a, int32_t dim, double *unit) {
    double largest = 0.0, length;
    int exponent;
    for (int32_t d = 0; d < dim; ++d)
        if (fabs(a[d]) > largest) largest = fabs(a[d]);
    (void)frexp(largest, &exponent);
    for (int32_t d = 0; d < dim; ++d) unit[d] = ldexp(a[d], -exponent);
    length = sqrt(peri__dot(unit, unit, dim));
    for (int32_t d = 0; largest > 0.0 && d < dim; ++d) unit[d] /= length;
    return largest > 0.0;
}

/* splitmix64: a fixed generator, so that a seed means the same grid on every machine. Uniform in [-1, 1). */
static double peri__random(uint64_t *state) {
    uint64_t z = (*state += UINT64_C(0x9E3779B97F4A7C15));
    z = (z ^ (z >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94D049BB133111EB);
    z ^= z >> 31;
    return (double)(z >> 11) * (1.0 / 4503599627370496.0) - 1.0;
}

/* Nodes and weights of Gauss-Legendre quadrature on [0, 1], by Newton's method on P_n. */
#define PERI_GAUSS 20
static void peri__gauss(double *x, double *w) {
    for (int k = 0; k < PERI_GAUSS; ++k) {
        double z = cos(PERI_PI * (k + 0.75) / (PERI_GAUSS + 0.5)), slope = 1.0;
        for (int newton = 0; newton < 8; ++newton) {
            double p0 = 1.0, p1 = z;
            for (int n = 2; n <= PERI_GAUSS; ++n) {
                double p2 = ((2 * n - 1) * z * p1 - (n - 1) * p0) / n;
                p0 = p1;
                p1 = p2;
            }
            slope = PERI_GAUSS * (z * p1 - p0) / (z * z - 1.0);
            z -= p1 / slope;
        }
        x[k] = 0.5 * (1.0 - z);
        w[k] = 1.0 / ((1.0 - z * z) * slope * slope);
    }
}
