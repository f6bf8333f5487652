/* SPDX-License-Identifier: MIT */
/* vector.inl - the operations of columns.inl and list.inl per instruction set: PERI_V_ISA 0 SSE2, which every x86-64 has; elsewhere the
   vectors of gcc and clang, or plain text, one lane at a time; 1 AVX2; 2 AVX-512.

   PERI_VECTOR     PERI_WIDTH reals of bonds. + - * / are the compiler's own, each rounded; PERI_V(set1), PERI_V(loadu), PERI_V(sqrt)
   PERI_LIVE       which of its lanes count, from the lowest bits of a word
   PERI_KEEP       0 in the lanes that do not count; PERI_KEEP_PRODUCT: of a product
   PERI_FREE_CHOICE 1: leaving lanes out of a product takes no time
   PERI_ABOVE      a bit for each lane that counts where a > b
   PERI_STATE      as many reals of the state: `take` reads them, `apart` is what others are more than these, as reals of bonds, `gather`
                   adds reals of bonds to them, `merge` others like them, `spread` writes them, `fold` is the sum over lanes, by halves
   differ          four reals of the state from records + reals*id of each of PERI_WIDTH ids, less own[4], as four PERI_VECTOR. Records are
                   loaded whole and turned in registers (`fetch`): a fraction of the time of gathering numbers one by one */

/* PERI_COMPACT   1: where processors of the instruction set have become rare its code is kept small: linear geometry and breaking are
                   asked for where they matter, not once */
#if PERI_V_ISA == 0 && defined(PERI_ISA)
#define PERI_COMPACT 1
#define PERI_PIECEWISE PERI_NO_UNROLLING
#else
#define PERI_COMPACT 0
#define PERI_PIECEWISE
#endif

#if PERI_V_ISA == 0 && !defined(PERI_ISA) && !defined(PERI_GENERIC)
#define PERI_VECTOR peri_b
#define PERI_WIDTH 1
#define PERI_V(name) PERI_PLAIN_##name
#define PERI_LIVE uint32_t
#define PERI_TO_LIVE(bits) ((bits) & 1)
#define PERI_KEEP(live, a) ((live) ? (a) : 0)
#define PERI_ABOVE(a, b, live) (((a) > (b)) & (int)(live))
#define PERI_STATE peri_r
PERI_INLINE peri_r PERI_ISA_FN(take)(const peri_r *at) { return *at; }
PERI_INLINE peri_b PERI_ISA_FN(apart)(const peri_r *at, peri_r own) { return (peri_b)(*at - own); }
PERI_INLINE void PERI_ISA_FN(gather)(peri_r *sum, peri_b part) { *sum += part; }
PERI_INLINE void PERI_ISA_FN(spread)(peri_r *at, const peri_r *from) { *at = *from; }
PERI_INLINE void PERI_ISA_FN(merge)(peri_r *sum, const peri_r *other) { *sum += *other; }
PERI_INLINE peri_r PERI_ISA_FN(fold)(const peri_r *sum) { return *sum; }
PERI_INLINE void PERI_ISA_FN(differ)(const peri_r *records, int32_t reals, const int32_t *ids, const peri_r *own, peri_b *got) {
    for (int s = 0; s < 4; ++s) got[s] = (peri_b)(records[(int64_t)reals * ids[0] + s] - own[s]);
}

#elif PERI_V_ISA == 0 && defined(PERI_GENERIC)
#define PERI_V(name) PERI_ISA_FN(v_##name)
#define PERI_KEEP(live, a) ((PERI_VECTOR)((PERI_LIVE)(a) & (live)))
#define PERI_ABOVE(a, b, live) PERI_ISA_FN(bits)(((a) > (b)) & (live))
#if PERI_T_BOND == 64
#define PERI_VECTOR peri__double2
#define PERI_WIDTH 2
#define PERI_LIVE peri__long2
#define PERI_TO_LIVE(bits) ((peri__long2){ -(int64_t)((bits) & 1), -(int64_t)((bits) >> 1 & 1) })
PERI_INLINE PERI_VECTOR PERI_V(set1)(double a) { return (PERI_VECTOR){ a, a }; }
PERI_INLINE PERI_VECTOR PERI_V(sqrt)(PERI_VECTOR a) { return (PERI_VECTOR){ sqrt(a[0]), sqrt(a[1]) }; }
PERI_INLINE int PERI_ISA_FN(bits)(peri__long2 a) { return (int)((a[0] & 1) | (a[1] & 2)); }
#else
#define PERI_VECTOR peri__float4
#define PERI_WIDTH 4
#define PERI_LIVE peri__int4
#define PERI_TO_LIVE(bits)                                                                                             \
    ((peri__int4){ -(int32_t)((bits) & 1), -(int32_t)((bits) >> 1 & 1), -(int32_t)((bits) >> 2 & 1), -(int32_t)((bits) >> 3 & 1) })
PERI_INLINE PERI_VECTOR PERI_V(set1)(float a) { return (PERI_VECTOR){ a, a, a, a }; }
PERI_INLINE PERI_VECTOR PERI_V(sqrt)(PERI_VECTOR a) { return (PERI_VECTOR){ sqrtf(a[0]), sqrtf(a[1]), sqrtf(a[2]), sqrtf(a[3]) }; }
PERI_INLINE int PERI_ISA_FN(bits)(peri__int4 a) { return (a[0] & 1) | (a[1] & 2) | (a[2] & 4) | (a[3] & 8); }
#endif
PERI_INLINE PERI_VECTOR PERI_V(loadu)(const peri_b *at) {
    PERI_VECTOR a;
    memcpy(&a, at, sizeof a);
    return a;
}
PERI_INLINE void PERI_V(storeu)(peri_b *at, PERI_VECTOR a) { memcpy(at, &a, sizeof a); }
#if PERI_T_REAL == 64
#define PERI_HALF peri__double2
#define PERI_ROW(s) { records[(int64_t)reals * ids[0] + (s)], records[(int64_t)reals * ids[1] + (s)] }
PERI_INLINE double PERI_ISA_FN(across)(PERI_HALF a) { return a[0] + a[1]; }
#else
#define PERI_HALF peri__float4
#define PERI_ROW(s)                                                                                                    \
    { records[(int64_t)reals * ids[0] + (s)], records[(int64_t)reals * ids[1] + (s)], records[(int64_t)reals * ids[2] + (s)],   \
      records[(int64_t)reals * ids[3] + (s)] }
PERI_INLINE float PERI_ISA_FN(across)(PERI_HALF a) { return (a[0] + a[2]) + (a[1] + a[3]); }
#endif
PERI_INLINE void PERI_ISA_FN(fetch)(const peri_r *records, int32_t reals, const int32_t *ids, PERI_HALF *got) {
    for (int s = 0; s < 4; ++s) got[s] = (PERI_HALF)PERI_ROW(s);
}
#undef PERI_ROW
#if PERI_T_REAL != PERI_T_BOND
#define PERI_S(name) PERI_ISA_FN(s_##name)
PERI_INLINE PERI_HALF PERI_S(set1)(double a) { return (PERI_HALF){ a, a }; }
PERI_INLINE PERI_HALF PERI_S(loadu)(const double *at) { return (PERI_HALF){ at[0], at[1] }; }
PERI_INLINE void PERI_S(storeu)(double *at, PERI_HALF a) { memcpy(at, &a, sizeof a); }
#define PERI_NARROW(lo, hi) PERI_ISA_FN(narrow)(lo, hi)
PERI_INLINE PERI_VECTOR PERI_ISA_FN(narrow)(PERI_HALF lo, PERI_HALF hi) {
    return (PERI_VECTOR){ (float)lo[0], (float)lo[1], (float)hi[0], (float)hi[1] };
}
#define PERI_WIDEN_LO(a) ((PERI_HALF){ (double)(a)[0], (double)(a)[1] })
#define PERI_WIDEN_HI(a) ((PERI_HALF){ (double)(a)[2], (double)(a)[3] })
#endif

#elif PERI_V_ISA == 0
#if PERI_T_BOND == 64
#define PERI_VECTOR __m128d
#define PERI_WIDTH 2
#define PERI_V(name) _mm_##name##_pd
#define PERI_LIVE __m128d
#define PERI_TO_LIVE(bits) _mm_castsi128_pd(_mm_set_epi64x(-(int64_t)((bits) >> 1 & 1), -(int64_t)((bits) & 1)))
#define PERI_KEEP(live, a) _mm_and_pd(live, a)
#define PERI_ABOVE(a, b, live) _mm_movemask_pd(_mm_and_pd(live, _mm_cmpgt_pd(a, b)))
#else
#define PERI_VECTOR __m128
#define PERI_WIDTH 4
#define PERI_V(name) _mm_##name##_ps
#define PERI_LIVE __m128
#define PERI_TO_LIVE(bits)                                                                                             \
    _mm_castsi128_ps(_mm_cmpgt_epi32(_mm_and_si128(_mm_set1_epi32((int32_t)(bits)), _mm_setr_epi32(1, 2, 4, 8)), _mm_setzero_si128()))
#define PERI_KEEP(live, a) _mm_and_ps(live, a)
#define PERI_ABOVE(a, b, live) _mm_movemask_ps(_mm_and_ps(live, _mm_cmpgt_ps(a, b)))
#endif
#if PERI_T_REAL == 64
#define PERI_HALF __m128d
#define PERI_S(name) _mm_##name##_pd
PERI_ISA_TARGET PERI_INLINE double PERI_ISA_FN(across)(__m128d a) { return peri__across_2(a); }
PERI_ISA_TARGET PERI_INLINE void PERI_ISA_FN(fetch)(const double *records, int32_t reals, const int32_t *ids, __m128d *got) {
    const double *a = records + (int64_t)reals * ids[0], *b = records + (int64_t)reals * ids[1];
    const __m128d a01 = _mm_loadu_pd(a), a23 = _mm_loadu_pd(a + 2), b01 = _mm_loadu_pd(b), b23 = _mm_loadu_pd(b + 2);
    got[0] = _mm_unpacklo_pd(a01, b01);
    got[1] = _mm_unpackhi_pd(a01, b01);
    got[2] = _mm_unpacklo_pd(a23, b23);
    got[3] = _mm_unpackhi_pd(a23, b23);
}
#else
#define PERI_HALF __m128
#define PERI_S(name) _mm_##name##_ps
PERI_ISA_TARGET PERI_INLINE float PERI_ISA_FN(across)(__m128 a) { return peri__across_4(a); }
PERI_ISA_TARGET PERI_INLINE void PERI_ISA_FN(fetch)(const float *records, int32_t reals, const int32_t *ids, __m128 *got) {
    for (int k = 0; k < 4; ++k) got[k] = _mm_loadu_ps(records + (int64_t)reals * ids[k]);
    _MM_TRANSPOSE4_PS(got[0], got[1], got[2], got[3]);
}
#endif
#define PERI_NARROW(lo, hi) _mm_movelh_ps(_mm_cvtpd_ps(lo), _mm_cvtpd_ps(hi))
#define PERI_WIDEN_LO(a) _mm_cvtps_pd(a)
#define PERI_WIDEN_HI(a) _mm_cvtps_pd(_mm_movehl_ps(a, a))

#elif PERI_V_ISA == 1
#if PERI_T_BOND == 64
#define PERI_VECTOR __m256d
#define PERI_WIDTH 4
#define PERI_V(name) _mm256_##name##_pd
#define PERI_LIVE __m256d
#define PERI_TO_LIVE(bits)                                                                                             \
    _mm256_castsi256_pd(_mm256_cmpgt_epi64(                                                                            \
        _mm256_and_si256(_mm256_set1_epi64x((int64_t)(bits)), _mm256_setr_epi64x(1, 2, 4, 8)), _mm256_setzero_si256()))
#define PERI_KEEP(live, a) _mm256_and_pd(live, a)
#define PERI_ABOVE(a, b, live) _mm256_movemask_pd(_mm256_and_pd(live, _mm256_cmp_pd(a, b, _CMP_GT_OQ)))
#else
#define PERI_VECTOR __m256
#define PERI_WIDTH 8
#define PERI_V(name) _mm256_##name##_ps
#define PERI_LIVE __m256
#define PERI_TO_LIVE(bits)                                                                                             \
    _mm256_castsi256_ps(_mm256_cmpgt_epi32(                                                                            \
        _mm256_and_si256(_mm256_set1_epi32((int32_t)(bits)), _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128)), _mm256_setzero_si256()))
#define PERI_KEEP(live, a) _mm256_and_ps(live, a)
#define PERI_ABOVE(a, b, live) _mm256_movemask_ps(_mm256_and_ps(live, _mm256_cmp_ps(a, b, _CMP_GT_OQ)))
#endif
#if PERI_T_REAL == 64
#define PERI_HALF __m256d
#define PERI_S(name) _mm256_##name##_pd
PERI_ISA_TARGET PERI_INLINE double PERI_ISA_FN(across)(__m256d a) {
    return peri__across_2(_mm256_castpd256_pd128(a) + _mm256_extractf128_pd(a, 1));
}
PERI_ISA_TARGET PERI_INLINE void PERI_ISA_FN(fetch)(const double *records, int32_t reals, const int32_t *ids, __m256d *got) {
    const __m256d a = _mm256_loadu_pd(records + (int64_t)reals * ids[0]), b = _mm256_loadu_pd(records + (int64_t)reals * ids[1]);
    const __m256d c = _mm256_loadu_pd(records + (int64_t)reals * ids[2]), d = _mm256_loadu_pd(records + (int64_t)reals * ids[3]);
    const __m256d ab = _mm256_unpacklo_pd(a, b), cd = _mm256_unpacklo_pd(c, d); /* reals 0 and 2 */
    const __m256d ba = _mm256_unpackhi_pd(a, b), dc = _mm256_unpackhi_pd(c, d); /* reals 1 and 3 */
    got[0] = _mm256_permute2f128_pd(ab, cd, 0x20);
    got[1] = _mm256_permute2f128_pd(ba, dc, 0x20);
    got[2] = _mm256_permute2f128_pd(ab, cd, 0x31);
    got[3] = _mm256_permute2f128_pd(ba, dc, 0x31);
}
#else
#define PERI_HALF __m256
#define PERI_S(name) _mm256_##name##_ps
PERI_ISA_TARGET PERI_INLINE float PERI_ISA_FN(across)(__m256 a) {
    return peri__across_4(_mm256_castps256_ps128(a) + _mm256_extractf128_ps(a, 1));
}
PERI_ISA_TARGET PERI_INLINE void PERI_ISA_FN(fetch)(const float *records, int32_t reals, const int32_t *ids, __m256 *got) {
#define PERI_ONE(k) _mm_loadu_ps(records + (int64_t)reals * ids[k])
#define PERI_TWO(k) _mm256_insertf128_ps(_mm256_castps128_ps256(PERI_ONE(k)), PERI_ONE((k) + 4), 1)
    const __m256 a = PERI_TWO(0), b = PERI_TWO(1), c = PERI_TWO(2), d = PERI_TWO(3);
#undef PERI_TWO
#undef PERI_ONE
    const __m256d ab = _mm256_castps_pd(_mm256_unpacklo_ps(a, b)), cd = _mm256_castps_pd(_mm256_unpacklo_ps(c, d));
    const __m256d ba = _mm256_castps_pd(_mm256_unpackhi_ps(a, b)), dc = _mm256_castps_pd(_mm256_unpackhi_ps(c, d));
    got[0] = _mm256_castpd_ps(_mm256_unpacklo_pd(ab, cd));
    got[1] = _mm256_castpd_ps(_mm256_unpackhi_pd(ab, cd));
    got[2] = _mm256_castpd_ps(_mm256_unpacklo_pd(ba, dc));
    got[3] = _mm256_castpd_ps(_mm256_unpackhi_pd(ba, dc));
}
#endif
#define PERI_NARROW(lo, hi) _mm256_set_m128(_mm256_cvtpd_ps(hi), _mm256_cvtpd_ps(lo))
#define PERI_WIDEN_LO(a) _mm256_cvtps_pd(_mm256_castps256_ps128(a))
#define PERI_WIDEN_HI(a) _mm256_cvtps_pd(_mm256_extractf128_ps(a, 1))

#else
#define PERI_FREE_CHOICE 1
#define PERI_WIDTH PERI_CHUNK
#if PERI_T_BOND == 64
#define PERI_VECTOR __m512d
#define PERI_V(name) _mm512_##name##_pd
#define PERI_LIVE __mmask8
#define PERI_TO_LIVE(bits) ((__mmask8)(bits))
#define PERI_KEEP(live, a) _mm512_maskz_mov_pd(live, a)
#define PERI_KEEP_PRODUCT(live, a, b) _mm512_maskz_mul_pd(live, a, b)
#define PERI_ABOVE(a, b, live) _mm512_mask_cmp_pd_mask(live, a, b, _CMP_GT_OQ)
#else
#define PERI_VECTOR __m512
#define PERI_V(name) _mm512_##name##_ps
#define PERI_LIVE __mmask16
#define PERI_TO_LIVE(bits) ((__mmask16)(bits))
#define PERI_KEEP(live, a) _mm512_maskz_mov_ps(live, a)
#define PERI_KEEP_PRODUCT(live, a, b) _mm512_maskz_mul_ps(live, a, b)
#define PERI_ABOVE(a, b, live) _mm512_mask_cmp_ps_mask(live, a, b, _CMP_GT_OQ)
#endif
#if PERI_T_REAL == 64
#define PERI_HALF __m512d
#define PERI_S(name) _mm512_##name##_pd
PERI_ISA_TARGET PERI_INLINE double PERI_ISA_FN(across)(__m512d a) {
    const __m256d half = _mm512_castpd512_pd256(a) + _mm512_extractf64x4_pd(a, 1);
    return peri__across_2(_mm256_castpd256_pd128(half) + _mm256_extractf128_pd(half, 1));
}
PERI_ISA_TARGET PERI_INLINE void PERI_ISA_FN(fetch)(const double *records, int32_t reals, const int32_t *ids, __m512d *got) {
#define PERI_ONE(k) _mm256_loadu_pd(records + (int64_t)reals * ids[k])
#define PERI_TWO(k) _mm512_insertf64x4(_mm512_castpd256_pd512(PERI_ONE(k)), PERI_ONE((k) + 2), 1)
    const __m512d a = PERI_TWO(0), b = PERI_TWO(1), c = PERI_TWO(4), d = PERI_TWO(5);
#undef PERI_TWO
#undef PERI_ONE
    const __m512d ab = _mm512_unpacklo_pd(a, b), cd = _mm512_unpacklo_pd(c, d);
    const __m512d ba = _mm512_unpackhi_pd(a, b), dc = _mm512_unpackhi_pd(c, d);
    got[0] = _mm512_shuffle_f64x2(ab, cd, 0x88);
    got[1] = _mm512_shuffle_f64x2(ba, dc, 0x88);
    got[2] = _mm512_shuffle_f64x2(ab, cd, 0xdd);
    got[3] = _mm512_shuffle_f64x2(ba, dc, 0xdd);
}
#else
#define PERI_HALF __m512
#define PERI_S(name) _mm512_##name##_ps
PERI_ISA_TARGET PERI_INLINE float PERI_ISA_FN(across)(__m512 a) {
    const __m256 half = _mm512_castps512_ps256(a) + _mm512_extractf32x8_ps(a, 1);
    return peri__across_4(_mm256_castps256_ps128(half) + _mm256_extractf128_ps(half, 1));
}
PERI_ISA_TARGET PERI_INLINE void PERI_ISA_FN(fetch)(const float *records, int32_t reals, const int32_t *ids, __m512 *got) {
#define PERI_ONE(k) _mm_loadu_ps(records + (int64_t)reals * ids[k])
#define PERI_TWO(k) _mm512_insertf32x4(_mm512_castps128_ps512(PERI_ONE(k)), PERI_ONE((k) + 4), 1)
#define PERI_FOUR(k) _mm512_insertf32x4(_mm512_insertf32x4(PERI_TWO(k), PERI_ONE((k) + 8), 2), PERI_ONE((k) + 12), 3)
    const __m512 a = PERI_FOUR(0), b = PERI_FOUR(1), c = PERI_FOUR(2), d = PERI_FOUR(3);
#undef PERI_FOUR
#undef PERI_TWO
#undef PERI_ONE
    const __m512d ab = _mm512_castps_pd(_mm512_unpacklo_ps(a, b)), cd = _mm512_castps_pd(_mm512_unpacklo_ps(c, d));
    const __m512d ba = _mm512_castps_pd(_mm512_unpackhi_ps(a, b)), dc = _mm512_castps_pd(_mm512_unpackhi_ps(c, d));
    got[0] = _mm512_castpd_ps(_mm512_unpacklo_pd(ab, cd));
    got[1] = _mm512_castpd_ps(_mm512_unpackhi_pd(ab, cd));
    got[2] = _mm512_castpd_ps(_mm512_unpacklo_pd(ba, dc));
    got[3] = _mm512_castpd_ps(_mm512_unpackhi_pd(ba, dc));
}
#endif
#define PERI_NARROW(lo, hi)                                                                                            \
    _mm512_insertf32x8(_mm512_castps256_ps512(_mm512_cvtpd_ps(lo)), _mm512_cvtpd_ps(hi), 1)
#define PERI_WIDEN_LO(a) _mm512_cvtps_pd(_mm512_castps512_ps256(a))
#define PERI_WIDEN_HI(a) _mm512_cvtps_pd(_mm512_extractf32x8_ps(a, 1))
#endif

#ifndef PERI_FREE_CHOICE
#define PERI_FREE_CHOICE 0
#define PERI_KEEP_PRODUCT(live, a, b) PERI_KEEP(live, (a) * (b))
#endif

#if defined(PERI_HALF) && PERI_T_REAL == PERI_T_BOND
#define PERI_STATE PERI_VECTOR
PERI_ISA_TARGET PERI_INLINE PERI_STATE PERI_ISA_FN(take)(const peri_r *at) { return PERI_V(loadu)(at); }
PERI_ISA_TARGET PERI_INLINE PERI_VECTOR PERI_ISA_FN(apart)(const peri_r *at, PERI_STATE own) {
    return PERI_V(loadu)(at) - own;
}
PERI_ISA_TARGET PERI_INLINE void PERI_ISA_FN(gather)(PERI_STATE *sum, PERI_VECTOR part) { *sum += part; }
PERI_ISA_TARGET PERI_INLINE void PERI_ISA_FN(spread)(peri_r *at, const PERI_STATE *from) { PERI_V(storeu)(at, *from); }
PERI_ISA_TARGET PERI_INLINE void PERI_ISA_FN(merge)(PERI_STATE *sum, const PERI_STATE *other) { *sum += *other; }
PERI_ISA_TARGET PERI_INLINE peri_r PERI_ISA_FN(fold)(const PERI_STATE *sum) { return PERI_ISA_FN(across)(*sum); }
PERI_ISA_TARGET PERI_INLINE void PERI_ISA_FN(differ)(const peri_r *records, int32_t reals, const int32_t *ids, const peri_r *own,
                                                         PERI_VECTOR *got) {
    PERI_ISA_FN(fetch)(records, reals, ids, got);
    for (int s = 0; s < 4; ++s) got[s] -= PERI_V(set1)(own[s]);
}

#elif defined(PERI_HALF)
typedef struct PERI_ISA_FN(halves) {
    PERI_HALF lo, hi;
} PERI_ISA_FN(halves);
#define PERI_STATE PERI_ISA_FN(halves)
PERI_ISA_TARGET PERI_INLINE PERI_STATE PERI_ISA_FN(take)(const peri_r *at) {
    PERI_STATE state;
    state.lo = PERI_S(loadu)(at);
    state.hi = PERI_S(loadu)(at + PERI_WIDTH / 2);
    return state;
}
PERI_ISA_TARGET PERI_INLINE PERI_VECTOR PERI_ISA_FN(apart)(const peri_r *at, PERI_STATE own) {
    return PERI_NARROW(PERI_S(loadu)(at) - own.lo, PERI_S(loadu)(at + PERI_WIDTH / 2) - own.hi);
}
PERI_ISA_TARGET PERI_INLINE void PERI_ISA_FN(gather)(PERI_STATE *sum, PERI_VECTOR part) {
    sum->lo += PERI_WIDEN_LO(part);
    sum->hi += PERI_WIDEN_HI(part);
}
PERI_ISA_TARGET PERI_INLINE void PERI_ISA_FN(spread)(peri_r *at, const PERI_STATE *from) {
    PERI_S(storeu)(at, from->lo);
    PERI_S(storeu)(at + PERI_WIDTH / 2, from->hi);
}
PERI_ISA_TARGET PERI_INLINE void PERI_ISA_FN(merge)(PERI_STATE *sum, const PERI_STATE *other) {
    sum->lo += other->lo;
    sum->hi += other->hi;
}
PERI_ISA_TARGET PERI_INLINE peri_r PERI_ISA_FN(fold)(const PERI_STATE *sum) { return PERI_ISA_FN(across)(sum->lo + sum->hi); }
PERI_ISA_TARGET PERI_INLINE void PERI_ISA_FN(differ)(const peri_r *records, int32_t reals, const int32_t *ids, const peri_r *own,
                                                         PERI_VECTOR *got) {
    PERI_HALF lo[4], hi[4];
    PERI_ISA_FN(fetch)(records, reals, ids, lo);
    PERI_ISA_FN(fetch)(records, reals, ids + PERI_WIDTH / 2, hi);
    for (int s = 0; s < 4; ++s) got[s] = PERI_NARROW(lo[s] - PERI_S(set1)(own[s]), hi[s] - PERI_S(set1)(own[s]));
}
#endif
#undef PERI_HALF
#undef PERI_S
#undef PERI_NARROW
#undef PERI_WIDEN_LO
#undef PERI_WIDEN_HI
#undef PERI_V_ISA
