/* SPDX-License-Identifier: MIT */
/* test_free_bodies.c - obstacles that rub, swallow energy and move: Coulomb's law on a slope, restitution, impact on free rigid bodies,
   their spin, the stable step, reset and clones.
   SOURCE OF TRUTH: conservation of momentum, angular momentum and energy; Coulomb and Galileo; Euler's equations of a top. */
#include "refusal.h"

static peri_obstacle_desc shaped(int32_t shape) {
    peri_obstacle_desc d;
    peri_obstacle_desc_init(&d, shape);
    return d;
}
static peri_obstacle_state state_of(peri_body *b, int32_t obstacle) {
    peri_obstacle_state s;
    memset(&s, 0, sizeof s);
    MUST(b, peri_get_obstacle_state(b, obstacle, &s));
    return s;
}

/* ---- friction ------------------------------------------------------------------------------------------------------- */

#define SLIP 3e-4 /* friction_speed */

typedef struct slide {
    double speed, gained; /* along the slope at the end; what Coulomb's law leaves of the weight, times the time */
    double drift;         /* mean speed */
    double balance;       /* of the energies, over what friction took */
} slide;

/* A block of 8 x 2 points, stiff beside the slope (stiffness 0.01), put where its weight and the slope balance. */
static double mean(const double *u, int points) { /* of x in 2D */
    double sum = 0;
    for (int i = 0; i < points; ++i) sum += u[2 * i] / points;
    return sum;
}

static slide slide_down(double angle, double mu, double time, int32_t integrator) {
    peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR, 8, 2, 1);
    const double weight = 2e-3, stiffness = 2, g[2] = {weight * sin(angle), -weight * cos(angle)};
    const double down[2] = {0, -2 * weight * cos(angle) / stiffness}; /* two rows on one */
    peri_obstacle_desc d = shaped(PERI_SHAPE_PLANE);
    double p[2];
    slide s;
    peri_energy e;
    d.place[1] = 0.5 * H;
    d.normal[1] = 1;
    d.stiffness = stiffness;
    d.friction = mu;
    d.friction_speed = SLIP;
    const int32_t ground = (int32_t)MUST(b, peri_add_obstacle(b, &d));
    MUST(b, peri_apply_body_force(b, PERI_ALL, g, NULL, NULL));
    MUST(b, peri_add_displacement(b, PERI_ALL, down));
    peri_advance_desc a;
    peri_advance_desc_init(&a);
    a.integrator = integrator;
    a.duration = time;
    MUST(b, peri_advance(b, &a));
    MUST(b, peri_get_momentum(b, p, NULL));
    MUST(b, peri_get_energy(b, &e));
    double *u = get(b, PERI_FIELD_DISPLACEMENT);
    s.drift = mean(u, 16) / time;
    free(u);
    const double volume = 16 * H * H * THICK;
    const peri_obstacle_state o = state_of(b, ground);
    s.speed = p[0] / (volume * DENSITY);
    s.gained = weight / DENSITY * (sin(angle) - mu * cos(angle)) * time;
    const double stored = 0.5 * stiffness * pow(down[1], 2) * 8 * H * H * THICK; /* at the start */
    s.balance = (e.obstacle + o.stored - stored + o.lost) / o.lost;
    CHECK(fabs(e.error) <= 1e-3 * e.external);
    peri_body_destroy(b);
    return s;
}

static void a_block_slides_by_coulombs_law(void) {
    const double angle = 0.4, times[3] = {1.01, 2.0, 1e9};
    for (int k = 0; k < 3; ++k)
        for (int32_t integrator = PERI_INTEGRATOR_VELOCITY_VERLET; integrator <= PERI_INTEGRATOR_CENTRAL_DIFFERENCE; ++integrator) {
            if (k == 0 && integrator > PERI_INTEGRATOR_VELOCITY_VERLET) continue; /* takes long */
            const slide s = slide_down(angle, tan(angle) / times[k], k == 0 ? 6000 : 200, integrator);
            printf("    tan(angle) = %.3g mu: speed %.6g for %.6g, balance %.2g\n", times[k], s.speed, s.gained, s.balance);
            CHECK_NEAR(s.speed, s.gained, 0.02, 0);
            if (k < 2) CHECK(fabs(s.balance) <= 0.01);
        }
    const slide held = slide_down(angle, tan(angle) / 0.99, 400, PERI_INTEGRATOR_VELOCITY_VERLET);
    printf("    tan(angle) = 0.99 mu: drift %.6g\n", held.drift);
    CHECK(held.drift > 0 && held.drift <= 1.1 * SLIP); /* steady creep is 0.99 of it; the block shakes */
}

/* A coefficient of velocity c makes 2/w to (sqrt(w^2 + c^2/4) - c/2) 2/w^2: that of all such obstacles takes a quarter of it at most. */
static void what_rubs_makes_steps_smaller(void) {
    double step[3];
    for (int k = 0; k < 3; ++k) {
        peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR, 8, 4, 1);
        peri_obstacle_desc d = shaped(PERI_SHAPE_PLANE);
        d.place[1] = -1;
        d.normal[1] = 1;
        d.stiffness = 1e-6;
        if (k == 1) d.friction = 0.1;
        if (k == 2) d.restitution = 0.9;
        MUST(b, peri_add_obstacle(b, &d));
        step[k] = peri_stable_step(b);
        peri_body_destroy(b);
    }
    printf("    stable step with friction %.4f, with restitution %.4f of that without\n", step[1] / step[0], step[2] / step[0]);
    CHECK(step[1] == step[2] && step[1] < step[0] && step[1] > 0.75 * step[0]);
}

/* ---- restitution ----------------------------------------------------------------------------------------------------- */

static void a_block_comes_back_with_its_restitution(void) {
    const double given[4] = {1, 0.8, 0.5, 0.3}, v0[2] = {0, -0.01};
    for (int k = 0; k < 4; ++k) {
        peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR, 8, 8, 1);
        peri_obstacle_desc d = shaped(PERI_SHAPE_PLANE);
        double p0[2], p[2];
        peri_energy e;
        d.place[1] = 0.5 * H - 0.01;
        d.normal[1] = 1;
        d.stiffness = 2;
        d.restitution = given[k];
        if (k == 0) d.friction = 0.5; /* takes nothing of a straight fall but by what spreads sideways */
        const int32_t ground = (int32_t)MUST(b, peri_add_obstacle(b, &d));
        MUST(b, peri_add_velocity(b, PERI_ALL, v0));
        MUST(b, peri_get_momentum(b, p0, NULL));
        go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 700, 0, 0);
        MUST(b, peri_get_momentum(b, p, NULL));
        MUST(b, peri_get_energy(b, &e));
        const peri_obstacle_state o = state_of(b, ground);
        printf("    restitution %.2f: %.4f; work %.4g, lost %.4g, error %.2g\n", given[k], -p[1] / p0[1], e.obstacle / e.initial,
               o.lost / e.initial, e.error / e.initial);
        CHECK_NEAR(-p[1] / p0[1], given[k], 0.05, 0);
        CHECK_NEAR(e.obstacle, -o.lost, 0.01, 1e-4 * e.initial);
        CHECK(k > 0 || o.lost < 0.01 * e.initial);
        CHECK(o.stored == 0);
        peri_body_destroy(b);
    }
}

/* ---- free bodies ------------------------------------------------------------------------------------------------------- */

static void cross(const double *a, const double *b, double *out) {
    for (int k = 0; k < 3; ++k) out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

/* Momentum (3) and angular momentum (3) of the body and of a ball of this moment of inertia; the energy of all in sums[6]. */
static void sum_up(peri_body *b, int32_t ball, double inertia, double *sums) {
    const int dim = peri_dimension(b);
    const peri_obstacle_state s = state_of(b, ball);
    double p[3] = {0}, l[3] = {0}, way[3], spin[3] = {0, 0, s.spin[0]};
    peri_energy e;
    MUST(b, peri_get_momentum(b, p, dim == 3 ? l : l + 2));
    MUST(b, peri_get_energy(b, &e));
    cross(s.place, s.velocity, way);
    for (int k = 0; k < 3; ++k) {
        sums[k] = p[k] + s.mass * s.velocity[k];
        sums[3 + k] = l[k] + s.mass * way[k] + inertia * (dim == 3 ? s.spin : spin)[k];
    }
    sums[6] = e.kinetic + e.elastic + s.kinetic + s.stored + s.lost;
}

/* A ball with a spin hits a block that flies free, off its middle, and rubs: both integrators, both precisions, 2D and 3D. Rounding of some
   1e3 steps is held to 1e-13 and 1e-5 of the ball's momentum. The energy is that of velocity-Verlet, to O(dt^2). */
static void a_free_ball_hits(int32_t space) {
    const int dim = dim_of(space);
    double found[2][7];
    for (int32_t integrator = 0; integrator < 2; ++integrator)
        for (int32_t precision = PERI_PRECISION_DOUBLE; precision <= PERI_PRECISION_SINGLE; precision += 2) {
            peri_body *b = block(space, precision, PERI_GEOMETRY_NONLINEAR, 8, 6, 4);
            peri_obstacle_desc d = shaped(PERI_SHAPE_BALL);
            const double place[3] = {0.55, 0.81, 0.23}, velocity[3] = {0.01, -0.05, 0.02}, spin[3] = {0.5, 0.1, -0.3};
            const double most = precision == PERI_PRECISION_DOUBLE ? 1e-13 : 1e-5;
            double start[7], now[7] = {0}, f[3], moment[3];
            memcpy(d.place, place, sizeof place);
            memcpy(d.velocity, velocity, sizeof velocity);
            memcpy(d.spin, spin, sizeof spin);
            d.radius = 0.2;
            d.density = 4;
            d.friction = 0.3;
            const int32_t ball = (int32_t)MUST(b, peri_add_obstacle(b, &d));
            const peri_obstacle_state o = state_of(b, ball);
            const double inertia = (dim == 2 ? 0.5 : 0.4) * o.mass * 0.04;
            CHECK_NEAR(o.mass, dim == 2 ? 4 * PI * 0.04 * THICK : 4 * 4 / 3.0 * PI * 0.008, 1e-12, 0);
            const double square = dim == 2 ? 0.0026 : 0.003, spins = dim == 2 ? 0.25 : 0.35; /* of velocity and spin */
            CHECK_NEAR(o.kinetic, 0.5 * o.mass * square + 0.5 * inertia * spins, 1e-12, 0);
            sum_up(b, ball, inertia, start);
            int touched = 0;
            for (int k = 0; k < 10; ++k) {
                go(b, PERI_INTEGRATOR_VELOCITY_VERLET + integrator, 15, 0, 0);
                sum_up(b, ball, inertia, now);
                for (int n = 0; n < 6; ++n) CHECK_NEAR(now[n], start[n], 0, most * o.mass * 0.05);
                CHECK_NEAR(now[6], start[6], 0.01, 0);
                MUST(b, peri_get_obstacle_force(b, ball, f, moment));
                touched += f[1] < 0;
            }
            CHECK(touched > 0 && touched < 10 && f[1] == 0 && moment[0] == 0);
            const peri_obstacle_state s = state_of(b, ball);
            if (precision == PERI_PRECISION_DOUBLE) memcpy(found[integrator], s.velocity, 6 * sizeof(double));
            printf("    %dD %s: ball %.4g -> %.4g, spin %.4g -> %.4g, lost %.3g, energy off by %.2g\n", dim,
                   precision == PERI_PRECISION_DOUBLE ? "f64" : "f32", o.velocity[1], s.velocity[1], o.spin[0], s.spin[0],
                   s.lost / start[6], now[6] / start[6] - 1);
            CHECK(s.velocity[1] > -0.025 && s.lost > 0.01 * start[6] && fabs(s.spin[0]) < fabs(o.spin[0]));
            peri_body_destroy(b);
        }
    for (int k = 0; k < 6; ++k) CHECK_NEAR(found[0][k], found[1][k], 1e-10, 1e-14); /* the same motion */
}
static void a_free_ball_hits_in_2d(void) { a_free_ball_hits(PERI_SPACE_PLANE_STRESS); }
static void a_free_ball_hits_in_3d(void) { a_free_ball_hits(PERI_SPACE_SOLID); }

static peri_body *far_block(int32_t space) { return block(space, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR, 4, 4, 4); }

/* Without touch: the centre of mass of a wedge falls on Galileo's parabola, as that lies off the origin of its frame the place goes
   round it, and energy changes by the work of gravity. */
static void free_fall(void) {
    peri_body *b = far_block(PERI_SPACE_PLANE_STRAIN);
    const double wedge[6] = {0, 0, 0.3, 0, 0, 0.6}, off[2] = {0.1, 0.2}; /* centre of a triangle */
    peri_obstacle_desc d = shaped(PERI_SHAPE_MESH);
    d.vertex_count = 3;
    d.vertices = wedge;
    d.place[0] = 10;
    d.place[1] = 20;
    d.turn[0] = 0.3;
    d.mass = 7;
    d.velocity[0] = 0.2;
    d.spin[0] = 2;
    d.gravity[1] = -0.5;
    const int32_t stone = (int32_t)MUST(b, peri_add_obstacle(b, &d));
    const peri_obstacle_state o = state_of(b, stone);
    go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 400, 0.01, 0);
    const peri_obstacle_state s = state_of(b, stone);
    double from[2], to[2], speed[2]; /* of the centre of mass */
    for (int k = 0; k < 2; ++k) {
        const double c0 = cos(0.3), s0 = sin(0.3), c1 = cos(s.turn[0]), s1 = sin(s.turn[0]);
        from[k] = d.place[k] + (k == 0 ? c0 * off[0] - s0 * off[1] : s0 * off[0] + c0 * off[1]);
        to[k] = s.place[k] + (k == 0 ? c1 * off[0] - s1 * off[1] : s1 * off[0] + c1 * off[1]);
    }
    speed[0] = d.velocity[0] - 2 * (from[1] - d.place[1]);
    speed[1] = d.velocity[1] + 2 * (from[0] - d.place[0]);
    CHECK_NEAR(s.turn[0], 0.3 + 2 * 4, 1e-12, 0);
    CHECK_NEAR(s.spin[0], 2, 1e-12, 0);
    CHECK_NEAR(to[0], from[0] + 4 * speed[0], 1e-12, 0);
    CHECK_NEAR(to[1], from[1] + 4 * speed[1] - 0.25 * 16, 1e-11, 0);
    CHECK_NEAR(s.kinetic - o.kinetic, 7 * 0.5 * (from[1] - to[1]), 1e-11, 0);
    /* of a right triangle about its centre: m (a^2 + b^2)/18 */
    CHECK_NEAR(o.kinetic, 0.5 * 7 * (speed[0] * speed[0] + speed[1] * speed[1]) + 0.5 * 7 * (0.09 + 0.36) / 18 * 4, 1e-12, 0);
    peri_body_destroy(b);
}

/* Euler: the axis of a free symmetric top, J across and J3 along it, goes round the angular momentum L at L/J; the spin about the axis
   stays. A body of three moments turns over about its middle one: L, and the energy, to O(dt^2), stay. */
static void tops_turn(void) {
    for (int k = 0; k < 2; ++k) {
        peri_body *b = far_block(PERI_SPACE_SOLID);
        peri_obstacle_desc d = shaped(PERI_SHAPE_CYLINDER);
        const double across = 2, along = k == 0 ? 3 : 1, spin[3] = {k == 0 ? 0.3 : 0.02, 2, k == 0 ? 4 : 0.01};
        double l[2][3], axis[2][3] = {{0, 0, 1}, {0}}, most = 0;
        d.place[0] = 30;
        d.radius = d.length = 1;
        d.axis[2] = 1;
        d.mass = 1;
        d.inertia[0] = k == 0 ? across : 3;
        d.inertia[1] = across;
        d.inertia[2] = along;
        memcpy(d.spin, spin, sizeof spin);
        const int32_t top = (int32_t)MUST(b, peri_add_obstacle(b, &d));
        const double kinetic = state_of(b, top).kinetic, dt = 0.004;
        for (int n = 0; n < 2; ++n) {
            const peri_obstacle_state s = state_of(b, top);
            const double w = s.turn[0], x = s.turn[1], y = s.turn[2], z = s.turn[3];
            const double turn[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                                       {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                                       {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
            for (int r = 0; r < 3; ++r) {
                l[n][r] = 0;
                axis[n][r] = turn[r][2];
                for (int c = 0; c < 3; ++c)
                    for (int q = 0; q < 3; ++q) l[n][r] += turn[r][c] * d.inertia[c] * turn[q][c] * s.spin[q];
            }
            if (n == 0) go(b, PERI_INTEGRATOR_VELOCITY_VERLET, k == 0 ? 500 : 2500, dt, 0);
            else CHECK_NEAR(s.kinetic, kinetic, 1e-4, 0);
            most = fmax(most, fabs(turn[1][1]));
        }
        for (int r = 0; r < 3; ++r) CHECK_NEAR(l[1][r], l[0][r], 0, 1e-11 * 13);
        if (k == 0) { /* Rodrigues: the axis turned about L */
            const double size = sqrt(l[0][0] * l[0][0] + l[0][1] * l[0][1] + l[0][2] * l[0][2]), angle = size / across * 500 * dt;
            double unit[3], side[3];
            for (int r = 0; r < 3; ++r) unit[r] = l[0][r] / size;
            cross(unit, axis[0], side);
            for (int r = 0; r < 3; ++r)
                CHECK_NEAR(axis[1][r], axis[0][r] * cos(angle) + side[r] * sin(angle) + unit[r] * unit[2] * (1 - cos(angle)), 0, 1e-4);
        }
        peri_body_destroy(b);
    }
}

/* A ball a thousandth as heavy as the points that it meets has their springs to itself: the step must know, before they come into
   touch. What the body does not take the ball has. */
static void light_balls_do_not_explode(void) {
    for (int32_t space = PERI_SPACE_PLANE_STRESS; space <= PERI_SPACE_SOLID; space += 2) {
        peri_body *b = block(space, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR, 6, 4, 3);
        peri_obstacle_desc d = shaped(PERI_SHAPE_BOX);
        const double place[3] = {0.3, 0.48, 0.15}, size[3] = {0.3, 0.2, 0.3};
        memcpy(d.place, place, sizeof place);
        memcpy(d.size, size, sizeof size);
        d.mass = 2e-6;
        d.velocity[1] = -0.5;
        d.spin[0] = 0.02;
        const double first = peri_stable_step(b);
        const int32_t ball = (int32_t)MUST(b, peri_add_obstacle(b, &d));
        double least = first;
        for (int k = 0; k < 40; ++k) {
            go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 10, 0, 0);
            least = fmin(least, peri_stable_step(b));
        }
        const peri_obstacle_state s = state_of(b, ball);
        peri_energy e;
        MUST(b, peri_get_energy(b, &e));
        printf("    %dD: step %.2g, in touch %.2g; away at %.4g, energy off by %.2g\n", dim_of(space), first, least, s.velocity[1],
               (e.kinetic + e.elastic + s.kinetic + s.stored) / (0.5 * 2e-6 * 0.25) - 1);
        /* one row of 3 (9) points in touch: below 2/w of that */
        CHECK(least < 2 / sqrt(YOUNG / (H * H) * (dim_of(space) == 2 ? 3 * H * H * THICK : 9 * H * H * H) / 2e-6) && s.velocity[1] > 0);
        CHECK_NEAR(e.kinetic + e.elastic + s.kinetic + s.stored, 0.5 * 2e-6 * 0.25, 0.03, 0); /* steps of 0.9 of the stable one */
        peri_body_destroy(b);
    }
}

/* ---- state ------------------------------------------------------------------------------------------------------------- */

static void same_state(const peri_obstacle_state *a, const peri_obstacle_state *b) {
    CHECK(memcmp(a, b, sizeof *a) == 0);
}

/* peri_reset leads back to the start, to the bit; a clone goes on alike and by itself. */
static void reset_and_clones(void) {
    peri_body *b = block(PERI_SPACE_SOLID, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR, 6, 3, 4), *copy = NULL;
    const double corner[4][3] = {{0, 0, 0}, {0.3, 0, 0}, {0, 0.4, 0}, {0, 0, 0.3}};
    const int32_t sides[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    peri_obstacle_desc d = shaped(PERI_SHAPE_MESH);
    d.vertex_count = d.face_count = 4;
    d.vertices = &corner[0][0];
    d.faces = sides;
    d.place[0] = 0.1;
    d.place[1] = 0.31;
    d.place[2] = 0.1;
    d.density = 5;
    d.velocity[1] = -0.1;
    d.spin[2] = 1;
    d.friction = 0.2;
    d.restitution = 0.6;
    const int32_t stone = (int32_t)MUST(b, peri_add_obstacle(b, &d));
    const peri_obstacle_state start = state_of(b, stone);
    CHECK_NEAR(start.mass, 5 * 0.3 * 0.4 * 0.3 / 6, 1e-12, 0);
    go(b, PERI_INTEGRATOR_CENTRAL_DIFFERENCE, 20, 0, 0);
    CHECK(peri_body_clone(b, &copy, NULL) == PERI_OK);
    go(b, PERI_INTEGRATOR_CENTRAL_DIFFERENCE, 20, 0, 0);
    const peri_obstacle_state end = state_of(b, stone);
    CHECK(end.lost > 0 && end.velocity[1] > -0.09);
    MUST(b, peri_reset(b));
    peri_obstacle_state again = state_of(b, stone), other = state_of(copy, stone);
    same_state(&start, &again);
    go(copy, PERI_INTEGRATOR_CENTRAL_DIFFERENCE, 20, 0, 0);
    other = state_of(copy, stone);
    same_state(&end, &other);
    go(b, PERI_INTEGRATOR_CENTRAL_DIFFERENCE, 20, 0, 0);
    go(b, PERI_INTEGRATOR_CENTRAL_DIFFERENCE, 20, 0, 0);
    again = state_of(b, stone);
    same_state(&end, &again);
    MUST(copy, peri_remove_obstacle(copy, stone));
    CHECK(peri_get_obstacle_state(copy, stone, &other) == PERI_ERROR_ID_GONE);
    peri_body_destroy(copy);
    MUST(b, peri_set_obstacle_state(b, stone, &end)); /* what was read is what is set */
    again = state_of(b, stone);
    for (int k = 0; k < 3; ++k) CHECK_NEAR(again.velocity[k], end.velocity[k], 1e-12, 1e-15);
    for (int k = 0; k < 3; ++k) CHECK_NEAR(again.spin[k], end.spin[k], 1e-10, 1e-12);
    for (int k = 0; k < 4; ++k) CHECK_NEAR(again.turn[k], end.turn[k], 1e-15, 1e-15);
    CHECK_NEAR(again.kinetic, end.kinetic, 1e-10, 0);
    again.velocity[0] = (double)INFINITY;
    REFUSE(b, PERI_ERROR_RANGE, peri_set_obstacle_state(b, stone, &again));
    FIELD_IS("velocity");
    other = state_of(b, stone);
    CHECK(other.velocity[0] == other.velocity[0] && fabs(other.velocity[0] - end.velocity[0]) < 1e-12);
    peri_body_destroy(b);
}

/* Where the origin of its frame lies is nothing to a body: off its centre, or in it, it bounces and turns alike. */
static void the_origin_does_not_matter(void) {
    double found[2][3];
    for (int k = 0; k < 2; ++k) {
        peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR, 8, 3, 1);
        const double wedge[3][2] = {{0, 0}, {0.3, 0}, {0, 0.6}};
        double corner[3][2];
        peri_obstacle_desc d = shaped(PERI_SHAPE_MESH);
        for (int c = 0; c < 6; ++c) corner[c / 2][c % 2] = wedge[c / 2][c % 2] - (k == 0 ? 0 : c % 2 ? 0.2 : 0.1);
        d.vertex_count = 3;
        d.vertices = &corner[0][0];
        d.place[0] = k == 0 ? 0.2 : 0.3;
        d.place[1] = k == 0 ? 0.26 : 0.46;
        d.density = 3;
        d.velocity[1] = -0.05;
        const int32_t stone = (int32_t)MUST(b, peri_add_obstacle(b, &d));
        go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 30, 0.05, 0);
        const peri_obstacle_state s = state_of(b, stone);
        const double c1 = cos(s.turn[0]), s1 = sin(s.turn[0]), x = k == 0 ? 0.1 : 0, y = k == 0 ? 0.2 : 0;
        found[k][0] = s.place[0] + c1 * x - s1 * y;
        found[k][1] = s.place[1] + s1 * x + c1 * y;
        found[k][2] = s.spin[0];
        peri_body_destroy(b);
    }
    CHECK(fabs(found[0][2]) > 1e-3);
    for (int c = 0; c < 3; ++c) CHECK_NEAR(found[0][c], found[1][c], 1e-10, 1e-12);
}

/* The status of a free body that leaves the numbers names it. */
static void what_leaves_the_numbers(void) {
    peri_body *b = far_block(PERI_SPACE_PLANE_STRESS);
    peri_obstacle_desc d = shaped(PERI_SHAPE_BALL);
    peri_advance_desc a;
    d.place[0] = 10;
    d.radius = d.mass = 1;
    d.gravity[0] = 1e9;
    const int32_t ball = (int32_t)MUST(b, peri_add_obstacle(b, &d));
    peri_advance_desc_init(&a);
    a.steps = 1000000;
    REFUSE(b, PERI_ERROR_UNSTABLE, peri_advance(b, &a));
    FIELD_IS("obstacle");
    CHECK(seen.index == ball);
    MUST(b, peri_reset(b));
    CHECK(state_of(b, ball).velocity[0] == 0);
    a.steps = 1;
    MUST(b, peri_advance(b, &a));
    peri_body_destroy(b);
}

/* The step that peri_stable_step tells is one that peri_advance takes: also where nothing has asked yet what a light body is near. What is
   refused changes nothing, the step included. */
static void the_step_told_is_taken(void) {
    peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR, 8, 4, 1);
    const double alone = peri_stable_step(b);
    peri_obstacle_desc d = shaped(PERI_SHAPE_BALL);
    peri_advance_desc a;
    d.place[0] = 0.35;
    d.place[1] = 0.41;
    d.radius = 0.05;
    d.mass = 1e-6;
    (void)MUST(b, peri_add_obstacle(b, &d));
    peri_advance_desc_init(&a);
    a.steps = 1;
    for (int k = 0; k < 2; ++k) {
        const double step = peri_stable_step(b);
        CHECK(step > 0 && step < 0.5 * alone);
        a.time_step = 1.001 * step;
        REFUSE(b, PERI_ERROR_STEP, peri_advance(b, &a));
        CHECK(seen.value == step && peri_stable_step(b) == step);
        a.time_step = step;
        MUST(b, peri_advance(b, &a));
        MUST(b, peri_reset(b));
    }
    peri_body_destroy(b);
}

/* However far out a body has gone, the stable step is a number, with friction, too. */
static void the_step_of_what_is_lost(void) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_CORRESPONDENCE, 0.2, H, 3, 8, 4, 1);
    peri_body *b = specimen_make(&s); /* the more it is stretched the stiffer */
    double *u = get(b, PERI_FIELD_DISPLACEMENT);
    peri_obstacle_desc d = shaped(PERI_SHAPE_PLANE);
    peri_advance_desc a;
    peri_solve_desc st;
    u[0] = 1e-3;
    MUST(b, peri_set_field(b, PERI_FIELD_DISPLACEMENT, u, peri_size_of_field(b, PERI_FIELD_DISPLACEMENT)));
    free(u);
    peri_advance_desc_init(&a);
    a.steps = 100000;
    a.time_step = 1e120; /* squares of the displacements are beyond the numbers */
    a.force_step = 1;
    REFUSE(b, PERI_ERROR_UNSTABLE, peri_advance(b, &a));
    peri_solve_desc_init(&st);
    CHECK(peri_solve(b, &st, NULL) < 0); /* after which the deformation is looked at anew */
    d.normal[1] = 1;
    d.friction = 0.3;
    d.friction_speed = SLIP;
    (void)MUST(b, peri_add_obstacle(b, &d));
    CHECK(peri_stable_step(b) >= 0 && peri_stable_step(b) <= 1);
    MUST(b, peri_reset(b));
    CHECK(peri_stable_step(b) > 1e-3);
    peri_body_destroy(b);
}

/* peri_solve leaves free bodies where they are, and they press as they are placed. */
static void statics_hold_them(void) {
    peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR, 8, 4, 1);
    const double lo[2] = {0, 0}, hi[2] = {0.8, 0.1};
    double f[2], r[2];
    peri_obstacle_desc d = shaped(PERI_SHAPE_CAPSULE);
    peri_solve_desc st;
    const int32_t row = (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi));
    const int32_t held = (int32_t)MUST(b, peri_prescribe_displacement(b, row, PERI_AXIS_XY, NULL, NULL, NULL));
    d.place[0] = 0.4;
    d.place[1] = 0.54;
    d.radius = 0.2;
    d.length = 0.2;
    d.axis[0] = 1;
    d.mass = 1;
    d.gravity[1] = -1;
    d.velocity[0] = 0.1;
    d.friction = 0.5;
    const int32_t rod = (int32_t)MUST(b, peri_add_obstacle(b, &d));
    const peri_obstacle_state before = state_of(b, rod);
    peri_solve_desc_init(&st);
    MUST(b, peri_solve(b, &st, NULL));
    const peri_obstacle_state after = state_of(b, rod);
    MUST(b, peri_get_obstacle_force(b, rod, f, NULL));
    MUST(b, peri_get_reaction(b, held, r));
    CHECK(memcmp(before.place, after.place, sizeof before.place) == 0 && after.velocity[0] == before.velocity[0] && after.stored > 0);
    CHECK(f[1] < 0);
    CHECK_NEAR(f[1], -r[1], 1e-6, 0);
    CHECK(fabs(f[0]) <= 1e-6 * fabs(f[1])); /* smooth, though it has a velocity */
    peri_body_destroy(b);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(a_block_slides_by_coulombs_law);
    RUN(what_rubs_makes_steps_smaller);
    RUN(a_block_comes_back_with_its_restitution);
    RUN(a_free_ball_hits_in_2d);
    RUN(a_free_ball_hits_in_3d);
    RUN(free_fall);
    RUN(tops_turn);
    RUN(the_origin_does_not_matter);
    RUN(light_balls_do_not_explode);
    RUN(reset_and_clones);
    RUN(what_leaves_the_numbers);
    RUN(the_step_told_is_taken);
    RUN(the_step_of_what_is_lost);
    RUN(statics_hold_them);
    return test_end("test_free_bodies");
}
