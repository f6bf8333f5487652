/* SPDX-License-Identifier: MIT */
/* cells.h - cells of the caller, of one call; kept up to peri_build, and where the quadrature takes parts of cells alone. */
#ifndef PERI_CELLS_H
#define PERI_CELLS_H

#define PERI_CORNERS 256 /* of a polygon at most                                                                          */

typedef struct peri__cells { /* a block of memory, with its arrays behind it                                              */
    int64_t  bytes;
    double   radius; /* [L] the largest distance of a corner from the point of its cell                                   */
    int64_t *first;  /* [cells+1] of the corners of a cell                                                                */
    double  *corner; /* [corners][dim] [L] from the point; counter-clockwise in planes, else such that faces look outwards */
} peri__cells;

#endif
