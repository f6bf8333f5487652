! SPDX-License-Identifier: MIT
! peri.f90 - peri for Fortran 2008. Made from peri.h by tools/bind.py: edit that.
!
! Names are those of peri.h; body is type(peri_body), and what C returns comes from a function, or by an argument where there is
! none to return. Lengths follow from the arrays. A callback is a bind(c) procedure of an interface below, and has its data in a
! module, or where user=c_loc(data) says. Each call takes stat= and errmsg=, like allocate: without stat, a failure is an error
! stop. A name '' stands for NULL. Points count from 0. A body is freed by call peri_body_destroy(body); do not copy it.

! What C has, as it is; use peri, not this.
module peri_c
    use, intrinsic :: iso_c_binding
    implicit none
    integer(c_int32_t), parameter :: PERI_VERSION_NUMBER = 2000
    integer(c_int32_t), parameter :: PERI_ALL = 268435456

    ! success: as brittle bonds, the horizon being too large
    integer(c_int32_t), parameter :: PERI_BRITTLE = 2
    ! a callback asked to stop; the body is at a whole step
    integer(c_int32_t), parameter :: PERI_STOPPED = 1
    ! success
    integer(c_int32_t), parameter :: PERI_OK = 0
    ! missing, NULL or given twice, or a count that is wrong
    integer(c_int32_t), parameter :: PERI_ERROR_ARGUMENT = -1
    ! not a value of this enum, or a flag that is not 0 or 1
    integer(c_int32_t), parameter :: PERI_ERROR_CHOICE = -2
    ! not filled by its init function, or of another version
    integer(c_int32_t), parameter :: PERI_ERROR_DESCRIPTOR = -3
    ! a number is not finite or outside the range of its field
    integer(c_int32_t), parameter :: PERI_ERROR_RANGE = -4
    ! too early, too late, or from a callback that may not
    integer(c_int32_t), parameter :: PERI_ERROR_ORDER = -5
    ! the allocator returned NULL
    integer(c_int32_t), parameter :: PERI_ERROR_MEMORY = -6
    ! more than the library or memory takes; see the value
    integer(c_int32_t), parameter :: PERI_ERROR_TOO_LARGE = -7
    ! the buffer has the wrong size; it needs the value
    integer(c_int32_t), parameter :: PERI_ERROR_CAPACITY = -8
    ! no id: zero, a plain number, or what a failed call returned
    integer(c_int32_t), parameter :: PERI_ERROR_ID_NONE = -9
    ! an id of another kind: of a load, say, not of a set
    integer(c_int32_t), parameter :: PERI_ERROR_ID_KIND = -10
    ! an id of another body
    integer(c_int32_t), parameter :: PERI_ERROR_ID_BODY = -11
    ! nothing has this id: it was removed, or never given
    integer(c_int32_t), parameter :: PERI_ERROR_ID_GONE = -12
    ! no point has this number
    integer(c_int32_t), parameter :: PERI_ERROR_INDEX = -13
    ! a name that is taken, or that no set has
    integer(c_int32_t), parameter :: PERI_ERROR_NAME = -14
    ! the body, the shape or the selection holds no point
    integer(c_int32_t), parameter :: PERI_ERROR_EMPTY = -15
    ! the material contradicts itself, or is missing
    integer(c_int32_t), parameter :: PERI_ERROR_MATERIAL = -16
    ! bond-based: Poisson's ratio is fixed; it is the value
    integer(c_int32_t), parameter :: PERI_ERROR_POISSON = -17
    ! this law has no such thing, or cannot take this
    integer(c_int32_t), parameter :: PERI_ERROR_LAW = -18
    ! the criterion cannot act on this law, or lacks its G0
    integer(c_int32_t), parameter :: PERI_ERROR_CRITERION = -19
    ! the influence function or its moments are not finite
    integer(c_int32_t), parameter :: PERI_ERROR_INFLUENCE = -20
    ! a place not finite, no volume, or a cell that crosses itself
    integer(c_int32_t), parameter :: PERI_ERROR_POINT = -21
    ! two points are at the same place
    integer(c_int32_t), parameter :: PERI_ERROR_COINCIDENT = -22
    ! the horizon is smaller than the spacing of the points
    integer(c_int32_t), parameter :: PERI_ERROR_HORIZON = -23
    ! a point has no neighbour, or none with a weight
    integer(c_int32_t), parameter :: PERI_ERROR_FAMILY = -24
    ! given families: wrong number, not mutual, not of the horizon
    integer(c_int32_t), parameter :: PERI_ERROR_IBOND = -25
    ! the crack has no extent, or is not for this space
    integer(c_int32_t), parameter :: PERI_ERROR_CRACK = -26
    ! the two points share no bond
    integer(c_int32_t), parameter :: PERI_ERROR_PAIR = -27
    ! this field cannot be used in this way: it is not stored
    integer(c_int32_t), parameter :: PERI_ERROR_FIELD = -28
    ! the points feel another area than that of the face
    integer(c_int32_t), parameter :: PERI_ERROR_AREA = -29
    ! the time step exceeds the stable step, which is the value
    integer(c_int32_t), parameter :: PERI_ERROR_STEP = -30
    ! a point passed 1e9 speeds of sound: step, load or start
    integer(c_int32_t), parameter :: PERI_ERROR_UNSTABLE = -31
    ! a callback failed, or wrote what is not finite
    integer(c_int32_t), parameter :: PERI_ERROR_CALLBACK = -32
    ! no support holds this part against some motion
    integer(c_int32_t), parameter :: PERI_ERROR_LOOSE = -33
    ! the tangent is not positive: buckling or softening
    integer(c_int32_t), parameter :: PERI_ERROR_INDEFINITE = -34
    ! no equilibrium within the iterations; value: residual
    integer(c_int32_t), parameter :: PERI_ERROR_CONVERGENCE = -35
    ! the file or the write callback failed
    integer(c_int32_t), parameter :: PERI_ERROR_WRITE = -36
    ! left out of this build, by the switch that the field names
    integer(c_int32_t), parameter :: PERI_ERROR_LEFT_OUT = -37
    ! no saved state of such a body, or damaged; value: the byte
    integer(c_int32_t), parameter :: PERI_ERROR_STATE = -38
    ! not of a part of a body; or its ghosts are not as owned
    integer(c_int32_t), parameter :: PERI_ERROR_PART = -39

    integer(c_int32_t), parameter :: PERI_KIND_MATERIAL = 2201
    integer(c_int32_t), parameter :: PERI_KIND_SET = 2202
    ! supports included
    integer(c_int32_t), parameter :: PERI_KIND_LOAD = 2203
    integer(c_int32_t), parameter :: PERI_KIND_OBSTACLE = 2204

    ! 2D, thin plate; bond-based: Poisson's ratio 1/3
    integer(c_int32_t), parameter :: PERI_SPACE_PLANE_STRESS = 101
    ! 2D, long prism; bond-based: 1/4
    integer(c_int32_t), parameter :: PERI_SPACE_PLANE_STRAIN = 102
    ! 3D; bond-based: 1/4
    integer(c_int32_t), parameter :: PERI_SPACE_SOLID = 103

    integer(c_int32_t), parameter :: PERI_PRECISION_DOUBLE = 201
    ! state in double, bonds in single: strain to 7 digits
    integer(c_int32_t), parameter :: PERI_PRECISION_MIXED = 202
    ! faster, 0.65 of the memory; strains below 1e-6 lose digits
    integer(c_int32_t), parameter :: PERI_PRECISION_SINGLE = 203

    ! e = |xi+eta| - |xi|, force along xi+eta ([T] 1.23)
    integer(c_int32_t), parameter :: PERI_GEOMETRY_NONLINEAR = 301
    ! e = xi.eta/|xi|, force along xi: small motion ([T] 1.37)
    integer(c_int32_t), parameter :: PERI_GEOMETRY_LINEAR = 302

    ! 1, also beyond [P] w0, [C] Const
    integer(c_int32_t), parameter :: PERI_INFLUENCE_CONSTANT = 401
    ! 1, beyond 0 [P] w0.5
    integer(c_int32_t), parameter :: PERI_INFLUENCE_CUTOFF = 402
    ! 1 - q, beyond 0 [P] w1, [C] Linear
    integer(c_int32_t), parameter :: PERI_INFLUENCE_LINEAR = 403
    ! 1 - 3q^2 + 2q^3, beyond 0 [P] w3
    integer(c_int32_t), parameter :: PERI_INFLUENCE_CUBIC = 404
    ! 1 - 10q^3 + 15q^4 - 6q^5, beyond 0 [P] w5
    integer(c_int32_t), parameter :: PERI_INFLUENCE_QUINTIC = 405
    ! 1 - 35q^4 + 84q^5 - 70q^6 + 20q^7, beyond 0 [P] w7
    integer(c_int32_t), parameter :: PERI_INFLUENCE_SEPTIC = 406
    ! (1 - q)^2, beyond 0 [C] Quadr
    integer(c_int32_t), parameter :: PERI_INFLUENCE_POWER_2 = 407
    ! (1 - q)^3, beyond 0 [C] Cubic
    integer(c_int32_t), parameter :: PERI_INFLUENCE_POWER_3 = 408
    ! exp(-q^2), also beyond [T]
    integer(c_int32_t), parameter :: PERI_INFLUENCE_GAUSSIAN = 409
    ! q, also beyond [T]
    integer(c_int32_t), parameter :: PERI_INFLUENCE_PROPORTIONAL = 410
    ! 1/q, also beyond [T], [C] Inv
    integer(c_int32_t), parameter :: PERI_INFLUENCE_INVERSE = 411
    ! q^-4, also beyond; no finite moments [T]
    integer(c_int32_t), parameter :: PERI_INFLUENCE_INVERSE_4 = 412
    ! 1/(1 + spacing/(2 horizon) - q) [T]
    integer(c_int32_t), parameter :: PERI_INFLUENCE_POLE_EDGE = 413
    ! 1/|2q - 1|, also beyond; no finite moments [T]
    integer(c_int32_t), parameter :: PERI_INFLUENCE_POLE_HALF = 414
    ! exp(1/(q - 1/4)), also beyond; no moments; [T] in mm
    integer(c_int32_t), parameter :: PERI_INFLUENCE_POLE_QUARTER = 415
    ! influence_fn
    integer(c_int32_t), parameter :: PERI_INFLUENCE_USER = 416

    ! cells whose centre is within, whole [P] FA
    integer(c_int32_t), parameter :: PERI_QUADRATURE_FULL = 501
    ! from 1 to 0 over horizon -+ spacing/2 [T] Fig. 3.7
    integer(c_int32_t), parameter :: PERI_QUADRATURE_RAMP = 502
    ! the exact part within the horizon [P] PA-AC
    integer(c_int32_t), parameter :: PERI_QUADRATURE_PARTIAL = 503
    ! 2D, to its centroid [P] IPA-AC: for comparison
    integer(c_int32_t), parameter :: PERI_QUADRATURE_PARTIAL_CENTROID = 504
    ! 2D, the centroid's energy, objective
    integer(c_int32_t), parameter :: PERI_QUADRATURE_PARTIAL_MOMENT = 505

    ! a bond acts until it meets its criterion; error O(dt^2)
    integer(c_int32_t), parameter :: PERI_BREAK_WITHIN_STEP = 601
    ! until the middle of the step [P]; ledger error O(dt)
    integer(c_int32_t), parameter :: PERI_BREAK_AFTER_DRIFT = 602

    ! the constants of an infinite body
    integer(c_int32_t), parameter :: PERI_CORRECTION_NONE = 701
    ! bond-based, by volumes (Le, Bobaru 2018): for comparison
    integer(c_int32_t), parameter :: PERI_CORRECTION_VOLUME = 702
    ! bond-based: right energy of isotropic strain and mean shear
    integer(c_int32_t), parameter :: PERI_CORRECTION_ENERGY = 703
    ! weights, as little as makes uniform strain exact on lattices
    integer(c_int32_t), parameter :: PERI_CORRECTION_MOMENT = 704
    ! and in equilibrium inside on any cloud; not of parts
    integer(c_int32_t), parameter :: PERI_CORRECTION_EQUILIBRIUM = 705

    ! those left: they take over what others carried
    integer(c_int32_t), parameter :: PERI_MOMENTS_LIVE = 2501
    ! all, broken and cut ones included
    integer(c_int32_t), parameter :: PERI_MOMENTS_WHOLE = 2502

    ! columns on lattices where that serves, else a list
    integer(c_int32_t), parameter :: PERI_KERNEL_BEST = 801
    ! every quantity by its formula, bond by bond: slow
    integer(c_int32_t), parameter :: PERI_KERNEL_REFERENCE = 802
    ! the list of families, as clouds have it
    integer(c_int32_t), parameter :: PERI_KERNEL_LIST = 803

    ! of the machine
    integer(c_int32_t), parameter :: PERI_INSTRUCTIONS_BEST = 901
    ! SSE2
    integer(c_int32_t), parameter :: PERI_INSTRUCTIONS_BASELINE = 902
    integer(c_int32_t), parameter :: PERI_INSTRUCTIONS_AVX2 = 903
    ! F, VL, DQ and BW
    integer(c_int32_t), parameter :: PERI_INSTRUCTIONS_AVX512 = 904

    ! t = 1/2 c w s, s = e/|xi|: PMB, generalised [P] A, [T] 1.23
    integer(c_int32_t), parameter :: PERI_LAW_BOND_BASED = 1001
    ! t = (w/m)(A theta |xi| + B e) [T] 1.54, 1.67, [C] 2-7
    integer(c_int32_t), parameter :: PERI_LAW_LPS = 1002
    ! t = 2 w (a d theta + b e), on each family [C] 8-17
    integer(c_int32_t), parameter :: PERI_LAW_OTERKUS = 1003
    ! T = w P K^-1 xi, stabilised [C] 18-21
    integer(c_int32_t), parameter :: PERI_LAW_CORRESPONDENCE = 1004

    ! s > s0 [T] 1.40, 1.41
    integer(c_int32_t), parameter :: PERI_CRITERION_STRETCH = 1101
    ! state-based: work on the bond > w0 [T] 1.100
    integer(c_int32_t), parameter :: PERI_CRITERION_BOND_ENERGY = 1102
    ! state-based: mean energy of both ends > w0 [T] 1.102
    integer(c_int32_t), parameter :: PERI_CRITERION_NODE_ENERGY = 1103
    ! tension along the bond > strength
    integer(c_int32_t), parameter :: PERI_CRITERION_PRINCIPAL_STRESS = 1104
    ! von Mises's > strength; shortened bonds, too
    integer(c_int32_t), parameter :: PERI_CRITERION_VON_MISES = 1105
    ! shear > cohesion - tan(friction_angle) normal
    integer(c_int32_t), parameter :: PERI_CRITERION_MOHR_COULOMB = 1106
    ! s > s0 - compression * least s at either end
    integer(c_int32_t), parameter :: PERI_CRITERION_CONFINED_STRETCH = 1107
    ! s > s0 (1 + (ds/dt / rate)^rate_power)
    integer(c_int32_t), parameter :: PERI_CRITERION_RATE_STRETCH = 1108
    ! s > s0 for `delay` in all
    integer(c_int32_t), parameter :: PERI_CRITERION_DELAYED_STRETCH = 1109

    ! straight
    integer(c_int32_t), parameter :: PERI_SOFTENING_BILINEAR = 2901
    ! kinked at 1/4 of the strength: concrete
    integer(c_int32_t), parameter :: PERI_SOFTENING_TRILINEAR = 2902
    ! cut off at 1/100 of the strength
    integer(c_int32_t), parameter :: PERI_SOFTENING_EXPONENTIAL = 2903
    ! a table of yours
    integer(c_int32_t), parameter :: PERI_SOFTENING_TABLE = 2904

    ! to the origin: damage
    integer(c_int32_t), parameter :: PERI_UNLOADING_SECANT = 3001
    ! as stiff as new: a stretch stays
    integer(c_int32_t), parameter :: PERI_UNLOADING_ELASTIC = 3002

    integer(c_int32_t), parameter :: PERI_REDUCTION_SUM = 3901
    integer(c_int32_t), parameter :: PERI_REDUCTION_MAX = 3902

    ! an initial crack: stays at peri_reset. Only before the first step
    integer(c_int32_t), parameter :: PERI_CUT_INITIAL = 2101
    ! counts as broken, whole again at peri_reset
    integer(c_int32_t), parameter :: PERI_CUT_NOW = 2102
    ! as PERI_CUT_NOW, where the body is now: by current positions
    integer(c_int32_t), parameter :: PERI_CUT_IN_PLACE = 2103

    integer(c_int32_t), parameter :: PERI_AXIS_X = 4097
    integer(c_int32_t), parameter :: PERI_AXIS_Y = 4098
    integer(c_int32_t), parameter :: PERI_AXIS_Z = 4100
    integer(c_int32_t), parameter :: PERI_AXIS_XY = 4099
    integer(c_int32_t), parameter :: PERI_AXIS_XYZ = 4103

    ! all behind the plane through 0 with `normal`
    integer(c_int32_t), parameter :: PERI_SHAPE_PLANE = 2601
    ! radius; 2D: a disc
    integer(c_int32_t), parameter :: PERI_SHAPE_BALL = 2602
    ! size, about 0
    integer(c_int32_t), parameter :: PERI_SHAPE_BOX = 2603
    ! within radius of a line of `length` along `axis`, about 0
    integer(c_int32_t), parameter :: PERI_SHAPE_CAPSULE = 2604
    ! 3D: the same with flat ends
    integer(c_int32_t), parameter :: PERI_SHAPE_CYLINDER = 2605
    ! within the closed surface of vertices and faces
    integer(c_int32_t), parameter :: PERI_SHAPE_MESH = 2606
    ! where `distance` is below 0
    integer(c_int32_t), parameter :: PERI_SHAPE_DISTANCE = 2607

    ! half kick, drift, force, half kick [T] 2.2
    integer(c_int32_t), parameter :: PERI_INTEGRATOR_VELOCITY_VERLET = 1201
    ! one kick per step, the same motion [L], [T] 2.10
    integer(c_int32_t), parameter :: PERI_INTEGRATOR_CENTRAL_DIFFERENCE = 1202

    ! conjugate gradients on the tangent, never stored
    integer(c_int32_t), parameter :: PERI_METHOD_NEWTON = 1301
    ! on the assembled tangent ([T] 3.2): for comparison
    integer(c_int32_t), parameter :: PERI_METHOD_BICGSTAB = 1302
    ! adaptive dynamic relaxation: slow, any tangent
    integer(c_int32_t), parameter :: PERI_METHOD_RELAXATION = 1303

    ! blocks, and elasticity on background grids
    integer(c_int32_t), parameter :: PERI_PRECONDITIONER_MULTILEVEL = 1401
    ! the dim x dim blocks of the diagonal
    integer(c_int32_t), parameter :: PERI_PRECONDITIONER_BLOCK_JACOBI = 1402
    integer(c_int32_t), parameter :: PERI_PRECONDITIONER_NONE = 1403

    ! PERI_ERROR_LOOSE, index: a point of it; see lost_parts
    integer(c_int32_t), parameter :: PERI_LOOSE_REFUSED = 1501
    ! just enough is held; exact where loads balance
    integer(c_int32_t), parameter :: PERI_LOOSE_PINNED = 1502
    ! the part of the loads that drives the mode is left out
    integer(c_int32_t), parameter :: PERI_LOOSE_BALANCED = 1503

    ! the load steps
    integer(c_int32_t), parameter :: PERI_CONTROL_LOAD = 2801
    ! where the next bond meets its criterion: through snap-back
    integer(c_int32_t), parameter :: PERI_CONTROL_FRACTURE = 2802

    ! load_to is reached
    integer(c_int32_t), parameter :: PERI_ENDED_LOAD = 2701
    ! a part that bears a load or a support broke off
    integer(c_int32_t), parameter :: PERI_ENDED_SEVERED = 2702
    integer(c_int32_t), parameter :: PERI_ENDED_BREAKS = 2703
    integer(c_int32_t), parameter :: PERI_ENDED_STOPPED = 2704

    ! S [dim] reference position [L]
    integer(c_int32_t), parameter :: PERI_FIELD_POSITION = 2001
    ! SW [dim] [L]
    integer(c_int32_t), parameter :: PERI_FIELD_DISPLACEMENT = 2002
    ! SW [dim] [L T^-1]
    integer(c_int32_t), parameter :: PERI_FIELD_VELOCITY = 2003
    ! S [dim] internal, loads, obstacles, contact
    integer(c_int32_t), parameter :: PERI_FIELD_FORCE_DENSITY = 2004
    ! S [L^3]; planes: area [L^2]
    integer(c_int32_t), parameter :: PERI_FIELD_VOLUME = 2005
    ! PERI_ID_INDEX of the material
    integer(c_int32_t), parameter :: PERI_FIELD_MATERIAL = 2006
    ! bonds of the point, broken ones included
    integer(c_int32_t), parameter :: PERI_FIELD_FAMILY_SIZE = 2007
    ! 1 - intact/all volume of the family [-] [L]
    integer(c_int32_t), parameter :: PERI_FIELD_DAMAGE = 2008
    ! the same among bonds that are not initial cracks
    integer(c_int32_t), parameter :: PERI_FIELD_DAMAGE_GROWN = 2009
    ! elastic W of the law [M L^-1 T^-2] [P] eq. 7
    integer(c_int32_t), parameter :: PERI_FIELD_ENERGY_DENSITY = 2010
    ! [dim] [L]
    integer(c_int32_t), parameter :: PERI_FIELD_CURRENT_POSITION = 2011
    ! theta of the law [-]
    integer(c_int32_t), parameter :: PERI_FIELD_DILATATION = 2012
    ! [tensor] of F: small, or Green-Lagrange [T] 4.14
    integer(c_int32_t), parameter :: PERI_FIELD_STRAIN = 2013
    ! [tensor] Cauchy, of the material [M L^-1 T^-2]
    integer(c_int32_t), parameter :: PERI_FIELD_STRESS = 2014
    ! [tensor] Cauchy, what the bonds carry [T] 4.10, 4.13
    integer(c_int32_t), parameter :: PERI_FIELD_FORCE_STRESS = 2015
    ! [dim] force density of supports, mean of the last step
    integer(c_int32_t), parameter :: PERI_FIELD_REACTION = 2016
    ! peri_find_fragments
    integer(c_int32_t), parameter :: PERI_FIELD_FRAGMENT = 2017
    ! [M]; planes: thickness included
    integer(c_int32_t), parameter :: PERI_FIELD_MASS = 2018
    ! W [M L^-3] Default: of the material
    integer(c_int32_t), parameter :: PERI_FIELD_DENSITY = 2019
    ! [dim] 1: a support prescribes it; else 0
    integer(c_int32_t), parameter :: PERI_FIELD_HELD = 2020
    ! W stretch at no force [-] -0.9..10. Default 0
    integer(c_int32_t), parameter :: PERI_FIELD_EIGENSTRAIN = 2021
    ! W times s0, squared times w0 [-] 1e-6..1e6. Default 1
    integer(c_int32_t), parameter :: PERI_FIELD_STRENGTH = 2022
    ! W times E [-] 1e-6..1e6. Default 1
    integer(c_int32_t), parameter :: PERI_FIELD_STIFFNESS = 2023
    ! [dim*dim] F by rows
    integer(c_int32_t), parameter :: PERI_FIELD_DEFORMATION_GRADIENT = 2024

    integer(c_int32_t), parameter :: PERI_TYPE_F64 = 1601
    integer(c_int32_t), parameter :: PERI_TYPE_F32 = 1602
    integer(c_int32_t), parameter :: PERI_TYPE_I32 = 1603

    ! i
    integer(c_int32_t), parameter :: PERI_BOND_POINT = 4001
    ! j
    integer(c_int32_t), parameter :: PERI_BOND_OTHER = 4002
    ! |xi| [L]
    integer(c_int32_t), parameter :: PERI_BOND_LENGTH = 4003
    ! beta V_j [L^3]
    integer(c_int32_t), parameter :: PERI_BOND_VOLUME = 4004
    ! w beta V_j, corrected
    integer(c_int32_t), parameter :: PERI_BOND_WEIGHT = 4005
    ! 1 or 0
    integer(c_int32_t), parameter :: PERI_BOND_INTACT = 4006
    ! [-]
    integer(c_int32_t), parameter :: PERI_BOND_STRETCH = 4007
    ! [dim] part of the force density of i
    integer(c_int32_t), parameter :: PERI_BOND_FORCE = 4008
    ! and of the energy density
    integer(c_int32_t), parameter :: PERI_BOND_ENERGY = 4009

    ! peri_add_box
    integer(c_int32_t), parameter :: PERI_SOURCE_BOX = 1701
    ! peri_add_perturbed_box
    integer(c_int32_t), parameter :: PERI_SOURCE_PERTURBED = 1702
    ! peri_add_points: a cloud, about one point to a cell
    integer(c_int32_t), parameter :: PERI_SOURCE_POINTS = 1703

    ! stiffness; the least thickness that carries
    integer(c_int32_t), parameter :: PERI_QUANTITY_DEFORMATION = 1801
    ! around holes and notches; the radius
    integer(c_int32_t), parameter :: PERI_QUANTITY_STRESS = 1802
    ! their way; the shortest wavelength
    integer(c_int32_t), parameter :: PERI_QUANTITY_WAVES = 1803
    ! when cracks grow; the crack's length, 8 spacings or more
    integer(c_int32_t), parameter :: PERI_QUANTITY_FRACTURE = 1804

    integer(c_int32_t), parameter :: PERI_PRESET_NONE = 1901
    ! 20 %
    integer(c_int32_t), parameter :: PERI_PRESET_GAME = 1902
    ! 10 %
    integer(c_int32_t), parameter :: PERI_PRESET_TEACHING = 1903
    ! 5 %
    integer(c_int32_t), parameter :: PERI_PRESET_ENGINEERING = 1904
    ! deformation 1 %, stress 2 %, waves and fracture 3 %
    integer(c_int32_t), parameter :: PERI_PRESET_REFERENCE = 1905

    type :: peri_body
        type(c_ptr) :: handle = c_null_ptr
    end type

    ! The same as a matrix by compressed rows, points*dim square ([T] 3.2, 3.3). It outlives the body; free it by
    ! peri_matrix_destroy.
    type :: peri_matrix
        type(c_ptr) :: handle = c_null_ptr
        integer(c_int32_t) :: dim = 0
    end type

    ! Cracks: midway through the broken bonds of adjacent points. They outlive the body; free them by peri_cracks_destroy.
    type :: peri_cracks
        type(c_ptr) :: handle = c_null_ptr
        integer(c_int32_t) :: dim = 0
    end type

    type, bind(c) :: peri_error
        ! peri_status
        integer(c_int32_t) :: code = 0
        ! 0
        integer(c_int32_t) :: reserved = 0
        ! first offending point, entry or id; else -1
        integer(c_int64_t) :: index = 0
        ! the offending value, or the limit that was passed; else 0
        real(c_double) :: value = 0
        ! constant text: the name in this header of what is at fault, or ""
        type(c_ptr) :: field = c_null_ptr
        ! constant text: peri_status_text(code)
        type(c_ptr) :: text = c_null_ptr
    end type

    ! Points whose stress is asked for; matrices by rows, out: to be written.
    type, bind(c) :: peri_stress_block
        integer(c_int64_t) :: count = 0
        ! [count]
        type(c_ptr) :: points = c_null_ptr
        ! [count][dim][dim] H = F - 1
        type(c_ptr) :: gradient = c_null_ptr
        ! [T] since the history was committed
        real(c_double) :: time_step = 0
        ! [count][history] as committed; out: as it becomes
        type(c_ptr) :: history = c_null_ptr
        ! [count][dim][dim] out: P, first Piola-Kirchhoff; linear: Cauchy
        type(c_ptr) :: stress = c_null_ptr
        ! [count][dim^2][dim^2] out: dP/dH, symmetric; NULL: not wanted
        type(c_ptr) :: tangent = c_null_ptr
        ! [count] out: stored [M L^-1 T^-2]. 0
        type(c_ptr) :: energy = c_null_ptr
        ! [count] out: lost in time_step, likewise. 0
        type(c_ptr) :: dissipation = c_null_ptr
    end type

    ! Bonds of one point to others[]: arrays of `count`. All that is written is 0 at first.
    type, bind(c) :: peri_bond_row
        integer(c_int32_t) :: point = 0
        integer(c_int32_t) :: count = 0
        type(c_ptr) :: others = c_null_ptr
        ! |xi| [L]
        type(c_ptr) :: length = c_null_ptr
        ! s = e/|xi| [-]; 0 of broken bonds
        type(c_ptr) :: stretch = c_null_ptr
        ! [count*states] in: as last kept; out: as it is with this stretch
        type(c_ptr) :: state = c_null_ptr
        ! out [-] f/c: the stretch at which a linear bond pulls as hard
        type(c_ptr) :: force = c_null_ptr
        ! out, its derivative; this and what follows NULL where not asked for
        type(c_ptr) :: tangent = c_null_ptr
        ! out: stored, of which `force` is the derivative at constant state
        type(c_ptr) :: energy = c_null_ptr
        ! out: lost since `state` was kept
        type(c_ptr) :: lost = c_null_ptr
        ! out: 1 breaks the bond for good
        type(c_ptr) :: broken = c_null_ptr
    end type

    type, bind(c) :: peri_body_desc
        ! set by init
        integer(c_int64_t) :: cookie = 0
        ! peri_space. Required
        integer(c_int32_t) :: space = 0
        ! Default PERI_PRECISION_DOUBLE
        integer(c_int32_t) :: precision = 0
        ! Default PERI_GEOMETRY_NONLINEAR
        integer(c_int32_t) :: geometry = 0
        ! Default PERI_INFLUENCE_CONSTANT
        integer(c_int32_t) :: influence = 0
        ! Default PERI_QUADRATURE_FULL
        integer(c_int32_t) :: quadrature = 0
        ! Default PERI_CORRECTION_NONE
        integer(c_int32_t) :: correction = 0
        ! Default PERI_BREAK_WITHIN_STEP
        integer(c_int32_t) :: break_timing = 0
        ! Default PERI_MOMENTS_LIVE
        integer(c_int32_t) :: moments = 0
        ! Default PERI_KERNEL_BEST
        integer(c_int32_t) :: kernel = 0
        ! Default PERI_INSTRUCTIONS_BEST
        integer(c_int32_t) :: instructions = 0
        ! 0 (default): as OpenMP says; 1: serial; n: n threads
        integer(c_int32_t) :: threads = 0
        ! 1 (default): account for work while running; 0: not
        integer(c_int32_t) :: ledger = 0
        ! 1..127, in its ids; 0 (default): from its address
        integer(c_int32_t) :: number = 0
        ! 0
        integer(c_int32_t) :: reserved = 0
        ! [L] > 0. Required. 3 to 4 spacings
        real(c_double) :: horizon = 0
        ! [L] > 0, of planes. Default 1
        real(c_double) :: thickness = 0
        ! c_funloc of a peri_influence_fn. for PERI_INFLUENCE_USER
        type(c_funptr) :: influence_fn = c_null_funptr
        type(c_ptr) :: influence_user = c_null_ptr
        ! Default NULL: malloc
        type(c_funptr) :: allocate = c_null_funptr
        ! Default NULL: free
        type(c_funptr) :: release = c_null_funptr
        type(c_ptr) :: memory_user = c_null_ptr
        ! Default NULL: OpenMP, or serial
        type(c_funptr) :: parallel_for = c_null_funptr
        type(c_ptr) :: parallel_user = c_null_ptr
        ! c_funloc of a peri_log_fn. Default NULL: silent
        type(c_funptr) :: log = c_null_funptr
        type(c_ptr) :: log_user = c_null_ptr
    end type

    type, bind(c) :: peri_material_desc
        ! set by init
        integer(c_int64_t) :: cookie = 0
        ! peri_law
        integer(c_int32_t) :: law = 0
        ! Default PERI_CRITERION_STRETCH
        integer(c_int32_t) :: criterion = 0
        ! E [M L^-1 T^-2] > 0. Give E or K, not both; 0 = not given
        real(c_double) :: young = 0
        ! K = E/(3(1-2 nu)) [M L^-1 T^-2] > 0
        real(c_double) :: bulk = 0
        ! [-] in (-1, 1/2); NaN (default): bond-based, that of the space
        real(c_double) :: poisson = 0
        ! [M L^-3] > 0. Required
        real(c_double) :: density = 0
        ! G0 [M T^-2] > 0, per area of crack. 0 (default) = not given
        real(c_double) :: fracture_energy = 0
        ! s0 [-] > 0. 0 (default) = from G0; with neither, no bond breaks
        real(c_double) :: critical_stretch = 0
        ! [-] >= 0, correspondence: against zero-energy modes. Default 0.2
        real(c_double) :: stabilization = 0
        ! [M L^-1 T^-2] > 0 of the criteria of stress; Mohr-Coulomb: or 0
        real(c_double) :: strength = 0
        ! [M L^-1 T^-2] > 0 of Mohr-Coulomb
        real(c_double) :: cohesion = 0
        ! [-] [0, pi/2) likewise
        real(c_double) :: friction_angle = 0
        ! alpha [-] 0..1e3, of the confined stretch. 0 (default): none
        real(c_double) :: compression = 0
        ! [T^-1] > 0 of the rate stretch, and
        real(c_double) :: rate = 0
        ! [-] 0..10. 0 (default): 1
        real(c_double) :: rate_power = 0
        ! [T] > 0 of the delayed stretch
        real(c_double) :: delay = 0
        ! LPS: [M L^-1 T^-2] in shear, at which it flows. Default 0: never
        real(c_double) :: yield_shear = 0
        ! LPS, viscous: 0..PERI_RELAXATIONS. Default 0
        integer(c_int32_t) :: relaxations = 0
        ! numbers per point for `stress`, 0..PERI_HISTORY. Default 0
        integer(c_int32_t) :: history = 0
        ! (0, 1] of the stiffness in shear, and
        real(c_double) :: relaxation_part(4) = 0
        ! [T] > 0 in which it relaxes
        real(c_double) :: relaxation_time(4) = 0
        ! c_funloc of a peri_stress_fn. correspondence: yours. Default NULL
        type(c_funptr) :: stress = c_null_funptr
        type(c_ptr) :: stress_user = c_null_ptr
    end type

    type, bind(c) :: peri_softening_desc
        ! set by init
        integer(c_int64_t) :: cookie = 0
        ! peri_softening, set by init
        integer(c_int32_t) :: shape = 0
        ! Default PERI_UNLOADING_SECANT
        integer(c_int32_t) :: unloading = 0
        ! [M L^-1 T^-2] > 0, of uniaxial tension. Required
        real(c_double) :: strength = 0
        ! [M T^-2] > 0, the area under the curve. Required
        real(c_double) :: fracture_energy = 0
        ! (0, 1] stiffness when shorter, over that when longer. Default 1
        real(c_double) :: compression = 0
        ! 2..30 rows of
        integer(c_int64_t) :: count = 0
        ! [count*2] stretch past the strength, of any scale, from 0 ascending; force over the strength, from 1 to 0, descending
        type(c_ptr) :: table = c_null_ptr
    end type

    ! Cells: polygons, convex or not; tetrahedra, pyramids, wedges, hexahedra (4, 5, 6, 8 corners) in VTK's order, or mirrored.
    type, bind(c) :: peri_cells_desc
        ! set by init
        integer(c_int64_t) :: cookie = 0
        integer(c_int64_t) :: vertex_count = 0
        ! [vertex_count*vertex_stride] [L]
        type(c_ptr) :: vertices = c_null_ptr
        ! Default 0: dim
        integer(c_int64_t) :: vertex_stride = 0
        integer(c_int64_t) :: cell_count = 0
        ! of cell 0, 1, ...
        type(c_ptr) :: corners = c_null_ptr
        ! [cell_count+1] in corners[]. Default NULL: cell_corners each
        type(c_ptr) :: offsets = c_null_ptr
        integer(c_int32_t) :: cell_corners = 0
        ! 0
        integer(c_int32_t) :: reserved = 0
        ! [cell_count]. Default NULL
        type(c_ptr) :: materials = c_null_ptr
    end type

    ! Ghosts: copies of points that other parts own, peri_ghost_depth horizons deep. They bear no load and are in no set, sum
    ! or count. Give them all else that their owners have: cuts, motion.
    type, bind(c) :: peri_part_desc
        ! set by init
        integer(c_int64_t) :: cookie = 0
        ! [L] any; this and the next two alike on all parts. Required
        real(c_double) :: origin(3) = 0
        ! [L] > 0: the spacing; that of boxes to a factor of 16
        real(c_double) :: length = 0
        ! [L^3] > 0, planes [L^2], of a point
        real(c_double) :: mean_volume = 0
        ! Default 0
        integer(c_int64_t) :: ghost_count = 0
        ! [ghost_count] points, ascending
        type(c_ptr) :: ghosts = c_null_ptr
        ! [ghost_count] the point that it is an image of in a periodic body, or -1. Default NULL: none is
        type(c_ptr) :: owners = c_null_ptr
        ! [points] in the whole body, ascending. Default NULL: unknown
        type(c_ptr) :: ids = c_null_ptr
        ! c_funloc of a peri_exchange_fn. where another part owns ghosts. Default NULL
        type(c_funptr) :: exchange = c_null_funptr
        ! c_funloc of a peri_reduce_fn. of several parts. Default NULL
        type(c_funptr) :: reduce = c_null_funptr
        type(c_ptr) :: user = c_null_ptr
    end type

    ! A rigid body of point masses; in 2D vectors end with 0.
    type, bind(c) :: peri_fragment
        ! its least point
        integer(c_int32_t) :: first = 0
        ! how many
        integer(c_int32_t) :: points = 0
        ! the fragment that it broke off, or -1
        integer(c_int32_t) :: parent = 0
        ! 1: a support holds a point of it
        integer(c_int32_t) :: held = 0
        ! [M]
        real(c_double) :: mass = 0
        ! [L] of mass, now
        real(c_double) :: centre(3) = 0
        ! [L T^-1] of the centre
        real(c_double) :: velocity(3) = 0
        ! [M L^2 T^-1] momentum about the centre
        real(c_double) :: angular(3) = 0
        ! [M L^2] about the centre: xx yy zz xy yz xz
        real(c_double) :: inertia(6) = 0
        ! [L] box around its points, now
        real(c_double) :: lo(3) = 0
        real(c_double) :: hi(3) = 0
    end type

    ! Pushes points within it out along the normal by stiffness*depth [M L^-2 T^-2]. A free one (of a mass) is moved by that
    ! and by gravity, not by other obstacles.
    type, bind(c) :: peri_obstacle_desc
        ! set by init
        integer(c_int64_t) :: cookie = 0
        ! peri_shape, set by init
        integer(c_int32_t) :: shape = 0
        ! 0
        integer(c_int32_t) :: reserved = 0
        ! of the frame, and
        real(c_double) :: place(3) = 0
        ! see peri_motion_fn. Default 0: the frame of the body
        real(c_double) :: turn(4) = 0
        ! of a plane,
        real(c_double) :: normal(3) = 0
        ! of capsule and cylinder, of any length
        real(c_double) :: axis(3) = 0
        ! [L] > 0; PERI_SHAPE_DISTANCE: all lies within it, 0: unknown
        real(c_double) :: radius = 0
        ! [L] > 0
        real(c_double) :: length = 0
        ! [L] > 0
        real(c_double) :: size(3) = 0
        integer(c_int64_t) :: vertex_count = 0
        integer(c_int64_t) :: face_count = 0
        ! [vertex_count*dim] [L]; 2D: of a polygon, counter-clockwise
        type(c_ptr) :: vertices = c_null_ptr
        ! 3D: [face_count*3], counter-clockwise from outside
        type(c_ptr) :: faces = c_null_ptr
        ! c_funloc of a peri_distance_fn.
        type(c_funptr) :: distance = c_null_funptr
        ! [M L^-3 T^-2]. 0 (default): young/spacing^2
        real(c_double) :: stiffness = 0
        ! mu [-] >= 0, Coulomb. Default 0
        real(c_double) :: friction = 0
        ! [L T^-1] >= 0: slower slip is resisted less. 0 (default): 1e-6 sqrt(young/density)
        real(c_double) :: friction_speed = 0
        ! (0, 1], of what is stiff beside the obstacle. Default 1
        real(c_double) :: restitution = 0
        ! [M] > 0: a free rigid body. Default 0; or
        real(c_double) :: mass = 0
        ! [M L^-3] > 0: likewise. Default 0
        real(c_double) :: density = 0
        ! [M L^2] about the axes of the frame, 2D: inertia[0]; HUGE_VAL: never turns. 0 (default): of the shape, uniform
        real(c_double) :: inertia(3) = 0
        ! [L T^-1] of a free one at the start
        real(c_double) :: velocity(3) = 0
        ! [T^-1] likewise; 2D: spin[0]
        real(c_double) :: spin(3) = 0
        ! [L T^-2] of a free one
        real(c_double) :: gravity(3) = 0
        ! c_funloc of a peri_motion_fn. of others. Default NULL: at rest
        type(c_funptr) :: motion = c_null_funptr
        ! of distance and motion
        type(c_ptr) :: user = c_null_ptr
    end type

    ! of its frame; components beyond dim are 0
    type, bind(c) :: peri_obstacle_state
        real(c_double) :: place(3) = 0
        real(c_double) :: turn(4) = 0
        ! mean of the last step; of a free one now; and
        real(c_double) :: velocity(3) = 0
        ! [T^-1] likewise; 2D: spin[0]
        real(c_double) :: spin(3) = 0
        ! [M] of a free one, else 0
        real(c_double) :: mass = 0
        ! [M L^2 T^-2] likewise
        real(c_double) :: kinetic = 0
        ! [M L^2 T^-2] in its springs
        real(c_double) :: stored = 0
        ! to friction and restitution since build or reset
        real(c_double) :: lost = 0
    end type

    ! Unbonded surface points: 1/2 k (d - r)^2 where r < d = min(distance, |xi|), k = stiffness E V /(spacing distance)
    type, bind(c) :: peri_contact_desc
        ! set by init
        integer(c_int64_t) :: cookie = 0
        ! (0, 1e3] of a cell's own [-]. Default 0.25
        real(c_double) :: stiffness = 0
        ! [L] Default 0: the spacing
        real(c_double) :: distance = 0
        ! mu [-] 0..1e3. Default 0
        real(c_double) :: friction = 0
        ! [L T^-1] below it: viscous. Default 0
        real(c_double) :: friction_speed = 0
        ! (0, 1] of light pieces. Default 1
        real(c_double) :: restitution = 0
    end type

    type, bind(c) :: peri_advance_desc
        ! set by init
        integer(c_int64_t) :: cookie = 0
        ! Default PERI_INTEGRATOR_VELOCITY_VERLET
        integer(c_int32_t) :: integrator = 0
        ! 1: time_step may exceed peri_stable_step. Default 0
        integer(c_int32_t) :: force_step = 0
        ! run this many steps; or
        integer(c_int64_t) :: steps = 0
        ! [T] run this long, to the last bit. One of the two is required
        real(c_double) :: duration = 0
        ! [T] > 0; 0 (default): safety * peri_stable_step
        real(c_double) :: time_step = 0
        ! (0, 1]. Default 0.9
        real(c_double) :: safety = 0
        ! a [T^-1] >= 0: force -a*density*velocity. Default 0
        real(c_double) :: damping = 0
        ! NaN (default): peri_load_factor, or 1 where none has acted
        real(c_double) :: load_factor = 0
        ! steps between calls of on_frame; 0 (default): only at the end
        integer(c_int64_t) :: frame_steps = 0
        ! c_funloc of a peri_frame_fn. Default NULL
        type(c_funptr) :: on_frame = c_null_funptr
        type(c_ptr) :: user = c_null_ptr
    end type

    type, bind(c) :: peri_evaluate_desc
        ! set by init
        integer(c_int64_t) :: cookie = 0
        ! of all arrays: PERI_TYPE_F64 (default) or PERI_TYPE_F32
        integer(c_int32_t) :: type = 0
        ! 1: forces [M L T^-2]; 0 (default): per volume [M L^-2 T^-2]
        integer(c_int32_t) :: nodal = 0
        ! 1 (default): theirs; 0: not
        integer(c_int32_t) :: bonds = 0
        ! 1 (default): of loads (moving: obstacles, contact); 0: not
        integer(c_int32_t) :: external = 0
        ! 1: the body moves there, and bonds break. Default 0: it stays
        integer(c_int32_t) :: fracture = 0
        ! 1: report.energy, for one more pass. Default 0
        integer(c_int32_t) :: energy = 0
        ! in elements. Default 0: dim
        integer(c_int64_t) :: point_stride = 0
        ! Default 0: 1
        integer(c_int64_t) :: component_stride = 0
        ! [L]. Default NULL: where the body is
        type(c_ptr) :: displacement = c_null_ptr
        ! [L T^-1], with fracture. Default NULL: that of the body
        type(c_ptr) :: velocity = c_null_ptr
        ! [T], with fracture: how long `velocity` took it there. Default 0
        real(c_double) :: time_step = 0
        ! of loads. NaN (default): peri_time
        real(c_double) :: time = 0
        ! Default NaN: the body's
        real(c_double) :: load_factor = 0
        ! out, supports aside. Default NULL
        type(c_ptr) :: force = c_null_ptr
        ! out, with time_step: force times [T] of bonds that broke
        type(c_ptr) :: impulse = c_null_ptr
    end type

    type, bind(c) :: peri_evaluate_report
        ! bonds, by this call
        integer(c_int64_t) :: broken = 0
        ! elastic [M L^2 T^-2], of the bonds that are left
        real(c_double) :: energy = 0
    end type

    type, bind(c) :: peri_solve_desc
        ! set by init
        integer(c_int64_t) :: cookie = 0
        ! Default PERI_METHOD_NEWTON
        integer(c_int32_t) :: method = 0
        ! of Newton. Default PERI_PRECONDITIONER_MULTILEVEL
        integer(c_int32_t) :: preconditioner = 0
        ! Default PERI_LOOSE_REFUSED
        integer(c_int32_t) :: loose = 0
        ! 1 (default): bonds break by their criterion; 0: none
        integer(c_int32_t) :: fracture = 0
        ! Default PERI_CONTROL_LOAD
        integer(c_int32_t) :: control = 0
        ! load or support whose curve is recorded. Default 0: none
        integer(c_int32_t) :: curve_load = 0
        ! 1: what this solve prepares serves the next, until bonds or supports change. Default 0: that is freed
        integer(c_int32_t) :: keep = 0
        ! 0
        integer(c_int32_t) :: reserved = 0
        ! [0, 1]: break those over this part of the largest excess. Default 0.98; 1: one by one
        real(c_double) :: criticality = 0
        ! [0, 1): |residual| over |loads| or |reactions|. 0 (default): 1e-8, mixed 1e-5, single 1e-4
        real(c_double) :: tolerance = 0
        ! > 0, of Newton: this fall of the residual's energy is enough, too. Default 0: never
        real(c_double) :: energy_tolerance = 0
        ! most for one equilibrium, linear. Default 20000
        integer(c_int64_t) :: iterations = 0
        ! most Newton iterations for one equilibrium. Default 60
        integer(c_int64_t) :: newton = 0
        ! most rounds of breaking at one factor, or of fracture control. Default 100000
        integer(c_int64_t) :: breaks = 0
        ! factor to begin at. NaN (default): peri_load_factor
        real(c_double) :: load_from = 0
        ! factor at the end. Default 1
        real(c_double) :: load_to = 0
        ! load steps >= 1. Default 1
        integer(c_int64_t) :: steps = 0
        ! [T] >= 0 of all steps: what flows, does. Default 0
        real(c_double) :: duration = 0
        ! most halvings of a failing step, 0..60. Default 8
        integer(c_int64_t) :: halvings = 0
        ! [curve_rows][2 + 2*dim]: load factor, mean displacement [L], peri_get_reaction, broken bonds
        type(c_ptr) :: curve = c_null_ptr
        ! rows that fit; more are counted in the report
        integer(c_int64_t) :: curve_rows = 0
        ! c_funloc of a peri_iteration_fn. Default NULL
        type(c_funptr) :: on_iteration = c_null_funptr
        ! c_funloc of a peri_frame_fn. at each equilibrium, also after it cut. Default NULL
        type(c_funptr) :: on_step = c_null_funptr
        ! for both
        type(c_ptr) :: user = c_null_ptr
    end type

    type, bind(c) :: peri_solve_report
        ! of the linear solver, or relaxation steps, in all
        integer(c_int64_t) :: iterations = 0
        ! evaluations of all bonds: forces and products with the tangent
        integer(c_int64_t) :: passes = 0
        ! Newton iterations in all
        integer(c_int64_t) :: newton = 0
        ! load steps done
        integer(c_int64_t) :: steps = 0
        ! bonds broken
        integer(c_int64_t) :: broken = 0
        ! rows of the curve, written or not
        integer(c_int64_t) :: curve_rows = 0
        ! rigid-body modes pinned or balanced in the last equilibrium
        integer(c_int64_t) :: loose = 0
        ! broke off, bear nothing and are left where they are
        integer(c_int64_t) :: lost_parts = 0
        integer(c_int64_t) :: lost_points = 0
        ! most memory of the solver at a time, beside the body
        integer(c_int64_t) :: bytes = 0
        ! peri_ended; 0 where the solve failed
        integer(c_int32_t) :: ended = 0
        ! 0
        integer(c_int32_t) :: reserved = 0
        ! of the last equilibrium, over its scale; 0 where nothing acts
        real(c_double) :: residual = 0
        ! of the last equilibrium
        real(c_double) :: load_factor = 0
    end type

    ! A field in place: component k of point i, in your units, is offset[k] + scale * data[i*point_stride +
    ! k*component_stride].
    type, bind(c) :: peri_view
        ! of the body
        type(c_ptr) :: data = c_null_ptr
        ! points
        integer(c_int64_t) :: count = 0
        ! in elements
        integer(c_int64_t) :: point_stride = 0
        ! in elements
        integer(c_int64_t) :: component_stride = 0
        ! 1, dim, 3 or 6 of a tensor, or dim*dim
        integer(c_int32_t) :: components = 0
        ! peri_type
        integer(c_int32_t) :: type = 0
        real(c_double) :: scale = 0
        real(c_double) :: offset(3) = 0
    end type

    ! The ledger [M L^2 T^-2], from build or reset on: initial + external + obstacle = kinetic + elastic + contact + damping +
    ! fracture + error.
    type, bind(c) :: peri_energy
        real(c_double) :: kinetic = 0
        ! stored in intact bonds
        real(c_double) :: elastic = 0
        ! stored in contact
        real(c_double) :: contact = 0
        ! work of loads and supports; in peri_solve of obstacles, too
        real(c_double) :: external = 0
        ! work of obstacles
        real(c_double) :: obstacle = 0
        ! by damping and contact; in peri_solve what springs free as bonds break
        real(c_double) :: damping = 0
        ! elastic energy that went with bonds as they broke, less what contact got
        real(c_double) :: fracture = 0
        ! put in by setting motion, less what later cuts took out
        real(c_double) :: initial = 0
        ! what time steps, or load steps, left open
        real(c_double) :: error = 0
    end type

    type, bind(c) :: peri_cracks_desc
        ! set by init
        integer(c_int64_t) :: cookie = 0
        ! 1 (default): initial cracks, too
        integer(c_int32_t) :: initial = 0
        ! 1: where the body is now. Default 0: reference positions
        integer(c_int32_t) :: current = 0
        ! [L] >= 0, 2D: leaves out shorter cracks and branches with a tip. NaN (default): the horizon
        real(c_double) :: shortest = 0
    end type

    ! 2D: where a path ends within the body
    type, bind(c) :: peri_crack_tip
        ! [L]
        real(c_double) :: place(3) = 0
        ! of length 1
        real(c_double) :: direction(3) = 0
        ! [L T^-1] NaN: not recorded
        real(c_double) :: speed = 0
        ! 0, 1, ...
        integer(c_int64_t) :: path = 0
    end type

    ! Bytes that the body holds, as asked of its allocator. Solves and builds take more.
    type, bind(c) :: peri_memory
        ! positions, volumes, materials, sizes of families
        integer(c_int64_t) :: points = 0
        ! who is bonded to whom, and what each bond weighs
        integer(c_int64_t) :: families = 0
        ! flags of bonds, no-fail zones, events, what the criteria keep
        integer(c_int64_t) :: damage = 0
        ! displacements, velocities, forces, and scratch of passes
        integer(c_int64_t) :: state = 0
        ! materials, constants, and the body itself
        integer(c_int64_t) :: laws = 0
        ! sets, supports, loads, obstacles, contact
        integer(c_int64_t) :: loads = 0
        ! derived fields that were viewed; fragments
        integer(c_int64_t) :: fields = 0
        ! of all these
        integer(c_int64_t) :: total = 0
        ! of the total: what clones share
        integer(c_int64_t) :: shared = 0
    end type

    ! a body that is only described: one material in a box
    type, bind(c) :: peri_plan_desc
        ! set by init
        integer(c_int64_t) :: cookie = 0
        ! Required
        type(c_ptr) :: body = c_null_ptr
        ! Required
        type(c_ptr) :: material = c_null_ptr
        ! Default PERI_SOURCE_BOX
        integer(c_int32_t) :: source = 0
        ! 1: time a small body, 20..100 ms. Default 0: no clock
        integer(c_int32_t) :: measure = 0
        ! [0, 1], of PERI_SOURCE_PERTURBED. Default 1
        real(c_double) :: amount = 0
        ! [L] corners. Required
        real(c_double) :: lo(3) = 0
        real(c_double) :: hi(3) = 0
        ! [L] > 0. Required
        real(c_double) :: spacing = 0
    end type

    type, bind(c) :: peri_plan_report
        ! peri_point_count
        integer(c_int64_t) :: points = 0
        ! peri_entry_count: exact of a box, else to 5 %
        integer(c_int64_t) :: entries = 0
        ! peri_family_width: exact of a box, else an estimate
        integer(c_int64_t) :: width = 0
        ! families by columns: how many; 0: a list
        integer(c_int64_t) :: columns = 0
        ! peri_memory.total after peri_build: exact of a box, else to 5 %
        integer(c_int64_t) :: bytes = 0
        ! most at a time in peri_build, to 5 % or half a megabyte
        integer(c_int64_t) :: peak = 0
        ! [T] peri_stable_step, of a box to 6 %
        real(c_double) :: stable_step = 0
        ! [s] of one thread per step; 0 where not measured
        real(c_double) :: seconds = 0
    end type

    ! a preset, or an error, at least cost; or a budget; or both
    type, bind(c) :: peri_choose_desc
        ! set by init
        integer(c_int64_t) :: cookie = 0
        ! Default PERI_PRESET_NONE
        integer(c_int32_t) :: preset = 0
        ! peri_quantity. Required
        integer(c_int32_t) :: quantity = 0
        ! (0, 1) relative error to reach. Default 0: not given
        real(c_double) :: error = 0
        ! [s] of one thread per step. Default 0: any. Takes about a second
        real(c_double) :: seconds = 0
        ! most until peri_build has returned. Default 0: any
        integer(c_int64_t) :: bytes = 0
        ! [L] > 0. Required
        real(c_double) :: feature = 0
        ! [L] corners of the scene. Required
        real(c_double) :: lo(3) = 0
        real(c_double) :: hi(3) = 0
    end type

    type, bind(c) :: peri_choose_report
        ! [L] for peri_add_box
        real(c_double) :: spacing = 0
        ! spacings across the feature
        real(c_double) :: across = 0
        ! of the quantity, not above this
        real(c_double) :: error = 0
        ! constant text: the choice in words
        type(c_ptr) :: text = c_null_ptr
        ! as peri_plan says
        type(peri_plan_report) :: cost
    end type

    abstract interface

        ! Remarks that are no errors. level: 0 information, 1 warning.
        subroutine peri_log_fn(user, level, text) bind(c)
            import
            type(c_ptr), value :: user
            integer(c_int32_t), value :: level
            type(c_ptr), value :: text
        end subroutine

        ! Influence function: *w = w(q) [-], q = |xi|/horizon > 0, with partial volumes also a little beyond 1; 0, or 1e-100 <
        ! |w| < 1e100.
        function peri_influence_fn(user, q, w) bind(c) result(result_)
            import
            type(c_ptr), value :: user
            real(c_double), value :: q
            real(c_double), intent(inout) :: w
            integer(c_int32_t) :: result_
        end function

        ! > 0 takes the point or site at x[dim]; index numbers the candidates.
        function peri_point_fn(user, index, x) bind(c) result(result_)
            import
            type(c_ptr), value :: user
            integer(c_int64_t), value :: index
            real(c_double), intent(in) :: x(*)
            integer(c_int32_t) :: result_
        end function

        ! > 0 cuts the bond between points i < j at xi[dim] and xj[dim].
        function peri_pair_fn(user, i, j, xi, xj) bind(c) result(result_)
            import
            type(c_ptr), value :: user
            integer(c_int32_t), value :: i
            integer(c_int32_t), value :: j
            real(c_double), intent(in) :: xi(*)
            real(c_double), intent(in) :: xj(*)
            integer(c_int32_t) :: result_
        end function

        ! Values of a load or support at `time` on points[count]: value[count*dim] holds the constant value; overwrite what
        ! varies. Once per step, for its end; in peri_solve time is the load factor. > 0 stops the run after the step;
        ! peri_solve as peri_iteration_fn does.
        function peri_load_fn(user, time, count, points, value) bind(c) result(result_)
            import
            type(c_ptr), value :: user
            real(c_double), value :: time
            integer(c_int64_t), value :: count
            integer(c_int32_t), intent(in) :: points(count)
            real(c_double), intent(inout) :: value(*)
            integer(c_int32_t) :: result_
        end function

        ! Writes where the frame of an obstacle is at `time`: place[dim] [L], and its turn, in 2D an angle turn[1], in 3D a
        ! quaternion turn[4] (w x y z). They hold those of the start. > 0: likewise.
        function peri_motion_fn(user, time, place, turn) bind(c) result(result_)
            import
            type(c_ptr), value :: user
            real(c_double), value :: time
            real(c_double), intent(inout) :: place(*)
            real(c_double), intent(inout) :: turn(*)
            integer(c_int32_t) :: result_
        end function

        ! A shape: *distance [L] of x[dim] from its surface, < 0 inside, and there the outward normal[dim], of any length; in
        ! the frame of the obstacle
        function peri_distance_fn(user, x, distance, normal) bind(c) result(result_)
            import
            type(c_ptr), value :: user
            real(c_double), intent(in) :: x(*)
            real(c_double), intent(inout) :: distance
            real(c_double), intent(inout) :: normal(*)
            integer(c_int32_t) :: result_
        end function

        ! Comes on the threads of the body, for several blocks at once; no jump may leave it.
        function peri_stress_fn(user, block) bind(c) result(result_)
            import
            type(c_ptr), value :: user
            type(peri_stress_block), intent(in) :: block
            integer(c_int32_t) :: result_
        end function

        ! Writes the motion of a rigid support at `time`. > 0: likewise.
        function peri_rigid_fn(user, time, motion) bind(c) result(result_)
            import
            type(c_ptr), value :: user
            real(c_double), value :: time
            real(c_double), intent(inout) :: motion(*)
            integer(c_int32_t) :: result_
        end function

        ! A bond i < j broke by its criterion at `time` [T] and this stretch [-]. Called after the step, in ascending (i, j). >
        ! 0 ends the run with PERI_STOPPED.
        function peri_break_fn(user, i, j, time, stretch) bind(c) result(result_)
            import
            type(c_ptr), value :: user
            integer(c_int32_t), value :: i
            integer(c_int32_t), value :: j
            real(c_double), value :: time
            real(c_double), value :: stretch
            integer(c_int32_t) :: result_
        end function

        ! A law, or a criterion, of bonds. A function of what it gets alone: it comes for each bond from both ends, as often as
        ! wanted, on any thread, and may not call the library.
        function peri_bond_law_fn(user, row) bind(c) result(result_)
            import
            type(c_ptr), value :: user
            type(peri_bond_row), intent(in) :: row
            integer(c_int32_t) :: result_
        end function

        ! Takes the next `count` bytes of a file; all but 0 is a failure: PERI_ERROR_WRITE.
        function peri_write_fn(user, bytes, count) bind(c) result(result_)
            import
            type(c_ptr), value :: user
            type(c_ptr), value :: bytes
            integer(c_int64_t), value :: count
            integer(c_int32_t) :: result_
        end function

        ! Writes the next `count` bytes to `bytes`; all but 0 is a failure, as where fewer are left.
        function peri_read_fn(user, bytes, count) bind(c) result(result_)
            import
            type(c_ptr), value :: user
            type(c_ptr), value :: bytes
            integer(c_int64_t), value :: count
            integer(c_int32_t) :: result_
        end function

        ! plane[k][i], of type PERI_TYPE_F64 or _F32, is of point i: send those of your points to where they are ghosts, and
        ! write those of ghosts. Once per step; `planes` is alike on all parts.
        function peri_exchange_fn(user, type, planes, plane) bind(c) result(result_)
            import
            type(c_ptr), value :: user
            integer(c_int32_t), value :: type
            integer(c_int32_t), value :: planes
            type(c_ptr), value :: plane
            integer(c_int32_t) :: result_
        end function

        ! values[count] become their sums or maxima. Once per step, and in most calls.
        function peri_reduce_fn(user, reduction, count, values) bind(c) result(result_)
            import
            type(c_ptr), value :: user
            integer(c_int32_t), value :: reduction
            integer(c_int64_t), value :: count
            real(c_double), intent(inout) :: values(count)
            integer(c_int32_t) :: result_
        end function

        ! Every frame_steps steps and at the end of a run; at each equilibrium of peri_solve. > 0 stops. It may also cut,
        ! select, set no-fail zones and contact, add or remove loads and obstacles.
        function peri_frame_fn(user, body) bind(c) result(result_)
            import
            type(c_ptr), value :: user
            type(c_ptr), value :: body
            integer(c_int32_t) :: result_
        end function

        ! After each iteration of the linear solver, with the residual over its scale. > 0 stops there, short of the
        ! equilibrium.
        function peri_iteration_fn(user, iteration, residual) bind(c) result(result_)
            import
            type(c_ptr), value :: user
            integer(c_int64_t), value :: iteration
            real(c_double), value :: residual
            integer(c_int32_t) :: result_
        end function
    end interface

    interface
        function c_version() bind(c, name='peri_version')
            import
            integer(c_int32_t) :: c_version
        end function
        function c_status_text(status) bind(c, name='peri_status_text')
            import
            integer(c_int32_t), value :: status
            type(c_ptr) :: c_status_text
        end function
        function c_format_error(error, buffer, capacity) bind(c, name='peri_format_error')
            import
            type(peri_error), intent(in) :: error
            type(c_ptr), value :: buffer
            integer(c_int64_t), value :: capacity
            integer(c_int64_t) :: c_format_error
        end function
        subroutine c_body_desc_init(desc) bind(c, name='peri_body_desc_init')
            import
            type(peri_body_desc), intent(inout) :: desc
        end subroutine
        function c_body_create(desc, body, error) bind(c, name='peri_body_create')
            import
            type(peri_body_desc), intent(in) :: desc
            type(c_ptr), intent(out) :: body
            type(c_ptr), value :: error
            integer(c_int32_t) :: c_body_create
        end function
        function c_body_clone(body, copy, error) bind(c, name='peri_body_clone')
            import
            type(c_ptr), value :: body
            type(c_ptr), intent(out) :: copy
            type(c_ptr), value :: error
            integer(c_int32_t) :: c_body_clone
        end function
        subroutine c_body_destroy(body) bind(c, name='peri_body_destroy')
            import
            type(c_ptr), value :: body
        end subroutine
        function c_unlock(body) bind(c, name='peri_unlock')
            import
            type(c_ptr), value :: body
            integer(c_int32_t) :: c_unlock
        end function
        function c_get_error(body, error) bind(c, name='peri_get_error')
            import
            type(c_ptr), value :: body
            type(peri_error), intent(inout) :: error
            integer(c_int32_t) :: c_get_error
        end function
        function c_id(body, kind, index) bind(c, name='peri_id')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: kind
            integer(c_int64_t), value :: index
            integer(c_int32_t) :: c_id
        end function
        subroutine c_material_desc_init(desc, law) bind(c, name='peri_material_desc_init')
            import
            type(peri_material_desc), intent(inout) :: desc
            integer(c_int32_t), value :: law
        end subroutine
        function c_add_material(body, desc) bind(c, name='peri_add_material')
            import
            type(c_ptr), value :: body
            type(peri_material_desc), intent(in) :: desc
            integer(c_int32_t) :: c_add_material
        end function
        function c_set_interface(body, i, j, desc) bind(c, name='peri_set_interface')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: i
            integer(c_int32_t), value :: j
            type(peri_material_desc), intent(in) :: desc
            integer(c_int32_t) :: c_set_interface
        end function
        subroutine c_softening_desc_init(desc, shape) bind(c, name='peri_softening_desc_init')
            import
            type(peri_softening_desc), intent(inout) :: desc
            integer(c_int32_t), value :: shape
        end subroutine
        function c_set_softening(body, i, j, desc) bind(c, name='peri_set_softening')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: i
            integer(c_int32_t), value :: j
            type(peri_softening_desc), intent(in) :: desc
            integer(c_int32_t) :: c_set_softening
        end function
        function c_get_softening(body, i, j, first, last) bind(c, name='peri_get_softening')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: i
            integer(c_int32_t), value :: j
            type(c_ptr), value :: first
            type(c_ptr), value :: last
            integer(c_int32_t) :: c_get_softening
        end function
        function c_set_bond_law(body, i, j, states, fn, user) bind(c, name='peri_set_bond_law')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: i
            integer(c_int32_t), value :: j
            integer(c_int32_t), value :: states
            type(c_funptr), value :: fn
            type(c_ptr), value :: user
            integer(c_int32_t) :: c_set_bond_law
        end function
        function c_get_bond_constants(body, i, j, c, s0) bind(c, name='peri_get_bond_constants')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: i
            integer(c_int32_t), value :: j
            type(c_ptr), value :: c
            type(c_ptr), value :: s0
            integer(c_int32_t) :: c_get_bond_constants
        end function
        function c_get_critical_energy(body, material, w0) bind(c, name='peri_get_critical_energy')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: material
            type(c_ptr), value :: w0
            integer(c_int32_t) :: c_get_critical_energy
        end function
        function c_add_box(body, material, lo, hi, spacing) bind(c, name='peri_add_box')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: material
            type(c_ptr), value :: lo
            type(c_ptr), value :: hi
            real(c_double), value :: spacing
            integer(c_int64_t) :: c_add_box
        end function
        function c_add_grid(body, material, lo, hi, cells) bind(c, name='peri_add_grid')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: material
            type(c_ptr), value :: lo
            type(c_ptr), value :: hi
            type(c_ptr), value :: cells
            integer(c_int64_t) :: c_add_grid
        end function
        function c_add_ball(body, material, centre, radius, spacing) bind(c, name='peri_add_ball')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: material
            type(c_ptr), value :: centre
            real(c_double), value :: radius
            real(c_double), value :: spacing
            integer(c_int64_t) :: c_add_ball
        end function
        function c_add_shape(body, material, lo, hi, spacing, inside, user) bind(c, name='peri_add_shape')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: material
            type(c_ptr), value :: lo
            type(c_ptr), value :: hi
            real(c_double), value :: spacing
            type(c_funptr), value :: inside
            type(c_ptr), value :: user
            integer(c_int64_t) :: c_add_shape
        end function
        function c_add_perturbed_box(body, material, lo, hi, spacing, amount, seed) bind(c, name='peri_add_perturbed_box')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: material
            type(c_ptr), value :: lo
            type(c_ptr), value :: hi
            real(c_double), value :: spacing
            real(c_double), value :: amount
            integer(c_int64_t), value :: seed
            integer(c_int64_t) :: c_add_perturbed_box
        end function
        function c_add_points(body, count, positions, volumes, materials) bind(c, name='peri_add_points')
            import
            type(c_ptr), value :: body
            integer(c_int64_t), value :: count
            type(c_ptr), value :: positions
            type(c_ptr), value :: volumes
            type(c_ptr), value :: materials
            integer(c_int64_t) :: c_add_points
        end function
        subroutine c_cells_desc_init(desc) bind(c, name='peri_cells_desc_init')
            import
            type(peri_cells_desc), intent(inout) :: desc
        end subroutine
        function c_add_cells(body, desc) bind(c, name='peri_add_cells')
            import
            type(c_ptr), value :: body
            type(peri_cells_desc), intent(in) :: desc
            integer(c_int64_t) :: c_add_cells
        end function
        function c_set_families(body, width, ibond) bind(c, name='peri_set_families')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: width
            type(c_ptr), value :: ibond
            integer(c_int32_t) :: c_set_families
        end function
        subroutine c_part_desc_init(desc) bind(c, name='peri_part_desc_init')
            import
            type(peri_part_desc), intent(inout) :: desc
        end subroutine
        function c_set_part(body, desc) bind(c, name='peri_set_part')
            import
            type(c_ptr), value :: body
            type(peri_part_desc), intent(in) :: desc
            integer(c_int32_t) :: c_set_part
        end function
        function c_ghost_depth(body) bind(c, name='peri_ghost_depth')
            import
            type(c_ptr), value :: body
            integer(c_int32_t) :: c_ghost_depth
        end function
        function c_set_mean_gradient(body, gradient) bind(c, name='peri_set_mean_gradient')
            import
            type(c_ptr), value :: body
            type(c_ptr), value :: gradient
            integer(c_int32_t) :: c_set_mean_gradient
        end function
        function c_add_box_part(body, material, lo, hi, spacing, first, last) bind(c, name='peri_add_box_part')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: material
            type(c_ptr), value :: lo
            type(c_ptr), value :: hi
            real(c_double), value :: spacing
            type(c_ptr), value :: first
            type(c_ptr), value :: last
            integer(c_int64_t) :: c_add_box_part
        end function
        function c_build(body) bind(c, name='peri_build')
            import
            type(c_ptr), value :: body
            integer(c_int32_t) :: c_build
        end function
        function c_dimension(body) bind(c, name='peri_dimension')
            import
            type(c_ptr), value :: body
            integer(c_int32_t) :: c_dimension
        end function
        function c_point_count(body) bind(c, name='peri_point_count')
            import
            type(c_ptr), value :: body
            integer(c_int64_t) :: c_point_count
        end function
        function c_family_width(body) bind(c, name='peri_family_width')
            import
            type(c_ptr), value :: body
            integer(c_int32_t) :: c_family_width
        end function
        function c_bond_count(body) bind(c, name='peri_bond_count')
            import
            type(c_ptr), value :: body
            integer(c_int64_t) :: c_bond_count
        end function
        function c_entry_count(body) bind(c, name='peri_entry_count')
            import
            type(c_ptr), value :: body
            integer(c_int64_t) :: c_entry_count
        end function
        function c_cut_count(body) bind(c, name='peri_cut_count')
            import
            type(c_ptr), value :: body
            integer(c_int64_t) :: c_cut_count
        end function
        function c_broken_count(body) bind(c, name='peri_broken_count')
            import
            type(c_ptr), value :: body
            integer(c_int64_t) :: c_broken_count
        end function
        function c_step_count(body) bind(c, name='peri_step_count')
            import
            type(c_ptr), value :: body
            integer(c_int64_t) :: c_step_count
        end function
        function c_time(body) bind(c, name='peri_time')
            import
            type(c_ptr), value :: body
            real(c_double) :: c_time
        end function
        function c_load_factor(body) bind(c, name='peri_load_factor')
            import
            type(c_ptr), value :: body
            real(c_double) :: c_load_factor
        end function
        function c_kernel_text(body) bind(c, name='peri_kernel_text')
            import
            type(c_ptr), value :: body
            type(c_ptr) :: c_kernel_text
        end function
        function c_stable_step(body) bind(c, name='peri_stable_step')
            import
            type(c_ptr), value :: body
            real(c_double) :: c_stable_step
        end function
        function c_get_families(body, first, count, rows, capacity) bind(c, name='peri_get_families')
            import
            type(c_ptr), value :: body
            integer(c_int64_t), value :: first
            integer(c_int64_t), value :: count
            type(c_ptr), value :: rows
            integer(c_int64_t), value :: capacity
            integer(c_int32_t) :: c_get_families
        end function
        function c_find_point(body, x) bind(c, name='peri_find_point')
            import
            type(c_ptr), value :: body
            type(c_ptr), value :: x
            integer(c_int32_t) :: c_find_point
        end function
        function c_find_point_in_place(body, x) bind(c, name='peri_find_point_in_place')
            import
            type(c_ptr), value :: body
            type(c_ptr), value :: x
            integer(c_int32_t) :: c_find_point_in_place
        end function
        function c_bond_is_intact(body, i, j) bind(c, name='peri_bond_is_intact')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: i
            integer(c_int32_t), value :: j
            integer(c_int32_t) :: c_bond_is_intact
        end function
        function c_reset(body) bind(c, name='peri_reset')
            import
            type(c_ptr), value :: body
            integer(c_int32_t) :: c_reset
        end function
        function c_select_box(body, name, lo, hi) bind(c, name='peri_select_box')
            import
            type(c_ptr), value :: body
            type(c_ptr), value :: name
            type(c_ptr), value :: lo
            type(c_ptr), value :: hi
            integer(c_int32_t) :: c_select_box
        end function
        function c_select_ball(body, name, centre, radius) bind(c, name='peri_select_ball')
            import
            type(c_ptr), value :: body
            type(c_ptr), value :: name
            type(c_ptr), value :: centre
            real(c_double), value :: radius
            integer(c_int32_t) :: c_select_ball
        end function
        function c_select_box_in_place(body, name, lo, hi) bind(c, name='peri_select_box_in_place')
            import
            type(c_ptr), value :: body
            type(c_ptr), value :: name
            type(c_ptr), value :: lo
            type(c_ptr), value :: hi
            integer(c_int32_t) :: c_select_box_in_place
        end function
        function c_select_ball_in_place(body, name, centre, radius) bind(c, name='peri_select_ball_in_place')
            import
            type(c_ptr), value :: body
            type(c_ptr), value :: name
            type(c_ptr), value :: centre
            real(c_double), value :: radius
            integer(c_int32_t) :: c_select_ball_in_place
        end function
        function c_select_if(body, name, take, user) bind(c, name='peri_select_if')
            import
            type(c_ptr), value :: body
            type(c_ptr), value :: name
            type(c_funptr), value :: take
            type(c_ptr), value :: user
            integer(c_int32_t) :: c_select_if
        end function
        function c_select_points(body, name, count, points) bind(c, name='peri_select_points')
            import
            type(c_ptr), value :: body
            type(c_ptr), value :: name
            integer(c_int64_t), value :: count
            type(c_ptr), value :: points
            integer(c_int32_t) :: c_select_points
        end function
        function c_find_set(body, name) bind(c, name='peri_find_set')
            import
            type(c_ptr), value :: body
            type(c_ptr), value :: name
            integer(c_int32_t) :: c_find_set
        end function
        function c_size_of_set(body, set) bind(c, name='peri_size_of_set')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: set
            integer(c_int64_t) :: c_size_of_set
        end function
        function c_get_set(body, set, points, capacity) bind(c, name='peri_get_set')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: set
            type(c_ptr), value :: points
            integer(c_int64_t), value :: capacity
            integer(c_int32_t) :: c_get_set
        end function
        function c_cut_segment(body, standing, from, to) bind(c, name='peri_cut_segment')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: standing
            type(c_ptr), value :: from
            type(c_ptr), value :: to
            integer(c_int64_t) :: c_cut_segment
        end function
        function c_cut_polyline(body, standing, count, vertices) bind(c, name='peri_cut_polyline')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: standing
            integer(c_int64_t), value :: count
            type(c_ptr), value :: vertices
            integer(c_int64_t) :: c_cut_polyline
        end function
        function c_cut_disc(body, standing, centre, normal, radius) bind(c, name='peri_cut_disc')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: standing
            type(c_ptr), value :: centre
            type(c_ptr), value :: normal
            real(c_double), value :: radius
            integer(c_int64_t) :: c_cut_disc
        end function
        function c_cut_triangle(body, standing, p, q, r) bind(c, name='peri_cut_triangle')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: standing
            type(c_ptr), value :: p
            type(c_ptr), value :: q
            type(c_ptr), value :: r
            integer(c_int64_t) :: c_cut_triangle
        end function
        function c_cut_rectangle(body, standing, corner, edge1, edge2) bind(c, name='peri_cut_rectangle')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: standing
            type(c_ptr), value :: corner
            type(c_ptr), value :: edge1
            type(c_ptr), value :: edge2
            integer(c_int64_t) :: c_cut_rectangle
        end function
        function c_cut_pairs(body, standing, count, pairs) bind(c, name='peri_cut_pairs')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: standing
            integer(c_int64_t), value :: count
            type(c_ptr), value :: pairs
            integer(c_int64_t) :: c_cut_pairs
        end function
        function c_cut_if(body, standing, cut, user) bind(c, name='peri_cut_if')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: standing
            type(c_funptr), value :: cut
            type(c_ptr), value :: user
            integer(c_int64_t) :: c_cut_if
        end function
        function c_set_no_fail(body, set, on) bind(c, name='peri_set_no_fail')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: set
            integer(c_int32_t), value :: on
            integer(c_int32_t) :: c_set_no_fail
        end function
        function c_on_break(body, fn, user) bind(c, name='peri_on_break')
            import
            type(c_ptr), value :: body
            type(c_funptr), value :: fn
            type(c_ptr), value :: user
            integer(c_int32_t) :: c_on_break
        end function
        function c_set_strength_pairs(body, count, pairs, factors) bind(c, name='peri_set_strength_pairs')
            import
            type(c_ptr), value :: body
            integer(c_int64_t), value :: count
            type(c_ptr), value :: pairs
            type(c_ptr), value :: factors
            integer(c_int64_t) :: c_set_strength_pairs
        end function
        function c_set_strength_if(body, factor, take, user) bind(c, name='peri_set_strength_if')
            import
            type(c_ptr), value :: body
            real(c_double), value :: factor
            type(c_funptr), value :: take
            type(c_ptr), value :: user
            integer(c_int64_t) :: c_set_strength_if
        end function
        function c_record_breaks(body, on) bind(c, name='peri_record_breaks')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: on
            integer(c_int32_t) :: c_record_breaks
        end function
        function c_find_fragments(body, of_point, capacity) bind(c, name='peri_find_fragments')
            import
            type(c_ptr), value :: body
            type(c_ptr), value :: of_point
            integer(c_int64_t), value :: capacity
            integer(c_int64_t) :: c_find_fragments
        end function
        function c_get_fragments(body, out, capacity) bind(c, name='peri_get_fragments')
            import
            type(c_ptr), value :: body
            type(c_ptr), value :: out
            integer(c_int64_t), value :: capacity
            integer(c_int32_t) :: c_get_fragments
        end function
        function c_size_of_outline(body, fragment, vertices, faces) bind(c, name='peri_size_of_outline')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: fragment
            type(c_ptr), value :: vertices
            type(c_ptr), value :: faces
            integer(c_int32_t) :: c_size_of_outline
        end function
        function c_get_outline(body, fragment, vertices, vertex_capacity, faces, owners, inner, face_capacity) bind(c, &
            name='peri_get_outline')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: fragment
            type(c_ptr), value :: vertices
            integer(c_int64_t), value :: vertex_capacity
            type(c_ptr), value :: faces
            type(c_ptr), value :: owners
            type(c_ptr), value :: inner
            integer(c_int64_t), value :: face_capacity
            integer(c_int32_t) :: c_get_outline
        end function
        function c_add_displacement(body, set, value) bind(c, name='peri_add_displacement')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: set
            type(c_ptr), value :: value
            integer(c_int32_t) :: c_add_displacement
        end function
        function c_add_velocity(body, set, value) bind(c, name='peri_add_velocity')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: set
            type(c_ptr), value :: value
            integer(c_int32_t) :: c_add_velocity
        end function
        function c_prescribe_displacement(body, set, axes, value, fn, user) bind(c, name='peri_prescribe_displacement')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: set
            integer(c_int32_t), value :: axes
            type(c_ptr), value :: value
            type(c_funptr), value :: fn
            type(c_ptr), value :: user
            integer(c_int32_t) :: c_prescribe_displacement
        end function
        function c_prescribe_velocity(body, set, axes, value, fn, user) bind(c, name='peri_prescribe_velocity')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: set
            integer(c_int32_t), value :: axes
            type(c_ptr), value :: value
            type(c_funptr), value :: fn
            type(c_ptr), value :: user
            integer(c_int32_t) :: c_prescribe_velocity
        end function
        function c_prescribe_rigid(body, set, centre, motion, fn, user) bind(c, name='peri_prescribe_rigid')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: set
            type(c_ptr), value :: centre
            type(c_ptr), value :: motion
            type(c_funptr), value :: fn
            type(c_ptr), value :: user
            integer(c_int32_t) :: c_prescribe_rigid
        end function
        function c_apply_body_force(body, set, value, fn, user) bind(c, name='peri_apply_body_force')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: set
            type(c_ptr), value :: value
            type(c_funptr), value :: fn
            type(c_ptr), value :: user
            integer(c_int32_t) :: c_apply_body_force
        end function
        function c_apply_traction(body, set, area, normal, value, fn, user) bind(c, name='peri_apply_traction')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: set
            real(c_double), value :: area
            type(c_ptr), value :: normal
            type(c_ptr), value :: value
            type(c_funptr), value :: fn
            type(c_ptr), value :: user
            integer(c_int32_t) :: c_apply_traction
        end function
        function c_apply_layer_traction(body, set, area, value, fn, user) bind(c, name='peri_apply_layer_traction')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: set
            real(c_double), value :: area
            type(c_ptr), value :: value
            type(c_funptr), value :: fn
            type(c_ptr), value :: user
            integer(c_int32_t) :: c_apply_layer_traction
        end function
        function c_apply_pressure(body, set, pressure, fn, user) bind(c, name='peri_apply_pressure')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: set
            real(c_double), value :: pressure
            type(c_funptr), value :: fn
            type(c_ptr), value :: user
            integer(c_int32_t) :: c_apply_pressure
        end function
        function c_apply_bond_pressure_for_comparison(body, set, pressure, fn, user) bind(c, &
            name='peri_apply_bond_pressure_for_comparison')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: set
            real(c_double), value :: pressure
            type(c_funptr), value :: fn
            type(c_ptr), value :: user
            integer(c_int32_t) :: c_apply_bond_pressure_for_comparison
        end function
        function c_remove_load(body, load) bind(c, name='peri_remove_load')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: load
            integer(c_int32_t) :: c_remove_load
        end function
        function c_get_reaction(body, load, force) bind(c, name='peri_get_reaction')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: load
            type(c_ptr), value :: force
            integer(c_int32_t) :: c_get_reaction
        end function
        function c_get_reaction_moment(body, load, place, moment) bind(c, name='peri_get_reaction_moment')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: load
            type(c_ptr), value :: place
            type(c_ptr), value :: moment
            integer(c_int32_t) :: c_get_reaction_moment
        end function
        subroutine c_obstacle_desc_init(desc, shape) bind(c, name='peri_obstacle_desc_init')
            import
            type(peri_obstacle_desc), intent(inout) :: desc
            integer(c_int32_t), value :: shape
        end subroutine
        function c_add_obstacle(body, desc) bind(c, name='peri_add_obstacle')
            import
            type(c_ptr), value :: body
            type(peri_obstacle_desc), intent(in) :: desc
            integer(c_int32_t) :: c_add_obstacle
        end function
        function c_remove_obstacle(body, obstacle) bind(c, name='peri_remove_obstacle')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: obstacle
            integer(c_int32_t) :: c_remove_obstacle
        end function
        function c_get_obstacle_force(body, obstacle, force, moment) bind(c, name='peri_get_obstacle_force')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: obstacle
            type(c_ptr), value :: force
            type(c_ptr), value :: moment
            integer(c_int32_t) :: c_get_obstacle_force
        end function
        function c_get_obstacle_state(body, obstacle, state) bind(c, name='peri_get_obstacle_state')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: obstacle
            type(peri_obstacle_state), intent(inout) :: state
            integer(c_int32_t) :: c_get_obstacle_state
        end function
        function c_set_obstacle_state(body, obstacle, state) bind(c, name='peri_set_obstacle_state')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: obstacle
            type(peri_obstacle_state), intent(in) :: state
            integer(c_int32_t) :: c_set_obstacle_state
        end function
        subroutine c_contact_desc_init(desc) bind(c, name='peri_contact_desc_init')
            import
            type(peri_contact_desc), intent(inout) :: desc
        end subroutine
        function c_set_contact(body, i, j, desc) bind(c, name='peri_set_contact')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: i
            integer(c_int32_t), value :: j
            type(c_ptr), value :: desc
            integer(c_int32_t) :: c_set_contact
        end function
        subroutine c_advance_desc_init(desc) bind(c, name='peri_advance_desc_init')
            import
            type(peri_advance_desc), intent(inout) :: desc
        end subroutine
        function c_advance(body, desc) bind(c, name='peri_advance')
            import
            type(c_ptr), value :: body
            type(peri_advance_desc), intent(in) :: desc
            integer(c_int32_t) :: c_advance
        end function
        subroutine c_evaluate_desc_init(desc) bind(c, name='peri_evaluate_desc_init')
            import
            type(peri_evaluate_desc), intent(inout) :: desc
        end subroutine
        function c_evaluate(body, desc, report) bind(c, name='peri_evaluate')
            import
            type(c_ptr), value :: body
            type(peri_evaluate_desc), intent(in) :: desc
            type(c_ptr), value :: report
            integer(c_int32_t) :: c_evaluate
        end function
        subroutine c_solve_desc_init(desc) bind(c, name='peri_solve_desc_init')
            import
            type(peri_solve_desc), intent(inout) :: desc
        end subroutine
        function c_solve(body, desc, report) bind(c, name='peri_solve')
            import
            type(c_ptr), value :: body
            type(peri_solve_desc), intent(in) :: desc
            type(peri_solve_report), intent(inout) :: report
            integer(c_int32_t) :: c_solve
        end function
        function c_advance_implicit(body, advance, solve, rho, report) bind(c, name='peri_advance_implicit')
            import
            type(c_ptr), value :: body
            type(peri_advance_desc), intent(in) :: advance
            type(peri_solve_desc), intent(in) :: solve
            real(c_double), value :: rho
            type(c_ptr), value :: report
            integer(c_int32_t) :: c_advance_implicit
        end function
        function c_multiply_stiffness(body, in, out, count) bind(c, name='peri_multiply_stiffness')
            import
            type(c_ptr), value :: body
            type(c_ptr), value :: in
            type(c_ptr), value :: out
            integer(c_int64_t), value :: count
            integer(c_int32_t) :: c_multiply_stiffness
        end function
        function c_multiply_stiffness_at(body, displacement, in, out, count) bind(c, name='peri_multiply_stiffness_at')
            import
            type(c_ptr), value :: body
            type(c_ptr), value :: displacement
            type(c_ptr), value :: in
            type(c_ptr), value :: out
            integer(c_int64_t), value :: count
            integer(c_int32_t) :: c_multiply_stiffness_at
        end function
        function c_matrix_create(body, matrix) bind(c, name='peri_matrix_create')
            import
            type(c_ptr), value :: body
            type(c_ptr), intent(out) :: matrix
            integer(c_int32_t) :: c_matrix_create
        end function
        subroutine c_matrix_destroy(matrix) bind(c, name='peri_matrix_destroy')
            import
            type(c_ptr), value :: matrix
        end subroutine
        function c_matrix_rows(matrix) bind(c, name='peri_matrix_rows')
            import
            type(c_ptr), value :: matrix
            integer(c_int64_t) :: c_matrix_rows
        end function
        function c_matrix_entries(matrix) bind(c, name='peri_matrix_entries')
            import
            type(c_ptr), value :: matrix
            integer(c_int64_t) :: c_matrix_entries
        end function
        function c_get_matrix(matrix, start, column, value) bind(c, name='peri_get_matrix')
            import
            type(c_ptr), value :: matrix
            type(c_ptr), value :: start
            type(c_ptr), value :: column
            type(c_ptr), value :: value
            integer(c_int32_t) :: c_get_matrix
        end function
        function c_export_matrix_to(matrix, write, user) bind(c, name='peri_export_matrix_to')
            import
            type(c_ptr), value :: matrix
            type(c_funptr), value :: write
            type(c_ptr), value :: user
            integer(c_int32_t) :: c_export_matrix_to
        end function
        function c_size_of_field(body, field) bind(c, name='peri_size_of_field')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: field
            integer(c_int64_t) :: c_size_of_field
        end function
        function c_get_field(body, field, out, capacity) bind(c, name='peri_get_field')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: field
            type(c_ptr), value :: out
            integer(c_int64_t), value :: capacity
            integer(c_int32_t) :: c_get_field
        end function
        function c_set_field(body, field, in, count) bind(c, name='peri_set_field')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: field
            type(c_ptr), value :: in
            integer(c_int64_t), value :: count
            integer(c_int32_t) :: c_set_field
        end function
        function c_view_field(body, field, view) bind(c, name='peri_view_field')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: field
            type(peri_view), intent(inout) :: view
            integer(c_int32_t) :: c_view_field
        end function
        function c_get_field_at(body, field, count, points, out, capacity) bind(c, name='peri_get_field_at')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: field
            integer(c_int64_t), value :: count
            type(c_ptr), value :: points
            type(c_ptr), value :: out
            integer(c_int64_t), value :: capacity
            integer(c_int32_t) :: c_get_field_at
        end function
        function c_interpolate_field(body, field, in_place, count, places, out, capacity) bind(c, name='peri_interpolate_field')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: field
            integer(c_int32_t), value :: in_place
            integer(c_int64_t), value :: count
            type(c_ptr), value :: places
            type(c_ptr), value :: out
            integer(c_int64_t), value :: capacity
            integer(c_int32_t) :: c_interpolate_field
        end function
        function c_size_of_bonds(body, set, bond) bind(c, name='peri_size_of_bonds')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: set
            integer(c_int32_t), value :: bond
            integer(c_int64_t) :: c_size_of_bonds
        end function
        function c_get_bonds(body, set, bond, out, capacity) bind(c, name='peri_get_bonds')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: set
            integer(c_int32_t), value :: bond
            type(c_ptr), value :: out
            integer(c_int64_t), value :: capacity
            integer(c_int32_t) :: c_get_bonds
        end function
        function c_get_energy(body, energy) bind(c, name='peri_get_energy')
            import
            type(c_ptr), value :: body
            type(peri_energy), intent(inout) :: energy
            integer(c_int32_t) :: c_get_energy
        end function
        function c_get_momentum(body, linear, angular) bind(c, name='peri_get_momentum')
            import
            type(c_ptr), value :: body
            type(c_ptr), value :: linear
            type(c_ptr), value :: angular
            integer(c_int32_t) :: c_get_momentum
        end function
        subroutine c_cracks_desc_init(desc) bind(c, name='peri_cracks_desc_init')
            import
            type(peri_cracks_desc), intent(inout) :: desc
        end subroutine
        function c_cracks_create(body, desc, cracks) bind(c, name='peri_cracks_create')
            import
            type(c_ptr), value :: body
            type(peri_cracks_desc), intent(in) :: desc
            type(c_ptr), intent(out) :: cracks
            integer(c_int32_t) :: c_cracks_create
        end function
        subroutine c_cracks_destroy(cracks) bind(c, name='peri_cracks_destroy')
            import
            type(c_ptr), value :: cracks
        end subroutine
        function c_cracks_paths(cracks) bind(c, name='peri_cracks_paths')
            import
            type(c_ptr), value :: cracks
            integer(c_int64_t) :: c_cracks_paths
        end function
        function c_cracks_vertices(cracks) bind(c, name='peri_cracks_vertices')
            import
            type(c_ptr), value :: cracks
            integer(c_int64_t) :: c_cracks_vertices
        end function
        function c_cracks_tips(cracks) bind(c, name='peri_cracks_tips')
            import
            type(c_ptr), value :: cracks
            integer(c_int64_t) :: c_cracks_tips
        end function
        function c_cracks_size(cracks) bind(c, name='peri_cracks_size')
            import
            type(c_ptr), value :: cracks
            real(c_double) :: c_cracks_size
        end function
        function c_get_cracks(cracks, start, vertex, time, tip) bind(c, name='peri_get_cracks')
            import
            type(c_ptr), value :: cracks
            type(c_ptr), value :: start
            type(c_ptr), value :: vertex
            type(c_ptr), value :: time
            type(c_ptr), value :: tip
            integer(c_int32_t) :: c_get_cracks
        end function
        function c_export_cracks_to(cracks, write, user) bind(c, name='peri_export_cracks_to')
            import
            type(c_ptr), value :: cracks
            type(c_funptr), value :: write
            type(c_ptr), value :: user
            integer(c_int32_t) :: c_export_cracks_to
        end function
        function c_export_vtu_to(body, write, user) bind(c, name='peri_export_vtu_to')
            import
            type(c_ptr), value :: body
            type(c_funptr), value :: write
            type(c_ptr), value :: user
            integer(c_int32_t) :: c_export_vtu_to
        end function
        function c_export_fields_to(body, fields, count, write, user) bind(c, name='peri_export_fields_to')
            import
            type(c_ptr), value :: body
            type(c_ptr), value :: fields
            integer(c_int64_t), value :: count
            type(c_funptr), value :: write
            type(c_ptr), value :: user
            integer(c_int32_t) :: c_export_fields_to
        end function
        function c_export_history_to(body, header, write, user) bind(c, name='peri_export_history_to')
            import
            type(c_ptr), value :: body
            integer(c_int32_t), value :: header
            type(c_funptr), value :: write
            type(c_ptr), value :: user
            integer(c_int32_t) :: c_export_history_to
        end function
        function c_export_vtu(body, path) bind(c, name='peri_export_vtu')
            import
            type(c_ptr), value :: body
            type(c_ptr), value :: path
            integer(c_int32_t) :: c_export_vtu
        end function
        function c_export_frame(body, path, frame, fields, count) bind(c, name='peri_export_frame')
            import
            type(c_ptr), value :: body
            type(c_ptr), value :: path
            integer(c_int64_t), value :: frame
            type(c_ptr), value :: fields
            integer(c_int64_t), value :: count
            integer(c_int32_t) :: c_export_frame
        end function
        function c_export_history(body, path, append) bind(c, name='peri_export_history')
            import
            type(c_ptr), value :: body
            type(c_ptr), value :: path
            integer(c_int32_t), value :: append
            integer(c_int32_t) :: c_export_history
        end function
        function c_save_state_to(body, write, user) bind(c, name='peri_save_state_to')
            import
            type(c_ptr), value :: body
            type(c_funptr), value :: write
            type(c_ptr), value :: user
            integer(c_int32_t) :: c_save_state_to
        end function
        function c_load_state_from(body, read, user) bind(c, name='peri_load_state_from')
            import
            type(c_ptr), value :: body
            type(c_funptr), value :: read
            type(c_ptr), value :: user
            integer(c_int32_t) :: c_load_state_from
        end function
        function c_save_state(body, path) bind(c, name='peri_save_state')
            import
            type(c_ptr), value :: body
            type(c_ptr), value :: path
            integer(c_int32_t) :: c_save_state
        end function
        function c_load_state(body, path) bind(c, name='peri_load_state')
            import
            type(c_ptr), value :: body
            type(c_ptr), value :: path
            integer(c_int32_t) :: c_load_state
        end function
        function c_get_memory(body, memory) bind(c, name='peri_get_memory')
            import
            type(c_ptr), value :: body
            type(peri_memory), intent(inout) :: memory
            integer(c_int32_t) :: c_get_memory
        end function
        subroutine c_plan_desc_init(desc) bind(c, name='peri_plan_desc_init')
            import
            type(peri_plan_desc), intent(inout) :: desc
        end subroutine
        function c_plan(desc, report, error) bind(c, name='peri_plan')
            import
            type(peri_plan_desc), intent(in) :: desc
            type(peri_plan_report), intent(inout) :: report
            type(c_ptr), value :: error
            integer(c_int32_t) :: c_plan
        end function
        subroutine c_choose_desc_init(desc) bind(c, name='peri_choose_desc_init')
            import
            type(peri_choose_desc), intent(inout) :: desc
        end subroutine
        function c_choose(desc, body, material, report, error) bind(c, name='peri_choose')
            import
            type(peri_choose_desc), intent(in) :: desc
            type(peri_body_desc), intent(inout) :: body
            type(peri_material_desc), intent(inout) :: material
            type(peri_choose_report), intent(inout) :: report
            type(c_ptr), value :: error
            integer(c_int32_t) :: c_choose
        end function
    end interface
end module

module peri
    use peri_c
    use, intrinsic :: iso_fortran_env, only: error_unit
    implicit none
    private :: text_of, c_text, failed, refused, optional_text, c_ptr_of, error_unit
    private :: c_version
    private :: c_status_text
    private :: c_format_error
    private :: c_body_desc_init
    private :: c_body_create
    private :: c_body_clone
    private :: c_body_destroy
    private :: c_unlock
    private :: c_get_error
    private :: c_id
    private :: c_material_desc_init
    private :: c_add_material
    private :: c_set_interface
    private :: c_softening_desc_init
    private :: c_set_softening
    private :: c_get_softening
    private :: c_set_bond_law
    private :: c_get_bond_constants
    private :: c_get_critical_energy
    private :: c_add_box
    private :: c_add_grid
    private :: c_add_ball
    private :: c_add_shape
    private :: c_add_perturbed_box
    private :: c_add_points
    private :: c_cells_desc_init
    private :: c_add_cells
    private :: c_set_families
    private :: c_part_desc_init
    private :: c_set_part
    private :: c_ghost_depth
    private :: c_set_mean_gradient
    private :: c_add_box_part
    private :: c_build
    private :: c_dimension
    private :: c_point_count
    private :: c_family_width
    private :: c_bond_count
    private :: c_entry_count
    private :: c_cut_count
    private :: c_broken_count
    private :: c_step_count
    private :: c_time
    private :: c_load_factor
    private :: c_kernel_text
    private :: c_stable_step
    private :: c_get_families
    private :: c_find_point
    private :: c_find_point_in_place
    private :: c_bond_is_intact
    private :: c_reset
    private :: c_select_box
    private :: c_select_ball
    private :: c_select_box_in_place
    private :: c_select_ball_in_place
    private :: c_select_if
    private :: c_select_points
    private :: c_find_set
    private :: c_size_of_set
    private :: c_get_set
    private :: c_cut_segment
    private :: c_cut_polyline
    private :: c_cut_disc
    private :: c_cut_triangle
    private :: c_cut_rectangle
    private :: c_cut_pairs
    private :: c_cut_if
    private :: c_set_no_fail
    private :: c_on_break
    private :: c_set_strength_pairs
    private :: c_set_strength_if
    private :: c_record_breaks
    private :: c_find_fragments
    private :: c_get_fragments
    private :: c_size_of_outline
    private :: c_get_outline
    private :: c_add_displacement
    private :: c_add_velocity
    private :: c_prescribe_displacement
    private :: c_prescribe_velocity
    private :: c_prescribe_rigid
    private :: c_apply_body_force
    private :: c_apply_traction
    private :: c_apply_layer_traction
    private :: c_apply_pressure
    private :: c_apply_bond_pressure_for_comparison
    private :: c_remove_load
    private :: c_get_reaction
    private :: c_get_reaction_moment
    private :: c_obstacle_desc_init
    private :: c_add_obstacle
    private :: c_remove_obstacle
    private :: c_get_obstacle_force
    private :: c_get_obstacle_state
    private :: c_set_obstacle_state
    private :: c_contact_desc_init
    private :: c_set_contact
    private :: c_advance_desc_init
    private :: c_advance
    private :: c_evaluate_desc_init
    private :: c_evaluate
    private :: c_solve_desc_init
    private :: c_solve
    private :: c_advance_implicit
    private :: c_multiply_stiffness
    private :: c_multiply_stiffness_at
    private :: c_matrix_create
    private :: c_matrix_destroy
    private :: c_matrix_rows
    private :: c_matrix_entries
    private :: c_get_matrix
    private :: c_export_matrix_to
    private :: c_size_of_field
    private :: c_get_field
    private :: c_set_field
    private :: c_view_field
    private :: c_get_field_at
    private :: c_interpolate_field
    private :: c_size_of_bonds
    private :: c_get_bonds
    private :: c_get_energy
    private :: c_get_momentum
    private :: c_cracks_desc_init
    private :: c_cracks_create
    private :: c_cracks_destroy
    private :: c_cracks_paths
    private :: c_cracks_vertices
    private :: c_cracks_tips
    private :: c_cracks_size
    private :: c_get_cracks
    private :: c_export_cracks_to
    private :: c_export_vtu_to
    private :: c_export_fields_to
    private :: c_export_history_to
    private :: c_export_vtu
    private :: c_export_frame
    private :: c_export_history
    private :: c_save_state_to
    private :: c_load_state_from
    private :: c_save_state
    private :: c_load_state
    private :: c_get_memory
    private :: c_plan_desc_init
    private :: c_plan
    private :: c_choose_desc_init
    private :: c_choose

contains

    subroutine text_of(from, text)
        type(c_ptr), value :: from
        character(:), allocatable, intent(out) :: text
        character(kind=c_char), pointer :: letters(:)
        integer :: n
        text = ''
        if (.not. c_associated(from)) return
        call c_f_pointer(from, letters, [400])
        do n = 1, 399
            if (letters(n) == c_null_char) exit
            text = text // letters(n)
        end do
    end subroutine

    pure function c_text(text) result(out)
        character(*), intent(in) :: text
        character(kind=c_char) :: out(len(text) + 1)
        integer :: k
        do k = 1, len(text)
            out(k) = text(k:k)
        end do
        out(len(text) + 1) = c_null_char
    end function

    ! "" stands for NULL
    subroutine optional_text(text, at)
        character(kind=c_char), intent(in), target :: text(:)
        type(c_ptr), intent(out) :: at
        at = c_null_ptr
        if (size(text) > 1) at = c_loc(text(1))
    end subroutine

    function c_ptr_of(given) result(at)
        type(c_ptr), intent(in), optional :: given
        type(c_ptr) :: at
        at = c_null_ptr
        if (present(given)) at = given
    end function

    ! What went wrong, as stat and errmsg have it; an error stop where there is no stat.
    subroutine failed(record, stat, errmsg)
        type(peri_error), intent(in), target :: record
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        character(kind=c_char), target :: letters(400)
        character(:), allocatable :: text
        integer(c_int64_t) :: length
        type(c_ptr) :: at
        letters = c_null_char
        at = c_loc(letters(1)) ! not within the calls: gfortran 12 passes the length of a letter with it
        length = c_format_error(record, at, 400_c_int64_t)
        if (length < 0) return
        call text_of(at, text)
        if (present(errmsg)) errmsg = text
        if (present(stat)) then
            stat = record%code
        else
            write (error_unit, '(a)') text
            error stop 'peri: a call failed, and has no stat='
        end if
    end subroutine

    subroutine refused(field, stat, errmsg)
        character(*), intent(in) :: field
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(peri_error) :: record
        character(kind=c_char), target :: letters(len(field) + 1)
        letters = c_text(field)
        record%code = PERI_ERROR_ARGUMENT
        record%index = -1
        record%field = c_loc(letters(1))
        record%text = c_status_text(PERI_ERROR_ARGUMENT)
        call failed(record, stat, errmsg)
    end subroutine

    ! The record of a failed call of a body: stat, field, index and value.
    subroutine peri_get_error(body, record)
        type(peri_body), intent(in) :: body
        type(peri_error), intent(out) :: record
        integer(c_int32_t) :: result_
        result_ = c_get_error(body%handle, record)
        if (result_ < 0) record%code = result_
    end subroutine

    ! The field of a record.
    function peri_field_of_error(record) result(text)
        type(peri_error), intent(in) :: record
        character(:), allocatable :: text
        call text_of(record%field, text)
    end function

    function peri_status_text(status) result(text)
        integer, intent(in) :: status
        character(:), allocatable :: text
        call text_of(c_status_text(int(status, c_int32_t)), text)
    end function

    function peri_version() result(version)
        integer :: version
        version = c_version()
    end function

    pure function peri_id_index(id) result(index)
        integer(c_int32_t), intent(in) :: id
        integer(c_int32_t) :: index
        index = iand(id, int(z'FFFFF', c_int32_t))
    end function

    ! A field in place, nothing copied: component k of point i, both from 0, is data(1 + i*point_stride + k*component_stride).
    subroutine peri_view_pointer(view, data)
        type(peri_view), intent(in) :: view
        real(c_double), pointer, intent(out) :: data(:)
        nullify (data)
        if (view%type /= PERI_TYPE_F64 .or. view%count < 1) return
        call c_f_pointer(view%data, data, [(view%count - 1)*view%point_stride + (view%components - 1)*view%component_stride + 1])
    end subroutine

    ! Fills in the defaults. NULL is ignored; alike all _desc_init.
    subroutine peri_body_desc_init(desc)
        type(peri_body_desc), intent(out) :: desc
        call c_body_desc_init(desc)
    end subroutine

    ! *body is NULL on failure. error may be NULL.
    subroutine peri_body_create(desc, body, stat, errmsg)
        type(peri_body_desc), intent(in) :: desc
        type(peri_body), intent(out) :: body
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(peri_error), target :: record
        result_ = c_body_create(desc, body%handle, c_loc(record))
        if (result_ < 0) then
            record%code = int(result_, c_int32_t)
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! An independent copy of a built body, state, loads and number included: ids hold in both. Points, families and weights are
    ! shared. error may be NULL.
    subroutine peri_body_clone(body, copy, stat, errmsg)
        type(peri_body), intent(in) :: body
        type(peri_body), intent(out) :: copy
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(peri_error), target :: record
        result_ = c_body_clone(body%handle, copy%handle, c_loc(record))
        if (result_ < 0) then
            record%code = int(result_, c_int32_t)
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! Frees the body. Ignored of NULL, and from a callback of the body. Clones live on.
    subroutine peri_body_destroy(body)
        type(peri_body), intent(inout) :: body
        call c_body_destroy(body%handle)
        body%handle = c_null_ptr
    end subroutine

    ! After a callback was left by longjmp or an exception: ends the call that it came from, and frees its memory. The body may
    ! then be read, reset or destroyed; it runs again after peri_reset. Never from within a callback. PERI_ERROR_ORDER where
    ! none was left. Memory hooks, job systems and what a measuring peri_plan calls may not be left so.
    subroutine peri_unlock(body, stat, errmsg)
        type(peri_body), intent(in) :: body
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(peri_error) :: record
        result_ = c_unlock(body%handle)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! The id of the index-th (1, 2, ...) thing of a peri_kind, removed ones counted; or an error.
    function peri_id(body, kind, index, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: kind
        integer(c_int64_t), intent(in) :: index
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(peri_error) :: record
        result_ = c_id(body%handle, kind, index)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    subroutine peri_material_desc_init(desc, law)
        type(peri_material_desc), intent(out) :: desc
        integer(c_int32_t), intent(in) :: law
        call c_material_desc_init(desc, law)
    end subroutine

    ! Adds a material, before peri_build; at most 120. Returns its id, or an error.
    function peri_add_material(body, desc, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        type(peri_material_desc), intent(in) :: desc
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(peri_error) :: record
        result_ = c_add_material(body%handle, desc)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    ! Bonds between i and j break, and of bond-based i and j act, as if of `desc`, before peri_build; its law is that of one of
    ! them, not bond-based unless both are. Default: harmonic mean of the micromoduli, the criteria of both.
    subroutine peri_set_interface(body, i, j, desc, stat, errmsg)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: i
        integer(c_int32_t), intent(in) :: j
        type(peri_material_desc), intent(in) :: desc
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(peri_error) :: record
        result_ = c_set_interface(body%handle, i, j, desc)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    subroutine peri_softening_desc_init(desc, shape)
        type(peri_softening_desc), intent(out) :: desc
        integer(c_int32_t), intent(in) :: shape
        call c_softening_desc_init(desc, shape)
    end subroutine

    ! Bonds between bond-based materials i and j (i, i: within one) soften, before peri_build; their fracture_energy and
    ! critical_stretch do not count. PERI_BRITTLE: the horizon is too large, bonds break at once at less than the strength and
    ! take the energy. docs/laws.md
    subroutine peri_set_softening(body, i, j, desc, stat, errmsg)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: i
        integer(c_int32_t), intent(in) :: j
        type(peri_softening_desc), intent(in) :: desc
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(peri_error) :: record
        result_ = c_set_softening(body%handle, i, j, desc)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! The stretch at which bonds begin to soften, and that at which they break; after peri_build. PERI_BRITTLE: they are one.
    ! Either may be NULL.
    subroutine peri_get_softening(body, i, j, first, last, stat, errmsg)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: i
        integer(c_int32_t), intent(in) :: j
        real(c_double), intent(inout), optional, target :: first
        real(c_double), intent(inout), optional, target :: last
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_ptr) :: first_at
        type(c_ptr) :: last_at
        type(peri_error) :: record
        first_at = c_null_ptr
        if (present(first)) first_at = c_loc(first)
        last_at = c_null_ptr
        if (present(last)) last_at = c_loc(last)
        result_ = c_get_softening(body%handle, i, j, first_at, last_at)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! Bonds between bond-based materials i and j follow fn, each with `states` (0..8) numbers of its own, 0 at first; before
    ! peri_build. Their critical stretch holds, too. docs/laws.md
    subroutine peri_set_bond_law(body, i, j, states, fn, user, stat, errmsg)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: i
        integer(c_int32_t), intent(in) :: j
        integer(c_int32_t), intent(in) :: states
        procedure(peri_bond_law_fn), optional :: fn
        type(c_ptr), intent(in), optional :: user
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_funptr) :: fn_at
        type(peri_error) :: record
        fn_at = c_null_funptr
        if (present(fn)) fn_at = c_funloc(fn)
        result_ = c_set_bond_law(body%handle, i, j, states, fn_at, c_ptr_of(user))
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! Micromodulus c [M L^-5 T^-2] (bond-based only, else NULL) and critical stretch s0 [-] (HUGE_VAL: never; softening: where
    ! they break, after peri_build) of bonds between materials i and j. Either may be NULL. ([P] C.15-C.20, [T] 1.24, 1.40)
    subroutine peri_get_bond_constants(body, i, j, c, s0, stat, errmsg)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: i
        integer(c_int32_t), intent(in) :: j
        real(c_double), intent(inout), optional, target :: c
        real(c_double), intent(inout), optional, target :: s0
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_ptr) :: c_at
        type(c_ptr) :: s0_at
        type(peri_error) :: record
        c_at = c_null_ptr
        if (present(c)) c_at = c_loc(c)
        s0_at = c_null_ptr
        if (present(s0)) s0_at = c_loc(s0)
        result_ = c_get_bond_constants(body%handle, i, j, c_at, s0_at)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! Critical bond energy w0 [M L^-4 T^-2] of a material whose criterion is an energy; HUGE_VAL: none.
    ! PERI_CRITERION_NODE_ENERGY: after peri_build.
    subroutine peri_get_critical_energy(body, material, w0, stat, errmsg)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: material
        real(c_double), intent(out), target :: w0
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(peri_error) :: record
        result_ = c_get_critical_energy(body%handle, material, c_loc(w0))
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! The box lo[dim]..hi[dim] in cells of about `spacing` [L], which tile it.
    function peri_add_box(body, material, lo, hi, spacing, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: material
        real(c_double), intent(in), target, contiguous :: lo(:)
        real(c_double), intent(in), target, contiguous :: hi(:)
        real(c_double), intent(in) :: spacing
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int64_t) :: result_
        type(c_ptr) :: lo_at
        type(c_ptr) :: hi_at
        type(peri_error) :: record
        result_ = PERI_ERROR_ARGUMENT
        if (size(lo) /= int(c_dimension(body%handle))) then
            call refused('lo', stat, errmsg)
            return
        end if
        lo_at = c_null_ptr
        if (size(lo) > 0) lo_at = c_loc(lo)
        if (size(hi) /= int(c_dimension(body%handle))) then
            call refused('hi', stat, errmsg)
            return
        end if
        hi_at = c_null_ptr
        if (size(hi) > 0) hi_at = c_loc(hi)
        result_ = c_add_box(body%handle, material, lo_at, hi_at, spacing)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    ! The box in cells[dim] cells per axis.
    function peri_add_grid(body, material, lo, hi, cells, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: material
        real(c_double), intent(in), target, contiguous :: lo(:)
        real(c_double), intent(in), target, contiguous :: hi(:)
        integer(c_int32_t), intent(in), target, contiguous :: cells(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int64_t) :: result_
        type(c_ptr) :: lo_at
        type(c_ptr) :: hi_at
        type(c_ptr) :: cells_at
        type(peri_error) :: record
        result_ = PERI_ERROR_ARGUMENT
        if (size(lo) /= int(c_dimension(body%handle))) then
            call refused('lo', stat, errmsg)
            return
        end if
        lo_at = c_null_ptr
        if (size(lo) > 0) lo_at = c_loc(lo)
        if (size(hi) /= int(c_dimension(body%handle))) then
            call refused('hi', stat, errmsg)
            return
        end if
        hi_at = c_null_ptr
        if (size(hi) > 0) hi_at = c_loc(hi)
        if (size(cells) /= int(c_dimension(body%handle))) then
            call refused('cells', stat, errmsg)
            return
        end if
        cells_at = c_null_ptr
        if (size(cells) > 0) cells_at = c_loc(cells)
        result_ = c_add_grid(body%handle, material, lo_at, hi_at, cells_at)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    ! The lattice cells whose centre is within `radius` of `centre`: a ball, in 2D a disc.
    function peri_add_ball(body, material, centre, radius, spacing, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: material
        real(c_double), intent(in), target, contiguous :: centre(:)
        real(c_double), intent(in) :: radius
        real(c_double), intent(in) :: spacing
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int64_t) :: result_
        type(c_ptr) :: centre_at
        type(peri_error) :: record
        result_ = PERI_ERROR_ARGUMENT
        if (size(centre) /= int(c_dimension(body%handle))) then
            call refused('centre', stat, errmsg)
            return
        end if
        centre_at = c_null_ptr
        if (size(centre) > 0) centre_at = c_loc(centre)
        result_ = c_add_ball(body%handle, material, centre_at, radius, spacing)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    ! The lattice cells of the box whose centre `inside` takes.
    function peri_add_shape(body, material, lo, hi, spacing, inside, user, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: material
        real(c_double), intent(in), target, contiguous :: lo(:)
        real(c_double), intent(in), target, contiguous :: hi(:)
        real(c_double), intent(in) :: spacing
        procedure(peri_point_fn) :: inside
        type(c_ptr), intent(in), optional :: user
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int64_t) :: result_
        type(c_ptr) :: lo_at
        type(c_ptr) :: hi_at
        type(c_funptr) :: inside_at
        type(peri_error) :: record
        result_ = PERI_ERROR_ARGUMENT
        if (size(lo) /= int(c_dimension(body%handle))) then
            call refused('lo', stat, errmsg)
            return
        end if
        lo_at = c_null_ptr
        if (size(lo) > 0) lo_at = c_loc(lo)
        if (size(hi) /= int(c_dimension(body%handle))) then
            call refused('hi', stat, errmsg)
            return
        end if
        hi_at = c_null_ptr
        if (size(hi) > 0) hi_at = c_loc(hi)
        inside_at = c_funloc(inside)
        result_ = c_add_shape(body%handle, material, lo_at, hi_at, spacing, inside_at, c_ptr_of(user))
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    ! peri_add_box, interior vertices moved by up to `amount` (0..1) quarters of a cell ([P] B).
    function peri_add_perturbed_box(body, material, lo, hi, spacing, amount, seed, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: material
        real(c_double), intent(in), target, contiguous :: lo(:)
        real(c_double), intent(in), target, contiguous :: hi(:)
        real(c_double), intent(in) :: spacing
        real(c_double), intent(in) :: amount
        integer(c_int64_t), intent(in) :: seed
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int64_t) :: result_
        type(c_ptr) :: lo_at
        type(c_ptr) :: hi_at
        type(peri_error) :: record
        result_ = PERI_ERROR_ARGUMENT
        if (size(lo) /= int(c_dimension(body%handle))) then
            call refused('lo', stat, errmsg)
            return
        end if
        lo_at = c_null_ptr
        if (size(lo) > 0) lo_at = c_loc(lo)
        if (size(hi) /= int(c_dimension(body%handle))) then
            call refused('hi', stat, errmsg)
            return
        end if
        hi_at = c_null_ptr
        if (size(hi) > 0) hi_at = c_loc(hi)
        result_ = c_add_perturbed_box(body%handle, material, lo_at, hi_at, spacing, amount, seed)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    ! Points of yours: positions[count*dim] [L], volumes[count] [L^3] (planes: areas [L^2]), materials[count] (ids), or NULL
    ! where the body has one material.
    function peri_add_points(body, positions, volumes, materials, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        real(c_double), intent(in), target, contiguous :: positions(:)
        real(c_double), intent(in), target, contiguous :: volumes(:)
        integer(c_int32_t), intent(in), optional, target, contiguous :: materials(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int64_t) :: result_
        type(c_ptr) :: positions_at
        type(c_ptr) :: volumes_at
        type(c_ptr) :: materials_at
        type(peri_error) :: record
        result_ = PERI_ERROR_ARGUMENT
        if (size(positions) /= size(volumes, kind=c_int64_t)*int(c_dimension(body%handle))) then
            call refused('positions', stat, errmsg)
            return
        end if
        positions_at = c_null_ptr
        if (size(positions) > 0) positions_at = c_loc(positions)
        volumes_at = c_null_ptr
        if (size(volumes) > 0) volumes_at = c_loc(volumes)
        if (present(materials)) then
            if (size(materials) /= size(volumes, kind=c_int64_t)) then
                call refused('materials', stat, errmsg)
                return
            end if
        end if
        materials_at = c_null_ptr
        if (present(materials)) materials_at = c_loc(materials)
        result_ = c_add_points(body%handle, size(volumes, kind=c_int64_t), positions_at, volumes_at, materials_at)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    subroutine peri_cells_desc_init(desc)
        type(peri_cells_desc), intent(out) :: desc
        call c_cells_desc_init(desc)
    end subroutine

    ! Each is a point at its centroid, with its volume; partial volumes are exact.
    function peri_add_cells(body, desc, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        type(peri_cells_desc), intent(in) :: desc
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int64_t) :: result_
        type(peri_error) :: record
        result_ = c_add_cells(body%handle, desc)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    ! Families of yours instead of a search: ibond[points*width] as in [T] 3.11, row i padded with i. Membership must be
    ! mutual. Weights are computed as for found families, of whose horizon they must be.
    subroutine peri_set_families(body, width, ibond, stat, errmsg)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: width
        integer(c_int32_t), intent(in), target, contiguous :: ibond(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_ptr) :: ibond_at
        type(peri_error) :: record
        if (size(ibond) /= c_point_count(body%handle)*width) then
            call refused('ibond', stat, errmsg)
            return
        end if
        ibond_at = c_null_ptr
        if (size(ibond) > 0) ibond_at = c_loc(ibond)
        result_ = c_set_families(body%handle, width, ibond_at)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    subroutine peri_part_desc_init(desc)
        type(peri_part_desc), intent(out) :: desc
        call c_part_desc_init(desc)
    end subroutine

    ! After the points, before peri_build. All parts make the same calls.
    subroutine peri_set_part(body, desc, stat, errmsg)
        type(peri_body), intent(in) :: body
        type(peri_part_desc), intent(in) :: desc
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(peri_error) :: record
        result_ = c_set_part(body%handle, desc)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! 1 or 2, before peri_build; the deepest that its materials need.
    subroutine peri_ghost_depth(body, stat, errmsg)
        type(peri_body), intent(in) :: body
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(peri_error) :: record
        result_ = c_ghost_depth(body%handle)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! H[dim*dim] [-] by rows: images have their owner's displacement + H (distance). Default 0
    subroutine peri_set_mean_gradient(body, gradient, stat, errmsg)
        type(peri_body), intent(in) :: body
        real(c_double), intent(in), target, contiguous :: gradient(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_ptr) :: gradient_at
        type(peri_error) :: record
        if (size(gradient) /= int(c_dimension(body%handle))) then
            call refused('gradient', stat, errmsg)
            return
        end if
        gradient_at = c_null_ptr
        if (size(gradient) > 0) gradient_at = c_loc(gradient)
        result_ = c_set_mean_gradient(body%handle, gradient_at)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! Of the cells of peri_add_box those from first[dim] to before last[dim].
    function peri_add_box_part(body, material, lo, hi, spacing, first, last, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: material
        real(c_double), intent(in), target, contiguous :: lo(:)
        real(c_double), intent(in), target, contiguous :: hi(:)
        real(c_double), intent(in) :: spacing
        integer(c_int32_t), intent(in), target, contiguous :: first(:)
        integer(c_int32_t), intent(in), target, contiguous :: last(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int64_t) :: result_
        type(c_ptr) :: lo_at
        type(c_ptr) :: hi_at
        type(c_ptr) :: first_at
        type(c_ptr) :: last_at
        type(peri_error) :: record
        result_ = PERI_ERROR_ARGUMENT
        if (size(lo) /= int(c_dimension(body%handle))) then
            call refused('lo', stat, errmsg)
            return
        end if
        lo_at = c_null_ptr
        if (size(lo) > 0) lo_at = c_loc(lo)
        if (size(hi) /= int(c_dimension(body%handle))) then
            call refused('hi', stat, errmsg)
            return
        end if
        hi_at = c_null_ptr
        if (size(hi) > 0) hi_at = c_loc(hi)
        if (size(first) /= int(c_dimension(body%handle))) then
            call refused('first', stat, errmsg)
            return
        end if
        first_at = c_null_ptr
        if (size(first) > 0) first_at = c_loc(first)
        if (size(last) /= int(c_dimension(body%handle))) then
            call refused('last', stat, errmsg)
            return
        end if
        last_at = c_null_ptr
        if (size(last) > 0) last_at = c_loc(last)
        result_ = c_add_box_part(body%handle, material, lo_at, hi_at, spacing, first_at, last_at)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    ! Finds the families, computes weights and constants, takes the state. Warns of rows of points, and of sheets of them in
    ! 3D: no constants are for these. After a failure the body is as it was: add what is missing and build again.
    subroutine peri_build(body, stat, errmsg)
        type(peri_body), intent(in) :: body
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(peri_error) :: record
        result_ = c_build(body%handle)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! 2 or 3
    function peri_dimension(body) result(result_)
        type(peri_body), intent(in) :: body
        integer(c_int32_t) :: result_
        result_ = c_dimension(body%handle)
    end function

    function peri_point_count(body) result(result_)
        type(peri_body), intent(in) :: body
        integer(c_int64_t) :: result_
        result_ = c_point_count(body%handle)
    end function

    ! size of the largest family
    function peri_family_width(body) result(result_)
        type(peri_body), intent(in) :: body
        integer(c_int32_t) :: result_
        result_ = c_family_width(body%handle)
    end function

    ! broken and cut ones included
    function peri_bond_count(body) result(result_)
        type(peri_body), intent(in) :: body
        integer(c_int64_t) :: result_
        result_ = c_bond_count(body%handle)
    end function

    ! of all families: twice the bonds
    function peri_entry_count(body) result(result_)
        type(peri_body), intent(in) :: body
        integer(c_int64_t) :: result_
        result_ = c_entry_count(body%handle)
    end function

    ! bonds of the initial cracks
    function peri_cut_count(body) result(result_)
        type(peri_body), intent(in) :: body
        integer(c_int64_t) :: result_
        result_ = c_cut_count(body%handle)
    end function

    ! bonds broken, or cut later
    function peri_broken_count(body) result(result_)
        type(peri_body), intent(in) :: body
        integer(c_int64_t) :: result_
        result_ = c_broken_count(body%handle)
    end function

    ! steps, load steps too, since reset
    function peri_step_count(body) result(result_)
        type(peri_body), intent(in) :: body
        integer(c_int64_t) :: result_
        result_ = c_step_count(body%handle)
    end function

    ! [T] since build or reset
    function peri_time(body) result(result_)
        type(peri_body), intent(in) :: body
        real(c_double) :: result_
        result_ = c_time(body%handle)
    end function

    ! that loads act with; 0 before any did
    function peri_load_factor(body) result(result_)
        type(peri_body), intent(in) :: body
        real(c_double) :: result_
        result_ = c_load_factor(body%handle)
    end function

    ! How bonds are worked on: "columns, AVX-512", "list, SSE2", "rows", "reference".
    function peri_kernel_text(body) result(result_)
        type(peri_body), intent(in) :: body
        character(:), allocatable :: result_
        call text_of(c_kernel_text(body%handle), result_)
    end function

    ! Largest stable time step [T], to 4 % at rest; of state-based bodies that can break, a bound. Takes 20 to 100 steps once:
    ! docs/accuracy.md. 0 before peri_build.
    function peri_stable_step(body) result(result_)
        type(peri_body), intent(in) :: body
        real(c_double) :: result_
        result_ = c_stable_step(body%handle)
    end function

    ! Rows [first, first+count) of the families ([T] 3.11) to rows[count*width]: ascending, padded with the row's own number;
    ! broken bonds are listed. capacity counts entries.
    subroutine peri_get_families(body, first, count, rows, stat, errmsg)
        type(peri_body), intent(in) :: body
        integer(c_int64_t), intent(in) :: first
        integer(c_int64_t), intent(in) :: count
        integer(c_int32_t), intent(inout), target, contiguous :: rows(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_ptr) :: rows_at
        type(peri_error) :: record
        rows_at = c_null_ptr
        if (size(rows) > 0) rows_at = c_loc(rows)
        result_ = c_get_families(body%handle, first, count, rows_at, size(rows, kind=c_int64_t))
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! The point nearest to x[dim] [L]; _in_place: where it is now.
    function peri_find_point(body, x, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        real(c_double), intent(in), target, contiguous :: x(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_ptr) :: x_at
        type(peri_error) :: record
        result_ = PERI_ERROR_ARGUMENT
        if (size(x) /= int(c_dimension(body%handle))) then
            call refused('x', stat, errmsg)
            return
        end if
        x_at = c_null_ptr
        if (size(x) > 0) x_at = c_loc(x)
        result_ = c_find_point(body%handle, x_at)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    ! The point nearest to x[dim] [L]; _in_place: where it is now.
    function peri_find_point_in_place(body, x, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        real(c_double), intent(in), target, contiguous :: x(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_ptr) :: x_at
        type(peri_error) :: record
        result_ = PERI_ERROR_ARGUMENT
        if (size(x) /= int(c_dimension(body%handle))) then
            call refused('x', stat, errmsg)
            return
        end if
        x_at = c_null_ptr
        if (size(x) > 0) x_at = c_loc(x)
        result_ = c_find_point_in_place(body%handle, x_at)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    ! 1: bond (i,j) carries force; 0: broken or cut; PERI_ERROR_PAIR: no such bond.
    function peri_bond_is_intact(body, i, j, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: i
        integer(c_int32_t), intent(in) :: j
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(peri_error) :: record
        result_ = c_bond_is_intact(body%handle, i, j)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    ! Motion, time, steps, load factor and ledger become zero, broken bonds whole. Initial cracks, sets, loads, obstacles and
    ! no-fail zones stay.
    subroutine peri_reset(body, stat, errmsg)
        type(peri_body), intent(in) :: body
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(peri_error) :: record
        result_ = c_reset(body%handle)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! name (copied) may be NULL. Reference positions; box and ball include their boundary to 1e-9 spacings.
    function peri_select_box(body, name, lo, hi, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        character(*), intent(in) :: name
        real(c_double), intent(in), target, contiguous :: lo(:)
        real(c_double), intent(in), target, contiguous :: hi(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        character(kind=c_char), target :: name_c(len(name) + 1)
        type(c_ptr) :: name_at
        type(c_ptr) :: lo_at
        type(c_ptr) :: hi_at
        type(peri_error) :: record
        result_ = PERI_ERROR_ARGUMENT
        name_c = c_text(name)
        name_at = c_loc(name_c(1))
        call optional_text(name_c, name_at)
        if (size(lo) /= int(c_dimension(body%handle))) then
            call refused('lo', stat, errmsg)
            return
        end if
        lo_at = c_null_ptr
        if (size(lo) > 0) lo_at = c_loc(lo)
        if (size(hi) /= int(c_dimension(body%handle))) then
            call refused('hi', stat, errmsg)
            return
        end if
        hi_at = c_null_ptr
        if (size(hi) > 0) hi_at = c_loc(hi)
        result_ = c_select_box(body%handle, name_at, lo_at, hi_at)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    ! name (copied) may be NULL. Reference positions; box and ball include their boundary to 1e-9 spacings.
    function peri_select_ball(body, name, centre, radius, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        character(*), intent(in) :: name
        real(c_double), intent(in), target, contiguous :: centre(:)
        real(c_double), intent(in) :: radius
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        character(kind=c_char), target :: name_c(len(name) + 1)
        type(c_ptr) :: name_at
        type(c_ptr) :: centre_at
        type(peri_error) :: record
        result_ = PERI_ERROR_ARGUMENT
        name_c = c_text(name)
        name_at = c_loc(name_c(1))
        call optional_text(name_c, name_at)
        if (size(centre) /= int(c_dimension(body%handle))) then
            call refused('centre', stat, errmsg)
            return
        end if
        centre_at = c_null_ptr
        if (size(centre) > 0) centre_at = c_loc(centre)
        result_ = c_select_ball(body%handle, name_at, centre_at, radius)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    ! By present positions.
    function peri_select_box_in_place(body, name, lo, hi, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        character(*), intent(in) :: name
        real(c_double), intent(in), target, contiguous :: lo(:)
        real(c_double), intent(in), target, contiguous :: hi(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        character(kind=c_char), target :: name_c(len(name) + 1)
        type(c_ptr) :: name_at
        type(c_ptr) :: lo_at
        type(c_ptr) :: hi_at
        type(peri_error) :: record
        result_ = PERI_ERROR_ARGUMENT
        name_c = c_text(name)
        name_at = c_loc(name_c(1))
        call optional_text(name_c, name_at)
        if (size(lo) /= int(c_dimension(body%handle))) then
            call refused('lo', stat, errmsg)
            return
        end if
        lo_at = c_null_ptr
        if (size(lo) > 0) lo_at = c_loc(lo)
        if (size(hi) /= int(c_dimension(body%handle))) then
            call refused('hi', stat, errmsg)
            return
        end if
        hi_at = c_null_ptr
        if (size(hi) > 0) hi_at = c_loc(hi)
        result_ = c_select_box_in_place(body%handle, name_at, lo_at, hi_at)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    ! By present positions.
    function peri_select_ball_in_place(body, name, centre, radius, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        character(*), intent(in) :: name
        real(c_double), intent(in), target, contiguous :: centre(:)
        real(c_double), intent(in) :: radius
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        character(kind=c_char), target :: name_c(len(name) + 1)
        type(c_ptr) :: name_at
        type(c_ptr) :: centre_at
        type(peri_error) :: record
        result_ = PERI_ERROR_ARGUMENT
        name_c = c_text(name)
        name_at = c_loc(name_c(1))
        call optional_text(name_c, name_at)
        if (size(centre) /= int(c_dimension(body%handle))) then
            call refused('centre', stat, errmsg)
            return
        end if
        centre_at = c_null_ptr
        if (size(centre) > 0) centre_at = c_loc(centre)
        result_ = c_select_ball_in_place(body%handle, name_at, centre_at, radius)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    function peri_select_if(body, name, take, user, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        character(*), intent(in) :: name
        procedure(peri_point_fn) :: take
        type(c_ptr), intent(in), optional :: user
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        character(kind=c_char), target :: name_c(len(name) + 1)
        type(c_ptr) :: name_at
        type(c_funptr) :: take_at
        type(peri_error) :: record
        name_c = c_text(name)
        name_at = c_loc(name_c(1))
        call optional_text(name_c, name_at)
        take_at = c_funloc(take)
        result_ = c_select_if(body%handle, name_at, take_at, c_ptr_of(user))
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    function peri_select_points(body, name, points, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        character(*), intent(in) :: name
        integer(c_int32_t), intent(in), target, contiguous :: points(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        character(kind=c_char), target :: name_c(len(name) + 1)
        type(c_ptr) :: name_at
        type(c_ptr) :: points_at
        type(peri_error) :: record
        name_c = c_text(name)
        name_at = c_loc(name_c(1))
        call optional_text(name_c, name_at)
        points_at = c_null_ptr
        if (size(points) > 0) points_at = c_loc(points)
        result_ = c_select_points(body%handle, name_at, size(points, kind=c_int64_t), points_at)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    ! id, or PERI_ERROR_NAME
    function peri_find_set(body, name, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        character(*), intent(in) :: name
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        character(kind=c_char), target :: name_c(len(name) + 1)
        type(c_ptr) :: name_at
        type(peri_error) :: record
        name_c = c_text(name)
        name_at = c_loc(name_c(1))
        result_ = c_find_set(body%handle, name_at)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    ! id, or PERI_ERROR_NAME
    function peri_size_of_set(body, set, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: set
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int64_t) :: result_
        type(peri_error) :: record
        result_ = c_size_of_set(body%handle, set)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    ! id, or PERI_ERROR_NAME
    subroutine peri_get_set(body, set, points, stat, errmsg)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: set
        integer(c_int32_t), intent(inout), target, contiguous :: points(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_ptr) :: points_at
        type(peri_error) :: record
        points_at = c_null_ptr
        if (size(points) > 0) points_at = c_loc(points)
        result_ = c_get_set(body%handle, set, points_at, size(points, kind=c_int64_t))
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a spacing. Returns
    ! the number of bonds newly cut. 2D
    function peri_cut_segment(body, standing, from, to, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: standing
        real(c_double), intent(in), target, contiguous :: from(:)
        real(c_double), intent(in), target, contiguous :: to(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int64_t) :: result_
        type(c_ptr) :: from_at
        type(c_ptr) :: to_at
        type(peri_error) :: record
        result_ = PERI_ERROR_ARGUMENT
        if (size(from) /= int(c_dimension(body%handle))) then
            call refused('from', stat, errmsg)
            return
        end if
        from_at = c_null_ptr
        if (size(from) > 0) from_at = c_loc(from)
        if (size(to) /= int(c_dimension(body%handle))) then
            call refused('to', stat, errmsg)
            return
        end if
        to_at = c_null_ptr
        if (size(to) > 0) to_at = c_loc(to)
        result_ = c_cut_segment(body%handle, standing, from_at, to_at)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    ! Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a spacing. Returns
    ! the number of bonds newly cut. 2D, [count*2]
    function peri_cut_polyline(body, standing, vertices, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: standing
        real(c_double), intent(in), target, contiguous :: vertices(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int64_t) :: result_
        type(c_ptr) :: vertices_at
        type(peri_error) :: record
        result_ = PERI_ERROR_ARGUMENT
        if (mod(size(vertices), 2) /= 0) then
            call refused('vertices', stat, errmsg)
            return
        end if
        vertices_at = c_null_ptr
        if (size(vertices) > 0) vertices_at = c_loc(vertices)
        result_ = c_cut_polyline(body%handle, standing, size(vertices, kind=c_int64_t)/(2), vertices_at)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    ! Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a spacing. Returns
    ! the number of bonds newly cut. 3D
    function peri_cut_disc(body, standing, centre, normal, radius, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: standing
        real(c_double), intent(in), target, contiguous :: centre(:)
        real(c_double), intent(in), target, contiguous :: normal(:)
        real(c_double), intent(in) :: radius
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int64_t) :: result_
        type(c_ptr) :: centre_at
        type(c_ptr) :: normal_at
        type(peri_error) :: record
        result_ = PERI_ERROR_ARGUMENT
        if (size(centre) /= int(c_dimension(body%handle))) then
            call refused('centre', stat, errmsg)
            return
        end if
        centre_at = c_null_ptr
        if (size(centre) > 0) centre_at = c_loc(centre)
        if (size(normal) /= int(c_dimension(body%handle))) then
            call refused('normal', stat, errmsg)
            return
        end if
        normal_at = c_null_ptr
        if (size(normal) > 0) normal_at = c_loc(normal)
        result_ = c_cut_disc(body%handle, standing, centre_at, normal_at, radius)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    ! Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a spacing. Returns
    ! the number of bonds newly cut. 3D
    function peri_cut_triangle(body, standing, p, q, r, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: standing
        real(c_double), intent(in), target, contiguous :: p(:)
        real(c_double), intent(in), target, contiguous :: q(:)
        real(c_double), intent(in), target, contiguous :: r(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int64_t) :: result_
        type(c_ptr) :: p_at
        type(c_ptr) :: q_at
        type(c_ptr) :: r_at
        type(peri_error) :: record
        result_ = PERI_ERROR_ARGUMENT
        if (size(p) /= int(c_dimension(body%handle))) then
            call refused('p', stat, errmsg)
            return
        end if
        p_at = c_null_ptr
        if (size(p) > 0) p_at = c_loc(p)
        if (size(q) /= int(c_dimension(body%handle))) then
            call refused('q', stat, errmsg)
            return
        end if
        q_at = c_null_ptr
        if (size(q) > 0) q_at = c_loc(q)
        if (size(r) /= int(c_dimension(body%handle))) then
            call refused('r', stat, errmsg)
            return
        end if
        r_at = c_null_ptr
        if (size(r) > 0) r_at = c_loc(r)
        result_ = c_cut_triangle(body%handle, standing, p_at, q_at, r_at)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    ! Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a spacing. Returns
    ! the number of bonds newly cut. 3D, or parallelogram
    function peri_cut_rectangle(body, standing, corner, edge1, edge2, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: standing
        real(c_double), intent(in), target, contiguous :: corner(:)
        real(c_double), intent(in), target, contiguous :: edge1(:)
        real(c_double), intent(in), target, contiguous :: edge2(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int64_t) :: result_
        type(c_ptr) :: corner_at
        type(c_ptr) :: edge1_at
        type(c_ptr) :: edge2_at
        type(peri_error) :: record
        result_ = PERI_ERROR_ARGUMENT
        if (size(corner) /= int(c_dimension(body%handle))) then
            call refused('corner', stat, errmsg)
            return
        end if
        corner_at = c_null_ptr
        if (size(corner) > 0) corner_at = c_loc(corner)
        if (size(edge1) /= int(c_dimension(body%handle))) then
            call refused('edge1', stat, errmsg)
            return
        end if
        edge1_at = c_null_ptr
        if (size(edge1) > 0) edge1_at = c_loc(edge1)
        if (size(edge2) /= int(c_dimension(body%handle))) then
            call refused('edge2', stat, errmsg)
            return
        end if
        edge2_at = c_null_ptr
        if (size(edge2) > 0) edge2_at = c_loc(edge2)
        result_ = c_cut_rectangle(body%handle, standing, corner_at, edge1_at, edge2_at)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    ! Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a spacing. Returns
    ! the number of bonds newly cut. [count*2] points; each pair must be a bond
    function peri_cut_pairs(body, standing, pairs, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: standing
        integer(c_int32_t), intent(in), target, contiguous :: pairs(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int64_t) :: result_
        type(c_ptr) :: pairs_at
        type(peri_error) :: record
        result_ = PERI_ERROR_ARGUMENT
        if (mod(size(pairs), 2) /= 0) then
            call refused('pairs', stat, errmsg)
            return
        end if
        pairs_at = c_null_ptr
        if (size(pairs) > 0) pairs_at = c_loc(pairs)
        result_ = c_cut_pairs(body%handle, standing, size(pairs, kind=c_int64_t)/(2), pairs_at)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    ! Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a spacing. Returns
    ! the number of bonds newly cut.
    function peri_cut_if(body, standing, cut, user, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: standing
        procedure(peri_pair_fn) :: cut
        type(c_ptr), intent(in), optional :: user
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int64_t) :: result_
        type(c_funptr) :: cut_at
        type(peri_error) :: record
        cut_at = c_funloc(cut)
        result_ = c_cut_if(body%handle, standing, cut_at, c_ptr_of(user))
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    ! Bonds with an end in the set never break by a criterion (on = 1), or may again (0). Cuts still cut.
    subroutine peri_set_no_fail(body, set, on, stat, errmsg)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: set
        integer(c_int32_t), intent(in) :: on
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(peri_error) :: record
        result_ = c_set_no_fail(body%handle, set, on)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! fn is called for every bond that breaks by its criterion; NULL removes. Costs two to three bits per bond.
    subroutine peri_on_break(body, fn, user, stat, errmsg)
        type(peri_body), intent(in) :: body
        procedure(peri_break_fn), optional :: fn
        type(c_ptr), intent(in), optional :: user
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_funptr) :: fn_at
        type(peri_error) :: record
        fn_at = c_null_funptr
        if (present(fn)) fn_at = c_funloc(fn)
        result_ = c_on_break(body%handle, fn_at, c_ptr_of(user))
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! Strength of bonds, times that of points: factors[count] of pairs[count*2], or of intact bonds that `take` takes. Returns
    ! how many.
    function peri_set_strength_pairs(body, pairs, factors, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in), target, contiguous :: pairs(:)
        real(c_double), intent(in), target, contiguous :: factors(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int64_t) :: result_
        type(c_ptr) :: pairs_at
        type(c_ptr) :: factors_at
        type(peri_error) :: record
        result_ = PERI_ERROR_ARGUMENT
        if (size(pairs) /= size(factors, kind=c_int64_t)*2) then
            call refused('pairs', stat, errmsg)
            return
        end if
        pairs_at = c_null_ptr
        if (size(pairs) > 0) pairs_at = c_loc(pairs)
        factors_at = c_null_ptr
        if (size(factors) > 0) factors_at = c_loc(factors)
        result_ = c_set_strength_pairs(body%handle, size(factors, kind=c_int64_t), pairs_at, factors_at)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    ! Strength of bonds, times that of points: factors[count] of pairs[count*2], or of intact bonds that `take` takes. Returns
    ! how many.
    function peri_set_strength_if(body, factor, take, user, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        real(c_double), intent(in) :: factor
        procedure(peri_pair_fn) :: take
        type(c_ptr), intent(in), optional :: user
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int64_t) :: result_
        type(c_funptr) :: take_at
        type(peri_error) :: record
        take_at = c_funloc(take)
        result_ = c_set_strength_if(body%handle, factor, take_at, c_ptr_of(user))
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    ! on = 1: keeps when bonds between adjacent points break, for peri_get_cracks: 32 to 44 bytes per point.
    subroutine peri_record_breaks(body, on, stat, errmsg)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: on
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(peri_error) :: record
        result_ = c_record_breaks(body%handle, on)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! How many there are, and which each point is in: of_point[points], or NULL. They are numbered 0, 1, ... by their least
    ! points when first asked for. Of one that has split since, the piece of most points keeps the number; the others get the
    ! next ones. Free where no bond broke.
    function peri_find_fragments(body, of_point, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(inout), optional, target, contiguous :: of_point(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int64_t) :: result_
        type(c_ptr) :: of_point_at
        integer(c_int64_t) :: capacity_
        type(peri_error) :: record
        of_point_at = c_null_ptr
        if (present(of_point)) of_point_at = c_loc(of_point)
        capacity_ = 0
        if (present(of_point)) capacity_ = size(of_point, kind=c_int64_t)
        result_ = c_find_fragments(body%handle, of_point_at, capacity_)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    ! out[k] is fragment k.
    subroutine peri_get_fragments(body, out, stat, errmsg)
        type(peri_body), intent(in) :: body
        type(peri_fragment), intent(inout), target, contiguous :: out(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_ptr) :: out_at
        type(peri_error) :: record
        out_at = c_null_ptr
        if (size(out) > 0) out_at = c_loc(out)
        result_ = c_get_fragments(body%handle, out_at, size(out, kind=c_int64_t))
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! The closed surface of a fragment, or of all (-1), now, by cells. vertices[][dim] [L]; faces[][dim] of vertices: in 2D
    ! edges with the fragment on the left, loop by loop, edge k from vertex k on; in 3D triangles, counter-clockwise from
    ! outside. owners[], or NULL: its point; inner[], or NULL: 1 where a crack made it. Points and cells of yours are squares
    ! or cubes.
    subroutine peri_size_of_outline(body, fragment, vertices, faces, stat, errmsg)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: fragment
        integer(c_int64_t), intent(out), target :: vertices
        integer(c_int64_t), intent(out), target :: faces
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(peri_error) :: record
        result_ = c_size_of_outline(body%handle, fragment, c_loc(vertices), c_loc(faces))
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! The closed surface of a fragment, or of all (-1), now, by cells. vertices[][dim] [L]; faces[][dim] of vertices: in 2D
    ! edges with the fragment on the left, loop by loop, edge k from vertex k on; in 3D triangles, counter-clockwise from
    ! outside. owners[], or NULL: its point; inner[], or NULL: 1 where a crack made it. Points and cells of yours are squares
    ! or cubes.
    subroutine peri_get_outline(body, fragment, vertices, faces, owners, inner, stat, errmsg)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: fragment
        real(c_double), intent(inout), target, contiguous :: vertices(:)
        integer(c_int32_t), intent(inout), target, contiguous :: faces(:)
        integer(c_int32_t), intent(inout), optional, target, contiguous :: owners(:)
        integer(c_int32_t), intent(inout), optional, target, contiguous :: inner(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_ptr) :: vertices_at
        type(c_ptr) :: faces_at
        type(c_ptr) :: owners_at
        type(c_ptr) :: inner_at
        type(peri_error) :: record
        if (mod(size(vertices), int(c_dimension(body%handle))) /= 0) then
            call refused('vertices', stat, errmsg)
            return
        end if
        vertices_at = c_null_ptr
        if (size(vertices) > 0) vertices_at = c_loc(vertices)
        if (mod(size(faces), int(c_dimension(body%handle))) /= 0) then
            call refused('faces', stat, errmsg)
            return
        end if
        faces_at = c_null_ptr
        if (size(faces) > 0) faces_at = c_loc(faces)
        if (present(owners)) then
            if (size(owners) /= size(faces, kind=c_int64_t)/(int(c_dimension(body%handle)))) then
                call refused('owners', stat, errmsg)
                return
            end if
        end if
        owners_at = c_null_ptr
        if (present(owners)) owners_at = c_loc(owners)
        if (present(inner)) then
            if (size(inner) /= size(faces, kind=c_int64_t)/(int(c_dimension(body%handle)))) then
                call refused('inner', stat, errmsg)
                return
            end if
        end if
        inner_at = c_null_ptr
        if (present(inner)) inner_at = c_loc(inner)
        result_ = c_get_outline(body%handle, fragment, vertices_at, size(vertices, &
            kind=c_int64_t)/(int(c_dimension(body%handle))), faces_at, owners_at, inner_at, size(faces, &
            kind=c_int64_t)/(int(c_dimension(body%handle))))
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! Add value[dim] to the displacement [L] or velocity [L T^-1] of a set, now; peri_reset clears both. Sums are below 1e15
    ! spacings, 1e9 speeds of sound.
    subroutine peri_add_displacement(body, set, value, stat, errmsg)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: set
        real(c_double), intent(in), target, contiguous :: value(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_ptr) :: value_at
        type(peri_error) :: record
        if (size(value) /= int(c_dimension(body%handle))) then
            call refused('value', stat, errmsg)
            return
        end if
        value_at = c_null_ptr
        if (size(value) > 0) value_at = c_loc(value)
        result_ = c_add_displacement(body%handle, set, value_at)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! Add value[dim] to the displacement [L] or velocity [L T^-1] of a set, now; peri_reset clears both. Sums are below 1e15
    ! spacings, 1e9 speeds of sound.
    subroutine peri_add_velocity(body, set, value, stat, errmsg)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: set
        real(c_double), intent(in), target, contiguous :: value(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_ptr) :: value_at
        type(peri_error) :: record
        if (size(value) /= int(c_dimension(body%handle))) then
            call refused('value', stat, errmsg)
            return
        end if
        value_at = c_null_ptr
        if (size(value) > 0) value_at = c_loc(value)
        result_ = c_add_velocity(body%handle, set, value_at)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! Supports: prescribe the `axes` of displacement [L] or velocity [L T^-1] of a set: value[dim] (NULL = zero), or as fn says
    ! (may be NULL). Later supports win. The load factor multiplies a constant displacement, not a velocity. A grip should be a
    ! horizon deep, of state-based laws two.
    function peri_prescribe_displacement(body, set, axes, value, fn, user, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: set
        integer(c_int32_t), intent(in) :: axes
        real(c_double), intent(in), optional, target, contiguous :: value(:)
        procedure(peri_load_fn), optional :: fn
        type(c_ptr), intent(in), optional :: user
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_ptr) :: value_at
        type(c_funptr) :: fn_at
        type(peri_error) :: record
        result_ = PERI_ERROR_ARGUMENT
        if (present(value)) then
            if (size(value) /= int(c_dimension(body%handle))) then
                call refused('value', stat, errmsg)
                return
            end if
        end if
        value_at = c_null_ptr
        if (present(value)) value_at = c_loc(value)
        fn_at = c_null_funptr
        if (present(fn)) fn_at = c_funloc(fn)
        result_ = c_prescribe_displacement(body%handle, set, axes, value_at, fn_at, c_ptr_of(user))
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    ! Supports: prescribe the `axes` of displacement [L] or velocity [L T^-1] of a set: value[dim] (NULL = zero), or as fn says
    ! (may be NULL). Later supports win. The load factor multiplies a constant displacement, not a velocity. A grip should be a
    ! horizon deep, of state-based laws two.
    function peri_prescribe_velocity(body, set, axes, value, fn, user, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: set
        integer(c_int32_t), intent(in) :: axes
        real(c_double), intent(in), optional, target, contiguous :: value(:)
        procedure(peri_load_fn), optional :: fn
        type(c_ptr), intent(in), optional :: user
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_ptr) :: value_at
        type(c_funptr) :: fn_at
        type(peri_error) :: record
        result_ = PERI_ERROR_ARGUMENT
        if (present(value)) then
            if (size(value) /= int(c_dimension(body%handle))) then
                call refused('value', stat, errmsg)
                return
            end if
        end if
        value_at = c_null_ptr
        if (present(value)) value_at = c_loc(value)
        fn_at = c_null_funptr
        if (present(fn)) fn_at = c_funloc(fn)
        result_ = c_prescribe_velocity(body%handle, set, axes, value_at, fn_at, c_ptr_of(user))
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    ! Support: the set moves as a rigid body. motion: displacement [L], then in 2D the angle about centre[dim], in 3D a vector
    ! along the axis as long as the angle; NULL: 0. The load factor multiplies it; or fn writes it (may be NULL).
    function peri_prescribe_rigid(body, set, centre, motion, fn, user, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: set
        real(c_double), intent(in), target, contiguous :: centre(:)
        real(c_double), intent(in), optional, target, contiguous :: motion(:)
        procedure(peri_rigid_fn), optional :: fn
        type(c_ptr), intent(in), optional :: user
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_ptr) :: centre_at
        type(c_ptr) :: motion_at
        type(c_funptr) :: fn_at
        type(peri_error) :: record
        result_ = PERI_ERROR_ARGUMENT
        if (size(centre) /= int(c_dimension(body%handle))) then
            call refused('centre', stat, errmsg)
            return
        end if
        centre_at = c_null_ptr
        if (size(centre) > 0) centre_at = c_loc(centre)
        if (present(motion)) then
            if (size(motion) /= int(c_dimension(body%handle))+(2*int(c_dimension(body%handle)) - 3)) then
                call refused('motion', stat, errmsg)
                return
            end if
        end if
        motion_at = c_null_ptr
        if (present(motion)) motion_at = c_loc(motion)
        fn_at = c_null_funptr
        if (present(fn)) fn_at = c_funloc(fn)
        result_ = c_prescribe_rigid(body%handle, set, centre_at, motion_at, fn_at, c_ptr_of(user))
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    ! Body force density value[dim] [M L^-2 T^-2] on a set; gravity is density times g.
    function peri_apply_body_force(body, set, value, fn, user, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: set
        real(c_double), intent(in), target, contiguous :: value(:)
        procedure(peri_load_fn), optional :: fn
        type(c_ptr), intent(in), optional :: user
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_ptr) :: value_at
        type(c_funptr) :: fn_at
        type(peri_error) :: record
        result_ = PERI_ERROR_ARGUMENT
        if (size(value) /= int(c_dimension(body%handle))) then
            call refused('value', stat, errmsg)
            return
        end if
        value_at = c_null_ptr
        if (size(value) > 0) value_at = c_loc(value)
        fn_at = c_null_funptr
        if (present(fn)) fn_at = c_funloc(fn)
        result_ = c_apply_body_force(body%handle, set, value_at, fn_at, c_ptr_of(user))
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    ! Traction value[dim] [M L^-1 T^-2] on a flat face of `area` [L^2] (2D: length [L]) and outward `normal`. The set: all
    ! points within two horizons of it, of one material. Uniform stress is exact for correspondence; else the total is, and
    ! strain is off by O(horizon). ([C] 2.5, docs/statics.md)
    function peri_apply_traction(body, set, area, normal, value, fn, user, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: set
        real(c_double), intent(in) :: area
        real(c_double), intent(in), target, contiguous :: normal(:)
        real(c_double), intent(in), target, contiguous :: value(:)
        procedure(peri_load_fn), optional :: fn
        type(c_ptr), intent(in), optional :: user
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_ptr) :: normal_at
        type(c_ptr) :: value_at
        type(c_funptr) :: fn_at
        type(peri_error) :: record
        result_ = PERI_ERROR_ARGUMENT
        if (size(normal) /= int(c_dimension(body%handle))) then
            call refused('normal', stat, errmsg)
            return
        end if
        normal_at = c_null_ptr
        if (size(normal) > 0) normal_at = c_loc(normal)
        if (size(value) /= int(c_dimension(body%handle))) then
            call refused('value', stat, errmsg)
            return
        end if
        value_at = c_null_ptr
        if (size(value) > 0) value_at = c_loc(value)
        fn_at = c_null_funptr
        if (present(fn)) fn_at = c_funloc(fn)
        result_ = c_apply_traction(body%handle, set, area, normal_at, value_at, fn_at, c_ptr_of(user))
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    ! A total of value*area (in 2D times the thickness), spread over the set by volume: on the outermost layer, say. Exact in
    ! sum, but strain near the face is wrong by O(1) ([C] 2.5).
    function peri_apply_layer_traction(body, set, area, value, fn, user, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: set
        real(c_double), intent(in) :: area
        real(c_double), intent(in), target, contiguous :: value(:)
        procedure(peri_load_fn), optional :: fn
        type(c_ptr), intent(in), optional :: user
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_ptr) :: value_at
        type(c_funptr) :: fn_at
        type(peri_error) :: record
        result_ = PERI_ERROR_ARGUMENT
        if (size(value) /= int(c_dimension(body%handle))) then
            call refused('value', stat, errmsg)
            return
        end if
        value_at = c_null_ptr
        if (size(value) > 0) value_at = c_loc(value)
        fn_at = c_null_funptr
        if (present(fn)) fn_at = c_funloc(fn)
        result_ = c_apply_layer_traction(body%handle, set, area, value_at, fn_at, c_ptr_of(user))
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    ! Pressure [M L^-1 T^-2] on all surfaces of a set, faces of cracks included ([C] 2.6): for a crack select the points within
    ! two horizons of it. fn: value[k*dim] is the pressure on point k.
    function peri_apply_pressure(body, set, pressure, fn, user, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: set
        real(c_double), intent(in) :: pressure
        procedure(peri_load_fn), optional :: fn
        type(c_ptr), intent(in), optional :: user
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_funptr) :: fn_at
        type(peri_error) :: record
        fn_at = c_null_funptr
        if (present(fn)) fn_at = c_funloc(fn)
        result_ = c_apply_pressure(body%handle, set, pressure, fn_at, c_ptr_of(user))
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    ! As [C] 2.6 has it: through the cut bonds between neighbouring points.
    function peri_apply_bond_pressure_for_comparison(body, set, pressure, fn, user, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: set
        real(c_double), intent(in) :: pressure
        procedure(peri_load_fn), optional :: fn
        type(c_ptr), intent(in), optional :: user
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_funptr) :: fn_at
        type(peri_error) :: record
        fn_at = c_null_funptr
        if (present(fn)) fn_at = c_funloc(fn)
        result_ = c_apply_bond_pressure_for_comparison(body%handle, set, pressure, fn_at, c_ptr_of(user))
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    ! ids are not used twice
    subroutine peri_remove_load(body, load, stat, errmsg)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: load
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(peri_error) :: record
        result_ = c_remove_load(body%handle, load)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! Force [M L T^-2] to force[dim]: of a support on the body, mean of the last step (or of the equilibrium); of a load, its
    ! present total.
    subroutine peri_get_reaction(body, load, force, stat, errmsg)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: load
        real(c_double), intent(inout), target, contiguous :: force(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_ptr) :: force_at
        type(peri_error) :: record
        if (size(force) /= int(c_dimension(body%handle))) then
            call refused('force', stat, errmsg)
            return
        end if
        force_at = c_null_ptr
        if (size(force) > 0) force_at = c_loc(force)
        result_ = c_get_reaction(body%handle, load, force_at)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! Its moment about place[dim] [M L^2 T^-2] to moment[1] (2D) or [3].
    subroutine peri_get_reaction_moment(body, load, place, moment, stat, errmsg)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: load
        real(c_double), intent(in), target, contiguous :: place(:)
        real(c_double), intent(inout), target, contiguous :: moment(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_ptr) :: place_at
        type(c_ptr) :: moment_at
        type(peri_error) :: record
        if (size(place) /= int(c_dimension(body%handle))) then
            call refused('place', stat, errmsg)
            return
        end if
        place_at = c_null_ptr
        if (size(place) > 0) place_at = c_loc(place)
        if (size(moment) /= (2*int(c_dimension(body%handle)) - 3)) then
            call refused('moment', stat, errmsg)
            return
        end if
        moment_at = c_null_ptr
        if (size(moment) > 0) moment_at = c_loc(moment)
        result_ = c_get_reaction_moment(body%handle, load, place_at, moment_at)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    subroutine peri_obstacle_desc_init(desc, shape)
        type(peri_obstacle_desc), intent(out) :: desc
        integer(c_int32_t), intent(in) :: shape
        call c_obstacle_desc_init(desc, shape)
    end subroutine

    ! A mesh is copied, and must be closed.
    function peri_add_obstacle(body, desc, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        type(peri_obstacle_desc), intent(in) :: desc
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(peri_error) :: record
        result_ = c_add_obstacle(body%handle, desc)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    ! A mesh is copied, and must be closed.
    subroutine peri_remove_obstacle(body, obstacle, stat, errmsg)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: obstacle
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(peri_error) :: record
        result_ = c_remove_obstacle(body%handle, obstacle)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! On the body: force[dim] [M L T^-2]; moment[3], in 2D [1], [M L^2 T^-2] about its place. Either may be NULL.
    subroutine peri_get_obstacle_force(body, obstacle, force, moment, stat, errmsg)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: obstacle
        real(c_double), intent(inout), optional, target, contiguous :: force(:)
        real(c_double), intent(inout), optional, target, contiguous :: moment(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_ptr) :: force_at
        type(c_ptr) :: moment_at
        type(peri_error) :: record
        if (present(force)) then
            if (size(force) /= int(c_dimension(body%handle))) then
                call refused('force', stat, errmsg)
                return
            end if
        end if
        force_at = c_null_ptr
        if (present(force)) force_at = c_loc(force)
        if (present(moment)) then
            if (size(moment) /= (2*int(c_dimension(body%handle)) - 3)) then
                call refused('moment', stat, errmsg)
                return
            end if
        end if
        moment_at = c_null_ptr
        if (present(moment)) moment_at = c_loc(moment)
        result_ = c_get_obstacle_force(body%handle, obstacle, force_at, moment_at)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    subroutine peri_get_obstacle_state(body, obstacle, state, stat, errmsg)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: obstacle
        type(peri_obstacle_state), intent(inout) :: state
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(peri_error) :: record
        result_ = c_get_obstacle_state(body%handle, obstacle, state)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! Sets place, turn, velocity and spin of a free one.
    subroutine peri_set_obstacle_state(body, obstacle, state, stat, errmsg)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: obstacle
        type(peri_obstacle_state), intent(in) :: state
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(peri_error) :: record
        result_ = c_set_obstacle_state(body%handle, obstacle, state)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    subroutine peri_contact_desc_init(desc)
        type(peri_contact_desc), intent(out) :: desc
        call c_contact_desc_init(desc)
    end subroutine

    ! Of materials i and j, ids or PERI_ALL; NULL: none.
    subroutine peri_set_contact(body, i, j, desc, stat, errmsg)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: i
        integer(c_int32_t), intent(in) :: j
        type(peri_contact_desc), intent(in), optional, target :: desc
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_ptr) :: desc_at
        type(peri_error) :: record
        desc_at = c_null_ptr
        if (present(desc)) desc_at = c_loc(desc)
        result_ = c_set_contact(body%handle, i, j, desc_at)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    subroutine peri_advance_desc_init(desc)
        type(peri_advance_desc), intent(out) :: desc
        call c_advance_desc_init(desc)
    end subroutine

    ! Advances the body in time. PERI_ERROR_STEP: it ends at a whole step; the value is what may follow. So does
    ! PERI_ERROR_CALLBACK of a peri_frame_fn or peri_break_fn. PERI_ERROR_UNSTABLE, and PERI_ERROR_CALLBACK of a load or
    ! obstacle (index: the point): it ended within a step; read it, then reset or destroy it.
    subroutine peri_advance(body, desc, stat, errmsg)
        type(peri_body), intent(in) :: body
        type(peri_advance_desc), intent(in) :: desc
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(peri_error) :: record
        result_ = c_advance(body%handle, desc)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    subroutine peri_evaluate_desc_init(desc)
        type(peri_evaluate_desc), intent(out) :: desc
        call c_evaluate_desc_init(desc)
    end subroutine

    ! Forces at a displacement of yours. A step, rho of PERI_FIELD_DENSITY: v += dt/2 force/rho, u += dt v, peri_evaluate, v +=
    ! (dt/2 force + impulse)/rho. report may be NULL.
    subroutine peri_evaluate(body, desc, report, stat, errmsg)
        type(peri_body), intent(in) :: body
        type(peri_evaluate_desc), intent(in) :: desc
        type(peri_evaluate_report), intent(inout), optional, target :: report
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_ptr) :: report_at
        type(peri_error) :: record
        report_at = c_null_ptr
        if (present(report)) report_at = c_loc(report)
        result_ = c_evaluate(body%handle, desc, report_at)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    subroutine peri_solve_desc_init(desc)
        type(peri_solve_desc), intent(out) :: desc
        call c_solve_desc_init(desc)
    end subroutine

    ! Equilibrium under supports and loads, constant values times a factor from load_from to load_to, callbacks at time =
    ! factor, prescribed velocities at rest; bonds over their limit break until none does. A later run goes on at load_to. A
    ! failed step leaves the last equilibrium, or, after breaks, how far it came; so does PERI_ENDED_SEVERED.
    subroutine peri_solve(body, desc, report, stat, errmsg)
        type(peri_body), intent(in) :: body
        type(peri_solve_desc), intent(in) :: desc
        type(peri_solve_report), intent(inout) :: report
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(peri_error) :: record
        result_ = c_solve(body%handle, desc, report)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! peri_advance by implicit steps, `time_step` > 0 of any size (generalised alpha, order 2). rho [0, 1]: what is left of the
    ! highest modes per step; 1 keeps the energy. solve: tolerance, fracture, limits, on_iteration; NULL: defaults. No
    ! obstacles or contact. A step that fails leaves the last one, less the bonds that broke in it. report may be NULL.
    subroutine peri_advance_implicit(body, advance, solve, rho, report, stat, errmsg)
        type(peri_body), intent(in) :: body
        type(peri_advance_desc), intent(in) :: advance
        type(peri_solve_desc), intent(in) :: solve
        real(c_double), intent(in) :: rho
        type(peri_solve_report), intent(inout), optional, target :: report
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_ptr) :: report_at
        type(peri_error) :: record
        report_at = c_null_ptr
        if (present(report)) report_at = c_loc(report)
        result_ = c_advance_implicit(body%handle, advance, solve, rho, report_at)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! out = K in [M L T^-2], the tangent at the present displacement times in[count], count = points*dim; without supports,
    ! obstacles and contact. out may be in. The first call takes memory (peri_memory.state).
    subroutine peri_multiply_stiffness(body, in, out, stat, errmsg)
        type(peri_body), intent(in) :: body
        real(c_double), intent(in), target, contiguous :: in(:)
        real(c_double), intent(inout), target, contiguous :: out(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_ptr) :: in_at
        type(c_ptr) :: out_at
        type(peri_error) :: record
        in_at = c_null_ptr
        if (size(in) > 0) in_at = c_loc(in)
        if (size(out) /= size(in, kind=c_int64_t)) then
            call refused('out', stat, errmsg)
            return
        end if
        out_at = c_null_ptr
        if (size(out) > 0) out_at = c_loc(out)
        result_ = c_multiply_stiffness(body%handle, in_at, out_at, size(in, kind=c_int64_t))
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! The same at `displacement` [points*dim] of yours instead: the body stays where it is.
    subroutine peri_multiply_stiffness_at(body, displacement, in, out, stat, errmsg)
        type(peri_body), intent(in) :: body
        real(c_double), intent(in), target, contiguous :: displacement(:)
        real(c_double), intent(in), target, contiguous :: in(:)
        real(c_double), intent(inout), target, contiguous :: out(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_ptr) :: displacement_at
        type(c_ptr) :: in_at
        type(c_ptr) :: out_at
        type(peri_error) :: record
        if (size(displacement) /= c_point_count(body%handle)*int(c_dimension(body%handle))) then
            call refused('displacement', stat, errmsg)
            return
        end if
        displacement_at = c_null_ptr
        if (size(displacement) > 0) displacement_at = c_loc(displacement)
        in_at = c_null_ptr
        if (size(in) > 0) in_at = c_loc(in)
        if (size(out) /= size(in, kind=c_int64_t)) then
            call refused('out', stat, errmsg)
            return
        end if
        out_at = c_null_ptr
        if (size(out) > 0) out_at = c_loc(out)
        result_ = c_multiply_stiffness_at(body%handle, displacement_at, in_at, out_at, size(in, kind=c_int64_t))
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! The same as a matrix by compressed rows, points*dim square ([T] 3.2, 3.3). It outlives the body; free it by
    ! peri_matrix_destroy.
    subroutine peri_matrix_create(body, matrix, stat, errmsg)
        type(peri_body), intent(in) :: body
        type(peri_matrix), intent(out) :: matrix
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(peri_error) :: record
        result_ = c_matrix_create(body%handle, matrix%handle)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        matrix%dim = c_dimension(body%handle)
        if (present(stat)) stat = int(result_)
    end subroutine

    ! The same as a matrix by compressed rows, points*dim square ([T] 3.2, 3.3). It outlives the body; free it by
    ! peri_matrix_destroy.
    subroutine peri_matrix_destroy(matrix)
        type(peri_matrix), intent(inout) :: matrix
        call c_matrix_destroy(matrix%handle)
        matrix%handle = c_null_ptr
    end subroutine

    ! The same as a matrix by compressed rows, points*dim square ([T] 3.2, 3.3). It outlives the body; free it by
    ! peri_matrix_destroy.
    function peri_matrix_rows(matrix) result(result_)
        type(peri_matrix), intent(in) :: matrix
        integer(c_int64_t) :: result_
        result_ = c_matrix_rows(matrix%handle)
    end function

    ! The same as a matrix by compressed rows, points*dim square ([T] 3.2, 3.3). It outlives the body; free it by
    ! peri_matrix_destroy.
    function peri_matrix_entries(matrix) result(result_)
        type(peri_matrix), intent(in) :: matrix
        integer(c_int64_t) :: result_
        result_ = c_matrix_entries(matrix%handle)
    end function

    ! start[rows+1], column[entries] ascending in each row, value[entries] [M T^-2]; any may be NULL.
    subroutine peri_get_matrix(matrix, start, column, value, stat, errmsg)
        type(peri_matrix), intent(in) :: matrix
        integer(c_int64_t), intent(inout), optional, target, contiguous :: start(:)
        integer(c_int32_t), intent(inout), optional, target, contiguous :: column(:)
        real(c_double), intent(inout), optional, target, contiguous :: value(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_ptr) :: start_at
        type(c_ptr) :: column_at
        type(c_ptr) :: value_at
        type(peri_error) :: record
        if (present(start)) then
            if (size(start) /= c_matrix_rows(matrix%handle)+1) then
                call refused('start', stat, errmsg)
                return
            end if
        end if
        start_at = c_null_ptr
        if (present(start)) start_at = c_loc(start)
        if (present(column)) then
            if (size(column) /= c_matrix_entries(matrix%handle)) then
                call refused('column', stat, errmsg)
                return
            end if
        end if
        column_at = c_null_ptr
        if (present(column)) column_at = c_loc(column)
        if (present(value)) then
            if (size(value) /= c_matrix_entries(matrix%handle)) then
                call refused('value', stat, errmsg)
                return
            end if
        end if
        value_at = c_null_ptr
        if (present(value)) value_at = c_loc(value)
        result_ = c_get_matrix(matrix%handle, start_at, column_at, value_at)
        if (result_ < 0) then
            record%code = int(result_, c_int32_t)
            record%index = -1
            record%value = 0
            record%field = c_null_ptr
            record%text = c_status_text(record%code)
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! Matrix Market, coordinate real symmetric: the lower triangle.
    subroutine peri_export_matrix_to(matrix, write, user, stat, errmsg)
        type(peri_matrix), intent(in) :: matrix
        procedure(peri_write_fn) :: write
        type(c_ptr), intent(in), optional :: user
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_funptr) :: write_at
        type(peri_error) :: record
        write_at = c_funloc(write)
        result_ = c_export_matrix_to(matrix%handle, write_at, c_ptr_of(user))
        if (result_ < 0) then
            record%code = int(result_, c_int32_t)
            record%index = -1
            record%value = 0
            record%field = c_null_ptr
            record%text = c_status_text(record%code)
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! Entries of a field: points*components.
    function peri_size_of_field(body, field, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: field
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int64_t) :: result_
        type(peri_error) :: record
        result_ = c_size_of_field(body%handle, field)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    ! Copies a field, as double, in your units and order. capacity counts doubles.
    subroutine peri_get_field(body, field, out, stat, errmsg)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: field
        real(c_double), intent(inout), target, contiguous :: out(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_ptr) :: out_at
        type(peri_error) :: record
        out_at = c_null_ptr
        if (size(out) > 0) out_at = c_loc(out)
        result_ = c_get_field(body%handle, field, out_at, size(out, kind=c_int64_t))
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! Sets a field W of all points; count = points*components. What peri_get_field gives changes no bit. Fields of material
    ! (docs/laws.md), which peri_frame_fn may set, too, outlast peri_reset.
    subroutine peri_set_field(body, field, in, stat, errmsg)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: field
        real(c_double), intent(in), target, contiguous :: in(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_ptr) :: in_at
        type(peri_error) :: record
        in_at = c_null_ptr
        if (size(in) > 0) in_at = c_loc(in)
        result_ = c_set_field(body%handle, field, in_at, size(in, kind=c_int64_t))
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! Without a copy. Of a stored field it shows the present state; of a derived one that of the call, until it is viewed
    ! again.
    subroutine peri_view_field(body, field, view, stat, errmsg)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: field
        type(peri_view), intent(inout) :: view
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(peri_error) :: record
        result_ = c_view_field(body%handle, field, view)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! Of points[count] alone: count*components.
    subroutine peri_get_field_at(body, field, points, out, stat, errmsg)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: field
        integer(c_int32_t), intent(in), target, contiguous :: points(:)
        real(c_double), intent(inout), target, contiguous :: out(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_ptr) :: points_at
        type(c_ptr) :: out_at
        type(peri_error) :: record
        points_at = c_null_ptr
        if (size(points) > 0) points_at = c_loc(points)
        out_at = c_null_ptr
        if (size(out) > 0) out_at = c_loc(out)
        result_ = c_get_field_at(body%handle, field, size(points, kind=c_int64_t), points_at, out_at, size(out, kind=c_int64_t))
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! At places[count*dim] [L], in_place = 1: present ones: linear fields exactly, not across cracks. Outside: NaN.
    subroutine peri_interpolate_field(body, field, in_place, places, out, stat, errmsg)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: field
        integer(c_int32_t), intent(in) :: in_place
        real(c_double), intent(in), target, contiguous :: places(:)
        real(c_double), intent(inout), target, contiguous :: out(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_ptr) :: places_at
        type(c_ptr) :: out_at
        type(peri_error) :: record
        if (mod(size(places), int(c_dimension(body%handle))) /= 0) then
            call refused('places', stat, errmsg)
            return
        end if
        places_at = c_null_ptr
        if (size(places) > 0) places_at = c_loc(places)
        out_at = c_null_ptr
        if (size(out) > 0) out_at = c_loc(out)
        result_ = c_interpolate_field(body%handle, field, in_place, size(places, &
            kind=c_int64_t)/(int(c_dimension(body%handle))), places_at, out_at, size(out, kind=c_int64_t))
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! Bonds of the points of a set, as in peri_get_families.
    function peri_size_of_bonds(body, set, bond, stat, errmsg) result(result_)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: set
        integer(c_int32_t), intent(in) :: bond
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int64_t) :: result_
        type(peri_error) :: record
        result_ = c_size_of_bonds(body%handle, set, bond)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = 0
    end function

    ! Bonds of the points of a set, as in peri_get_families.
    subroutine peri_get_bonds(body, set, bond, out, stat, errmsg)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: set
        integer(c_int32_t), intent(in) :: bond
        real(c_double), intent(inout), target, contiguous :: out(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_ptr) :: out_at
        type(peri_error) :: record
        out_at = c_null_ptr
        if (size(out) > 0) out_at = c_loc(out)
        result_ = c_get_bonds(body%handle, set, bond, out_at, size(out, kind=c_int64_t))
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! Costs one evaluation of the forces.
    subroutine peri_get_energy(body, energy, stat, errmsg)
        type(peri_body), intent(in) :: body
        type(peri_energy), intent(inout) :: energy
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(peri_error) :: record
        result_ = c_get_energy(body%handle, energy)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! Momentum [M L T^-1] to linear[dim], about the origin [M L^2 T^-1] to angular[1] (2D) or [3]. Either may be NULL.
    subroutine peri_get_momentum(body, linear, angular, stat, errmsg)
        type(peri_body), intent(in) :: body
        real(c_double), intent(inout), optional, target, contiguous :: linear(:)
        real(c_double), intent(inout), optional, target, contiguous :: angular(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_ptr) :: linear_at
        type(c_ptr) :: angular_at
        type(peri_error) :: record
        if (present(linear)) then
            if (size(linear) /= int(c_dimension(body%handle))) then
                call refused('linear', stat, errmsg)
                return
            end if
        end if
        linear_at = c_null_ptr
        if (present(linear)) linear_at = c_loc(linear)
        if (present(angular)) then
            if (size(angular) /= (2*int(c_dimension(body%handle)) - 3)) then
                call refused('angular', stat, errmsg)
                return
            end if
        end if
        angular_at = c_null_ptr
        if (present(angular)) angular_at = c_loc(angular)
        result_ = c_get_momentum(body%handle, linear_at, angular_at)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    subroutine peri_cracks_desc_init(desc)
        type(peri_cracks_desc), intent(out) :: desc
        call c_cracks_desc_init(desc)
    end subroutine

    subroutine peri_cracks_create(body, desc, cracks, stat, errmsg)
        type(peri_body), intent(in) :: body
        type(peri_cracks_desc), intent(in) :: desc
        type(peri_cracks), intent(out) :: cracks
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(peri_error) :: record
        result_ = c_cracks_create(body%handle, desc, cracks%handle)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        cracks%dim = c_dimension(body%handle)
        if (present(stat)) stat = int(result_)
    end subroutine

    subroutine peri_cracks_destroy(cracks)
        type(peri_cracks), intent(inout) :: cracks
        call c_cracks_destroy(cracks%handle)
        cracks%handle = c_null_ptr
    end subroutine

    ! polylines; 3D: sides of cells
    function peri_cracks_paths(cracks) result(result_)
        type(peri_cracks), intent(in) :: cracks
        integer(c_int64_t) :: result_
        result_ = c_cracks_paths(cracks%handle)
    end function

    function peri_cracks_vertices(cracks) result(result_)
        type(peri_cracks), intent(in) :: cracks
        integer(c_int64_t) :: result_
        result_ = c_cracks_vertices(cracks%handle)
    end function

    function peri_cracks_tips(cracks) result(result_)
        type(peri_cracks), intent(in) :: cracks
        integer(c_int64_t) :: result_
        result_ = c_cracks_tips(cracks%handle)
    end function

    ! length [L]; 3D: area [L^2]
    function peri_cracks_size(cracks) result(result_)
        type(peri_cracks), intent(in) :: cracks
        real(c_double) :: result_
        result_ = c_cracks_size(cracks%handle)
    end function

    ! Path p: vertices start[p] to start[p+1], of start[paths+1]; in 3D 4: triangles 0 1 2, 0 2 3. vertex[vertices*dim] [L],
    ! time[vertices] of breaking [T] (peri_solve: load factor; NaN: not recorded), tip[tips]. Any may be NULL.
    subroutine peri_get_cracks(cracks, start, vertex, time, tip, stat, errmsg)
        type(peri_cracks), intent(in) :: cracks
        integer(c_int64_t), intent(inout), optional, target, contiguous :: start(:)
        real(c_double), intent(inout), optional, target, contiguous :: vertex(:)
        real(c_double), intent(inout), optional, target, contiguous :: time(:)
        type(peri_crack_tip), intent(inout), optional, target, contiguous :: tip(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_ptr) :: start_at
        type(c_ptr) :: vertex_at
        type(c_ptr) :: time_at
        type(c_ptr) :: tip_at
        type(peri_error) :: record
        if (present(start)) then
            if (size(start) /= c_cracks_paths(cracks%handle)+1) then
                call refused('start', stat, errmsg)
                return
            end if
        end if
        start_at = c_null_ptr
        if (present(start)) start_at = c_loc(start)
        if (present(vertex)) then
            if (size(vertex) /= c_cracks_vertices(cracks%handle)*int(cracks%dim)) then
                call refused('vertex', stat, errmsg)
                return
            end if
        end if
        vertex_at = c_null_ptr
        if (present(vertex)) vertex_at = c_loc(vertex)
        if (present(time)) then
            if (size(time) /= c_cracks_vertices(cracks%handle)) then
                call refused('time', stat, errmsg)
                return
            end if
        end if
        time_at = c_null_ptr
        if (present(time)) time_at = c_loc(time)
        if (present(tip)) then
            if (size(tip) /= c_cracks_tips(cracks%handle)) then
                call refused('tip', stat, errmsg)
                return
            end if
        end if
        tip_at = c_null_ptr
        if (present(tip)) tip_at = c_loc(tip)
        result_ = c_get_cracks(cracks%handle, start_at, vertex_at, time_at, tip_at)
        if (result_ < 0) then
            record%code = int(result_, c_int32_t)
            record%index = -1
            record%value = 0
            record%field = c_null_ptr
            record%text = c_status_text(record%code)
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! VTK XML PolyData (.vtp).
    subroutine peri_export_cracks_to(cracks, write, user, stat, errmsg)
        type(peri_cracks), intent(in) :: cracks
        procedure(peri_write_fn) :: write
        type(c_ptr), intent(in), optional :: user
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_funptr) :: write_at
        type(peri_error) :: record
        write_at = c_funloc(write)
        result_ = c_export_cracks_to(cracks%handle, write_at, c_ptr_of(user))
        if (result_ < 0) then
            record%code = int(result_, c_int32_t)
            record%index = -1
            record%value = 0
            record%field = c_null_ptr
            record%text = c_status_text(record%code)
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! VTK XML for ParaView; "Warp By Vector" shows the deformed body.
    subroutine peri_export_vtu_to(body, write, user, stat, errmsg)
        type(peri_body), intent(in) :: body
        procedure(peri_write_fn) :: write
        type(c_ptr), intent(in), optional :: user
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_funptr) :: write_at
        type(peri_error) :: record
        write_at = c_funloc(write)
        result_ = c_export_vtu_to(body%handle, write_at, c_ptr_of(user))
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! fields[count], each once, or NULL: as above.
    subroutine peri_export_fields_to(body, fields, write, user, stat, errmsg)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in), optional, target, contiguous :: fields(:)
        procedure(peri_write_fn) :: write
        type(c_ptr), intent(in), optional :: user
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_ptr) :: fields_at
        integer(c_int64_t) :: count_
        type(c_funptr) :: write_at
        type(peri_error) :: record
        fields_at = c_null_ptr
        if (present(fields)) fields_at = c_loc(fields)
        count_ = 0
        if (present(fields)) count_ = size(fields, kind=c_int64_t)
        write_at = c_funloc(write)
        result_ = c_export_fields_to(body%handle, fields_at, count_, write_at, c_ptr_of(user))
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! One CSV line: step, time, the ledger, broken and cut bonds; header = 1: the names first.
    subroutine peri_export_history_to(body, header, write, user, stat, errmsg)
        type(peri_body), intent(in) :: body
        integer(c_int32_t), intent(in) :: header
        procedure(peri_write_fn) :: write
        type(c_ptr), intent(in), optional :: user
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_funptr) :: write_at
        type(peri_error) :: record
        write_at = c_funloc(write)
        result_ = c_export_history_to(body%handle, header, write_at, c_ptr_of(user))
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    subroutine peri_export_vtu(body, path, stat, errmsg)
        type(peri_body), intent(in) :: body
        character(*), intent(in) :: path
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        character(kind=c_char), target :: path_c(len(path) + 1)
        type(c_ptr) :: path_at
        type(peri_error) :: record
        path_c = c_text(path)
        path_at = c_loc(path_c(1))
        result_ = c_export_vtu(body%handle, path_at)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! Frame 0, 1, ... of a series: its VTU beside `path`, a .pvd.
    subroutine peri_export_frame(body, path, frame, fields, stat, errmsg)
        type(peri_body), intent(in) :: body
        character(*), intent(in) :: path
        integer(c_int64_t), intent(in) :: frame
        integer(c_int32_t), intent(in), optional, target, contiguous :: fields(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        character(kind=c_char), target :: path_c(len(path) + 1)
        type(c_ptr) :: path_at
        type(c_ptr) :: fields_at
        integer(c_int64_t) :: count_
        type(peri_error) :: record
        path_c = c_text(path)
        path_at = c_loc(path_c(1))
        fields_at = c_null_ptr
        if (present(fields)) fields_at = c_loc(fields)
        count_ = 0
        if (present(fields)) count_ = size(fields, kind=c_int64_t)
        result_ = c_export_frame(body%handle, path_at, frame, fields_at, count_)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! append = 0 starts the file with a header, 1 adds a line.
    subroutine peri_export_history(body, path, append, stat, errmsg)
        type(peri_body), intent(in) :: body
        character(*), intent(in) :: path
        integer(c_int32_t), intent(in) :: append
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        character(kind=c_char), target :: path_c(len(path) + 1)
        type(c_ptr) :: path_at
        type(peri_error) :: record
        path_c = c_text(path)
        path_at = c_loc(path_c(1))
        result_ = c_export_history(body%handle, path_at, append)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! Saves the state: motion, bonds, what criteria keep, time, ledger. Not the scene: load it into a body that the same calls
    ! built. What follows has the same bits.
    subroutine peri_save_state_to(body, write, user, stat, errmsg)
        type(peri_body), intent(in) :: body
        procedure(peri_write_fn) :: write
        type(c_ptr), intent(in), optional :: user
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_funptr) :: write_at
        type(peri_error) :: record
        write_at = c_funloc(write)
        result_ = c_save_state_to(body%handle, write_at, c_ptr_of(user))
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    ! Reads all, verifies it, then takes it. PERI_ERROR_STATE: nothing has changed; field: what is of another scene, or "".
    subroutine peri_load_state_from(body, read, user, stat, errmsg)
        type(peri_body), intent(in) :: body
        procedure(peri_read_fn) :: read
        type(c_ptr), intent(in), optional :: user
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(c_funptr) :: read_at
        type(peri_error) :: record
        read_at = c_funloc(read)
        result_ = c_load_state_from(body%handle, read_at, c_ptr_of(user))
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    subroutine peri_save_state(body, path, stat, errmsg)
        type(peri_body), intent(in) :: body
        character(*), intent(in) :: path
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        character(kind=c_char), target :: path_c(len(path) + 1)
        type(c_ptr) :: path_at
        type(peri_error) :: record
        path_c = c_text(path)
        path_at = c_loc(path_c(1))
        result_ = c_save_state(body%handle, path_at)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    subroutine peri_load_state(body, path, stat, errmsg)
        type(peri_body), intent(in) :: body
        character(*), intent(in) :: path
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        character(kind=c_char), target :: path_c(len(path) + 1)
        type(c_ptr) :: path_at
        type(peri_error) :: record
        path_c = c_text(path)
        path_at = c_loc(path_c(1))
        result_ = c_load_state(body%handle, path_at)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    subroutine peri_get_memory(body, memory, stat, errmsg)
        type(peri_body), intent(in) :: body
        type(peri_memory), intent(inout) :: memory
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(peri_error) :: record
        result_ = c_get_memory(body%handle, memory)
        if (result_ < 0) then
            if (c_get_error(body%handle, record) < 0) record%code = 0
            if (record%code /= result_) then
                record%code = int(result_, c_int32_t)
                record%index = -1
                record%value = 0
                record%field = c_null_ptr
                record%text = c_status_text(record%code)
            end if
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    subroutine peri_plan_desc_init(desc)
        type(peri_plan_desc), intent(out) :: desc
        call c_plan_desc_init(desc)
    end subroutine

    ! What a scene will cost, before it is made: some milliseconds. Refuses what peri_body_create, peri_add_material,
    ! peri_add_box and peri_build would refuse. error may be NULL.
    subroutine peri_plan(desc, report, stat, errmsg)
        type(peri_plan_desc), intent(in) :: desc
        type(peri_plan_report), intent(inout) :: report
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(peri_error), target :: record
        result_ = c_plan(desc, report, c_loc(record))
        if (result_ < 0) then
            record%code = int(result_, c_int32_t)
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine

    subroutine peri_choose_desc_init(desc)
        type(peri_choose_desc), intent(out) :: desc
        call c_choose_desc_init(desc)
    end subroutine

    ! Fills body (precision, influence, quadrature, correction, horizon) and material (law, poisson, stabilization) with the
    ! best choice, from a measured table; the rest stays. body needs its space, material its constants. PERI_ERROR_RANGE: out
    ! of reach; the value is what is in reach. error may be NULL.
    subroutine peri_choose(desc, body, material, report, stat, errmsg)
        type(peri_choose_desc), intent(in) :: desc
        type(peri_body_desc), intent(inout) :: body
        type(peri_material_desc), intent(inout) :: material
        type(peri_choose_report), intent(inout) :: report
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: result_
        type(peri_error), target :: record
        result_ = c_choose(desc, body, material, report, c_loc(record))
        if (result_ < 0) then
            record%code = int(result_, c_int32_t)
            call failed(record, stat, errmsg)
            return
        end if
        if (present(stat)) stat = int(result_)
    end subroutine
end module
