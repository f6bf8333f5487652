/* SPDX-License-Identifier: MIT */
/* limits.c - what one core of the machine can do, by loops that do nothing else: operations per second of vectors as wide as the
   compiler's target has, and the flow of data at sizes from cache to memory. Compiled -O3 -march=native. Without vector
   intrinsics (other machines than x86-64) the loops are plain and as wide as the compiler makes them.

   Additions and multiplications go round in registers, in chains enough to fill both pipes; roots and divisions take their arguments from
   the first-level cache, all different, and add the results up, which has a pipe of its own. */
#include "suite.h"

#if defined(__AVX512F__) || defined(__AVX2__)
#include <immintrin.h>
#endif

#define CHAINS 6      /* of each kind: 12 and two constants fit the 16 registers of AVX2                                            */
#define TURNS 200000  /* about 1 ms                                                                                                 */
#define ARGUMENTS 512 /* reals, twice: of the first-level cache                                                                     */

#if defined(__AVX512F__)
#define VECTORS "AVX-512"
#define HAS_FMA 1
#define V64(name) _mm512_##name##_pd
#define V32(name) _mm512_##name##_ps
typedef __m512d vector64;
typedef __m512 vector32;
#elif defined(__AVX2__) && defined(__FMA__)
#define VECTORS "AVX2"
#define HAS_FMA 1
#define V64(name) _mm256_##name##_pd
#define V32(name) _mm256_##name##_ps
typedef __m256d vector64;
typedef __m256 vector32;
#else
#define VECTORS "plain"
#define HAS_FMA 0
#define LANES 8
typedef struct vector64 { double lane[LANES]; } vector64;
typedef struct vector32 { float lane[LANES]; } vector32;
#define PLAIN(vector, real, suffix, root)                                                                              \
    static inline vector plain_set1_##suffix(real a) { vector v; for (int l = 0; l < LANES; ++l) v.lane[l] = a; return v; } \
    static inline vector plain_loadu_##suffix(const real *a) { vector v; for (int l = 0; l < LANES; ++l) v.lane[l] = a[l]; return v; } \
    static inline void plain_storeu_##suffix(real *a, vector v) { for (int l = 0; l < LANES; ++l) a[l] = v.lane[l]; }    \
    static inline vector plain_add_##suffix(vector a, vector b) { for (int l = 0; l < LANES; ++l) a.lane[l] += b.lane[l]; return a; } \
    static inline vector plain_mul_##suffix(vector a, vector b) { for (int l = 0; l < LANES; ++l) a.lane[l] *= b.lane[l]; return a; } \
    static inline vector plain_div_##suffix(vector a, vector b) { for (int l = 0; l < LANES; ++l) a.lane[l] /= b.lane[l]; return a; } \
    static inline vector plain_sqrt_##suffix(vector a) { for (int l = 0; l < LANES; ++l) a.lane[l] = root(a.lane[l]); return a; }
PLAIN(vector64, double, d, sqrt)
PLAIN(vector32, float, f, sqrtf)
#define V64(name) plain_##name##_d
#define V32(name) plain_##name##_f
#endif

const char *machine_vectors(void) { return VECTORS; }

/* A function that times `turn` over `turns` turns of `operations` vectors of work each: 1e9 operations per second, the best of `repeats`.
   `one` and `nil` come from outside, chains start from different numbers, and where the arguments are is read anew in each turn, so that
   nothing can be left out or done once for all. */
#define RATE(function, real, vector, V, turns, operations, turn)                                                      \
    static double function(int64_t repeats, const real *from) {                                                      \
        const int64_t lanes = (int64_t)(sizeof(vector) / sizeof(real));                                                \
        double best = 1e300;                                                                                           \
        real out[sizeof(vector) / sizeof(real)];                                                                       \
        vector a[CHAINS], b[CHAINS];                                                                                   \
        const vector one = V(set1)(from[0]), nil = V(set1)(from[1]);                                                   \
        const real *volatile place = from;                                                                             \
        volatile real sink;                                                                                            \
        for (int64_t r = 0; r < repeats; ++r) {                                                                        \
            const double start = processor_seconds();                                                                            \
            EACH(a[c] = V(loadu)(from + 2 + c); b[c] = V(loadu)(from + 2 + CHAINS + c))                                \
            for (int64_t k = 0; k < (turns); ++k) {                                                                    \
                turn                                                                                                   \
            }                                                                                                          \
            for (int c = 1; c < CHAINS; ++c) a[0] = V(add)(a[0], V(add)(a[c], b[c]));                                  \
            V(storeu)(out, V(add)(a[0], b[0]));                                                                        \
            sink = out[0];                                                                                             \
            (void)sink;                                                                                                \
            if (processor_seconds() - start < best) best = processor_seconds() - start;                                                    \
        }                                                                                                              \
        (void)place;                                                                                                   \
        (void)one;                                                                                                     \
        (void)nil;                                                                                                     \
        return (double)((turns) * (operations) * lanes) / best / 1e9;                                                  \
    }
#define EACH(statement)                                                                                                \
    for (int c = 0; c < CHAINS; ++c) { statement; }
/* All arguments once. */
#define ALL(real, V, expression)                                                                                       \
    const real *at = place;                                                                                            \
    for (int64_t n = 0; n + CHAINS * lanes <= ARGUMENTS; n += CHAINS * lanes)                                          \
        EACH(a[c] = V(add)(a[c], expression))
#define VISITS (ARGUMENTS / (CHAINS * lanes) * CHAINS)
#define FIRST(V) V(loadu)(at + n + c * lanes)
#define SECOND(V) V(loadu)(at + ARGUMENTS + n + c * lanes)

#define RATES(real, vector, V, suffix)                                                                                 \
    RATE(add_##suffix, real, vector, V, TURNS, 2 * CHAINS, EACH(a[c] = V(add)(a[c], nil); b[c] = V(add)(b[c], nil)))   \
    RATE(mul_##suffix, real, vector, V, TURNS, 2 * CHAINS, EACH(a[c] = V(mul)(a[c], one); b[c] = V(mul)(b[c], one)))   \
    RATE(both_##suffix, real, vector, V, TURNS, 2 * CHAINS, EACH(a[c] = V(mul)(a[c], one); b[c] = V(add)(b[c], nil)))  \
    RATE(root_##suffix, real, vector, V, TURNS / 80, VISITS, ALL(real, V, V(sqrt)(FIRST(V))))                                \
    RATE(div_##suffix, real, vector, V, TURNS / 80, VISITS, ALL(real, V, V(div)(FIRST(V), SECOND(V))))                       \
    RATE(pair_##suffix, real, vector, V, TURNS / 80, VISITS, ALL(real, V, V(div)(SECOND(V), V(sqrt)(FIRST(V)))))
RATES(double, vector64, V64, d)
RATES(float, vector32, V32, f)
#if HAS_FMA
#define FUSED EACH(a[c] = V(fmadd)(a[c], one, nil); b[c] = V(fmadd)(b[c], one, nil))
#define V V64
RATE(fma_d, double, vector64, V64, TURNS, 4 * CHAINS, FUSED)
#undef V
#define V V32
RATE(fma_f, float, vector32, V32, TURNS, 4 * CHAINS, FUSED)
#undef V
#else
static double fma_d(int64_t repeats, const double *from) { return (void)repeats, (void)from, 0.0; }
static double fma_f(int64_t repeats, const float *from) { return (void)repeats, (void)from, 0.0; }
#endif

/* GB/s of b = s a, or of a = s a, counting what is read and what is written: the cache may read b, too, before it writes. */
static double flow(float *a, float *b, int64_t count, float s, int64_t repeats) {
    const int64_t turns = 16000000 / count + 1;
    double best = 1e300;
    for (int64_t r = 0; r < repeats; ++r) {
        const double start = processor_seconds();
        for (int64_t k = 0; k < turns; ++k) {
            const int64_t lanes = (int64_t)(sizeof(vector32) / sizeof(float));
            for (int64_t n = 0; n < count; n += 2 * lanes) {
                const vector32 first = V32(mul)(V32(loadu)(a + n), V32(set1)(s));
                const vector32 second = V32(mul)(V32(loadu)(a + n + lanes), V32(set1)(s));
                V32(storeu)(b + n, first);
                V32(storeu)(b + n + lanes, second);
            }
        }
        if ((processor_seconds() - start) / (double)turns < best) best = (processor_seconds() - start) / (double)turns;
    }
    return 2.0 * (double)count * sizeof(float) / best / 1e9;
}

void machine_measure(machine *m, int64_t repeats) {
    double from64[2 * ARGUMENTS];
    float from32[2 * ARGUMENTS];
    const int64_t most = (int64_t)65536 << 2 * (RUNGS - 1); /* floats of the largest rung */
    float *a = (float *)malloc((size_t)most * sizeof *a);
    volatile float one = 1.0f;
    if (!a) exit(1);
    for (int k = 0; k < 2 * ARGUMENTS; ++k) from64[k] = k == 0 ? 1.0 : k == 1 ? 0.0 : 1.0 + (double)(k * 7919 % 1009) / 1009.0;
    for (int k = 0; k < 2 * ARGUMENTS; ++k) from32[k] = (float)from64[k];
    for (int64_t k = 0; k < most; ++k) a[k] = 1.0f;
    m->add[0] = add_d(repeats, from64);
    m->add[1] = add_f(repeats, from32);
    m->mul[0] = mul_d(repeats, from64);
    m->mul[1] = mul_f(repeats, from32);
    m->both[0] = both_d(repeats, from64);
    m->both[1] = both_f(repeats, from32);
    m->fma[0] = fma_d(repeats, from64);
    m->fma[1] = fma_f(repeats, from32);
    m->root[0] = root_d(repeats, from64);
    m->root[1] = root_f(repeats, from32);
    m->div[0] = div_d(repeats, from64);
    m->div[1] = div_f(repeats, from32);
    m->pair[0] = pair_d(repeats, from64);
    m->pair[1] = pair_f(repeats, from32);
    for (int k = 0; k < RUNGS; ++k) {
        const int64_t count = (int64_t)65536 << 2 * k;
        m->copy[k] = flow(a, a + count / 2, count / 2, one, repeats);
        m->update[k] = flow(a, a, count, one, repeats);
    }
    free(a);
}
