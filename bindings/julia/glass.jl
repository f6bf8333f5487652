# SPDX-License-Identifier: MIT
# glass.jl - a pane of glass is pulled until the crack from its notch splits it.
include(joinpath(@__DIR__, "Peri.jl"))

d = Peri.body_desc()
d.space = Peri.SPACE_PLANE_STRESS
d.horizon = 1.5e-3
glass = Peri.material_desc(Peri.LAW_BOND_BASED)
glass.young = 72e9
glass.density = 2440
glass.fracture_energy = 3.8

pane = Peri.Body(d)
Peri.add_box(pane, Peri.add_material(pane, glass), [0, 0], [0.1, 0.04], 0.5e-3)
Peri.build(pane)
Peri.cut_segment(pane, Peri.CUT_INITIAL, [0, 0.02], [0.05, 0.02])
Peri.apply_layer_traction(pane, Peri.select_box(pane, "top", [0, 0.0395], [0.1, 0.04]), 0.1, [0, 2e6])
Peri.prescribe_velocity(pane, Peri.select_box(pane, "bottom", [0, 0], [0.1, 0.0005]), Peri.AXIS_XY)
run = Peri.advance_desc()
run.duration = 40e-6
Peri.advance(pane, run)
println("$(Peri.point_count(pane)) points, $(Peri.step_count(pane)) steps, $(Peri.broken_count(pane)) bonds broken")
