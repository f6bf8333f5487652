! SPDX-License-Identifier: MIT
! glass.f90 - a pane of glass is pulled until the crack from its notch splits it.
program glass_pane
    use peri
    implicit none
    type(peri_body_desc) :: d
    type(peri_material_desc) :: glass
    type(peri_advance_desc) :: run
    type(peri_body) :: pane
    real(8), parameter :: o(2) = 0, corner(2) = [0.1d0, 0.04d0]
    integer :: n, cut, load

    call peri_body_desc_init(d)
    d%space = PERI_SPACE_PLANE_STRESS;  d%horizon = 1.5d-3
    call peri_material_desc_init(glass, PERI_LAW_BOND_BASED)
    glass%young = 72d9;  glass%density = 2440;  glass%fracture_energy = 3.8d0
    call peri_body_create(d, pane)
    n = int(peri_add_box(pane, peri_add_material(pane, glass), o, corner, 0.5d-3))
    call peri_build(pane)
    cut = int(peri_cut_segment(pane, PERI_CUT_INITIAL, [0d0, 0.02d0], [0.05d0, 0.02d0]))
    load = peri_apply_layer_traction(pane, peri_select_box(pane, 'top', [0d0, 0.0395d0], corner), 0.1d0, [0d0, 2d6])
    load = peri_prescribe_velocity(pane, peri_select_box(pane, 'bottom', o, [0.1d0, 0.0005d0]), PERI_AXIS_XY)
    call peri_advance_desc_init(run)
    run%duration = 40d-6
    call peri_advance(pane, run)
    print '(i0, a, i0, a, i0, a)', n, ' points, ', peri_step_count(pane), ' steps, ', peri_broken_count(pane), ' bonds broken'
    call peri_body_destroy(pane)
end program
