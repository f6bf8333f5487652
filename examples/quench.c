/* SPDX-License-Identifier: MIT */
/* quench.c - a hot plate of alumina whose edge is dipped into water. The cold layer would shrink, the hot rest holds it: cracks run in from
   the edge, close together at first; then more and more of them are left behind by their neighbours.

   Heat comes as eigenstrain by point, -alpha (T0 - T) = -full erfc(y/reach), reach = sqrt(4 D t), in a time that is slow for waves.
   Griffith: an array of long cracks L apart takes all stress from between them; its tips stay where full^2 erfc(y/reach)^2 E/2 L, the
   energy that one crack frees, has fallen to G0. Writes out/quench.png (damage). */
#include "picture.h"

typedef struct quench {
    double *x, *heat; /* of points */
    int64_t points;
    double  full, reach, duration;
} quench;

static int32_t cool(void *user, peri_body *plate) { /* every 20 steps */
    quench *q = (quench *)user;
    const double reach = q->reach * sqrt(peri_time(plate) / q->duration + 1e-6);
    for (int64_t i = 0; i < q->points; ++i) q->heat[i] = -q->full * erfc(q->x[2 * i + 1] / reach);
    return peri_set_field(plate, PERI_FIELD_EIGENSTRAIN, q->heat, q->points);
}

/* Cracks that cross the row of points at depth y: stretches of it that are damaged. */
static int cracks_at(const quench *q, const double *damage, double y, double h) {
    int cracks = 0, in = 0;
    for (int64_t i = 0; i < q->points; ++i)
        if (fabs(q->x[2 * i + 1] - y) < 0.25 * h) cracks += damage[i] > 0.25 && !in, in = damage[i] > 0.25;
    return cracks;
}

int main(void) {
    const double h = 0.2e-3, width = 20e-3, depth = 5e-3, young = 370e9, g0 = 42.47, grip = 3.01 * h;
    const double lo[2] = {0, 0}, hi[2] = {width, depth};
    const double box[3][4] = {{0, 0, grip, depth}, {width - grip, 0, width, depth}, {0, depth - grip, width, depth}};
    quench q = {NULL, NULL, 0, 7.5e-6 * 280, 2.5e-3, 60e-6};
    uint32_t dice = 1;
    double y, deepest = 0;
    peri_body_desc desc;
    peri_material_desc alumina;
    peri_advance_desc run;

    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_PLANE_STRESS;
    desc.geometry = PERI_GEOMETRY_LINEAR;
    desc.horizon = 3 * h;
    desc.threads = 1;
    peri_body *plate = must_create(&desc);
    peri_material_desc_init(&alumina, PERI_LAW_BOND_BASED);
    alumina.young = young, alumina.density = 3980, alumina.fracture_energy = g0;
    must(plate, peri_add_box(plate, must(plate, peri_add_material(plate, &alumina)), lo, hi, h));
    must(plate, peri_build(plate));
    q.points = peri_point_count(plate);
    q.x = (double *)malloc(3 * (size_t)q.points * sizeof(double));
    if (q.x == NULL) return 1;
    q.heat = q.x + 2 * q.points;
    must(plate, peri_get_field(plate, PERI_FIELD_POSITION, q.x, 2 * q.points));
    for (int k = 0; k < 3; ++k) { /* it goes on to the left, the right and behind */
        const int32_t side = must(plate, peri_select_box(plate, NULL, box[k], box[k] + 2));
        must(plate, peri_prescribe_displacement(plate, side, k == 2 ? PERI_AXIS_Y : PERI_AXIS_X, NULL, NULL, NULL));
        must(plate, peri_set_no_fail(plate, side, 1));
    }
    for (int64_t i = 0; i < q.points; ++i) q.heat[i] = 0.9 + 0.2 * ((dice = dice * 1664525u + 1013904223u) / 4294967296.0);
    must(plate, peri_set_field(plate, PERI_FIELD_STRENGTH, q.heat, q.points)); /* flaws, so that cracks begin somewhere    */
    peri_advance_desc_init(&run);
    run.duration = q.duration, run.damping = 1e6;
    run.frame_steps = 20, run.on_frame = cool, run.user = &q;
    must(plate, peri_advance(plate, &run));
    must(plate, peri_get_field(plate, PERI_FIELD_DAMAGE, q.heat, q.points));
    for (y = 0.5 * h; y < depth && (y < 4 * h || cracks_at(&q, q.heat, y, h) > 0); deepest = y, y += h)
        printf("%4.1f mm deep: %2d cracks\n", 1e3 * y, cracks_at(&q, q.heat, y, h));
    const double spacing = width / cracks_at(&q, q.heat, h * (floor(0.8 * deepest / h) + 0.5), h);
    const double griffith = q.full * q.full * young * spacing / 2; /* erfc(y/reach)^2 of this is G0                       */
    for (y = 0; pow(erfc(y / q.reach), 2) * griffith > g0;) y += 1e-6;
    printf("cracks %.1f mm apart are %.2f mm deep; Griffith: %.2f mm\n", 1e3 * spacing, 1e3 * deepest, 1e3 * y);
    must(plate, picture("out/quench.png", plate, PERI_FIELD_DAMAGE, "damage", 0, 0.6, 1300, 300));
    free(q.x);
    peri_body_destroy(plate);
    return fabs(deepest / y - 1) < 0.2 ? 0 : 1;
}
