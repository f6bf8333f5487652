/* SPDX-License-Identifier: MIT */
/* branching.c - a crack in glass branches: the benchmark of [P], with the default step, a sixteenth of it, and the step and rule of [P].

   300 x 120 points of 100 x 40 mm, horizon 1 mm, E 72 GPa, 2440 kg/m^3, 3.8 J/m^2, notched to the middle, 2 MPa on the long edges. */
#include "gallery.h"

typedef struct outcome {
    double tip, kinetic, broken, cut, open; /* [m], [J], bonds, bonds of the notch, error of the ledger over the work of the loads */
} outcome;

typedef struct front { /* how far the crack has come, over time */
    broken_bonds *bonds;
    int64_t       seen;
    double        tip;
    FILE         *file;
} front;

static int32_t follow(void *user, peri_body *pane) {
    front *f = (front *)user;
    for (; f->seen < f->bonds->count; ++f->seen) f->tip = fmax(f->tip, f->bonds->at[3 * f->seen]);
    if (f->file) fprintf(f->file, "%.6g,%.6g\n", 1e6 * peri_time(pane), 1e3 * f->tip);
    return 0;
}

static outcome pull(const char *name, double safety, double step, int32_t timing) {
    const double lx = 0.05, ly = 0.02, h = 0.1 / 300, zone = 1e-3, lo[2] = {-lx, -ly}, hi[2] = {lx, ly}, notch[4] = {-lx, 0, 0, 0};
    const double top_row[2] = {-lx, ly - h}, low_row[2] = {lx, h - ly}, up[2] = {0, 2e6}, down[2] = {0, -2e6};
    const double top_zone[2] = {-lx, ly - zone}, low_zone[2] = {lx, zone - ly};
    broken_bonds bonds = {NULL, NULL, 0, 0};
    front watch = {&bonds, 0, 0, NULL};
    outcome result;
    peri_body_desc desc;
    peri_material_desc glass;
    peri_advance_desc run;
    peri_energy e;

    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_PLANE_STRESS, desc.horizon = zone, desc.break_timing = timing;
    peri_body *pane = must_create(&desc);
    peri_material_desc_init(&glass, PERI_LAW_BOND_BASED);
    glass.young = 72e9, glass.density = 2440, glass.fracture_energy = 3.8; /* [Pa], [kg/m^3], [J/m^2] */
    const int32_t material = must(pane, peri_add_material(pane, &glass));
    must(pane, peri_add_box(pane, material, lo, hi, h)), must(pane, peri_build(pane));
    must(pane, peri_cut_segment(pane, PERI_CUT_INITIAL, notch, notch + 2));
    const int32_t upper = must(pane, peri_select_box(pane, NULL, top_row, hi));
    const int32_t lower = must(pane, peri_select_box(pane, NULL, lo, low_row));
    must(pane, peri_apply_layer_traction(pane, upper, 0.1, up, NULL, NULL));
    must(pane, peri_apply_layer_traction(pane, lower, 0.1, down, NULL, NULL));
    must(pane, peri_set_no_fail(pane, must(pane, peri_select_box(pane, NULL, top_zone, hi)), 1));
    must(pane, peri_set_no_fail(pane, must(pane, peri_select_box(pane, NULL, lo, low_zone)), 1));
    bonds.x = field_of(pane, PERI_FIELD_POSITION);
    must(pane, peri_on_break(pane, note_bond, &bonds));
    peri_advance_desc_init(&run);
    run.on_frame = follow, run.user = &watch, run.frame_steps = 8;
    if (step > 0) run.time_step = step, run.steps = 642;
    else run.duration = 43e-6, run.time_step = safety * peri_stable_step(pane);
    if (name) watch.file = table("branching_tip", "us,mm");
    must(pane, peri_advance(pane, &run));
    if (name) fclose(watch.file), map_of(name, pane, PERI_FIELD_DAMAGE, 0);
    must(pane, peri_get_energy(pane, &e));
    result.tip = watch.tip, result.kinetic = e.kinetic, result.broken = (double)peri_broken_count(pane);
    result.cut = (double)peri_cut_count(pane), result.open = e.error / e.external;
    free((void *)bonds.x), free(bonds.at);
    peri_body_destroy(pane);
    return result;
}

int main(void) {
    FILE *f = figures_of("branching");
    const outcome usual = pull("branching", 0.9, 0, PERI_BREAK_WITHIN_STEP), fine = pull(NULL, 0.9 / 16, 0, PERI_BREAK_WITHIN_STEP);
    const outcome published = pull(NULL, 0, 67e-9, PERI_BREAK_AFTER_DRIFT);
    figure(f, "tip; reference: a sixteenth of the step", 1e3 * usual.tip, 1e3 * fine.tip, 1.0 / 3, "mm");
    figure(f, "kinetic energy; likewise", 1e3 * usual.kinetic, 1e3 * fine.kinetic, 5e-3 * 1e3 * fine.kinetic, "mJ");
    figure(f, "broken bonds; likewise", usual.broken, fine.broken, 0.01 * fine.broken, "");
    figure(f, "error of the ledger over the work done", 1e2 * usual.open, 0, 1, "%");
    figure(f, "broken and cut bonds by the step and rule of [P]; PDMATLAB2D", published.broken + published.cut, 8930, 0, "");
    fclose(f);
    return 0;
}
