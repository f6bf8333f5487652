-- SPDX-License-Identifier: MIT
-- scenes.lua - the scenes of bindings/scenes.md by bindings/lua/peri.lua; and what is its own: errors, closures, views, collection.
local ffi = require "ffi"
local bit = require "bit"
local peri = require "peri"
local scene

local function count(name, n) print(string.format("%s.%s %d", scene, name, n)) end
local function number(name, v) print(string.format("%s.%s %.17g", scene, name, v)) end
local function hash(name, array, bytes)
    local h, p = ffi.cast("uint32_t", 2166136261), ffi.cast("const uint8_t *", array)
    for k = 0, bytes - 1 do
        h = ffi.cast("uint32_t", ffi.cast("uint64_t", ffi.cast("uint32_t", bit.bxor(tonumber(h), p[k]))) * 16777619ULL % 4294967296ULL)
    end
    print(string.format("%s.%s %s", scene, name, bit.tohex(tonumber(h))))
end
local function field(body, name, which) hash(name, body:get_field(which), 8 * body:size_of_field(which)) end

local function common(body)
    count("points", body:point_count())
    count("bonds", body:bond_count())
    count("cut", body:cut_count())
    count("steps", body:step_count())
    count("broken", body:broken_count())
    field(body, "displacement", peri.FIELD_DISPLACEMENT)
    field(body, "velocity", peri.FIELD_VELOCITY)
    field(body, "damage", peri.FIELD_DAMAGE)
    local e = body:get_energy()
    number("kinetic", e.kinetic)
    number("elastic", e.elastic)
    number("external", e.external)
    number("fracture", e.fracture)
end

local function create(space, horizon)
    local d = peri.body_desc()
    d.space, d.horizon = space, horizon
    return peri.body(d)
end

local scenes = {}

function scenes.glass()
    local pane = create(peri.SPACE_PLANE_STRESS, 1.5e-3)
    local m = peri.material_desc(peri.LAW_BOND_BASED)
    m.young, m.density, m.fracture_energy = 72e9, 2440, 3.8
    pane:add_box(pane:add_material(m), {0, 0}, {0.1, 0.04}, 0.5e-3)
    pane:build()
    pane:cut_segment(peri.CUT_INITIAL, {0, 0.02}, {0.05, 0.02})
    local top = pane:select_box("top", {0, 0.0395}, {0.1, 0.04})
    local bottom = pane:select_box("bottom", {0, 0}, {0.1, 0.0005})
    pane:apply_layer_traction(top, 0.1, {0, 2e6})
    pane:prescribe_velocity(bottom, peri.AXIS_XY)
    local run = peri.advance_desc()
    run.duration = 40e-6
    pane:advance(run)
    common(pane)
end

function scenes.ball()
    local block = create(peri.SPACE_SOLID, 0.03)
    local m = peri.material_desc(peri.LAW_LPS)
    m.young, m.poisson, m.density, m.critical_stretch = 30e9, 0.2, 2400, 3e-3
    block:add_box(block:add_material(m), {0, 0, 0}, {0.1, 0.1, 0.04}, 0.01)
    block:build()
    block:cut_rectangle(peri.CUT_INITIAL, {0.07, -0.01, -0.01}, {0, 0.12, 0}, {0, 0, 0.06})
    local o = peri.obstacle_desc(peri.SHAPE_BALL)
    o.place = {0.05, 0.05, 0.055}
    o.radius, o.density, o.friction = 0.02, 7800, 0.1
    o.velocity = {0, 0, -60}
    local striker = block:add_obstacle(o)
    local pairs_, times, frames = {}, {}, 0
    block:on_break(function(i, j, time)
        pairs_[#pairs_ + 1], pairs_[#pairs_ + 2], times[#times + 1] = i, j, time
    end)
    local run = peri.advance_desc()
    run.steps, run.time_step, run.frame_steps = 80, 1e-6, 10
    run.on_frame = function() frames = frames + 1 end
    block:advance(run)
    common(block)
    count("frames", frames)
    count("breaks", #times)
    hash("pairs", ffi.new("int32_t[?]", #pairs_, pairs_), 4 * #pairs_)
    hash("times", ffi.new("double[?]", #times, times), 8 * #times)
    local state = block:get_obstacle_state(striker)
    number("striker_z", state.place[2])
    number("striker_speed", state.velocity[2])
    local of_point = peri.integers(block:point_count())
    count("fragments", block:find_fragments(of_point))
    local f = block:get_fragments()
    hash("of_point", of_point, 4 * block:point_count())
    count("first_points", f[0].points)
    number("first_centre_z", f[0].centre[2])
end

function scenes.cantilever()
    local beam = create(peri.SPACE_PLANE_STRESS, 0.15)
    local m = peri.material_desc(peri.LAW_LPS)
    m.young, m.poisson, m.density = 1e9, 0.3, 1000
    beam:add_box(beam:add_material(m), {0, 0}, {1, 0.25}, 0.05)
    beam:build()
    local held, tip = beam:select_box("held", {0, 0}, {0.15, 0.25}), beam:select_box("tip", {0.95, 0}, {1, 0.25})
    local support = beam:prescribe_displacement(held, peri.AXIS_XY)
    local calls = 0
    beam:apply_body_force(tip, {0, 0}, function(time, n, _, value)
        calls = calls + 1
        for k = 0, n - 1 do value[2 * k + 1] = -2e4 * time * time end
    end)
    local curve = peri.doubles(12)
    local s = peri.solve_desc()
    s.steps, s.curve_load, s.curve, s.curve_rows = 2, support, curve, 2
    local report = beam:solve(s)
    common(beam)
    count("load_steps", tonumber(report.steps))
    count("curve_rows", tonumber(report.curve_rows))
    hash("curve", curve, 96)
    number("reaction_y", beam:get_reaction(support)[1])
    count("called", calls > 0 and 1 or 0)
end

local function strip()
    local body = create(peri.SPACE_PLANE_STRESS, 0.15)
    local m = peri.material_desc(peri.LAW_BOND_BASED)
    m.young, m.density = 1e9, 1000
    body:add_box(body:add_material(m), {0, 0}, {1, 0.25}, 0.05)
    body:build()
    return body
end

-- what a function has raised comes out of the call
local here = {}
local function raises(f)
    local good, raised = pcall(f)
    return not good and raised == here
end

function scenes.own()
    local good, e = pcall(create, peri.SPACE_SOLID, -1)
    assert(not good and e.status == peri.ERROR_RANGE and e.field == "horizon" and e.value == -1 and e.index == -1)
    assert(tostring(e):find("horizon", 1, true))
    local body = strip()
    good, e = pcall(body.get_reaction, body, peri.ALL)
    assert(not good and e.status == peri.ERROR_ID_KIND and e.index == peri.ALL)
    good, e = pcall(body.select_box, body, "short", {0}, {1, 1})
    assert(not good and e.status == peri.ERROR_ARGUMENT and e.field == "lo")
    local run, frames = peri.advance_desc(), 0
    run.steps, run.frame_steps = 3, 1
    run.on_frame = function(b)
        frames = frames + 1
        assert(raises(function() b:cut_if(peri.CUT_NOW, function() error(here) end) end))
        error(here)
    end
    assert(raises(function() body:advance(run) end) and frames == 1)
    assert(raises(function() body:select_if("x", function() error(here) end) end))
    assert(raises(function() body:export_vtu_to(function() error(here) end) end))
    local load = body:apply_body_force(peri.ALL, {0, 0}, function() error(here) end)
    assert(raises(function() body:advance(run) end))
    body:reset()
    body:remove_load(load)
    run.on_frame = nil
    assert(body:advance(run) == peri.OK and body:step_count() == 3)
    local view = body:view_field(peri.FIELD_DISPLACEMENT)
    assert(view.data == body:view_field(peri.FIELD_DISPLACEMENT).data and peri.at(view, 3, 1) == body:get_field(peri.FIELD_DISPLACEMENT)[7])
    for _ = 1, 2000 do -- callbacks are given back: there are some hundreds of them
        body:select_if(nil, function(k) return k == 0 end)
    end
    local calls, other = 0
    do -- a clone outlives the body with the functions of both
        local first = strip()
        first:apply_body_force(peri.ALL, {0, 0}, function() calls = calls + 1 end)
        other = first:clone()
    end
    collectgarbage()
    collectgarbage()
    other:advance(run)
    assert(calls >= 3)
    assert(other:cracks_create(peri.cracks_desc()):paths() == 0)
    local matrix = other:matrix_create()
    local start = ffi.new("int64_t[201]")
    matrix:get_matrix(start)
    assert(matrix:rows() == 200 and tonumber(start[200]) == matrix:entries())
    other:destroy()
end

for _, name in ipairs { "glass", "ball", "cantilever", "own" } do
    scene = name
    scenes[name]()
end
