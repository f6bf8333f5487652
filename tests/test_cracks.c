/* SPDX-License-Identifier: MIT */
/* test_cracks.c - bonds that are cut, and damage. Bonds that break by stretch are in test_breaking.c.

   Sources of truth: geometry in whole numbers. Points lie at 4i + 2 quarters of a spacing and cracks have whole vertices, so
   orientations are exact in int64 and "touches" has no tolerance; the nearest miss of such numbers is above 1e-6 of a spacing,
   far beyond the library's 1e-9. Damage is counted by hand. */
#include "peri_test.h"

#define N_MAX 256
#define WIDTH 128

typedef struct {
    int64_t x, y, z;
} vec;

static vec make(int64_t x, int64_t y, int64_t z) {
    vec v;
    v.x = x;
    v.y = y;
    v.z = z;
    return v;
}
static vec sub(vec a, vec b) { return make(a.x - b.x, a.y - b.y, a.z - b.z); }
static vec add(vec a, vec b) { return make(a.x + b.x, a.y + b.y, a.z + b.z); }
static vec times(int64_t s, vec a) { return make(s * a.x, s * a.y, s * a.z); }
static int64_t dot(vec a, vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static vec cross(vec a, vec b) { return make(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x); }
static int sign(int64_t a) { return (a > 0) - (a < 0); }
static int64_t volume(vec a, vec b, vec c, vec d) { return dot(cross(sub(b, a), sub(c, a)), sub(d, a)); }

/* ---- exact intersections ------------------------------------------------------------------------------------------- */

static int turn(vec a, vec b, vec c) { return sign((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)); }

/* c on the segment a-b, given that it is on its line. */
static int between(vec a, vec b, vec c) {
    return (c.x - a.x) * (c.x - b.x) <= 0 && (c.y - a.y) * (c.y - b.y) <= 0;
}

static int segments_meet(vec p, vec q, vec a, vec b) {
    const int d1 = turn(a, b, p), d2 = turn(a, b, q), d3 = turn(p, q, a), d4 = turn(p, q, b);
    if (d1 * d2 < 0 && d3 * d4 < 0) return 1;
    return (d1 == 0 && between(a, b, p)) || (d2 == 0 && between(a, b, q)) || (d3 == 0 && between(p, q, a)) ||
           (d4 == 0 && between(p, q, b));
}

/* Drops the axis along which the normal is longest. */
static vec flatten(vec p, vec normal) {
    const int64_t x = llabs(normal.x), y = llabs(normal.y), z = llabs(normal.z);
    if (x >= y && x >= z) return make(p.y, p.z, 0);
    return y >= z ? make(p.x, p.z, 0) : make(p.x, p.y, 0);
}

/* The closed segment p-q and the closed triangle. */
static int triangle_meets(vec p, vec q, vec a, vec b, vec c) {
    const vec n = cross(sub(b, a), sub(c, a));
    const int sp = sign(dot(n, sub(p, a))), sq = sign(dot(n, sub(q, a)));
    int s1, s2, s3;
    if (sp * sq > 0) return 0;
    if (sp == 0 && sq == 0) { /* all in one plane */
        p = flatten(p, n), q = flatten(q, n), a = flatten(a, n), b = flatten(b, n), c = flatten(c, n);
        s1 = turn(a, b, p), s2 = turn(b, c, p), s3 = turn(c, a, p);
        if ((s1 >= 0 && s2 >= 0 && s3 >= 0) || (s1 <= 0 && s2 <= 0 && s3 <= 0)) return 1;
        return segments_meet(p, q, a, b) || segments_meet(p, q, b, c) || segments_meet(p, q, c, a);
    }
    s1 = sign(volume(p, q, a, b)), s2 = sign(volume(p, q, b, c)), s3 = sign(volume(p, q, c, a));
    return (s1 >= 0 && s2 >= 0 && s3 >= 0) || (s1 <= 0 && s2 <= 0 && s3 <= 0);
}

/* The closed disc of radius sqrt(r2) about c: the segment's point in the plane is p + d dp/(dp - dq). In the plane, the
   segment's point nearest to c. */
static int disc_meets(vec p, vec q, vec c, vec n, int64_t r2) {
    const vec d = sub(q, p), w = sub(p, c);
    const int64_t dp = dot(n, w), dq = dot(n, sub(q, c)), span = dp - dq;
    vec at;
    if (sign(dp) * sign(dq) > 0) return 0;
    if (dp == 0 && dq == 0) {
        const int64_t along = -dot(w, d), length2 = dot(d, d);
        if (along <= 0) return dot(w, w) <= r2;
        if (along >= length2) return dot(sub(q, c), sub(q, c)) <= r2;
        return dot(w, w) * length2 - along * along <= r2 * length2;
    }
    at = add(times(span, w), times(dp, d));
    return dot(at, at) <= r2 * span * span;
}

/* ---- cracks on lattices -------------------------------------------------------------------------------------------- */

typedef struct {
    int kind; /* 's' segment, 'p' polyline, 't' triangle, 'r' rectangle, 'd' disc */
    int count;
    vec v[6]; /* vertices; r: corner, two edges; d: centre, normal */
    int64_t r2;
} crack;

static int crack_meets(const crack *k, vec p, vec q) {
    int n;
    switch (k->kind) {
    case 't': return triangle_meets(p, q, k->v[0], k->v[1], k->v[2]);
    case 'd': return disc_meets(p, q, k->v[0], k->v[1], k->r2);
    case 'r': { /* two closed triangles */
        const vec b = add(k->v[0], k->v[1]), c = add(b, k->v[2]), d = add(k->v[0], k->v[2]);
        return triangle_meets(p, q, k->v[0], b, c) || triangle_meets(p, q, k->v[0], c, d);
    }
    default:
        for (n = 0; n + 1 < k->count; ++n)
            if (segments_meet(p, q, k->v[n], k->v[n + 1])) return 1;
        return 0;
    }
}

typedef struct {
    int dim, size[3], count;
    double unit, origin; /* quarter of the spacing; every coordinate of the corner */
    peri_body *body;
    vec at[N_MAX];
    int32_t width, rows[N_MAX * WIDTH];
} lattice;

static peri_body *new_body(int dim, double horizon, int32_t precision) {
    peri_body_desc d;
    peri_body_desc_init(&d);
    d.space = dim == 3 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRESS;
    d.horizon = horizon;
    d.precision = precision;
    d.threads = 1;
    return test_unit_body(&d, 0.0);
}

static void place(const lattice *l, vec v, double *x) {
    x[0] = l->origin + l->unit * (double)v.x;
    x[1] = l->origin + l->unit * (double)v.y;
    if (l->dim == 3) x[2] = l->origin + l->unit * (double)v.z;
}

static lattice the_lattice;
static lattice *make_lattice_as(int dim, double dx, double origin, int32_t precision) {
    lattice *l = &the_lattice;
    double lo[3], hi[3];
    int i;
    l->dim = dim;
    l->unit = 0.25 * dx;
    l->origin = origin * dx;
    l->size[0] = dim == 3 ? 6 : 11;
    l->size[1] = dim == 3 ? 5 : 9;
    l->size[2] = dim == 3 ? 5 : 1;
    l->count = l->size[0] * l->size[1] * l->size[2];
    for (i = 0; i < 3; ++i) {
        lo[i] = l->origin;
        hi[i] = l->origin + l->size[i] * dx;
    }
    for (i = 0; i < l->count; ++i)
        l->at[i] = make(4 * (i % l->size[0]) + 2, 4 * (i / l->size[0] % l->size[1]) + 2,
                        dim == 3 ? 4 * (i / l->size[0] / l->size[1]) + 2 : 0);
    l->body = new_body(dim, (dim == 3 ? 2 : 3) * dx, precision);
    if (origin == 0.0) { /* the library's lattice, or the same points as the caller's */
        CHECK(MUST(l->body, peri_add_box(l->body, peri_id(l->body, PERI_KIND_MATERIAL, 1), lo, hi, dx)) == l->count);
    } else {
        static double x[3 * N_MAX], v[N_MAX];
        for (i = 0; i < l->count; ++i) {
            place(l, l->at[i], x + i * dim);
            v[i] = pow(dx, dim);
        }
        CHECK(MUST(l->body, peri_add_points(l->body, l->count, x, v, NULL)) == l->count);
    }
    MUST(l->body, peri_build(l->body));
    l->width = peri_family_width(l->body);
    if (l->width > WIDTH) exit(3);
    MUST(l->body, peri_get_families(l->body, 0, l->count, l->rows, N_MAX * WIDTH));
    return l;
}

static lattice *make_lattice(int dim, double dx, double origin) { return make_lattice_as(dim, dx, origin, PERI_PRECISION_DOUBLE); }

/* Hands the crack to the library; vectors (edges, normals) have no origin. */
static int64_t cut(const lattice *l, peri_body *body, const crack *k) {
    double x[18];
    int n, c;
    for (n = 0; n < k->count; ++n) {
        place(l, k->v[n], x + n * l->dim);
        for (c = 0; c < 3 && n > 0 && (k->kind == 'r' || k->kind == 'd'); ++c)
            x[3 * n + c] = l->unit * (double)(c == 0 ? k->v[n].x : c == 1 ? k->v[n].y : k->v[n].z);
    }
    switch (k->kind) {
    case 's': return peri_cut_segment(body, PERI_CUT_INITIAL, x, x + 2);
    case 'p': return peri_cut_polyline(body, PERI_CUT_INITIAL, k->count, x);
    case 't': return peri_cut_triangle(body, PERI_CUT_INITIAL, x, x + 3, x + 6);
    case 'r': return peri_cut_rectangle(body, PERI_CUT_INITIAL, x, x + 3, x + 6);
    default: return peri_cut_disc(body, PERI_CUT_INITIAL, x, x + 3, sqrt((double)k->r2) * l->unit);
    }
}

/* Cuts two cracks one after the other in a copy of the lattice: the first count is of bonds that meet the first, the second of
   those that meet the second alone; then the state of every bond, asked both ways round. */
static int64_t check_cracks(lattice *l, const crack *a, const crack *b) {
    peri_body *body = NULL;
    int64_t got_a, got_b, want_a = 0, want_b = 0, wrong = 0;
    int32_t i, j;
    int k;
    if (MUST(l->body, peri_body_clone(l->body, &body, NULL)) < 0) return 0;
    got_a = MUST(body, cut(l, body, a));
    got_b = MUST(body, cut(l, body, b));
    for (i = 0; i < l->count; ++i)
        for (k = 0; k < l->width && (j = l->rows[i * l->width + k]) != i; ++k) {
            const int in_a = crack_meets(a, l->at[i], l->at[j]), in_b = crack_meets(b, l->at[i], l->at[j]);
            wrong += peri_bond_is_intact(body, i, j) != !(in_a || in_b);
            if (i > j) continue;
            want_a += in_a;
            want_b += in_b && !in_a;
        }
    CHECK(wrong == 0);
    CHECK(got_a == want_a);
    CHECK(got_b == want_b);
    CHECK(peri_cut_count(body) == want_a + want_b && peri_broken_count(body) == 0);
    peri_body_destroy(body);
    return want_a + want_b;
}

/* ---- random cracks ------------------------------------------------------------------------------------------------- */

static int64_t whole(uint64_t *seed, int64_t lo, int64_t hi) {
    return lo + (int64_t)(test_random(seed) * (double)(hi - lo + 1));
}

/* Where cracks begin and end: anywhere; on a point; on an axis-parallel bond; half-way between diagonal neighbours. */
static vec spot(const lattice *l, uint64_t *seed) {
    const vec any = make(whole(seed, -6, 4 * l->size[0] + 6), whole(seed, -6, 4 * l->size[1] + 6),
                         l->dim == 3 ? whole(seed, -6, 4 * l->size[2] + 6) : 0);
    vec v = l->at[whole(seed, 0, l->count - 1)];
    switch (whole(seed, 0, 4)) {
    case 0: v.x += whole(seed, 1, 3); return v;
    case 1: return v;
    case 2: v.x += 2, v.y += 2; return v;
    default: return any;
    }
}

static vec step(int dim, uint64_t *seed, int64_t reach) {
    vec v;
    do v = make(whole(seed, -reach, reach), whole(seed, -reach, reach), dim == 3 ? whole(seed, -reach, reach) : 0);
    while (dot(v, v) == 0);
    return v;
}

/* Segments, triangles and so on that have an extent. One in three runs along lattice directions, so that it is collinear with
   bonds, and in 3D in lattice planes, so that it is coplanar with many. */
static crack random_crack(const lattice *l, uint64_t *seed, int kind) {
    const int aligned = whole(seed, 0, 2) == 0;
    const int64_t reach = kind == 'd' ? 2 : aligned ? 1 : 16;
    crack k;
    int n, tries = 1;
    memset(&k, 0, sizeof k);
    k.kind = kind;
    k.count = kind == 's' || kind == 'd' ? 2 : kind == 'p' ? (int)whole(seed, 2, 6) : 3;
    for (; tries; --tries) {
        k.v[0] = spot(l, seed);
        for (n = 1; n < k.count; ++n) {
            const vec s = step(l->dim, seed, reach);
            if (kind == 'd' || kind == 'r') k.v[n] = kind == 'd' || !aligned ? s : times(whole(seed, 1, 16), s);
            else if (aligned) k.v[n] = add(k.v[n - 1], times(whole(seed, 1, 24), s));
            else k.v[n] = spot(l, seed);
            if (kind == 'p' && dot(sub(k.v[n], k.v[n - 1]), sub(k.v[n], k.v[n - 1])) == 0) --n; /* again */
        }
        if (kind == 's' && k.v[0].x == k.v[1].x && k.v[0].y == k.v[1].y) tries = 2;
        if (kind == 'r' && dot(cross(k.v[1], k.v[2]), cross(k.v[1], k.v[2])) == 0) tries = 2;
        if (kind == 't') {
            const vec area = cross(sub(k.v[1], k.v[0]), sub(k.v[2], k.v[0]));
            if (dot(area, area) == 0) tries = 2;
        }
    }
    k.r2 = whole(seed, 1, 200);
    return k;
}

/* The same cracks at three scales, far from the origin (1e5 spacings: rounding of places 1e-11 spacings), and in float. */
static void random_cracks(int dim, const char *kinds, int count) {
    static const double scale[5] = {1.0, 1e-9, 1e6, 1.0, 0.1}, origin[5] = {0, 0, 0, 1e5, 0};
    int64_t cuts[5] = {0, 0, 0, 0, 0};
    int s, n;
    for (s = 0; s < 5; ++s) {
        lattice *l = make_lattice_as(dim, scale[s], origin[s], s == 4 ? PERI_PRECISION_SINGLE : PERI_PRECISION_DOUBLE);
        uint64_t seed = 2024;
        for (n = 0; n < count; ++n) {
            const crack a = random_crack(l, &seed, kinds[n % (int)strlen(kinds)]);
            const crack b = random_crack(l, &seed, kinds[(n + 1) % (int)strlen(kinds)]);
            cuts[s] += check_cracks(l, &a, &b);
        }
        peri_body_destroy(l->body);
    }
    CHECK(cuts[0] > 10 * count); /* they do cut */
    for (s = 1; s < 5; ++s) CHECK(cuts[s] == cuts[0]);
}

static void segments(void) { random_cracks(2, "s", 300); }
static void polylines(void) { random_cracks(2, "p", 100); }
static void triangles(void) { random_cracks(3, "t", 120); }
static void rectangles(void) { random_cracks(3, "r", 100); }
static void discs(void) { random_cracks(3, "d", 150); }
static void mixed_long(void) {
    random_cracks(2, "sp", 5000);
    random_cracks(3, "trd", 3000);
}

/* Truth: peri.h, tolerance 1e-9 of the spacing: a crack that ends 1e-6 short of the bonds at x = 5.5 leaves them, one that ends
   1e-11 short, or past them, cuts: on y = 4 those from rows 1-3 to rows 4-6 that are at most 3 long, which are 6. So does a
   crack 1e-11 above the row y = 4.5, along it, and one 1e-6 above it does not touch the row's own bonds. */
static void near_misses(void) {
    static const double gap[4] = {1e-6, 1e-11, -1e-11, -1e-6};
    static const double scale[3] = {1.0, 1e-9, 1e6};
    int s, k;
    for (s = 0; s < 3; ++s)
        for (k = 0; k < 4; ++k) {
            const double dx = scale[s], a[2] = {4.9 * dx, 4.0 * dx}, b[2] = {(5.5 - gap[k]) * dx, 4.0 * dx};
            const double c[2] = {-dx, (4.5 + gap[k]) * dx}, d[2] = {20 * dx, (4.5 + gap[k]) * dx};
            lattice *l = make_lattice(2, dx, 0.0);
            int32_t r, t, upright = 0, level = 0;
            MUST(l->body, peri_cut_segment(l->body, PERI_CUT_INITIAL, a, b));
            for (r = 1; r <= 3; ++r)
                for (t = 4; t <= r + 3; ++t) upright += peri_bond_is_intact(l->body, 5 + 11 * r, 5 + 11 * t) == 0;
            CHECK(upright == (k == 0 ? 0 : 6));
            MUST(l->body, peri_cut_segment(l->body, PERI_CUT_INITIAL, c, d));
            for (r = 0; r < 11; ++r)
                for (t = r + 1; t < 11 && t <= r + 3; ++t) level += peri_bond_is_intact(l->body, r + 44, t + 44) == 0;
            CHECK(level == (k == 0 || k == 3 ? 0 : 10 + 9 + 8));
            peri_body_destroy(l->body);
        }
}

/* The same in 3D: flat cracks at z = 2, between the layers at 1.5 and 2.5, whose edges end by a gap short of the upright bonds
   through the layer: a rectangle and a triangle at the one at (4.5, 2.5), a disc, off its axes, at the one at (4.5, 3.5). */
static void near_misses_3d(void) {
    static const double gap[4] = {1e-6, 1e-11, -1e-11, -1e-6};
    int s, k, kind;
    for (s = 0; s < 2; ++s)
        for (k = 0; k < 4; ++k)
            for (kind = 0; kind < 3; ++kind) {
                const double dx = s ? 1e-9 : 1.0, reach = (2 - gap[k]) * dx, centre[3] = {2.5 * dx, 2.5 * dx, 2 * dx};
                const double normal[3] = {0, 0, -3}, edge1[3] = {reach, 0, 0}, edge2[3] = {0, 0.7 * dx, 0};
                const double b[3] = {centre[0] + reach, centre[1] + reach, centre[2]}, c[3] = {b[0], centre[1] - reach, b[2]};
                lattice *l = make_lattice(3, dx, 0.0);
                const int32_t at = 4 + 6 * ((kind ? 2 : 3) + 5 * 1), inner = 3 + 6 * (2 + 5 * 1);
                if (kind == 0) MUST(l->body, peri_cut_disc(l->body, PERI_CUT_INITIAL, centre, normal, (sqrt(5.0) - gap[k]) * dx));
                if (kind == 1) MUST(l->body, peri_cut_rectangle(l->body, PERI_CUT_INITIAL, centre, edge1, edge2));
                if (kind == 2) MUST(l->body, peri_cut_triangle(l->body, PERI_CUT_INITIAL, centre, b, c));
                CHECK(peri_bond_is_intact(l->body, at, at + 30) == (k == 0));
                CHECK(peri_bond_is_intact(l->body, inner, inner + 30) == 0);
                peri_body_destroy(l->body);
            }
}

static double area(const double *x, int a, int b, int c) {
    return (x[2 * b] - x[2 * a]) * (x[2 * c + 1] - x[2 * a + 1]) - (x[2 * b + 1] - x[2 * a + 1]) * (x[2 * c] - x[2 * a]);
}

/* Truth: a crack from one point of a cloud to another touches both, so it cuts all their bonds, in either precision; the other
   bonds by orientation, where that is clear by 1e-5 (an area, of edges up to 1). */
static void cloud_points(void) {
    int precision, n, i, j;
    for (precision = PERI_PRECISION_DOUBLE; precision <= PERI_PRECISION_SINGLE; ++precision) {
        static double x[2 * N_MAX], v[N_MAX];
        static int32_t rows[N_MAX * N_MAX];
        peri_body *body = new_body(2, 0.2, precision), *copy;
        int64_t all_missed = 0;
        uint64_t seed = 31;
        int32_t width;
        for (i = 0; i < N_MAX; ++i) {
            x[2 * i] = test_random(&seed);
            x[2 * i + 1] = test_random(&seed);
            v[i] = 1.0 / N_MAX;
        }
        MUST(body, peri_add_points(body, N_MAX, x, v, NULL));
        MUST(body, peri_build(body));
        width = peri_family_width(body);
        MUST(body, peri_get_families(body, 0, N_MAX, rows, N_MAX * N_MAX));
        for (n = 0; n < 40; ++n) {
            const int a = (int)whole(&seed, 0, 127), b = (int)whole(&seed, 128, 255);
            int64_t missed = 0, wrong = 0, clear = 0;
            int k;
            MUST(body, peri_body_clone(body, &copy, NULL));
            CHECK(MUST(copy, peri_cut_segment(copy, PERI_CUT_INITIAL, x + 2 * a, x + 2 * b)) > 0);
            for (i = 0; i < N_MAX; ++i)
                for (k = 0; k < width && (j = rows[i * width + k]) != i; ++k) {
                    const int intact = peri_bond_is_intact(copy, i, j), touches = i == a || i == b || j == a || j == b;
                    const double d1 = area(x, a, b, i), d2 = area(x, a, b, j), d3 = area(x, i, j, a), d4 = area(x, i, j, b);
                    missed += touches && intact;
                    if (touches || fmin(fmin(fabs(d1), fabs(d2)), fmin(fabs(d3), fabs(d4))) < 1e-5) continue;
                    clear++;
                    wrong += intact == (d1 * d2 < 0 && d3 * d4 < 0);
                }
            CHECK(wrong == 0 && clear > 1000);
            all_missed += missed;
            peri_body_destroy(copy);
        }
        if (all_missed) printf("    precision %d: %d bonds of the crack's end points are whole\n", precision, (int)all_missed);
        CHECK(all_missed == 0);
        peri_body_destroy(body);
    }
}

/* ---- cuts by hand -------------------------------------------------------------------------------------------------- */

static double *field(peri_body *body, int32_t which) { /* valid until the next call for this field */
    static double values[17][3 * N_MAX];
    MUST(body, peri_get_field(body, which, values[which % 100], 3 * N_MAX));
    return values[which % 100];
}

/* Truth: a bond is cut once, however it is named; where one pair is no bond, none is cut and the pair is named. */
static void pairs(void) {
    static const int32_t good[8] = {0, 1, 12, 0, 1, 0, 50, 52}, bad[6] = {20, 21, 0, 60, 30, 31}, self[2] = {7, 7}, far_id[2] = {3, 99};
    lattice *l = make_lattice(2, 1.0, 0.0);
    peri_error error;
    CHECK(peri_cut_pairs(l->body, PERI_CUT_INITIAL, 3, bad) == PERI_ERROR_PAIR);
    CHECK(peri_get_error(l->body, &error) == PERI_OK && error.code == PERI_ERROR_PAIR && error.index == 1);
    CHECK(peri_bond_is_intact(l->body, 20, 21) == 1 && peri_bond_is_intact(l->body, 30, 31) == 1);
    CHECK(peri_cut_pairs(l->body, PERI_CUT_INITIAL, 1, self) < 0);
    CHECK(peri_cut_pairs(l->body, PERI_CUT_INITIAL, 1, far_id) < 0);
    CHECK(peri_cut_count(l->body) == 0);
    CHECK(peri_cut_pairs(l->body, PERI_CUT_INITIAL, 4, good) == 3);
    CHECK(peri_cut_pairs(l->body, PERI_CUT_INITIAL, 4, good) == 0);
    CHECK(peri_cut_count(l->body) == 3);
    CHECK(peri_bond_is_intact(l->body, 1, 0) == 0 && peri_bond_is_intact(l->body, 0, 12) == 0);
    CHECK(peri_bond_is_intact(l->body, 52, 50) == 0 && peri_bond_is_intact(l->body, 0, 2) == 1);
    CHECK(peri_bond_is_intact(l->body, 0, 60) == PERI_ERROR_PAIR && peri_bond_is_intact(l->body, 5, 5) == PERI_ERROR_PAIR);
    peri_body_destroy(l->body);
}

typedef struct {
    const double *x;
    int64_t calls, taken, wrong;
} pair_state;

static int32_t some_pairs(void *user, int32_t i, int32_t j, const double *xi, const double *xj) {
    pair_state *s = (pair_state *)user;
    const int32_t take = (i + j) % 5 == 0;
    s->wrong += i >= j || xi[0] != s->x[2 * i] || xi[1] != s->x[2 * i + 1] || xj[0] != s->x[2 * j] || xj[1] != s->x[2 * j + 1];
    s->calls++;
    s->taken += take;
    return take;
}

/* Truth: the function is asked once for every bond, and its answer is the bond's state. */
static void pairs_if(void) {
    lattice *l = make_lattice(2, 1.0, 0.0);
    pair_state s = {NULL, 0, 0, 0};
    int32_t i, j, k, wrong = 0;
    s.x = field(l->body, PERI_FIELD_POSITION);
    CHECK(peri_cut_if(l->body, PERI_CUT_INITIAL, some_pairs, &s) == s.taken);
    CHECK(s.calls == peri_entry_count(l->body) / 2 && s.wrong == 0 && s.taken > 100 && peri_cut_count(l->body) == s.taken);
    for (i = 0; i < l->count; ++i)
        for (k = 0; k < l->width && (j = l->rows[i * l->width + k]) != i; ++k)
            wrong += peri_bond_is_intact(l->body, i, j) != ((i + j) % 5 != 0);
    CHECK(wrong == 0);
    peri_body_destroy(l->body);
}

/* Truth: peri.h: no extent, or of the other space: PERI_ERROR_CRACK, and nothing is cut. */
static void refused(void) {
    static const double a[3] = {1, 2, 2}, b[3] = {3, 2, 2}, c[3] = {5, 2, 2}, same[6] = {1, 2, 1, 2, 1, 2}, no[3] = {0, 0, 0};
    static const double bad[3] = {1, HUGE_VAL, 2};
    lattice *l = make_lattice(2, 1.0, 0.0);
    CHECK(peri_cut_segment(l->body, PERI_CUT_INITIAL, a, a) == PERI_ERROR_CRACK);
    CHECK(peri_cut_polyline(l->body, PERI_CUT_INITIAL, 3, same) == PERI_ERROR_CRACK);
    CHECK(peri_cut_disc(l->body, PERI_CUT_INITIAL, a, b, 1.0) == PERI_ERROR_CRACK);
    CHECK(peri_cut_triangle(l->body, PERI_CUT_INITIAL, a, b, no) == PERI_ERROR_CRACK);
    CHECK(peri_cut_rectangle(l->body, PERI_CUT_INITIAL, a, b, no) == PERI_ERROR_CRACK);
    CHECK(peri_cut_segment(l->body, PERI_CUT_INITIAL, a, bad) == PERI_ERROR_RANGE);
    CHECK(peri_cut_count(l->body) == 0);
    peri_body_destroy(l->body);
    l = make_lattice(3, 1.0, 0.0);
    CHECK(peri_cut_segment(l->body, PERI_CUT_INITIAL, a, b) == PERI_ERROR_CRACK);
    CHECK(peri_cut_polyline(l->body, PERI_CUT_INITIAL, 2, same) == PERI_ERROR_CRACK);
    CHECK(peri_cut_disc(l->body, PERI_CUT_INITIAL, a, no, 1.0) == PERI_ERROR_CRACK);
    CHECK(peri_cut_disc(l->body, PERI_CUT_INITIAL, a, b, 0.0) == PERI_ERROR_CRACK);
    CHECK(peri_cut_triangle(l->body, PERI_CUT_INITIAL, a, b, c) == PERI_ERROR_CRACK);
    CHECK(peri_cut_triangle(l->body, PERI_CUT_INITIAL, a, a, no) == PERI_ERROR_CRACK);
    CHECK(peri_cut_rectangle(l->body, PERI_CUT_INITIAL, no, a, a) == PERI_ERROR_CRACK);
    CHECK(peri_cut_rectangle(l->body, PERI_CUT_INITIAL, a, b, no) == PERI_ERROR_CRACK);
    CHECK(peri_cut_disc(l->body, PERI_CUT_INITIAL, a, bad, 1.0) == PERI_ERROR_RANGE && peri_cut_count(l->body) == 0);
    peri_body_destroy(l->body);
}

/* ---- damage -------------------------------------------------------------------------------------------------------- */

static int32_t advance(peri_body *body, int64_t steps, double time_step) {
    peri_advance_desc r;
    peri_advance_desc_init(&r);
    r.steps = steps;
    r.time_step = time_step;
    return (int32_t)MUST(body, peri_advance(body, &r));
}

/* Truth: points on a notch have no bonds: damage 1, no force, and they keep their velocity: u = v t. The rest moves under its
   load and everything stays finite. In float, t is a sum of 50 steps: 50 roundings of 6e-8. */
static void notch_through_points(void) {
    static const double a[2] = {0, 4.5}, b[2] = {5.5, 4.5}, up[2] = {0, 1e-3}, v[2] = {0.01, -0.02};
    int precision;
    for (precision = PERI_PRECISION_DOUBLE; precision <= PERI_PRECISION_SINGLE; ++precision) {
        static const double lo[2] = {0, 0}, hi[2] = {11, 9}, top[4] = {0, 8, 11, 9};
        static const int32_t ids[6] = {44, 45, 46, 47, 48, 49};
        peri_body *body = new_body(2, 3.0, precision);
        double *u, *f, *damage;
        int i;
        MUST(body, peri_add_box(body, peri_id(body, PERI_KIND_MATERIAL, 1), lo, hi, 1.0));
        MUST(body, peri_build(body));
        CHECK(MUST(body, peri_cut_segment(body, PERI_CUT_INITIAL, a, b)) > 0);
        MUST(body, peri_apply_body_force(body, peri_select_box(body, "top", top, top + 2), up, NULL, NULL));
        MUST(body, peri_add_velocity(body, peri_select_points(body, "free", 6, ids), v));
        advance(body, 50, 0.0);
        u = field(body, PERI_FIELD_DISPLACEMENT);
        f = field(body, PERI_FIELD_FORCE_DENSITY);
        damage = field(body, PERI_FIELD_DAMAGE);
        for (i = 0; i < 99; ++i) {
            CHECK(isfinite(u[2 * i]) && isfinite(u[2 * i + 1]) && isfinite(f[2 * i]) && isfinite(f[2 * i + 1]));
            if (i < 44 || i > 49) {
                CHECK(damage[i] < 1.0);
                continue;
            }
            CHECK(damage[i] == 1.0 && f[2 * i] == 0.0 && f[2 * i + 1] == 0.0);
            CHECK_NEAR(u[2 * i], v[0] * peri_time(body), precision == PERI_PRECISION_DOUBLE ? 1e-13 : 50 * 6e-8, 0.0);
            CHECK_NEAR(u[2 * i + 1], v[1] * peri_time(body), precision == PERI_PRECISION_DOUBLE ? 1e-13 : 50 * 6e-8, 0.0);
        }
        CHECK(u[2 * 93 + 1] > 0.0);
        peri_body_destroy(body);
    }
}

/* Truth: by hand. 3 x 3 points, horizon 1.5: corners 3 bonds, sides 5, centre (4) 8. Cut 4-0, 4-1, 0-1 and, after a step, 4-2,
   4-3, 4-5. Damage counts all, PERI_FIELD_DAMAGE_GROWN only the later ones among those not cut before. Reset makes the later ones
   whole. Then unequal volumes: 1 - intact volume / volume of the family. */
static void damage_index(void) {
    static const double lo[2] = {0, 0}, hi[2] = {3, 3};
    static const int32_t first[6] = {4, 0, 4, 1, 0, 1}, later[6] = {2, 4, 3, 4, 4, 5}, rest[2] = {0, 3};
    static const double all[9] = {2.0 / 3, 2.0 / 5, 1.0 / 3, 1.0 / 5, 5.0 / 8, 1.0 / 5, 0, 0, 0};
    static const double grown[9] = {0, 0, 1.0 / 3, 1.0 / 5, 3.0 / 6, 1.0 / 5, 0, 0, 0};
    static const double before[9] = {2.0 / 3, 2.0 / 5, 0, 0, 2.0 / 8, 0, 0, 0, 0};
    static const double x[8] = {0, 0, 1, 0, 0, 1, 1, 1}, v[4] = {1.0, 0.5, 0.25, 0.75};
    static const int32_t one[2] = {3, 0}, two[2] = {0, 1};
    peri_body *body = new_body(2, 1.5, PERI_PRECISION_DOUBLE);
    double *d;
    int i;
    MUST(body, peri_add_box(body, peri_id(body, PERI_KIND_MATERIAL, 1), lo, hi, 1.0));
    MUST(body, peri_build(body));
    CHECK(peri_cut_pairs(body, PERI_CUT_INITIAL, 3, first) == 3);
    advance(body, 1, 0.0);
    CHECK(peri_cut_pairs(body, PERI_CUT_NOW, 3, later) == 3);
    CHECK(peri_cut_count(body) == 3 && peri_broken_count(body) == 3);
    d = field(body, PERI_FIELD_DAMAGE);
    for (i = 0; i < 9; ++i) CHECK_NEAR(d[i], all[i], 0.0, 1e-14);
    d = field(body, PERI_FIELD_DAMAGE_GROWN);
    for (i = 0; i < 9; ++i) CHECK_NEAR(d[i], grown[i], 0.0, 1e-14);
    MUST(body, peri_reset(body));
    CHECK(peri_cut_count(body) == 3 && peri_broken_count(body) == 0);
    CHECK(peri_bond_is_intact(body, 4, 2) == 1 && peri_bond_is_intact(body, 4, 1) == 0);
    d = field(body, PERI_FIELD_DAMAGE);
    for (i = 0; i < 9; ++i) CHECK_NEAR(d[i], before[i], 0.0, 1e-14);
    CHECK(peri_cut_pairs(body, PERI_CUT_INITIAL, 1, rest) == 1); /* point 0 has no bond left that could grow damage */
    CHECK(field(body, PERI_FIELD_DAMAGE)[0] == 1.0 && field(body, PERI_FIELD_DAMAGE_GROWN)[0] == 0.0);
    peri_body_destroy(body);

    body = new_body(2, 1.5, PERI_PRECISION_DOUBLE);
    MUST(body, peri_add_points(body, 4, x, v, NULL));
    MUST(body, peri_build(body));
    CHECK(peri_cut_pairs(body, PERI_CUT_INITIAL, 1, one) == 1);
    advance(body, 1, 0.0);
    CHECK(peri_cut_pairs(body, PERI_CUT_NOW, 1, two) == 1);
    d = field(body, PERI_FIELD_DAMAGE);
    CHECK_NEAR(d[0], 1.0 - 0.25 / 1.5, 1e-14, 0.0);
    CHECK_NEAR(d[1], 1.0 - 1.0 / 2.0, 1e-14, 0.0);
    CHECK_NEAR(d[2], 0.0, 0.0, 1e-14);
    CHECK_NEAR(d[3], 1.0 - 0.75 / 1.75, 1e-14, 0.0);
    d = field(body, PERI_FIELD_DAMAGE_GROWN);
    CHECK_NEAR(d[0], 1.0 - 0.25 / 0.75, 1e-14, 0.0);
    CHECK_NEAR(d[3], 0.0, 0.0, 1e-14);
    peri_body_destroy(body);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(segments);
    RUN(polylines);
    RUN(triangles);
    RUN(rectangles);
    RUN(discs);
    LONG_RUN(mixed_long);
    RUN(near_misses);
    RUN(near_misses_3d);
    RUN(cloud_points);
    RUN(pairs);
    RUN(pairs_if);
    RUN(refused);
    RUN(notch_through_points);
    RUN(damage_index);
    return test_end("test_cracks");
}
