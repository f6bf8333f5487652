/* SPDX-License-Identifier: MIT */
/* bars.c - the library against plain loops, and against itself on two threads. */
#include "suite.h"

static void release(textbook_input *t) {
    free(t->id);
    free(t->x);
    free(t->u);
    free(t->force);
    free(t->volume);
}

/* The textbook in double and single precision and the library in each precision, in turns, on the same body: the textbook's force pass
   alone against whole steps of the library, its breaking included on both sides. The textbook's forces must be those of the library. */
static void textbook_rows(bench_run *run, table *t, int32_t law, int32_t space, int64_t edge, double bar_single) {
    static const int32_t reals[3] = { PERI_PRECISION_DOUBLE, PERI_PRECISION_MIXED, PERI_PRECISION_SINGLE };
    const suite *s = &cases_plain;
    bench_case c = { law, space, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR, 1, 0.5, 0, { edge, edge, edge }, 3 };
    peri_body *body[3];
    bench_facts facts[3];
    textbook_input in;
    textbook *book[2];
    double best[5] = { 1e300, 1e300, 1e300, 1e300, 1e300 };
    char name[160], grid[32];
    memset(&in, 0, sizeof in);
    for (int k = 0; k < 3; ++k) {
        c.precision = reals[k];
        body[k] = s->build(&c, &facts[k]);
        if (k == 0 && body[k]) s->read_textbook(body[k], &c, &in);
    }
    const double bonds = (double)facts[0].bonds;
    for (int k = 0; k < 2; ++k) book[k] = textbook_make(&in, k);
    for (int k = 0; k < 2; ++k) {
        textbook_force(book[k]);
        const double error = textbook_error(book[k], in.force);
        if (!(error < (k ? 5e-2 : 1e-10))) { /* places of 300, extensions of 1e-3: 3e5 rounding units, 3e-11 and 2e-2 */
            fprintf(stderr, "bench: the textbook in %s precision is off by %g\n", k ? "single" : "double", error);
            exit(1);
        }
    }
    for (int64_t r = 0; r < run->repeats; ++r) {
        for (int k = 0; k < 2; ++k) {
            const double start = processor_seconds();
            textbook_force(book[k]);
            const double taken = (processor_seconds() - start) * 1e9 / bonds;
            if (taken < best[k]) best[k] = taken;
        }
        for (int k = 0; k < 3; ++k) {
            if (!body[k]) continue;
            const double taken = s->steps(body[k], 2, 1) * 1e9 / (2.0 * bonds);
            if (taken < best[2 + k]) best[2 + k] = taken;
        }
    }
    for (int k = 0; k < 3; ++k) {
        const char *part = "";
        bench_work w;
        c.precision = reals[k];
        case_name(&c, name, sizeof name);
        (void)sprintf(grid, " %ld^%d", (long)edge, space == PERI_SPACE_SOLID ? 3 : 2);
        put_text(t, strcat(name, grid));
        put_number(t, best[0]);
        put_number(t, best[1]);
        if (!body[k]) {
            for (int n = 3; n < t->count; ++n) put_number(t, NOTHING);
            continue;
        }
        w = work_of(&c, &facts[k]);
        const double limit = limit_of(&run->machine, &c, &w, &part);
        put_number(t, best[2 + k]);
        put_number(t, best[0] / best[2 + k]);
        put_number(t, best[1] / best[2 + k]);
        put_number(t, reals[k] == PERI_PRECISION_SINGLE ? bar_single : NOTHING);
        put_number(t, facts[k].bytes);
        put_number(t, w.flop / best[2 + k]);
        put_number(t, w.bytes / best[2 + k]);
        put_number(t, facts[k].columns > 0 ? bonds / (16.0 * (double)facts[k].columns) : NOTHING);
        put_number(t, limit);
        put_number(t, 100.0 * limit / best[2 + k]);
        put_text(t, part);
    }
    for (int k = 0; k < 3; ++k)
        if (body[k]) s->destroy(body[k]);
    for (int k = 0; k < 2; ++k) textbook_free(book[k]);
    release(&in);
}

void bench_textbook(bench_run *run) {
    static const column columns[] = {
        { "case", "case", -40, 0 },
        { "book f64", "textbook_double_ns", 8, 2 }, { "book f32", "textbook_single_ns", 8, 2 },
        { "ns/bond", "ns_per_bond", 8, 2 },         { "x f64", "faster_than_double", 6, 2 },
        { "x f32", "faster_than_single", 6, 2 },    { "bar", "bar", 5, 1 },
        { "bytes/pt", "bytes_per_point", 8, 0 },    { "GFLOP/s", "gflops", 7, 1 },
        { "GB/s", "gbytes_per_s", 6, 1 },           { "filled", "lanes_filled", 6, 2 },
        { "limit", "limit_ns_per_bond", 6, 2 },     { "share %", "share_percent", 7, 0 },
        { "by", "limited_by", -5, 0 },
    };
    table t;
    printf("\nTextbook loops (force pass, -O2 -march=native) against steps of the library (-O2); bar: times faster than the double loop;\n"
           "filled: lanes of columns that hold a bond");
    table_open(&t, "out/textbook.csv", columns, (int)(sizeof columns / sizeof columns[0]));
    textbook_rows(run, &t, PERI_LAW_BOND_BASED, PERI_SPACE_PLANE_STRESS, 300, NOTHING);
    textbook_rows(run, &t, PERI_LAW_LPS, PERI_SPACE_PLANE_STRESS, 300, NOTHING);
    textbook_rows(run, &t, PERI_LAW_BOND_BASED, PERI_SPACE_SOLID, 64, 6.0);
    textbook_rows(run, &t, PERI_LAW_LPS, PERI_SPACE_SOLID, 64, 5.0);
    table_close(&t);
}

static void thread_row(bench_run *run, table *t, int32_t law, int32_t precision, int32_t cloud, int64_t edge) {
    const suite *s = &cases_plain;
    bench_case c = { law, PERI_SPACE_SOLID, precision, PERI_GEOMETRY_NONLINEAR, 1, 0.5, cloud, { edge, edge, edge }, 3 };
    peri_body *body[2];
    bench_facts facts[2];
    double best[2] = { 1e300, 1e300 }, work[2] = { 1e300, 1e300 };
    char name[128];
    case_name(&c, name, sizeof name);
    for (int k = 0; k < 2; ++k) {
        c.threads = k + 1;
        body[k] = s->build(&c, &facts[k]);
        if (body[k]) s->harm(body[k], &facts[k]);
    }
    const int64_t size = facts[0].points * 3;
    double *state = doubles(4 * size);
    if (!body[0] || !body[1]) exit(1);
    for (int64_t r = 0; r < 12 * run->repeats; ++r) /* both threads are let in at once in some runs only */
        for (int k = 0; k < 2; ++k) {
            const double start = processor_seconds(), taken = s->steps(body[k], 2, 2) * 1e9 / (2.0 * (double)facts[k].bonds);
            if (taken < best[k]) best[k] = taken;
            if (processor_seconds() - start < work[k]) work[k] = processor_seconds() - start;
        }
    for (int k = 0; k < 2; ++k) s->read_state(body[k], state + 2 * k * size, state + (2 * k + 1) * size, size);
    put_text(t, name);
    put_number(t, best[0]);
    put_number(t, best[1]);
    put_number(t, best[0] / best[1]);
    put_number(t, work[1] / work[0]);
    put_text(t, memcmp(state, state + 2 * size, (size_t)(2 * size) * sizeof *state) == 0 ? "same" : "DIFFERENT");
    free(state);
    for (int k = 0; k < 2; ++k) s->destroy(body[k]);
}

void bench_threads(bench_run *run) {
    static const column columns[] = {
        { "case", "case", -40, 0 },       { "1 thread", "one_ns_per_bond", 9, 2 }, { "2 threads", "two_ns_per_bond", 9, 2 },
        { "ratio", "ratio", 6, 2 },       { "work", "work_of_two_over_one", 6, 2 },
        { "bits", "bits", -9, 0 },
    };
    table t;
#ifndef _OPENMP
    printf("\nThreads: compiled without OpenMP\n");
    return;
#endif
    printf("\nThreads, bodies harmed (bar 1.80, same bits), by the clock on the wall: needs two idle cores, and threads that do not spin\n"
           "while they wait (OMP_WAIT_POLICY=passive). work: time of the processor of both threads over that of one, whatever else runs:\n"
           "at 1.00 two free cores take half the time, and what one waits for the other");
    table_open(&t, "out/threads.csv", columns, (int)(sizeof columns / sizeof columns[0]));
    thread_row(run, &t, PERI_LAW_BOND_BASED, PERI_PRECISION_DOUBLE, 0, 48);
    thread_row(run, &t, PERI_LAW_BOND_BASED, PERI_PRECISION_SINGLE, 0, 48);
    thread_row(run, &t, PERI_LAW_LPS, PERI_PRECISION_DOUBLE, 0, 48);
    thread_row(run, &t, PERI_LAW_LPS, PERI_PRECISION_SINGLE, 0, 48);
    thread_row(run, &t, PERI_LAW_CORRESPONDENCE, PERI_PRECISION_DOUBLE, 0, 40);
    thread_row(run, &t, PERI_LAW_BOND_BASED, PERI_PRECISION_DOUBLE, 1, 40);
    thread_row(run, &t, PERI_LAW_LPS, PERI_PRECISION_SINGLE, 1, 40);
    table_close(&t);
}
