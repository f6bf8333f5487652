/* SPDX-License-Identifier: MIT */
/* progress.h - how far a body has come, what is stale of it, and who is at work on it. */
#ifndef PERI_PROGRESS_H
#define PERI_PROGRESS_H

typedef struct peri__ledger { /* inner units of energy; doubles alone                                                     */
    double external, obstacle, damping, fracture, initial;
    double before; /* kinetic + elastic before the first unaccounted change, while PERI__STALE_LEDGER                    */
    double others; /* of `external`: work of the other bodies of a world                                                */
    double rubbed; /* what dashpots and friction between them took, each body's half                                     */
} peri__ledger;

/* What is derived from the state and no longer belongs to it: see stale.c. Where masks or constants are stale the force is, too. */
typedef enum peri__stale {
    PERI__STALE_MASKS = 1,     /* body->masks: bonds have been cut or mended since                                 */
    PERI__STALE_CONSTANTS = 2, /* body->constant, gather_row_sum, row_sum, largest_row_sum, central: likewise, where laws are state-based */
    PERI__STALE_FORCE = 4,     /* body->f and all that comes with it: push, response, reactions, places of obstacles     */
    PERI__STALE_LEDGER = 8,    /* ledger.initial lacks a change by the caller: that from ledger.before to now            */
    PERI__STALE_BALANCE = 16,  /* the equilibrium that peri_solve has found: what acts, or the bonds, are others         */
    PERI__STALE_SHARP = 32,    /* body->sharp: bonds of which it was made have been cut or mended since; or never asked for */
    PERI__STALE_STRETCH = 64,  /* now.stiffer: displacements were changed since, not by a run                            */
    PERI__STALE_PAST = 128     /* of inelastic bodies: what a change by the caller makes of them in no time              */
} peri__stale;

/* How far a body has come: what a clone takes over as it is and peri_reset begins anew. The arrays of the state are in arrays.c. A list, so
   that no member is missing in a checkpoint:
     cut, broken  directed bonds
     time         [T], the caller's unit: a run ends at its duration to the last bit
     fragments, fragment_dead   how many are known, 0: none; `cut` + `broken` when they were
     loaded       1: loads have acted, by a solve or a run
     load_factor  of constant loads and supports; the time of callbacks where `still`
     still        1: the last motion was a static one
     torn         1: a run is under way; where no call is, a callback left it by a jump
     pushed       1: the force is with that of other bodies of a world
     stiffer      what the deformation makes of the square of the highest frequency: stretched.c
     stale        bits of peri__stale */
#define PERI_PROGRESS_LIST(X)                                                                                          \
    X(int64_t, cut)                                                                                                    \
    X(int64_t, broken)                                                                                                 \
    X(int64_t, steps)                                                                                                  \
    X(int64_t, fragments)                                                                                              \
    X(int64_t, fragment_dead)                                                                                          \
    X(double, time)                                                                                                    \
    X(int32_t, loaded)                                                                                                 \
    X(double, load_factor)                                                                                             \
    X(int32_t, still)                                                                                                  \
    X(int32_t, torn)                                                                                                   \
    X(int32_t, pushed)                                                                                                 \
    X(double, stiffer)                                                                                                 \
    X(uint32_t, stale)
#define PERI_PROGRESS_MEMBER_(type, name) type name;
typedef struct peri__progress {
    PERI_PROGRESS_LIST(PERI_PROGRESS_MEMBER_)
    peri__ledger ledger;
} peri__progress;

/* Who is at work on a body: peri__enter and peri__leave of status.c. */
typedef enum peri__running {
    PERI__IDLE,
    PERI__IN_FRAME,    /* on_frame or on_step: the state stays; bonds and what acts may change                           */
    PERI__IN_CALLBACK, /* any other callback, or a call that makes some: nothing may change                              */
    PERI__IN_LOG       /* likewise, and the log is silent                                                                */
} peri__running;

#endif
