/* SPDX-License-Identifier: MIT */
/* probe.c - a strain gauge on a bar, its record in time, and a line of samples.

   A steel bar, 0.4 m long, is pulled at its right end at 1 m/s. The front runs to the left at c0 = sqrt(E/rho), and behind it
   the strain is v/c0. A gauge at 0.25 m, between points, reads strain and velocity after every second step; at the end 81
   places along the axis tell where the front is, and the bonds at the gauge how far they are stretched.
   Units: SI. Writes out/probe.csv, out/probe_line.csv and out/probe.pvd, which ParaView plays. */
#include "example.h"

enum { PLACES = 81 };

typedef struct gauge {
    FILE  *file;
    double place[2], sum, from; /* of its strain, from that time on                                                      */
    int    frame, count;
} gauge;

static int32_t sample(void *user, peri_body *body) {
    static const int32_t fields[2] = {PERI_FIELD_STRAIN, PERI_FIELD_VELOCITY};
    gauge *g = (gauge *)user;
    double strain[3], velocity[2];
    must(body, peri_interpolate_field(body, PERI_FIELD_STRAIN, 0, 1, g->place, strain, 3));
    must(body, peri_interpolate_field(body, PERI_FIELD_VELOCITY, 0, 1, g->place, velocity, 2));
    fprintf(g->file, "%.6e,%.6e,%.6e\n", peri_time(body), strain[0], velocity[0]);
    if (peri_time(body) > g->from) g->sum += strain[0], g->count++;
    return g->frame++ % 20 ? 0 : peri_export_frame(body, "out/probe.pvd", g->frame / 20, fields, 2);
}

static void write_line(peri_body *body) {
    double places[PLACES][2], strain[PLACES][3];
    FILE *file = fopen("out/probe_line.csv", "w");
    if (!file) exit(EXIT_FAILURE);
    for (int k = 0; k < PLACES; ++k) places[k][0] = 0.4 * k / (PLACES - 1), places[k][1] = 0.01;
    must(body, peri_interpolate_field(body, PERI_FIELD_STRAIN, 0, PLACES, places[0], strain[0], 3 * PLACES));
    fprintf(file, "x,strain_xx\n");
    for (int k = 0; k < PLACES; ++k) fprintf(file, "%.4f,%.6e\n", places[k][0], strain[k][0]);
    (void)fclose(file);
}

int main(void) {
    const double lo[2] = {0, 0}, hi[2] = {0.4, 0.02}, grip[2] = {0.394, 0}, pull[2] = {1, 0}, h = 0.002, c0 = sqrt(200e9 / 7850);
    gauge g = {fopen("out/probe.csv", "w"), {0.25, 0.01}, 0, 0.17 / c0, 0, 0};
    double stretch[64], most = 0;
    peri_body_desc desc;
    peri_material_desc steel;
    peri_advance_desc run;
    if (!g.file) return EXIT_FAILURE;
    fprintf(g.file, "time,strain_xx,velocity_x\n");

    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_PLANE_STRESS;
    desc.horizon = 3 * h;
    desc.correction = PERI_CORRECTION_MOMENT; /* the bar is as thin as three horizons */
    peri_body *body = must_create(&desc);
    peri_material_desc_init(&steel, PERI_LAW_LPS);
    steel.young = 200e9;
    steel.poisson = 0.3;
    steel.density = 7850;
    must(body, peri_add_box(body, must(body, peri_add_material(body, &steel)), lo, hi, h));
    must(body, peri_build(body));
    must(body, peri_prescribe_velocity(body, must(body, peri_select_box(body, "grip", grip, hi)), PERI_AXIS_X, pull, NULL, NULL));
    peri_advance_desc_init(&run);
    run.duration = 0.25 / c0; /* the front is at 0.15 m, beyond the gauge */
    run.frame_steps = 2;
    run.on_frame = sample;
    run.user = &g;
    must(body, peri_advance(body, &run));
    (void)fclose(g.file);
    write_line(body);
    const int32_t nearest = must(body, peri_find_point(body, g.place));
    const int32_t set = must(body, peri_select_points(body, "gauge", 1, &nearest));
    const int32_t bonds = must(body, peri_size_of_bonds(body, set, PERI_BOND_STRETCH));
    must(body, peri_get_bonds(body, set, PERI_BOND_STRETCH, stretch, 64));
    for (int k = 0; k < bonds; ++k) most = fmax(most, stretch[k]);
    printf("mean strain at the gauge behind the front %.4e, v/c0 = %.4e\n", g.sum / g.count, 1 / c0);
    printf("the %ld bonds beside it are stretched by up to %.4e\n", (long)bonds, most);
    peri_body_destroy(body);
    return 0;
}
