/* SPDX-License-Identifier: MIT */
/* test_cells.c - cells of the caller: their volumes and centroids, the parts of them within a horizon, what is refused.

   SOURCE OF TRUTH: sums of triangles and determinants; Gauss's rule on the Jacobian of trilinear hexahedra; affine maps, that turn volumes
   and centroids as they turn space. The parts of the cells around a place add up to the disk or the ball. The part of a convex cell is the
   sum of chords that lines cut out of it and of the ball. Squares and bricks are those of peri_add_box. */
#include "cell_mesh.h"
#include "pool.h"

#define PI 3.14159265358979323846

/* ---- volumes and centroids ------------------------------------------------------------------------------------------ */

/* The cells of a descriptor as points: places and volumes. */
static void points_of(int dim, const peri_cells_desc *d, double *x, double *v) {
    const solid s = solid_with(dim, PERI_LAW_BOND_BASED, PERI_QUADRATURE_PARTIAL, 1e4);
    peri_body *b = solid_new(&s);
    (void)MUST(b, peri_add_cells(b, d));
    (void)MUST(b, peri_build(b));
    (void)MUST(b, peri_get_field(b, PERI_FIELD_POSITION, x, d->cell_count * dim));
    (void)MUST(b, peri_get_field(b, PERI_FIELD_VOLUME, v, d->cell_count));
    peri_body_destroy(b);
}

/* Stars of random corners about a centre, far from the origin: triangles of that centre. Every second one clockwise. */
static void polygons(void) {
    enum { COUNT = 40 };
    double x[COUNT * 2], v[COUNT], corner[COUNT * 12][3] = {{0}};
    int64_t offset[COUNT + 1] = {0};
    int32_t order[COUNT * 12];
    uint64_t seed = 5;
    double want[COUNT][3] = {{0}};
    peri_cells_desc d;
    int total = 0;
    for (int k = 0; k < COUNT; ++k) {
        const int n = 3 + k % 10;
        const double at[2] = {500 + 3.0 * k, -800 - k};
        for (int c = 0; c < n; ++c) {
            const double r = n < 4 ? 1 : 0.3 + test_random(&seed), angle = 2 * PI * (c + 0.4 * test_random(&seed)) / n;
            corner[total + c][0] = at[0] + r * cos(angle);
            corner[total + c][1] = at[1] + r * sin(angle);
            order[total + c] = total + (k % 2 ? n - 1 - c : c);
        }
        for (int c = 0; c < n; ++c) {
            const double *p = corner[total + c], *q = corner[total + (c + 1) % n];
            const double area = 0.5 * ((p[0] - at[0]) * (q[1] - at[1]) - (p[1] - at[1]) * (q[0] - at[0]));
            want[k][2] += area;
            for (int e = 0; e < 2; ++e) want[k][e] += area * ((p[e] - at[e]) + (q[e] - at[e])) / 3;
        }
        for (int e = 0; e < 2; ++e) want[k][e] = at[e] + want[k][e] / want[k][2];
        offset[k + 1] = total += n;
    }
    peri_cells_desc_init(&d);
    d.vertex_count = total, d.vertices = corner[0], d.vertex_stride = 3, d.cell_count = COUNT, d.corners = order, d.offsets = offset;
    points_of(2, &d, x, v);
    for (int k = 0; k < COUNT; ++k) {
        CHECK_NEAR(v[k], want[k][2], 1e-12, 0);
        for (int e = 0; e < 2; ++e) CHECK_NEAR(x[2 * k + e], want[k][e], 0, 1e-11);
    }
}

/* Determinant of the columns. */
static double determinant(const double *a, const double *b, const double *c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

static const double cube[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
/* A frustum: the upper face is a half as long as the lower one, so that the area at height z is (1 - z/2)^2. */
static const double frustum[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {0.5, 0, 1}, {0.5, 0.5, 1}, {0, 0.5, 1}};
static const double shape[4][6][3] = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}},
                                      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}},
                                      {{0}}};
static const double size_of_shape[4] = {1.0 / 6, 1.0 / 3, 0.5, 7.0 / 12};
/* of the frustum: int z (1-z/2)^2 = 11/48; int (1-z/2)^3/2 = 15/64 along x and y */
static const double middle_of_shape[4][3] = {{0.25, 0.25, 0.25}, {0.5, 0.5, 0.25}, {1.0 / 3, 1.0 / 3, 0.5},
                                             {15.0 / 64 * 12 / 7, 15.0 / 64 * 12 / 7, 11.0 / 48 * 12 / 7}};
static const int corners_of_shape[4] = {4, 5, 6, 8};

/* Affine images of the four shapes; maps that mirror, too. */
static void solids(void) {
    enum { COUNT = 40 };
    double x[COUNT * 3], v[COUNT], corner[COUNT * 8][3];
    int64_t offset[COUNT + 1] = {0};
    int32_t order[COUNT * 8];
    uint64_t seed = 9;
    double want[COUNT][4];
    peri_cells_desc d;
    int total = 0;
    for (int k = 0; k < COUNT; ++k) {
        const int kind = k % 4;
        double map[3][3], at[3] = {300 + 5.0 * k, 7, -4};
        for (int c = 0; c < 3; ++c)
            for (int e = 0; e < 3; ++e) map[c][e] = (c == e) * (k / 4 % 2 ? -1 : 1) + 0.4 * (2 * test_random(&seed) - 1);
        for (int c = 0; c < corners_of_shape[kind]; ++c, ++total) {
            const double *p = kind == 3 ? frustum[c] : shape[kind][c];
            for (int e = 0; e < 3; ++e) corner[total][e] = at[e] + map[0][e] * p[0] + map[1][e] * p[1] + map[2][e] * p[2];
            order[total] = total;
        }
        offset[k + 1] = total;
        const double *middle = middle_of_shape[kind];
        for (int e = 0; e < 3; ++e) want[k][e] = at[e] + map[0][e] * middle[0] + map[1][e] * middle[1] + map[2][e] * middle[2];
        want[k][3] = fabs(determinant(map[0], map[1], map[2])) * size_of_shape[kind];
    }
    peri_cells_desc_init(&d);
    d.vertex_count = total, d.vertices = corner[0], d.cell_count = COUNT, d.corners = order, d.offsets = offset;
    points_of(3, &d, x, v);
    for (int k = 0; k < COUNT; ++k) {
        CHECK_NEAR(v[k], want[k][3], 1e-12, 0);
        for (int e = 0; e < 3; ++e) CHECK_NEAR(x[3 * k + e], want[k][e], 0, 1e-11);
    }
}

/* The volume of a hexahedron with warped faces is the integral of the Jacobian of its trilinear map: two Gauss points per axis. */
static void warped_hexahedra(void) {
    cell_mesh m = mesh_of(HEXAHEDRA, 4, 0.3, 3);
    const peri_cells_desc d = mesh_desc(&m);
    double *x = (double *)malloc((size_t)m.cells * 3 * sizeof *x), *v = (double *)malloc((size_t)m.cells * sizeof *v), sum = 0;
    points_of(3, &d, x, v);
    for (int64_t k = 0; k < m.cells; ++k) {
        double volume = 0;
        for (int g = 0; g < 8; ++g) {
            double r[3], column[3][3] = {{0}};
            for (int e = 0; e < 3; ++e) r[e] = 0.5 + (g >> e & 1 ? 0.5 : -0.5) / sqrt(3.0);
            for (int c = 0; c < 8; ++c)
                for (int e = 0; e < 3; ++e) {
                    double slope = cube[c][e] > 0 ? 1 : -1;
                    for (int o = 0; o < 3; ++o) slope *= o == e ? 1 : cube[c][o] > 0 ? r[o] : 1 - r[o];
                    for (int o = 0; o < 3; ++o) column[e][o] += slope * m.x[3 * m.corner[8 * k + c] + o];
                }
            volume += determinant(column[0], column[1], column[2]) / 8;
        }
        CHECK_NEAR(v[k], volume, 1e-13, 0);
        sum += v[k];
    }
    CHECK_NEAR(sum, 64, 1e-13, 0);
    free(x);
    free(v);
    mesh_free(&m);
}

/* ---- parts ------------------------------------------------------------------------------------------------------------ */

/* With the influence 1/q a bond-based point under the strain e in all directions has the energy of the solid times the volume of its family
   over that of the full horizon: w |xi| does not depend on the length. A tiny cell at `at` is bonded with
   the mean of two parts: that of the other cell within its own horizon, and its own within the other's, which is all or nothing. So
       2 sum beta V - sum of V of the points within the horizon = sum of the parts. d NULL: of a perturbed box. */
static double sum_of_parts(int dim, double horizon, const double *at, const peri_cells_desc *d) {
    solid s = solid_with(dim, PERI_LAW_BOND_BASED, PERI_QUADRATURE_PARTIAL, horizon);
    const double tiny = 1e-5 * horizon, eps[6] = {1e-3, 1e-3, dim == 3 ? 1e-3 : 0, 0, 0, 0};
    const double full = dim == 3 ? 4 * PI / 3 * pow(horizon, 3) : PI * horizon * horizon;
    const double lo[3] = {0, 0, 0}, hi[3] = {4, 4, 4};
    double corner[8][3], h[9], within = 0, *x, *v, *w;
    int32_t order[8] = {0, 1, 2, 3, 4, 5, 6, 7};
    peri_cells_desc probe;
    s.influence = PERI_INFLUENCE_INVERSE;
    peri_body *b = solid_new(&s);
    for (int c = 0; c < (dim == 3 ? 8 : 4); ++c)
        for (int k = 0; k < 3; ++k) corner[c][k] = (k < dim ? at[k] : 0) + tiny * (cube[c][k] - 0.5);
    peri_cells_desc_init(&probe);
    probe.vertex_count = probe.cell_corners = dim == 3 ? 8 : 4;
    probe.vertices = corner[0], probe.vertex_stride = 3, probe.cell_count = 1, probe.corners = order;
    (void)MUST(b, peri_add_cells(b, &probe));
    if (d) (void)MUST(b, peri_add_cells(b, d));
    else (void)MUST(b, peri_add_perturbed_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo, hi, 1, 1, 3));
    (void)MUST(b, peri_build(b));
    strain_matrix(dim, eps, h);
    stretch_by(b, h);
    x = get(b, PERI_FIELD_POSITION);
    v = get(b, PERI_FIELD_VOLUME);
    w = get(b, PERI_FIELD_ENERGY_DENSITY);
    for (int64_t i = 1; i < peri_point_count(b); ++i) {
        double square = 0;
        for (int k = 0; k < dim; ++k) square += pow(x[i * dim + k] - x[k], 2);
        CHECK(fabs(sqrt(square) - horizon) > 2 * tiny); /* else it is neither all nor nothing */
        if (square < horizon * horizon) within += v[i];
    }
    const double parts = 2 * full * w[0] / solid_energy(&s, eps) - within;
    free(x);
    free(v);
    free(w);
    peri_body_destroy(b);
    return parts;
}

/* Disks and balls in meshes that hold them. */
static void parts_add_up(void) {
    for (int kind = 0; kind < MESH_KINDS; ++kind) {
        cell_mesh m = mesh_of(kind, kind < TETRAHEDRA ? 8 : 4, 0.22, 7);
        const peri_cells_desc d = mesh_desc(&m);
        uint64_t seed = 1;
        for (int k = kind < TETRAHEDRA || test_long ? 0 : 2; k < 4; ++k) {
            const double horizon = (kind < TETRAHEDRA ? 2 : 1) * (0.4 + 0.3 * k), middle = 0.5 * m.side;
            double at[3];
            for (int e = 0; e < 3; ++e) at[e] = middle + 0.8 * (test_random(&seed) - 0.5);
            const double sum = sum_of_parts(m.dim, horizon, at, &d);
            const double want = m.dim == 3 ? 4 * PI / 3 * pow(horizon, 3) : PI * pow(horizon, 2);
            if (test_long) printf("    %s, horizon %.1f: sum of parts off by %.1e\n", mesh_name[kind], horizon, sum / want - 1);
            CHECK_NEAR(sum, want, 1e-12, 0);
        }
        mesh_free(&m);
    }
}

/* The hexahedra of a perturbed box. */
static void parts_of_a_perturbed_box_add_up(void) {
    for (int dim = 2; dim <= 3; ++dim) {
        const double horizon = dim == 2 ? 1.9 : 1.3, at[3] = {2.1, 1.9, 2.2}, want = dim == 3 ? 4 * PI / 3 * pow(1.3, 3) : PI * pow(1.9, 2);
        CHECK_NEAR(sum_of_parts(dim, horizon, at, NULL), want, 1e-12, 0);
    }
}

/* Affine images of the shapes of which all faces are flat; chords along x of lines through the middles of a fine grid in y and z. */
typedef struct planes {
    int    count;
    double normal[6][3], at[6];
} planes;

static planes planes_of(const double (*x)[3], int corners) {
    static const int faces[4][7][3] = {{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}},
                                       {{0, 3, 2}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}},
                                       {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {1, 2, 5}, {2, 0, 3}},
                                       {{0, 3, 2}, {4, 5, 6}, {0, 1, 5}, {1, 2, 6}, {2, 3, 7}, {3, 0, 4}}};
    const int kind = corners == 8 ? 3 : corners - 4;
    planes p;
    p.count = corners == 4 ? 4 : corners == 8 ? 6 : 5;
    for (int f = 0; f < p.count; ++f) {
        const double *a = x[faces[kind][f][0]], *b = x[faces[kind][f][1]], *c = x[faces[kind][f][2]];
        double u[3], w[3];
        for (int e = 0; e < 3; ++e) u[e] = b[e] - a[e], w[e] = c[e] - a[e];
        for (int e = 0; e < 3; ++e) p.normal[f][e] = u[(e + 1) % 3] * w[(e + 2) % 3] - u[(e + 2) % 3] * w[(e + 1) % 3];
        p.at[f] = p.normal[f][0] * a[0] + p.normal[f][1] * a[1] + p.normal[f][2] * a[2];
    }
    return p;
}

static double part_by_chords(const planes *p, const double *at, double R) {
    enum { FINE = 700 };
    const double step = 2 * R / FINE;
    double sum = 0;
    for (int k = 0; k < FINE * FINE; ++k) {
        const double y = at[1] - R + step * (k % FINE + 0.5), z = at[2] - R + step * (k / FINE + 0.5);
        const double square = R * R - pow(y - at[1], 2) - pow(z - at[2], 2);
        double lo = at[0] - sqrt(square > 0 ? square : 0), hi = at[0] + sqrt(square > 0 ? square : 0);
        for (int f = 0; f < p->count && hi > lo; ++f) {
            const double slope = p->normal[f][0], rest = p->at[f] - p->normal[f][1] * y - p->normal[f][2] * z;
            if (slope > 0) hi = fmin(hi, rest / slope);
            else lo = fmax(lo, rest / slope);
        }
        if (hi > lo) sum += (hi - lo) * step * step;
    }
    return sum;
}

/* A cell beside the centre, around it, and far out: the sum over lines has an error of some step^1.5. */
static void parts_of_single_cells(void) {
    uint64_t seed = 21;
    for (int k = 0; k < 12; ++k) {
        const int kind = k % 4, corners = corners_of_shape[kind];
        double x[8][3], map[3][3], at[3];
        const int32_t order[8] = {0, 1, 2, 3, 4, 5, 6, 7};
        peri_cells_desc d;
        for (int c = 0; c < 3; ++c)
            for (int e = 0; e < 3; ++e) map[c][e] = (c == e) + 0.3 * (2 * test_random(&seed) - 1);
        for (int c = 0; c < corners; ++c)
            for (int e = 0; e < 3; ++e) {
                const double *p = kind == 3 ? frustum[c] : shape[kind][c];
                x[c][e] = map[0][e] * p[0] + map[1][e] * p[1] + map[2][e] * p[2];
            }
        for (int e = 0; e < 3; ++e) {
            at[e] = map[0][e] * middle_of_shape[kind][0] + map[1][e] * middle_of_shape[kind][1] + map[2][e] * middle_of_shape[kind][2];
            at[e] += (k < 4 ? 0.1 : 0.6) * (e == k % 3 ? 1 : 0.4);
        }
        const double horizon = k < 4 ? 0.5 : k < 8 ? 0.7 : 0.55;
        const planes p = planes_of((const double(*)[3])x, corners);
        peri_cells_desc_init(&d);
        d.vertex_count = d.cell_corners = corners, d.vertices = x[0], d.cell_count = 1, d.corners = order;
        const double part = sum_of_parts(3, horizon, at, &d), want = part_by_chords(&p, at, horizon);
        if (test_long) printf("    %d corners, horizon %.2f: part %.6f, by chords %.6f\n", corners, horizon, part, want);
        CHECK(want > 0.01);
        CHECK_NEAR(part, want, 1e-4, 1e-5);
    }
}

/* Of random triangles and hooks: rays from the centre, of which the pieces within the polygon are known from its sides. */
static void areas_of_single_cells(void) {
    static const double hook[6][2] = {{0, 0}, {1.2, 0.1}, {0.5, 0.4}, {0.45, 0.8}, {1, 1}, {-0.1, 1.1}};
    const int32_t order[6] = {0, 1, 2, 3, 4, 5};
    uint64_t seed = 4;
    for (int k = 0; k < 8; ++k) {
        enum { RAYS = 200000 };
        const int n = k % 2 ? 6 : 3;
        double x[6][2], at[2], want = 0;
        const double R = 0.45 + 0.1 * k;
        peri_cells_desc d;
        for (int c = 0; c < n; ++c)
            for (int e = 0; e < 2; ++e) x[c][e] = hook[n == 3 && c ? 2 * c - (c == 1) : c][e] + 0.1 * test_random(&seed);
        at[0] = 0.3 + 0.5 * test_random(&seed);
        at[1] = 0.4 + 0.2 * test_random(&seed);
        for (int r = 0; r < RAYS; ++r) {
            const double angle = 2 * PI * (r + 0.5) / RAYS, u[2] = {cos(angle), sin(angle)};
            for (int c = 0; c < n; ++c) { /* each side adds or takes the sector up to it, by the way that it passes the ray */
                const double *p = x[c], *q = x[(c + 1) % n], a[2] = {p[0] - at[0], p[1] - at[1]}, b[2] = {q[0] - at[0], q[1] - at[1]};
                const double ua = u[0] * a[1] - u[1] * a[0], ub = u[0] * b[1] - u[1] * b[0];
                if ((ua > 0) == (ub > 0)) continue;
                const double away = ((u[0] * a[0] + u[1] * a[1]) * ub - (u[0] * b[0] + u[1] * b[1]) * ua) / (ub - ua);
                if (away > 0) want += (ub > ua ? 1 : -1) * 0.5 * pow(fmin(away, R), 2) * 2 * PI / RAYS;
            }
        }
        peri_cells_desc_init(&d);
        d.vertex_count = d.cell_corners = n, d.vertices = x[0], d.cell_count = 1, d.corners = order;
        CHECK(want > 0.01);
        CHECK_NEAR(sum_of_parts(2, R, at, &d), want, 1e-6, 1e-6);
    }
}

/* ---- as peri_add_box ---------------------------------------------------------------------------------------------------- */

static void shake(peri_body *b) {
    uint64_t seed = 11;
    double *u = get(b, PERI_FIELD_DISPLACEMENT);
    for (int64_t k = 0; k < peri_point_count(b) * peri_dimension(b); ++k) u[k] = 1e-3 * (2 * test_random(&seed) - 1);
    put(b, PERI_FIELD_DISPLACEMENT, u);
    free(u);
}

static void same_forces(peri_body *a, peri_body *b, double bound) {
    double *f, *g, most = 0;
    shake(a);
    shake(b);
    CHECK(peri_point_count(a) == peri_point_count(b) && peri_bond_count(a) == peri_bond_count(b));
    f = get(a, PERI_FIELD_FORCE_DENSITY);
    g = get(b, PERI_FIELD_FORCE_DENSITY);
    most = largest(f, peri_point_count(a) * peri_dimension(a));
    for (int64_t k = 0; k < peri_point_count(a) * peri_dimension(a); ++k) CHECK(fabs(f[k] - g[k]) <= bound * most);
    CHECK(most > 0);
    free(f);
    free(g);
    peri_body_destroy(a);
    peri_body_destroy(b);
}

static const int32_t quadratures[5] = {PERI_QUADRATURE_FULL, PERI_QUADRATURE_RAMP, PERI_QUADRATURE_PARTIAL,
                                       PERI_QUADRATURE_PARTIAL_CENTROID, PERI_QUADRATURE_PARTIAL_MOMENT};

/* Squares and cubes; in 3D the box is integrated by Gauss's rule, here there are closed forms. */
static void squares_are_those_of_a_box(void) {
    for (int dim = 2; dim <= 3; ++dim)
        for (int q = 0; q < (dim == 2 ? 5 : 3); ++q)
            for (int32_t law = PERI_LAW_BOND_BASED; law <= (q < 3 ? PERI_LAW_LPS : PERI_LAW_BOND_BASED); ++law) {
                const solid s = solid_with(dim, law, quadratures[q], dim == 2 ? 2.3 : 1.6);
                const int n = dim == 2 ? 9 : 4;
                const double lo[3] = {0, 0, 0}, hi[3] = {n, n, n};
                cell_mesh m = mesh_of(dim == 2 ? QUADS : HEXAHEDRA, n, 0, 1);
                peri_body *a = mesh_body(&m, &s), *b = solid_new(&s);
                (void)MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo, hi, 1));
                (void)MUST(b, peri_build(b));
                same_forces(a, b, dim == 2 ? 1e-13 : 1e-9);
                mesh_free(&m);
            }
}

/* Rectangles and bricks with edges of their own. */
static void grids(void) {
    const double lo[3] = {-1, 2, 0}, hi[3] = {1, 5, 0.5};
    for (int dim = 2; dim <= 3; ++dim) {
        const solid s = solid_with(dim, PERI_LAW_LPS, PERI_QUADRATURE_PARTIAL, 0.9);
        const int32_t cells[3] = {8, 5, 4};
        cell_mesh m = mesh_of(dim == 2 ? QUADS : HEXAHEDRA, 8, 0, 1);
        peri_cells_desc d = mesh_desc(&m);
        int32_t *order = (int32_t *)malloc((size_t)m.total * sizeof *order);
        int64_t kept = 0;
        for (int64_t k = 0; k < m.cells; ++k) { /* of 8 cells per axis those that the grid has */
            const int64_t at[3] = {k % 8, k / 8 % 8, k / 64};
            if (at[1] >= cells[1] || (dim == 3 && at[2] >= cells[2])) continue;
            memcpy(&order[kept++ * (dim == 3 ? 8 : 4)], &m.corner[k * (dim == 3 ? 8 : 4)], (dim == 3 ? 8 : 4) * sizeof *order);
        }
        for (int64_t v = 0; v < m.vertices; ++v)
            for (int e = 0; e < dim; ++e) m.x[v * dim + e] = lo[e] + (hi[e] - lo[e]) * m.x[v * dim + e] / cells[e];
        d.offsets = NULL, d.cell_corners = dim == 3 ? 8 : 4, d.corners = order, d.cell_count = kept;
        peri_body *a = solid_new(&s), *b = solid_new(&s);
        CHECK(MUST(a, peri_add_cells(a, &d)) == 40 * (dim == 3 ? 4 : 1));
        CHECK(MUST(b, peri_add_grid(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo, hi, cells)) == kept);
        (void)MUST(a, peri_build(a));
        (void)MUST(b, peri_build(b));
        same_forces(a, b, dim == 2 ? 1e-12 : 1e-9);
        free(order);
        mesh_free(&m);
    }
}
static void a_grid_may_be_a_box(void) {
    const double lo[2] = {0, 0}, hi[2] = {6, 4};
    const int32_t cells[2] = {12, 8};
    const solid s = solid_with(2, PERI_LAW_LPS, PERI_QUADRATURE_PARTIAL, 1.6);
    peri_body *a = solid_new(&s), *b = solid_new(&s);
    (void)MUST(a, peri_add_box(a, peri_id(a, PERI_KIND_MATERIAL, 1), lo, hi, 0.5));
    (void)MUST(b, peri_add_grid(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo, hi, cells));
    (void)MUST(a, peri_build(a));
    (void)MUST(b, peri_build(b));
    same_forces(a, b, 0);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(polygons);
    RUN(solids);
    RUN(warped_hexahedra);
    RUN(parts_add_up);
    RUN(parts_of_a_perturbed_box_add_up);
    RUN(areas_of_single_cells);
    RUN(parts_of_single_cells);
    RUN(squares_are_those_of_a_box);
    RUN(grids);
    RUN(a_grid_may_be_a_box);
    return test_end("test_cells");
}
