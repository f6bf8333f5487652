/* SPDX-License-Identifier: MIT */
/* solver.h - what a static solve takes, and gives back at its end: a part of types.h. */
#ifndef PERI_SOLVER_H
#define PERI_SOLVER_H

typedef struct peri__floating_part { /* connected points that some rigid motions leave without resistance                */
    double  centre[3], radius;
    int32_t modes;
    double  mode[PERI_RIGID_MODES][PERI_RIGID_MODES];    /* [modes]: of the rigid motions                                */
    double  inverse[PERI_RIGID_MODES][PERI_RIGID_MODES]; /* of the mass of the modes                                     */
    double  sum[PERI_RIGID_MODES];                 /* scratch                                                            */
} peri__floating_part;

typedef struct peri__multilevel peri__multilevel;
typedef struct peri__hold peri__hold; /* by an obstacle: statics/touch.c                                                     */

#define PERI_SINGULAR 8 /* in constrained: the bonds of the point resist only in some of the free directions             */
#define PERI_LOADED 16  /* in constrained: a load acts on the point                                                      */

struct peri__kept { /* what a solve leaves to the next, in blocks of b->keeping                                          */
    peri__multilevel *levels;
    void             *blocks; /* as those of peri__solver, inverted where `ready`                                         */
    uint8_t          *axes;   /* [points] that supports held,                                                             */
    uint32_t         *alive;  /* [points][words] and the bonds, when these were made; NULL where all were whole            */
    double            stiff, softest, pace, lost;
    int32_t           preconditioner, ready; /* ready: all of it serves as it is: linear, and nothing was loose           */
};

typedef struct peri__solver { /* what a static solve takes, and gives back at its end                                     */
    peri_body          *body;
    const peri_solve_desc *settings;
    double              load_from; /* where the load factor begins                                                       */
    peri_solve_report   report;
    peri__krylov        k;
    peri__tangent       t;
    void               *blocks;   /* real [packed][stride]                                                               */
    void               *before;   /* real [dim][stride] displacement at the last equilibrium; NULL where it is not needed */
    void               *rate;     /* real [dim][stride] change of the displacement with the load factor; NULL without fracture control */
    void               *from;     /* real [dim][stride] displacement before the last solve; NULL, like the next, without a ledger */
    void               *place;    /* real [dim][stride] where springs of inertia pull points; NULL but in implicit.c      */
    double              inertia;  /* their stiffness over the density; 0 in equilibria                                    */
    void               *load;     /* real [dim][stride] force density of loads and reactions then               */
    uint8_t            *constrained;     /* [points] axes, PERI_SINGULAR, PERI_LOADED                                    */
    int32_t            *part_of;  /* [points] part, or less than 0: rigid_modes.c                                        */
    int32_t            *queue;    /* [points] scratch                                                                    */
    peri__floating_part     *parts;
    int64_t             part_count, part_capacity;
    peri__hold         *contacts; /* what obstacles hold, or may come to hold                                            */
    int64_t             contact_count, contact_capacity;
    int32_t            *leaning;  /* [points] 1, 2, ...: of a part that would be loose without obstacles; NULL without them */
    int32_t             leaning_count, counted, bridged, hanging; /* see touch.c                                         */
    peri__kept         *kept;     /* that of the body, whose blocks and levels are these; NULL: they go with the solve       */
    peri__multilevel   *levels;
    double              pace;     /* iterations per e-fold of the residual that the levels took when they were new; 0: not yet known */
    double              lost;     /* iterations that they have taken more since, as bonds broke                           */
    int64_t             singular;  /* points that are                                                                    */
    double              stiff;    /* mean of the diagonal of the stiffness                                               */
    double              softest;  /* the smallest trace of a diagonal block                                              */
    double              scale;    /* the larger of |loads and eigenstrain| and |reactions|                                */
    double              strained; /* |V f| of what is free, of the eigenstrain at rest                                  */
    double              slope;    /* r.d of the last linear solve, r as it was before                                     */
    double              top;      /* the largest scale of this call                                                      */
    double              widest;   /* the longest way that a constrained component still had to go                        */
    double              floor;    /* |r| that is rounding, of bonds over displacements                                   */
    double              rough;    /* a tolerance that will do for now: more bonds are to break; else 0                   */
    double              energy0;  /* r.z at the start of this equilibrium                                                */
    int32_t             energy_done; /* 1: the linear solve was ended by energy_tolerance                                */
    int32_t             begun;    /* 1: the body has been changed                                                        */
    int32_t             disturbed; /* 1: on_step has changed what acts, or the bonds                                      */
    int32_t             cut;      /* 1: on_step has cut bonds, whose equilibrium is another                               */
    peri_error          failure;  /* why the last step ended: the body's record only where it is not halved               */
    int64_t             left;     /* iterations that may still be taken for this equilibrium                             */
    int64_t             broken_before; /* report.broken when this load step began                                         */
    int64_t             bytes;    /* taken now                                                                           */
    int32_t             secants, negative; /* 1: the tangent is that of secants; the last linear solve met negative curvature */
} peri__solver;

#endif
