/* kernels.inl - the driver of the kernel templates. Included once per precision and dimension with PERI_T_REAL (64, 32), PERI_T_BOND (64,
   32) and PERI_T_DIM (2, 3) set; defines the kernels and one table of them, and undefines all it defined.

   peri_r is the real of the state: places, displacements, forces and their sums. peri_b is that of bonds: what happens between the
   difference of two displacements, taken in peri_r, and the force that is added to a sum in peri_r; weights and the constants and responses
   of laws too. They differ in mixed precision. */

#if PERI_T_REAL == 64
#define peri_r double
#define PERI_ROOT sqrt
#else
#define peri_r float
#define PERI_ROOT sqrtf
#endif
#if PERI_T_BOND == 64
#define peri_b double
#define peri_i int64_t
#define PERI_SQRT sqrt
#define PERI_CHUNK 8 /* bonds of a row that are worked on at once                                                       */
#define PERI_NEAR 1e-12 /* relative; kernels on lanes leave bonds this near their critical stretch to the rows            */
#define PERI_TINY 1e-250 /* keeps 0/0 out of a bond whose ends meet: a length far below any; the largest force over it is finite   */
#else
#define peri_b float
#define peri_i int32_t
#define PERI_SQRT sqrtf
#define PERI_CHUNK 16
#define PERI_NEAR 1e-5
#define PERI_TINY 1e-20f
#endif
#if PERI_T_BOND == 64
#if PERI_T_DIM == 2
#define PERI_FN(name) peri__##name##_d2
#else
#define PERI_FN(name) peri__##name##_d3
#endif
#elif PERI_T_REAL == 64
#if PERI_T_DIM == 2
#define PERI_FN(name) peri__##name##_m2
#else
#define PERI_FN(name) peri__##name##_m3
#endif
#elif PERI_T_DIM == 2
#define PERI_FN(name) peri__##name##_f2
#else
#define PERI_FN(name) peri__##name##_f3
#endif
#define PERI_D PERI_T_DIM
#define PERI_SPEEDING ((peri_r)1e9)

#include "k_bond.inl"

/* Sums of vectors have the type of the compiler, which differs from that of intrinsics where it must choose. */
#define PERI_IF(condition, a, b) ((condition) ? (PERI_VECTOR)(a) : (PERI_VECTOR)(b))
#define PERI_PLAIN_sqrt(a) PERI_SQRT(a)
#define PERI_PLAIN_set1(a) (a)
#define PERI_PLAIN_loadu(a) (*(a))
#define PERI_PLAIN_storeu(a, value) (*(a) = (value))

#define PERI_LANES_TARGET PERI_VECTOR_CODE
#define PERI_LANES_FN(name) PERI_FN(name##_base)
#define PERI_V_ISA 0
#include "k_vector.inl"
#include "k_lanes.inl"
#include "k_list.inl"
#include "k_pointwise.inl"
#undef PERI_LANES_FN
#undef PERI_LANES_TARGET
#ifdef PERI_ISA
#define PERI_LANES_TARGET PERI_VECTOR_CODE PERI_TARGET_AVX2
#define PERI_LANES_FN(name) PERI_FN(name##_avx2)
#define PERI_V_ISA 1
#include "k_vector.inl"
#include "k_lanes.inl"
#include "k_list.inl"
#include "k_pointwise.inl"
#undef PERI_LANES_FN
#undef PERI_LANES_TARGET
#define PERI_LANES_TARGET PERI_VECTOR_CODE PERI_TARGET_AVX512
#define PERI_LANES_FN(name) PERI_FN(name##_avx512)
#define PERI_V_ISA 2
#include "k_vector.inl"
#include "k_lanes.inl"
#include "k_list.inl"
#include "k_pointwise.inl"
#undef PERI_LANES_FN
#undef PERI_LANES_TARGET
#endif

#ifdef PERI_ISA
#define PERI_ON_LANES(isa, name, arguments)                                                                            \
    ((isa) == 2 ? PERI_FN(name##_avx512) arguments : (isa) == 1 ? PERI_FN(name##_avx2) arguments : PERI_FN(name##_base) arguments)
#else
#define PERI_ON_LANES(isa, name, arguments) PERI_FN(name##_base) arguments
#endif

#undef PERI_IF
#undef PERI_PLAIN_sqrt
#undef PERI_PLAIN_set1
#undef PERI_PLAIN_loadu
#undef PERI_PLAIN_storeu

#include "k_force.inl"
#include "k_state.inl"
#include "k_march.inl"
#include "k_solve.inl"

PERI_SHARED const peri__ops PERI_FN(ops) = {
    PERI_FN(pack), PERI_FN(pack_response), PERI_FN(force), PERI_FN(respond), PERI_FN(respond_rows), PERI_FN(share),
    PERI_FN(exchange), PERI_FN(energy), PERI_FN(kick), PERI_FN(kinetic), PERI_FN(tangent_respond), PERI_FN(tangent_share),
    PERI_FN(krylov_step), PERI_FN(krylov_turn), PERI_FN(krylov_force), PERI_FN(krylov_blocks), PERI_FN(krylov_norm),
    PERI_FN(krylov_dot)
};

#undef PERI_ON_LANES
#undef peri_r
#undef peri_b
#undef peri_i
#undef PERI_NEAR
#undef PERI_SQRT
#undef PERI_ROOT
#undef PERI_CHUNK
#undef PERI_TINY
#undef PERI_SPEEDING
#undef PERI_FN
#undef PERI_D
#undef PERI_T_REAL
#undef PERI_T_BOND
#undef PERI_T_DIM
