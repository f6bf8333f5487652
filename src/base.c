/* base.c - compiler differences, small arithmetic, numbers to text. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#if defined(__GNUC__) || defined(__clang__)
#define PERI_INLINE static inline __attribute__((always_inline))
#elif defined(_MSC_VER)
#define PERI_INLINE static __forceinline
#else
#define PERI_INLINE static
#endif

#if defined(_MSC_VER)
#define PERI_RESTRICT __restrict
#else
#define PERI_RESTRICT restrict
#endif

#if defined(__GNUC__) || defined(__clang__)
#define PERI_PREFETCH(address) __builtin_prefetch(address)
#else
#define PERI_PREFETCH(address) ((void)(address))
#endif

/* Arithmetic is what is written, whatever the user's flags: refusals compare with NaN and infinity, which -ffinite-math-only would fold
   away, and both ends of a bond must come to the same number, which sums taken in another order or fused with products (FMA) do not.
   clang's -ffast-math fuses, and estimates square roots, in spite of the pragma. Ends with peri_impl.c. */
#if defined(__clang__) && __clang_major__ >= 12
#define PERI_AS_WRITTEN
#pragma float_control(push)
#pragma float_control(precise, on)
#pragma clang fp contract(off)
#elif defined(__GNUC__) && !defined(__clang__) && !defined(__TINYC__) &&                                                \
    (__FINITE_MATH_ONLY__ || defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || defined(__NO_SIGNED_ZEROS__) || \
     defined(__FP_FAST_FMA))
#define PERI_AS_WRITTEN
#pragma GCC push_options
#pragma GCC optimize("no-finite-math-only", "no-associative-math", "no-reciprocal-math", "signed-zeros", "no-unsafe-math-optimizations", \
                     "fp-contract=off")
#endif

/* Kernels on columns and on the list work on vectors (k_vector.inl): on x86-64 with the best instruction set, chosen at run time; elsewhere
   those of gcc and clang, or plain loops over lanes. Products and sums stay apart (no contraction), so that every instruction set gives the
   same bits. gcc gets its options here, whatever the user's flags: at -O2 it does not unroll the loops over dimensions and pieces, which
   costs half the speed and more. Builds with gcc's address sanitizer, or with PERI_PLAIN, take the plain text alone: vector code takes
   minutes to instrument. */
#if defined(__clang__)
#define PERI_VECTOR_CODE
#define PERI_NO_CONTRACTION _Pragma("clang fp contract(off)")
#define PERI_WIDE "avx512f,avx512vl,avx512dq,avx512bw"
#elif defined(__GNUC__) && !defined(__SANITIZE_ADDRESS__)
#define PERI_VECTOR_CODE __attribute__((optimize("O3", "no-trapping-math", "fp-contract=off")))
#define PERI_NO_CONTRACTION
#define PERI_WIDE "avx512f,avx512vl,avx512dq,avx512bw,prefer-vector-width=512"
#else
#define PERI_VECTOR_CODE
#define PERI_NO_CONTRACTION
#endif
#if (defined(__GNUC__) || defined(__clang__)) && !defined(__TINYC__) && !defined(__SANITIZE_ADDRESS__) && !defined(PERI_PLAIN)
#if defined(__x86_64__) && !defined(PERI_PORTABLE)
#define PERI_ISA
#include <immintrin.h>
#define PERI_TARGET_AVX2 __attribute__((target("avx2")))
#define PERI_TARGET_AVX512 __attribute__((target(PERI_WIDE)))
/* Sums over lanes, by halves. */
PERI_INLINE double peri__across_2(__m128d a) { return _mm_cvtsd_f64(_mm_add_sd(a, _mm_unpackhi_pd(a, a))); }
PERI_INLINE float peri__across_4(__m128 a) {
    const __m128 half = _mm_add_ps(a, _mm_movehl_ps(a, a));
    return _mm_cvtss_f32(_mm_add_ss(half, _mm_shuffle_ps(half, half, 1)));
}
#elif !defined(__i386__) || defined(__SSE2__)
#define PERI_GENERIC /* the vectors of gcc and clang, 16 bytes: NEON, VSX, ... */
typedef double  peri__double2 __attribute__((vector_size(16)));
typedef float   peri__float4 __attribute__((vector_size(16)));
typedef int64_t peri__long2 __attribute__((vector_size(16)));
typedef int32_t peri__int4 __attribute__((vector_size(16)));
#endif
#endif

/* 2: AVX-512, 1: AVX2, 0: what the compiler takes for granted; no more than `most`, a peri_instructions or 0. */
static int32_t peri__isa(int32_t most) {
#ifdef PERI_ISA
    if ((most == 0 || most >= PERI_AVX512) && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl")
        && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw"))
        return 2;
    if ((most == 0 || most >= PERI_AVX2) && __builtin_cpu_supports("avx2")) return 1;
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

static int64_t peri__min(int64_t a, int64_t b) { return a < b ? a : b; }
static double peri__square(double a) { return a * a; }

/* a as a double: the registers of the x87 have more digits and a wider range. */
static double peri__stored(double a) {
    volatile double stored = a;
    return stored;
}

/* Finite, without isfinite: -ffast-math compilers may fold isfinite to 1. */
static int peri__finite(double a) { return a >= -DBL_MAX && a <= DBL_MAX; }

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

/* ---- numbers to text: no printf, so no locale and no stdio -------------------------------------------------------- */

static char *peri__put_text(char *out, const char *text) {
    size_t length = strlen(text);
    memcpy(out, text, length);
    return out + length;
}

static char *peri__put_integer(char *out, int64_t value) {
    char digits[24];
    int count = 0;
    uint64_t rest = value < 0 ? (uint64_t)0 - (uint64_t)value : (uint64_t)value;
    if (value < 0) *out++ = '-';
    do {
        digits[count++] = (char)('0' + (int)(rest % 10));
        rest /= 10;
    } while (rest > 0);
    while (count > 0) *out++ = digits[--count];
    return out;
}

/* d.ddddddddddddddde[-]ddd, 16 significant digits, right to a few units of the last. At most 26 characters. */
static char *peri__put_double(char *out, double value) {
    if (value != value) return peri__put_text(out, "nan");
    if (value < 0.0) {
        *out++ = '-';
        value = -value;
    }
    if (value == 0.0) return peri__put_text(out, "0");
    if (value > DBL_MAX) return peri__put_text(out, "inf");
    int exponent = (int)floor(log10(value));
    /* two factors: 10^exponent alone over- or underflows at the ends of the range */
    int half = exponent / 2;
    double scaled = value / pow(10.0, half) / pow(10.0, exponent - half) * 1e15;
    if (scaled < 1e15) {
        scaled *= 10.0;
        exponent--;
    }
    if (scaled >= 9999999999999999.5) {
        scaled /= 10.0;
        exponent++;
    }
    char digits[32];
    char *end = peri__put_integer(digits, (int64_t)(scaled + 0.5));
    while (end > digits + 1 && end[-1] == '0') --end;
    *out++ = digits[0];
    if (end > digits + 1) {
        *out++ = '.';
        memcpy(out, digits + 1, (size_t)(end - digits - 1));
        out += end - digits - 1;
    }
    if (exponent != 0) {
        *out++ = 'e';
        out = peri__put_integer(out, exponent);
    }
    return out;
}
