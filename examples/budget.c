/* SPDX-License-Identifier: MIT */
/* budget.c - what would it cost? Before a single point is made: the memory and the time of one concrete scene, in single and in double
   precision, at a horizon of 3 and of 4 spacings; then the most accurate choice that fits a budget of both.
   cc -O2 examples/budget.c peri_impl.c -lm

   The scene: a block of concrete, 100 x 50 x 50 mm, hit at one end, for a quarter of a millisecond. The horizon is 6 mm throughout, so the
   spacing follows from how many of them are to span it: at 4 there are 2.4 times as many points as at 3, each with twice as many bonds,
   and the stable step is a little shorter. */
#include "example.h"

int main(void) {
    const double horizon = 6e-3, duration = 0.25e-3;      /* [m], [s]                                                    */
    const double most_bytes = 50e6, most_step = 35e-3;    /* the budget: while it is built, and [s] of one core per step */
    const int32_t precisions[2] = {PERI_PRECISION_SINGLE, PERI_PRECISION_DOUBLE};
    const char *names[2] = {"single", "double"};
    double spacing = 0.0;
    int chosen = -1;
    peri_material_desc concrete;
    peri_material_desc_init(&concrete, PERI_LAW_LPS);
    concrete.young = 30e9; /* [Pa] */
    concrete.poisson = 0.2;
    concrete.density = 2400;        /* [kg/m^3] */
    concrete.fracture_energy = 100; /* [J/m^2]: bonds can break, and that takes memory, too */

    printf("precision  spacings  points    bonds  MB built  while built  ms/step  steps      s\n");
    for (int k = 0; k < 4; ++k) { /* by accuracy: spacings before digits */
        const int spacings = 3 + k / 2, which = k % 2;
        peri_body_desc desc;
        peri_plan_desc plan;
        peri_plan_report cost;
        peri_error error;
        peri_body_desc_init(&desc);
        desc.space = PERI_SPACE_SOLID;
        desc.horizon = horizon;
        desc.precision = precisions[which];
        peri_plan_desc_init(&plan);
        plan.body = &desc;
        plan.material = &concrete;
        plan.hi[0] = 0.1; /* [m]; lo is the origin */
        plan.hi[1] = plan.hi[2] = 0.05;
        plan.spacing = horizon / spacings;
        plan.measure = 1; /* builds a small body of this kind and advances it: a tenth of a second */
        if (peri_plan(&plan, &cost, &error) < 0) stop(&error);

        const double steps = ceil(duration / (0.9 * cost.stable_step)); /* 0.9: the default safety of peri_advance_desc */
        const int fits = (double)cost.peak <= most_bytes && cost.seconds <= most_step;
        printf("%-9s  %8d  %6ld  %5.2f M  %8.1f  %11.1f  %7.1f  %5.0f  %5.1f%s\n", names[which], spacings, (long)cost.points,
               1e-6 * (double)cost.entries, 1e-6 * (double)cost.bytes, 1e-6 * (double)cost.peak, 1e3 * cost.seconds, steps,
               steps * cost.seconds, fits ? "" : "   over the budget");
        if (!fits) continue;
        spacing = plan.spacing;
        chosen = which;
    }
    if (chosen < 0) printf("nothing fits %.0f MB and %.0f ms per step\n", 1e-6 * most_bytes, 1e3 * most_step);
    else printf("take %s precision and a spacing of %.1f mm\n", names[chosen], 1e3 * spacing);
    return 0;
}
