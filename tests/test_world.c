/* SPDX-License-Identifier: MIT */
/* test_world.c - contact between bodies that advance together.

   SOURCE OF TRUTH: the law that docs/laws.md states, worked out by hand for pairs of points; Newton's laws: momentum, energy, elastic bars
   that exchange their velocities; Coulomb's law; the restitution asked for; a body alone, or one body that holds both. */
#include "world_scene.h"

/* ---- the law -------------------------------------------------------------------------------------------------------------------- */

/* Two cubes of other moduli, cells, densities, thickness and precision, pressed into each other by hand. */
static void forces_are(int dim, int single) {
    const double h[2] = {1, 0.8}, young[2] = {3e9, 5e9}, depth = 0.07, thick[2] = {0.25, 0.5}, distance = 1.02;
    const double tiny = single ? 1e-5 : 1e-12;
    const double way[3] = {-(5.4 - 1.5 - (distance - depth)), 0, 0};
    double f[2][24], x[2][24], volume[2], want[2][24], sum[3] = {0, 0, 0}, scale = 0, energy = 0, force[3];
    peri_body *b[2] = {NULL, NULL};
    peri_contact_desc c;
    peri_advance_desc a;
    peri_energy e;
    peri_world *w = world_make();
    const int n = dim == 2 ? 4 : 8;
    for (int k = 0; k < 2; ++k) {
        const double lo[3] = {k ? 5 : 0, k * 0.1, k * 0.1}, hi[3] = {lo[0] + 2 * h[k], lo[1] + 2 * h[k], lo[2] + 2 * h[k]};
        peri_body_desc d;
        peri_material_desc m;
        peri_body_desc_init(&d);
        d.space = dim == 3 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRESS;
        d.precision = k && single ? PERI_PRECISION_SINGLE : PERI_PRECISION_DOUBLE;
        d.horizon = (2.5 + k) * h[k];
        d.thickness = dim == 2 ? thick[k] : 1;
        (void)MUST(NULL, peri_body_create(&d, &b[k], NULL));
        peri_material_desc_init(&m, PERI_LAW_BOND_BASED);
        m.young = young[k];
        m.density = 1000 * (1 + k);
        (void)MUST(b[k], peri_add_box(b[k], (int32_t)MUST(b[k], peri_add_material(b[k], &m)), lo, hi, h[k]));
        (void)MUST(b[k], peri_build(b[k]));
        volume[k] = pow(h[k], dim) * (dim == 2 ? thick[k] : 1);
        (void)world_must(w, peri_world_add(w, b[k]));
    }
    peri_contact_desc_init(&c);
    c.stiffness = 0.4;
    c.distance = distance;
    (void)world_must(w, peri_world_set_contact(w, b[1], b[0], &c));
    (void)MUST(b[1], peri_add_displacement(b[1], PERI_ALL, way));
    (void)world_must(w, peri_world_get_energy(w, &e));
    const double before = e.contact;
    peri_advance_desc_init(&a);
    a.steps = 1;
    a.time_step = 1e-9 * peri_world_stable_step(w);
    (void)world_must(w, peri_world_advance(w, &a));
    for (int k = 0; k < 2; ++k) {
        (void)MUST(b[k], peri_get_field(b[k], PERI_FIELD_FORCE_DENSITY, f[k], n * dim));
        (void)MUST(b[k], peri_get_field(b[k], PERI_FIELD_CURRENT_POSITION, x[k], n * dim));
    }
    const double stiffness = 0.4 * 2 * 3e9 * 5 / 8 * 2 * volume[0] * volume[1] / (volume[0] + volume[1]) / (0.9 * distance);
    memset(want, 0, sizeof want);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            double r[3] = {0, 0, 0}, length = 0;
            for (int d = 0; d < dim; ++d) r[d] = x[1][j * dim + d] - x[0][i * dim + d];
            length = sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]);
            if (!(length < distance)) continue;
            energy += 0.5 * stiffness * (distance - length) * (distance - length);
            for (int d = 0; d < dim; ++d) {
                want[0][i * dim + d] -= stiffness * (distance - length) * r[d] / length / volume[0];
                want[1][j * dim + d] += stiffness * (distance - length) * r[d] / length / volume[1];
            }
        }
    for (int k = 0; k < 2; ++k)
        for (int i = 0; i < n * dim; ++i) scale = fmax(scale, fabs(want[k][i]));
    CHECK(scale > 0);
    for (int k = 0; k < 2; ++k)
        for (int i = 0; i < n * dim; ++i) {
            CHECK_NEAR(f[k][i] / scale, want[k][i] / scale, 0, 1e-6); /* of the bonds the first step strains */
            sum[i % dim] += f[k][i] * volume[k] / (scale * volume[1]);
        }
    for (int d = 0; d < dim; ++d) CHECK_NEAR(sum[d], 0, 0, tiny);
    CHECK_NEAR(before, energy, 1e-6, 0);
    (void)world_must(w, peri_world_get_energy(w, &e));
    CHECK_NEAR(e.initial, before, 1e-6, 0); /* the caller has put it in */
    CHECK_NEAR(e.error / before, 0, 0, 1e-6);
    (void)world_must(w, peri_world_get_force(w, b[1], force));
    double on_second = 0;
    for (int i = 0; i < n; ++i) on_second += f[1][i * dim] * volume[1];
    CHECK_NEAR(force[0], on_second, 1e-6, 0);
    CHECK(force[0] > 0);
    (void)world_must(w, peri_world_set_contact(w, b[0], NULL, NULL));
    (void)world_must(w, peri_world_get_energy(w, &e)); /* what is removed under pressure is taken out again */
    CHECK(e.contact == 0);
    CHECK_NEAR(e.error / before, 0, 0, 1e-6);
    (void)world_must(w, peri_world_advance(w, &a)); /* and stays so as it goes on */
    (void)world_must(w, peri_world_get_energy(w, &e));
    CHECK_NEAR(e.error / before, 0, 0, 1e-6);
    peri_world_destroy(w);
    for (int k = 0; k < 2; ++k) peri_body_destroy(b[k]);
}

static void the_force_is_that_of_the_law(void) {
    for (int dim = 2; dim <= 3; ++dim)
        for (int single = 0; single < 2; ++single) forces_are(dim, single);
}

/* ---- collisions ----------------------------------------------------------------------------------------------------------------- */

/* Bars of one material that cannot bulge, of other horizons, cells and precisions: one-dimensional waves. The first comes to rest as the
   wave that the free end of the second sends back, or its own, has passed: it gives the second its momentum. */
static int cells = 40; /* of the first */

static void bars_meet(int dim, double reach, double other_reach, double coarser, int longer, int single, int32_t integrator) {
    bars s = bars_of(dim, reach, cells, 2), o = bars_of(dim, other_reach, (int)(cells * longer / coarser), 2);
    double before[3], after[3], worst = 0, contact = 0, exchanged = 0, total[3] = {0, 0, 0};
    peri_advance_desc a;
    peri_energy e;
    s.held = o.held = 1;
    s.desc.correction = o.desc.correction = PERI_CORRECTION_MOMENT; /* else bars of another horizon have another impedance */
    o.spacing = coarser * s.spacing;
    o.across[1] = o.across[2] = (int)(2 / coarser);
    s.across[1] = s.across[2] = 2;
    o.desc.horizon = other_reach * 1.0001 * o.spacing;
    if (single) o.desc.precision = PERI_PRECISION_SINGLE;
    const double length = cells * s.spacing, gap = 0.6 * s.spacing;
    peri_body *b[2] = {bar_at(&s, 0, s.speed), bar_at(&o, length + gap, 0)};
    peri_world *w = world_make();
    for (int k = 0; k < 2; ++k) (void)world_must(w, peri_world_add(w, b[k]));
    (void)MUST(b[0], peri_get_momentum(b[0], before, NULL));
    (void)world_must(w, peri_world_get_energy(w, &e));
    const double all = e.kinetic;
    peri_advance_desc_init(&a);
    a.integrator = integrator;
    a.duration = (gap / s.speed + 2 * length * longer / 5000) * 1.2 / 20;
    for (int k = 0; k < 20; ++k) {
        (void)world_must(w, peri_world_advance(w, &a));
        (void)world_must(w, peri_world_get_energy(w, &e));
        worst = fmax(worst, fabs(e.error) / all);
        contact = fmax(contact, e.contact / all);
    }
    for (int k = 0; k < 2; ++k) {
        peri_energy own;
        (void)MUST(b[k], peri_get_momentum(b[k], after, NULL));
        (void)MUST(b[k], peri_get_energy(b[k], &own));
        CHECK(fabs(own.error) < 0.01 * all); /* what the other does is its work */
        CHECK(k == 0 ? own.external < -0.1 * all : own.external > 0.1 * all);
        total[0] += after[0];
        exchanged = after[0];
    }
    if (test_long)
        printf("    %dD, m = %g and %g, cells 1 and %g, lengths 1 and %d, %s: momentum %.1e, energy %.1e, contact %.1e, apart with %.4f\n",
               dim, reach, other_reach, coarser, longer, single ? "f32" : "f64", fabs(total[0] - before[0]) / before[0], worst, contact,
               (mean_speed(b[1]) - mean_speed(b[0])) / s.speed);
    CHECK(exchanged > 0.9 * before[0]);
    CHECK_NEAR(total[0], before[0], single ? 1e-6 : 1e-14, 0);
    CHECK(worst < 0.01);
    CHECK(contact > 1e-4 && e.contact == 0);
    CHECK(e.damping == 0);
    /* two bars of other lengths part as the tail of the wave passes: 0.035 too fast at 40 cells, 0.012 at 160 */
    CHECK_NEAR((mean_speed(b[1]) - mean_speed(b[0])) / s.speed, 1.0 / longer, 0, longer == 1 ? 0.02 : 0.05);
    peri_body_destroy(b[0]);
    peri_world_destroy(w);
    peri_body_destroy(b[1]);
}

static void bars_exchange_their_velocities(void) {
    bars_meet(2, 3, 3, 1, 1, 0, PERI_INTEGRATOR_VELOCITY_VERLET);
    bars_meet(2, 2, 3, 1, 1, 1, PERI_INTEGRATOR_CENTRAL_DIFFERENCE);
    bars_meet(2, 3, 3, 0.5, 1, 0, PERI_INTEGRATOR_CENTRAL_DIFFERENCE);
    bars_meet(2, 3, 2, 1, 2, 1, PERI_INTEGRATOR_VELOCITY_VERLET);
    bars_meet(3, 2, 3, 1, 1, 1, PERI_INTEGRATOR_VELOCITY_VERLET);
}

/* In 3D bars of 80 cells, as in test_contact.c. Of one horizon: two cells across, bars of m = 5 are not as stiff as those of 2. */
static void bars_of_any_horizon(void) {
    for (int dim = 2; dim <= 3; ++dim)
        for (int m = 2; m <= 5; ++m)
            for (int single = 0; single < 2; ++single) {
                cells = dim == 3 ? 80 : 40;
                bars_meet(dim, m, m, 1, 1, single, PERI_INTEGRATOR_VELOCITY_VERLET);
            }
    cells = 40;
}

/* ---- beside one body ----------------------------------------------------------------------------------------------------------- */

/* A world of one body is that body, to the last bit, whatever the run. */
static void a_world_of_one_is_the_body_alone(void) {
    for (int kind = 0; kind < 4; ++kind) {
        bars s = bars_of(2, 3, 12, 4);
        double v[96];
        uint64_t seed = 5;
        peri_advance_desc a;
        peri_energy e, f;
        s.material.fracture_energy = kind == 2 ? 1 : 100;
        s.desc.precision = kind == 1 ? PERI_PRECISION_SINGLE : PERI_PRECISION_DOUBLE;
        peri_body *b = bar_at(&s, 3e-3, 0), *alone;
        for (int k = 0; k < 96; ++k) v[k] = 60 * (test_random(&seed) - 0.5);
        (void)MUST(b, peri_set_field(b, PERI_FIELD_VELOCITY, v, 96));
        (void)MUST(b, peri_body_clone(b, &alone, NULL));
        peri_world *w = world_make();
        (void)world_must(w, peri_world_add(w, b));
        peri_advance_desc_init(&a);
        a.integrator = kind == 3 ? PERI_INTEGRATOR_CENTRAL_DIFFERENCE : PERI_INTEGRATOR_VELOCITY_VERLET;
        a.damping = kind == 3 ? 1e4 : 0;
        CHECK(peri_world_stable_step(w) == peri_stable_step(alone));
        for (int run = 0; run < 3; ++run) {
            a.steps = run == 1 ? 0 : 40;
            a.duration = run == 1 ? 3.3e-6 : 0;
            a.time_step = run == 2 ? 0.7 * peri_stable_step(alone) : 0;
            (void)world_must(w, peri_world_advance(w, &a));
            (void)MUST(alone, peri_advance(alone, &a));
        }
        CHECK(same_motion(b, alone));
        CHECK(peri_time(b) == peri_time(alone) && peri_step_count(b) == peri_step_count(alone));
        CHECK(peri_broken_count(b) == peri_broken_count(alone) && (kind != 2 || peri_broken_count(b) > 0));
        (void)MUST(alone, peri_get_energy(alone, &f));
        (void)world_must(w, peri_world_get_energy(w, &e));
        CHECK(e.elastic == f.elastic && e.kinetic == f.kinetic && e.damping == f.damping && e.contact == 0);
        CHECK_NEAR(e.error, f.error, 1e-9, 1e-12 * f.kinetic);
        peri_world_destroy(w);
        peri_body_destroy(b);
        peri_body_destroy(alone);
    }
}

/* Bodies that never meet are as each alone with the same step. */
static void those_who_never_meet_are_alone(void) {
    bars s = bars_of(2, 3, 8, 3), o = bars_of(2, 2, 6, 3);
    double v[48];
    uint64_t seed = 11;
    peri_advance_desc a;
    o.spacing = 0.7e-3;
    o.desc.horizon = 2.01 * o.spacing;
    o.material.young = 3e9;
    o.desc.precision = PERI_PRECISION_SINGLE;
    peri_body *b[2] = {bar_at(&s, 0, 5), bar_at(&o, 8e-3 + 0.4e-3, 5)}, *alone[2];
    peri_world *w = world_make();
    for (int k = 0; k < 48; ++k) v[k] = 5 + (test_random(&seed) - 0.5) * 0.1;
    (void)MUST(b[0], peri_set_field(b[0], PERI_FIELD_VELOCITY, v, 48));
    for (int k = 0; k < 2; ++k) {
        (void)MUST(b[k], peri_body_clone(b[k], &alone[k], NULL));
        (void)world_must(w, peri_world_add(w, b[k]));
    }
    peri_advance_desc_init(&a);
    a.time_step = 0.8 * peri_world_stable_step(w);
    for (int run = 0; run < 2; ++run) {
        a.steps = run == 0 ? 60 : 0;
        a.duration = run == 1 ? 33.3 * a.time_step : 0;
        (void)world_must(w, peri_world_advance(w, &a));
        for (int k = 0; k < 2; ++k) (void)MUST(alone[k], peri_advance(alone[k], &a));
    }
    for (int k = 0; k < 2; ++k) {
        CHECK(same_motion(b[k], alone[k]));
        CHECK(peri_time(b[k]) == peri_time(alone[k]));
    }
    peri_world_destroy(w);
    for (int k = 0; k < 2; ++k) peri_body_destroy(b[k]), peri_body_destroy(alone[k]);
}

/* Two bars in a world are as one body that holds both and whose parts touch each other, to rounding. */
static void two_are_as_one_with_two_parts(void) {
    for (int kind = 0; kind < 2; ++kind) {
        bars s = bars_of(2, 3, 10, 4);
        double v[160], u[2][80];
        peri_advance_desc a;
        peri_energy e, f;
        s.offset = 0.3;
        s.contact.friction = kind ? 0.3 : 0;
        s.contact.restitution = kind ? 0.6 : 1;
        peri_body *both = bars_make(&s);
        bars t = s;
        peri_body *b[2];
        b[0] = bar_at(&t, 0, s.speed);
        b[1] = bar_at(&t, 10 * s.spacing + bars_gap(&s), 0);
        const double aside[2] = {0, s.offset * s.spacing};
        (void)MUST(b[1], peri_add_displacement(b[1], PERI_ALL, aside));
        peri_world *w = world_make();
        for (int k = 0; k < 2; ++k) (void)world_must(w, peri_world_add(w, b[k]));
        (void)world_must(w, peri_world_set_contact(w, NULL, NULL, &s.contact));
        peri_advance_desc_init(&a);
        a.time_step = 0.9 * peri_stable_step(both);
        CHECK_NEAR(a.time_step, 0.9 * peri_world_stable_step(w), 0.001, 0);
        a.duration = bars_gap(&s) / s.speed + 4e-6;
        (void)MUST(both, peri_advance(both, &a));
        a.force_step = 1; /* the estimate differs in the last digits */
        (void)world_must(w, peri_world_advance(w, &a));
        (void)MUST(both, peri_get_field(both, PERI_FIELD_VELOCITY, v, 160));
        for (int k = 0; k < 2; ++k) (void)MUST(b[k], peri_get_field(b[k], PERI_FIELD_VELOCITY, u[k], 80));
        for (int k = 0; k < 160; ++k) CHECK_NEAR(u[k / 80][k % 80], v[k], 0, 1e-8 * s.speed);
        (void)MUST(both, peri_get_energy(both, &e));
        (void)world_must(w, peri_world_get_energy(w, &f));
        CHECK(e.contact > 1e-6 * e.initial && (kind == 0 || e.damping > 1e-4 * e.initial));
        CHECK_NEAR(f.contact, e.contact, 1e-6, 0);
        CHECK_NEAR(f.damping, e.damping, 1e-6, 0);
        CHECK_NEAR(f.initial, e.initial, 1e-9, 0);
        CHECK_NEAR(f.error, e.error, 1e-3, 1e-9 * e.initial);
        peri_world_destroy(w);
        peri_body_destroy(both);
        for (int k = 0; k < 2; ++k) peri_body_destroy(b[k]);
    }
}

/* ---- as given ------------------------------------------------------------------------------------------------------------------ */

/* Of pieces that are stiff beside their contact, of unlike mass, cells and density. */
static void restitution_is_as_given(void) {
    const double given[3] = {0.4, 0.7, 0.9};
    for (int k = 0; k < 3; ++k)
        for (int kind = 0; kind < 3; ++kind) {
            const int dim = kind == 2 ? 3 : 2;
            bars s = bars_of(dim, 3, 3, 3), o = bars_of(dim, 3, kind == 1 ? 4 : 3, kind == 1 ? 4 : 3);
            double one[3], two[3], gap;
            peri_energy e;
            s.contact.stiffness = 0.002;
            s.contact.restitution = given[k];
            s.speed = 5;
            if (kind == 1) o.spacing = 0.75 * s.spacing, o.desc.horizon *= 0.75;
            if (kind == 1) o.material.density *= 1.5, o.material.young *= 1.5;
            gap = 0.6 * s.spacing;
            peri_body *b[2] = {bar_at(&s, 0, s.speed), bar_at(&o, 3 * s.spacing + gap, 0)};
            peri_world *w = world_make();
            for (int n = 0; n < 2; ++n) (void)world_must(w, peri_world_add(w, b[n]));
            (void)world_must(w, peri_world_set_contact(w, b[0], b[1], &s.contact));
            (void)MUST(b[0], peri_get_momentum(b[0], one, NULL));
            const double start = one[0];
            (void)world_must(w, world_for(w, gap / s.speed * 2));
            (void)MUST(b[0], peri_get_momentum(b[0], one, NULL));
            (void)MUST(b[1], peri_get_momentum(b[1], two, NULL));
            (void)world_must(w, peri_world_get_energy(w, &e));
            CHECK_NEAR(e.contact / e.initial, 0, 0, 1e-12);
            CHECK_NEAR((mean_speed(b[1]) - mean_speed(b[0])) / s.speed, given[k], 0.05, 0);
            CHECK_NEAR((one[0] + two[0]) / start, 1, 1e-14, 0);
            CHECK_NEAR(e.error / e.initial, 0, 0, 0.01);
            CHECK(e.damping > 0);
            for (int n = 0; n < 2; ++n) peri_body_destroy(b[n]);
            peri_world_destroy(w);
        }
}

/* A block that rests on another, which is held below: the weight goes through the contact into the support, and friction holds what pulls
   the upper block aside with less than mu of its weight, and lets go what pulls with more. */
static void rest(double pull, double *weight, double *aside, double *reaction, double *moved) {
    const double h = 0.05, lo[2] = {0, 0}, hi[2] = {8 * h, 4 * h}, lo2[2] = {2 * h, 4 * h}, hi2[2] = {6 * h, 8 * h}, bed[2] = {8 * h, h};
    double force[2], load[2] = {pull, -1};
    peri_body *b[2];
    peri_contact_desc c;
    peri_advance_desc a;
    peri_world *w = world_make();
    for (int k = 0; k < 2; ++k) {
        peri_body_desc d;
        peri_body_desc_init(&d);
        d.space = PERI_SPACE_PLANE_STRAIN;
        d.horizon = 3.01 * h;
        b[k] = test_unit_body(&d, 0);
        (void)MUST(b[k], peri_add_box(b[k], peri_id(b[k], PERI_KIND_MATERIAL, 1), k ? lo2 : lo, k ? hi2 : hi, h));
        (void)MUST(b[k], peri_build(b[k]));
        (void)world_must(w, peri_world_add(w, b[k]));
    }
    for (int k = 0; k < 2; ++k) load[k] *= 1e-5;
    (void)MUST(b[1], peri_apply_body_force(b[1], PERI_ALL, load, NULL, NULL));
    const int32_t held = (int32_t)MUST(b[0], peri_prescribe_displacement(b[0], (int32_t)MUST(b[0], peri_select_box(b[0], NULL, lo, bed)),
                                                                         PERI_AXIS_XY, NULL, NULL, NULL));
    peri_contact_desc_init(&c);
    c.friction = 0.5;
    c.restitution = 0.5;
    (void)world_must(w, peri_world_set_contact(w, NULL, NULL, &c));
    peri_advance_desc_init(&a);
    a.duration = 60;
    a.damping = 0.05;
    (void)world_must(w, peri_world_advance(w, &a));
    (void)world_must(w, peri_world_get_force(w, b[1], force));
    *weight = force[1] / (1e-5 * 16 * h * h);
    *aside = force[0] / (1e-5 * 16 * h * h);
    (void)MUST(b[0], peri_get_reaction(b[0], held, force));
    *reaction = force[1] / (1e-5 * 16 * h * h);
    *moved = mean_speed(b[1]);
    peri_world_destroy(w);
    for (int k = 0; k < 2; ++k) peri_body_destroy(b[k]);
}

static void a_block_rests_on_another(void) {
    double weight, aside, reaction, speed, faster;
    rest(0, &weight, &aside, &reaction, &speed);
    CHECK_NEAR(weight, 1, 1e-3, 0);
    CHECK_NEAR(reaction, 1, 1e-3, 0);
    CHECK_NEAR(aside, 0, 0, 1e-6);
    rest(0.4, &weight, &aside, &reaction, &speed);
    CHECK_NEAR(weight, 1, 1e-2, 0);
    CHECK_NEAR(aside, -(0.4 - 0.05 * speed / 1e-5), 1e-3, 0); /* it creeps, which the damping resists, too */
    CHECK(fabs(speed) < 0.02 * 0.4e-5 * 60);
    rest(0.8, &weight, &aside, &reaction, &faster);
    CHECK(faster > 10 * fabs(speed));
}

/* Three equal bars in a row: what the first brings the last takes away. */
static void a_cradle_hands_it_on(void) {
    bars s = bars_of(2, 3, 40, 2);
    peri_body *b[3];
    peri_world *w = world_make();
    s.held = 1;
    for (int k = 0; k < 3; ++k) {
        b[k] = bar_at(&s, k * 40.4 * s.spacing, k == 0 ? s.speed : 0);
        (void)world_must(w, peri_world_add(w, b[k]));
    }
    (void)world_must(w, world_for(w, 0.9 * s.spacing / s.speed + 3.6 * 40 * s.spacing / 5000));
    CHECK_NEAR(mean_speed(b[0]) / s.speed, 0, 0, 0.02);
    CHECK_NEAR(mean_speed(b[1]) / s.speed, 0, 0, 0.02);
    CHECK_NEAR(mean_speed(b[2]) / s.speed, 1, 0.02, 0);
    for (int k = 0; k < 3; ++k) peri_body_destroy(b[k]);
    peri_world_destroy(w);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(the_force_is_that_of_the_law);
    RUN(bars_exchange_their_velocities);
    LONG_RUN(bars_of_any_horizon);
    RUN(a_world_of_one_is_the_body_alone);
    RUN(those_who_never_meet_are_alone);
    RUN(two_are_as_one_with_two_parts);
    RUN(restitution_is_as_given);
    RUN(a_block_rests_on_another);
    RUN(a_cradle_hands_it_on);
    return test_end("test_world");
}
