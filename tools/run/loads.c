/* SPDX-License-Identifier: MIT */
/* loads.c - the sections of what acts on a built body: set, cut, supports, loads, the state at the start, obstacles, contact. */
#include "run.h"
#include <math.h>
#include <string.h>

static int is(const run_section *section, const char *kind) { return run_same(section->kind, kind); }

static int vector(run_scene *scene, run_section *section, const char *key, double *to) {
    return run_vector(&scene->deck, section, key, scene->dim, to);
}

/* An entry that may be missing; 1: it was there. */
static int optional(run_scene *scene, run_section *section, const char *key, int count, double *to) {
    if (run_find(section, key) == NULL) return 0;
    return run_vector(&scene->deck, section, key, count, to) < 0 ? -1 : 1;
}

int run_set_of(run_scene *scene, run_section *section, int32_t *set) {
    const char *name;
    *set = PERI_ALL;
    if (run_find(section, "set") == NULL) return run_fail_at(&scene->deck, section, NULL, "set", "is missing: a set's name, or all");
    if (run_string(&scene->deck, section, "set", &name) < 0) return -1;
    if (run_same(name, "all")) return 0;
    *set = peri_find_set(scene->body, name);
    return *set > 0 ? 0 : run_fail_at(&scene->deck, section, run_find(section, "set"), "set", "no set has this name");
}

static int add_set(run_scene *scene, run_section *section) {
    double  lo[3], hi[3], radius, no_fail = 0;
    int64_t set;
    if (section->name[0] == 0) return run_fail_at(&scene->deck, section, NULL, "", "a set needs a name: [set NAME]");
    if (run_find(section, "lo") != NULL) {
        if (vector(scene, section, "lo", lo) < 0 || vector(scene, section, "hi", hi) < 0) return -1;
        set = run_must(scene, section, peri_select_box(scene->body, section->name, lo, hi));
    } else if (run_find(section, "centre") != NULL) {
        if (vector(scene, section, "centre", lo) < 0 || run_vector(&scene->deck, section, "radius", 1, &radius) < 0) return -1;
        set = run_must(scene, section, peri_select_ball(scene->body, section->name, lo, radius));
    } else { /* of the mesh, or one before */
        set = peri_find_set(scene->body, section->name);
        if (set <= 0) return run_fail_at(&scene->deck, section, NULL, "lo", "is missing: lo and hi, centre and radius, or a set of a mesh");
    }
    if (set < 0 || optional(scene, section, "no_fail", 1, &no_fail) < 0) return -1;
    if (no_fail == 0) return 0;
    return run_must(scene, section, peri_set_no_fail(scene->body, (int32_t)set, no_fail == 1 ? 1 : -1)) < 0 ? -1 : 0;
}

static int add_cut(run_scene *scene, run_section *section) {
    double  p[3], q[3], r[3];
    int64_t cut;
    if (scene->dim == 2) {
        if (vector(scene, section, "from", p) < 0 || vector(scene, section, "to", q) < 0) return -1;
        cut = peri_cut_segment(scene->body, PERI_CUT_INITIAL, p, q);
    } else if (run_find(section, "centre") != NULL) {
        if (vector(scene, section, "centre", p) < 0 || vector(scene, section, "normal", q) < 0 ||
            run_vector(&scene->deck, section, "radius", 1, r) < 0)
            return -1;
        cut = peri_cut_disc(scene->body, PERI_CUT_INITIAL, p, q, r[0]);
    } else {
        if (vector(scene, section, "corner", p) < 0 || vector(scene, section, "edge1", q) < 0 || vector(scene, section, "edge2", r) < 0)
            return -1;
        cut = peri_cut_rectangle(scene->body, PERI_CUT_INITIAL, p, q, r);
    }
    return run_must(scene, section, cut) < 0 ? -1 : 0;
}

static int add_obstacle(run_scene *scene, run_section *section) {
    static const run_choice shapes[] = {{"plane", PERI_SHAPE_PLANE}, {"ball", PERI_SHAPE_BALL}, {"box", PERI_SHAPE_BOX},
                                        {"capsule", PERI_SHAPE_CAPSULE}, {"cylinder", PERI_SHAPE_CYLINDER}, {NULL, 0}};
    static const run_key shape_key[] = {{"shape", RUN_CHOICE, 0, shapes}, {NULL, 0, 0, NULL}};
#define NUMBER(field) {#field, RUN_NUMBER, offsetof(peri_obstacle_desc, field), NULL}
#define VECTOR(field) {#field, RUN_VECTOR, offsetof(peri_obstacle_desc, field), NULL}
    static const run_key keys[] = {VECTOR(place), VECTOR(normal), VECTOR(axis), VECTOR(size), VECTOR(velocity), VECTOR(gravity),
        NUMBER(radius), NUMBER(length), NUMBER(stiffness), NUMBER(friction), NUMBER(friction_speed), NUMBER(restitution), NUMBER(mass),
        NUMBER(density), {NULL, 0, 0, NULL}};
#undef NUMBER
#undef VECTOR
    peri_obstacle_desc desc;
    int32_t shape = 0;
    if (run_take(&scene->deck, section, shape_key, 0, &shape) < 0) return -1;
    if (shape == 0) return run_fail_at(&scene->deck, section, NULL, "shape", "is missing");
    peri_obstacle_desc_init(&desc, shape);
    if (run_take(&scene->deck, section, keys, scene->dim, &desc) < 0) return -1;
    return run_must(scene, section, peri_add_obstacle(scene->body, &desc)) < 0 ? -1 : 0;
}

static int set_contact(run_scene *scene, run_section *section) {
    static const run_key keys[] = {{"stiffness", RUN_NUMBER, offsetof(peri_contact_desc, stiffness), NULL},
        {"distance", RUN_NUMBER, offsetof(peri_contact_desc, distance), NULL},
        {"friction", RUN_NUMBER, offsetof(peri_contact_desc, friction), NULL},
        {"restitution", RUN_NUMBER, offsetof(peri_contact_desc, restitution), NULL}, {NULL, 0, 0, NULL}};
    peri_contact_desc desc;
    peri_contact_desc_init(&desc);
    if (run_take(&scene->deck, section, keys, 0, &desc) < 0) return -1;
    return run_must(scene, section, peri_set_contact(scene->body, PERI_ALL, PERI_ALL, &desc)) < 0 ? -1 : 0;
}

/* Linearly up to the value at time `rise`. */
static int32_t ramp(void *user, double time, int64_t count, const int32_t *points, double *value) {
    const run_load *load = (const run_load *)user;
    const double    part = time < load->rise ? time / load->rise : 1.0;
    int64_t         k;
    (void)points;
    for (k = 0; k < count * load->dim; ++k) value[k] *= part;
    return 0;
}

static int axes_of(run_scene *scene, run_section *section, int32_t *axes) {
    static const run_choice choices[] = {{"x", PERI_AXIS_X}, {"y", PERI_AXIS_Y}, {"z", PERI_AXIS_Z}, {"xy", PERI_AXIS_XY},
        {"xz", PERI_AXIS_X | PERI_AXIS_Z}, {"yz", PERI_AXIS_Y | PERI_AXIS_Z}, {"xyz", PERI_AXIS_XYZ}, {NULL, 0}};
    static const run_key keys[] = {{"axes", RUN_CHOICE, 0, choices}, {NULL, 0, 0, NULL}};
    *axes = scene->dim == 2 ? PERI_AXIS_XY : PERI_AXIS_XYZ;
    return run_take(&scene->deck, section, keys, 0, axes);
}

static int64_t add_load(run_scene *scene, run_section *section, run_load *load) {
    peri_body   *body = scene->body;
    peri_load_fn fn = load->rise > 0 ? ramp : NULL;
    double       value[3] = {0, 0, 0}, normal[3], area;
    int32_t      axes;
    if (is(section, "displacement") || is(section, "velocity")) {
        if (axes_of(scene, section, &axes) < 0 || optional(scene, section, "value", scene->dim, value) < 0) return -1;
        return run_must(scene, section, is(section, "velocity") ? peri_prescribe_velocity(body, load->set, axes, value, fn, load)
                                                                : peri_prescribe_displacement(body, load->set, axes, value, fn, load));
    }
    if (is(section, "pressure")) {
        if (run_vector(&scene->deck, section, "value", 1, value) < 0) return -1;
        return run_must(scene, section, peri_apply_pressure(body, load->set, value[0], fn, load));
    }
    if (vector(scene, section, "value", value) < 0) return -1;
    if (is(section, "body_force")) return run_must(scene, section, peri_apply_body_force(body, load->set, value, fn, load));
    if (run_vector(&scene->deck, section, "area", 1, &area) < 0) return -1;
    if (is(section, "layer_traction")) return run_must(scene, section, peri_apply_layer_traction(body, load->set, area, value, fn, load));
    if (vector(scene, section, "normal", normal) < 0) return -1;
    return run_must(scene, section, peri_apply_traction(body, load->set, area, normal, value, fn, load));
}

static int new_load(run_scene *scene, run_section *section) {
    run_load *load = &scene->load[scene->loads];
    int64_t   id;
    int       k;
    if (scene->loads == RUN_LOADS) return run_fail_at(&scene->deck, section, NULL, "", "too many loads");
    for (k = 0; section->name[0] != 0 && k < scene->loads; ++k)
        if (run_same(scene->load[k].name, section->name)) return run_fail_at(&scene->deck, section, NULL, "", "a second load of this name");
    load->name = section->name;
    load->dim = is(section, "pressure") ? 1 : scene->dim;
    load->rise = 0;
    if (run_set_of(scene, section, &load->set) < 0 || optional(scene, section, "rise", 1, &load->rise) < 0) return -1;
    if (load->rise < 0) return run_fail_at(&scene->deck, section, run_find(section, "rise"), "rise", "is negative");
    id = add_load(scene, section, load);
    if (id < 0) return -1;
    load->id = (int32_t)id;
    ++scene->loads;
    return 0;
}

static int add_start(run_scene *scene, run_section *section) {
    double  value[3];
    int32_t set;
    if (run_set_of(scene, section, &set) < 0 || vector(scene, section, "value", value) < 0) return -1;
    return run_must(scene, section, is(section, "initial_velocity") ? peri_add_velocity(scene->body, set, value)
                                                                     : peri_add_displacement(scene->body, set, value)) < 0 ? -1 : 0;
}

int run_act(run_scene *scene, run_section *section) {
    static const char *const loads[] = {"displacement", "velocity", "traction", "layer_traction", "body_force", "pressure"};
    size_t k;
    int    result = 1;
    if (is(section, "set")) result = add_set(scene, section);
    else if (is(section, "cut")) result = add_cut(scene, section);
    else if (is(section, "obstacle")) result = add_obstacle(scene, section);
    else if (is(section, "contact")) result = set_contact(scene, section);
    else if (is(section, "initial_velocity") || is(section, "initial_displacement")) result = add_start(scene, section);
    else {
        for (k = 0; k < sizeof loads / sizeof *loads && !is(section, loads[k]); ++k) {}
        if (k == sizeof loads / sizeof *loads) return 0;
        result = new_load(scene, section);
    }
    return result < 0 ? -1 : 1;
}
