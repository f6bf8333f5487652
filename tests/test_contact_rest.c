/* SPDX-License-Identifier: MIT */
/* test_contact_rest.c - contact at rest: equilibria of closed and open cracks, rubble; and what contact costs.

   SOURCE OF TRUTH: a closed crack carries what the whole block does (to the surfaces that its faces are), an open one nothing; relaxation
   and Newton's method find the same equilibrium; rubble loses its motion, and its pieces stay apart; the bars of cost are shares of a step
   without contact, measured side by side. */
#include "contact_scene.h"

/* ---- equilibria ----------------------------------------------------------------------------------------------------------------- */

typedef struct block {
    int     law, dim, precision, geometry, method, whole, n;
    double  stiffness, reach, strain;
    int32_t status;
    double  force;
    peri_energy energy;
} block;

/* A block of n x 2n cells, cut through in the middle unless `whole`, pressed (strain > 0) between two grips. */
static void press(block *s) {
    const int n = s->n;
    const double lo[3] = {0, 0, 0}, hi[3] = {n, 2.0 * n, 6}, from[2] = {-1, n}, to[2] = {n + 1.0, n};
    const double corner[3] = {-1, n, -1}, edge1[3] = {n + 2.0, 0, 0}, edge2[3] = {0, 0, 8};
    const double low[3] = {-1, -1, -1}, lows[3] = {n + 1.0, s->reach + 0.1, 9}, high[3] = {-1, 2.0 * n - s->reach - 0.1, -1};
    const double highs[3] = {n + 1.0, 2.0 * n + 1, 9}, way[3] = {0, -s->strain * 2 * n, 0};
    double force[3];
    peri_body_desc d;
    peri_material_desc m;
    peri_contact_desc c;
    peri_solve_desc solve;
    peri_body *b = NULL;
    peri_body_desc_init(&d);
    d.space = s->dim == 3 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRAIN;
    d.precision = s->precision;
    d.geometry = s->geometry;
    d.horizon = s->reach * 1.0001;
    (void)MUST(NULL, peri_body_create(&d, &b, NULL));
    peri_material_desc_init(&m, s->law);
    m.young = m.density = 1;
    if (s->law != PERI_LAW_BOND_BASED) m.poisson = 0.25;
    (void)MUST(b, peri_add_material(b, &m));
    (void)MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo, hi, 1));
    (void)MUST(b, peri_build(b));
    if (!s->whole && s->dim == 2) (void)MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, from, to));
    if (!s->whole && s->dim == 3) (void)MUST(b, peri_cut_rectangle(b, PERI_CUT_INITIAL, corner, edge1, edge2));
    peri_contact_desc_init(&c);
    c.stiffness = s->stiffness;
    if (s->stiffness > 0) (void)MUST(b, peri_set_contact(b, PERI_ALL, PERI_ALL, &c));
    const int32_t axes = s->dim == 2 ? PERI_AXIS_XY : PERI_AXIS_XYZ;
    (void)MUST(b, peri_prescribe_displacement(b, (int32_t)MUST(b, peri_select_box(b, NULL, low, lows)), axes, NULL, NULL, NULL));
    const int32_t grip = (int32_t)MUST(b, peri_select_box(b, NULL, high, highs));
    const int32_t load = (int32_t)MUST(b, peri_prescribe_displacement(b, grip, axes, way, NULL, NULL));
    peri_solve_desc_init(&solve);
    solve.method = s->method;
    s->status = peri_solve(b, &solve, NULL);
    (void)MUST(b, peri_get_reaction(b, load, force));
    (void)MUST(b, peri_get_energy(b, &s->energy));
    s->force = force[1];
    peri_body_destroy(b);
}

static block block_of(int law, int dim, double stiffness) {
    block s;
    memset(&s, 0, sizeof s);
    s.law = law;
    s.dim = dim;
    s.precision = PERI_PRECISION_DOUBLE;
    s.geometry = PERI_GEOMETRY_NONLINEAR;
    s.method = PERI_METHOD_NEWTON;
    s.n = dim == 3 ? 6 : 12;
    s.stiffness = stiffness;
    s.reach = dim == 3 ? 2 : 3;
    s.strain = 1e-3;
    return s;
}

static void check_closed(block cracked, double within) {
    block whole = cracked;
    whole.whole = 1;
    press(&whole);
    press(&cracked);
    CHECK(whole.status == PERI_OK && cracked.status == PERI_OK);
    CHECK_NEAR(cracked.force, whole.force, within, 0);
    CHECK(whole.energy.contact == 0 && cracked.energy.contact > 0);
    CHECK_NEAR(cracked.energy.error, 0, 0, 0.01 * cracked.energy.external);
    cracked.strain = -1e-3;
    press(&cracked);
    CHECK(cracked.status == PERI_OK);
    CHECK_NEAR(cracked.force, 0, 0, 1e-5 * fabs(whole.force));
    CHECK(cracked.energy.contact == 0);
}

/* Bond-based bodies are soft at surfaces, which the faces of a crack are: 20 cells on either side make that small. */
static void a_closed_crack_carries(void) {
    block s = block_of(PERI_LAW_BOND_BASED, 2, 8);
    s.n = 20;
    check_closed(s, 0.05);
    s = block_of(PERI_LAW_LPS, 2, 2);
    s.precision = PERI_PRECISION_SINGLE;
    check_closed(s, 0.05);
    s = block_of(PERI_LAW_CORRESPONDENCE, 2, 1);
    s.geometry = PERI_GEOMETRY_LINEAR;
    check_closed(s, 0.05);
    check_closed(block_of(PERI_LAW_BOND_BASED, 3, 4), 0.05);
}

static void methods_agree_of_a_closed_crack(void) {
    block newton = block_of(PERI_LAW_BOND_BASED, 2, 1), relaxed = newton;
    newton.n = relaxed.n = 8;
    relaxed.method = PERI_METHOD_RELAXATION;
    press(&newton);
    press(&relaxed);
    CHECK(newton.status == PERI_OK && relaxed.status == PERI_OK);
    CHECK_NEAR(relaxed.force, newton.force, 1e-6, 0);
    CHECK_NEAR(relaxed.energy.contact, newton.energy.contact, 1e-5, 0);
    newton.method = PERI_METHOD_BICGSTAB; /* the assembled matrix has no contact */
    press(&newton);
    CHECK(newton.status == PERI_ERROR_LAW);
}

/* A block that nothing but contact holds up is loose; and products with the stiffness do not know of contact. */
static void contact_is_no_support(void) {
    bars s = bars_of(2, 2, 4, 4);
    double in[64], with[64], without[64];
    const double way[2] = {-2.65e-3, 0};
    uint64_t seed = 5;
    s.speed = 0;
    peri_body *b = bars_make(&s);
    (void)MUST(b, peri_prescribe_displacement(b, (int32_t)MUST(b, peri_find_set(b, "first")), PERI_AXIS_XY, NULL, NULL, NULL));
    (void)MUST(b, peri_add_displacement(b, (int32_t)MUST(b, peri_find_set(b, "second")), way));
    for (int k = 0; k < 64; ++k) in[k] = test_random(&seed) - 0.5;
    (void)MUST(b, peri_multiply_stiffness(b, in, with, 64));
    peri_solve_desc solve;
    peri_solve_desc_init(&solve);
    CHECK(peri_solve(b, &solve, NULL) == PERI_ERROR_LOOSE);
    (void)MUST(b, peri_set_contact(b, PERI_ALL, PERI_ALL, NULL));
    (void)MUST(b, peri_multiply_stiffness(b, in, without, 64));
    CHECK(memcmp(with, without, sizeof with) == 0);
    peri_body_destroy(b);
}

/* ---- rubble --------------------------------------------------------------------------------------------------------------------- */

static int by_size(const void *a, const void *b) {
    const double p = *(const double *)a, q = *(const double *)b;
    return (p > q) - (p < q);
}

/* A block of wide x high cells falls into a trough of fixed points, and shatters. In the second half of the time it lies: the kinetic
   energy is mostly below `still` of its peak; what viscous friction lets creep may slip off a hump of its neighbours now and then. */
static void pile_up(int wide, int high, double young, double time, double still) {
    const double h = 0.01, w = (wide + 8) * h, lo[2] = {0, 0}, hi[2] = {wide * h, high * h}, pull[2] = {0, -2000 * 9.81}, v[2] = {0.5, -2};
    const double part[3][2][2] = {
        {{-8 * h, -6 * h}, {w, -4 * h}}, {{-10 * h, -6 * h}, {-8 * h, 60 * h}}, {{w, -6 * h}, {w + 2 * h, 60 * h}}};
    double peak = 0, least = 9, lying[20], *x;
    int near = 0;
    peri_body_desc d;
    peri_material_desc m;
    peri_contact_desc c;
    peri_advance_desc a;
    peri_energy e;
    peri_body *b = NULL;
    peri_body_desc_init(&d);
    d.space = PERI_SPACE_PLANE_STRESS;
    d.horizon = 3.0001 * h;
    (void)MUST(NULL, peri_body_create(&d, &b, NULL));
    peri_material_desc_init(&m, PERI_LAW_BOND_BASED);
    m.young = young;
    m.density = 2000;
    m.critical_stretch = 0.01;
    const int32_t brittle = (int32_t)MUST(b, peri_add_material(b, &m));
    m.critical_stretch = 0;
    const int32_t ground = (int32_t)MUST(b, peri_add_material(b, &m));
    const int64_t n = MUST(b, peri_add_box(b, brittle, lo, hi, h));
    for (int k = 0; k < 3; ++k) (void)MUST(b, peri_add_box(b, ground, part[k][0], part[k][1], h));
    (void)MUST(b, peri_build(b));
    for (int k = 0; k < 3; ++k) {
        const int32_t wall = (int32_t)MUST(b, peri_select_box(b, NULL, part[k][0], part[k][1]));
        (void)MUST(b, peri_prescribe_displacement(b, wall, PERI_AXIS_XY, NULL, NULL, NULL));
    }
    const int32_t falls = (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi));
    (void)MUST(b, peri_add_velocity(b, falls, v));
    (void)MUST(b, peri_apply_body_force(b, falls, pull, NULL, NULL));
    peri_contact_desc_init(&c);
    c.friction = 0.5;
    c.restitution = 0.6;
    (void)MUST(b, peri_set_contact(b, PERI_ALL, PERI_ALL, &c));
    const int64_t all = peri_point_count(b);
    x = (double *)malloc((size_t)(2 * all) * sizeof *x);
    peri_advance_desc_init(&a);
    a.duration = time / 40;
    a.damping = 8;
    for (int k = 0; k < 40; ++k) {
        (void)MUST(b, peri_advance(b, &a));
        (void)MUST(b, peri_get_energy(b, &e));
        peak = fmax(peak, e.kinetic);
        lying[k % 20] = e.kinetic;
    }
    qsort(lying, 20, sizeof *lying, by_size);
    (void)MUST(b, peri_get_field(b, PERI_FIELD_CURRENT_POSITION, x, 2 * all));
    for (int64_t i = 0; i < n; ++i) {
        CHECK(x[2 * i + 1] > -4.5 * h); /* nothing fell through */
        for (int64_t j = i + 1; j < all; ++j) {
            const double r = hypot(x[2 * i] - x[2 * j], x[2 * i + 1] - x[2 * j + 1]) / h;
            least = fmin(least, r);
            near += r < 0.5;
        }
    }
    if (test_long)
        printf("    %d points: kinetic energy %.1e, at most %.1e of its peak, nearest %.2f spacings, %d of %d bonds broken, error %.1e\n",
               (int)n, lying[10] / peak, lying[19] / peak, least, (int)peri_broken_count(b), (int)peri_bond_count(b),
               e.error / (e.initial + e.external));
    CHECK(near == 0);
    CHECK(lying[10] < still * peak && lying[19] < 1e3 * still * peak);
    CHECK(peri_broken_count(b) > peri_bond_count(b) / 8);
    CHECK_NEAR(e.error / (e.initial + e.external), 0, 0, 0.02);
    free(x);
    peri_body_destroy(b);
}

static void rubble_comes_to_rest(void) { pile_up(12, 10, 1e6, 0.8, 1e-3); }

static void rubble_of_800_points(void) { pile_up(40, 20, 1e7, 2, 1e-6); }

/* ---- what it costs -------------------------------------------------------------------------------------------------------------- */

/* The least time of a step with contact over that without, of a pane with a crack (2D) or a plate of 16 layers, whose half is pressed on
   the other as it flies. */
static double cost(int dim, int precision) {
    const double h = 1e-3, lo[3] = {0, 0, 0}, hi2[3] = {300 * h, 120 * h, 0}, hi3[3] = {60 * h, 60 * h, 16 * h}, from[2] = {0, 60 * h};
    const double to[2] = {150 * h, 60 * h}, low[3] = {-1, -1, -1}, half[3] = {1, 60 * h, 1}, v[3] = {20, 0, 0}, up[3] = {0, 5, 0};
    double least[2] = {1e9, 1e9};
    peri_body *b[2];
    for (int k = 0; k < 2; ++k) {
        peri_body_desc d;
        peri_material_desc m;
        peri_contact_desc c;
        peri_body_desc_init(&d);
        d.space = dim == 2 ? PERI_SPACE_PLANE_STRESS : PERI_SPACE_SOLID;
        d.precision = precision;
        d.horizon = 3.0001 * h;
        d.threads = 1;
        (void)MUST(NULL, peri_body_create(&d, &b[k], NULL));
        peri_material_desc_init(&m, PERI_LAW_BOND_BASED);
        m.young = 72e9;
        m.density = 2440;
        (void)MUST(b[k], peri_add_material(b[k], &m));
        (void)MUST(b[k], peri_add_box(b[k], peri_id(b[k], PERI_KIND_MATERIAL, 1), lo, dim == 2 ? hi2 : hi3, h));
        (void)MUST(b[k], peri_build(b[k]));
        if (dim == 2) (void)MUST(b[k], peri_cut_segment(b[k], PERI_CUT_INITIAL, from, to));
        peri_contact_desc_init(&c);
        c.friction = 0.3;
        c.restitution = 0.7;
        if (k) (void)MUST(b[k], peri_set_contact(b[k], PERI_ALL, PERI_ALL, &c));
        (void)MUST(b[k], peri_add_velocity(b[k], PERI_ALL, v));
        (void)MUST(b[k], peri_add_velocity(b[k], (int32_t)MUST(b[k], peri_select_box(b[k], NULL, low, half)), up));
    }
    peri_advance_desc a;
    peri_advance_desc_init(&a);
    a.steps = dim == 2 ? 25 : 6;
    a.time_step = 0.9 * peri_stable_step(b[1]);
    for (int round = 0; round < 14; ++round)
        for (int k = 0; k < 2; ++k) {
            const clock_t start = clock();
            (void)MUST(b[k], peri_advance(b[k], &a));
            const double took = (double)(clock() - start);
            if (round > 0) least[k] = fmin(least[k], took);
        }
    for (int k = 0; k < 2; ++k) peri_body_destroy(b[k]);
    return least[1] / least[0] - 1;
}

static void contact_costs_little(void) {
    for (int k = 0; k < 4; ++k) {
        const double share = cost(2 + k / 2, k % 2 ? PERI_PRECISION_SINGLE : PERI_PRECISION_DOUBLE);
        printf("    %dD, %s: %.3f of a step\n", 2 + k / 2, k % 2 ? "single" : "double", share);
        CHECK(share < (k < 2 ? 0.10 : 0.25));
    }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(a_closed_crack_carries);
    RUN(methods_agree_of_a_closed_crack);
    RUN(contact_is_no_support);
    RUN(rubble_comes_to_rest);
    LONG_RUN(rubble_of_800_points);
    LONG_RUN(contact_costs_little);
    return test_end("test_contact_rest");
}
