/* SPDX-License-Identifier: MIT */
/* bond_laws.h - what is said of the bonds between two materials: interfaces, and laws of bonds: what pulls at a bond of a given stretch and
   history, a table or a function of the caller. A bunch is some bonds of a row, for which passes ask their laws. */
#ifndef PERI_BOND_LAWS_H
#define PERI_BOND_LAWS_H

struct peri__interface {
    int32_t            i, j;
    peri_material_desc material;
};

#define PERI_BUNCH 64            /* bonds of a row that laws of bonds are asked for at once                               */
#define PERI_BOND_STATES 8       /* most numbers that such a law keeps per bond                                           */
#define PERI_SOFTENING_POINTS 32 /* of a table, with its straight beginning                                              */
#define PERI_BOND_LAWS 255

/* The law of the bonds between two materials where it is not c w s: a table, or a function of the caller. Forces are over c w: that of a
   linear bond is its stretch. */
struct peri__bond_law {
    int32_t i, j;             /* indices of the materials                                                                */
    int32_t states;           /* numbers kept per bond; of a table 1: the farthest stretch past `first`                  */
    int32_t brittle;          /* 1: the table is none: bonds break at `last`                                             */
    peri_bond_law_fn fn;      /* NULL: the table                                                                         */
    void   *user;
    int32_t unloading, given; /* given: rows of `shape`                                                                  */
    double  strength, fracture_energy, compression; /* units of the caller                                               */
    double  shape[PERI_SOFTENING_POINTS][2]; /* stretch past the strength, of any scale; force over the strength         */
    double  first, last;      /* stretches at which bonds begin to soften, and break; NaN before peri_build              */
    int32_t count;            /* points of the curve: force at a stretch, and the area up to there; straight between     */
    double  stretch[PERI_SOFTENING_POINTS], force[PERI_SOFTENING_POINTS], area[PERI_SOFTENING_POINTS];
};

typedef enum peri__asked { /* of laws of bonds, beside the force                                                         */
    PERI__ASK_TANGENT = 1,
    PERI__ASK_ENERGY = 2,
    PERI__ASK_HISTORY = 4 /* what is lost, what breaks, and the state                                                    */
} peri__asked;

typedef struct peri__bunch { /* some bonds of a row, and what their laws make of their stretch                           */
    int32_t count, asked;
    int64_t point, first; /* of peri__ask_bond: whose, and which, the last were; point < 0: none                         */
    int32_t failed;       /* of peri__ask_bond: 1 where a law has failed                                                */
    int32_t others[PERI_BUNCH], broken[PERI_BUNCH];
    double  length[PERI_BUNCH], stretch[PERI_BUNCH], force[PERI_BUNCH], tangent[PERI_BUNCH], energy[PERI_BUNCH], lost[PERI_BUNCH];
    double  state[PERI_BUNCH * PERI_BOND_STATES]; /* [count][states of the model]                                        */
} peri__bunch;

#endif
