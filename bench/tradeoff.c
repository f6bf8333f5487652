/* SPDX-License-Identifier: MIT */
/* tradeoff.c - how accurate, how fast, how large: `tradeoff [PROBLEM ...]`, `tradeoff --recipes [PROBLEM ...]`, `tradeoff --header`.

   Problems with known answers (tradeoff_statics.c, tradeoff_motion.c say of each which, and how the error is measured), run over the knobs
   of the library. The full product is millions of runs, so each problem goes by stages:
     1  law x correction x horizon over spacing x resolution, all else by default (uniform strain: and influence x quadrature)
     2  rows on the front of error against time, or of error against memory, with each other knob varied alone: precision, influence,
        quadrature, geometry, stabilization, tolerance, time step, integrator
     3  of each of these rows the values that helped (by error x seconds x root of bytes), in all combinations
     4  every set of knobs that is on a front by then, at all resolutions, until no new set comes there
   A combination that the library refuses is a row with its status. Runs expected to take longer than the problem allows are left out.

   seconds  processor time of one thread, build and solve (or run); the least of three where it is below 50 ms
   bytes    the most that the library's allocator held at a time
   error    relative, as the problem says;  guarded: see guard() of tradeoff_table.c; fronts and choices go by it
   Writes build/tradeoff/PROBLEM.csv and .md; `make tradeoff` joins them into out/tradeoff.csv and out/tradeoff.md, and draws. */
#include "tradeoff.h"

#define MEASURE(of) .run = run_##of, .work = work_##of
const problem problems[] = {
    { .name = "uniform", .title = "Uniform strain of 64 x 64 spacings, plane stress", .space = PERI_SPACE_PLANE_STRESS,
      .feature = "spacings across the side", .truth = "elastic energy of a square, surfaces included",
      .across = { 32, 64 }, .usual = 2, .only = 64, .ratio = { 2, 3, 4 }, .product = 1, .limit = 0.3, MEASURE(uniform) },
    { .name = "uniform_3d", .title = "Uniform strain of 24 x 24 x 24 spacings, 3D", .space = PERI_SPACE_SOLID,
      .feature = "spacings across the side", .truth = "elastic energy of a cube, surfaces included",
      .across = { 16, 24 }, .usual = 2, .only = 24, .ratio = { 2, 3, 4 }, .limit = 0.4, MEASURE(uniform) },
    { .name = "cantilever", .title = "Cantilever under a force, plane stress", .space = PERI_SPACE_PLANE_STRESS,
      .feature = "spacings across the depth", .truth = "deflection of the tip against Timoshenko and Goodier",
      .across = { 4, 6, 8, 12, 16, 24, 32, 48, 64 }, .usual = 6, .ratio = { 2, 3, 4, 6 }, .limit = 0.5, MEASURE(cantilever) },
    { .name = "cantilever_3d", .title = "Bar under end moments, 3D", .space = PERI_SPACE_SOLID,
      .feature = "spacings across the depth", .truth = "deflection of the tip against the exact solution",
      .across = { 4, 6, 8, 12, 16, 20, 24 }, .usual = 4, .ratio = { 2, 3, 4 }, .limit = 0.7, MEASURE(cantilever) },
    { .name = "hole", .title = "Plate with a hole, plane stress", .space = PERI_SPACE_PLANE_STRESS,
      .feature = "spacings to the radius", .truth = "stress around the hole against Kirsch",
      .across = { 6, 8, 10, 12, 16, 20, 24, 32, 40, 48, 64, 96 }, .usual = 7, .ratio = { 2, 3, 4, 6 }, .limit = 0.5, MEASURE(hole) },
    { .name = "crack", .title = "Crack under tension, plane stress", .space = PERI_SPACE_PLANE_STRESS,
      .feature = "spacings along the crack", .truth = "energy release rate against Tada, Paris, Irwin",
      .across = { 8, 12, 16, 24, 32, 48, 64, 96 }, .usual = 5, .ratio = { 2, 3, 4, 6 }, .limit = 0.5, MEASURE(crack) },
    { .name = "edge_cracks", .title = "Cracks in both edges, plane stress", .space = PERI_SPACE_PLANE_STRESS,
      .feature = "spacings along a crack", .truth = "energy release rate against Tada, Paris, Irwin",
      .across = { 4, 6, 8, 12, 16, 24, 32, 48 }, .usual = 4, .ratio = { 2, 3, 4 }, .limit = 0.3, MEASURE(edges) },
    { .name = "p_wave", .title = "P wave, plane strain", .space = PERI_SPACE_PLANE_STRAIN, .moves = 1,
      .feature = "spacings to the wavelength", .truth = "speed of a packet over two waves",
      .across = { 8, 12, 16, 24, 32, 48, 64, 96 }, .usual = 5, .ratio = { 2, 3, 4, 6 }, .limit = 0.5, MEASURE(wave) },
    { .name = "p_wave_3d", .title = "P wave, 3D", .space = PERI_SPACE_SOLID, .moves = 1,
      .feature = "spacings to the wavelength", .truth = "speed of a packet over one wave",
      .across = { 6, 8, 10, 12, 16, 20, 24 }, .usual = 4, .ratio = { 2, 3, 4 }, .limit = 0.5, MEASURE(wave) },
    { .name = "branching", .title = "Crack branching in glass, horizon 1 mm", .space = PERI_SPACE_PLANE_STRESS, .moves = 1,
      .feature = "spacings to the horizon", .truth = "path of the upper tip against the finest run",
      .across = { 2, 3, 4, 5 }, .usual = 4, .limit = 3, MEASURE(branching) }
};
const int problem_count = (int)(sizeof problems / sizeof *problems);

static const char *const HEADER =
    "problem,space,law,correction,m,across,influence,quadrature,precision,geometry,stabilization,tolerance,integrator,safety,poisson,"
    "points,bonds,bytes,seconds,error,guarded,stage,front_time,front_bytes,status\n";

static FILE *open_part(const problem *p, const char *kind) {
    char path[80];
    FILE *file;
    (void)snprintf(path, sizeof path, "build/tradeoff/%s.%s", p->name, kind);
    file = fopen(path, "w");
    if (!file) {
        fprintf(stderr, "tradeoff: cannot write %s\n", path);
        exit(1);
    }
    return file;
}

static void study(const problem *p) {
    table t;
    FILE *csv = open_part(p, "csv"), *md = open_part(p, "md");
    memset(&t, 0, sizeof t);
    t.p = p;
    table_fill(&t);
    table_csv(&t, csv);
    table_choices(&t, md);
    printf("%-14s %5d runs, %6.1f s\n", p->name, t.count, t.spent);
    (void)fflush(stdout);
    free(t.rows);
    (void)fclose(csv);
    (void)fclose(md);
}

int main(int argc, char **argv) {
    if (argc > 1 && strcmp(argv[1], "--header") == 0) {
        printf("%s", HEADER);
        return 0;
    }
    if (argc > 1 && strcmp(argv[1], "--recipes") == 0) {
        printf("recipe,problem,across,error,seconds,bytes,points,bonds,poisson,series,status\n");
        if (argc == 2) return print_recipes(NULL);
        for (int a = 2; a < argc; ++a)
            if (print_recipes(argv[a])) return 1;
        return 0;
    }
    for (int a = 1; a < argc; ++a) {
        int known = 0;
        for (int i = 0; i < problem_count; ++i) known |= strcmp(argv[a], problems[i].name) == 0;
        if (!known) {
            fprintf(stderr, "tradeoff: no problem %s\n", argv[a]);
            return 1;
        }
    }
    for (int i = 0; i < problem_count; ++i) {
        int wanted = argc < 2;
        for (int a = 1; a < argc; ++a) wanted |= strcmp(argv[a], problems[i].name) == 0;
        if (wanted) study(&problems[i]);
    }
    return 0;
}
