/* SPDX-License-Identifier: MIT */
/* wave.c - a ring-shaped pulse in an elastic plate, and the speed at which it spreads.

   The plate starts at rest with the radial displacement  u_r = A exp(-(r-R)^2/(2 sigma)^2)  about its middle. Half of
   it runs inwards, half outwards. Waves much longer than the horizon have the speed of a thin plate of the continuum,
   c_P = sqrt(E/(rho (1-nu^2))) with nu = 1/3; shorter ones are slower, because a bond averages over the wave.
   Units: length 1 m, E = 1 Pa, rho = 1 kg/m^3. Writes out/wave.png (magnitude of u) and out/wave.vtu. */
#include "picture.h"

enum { CELLS = 200, POINTS = CELLS * CELLS };
static const double side = 5, A = 0.025, sigma = 1.0 / 30, R = 6.0 / 30;
static double x[POINTS][2], u[POINTS][2];

/* Radius of the outermost ring: the first peak of u_x on the way from the right edge to the middle, along the row of
   points just above it; a parabola through three points gives the place between them. */
static double ring(peri_body *body) {
    must(body, peri_get_field(body, PERI_FIELD_DISPLACEMENT, u[0], 2 * POINTS));
    for (int i = POINTS / 2 + CELLS - 2; i > POINTS / 2 + CELLS / 2; --i) {
        const double in = u[i - 1][0], at = u[i][0], out = u[i + 1][0];
        if (at > A / 100 && at > out && at >= in)
            return x[i][0] - side / 2 + side / CELLS * 0.5 * (in - out) / (in - 2 * at + out);
    }
    return 0;
}

int main(void) {
    const double lo[2] = {0, 0}, hi[2] = {5, 5}, h = side / CELLS, speed = sqrt(1 / (1 - 1.0 / 9));
    double first, last;
    peri_body_desc desc;
    peri_material_desc plate;
    peri_advance_desc run;

    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_PLANE_STRESS;
    desc.horizon = 0.1; /* 4 cells */
    peri_body *body = must_create(&desc);
    peri_material_desc_init(&plate, PERI_LAW_BOND_BASED);
    plate.young = 1;
    plate.density = 1; /* no fracture energy: bonds do not break */
    const int32_t material = must(body, peri_add_material(body, &plate));
    must(body, peri_add_box(body, material, lo, hi, h));
    must(body, peri_build(body));

    must(body, peri_get_field(body, PERI_FIELD_POSITION, x[0], 2 * POINTS));
    for (int i = 0; i < POINTS; ++i) {
        const double rx = x[i][0] - side / 2, ry = x[i][1] - side / 2, r = sqrt(rx * rx + ry * ry);
        const double at = (r - R) / (2 * sigma), size = fabs(r - R) < 6 * sigma ? A * exp(-at * at) : 0;
        u[i][0] = size * rx / r;
        u[i][1] = size * ry / r;
    }
    must(body, peri_set_field(body, PERI_FIELD_DISPLACEMENT, u[0], 2 * POINTS));

    peri_advance_desc_init(&run);
    run.time_step = 0.01;
    run.steps = 90;
    must(body, peri_advance(body, &run));
    first = ring(body);
    must(body, peri_advance(body, &run));
    last = ring(body);
    printf("the ring at %.1f s: r = %.3f m; with c_P from r = %.3f m on it would be at %.3f m\n", peri_time(body),
           last, R, R + speed * 1.8);
    printf("speed over the last 0.9 s: %.4f m/s, in the continuum c_P = %.4f m/s\n", (last - first) / 0.9, speed);
    print_energy(body);
    must(body, picture("out/wave.png", body, PERI_FIELD_DISPLACEMENT, "displacement [m]", 0, 0, 1000, 0));
    must(body, peri_export_vtu(body, "out/wave.vtu"));
    peri_body_destroy(body);
    return 0;
}
