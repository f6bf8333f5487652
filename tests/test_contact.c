/* SPDX-License-Identifier: MIT */
/* test_contact.c - contact between parts of a body, in motion.

   SOURCE OF TRUTH: the law that peri.h states, worked out by hand for pairs of points; Newton's laws: momentum, energy, equal elastic bars
   that exchange their velocities; Coulomb's law on a slope; the restitution asked for. */
#include "contact_scene.h"

static const int32_t precisions[3] = {PERI_PRECISION_DOUBLE, PERI_PRECISION_MIXED, PERI_PRECISION_SINGLE};

/* ---- the law -------------------------------------------------------------------------------------------------------------------- */

/* Two pieces of four (eight) points, of other moduli and cells, pressed by hand. k = kappa E V/(spacing distance). */
static void the_force_is_that_of_the_law(void) {
    for (int dim = 2; dim <= 3; ++dim)
        for (int p = 0; p < 3; ++p) {
            const double h[2] = {1, 0.9}, young[2] = {3, 5}, depth = 0.07, thickness = dim == 2 ? 0.25 : 1, tiny = p < 2 ? 1e-12 : 1e-5;
            double lo[3] = {0, 0, 0}, hi[3] = {2, 2, 2}, lo2[3] = {6, 0.1, 0.1}, hi2[3] = {7.8, 1.9, 1.9}, way[3] = {0, 0, 0};
            double f[48], x[48], sum[3] = {0, 0, 0}, volume[2], stiffness, mean, energy = 0;
            peri_body_desc d;
            peri_material_desc m;
            peri_contact_desc c;
            peri_energy e;
            peri_body *b = NULL;
            int32_t ids[2];
            peri_body_desc_init(&d);
            d.space = dim == 3 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRESS;
            d.precision = precisions[p];
            d.horizon = 3;
            d.thickness = thickness;
            (void)MUST(NULL, peri_body_create(&d, &b, NULL));
            for (int k = 0; k < 2; ++k) {
                peri_material_desc_init(&m, PERI_LAW_BOND_BASED);
                m.young = young[k];
                m.density = 1 + k;
                ids[k] = (int32_t)MUST(b, peri_add_material(b, &m));
                volume[k] = pow(h[k], dim);
            }
            (void)MUST(b, peri_add_box(b, ids[0], lo, hi, 1));
            (void)MUST(b, peri_add_box(b, ids[1], lo2, hi2, 0.9));
            (void)MUST(b, peri_build(b));
            peri_contact_desc_init(&c);
            c.stiffness = 0.4;
            c.distance = 1.02;
            (void)MUST(b, peri_set_contact(b, ids[1], ids[0], &c));
            way[0] = -(6.45 - 1.5 - (1.02 - depth)); /* facing points then are 0.05 off across */
            (void)MUST(b, peri_add_displacement(b, (int32_t)MUST(b, peri_select_box(b, NULL, lo2, hi2)), way));
            const int64_t n = peri_point_count(b), half = n / 2;
            (void)MUST(b, peri_get_field(b, PERI_FIELD_FORCE_DENSITY, f, n * dim));
            (void)MUST(b, peri_get_field(b, PERI_FIELD_CURRENT_POSITION, x, n * dim));
            mean = (volume[0] + volume[1]) / 2;
            stiffness = 0.4 * 2 * 3 * 5 / (3 + 5.0) * 2 * volume[0] * volume[1] / (volume[0] + volume[1]) / (pow(mean, 1.0 / dim) * 1.02);
            for (int64_t i = 0; i < n; ++i) {
                double want[3] = {0, 0, 0};
                for (int64_t j = 0; j < n; ++j) { /* of the other piece */
                    double r[3] = {0, 0, 0}, length = 0;
                    if ((i < half) == (j < half)) continue;
                    for (int k = 0; k < dim; ++k) r[k] = x[j * dim + k] - x[i * dim + k];
                    length = sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]);
                    if (!(length < 1.02)) continue;
                    for (int k = 0; k < dim; ++k) want[k] -= stiffness * (1.02 - length) * r[k] / length / volume[i >= half];
                    energy += 0.25 * stiffness * (1.02 - length) * (1.02 - length);
                }
                for (int k = 0; k < dim; ++k) {
                    CHECK_NEAR(f[i * dim + k], want[k], 0, 10 * tiny);
                    sum[k] += f[i * dim + k] * volume[i >= half];
                }
            }
            CHECK(energy > 0);
            for (int k = 0; k < dim; ++k) CHECK_NEAR(sum[k], 0, 0, tiny);
            (void)MUST(b, peri_get_energy(b, &e));
            CHECK_NEAR(e.contact, energy * thickness, 0, 10 * tiny);
            CHECK_NEAR(e.initial, energy * thickness, 0, 10 * tiny); /* the caller has put it in */
            CHECK_NEAR(e.error, 0, 0, tiny);
            (void)MUST(b, peri_set_contact(b, PERI_ALL, ids[0], NULL));
            (void)MUST(b, peri_get_field(b, PERI_FIELD_FORCE_DENSITY, f, n * dim));
            for (int64_t k = 0; k < n * dim; ++k) CHECK_NEAR(f[k], 0, 0, tiny);
            (void)MUST(b, peri_get_energy(b, &e)); /* what is removed under pressure is taken out again */
            CHECK_NEAR(e.initial, 0, 0, tiny);
            CHECK_NEAR(e.error, 0, 0, tiny);
            peri_body_destroy(b);
        }
}

/* A body that nothing has moved has no contact, however near its parts are: a crack, a perturbed lattice, two boxes nearer than the
   distance. And contact does not touch a bit of a whole body in motion. */
static void a_body_is_born_at_rest(void) {
    for (int p = 0; p < 3; ++p) {
        const double lo[2] = {0, 0}, hi[2] = {12, 12}, lo2[2] = {12.2, 0}, hi2[2] = {20.2, 12}, a[2] = {-1, 6.1}, z[2] = {30, 6.1};
        double v[2 * 240], f[2 * 240];
        peri_body_desc d;
        peri_contact_desc c;
        peri_energy e;
        peri_body *b, *free_of;
        uint64_t seed = 7;
        peri_body_desc_init(&d);
        d.space = PERI_SPACE_PLANE_STRESS;
        d.precision = precisions[p];
        d.horizon = 1.1;
        b = test_unit_body(&d, 0);
        const int32_t m = peri_id(b, PERI_KIND_MATERIAL, 1);
        (void)MUST(b, peri_add_perturbed_box(b, m, lo, hi, 1, p == 1 ? 0 : 0.3, 3));
        (void)MUST(b, peri_add_box(b, m, lo2, hi2, 1));
        (void)MUST(b, peri_build(b));
        (void)MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, a, z));
        (void)MUST(b, peri_body_clone(b, &free_of, NULL));
        peri_contact_desc_init(&c);
        c.distance = 1.1;
        (void)MUST(b, peri_set_contact(b, m, m, &c));
        (void)MUST(b, peri_get_energy(b, &e));
        CHECK(e.contact == 0);
        (void)MUST(b, peri_get_field(b, PERI_FIELD_FORCE_DENSITY, f, 480));
        for (int k = 0; k < 480; ++k) CHECK(f[k] == 0);
        peri_body_destroy(free_of);
        peri_body_destroy(b);

        peri_body_desc_init(&d);
        d.space = PERI_SPACE_PLANE_STRESS;
        d.precision = precisions[p];
        d.horizon = 3;
        b = test_unit_body(&d, 0);
        (void)MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo, hi, 1));
        (void)MUST(b, peri_build(b));
        for (int k = 0; k < 288; ++k) v[k] = 0.02 * (test_random(&seed) - 0.5);
        (void)MUST(b, peri_set_field(b, PERI_FIELD_VELOCITY, v, 288));
        (void)MUST(b, peri_body_clone(b, &free_of, NULL));
        c.distance = 0;
        (void)MUST(b, peri_set_contact(b, PERI_ALL, PERI_ALL, &c));
        peri_advance_desc r;
        peri_advance_desc_init(&r);
        r.steps = 60;
        r.time_step = 0.9 * peri_stable_step(b);
        (void)MUST(b, peri_advance(b, &r));
        (void)MUST(free_of, peri_advance(free_of, &r));
        CHECK(same_motion(b, free_of));
        peri_body_destroy(free_of);
        peri_body_destroy(b);
    }
}

/* Points at one place push each other apart along the line that joins them in the reference. */
static void points_at_one_place_part(void) {
    for (int p = 0; p < 3; ++p) {
        bars s = bars_of(2, 2, 3, 3);
        double way[2], linear[2], first, second;
        s.desc.precision = precisions[p];
        s.spacing = 0.5; /* so that the way is whole, too */
        s.desc.horizon = 2.0001 * 0.5;
        s.speed = 0;
        s.reach = 2.4; /* 1.5 away */
        peri_body *b = bars_make(&s);
        way[0] = -3;
        way[1] = 0;
        (void)MUST(b, peri_add_displacement(b, (int32_t)MUST(b, peri_find_set(b, "second")), way));
        CHECK(run_for(b, 4e-4) == PERI_OK);
        (void)MUST(b, peri_get_momentum(b, linear, NULL));
        mean_speeds(b, &first, &second);
        CHECK(second > 0 && first < 0);
        CHECK_NEAR(linear[0], 0, 0, (p < 2 ? 1e-14 : 1e-6) * second * 2440 * 2.25);
        peri_body_destroy(b);
    }
}

/* ---- collisions ----------------------------------------------------------------------------------------------------------------- */

/* Equal elastic bars that cannot bulge exchange their velocities: one-dimensional waves. Default step. */
static void bars_exchange(int dim, double reach, int precision, int32_t integrator, int along) {
    bars s = bars_of(dim, reach, along, 2);
    double before[3], after[3], first, second, worst = 0, contact = 0;
    peri_advance_desc a;
    peri_energy e;
    s.held = 1;
    s.contact.friction = dim == 3 ? 0.5 : 0; /* nothing slips */
    s.desc.precision = precisions[precision];
    peri_body *b = bars_make(&s);
    (void)MUST(b, peri_get_momentum(b, before, NULL));
    (void)MUST(b, peri_get_energy(b, &e));
    const double all = e.kinetic;
    peri_advance_desc_init(&a);
    a.integrator = integrator;
    a.duration = (bars_gap(&s) / s.speed + 2 * along * s.spacing / 5000) * 1.2 / 20;
    for (int k = 0; k < 20; ++k) {
        (void)MUST(b, peri_advance(b, &a));
        (void)MUST(b, peri_get_energy(b, &e));
        worst = fmax(worst, fabs(e.error) / all);
        contact = fmax(contact, e.contact / all);
    }
    (void)MUST(b, peri_get_momentum(b, after, NULL));
    mean_speeds(b, &first, &second);
    if (test_long)
        printf("    %dD, m = %g, %s: momentum %.1e, energy %.1e, contact up to %.1e, restitution %.4f, %d steps\n", dim, reach,
               precision == 2 ? "f32" : precision ? "mixed" : "f64", fabs(after[0] / before[0] - 1), worst, contact,
               (second - first) / s.speed, (int)peri_step_count(b));
    CHECK_NEAR(after[0], before[0], precision < 2 ? 1e-14 : 1e-6, 0);
    CHECK(worst < 0.01);
    CHECK(e.contact == 0);
    CHECK_NEAR(e.damping / all, 0, 0, 1e-5);
    CHECK_NEAR((second - first) / s.speed, 1, 0.02, 0);
    peri_body_destroy(b);
}

static void equal_bars_exchange_their_velocities(void) {
    bars_exchange(2, 3, 0, PERI_INTEGRATOR_VELOCITY_VERLET, 40);
    bars_exchange(2, 2, 2, PERI_INTEGRATOR_CENTRAL_DIFFERENCE, 40);
    bars_exchange(3, 2, 1, PERI_INTEGRATOR_VELOCITY_VERLET, 40);
}

/* In 3D bars of 80 cells: of 40 keep 0.976 at m = 3, since the front of a wave, a horizon and a bulge wide, is no small part of them. */
static void equal_bars_of_any_horizon(void) {
    for (int dim = 2; dim <= 3; ++dim)
        for (int m = 2; m <= 5; ++m)
            for (int p = 0; p < 3; ++p) bars_exchange(dim, m, p, PERI_INTEGRATOR_VELOCITY_VERLET, dim == 3 ? 80 : 40);
}

/* Of pieces that are stiff beside their contact, whatever their mass and however many points meet. */
static void restitution_is_as_given(void) {
    const double given[4] = {0.4, 0.5, 0.7, 0.9};
    for (int k = 0; k < 4; ++k)
        for (int kind = 0; kind < 4; ++kind) {
            const int dim = kind == 2 ? 3 : 2, cells = kind == 1 ? 2 : 3;
            bars s = bars_of(dim, 3, cells, cells);
            double first, second, after[3];
            peri_energy e;
            s.contact.stiffness = 0.002;
            s.contact.restitution = given[k];
            s.speed = 5;
            s.desc.precision = kind == 3 ? PERI_PRECISION_SINGLE : PERI_PRECISION_DOUBLE;
            peri_body *b = bars_make(&s);
            CHECK(run_for(b, bars_gap(&s) / s.speed * 1.2) == PERI_OK);
            mean_speeds(b, &first, &second);
            (void)MUST(b, peri_get_momentum(b, after, NULL));
            (void)MUST(b, peri_get_energy(b, &e));
            CHECK(e.contact == 0);
            CHECK_NEAR((second - first) / s.speed, given[k], 0.05, 0);
            CHECK_NEAR((first + second) / s.speed, 1, kind == 3 ? 1e-6 : 1e-14, 0);
            CHECK_NEAR(e.error / e.initial, 0, 0, 0.01);
            CHECK(e.damping > 0);
            peri_body_destroy(b);
        }
}

/* Large bars keep more than they are asked to, stiffer than their contact or not. */
static void bars_lose_little(void) {
    bars s = bars_of(2, 3, 30, 2);
    double first, second;
    s.held = 1;
    s.contact.restitution = 0.6;
    peri_body *b = bars_make(&s);
    CHECK(run_for(b, (bars_gap(&s) / s.speed + 2 * 30 * s.spacing / 5000) * 1.2) == PERI_OK);
    mean_speeds(b, &first, &second);
    CHECK((second - first) / s.speed > 0.85 && (second - first) / s.speed < 0.99);
    peri_body_destroy(b);
}

/* ../shared/cases/01: one block flies into another half a block away. */
static void a_block_pushes_the_next(void) {
    const double lo[2] = {0, 0}, hi[2] = {1, 1}, lo2[2] = {1.5, 0}, hi2[2] = {2.5, 1}, v[2] = {1, 0};
    double first, second, x[400], front[2] = {-9, -9};
    peri_body_desc d;
    peri_contact_desc c;
    peri_material_desc m;
    peri_body *b = NULL;
    peri_body_desc_init(&d);
    d.space = PERI_SPACE_PLANE_STRAIN;
    d.horizon = 0.3;
    (void)MUST(NULL, peri_body_create(&d, &b, NULL));
    peri_material_desc_init(&m, PERI_LAW_BOND_BASED);
    m.young = 1e6;
    m.density = 1000;
    const int32_t id = (int32_t)MUST(b, peri_add_material(b, &m));
    (void)MUST(b, peri_add_box(b, id, lo, hi, 0.1));
    (void)MUST(b, peri_add_box(b, id, lo2, hi2, 0.1));
    (void)MUST(b, peri_build(b));
    peri_contact_desc_init(&c);
    (void)MUST(b, peri_set_contact(b, id, id, &c));
    (void)MUST(b, peri_add_velocity(b, (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi)), v));
    CHECK(run_for(b, 3) == PERI_OK);
    mean_speeds(b, &first, &second);
    (void)MUST(b, peri_get_field(b, PERI_FIELD_CURRENT_POSITION, x, 400));
    for (int i = 0; i < 200; ++i) front[i / 100] = fmax(front[i / 100], x[2 * i]);
    CHECK(second > 0.5 && front[0] < front[1]);
    CHECK_NEAR(first + second, 1, 1e-12, 0);
    peri_body_destroy(b);
}

/* ---- friction ------------------------------------------------------------------------------------------------------------------- */

/* Pieces that scrape as they meet, so that their points pass each other half way through the contact: the momentum across is mu times
   that along, whatever of it the dashpots give. */
static void friction_is_mu_times_the_whole_pressure(void) {
    bars s = bars_of(2, 3, 3, 3);
    double start[2], end[2], v[2] = {5, 2};
    s.contact.stiffness = 0.002;
    s.contact.friction = 0.1;
    s.contact.restitution = 0.4;
    s.speed = 0;
    s.offset = (s.reach + 0.6) * v[1] / v[0] + 0.01; /* level at the mean moment of the impulse, 30 spacings over 5,800 m/s later */
    peri_body *b = bars_make(&s);
    (void)MUST(b, peri_add_velocity(b, (int32_t)MUST(b, peri_find_set(b, "first")), v));
    (void)MUST(b, peri_get_momentum(b, start, NULL));
    CHECK(run_for(b, bars_gap(&s) / v[0] * 1.5) == PERI_OK);
    const int64_t n = peri_point_count(b) / 2;
    double w[64];
    (void)MUST(b, peri_get_field(b, PERI_FIELD_VELOCITY, w, 4 * n));
    end[0] = end[1] = 0;
    for (int64_t i = n; i < 2 * n; ++i)
        for (int d = 0; d < 2; ++d) end[d] += w[2 * i + d] * start[0] / v[0] / (double)n;
    CHECK(end[0] > 0.65 * start[0]);
    CHECK_NEAR(end[1] / end[0], 0.1, 0.05, 0);
    peri_body_destroy(b);
}

/* A block on a slope of fixed points, column on column, for so short a way that the roughness of surfaces of points tells nothing; it
   begins where its weight holds it: what it gains in the second half of the time, and what Coulomb says. */
static void slide(double mu, double viscous, double tangent, double half, double *gained, double *expected, double *speed) {
    const double h = 0.01, g = 1, gap = 3.0001 * h, angle = atan(tangent), lo[2] = {0, 0}, hi[2] = {8 * h, 3 * h};
    const double lo2[2] = {-3 * h, -gap}, hi2[2] = {11 * h, -gap + h};
    double pull[2], momentum[2], last[2] = {0, 0}, way[2] = {0, 0};
    peri_body_desc d;
    peri_material_desc m;
    peri_contact_desc c;
    peri_body *b = NULL;
    peri_body_desc_init(&d);
    d.space = PERI_SPACE_PLANE_STRAIN;
    d.horizon = 3.00005 * h;
    (void)MUST(NULL, peri_body_create(&d, &b, NULL));
    peri_material_desc_init(&m, PERI_LAW_BOND_BASED);
    m.young = 1e9;
    m.density = 1000;
    const int32_t id = (int32_t)MUST(b, peri_add_material(b, &m));
    const int64_t n = MUST(b, peri_add_box(b, id, lo, hi, h));
    (void)MUST(b, peri_add_box(b, id, lo2, hi2, h));
    (void)MUST(b, peri_build(b));
    const int32_t block = (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi)), slope = (int32_t)MUST(b, peri_select_box(b, NULL, lo2, hi2));
    (void)MUST(b, peri_prescribe_displacement(b, slope, PERI_AXIS_XY, NULL, NULL, NULL));
    pull[0] = m.density * g * sin(angle);
    pull[1] = -m.density * g * cos(angle);
    (void)MUST(b, peri_apply_body_force(b, block, pull, NULL, NULL));
    peri_contact_desc_init(&c);
    c.distance = 3 * h;
    c.friction = mu;
    c.friction_speed = viscous;
    c.restitution = 0.5;
    (void)MUST(b, peri_set_contact(b, id, id, &c));
    way[1] = -(gap - 3 * h) + 3 * h * pull[1] / (c.stiffness * m.young / c.distance); /* k/V (d - r) = weight of a column / V */
    (void)MUST(b, peri_add_displacement(b, block, way));
    for (int k = 0; k < 2; ++k) {
        CHECK(run_for(b, half) == PERI_OK);
        (void)MUST(b, peri_get_momentum(b, momentum, NULL));
        if (k == 0) memcpy(last, momentum, sizeof last);
    }
    *gained = (momentum[0] - last[0]) / (half * (double)n * h * h * m.density);
    *speed = momentum[0] / ((double)n * h * h * m.density);
    *expected = g * (sin(angle) - mu * cos(angle));
    peri_body_destroy(b);
}

static void a_block_slides_as_coulomb_says(void) {
    double gained, expected, speed;
    slide(0.5, 0, 1.0, 0.008, &gained, &expected, &speed);
    CHECK_NEAR(gained, expected, 0.02, 0);
    slide(0.5, 0, 0.99 * 0.5, 0.03, &gained, &expected, &speed); /* it holds, but for a creep that does not grow */
    CHECK_NEAR(gained, 0, 0, 0.1 * fabs(expected));
    slide(0.5, 0, 1.01 * 0.5, 0.03, &gained, &expected, &speed);
    CHECK_NEAR(gained, expected, 0.3, 0);
    slide(0.5, 1e-3, 0.25, 0.01, &gained, &expected, &speed); /* viscous: half of the friction at half of the speed */
    CHECK_NEAR(speed, 0.5e-3, 0.03, 0);
}

/* Without friction a block of points rests in the hollows of others up to 30 degrees: at the distance of a spacing two below bear each. At
   three it slides on half of that slope. */
static int rests(double distance, double degrees) {
    const double h = 1, lo[2] = {0, 0}, hi[2] = {6, 3}, lo2[2] = {-6, -3.11 - 0.5}, hi2[2] = {24, -3.11 + 0.5};
    const double slow = 0.005, angle = degrees * acos(-1) / 180;
    double x[2 * 128], pull[2], start[2];
    peri_body_desc d;
    peri_contact_desc c;
    peri_advance_desc a;
    peri_body_desc_init(&d);
    d.space = PERI_SPACE_PLANE_STRAIN;
    d.horizon = 3.05;
    peri_body *b = test_unit_body(&d, 0);
    const int32_t id = peri_id(b, PERI_KIND_MATERIAL, 1);
    const int64_t n = MUST(b, peri_add_box(b, id, lo, hi, h));
    (void)MUST(b, peri_add_box(b, id, lo2, hi2, h));
    (void)MUST(b, peri_build(b));
    (void)MUST(b, peri_prescribe_displacement(b, (int32_t)MUST(b, peri_select_box(b, NULL, lo2, hi2)), PERI_AXIS_XY, NULL, NULL, NULL));
    const int32_t block = (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi));
    pull[0] = 1e-4 * sin(angle);
    pull[1] = -1e-4 * cos(angle);
    (void)MUST(b, peri_apply_body_force(b, block, pull, NULL, NULL));
    peri_contact_desc_init(&c);
    c.distance = distance;
    (void)MUST(b, peri_set_contact(b, id, id, &c));
    start[0] = 0.5;
    start[1] = -(0.5 + 3.11 - sqrt(distance * distance - 0.25));
    (void)MUST(b, peri_add_displacement(b, block, start));
    peri_advance_desc_init(&a);
    a.duration = 800;
    a.damping = slow;
    (void)MUST(b, peri_advance(b, &a));
    (void)MUST(b, peri_get_field(b, PERI_FIELD_CURRENT_POSITION, x, 2 * peri_point_count(b)));
    double moved = -0.5;
    for (int64_t i = 0; i < n; ++i) moved += (x[2 * i] - ((double)(i % 6) + 0.5)) / (double)n;
    peri_body_destroy(b);
    if (test_long) printf("    %g %g: %g\n", distance, degrees, moved);
    return fabs(moved) < 0.3;
}

static void equal_lattices_interlock(void) {
    CHECK(rests(1, 25) && !rests(1, 35));
    CHECK(rests(3, 7) && !rests(3, 15));
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(the_force_is_that_of_the_law);
    RUN(a_body_is_born_at_rest);
    RUN(points_at_one_place_part);
    RUN(equal_bars_exchange_their_velocities);
    LONG_RUN(equal_bars_of_any_horizon);
    RUN(restitution_is_as_given);
    RUN(bars_lose_little);
    RUN(a_block_pushes_the_next);
    RUN(friction_is_mu_times_the_whole_pressure);
    RUN(a_block_slides_as_coulomb_says);
    RUN(equal_lattices_interlock);
    return test_end("test_contact");
}
