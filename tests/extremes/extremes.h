/* SPDX-License-Identifier: MIT */
/* extremes.h - scenes at the edge of what numbers, bodies and calls can be, as rows of tables.

   A row says how its scene must end, in each of the three precisions: right to a stated bound, or refused by a named status. Whatever
   it is, no number that the body shows may be NaN or infinite, no memory may be left, and it may not take long. Each row states its
   SOURCE OF TRUTH. A file holds the rows of one subject and their scenes; extremes.c plays them all. */
#ifndef EXTREMES_H
#define EXTREMES_H

#include "../peri_test.h"

typedef struct outcome {
    int32_t     status; /* PERI_OK, or the first failure that the scene came to                                           */
    const char *field;  /* that its record names, "" where none; of a scene that came to its end: the worst case in it    */
    double      error;  /* distance from the truth, as a part of it                                                       */
} outcome;

#define NOT_FINITE (-1000) /* statuses of outcomes besides those of peri: a number that the body shows is NaN or infinite, and */
#define SPOILED    (-1001) /* a call that was refused has changed something, or another that must be refused was not       */

typedef struct extreme {
    const char *name;
    const char *truth;
    outcome (*play)(const struct extreme *row, int32_t precision);
    double      value, other; /* what the scene makes of them                                                             */
    int32_t     choice;
    int32_t     status;   /* how it must end                                                                              */
    const char *field;    /* that the record must name; NULL: whichever                                                   */
    double      bound[3]; /* largest error in double, mixed and single precision                                          */
} extreme;

typedef struct extreme_table {
    const char    *subject;
    const extreme *rows;
    int            count;
} extreme_table;

#define EXTREME_TABLE(subject, rows) {subject, rows, (int)(sizeof(rows) / sizeof(rows)[0])}

/* The allocator of the scenes: counts, fills what it gives and what it takes back with a pattern that reads as NaN, checks sizes. All is
   zero before each row. */
typedef struct extreme_pool {
    int64_t blocks;  /* that live                                                                                         */
    int64_t bytes;   /* in them                                                                                           */
    int64_t calls;   /* so far                                                                                            */
    int64_t fail_at; /* the call that returns NULL, from 1; 0: none                                                       */
    int64_t limit;   /* most bytes at a time; 0: any                                                                      */
    size_t  offset;  /* of the pointers that it gives from an address that suits all types                                */
    int     wrong;
} extreme_pool;
extern extreme_pool extreme_memory;

/* The id of the k-th material, 1 the first. */
static inline int32_t material_id(const peri_body *b, int64_t k) { return peri_id(b, PERI_KIND_MATERIAL, k); }

extern int extreme_long; /* 1: with --long, for scenes that then do more                                                */

/* A descriptor with defaults, one thread and that allocator. */
void extreme_desc(peri_body_desc *desc, int32_t space, int32_t precision, double horizon);

/* A material of unit modulus and density; poisson is of state-based laws. Bonds break where stretch > 0. */
void extreme_material(peri_material_desc *material, int32_t law, double poisson, double stretch);

/* A built body of one material, in cells of `spacing` from the origin to hi; what fails is noted. NULL where there is none. */
peri_body *extreme_box(outcome *o, const peri_body_desc *desc, const peri_material_desc *material, const double *hi, double spacing);

/* Notes the first failure of a body, with the field that its record names. True where the result is one. b may be NULL. */
int extreme_fails(outcome *o, const peri_body *b, int64_t result);

/* What ends every scene: reads all there is to read of a body that was built, whatever has happened to it but an instability, notes
   numbers that are not finite, and destroys it. b may be NULL. */
outcome extreme_end(outcome o, peri_body *b);

/* The larger one, NaN where either is. */
double extreme_worst(double a, double b);

/* Half a unit in the last place of 1, in the arithmetic of bonds. */
double extreme_roundoff(int32_t precision);

/* Keeps the larger error, NaN included, and names its case: a text and up to three numbers of up to three digits. */
void extreme_take(outcome *o, double error, const char *what, int a, int b, int c);

/* Notes an error of one of a scene's combinations, and where the row does not bear it prints what the format says: which it is. */
void extreme_note(outcome *o, const extreme *row, int32_t precision, double error, const char *format, ...);

/* A new array of a field of points; NULL where the call fails, which is noted. */
double *extreme_read(outcome *o, peri_body *b, int32_t field);

/* The set of points with coordinate `axis` between from and to; what fails is noted. */
int32_t extreme_slab(outcome *o, peri_body *b, int axis, double from, double to);

/* Writes u = G x, G[dim*dim] by rows, x from `origin`[dim] (NULL: the origin). */
void extreme_affine(outcome *o, peri_body *b, const double *gradient, const double *origin);

extern const extreme_table extreme_units, extreme_elasticity, extreme_motion, extreme_stretches, extreme_families, extreme_damage,
    extreme_cracks, extreme_tiny, extreme_time, extreme_pairs, extreme_statics, extreme_solids, extreme_trusses, extreme_sizes,
    extreme_callbacks, extreme_allocation, extreme_hooks, extreme_rounding;

#endif
