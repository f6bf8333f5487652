-- SPDX-License-Identifier: MIT
-- glass.lua - a pane of glass is pulled until the crack from its notch splits it.
local peri = require "peri"

local d = peri.body_desc()
d.space = peri.SPACE_PLANE_STRESS
d.horizon = 1.5e-3
local glass = peri.material_desc(peri.LAW_BOND_BASED)
glass.young = 72e9
glass.density = 2440
glass.fracture_energy = 3.8

local pane = peri.body(d)
pane:add_box(pane:add_material(glass), {0, 0}, {0.1, 0.04}, 0.5e-3)
pane:build()
pane:cut_segment(peri.CUT_INITIAL, {0, 0.02}, {0.05, 0.02})
pane:apply_layer_traction(pane:select_box("top", {0, 0.0395}, {0.1, 0.04}), 0.1, {0, 2e6})
pane:prescribe_velocity(pane:select_box("bottom", {0, 0}, {0.1, 0.0005}), peri.AXIS_XY)
local run = peri.advance_desc()
run.duration = 40e-6
pane:advance(run)
print(string.format("%d points, %d steps, %d bonds broken", pane:point_count(), pane:step_count(), pane:broken_count()))
