/* SPDX-License-Identifier: MIT */
/* tradeoff.h - what the parts of the tradeoff program share: the knobs, a run, the problems, the rows of the table. */
#ifndef TRADEOFF_H
#define TRADEOFF_H

#include "../peri.h"
#include "../src/base/enums.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define PI 3.14159265358979323846

typedef struct knobs {
    int32_t space, law, correction, influence, quadrature, precision, geometry, integrator;
    double  m;             /* horizon over spacing                                                                       */
    double  across;        /* spacings across the feature of the problem                                                 */
    double  poisson;       /* of the bond-based law: the one that it has                                                 */
    double  stabilization; /* of correspondence; < 0: the default, and of the other laws                                 */
    double  tolerance;     /* of statics; 0: the default                                                                 */
    double  safety;        /* of dynamics: time step over the stable step                                                */
} knobs;

typedef struct outcome {
    int32_t status;
    int64_t points, bonds, bytes; /* bytes: the most that the allocator held                                             */
    double  seconds, error;       /* processor time of build and solve, or build and run; relative error                 */
    char    text[160];            /* of the failure                                                                      */
} outcome;

typedef struct problem {
    const char *name, *title, *feature, *truth; /* feature: what `across` counts                                         */
    int32_t space;
    int     moves;      /* dynamics                                                                                      */
    int     product;    /* stage 1 takes every influence function and quadrature, too: cheap                             */
    double  only;       /* the resolution at which rows are compared, where it is no choice of the user's; 0: all         */
    double  across[14]; /* ascending, ends with 0; the first `usual` of them make the main grid                           */
    int     usual;
    double  ratio[6];   /* horizon over spacing in the main grid, ends with 0; none where it is `across`                  */
    double  limit;      /* runs expected to take more seconds than this are left out, in stage 4 four times that           */
    outcome (*run)(const knobs *k);
    double (*work)(const knobs *k); /* evaluations of a bond expected                                                     */
} problem;

extern const problem problems[];
extern const int problem_count;

/* Defaults: double, whole volumes, constant influence, no correction; small strains in statics, any in dynamics. */
knobs knobs_of(const problem *p, int32_t law, double m, double across);

/* ---- one run ------------------------------------------------------------------------------------------------------ */

typedef struct trial {
    const knobs *k;
    peri_body   *body;
    outcome      out;
    double       since;
} trial;

/* E = 1 and density 1 unless changed before trial_build. */
peri_material_desc trial_material(const knobs *k);
/* A body with material 0 and the clock running. Calls after one that failed do nothing; trial_fine says whether all went well. */
void trial_create(trial *t, const knobs *k, double spacing, const peri_material_desc *material);
void trial_note(trial *t, int64_t result);
int  trial_fine(const trial *t);
void trial_build(trial *t, const double *lo, const double *hi, double spacing, peri_point_fn inside);
int32_t trial_box(trial *t, double x0, double y0, double x1, double y1); /* set; any z                                    */
double *trial_read(trial *t, int32_t field);                             /* of calloc; NULL where the trial has failed    */
void trial_solve(trial *t, int32_t loose, double from);
void trial_pause(trial *t);
void trial_resume(trial *t);
outcome trial_end(trial *t, double error);

int    dimension_of(const knobs *k);
double family_of(const knobs *k);                                     /* bonds of a point, about                         */
void   lame_of(const knobs *k, double *lambda, double *mu);            /* in-plane ones in plane stress                   */

/* ---- problems ----------------------------------------------------------------------------------------------------- */

outcome run_uniform(const knobs *k), run_cantilever(const knobs *k), run_hole(const knobs *k), run_crack(const knobs *k),
        run_edges(const knobs *k);
outcome run_wave(const knobs *k), run_branching(const knobs *k);
double  work_uniform(const knobs *k), work_cantilever(const knobs *k), work_hole(const knobs *k), work_crack(const knobs *k),
       work_edges(const knobs *k);
double  work_wave(const knobs *k), work_branching(const knobs *k);

/* ---- rows --------------------------------------------------------------------------------------------------------- */

typedef struct row {
    knobs   k;
    outcome out;
    double  guarded; /* the error, or what the neighbours in resolution give reason to expect                            */
    int     stage, fast, small; /* fast, small: on the front of error and seconds, of error and bytes                    */
} row;

typedef struct table {
    const problem *p;
    row    *rows;
    int     count, room;
    double  spent; /* [s] of the processor                                                                               */
} table;

double  seconds_expected(const problem *p, const knobs *k);
outcome run_best(const problem *p, const knobs *k); /* the least time of three where it is below 50 ms                   */

row *table_find(const table *t, const knobs *k);
row *table_ask(table *t, const knobs *k, int stage, double limit); /* runs it unless it was; NULL: left out               */
void table_fill(table *t);                                         /* all stages                                          */
void table_judge(table *t);                                        /* guarded errors and fronts                           */
void table_csv(const table *t, FILE *file);
void table_choices(const table *t, FILE *file);

void name_series(const knobs *k, int32_t moves, char *text, size_t capacity);
int  print_recipes(const char *only);

#endif
