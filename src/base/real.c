/* SPDX-License-Identifier: MIT */
/* real.c - access to the reals of a body, whatever their precision. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

/* Is it single precision? A build with one precision knows, and has one branch less wherever reals are read. */
#if defined(PERI_NO_F32) && defined(PERI_NO_MIXED)
#define PERI_SINGLE(f32) ((void)(f32), 0)
#elif defined(PERI_NO_F64) && defined(PERI_NO_MIXED)
#define PERI_SINGLE(f32) ((void)(f32), 1)
#else
#define PERI_SINGLE(f32) (f32)
#endif

/* Sizes of the reals of a body: of the state and reference positions, and of what bonds are reckoned with. */
static size_t peri__real(const peri_body *b) { return PERI_SINGLE(b->f32) ? sizeof(float) : sizeof(double); }

static size_t peri__bond_real(const peri_body *b) { return PERI_SINGLE(b->b32) ? sizeof(float) : sizeof(double); }

static void peri__put_real(void *array, int32_t f32, int64_t at, double value) {
    if (PERI_SINGLE(f32)) ((float *)array)[at] = (float)value;
    else ((double *)array)[at] = value;
}

PERI_INLINE double peri__get_real(const void *array, int32_t f32, int64_t at) {
    return PERI_SINGLE(f32) ? (double)((const float *)array)[at] : ((const double *)array)[at];
}

/* w beta V_j of entry `at` of weights of point i. */
PERI_INLINE double peri__weight_of(const peri__model *m, int64_t i, const void *weights, int64_t at) {
    return peri__get_real(weights, m->b32, at) / peri__share(m, i);
}
