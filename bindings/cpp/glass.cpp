// SPDX-License-Identifier: MIT
// glass.cpp - a pane of glass is pulled until the crack from its notch splits it.
#include "peri.hpp"
#include <cstdio>

int main() try {
    peri::body_desc d;
    d.space = PERI_SPACE_PLANE_STRESS;
    d.horizon = 1.5e-3;
    peri::material_desc glass(PERI_LAW_BOND_BASED);
    glass.young = 72e9;
    glass.density = 2440;
    glass.fracture_energy = 3.8;

    peri::body pane(d);
    pane.add_box(pane.add_material(glass), {0, 0}, {0.1, 0.04}, 0.5e-3);
    pane.build();
    pane.cut_segment(PERI_CUT_INITIAL, {0, 0.02}, {0.05, 0.02});
    pane.apply_layer_traction(pane.select_box("top", {0, 0.0395}, {0.1, 0.04}), 0.1, {0, 2e6});
    pane.prescribe_velocity(pane.select_box("bottom", {0, 0}, {0.1, 0.0005}), PERI_AXIS_XY);
    peri::advance_desc run;
    run.duration = 40e-6;
    pane.advance(run);
    std::printf("%ld points, %ld steps, %ld bonds broken\n", long(pane.point_count()), long(pane.step_count()), long(pane.broken_count()));
} catch (const peri::error &e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
}
