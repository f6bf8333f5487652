/* SPDX-License-Identifier: MIT */
/* types.h - every internal struct, and the glossary of symbols.

   Symbols, as in the source texts:
     i, j      points; j is in the family of i            xi     x_j - x_i, reference bond
     u, v      displacement, velocity                     eta    u_j - u_i, relative displacement
     w         influence function w(|xi|)                 e      extension |xi+eta| - |xi|
     beta      part of cell j within the horizon of i     s      stretch e/|xi|
     V         volume (2D: area)                          c, s0  micromodulus, critical stretch
     theta     dilatation                                 m      weighted volume, sum w |xi|^2 V
     K, F      shape tensor, deformation gradient         H      F - 1, displacement gradient
   Inside, lengths are in units of `length` (the spacing), stresses of `stress` (Young's modulus), densities of `density`,
   times of length*sqrt(density/stress). So c, forces and velocities are of order one for nanometres and for kilometres, and the
   coordinates of a lattice are small half-integers: exact in single precision too. `real` is the type of the state, `bond` that of what
   bonds are reckoned with (peri_r and peri_b of kernels.inl); they differ in mixed precision.

   Words, one meaning each. Bodies and families:
     model     peri__model: the discretisation that peri_build makes. The constitutive law of a material is its law
     law       peri__law: the elasticity of a material; its kind is the `law` of peri_material_desc
     family    the points within the horizon of a point; its bonds are directed, from the point outwards
     row       the family of one point, in one form wherever it is stored (peri__row)
     list      families as rows one after the other; an entry is an index into it, a place a point's index in the order of its rows
     record    what passes over the list need of a neighbour, side by side: record_reals reals per place
     stencil   families of points of lattices, stored by columns: a sparse matrix in sliced ELLPACK (SELL) form with a table of vectors
     group     PERI_GROUP points with successive ids: what a column holds one bond each of. A lane is one of them
     column    bonds of a group along one vector. `columns` counts those of all groups, `kept` those stored: equal groups share them
     vector    in the stencil: a row of its table, what bonds along one lattice vector share. Else an array [dim][stride] over the points
     mask      of a column: a bit per point of the group whose bond carries force; `member`: whose bond exists
     block     PERI_BLOCK points, the unit of parallel work; of a matrix: the dim x dim entries of a pair of points
     plane     one component of an array for all points, `stride` reals long; `margin` reals lie before and after
     partial volume   beta V_j, what counts of cell j in the family of i; weight: w times that; mutual: and times V_i, of which sums take
               a portion, 1/V_i
     pair      constants of bonds between two classes; a point's class is its material, apart where bonds are not to fail
     piece     points that were added by one call; cloud: the points while families are sought
     builder   what the building of the stencil needs and drops; quantum: the unit in which it compares reals
   Laws, for a point and its live family:
     gauge     g of a law, |xi| or 1: theta weighs bonds with it
     gather    the pass that makes theta, or H, of the displacements; the response is what the law makes of them: p, or Q
     calibration   the constants of the law on the bonds left, or all: theta_factor, pressure_factor, spring, stabilization, shape_inverse
     pairwise  of a law: its bonds know of no other bond (bond-based). ordinary: theta is gathered; tensor: H is, a law with a gradient
     collapsed stress   the stress that the bonds of a point carry: sum T xi V, T its half of their force densities
     row sum   of the absolute stiffness of a point over rho: bounds the square of the highest frequency
     gather_row_sum   kappa_i R_i, what a point adds to the row sums of others by theta or H; gather_diagonal: |G_ii|; see stiffness.c
     central   of a group: some points in it or beside it act by springs alone, since their families span too little
   Motion and failure:
     operands  peri__operands: all that a pass over the points may read or write
     dying     bonds whose criterion was met in the last pass; alive: those that carry force; uncut: those not cut before the start
     eigenstrain   the stretch at which a bond bears no force, a field of material; elastic: stretch, extension or strain less that
     work      done on a bond; pull: its force density at the last count; node: the energy of the ends of bonds
     stale     of derived quantities: they no longer belong to the state. stale.c says which follow from which
     ledger    the sums of energy that balance: external work, damping, fracture, obstacles; contact is stored, like elastic energy
     side      a pair of adjacent points, and what is between their cells: sides.c
   Contact:
     touch     of a pair: nearer than the distance declared, and than in the reference, and no bond joins them
     exposed   of a point: it is at a surface, or lost a bond, so that it can touch; member: it has a row of candidates
     candidate a pair that may touch before the lists are made again; open: it may now; it sleeps while its bond lives
     drag      the force of dashpots and friction, beside that of the springs; crowd: the largest row sum of springs over rho
   Statics:
     constrained   of a degree of freedom (dof): it moves as a support prescribes; the others are free
     floating part connected points that some rigid-body modes leave without resistance
     singular  of a point: its bonds resist only in some of its free directions
     tangent   the derivative of the forces; product: what it makes of a change of the displacements
     level     nodes of the multigrid preconditioner at the sites of a grid, several where the body is cut through at a site; block: what
               couples two of them; patch: connected points of a cell
   Advice:
     estimate  peri__estimate: a body that is only described, and the counts found of it; jitter: how far its points may be off their sites

   Who owns what: peri__model is what peri_build makes and nothing changes afterwards; clones share it by count.
   peri_body holds the rest. */
#ifndef PERI_TYPES_H
#define PERI_TYPES_H

#define PERI_BLOCK 64          /* points per task; totals are summed block by block, whatever the threads                */
#define PERI_GROUP 16          /* points per group of the stencil; component planes are padded to a multiple of it       */
#define PERI_MATERIAL_LIMIT 120 /* a point's class is material + (no-fail ? materials : 0), in 8 bits                    */
#define PERI_ALIGNED 2         /* criteria that look at planes                                                           */
#define PERI_NEVER 1e30        /* critical stretch of bonds that do not break; finite, so that 0*PERI_NEVER is 0         */

/* Lists that belong to an enum are macros LIST(X), which call X(name, number, ...) for each entry. An entry that the enum has and the
   list has not, or another number of the same name, does not compile. */
#define PERI_ONE_(...) +1
#define PERI_SAME_NUMBER_(name, same) typedef char peri__number_of_##name[(same) ? 1 : -1];
#define PERI_SAME_COUNT(name, list, count) typedef char peri__count_of_##name[(list(PERI_ONE_)) == (count) ? 1 : -1]

typedef struct peri__taken peri__taken; /* a block that a call has taken for itself, see memory.c                        */

typedef struct peri__memory {
    peri_allocate_fn allocate;
    peri_release_fn  release;
    void            *user;
    peri__taken    **taken; /* where the blocks of calls are listed; NULL: these blocks belong to a body or a model      */
} peri__memory;

#include "cells.h" /* cells of the caller */

/* Where points came from: a lattice of cells, or the caller's arrays. A point of a lattice piece is at
   origin + local*cell per axis, local being half-integers (or moved centroids); a caller's point is at local. */
typedef struct peri__piece {
    int64_t first, count;
    int32_t lattice;      /* 1: cells are boxes or moved boxes; 0: the caller's points                                    */
    peri__cells *shapes;  /* of the cells of the caller; NULL: where there is no lattice they are taken as squares or cubes */
    double  origin[3];    /* [L] lower corner                                                                            */
    double  cell[3];      /* [L] edges of a cell                                                                         */
    int64_t cells[3];     /* cells per axis                                                                              */
    double *vertices;     /* moved vertices in cell units, [(cells+1)^dim][dim], x fastest; NULL where none moved         */
    int64_t vertex_bytes;
    double  amount;       /* how far vertices moved, of a quarter of a cell, and by which random numbers: models keep these alone */
    uint64_t seed;
} peri__piece;

#include "part.h" /* bodies that are parts of larger ones */

/* What is described before peri_build. */
typedef struct peri__setup {
    peri__piece *pieces;
    int64_t      piece_count, piece_capacity;
    double      *local;    /* [points*dim], see peri__piece                                                              */
    double      *volume;   /* [points], user's units                                                                     */
    uint8_t     *material; /* [points]                                                                                   */
    int64_t      point_count, point_capacity;
    int32_t     *ibond;    /* the caller's families, or NULL                                                             */
    int64_t      ibond_entries;
    int32_t      ibond_width;
    peri__domain  *part;     /* NULL: all of a body                                                                        */
} peri__setup;

#include "past.h" /* what inelastic materials keep of their past */

typedef struct peri__law { /* the elasticity of a material, inner units                                                   */
    int32_t kind;              /* peri_law                                                                               */
    int32_t gather, gauge, pairwise; /* what its points gather; g = |xi|^gauge; 1: no constants, c of the pair. See law.h */
    double  young, lambda, mu; /* lambda: of the plane, lambda' = E nu/(1-nu^2) in plane stress                          */
    double  a, b;              /* A, B of LPS                                                                            */
    double  bulk;              /* lambda + 2 mu/D: W = D^2/2 bulk e^2 under the strain e in all directions               */
    double  stabilization;
} peri__law;

/* What the family of a point makes of its law: planes of body->constant. The half of a bond that point i gives is
   w [(p g + q e) M + Q xi + k eta] with g = |xi|, Oterkus 1. */
typedef enum peri__constant {
    PERI__THETA_FACTOR,  /* theta = theta_factor * sum w g e V                                                           */
    PERI__PRESSURE_FACTOR,   /* p = pressure_factor * theta */
    PERI__SPRING,  /* q                                                                                                  */
    PERI__STABILIZATION,  /* k; planes from here on only where a material is of the correspondence model                 */
    PERI__SHAPE_INVERSE, /* K^-1: xx yy xy, or xx yy zz xy yz xz                                                         */
    PERI__CONSTANTS = PERI__SHAPE_INVERSE + 6
} peri__constant;

typedef struct peri__interface peri__interface; /* this and the next: bond_laws.h                                        */
typedef struct peri__bond_law peri__bond_law;
typedef struct peri__ops peri__ops;
typedef struct peri__contact peri__contact; typedef struct peri__kept peri__kept; /* of a body: search.c; solver.h        */
typedef struct peri__seat peri__seat; /* of a body in a world: world.c                                                       */

typedef struct peri__stencil_bond { /* what bonds along one lattice vector between two materials share, rounded as bond  */
    double xi[3], length, weight, partial_volume, inverse; /* weight: as the model's; partial_volume: beta V_j; inverse: 1/|xi| */
    double c, s0;                                 /* of the pair                                                         */
} peri__stencil_bond;

typedef struct peri__stencil_ends { /* and what their ends are, where laws differ or bonds break by their energy         */
    double gauge, other_gauge; /* g of the own end and of the other; 0 of a pairwise law                                 */
    double spring;             /* c/(2 |xi|) of the pairwise ends                                                         */
    double energy;             /* critical energy density of the bond, times beta V_j                                     */
} peri__stencil_ends;

#define PERI_VECTOR_LIMIT 1024 /* rows of the table; so no family on columns is larger                                    */

typedef struct peri__column { /* the bonds of a group of PERI_GROUP points along one vector                               */
    int32_t  offset;         /* neighbour's id less own                                                                  */
    uint16_t vector, member; /* row of the table; which points of the group have the bond                                */
} peri__column;

typedef struct peri__stencil { /* see stencil.c                                                                          */
    int64_t       groups, reach;  /* reach: largest offset                                                               */
    int64_t       columns, kept;  /* of all groups, each counted for itself; and those in `column`                       */
    int64_t      *begin;          /* [groups+1] columns of the groups before                                             */
    int64_t      *first;          /* [groups] place in `column` of the first of a group; equal groups share their columns */
    peri__column *column;         /* [kept] ascending by offset, then vector, in a group                                 */
    peri__stencil_bond *table;    /* [vectors]                                                                           */
    peri__stencil_ends *ends;     /* [vectors]; NULL where nobody needs them                                             */
    int32_t       vectors, isa;   /* isa: which instruction set the kernels use                                          */
    int32_t       partial;        /* 1: cells may be partial                                                             */
} peri__stencil;

/* What peri_build makes. */
typedef struct peri__model {
    peri__memory     memory;
    volatile int32_t users;

    int32_t f32, b32;          /* single precision: of the state; of the arithmetic of bonds, weights and constants      */
    int32_t dim, width, words; /* words: 32-bit words of bond flags per row                                              */
    int64_t points, stride;    /* stride: length of a component plane                                                    */
    int64_t blocks, bonds;     /* bonds: directed                                                                        */
    double  length, stress, density, time, origin[3]; /* the units                                                       */
    double  horizon;           /* inner units                                                                            */
    double  spacing;           /* mean, inner units                                                                      */
    double  extent;            /* largest coordinate, inner units: times the rounding unit, the error of a position      */
    double  energy;            /* unit of energy, thickness included                                                     */
    double  row_sum;              /* bounds the square of the highest frequency, all bonds whole: the largest row sum of the
                                  stiffness over rho; bond-based, of 2 c w V/|xi|                                         */

    void      *x;        /* real [dim][stride] reference positions                                                       */
    double    *volume;   /* [points]                                                                                     */
    void      *portion;  /* real [stride] 1/V_i: what of its sums a point takes where weights are `mutual`; else NULL    */
    uint8_t   *material; /* [points]                                                                                     */
    int32_t   *count;    /* [points] family sizes                                                                        */
    peri__stencil stencil;   /* families by columns, where they come from a lattice. Rows are then not kept: the next are NULL */
    int32_t   *sorted;   /* the same order while peri_build works, whether it will be kept or not; else NULL             */
    int32_t   *order;    /* [points] id by place, see search.c: the order of the rows in the list, of the passes over it and of the
                            body->records; NULL, places then being ids, where rows were not searched, and on columns */
    int64_t   *start;    /* [points] row i is entries start[i] to start[i] + count[i] of the list                        */
    int64_t    entries;  /* bonds, and PERI_GROUP more that kernels may read                                             */
    int32_t   *ids;      /* [entries] Ibond without its padding: places of the neighbours, ascending; see peri__entry_id */
    void      *weight;   /* bond [entries] w(|xi|) beta V_j; where `mutual` times V_i                                    */
    void      *back;     /* bond [entries] w_ji beta V_j: what j's half of the bond weighs, likewise; `weight` itself where equal */
    void      *bond;     /* bond [entries] |xi|; NULL where x tells: not with the centroid rule, for families larger than the
                            room of peri__row, and where single precision blurs it                                       */
    void      *centroid; /* bond [entries][dim] bond to the centroid of the part; NULL but for that rule                 */
    float     *partial_volume;     /* [entries] beta V_j; NULL for whole cells                                           */
    int32_t    mutual;   /* 1: weights are w beta V_i V_j and sums with them are divided by V_i, see peri__share       */
    int32_t    record_reals;    /* reals per record of body->records: 4, 8, 12 or 16; 0 where list.inl does not serve    */
    int64_t    margin;   /* of a state vector before and after: kernels on columns read beyond the ends, and discard     */

    peri__piece *pieces;  /* [piece_count] where the points came from, vertices NULL                                     */
    int64_t    piece_count;
    int32_t    materials;
    int32_t    law;      /* the number of one of the laws in use; 0: none                                                */
    int32_t    pairwise; /* 1 where all laws in use are: bodies have no constants and responses then                     */
    int32_t    mixed;    /* 1 where laws in use differ                                                                   */
    int32_t    gauge;    /* of laws that do not                                                                          */
    int32_t    gathers;  /* bits of peri__gather: what some law in use asks for                                          */
    int32_t    seen_by;   /* bits of peri__seen: how criteria in use are seen                                            */
    uint32_t   criteria;  /* bits of the criteria of which some pair has a limit                                         */
    peri__law  laws[PERI_MATERIAL_LIMIT];
    double     rho[PERI_MATERIAL_LIMIT];
    int32_t    breakable; /* 1 where some pair has a finite s0                                                           */
    peri__pair *pairs;    /* [materials][materials]                                                                      */
    uint8_t   *law_of;    /* [materials][materials] 1 + which of body->bond_laws bonds follow, 0: none; NULL without such laws, */
    int32_t    bond_states; /* of which bonds keep that many numbers, in body->history                                   */
    int32_t   inelastic;  /* bits of peri__inelastic: what materials in use are                                          */
    peri__past_model past;
    peri__domain *part;          /* NULL: all of a body                                                                    */
    int64_t     part_bytes;
} peri__model;

typedef union peri__reals {
    double f64[PERI_VECTOR_LIMIT];
    float  f32[PERI_VECTOR_LIMIT];
} peri__reals;

typedef struct peri__row { /* the family of a point, see peri__read_row; 31 kB, and not to be copied                      */
    int64_t        count, first;          /* first: its entry in the list; 0 on columns                                   */
    const int32_t *ids;                   /* ascending by place in the order of the model                                 */
    const void    *weight, *bond, *back;  /* bond, as the arrays of the model                                             */
    const float   *partial_volume;                  /* NULL for whole cells                                              */
    const uint16_t *vector;               /* on columns: rows of `table`, where xi is; NULL on the list, where x tells    */
    const int32_t *column;                /* on columns: which column of the group                                        */
    const peri__stencil_bond *table;
    int32_t        ids_room[PERI_VECTOR_LIMIT];
    float          partial_volume_room[PERI_VECTOR_LIMIT];
    uint16_t       vector_room[PERI_VECTOR_LIMIT];
    int32_t        column_room[PERI_VECTOR_LIMIT];
    peri__reals    weight_room, bond_room;
} peri__row;

typedef struct peri__set {
    char    *name;
    int64_t  name_bytes;
    int32_t *points; /* ascending; NULL for the set of all points                                                        */
    int64_t  count, all; /* all: with ghosts, which come last                                                            */
} peri__set;

typedef enum peri__load_kind { PERI__FREE, PERI__DISPLACEMENT, PERI__VELOCITY, PERI__FORCE } peri__load_kind;

/* What a support keeps per dof, in planes of load->force; inner units. */
typedef enum peri__support_plane {
    PERI__SUPPORT_FORCE,    /* force density of bonds, loads and obstacles, before it was replaced                       */
    PERI__SUPPORT_VELOCITY, /* what carries the dof through the present step                                             */
    PERI__SUPPORT_ENERGY,   /* velocity at the last whole step: what the ledger has counted                              */
    PERI__SUPPORT_VALUE,    /* prescribed value at the last whole step                                                   */
    PERI__SUPPORT_REACTION, /* force density that the support gave, mean of the last step                                */
    PERI__SUPPORT_PLANES
} peri__support_plane;

typedef struct peri__load {
    int32_t      kind, set, axes;
    double       constant[3]; /* user's units; for a traction already a force density                                    */
    double       per_value;   /* force density per value: 1, or area/volume of the set for a traction                    */
    double      *spread;      /* [count][dim][dim] force density per component of the value, over per_value; NULL: each its own */
    peri_load_fn fn;
    void        *user;
    double      *value;       /* [count*dim] buffer for fn, user's units; NULL where fn is NULL                          */
    double      *force;       /* supports: [PERI__SUPPORT_PLANES][count*dim]; else NULL                                   */
    int32_t     *all;         /* [count] 0, 1, ... for fn on PERI_ALL, which is stored nowhere else; else NULL           */
    uint8_t     *owned;       /* supports: [count] axes that no later support has taken; else NULL                       */
    int64_t      count;
    int32_t      stepped; /* supports: a step has left its mean reaction                                                 */
    int32_t      rigid;   /* supports: 1: the set moves as a rigid body, by these, user's units; `value` then follows    */
    double       centre[3], turn[3]; /* about which it turns; rotation vector, of the plane in z. `constant`: how far it goes */
    peri_rigid_fn motion;  /* or NULL                                                                                    */
} peri__load;

typedef struct peri__obstacle peri__obstacle; /* obstacles.h                                                              */

typedef struct peri__sums { /* what a block of points adds up; summed over blocks in order                                */
    double  a, b;
    int64_t n, bad; /* bad: first point whose motion is not finite, or -1                                                */
} peri__sums;

/* All that a pass over the points may read or write: vectors of a body, or any others laid out alike. */
typedef struct peri__operands {
    const peri__model *model;
    const void        *u;       /* real [dim][stride] displacement, with margins like all vectors                        */
    void              *v, *f;   /* real [dim][stride] velocity, force density                                            */
    void              *drifted; /* real [dim][stride]: the displacement that `kick` moves                                */
    void              *records;    /* real [places][record_reals], see peri_body                                         */
    const void        *constant; /* bond [constants][stride], from the first point on: the margin lies before            */
    void              *response; /* bond [1 + dim*dim][stride], likewise                                                  */
    uint32_t          *alive, *dying; /* [points][words]                                                                 */
    uint16_t          *masks;   /* [columns] alive by columns                                                            */
    const uint8_t     *point_class;     /* [points] row of pairs; NULL: 0                                                */
    const peri__pair  *pairs;   /* [classes][classes]                                                                    */
    int32_t            classes;
    const uint8_t     *central; /* as body->central                                                                      */
    const void        *eigenstrain, *strength, *stiffness; /* bond [stride] from the first point on; NULL, like the next two: none */
    const float *bond_strength; const double *density; /* by peri__bond_slot; [points]                                   */
    double least_strength; int32_t fields, partly; /* least of a bond; 1: bonds need fields; constants count bonds that are not alive */
    void              *work, *pull; /* real [bonds], [bonds][dim], see peri_body                                         */
    const void        *worked;
    double            *node;    /* [points]                                                                              */
    double             node_most; /* the largest, of points whose bonds may break by it                                  */
    const peri__bond_law *bond_laws; /* NULL: bonds are linear                                                           */
    double            *history; /* [entries][bond_states] of laws of bonds                                               */
    int32_t            keeping, secant; /* 1: that is brought up to date; 2: and bonds break by their laws. 1: the tangent is of springs
                                           as soft as bonds are by now: never negative                                   */
    double            *stress;  /* [points][dim*dim], see peri_body; NULL, like the next, where nobody asks              */
    const double      *nearness; /* [points] the most that a bond of the point can have of a criterion of stress, over its limit */
    double             nearness_most;
    const double      *aligned; /* [points][PERI_ALIGNED], see peri_body                                                 */
    double            *least;   /* [points] least stretch of the live bonds                                              */
    double            *overtime;   /* [bonds] how long a bond has been over its limit                                       */
    int32_t            linear;  /* the geometry                                                                          */
    int32_t            working; /* the work on bonds is counted                                                          */
    int32_t            breaking; /* bonds may break                                                                      */
    double             step;    /* how long the drift took                                                               */
    void              *closing; /* real [dim][stride]: impulse per volume of the bonds that broke; NULL: it is let go     */
    double             keep, kick, drift; /* v = keep*v + kick*f/rho, u += drift*v                                       */
    double             loss_old, loss_new; /* damping work: (loss_old v_old + loss_new v_new).(v_old + v_new)/2 rho V     */
    const uint8_t     *ghost;   /* [points] not 0: a ghost, in no sum; NULL: there are none                              */
    double            *out;     /* energy density per point, or NULL                                                     */
    const void        *p;       /* real [dim][stride]: a change of the displacements                                     */
    void              *q;       /* real [dim][stride]: the change that the tangent makes of the force density            */
    void              *change;  /* as response: of p and Q                                                               */
    peri__past_pass    past;
} peri__operands;

typedef struct peri__tangent { /* a change of the displacements, and what the tangent makes of it                        */
    peri_body  *body;
    const void *p;      /* real [dim][stride] with margins: the change                                                   */
    void       *q;      /* real [dim][stride] with margins: the change of the force density                              */
    void       *change; /* as body->response: that of p and Q; NULL without constants                                    */
    const void *u;      /* real [dim][stride] with margins: the displacement there; NULL, like the next: those of the body */
    void       *response; int32_t secant; /* as body->response: of u; see peri__operands                                  */
    double     *moduli;   /* of raw points, at u; NULL where there are none                                              */
    double      step;     /* time since the history that bodies keep                                                     */
} peri__tangent;

typedef struct peri__krylov { /* vectors of conjugate gradients, real [dim][stride], forces times volumes                 */
    const peri__model *model;
    void          *d, *r, *p, *q, *z; /* solution, residual, direction, K p, preconditioned residual                     */
    const void    *blocks;            /* real [packed][stride] inverses of the diagonal blocks, 0 where constrained; or NULL */
    const uint8_t *constrained;              /* [points] axes that do not move                                           */
    double         alpha, beta;
} peri__krylov;

#define PERI_RIGID_MODES 6 /* rigid motions: translations, then turns over the radius of the part                        */

typedef struct peri__derived { /* what peri_view_field computed of a field                                               */
    double *data; /* [points*components]; NULL until first asked for                                                     */
    int32_t components;
} peri__derived;

typedef struct peri__fragment { /* connected points: fragments.c                                                         */
    int32_t first, points, parent; /* as of peri_fragment                                                                */
} peri__fragment;

#include "progress.h" /* how far a body has come */

struct peri__ops { /* kernels of one precision, dimension and instruction set; all are peri__block_fn, on a peri__operands unless said */
    void (*fill_records)(void *, int64_t, int64_t, peri__sums *);    /* all of a record; before force or gather on the list */
    void (*fill_responses)(void *, int64_t, int64_t, peri__sums *); /* p; before force                                   */
    void (*gather)(void *, int64_t, int64_t, peri__sums *);  /* what each point makes of its family, then                */
    void (*gather_rows)(void *, int64_t, int64_t, peri__sums *);
    void (*gather_shapes)(void *, int64_t, int64_t, peri__sums *); /* the sum of w eta xi V, to ->stress                 */
    void (*gather_least)(void *, int64_t, int64_t, peri__sums *);  /* to ->least                                         */
    void (*force)(void *, int64_t, int64_t, peri__sums *);   /* the force of bonds, each end giving its half             */
    void (*add_point_forces)(const peri__operands *, const int32_t *points, int64_t count, int sign, double time);
    peri__parting (*part)(const peri__operands *, int64_t i, const peri__row *row, int64_t k);
    void (*bond_force)(const peri__operands *, int64_t i, const peri__row *row, int64_t k, double *force);
    void (*energy)(void *, int64_t, int64_t, peri__sums *);
    void (*kick)(void *, int64_t, int64_t, peri__sums *);
    void (*kinetic)(void *, int64_t, int64_t, peri__sums *);
    void (*tangent_gather)(void *, int64_t, int64_t, peri__sums *);
    void (*tangent_force)(void *, int64_t, int64_t, peri__sums *);
    void (*law_force)(void *, int64_t, int64_t, peri__sums *), (*law_energy)(void *, int64_t, int64_t, peri__sums *),
        (*law_tangent)(void *, int64_t, int64_t, peri__sums *); /* of bodies with laws of bonds                          */
    void (*krylov_step)(void *, int64_t, int64_t, peri__sums *); /* these on a peri__krylov                              */
    void (*krylov_turn)(void *, int64_t, int64_t, peri__sums *);
    void (*krylov_force)(void *, int64_t, int64_t, peri__sums *);
    void (*krylov_blocks)(void *, int64_t, int64_t, peri__sums *);
    void (*krylov_norm)(void *, int64_t, int64_t, peri__sums *);
    void (*krylov_dot)(void *, int64_t, int64_t, peri__sums *);
};

struct peri_body {
    peri_body_desc desc;
    peri__memory   memory, scratch; /* for what the body keeps; for what a call takes for itself and gives back          */
    peri__taken   *taken;    /* blocks of scratch: of calls under way, or that a callback was left in by a jump          */
    peri_error     error;
    int32_t        number;  /* of the body in its ids, 1..127                                                            */
    int32_t        dim, f32, b32; /* single precision: of the state; of the arithmetic of bonds, weights and constants   */

    peri_material_desc    materials[PERI_MATERIAL_LIMIT];
    int32_t          material_count;
    peri__interface *interfaces;
    int64_t          interface_count, interface_capacity;
    peri__bond_law  *bond_laws; int64_t bond_law_count, bond_law_capacity;
    peri__setup      setup;

    peri__model      *model; /* NULL before peri_build                                                                   */
    peri__model      *building; /* what peri_build is at work on; else NULL                                              */
    const peri__ops  *ops;
    void     *u, *v, *f;     /* real [dim][stride]; f: force density                                                     */
    void     *records;          /* real [places][record_reals] for list.inl: x, u, then p and q, or Q and k of a gradient, or material;
                                NULL where record_reals is 0. Scratch: filled before each pass */
    uint32_t *alive;         /* [points][words] bond carries force; NULL where nothing can break and nothing is cut      */
    uint32_t *uncut;         /* [points][words] bond was not cut before the first step; NULL where none was              */
    uint32_t *before;        /* [points][words] alive before the step, for break events; NULL without a callback         */
    uint16_t *masks;         /* [columns] as alive, by columns; NULL where alive or the columns are                      */
    uint8_t  *no_fail;       /* [points]; NULL where none                                                                */
    uint8_t  *point_class;           /* [points] class: row of `pairs`; NULL where there is one class                    */
    peri__pair *pairs;       /* [classes][classes]                                                                       */
    int32_t   classes;
    peri__sums *sums;        /* [blocks]                                                                                 */
    void     *constant;      /* bond [constants][stride], see peri__constant, with a margin before and after; NULL, like the next,
                                without state-based laws                                                                 */
    void     *response;      /* bond [1 + dim*dim][stride]: p, and Q where there are tensors; with margins               */
    double   *row_sum, *gather_row_sum; /* [points] row sum of the stiffness over rho; kappa_i R_i, see stiffness.c */
    double    largest_row_sum; /* largest row_sum                                                                        */
    double    sharp;         /* the square of the highest frequency, estimated: frequency.c; HUGE_VAL where it is not     */
    int32_t   softens;       /* 1: found to get no stiffer whatever bonds it loses, so that `sharp` outlasts that         */
    uint8_t  *central;       /* [groups], of parts [points] 1: points there or beside it act by central bonds, not a gradient; NULL without
                                gradients                                                                                */
    uint32_t *dying;         /* [points][words] bonds whose criterion was met in the last pass; NULL where none can break */
    int32_t  *near_dying;    /* [points] the points whose force that changes                                             */
    uint8_t  *marked;        /* [points] scratch: 1 loses a bond, 2 is next to one that does                             */
    void     *closing;       /* real [dim][stride] impulse per volume that bonds still give in the step that breaks them; 0 between
                                steps; NULL where none break, or not so                                                  */
    void     *work;          /* real work done on bonds, by peri__bond_slot; NULL, like the next, without that criterion */
    void     *pull;          /* real force density of bonds when last worked out: on the list [entries][dim], on columns [columns][dim]
                                [PERI_GROUP]                                                                             */
    void     *worked;        /* real [dim][stride] displacement then, with a margin before and after                     */
    void     *change_u;      /* displacements that are not those of the body, or a change of them: of peri_evaluate and products with the
                                stiffness, which take these when first asked for;                                        */
    void     *change_f;      /* what that makes of the force, both laid out as u with its margins,                       */
    void     *change_response; /* and of the response                                                                     */
    uint32_t *fragment_alive; /* [points][words] alive when fragments were made; NULL, like the next, until they are asked for */
    int32_t  *fragment_of;   /* [points] fragment                                                                        */
    peri__fragment *fragments; /* [points], of which there are now.fragments                                             */
    double   *history;       /* [entries][bond_states] what laws of bonds keep, both ends the same; NULL without          */
    double   *node;          /* [points] 2 W/volume of the family; NULL without that criterion                           */
    double   *stress;        /* [points][dim*dim] of points, for criteria: xx yy xy zz, or xx yy zz xy yz xz and 3 of no use; first
                                the sum of w eta xi V that it is made of. NULL, like the next four, without such a criterion */
    double   *nearness;      /* [points] see peri__operands                                                              */
    double   *aligned;       /* [points][PERI_ALIGNED] how much more the worst plane has than that of the best bond of the family: of
                                principal stress, of Mohr-Coulomb                                                        */
    double   *inverse;       /* [points][packed + 1] K^-1 of the live family, and 1 where that spans the space           */
    uint32_t *inverse_alive; /* [points][words] alive when that was made; none at first                                  */
    double   *least;         /* [points] least stretch of the live bonds; NULL without a criterion that asks             */
    double   *overtime;      /* how long bonds have been over their limit, by peri__bond_slot; NULL likewise             */
    int64_t   side_count;    /* pairs i < j of adjacent points, see sides.c; 0 unless they are recorded                 */
    int64_t  *side_start;    /* [points+1] pairs of the points before; NULL, like the next, unless recorded              */
    int32_t  *side;          /* [side_count] bond of the row of i                                                        */
    double   *side_time;     /* [side_count] when it broke; HUGE_VAL: it is whole, NaN: it broke before the record       */
    double   *push;          /* [dim][stride] force density of the obstacles; NULL where none                            */
    void     *eigenstrain, *strength, *stiffness; /* bond [stride] with margins: fields of material; NULL, like the next two, where none */
    float *bond_strength; double *density; /* by peri__bond_slot, a factor; [points] rho                                 */
    double    mean_gradient[9]; /* [dim][dim] of the displacement over a periodic cell: what images have over their owners, by distance */
    double    least_strength, row_sum_factor; /* of these, 1 without: a bound of all bonds'; what model->row_sum is times */
    peri__past past; peri__kept *kept; peri__taken *keeping; /* what peri_solve keeps; the list of its blocks            */
    peri__contact *contact;  /* NULL where none is declared                                                              */
    peri__seat *seat;        /* in a world; or NULL                                                                      */
    peri__derived derived[peri__count_field]; /* by field                                                                */

    peri__set      *sets;
    int64_t         set_count, set_capacity;
    peri__load     *loads;
    int64_t         load_count, load_capacity;
    peri__obstacle *obstacles;
    int64_t         obstacle_count, obstacle_capacity;
    peri_break_fn   on_break;
    void           *break_user;

    peri__progress now;
    int32_t        told;    /* of a part: 1: the others know that this call has failed                                   */
    int32_t        running; /* peri__running                                                                             */
    int32_t        stop;    /* 1: a load or an obstacle asked the run to stop                                            */
    int64_t        law_bad;        /* the first point at whose bonds a law has failed since that was last asked, or -1    */
    int32_t        break_said;     /* what on_break returned in this run, if not 0: the failure, or the first wish to stop */
    int32_t        influence_said; /* what influence_fn returned as it failed in this call, else 0                       */
};

#endif
