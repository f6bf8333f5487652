/* kernels.inl - the driver of the kernel templates. Included once per real type and dimension with PERI_T_REAL (64, 32) and
   PERI_T_DIM (2, 3) set; defines the kernels and one table of them, and undefines all it defined. */

#if PERI_T_REAL == 64
#define peri_r double
#define PERI_SQRT sqrt
#define PERI_TINY 1e-290 /* keeps 0/0 out of a bond whose ends meet; far below any length                                */
#if PERI_T_DIM == 2
#define PERI_FN(name) peri__##name##_d2
#else
#define PERI_FN(name) peri__##name##_d3
#endif
#else
#define peri_r float
#define PERI_SQRT sqrtf
#define PERI_TINY 1e-30f
#if PERI_T_DIM == 2
#define PERI_FN(name) peri__##name##_f2
#else
#define PERI_FN(name) peri__##name##_f3
#endif
#endif
#define PERI_D PERI_T_DIM

#include "k_bond.inl"
#include "k_march.inl"

static const peri__ops PERI_FN(ops) = {
    PERI_FN(force), PERI_FN(energy), PERI_FN(kick), PERI_FN(kinetic)
};

#undef peri_r
#undef PERI_SQRT
#undef PERI_TINY
#undef PERI_FN
#undef PERI_D
#undef PERI_T_REAL
#undef PERI_T_DIM
