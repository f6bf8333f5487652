/* SPDX-License-Identifier: MIT */
/* scene.c - from a deck to a built body: its sections body, material, box, mesh. */
#include "run.h"
#include <stdlib.h>
#include <string.h>

int64_t run_must(run_scene *scene, run_section *section, int64_t result) {
    peri_error error;
    char       text[250];
    run_entry *entry;
    if (result >= 0) return result;
    memset(&error, 0, sizeof error);
    if (scene->body == NULL || peri_get_error(scene->body, &error) < 0 || error.code != (int32_t)result)
        return run_fail_at(&scene->deck, section, NULL, "", peri_status_text((int32_t)result));
    (void)peri_format_error(&error, text, (int64_t)sizeof text);
    entry = run_find(section, error.field);
    return run_fail_at(&scene->deck, section, entry, error.field, text);
}

static int is(const run_section *section, const char *kind) { return run_same(section->kind, kind); }

static int fail(run_scene *scene, const run_section *section, const char *key, const char *text) {
    return run_fail_at(&scene->deck, section, NULL, key, text);
}

static int make_body(run_scene *scene, run_section *section) {
    static const run_choice spaces[] = {{"plane_stress", PERI_SPACE_PLANE_STRESS}, {"plane_strain", PERI_SPACE_PLANE_STRAIN},
                                        {"solid", PERI_SPACE_SOLID}, {NULL, 0}};
    static const run_choice precisions[] = {{"double", PERI_PRECISION_DOUBLE}, {"mixed", PERI_PRECISION_MIXED},
                                            {"single", PERI_PRECISION_SINGLE}, {NULL, 0}};
    static const run_choice geometries[] = {{"nonlinear", PERI_GEOMETRY_NONLINEAR}, {"linear", PERI_GEOMETRY_LINEAR}, {NULL, 0}};
    static const run_choice influences[] = {{"constant", PERI_INFLUENCE_CONSTANT}, {"cutoff", PERI_INFLUENCE_CUTOFF},
        {"linear", PERI_INFLUENCE_LINEAR}, {"cubic", PERI_INFLUENCE_CUBIC}, {"quintic", PERI_INFLUENCE_QUINTIC},
        {"septic", PERI_INFLUENCE_SEPTIC}, {"power_2", PERI_INFLUENCE_POWER_2}, {"power_3", PERI_INFLUENCE_POWER_3},
        {"gaussian", PERI_INFLUENCE_GAUSSIAN}, {"proportional", PERI_INFLUENCE_PROPORTIONAL}, {"inverse", PERI_INFLUENCE_INVERSE},
        {NULL, 0}};
    static const run_choice quadratures[] = {{"full", PERI_QUADRATURE_FULL}, {"ramp", PERI_QUADRATURE_RAMP},
        {"partial", PERI_QUADRATURE_PARTIAL}, {"partial_centroid", PERI_QUADRATURE_PARTIAL_CENTROID},
        {"partial_moment", PERI_QUADRATURE_PARTIAL_MOMENT}, {NULL, 0}};
    static const run_choice corrections[] = {{"none", PERI_CORRECTION_NONE}, {"volume", PERI_CORRECTION_VOLUME},
        {"energy", PERI_CORRECTION_ENERGY}, {"moment", PERI_CORRECTION_MOMENT},
        {"equilibrium", PERI_CORRECTION_EQUILIBRIUM}, {NULL, 0}};
    static const run_choice timings[] = {{"within_step", PERI_BREAK_WITHIN_STEP}, {"after_drift", PERI_BREAK_AFTER_DRIFT}, {NULL, 0}};
    static const run_key keys[] = {{"space", RUN_CHOICE, offsetof(peri_body_desc, space), spaces},
        {"precision", RUN_CHOICE, offsetof(peri_body_desc, precision), precisions},
        {"geometry", RUN_CHOICE, offsetof(peri_body_desc, geometry), geometries},
        {"influence", RUN_CHOICE, offsetof(peri_body_desc, influence), influences},
        {"quadrature", RUN_CHOICE, offsetof(peri_body_desc, quadrature), quadratures},
        {"correction", RUN_CHOICE, offsetof(peri_body_desc, correction), corrections},
        {"break_timing", RUN_CHOICE, offsetof(peri_body_desc, break_timing), timings},
        {"threads", RUN_I32, offsetof(peri_body_desc, threads), NULL}, {"horizon", RUN_NUMBER, offsetof(peri_body_desc, horizon), NULL},
        {"thickness", RUN_NUMBER, offsetof(peri_body_desc, thickness), NULL}, {NULL, 0, 0, NULL}};
    peri_body_desc desc;
    peri_error     error;
    char           text[250];
    if (scene->body != NULL) return fail(scene, section, "", "a second body");
    peri_body_desc_init(&desc);
    if (run_take(&scene->deck, section, keys, 0, &desc) < 0 || run_all_used(&scene->deck, section) < 0) return -1;
    if (peri_body_create(&desc, &scene->body, &error) < 0) {
        (void)peri_format_error(&error, text, (int64_t)sizeof text);
        return run_fail_at(&scene->deck, section, run_find(section, error.field), error.field, text);
    }
    scene->dim = peri_dimension(scene->body);
    return 0;
}

static int make_material(run_scene *scene, run_section *section) {
    static const run_choice laws[] = {{"bond_based", PERI_LAW_BOND_BASED}, {"lps", PERI_LAW_LPS}, {"oterkus", PERI_LAW_OTERKUS},
                                      {"correspondence", PERI_LAW_CORRESPONDENCE}, {NULL, 0}};
    static const run_choice criteria[] = {{"stretch", PERI_CRITERION_STRETCH}, {"bond_energy", PERI_CRITERION_BOND_ENERGY},
        {"node_energy", PERI_CRITERION_NODE_ENERGY}, {"principal_stress", PERI_CRITERION_PRINCIPAL_STRESS},
        {"von_mises", PERI_CRITERION_VON_MISES}, {"mohr_coulomb", PERI_CRITERION_MOHR_COULOMB},
        {"confined_stretch", PERI_CRITERION_CONFINED_STRETCH}, {"rate_stretch", PERI_CRITERION_RATE_STRETCH},
        {"delayed_stretch", PERI_CRITERION_DELAYED_STRETCH}, {NULL, 0}};
#define NUMBER(field) {#field, RUN_NUMBER, offsetof(peri_material_desc, field), NULL}
    static const run_key keys[] = {{"law", RUN_CHOICE, offsetof(peri_material_desc, law), laws},
        {"criterion", RUN_CHOICE, offsetof(peri_material_desc, criterion), criteria}, NUMBER(young), NUMBER(bulk), NUMBER(poisson),
        NUMBER(density), NUMBER(fracture_energy), NUMBER(critical_stretch), NUMBER(stabilization), NUMBER(strength), NUMBER(cohesion),
        NUMBER(friction_angle), NUMBER(compression), NUMBER(rate), NUMBER(rate_power), NUMBER(delay), NUMBER(yield_shear),
        {NULL, 0, 0, NULL}};
#undef NUMBER
    peri_material_desc desc;
    int64_t id;
    int     k;
    if (scene->materials == RUN_MATERIALS) return fail(scene, section, "", "too many materials");
    for (k = 0; k < scene->materials; ++k)
        if (run_same(scene->material_name[k], section->name)) return fail(scene, section, "", "a second material of this name");
    peri_material_desc_init(&desc, PERI_LAW_BOND_BASED);
    if (run_take(&scene->deck, section, keys, 0, &desc) < 0 || run_all_used(&scene->deck, section) < 0) return -1;
    id = run_must(scene, section, peri_add_material(scene->body, &desc));
    if (id < 0) return -1;
    scene->material_name[scene->materials] = section->name;
    scene->material[scene->materials++] = (int32_t)id;
    return 0;
}

static int find_material(run_scene *scene, run_section *section, const run_entry *entry, const char *name, int32_t *id) {
    int k;
    for (k = 0; k < scene->materials; ++k)
        if (run_same(scene->material_name[k], name)) {
            *id = scene->material[k];
            return 0;
        }
    return run_fail_at(&scene->deck, section, entry, "material", "no section [material] has this name");
}

/* The material that a section names; the first one where it names none. */
static int material_of(run_scene *scene, run_section *section, int32_t *id) {
    run_entry *entry = run_find(section, "material");
    if (scene->materials == 0) return fail(scene, section, "material", "the deck has no section [material]");
    *id = scene->material[0];
    return entry == NULL ? 0 : find_material(scene, section, entry, entry->value[0], id);
}

typedef struct balls { /* that are left out of a box */
    int    count, dim;
    double ball[RUN_TOKENS][4];
} balls;

static int32_t outside(void *user, int64_t index, const double *x) {
    const balls *b = (const balls *)user;
    int k, d;
    (void)index;
    for (k = 0; k < b->count; ++k) {
        double square = 0;
        for (d = 0; d < b->dim; ++d) square += (x[d] - b->ball[k][d]) * (x[d] - b->ball[k][d]);
        if (square <= b->ball[k][b->dim] * b->ball[k][b->dim]) return 0;
    }
    return 1;
}

static int add_box(run_scene *scene, run_section *section) {
    double  lo[3], hi[3], spacing;
    balls   out;
    int32_t material;
    int64_t k, result;
    out.count = 0;
    out.dim = scene->dim;
    if (run_vector(&scene->deck, section, "lo", scene->dim, lo) < 0 || run_vector(&scene->deck, section, "hi", scene->dim, hi) < 0 ||
        run_vector(&scene->deck, section, "spacing", 1, &spacing) < 0 || material_of(scene, section, &material) < 0)
        return -1;
    for (k = 0; k < section->entries; ++k) {
        run_entry *entry = &section->entry[k];
        int        v;
        if (!run_same(entry->key, "without_ball")) continue;
        entry->used = 1;
        if (entry->count != scene->dim + 1 || out.count == RUN_TOKENS)
            return run_fail_at(&scene->deck, section, entry, entry->key, "is a centre and a radius");
        for (v = 0; v <= scene->dim; ++v)
            if (run_number(entry->value[v], &out.ball[out.count][v]) < 0)
                return run_fail_at(&scene->deck, section, entry, entry->key, "is not a finite number");
        ++out.count;
    }
    if (run_all_used(&scene->deck, section) < 0) return -1;
    result = out.count == 0 ? peri_add_box(scene->body, material, lo, hi, spacing)
                            : peri_add_shape(scene->body, material, lo, hi, spacing, outside, &out);
    return run_must(scene, section, result) < 0 ? -1 : 0;
}

/* ---- clouds and meshes */

static int format_of(run_scene *scene, run_section *section, const char *path, int32_t *format) {
    static const run_choice formats[] = {{"gmsh", RUN_FORMAT_GMSH}, {"abaqus", RUN_FORMAT_ABAQUS}, {"peridigm", RUN_FORMAT_PERIDIGM},
                                         {"lammps", RUN_FORMAT_LAMMPS}, {NULL, 0}};
    static const run_choice ends[] = {{".msh", RUN_FORMAT_GMSH}, {".inp", RUN_FORMAT_ABAQUS}, {".txt", RUN_FORMAT_PERIDIGM},
                                      {".data", RUN_FORMAT_LAMMPS}, {NULL, 0}};
    static const run_key keys[] = {{"format", RUN_CHOICE, 0, formats}, {NULL, 0, 0, NULL}};
    const char *dot = strrchr(path, '.');
    int k;
    *format = 0;
    if (run_take(&scene->deck, section, keys, 0, format) < 0) return -1;
    for (k = 0; *format == 0 && dot != NULL && ends[k].name != NULL; ++k)
        if (run_same(dot, ends[k].name)) *format = ends[k].value;
    return *format != 0 ? 0 : fail(scene, section, "format", "is needed: the file ends with none of .msh .inp .txt .data");
}

/* A path in a deck is relative to the folder of the deck. */
static int path_beside(run_scene *scene, run_section *section, const char *file, char *path) {
    const char *deck = scene->deck.text.path, *slash = strrchr(deck, '/');
    const size_t head = slash == NULL || file[0] == '/' ? 0 : (size_t)(slash - deck) + 1;
    if (head + strlen(file) >= RUN_PATH) return fail(scene, section, "file", "the path is too long");
    memcpy(path, deck, head);
    memcpy(path + head, file, strlen(file) + 1);
    return 0;
}

/* Materials by sets: material_of SET MATERIAL; sets of the file become sets of the body after the build (select_sets). */
static int materials_of_sets(run_scene *scene, run_section *section, run_cloud *cloud, int32_t *material) {
    int64_t k, i;
    for (k = 0; k < section->entries; ++k) {
        run_entry *entry = &section->entry[k];
        run_set   *set;
        int32_t    id = 0;
        if (!run_same(entry->key, "material_of")) continue;
        entry->used = 1;
        if (entry->count != 2) return run_fail_at(&scene->deck, section, entry, entry->key, "is a set and a material");
        set = run_find_set(cloud, entry->value[0]);
        if (set == NULL) return run_fail_at(&scene->deck, section, entry, entry->key, "no set of the file has this name");
        if (find_material(scene, section, entry, entry->value[1], &id) < 0) return -1;
        for (i = 0; i < set->count; ++i) material[set->points[i]] = id;
    }
    return 0;
}

static int scale_cloud(run_scene *scene, run_section *section, run_cloud *cloud) {
    double  scale = 1, volume = 0;
    int64_t k;
    const int given = run_find(section, "volume") != NULL;
    if (run_find(section, "scale") != NULL && run_vector(&scene->deck, section, "scale", 1, &scale) < 0) return -1;
    if (scale <= 0) return run_fail_at(&scene->deck, section, run_find(section, "scale"), "scale", "is not above 0");
    if (given && run_vector(&scene->deck, section, "volume", 1, &volume) < 0) return -1;
    for (k = 0; k < 3 * cloud->corners; ++k) cloud->corner[k] *= scale;
    for (k = 0; k < cloud->count; ++k) {
        double *x = cloud->place + 3 * k;
        const int missing = cloud->volume[k] != cloud->volume[k];
        if (missing && !given) return fail(scene, section, "volume", "is needed: the file gives none");
        if (!missing && given) return run_fail_at(&scene->deck, section, run_find(section, "volume"), "volume", "the file gives its own");
        x[0] *= scale, x[1] *= scale, x[2] *= scale;
        cloud->volume[k] = missing ? volume : cloud->volume[k] * (scene->dim == 3 ? scale * scale * scale : scale * scale);
        if (scene->dim == 2) cloud->place[2 * k] = x[0], cloud->place[2 * k + 1] = x[1];
    }
    return 0;
}

/* The cells of a mesh, whose points and volumes the library finds, too. */
static int64_t add_cells(run_scene *scene, const run_cloud *cloud, const int32_t *materials) {
    peri_cells_desc d;
    int32_t *corner = (int32_t *)malloc((size_t)cloud->corners * sizeof *corner);
    int64_t *offset = (int64_t *)malloc(((size_t)cloud->count + 1) * sizeof *offset), k, result = PERI_ERROR_MEMORY;
    peri_cells_desc_init(&d);
    if (corner != NULL && offset != NULL) {
        for (k = 0; k < cloud->corners; ++k) corner[k] = (int32_t)k;
        for (k = 0; k <= cloud->count; ++k) offset[k] = k == 0 ? 0 : cloud->last[k - 1];
        d.vertex_count = cloud->corners;
        d.vertices = cloud->corner;
        d.vertex_stride = 3;
        d.cell_count = cloud->count;
        d.corners = corner;
        d.offsets = offset;
        d.materials = materials;
        result = peri_add_cells(scene->body, &d);
    }
    free(corner);
    free(offset);
    return result;
}

static int add_cloud(run_scene *scene, run_section *section, run_cloud *cloud) {
    int32_t material = 0, *materials = (int32_t *)malloc(((size_t)cloud->count + 1) * sizeof *materials);
    int64_t k;
    int     result = materials == NULL ? fail(scene, section, "file", "no memory") : material_of(scene, section, &material);
    for (k = 0; result == 0 && k < cloud->count; ++k) materials[k] = material;
    if (result == 0) result = scale_cloud(scene, section, cloud);
    if (result == 0) result = materials_of_sets(scene, section, cloud, materials);
    if (result == 0) result = run_all_used(&scene->deck, section);
    if (result == 0 && run_must(scene, section, cloud->corner != NULL ? add_cells(scene, cloud, materials)
                                : peri_add_points(scene->body, cloud->count, cloud->place, cloud->volume, materials)) < 0)
        result = -1;
    free(materials);
    return result;
}

static int read_cloud(run_scene *scene, run_section *section, run_cloud *cloud) {
    char        path[RUN_PATH];
    const char *file;
    run_text    text;
    int32_t     format;
    int         result;
    memset(cloud, 0, sizeof *cloud);
    if (run_string(&scene->deck, section, "file", &file) < 0 || path_beside(scene, section, file, path) < 0 ||
        format_of(scene, section, file, &format) < 0)
        return -1;
    result = run_text_open(&text, path, scene->fault);
    if (result == 0) result = run_read_cloud(&text, format, scene->dim, cloud);
    run_text_close(&text);
    return result;
}

static int select_sets(run_scene *scene, run_section *section, run_cloud *cloud, int64_t first) {
    int64_t k, i;
    for (k = 0; k < cloud->sets; ++k) {
        run_set *set = &cloud->set[k];
        if (set->count == 0) continue;
        for (i = 0; i < set->count; ++i) set->points[i] += (int32_t)first;
        if (run_must(scene, section, peri_select_points(scene->body, set->name, set->count, set->points)) < 0) return -1;
    }
    return 0;
}

/* ---- the whole scene */

static int add_points(run_scene *scene, run_cloud *clouds, int64_t *first) {
    run_deck *deck = &scene->deck;
    int64_t   k;
    for (k = 0; k < deck->sections; ++k) {
        run_section *section = &deck->section[k];
        first[k] = peri_point_count(scene->body);
        if (is(section, "box") && add_box(scene, section) < 0) return -1;
        if (is(section, "mesh") && (read_cloud(scene, section, &clouds[k]) < 0 || add_cloud(scene, section, &clouds[k]) < 0)) return -1;
    }
    return 0;
}

static int build(run_scene *scene) {
    run_deck  *deck = &scene->deck;
    run_cloud *clouds = (run_cloud *)calloc((size_t)deck->sections, sizeof *clouds);
    int64_t   *first = (int64_t *)calloc((size_t)deck->sections, sizeof *first), k;
    int        result = clouds == NULL || first == NULL ? fail(scene, deck->section, "", "no memory") : add_points(scene, clouds, first);
    for (k = 0; k < deck->sections && result == 0; ++k)
        if (is(&deck->section[k], "body") && run_must(scene, &deck->section[k], peri_build(scene->body)) < 0) result = -1;
    for (k = 0; clouds != NULL && k < deck->sections; ++k) {
        if (result == 0 && select_sets(scene, &deck->section[k], &clouds[k], first[k]) < 0) result = -1;
        run_free_cloud(&clouds[k]);
    }
    free(clouds);
    free(first);
    return result;
}

int run_scene_make(run_scene *scene) {
    run_deck *deck = &scene->deck;
    int64_t   k;
    int       acts;
    for (k = 0; k < deck->sections; ++k)
        if (is(&deck->section[k], "body") && make_body(scene, &deck->section[k]) < 0) return -1;
    if (scene->body == NULL) return run_fail(scene->fault, deck->text.path, 0, "[body]", "the deck has no such section");
    for (k = 0; k < deck->sections; ++k)
        if (is(&deck->section[k], "material") && make_material(scene, &deck->section[k]) < 0) return -1;
    if (build(scene) < 0) return -1;
    for (k = 0; k < deck->sections; ++k) {
        run_section *section = &deck->section[k];
        if (is(section, "body") || is(section, "material") || is(section, "box") || is(section, "mesh") || is(section, "run") ||
            is(section, "solve"))
            continue;
        if (is(section, "output")) {
            if (scene->output != NULL) return fail(scene, section, "", "a second one");
            scene->output = section;
            continue;
        }
        acts = run_act(scene, section);
        if (acts == 0) return fail(scene, section, "", "no such section");
        if (acts < 0 || run_all_used(deck, section) < 0) return -1;
    }
    return 0;
}

static void begin(run_scene *scene, const char *directory, int quiet, run_fault *fault) {
    memset(scene, 0, sizeof *scene);
    scene->fault = fault;
    scene->directory = directory;
    scene->quiet = quiet;
}

int run_scene_read(run_scene *scene, const char *path, const char *directory, int quiet, run_fault *fault) {
    begin(scene, directory, quiet, fault);
    if (run_deck_read(&scene->deck, path, fault) < 0 || run_scene_make(scene) < 0) return -1;
    return run_scene_run(scene);
}

int run_scene_of(run_scene *scene, const char *bytes, size_t size, const char *path, const char *directory, int quiet, run_fault *fault) {
    begin(scene, directory, quiet, fault);
    if (run_deck_of(&scene->deck, bytes, size, path, fault) < 0 || run_scene_make(scene) < 0) return -1;
    return run_scene_run(scene);
}

void run_scene_free(run_scene *scene) {
    peri_body_destroy(scene->body);
    scene->body = NULL;
    free(scene->field);
    scene->field = NULL;
    if (scene->curve != NULL) (void)fclose(scene->curve);
    scene->curve = NULL;
    run_deck_free(&scene->deck);
}
