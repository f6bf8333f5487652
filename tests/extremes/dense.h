/* SPDX-License-Identifier: MIT */
/* dense.h - the four laws of peri.h written out bond by bond in double, for any positions and displacements: an independent answer for
   the force and energy densities of a body, with a measure of what rounding may do to them. */
#ifndef DENSE_H
#define DENSE_H

#include "extremes.h"

/* Bounds of so many units of rounding, per precision; bonds of mixed precision are worked on in single. */
#define ROUNDINGS(n) {(n) * 1.1102230246251565e-16, (n) * 5.9604644775390625e-8, (n) * 5.9604644775390625e-8}

/* Largest distance between the body's force densities, energy densities, total force, torque and elastic energy and those of the laws, each
   over the sum of the sizes of its terms times their condition: of the order of the unit of rounding, whatever the displacement. w = 1,
   whole cells, no correction; m[] in the order in which they were added. NaN where a call fails, which is noted. */
double dense_error(outcome *o, peri_body *b, const peri_body_desc *d, const peri_material_desc *m);

/* A built box of n^dim unit cells with a corner at the origin. NULL where a call fails, which is noted. */
peri_body *dense_box(outcome *o, const peri_body_desc *d, const peri_material_desc *m, int n);

/* A built body of points of yours. */
peri_body *dense_cloud(outcome *o, const peri_body_desc *d, const peri_material_desc *m, int64_t count, const double *x,
                       const double *volume);

/* Adds random numbers within +-size to each component of the displacements. */
void dense_scatter(outcome *o, peri_body *b, double size, uint64_t seed);

/* Takes note of a part of a row: its error, and where it is the worst so far its place. Space and law of it. */
void dense_note(outcome *o, double error, int32_t space, int32_t law);

/* Of a material: lambda, mu and lambda + 2 mu/D of the space (lambda' in plane stress); Young's modulus is 1. */
typedef struct dense_moduli {
    double lambda, mu, bulk;
} dense_moduli;
dense_moduli dense_moduli_of(const peri_material_desc *m, int32_t space);

/* c of a bond-based material of the infinite body, w = 1: [T] 1.24, [P] C.15, C.18. */
double dense_micromodulus(int32_t space, double horizon);

#endif
