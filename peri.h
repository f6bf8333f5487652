/* peri.h - peridynamics in one include: deformation and fracture of solids by nonlocal bonds.   C99, libc and libm.

   WHAT IT IS
     A body is a cloud of points. Each point has a volume and a family: the points within its horizon. Points of a family
     are joined by bonds, and the bonds carry the force. A bond that is stretched too far breaks for good; cracks are where
     bonds are broken. There is no mesh and no crack-tracking. The equations are those of

       [T]  the thesis on bond- and state-based peridynamics (BBP/SBP): equations 1.20-1.102, 2.10-2.14, 4.9-4.14, section 3.3.1
       [L]  the lecture on the PMB algorithm (force, damage, central difference)
       [P]  Seleson, Pasetto, John, Trageser, Reeve: PDMATLAB2D (2D kernels, exact partial areas, appendices A-G)
       [C]  Queiruga, Moridis 2017, the convergence study (its three state-based laws; influence functions of its table 2)

   HOW TO BUILD, any one of
       cc -O2 -c peri_impl.c             once (up to a minute of gcc), and link peri_impl.o; every other file only includes peri.h
       #define PERI_IMPLEMENTATION       in exactly one C file, then  #include "peri.h": that file takes as much longer each time
                                         that it is compiled; without optimisation some 5 seconds
       #define PERI_STATIC               together with PERI_IMPLEMENTATION, in as many files as you like: private copies
     The implementation is C99 (compile it as C); the declarations are also C++11. Link with -lm. With -fopenmp the loops
     run on all cores. The single file (`make dist`) includes itself: where a compiler does not tell it its name and that is not peri.h,
     define PERI_FILE to "its_name.h". Switches for the implementation:
       PERI_KERNELS   1 plain C99, the default without optimisation; 2 the vectors of gcc and clang; 3 (default) those of x86-64, too
       PERI_NO_2D, PERI_NO_3D, PERI_NO_F64, PERI_NO_MIXED, PERI_NO_F32, PERI_NO_STATICS (all under "statics" below), PERI_NO_ADVICE
                      (peri_plan, peri_choose), PERI_NO_OUTPUT (VTU, CSV) leave out what a scene does not need; README.md says what each
                      saves. What is left out answers PERI_ERROR_LEFT_OUT, and the field of the error names the switch
       PERI_NO_STDIO (no FILE helpers), PERI_NO_OPENMP, PERI_API (your own linkage)

   STEP BY STEP
     1  peri_body_desc d;  peri_body_desc_init(&d);  d.space = PERI_PLANE_STRESS;  d.horizon = 1e-3;
        peri_body_create(&d, &body, &error);
     2  peri_material m;  peri_material_init(&m, PERI_BOND_BASED);  m.young = 72e9;  m.density = 2440;
        glass = peri_add_material(body, &m);
     3  peri_add_box(body, glass, lo, hi, spacing);            points, as many calls as the shape needs
     4  peri_build(body);                                      families, weights, constants: the points are now fixed
     5  peri_cut_segment, peri_select_box, peri_apply_traction, peri_prescribe_velocity, ...
     6  peri_run r;  peri_run_init(&r);  r.duration = 43e-6;   peri_advance(body, &r);      in time, as often as you like; or
        peri_statics s;  peri_statics_init(&s);   peri_solve(body, &s, NULL);               the equilibrium, by load steps
     7  peri_read(body, PERI_DAMAGE, buffer, capacity);  peri_save_vtu(body, "out.vtu");
     8  peri_reset(body) for the next case of a sweep, peri_clone for an independent copy, peri_body_destroy at the end.

   CONVENTIONS
     Units    Any consistent set. [L] length, [M] mass, [T] time; [M L^-1 T^-2] is a stress or a modulus. Inside, lengths are
              scaled by the spacing and stresses by Young's modulus, so nanometres in single precision are as good as metres.
              Where a product of units (energy, time, momentum, ...) leaves 1e-250..1e250 peri_build refuses: PERI_ERROR_RANGE.
              So it does where materials of one body differ in E by 1e25 in single and mixed precision, in density in single.
     Arrays   Per-point vectors are interleaved: x0 y0 x1 y1 ... in 2D, x0 y0 z0 x1 ... in 3D ("[points*dim]").
              `const double *p` for one place or one vector has dim entries. All of the API speaks double.
     Planes   In PERI_PLANE_STRESS and PERI_PLANE_STRAIN a point's "volume" is its area [L^2], and the "area" of a loaded
              edge is its length [L]; energies and forces include the thickness of the descriptor.
     Points   are numbered from 0 in the order in which you added them. Boxes number x fastest, then y, then z.
     Results  Functions return an int32_t (or int64_t) that is >= 0 on success: PERI_OK, or an id or count where it says so.
              Negative values are PERI_ERROR_*; peri_last_error tells the field, the first offending point and a limit
              (functions on a const body only return the code).
              A call that fails has changed nothing, unless its text says otherwise. An id that came from a failed call is
              negative and is refused by the next call, so a chain of set-up calls cannot go silently wrong.
     Enums    end in a PERI_..._COUNT_, one beyond the last number, which is not for you: it grows with the enum.
     Owner    You own what you pass in: descriptors and arrays are copied. The body owns what views point to.
     Callbacks may read the body (within a step, forces and velocities are those under way). on_frame may also cut, select,
              set no-fail zones and break callbacks, and add or remove loads and obstacles. Any other change to the body
              that made the call is refused with PERI_ERROR_ORDER; destroying it is ignored.
     Threads  One body: one thread at a time. Different bodies, clones included: any threads at once (your hooks, which clones
              share, must then bear it). Callbacks run on the thread that made the call, one at a time (exception: the tasks
              that you are given in parallel_for).
     Same bits for any number of threads: each point sums its own bonds in a fixed order, and totals are summed over
              fixed blocks in a fixed order.
     Floats   IEEE 754, in any rounding mode (rounding up or down is not the same from both ends: a bond within rounding of its limit
              may then break at one end before the other). Nothing depends on denormals. gcc and clang leave -ffast-math out of
              the library, whatever your flags (but clang's fuses products into sums and estimates square roots all the same: for the
              same bits on all vectors add -ffp-contract=off -mrecip=none). 32-bit x86 without SSE2: compile with -std=c99 or
              -fexcess-precision=standard.

   WHAT IT DOES NOT DO
     It does not print, exit, assert on your data, keep global state, read files, or touch the locale or, but in peri_plan where it
     is asked to measure, the clock.
     No contact between parts of a body (rigid obstacles only), no heat, no plasticity, no adaptive horizon.

   The trades between speed and accuracy are the model of the material and fields of peri_body_desc: precision, geometry, horizon
   over spacing, quadrature, influence function and correction. Each says there what it costs. */

#ifndef PERI_H
#define PERI_H

#include <stddef.h>
#include <stdint.h>

#define PERI_VERSION "0.1.0"

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

/* ---- status ------------------------------------------------------------------------------------------------------- */

/* peri_status_text says the same. */
typedef enum peri_status {
    PERI_STOPPED           =   1, /* a callback asked to stop; the body is at a whole step and may go on */
    PERI_OK                =   0, /* success */
    PERI_ERROR_ARGUMENT    =  -1, /* a required pointer is NULL, or a count or a choice is not one of the allowed values */
    PERI_ERROR_DESCRIPTOR  =  -2, /* the descriptor was not filled by its init function, or is of another version */
    PERI_ERROR_MEMORY      =  -3, /* the allocator returned NULL */
    PERI_ERROR_RANGE       =  -4, /* a number is not finite or lies outside the range of its field */
    PERI_ERROR_ORDER       =  -5, /* this call comes too early or too late: points before peri_build, all else after it */
    PERI_ERROR_MATERIAL    =  -6, /* no such material, or a material that contradicts itself */
    PERI_ERROR_POISSON     =  -7, /* a bond-based material has a fixed Poisson ratio (1/4 in 3D and plane strain, 1/3
                                     in plane stress); it must be */
    PERI_ERROR_INFLUENCE   =  -8, /* the influence function is not finite here, or has no finite moments to calibrate with */
    PERI_ERROR_POINT       =  -9, /* a point has a position that is not finite, or a volume that is not positive and finite */
    PERI_ERROR_COINCIDENT  = -10, /* two points are at the same place */
    PERI_ERROR_NO_POINTS   = -11, /* the body, or the shape just added, has no point */
    PERI_ERROR_HORIZON     = -12, /* the horizon is smaller than the spacing of the points */
    PERI_ERROR_FAMILY      = -13, /* a point has no neighbour within its horizon, or none with a weight */
    PERI_ERROR_IBOND       = -14, /* the given families are not valid: id out of range, given twice, or not mutual */
    PERI_ERROR_TOO_LARGE   = -15, /* more points or bonds than 32-bit ids can number, or more than the memory can address */
    PERI_ERROR_SET         = -16, /* no such set, a name that is taken, or a selection that holds no point */
    PERI_ERROR_ID          = -17, /* no such point, load or obstacle */
    PERI_ERROR_CRACK       = -18, /* the crack has no extent, or is of a kind that this space does not have */
    PERI_ERROR_PAIR        = -19, /* the two points share no bond */
    PERI_ERROR_STEP        = -20, /* the time step is larger than the stable step, which is the value */
    PERI_ERROR_UNSTABLE    = -21, /* a point is faster than 1e9 speeds of sound or not finite: unstable step, load or start */
    PERI_ERROR_CALLBACK    = -22, /* a callback wrote a number that is not finite */
    PERI_ERROR_FIELD       = -23, /* the field cannot be used in this way: not stored, or not writable */
    PERI_ERROR_CAPACITY    = -24, /* the buffer has the wrong size; it needs the value */
    PERI_ERROR_WRITE       = -25, /* the file could not be opened or written, or the write callback failed */
    PERI_ERROR_CRITERION   = -26, /* the failure criterion cannot act on this model, or lacks its fracture energy */
    PERI_ERROR_MODEL       = -27, /* this model has no such constant, or cannot take this quadrature, interface or load */
    PERI_ERROR_LOOSE       = -28, /* no support holds this part of the body against some motion */
    PERI_ERROR_INDEFINITE  = -29, /* the tangent stiffness is not positive: buckling, softening or compression */
    PERI_ERROR_CONVERGENCE = -30, /* no equilibrium within the iterations allowed; the value is the residual over its scale */
    PERI_ERROR_LEFT_OUT    = -31, /* left out of this build, by the switch that the field names */
    PERI_STATUS_COUNT_     =  33  /* how many there are */
} peri_status;

typedef struct peri_error {
    int32_t     code;     /* a peri_status                                                                              */
    int32_t     reserved; /* 0                                                                                          */
    int64_t     index;    /* the first offending point, entry of an array argument, or id; -1 where there is none       */
    double      value;    /* the offending value, or the limit that was passed (see the text); 0 where there is none    */
    const char *field;    /* constant text: the descriptor field or argument at fault, "" where there is none           */
    const char *text;     /* constant text: what is wrong                                                               */
} peri_error;

/* Constant text of a status; "unknown status" for other numbers. Never NULL. */
PERI_API const char *peri_status_text(int32_t status);

/* Writes "text: field index i, value v" of an error, zero-terminated, truncated to capacity bytes. Returns the length that
   the full text needs without its zero, or PERI_ERROR_ARGUMENT. buffer may be NULL where capacity is 0. */
PERI_API int64_t peri_error_format(const peri_error *error, char *buffer, int64_t capacity);

/* ---- hooks -------------------------------------------------------------------------------------------------------- */

/* Memory. Both functions or neither. release gets the size that allocate was asked for. Any alignment will do. Neither may call the
   library for a body that uses it. */
typedef void *(*peri_allocate_fn)(void *user, uint64_t bytes);
typedef void (*peri_release_fn)(void *user, void *pointer, uint64_t bytes);

/* Your job system: call task(context, k) once for every k in [0, count), in any order, on any threads, and return when
   all are done. Without it the loops run under OpenMP where the compiler has it on, else serially. Results do not depend
   on the choice, to the last bit. It may not read the body: what it would use is in use. */
typedef void (*peri_task_fn)(void *context, int64_t k);
typedef void (*peri_parallel_for_fn)(void *user, int64_t count, peri_task_fn task, void *context);

/* Remarks that are no errors (level 0 information, 1 warning), such as a time step that was forced. */
typedef void (*peri_log_fn)(void *user, int32_t level, const char *text);

/* Influence function w(q), q = |xi|/horizon > 0, dimensionless and finite, sizes above 1e100 being taken as infinite and below 1e-100
   as 0; with partial volumes also a little beyond q = 1, for cells whose centre lies outside. Called by peri_build, peri_plan and
   peri_read_bond_constants only. Negative values are accepted, but only a non-negative w gives a stable solid. Sums of w over a family
   beyond 1e100 or below 1e-100 are refused, in mixed and single precision beyond 1e32 or below 1e-32. */
typedef double (*peri_influence_fn)(void *user, double q);

/* Nonzero takes the point at x[dim], zero leaves it out. index numbers the candidates (lattice sites or points). */
typedef int32_t (*peri_point_fn)(void *user, int64_t index, const double *x);

/* Nonzero cuts the bond between points i < j at xi[dim] and xj[dim]. */
typedef int32_t (*peri_pair_fn)(void *user, int32_t i, int32_t j, const double *xi, const double *xj);

/* Values of a load or support at `time` on the points[count] of its set. value[count*dim] holds the constant value at entry;
   overwrite what varies. Called once per step, for the time at its end; loads and velocities also at the start of a run. In peri_solve
   time is the load factor, and calls may repeat. */
typedef void (*peri_load_fn)(void *user, double time, int64_t count, const int32_t *points, double *value);

/* Where a moving obstacle is: write its reference place (peri_add_ball_obstacle: the centre) at `time` to place[dim]. */
typedef void (*peri_motion_fn)(void *user, double time, double *place);

/* Takes the next `count` bytes of a file; nonzero = failed. */
typedef int32_t (*peri_write_fn)(void *user, const void *bytes, int64_t count);

/* ---- body --------------------------------------------------------------------------------------------------------- */

typedef struct peri_body peri_body; /* opaque: points, families, materials, state, loads                                */

typedef enum peri_space {
    PERI_PLANE_STRESS = 1, /* 2D, thin plate, Poisson ratio 1/3 when bond-based                                         */
    PERI_PLANE_STRAIN = 2, /* 2D, long prism, Poisson ratio 1/4 when bond-based                                         */
    PERI_SOLID        = 3, /* 3D, Poisson ratio 1/4 when bond-based                                                     */
    PERI_SPACE_COUNT_
} peri_space;

typedef enum peri_type {
    PERI_F64   = 1,
    PERI_F32   = 2,
    PERI_I32   = 3, /* of views                                                                                         */
    PERI_MIXED = 4, /* of bodies                                                                                        */
    PERI_TYPE_COUNT_
} peri_type;

typedef enum peri_geometry {
    PERI_NONLINEAR = 1, /* extension e = |xi+eta| - |xi|, force along xi+eta: any rotation, any stretch  ([T] 1.23)     */
    PERI_LINEAR    = 2, /* e = xi.eta/|xi|, force along xi: small displacements, no square root           ([T] 1.37)     */
    PERI_GEOMETRY_COUNT_
} peri_geometry;

/* Influence functions w(q), q = |xi|/horizon. The first column of values counts for |xi| <= horizon; `beyond` is the value
   for partial cells whose centre lies just outside. Constant factors cancel in every law, so all are dimensionless here. */
typedef enum peri_influence {
    PERI_INFLUENCE_CONSTANT     = 1,  /* 1, also beyond                          [P] w0, [T] constant, [C] Const         */
    PERI_INFLUENCE_CUTOFF       = 2,  /* 1, beyond 0                             [P] w0.5                                */
    PERI_INFLUENCE_LINEAR       = 3,  /* 1 - q, beyond 0                         [P] w1, [T] conical, [C] Linear         */
    PERI_INFLUENCE_CUBIC        = 4,  /* 1 - 3q^2 + 2q^3, beyond 0               [P] w3                                  */
    PERI_INFLUENCE_QUINTIC      = 5,  /* 1 - 10q^3 + 15q^4 - 6q^5, beyond 0      [P] w5                                  */
    PERI_INFLUENCE_SEPTIC       = 6,  /* 1 - 35q^4 + 84q^5 - 70q^6 + 20q^7       [P] w7, beyond 0                        */
    PERI_INFLUENCE_POWER_2      = 7,  /* (1 - q)^2, beyond 0                     [C] Quadr                               */
    PERI_INFLUENCE_POWER_3      = 8,  /* (1 - q)^3, beyond 0                     [C] Cubic                               */
    PERI_INFLUENCE_GAUSSIAN     = 9,  /* exp(-q^2), also beyond                  [T] Gaussian                            */
    PERI_INFLUENCE_PROPORTIONAL = 10, /* q, also beyond                          [T] linear proportional                 */
    PERI_INFLUENCE_INVERSE      = 11, /* 1/q, also beyond                        [T] hyperbole, [C] Inv                  */
    PERI_INFLUENCE_INVERSE_4    = 12, /* q^-4, also beyond                       [T] power function                      */
    PERI_INFLUENCE_POLE_EDGE    = 13, /* 1/(1 + spacing/(2 horizon) - q)         [T] asymptote at horizon + spacing/2    */
    PERI_INFLUENCE_POLE_HALF    = 14, /* 1/(2q - 1), also beyond                 [T] asymptote at horizon/2              */
    PERI_INFLUENCE_POLE_QUARTER = 15, /* exp(1/(q - 1/4)), also beyond           [T] asymptote at horizon/4              */
    PERI_INFLUENCE_USER         = 16, /* influence_fn of the descriptor                                                  */
    PERI_INFLUENCE_COUNT_
} peri_influence;                     /* 12, 14, 15 are taken as having no finite moments: no bond-based constants, no s0 from G0       */

/* Quadrature: how much of a neighbour's cell counts, and from where. Cells are boxes or moved quadrilaterals where the
   library made the points, and squares or cubes of the given volume where you gave them. Weights are made mutual (the mean
   of both directions) where neighbouring cells differ, so that momentum is conserved for any cloud. */
typedef enum peri_quadrature {
    PERI_FULL_VOLUME      = 1, /* cells whose centre is within the horizon, whole.          [P] FA                       */
    PERI_VOLUME_RAMP      = 2, /* linear from 1 to 0 over horizon -+ spacing/2.             [T] Fig. 3.7                 */
    PERI_PARTIAL_VOLUME   = 3, /* exact part of the cell within the horizon, bond to the cell's centre.  [P] PA-AC; in 3D by
                                  exact areas of slices, Gauss-Legendre across them, to 1e-10 of a cell                  */
    PERI_PARTIAL_CENTROID = 4, /* 2D: same part, but bond to the centroid of the part, moved with the cell's displacement:
                                  [P] IPA-AC as printed. Not objective and not exact for affine fields: for comparison    */
    PERI_PARTIAL_MOMENT   = 5, /* 2D: same part, bond to the centre, weight scaled by |centroid bond|/|centre bond| and w taken
                                  at the centroid: the centroid rule's isotropic energy, objective                        */
    PERI_QUADRATURE_COUNT_
} peri_quadrature;

typedef enum peri_break_timing {
    PERI_BREAK_AT_STEP_END = 1, /* a bond acts to the end of the step in which it passes the critical stretch: the energy
                                   ledger closes to O(dt^2) through fracture                                             */
    PERI_BREAK_AFTER_DRIFT = 2, /* it no longer acts in that step's second half kick, as in [P]; ledger error O(dt)       */
    PERI_BREAK_TIMING_COUNT_
} peri_break_timing;

/* What makes good for the part of a family that is missing at a surface, and for the coarseness of a sum over few points.
   Without it a bond-based body is soft near its surfaces. State-based laws divide by moments of the family as it is, and so are
   calibrated point by point as they stand: LPS without correction acts like bond-based with PERI_ENERGY_CORRECTION. Costs set-up
   time; and bonds near surfaces then differ one by one, so that such bodies keep the list of families instead of columns: 12 bytes per
   bond, and with the moment correction 1.3 times the time per step in 3D, 1.5 (bond-based) to 1.8 times (LPS) in 2D. Measured, plane
   stress, horizon of 3 spacings:
                                            none   volume  energy  moment   LPS, none  LPS, moment  correspondence
     bulk energy, mean error over strains   3.8 %   2.2 %   1.4 %     0        1.5 %       0            0
     the same at faces                       22 %    17 %    17 %    13 %       12 %       0            0
     strip 8 cells thick, pulled: stiffness  0.99    1.16    1.18    1.00       1.19      0.99         1.00
     strip 4 cells thick, bent: deflection   1.52    0.99    0.96    1.38       0.97      1.39         1.02
   No correction makes both of the last rows right where parts are about one horizon thick; all converge as they get thicker, those
   that are exact in the bulk to the right value. */
typedef enum peri_correction {
    PERI_NO_CORRECTION     = 1, /* the constants of an infinite body                                                     */
    PERI_VOLUME_CORRECTION = 2, /* bond-based: each bond times 2 V0/(V_i + V_j), V0 = full, V_i = actual volume within the
                                   horizon, own cell included (Le, Bobaru 2018). For comparison. State-based: none       */
    PERI_ENERGY_CORRECTION = 3, /* bond-based: c of each point such that its own family has the energy of isotropic strain, and of
                                   shear on the mean over its directions (Madenci, Oterkus 2014); bonds take the mean of both ends.
                                   State-based: none, see above                                                          */
    PERI_MOMENT_CORRECTION = 4, /* the weights of each family changed as little as can be so that every uniform strain has the
                                   energy of the solid (after Trask et al. 2019), bond-based moduli calibrated as above: exact to
                                   rounding in the bulk; near surfaces as far as weights that are not negative allow. Where it would
                                   take factors above 10 (edges; m near 1; steep poles) it is a compromise, and the log says so;
                                   families with negative w keep their shape. Oterkus's theta has a moment of its own: exact in
                                   the bulk of lattices, to 1 % at faces                                                 */
    PERI_CORRECTION_COUNT_
} peri_correction;

/* How bonds are worked on; results agree to the rounding of sums. To check one by another, and to measure what each is worth. */
typedef enum peri_kernel {
    PERI_KERNEL_BEST      = 0, /* families of lattices packed by columns of 16 points, where that serves; else as a list */
    PERI_KERNEL_REFERENCE = 1, /* every quantity by its formula, bond by bond: slow                                      */
    PERI_KERNEL_LIST      = 2, /* the list of families, as clouds have it                                                */
    PERI_KERNEL_COUNT_
} peri_kernel;

/* Vector instructions of x86-64, the same bits from each; elsewhere kernels are plain loops, and this has no effect. */
typedef enum peri_instructions {
    PERI_BASELINE = 1, /* SSE2                                                                                           */
    PERI_AVX2     = 2,
    PERI_AVX512   = 3, /* F, VL, DQ and BW                                                                               */
    PERI_INSTRUCTIONS_COUNT_
} peri_instructions;

typedef struct peri_body_desc {
    uint64_t          cookie;           /* set by peri_body_desc_init                                                    */
    int32_t           space;            /* peri_space. Required                                                          */
    int32_t           precision;        /* PERI_F64 (default); PERI_F32: faster, 0.65 of the memory, but strains < 1e-6 lose digits,
                                           and bonds shorter than 1e-6 of the extent are refused (PERI_ERROR_COINCIDENT); or
                                           PERI_MIXED: the state as F64, bonds and their weights as F32: any strain to 7 digits;
                                           clouds take little more memory than as F32                                    */
    int32_t           geometry;         /* peri_geometry. Default PERI_NONLINEAR                                         */
    int32_t           influence;        /* peri_influence. Default PERI_INFLUENCE_CONSTANT                               */
    int32_t           quadrature;       /* peri_quadrature. Default PERI_FULL_VOLUME                                     */
    int32_t           break_timing;     /* peri_break_timing. Default PERI_BREAK_AT_STEP_END                             */
    int32_t           threads;          /* 0 = as OpenMP says (default), 1 = serial, n = n OpenMP threads. Small bodies run
                                           serially. Where other work shares the machine, waiting OpenMP threads can cost
                                           more than they give: set OMP_WAIT_POLICY=passive, or threads = 1              */
    int32_t           kernel;           /* peri_kernel. Default PERI_KERNEL_BEST                                         */
    int32_t           instructions;     /* peri_instructions, the most that kernels may use; 0 (default): what the machine has */
    int32_t           ledger;           /* 1 (default) = account for external work, damping and obstacles while running;
                                           0 = do not: peri_read_energy then gives kinetic, elastic and fracture only    */
    int32_t           correction;       /* peri_correction. Default PERI_NO_CORRECTION                                   */
    int32_t           reserved;         /* 0                                                                             */
    double            horizon;          /* [L] > 0. Required. 3 to 4 spacings is usual; cost grows as (horizon/spacing)^dim.
                                           Points nearer than this to a free face have part of a family: see correction.
                                           Comparisons have a relative tolerance of 1e-8 built in: 3*spacing means 3     */
    double            thickness;        /* [L] > 0, 2D only. Default 1                                                   */
    peri_influence_fn influence_fn;     /* for PERI_INFLUENCE_USER                                                       */
    void             *influence_user;   /* handed to influence_fn                                                        */
    peri_allocate_fn  allocate;         /* default NULL: malloc                                                          */
    peri_release_fn   release;          /* default NULL: free                                                            */
    void             *memory_user;      /* handed to allocate and release                                                */
    peri_parallel_for_fn parallel_for;  /* default NULL: OpenMP or serial                                                */
    void             *parallel_user;    /* handed to parallel_for                                                        */
    peri_log_fn       log;              /* default NULL: silent                                                          */
    void             *log_user;         /* handed to log                                                                 */
} peri_body_desc;

/* Fills every field with its default. NULL is ignored. */
PERI_API void peri_body_desc_init(peri_body_desc *desc);

/* Makes an empty body. *body is NULL on failure. error may be NULL. */
PERI_API int32_t peri_body_create(const peri_body_desc *desc, peri_body **body, peri_error *error);

/* Frees the body; NULL is ignored. Clones live on. */
PERI_API void peri_body_destroy(peri_body *body);

/* Copies the record of the body's last failed call (code PERI_OK where none failed yet). */
PERI_API int32_t peri_last_error(const peri_body *body, peri_error *error);

/* ---- materials ---------------------------------------------------------------------------------------------------- */

/* Laws. With extension e, direction M = (xi+eta)/|xi+eta| and sums over the live bonds of a family, the force density on i is
   sum_j (t_i + t_j) M V_j, each end of a bond giving its own half by its own material. Every law is the derivative of an energy, so
   momentum and energy are conserved whatever meets whatever. D = 3 in 3D, else 2.

     bond-based      t = 1/2 c w s,  s = e/|xi|                      micromodulus c of the infinite body; Poisson ratio fixed
     LPS             t = (w/m) (A theta |xi| + B e)                  m = sum w |xi|^2 V,  theta = (D/m) sum w |xi| e V
     Oterkus         t = 2 w (a d theta + b e)                       theta = d sum w e V;  a, b, d from sums over the actual family
     correspondence  T = w P K^-1 xi + k w (Y - F xi)                K = sum w xi xi V,  F = (sum w Y xi V) K^-1,  P from F

   A = 3K - 5 mu, B = 15 mu in 3D; 2 lambda - 2 mu, 8 mu in plane strain; the same with lambda' = E nu/(1-nu^2) in plane stress.
   LPS at the Poisson ratio of a bond-based material has A = 0 and skips theta. Oterkus takes the spring of LPS where a family has less
   than a fifth of the moment that calibrates shear, and never one that could make the energy negative: with constant w shear is
   softer than asked for below a Poisson ratio of -0.64 in plane stress and -0.72 in 3D (the log says so), where w is steep or the
   family of odd shape before that. Oterkus's factor Lambda (cosine of the bond's rotation)
   is taken as 1: with it the law would not be objective. Bonds that are broken or cut are in none of the sums. A correspondence point
   whose live bonds span too little (K nearly singular) acts by central bonds alone, t = B w e/m0 with m0 of the whole family. */
typedef enum peri_model {
    PERI_BOND_BASED     = 1, /* generalised prototype microelastic brittle (GPMB)                        ([P] A, [T] 1.23) */
    PERI_LPS            = 2, /* linear peridynamic solid, ordinary state-based      ([T] 1.54, 1.67, 1.72, [C] eqs. 2-7) */
    PERI_OTERKUS        = 3, /* ordinary state-based, discrete calibration                              ([C] eqs. 8-17) */
    PERI_CORRESPONDENCE = 4, /* deformation gradient: sigma = lambda tr(eps) + 2 mu eps where the geometry is linear ([C] 18-21), else
                                Saint Venant-Kirchhoff, S = lambda tr(E) + 2 mu E, objective                             */
    PERI_MODEL_COUNT_
} peri_model;

/* When a bond breaks. Only bonds that are longer than at rest break. A bond between two materials breaks when the criterion of
   either is met, at the lower limit where both have the same. */
typedef enum peri_criterion {
    PERI_CRITERION_STRETCH     = 1, /* s > s0                                                         ([T] 1.40, 1.41)     */
    PERI_CRITERION_BOND_ENERGY = 2, /* state-based: the work done on the bond, int (T_i + T_j).d eta, passes w0 = 4 G0/(pi h^4) in
                                       3D, 3 G0/(2 h^3 thickness) in 2D ([T] 1.100, 1.101), h the horizon; keeps dim + 1 numbers per
                                       bond                                                                              */
    PERI_CRITERION_NODE_ENERGY = 3, /* state-based: the mean over both ends of 2 W/(sum of beta V_j over the whole family) passes w0
                                       ([T] 1.102, made consistent in its units). Spreads damage, as the thesis finds    */
    PERI_CRITERION_COUNT_
} peri_criterion;

typedef struct peri_material {
    uint64_t cookie;           /* set by peri_material_init                                                              */
    int32_t  model;            /* peri_model                                                                             */
    int32_t  criterion;        /* peri_criterion. Default PERI_CRITERION_STRETCH                                         */
    double   young;            /* E [M L^-1 T^-2] > 0. Give E or K, not both (0 = not given)                             */
    double   bulk;             /* K = E/(3(1-2 nu)) [M L^-1 T^-2] > 0                                                    */
    double   poisson;          /* [-] in (-1, 1/2), required by state-based models. Bond-based: fixed by the space, NaN (default) =
                                  that value, others are refused                                                         */
    double   density;          /* [M L^-3] > 0. Required                                                                 */
    double   fracture_energy;  /* G0 [M T^-2] > 0, energy per area of crack. 0 (default) = not given                     */
    double   critical_stretch; /* s0 [-] > 0. 0 (default) = from G0; with neither, bonds do not break. Not both. From G0 it is the
                                  bond-based value for E; for state-based models, too ([T] 1.2.3), with w |xi| in place of w */
    double   stabilization;    /* correspondence: k m/B [-] >= 0, stiffness against zero-energy modes relative to the central bonds of
                                  LPS. Default 0.2 for PERI_CORRESPONDENCE (thin strips bend right, 0.95 to 1.02 at 4 cells); more makes
                                  short waves and thin parts stiffer. Beams are best with PERI_INFLUENCE_POWER_3 and 0.4: deflection
                                  within 0.5 % from 10 cells of thickness on; but cracks open less: by 10 % at 0.5 and a
                                  horizon of 2 spacings or more. Must be 0 for others                                    */
} peri_material;

/* Defaults for a model. NULL is ignored. */
PERI_API void peri_material_init(peri_material *material, int32_t model);

/* Adds a material, before peri_build. Returns its id (0, 1, ...; at most 120 of them) or an error. */
PERI_API int32_t peri_add_material(peri_body *body, const peri_material *material);

/* Bonds between the bond-based materials i and j behave as if of the bond-based `material` (its density is not used), before
   peri_build. Without this call their micromodulus is the harmonic mean of both and their critical stretch the smaller one. i = j is
   refused; so are state-based materials (PERI_ERROR_MODEL), whose bonds are no springs of their own: each end gives its half. */
PERI_API int32_t peri_set_interface(peri_body *body, int32_t i, int32_t j, const peri_material *material);

/* Micromodulus c [M L^-5 T^-2 per volume^2: force per volume squared] and critical stretch s0 [-] (HUGE_VAL = never) of the
   bonds between materials i and j, for an infinite body with this horizon and influence function: closed forms of [P] C.15,
   C.18, C.20 and [T] 1.24, 1.40 where they exist, else radial Gauss-Legendre quadrature. Either pointer may be NULL.
   Works before and after peri_build, except that PERI_INFLUENCE_POLE_EDGE needs the spacing and so comes after. State-based materials
   have no c: it must be NULL (else PERI_ERROR_MODEL). */
PERI_API int32_t peri_read_bond_constants(peri_body *body, int32_t i, int32_t j, double *c, double *s0);

/* Critical bond energy w0 [M L^-4 T^-2: energy per volume squared, in 2D volume = area times thickness] of a material whose criterion
   is an energy; HUGE_VAL = none. */
PERI_API int32_t peri_read_critical_energy(peri_body *body, int32_t material, double *w0);

/* ---- points, before peri_build ------------------------------------------------------------------------------------ */

/* Fills the box lo[dim]..hi[dim] with cells of about `spacing` [L]: round((hi-lo)/spacing) per axis, at least one, so that the
   cells tile the box exactly; points at cell centres. Returns the number of points added, or an error. */
PERI_API int64_t peri_add_box(peri_body *body, int32_t material, const double *lo, const double *hi, double spacing);

/* A ball (in 2D a disc): the lattice cells whose centre is within `radius` of `centre`. Otherwise as peri_add_box. */
PERI_API int64_t peri_add_ball(peri_body *body, int32_t material, const double *centre, double radius, double spacing);

/* The lattice cells of the box whose centre `inside` takes. Otherwise as peri_add_box. */
PERI_API int64_t peri_add_shape(peri_body *body, int32_t material, const double *lo, const double *hi, double spacing,
                                peri_point_fn inside, void *user);

/* peri_add_box with each interior vertex of the cells moved by up to `amount` quarters of a cell per axis ([P] appendix B),
   0 <= amount <= 1, from a fixed generator started with seed; points are the centroids of the moved cells, volumes theirs. */
PERI_API int64_t peri_add_perturbed_box(peri_body *body, int32_t material, const double *lo, const double *hi, double spacing,
                                        double amount, uint64_t seed);

/* Your own points: positions[count*dim] [L], volumes[count] [L^3] (2D: areas [L^2]), materials[count] or NULL for material 0. */
PERI_API int64_t peri_add_points(peri_body *body, int64_t count, const double *positions, const double *volumes,
                                 const int32_t *materials);

/* Your own families instead of a search: ibond[points*width] as in [T] 3.11: row i lists the neighbours of i and is padded
   with i itself. Membership must be mutual. Weights are computed as for found families. */
PERI_API int32_t peri_set_families(peri_body *body, int32_t width, const int32_t *ibond);

/* Finds the families (cell grid, O(N)), computes weights and constants, and allocates the state. Nothing may be added
   afterwards. On failure the body is as it was: add what is missing and build again. */
PERI_API int32_t peri_build(peri_body *body);

/* ---- the built body ----------------------------------------------------------------------------------------------- */

PERI_API int32_t peri_dimension(const peri_body *body);      /* 2 or 3                                                   */
PERI_API int64_t peri_point_count(const peri_body *body);    /* points                                                   */
PERI_API int32_t peri_family_width(const peri_body *body);   /* M: the size of the largest family; 0 before peri_build   */
PERI_API int64_t peri_bond_count(const peri_body *body);     /* entries (i,j) of all families: twice the number of bonds */
PERI_API int64_t peri_cut_count(const peri_body *body);      /* bonds (pairs) cut before the first step                  */
PERI_API int64_t peri_broken_count(const peri_body *body);   /* bonds (pairs) broken by a criterion, or cut, since then  */
PERI_API int64_t peri_step_count(const peri_body *body);     /* steps and load steps since build or reset                */
PERI_API double  peri_time(const peri_body *body);           /* [T] since build or reset                                 */

/* How the bonds are worked on: "columns, AVX-512", "list, SSE2", ...; "rows": one by one, which is what several models in one body, the
   energy criteria, families above 1024 bonds, and in single precision points nearer than its rounding ask for; "reference". Constant text,
   "" before peri_build. */
PERI_API const char *peri_kernel_text(const peri_body *body);

/* Largest stable time step [T], 2/sqrt(lambda) with lambda bounded by the stiffness of the actual bonds of each point
   ([T] 2.11: sqrt(2 rho / sum c V / |xi|)) and of the obstacles. Safe, not sharp: the true limit is up to 1.5 times larger, in
   small or cut bodies up to 3 times.
   Broken bonds only make a bond-based body softer. State-based laws spread the modulus over the bonds that are left, so a point that
   hangs on a few short ones is stiffer than before: for them this falls as bonds break, and never exceeds that of the whole body.
   It is that of the body as built: nonlinear correspondence that is stretched is stiffer (twice the length asks for 0.4 of the step), and
   so are bonds across their length that are squeezed to a fraction of it; the ledger's error tells, in time PERI_ERROR_UNSTABLE.
   0 before peri_build. */
PERI_API double peri_stable_step(const peri_body *body);

/* Rows [first, first+count) of the N x M family array ([T] 3.11) to rows[count*width]: ascending ids, padded with the
   row's own id. capacity counts entries. Broken and cut bonds are listed too: see peri_bond_is_intact. */
PERI_API int32_t peri_read_families(peri_body *body, int64_t first, int64_t count, int32_t *rows, int64_t capacity);

/* 1 = bond (i,j) carries force, 0 = broken or cut, PERI_ERROR_PAIR = no such bond. */
PERI_API int32_t peri_bond_is_intact(peri_body *body, int32_t i, int32_t j);

/* Back to the reference state: displacement, velocity, time, steps and ledger zero, bonds broken or cut since the first
   step whole again. Cracks cut before the first step, sets, loads, obstacles and no-fail zones stay. */
PERI_API int32_t peri_reset(peri_body *body);

/* An independent copy of a built body, state and loads included; points, families and weights are shared (and counted).
   error may be NULL. The copy uses the same hooks. */
PERI_API int32_t peri_clone(const peri_body *body, peri_body **copy, peri_error *error);

/* ---- sets --------------------------------------------------------------------------------------------------------- */

#define PERI_ALL 0 /* the set of all points                                                                              */

/* Each returns the set's id (1, 2, ...) or an error; an empty selection is an error. name (copied) may be NULL.
   Box and ball include their boundary to 1e-9 of a spacing. */
PERI_API int32_t peri_select_box(peri_body *body, const char *name, const double *lo, const double *hi);
PERI_API int32_t peri_select_ball(peri_body *body, const char *name, const double *centre, double radius);
PERI_API int32_t peri_select_if(peri_body *body, const char *name, peri_point_fn take, void *user);
PERI_API int32_t peri_select_points(peri_body *body, const char *name, int64_t count, const int32_t *points);

PERI_API int32_t peri_find_set(const peri_body *body, const char *name);  /* id, or PERI_ERROR_SET                       */
PERI_API int64_t peri_set_size(const peri_body *body, int32_t set);       /* points in the set, or an error              */
PERI_API int32_t peri_read_set(peri_body *body, int32_t set, int32_t *points, int64_t capacity); /* ascending ids        */

/* ---- cracks and failure ------------------------------------------------------------------------------------------- */

/* Cut every bond whose straight line from point to point meets the crack; touching counts, collinear counts (tolerance
   1e-9 of the spacing; in single precision also the rounding of coordinates, 6e-8 of the body's extent). So a crack that ends on the line
   of a column of bonds acts half a spacing longer than one that ends a hair before it. Return the number of bonds (pairs) newly cut: 0
   where the crack misses (and a remark in the log). Made before the first step they are the initial crack and survive peri_reset;
   later they count as broken. */
PERI_API int64_t peri_cut_segment(peri_body *body, const double *from, const double *to);                    /* 2D        */
PERI_API int64_t peri_cut_polyline(peri_body *body, int64_t count, const double *vertices);                 /* 2D        */
PERI_API int64_t peri_cut_disc(peri_body *body, const double *centre, const double *normal, double radius); /* 3D        */
PERI_API int64_t peri_cut_triangle(peri_body *body, const double *p, const double *q, const double *r);     /* 3D        */
PERI_API int64_t peri_cut_rectangle(peri_body *body, const double *corner, const double *edge1,
                                    const double *edge2);                      /* 3D, any parallelogram                  */
PERI_API int64_t peri_cut_pairs(peri_body *body, int64_t count, const int32_t *pairs); /* pairs[2*count]; each must be a bond */
PERI_API int64_t peri_cut_if(peri_body *body, peri_pair_fn cut, void *user);

/* Bonds with an end in the set never break by a criterion (on = 1) or may again (on = 0). Cuts still cut them. */
PERI_API int32_t peri_set_no_fail(peri_body *body, int32_t set, int32_t on);

/* Called for every bond that breaks by its criterion: i < j, the time [T] and the stretch at which it broke. Called after the
   step in ascending (i, j); it may read the body but not change it. NULL removes. Costs one bit per bond. */
typedef void (*peri_break_fn)(void *user, int32_t i, int32_t j, double time, double stretch);
PERI_API int32_t peri_on_break(peri_body *body, peri_break_fn fn, void *user);

/* ---- initial state, supports, loads, obstacles -------------------------------------------------------------------- */

#define PERI_X 1
#define PERI_Y 2
#define PERI_Z 4

/* Add the constant vector value[dim] to the displacement [L] / velocity [L T^-1] of a set, now; peri_reset clears both. PERI_ERROR_RANGE,
   as by peri_write, beyond 1e15 spacings (1e11 of nonlinear correspondence in mixed and single precision) and 1e9 speeds of sound. */
PERI_API int32_t peri_add_displacement(peri_body *body, int32_t set, const double *value);
PERI_API int32_t peri_add_velocity(peri_body *body, int32_t set, const double *value);

/* Supports: prescribe the components in `axes` (PERI_X | PERI_Y | PERI_Z) of the displacement [L] or velocity [L T^-1] of a
   set, constant value[dim] (NULL = zero) or as fn says; fn may be NULL. Later supports win where they overlap. The velocity of a
   point with prescribed displacement is the mean of the last step. Each returns a load id (0, 1, ...) or an error. A grip should be a
   horizon deep, of state-based materials two: their points feel what moves two horizons away. */
PERI_API int32_t peri_prescribe_displacement(peri_body *body, int32_t set, int32_t axes, const double *value, peri_load_fn fn,
                                             void *user);
PERI_API int32_t peri_prescribe_velocity(peri_body *body, int32_t set, int32_t axes, const double *value, peri_load_fn fn,
                                         void *user);

/* Body force density value[dim] [M L^-2 T^-2] (gravity: density times g) on a set. Returns a load id or an error. */
PERI_API int32_t peri_apply_body_force(peri_body *body, int32_t set, const double *value, peri_load_fn fn, void *user);

/* Traction value[dim] [M L^-1 T^-2] on a face of `area` [L^2] (2D: edge length [L]), spread over the set's points by volume: the
   total force is value*area (in 2D times the thickness) exactly. The usual choice is the outermost layer; near the face it is
   wrong by O(1) ([C] 2.5). */
PERI_API int32_t peri_apply_traction(peri_body *body, int32_t set, double area, const double *value, peri_load_fn fn,
                                     void *user);

/* Takes a load or support away again. Ids of the others stay, and ids are not used twice. */
PERI_API int32_t peri_remove_load(peri_body *body, int32_t load);

/* Force [M L T^-2] to force[dim]: of a support on the body (its prescribed components), mean of the last step, so that reactions
   times steps add up to the momentum given, or of the equilibrium; of a load, its present total. */
PERI_API int32_t peri_read_reaction(peri_body *body, int32_t load, double *force);

/* Rigid obstacles, by penalty: a point that is `depth` inside is pushed out along the normal with a force density of
   stiffness*depth [M L^-2 T^-2]; stiffness [M L^-3 T^-2] 0 = young/spacing^2 of the stiffest material. They lower the stable
   step a little. Half-space: solid on the side away from `normal`. `motion` (or NULL: at rest) moves it. Each returns an
   obstacle id or an error. */
PERI_API int32_t peri_add_plane_obstacle(peri_body *body, const double *place, const double *normal, double stiffness,
                                         peri_motion_fn motion, void *user);
PERI_API int32_t peri_add_ball_obstacle(peri_body *body, const double *centre, double radius, double stiffness,
                                        peri_motion_fn motion, void *user);

PERI_API int32_t peri_remove_obstacle(peri_body *body, int32_t obstacle); /* ids of the others stay                       */

/* Force [M L T^-2] of the obstacle on the body at the present time, to force[dim]. */
PERI_API int32_t peri_read_obstacle_force(peri_body *body, int32_t obstacle, double *force);

/* ---- explicit dynamics -------------------------------------------------------------------------------------------- */

typedef enum peri_integrator {
    PERI_VELOCITY_VERLET    = 1, /* [T] 2.2: half kick, drift, force, half kick                                          */
    PERI_CENTRAL_DIFFERENCE = 2, /* [L], [T] 2.10: u(t+dt) = 2u(t) - u(t-dt) + dt^2 a, summed as velocities at half steps
                                    so that no digits cancel: one kick per step, same motion                             */
    PERI_INTEGRATOR_COUNT_
} peri_integrator;

/* Called every frame_steps steps and at the end of the run. Nonzero stops: peri_advance returns PERI_STOPPED. It may read the
   body, write files, cut, and add or remove loads, but not advance, reset or destroy it. */
typedef int32_t (*peri_frame_fn)(void *user, peri_body *body);

typedef struct peri_run {
    uint64_t      cookie;       /* set by peri_run_init                                                                  */
    int32_t       integrator;   /* peri_integrator. Default PERI_VELOCITY_VERLET                                         */
    int32_t       force_step;   /* 1 = take time_step even if it is larger than peri_stable_step. Default 0: refused     */
    int64_t       steps;        /* run this many steps; or                                                               */
    double        duration;     /* [T] run this long; the last two steps are shortened alike to end exactly there. One of the two is
                                   required: both default to 0                                                           */
    double        time_step;    /* [T] > 0; 0 (default) = safety * peri_stable_step, made shorter where broken bonds shorten that */
    double        safety;       /* (0, 1]. Default 0.9                                                                   */
    double        damping;      /* a [T^-1] >= 0: force -a*density*velocity on every point; a*time_step <= 2. Default 0  */
    int64_t       frame_steps;  /* steps between calls of on_frame; 0 (default) = only at the end                        */
    peri_frame_fn on_frame;     /* default NULL                                                                          */
    void         *user;         /* handed to on_frame                                                                    */
} peri_run;

/* Fills every field with its default. NULL is ignored. */
PERI_API void peri_run_init(peri_run *run);

/* Advances the body in time. On PERI_ERROR_STEP nothing has moved and error.value is the largest step. On
   PERI_ERROR_UNSTABLE and PERI_ERROR_CALLBACK (error.index: the point) it stopped within a step: read it, then reset or destroy it.
   An obstacle that on_frame added, or state-based bonds that broke, may make a given time_step too large: this ends the run with
   PERI_ERROR_STEP, at a whole step; error.value is what may follow. */
PERI_API int32_t peri_advance(peri_body *body, const peri_run *run);

/* ---- statics ------------------------------------------------------------------------------------------------------ */

/* The equilibrium of the body under its supports and loads. Constant values of loads and supports count times a load factor, that goes from
   load_from to load_to in steps; callbacks are asked for their values at time = load factor. Prescribed velocities hold a point where
   it is. At each factor the equations  internal force(u) + loads = 0  on what is not supported are solved by Newton's method: each
   iteration by conjugate gradients on the tangent, which is applied without being stored, then a line search. Where the geometry is
   linear and there are no obstacles the first iteration ends it. Converged: |residual| <= tolerance * the larger of |loads| and
   |reactions|, as vectors of point forces. Then bonds over their limit break, and equilibrium is sought again, until none does. Slow cracks
   are trapped between the rows of a lattice: a bond-based one took 1.56, 1.29, 1.12 times the energy G0 at 3, 4, 6 spacings to the horizon.
   Starts from the present displacements, so a solve whose first step ran out of iterations goes on where it stopped when called again
   (nonlinear: with halvings = 0). In single precision the residual cannot fall much below 1e-5, of slender bodies 5e-3, in mixed precision
   below 1e-7 and 1e-6: a tolerance out of reach ends with PERI_ERROR_CONVERGENCE at the best that there is. Where nothing acts (a body
   turned rigidly) rounding is good enough; forces below 1e-140 (single and mixed precision: 1e-42) of Young's modulus times a face of a
   cell are nothing. */
typedef enum peri_method {
    PERI_NEWTON     = 1, /* Newton with conjugate gradients: the default                                                 */
    PERI_BICGSTAB   = 2, /* Newton with BiCGSTAB on the assembled tangent ([T] 3.2, 3.3): small bodies, for comparison   */
    PERI_RELAXATION = 3, /* adaptive dynamic relaxation (Kilic, Madenci 2010): slow, asks for forces only; goes on where a tangent
                            is not positive                                                                              */
    PERI_METHOD_COUNT_
} peri_method;

typedef enum peri_preconditioner {
    PERI_MULTILEVEL        = 1, /* blocks of the diagonal, and linear elasticity on a background grid of about a horizon with all its
                                   coarser grids: iterations hardly grow with the number of points, by about 1.4 per halving of the
                                   spacing where there are long cracks. The default                                      */
    PERI_BLOCK_JACOBI      = 2, /* the dim x dim blocks of the diagonal                                                  */
    PERI_NO_PRECONDITIONER = 3,
    PERI_PRECONDITIONER_COUNT_
} peri_preconditioner;

/* What becomes of parts that no support holds against some rigid motion, and of points whose bonds resist only in some directions. */
typedef enum peri_loose {
    PERI_LOOSE_REFUSED  = 1, /* PERI_ERROR_LOOSE, index = the first point. The default. Hinges (parts joined at one point) are found by
                                the solver, whatever is chosen here; index is then a point that they let move            */
    PERI_LOOSE_PINNED   = 2, /* just enough components of points are held to stop the rigid motions; exact where loads balance */
    PERI_LOOSE_BALANCED = 3, /* the part of the loads that would drive the motion is left out (spread by mass, as inertia would); the
                                motion itself stays as it was                                                            */
    PERI_LOOSE_COUNT_
} peri_loose; /* points whose bonds span less than the space: the force on what is not resisted is left out by the last two */

/* Called after each iteration of the linear solver with the residual over its scale; nonzero stops: PERI_STOPPED, on the way to an
   equilibrium (linear: with what the linear solver had found; else where the last Newton iteration left it). */
typedef int32_t (*peri_iteration_fn)(void *user, int64_t iteration, double residual);

typedef struct peri_statics {
    uint64_t          cookie;         /* set by peri_statics_init                                                        */
    int32_t           method;         /* peri_method. Default PERI_NEWTON                                                */
    int32_t           preconditioner; /* peri_preconditioner, of PERI_NEWTON. Default PERI_MULTILEVEL                    */
    int32_t           loose;          /* peri_loose. Default PERI_LOOSE_REFUSED                                          */
    int32_t           fracture;       /* 1 (default) = bonds break by their criterion, 0 = none breaks                   */
    double            criticality;    /* [0, 1]: of the bonds over their limit those break that are over criticality times the largest
                                         excess (value/limit): 0 (default) = all, 1 = only the most critical (and its equals)   */
    double            tolerance;      /* [0, 1): 0 (default) = 1e-8, in mixed precision 1e-5, in single 1e-4              */
    double            energy_tolerance; /* > 0, PERI_NEWTON: converged also when the residual in the norm of the preconditioner has
                                         fallen by this factor, an estimate of the error in energy. Default 0: never     */
    int64_t           iterations;     /* most iterations of the linear solver (of PERI_RELAXATION: steps) for one equilibrium.
                                         Default 20000                                                                   */
    int64_t           newton;         /* most Newton iterations for one equilibrium. Default 60                          */
    int64_t           breaks;         /* most rounds of breaking at one load factor. Default 100000; then PERI_ERROR_CONVERGENCE */
    double            load_from;      /* load factor at which the body stands now, say load_to of the last solve. Default 0 */
    double            load_to;        /* load factor at the end. Default 1                                               */
    int64_t           steps;          /* load steps >= 1. A step without equilibrium is halved, then grows again. Default 1 */
    int64_t           halvings;       /* most halvings of a step, 0..60. Default 8; PERI_ERROR_CONVERGENCE, ... beyond      */
    int32_t           curve_load;     /* load or support whose curve is recorded. Default -1: none                       */
    int32_t           reserved;       /* 0                                                                               */
    double           *curve;          /* [curve_rows][2 + 2*dim]: load factor, mean displacement of its set (dim) [L], force as by
                                         peri_read_reaction (dim) [M L T^-2], broken bonds. Yours                        */
    int64_t           curve_rows;     /* rows that fit; those beyond are counted in the report but not written            */
    peri_iteration_fn on_iteration;   /* default NULL                                                                    */
    peri_frame_fn     on_step;        /* called at each equilibrium, after breaking; nonzero stops. May do what on_frame may. Default
                                         NULL                                                                            */
    void             *user;           /* handed to both                                                                  */
} peri_statics;

typedef struct peri_statics_report {
    int64_t iterations;   /* of the linear solver, or relaxation steps, in all                                           */
    int64_t passes;       /* evaluations of all bonds: forces and products with the tangent                              */
    int64_t newton;       /* Newton iterations in all                                                                    */
    int64_t steps;        /* load steps done                                                                             */
    int64_t broken;       /* bonds (pairs) broken                                                                        */
    int64_t curve_rows;   /* rows of the curve, written or not                                                           */
    int64_t loose;        /* rigid motions that were pinned or balanced in the last equilibrium                          */
    int64_t bytes;        /* most memory that the solver took at a time, beside the body                                 */
    double  residual;     /* of the last equilibrium, over its scale; 0 where nothing acts                               */
    double  load_factor;  /* of the last equilibrium                                                                     */
} peri_statics_report;

/* Fills every field with its default. NULL is ignored. */
PERI_API void peri_statics_init(peri_statics *statics);

/* Solves; report may be NULL. Velocities become zero. The ledger counts the work of loads and supports by the trapezoidal rule from each
   equilibrium to the next, those in between bonds breaking included. A step that fails leaves the body at the equilibrium before it; where
   there is none in this call, and after bonds have broken in it, as far as it came. PERI_ERROR_LOOSE, PERI_ERROR_INDEFINITE (buckling or
   softening: the tangent has a negative direction, and no equilibrium was found further down; directions that nothing excites are not
   looked for: a perfect strut stays straight until something pushes it aside), PERI_ERROR_CONVERGENCE (value: residual
   reached), PERI_ERROR_RANGE (all loads over E, and ways of supports over the spacing, are below 1e-132, in mixed precision 1e-37, in
   single 1e-38, which cannot be told from rest), PERI_ERROR_CALLBACK. Loads stay at the last factor, and callbacks are asked for it, when
   forces are read; peri_advance takes them at 1, and at its time, again. */
PERI_API int32_t peri_solve(peri_body *body, const peri_statics *statics, peri_statics_report *report);

/* Tractions that pass the patch test: value[dim] [M L^-1 T^-2] on a face of `area` and outward `normal`, given to all points that feel the
   face: the set should hold them, to a depth of two horizons, and reach to no other face of opposite normal. Of correspondence, point i
   gets value (normal.a_i) with the area vector of its live family a_i = sum_j V_j g_ji - V_i sum_j g_ij, g_ij = w K_i^-1 xi V_j: uniform
   stress is then exact, whatever the horizon and influence function; on clouds, where a_i vanishes nowhere, if the sets of opposite faces
   together hold all points. Of the other laws, each component along an axis t of the face is shared as the bonds' force along t under
   the stress t x normal + normal x t, scaled to the total value*area: no exact form is known, and strain is off near edges and by
   O(horizon) inside.
   fn may vary the traction over the points: their total force is as given, their moment off by O(horizon). Taken at the call, for small
   displacements: cracks made later do not change it. Returns a load id or an error; PERI_ERROR_SET where the
   points feel much less or more than the area (value: what they feel), PERI_ERROR_MODEL where the set has several materials. */
PERI_API int32_t peri_apply_surface_traction(peri_body *body, int32_t set, double area, const double *normal, const double *value,
                                             peri_load_fn fn, void *user);

/* Pressure [M L^-1 T^-2] on all surfaces of a set, outer faces and faces of cracks alike ([C] 2.6): -pressure a_i. So for a crack select
   the points within two horizons of it. fn: value[k*dim] is the pressure on point k. Otherwise as above. */
PERI_API int32_t peri_apply_pressure(peri_body *body, int32_t set, double pressure, peri_load_fn fn, void *user);

/* The same through the cut bonds between neighbouring points, as [C] 2.6 does: each cut bond between two points of the set no further apart
   than 1.2 spacings gives both `pressure` times the face of a cell, along the bond. For comparison. */
PERI_API int32_t peri_apply_bond_pressure(peri_body *body, int32_t set, double pressure, peri_load_fn fn, void *user);

/* out = K in, the tangent stiffness at the present displacement times in[count], count = points*dim: forces [M L T^-2] of displacements
   [L]. Supports and obstacles are not in it. out may be in. The first call takes memory for what products work on (peri_memory.state),
   which stays with the body. */
PERI_API int32_t peri_multiply_stiffness(peri_body *body, const double *in, double *out, int64_t count);

/* The same stiffness as a matrix ([T] 3.2, 3.3), compressed by rows, rows and columns points*dim, every entry of a coupled pair of points
   stored: point couples with those two horizons away. Lives on its own; free it with peri_matrix_destroy. */
typedef struct peri_matrix peri_matrix;
PERI_API int32_t peri_assemble(peri_body *body, peri_matrix **matrix);
PERI_API void    peri_matrix_destroy(peri_matrix *matrix);
PERI_API int64_t peri_matrix_rows(const peri_matrix *matrix);
PERI_API int64_t peri_matrix_entries(const peri_matrix *matrix);

/* start[rows+1], column[entries] ascending in each row, value[entries] [M T^-2]; any may be NULL. */
PERI_API int32_t peri_read_matrix(const peri_matrix *matrix, int64_t *start, int32_t *column, double *value);

/* Matrix Market, coordinate real symmetric: the lower triangle. */
PERI_API int32_t peri_write_matrix(const peri_matrix *matrix, peri_write_fn write, void *user);

/* ---- what a scene costs ------------------------------------------------------------------------------------------- */

/* Bytes that a body holds now, as asked of its allocator: the sum is what a counting allocator sees, to the byte. A solve takes more
   while it runs (peri_statics_report.bytes), and so do peri_build (see peri_plan) and some calls that select, write or assemble. */
typedef struct peri_memory {
    int64_t points;   /* positions, volumes, materials, sizes of families; before peri_build what was added so far       */
    int64_t families; /* who is bonded to whom, and what each bond weighs                                                */
    int64_t damage;   /* flags of bonds, no-fail zones, events, what the criteria keep                                   */
    int64_t state;    /* displacements, velocities, forces, and scratch of the passes over them                          */
    int64_t laws;     /* materials, constants of pairs and of points, and the body itself                                */
    int64_t loads;    /* sets, supports, loads, obstacles                                                                */
    int64_t fields;   /* derived fields that were viewed                                                                 */
    int64_t total;    /* of all these                                                                                    */
    int64_t shared;   /* of the total: what clones share. Counted in full in each of them; n of them hold the sum less n-1 times this */
} peri_memory;

/* Before and after peri_build. */
PERI_API int32_t peri_read_memory(const peri_body *body, peri_memory *memory);

typedef enum peri_source {
    PERI_SOURCE_BOX       = 1, /* peri_add_box; or points of yours that lie on a lattice, in its order                   */
    PERI_SOURCE_PERTURBED = 2, /* peri_add_perturbed_box, by amount                                                      */
    PERI_SOURCE_POINTS    = 3, /* peri_add_points: a cloud, in any order, that fills the box with about one point to a cell */
    PERI_SOURCE_COUNT_
} peri_source;

/* A body that is only described: one material in a box. A shape cut from the box mostly costs less than the box. */
typedef struct peri_plan_desc {
    uint64_t              cookie;    /* set by peri_plan_desc_init                                                       */
    const peri_body_desc *body;      /* Required                                                                         */
    const peri_material  *material;  /* Required. Bonds can break where it has a fracture energy or a critical stretch   */
    int32_t               source;    /* peri_source. Default PERI_SOURCE_BOX                                             */
    int32_t               measure;   /* 1 = build a small body of this kind with the allocator of `body`, advance it, and free
                                        it: some 100 ms. Default 0: nothing is allocated                                 */
    double                amount;    /* [0, 1], of PERI_SOURCE_PERTURBED. Default 1                                      */
    double                lo[3];     /* [L] corners of the box; 2D: the third is ignored. Required                       */
    double                hi[3];
    double                spacing;   /* [L] > 0. Required                                                                */
} peri_plan_desc;

typedef struct peri_plan_report {
    int64_t points;      /* as peri_point_count will say                                                                 */
    int64_t bonds;       /* as peri_bond_count will say: exact of a box, else to 5 % from 25 bonds to a family on        */
    int64_t width;       /* as peri_family_width will say: exact of a box, else an estimate                              */
    int64_t columns;     /* families by columns: how many, of 16 bonds each; 0 = a list of bonds, see stencil.c          */
    int64_t bytes;       /* total of peri_read_memory after peri_build: to the byte of a box without correction, else to 5 %. Cuts, loads,
                            supports and views come on top                                                               */
    int64_t peak;        /* most that is held at a time until peri_build has returned, to 5 % or half a megabyte         */
    double  stable_step; /* [T] as peri_stable_step will say: of a box without correction, thicker than a horizon, exact where that is 5
                            (3D), 15 (2D) spacings or less, else to 5 %. Corrections take up to 30 % off it, of parts thinner than
                            two horizons up to 70 %, clouds 15 %, and more where points are close together: measuring sees much
                            of that                                                                                      */
    double  seconds;     /* per step of one thread, on this machine; 0 where it was not measured. Processor time (C's clock): other
                            threads of the process should rest. Within 10 % of large lattices, 20 % of clouds in order; points that
                            come in no order take up to twice as long                                                    */
} peri_plan_report;

/* Fills every field with its default. NULL is ignored. */
PERI_API void peri_plan_desc_init(peri_plan_desc *plan);

/* What a scene will cost, before it is made. Refuses what peri_body_create, peri_add_material, peri_add_box and peri_build would refuse,
   by the same codes and fields (negative influence functions: what a whole family refuses); PERI_ERROR_TOO_LARGE also where the bytes
   cannot be addressed (value: the bonds). The report is then all zero. error may be NULL. Takes about a millisecond at usual horizons,
   however many the points. Where the weights of bonds are corrected, whether a box gets columns or a list is an estimate. */
PERI_API int32_t peri_plan(const peri_plan_desc *plan, peri_plan_report *report, peri_error *error);

/* ---- which trade to take ------------------------------------------------------------------------------------------ */

/* What is to be right, and which length the resolution goes by: the `feature`. */
typedef enum peri_quantity {
    PERI_FOR_DEFORMATION = 1, /* displacements, stiffness, elastic energy. feature: the least thickness of a part that carries     */
    PERI_FOR_STRESS      = 2, /* stress around holes and notches, from 0.3 radii of the rim on. feature: the radius       */
    PERI_FOR_WAVES       = 3, /* the way of waves. feature: the shortest wavelength that matters                         */
    PERI_FOR_FRACTURE    = 4, /* when cracks grow: energy release rate. feature: the length of the crack, 8 spacings or more */
    PERI_QUANTITY_COUNT_
} peri_quantity;

/* Named errors, each for a use. */
typedef enum peri_preset {
    PERI_PRESET_GAME        = 1, /* 20 %: looks right                                                                    */
    PERI_PRESET_TEACHING    = 2, /* 10 %: what is taught is there                                                        */
    PERI_PRESET_ENGINEERING = 3, /* 5 %: as good as the data of most materials                                           */
    PERI_PRESET_REFERENCE   = 4, /* to compare others with: deformation 1 %, stress 2 %, waves and fracture 3 %         */
    PERI_PRESET_COUNT_
} peri_preset;

/* A preset or an error to reach at least cost; or a budget, or both of its kinds, to be as right as can be in. With both an error and a
   budget the cheapest choice for the error must fit. */
typedef struct peri_goal {
    uint64_t cookie;   /* set by peri_goal_init                                                                          */
    int32_t  preset;   /* peri_preset. Default 0: none                                                                   */
    int32_t  quantity; /* peri_quantity. Required                                                                        */
    double   error;    /* (0, 1) relative error to reach. Default 0: not given                                           */
    double   seconds;  /* [s] of one thread of this machine, per step. Default 0: any. Asks for the clock, as `measure` of peri_plan_desc */
    int64_t  bytes;    /* most that is held until peri_build has returned. Default 0: any                                */
    double   feature;  /* [L] > 0. Required                                                                              */
    double   lo[3];    /* [L] corners of the scene; 2D: the third is ignored. Required                                   */
    double   hi[3];
} peri_goal;

typedef struct peri_choice {
    double           spacing; /* [L] for peri_add_box                                                                    */
    double           across;  /* spacings across the feature                                                             */
    double           error;   /* not above this for the quantity: 2.5 times the table's at this and finer resolutions    */
    const char      *text;    /* constant text: the choice in words                                                      */
    peri_plan_report cost;    /* as peri_plan says; seconds where the goal has them                                      */
} peri_choice;

/* Fills every field with its default. NULL is ignored. */
PERI_API void peri_goal_init(peri_goal *goal);

/* Fills body (precision, influence, quadrature, correction, horizon) and material (model, and with it poisson and stabilization) with the
   best choice for a goal, from a table that `make tradeoff` measured on lattices, Poisson's ratio 0.1, 0.3 and 0.45; all else in them, and
   both where the call fails, stays as it is. body needs its space, material its constants and its ratio: PERI_BOND_BASED stands for the
   ratio that it has. Bond-based is chosen only where the ratio and the criterion allow it. The error is one of discretization, of linear
   elasticity: of materials, loads and supports it knows nothing, and the paths of fast cracks ask for horizons small beside what they run
   through. In 3D stress and fracture stand on measurements in the plane. A budget of time takes about a second to look into.
   PERI_ERROR_RANGE: "error": out of reach of the table (value: what is in reach), "poisson": outside [0, 0.45], "seconds", "bytes": out
   of the budget (value: what it takes, 0 where not even the coarsest fits). error may be NULL. */
PERI_API int32_t peri_choose(const peri_goal *goal, peri_body_desc *body, peri_material *material, peri_choice *choice,
                             peri_error *error);

/* ---- results ------------------------------------------------------------------------------------------------------ */

typedef enum peri_field {
    PERI_POSITION       = 1,  /* [dim] reference position [L]                                                    stored  */
    PERI_DISPLACEMENT   = 2,  /* [dim] [L]                                                             stored, writable  */
    PERI_VELOCITY       = 3,  /* [dim] [L T^-1]                                                        stored, writable  */
    PERI_FORCE_DENSITY  = 4,  /* [dim] internal + loads + obstacles [M L^-2 T^-2]; where supported, what the
                                 prescribed acceleration needs                                                   stored  */
    PERI_VOLUME         = 5,  /* [L^3], 2D: area [L^2]                                                           stored  */
    PERI_MATERIAL       = 6,  /* material id                                                                    derived  */
    PERI_FAMILY_SIZE    = 7,  /* bonds of the point, broken ones included                                       derived  */
    PERI_DAMAGE         = 8,  /* 1 - intact/all volume of the family (beta V_j, kept to 6e-8); initial cuts count [L] derived */
    PERI_DAMAGE_GROWN   = 9,  /* the same among bonds that were not cut before the first step                   derived  */
    PERI_ENERGY_DENSITY = 10, /* elastic energy density W of the law [M L^-1 T^-2]                ([P] eq. 7)   derived  */
    PERI_CURRENT        = 11, /* [dim] current position [L]                                                     derived  */
    PERI_DILATATION     = 12, /* theta of the law; bond-based: of LPS with w/|xi|; correspondence: tr(strain)   derived  */
    PERI_STRAIN         = 13, /* [tensor] F = (sum w Y xi V) K^-1 over live bonds: 1/2(F + F^T) - 1 where the geometry is linear
                                 ([T] 4.14), else Green-Lagrange 1/2(F^T F - 1), zero for rotations             derived  */
    PERI_STRESS         = 14, /* [tensor] Cauchy stress of the material at this F [M L^-1 T^-2]; in 2D per area in the plane, the
                                 thickness taken as it was                                                      derived  */
    PERI_FORCE_STRESS   = 15, /* [tensor] collapsed peridynamic stress sum T xi V ([T] 4.10), as Cauchy stress (4.13),
                                 symmetric part: what the bonds carry                                           derived  */
    PERI_REACTION       = 16, /* [dim] force density of the supports on each point, mean of the last step
                                 [M L^-2 T^-2]; 0 where not supported                                           derived  */
    PERI_FIELD_COUNT_
} peri_field; /* [tensor]: xx yy xy in 2D, xx yy zz xy yz xz in 3D. Where live bonds do not span the space, F is what they do span */

/* Entries that peri_read needs for a field: points*components. */
PERI_API int64_t peri_field_size(const peri_body *body, int32_t field);

/* Copies a field, in your units, as double, in your order. capacity counts doubles. */
PERI_API int32_t peri_read(peri_body *body, int32_t field, double *out, int64_t capacity);

/* Sets displacement or velocity of all points from in[count], count = points*dim. */
PERI_API int32_t peri_write(peri_body *body, int32_t field, const double *in, int64_t count);

/* Where a field lies in memory, without a copy. Component k of point i, in your units, is
       offset[k] + scale * data[i*point_stride + k*component_stride]           (data of the given type)
   Stored vectors are of the body's precision and lie in planes: all x, then all y. Volume and derived fields are PERI_F64.
   A stored field's view stays valid until the body is destroyed and shows the present state (forces, once a peri_write or a
   cut has made them old, from the next peri_advance, peri_read or peri_view_field on). A derived one is computed at the call into
   memory of the body (taken on first use) and is valid until the field is viewed again or the body is destroyed. */
typedef struct peri_view {
    const void *data;
    int64_t     count;            /* points                                                                              */
    int64_t     point_stride;     /* in elements                                                                         */
    int64_t     component_stride; /* in elements                                                                         */
    int32_t     components;       /* 1, dim, or 3 or 6 of a tensor                                                       */
    int32_t     type;             /* PERI_F64, PERI_F32 or PERI_I32                                                      */
    double      scale;
    double      offset[3];
} peri_view;
PERI_API int32_t peri_view_field(peri_body *body, int32_t field, peri_view *view);

/* The energy ledger [M L^2 T^-2]. All entries count from build or reset.
       initial + external + obstacle = kinetic + elastic + damping + fracture + error
   where error is what the time step left open. */
typedef struct peri_energy {
    double kinetic;  /* of all points                                                                                    */
    double elastic;  /* stored in intact bonds                                                                           */
    double external; /* work done by loads and supports; in peri_solve by obstacles, too                                 */
    double obstacle; /* work done by obstacles                                                                           */
    double damping;  /* dissipated by mass damping; in peri_solve, what springs free when bonds have broken              */
    double fracture; /* elastic energy that went as bonds broke. State-based: the families that are left are calibrated anew,
                        so a single break may even add some                                                              */
    double initial;  /* put in by writing displacement or velocity (less what later cuts took out), or by a peri_solve that ended on
                        the way to an equilibrium                                                                        */
    double error;    /* initial + external + obstacle - kinetic - elastic - damping - fracture; in peri_solve O(load step^2) where
                        the geometry is not linear                                                                       */
} peri_energy;

/* Costs about one force evaluation, once, when called; keeping the ledger while running costs by the size of the loads. */
PERI_API int32_t peri_read_energy(peri_body *body, peri_energy *energy);

/* Total linear momentum [M L T^-1] to linear[dim], and angular momentum about the origin of the current positions
   [M L^2 T^-1] to angular[1] (2D) or angular[3]. Either may be NULL. */
PERI_API int32_t peri_read_momentum(peri_body *body, double *linear, double *angular);

/* ---- output ------------------------------------------------------------------------------------------------------- */

/* VTK XML unstructured grid for ParaView: points at reference positions, fields displacement, velocity, damage, energy density,
   material, volume, stress (a symmetric tensor); binary. ParaView's "Warp By Vector" shows the deformed body. */
PERI_API int32_t peri_write_vtu(peri_body *body, peri_write_fn write, void *user);

/* One CSV line: step, time, the ledger in the order of peri_energy, broken and cut bonds; with header = 1 the names first. */
PERI_API int32_t peri_write_history(peri_body *body, int32_t header, peri_write_fn write, void *user);

#ifndef PERI_NO_STDIO
PERI_API int32_t peri_save_vtu(peri_body *body, const char *path);
/* append = 0 starts the file with a header, 1 adds a line. */
PERI_API int32_t peri_save_history(peri_body *body, const char *path, int32_t append);
#endif

#ifdef __cplusplus
}
#endif
#endif /* PERI_H */

#if defined(PERI_IMPLEMENTATION) && !defined(PERI_IMPLEMENTATION_DONE)
#define PERI_IMPLEMENTATION_DONE
#include "peri_impl.c"
#endif
