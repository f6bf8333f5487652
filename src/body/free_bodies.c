/* SPDX-License-Identifier: MIT */
/* free_bodies.c - where obstacles are, and the motion of free ones.

   A free body moves by velocity-Verlet in step with the points: half kick, drift, forces, half kick. Its drift turns the frame by the
   implicit midpoint rule, spin = A J^-1 A^T L with the axes A in the middle of the step, which keeps the angular momentum L. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

/* ---- turns ------------------------------------------------------------------------------------------------------ */

/* axes: [9], columns; of an angle in 2D, of a unit quaternion in 3D. */
static void peri__axes_of(int32_t dim, const double *turn, double *axes) {
    if (dim == 2) {
        const double c = cos(turn[0]), s = sin(turn[0]);
        const double plane[9] = { c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0 };
        memcpy(axes, plane, sizeof plane);
        return;
    }
    const double w = turn[0], x = turn[1], y = turn[2], z = turn[3];
    const double solid[9] = { 1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y),
                              2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x),
                              2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y) };
    memcpy(axes, solid, sizeof solid);
}

static void peri__to_body(const double *axes, const double *own, double *out) {
    for (int r = 0; r < 3; ++r) out[r] = peri__dot(&axes[3 * r], own, 3);
}

static void peri__to_own(const double *axes, const double *body, double *out) {
    for (int c = 0; c < 3; ++c) out[c] = axes[c] * body[0] + axes[3 + c] * body[1] + axes[6 + c] * body[2];
}

/* Follows a change of o->turn. */
static void peri__update_axes(peri__obstacle *o, int32_t dim) {
    o->turned = dim == 2 ? o->turn[0] != 0.0 : o->turn[1] != 0.0 || o->turn[2] != 0.0 || o->turn[3] != 0.0;
    peri__axes_of(dim, o->turn, o->axes);
    if (o->turned) peri__to_body(o->axes, o->solid.direction, o->normal);
    else memcpy(o->normal, o->solid.direction, sizeof o->normal);
}

/* A turn of the caller; 0 where it is not finite or no quaternion. All zero is none. */
static int peri__read_turn(int32_t dim, const double *given, double *turn) {
    for (int k = 0; k < 4; ++k) turn[k] = 0.0;
    if (!peri__finite_vector(given, dim == 2 ? 1 : 4)) return 0;
    if (dim == 2) {
        turn[0] = given[0];
        return 1;
    }
    return peri__direction(given, 4, turn);
}

/* out = a b, of quaternions, of length 1. */
static void peri__multiply_turns(const double *a, const double *b, double *out) {
    const double product[4] = { a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
                                a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
                                a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
                                a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0] };
    (void)peri__direction(product, 4, out);
}

/* out = turn, and then by `spin` for a time. */
static void peri__turn_by(int32_t dim, const double *turn, const double *spin, double time, double *out) {
    const double speed = sqrt(peri__dot(spin, spin, 3)), half = 0.5 * speed * time;
    if (dim == 2 || speed == 0.0) {
        memcpy(out, turn, 4 * sizeof *out);
        if (dim == 2) out[0] += spin[2] * time;
        return;
    }
    const double sine = sin(half) / speed, change[4] = { cos(half), sine * spin[0], sine * spin[1], sine * spin[2] };
    peri__multiply_turns(change, turn, out);
}

/* The spin that leads from one turn to another in a time, the short way. */
static void peri__spin_between(int32_t dim, const double *from, const double *to, double time, double *spin) {
    spin[0] = spin[1] = spin[2] = 0.0;
    if (dim == 2) {
        spin[2] = (to[0] - from[0]) / time;
        return;
    }
    const double back[4] = { from[0], -from[1], -from[2], -from[3] };
    double change[4];
    peri__multiply_turns(to, back, change);
    const double sine = sqrt(peri__dot(change + 1, change + 1, 3)), angle = 2.0 * atan2(sine, fabs(change[0]));
    for (int d = 0; d < 3 && sine > 0.0; ++d) spin[d] = (change[0] < 0.0 ? -angle : angle) * change[1 + d] / (sine * time);
}

/* ---- free bodies ------------------------------------------------------------------------------------------------ */

/* What a tensor of the own frame makes of a vector of the body's. */
static void peri__apply_turned(const double *tensor, const double *axes, const double *in, double *out) {
    double own[3], made[3];
    peri__to_own(axes, in, own);
    peri__to_body(tensor, own, made);
    peri__to_body(axes, made, out);
}

/* From the origin of the frame to the centre of mass. */
static void peri__to_centre(const peri__obstacle *o, double *way) { peri__to_body(o->axes, o->free->centre, way); }

/* Velocity and spin of the frame as the momenta are now. */
static void peri__update_velocity(peri__obstacle *o) {
    double way[3], turned[3];
    peri__apply_turned(o->free->inverse, o->axes, o->free->turning, o->spin);
    peri__to_centre(o, way);
    peri__cross(o->spin, way, turned);
    for (int d = 0; d < 3; ++d) o->velocity[d] = o->free->velocity[d] - turned[d];
}

/* The other way: the momenta of a frame that moves so. */
static void peri__set_momenta(const peri__obstacle *o, const double *velocity, const double *spin) {
    double way[3], turned[3];
    peri__to_centre(o, way);
    peri__cross(spin, way, turned);
    for (int d = 0; d < 3; ++d) o->free->velocity[d] = velocity[d] + turned[d];
    peri__apply_turned(o->free->inertia, o->axes, spin, o->free->turning);
}

static void peri__kick_free(peri__free_body *f, double time) {
    for (int d = 0; d < 3; ++d) {
        f->velocity[d] += time * (f->force[d] / f->mass + f->gravity[d]);
        f->turning[d] += time * f->moment[d];
    }
}

/* The spin in the middle of a step. */
static void peri__middle_spin(peri__obstacle *o, int32_t dim, double step) {
    double turn[4], axes[9], last[3];
    peri__apply_turned(o->free->inverse, o->axes, o->free->turning, o->spin);
    for (int k = 0; k < 30 && dim == 3; ++k) {
        double change = 0.0;
        memcpy(last, o->spin, sizeof last);
        peri__turn_by(dim, o->turn, o->spin, 0.5 * step, turn);
        peri__axes_of(dim, turn, axes);
        peri__apply_turned(o->free->inverse, axes, o->free->turning, o->spin);
        for (int d = 0; d < 3; ++d) change += fabs(o->spin[d] - last[d]) * step;
        if (!(change > 1e-15)) return;
    }
}

static void peri__drift_free(peri__obstacle *o, int32_t dim, double step) {
    double way[3], centre[3], turn[4];
    peri__to_centre(o, way);
    for (int d = 0; d < 3; ++d) centre[d] = o->position[d] + way[d] + step * o->free->velocity[d];
    peri__middle_spin(o, dim, step);
    peri__turn_by(dim, o->turn, o->spin, step, turn);
    memcpy(o->turn, turn, sizeof turn);
    peri__update_axes(o, dim);
    peri__to_centre(o, way);
    for (int d = 0; d < 3; ++d) {
        const double from = o->position[d];
        o->position[d] = centre[d] - way[d];
        o->velocity[d] = (o->position[d] - from) / step;
    }
}

/* Is the motion still within what the arithmetic can square? */
static int peri__is_bounded(const peri__obstacle *o) {
    for (int d = 0; d < 3; ++d)
        if (!(fabs(o->position[d]) < 1e15 && fabs(o->free->velocity[d]) < 1e9 && fabs(o->free->turning[d]) < 1e300)) return 0;
    return peri__finite_vector(o->turn, 4);
}

static double peri__free_kinetic(const peri__free_body *f, const double *spin) {
    return 0.5 * f->mass * peri__dot(f->velocity, f->velocity, 3) + 0.5 * peri__dot(f->turning, spin, 3);
}

/* The stiffness of what is near over the mass: bounds the square of the frequency at which a free body moves on it. What a step may bring
   into touch counts before it does: the first push of a light body would else be too large for the step. */
static double peri__free_stiffness(const peri__obstacle *o) {
    const peri__free_body *f = o->free;
    return o->stiffness * (f->touched / f->mass + f->swept * (f->inverse[0] + f->inverse[4] + f->inverse[8]));
}

/* Back to the start. */
static void peri__restart_obstacle(peri__obstacle *o, int32_t dim, int64_t points) {
    memcpy(o->position, o->position0, sizeof o->position);
    memcpy(o->turn, o->turn0, sizeof o->turn);
    peri__update_axes(o, dim);
    o->lost = 0.0;
    if (o->kept) memset(o->kept, 0, (size_t)points * PERI_KEPT * sizeof *o->kept);
    for (int d = 0; d < 3; ++d) o->velocity[d] = o->spin[d] = o->force[d] = o->moment[d] = 0.0;
    if (!o->free) return;
    memcpy(o->free->velocity, o->free->velocity0, sizeof o->free->velocity);
    memcpy(o->free->turning, o->free->turning0, sizeof o->free->turning);
    o->free->touched = o->free->swept = 0.0;
    for (int d = 0; d < 3; ++d) o->free->force[d] = o->free->moment[d] = 0.0;
    peri__update_velocity(o);
}
