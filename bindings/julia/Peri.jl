# SPDX-License-Identifier: MIT
"""
peri for Julia: deformation and fracture of solids by nonlocal bonds. Made from peri.h by tools/bind.py: edit that.

The shared library is that of the environment variable PERI, else libperi. Names are those of peri.h: `peri_add_box(body, ...)` is
`Peri.add_box(body, ...)`, `PERI_SPACE_SOLID` is `Peri.SPACE_SOLID`, `peri_body_desc` with its init function is `Peri.body_desc()`. A function
that fills arrays has a `!` and takes them; without it returns new ones. `nothing` stands for NULL. Points count from 0. A call that fails
throws a `Peri.Error`; what a function of yours throws stops the call that it came from and comes out of it.
"""
module Peri

const LIB = get(ENV, "PERI", "libperi")

const VERSION = "0.2.0"
const VERSION_NUMBER = Int32(2000)
const ALL = Int32(268435456)
const BRITTLE = Int32(2) # success: as brittle bonds, the horizon being too large
const STOPPED = Int32(1) # a callback asked to stop; the body is at a whole step
const OK = Int32(0) # success
const ERROR_ARGUMENT = Int32(-1) # missing, NULL or given twice, or a count that is wrong
const ERROR_CHOICE = Int32(-2) # not a value of this enum, or a flag that is not 0 or 1
const ERROR_DESCRIPTOR = Int32(-3) # not filled by its init function, or of another version
const ERROR_RANGE = Int32(-4) # a number is not finite or outside the range of its field
const ERROR_ORDER = Int32(-5) # too early, too late, or from a callback that may not
const ERROR_MEMORY = Int32(-6) # the allocator returned NULL
const ERROR_TOO_LARGE = Int32(-7) # more than the library or memory takes; see the value
const ERROR_CAPACITY = Int32(-8) # the buffer has the wrong size; it needs the value
const ERROR_ID_NONE = Int32(-9) # no id: zero, a plain number, or what a failed call returned
const ERROR_ID_KIND = Int32(-10) # an id of another kind: of a load, say, not of a set
const ERROR_ID_BODY = Int32(-11) # an id of another body
const ERROR_ID_GONE = Int32(-12) # nothing has this id: it was removed, or never given
const ERROR_INDEX = Int32(-13) # no point has this number
const ERROR_NAME = Int32(-14) # a name that is taken, or that no set has
const ERROR_EMPTY = Int32(-15) # the body, the shape or the selection holds no point
const ERROR_MATERIAL = Int32(-16) # the material contradicts itself, or is missing
const ERROR_POISSON = Int32(-17) # bond-based: Poisson's ratio is fixed; it is the value
const ERROR_LAW = Int32(-18) # this law has no such thing, or cannot take this
const ERROR_CRITERION = Int32(-19) # the criterion cannot act on this law, or lacks its G0
const ERROR_INFLUENCE = Int32(-20) # the influence function or its moments are not finite
const ERROR_POINT = Int32(-21) # a place not finite, no volume, or a cell that crosses itself
const ERROR_COINCIDENT = Int32(-22) # two points are at the same place
const ERROR_HORIZON = Int32(-23) # the horizon is smaller than the spacing of the points
const ERROR_FAMILY = Int32(-24) # a point has no neighbour, or none with a weight
const ERROR_IBOND = Int32(-25) # given families: wrong number, not mutual, not of the horizon
const ERROR_CRACK = Int32(-26) # the crack has no extent, or is not for this space
const ERROR_PAIR = Int32(-27) # the two points share no bond
const ERROR_FIELD = Int32(-28) # this field cannot be used in this way: it is not stored
const ERROR_AREA = Int32(-29) # the points feel another area than that of the face
const ERROR_STEP = Int32(-30) # the time step exceeds the stable step, which is the value
const ERROR_UNSTABLE = Int32(-31) # a point passed 1e9 speeds of sound: step, load or start
const ERROR_CALLBACK = Int32(-32) # a callback failed, or wrote what is not finite
const ERROR_LOOSE = Int32(-33) # no support holds this part against some motion
const ERROR_INDEFINITE = Int32(-34) # the tangent is not positive: buckling or softening
const ERROR_CONVERGENCE = Int32(-35) # no equilibrium within the iterations; value: residual
const ERROR_WRITE = Int32(-36) # the file or the write callback failed
const ERROR_LEFT_OUT = Int32(-37) # left out of this build, by the switch that the field names
const ERROR_STATE = Int32(-38) # no saved state of such a body, or damaged; value: the byte
const ERROR_PART = Int32(-39) # not of a part of a body; or its ghosts are not as owned
const KIND_MATERIAL = Int32(2201)
const KIND_SET = Int32(2202)
const KIND_LOAD = Int32(2203) # supports included
const KIND_OBSTACLE = Int32(2204)
const SPACE_PLANE_STRESS = Int32(101) # 2D, thin plate; bond-based: Poisson's ratio 1/3
const SPACE_PLANE_STRAIN = Int32(102) # 2D, long prism; bond-based: 1/4
const SPACE_SOLID = Int32(103) # 3D; bond-based: 1/4
const PRECISION_DOUBLE = Int32(201)
const PRECISION_MIXED = Int32(202) # state in double, bonds in single: strain to 7 digits
const PRECISION_SINGLE = Int32(203) # faster, 0.65 of the memory; strains below 1e-6 lose digits
const GEOMETRY_NONLINEAR = Int32(301) # e = |xi+eta| - |xi|, force along xi+eta ([T] 1.23)
const GEOMETRY_LINEAR = Int32(302) # e = xi.eta/|xi|, force along xi: small motion ([T] 1.37)
const INFLUENCE_CONSTANT = Int32(401) # 1, also beyond [P] w0, [C] Const
const INFLUENCE_CUTOFF = Int32(402) # 1, beyond 0 [P] w0.5
const INFLUENCE_LINEAR = Int32(403) # 1 - q, beyond 0 [P] w1, [C] Linear
const INFLUENCE_CUBIC = Int32(404) # 1 - 3q^2 + 2q^3, beyond 0 [P] w3
const INFLUENCE_QUINTIC = Int32(405) # 1 - 10q^3 + 15q^4 - 6q^5, beyond 0 [P] w5
const INFLUENCE_SEPTIC = Int32(406) # 1 - 35q^4 + 84q^5 - 70q^6 + 20q^7, beyond 0 [P] w7
const INFLUENCE_POWER_2 = Int32(407) # (1 - q)^2, beyond 0 [C] Quadr
const INFLUENCE_POWER_3 = Int32(408) # (1 - q)^3, beyond 0 [C] Cubic
const INFLUENCE_GAUSSIAN = Int32(409) # exp(-q^2), also beyond [T]
const INFLUENCE_PROPORTIONAL = Int32(410) # q, also beyond [T]
const INFLUENCE_INVERSE = Int32(411) # 1/q, also beyond [T], [C] Inv
const INFLUENCE_INVERSE_4 = Int32(412) # q^-4, also beyond; no finite moments [T]
const INFLUENCE_POLE_EDGE = Int32(413) # 1/(1 + spacing/(2 horizon) - q) [T]
const INFLUENCE_POLE_HALF = Int32(414) # 1/|2q - 1|, also beyond; no finite moments [T]
const INFLUENCE_POLE_QUARTER = Int32(415) # exp(1/(q - 1/4)), also beyond; no moments; [T] in mm
const INFLUENCE_USER = Int32(416) # influence_fn
const QUADRATURE_FULL = Int32(501) # cells whose centre is within, whole [P] FA
const QUADRATURE_RAMP = Int32(502) # from 1 to 0 over horizon -+ spacing/2 [T] Fig. 3.7
const QUADRATURE_PARTIAL = Int32(503) # the exact part within the horizon [P] PA-AC
const QUADRATURE_PARTIAL_CENTROID = Int32(504) # 2D, to its centroid [P] IPA-AC: for comparison
const QUADRATURE_PARTIAL_MOMENT = Int32(505) # 2D, the centroid's energy, objective
const BREAK_WITHIN_STEP = Int32(601) # a bond acts until it meets its criterion; error O(dt^2)
const BREAK_AFTER_DRIFT = Int32(602) # until the middle of the step [P]; ledger error O(dt)
const CORRECTION_NONE = Int32(701) # the constants of an infinite body
const CORRECTION_VOLUME = Int32(702) # bond-based, by volumes (Le, Bobaru 2018): for comparison
const CORRECTION_ENERGY = Int32(703) # bond-based: right energy of isotropic strain and mean shear
const CORRECTION_MOMENT = Int32(704) # weights, as little as makes uniform strain exact on lattices
const CORRECTION_EQUILIBRIUM = Int32(705) # and in equilibrium inside on any cloud; not of parts
const MOMENTS_LIVE = Int32(2501) # those left: they take over what others carried
const MOMENTS_WHOLE = Int32(2502) # all, broken and cut ones included
const KERNEL_BEST = Int32(801) # columns on lattices where that serves, else a list
const KERNEL_REFERENCE = Int32(802) # every quantity by its formula, bond by bond: slow
const KERNEL_LIST = Int32(803) # the list of families, as clouds have it
const INSTRUCTIONS_BEST = Int32(901) # of the machine
const INSTRUCTIONS_BASELINE = Int32(902) # SSE2
const INSTRUCTIONS_AVX2 = Int32(903)
const INSTRUCTIONS_AVX512 = Int32(904) # F, VL, DQ and BW
const LAW_BOND_BASED = Int32(1001) # t = 1/2 c w s, s = e/|xi|: PMB, generalised [P] A, [T] 1.23
const LAW_LPS = Int32(1002) # t = (w/m)(A theta |xi| + B e) [T] 1.54, 1.67, [C] 2-7
const LAW_OTERKUS = Int32(1003) # t = 2 w (a d theta + b e), on each family [C] 8-17
const LAW_CORRESPONDENCE = Int32(1004) # T = w P K^-1 xi, stabilised [C] 18-21
const CRITERION_STRETCH = Int32(1101) # s > s0 [T] 1.40, 1.41
const CRITERION_BOND_ENERGY = Int32(1102) # state-based: work on the bond > w0 [T] 1.100
const CRITERION_NODE_ENERGY = Int32(1103) # state-based: mean energy of both ends > w0 [T] 1.102
const CRITERION_PRINCIPAL_STRESS = Int32(1104) # tension along the bond > strength
const CRITERION_VON_MISES = Int32(1105) # von Mises's > strength; shortened bonds, too
const CRITERION_MOHR_COULOMB = Int32(1106) # shear > cohesion - tan(friction_angle) normal
const CRITERION_CONFINED_STRETCH = Int32(1107) # s > s0 - compression * least s at either end
const CRITERION_RATE_STRETCH = Int32(1108) # s > s0 (1 + (ds/dt / rate)^rate_power)
const CRITERION_DELAYED_STRETCH = Int32(1109) # s > s0 for `delay` in all
const SOFTENING_BILINEAR = Int32(2901) # straight
const SOFTENING_TRILINEAR = Int32(2902) # kinked at 1/4 of the strength: concrete
const SOFTENING_EXPONENTIAL = Int32(2903) # cut off at 1/100 of the strength
const SOFTENING_TABLE = Int32(2904) # a table of yours
const UNLOADING_SECANT = Int32(3001) # to the origin: damage
const UNLOADING_ELASTIC = Int32(3002) # as stiff as new: a stretch stays
const REDUCTION_SUM = Int32(3901)
const REDUCTION_MAX = Int32(3902)
const CUT_INITIAL = Int32(2101) # an initial crack: stays at peri_reset. Only before the first step
const CUT_NOW = Int32(2102) # counts as broken, whole again at peri_reset
const CUT_IN_PLACE = Int32(2103) # as PERI_CUT_NOW, where the body is now: by current positions
const AXIS_X = Int32(4097)
const AXIS_Y = Int32(4098)
const AXIS_Z = Int32(4100)
const AXIS_XY = Int32(4099)
const AXIS_XYZ = Int32(4103)
const SHAPE_PLANE = Int32(2601) # all behind the plane through 0 with `normal`
const SHAPE_BALL = Int32(2602) # radius; 2D: a disc
const SHAPE_BOX = Int32(2603) # size, about 0
const SHAPE_CAPSULE = Int32(2604) # within radius of a line of `length` along `axis`, about 0
const SHAPE_CYLINDER = Int32(2605) # 3D: the same with flat ends
const SHAPE_MESH = Int32(2606) # within the closed surface of vertices and faces
const SHAPE_DISTANCE = Int32(2607) # where `distance` is below 0
const INTEGRATOR_VELOCITY_VERLET = Int32(1201) # half kick, drift, force, half kick [T] 2.2
const INTEGRATOR_CENTRAL_DIFFERENCE = Int32(1202) # one kick per step, the same motion [L], [T] 2.10
const METHOD_NEWTON = Int32(1301) # conjugate gradients on the tangent, never stored
const METHOD_BICGSTAB = Int32(1302) # on the assembled tangent ([T] 3.2): for comparison
const METHOD_RELAXATION = Int32(1303) # adaptive dynamic relaxation: slow, any tangent
const PRECONDITIONER_MULTILEVEL = Int32(1401) # blocks, and elasticity on background grids
const PRECONDITIONER_BLOCK_JACOBI = Int32(1402) # the dim x dim blocks of the diagonal
const PRECONDITIONER_NONE = Int32(1403)
const LOOSE_REFUSED = Int32(1501) # PERI_ERROR_LOOSE, index: a point of it; see lost_parts
const LOOSE_PINNED = Int32(1502) # just enough is held; exact where loads balance
const LOOSE_BALANCED = Int32(1503) # the part of the loads that drives the mode is left out
const CONTROL_LOAD = Int32(2801) # the load steps
const CONTROL_FRACTURE = Int32(2802) # where the next bond meets its criterion: through snap-back
const ENDED_LOAD = Int32(2701) # load_to is reached
const ENDED_SEVERED = Int32(2702) # a part that bears a load or a support broke off
const ENDED_BREAKS = Int32(2703)
const ENDED_STOPPED = Int32(2704)
const FIELD_POSITION = Int32(2001) # S [dim] reference position [L]
const FIELD_DISPLACEMENT = Int32(2002) # SW [dim] [L]
const FIELD_VELOCITY = Int32(2003) # SW [dim] [L T^-1]
const FIELD_FORCE_DENSITY = Int32(2004) # S [dim] internal, loads, obstacles, contact
const FIELD_VOLUME = Int32(2005) # S [L^3]; planes: area [L^2]
const FIELD_MATERIAL = Int32(2006) # PERI_ID_INDEX of the material
const FIELD_FAMILY_SIZE = Int32(2007) # bonds of the point, broken ones included
const FIELD_DAMAGE = Int32(2008) # 1 - intact/all volume of the family [-] [L]
const FIELD_DAMAGE_GROWN = Int32(2009) # the same among bonds that are not initial cracks
const FIELD_ENERGY_DENSITY = Int32(2010) # elastic W of the law [M L^-1 T^-2] [P] eq. 7
const FIELD_CURRENT_POSITION = Int32(2011) # [dim] [L]
const FIELD_DILATATION = Int32(2012) # theta of the law [-]
const FIELD_STRAIN = Int32(2013) # [tensor] of F: small, or Green-Lagrange [T] 4.14
const FIELD_STRESS = Int32(2014) # [tensor] Cauchy, of the material [M L^-1 T^-2]
const FIELD_FORCE_STRESS = Int32(2015) # [tensor] Cauchy, what the bonds carry [T] 4.10, 4.13
const FIELD_REACTION = Int32(2016) # [dim] force density of supports, mean of the last step
const FIELD_FRAGMENT = Int32(2017) # peri_find_fragments
const FIELD_MASS = Int32(2018) # [M]; planes: thickness included
const FIELD_DENSITY = Int32(2019) # W [M L^-3] Default: of the material
const FIELD_HELD = Int32(2020) # [dim] 1: a support prescribes it; else 0
const FIELD_EIGENSTRAIN = Int32(2021) # W stretch at no force [-] -0.9..10. Default 0
const FIELD_STRENGTH = Int32(2022) # W times s0, squared times w0 [-] 1e-6..1e6. Default 1
const FIELD_STIFFNESS = Int32(2023) # W times E [-] 1e-6..1e6. Default 1
const FIELD_DEFORMATION_GRADIENT = Int32(2024) # [dim*dim] F by rows
const TYPE_F64 = Int32(1601)
const TYPE_F32 = Int32(1602)
const TYPE_I32 = Int32(1603)
const BOND_POINT = Int32(4001) # i
const BOND_OTHER = Int32(4002) # j
const BOND_LENGTH = Int32(4003) # |xi| [L]
const BOND_VOLUME = Int32(4004) # beta V_j [L^3]
const BOND_WEIGHT = Int32(4005) # w beta V_j, corrected
const BOND_INTACT = Int32(4006) # 1 or 0
const BOND_STRETCH = Int32(4007) # [-]
const BOND_FORCE = Int32(4008) # [dim] part of the force density of i
const BOND_ENERGY = Int32(4009) # and of the energy density
const SOURCE_BOX = Int32(1701) # peri_add_box
const SOURCE_PERTURBED = Int32(1702) # peri_add_perturbed_box
const SOURCE_POINTS = Int32(1703) # peri_add_points: a cloud, about one point to a cell
const QUANTITY_DEFORMATION = Int32(1801) # stiffness; the least thickness that carries
const QUANTITY_STRESS = Int32(1802) # around holes and notches; the radius
const QUANTITY_WAVES = Int32(1803) # their way; the shortest wavelength
const QUANTITY_FRACTURE = Int32(1804) # when cracks grow; the crack's length, 8 spacings or more
const PRESET_NONE = Int32(1901)
const PRESET_GAME = Int32(1902) # 20 %
const PRESET_TEACHING = Int32(1903) # 10 %
const PRESET_ENGINEERING = Int32(1904) # 5 %
const PRESET_REFERENCE = Int32(1905) # deformation 1 %, stress 2 %, waves and fracture 3 %

# ---- structs as C has them

struct peri_error
    code::Int32 # peri_status
    reserved::Int32 # 0
    index::Int64 # first offending point, entry or id; else -1
    value::Float64 # the offending value, or the limit that was passed; else 0
    field::Ptr{UInt8} # constant text: the name in this header of what is at fault, or ""
    text::Ptr{UInt8} # constant text: peri_status_text(code)
end

"""
Points whose stress is asked for; matrices by rows, out: to be written.
"""
struct peri_stress_block
    count::Int64
    points::Ptr{Int32} # [count]
    gradient::Ptr{Float64} # [count][dim][dim] H = F - 1
    time_step::Float64 # [T] since the history was committed
    history::Ptr{Float64} # [count][history] as committed; out: as it becomes
    stress::Ptr{Float64} # [count][dim][dim] out: P, first Piola-Kirchhoff; linear: Cauchy
    tangent::Ptr{Float64} # [count][dim^2][dim^2] out: dP/dH, symmetric; NULL: not wanted
    energy::Ptr{Float64} # [count] out: stored [M L^-1 T^-2]. 0
    dissipation::Ptr{Float64} # [count] out: lost in time_step, likewise. 0
end

"""
Bonds of one point to others[]: arrays of `count`. All that is written is 0 at first.
"""
struct peri_bond_row
    point::Int32
    count::Int32
    others::Ptr{Int32}
    length::Ptr{Float64} # |xi| [L]
    stretch::Ptr{Float64} # s = e/|xi| [-]; 0 of broken bonds
    state::Ptr{Float64} # [count*states] in: as last kept; out: as it is with this stretch
    force::Ptr{Float64} # out [-] f/c: the stretch at which a linear bond pulls as hard
    tangent::Ptr{Float64} # out, its derivative; this and what follows NULL where not asked for
    energy::Ptr{Float64} # out: stored, of which `force` is the derivative at constant state
    lost::Ptr{Float64} # out: lost since `state` was kept
    broken::Ptr{Int32} # out: 1 breaks the bond for good
end

mutable struct peri_body_desc
    cookie::UInt64 # set by init
    space::Int32 # peri_space. Required
    precision::Int32 # Default PERI_PRECISION_DOUBLE
    geometry::Int32 # Default PERI_GEOMETRY_NONLINEAR
    influence::Int32 # Default PERI_INFLUENCE_CONSTANT
    quadrature::Int32 # Default PERI_QUADRATURE_FULL
    correction::Int32 # Default PERI_CORRECTION_NONE
    break_timing::Int32 # Default PERI_BREAK_WITHIN_STEP
    moments::Int32 # Default PERI_MOMENTS_LIVE
    kernel::Int32 # Default PERI_KERNEL_BEST
    instructions::Int32 # Default PERI_INSTRUCTIONS_BEST
    threads::Int32 # 0 (default): as OpenMP says; 1: serial; n: n threads
    ledger::Int32 # 1 (default): account for work while running; 0: not
    number::Int32 # 1..127, in its ids; 0 (default): from its address
    reserved::Int32 # 0
    horizon::Float64 # [L] > 0. Required. 3 to 4 spacings
    thickness::Float64 # [L] > 0, of planes. Default 1
    influence_fn::Ptr{Cvoid} # for PERI_INFLUENCE_USER
    influence_user::Ptr{Cvoid}
    allocate::Ptr{Cvoid} # Default NULL: malloc
    release::Ptr{Cvoid} # Default NULL: free
    memory_user::Ptr{Cvoid}
    parallel_for::Ptr{Cvoid} # Default NULL: OpenMP, or serial
    parallel_user::Ptr{Cvoid}
    log::Ptr{Cvoid} # Default NULL: silent
    log_user::Ptr{Cvoid}
    peri_body_desc() = new()
end

mutable struct peri_material_desc
    cookie::UInt64 # set by init
    law::Int32 # peri_law
    criterion::Int32 # Default PERI_CRITERION_STRETCH
    young::Float64 # E [M L^-1 T^-2] > 0. Give E or K, not both; 0 = not given
    bulk::Float64 # K = E/(3(1-2 nu)) [M L^-1 T^-2] > 0
    poisson::Float64 # [-] in (-1, 1/2); NaN (default): bond-based, that of the space
    density::Float64 # [M L^-3] > 0. Required
    fracture_energy::Float64 # G0 [M T^-2] > 0, per area of crack. 0 (default) = not given
    critical_stretch::Float64 # s0 [-] > 0. 0 (default) = from G0; with neither, no bond breaks
    stabilization::Float64 # [-] >= 0, correspondence: against zero-energy modes. Default 0.2
    strength::Float64 # [M L^-1 T^-2] > 0 of the criteria of stress; Mohr-Coulomb: or 0
    cohesion::Float64 # [M L^-1 T^-2] > 0 of Mohr-Coulomb
    friction_angle::Float64 # [-] [0, pi/2) likewise
    compression::Float64 # alpha [-] 0..1e3, of the confined stretch. 0 (default): none
    rate::Float64 # [T^-1] > 0 of the rate stretch, and
    rate_power::Float64 # [-] 0..10. 0 (default): 1
    delay::Float64 # [T] > 0 of the delayed stretch
    yield_shear::Float64 # LPS: [M L^-1 T^-2] in shear, at which it flows. Default 0: never
    relaxations::Int32 # LPS, viscous: 0..PERI_RELAXATIONS. Default 0
    history::Int32 # numbers per point for `stress`, 0..PERI_HISTORY. Default 0
    relaxation_part::NTuple{4,Float64} # (0, 1] of the stiffness in shear, and
    relaxation_time::NTuple{4,Float64} # [T] > 0 in which it relaxes
    stress::Ptr{Cvoid} # correspondence: yours. Default NULL
    stress_user::Ptr{Cvoid}
    peri_material_desc() = new()
end

mutable struct peri_softening_desc
    cookie::UInt64 # set by init
    shape::Int32 # peri_softening, set by init
    unloading::Int32 # Default PERI_UNLOADING_SECANT
    strength::Float64 # [M L^-1 T^-2] > 0, of uniaxial tension. Required
    fracture_energy::Float64 # [M T^-2] > 0, the area under the curve. Required
    compression::Float64 # (0, 1] stiffness when shorter, over that when longer. Default 1
    count::Int64 # 2..30 rows of
    table::Ptr{Float64} # [count*2] stretch past the strength, of any scale, from 0 ascending; force over the strength, from 1 to 0, descending
    peri_softening_desc() = new()
end

"""
Cells: polygons, convex or not; tetrahedra, pyramids, wedges, hexahedra (4, 5, 6, 8 corners) in VTK's order, or mirrored.
"""
mutable struct peri_cells_desc
    cookie::UInt64 # set by init
    vertex_count::Int64
    vertices::Ptr{Float64} # [vertex_count*vertex_stride] [L]
    vertex_stride::Int64 # Default 0: dim
    cell_count::Int64
    corners::Ptr{Int32} # of cell 0, 1, ...
    offsets::Ptr{Int64} # [cell_count+1] in corners[]. Default NULL: cell_corners each
    cell_corners::Int32
    reserved::Int32 # 0
    materials::Ptr{Int32} # [cell_count]. Default NULL
    peri_cells_desc() = new()
end

"""
Ghosts: copies of points that other parts own, peri_ghost_depth horizons deep. They bear no load and are in no set, sum or count.
Give them all else that their owners have: cuts, motion.
"""
mutable struct peri_part_desc
    cookie::UInt64 # set by init
    origin::NTuple{3,Float64} # [L] any; this and the next two alike on all parts. Required
    length::Float64 # [L] > 0: the spacing; that of boxes to a factor of 16
    mean_volume::Float64 # [L^3] > 0, planes [L^2], of a point
    ghost_count::Int64 # Default 0
    ghosts::Ptr{Int32} # [ghost_count] points, ascending
    owners::Ptr{Int32} # [ghost_count] the point that it is an image of in a periodic body, or -1. Default NULL: none is
    ids::Ptr{Int64} # [points] in the whole body, ascending. Default NULL: unknown
    exchange::Ptr{Cvoid} # where another part owns ghosts. Default NULL
    reduce::Ptr{Cvoid} # of several parts. Default NULL
    user::Ptr{Cvoid}
    peri_part_desc() = new()
end

"""
A rigid body of point masses; in 2D vectors end with 0.
"""
struct peri_fragment
    first::Int32 # its least point
    points::Int32 # how many
    parent::Int32 # the fragment that it broke off, or -1
    held::Int32 # 1: a support holds a point of it
    mass::Float64 # [M]
    centre::NTuple{3,Float64} # [L] of mass, now
    velocity::NTuple{3,Float64} # [L T^-1] of the centre
    angular::NTuple{3,Float64} # [M L^2 T^-1] momentum about the centre
    inertia::NTuple{6,Float64} # [M L^2] about the centre: xx yy zz xy yz xz
    lo::NTuple{3,Float64} # [L] box around its points, now
    hi::NTuple{3,Float64}
end

"""
Pushes points within it out along the normal by stiffness*depth [M L^-2 T^-2]. A free one (of a mass) is moved by that and by
gravity, not by other obstacles.
"""
mutable struct peri_obstacle_desc
    cookie::UInt64 # set by init
    shape::Int32 # peri_shape, set by init
    reserved::Int32 # 0
    place::NTuple{3,Float64} # of the frame, and
    turn::NTuple{4,Float64} # see peri_motion_fn. Default 0: the frame of the body
    normal::NTuple{3,Float64} # of a plane,
    axis::NTuple{3,Float64} # of capsule and cylinder, of any length
    radius::Float64 # [L] > 0; PERI_SHAPE_DISTANCE: all lies within it, 0: unknown
    length::Float64 # [L] > 0
    size::NTuple{3,Float64} # [L] > 0
    vertex_count::Int64
    face_count::Int64
    vertices::Ptr{Float64} # [vertex_count*dim] [L]; 2D: of a polygon, counter-clockwise
    faces::Ptr{Int32} # 3D: [face_count*3], counter-clockwise from outside
    distance::Ptr{Cvoid}
    stiffness::Float64 # [M L^-3 T^-2]. 0 (default): young/spacing^2
    friction::Float64 # mu [-] >= 0, Coulomb. Default 0
    friction_speed::Float64 # [L T^-1] >= 0: slower slip is resisted less. 0 (default): 1e-6 sqrt(young/density)
    restitution::Float64 # (0, 1], of what is stiff beside the obstacle. Default 1
    mass::Float64 # [M] > 0: a free rigid body. Default 0; or
    density::Float64 # [M L^-3] > 0: likewise. Default 0
    inertia::NTuple{3,Float64} # [M L^2] about the axes of the frame, 2D: inertia[0]; HUGE_VAL: never turns. 0 (default): of the shape, uniform
    velocity::NTuple{3,Float64} # [L T^-1] of a free one at the start
    spin::NTuple{3,Float64} # [T^-1] likewise; 2D: spin[0]
    gravity::NTuple{3,Float64} # [L T^-2] of a free one
    motion::Ptr{Cvoid} # of others. Default NULL: at rest
    user::Ptr{Cvoid} # of distance and motion
    peri_obstacle_desc() = new()
end

"""
of its frame; components beyond dim are 0
"""
struct peri_obstacle_state
    place::NTuple{3,Float64}
    turn::NTuple{4,Float64}
    velocity::NTuple{3,Float64} # mean of the last step; of a free one now; and
    spin::NTuple{3,Float64} # [T^-1] likewise; 2D: spin[0]
    mass::Float64 # [M] of a free one, else 0
    kinetic::Float64 # [M L^2 T^-2] likewise
    stored::Float64 # [M L^2 T^-2] in its springs
    lost::Float64 # to friction and restitution since build or reset
end

"""
Unbonded surface points: 1/2 k (d - r)^2 where r < d = min(distance, |xi|), k = stiffness E V /(spacing distance)
"""
mutable struct peri_contact_desc
    cookie::UInt64 # set by init
    stiffness::Float64 # (0, 1e3] of a cell's own [-]. Default 0.25
    distance::Float64 # [L] Default 0: the spacing
    friction::Float64 # mu [-] 0..1e3. Default 0
    friction_speed::Float64 # [L T^-1] below it: viscous. Default 0
    restitution::Float64 # (0, 1] of light pieces. Default 1
    peri_contact_desc() = new()
end

mutable struct peri_advance_desc
    cookie::UInt64 # set by init
    integrator::Int32 # Default PERI_INTEGRATOR_VELOCITY_VERLET
    force_step::Int32 # 1: time_step may exceed peri_stable_step. Default 0
    steps::Int64 # run this many steps; or
    duration::Float64 # [T] run this long, to the last bit. One of the two is required
    time_step::Float64 # [T] > 0; 0 (default): safety * peri_stable_step
    safety::Float64 # (0, 1]. Default 0.9
    damping::Float64 # a [T^-1] >= 0: force -a*density*velocity. Default 0
    load_factor::Float64 # NaN (default): peri_load_factor, or 1 where none has acted
    frame_steps::Int64 # steps between calls of on_frame; 0 (default): only at the end
    on_frame::Ptr{Cvoid} # Default NULL
    user::Ptr{Cvoid}
    peri_advance_desc() = new()
end

mutable struct peri_evaluate_desc
    cookie::UInt64 # set by init
    type::Int32 # of all arrays: PERI_TYPE_F64 (default) or PERI_TYPE_F32
    nodal::Int32 # 1: forces [M L T^-2]; 0 (default): per volume [M L^-2 T^-2]
    bonds::Int32 # 1 (default): theirs; 0: not
    external::Int32 # 1 (default): of loads (moving: obstacles, contact); 0: not
    fracture::Int32 # 1: the body moves there, and bonds break. Default 0: it stays
    energy::Int32 # 1: report.energy, for one more pass. Default 0
    point_stride::Int64 # in elements. Default 0: dim
    component_stride::Int64 # Default 0: 1
    displacement::Ptr{Cvoid} # [L]. Default NULL: where the body is
    velocity::Ptr{Cvoid} # [L T^-1], with fracture. Default NULL: that of the body
    time_step::Float64 # [T], with fracture: how long `velocity` took it there. Default 0
    time::Float64 # of loads. NaN (default): peri_time
    load_factor::Float64 # Default NaN: the body's
    force::Ptr{Cvoid} # out, supports aside. Default NULL
    impulse::Ptr{Cvoid} # out, with time_step: force times [T] of bonds that broke
    peri_evaluate_desc() = new()
end

struct peri_evaluate_report
    broken::Int64 # bonds, by this call
    energy::Float64 # elastic [M L^2 T^-2], of the bonds that are left
end

mutable struct peri_solve_desc
    cookie::UInt64 # set by init
    method::Int32 # Default PERI_METHOD_NEWTON
    preconditioner::Int32 # of Newton. Default PERI_PRECONDITIONER_MULTILEVEL
    loose::Int32 # Default PERI_LOOSE_REFUSED
    fracture::Int32 # 1 (default): bonds break by their criterion; 0: none
    control::Int32 # Default PERI_CONTROL_LOAD
    curve_load::Int32 # load or support whose curve is recorded. Default 0: none
    keep::Int32 # 1: what this solve prepares serves the next, until bonds or supports change. Default 0: that is freed
    reserved::Int32 # 0
    criticality::Float64 # [0, 1]: break those over this part of the largest excess. Default 0.98; 1: one by one
    tolerance::Float64 # [0, 1): |residual| over |loads| or |reactions|. 0 (default): 1e-8, mixed 1e-5, single 1e-4
    energy_tolerance::Float64 # > 0, of Newton: this fall of the residual's energy is enough, too. Default 0: never
    iterations::Int64 # most for one equilibrium, linear. Default 20000
    newton::Int64 # most Newton iterations for one equilibrium. Default 60
    breaks::Int64 # most rounds of breaking at one factor, or of fracture control. Default 100000
    load_from::Float64 # factor to begin at. NaN (default): peri_load_factor
    load_to::Float64 # factor at the end. Default 1
    steps::Int64 # load steps >= 1. Default 1
    duration::Float64 # [T] >= 0 of all steps: what flows, does. Default 0
    halvings::Int64 # most halvings of a failing step, 0..60. Default 8
    curve::Ptr{Float64} # [curve_rows][2 + 2*dim]: load factor, mean displacement [L], peri_get_reaction, broken bonds
    curve_rows::Int64 # rows that fit; more are counted in the report
    on_iteration::Ptr{Cvoid} # Default NULL
    on_step::Ptr{Cvoid} # at each equilibrium, also after it cut. Default NULL
    user::Ptr{Cvoid} # for both
    peri_solve_desc() = new()
end

struct peri_solve_report
    iterations::Int64 # of the linear solver, or relaxation steps, in all
    passes::Int64 # evaluations of all bonds: forces and products with the tangent
    newton::Int64 # Newton iterations in all
    steps::Int64 # load steps done
    broken::Int64 # bonds broken
    curve_rows::Int64 # rows of the curve, written or not
    loose::Int64 # rigid-body modes pinned or balanced in the last equilibrium
    lost_parts::Int64 # broke off, bear nothing and are left where they are
    lost_points::Int64
    bytes::Int64 # most memory of the solver at a time, beside the body
    ended::Int32 # peri_ended; 0 where the solve failed
    reserved::Int32 # 0
    residual::Float64 # of the last equilibrium, over its scale; 0 where nothing acts
    load_factor::Float64 # of the last equilibrium
end

"""
A field in place: component k of point i, in your units, is offset[k] + scale * data[i*point_stride + k*component_stride].
"""
struct peri_view
    data::Ptr{Cvoid} # of the body
    count::Int64 # points
    point_stride::Int64 # in elements
    component_stride::Int64 # in elements
    components::Int32 # 1, dim, 3 or 6 of a tensor, or dim*dim
    type::Int32 # peri_type
    scale::Float64
    offset::NTuple{3,Float64}
end

"""
The ledger [M L^2 T^-2], from build or reset on: initial + external + obstacle = kinetic + elastic + contact + damping + fracture
+ error.
"""
struct peri_energy
    kinetic::Float64
    elastic::Float64 # stored in intact bonds
    contact::Float64 # stored in contact
    external::Float64 # work of loads and supports; in peri_solve of obstacles, too
    obstacle::Float64 # work of obstacles
    damping::Float64 # by damping and contact; in peri_solve what springs free as bonds break
    fracture::Float64 # elastic energy that went with bonds as they broke, less what contact got
    initial::Float64 # put in by setting motion, less what later cuts took out
    error::Float64 # what time steps, or load steps, left open
end

mutable struct peri_cracks_desc
    cookie::UInt64 # set by init
    initial::Int32 # 1 (default): initial cracks, too
    current::Int32 # 1: where the body is now. Default 0: reference positions
    shortest::Float64 # [L] >= 0, 2D: leaves out shorter cracks and branches with a tip. NaN (default): the horizon
    peri_cracks_desc() = new()
end

"""
2D: where a path ends within the body
"""
struct peri_crack_tip
    place::NTuple{3,Float64} # [L]
    direction::NTuple{3,Float64} # of length 1
    speed::Float64 # [L T^-1] NaN: not recorded
    path::Int64 # 0, 1, ...
end

"""
Bytes that the body holds, as asked of its allocator. Solves and builds take more.
"""
struct peri_memory
    points::Int64 # positions, volumes, materials, sizes of families
    families::Int64 # who is bonded to whom, and what each bond weighs
    damage::Int64 # flags of bonds, no-fail zones, events, what the criteria keep
    state::Int64 # displacements, velocities, forces, and scratch of passes
    laws::Int64 # materials, constants, and the body itself
    loads::Int64 # sets, supports, loads, obstacles, contact
    fields::Int64 # derived fields that were viewed; fragments
    total::Int64 # of all these
    shared::Int64 # of the total: what clones share
end

"""
a body that is only described: one material in a box
"""
mutable struct peri_plan_desc
    cookie::UInt64 # set by init
    body::Ptr{peri_body_desc} # Required
    material::Ptr{peri_material_desc} # Required
    source::Int32 # Default PERI_SOURCE_BOX
    measure::Int32 # 1: time a small body, 20..100 ms. Default 0: no clock
    amount::Float64 # [0, 1], of PERI_SOURCE_PERTURBED. Default 1
    lo::NTuple{3,Float64} # [L] corners. Required
    hi::NTuple{3,Float64}
    spacing::Float64 # [L] > 0. Required
    peri_plan_desc() = new()
end

struct peri_plan_report
    points::Int64 # peri_point_count
    entries::Int64 # peri_entry_count: exact of a box, else to 5 %
    width::Int64 # peri_family_width: exact of a box, else an estimate
    columns::Int64 # families by columns: how many; 0: a list
    bytes::Int64 # peri_memory.total after peri_build: exact of a box, else to 5 %
    peak::Int64 # most at a time in peri_build, to 5 % or half a megabyte
    stable_step::Float64 # [T] peri_stable_step, of a box to 6 %
    seconds::Float64 # [s] of one thread per step; 0 where not measured
end

"""
a preset, or an error, at least cost; or a budget; or both
"""
mutable struct peri_choose_desc
    cookie::UInt64 # set by init
    preset::Int32 # Default PERI_PRESET_NONE
    quantity::Int32 # peri_quantity. Required
    error::Float64 # (0, 1) relative error to reach. Default 0: not given
    seconds::Float64 # [s] of one thread per step. Default 0: any. Takes about a second
    bytes::Int64 # most until peri_build has returned. Default 0: any
    feature::Float64 # [L] > 0. Required
    lo::NTuple{3,Float64} # [L] corners of the scene. Required
    hi::NTuple{3,Float64}
    peri_choose_desc() = new()
end

struct peri_choose_report
    spacing::Float64 # [L] for peri_add_box
    across::Float64 # spacings across the feature
    error::Float64 # of the quantity, not above this
    text::Ptr{UInt8} # constant text: the choice in words
    cost::peri_plan_report # as peri_plan says
end

# ---- errors

struct Error <: Exception
    status::Int32
    field::String
    index::Int64
    value::Float64
    text::String
end
Base.showerror(io::IO, e::Error) = print(io, "Peri.Error: ", e.text)

text(p) = p == C_NULL ? "" : unsafe_string(Ptr{UInt8}(p))

blank(status, field) = peri_error(Int32(status), Int32(0), Int64(-1), 0.0, pointer(field), ccall((:peri_status_text, LIB), Ptr{UInt8}, (Int32,), status))

function failed(record::peri_error)
    letters = zeros(UInt8, 300)
    ccall((:peri_format_error, LIB), Int64, (Ref{peri_error}, Ptr{UInt8}, Int64), Ref(record), letters, 300)
    said = GC.@preserve letters unsafe_string(pointer(letters))
    return Error(record.code, text(record.field), record.index, record.value, said)
end

refuse(field::String) = throw(GC.@preserve field failed(blank(-1, field)))

# What a function of yours has thrown, until the call that it came from has ended.
function guarded(f)
    try
        result = f()
        return result === true ? Int32(1) : result isa Integer ? Int32(result) : Int32(0)
    catch thrown
        task_local_storage(:peri_thrown, thrown)
        return Int32(-1)
    end
end

function check(result, record = nothing)
    thrown = get(task_local_storage(), :peri_thrown, nothing)
    if thrown !== nothing
        delete!(task_local_storage(), :peri_thrown)
        throw(thrown)
    end
    if result < 0
        none = ""
        GC.@preserve none throw(failed(record !== nothing && record.code == result ? record : blank(result, none)))
    end
    return result
end

# ---- arrays

array(kind::Type{T}, given::Vector{T}) where {T} = given
array(kind::Type{T}, given) where {T} = collect(T, given)
maybe(kind, given) = given === nothing ? C_NULL : array(kind, given)
entries(given) = given === nothing ? 0 : length(given)
sized(given, needs, field) = given === nothing || length(given) == needs || refuse(field)

# ---- descriptions: fields of C, and functions of yours in the place of callbacks

mutable struct Desc{T}
    raw::T
    calls::Dict{Symbol,Any}
    anchors::Dict{Symbol,Any}
    Desc(raw::T) where {T} = new{T}(raw, Dict{Symbol,Any}(), Dict{Symbol,Any}())
end

callbacks(::Type) = ()

function Base.getproperty(d::Desc{T}, name::Symbol) where {T}
    name in callbacks(T) && return get(getfield(d, :calls), name, nothing)
    return getfield(getfield(d, :raw), name)
end

function Base.setproperty!(d::Desc{T}, name::Symbol, value) where {T}
    raw = getfield(d, :raw)
    if name in callbacks(T)
        getfield(d, :calls)[name] = value
        return value
    end
    kind = fieldtype(T, name)
    if value isa Desc
        getfield(d, :anchors)[name] = value
        setfield!(raw, name, kind(pointer_from_objref(getfield(value, :raw))))
    elseif kind <: Ptr && value isa Array
        getfield(d, :anchors)[name] = value
        setfield!(raw, name, kind(pointer(value)))
    elseif kind <: Tuple
        setfield!(raw, name, convert(kind, Tuple(value)))
    else
        setfield!(raw, name, convert(kind, value))
    end
    return value
end

# What a function of C gets back as its user: closures, the body, its dimension.
mutable struct Context
    calls::Dict{Symbol,Any}
    owner::Any
    dim::Int64
end

version() = ccall((:peri_version, LIB), Int32, ())
status_text(status) = text(ccall((:peri_status_text, LIB), Ptr{UInt8}, (Int32,), status))
id_index(id) = id & 0xFFFFF

"""A field in place, nothing copied: component k of point i, from 0, is at 1 + i*point_stride + k*component_stride."""
function numbers(view)
    kind = view.type == TYPE_F64 ? Float64 : view.type == TYPE_F32 ? Float32 : Int32
    n = view.count == 0 ? 0 : (view.count - 1) * view.point_stride + (view.components - 1) * view.component_stride + 1
    return unsafe_wrap(Array, Ptr{kind}(view.data), n)
end

callbacks(::Type{peri_body_desc}) = (:influence_fn, :log, )
"""peri_body_desc with its defaults."""
function body_desc()
    raw = peri_body_desc()
    ccall((:peri_body_desc_init, LIB), Cvoid, (Ref{peri_body_desc},), raw)
    return Desc(raw)
end

callbacks(::Type{peri_material_desc}) = (:stress, )
"""peri_material_desc with its defaults."""
function material_desc(law)
    raw = peri_material_desc()
    ccall((:peri_material_desc_init, LIB), Cvoid, (Ref{peri_material_desc}, Int32), raw, law)
    return Desc(raw)
end

"""peri_softening_desc with its defaults."""
function softening_desc(shape)
    raw = peri_softening_desc()
    ccall((:peri_softening_desc_init, LIB), Cvoid, (Ref{peri_softening_desc}, Int32), raw, shape)
    return Desc(raw)
end

"""peri_cells_desc with its defaults."""
function cells_desc()
    raw = peri_cells_desc()
    ccall((:peri_cells_desc_init, LIB), Cvoid, (Ref{peri_cells_desc},), raw)
    return Desc(raw)
end

callbacks(::Type{peri_part_desc}) = (:exchange, :reduce, )
"""peri_part_desc with its defaults."""
function part_desc()
    raw = peri_part_desc()
    ccall((:peri_part_desc_init, LIB), Cvoid, (Ref{peri_part_desc},), raw)
    return Desc(raw)
end

callbacks(::Type{peri_obstacle_desc}) = (:distance, :motion, )
"""peri_obstacle_desc with its defaults."""
function obstacle_desc(shape)
    raw = peri_obstacle_desc()
    ccall((:peri_obstacle_desc_init, LIB), Cvoid, (Ref{peri_obstacle_desc}, Int32), raw, shape)
    return Desc(raw)
end

"""peri_contact_desc with its defaults."""
function contact_desc()
    raw = peri_contact_desc()
    ccall((:peri_contact_desc_init, LIB), Cvoid, (Ref{peri_contact_desc},), raw)
    return Desc(raw)
end

callbacks(::Type{peri_advance_desc}) = (:on_frame, )
"""peri_advance_desc with its defaults."""
function advance_desc()
    raw = peri_advance_desc()
    ccall((:peri_advance_desc_init, LIB), Cvoid, (Ref{peri_advance_desc},), raw)
    return Desc(raw)
end

"""peri_evaluate_desc with its defaults."""
function evaluate_desc()
    raw = peri_evaluate_desc()
    ccall((:peri_evaluate_desc_init, LIB), Cvoid, (Ref{peri_evaluate_desc},), raw)
    return Desc(raw)
end

callbacks(::Type{peri_solve_desc}) = (:on_iteration, :on_step, )
"""peri_solve_desc with its defaults."""
function solve_desc()
    raw = peri_solve_desc()
    ccall((:peri_solve_desc_init, LIB), Cvoid, (Ref{peri_solve_desc},), raw)
    return Desc(raw)
end

"""peri_cracks_desc with its defaults."""
function cracks_desc()
    raw = peri_cracks_desc()
    ccall((:peri_cracks_desc_init, LIB), Cvoid, (Ref{peri_cracks_desc},), raw)
    return Desc(raw)
end

"""peri_plan_desc with its defaults."""
function plan_desc()
    raw = peri_plan_desc()
    ccall((:peri_plan_desc_init, LIB), Cvoid, (Ref{peri_plan_desc},), raw)
    return Desc(raw)
end

"""peri_choose_desc with its defaults."""
function choose_desc()
    raw = peri_choose_desc()
    ccall((:peri_choose_desc_init, LIB), Cvoid, (Ref{peri_choose_desc},), raw)
    return Desc(raw)
end

"""Owns a peri_body."""
mutable struct Body
    handle::Ptr{Cvoid}
    keep::Vector{Any}
    function Body(handle::Ptr{Cvoid}, keep)
        return finalizer(destroy, new(handle, keep))
    end
end

"""Frees it at once; else the collector does."""
function destroy(one::Body)
    one.handle == C_NULL || ccall((:peri_body_destroy, LIB), Cvoid, (Ptr{Cvoid},), one.handle)
    one.handle = C_NULL
    return nothing
end

"""Owns a peri_cracks."""
mutable struct Cracks
    handle::Ptr{Cvoid}
    dim::Int64
    function Cracks(handle::Ptr{Cvoid}, dim)
        return finalizer(destroy, new(handle, dim))
    end
end

"""Frees it at once; else the collector does."""
function destroy(one::Cracks)
    one.handle == C_NULL || ccall((:peri_cracks_destroy, LIB), Cvoid, (Ptr{Cvoid},), one.handle)
    one.handle = C_NULL
    return nothing
end

"""Owns a peri_matrix."""
mutable struct Matrix
    handle::Ptr{Cvoid}
    dim::Int64
    function Matrix(handle::Ptr{Cvoid}, dim)
        return finalizer(destroy, new(handle, dim))
    end
end

"""Frees it at once; else the collector does."""
function destroy(one::Matrix)
    one.handle == C_NULL || ccall((:peri_matrix_destroy, LIB), Cvoid, (Ptr{Cvoid},), one.handle)
    one.handle = C_NULL
    return nothing
end

function last_error(body::Body)
    record = Ref{peri_error}()
    GC.@preserve body ccall((:peri_get_error, LIB), Int32, (Ptr{Cvoid}, Ref{peri_error}), body.handle, record)
    return record[]
end

function influence_fn_influence_fn(user::Ptr{Cvoid}, q::Float64, w::Ptr{Float64})
    context = unsafe_pointer_to_objref(user)::Context
    result = guarded(() -> context.calls[:influence_fn](q, unsafe_wrap(Array, w, 1)))
    return result
end
pointer_of_influence_fn_influence_fn() = @cfunction(influence_fn_influence_fn, Int32, (Ptr{Cvoid}, Float64, Ptr{Float64},))

function log_fn_log(user::Ptr{Cvoid}, level::Int32, text::Ptr{UInt8})
    context = unsafe_pointer_to_objref(user)::Context
    result = guarded(() -> context.calls[:log](level, text(text)))
    return nothing
end
pointer_of_log_fn_log() = @cfunction(log_fn_log, Cvoid, (Ptr{Cvoid}, Int32, Ptr{UInt8},))

function stress_fn_stress(user::Ptr{Cvoid}, block::Ptr{peri_stress_block})
    context = unsafe_pointer_to_objref(user)::Context
    result = guarded(() -> context.calls[:stress](block))
    return result
end
pointer_of_stress_fn_stress() = @cfunction(stress_fn_stress, Int32, (Ptr{Cvoid}, Ptr{peri_stress_block},))

function exchange_fn_exchange(user::Ptr{Cvoid}, type_::Int32, planes::Int32, plane::Ptr{Ptr{Cvoid}})
    context = unsafe_pointer_to_objref(user)::Context
    result = guarded(() -> context.calls[:exchange](type_, planes, plane))
    return result
end
pointer_of_exchange_fn_exchange() = @cfunction(exchange_fn_exchange, Int32, (Ptr{Cvoid}, Int32, Int32, Ptr{Ptr{Cvoid}},))

function reduce_fn_reduce(user::Ptr{Cvoid}, reduction::Int32, count::Int64, values::Ptr{Float64})
    context = unsafe_pointer_to_objref(user)::Context
    result = guarded(() -> context.calls[:reduce](reduction, unsafe_wrap(Array, values, count)))
    return result
end
pointer_of_reduce_fn_reduce() = @cfunction(reduce_fn_reduce, Int32, (Ptr{Cvoid}, Int32, Int64, Ptr{Float64},))

function distance_fn_distance(user::Ptr{Cvoid}, x::Ptr{Float64}, distance::Ptr{Float64}, normal::Ptr{Float64})
    context = unsafe_pointer_to_objref(user)::Context
    result = guarded(() -> context.calls[:distance](unsafe_wrap(Array, x, context.dim), unsafe_wrap(Array, distance, 1), unsafe_wrap(Array, normal, context.dim)))
    return result
end
pointer_of_distance_fn_distance() = @cfunction(distance_fn_distance, Int32, (Ptr{Cvoid}, Ptr{Float64}, Ptr{Float64}, Ptr{Float64},))

function motion_fn_motion(user::Ptr{Cvoid}, time::Float64, place::Ptr{Float64}, turn::Ptr{Float64})
    context = unsafe_pointer_to_objref(user)::Context
    result = guarded(() -> context.calls[:motion](time, unsafe_wrap(Array, place, context.dim), unsafe_wrap(Array, turn, 3*context.dim-5)))
    return result
end
pointer_of_motion_fn_motion() = @cfunction(motion_fn_motion, Int32, (Ptr{Cvoid}, Float64, Ptr{Float64}, Ptr{Float64},))

function frame_fn_on_frame(user::Ptr{Cvoid}, body::Ptr{Cvoid})
    context = unsafe_pointer_to_objref(user)::Context
    result = guarded(() -> context.calls[:on_frame](context.owner))
    return result
end
pointer_of_frame_fn_on_frame() = @cfunction(frame_fn_on_frame, Int32, (Ptr{Cvoid}, Ptr{Cvoid},))

function iteration_fn_on_iteration(user::Ptr{Cvoid}, iteration::Int64, residual::Float64)
    context = unsafe_pointer_to_objref(user)::Context
    result = guarded(() -> context.calls[:on_iteration](iteration, residual))
    return result
end
pointer_of_iteration_fn_on_iteration() = @cfunction(iteration_fn_on_iteration, Int32, (Ptr{Cvoid}, Int64, Float64,))

function frame_fn_on_step(user::Ptr{Cvoid}, body::Ptr{Cvoid})
    context = unsafe_pointer_to_objref(user)::Context
    result = guarded(() -> context.calls[:on_step](context.owner))
    return result
end
pointer_of_frame_fn_on_step() = @cfunction(frame_fn_on_step, Int32, (Ptr{Cvoid}, Ptr{Cvoid},))

function bond_law_fn_call(user::Ptr{Cvoid}, row::Ptr{peri_bond_row})
    context = unsafe_pointer_to_objref(user)::Context
    result = guarded(() -> context.calls[:call](row))
    return result
end
pointer_of_bond_law_fn_call() = @cfunction(bond_law_fn_call, Int32, (Ptr{Cvoid}, Ptr{peri_bond_row},))

function point_fn_call(user::Ptr{Cvoid}, index::Int64, x::Ptr{Float64})
    context = unsafe_pointer_to_objref(user)::Context
    result = guarded(() -> context.calls[:call](index, unsafe_wrap(Array, x, context.dim)))
    return result
end
pointer_of_point_fn_call() = @cfunction(point_fn_call, Int32, (Ptr{Cvoid}, Int64, Ptr{Float64},))

function pair_fn_call(user::Ptr{Cvoid}, i::Int32, j::Int32, xi::Ptr{Float64}, xj::Ptr{Float64})
    context = unsafe_pointer_to_objref(user)::Context
    result = guarded(() -> context.calls[:call](i, j, unsafe_wrap(Array, xi, context.dim), unsafe_wrap(Array, xj, context.dim)))
    return result
end
pointer_of_pair_fn_call() = @cfunction(pair_fn_call, Int32, (Ptr{Cvoid}, Int32, Int32, Ptr{Float64}, Ptr{Float64},))

function break_fn_call(user::Ptr{Cvoid}, i::Int32, j::Int32, time::Float64, stretch::Float64)
    context = unsafe_pointer_to_objref(user)::Context
    result = guarded(() -> context.calls[:call](i, j, time, stretch))
    return result
end
pointer_of_break_fn_call() = @cfunction(break_fn_call, Int32, (Ptr{Cvoid}, Int32, Int32, Float64, Float64,))

function load_fn_call(user::Ptr{Cvoid}, time::Float64, count::Int64, points::Ptr{Int32}, value::Ptr{Float64})
    context = unsafe_pointer_to_objref(user)::Context
    result = guarded(() -> context.calls[:call](time, unsafe_wrap(Array, points, count), unsafe_wrap(Array, value, count*context.dim)))
    return result
end
pointer_of_load_fn_call() = @cfunction(load_fn_call, Int32, (Ptr{Cvoid}, Float64, Int64, Ptr{Int32}, Ptr{Float64},))

function rigid_fn_call(user::Ptr{Cvoid}, time::Float64, motion::Ptr{Float64})
    context = unsafe_pointer_to_objref(user)::Context
    result = guarded(() -> context.calls[:call](time, unsafe_wrap(Array, motion, context.dim+(2 * context.dim - 3))))
    return result
end
pointer_of_rigid_fn_call() = @cfunction(rigid_fn_call, Int32, (Ptr{Cvoid}, Float64, Ptr{Float64},))

function write_fn_call(user::Ptr{Cvoid}, bytes::Ptr{Cvoid}, count::Int64)
    context = unsafe_pointer_to_objref(user)::Context
    result = guarded(() -> context.calls[:call](unsafe_wrap(Array, Ptr{UInt8}(bytes), count)))
    return result
end
pointer_of_write_fn_call() = @cfunction(write_fn_call, Int32, (Ptr{Cvoid}, Ptr{Cvoid}, Int64,))

function read_fn_call(user::Ptr{Cvoid}, bytes::Ptr{Cvoid}, count::Int64)
    context = unsafe_pointer_to_objref(user)::Context
    result = guarded(() -> context.calls[:call](unsafe_wrap(Array, Ptr{UInt8}(bytes), count)))
    return result
end
pointer_of_read_fn_call() = @cfunction(read_fn_call, Int32, (Ptr{Cvoid}, Ptr{Cvoid}, Int64,))

"""
*body is NULL on failure. error may be NULL.
"""
function body_create(desc::Desc{peri_body_desc})
    keep = Any[]
    context_desc_influence_user = Context(copy(getfield(desc, :calls)), nothing, desc.space == SPACE_SOLID ? 3 : 2)
    setfield!(getfield(desc, :raw), :influence_user, pointer_from_objref(context_desc_influence_user))
    setfield!(getfield(desc, :raw), :influence_fn, desc.influence_fn === nothing ? C_NULL : pointer_of_influence_fn_influence_fn())
    push!(keep, context_desc_influence_user)
    context_desc_log_user = Context(copy(getfield(desc, :calls)), nothing, desc.space == SPACE_SOLID ? 3 : 2)
    setfield!(getfield(desc, :raw), :log_user, pointer_from_objref(context_desc_log_user))
    setfield!(getfield(desc, :raw), :log, desc.log === nothing ? C_NULL : pointer_of_log_fn_log())
    push!(keep, context_desc_log_user)
    made = Ref{Ptr{Cvoid}}(C_NULL)
    record = Ref{peri_error}(blank(0, ""))
    result = GC.@preserve desc context_desc_influence_user context_desc_log_user ccall((:peri_body_create, LIB), Int32, (Ptr{peri_body_desc}, Ptr{Ptr{Cvoid}}, Ref{peri_error}), Ptr{peri_body_desc}(pointer_from_objref(getfield(desc, :raw))), made, record)
    check(result, record[])
    return Body(made[], keep)
end

"""
An independent copy of a built body, state, loads and number included: ids hold in both. Points, families and weights are shared.
error may be NULL.
"""
function clone(body::Body)
    made = Ref{Ptr{Cvoid}}(C_NULL)
    record = Ref{peri_error}(blank(0, ""))
    result = GC.@preserve body ccall((:peri_body_clone, LIB), Int32, (Ptr{Cvoid}, Ptr{Ptr{Cvoid}}, Ref{peri_error}), body.handle, made, record)
    check(result, record[])
    return Body(made[], body.keep)
end

"""
After a callback was left by longjmp or an exception: ends the call that it came from, and frees its memory. The body may then be
read, reset or destroyed; it runs again after peri_reset. Never from within a callback. PERI_ERROR_ORDER where none was left.
Memory hooks, job systems and what a measuring peri_plan calls may not be left so.
"""
function unlock(body::Body)
    result = GC.@preserve body ccall((:peri_unlock, LIB), Int32, (Ptr{Cvoid},), body.handle)
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
The id of the index-th (1, 2, ...) thing of a peri_kind, removed ones counted; or an error.
"""
function id(body::Body, kind, index)
    result = GC.@preserve body ccall((:peri_id, LIB), Int32, (Ptr{Cvoid}, Int32, Int64), body.handle, kind, index)
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
Adds a material, before peri_build; at most 120. Returns its id, or an error.
"""
function add_material(body::Body, desc::Desc{peri_material_desc})
    context_desc_stress_user = Context(copy(getfield(desc, :calls)), nothing, dimension(body))
    setfield!(getfield(desc, :raw), :stress_user, pointer_from_objref(context_desc_stress_user))
    setfield!(getfield(desc, :raw), :stress, desc.stress === nothing ? C_NULL : pointer_of_stress_fn_stress())
    push!(body.keep, context_desc_stress_user)
    result = GC.@preserve body desc context_desc_stress_user ccall((:peri_add_material, LIB), Int32, (Ptr{Cvoid}, Ptr{peri_material_desc}), body.handle, Ptr{peri_material_desc}(pointer_from_objref(getfield(desc, :raw))))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
Bonds between i and j break, and of bond-based i and j act, as if of `desc`, before peri_build; its law is that of one of them,
not bond-based unless both are. Default: harmonic mean of the micromoduli, the criteria of both.
"""
function set_interface(body::Body, i, j, desc::Desc{peri_material_desc})
    context_desc_stress_user = Context(copy(getfield(desc, :calls)), nothing, dimension(body))
    setfield!(getfield(desc, :raw), :stress_user, pointer_from_objref(context_desc_stress_user))
    setfield!(getfield(desc, :raw), :stress, desc.stress === nothing ? C_NULL : pointer_of_stress_fn_stress())
    push!(body.keep, context_desc_stress_user)
    result = GC.@preserve body desc context_desc_stress_user ccall((:peri_set_interface, LIB), Int32, (Ptr{Cvoid}, Int32, Int32, Ptr{peri_material_desc}), body.handle, i, j, Ptr{peri_material_desc}(pointer_from_objref(getfield(desc, :raw))))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
Bonds between bond-based materials i and j (i, i: within one) soften, before peri_build; their fracture_energy and
critical_stretch do not count. PERI_BRITTLE: the horizon is too large, bonds break at once at less than the strength and take the
energy. docs/laws.md
"""
function set_softening(body::Body, i, j, desc::Desc{peri_softening_desc})
    result = GC.@preserve body desc ccall((:peri_set_softening, LIB), Int32, (Ptr{Cvoid}, Int32, Int32, Ptr{peri_softening_desc}), body.handle, i, j, Ptr{peri_softening_desc}(pointer_from_objref(getfield(desc, :raw))))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
The stretch at which bonds begin to soften, and that at which they break; after peri_build. PERI_BRITTLE: they are one. Either may
be NULL.
"""
function get_softening!(body::Body, i, j, first = nothing, last = nothing)
    sized(first, 1, "first")
    sized(last, 1, "last")
    result = GC.@preserve body ccall((:peri_get_softening, LIB), Int32, (Ptr{Cvoid}, Int32, Int32, Ptr{Float64}, Ptr{Float64}), body.handle, i, j, first === nothing ? C_NULL : first, last === nothing ? C_NULL : last)
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
Bonds between bond-based materials i and j follow fn, each with `states` (0..8) numbers of its own, 0 at first; before peri_build.
Their critical stretch holds, too. docs/laws.md
"""
function set_bond_law(body::Body, i, j, states, fn = nothing)
    context = fn === nothing ? nothing : Context(Dict{Symbol,Any}(:call => fn), nothing, dimension(body))
    context === nothing || push!(body.keep, context)
    result = GC.@preserve body context ccall((:peri_set_bond_law, LIB), Int32, (Ptr{Cvoid}, Int32, Int32, Int32, Ptr{Cvoid}, Ptr{Cvoid}), body.handle, i, j, states, context === nothing ? C_NULL : pointer_of_bond_law_fn_call(), context === nothing ? C_NULL : pointer_from_objref(context))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
Micromodulus c [M L^-5 T^-2] (bond-based only, else NULL) and critical stretch s0 [-] (HUGE_VAL: never; softening: where they
break, after peri_build) of bonds between materials i and j. Either may be NULL. ([P] C.15-C.20, [T] 1.24, 1.40)
"""
function get_bond_constants!(body::Body, i, j, c = nothing, s0 = nothing)
    sized(c, 1, "c")
    sized(s0, 1, "s0")
    result = GC.@preserve body ccall((:peri_get_bond_constants, LIB), Int32, (Ptr{Cvoid}, Int32, Int32, Ptr{Float64}, Ptr{Float64}), body.handle, i, j, c === nothing ? C_NULL : c, s0 === nothing ? C_NULL : s0)
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
Critical bond energy w0 [M L^-4 T^-2] of a material whose criterion is an energy; HUGE_VAL: none. PERI_CRITERION_NODE_ENERGY:
after peri_build.
"""
function get_critical_energy!(body::Body, material, w0)
    sized(w0, 1, "w0")
    result = GC.@preserve body ccall((:peri_get_critical_energy, LIB), Int32, (Ptr{Cvoid}, Int32, Ptr{Float64}), body.handle, material, w0)
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

function get_critical_energy(body::Body, material)
    w0 = Vector{Float64}(undef, 1)
    get_critical_energy!(body, material, w0)
    return w0[1]
end

"""
The box lo[dim]..hi[dim] in cells of about `spacing` [L], which tile it.
"""
function add_box(body::Body, material, lo, hi, spacing)
    sized(lo, dimension(body), "lo")
    sized(hi, dimension(body), "hi")
    result = GC.@preserve body ccall((:peri_add_box, LIB), Int64, (Ptr{Cvoid}, Int32, Ptr{Float64}, Ptr{Float64}, Float64), body.handle, material, maybe(Float64, lo), maybe(Float64, hi), spacing)
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
The box in cells[dim] cells per axis.
"""
function add_grid(body::Body, material, lo, hi, cells)
    sized(lo, dimension(body), "lo")
    sized(hi, dimension(body), "hi")
    sized(cells, dimension(body), "cells")
    result = GC.@preserve body ccall((:peri_add_grid, LIB), Int64, (Ptr{Cvoid}, Int32, Ptr{Float64}, Ptr{Float64}, Ptr{Int32}), body.handle, material, maybe(Float64, lo), maybe(Float64, hi), maybe(Int32, cells))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
The lattice cells whose centre is within `radius` of `centre`: a ball, in 2D a disc.
"""
function add_ball(body::Body, material, centre, radius, spacing)
    sized(centre, dimension(body), "centre")
    result = GC.@preserve body ccall((:peri_add_ball, LIB), Int64, (Ptr{Cvoid}, Int32, Ptr{Float64}, Float64, Float64), body.handle, material, maybe(Float64, centre), radius, spacing)
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
The lattice cells of the box whose centre `inside` takes.
"""
function add_shape(body::Body, material, lo, hi, spacing, inside)
    sized(lo, dimension(body), "lo")
    sized(hi, dimension(body), "hi")
    context = inside === nothing ? nothing : Context(Dict{Symbol,Any}(:call => inside), nothing, dimension(body))
    result = GC.@preserve body context ccall((:peri_add_shape, LIB), Int64, (Ptr{Cvoid}, Int32, Ptr{Float64}, Ptr{Float64}, Float64, Ptr{Cvoid}, Ptr{Cvoid}), body.handle, material, maybe(Float64, lo), maybe(Float64, hi), spacing, context === nothing ? C_NULL : pointer_of_point_fn_call(), context === nothing ? C_NULL : pointer_from_objref(context))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
peri_add_box, interior vertices moved by up to `amount` (0..1) quarters of a cell ([P] B).
"""
function add_perturbed_box(body::Body, material, lo, hi, spacing, amount, seed)
    sized(lo, dimension(body), "lo")
    sized(hi, dimension(body), "hi")
    result = GC.@preserve body ccall((:peri_add_perturbed_box, LIB), Int64, (Ptr{Cvoid}, Int32, Ptr{Float64}, Ptr{Float64}, Float64, Float64, UInt64), body.handle, material, maybe(Float64, lo), maybe(Float64, hi), spacing, amount, seed)
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
Points of yours: positions[count*dim] [L], volumes[count] [L^3] (planes: areas [L^2]), materials[count] (ids), or NULL where the
body has one material.
"""
function add_points(body::Body, positions, volumes, materials = nothing)
    sized(positions, entries(volumes)*dimension(body), "positions")
    sized(materials, entries(volumes), "materials")
    result = GC.@preserve body ccall((:peri_add_points, LIB), Int64, (Ptr{Cvoid}, Int64, Ptr{Float64}, Ptr{Float64}, Ptr{Int32}), body.handle, entries(volumes), maybe(Float64, positions), maybe(Float64, volumes), maybe(Int32, materials))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
Each is a point at its centroid, with its volume; partial volumes are exact.
"""
function add_cells(body::Body, desc::Desc{peri_cells_desc})
    result = GC.@preserve body desc ccall((:peri_add_cells, LIB), Int64, (Ptr{Cvoid}, Ptr{peri_cells_desc}), body.handle, Ptr{peri_cells_desc}(pointer_from_objref(getfield(desc, :raw))))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
Families of yours instead of a search: ibond[points*width] as in [T] 3.11, row i padded with i. Membership must be mutual. Weights
are computed as for found families, of whose horizon they must be.
"""
function set_families(body::Body, width, ibond)
    sized(ibond, point_count(body)*width, "ibond")
    result = GC.@preserve body ccall((:peri_set_families, LIB), Int32, (Ptr{Cvoid}, Int32, Ptr{Int32}), body.handle, width, maybe(Int32, ibond))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
After the points, before peri_build. All parts make the same calls.
"""
function set_part(body::Body, desc::Desc{peri_part_desc})
    context_desc_user = Context(copy(getfield(desc, :calls)), nothing, dimension(body))
    setfield!(getfield(desc, :raw), :user, pointer_from_objref(context_desc_user))
    setfield!(getfield(desc, :raw), :exchange, desc.exchange === nothing ? C_NULL : pointer_of_exchange_fn_exchange())
    setfield!(getfield(desc, :raw), :reduce, desc.reduce === nothing ? C_NULL : pointer_of_reduce_fn_reduce())
    push!(body.keep, context_desc_user)
    result = GC.@preserve body desc context_desc_user ccall((:peri_set_part, LIB), Int32, (Ptr{Cvoid}, Ptr{peri_part_desc}), body.handle, Ptr{peri_part_desc}(pointer_from_objref(getfield(desc, :raw))))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
1 or 2, before peri_build; the deepest that its materials need.
"""
function ghost_depth(body::Body)
    result = GC.@preserve body ccall((:peri_ghost_depth, LIB), Int32, (Ptr{Cvoid},), body.handle)
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
H[dim*dim] [-] by rows: images have their owner's displacement + H (distance). Default 0
"""
function set_mean_gradient(body::Body, gradient)
    sized(gradient, dimension(body), "gradient")
    result = GC.@preserve body ccall((:peri_set_mean_gradient, LIB), Int32, (Ptr{Cvoid}, Ptr{Float64}), body.handle, maybe(Float64, gradient))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
Of the cells of peri_add_box those from first[dim] to before last[dim].
"""
function add_box_part(body::Body, material, lo, hi, spacing, first, last)
    sized(lo, dimension(body), "lo")
    sized(hi, dimension(body), "hi")
    sized(first, dimension(body), "first")
    sized(last, dimension(body), "last")
    result = GC.@preserve body ccall((:peri_add_box_part, LIB), Int64, (Ptr{Cvoid}, Int32, Ptr{Float64}, Ptr{Float64}, Float64, Ptr{Int32}, Ptr{Int32}), body.handle, material, maybe(Float64, lo), maybe(Float64, hi), spacing, maybe(Int32, first), maybe(Int32, last))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
Finds the families, computes weights and constants, takes the state. Warns of rows of points, and of sheets of them in 3D: no
constants are for these. After a failure the body is as it was: add what is missing and build again.
"""
function build(body::Body)
    result = GC.@preserve body ccall((:peri_build, LIB), Int32, (Ptr{Cvoid},), body.handle)
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
2 or 3
"""
function dimension(body::Body)
    result = GC.@preserve body ccall((:peri_dimension, LIB), Int32, (Ptr{Cvoid},), body.handle)
    return result
end

function point_count(body::Body)
    result = GC.@preserve body ccall((:peri_point_count, LIB), Int64, (Ptr{Cvoid},), body.handle)
    return result
end

"""
size of the largest family
"""
function family_width(body::Body)
    result = GC.@preserve body ccall((:peri_family_width, LIB), Int32, (Ptr{Cvoid},), body.handle)
    return result
end

"""
broken and cut ones included
"""
function bond_count(body::Body)
    result = GC.@preserve body ccall((:peri_bond_count, LIB), Int64, (Ptr{Cvoid},), body.handle)
    return result
end

"""
of all families: twice the bonds
"""
function entry_count(body::Body)
    result = GC.@preserve body ccall((:peri_entry_count, LIB), Int64, (Ptr{Cvoid},), body.handle)
    return result
end

"""
bonds of the initial cracks
"""
function cut_count(body::Body)
    result = GC.@preserve body ccall((:peri_cut_count, LIB), Int64, (Ptr{Cvoid},), body.handle)
    return result
end

"""
bonds broken, or cut later
"""
function broken_count(body::Body)
    result = GC.@preserve body ccall((:peri_broken_count, LIB), Int64, (Ptr{Cvoid},), body.handle)
    return result
end

"""
steps, load steps too, since reset
"""
function step_count(body::Body)
    result = GC.@preserve body ccall((:peri_step_count, LIB), Int64, (Ptr{Cvoid},), body.handle)
    return result
end

"""
[T] since build or reset
"""
function time(body::Body)
    result = GC.@preserve body ccall((:peri_time, LIB), Float64, (Ptr{Cvoid},), body.handle)
    return result
end

"""
that loads act with; 0 before any did
"""
function load_factor(body::Body)
    result = GC.@preserve body ccall((:peri_load_factor, LIB), Float64, (Ptr{Cvoid},), body.handle)
    return result
end

"""
How bonds are worked on: 'columns, AVX-512', 'list, SSE2', 'rows', 'reference'.
"""
function kernel_text(body::Body)
    result = GC.@preserve body ccall((:peri_kernel_text, LIB), Ptr{UInt8}, (Ptr{Cvoid},), body.handle)
    return text(result)
end

"""
Largest stable time step [T], to 4 % at rest; of state-based bodies that can break, a bound. Takes 20 to 100 steps once:
docs/accuracy.md. 0 before peri_build.
"""
function stable_step(body::Body)
    result = GC.@preserve body ccall((:peri_stable_step, LIB), Float64, (Ptr{Cvoid},), body.handle)
    return result
end

"""
Rows [first, first+count) of the families ([T] 3.11) to rows[count*width]: ascending, padded with the row's own number; broken
bonds are listed. capacity counts entries.
"""
function get_families!(body::Body, first, count, rows)
    result = GC.@preserve body ccall((:peri_get_families, LIB), Int32, (Ptr{Cvoid}, Int64, Int64, Ptr{Int32}, Int64), body.handle, first, count, rows, entries(rows))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

function get_families(body::Body, first, count)
    rows = Vector{Int32}(undef, count*family_width(body))
    get_families!(body, first, count, rows)
    return rows
end

"""
The point nearest to x[dim] [L]; _in_place: where it is now.
"""
function find_point(body::Body, x)
    sized(x, dimension(body), "x")
    result = GC.@preserve body ccall((:peri_find_point, LIB), Int32, (Ptr{Cvoid}, Ptr{Float64}), body.handle, maybe(Float64, x))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
The point nearest to x[dim] [L]; _in_place: where it is now.
"""
function find_point_in_place(body::Body, x)
    sized(x, dimension(body), "x")
    result = GC.@preserve body ccall((:peri_find_point_in_place, LIB), Int32, (Ptr{Cvoid}, Ptr{Float64}), body.handle, maybe(Float64, x))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
1: bond (i,j) carries force; 0: broken or cut; PERI_ERROR_PAIR: no such bond.
"""
function bond_is_intact(body::Body, i, j)
    result = GC.@preserve body ccall((:peri_bond_is_intact, LIB), Int32, (Ptr{Cvoid}, Int32, Int32), body.handle, i, j)
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
Motion, time, steps, load factor and ledger become zero, broken bonds whole. Initial cracks, sets, loads, obstacles and no-fail
zones stay.
"""
function reset(body::Body)
    result = GC.@preserve body ccall((:peri_reset, LIB), Int32, (Ptr{Cvoid},), body.handle)
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
name (copied) may be NULL. Reference positions; box and ball include their boundary to 1e-9 spacings.
"""
function select_box(body::Body, name, lo, hi)
    sized(lo, dimension(body), "lo")
    sized(hi, dimension(body), "hi")
    result = GC.@preserve body ccall((:peri_select_box, LIB), Int32, (Ptr{Cvoid}, Cstring, Ptr{Float64}, Ptr{Float64}), body.handle, name === nothing ? Cstring(C_NULL) : name, maybe(Float64, lo), maybe(Float64, hi))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
name (copied) may be NULL. Reference positions; box and ball include their boundary to 1e-9 spacings.
"""
function select_ball(body::Body, name, centre, radius)
    sized(centre, dimension(body), "centre")
    result = GC.@preserve body ccall((:peri_select_ball, LIB), Int32, (Ptr{Cvoid}, Cstring, Ptr{Float64}, Float64), body.handle, name === nothing ? Cstring(C_NULL) : name, maybe(Float64, centre), radius)
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
By present positions.
"""
function select_box_in_place(body::Body, name, lo, hi)
    sized(lo, dimension(body), "lo")
    sized(hi, dimension(body), "hi")
    result = GC.@preserve body ccall((:peri_select_box_in_place, LIB), Int32, (Ptr{Cvoid}, Cstring, Ptr{Float64}, Ptr{Float64}), body.handle, name === nothing ? Cstring(C_NULL) : name, maybe(Float64, lo), maybe(Float64, hi))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
By present positions.
"""
function select_ball_in_place(body::Body, name, centre, radius)
    sized(centre, dimension(body), "centre")
    result = GC.@preserve body ccall((:peri_select_ball_in_place, LIB), Int32, (Ptr{Cvoid}, Cstring, Ptr{Float64}, Float64), body.handle, name === nothing ? Cstring(C_NULL) : name, maybe(Float64, centre), radius)
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

function select_if(body::Body, name, take)
    context = take === nothing ? nothing : Context(Dict{Symbol,Any}(:call => take), nothing, dimension(body))
    result = GC.@preserve body context ccall((:peri_select_if, LIB), Int32, (Ptr{Cvoid}, Cstring, Ptr{Cvoid}, Ptr{Cvoid}), body.handle, name === nothing ? Cstring(C_NULL) : name, context === nothing ? C_NULL : pointer_of_point_fn_call(), context === nothing ? C_NULL : pointer_from_objref(context))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

function select_points(body::Body, name, points)
    result = GC.@preserve body ccall((:peri_select_points, LIB), Int32, (Ptr{Cvoid}, Cstring, Int64, Ptr{Int32}), body.handle, name === nothing ? Cstring(C_NULL) : name, entries(points), maybe(Int32, points))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
id, or PERI_ERROR_NAME
"""
function find_set(body::Body, name)
    result = GC.@preserve body ccall((:peri_find_set, LIB), Int32, (Ptr{Cvoid}, Cstring), body.handle, name)
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
id, or PERI_ERROR_NAME
"""
function size_of_set(body::Body, set)
    result = GC.@preserve body ccall((:peri_size_of_set, LIB), Int64, (Ptr{Cvoid}, Int32), body.handle, set)
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
id, or PERI_ERROR_NAME
"""
function get_set!(body::Body, set, points)
    result = GC.@preserve body ccall((:peri_get_set, LIB), Int32, (Ptr{Cvoid}, Int32, Ptr{Int32}, Int64), body.handle, set, points, entries(points))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

function get_set(body::Body, set)
    points = Vector{Int32}(undef, size_of_set(body, set))
    get_set!(body, set, points)
    return points
end

"""
Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a spacing. Returns the number
of bonds newly cut. 2D
"""
function cut_segment(body::Body, standing, from, to)
    sized(from, dimension(body), "from")
    sized(to, dimension(body), "to")
    result = GC.@preserve body ccall((:peri_cut_segment, LIB), Int64, (Ptr{Cvoid}, Int32, Ptr{Float64}, Ptr{Float64}), body.handle, standing, maybe(Float64, from), maybe(Float64, to))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a spacing. Returns the number
of bonds newly cut. 2D, [count*2]
"""
function cut_polyline(body::Body, standing, vertices)
    entries(vertices) % 2 == 0 || refuse("vertices")
    result = GC.@preserve body ccall((:peri_cut_polyline, LIB), Int64, (Ptr{Cvoid}, Int32, Int64, Ptr{Float64}), body.handle, standing, entries(vertices) ÷ 2, maybe(Float64, vertices))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a spacing. Returns the number
of bonds newly cut. 3D
"""
function cut_disc(body::Body, standing, centre, normal, radius)
    sized(centre, dimension(body), "centre")
    sized(normal, dimension(body), "normal")
    result = GC.@preserve body ccall((:peri_cut_disc, LIB), Int64, (Ptr{Cvoid}, Int32, Ptr{Float64}, Ptr{Float64}, Float64), body.handle, standing, maybe(Float64, centre), maybe(Float64, normal), radius)
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a spacing. Returns the number
of bonds newly cut. 3D
"""
function cut_triangle(body::Body, standing, p, q, r)
    sized(p, dimension(body), "p")
    sized(q, dimension(body), "q")
    sized(r, dimension(body), "r")
    result = GC.@preserve body ccall((:peri_cut_triangle, LIB), Int64, (Ptr{Cvoid}, Int32, Ptr{Float64}, Ptr{Float64}, Ptr{Float64}), body.handle, standing, maybe(Float64, p), maybe(Float64, q), maybe(Float64, r))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a spacing. Returns the number
of bonds newly cut. 3D, or parallelogram
"""
function cut_rectangle(body::Body, standing, corner, edge1, edge2)
    sized(corner, dimension(body), "corner")
    sized(edge1, dimension(body), "edge1")
    sized(edge2, dimension(body), "edge2")
    result = GC.@preserve body ccall((:peri_cut_rectangle, LIB), Int64, (Ptr{Cvoid}, Int32, Ptr{Float64}, Ptr{Float64}, Ptr{Float64}), body.handle, standing, maybe(Float64, corner), maybe(Float64, edge1), maybe(Float64, edge2))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a spacing. Returns the number
of bonds newly cut. [count*2] points; each pair must be a bond
"""
function cut_pairs(body::Body, standing, pairs)
    entries(pairs) % 2 == 0 || refuse("pairs")
    result = GC.@preserve body ccall((:peri_cut_pairs, LIB), Int64, (Ptr{Cvoid}, Int32, Int64, Ptr{Int32}), body.handle, standing, entries(pairs) ÷ 2, maybe(Int32, pairs))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a spacing. Returns the number
of bonds newly cut.
"""
function cut_if(body::Body, standing, cut)
    context = cut === nothing ? nothing : Context(Dict{Symbol,Any}(:call => cut), nothing, dimension(body))
    result = GC.@preserve body context ccall((:peri_cut_if, LIB), Int64, (Ptr{Cvoid}, Int32, Ptr{Cvoid}, Ptr{Cvoid}), body.handle, standing, context === nothing ? C_NULL : pointer_of_pair_fn_call(), context === nothing ? C_NULL : pointer_from_objref(context))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
Bonds with an end in the set never break by a criterion (on = 1), or may again (0). Cuts still cut.
"""
function set_no_fail(body::Body, set, on)
    result = GC.@preserve body ccall((:peri_set_no_fail, LIB), Int32, (Ptr{Cvoid}, Int32, Int32), body.handle, set, on)
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
fn is called for every bond that breaks by its criterion; NULL removes. Costs two to three bits per bond.
"""
function on_break(body::Body, fn = nothing)
    context = fn === nothing ? nothing : Context(Dict{Symbol,Any}(:call => fn), nothing, dimension(body))
    context === nothing || push!(body.keep, context)
    result = GC.@preserve body context ccall((:peri_on_break, LIB), Int32, (Ptr{Cvoid}, Ptr{Cvoid}, Ptr{Cvoid}), body.handle, context === nothing ? C_NULL : pointer_of_break_fn_call(), context === nothing ? C_NULL : pointer_from_objref(context))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
Strength of bonds, times that of points: factors[count] of pairs[count*2], or of intact bonds that `take` takes. Returns how many.
"""
function set_strength_pairs(body::Body, pairs, factors)
    sized(pairs, entries(factors)*2, "pairs")
    result = GC.@preserve body ccall((:peri_set_strength_pairs, LIB), Int64, (Ptr{Cvoid}, Int64, Ptr{Int32}, Ptr{Float64}), body.handle, entries(factors), maybe(Int32, pairs), maybe(Float64, factors))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
Strength of bonds, times that of points: factors[count] of pairs[count*2], or of intact bonds that `take` takes. Returns how many.
"""
function set_strength_if(body::Body, factor, take)
    context = take === nothing ? nothing : Context(Dict{Symbol,Any}(:call => take), nothing, dimension(body))
    result = GC.@preserve body context ccall((:peri_set_strength_if, LIB), Int64, (Ptr{Cvoid}, Float64, Ptr{Cvoid}, Ptr{Cvoid}), body.handle, factor, context === nothing ? C_NULL : pointer_of_pair_fn_call(), context === nothing ? C_NULL : pointer_from_objref(context))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
on = 1: keeps when bonds between adjacent points break, for peri_get_cracks: 32 to 44 bytes per point.
"""
function record_breaks(body::Body, on)
    result = GC.@preserve body ccall((:peri_record_breaks, LIB), Int32, (Ptr{Cvoid}, Int32), body.handle, on)
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
How many there are, and which each point is in: of_point[points], or NULL. They are numbered 0, 1, ... by their least points when
first asked for. Of one that has split since, the piece of most points keeps the number; the others get the next ones. Free where
no bond broke.
"""
function find_fragments!(body::Body, of_point = nothing)
    result = GC.@preserve body ccall((:peri_find_fragments, LIB), Int64, (Ptr{Cvoid}, Ptr{Int32}, Int64), body.handle, of_point === nothing ? C_NULL : of_point, entries(of_point))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
out[k] is fragment k.
"""
function get_fragments!(body::Body, out)
    result = GC.@preserve body ccall((:peri_get_fragments, LIB), Int32, (Ptr{Cvoid}, Ptr{peri_fragment}, Int64), body.handle, out, entries(out))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

function get_fragments(body::Body)
    out = Vector{peri_fragment}(undef, find_fragments!(body))
    get_fragments!(body, out)
    return out
end

"""
The closed surface of a fragment, or of all (-1), now, by cells. vertices[][dim] [L]; faces[][dim] of vertices: in 2D edges with
the fragment on the left, loop by loop, edge k from vertex k on; in 3D triangles, counter-clockwise from outside. owners[], or
NULL: its point; inner[], or NULL: 1 where a crack made it. Points and cells of yours are squares or cubes.
"""
function size_of_outline!(body::Body, fragment, vertices, faces)
    sized(vertices, 1, "vertices")
    sized(faces, 1, "faces")
    result = GC.@preserve body ccall((:peri_size_of_outline, LIB), Int32, (Ptr{Cvoid}, Int32, Ptr{Int64}, Ptr{Int64}), body.handle, fragment, vertices, faces)
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

function size_of_outline(body::Body, fragment)
    vertices = Vector{Int64}(undef, 1)
    faces = Vector{Int64}(undef, 1)
    size_of_outline!(body, fragment, vertices, faces)
    return vertices[1], faces[1]
end

"""
The closed surface of a fragment, or of all (-1), now, by cells. vertices[][dim] [L]; faces[][dim] of vertices: in 2D edges with
the fragment on the left, loop by loop, edge k from vertex k on; in 3D triangles, counter-clockwise from outside. owners[], or
NULL: its point; inner[], or NULL: 1 where a crack made it. Points and cells of yours are squares or cubes.
"""
function get_outline!(body::Body, fragment, vertices, faces, owners = nothing, inner = nothing)
    entries(vertices) % dimension(body) == 0 || refuse("vertices")
    entries(faces) % dimension(body) == 0 || refuse("faces")
    sized(owners, entries(faces) ÷ dimension(body), "owners")
    sized(inner, entries(faces) ÷ dimension(body), "inner")
    result = GC.@preserve body ccall((:peri_get_outline, LIB), Int32, (Ptr{Cvoid}, Int32, Ptr{Float64}, Int64, Ptr{Int32}, Ptr{Int32}, Ptr{Int32}, Int64), body.handle, fragment, vertices, entries(vertices) ÷ dimension(body), faces, owners === nothing ? C_NULL : owners, inner === nothing ? C_NULL : inner, entries(faces) ÷ dimension(body))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
Add value[dim] to the displacement [L] or velocity [L T^-1] of a set, now; peri_reset clears both. Sums are below 1e15 spacings,
1e9 speeds of sound.
"""
function add_displacement(body::Body, set, value)
    sized(value, dimension(body), "value")
    result = GC.@preserve body ccall((:peri_add_displacement, LIB), Int32, (Ptr{Cvoid}, Int32, Ptr{Float64}), body.handle, set, maybe(Float64, value))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
Add value[dim] to the displacement [L] or velocity [L T^-1] of a set, now; peri_reset clears both. Sums are below 1e15 spacings,
1e9 speeds of sound.
"""
function add_velocity(body::Body, set, value)
    sized(value, dimension(body), "value")
    result = GC.@preserve body ccall((:peri_add_velocity, LIB), Int32, (Ptr{Cvoid}, Int32, Ptr{Float64}), body.handle, set, maybe(Float64, value))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
Supports: prescribe the `axes` of displacement [L] or velocity [L T^-1] of a set: value[dim] (NULL = zero), or as fn says (may be
NULL). Later supports win. The load factor multiplies a constant displacement, not a velocity. A grip should be a horizon deep, of
state-based laws two.
"""
function prescribe_displacement(body::Body, set, axes, value = nothing, fn = nothing)
    sized(value, dimension(body), "value")
    context = fn === nothing ? nothing : Context(Dict{Symbol,Any}(:call => fn), nothing, dimension(body))
    context === nothing || push!(body.keep, context)
    result = GC.@preserve body context ccall((:peri_prescribe_displacement, LIB), Int32, (Ptr{Cvoid}, Int32, Int32, Ptr{Float64}, Ptr{Cvoid}, Ptr{Cvoid}), body.handle, set, axes, maybe(Float64, value), context === nothing ? C_NULL : pointer_of_load_fn_call(), context === nothing ? C_NULL : pointer_from_objref(context))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
Supports: prescribe the `axes` of displacement [L] or velocity [L T^-1] of a set: value[dim] (NULL = zero), or as fn says (may be
NULL). Later supports win. The load factor multiplies a constant displacement, not a velocity. A grip should be a horizon deep, of
state-based laws two.
"""
function prescribe_velocity(body::Body, set, axes, value = nothing, fn = nothing)
    sized(value, dimension(body), "value")
    context = fn === nothing ? nothing : Context(Dict{Symbol,Any}(:call => fn), nothing, dimension(body))
    context === nothing || push!(body.keep, context)
    result = GC.@preserve body context ccall((:peri_prescribe_velocity, LIB), Int32, (Ptr{Cvoid}, Int32, Int32, Ptr{Float64}, Ptr{Cvoid}, Ptr{Cvoid}), body.handle, set, axes, maybe(Float64, value), context === nothing ? C_NULL : pointer_of_load_fn_call(), context === nothing ? C_NULL : pointer_from_objref(context))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
Support: the set moves as a rigid body. motion: displacement [L], then in 2D the angle about centre[dim], in 3D a vector along the
axis as long as the angle; NULL: 0. The load factor multiplies it; or fn writes it (may be NULL).
"""
function prescribe_rigid(body::Body, set, centre, motion = nothing, fn = nothing)
    sized(centre, dimension(body), "centre")
    sized(motion, dimension(body)+(2 * dimension(body) - 3), "motion")
    context = fn === nothing ? nothing : Context(Dict{Symbol,Any}(:call => fn), nothing, dimension(body))
    context === nothing || push!(body.keep, context)
    result = GC.@preserve body context ccall((:peri_prescribe_rigid, LIB), Int32, (Ptr{Cvoid}, Int32, Ptr{Float64}, Ptr{Float64}, Ptr{Cvoid}, Ptr{Cvoid}), body.handle, set, maybe(Float64, centre), maybe(Float64, motion), context === nothing ? C_NULL : pointer_of_rigid_fn_call(), context === nothing ? C_NULL : pointer_from_objref(context))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
Body force density value[dim] [M L^-2 T^-2] on a set; gravity is density times g.
"""
function apply_body_force(body::Body, set, value, fn = nothing)
    sized(value, dimension(body), "value")
    context = fn === nothing ? nothing : Context(Dict{Symbol,Any}(:call => fn), nothing, dimension(body))
    context === nothing || push!(body.keep, context)
    result = GC.@preserve body context ccall((:peri_apply_body_force, LIB), Int32, (Ptr{Cvoid}, Int32, Ptr{Float64}, Ptr{Cvoid}, Ptr{Cvoid}), body.handle, set, maybe(Float64, value), context === nothing ? C_NULL : pointer_of_load_fn_call(), context === nothing ? C_NULL : pointer_from_objref(context))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
Traction value[dim] [M L^-1 T^-2] on a flat face of `area` [L^2] (2D: length [L]) and outward `normal`. The set: all points within
two horizons of it, of one material. Uniform stress is exact for correspondence; else the total is, and strain is off by
O(horizon). ([C] 2.5, docs/statics.md)
"""
function apply_traction(body::Body, set, area, normal, value, fn = nothing)
    sized(normal, dimension(body), "normal")
    sized(value, dimension(body), "value")
    context = fn === nothing ? nothing : Context(Dict{Symbol,Any}(:call => fn), nothing, dimension(body))
    context === nothing || push!(body.keep, context)
    result = GC.@preserve body context ccall((:peri_apply_traction, LIB), Int32, (Ptr{Cvoid}, Int32, Float64, Ptr{Float64}, Ptr{Float64}, Ptr{Cvoid}, Ptr{Cvoid}), body.handle, set, area, maybe(Float64, normal), maybe(Float64, value), context === nothing ? C_NULL : pointer_of_load_fn_call(), context === nothing ? C_NULL : pointer_from_objref(context))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
A total of value*area (in 2D times the thickness), spread over the set by volume: on the outermost layer, say. Exact in sum, but
strain near the face is wrong by O(1) ([C] 2.5).
"""
function apply_layer_traction(body::Body, set, area, value, fn = nothing)
    sized(value, dimension(body), "value")
    context = fn === nothing ? nothing : Context(Dict{Symbol,Any}(:call => fn), nothing, dimension(body))
    context === nothing || push!(body.keep, context)
    result = GC.@preserve body context ccall((:peri_apply_layer_traction, LIB), Int32, (Ptr{Cvoid}, Int32, Float64, Ptr{Float64}, Ptr{Cvoid}, Ptr{Cvoid}), body.handle, set, area, maybe(Float64, value), context === nothing ? C_NULL : pointer_of_load_fn_call(), context === nothing ? C_NULL : pointer_from_objref(context))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
Pressure [M L^-1 T^-2] on all surfaces of a set, faces of cracks included ([C] 2.6): for a crack select the points within two
horizons of it. fn: value[k*dim] is the pressure on point k.
"""
function apply_pressure(body::Body, set, pressure, fn = nothing)
    context = fn === nothing ? nothing : Context(Dict{Symbol,Any}(:call => fn), nothing, dimension(body))
    context === nothing || push!(body.keep, context)
    result = GC.@preserve body context ccall((:peri_apply_pressure, LIB), Int32, (Ptr{Cvoid}, Int32, Float64, Ptr{Cvoid}, Ptr{Cvoid}), body.handle, set, pressure, context === nothing ? C_NULL : pointer_of_load_fn_call(), context === nothing ? C_NULL : pointer_from_objref(context))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
As [C] 2.6 has it: through the cut bonds between neighbouring points.
"""
function apply_bond_pressure_for_comparison(body::Body, set, pressure, fn = nothing)
    context = fn === nothing ? nothing : Context(Dict{Symbol,Any}(:call => fn), nothing, dimension(body))
    context === nothing || push!(body.keep, context)
    result = GC.@preserve body context ccall((:peri_apply_bond_pressure_for_comparison, LIB), Int32, (Ptr{Cvoid}, Int32, Float64, Ptr{Cvoid}, Ptr{Cvoid}), body.handle, set, pressure, context === nothing ? C_NULL : pointer_of_load_fn_call(), context === nothing ? C_NULL : pointer_from_objref(context))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
ids are not used twice
"""
function remove_load(body::Body, load)
    result = GC.@preserve body ccall((:peri_remove_load, LIB), Int32, (Ptr{Cvoid}, Int32), body.handle, load)
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
Force [M L T^-2] to force[dim]: of a support on the body, mean of the last step (or of the equilibrium); of a load, its present
total.
"""
function get_reaction!(body::Body, load, force)
    sized(force, dimension(body), "force")
    result = GC.@preserve body ccall((:peri_get_reaction, LIB), Int32, (Ptr{Cvoid}, Int32, Ptr{Float64}), body.handle, load, force)
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

function get_reaction(body::Body, load)
    force = Vector{Float64}(undef, dimension(body))
    get_reaction!(body, load, force)
    return force
end

"""
Its moment about place[dim] [M L^2 T^-2] to moment[1] (2D) or [3].
"""
function get_reaction_moment!(body::Body, load, place, moment)
    sized(place, dimension(body), "place")
    sized(moment, (2 * dimension(body) - 3), "moment")
    result = GC.@preserve body ccall((:peri_get_reaction_moment, LIB), Int32, (Ptr{Cvoid}, Int32, Ptr{Float64}, Ptr{Float64}), body.handle, load, maybe(Float64, place), moment)
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

function get_reaction_moment(body::Body, load, place)
    moment = Vector{Float64}(undef, (2 * dimension(body) - 3))
    get_reaction_moment!(body, load, place, moment)
    return moment
end

"""
A mesh is copied, and must be closed.
"""
function add_obstacle(body::Body, desc::Desc{peri_obstacle_desc})
    context_desc_user = Context(copy(getfield(desc, :calls)), nothing, dimension(body))
    setfield!(getfield(desc, :raw), :user, pointer_from_objref(context_desc_user))
    setfield!(getfield(desc, :raw), :distance, desc.distance === nothing ? C_NULL : pointer_of_distance_fn_distance())
    setfield!(getfield(desc, :raw), :motion, desc.motion === nothing ? C_NULL : pointer_of_motion_fn_motion())
    push!(body.keep, context_desc_user)
    result = GC.@preserve body desc context_desc_user ccall((:peri_add_obstacle, LIB), Int32, (Ptr{Cvoid}, Ptr{peri_obstacle_desc}), body.handle, Ptr{peri_obstacle_desc}(pointer_from_objref(getfield(desc, :raw))))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
A mesh is copied, and must be closed.
"""
function remove_obstacle(body::Body, obstacle)
    result = GC.@preserve body ccall((:peri_remove_obstacle, LIB), Int32, (Ptr{Cvoid}, Int32), body.handle, obstacle)
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
On the body: force[dim] [M L T^-2]; moment[3], in 2D [1], [M L^2 T^-2] about its place. Either may be NULL.
"""
function get_obstacle_force!(body::Body, obstacle, force = nothing, moment = nothing)
    sized(force, dimension(body), "force")
    sized(moment, (2 * dimension(body) - 3), "moment")
    result = GC.@preserve body ccall((:peri_get_obstacle_force, LIB), Int32, (Ptr{Cvoid}, Int32, Ptr{Float64}, Ptr{Float64}), body.handle, obstacle, force === nothing ? C_NULL : force, moment === nothing ? C_NULL : moment)
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

function get_obstacle_state(body::Body, obstacle)
    state = Ref{peri_obstacle_state}()
    result = GC.@preserve body ccall((:peri_get_obstacle_state, LIB), Int32, (Ptr{Cvoid}, Int32, Ref{peri_obstacle_state}), body.handle, obstacle, state)
    check(result, result < 0 ? last_error(body) : nothing)
    return state[]
end

"""
Sets place, turn, velocity and spin of a free one.
"""
function set_obstacle_state(body::Body, obstacle, state::peri_obstacle_state)
    result = GC.@preserve body ccall((:peri_set_obstacle_state, LIB), Int32, (Ptr{Cvoid}, Int32, Ref{peri_obstacle_state}), body.handle, obstacle, state)
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
Of materials i and j, ids or PERI_ALL; NULL: none.
"""
function set_contact(body::Body, i, j, desc)
    result = GC.@preserve body desc ccall((:peri_set_contact, LIB), Int32, (Ptr{Cvoid}, Int32, Int32, Ptr{peri_contact_desc}), body.handle, i, j, desc === nothing ? C_NULL : Ptr{peri_contact_desc}(pointer_from_objref(getfield(desc, :raw))))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
Advances the body in time. PERI_ERROR_STEP: it ends at a whole step; the value is what may follow. So does PERI_ERROR_CALLBACK of
a peri_frame_fn or peri_break_fn. PERI_ERROR_UNSTABLE, and PERI_ERROR_CALLBACK of a load or obstacle (index: the point): it ended
within a step; read it, then reset or destroy it.
"""
function advance(body::Body, desc::Desc{peri_advance_desc})
    context_desc_user = Context(copy(getfield(desc, :calls)), body, dimension(body))
    setfield!(getfield(desc, :raw), :user, pointer_from_objref(context_desc_user))
    setfield!(getfield(desc, :raw), :on_frame, desc.on_frame === nothing ? C_NULL : pointer_of_frame_fn_on_frame())
    result = GC.@preserve body desc context_desc_user ccall((:peri_advance, LIB), Int32, (Ptr{Cvoid}, Ptr{peri_advance_desc}), body.handle, Ptr{peri_advance_desc}(pointer_from_objref(getfield(desc, :raw))))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
Forces at a displacement of yours. A step, rho of PERI_FIELD_DENSITY: v += dt/2 force/rho, u += dt v, peri_evaluate, v += (dt/2
force + impulse)/rho. report may be NULL.
"""
function evaluate(body::Body, desc::Desc{peri_evaluate_desc})
    report = Ref{peri_evaluate_report}()
    result = GC.@preserve body desc ccall((:peri_evaluate, LIB), Int32, (Ptr{Cvoid}, Ptr{peri_evaluate_desc}, Ref{peri_evaluate_report}), body.handle, Ptr{peri_evaluate_desc}(pointer_from_objref(getfield(desc, :raw))), report)
    check(result, result < 0 ? last_error(body) : nothing)
    return report[]
end

"""
Equilibrium under supports and loads, constant values times a factor from load_from to load_to, callbacks at time = factor,
prescribed velocities at rest; bonds over their limit break until none does. A later run goes on at load_to. A failed step leaves
the last equilibrium, or, after breaks, how far it came; so does PERI_ENDED_SEVERED.
"""
function solve(body::Body, desc::Desc{peri_solve_desc})
    context_desc_user = Context(copy(getfield(desc, :calls)), body, dimension(body))
    setfield!(getfield(desc, :raw), :user, pointer_from_objref(context_desc_user))
    setfield!(getfield(desc, :raw), :on_iteration, desc.on_iteration === nothing ? C_NULL : pointer_of_iteration_fn_on_iteration())
    setfield!(getfield(desc, :raw), :on_step, desc.on_step === nothing ? C_NULL : pointer_of_frame_fn_on_step())
    report = Ref{peri_solve_report}()
    result = GC.@preserve body desc context_desc_user ccall((:peri_solve, LIB), Int32, (Ptr{Cvoid}, Ptr{peri_solve_desc}, Ref{peri_solve_report}), body.handle, Ptr{peri_solve_desc}(pointer_from_objref(getfield(desc, :raw))), report)
    check(result, result < 0 ? last_error(body) : nothing)
    return report[]
end

"""
peri_advance by implicit steps, `time_step` > 0 of any size (generalised alpha, order 2). rho [0, 1]: what is left of the highest
modes per step; 1 keeps the energy. solve: tolerance, fracture, limits, on_iteration; NULL: defaults. No obstacles or contact. A
step that fails leaves the last one, less the bonds that broke in it. report may be NULL.
"""
function advance_implicit(body::Body, advance::Desc{peri_advance_desc}, solve::Desc{peri_solve_desc}, rho)
    context_advance_user = Context(copy(getfield(advance, :calls)), body, dimension(body))
    setfield!(getfield(advance, :raw), :user, pointer_from_objref(context_advance_user))
    setfield!(getfield(advance, :raw), :on_frame, advance.on_frame === nothing ? C_NULL : pointer_of_frame_fn_on_frame())
    context_solve_user = Context(copy(getfield(solve, :calls)), body, dimension(body))
    setfield!(getfield(solve, :raw), :user, pointer_from_objref(context_solve_user))
    setfield!(getfield(solve, :raw), :on_iteration, solve.on_iteration === nothing ? C_NULL : pointer_of_iteration_fn_on_iteration())
    setfield!(getfield(solve, :raw), :on_step, solve.on_step === nothing ? C_NULL : pointer_of_frame_fn_on_step())
    report = Ref{peri_solve_report}()
    result = GC.@preserve body advance context_advance_user solve context_solve_user ccall((:peri_advance_implicit, LIB), Int32, (Ptr{Cvoid}, Ptr{peri_advance_desc}, Ptr{peri_solve_desc}, Float64, Ref{peri_solve_report}), body.handle, Ptr{peri_advance_desc}(pointer_from_objref(getfield(advance, :raw))), Ptr{peri_solve_desc}(pointer_from_objref(getfield(solve, :raw))), rho, report)
    check(result, result < 0 ? last_error(body) : nothing)
    return report[]
end

"""
out = K in [M L T^-2], the tangent at the present displacement times in[count], count = points*dim; without supports, obstacles
and contact. out may be in. The first call takes memory (peri_memory.state).
"""
function multiply_stiffness!(body::Body, in_, out)
    sized(out, entries(in_), "out")
    result = GC.@preserve body ccall((:peri_multiply_stiffness, LIB), Int32, (Ptr{Cvoid}, Ptr{Float64}, Ptr{Float64}, Int64), body.handle, maybe(Float64, in_), out, entries(in_))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

function multiply_stiffness(body::Body, in_)
    out = Vector{Float64}(undef, length(in_))
    multiply_stiffness!(body, in_, out)
    return out
end

"""
The same at `displacement` [points*dim] of yours instead: the body stays where it is.
"""
function multiply_stiffness_at!(body::Body, displacement, in_, out)
    sized(displacement, point_count(body)*dimension(body), "displacement")
    sized(out, entries(in_), "out")
    result = GC.@preserve body ccall((:peri_multiply_stiffness_at, LIB), Int32, (Ptr{Cvoid}, Ptr{Float64}, Ptr{Float64}, Ptr{Float64}, Int64), body.handle, maybe(Float64, displacement), maybe(Float64, in_), out, entries(in_))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

function multiply_stiffness_at(body::Body, displacement, in_)
    out = Vector{Float64}(undef, length(in_))
    multiply_stiffness_at!(body, displacement, in_, out)
    return out
end

"""
The same as a matrix by compressed rows, points*dim square ([T] 3.2, 3.3). It outlives the body; free it by peri_matrix_destroy.
"""
function matrix_create(body::Body)
    made = Ref{Ptr{Cvoid}}(C_NULL)
    result = GC.@preserve body ccall((:peri_matrix_create, LIB), Int32, (Ptr{Cvoid}, Ptr{Ptr{Cvoid}}), body.handle, made)
    check(result, result < 0 ? last_error(body) : nothing)
    return Matrix(made[], dimension(body))
end

"""
The same as a matrix by compressed rows, points*dim square ([T] 3.2, 3.3). It outlives the body; free it by peri_matrix_destroy.
"""
function matrix_rows(matrix::Matrix)
    result = GC.@preserve matrix ccall((:peri_matrix_rows, LIB), Int64, (Ptr{Cvoid},), matrix.handle)
    return result
end

"""
The same as a matrix by compressed rows, points*dim square ([T] 3.2, 3.3). It outlives the body; free it by peri_matrix_destroy.
"""
function matrix_entries(matrix::Matrix)
    result = GC.@preserve matrix ccall((:peri_matrix_entries, LIB), Int64, (Ptr{Cvoid},), matrix.handle)
    return result
end

"""
start[rows+1], column[entries] ascending in each row, value[entries] [M T^-2]; any may be NULL.
"""
function get_matrix!(matrix::Matrix, start = nothing, column = nothing, value = nothing)
    sized(start, matrix_rows(matrix)+1, "start")
    sized(column, matrix_entries(matrix), "column")
    sized(value, matrix_entries(matrix), "value")
    result = GC.@preserve matrix ccall((:peri_get_matrix, LIB), Int32, (Ptr{Cvoid}, Ptr{Int64}, Ptr{Int32}, Ptr{Float64}), matrix.handle, start === nothing ? C_NULL : start, column === nothing ? C_NULL : column, value === nothing ? C_NULL : value)
    check(result)
    return result
end

"""
Matrix Market, coordinate real symmetric: the lower triangle.
"""
function export_matrix_to(matrix::Matrix, write)
    context = write === nothing ? nothing : Context(Dict{Symbol,Any}(:call => write), nothing, matrix.dim)
    result = GC.@preserve matrix context ccall((:peri_export_matrix_to, LIB), Int32, (Ptr{Cvoid}, Ptr{Cvoid}, Ptr{Cvoid}), matrix.handle, context === nothing ? C_NULL : pointer_of_write_fn_call(), context === nothing ? C_NULL : pointer_from_objref(context))
    check(result)
    return result
end

"""
Entries of a field: points*components.
"""
function size_of_field(body::Body, field)
    result = GC.@preserve body ccall((:peri_size_of_field, LIB), Int64, (Ptr{Cvoid}, Int32), body.handle, field)
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
Copies a field, as double, in your units and order. capacity counts doubles.
"""
function get_field!(body::Body, field, out)
    result = GC.@preserve body ccall((:peri_get_field, LIB), Int32, (Ptr{Cvoid}, Int32, Ptr{Float64}, Int64), body.handle, field, out, entries(out))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

function get_field(body::Body, field)
    out = Vector{Float64}(undef, size_of_field(body, field))
    get_field!(body, field, out)
    return out
end

"""
Sets a field W of all points; count = points*components. What peri_get_field gives changes no bit. Fields of material
(docs/laws.md), which peri_frame_fn may set, too, outlast peri_reset.
"""
function set_field(body::Body, field, in_)
    result = GC.@preserve body ccall((:peri_set_field, LIB), Int32, (Ptr{Cvoid}, Int32, Ptr{Float64}, Int64), body.handle, field, maybe(Float64, in_), entries(in_))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
Without a copy. Of a stored field it shows the present state; of a derived one that of the call, until it is viewed again.
"""
function view_field(body::Body, field)
    view = Ref{peri_view}()
    result = GC.@preserve body ccall((:peri_view_field, LIB), Int32, (Ptr{Cvoid}, Int32, Ref{peri_view}), body.handle, field, view)
    check(result, result < 0 ? last_error(body) : nothing)
    return view[]
end

"""
Of points[count] alone: count*components.
"""
function get_field_at!(body::Body, field, points, out)
    result = GC.@preserve body ccall((:peri_get_field_at, LIB), Int32, (Ptr{Cvoid}, Int32, Int64, Ptr{Int32}, Ptr{Float64}, Int64), body.handle, field, entries(points), maybe(Int32, points), out, entries(out))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
At places[count*dim] [L], in_place = 1: present ones: linear fields exactly, not across cracks. Outside: NaN.
"""
function interpolate_field!(body::Body, field, in_place, places, out)
    entries(places) % dimension(body) == 0 || refuse("places")
    result = GC.@preserve body ccall((:peri_interpolate_field, LIB), Int32, (Ptr{Cvoid}, Int32, Int32, Int64, Ptr{Float64}, Ptr{Float64}, Int64), body.handle, field, in_place, entries(places) ÷ dimension(body), maybe(Float64, places), out, entries(out))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
Bonds of the points of a set, as in peri_get_families.
"""
function size_of_bonds(body::Body, set, bond)
    result = GC.@preserve body ccall((:peri_size_of_bonds, LIB), Int64, (Ptr{Cvoid}, Int32, Int32), body.handle, set, bond)
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
Bonds of the points of a set, as in peri_get_families.
"""
function get_bonds!(body::Body, set, bond, out)
    result = GC.@preserve body ccall((:peri_get_bonds, LIB), Int32, (Ptr{Cvoid}, Int32, Int32, Ptr{Float64}, Int64), body.handle, set, bond, out, entries(out))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
Costs one evaluation of the forces.
"""
function get_energy(body::Body)
    energy = Ref{peri_energy}()
    result = GC.@preserve body ccall((:peri_get_energy, LIB), Int32, (Ptr{Cvoid}, Ref{peri_energy}), body.handle, energy)
    check(result, result < 0 ? last_error(body) : nothing)
    return energy[]
end

"""
Momentum [M L T^-1] to linear[dim], about the origin [M L^2 T^-1] to angular[1] (2D) or [3]. Either may be NULL.
"""
function get_momentum!(body::Body, linear = nothing, angular = nothing)
    sized(linear, dimension(body), "linear")
    sized(angular, (2 * dimension(body) - 3), "angular")
    result = GC.@preserve body ccall((:peri_get_momentum, LIB), Int32, (Ptr{Cvoid}, Ptr{Float64}, Ptr{Float64}), body.handle, linear === nothing ? C_NULL : linear, angular === nothing ? C_NULL : angular)
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

function cracks_create(body::Body, desc::Desc{peri_cracks_desc})
    made = Ref{Ptr{Cvoid}}(C_NULL)
    result = GC.@preserve body desc ccall((:peri_cracks_create, LIB), Int32, (Ptr{Cvoid}, Ptr{peri_cracks_desc}, Ptr{Ptr{Cvoid}}), body.handle, Ptr{peri_cracks_desc}(pointer_from_objref(getfield(desc, :raw))), made)
    check(result, result < 0 ? last_error(body) : nothing)
    return Cracks(made[], dimension(body))
end

"""
polylines; 3D: sides of cells
"""
function cracks_paths(cracks::Cracks)
    result = GC.@preserve cracks ccall((:peri_cracks_paths, LIB), Int64, (Ptr{Cvoid},), cracks.handle)
    return result
end

function cracks_vertices(cracks::Cracks)
    result = GC.@preserve cracks ccall((:peri_cracks_vertices, LIB), Int64, (Ptr{Cvoid},), cracks.handle)
    return result
end

function cracks_tips(cracks::Cracks)
    result = GC.@preserve cracks ccall((:peri_cracks_tips, LIB), Int64, (Ptr{Cvoid},), cracks.handle)
    return result
end

"""
length [L]; 3D: area [L^2]
"""
function cracks_size(cracks::Cracks)
    result = GC.@preserve cracks ccall((:peri_cracks_size, LIB), Float64, (Ptr{Cvoid},), cracks.handle)
    return result
end

"""
Path p: vertices start[p] to start[p+1], of start[paths+1]; in 3D 4: triangles 0 1 2, 0 2 3. vertex[vertices*dim] [L],
time[vertices] of breaking [T] (peri_solve: load factor; NaN: not recorded), tip[tips]. Any may be NULL.
"""
function get_cracks!(cracks::Cracks, start = nothing, vertex = nothing, time = nothing, tip = nothing)
    sized(start, cracks_paths(cracks)+1, "start")
    sized(vertex, cracks_vertices(cracks)*cracks.dim, "vertex")
    sized(time, cracks_vertices(cracks), "time")
    sized(tip, cracks_tips(cracks), "tip")
    result = GC.@preserve cracks ccall((:peri_get_cracks, LIB), Int32, (Ptr{Cvoid}, Ptr{Int64}, Ptr{Float64}, Ptr{Float64}, Ptr{peri_crack_tip}), cracks.handle, start === nothing ? C_NULL : start, vertex === nothing ? C_NULL : vertex, time === nothing ? C_NULL : time, tip === nothing ? C_NULL : tip)
    check(result)
    return result
end

"""
VTK XML PolyData (.vtp).
"""
function export_cracks_to(cracks::Cracks, write)
    context = write === nothing ? nothing : Context(Dict{Symbol,Any}(:call => write), nothing, cracks.dim)
    result = GC.@preserve cracks context ccall((:peri_export_cracks_to, LIB), Int32, (Ptr{Cvoid}, Ptr{Cvoid}, Ptr{Cvoid}), cracks.handle, context === nothing ? C_NULL : pointer_of_write_fn_call(), context === nothing ? C_NULL : pointer_from_objref(context))
    check(result)
    return result
end

"""
VTK XML for ParaView; 'Warp By Vector' shows the deformed body.
"""
function export_vtu_to(body::Body, write)
    context = write === nothing ? nothing : Context(Dict{Symbol,Any}(:call => write), nothing, dimension(body))
    result = GC.@preserve body context ccall((:peri_export_vtu_to, LIB), Int32, (Ptr{Cvoid}, Ptr{Cvoid}, Ptr{Cvoid}), body.handle, context === nothing ? C_NULL : pointer_of_write_fn_call(), context === nothing ? C_NULL : pointer_from_objref(context))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
fields[count], each once, or NULL: as above.
"""
function export_fields_to(body::Body, fields = nothing, write)
    context = write === nothing ? nothing : Context(Dict{Symbol,Any}(:call => write), nothing, dimension(body))
    result = GC.@preserve body context ccall((:peri_export_fields_to, LIB), Int32, (Ptr{Cvoid}, Ptr{Int32}, Int64, Ptr{Cvoid}, Ptr{Cvoid}), body.handle, maybe(Int32, fields), entries(fields), context === nothing ? C_NULL : pointer_of_write_fn_call(), context === nothing ? C_NULL : pointer_from_objref(context))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
One CSV line: step, time, the ledger, broken and cut bonds; header = 1: the names first.
"""
function export_history_to(body::Body, header, write)
    context = write === nothing ? nothing : Context(Dict{Symbol,Any}(:call => write), nothing, dimension(body))
    result = GC.@preserve body context ccall((:peri_export_history_to, LIB), Int32, (Ptr{Cvoid}, Int32, Ptr{Cvoid}, Ptr{Cvoid}), body.handle, header, context === nothing ? C_NULL : pointer_of_write_fn_call(), context === nothing ? C_NULL : pointer_from_objref(context))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

function export_vtu(body::Body, path)
    result = GC.@preserve body ccall((:peri_export_vtu, LIB), Int32, (Ptr{Cvoid}, Cstring), body.handle, path)
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
Frame 0, 1, ... of a series: its VTU beside `path`, a .pvd.
"""
function export_frame(body::Body, path, frame, fields = nothing)
    result = GC.@preserve body ccall((:peri_export_frame, LIB), Int32, (Ptr{Cvoid}, Cstring, Int64, Ptr{Int32}, Int64), body.handle, path, frame, maybe(Int32, fields), entries(fields))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
append = 0 starts the file with a header, 1 adds a line.
"""
function export_history(body::Body, path, append)
    result = GC.@preserve body ccall((:peri_export_history, LIB), Int32, (Ptr{Cvoid}, Cstring, Int32), body.handle, path, append)
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
Saves the state: motion, bonds, what criteria keep, time, ledger. Not the scene: load it into a body that the same calls built.
What follows has the same bits.
"""
function save_state_to(body::Body, write)
    context = write === nothing ? nothing : Context(Dict{Symbol,Any}(:call => write), nothing, dimension(body))
    result = GC.@preserve body context ccall((:peri_save_state_to, LIB), Int32, (Ptr{Cvoid}, Ptr{Cvoid}, Ptr{Cvoid}), body.handle, context === nothing ? C_NULL : pointer_of_write_fn_call(), context === nothing ? C_NULL : pointer_from_objref(context))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

"""
Reads all, verifies it, then takes it. PERI_ERROR_STATE: nothing has changed; field: what is of another scene, or ''.
"""
function load_state_from(body::Body, read)
    context = read === nothing ? nothing : Context(Dict{Symbol,Any}(:call => read), nothing, dimension(body))
    result = GC.@preserve body context ccall((:peri_load_state_from, LIB), Int32, (Ptr{Cvoid}, Ptr{Cvoid}, Ptr{Cvoid}), body.handle, context === nothing ? C_NULL : pointer_of_read_fn_call(), context === nothing ? C_NULL : pointer_from_objref(context))
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

function save_state(body::Body, path)
    result = GC.@preserve body ccall((:peri_save_state, LIB), Int32, (Ptr{Cvoid}, Cstring), body.handle, path)
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

function load_state(body::Body, path)
    result = GC.@preserve body ccall((:peri_load_state, LIB), Int32, (Ptr{Cvoid}, Cstring), body.handle, path)
    check(result, result < 0 ? last_error(body) : nothing)
    return result
end

function get_memory(body::Body)
    memory = Ref{peri_memory}()
    result = GC.@preserve body ccall((:peri_get_memory, LIB), Int32, (Ptr{Cvoid}, Ref{peri_memory}), body.handle, memory)
    check(result, result < 0 ? last_error(body) : nothing)
    return memory[]
end

"""
What a scene will cost, before it is made: some milliseconds. Refuses what peri_body_create, peri_add_material, peri_add_box and
peri_build would refuse. error may be NULL.
"""
function plan(desc::Desc{peri_plan_desc})
    report = Ref{peri_plan_report}()
    record = Ref{peri_error}(blank(0, ""))
    result = GC.@preserve desc ccall((:peri_plan, LIB), Int32, (Ptr{peri_plan_desc}, Ref{peri_plan_report}, Ref{peri_error}), Ptr{peri_plan_desc}(pointer_from_objref(getfield(desc, :raw))), report, record)
    check(result, record[])
    return report[]
end

"""
Fills body (precision, influence, quadrature, correction, horizon) and material (law, poisson, stabilization) with the best
choice, from a measured table; the rest stays. body needs its space, material its constants. PERI_ERROR_RANGE: out of reach; the
value is what is in reach. error may be NULL.
"""
function choose(desc::Desc{peri_choose_desc}, body::Desc{peri_body_desc}, material::Desc{peri_material_desc})
    context_body_influence_user = Context(copy(getfield(body, :calls)), nothing, desc.dim)
    setfield!(getfield(body, :raw), :influence_user, pointer_from_objref(context_body_influence_user))
    setfield!(getfield(body, :raw), :influence_fn, body.influence_fn === nothing ? C_NULL : pointer_of_influence_fn_influence_fn())
    push!(keep, context_body_influence_user)
    context_body_log_user = Context(copy(getfield(body, :calls)), nothing, desc.dim)
    setfield!(getfield(body, :raw), :log_user, pointer_from_objref(context_body_log_user))
    setfield!(getfield(body, :raw), :log, body.log === nothing ? C_NULL : pointer_of_log_fn_log())
    push!(keep, context_body_log_user)
    context_material_stress_user = Context(copy(getfield(material, :calls)), nothing, desc.dim)
    setfield!(getfield(material, :raw), :stress_user, pointer_from_objref(context_material_stress_user))
    setfield!(getfield(material, :raw), :stress, material.stress === nothing ? C_NULL : pointer_of_stress_fn_stress())
    push!(keep, context_material_stress_user)
    report = Ref{peri_choose_report}()
    record = Ref{peri_error}(blank(0, ""))
    result = GC.@preserve desc body context_body_influence_user context_body_log_user material context_material_stress_user ccall((:peri_choose, LIB), Int32, (Ptr{peri_choose_desc}, Ptr{peri_body_desc}, Ptr{peri_material_desc}, Ref{peri_choose_report}, Ref{peri_error}), Ptr{peri_choose_desc}(pointer_from_objref(getfield(desc, :raw))), Ptr{peri_body_desc}(pointer_from_objref(getfield(body, :raw))), Ptr{peri_material_desc}(pointer_from_objref(getfield(material, :raw))), report, record)
    check(result, record[])
    return report[]
end

Body(desc::Desc{peri_body_desc}) = body_create(desc)

end # module
