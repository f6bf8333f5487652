// SPDX-License-Identifier: MIT
//! peri: deformation and fracture of solids by nonlocal bonds. Made from peri.h by tools/bind.py: edit that.
//!
//! Names are those of peri.h: `peri_add_box(body, ...)` is [`Body::add_box`], `PERI_SPACE_SOLID` is [`SPACE_SOLID`]. A call that fails gives
//! an [`Error`]. A panic in a closure stops the call that it came from and goes on from there. Closures of loads, obstacles and events live
//! as long as the body and its clones, which may be on other threads: they are `Fn + Send + Sync`. An array has as many entries as peri.h
//! says, or the call fails. Where a name may be NULL, "" stands for it.
#![allow(unused_parens, unused_unsafe, clippy::all)]
use peri_sys as sys;
use std::any::Any;
use std::cell::RefCell;
use std::ffi::{c_char, c_void, CStr, CString};
use std::panic::{catch_unwind, resume_unwind, AssertUnwindSafe};
use std::sync::{Arc, Mutex};

/// What went wrong: the record of the library.
#[derive(Debug, Clone, PartialEq)]
pub struct Error {
    /// Of the `ERROR_` constants.
    pub status: i32,
    /// The name in peri.h of what is at fault, or "".
    pub field: &'static str,
    /// First offending point, entry or id; else -1.
    pub index: i64,
    /// The offending value, or the limit that was passed; else 0.
    pub value: f64,
    text: String,
}

impl std::fmt::Display for Error {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str(&self.text)
    }
}
impl std::error::Error for Error {}

pub type Result<T> = std::result::Result<T, Error>;

fn constant(text: *const c_char) -> &'static str {
    if text.is_null() {
        return "";
    }
    unsafe { CStr::from_ptr(text) }.to_str().unwrap_or("") // constant texts of the library
}

fn blank() -> sys::peri_error {
    sys::peri_error { code: 0, reserved: 0, index: -1, value: 0.0, field: c"".as_ptr(), text: c"".as_ptr() }
}

fn failed(status: i64, record: &sys::peri_error) -> Error {
    let mut one = *record;
    if i64::from(one.code) != status {
        one = blank();
        one.code = status as i32;
        one.text = unsafe { sys::peri_status_text(one.code) };
    }
    let mut text = [0 as c_char; 300];
    unsafe { sys::peri_format_error(&one, text.as_mut_ptr(), text.len() as i64) };
    let text = unsafe { CStr::from_ptr(text.as_ptr()) }.to_string_lossy().into_owned();
    Error { status: one.code, field: constant(one.field), index: one.index, value: one.value, text }
}

fn refused(field: &'static str) -> Error {
    let text = format!("{}: {}", status_text(ERROR_ARGUMENT), field);
    Error { status: ERROR_ARGUMENT, field, index: -1, value: 0.0, text }
}

fn sized(has: usize, needs: i64, field: &'static str) -> Result<()> {
    if has as i64 == needs {
        Ok(())
    } else {
        Err(refused(field))
    }
}

fn c_text(text: &str, field: &'static str) -> Result<CString> {
    CString::new(text).map_err(|_| refused(field))
}

thread_local! {
    /// The panic of a closure on this thread, until the call of the library that it came from has ended.
    static PANIC: RefCell<Option<Box<dyn Any + Send>>> = const { RefCell::new(None) };
}

fn guarded<F: FnOnce() -> i32>(call: F) -> i32 {
    catch_unwind(AssertUnwindSafe(call)).unwrap_or_else(|panic| {
        PANIC.with(|p| *p.borrow_mut() = Some(panic));
        -1
    })
}

fn go_on() {
    if let Some(panic) = PANIC.with(|p| p.borrow_mut().take()) {
        resume_unwind(panic);
    }
}

fn known(result: i64, record: &sys::peri_error) -> Result<()> {
    go_on();
    if result < 0 {
        Err(failed(result, record))
    } else {
        Ok(())
    }
}

unsafe fn slice<'a, T>(data: *const T, count: i64) -> &'a [T] {
    if data.is_null() || count <= 0 {
        &[]
    } else {
        unsafe { std::slice::from_raw_parts(data, count as usize) }
    }
}

unsafe fn slice_mut<'a, T>(data: *mut T, count: i64) -> &'a mut [T] {
    if data.is_null() || count <= 0 {
        &mut []
    } else {
        unsafe { std::slice::from_raw_parts_mut(data, count as usize) }
    }
}

type Keep = Arc<Mutex<Vec<Arc<dyn Any + Send + Sync>>>>;

fn keep(all: &Keep, one: Arc<dyn Any + Send + Sync>) {
    all.lock().unwrap_or_else(|e| e.into_inner()).push(one);
}

pub fn version() -> i32 {
    unsafe { sys::peri_version() }
}

pub fn status_text(status: i32) -> &'static str {
    constant(unsafe { sys::peri_status_text(status) })
}

/// 1, 2, ... in the order in which the ids were given.
pub const fn id_index(id: i32) -> i32 {
    id & 0xFFFFF
}

/// A field in place; it borrows the body, which stays as it is meanwhile.
pub struct View<'a> {
    raw: sys::peri_view,
    body: std::marker::PhantomData<&'a mut Body>,
}

impl View<'_> {
    pub fn points(&self) -> usize {
        self.raw.count as usize
    }
    pub fn components(&self) -> usize {
        self.raw.components as usize
    }
    fn extent(&self) -> i64 {
        let v = &self.raw;
        if v.count == 0 { 0 } else { (v.count - 1) * v.point_stride + i64::from(v.components - 1) * v.component_stride + 1 }
    }
    /// The numbers as they lie in the body: component k of point i at i*point_stride + k*component_stride. None: of another type.
    pub fn doubles(&self) -> Option<&[f64]> {
        (self.raw.r#type == TYPE_F64).then(|| unsafe { slice(self.raw.data as *const f64, self.extent()) })
    }
    pub fn floats(&self) -> Option<&[f32]> {
        (self.raw.r#type == TYPE_F32).then(|| unsafe { slice(self.raw.data as *const f32, self.extent()) })
    }
    pub fn integers(&self) -> Option<&[i32]> {
        (self.raw.r#type == TYPE_I32).then(|| unsafe { slice(self.raw.data as *const i32, self.extent()) })
    }
    pub fn point_stride(&self) -> usize {
        self.raw.point_stride as usize
    }
    pub fn component_stride(&self) -> usize {
        self.raw.component_stride as usize
    }
    /// Component k of point i in your units.
    pub fn at(&self, i: usize, k: usize) -> f64 {
        let n = i * self.point_stride() + k * self.component_stride();
        let number = if let Some(d) = self.doubles() {
            d[n]
        } else if let Some(d) = self.floats() {
            f64::from(d[n])
        } else {
            f64::from(self.integers().unwrap_or(&[])[n])
        };
        self.raw.offset[if k < 3 { k } else { 0 }] + self.raw.scale * number
    }
}

pub const VERSION_NUMBER: i32 = sys::PERI_VERSION_NUMBER;
pub const ALL: i32 = sys::PERI_ALL;
/// success: as brittle bonds, the horizon being too large
pub const BRITTLE: i32 = sys::PERI_BRITTLE;
/// a callback asked to stop; the body is at a whole step
pub const STOPPED: i32 = sys::PERI_STOPPED;
/// success
pub const OK: i32 = sys::PERI_OK;
/// missing, NULL or given twice, or a count that is wrong
pub const ERROR_ARGUMENT: i32 = sys::PERI_ERROR_ARGUMENT;
/// not a value of this enum, or a flag that is not 0 or 1
pub const ERROR_CHOICE: i32 = sys::PERI_ERROR_CHOICE;
/// not filled by its init function, or of another version
pub const ERROR_DESCRIPTOR: i32 = sys::PERI_ERROR_DESCRIPTOR;
/// a number is not finite or outside the range of its field
pub const ERROR_RANGE: i32 = sys::PERI_ERROR_RANGE;
/// too early, too late, or from a callback that may not
pub const ERROR_ORDER: i32 = sys::PERI_ERROR_ORDER;
/// the allocator returned NULL
pub const ERROR_MEMORY: i32 = sys::PERI_ERROR_MEMORY;
/// more than the library or memory takes; see the value
pub const ERROR_TOO_LARGE: i32 = sys::PERI_ERROR_TOO_LARGE;
/// the buffer has the wrong size; it needs the value
pub const ERROR_CAPACITY: i32 = sys::PERI_ERROR_CAPACITY;
/// no id: zero, a plain number, or what a failed call returned
pub const ERROR_ID_NONE: i32 = sys::PERI_ERROR_ID_NONE;
/// an id of another kind: of a load, say, not of a set
pub const ERROR_ID_KIND: i32 = sys::PERI_ERROR_ID_KIND;
/// an id of another body
pub const ERROR_ID_BODY: i32 = sys::PERI_ERROR_ID_BODY;
/// nothing has this id: it was removed, or never given
pub const ERROR_ID_GONE: i32 = sys::PERI_ERROR_ID_GONE;
/// no point has this number
pub const ERROR_INDEX: i32 = sys::PERI_ERROR_INDEX;
/// a name that is taken, or that no set has
pub const ERROR_NAME: i32 = sys::PERI_ERROR_NAME;
/// the body, the shape or the selection holds no point
pub const ERROR_EMPTY: i32 = sys::PERI_ERROR_EMPTY;
/// the material contradicts itself, or is missing
pub const ERROR_MATERIAL: i32 = sys::PERI_ERROR_MATERIAL;
/// bond-based: Poisson's ratio is fixed; it is the value
pub const ERROR_POISSON: i32 = sys::PERI_ERROR_POISSON;
/// this law has no such thing, or cannot take this
pub const ERROR_LAW: i32 = sys::PERI_ERROR_LAW;
/// the criterion cannot act on this law, or lacks its G0
pub const ERROR_CRITERION: i32 = sys::PERI_ERROR_CRITERION;
/// the influence function or its moments are not finite
pub const ERROR_INFLUENCE: i32 = sys::PERI_ERROR_INFLUENCE;
/// a place not finite, no volume, or a cell that crosses itself
pub const ERROR_POINT: i32 = sys::PERI_ERROR_POINT;
/// two points are at the same place
pub const ERROR_COINCIDENT: i32 = sys::PERI_ERROR_COINCIDENT;
/// the horizon is smaller than the spacing of the points
pub const ERROR_HORIZON: i32 = sys::PERI_ERROR_HORIZON;
/// a point has no neighbour, or none with a weight
pub const ERROR_FAMILY: i32 = sys::PERI_ERROR_FAMILY;
/// given families: wrong number, not mutual, not of the horizon
pub const ERROR_IBOND: i32 = sys::PERI_ERROR_IBOND;
/// the crack has no extent, or is not for this space
pub const ERROR_CRACK: i32 = sys::PERI_ERROR_CRACK;
/// the two points share no bond
pub const ERROR_PAIR: i32 = sys::PERI_ERROR_PAIR;
/// this field cannot be used in this way: it is not stored
pub const ERROR_FIELD: i32 = sys::PERI_ERROR_FIELD;
/// the points feel another area than that of the face
pub const ERROR_AREA: i32 = sys::PERI_ERROR_AREA;
/// the time step exceeds the stable step, which is the value
pub const ERROR_STEP: i32 = sys::PERI_ERROR_STEP;
/// a point passed 1e9 speeds of sound: step, load or start
pub const ERROR_UNSTABLE: i32 = sys::PERI_ERROR_UNSTABLE;
/// a callback failed, or wrote what is not finite
pub const ERROR_CALLBACK: i32 = sys::PERI_ERROR_CALLBACK;
/// no support holds this part against some motion
pub const ERROR_LOOSE: i32 = sys::PERI_ERROR_LOOSE;
/// the tangent is not positive: buckling or softening
pub const ERROR_INDEFINITE: i32 = sys::PERI_ERROR_INDEFINITE;
/// no equilibrium within the iterations; value: residual
pub const ERROR_CONVERGENCE: i32 = sys::PERI_ERROR_CONVERGENCE;
/// the file or the write callback failed
pub const ERROR_WRITE: i32 = sys::PERI_ERROR_WRITE;
/// left out of this build, by the switch that the field names
pub const ERROR_LEFT_OUT: i32 = sys::PERI_ERROR_LEFT_OUT;
/// no saved state of such a body, or damaged; value: the byte
pub const ERROR_STATE: i32 = sys::PERI_ERROR_STATE;
/// not of a part of a body; or its ghosts are not as owned
pub const ERROR_PART: i32 = sys::PERI_ERROR_PART;
pub const KIND_MATERIAL: i32 = sys::PERI_KIND_MATERIAL;
pub const KIND_SET: i32 = sys::PERI_KIND_SET;
/// supports included
pub const KIND_LOAD: i32 = sys::PERI_KIND_LOAD;
pub const KIND_OBSTACLE: i32 = sys::PERI_KIND_OBSTACLE;
/// 2D, thin plate; bond-based: Poisson's ratio 1/3
pub const SPACE_PLANE_STRESS: i32 = sys::PERI_SPACE_PLANE_STRESS;
/// 2D, long prism; bond-based: 1/4
pub const SPACE_PLANE_STRAIN: i32 = sys::PERI_SPACE_PLANE_STRAIN;
/// 3D; bond-based: 1/4
pub const SPACE_SOLID: i32 = sys::PERI_SPACE_SOLID;
pub const PRECISION_DOUBLE: i32 = sys::PERI_PRECISION_DOUBLE;
/// state in double, bonds in single: strain to 7 digits
pub const PRECISION_MIXED: i32 = sys::PERI_PRECISION_MIXED;
/// faster, 0.65 of the memory; strains below 1e-6 lose digits
pub const PRECISION_SINGLE: i32 = sys::PERI_PRECISION_SINGLE;
/// e = \|xi+eta\| - \|xi\|, force along xi+eta (\[T\] 1.23)
pub const GEOMETRY_NONLINEAR: i32 = sys::PERI_GEOMETRY_NONLINEAR;
/// e = xi.eta/\|xi\|, force along xi: small motion (\[T\] 1.37)
pub const GEOMETRY_LINEAR: i32 = sys::PERI_GEOMETRY_LINEAR;
/// 1, also beyond \[P\] w0, \[C\] Const
pub const INFLUENCE_CONSTANT: i32 = sys::PERI_INFLUENCE_CONSTANT;
/// 1, beyond 0 \[P\] w0.5
pub const INFLUENCE_CUTOFF: i32 = sys::PERI_INFLUENCE_CUTOFF;
/// 1 - q, beyond 0 \[P\] w1, \[C\] Linear
pub const INFLUENCE_LINEAR: i32 = sys::PERI_INFLUENCE_LINEAR;
/// 1 - 3q^2 + 2q^3, beyond 0 \[P\] w3
pub const INFLUENCE_CUBIC: i32 = sys::PERI_INFLUENCE_CUBIC;
/// 1 - 10q^3 + 15q^4 - 6q^5, beyond 0 \[P\] w5
pub const INFLUENCE_QUINTIC: i32 = sys::PERI_INFLUENCE_QUINTIC;
/// 1 - 35q^4 + 84q^5 - 70q^6 + 20q^7, beyond 0 \[P\] w7
pub const INFLUENCE_SEPTIC: i32 = sys::PERI_INFLUENCE_SEPTIC;
/// (1 - q)^2, beyond 0 \[C\] Quadr
pub const INFLUENCE_POWER_2: i32 = sys::PERI_INFLUENCE_POWER_2;
/// (1 - q)^3, beyond 0 \[C\] Cubic
pub const INFLUENCE_POWER_3: i32 = sys::PERI_INFLUENCE_POWER_3;
/// exp(-q^2), also beyond \[T\]
pub const INFLUENCE_GAUSSIAN: i32 = sys::PERI_INFLUENCE_GAUSSIAN;
/// q, also beyond \[T\]
pub const INFLUENCE_PROPORTIONAL: i32 = sys::PERI_INFLUENCE_PROPORTIONAL;
/// 1/q, also beyond \[T\], \[C\] Inv
pub const INFLUENCE_INVERSE: i32 = sys::PERI_INFLUENCE_INVERSE;
/// q^-4, also beyond; no finite moments \[T\]
pub const INFLUENCE_INVERSE_4: i32 = sys::PERI_INFLUENCE_INVERSE_4;
/// 1/(1 + spacing/(2 horizon) - q) \[T\]
pub const INFLUENCE_POLE_EDGE: i32 = sys::PERI_INFLUENCE_POLE_EDGE;
/// 1/\|2q - 1\|, also beyond; no finite moments \[T\]
pub const INFLUENCE_POLE_HALF: i32 = sys::PERI_INFLUENCE_POLE_HALF;
/// exp(1/(q - 1/4)), also beyond; no moments; \[T\] in mm
pub const INFLUENCE_POLE_QUARTER: i32 = sys::PERI_INFLUENCE_POLE_QUARTER;
/// influence\_fn
pub const INFLUENCE_USER: i32 = sys::PERI_INFLUENCE_USER;
/// cells whose centre is within, whole \[P\] FA
pub const QUADRATURE_FULL: i32 = sys::PERI_QUADRATURE_FULL;
/// from 1 to 0 over horizon -+ spacing/2 \[T\] Fig. 3.7
pub const QUADRATURE_RAMP: i32 = sys::PERI_QUADRATURE_RAMP;
/// the exact part within the horizon \[P\] PA-AC
pub const QUADRATURE_PARTIAL: i32 = sys::PERI_QUADRATURE_PARTIAL;
/// 2D, to its centroid \[P\] IPA-AC: for comparison
pub const QUADRATURE_PARTIAL_CENTROID: i32 = sys::PERI_QUADRATURE_PARTIAL_CENTROID;
/// 2D, the centroid's energy, objective
pub const QUADRATURE_PARTIAL_MOMENT: i32 = sys::PERI_QUADRATURE_PARTIAL_MOMENT;
/// a bond acts until it meets its criterion; error O(dt^2)
pub const BREAK_WITHIN_STEP: i32 = sys::PERI_BREAK_WITHIN_STEP;
/// until the middle of the step \[P\]; ledger error O(dt)
pub const BREAK_AFTER_DRIFT: i32 = sys::PERI_BREAK_AFTER_DRIFT;
/// the constants of an infinite body
pub const CORRECTION_NONE: i32 = sys::PERI_CORRECTION_NONE;
/// bond-based, by volumes (Le, Bobaru 2018): for comparison
pub const CORRECTION_VOLUME: i32 = sys::PERI_CORRECTION_VOLUME;
/// bond-based: right energy of isotropic strain and mean shear
pub const CORRECTION_ENERGY: i32 = sys::PERI_CORRECTION_ENERGY;
/// weights, as little as makes uniform strain exact on lattices
pub const CORRECTION_MOMENT: i32 = sys::PERI_CORRECTION_MOMENT;
/// and in equilibrium inside on any cloud; not of parts
pub const CORRECTION_EQUILIBRIUM: i32 = sys::PERI_CORRECTION_EQUILIBRIUM;
/// those left: they take over what others carried
pub const MOMENTS_LIVE: i32 = sys::PERI_MOMENTS_LIVE;
/// all, broken and cut ones included
pub const MOMENTS_WHOLE: i32 = sys::PERI_MOMENTS_WHOLE;
/// columns on lattices where that serves, else a list
pub const KERNEL_BEST: i32 = sys::PERI_KERNEL_BEST;
/// every quantity by its formula, bond by bond: slow
pub const KERNEL_REFERENCE: i32 = sys::PERI_KERNEL_REFERENCE;
/// the list of families, as clouds have it
pub const KERNEL_LIST: i32 = sys::PERI_KERNEL_LIST;
/// of the machine
pub const INSTRUCTIONS_BEST: i32 = sys::PERI_INSTRUCTIONS_BEST;
/// SSE2
pub const INSTRUCTIONS_BASELINE: i32 = sys::PERI_INSTRUCTIONS_BASELINE;
pub const INSTRUCTIONS_AVX2: i32 = sys::PERI_INSTRUCTIONS_AVX2;
/// F, VL, DQ and BW
pub const INSTRUCTIONS_AVX512: i32 = sys::PERI_INSTRUCTIONS_AVX512;
/// t = 1/2 c w s, s = e/\|xi\|: PMB, generalised \[P\] A, \[T\] 1.23
pub const LAW_BOND_BASED: i32 = sys::PERI_LAW_BOND_BASED;
/// t = (w/m)(A theta \|xi\| + B e) \[T\] 1.54, 1.67, \[C\] 2-7
pub const LAW_LPS: i32 = sys::PERI_LAW_LPS;
/// t = 2 w (a d theta + b e), on each family \[C\] 8-17
pub const LAW_OTERKUS: i32 = sys::PERI_LAW_OTERKUS;
/// T = w P K^-1 xi, stabilised \[C\] 18-21
pub const LAW_CORRESPONDENCE: i32 = sys::PERI_LAW_CORRESPONDENCE;
/// s \> s0 \[T\] 1.40, 1.41
pub const CRITERION_STRETCH: i32 = sys::PERI_CRITERION_STRETCH;
/// state-based: work on the bond \> w0 \[T\] 1.100
pub const CRITERION_BOND_ENERGY: i32 = sys::PERI_CRITERION_BOND_ENERGY;
/// state-based: mean energy of both ends \> w0 \[T\] 1.102
pub const CRITERION_NODE_ENERGY: i32 = sys::PERI_CRITERION_NODE_ENERGY;
/// tension along the bond \> strength
pub const CRITERION_PRINCIPAL_STRESS: i32 = sys::PERI_CRITERION_PRINCIPAL_STRESS;
/// von Mises's \> strength; shortened bonds, too
pub const CRITERION_VON_MISES: i32 = sys::PERI_CRITERION_VON_MISES;
/// shear \> cohesion - tan(friction\_angle) normal
pub const CRITERION_MOHR_COULOMB: i32 = sys::PERI_CRITERION_MOHR_COULOMB;
/// s \> s0 - compression \* least s at either end
pub const CRITERION_CONFINED_STRETCH: i32 = sys::PERI_CRITERION_CONFINED_STRETCH;
/// s \> s0 (1 + (ds/dt / rate)^rate\_power)
pub const CRITERION_RATE_STRETCH: i32 = sys::PERI_CRITERION_RATE_STRETCH;
/// s \> s0 for \`delay\` in all
pub const CRITERION_DELAYED_STRETCH: i32 = sys::PERI_CRITERION_DELAYED_STRETCH;
/// straight
pub const SOFTENING_BILINEAR: i32 = sys::PERI_SOFTENING_BILINEAR;
/// kinked at 1/4 of the strength: concrete
pub const SOFTENING_TRILINEAR: i32 = sys::PERI_SOFTENING_TRILINEAR;
/// cut off at 1/100 of the strength
pub const SOFTENING_EXPONENTIAL: i32 = sys::PERI_SOFTENING_EXPONENTIAL;
/// a table of yours
pub const SOFTENING_TABLE: i32 = sys::PERI_SOFTENING_TABLE;
/// to the origin: damage
pub const UNLOADING_SECANT: i32 = sys::PERI_UNLOADING_SECANT;
/// as stiff as new: a stretch stays
pub const UNLOADING_ELASTIC: i32 = sys::PERI_UNLOADING_ELASTIC;
pub const REDUCTION_SUM: i32 = sys::PERI_REDUCTION_SUM;
pub const REDUCTION_MAX: i32 = sys::PERI_REDUCTION_MAX;
/// an initial crack: stays at peri\_reset. Only before the first step
pub const CUT_INITIAL: i32 = sys::PERI_CUT_INITIAL;
/// counts as broken, whole again at peri\_reset
pub const CUT_NOW: i32 = sys::PERI_CUT_NOW;
/// as PERI\_CUT\_NOW, where the body is now: by current positions
pub const CUT_IN_PLACE: i32 = sys::PERI_CUT_IN_PLACE;
pub const AXIS_X: i32 = sys::PERI_AXIS_X;
pub const AXIS_Y: i32 = sys::PERI_AXIS_Y;
pub const AXIS_Z: i32 = sys::PERI_AXIS_Z;
pub const AXIS_XY: i32 = sys::PERI_AXIS_XY;
pub const AXIS_XYZ: i32 = sys::PERI_AXIS_XYZ;
/// all behind the plane through 0 with \`normal\`
pub const SHAPE_PLANE: i32 = sys::PERI_SHAPE_PLANE;
/// radius; 2D: a disc
pub const SHAPE_BALL: i32 = sys::PERI_SHAPE_BALL;
/// size, about 0
pub const SHAPE_BOX: i32 = sys::PERI_SHAPE_BOX;
/// within radius of a line of \`length\` along \`axis\`, about 0
pub const SHAPE_CAPSULE: i32 = sys::PERI_SHAPE_CAPSULE;
/// 3D: the same with flat ends
pub const SHAPE_CYLINDER: i32 = sys::PERI_SHAPE_CYLINDER;
/// within the closed surface of vertices and faces
pub const SHAPE_MESH: i32 = sys::PERI_SHAPE_MESH;
/// where \`distance\` is below 0
pub const SHAPE_DISTANCE: i32 = sys::PERI_SHAPE_DISTANCE;
/// half kick, drift, force, half kick \[T\] 2.2
pub const INTEGRATOR_VELOCITY_VERLET: i32 = sys::PERI_INTEGRATOR_VELOCITY_VERLET;
/// one kick per step, the same motion \[L\], \[T\] 2.10
pub const INTEGRATOR_CENTRAL_DIFFERENCE: i32 = sys::PERI_INTEGRATOR_CENTRAL_DIFFERENCE;
/// conjugate gradients on the tangent, never stored
pub const METHOD_NEWTON: i32 = sys::PERI_METHOD_NEWTON;
/// on the assembled tangent (\[T\] 3.2): for comparison
pub const METHOD_BICGSTAB: i32 = sys::PERI_METHOD_BICGSTAB;
/// adaptive dynamic relaxation: slow, any tangent
pub const METHOD_RELAXATION: i32 = sys::PERI_METHOD_RELAXATION;
/// blocks, and elasticity on background grids
pub const PRECONDITIONER_MULTILEVEL: i32 = sys::PERI_PRECONDITIONER_MULTILEVEL;
/// the dim x dim blocks of the diagonal
pub const PRECONDITIONER_BLOCK_JACOBI: i32 = sys::PERI_PRECONDITIONER_BLOCK_JACOBI;
pub const PRECONDITIONER_NONE: i32 = sys::PERI_PRECONDITIONER_NONE;
/// PERI\_ERROR\_LOOSE, index: a point of it; see lost\_parts
pub const LOOSE_REFUSED: i32 = sys::PERI_LOOSE_REFUSED;
/// just enough is held; exact where loads balance
pub const LOOSE_PINNED: i32 = sys::PERI_LOOSE_PINNED;
/// the part of the loads that drives the mode is left out
pub const LOOSE_BALANCED: i32 = sys::PERI_LOOSE_BALANCED;
/// the load steps
pub const CONTROL_LOAD: i32 = sys::PERI_CONTROL_LOAD;
/// where the next bond meets its criterion: through snap-back
pub const CONTROL_FRACTURE: i32 = sys::PERI_CONTROL_FRACTURE;
/// load\_to is reached
pub const ENDED_LOAD: i32 = sys::PERI_ENDED_LOAD;
/// a part that bears a load or a support broke off
pub const ENDED_SEVERED: i32 = sys::PERI_ENDED_SEVERED;
pub const ENDED_BREAKS: i32 = sys::PERI_ENDED_BREAKS;
pub const ENDED_STOPPED: i32 = sys::PERI_ENDED_STOPPED;
/// S \[dim\] reference position \[L\]
pub const FIELD_POSITION: i32 = sys::PERI_FIELD_POSITION;
/// SW \[dim\] \[L\]
pub const FIELD_DISPLACEMENT: i32 = sys::PERI_FIELD_DISPLACEMENT;
/// SW \[dim\] \[L T^-1\]
pub const FIELD_VELOCITY: i32 = sys::PERI_FIELD_VELOCITY;
/// S \[dim\] internal, loads, obstacles, contact
pub const FIELD_FORCE_DENSITY: i32 = sys::PERI_FIELD_FORCE_DENSITY;
/// S \[L^3\]; planes: area \[L^2\]
pub const FIELD_VOLUME: i32 = sys::PERI_FIELD_VOLUME;
/// PERI\_ID\_INDEX of the material
pub const FIELD_MATERIAL: i32 = sys::PERI_FIELD_MATERIAL;
/// bonds of the point, broken ones included
pub const FIELD_FAMILY_SIZE: i32 = sys::PERI_FIELD_FAMILY_SIZE;
/// 1 - intact/all volume of the family \[-\] \[L\]
pub const FIELD_DAMAGE: i32 = sys::PERI_FIELD_DAMAGE;
/// the same among bonds that are not initial cracks
pub const FIELD_DAMAGE_GROWN: i32 = sys::PERI_FIELD_DAMAGE_GROWN;
/// elastic W of the law \[M L^-1 T^-2\] \[P\] eq. 7
pub const FIELD_ENERGY_DENSITY: i32 = sys::PERI_FIELD_ENERGY_DENSITY;
/// \[dim\] \[L\]
pub const FIELD_CURRENT_POSITION: i32 = sys::PERI_FIELD_CURRENT_POSITION;
/// theta of the law \[-\]
pub const FIELD_DILATATION: i32 = sys::PERI_FIELD_DILATATION;
/// \[tensor\] of F: small, or Green-Lagrange \[T\] 4.14
pub const FIELD_STRAIN: i32 = sys::PERI_FIELD_STRAIN;
/// \[tensor\] Cauchy, of the material \[M L^-1 T^-2\]
pub const FIELD_STRESS: i32 = sys::PERI_FIELD_STRESS;
/// \[tensor\] Cauchy, what the bonds carry \[T\] 4.10, 4.13
pub const FIELD_FORCE_STRESS: i32 = sys::PERI_FIELD_FORCE_STRESS;
/// \[dim\] force density of supports, mean of the last step
pub const FIELD_REACTION: i32 = sys::PERI_FIELD_REACTION;
/// peri\_find\_fragments
pub const FIELD_FRAGMENT: i32 = sys::PERI_FIELD_FRAGMENT;
/// \[M\]; planes: thickness included
pub const FIELD_MASS: i32 = sys::PERI_FIELD_MASS;
/// W \[M L^-3\] Default: of the material
pub const FIELD_DENSITY: i32 = sys::PERI_FIELD_DENSITY;
/// \[dim\] 1: a support prescribes it; else 0
pub const FIELD_HELD: i32 = sys::PERI_FIELD_HELD;
/// W stretch at no force \[-\] -0.9..10. Default 0
pub const FIELD_EIGENSTRAIN: i32 = sys::PERI_FIELD_EIGENSTRAIN;
/// W times s0, squared times w0 \[-\] 1e-6..1e6. Default 1
pub const FIELD_STRENGTH: i32 = sys::PERI_FIELD_STRENGTH;
/// W times E \[-\] 1e-6..1e6. Default 1
pub const FIELD_STIFFNESS: i32 = sys::PERI_FIELD_STIFFNESS;
/// \[dim\*dim\] F by rows
pub const FIELD_DEFORMATION_GRADIENT: i32 = sys::PERI_FIELD_DEFORMATION_GRADIENT;
pub const TYPE_F64: i32 = sys::PERI_TYPE_F64;
pub const TYPE_F32: i32 = sys::PERI_TYPE_F32;
pub const TYPE_I32: i32 = sys::PERI_TYPE_I32;
/// i
pub const BOND_POINT: i32 = sys::PERI_BOND_POINT;
/// j
pub const BOND_OTHER: i32 = sys::PERI_BOND_OTHER;
/// \|xi\| \[L\]
pub const BOND_LENGTH: i32 = sys::PERI_BOND_LENGTH;
/// beta V\_j \[L^3\]
pub const BOND_VOLUME: i32 = sys::PERI_BOND_VOLUME;
/// w beta V\_j, corrected
pub const BOND_WEIGHT: i32 = sys::PERI_BOND_WEIGHT;
/// 1 or 0
pub const BOND_INTACT: i32 = sys::PERI_BOND_INTACT;
/// \[-\]
pub const BOND_STRETCH: i32 = sys::PERI_BOND_STRETCH;
/// \[dim\] part of the force density of i
pub const BOND_FORCE: i32 = sys::PERI_BOND_FORCE;
/// and of the energy density
pub const BOND_ENERGY: i32 = sys::PERI_BOND_ENERGY;
/// peri\_add\_box
pub const SOURCE_BOX: i32 = sys::PERI_SOURCE_BOX;
/// peri\_add\_perturbed\_box
pub const SOURCE_PERTURBED: i32 = sys::PERI_SOURCE_PERTURBED;
/// peri\_add\_points: a cloud, about one point to a cell
pub const SOURCE_POINTS: i32 = sys::PERI_SOURCE_POINTS;
/// stiffness; the least thickness that carries
pub const QUANTITY_DEFORMATION: i32 = sys::PERI_QUANTITY_DEFORMATION;
/// around holes and notches; the radius
pub const QUANTITY_STRESS: i32 = sys::PERI_QUANTITY_STRESS;
/// their way; the shortest wavelength
pub const QUANTITY_WAVES: i32 = sys::PERI_QUANTITY_WAVES;
/// when cracks grow; the crack's length, 8 spacings or more
pub const QUANTITY_FRACTURE: i32 = sys::PERI_QUANTITY_FRACTURE;
pub const PRESET_NONE: i32 = sys::PERI_PRESET_NONE;
/// 20 %
pub const PRESET_GAME: i32 = sys::PERI_PRESET_GAME;
/// 10 %
pub const PRESET_TEACHING: i32 = sys::PERI_PRESET_TEACHING;
/// 5 %
pub const PRESET_ENGINEERING: i32 = sys::PERI_PRESET_ENGINEERING;
/// deformation 1 %, stress 2 %, waves and fracture 3 %
pub const PRESET_REFERENCE: i32 = sys::PERI_PRESET_REFERENCE;

/// Points whose stress is asked for; matrices by rows, out: to be written.
pub type StressBlock = sys::peri_stress_block;
/// Bonds of one point to others\[\]: arrays of \`count\`. All that is written is 0 at first.
pub type BondRow = sys::peri_bond_row;

pub struct BodyDesc {
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
    /// \[L\] \> 0. Required. 3 to 4 spacings
    pub horizon: f64,
    /// \[L\] \> 0, of planes. Default 1
    pub thickness: f64,
    /// for PERI\_INFLUENCE\_USER (q, w)
    pub influence_fn: Option<Box<dyn Fn(f64, &mut f64) -> i32 + Send + Sync>>,
    /// Default NULL: silent (level, text)
    pub log: Option<Box<dyn Fn(i32, &str) + Send + Sync>>,
}

impl BodyDesc {
    /// The defaults.
    pub fn new() -> Self {
        let raw = Self::start();
        Self {
            space: raw.space,
            precision: raw.precision,
            geometry: raw.geometry,
            influence: raw.influence,
            quadrature: raw.quadrature,
            correction: raw.correction,
            break_timing: raw.break_timing,
            moments: raw.moments,
            kernel: raw.kernel,
            instructions: raw.instructions,
            threads: raw.threads,
            ledger: raw.ledger,
            number: raw.number,
            horizon: raw.horizon,
            thickness: raw.thickness,
            influence_fn: None,
            log: None,
        }
    }
    fn start() -> sys::peri_body_desc {
        let mut raw = std::mem::MaybeUninit::<sys::peri_body_desc>::zeroed();
        unsafe {
            sys::peri_body_desc_init(raw.as_mut_ptr());
            raw.assume_init()
        }
    }
    #[allow(unused_mut)]
    fn raw(&self) -> sys::peri_body_desc {
        let mut raw = Self::start();
        raw.space = self.space;
        raw.precision = self.precision;
        raw.geometry = self.geometry;
        raw.influence = self.influence;
        raw.quadrature = self.quadrature;
        raw.correction = self.correction;
        raw.break_timing = self.break_timing;
        raw.moments = self.moments;
        raw.kernel = self.kernel;
        raw.instructions = self.instructions;
        raw.threads = self.threads;
        raw.ledger = self.ledger;
        raw.number = self.number;
        raw.horizon = self.horizon;
        raw.thickness = self.thickness;
        raw
    }
    fn take(&mut self, raw: &sys::peri_body_desc) {
        self.space = raw.space;
        self.precision = raw.precision;
        self.geometry = raw.geometry;
        self.influence = raw.influence;
        self.quadrature = raw.quadrature;
        self.correction = raw.correction;
        self.break_timing = raw.break_timing;
        self.moments = raw.moments;
        self.kernel = raw.kernel;
        self.instructions = raw.instructions;
        self.threads = raw.threads;
        self.ledger = raw.ledger;
        self.number = raw.number;
        self.horizon = raw.horizon;
        self.thickness = raw.thickness;
    }
}

impl Default for BodyDesc {
    fn default() -> Self {
        Self::new()
    }
}

struct BodyDescInfluenceUser {
    influence_fn: Option<Box<dyn Fn(f64, &mut f64) -> i32 + Send + Sync>>,
}

impl BodyDescInfluenceUser {
    unsafe extern "C" fn influence_fn_c(user: *mut c_void, q: f64, w: *mut f64) -> i32 {
        let this = unsafe { &*(user as *const BodyDescInfluenceUser) };
        guarded(|| unsafe { if let Some(f) = this.influence_fn.as_ref() { f(q, &mut *w) } else { -1 } })
    }
    fn fill(&self, raw: &mut sys::peri_body_desc, user: *mut c_void) {
        raw.influence_user = user;
        if self.influence_fn.is_some() {
            raw.influence_fn = Some(Self::influence_fn_c);
        }
    }
}

struct BodyDescLogUser {
    log: Option<Box<dyn Fn(i32, &str) + Send + Sync>>,
}

impl BodyDescLogUser {
    unsafe extern "C" fn log_c(user: *mut c_void, level: i32, text: *const c_char) {
        let this = unsafe { &*(user as *const BodyDescLogUser) };
        guarded(|| unsafe { if let Some(f) = this.log.as_ref() { f(level, constant(text)); 0 } else { 0 } });
    }
    fn fill(&self, raw: &mut sys::peri_body_desc, user: *mut c_void) {
        raw.log_user = user;
        if self.log.is_some() {
            raw.log = Some(Self::log_c);
        }
    }
}

pub struct MaterialDesc {
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
    /// correspondence: yours. Default NULL (block)
    pub stress: Option<Box<dyn Fn(&sys::peri_stress_block) -> i32 + Send + Sync>>,
}

impl MaterialDesc {
    /// The defaults.
    pub fn new(law: i32) -> Self {
        let raw = Self::start(law);
        Self {
            law: raw.law,
            criterion: raw.criterion,
            young: raw.young,
            bulk: raw.bulk,
            poisson: raw.poisson,
            density: raw.density,
            fracture_energy: raw.fracture_energy,
            critical_stretch: raw.critical_stretch,
            stabilization: raw.stabilization,
            strength: raw.strength,
            cohesion: raw.cohesion,
            friction_angle: raw.friction_angle,
            compression: raw.compression,
            rate: raw.rate,
            rate_power: raw.rate_power,
            delay: raw.delay,
            yield_shear: raw.yield_shear,
            relaxations: raw.relaxations,
            history: raw.history,
            relaxation_part: raw.relaxation_part,
            relaxation_time: raw.relaxation_time,
            stress: None,
        }
    }
    fn start(law: i32) -> sys::peri_material_desc {
        let mut raw = std::mem::MaybeUninit::<sys::peri_material_desc>::zeroed();
        unsafe {
            sys::peri_material_desc_init(raw.as_mut_ptr(), law);
            raw.assume_init()
        }
    }
    #[allow(unused_mut)]
    fn raw(&self) -> sys::peri_material_desc {
        let mut raw = Self::start(self.law);
        raw.law = self.law;
        raw.criterion = self.criterion;
        raw.young = self.young;
        raw.bulk = self.bulk;
        raw.poisson = self.poisson;
        raw.density = self.density;
        raw.fracture_energy = self.fracture_energy;
        raw.critical_stretch = self.critical_stretch;
        raw.stabilization = self.stabilization;
        raw.strength = self.strength;
        raw.cohesion = self.cohesion;
        raw.friction_angle = self.friction_angle;
        raw.compression = self.compression;
        raw.rate = self.rate;
        raw.rate_power = self.rate_power;
        raw.delay = self.delay;
        raw.yield_shear = self.yield_shear;
        raw.relaxations = self.relaxations;
        raw.history = self.history;
        raw.relaxation_part = self.relaxation_part;
        raw.relaxation_time = self.relaxation_time;
        raw
    }
    fn take(&mut self, raw: &sys::peri_material_desc) {
        self.law = raw.law;
        self.criterion = raw.criterion;
        self.young = raw.young;
        self.bulk = raw.bulk;
        self.poisson = raw.poisson;
        self.density = raw.density;
        self.fracture_energy = raw.fracture_energy;
        self.critical_stretch = raw.critical_stretch;
        self.stabilization = raw.stabilization;
        self.strength = raw.strength;
        self.cohesion = raw.cohesion;
        self.friction_angle = raw.friction_angle;
        self.compression = raw.compression;
        self.rate = raw.rate;
        self.rate_power = raw.rate_power;
        self.delay = raw.delay;
        self.yield_shear = raw.yield_shear;
        self.relaxations = raw.relaxations;
        self.history = raw.history;
        self.relaxation_part = raw.relaxation_part;
        self.relaxation_time = raw.relaxation_time;
    }
}

struct MaterialDescStressUser {
    stress: Option<Box<dyn Fn(&sys::peri_stress_block) -> i32 + Send + Sync>>,
}

impl MaterialDescStressUser {
    unsafe extern "C" fn stress_c(user: *mut c_void, block: *const sys::peri_stress_block) -> i32 {
        let this = unsafe { &*(user as *const MaterialDescStressUser) };
        guarded(|| unsafe { if let Some(f) = this.stress.as_ref() { f(&*block) } else { -1 } })
    }
    fn fill(&self, raw: &mut sys::peri_material_desc, user: *mut c_void) {
        raw.stress_user = user;
        if self.stress.is_some() {
            raw.stress = Some(Self::stress_c);
        }
    }
}

pub struct SofteningDesc<'a> {
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
    /// \[count\*2\] stretch past the strength, of any scale, from 0 ascending; force over the strength, from 1 to 0, descending
    pub table: &'a [f64],
}

impl<'a> SofteningDesc<'a> {
    /// The defaults.
    pub fn new(shape: i32) -> Self {
        let raw = Self::start(shape);
        Self {
            shape: raw.shape,
            unloading: raw.unloading,
            strength: raw.strength,
            fracture_energy: raw.fracture_energy,
            compression: raw.compression,
            table: &[],
        }
    }
    fn start(shape: i32) -> sys::peri_softening_desc {
        let mut raw = std::mem::MaybeUninit::<sys::peri_softening_desc>::zeroed();
        unsafe {
            sys::peri_softening_desc_init(raw.as_mut_ptr(), shape);
            raw.assume_init()
        }
    }
    #[allow(unused_mut)]
    fn raw(&self, _dim: i64) -> sys::peri_softening_desc {
        let mut raw = Self::start(self.shape);
        raw.shape = self.shape;
        raw.unloading = self.unloading;
        raw.strength = self.strength;
        raw.fracture_energy = self.fracture_energy;
        raw.compression = self.compression;
        raw.table = self.table.as_ptr();
        raw.count = self.table.len() as i64 / 2;
        raw
    }
}

/// Cells: polygons, convex or not; tetrahedra, pyramids, wedges, hexahedra (4, 5, 6, 8 corners) in VTK's order, or mirrored.
pub struct CellsDesc<'a> {
    /// \[vertex\_count\*vertex\_stride\] \[L\]
    pub vertices: &'a [f64],
    /// Default 0: dim
    pub vertex_stride: i64,
    /// of cell 0, 1, ...
    pub corners: &'a [i32],
    /// \[cell\_count+1\] in corners\[\]. Default NULL: cell\_corners each
    pub offsets: &'a [i64],
    pub cell_corners: i32,
    /// \[cell\_count\]. Default NULL
    pub materials: &'a [i32],
}

impl<'a> CellsDesc<'a> {
    /// The defaults.
    pub fn new() -> Self {
        let raw = Self::start();
        Self {
            vertices: &[],
            vertex_stride: raw.vertex_stride,
            corners: &[],
            offsets: &[],
            cell_corners: raw.cell_corners,
            materials: &[],
        }
    }
    fn start() -> sys::peri_cells_desc {
        let mut raw = std::mem::MaybeUninit::<sys::peri_cells_desc>::zeroed();
        unsafe {
            sys::peri_cells_desc_init(raw.as_mut_ptr());
            raw.assume_init()
        }
    }
    #[allow(unused_mut)]
    fn raw(&self, _dim: i64) -> sys::peri_cells_desc {
        let mut raw = Self::start();
        raw.vertices = self.vertices.as_ptr();
        raw.vertex_count = self.vertices.len() as i64 / vertex_stride;
        raw.vertex_stride = self.vertex_stride;
        raw.corners = self.corners.as_ptr();
        raw.offsets = self.offsets.as_ptr();
        raw.cell_corners = self.cell_corners;
        raw.materials = self.materials.as_ptr();
        raw.cell_count = self.materials.len() as i64 / 1;
        raw
    }
}

impl<'a> Default for CellsDesc<'a> {
    fn default() -> Self {
        Self::new()
    }
}

/// Ghosts: copies of points that other parts own, peri\_ghost\_depth horizons deep. They bear no load and are in no set, sum or
/// count. Give them all else that their owners have: cuts, motion.
pub struct PartDesc<'a> {
    /// \[L\] any; this and the next two alike on all parts. Required
    pub origin: [f64; 3],
    /// \[L\] \> 0: the spacing; that of boxes to a factor of 16
    pub length: f64,
    /// \[L^3\] \> 0, planes \[L^2\], of a point
    pub mean_volume: f64,
    /// \[ghost\_count\] points, ascending
    pub ghosts: &'a [i32],
    /// \[ghost\_count\] the point that it is an image of in a periodic body, or -1. Default NULL: none is
    pub owners: &'a [i32],
    /// \[points\] in the whole body, ascending. Default NULL: unknown
    pub ids: &'a [i64],
    /// where another part owns ghosts. Default NULL (type, planes, plane)
    pub exchange: Option<Box<dyn Fn(i32, i32, *mut *mut c_void) -> i32 + Send + Sync>>,
    /// of several parts. Default NULL (reduction, values)
    pub reduce: Option<Box<dyn Fn(i32, &mut [f64]) -> i32 + Send + Sync>>,
}

impl<'a> PartDesc<'a> {
    /// The defaults.
    pub fn new() -> Self {
        let raw = Self::start();
        Self {
            origin: raw.origin,
            length: raw.length,
            mean_volume: raw.mean_volume,
            ghosts: &[],
            owners: &[],
            ids: &[],
            exchange: None,
            reduce: None,
        }
    }
    fn start() -> sys::peri_part_desc {
        let mut raw = std::mem::MaybeUninit::<sys::peri_part_desc>::zeroed();
        unsafe {
            sys::peri_part_desc_init(raw.as_mut_ptr());
            raw.assume_init()
        }
    }
    #[allow(unused_mut)]
    fn raw(&self, _dim: i64) -> sys::peri_part_desc {
        let mut raw = Self::start();
        raw.origin = self.origin;
        raw.length = self.length;
        raw.mean_volume = self.mean_volume;
        raw.ghosts = self.ghosts.as_ptr();
        raw.ghost_count = self.ghosts.len() as i64 / 1;
        raw.owners = self.owners.as_ptr();
        raw.ghost_count = self.owners.len() as i64 / 1;
        raw.ids = self.ids.as_ptr();
        raw
    }
}

impl<'a> Default for PartDesc<'a> {
    fn default() -> Self {
        Self::new()
    }
}

struct PartDescUser {
    exchange: Option<Box<dyn Fn(i32, i32, *mut *mut c_void) -> i32 + Send + Sync>>,
    reduce: Option<Box<dyn Fn(i32, &mut [f64]) -> i32 + Send + Sync>>,
}

impl PartDescUser {
    unsafe extern "C" fn exchange_c(user: *mut c_void, r#type: i32, planes: i32, plane: *mut *mut c_void) -> i32 {
        let this = unsafe { &*(user as *const PartDescUser) };
        guarded(|| unsafe { if let Some(f) = this.exchange.as_ref() { f(r#type, planes, plane) } else { -1 } })
    }
    unsafe extern "C" fn reduce_c(user: *mut c_void, reduction: i32, count: i64, values: *mut f64) -> i32 {
        let this = unsafe { &*(user as *const PartDescUser) };
        guarded(|| unsafe { if let Some(f) = this.reduce.as_ref() { f(reduction, slice_mut(values, count)) } else { -1 } })
    }
    fn fill(&self, raw: &mut sys::peri_part_desc, user: *mut c_void) {
        raw.user = user;
        if self.exchange.is_some() {
            raw.exchange = Some(Self::exchange_c);
        }
        if self.reduce.is_some() {
            raw.reduce = Some(Self::reduce_c);
        }
    }
}
/// A rigid body of point masses; in 2D vectors end with 0.
pub type Fragment = sys::peri_fragment;

/// Pushes points within it out along the normal by stiffness\*depth \[M L^-2 T^-2\]. A free one (of a mass) is moved by that and by
/// gravity, not by other obstacles.
pub struct ObstacleDesc<'a> {
    /// peri\_shape, set by init
    pub shape: i32,
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
    /// \[vertex\_count\*dim\] \[L\]; 2D: of a polygon, counter-clockwise
    pub vertices: &'a [f64],
    /// 3D: \[face\_count\*3\], counter-clockwise from outside
    pub faces: &'a [i32],
    /// (x, distance, normal)
    pub distance: Option<Box<dyn Fn(&[f64], &mut f64, &mut [f64]) -> i32 + Send + Sync>>,
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
    /// of others. Default NULL: at rest (time, place, turn)
    pub motion: Option<Box<dyn Fn(f64, &mut [f64], &mut [f64]) -> i32 + Send + Sync>>,
}

impl<'a> ObstacleDesc<'a> {
    /// The defaults.
    pub fn new(shape: i32) -> Self {
        let raw = Self::start(shape);
        Self {
            shape: raw.shape,
            place: raw.place,
            turn: raw.turn,
            normal: raw.normal,
            axis: raw.axis,
            radius: raw.radius,
            length: raw.length,
            size: raw.size,
            vertices: &[],
            faces: &[],
            distance: None,
            stiffness: raw.stiffness,
            friction: raw.friction,
            friction_speed: raw.friction_speed,
            restitution: raw.restitution,
            mass: raw.mass,
            density: raw.density,
            inertia: raw.inertia,
            velocity: raw.velocity,
            spin: raw.spin,
            gravity: raw.gravity,
            motion: None,
        }
    }
    fn start(shape: i32) -> sys::peri_obstacle_desc {
        let mut raw = std::mem::MaybeUninit::<sys::peri_obstacle_desc>::zeroed();
        unsafe {
            sys::peri_obstacle_desc_init(raw.as_mut_ptr(), shape);
            raw.assume_init()
        }
    }
    #[allow(unused_mut)]
    fn raw(&self, dim: i64) -> sys::peri_obstacle_desc {
        let mut raw = Self::start(self.shape);
        raw.shape = self.shape;
        raw.place = self.place;
        raw.turn = self.turn;
        raw.normal = self.normal;
        raw.axis = self.axis;
        raw.radius = self.radius;
        raw.length = self.length;
        raw.size = self.size;
        raw.vertices = self.vertices.as_ptr();
        raw.vertex_count = self.vertices.len() as i64 / dim;
        raw.faces = self.faces.as_ptr();
        raw.face_count = self.faces.len() as i64 / 3;
        raw.stiffness = self.stiffness;
        raw.friction = self.friction;
        raw.friction_speed = self.friction_speed;
        raw.restitution = self.restitution;
        raw.mass = self.mass;
        raw.density = self.density;
        raw.inertia = self.inertia;
        raw.velocity = self.velocity;
        raw.spin = self.spin;
        raw.gravity = self.gravity;
        raw
    }
}

struct ObstacleDescUser {
    dim: i64,
    distance: Option<Box<dyn Fn(&[f64], &mut f64, &mut [f64]) -> i32 + Send + Sync>>,
    motion: Option<Box<dyn Fn(f64, &mut [f64], &mut [f64]) -> i32 + Send + Sync>>,
}

impl ObstacleDescUser {
    unsafe extern "C" fn distance_c(user: *mut c_void, x: *const f64, distance: *mut f64, normal: *mut f64) -> i32 {
        let this = unsafe { &*(user as *const ObstacleDescUser) };
        guarded(|| unsafe { if let Some(f) = this.distance.as_ref() { f(slice(x, this.dim), &mut *distance, slice_mut(normal, this.dim)) } else { -1 } })
    }
    unsafe extern "C" fn motion_c(user: *mut c_void, time: f64, place: *mut f64, turn: *mut f64) -> i32 {
        let this = unsafe { &*(user as *const ObstacleDescUser) };
        guarded(|| unsafe { if let Some(f) = this.motion.as_ref() { f(time, slice_mut(place, this.dim), slice_mut(turn, 3*this.dim-5)) } else { -1 } })
    }
    fn fill(&self, raw: &mut sys::peri_obstacle_desc, user: *mut c_void) {
        raw.user = user;
        if self.distance.is_some() {
            raw.distance = Some(Self::distance_c);
        }
        if self.motion.is_some() {
            raw.motion = Some(Self::motion_c);
        }
    }
}
/// of its frame; components beyond dim are 0
pub type ObstacleState = sys::peri_obstacle_state;

/// Unbonded surface points: 1/2 k (d - r)^2 where r \< d = min(distance, \|xi\|), k = stiffness E V /(spacing distance)
pub struct ContactDesc {
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

impl ContactDesc {
    /// The defaults.
    pub fn new() -> Self {
        let raw = Self::start();
        Self {
            stiffness: raw.stiffness,
            distance: raw.distance,
            friction: raw.friction,
            friction_speed: raw.friction_speed,
            restitution: raw.restitution,
        }
    }
    fn start() -> sys::peri_contact_desc {
        let mut raw = std::mem::MaybeUninit::<sys::peri_contact_desc>::zeroed();
        unsafe {
            sys::peri_contact_desc_init(raw.as_mut_ptr());
            raw.assume_init()
        }
    }
    #[allow(unused_mut)]
    fn raw(&self) -> sys::peri_contact_desc {
        let mut raw = Self::start();
        raw.stiffness = self.stiffness;
        raw.distance = self.distance;
        raw.friction = self.friction;
        raw.friction_speed = self.friction_speed;
        raw.restitution = self.restitution;
        raw
    }
}

impl Default for ContactDesc {
    fn default() -> Self {
        Self::new()
    }
}

pub struct AdvanceDesc<'a> {
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
    /// Default NULL (body)
    pub on_frame: Option<&'a mut dyn FnMut(&Body) -> i32>,
}

impl<'a> AdvanceDesc<'a> {
    /// The defaults.
    pub fn new() -> Self {
        let raw = Self::start();
        Self {
            integrator: raw.integrator,
            force_step: raw.force_step,
            steps: raw.steps,
            duration: raw.duration,
            time_step: raw.time_step,
            safety: raw.safety,
            damping: raw.damping,
            load_factor: raw.load_factor,
            frame_steps: raw.frame_steps,
            on_frame: None,
        }
    }
    fn start() -> sys::peri_advance_desc {
        let mut raw = std::mem::MaybeUninit::<sys::peri_advance_desc>::zeroed();
        unsafe {
            sys::peri_advance_desc_init(raw.as_mut_ptr());
            raw.assume_init()
        }
    }
    #[allow(unused_mut)]
    fn raw(&self) -> sys::peri_advance_desc {
        let mut raw = Self::start();
        raw.integrator = self.integrator;
        raw.force_step = self.force_step;
        raw.steps = self.steps;
        raw.duration = self.duration;
        raw.time_step = self.time_step;
        raw.safety = self.safety;
        raw.damping = self.damping;
        raw.load_factor = self.load_factor;
        raw.frame_steps = self.frame_steps;
        raw
    }
}

impl<'a> Default for AdvanceDesc<'a> {
    fn default() -> Self {
        Self::new()
    }
}

struct AdvanceDescUser<'a> {
    owner: *const Body,
    on_frame: Option<&'a mut dyn FnMut(&Body) -> i32>,
}

impl AdvanceDescUser<'_> {
    unsafe extern "C" fn on_frame_c(user: *mut c_void, _body: *mut sys::peri_body) -> i32 {
        let this = unsafe { &mut *(user as *mut AdvanceDescUser) };
        guarded(|| unsafe { if let Some(f) = this.on_frame.as_mut() { f(&*this.owner) } else { -1 } })
    }
    fn fill(&self, raw: &mut sys::peri_advance_desc, user: *mut c_void) {
        raw.user = user;
        if self.on_frame.is_some() {
            raw.on_frame = Some(Self::on_frame_c);
        }
    }
}
pub type EvaluateReport = sys::peri_evaluate_report;

pub struct SolveDesc<'a> {
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
    pub curve: &'a mut [f64],
    /// Default NULL (iteration, residual)
    pub on_iteration: Option<&'a mut dyn FnMut(i64, f64) -> i32>,
    /// at each equilibrium, also after it cut. Default NULL (body)
    pub on_step: Option<&'a mut dyn FnMut(&Body) -> i32>,
}

impl<'a> SolveDesc<'a> {
    /// The defaults.
    pub fn new() -> Self {
        let raw = Self::start();
        Self {
            method: raw.method,
            preconditioner: raw.preconditioner,
            loose: raw.loose,
            fracture: raw.fracture,
            control: raw.control,
            curve_load: raw.curve_load,
            keep: raw.keep,
            criticality: raw.criticality,
            tolerance: raw.tolerance,
            energy_tolerance: raw.energy_tolerance,
            iterations: raw.iterations,
            newton: raw.newton,
            breaks: raw.breaks,
            load_from: raw.load_from,
            load_to: raw.load_to,
            steps: raw.steps,
            duration: raw.duration,
            halvings: raw.halvings,
            curve: &mut [],
            on_iteration: None,
            on_step: None,
        }
    }
    fn start() -> sys::peri_solve_desc {
        let mut raw = std::mem::MaybeUninit::<sys::peri_solve_desc>::zeroed();
        unsafe {
            sys::peri_solve_desc_init(raw.as_mut_ptr());
            raw.assume_init()
        }
    }
    #[allow(unused_mut)]
    fn raw(&mut self, dim: i64) -> sys::peri_solve_desc {
        let mut raw = Self::start();
        raw.method = self.method;
        raw.preconditioner = self.preconditioner;
        raw.loose = self.loose;
        raw.fracture = self.fracture;
        raw.control = self.control;
        raw.curve_load = self.curve_load;
        raw.keep = self.keep;
        raw.criticality = self.criticality;
        raw.tolerance = self.tolerance;
        raw.energy_tolerance = self.energy_tolerance;
        raw.iterations = self.iterations;
        raw.newton = self.newton;
        raw.breaks = self.breaks;
        raw.load_from = self.load_from;
        raw.load_to = self.load_to;
        raw.steps = self.steps;
        raw.duration = self.duration;
        raw.halvings = self.halvings;
        raw.curve = self.curve.as_mut_ptr();
        raw.curve_rows = self.curve.len() as i64 / (2 + 2*dim);
        raw
    }
}

impl<'a> Default for SolveDesc<'a> {
    fn default() -> Self {
        Self::new()
    }
}

struct SolveDescUser<'a> {
    owner: *const Body,
    on_iteration: Option<&'a mut dyn FnMut(i64, f64) -> i32>,
    on_step: Option<&'a mut dyn FnMut(&Body) -> i32>,
}

impl SolveDescUser<'_> {
    unsafe extern "C" fn on_iteration_c(user: *mut c_void, iteration: i64, residual: f64) -> i32 {
        let this = unsafe { &mut *(user as *mut SolveDescUser) };
        guarded(|| unsafe { if let Some(f) = this.on_iteration.as_mut() { f(iteration, residual) } else { -1 } })
    }
    unsafe extern "C" fn on_step_c(user: *mut c_void, _body: *mut sys::peri_body) -> i32 {
        let this = unsafe { &mut *(user as *mut SolveDescUser) };
        guarded(|| unsafe { if let Some(f) = this.on_step.as_mut() { f(&*this.owner) } else { -1 } })
    }
    fn fill(&self, raw: &mut sys::peri_solve_desc, user: *mut c_void) {
        raw.user = user;
        if self.on_iteration.is_some() {
            raw.on_iteration = Some(Self::on_iteration_c);
        }
        if self.on_step.is_some() {
            raw.on_step = Some(Self::on_step_c);
        }
    }
}
pub type SolveReport = sys::peri_solve_report;
/// The ledger \[M L^2 T^-2\], from build or reset on: initial + external + obstacle = kinetic + elastic + contact + damping +
/// fracture + error.
pub type Energy = sys::peri_energy;

pub struct CracksDesc {
    /// 1 (default): initial cracks, too
    pub initial: i32,
    /// 1: where the body is now. Default 0: reference positions
    pub current: i32,
    /// \[L\] \>= 0, 2D: leaves out shorter cracks and branches with a tip. NaN (default): the horizon
    pub shortest: f64,
}

impl CracksDesc {
    /// The defaults.
    pub fn new() -> Self {
        let raw = Self::start();
        Self {
            initial: raw.initial,
            current: raw.current,
            shortest: raw.shortest,
        }
    }
    fn start() -> sys::peri_cracks_desc {
        let mut raw = std::mem::MaybeUninit::<sys::peri_cracks_desc>::zeroed();
        unsafe {
            sys::peri_cracks_desc_init(raw.as_mut_ptr());
            raw.assume_init()
        }
    }
    #[allow(unused_mut)]
    fn raw(&self) -> sys::peri_cracks_desc {
        let mut raw = Self::start();
        raw.initial = self.initial;
        raw.current = self.current;
        raw.shortest = self.shortest;
        raw
    }
}

impl Default for CracksDesc {
    fn default() -> Self {
        Self::new()
    }
}
/// 2D: where a path ends within the body
pub type CrackTip = sys::peri_crack_tip;
/// Bytes that the body holds, as asked of its allocator. Solves and builds take more.
pub type Memory = sys::peri_memory;

/// a body that is only described: one material in a box
pub struct PlanDesc<'a> {
    /// Required
    pub body: Option<&'a BodyDesc>,
    /// Required
    pub material: Option<&'a MaterialDesc>,
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

impl<'a> PlanDesc<'a> {
    /// The defaults.
    pub fn new() -> Self {
        let raw = Self::start();
        Self {
            body: None,
            material: None,
            source: raw.source,
            measure: raw.measure,
            amount: raw.amount,
            lo: raw.lo,
            hi: raw.hi,
            spacing: raw.spacing,
        }
    }
    fn start() -> sys::peri_plan_desc {
        let mut raw = std::mem::MaybeUninit::<sys::peri_plan_desc>::zeroed();
        unsafe {
            sys::peri_plan_desc_init(raw.as_mut_ptr());
            raw.assume_init()
        }
    }
    #[allow(unused_mut)]
    fn raw(&self) -> sys::peri_plan_desc {
        let mut raw = Self::start();
        raw.source = self.source;
        raw.measure = self.measure;
        raw.amount = self.amount;
        raw.lo = self.lo;
        raw.hi = self.hi;
        raw.spacing = self.spacing;
        raw
    }
}

impl<'a> Default for PlanDesc<'a> {
    fn default() -> Self {
        Self::new()
    }
}
pub type PlanReport = sys::peri_plan_report;

/// a preset, or an error, at least cost; or a budget; or both
pub struct ChooseDesc {
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

impl ChooseDesc {
    /// The defaults.
    pub fn new() -> Self {
        let raw = Self::start();
        Self {
            preset: raw.preset,
            quantity: raw.quantity,
            error: raw.error,
            seconds: raw.seconds,
            bytes: raw.bytes,
            feature: raw.feature,
            lo: raw.lo,
            hi: raw.hi,
        }
    }
    fn start() -> sys::peri_choose_desc {
        let mut raw = std::mem::MaybeUninit::<sys::peri_choose_desc>::zeroed();
        unsafe {
            sys::peri_choose_desc_init(raw.as_mut_ptr());
            raw.assume_init()
        }
    }
    #[allow(unused_mut)]
    fn raw(&self) -> sys::peri_choose_desc {
        let mut raw = Self::start();
        raw.preset = self.preset;
        raw.quantity = self.quantity;
        raw.error = self.error;
        raw.seconds = self.seconds;
        raw.bytes = self.bytes;
        raw.feature = self.feature;
        raw.lo = self.lo;
        raw.hi = self.hi;
        raw
    }
}

impl Default for ChooseDesc {
    fn default() -> Self {
        Self::new()
    }
}

pub struct ChooseReport {
    /// \[L\] for peri\_add\_box
    pub spacing: f64,
    /// spacings across the feature
    pub across: f64,
    /// of the quantity, not above this
    pub error: f64,
    /// constant text: the choice in words
    pub text: &'static str,
    /// as peri\_plan says
    pub cost: sys::peri_plan_report,
}

impl ChooseReport {
    fn of(raw: &sys::peri_choose_report) -> Self {
        Self {
            spacing: raw.spacing,
            across: raw.across,
            error: raw.error,
            text: constant(raw.text),
            cost: raw.cost,
        }
    }
}

/// The defaults.
pub fn evaluate_desc() -> sys::peri_evaluate_desc {
    let mut raw = std::mem::MaybeUninit::<sys::peri_evaluate_desc>::zeroed();
    unsafe {
        sys::peri_evaluate_desc_init(raw.as_mut_ptr());
        raw.assume_init()
    }
}

struct PointFnHolder<'a> {
    dim: i64,
    call: Option<&'a mut dyn FnMut(i64, &[f64]) -> i32>,
}

impl PointFnHolder<'_> {
    unsafe extern "C" fn call_c(user: *mut c_void, index: i64, x: *const f64) -> i32 {
        let this = unsafe { &mut *(user as *mut PointFnHolder) };
        guarded(|| unsafe { if let Some(f) = this.call.as_mut() { f(index, slice(x, this.dim)) } else { -1 } })
    }
}

struct PairFnHolder<'a> {
    dim: i64,
    call: Option<&'a mut dyn FnMut(i32, i32, &[f64], &[f64]) -> i32>,
}

impl PairFnHolder<'_> {
    unsafe extern "C" fn call_c(user: *mut c_void, i: i32, j: i32, xi: *const f64, xj: *const f64) -> i32 {
        let this = unsafe { &mut *(user as *mut PairFnHolder) };
        guarded(|| unsafe { if let Some(f) = this.call.as_mut() { f(i, j, slice(xi, this.dim), slice(xj, this.dim)) } else { -1 } })
    }
}

struct LoadFnHolder {
    dim: i64,
    call: Option<Box<dyn Fn(f64, &[i32], &mut [f64]) -> i32 + Send + Sync>>,
}

impl LoadFnHolder {
    unsafe extern "C" fn call_c(user: *mut c_void, time: f64, count: i64, points: *const i32, value: *mut f64) -> i32 {
        let this = unsafe { &*(user as *const LoadFnHolder) };
        guarded(|| unsafe { if let Some(f) = this.call.as_ref() { f(time, slice(points, count), slice_mut(value, count*this.dim)) } else { -1 } })
    }
}

struct RigidFnHolder {
    dim: i64,
    call: Option<Box<dyn Fn(f64, &mut [f64]) -> i32 + Send + Sync>>,
}

impl RigidFnHolder {
    unsafe extern "C" fn call_c(user: *mut c_void, time: f64, motion: *mut f64) -> i32 {
        let this = unsafe { &*(user as *const RigidFnHolder) };
        guarded(|| unsafe { if let Some(f) = this.call.as_ref() { f(time, slice_mut(motion, this.dim+(2 * this.dim - 3))) } else { -1 } })
    }
}

struct BreakFnHolder {
    call: Option<Box<dyn Fn(i32, i32, f64, f64) -> i32 + Send + Sync>>,
}

impl BreakFnHolder {
    unsafe extern "C" fn call_c(user: *mut c_void, i: i32, j: i32, time: f64, stretch: f64) -> i32 {
        let this = unsafe { &*(user as *const BreakFnHolder) };
        guarded(|| unsafe { if let Some(f) = this.call.as_ref() { f(i, j, time, stretch) } else { -1 } })
    }
}

struct BondLawFnHolder {
    call: Option<Box<dyn Fn(&sys::peri_bond_row) -> i32 + Send + Sync>>,
}

impl BondLawFnHolder {
    unsafe extern "C" fn call_c(user: *mut c_void, row: *const sys::peri_bond_row) -> i32 {
        let this = unsafe { &*(user as *const BondLawFnHolder) };
        guarded(|| unsafe { if let Some(f) = this.call.as_ref() { f(&*row) } else { -1 } })
    }
}

struct WriteFnHolder<'a> {
    call: Option<&'a mut dyn FnMut(&[u8]) -> i32>,
}

impl WriteFnHolder<'_> {
    unsafe extern "C" fn call_c(user: *mut c_void, bytes: *const c_void, count: i64) -> i32 {
        let this = unsafe { &mut *(user as *mut WriteFnHolder) };
        guarded(|| unsafe { if let Some(f) = this.call.as_mut() { f(slice(bytes as *const u8, count)) } else { -1 } })
    }
}

struct ReadFnHolder<'a> {
    call: Option<&'a mut dyn FnMut(&mut [u8]) -> i32>,
}

impl ReadFnHolder<'_> {
    unsafe extern "C" fn call_c(user: *mut c_void, bytes: *mut c_void, count: i64) -> i32 {
        let this = unsafe { &mut *(user as *mut ReadFnHolder) };
        guarded(|| unsafe { if let Some(f) = this.call.as_mut() { f(slice_mut(bytes as *mut u8, count)) } else { -1 } })
    }
}

/// Owns a peri\_body.
pub struct Body {
    handle: *mut sys::peri_body,
    keep: Keep,
}

// Any thread may use it, one at a time.
unsafe impl Send for Body {}

impl Drop for Body {
    fn drop(&mut self) {
        unsafe { sys::peri_body_destroy(self.handle) }
    }
}

impl Body {
    pub fn new(desc: BodyDesc) -> Result<Self> {
        body_create(desc)
    }
    fn check(&self, result: i64) -> Result<()> {
        go_on();
        if result >= 0 {
            return Ok(());
        }
        let mut record = blank();
        unsafe { sys::peri_get_error(self.handle, &mut record) };
        Err(failed(result, &record))
    }
    /// An independent copy of a built body, state, loads and number included: ids hold in both. Points, families and weights are
    /// shared. error may be NULL.
    pub fn clone(&self) -> Result<Body> {
        let mut made = std::ptr::null_mut();
        let mut record = blank();
        let result = unsafe { sys::peri_body_clone(self.handle, &mut made, &mut record) };
        known(i64::from(result), &record)?;
        Ok(Body { handle: made, keep: self.keep.clone() })
    }
    /// After a callback was left by longjmp or an exception: ends the call that it came from, and frees its memory. The body may then
    /// be read, reset or destroyed; it runs again after peri\_reset. Never from within a callback. PERI\_ERROR\_ORDER where none was
    /// left. Memory hooks, job systems and what a measuring peri\_plan calls may not be left so.
    pub fn unlock(&self) -> Result<i32> {
        let result = unsafe { sys::peri_unlock(self.handle) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// The id of the index-th (1, 2, ...) thing of a peri\_kind, removed ones counted; or an error.
    pub fn id(&self, kind: i32, index: i64) -> Result<i32> {
        let result = unsafe { sys::peri_id(self.handle, kind, index) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// Adds a material, before peri\_build; at most 120. Returns its id, or an error.
    pub fn add_material(&self, desc: MaterialDesc) -> Result<i32> {
        let mut desc_raw = desc.raw();
        let stress_user_holder = Arc::new(MaterialDescStressUser { stress: desc.stress });
        stress_user_holder.fill(&mut desc_raw, Arc::as_ptr(&stress_user_holder) as *mut c_void);
        keep(&self.keep, stress_user_holder);
        let result = unsafe { sys::peri_add_material(self.handle, &desc_raw) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// Bonds between i and j break, and of bond-based i and j act, as if of \`desc\`, before peri\_build; its law is that of one of
    /// them, not bond-based unless both are. Default: harmonic mean of the micromoduli, the criteria of both.
    pub fn set_interface(&self, i: i32, j: i32, desc: MaterialDesc) -> Result<i32> {
        let mut desc_raw = desc.raw();
        let stress_user_holder = Arc::new(MaterialDescStressUser { stress: desc.stress });
        stress_user_holder.fill(&mut desc_raw, Arc::as_ptr(&stress_user_holder) as *mut c_void);
        keep(&self.keep, stress_user_holder);
        let result = unsafe { sys::peri_set_interface(self.handle, i, j, &desc_raw) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// Bonds between bond-based materials i and j (i, i: within one) soften, before peri\_build; their fracture\_energy and
    /// critical\_stretch do not count. PERI\_BRITTLE: the horizon is too large, bonds break at once at less than the strength and
    /// take the energy. docs/laws.md
    pub fn set_softening(&self, i: i32, j: i32, desc: &SofteningDesc) -> Result<i32> {
        let dim = i64::from(self.dimension());
        if desc.table.len() as i64 % (2) != 0 {
                    return Err(refused("table"));
                }
        let desc_raw = desc.raw(dim);
        let result = unsafe { sys::peri_set_softening(self.handle, i, j, &desc_raw) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// The stretch at which bonds begin to soften, and that at which they break; after peri\_build. PERI\_BRITTLE: they are one.
    /// Either may be NULL.
    pub fn get_softening(&self, i: i32, j: i32, first: Option<&mut f64>, last: Option<&mut f64>) -> Result<i32> {
        let result = unsafe { sys::peri_get_softening(self.handle, i, j, first.map_or(std::ptr::null_mut(), |a| a as *mut _), last.map_or(std::ptr::null_mut(), |a| a as *mut _)) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// Bonds between bond-based materials i and j follow fn, each with \`states\` (0..8) numbers of its own, 0 at first; before
    /// peri\_build. Their critical stretch holds, too. docs/laws.md
    pub fn set_bond_law(&self, i: i32, j: i32, states: i32, r#fn: Option<Box<dyn Fn(&sys::peri_bond_row) -> i32 + Send + Sync>>) -> Result<i32> {
        let call_c: sys::peri_bond_law_fn = if r#fn.is_some() { Some(BondLawFnHolder::call_c) } else { None };
        let holder = Arc::new(BondLawFnHolder { call: r#fn });
        let user = Arc::as_ptr(&holder) as *mut c_void;
        if call_c.is_some() {
                    keep(&self.keep, holder.clone());
                }
        let result = unsafe { sys::peri_set_bond_law(self.handle, i, j, states, call_c, user) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// Micromodulus c \[M L^-5 T^-2\] (bond-based only, else NULL) and critical stretch s0 \[-\] (HUGE\_VAL: never; softening: where
    /// they break, after peri\_build) of bonds between materials i and j. Either may be NULL. (\[P\] C.15-C.20, \[T\] 1.24, 1.40)
    pub fn get_bond_constants(&self, i: i32, j: i32, c: Option<&mut f64>, s0: Option<&mut f64>) -> Result<i32> {
        let result = unsafe { sys::peri_get_bond_constants(self.handle, i, j, c.map_or(std::ptr::null_mut(), |a| a as *mut _), s0.map_or(std::ptr::null_mut(), |a| a as *mut _)) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// Critical bond energy w0 \[M L^-4 T^-2\] of a material whose criterion is an energy; HUGE\_VAL: none.
    /// PERI\_CRITERION\_NODE\_ENERGY: after peri\_build.
    pub fn get_critical_energy(&self, material: i32) -> Result<f64> {
        let mut w0 = 0.0;
        let result = unsafe { sys::peri_get_critical_energy(self.handle, material, &mut w0) };
        self.check(i64::from(result))?;
        Ok(w0)
    }
    /// The box lo\[dim\]..hi\[dim\] in cells of about \`spacing\` \[L\], which tile it.
    pub fn add_box(&self, material: i32, lo: &[f64], hi: &[f64], spacing: f64) -> Result<i64> {
        sized(lo.len(), i64::from(self.dimension()), "lo")?;
        sized(hi.len(), i64::from(self.dimension()), "hi")?;
        let result = unsafe { sys::peri_add_box(self.handle, material, lo.as_ptr(), hi.as_ptr(), spacing) };
        self.check(result)?;
        Ok(result)
    }
    /// The box in cells\[dim\] cells per axis.
    pub fn add_grid(&self, material: i32, lo: &[f64], hi: &[f64], cells: &[i32]) -> Result<i64> {
        sized(lo.len(), i64::from(self.dimension()), "lo")?;
        sized(hi.len(), i64::from(self.dimension()), "hi")?;
        sized(cells.len(), i64::from(self.dimension()), "cells")?;
        let result = unsafe { sys::peri_add_grid(self.handle, material, lo.as_ptr(), hi.as_ptr(), cells.as_ptr()) };
        self.check(result)?;
        Ok(result)
    }
    /// The lattice cells whose centre is within \`radius\` of \`centre\`: a ball, in 2D a disc.
    pub fn add_ball(&self, material: i32, centre: &[f64], radius: f64, spacing: f64) -> Result<i64> {
        sized(centre.len(), i64::from(self.dimension()), "centre")?;
        let result = unsafe { sys::peri_add_ball(self.handle, material, centre.as_ptr(), radius, spacing) };
        self.check(result)?;
        Ok(result)
    }
    /// The lattice cells of the box whose centre \`inside\` takes.
    pub fn add_shape(&self, material: i32, lo: &[f64], hi: &[f64], spacing: f64, inside: &mut dyn FnMut(i64, &[f64]) -> i32) -> Result<i64> {
        sized(lo.len(), i64::from(self.dimension()), "lo")?;
        sized(hi.len(), i64::from(self.dimension()), "hi")?;
        let mut holder = PointFnHolder { dim: i64::from(self.dimension()), call: Some(inside) };
        let user = &mut holder as *mut _ as *mut c_void;
        let call_c: sys::peri_point_fn = Some(PointFnHolder::call_c);
        let result = unsafe { sys::peri_add_shape(self.handle, material, lo.as_ptr(), hi.as_ptr(), spacing, call_c, user) };
        self.check(result)?;
        Ok(result)
    }
    /// peri\_add\_box, interior vertices moved by up to \`amount\` (0..1) quarters of a cell (\[P\] B).
    pub fn add_perturbed_box(&self, material: i32, lo: &[f64], hi: &[f64], spacing: f64, amount: f64, seed: u64) -> Result<i64> {
        sized(lo.len(), i64::from(self.dimension()), "lo")?;
        sized(hi.len(), i64::from(self.dimension()), "hi")?;
        let result = unsafe { sys::peri_add_perturbed_box(self.handle, material, lo.as_ptr(), hi.as_ptr(), spacing, amount, seed) };
        self.check(result)?;
        Ok(result)
    }
    /// Points of yours: positions\[count\*dim\] \[L\], volumes\[count\] \[L^3\] (planes: areas \[L^2\]), materials\[count\] (ids), or
    /// NULL where the body has one material.
    pub fn add_points(&self, positions: &[f64], volumes: &[f64], materials: Option<&[i32]>) -> Result<i64> {
        sized(positions.len(), (volumes.len() as i64)*i64::from(self.dimension()), "positions")?;
        if let Some(a) = materials.as_deref() {
                    sized(a.len(), (volumes.len() as i64), "materials")?;
                }
        let result = unsafe { sys::peri_add_points(self.handle, (volumes.len() as i64), positions.as_ptr(), volumes.as_ptr(), materials.map_or(std::ptr::null(), |a| a.as_ptr())) };
        self.check(result)?;
        Ok(result)
    }
    /// Each is a point at its centroid, with its volume; partial volumes are exact.
    pub fn add_cells(&self, desc: &CellsDesc) -> Result<i64> {
        let dim = i64::from(self.dimension());
        if desc.vertices.len() as i64 % (vertex_stride) != 0 {
                    return Err(refused("vertices"));
                }
        let desc_raw = desc.raw(dim);
        let result = unsafe { sys::peri_add_cells(self.handle, &desc_raw) };
        self.check(result)?;
        Ok(result)
    }
    /// Families of yours instead of a search: ibond\[points\*width\] as in \[T\] 3.11, row i padded with i. Membership must be
    /// mutual. Weights are computed as for found families, of whose horizon they must be.
    pub fn set_families(&self, width: i32, ibond: &[i32]) -> Result<i32> {
        sized(ibond.len(), self.point_count()*i64::from(width), "ibond")?;
        let result = unsafe { sys::peri_set_families(self.handle, width, ibond.as_ptr()) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// After the points, before peri\_build. All parts make the same calls.
    pub fn set_part(&self, desc: PartDesc) -> Result<i32> {
        let dim = i64::from(self.dimension());
        let mut desc_raw = desc.raw(dim);
        let user_holder = Arc::new(PartDescUser { exchange: desc.exchange, reduce: desc.reduce });
        user_holder.fill(&mut desc_raw, Arc::as_ptr(&user_holder) as *mut c_void);
        keep(&self.keep, user_holder);
        let result = unsafe { sys::peri_set_part(self.handle, &desc_raw) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// 1 or 2, before peri\_build; the deepest that its materials need.
    pub fn ghost_depth(&self) -> Result<i32> {
        let result = unsafe { sys::peri_ghost_depth(self.handle) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// H\[dim\*dim\] \[-\] by rows: images have their owner's displacement + H (distance). Default 0
    pub fn set_mean_gradient(&self, gradient: &[f64]) -> Result<i32> {
        sized(gradient.len(), i64::from(self.dimension()), "gradient")?;
        let result = unsafe { sys::peri_set_mean_gradient(self.handle, gradient.as_ptr()) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// Of the cells of peri\_add\_box those from first\[dim\] to before last\[dim\].
    pub fn add_box_part(&self, material: i32, lo: &[f64], hi: &[f64], spacing: f64, first: &[i32], last: &[i32]) -> Result<i64> {
        sized(lo.len(), i64::from(self.dimension()), "lo")?;
        sized(hi.len(), i64::from(self.dimension()), "hi")?;
        sized(first.len(), i64::from(self.dimension()), "first")?;
        sized(last.len(), i64::from(self.dimension()), "last")?;
        let result = unsafe { sys::peri_add_box_part(self.handle, material, lo.as_ptr(), hi.as_ptr(), spacing, first.as_ptr(), last.as_ptr()) };
        self.check(result)?;
        Ok(result)
    }
    /// Finds the families, computes weights and constants, takes the state. Warns of rows of points, and of sheets of them in 3D: no
    /// constants are for these. After a failure the body is as it was: add what is missing and build again.
    pub fn build(&self) -> Result<i32> {
        let result = unsafe { sys::peri_build(self.handle) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// 2 or 3
    pub fn dimension(&self) -> i32 {
        unsafe { sys::peri_dimension(self.handle) }
    }
    pub fn point_count(&self) -> i64 {
        unsafe { sys::peri_point_count(self.handle) }
    }
    /// size of the largest family
    pub fn family_width(&self) -> i32 {
        unsafe { sys::peri_family_width(self.handle) }
    }
    /// broken and cut ones included
    pub fn bond_count(&self) -> i64 {
        unsafe { sys::peri_bond_count(self.handle) }
    }
    /// of all families: twice the bonds
    pub fn entry_count(&self) -> i64 {
        unsafe { sys::peri_entry_count(self.handle) }
    }
    /// bonds of the initial cracks
    pub fn cut_count(&self) -> i64 {
        unsafe { sys::peri_cut_count(self.handle) }
    }
    /// bonds broken, or cut later
    pub fn broken_count(&self) -> i64 {
        unsafe { sys::peri_broken_count(self.handle) }
    }
    /// steps, load steps too, since reset
    pub fn step_count(&self) -> i64 {
        unsafe { sys::peri_step_count(self.handle) }
    }
    /// \[T\] since build or reset
    pub fn time(&self) -> f64 {
        unsafe { sys::peri_time(self.handle) }
    }
    /// that loads act with; 0 before any did
    pub fn load_factor(&self) -> f64 {
        unsafe { sys::peri_load_factor(self.handle) }
    }
    /// How bonds are worked on: "columns, AVX-512", "list, SSE2", "rows", "reference".
    pub fn kernel_text(&self) -> &'static str {
        constant(unsafe { sys::peri_kernel_text(self.handle) })
    }
    /// Largest stable time step \[T\], to 4 % at rest; of state-based bodies that can break, a bound. Takes 20 to 100 steps once:
    /// docs/accuracy.md. 0 before peri\_build.
    pub fn stable_step(&self) -> f64 {
        unsafe { sys::peri_stable_step(self.handle) }
    }
    /// Rows \[first, first+count) of the families (\[T\] 3.11) to rows\[count\*width\]: ascending, padded with the row's own number;
    /// broken bonds are listed. capacity counts entries.
    pub fn get_families_into(&self, first: i64, count: i64, rows: &mut [i32]) -> Result<i32> {
        let result = unsafe { sys::peri_get_families(self.handle, first, count, rows.as_mut_ptr(), (rows.len() as i64)) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// Rows \[first, first+count) of the families (\[T\] 3.11) to rows\[count\*width\]: ascending, padded with the row's own number;
    /// broken bonds are listed. capacity counts entries.
    pub fn get_families(&self, first: i64, count: i64) -> Result<Vec<i32>> {
        let mut out_array = vec![0; (i64::from(count)*i64::from(self.family_width())) as usize];
        self.get_families_into(first, count, &mut out_array)?;
        Ok(out_array)
    }
    /// The point nearest to x\[dim\] \[L\]; \_in\_place: where it is now.
    pub fn find_point(&self, x: &[f64]) -> Result<i32> {
        sized(x.len(), i64::from(self.dimension()), "x")?;
        let result = unsafe { sys::peri_find_point(self.handle, x.as_ptr()) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// The point nearest to x\[dim\] \[L\]; \_in\_place: where it is now.
    pub fn find_point_in_place(&self, x: &[f64]) -> Result<i32> {
        sized(x.len(), i64::from(self.dimension()), "x")?;
        let result = unsafe { sys::peri_find_point_in_place(self.handle, x.as_ptr()) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// 1: bond (i,j) carries force; 0: broken or cut; PERI\_ERROR\_PAIR: no such bond.
    pub fn bond_is_intact(&self, i: i32, j: i32) -> Result<i32> {
        let result = unsafe { sys::peri_bond_is_intact(self.handle, i, j) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// Motion, time, steps, load factor and ledger become zero, broken bonds whole. Initial cracks, sets, loads, obstacles and
    /// no-fail zones stay.
    pub fn reset(&self) -> Result<i32> {
        let result = unsafe { sys::peri_reset(self.handle) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// name (copied) may be NULL. Reference positions; box and ball include their boundary to 1e-9 spacings.
    pub fn select_box(&self, name: &str, lo: &[f64], hi: &[f64]) -> Result<i32> {
        let name_c = c_text(name, "name")?;
        sized(lo.len(), i64::from(self.dimension()), "lo")?;
        sized(hi.len(), i64::from(self.dimension()), "hi")?;
        let result = unsafe { sys::peri_select_box(self.handle, if name.is_empty() { std::ptr::null() } else { name_c.as_ptr() }, lo.as_ptr(), hi.as_ptr()) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// name (copied) may be NULL. Reference positions; box and ball include their boundary to 1e-9 spacings.
    pub fn select_ball(&self, name: &str, centre: &[f64], radius: f64) -> Result<i32> {
        let name_c = c_text(name, "name")?;
        sized(centre.len(), i64::from(self.dimension()), "centre")?;
        let result = unsafe { sys::peri_select_ball(self.handle, if name.is_empty() { std::ptr::null() } else { name_c.as_ptr() }, centre.as_ptr(), radius) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// By present positions.
    pub fn select_box_in_place(&self, name: &str, lo: &[f64], hi: &[f64]) -> Result<i32> {
        let name_c = c_text(name, "name")?;
        sized(lo.len(), i64::from(self.dimension()), "lo")?;
        sized(hi.len(), i64::from(self.dimension()), "hi")?;
        let result = unsafe { sys::peri_select_box_in_place(self.handle, if name.is_empty() { std::ptr::null() } else { name_c.as_ptr() }, lo.as_ptr(), hi.as_ptr()) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// By present positions.
    pub fn select_ball_in_place(&self, name: &str, centre: &[f64], radius: f64) -> Result<i32> {
        let name_c = c_text(name, "name")?;
        sized(centre.len(), i64::from(self.dimension()), "centre")?;
        let result = unsafe { sys::peri_select_ball_in_place(self.handle, if name.is_empty() { std::ptr::null() } else { name_c.as_ptr() }, centre.as_ptr(), radius) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    pub fn select_if(&self, name: &str, take: &mut dyn FnMut(i64, &[f64]) -> i32) -> Result<i32> {
        let name_c = c_text(name, "name")?;
        let mut holder = PointFnHolder { dim: i64::from(self.dimension()), call: Some(take) };
        let user = &mut holder as *mut _ as *mut c_void;
        let call_c: sys::peri_point_fn = Some(PointFnHolder::call_c);
        let result = unsafe { sys::peri_select_if(self.handle, if name.is_empty() { std::ptr::null() } else { name_c.as_ptr() }, call_c, user) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    pub fn select_points(&self, name: &str, points: &[i32]) -> Result<i32> {
        let name_c = c_text(name, "name")?;
        let result = unsafe { sys::peri_select_points(self.handle, if name.is_empty() { std::ptr::null() } else { name_c.as_ptr() }, (points.len() as i64), points.as_ptr()) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// id, or PERI\_ERROR\_NAME
    pub fn find_set(&self, name: &str) -> Result<i32> {
        let name_c = c_text(name, "name")?;
        let result = unsafe { sys::peri_find_set(self.handle, name_c.as_ptr()) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// id, or PERI\_ERROR\_NAME
    pub fn size_of_set(&self, set: i32) -> Result<i64> {
        let result = unsafe { sys::peri_size_of_set(self.handle, set) };
        self.check(result)?;
        Ok(result)
    }
    /// id, or PERI\_ERROR\_NAME
    pub fn get_set_into(&self, set: i32, points: &mut [i32]) -> Result<i32> {
        let result = unsafe { sys::peri_get_set(self.handle, set, points.as_mut_ptr(), (points.len() as i64)) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// id, or PERI\_ERROR\_NAME
    pub fn get_set(&self, set: i32) -> Result<Vec<i32>> {
        let mut out_array = vec![0; (self.size_of_set(set)?) as usize];
        self.get_set_into(set, &mut out_array)?;
        Ok(out_array)
    }
    /// Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a spacing. Returns the
    /// number of bonds newly cut. 2D
    pub fn cut_segment(&self, standing: i32, from: &[f64], to: &[f64]) -> Result<i64> {
        sized(from.len(), i64::from(self.dimension()), "from")?;
        sized(to.len(), i64::from(self.dimension()), "to")?;
        let result = unsafe { sys::peri_cut_segment(self.handle, standing, from.as_ptr(), to.as_ptr()) };
        self.check(result)?;
        Ok(result)
    }
    /// Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a spacing. Returns the
    /// number of bonds newly cut. 2D, \[count\*2\]
    pub fn cut_polyline(&self, standing: i32, vertices: &[f64]) -> Result<i64> {
        if vertices.len() as i64 % (2) != 0 {
                    return Err(refused("vertices"));
                }
        let result = unsafe { sys::peri_cut_polyline(self.handle, standing, (vertices.len() as i64 / (2)), vertices.as_ptr()) };
        self.check(result)?;
        Ok(result)
    }
    /// Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a spacing. Returns the
    /// number of bonds newly cut. 3D
    pub fn cut_disc(&self, standing: i32, centre: &[f64], normal: &[f64], radius: f64) -> Result<i64> {
        sized(centre.len(), i64::from(self.dimension()), "centre")?;
        sized(normal.len(), i64::from(self.dimension()), "normal")?;
        let result = unsafe { sys::peri_cut_disc(self.handle, standing, centre.as_ptr(), normal.as_ptr(), radius) };
        self.check(result)?;
        Ok(result)
    }
    /// Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a spacing. Returns the
    /// number of bonds newly cut. 3D
    pub fn cut_triangle(&self, standing: i32, p: &[f64], q: &[f64], r: &[f64]) -> Result<i64> {
        sized(p.len(), i64::from(self.dimension()), "p")?;
        sized(q.len(), i64::from(self.dimension()), "q")?;
        sized(r.len(), i64::from(self.dimension()), "r")?;
        let result = unsafe { sys::peri_cut_triangle(self.handle, standing, p.as_ptr(), q.as_ptr(), r.as_ptr()) };
        self.check(result)?;
        Ok(result)
    }
    /// Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a spacing. Returns the
    /// number of bonds newly cut. 3D, or parallelogram
    pub fn cut_rectangle(&self, standing: i32, corner: &[f64], edge1: &[f64], edge2: &[f64]) -> Result<i64> {
        sized(corner.len(), i64::from(self.dimension()), "corner")?;
        sized(edge1.len(), i64::from(self.dimension()), "edge1")?;
        sized(edge2.len(), i64::from(self.dimension()), "edge2")?;
        let result = unsafe { sys::peri_cut_rectangle(self.handle, standing, corner.as_ptr(), edge1.as_ptr(), edge2.as_ptr()) };
        self.check(result)?;
        Ok(result)
    }
    /// Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a spacing. Returns the
    /// number of bonds newly cut. \[count\*2\] points; each pair must be a bond
    pub fn cut_pairs(&self, standing: i32, pairs: &[i32]) -> Result<i64> {
        if pairs.len() as i64 % (2) != 0 {
                    return Err(refused("pairs"));
                }
        let result = unsafe { sys::peri_cut_pairs(self.handle, standing, (pairs.len() as i64 / (2)), pairs.as_ptr()) };
        self.check(result)?;
        Ok(result)
    }
    /// Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a spacing. Returns the
    /// number of bonds newly cut.
    pub fn cut_if(&self, standing: i32, cut: &mut dyn FnMut(i32, i32, &[f64], &[f64]) -> i32) -> Result<i64> {
        let mut holder = PairFnHolder { dim: i64::from(self.dimension()), call: Some(cut) };
        let user = &mut holder as *mut _ as *mut c_void;
        let call_c: sys::peri_pair_fn = Some(PairFnHolder::call_c);
        let result = unsafe { sys::peri_cut_if(self.handle, standing, call_c, user) };
        self.check(result)?;
        Ok(result)
    }
    /// Bonds with an end in the set never break by a criterion (on = 1), or may again (0). Cuts still cut.
    pub fn set_no_fail(&self, set: i32, on: i32) -> Result<i32> {
        let result = unsafe { sys::peri_set_no_fail(self.handle, set, on) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// fn is called for every bond that breaks by its criterion; NULL removes. Costs two to three bits per bond.
    pub fn on_break(&self, r#fn: Option<Box<dyn Fn(i32, i32, f64, f64) -> i32 + Send + Sync>>) -> Result<i32> {
        let call_c: sys::peri_break_fn = if r#fn.is_some() { Some(BreakFnHolder::call_c) } else { None };
        let holder = Arc::new(BreakFnHolder { call: r#fn });
        let user = Arc::as_ptr(&holder) as *mut c_void;
        if call_c.is_some() {
                    keep(&self.keep, holder.clone());
                }
        let result = unsafe { sys::peri_on_break(self.handle, call_c, user) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// Strength of bonds, times that of points: factors\[count\] of pairs\[count\*2\], or of intact bonds that \`take\` takes.
    /// Returns how many.
    pub fn set_strength_pairs(&self, pairs: &[i32], factors: &[f64]) -> Result<i64> {
        sized(pairs.len(), (factors.len() as i64)*2, "pairs")?;
        let result = unsafe { sys::peri_set_strength_pairs(self.handle, (factors.len() as i64), pairs.as_ptr(), factors.as_ptr()) };
        self.check(result)?;
        Ok(result)
    }
    /// Strength of bonds, times that of points: factors\[count\] of pairs\[count\*2\], or of intact bonds that \`take\` takes.
    /// Returns how many.
    pub fn set_strength_if(&self, factor: f64, take: &mut dyn FnMut(i32, i32, &[f64], &[f64]) -> i32) -> Result<i64> {
        let mut holder = PairFnHolder { dim: i64::from(self.dimension()), call: Some(take) };
        let user = &mut holder as *mut _ as *mut c_void;
        let call_c: sys::peri_pair_fn = Some(PairFnHolder::call_c);
        let result = unsafe { sys::peri_set_strength_if(self.handle, factor, call_c, user) };
        self.check(result)?;
        Ok(result)
    }
    /// on = 1: keeps when bonds between adjacent points break, for peri\_get\_cracks: 32 to 44 bytes per point.
    pub fn record_breaks(&self, on: i32) -> Result<i32> {
        let result = unsafe { sys::peri_record_breaks(self.handle, on) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// How many there are, and which each point is in: of\_point\[points\], or NULL. They are numbered 0, 1, ... by their least
    /// points when first asked for. Of one that has split since, the piece of most points keeps the number; the others get the next
    /// ones. Free where no bond broke.
    pub fn find_fragments(&self, of_point: Option<&mut [i32]>) -> Result<i64> {
        let capacity = (of_point.as_deref().map_or(0, |a| a.len()) as i64);
        let result = unsafe { sys::peri_find_fragments(self.handle, of_point.map_or(std::ptr::null_mut(), |a| a.as_mut_ptr()), capacity) };
        self.check(result)?;
        Ok(result)
    }
    /// out\[k\] is fragment k.
    pub fn get_fragments_into(&self, out: &mut [sys::peri_fragment]) -> Result<i32> {
        let result = unsafe { sys::peri_get_fragments(self.handle, out.as_mut_ptr(), (out.len() as i64)) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// out\[k\] is fragment k.
    pub fn get_fragments(&self) -> Result<Vec<Fragment>> {
        let mut out_array = vec![unsafe { std::mem::zeroed::<sys::peri_fragment>() }; (self.find_fragments(None)?) as usize];
        self.get_fragments_into(&mut out_array)?;
        Ok(out_array)
    }
    /// The closed surface of a fragment, or of all (-1), now, by cells. vertices\[\]\[dim\] \[L\]; faces\[\]\[dim\] of vertices: in
    /// 2D edges with the fragment on the left, loop by loop, edge k from vertex k on; in 3D triangles, counter-clockwise from
    /// outside. owners\[\], or NULL: its point; inner\[\], or NULL: 1 where a crack made it. Points and cells of yours are squares or
    /// cubes.
    pub fn size_of_outline(&self, fragment: i32) -> Result<(i64, i64)> {
        let mut vertices = 0;
        let mut faces = 0;
        let result = unsafe { sys::peri_size_of_outline(self.handle, fragment, &mut vertices, &mut faces) };
        self.check(i64::from(result))?;
        Ok((vertices, faces))
    }
    /// The closed surface of a fragment, or of all (-1), now, by cells. vertices\[\]\[dim\] \[L\]; faces\[\]\[dim\] of vertices: in
    /// 2D edges with the fragment on the left, loop by loop, edge k from vertex k on; in 3D triangles, counter-clockwise from
    /// outside. owners\[\], or NULL: its point; inner\[\], or NULL: 1 where a crack made it. Points and cells of yours are squares or
    /// cubes.
    pub fn get_outline(&self, fragment: i32, vertices: &mut [f64], faces: &mut [i32], owners: Option<&mut [i32]>, inner: Option<&mut [i32]>) -> Result<i32> {
        if vertices.len() as i64 % (i64::from(self.dimension())) != 0 {
                    return Err(refused("vertices"));
                }
        if faces.len() as i64 % (i64::from(self.dimension())) != 0 {
                    return Err(refused("faces"));
                }
        if let Some(a) = owners.as_deref() {
                    sized(a.len(), (faces.len() as i64 / (i64::from(self.dimension()))), "owners")?;
                }
        if let Some(a) = inner.as_deref() {
                    sized(a.len(), (faces.len() as i64 / (i64::from(self.dimension()))), "inner")?;
                }
        let result = unsafe { sys::peri_get_outline(self.handle, fragment, vertices.as_mut_ptr(), (vertices.len() as i64 / (i64::from(self.dimension()))), faces.as_mut_ptr(), owners.map_or(std::ptr::null_mut(), |a| a.as_mut_ptr()), inner.map_or(std::ptr::null_mut(), |a| a.as_mut_ptr()), (faces.len() as i64 / (i64::from(self.dimension())))) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// Add value\[dim\] to the displacement \[L\] or velocity \[L T^-1\] of a set, now; peri\_reset clears both. Sums are below 1e15
    /// spacings, 1e9 speeds of sound.
    pub fn add_displacement(&self, set: i32, value: &[f64]) -> Result<i32> {
        sized(value.len(), i64::from(self.dimension()), "value")?;
        let result = unsafe { sys::peri_add_displacement(self.handle, set, value.as_ptr()) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// Add value\[dim\] to the displacement \[L\] or velocity \[L T^-1\] of a set, now; peri\_reset clears both. Sums are below 1e15
    /// spacings, 1e9 speeds of sound.
    pub fn add_velocity(&self, set: i32, value: &[f64]) -> Result<i32> {
        sized(value.len(), i64::from(self.dimension()), "value")?;
        let result = unsafe { sys::peri_add_velocity(self.handle, set, value.as_ptr()) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// Supports: prescribe the \`axes\` of displacement \[L\] or velocity \[L T^-1\] of a set: value\[dim\] (NULL = zero), or as fn
    /// says (may be NULL). Later supports win. The load factor multiplies a constant displacement, not a velocity. A grip should be a
    /// horizon deep, of state-based laws two.
    pub fn prescribe_displacement(&self, set: i32, axes: i32, value: Option<&[f64]>, r#fn: Option<Box<dyn Fn(f64, &[i32], &mut [f64]) -> i32 + Send + Sync>>) -> Result<i32> {
        if let Some(a) = value.as_deref() {
                    sized(a.len(), i64::from(self.dimension()), "value")?;
                }
        let call_c: sys::peri_load_fn = if r#fn.is_some() { Some(LoadFnHolder::call_c) } else { None };
        let holder = Arc::new(LoadFnHolder { dim: i64::from(self.dimension()), call: r#fn });
        let user = Arc::as_ptr(&holder) as *mut c_void;
        if call_c.is_some() {
                    keep(&self.keep, holder.clone());
                }
        let result = unsafe { sys::peri_prescribe_displacement(self.handle, set, axes, value.map_or(std::ptr::null(), |a| a.as_ptr()), call_c, user) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// Supports: prescribe the \`axes\` of displacement \[L\] or velocity \[L T^-1\] of a set: value\[dim\] (NULL = zero), or as fn
    /// says (may be NULL). Later supports win. The load factor multiplies a constant displacement, not a velocity. A grip should be a
    /// horizon deep, of state-based laws two.
    pub fn prescribe_velocity(&self, set: i32, axes: i32, value: Option<&[f64]>, r#fn: Option<Box<dyn Fn(f64, &[i32], &mut [f64]) -> i32 + Send + Sync>>) -> Result<i32> {
        if let Some(a) = value.as_deref() {
                    sized(a.len(), i64::from(self.dimension()), "value")?;
                }
        let call_c: sys::peri_load_fn = if r#fn.is_some() { Some(LoadFnHolder::call_c) } else { None };
        let holder = Arc::new(LoadFnHolder { dim: i64::from(self.dimension()), call: r#fn });
        let user = Arc::as_ptr(&holder) as *mut c_void;
        if call_c.is_some() {
                    keep(&self.keep, holder.clone());
                }
        let result = unsafe { sys::peri_prescribe_velocity(self.handle, set, axes, value.map_or(std::ptr::null(), |a| a.as_ptr()), call_c, user) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// Support: the set moves as a rigid body. motion: displacement \[L\], then in 2D the angle about centre\[dim\], in 3D a vector
    /// along the axis as long as the angle; NULL: 0. The load factor multiplies it; or fn writes it (may be NULL).
    pub fn prescribe_rigid(&self, set: i32, centre: &[f64], motion: Option<&[f64]>, r#fn: Option<Box<dyn Fn(f64, &mut [f64]) -> i32 + Send + Sync>>) -> Result<i32> {
        sized(centre.len(), i64::from(self.dimension()), "centre")?;
        if let Some(a) = motion.as_deref() {
                    sized(a.len(), i64::from(self.dimension())+(2 * i64::from(self.dimension()) - 3), "motion")?;
                }
        let call_c: sys::peri_rigid_fn = if r#fn.is_some() { Some(RigidFnHolder::call_c) } else { None };
        let holder = Arc::new(RigidFnHolder { dim: i64::from(self.dimension()), call: r#fn });
        let user = Arc::as_ptr(&holder) as *mut c_void;
        if call_c.is_some() {
                    keep(&self.keep, holder.clone());
                }
        let result = unsafe { sys::peri_prescribe_rigid(self.handle, set, centre.as_ptr(), motion.map_or(std::ptr::null(), |a| a.as_ptr()), call_c, user) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// Body force density value\[dim\] \[M L^-2 T^-2\] on a set; gravity is density times g.
    pub fn apply_body_force(&self, set: i32, value: &[f64], r#fn: Option<Box<dyn Fn(f64, &[i32], &mut [f64]) -> i32 + Send + Sync>>) -> Result<i32> {
        sized(value.len(), i64::from(self.dimension()), "value")?;
        let call_c: sys::peri_load_fn = if r#fn.is_some() { Some(LoadFnHolder::call_c) } else { None };
        let holder = Arc::new(LoadFnHolder { dim: i64::from(self.dimension()), call: r#fn });
        let user = Arc::as_ptr(&holder) as *mut c_void;
        if call_c.is_some() {
                    keep(&self.keep, holder.clone());
                }
        let result = unsafe { sys::peri_apply_body_force(self.handle, set, value.as_ptr(), call_c, user) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// Traction value\[dim\] \[M L^-1 T^-2\] on a flat face of \`area\` \[L^2\] (2D: length \[L\]) and outward \`normal\`. The set:
    /// all points within two horizons of it, of one material. Uniform stress is exact for correspondence; else the total is, and
    /// strain is off by O(horizon). (\[C\] 2.5, docs/statics.md)
    pub fn apply_traction(&self, set: i32, area: f64, normal: &[f64], value: &[f64], r#fn: Option<Box<dyn Fn(f64, &[i32], &mut [f64]) -> i32 + Send + Sync>>) -> Result<i32> {
        sized(normal.len(), i64::from(self.dimension()), "normal")?;
        sized(value.len(), i64::from(self.dimension()), "value")?;
        let call_c: sys::peri_load_fn = if r#fn.is_some() { Some(LoadFnHolder::call_c) } else { None };
        let holder = Arc::new(LoadFnHolder { dim: i64::from(self.dimension()), call: r#fn });
        let user = Arc::as_ptr(&holder) as *mut c_void;
        if call_c.is_some() {
                    keep(&self.keep, holder.clone());
                }
        let result = unsafe { sys::peri_apply_traction(self.handle, set, area, normal.as_ptr(), value.as_ptr(), call_c, user) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// A total of value\*area (in 2D times the thickness), spread over the set by volume: on the outermost layer, say. Exact in sum,
    /// but strain near the face is wrong by O(1) (\[C\] 2.5).
    pub fn apply_layer_traction(&self, set: i32, area: f64, value: &[f64], r#fn: Option<Box<dyn Fn(f64, &[i32], &mut [f64]) -> i32 + Send + Sync>>) -> Result<i32> {
        sized(value.len(), i64::from(self.dimension()), "value")?;
        let call_c: sys::peri_load_fn = if r#fn.is_some() { Some(LoadFnHolder::call_c) } else { None };
        let holder = Arc::new(LoadFnHolder { dim: i64::from(self.dimension()), call: r#fn });
        let user = Arc::as_ptr(&holder) as *mut c_void;
        if call_c.is_some() {
                    keep(&self.keep, holder.clone());
                }
        let result = unsafe { sys::peri_apply_layer_traction(self.handle, set, area, value.as_ptr(), call_c, user) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// Pressure \[M L^-1 T^-2\] on all surfaces of a set, faces of cracks included (\[C\] 2.6): for a crack select the points within
    /// two horizons of it. fn: value\[k\*dim\] is the pressure on point k.
    pub fn apply_pressure(&self, set: i32, pressure: f64, r#fn: Option<Box<dyn Fn(f64, &[i32], &mut [f64]) -> i32 + Send + Sync>>) -> Result<i32> {
        let call_c: sys::peri_load_fn = if r#fn.is_some() { Some(LoadFnHolder::call_c) } else { None };
        let holder = Arc::new(LoadFnHolder { dim: i64::from(self.dimension()), call: r#fn });
        let user = Arc::as_ptr(&holder) as *mut c_void;
        if call_c.is_some() {
                    keep(&self.keep, holder.clone());
                }
        let result = unsafe { sys::peri_apply_pressure(self.handle, set, pressure, call_c, user) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// As \[C\] 2.6 has it: through the cut bonds between neighbouring points.
    pub fn apply_bond_pressure_for_comparison(&self, set: i32, pressure: f64, r#fn: Option<Box<dyn Fn(f64, &[i32], &mut [f64]) -> i32 + Send + Sync>>) -> Result<i32> {
        let call_c: sys::peri_load_fn = if r#fn.is_some() { Some(LoadFnHolder::call_c) } else { None };
        let holder = Arc::new(LoadFnHolder { dim: i64::from(self.dimension()), call: r#fn });
        let user = Arc::as_ptr(&holder) as *mut c_void;
        if call_c.is_some() {
                    keep(&self.keep, holder.clone());
                }
        let result = unsafe { sys::peri_apply_bond_pressure_for_comparison(self.handle, set, pressure, call_c, user) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// ids are not used twice
    pub fn remove_load(&self, load: i32) -> Result<i32> {
        let result = unsafe { sys::peri_remove_load(self.handle, load) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// Force \[M L T^-2\] to force\[dim\]: of a support on the body, mean of the last step (or of the equilibrium); of a load, its
    /// present total.
    pub fn get_reaction_into(&self, load: i32, force: &mut [f64]) -> Result<i32> {
        sized(force.len(), i64::from(self.dimension()), "force")?;
        let result = unsafe { sys::peri_get_reaction(self.handle, load, force.as_mut_ptr()) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// Force \[M L T^-2\] to force\[dim\]: of a support on the body, mean of the last step (or of the equilibrium); of a load, its
    /// present total.
    pub fn get_reaction(&self, load: i32) -> Result<Vec<f64>> {
        let mut out_array = vec![0.0; (i64::from(self.dimension())) as usize];
        self.get_reaction_into(load, &mut out_array)?;
        Ok(out_array)
    }
    /// Its moment about place\[dim\] \[M L^2 T^-2\] to moment\[1\] (2D) or \[3\].
    pub fn get_reaction_moment_into(&self, load: i32, place: &[f64], moment: &mut [f64]) -> Result<i32> {
        sized(place.len(), i64::from(self.dimension()), "place")?;
        sized(moment.len(), (2 * i64::from(self.dimension()) - 3), "moment")?;
        let result = unsafe { sys::peri_get_reaction_moment(self.handle, load, place.as_ptr(), moment.as_mut_ptr()) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// Its moment about place\[dim\] \[M L^2 T^-2\] to moment\[1\] (2D) or \[3\].
    pub fn get_reaction_moment(&self, load: i32, place: &[f64]) -> Result<Vec<f64>> {
        let mut out_array = vec![0.0; ((2 * i64::from(self.dimension()) - 3)) as usize];
        self.get_reaction_moment_into(load, place, &mut out_array)?;
        Ok(out_array)
    }
    /// A mesh is copied, and must be closed.
    pub fn add_obstacle(&self, desc: ObstacleDesc) -> Result<i32> {
        let dim = i64::from(self.dimension());
        if desc.vertices.len() as i64 % (dim) != 0 {
                    return Err(refused("vertices"));
                }
        if desc.faces.len() as i64 % (3) != 0 {
                    return Err(refused("faces"));
                }
        let mut desc_raw = desc.raw(dim);
        let user_holder = Arc::new(ObstacleDescUser { dim, distance: desc.distance, motion: desc.motion });
        user_holder.fill(&mut desc_raw, Arc::as_ptr(&user_holder) as *mut c_void);
        keep(&self.keep, user_holder);
        let result = unsafe { sys::peri_add_obstacle(self.handle, &desc_raw) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// A mesh is copied, and must be closed.
    pub fn remove_obstacle(&self, obstacle: i32) -> Result<i32> {
        let result = unsafe { sys::peri_remove_obstacle(self.handle, obstacle) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// On the body: force\[dim\] \[M L T^-2\]; moment\[3\], in 2D \[1\], \[M L^2 T^-2\] about its place. Either may be NULL.
    pub fn get_obstacle_force(&self, obstacle: i32, force: Option<&mut [f64]>, moment: Option<&mut [f64]>) -> Result<i32> {
        if let Some(a) = force.as_deref() {
                    sized(a.len(), i64::from(self.dimension()), "force")?;
                }
        if let Some(a) = moment.as_deref() {
                    sized(a.len(), (2 * i64::from(self.dimension()) - 3), "moment")?;
                }
        let result = unsafe { sys::peri_get_obstacle_force(self.handle, obstacle, force.map_or(std::ptr::null_mut(), |a| a.as_mut_ptr()), moment.map_or(std::ptr::null_mut(), |a| a.as_mut_ptr())) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    pub fn get_obstacle_state(&self, obstacle: i32) -> Result<ObstacleState> {
        let mut state = std::mem::MaybeUninit::<sys::peri_obstacle_state>::zeroed();
        let result = unsafe { sys::peri_get_obstacle_state(self.handle, obstacle, state.as_mut_ptr()) };
        self.check(i64::from(result))?;
        Ok(unsafe { state.assume_init() })
    }
    /// Sets place, turn, velocity and spin of a free one.
    pub fn set_obstacle_state(&self, obstacle: i32, state: &sys::peri_obstacle_state) -> Result<i32> {
        let result = unsafe { sys::peri_set_obstacle_state(self.handle, obstacle, state) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// Of materials i and j, ids or PERI\_ALL; NULL: none.
    pub fn set_contact(&self, i: i32, j: i32, desc: Option<&ContactDesc>) -> Result<i32> {
        let desc_raw = desc.map(|d| d.raw());
        let result = unsafe { sys::peri_set_contact(self.handle, i, j, desc_raw.as_ref().map_or(std::ptr::null(), |d| d as *const _)) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// Advances the body in time. PERI\_ERROR\_STEP: it ends at a whole step; the value is what may follow. So does
    /// PERI\_ERROR\_CALLBACK of a peri\_frame\_fn or peri\_break\_fn. PERI\_ERROR\_UNSTABLE, and PERI\_ERROR\_CALLBACK of a load or
    /// obstacle (index: the point): it ended within a step; read it, then reset or destroy it.
    pub fn advance(&self, desc: AdvanceDesc) -> Result<i32> {
        let mut desc_raw = desc.raw();
        let mut user_holder = AdvanceDescUser { owner: self, on_frame: desc.on_frame };
        let user_pointer = &mut user_holder as *mut _ as *mut c_void;
        user_holder.fill(&mut desc_raw, user_pointer);
        let result = unsafe { sys::peri_advance(self.handle, &desc_raw) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// Forces at a displacement of yours. A step, rho of PERI\_FIELD\_DENSITY: v += dt/2 force/rho, u += dt v, peri\_evaluate, v +=
    /// (dt/2 force + impulse)/rho. report may be NULL.
    ///
    /// # Safety
    /// The arrays that it points to are as long as peri.h says.
    pub unsafe fn evaluate(&self, desc: &sys::peri_evaluate_desc) -> Result<EvaluateReport> {
        let mut report = std::mem::MaybeUninit::<sys::peri_evaluate_report>::zeroed();
        let result = unsafe { sys::peri_evaluate(self.handle, desc, report.as_mut_ptr()) };
        self.check(i64::from(result))?;
        Ok(unsafe { report.assume_init() })
    }
    /// Equilibrium under supports and loads, constant values times a factor from load\_from to load\_to, callbacks at time = factor,
    /// prescribed velocities at rest; bonds over their limit break until none does. A later run goes on at load\_to. A failed step
    /// leaves the last equilibrium, or, after breaks, how far it came; so does PERI\_ENDED\_SEVERED.
    pub fn solve(&self, mut desc: SolveDesc) -> Result<SolveReport> {
        let dim = i64::from(self.dimension());
        if desc.curve.len() as i64 % ((2 + 2*dim)) != 0 {
                    return Err(refused("curve"));
                }
        let mut desc_raw = desc.raw(dim);
        let mut user_holder = SolveDescUser { owner: self, on_iteration: desc.on_iteration, on_step: desc.on_step };
        let user_pointer = &mut user_holder as *mut _ as *mut c_void;
        user_holder.fill(&mut desc_raw, user_pointer);
        let mut report = std::mem::MaybeUninit::<sys::peri_solve_report>::zeroed();
        let result = unsafe { sys::peri_solve(self.handle, &desc_raw, report.as_mut_ptr()) };
        self.check(i64::from(result))?;
        Ok(unsafe { report.assume_init() })
    }
    /// peri\_advance by implicit steps, \`time\_step\` \> 0 of any size (generalised alpha, order 2). rho \[0, 1\]: what is left of
    /// the highest modes per step; 1 keeps the energy. solve: tolerance, fracture, limits, on\_iteration; NULL: defaults. No
    /// obstacles or contact. A step that fails leaves the last one, less the bonds that broke in it. report may be NULL.
    pub fn advance_implicit(&self, advance: AdvanceDesc, mut solve: SolveDesc, rho: f64) -> Result<SolveReport> {
        let mut advance_raw = advance.raw();
        let mut user_holder = AdvanceDescUser { owner: self, on_frame: advance.on_frame };
        let user_pointer = &mut user_holder as *mut _ as *mut c_void;
        user_holder.fill(&mut advance_raw, user_pointer);
        let dim = i64::from(self.dimension());
        if solve.curve.len() as i64 % ((2 + 2*dim)) != 0 {
                    return Err(refused("curve"));
                }
        let mut solve_raw = solve.raw(dim);
        let mut user_holder = SolveDescUser { owner: self, on_iteration: solve.on_iteration, on_step: solve.on_step };
        let user_pointer = &mut user_holder as *mut _ as *mut c_void;
        user_holder.fill(&mut solve_raw, user_pointer);
        let mut report = std::mem::MaybeUninit::<sys::peri_solve_report>::zeroed();
        let result = unsafe { sys::peri_advance_implicit(self.handle, &advance_raw, &solve_raw, rho, report.as_mut_ptr()) };
        self.check(i64::from(result))?;
        Ok(unsafe { report.assume_init() })
    }
    /// out = K in \[M L T^-2\], the tangent at the present displacement times in\[count\], count = points\*dim; without supports,
    /// obstacles and contact. out may be in. The first call takes memory (peri\_memory.state).
    pub fn multiply_stiffness_into(&self, r#in: &[f64], out: &mut [f64]) -> Result<i32> {
        sized(out.len(), (r#in.len() as i64), "out")?;
        let result = unsafe { sys::peri_multiply_stiffness(self.handle, r#in.as_ptr(), out.as_mut_ptr(), (r#in.len() as i64)) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// out = K in \[M L T^-2\], the tangent at the present displacement times in\[count\], count = points\*dim; without supports,
    /// obstacles and contact. out may be in. The first call takes memory (peri\_memory.state).
    pub fn multiply_stiffness(&self, r#in: &[f64]) -> Result<Vec<f64>> {
        let mut out_array = vec![0.0; (r#in.len() as i64) as usize];
        self.multiply_stiffness_into(r#in, &mut out_array)?;
        Ok(out_array)
    }
    /// The same at \`displacement\` \[points\*dim\] of yours instead: the body stays where it is.
    pub fn multiply_stiffness_at_into(&self, displacement: &[f64], r#in: &[f64], out: &mut [f64]) -> Result<i32> {
        sized(displacement.len(), self.point_count()*i64::from(self.dimension()), "displacement")?;
        sized(out.len(), (r#in.len() as i64), "out")?;
        let result = unsafe { sys::peri_multiply_stiffness_at(self.handle, displacement.as_ptr(), r#in.as_ptr(), out.as_mut_ptr(), (r#in.len() as i64)) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// The same at \`displacement\` \[points\*dim\] of yours instead: the body stays where it is.
    pub fn multiply_stiffness_at(&self, displacement: &[f64], r#in: &[f64]) -> Result<Vec<f64>> {
        let mut out_array = vec![0.0; (r#in.len() as i64) as usize];
        self.multiply_stiffness_at_into(displacement, r#in, &mut out_array)?;
        Ok(out_array)
    }
    /// The same as a matrix by compressed rows, points\*dim square (\[T\] 3.2, 3.3). It outlives the body; free it by
    /// peri\_matrix\_destroy.
    pub fn matrix_create(&self) -> Result<Matrix> {
        let mut made = std::ptr::null_mut();
        let result = unsafe { sys::peri_matrix_create(self.handle, &mut made) };
        self.check(i64::from(result))?;
        Ok(Matrix { handle: made, dim: i64::from(self.dimension()) })
    }
    /// Entries of a field: points\*components.
    pub fn size_of_field(&self, field: i32) -> Result<i64> {
        let result = unsafe { sys::peri_size_of_field(self.handle, field) };
        self.check(result)?;
        Ok(result)
    }
    /// Copies a field, as double, in your units and order. capacity counts doubles.
    pub fn get_field_into(&self, field: i32, out: &mut [f64]) -> Result<i32> {
        let result = unsafe { sys::peri_get_field(self.handle, field, out.as_mut_ptr(), (out.len() as i64)) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// Copies a field, as double, in your units and order. capacity counts doubles.
    pub fn get_field(&self, field: i32) -> Result<Vec<f64>> {
        let mut out_array = vec![0.0; (self.size_of_field(field)?) as usize];
        self.get_field_into(field, &mut out_array)?;
        Ok(out_array)
    }
    /// Sets a field W of all points; count = points\*components. What peri\_get\_field gives changes no bit. Fields of material
    /// (docs/laws.md), which peri\_frame\_fn may set, too, outlast peri\_reset.
    pub fn set_field(&self, field: i32, r#in: &[f64]) -> Result<i32> {
        let result = unsafe { sys::peri_set_field(self.handle, field, r#in.as_ptr(), (r#in.len() as i64)) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// Without a copy. Of a stored field it shows the present state; of a derived one that of the call, until it is viewed again.
    pub fn view_field(&mut self, field: i32) -> Result<View<'_>> {
        let mut view = std::mem::MaybeUninit::<sys::peri_view>::zeroed();
        let result = unsafe { sys::peri_view_field(self.handle, field, view.as_mut_ptr()) };
        self.check(i64::from(result))?;
        Ok(View { raw: unsafe { view.assume_init() }, body: std::marker::PhantomData })
    }
    /// Of points\[count\] alone: count\*components.
    pub fn get_field_at(&self, field: i32, points: &[i32], out: &mut [f64]) -> Result<i32> {
        let result = unsafe { sys::peri_get_field_at(self.handle, field, (points.len() as i64), points.as_ptr(), out.as_mut_ptr(), (out.len() as i64)) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// At places\[count\*dim\] \[L\], in\_place = 1: present ones: linear fields exactly, not across cracks. Outside: NaN.
    pub fn interpolate_field(&self, field: i32, in_place: i32, places: &[f64], out: &mut [f64]) -> Result<i32> {
        if places.len() as i64 % (i64::from(self.dimension())) != 0 {
                    return Err(refused("places"));
                }
        let result = unsafe { sys::peri_interpolate_field(self.handle, field, in_place, (places.len() as i64 / (i64::from(self.dimension()))), places.as_ptr(), out.as_mut_ptr(), (out.len() as i64)) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// Bonds of the points of a set, as in peri\_get\_families.
    pub fn size_of_bonds(&self, set: i32, bond: i32) -> Result<i64> {
        let result = unsafe { sys::peri_size_of_bonds(self.handle, set, bond) };
        self.check(result)?;
        Ok(result)
    }
    /// Bonds of the points of a set, as in peri\_get\_families.
    pub fn get_bonds(&self, set: i32, bond: i32, out: &mut [f64]) -> Result<i32> {
        let result = unsafe { sys::peri_get_bonds(self.handle, set, bond, out.as_mut_ptr(), (out.len() as i64)) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// Costs one evaluation of the forces.
    pub fn get_energy(&self) -> Result<Energy> {
        let mut energy = std::mem::MaybeUninit::<sys::peri_energy>::zeroed();
        let result = unsafe { sys::peri_get_energy(self.handle, energy.as_mut_ptr()) };
        self.check(i64::from(result))?;
        Ok(unsafe { energy.assume_init() })
    }
    /// Momentum \[M L T^-1\] to linear\[dim\], about the origin \[M L^2 T^-1\] to angular\[1\] (2D) or \[3\]. Either may be NULL.
    pub fn get_momentum(&self, linear: Option<&mut [f64]>, angular: Option<&mut [f64]>) -> Result<i32> {
        if let Some(a) = linear.as_deref() {
                    sized(a.len(), i64::from(self.dimension()), "linear")?;
                }
        if let Some(a) = angular.as_deref() {
                    sized(a.len(), (2 * i64::from(self.dimension()) - 3), "angular")?;
                }
        let result = unsafe { sys::peri_get_momentum(self.handle, linear.map_or(std::ptr::null_mut(), |a| a.as_mut_ptr()), angular.map_or(std::ptr::null_mut(), |a| a.as_mut_ptr())) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    pub fn cracks_create(&self, desc: &CracksDesc) -> Result<Cracks> {
        let desc_raw = desc.raw();
        let mut made = std::ptr::null_mut();
        let result = unsafe { sys::peri_cracks_create(self.handle, &desc_raw, &mut made) };
        self.check(i64::from(result))?;
        Ok(Cracks { handle: made, dim: i64::from(self.dimension()) })
    }
    /// VTK XML for ParaView; "Warp By Vector" shows the deformed body.
    pub fn export_vtu_to(&self, write: &mut dyn FnMut(&[u8]) -> i32) -> Result<i32> {
        let mut holder = WriteFnHolder { call: Some(write) };
        let user = &mut holder as *mut _ as *mut c_void;
        let call_c: sys::peri_write_fn = Some(WriteFnHolder::call_c);
        let result = unsafe { sys::peri_export_vtu_to(self.handle, call_c, user) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// fields\[count\], each once, or NULL: as above.
    pub fn export_fields_to(&self, fields: Option<&[i32]>, write: &mut dyn FnMut(&[u8]) -> i32) -> Result<i32> {
        let count = (fields.as_deref().map_or(0, |a| a.len()) as i64);
        let mut holder = WriteFnHolder { call: Some(write) };
        let user = &mut holder as *mut _ as *mut c_void;
        let call_c: sys::peri_write_fn = Some(WriteFnHolder::call_c);
        let result = unsafe { sys::peri_export_fields_to(self.handle, fields.map_or(std::ptr::null(), |a| a.as_ptr()), count, call_c, user) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// One CSV line: step, time, the ledger, broken and cut bonds; header = 1: the names first.
    pub fn export_history_to(&self, header: i32, write: &mut dyn FnMut(&[u8]) -> i32) -> Result<i32> {
        let mut holder = WriteFnHolder { call: Some(write) };
        let user = &mut holder as *mut _ as *mut c_void;
        let call_c: sys::peri_write_fn = Some(WriteFnHolder::call_c);
        let result = unsafe { sys::peri_export_history_to(self.handle, header, call_c, user) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    pub fn export_vtu(&self, path: &str) -> Result<i32> {
        let path_c = c_text(path, "path")?;
        let result = unsafe { sys::peri_export_vtu(self.handle, path_c.as_ptr()) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// Frame 0, 1, ... of a series: its VTU beside \`path\`, a .pvd.
    pub fn export_frame(&self, path: &str, frame: i64, fields: Option<&[i32]>) -> Result<i32> {
        let count = (fields.as_deref().map_or(0, |a| a.len()) as i64);
        let path_c = c_text(path, "path")?;
        let result = unsafe { sys::peri_export_frame(self.handle, path_c.as_ptr(), frame, fields.map_or(std::ptr::null(), |a| a.as_ptr()), count) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// append = 0 starts the file with a header, 1 adds a line.
    pub fn export_history(&self, path: &str, append: i32) -> Result<i32> {
        let path_c = c_text(path, "path")?;
        let result = unsafe { sys::peri_export_history(self.handle, path_c.as_ptr(), append) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// Saves the state: motion, bonds, what criteria keep, time, ledger. Not the scene: load it into a body that the same calls
    /// built. What follows has the same bits.
    pub fn save_state_to(&self, write: &mut dyn FnMut(&[u8]) -> i32) -> Result<i32> {
        let mut holder = WriteFnHolder { call: Some(write) };
        let user = &mut holder as *mut _ as *mut c_void;
        let call_c: sys::peri_write_fn = Some(WriteFnHolder::call_c);
        let result = unsafe { sys::peri_save_state_to(self.handle, call_c, user) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    /// Reads all, verifies it, then takes it. PERI\_ERROR\_STATE: nothing has changed; field: what is of another scene, or "".
    pub fn load_state_from(&self, read: &mut dyn FnMut(&mut [u8]) -> i32) -> Result<i32> {
        let mut holder = ReadFnHolder { call: Some(read) };
        let user = &mut holder as *mut _ as *mut c_void;
        let call_c: sys::peri_read_fn = Some(ReadFnHolder::call_c);
        let result = unsafe { sys::peri_load_state_from(self.handle, call_c, user) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    pub fn save_state(&self, path: &str) -> Result<i32> {
        let path_c = c_text(path, "path")?;
        let result = unsafe { sys::peri_save_state(self.handle, path_c.as_ptr()) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    pub fn load_state(&self, path: &str) -> Result<i32> {
        let path_c = c_text(path, "path")?;
        let result = unsafe { sys::peri_load_state(self.handle, path_c.as_ptr()) };
        self.check(i64::from(result))?;
        Ok(result)
    }
    pub fn get_memory(&self) -> Result<Memory> {
        let mut memory = std::mem::MaybeUninit::<sys::peri_memory>::zeroed();
        let result = unsafe { sys::peri_get_memory(self.handle, memory.as_mut_ptr()) };
        self.check(i64::from(result))?;
        Ok(unsafe { memory.assume_init() })
    }
}

/// Owns a peri\_cracks. Cracks: midway through the broken bonds of adjacent points. They outlive the body; free them by
/// peri\_cracks\_destroy.
pub struct Cracks {
    handle: *mut sys::peri_cracks,
    #[allow(dead_code)]
    dim: i64,
}

// Any thread may use it, one at a time.
unsafe impl Send for Cracks {}

impl Drop for Cracks {
    fn drop(&mut self) {
        unsafe { sys::peri_cracks_destroy(self.handle) }
    }
}

impl Cracks {
    /// polylines; 3D: sides of cells
    pub fn paths(&self) -> i64 {
        unsafe { sys::peri_cracks_paths(self.handle) }
    }
    pub fn vertices(&self) -> i64 {
        unsafe { sys::peri_cracks_vertices(self.handle) }
    }
    pub fn tips(&self) -> i64 {
        unsafe { sys::peri_cracks_tips(self.handle) }
    }
    /// length \[L\]; 3D: area \[L^2\]
    pub fn size(&self) -> f64 {
        unsafe { sys::peri_cracks_size(self.handle) }
    }
    /// Path p: vertices start\[p\] to start\[p+1\], of start\[paths+1\]; in 3D 4: triangles 0 1 2, 0 2 3. vertex\[vertices\*dim\]
    /// \[L\], time\[vertices\] of breaking \[T\] (peri\_solve: load factor; NaN: not recorded), tip\[tips\]. Any may be NULL.
    pub fn get_cracks(&self, start: Option<&mut [i64]>, vertex: Option<&mut [f64]>, time: Option<&mut [f64]>, tip: Option<&mut [sys::peri_crack_tip]>) -> Result<i32> {
        if let Some(a) = start.as_deref() {
                    sized(a.len(), self.paths()+1, "start")?;
                }
        if let Some(a) = vertex.as_deref() {
                    sized(a.len(), self.vertices()*self.dim, "vertex")?;
                }
        if let Some(a) = time.as_deref() {
                    sized(a.len(), self.vertices(), "time")?;
                }
        if let Some(a) = tip.as_deref() {
                    sized(a.len(), self.tips(), "tip")?;
                }
        let result = unsafe { sys::peri_get_cracks(self.handle, start.map_or(std::ptr::null_mut(), |a| a.as_mut_ptr()), vertex.map_or(std::ptr::null_mut(), |a| a.as_mut_ptr()), time.map_or(std::ptr::null_mut(), |a| a.as_mut_ptr()), tip.map_or(std::ptr::null_mut(), |a| a.as_mut_ptr())) };
        known(i64::from(result), &blank())?;
        Ok(result)
    }
    /// VTK XML PolyData (.vtp).
    pub fn export_cracks_to(&self, write: &mut dyn FnMut(&[u8]) -> i32) -> Result<i32> {
        let mut holder = WriteFnHolder { call: Some(write) };
        let user = &mut holder as *mut _ as *mut c_void;
        let call_c: sys::peri_write_fn = Some(WriteFnHolder::call_c);
        let result = unsafe { sys::peri_export_cracks_to(self.handle, call_c, user) };
        known(i64::from(result), &blank())?;
        Ok(result)
    }
}

/// Owns a peri\_matrix. The same as a matrix by compressed rows, points\*dim square (\[T\] 3.2, 3.3). It outlives the body; free it
/// by peri\_matrix\_destroy.
pub struct Matrix {
    handle: *mut sys::peri_matrix,
    #[allow(dead_code)]
    dim: i64,
}

// Any thread may use it, one at a time.
unsafe impl Send for Matrix {}

impl Drop for Matrix {
    fn drop(&mut self) {
        unsafe { sys::peri_matrix_destroy(self.handle) }
    }
}

impl Matrix {
    /// The same as a matrix by compressed rows, points\*dim square (\[T\] 3.2, 3.3). It outlives the body; free it by
    /// peri\_matrix\_destroy.
    pub fn rows(&self) -> i64 {
        unsafe { sys::peri_matrix_rows(self.handle) }
    }
    /// The same as a matrix by compressed rows, points\*dim square (\[T\] 3.2, 3.3). It outlives the body; free it by
    /// peri\_matrix\_destroy.
    pub fn entries(&self) -> i64 {
        unsafe { sys::peri_matrix_entries(self.handle) }
    }
    /// start\[rows+1\], column\[entries\] ascending in each row, value\[entries\] \[M T^-2\]; any may be NULL.
    pub fn get_matrix(&self, start: Option<&mut [i64]>, column: Option<&mut [i32]>, value: Option<&mut [f64]>) -> Result<i32> {
        if let Some(a) = start.as_deref() {
                    sized(a.len(), self.rows()+1, "start")?;
                }
        if let Some(a) = column.as_deref() {
                    sized(a.len(), self.entries(), "column")?;
                }
        if let Some(a) = value.as_deref() {
                    sized(a.len(), self.entries(), "value")?;
                }
        let result = unsafe { sys::peri_get_matrix(self.handle, start.map_or(std::ptr::null_mut(), |a| a.as_mut_ptr()), column.map_or(std::ptr::null_mut(), |a| a.as_mut_ptr()), value.map_or(std::ptr::null_mut(), |a| a.as_mut_ptr())) };
        known(i64::from(result), &blank())?;
        Ok(result)
    }
    /// Matrix Market, coordinate real symmetric: the lower triangle.
    pub fn export_matrix_to(&self, write: &mut dyn FnMut(&[u8]) -> i32) -> Result<i32> {
        let mut holder = WriteFnHolder { call: Some(write) };
        let user = &mut holder as *mut _ as *mut c_void;
        let call_c: sys::peri_write_fn = Some(WriteFnHolder::call_c);
        let result = unsafe { sys::peri_export_matrix_to(self.handle, call_c, user) };
        known(i64::from(result), &blank())?;
        Ok(result)
    }
}

/// \*body is NULL on failure. error may be NULL.
pub fn body_create(desc: BodyDesc) -> Result<Body> {
    let all: Keep = Arc::default();
    let mut desc_raw = desc.raw();
    let influence_user_holder = Arc::new(BodyDescInfluenceUser { influence_fn: desc.influence_fn });
    influence_user_holder.fill(&mut desc_raw, Arc::as_ptr(&influence_user_holder) as *mut c_void);
    keep(&all, influence_user_holder);
    let log_user_holder = Arc::new(BodyDescLogUser { log: desc.log });
    log_user_holder.fill(&mut desc_raw, Arc::as_ptr(&log_user_holder) as *mut c_void);
    keep(&all, log_user_holder);
    let mut made = std::ptr::null_mut();
    let mut record = blank();
    let result = unsafe { sys::peri_body_create(&desc_raw, &mut made, &mut record) };
    known(i64::from(result), &record)?;
    Ok(Body { handle: made, keep: all })
}

/// What a scene will cost, before it is made: some milliseconds. Refuses what peri\_body\_create, peri\_add\_material, peri\_add\_box
/// and peri\_build would refuse. error may be NULL.
pub fn plan(desc: &PlanDesc) -> Result<PlanReport> {
    let mut desc_raw = desc.raw();
    let body_pointed = desc.body.map(|d| d.raw());
    desc_raw.body = body_pointed.as_ref().map_or(std::ptr::null(), |d| d as *const _);
    let material_pointed = desc.material.map(|d| d.raw());
    desc_raw.material = material_pointed.as_ref().map_or(std::ptr::null(), |d| d as *const _);
    let mut report = std::mem::MaybeUninit::<sys::peri_plan_report>::zeroed();
    let mut record = blank();
    let result = unsafe { sys::peri_plan(&desc_raw, report.as_mut_ptr(), &mut record) };
    known(i64::from(result), &record)?;
    Ok(unsafe { report.assume_init() })
}

/// Fills body (precision, influence, quadrature, correction, horizon) and material (law, poisson, stabilization) with the best
/// choice, from a measured table; the rest stays. body needs its space, material its constants. PERI\_ERROR\_RANGE: out of reach; the
/// value is what is in reach. error may be NULL.
pub fn choose(desc: &ChooseDesc, body: &mut BodyDesc, material: &mut MaterialDesc) -> Result<ChooseReport> {
    let desc_raw = desc.raw();
    let mut body_raw = body.raw();
    let mut material_raw = material.raw();
    let mut report = std::mem::MaybeUninit::<sys::peri_choose_report>::zeroed();
    let mut record = blank();
    let result = unsafe { sys::peri_choose(&desc_raw, &mut body_raw, &mut material_raw, report.as_mut_ptr(), &mut record) };
    known(i64::from(result), &record)?;
    body.take(&body_raw);
    material.take(&material_raw);
    Ok(ChooseReport::of(&unsafe { report.assume_init() }))
}
