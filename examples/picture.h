/* SPDX-License-Identifier: MIT */
/* picture.h - for examples that draw: a picture in one line, by extras/peri_view.h, which does more. */
#ifndef PERI_EXAMPLE_PICTURE_H
#define PERI_EXAMPLE_PICTURE_H

#include "../extras/peri_view.h"
#include "example.h"

/* The body, displaced `magnify` times as far as it is, in the colours of a field from lo to hi (lo = hi: its range). */
static inline int32_t picture(const char *path, peri_body *body, int32_t field, const char *label, double lo, double hi, int width,
                              double magnify) {
    peri_picture_desc desc;
    peri_picture_desc_init(&desc);
    desc.field = field;
    desc.label = label;
    desc.lo = lo;
    desc.hi = hi;
    desc.width = width;
    desc.magnify = magnify;
    desc.length_unit = "m";
    return peri_picture_save(path, body, &desc);
}

#endif
