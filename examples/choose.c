/* SPDX-License-Identifier: MIT */
/* choose.c - which settings? For a glass pane with a crack: what the library takes for four accuracies and within two budgets, what it
   expects of them, and one of them built and run.
   cc -O2 examples/choose.c peri_impl.c -lm

   A choice is the law, the horizon, the spacing, the precision and the corrections that reach an error at least cost, or that are as right
   as a budget allows; from a table that the project measured on problems with known answers (make tradeoff). */
#include "example.h"

static const double pane[2] = {0.1, 0.04}, crack = 0.02; /* [m] */

static peri_choose_desc goal_of(int32_t preset, double seconds, int64_t bytes) {
    peri_choose_desc goal;
    peri_choose_desc_init(&goal);
    goal.preset = preset;
    goal.seconds = seconds; /* of one step, on this machine */
    goal.bytes = bytes;
    goal.quantity = PERI_QUANTITY_FRACTURE; /* when does the crack run? */
    goal.feature = crack;                   /* the length that the resolution goes by */
    goal.hi[0] = pane[0];
    goal.hi[1] = pane[1];
    return goal;
}

int main(void) {
    const char *names[6] = {"game", "teaching", "engineering", "reference", "0.3 ms per step", "1 MB"};
    const peri_choose_desc goals[6] = {goal_of(PERI_PRESET_GAME, 0, 0),        goal_of(PERI_PRESET_TEACHING, 0, 0),
                                       goal_of(PERI_PRESET_ENGINEERING, 0, 0), goal_of(PERI_PRESET_REFERENCE, 0, 0),
                                       goal_of(PERI_PRESET_NONE, 0.3e-3, 0),   goal_of(PERI_PRESET_NONE, 0, 1000000)};
    peri_body_desc desc;
    peri_material_desc glass;
    peri_choose_report choice;
    peri_error error;
    printf("%-16s  error  spacing   points     MB  choice\n", "goal");
    for (int k = 0; k < 6; ++k) {
        peri_body_desc_init(&desc);
        desc.space = PERI_SPACE_PLANE_STRESS;
        peri_material_desc_init(&glass, PERI_LAW_LPS);
        glass.young = 72e9; /* [Pa] */
        glass.poisson = 0.22;
        glass.density = 2440;        /* [kg/m^3] */
        glass.fracture_energy = 3.8; /* [J/m^2] */
        if (peri_choose(&goals[k], &desc, &glass, &choice, &error) < 0) stop(&error);
        printf("%-16s %4.1f %%  %.2f mm  %7ld  %5.1f  %s\n", names[k], 100 * choice.error, 1e3 * choice.spacing,
               (long)choice.cost.points, 1e-6 * (double)choice.cost.bytes, choice.text);
    }

    /* the descriptor and the material are filled: the last choice, built */
    const double lo[2] = {0, 0}, edge[2] = {-crack, pane[1] / 2}, tip[2] = {crack, pane[1] / 2};
    peri_body *body;
    if (peri_body_create(&desc, &body, &error) < 0) stop(&error);
    const int32_t material = peri_add_material(body, &glass);
    peri_add_box(body, material, lo, pane, choice.spacing);
    if (peri_build(body) < 0) {
        peri_get_error(body, &error);
        stop(&error);
    }
    const int64_t cut = peri_cut_segment(body, PERI_CUT_INITIAL, edge, tip);
    printf("built: %ld points, %ld bonds cut, step %.0f ns\n", (long)peri_point_count(body), (long)cut, 1e9 * peri_stable_step(body));
    peri_body_destroy(body);
    return 0;
}
