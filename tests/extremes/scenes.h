/* SPDX-License-Identifier: MIT */
/* scenes.h - what the rows about calls and machines share: sizes.c, memory.c, callbacks.c, rounding.c. */
#ifndef SCENES_H
#define SCENES_H

#include "extremes.h"

static const int32_t scene_laws[4] = {PERI_LAW_BOND_BASED, PERI_LAW_LPS, PERI_LAW_OTERKUS, PERI_LAW_CORRESPONDENCE};

static inline outcome scene_spoiled(outcome o, const char *what) {
    if (o.status >= 0) {
        o.status = SPOILED;
        o.field = what;
    }
    return o;
}

/* In a scene with an `outcome o`. */
#define HOLDS(condition)                                                                                               \
    do {                                                                                                               \
        if (!(condition)) o = scene_spoiled(o, #condition);                                                            \
    } while (0)

/* The call must end so. */
#define ENDS(status, call) HOLDS((call) == (status))

/* A plate of a law with a set, a support, a load and a crack; LPS in lists, others in columns. */
static inline peri_body *scene_plate(outcome *o, int32_t law, int32_t precision, int32_t space) {
    const double hi[3] = {9, 6, 3}, edge[3] = {1, 6, 3}, pull[3] = {1e-4, 2e-5, 0}, from[3] = {5.2, -1, -1}, to[3] = {5.2, 2.2, -1};
    const double along[3] = {0, 0, 9}, up[3] = {0, 3.2, 0}, lo[3] = {0, 0, 0};
    peri_body_desc d;
    peri_material_desc m;
    peri_body *b;
    int32_t set;
    extreme_desc(&d, space, precision, 2.2);
    if (law == PERI_LAW_LPS) d.kernel = PERI_KERNEL_LIST;
    extreme_material(&m, law, 0.2, 0.02);
    b = extreme_box(o, &d, &m, hi, 1);
    if (o->status < 0) return b;
    (void)extreme_fails(o, b, set = peri_select_box(b, "edge", lo, edge));
    const int32_t axes = space == PERI_SPACE_SOLID ? PERI_AXIS_XYZ : PERI_AXIS_XY;
    (void)extreme_fails(o, b, peri_prescribe_displacement(b, set, axes, NULL, NULL, NULL));
    (void)extreme_fails(o, b, peri_apply_body_force(b, PERI_ALL, pull, NULL, NULL));
    (void)extreme_fails(o, b, space == PERI_SPACE_SOLID ? peri_cut_rectangle(b, PERI_CUT_INITIAL, from, up, along)
                                                        : peri_cut_segment(b, PERI_CUT_INITIAL, from, to));
    return b;
}

/* A digest of bytes, or of numbers. */
#define DIGEST_START UINT64_C(0xCBF29CE484222325)
static inline int32_t scene_swallow(void *user, const void *bytes, int64_t count) {
    const unsigned char *at = (const unsigned char *)bytes;
    uint64_t *hash = (uint64_t *)user;
    for (int64_t k = 0; k < count; ++k) *hash = (*hash ^ at[k]) * UINT64_C(0x100000001B3);
    return 0;
}

static inline void scene_digest(uint64_t *hash, const double *x, int64_t n) {
    if (x) (void)scene_swallow(hash, x, n * (int64_t)sizeof *x);
}

#endif
