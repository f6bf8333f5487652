/* SPDX-License-Identifier: MIT */
/* test_loose.c - parts that nothing holds, points that hang on too few bonds, and stiffness that is not positive.

   SOURCE OF TRUTH: peri.h (peri_loose); rigid motions strain nothing, so balanced loads strain a free body as they do a held one;
   d'Alembert: a free body under any load is at rest in the frame that its own inertia makes; springs in series. */
#include "solid.h"
#include "equilibrium.h"

static const int32_t policies[] = {PERI_LOOSE_REFUSED, PERI_LOOSE_PINNED, PERI_LOOSE_BALANCED};

static int32_t solve_loose(peri_body *b, int32_t loose, double tolerance, peri_solve_report *r) {
    peri_solve_desc s = statics_of(tolerance);
    s.loose = loose;
    return peri_solve(b, &s, r);
}

/* The refusal names the first point and the number of its motions, and moves nothing. */
static void refused_at(peri_body *b, int64_t point, double motions) {
    peri_error e;
    double *before = get(b, PERI_FIELD_DISPLACEMENT), *after;
    int32_t code = solve_loose(b, PERI_LOOSE_REFUSED, 1e-10, NULL);
    CHECK(code == PERI_ERROR_LOOSE);
    CHECK(peri_get_error(b, &e) == PERI_OK && e.code == PERI_ERROR_LOOSE && e.index == point && e.value == motions);
    after = get(b, PERI_FIELD_DISPLACEMENT);
    CHECK(memcmp(before, after, (size_t)peri_size_of_field(b, PERI_FIELD_DISPLACEMENT) * sizeof *after) == 0);
    free(before);
    free(after);
}

/* ---- free bodies -------------------------------------------------------------------------------------------------- */

typedef struct push { /* body force density of each point, times the factor */
    int           dim;
    const double *density;
} push;
static int32_t pushing(void *user, double time, int64_t count, const int32_t *points, double *value) {
    const push *p = (const push *)user;
    int64_t k;
    int d;
    for (k = 0; k < count; ++k)
        for (d = 0; d < p->dim; ++d) value[k * p->dim + d] = time * p->density[points[k] * p->dim + d];
    return 0;
}

/* Takes out of a body force what moves the centre of mass and turns the body about it: density rho (a + alpha x r), by d'Alembert. rho:
   DENSITY everywhere. */
static void take_inertia_out(peri_body *b, double *density) {
    double *x = get(b, PERI_FIELD_POSITION), *v = get(b, PERI_FIELD_VOLUME), centre[3] = {0}, mass = 0, force[3] = {0}, torque[3] = {0};
    double inertia[9] = {0}, alpha[3] = {0};
    int dim = peri_dimension(b), d, a, c, q;
    int64_t i, n = peri_point_count(b);
    for (i = 0; i < n; ++i) {
        mass += v[i];
        for (d = 0; d < dim; ++d) {
            centre[d] += v[i] * x[i * dim + d];
            force[d] += v[i] * density[i * dim + d];
        }
    }
    for (d = 0; d < dim; ++d) centre[d] /= mass;
    for (i = 0; i < n; ++i) {
        double r[3] = {0, 0, 0}, f[3] = {0, 0, 0}, square = 0;
        for (d = 0; d < dim; ++d) {
            r[d] = x[i * dim + d] - centre[d];
            f[d] = v[i] * density[i * dim + d];
            square += r[d] * r[d];
        }
        for (a = 0; a < 3; ++a) {
            torque[a] += r[(a + 1) % 3] * f[(a + 2) % 3] - r[(a + 2) % 3] * f[(a + 1) % 3];
            for (c = 0; c < 3; ++c) inertia[a * 3 + c] += v[i] * ((a == c ? square : 0) - r[a] * r[c]);
        }
    }
    if (dim == 2) {
        alpha[2] = torque[2] / inertia[8];
    } else {
        CHECK(factorise(inertia, 3, NULL));
        memcpy(alpha, torque, sizeof alpha);
        substitute(inertia, 3, alpha);
    }
    for (i = 0; i < n; ++i)
        for (d = 0; d < dim; ++d) {
            a = (d + 1) % 3;
            q = (d + 2) % 3;
            density[i * dim + d] -= force[d] / mass;
            if (q < dim) density[i * dim + d] -= alpha[a] * (x[i * dim + q] - centre[q]);
            if (a < dim) density[i * dim + d] += alpha[q] * (x[i * dim + a] - centre[a]);
        }
    free(x);
    free(v);
}

/* Momentum of the displacement, as if it were a velocity: over mass and the size of the body; 0 where the motion is left as it was. */
static double drift(peri_body *b, const double *start) {
    double *u = get(b, PERI_FIELD_DISPLACEMENT), *x = get(b, PERI_FIELD_POSITION), *v = get(b, PERI_FIELD_VOLUME);
    double sum[3] = {0}, spin[3] = {0};
    int dim = peri_dimension(b), d, a;
    int64_t i, n = peri_point_count(b);
    for (i = 0; i < n; ++i) {
        double w[3] = {0, 0, 0}, r[3] = {0, 0, 0};
        for (d = 0; d < dim; ++d) {
            w[d] = v[i] * (u[i * dim + d] - start[d]);
            r[d] = x[i * dim + d];
            sum[d] += w[d];
        }
        for (a = 0; a < 3; ++a) spin[a] += r[(a + 1) % 3] * w[(a + 2) % 3] - r[(a + 2) % 3] * w[(a + 1) % 3];
    }
    free(u);
    free(x);
    free(v);
    return fmax(largest(sum, 3), largest(spin, 3));
}

/* A free body of any law under random forces. Balanced: loads less inertia strain it, and it does not move; pinned with the same loads
   without what drives it: the same strain. */
static void free_bodies(void) {
    int32_t space, law;
    for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
        for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law) {
            solid s = solid_of(space, law, PERI_CORRECTION_NONE);
            int dim = dim_of(space), k, motions = dim == 3 ? 6 : 3;
            const double start[3] = {3e-3, -2e-3, 1e-3};
            double *strain[2], *density;
            int64_t n;
            s.ratio = 2;
            for (k = 0; k < 2; ++k) {
                peri_body *b = solid_block(&s, 7, 5, 4);
                peri_solve_report r;
                push p;
                n = peri_point_count(b) * dim;
                density = random_field(n, 1e-3, 17);
                if (k) take_inertia_out(b, density);
                p.dim = dim;
                p.density = density;
                (void)MUST(b, peri_add_displacement(b, PERI_ALL, start));
                (void)MUST(b, peri_apply_body_force(b, PERI_ALL, NULL, pushing, &p));
                refused_at(b, 0, motions);
                (void)MUST(b, solve_loose(b, k ? PERI_LOOSE_PINNED : PERI_LOOSE_BALANCED, 1e-10, &r));
                CHECK(r.loose == motions && r.residual <= 1e-10);
                strain[k] = get(b, PERI_FIELD_STRAIN);
                if (!k) CHECK(drift(b, start) < 1e-12);
                free(density);
                peri_body_destroy(b);
            }
            n = n / dim * parts_of(dim);
            CHECK(largest(strain[0], n) > 1e-6);
            CHECK(furthest(strain[0], strain[1], n) <= 1e-8 * largest(strain[0], n));
            free(strain[0]);
            free(strain[1]);
        }
}

/* Gravity does not strain a free body, whatever its densities; and a body that was turned as a whole is strained in its own axes as one
   that was not (nonlinear). */
static void free_fall(void) {
    const double lo[2] = {0, 0}, hi[2] = {8 * H, 4 * H}, next[2] = {8 * H, 0}, far[2] = {12 * H, 4 * H}, light[2] = {0, -0.02};
    double heavy[2] = {0, -0.06}, *e;
    solid s = solid_of(PERI_SPACE_PLANE_STRAIN, PERI_LAW_LPS, PERI_CORRECTION_NONE);
    peri_body *b = solid_new(&s);
    peri_material_desc m = solid_material(&s);
    peri_solve_report r;
    m.density *= 3;
    (void)MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo, hi, H));
    (void)MUST(b, peri_add_box(b, (int32_t)MUST(b, peri_add_material(b, &m)), next, far, H));
    (void)MUST(b, peri_build(b));
    (void)MUST(b, peri_apply_body_force(b, slab(b, 0, -1, 8 * H), light, NULL, NULL));
    (void)MUST(b, peri_apply_body_force(b, slab(b, 0, 8 * H, 13 * H), heavy, NULL, NULL));
    (void)MUST(b, solve_loose(b, PERI_LOOSE_BALANCED, 1e-10, &r));
    e = get(b, PERI_FIELD_STRAIN);
    CHECK(largest(e, 3 * peri_point_count(b)) < 1e-12 && r.loose == 3);
    free(e);
    peri_body_destroy(b);
}
static void turned_bodies_strain_alike(void) {
    int32_t law;
    for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law) {
        double *strain[2];
        int turned;
        int64_t n = 0;
        for (turned = 0; turned <= 1; ++turned) {
            solid s = solid_of(PERI_SPACE_PLANE_STRESS, law, PERI_CORRECTION_NONE);
            const double c = cos(turned * 0.7), q = sin(turned * 0.7), h[4] = {c - 1, -q, q, c - 1};
            const double right[2] = {0.2 * c, 0.2 * q}, left[2] = {-0.2 * c, -0.2 * q};
            peri_solve_report r;
            peri_body *b;
            s.geometry = PERI_GEOMETRY_NONLINEAR;
            s.ratio = 2;
            b = solid_block(&s, 10, 4, 1);
            stretch_by(b, h);
            (void)MUST(b, peri_apply_layer_traction(b, slab(b, 0, 9 * H, 10 * H), 4 * H, right, NULL, NULL));
            (void)MUST(b, peri_apply_layer_traction(b, slab(b, 0, 0, H), 4 * H, left, NULL, NULL));
            (void)MUST(b, solve_loose(b, PERI_LOOSE_BALANCED, 1e-10, &r));
            CHECK(r.iterations < 200 && r.steps == 1);
            strain[turned] = get(b, PERI_FIELD_STRAIN); /* Green-Lagrange: in the axes of the reference */
            n = 3 * peri_point_count(b);
            peri_body_destroy(b);
        }
        CHECK(largest(strain[0], n) > 0.03);
        /* steps in which the motion does not change turn the body by their square: dead loads then meet it at another angle */
        CHECK(furthest(strain[0], strain[1], n) <= pow(largest(strain[0], n), 3));
        free(strain[0]);
        free(strain[1]);
    }
}

/* ---- parts -------------------------------------------------------------------------------------------------------- */

/* A held block and a free one, one a copy of the other but for its place, in either order; the held one as if it were alone. */
static void a_floating_fragment(void) {
    int order, cut, k;
    for (order = 0; order < 2; ++order)
        for (cut = 0; cut < 2; ++cut)
            for (k = 1; k <= 2; ++k) {
                solid s = solid_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, PERI_CORRECTION_NONE);
                const double gap = cut ? 0 : 5 * H, lo[2] = {0, 0}, hi[2] = {8 * H, 4 * H};
                double far_lo[2] = {8 * H, 0}, far_hi[2] = {14 * H, 4 * H}, a[2] = {8 * H, -1}, c[2] = {8 * H, 1}, *u, *alone;
                const double pull[2] = {0, -1e-3}, out[2] = {1e-3, 0};
                peri_body *b = solid_new(&s), *one = solid_block(&s, 8, 4, 1);
                peri_solve_report r;
                int64_t held = order ? 24 : 0, loose = order ? 0 : 32;
                far_lo[0] += gap;
                far_hi[0] += gap;
                if (order) (void)MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), far_lo, far_hi, H));
                (void)MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo, hi, H));
                if (!order) (void)MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), far_lo, far_hi, H));
                (void)MUST(b, peri_build(b));
                if (cut) CHECK(MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, a, c)) > 0);
                (void)MUST(b, peri_prescribe_displacement(b, slab(b, 0, 0, 2 * H), PERI_AXIS_X | PERI_AXIS_Y, NULL, NULL, NULL));
                (void)MUST(b, peri_apply_body_force(b, slab(b, 0, 0, 8 * H), pull, NULL, NULL));
                (void)MUST(b, peri_apply_body_force(b, slab(b, 0, 11 * H + gap, 14 * H + gap), out, NULL, NULL)); /* drives the free one */
                refused_at(b, loose, 3);
                (void)MUST(b, solve_loose(b, policies[k], 1e-11, &r));
                CHECK(r.loose == 3);
                (void)MUST(one, peri_prescribe_displacement(one, slab(one, 0, 0, 2 * H), PERI_AXIS_X | PERI_AXIS_Y, NULL, NULL, NULL));
                (void)MUST(one, peri_apply_body_force(one, PERI_ALL, pull, NULL, NULL));
                (void)MUST(one, solve_loose(one, PERI_LOOSE_REFUSED, 1e-11, &r));
                CHECK(r.loose == 0);
                u = get(b, PERI_FIELD_DISPLACEMENT);
                alone = get(one, PERI_FIELD_DISPLACEMENT);
                CHECK(furthest(u + 2 * held, alone, 64) <= 1e-8 * largest(alone, 64));
                CHECK(largest(u + 2 * loose, 48) > 0 && largest(u + 2 * loose, 48) < 1e-2);
                free(u);
                free(alone);
                peri_body_destroy(b);
                peri_body_destroy(one);
            }
}

/* Supports that leave some motions free: their number, and that only they are free: a load against what is held strains the body as one
   that is held by all that it needs does. */
typedef struct partial {
    const char *what;
    int         dim, axis, axes, motions; /* points below 1.1 cells along the axis, held in axes; axis 9: those of the edge x = z = 0 */
} partial;
static void on_rollers(void) {
    static const partial cases[] = {{"roller", 2, 1, PERI_AXIS_Y, 1},
                                    {"floor", 3, 2, PERI_AXIS_Z, 3},
                                    {"rail", 3, 2, PERI_AXIS_X | PERI_AXIS_Z, 1},
                                    {"hinge", 3, 9, PERI_AXIS_X | PERI_AXIS_Y | PERI_AXIS_Z, 1},
                                    {"hinge that slides", 3, 9, PERI_AXIS_X | PERI_AXIS_Z, 2}};
    int c, k, d;
    for (c = 0; c < 5; ++c) {
        solid s = solid_of(cases[c].dim == 3 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, PERI_CORRECTION_NONE);
        int dim = cases[c].dim, axes = cases[c].axes;
        double *strain[3];
        int64_t n = 0;
        s.ratio = 2;
        for (k = 0; k < 3; ++k) { /* pinned, balanced, and the rest held at single points by hand */
            peri_body *b = solid_block(&s, 7, 5, 4);
            double *x = get(b, PERI_FIELD_POSITION), *density, lo[3] = {-1, -1, -1}, hi[3] = {0.6 * H, 9, 0.6 * H}, force[3] = {0};
            peri_solve_report r;
            push p;
            int32_t set = cases[c].axis == 9 ? (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi)) : slab(b, cases[c].axis, -1, 1.1 * H);
            int32_t support;
            n = peri_point_count(b) * dim;
            density = random_field(n, 1e-3, 5);
            take_inertia_out(b, density); /* balanced in itself: no free motion is driven */
            p.dim = dim;
            p.density = density;
            support = (int32_t)MUST(b, peri_prescribe_displacement(b, set, axes, NULL, NULL, NULL));
            (void)MUST(b, peri_apply_body_force(b, PERI_ALL, NULL, pushing, &p));
            if (k == 2) {
                const int32_t first = 0, last = (int32_t)(peri_point_count(b) - 1), side = dim == 3 ? 6 : -1;
                int32_t one = (int32_t)MUST(b, peri_select_points(b, NULL, 1, &first)), other;
                const int32_t none = PERI_AXIS_X & PERI_AXIS_Y, free_axes = all_axes(dim) & ~axes;
                if (free_axes) (void)MUST(b, peri_prescribe_displacement(b, one, free_axes | none, NULL, NULL, NULL));
                other = (int32_t)MUST(b, peri_select_points(b, NULL, 1, cases[c].axis == 9 ? &last : side > 0 ? &side : &last));
                /* the turn left: of the floor about z, of a hinge about y */
                if (cases[c].motions == 3) (void)MUST(b, peri_prescribe_displacement(b, other, PERI_AXIS_Y, NULL, NULL, NULL));
                if (cases[c].axis == 9) (void)MUST(b, peri_prescribe_displacement(b, other, PERI_AXIS_X, NULL, NULL, NULL));
            } else {
                refused_at(b, 0, cases[c].motions);
            }
            if (solve_loose(b, k == 2 ? PERI_LOOSE_REFUSED : policies[1 + k], 1e-11, &r) < 0
                || r.loose != (k == 2 ? 0 : cases[c].motions)) {
                printf("    %s, %d: %d motions\n", cases[c].what, k, (int)r.loose);
                test_bad++;
            }
            (void)MUST(b, peri_get_reaction(b, support, force)); /* the loads are balanced: so is what the support gives */
            for (d = 0; d < dim; ++d) CHECK(fabs(force[d]) <= 1e-10);
            strain[k] = get(b, PERI_FIELD_STRAIN);
            free(density);
            free(x);
            peri_body_destroy(b);
        }
        n = n / dim * parts_of(dim);
        CHECK(largest(strain[2], n) > 1e-6);
        CHECK(furthest(strain[0], strain[2], n) <= 1e-8 * largest(strain[2], n));
        CHECK(furthest(strain[1], strain[2], n) <= 1e-8 * largest(strain[2], n));
        for (k = 0; k < 3; ++k) free(strain[k]);
    }
}

/* ---- hanging points ----------------------------------------------------------------------------------------------- */

/* A line of points of volume v, `gap` apart, along a slanted direction, each joined to the next alone; the first is held. The last is
   pulled along the line and, where that is left out (balanced), across. Bonds are springs of force c V V e/|xi| (linear, bond-based: c w
   s) in series: each becomes longer by F |xi|/(c V^2). Across the line nothing says where the points are. */
static void a_chain(int32_t space, int count) {
    static const double line[3] = {0.6, 0.48, 0.64}, flat[2] = {0.6, 0.8}, side[3] = {0.8, -0.36, -0.48}, down[2] = {0.8, -0.6};
    const double gap = 0.1, v = 2e-3, pull = 1e-4;
    const double *along = space == PERI_SPACE_SOLID ? line : flat, *across = space == PERI_SPACE_SOLID ? side : down;
    const int32_t first = 0, last = count;
    int dim = dim_of(space), k, d, way;
    double x[3 * 12], volumes[12], c = 0, density[3], *u, want;
    for (k = 0; k <= count; ++k) {
        volumes[k] = v;
        for (d = 0; d < dim; ++d) x[k * dim + d] = k * gap * along[d];
    }
    for (way = 1; way <= 2; ++way) {
        peri_body *b = empty(space, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 1.5 * gap);
        peri_solve_report r;
        double off = 0, force[3] = {0, 0, 0};
        int32_t support;
        (void)unbreakable(b, YOUNG, DENSITY);
        (void)MUST(b, peri_add_points(b, count + 1, x, volumes, NULL));
        (void)MUST(b, peri_build(b));
        (void)MUST(b, peri_get_bond_constants(b, peri_id(b, PERI_KIND_MATERIAL, 1), peri_id(b, PERI_KIND_MATERIAL, 1), &c, NULL));
        support = (int32_t)MUST(b, peri_select_points(b, NULL, 1, &first));
        support = (int32_t)MUST(b, peri_prescribe_displacement(b, support, all_axes(dim), NULL, NULL, NULL));
        for (d = 0; d < dim; ++d) density[d] = pull * (along[d] + (way == 2 ? 0.7 * across[d] : 0)) / (v * thickness(space));
        (void)MUST(b, peri_apply_body_force(b, (int32_t)MUST(b, peri_select_points(b, NULL, 1, &last)), density, NULL, NULL));
        CHECK(solve_loose(b, PERI_LOOSE_REFUSED, 1e-10, &r) == PERI_ERROR_LOOSE);
        if (MUST(b, solve_loose(b, policies[way], 1e-10, &r)) == PERI_OK) {
            (void)MUST(b, peri_get_reaction(b, support, force));
            for (d = 0; d < dim; ++d) CHECK_NEAR(force[d], -pull * along[d], 0, 1e-9 * pull);
            CHECK(r.loose == dim - 1);
            u = get(b, PERI_FIELD_DISPLACEMENT);
            want = pull * gap / (c * v * v * thickness(space) * thickness(space));
            for (k = 1; k <= count; ++k) {
                double longer = 0;
                for (d = 0; d < dim; ++d) longer += (u[k * dim + d] - u[k * dim - dim + d]) * along[d];
                off = fmax(off, fabs(longer / want - 1));
            }
            if (!(off < 1e-8)) printf("    %s, %d points, way %d: off by %.2g\n", space_name[space % 100], count + 1, way, off);
            CHECK(off < 1e-8);
            free(u);
        }
        peri_body_destroy(b);
    }
}
static void chains_of_points(void) {
    int32_t space;
    int count;
    for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
        for (count = 1; count <= 11; count += count == 1 ? 1 : 9) a_chain(space, count);
}

/* A block whose first point hangs on the bond to the point diagonally next to it. It is refused by its number; else a load on it comes
   through along the bond alone: K u and the reactions say so. Of correspondence the other end's stress and stabilization resist across
   the bond, too: nothing hangs. */
static int32_t all_but_one(void *user, int32_t i, int32_t j, const double *xi, const double *xj) {
    (void)xi;
    (void)xj;
    return i == 0 && j != *(const int32_t *)user;
}
static void a_point_on_one_bond(void) {
    int32_t space, law;
    int way, d;
    for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
        for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law)
            for (way = 0; way <= 2; ++way) {
                solid s = solid_of(space, law, PERI_CORRECTION_NONE);
                const double density[3] = {2e-3, -0.5e-3, 1e-3}; /* along (1, 1, 0)/sqrt 2: 1.5e-3/sqrt 2 */
                const int32_t first = 0;
                int32_t other = 7, dim = dim_of(space), support;
                int64_t n, k;
                int whole = law == PERI_LAW_CORRESPONDENCE;
                double *u, *ku, force[3] = {0, 0, 0}, volume = pow(H, dim) * thickness(space), along = 0.75e-3 * volume, off = 0, want[3];
                peri_solve_report r;
                peri_error e;
                peri_body *b = solid_block(&s, 6, 5, 4);
                n = peri_point_count(b) * dim;
                CHECK(MUST(b, peri_cut_if(b, PERI_CUT_INITIAL, all_but_one, &other)) > 3);
                support = (int32_t)MUST(b, peri_prescribe_displacement(b, slab(b, 0, 4 * H, 6 * H), all_axes(dim), NULL, NULL, NULL));
                (void)MUST(b, peri_apply_body_force(b, (int32_t)MUST(b, peri_select_points(b, NULL, 1, &first)), density, NULL, NULL));
                for (d = 0; d < dim; ++d) want[d] = whole ? density[d] * volume : d < 2 ? along : 0;
                if (way == 0 && !whole) {
                    CHECK(solve_loose(b, PERI_LOOSE_REFUSED, 1e-10, &r) == PERI_ERROR_LOOSE);
                    CHECK(peri_get_error(b, &e) == PERI_OK && e.index == 0);
                    peri_body_destroy(b);
                    continue;
                }
                if (MUST(b, solve_loose(b, policies[way], 1e-11, &r)) == PERI_OK) {
                    (void)MUST(b, peri_get_reaction(b, support, force));
                    u = get(b, PERI_FIELD_DISPLACEMENT);
                    ku = (double *)calloc((size_t)n, sizeof *ku);
                    (void)MUST(b, peri_multiply_stiffness(b, u, ku, n));
                    for (k = 0; k < n; ++k)
                        if (k / dim % 6 < 4) off = fmax(off, fabs(ku[k] - (k < dim ? want[k] : 0)));
                    for (d = 0; d < dim; ++d) CHECK_NEAR(force[d], -want[d], 0, 1e-9 * along);
                    CHECK(off <= 1e-9 * along && u[0] > 0);
                    free(u);
                    free(ku);
                }
                peri_body_destroy(b);
            }
}

/* ---- not positive ------------------------------------------------------------------------------------------------- */

static int32_t sign_changing(void *user, double q, double *w) {
    *w = 1 - *(const double *)user * pow(1 - q, 4);
    return 0;
}

/* Influence that is negative on short bonds (peri.h: "only a non-negative w gives a stable solid"): motions in which neighbours alternate
   lower the energy; with a factor of 20 any point moved alone does, too. v.K v < 0 says so. Conjugate gradients must tell; whatever the
   method, a solve ends with a status and finite displacements. */
static void indefinite(double factor, int32_t geometry, int32_t method, int32_t loose) {
    const double lo[2] = {0, 0}, hi[2] = {12 * H, 8 * H};
    peri_body_desc d;
    peri_body *b = NULL;
    peri_solve_desc s = statics_of(1e-8);
    peri_solve_report r;
    double *v, *kv, *numbers, energy = 0;
    int64_t n, i;
    int32_t code;
    int bad = 0;
    push p;
    peri_body_desc_init(&d);
    d.space = PERI_SPACE_PLANE_STRESS;
    d.horizon = 3 * H;
    d.geometry = geometry;
    d.influence = PERI_INFLUENCE_USER;
    d.influence_fn = sign_changing;
    d.influence_user = &factor;
    d.threads = 1;
    (void)MUST(NULL, peri_body_create(&d, &b, NULL));
    (void)unbreakable(b, YOUNG, DENSITY);
    (void)MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo, hi, H));
    (void)MUST(b, peri_build(b));
    n = peri_point_count(b) * 2;
    v = (double *)calloc((size_t)n, sizeof *v);
    kv = (double *)calloc((size_t)n, sizeof *kv);
    if (factor > 15) v[100] = 1;
    for (i = 0; i < n && factor < 15; i += 2) v[i] = (i / 2 % 12 + i / 24) % 2 ? 1 : -1;
    (void)MUST(b, peri_multiply_stiffness(b, v, kv, n));
    for (i = 0; i < n; ++i) energy += v[i] * kv[i];
    CHECK(energy < 0);
    numbers = random_field(n, 1e-3, 4);
    p.dim = 2;
    p.density = numbers;
    (void)MUST(b, peri_prescribe_displacement(b, slab(b, 0, 0, 3 * H), PERI_AXIS_X | PERI_AXIS_Y, NULL, NULL, NULL));
    (void)MUST(b, peri_apply_body_force(b, PERI_ALL, NULL, pushing, &p));
    s.method = method;
    s.loose = loose;
    s.iterations = 3000;
    s.halvings = 3;
    code = peri_solve(b, &s, &r);
    free(v);
    v = get(b, PERI_FIELD_DISPLACEMENT);
    for (i = 0; i < n; ++i) bad += !isfinite(v[i]);
    if (test_long)
        printf("    factor %.0f, geometry %d, method %d, loose %d: %s, residual %.1e\n", factor, (int)geometry, (int)method, (int)loose,
               peri_status_text(code), r.residual);
    CHECK(bad == 0);
    if (method == PERI_METHOD_NEWTON && geometry == PERI_GEOMETRY_LINEAR) CHECK(code == PERI_ERROR_INDEFINITE);
    /* nonlinear: an equilibrium further down may have been found. BiCGSTAB does not ask for the sign; relaxation runs away */
    else CHECK(code == PERI_ERROR_INDEFINITE || code == PERI_ERROR_CONVERGENCE || (code == PERI_OK && method != PERI_METHOD_RELAXATION));
    free(v);
    free(kv);
    free(numbers);
    peri_body_destroy(b);
}
static void indefinite_stiffness_is_told(void) {
    int32_t geometry, method, loose;
    for (geometry = PERI_GEOMETRY_NONLINEAR; geometry < peri__end_geometry; ++geometry)
        for (method = PERI_METHOD_NEWTON; method < peri__end_method; ++method)
            for (loose = PERI_LOOSE_REFUSED; loose <= PERI_LOOSE_PINNED; ++loose) {
                indefinite(13, geometry, method, loose);
                indefinite(20, geometry, method, loose);
            }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(free_bodies);
    RUN(free_fall);
    RUN(turned_bodies_strain_alike);
    RUN(a_floating_fragment);
    RUN(on_rollers);
    RUN(chains_of_points);
    RUN(a_point_on_one_bond);
    RUN(indefinite_stiffness_is_told);
    return test_end("test_loose");
}
