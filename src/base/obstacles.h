/* SPDX-License-Identifier: MIT */
/* obstacles.h - obstacles: their shapes, where they are, and how free ones move. Inner units.

   An obstacle has a frame of its own, in which its shape lies: x = position + axes y. In 2D a turn is an angle and what turns has one
   component, the last: spin[2], turning[2], moment[2]. */
#ifndef PERI_OBSTACLES_H
#define PERI_OBSTACLES_H

#define PERI__REMOVED 0 /* instead of the shape of an obstacle                                                             */

typedef struct peri__mesh { /* closed surface of triangles, or of segments in 2D; its block, which begins with this, holds the arrays */
    int64_t  bytes, vertices, faces;
    int32_t  corners;       /* of a face: the dimension                                                                    */
    double  *vertex;        /* [vertices][3]                                                                               */
    double  *face_normal;   /* [faces][3] unit, outward                                                                    */
    double  *edge_normal;   /* [faces][3][3] of the edge from corner k on: the sum of those of its two faces; 3D           */
    double  *vertex_normal; /* [vertices][3] those of its faces, weighed by their angles                                   */
    double  *box;           /* [2*faces-1][6] least and largest coordinates of what hangs on a node of the tree            */
    int32_t *face;          /* [faces][corners]                                                                            */
    int32_t *order;         /* [faces] faces by leaf of the tree                                                           */
} peri__mesh;

typedef struct peri__solid { /* what an obstacle is made of, in its own frame                                             */
    int32_t     shape;        /* peri_shape                                                                                */
    double      direction[3]; /* unit: the normal of a plane, the axis of a capsule or a cylinder                          */
    double      half[3];      /* half the edges of a box; [0]: half the length of a capsule or a cylinder                  */
    double      radius;       /* of a signed distance: nothing lies further out                                            */
    peri__mesh *mesh;         /* owned; NULL but for meshes                                                                */
    peri_distance_fn distance;
} peri__solid;

typedef struct peri__free_body { /* the motion of an obstacle that has a mass; in its own frame: centre, inertia, inverse  */
    double mass, centre[3];     /* of mass                                                                                 */
    double inertia[9], inverse[9]; /* about it; both 0 along what never turns                                              */
    double gravity[3];
    double velocity[3], turning[3]; /* of the centre of mass; angular momentum about it, [2] in 2D                        */
    double velocity0[3], turning0[3];
    double force[3], moment[3]; /* of the body on it, at its centre of mass, when last worked out                         */
    double touched, swept;        /* sum of V, and of V |r x n|^2, over the points near then                                 */
} peri__free_body;

#define PERI_TALLIED 9 /* per block of points: force, moment about the frame's origin, energy lost, V, V |r x n|^2, of those near */
#define PERI_KEPT 4    /* per point: a0, 0 where not in touch; and what the obstacle takes energy by: its force density less k depth n */

struct peri__obstacle { /* inner units                                                                                    */
    int32_t        kind;        /* peri_shape, or PERI__REMOVED                                                            */
    int32_t        turned;      /* 1: the axes of the frame are not those of the body                                      */
    int32_t        lossy;       /* 1: friction, or a restitution below 1                                                   */
    peri__solid    solid;
    double         position[3], position0[3], turn[4], turn0[4]; /* of the frame, now and at the start: angle, or quaternion */
    double         axes[9];     /* columns: the axes of the frame                                                          */
    double         normal[3];   /* of a plane, in the body's frame                                                         */
    double         velocity[3], spin[3]; /* of the frame, over the last step; of a free one now. spin[2] in 2D             */
    double         stiffness, friction, friction_speed;
    double         hysteresis;  /* w of the normal force k depth (1 + w a/a0), a0 the largest speed of approach            */
    double         force[3], moment[3]; /* on the body, when last worked out; moment about the origin of the frame; where tallied */
    double         lost;        /* to friction and hysteresis                                                              */
    double        *kept;        /* [points][PERI_KEPT]; NULL of smooth ones                                                */
    double        *tally;       /* [blocks][PERI_TALLIED]; NULL of smooth ones that are not free                              */
    peri__free_body *free;      /* NULL: goes where `motion` says                                                          */
    peri_motion_fn motion;
    void          *user;
};

#endif
