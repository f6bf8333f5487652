/* SPDX-License-Identifier: MIT */
/* binding_scenes.c - the three scenes of bindings/scenes.md in C. Every binding runs the same calls and must print the same lines, in this
   order: "scene.name value". Values are whole numbers, doubles with 17 digits, or the hash of an array: FNV-1a of 32 bits over the bytes of
   its numbers, least significant byte first, as 8 hexadecimal digits.

     binding_scenes                all scenes
     binding_scenes glass ball     those named */
#include "../peri.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *scene;

static int64_t must(peri_body *body, int64_t result) {
    peri_error error;
    char text[300];
    if (result >= 0) return result;
    (void)peri_get_error(body, &error);
    (void)peri_format_error(&error, text, sizeof text);
    fprintf(stderr, "%s: %s\n", scene, text);
    exit(1);
}
static int32_t id(peri_body *body, int64_t result) { return (int32_t)must(body, result); }

static void count(const char *name, int64_t n) { printf("%s.%s %ld\n", scene, name, (long)n); }
static void number(const char *name, double v) { printf("%s.%s %.17g\n", scene, name, v); }

/* bytes of one number each: 8 of a double, 4 of an int32_t */
static void hash(const char *name, const void *numbers, int64_t entries, int bytes) {
    uint32_t h = 2166136261u;
    int64_t i;
    int k;
    for (i = 0; i < entries; ++i) {
        uint64_t word = 0;
        uint32_t half;
        if (bytes == 8) memcpy(&word, (const char *)numbers + 8 * i, 8);
        else {
            memcpy(&half, (const char *)numbers + 4 * i, 4);
            word = half;
        }
        for (k = 0; k < bytes; ++k) h = (h ^ (uint32_t)(word >> (8 * k) & 0xff)) * 16777619u;
    }
    printf("%s.%s %08lx\n", scene, name, (unsigned long)h);
}

static void field(peri_body *body, const char *name, int32_t which) {
    int64_t n = must(body, peri_size_of_field(body, which));
    double *v = (double *)malloc((size_t)n * sizeof *v);
    if (!v) exit(1);
    (void)must(body, peri_get_field(body, which, v, n));
    hash(name, v, n, 8);
    free(v);
}

static void common(peri_body *body) {
    peri_energy e;
    count("points", peri_point_count(body));
    count("bonds", peri_bond_count(body));
    count("cut", peri_cut_count(body));
    count("steps", peri_step_count(body));
    count("broken", peri_broken_count(body));
    field(body, "displacement", PERI_FIELD_DISPLACEMENT);
    field(body, "velocity", PERI_FIELD_VELOCITY);
    field(body, "damage", PERI_FIELD_DAMAGE);
    (void)must(body, peri_get_energy(body, &e));
    number("kinetic", e.kinetic);
    number("elastic", e.elastic);
    number("external", e.external);
    number("fracture", e.fracture);
}

static peri_body *create(int32_t space, double horizon) {
    peri_body_desc d;
    peri_body *body = NULL;
    peri_body_desc_init(&d);
    d.space = space;
    d.horizon = horizon;
    if (peri_body_create(&d, &body, NULL) < 0) exit(1);
    return body;
}

/* ---- glass: the pane of README.md, pulled by its upper edge until the crack from the notch splits it ---- */

static void glass(void) {
    const double lo[2] = {0, 0}, hi[2] = {0.1, 0.04}, tip[2] = {0.05, 0.02}, edge[2] = {0, 0.02}, up[2] = {0, 2e6};
    const double row[2] = {0, 0.0395}, floor_hi[2] = {0.1, 0.0005};
    peri_body *pane = create(PERI_SPACE_PLANE_STRESS, 1.5e-3);
    peri_material_desc m;
    peri_advance_desc run;
    int32_t top, bottom;
    peri_material_desc_init(&m, PERI_LAW_BOND_BASED);
    m.young = 72e9;
    m.density = 2440;
    m.fracture_energy = 3.8;
    (void)must(pane, peri_add_box(pane, id(pane, peri_add_material(pane, &m)), lo, hi, 0.5e-3));
    (void)must(pane, peri_build(pane));
    (void)must(pane, peri_cut_segment(pane, PERI_CUT_INITIAL, edge, tip));
    top = id(pane, peri_select_box(pane, "top", row, hi));
    bottom = id(pane, peri_select_box(pane, "bottom", lo, floor_hi));
    (void)must(pane, peri_apply_layer_traction(pane, top, 0.1, up, NULL, NULL));
    (void)must(pane, peri_prescribe_velocity(pane, bottom, PERI_AXIS_XY, NULL, NULL, NULL));
    peri_advance_desc_init(&run);
    run.duration = 40e-6;
    (void)must(pane, peri_advance(pane, &run));
    common(pane);
    peri_body_destroy(pane);
}

/* ---- ball: a block of an LPS solid in two pieces, the larger struck by a free ball; what callbacks are told is hashed ---- */

enum { TOLD = 40000 };
typedef struct told {
    int64_t frames, breaks;
    int32_t pairs[TOLD]; /* of the bonds that broke, in the order in which they were told */
    double times[TOLD / 2];
} told;

static int32_t on_frame(void *user, peri_body *body) {
    (void)body;
    ((told *)user)->frames++;
    return 0;
}
static int32_t on_break(void *user, int32_t i, int32_t j, double time, double stretch) {
    told *t = (told *)user;
    (void)stretch;
    if (2 * t->breaks + 2 > TOLD) return -1;
    t->pairs[2 * t->breaks] = i;
    t->pairs[2 * t->breaks + 1] = j;
    t->times[t->breaks++] = time;
    return 0;
}

static void fragments(peri_body *body) {
    int64_t points = peri_point_count(body), n;
    int32_t *of_point = (int32_t *)malloc((size_t)points * sizeof *of_point);
    peri_fragment *f;
    if (!of_point) exit(1);
    n = must(body, peri_find_fragments(body, of_point, points));
    f = (peri_fragment *)malloc((size_t)n * sizeof *f);
    if (!f) exit(1);
    (void)must(body, peri_get_fragments(body, f, n));
    count("fragments", n);
    hash("of_point", of_point, points, 4);
    count("first_points", f[0].points);
    number("first_centre_z", f[0].centre[2]);
    free(f);
    free(of_point);
}

static void ball(void) {
    const double lo[3] = {0, 0, 0}, hi[3] = {0.1, 0.1, 0.04};
    const double corner[3] = {0.07, -0.01, -0.01}, along[3] = {0, 0.12, 0}, down[3] = {0, 0, 0.06};
    peri_body *block = create(PERI_SPACE_SOLID, 0.03);
    told *t = (told *)calloc(1, sizeof *t);
    peri_material_desc m;
    peri_obstacle_desc o;
    peri_obstacle_state state;
    peri_advance_desc run;
    int32_t striker;
    if (!t) exit(1);
    peri_material_desc_init(&m, PERI_LAW_LPS);
    m.young = 30e9;
    m.poisson = 0.2;
    m.density = 2400;
    m.critical_stretch = 3e-3;
    (void)must(block, peri_add_box(block, id(block, peri_add_material(block, &m)), lo, hi, 0.01));
    (void)must(block, peri_build(block));
    (void)must(block, peri_cut_rectangle(block, PERI_CUT_INITIAL, corner, along, down));
    peri_obstacle_desc_init(&o, PERI_SHAPE_BALL);
    o.place[0] = o.place[1] = 0.05;
    o.place[2] = 0.055;
    o.radius = 0.02;
    o.density = 7800;
    o.friction = 0.1;
    o.velocity[2] = -60;
    striker = id(block, peri_add_obstacle(block, &o));
    (void)must(block, peri_on_break(block, on_break, t));
    peri_advance_desc_init(&run);
    run.steps = 80;
    run.time_step = 1e-6;
    run.frame_steps = 10;
    run.on_frame = on_frame;
    run.user = t;
    (void)must(block, peri_advance(block, &run));
    common(block);
    count("frames", t->frames);
    count("breaks", t->breaks);
    hash("pairs", t->pairs, 2 * t->breaks, 4);
    hash("times", t->times, t->breaks, 8);
    (void)must(block, peri_get_obstacle_state(block, striker, &state));
    number("striker_z", state.place[2]);
    number("striker_speed", state.velocity[2]);
    fragments(block);
    peri_body_destroy(block);
    free(t);
}

/* ---- cantilever: equilibrium of a strip held at its left, in two load steps, under a force that a callback writes ---- */

static int32_t pull_down(void *user, double time, int64_t points, const int32_t *which, double *value) {
    int64_t k;
    ++*(int64_t *)user;
    (void)which;
    for (k = 0; k < points; ++k) value[2 * k + 1] = -2e4 * time * time;
    return 0;
}

static void cantilever(void) {
    const double lo[2] = {0, 0}, hi[2] = {1, 0.25}, grip[2] = {0.15, 0.25}, end[2] = {0.95, 0}, zero[2] = {0, 0};
    peri_body *beam = create(PERI_SPACE_PLANE_STRESS, 0.15);
    double curve[12], force[2];
    int64_t calls = 0;
    peri_material_desc m;
    peri_solve_desc s;
    peri_solve_report report;
    int32_t held, tip, support;
    peri_material_desc_init(&m, PERI_LAW_LPS);
    m.young = 1e9;
    m.poisson = 0.3;
    m.density = 1000;
    (void)must(beam, peri_add_box(beam, id(beam, peri_add_material(beam, &m)), lo, hi, 0.05));
    (void)must(beam, peri_build(beam));
    held = id(beam, peri_select_box(beam, "held", lo, grip));
    tip = id(beam, peri_select_box(beam, "tip", end, hi));
    support = id(beam, peri_prescribe_displacement(beam, held, PERI_AXIS_XY, NULL, NULL, NULL));
    (void)must(beam, peri_apply_body_force(beam, tip, zero, pull_down, &calls));
    peri_solve_desc_init(&s);
    s.steps = 2;
    s.curve_load = support;
    s.curve = curve;
    s.curve_rows = 2;
    (void)must(beam, peri_solve(beam, &s, &report));
    common(beam);
    count("load_steps", report.steps);
    count("curve_rows", report.curve_rows);
    hash("curve", curve, 12, 8);
    (void)must(beam, peri_get_reaction(beam, support, force));
    number("reaction_y", force[1]);
    number("called", calls > 0);
    peri_body_destroy(beam);
}

int main(int argc, char **argv) {
    static const struct {
        const char *name;
        void (*run)(void);
    } all[] = {{"glass", glass}, {"ball", ball}, {"cantilever", cantilever}};
    size_t k;
    int a;
    for (k = 0; k < sizeof all / sizeof all[0]; ++k) {
        int wanted = argc < 2;
        for (a = 1; a < argc; ++a) wanted |= !strcmp(argv[a], all[k].name);
        scene = all[k].name;
        if (wanted) all[k].run();
    }
    return 0;
}
