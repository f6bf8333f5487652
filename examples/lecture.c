/* SPDX-License-Identifier: MIT */
/* lecture.c - the method in two short functions: the prototype microelastic brittle (PMB) law, step by step.

     rho a_i = sum of  mu c s V_j y/|y|  over the family of i      y = x_j + u_j - x_i - u_i
     u(t+dt) = 2 u(t) - u(t-dt) + dt^2 a(t)                        s = (|y| - |x_j - x_i|) / |x_j - x_i|
     mu = 1, but 0 for good from the step on in which s reaches s0

   A glass bar is pulled apart. The library gives points, families and constants, c = 18 K/(pi horizon^4); then it
   does the same run by itself. Both break the same bonds and agree in every displacement, up to rounding. */
#include "example.h"
enum { N = 32 * 8 * 8, M = 122, STEPS = 200 };        /* points, whole family, time steps */
static const double h = 1e-3, dt = 1e-7, speed = 8;   /* spacing [m], time step [s], speed of the two ends [m/s] */
static double x[3 * N], u[3 * N], before[3 * N];      /* places, displacements u(t) and u(t-dt) [m] */
static double a[3 * N], library[3 * N];               /* accelerations [m/s^2]; u as peri_advance finds it */
static int32_t family[N][M], mu[N][M];

static int64_t accelerate(double c, double s0, double rho) { /* returns the number of broken bonds */
    int64_t broken = 0;
    for (int i = 0; i < N; ++i) {
        a[3 * i] = a[3 * i + 1] = a[3 * i + 2] = 0;
        for (int k = 0; k < M && family[i][k] != i; ++k) { /* a row is filled up with its own point */
            const int j = family[i][k];
            double y[3], length = 0, rest = 0; /* squared */
            for (int d = 0; d < 3; ++d) {
                const double xi = x[3 * j + d] - x[3 * i + d];
                y[d] = xi + u[3 * j + d] - u[3 * i + d];
                length += y[d] * y[d];
                rest += xi * xi;
            }
            const double now = sqrt(length), was = sqrt(rest), s = (now - was) / was;
            if (s >= s0) mu[i][k] = 0;
            broken += i < j && !mu[i][k];
            for (int d = 0; d < 3; ++d) a[3 * i + d] += mu[i][k] * c * s * y[d] / now * (h * h * h) / rho;
        }
    }
    return broken;
}

int main(void) {
    const double lo[3] = {0, 0, 0}, hi[3] = {32 * h, 8 * h, 8 * h}, v[3] = {speed, 0, 0}, minus_v[3] = {-speed, 0, 0};
    const double left[3] = {3 * h, 8 * h, 8 * h}, right[3] = {29 * h, 0, 0}; /* corners of the ends */
    double c, s0, most = 0, apart = 0;
    int64_t broken; /* bonds */
    peri_body_desc desc;  peri_material_desc glass;  peri_advance_desc run;

    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_SOLID;  desc.horizon = 3 * h;
    desc.break_timing = PERI_BREAK_AFTER_DRIFT; /* a bond beyond s0 does not act once more */
    peri_body *body = must_create(&desc);
    peri_material_desc_init(&glass, PERI_LAW_BOND_BASED);
    glass.young = 72e9;  glass.density = 2440;  glass.critical_stretch = 2e-3; /* [Pa], [kg/m^3] */
    const int32_t id = must(body, peri_add_material(body, &glass));
    must(body, peri_add_box(body, id, lo, hi, h));  must(body, peri_build(body));
    must(body, peri_get_field(body, PERI_FIELD_POSITION, x, 3 * N));
    must(body, peri_get_bond_constants(body, id, id, &c, &s0));
    must(body, peri_get_families(body, 0, N, family[0], (int64_t)N * M)); /* N rows of peri_family_width(body) = M */
    for (int k = 0; k < N * M; ++k) mu[k / M][k % M] = 1;

    for (int n = 0; broken = accelerate(c, s0, glass.density), n < STEPS; ++n)
        for (int k = 0; k < 3 * N; ++k) {
            const double x0 = x[k - k % 3], end = k % 3 ? 0 : (n + 1) * dt * speed; /* the ends move along x */
            const double next = 2 * u[k] - before[k] + dt * dt * a[k];
            before[k] = u[k];
            u[k] = x0 < left[0] ? -end : x0 > right[0] ? end : next;
        }
    const int32_t at_left = peri_select_box(body, "left", lo, left), at_right = peri_select_box(body, "right", right, hi);
    must(body, peri_prescribe_velocity(body, at_left, PERI_AXIS_XYZ, minus_v, NULL, NULL));
    must(body, peri_prescribe_velocity(body, at_right, PERI_AXIS_XYZ, v, NULL, NULL));
    peri_advance_desc_init(&run);
    run.integrator = PERI_INTEGRATOR_CENTRAL_DIFFERENCE;  run.time_step = dt;  run.steps = STEPS;
    must(body, peri_advance(body, &run));  must(body, peri_get_field(body, PERI_FIELD_DISPLACEMENT, library, 3 * N));
    for (int k = 0; k < 3 * N; ++k) {
        most = fmax(most, fabs(u[k]));
        apart = fmax(apart, fabs(u[k] - library[k]));
    }
    printf("bonds broken: %ld here, %ld by the library\nlargest displacement %.3e m, largest difference %.1e m\n",
           (long)broken, (long)peri_broken_count(body), most, apart);
    peri_body_destroy(body);
}
