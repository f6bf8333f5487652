! SPDX-License-Identifier: MIT
! scenes.f90 - the scenes of bindings/scenes.md by bindings/fortran/peri.f90; and what is its own: stat and errmsg, callbacks, views.
module told
    use peri
    implicit none
    integer :: frames = 0, breaks = 0, calls = 0
    integer(c_int32_t) :: pairs(40000)
    real(c_double) :: times(20000)
contains
    function on_frame(user, body) bind(c) result(go)
        type(c_ptr), value :: user, body
        integer(c_int32_t) :: go
        frames = frames + 1
        go = 0
        if (c_associated(user) .or. .not. c_associated(body)) go = -1
    end function

    function on_break(user, i, j, time, stretch) bind(c) result(go)
        type(c_ptr), value :: user
        integer(c_int32_t), value :: i, j
        real(c_double), value :: time, stretch
        integer(c_int32_t) :: go
        breaks = breaks + 1
        pairs(2*breaks - 1:2*breaks) = [i, j]
        times(breaks) = time
        go = 0
        if (c_associated(user) .or. stretch < 0) go = -1
    end function

    function pull_down(user, time, count, points, value) bind(c) result(go)
        type(c_ptr), value :: user
        real(c_double), value :: time
        integer(c_int64_t), value :: count
        integer(c_int32_t), intent(in) :: points(count)
        real(c_double), intent(inout) :: value(*)
        integer(c_int32_t) :: go
        integer(c_int64_t) :: k
        calls = calls + 1
        do k = 1, count
            value(2*k) = -2d4*time*time
        end do
        go = 0
        if (c_associated(user) .or. points(1) < 0) go = -1
    end function

    function fails(user, body) bind(c) result(go)
        type(c_ptr), value :: user, body
        integer(c_int32_t) :: go
        integer, pointer :: data
        go = -1
        if (.not. c_associated(body)) return
        call c_f_pointer(user, data)
        data = data + 1
    end function
end module

program scenes
    use peri
    use told
    implicit none
    character(10) :: scene
    scene = 'glass'
    call glass
    scene = 'ball'
    call ball
    scene = 'cantilever'
    call cantilever
    call own
contains

    subroutine count(name, n)
        character(*), intent(in) :: name
        integer, intent(in) :: n
        print '(4a, i0)', trim(scene), '.', name, ' ', n
    end subroutine

    subroutine number(name, v)
        character(*), intent(in) :: name
        real(8), intent(in) :: v
        print '(4a, es25.16e3)', trim(scene), '.', name, ' ', v
    end subroutine

    subroutine hash(name, bytes)
        character(*), intent(in) :: name
        integer(1), intent(in) :: bytes(:)
        integer(8) :: h
        integer :: k
        h = 2166136261_8
        do k = 1, size(bytes)
            h = iand(ieor(h, iand(int(bytes(k), 8), 255_8))*16777619_8, int(z'FFFFFFFF', 8))
        end do
        print '(4a, z8.8)', trim(scene), '.', name, ' ', h
    end subroutine

    subroutine field(body, name, which)
        type(peri_body), intent(in) :: body
        character(*), intent(in) :: name
        integer(c_int32_t), intent(in) :: which
        real(8), allocatable :: v(:)
        allocate (v(peri_size_of_field(body, which)))
        call peri_get_field(body, which, v)
        call hash(name, transfer(v, [1_1]))
    end subroutine

    subroutine common_lines(body)
        type(peri_body), intent(in) :: body
        type(peri_energy) :: e
        call count('points', int(peri_point_count(body)))
        call count('bonds', int(peri_bond_count(body)))
        call count('cut', int(peri_cut_count(body)))
        call count('steps', int(peri_step_count(body)))
        call count('broken', int(peri_broken_count(body)))
        call field(body, 'displacement', PERI_FIELD_DISPLACEMENT)
        call field(body, 'velocity', PERI_FIELD_VELOCITY)
        call field(body, 'damage', PERI_FIELD_DAMAGE)
        call peri_get_energy(body, e)
        call number('kinetic', e%kinetic)
        call number('elastic', e%elastic)
        call number('external', e%external)
        call number('fracture', e%fracture)
    end subroutine

    subroutine create(space, horizon, body)
        integer(c_int32_t), intent(in) :: space
        real(8), intent(in) :: horizon
        type(peri_body), intent(out) :: body
        type(peri_body_desc) :: d
        call peri_body_desc_init(d)
        d%space = space
        d%horizon = horizon
        call peri_body_create(d, body)
    end subroutine

    subroutine glass
        type(peri_body) :: pane
        type(peri_material_desc) :: m
        type(peri_advance_desc) :: run
        integer :: ignored, top, bottom
        call create(PERI_SPACE_PLANE_STRESS, 1.5d-3, pane)
        call peri_material_desc_init(m, PERI_LAW_BOND_BASED)
        m%young = 72d9
        m%density = 2440
        m%fracture_energy = 3.8d0
        ignored = int(peri_add_box(pane, peri_add_material(pane, m), [0d0, 0d0], [0.1d0, 0.04d0], 0.5d-3))
        call peri_build(pane)
        ignored = int(peri_cut_segment(pane, PERI_CUT_INITIAL, [0d0, 0.02d0], [0.05d0, 0.02d0]))
        top = peri_select_box(pane, 'top', [0d0, 0.0395d0], [0.1d0, 0.04d0])
        bottom = peri_select_box(pane, 'bottom', [0d0, 0d0], [0.1d0, 0.0005d0])
        ignored = peri_apply_layer_traction(pane, top, 0.1d0, [0d0, 2d6])
        ignored = peri_prescribe_velocity(pane, bottom, PERI_AXIS_XY)
        call peri_advance_desc_init(run)
        run%duration = 40d-6
        call peri_advance(pane, run)
        call common_lines(pane)
        call peri_body_destroy(pane)
    end subroutine

    subroutine ball
        type(peri_body) :: block
        type(peri_material_desc) :: m
        type(peri_obstacle_desc) :: o
        type(peri_obstacle_state) :: state
        type(peri_advance_desc) :: run
        type(peri_fragment), allocatable :: f(:)
        integer(c_int32_t), allocatable :: of_point(:)
        integer :: ignored, striker, n
        call create(PERI_SPACE_SOLID, 0.03d0, block)
        call peri_material_desc_init(m, PERI_LAW_LPS)
        m%young = 30d9
        m%poisson = 0.2d0
        m%density = 2400
        m%critical_stretch = 3d-3
        ignored = int(peri_add_box(block, peri_add_material(block, m), [0d0, 0d0, 0d0], [0.1d0, 0.1d0, 0.04d0], 0.01d0))
        call peri_build(block)
        ignored = int(peri_cut_rectangle(block, PERI_CUT_INITIAL, [0.07d0, -0.01d0, -0.01d0], [0d0, 0.12d0, 0d0], &
                                         [0d0, 0d0, 0.06d0]))
        call peri_obstacle_desc_init(o, PERI_SHAPE_BALL)
        o%place = [0.05d0, 0.05d0, 0.055d0]
        o%radius = 0.02d0
        o%density = 7800
        o%friction = 0.1d0
        o%velocity(3) = -60
        striker = peri_add_obstacle(block, o)
        call peri_on_break(block, on_break)
        call peri_advance_desc_init(run)
        run%steps = 80
        run%time_step = 1d-6
        run%frame_steps = 10
        run%on_frame = c_funloc(on_frame)
        call peri_advance(block, run)
        call common_lines(block)
        call count('frames', frames)
        call count('breaks', breaks)
        call hash('pairs', transfer(pairs(:2*breaks), [1_1]))
        call hash('times', transfer(times(:breaks), [1_1]))
        call peri_get_obstacle_state(block, striker, state)
        call number('striker_z', state%place(3))
        call number('striker_speed', state%velocity(3))
        allocate (of_point(peri_point_count(block)))
        n = int(peri_find_fragments(block, of_point))
        call count('fragments', n)
        allocate (f(n))
        call peri_get_fragments(block, f)
        call hash('of_point', transfer(of_point, [1_1]))
        call count('first_points', f(1)%points)
        call number('first_centre_z', f(1)%centre(3))
        call peri_body_destroy(block)
    end subroutine

    subroutine cantilever
        type(peri_body) :: beam
        type(peri_material_desc) :: m
        type(peri_solve_desc) :: s
        type(peri_solve_report) :: report
        real(8), target :: curve(12)
        real(8) :: force(2)
        integer :: ignored, held, tip, support
        call create(PERI_SPACE_PLANE_STRESS, 0.15d0, beam)
        call peri_material_desc_init(m, PERI_LAW_LPS)
        m%young = 1d9
        m%poisson = 0.3d0
        m%density = 1000
        ignored = int(peri_add_box(beam, peri_add_material(beam, m), [0d0, 0d0], [1d0, 0.25d0], 0.05d0))
        call peri_build(beam)
        held = peri_select_box(beam, 'held', [0d0, 0d0], [0.15d0, 0.25d0])
        tip = peri_select_box(beam, 'tip', [0.95d0, 0d0], [1d0, 0.25d0])
        support = peri_prescribe_displacement(beam, held, PERI_AXIS_XY)
        ignored = peri_apply_body_force(beam, tip, [0d0, 0d0], pull_down)
        call peri_solve_desc_init(s)
        s%steps = 2
        s%curve_load = support
        s%curve = c_loc(curve)
        s%curve_rows = 2
        call peri_solve(beam, s, report)
        call common_lines(beam)
        call count('load_steps', int(report%steps))
        call count('curve_rows', int(report%curve_rows))
        call hash('curve', transfer(curve, [1_1]))
        call peri_get_reaction(beam, support, force)
        call number('reaction_y', force(2))
        call count('called', merge(1, 0, calls > 0))
        call peri_body_destroy(beam)
    end subroutine

    subroutine must(good, what)
        logical, intent(in) :: good
        character(*), intent(in) :: what
        if (good) return
        print '(2a)', 'scenes.f90: ', what
        error stop
    end subroutine

    subroutine own
        type(peri_body) :: body, other
        type(peri_body_desc) :: d
        type(peri_material_desc) :: m
        type(peri_advance_desc) :: run
        type(peri_error) :: record
        type(peri_view) :: view
        type(peri_matrix) :: matrix
        real(c_double), pointer :: data(:)
        real(8) :: u(200), force(2)
        integer(c_int64_t) :: start(201)
        integer, target :: failures
        integer :: stat, ignored
        character(200) :: text
        call peri_body_desc_init(d)
        d%space = PERI_SPACE_SOLID
        d%horizon = -1
        call peri_body_create(d, body, stat, text)
        call must(stat == PERI_ERROR_RANGE .and. index(text, 'horizon') > 0, 'a negative horizon is refused')
        call create(PERI_SPACE_PLANE_STRESS, 0.15d0, body)
        call peri_material_desc_init(m, PERI_LAW_BOND_BASED)
        m%young = 1d9
        m%density = 1000
        ignored = int(peri_add_box(body, peri_add_material(body, m), [0d0, 0d0], [1d0, 0.25d0], 0.05d0, stat))
        call must(stat == 0 .and. ignored == 100, 'points')
        call peri_build(body)
        call peri_get_reaction(body, PERI_ALL, force, stat, text)
        call peri_get_error(body, record)
        call must(stat == PERI_ERROR_ID_KIND .and. record%index == PERI_ALL, 'a set is no load')
        ignored = peri_select_box(body, 'short', [0d0], [1d0, 1d0], stat, text)
        call must(stat == PERI_ERROR_ARGUMENT .and. index(text, 'lo') > 0, 'a corner of a plane has two numbers')
        call peri_advance_desc_init(run)
        run%steps = 3
        run%frame_steps = 1
        run%on_frame = c_funloc(fails)
        failures = 0
        run%user = c_loc(failures)
        call peri_advance(body, run, stat, text)
        call must(stat == PERI_ERROR_CALLBACK .and. failures == 1, 'a frame fails once')
        run%on_frame = c_null_funptr
        call peri_reset(body)
        call peri_advance(body, run)
        call peri_view_field(body, PERI_FIELD_DISPLACEMENT, view)
        call peri_view_pointer(view, data)
        call peri_get_field(body, PERI_FIELD_DISPLACEMENT, u)
        call must(.not. abs(data(1 + 3*view%point_stride) - u(7)) > 0, 'a view is the field')
        call must(transfer(c_loc(data(1)), 0_c_intptr_t) == transfer(view%data, 0_c_intptr_t), 'and no copy')
        call peri_body_clone(body, other)
        call peri_body_destroy(body)
        call peri_matrix_create(other, matrix)
        call peri_get_matrix(matrix, start)
        call must(peri_matrix_rows(matrix) == 200 .and. start(201) == peri_matrix_entries(matrix), 'a matrix')
        call must(len(peri_kernel_text(other)) > 3 .and. peri_status_text(0) == 'success', 'texts')
        call peri_matrix_destroy(matrix)
        call peri_body_destroy(other)
    end subroutine
end program
