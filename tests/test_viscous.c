/* SPDX-License-Identifier: MIT */
/* test_viscous.c - the viscoelastic linear peridynamic solid.

   SOURCE OF TRUTH: the standard linear solid and its Prony series in closed form (relaxation, ramp, creep); the balance of energies; the
   second law: what is dissipated never falls; differences of forces for the tangent. */
#include "held_shear.h"

static void relaxes(specimen *s, double part, double time) {
    s->material.relaxation_part[s->material.relaxations] = part;
    s->material.relaxation_time[s->material.relaxations++] = time;
}

static double still(double time) {
    (void)time;
    return 0;
}

/* u_x = gamma y at once. */
static void shear_at_once(peri_body *b, double gamma) {
    const int64_t n = peri_point_count(b) * peri_dimension(b);
    double *x = get(b, PERI_FIELD_POSITION);
    for (int64_t k = 0; k < n; ++k) x[k] = k % peri_dimension(b) ? 0 : gamma * x[k + 1];
    put(b, PERI_FIELD_DISPLACEMENT, x);
    free(x);
}

/* G(t)/G(0) of the parts that the materials below have. */
static double kept(double t) { return 0.2 + 0.5 * exp(-t / 3) + 0.3 * exp(-t / 0.5); }

static peri_body *two_parts(int32_t space, int32_t precision) {
    specimen s = shear_specimen(space);
    s.desc.precision = precision;
    relaxes(&s, 0.5, 3);
    relaxes(&s, 0.3, 0.5);
    return specimen_make(&s);
}

/* A family sheared at once relaxes by the series, in motion and in equilibria; to the step it does not matter. */
static void sheared_at_once(void) {
    static const int32_t space[3] = {PERI_SPACE_PLANE_STRESS, PERI_SPACE_PLANE_STRAIN, PERI_SPACE_SOLID};
    for (int k = 0; k < 3; ++k) {
        shear s;
        peri_body *b = two_parts(space[k], PERI_PRECISION_DOUBLE), *copy = NULL;
        peri_solve_desc solve;
        const double gamma = 1e-3, mu = 1 / 2.6;
        hold_shear(b, &s, still, 1);
        shear_at_once(b, gamma);
        CHECK_NEAR(shear_stress(b), mu * gamma, 1e-6, 0);
        MUST(b, peri_body_clone(b, &copy, NULL));
        { /* whoever reads between the motion and the run leaves no trace: the jump was elastic */
            peri_body *read = two_parts(space[k], PERI_PRECISION_DOUBLE);
            shear other;
            double force[3];
            hold_shear(read, &other, still, 1);
            shear_at_once(read, gamma);
            MUST(read, peri_get_reaction(read, peri_id(read, PERI_KIND_LOAD, 1), force));
            (void)go(read, PERI_INTEGRATOR_VELOCITY_VERLET, 10, 0.07, 0);
            CHECK_NEAR(shear_stress(read), mu * gamma * kept(0.7), 1e-6, 0);
            free(other.x);
            peri_body_destroy(read);
        }
        (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 10, 0.07, 0);
        CHECK_NEAR(shear_stress(b), mu * gamma * kept(0.7), 1e-6, 0);
        peri_solve_desc_init(&solve);
        solve.duration = 4;
        solve.steps = 3;
        MUST(copy, peri_solve(copy, &solve, NULL));
        CHECK_NEAR(shear_stress(copy), mu * gamma * kept(4), 1e-6, 0);
        CHECK_NEAR(peri_time(copy), 4, 1e-12, 0);
        solve.duration = 1e6;
        MUST(copy, peri_solve(copy, &solve, NULL));
        CHECK_NEAR(shear_stress(copy), mu * gamma * 0.2, 1e-6, 0);
        free(s.x);
        peri_body_destroy(copy);
        peri_body_destroy(b);
    }
}

static double steady(double time) {
    (void)time;
    return 1e-3;
}

/* At a constant rate: tau/(mu rate) = 0.2 t + sum part time (1 - exp(-t/time)). */
static void sheared_steadily(void) {
    for (int precision = 0; precision < 3; ++precision) {
        shear s;
        peri_body *b = two_parts(PERI_SPACE_PLANE_STRAIN, PERI_PRECISION_DOUBLE + precision);
        const double t = 2, want = 1e-3 / 2.6 * (0.2 * t + 1.5 * (1 - exp(-t / 3)) + 0.15 * (1 - exp(-t / 0.5)));
        hold_shear(b, &s, steady, 1);
        (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 20, 0.1, 0);
        CHECK_NEAR(shear_stress(b), want, precision ? 1e-4 : 1e-6, 0);
        free(s.x);
        peri_body_destroy(b);
    }
}

/* Volume does not relax: a body that is stretched alike in all directions keeps its stress. */
static void volume_is_elastic(void) {
    shear s;
    peri_body *b = two_parts(PERI_SPACE_SOLID, PERI_PRECISION_DOUBLE);
    double *x = get(b, PERI_FIELD_POSITION), *before, *after;
    hold_shear(b, &s, still, 1);
    for (int64_t k = 0; k < 3 * peri_point_count(b); ++k) x[k] *= 1e-3;
    put(b, PERI_FIELD_DISPLACEMENT, x);
    before = get(b, PERI_FIELD_FORCE_STRESS);
    (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 20, 0.1, 0);
    after = get(b, PERI_FIELD_FORCE_STRESS);
    const int64_t middle = 6 * (peri_point_count(b) / 2);
    CHECK_NEAR(after[middle], before[middle], 1e-9, 0);
    CHECK(before[middle] > 1e-4);
    free(x);
    free(before);
    free(after);
    free(s.x);
    peri_body_destroy(b);
}

/* Free vibration: the ledger is balanced, to the square of the step; what is dissipated only grows, and in the end is all of the shear. */
static void energy_is_taken(void) {
    double error[2];
    for (int fine = 0; fine < 2; ++fine) {
        peri_energy e;
        double taken = 0;
        specimen s = shear_specimen(PERI_SPACE_PLANE_STRESS);
        s.desc.geometry = PERI_GEOMETRY_NONLINEAR;
        relaxes(&s, 0.6, 4 * H);
        peri_body *b = specimen_make(&s);
        shear_at_once(b, 0.02);
        for (int k = 0; k < 10; ++k) {
            (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, fine ? 16 : 8, fine ? 0.1 * H : 0.2 * H, 0);
            MUST(b, peri_get_energy(b, &e));
            CHECK(e.damping >= taken);
            taken = e.damping;
        }
        CHECK(taken > 0.3 * e.initial);
        error[fine] = fabs(e.error) / e.initial;
        peri_body_destroy(b);
    }
    CHECK(error[0] < 1e-2);
    CHECK(error[1] < 0.4 * error[0]);
}

/* Creep of a bar of plane stress under a constant traction: of the two-dimensional moduli K2 = E/(2 (1 - nu)) and G the strain along it is
   sigma (1/(4 K2) + J/4), J = 1/G of an elastic bar and 1/G (1/(1 - p) - p/(1 - p) exp(-(1 - p) t/tau)) of the standard linear solid.
   Families at the surfaces are softer than the others, so the ratio to the strain at once is looked at. */
static void bar_creeps(void) {
    const double p = 0.4, tau = 2, nu = 0.3, g = 1 / 2.6, k2 = 1 / (2 * (1 - nu)), normal[2] = {1, 0}, pull[2] = {1e-3, 0};
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, nu, H, 2.6, 24, 8, 1);
    peri_solve_desc solve;
    double at_once = 0;
    const double lo[2] = {-1, 0}, hi[2] = {6 * H, 8 * H}, corner[2] = {17 * H, 0}, end[2] = {24 * H, 8 * H};
    s.desc.geometry = PERI_GEOMETRY_LINEAR;
    s.desc.correction = PERI_CORRECTION_MOMENT;
    relaxes(&s, p, tau);
    peri_body *b = specimen_make(&s);
    MUST(b, peri_prescribe_displacement(b, (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi)), PERI_AXIS_X, NULL, NULL, NULL));
    MUST(b, peri_apply_traction(b, (int32_t)MUST(b, peri_select_box(b, NULL, corner, end)), 8 * H, normal, pull, NULL, NULL));
    peri_solve_desc_init(&solve);
    solve.loose = PERI_LOOSE_PINNED;
    solve.tolerance = 1e-8;
    for (int k = 0; k < 4; ++k) {
        const double t = k * 1.5, j = (1 / (1 - p) - p / (1 - p) * exp(-(1 - p) * t / tau)) / g;
        solve.duration = k ? 1.5 : 0;
        solve.steps = k ? 6 : 1;
        MUST(b, peri_solve(b, &solve, NULL));
        const double place[3][2] = {{8.5 * H, 4 * H}, {15.5 * H, 4 * H}};
        double *u = get(b, PERI_FIELD_DISPLACEMENT), strain = 0;
        for (int n = 0; n < 2; ++n) strain += (n ? 1 : -1) * u[2 * peri_find_point(b, place[n])] / (7 * H);
        if (k == 0) at_once = strain;
        CHECK_NEAR(at_once, 1e-3 * (1 / (4 * k2) + 1 / (4 * g)), 0.03, 0);
        CHECK_NEAR(strain / at_once, (1 / k2 + j) / (1 / k2 + 1 / g), 0.01, 0);
        free(u);
    }
    peri_body_destroy(b);
}

/* A body of two materials, one of which relaxes: momentum is that of the start, and nothing else changes with the number of threads. */
static void halves_and_threads(void) {
    peri_body *b[2];
    double momentum[2][2], turn[2][1];
    for (int n = 0; n < 2; ++n) {
        specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, 0.3, H, 3.1, 60, 60, 1);
        const double lo[2] = {0, 0}, mid[2] = {30 * H, 60 * H}, from[2] = {30 * H, 0}, hi[2] = {60 * H, 60 * H};
        s.desc.threads = n ? 3 : 1;
        b[n] = specimen_start(&s);
        relaxes(&s, 0.5, H);
        const int32_t other = (int32_t)MUST(b[n], peri_add_material(b[n], &s.material));
        MUST(b[n], peri_add_box(b[n], peri_id(b[n], PERI_KIND_MATERIAL, 1), lo, mid, H));
        MUST(b[n], peri_add_box(b[n], other, from, hi, H));
        MUST(b[n], peri_build(b[n]));
        shear_at_once(b[n], 0.01);
        (void)go(b[n], PERI_INTEGRATOR_VELOCITY_VERLET, 10, 0, 0);
        MUST(b[n], peri_get_momentum(b[n], momentum[n], turn[n]));
        CHECK(fabs(momentum[n][0]) + fabs(momentum[n][1]) < 1e-15 && fabs(turn[n][0]) < 1e-15);
    }
    double *p = get(b[0], PERI_FIELD_VELOCITY), *q = get(b[1], PERI_FIELD_VELOCITY);
    CHECK(memcmp(p, q, (size_t)(2 * peri_point_count(b[0])) * sizeof *p) == 0);
    free(p);
    free(q);
    peri_body_destroy(b[0]);
    peri_body_destroy(b[1]);
}

/* Forces are the derivative of the energy, whatever has relaxed and whatever bonds were cut since: on those that are left what relaxed
   is no longer deviatoric. With the moments of the family as it is and as it was. */
static void force_is_the_derivative(void) {
    for (int k = 0; k < 2; ++k) {
        specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, 0.3, H, 2.6, 7, 6, 1);
        chance tenth = {7, 0.1};
        s.desc.moments = k ? PERI_MOMENTS_WHOLE : PERI_MOMENTS_LIVE;
        relaxes(&s, 0.8, H);
        peri_body *b = specimen_make(&s);
        double *u = random_field(84, 0.03 * H, 3), *v = random_field(84, H, 8), *volume = get(b, PERI_FIELD_VOLUME);
        double energy[2], at[84], f[84], power = 0;
        peri_evaluate_desc e;
        peri_evaluate_report report;
        put(b, PERI_FIELD_DISPLACEMENT, u);
        (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 20, 0, 0);
        MUST(b, peri_cut_if(b, PERI_CUT_NOW, by_chance, &tenth));
        free(u);
        u = get(b, PERI_FIELD_DISPLACEMENT);
        peri_evaluate_desc_init(&e);
        e.energy = 1;
        e.force = f;
        for (int side = 0; side < 2; ++side) {
            e.displacement = at;
            for (int i = 0; i < 84; ++i) at[i] = u[i] + (side ? 1e-5 : -1e-5) * v[i];
            MUST(b, peri_evaluate(b, &e, &report));
            energy[side] = report.energy;
        }
        e.displacement = NULL;
        MUST(b, peri_evaluate(b, &e, NULL));
        for (int i = 0; i < 84; ++i) power += f[i] * v[i] * volume[i / 2];
        CHECK_NEAR((energy[1] - energy[0]) / 2e-5, -power, 1e-6, 0);
        free(u);
        free(v);
        free(volume);
        peri_body_destroy(b);
    }
}

static void refusals(void) {
    specimen s = shear_specimen(PERI_SPACE_PLANE_STRESS);
    relaxes(&s, 0.7, 1);
    relaxes(&s, 0.3, 1);
    CHECK(material_status(PERI_SPACE_PLANE_STRESS, &s.material, "", -1) >= 0);
    s.material.relaxation_part[1] = 0.31;
    CHECK(material_status(PERI_SPACE_PLANE_STRESS, &s.material, "relaxation_part", -1) == PERI_ERROR_RANGE);
    s.material.relaxation_part[1] = 0;
    CHECK(material_status(PERI_SPACE_PLANE_STRESS, &s.material, "relaxation_part", 1) == PERI_ERROR_RANGE);
    s.material.relaxation_part[1] = 0.1;
    s.material.relaxation_time[1] = 0;
    CHECK(material_status(PERI_SPACE_PLANE_STRESS, &s.material, "relaxation_time", 1) == PERI_ERROR_RANGE);
    s.material.relaxation_time[1] = 1;
    s.material.relaxations = PERI_RELAXATIONS + 1;
    CHECK(material_status(PERI_SPACE_PLANE_STRESS, &s.material, "relaxations", -1) == PERI_ERROR_RANGE);
    s.material.relaxations = 2;
    s.material.yield_shear = 1;
    CHECK(material_status(PERI_SPACE_PLANE_STRESS, &s.material, "relaxations", -1) == PERI_ERROR_MATERIAL);
    s.material.yield_shear = 0;
    s.material.law = PERI_LAW_OTERKUS;
    CHECK(material_status(PERI_SPACE_PLANE_STRESS, &s.material, "relaxations", -1) == PERI_ERROR_LAW);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(sheared_at_once);
    RUN(sheared_steadily);
    RUN(volume_is_elastic);
    RUN(energy_is_taken);
    RUN(bar_creeps);
    RUN(halves_and_threads);
    RUN(force_is_the_derivative);
    RUN(refusals);
    return test_end("test_viscous");
}
