/* real.c - access to the reals of a body, whatever their precision. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

/* Sizes of the reals of a body: of the state and reference positions, and of what bonds are reckoned with. */
static size_t peri__real(const peri_body *b) { return b->f32 ? sizeof(float) : sizeof(double); }

static size_t peri__bond_real(const peri_body *b) { return b->b32 ? sizeof(float) : sizeof(double); }

static void peri__put_real(void *array, int32_t f32, int64_t at, double value) {
    if (f32) ((float *)array)[at] = (float)value;
    else ((double *)array)[at] = value;
}

PERI_INLINE double peri__get_real(const void *array, int32_t f32, int64_t at) {
    return f32 ? (double)((const float *)array)[at] : ((const double *)array)[at];
}
