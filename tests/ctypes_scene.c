/* SPDX-License-Identifier: MIT */
/* ctypes_scene.c - the scene of test_ctypes.py in C: a notched bar, pulled by a load that a callback sets, watched by a frame
   callback, until it tears. Prints every number with 17 digits, one a line; test_ctypes.py must get the same from the library
   through ctypes, in the same order. First the layout of the structures. */
#include "../peri.h"
#include <stdio.h>
#include <stdlib.h>

static void show(double v) { printf("%.17g\n", v); }

static int32_t pull(void *user, double time, int64_t count, const int32_t *points, double *value) {
    int64_t i;
    ++*(int *)user;
    for (i = 0; i < count; ++i) value[2 * i] = value[2 * i] * (1.0 + 0.25 * time) + points[i] * 0.0001;
    return 0;
}
static int32_t on_frame(void *user, peri_body *body) {
    double u[2 * 96];
    ++*(int *)user;
    if (peri_get_field(body, PERI_FIELD_DISPLACEMENT, u, 2 * 96) < 0) return 1;
    show(peri_time(body));
    show(u[2 * 95]);
    return 0;
}
static int32_t on_break(void *user, int32_t i, int32_t j, double time, double stretch) {
    ++*(int *)user;
    show(i);
    show(j);
    show(time);
    show(stretch);
    return 0;
}

static int32_t on_iteration(void *user, int64_t iteration, double residual) {
    *(double *)user += (double)iteration * residual;
    return 0;
}

/* The equilibrium of the same body, half the load in each of two steps. */
static int32_t solve(peri_body *body) {
    double curve[12] = {0}, told = 0;
    peri_solve_desc s;
    peri_solve_report report;
    int32_t status, k;
    show((double)sizeof s);
    show((double)sizeof report);
    show((double)offsetof(peri_solve_desc, on_iteration));
    peri_solve_desc_init(&s);
    show((double)s.iterations);
    s.fracture = 0;
    s.steps = 2;
    s.curve_load = peri_id(body, PERI_KIND_LOAD, 1);
    s.curve = curve;
    s.curve_rows = 2;
    s.on_iteration = on_iteration;
    s.user = &told;
    status = peri_reset(body);
    if (status == 0) status = peri_solve(body, &s, &report);
    for (k = 0; k < 12; ++k) show(curve[k]);
    show((double)report.iterations);
    show((double)report.passes);
    show(report.residual);
    show(told);
    return status;
}

/* What the body holds, and what its like would cost. */
static int32_t weigh(const peri_body *body, const peri_body_desc *d, const peri_material_desc *m) {
    peri_memory memory;
    peri_plan_desc plan;
    peri_plan_report planned;
    show((double)sizeof memory);
    show((double)sizeof plan);
    show((double)sizeof planned);
    show((double)offsetof(peri_plan_desc, spacing));
    if (peri_get_memory(body, &memory) < 0) return -1;
    show((double)memory.points);
    show((double)memory.families);
    show((double)memory.damage);
    show((double)memory.state);
    show((double)memory.loads);
    show((double)memory.total);
    show((double)memory.shared);
    peri_plan_desc_init(&plan);
    plan.body = d;
    plan.material = m;
    plan.spacing = 0.1;
    plan.hi[0] = 1.6;
    plan.hi[1] = 0.6;
    if (peri_plan(&plan, &planned, NULL) < 0) return -1;
    show((double)planned.points);
    show((double)planned.entries);
    show((double)planned.width);
    show((double)planned.bytes);
    show((double)planned.peak);
    show(planned.stable_step);
    return 0;
}

int main(void) {
    const double lo[2] = {0, 0}, hi[2] = {1.6, 0.6}, left[2] = {0.2, 0.6}, right[2] = {1.4, 0}, t[2] = {0.09, 0};
    const double a[2] = {0.8, 0}, b[2] = {0.8, 0.2};
    const int32_t fields[4] = {PERI_FIELD_DISPLACEMENT, PERI_FIELD_VELOCITY, PERI_FIELD_DAMAGE, PERI_FIELD_FAMILY_SIZE};
    double v[2 * 96], force[2];
    int loads = 0, frames = 0, breaks = 0, k;
    int64_t i, status = 0;
    peri_body_desc d;
    peri_material_desc m;
    peri_body *body = NULL;
    peri_error error;
    peri_advance_desc run;
    peri_energy e;
    peri_view view;

    show((double)sizeof(peri_error));
    show((double)sizeof(peri_body_desc));
    show((double)sizeof(peri_material_desc));
    show((double)sizeof(peri_advance_desc));
    show((double)sizeof(peri_view));
    show((double)sizeof(peri_energy));
    show((double)offsetof(peri_body_desc, horizon));
    show((double)offsetof(peri_body_desc, log_user));
    show((double)offsetof(peri_advance_desc, on_frame));

    peri_body_desc_init(&d);
    show(d.precision);
    show(d.thickness);
    d.space = PERI_SPACE_PLANE_STRESS;
    d.horizon = 0.3;
    d.thickness = 0.5;
    if (peri_body_create(&d, &body, &error) < 0) return 1;
    peri_material_desc_init(&m, PERI_LAW_BOND_BASED);
    m.young = 3;
    m.density = 2;
    m.critical_stretch = 0.02;
    const int32_t stuff = peri_add_material(body, &m);
    status |= stuff;
    show((double)peri_add_box(body, stuff, lo, hi, 0.1));
    status |= peri_build(body);
    show((double)peri_entry_count(body));
    show((double)peri_cut_segment(body, PERI_CUT_INITIAL, a, b));
    const int32_t at_left = peri_select_box(body, "left", lo, left), at_right = peri_select_box(body, "right", right, hi);
    status |= at_left | at_right;
    status |= peri_prescribe_displacement(body, peri_find_set(body, "left"), PERI_AXIS_XY, NULL, NULL, NULL);
    status |= peri_apply_layer_traction(body, peri_find_set(body, "right"), 0.6, t, pull, &loads);
    status |= peri_set_no_fail(body, at_left, 1);
    status |= peri_set_no_fail(body, at_right, 1);
    status |= peri_on_break(body, on_break, &breaks);
    show(peri_stable_step(body));
    peri_advance_desc_init(&run);
    show(run.safety);
    run.duration = 8;
    run.frame_steps = 20;
    run.on_frame = on_frame;
    run.user = &frames;
    status |= peri_advance(body, &run);
    if (status < 0) return 2;
    for (k = 0; k < 4; ++k) {
        int64_t n = peri_size_of_field(body, fields[k]);
        if (peri_get_field(body, fields[k], v, n) < 0) return 3;
        for (i = 0; i < n; ++i) show(v[i]);
    }
    if (peri_get_energy(body, &e) < 0 || peri_get_reaction(body, peri_id(body, PERI_KIND_LOAD, 1), force) < 0) return 4;
    show(e.kinetic);
    show(e.elastic);
    show(e.external);
    show(e.fracture);
    show(e.initial);
    show(e.error);
    show(force[0]);
    show(force[1]);
    if (peri_view_field(body, PERI_FIELD_VELOCITY, &view) < 0) return 5;
    show(view.scale * ((const double *)view.data)[95 * view.point_stride + view.component_stride] + view.offset[1]);
    show(loads);
    show(frames);
    show(breaks);
    run.time_step = 1;
    show(peri_advance(body, &run));
    if (peri_get_error(body, &error) < 0) return 6;
    show(error.code);
    show(error.value);
    if (solve(body) < 0 || weigh(body, &d, &m) < 0) return 7;
    peri_body_destroy(body);
    return 0;
}
