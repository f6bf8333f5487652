/* SPDX-License-Identifier: MIT */
/* test_ledger_laws.c - the energy ledger where laws, criteria and contact meet: bonds that break while they are shortened.

   SOURCE OF TRUTH: the first law. What came in is there, was used, or is the error of the step; that of a second-order scheme goes with
   dt^2, and at a break that comes a step sooner or later by no more than a part of it. */
#include "criterion.h"
#include "scene.h"

typedef struct crush {
    int32_t law, space, criterion, integrator, timing;
    double  friction, restitution;
} crush;

typedef struct crushed {
    double  worst;            /* largest |error| in the run, over what came in                                             */
    double  contact, fracture; /* over what came in                                                                        */
    int64_t broken;
} crushed;

/* The ends of the body fly together, and its sides apart. */
static void rush(peri_body *b) {
    const int dim = peri_dimension(b);
    double *x = get(b, PERI_FIELD_POSITION), *v = get(b, PERI_FIELD_VELOCITY);
    for (int64_t i = 0; i < peri_point_count(b); ++i) {
        v[dim * i] = -0.15 * sin(2.0 * (x[dim * i] - 0.6));
        v[dim * i + 1] = 0.045 * (x[dim * i + 1] - 0.4);
    }
    put(b, PERI_FIELD_VELOCITY, v);
    free(x);
    free(v);
}

static peri_body *make_crush(const crush *c) {
    const int solid = c->space == PERI_SPACE_SOLID;
    specimen s = specimen_of(c->space, c->law, bond_nu(c->space), H, solid ? 2.2 : 3, solid ? 8 : 12, solid ? 4 : 8, 4);
    peri_contact_desc touch;
    peri_body *b;
    s.desc.break_timing = c->timing;
    s.material.young = YOUNG;
    s.material.density = DENSITY;
    give_criterion(&s.material, c->criterion, 0.03, s.desc.horizon, 0.1);
    if (c->criterion == PERI_CRITERION_MOHR_COULOMB) s.material.cohesion *= 0.5;
    b = specimen_make(&s);
    peri_contact_desc_init(&touch);
    touch.distance = 1.5 * H; /* Mohr-Coulomb breaks the diagonals of the cells first */
    touch.friction = c->friction;
    touch.restitution = c->restitution;
    (void)MUST(b, peri_set_contact(b, PERI_ALL, PERI_ALL, &touch));
    rush(b);
    return b;
}

static crushed run_crush(const crush *c, double dt, int steps) {
    peri_body *b = make_crush(c);
    peri_energy e;
    crushed l;
    memset(&l, 0, sizeof l);
    for (int k = 0; k < 10; ++k) {
        (void)MUST(b, go(b, c->integrator, steps / 10, dt, 0));
        (void)MUST(b, peri_get_energy(b, &e));
        l.worst = fmax(l.worst, fabs(e.error) / e.initial);
    }
    l.contact = e.contact / e.initial;
    l.fracture = e.fracture / e.initial;
    l.broken = peri_broken_count(b);
    peri_body_destroy(b);
    return l;
}

/* At the end contact has more than 3e-2 of what came in, all of it of pairs that were bonds, since the body has one piece whose surfaces
   are apart: thirty times the bound, 1e-3, that `worst` is held to. At half the step it is held to half of that. */
static void crush_one(const crush *c) {
    for (int half = 0; half < 2; ++half) {
        const crushed l = run_crush(c, 0.005 / (1 << half), 80 << half);
        CHECK(l.broken > 50 && l.contact > 0.03);
        CHECK_NEAR(l.worst, 0, 0, 1e-3 / (1 << half));
    }
}

static void crushed_bodies(void) {
    static const int32_t laws[] = {PERI_LAW_BOND_BASED, PERI_LAW_LPS, PERI_LAW_OTERKUS, PERI_LAW_CORRESPONDENCE};
    for (int k = 0; k < 4; ++k) {
        crush c = {0, PERI_SPACE_PLANE_STRAIN, PERI_CRITERION_VON_MISES, PERI_INTEGRATOR_VELOCITY_VERLET, PERI_BREAK_WITHIN_STEP, 0, 1};
        c.law = laws[k];
        crush_one(&c);
        c.criterion = PERI_CRITERION_MOHR_COULOMB;
        crush_one(&c);
        c.integrator = PERI_INTEGRATOR_CENTRAL_DIFFERENCE;
        c.friction = 0.3;
        c.restitution = 0.8;
        crush_one(&c);
        if (k == 0) c.timing = PERI_BREAK_AFTER_DRIFT, crush_one(&c);
    }
    {
        crush c = {PERI_LAW_LPS, PERI_SPACE_SOLID, PERI_CRITERION_VON_MISES, PERI_INTEGRATOR_VELOCITY_VERLET, PERI_BREAK_WITHIN_STEP, 0, 1};
        crush_one(&c);
        c.law = PERI_LAW_BOND_BASED;
        crush_one(&c);
    }
}

/* A loop of the caller's, velocity Verlet: what he moves is `initial`, and of that `fracture` has what it has in a run, to the O(dt^2) of
   impulses that a run gives the velocity a moment before: 1e-3. */
static void a_loop_of_the_callers(void) {
    const crush c = {PERI_LAW_BOND_BASED, PERI_SPACE_PLANE_STRAIN, PERI_CRITERION_VON_MISES, PERI_INTEGRATOR_VELOCITY_VERLET,
        PERI_BREAK_WITHIN_STEP, 0, 1};
    const double dt = 0.005;
    peri_body *a = make_crush(&c), *b = make_crush(&c);
    const int64_t n = 2 * peri_point_count(b);
    double *u = get(b, PERI_FIELD_DISPLACEMENT), *v = get(b, PERI_FIELD_VELOCITY), *f = get(b, PERI_FIELD_VELOCITY);
    double *impulse = get(b, PERI_FIELD_VELOCITY);
    peri_evaluate_desc e;
    peri_energy run, own;
    peri_evaluate_desc_init(&e);
    (void)MUST(a, go(a, c.integrator, 80, dt, 0));
    (void)MUST(a, peri_get_energy(a, &run));
    e.displacement = u, e.velocity = v, e.force = f, e.fracture = 1;
    (void)MUST(b, peri_evaluate(b, &e, NULL));
    e.impulse = impulse, e.time_step = dt;
    for (int step = 0; step < 80; ++step) {
        for (int64_t k = 0; k < n; ++k) v[k] += 0.5 * dt / DENSITY * f[k], u[k] += dt * v[k];
        (void)MUST(b, peri_evaluate(b, &e, NULL));
        for (int64_t k = 0; k < n; ++k) v[k] += (impulse[k] + 0.5 * dt * f[k]) / DENSITY;
    }
    put(b, PERI_FIELD_VELOCITY, v);
    (void)MUST(b, peri_get_energy(b, &own));
    CHECK(run.contact > 0.1 * run.initial && peri_broken_count(a) == peri_broken_count(b));
    CHECK_NEAR(own.fracture, run.fracture, 0, 1e-3 * run.initial);
    CHECK_NEAR(own.initial, run.initial, 0, 1e-3 * run.initial);
    free(u), free(v), free(f), free(impulse);
    peri_body_destroy(a);
    peri_body_destroy(b);
}

int main(void) {
    RUN(crushed_bodies);
    RUN(a_loop_of_the_callers);
    return test_end("test_ledger_laws");
}
