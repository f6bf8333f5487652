/* SPDX-License-Identifier: MIT */
/* Cracks as paths, tips and sides: where cuts of known shape are found, how long, and how fast they grow. */
#include "pool.h"
#include "scene.h"

typedef struct found {
    int64_t paths, vertices, tips;
    double  size;
    int64_t start[4096];
    double  vertex[3 * 16384], time[16384];
    peri_crack_tip tip[64];
} found;
static found f;

/* Spurs: 0 keeps all, NaN those of a horizon or more. */
static void find(peri_body *b, double shortest, int32_t initial, int32_t current) {
    peri_cracks_desc d;
    peri_cracks *c = NULL;
    peri_cracks_desc_init(&d);
    d.shortest = shortest;
    d.initial = initial;
    d.current = current;
    memset(&f, 0, sizeof f);
    if (MUST(b, peri_cracks_create(b, &d, &c)) < 0) return;
    f.paths = peri_cracks_paths(c);
    f.vertices = peri_cracks_vertices(c);
    f.tips = peri_cracks_tips(c);
    f.size = peri_cracks_size(c);
    CHECK(f.paths < 4096 && f.vertices <= 16384 && f.tips <= 64);
    if (f.paths < 4096 && f.vertices <= 16384 && f.tips <= 64) CHECK(peri_get_cracks(c, f.start, f.vertex, f.time, f.tip) == PERI_OK);
    CHECK(f.start[0] == 0 && f.start[f.paths] == f.vertices);
    peri_cracks_destroy(c);
}

/* A plate of n x n cells of size 1; scatter: a cloud; turn: by that angle about the origin. */
static double turned_by;
static void turn(double x, double y, double *out) {
    out[0] = cos(turned_by) * x - sin(turned_by) * y;
    out[1] = sin(turned_by) * x + cos(turned_by) * y;
}

static peri_body *plate(int n, double scatter, double turned) {
    static double x[2 * 10000], v[10000];
    uint64_t seed = 7;
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 3.015, n, n, 1);
    s.material.critical_stretch = 0.01;
    turned_by = turned;
    if (scatter == 0 && turned == 0) return specimen_make(&s);
    peri_body *b = specimen_start(&s);
    for (int k = 0; k < n * n; ++k) {
        const double a = k % n + 0.5 + scatter * (test_random(&seed) - 0.5), c = k / n + 0.5 + scatter * (test_random(&seed) - 0.5);
        turn(a, c, &x[2 * k]);
        v[k] = 1;
    }
    (void)MUST(b, peri_add_points(b, n * n, x, v, NULL));
    (void)MUST(b, peri_build(b));
    return b;
}

static void cut(peri_body *b, int32_t standing, double x0, double y0, double x1, double y1) {
    double p[2], q[2];
    turn(x0, y0, p);
    turn(x1, y1, q);
    (void)MUST(b, peri_cut_segment(b, standing, p, q));
}

static double apart2(const double *p, double x, double y) {
    double q[2];
    turn(x, y, q);
    return hypot(p[0] - q[0], p[1] - q[1]);
}

/* How far the vertices lie from the segment, at most. */
static double off_segment(double x0, double y0, double x1, double y1) {
    double p[2], q[2], most = 0;
    turn(x0, y0, p);
    turn(x1, y1, q);
    for (int64_t n = 0; n < f.vertices; ++n) {
        const double along[2] = {q[0] - p[0], q[1] - p[1]}, at[2] = {f.vertex[2 * n] - p[0], f.vertex[2 * n + 1] - p[1]};
        const double t = fmin(1, fmax(0, (at[0] * along[0] + at[1] * along[1]) / (along[0] * along[0] + along[1] * along[1])));
        most = fmax(most, hypot(at[0] - t * along[0], at[1] - t * along[1]));
    }
    return most;
}

/* Truth: the cut itself; its ends are known to a cell each way. */
static void straight_cuts(void) {
    for (int kind = 0; kind < 4; ++kind)
        for (double angle = 0; angle < 91; angle += kind ? 15 : 7.5) {
            const double a = angle * PI / 180, dx = 10 * cos(a), dy = 10 * sin(a);
            const double x0 = 20.1 - dx, y0 = 19.9 - dy, x1 = 20.1 + dx, y1 = 19.9 + dy;
            peri_body *b = plate(40, kind % 2 ? 0.4 : 0, kind / 2 ? 0.3 : 0);
            cut(b, PERI_CUT_INITIAL, x0, y0, x1, y1);
            find(b, NAN, 1, 0);
            CHECK(f.paths == 1 && f.tips == 2);
            CHECK_NEAR(f.size, 20, 0, kind % 2 ? 1.2 : 1);
            CHECK(off_segment(x0, y0, x1, y1) < 0.75);
            const int first = apart2(f.tip[0].place, x0, y0) > apart2(f.tip[0].place, x1, y1);
            CHECK(apart2(f.tip[first].place, x0, y0) < 1 && apart2(f.tip[1 - first].place, x1, y1) < 1);
            for (int k = 0; k < 2; ++k) {
                double way[2];
                turn(k == first ? -cos(a) : cos(a), k == first ? -sin(a) : sin(a), way);
                CHECK(f.tip[k].direction[0] * way[0] + f.tip[k].direction[1] * way[1] > 0.93 && f.tip[k].direction[2] == 0);
                CHECK_NEAR(hypot(f.tip[k].direction[0], f.tip[k].direction[1]), 1, 1e-12, 0);
                CHECK(isnan(f.tip[k].speed) && f.tip[k].path == 0);
            }
            find(b, NAN, 0, 0);
            CHECK(f.paths == 0 && f.size == 0);
            peri_body_destroy(b);
        }
}

/* However long a cut, of steps that a cut of 20 spacings does not show. */
static void long_cuts(void) {
    for (int k = 0; k < 4; ++k) {
        const double a = (k % 2 ? 14.8 : 3.7) * PI / 180;
        specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 1.5, 170, 50, 1);
        s.scatter = k / 2 ? 0.9 : 0;
        peri_body *b = specimen_make(&s);
        turned_by = 0;
        cut(b, PERI_CUT_INITIAL, 5, 5.3, 5 + 160 * cos(a), 5.3 + 160 * sin(a));
        find(b, NAN, 1, 0);
        CHECK(f.paths == 1 && f.tips == 2);
        CHECK_NEAR(f.size, 160, k / 2 ? 0.015 : 0.01, 0);
        peri_body_destroy(b);
    }
}

/* Truth: the length of the arc. */
static void arcs(void) {
    for (int k = 0; k < 6; ++k) {
        const double radius = 10 + k, wide = 0.8 + 0.35 * k;
        double vertices[2 * 41];
        peri_body *b = plate(40, k % 2 ? 0.3 : 0, 0);
        for (int n = 0; n <= 40; ++n) {
            vertices[2 * n] = 20.03 + radius * cos(0.3 + wide * n / 40);
            vertices[2 * n + 1] = 12.02 + radius * sin(0.3 + wide * n / 40);
        }
        (void)MUST(b, peri_cut_polyline(b, PERI_CUT_INITIAL, 41, vertices));
        find(b, NAN, 1, 0);
        CHECK(f.paths == 1 && f.tips == 2);
        CHECK_NEAR(f.size, radius * wide, 0, 1.2);
        for (int64_t n = 0; n < f.vertices; ++n) CHECK_NEAR(hypot(f.vertex[2 * n] - 20.03, f.vertex[2 * n + 1] - 12.02), radius, 0, 0.75);
        peri_body_destroy(b);
    }
}

/* Cracks end at surfaces and holes, not at tips. On the lattice a straight one is as long as the sides that it runs along. */
static int32_t no_hole(void *user, int64_t index, const double *x) {
    (void)user, (void)index;
    return hypot(x[0] - 20, x[1] - 20) > 3;
}
static void surfaces_and_holes(void) {
    peri_body *b = plate(20, 0, 0);
    cut(b, PERI_CUT_INITIAL, -1, 10, 7.5, 10);
    find(b, NAN, 1, 0);
    CHECK(f.paths == 1 && f.tips == 1 && f.vertices == 10); /* 8 sides and both ends */
    CHECK_NEAR(f.size, 8, 1e-12, 0);
    CHECK_NEAR(fmin(f.vertex[0], f.vertex[2 * 9]), 0, 0, 1e-12);
    CHECK_NEAR(f.tip[0].place[0], 8, 1e-12, 0);
    CHECK_NEAR(f.tip[0].place[1], 10, 1e-12, 0);
    CHECK_NEAR(f.tip[0].direction[0], 1, 1e-12, 0);
    cut(b, PERI_CUT_INITIAL, 7, 10, 21, 10);
    find(b, NAN, 1, 0);
    CHECK(f.paths == 1 && f.tips == 0);
    CHECK_NEAR(f.size, 20, 1e-12, 0);
    cut(b, PERI_CUT_INITIAL, 12, 2, 12, 4.3); /* shorter than the horizon */
    find(b, NAN, 1, 0);
    CHECK(f.paths == 1);
    find(b, 0, 1, 0);
    CHECK(f.paths == 2 && f.tips == 2);
    CHECK_NEAR(f.size, 22, 0, 1);
    peri_body_destroy(b);
    for (int through = 0; through < 2; ++through) {
        specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 3.015, 40, 40, 1);
        b = specimen_start(&s);
        (void)MUST(b, peri_add_shape(b, peri_id(b, PERI_KIND_MATERIAL, 1), s.lo, s.hi, 1, no_hole, NULL));
        (void)MUST(b, peri_build(b));
        turned_by = 0;
        cut(b, PERI_CUT_INITIAL, 20, 20, through ? 41 : 32.5, 20);
        find(b, NAN, 1, 0);
        CHECK(f.paths == 1 && f.tips == 1 - through);
        CHECK_NEAR(f.size, through ? 17 : 9.5, 0, 1);
        peri_body_destroy(b);
    }
}

/* A crack that branches has three tips, wherever its arms point; a spur shorter than the horizon is none of them. */
static void branches(void) {
    for (int k = 0; k < 6; ++k) {
        peri_body *b = plate(40, k % 2 ? 0.3 : 0, k > 3 ? 0.4 : 0);
        const double a = 0.4 + 0.1 * k;
        cut(b, PERI_CUT_INITIAL, 8, 20.02, 20, 20.02);
        cut(b, PERI_CUT_INITIAL, 20, 20.02, 20 + 12 * cos(a), 20.02 + 12 * sin(a));
        cut(b, PERI_CUT_INITIAL, 20, 20.02, 20 + 12 * cos(a), 20.02 - 12 * sin(a));
        find(b, NAN, 1, 0);
        CHECK(f.tips == 3 && f.paths == 3);
        CHECK_NEAR(f.size, 36, 0, 3);
        cut(b, PERI_CUT_INITIAL, 13, 20, 13, 21.7);
        find(b, NAN, 1, 0);
        CHECK(f.tips == 3 && f.paths == 3);
        find(b, 0, 1, 0);
        CHECK(f.tips == 4 && f.paths == 5);
        peri_body_destroy(b);
    }
    peri_body *b = plate(20, 0, 0); /* around a block of cells */
    const double square[10] = {5, 5, 14, 5, 14, 14, 5, 14, 5, 5};
    (void)MUST(b, peri_record_breaks(b, 1));
    (void)MUST(b, peri_cut_polyline(b, PERI_CUT_NOW, 5, square));
    find(b, NAN, 1, 0);
    for (int64_t n = 0; n < f.vertices; ++n) CHECK(f.time[n] == 0);
    CHECK(f.paths == 1 && f.tips == 0 && f.vertices == 4 * 9 + 1);
    CHECK(f.vertex[0] == f.vertex[2 * 36] && f.vertex[1] == f.vertex[2 * 36 + 1]);
    CHECK_NEAR(f.size, 36, 0.1, 0); /* corners are cut short */
    peri_body_destroy(b);
}

/* The same in the deformed body: a path goes with the points on both its sides. */
static void in_the_present_configuration(void) {
    peri_body *b = plate(20, 0, 0);
    double *x = get(b, PERI_FIELD_POSITION), *u = (double *)calloc(800, sizeof *u);
    static found before;
    cut(b, PERI_CUT_INITIAL, 5, 10, 15, 10);
    find(b, NAN, 1, 0);
    before = f;
    for (int k = 0; k < 400; ++k) {
        u[2 * k] = 3;
        u[2 * k + 1] = x[2 * k + 1] > 10 ? 0.5 : -0.5; /* opens */
    }
    put(b, PERI_FIELD_DISPLACEMENT, u);
    find(b, NAN, 1, 0);
    CHECK(f.vertices == before.vertices && memcmp(f.vertex, before.vertex, sizeof f.vertex) == 0);
    find(b, NAN, 1, 1);
    CHECK(f.vertices == before.vertices);
    for (int64_t n = 0; n < f.vertices; ++n) {
        CHECK_NEAR(f.vertex[2 * n], before.vertex[2 * n] + 3, 1e-12, 0);
        CHECK_NEAR(f.vertex[2 * n + 1], before.vertex[2 * n + 1], 1e-12, 0);
    }
    free(x);
    free(u);
    peri_body_destroy(b);
}

/* ---- when ------------------------------------------------------------------------------------------------------------ */

/* Truth: a cut that is moved on by a cell every third step has the speed of a cell in three steps. */
static void speed_of_an_advancing_cut(void) {
    peri_body *b = plate(30, 0, 0), *copy = NULL;
    const double dt = 0.1 * peri_stable_step(b);
    static found whole;
    (void)MUST(b, peri_record_breaks(b, 1));
    cut(b, PERI_CUT_INITIAL, -1, 15, 4.5, 15);
    for (int n = 5; n < 20; ++n) {
        cut(b, PERI_CUT_NOW, n - 0.9, 15, n + 0.5, 15);
        (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 3, dt, 0);
    }
    find(b, NAN, 1, 0);
    CHECK(f.paths == 1 && f.tips == 1 && f.vertices == 20 + 2);
    CHECK_NEAR(f.tip[0].speed, 1 / (3 * dt), 0.05, 0);
    const int back = f.vertex[0] > 10;
    for (int n = 0; n < 22; ++n) {
        const int64_t at = back ? 21 - n : n;
        if (n < 6) CHECK(isnan(f.time[at])); /* the initial crack, and the end at the surface */
        else CHECK_NEAR(f.time[at], 3 * dt * (n < 20 ? n - 6 : 14), 1e-12, 1e-12 * dt);
    }
    whole = f;
    (void)MUST(b, peri_body_clone(b, &copy, NULL));
    (void)MUST(b, peri_reset(b));
    find(copy, NAN, 1, 0);
    CHECK(f.vertices == whole.vertices && memcmp(f.vertex, whole.vertex, sizeof f.vertex) == 0 && f.tip[0].speed == whole.tip[0].speed);
    (void)MUST(copy, peri_record_breaks(copy, 0));
    find(copy, NAN, 1, 0);
    CHECK(f.vertices == 22 && isnan(f.tip[0].speed));
    for (int n = 0; n < 22; ++n) CHECK(isnan(f.time[n]));
    (void)MUST(copy, peri_record_breaks(copy, 1)); /* what is broken by then has no time */
    cut(copy, PERI_CUT_NOW, 19.4, 15, 20.5, 15);
    find(copy, NAN, 1, 0);
    int known = 0;
    for (int n = 0; n < f.vertices; ++n) known += !isnan(f.time[n]);
    CHECK(f.vertices == 23 && known == 2);
    find(b, NAN, 1, 0);
    CHECK(f.vertices == 7 && isnan(f.time[0]) && isnan(f.time[6])); /* only the initial crack is left */
    cut(b, PERI_CUT_NOW, 4.1, 15, 5.5, 15);
    find(b, NAN, 1, 0);
    CHECK(f.vertices == 8 && f.time[f.vertex[0] > 3 ? 1 : 6] == 0);
    peri_body_destroy(copy);
    peri_body_destroy(b);
}

typedef struct events {
    int    n, count;
    double last, sum;
} events;
static int32_t count_neighbours(void *user, int32_t i, int32_t j, double time, double stretch) {
    events *e = (events *)user;
    (void)stretch;
    if (j - i != e->n && !(j - i == 1 && j % e->n)) return 0;
    e->count++;
    e->sum += time;
    e->last = time;
    return 0;
}

/* Truth: what peri_on_break says of the bonds between neighbours: how many, and when; in motion and at rest. */
static void times_are_those_of_break_events(void) {
    for (int still = 0; still < 2; ++still)
        for (int32_t law = PERI_LAW_BOND_BASED; law <= PERI_LAW_LPS; ++law) {
            const int n = 16;
            specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, law, 0.3, 1, 3.015, n, n, 1);
            events e = {n, 0, 0, 0};
            s.material.critical_stretch = 0.01;
            peri_body *b = specimen_make(&s);
            turned_by = 0;
            cut(b, PERI_CUT_INITIAL, -1, 8, 5.2, 8);
            (void)MUST(b, peri_record_breaks(b, 1));
            (void)MUST(b, peri_on_break(b, count_neighbours, &e));
            const double lo[2] = {-1, -1}, hi[2] = {20, 2.1}, lo2[2] = {-1, 13.9}, hi2[2] = {20, 20};
            const double up[2] = {0, still ? 0.17 : 0.02}, none[2] = {0, 0};
            const int32_t top = (int32_t)MUST(b, peri_select_box(b, NULL, lo2, hi2));
            const int32_t bottom = (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi));
            if (still) {
                peri_solve_desc d;
                peri_solve_desc_init(&d);
                d.steps = 4;
                d.tolerance = 1e-4;
                d.loose = PERI_LOOSE_BALANCED;
                (void)MUST(b, peri_prescribe_displacement(b, bottom, PERI_AXIS_XY, none, NULL, NULL));
                (void)MUST(b, peri_prescribe_displacement(b, top, PERI_AXIS_XY, up, NULL, NULL));
                (void)peri_solve(b, &d, NULL);
            } else {
                (void)MUST(b, peri_prescribe_velocity(b, bottom, PERI_AXIS_XY, none, NULL, NULL));
                (void)MUST(b, peri_prescribe_velocity(b, top, PERI_AXIS_XY, up, NULL, NULL));
                (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 60, 0, 0);
            }
            CHECK(e.count > 3);
            find(b, 0, 0, 0);
            double sum = 0;
            int64_t sides = 0;
            for (int64_t p = 0; p < f.paths; ++p) {
                const double *first = &f.vertex[2 * f.start[p]], *end = &f.vertex[2 * f.start[p + 1] - 2];
                const int loop = first[0] == end[0] && first[1] == end[1];
                for (int64_t k = f.start[p] + !loop; k < f.start[p + 1] - 1; ++k, ++sides) sum += f.time[k];
            }
            CHECK(sides == e.count);
            CHECK_NEAR(sum, e.sum, 1e-9, 0);
            CHECK(!still || e.last <= 1);
            peri_body_destroy(b);
        }
}

/* ---- 3D -------------------------------------------------------------------------------------------------------------- */

static double area_of_triangles(void) {
    double sum = 0;
    for (int64_t p = 0; p < f.paths; ++p)
        for (int t = 1; t < 3; ++t) {
            const double *a = &f.vertex[12 * p], *q = a + 3 * t, *r = a + 3 * (t + 1);
            double c[3], u[3], v[3];
            for (int d = 0; d < 3; ++d) u[d] = q[d] - a[d], v[d] = r[d] - a[d];
            for (int d = 0; d < 3; ++d) c[d] = u[(d + 1) % 3] * v[(d + 2) % 3] - u[(d + 2) % 3] * v[(d + 1) % 3];
            sum += 0.5 * sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]);
        }
    return sum;
}

/* Truth: pi r^2; sides are whole, so that a rim of half a cell either way is not known. */
static void penny_shaped_cracks(void) {
    for (int k = 0; k < 6; ++k) {
        const double radius = 5.3, centre[3] = {9.02, 9.01, 9}, a = 0.2 * k, normal[3] = {sin(a), k % 2 ? 0.3 * sin(a) : 0, cos(a)};
        specimen s = specimen_of(PERI_SPACE_SOLID, PERI_LAW_BOND_BASED, 0, 1, 2.5, 18, 18, 18);
        s.scatter = k == 5 ? 0.5 : 0;
        peri_body *b = specimen_make(&s);
        (void)MUST(b, peri_cut_disc(b, PERI_CUT_INITIAL, centre, normal, radius));
        find(b, NAN, 1, 0);
        CHECK(f.tips == 0 && f.vertices == 4 * f.paths);
        CHECK_NEAR(f.size, PI * radius * radius, 0, PI * radius);
        CHECK_NEAR(f.size, PI * radius * radius, 0.12, 0);
        if (k == 0) CHECK_NEAR(area_of_triangles(), (double)f.paths, 1e-12, 0);
        if (k < 5) CHECK_NEAR(area_of_triangles(), (double)f.paths, 1e-9, 0); /* squares of a cell's side */
        const double size = sqrt(1 + (k % 2 ? 0.09 * sin(a) * sin(a) : 0));
        for (int64_t n = 0; n < f.paths; ++n) {
            double off = 0;
            for (int d = 0; d < 3; ++d)
                for (int v = 0; v < 4; ++v) off += normal[d] / size * 0.25 * (f.vertex[12 * n + 3 * v + d] - centre[d]);
            CHECK(fabs(off) < 0.75);
        }
        peri_body_destroy(b);
    }
}

/* A plane through a block: a side of a cell each, with the time of the cut. */
static void plane_through_a_block(void) {
    const double corner[3] = {-1, -1, 4}, along[3] = {12, 0, 0}, across[3] = {0, 10, 0};
    specimen s = specimen_of(PERI_SPACE_SOLID, PERI_LAW_LPS, 0.2, 0.5, 1.2, 10, 8, 16);
    peri_body *b = specimen_make(&s);
    (void)MUST(b, peri_record_breaks(b, 1));
    (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 2, 0, 0);
    (void)MUST(b, peri_cut_rectangle(b, PERI_CUT_NOW, corner, along, across));
    find(b, NAN, 0, 0);
    CHECK(f.paths == 80);
    CHECK_NEAR(f.size, 5 * 4, 1e-9, 0);
    for (int64_t n = 0; n < f.vertices; ++n) {
        CHECK_NEAR(f.vertex[3 * n + 2], 4, 1e-12, 0);
        CHECK(f.time[n] == peri_time(b) && f.time[n] > 0);
    }
    peri_body_destroy(b);
}

/* ---- whatever the kernel, the precision and the threads --------------------------------------------------------------- */

static void same_paths_from_all_kernels(void) {
    static found first;
    for (int k = 0; k < 5; ++k) {
        specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, 0.2, 1, 3.015, 30, 30, 1);
        s.desc.kernel = k == 1 ? PERI_KERNEL_LIST : k == 2 ? PERI_KERNEL_REFERENCE : PERI_KERNEL_BEST;
        s.desc.threads = k == 3 ? 3 : 1;
        s.desc.precision = k == 4 ? PERI_PRECISION_SINGLE : PERI_PRECISION_DOUBLE;
        peri_body *b = specimen_make(&s);
        turned_by = 0;
        cut(b, PERI_CUT_INITIAL, 5, 8, 22, 13);
        cut(b, PERI_CUT_INITIAL, 15, 10, 11, 25);
        find(b, NAN, 1, 0);
        if (k == 0) first = f;
        CHECK(f.paths == first.paths && f.tips == 3 && f.vertices == first.vertices);
        CHECK(memcmp(f.vertex, first.vertex, sizeof f.vertex) == 0);
        CHECK(memcmp(f.tip[0].place, first.tip[0].place, sizeof f.tip[0].place) == 0);
        peri_body_destroy(b);
    }
}

/* ---- files, memory ----------------------------------------------------------------------------------------------------- */

typedef struct text {
    char    byte[60000];
    int64_t used;
    int     left; /* writes that still succeed; negative: all */
} text;
static int32_t keep_text(void *user, const void *bytes, int64_t count) {
    text *t = (text *)user;
    if (t->left == 0) return 1;
    if (t->left > 0) t->left--;
    if (t->used + count >= (int64_t)sizeof t->byte) return 1;
    memcpy(t->byte + t->used, bytes, (size_t)count);
    t->used += count;
    t->byte[t->used] = 0;
    return 0;
}

static void files_for_paraview(void) {
    static text t;
    peri_cracks_desc d;
    peri_cracks *c = NULL;
    char head[128];
    peri_body *b = plate(20, 0, 0);
    cut(b, PERI_CUT_INITIAL, 5, 10, 15, 10);
    peri_cracks_desc_init(&d);
    (void)MUST(b, peri_cracks_create(b, &d, &c));
    peri_body_destroy(b); /* cracks outlive the body */
    t.left = -1;
    CHECK(peri_export_cracks_to(c, keep_text, &t) == PERI_OK);
    (void)snprintf(head, sizeof head, "<Piece NumberOfPoints=\"%d\" NumberOfLines=\"1\" NumberOfPolys=\"0\">",
                   (int)peri_cracks_vertices(c));
    CHECK(strstr(t.byte, head) != NULL && strstr(t.byte, "</VTKFile>") != NULL);
    const char *at = strchr(strstr(t.byte, "Name=\"vertex\""), '\n');
    double *x = (double *)calloc(2 * (size_t)peri_cracks_vertices(c), sizeof *x);
    CHECK(peri_get_cracks(c, NULL, x, NULL, NULL) == PERI_OK);
    for (int64_t n = 0; n < peri_cracks_vertices(c) && at; ++n) {
        char *end = NULL;
        for (int k = 0; k < 3; ++k, at = end) CHECK_NEAR(strtod(at, &end), k < 2 ? x[2 * n + k] : 0, 1e-14, 0);
    }
    free(x);
    for (int left = 0; left < 5; ++left) {
        t.left = left;
        t.used = 0;
        CHECK(peri_export_cracks_to(c, keep_text, &t) == PERI_ERROR_WRITE);
    }
    peri_cracks_destroy(c);
    CHECK(peri_export_cracks_to(NULL, keep_text, &t) == PERI_ERROR_ARGUMENT && peri_cracks_size(NULL) == 0);
    CHECK(peri_cracks_paths(NULL) == PERI_ERROR_ARGUMENT && peri_get_cracks(NULL, NULL, NULL, NULL, NULL) == PERI_ERROR_ARGUMENT);
    peri_cracks_destroy(NULL);
}

static pool lent;

/* Truth: what the allocator of the body lent. Whichever allocation fails, nothing is lost, and the next call succeeds. */
static void failing_allocations(void) {
    for (int solid = 0; solid < 2; ++solid) {
        const double centre[3] = {3, 3, 3}, up[3] = {0, 0, 1};
        specimen s = specimen_of(solid ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRAIN, PERI_LAW_BOND_BASED, 0, 1, 1.5, 6, 6, solid ? 6 : 1);
        peri_memory before, after;
        peri_cracks_desc d;
        peri_cracks *c = NULL;
        hook(&s.desc, &lent);
        memset(&lent, 0, sizeof lent);
        lent.fail_at = -1;
        peri_body *b = specimen_make(&s);
        turned_by = 0;
        if (solid) (void)MUST(b, peri_cut_disc(b, PERI_CUT_INITIAL, centre, up, 2));
        else cut(b, PERI_CUT_INITIAL, 1, 3, 5, 3.5);
        (void)MUST(b, peri_get_memory(b, &before));
        CHECK(before.total == lent.bytes);
        int32_t status = PERI_ERROR_MEMORY;
        for (int64_t n = 1; status == PERI_ERROR_MEMORY && n < 50; ++n) {
            lent.fail_at = lent.calls + n - 1;
            status = peri_record_breaks(b, 1);
            if (status < 0) CHECK(lent.bytes == before.total);
        }
        lent.fail_at = -1;
        (void)MUST(b, peri_record_breaks(b, 1));
        (void)MUST(b, peri_get_memory(b, &after));
        CHECK(after.total == lent.bytes && after.damage > before.damage && after.state == before.state);
        const int64_t recorded = lent.bytes;
        peri_cracks_desc_init(&d);
        d.shortest = 0;
        for (int64_t n = 1, made = PERI_ERROR_MEMORY; made == PERI_ERROR_MEMORY && n < 100; ++n) {
            lent.fail_at = lent.calls + n - 1;
            made = peri_cracks_create(b, &d, &c);
            if (made < 0) CHECK(lent.bytes == recorded && c == NULL);
        }
        CHECK(c != NULL && peri_cracks_paths(c) > 0 && lent.bytes > recorded);
        peri_cracks_destroy(c);
        CHECK(lent.bytes == recorded);
        (void)MUST(b, peri_record_breaks(b, 0));
        CHECK(lent.bytes == before.total);
        peri_body_destroy(b);
        CHECK(lent.bytes == 0);
    }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(straight_cuts);
    RUN(long_cuts);
    RUN(arcs);
    RUN(surfaces_and_holes);
    RUN(branches);
    RUN(in_the_present_configuration);
    RUN(speed_of_an_advancing_cut);
    RUN(times_are_those_of_break_events);
    RUN(penny_shaped_cracks);
    RUN(plane_through_a_block);
    RUN(same_paths_from_all_kernels);
    RUN(files_for_paraview);
    RUN(failing_allocations);
    return test_end("test_paths");
}
