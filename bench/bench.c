/* SPDX-License-Identifier: MIT */
/* bench.c - the proof of speed: `bench [--large] [--repeats n] [section ...]`, all sections but `large` where none is named. One row a
   case, as CSV too. Each figure is the least of n >= 7 timings of about 6 ms or of one step, where that is longer; what is compared takes
   turns in one run. One thread, unless a row says otherwise, and then in time of the processor, so that other work on the machine only
   counts by what it takes of caches and memory.

     limits     out/limits.csv     what one core can do: additions, multiplications, both side by side, fused ones, roots and divisions,
                                   1e9 per second
                out/flow.csv       GB/s of b = s a and of a = s a by the size of the arrays
                out/work.csv       operations per bond, and the equations that they are of
     cases      out/cases.csv      three laws, three grids, three precisions, intact and harmed (2 % of the bonds cut at random, and a
                                   crack), lattice and cloud. ns per directed bond and step: the library compiled twice in one program,
                                   -O2 and -O3 -march=native (`native`; `ratio` of the first over it); `harmed`: over the same row
                                   intact; bytes per point of all that the body holds, and the most that it holds during peri_build;
                                   ns per bond of peri_build, search of neighbours and all
     textbook   out/textbook.csv   plain loops in double and in single precision against the library
     threads    out/threads.csv    one and two threads, by the clock on the wall, and whether their states are the same to the last bit
     operator   out/operator.csv   products with the tangent, and steps of linear geometry
     unused     out/unused.csv     what a scene pays for what it uses, and does not pay for what it does not
     cliffs     out/cliffs.csv     criteria, corrections, materials, horizons over the best path of their law and storage
     game       out/game.csv       frames of a game
     branching  out/branching_time.csv   a whole run of crack branching
     large      out/large.csv      8 million points; also as --large

   The share of a row is the least time in which the machine could do the bond, over the time of the step per bond. The least time is the
   largest of three: bytes that must move over the flow of data measured at that size; roots and divisions, which share a pipe;
   multiplications and additions, apart, because fused ones would round otherwise on machines without them. So 100 % would be a kernel
   that keeps one pipe busy all the time and hides all else behind it, passes over the points and lanes without a bond included. */
#include "suite.h"

void case_name(const bench_case *c, char *out, size_t capacity) {
    static const char *const laws[] = { "?", "bond-based", "LPS", "Oterkus", "correspondence" };
    static const char *const reals[] = { "?", "f64", "mixed", "f32" };
    char text[128];
    (void)sprintf(text, "%s %s m=%g %s %s", laws[c->law % 100], c->space == PERI_SPACE_SOLID ? "3D" : "2D", c->m,
                  reals[c->precision % 100],
                  c->cloud ? "cloud" : "lattice");
    if (capacity > 0) {
        strncpy(out, text, capacity - 1);
        out[capacity - 1] = 0;
    }
}

/* ---- limits ------------------------------------------------------------------------------------------------------- */

static void bench_limits(bench_run *run) {
    static const column columns[] = {
        { "1e9/s", "what", -12, 0 },  { "add", "add", 8, 1 },    { "mul", "mul", 8, 1 },   { "both", "both", 8, 1 },
        { "fma x 2", "fma", 8, 1 },   { "root", "root", 8, 2 },  { "div", "div", 8, 2 },   { "root+div", "pair", 9, 2 },
    };
    static const column sizes[] = { { "GB/s at KiB", "kib", 12, 0 }, { "b = s a", "copy", 9, 1 }, { "a = s a", "update", 9, 1 } };
    const machine *m = &run->machine;
    table t;
    printf("One core, %s", machine_vectors());
    table_open(&t, "out/limits.csv", columns, (int)(sizeof columns / sizeof columns[0]));
    for (int k = 0; k < 2; ++k) {
        put_text(&t, k == 0 ? "double" : "single");
        put_number(&t, m->add[k]);
        put_number(&t, m->mul[k]);
        put_number(&t, m->both[k]);
        put_number(&t, m->fma[k] > 0 ? m->fma[k] : NOTHING);
        put_number(&t, m->root[k]);
        put_number(&t, m->div[k]);
        put_number(&t, m->pair[k]);
    }
    table_close(&t);
    table_open(&t, "out/flow.csv", sizes, 3);
    for (int k = 0; k < RUNGS; ++k) {
        put_number(&t, (double)(256 << 2 * k));
        put_number(&t, m->copy[k]);
        put_number(&t, m->update[k]);
    }
    table_close(&t);
    work_print();
}

/* ---- cases -------------------------------------------------------------------------------------------------------- */

typedef struct worst { /* of a ratio over all rows                                                                               */
    double ratio;
    int    rows, over;
    char   name[128];
} worst;

static void note(worst *w, double ratio, double bar, const char *name) {
    w->rows++;
    w->over += ratio > bar;
    if (!(ratio > w->ratio)) return;
    w->ratio = ratio;
    strcpy(w->name, name);
}

/* The rows intact and harmed of a case: the same bodies. */
static void two_rows(bench_run *run, const bench_case *c, table *t, worst *plain_over_native, worst *harmed_over_intact) {
    const suite *const suites[2] = { &cases_plain, &cases_native };
    peri_body *body[2];
    bench_facts facts[2];
    double intact = NOTHING;
    for (int s = 0; s < 2; ++s) body[s] = suites[s]->build(c, &facts[s]);
    for (int harmed = 0; harmed < 2; ++harmed) {
        double best[2] = { 1e300, 1e300 }, limit = 0.0;
        const char *part = "";
        char name[128];
        bench_work w;
        case_name(c, name, sizeof name);
        put_text(t, name);
        put_text(t, harmed ? "harmed" : "intact");
        if (!body[0] || !body[1]) {
            for (int k = 2; k < t->count; ++k) put_number(t, NOTHING);
            continue;
        }
        for (int s = 0; s < 2; ++s) {
            if (harmed) suites[s]->harm(body[s], &facts[s]);
            best[s] = suites[s]->steps(body[s], 1, 1);
        }
        const int64_t steps = enough_steps(best[0]);
        best[0] = best[1] = 1e300;
        for (int64_t r = 0; r < run->repeats; ++r)
            for (int s = 0; s < 2; ++s) {
                const double taken = suites[s]->steps(body[s], steps, 1) * 1e9 / (double)(steps * facts[s].bonds);
                if (taken < best[s]) best[s] = taken;
            }
        w = work_of(c, &facts[0]);
        limit = limit_of(&run->machine, c, &w, &part);
        if (!harmed) intact = best[0];
        put_number(t, best[0]);
        put_number(t, best[1]);
        put_number(t, best[0] / best[1]);
        put_number(t, harmed ? best[0] / intact : NOTHING);
        put_number(t, facts[0].bytes);
        put_number(t, facts[0].peak);
        put_number(t, facts[0].build * 1e9 / (double)facts[0].bonds);
        put_number(t, w.flop / best[0]);
        put_number(t, w.bytes / best[0]);
        put_number(t, limit);
        put_number(t, 100.0 * limit / best[0]);
        put_text(t, part);
        strcat(name, harmed ? " harmed" : " intact");
        note(plain_over_native, best[0] / best[1], 1.3, name);
        if (harmed) note(harmed_over_intact, best[0] / intact, 1.2, name);
    }
    for (int s = 0; s < 2; ++s)
        if (body[s]) suites[s]->destroy(body[s]);
}

static void bench_cases(bench_run *run) {
    static const column columns[] = {
        { "case", "case", -36, 0 },           { "bonds", "bonds", -6, 0 },
        { "ns/bond", "ns_per_bond", 8, 2 },   { "native", "native_ns_per_bond", 7, 2 },
        { "ratio", "plain_over_native", 6, 2 }, { "harmed", "harmed_over_intact", 6, 2 },
        { "bytes/pt", "bytes_per_point", 8, 0 }, { "peak", "peak_bytes_per_point", 6, 0 },
        { "build", "build_ns_per_bond", 6, 1 }, { "GFLOP/s", "gflops", 7, 1 },
        { "GB/s", "gbytes_per_s", 6, 1 },     { "limit", "limit_ns_per_bond", 6, 2 },
        { "share %", "share_percent", 7, 0 }, { "by", "limited_by", -5, 0 },
    };
    static const int32_t laws[] = { PERI_LAW_BOND_BASED, PERI_LAW_LPS, PERI_LAW_CORRESPONDENCE };
    static const int32_t reals[] = { PERI_PRECISION_DOUBLE, PERI_PRECISION_MIXED, PERI_PRECISION_SINGLE };
    static const struct grid { int32_t space; int64_t edge; double m; } grids[] = {
        { PERI_SPACE_PLANE_STRESS, 300, 3 }, { PERI_SPACE_SOLID, 36, 3 }, { PERI_SPACE_SOLID, 20, 5 }
    };
    worst plain = { 0.0, 0, 0, "" }, harmed = { 0.0, 0, 0, "" };
    table t;
    printf("\nCases: -O2 and -O3 -march=native in turns");
    table_open(&t, "out/cases.csv", columns, (int)(sizeof columns / sizeof columns[0]));
    for (int law = 0; law < 3; ++law)
        for (int grid = 0; grid < 3; ++grid)
            for (int cloud = 0; cloud < 2; ++cloud)
                for (int real = 0; real < 3; ++real) {
                    const int64_t edge = grids[grid].edge;
                    const bench_case c = { laws[law], grids[grid].space, reals[real], PERI_GEOMETRY_NONLINEAR, 1, 0.5, cloud,
                                           { edge, edge, edge }, grids[grid].m };
                    two_rows(run, &c, &t, &plain, &harmed);
                }
    table_close(&t);
    printf("bar 1.30: -O2 over native, worst %.2f (%s), %d of %d rows over\n", plain.ratio, plain.name, plain.over, plain.rows);
    printf("bar 1.20: harmed over intact, worst %.2f (%s), %d of %d rows over\n", harmed.ratio, harmed.name, harmed.over, harmed.rows);
}

/* ---- driver ------------------------------------------------------------------------------------------------------- */

int main(int argc, char **argv) {
    static const struct section { const char *name; void (*run)(bench_run *); } sections[] = {
        { "limits", bench_limits },     { "cases", bench_cases },       { "textbook", bench_textbook },
        { "threads", bench_threads },   { "operator", bench_operator }, { "unused", bench_unused },
        { "cliffs", bench_cliffs }, { "game", bench_game },         { "branching", bench_branching }, { "large", bench_large },
    };
    const int count = (int)(sizeof sections / sizeof sections[0]);
    static bench_run run;
    int named = 0, wanted[16] = { 0 };
    run.repeats = 7;
    for (int k = 1; k < argc; ++k) {
        const char *word = strcmp(argv[k], "--large") == 0 ? "large" : argv[k];
        int s = 0;
        if (strcmp(word, "--repeats") == 0 && k + 1 < argc) {
            run.repeats = atol(argv[++k]);
            continue;
        }
        while (s < count && strcmp(word, sections[s].name) != 0) ++s;
        if (s == count) {
            fprintf(stderr, "bench: no section `%s`; see bench/bench.c\n", word);
            return 2;
        }
        wanted[s] = named = 1;
    }
    if (run.repeats < 7) run.repeats = 7;
    machine_measure(&run.machine, run.repeats);
    for (int s = 0; s < count; ++s)
        if (named ? wanted[s] : strcmp(sections[s].name, "large") != 0) sections[s].run(&run);
    return 0;
}
