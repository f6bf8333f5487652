/* SPDX-License-Identifier: MIT */
/* cracks.c - cracks through points, along rows, outside, of no extent, and ten thousand of them; directions of any length. */
#include "dense.h"
#include <time.h>

/* An LPS box of 64 unit cells with a corner at the origin. */
static peri_body *make(outcome *o, int32_t space, int32_t precision, int32_t kernel) {
    peri_body_desc d;
    peri_material_desc m;
    extreme_desc(&d, space, precision, space == PERI_SPACE_SOLID ? 2 : 3);
    d.kernel = kernel;
    extreme_material(&m, PERI_LAW_LPS, 0.3, 0);
    return dense_box(o, &d, &m, space == PERI_SPACE_SOLID ? 4 : 8);
}

/* Cracks have corners at multiples of 1/4, points lie at odd multiples of 1/2: in quarters all is whole numbers, and these are exact. */
typedef int64_t place[3];

static int64_t turn(const int64_t *a, const int64_t *b, const int64_t *c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static int between(const int64_t *a, const int64_t *b, const int64_t *c) { /* c, on the line of a and b */
    const int64_t x = (c[0] - a[0]) * (c[0] - b[0]), y = (c[1] - a[1]) * (c[1] - b[1]);
    return x <= 0 && y <= 0;
}

/* Do the segments a-b and p-q of the plane touch? */
static int meet(const int64_t *a, const int64_t *b, const int64_t *p, const int64_t *q) {
    const int64_t ap = turn(a, b, p), aq = turn(a, b, q), pa = turn(p, q, a), pb = turn(p, q, b);
    if (((ap > 0 && aq < 0) || (ap < 0 && aq > 0)) && ((pa > 0 && pb < 0) || (pa < 0 && pb > 0))) return 1;
    return (ap == 0 && between(a, b, p)) || (aq == 0 && between(a, b, q)) || (pa == 0 && between(p, q, a)) || (pb == 0 && between(p, q, b));
}

/* Does a-b touch the rectangle lo..hi at the height lo[2]? */
static int pierces(const int64_t *a, const int64_t *b, const int64_t *lo, const int64_t *hi) {
    const int64_t up = b[2] - a[2], way = lo[2] - a[2];
    place corner[4];
    int d, k;
    if (up == 0 && way != 0) return 0;
    if (up != 0) {
        if (way * (lo[2] - b[2]) > 0) return 0;
        for (d = 0; d < 2; ++d) { /* a + (b - a) way/up, times up */
            const int64_t at = a[d] * up + (b[d] - a[d]) * way, least = lo[d] * up, most = hi[d] * up;
            if (up > 0 ? at < least || at > most : at > least || at < most) return 0;
        }
        return 1;
    }
    for (k = 0; k < 4; ++k) {
        corner[k][0] = k == 1 || k == 2 ? hi[0] : lo[0];
        corner[k][1] = k >= 2 ? hi[1] : lo[1];
        if (meet(a, b, corner[k > 0 ? k - 1 : 0], corner[k])) return 1;
    }
    if (meet(a, b, corner[3], corner[0])) return 1;
    return a[0] >= lo[0] && a[0] <= hi[0] && a[1] >= lo[1] && a[1] <= hi[1];
}

/* Cracks of the plane, from and to; and rectangles across z, lo and hi. In quarters. */
static const place segments[11][2] = {{{0, 16, 0}, {32, 16, 0}},      /* between rows                                     */
                                      {{2, 14, 0}, {30, 14, 0}},      /* along a row, from point to point                 */
                                      {{0, 0, 0}, {32, 32, 0}},       /* through points, across                           */
                                      {{8, 9, 0}, {9, 9, 0}},         /* a quarter of a cell                              */
                                      {{-20, -20, 0}, {-4, -4, 0}},   /* outside                                          */
                                      {{-400, 16, 0}, {400, 16, 0}},  /* beyond the body                                  */
                                      {{16, 2, 0}, {16, 14, 0}},      /* ends on the line of a row of bonds               */
                                      {{14, 14, 0}, {18, 14, 0}},     /* is a bond                                        */
                                      {{14, 14, 0}, {22, 18, 0}},     /* is an oblique bond                               */
                                      {{14, 0, 0}, {14, 14, 0}},      /* ends at a point                                  */
                                      {{-1, 12, 0}, {12, -1, 0}}};    /* takes a corner off                               */
static const place rectangles[6][2] = {{{-4, -4, 8}, {20, 20, 8}},    /* through the body                                 */
                                       {{2, 2, 6}, {10, 6, 6}},       /* in a layer of points, corner at points           */
                                       {{5, 5, 8}, {7, 7, 8}},        /* around one bond                                  */
                                       {{6, 2, 8}, {6 + 4, 2 + 8, 8}}, /* edge through bonds                              */
                                       {{-20, -20, 8}, {-1, -1, 8}},  /* outside                                          */
                                       {{3, 3, 6}, {5, 5, 6}}};       /* between points of a layer                        */

static void quarters(const double *x, int dim, int64_t *out) {
    int d;
    for (d = 0; d < 3; ++d) out[d] = d < dim ? (int64_t)floor(4 * x[d] + 0.5) : 0;
}

/* One of the cracks by one of the calls; bonds that are cut and should not be, or should and are not. */
static double crack_error(outcome *o, peri_body *body, int which, int triangles) {
    const int dim = peri_dimension(body);
    const int64_t n = peri_point_count(body), width = peri_family_width(body);
    double from[3], to[3], edge[2][3] = {{0, 0, 0}, {0, 0, 0}}, corner[2][3], *x = extreme_read(o, body, PERI_FIELD_POSITION), wrong = 0;
    const int64_t *lo = dim == 2 ? segments[which][0] : rectangles[which][0], *hi = dim == 2 ? segments[which][1] : rectangles[which][1];
    int64_t cut, count = 0, i, k;
    int32_t row[64];
    int d;
    for (d = 0; d < 3; ++d) {
        from[d] = (double)lo[d] / 4;
        to[d] = (double)hi[d] / 4;
        corner[0][d] = d == 0 ? to[d] : from[d];
        corner[1][d] = d == 1 ? to[d] : from[d];
    }
    edge[0][0] = to[0] - from[0];
    edge[1][1] = to[1] - from[1];
    if (dim == 2) cut = peri_cut_segment(body, PERI_CUT_INITIAL, from, to);
    else if (!triangles) cut = peri_cut_rectangle(body, PERI_CUT_INITIAL, from, edge[0], edge[1]);
    else cut = peri_cut_triangle(body, PERI_CUT_INITIAL, from, corner[0], to) + peri_cut_triangle(body, PERI_CUT_INITIAL, to, corner[1],
                                                                                                  from);
    for (i = 0; x && i < n; ++i) {
        place a;
        if (extreme_fails(o, body, peri_get_families(body, (int32_t)i, 1, row, width))) break;
        quarters(&x[i * dim], dim, a);
        for (k = 0; k < width; ++k) {
            place b;
            int cuts;
            if (row[k] == i) continue;
            quarters(&x[row[k] * dim], dim, b);
            cuts = dim == 2 ? meet(a, b, lo, hi) : pierces(a, b, lo, hi);
            count += cuts && row[k] > i;
            wrong += (peri_bond_is_intact(body, (int32_t)i, row[k]) == 0) != cuts;
        }
    }
    free(x);
    return extreme_worst(wrong, fabs((double)(cut - count)));
}

static outcome cracks(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    const int32_t space = row->choice;
    int which, triangles, kernel;
    for (which = 0; which < (space == PERI_SPACE_SOLID ? 6 : 11); ++which)
        for (triangles = 0; triangles < (space == PERI_SPACE_SOLID ? 2 : 1); ++triangles)
            for (kernel = PERI_KERNEL_BEST; kernel <= PERI_KERNEL_LIST && o.status >= 0; kernel += 2) {
                peri_body *b = make(&o, space, precision, kernel);
                if (b) dense_note(&o, crack_error(&o, b, which, triangles), space, PERI_LAW_LPS);
                o = extreme_end(o, b);
            }
    return o;
}

/* Bonds that a disc of radius 1.2 in the plane z = value cuts, whatever the length of its normal. */
static outcome disc(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    const double centre[3] = {1.75, 2.25, row->value}, normal[3] = {0, 0, row->other};
    const int64_t n = 64;
    int64_t count = 0, cut, i, j;
    double *x;
    peri_body *body = make(&o, PERI_SPACE_SOLID, precision, PERI_KERNEL_BEST);
    if (!body) return o;
    x = extreme_read(&o, body, PERI_FIELD_POSITION);
    for (i = 0; x && i < n; ++i)
        for (j = i + 1; j < n; ++j) {
            double a[3], b[3], square = 0, along = 0, length = 0, t;
            int d;
            for (d = 0; d < 3; ++d) {
                a[d] = x[3 * i + d] - centre[d];
                b[d] = x[3 * j + d] - x[3 * i + d];
                square += b[d] * b[d];
            }
            if (square > 4 * (1 + 1e-8) || a[2] * (a[2] + b[2]) > 0 || (b[2] == 0 && a[2] != 0)) continue;
            for (d = 0; d < 2; ++d) {
                along -= a[d] * b[d];
                length += b[d] * b[d];
            }
            t = b[2] != 0 ? -a[2] / b[2] : along / length; /* where it passes, or its place nearest to the centre */
            t = t < 0 ? 0 : t > 1 ? 1 : t;
            count += hypot(a[0] + t * b[0], a[1] + t * b[1]) <= 1.2;
        }
    free(x);
    cut = peri_cut_disc(body, PERI_CUT_INITIAL, centre, normal, 1.2);
    if (!extreme_fails(&o, body, cut)) dense_note(&o, count > 0 ? fabs((double)(cut - count)) : 1, PERI_SPACE_SOLID, PERI_LAW_BOND_BASED);
    return extreme_end(o, body);
}

enum no_crack { POINT_2D, TOO_SHORT, TOO_FAR, NOT_A_NUMBER, TWICE_THERE, DISC_2D, IN_3D, LINE_3D, NO_EDGE, NO_NORMAL, NO_RADIUS,
                LESS_RADIUS, ENDLESS_RADIUS };

static outcome no_crack(const extreme *row, int32_t precision) {
    static const double here[3] = {1, 2, 3}, odd[3] = {1, NAN, 3}, far_[3] = {1e308, 2, 3}, far_off[3] = {-1e308, 2, 3};
    static const double third[3] = {3, 6, 9}, up[3] = {0, 0, 1}, zero[3] = {0, 0, 0}, bend[6] = {0, 0, 2, 2, 2, 2};
    static const double near_[3] = {1e-300, 0, 0};
    outcome o = {PERI_OK, "", 0};
    const int plane = row->choice <= DISC_2D;
    int64_t cut = 0;
    peri_body *body = make(&o, plane ? PERI_SPACE_PLANE_STRESS : PERI_SPACE_SOLID, precision, PERI_KERNEL_BEST);
    if (!body) return o;
    switch (row->choice) {
    case POINT_2D: cut = peri_cut_segment(body, PERI_CUT_INITIAL, here, here); break;
    case TOO_SHORT: cut = peri_cut_segment(body, PERI_CUT_INITIAL, zero, near_); break;
    case TOO_FAR: cut = peri_cut_segment(body, PERI_CUT_INITIAL, far_off, far_); break;
    case NOT_A_NUMBER: cut = peri_cut_segment(body, PERI_CUT_INITIAL, here, odd); break;
    case IN_3D: cut = peri_cut_segment(body, PERI_CUT_INITIAL, here, up); break;
    case LINE_3D: cut = peri_cut_triangle(body, PERI_CUT_INITIAL, zero, here, third); break;
    case NO_EDGE: cut = peri_cut_rectangle(body, PERI_CUT_INITIAL, here, up, zero); break;
    case NO_NORMAL: cut = peri_cut_disc(body, PERI_CUT_INITIAL, here, zero, 1); break;
    case NO_RADIUS: cut = peri_cut_disc(body, PERI_CUT_INITIAL, here, up, 0); break;
    case LESS_RADIUS: cut = peri_cut_disc(body, PERI_CUT_INITIAL, here, up, -1); break;
    case ENDLESS_RADIUS: cut = peri_cut_disc(body, PERI_CUT_INITIAL, here, up, HUGE_VAL); break;
    case DISC_2D: cut = peri_cut_disc(body, PERI_CUT_INITIAL, here, up, 1); break;
    default: cut = peri_cut_polyline(body, PERI_CUT_INITIAL, 3, bend);
    }
    (void)extreme_fails(&o, body, cut);
    if (peri_cut_count(body) != 0) o.error = 1;
    return extreme_end(o, body);
}

static double cutting(outcome *o, peri_body *body, int count) {
    const clock_t begin = clock();
    uint64_t seed = 71;
    int k;
    for (k = 0; k < count; ++k) {
        const double from[2] = {8 * test_random(&seed), 8 * test_random(&seed)}, to[2] = {from[0] + 0.01, from[1] + 0.01};
        if (extreme_fails(o, body, peri_cut_segment(body, PERI_CUT_INITIAL, from, to))) break;
    }
    return (double)(clock() - begin);
}

/* 10,000 cracks take 10 times as long as 1,000, and 100 times if time were quadratic. */
static outcome many_cracks(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    peri_body *body = make(&o, PERI_SPACE_PLANE_STRESS, precision, PERI_KERNEL_BEST);
    if (body) {
        const double few = cutting(&o, body, (int)row->value), many = cutting(&o, body, 10 * (int)row->value);
        o.error = many / few;
    }
    return extreme_end(o, body);
}

/* A plane obstacle and a surface traction whose normal is of length row->value: what they do is that of a normal of length 1. */
static outcome directions(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    const double lo[3] = {0, 0, 2}, hi[3] = {4, 4, 4}, at[3] = {1, 1, 0.75}, value[3] = {1e-3, 2e-3, -1e-3};
    double *f[2] = {NULL, NULL};
    int64_t i, n = 0;
    int k;
    for (k = 0; k < 2; ++k) {
        const double length = k ? row->value : 1, normal[3] = {0, 0.6 * length, 0.8 * length};
        peri_body *b = make(&o, PERI_SPACE_SOLID, precision, PERI_KERNEL_BEST);
        if (b) {
            const int32_t top = peri_select_box(b, NULL, lo, hi);
            n = peri_size_of_field(b, PERI_FIELD_FORCE_DENSITY);
            (void)(extreme_fails(&o, b, plane_obstacle(b, at, normal, 1, NULL, NULL))
                   || extreme_fails(&o, b, peri_apply_traction(b, top, 16, normal, value, NULL, NULL)));
            f[k] = extreme_read(&o, b, PERI_FIELD_FORCE_DENSITY);
        }
        o = extreme_end(o, b);
    }
    for (i = 0; f[0] && f[1] && i < n; ++i) o.error = extreme_worst(o.error, fabs(f[0][i] - f[1][i]));
    free(f[0]), free(f[1]);
    return o;
}

#define REFUSED {0, 0, 0}
#define EXACT {0, 0, 0}
static const extreme rows[] = {
    {"cracks in the plane", "whole-number geometry; touching counts", cracks, 0, 0, PERI_SPACE_PLANE_STRAIN, PERI_OK, NULL, EXACT},
    {"cracks in space", "whole-number geometry; touching counts", cracks, 0, 0, PERI_SPACE_SOLID, PERI_OK, NULL, EXACT},
    {"a disc between layers", "geometry of the disc", disc, 2, 1, 0, PERI_OK, NULL, EXACT},
    {"a disc in a layer", "geometry of the disc", disc, 1.5, -1, 0, PERI_OK, NULL, EXACT},
    {"a disc with a normal of 1e200", "a direction has no length", disc, 2, 1e200, 0, PERI_OK, NULL, EXACT},
    {"a disc with a normal of 1e-200", "a direction has no length", disc, 2, 1e-200, 0, PERI_OK, NULL, EXACT},
    {"a crack of no length", "peri.h: no extent", no_crack, 0, 0, POINT_2D, PERI_ERROR_CRACK, NULL, REFUSED},
    {"a crack of 1e-300", "peri.h: no extent", no_crack, 0, 0, TOO_SHORT, PERI_ERROR_CRACK, NULL, REFUSED},
    {"a crack of 2e308", "its length is no number", no_crack, 0, 0, TOO_FAR, PERI_ERROR_CRACK, NULL, REFUSED},
    {"a crack to nowhere", "peri.h: a number is not finite", no_crack, 0, 0, NOT_A_NUMBER, PERI_ERROR_RANGE, NULL, REFUSED},
    {"a segment in space", "peri.h: a kind that this space does not have", no_crack, 0, 0, IN_3D, PERI_ERROR_CRACK, NULL, REFUSED},
    {"a triangle in a line", "peri.h: no extent", no_crack, 0, 0, LINE_3D, PERI_ERROR_CRACK, NULL, REFUSED},
    {"a rectangle of one edge", "peri.h: no extent", no_crack, 0, 0, NO_EDGE, PERI_ERROR_CRACK, NULL, REFUSED},
    {"a disc without a normal", "peri.h: no extent", no_crack, 0, 0, NO_NORMAL, PERI_ERROR_CRACK, "normal", REFUSED},
    {"a disc without a radius", "peri.h: no extent", no_crack, 0, 0, NO_RADIUS, PERI_ERROR_CRACK, "radius", REFUSED},
    {"a disc of negative radius", "peri.h: outside its range", no_crack, 0, 0, LESS_RADIUS, PERI_ERROR_RANGE, "radius", REFUSED},
    {"a disc of infinite radius", "peri.h: a number is not finite", no_crack, 0, 0, ENDLESS_RADIUS, PERI_ERROR_RANGE, "radius", REFUSED},
    {"a disc in the plane", "peri.h: a kind that this space does not have", no_crack, 0, 0, DISC_2D, PERI_ERROR_CRACK, NULL, REFUSED},
    {"a polyline that stays", "peri.h: no extent, and a call that fails has cut nothing", no_crack, 0, 0, TWICE_THERE, PERI_ERROR_CRACK,
     NULL,
     REFUSED},
    {"10,000 cracks", "10 times as long as 1,000; noise of the clock up to a factor of 3", many_cracks, 1000, 0, 0, PERI_OK, NULL, {30,
     30, 30}},
    {"normals of 1e200", "a direction has no length", directions, 1e200, 0, 0, PERI_OK, NULL, ROUNDINGS(10)},
    {"normals of 1e-200", "a direction has no length", directions, 1e-200, 0, 0, PERI_OK, NULL, ROUNDINGS(10)},
};
const extreme_table extreme_cracks = EXTREME_TABLE("cracks", rows);
