/* SPDX-License-Identifier: MIT */
/* result.c - runs by time and equilibria in the order of the deck, the progress line, and what is written. */
#include "run.h"
#include "../../extras/peri_view.h"
#include <stdlib.h>
#include <string.h>

static int is(const run_section *section, const char *kind) { return run_same(section->kind, kind); }

/* 1 and the path of an entry of [output]; 0: not asked for. */
static int path_of(run_scene *scene, const char *key, char *path) {
    const char *file;
    size_t      head;
    if (scene->output == NULL || run_find(scene->output, key) == NULL) return 0;
    if (run_string(&scene->deck, scene->output, key, &file) < 0) return -1;
    head = strlen(scene->directory);
    if (head + strlen(file) + 2 > RUN_PATH)
        return run_fail_at(&scene->deck, scene->output, run_find(scene->output, key), key, "the path is too long");
    memcpy(path, scene->directory, head);
    path[head] = '/';
    memcpy(path + head + 1, file, strlen(file) + 1);
    return 1;
}

static int cannot_write(run_scene *scene, const char *key) {
    return run_fail_at(&scene->deck, scene->output, run_find(scene->output, key), key, "the file cannot be written");
}

/* ---- the reaction of a load or support over time or load factor */

static int begin_curve(run_scene *scene) {
    char        path[RUN_PATH];
    const char *name;
    int         k, asked = path_of(scene, "curve", path);
    if (asked <= 0) return asked;
    if (run_string(&scene->deck, scene->output, "curve_of", &name) < 0) return -1;
    for (k = 0; k < scene->loads && scene->curve_load == NULL; ++k)
        if (run_same(scene->load[k].name, name)) scene->curve_load = &scene->load[k];
    if (scene->curve_load == NULL)
        return run_fail_at(&scene->deck, scene->output, run_find(scene->output, "curve_of"), "curve_of", "no load has this name");
    scene->field = (double *)malloc((size_t)peri_size_of_field(scene->body, PERI_FIELD_DISPLACEMENT) * sizeof *scene->field);
    if (scene->field == NULL) return run_fail_at(&scene->deck, scene->output, NULL, "curve", "no memory");
    scene->curve = fopen(path, "wb");
    if (scene->curve == NULL) return cannot_write(scene, "curve");
    (void)fprintf(scene->curve, "time,load factor,%sforce x,force y%s,broken bonds\n",
                  scene->dim == 2 ? "mean u x,mean u y," : "mean u x,mean u y,mean u z,", scene->dim == 2 ? "" : ",force z");
    return 0;
}

static int mean_of_set(run_scene *scene, double *mean) {
    const int32_t set = scene->curve_load->set;
    const int64_t all = peri_point_count(scene->body), count = set == PERI_ALL ? all : peri_size_of_set(scene->body, set);
    int32_t      *points = (int32_t *)malloc((size_t)count * sizeof *points);
    int64_t       k;
    int           d, failed = points == NULL;
    failed = failed || peri_get_field(scene->body, PERI_FIELD_DISPLACEMENT, scene->field, all * scene->dim) < 0;
    failed = failed || (set != PERI_ALL && peri_get_set(scene->body, set, points, count) < 0);
    for (k = 0; !failed && k < count; ++k)
        for (d = 0; d < scene->dim; ++d)
            mean[d] += scene->field[(set == PERI_ALL ? k : points[k]) * scene->dim + d] / (double)count;
    free(points);
    return failed ? -1 : 0;
}

static int curve_row(run_scene *scene) {
    double mean[3] = {0, 0, 0}, force[3] = {0, 0, 0};
    int    d;
    if (mean_of_set(scene, mean) < 0 || peri_get_reaction(scene->body, scene->curve_load->id, force) < 0) return -1;
    (void)fprintf(scene->curve, "%.12g,%.12g", peri_time(scene->body), peri_load_factor(scene->body));
    for (d = 0; d < scene->dim; ++d) (void)fprintf(scene->curve, ",%.12g", mean[d]);
    for (d = 0; d < scene->dim; ++d) (void)fprintf(scene->curve, ",%.12g", force[d]);
    (void)fprintf(scene->curve, ",%lld\n", (long long)peri_broken_count(scene->body));
    return ferror(scene->curve) ? -1 : 0;
}

/* ---- running */

static void show(run_scene *scene, int percent, const char *more) {
    if (scene->quiet || (percent == scene->shown && more[0] == 0)) return;
    scene->shown = percent;
    (void)fprintf(stderr, "\r%-6s %3d %%  step %lld  t = %.4g s  broken %lld%s ", scene->now->kind, percent,
                  (long long)peri_step_count(scene->body), peri_time(scene->body), (long long)peri_broken_count(scene->body), more);
    if (percent == 100) (void)fputc('\n', stderr);
    (void)fflush(stderr);
}

static int32_t frame(void *user, peri_body *body) {
    run_scene *scene = (run_scene *)user;
    char       path[RUN_PATH];
    const double at = is(scene->now, "solve") ? peri_load_factor(body) : scene->by_steps ? (double)peri_step_count(body) : peri_time(body);
    const double done = scene->length != 0 ? 100.0 * (at - scene->begun) / scene->length : 0.0;
    if (path_of(scene, "history", path) > 0 && peri_export_history(body, path, 1) < 0) return -1;
    if (scene->curve != NULL && curve_row(scene) < 0) return -1;
    show(scene, done > 0 && done < 101 ? (int)(done + 1e-6) : 0, "");
    return 0;
}

static int32_t iteration(void *user, int64_t count, double residual) {
    run_scene *scene = (run_scene *)user;
    char       more[60];
    if (count % 50 != 0 || scene->quiet) return 0;
    (void)snprintf(more, sizeof more, "  iteration %lld  residual %.1e", (long long)count, residual);
    show(scene, scene->shown > 0 ? scene->shown : 0, more);
    return 0;
}

static int run_by_time(run_scene *scene, run_section *section) {
    static const run_choice integrators[] = {{"velocity_verlet", PERI_INTEGRATOR_VELOCITY_VERLET},
                                             {"central_difference", PERI_INTEGRATOR_CENTRAL_DIFFERENCE}, {NULL, 0}};
    static const run_key keys[] = {{"duration", RUN_NUMBER, offsetof(peri_advance_desc, duration), NULL},
        {"time_step", RUN_NUMBER, offsetof(peri_advance_desc, time_step), NULL},
        {"safety", RUN_NUMBER, offsetof(peri_advance_desc, safety), NULL},
        {"damping", RUN_NUMBER, offsetof(peri_advance_desc, damping), NULL},
        {"load_factor", RUN_NUMBER, offsetof(peri_advance_desc, load_factor), NULL},
        {"steps", RUN_I64, offsetof(peri_advance_desc, steps), NULL},
        {"frame_steps", RUN_I64, offsetof(peri_advance_desc, frame_steps), NULL},
        {"integrator", RUN_CHOICE, offsetof(peri_advance_desc, integrator), integrators}, {NULL, 0, 0, NULL}};
    peri_advance_desc desc;
    peri_advance_desc_init(&desc);
    desc.frame_steps = 20;
    if (run_take(&scene->deck, section, keys, 0, &desc) < 0 || run_all_used(&scene->deck, section) < 0) return -1;
    desc.on_frame = frame;
    desc.user = scene;
    scene->length = desc.steps > 0 ? (double)desc.steps : desc.duration;
    scene->by_steps = desc.steps > 0;
    scene->begun = scene->by_steps ? (double)peri_step_count(scene->body) : peri_time(scene->body);
    return run_must(scene, section, peri_advance(scene->body, &desc)) < 0 ? -1 : 0;
}

static int run_to_equilibrium(run_scene *scene, run_section *section) {
    static const run_choice methods[] = {{"newton", PERI_METHOD_NEWTON}, {"bicgstab", PERI_METHOD_BICGSTAB},
                                         {"relaxation", PERI_METHOD_RELAXATION}, {NULL, 0}};
    static const run_choice preconditioners[] = {{"multilevel", PERI_PRECONDITIONER_MULTILEVEL},
        {"block_jacobi", PERI_PRECONDITIONER_BLOCK_JACOBI}, {"none", PERI_PRECONDITIONER_NONE}, {NULL, 0}};
    static const run_choice loose[] = {{"refused", PERI_LOOSE_REFUSED}, {"pinned", PERI_LOOSE_PINNED}, {"balanced", PERI_LOOSE_BALANCED},
                                       {NULL, 0}};
    static const run_choice controls[] = {{"load", PERI_CONTROL_LOAD}, {"fracture", PERI_CONTROL_FRACTURE}, {NULL, 0}};
#define KEY(kind, field) {#field, kind, offsetof(peri_solve_desc, field), NULL}
    static const run_key keys[] = {{"method", RUN_CHOICE, offsetof(peri_solve_desc, method), methods},
        {"preconditioner", RUN_CHOICE, offsetof(peri_solve_desc, preconditioner), preconditioners},
        {"loose", RUN_CHOICE, offsetof(peri_solve_desc, loose), loose},
        {"control", RUN_CHOICE, offsetof(peri_solve_desc, control), controls},
        KEY(RUN_I32, fracture), KEY(RUN_NUMBER, criticality), KEY(RUN_NUMBER, tolerance), KEY(RUN_I64, iterations), KEY(RUN_I64, newton),
        KEY(RUN_I64, breaks), KEY(RUN_NUMBER, load_from), KEY(RUN_NUMBER, load_to), KEY(RUN_I64, steps), KEY(RUN_NUMBER, duration),
        KEY(RUN_I64, halvings), {NULL, 0, 0, NULL}};
#undef KEY
    peri_solve_desc   desc;
    peri_solve_report report;
    peri_solve_desc_init(&desc);
    if (run_take(&scene->deck, section, keys, 0, &desc) < 0 || run_all_used(&scene->deck, section) < 0) return -1;
    desc.on_step = frame;
    desc.on_iteration = iteration;
    desc.user = scene;
    scene->length = desc.load_to;
    scene->begun = 0;
    if (run_must(scene, section, peri_solve(scene->body, &desc, &report)) < 0) return -1;
    if (!scene->quiet)
        (void)printf("equilibrium: load factor %.6g, %lld iterations, residual %.1e, %lld bonds broken\n", report.load_factor,
                     (long long)report.iterations, report.residual, (long long)report.broken);
    return 0;
}

/* ---- what is written at the end */

static int draw(run_scene *scene, const char *path) {
    static const run_choice fields[] = {{"displacement", PERI_FIELD_DISPLACEMENT}, {"velocity", PERI_FIELD_VELOCITY},
        {"damage", PERI_FIELD_DAMAGE}, {"damage_grown", PERI_FIELD_DAMAGE_GROWN}, {"energy_density", PERI_FIELD_ENERGY_DENSITY},
        {"strain", PERI_FIELD_STRAIN}, {"stress", PERI_FIELD_STRESS}, {"fragment", PERI_FIELD_FRAGMENT}, {"material", PERI_FIELD_MATERIAL},
        {NULL, 0}};
    static const run_key keys[] = {{"field", RUN_CHOICE, offsetof(peri_picture_desc, field), fields},
        {"component", RUN_I32, offsetof(peri_picture_desc, component), NULL}, {"width", RUN_I32, offsetof(peri_picture_desc, width), NULL},
        {"along", RUN_I32, offsetof(peri_picture_desc, along), NULL}, {"magnify", RUN_NUMBER, offsetof(peri_picture_desc, magnify), NULL},
        {"range_lo", RUN_NUMBER, offsetof(peri_picture_desc, lo), NULL}, {"range_hi", RUN_NUMBER, offsetof(peri_picture_desc, hi), NULL},
        {NULL, 0, 0, NULL}};
    peri_picture_desc desc;
    peri_picture_desc_init(&desc);
    desc.length_unit = "m";
    if (run_take(&scene->deck, scene->output, keys, 0, &desc) < 0 || run_all_used(&scene->deck, scene->output) < 0) return -1;
    if (path != NULL && peri_picture_save(path, scene->body, &desc) < 0) return cannot_write(scene, "picture");
    return 0;
}

/* probe NAME x y [z]: the displacement and velocity of the nearest point. */
static int probe(run_scene *scene, run_entry *entry) {
    double       place[3], u[3] = {0, 0, 0};
    const int    dim = scene->dim;
    peri_view    view;
    int32_t      point;
    int          d;
    if (entry->count != dim + 1) return run_fail_at(&scene->deck, scene->output, entry, "probe", "is a name and a place");
    for (d = 0; d < dim; ++d)
        if (run_number(entry->value[d + 1], &place[d]) < 0)
            return run_fail_at(&scene->deck, scene->output, entry, "probe", "is not a finite number");
    point = (int32_t)run_must(scene, scene->output, peri_find_point(scene->body, place));
    if (point < 0 || run_must(scene, scene->output, peri_view_field(scene->body, PERI_FIELD_DISPLACEMENT, &view)) < 0) return -1;
    for (d = 0; d < dim; ++d) {
        const int64_t at = point * view.point_stride + d * view.component_stride;
        u[d] = view.offset[d] + view.scale * (view.type == PERI_TYPE_F32 ? (double)((const float *)view.data)[at]
                                                                        : ((const double *)view.data)[at]);
    }
    if (dim == 2) (void)printf("probe %s point %ld u %.12g %.12g\n", entry->value[0], (long)point, u[0], u[1]);
    else (void)printf("probe %s point %ld u %.12g %.12g %.12g\n", entry->value[0], (long)point, u[0], u[1], u[2]);
    return 0;
}

static int write_results(run_scene *scene) {
    char    vtu[RUN_PATH], picture[RUN_PATH];
    int64_t k;
    const int with_vtu = path_of(scene, "vtu", vtu), drawn = path_of(scene, "picture", picture);
    if (scene->output == NULL) return 0;
    if (with_vtu < 0 || drawn < 0) return -1;
    if (with_vtu > 0 && run_must(scene, scene->output, peri_export_vtu(scene->body, vtu)) < 0) return cannot_write(scene, "vtu");
    for (k = 0; k < scene->output->entries; ++k)
        if (run_same(scene->output->entry[k].key, "probe") && probe(scene, &scene->output->entry[k]) < 0) return -1;
    if (draw(scene, drawn > 0 ? picture : NULL) < 0) return -1;
    if (scene->curve != NULL) {
        FILE *curve = scene->curve;
        scene->curve = NULL;
        if (fclose(curve) != 0) return cannot_write(scene, "curve");
    }
    return 0;
}

/* Keys of [output] are looked at before anything runs: a run may be long. */
static int check_output(run_scene *scene) {
    char    path[RUN_PATH];
    int64_t k;
    int     asked;
    if (scene->output == NULL) return 0;
    for (k = 0; k < scene->output->entries; ++k)
        if (run_same(scene->output->entry[k].key, "probe")) scene->output->entry[k].used = 1;
    if (begin_curve(scene) < 0 || path_of(scene, "vtu", path) < 0 || path_of(scene, "picture", path) < 0) return -1;
    asked = path_of(scene, "history", path);
    if (asked < 0 || draw(scene, NULL) < 0) return -1;
    if (asked > 0 && peri_export_history(scene->body, path, 0) < 0) return cannot_write(scene, "history");
    return 0;
}

int run_scene_run(run_scene *scene) {
    run_deck *deck = &scene->deck;
    int64_t   k;
    if (check_output(scene) < 0) return -1;
    for (k = 0; k < deck->sections; ++k) {
        run_section *section = &deck->section[k];
        if (!is(section, "run") && !is(section, "solve")) continue;
        scene->now = section;
        scene->shown = -1;
        if ((is(section, "run") ? run_by_time : run_to_equilibrium)(scene, section) < 0) return -1;
    }
    if (!scene->quiet)
        (void)printf("%lld points, %lld bonds, %lld cut, %lld broken in %lld steps, t = %.6g s\n", (long long)peri_point_count(scene->body),
                     (long long)peri_bond_count(scene->body), (long long)peri_cut_count(scene->body),
                     (long long)peri_broken_count(scene->body), (long long)peri_step_count(scene->body), peri_time(scene->body));
    return write_results(scene);
}
