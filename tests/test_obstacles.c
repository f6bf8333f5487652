/* SPDX-License-Identifier: MIT */
/* test_obstacles.c - the shapes of obstacles, where they are, and the forces and moments that they give.
   SOURCE OF TRUTH: signed distances worked out here, place by place; sums over the points; kinematics of rigid bodies. */
#include "pool.h"
#include "refusal.h"

static peri_obstacle_desc shaped(int32_t shape) {
    peri_obstacle_desc d;
    peri_obstacle_desc_init(&d, shape);
    return d;
}

/* ---- depth ------------------------------------------------------------------------------------------------------------ */

#define POINTS 500

/* Scattered points within 1 of the origin, undeformed: there the force density is that of obstacles alone, stiffness 1 its depth. */
static peri_body *cloud(int32_t space, uint64_t seed) {
    const int dim = dim_of(space);
    double x[3 * POINTS], volume[POINTS];
    peri_body *b = empty(space, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR, 0.6);
    (void)unbreakable(b, 1, 1);
    for (int i = 0; i < POINTS; ++i) {
        volume[i] = 0.001 * (1 + test_random(&seed));
        for (int d = 0; d < dim; ++d) x[dim * i + d] = 2 * test_random(&seed) - 1;
    }
    MUST(b, peri_add_points(b, POINTS, x, volume, NULL));
    MUST(b, peri_build(b));
    return b;
}

/* The axes of a frame, as columns; 2D: the angle is turn[0]. */
static void axes_of(int dim, const double *turn, double axes[3][3]) {
    const double w = turn[0], x = turn[1], y = turn[2], z = turn[3], size = w * w + x * x + y * y + z * z;
    const double solid[3][3] = {{w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)},
                                {2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)},
                                {2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z}};
    const double flat[3][3] = {{cos(w), -sin(w), 0}, {sin(w), cos(w), 0}, {0, 0, 1}};
    for (int k = 0; k < 9; ++k) axes[k / 3][k % 3] = dim == 2 ? flat[k / 3][k % 3] : size > 0 ? solid[k / 3][k % 3] / size : k % 4 == 0;
}

static double bounded(double a, double most) { return a > most ? most : a < -most ? -most : a; }

/* Two boxes, [0, 2] x [0, 1] and [0, 1] x [0, 2] of side 0.4, make an L; in 3D it is 0.4 thick. Its depth is the least distance to any of
   the six (8) flat sides. */
#define L_SIDE 0.4
static const double l_corner[6][2] = {{0, 0}, {2 * L_SIDE, 0}, {2 * L_SIDE, L_SIDE},
                                      {L_SIDE, L_SIDE}, {L_SIDE, 2 * L_SIDE}, {0, 2 * L_SIDE}};
static double l_depth(int dim, const double *y, double *normal) {
    double best = HUGE_VAL;
    int in = (y[0] > 0 && y[1] > 0 && y[0] < 2 * L_SIDE && y[1] < L_SIDE) || (y[0] > 0 && y[1] > 0 && y[0] < L_SIDE && y[1] < 2 * L_SIDE);
    if (dim == 3) in = in && y[2] > 0 && y[2] < L_SIDE;
    if (!in) return -1;
    for (int k = 0; k < 6; ++k) {
        const double *a = l_corner[k], *c = l_corner[(k + 1) % 6], way[2] = {c[0] - a[0], c[1] - a[1]};
        double t = ((y[0] - a[0]) * way[0] + (y[1] - a[1]) * way[1]) / (way[0] * way[0] + way[1] * way[1]);
        t = t < 0 ? 0 : t > 1 ? 1 : t;
        const double to[3] = {a[0] + t * way[0] - y[0], a[1] + t * way[1] - y[1], 0}, far_ = sqrt(to[0] * to[0] + to[1] * to[1]);
        if (far_ >= best) continue;
        best = far_;
        for (int d = 0; d < 3; ++d) normal[d] = to[d] / far_;
    }
    for (int side = 0; dim == 3 && side < 2; ++side) {
        const double far_ = side ? L_SIDE - y[2] : y[2];
        if (far_ >= best) continue;
        best = far_;
        normal[0] = normal[1] = 0;
        normal[2] = side ? 1 : -1;
    }
    return best;
}

/* Depth and normal at y of the own frame, < 0 outside: each by the definition of its shape. */
static double depth_of(const peri_obstacle_desc *d, int dim, const double *y, double *normal) {
    double rest[3], along = 0, size = 0, depth = HUGE_VAL, near_ = 0;
    for (int k = 0; k < 3; ++k) normal[k] = 0;
    if (d->shape == PERI_SHAPE_MESH || d->shape == PERI_SHAPE_DISTANCE) return l_depth(dim, y, normal);
    const double *way = d->shape == PERI_SHAPE_PLANE ? d->normal : d->axis;
    for (int k = 0; k < dim; ++k) size += way[k] * way[k];
    for (int k = 0; k < dim; ++k) along += y[k] * way[k] / sqrt(size);
    if (d->shape == PERI_SHAPE_PLANE) {
        for (int k = 0; k < dim; ++k) normal[k] = d->normal[k] / sqrt(size);
        return -along;
    }
    if (d->shape == PERI_SHAPE_BOX) {
        for (int k = 0; k < dim; ++k) {
            if (d->size[k] / 2 - fabs(y[k]) >= depth) continue;
            depth = d->size[k] / 2 - fabs(y[k]);
            normal[0] = normal[1] = normal[2] = 0;
            normal[k] = y[k] < 0 ? -1 : 1;
        }
        return depth;
    }
    if (d->shape == PERI_SHAPE_CAPSULE) near_ = bounded(along, d->length / 2);
    if (d->shape == PERI_SHAPE_CYLINDER) near_ = along;
    for (int k = 0; k < dim; ++k) rest[k] = y[k] - (size > 0 ? near_ * d->axis[k] / sqrt(size) : 0);
    for (int k = 0; k < dim; ++k) normal[k] = rest[k];
    const double far_ = sqrt(rest[0] * rest[0] + rest[1] * rest[1] + (dim == 3 ? rest[2] * rest[2] : 0));
    for (int k = 0; k < dim; ++k) normal[k] /= far_;
    depth = d->radius - far_;
    if (d->shape == PERI_SHAPE_CYLINDER && d->length / 2 - fabs(along) < depth) {
        for (int k = 0; k < dim; ++k) normal[k] = (along < 0 ? -1 : 1) * d->axis[k] / sqrt(size);
        depth = d->length / 2 - fabs(along);
    }
    return depth;
}

static int32_t l_distance(void *user, const double *x, double *distance, double *normal) {
    double n[3];
    const double depth = l_depth(*(const int *)user, x, n);
    *distance = -depth;
    for (int d = 0; depth > 0 && d < *(const int *)user; ++d) normal[d] = 3 * n[d]; /* of any length */
    return 0;
}

/* The L as a prism: two faces of four triangles each, six sides of two. */
static const int32_t l_faces[20][3] = {{0, 2, 1}, {0, 3, 2}, {0, 5, 3}, {3, 5, 4}, {6, 7, 8}, {6, 8, 9}, {6, 9, 11}, {9, 10, 11},
                                       {0, 1, 7}, {0, 7, 6}, {1, 2, 8}, {1, 8, 7}, {2, 3, 9}, {2, 9, 8}, {3, 4, 10}, {3, 10, 9},
                                       {4, 5, 11}, {4, 11, 10}, {5, 0, 6}, {5, 6, 11}};
static double l_vertex[12][3];
static void make_l(void) {
    for (int k = 0; k < 12; ++k) {
        l_vertex[k][0] = l_corner[k % 6][0];
        l_vertex[k][1] = l_corner[k % 6][1];
        l_vertex[k][2] = k < 6 ? 0 : L_SIDE;
    }
}

static peri_obstacle_desc any_shape(int32_t shape, int *dim) {
    static const double axis[3] = {2, 1, -1}, size[3] = {0.9, 0.7, 0.8}, place[3] = {0.1, -0.2, 0.15};
    peri_obstacle_desc d = shaped(shape);
    memcpy(d.normal, axis, sizeof axis);
    memcpy(d.axis, axis, sizeof axis);
    memcpy(d.size, size, sizeof size);
    memcpy(d.place, place, sizeof place);
    d.radius = shape == PERI_SHAPE_DISTANCE ? 3 * L_SIDE : 0.45;
    d.length = 0.6;
    d.vertices = *dim == 2 ? &l_corner[0][0] : &l_vertex[0][0];
    d.vertex_count = *dim == 2 ? 6 : 12;
    d.faces = &l_faces[0][0];
    d.face_count = 20;
    d.distance = l_distance;
    d.user = dim;
    d.stiffness = 1;
    return d;
}

/* Force density, force and moment of one obstacle against the depths worked out here, its frame being at place and turn. */
static void compare(peri_body *b, const peri_obstacle_desc *d, int32_t id, const double *place, const double *turn) {
    const int dim = peri_dimension(b);
    double axes[3][3], force[3] = {0}, moment[3] = {0}, got[3] = {0}, got_moment[3] = {0};
    double *x = get(b, PERI_FIELD_CURRENT_POSITION), *f = get(b, PERI_FIELD_FORCE_DENSITY), *v = get(b, PERI_FIELD_VOLUME);
    const double thick = dim == 2 ? THICK : 1;
    int within = 0;
    axes_of(dim, turn, axes);
    for (int i = 0; i < POINTS; ++i) {
        double r[3] = {0}, y[3] = {0}, own[3], push[3] = {0};
        for (int k = 0; k < dim; ++k) r[k] = x[dim * i + k] - place[k];
        for (int k = 0; k < 3; ++k) y[k] = axes[0][k] * r[0] + axes[1][k] * r[1] + axes[2][k] * r[2];
        const double depth = depth_of(d, dim, y, own);
        within += depth > 0;
        for (int k = 0; k < 3; ++k) push[k] = depth > 0 ? depth * (axes[k][0] * own[0] + axes[k][1] * own[1] + axes[k][2] * own[2]) : 0;
        for (int k = 0; k < dim; ++k) CHECK_NEAR(f[dim * i + k], push[k], 0, 1e-12);
        for (int k = 0; k < 3; ++k) {
            force[k] += thick * v[i] * push[k];
            moment[k] += thick * v[i] * (r[(k + 1) % 3] * push[(k + 2) % 3] - r[(k + 2) % 3] * push[(k + 1) % 3]);
        }
    }
    CHECK(within > 3 && within < POINTS - 10);
    MUST(b, peri_get_obstacle_force(b, id, got, got_moment));
    if (dim == 2) got_moment[2] = got_moment[0], got_moment[0] = 0;
    for (int k = 0; k < dim; ++k) CHECK_NEAR(got[k], force[k], 0, 1e-12);
    for (int k = 0; k < 3; ++k) CHECK_NEAR(got_moment[k], moment[k], 0, 1e-12);
    free(x);
    free(f);
    free(v);
}

static void shapes_push_by_their_depth(void) {
    const double turns[3][4] = {{0, 0, 0, 0}, {0.7, 0, 0, 0}, {0.9, -0.4, 0.3, 0.5}};
    make_l();
    for (int32_t space = PERI_SPACE_PLANE_STRESS; space <= PERI_SPACE_SOLID; space += 2)
        for (int32_t shape = PERI_SHAPE_PLANE; shape <= PERI_SHAPE_DISTANCE; ++shape)
            for (int turned = 0; turned < 3; ++turned) {
                int dim = dim_of(space);
                if (dim == 2 && shape == PERI_SHAPE_CYLINDER) continue;
                peri_body *b = cloud(space, (uint64_t)shape);
                peri_obstacle_desc d = any_shape(shape, &dim);
                memcpy(d.turn, turns[turned], sizeof d.turn);
                if (turned == 2) d.mass = d.inertia[0] = d.inertia[1] = d.inertia[2] = 1; /* sums are kept, and what is near as well */
                const int32_t id = (int32_t)MUST(b, peri_add_obstacle(b, &d));
                compare(b, &d, id, d.place, d.turn);
                if (turned == 2) { /* put elsewhere, another way round */
                    peri_obstacle_state s;
                    MUST(b, peri_get_obstacle_state(b, id, &s));
                    s.place[0] += 0.1;
                    memcpy(s.turn, turns[1], sizeof s.turn);
                    s.turn[1] = dim == 3;
                    MUST(b, peri_set_obstacle_state(b, id, &s));
                    compare(b, &d, id, s.place, s.turn);
                }
                if (test_bad) printf("    %dD, shape %d, turn %d\n", dim, (int)shape, turned);
                peri_body_destroy(b);
                if (test_bad) return;
            }
}

/* Of a sharp tetrahedron and of a sharp triangle: within is what is behind all sides, which are planes. At edges and corners sharper than a
   right angle the nearest face alone may look the wrong way. */
static void sharp_edges_have_two_sides(void) {
    const double tip[4][3] = {{-0.9, -0.2, 0}, {0.9, -0.1, 0.1}, {0.1, 0.5, 0.1}, {0, 0, 0.35}};
    const double flat[3][2] = {{-0.9, -0.3}, {0.9, 0.1}, {0.7, 0.35}};
    const int32_t sides[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    for (int32_t space = PERI_SPACE_PLANE_STRESS; space <= PERI_SPACE_SOLID; space += 2) {
        const int dim = dim_of(space);
        peri_body *b = cloud(space, 11);
        peri_obstacle_desc d = shaped(PERI_SHAPE_MESH);
        int within = 0;
        d.vertex_count = dim + 1;
        d.vertices = dim == 2 ? &flat[0][0] : &tip[0][0];
        d.faces = &sides[0][0];
        d.face_count = 4;
        d.stiffness = 1;
        MUST(b, peri_add_obstacle(b, &d));
        double *x = get(b, PERI_FIELD_POSITION), *f = get(b, PERI_FIELD_FORCE_DENSITY);
        for (int i = 0; i < POINTS; ++i) {
            double least = HUGE_VAL, push = 0;
            for (int s = 0; s <= dim; ++s) {
                double n[3] = {0, 0, 0}, depth = 0;
                const double *p = dim == 2 ? flat[s] : tip[sides[s][0]], *q = dim == 2 ? flat[(s + 1) % 3] : tip[sides[s][1]];
                if (dim == 2) n[0] = q[1] - p[1], n[1] = p[0] - q[0];
                const double *r = tip[sides[s][2]];
                for (int k = 0; dim == 3 && k < 3; ++k)
                    n[k] = (q[(k + 1) % 3] - p[(k + 1) % 3]) * (r[(k + 2) % 3] - p[(k + 2) % 3])
                         - (q[(k + 2) % 3] - p[(k + 2) % 3]) * (r[(k + 1) % 3] - p[(k + 1) % 3]);
                const double size = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
                for (int k = 0; k < dim; ++k) depth -= n[k] / size * (x[dim * i + k] - p[k]);
                least = fmin(least, depth);
            }
            for (int k = 0; k < dim; ++k) push += f[dim * i + k] * f[dim * i + k];
            CHECK_NEAR(sqrt(push), fmax(least, 0), 0, 1e-12); /* convex: the depth is that behind the nearest plane */
            within += least > 0;
        }
        CHECK(within > 3);
        free(x);
        free(f);
        peri_body_destroy(b);
    }
}

/* ---- motion ------------------------------------------------------------------------------------------------------------ */

/* Spins about (1, 2, 2)/3 (2D: z) at 0.5 while its place goes along. */
static int32_t wander(void *user, double time, double *place, double *turn) {
    const int dim = *(const int *)user;
    for (int d = 0; d < dim; ++d) place[d] += 0.3 * (d + 1) * time;
    if (dim == 2) turn[0] += 0.5 * time;
    else {
        const double c = cos(0.25 * time), s = sin(0.25 * time) / 3;
        turn[0] = 2 * c; /* of any length */
        turn[1] = 2 * s;
        turn[2] = turn[3] = 4 * s;
    }
    return 0;
}

/* Moving obstacles are where `motion` puts them, turn what they carry, and tell their velocity and spin. */
static void they_go_where_they_are_told(void) {
    make_l();
    for (int32_t space = PERI_SPACE_PLANE_STRESS; space <= PERI_SPACE_SOLID; space += 2)
        for (int32_t shape = PERI_SHAPE_PLANE; shape <= PERI_SHAPE_MESH; shape += PERI_SHAPE_MESH - PERI_SHAPE_PLANE) {
            int dim = dim_of(space);
            peri_body *b = cloud(space, 7);
            peri_obstacle_desc d = any_shape(shape, &dim);
            peri_obstacle_state s;
            d.motion = wander;
            d.friction = 0.1; /* what rubs keeps its sums */
            d.stiffness = 1e-12;
            const int32_t id = (int32_t)MUST(b, peri_add_obstacle(b, &d));
            for (int k = 0; k < 5; ++k) go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 1, 0.01, 0);
            MUST(b, peri_get_obstacle_state(b, id, &s));
            for (int k = 0; k < dim; ++k) {
                CHECK_NEAR(s.place[k], d.place[k] + 0.3 * (k + 1) * 0.05, 1e-12, 0);
                CHECK_NEAR(s.velocity[k], 0.3 * (k + 1), 1e-10, 0);
            }
            if (dim == 2) CHECK_NEAR(s.turn[0], 0.025, 1e-12, 0);
            if (dim == 2) CHECK_NEAR(s.spin[0], 0.5, 1e-11, 0);
            for (int k = 0; dim == 3 && k < 3; ++k) CHECK_NEAR(s.spin[k], 0.5 * (k == 0 ? 1 : 2) / 3, 1e-10, 0);
            const double turn[4] = {cos(0.0125), sin(0.0125) / 3, 2 * sin(0.0125) / 3, 2 * sin(0.0125) / 3};
            for (int k = 0; dim == 3 && k < 4; ++k) CHECK_NEAR(s.turn[k], turn[k], 1e-12, 0);
            CHECK(s.mass == 0 && s.kinetic == 0);
            MUST(b, peri_reset(b));
            MUST(b, peri_get_obstacle_state(b, id, &s));
            CHECK(s.velocity[0] == 0 && s.spin[0] == 0 && s.lost == 0);
            for (int k = 0; k < dim; ++k) CHECK_NEAR(s.place[k], d.place[k], 1e-15, 1e-15);
            peri_body_destroy(b);
        }
}

/* A drum that spins below a block pulls it by mu times what it carries, along its surface, and feels that as a moment. */
static int32_t spin_up(void *user, double time, double *place, double *turn) {
    (void)user, (void)place;
    turn[0] = -0.02 * time;
    return 0;
}
static void a_drum_carries(void) {
    peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR, 3, 2, 1);
    const double weight[2] = {0, -1e-3}, mass = 6 * H * H * THICK * DENSITY;
    peri_obstacle_desc d = shaped(PERI_SHAPE_BALL);
    double p[2], f[2], m;
    d.place[0] = 0.15;
    d.place[1] = -20 + 0.5 * H + 1e-3;
    d.radius = 20;
    d.stiffness = 2;
    d.friction = 0.5;
    d.friction_speed = 2e-4;
    d.motion = spin_up;
    const int32_t drum = (int32_t)MUST(b, peri_add_obstacle(b, &d));
    MUST(b, peri_apply_body_force(b, PERI_ALL, weight, NULL, NULL));
    go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 40, 0, 0); /* its surface runs at 0.4: the block slips */
    MUST(b, peri_get_obstacle_force(b, drum, f, &m));
    CHECK(f[1] > 0 && f[0] > 0);
    CHECK_NEAR(f[0], 0.5 * f[1], 0.02, 0);
    CHECK_NEAR(m, -20 * f[0], 0.02, 0); /* about its middle */
    MUST(b, peri_get_momentum(b, p, NULL));
    CHECK_NEAR(p[0] / mass, 0.5 * 1e-3 / DENSITY * peri_time(b), 0.05, 0);
    peri_body_destroy(b);
}

/* ---- what is refused, and what callbacks may do --------------------------------------------------------------------------- */

static void meshes_must_be_closed(void) {
    peri_body *b = cloud(PERI_SPACE_SOLID, 1), *flat = cloud(PERI_SPACE_PLANE_STRESS, 1);
    int dim = 3, two = 2;
    peri_memory before, after;
    double spoilt[12][3], line[6][2];
    int32_t faces[20][3];
    make_l();
    MUST(b, peri_get_memory(b, &before));
    peri_obstacle_desc d = any_shape(PERI_SHAPE_MESH, &dim);
    d.face_count = 19; /* a hole */
    REFUSE(b, PERI_ERROR_RANGE, peri_add_obstacle(b, &d));
    FIELD_IS("faces");
    d.face_count = 20;
    memcpy(faces, l_faces, sizeof faces);
    d.faces = &faces[0][0];
    faces[3][1] = 12;
    REFUSE(b, PERI_ERROR_RANGE, peri_add_obstacle(b, &d));
    CHECK(seen.index == 3 && seen.value == 12);
    memcpy(faces, l_faces, sizeof faces);
    faces[3][1] = 4, faces[3][2] = 5; /* turned over */
    REFUSE(b, PERI_ERROR_RANGE, peri_add_obstacle(b, &d));
    FIELD_IS("faces");
    for (int k = 0; k < 20; ++k) faces[k][0] = l_faces[k][0], faces[k][1] = l_faces[k][2], faces[k][2] = l_faces[k][1]; /* inside out */
    REFUSE(b, PERI_ERROR_RANGE, peri_add_obstacle(b, &d));
    CHECK_NEAR(seen.value, -3 * L_SIDE * L_SIDE * L_SIDE, 1e-12, 0);
    d.faces = &l_faces[0][0];
    memcpy(spoilt, l_vertex, sizeof spoilt);
    d.vertices = &spoilt[0][0];
    spoilt[7][1] = (double)NAN;
    REFUSE(b, PERI_ERROR_RANGE, peri_add_obstacle(b, &d));
    CHECK(seen.index == 7);
    FIELD_IS("vertices");
    memcpy(spoilt[7], spoilt[8], sizeof spoilt[7]); /* a triangle without area */
    REFUSE(b, PERI_ERROR_RANGE, peri_add_obstacle(b, &d));
    MUST(b, peri_get_memory(b, &after));
    CHECK(before.total == after.total);
    d = any_shape(PERI_SHAPE_MESH, &two);
    for (int k = 0; k < 6; ++k) memcpy(line[k], l_corner[5 - k], sizeof line[k]); /* clockwise */
    d.vertices = &line[0][0];
    REFUSE(flat, PERI_ERROR_RANGE, peri_add_obstacle(flat, &d));
    FIELD_IS("vertices");
    CHECK_NEAR(seen.value, -3 * L_SIDE * L_SIDE, 1e-12, 0);
    peri_body_destroy(b);
    peri_body_destroy(flat);
}

typedef struct teller {
    int     calls, wrong, say;
    double  distance, normal;
    peri_body *body;
} teller;
static int32_t tell_distance(void *user, const double *x, double *distance, double *normal) {
    teller *t = (teller *)user;
    t->calls++;
    t->wrong += !(sqrt(x[0] * x[0] + x[1] * x[1]) <= 0.5); /* the bound */
    t->wrong += t->body && peri_remove_obstacle(t->body, 1) != PERI_ERROR_ORDER;
    *distance = t->distance;
    normal[0] = t->normal;
    return t->say;
}
static void distances_are_asked_for(void) {
    teller t = {0, 0, 0, -0.1, 1, NULL};
    peri_body *b = cloud(PERI_SPACE_PLANE_STRESS, 3);
    peri_obstacle_desc d = shaped(PERI_SHAPE_DISTANCE);
    peri_advance_desc a;
    double f[2];
    t.body = b;
    d.distance = tell_distance;
    d.radius = 0.5;
    d.user = &t;
    d.stiffness = 1e-9;
    const int32_t id = (int32_t)MUST(b, peri_add_obstacle(b, &d));
    MUST(b, peri_get_obstacle_force(b, id, f, NULL));
    CHECK(f[0] > 0 && f[1] == 0 && t.calls > 20 && t.wrong == 0);
    peri_advance_desc_init(&a);
    a.steps = 3;
    t.distance = (double)NAN;
    REFUSE(b, PERI_ERROR_CALLBACK, peri_advance(b, &a));
    FIELD_IS("distance");
    CHECK(seen.index >= 0);
    MUST(b, peri_reset(b));
    t.distance = -0.1;
    t.normal = 0;
    REFUSE(b, PERI_ERROR_CALLBACK, peri_get_obstacle_force(b, id, f, NULL));
    FIELD_IS("normal");
    t.normal = 1;
    t.say = -5;
    REFUSE(b, PERI_ERROR_CALLBACK, peri_advance(b, &a));
    FIELD_IS("peri_distance_fn");
    CHECK(seen.value == -5);
    MUST(b, peri_reset(b));
    t.say = 0;
    MUST(b, peri_advance(b, &a));
    t.say = 1;
    CHECK(peri_advance(b, &a) == PERI_STOPPED && peri_step_count(b) == 4);
    peri_body_destroy(b);
}

/* ---- memory -------------------------------------------------------------------------------------------------------------- */

/* Each allocation of adding and cloning the most that there is fails once: nothing leaks, and peri_get_memory tells what is held. */
static void memory_may_be_short(void) {
    pool p = {0, 0, 0, 0, -1, 0};
    int dim = 3;
    peri_memory told;
    peri_body *b = NULL, *copy = NULL;
    const double lo[3] = {0, 0, 0}, hi[3] = {0.4, 0.4, 0.4};
    peri_body_desc desc;
    make_l();
    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_SOLID;
    desc.horizon = 0.3;
    hook(&desc, &p);
    MUST(NULL, peri_body_create(&desc, &b, NULL));
    MUST(b, peri_add_box(b, unbreakable(b, 1, 1), lo, hi, 0.1));
    MUST(b, peri_build(b));
    peri_obstacle_desc d = any_shape(PERI_SHAPE_MESH, &dim);
    d.mass = 1;
    d.restitution = 0.5;
    int32_t id = PERI_ERROR_MEMORY;
    int failed = 0;
    for (; id == PERI_ERROR_MEMORY && failed < 50; ++failed) {
        const int64_t held = p.bytes, push = 64 * 3 * 8 + 200; /* what is for all obstacles may stay */
        p.calls = 0;
        p.fail_at = failed;
        id = peri_add_obstacle(b, &d);
        if (id == PERI_ERROR_MEMORY) CHECK(p.bytes - held <= push + 8192);
    }
    CHECK(id > 0 && failed == 8); /* mesh, scratch, free, kept, tally, obstacles, push: then it went well */
    p.fail_at = -1;
    MUST(b, peri_get_memory(b, &told));
    CHECK(told.total <= p.bytes && told.total > p.bytes - 4096);
    const int64_t held = p.bytes;
    for (failed = 0; !copy && failed < 100; ++failed) {
        p.calls = 0;
        p.fail_at = failed;
        const int32_t status = peri_body_clone(b, &copy, NULL);
        CHECK(status == PERI_OK || (status == PERI_ERROR_MEMORY && !copy && p.bytes == held));
    }
    CHECK(copy && failed > 8);
    p.fail_at = -1;
    peri_body_destroy(copy);
    CHECK(p.bytes == held);
    MUST(b, peri_remove_obstacle(b, id));
    CHECK(p.bytes < held);
    peri_body_destroy(b);
    CHECK(p.bytes == 0);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(shapes_push_by_their_depth);
    RUN(sharp_edges_have_two_sides);
    RUN(they_go_where_they_are_told);
    RUN(a_drum_carries);
    RUN(meshes_must_be_closed);
    RUN(distances_are_asked_for);
    RUN(memory_may_be_short);
    return test_end("test_obstacles");
}
