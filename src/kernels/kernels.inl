/* SPDX-License-Identifier: MIT */
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
#define PERI_NEAR 1e-12 /* relative; kernels on columns leave bonds this near their critical stretch to the rows         */
#define PERI_TINY 1e-250 /* keeps 0/0 out of a bond whose ends meet: a length far below any; the largest force over it is finite */
#else
#define peri_b float
#define peri_i int32_t
#define PERI_SQRT sqrtf
#define PERI_CHUNK 16
#define PERI_NEAR 1e-5
#define PERI_TINY 1e-20f
#endif
#define PERI_MUTUAL(model) (PERI_T_BOND == 32 && (model)->mutual)
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

#if (PERI_T_DIM == 2 && defined(PERI_NO_2D)) || (PERI_T_DIM == 3 && defined(PERI_NO_3D)) ||                            \
    (PERI_T_BOND == 64 && defined(PERI_NO_F64)) || (PERI_T_REAL == 32 && defined(PERI_NO_F32)) ||                      \
    (PERI_T_REAL != PERI_T_BOND && defined(PERI_NO_MIXED))
PERI_SHARED const peri__ops PERI_FN(ops) = { 0 }; /* left out: peri_body_create refuses it */
#else

#define peri_s peri_r
#define PERI_S_DIM PERI_D
#define PERI_S_FN PERI_FN
#include "../laws/gradient.inl"
#undef peri_s
#undef PERI_S_DIM
#undef PERI_S_FN
#include "fields.inl"
#include "rows.inl"
#ifndef PERI_NO_STATICS
#include "tangent.inl"
#endif

/* Sums of vectors have the type of the compiler, which differs from that of intrinsics where it must choose. */
#define PERI_IF(condition, a, b) ((condition) ? (PERI_VECTOR)(a) : (PERI_VECTOR)(b))
#define PERI_PLAIN_sqrt(a) PERI_SQRT(a)
#define PERI_PLAIN_set1(a) (a)
#define PERI_PLAIN_loadu(a) (*(a))
#define PERI_PLAIN_storeu(a, value) (*(a) = (value))

typedef struct PERI_FN(pulled) { /* of the bonds of a bunch: c w phi/|y|, at first w/|y|, and the y along which they pull  */
    peri_b factor[PERI_BUNCH], y[PERI_D][PERI_BUNCH];
} PERI_FN(pulled);

/* what works on vectors, of one instruction set */
typedef struct PERI_FN(vector_ops) {
    uint32_t (*pairwise)(const peri__operands *, int64_t, peri_r[PERI_D][PERI_GROUP]);
    uint32_t (*ordinary)(const peri__operands *, int64_t, peri_r[PERI_D][PERI_GROUP]);
    uint32_t (*mixed)(const peri__operands *, int64_t, peri_r[PERI_D][PERI_GROUP]);
    uint32_t (*tensor)(const peri__operands *, int64_t, peri_r[PERI_D][PERI_GROUP]);
    uint32_t (*fielded)(const peri__operands *, int64_t, peri_r[PERI_D][PERI_GROUP]);
    void (*dilatation_sum)(const peri__operands *, int64_t, peri_r[PERI_GROUP]);
    void (*squares)(const peri__operands *, int64_t, double[PERI_GROUP]);
    void (*least)(const peri__operands *, int64_t, double[PERI_GROUP]);
    void (*misfit)(const peri__operands *, int64_t, peri_r[PERI_D][PERI_D][PERI_GROUP], double[PERI_GROUP]);
    double (*list_least)(const peri__operands *, int64_t, int);
    double (*list_misfit)(const peri__operands *, int64_t, peri_r[PERI_D][PERI_D]);
    void (*shape)(const peri__operands *, int64_t, peri_r[PERI_D][PERI_D][PERI_GROUP]);
    int (*list_pairwise)(const peri__operands *, int64_t, peri_r *);
    int (*list_ordinary)(const peri__operands *, int64_t, peri_r *);
    int (*list_mixed)(const peri__operands *, int64_t, peri_r *);
    int (*list_tensor)(const peri__operands *, int64_t, peri_r *);
    int (*list_fielded)(const peri__operands *, int64_t, peri_r *);
    peri_r (*list_dilatation_sum)(const peri__operands *, int64_t);
    void (*list_shape)(const peri__operands *, int64_t, peri_r[PERI_D][PERI_D]);
    void (*list_stretch)(const peri__operands *, int64_t, int64_t, uint64_t, peri__bunch *, PERI_FN(pulled) *);
    void (*law_sum)(const peri__bunch *, const PERI_FN(pulled) *, uint64_t, peri_r *);
    int (*kick_some)(int64_t, peri_r, const peri_r *, const peri_r *, peri_r *);
    void (*drift_some)(int64_t, peri_r, const peri_r *, peri_r *);
    void (*share_some)(const peri_r *, const peri_r *, peri_r *);
    void (*square_some)(int64_t, int, const uint8_t *, const peri_r *, double *, double *);
    void (*step_some)(int64_t, peri_r, const peri_r *, const peri_r *, peri_r *, peri_r *);
    void (*weigh_some)(int64_t, const double *, const peri_r *, peri_r *, double *, double *);
    void (*dot_some)(int64_t, int, const uint8_t *, const peri_r *, const peri_r *, double *);
    void (*turn_some)(int64_t, int, const uint8_t *, peri_r, const peri_r *, peri_r *);
} PERI_FN(vector_ops);

#define PERI_ISA_TARGET PERI_VECTOR_CODE
#define PERI_ISA_FN(name) PERI_FN(name##_base)
#define PERI_V_ISA 0
#include "isa.inl"
#ifdef PERI_ISA
#define PERI_ISA_TARGET PERI_VECTOR_CODE PERI_TARGET_AVX2
#define PERI_ISA_FN(name) PERI_FN(name##_avx2)
#define PERI_V_ISA 1
#include "isa.inl"
#define PERI_ISA_TARGET PERI_VECTOR_CODE PERI_TARGET_AVX512
#define PERI_ISA_FN(name) PERI_FN(name##_avx512)
#define PERI_V_ISA 2
#include "isa.inl"
#endif

#undef PERI_IF
#undef PERI_PLAIN_sqrt
#undef PERI_PLAIN_set1
#undef PERI_PLAIN_loadu
#undef PERI_PLAIN_storeu

/* by peri__isa */
#define PERI_TABLE(set)                                                                                                \
    { PERI_FN(pairwise_##set), PERI_FN(ordinary_##set), PERI_FN(mixed_##set), PERI_FN(tensor_##set), PERI_FN(fielded_##set), \
      PERI_FN(dilatation_sum_##set), PERI_FN(squares_##set), PERI_FN(least_##set), PERI_FN(misfit_##set),                \
      PERI_FN(list_least_##set), PERI_FN(list_misfit_##set), PERI_FN(shape_##set), PERI_FN(list_pairwise_##set),         \
      PERI_FN(list_ordinary_##set), PERI_FN(list_mixed_##set), PERI_FN(list_tensor_##set), PERI_FN(list_fielded_##set),   \
      PERI_FN(list_dilatation_sum_##set), PERI_FN(list_shape_##set), PERI_FN(list_stretch_##set), PERI_FN(law_sum_##set), \
      PERI_FN(kick_some_##set),                                                                                          \
      PERI_FN(drift_some_##set), PERI_FN(share_some_##set), PERI_FN(square_some_##set), PERI_FN(step_some_##set),           \
      PERI_FN(weigh_some_##set), PERI_FN(dot_some_##set), PERI_FN(turn_some_##set) }
static const PERI_FN(vector_ops) PERI_FN(vectors)[] = {
    PERI_TABLE(base),
#ifdef PERI_ISA
    PERI_TABLE(avx2),
    PERI_TABLE(avx512)
#endif
};
#undef PERI_TABLE

#include "passes.inl"
#include "bond_laws.inl"
#include "march.inl"
#ifndef PERI_NO_STATICS
#include "solve.inl"
#endif

PERI_SHARED const peri__ops PERI_FN(ops) = {
    PERI_FN(fill_records), PERI_FN(fill_responses), PERI_FN(gather_block), PERI_FN(gather_rows), PERI_FN(gather_shapes),
    PERI_FN(gather_least), PERI_FN(force_block),
    PERI_FN(add_point_forces),
    PERI_FN(part_of), PERI_FN(bond_force),
    PERI_FN(energy), PERI_FN(kick), PERI_FN(kinetic),
#ifdef PERI_NO_STATICS
    NULL, NULL, PERI_FN(law_force), PERI_FN(law_energy), NULL, NULL, NULL, NULL, NULL, NULL, NULL
#else
    PERI_FN(tangent_gather), PERI_FN(tangent_force), PERI_FN(law_force), PERI_FN(law_energy), PERI_FN(law_tangent),
    PERI_FN(krylov_step), PERI_FN(krylov_turn), PERI_FN(krylov_force), PERI_FN(krylov_blocks), PERI_FN(krylov_norm),
    PERI_FN(krylov_dot)
#endif
};
#endif

#undef PERI_BY_VECTORS
#undef peri_r
#undef peri_b
#undef peri_i
#undef PERI_NEAR
#undef PERI_SQRT
#undef PERI_ROOT
#undef PERI_CHUNK
#undef PERI_TINY
#undef PERI_MUTUAL
#undef PERI_SPEEDING
#undef PERI_FN
#undef PERI_D
#undef PERI_T_REAL
#undef PERI_T_BOND
#undef PERI_T_DIM
