/* SPDX-License-Identifier: MIT */
/* run_decks.c - the decks of tools/run/decks, run by the parts of peri_run.

   SOURCE OF TRUTH: C code that makes the same calls (the same bits); Hooke for the bar, Kirsch for the hole, Timoshenko for the cantilever,
   to bounds that follow from the coarseness of the decks; and, of decks with one thing wrong, the line where it is.
   run_decks DIRECTORY (of what is written; tests/check_run.sh). */
#include "../tools/run/run.h"
#include "peri_test.h"

static const char *directory = "build/checks/run";

static int run_file(run_scene *scene, const char *name) {
    char      path[200];
    run_fault fault = {""};
    int       result;
    (void)snprintf(path, sizeof path, "tools/run/decks/%s.txt", name);
    result = run_scene_read(scene, path, directory, 1, &fault);
    if (result < 0) printf("    %s\n", fault.text);
    CHECK(result == 0);
    return result;
}

static double *field_of(peri_body *body, int32_t field, int64_t *count) {
    double *values;
    *count = peri_size_of_field(body, field);
    values = (double *)malloc((size_t)(*count > 0 ? *count : 1) * sizeof *values);
    if (values == NULL) exit(1);
    MUST(body, peri_get_field(body, field, values, *count));
    return values;
}

static void same_bits(peri_body *a, peri_body *b) {
    int64_t n, m;
    double *p = field_of(a, PERI_FIELD_DISPLACEMENT, &n), *q = field_of(b, PERI_FIELD_DISPLACEMENT, &m);
    CHECK(n == m && n > 1000 && memcmp(p, q, (size_t)n * sizeof *p) == 0);
    CHECK(peri_step_count(a) == peri_step_count(b) && peri_broken_count(a) == peri_broken_count(b));
    free(p);
    free(q);
}

static peri_body *create(int32_t space, double horizon, int32_t quadrature, int32_t geometry, double thickness) {
    peri_body_desc desc;
    peri_body     *body = NULL;
    peri_body_desc_init(&desc);
    desc.space = space;
    desc.horizon = horizon;
    desc.quadrature = quadrature;
    desc.geometry = geometry;
    desc.thickness = thickness;
    CHECK(peri_body_create(&desc, &body, NULL) == PERI_OK);
    return body;
}

static int32_t add_brittle(peri_body *body, double young, double density, double fracture_energy) {
    peri_material_desc desc;
    peri_material_desc_init(&desc, PERI_LAW_BOND_BASED);
    desc.young = young;
    desc.density = density;
    desc.fracture_energy = fracture_energy;
    return (int32_t)MUST(body, peri_add_material(body, &desc));
}

static int32_t box_set(peri_body *body, double x0, double y0, double x1, double y1) {
    const double lo[2] = {x0, y0}, hi[2] = {x1, y1};
    return (int32_t)MUST(body, peri_select_box(body, NULL, lo, hi));
}

/* examples/hello.c */
static void bar(void) {
    const double lo[2] = {0, 0}, hi[2] = {0.1, 0.04}, left[2] = {-100e6, 0}, right[2] = {100e6, 0};
    run_scene    scene;
    peri_body   *body = create(PERI_SPACE_PLANE_STRESS, 3e-3, PERI_QUADRATURE_PARTIAL, PERI_GEOMETRY_NONLINEAR, 1);
    peri_advance_desc run;
    MUST(body, peri_add_box(body, add_brittle(body, 210e9, 7850, 0), lo, hi, 1e-3));
    MUST(body, peri_build(body));
    MUST(body, peri_apply_layer_traction(body, box_set(body, 0, 0, 1e-3, 0.04), 0.04, left, NULL, NULL));
    MUST(body, peri_apply_layer_traction(body, box_set(body, 0.099, 0, 0.1, 0.04), 0.04, right, NULL, NULL));
    peri_advance_desc_init(&run);
    run.duration = 1e-4;
    run.damping = 3e5;
    MUST(body, peri_advance(body, &run));
    if (run_file(&scene, "bar") == 0) {
        int64_t n;
        double *u = field_of(scene.body, PERI_FIELD_DISPLACEMENT, &n);
        same_bits(scene.body, body);
        CHECK_NEAR(u[2 * 2080] - u[2 * 2020], 0.06 * 100e6 / 210e9, 0.04, 0); /* a sum over three cells for the integral */
        free(u);
    }
    run_scene_free(&scene);
    peri_body_destroy(body);
}

/* examples/branching.c */
static void branching(void) {
    const double lo[2] = {-0.05, -0.02}, hi[2] = {0.05, 0.02}, edge[2] = {-0.05, 0}, middle[2] = {0, 0};
    const double up[2] = {0, 2e6}, down[2] = {0, -2e6};
    run_scene    scene;
    peri_body   *body = create(PERI_SPACE_PLANE_STRESS, 2e-3, PERI_QUADRATURE_FULL, PERI_GEOMETRY_NONLINEAR, 1);
    peri_advance_desc run;
    MUST(body, peri_add_box(body, add_brittle(body, 72e9, 2440, 3.8), lo, hi, 0.1 / 150));
    MUST(body, peri_build(body));
    CHECK(peri_cut_segment(body, PERI_CUT_INITIAL, edge, middle) > 1000);
    MUST(body, peri_set_no_fail(body, box_set(body, -0.05, 0.018, 0.05, 0.02), 1));
    MUST(body, peri_set_no_fail(body, box_set(body, -0.05, -0.02, 0.05, -0.018), 1));
    MUST(body, peri_apply_layer_traction(body, box_set(body, -0.05, 0.0193333, 0.05, 0.02), 0.1, up, NULL, NULL));
    MUST(body, peri_apply_layer_traction(body, box_set(body, -0.05, -0.02, 0.05, -0.0193333), 0.1, down, NULL, NULL));
    peri_advance_desc_init(&run);
    run.duration = 43e-6;
    MUST(body, peri_advance(body, &run));
    if (run_file(&scene, "branching") == 0) {
        same_bits(scene.body, body);
        CHECK(peri_broken_count(scene.body) > 1000 && peri_cut_count(scene.body) == peri_cut_count(body));
    }
    run_scene_free(&scene);
    peri_body_destroy(body);
}

/* Kirsch across the pull, times 3.14/3 for the width (Heywood, examples/hole.c), further than a horizon from the rim. 6 %: the rim is a
   staircase of cells of a tenth of the radius, and families average over 0.3 radii. */
static void hole(void) {
    run_scene scene;
    if (run_file(&scene, "hole") == 0) {
        int64_t n, i, compared = 0;
        double *x = field_of(scene.body, PERI_FIELD_POSITION, &n), *stress = field_of(scene.body, PERI_FIELD_STRESS, &i);
        CHECK(2 * i == 3 * n);
        for (i = 0; i < n / 2; ++i) {
            const double q = pow(0.01 / x[2 * i + 1], 2);
            if (x[2 * i] < 0 || x[2 * i] > 1e-3 || x[2 * i + 1] < 0.013 || x[2 * i + 1] > 0.025) continue;
            CHECK_NEAR(stress[3 * i] / 100e6, (1 + q / 2 + 3 * q * q / 2) * 3.14 / 3, 0.06, 0);
            ++compared;
        }
        CHECK(compared == 12); /* rows of 1 mm from 13 to 25 mm */
        free(x);
        free(stress);
    }
    run_scene_free(&scene);
}

static int32_t ball_set(peri_body *body, double x, double y, double radius) {
    const double centre[2] = {x, y};
    return (int32_t)MUST(body, peri_select_ball(body, NULL, centre, radius));
}

/* The rows that the deck writes against the curve of peri_solve. */
static void compare_curve(const double (*curve)[6]) {
    char   path[200], line[400];
    double row[7];
    FILE  *file;
    int    k, rows = 0;
    (void)snprintf(path, sizeof path, "%s/bending.csv", directory);
    file = fopen(path, "r");
    CHECK(file != NULL);
    if (file == NULL) return;
    CHECK(fgets(line, sizeof line, file) != NULL && strcmp(line, "time,load factor,mean u x,mean u y,force x,force y,broken bonds\n") == 0);
    for (k = 0; k < 10 && fgets(line, sizeof line, file) != NULL; ++k, ++rows) {
        CHECK(sscanf(line, "%lf,%lf,%lf,%lf,%lf,%lf,%lf", row, row + 1, row + 2, row + 3, row + 4, row + 5, row + 6) == 7);
        CHECK_NEAR(row[1], curve[k][0], 1e-10, 0);
        CHECK_NEAR(row[3], curve[k][2], 1e-10, 0);
        CHECK_NEAR(row[5], curve[k][4], 1e-10, 0);
        CHECK(row[6] == curve[k][5]);
    }
    CHECK(rows == 10 && curve[9][5] > 20);
    (void)fclose(file);
}

/* examples/bending.c */
static void bending(void) {
    const double lo[2] = {-0.21, 0}, hi[2] = {0.21, 0.1}, below[2] = {0, -0.001}, tip[2] = {0, 0.05}, down[2] = {0, -1.5e-4};
    static double curve[10][6];
    run_scene    scene;
    peri_body   *body = create(PERI_SPACE_PLANE_STRESS, 0.015, PERI_QUADRATURE_FULL, PERI_GEOMETRY_LINEAR, 0.1);
    peri_solve_desc solve;
    MUST(body, peri_add_box(body, add_brittle(body, 30e9, 2400, 100), lo, hi, 0.005));
    MUST(body, peri_build(body));
    MUST(body, peri_cut_segment(body, PERI_CUT_INITIAL, below, tip));
    MUST(body, peri_set_no_fail(body, ball_set(body, -0.2, 0, 0.015), 1));
    MUST(body, peri_set_no_fail(body, ball_set(body, 0.2, 0, 0.015), 1));
    MUST(body, peri_set_no_fail(body, ball_set(body, 0, 0.1, 0.015), 1));
    MUST(body, peri_prescribe_displacement(body, ball_set(body, -0.2, 0, 0.004), PERI_AXIS_XY, NULL, NULL, NULL));
    MUST(body, peri_prescribe_displacement(body, ball_set(body, 0.2, 0, 0.004), PERI_AXIS_Y, NULL, NULL, NULL));
    peri_solve_desc_init(&solve);
    solve.curve_load = (int32_t)MUST(body, peri_prescribe_displacement(body, ball_set(body, 0, 0.1, 0.004), PERI_AXIS_Y, down, NULL, NULL));
    solve.steps = solve.curve_rows = 10;
    solve.curve = curve[0];
    MUST(body, peri_solve(body, &solve, NULL));
    if (run_file(&scene, "bending") == 0) {
        same_bits(scene.body, body);
        run_scene_free(&scene); /* closes what it wrote */
        compare_curve((const double(*)[6])curve);
    } else run_scene_free(&scene);
    peri_body_destroy(body);
}

/* Timoshenko, examples/cantilever.c. 3 %: 1.5 cells of 1 mm on 200 mm come from where the wall ends, the rest from ten rows of points. */
static void cantilever(void) {
    run_scene scene;
    if (run_file(&scene, "cantilever") == 0) {
        const double at = 0.1995, bending = 100 * at * at * (3 * 0.2 - at) / (6 * 210e9 * 0.005 * 1e-6 / 12);
        const double shear = 1.2 * 100 * at / (210e9 / 2.6 * 5e-5), place[2] = {at, 0.0005};
        int64_t n;
        double *u = field_of(scene.body, PERI_FIELD_DISPLACEMENT, &n), wall[2];
        CHECK_NEAR(u[2 * peri_find_point(scene.body, place) + 1], -(bending + shear), 0.03, 0);
        MUST(scene.body, peri_get_reaction(scene.body, scene.load[0].id, wall));
        CHECK_NEAR(wall[1], 100, 1e-6, 0); /* the tolerance of the equilibrium is 1e-8 */
        free(u);
    }
    run_scene_free(&scene);
}

static void impact(void) {
    const double lo[3] = {0, 0, 0}, hi[3] = {0.03, 0.03, 0.004}, left[3] = {0.002, 0.03, 0.004}, right[3] = {0.028, 0, 0};
    run_scene    scene;
    peri_body   *body = create(PERI_SPACE_SOLID, 3e-3, PERI_QUADRATURE_FULL, PERI_GEOMETRY_NONLINEAR, 1);
    peri_advance_desc  run;
    peri_obstacle_desc ball;
    peri_obstacle_state state;
    MUST(body, peri_add_box(body, add_brittle(body, 72e9, 2440, 3.8), lo, hi, 1e-3));
    MUST(body, peri_build(body));
    MUST(body, peri_prescribe_velocity(body, (int32_t)peri_select_box(body, NULL, lo, left), PERI_AXIS_XYZ, NULL, NULL, NULL));
    MUST(body, peri_prescribe_velocity(body, (int32_t)peri_select_box(body, NULL, right, hi), PERI_AXIS_XYZ, NULL, NULL, NULL));
    peri_obstacle_desc_init(&ball, PERI_SHAPE_BALL);
    ball.place[0] = ball.place[1] = 0.015;
    ball.place[2] = 0.0086;
    ball.radius = 0.005;
    ball.density = 7850;
    ball.velocity[2] = -30;
    MUST(body, peri_add_obstacle(body, &ball));
    peri_advance_desc_init(&run);
    run.duration = 2e-5;
    MUST(body, peri_advance(body, &run));
    if (run_file(&scene, "impact") == 0) {
        same_bits(scene.body, body);
        MUST(scene.body, peri_get_obstacle_state(scene.body, peri_id(scene.body, PERI_KIND_OBSTACLE, 1), &state));
        CHECK(state.velocity[2] > -29.9); /* it was slowed down: it struck */
    }
    run_scene_free(&scene);
    peri_body_destroy(body);
}

/* ---- meshes in decks */

static void write_file(const char *name, const char *text) {
    char  path[200];
    FILE *file;
    (void)snprintf(path, sizeof path, "%s/%s", directory, name);
    file = fopen(path, "wb");
    CHECK(file != NULL);
    if (file == NULL) return;
    CHECK(fputs(text, file) >= 0);
    CHECK(fclose(file) == 0);
}

static int run_text_deck(run_scene *scene, const char *text, run_fault *fault) {
    char path[200];
    (void)snprintf(path, sizeof path, "%s/deck", directory);
    fault->text[0] = 0;
    return run_scene_of(scene, text, strlen(text), path, directory, 1, fault);
}

#define BODY "[body]\nspace plane_stress\nhorizon 2.5e-3\nthreads 1\n"
#define STEEL "[material steel]\nyoung 2e11\ndensity 7800\n"

/* A mesh in millimetres, 6 x 4 squares; half of it of another material, the left column held by a group of the mesh. */
static void a_mesh_in_a_deck(void) {
    char      text[8000];
    size_t    at = (size_t)snprintf(text, sizeof text, "*NODE\n");
    run_scene scene;
    run_fault fault;
    int       i, j;
    for (j = 0; j <= 4; ++j)
        for (i = 0; i <= 6; ++i) at += (size_t)snprintf(text + at, sizeof text - at, "%d, %d, %d, 0\n", 7 * j + i + 1, i, j);
    at += (size_t)snprintf(text + at, sizeof text - at, "*ELEMENT, TYPE=CPS4\n");
    for (j = 0; j < 4; ++j)
        for (i = 0; i < 6; ++i)
            at += (size_t)snprintf(text + at, sizeof text - at, "%d, %d, %d, %d, %d\n", 6 * j + i + 1, 7 * j + i + 1, 7 * j + i + 2,
                                   7 * (j + 1) + i + 2, 7 * (j + 1) + i + 1);
    (void)snprintf(text + at, sizeof text - at, "*ELSET, ELSET=upper, GENERATE\n13, 24, 1\n*NSET, NSET=left, GENERATE\n1, 29, 7\n");
    write_file("plate.inp", text);
    if (run_text_deck(&scene, BODY STEEL "[material glass]\nyoung 7e10\ndensity 2500\n[mesh]\nfile plate.inp\nscale 1e-3\n"
                      "material_of upper glass\n[displacement]\nset left\n[body_force]\nset upper\nvalue 0 -1e6\n[solve]\n", &fault) == 0) {
        int64_t n, k;
        double *volume = field_of(scene.body, PERI_FIELD_VOLUME, &n), *material = field_of(scene.body, PERI_FIELD_MATERIAL, &k);
        double *place = field_of(scene.body, PERI_FIELD_POSITION, &k), total = 0, held[2];
        CHECK(n == 24);
        for (k = 0; k < n; ++k) total += volume[k];
        for (k = 0; k < n; ++k) CHECK(material[k] == (k < 12 ? 1 : 2));
        CHECK_NEAR(total, 24e-6, 1e-14, 0);
        CHECK_NEAR(place[2 * 23], 5.5e-3, 1e-14, 0);
        CHECK_NEAR(place[2 * 23 + 1], 3.5e-3, 1e-14, 0);
        CHECK(peri_size_of_set(scene.body, peri_find_set(scene.body, "left")) == 4);
        MUST(scene.body, peri_get_reaction(scene.body, scene.load[0].id, held));
        CHECK_NEAR(held[1], 12e-6 * 1e6, 1e-6, 0); /* but for the held points: theirs, too, is borne by the support */
        free(volume), free(material), free(place);
    }
    CHECK(fault.text[0] == 0);
    if (fault.text[0] != 0) printf("    %s\n", fault.text);
    run_scene_free(&scene);
}

/* Rectangles of 1.5 x 1: partial areas are those of peri_add_grid, so that the displacements under a load are. */
static void cells_of_a_mesh_are_exact(void) {
    const double lo[2] = {0, 0}, hi[2] = {9e-3, 4e-3}, edge[2] = {1.5e-3, 4e-3}, zero[2] = {0, 0}, pull[2] = {0, -1e6};
    const int32_t cells[2] = {6, 4};
    char      text[8000];
    size_t    at = (size_t)snprintf(text, sizeof text, "*NODE\n");
    run_scene scene;
    run_fault fault;
    peri_body *body;
    peri_body_desc d;
    peri_material_desc m;
    peri_solve_desc s;
    double   *u, *want;
    int64_t   n, k;
    int       i, j;
    for (j = 0; j <= 4; ++j)
        for (i = 0; i <= 6; ++i) at += (size_t)snprintf(text + at, sizeof text - at, "%d, %g, %d, 0\n", 7 * j + i + 1, 1.5 * i, j);
    at += (size_t)snprintf(text + at, sizeof text - at, "*ELEMENT, TYPE=CPS4\n");
    for (j = 0; j < 4; ++j)
        for (i = 0; i < 6; ++i)
            at += (size_t)snprintf(text + at, sizeof text - at, "%d, %d, %d, %d, %d\n", 6 * j + i + 1, 7 * j + i + 1, 7 * j + i + 2,
                                   7 * (j + 1) + i + 2, 7 * (j + 1) + i + 1);
    write_file("rectangles.inp", text);
    CHECK(run_text_deck(&scene, BODY "quadrature partial\ncorrection equilibrium\n" STEEL "law lps\npoisson 0.3\n"
                        "[mesh]\nfile rectangles.inp\n"
                        "scale 1e-3\n[set edge]\nlo 0 0\nhi 1.5e-3 4e-3\n[displacement]\nset edge\n[body_force]\nset all\n"
                        "value 0 -1e6\n[solve]\n", &fault) == 0);
    if (fault.text[0] != 0) printf("    %s\n", fault.text);
    peri_body_desc_init(&d);
    d.space = PERI_SPACE_PLANE_STRESS, d.horizon = 2.5e-3, d.threads = 1;
    d.quadrature = PERI_QUADRATURE_PARTIAL, d.correction = PERI_CORRECTION_EQUILIBRIUM;
    peri_material_desc_init(&m, PERI_LAW_LPS);
    m.young = 2e11, m.density = 7800, m.poisson = 0.3;
    MUST(NULL, peri_body_create(&d, &body, NULL));
    MUST(body, peri_add_grid(body, (int32_t)MUST(body, peri_add_material(body, &m)), lo, hi, cells));
    MUST(body, peri_build(body));
    const int32_t held = (int32_t)MUST(body, peri_select_box(body, NULL, lo, edge));
    MUST(body, peri_prescribe_displacement(body, held, PERI_AXIS_XY, zero, NULL, NULL));
    MUST(body, peri_apply_body_force(body, PERI_ALL, pull, NULL, NULL));
    peri_solve_desc_init(&s);
    MUST(body, peri_solve(body, &s, NULL));
    if (fault.text[0] == 0) {
        u = field_of(scene.body, PERI_FIELD_DISPLACEMENT, &n);
        want = field_of(body, PERI_FIELD_DISPLACEMENT, &n);
        CHECK(n == 48 && fabs(want[47]) > 0);
        for (k = 0; k < n; ++k) CHECK(fabs(u[k] - want[k]) <= 1e-6 * fabs(want[47])); /* of two solves to 1e-8 or so */
        free(u), free(want);
    }
    peri_body_destroy(body);
    run_scene_free(&scene);
}

/* A support that rises to its value by the time 4 steps are over, and stays. */
static void supports_rise(void) {
    run_scene scene;
    run_fault fault;
    int64_t   n;
    double   *u;
    int       k;
    for (k = 2; k <= 6; k += 2) {
        char deck[400];
        (void)snprintf(deck, sizeof deck, BODY STEEL "[box]\nlo 0 0\nhi 0.01 0.004\nspacing 1e-3\n[set end]\nlo 0 0\nhi 0.001 0.004\n"
                       "[displacement]\nset end\naxes x\nvalue -1e-6 0\nrise 4e-8\n[run]\nsteps %d\ntime_step 1e-8\n", k);
        CHECK(run_text_deck(&scene, deck, &fault) == 0);
        if (fault.text[0] == 0) {
            u = field_of(scene.body, PERI_FIELD_DISPLACEMENT, &n);
            CHECK_NEAR(u[0], -1e-6 * (k < 4 ? k / 4.0 : 1), 1e-9, 0);
            free(u);
        } else printf("    %s\n", fault.text);
        run_scene_free(&scene);
    }
}

/* ---- decks with one thing wrong */

#define BOX "[box]\nlo 0 0\nhi 0.01 0.004\nspacing 1e-3\n"
static void faults_are_named(void) {
    static const struct { const char *text, *where; } bad[] = {
        {"", "deck: holds no section"},
        {"young 3\n", ":1: young: stands before"},
        {"[body\nspace solid\n", ":1: [body: the section does not end"},
        {"[body]\nspace\n", ":2: space: has no value"},
        {"[body]\nspace plane\n", ":2: [body] space: is one of: plane_stress"},
        {"[body]\nspace solid\nspace solid\n", ":3: space: is given twice"},
        {"[body]\nspace solid\nhorizon 1 2\n", ":3: [body] horizon: has 2 values, but 1"},
        {"[body]\nspace solid\nhorizon 1e999\n", ":3: [body] horizon: is not a finite number"},
        {"[body]\nspace solid\nhorizon -1\n", ":3: [body] horizon: "},
        {"[body]\nspace solid\n", ":1: [body] horizon: "},
        {"[body]\nspace solid\nhorizon 1\nthreads 1.5\n", ":4: [body] threads: is not a whole number"},
        {"[body]\nspace solid\nhorizon 1\ncolour red\n", ":4: [body] colour: no such key here"},
        {STEEL, "[body]: the deck has no such section"},
        {BODY "[material glass]\nyoung 7e10\n", ":5: [material glass] density"},
        {BODY "[material glass]\nyoung 7e10\ndensity 1\npoisson 0.2\n", ":8: [material glass] poisson"},
        {BODY STEEL STEEL, ":8: [material steel] : a second material"},
        {BODY STEEL "[box]\nlo 0 0\nspacing 1\n", ":8: [box] hi: is missing"},
        {BODY STEEL "[box]\nmaterial gold\nlo 0 0\nhi 1 1\nspacing 0.1\n", ":9: [box] material: no section"},
        {BODY STEEL "[box]\nlo 0 0\nhi 1 1\nspacing 0\n", ":11: [box] spacing: "},
        {BODY STEEL "[mesh]\nfile none.inp\n", "none.inp: file: "},
        {BODY STEEL "[mesh]\nfile none\n", ":8: [mesh] format: is needed"},
        {BODY STEEL "[mesh]\nfile broken.msh\n", "broken.msh:2: MeshFormat"},
        {BODY STEEL BOX "[set a]\nlo 1 1\nhi 2 2\n", ":12: [set a]"},
        {BODY STEEL BOX "[traction]\nset a\n", ":13: [traction] set: no set has this name"},
        {BODY STEEL BOX "[displacement]\nset all\naxes w\n", ":14: [displacement] axes: is one of: x y z"},
        {BODY STEEL BOX "[force]\nset all\n", ":12: [force] : no such section"},
        {BODY STEEL BOX "[cut]\nfrom 0 0\nto 0 0\n", ":14: [cut] to"},
        {BODY STEEL BOX "[output]\ncurve a.csv\ncurve_of pull\n", ":14: [output] curve_of: no load"},
        {BODY STEEL BOX "[output]\nprobe a 1\n[run]\nsteps 1\n", ":13: [output] probe: is a name"},
        {BODY STEEL BOX "[output]\nvtk a.vtk\n", ":13: [output] vtk: no such key"},
        {BODY STEEL BOX "[output]\nvtu none/a.vtu\n", ":13: [output] vtu: "},
        {BODY STEEL BOX "[run]\nduration 1\ntime_step 1\n", ":14: [run] time_step: "},
        {BODY STEEL BOX "[run]\nsteps 1\nspeed 4\n", ":14: [run] speed: no such key"},
        {BODY STEEL BOX "[body_force]\nset all\nvalue 0 1\n[solve]\n", ":15: [solve]"}};
    size_t k;
    write_file("broken.msh", "$MeshFormat\n3 0 8\n$EndMeshFormat\n");
    for (k = 0; k < sizeof bad / sizeof *bad; ++k) {
        run_scene scene;
        run_fault fault;
        CHECK(run_text_deck(&scene, bad[k].text, &fault) < 0);
        if (strstr(fault.text, bad[k].where) == NULL) printf("    row %d: %s\n", (int)k, fault.text);
        CHECK(strstr(fault.text, bad[k].where) != NULL);
        run_scene_free(&scene);
    }
}

/* Cut off at every byte, and with every byte replaced by one that separates or begins a section. */
static void damaged_decks(void) {
    static const char deck[] = BODY STEEL "[box]\nlo 0 0\nhi 0.01 0.004\nspacing 1e-3\nwithout_ball 0 0 1e-3\n[set a]\nlo 0 0\nhi 1e-3 1\n"
        "no_fail 1\n[cut]\nfrom 5e-3 0\nto 5e-3 2e-3\n[traction b]\nset a\narea 4e-3\nnormal -1 0\nvalue -1e6 0\n[obstacle]\nshape ball\n"
        "place 0 1\nradius 0.1\n[contact]\nfriction 0.1\n[run]\nsteps 1\n[output]\nprobe p 0 0\nfield damage\n";
    static const char bytes[] = "[ #-";
    char   copy[sizeof deck];
    size_t size, b;
    int    refused = 0;
    for (size = 0; size < sizeof deck; ++size)
        for (b = 0; b < sizeof bytes; ++b) { /* b = 0: cut off there */
            run_scene scene;
            run_fault fault;
            int       result;
            memcpy(copy, deck, sizeof deck);
            if (size < sizeof deck - 1) copy[size] = b == 0 ? (char)0 : bytes[b - 1];
            result = run_text_deck(&scene, copy, &fault);
            CHECK((result < 0) == (fault.text[0] != 0));
            refused += result < 0;
            run_scene_free(&scene);
        }
    CHECK(refused > 500);
}

int main(int argc, char **argv) {
    if (argc > 1 && strchr(argv[1], '/') != NULL) directory = argv[1], --argc, ++argv;
    test_begin(argc, argv);
    RUN(bar);
    RUN(branching);
    RUN(hole);
    RUN(bending);
    RUN(cantilever);
    RUN(impact);
    RUN(a_mesh_in_a_deck);
    RUN(cells_of_a_mesh_are_exact);
    RUN(supports_rise);
    RUN(faults_are_named);
    RUN(damaged_decks);
    return test_end("run_decks");
}
