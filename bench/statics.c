/* SPDX-License-Identifier: MIT */
/* statics.c - what a static solve costs: `statics [--large]`. Tables, and CSV (out/statics.csv).

   1  plates of LPS, plane stress, nu = 0.3, horizon 3 spacings, linear, clamped at three columns on the left and pulled at the last on
      the right, to a residual of 1e-8: iterations, time, and the number of evaluations of all bonds that the time equals, for each
      preconditioner
   2  blocks of LPS, nu = 0.25, horizon 3, linear, one thread: three layers clamped at x = 0, three at x = 1 pulled by 0.001 (y, z held),
      to 1e-6. To beat: 40^3 in 3 s, 60 MB with all that the body holds. Peridigm 1.5 takes for 40^3 151 s on two cores; for 20^3 17 s
      matrix-free, 160 s and 1.45 GB with its tangent assembled
   3  with --large: a block of 100^3, pulled alike

   Bytes are counted by an allocator hook: the body with all of its state, and the most that there was at a time. */
#include "bench.h"

static peri_body *block(int32_t space, int64_t edge, double poisson, int32_t precision) {
    const double lo[3] = { 0, 0, 0 }, hi[3] = { 1, 1, 1 };
    peri_body_desc desc;
    peri_material_desc material;
    peri_body *body = NULL;
    peri_body_desc_init(&desc);
    desc.space = space;
    desc.geometry = PERI_GEOMETRY_LINEAR;
    desc.precision = precision;
    desc.horizon = 3.0 / (double)edge;
    desc.threads = 1;
    desc.allocate = count_allocate;
    desc.release = count_release;
    bytes_now = bytes_most = 0;
    if (peri_body_create(&desc, &body, NULL) < 0) exit(1);
    peri_material_desc_init(&material, PERI_LAW_LPS);
    material.young = 1.0;
    material.poisson = poisson;
    material.density = 1.0;
    need(body, peri_add_material(body, &material));
    need(body, peri_add_box(body, peri_id(body, PERI_KIND_MATERIAL, 1), lo, hi, 1.0 / (double)edge));
    need(body, peri_build(body));
    return body;
}

/* Points of columns or layers [from, to). */
static int32_t layers(peri_body *body, int64_t edge, int64_t from, int64_t to) {
    const double lo[3] = { (double)from / (double)edge, -1, -1 }, hi[3] = { (double)to / (double)edge, 2, 2 };
    int32_t set = peri_select_box(body, NULL, lo, hi);
    need(body, set);
    return set;
}

/* Time of one evaluation of all bonds, by the steps of explicit dynamics, which are a pass and a little each: the best of five. */
static double one_pass(peri_body *body) {
    double best = 1e300;
    peri_advance_desc run;
    peri_advance_desc_init(&run);
    run.steps = 1;
    need(body, peri_reset(body));
    need(body, peri_advance(body, &run));
    run.steps = 5;
    for (int r = 0; r < 5; ++r) {
        double start = seconds();
        need(body, peri_advance(body, &run));
        if ((seconds() - start) / 5 < best) best = (seconds() - start) / 5;
    }
    return best;
}

static void row(FILE *csv, const char *scene, peri_body *body, const char *how, const peri_solve_desc *statics) {
    peri_solve_report report;
    double body_bytes = (double)bytes_now, start = seconds(), taken, most, pass;
    bytes_most = bytes_now;
    need(body, peri_solve(body, statics, &report));
    taken = seconds() - start;
    most = (double)bytes_most;
    pass = one_pass(body);
    printf("%-14s %-11s %7lld %9.3f %8.0f %9.4f %8.1f %8.1f %9.1e\n", scene, how, (long long)report.iterations, taken, taken / pass,
           1e3 * pass, body_bytes / 1e6, most / 1e6, report.residual);
    if (csv)
        fprintf(csv, "%s,%s,%lld,%lld,%.4g,%.4g,%.4g,%.6g,%.6g,%.3g\n", scene, how, (long long)peri_point_count(body),
                (long long)report.iterations, taken, taken / pass, pass, body_bytes, most, report.residual);
    (void)fflush(stdout);
}

static void plates(FILE *csv) {
    static const char *const names[] = { "", "multilevel", "blocks", "none" };
    const double pull[2] = { 1e-3, 0 };
    for (int64_t edge = 100; edge <= 800; edge *= 2)
        for (int32_t p = PERI_PRECONDITIONER_MULTILEVEL; p < peri__end_preconditioner; ++p) {
            char scene[32];
            peri_solve_desc statics;
            peri_body *body;
            if (p != PERI_PRECONDITIONER_MULTILEVEL && edge > 400) continue;
            body = block(PERI_SPACE_PLANE_STRESS, edge, 0.3, PERI_PRECISION_DOUBLE);
            need(body, peri_prescribe_displacement(body, layers(body, edge, 0, 3), PERI_AXIS_XY, NULL, NULL, NULL));
            need(body, peri_apply_layer_traction(body, layers(body, edge, edge - 1, edge), 1.0, pull, NULL, NULL));
            peri_solve_desc_init(&statics);
            statics.tolerance = 1e-8;
            statics.preconditioner = p;
            (void)sprintf(scene, "plate %lld^2", (long long)edge);
            row(csv, scene, body, names[p % 100], &statics);
            peri_body_destroy(body);
        }
}

static void blocks_of(FILE *csv, int64_t edge) {
    const double pull[3] = { 1e-3, 0, 0 };
    static const int32_t precisions[2] = { PERI_PRECISION_DOUBLE, PERI_PRECISION_SINGLE };
    for (int k = 0; k < 2; ++k) {
        const int32_t precision = precisions[k];
        char scene[32];
        peri_solve_desc statics;
        peri_body *body = block(PERI_SPACE_SOLID, edge, 0.25, precision);
        need(body, peri_prescribe_displacement(body, layers(body, edge, 0, 3), PERI_AXIS_XYZ, NULL, NULL, NULL));
        need(body, peri_prescribe_displacement(body, layers(body, edge, edge - 3, edge), PERI_AXIS_XYZ, pull, NULL, NULL));
        peri_solve_desc_init(&statics);
        statics.tolerance = precision == PERI_PRECISION_DOUBLE ? 1e-6 : 1e-4;
        (void)sprintf(scene, "block %lld^3", (long long)edge);
        row(csv, scene, body, precision == PERI_PRECISION_DOUBLE ? "f64" : "f32, 1e-4", &statics);
        peri_body_destroy(body);
        if (edge > 40) break;
    }
}

int main(int argc, char **argv) {
    FILE *csv = fopen("out/statics.csv", "w");
    if (csv) fprintf(csv, "scene,how,points,iterations,seconds,passes,seconds_of_a_pass,body_bytes,most_bytes,residual\n");
    printf("%-14s %-11s %7s %9s %8s %9s %8s %8s %9s\n", "scene", "how", "iter.", "s", "= passes", "ms/pass", "body MB", "most MB",
           "residual");
    plates(csv);
    blocks_of(csv, 20);
    blocks_of(csv, 40);
    printf("to beat at 40^3: 3 s, 60 MB; Peridigm 1.5: 40^3 151 s on two cores, 20^3 17 s matrix-free, 160 s and 1.45 GB assembled\n");
    if (argc > 1 && strcmp(argv[1], "--large") == 0) blocks_of(csv, 100);
    if (csv) (void)fclose(csv);
    return 0;
}
