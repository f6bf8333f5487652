/* SPDX-License-Identifier: MIT */
/* pairs.h - what the bonds between two materials have in common, their limits above all; how a bond breaks, and what points gather. */
#ifndef PERI_PAIRS_H
#define PERI_PAIRS_H

typedef enum peri__seen { /* how passes on vectors see that a bond may be over a criterion; rows decide                   */
    PERI__BY_STRETCH = 0,     /* its stretch nears the limit: nothing need be kept                                        */
    PERI__BY_WORK = 1,        /* the work done on it does: bodies keep that of every bond                                 */
    PERI__BY_NODE_ENERGY = 2, /* the energy of its ends does: bodies keep that of every point over the volume of its family */
    PERI__BY_ROWS = 4,        /* not at all: every bond is looked at by rows                                              */
    PERI__BY_STRESS = 8,      /* the stress of its ends does: bodies keep that of every point                             */
    PERI__AND_MORE = 16,      /* its stretch does, but rows ask for more than that                                        */
    PERI__AND_LEAST = 32,     /* the least stretch at its ends: bodies keep that of every point                           */
    PERI__AND_PAST = 64       /* how long it has been over its limit: bodies keep that of every bond                      */
} peri__seen;

typedef struct peri__pair { /* constants of the bonds between two materials, in inner units                               */
    double c; /* of the end whose row this is; the same from both where both laws are pairwise                           */
    double limit[peri__count_criterion]; /* by criterion; PERI_NEVER where neither material has it                       */
    double s0; /* the least limit of those seen by stretch: no bond breaks below it                                      */
    double friction;    /* tangent of the angle of friction; of the material of the lower limit, like the next           */
    double compression; /* what a unit of the least stretch at the ends takes from the critical stretch                  */
    double rate, power; /* of stretch, at which strength doubles, in the unit of the caller; how strength goes with it   */
    double delay;       /* how long a bond is over its limit before it breaks, likewise                                  */
} peri__pair;

typedef struct peri__parting { /* how a bond breaks within a step: PERI_FN(part)                                         */
    double met;    /* the extension at which it breaks, over that at the end of the step                                 */
    double moment; /* when, as a part of the step                                                                        */
    double share;  /* what it still gives, over the force at the end of the step times half a step                       */
} peri__parting;

typedef enum peri__gather { /* what a point makes of its family before forces can be had                                  */
    PERI__NO_GATHER = 0,
    PERI__DILATATION = 1,
    PERI__GRADIENT = 2
} peri__gather;

#endif
