/* SPDX-License-Identifier: MIT */
/* past.h - what inelastic materials keep of their past: flow.c, own_stress.c.

     inelastic extension   the part c of e that gives no force, per directed bond: T = w (p g + q (e - c)) M. It flows: c grows
     past      history: what materials have come to. commit: it takes what the last pass made of it; until then that is a trial
     raw       of a point: the stress is the caller's, and gathers leave H in place of Q. moduli: dP/dH */
#ifndef PERI_PAST_H
#define PERI_PAST_H

typedef enum peri__inelastic { /* what a material is beyond the elasticity of its law                                   */
    PERI__FLOWS = 1,     /* bonds have an inelastic extension: flow.c                                                     */
    PERI__OWN_STRESS = 2 /* the stress is the caller's: own_stress.c                                                      */
} peri__inelastic;

typedef struct peri__past_model { /* of a model                                                                         */
    int32_t bond;  /* reals of history per directed bond: 0, or 1 + the internal ones                                   */
    int32_t point; /* numbers of history per point, the most that a stress of the caller's wants                         */
    uint8_t raw[PERI_MATERIAL_LIMIT]; /* 1: points of the material are raw                                                */
} peri__past_model;

typedef struct peri__past_pass { /* of a pass over the points                                                            */
    const uint8_t *raw; /* [materials]; NULL: no point is taken as raw                                                   */
    int32_t commit;     /* 1: the history takes what the pass makes of it                                                 */
    double *moduli;     /* [points][dim^4] out: moduli of raw points; or NULL                                             */
    double  taken;      /* out: energy that raw points dissipate, of a pass that commits                                  */
} peri__past_pass;

typedef struct peri__past { /* of a body; NULL unless bonds flow, or points are raw                                      */
    int64_t *start;     /* [points+1] where the directed bonds of a point begin in the next four                         */
    int32_t *mirror;    /* [bonds] which bond of its row the same bond is at the other end                                */
    double  *flow;      /* [bonds] c at the displacement looked at last                                                  */
    double  *change;    /* [bonds] scratch of tangents: its change                                                        */
    double  *bond;      /* [bonds][model->past.bond] history                                                              */
    double  *point;     /* [points][model->past.point] history of raw points,                                             */
    double  *trial;     /* and what the caller made of it last                                                            */
    int32_t  said;      /* what a peri_stress_fn returned as it failed, at point said_at; 1: it wrote what is not finite  */
    int64_t  said_at;
    int32_t  settling;  /* 1: history takes what the caller's change of the motion makes of it                            */
} peri__past;

#endif
