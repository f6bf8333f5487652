/* SPDX-License-Identifier: MIT */
/* test_touch.c - equilibria that obstacles hold: an exact touch, a gap, a beam on rollers, a press.
   SOURCE OF TRUTH: balance of forces. What carries a body gives its weight, whatever the load steps, the method and what is done about
   loose parts; what is pulled off or out of reach is loose. Hertz. */
#include "scene.h"

typedef struct outcome {
    int32_t status;
    double  force[3]; /* of all obstacles */
    peri_solve_report report;
} outcome;

static outcome solve(peri_body *b, int32_t loose, int32_t method, int64_t steps) {
    peri_solve_desc st;
    outcome o;
    memset(&o, 0, sizeof o);
    peri_solve_desc_init(&st);
    st.loose = loose;
    st.method = method;
    st.steps = steps;
    st.load_from = steps > 1 ? 1.0 / (double)steps : 0;
    st.tolerance = 1e-9;
    o.status = peri_solve(b, &st, &o.report);
    for (int32_t k = 1; peri_id(b, PERI_KIND_OBSTACLE, k) > 0; ++k) {
        double f[3] = {0};
        if (o.status >= 0) MUST(b, peri_get_obstacle_force(b, peri_id(b, PERI_KIND_OBSTACLE, k), f, NULL));
        for (int d = 0; d < 3; ++d) o.force[d] += f[d];
    }
    return o;
}

#define WEIGHT 1e-3 /* per volume */

/* A block of 10 x 6 (x 4) points, its weight along -y, `gap` spacings above a plane that is inclined by `angle`. */
static peri_body *block_above(int32_t space, double gap, double angle) {
    peri_body *b = block(space, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR, 10, 6, 4);
    const double down[3] = {WEIGHT * sin(angle), -WEIGHT * cos(angle), 0}, place[3] = {0.3, (0.5 - gap) * H, 0.2}, up[3] = {0, 1, 0};
    MUST(b, peri_apply_body_force(b, PERI_ALL, down, NULL, NULL));
    MUST(b, plane_obstacle(b, place, up, 0, NULL, NULL));
    return b;
}
static double weight_of(int32_t space) { return WEIGHT * 60 * (space == PERI_SPACE_SOLID ? 4 * H * H * H : H * H * THICK); }

/* Sideways a support of one column holds it, or a pin. */
static void a_block_rests(void) {
    const double gaps[5] = {0, 1e-9, 0.1, 0.45, -0.2}, lo[3] = {0.4, 0, 0}, hi[3] = {0.5, 1, 1};
    for (int32_t space = PERI_SPACE_PLANE_STRESS; space <= PERI_SPACE_SOLID; space += 2)
        for (int k = 0; k < 5; ++k)
            for (int held = 0; held < 2; ++held)
                for (int32_t loose = held ? PERI_LOOSE_REFUSED : PERI_LOOSE_PINNED; loose <= PERI_LOOSE_BALANCED; ++loose) {
                    if (space == PERI_SPACE_SOLID && k % 2) continue;
                    peri_body *b = block_above(space, gaps[k], 0);
                    const int32_t sides = space == PERI_SPACE_SOLID ? PERI_AXIS_X | PERI_AXIS_Z : PERI_AXIS_X;
                    const int32_t column = (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi));
                    if (held) MUST(b, peri_prescribe_displacement(b, column, sides, NULL, NULL, NULL));
                    const outcome o = solve(b, loose, PERI_METHOD_NEWTON, 1);
                    CHECK(o.status == PERI_OK);
                    CHECK(o.report.loose == (held ? 0 : space == PERI_SPACE_SOLID ? 3 : 1)); /* along the plane, and about its normal */
                    CHECK_NEAR(o.force[1], weight_of(space), 1e-6, 0);
                    peri_body_destroy(b);
                    if (test_bad) printf("    %s, gap %g, held %d, loose %d\n", space_name[space % 100], gaps[k], held, (int)loose);
                    if (test_bad) return;
                }
    peri_body *b = block_above(PERI_SPACE_PLANE_STRESS, 0, 0); /* free along the plane */
    CHECK(solve(b, PERI_LOOSE_REFUSED, PERI_METHOD_NEWTON, 1).status == PERI_ERROR_LOOSE);
    peri_body_destroy(b);
}

/* By every method, in several load steps. */
static void methods_agree(void) {
    const double lo[2] = {0.4, 0}, hi[2] = {0.5, 1};
    for (int32_t method = PERI_METHOD_NEWTON; method <= PERI_METHOD_RELAXATION; ++method)
        for (int64_t steps = 1; steps <= 3; steps += 2) {
            peri_body *b = block_above(PERI_SPACE_PLANE_STRESS, 0, 0);
            MUST(b, peri_prescribe_displacement(b, (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi)), PERI_AXIS_X, NULL, NULL, NULL));
            const outcome o = solve(b, PERI_LOOSE_REFUSED, method, steps);
            CHECK(o.status == PERI_OK);
            CHECK_NEAR(o.force[1], weight_of(PERI_SPACE_PLANE_STRESS), 1e-6, 0);
            peri_body_destroy(b);
        }
}

/* A beam, 40 x 4 points, on two rollers whose tops are at its lowest points, between two columns of them: the nearest are H^2/(8 R) off. */
static peri_body *beam_on_rollers(double radius, int press) {
    peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR, 40, 4, 1);
    const double down[2] = {0, -WEIGHT}, left[2] = {0.5, 0.5 * H - radius}, right[2] = {3.5, 0.5 * H - radius};
    const double lo[2] = {1.95, 0}, hi[2] = {2.05, 0.4};
    MUST(b, peri_prescribe_displacement(b, (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi)), PERI_AXIS_X, NULL, NULL, NULL));
    if (!press) MUST(b, peri_apply_body_force(b, PERI_ALL, down, NULL, NULL));
    MUST(b, ball_obstacle(b, left, radius, 0, NULL, NULL));
    MUST(b, ball_obstacle(b, right, radius, 0, NULL, NULL));
    return b;
}
static void a_beam_on_rollers(void) {
    const int64_t steps[4] = {1, 4, 13, 40};
    const double radii[2] = {0.3, 2};
    for (int r = 0; r < 2; ++r)
        for (int32_t loose = PERI_LOOSE_REFUSED; loose <= PERI_LOOSE_PINNED; ++loose)
            for (int k = 0; k < 4; ++k) {
                if (k % 2 && (r != 0 || loose != PERI_LOOSE_REFUSED)) continue;
                peri_body *b = beam_on_rollers(radii[r], 0);
                const outcome o = solve(b, loose, PERI_METHOD_NEWTON, steps[k]);
                CHECK(o.status == PERI_OK && o.report.loose == 0);
                if (o.status == PERI_OK) CHECK_NEAR(o.force[1], WEIGHT * 160 * H * H * THICK, 1e-6, 0);
                if (o.status == PERI_OK) CHECK_NEAR(o.force[0], 0, 0, 1e-6 * o.force[1]);
                printf("    radius %g, loose %d, %2d steps: %d Newton, %d iterations, weight off by %.2g\n", radii[r], (int)loose,
                       (int)steps[k], (int)o.report.newton, (int)o.report.iterations, o.force[1] / (WEIGHT * 160 * H * H * THICK) - 1);
                peri_body_destroy(b);
            }
}

/* Three-point bending by a press from above, which touches in the course of the load: no weight, so that all that comes down goes through
   the rollers below. */
static int32_t press_down(void *user, double time, double *place, double *turn) {
    (void)user, (void)turn;
    place[1] -= 0.02 * time;
    return 0;
}
static void a_press(void) {
    double first = 0;
    for (int64_t steps = 4; steps <= 16; steps *= 2) {
        peri_body *b = beam_on_rollers(0.3, 1);
        const double above[2] = {2, 3.5 * H + 0.3 + 0.004};
        double f[2];
        const int32_t punch = (int32_t)MUST(b, ball_obstacle(b, above, 0.3, 0, press_down, NULL));
        const outcome o = solve(b, PERI_LOOSE_REFUSED, PERI_METHOD_NEWTON, steps);
        CHECK(o.status == PERI_OK);
        MUST(b, peri_get_obstacle_force(b, punch, f, NULL));
        printf("    %d steps: %d Newton, press %.8g, all three %.2g\n", (int)steps, (int)o.report.newton, f[1], o.force[1]);
        CHECK(f[1] < 0);
        CHECK_NEAR(o.force[1], 0, 0, 1e-6 * fabs(f[1])); /* what the press gives the rollers take */
        if (steps == 4) first = f[1];
        CHECK_NEAR(f[1], first, 1e-6, 0);
        peri_body_destroy(b);
    }
}

/* A ceiling that the block touches from below does not hold it; nor does a floor out of reach; nor what pushes sideways alone. */
static void what_is_pulled_off_is_loose(void) {
    const double lo[2] = {0.4, 0}, hi[2] = {0.5, 1}, under[2] = {0, -1}, top[2] = {0, 5.5 * H};
    for (int k = 0; k < 3; ++k) {
        peri_body *b = block_above(PERI_SPACE_PLANE_STRESS, k == 0 ? 0.8 : 50, 0);
        MUST(b, peri_prescribe_displacement(b, (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi)), PERI_AXIS_X, NULL, NULL, NULL));
        if (k == 1) MUST(b, plane_obstacle(b, top, under, 0, NULL, NULL));
        if (k == 2) MUST(b, plane_obstacle(b, (const double[2]){0.5 * H, 0}, (const double[2]){1, 0}, 0, NULL, NULL));
        CHECK(solve(b, PERI_LOOSE_REFUSED, PERI_METHOD_NEWTON, 1).status == PERI_ERROR_LOOSE);
        peri_body_destroy(b);
    }
}

/* A disc of radius 1 in rings of points, pressed between two smooth planes, linear. Hertz (Johnson, Contact Mechanics, 5.6): under a
   force P per thickness the contact is 2 a wide, a^2 = 4 P R/(pi E), and the planes come nearer by 4 P/(pi E) (ln(4 R/a) - 1/2), in plane
   stress. R is that of the outer ring. The springs of the planes are 20 times as stiff as a cell. */
static double hertz_force(double approach, double radius) {
    double low = 0, high = 1;
    for (int k = 0; k < 60; ++k) {
        const double p = 0.5 * (low + high), a = sqrt(4 * p * radius / PI);
        if (4 * p / PI * (log(4 * radius / a) - 0.5) < approach) low = p;
        else high = p;
    }
    return low;
}
static double squeezed_disc(int rings, int32_t law, int32_t correction) {
    const double h = 1.0 / rings, approach = 0.03, up[2] = {0, 1}, down[2] = {0, -1};
    double *x = (double *)malloc((size_t)(8 * rings * rings) * 2 * sizeof *x), *volume = x + 8 * rings * rings, f[2] = {0, 0};
    int64_t n = 0;
    for (int j = 0; j < rings; ++j) {
        const int count = 4 * ((int)(2 * PI * (j + 0.5) + 2.5) / 4);
        for (int k = 0; k < count; ++k, ++n) {
            x[2 * n] = (j + 0.5) * h * sin(2 * PI * (k + 0.5) / count);
            x[2 * n + 1] = (j + 0.5) * h * cos(2 * PI * (k + 0.5) / count);
            volume[n] = PI * (2 * j + 1) * h * h / count;
        }
    }
    double top = 0;
    for (int64_t k = 0; k < n; ++k) top = fmax(top, x[2 * k + 1]);
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, law, 1 / 3.0, h, 3.01, 1, 1, 1);
    s.desc.geometry = PERI_GEOMETRY_LINEAR;
    s.desc.correction = correction;
    peri_body *b = specimen_start(&s);
    MUST(b, peri_add_points(b, n, x, volume, NULL));
    MUST(b, peri_build(b));
    const double low[2] = {0, approach / 2 - top}, high[2] = {0, top - approach / 2};
    const int32_t plane = (int32_t)MUST(b, plane_obstacle(b, low, up, 20 / (h * h), NULL, NULL));
    MUST(b, plane_obstacle(b, high, down, 20 / (h * h), NULL, NULL));
    peri_solve_desc st;
    peri_solve_desc_init(&st);
    st.loose = PERI_LOOSE_PINNED; /* sideways, and about its middle */
    st.tolerance = 1e-6;
    MUST(b, peri_solve(b, &st, NULL));
    MUST(b, peri_get_obstacle_force(b, plane, f, NULL));
    const double off = f[1] / hertz_force(approach, top) - 1;
    printf("    %s, %2d rings, %d points: force off by %+.4f\n", law_name[law % 100], rings, (int)n, off);
    peri_body_destroy(b);
    free(x);
    return off;
}
static void hertz(int finest) {
    const int32_t laws[2] = {PERI_LAW_BOND_BASED, PERI_LAW_LPS}, corrections[2] = {PERI_CORRECTION_ENERGY, PERI_CORRECTION_MOMENT};
    for (int k = 0; k < 2; ++k) {
        double last = 0.05;
        for (int rings = 15; rings <= finest; rings *= 2) {
            const double off = fabs(squeezed_disc(rings, laws[k], corrections[k]));
            CHECK(off < last); /* below 5 %, and converging */
            last = off;
        }
    }
}
static void a_disc_is_squeezed(void) { hertz(30); }
static void a_fine_disc_is_squeezed(void) { hertz(60); }

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(a_block_rests);
    RUN(methods_agree);
    RUN(a_beam_on_rollers);
    RUN(a_press);
    RUN(what_is_pulled_off_is_loose);
    RUN(a_disc_is_squeezed);
    LONG_RUN(a_fine_disc_is_squeezed);
    return test_end("test_touch");
}
