/* SPDX-License-Identifier: MIT */
/* suite.h - what the parts of the bench program share: rows of cases, tables of figures, the limits of the machine, the work of a bond.

   bench.c     the driver; the table of all cases     scene.h    one function that makes a body of a case row
   cases.c     the library compiled into it, twice    runs.c     scenes through the public API: operator, game, fracture, ...
   cliffs.c    what settings cost over the plain body
   limits.c    what the machine can do                work.c     what a bond asks of it
   textbook.c  plain loops to compare with            bars.c     the library against them; threads
   table.c     aligned text and CSV                   glass.c    the branching benchmark                                        */
#ifndef SUITE_H
#define SUITE_H

#include "bench.h"

typedef struct bench_case {
    int32_t law, space, precision, geometry, threads;
    double  critical; /* critical stretch: 0 = elastic; 0.5 = never reached, but the state of every bond is kept and asked for  */
    int32_t cloud;    /* 1: the lattice perturbed by a quarter of a cell, bonds all different                                   */
    int64_t edge[3];  /* points per edge; the spacing is 1                                                                       */
    double  m;        /* horizon over spacing                                                                                    */
} bench_case;

typedef struct bench_facts { /* of a body                                                                                        */
    int64_t points, bonds, width; /* bonds: directed                                                                             */
    int64_t columns, kept;        /* columns of 16 bonds over all groups, and those stored; 0 where the families are a list      */
    int32_t slots;                /* reals of a point's record on the list; 0 on columns                                         */
    double  bytes, peak;          /* per point: all that the body holds, and the most during peri_build                          */
    double  build;                /* [s]                                                                                         */
} bench_facts;

/* Writes "law space m precision", and "lattice" or "cloud". */
void case_name(const bench_case *c, char *out, size_t capacity);

/* ---- the library, compiled in: cases.c ---------------------------------------------------------------------------- */

typedef struct textbook_input { /* a body, as a textbook wants it                                                                */
    int64_t  n, width, bonds;
    int32_t  dim, lps;
    int32_t *id;                    /* [n*width] families, ascending, padded with the own id                                     */
    double  *x, *u, *force;         /* [n*dim]; force: density of the library at u                                               */
    double  *volume;                /* [n]                                                                                       */
    double   c, s0, a, b;           /* bond-based: c; LPS: A, B                                                                  */
} textbook_input;

typedef struct suite {
    peri_body *(*build)(const bench_case *c, bench_facts *facts); /* NULL where the precision is refused                        */
    void (*harm)(peri_body *body, bench_facts *facts);            /* 2 % of the bonds cut at random, and a crack                */
    double (*steps)(peri_body *body, int64_t steps, int32_t threads); /* seconds taken: of the processor for one thread, else of
                                                                         the wall                                               */
    void (*read_state)(peri_body *body, double *u, double *v, int64_t size);
    void (*read_textbook)(peri_body *body, const bench_case *c, textbook_input *t); /* arrays from malloc                       */
    void (*destroy)(peri_body *body);
} suite;
extern const suite cases_plain, cases_native;

/* ---- the machine -------------------------------------------------------------------------------------------------- */

#define RUNGS 6 /* sizes at which the flow of data is measured: 256 KiB times 4^k                                                 */

typedef struct machine {                  /* [0] double, [1] single precision; 1e9 per second                                    */
    double add[2], mul[2];                /* additions alone, multiplications alone                                              */
    double both[2];                       /* as many of each side by side, all counted: the limit without contraction            */
    double fma[2];                        /* fused, two operations each; 0 where there is no such instruction                    */
    double root[2], div[2], pair[2];      /* square roots; divisions; a root and a division, both counted as one                 */
    double copy[RUNGS], update[RUNGS];    /* GB/s of b = s a and of a = s a, 2 reals counted per element                         */
} machine;

void        machine_measure(machine *m, int64_t repeats);
const char *machine_vectors(void);

/* ---- work --------------------------------------------------------------------------------------------------------- */

typedef struct bench_work { /* per directed bond and step                                                                        */
    double add, mul, root, div; /* add: subtractions and comparisons, too                                                        */
    double wide;                /* of `add`: in double, where the rest is in single precision                                    */
    double flop;                /* all of them without comparisons                                                               */
    double bytes;               /* that must come from and go to beyond the registers, each array once per pass                  */
    double set;                 /* [bytes] of the arrays that a step touches, whole body                                         */
} bench_work;

bench_work work_of(const bench_case *c, const bench_facts *f);
void       work_print(void);

/* The least time [ns] that the machine needs for a bond, and which of its parts sets it. */
double limit_of(const machine *m, const bench_case *c, const bench_work *w, const char **part);

/* ---- textbook loops ----------------------------------------------------------------------------------------------- */

typedef struct textbook textbook;
textbook *textbook_make(const textbook_input *t, int32_t single); /* arrays of double, or of float                              */
void      textbook_force(textbook *t);                            /* one pass over all bonds (LPS: two)                         */
double    textbook_error(const textbook *t, const double *force); /* largest difference over the largest force                  */
void      textbook_free(textbook *t);

/* ---- tables ------------------------------------------------------------------------------------------------------- */

typedef struct column {
    const char *title, *name; /* in the text and in the CSV                                                                      */
    int         width, decimals; /* width < 0: text, to the left                                                                 */
} column;

typedef struct table {
    FILE         *csv;
    const column *columns;
    int           count, at;
} table;

void table_open(table *t, const char *path, const column *columns, int count);
void put_text(table *t, const char *text);
void put_number(table *t, double value); /* not a number: "-" in the text, nothing in the CSV                                    */
void table_close(table *t);
#define NOTHING ((double)NAN)

/* ---- sections of the program -------------------------------------------------------------------------------------- */

typedef struct bench_run {
    int64_t repeats;
    machine machine;
} bench_run;

void bench_textbook(bench_run *run); /* bars.c */
void bench_threads(bench_run *run);
void bench_operator(bench_run *run); /* runs.c */
void bench_unused(bench_run *run);
void bench_cliffs(bench_run *run); /* cliffs.c */
void bench_game(bench_run *run);
void bench_branching(bench_run *run);
void bench_large(bench_run *run);

/* glass.c: the crack branching benchmark, ready to run, and the step and number of steps of its run. NULL where the precision is
   refused. */
peri_body *glass_plate(int32_t precision, double *step, int64_t *steps);

/* Room for numbers, or the end of the program. */
static inline double *doubles(int64_t count) {
    double *a = count > 0 ? (double *)malloc((size_t)count * sizeof *a) : NULL;
    if (a) return a;
    fprintf(stderr, "bench: no memory\n");
    exit(1);
}

/* Steps of about 6 ms in all, given the seconds of one. */
static inline int64_t enough_steps(double seconds_of_one) {
    return seconds_of_one > 6e-3 ? 1 : (int64_t)(6e-3 / (seconds_of_one + 1e-6)) + 1;
}

#endif
