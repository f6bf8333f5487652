/* peri.h - peridynamics in one include: deformation and fracture of solids by nonlocal bonds.
   SPDX-License-Identifier: MIT

   A body is a cloud of points, each with a volume and a family: the points within its horizon, to
   which bonds join it. Bonds carry the force; one that is stretched too far breaks for good.

   BUILD, any one of (C99; the declarations are C++11, too; link with -lm; -fopenmp for all cores)
     cc -O2 -c peri_impl.c          once, up to a minute of gcc; every other file includes peri.h
     #define PERI_IMPLEMENTATION    in one C file, then #include "peri.h"
     #define PERI_STATIC            with PERI_IMPLEMENTATION, in as many files as you like
   Switches leave out what a scene does not need: docs/manual.md, Build.

   STEP BY STEP
     1 peri_body_desc d;  peri_body_desc_init(&d);  d.space = PERI_SPACE_PLANE_STRESS;
       d.horizon = 1e-3;  peri_body_create(&d, &body, &error);
     2 peri_material_desc m;  peri_material_desc_init(&m, PERI_LAW_BOND_BASED);  m.young = 72e9;
       m.density = 2440;  glass = peri_add_material(body, &m);
     3 peri_add_box(body, glass, lo, hi, spacing);  as many shapes as you like
     4 peri_build(body);  families, weights, constants: the points are now fixed
     5 peri_cut_segment, peri_select_box, peri_apply_traction, peri_prescribe_velocity, ...
     6 peri_advance_desc a;  peri_advance_desc_init(&a);  a.duration = 43e-6;
       peri_advance(body, &a);  motion; or peri_solve: the equilibrium
     7 peri_get_field(body, PERI_FIELD_DAMAGE, out, n);  peri_export_vtu(body, "out.vtu");
     8 peri_body_destroy(body);

   CONVENTIONS: docs/manual.md
     Units    any consistent set; [L] length, [M] mass, [T] time: [M L^-1 T^-2] is a stress.
     Arrays   of double, vectors interleaved: x0 y0 x1 y1 ... "[points*dim]"; one place or vector
              has dim entries. They are copied; you own what you pass in.
     Planes   a point's "volume" is its area [L^2]; forces and energies include the thickness.
     Results  >= 0 is success: PERI_OK, an id or a count. < 0 is a peri_status; peri_get_error then
              tells field, place and value. A call that fails has changed nothing, unless said.
     Ids      carry their kind and the number of their body, and are never 0: a load is not taken
              for a set, nor an id of another body. Points are no ids: 0, 1, ... as added.
     Enums    have disjoint values: one in the wrong field is refused. Flags are 0 or 1.
     Callback returns 0: go on, or no; > 0: stop, or yes; < 0: it failed, which ends the call with
              PERI_ERROR_CALLBACK. It may read the body that called it.
     Threads  one at a time per body; different bodies, clones included, at once. Results have the
              same bits for any number. Callbacks come on the thread of the call, but for laws of
              bonds and stresses.
   The library never prints, exits, asserts, or keeps global state. Equations are cited from
   [T] the thesis, [L] the lecture, [P] PDMATLAB2D, [C] the convergence study: docs/theory.md. */

#ifndef PERI_H
#define PERI_H

#include <stddef.h>
#include <stdint.h>

#define PERI_VERSION        "0.2.0"
#define PERI_VERSION_NUMBER 2000 /* major * 1000000 + minor * 1000 + patch */

#if defined(__GNUC__) || defined(__clang__)
#define PERI_UNUSED_ __attribute__((unused))
#else
#define PERI_UNUSED_
#endif
#ifndef PERI_API
#ifdef PERI_STATIC
#define PERI_API PERI_UNUSED_ static
#else
#define PERI_API extern
#endif
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* PERI_VERSION_NUMBER of the implementation. */
PERI_API int32_t peri_version(void);

/* ---- status ----------------------------------------------------------------- */

typedef enum peri_status { /* peri_status_text says the same */
    PERI_BRITTLE = 2,             /* success: as brittle bonds, the horizon being too large */
    PERI_STOPPED = 1,             /* a callback asked to stop; the body is at a whole step */
    PERI_OK = 0,                  /* success */
    PERI_ERROR_ARGUMENT = -1,     /* missing, NULL or given twice, or a count that is wrong */
    PERI_ERROR_CHOICE = -2,       /* not a value of this enum, or a flag that is not 0 or 1 */
    PERI_ERROR_DESCRIPTOR = -3,   /* not filled by its init function, or of another version */
    PERI_ERROR_RANGE = -4,        /* a number is not finite or outside the range of its field */
    PERI_ERROR_ORDER = -5,        /* too early, too late, or from a callback that may not */
    PERI_ERROR_MEMORY = -6,       /* the allocator returned NULL */
    PERI_ERROR_TOO_LARGE = -7,    /* more than the library or memory takes; see the value */
    PERI_ERROR_CAPACITY = -8,     /* the buffer has the wrong size; it needs the value */
    PERI_ERROR_ID_NONE = -9,      /* no id: zero, a plain number, or what a failed call returned */
    PERI_ERROR_ID_KIND = -10,     /* an id of another kind: of a load, say, not of a set */
    PERI_ERROR_ID_BODY = -11,     /* an id of another body */
    PERI_ERROR_ID_GONE = -12,     /* nothing has this id: it was removed, or never given */
    PERI_ERROR_INDEX = -13,       /* no point has this number */
    PERI_ERROR_NAME = -14,        /* a name that is taken, or that no set has */
    PERI_ERROR_EMPTY = -15,       /* the body, the shape or the selection holds no point */
    PERI_ERROR_MATERIAL = -16,    /* the material contradicts itself, or is missing */
    PERI_ERROR_POISSON = -17,     /* bond-based: Poisson's ratio is fixed; it is the value */
    PERI_ERROR_LAW = -18,         /* this law has no such thing, or cannot take this */
    PERI_ERROR_CRITERION = -19,   /* the criterion cannot act on this law, or lacks its G0 */
    PERI_ERROR_INFLUENCE = -20,   /* the influence function or its moments are not finite */
    PERI_ERROR_POINT = -21,       /* a place not finite, no volume, or a cell that crosses itself */
    PERI_ERROR_COINCIDENT = -22,  /* two points are at the same place */
    PERI_ERROR_HORIZON = -23,     /* the horizon is smaller than the spacing of the points */
    PERI_ERROR_FAMILY = -24,      /* a point has no neighbour, or none with a weight */
    PERI_ERROR_IBOND = -25,       /* given families: wrong number, not mutual, not of the horizon */
    PERI_ERROR_CRACK = -26,       /* the crack has no extent, or is not for this space */
    PERI_ERROR_PAIR = -27,        /* the two points share no bond */
    PERI_ERROR_FIELD = -28,       /* this field cannot be used in this way: it is not stored */
    PERI_ERROR_AREA = -29,        /* the points feel another area than that of the face */
    PERI_ERROR_STEP = -30,        /* the time step exceeds the stable step, which is the value */
    PERI_ERROR_UNSTABLE = -31,    /* a point passed 1e9 speeds of sound: step, load or start */
    PERI_ERROR_CALLBACK = -32,    /* a callback failed, or wrote what is not finite */
    PERI_ERROR_LOOSE = -33,       /* no support holds this part against some motion */
    PERI_ERROR_INDEFINITE = -34,  /* the tangent is not positive: buckling or softening */
    PERI_ERROR_CONVERGENCE = -35, /* no equilibrium within the iterations; value: residual */
    PERI_ERROR_WRITE = -36,       /* the file or the write callback failed */
    PERI_ERROR_LEFT_OUT = -37,    /* left out of this build, by the switch that the field names */
    PERI_ERROR_STATE = -38,       /* no saved state of such a body, or damaged; value: the byte */
    PERI_ERROR_PART = -39         /* not of a part of a body; or its ghosts are not as owned */
} peri_status;

typedef struct peri_error {
    int32_t code;      /* peri_status */
    int32_t reserved;  /* 0 */
    int64_t index;     /* first offending point, entry or id; else -1 */
    double value;      /* the offending value, or the limit that was passed; else 0 */
    const char *field; /* constant text: the name in this header of what is at fault, or "" */
    const char *text;  /* constant text: peri_status_text(code) */
} peri_error;

/* Never NULL. */
PERI_API const char *peri_status_text(int32_t status);

/* "text: field index i, value v", cut off at capacity bytes, zero included. Returns the length of
   the whole text. buffer may be NULL where capacity is 0. */
PERI_API int64_t peri_format_error(const peri_error *error, char *buffer, int64_t capacity);

/* ---- hooks and callbacks (user is what was given beside the function) ------- */

/* Memory, both or neither. release gets the size that allocate was asked for. Neither may call the
   library. */
typedef void *(*peri_allocate_fn)(void *user, uint64_t bytes);
typedef void (*peri_release_fn)(void *user, void *pointer, uint64_t bytes);

/* A job system: call task(context, k) once for each k in [0, count), in any order on any threads,
   and return when all are done. Default: OpenMP where compiled in, else serial. */
typedef void (*peri_task_fn)(void *context, int64_t k);
typedef void (*peri_parallel_for_fn)(void *user, int64_t count, peri_task_fn task, void *context);

/* Remarks that are no errors. level: 0 information, 1 warning. */
typedef void (*peri_log_fn)(void *user, int32_t level, const char *text);

/* Influence function: *w = w(q) [-], q = |xi|/horizon > 0, with partial volumes also a little
   beyond 1; 0, or 1e-100 < |w| < 1e100. */
typedef int32_t (*peri_influence_fn)(void *user, double q, double *w);

/* > 0 takes the point or site at x[dim]; index numbers the candidates. */
typedef int32_t (*peri_point_fn)(void *user, int64_t index, const double *x);

/* > 0 cuts the bond between points i < j at xi[dim] and xj[dim]. */
typedef int32_t (*peri_pair_fn)(void *user, int32_t i, int32_t j, const double *xi,
    const double *xj);

/* Values of a load or support at `time` on points[count]: value[count*dim] holds the constant
   value; overwrite what varies. Once per step, for its end; in peri_solve time is the load factor.
   > 0 stops the run after the step; peri_solve as peri_iteration_fn does. */
typedef int32_t (*peri_load_fn)(void *user, double time, int64_t count, const int32_t *points,
    double *value);

/* Writes where the frame of an obstacle is at `time`: place[dim] [L], and its turn, in 2D an angle
   turn[1], in 3D a quaternion turn[4] (w x y z). They hold those of the start. > 0: likewise. */
typedef int32_t (*peri_motion_fn)(void *user, double time, double *place, double *turn);

/* A shape: *distance [L] of x[dim] from its surface, < 0 inside, and there the outward normal[dim],
   of any length; in the frame of the obstacle */
typedef int32_t (*peri_distance_fn)(void *user, const double *x, double *distance, double *normal);

/* Points whose stress is asked for; matrices by rows, out: to be written. */
typedef struct peri_stress_block {
    int64_t count;
    const int32_t *points;  /* [count] */
    const double *gradient; /* [count][dim][dim] H = F - 1 */
    double time_step;       /* [T] since the history was committed */
    double *history;        /* [count][history] as committed; out: as it becomes */
    double *stress;         /* [count][dim][dim] out: P, first Piola-Kirchhoff; linear: Cauchy */
    double *tangent;        /* [count][dim^2][dim^2] out: dP/dH, symmetric; NULL: not wanted */
    double *energy;         /* [count] out: stored [M L^-1 T^-2]. 0 */
    double *dissipation;    /* [count] out: lost in time_step, likewise. 0 */
} peri_stress_block;

/* Comes on the threads of the body, for several blocks at once; no jump may leave it. */
typedef int32_t (*peri_stress_fn)(void *user, const peri_stress_block *block);

/* Writes the motion of a rigid support at `time`. > 0: likewise. */
typedef int32_t (*peri_rigid_fn)(void *user, double time, double *motion);


/* A bond i < j broke by its criterion at `time` [T] and this stretch [-]. Called after the step, in
   ascending (i, j). > 0 ends the run with PERI_STOPPED. */
typedef int32_t (*peri_break_fn)(void *user, int32_t i, int32_t j, double time, double stretch);

/* Bonds of one point to others[]: arrays of `count`. All that is written is 0 at first. */
typedef struct peri_bond_row {
    int32_t point;
    int32_t count;
    const int32_t *others;
    const double *length;  /* |xi| [L] */
    const double *stretch; /* s = e/|xi| [-]; 0 of broken bonds */
    double *state;         /* [count*states] in: as last kept; out: as it is with this stretch */
    double *force;         /* out [-] f/c: the stretch at which a linear bond pulls as hard */
    double *tangent;       /* out, its derivative; this and what follows NULL where not asked for */
    double *energy;        /* out: stored, of which `force` is the derivative at constant state */
    double *lost;          /* out: lost since `state` was kept */
    int32_t *broken;       /* out: 1 breaks the bond for good */
} peri_bond_row;

/* A law, or a criterion, of bonds. A function of what it gets alone: it comes for each bond from
   both ends, as often as wanted, on any thread, and may not call the library. */
typedef int32_t (*peri_bond_law_fn)(void *user, const peri_bond_row *row);

/* Takes the next `count` bytes of a file; all but 0 is a failure: PERI_ERROR_WRITE. */
typedef int32_t (*peri_write_fn)(void *user, const void *bytes, int64_t count);

/* Writes the next `count` bytes to `bytes`; all but 0 is a failure, as where fewer are left. */
typedef int32_t (*peri_read_fn)(void *user, void *bytes, int64_t count);

/* ---- ids -------------------------------------------------------------------- */

enum { PERI_ALL = 0x10000000 };            /* the set of all points, of any body */
#define PERI_ID_INDEX(id) ((id) & 0xFFFFF) /* 1, 2, ... in the order in which they were given */

typedef enum peri_kind {
    PERI_KIND_MATERIAL = 2201,
    PERI_KIND_SET = 2202,
    PERI_KIND_LOAD = 2203,     /* supports included */
    PERI_KIND_OBSTACLE = 2204
} peri_kind;

/* ---- body ------------------------------------------------------------------- */

typedef struct peri_body peri_body; /* opaque */

typedef enum peri_space {
    PERI_SPACE_PLANE_STRESS = 101, /* 2D, thin plate; bond-based: Poisson's ratio 1/3 */
    PERI_SPACE_PLANE_STRAIN = 102, /* 2D, long prism; bond-based: 1/4 */
    PERI_SPACE_SOLID = 103         /* 3D; bond-based: 1/4 */
} peri_space;

typedef enum peri_precision {
    PERI_PRECISION_DOUBLE = 201,
    PERI_PRECISION_MIXED = 202,  /* state in double, bonds in single: strain to 7 digits */
    PERI_PRECISION_SINGLE = 203  /* faster, 0.65 of the memory; strains below 1e-6 lose digits */
} peri_precision;

typedef enum peri_geometry {
    PERI_GEOMETRY_NONLINEAR = 301, /* e = |xi+eta| - |xi|, force along xi+eta ([T] 1.23) */
    PERI_GEOMETRY_LINEAR = 302     /* e = xi.eta/|xi|, force along xi: small motion ([T] 1.37) */
} peri_geometry;

/* w(q), q = |xi|/horizon; "beyond": of partial cells whose centre lies outside. Factors cancel. */
typedef enum peri_influence {
    PERI_INFLUENCE_CONSTANT = 401,     /* 1, also beyond [P] w0, [C] Const */
    PERI_INFLUENCE_CUTOFF = 402,       /* 1, beyond 0 [P] w0.5 */
    PERI_INFLUENCE_LINEAR = 403,       /* 1 - q, beyond 0 [P] w1, [C] Linear */
    PERI_INFLUENCE_CUBIC = 404,        /* 1 - 3q^2 + 2q^3, beyond 0 [P] w3 */
    PERI_INFLUENCE_QUINTIC = 405,      /* 1 - 10q^3 + 15q^4 - 6q^5, beyond 0 [P] w5 */
    PERI_INFLUENCE_SEPTIC = 406,       /* 1 - 35q^4 + 84q^5 - 70q^6 + 20q^7, beyond 0 [P] w7 */
    PERI_INFLUENCE_POWER_2 = 407,      /* (1 - q)^2, beyond 0 [C] Quadr */
    PERI_INFLUENCE_POWER_3 = 408,      /* (1 - q)^3, beyond 0 [C] Cubic */
    PERI_INFLUENCE_GAUSSIAN = 409,     /* exp(-q^2), also beyond [T] */
    PERI_INFLUENCE_PROPORTIONAL = 410, /* q, also beyond [T] */
    PERI_INFLUENCE_INVERSE = 411,      /* 1/q, also beyond [T], [C] Inv */
    PERI_INFLUENCE_INVERSE_4 = 412,    /* q^-4, also beyond; no finite moments [T] */
    PERI_INFLUENCE_POLE_EDGE = 413,    /* 1/(1 + spacing/(2 horizon) - q) [T] */
    PERI_INFLUENCE_POLE_HALF = 414,    /* 1/|2q - 1|, also beyond; no finite moments [T] */
    PERI_INFLUENCE_POLE_QUARTER = 415, /* exp(1/(q - 1/4)), also beyond; no moments; [T] in mm */
    PERI_INFLUENCE_USER = 416          /* influence_fn */
} peri_influence;

typedef enum peri_quadrature { /* how much of a neighbour's cell counts, and from where */
    PERI_QUADRATURE_FULL = 501,             /* cells whose centre is within, whole [P] FA */
    PERI_QUADRATURE_RAMP = 502,             /* from 1 to 0 over horizon -+ spacing/2 [T] Fig. 3.7 */
    PERI_QUADRATURE_PARTIAL = 503,          /* the exact part within the horizon [P] PA-AC */
    PERI_QUADRATURE_PARTIAL_CENTROID = 504, /* 2D, to its centroid [P] IPA-AC: for comparison */
    PERI_QUADRATURE_PARTIAL_MOMENT = 505    /* 2D, the centroid's energy, objective */
} peri_quadrature;

typedef enum peri_break_timing {
    PERI_BREAK_WITHIN_STEP = 601, /* a bond acts until it meets its criterion; error O(dt^2) */
    PERI_BREAK_AFTER_DRIFT = 602  /* until the middle of the step [P]; ledger error O(dt) */
} peri_break_timing;

/* For families cut off at surfaces, and coarse sums; measured in docs/accuracy.md. */
typedef enum peri_correction {
    PERI_CORRECTION_NONE = 701,   /* the constants of an infinite body */
    PERI_CORRECTION_VOLUME = 702, /* bond-based, by volumes (Le, Bobaru 2018): for comparison */
    PERI_CORRECTION_ENERGY = 703, /* bond-based: right energy of isotropic strain and mean shear */
    PERI_CORRECTION_MOMENT = 704, /* weights, as little as makes uniform strain exact on lattices */
    PERI_CORRECTION_EQUILIBRIUM = 705 /* and in equilibrium inside on any cloud; not of parts */
} peri_correction;

typedef enum peri_moments { /* which bonds calibrate LPS and Oterkus */
    PERI_MOMENTS_LIVE = 2501, /* those left: they take over what others carried */
    PERI_MOMENTS_WHOLE = 2502 /* all, broken and cut ones included */
} peri_moments;

typedef enum peri_kernel { /* results agree to the rounding of sums */
    PERI_KERNEL_BEST = 801,      /* columns on lattices where that serves, else a list */
    PERI_KERNEL_REFERENCE = 802, /* every quantity by its formula, bond by bond: slow */
    PERI_KERNEL_LIST = 803       /* the list of families, as clouds have it */
} peri_kernel;

/* The most that kernels may use on x86-64; the same bits from each. */
typedef enum peri_instructions {
    PERI_INSTRUCTIONS_BEST = 901,     /* of the machine */
    PERI_INSTRUCTIONS_BASELINE = 902, /* SSE2 */
    PERI_INSTRUCTIONS_AVX2 = 903,
    PERI_INSTRUCTIONS_AVX512 = 904    /* F, VL, DQ and BW */
} peri_instructions;

typedef struct peri_body_desc {
    uint64_t cookie;                   /* set by init */
    int32_t space;                     /* peri_space. Required */
    int32_t precision;                 /* Default PERI_PRECISION_DOUBLE */
    int32_t geometry;                  /* Default PERI_GEOMETRY_NONLINEAR */
    int32_t influence;                 /* Default PERI_INFLUENCE_CONSTANT */
    int32_t quadrature;                /* Default PERI_QUADRATURE_FULL */
    int32_t correction;                /* Default PERI_CORRECTION_NONE */
    int32_t break_timing;              /* Default PERI_BREAK_WITHIN_STEP */
    int32_t moments;                   /* Default PERI_MOMENTS_LIVE */
    int32_t kernel;                    /* Default PERI_KERNEL_BEST */
    int32_t instructions;              /* Default PERI_INSTRUCTIONS_BEST */
    int32_t threads;                   /* 0 (default): as OpenMP says; 1: serial; n: n threads */
    int32_t ledger;                    /* 1 (default): account for work while running; 0: not */
    int32_t number;                    /* 1..127, in its ids; 0 (default): from its address */
    int32_t reserved;                  /* 0 */
    double horizon;                    /* [L] > 0. Required. 3 to 4 spacings */
    double thickness;                  /* [L] > 0, of planes. Default 1 */
    peri_influence_fn influence_fn;    /* for PERI_INFLUENCE_USER */
    void *influence_user;
    peri_allocate_fn allocate;         /* Default NULL: malloc */
    peri_release_fn release;           /* Default NULL: free */
    void *memory_user;
    peri_parallel_for_fn parallel_for; /* Default NULL: OpenMP, or serial */
    void *parallel_user;
    peri_log_fn log;                   /* Default NULL: silent */
    void *log_user;
} peri_body_desc;

/* Fills in the defaults. NULL is ignored; alike all _desc_init. */
PERI_API void peri_body_desc_init(peri_body_desc *desc);

/* *body is NULL on failure. error may be NULL. */
PERI_API int32_t peri_body_create(const peri_body_desc *desc, peri_body **body, peri_error *error);

/* An independent copy of a built body, state, loads and number included: ids hold in both. Points,
   families and weights are shared. error may be NULL. */
PERI_API int32_t peri_body_clone(const peri_body *body, peri_body **copy, peri_error *error);

/* Frees the body. Ignored of NULL, and from a callback of the body. Clones live on. */
PERI_API void peri_body_destroy(peri_body *body);

/* After a callback was left by longjmp or an exception: ends the call that it came from, and frees
   its memory. The body may then be read, reset or destroyed; it runs again after peri_reset. Never
   from within a callback. PERI_ERROR_ORDER where none was left. Memory hooks, job systems and what
   a measuring peri_plan calls may not be left so. */
PERI_API int32_t peri_unlock(peri_body *body);

/* The record of the body's last failed call; code PERI_OK where none failed. */
PERI_API int32_t peri_get_error(const peri_body *body, peri_error *error);

/* The id of the index-th (1, 2, ...) thing of a peri_kind, removed ones counted; or an error. */
PERI_API int32_t peri_id(const peri_body *body, int32_t kind, int64_t index);

/* ---- materials -------------------------------------------------------------- */

/* Force density on i: sum_j (t_i + t_j) V_j, each end giving its half by its own law, each the
   derivative of an energy. Constants and limits: docs/theory.md. */
typedef enum peri_law {
    PERI_LAW_BOND_BASED = 1001,    /* t = 1/2 c w s, s = e/|xi|: PMB, generalised [P] A, [T] 1.23 */
    PERI_LAW_LPS = 1002,           /* t = (w/m)(A theta |xi| + B e) [T] 1.54, 1.67, [C] 2-7 */
    PERI_LAW_OTERKUS = 1003,       /* t = 2 w (a d theta + b e), on each family [C] 8-17 */
    PERI_LAW_CORRESPONDENCE = 1004 /* T = w P K^-1 xi, stabilised [C] 18-21 */
} peri_law;

#define PERI_RELAXATIONS 4  /* most parts that relax */
#define PERI_HISTORY     64 /* most numbers per point */

/* When a stretched bond breaks; between two materials: when either's criterion is met. */
typedef enum peri_criterion {
    PERI_CRITERION_STRETCH = 1101,     /* s > s0 [T] 1.40, 1.41 */
    PERI_CRITERION_BOND_ENERGY = 1102, /* state-based: work on the bond > w0 [T] 1.100 */
    PERI_CRITERION_NODE_ENERGY = 1103, /* state-based: mean energy of both ends > w0 [T] 1.102 */
    PERI_CRITERION_PRINCIPAL_STRESS = 1104, /* tension along the bond > strength */
    PERI_CRITERION_VON_MISES = 1105,        /* von Mises's > strength; shortened bonds, too */
    PERI_CRITERION_MOHR_COULOMB = 1106,     /* shear > cohesion - tan(friction_angle) normal */
    PERI_CRITERION_CONFINED_STRETCH = 1107, /* s > s0 - compression * least s at either end */
    PERI_CRITERION_RATE_STRETCH = 1108,     /* s > s0 (1 + (ds/dt / rate)^rate_power) */
    PERI_CRITERION_DELAYED_STRETCH = 1109   /* s > s0 for `delay` in all */
} peri_criterion;

typedef struct peri_material_desc {
    uint64_t cookie;         /* set by init */
    int32_t law;             /* peri_law */
    int32_t criterion;       /* Default PERI_CRITERION_STRETCH */
    double young;            /* E [M L^-1 T^-2] > 0. Give E or K, not both; 0 = not given */
    double bulk;             /* K = E/(3(1-2 nu)) [M L^-1 T^-2] > 0 */
    double poisson;          /* [-] in (-1, 1/2); NaN (default): bond-based, that of the space */
    double density;          /* [M L^-3] > 0. Required */
    double fracture_energy;  /* G0 [M T^-2] > 0, per area of crack. 0 (default) = not given */
    double critical_stretch; /* s0 [-] > 0. 0 (default) = from G0; with neither, no bond breaks */
    double stabilization;    /* [-] >= 0, correspondence: against zero-energy modes. Default 0.2 */
    double strength;         /* [M L^-1 T^-2] > 0 of the criteria of stress; Mohr-Coulomb: or 0 */
    double cohesion;         /* [M L^-1 T^-2] > 0 of Mohr-Coulomb */
    double friction_angle;   /* [-] [0, pi/2) likewise */
    double compression;      /* alpha [-] 0..1e3, of the confined stretch. 0 (default): none */
    double rate;             /* [T^-1] > 0 of the rate stretch, and */
    double rate_power;       /* [-] 0..10. 0 (default): 1 */
    double delay;            /* [T] > 0 of the delayed stretch */
    double yield_shear;      /* LPS: [M L^-1 T^-2] in shear, at which it flows. Default 0: never */
    int32_t relaxations;     /* LPS, viscous: 0..PERI_RELAXATIONS. Default 0 */
    int32_t history;         /* numbers per point for `stress`, 0..PERI_HISTORY. Default 0 */
    double relaxation_part[4]; /* (0, 1] of the stiffness in shear, and */
    double relaxation_time[4]; /* [T] > 0 in which it relaxes */
    peri_stress_fn stress;   /* correspondence: yours. Default NULL */
    void *stress_user;
} peri_material_desc;

PERI_API void peri_material_desc_init(peri_material_desc *desc, int32_t law);

/* Adds a material, before peri_build; at most 120. Returns its id, or an error. */
PERI_API int32_t peri_add_material(peri_body *body, const peri_material_desc *desc);

/* Bonds between i and j break, and of bond-based i and j act, as if of `desc`, before peri_build;
   its law is that of one of them, not bond-based unless both are. Default: harmonic mean of the
   micromoduli, the criteria of both. */
PERI_API int32_t peri_set_interface(peri_body *body, int32_t i, int32_t j,
    const peri_material_desc *desc);

typedef enum peri_softening { /* of bonds past their strength, to no force */
    PERI_SOFTENING_BILINEAR = 2901,    /* straight */
    PERI_SOFTENING_TRILINEAR = 2902,   /* kinked at 1/4 of the strength: concrete */
    PERI_SOFTENING_EXPONENTIAL = 2903, /* cut off at 1/100 of the strength */
    PERI_SOFTENING_TABLE = 2904        /* a table of yours */
} peri_softening;

typedef enum peri_unloading {
    PERI_UNLOADING_SECANT = 3001, /* to the origin: damage */
    PERI_UNLOADING_ELASTIC = 3002 /* as stiff as new: a stretch stays */
} peri_unloading;

typedef struct peri_softening_desc {
    uint64_t cookie;        /* set by init */
    int32_t shape;          /* peri_softening, set by init */
    int32_t unloading;      /* Default PERI_UNLOADING_SECANT */
    double strength;        /* [M L^-1 T^-2] > 0, of uniaxial tension. Required */
    double fracture_energy; /* [M T^-2] > 0, the area under the curve. Required */
    double compression;     /* (0, 1] stiffness when shorter, over that when longer. Default 1 */
    int64_t count;          /* 2..30 rows of */
    const double *table;    /* [count*2] stretch past the strength, of any scale, from 0 ascending;
                               force over the strength, from 1 to 0, descending */
} peri_softening_desc;

PERI_API void peri_softening_desc_init(peri_softening_desc *desc, int32_t shape);

/* Bonds between bond-based materials i and j (i, i: within one) soften, before peri_build; their
   fracture_energy and critical_stretch do not count. PERI_BRITTLE: the horizon is too large, bonds
   break at once at less than the strength and take the energy. docs/laws.md */
PERI_API int32_t peri_set_softening(peri_body *body, int32_t i, int32_t j,
    const peri_softening_desc *desc);

/* The stretch at which bonds begin to soften, and that at which they break; after peri_build.
   PERI_BRITTLE: they are one. Either may be NULL. */
PERI_API int32_t peri_get_softening(peri_body *body, int32_t i, int32_t j, double *first,
    double *last);

/* Bonds between bond-based materials i and j follow fn, each with `states` (0..8) numbers of its
   own, 0 at first; before peri_build. Their critical stretch holds, too. docs/laws.md */
PERI_API int32_t peri_set_bond_law(peri_body *body, int32_t i, int32_t j, int32_t states,
    peri_bond_law_fn fn, void *user);

/* Micromodulus c [M L^-5 T^-2] (bond-based only, else NULL) and critical stretch s0 [-] (HUGE_VAL:
   never; softening: where they break, after peri_build) of bonds between materials i and j.
   Either may be NULL. ([P] C.15-C.20, [T] 1.24, 1.40) */
PERI_API int32_t peri_get_bond_constants(peri_body *body, int32_t i, int32_t j, double *c,
    double *s0);

/* Critical bond energy w0 [M L^-4 T^-2] of a material whose criterion is an energy; HUGE_VAL:
   none. PERI_CRITERION_NODE_ENERGY: after peri_build. */
PERI_API int32_t peri_get_critical_energy(peri_body *body, int32_t material, double *w0);

/* ---- points, before peri_build; each returns the number of points added, or an error  */

/* The box lo[dim]..hi[dim] in cells of about `spacing` [L], which tile it. */
PERI_API int64_t peri_add_box(peri_body *body, int32_t material, const double *lo,
    const double *hi, double spacing);

/* The box in cells[dim] cells per axis. */
PERI_API int64_t peri_add_grid(peri_body *body, int32_t material, const double *lo,
    const double *hi, const int32_t *cells);

/* The lattice cells whose centre is within `radius` of `centre`: a ball, in 2D a disc. */
PERI_API int64_t peri_add_ball(peri_body *body, int32_t material, const double *centre,
    double radius, double spacing);

/* The lattice cells of the box whose centre `inside` takes. */
PERI_API int64_t peri_add_shape(peri_body *body, int32_t material, const double *lo,
    const double *hi, double spacing, peri_point_fn inside, void *user);

/* peri_add_box, interior vertices moved by up to `amount` (0..1) quarters of a cell ([P] B). */
PERI_API int64_t peri_add_perturbed_box(peri_body *body, int32_t material, const double *lo,
    const double *hi, double spacing, double amount, uint64_t seed);

/* Points of yours: positions[count*dim] [L], volumes[count] [L^3] (planes: areas [L^2]),
   materials[count] (ids), or NULL where the body has one material. */
PERI_API int64_t peri_add_points(peri_body *body, int64_t count, const double *positions,
    const double *volumes, const int32_t *materials);

/* Cells: polygons, convex or not; tetrahedra, pyramids, wedges, hexahedra (4, 5, 6, 8 corners) in
   VTK's order, or mirrored. */
typedef struct peri_cells_desc {
    uint64_t cookie;          /* set by init */
    int64_t vertex_count;
    const double *vertices;   /* [vertex_count*vertex_stride] [L] */
    int64_t vertex_stride;    /* Default 0: dim */
    int64_t cell_count;
    const int32_t *corners;   /* of cell 0, 1, ... */
    const int64_t *offsets;   /* [cell_count+1] in corners[]. Default NULL: cell_corners each */
    int32_t cell_corners;
    int32_t reserved;         /* 0 */
    const int32_t *materials; /* [cell_count]. Default NULL */
} peri_cells_desc;

PERI_API void peri_cells_desc_init(peri_cells_desc *desc);

/* Each is a point at its centroid, with its volume; partial volumes are exact. */
PERI_API int64_t peri_add_cells(peri_body *body, const peri_cells_desc *desc);

/* Families of yours instead of a search: ibond[points*width] as in [T] 3.11, row i padded with i.
   Membership must be mutual. Weights are computed as for found families, of whose horizon they must
   be. */
PERI_API int32_t peri_set_families(peri_body *body, int32_t width, const int32_t *ibond);

/* ---- a part of a body: one of several processes, or a periodic cell (docs/scale.md) */

/* plane[k][i], of type PERI_TYPE_F64 or _F32, is of point i: send those of your points to where
   they are ghosts, and write those of ghosts. Once per step; `planes` is alike on all parts. */
typedef int32_t (*peri_exchange_fn)(void *user, int32_t type, int32_t planes, void **plane);

typedef enum peri_reduction { /* over all parts */
    PERI_REDUCTION_SUM = 3901,
    PERI_REDUCTION_MAX = 3902
} peri_reduction;

/* values[count] become their sums or maxima. Once per step, and in most calls. */
typedef int32_t (*peri_reduce_fn)(void *user, int32_t reduction, int64_t count, double *values);

/* Ghosts: copies of points that other parts own, peri_ghost_depth horizons deep. They bear no load
   and are in no set, sum or count. Give them all else that their owners have: cuts, motion. */
typedef struct peri_part_desc {
    uint64_t cookie;           /* set by init */
    double origin[3];          /* [L] any; this and the next two alike on all parts. Required */
    double length;             /* [L] > 0: the spacing; that of boxes to a factor of 16 */
    double mean_volume;        /* [L^3] > 0, planes [L^2], of a point */
    int64_t ghost_count;       /* Default 0 */
    const int32_t *ghosts;     /* [ghost_count] points, ascending */
    const int32_t *owners;     /* [ghost_count] the point that it is an image of in a periodic body,
                                  or -1. Default NULL: none is */
    const int64_t *ids;        /* [points] in the whole body, ascending. Default NULL: unknown */
    peri_exchange_fn exchange; /* where another part owns ghosts. Default NULL */
    peri_reduce_fn reduce;     /* of several parts. Default NULL */
    void *user;
} peri_part_desc;

PERI_API void peri_part_desc_init(peri_part_desc *desc);

/* After the points, before peri_build. All parts make the same calls. */
PERI_API int32_t peri_set_part(peri_body *body, const peri_part_desc *desc);

/* 1 or 2, before peri_build; the deepest that its materials need. */
PERI_API int32_t peri_ghost_depth(const peri_body *body);

/* H[dim*dim] [-] by rows: images have their owner's displacement + H (distance). Default 0 */
PERI_API int32_t peri_set_mean_gradient(peri_body *body, const double *gradient);

/* Of the cells of peri_add_box those from first[dim] to before last[dim]. */
PERI_API int64_t peri_add_box_part(peri_body *body, int32_t material, const double *lo,
    const double *hi, double spacing, const int32_t *first, const int32_t *last);

/* Finds the families, computes weights and constants, takes the state. Warns of rows of points, and
   of sheets of them in 3D: no constants are for these. After a failure the body is as it was: add
   what is missing and build again. */
PERI_API int32_t peri_build(peri_body *body);

/* ---- the built body: nouns return that number, 0 for NULL */

PERI_API int32_t peri_dimension(const peri_body *body); /* 2 or 3 */
PERI_API int64_t peri_point_count(const peri_body *body);
PERI_API int32_t peri_family_width(const peri_body *body); /* size of the largest family */
PERI_API int64_t peri_bond_count(const peri_body *body);   /* broken and cut ones included */
PERI_API int64_t peri_entry_count(const peri_body *body);  /* of all families: twice the bonds */
PERI_API int64_t peri_cut_count(const peri_body *body); /* bonds of the initial cracks */
PERI_API int64_t peri_broken_count(const peri_body *body); /* bonds broken, or cut later */
PERI_API int64_t peri_step_count(const peri_body *body); /* steps, load steps too, since reset */
PERI_API double peri_time(const peri_body *body); /* [T] since build or reset */
PERI_API double peri_load_factor(const peri_body *body); /* that loads act with; 0 before any did */

/* How bonds are worked on: "columns, AVX-512", "list, SSE2", "rows", "reference". */
PERI_API const char *peri_kernel_text(const peri_body *body);

/* Largest stable time step [T], to 4 % at rest; of state-based bodies that can break, a bound.
   Takes 20 to 100 steps once: docs/accuracy.md. 0 before peri_build. */
PERI_API double peri_stable_step(const peri_body *body);

/* Rows [first, first+count) of the families ([T] 3.11) to rows[count*width]: ascending, padded with
   the row's own number; broken bonds are listed. capacity counts entries. */
PERI_API int32_t peri_get_families(peri_body *body, int64_t first, int64_t count, int32_t *rows,
    int64_t capacity);

/* The point nearest to x[dim] [L]; _in_place: where it is now. */
PERI_API int32_t peri_find_point(peri_body *body, const double *x);
PERI_API int32_t peri_find_point_in_place(peri_body *body, const double *x);

/* 1: bond (i,j) carries force; 0: broken or cut; PERI_ERROR_PAIR: no such bond. */
PERI_API int32_t peri_bond_is_intact(peri_body *body, int32_t i, int32_t j);

/* Motion, time, steps, load factor and ledger become zero, broken bonds whole. Initial cracks,
   sets, loads, obstacles and no-fail zones stay. */
PERI_API int32_t peri_reset(peri_body *body);

/* ---- sets; select returns an id, or an error, PERI_ERROR_EMPTY where no point is taken  */

/* name (copied) may be NULL. Reference positions; box and ball include their boundary to 1e-9
   spacings. */
PERI_API int32_t peri_select_box(peri_body *body, const char *name, const double *lo,
    const double *hi);
PERI_API int32_t peri_select_ball(peri_body *body, const char *name, const double *centre,
    double radius);
/* By present positions. */
PERI_API int32_t peri_select_box_in_place(peri_body *body, const char *name, const double *lo,
    const double *hi);
PERI_API int32_t peri_select_ball_in_place(peri_body *body, const char *name, const double *centre,
    double radius);

PERI_API int32_t peri_select_if(peri_body *body, const char *name, peri_point_fn take, void *user);
PERI_API int32_t peri_select_points(peri_body *body, const char *name, int64_t count,
    const int32_t *points);

/* id, or PERI_ERROR_NAME */
PERI_API int32_t peri_find_set(const peri_body *body, const char *name);
PERI_API int64_t peri_size_of_set(const peri_body *body, int32_t set);
PERI_API int32_t peri_get_set(peri_body *body, int32_t set, int32_t *points, int64_t capacity);

/* ---- cracks and failure ----------------------------------------------------- */

typedef enum peri_standing { /* of a cut */
    PERI_CUT_INITIAL = 2101, /* an initial crack: stays at peri_reset. Only before the first step */
    PERI_CUT_NOW = 2102,     /* counts as broken, whole again at peri_reset */
    PERI_CUT_IN_PLACE = 2103 /* as PERI_CUT_NOW, where the body is now: by current positions */
} peri_standing;

/* Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9
   of a spacing. Returns the number of bonds newly cut. */
PERI_API int64_t peri_cut_segment(peri_body *body, int32_t standing, const double *from,
    const double *to); /* 2D */
PERI_API int64_t peri_cut_polyline(peri_body *body, int32_t standing, int64_t count,
    const double *vertices); /* 2D, [count*2] */
PERI_API int64_t peri_cut_disc(peri_body *body, int32_t standing, const double *centre,
    const double *normal, double radius); /* 3D */
PERI_API int64_t peri_cut_triangle(peri_body *body, int32_t standing, const double *p,
    const double *q, const double *r); /* 3D */
PERI_API int64_t peri_cut_rectangle(peri_body *body, int32_t standing, const double *corner,
    const double *edge1, const double *edge2); /* 3D, or parallelogram */
PERI_API int64_t peri_cut_pairs(peri_body *body, int32_t standing, int64_t count,
    const int32_t *pairs); /* [count*2] points; each pair must be a bond */
PERI_API int64_t peri_cut_if(peri_body *body, int32_t standing, peri_pair_fn cut, void *user);

/* Bonds with an end in the set never break by a criterion (on = 1), or may again (0). Cuts still
   cut. */
PERI_API int32_t peri_set_no_fail(peri_body *body, int32_t set, int32_t on);

/* fn is called for every bond that breaks by its criterion; NULL removes. Costs two to
   three bits per bond. */
PERI_API int32_t peri_on_break(peri_body *body, peri_break_fn fn, void *user);

/* Strength of bonds, times that of points: factors[count] of pairs[count*2], or of intact bonds
   that `take` takes. Returns how many. */
PERI_API int64_t peri_set_strength_pairs(peri_body *body, int64_t count, const int32_t *pairs,
    const double *factors);
PERI_API int64_t peri_set_strength_if(peri_body *body, double factor, peri_pair_fn take,
    void *user);

/* on = 1: keeps when bonds between adjacent points break, for peri_get_cracks: 32 to 44 bytes per
   point. */
PERI_API int32_t peri_record_breaks(peri_body *body, int32_t on);

/* ---- fragments: points joined by bonds that carry force --------------------- */

/* A rigid body of point masses; in 2D vectors end with 0. */
typedef struct peri_fragment {
    int32_t first;      /* its least point */
    int32_t points;     /* how many */
    int32_t parent;     /* the fragment that it broke off, or -1 */
    int32_t held;       /* 1: a support holds a point of it */
    double mass;        /* [M] */
    double centre[3];   /* [L] of mass, now */
    double velocity[3]; /* [L T^-1] of the centre */
    double angular[3];  /* [M L^2 T^-1] momentum about the centre */
    double inertia[6];  /* [M L^2] about the centre: xx yy zz xy yz xz */
    double lo[3];       /* [L] box around its points, now */
    double hi[3];
} peri_fragment;

/* How many there are, and which each point is in: of_point[points], or NULL. They are numbered 0,
   1, ... by their least points when first asked for. Of one that has split since, the piece of most
   points keeps the number; the others get the next ones. Free where no bond broke. */
PERI_API int64_t peri_find_fragments(peri_body *body, int32_t *of_point, int64_t capacity);

/* out[k] is fragment k. */
PERI_API int32_t peri_get_fragments(peri_body *body, peri_fragment *out, int64_t capacity);

/* The closed surface of a fragment, or of all (-1), now, by cells. vertices[][dim] [L];
   faces[][dim] of vertices: in 2D edges with the fragment on the left, loop by loop, edge k from
   vertex k on; in 3D triangles, counter-clockwise from outside. owners[], or NULL: its point;
   inner[], or NULL: 1 where a crack made it. Points and cells of yours are squares or cubes. */
PERI_API int32_t peri_size_of_outline(peri_body *body, int32_t fragment, int64_t *vertices,
    int64_t *faces);
PERI_API int32_t peri_get_outline(peri_body *body, int32_t fragment, double *vertices,
    int64_t vertex_capacity, int32_t *faces, int32_t *owners, int32_t *inner,
    int64_t face_capacity);

/* ---- initial state, supports, loads, obstacles: ids, or an error ------------ */

typedef enum peri_axis { /* or-ed */
    PERI_AXIS_X = 0x1001,
    PERI_AXIS_Y = 0x1002,
    PERI_AXIS_Z = 0x1004,
    PERI_AXIS_XY = 0x1003,
    PERI_AXIS_XYZ = 0x1007
} peri_axis;

/* Add value[dim] to the displacement [L] or velocity [L T^-1] of a set, now; peri_reset clears
   both. Sums are below 1e15 spacings, 1e9 speeds of sound. */
PERI_API int32_t peri_add_displacement(peri_body *body, int32_t set, const double *value);
PERI_API int32_t peri_add_velocity(peri_body *body, int32_t set, const double *value);

/* Supports: prescribe the `axes` of displacement [L] or velocity [L T^-1] of a set: value[dim]
   (NULL = zero), or as fn says (may be NULL). Later supports win. The load factor multiplies a
   constant displacement, not a velocity. A grip should be a horizon deep, of state-based laws
   two. */
PERI_API int32_t peri_prescribe_displacement(peri_body *body, int32_t set, int32_t axes,
    const double *value, peri_load_fn fn, void *user);
PERI_API int32_t peri_prescribe_velocity(peri_body *body, int32_t set, int32_t axes,
    const double *value, peri_load_fn fn, void *user);

/* Support: the set moves as a rigid body. motion: displacement [L], then in 2D the angle about
   centre[dim], in 3D a vector along the axis as long as the angle; NULL: 0. The load factor
   multiplies it; or fn writes it (may be NULL). */
PERI_API int32_t peri_prescribe_rigid(peri_body *body, int32_t set, const double *centre,
    const double *motion, peri_rigid_fn fn, void *user);

/* Body force density value[dim] [M L^-2 T^-2] on a set; gravity is density times g. */
PERI_API int32_t peri_apply_body_force(peri_body *body, int32_t set, const double *value,
    peri_load_fn fn, void *user);

/* Traction value[dim] [M L^-1 T^-2] on a flat face of `area` [L^2] (2D: length [L]) and outward
   `normal`. The set: all points within two horizons of it, of one material. Uniform stress is exact
   for correspondence; else the total is, and strain is off by O(horizon). ([C] 2.5,
   docs/statics.md) */
PERI_API int32_t peri_apply_traction(peri_body *body, int32_t set, double area,
    const double *normal, const double *value, peri_load_fn fn, void *user);

/* A total of value*area (in 2D times the thickness), spread over the set by volume: on
   the outermost layer, say. Exact in sum, but strain near the face is wrong by O(1) ([C]
   2.5). */
PERI_API int32_t peri_apply_layer_traction(peri_body *body, int32_t set, double area,
    const double *value, peri_load_fn fn, void *user);

/* Pressure [M L^-1 T^-2] on all surfaces of a set, faces of cracks included ([C] 2.6): for a crack
   select the points within two horizons of it. fn: value[k*dim] is the pressure on point k. */
PERI_API int32_t peri_apply_pressure(peri_body *body, int32_t set, double pressure,
    peri_load_fn fn, void *user);

/* As [C] 2.6 has it: through the cut bonds between neighbouring points. */
PERI_API int32_t peri_apply_bond_pressure_for_comparison(peri_body *body, int32_t set,
    double pressure, peri_load_fn fn, void *user);

PERI_API int32_t peri_remove_load(peri_body *body, int32_t load); /* ids are not used twice */

/* Force [M L T^-2] to force[dim]: of a support on the body, mean of the last step (or of the
   equilibrium); of a load, its present total. */
PERI_API int32_t peri_get_reaction(peri_body *body, int32_t load, double *force);

/* Its moment about place[dim] [M L^2 T^-2] to moment[1] (2D) or [3]. */
PERI_API int32_t peri_get_reaction_moment(peri_body *body, int32_t load, const double *place,
    double *moment);

typedef enum peri_shape { /* of an obstacle, solid, in its own frame */
    PERI_SHAPE_PLANE = 2601,    /* all behind the plane through 0 with `normal` */
    PERI_SHAPE_BALL = 2602,     /* radius; 2D: a disc */
    PERI_SHAPE_BOX = 2603,      /* size, about 0 */
    PERI_SHAPE_CAPSULE = 2604,  /* within radius of a line of `length` along `axis`, about 0 */
    PERI_SHAPE_CYLINDER = 2605, /* 3D: the same with flat ends */
    PERI_SHAPE_MESH = 2606,     /* within the closed surface of vertices and faces */
    PERI_SHAPE_DISTANCE = 2607  /* where `distance` is below 0 */
} peri_shape;

/* Pushes points within it out along the normal by stiffness*depth [M L^-2 T^-2]. A free one (of a
   mass) is moved by that and by gravity, not by other obstacles. */
typedef struct peri_obstacle_desc {
    uint64_t cookie;           /* set by init */
    int32_t shape;             /* peri_shape, set by init */
    int32_t reserved;          /* 0 */
    double place[3];           /* of the frame, and */
    double turn[4];            /* see peri_motion_fn. Default 0: the frame of the body */
    double normal[3];          /* of a plane, */
    double axis[3];            /* of capsule and cylinder, of any length */
    double radius;             /* [L] > 0; PERI_SHAPE_DISTANCE: all lies within it, 0: unknown */
    double length;             /* [L] > 0 */
    double size[3];            /* [L] > 0 */
    int64_t vertex_count;
    int64_t face_count;
    const double *vertices;    /* [vertex_count*dim] [L]; 2D: of a polygon, counter-clockwise */
    const int32_t *faces;      /* 3D: [face_count*3], counter-clockwise from outside */
    peri_distance_fn distance;
    double stiffness;          /* [M L^-3 T^-2]. 0 (default): young/spacing^2 */
    double friction;           /* mu [-] >= 0, Coulomb. Default 0 */
    double friction_speed;     /* [L T^-1] >= 0: slower slip is resisted less. 0 (default): 1e-6
                                  sqrt(young/density) */
    double restitution;        /* (0, 1], of what is stiff beside the obstacle. Default 1 */
    double mass;               /* [M] > 0: a free rigid body. Default 0; or */
    double density;            /* [M L^-3] > 0: likewise. Default 0 */
    double inertia[3];         /* [M L^2] about the axes of the frame, 2D: inertia[0]; HUGE_VAL:
                                  never turns. 0 (default): of the shape, uniform */
    double velocity[3];        /* [L T^-1] of a free one at the start */
    double spin[3];            /* [T^-1] likewise; 2D: spin[0] */
    double gravity[3];         /* [L T^-2] of a free one */
    peri_motion_fn motion;     /* of others. Default NULL: at rest */
    void *user;                /* of distance and motion */
} peri_obstacle_desc;

PERI_API void peri_obstacle_desc_init(peri_obstacle_desc *desc, int32_t shape);

/* A mesh is copied, and must be closed. */
PERI_API int32_t peri_add_obstacle(peri_body *body, const peri_obstacle_desc *desc);
PERI_API int32_t peri_remove_obstacle(peri_body *body, int32_t obstacle);

/* On the body: force[dim] [M L T^-2]; moment[3], in 2D [1], [M L^2 T^-2] about its place. Either
   may be NULL. */
PERI_API int32_t peri_get_obstacle_force(peri_body *body, int32_t obstacle, double *force,
    double *moment);

typedef struct peri_obstacle_state { /* of its frame; components beyond dim are 0 */
    double place[3];
    double turn[4];
    double velocity[3]; /* mean of the last step; of a free one now; and */
    double spin[3];     /* [T^-1] likewise; 2D: spin[0] */
    double mass;        /* [M] of a free one, else 0 */
    double kinetic;     /* [M L^2 T^-2] likewise */
    double stored;      /* [M L^2 T^-2] in its springs */
    double lost;        /* to friction and restitution since build or reset */
} peri_obstacle_state;

PERI_API int32_t peri_get_obstacle_state(peri_body *body, int32_t obstacle,
    peri_obstacle_state *state);

/* Sets place, turn, velocity and spin of a free one. */
PERI_API int32_t peri_set_obstacle_state(peri_body *body, int32_t obstacle,
    const peri_obstacle_state *state);

/* ---- contact ---------------------------------------------------------------- */

/* Unbonded surface points: 1/2 k (d - r)^2 where r < d = min(distance, |xi|), k = stiffness E V
   /(spacing distance) */
typedef struct peri_contact_desc {
    uint64_t cookie;       /* set by init */
    double stiffness;      /* (0, 1e3] of a cell's own [-]. Default 0.25 */
    double distance;       /* [L] Default 0: the spacing */
    double friction;       /* mu [-] 0..1e3. Default 0 */
    double friction_speed; /* [L T^-1] below it: viscous. Default 0 */
    double restitution;    /* (0, 1] of light pieces. Default 1 */
} peri_contact_desc;

PERI_API void peri_contact_desc_init(peri_contact_desc *desc);

/* Of materials i and j, ids or PERI_ALL; NULL: none. */
PERI_API int32_t peri_set_contact(peri_body *body, int32_t i, int32_t j,
    const peri_contact_desc *desc);

/* ---- motion ----------------------------------------------------------------- */

typedef enum peri_integrator {
    PERI_INTEGRATOR_VELOCITY_VERLET = 1201,   /* half kick, drift, force, half kick [T] 2.2 */
    PERI_INTEGRATOR_CENTRAL_DIFFERENCE = 1202 /* one kick per step, the same motion [L], [T] 2.10 */
} peri_integrator;

/* Every frame_steps steps and at the end of a run; at each equilibrium of peri_solve. > 0 stops. It
   may also cut, select, set no-fail zones and contact, add or remove loads and obstacles. */
typedef int32_t (*peri_frame_fn)(void *user, peri_body *body);

typedef struct peri_advance_desc {
    uint64_t cookie;        /* set by init */
    int32_t integrator;     /* Default PERI_INTEGRATOR_VELOCITY_VERLET */
    int32_t force_step;     /* 1: time_step may exceed peri_stable_step. Default 0 */
    int64_t steps;          /* run this many steps; or */
    double duration;        /* [T] run this long, to the last bit. One of the two is required */
    double time_step;       /* [T] > 0; 0 (default): safety * peri_stable_step */
    double safety;          /* (0, 1]. Default 0.9 */
    double damping;         /* a [T^-1] >= 0: force -a*density*velocity. Default 0 */
    double load_factor;     /* NaN (default): peri_load_factor, or 1 where none has acted */
    int64_t frame_steps;    /* steps between calls of on_frame; 0 (default): only at the end */
    peri_frame_fn on_frame; /* Default NULL */
    void *user;
} peri_advance_desc;

PERI_API void peri_advance_desc_init(peri_advance_desc *desc);

/* Advances the body in time. PERI_ERROR_STEP: it ends at a whole step; the value is what may
   follow. So does PERI_ERROR_CALLBACK of a peri_frame_fn or peri_break_fn. PERI_ERROR_UNSTABLE, and
   PERI_ERROR_CALLBACK of a load or obstacle (index: the point): it ended within a step; read it,
   then reset or destroy it. */
PERI_API int32_t peri_advance(peri_body *body, const peri_advance_desc *desc);

/* ---- worlds: bodies that advance together and touch (docs/laws.md) ----------- */

typedef struct peri_world peri_world; /* opaque; its bodies remain yours, and leave as they die */

typedef struct peri_world_desc {
    uint64_t cookie;           /* set by init */
    peri_allocate_fn allocate; /* Default NULL: malloc */
    peri_release_fn release;   /* Default NULL: free */
    void *memory_user;
    double sleep_speed; /* [L T^-1] of points, below which bodies rest. Default 0: none sleeps */
    double sleep_time;  /* [T] of rest, after which they sleep; positive with sleep_speed */
} peri_world_desc;

PERI_API void peri_world_desc_init(peri_world_desc *desc);
PERI_API int32_t peri_world_create(const peri_world_desc *desc, peri_world **world,
    peri_error *error);
PERI_API void peri_world_destroy(peri_world *world);
PERI_API int64_t peri_world_bytes(const peri_world *world); /* it holds, beside its bodies */

/* *body: whose error it is, or NULL. body may be NULL. */
PERI_API int32_t peri_world_get_error(const peri_world *world, peri_error *error,
    peri_body **body);

/* Built bodies of one dimension. Points do not touch at the distance they have when added. */
PERI_API int32_t peri_world_add(peri_world *world, peri_body *body);
PERI_API int32_t peri_world_remove(peri_world *world, peri_body *body);

/* Of bodies a and b, NULL: any, those yet to come too. desc NULL: none. Default: peri_contact_desc
   with distance and spacing the mean of both spacings. */
PERI_API int32_t peri_world_set_contact(peri_world *world, const peri_body *a,
    const peri_body *b, const peri_contact_desc *desc);

/* 1: the body sleeps, 0: not. NULL: how many do. */
PERI_API int64_t peri_world_asleep(const peri_world *world, const peri_body *body);

/* As peri_stable_step and peri_advance, for all by one step. on_frame comes for each body. */
PERI_API double peri_world_stable_step(peri_world *world);
PERI_API int32_t peri_world_advance(peri_world *world, const peri_advance_desc *desc);

/* force[dim] [M L T^-2] of the others on a body, in the last step. */
PERI_API int32_t peri_world_get_force(peri_world *world, const peri_body *body, double *force);

/* ---- a time loop or a solver of yours (examples/own_loop.c) ------------------ */

typedef struct peri_evaluate_desc {
    uint64_t cookie;          /* set by init */
    int32_t type;             /* of all arrays: PERI_TYPE_F64 (default) or PERI_TYPE_F32 */
    int32_t nodal;            /* 1: forces [M L T^-2]; 0 (default): per volume [M L^-2 T^-2] */
    int32_t bonds;            /* 1 (default): theirs; 0: not */
    int32_t external;         /* 1 (default): of loads (moving: obstacles, contact); 0: not */
    int32_t fracture;         /* 1: the body moves there, and bonds break. Default 0: it stays */
    int32_t energy;           /* 1: report.energy, for one more pass. Default 0 */
    int64_t point_stride;     /* in elements. Default 0: dim */
    int64_t component_stride; /* Default 0: 1 */
    const void *displacement; /* [L]. Default NULL: where the body is */
    const void *velocity;     /* [L T^-1], with fracture. Default NULL: that of the body */
    double time_step;         /* [T], with fracture: how long `velocity` took it there. Default 0 */
    double time;              /* of loads. NaN (default): peri_time */
    double load_factor;       /* Default NaN: the body's */
    void *force;              /* out, supports aside. Default NULL */
    void *impulse;            /* out, with time_step: force times [T] of bonds that broke */
} peri_evaluate_desc;

typedef struct peri_evaluate_report {
    int64_t broken; /* bonds, by this call */
    double energy;  /* elastic [M L^2 T^-2], of the bonds that are left */
} peri_evaluate_report;

PERI_API void peri_evaluate_desc_init(peri_evaluate_desc *desc);

/* Forces at a displacement of yours. A step, rho of PERI_FIELD_DENSITY: v += dt/2 force/rho,
   u += dt v, peri_evaluate, v += (dt/2 force + impulse)/rho. report may be NULL. */
PERI_API int32_t peri_evaluate(peri_body *body, const peri_evaluate_desc *desc,
    peri_evaluate_report *report);

/* ---- equilibrium (docs/statics.md) ------------------------------------------ */

typedef enum peri_method {
    PERI_METHOD_NEWTON = 1301,    /* conjugate gradients on the tangent, never stored */
    PERI_METHOD_BICGSTAB = 1302,  /* on the assembled tangent ([T] 3.2): for comparison */
    PERI_METHOD_RELAXATION = 1303 /* adaptive dynamic relaxation: slow, any tangent */
} peri_method;

typedef enum peri_preconditioner {
    PERI_PRECONDITIONER_MULTILEVEL = 1401,   /* blocks, and elasticity on background grids */
    PERI_PRECONDITIONER_BLOCK_JACOBI = 1402, /* the dim x dim blocks of the diagonal */
    PERI_PRECONDITIONER_NONE = 1403
} peri_preconditioner;

typedef enum peri_loose { /* parts that no support holds against some rigid-body mode */
    PERI_LOOSE_REFUSED = 1501, /* PERI_ERROR_LOOSE, index: a point of it; see lost_parts */
    PERI_LOOSE_PINNED = 1502,  /* just enough is held; exact where loads balance */
    PERI_LOOSE_BALANCED = 1503 /* the part of the loads that drives the mode is left out */
} peri_loose;

typedef enum peri_control { /* what sets the load factor */
    PERI_CONTROL_LOAD = 2801,    /* the load steps */
    PERI_CONTROL_FRACTURE = 2802 /* where the next bond meets its criterion: through snap-back */
} peri_control;

typedef enum peri_ended { /* why a solve ended */
    PERI_ENDED_LOAD = 2701,    /* load_to is reached */
    PERI_ENDED_SEVERED = 2702, /* a part that bears a load or a support broke off */
    PERI_ENDED_BREAKS = 2703,
    PERI_ENDED_STOPPED = 2704
} peri_ended;

/* After each iteration of the linear solver, with the residual over its scale. > 0 stops there,
   short of the equilibrium. */
typedef int32_t (*peri_iteration_fn)(void *user, int64_t iteration, double residual);

typedef struct peri_solve_desc {
    uint64_t cookie;                /* set by init */
    int32_t method;                 /* Default PERI_METHOD_NEWTON */
    int32_t preconditioner;         /* of Newton. Default PERI_PRECONDITIONER_MULTILEVEL */
    int32_t loose;                  /* Default PERI_LOOSE_REFUSED */
    int32_t fracture;               /* 1 (default): bonds break by their criterion; 0: none */
    int32_t control;                /* Default PERI_CONTROL_LOAD */
    int32_t curve_load;             /* load or support whose curve is recorded. Default 0: none */
    int32_t keep;                   /* 1: what this solve prepares serves the next, until bonds or
                                       supports change. Default 0: that is freed */
    int32_t reserved;               /* 0 */
    double criticality;             /* [0, 1]: break those over this part of the largest excess.
                                       Default 0.98; 1: one by one */
    double tolerance;               /* [0, 1): |residual| over |loads| or |reactions|. 0
                                       (default): 1e-8, mixed 1e-5, single 1e-4 */
    double energy_tolerance;        /* > 0, of Newton: this fall of the residual's energy is
                                       enough, too. Default 0: never */
    int64_t iterations;             /* most for one equilibrium, linear. Default 20000 */
    int64_t newton;                 /* most Newton iterations for one equilibrium. Default 60 */
    int64_t breaks;                 /* most rounds of breaking at one factor, or of fracture
                                       control. Default 100000 */
    double load_from;               /* factor to begin at. NaN (default): peri_load_factor */
    double load_to;                 /* factor at the end. Default 1 */
    int64_t steps;                  /* load steps >= 1. Default 1 */
    double duration;                /* [T] >= 0 of all steps: what flows, does. Default 0 */
    int64_t halvings;               /* most halvings of a failing step, 0..60. Default 8 */
    double *curve;                  /* [curve_rows][2 + 2*dim]: load factor, mean displacement
                                       [L], peri_get_reaction, broken bonds */
    int64_t curve_rows;             /* rows that fit; more are counted in the report */
    peri_iteration_fn on_iteration; /* Default NULL */
    peri_frame_fn on_step;          /* at each equilibrium, also after it cut. Default NULL */
    void *user;                     /* for both */
} peri_solve_desc;

typedef struct peri_solve_report {
    int64_t iterations; /* of the linear solver, or relaxation steps, in all */
    int64_t passes;     /* evaluations of all bonds: forces and products with the tangent */
    int64_t newton;     /* Newton iterations in all */
    int64_t steps;      /* load steps done */
    int64_t broken;     /* bonds broken */
    int64_t curve_rows; /* rows of the curve, written or not */
    int64_t loose;      /* rigid-body modes pinned or balanced in the last equilibrium */
    int64_t lost_parts; /* broke off, bear nothing and are left where they are */
    int64_t lost_points;
    int64_t bytes;      /* most memory of the solver at a time, beside the body */
    int32_t ended;      /* peri_ended; 0 where the solve failed */
    int32_t reserved;   /* 0 */
    double residual;    /* of the last equilibrium, over its scale; 0 where nothing acts */
    double load_factor; /* of the last equilibrium */
} peri_solve_report;

PERI_API void peri_solve_desc_init(peri_solve_desc *desc);

/* Equilibrium under supports and loads, constant values times a factor from load_from to load_to,
   callbacks at time = factor, prescribed velocities at rest; bonds over their limit break until
   none does. A later run goes on at load_to. A failed step leaves the last equilibrium, or, after
   breaks, how far it came; so does PERI_ENDED_SEVERED. */
PERI_API int32_t peri_solve(peri_body *body, const peri_solve_desc *desc,
    peri_solve_report *report);

/* peri_advance by implicit steps, `time_step` > 0 of any size (generalised alpha, order 2). rho
   [0, 1]: what is left of the highest modes per step; 1 keeps the energy. solve: tolerance,
   fracture, limits, on_iteration; NULL: defaults. No obstacles or contact. A step that fails leaves
   the last one, less the bonds that broke in it. report may be NULL. */
PERI_API int32_t peri_advance_implicit(peri_body *body, const peri_advance_desc *advance,
    const peri_solve_desc *solve, double rho, peri_solve_report *report);

/* out = K in [M L T^-2], the tangent at the present displacement times in[count], count =
   points*dim; without supports, obstacles and contact. out may be in. The first call takes memory
   (peri_memory.state). */
PERI_API int32_t peri_multiply_stiffness(peri_body *body, const double *in, double *out,
    int64_t count);

/* The same at `displacement` [points*dim] of yours instead: the body stays where it is. */
PERI_API int32_t peri_multiply_stiffness_at(peri_body *body, const double *displacement,
    const double *in, double *out, int64_t count);

/* The same as a matrix by compressed rows, points*dim square ([T] 3.2, 3.3). It outlives the body;
   free it by peri_matrix_destroy. */
typedef struct peri_matrix peri_matrix;
PERI_API int32_t peri_matrix_create(peri_body *body, peri_matrix **matrix);
PERI_API void peri_matrix_destroy(peri_matrix *matrix);
PERI_API int64_t peri_matrix_rows(const peri_matrix *matrix);
PERI_API int64_t peri_matrix_entries(const peri_matrix *matrix);

/* start[rows+1], column[entries] ascending in each row, value[entries] [M T^-2]; any may be
   NULL. */
PERI_API int32_t peri_get_matrix(const peri_matrix *matrix, int64_t *start, int32_t *column,
    double *value);

/* Matrix Market, coordinate real symmetric: the lower triangle. */
PERI_API int32_t peri_export_matrix_to(const peri_matrix *matrix, peri_write_fn write, void *user);

/* ---- results ---------------------------------------------------------------- */

/* [tensor]: xx yy xy in 2D, xx yy zz xy yz xz in 3D. S: stored, W: can be set. */
typedef enum peri_field {
    PERI_FIELD_POSITION = 2001,         /* S [dim] reference position [L] */
    PERI_FIELD_DISPLACEMENT = 2002,     /* SW [dim] [L] */
    PERI_FIELD_VELOCITY = 2003,         /* SW [dim] [L T^-1] */
    PERI_FIELD_FORCE_DENSITY = 2004,    /* S [dim] internal, loads, obstacles, contact */
    PERI_FIELD_VOLUME = 2005,           /* S [L^3]; planes: area [L^2] */
    PERI_FIELD_MATERIAL = 2006,         /* PERI_ID_INDEX of the material */
    PERI_FIELD_FAMILY_SIZE = 2007,      /* bonds of the point, broken ones included */
    PERI_FIELD_DAMAGE = 2008,           /* 1 - intact/all volume of the family [-] [L] */
    PERI_FIELD_DAMAGE_GROWN = 2009,     /* the same among bonds that are not initial cracks */
    PERI_FIELD_ENERGY_DENSITY = 2010,   /* elastic W of the law [M L^-1 T^-2] [P] eq. 7 */
    PERI_FIELD_CURRENT_POSITION = 2011, /* [dim] [L] */
    PERI_FIELD_DILATATION = 2012,       /* theta of the law [-] */
    PERI_FIELD_STRAIN = 2013,           /* [tensor] of F: small, or Green-Lagrange [T] 4.14 */
    PERI_FIELD_STRESS = 2014,           /* [tensor] Cauchy, of the material [M L^-1 T^-2] */
    PERI_FIELD_FORCE_STRESS = 2015,     /* [tensor] Cauchy, what the bonds carry [T] 4.10, 4.13 */
    PERI_FIELD_REACTION = 2016,         /* [dim] force density of supports, mean of the last step */
    PERI_FIELD_FRAGMENT = 2017,         /* peri_find_fragments */
    PERI_FIELD_MASS = 2018,             /* [M]; planes: thickness included */
    PERI_FIELD_DENSITY = 2019,          /* W [M L^-3] Default: of the material */
    PERI_FIELD_HELD = 2020,             /* [dim] 1: a support prescribes it; else 0 */
    PERI_FIELD_EIGENSTRAIN = 2021,      /* W stretch at no force [-] -0.9..10. Default 0 */
    PERI_FIELD_STRENGTH = 2022,         /* W times s0, squared times w0 [-] 1e-6..1e6. Default 1 */
    PERI_FIELD_STIFFNESS = 2023,        /* W times E [-] 1e-6..1e6. Default 1 */
    PERI_FIELD_DEFORMATION_GRADIENT = 2024 /* [dim*dim] F by rows */
} peri_field;

typedef enum peri_type {
    PERI_TYPE_F64 = 1601,
    PERI_TYPE_F32 = 1602,
    PERI_TYPE_I32 = 1603
} peri_type;

/* Entries of a field: points*components. */
PERI_API int64_t peri_size_of_field(const peri_body *body, int32_t field);

/* Copies a field, as double, in your units and order. capacity counts doubles. */
PERI_API int32_t peri_get_field(peri_body *body, int32_t field, double *out, int64_t capacity);

/* Sets a field W of all points; count = points*components. What peri_get_field gives changes no
   bit. Fields of material (docs/laws.md), which peri_frame_fn may set, too, outlast peri_reset. */
PERI_API int32_t peri_set_field(peri_body *body, int32_t field, const double *in, int64_t count);

/* A field in place: component k of point i, in your units, is offset[k] + scale *
   data[i*point_stride + k*component_stride]. */
typedef struct peri_view {
    const void *data;         /* of the body */
    int64_t count;            /* points */
    int64_t point_stride;     /* in elements */
    int64_t component_stride; /* in elements */
    int32_t components;       /* 1, dim, 3 or 6 of a tensor, or dim*dim */
    int32_t type;             /* peri_type */
    double scale;
    double offset[3];
} peri_view;

/* Without a copy. Of a stored field it shows the present state; of a derived one that of the call,
   until it is viewed again. */
PERI_API int32_t peri_view_field(peri_body *body, int32_t field, peri_view *view);

/* Of points[count] alone: count*components. */
PERI_API int32_t peri_get_field_at(peri_body *body, int32_t field, int64_t count,
    const int32_t *points, double *out, int64_t capacity);

/* At places[count*dim] [L], in_place = 1: present ones: linear fields exactly, not across cracks.
   Outside: NaN. */
PERI_API int32_t peri_interpolate_field(peri_body *body, int32_t field, int32_t in_place,
    int64_t count, const double *places, double *out, int64_t capacity);

typedef enum peri_bond { /* of i's family */
    PERI_BOND_POINT = 4001,   /* i */
    PERI_BOND_OTHER = 4002,   /* j */
    PERI_BOND_LENGTH = 4003,  /* |xi| [L] */
    PERI_BOND_VOLUME = 4004,  /* beta V_j [L^3] */
    PERI_BOND_WEIGHT = 4005,  /* w beta V_j, corrected */
    PERI_BOND_INTACT = 4006,  /* 1 or 0 */
    PERI_BOND_STRETCH = 4007, /* [-] */
    PERI_BOND_FORCE = 4008,   /* [dim] part of the force density of i */
    PERI_BOND_ENERGY = 4009   /* and of the energy density */
} peri_bond;

/* Bonds of the points of a set, as in peri_get_families. */
PERI_API int64_t peri_size_of_bonds(const peri_body *body, int32_t set, int32_t bond);
PERI_API int32_t peri_get_bonds(peri_body *body, int32_t set, int32_t bond, double *out,
    int64_t capacity);

/* The ledger [M L^2 T^-2], from build or reset on: initial + external + obstacle = kinetic +
   elastic + contact + damping + fracture + error. */
typedef struct peri_energy {
    double kinetic;
    double elastic;  /* stored in intact bonds */
    double contact;  /* stored in contact */
    double external; /* work of loads and supports; in peri_solve of obstacles, too */
    double obstacle; /* work of obstacles */
    double damping;  /* by damping and contact; in peri_solve what springs free as bonds break */
    double fracture; /* elastic energy that went with bonds as they broke, less what contact got */
    double initial;  /* put in by setting motion, less what later cuts took out */
    double error;    /* what time steps, or load steps, left open */
} peri_energy;

/* Costs one evaluation of the forces. */
PERI_API int32_t peri_get_energy(peri_body *body, peri_energy *energy);

/* The ledger of all; in that of a body, what others do is `external`. */
PERI_API int32_t peri_world_get_energy(peri_world *world, peri_energy *energy);

/* Momentum [M L T^-1] to linear[dim], about the origin [M L^2 T^-1] to angular[1] (2D) or [3].
   Either may be NULL. */
PERI_API int32_t peri_get_momentum(peri_body *body, double *linear, double *angular);

/* Cracks: midway through the broken bonds of adjacent points. They outlive the body; free them by
   peri_cracks_destroy. */
typedef struct peri_cracks peri_cracks;

typedef struct peri_cracks_desc {
    uint64_t cookie;  /* set by init */
    int32_t initial;  /* 1 (default): initial cracks, too */
    int32_t current;  /* 1: where the body is now. Default 0: reference positions */
    double shortest;  /* [L] >= 0, 2D: leaves out shorter cracks and branches with a tip. NaN
                         (default): the horizon */
} peri_cracks_desc;

typedef struct peri_crack_tip { /* 2D: where a path ends within the body */
    double place[3];     /* [L] */
    double direction[3]; /* of length 1 */
    double speed;        /* [L T^-1] NaN: not recorded */
    int64_t path;        /* 0, 1, ... */
} peri_crack_tip;

PERI_API void peri_cracks_desc_init(peri_cracks_desc *desc);
PERI_API int32_t peri_cracks_create(peri_body *body, const peri_cracks_desc *desc,
    peri_cracks **cracks);
PERI_API void peri_cracks_destroy(peri_cracks *cracks);
PERI_API int64_t peri_cracks_paths(const peri_cracks *cracks); /* polylines; 3D: sides of cells */
PERI_API int64_t peri_cracks_vertices(const peri_cracks *cracks);
PERI_API int64_t peri_cracks_tips(const peri_cracks *cracks);
PERI_API double peri_cracks_size(const peri_cracks *cracks); /* length [L]; 3D: area [L^2] */

/* Path p: vertices start[p] to start[p+1], of start[paths+1]; in 3D 4: triangles 0 1 2, 0 2 3.
   vertex[vertices*dim] [L], time[vertices] of breaking [T] (peri_solve: load factor; NaN: not
   recorded), tip[tips]. Any may be NULL. */
PERI_API int32_t peri_get_cracks(const peri_cracks *cracks, int64_t *start, double *vertex,
    double *time, peri_crack_tip *tip);

/* VTK XML PolyData (.vtp). */
PERI_API int32_t peri_export_cracks_to(const peri_cracks *cracks, peri_write_fn write, void *user);

/* VTK XML for ParaView; "Warp By Vector" shows the deformed body. */
PERI_API int32_t peri_export_vtu_to(peri_body *body, peri_write_fn write, void *user);

/* fields[count], each once, or NULL: as above. */
PERI_API int32_t peri_export_fields_to(peri_body *body, const int32_t *fields, int64_t count,
    peri_write_fn write, void *user);

/* One CSV line: step, time, the ledger, broken and cut bonds; header = 1: the names first. */
PERI_API int32_t peri_export_history_to(peri_body *body, int32_t header, peri_write_fn write,
    void *user);

#ifndef PERI_NO_STDIO
PERI_API int32_t peri_export_vtu(peri_body *body, const char *path);
/* Frame 0, 1, ... of a series: its VTU beside `path`, a .pvd. */
PERI_API int32_t peri_export_frame(peri_body *body, const char *path, int64_t frame,
    const int32_t *fields, int64_t count);
/* append = 0 starts the file with a header, 1 adds a line. */
PERI_API int32_t peri_export_history(peri_body *body, const char *path, int32_t append);
#endif

/* Saves the state: motion, bonds, what criteria keep, time, ledger. Not the scene: load it into a
   body that the same calls built. What follows has the same bits. */
PERI_API int32_t peri_save_state_to(peri_body *body, peri_write_fn write, void *user);

/* Reads all, verifies it, then takes it. PERI_ERROR_STATE: nothing has changed; field: what is of
   another scene, or "". */
PERI_API int32_t peri_load_state_from(peri_body *body, peri_read_fn read, void *user);

#ifndef PERI_NO_STDIO
PERI_API int32_t peri_save_state(peri_body *body, const char *path);
PERI_API int32_t peri_load_state(peri_body *body, const char *path);
#endif

/* ---- what a scene costs (docs/accuracy.md) ---------------------------------- */

/* Bytes that the body holds, as asked of its allocator. Solves and builds take more. */
typedef struct peri_memory {
    int64_t points;   /* positions, volumes, materials, sizes of families */
    int64_t families; /* who is bonded to whom, and what each bond weighs */
    int64_t damage;   /* flags of bonds, no-fail zones, events, what the criteria keep */
    int64_t state;    /* displacements, velocities, forces, and scratch of passes */
    int64_t laws;     /* materials, constants, and the body itself */
    int64_t loads;    /* sets, supports, loads, obstacles, contact */
    int64_t fields;   /* derived fields that were viewed; fragments */
    int64_t total;    /* of all these */
    int64_t shared;   /* of the total: what clones share */
} peri_memory;

PERI_API int32_t peri_get_memory(const peri_body *body, peri_memory *memory);

typedef enum peri_source {
    PERI_SOURCE_BOX = 1701,       /* peri_add_box */
    PERI_SOURCE_PERTURBED = 1702, /* peri_add_perturbed_box */
    PERI_SOURCE_POINTS = 1703     /* peri_add_points: a cloud, about one point to a cell */
} peri_source;

typedef struct peri_plan_desc { /* a body that is only described: one material in a box */
    uint64_t cookie;                    /* set by init */
    const peri_body_desc *body;         /* Required */
    const peri_material_desc *material; /* Required */
    int32_t source;                     /* Default PERI_SOURCE_BOX */
    int32_t measure;                    /* 1: time a small body, 20..100 ms. Default 0: no clock */
    double amount;                      /* [0, 1], of PERI_SOURCE_PERTURBED. Default 1 */
    double lo[3];                       /* [L] corners. Required */
    double hi[3];
    double spacing;                     /* [L] > 0. Required */
} peri_plan_desc;

typedef struct peri_plan_report {
    int64_t points;     /* peri_point_count */
    int64_t entries;    /* peri_entry_count: exact of a box, else to 5 % */
    int64_t width;      /* peri_family_width: exact of a box, else an estimate */
    int64_t columns;    /* families by columns: how many; 0: a list */
    int64_t bytes;      /* peri_memory.total after peri_build: exact of a box, else to 5 % */
    int64_t peak;       /* most at a time in peri_build, to 5 % or half a megabyte */
    double stable_step; /* [T] peri_stable_step, of a box to 6 % */
    double seconds;     /* [s] of one thread per step; 0 where not measured */
} peri_plan_report;

PERI_API void peri_plan_desc_init(peri_plan_desc *desc);

/* What a scene will cost, before it is made: some milliseconds. Refuses what peri_body_create,
   peri_add_material, peri_add_box and peri_build would refuse. error may be NULL. */
PERI_API int32_t peri_plan(const peri_plan_desc *desc, peri_plan_report *report, peri_error *error);

typedef enum peri_quantity { /* what is to be right; its feature */
    PERI_QUANTITY_DEFORMATION = 1801, /* stiffness; the least thickness that carries */
    PERI_QUANTITY_STRESS = 1802,      /* around holes and notches; the radius */
    PERI_QUANTITY_WAVES = 1803,       /* their way; the shortest wavelength */
    PERI_QUANTITY_FRACTURE = 1804     /* when cracks grow; the crack's length, 8 spacings or more */
} peri_quantity;

typedef enum peri_preset { /* named errors */
    PERI_PRESET_NONE = 1901,
    PERI_PRESET_GAME = 1902,        /* 20 % */
    PERI_PRESET_TEACHING = 1903,    /* 10 % */
    PERI_PRESET_ENGINEERING = 1904, /* 5 % */
    PERI_PRESET_REFERENCE = 1905    /* deformation 1 %, stress 2 %, waves and fracture 3 % */
} peri_preset;

typedef struct peri_choose_desc { /* a preset, or an error, at least cost; or a budget; or both */
    uint64_t cookie;  /* set by init */
    int32_t preset;   /* Default PERI_PRESET_NONE */
    int32_t quantity; /* peri_quantity. Required */
    double error;     /* (0, 1) relative error to reach. Default 0: not given */
    double seconds;   /* [s] of one thread per step. Default 0: any. Takes about a second */
    int64_t bytes;    /* most until peri_build has returned. Default 0: any */
    double feature;   /* [L] > 0. Required */
    double lo[3];     /* [L] corners of the scene. Required */
    double hi[3];
} peri_choose_desc;

typedef struct peri_choose_report {
    double spacing;        /* [L] for peri_add_box */
    double across;         /* spacings across the feature */
    double error;          /* of the quantity, not above this */
    const char *text;      /* constant text: the choice in words */
    peri_plan_report cost; /* as peri_plan says */
} peri_choose_report;

PERI_API void peri_choose_desc_init(peri_choose_desc *desc);

/* Fills body (precision, influence, quadrature, correction, horizon) and material (law, poisson,
   stabilization) with the best choice, from a measured table; the rest stays. body needs its space,
   material its constants. PERI_ERROR_RANGE: out of reach; the value is what is in reach. error may
   be NULL. */
PERI_API int32_t peri_choose(const peri_choose_desc *desc, peri_body_desc *body,
    peri_material_desc *material, peri_choose_report *report, peri_error *error);

#ifdef __cplusplus
}
#endif
#ifndef PERI_STATIC
#define PERI_DECLARED_EXTERN_
#endif
#endif /* PERI_H */

/* Looked at each time that this file is included. */
#if defined(PERI_STATIC) && defined(PERI_DECLARED_EXTERN_)
#error "PERI_STATIC comes too late: define it before peri.h is first included"
#elif defined(PERI_IMPLEMENTATION) && defined(__cplusplus)
#error "PERI_IMPLEMENTATION in C++: put it in a C file, or compile peri_impl.c as C and link it"
#elif defined(PERI_IMPLEMENTATION) && !defined(PERI_IMPLEMENTATION_DONE)
#include "peri_impl.c"
#endif
