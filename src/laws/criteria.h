/* SPDX-License-Identifier: MIT */
/* criteria.h - when bonds break, and the list of criteria. A bond breaks where its value passes the limit of its pair of materials,
   peri__pair.limit, PERI_NEVER where neither material has the criterion.

   A criterion is one file and its place in criteria.inl, included in four roles: how it is seen, and whether bonds that are shorter than at
   rest break by it (here); its limit, from what the material gives; whether a bond is over it, and at which part of its extension it came
   to be, for the kernels; and by how much, for equilibria. One of stress has a fifth: the most that any bond of a point can have of it. */
#ifndef PERI_CRITERIA_H
#define PERI_CRITERIA_H

#define PERI_CRITERION_ROLE_TRAITS
#include "criteria.inl"
#undef PERI_CRITERION_ROLE_TRAITS

/* What a bond of a criterion of stress has: the mean of the stress of its ends; and what that puts on the plane to which the bond, along y,
   is normal. Both ends come to the same bits. */
typedef struct peri__traction {
    double normal, shear;
} peri__traction;

PERI_INLINE peri__traction peri__traction_of(int dim, const double *p, const double *q, const double *y) {
    double square = 0.0, normal = 0.0, whole = 0.0;
    peri__traction traction;
    for (int a = 0; a < dim; ++a) {
        double t = 0.0;
        for (int c = 0; c < dim; ++c) {
            const int at = peri__packed(dim, a, c);
            t += 0.5 * (p[at] + q[at]) * y[c];
        }
        normal += t * y[a];
        whole += t * t;
        square += y[a] * y[a];
    }
    square += DBL_MIN;
    traction.normal = normal / square;
    whole = whole / square - traction.normal * traction.normal;
    traction.shear = whole > 0.0 ? sqrt(whole) : 0.0;
    return traction;
}

/* The least and the largest principal value: in planes of those within it; else the roots of the characteristic cubic by Viete's cosines,
   the angle by atan2, which loses no digits where two values are equal. */
PERI_INLINE void peri__principal_of(int32_t dim, const double *stress, double *least, double *largest) {
    if (dim == 2) {
        const double mean = 0.5 * (stress[0] + stress[1]), radius = hypot(0.5 * (stress[0] - stress[1]), stress[2]);
        *least = mean - radius;
        *largest = mean + radius;
        return;
    }
    const double *s = stress, mean = (s[0] + s[1] + s[2]) / 3.0, x = s[0] - mean, y = s[1] - mean, z = s[2] - mean;
    const double size = (x * x + y * y + z * z + 2.0 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5])) / 6.0;
    const double det = 0.5 * (x * (y * z - s[4] * s[4]) - s[3] * (s[3] * z - s[4] * s[5]) + s[5] * (s[3] * s[4] - y * s[5]));
    const double angle = atan2(sqrt(fmax(0.0, size * size * size - det * det)), det) / 3.0, radius = 2.0 * sqrt(size);
    *largest = mean + radius * cos(angle);
    *least = mean + radius * cos(angle + 2.0943951023931953);
}

/* No bond is normal to just the plane that bears the most: what the bonds of a lattice bear falls short of that, by up to a fifth at a
   horizon of three spacings. So the value of a bond is taken times what the worst plane has over the plane of the best bond of the family:
   the strength then does not depend on how the lattice lies. Of both ends the lesser: it keeps the value below the mean of what the worst
   planes of the ends have, and the corners of bodies, whose families lack directions, from breaking early. */
PERI_INLINE double peri__alignment(const double *aligned, int64_t i, int64_t j, int slot) {
    const double own = aligned[i * PERI_ALIGNED + slot], other = aligned[j * PERI_ALIGNED + slot];
    return own < other ? own : other;
}

/* Of the mean of two stresses: in planes xx yy xy zz. */
PERI_INLINE double peri__equivalent_stress(int dim, const double *p, const double *q) {
    const double x = 0.5 * (p[0] + q[0]), y = 0.5 * (p[1] + q[1]), z = 0.5 * (p[dim == 2 ? 3 : 2] + q[dim == 2 ? 3 : 2]);
    double shear = 0.0;
    for (int k = 3; dim == 3 && k < 6; ++k) shear += 0.25 * (p[k] + q[k]) * (p[k] + q[k]);
    if (dim == 2) shear = 0.25 * (p[2] + q[2]) * (p[2] + q[2]);
    return sqrt(0.5 * ((x - y) * (x - y) + (y - z) * (y - z) + (z - x) * (z - x)) + 3.0 * shear);
}

PERI_SAME_COUNT(criterion, PERI_CRITERION_LIST, peri__count_criterion);

#endif
