/* SPDX-License-Identifier: MIT */
/* traction.c - what the planes bear that bonds are normal to. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

static const peri__pair *peri__pair_at(const peri_body *b, int64_t i, int64_t j) {
    return b->point_class ? &b->pairs[b->point_class[i] * b->classes + b->point_class[j]] : b->pairs;
}

/* What the mean stress of the ends of a bond puts on the plane that it is normal to. */
static peri__traction peri__traction_at(const peri_body *b, int64_t i, int64_t j) {
    const int64_t size = b->dim * b->dim;
    double xi[3], y[3];
    peri__pull_of(b, i, j, xi, y);
    for (int32_t d = 0; d < b->dim; ++d) y[d] = xi[d] + (b->desc.geometry == PERI_GEOMETRY_LINEAR ? 0.0 : y[d]);
    return peri__traction_of(b->dim, b->stress + i * size, b->stress + j * size, y);
}
