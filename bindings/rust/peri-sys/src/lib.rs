// SPDX-License-Identifier: MIT
//! peri.h as it is: constants, structs and functions of C. Made from peri.h by tools/bind.py: edit that.
#![no_std]
#![allow(non_camel_case_types, non_upper_case_globals)]
use core::ffi::{c_char, c_void};

pub const PERI_VERSION_NUMBER: i32 = 2000;
pub const PERI_ALL: i32 = 268435456;

// peri_status
/// success: as brittle bonds, the horizon being too large
pub const PERI_BRITTLE: i32 = 2;
/// a callback asked to stop; the body is at a whole step
pub const PERI_STOPPED: i32 = 1;
/// success
pub const PERI_OK: i32 = 0;
/// missing, NULL or given twice, or a count that is wrong
pub const PERI_ERROR_ARGUMENT: i32 = -1;
/// not a value of this enum, or a flag that is not 0 or 1
pub const PERI_ERROR_CHOICE: i32 = -2;
/// not filled by its init function, or of another version
pub const PERI_ERROR_DESCRIPTOR: i32 = -3;
/// a number is not finite or outside the range of its field
pub const PERI_ERROR_RANGE: i32 = -4;
/// too early, too late, or from a callback that may not
pub const PERI_ERROR_ORDER: i32 = -5;
/// the allocator returned NULL
pub const PERI_ERROR_MEMORY: i32 = -6;
/// more than the library or memory takes; see the value
pub const PERI_ERROR_TOO_LARGE: i32 = -7;
/// the buffer has the wrong size; it needs the value
pub const PERI_ERROR_CAPACITY: i32 = -8;
/// no id: zero, a plain number, or what a failed call returned
pub const PERI_ERROR_ID_NONE: i32 = -9;
/// an id of another kind: of a load, say, not of a set
pub const PERI_ERROR_ID_KIND: i32 = -10;
/// an id of another body
pub const PERI_ERROR_ID_BODY: i32 = -11;
/// nothing has this id: it was removed, or never given
pub const PERI_ERROR_ID_GONE: i32 = -12;
/// no point has this number
pub const PERI_ERROR_INDEX: i32 = -13;
/// a name that is taken, or that no set has
pub const PERI_ERROR_NAME: i32 = -14;
/// the body, the shape or the selection holds no point
pub const PERI_ERROR_EMPTY: i32 = -15;
/// the material contradicts itself, or is missing
pub const PERI_ERROR_MATERIAL: i32 = -16;
/// bond-based: Poisson's ratio is fixed; it is the value
pub const PERI_ERROR_POISSON: i32 = -17;
/// this law has no such thing, or cannot take this
pub const PERI_ERROR_LAW: i32 = -18;
/// the criterion cannot act on this law, or lacks its G0
pub const PERI_ERROR_CRITERION: i32 = -19;
/// the influence function or its moments are not finite
pub const PERI_ERROR_INFLUENCE: i32 = -20;
/// a place not finite, no volume, or a cell that crosses itself
pub const PERI_ERROR_POINT: i32 = -21;
/// two points are at the same place
pub const PERI_ERROR_COINCIDENT: i32 = -22;
/// the horizon is smaller than the spacing of the points
pub const PERI_ERROR_HORIZON: i32 = -23;
/// a point has no neighbour, or none with a weight
pub const PERI_ERROR_FAMILY: i32 = -24;
/// given families: wrong number, not mutual, not of the horizon
pub const PERI_ERROR_IBOND: i32 = -25;
/// the crack has no extent, or is not for this space
pub const PERI_ERROR_CRACK: i32 = -26;
/// the two points share no bond
pub const PERI_ERROR_PAIR: i32 = -27;
/// this field cannot be used in this way: it is not stored
pub const PERI_ERROR_FIELD: i32 = -28;
/// the points feel another area than that of the face
pub const PERI_ERROR_AREA: i32 = -29;
/// the time step exceeds the stable step, which is the value
pub const PERI_ERROR_STEP: i32 = -30;
/// a point passed 1e9 speeds of sound: step, load or start
pub const PERI_ERROR_UNSTABLE: i32 = -31;
/// a callback failed, or wrote what is not finite
pub const PERI_ERROR_CALLBACK: i32 = -32;
/// no support holds this part against some motion
pub const PERI_ERROR_LOOSE: i32 = -33;
/// the tangent is not positive: buckling or softening
pub const PERI_ERROR_INDEFINITE: i32 = -34;
/// no equilibrium within the iterations; value: residual
pub const PERI_ERROR_CONVERGENCE: i32 = -35;
/// the file or the write callback failed
pub const PERI_ERROR_WRITE: i32 = -36;
/// left out of this build, by the switch that the field names
pub const PERI_ERROR_LEFT_OUT: i32 = -37;
/// no saved state of such a body, or damaged; value: the byte
pub const PERI_ERROR_STATE: i32 = -38;
/// not of a part of a body; or its ghosts are not as owned
pub const PERI_ERROR_PART: i32 = -39;

// peri_kind
pub const PERI_KIND_MATERIAL: i32 = 2201;
pub const PERI_KIND_SET: i32 = 2202;
/// supports included
pub const PERI_KIND_LOAD: i32 = 2203;
pub const PERI_KIND_OBSTACLE: i32 = 2204;

// peri_space
/// 2D, thin plate; bond-based: Poisson's ratio 1/3
pub const PERI_SPACE_PLANE_STRESS: i32 = 101;
/// 2D, long prism; bond-based: 1/4
pub const PERI_SPACE_PLANE_STRAIN: i32 = 102;
/// 3D; bond-based: 1/4
pub const PERI_SPACE_SOLID: i32 = 103;

// peri_precision
pub const PERI_PRECISION_DOUBLE: i32 = 201;
/// state in double, bonds in single: strain to 7 digits
pub const PERI_PRECISION_MIXED: i32 = 202;
/// faster, 0.65 of the memory; strains below 1e-6 lose digits
pub const PERI_PRECISION_SINGLE: i32 = 203;

// peri_geometry
/// e = \|xi+eta\| - \|xi\|, force along xi+eta (\[T\] 1.23)
pub const PERI_GEOMETRY_NONLINEAR: i32 = 301;
/// e = xi.eta/\|xi\|, force along xi: small motion (\[T\] 1.37)
pub const PERI_GEOMETRY_LINEAR: i32 = 302;

// peri_influence
/// 1, also beyond \[P\] w0, \[C\] Const
pub const PERI_INFLUENCE_CONSTANT: i32 = 401;
/// 1, beyond 0 \[P\] w0.5
pub const PERI_INFLUENCE_CUTOFF: i32 = 402;
/// 1 - q, beyond 0 \[P\] w1, \[C\] Linear
pub const PERI_INFLUENCE_LINEAR: i32 = 403;
/// 1 - 3q^2 + 2q^3, beyond 0 \[P\] w3
pub const PERI_INFLUENCE_CUBIC: i32 = 404;
/// 1 - 10q^3 + 15q^4 - 6q^5, beyond 0 \[P\] w5
pub const PERI_INFLUENCE_QUINTIC: i32 = 405;
/// 1 - 35q^4 + 84q^5 - 70q^6 + 20q^7, beyond 0 \[P\] w7
pub const PERI_INFLUENCE_SEPTIC: i32 = 406;
/// (1 - q)^2, beyond 0 \[C\] Quadr
pub const PERI_INFLUENCE_POWER_2: i32 = 407;
/// (1 - q)^3, beyond 0 \[C\] Cubic
pub const PERI_INFLUENCE_POWER_3: i32 = 408;
/// exp(-q^2), also beyond \[T\]
pub const PERI_INFLUENCE_GAUSSIAN: i32 = 409;
/// q, also beyond \[T\]
pub const PERI_INFLUENCE_PROPORTIONAL: i32 = 410;
/// 1/q, also beyond \[T\], \[C\] Inv
pub const PERI_INFLUENCE_INVERSE: i32 = 411;
/// q^-4, also beyond; no finite moments \[T\]
pub const PERI_INFLUENCE_INVERSE_4: i32 = 412;
/// 1/(1 + spacing/(2 horizon) - q) \[T\]
pub const PERI_INFLUENCE_POLE_EDGE: i32 = 413;
/// 1/\|2q - 1\|, also beyond; no finite moments \[T\]
pub const PERI_INFLUENCE_POLE_HALF: i32 = 414;
/// exp(1/(q - 1/4)), also beyond; no moments; \[T\] in mm
pub const PERI_INFLUENCE_POLE_QUARTER: i32 = 415;
/// influence\_fn
pub const PERI_INFLUENCE_USER: i32 = 416;

// peri_quadrature
/// cells whose centre is within, whole \[P\] FA
pub const PERI_QUADRATURE_FULL: i32 = 501;
/// from 1 to 0 over horizon -+ spacing/2 \[T\] Fig. 3.7
pub const PERI_QUADRATURE_RAMP: i32 = 502;
/// the exact part within the horizon \[P\] PA-AC
pub const PERI_QUADRATURE_PARTIAL: i32 = 503;
/// 2D, to its centroid \[P\] IPA-AC: for comparison
pub const PERI_QUADRATURE_PARTIAL_CENTROID: i32 = 504;
/// 2D, the centroid's energy, objective
pub const PERI_QUADRATURE_PARTIAL_MOMENT: i32 = 505;

// peri_break_timing
/// a bond acts until it meets its criterion; error O(dt^2)
pub const PERI_BREAK_WITHIN_STEP: i32 = 601;
/// until the middle of the step \[P\]; ledger error O(dt)
pub const PERI_BREAK_AFTER_DRIFT: i32 = 602;

// peri_correction
/// the constants of an infinite body
pub const PERI_CORRECTION_NONE: i32 = 701;
/// bond-based, by volumes (Le, Bobaru 2018): for comparison
pub const PERI_CORRECTION_VOLUME: i32 = 702;
/// bond-based: right energy of isotropic strain and mean shear
pub const PERI_CORRECTION_ENERGY: i32 = 703;
/// weights, as little as makes uniform strain exact on lattices
pub const PERI_CORRECTION_MOMENT: i32 = 704;
/// and in equilibrium inside on any cloud; not of parts
pub const PERI_CORRECTION_EQUILIBRIUM: i32 = 705;

// peri_moments
/// those left: they take over what others carried
pub const PERI_MOMENTS_LIVE: i32 = 2501;
/// all, broken and cut ones included
pub const PERI_MOMENTS_WHOLE: i32 = 2502;

// peri_kernel
/// columns on lattices where that serves, else a list
pub const PERI_KERNEL_BEST: i32 = 801;
/// every quantity by its formula, bond by bond: slow
pub const PERI_KERNEL_REFERENCE: i32 = 802;
/// the list of families, as clouds have it
pub const PERI_KERNEL_LIST: i32 = 803;

// peri_instructions
/// of the machine
pub const PERI_INSTRUCTIONS_BEST: i32 = 901;
/// SSE2
pub const PERI_INSTRUCTIONS_BASELINE: i32 = 902;
pub const PERI_INSTRUCTIONS_AVX2: i32 = 903;
/// F, VL, DQ and BW
pub const PERI_INSTRUCTIONS_AVX512: i32 = 904;

// peri_law
/// t = 1/2 c w s, s = e/\|xi\|: PMB, generalised \[P\] A, \[T\] 1.23
pub const PERI_LAW_BOND_BASED: i32 = 1001;
/// t = (w/m)(A theta \|xi\| + B e) \[T\] 1.54, 1.67, \[C\] 2-7
pub const PERI_LAW_LPS: i32 = 1002;
/// t = 2 w (a d theta + b e), on each family \[C\] 8-17
pub const PERI_LAW_OTERKUS: i32 = 1003;
/// T = w P K^-1 xi, stabilised \[C\] 18-21
pub const PERI_LAW_CORRESPONDENCE: i32 = 1004;

// peri_criterion
/// s \> s0 \[T\] 1.40, 1.41
pub const PERI_CRITERION_STRETCH: i32 = 1101;
/// state-based: work on the bond \> w0 \[T\] 1.100
pub const PERI_CRITERION_BOND_ENERGY: i32 = 1102;
/// state-based: mean energy of both ends \> w0 \[T\] 1.102
pub const PERI_CRITERION_NODE_ENERGY: i32 = 1103;
/// tension along the bond \> strength
pub const PERI_CRITERION_PRINCIPAL_STRESS: i32 = 1104;
/// von Mises's \> strength; shortened bonds, too
pub const PERI_CRITERION_VON_MISES: i32 = 1105;
/// shear \> cohesion - tan(friction\_angle) normal
pub const PERI_CRITERION_MOHR_COULOMB: i32 = 1106;
/// s \> s0 - compression \* least s at either end
pub const PERI_CRITERION_CONFINED_STRETCH: i32 = 1107;
/// s \> s0 (1 + (ds/dt / rate)^rate\_power)
pub const PERI_CRITERION_RATE_STRETCH: i32 = 1108;
/// s \> s0 for \`delay\` in all
pub const PERI_CRITERION_DELAYED_STRETCH: i32 = 1109;

// peri_softening
/// straight
pub const PERI_SOFTENING_BILINEAR: i32 = 2901;
/// kinked at 1/4 of the strength: concrete
pub const PERI_SOFTENING_TRILINEAR: i32 = 2902;
/// cut off at 1/100 of the strength
pub const PERI_SOFTENING_EXPONENTIAL: i32 = 2903;
/// a table of yours
pub const PERI_SOFTENING_TABLE: i32 = 2904;

// peri_unloading
/// to the origin: damage
pub const PERI_UNLOADING_SECANT: i32 = 3001;
/// as stiff as new: a stretch stays
pub const PERI_UNLOADING_ELASTIC: i32 = 3002;

// peri_reduction
pub const PERI_REDUCTION_SUM: i32 = 3901;
pub const PERI_REDUCTION_MAX: i32 = 3902;

// peri_standing
/// an initial crack: stays at peri\_reset. Only before the first step
pub const PERI_CUT_INITIAL: i32 = 2101;
/// counts as broken, whole again at peri\_reset
pub const PERI_CUT_NOW: i32 = 2102;
/// as PERI\_CUT\_NOW, where the body is now: by current positions
pub const PERI_CUT_IN_PLACE: i32 = 2103;

// peri_axis
pub const PERI_AXIS_X: i32 = 4097;
pub const PERI_AXIS_Y: i32 = 4098;
pub const PERI_AXIS_Z: i32 = 4100;
pub const PERI_AXIS_XY: i32 = 4099;
pub const PERI_AXIS_XYZ: i32 = 4103;

// peri_shape
/// all behind the plane through 0 with \`normal\`
pub const PERI_SHAPE_PLANE: i32 = 2601;
/// radius; 2D: a disc
pub const PERI_SHAPE_BALL: i32 = 2602;
/// size, about 0
pub const PERI_SHAPE_BOX: i32 = 2603;
/// within radius of a line of \`length\` along \`axis\`, about 0
pub const PERI_SHAPE_CAPSULE: i32 = 2604;
/// 3D: the same with flat ends
pub const PERI_SHAPE_CYLINDER: i32 = 2605;
/// within the closed surface of vertices and faces
pub const PERI_SHAPE_MESH: i32 = 2606;
/// where \`distance\` is below 0
pub const PERI_SHAPE_DISTANCE: i32 = 2607;

// peri_integrator
/// half kick, drift, force, half kick \[T\] 2.2
pub const PERI_INTEGRATOR_VELOCITY_VERLET: i32 = 1201;
/// one kick per step, the same motion \[L\], \[T\] 2.10
pub const PERI_INTEGRATOR_CENTRAL_DIFFERENCE: i32 = 1202;

// peri_method
/// conjugate gradients on the tangent, never stored
pub const PERI_METHOD_NEWTON: i32 = 1301;
/// on the assembled tangent (\[T\] 3.2): for comparison
pub const PERI_METHOD_BICGSTAB: i32 = 1302;
/// adaptive dynamic relaxation: slow, any tangent
pub const PERI_METHOD_RELAXATION: i32 = 1303;

// peri_preconditioner
/// blocks, and elasticity on background grids
pub const PERI_PRECONDITIONER_MULTILEVEL: i32 = 1401;
/// the dim x dim blocks of the diagonal
pub const PERI_PRECONDITIONER_BLOCK_JACOBI: i32 = 1402;
pub const PERI_PRECONDITIONER_NONE: i32 = 1403;

// peri_loose
/// PERI\_ERROR\_LOOSE, index: a point of it; see lost\_parts
pub const PERI_LOOSE_REFUSED: i32 = 1501;
/// just enough is held; exact where loads balance
pub const PERI_LOOSE_PINNED: i32 = 1502;
/// the part of the loads that drives the mode is left out
pub const PERI_LOOSE_BALANCED: i32 = 1503;

// peri_control
/// the load steps
pub const PERI_CONTROL_LOAD: i32 = 2801;
/// where the next bond meets its criterion: through snap-back
pub const PERI_CONTROL_FRACTURE: i32 = 2802;

// peri_ended
/// load\_to is reached
pub const PERI_ENDED_LOAD: i32 = 2701;
/// a part that bears a load or a support broke off
pub const PERI_ENDED_SEVERED: i32 = 2702;
pub const PERI_ENDED_BREAKS: i32 = 2703;
pub const PERI_ENDED_STOPPED: i32 = 2704;

// peri_field
/// S \[dim\] reference position \[L\]
pub const PERI_FIELD_POSITION: i32 = 2001;
/// SW \[dim\] \[L\]
pub const PERI_FIELD_DISPLACEMENT: i32 = 2002;
/// SW \[dim\] \[L T^-1\]
pub const PERI_FIELD_VELOCITY: i32 = 2003;
/// S \[dim\] internal, loads, obstacles, contact
pub const PERI_FIELD_FORCE_DENSITY: i32 = 2004;
/// S \[L^3\]; planes: area \[L^2\]
pub const PERI_FIELD_VOLUME: i32 = 2005;
/// PERI\_ID\_INDEX of the material
pub const PERI_FIELD_MATERIAL: i32 = 2006;
/// bonds of the point, broken ones included
pub const PERI_FIELD_FAMILY_SIZE: i32 = 2007;
/// 1 - intact/all volume of the family \[-\] \[L\]
pub const PERI_FIELD_DAMAGE: i32 = 2008;
/// the same among bonds that are not initial cracks
pub const PERI_FIELD_DAMAGE_GROWN: i32 = 2009;
/// elastic W of the law \[M L^-1 T^-2\] \[P\] eq. 7
pub const PERI_FIELD_ENERGY_DENSITY: i32 = 2010;
/// \[dim\] \[L\]
pub const PERI_FIELD_CURRENT_POSITION: i32 = 2011;
/// theta of the law \[-\]
pub const PERI_FIELD_DILATATION: i32 = 2012;
/// \[tensor\] of F: small, or Green-Lagrange \[T\] 4.14
pub const PERI_FIELD_STRAIN: i32 = 2013;
/// \[tensor\] Cauchy, of the material \[M L^-1 T^-2\]
pub const PERI_FIELD_STRESS: i32 = 2014;
/// \[tensor\] Cauchy, what the bonds carry \[T\] 4.10, 4.13
pub const PERI_FIELD_FORCE_STRESS: i32 = 2015;
/// \[dim\] force density of supports, mean of the last step
pub const PERI_FIELD_REACTION: i32 = 2016;
/// peri\_find\_fragments
pub const PERI_FIELD_FRAGMENT: i32 = 2017;
/// \[M\]; planes: thickness included
pub const PERI_FIELD_MASS: i32 = 2018;
/// W \[M L^-3\] Default: of the material
pub const PERI_FIELD_DENSITY: i32 = 2019;
/// \[dim\] 1: a support prescribes it; else 0
pub const PERI_FIELD_HELD: i32 = 2020;
/// W stretch at no force \[-\] -0.9..10. Default 0
pub const PERI_FIELD_EIGENSTRAIN: i32 = 2021;
/// W times s0, squared times w0 \[-\] 1e-6..1e6. Default 1
pub const PERI_FIELD_STRENGTH: i32 = 2022;
/// W times E \[-\] 1e-6..1e6. Default 1
pub const PERI_FIELD_STIFFNESS: i32 = 2023;
/// \[dim\*dim\] F by rows
pub const PERI_FIELD_DEFORMATION_GRADIENT: i32 = 2024;

// peri_type
pub const PERI_TYPE_F64: i32 = 1601;
pub const PERI_TYPE_F32: i32 = 1602;
pub const PERI_TYPE_I32: i32 = 1603;

// peri_bond
/// i
pub const PERI_BOND_POINT: i32 = 4001;
/// j
pub const PERI_BOND_OTHER: i32 = 4002;
/// \|xi\| \[L\]
pub const PERI_BOND_LENGTH: i32 = 4003;
/// beta V\_j \[L^3\]
pub const PERI_BOND_VOLUME: i32 = 4004;
/// w beta V\_j, corrected
pub const PERI_BOND_WEIGHT: i32 = 4005;
/// 1 or 0
pub const PERI_BOND_INTACT: i32 = 4006;
/// \[-\]
pub const PERI_BOND_STRETCH: i32 = 4007;
/// \[dim\] part of the force density of i
pub const PERI_BOND_FORCE: i32 = 4008;
/// and of the energy density
pub const PERI_BOND_ENERGY: i32 = 4009;

// peri_source
/// peri\_add\_box
pub const PERI_SOURCE_BOX: i32 = 1701;
/// peri\_add\_perturbed\_box
pub const PERI_SOURCE_PERTURBED: i32 = 1702;
/// peri\_add\_points: a cloud, about one point to a cell
pub const PERI_SOURCE_POINTS: i32 = 1703;

// peri_quantity
/// stiffness; the least thickness that carries
pub const PERI_QUANTITY_DEFORMATION: i32 = 1801;
/// around holes and notches; the radius
pub const PERI_QUANTITY_STRESS: i32 = 1802;
/// their way; the shortest wavelength
pub const PERI_QUANTITY_WAVES: i32 = 1803;
/// when cracks grow; the crack's length, 8 spacings or more
pub const PERI_QUANTITY_FRACTURE: i32 = 1804;

// peri_preset
pub const PERI_PRESET_NONE: i32 = 1901;
/// 20 %
pub const PERI_PRESET_GAME: i32 = 1902;
/// 10 %
pub const PERI_PRESET_TEACHING: i32 = 1903;
/// 5 %
pub const PERI_PRESET_ENGINEERING: i32 = 1904;
/// deformation 1 %, stress 2 %, waves and fracture 3 %
pub const PERI_PRESET_REFERENCE: i32 = 1905;

#[repr(C)]
pub struct peri_body {
    _private: [u8; 0],
}

/// The same as a matrix by compressed rows, points\*dim square (\[T\] 3.2, 3.3). It outlives the body; free it by
/// peri\_matrix\_destroy.
#[repr(C)]
pub struct peri_matrix {
    _private: [u8; 0],
}

/// Cracks: midway through the broken bonds of adjacent points. They outlive the body; free them by peri\_cracks\_destroy.
#[repr(C)]
pub struct peri_cracks {
    _private: [u8; 0],
}

/// Memory, both or neither. release gets the size that allocate was asked for. Neither may call the library.
pub type peri_allocate_fn = Option<unsafe extern "C" fn(user: *mut c_void, bytes: u64) -> *mut c_void>;
/// Memory, both or neither. release gets the size that allocate was asked for. Neither may call the library.
pub type peri_release_fn = Option<unsafe extern "C" fn(user: *mut c_void, pointer: *mut c_void, bytes: u64)>;
/// A job system: call task(context, k) once for each k in \[0, count), in any order on any threads, and return when all are done.
/// Default: OpenMP where compiled in, else serial.
pub type peri_task_fn = Option<unsafe extern "C" fn(context: *mut c_void, k: i64)>;
/// A job system: call task(context, k) once for each k in \[0, count), in any order on any threads, and return when all are done.
/// Default: OpenMP where compiled in, else serial.
pub type peri_parallel_for_fn = Option<unsafe extern "C" fn(user: *mut c_void, count: i64, task: peri_task_fn, context: *mut c_void)>;
/// Remarks that are no errors. level: 0 information, 1 warning.
pub type peri_log_fn = Option<unsafe extern "C" fn(user: *mut c_void, level: i32, text: *const c_char)>;
/// Influence function: \*w = w(q) \[-\], q = \|xi\|/horizon \> 0, with partial volumes also a little beyond 1; 0, or 1e-100 \< \|w\|
/// \< 1e100.
pub type peri_influence_fn = Option<unsafe extern "C" fn(user: *mut c_void, q: f64, w: *mut f64) -> i32>;
/// \> 0 takes the point or site at x\[dim\]; index numbers the candidates.
pub type peri_point_fn = Option<unsafe extern "C" fn(user: *mut c_void, index: i64, x: *const f64) -> i32>;
/// \> 0 cuts the bond between points i \< j at xi\[dim\] and xj\[dim\].
pub type peri_pair_fn = Option<unsafe extern "C" fn(user: *mut c_void, i: i32, j: i32, xi: *const f64, xj: *const f64) -> i32>;
/// Values of a load or support at \`time\` on points\[count\]: value\[count\*dim\] holds the constant value; overwrite what varies.
/// Once per step, for its end; in peri\_solve time is the load factor. \> 0 stops the run after the step; peri\_solve as
/// peri\_iteration\_fn does.
pub type peri_load_fn = Option<unsafe extern "C" fn(user: *mut c_void, time: f64, count: i64, points: *const i32, value: *mut f64) -> i32>;
/// Writes where the frame of an obstacle is at \`time\`: place\[dim\] \[L\], and its turn, in 2D an angle turn\[1\], in 3D a
/// quaternion turn\[4\] (w x y z). They hold those of the start. \> 0: likewise.
pub type peri_motion_fn = Option<unsafe extern "C" fn(user: *mut c_void, time: f64, place: *mut f64, turn: *mut f64) -> i32>;
/// A shape: \*distance \[L\] of x\[dim\] from its surface, \< 0 inside, and there the outward normal\[dim\], of any length; in the
/// frame of the obstacle
pub type peri_distance_fn = Option<unsafe extern "C" fn(user: *mut c_void, x: *const f64, distance: *mut f64, normal: *mut f64) -> i32>;
/// Comes on the threads of the body, for several blocks at once; no jump may leave it.
pub type peri_stress_fn = Option<unsafe extern "C" fn(user: *mut c_void, block: *const peri_stress_block) -> i32>;
/// Writes the motion of a rigid support at \`time\`. \> 0: likewise.
pub type peri_rigid_fn = Option<unsafe extern "C" fn(user: *mut c_void, time: f64, motion: *mut f64) -> i32>;
/// A bond i \< j broke by its criterion at \`time\` \[T\] and this stretch \[-\]. Called after the step, in ascending (i, j). \> 0
/// ends the run with PERI\_STOPPED.
pub type peri_break_fn = Option<unsafe extern "C" fn(user: *mut c_void, i: i32, j: i32, time: f64, stretch: f64) -> i32>;
/// A law, or a criterion, of bonds. A function of what it gets alone: it comes for each bond from both ends, as often as wanted, on
/// any thread, and may not call the library.
pub type peri_bond_law_fn = Option<unsafe extern "C" fn(user: *mut c_void, row: *const peri_bond_row) -> i32>;
/// Takes the next \`count\` bytes of a file; all but 0 is a failure: PERI\_ERROR\_WRITE.
pub type peri_write_fn = Option<unsafe extern "C" fn(user: *mut c_void, bytes: *const c_void, count: i64) -> i32>;
/// Writes the next \`count\` bytes to \`bytes\`; all but 0 is a failure, as where fewer are left.
pub type peri_read_fn = Option<unsafe extern "C" fn(user: *mut c_void, bytes: *mut c_void, count: i64) -> i32>;
/// plane\[k\]\[i\], of type PERI\_TYPE\_F64 or \_F32, is of point i: send those of your points to where they are ghosts, and write
/// those of ghosts. Once per step; \`planes\` is alike on all parts.
pub type peri_exchange_fn = Option<unsafe extern "C" fn(user: *mut c_void, r#type: i32, planes: i32, plane: *mut *mut c_void) -> i32>;
/// values\[count\] become their sums or maxima. Once per step, and in most calls.
pub type peri_reduce_fn = Option<unsafe extern "C" fn(user: *mut c_void, reduction: i32, count: i64, values: *mut f64) -> i32>;
/// Every frame\_steps steps and at the end of a run; at each equilibrium of peri\_solve. \> 0 stops. It may also cut, select, set
/// no-fail zones and contact, add or remove loads and obstacles.
pub type peri_frame_fn = Option<unsafe extern "C" fn(user: *mut c_void, body: *mut peri_body) -> i32>;
/// After each iteration of the linear solver, with the residual over its scale. \> 0 stops there, short of the equilibrium.
pub type peri_iteration_fn = Option<unsafe extern "C" fn(user: *mut c_void, iteration: i64, residual: f64) -> i32>;

#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct peri_error {
    /// peri\_status
    pub code: i32,
    /// 0
    pub reserved: i32,
    /// first offending point, entry or id; else -1
    pub index: i64,
    /// the offending value, or the limit that was passed; else 0
    pub value: f64,
    /// constant text: the name in this header of what is at fault, or ""
    pub field: *const c_char,
    /// constant text: peri\_status\_text(code)
    pub text: *const c_char,
}

/// Points whose stress is asked for; matrices by rows, out: to be written.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct peri_stress_block {
    pub count: i64,
    /// \[count\]
    pub points: *const i32,
    /// \[count\]\[dim\]\[dim\] H = F - 1
    pub gradient: *const f64,
    /// \[T\] since the history was committed
    pub time_step: f64,
    /// \[count\]\[history\] as committed; out: as it becomes
    pub history: *mut f64,
    /// \[count\]\[dim\]\[dim\] out: P, first Piola-Kirchhoff; linear: Cauchy
    pub stress: *mut f64,
    /// \[count\]\[dim^2\]\[dim^2\] out: dP/dH, symmetric; NULL: not wanted
    pub tangent: *mut f64,
    /// \[count\] out: stored \[M L^-1 T^-2\]. 0
    pub energy: *mut f64,
    /// \[count\] out: lost in time\_step, likewise. 0
    pub dissipation: *mut f64,
}

/// Bonds of one point to others\[\]: arrays of \`count\`. All that is written is 0 at first.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct peri_bond_row {
    pub point: i32,
    pub count: i32,
    pub others: *const i32,
    /// \|xi\| \[L\]
    pub length: *const f64,
    /// s = e/\|xi\| \[-\]; 0 of broken bonds
    pub stretch: *const f64,
    /// \[count\*states\] in: as last kept; out: as it is with this stretch
    pub state: *mut f64,
    /// out \[-\] f/c: the stretch at which a linear bond pulls as hard
    pub force: *mut f64,
    /// out, its derivative; this and what follows NULL where not asked for
    pub tangent: *mut f64,
    /// out: stored, of which \`force\` is the derivative at constant state
    pub energy: *mut f64,
    /// out: lost since \`state\` was kept
    pub lost: *mut f64,
    /// out: 1 breaks the bond for good
    pub broken: *mut i32,
}

#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct peri_body_desc {
    /// set by init
    pub cookie: u64,
    /// peri\_space. Required
    pub space: i32,
    /// Default PERI\_PRECISION\_DOUBLE
    pub precision: i32,
    /// Default PERI\_GEOMETRY\_NONLINEAR
    pub geometry: i32,
    /// Default PERI\_INFLUENCE\_CONSTANT
    pub influence: i32,
    /// Default PERI\_QUADRATURE\_FULL
    pub quadrature: i32,
    /// Default PERI\_CORRECTION\_NONE
    pub correction: i32,
    /// Default PERI\_BREAK\_WITHIN\_STEP
    pub break_timing: i32,
    /// Default PERI\_MOMENTS\_LIVE
    pub moments: i32,
    /// Default PERI\_KERNEL\_BEST
    pub kernel: i32,
    /// Default PERI\_INSTRUCTIONS\_BEST
    pub instructions: i32,
    /// 0 (default): as OpenMP says; 1: serial; n: n threads
    pub threads: i32,
    /// 1 (default): account for work while running; 0: not
    pub ledger: i32,
    /// 1..127, in its ids; 0 (default): from its address
    pub number: i32,
    /// 0
    pub reserved: i32,
    /// \[L\] \> 0. Required. 3 to 4 spacings
    pub horizon: f64,
    /// \[L\] \> 0, of planes. Default 1
    pub thickness: f64,
    /// for PERI\_INFLUENCE\_USER
    pub influence_fn: peri_influence_fn,
    pub influence_user: *mut c_void,
    /// Default NULL: malloc
    pub allocate: peri_allocate_fn,
    /// Default NULL: free
    pub release: peri_release_fn,
    pub memory_user: *mut c_void,
    /// Default NULL: OpenMP, or serial
    pub parallel_for: peri_parallel_for_fn,
    pub parallel_user: *mut c_void,
    /// Default NULL: silent
    pub log: peri_log_fn,
    pub log_user: *mut c_void,
}

#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct peri_material_desc {
    /// set by init
    pub cookie: u64,
    /// peri\_law
    pub law: i32,
    /// Default PERI\_CRITERION\_STRETCH
    pub criterion: i32,
    /// E \[M L^-1 T^-2\] \> 0. Give E or K, not both; 0 = not given
    pub young: f64,
    /// K = E/(3(1-2 nu)) \[M L^-1 T^-2\] \> 0
    pub bulk: f64,
    /// \[-\] in (-1, 1/2); NaN (default): bond-based, that of the space
    pub poisson: f64,
    /// \[M L^-3\] \> 0. Required
    pub density: f64,
    /// G0 \[M T^-2\] \> 0, per area of crack. 0 (default) = not given
    pub fracture_energy: f64,
    /// s0 \[-\] \> 0. 0 (default) = from G0; with neither, no bond breaks
    pub critical_stretch: f64,
    /// \[-\] \>= 0, correspondence: against zero-energy modes. Default 0.2
    pub stabilization: f64,
    /// \[M L^-1 T^-2\] \> 0 of the criteria of stress; Mohr-Coulomb: or 0
    pub strength: f64,
    /// \[M L^-1 T^-2\] \> 0 of Mohr-Coulomb
    pub cohesion: f64,
    /// \[-\] \[0, pi/2) likewise
    pub friction_angle: f64,
    /// alpha \[-\] 0..1e3, of the confined stretch. 0 (default): none
    pub compression: f64,
    /// \[T^-1\] \> 0 of the rate stretch, and
    pub rate: f64,
    /// \[-\] 0..10. 0 (default): 1
    pub rate_power: f64,
    /// \[T\] \> 0 of the delayed stretch
    pub delay: f64,
    /// LPS: \[M L^-1 T^-2\] in shear, at which it flows. Default 0: never
    pub yield_shear: f64,
    /// LPS, viscous: 0..PERI\_RELAXATIONS. Default 0
    pub relaxations: i32,
    /// numbers per point for \`stress\`, 0..PERI\_HISTORY. Default 0
    pub history: i32,
    /// (0, 1\] of the stiffness in shear, and
    pub relaxation_part: [f64; 4],
    /// \[T\] \> 0 in which it relaxes
    pub relaxation_time: [f64; 4],
    /// correspondence: yours. Default NULL
    pub stress: peri_stress_fn,
    pub stress_user: *mut c_void,
}

#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct peri_softening_desc {
    /// set by init
    pub cookie: u64,
    /// peri\_softening, set by init
    pub shape: i32,
    /// Default PERI\_UNLOADING\_SECANT
    pub unloading: i32,
    /// \[M L^-1 T^-2\] \> 0, of uniaxial tension. Required
    pub strength: f64,
    /// \[M T^-2\] \> 0, the area under the curve. Required
    pub fracture_energy: f64,
    /// (0, 1\] stiffness when shorter, over that when longer. Default 1
    pub compression: f64,
    /// 2..30 rows of
    pub count: i64,
    /// \[count\*2\] stretch past the strength, of any scale, from 0 ascending; force over the strength, from 1 to 0, descending
    pub table: *const f64,
}

/// Cells: polygons, convex or not; tetrahedra, pyramids, wedges, hexahedra (4, 5, 6, 8 corners) in VTK's order, or mirrored.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct peri_cells_desc {
    /// set by init
    pub cookie: u64,
    pub vertex_count: i64,
    /// \[vertex\_count\*vertex\_stride\] \[L\]
    pub vertices: *const f64,
    /// Default 0: dim
    pub vertex_stride: i64,
    pub cell_count: i64,
    /// of cell 0, 1, ...
    pub corners: *const i32,
    /// \[cell\_count+1\] in corners\[\]. Default NULL: cell\_corners each
    pub offsets: *const i64,
    pub cell_corners: i32,
    /// 0
    pub reserved: i32,
    /// \[cell\_count\]. Default NULL
    pub materials: *const i32,
}

/// Ghosts: copies of points that other parts own, peri\_ghost\_depth horizons deep. They bear no load and are in no set, sum or
/// count. Give them all else that their owners have: cuts, motion.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct peri_part_desc {
    /// set by init
    pub cookie: u64,
    /// \[L\] any; this and the next two alike on all parts. Required
    pub origin: [f64; 3],
    /// \[L\] \> 0: the spacing; that of boxes to a factor of 16
    pub length: f64,
    /// \[L^3\] \> 0, planes \[L^2\], of a point
    pub mean_volume: f64,
    /// Default 0
    pub ghost_count: i64,
    /// \[ghost\_count\] points, ascending
    pub ghosts: *const i32,
    /// \[ghost\_count\] the point that it is an image of in a periodic body, or -1. Default NULL: none is
    pub owners: *const i32,
    /// \[points\] in the whole body, ascending. Default NULL: unknown
    pub ids: *const i64,
    /// where another part owns ghosts. Default NULL
    pub exchange: peri_exchange_fn,
    /// of several parts. Default NULL
    pub reduce: peri_reduce_fn,
    pub user: *mut c_void,
}

/// A rigid body of point masses; in 2D vectors end with 0.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct peri_fragment {
    /// its least point
    pub first: i32,
    /// how many
    pub points: i32,
    /// the fragment that it broke off, or -1
    pub parent: i32,
    /// 1: a support holds a point of it
    pub held: i32,
    /// \[M\]
    pub mass: f64,
    /// \[L\] of mass, now
    pub centre: [f64; 3],
    /// \[L T^-1\] of the centre
    pub velocity: [f64; 3],
    /// \[M L^2 T^-1\] momentum about the centre
    pub angular: [f64; 3],
    /// \[M L^2\] about the centre: xx yy zz xy yz xz
    pub inertia: [f64; 6],
    /// \[L\] box around its points, now
    pub lo: [f64; 3],
    pub hi: [f64; 3],
}

/// Pushes points within it out along the normal by stiffness\*depth \[M L^-2 T^-2\]. A free one (of a mass) is moved by that and by
/// gravity, not by other obstacles.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct peri_obstacle_desc {
    /// set by init
    pub cookie: u64,
    /// peri\_shape, set by init
    pub shape: i32,
    /// 0
    pub reserved: i32,
    /// of the frame, and
    pub place: [f64; 3],
    /// see peri\_motion\_fn. Default 0: the frame of the body
    pub turn: [f64; 4],
    /// of a plane,
    pub normal: [f64; 3],
    /// of capsule and cylinder, of any length
    pub axis: [f64; 3],
    /// \[L\] \> 0; PERI\_SHAPE\_DISTANCE: all lies within it, 0: unknown
    pub radius: f64,
    /// \[L\] \> 0
    pub length: f64,
    /// \[L\] \> 0
    pub size: [f64; 3],
    pub vertex_count: i64,
    pub face_count: i64,
    /// \[vertex\_count\*dim\] \[L\]; 2D: of a polygon, counter-clockwise
    pub vertices: *const f64,
    /// 3D: \[face\_count\*3\], counter-clockwise from outside
    pub faces: *const i32,
    pub distance: peri_distance_fn,
    /// \[M L^-3 T^-2\]. 0 (default): young/spacing^2
    pub stiffness: f64,
    /// mu \[-\] \>= 0, Coulomb. Default 0
    pub friction: f64,
    /// \[L T^-1\] \>= 0: slower slip is resisted less. 0 (default): 1e-6 sqrt(young/density)
    pub friction_speed: f64,
    /// (0, 1\], of what is stiff beside the obstacle. Default 1
    pub restitution: f64,
    /// \[M\] \> 0: a free rigid body. Default 0; or
    pub mass: f64,
    /// \[M L^-3\] \> 0: likewise. Default 0
    pub density: f64,
    /// \[M L^2\] about the axes of the frame, 2D: inertia\[0\]; HUGE\_VAL: never turns. 0 (default): of the shape, uniform
    pub inertia: [f64; 3],
    /// \[L T^-1\] of a free one at the start
    pub velocity: [f64; 3],
    /// \[T^-1\] likewise; 2D: spin\[0\]
    pub spin: [f64; 3],
    /// \[L T^-2\] of a free one
    pub gravity: [f64; 3],
    /// of others. Default NULL: at rest
    pub motion: peri_motion_fn,
    /// of distance and motion
    pub user: *mut c_void,
}

/// of its frame; components beyond dim are 0
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct peri_obstacle_state {
    pub place: [f64; 3],
    pub turn: [f64; 4],
    /// mean of the last step; of a free one now; and
    pub velocity: [f64; 3],
    /// \[T^-1\] likewise; 2D: spin\[0\]
    pub spin: [f64; 3],
    /// \[M\] of a free one, else 0
    pub mass: f64,
    /// \[M L^2 T^-2\] likewise
    pub kinetic: f64,
    /// \[M L^2 T^-2\] in its springs
    pub stored: f64,
    /// to friction and restitution since build or reset
    pub lost: f64,
}

/// Unbonded surface points: 1/2 k (d - r)^2 where r \< d = min(distance, \|xi\|), k = stiffness E V /(spacing distance)
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct peri_contact_desc {
    /// set by init
    pub cookie: u64,
    /// (0, 1e3\] of a cell's own \[-\]. Default 0.25
    pub stiffness: f64,
    /// \[L\] Default 0: the spacing
    pub distance: f64,
    /// mu \[-\] 0..1e3. Default 0
    pub friction: f64,
    /// \[L T^-1\] below it: viscous. Default 0
    pub friction_speed: f64,
    /// (0, 1\] of light pieces. Default 1
    pub restitution: f64,
}

#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct peri_advance_desc {
    /// set by init
    pub cookie: u64,
    /// Default PERI\_INTEGRATOR\_VELOCITY\_VERLET
    pub integrator: i32,
    /// 1: time\_step may exceed peri\_stable\_step. Default 0
    pub force_step: i32,
    /// run this many steps; or
    pub steps: i64,
    /// \[T\] run this long, to the last bit. One of the two is required
    pub duration: f64,
    /// \[T\] \> 0; 0 (default): safety \* peri\_stable\_step
    pub time_step: f64,
    /// (0, 1\]. Default 0.9
    pub safety: f64,
    /// a \[T^-1\] \>= 0: force -a\*density\*velocity. Default 0
    pub damping: f64,
    /// NaN (default): peri\_load\_factor, or 1 where none has acted
    pub load_factor: f64,
    /// steps between calls of on\_frame; 0 (default): only at the end
    pub frame_steps: i64,
    /// Default NULL
    pub on_frame: peri_frame_fn,
    pub user: *mut c_void,
}

#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct peri_evaluate_desc {
    /// set by init
    pub cookie: u64,
    /// of all arrays: PERI\_TYPE\_F64 (default) or PERI\_TYPE\_F32
    pub r#type: i32,
    /// 1: forces \[M L T^-2\]; 0 (default): per volume \[M L^-2 T^-2\]
    pub nodal: i32,
    /// 1 (default): theirs; 0: not
    pub bonds: i32,
    /// 1 (default): of loads (moving: obstacles, contact); 0: not
    pub external: i32,
    /// 1: the body moves there, and bonds break. Default 0: it stays
    pub fracture: i32,
    /// 1: report.energy, for one more pass. Default 0
    pub energy: i32,
    /// in elements. Default 0: dim
    pub point_stride: i64,
    /// Default 0: 1
    pub component_stride: i64,
    /// \[L\]. Default NULL: where the body is
    pub displacement: *const c_void,
    /// \[L T^-1\], with fracture. Default NULL: that of the body
    pub velocity: *const c_void,
    /// \[T\], with fracture: how long \`velocity\` took it there. Default 0
    pub time_step: f64,
    /// of loads. NaN (default): peri\_time
    pub time: f64,
    /// Default NaN: the body's
    pub load_factor: f64,
    /// out, supports aside. Default NULL
    pub force: *mut c_void,
    /// out, with time\_step: force times \[T\] of bonds that broke
    pub impulse: *mut c_void,
}

#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct peri_evaluate_report {
    /// bonds, by this call
    pub broken: i64,
    /// elastic \[M L^2 T^-2\], of the bonds that are left
    pub energy: f64,
}

#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct peri_solve_desc {
    /// set by init
    pub cookie: u64,
    /// Default PERI\_METHOD\_NEWTON
    pub method: i32,
    /// of Newton. Default PERI\_PRECONDITIONER\_MULTILEVEL
    pub preconditioner: i32,
    /// Default PERI\_LOOSE\_REFUSED
    pub loose: i32,
    /// 1 (default): bonds break by their criterion; 0: none
    pub fracture: i32,
    /// Default PERI\_CONTROL\_LOAD
    pub control: i32,
    /// load or support whose curve is recorded. Default 0: none
    pub curve_load: i32,
    /// 1: what this solve prepares serves the next, until bonds or supports change. Default 0: that is freed
    pub keep: i32,
    /// 0
    pub reserved: i32,
    /// \[0, 1\]: break those over this part of the largest excess. Default 0.98; 1: one by one
    pub criticality: f64,
    /// \[0, 1): \|residual\| over \|loads\| or \|reactions\|. 0 (default): 1e-8, mixed 1e-5, single 1e-4
    pub tolerance: f64,
    /// \> 0, of Newton: this fall of the residual's energy is enough, too. Default 0: never
    pub energy_tolerance: f64,
    /// most for one equilibrium, linear. Default 20000
    pub iterations: i64,
    /// most Newton iterations for one equilibrium. Default 60
    pub newton: i64,
    /// most rounds of breaking at one factor, or of fracture control. Default 100000
    pub breaks: i64,
    /// factor to begin at. NaN (default): peri\_load\_factor
    pub load_from: f64,
    /// factor at the end. Default 1
    pub load_to: f64,
    /// load steps \>= 1. Default 1
    pub steps: i64,
    /// \[T\] \>= 0 of all steps: what flows, does. Default 0
    pub duration: f64,
    /// most halvings of a failing step, 0..60. Default 8
    pub halvings: i64,
    /// \[curve\_rows\]\[2 + 2\*dim\]: load factor, mean displacement \[L\], peri\_get\_reaction, broken bonds
    pub curve: *mut f64,
    /// rows that fit; more are counted in the report
    pub curve_rows: i64,
    /// Default NULL
    pub on_iteration: peri_iteration_fn,
    /// at each equilibrium, also after it cut. Default NULL
    pub on_step: peri_frame_fn,
    /// for both
    pub user: *mut c_void,
}

#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct peri_solve_report {
    /// of the linear solver, or relaxation steps, in all
    pub iterations: i64,
    /// evaluations of all bonds: forces and products with the tangent
    pub passes: i64,
    /// Newton iterations in all
    pub newton: i64,
    /// load steps done
    pub steps: i64,
    /// bonds broken
    pub broken: i64,
    /// rows of the curve, written or not
    pub curve_rows: i64,
    /// rigid-body modes pinned or balanced in the last equilibrium
    pub loose: i64,
    /// broke off, bear nothing and are left where they are
    pub lost_parts: i64,
    pub lost_points: i64,
    /// most memory of the solver at a time, beside the body
    pub bytes: i64,
    /// peri\_ended; 0 where the solve failed
    pub ended: i32,
    /// 0
    pub reserved: i32,
    /// of the last equilibrium, over its scale; 0 where nothing acts
    pub residual: f64,
    /// of the last equilibrium
    pub load_factor: f64,
}

/// A field in place: component k of point i, in your units, is offset\[k\] + scale \* data\[i\*point\_stride +
/// k\*component\_stride\].
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct peri_view {
    /// of the body
    pub data: *const c_void,
    /// points
    pub count: i64,
    /// in elements
    pub point_stride: i64,
    /// in elements
    pub component_stride: i64,
    /// 1, dim, 3 or 6 of a tensor, or dim\*dim
    pub components: i32,
    /// peri\_type
    pub r#type: i32,
    pub scale: f64,
    pub offset: [f64; 3],
}

/// The ledger \[M L^2 T^-2\], from build or reset on: initial + external + obstacle = kinetic + elastic + contact + damping +
/// fracture + error.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct peri_energy {
    pub kinetic: f64,
    /// stored in intact bonds
    pub elastic: f64,
    /// stored in contact
    pub contact: f64,
    /// work of loads and supports; in peri\_solve of obstacles, too
    pub external: f64,
    /// work of obstacles
    pub obstacle: f64,
    /// by damping and contact; in peri\_solve what springs free as bonds break
    pub damping: f64,
    /// elastic energy that went with bonds as they broke, less what contact got
    pub fracture: f64,
    /// put in by setting motion, less what later cuts took out
    pub initial: f64,
    /// what time steps, or load steps, left open
    pub error: f64,
}

#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct peri_cracks_desc {
    /// set by init
    pub cookie: u64,
    /// 1 (default): initial cracks, too
    pub initial: i32,
    /// 1: where the body is now. Default 0: reference positions
    pub current: i32,
    /// \[L\] \>= 0, 2D: leaves out shorter cracks and branches with a tip. NaN (default): the horizon
    pub shortest: f64,
}

/// 2D: where a path ends within the body
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct peri_crack_tip {
    /// \[L\]
    pub place: [f64; 3],
    /// of length 1
    pub direction: [f64; 3],
    /// \[L T^-1\] NaN: not recorded
    pub speed: f64,
    /// 0, 1, ...
    pub path: i64,
}

/// Bytes that the body holds, as asked of its allocator. Solves and builds take more.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct peri_memory {
    /// positions, volumes, materials, sizes of families
    pub points: i64,
    /// who is bonded to whom, and what each bond weighs
    pub families: i64,
    /// flags of bonds, no-fail zones, events, what the criteria keep
    pub damage: i64,
    /// displacements, velocities, forces, and scratch of passes
    pub state: i64,
    /// materials, constants, and the body itself
    pub laws: i64,
    /// sets, supports, loads, obstacles, contact
    pub loads: i64,
    /// derived fields that were viewed; fragments
    pub fields: i64,
    /// of all these
    pub total: i64,
    /// of the total: what clones share
    pub shared: i64,
}

/// a body that is only described: one material in a box
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct peri_plan_desc {
    /// set by init
    pub cookie: u64,
    /// Required
    pub body: *const peri_body_desc,
    /// Required
    pub material: *const peri_material_desc,
    /// Default PERI\_SOURCE\_BOX
    pub source: i32,
    /// 1: time a small body, 20..100 ms. Default 0: no clock
    pub measure: i32,
    /// \[0, 1\], of PERI\_SOURCE\_PERTURBED. Default 1
    pub amount: f64,
    /// \[L\] corners. Required
    pub lo: [f64; 3],
    pub hi: [f64; 3],
    /// \[L\] \> 0. Required
    pub spacing: f64,
}

#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct peri_plan_report {
    /// peri\_point\_count
    pub points: i64,
    /// peri\_entry\_count: exact of a box, else to 5 %
    pub entries: i64,
    /// peri\_family\_width: exact of a box, else an estimate
    pub width: i64,
    /// families by columns: how many; 0: a list
    pub columns: i64,
    /// peri\_memory.total after peri\_build: exact of a box, else to 5 %
    pub bytes: i64,
    /// most at a time in peri\_build, to 5 % or half a megabyte
    pub peak: i64,
    /// \[T\] peri\_stable\_step, of a box to 6 %
    pub stable_step: f64,
    /// \[s\] of one thread per step; 0 where not measured
    pub seconds: f64,
}

/// a preset, or an error, at least cost; or a budget; or both
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct peri_choose_desc {
    /// set by init
    pub cookie: u64,
    /// Default PERI\_PRESET\_NONE
    pub preset: i32,
    /// peri\_quantity. Required
    pub quantity: i32,
    /// (0, 1) relative error to reach. Default 0: not given
    pub error: f64,
    /// \[s\] of one thread per step. Default 0: any. Takes about a second
    pub seconds: f64,
    /// most until peri\_build has returned. Default 0: any
    pub bytes: i64,
    /// \[L\] \> 0. Required
    pub feature: f64,
    /// \[L\] corners of the scene. Required
    pub lo: [f64; 3],
    pub hi: [f64; 3],
}

#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct peri_choose_report {
    /// \[L\] for peri\_add\_box
    pub spacing: f64,
    /// spacings across the feature
    pub across: f64,
    /// of the quantity, not above this
    pub error: f64,
    /// constant text: the choice in words
    pub text: *const c_char,
    /// as peri\_plan says
    pub cost: peri_plan_report,
}

unsafe extern "C" {
    /// PERI\_VERSION\_NUMBER of the implementation.
    pub fn peri_version() -> i32;
    /// Never NULL.
    pub fn peri_status_text(status: i32) -> *const c_char;
    /// "text: field index i, value v", cut off at capacity bytes, zero included. Returns the length of the whole text. buffer may be
    /// NULL where capacity is 0.
    pub fn peri_format_error(error: *const peri_error, buffer: *mut c_char, capacity: i64) -> i64;
    /// Fills in the defaults. NULL is ignored; alike all \_desc\_init.
    pub fn peri_body_desc_init(desc: *mut peri_body_desc);
    /// \*body is NULL on failure. error may be NULL.
    pub fn peri_body_create(desc: *const peri_body_desc, body: *mut *mut peri_body, error: *mut peri_error) -> i32;
    /// An independent copy of a built body, state, loads and number included: ids hold in both. Points, families and weights are
    /// shared. error may be NULL.
    pub fn peri_body_clone(body: *const peri_body, copy: *mut *mut peri_body, error: *mut peri_error) -> i32;
    /// Frees the body. Ignored of NULL, and from a callback of the body. Clones live on.
    pub fn peri_body_destroy(body: *mut peri_body);
    /// After a callback was left by longjmp or an exception: ends the call that it came from, and frees its memory. The body may then
    /// be read, reset or destroyed; it runs again after peri\_reset. Never from within a callback. PERI\_ERROR\_ORDER where none was
    /// left. Memory hooks, job systems and what a measuring peri\_plan calls may not be left so.
    pub fn peri_unlock(body: *mut peri_body) -> i32;
    /// The record of the body's last failed call; code PERI\_OK where none failed.
    pub fn peri_get_error(body: *const peri_body, error: *mut peri_error) -> i32;
    /// The id of the index-th (1, 2, ...) thing of a peri\_kind, removed ones counted; or an error.
    pub fn peri_id(body: *const peri_body, kind: i32, index: i64) -> i32;
    pub fn peri_material_desc_init(desc: *mut peri_material_desc, law: i32);
    /// Adds a material, before peri\_build; at most 120. Returns its id, or an error.
    pub fn peri_add_material(body: *mut peri_body, desc: *const peri_material_desc) -> i32;
    /// Bonds between i and j break, and of bond-based i and j act, as if of \`desc\`, before peri\_build; its law is that of one of
    /// them, not bond-based unless both are. Default: harmonic mean of the micromoduli, the criteria of both.
    pub fn peri_set_interface(body: *mut peri_body, i: i32, j: i32, desc: *const peri_material_desc) -> i32;
    pub fn peri_softening_desc_init(desc: *mut peri_softening_desc, shape: i32);
    /// Bonds between bond-based materials i and j (i, i: within one) soften, before peri\_build; their fracture\_energy and
    /// critical\_stretch do not count. PERI\_BRITTLE: the horizon is too large, bonds break at once at less than the strength and
    /// take the energy. docs/laws.md
    pub fn peri_set_softening(body: *mut peri_body, i: i32, j: i32, desc: *const peri_softening_desc) -> i32;
    /// The stretch at which bonds begin to soften, and that at which they break; after peri\_build. PERI\_BRITTLE: they are one.
    /// Either may be NULL.
    pub fn peri_get_softening(body: *mut peri_body, i: i32, j: i32, first: *mut f64, last: *mut f64) -> i32;
    /// Bonds between bond-based materials i and j follow fn, each with \`states\` (0..8) numbers of its own, 0 at first; before
    /// peri\_build. Their critical stretch holds, too. docs/laws.md
    pub fn peri_set_bond_law(body: *mut peri_body, i: i32, j: i32, states: i32, r#fn: peri_bond_law_fn, user: *mut c_void) -> i32;
    /// Micromodulus c \[M L^-5 T^-2\] (bond-based only, else NULL) and critical stretch s0 \[-\] (HUGE\_VAL: never; softening: where
    /// they break, after peri\_build) of bonds between materials i and j. Either may be NULL. (\[P\] C.15-C.20, \[T\] 1.24, 1.40)
    pub fn peri_get_bond_constants(body: *mut peri_body, i: i32, j: i32, c: *mut f64, s0: *mut f64) -> i32;
    /// Critical bond energy w0 \[M L^-4 T^-2\] of a material whose criterion is an energy; HUGE\_VAL: none.
    /// PERI\_CRITERION\_NODE\_ENERGY: after peri\_build.
    pub fn peri_get_critical_energy(body: *mut peri_body, material: i32, w0: *mut f64) -> i32;
    /// The box lo\[dim\]..hi\[dim\] in cells of about \`spacing\` \[L\], which tile it.
    pub fn peri_add_box(body: *mut peri_body, material: i32, lo: *const f64, hi: *const f64, spacing: f64) -> i64;
    /// The box in cells\[dim\] cells per axis.
    pub fn peri_add_grid(body: *mut peri_body, material: i32, lo: *const f64, hi: *const f64, cells: *const i32) -> i64;
    /// The lattice cells whose centre is within \`radius\` of \`centre\`: a ball, in 2D a disc.
    pub fn peri_add_ball(body: *mut peri_body, material: i32, centre: *const f64, radius: f64, spacing: f64) -> i64;
    /// The lattice cells of the box whose centre \`inside\` takes.
    pub fn peri_add_shape(body: *mut peri_body, material: i32, lo: *const f64, hi: *const f64, spacing: f64, inside: peri_point_fn, user: *mut c_void) -> i64;
    /// peri\_add\_box, interior vertices moved by up to \`amount\` (0..1) quarters of a cell (\[P\] B).
    pub fn peri_add_perturbed_box(body: *mut peri_body, material: i32, lo: *const f64, hi: *const f64, spacing: f64, amount: f64, seed: u64) -> i64;
    /// Points of yours: positions\[count\*dim\] \[L\], volumes\[count\] \[L^3\] (planes: areas \[L^2\]), materials\[count\] (ids), or
    /// NULL where the body has one material.
    pub fn peri_add_points(body: *mut peri_body, count: i64, positions: *const f64, volumes: *const f64, materials: *const i32) -> i64;
    pub fn peri_cells_desc_init(desc: *mut peri_cells_desc);
    /// Each is a point at its centroid, with its volume; partial volumes are exact.
    pub fn peri_add_cells(body: *mut peri_body, desc: *const peri_cells_desc) -> i64;
    /// Families of yours instead of a search: ibond\[points\*width\] as in \[T\] 3.11, row i padded with i. Membership must be
    /// mutual. Weights are computed as for found families, of whose horizon they must be.
    pub fn peri_set_families(body: *mut peri_body, width: i32, ibond: *const i32) -> i32;
    pub fn peri_part_desc_init(desc: *mut peri_part_desc);
    /// After the points, before peri\_build. All parts make the same calls.
    pub fn peri_set_part(body: *mut peri_body, desc: *const peri_part_desc) -> i32;
    /// 1 or 2, before peri\_build; the deepest that its materials need.
    pub fn peri_ghost_depth(body: *const peri_body) -> i32;
    /// H\[dim\*dim\] \[-\] by rows: images have their owner's displacement + H (distance). Default 0
    pub fn peri_set_mean_gradient(body: *mut peri_body, gradient: *const f64) -> i32;
    /// Of the cells of peri\_add\_box those from first\[dim\] to before last\[dim\].
    pub fn peri_add_box_part(body: *mut peri_body, material: i32, lo: *const f64, hi: *const f64, spacing: f64, first: *const i32, last: *const i32) -> i64;
    /// Finds the families, computes weights and constants, takes the state. Warns of rows of points, and of sheets of them in 3D: no
    /// constants are for these. After a failure the body is as it was: add what is missing and build again.
    pub fn peri_build(body: *mut peri_body) -> i32;
    /// 2 or 3
    pub fn peri_dimension(body: *const peri_body) -> i32;
    pub fn peri_point_count(body: *const peri_body) -> i64;
    /// size of the largest family
    pub fn peri_family_width(body: *const peri_body) -> i32;
    /// broken and cut ones included
    pub fn peri_bond_count(body: *const peri_body) -> i64;
    /// of all families: twice the bonds
    pub fn peri_entry_count(body: *const peri_body) -> i64;
    /// bonds of the initial cracks
    pub fn peri_cut_count(body: *const peri_body) -> i64;
    /// bonds broken, or cut later
    pub fn peri_broken_count(body: *const peri_body) -> i64;
    /// steps, load steps too, since reset
    pub fn peri_step_count(body: *const peri_body) -> i64;
    /// \[T\] since build or reset
    pub fn peri_time(body: *const peri_body) -> f64;
    /// that loads act with; 0 before any did
    pub fn peri_load_factor(body: *const peri_body) -> f64;
    /// How bonds are worked on: "columns, AVX-512", "list, SSE2", "rows", "reference".
    pub fn peri_kernel_text(body: *const peri_body) -> *const c_char;
    /// Largest stable time step \[T\], to 4 % at rest; of state-based bodies that can break, a bound. Takes 20 to 100 steps once:
    /// docs/accuracy.md. 0 before peri\_build.
    pub fn peri_stable_step(body: *const peri_body) -> f64;
    /// Rows \[first, first+count) of the families (\[T\] 3.11) to rows\[count\*width\]: ascending, padded with the row's own number;
    /// broken bonds are listed. capacity counts entries.
    pub fn peri_get_families(body: *mut peri_body, first: i64, count: i64, rows: *mut i32, capacity: i64) -> i32;
    /// The point nearest to x\[dim\] \[L\]; \_in\_place: where it is now.
    pub fn peri_find_point(body: *mut peri_body, x: *const f64) -> i32;
    /// The point nearest to x\[dim\] \[L\]; \_in\_place: where it is now.
    pub fn peri_find_point_in_place(body: *mut peri_body, x: *const f64) -> i32;
    /// 1: bond (i,j) carries force; 0: broken or cut; PERI\_ERROR\_PAIR: no such bond.
    pub fn peri_bond_is_intact(body: *mut peri_body, i: i32, j: i32) -> i32;
    /// Motion, time, steps, load factor and ledger become zero, broken bonds whole. Initial cracks, sets, loads, obstacles and
    /// no-fail zones stay.
    pub fn peri_reset(body: *mut peri_body) -> i32;
    /// name (copied) may be NULL. Reference positions; box and ball include their boundary to 1e-9 spacings.
    pub fn peri_select_box(body: *mut peri_body, name: *const c_char, lo: *const f64, hi: *const f64) -> i32;
    /// name (copied) may be NULL. Reference positions; box and ball include their boundary to 1e-9 spacings.
    pub fn peri_select_ball(body: *mut peri_body, name: *const c_char, centre: *const f64, radius: f64) -> i32;
    /// By present positions.
    pub fn peri_select_box_in_place(body: *mut peri_body, name: *const c_char, lo: *const f64, hi: *const f64) -> i32;
    /// By present positions.
    pub fn peri_select_ball_in_place(body: *mut peri_body, name: *const c_char, centre: *const f64, radius: f64) -> i32;
    pub fn peri_select_if(body: *mut peri_body, name: *const c_char, take: peri_point_fn, user: *mut c_void) -> i32;
    pub fn peri_select_points(body: *mut peri_body, name: *const c_char, count: i64, points: *const i32) -> i32;
    /// id, or PERI\_ERROR\_NAME
    pub fn peri_find_set(body: *const peri_body, name: *const c_char) -> i32;
    /// id, or PERI\_ERROR\_NAME
    pub fn peri_size_of_set(body: *const peri_body, set: i32) -> i64;
    /// id, or PERI\_ERROR\_NAME
    pub fn peri_get_set(body: *mut peri_body, set: i32, points: *mut i32, capacity: i64) -> i32;
    /// Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a spacing. Returns the
    /// number of bonds newly cut. 2D
    pub fn peri_cut_segment(body: *mut peri_body, standing: i32, from: *const f64, to: *const f64) -> i64;
    /// Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a spacing. Returns the
    /// number of bonds newly cut. 2D, \[count\*2\]
    pub fn peri_cut_polyline(body: *mut peri_body, standing: i32, count: i64, vertices: *const f64) -> i64;
    /// Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a spacing. Returns the
    /// number of bonds newly cut. 3D
    pub fn peri_cut_disc(body: *mut peri_body, standing: i32, centre: *const f64, normal: *const f64, radius: f64) -> i64;
    /// Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a spacing. Returns the
    /// number of bonds newly cut. 3D
    pub fn peri_cut_triangle(body: *mut peri_body, standing: i32, p: *const f64, q: *const f64, r: *const f64) -> i64;
    /// Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a spacing. Returns the
    /// number of bonds newly cut. 3D, or parallelogram
    pub fn peri_cut_rectangle(body: *mut peri_body, standing: i32, corner: *const f64, edge1: *const f64, edge2: *const f64) -> i64;
    /// Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a spacing. Returns the
    /// number of bonds newly cut. \[count\*2\] points; each pair must be a bond
    pub fn peri_cut_pairs(body: *mut peri_body, standing: i32, count: i64, pairs: *const i32) -> i64;
    /// Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a spacing. Returns the
    /// number of bonds newly cut.
    pub fn peri_cut_if(body: *mut peri_body, standing: i32, cut: peri_pair_fn, user: *mut c_void) -> i64;
    /// Bonds with an end in the set never break by a criterion (on = 1), or may again (0). Cuts still cut.
    pub fn peri_set_no_fail(body: *mut peri_body, set: i32, on: i32) -> i32;
    /// fn is called for every bond that breaks by its criterion; NULL removes. Costs two to three bits per bond.
    pub fn peri_on_break(body: *mut peri_body, r#fn: peri_break_fn, user: *mut c_void) -> i32;
    /// Strength of bonds, times that of points: factors\[count\] of pairs\[count\*2\], or of intact bonds that \`take\` takes.
    /// Returns how many.
    pub fn peri_set_strength_pairs(body: *mut peri_body, count: i64, pairs: *const i32, factors: *const f64) -> i64;
    /// Strength of bonds, times that of points: factors\[count\] of pairs\[count\*2\], or of intact bonds that \`take\` takes.
    /// Returns how many.
    pub fn peri_set_strength_if(body: *mut peri_body, factor: f64, take: peri_pair_fn, user: *mut c_void) -> i64;
    /// on = 1: keeps when bonds between adjacent points break, for peri\_get\_cracks: 32 to 44 bytes per point.
    pub fn peri_record_breaks(body: *mut peri_body, on: i32) -> i32;
    /// How many there are, and which each point is in: of\_point\[points\], or NULL. They are numbered 0, 1, ... by their least
    /// points when first asked for. Of one that has split since, the piece of most points keeps the number; the others get the next
    /// ones. Free where no bond broke.
    pub fn peri_find_fragments(body: *mut peri_body, of_point: *mut i32, capacity: i64) -> i64;
    /// out\[k\] is fragment k.
    pub fn peri_get_fragments(body: *mut peri_body, out: *mut peri_fragment, capacity: i64) -> i32;
    /// The closed surface of a fragment, or of all (-1), now, by cells. vertices\[\]\[dim\] \[L\]; faces\[\]\[dim\] of vertices: in
    /// 2D edges with the fragment on the left, loop by loop, edge k from vertex k on; in 3D triangles, counter-clockwise from
    /// outside. owners\[\], or NULL: its point; inner\[\], or NULL: 1 where a crack made it. Points and cells of yours are squares or
    /// cubes.
    pub fn peri_size_of_outline(body: *mut peri_body, fragment: i32, vertices: *mut i64, faces: *mut i64) -> i32;
    /// The closed surface of a fragment, or of all (-1), now, by cells. vertices\[\]\[dim\] \[L\]; faces\[\]\[dim\] of vertices: in
    /// 2D edges with the fragment on the left, loop by loop, edge k from vertex k on; in 3D triangles, counter-clockwise from
    /// outside. owners\[\], or NULL: its point; inner\[\], or NULL: 1 where a crack made it. Points and cells of yours are squares or
    /// cubes.
    pub fn peri_get_outline(body: *mut peri_body, fragment: i32, vertices: *mut f64, vertex_capacity: i64, faces: *mut i32, owners: *mut i32, inner: *mut i32, face_capacity: i64) -> i32;
    /// Add value\[dim\] to the displacement \[L\] or velocity \[L T^-1\] of a set, now; peri\_reset clears both. Sums are below 1e15
    /// spacings, 1e9 speeds of sound.
    pub fn peri_add_displacement(body: *mut peri_body, set: i32, value: *const f64) -> i32;
    /// Add value\[dim\] to the displacement \[L\] or velocity \[L T^-1\] of a set, now; peri\_reset clears both. Sums are below 1e15
    /// spacings, 1e9 speeds of sound.
    pub fn peri_add_velocity(body: *mut peri_body, set: i32, value: *const f64) -> i32;
    /// Supports: prescribe the \`axes\` of displacement \[L\] or velocity \[L T^-1\] of a set: value\[dim\] (NULL = zero), or as fn
    /// says (may be NULL). Later supports win. The load factor multiplies a constant displacement, not a velocity. A grip should be a
    /// horizon deep, of state-based laws two.
    pub fn peri_prescribe_displacement(body: *mut peri_body, set: i32, axes: i32, value: *const f64, r#fn: peri_load_fn, user: *mut c_void) -> i32;
    /// Supports: prescribe the \`axes\` of displacement \[L\] or velocity \[L T^-1\] of a set: value\[dim\] (NULL = zero), or as fn
    /// says (may be NULL). Later supports win. The load factor multiplies a constant displacement, not a velocity. A grip should be a
    /// horizon deep, of state-based laws two.
    pub fn peri_prescribe_velocity(body: *mut peri_body, set: i32, axes: i32, value: *const f64, r#fn: peri_load_fn, user: *mut c_void) -> i32;
    /// Support: the set moves as a rigid body. motion: displacement \[L\], then in 2D the angle about centre\[dim\], in 3D a vector
    /// along the axis as long as the angle; NULL: 0. The load factor multiplies it; or fn writes it (may be NULL).
    pub fn peri_prescribe_rigid(body: *mut peri_body, set: i32, centre: *const f64, motion: *const f64, r#fn: peri_rigid_fn, user: *mut c_void) -> i32;
    /// Body force density value\[dim\] \[M L^-2 T^-2\] on a set; gravity is density times g.
    pub fn peri_apply_body_force(body: *mut peri_body, set: i32, value: *const f64, r#fn: peri_load_fn, user: *mut c_void) -> i32;
    /// Traction value\[dim\] \[M L^-1 T^-2\] on a flat face of \`area\` \[L^2\] (2D: length \[L\]) and outward \`normal\`. The set:
    /// all points within two horizons of it, of one material. Uniform stress is exact for correspondence; else the total is, and
    /// strain is off by O(horizon). (\[C\] 2.5, docs/statics.md)
    pub fn peri_apply_traction(body: *mut peri_body, set: i32, area: f64, normal: *const f64, value: *const f64, r#fn: peri_load_fn, user: *mut c_void) -> i32;
    /// A total of value\*area (in 2D times the thickness), spread over the set by volume: on the outermost layer, say. Exact in sum,
    /// but strain near the face is wrong by O(1) (\[C\] 2.5).
    pub fn peri_apply_layer_traction(body: *mut peri_body, set: i32, area: f64, value: *const f64, r#fn: peri_load_fn, user: *mut c_void) -> i32;
    /// Pressure \[M L^-1 T^-2\] on all surfaces of a set, faces of cracks included (\[C\] 2.6): for a crack select the points within
    /// two horizons of it. fn: value\[k\*dim\] is the pressure on point k.
    pub fn peri_apply_pressure(body: *mut peri_body, set: i32, pressure: f64, r#fn: peri_load_fn, user: *mut c_void) -> i32;
    /// As \[C\] 2.6 has it: through the cut bonds between neighbouring points.
    pub fn peri_apply_bond_pressure_for_comparison(body: *mut peri_body, set: i32, pressure: f64, r#fn: peri_load_fn, user: *mut c_void) -> i32;
    /// ids are not used twice
    pub fn peri_remove_load(body: *mut peri_body, load: i32) -> i32;
    /// Force \[M L T^-2\] to force\[dim\]: of a support on the body, mean of the last step (or of the equilibrium); of a load, its
    /// present total.
    pub fn peri_get_reaction(body: *mut peri_body, load: i32, force: *mut f64) -> i32;
    /// Its moment about place\[dim\] \[M L^2 T^-2\] to moment\[1\] (2D) or \[3\].
    pub fn peri_get_reaction_moment(body: *mut peri_body, load: i32, place: *const f64, moment: *mut f64) -> i32;
    pub fn peri_obstacle_desc_init(desc: *mut peri_obstacle_desc, shape: i32);
    /// A mesh is copied, and must be closed.
    pub fn peri_add_obstacle(body: *mut peri_body, desc: *const peri_obstacle_desc) -> i32;
    /// A mesh is copied, and must be closed.
    pub fn peri_remove_obstacle(body: *mut peri_body, obstacle: i32) -> i32;
    /// On the body: force\[dim\] \[M L T^-2\]; moment\[3\], in 2D \[1\], \[M L^2 T^-2\] about its place. Either may be NULL.
    pub fn peri_get_obstacle_force(body: *mut peri_body, obstacle: i32, force: *mut f64, moment: *mut f64) -> i32;
    pub fn peri_get_obstacle_state(body: *mut peri_body, obstacle: i32, state: *mut peri_obstacle_state) -> i32;
    /// Sets place, turn, velocity and spin of a free one.
    pub fn peri_set_obstacle_state(body: *mut peri_body, obstacle: i32, state: *const peri_obstacle_state) -> i32;
    pub fn peri_contact_desc_init(desc: *mut peri_contact_desc);
    /// Of materials i and j, ids or PERI\_ALL; NULL: none.
    pub fn peri_set_contact(body: *mut peri_body, i: i32, j: i32, desc: *const peri_contact_desc) -> i32;
    pub fn peri_advance_desc_init(desc: *mut peri_advance_desc);
    /// Advances the body in time. PERI\_ERROR\_STEP: it ends at a whole step; the value is what may follow. So does
    /// PERI\_ERROR\_CALLBACK of a peri\_frame\_fn or peri\_break\_fn. PERI\_ERROR\_UNSTABLE, and PERI\_ERROR\_CALLBACK of a load or
    /// obstacle (index: the point): it ended within a step; read it, then reset or destroy it.
    pub fn peri_advance(body: *mut peri_body, desc: *const peri_advance_desc) -> i32;
    pub fn peri_evaluate_desc_init(desc: *mut peri_evaluate_desc);
    /// Forces at a displacement of yours. A step, rho of PERI\_FIELD\_DENSITY: v += dt/2 force/rho, u += dt v, peri\_evaluate, v +=
    /// (dt/2 force + impulse)/rho. report may be NULL.
    pub fn peri_evaluate(body: *mut peri_body, desc: *const peri_evaluate_desc, report: *mut peri_evaluate_report) -> i32;
    pub fn peri_solve_desc_init(desc: *mut peri_solve_desc);
    /// Equilibrium under supports and loads, constant values times a factor from load\_from to load\_to, callbacks at time = factor,
    /// prescribed velocities at rest; bonds over their limit break until none does. A later run goes on at load\_to. A failed step
    /// leaves the last equilibrium, or, after breaks, how far it came; so does PERI\_ENDED\_SEVERED.
    pub fn peri_solve(body: *mut peri_body, desc: *const peri_solve_desc, report: *mut peri_solve_report) -> i32;
    /// peri\_advance by implicit steps, \`time\_step\` \> 0 of any size (generalised alpha, order 2). rho \[0, 1\]: what is left of
    /// the highest modes per step; 1 keeps the energy. solve: tolerance, fracture, limits, on\_iteration; NULL: defaults. No
    /// obstacles or contact. A step that fails leaves the last one, less the bonds that broke in it. report may be NULL.
    pub fn peri_advance_implicit(body: *mut peri_body, advance: *const peri_advance_desc, solve: *const peri_solve_desc, rho: f64, report: *mut peri_solve_report) -> i32;
    /// out = K in \[M L T^-2\], the tangent at the present displacement times in\[count\], count = points\*dim; without supports,
    /// obstacles and contact. out may be in. The first call takes memory (peri\_memory.state).
    pub fn peri_multiply_stiffness(body: *mut peri_body, r#in: *const f64, out: *mut f64, count: i64) -> i32;
    /// The same at \`displacement\` \[points\*dim\] of yours instead: the body stays where it is.
    pub fn peri_multiply_stiffness_at(body: *mut peri_body, displacement: *const f64, r#in: *const f64, out: *mut f64, count: i64) -> i32;
    /// The same as a matrix by compressed rows, points\*dim square (\[T\] 3.2, 3.3). It outlives the body; free it by
    /// peri\_matrix\_destroy.
    pub fn peri_matrix_create(body: *mut peri_body, matrix: *mut *mut peri_matrix) -> i32;
    /// The same as a matrix by compressed rows, points\*dim square (\[T\] 3.2, 3.3). It outlives the body; free it by
    /// peri\_matrix\_destroy.
    pub fn peri_matrix_destroy(matrix: *mut peri_matrix);
    /// The same as a matrix by compressed rows, points\*dim square (\[T\] 3.2, 3.3). It outlives the body; free it by
    /// peri\_matrix\_destroy.
    pub fn peri_matrix_rows(matrix: *const peri_matrix) -> i64;
    /// The same as a matrix by compressed rows, points\*dim square (\[T\] 3.2, 3.3). It outlives the body; free it by
    /// peri\_matrix\_destroy.
    pub fn peri_matrix_entries(matrix: *const peri_matrix) -> i64;
    /// start\[rows+1\], column\[entries\] ascending in each row, value\[entries\] \[M T^-2\]; any may be NULL.
    pub fn peri_get_matrix(matrix: *const peri_matrix, start: *mut i64, column: *mut i32, value: *mut f64) -> i32;
    /// Matrix Market, coordinate real symmetric: the lower triangle.
    pub fn peri_export_matrix_to(matrix: *const peri_matrix, write: peri_write_fn, user: *mut c_void) -> i32;
    /// Entries of a field: points\*components.
    pub fn peri_size_of_field(body: *const peri_body, field: i32) -> i64;
    /// Copies a field, as double, in your units and order. capacity counts doubles.
    pub fn peri_get_field(body: *mut peri_body, field: i32, out: *mut f64, capacity: i64) -> i32;
    /// Sets a field W of all points; count = points\*components. What peri\_get\_field gives changes no bit. Fields of material
    /// (docs/laws.md), which peri\_frame\_fn may set, too, outlast peri\_reset.
    pub fn peri_set_field(body: *mut peri_body, field: i32, r#in: *const f64, count: i64) -> i32;
    /// Without a copy. Of a stored field it shows the present state; of a derived one that of the call, until it is viewed again.
    pub fn peri_view_field(body: *mut peri_body, field: i32, view: *mut peri_view) -> i32;
    /// Of points\[count\] alone: count\*components.
    pub fn peri_get_field_at(body: *mut peri_body, field: i32, count: i64, points: *const i32, out: *mut f64, capacity: i64) -> i32;
    /// At places\[count\*dim\] \[L\], in\_place = 1: present ones: linear fields exactly, not across cracks. Outside: NaN.
    pub fn peri_interpolate_field(body: *mut peri_body, field: i32, in_place: i32, count: i64, places: *const f64, out: *mut f64, capacity: i64) -> i32;
    /// Bonds of the points of a set, as in peri\_get\_families.
    pub fn peri_size_of_bonds(body: *const peri_body, set: i32, bond: i32) -> i64;
    /// Bonds of the points of a set, as in peri\_get\_families.
    pub fn peri_get_bonds(body: *mut peri_body, set: i32, bond: i32, out: *mut f64, capacity: i64) -> i32;
    /// Costs one evaluation of the forces.
    pub fn peri_get_energy(body: *mut peri_body, energy: *mut peri_energy) -> i32;
    /// Momentum \[M L T^-1\] to linear\[dim\], about the origin \[M L^2 T^-1\] to angular\[1\] (2D) or \[3\]. Either may be NULL.
    pub fn peri_get_momentum(body: *mut peri_body, linear: *mut f64, angular: *mut f64) -> i32;
    pub fn peri_cracks_desc_init(desc: *mut peri_cracks_desc);
    pub fn peri_cracks_create(body: *mut peri_body, desc: *const peri_cracks_desc, cracks: *mut *mut peri_cracks) -> i32;
    pub fn peri_cracks_destroy(cracks: *mut peri_cracks);
    /// polylines; 3D: sides of cells
    pub fn peri_cracks_paths(cracks: *const peri_cracks) -> i64;
    pub fn peri_cracks_vertices(cracks: *const peri_cracks) -> i64;
    pub fn peri_cracks_tips(cracks: *const peri_cracks) -> i64;
    /// length \[L\]; 3D: area \[L^2\]
    pub fn peri_cracks_size(cracks: *const peri_cracks) -> f64;
    /// Path p: vertices start\[p\] to start\[p+1\], of start\[paths+1\]; in 3D 4: triangles 0 1 2, 0 2 3. vertex\[vertices\*dim\]
    /// \[L\], time\[vertices\] of breaking \[T\] (peri\_solve: load factor; NaN: not recorded), tip\[tips\]. Any may be NULL.
    pub fn peri_get_cracks(cracks: *const peri_cracks, start: *mut i64, vertex: *mut f64, time: *mut f64, tip: *mut peri_crack_tip) -> i32;
    /// VTK XML PolyData (.vtp).
    pub fn peri_export_cracks_to(cracks: *const peri_cracks, write: peri_write_fn, user: *mut c_void) -> i32;
    /// VTK XML for ParaView; "Warp By Vector" shows the deformed body.
    pub fn peri_export_vtu_to(body: *mut peri_body, write: peri_write_fn, user: *mut c_void) -> i32;
    /// fields\[count\], each once, or NULL: as above.
    pub fn peri_export_fields_to(body: *mut peri_body, fields: *const i32, count: i64, write: peri_write_fn, user: *mut c_void) -> i32;
    /// One CSV line: step, time, the ledger, broken and cut bonds; header = 1: the names first.
    pub fn peri_export_history_to(body: *mut peri_body, header: i32, write: peri_write_fn, user: *mut c_void) -> i32;
    pub fn peri_export_vtu(body: *mut peri_body, path: *const c_char) -> i32;
    /// Frame 0, 1, ... of a series: its VTU beside \`path\`, a .pvd.
    pub fn peri_export_frame(body: *mut peri_body, path: *const c_char, frame: i64, fields: *const i32, count: i64) -> i32;
    /// append = 0 starts the file with a header, 1 adds a line.
    pub fn peri_export_history(body: *mut peri_body, path: *const c_char, append: i32) -> i32;
    /// Saves the state: motion, bonds, what criteria keep, time, ledger. Not the scene: load it into a body that the same calls
    /// built. What follows has the same bits.
    pub fn peri_save_state_to(body: *mut peri_body, write: peri_write_fn, user: *mut c_void) -> i32;
    /// Reads all, verifies it, then takes it. PERI\_ERROR\_STATE: nothing has changed; field: what is of another scene, or "".
    pub fn peri_load_state_from(body: *mut peri_body, read: peri_read_fn, user: *mut c_void) -> i32;
    pub fn peri_save_state(body: *mut peri_body, path: *const c_char) -> i32;
    pub fn peri_load_state(body: *mut peri_body, path: *const c_char) -> i32;
    pub fn peri_get_memory(body: *const peri_body, memory: *mut peri_memory) -> i32;
    pub fn peri_plan_desc_init(desc: *mut peri_plan_desc);
    /// What a scene will cost, before it is made: some milliseconds. Refuses what peri\_body\_create, peri\_add\_material,
    /// peri\_add\_box and peri\_build would refuse. error may be NULL.
    pub fn peri_plan(desc: *const peri_plan_desc, report: *mut peri_plan_report, error: *mut peri_error) -> i32;
    pub fn peri_choose_desc_init(desc: *mut peri_choose_desc);
    /// Fills body (precision, influence, quadrature, correction, horizon) and material (law, poisson, stabilization) with the best
    /// choice, from a measured table; the rest stays. body needs its space, material its constants. PERI\_ERROR\_RANGE: out of reach;
    /// the value is what is in reach. error may be NULL.
    pub fn peri_choose(desc: *const peri_choose_desc, body: *mut peri_body_desc, material: *mut peri_material_desc, report: *mut peri_choose_report, error: *mut peri_error) -> i32;
}
