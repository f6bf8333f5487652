/* SPDX-License-Identifier: MIT */
/* part.h - a body that is a part of a larger one, or a cell of a periodic one: part.c.

     frame   origin and unit of length, and the mean volume of a point, given instead of inferred: alike on all parts
     ghost   a point that another part owns: it has a displacement, and in a step a velocity, both received; it is in no sum
     image   a ghost whose owner is a point of the same body
     depth   of a ghost: how many bonds lie between it and an owned point, at least; 0 of owned points
     collective   of a call: all parts make it, as it asks the others */
#ifndef PERI_PART_H
#define PERI_PART_H

typedef struct peri__domain {
    peri_part_desc desc;     /* its arrays are those below                                                              */
    int64_t  bytes, points, blocks; /* of this block of memory; that arrays have room for                                */
    int32_t *ghosts;         /* [desc.ghost_count] ascending                                                             */
    int32_t *owners;         /* [desc.ghost_count] of images, else -1                                                    */
    int64_t *ids;            /* [points] in the whole body; NULL where not given                                         */
    int32_t *owned;          /* [points - ghosts] ascending                                                              */
    uint8_t *depth;          /* [points]; PERI_DEEPEST and more alike                                                    */
    uint8_t *force_skip, *gather_skip; /* [blocks] 1: no point there whose force, or response, is needed                  */
} peri__domain;

#define PERI_DEEPEST 3

#endif
