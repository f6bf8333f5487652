/* SPDX-License-Identifier: MIT */
/* study.h - what the two parts of the convergence study [C] share: square lattices of any law, one linear solve, the order of a
   series of errors. */
#ifndef STUDY_H
#define STUDY_H

#include "scene.h"

enum { CONST, INV, LINEAR, QUADR, CUBIC, SHAPES }; /* the influence functions of [C] table 2 */
static const int32_t study_influence[SHAPES] = {PERI_INFLUENCE_CONSTANT, PERI_INFLUENCE_INVERSE, PERI_INFLUENCE_LINEAR,
                                                PERI_INFLUENCE_POWER_2, PERI_INFLUENCE_POWER_3};
static const char *const shape_name[SHAPES] = {"Const", "Inv", "Linear", "Quadr", "Cubic"};

/* A law with its means against its own errors. Stabilization counts for correspondence only, where 0 is the "gradient" law of [C]. */
typedef struct study_law {
    int32_t law, correction;
    double  stabilization;
    const char *name;
} study_law;

static const study_law SILLING = {PERI_LAW_LPS, PERI_CORRECTION_NONE, 0, "Silling"};
static const study_law OTERKUS = {PERI_LAW_OTERKUS, PERI_CORRECTION_NONE, 0, "Oterkus"};
static const study_law GRADIENT = {PERI_LAW_CORRESPONDENCE, PERI_CORRECTION_NONE, 0, "gradient"};

/* A square with cells x cells points at the centres of its cells, one corner at lo[2]; plane strain, small displacements. */
static inline peri_body *study_square(const study_law *law, int shape, double ratio, int cells, const double *lo, double side, double young,
                                      double nu) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRAIN, law->law, nu, side / cells, ratio, cells, cells, 1);
    s.desc.geometry = PERI_GEOMETRY_LINEAR;
    s.desc.influence = study_influence[shape];
    s.desc.correction = law->correction;
    s.material.young = young;
    if (law->law == PERI_LAW_CORRESPONDENCE) s.material.stabilization = law->stabilization;
    for (int d = 0; d < 2; ++d) {
        s.lo[d] = lo[d];
        s.hi[d] = lo[d] + side;
    }
    peri_body *b = specimen_make(&s);
    CHECK(peri_point_count(b) == (int64_t)cells * cells);
    return b;
}

static inline int32_t study_box(peri_body *b, double x0, double y0, double x1, double y1) {
    double lo[2], hi[2];
    lo[0] = x0;
    lo[1] = y0;
    hi[0] = x1;
    hi[1] = y1;
    return (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi));
}

/* One linear solve without fracture. Returns the status of peri_solve, which a singular system may fail. */
static inline int32_t study_solve(peri_body *b, double tolerance, int64_t iterations, peri_solve_report *report) {
    peri_solve_desc s;
    peri_solve_desc_init(&s);
    s.fracture = 0;
    s.tolerance = tolerance;
    s.iterations = iterations;
    s.halvings = 0;
    return peri_solve(b, &s, report);
}

/* The slope of the least-squares line through (log h, log |error|), [C] 37. */
static inline double study_order(int count, const double *h, const double *error) {
    double sum[4] = {0, 0, 0, 0};
    int k;
    for (k = 0; k < count; ++k) {
        const double x = log(h[k]), y = log(fabs(error[k]));
        sum[0] += x;
        sum[1] += y;
        sum[2] += x * x;
        sum[3] += x * y;
    }
    return (count * sum[3] - sum[0] * sum[1]) / (count * sum[2] - sum[0] * sum[0]);
}

#endif
