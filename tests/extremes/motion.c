/* SPDX-License-Identifier: MIT */
/* motion.c - bodies far away, turned and spun for long.

   SOURCE OF TRUTH: invariance of the laws under rigid motion; conservation of momentum and angular momentum; elasticity. What a precision
   can hold of it follows from its rounding unit, 1.1e-16 of the state in double and mixed, 6e-8 in single. */
#include "moving.h"

#define PI 3.14159265358979323846

/* ---- far away ----------------------------------------------------------------------------------------------------- */

/* A pulled and sheared body, and the same carried away by value spacings (single: other). choice 1: a strain and a way that every precision
   holds to the last bit, 0: a strain of 1e-3. */
static outcome carried(const extreme *row, int32_t precision) {
    const double far_ = precision == PERI_PRECISION_SINGLE ? row->other : row->value, size = row->choice ? 1 : 1e-3;
    const double solid[9] = {size, size, 0, 0, size, 0, 0, 0, -size / 2}, plane[4] = {size, size, 0, -size / 2};
    const double shift[3] = {far_, -far_, far_ / 2};
    outcome o = {PERI_OK, "", 0};
    int32_t law, space, geometry;
    for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law)
        for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
            for (geometry = PERI_GEOMETRY_NONLINEAR; geometry < peri__end_geometry && o.status == PERI_OK; ++geometry) {
                const scene s = scene_of(space, precision, law, geometry);
                shown home, away;
                peri_body *b = small_body(&o, &s);
                deform(&o, b, space == PERI_SPACE_SOLID ? solid : plane, NULL, NULL);
                show(&o, b, &home);
                deform(&o, b, space == PERI_SPACE_SOLID ? solid : plane, NULL, shift);
                show(&o, b, &away);
                compare(&o, row, &s, &home, &away, 1, "carried");
                forget(&home);
                forget(&away);
                o = extreme_end(o, b);
            }
    return o;
}

/* A body made at value spacings from the origin, pulled, against one made there. choice 1: a lattice at places that are held exactly. */
static outcome made_far(const extreme *row, int32_t precision) {
    const double solid[9] = {1e-3, 5e-4, 0, 0, 1e-3, 0, 0, 0, -5e-4}, plane[4] = {1e-3, 5e-4, 0, -5e-4};
    outcome o = {PERI_OK, "", 0};
    int32_t law, space;
    int cloud;
    for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law)
        for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
            for (cloud = 0; cloud < (row->choice ? 1 : 2) && o.status == PERI_OK; ++cloud) {
                scene s = scene_of(space, precision, law, PERI_GEOMETRY_NONLINEAR);
                shown seen[2];
                int k, way;
                s.cloud = cloud;
                s.spacing = row->choice ? 1 : 0.1;
                for (way = 0; way < 2; ++way) {
                    peri_body *b;
                    for (k = 0; k < 3; ++k)
                        s.origin[k] = way * row->value * s.spacing * (row->choice ? 1.0 - 0.5 * k : k == 1 ? -1.0 / 3.0 : 1.0);
                    b = small_body(&o, &s);
                    deform(&o, b, space == PERI_SPACE_SOLID ? solid : plane, s.origin, NULL);
                    show(&o, b, &seen[way]);
                    o = extreme_end(o, b);
                }
                compare(&o, row, &s, &seen[0], &seen[1], 1, "made far away");
                forget(&seen[0]);
                forget(&seen[1]);
            }
    return o;
}

/* Cut, selected, thrown at a plane and torn, at home and at 2^20 spacings from the origin: numbers that are differences are the same. */
static outcome torn_far(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    int32_t law, space;
    for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law)
        for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space && o.status == PERI_OK; ++space) {
            scene s = scene_of(space, precision, law, PERI_GEOMETRY_NONLINEAR);
            shown seen[2];
            double sum[2][6] = {{0}};
            int way, k;
            s.stretch = 0.05;
            for (way = 0; way < 2; ++way) {
                const double at = way * row->value, from[2] = {at + 3, at + 2.25}, to[2] = {at + 3, at + 9};
                const double corner[3] = {at + 2, at + 1.75, at - 1};
                const double edge1[3] = {0, 9, 0}, edge2[3] = {0, 0, 9}, place[3] = {at, at + 0.25, at}, up[3] = {0, 1, 0};
                const double right[3] = {0.3, -0.1, 0}, lo[3] = {at + 3, at - 1, at - 1}, hi[3] = {at + 9, at + 9, at + 9};
                peri_body *b;
                peri_advance_desc run;
                peri_energy e;
                for (k = 0; k < 3; ++k) s.origin[k] = at;
                b = small_body(&o, &s);
                (void)extreme_fails(&o, b, space == PERI_SPACE_SOLID ? peri_cut_rectangle(b, PERI_CUT_INITIAL, corner, edge1, edge2)
                                                                     : peri_cut_segment(b, PERI_CUT_INITIAL, from, to));
                (void)extreme_fails(&o, b, peri_add_velocity(b, peri_select_box(b, NULL, lo, hi), right));
                (void)extreme_fails(&o, b, plane_obstacle(b, place, up, 0.5, NULL, NULL));
                peri_advance_desc_init(&run);
                run.steps = 25;
                if (o.status == PERI_OK) (void)extreme_fails(&o, b, peri_advance(b, &run));
                if (!extreme_fails(&o, b, peri_get_energy(b, &e))) {
                    sum[way][0] = e.kinetic;
                    sum[way][1] = e.fracture;
                    sum[way][2] = e.obstacle;
                    sum[way][3] = (double)peri_broken_count(b);
                    sum[way][4] = (double)peri_cut_count(b);
                    sum[way][5] = peri_time(b);
                }
                show(&o, b, &seen[way]);
                o = extreme_end(o, b);
            }
            if (!(sum[0][3] >= 10 && sum[0][4] >= 4 && sum[0][2] != 0))
                extreme_note(&o, row, precision, NAN, "%g broken, %g cut", sum[0][3], sum[0][4]);
            compare(&o, row, &s, &seen[0], &seen[1], 1, "torn far away");
            for (k = 0; k < 6; ++k)
                extreme_note(&o, row, precision, fabs(sum[0][k] - sum[1][k]), "sum %d: law %d, space %d", k, (int)law, (int)space);
            forget(&seen[0]);
            forget(&seen[1]);
        }
    return o;
}

/* ---- turned ------------------------------------------------------------------------------------------------------- */

/* The rotation by `angle` about a skew axis (planes: z), [dim*dim]. */
static void rotation(int dim, double angle, double *r) {
    const double c = cos(angle), s = sin(angle), axis[3] = {2.0 / 3, -1.0 / 3, 2.0 / 3};
    int a, k;
    if (dim == 2) {
        r[0] = r[3] = c;
        r[1] = -s;
        r[2] = s;
        return;
    }
    for (a = 0; a < 3; ++a)
        for (k = 0; k < 3; ++k) r[3 * a + k] = axis[a] * axis[k] * (1 - c) + (a == k ? c : 0);
    for (a = 0; a < 3; ++a) {
        r[3 * a + (a + 1) % 3] -= axis[(a + 2) % 3] * s;
        r[3 * a + (a + 2) % 3] += axis[(a + 1) % 3] * s;
    }
}

/* R T R^T of a packed tensor. */
static void turn_tensor(int dim, const double *r, const double *t, double *out) {
    static const int place[2][9] = {{0, 2, 2, 1}, {0, 3, 5, 3, 1, 4, 5, 4, 2}};
    int a, c, d, e;
    for (a = 0; a < dim; ++a)
        for (c = a; c < dim; ++c) {
            double sum = 0;
            for (d = 0; d < dim; ++d)
                for (e = 0; e < dim; ++e) sum += r[a * dim + d] * t[place[dim - 2][d * dim + e]] * r[c * dim + e];
            out[place[dim - 2][a * dim + c]] = sum;
        }
}

/* The fields of a body that is turned, from those before. Strain is of the reference. */
static void turn_shown(const shown *s, int dim, const double *r, shown *out) {
    int k;
    for (k = 0; k < FIELDS; ++k) {
        const int parts = fields[k] == PERI_FIELD_FORCE_DENSITY ? dim : fields[k] >= PERI_FIELD_STRESS ? dim * (dim + 1) / 2 : 1;
        int64_t i;
        int a, c;
        out->n[k] = s->n[k];
        out->x[k] = (double *)malloc((size_t)s->n[k] * sizeof(double) + 1);
        for (i = 0; out->x[k] && i < s->n[k]; i += parts) {
            if (parts == 1) out->x[k][i] = s->x[k][i];
            else if (parts != dim) turn_tensor(dim, r, &s->x[k][i], &out->x[k][i]);
            else
                for (a = 0; a < dim; ++a)
                    for (out->x[k][i + a] = 0, c = 0; c < dim; ++c) out->x[k][i + a] += r[a * dim + c] * s->x[k][i + c];
        }
    }
}

static const double angles[] = {1e-9, 1e-3, 0.7, PI / 2, 2, PI, -3, 2e4 * PI + 1};
#define ANGLES ((int)(sizeof angles / sizeof angles[0]))

/* choice 0: turned only: no energy (its root counts, a strain) and no force. 1: pulled by 10 %, then turned. */
static outcome turned(const extreme *row, int32_t precision) {
    const double pull[9] = {1.1, 0.05, 0, 0, 0.96, 0.03, 0, 0, 1}, flat[4] = {1.1, 0.05, 0, 0.96};
    outcome o = {PERI_OK, "", 0};
    int32_t law, space;
    int way, cloud;
    for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law)
        for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
            for (cloud = 0; cloud < 2 && o.status == PERI_OK; ++cloud) {
                const int dim = dim_of(space);
                const double *f = dim == 3 ? pull : flat;
                scene s = scene_of(space, precision, law, PERI_GEOMETRY_NONLINEAR);
                shown home, want, got;
                double g[9], r[9];
                peri_body *b;
                int a, c, d, k;
                s.cloud = cloud;
                b = small_body(&o, &s);
                for (a = 0; a < dim * dim; ++a) g[a] = f[a] - (a % (dim + 1) == 0 ? 1 : 0);
                deform(&o, b, g, NULL, NULL);
                show(&o, b, &home);
                for (way = 0; way < ANGLES && o.status == PERI_OK; ++way) {
                    rotation(dim, angles[way], r);
                    for (a = 0; a < dim; ++a)
                        for (c = 0; c < dim; ++c) {
                            double sum = 0;
                            for (d = 0; d < dim; ++d) sum += r[a * dim + d] * (row->choice ? f[d * dim + c] : d == c ? 1 : 0);
                            g[a * dim + c] = sum - (a == c ? 1 : 0);
                        }
                    deform(&o, b, g, NULL, NULL);
                    show(&o, b, &got);
                    if (row->choice) {
                        char what[40];
                        (void)snprintf(what, sizeof what, "turned by %g", angles[way]);
                        turn_shown(&home, dim, r, &want);
                        compare(&o, row, &s, &want, &got, 1, what);
                        forget(&want);
                    } else
                        for (k = 0; k < FIELDS; ++k) {
                            double most = 0;
                            int64_t i;
                            for (i = 0; i < got.n[k]; ++i) most = extreme_worst(most, fabs(got.x[k][i]));
                            if (fields[k] == PERI_FIELD_ENERGY_DENSITY) most = sqrt(most);
                            extreme_note(&o, row, precision, most, "turned by %g: %s, law %d, space %d, cloud %d", angles[way],
                                         names[k], (int)law, (int)space, cloud);
                        }
                    forget(&got);
                }
                forget(&home);
                o = extreme_end(o, b);
            }
    return o;
}

/* Linear geometry, turned by t about z: the strain is (cos t - 1) in the plane of the turn (peri.h: small displacements). Weights with the
   moment correction give the solid's energy in the middle. */
static outcome turned_linear(const extreme *row, int32_t precision) {
    static const double by[] = {0.1, 1, PI};
    outcome o = {PERI_OK, "", 0};
    int32_t law, space;
    int k;
    for (law = PERI_LAW_LPS; law < peri__end_law; ++law)
        for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space && o.status == PERI_OK; ++space) {
            const double lo[3] = {0, 0, 0}, hi[3] = {5, 5, 5}, nu = 0.3, mu = 0.5 / (1 + nu);
            const double lambda = space == PERI_SPACE_PLANE_STRESS ? nu / (1 - nu * nu) : nu / ((1 + nu) * (1 - 2 * nu));
            const int dim = dim_of(space), parts = dim == 3 ? 6 : 3;
            peri_body_desc d;
            peri_material_desc m;
            peri_body *b = NULL;
            extreme_desc(&d, space, precision, 2);
            d.geometry = PERI_GEOMETRY_LINEAR;
            d.correction = PERI_CORRECTION_MOMENT;
            extreme_material(&m, law, nu, 0);
            (void)extreme_fails(&o, NULL, peri_body_create(&d, &b, NULL));
            (void)extreme_fails(&o, b, peri_add_material(b, &m));
            (void)extreme_fails(&o, b, peri_add_box(b, material_id(b, 1), lo, hi, 1));
            (void)extreme_fails(&o, b, peri_build(b));
            for (k = 0; k < 3 && o.status == PERI_OK; ++k) {
                const double c = cos(by[k]) - 1, s = sin(by[k]), solid[9] = {c, -s, 0, s, c, 0, 0, 0, 0}, plane[4] = {c, -s, s, c};
                const double energy = 0.5 * lambda * 4 * c * c + mu * 2 * c * c, stress = (2 * lambda + 2 * mu) * c;
                const int64_t i = peri_point_count(b) / 2;
                shown got;
                double force = 0, worst;
                int64_t n;
                deform(&o, b, dim == 3 ? solid : plane, NULL, NULL);
                show(&o, b, &got);
                if (o.status == PERI_OK) {
                    worst = fabs(got.x[0][i] / energy - 1);
                    worst = extreme_worst(worst, fabs(got.x[4][i * parts] / stress - 1));
                    worst = extreme_worst(worst, fabs(got.x[5][i * parts + 1] / stress - 1));
                    worst = extreme_worst(worst, fabs(got.x[5][i * parts + (dim == 3 ? 3 : 2)] / stress));
                    for (n = 0; n < got.n[1]; ++n) force = extreme_worst(force, fabs(got.x[1][n]));
                    if (!(force > 0.01 * fabs(stress))) worst = NAN;
                    extreme_note(&o, row, precision, worst, "turned by %g: law %d, space %d", by[k], (int)law, (int)space);
                }
                forget(&got);
            }
            o = extreme_end(o, b);
        }
    return o;
}

/* ---- spun --------------------------------------------------------------------------------------------------------- */

/* Velocities of a spin w about the centre (3D: about a skew axis), and a drift. */
static void spin(outcome *o, peri_body *b, double w, double drift) {
    const int64_t n = peri_size_of_field(b, PERI_FIELD_POSITION);
    const int dim = peri_dimension(b);
    double *x = extreme_read(o, b, PERI_FIELD_POSITION), centre[3] = {0}, r[9];
    const double axis[3] = {2.0 / 3, -1.0 / 3, 2.0 / 3};
    int64_t i;
    int k;
    for (i = 0; x && i < n; ++i) centre[i % dim] += x[i] * dim / (double)n;
    for (i = 0; x && i < n; i += dim) {
        for (k = 0; k < dim; ++k) r[k] = x[i + k] - centre[k];
        if (dim == 2) {
            x[i] = -w * r[1] + drift;
            x[i + 1] = w * r[0];
        } else
            for (k = 0; k < 3; ++k)
                x[i + k] = w * (axis[(k + 1) % 3] * r[(k + 2) % 3] - axis[(k + 2) % 3] * r[(k + 1) % 3]) + (k == 0 ? drift : 0);
    }
    if (x) (void)extreme_fails(o, b, peri_set_field(b, PERI_FIELD_VELOCITY, x, n));
    free(x);
}

/* Bodies of every law that spin, drift and fly to pieces: momentum and angular momentum stay. choice 1: bonds break. */
static outcome spinning(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    int32_t law, space;
    int cloud;
    for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law)
        for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
            for (cloud = 0; cloud < 2 && o.status == PERI_OK; ++cloud) {
                scene s = scene_of(space, precision, law, PERI_GEOMETRY_NONLINEAR);
                const int dim = dim_of(space);
                double linear[2][3] = {{0}}, angular[2][3] = {{0}}, size = 0;
                peri_body *b;
                peri_advance_desc run;
                int k;
                s.cloud = cloud;
                s.stretch = row->choice ? 0.05 : 0;
                b = small_body(&o, &s);
                spin(&o, b, row->choice ? 0.15 : 0.05, 0.02);
                (void)extreme_fails(&o, b, peri_get_momentum(b, linear[0], angular[0]));
                peri_advance_desc_init(&run);
                run.steps = (int64_t)row->value;
                if (o.status == PERI_OK) (void)extreme_fails(&o, b, peri_advance(b, &run));
                (void)extreme_fails(&o, b, peri_get_momentum(b, linear[1], angular[1]));
                if (row->choice && o.status == PERI_OK && peri_broken_count(b) < 20)
                    extreme_note(&o, row, precision, NAN, "%d bonds broke", (int)peri_broken_count(b));
                for (k = 0; k < dim; ++k) size = extreme_worst(size, fabs(linear[0][k]));
                for (k = 0; k < dim; ++k)
                    extreme_note(&o, row, precision, fabs(linear[1][k] - linear[0][k]) / size,
                                 "momentum %d: law %d, space %d, cloud %d", k, (int)law, (int)space, cloud);
                for (size = 0, k = 0; k < 3; ++k) size = extreme_worst(size, fabs(angular[0][k]));
                for (k = 0; k < (dim == 3 ? 3 : 1); ++k)
                    extreme_note(&o, row, precision, fabs(angular[1][k] - angular[0][k]) / size,
                                 "angular momentum %d: law %d, space %d, cloud %d", k, (int)law, (int)space, cloud);
                o = extreme_end(o, b);
            }
    return o;
}

/* Four points that turn value times, then stopped, turned and pulled: angular momentum has stayed, and the stress is that of a pull at
   home. */
static outcome revolved(const extreme *row, int32_t precision) {
    const double lo[2] = {-1, -1}, hi[2] = {1, 1}, w = 0.3, pull[4] = {0.1, 0.05, 0, -0.04};
    outcome o = {PERI_OK, "", 0};
    scene s = scene_of(PERI_SPACE_PLANE_STRESS, precision, row->choice, PERI_GEOMETRY_NONLINEAR);
    peri_body_desc d;
    peri_material_desc m;
    peri_body *b = NULL;
    peri_advance_desc run;
    peri_energy e;
    shown home, want, got;
    double before = 0, after = 0, r[4], g[4], *x, angle;
    int a, c;
    extreme_desc(&d, s.space, precision, 1.5);
    extreme_material(&m, row->choice, 0.3, 0);
    (void)extreme_fails(&o, NULL, peri_body_create(&d, &b, NULL));
    (void)extreme_fails(&o, b, peri_add_material(b, &m));
    (void)extreme_fails(&o, b, peri_add_box(b, material_id(b, 1), lo, hi, 1));
    if (extreme_fails(&o, b, peri_build(b))) return extreme_end(o, b);
    deform(&o, b, pull, NULL, NULL);
    show(&o, b, &home);
    (void)extreme_fails(&o, b, peri_reset(b));
    spin(&o, b, w, 0);
    (void)extreme_fails(&o, b, peri_get_momentum(b, NULL, &before));
    peri_advance_desc_init(&run);
    run.duration = row->value * 2 * PI / w;
    (void)extreme_fails(&o, b, peri_advance(b, &run));
    (void)extreme_fails(&o, b, peri_get_momentum(b, NULL, &after));
    extreme_note(&o, row, precision, fabs(after / before - 1), "angular momentum");
    if (!extreme_fails(&o, b, peri_get_energy(b, &e)) && !(fabs(e.error) < 0.02 * e.initial))
        extreme_note(&o, row, precision, NAN, "energy %g", e.error / e.initial);
    x = extreme_read(&o, b, PERI_FIELD_CURRENT_POSITION);
    angle = x ? atan2(x[7] - x[1], x[6] - x[0]) - PI / 4 : 0;
    free(x);
    rotation(2, angle, r);
    for (a = 0; a < 2; ++a)
        for (c = 0; c < 2; ++c)
            g[a * 2 + c] = r[2 * a] * (pull[c] + (c == 0 ? 1 : 0)) + r[2 * a + 1] * (pull[2 + c] + (c == 1 ? 1 : 0)) - (a == c ? 1 : 0);
    deform(&o, b, g, NULL, NULL);
    show(&o, b, &got);
    turn_shown(&home, 2, r, &want);
    compare(&o, row, &s, &want, &got, 1, "after the turns");
    forget(&home);
    forget(&want);
    forget(&got);
    return extreme_end(o, b);
}

#define NONE {0, 0, 0}
#define OBJECTIVE "the laws are objective: a rigid motion changes nothing"

static const extreme rows[] = {
    {"carried 2^20 spacings away, held exactly", "differences of numbers that are held exactly are exact", carried, 1048576, 1048576, 1,
     PERI_OK, NULL, NONE},
    /* the state rounds at 1e6 spacings to 6e-11, in single at 10 to 5e-7: of extensions of 1e-3, twice a bond, in force and energy */
    {"carried 1e6 spacings away (single: 10)", OBJECTIVE, carried, 1e6, 10, 0, PERI_OK, NULL, {1e-6, 2e-6, 4e-3}},
    {"made 2^20 spacings away, held exactly", "differences of numbers that are held exactly are exact", made_far, 1048576, 0, 1, PERI_OK,
     NULL, NONE},
    /* places are given to 1e-10 of a spacing, bonds of one; weights and u follow */
    {"made 1e6 spacings away", OBJECTIVE, made_far, 1e6, 0, 0, PERI_OK, NULL, {1e-8, 1e-5, 1e-5}},
    {"torn 2^20 spacings away", OBJECTIVE, torn_far, 1048576, 0, 0, PERI_OK, NULL, NONE},
    /* displacements of 14 round to 1.6e-15, 8e-7; a bond's share to 6e-8; 30 bonds of stiffness 1 */
    {"turned by any angle", OBJECTIVE, turned, 0, 0, 0, PERI_OK, NULL, {5e-14, 4e-6, 2e-5}},
    {"pulled and turned by any angle", OBJECTIVE, turned, 0, 0, 1, PERI_OK, NULL, {5e-13, 4e-5, 2e-4}},
    {"turned, linear geometry", "strain cos - 1 in the plane of the turn; elasticity", turned_linear, 0, 0, 0, PERI_OK, NULL,
     {1e-11, 1e-3, 1e-3}},
    {"spinning", "momentum and angular momentum are conserved", spinning, 200, 0, 0, PERI_OK, NULL, {2e-13, 1e-4, 1e-4}},
    {"spinning to pieces", "momentum and angular momentum are conserved", spinning, 200, 0, 1, PERI_OK, NULL, {2e-13, 1e-4, 1e-4}},
    /* 3e5 steps of rounding without bias, 600 units */
    {"1e4 revolutions, then pulled, bond-based", OBJECTIVE, revolved, 1e4, 0, PERI_LAW_BOND_BASED, PERI_OK, NULL, {5e-13, 4e-4, 4e-4}},
    {"1e4 revolutions, then pulled, LPS", OBJECTIVE, revolved, 1e4, 0, PERI_LAW_LPS, PERI_OK, NULL, {5e-13, 4e-4, 4e-4}},
    {"1e4 revolutions, then pulled, Oterkus", OBJECTIVE, revolved, 1e4, 0, PERI_LAW_OTERKUS, PERI_OK, NULL, {5e-13, 4e-4, 4e-4}},
    {"1e4 revolutions, then pulled, correspondence", OBJECTIVE, revolved, 1e4, 0, PERI_LAW_CORRESPONDENCE, PERI_OK, NULL,
     {5e-13, 4e-4, 4e-4}},
};
const extreme_table extreme_motion = EXTREME_TABLE("motion", rows);
