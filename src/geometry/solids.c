/* SPDX-License-Identifier: MIT */
/* solids.c - the shapes of obstacles, in their own frame: how deep a place is in them, their volume, centre and moments of inertia.

   Vectors have three components; the third is 0 in 2D. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

/* ---- depth: > 0 within; and the outward unit normal of the nearest surface --------------------------------------- */

/* Within `radius` of what y - rest is on. */
static double peri__round_depth(double radius, const double *rest, int32_t dim, double *normal) {
    const double distance = sqrt(peri__dot(rest, rest, dim));
    for (int32_t d = 0; d < dim; ++d) normal[d] = rest[d] / (distance + 1e-290);
    return radius - distance;
}

/* rest = y less its part along the axis, which is returned. */
static double peri__split_axis(const peri__solid *s, int32_t dim, const double *y, double *rest) {
    const double along = peri__dot(s->direction, y, dim);
    for (int32_t d = 0; d < dim; ++d) rest[d] = y[d] - along * s->direction[d];
    return along;
}

static double peri__box_depth(const peri__solid *s, int32_t dim, const double *y, double *normal) {
    int32_t axis = 0;
    for (int32_t d = 0; d < dim; ++d) {
        normal[d] = 0.0;
        if (s->half[d] - fabs(y[d]) < s->half[axis] - fabs(y[axis])) axis = d;
    }
    normal[axis] = y[axis] < 0.0 ? -1.0 : 1.0;
    return s->half[axis] - fabs(y[axis]);
}

static double peri__capsule_depth(const peri__solid *s, int32_t dim, const double *y, double *normal) {
    double rest[3];
    const double along = peri__split_axis(s, dim, y, rest), beyond = along - fmax(-s->half[0], fmin(s->half[0], along));
    for (int32_t d = 0; d < dim; ++d) rest[d] += beyond * s->direction[d];
    return peri__round_depth(s->radius, rest, dim, normal);
}

static double peri__cylinder_depth(const peri__solid *s, const double *y, double *normal) {
    double rest[3];
    const double along = peri__split_axis(s, 3, y, rest), depth = peri__round_depth(s->radius, rest, 3, normal);
    const double end = s->half[0] - fabs(along);
    if (depth <= end) return depth;
    for (int32_t d = 0; d < 3; ++d) normal[d] = along < 0.0 ? -s->direction[d] : s->direction[d];
    return end;
}

/* Of all shapes but signed distances. Outside, up to `reach`, it is no less than the distance to the surface, negative. */
static double peri__solid_depth(const peri__solid *s, int32_t dim, const double *y, double reach, double *normal) {
    switch (s->shape) {
    case PERI_SHAPE_PLANE:
        memcpy(normal, s->direction, (size_t)dim * sizeof *normal);
        return -peri__dot(s->direction, y, dim);
    case PERI_SHAPE_BALL: return peri__round_depth(s->radius, y, dim, normal);
    case PERI_SHAPE_BOX: return peri__box_depth(s, dim, y, normal);
    case PERI_SHAPE_CAPSULE: return peri__capsule_depth(s, dim, y, normal);
    case PERI_SHAPE_CYLINDER: return peri__cylinder_depth(s, y, normal);
    default: return peri__mesh_depth(s->mesh, y, reach, normal);
    }
}

/* ---- mass ------------------------------------------------------------------------------------------------------- */

typedef struct peri__bulk { /* of density 1 */
    double volume, centre[3], inertia[9]; /* about the centre; 2D: [8] alone                                              */
} peri__bulk;

/* inertia = across (1 - a a) + about a a, of a solid of revolution about the axis a; in 2D what turns in the plane is `across`. */
static void peri__revolve(const peri__solid *s, int32_t dim, double across, double about, double *inertia) {
    const double *a = s->direction;
    for (int k = 0; k < 9; ++k) inertia[k] = 0.0;
    if (dim == 2) inertia[8] = across;
    for (int r = 0; r < dim && dim == 3; ++r)
        for (int c = 0; c < dim; ++c) inertia[r * 3 + c] = (r == c ? across : 0.0) + (about - across) * a[r] * a[c];
}

static void peri__box_bulk(const peri__solid *s, int32_t dim, peri__bulk *bulk) {
    const double x = peri__square(s->half[0]), y = peri__square(s->half[1]), z = dim == 3 ? peri__square(s->half[2]) : 0.0;
    bulk->volume = ldexp(s->half[0] * s->half[1] * (dim == 3 ? s->half[2] : 1.0), dim);
    bulk->inertia[8] = bulk->volume * (x + y) / 3.0;
    if (dim == 2) return;
    bulk->inertia[0] = bulk->volume * (y + z) / 3.0;
    bulk->inertia[4] = bulk->volume * (x + z) / 3.0;
}

/* A middle of length 2 half and two caps, half a ball each, whose centres of mass lie `off` beyond the ends of the middle. */
static void peri__capsule_bulk(const peri__solid *s, int32_t dim, int caps, peri__bulk *bulk) {
    const double r = s->radius, square = r * r, half = s->half[0];
    const double middle = dim == 2 ? 4.0 * half * r : 2.0 * PERI_PI * square * half;
    const double ends = !caps ? 0.0 : dim == 2 ? PERI_PI * square : 4.0 / 3.0 * PERI_PI * square * r;
    const double off = dim == 2 ? 4.0 * r / (3.0 * PERI_PI) : 0.375 * r;
    const double across = middle * (half * half / 3.0 + square / (dim == 2 ? 3.0 : 4.0))
                        + ends * (square * (dim == 2 ? 0.5 : 0.4) + half * half + 2.0 * half * off);
    bulk->volume = middle + ends;
    peri__revolve(s, dim, across, middle * square * 0.5 + ends * square * 0.4, bulk->inertia);
}

/* Of a solid of density 1; volume 0 of planes and signed distances. */
static void peri__solid_bulk(const peri__solid *s, int32_t dim, peri__bulk *bulk) {
    peri__solid ball = *s;
    memset(bulk, 0, sizeof *bulk);
    switch (s->shape) {
    case PERI_SHAPE_BALL:
        ball.half[0] = 0.0;
        peri__capsule_bulk(&ball, dim, 1, bulk);
        return;
    case PERI_SHAPE_BOX: peri__box_bulk(s, dim, bulk); return;
    case PERI_SHAPE_CAPSULE: peri__capsule_bulk(s, dim, 1, bulk); return;
    case PERI_SHAPE_CYLINDER: peri__capsule_bulk(s, dim, 0, bulk); return;
    case PERI_SHAPE_MESH:
        bulk->volume = peri__mesh_bulk(s->mesh, bulk->centre, bulk->inertia);
        return;
    default: return;
    }
}
