/* SPDX-License-Identifier: MIT */
/* compiler.h - what compilers and machines differ in. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif
#ifdef __cplusplus
#error "peri_impl.c is C99: compile it as C (cc, not c++), and link it; C++ files include peri.h alone"
#endif

/* A build without some of its parts has functions that nothing calls; in the whole library such a function is a mistake. Ends with
   peri_impl.c. */
#if defined(PERI_NO_2D) && defined(PERI_NO_3D)
#error "PERI_NO_2D and PERI_NO_3D: one of both must stay"
#endif
#if defined(PERI_NO_F64) && defined(PERI_NO_MIXED) && defined(PERI_NO_F32)
#error "PERI_NO_F64, PERI_NO_MIXED and PERI_NO_F32: one of them must stay"
#endif
#if (defined(__GNUC__) || defined(__clang__)) &&                                                                       \
    (defined(PERI_NO_2D) || defined(PERI_NO_3D) || defined(PERI_NO_F64) || defined(PERI_NO_MIXED) || defined(PERI_NO_F32) || \
     defined(PERI_NO_STATICS) || defined(PERI_NO_ADVICE) || defined(PERI_NO_OUTPUT))
#define PERI_UNCALLED
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#endif

/* Without optimisation, and under sanitizers, to inline what is small costs gcc a third of its time and saves little when it runs. An
   inline text may serve one of its includers alone. */
#if (defined(__GNUC__) || defined(__clang__)) && defined(__OPTIMIZE__) && !defined(__SANITIZE_ADDRESS__)
#define PERI_INLINE static inline __attribute__((always_inline, unused))
#elif defined(__GNUC__) || defined(__clang__)
#define PERI_INLINE static inline __attribute__((unused))
#elif defined(_MSC_VER)
#define PERI_INLINE static __forceinline
#else
#define PERI_INLINE static
#endif

/* PERI_RARE: a function of kernels that few bonds come by, which is not copied into each of its callers. */
#if (defined(__GNUC__) || defined(__clang__)) && !defined(__TINYC__)
#define PERI_RARE __attribute__((noinline, cold))
#else
#define PERI_RARE
#endif

/* PERI_APART: one that many may come by, and that is too large for copies. */
#if (defined(__GNUC__) || defined(__clang__)) && !defined(__TINYC__)
#define PERI_APART __attribute__((noinline))
#else
#define PERI_APART
#endif

/* PERI_SMALL ... PERI_SMALL_END: what runs once in the life of a body, or in none, is optimised for size by gcc (clang has no such pragma).
   The arithmetic is the same. */
#if defined(__GNUC__) && !defined(__clang__) && !defined(__TINYC__) && defined(__OPTIMIZE__) && !defined(__SANITIZE_ADDRESS__)
#define PERI_SMALL _Pragma("GCC push_options") _Pragma("GCC optimize(\"Os\")")
#define PERI_SMALL_END _Pragma("GCC pop_options")
#else
#define PERI_SMALL
#define PERI_SMALL_END
#endif

/* PERI_SHARED: what the kernels and the rest call of each other. The library is one unit, but for developers the kernels are objects of
   their own (PERI_SPLIT), which an edit elsewhere leaves alone. */
#ifndef PERI_SPLIT
#define PERI_SHARED static
#elif (defined(__GNUC__) || defined(__clang__)) && !defined(_WIN32) /* a DLL exports what says so */
#define PERI_SHARED __attribute__((visibility("hidden")))
#else
#define PERI_SHARED
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
#if defined(__clang__) && __clang_major__ >= 12 && !defined(__wasm__) /* which clang gives no such pragma */
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

/* PERI_KERNELS: the texts of the kernels on columns and on the list that are compiled (vector.inl): 1 plain C99, one lane at a time;
   2 the vectors of gcc and clang, 16 bytes; 3 on x86-64 SSE2, AVX2 and AVX-512, of which the best is chosen at run time, elsewhere as 2.
   1 is for builds without optimisation, which would take a minute, and with gcc's address sanitizer, minutes; and all that other
   compilers can. Products and sums stay apart (no contraction), so that every text gives the same bits. gcc gets its options here, whatever
   the user's flags: at -O2 it does not unroll the loops over dimensions and pieces, which costs half the speed and more. */
#ifndef PERI_KERNELS
#if (defined(__GNUC__) || defined(__clang__)) && defined(__OPTIMIZE__) && !defined(__SANITIZE_ADDRESS__)
#define PERI_KERNELS 3
#else
#define PERI_KERNELS 1
#endif
#endif
#if defined(__clang__)
#define PERI_NO_UNROLLING _Pragma("clang loop unroll(disable)")
#elif defined(__GNUC__) && !defined(__TINYC__) && __GNUC__ >= 8
#define PERI_NO_UNROLLING _Pragma("GCC unroll 1")
#else
#define PERI_NO_UNROLLING
#endif
#if defined(__clang__)
#define PERI_VECTOR_CODE
#define PERI_NO_CONTRACTION _Pragma("clang fp contract(off)")
#define PERI_WIDE "avx512f,avx512vl,avx512dq,avx512bw"
#elif defined(__GNUC__) && defined(__OPTIMIZE__) && !defined(__SANITIZE_ADDRESS__)
#define PERI_VECTOR_CODE __attribute__((optimize("O3", "no-trapping-math", "fp-contract=off")))
#define PERI_NO_CONTRACTION
#define PERI_WIDE "avx512f,avx512vl,avx512dq,avx512bw,prefer-vector-width=512"
#else
#define PERI_VECTOR_CODE
#define PERI_NO_CONTRACTION
#define PERI_WIDE "avx512f,avx512vl,avx512dq,avx512bw"
#endif
#if (defined(__GNUC__) || defined(__clang__)) && !defined(__TINYC__) && PERI_KERNELS > 1
#if defined(__x86_64__) && PERI_KERNELS > 2
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
