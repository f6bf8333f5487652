/* tradeoff.c - how accurate, how fast, how large: `tradeoff [PROBLEM ...]`, `tradeoff --recipes [PROBLEM ...]`, `tradeoff --header`.

   Problems with known answers (tradeoff_statics.c, tradeoff_motion.c say of each which, and how the error is measured), run over the knobs
   of the library. The full product is millions of runs, so each problem goes by stages:
     1  law x correction x horizon over spacing x resolution, all else by default (uniform strain: and influence x quadrature)
     2  every row on the front of error against time, or of error against memory, with each other knob varied alone: precision, influence,
        quadrature, geometry, stabilization, tolerance, time step, integrator
     3  of each of these rows the values that helped (by error x seconds x root of bytes), in all combinations
     4  every set of knobs that is on a front by then, at all resolutions, until no new set comes there
   A combination that the library refuses is a row with its status. Runs expected to take longer than the problem allows are left out.

   seconds  processor time of one thread, build and solve (or run); the least of three where it is below 50 ms
   bytes    the most that the library's allocator held at a time
   error    relative, as the problem says;  guarded: see guard() of tradeoff_table.c; fronts and choices go by it
   Writes build/tradeoff/PROBLEM.csv and .md; `make tradeoff` joins them into out/tradeoff.csv and out/tradeoff.md, and draws. */
#include "tradeoff.h"

const problem problems[] = {
    { "uniform", "Uniform strain, plane stress", "spacings across the side", "elastic energy of a square, surfaces included",
      PERI_PLANE_STRESS, 0, 1, { 8, 16, 32, 64, 128 }, 3, { 2, 3, 4 }, 0.3, run_uniform, work_uniform },
    { "uniform_3d", "Uniform strain, 3D", "spacings across the side", "elastic energy of a cube, surfaces included",
      PERI_SOLID, 0, 0, { 6, 8, 12, 16, 24, 32, 48 }, 5, { 2, 3, 4 }, 0.4, run_uniform, work_uniform },
    { "cantilever", "Cantilever under a force, plane stress", "spacings across the depth",
      "deflection of the tip against Timoshenko and Goodier",
      PERI_PLANE_STRESS, 0, 0, { 4, 6, 8, 12, 16, 24, 32, 48, 64 }, 7, { 2, 3, 4, 6 }, 1, run_cantilever, work_cantilever },
    { "cantilever_3d", "Bar under end moments, 3D", "spacings across the depth", "deflection of the tip against the exact solution",
      PERI_SOLID, 0, 0, { 4, 6, 8, 12, 16, 20, 24 }, 4, { 2, 3, 4 }, 2, run_cantilever, work_cantilever },
    { "hole", "Plate with a hole, plane stress", "spacings to the radius", "stress concentration factor against Kirsch",
      PERI_PLANE_STRESS, 0, 0, { 6, 8, 10, 12, 16, 20, 24, 32, 40, 48, 64, 96 }, 8, { 2, 3, 4, 6 }, 1, run_hole, work_hole },
    { "p_wave", "P wave, plane strain", "spacings to the wavelength", "speed of a packet over two waves",
      PERI_PLANE_STRAIN, 1, 0, { 8, 12, 16, 24, 32, 48, 64, 96 }, 6, { 2, 3, 4, 6 }, 1, run_wave, work_wave },
    { "p_wave_3d", "P wave, 3D", "spacings to the wavelength", "speed of a packet over one wave",
      PERI_SOLID, 1, 0, { 6, 8, 10, 12, 16, 20, 24 }, 4, { 2, 3, 4 }, 2, run_wave, work_wave },
    { "crack", "Crack under tension, plane stress", "spacings along the crack", "energy release rate against Tada, Paris, Irwin",
      PERI_PLANE_STRESS, 0, 0, { 8, 12, 16, 24, 32, 48, 64, 96 }, 6, { 2, 3, 4, 6 }, 2, run_crack, work_crack },
    { "branching", "Crack branching in glass, horizon 1 mm", "spacings to the horizon", "path of the upper tip against the finest run",
      PERI_PLANE_STRESS, 1, 0, { 2, 3, 4, 5 }, 4, { 0 }, 9, run_branching, work_branching }
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
    for (int i = 0; i < problem_count; ++i) {
        int wanted = argc < 2;
        for (int a = 1; a < argc; ++a) wanted |= strcmp(argv[a], problems[i].name) == 0;
        if (wanted) study(&problems[i]);
    }
    return 0;
}
