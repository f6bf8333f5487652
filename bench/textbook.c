/* SPDX-License-Identifier: MIT */
/* textbook.c - the loops of a textbook, compiled -O2 -march=native: every bond by itself, each point gathering its own, one thread.

     bond-based   f_i = sum c V_j s (xi+eta)/|xi+eta|,  s = (|xi+eta| - |xi|)/|xi|
     LPS          theta_i = (D/m_i) sum |xi| e V_j, then
                  f_i = sum ((A theta_i/m_i + A theta_j/m_j) |xi| + (B/m_i + B/m_j) e) V_j (xi+eta)/|xi+eta|

   with ids of 32 bits, lengths, weights and a byte per bond that says whether it lives, all stored, rows of equal width; a bond beyond its
   critical stretch is marked as broken. Only the force pass: no integration. Nothing is done that a first course would not do, and
   nothing is left out for show: the dimension is a constant of the loops, positions and displacements lie by points. */
#include "suite.h"

#define REAL double
#define ROOT sqrt
#define NAME(x) double_##x
#include "textbook.inl"
#undef REAL
#undef ROOT
#undef NAME
#define REAL float
#define ROOT sqrtf
#define NAME(x) float_##x
#include "textbook.inl"

struct textbook {
    int64_t       n, width;
    int32_t       dim, lps, single;
    int32_t      *count;
    uint8_t      *live;
    double_arrays of_double;
    float_arrays  of_float;
};

textbook *textbook_make(const textbook_input *in, int32_t single) {
    textbook *t = (textbook *)calloc(1, sizeof *t);
    if (!t) exit(1);
    t->n = in->n;
    t->width = in->width;
    t->dim = in->dim;
    t->lps = in->lps;
    t->single = single;
    t->count = (int32_t *)calloc((size_t)in->n, sizeof *t->count);
    t->live = (uint8_t *)malloc((size_t)(in->n * in->width));
    if (!t->count || !t->live) exit(1);
    memset(t->live, 1, (size_t)(in->n * in->width));
    for (int64_t i = 0; i < in->n; ++i)
        while (t->count[i] < in->width && in->id[i * in->width + t->count[i]] != i) t->count[i]++;
    if (single) float_fill(&t->of_float, in, t->count, t->live);
    else double_fill(&t->of_double, in, t->count, t->live);
    return t;
}

void textbook_force(textbook *t) {
    if (t->single) float_force(&t->of_float, t->n, t->width, t->dim, t->lps);
    else double_force(&t->of_double, t->n, t->width, t->dim, t->lps);
}

double textbook_error(const textbook *t, const double *force) {
    return t->single ? float_error(&t->of_float, force, t->n * t->dim) : double_error(&t->of_double, force, t->n * t->dim);
}

void textbook_free(textbook *t) {
    if (t->single) float_clear(&t->of_float);
    else double_clear(&t->of_double);
    free(t->count);
    free(t->live);
    free(t);
}
