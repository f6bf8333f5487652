/* kernels.inl - the driver of the kernel templates. Included once per real type and dimension with PERI_T_REAL (64, 32) and
   PERI_T_DIM (2, 3) set; defines the kernels and one table of them, and undefines all it defined. */

#if PERI_T_REAL == 64
#define peri_r double
#define peri_i int64_t
#define PERI_SQRT sqrt
#define PERI_CHUNK 8 /* bonds of a row that are worked on at once                                                       */
#define PERI_NEAR 1e-12 /* relative; kernels on lanes leave bonds this near their critical stretch to the rows            */
#define PERI_TINY 1e-290 /* keeps 0/0 out of a bond whose ends meet; far below any length                                */
#if PERI_T_DIM == 2
#define PERI_FN(name) peri__##name##_d2
#else
#define PERI_FN(name) peri__##name##_d3
#endif
#else
#define peri_r float
#define peri_i int32_t
#define PERI_SQRT sqrtf
#define PERI_CHUNK 16
#define PERI_NEAR 1e-5
#define PERI_TINY 1e-30f
#if PERI_T_DIM == 2
#define PERI_FN(name) peri__##name##_f2
#else
#define PERI_FN(name) peri__##name##_f3
#endif
#endif
#define PERI_D PERI_T_DIM

#include "k_bond.inl"

/* Square roots of PERI_LANES lanes in place. As intrinsics, because a call of sqrt may set errno and so is never vectorised. */
#ifdef PERI_ISA
#define PERI_LANES_ROOTS(name, target, width, load, store, root)                                                       \
    target PERI_INLINE void PERI_FN(name)(peri_r *a) {                                                                 \
        for (int l = 0; l < PERI_LANES; l += width) store(a + l, root(load(a + l)));                                   \
    }
#if PERI_T_REAL == 64
PERI_LANES_ROOTS(sqrt_plain, PERI_VECTOR_CODE, 2, _mm_loadu_pd, _mm_storeu_pd, _mm_sqrt_pd)
PERI_LANES_ROOTS(sqrt_avx2, PERI_VECTOR_CODE PERI_AVX2, 4, _mm256_loadu_pd, _mm256_storeu_pd, _mm256_sqrt_pd)
PERI_LANES_ROOTS(sqrt_avx512, PERI_VECTOR_CODE PERI_AVX512, 8, _mm512_loadu_pd, _mm512_storeu_pd, _mm512_sqrt_pd)
#else
PERI_LANES_ROOTS(sqrt_plain, PERI_VECTOR_CODE, 4, _mm_loadu_ps, _mm_storeu_ps, _mm_sqrt_ps)
PERI_LANES_ROOTS(sqrt_avx2, PERI_VECTOR_CODE PERI_AVX2, 8, _mm256_loadu_ps, _mm256_storeu_ps, _mm256_sqrt_ps)
PERI_LANES_ROOTS(sqrt_avx512, PERI_VECTOR_CODE PERI_AVX512, 16, _mm512_loadu_ps, _mm512_storeu_ps, _mm512_sqrt_ps)
#endif
#undef PERI_LANES_ROOTS
#else
PERI_INLINE void PERI_FN(sqrt_plain)(peri_r *a) {
    for (int l = 0; l < PERI_LANES; ++l) a[l] = PERI_SQRT(a[l]);
}
#endif

#define PERI_PLAIN_add(a, b) ((a) + (b))
#define PERI_PLAIN_sub(a, b) ((a) - (b))
#define PERI_PLAIN_mul(a, b) ((a) * (b))
#define PERI_PLAIN_div(a, b) ((a) / (b))
#define PERI_PLAIN_sqrt(a) PERI_SQRT(a)
#define PERI_PLAIN_set1(a) (a)
#define PERI_PLAIN_loadu(a) (*(a))
#define PERI_PLAIN_storeu(a, value) (*(a) = (value))

/* The least critical stretch that a bond of point i may have. */
static double PERI_FN(least_stretch)(const peri_body *b, int64_t i) {
    const peri__pair *pairs = b->cls ? &b->pairs[b->cls[i] * b->classes] : b->pairs;
    double least = pairs->s0;
    for (int32_t k = 1; b->cls && k < b->classes; ++k)
        if (pairs[k].s0 < least) least = pairs[k].s0;
    return least;
}

#define PERI_LANES_TARGET PERI_VECTOR_CODE
#define PERI_LANES_FN(name) PERI_FN(name##_plain)
#define PERI_LANES_SQRT PERI_FN(sqrt_plain)
#define PERI_V_ISA 0
#include "k_lanes.inl"
#include "k_vector.inl"
#include "k_list.inl"
#undef PERI_LANES_SQRT
#undef PERI_LANES_FN
#undef PERI_LANES_TARGET
#ifdef PERI_ISA
#define PERI_LANES_TARGET PERI_VECTOR_CODE PERI_AVX2
#define PERI_LANES_FN(name) PERI_FN(name##_avx2)
#define PERI_LANES_SQRT PERI_FN(sqrt_avx2)
#define PERI_V_ISA 1
#include "k_lanes.inl"
#include "k_vector.inl"
#include "k_list.inl"
#undef PERI_LANES_SQRT
#undef PERI_LANES_FN
#undef PERI_LANES_TARGET
#define PERI_LANES_TARGET PERI_VECTOR_CODE PERI_AVX512
#define PERI_LANES_FN(name) PERI_FN(name##_avx512)
#define PERI_LANES_SQRT PERI_FN(sqrt_avx512)
#define PERI_V_ISA 2
#include "k_lanes.inl"
#include "k_vector.inl"
#include "k_list.inl"
#undef PERI_LANES_SQRT
#undef PERI_LANES_FN
#undef PERI_LANES_TARGET
#endif

#ifdef PERI_ISA
#define PERI_ON_LANES(isa, name, arguments)                                                                            \
    ((isa) == 2 ? PERI_FN(name##_avx512) arguments : (isa) == 1 ? PERI_FN(name##_avx2) arguments : PERI_FN(name##_plain) arguments)
#else
#define PERI_ON_LANES(isa, name, arguments) PERI_FN(name##_plain) arguments
#endif

#undef PERI_PLAIN_add
#undef PERI_PLAIN_sub
#undef PERI_PLAIN_mul
#undef PERI_PLAIN_div
#undef PERI_PLAIN_sqrt
#undef PERI_PLAIN_set1
#undef PERI_PLAIN_loadu
#undef PERI_PLAIN_storeu

#include "k_force.inl"
#include "k_state.inl"
#include "k_march.inl"
#include "k_solve.inl"

static const peri__ops PERI_FN(ops) = {
    PERI_FN(pack), PERI_FN(pack_response), PERI_FN(force), PERI_FN(respond), PERI_FN(respond_rows), PERI_FN(share),
    PERI_FN(exchange), PERI_FN(energy), PERI_FN(kick), PERI_FN(kinetic), PERI_FN(tangent_respond), PERI_FN(tangent_share),
    PERI_FN(krylov_step), PERI_FN(krylov_turn), PERI_FN(krylov_force), PERI_FN(krylov_blocks), PERI_FN(krylov_norm),
    PERI_FN(krylov_dot)
};

#undef PERI_ON_LANES
#undef peri_r
#undef peri_i
#undef PERI_NEAR
#undef PERI_SQRT
#undef PERI_CHUNK
#undef PERI_TINY
#undef PERI_FN
#undef PERI_D
#undef PERI_T_REAL
#undef PERI_T_DIM
