/* SPDX-License-Identifier: MIT */
/* test_plastic.c - the perfectly plastic linear peridynamic solid.

   SOURCE OF TRUTH: the line of an elastic, perfectly plastic material in shear, whose yield stress is as given; Mitchell's psi_0
   (SAND2011-3166, eq. 39); what is dissipated is yield stress times plastic strain; the balance of energies and of momentum; differences of
   forces for the tangent; the elastic body where nothing yields. */
#include "held_shear.h"

static const double yield = 1e-3;

static peri_body *metal(int32_t space, int32_t precision) {
    specimen s = shear_specimen(space);
    s.material.yield_shear = yield;
    s.desc.precision = precision;
    return specimen_make(&s);
}

/* ---- a family -------------------------------------------------------------------------------------------------------- */

/* gamma goes to 3 times that of yielding, back to -2 times, and to 3 times again. */
static double cycle(double t) {
    const double unit = yield * 2.6, way = fmod(t, 10);
    return unit * (t <= 3 ? t : t <= 8 ? 6 - t : way - 8 + (t >= 10 ? 10 : 0) - 2);
}

/* The stress of that, over the yield stress. */
static double answer(double t) {
    if (t <= 3) return fmin(t, 1);
    if (t <= 8) return fmax(1 - (t - 3), -1);
    return fmin(-1 + (t - 8), 1);
}

static void family_in_a_cycle(void) {
    static const int32_t space[3] = {PERI_SPACE_PLANE_STRESS, PERI_SPACE_PLANE_STRAIN, PERI_SPACE_SOLID};
    for (int k = 0; k < 3; ++k)
        for (int precision = 0; precision < (k ? 1 : 3); ++precision) {
            shear s;
            peri_body *b = metal(space[k], PERI_PRECISION_DOUBLE + precision);
            peri_solve_desc solve;
            peri_energy e;
            double taken = 0;
            hold_shear(b, &s, cycle, 0);
            peri_solve_desc_init(&solve);
            for (int step = 1; step <= 24; ++step) {
                const double t = 0.5 * step;
                solve.load_from = 0.5 * (step - 1);
                solve.load_to = t;
                MUST(b, peri_solve(b, &solve, NULL));
                CHECK_NEAR(shear_stress(b), yield * answer(t), precision ? 1e-4 : 1e-6, precision ? 1e-8 : 1e-12);
                MUST(b, peri_get_energy(b, &e));
                CHECK(e.damping >= taken * (1 - 1e-6));
                taken = e.damping;
            }
            CHECK(fabs(e.error) < (precision ? 1e-3 : 1e-9) * taken);
            free(s.x);
            peri_body_destroy(b);
        }
}

/* The same in motion, by steps that do not end where it turns: the supports take the body through the cycle. */
static void family_in_motion(void) {
    shear s;
    peri_body *b = metal(PERI_SPACE_PLANE_STRAIN, PERI_PRECISION_DOUBLE);
    hold_shear(b, &s, cycle, 0);
    for (int step = 1; step <= 12; ++step) {
        (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 10, 0.1, 0);
        CHECK_NEAR(shear_stress(b), yield * answer(step), 1e-6, 1e-12);
    }
    free(s.x);
    peri_body_destroy(b);
}

/* psi_0 of a ball, w = 1: t'.t'/2 where a family yields, of the force densities t' = 15 mu/m e' that Mitchell has, is 75 tau^2/(8 pi h^5).
   By an integral over the ball instead of the sums of a lattice: the lattice differs from that by the error of its quadrature. */
static void yields_where_mitchell_does(void) {
    const double h = 4, mu = 1 / 2.6, m = 4 * 3.14159265358979 / 5 * pow(h, 5), gamma = yield / mu;
    const double psi = 75 * yield * yield / (8 * 3.14159265358979 * pow(h, 5));
    double sum = 0; /* of e'^2 in simple shear, over rings: (gamma x y/r)^2 has the mean gamma^2 r^2/15 */
    for (int k = 0; k < 1000; ++k) {
        const double r = (k + 0.5) * h / 1000;
        sum += gamma * gamma * r * r / 15 * 4 * 3.14159265358979 * r * r * h / 1000;
    }
    CHECK_NEAR(0.5 * pow(15 * mu / m, 2) * sum, psi, 1e-5, 0);
    /* and a lattice without correction, horizon 4 spacings, yields within its quadrature of that */
    shear s;
    specimen p = shear_specimen(PERI_SPACE_SOLID);
    peri_solve_desc solve;
    p.desc.correction = PERI_CORRECTION_NONE;
    p.desc.horizon = 4 * H;
    p.hi[0] = p.hi[1] = p.hi[2] = 9 * H;
    p.material.yield_shear = yield;
    peri_body *b = specimen_make(&p);
    hold_shear(b, &s, cycle, 0);
    peri_solve_desc_init(&solve);
    solve.load_to = 3;
    MUST(b, peri_solve(b, &solve, NULL));
    CHECK_NEAR(shear_stress(b), yield, 0.02, 0);
    free(s.x);
    peri_body_destroy(b);
}

/* Volume does not yield; what is stretched alike in all directions is elastic, and so is what stays below the yield stress. */
static void elastic_below(void) {
    for (int sheared = 0; sheared < 2; ++sheared) {
        peri_body *b[2];
        double *f[2];
        for (int n = 0; n < 2; ++n) {
            specimen s = specimen_of(PERI_SPACE_SOLID, PERI_LAW_LPS, 0.25, H, 2.6, 6, 6, 6);
            s.material.yield_shear = n ? yield : 0;
            b[n] = specimen_make(&s);
            double *x = get(b[n], PERI_FIELD_POSITION);
            for (int64_t k = 0; k < 3 * peri_point_count(b[n]); ++k)
                x[k] = sheared ? (k % 3 ? 0 : 0.5 * yield * 2.5 * x[k + 1]) : 0.1 * x[k];
            put(b[n], PERI_FIELD_DISPLACEMENT, x);
            free(x);
            f[n] = get(b[n], PERI_FIELD_FORCE_DENSITY);
        }
        const int64_t middle = 3 * (2 * 36 + 2 * 6 + 2);
        for (int d = 0; d < 3; ++d) CHECK_NEAR(f[1][middle + d], f[0][middle + d], 0, 1e-10);
        for (int n = 0; n < 2; ++n) {
            free(f[n]);
            peri_body_destroy(b[n]);
        }
    }
}

/* ---- blocks ------------------------------------------------------------------------------------------------------------ */

static double ramp(double t) { return 4 * yield * 2.6 * t; }

/* A block sheared by a frame two horizons wide; what lies within is free, and has a hole in its middle that makes stress uneven.
   Before it yields the stress there grows as that of an elastic body; then no point is above the yield stress, and the middle of the
   ligament is at it. */
static void block_in_a_frame(void) {
    shear s;
    specimen p = shear_specimen(PERI_SPACE_PLANE_STRAIN);
    peri_solve_desc solve;
    peri_energy e;
    double taken = 0;
    p.hi[0] = p.hi[1] = 21 * H;
    p.material.yield_shear = yield;
    peri_body *b = specimen_make(&p);
    double *x = get(b, PERI_FIELD_POSITION);
    int32_t points[441], count = 0;
    for (int32_t i = 0; i < 441; ++i)
        if (fabs(x[2 * i] - 10.5 * H) > 5 * H || fabs(x[2 * i + 1] - 10.5 * H) > 5 * H) points[count++] = i;
    s.value = ramp;
    s.dim = 2;
    s.x = x;
    const int32_t frame = (int32_t)MUST(b, peri_select_points(b, NULL, count, points));
    MUST(b, peri_prescribe_displacement(b, frame, PERI_AXIS_XY, NULL, shear_all, &s));
    peri_solve_desc_init(&solve);
    for (int step = 1; step <= 8; ++step) {
        solve.load_from = (step - 1) / 8.0;
        solve.load_to = step / 8.0;
        MUST(b, peri_solve(b, &solve, NULL));
        CHECK_NEAR(shear_stress(b), fmin(ramp(step / 8.0) / 2.6, yield), 0.01, 0);
        MUST(b, peri_get_energy(b, &e));
        CHECK(e.damping >= taken);
        taken = e.damping;
    }
    /* plastic strain 3 times that of yielding, within 10 x 10 cells and about as much in the frame, which is 21 x 21 in all */
    CHECK_NEAR(taken, yield * 3 * yield * 2.6 * 441 * H * H, 0.1, 0);
    CHECK(fabs(e.error) < 1e-6 * taken);
    free(x);
    peri_body_destroy(b);
}

/* A free block in motion: energy is balanced, momentum stays, both ends of a bond agree; save and load, clones and halves of the run have
   the same bits. */
static int32_t collect(void *user, const void *bytes, int64_t count) {
    char **end = (char **)user;
    memcpy(*end, bytes, (size_t)count);
    *end += count;
    return 0;
}

static int32_t give(void *user, void *bytes, int64_t count) {
    const char **at = (const char **)user;
    memcpy(bytes, *at, (size_t)count);
    *at += count;
    return 0;
}

static void throw_block(peri_body *b, double speed) {
    const int64_t n = peri_point_count(b);
    double *x = get(b, PERI_FIELD_POSITION);
    for (int64_t i = 0; i < n; ++i) {
        const double y = x[2 * i + 1] - 6 * H;
        x[2 * i + 1] = 0;
        x[2 * i] = speed * y / H;
    }
    put(b, PERI_FIELD_VELOCITY, x);
    free(x);
}

static void free_block(void) {
    static char bytes[1 << 21];
    char *end = bytes;
    const char *at = bytes;
    double momentum[2];
    peri_energy e;
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, 0.3, H, 3, 14, 12, 1);
    s.material.yield_shear = 0.01;
    peri_body *b = specimen_make(&s), *copy = NULL, *other = specimen_make(&s);
    const double dt = 0.5 * peri_stable_step(b);
    throw_block(b, 0.02);
    (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 60, dt, 0);
    MUST(b, peri_body_clone(b, &copy, NULL));
    MUST(b, peri_save_state_to(b, collect, &end));
    MUST(other, peri_load_state_from(other, give, &at));
    (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 40, dt, 0);
    (void)go(copy, PERI_INTEGRATOR_VELOCITY_VERLET, 15, dt, 0);
    (void)go(copy, PERI_INTEGRATOR_VELOCITY_VERLET, 25, dt, 0);
    (void)go(other, PERI_INTEGRATOR_VELOCITY_VERLET, 40, dt, 0);
    double *u[3];
    peri_body *bodies[3] = {b, copy, other};
    for (int n = 0; n < 3; ++n) u[n] = get(bodies[n], PERI_FIELD_DISPLACEMENT);
    CHECK(memcmp(u[0], u[1], 2 * 168 * sizeof(double)) == 0);
    CHECK(memcmp(u[0], u[2], 2 * 168 * sizeof(double)) == 0);
    MUST(b, peri_get_energy(b, &e));
    CHECK(e.damping > 0.2 * e.initial && e.damping < e.initial);
    CHECK(fabs(e.error) < 2e-3 * e.initial);
    MUST(b, peri_get_momentum(b, momentum, NULL));
    CHECK(fabs(momentum[0]) + fabs(momentum[1]) < 1e-15);
    MUST(b, peri_reset(b)); /* as new */
    throw_block(b, 0.02);
    (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 100, dt, 0);
    double *again = get(b, PERI_FIELD_DISPLACEMENT);
    CHECK(memcmp(u[0], again, 2 * 168 * sizeof(double)) == 0);
    free(again);
    for (int n = 0; n < 3; ++n) {
        free(u[n]);
        peri_body_destroy(bodies[n]);
    }
}

/* ---- the tangent ------------------------------------------------------------------------------------------------------- */

static void tangent_is_the_derivative(void) {
    for (int k = 0; k < 4; ++k) {
        specimen s = specimen_of(k % 2 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, 0.3, H, 2.1, 5, 5, k % 2 ? 4 : 1);
        s.desc.geometry = k < 2 ? PERI_GEOMETRY_NONLINEAR : PERI_GEOMETRY_LINEAR;
        s.material.yield_shear = 0.01;
        s.scatter = 0.3;
        s.seed = 4;
        peri_body *b = specimen_make(&s);
        const int64_t n = peri_point_count(b) * peri_dimension(b);
        double *u = random_field(n, 0.03 * H, 3), *v = random_field(n, H, 8), *volume = get(b, PERI_FIELD_VOLUME);
        double *at = (double *)calloc((size_t)(4 * n), sizeof *at), *f = at + n, *by = at + 3 * n, most = 0, differ = 0;
        peri_evaluate_desc e;
        peri_evaluate_desc_init(&e);
        put(b, PERI_FIELD_DISPLACEMENT, u);
        MUST(b, peri_multiply_stiffness(b, v, by, n));
        e.displacement = at;
        for (int side = 0; side < 2; ++side) {
            for (int64_t i = 0; i < n; ++i) at[i] = u[i] + (side ? 1e-6 : -1e-6) * v[i];
            e.force = f + side * n;
            MUST(b, peri_evaluate(b, &e, NULL));
        }
        for (int64_t i = 0; i < n; ++i) {
            const double want = -(f[n + i] - f[i]) / 2e-6 * volume[i / peri_dimension(b)];
            most = fmax(most, fabs(want));
            differ = fmax(differ, fabs(want - by[i]));
        }
        CHECK(differ < 1e-6 * most);
        MUST(b, peri_multiply_stiffness_at(b, u, v, at, n));
        for (int64_t i = 0; i < n; ++i) CHECK_NEAR(at[i], by[i], 1e-12, 1e-14);
        free(u);
        free(v);
        free(at);
        free(volume);
        peri_body_destroy(b);
    }
}

/* ---- breaking ---------------------------------------------------------------------------------------------------------- */

/* A block that is torn while it flows: what the bonds that break took and what flow took is in the ledger, and the halves fly apart. */
static void tears(void) {
    peri_energy e;
    double taken = 0, momentum[2];
    specimen s = specimen_of(PERI_SPACE_PLANE_STRAIN, PERI_LAW_LPS, 0.3, H, 2.6, 16, 8, 1);
    s.material.yield_shear = 0.005;
    s.material.critical_stretch = 0.08;
    peri_body *b = specimen_make(&s);
    double *x = get(b, PERI_FIELD_POSITION);
    for (int64_t k = 0; k < 2 * peri_point_count(b); ++k) x[k] = k % 2 ? 0 : x[k] > 8 * H ? 0.08 : -0.08;
    put(b, PERI_FIELD_VELOCITY, x);
    for (int k = 0; k < 10; ++k) {
        (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 10, 0.1 * H, 0);
        MUST(b, peri_get_energy(b, &e));
        CHECK(e.damping >= taken);
        taken = e.damping;
    }
    CHECK(peri_broken_count(b) > 30 && e.fracture > 0 && taken > 0.01 * e.initial);
    CHECK(fabs(e.error) < 0.02 * e.initial);
    MUST(b, peri_get_momentum(b, momentum, NULL));
    CHECK(fabs(momentum[0]) + fabs(momentum[1]) < 1e-12);
    CHECK(peri_find_fragments(b, NULL, 0) >= 2);
    double *first = get(b, PERI_FIELD_DISPLACEMENT), *second; /* and after peri_reset as a new body */
    MUST(b, peri_reset(b));
    put(b, PERI_FIELD_VELOCITY, x);
    for (int k = 0; k < 10; ++k) (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 10, 0.1 * H, 0);
    second = get(b, PERI_FIELD_DISPLACEMENT);
    CHECK(memcmp(first, second, (size_t)(2 * peri_point_count(b)) * sizeof *first) == 0);
    free(first);
    free(second);
    free(x);
    peri_body_destroy(b);
}

/* ---- refusals, memory --------------------------------------------------------------------------------------------------- */

static void refusals(void) {
    specimen s = shear_specimen(PERI_SPACE_SOLID);
    s.material.yield_shear = 1;
    CHECK(material_status(PERI_SPACE_SOLID, &s.material, "", -1) >= 0);
    s.material.yield_shear = -1;
    CHECK(material_status(PERI_SPACE_SOLID, &s.material, "yield_shear", -1) == PERI_ERROR_RANGE);
    s.material.yield_shear = (double)NAN;
    CHECK(material_status(PERI_SPACE_SOLID, &s.material, "yield_shear", -1) == PERI_ERROR_RANGE);
    s.material.yield_shear = 1;
    s.material.criterion = PERI_CRITERION_BOND_ENERGY;
    s.material.fracture_energy = 1;
    CHECK(material_status(PERI_SPACE_SOLID, &s.material, "criterion", -1) == PERI_ERROR_CRITERION);
    s.material.criterion = PERI_CRITERION_STRETCH;
    s.material.law = PERI_LAW_BOND_BASED;
    s.material.poisson = 0.25;
    CHECK(material_status(PERI_SPACE_SOLID, &s.material, "yield_shear", -1) == PERI_ERROR_LAW);
}

/* The plan knows what history takes; an elastic body has none of it. */
static void memory_is_planned(void) {
    peri_memory held, elastic;
    specimen s = shear_specimen(PERI_SPACE_SOLID);
    s.desc.correction = PERI_CORRECTION_NONE;
    peri_body *plain = specimen_make(&s);
    s.material.yield_shear = yield;
    peri_body *b = specimen_make(&s);
    MUST(b, peri_get_memory(b, &held));
    MUST(plain, peri_get_memory(plain, &elastic));
    CHECK(specimen_plan(&s, 0).bytes == held.total);
    /* four numbers and an index per directed bond, an index per point, and padding */
    const int64_t more = held.total - elastic.total, want = 36 * peri_entry_count(b) + 8 * peri_point_count(b);
    CHECK(more >= want && more < want + 1000);
    peri_body_destroy(plain);
    peri_body_destroy(b);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(family_in_a_cycle);
    RUN(family_in_motion);
    RUN(yields_where_mitchell_does);
    RUN(elastic_below);
    RUN(block_in_a_frame);
    RUN(free_block);
    RUN(tangent_is_the_derivative);
    RUN(tears);
    RUN(refusals);
    RUN(memory_is_planned);
    return test_end("test_plastic");
}
