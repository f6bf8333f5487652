/* SPDX-License-Identifier: MIT */
/* test_outline.c - the surface of fragments.
   SOURCE OF TRUTH: a closed, oriented surface has each edge as often one way as the other; the divergence theorem: what it encloses is the
   volume of the cells; rigid and affine motions carry it along; of boxes, cracks and holes the geometry is known. */
#include "pieces.h"

#define MOST 40000

typedef struct surface {
    int     dim;
    int64_t vertices, faces;
    double  vertex[3 * MOST];
    int32_t face[3 * MOST], owner[MOST], inner[MOST];
} surface;

static void get_surface(peri_body *b, int32_t fragment, surface *s) {
    s->dim = peri_dimension(b);
    MUST(b, peri_size_of_outline(b, fragment, &s->vertices, &s->faces));
    CHECK(s->vertices <= MOST && s->faces <= MOST);
    MUST(b, peri_get_outline(b, fragment, s->vertex, s->vertices, s->face, s->owner, s->inner, s->faces));
}

/* Normal times area of a face, outwards: of an edge with the body on its left the edge turned to the right. */
static void area_of(const surface *s, int64_t k, double *area) {
    const double *p = &s->vertex[s->face[k * s->dim] * s->dim], *q = &s->vertex[s->face[k * s->dim + 1] * s->dim];
    if (s->dim == 2) {
        area[0] = q[1] - p[1], area[1] = p[0] - q[0], area[2] = 0;
        return;
    }
    const double *r = &s->vertex[s->face[k * 3 + 2] * 3];
    for (int d = 0; d < 3; ++d) {
        const int e = (d + 1) % 3, f = (d + 2) % 3;
        area[d] = 0.5 * ((q[e] - p[e]) * (r[f] - p[f]) - (q[f] - p[f]) * (r[e] - p[e]));
    }
}

/* By the divergence of x/dim; of faces with `inner` the flag (2: all) the area to *size. */
static double enclosed(const surface *s, int inner, double *size) {
    double volume = 0, sum = 0;
    for (int64_t k = 0; k < s->faces; ++k) {
        const double *p = &s->vertex[s->face[k * s->dim] * s->dim];
        double area[3];
        area_of(s, k, area);
        for (int d = 0; d < s->dim; ++d) volume += p[d] * area[d] / s->dim;
        if (inner == 2 || s->inner[k] == inner) sum += sqrt(area[0] * area[0] + area[1] * area[1] + area[2] * area[2]);
    }
    if (size) *size = sum;
    return volume;
}

typedef struct side {
    int32_t low, high, way;
} side;
static int by_ends(const void *p, const void *q) {
    const side *a = (const side *)p, *b = (const side *)q;
    return a->low != b->low ? (a->low < b->low ? -1 : 1) : a->high != b->high ? (a->high < b->high ? -1 : 1) : 0;
}

/* Each edge (in 2D each vertex) as often one way as the other. */
static void is_closed(const surface *s) {
    static side edges[3 * MOST];
    const int64_t count = s->faces * s->dim;
    for (int64_t k = 0; k < count; ++k) {
        const int32_t a = s->face[k], b = s->face[k % s->dim == s->dim - 1 ? k - s->dim + 1 : k + 1];
        CHECK(a >= 0 && a < s->vertices);
        edges[k].low = s->dim == 2 || a < b ? a : b;
        edges[k].high = s->dim == 2 ? 0 : a < b ? b : a;
        edges[k].way = s->dim == 2 ? (k % 2 ? 1 : -1) : a < b ? 1 : -1;
        CHECK(s->dim == 2 || a != b);
    }
    qsort(edges, (size_t)count, sizeof *edges, by_ends);
    for (int64_t k = 0, end; k < count; k = end) {
        int32_t way = 0;
        for (end = k; end < count && by_ends(&edges[k], &edges[end]) == 0; ++end) way += edges[end].way;
        CHECK(way == 0);
        CHECK(s->dim == 3 || end == k + 2);
    }
}

/* In 2D face k begins at vertex k, and goes to the next one or back to the first of its loop. Returns how many loops there are, and how
   many go clockwise. */
static int loops_of(const surface *s, int *clockwise) {
    int loops = 0;
    *clockwise = 0;
    for (int64_t k = 0, first = 0; k < s->faces; ++k) {
        CHECK(s->face[2 * k] == k && (s->face[2 * k + 1] == k + 1 || s->face[2 * k + 1] == first));
        if (s->face[2 * k + 1] == k + 1) continue;
        double twice = 0;
        for (int64_t e = first; e <= k; ++e) {
            const double *p = &s->vertex[2 * s->face[2 * e]], *q = &s->vertex[2 * s->face[2 * e + 1]];
            twice += p[0] * q[1] - p[1] * q[0];
        }
        loops++;
        *clockwise += twice < 0;
        first = k + 1;
    }
    return loops;
}

static surface one, all;

/* ---- random scenes ------------------------------------------------------------------------------------------------- */

static void one_scene(int origin, int dim) {
    static int32_t of[2000];
    double sum = 0, cells = 0;
    int64_t faces = 0;
    peri_body *b = random_scene(origin, dim);
    for (int cut = 0; cut < 3; ++cut) break_some(b);
    const int64_t n = peri_point_count(b), count = MUST(b, peri_find_fragments(b, of, n));
    double *volume = field(b, PERI_FIELD_VOLUME);
    get_surface(b, -1, &all);
    is_closed(&all);
    for (int32_t f = 0; f < count && f < 30; ++f) {
        double own = 0;
        for (int64_t i = 0; i < n; ++i) own += of[i] == f ? volume[i] : 0;
        get_surface(b, f, &one);
        is_closed(&one);
        for (int64_t k = 0; k < one.faces; ++k) CHECK(of[one.owner[k]] == f);
        if (origin != PERTURBED || dim == 2) CHECK_NEAR(enclosed(&one, 2, NULL), own, 1e-9, 0); /* else cells have curved sides */
        faces += one.faces;
    }
    for (int64_t i = 0; i < n; ++i) cells += volume[i];
    sum = enclosed(&all, 2, NULL);
    CHECK_NEAR(sum, cells, 1e-9, 0); /* curved ones, too: both sides of a crack are cut into the same triangles */
    CHECK(count > 30 || faces == all.faces);
    if (dim == 2) (void)loops_of(&all, &(int){0});
    move_about(b); /* torn about, it stays closed */
    get_surface(b, -1, &one);
    is_closed(&one);
    CHECK(one.faces == all.faces && memcmp(one.face, all.face, (size_t)(all.faces * dim) * sizeof *all.face) == 0);
    free(volume);
    peri_body_destroy(b);
}

static void closed_oriented_and_of_the_right_volume(void) {
    for (int scene = 0; scene < (test_long ? 200 : 20); ++scene) {
        dice = 50000 + (uint64_t)scene;
        one_scene(scene % SOURCES, 2 + scene / SOURCES % 2);
        if (test_bad) {
            printf("    scene %d\n", scene);
            return;
        }
    }
}

/* ---- known shapes -------------------------------------------------------------------------------------------------- */

static int32_t not_the_middle(void *user, int64_t index, const double *x) {
    (void)user, (void)index;
    return !(x[0] > 3 && x[0] < 5 && x[1] > 2 && x[1] < 4);
}

/* A plate of 8 x 6 cells with a hole of 2 x 2, a crack of 2 cells that ends within, then a piece of 3 x 2 off a corner. */
static void loops_holes_and_cracks(void) {
    const double lo[2] = {0, 0}, hi[2] = {8, 6}, from[2] = {5.5, 5}, to[2] = {7.4, 5}, v[6] = {-1, 2, 3, 2, 3, -1};
    double edge = 0;
    int clockwise = 0;
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 1.1, 8, 6, 1);
    peri_body *b = specimen_start(&s);
    MUST(b, peri_add_shape(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo, hi, 1, not_the_middle, NULL));
    MUST(b, peri_build(b));
    get_surface(b, -1, &all);
    CHECK(loops_of(&all, &clockwise) == 2 && clockwise == 1 && all.faces == 28 + 8);
    CHECK_NEAR(enclosed(&all, 1, &edge), 44, 1e-12, 0);
    CHECK(edge == 0); /* no crack yet */
    CHECK(MUST(b, peri_cut_segment(b, PERI_CUT_NOW, from, to)) == 2);
    get_surface(b, 0, &all);
    CHECK(loops_of(&all, &clockwise) == 3 && all.faces == 28 + 8 + 4); /* both faces of two cells */
    CHECK_NEAR(enclosed(&all, 1, &edge), 44, 1e-12, 0);
    CHECK_NEAR(edge, 4, 1e-12, 0);
    CHECK(MUST(b, peri_cut_polyline(b, PERI_CUT_NOW, 3, v)) == 5 && MUST(b, peri_find_fragments(b, NULL, 0)) == 2);
    get_surface(b, 1, &one);
    CHECK(loops_of(&one, &clockwise) == 1 && clockwise == 0 && one.faces == 10);
    CHECK_NEAR(enclosed(&one, 0, &edge), 6, 1e-12, 0);
    CHECK_NEAR(edge, 5, 1e-12, 0);
    CHECK_NEAR(enclosed(&one, 1, &edge), 6, 1e-12, 0);
    CHECK_NEAR(edge, 5, 1e-12, 0);
    get_surface(b, 0, &all);
    CHECK_NEAR(enclosed(&all, 0, &edge), 38, 1e-12, 0);
    CHECK_NEAR(edge, 28 + 8 - 5, 1e-12, 0);
    peri_body_destroy(b);
}

/* Clouds: a square or cube of its volume to each point. */
static void points_are_squares_and_cubes(void) {
    for (int dim = 2; dim <= 3; ++dim) {
        const double x[9] = {0, 0, 0.1, 1, 0.2, 0.3, 2, 0, 0.5}, v[3] = {0.5, 1.5, 1};
        double size = 0, want = 0;
        specimen s = specimen_of(dim == 2 ? PERI_SPACE_PLANE_STRESS : PERI_SPACE_SOLID, PERI_LAW_BOND_BASED, 0, 1, 3, 1, 1, 1);
        peri_body *b = specimen_start(&s);
        MUST(b, peri_add_points(b, 3, x, v, NULL));
        MUST(b, peri_build(b));
        get_surface(b, -1, &all);
        CHECK(all.faces == 3 * (dim == 2 ? 4 : 12) && all.vertices == 3 * (dim == 2 ? 4 : 8));
        CHECK_NEAR(enclosed(&all, 0, &size), 3, 1e-12, 0);
        for (int k = 0; k < 3; ++k) want += 2 * dim * pow(v[k], (dim - 1.0) / dim);
        CHECK_NEAR(size, want, 1e-12, 0);
        peri_body_destroy(b);
    }
}

/* Neighbours on the lattice that never had a bond are apart where they are in different fragments: two rows of four cells, 1 wide and 1.245
   high, with a horizon of 1.2. */
static void neighbours_without_a_bond(void) {
    double size = 0;
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 1.2, 4, 2, 1);
    s.hi[1] = 2.49;
    peri_body *b = specimen_make(&s);
    CHECK(peri_bond_count(b) == 6 && MUST(b, peri_find_fragments(b, NULL, 0)) == 2);
    get_surface(b, 1, &one);
    CHECK(one.faces == 10);
    CHECK_NEAR(enclosed(&one, 1, &size), 4 * 1.245, 1e-12, 0);
    CHECK_NEAR(size, 4, 1e-12, 0);
    peri_body_destroy(b);
}

/* Cells of two calls are apart, and of one fragment all the same: two squares of 3 x 3 that share a side have 12 edges each. */
static void boxes_side_by_side(void) {
    const double lo[2] = {3, 0}, hi[2] = {6, 3};
    double size = 0;
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 2.1, 3, 3, 1);
    peri_body *b = specimen_start(&s);
    MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), s.lo, s.hi, 1));
    MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo, hi, 1));
    MUST(b, peri_build(b));
    CHECK(MUST(b, peri_find_fragments(b, NULL, 0)) == 1);
    get_surface(b, 0, &all);
    CHECK(all.faces == 24);
    CHECK_NEAR(enclosed(&all, 0, &size), 18, 1e-12, 0);
    CHECK_NEAR(size, 24, 1e-12, 0);
    peri_body_destroy(b);
}

/* ---- motions ------------------------------------------------------------------------------------------------------- */

/* Displaces all points by (F - 1) x + c, and says where the vertices of `from` come to. */
static void carry(peri_body *b, double f[3][3], const double *c, const surface *from, double *to) {
    const int dim = peri_dimension(b);
    double *x = field(b, PERI_FIELD_POSITION);
    for (int64_t i = 0; i < peri_point_count(b); ++i) {
        double u[3] = {0, 0, 0};
        for (int d = 0; d < dim; ++d) {
            u[d] = c[d] - x[i * dim + d];
            for (int e = 0; e < dim; ++e) u[d] += f[d][e] * x[i * dim + e];
        }
        for (int d = 0; d < dim; ++d) x[i * dim + d] = u[d];
    }
    MUST(b, peri_set_field(b, PERI_FIELD_DISPLACEMENT, x, peri_size_of_field(b, PERI_FIELD_DISPLACEMENT)));
    for (int64_t k = 0; k < from->vertices; ++k)
        for (int d = 0; d < dim; ++d) {
            to[k * dim + d] = c[d];
            for (int e = 0; e < dim; ++e) to[k * dim + d] += f[d][e] * from->vertex[k * dim + e];
        }
    free(x);
}

static void turn(double f[3][3], int axis, double angle) { /* in 2D axis 2 */
    const int d = (axis + 1) % 3, e = (axis + 2) % 3;
    memset(f, 0, 9 * sizeof f[0][0]);
    f[axis][axis] = 1;
    f[d][d] = f[e][e] = cos(angle);
    f[e][d] = sin(angle);
    f[d][e] = -sin(angle);
}

static void arrives(peri_body *b, double f[3][3]) {
    static double to[3 * MOST];
    const double c[3] = {3, -2, 1};
    MUST(b, peri_reset(b));
    get_surface(b, -1, &one);
    carry(b, f, c, &one, to);
    get_surface(b, -1, &all);
    CHECK(all.vertices == one.vertices);
    for (int64_t k = 0; k < all.vertices * all.dim; ++k) CHECK_NEAR(all.vertex[k], to[k], 0, 1e-12);
}

/* Affine motions of whole lattices are exact; turns even where a body is one cell thin: a strip in 2D by any angle, in 3D a sheet by any,
   and a rod by a turn about an axis perpendicular to it, half a turn too. */
static void motions_carry_it_along(void) {
    double f[3][3] = {{1.2, 0.3, -0.1}, {-0.2, 0.9, 0.4}, {0.1, 0.2, 1.1}};
    static const struct {
        int dim, nx, ny, nz;
    } box[8] = {{2, 5, 4, 1}, {3, 4, 3, 2}, {2, 6, 1, 1}, {2, 1, 5, 1}, {3, 4, 3, 1}, {3, 1, 3, 4}, {3, 5, 1, 1}, {3, 1, 1, 4}};
    for (int k = 0; k < 8; ++k) {
        specimen s = specimen_of(box[k].dim == 2 ? PERI_SPACE_PLANE_STRESS : PERI_SPACE_SOLID, PERI_LAW_BOND_BASED, 0, 1, 1.1, box[k].nx,
                                 box[k].ny, box[k].nz);
        peri_body *b = specimen_make(&s);
        double r[3][3];
        if (k < 2) arrives(b, f);
        for (int angle = 1; angle <= 4; ++angle) {
            const int axis = box[k].dim == 2 ? 2 : k < 6 ? angle % 3 : k == 6 ? 1 + angle % 2 : angle % 2;
            turn(r, axis, angle == 4 ? PI : 0.7 * angle);
            if (k < 6 || angle < 4) arrives(b, r);
        }
        if (k >= 6) { /* half a turn of a rod: about some axis perpendicular to it, so its square section arrives */
            const double c[3] = {0, 0, 0};
            static double to[3 * MOST];
            double size = 0;
            MUST(b, peri_reset(b));
            get_surface(b, -1, &one);
            turn(r, k == 6 ? 1 : 0, PI);
            carry(b, r, c, &one, to);
            get_surface(b, -1, &all);
            is_closed(&all);
            CHECK_NEAR(enclosed(&all, 2, &size), k == 6 ? 5 : 4, 1e-9, 0);
            CHECK_NEAR(size, k == 6 ? 22 : 18, 1e-9, 0);
        }
        peri_body_destroy(b);
    }
}

/* ---- refusals ------------------------------------------------------------------------------------------------------ */

static void refused_with_the_value(void) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 1.1, 3, 2, 1);
    peri_body *b = specimen_make(&s);
    peri_error e;
    int64_t vertices = 0, faces = 0;
    double vertex[20];
    int32_t face[20];
    MUST(b, peri_size_of_outline(b, 0, &vertices, &faces));
    CHECK(vertices == 10 && faces == 10);
    CHECK(peri_size_of_outline(b, 1, &vertices, &faces) == PERI_ERROR_RANGE && peri_size_of_outline(b, -2, &vertices, &faces) < 0);
    CHECK(peri_get_outline(b, 0, vertex, 9, face, NULL, NULL, 10) == PERI_ERROR_CAPACITY);
    CHECK(peri_get_error(b, &e) == PERI_OK && e.value == 10 && strcmp(e.field, "vertex_capacity") == 0);
    CHECK(peri_get_outline(b, 0, vertex, 10, face, NULL, NULL, 9) == PERI_ERROR_CAPACITY);
    CHECK(peri_get_error(b, &e) == PERI_OK && e.value == 10 && strcmp(e.field, "face_capacity") == 0);
    MUST(b, peri_get_outline(b, 0, vertex, 10, face, NULL, NULL, 10));
    peri_body_destroy(b);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(closed_oriented_and_of_the_right_volume);
    RUN(loops_holes_and_cracks);
    RUN(points_are_squares_and_cubes);
    RUN(neighbours_without_a_bond);
    RUN(boxes_side_by_side);
    RUN(motions_carry_it_along);
    RUN(refused_with_the_value);
    return test_end("test_outline");
}
