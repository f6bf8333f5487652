/* k_vector.inl - the operations of k_list.inl per instruction set: PERI_V_ISA 0 plain text, 1 AVX2, 2 AVX-512.

   PERI_VECTOR     PERI_WIDTH reals; PERI_V(add) and so on its arithmetic, each operation rounded
   PERI_LIVE       which of its lanes count, from the lowest bits of a word
   PERI_KEEP       0 in the lanes that do not count
   PERI_ABOVE      not 0 where a > b in a lane that counts
   PERI_FETCH      four reals from pack + slots*id of each of PERI_WIDTH ids, as four vectors. Records are loaded whole and turned in
                   registers, which takes a fraction of what gathering numbers one by one does */

#if PERI_V_ISA == 0
#define PERI_VECTOR peri_r
#define PERI_WIDTH 1
#define PERI_V(name) PERI_PLAIN_##name
#define PERI_LIVE uint32_t
#define PERI_TO_LIVE(bits) ((bits) & 1)
#define PERI_KEEP(live, a) ((live) ? (a) : 0)
#define PERI_ABOVE(a, b, live) (((a) > (b)) & (int)(live))
#define PERI_FETCH PERI_FN(fetch_plain)
PERI_INLINE void PERI_FN(fetch_plain)(const peri_r *pack, int32_t slots, const int32_t *ids, peri_r *got) {
    for (int s = 0; s < 4; ++s) got[s] = pack[(int64_t)slots * ids[0] + s];
}

#elif PERI_V_ISA == 1
#define PERI_FETCH PERI_FN(fetch_avx2)
#if PERI_T_REAL == 64
#define PERI_VECTOR __m256d
#define PERI_WIDTH 4
#define PERI_V(name) _mm256_##name##_pd
#define PERI_LIVE __m256d
#define PERI_TO_LIVE(bits)                                                                                             \
    _mm256_castsi256_pd(_mm256_cmpgt_epi64(                                                                            \
        _mm256_and_si256(_mm256_set1_epi64x((int64_t)(bits)), _mm256_setr_epi64x(1, 2, 4, 8)), _mm256_setzero_si256()))
#define PERI_KEEP(live, a) _mm256_and_pd(live, a)
#define PERI_ABOVE(a, b, live) _mm256_movemask_pd(_mm256_and_pd(live, _mm256_cmp_pd(a, b, _CMP_GT_OQ)))
PERI_VECTOR_CODE PERI_AVX2 PERI_INLINE void PERI_FN(fetch_avx2)(const double *pack, int32_t slots, const int32_t *ids, __m256d *got) {
    const __m256d a = _mm256_loadu_pd(pack + (int64_t)slots * ids[0]), b = _mm256_loadu_pd(pack + (int64_t)slots * ids[1]);
    const __m256d c = _mm256_loadu_pd(pack + (int64_t)slots * ids[2]), d = _mm256_loadu_pd(pack + (int64_t)slots * ids[3]);
    const __m256d ab = _mm256_unpacklo_pd(a, b), cd = _mm256_unpacklo_pd(c, d); /* reals 0 and 2 */
    const __m256d ba = _mm256_unpackhi_pd(a, b), dc = _mm256_unpackhi_pd(c, d); /* reals 1 and 3 */
    got[0] = _mm256_permute2f128_pd(ab, cd, 0x20);
    got[1] = _mm256_permute2f128_pd(ba, dc, 0x20);
    got[2] = _mm256_permute2f128_pd(ab, cd, 0x31);
    got[3] = _mm256_permute2f128_pd(ba, dc, 0x31);
}
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
PERI_VECTOR_CODE PERI_AVX2 PERI_INLINE void PERI_FN(fetch_avx2)(const float *pack, int32_t slots, const int32_t *ids, __m256 *got) {
#define PERI_ONE(k) _mm_loadu_ps(pack + (int64_t)slots * ids[k])
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

#else
#define PERI_FETCH PERI_FN(fetch_avx512)
#define PERI_WIDTH PERI_CHUNK
#if PERI_T_REAL == 64
#define PERI_VECTOR __m512d
#define PERI_V(name) _mm512_##name##_pd
#define PERI_LIVE __mmask8
#define PERI_TO_LIVE(bits) ((__mmask8)(bits))
#define PERI_KEEP(live, a) _mm512_maskz_mov_pd(live, a)
#define PERI_ABOVE(a, b, live) _mm512_mask_cmp_pd_mask(live, a, b, _CMP_GT_OQ)
PERI_VECTOR_CODE PERI_AVX512 PERI_INLINE void PERI_FN(fetch_avx512)(const double *pack, int32_t slots, const int32_t *ids, __m512d *got) {
#define PERI_ONE(k) _mm256_loadu_pd(pack + (int64_t)slots * ids[k])
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
#define PERI_VECTOR __m512
#define PERI_V(name) _mm512_##name##_ps
#define PERI_LIVE __mmask16
#define PERI_TO_LIVE(bits) ((__mmask16)(bits))
#define PERI_KEEP(live, a) _mm512_maskz_mov_ps(live, a)
#define PERI_ABOVE(a, b, live) _mm512_mask_cmp_ps_mask(live, a, b, _CMP_GT_OQ)
PERI_VECTOR_CODE PERI_AVX512 PERI_INLINE void PERI_FN(fetch_avx512)(const float *pack, int32_t slots, const int32_t *ids, __m512 *got) {
#define PERI_ONE(k) _mm_loadu_ps(pack + (int64_t)slots * ids[k])
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
#endif
#undef PERI_V_ISA
