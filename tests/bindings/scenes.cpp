// SPDX-License-Identifier: MIT
// scenes.cpp - the scenes of bindings/scenes.md by bindings/cpp/peri.hpp; and what is its own: exceptions, closures, views, moves.
#include "peri.hpp"
#include <cstdio>
#include <cstdlib>
#include <string>

static std::string scene;

static void count(const char *name, int64_t n) { std::printf("%s.%s %ld\n", scene.c_str(), name, long(n)); }
static void number(const char *name, double v) { std::printf("%s.%s %.17g\n", scene.c_str(), name, v); }
template <class T> static void hash(const char *name, const std::vector<T> &v) {
    uint32_t h = 2166136261u;
    for (T x : v) {
        unsigned char bytes[sizeof(T)];
        std::memcpy(bytes, &x, sizeof x); // least significant first: tested on such machines
        for (unsigned char b : bytes) h = (h ^ b) * 16777619u;
    }
    std::printf("%s.%s %08lx\n", scene.c_str(), name, static_cast<unsigned long>(h));
}

static void common(peri::body &body) {
    count("points", body.point_count());
    count("bonds", body.bond_count());
    count("cut", body.cut_count());
    count("steps", body.step_count());
    count("broken", body.broken_count());
    hash("displacement", body.get_field(PERI_FIELD_DISPLACEMENT));
    hash("velocity", body.get_field(PERI_FIELD_VELOCITY));
    hash("damage", body.get_field(PERI_FIELD_DAMAGE));
    const peri_energy e = body.get_energy();
    number("kinetic", e.kinetic);
    number("elastic", e.elastic);
    number("external", e.external);
    number("fracture", e.fracture);
}

static peri::body create(int32_t space, double horizon) {
    peri::body_desc d;
    d.space = space;
    d.horizon = horizon;
    return peri::body(d);
}

static void glass() {
    peri::body pane = create(PERI_SPACE_PLANE_STRESS, 1.5e-3);
    peri::material_desc m(PERI_LAW_BOND_BASED);
    m.young = 72e9;
    m.density = 2440;
    m.fracture_energy = 3.8;
    pane.add_box(pane.add_material(m), {0, 0}, {0.1, 0.04}, 0.5e-3);
    pane.build();
    pane.cut_segment(PERI_CUT_INITIAL, {0, 0.02}, {0.05, 0.02});
    const int32_t top = pane.select_box("top", {0, 0.0395}, {0.1, 0.04}), bottom = pane.select_box("bottom", {0, 0}, {0.1, 0.0005});
    pane.apply_layer_traction(top, 0.1, {0, 2e6});
    pane.prescribe_velocity(bottom, PERI_AXIS_XY);
    peri::advance_desc run;
    run.duration = 40e-6;
    pane.advance(run);
    common(pane);
}

static void ball() {
    peri::body block = create(PERI_SPACE_SOLID, 0.03);
    peri::material_desc m(PERI_LAW_LPS);
    m.young = 30e9;
    m.poisson = 0.2;
    m.density = 2400;
    m.critical_stretch = 3e-3;
    block.add_box(block.add_material(m), {0, 0, 0}, {0.1, 0.1, 0.04}, 0.01);
    block.build();
    block.cut_rectangle(PERI_CUT_INITIAL, {0.07, -0.01, -0.01}, {0, 0.12, 0}, {0, 0, 0.06});
    peri::obstacle_desc o(PERI_SHAPE_BALL);
    o.place[0] = o.place[1] = 0.05;
    o.place[2] = 0.055;
    o.radius = 0.02;
    o.density = 7800;
    o.friction = 0.1;
    o.velocity[2] = -60;
    const int32_t striker = block.add_obstacle(o);
    std::vector<int32_t> pairs;
    std::vector<double> times;
    int64_t frames = 0, breaks = 0;
    block.on_break([&](int32_t i, int32_t j, double time, double) {
        pairs.push_back(i);
        pairs.push_back(j);
        times.push_back(time);
        ++breaks;
        return 0;
    });
    peri::advance_desc run;
    run.steps = 80;
    run.time_step = 1e-6;
    run.frame_steps = 10;
    run.on_frame = [&](peri::body &) { return ++frames < 0; };
    block.advance(run);
    common(block);
    count("frames", frames);
    count("breaks", breaks);
    hash("pairs", pairs);
    hash("times", times);
    const peri_obstacle_state state = block.get_obstacle_state(striker);
    number("striker_z", state.place[2]);
    number("striker_speed", state.velocity[2]);
    std::vector<int32_t> of_point(static_cast<std::size_t>(block.point_count()));
    count("fragments", block.find_fragments(of_point));
    const std::vector<peri_fragment> f = block.get_fragments();
    hash("of_point", of_point);
    count("first_points", f[0].points);
    number("first_centre_z", f[0].centre[2]);
}

static void cantilever() {
    peri::body beam = create(PERI_SPACE_PLANE_STRESS, 0.15);
    peri::material_desc m(PERI_LAW_LPS);
    m.young = 1e9;
    m.poisson = 0.3;
    m.density = 1000;
    beam.add_box(beam.add_material(m), {0, 0}, {1, 0.25}, 0.05);
    beam.build();
    const int32_t held = beam.select_box("held", {0, 0}, {0.15, 0.25}), tip = beam.select_box("tip", {0.95, 0}, {1, 0.25});
    const int32_t support = beam.prescribe_displacement(held, PERI_AXIS_XY);
    int64_t calls = 0;
    beam.apply_body_force(tip, {0, 0}, [&](double time, peri::span<const int32_t> points, peri::span<double> value) {
        ++calls;
        for (std::size_t k = 0; k < points.size(); ++k) value[2 * k + 1] = -2e4 * time * time;
        return 0;
    });
    std::vector<double> curve(12);
    peri::solve_desc s;
    s.steps = 2;
    s.curve_load = support;
    s.curve = curve.data();
    s.curve_rows = 2;
    const peri_solve_report report = beam.solve(s);
    common(beam);
    count("load_steps", report.steps);
    count("curve_rows", report.curve_rows);
    hash("curve", curve);
    number("reaction_y", beam.get_reaction(support)[1]);
    number("called", calls > 0);
}

// ---- what is the binding's own

static void must(bool good, const char *what) {
    if (good) return;
    std::fprintf(stderr, "scenes.cpp: %s\n", what);
    std::exit(1);
}

struct stop_here {};

static peri::body strip() {
    peri::body body = create(PERI_SPACE_PLANE_STRESS, 0.15);
    peri::material_desc m(PERI_LAW_BOND_BASED);
    m.young = 1e9;
    m.density = 1000;
    body.add_box(body.add_material(m), {0, 0}, {1, 0.25}, 0.05);
    body.build();
    return body;
}

template <class F> static bool throws(F call) {
    try {
        call();
    } catch (const stop_here &) {
        return true;
    }
    return false;
}

static void own() {
    try { // a record: status, field, value
        peri::body_desc d;
        d.space = PERI_SPACE_SOLID;
        d.horizon = -1;
        peri::body body(d);
        must(false, "a negative horizon is refused");
    } catch (const peri::error &e) {
        must(e.status() == PERI_ERROR_RANGE && std::string(e.field()) == "horizon" && e.value() == -1 && e.index() == -1, "the record");
        must(std::string(e.what()).find("horizon") != std::string::npos, "the text");
    }
    peri::body body = strip();
    try {
        body.get_reaction(PERI_ALL);
        must(false, "a set is no load");
    } catch (const peri::error &e) {
        must(e.status() == PERI_ERROR_ID_KIND && e.index() == PERI_ALL, "the id");
    }
    try {
        body.select_box("short", {0}, {1, 1});
        must(false, "a corner of a plane has two numbers");
    } catch (const peri::error &e) {
        must(e.status() == PERI_ERROR_ARGUMENT && std::string(e.field()) == "lo", "the array");
    }
    peri::advance_desc run; // exceptions from each kind of closure
    run.steps = 3;
    run.frame_steps = 1;
    int frames = 0;
    run.on_frame = [&](peri::body &b) -> int32_t {
        ++frames;
        if (throws([&] { b.cut_if(PERI_CUT_NOW, [](int32_t, int32_t, peri::span<const double>, peri::span<const double>) -> int32_t { throw stop_here(); }); }))
            throw stop_here();
        return 0;
    };
    must(throws([&] { body.advance(run); }) && frames == 1, "a frame throws once");
    must(throws([&] { body.select_if("x", [](int64_t, peri::span<const double>) -> int32_t { throw stop_here(); }); }), "a predicate throws");
    must(throws([&] { body.export_vtu_to([](peri::span<const unsigned char>) -> int32_t { throw stop_here(); }); }), "a writer throws");
    const int32_t load = body.apply_body_force(PERI_ALL, {0, 0}, [](double, peri::span<const int32_t>, peri::span<double>) -> int32_t { throw stop_here(); });
    must(throws([&] { body.advance(run); }), "a load throws");
    body.reset();
    body.remove_load(load);
    run.on_frame = nullptr;
    must(body.advance(run) == PERI_OK && body.step_count() == 3, "it runs after that");
    // nothing is copied
    const peri_view view = body.view_field(PERI_FIELD_DISPLACEMENT);
    must(peri::numbers<double>(view).data() == view.data && view.data == body.view_field(PERI_FIELD_DISPLACEMENT).data, "the same numbers");
    must(peri::at(view, 3, 1) == body.get_field(PERI_FIELD_DISPLACEMENT)[7], "in the same place");
    // a clone outlives the body with the closures of both
    peri::body other = create(PERI_SPACE_PLANE_STRESS, 0.15);
    {
        std::vector<int> calls(1); // owned by the closure
        peri::body first = strip();
        first.apply_body_force(PERI_ALL, {0, 0}, [calls](double, peri::span<const int32_t>, peri::span<double>) mutable { return calls[0]++ < 0; });
        other = first.clone();
    }
    must(other.advance(run) == PERI_OK, "the clone runs");
    const peri::cracks cracks = other.cracks_create(peri::cracks_desc());
    must(cracks.paths() == 0, "no cracks");
    const peri::matrix matrix = other.matrix_create();
    std::vector<int64_t> start(static_cast<std::size_t>(matrix.rows()) + 1);
    matrix.get_matrix(start);
    must(matrix.rows() == 200 && start[200] == matrix.entries(), "a matrix");
}

int main(int argc, char **argv) {
    const std::string wanted = argc > 1 ? argv[1] : "";
    void (*const all[])() = {glass, ball, cantilever, own};
    const char *const names[] = {"glass", "ball", "cantilever", "own"};
    for (int k = 0; k < 4; ++k) {
        scene = names[k];
        if (wanted.empty() || wanted == scene) all[k]();
    }
    return 0;
}
