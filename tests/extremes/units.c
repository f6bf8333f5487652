/* SPDX-License-Identifier: MIT */
/* units.c - scenes in every system of units.

   SOURCE OF TRUTH: dimensional analysis. A scene whose lengths, moduli and densities are multiplied by L, E and rho has displacements of
   L, times of L sqrt(rho/E), stresses of E, energies of E L^3 (planes: E L^2 times the thickness) times those of the same scene in units
   of one, and breaks the same bonds. Both runs round on their own, so numbers agree to the rounding of what they went through. */
#include "extremes.h"
#define STEPS 30
#define GROUPS 64

typedef struct units {
    double length, stress, density, thickness;
} units;

typedef struct scene {
    int32_t space, precision, law, geometry, criterion;
    int32_t exact;  /* only what powers of two go through unrounded: no cube roots                                        */
    int32_t source; /* 0 a lattice; others with weights of their own: 1 cells moved, partial volumes, 2 points of the caller, a user's w,
                       3 a lattice, moment correction                                                                    */
} scene;

typedef struct record { /* numbers in units of the scene, by what they are                                              */
    double     *x[GROUPS];
    int64_t     n[GROUPS];
    const char *name[GROUPS];
    int         count;
    int64_t     broken;
} record;

static const units one = {1, 1, 1, 1};

static double time_unit(const units *s) { return s->length * (sqrt(s->density) / sqrt(s->stress)); }
static double speed_unit(const units *s) { return s->length / time_unit(s); }
static int dim_of(const scene *c) { return c->space == PERI_SPACE_SOLID ? 3 : 2; }
static double cube(const units *s, const scene *c) {
    return s->length * s->length * (c->space == PERI_SPACE_SOLID ? s->length : s->thickness);
}

/* ---- records ------------------------------------------------------------------------------------------------------ */

static void keep(record *r, const char *name, const double *x, int64_t n, double unit) {
    int64_t i;
    double *own = (double *)malloc((size_t)n * sizeof *own + 1);
    if (!own || r->count == GROUPS) {
        free(own);
        return;
    }
    for (i = 0; i < n; ++i) own[i] = x[i] / unit;
    r->x[r->count] = own;
    r->n[r->count] = n;
    r->name[r->count++] = name;
}

static void keep_field(record *r, outcome *o, peri_body *b, int32_t field, const char *name, double unit) {
    double *x = extreme_read(o, b, field);
    if (x) keep(r, name, x, peri_size_of_field(b, field), unit);
    free(x);
}

static void drop(record *r) {
    int k;
    for (k = 0; k < r->count; ++k) free(r->x[k]);
    r->count = 0;
}

/* The largest difference of two records, of each group as a part of its largest number. */
static double apart(const record *a, const record *b, const char **name) {
    double worst = 0;
    int k;
    *name = "nothing";
    if (a->count == 0 || a->count != b->count) return NAN;
    for (k = 0; k < a->count; ++k) {
        double largest = 0, difference = a->n[k] == b->n[k] ? 0 : NAN;
        int64_t i;
        for (i = 0; i < a->n[k]; ++i) {
            largest = extreme_worst(largest, fabs(a->x[k][i]));
            if (i < b->n[k] && a->x[k][i] != b->x[k][i]) difference = extreme_worst(difference, fabs(a->x[k][i] - b->x[k][i]));
        }
        if (difference > 0) difference /= largest;
        if (worst == worst && !(difference <= worst)) *name = a->name[k];
        worst = extreme_worst(worst, difference);
    }
    return worst;
}

/* All that a body tells; at rest forces are but what the solver has left. */
static void keep_all(record *r, outcome *o, peri_body *b, const units *s, const scene *c, int rest) {
    const int dim = dim_of(c), turns = dim == 3 ? 3 : 1;
    const double t = time_unit(s), density = s->stress / s->length, energy = s->stress * cube(s, c);
    double linear[3] = {0}, angular[3] = {0}, numbers[4];
    peri_energy e;
    keep_field(r, o, b, PERI_FIELD_POSITION, "position", s->length);
    keep_field(r, o, b, PERI_FIELD_DISPLACEMENT, "displacement", s->length);
    keep_field(r, o, b, PERI_FIELD_VELOCITY, "velocity", s->length / t);
    if (!rest) keep_field(r, o, b, PERI_FIELD_FORCE_DENSITY, "force density", density);
    keep_field(r, o, b, PERI_FIELD_VOLUME, "volume", dim == 3 ? cube(s, c) : s->length * s->length);
    keep_field(r, o, b, PERI_FIELD_FAMILY_SIZE, "family size", 1);
    keep_field(r, o, b, PERI_FIELD_DAMAGE, "damage", 1);
    keep_field(r, o, b, PERI_FIELD_ENERGY_DENSITY, "energy density", s->stress);
    keep_field(r, o, b, PERI_FIELD_CURRENT_POSITION, "current", s->length);
    keep_field(r, o, b, PERI_FIELD_DILATATION, "dilatation", 1);
    keep_field(r, o, b, PERI_FIELD_STRAIN, "strain", 1);
    keep_field(r, o, b, PERI_FIELD_STRESS, "stress", s->stress);
    keep_field(r, o, b, PERI_FIELD_FORCE_STRESS, "force stress", s->stress);
    keep_field(r, o, b, PERI_FIELD_REACTION, "reaction density", density);
    if (!extreme_fails(o, b, peri_get_energy(b, &e))) {
        const double ledger[8] = {e.kinetic, e.elastic, e.external, e.obstacle, e.damping, e.fracture, e.initial, e.error};
        keep(r, "ledger", ledger, 8, energy);
    }
    if (!extreme_fails(o, b, peri_get_momentum(b, linear, angular))) {
        keep(r, "momentum", linear, dim, s->density * cube(s, c) * s->length / t);
        keep(r, "angular momentum", angular, turns, energy * t);
    }
    numbers[0] = peri_stable_step(b);
    keep(r, "stable step", numbers, 1, t);
    numbers[0] = peri_time(b);
    keep(r, "time", numbers, 1, t);
    r->broken = peri_broken_count(b);
    numbers[0] = (double)r->broken;
    numbers[1] = (double)peri_cut_count(b);
    keep(r, "broken and cut", numbers, 2, 1);
    const int32_t id = material_id(b, 1);
    if (c->law == PERI_LAW_BOND_BASED && !extreme_fails(o, b, peri_get_bond_constants(b, id, id, &numbers[0], &numbers[1]))) {
        keep(r, "micromodulus", numbers, 1, s->stress / (s->length * cube(s, c)));
        keep(r, "critical stretch", numbers + 1, 1, 1);
    }
    if (c->criterion != PERI_CRITERION_STRETCH && !extreme_fails(o, b, peri_get_critical_energy(b, id, numbers)))
        keep(r, "critical energy", numbers, 1, s->stress / cube(s, c));
}

/* ---- the scene ---------------------------------------------------------------------------------------------------- */

static int32_t user_weight(void *user, double q, double *w) {
    (void)user;
    *w = 1.2 - q;
    return 0;
}

/* Points of the caller, off the lattice by up to 0.2. */
static void give_points(outcome *o, peri_body *b, const double *hi, double l, int dim) {
    double x[3 * 100], v[100];
    const int n[3] = {(int)(hi[0] / l + 0.5), (int)(hi[1] / l + 0.5), dim == 3 ? (int)(hi[2] / l + 0.5) : 1};
    uint64_t seed = 11;
    int k, d, count = 0;
    for (k = 0; k < n[0] * n[1] * n[2]; ++k, ++count) {
        const int at[3] = {k % n[0], k / n[0] % n[1], k / n[0] / n[1]};
        for (d = 0; d < dim; ++d) x[dim * k + d] = l * (at[d] + 0.3 + 0.4 * test_random(&seed));
        v[k] = dim == 3 ? l * l * l : l * l;
    }
    (void)extreme_fails(o, b, peri_add_points(b, count, x, v, NULL));
}

/* A bar of 7 x 4 x 3 cells, or a strip of 12 x 5, in units s; limit: times what breaks it at about 2 % stretch, 0: never. */
static peri_body *bar(outcome *o, const units *s, const scene *c, double limit) {
    const double l = s->length, lo[3] = {0, 0, 0}, solid[3] = {7 * l, 4 * l, 3 * l}, plane[3] = {12 * l, 5 * l, 0};
    const double *hi = c->space == PERI_SPACE_SOLID ? solid : plane;
    peri_body_desc d;
    peri_material_desc m;
    peri_body *b = NULL;
    extreme_desc(&d, c->space, c->precision, (c->space == PERI_SPACE_SOLID ? 2 : 3) * l);
    d.geometry = c->geometry;
    if (c->space != PERI_SPACE_SOLID) d.thickness = s->thickness;
    extreme_material(&m, c->law, 0.3, 0);
    m.young = s->stress;
    m.density = s->density;
    m.criterion = c->criterion;
    if (c->source == 1) d.quadrature = PERI_QUADRATURE_PARTIAL;
    if (c->source == 2) {
        d.influence = PERI_INFLUENCE_USER;
        d.influence_fn = user_weight;
    }
    if (c->source == 3) d.correction = PERI_CORRECTION_MOMENT;
    if (limit > 0) m.fracture_energy = limit * 1e-3 * s->stress * l;
    if (extreme_fails(o, NULL, peri_body_create(&d, &b, NULL)) || extreme_fails(o, b, peri_add_material(b, &m))) return b;
    if (c->source == 1) (void)extreme_fails(o, b, peri_add_perturbed_box(b, material_id(b, 1), lo, hi, l, 0.7, 3));
    else if (c->source == 2) give_points(o, b, hi, l, dim_of(c));
    else (void)extreme_fails(o, b, peri_add_box(b, material_id(b, 1), lo, hi, l));
    if (o->status == PERI_OK) (void)extreme_fails(o, b, peri_build(b));
    return b;
}

/* The points with x between from and to, in spacings. */
static int32_t slab(outcome *o, peri_body *b, const units *s, double from, double to) {
    const double l = s->length, lo[3] = {from * l, -l, -l}, hi[3] = {to * l, 99 * l, 99 * l};
    const int32_t set = peri_select_box(b, NULL, lo, hi);
    (void)extreme_fails(o, b, set);
    return set;
}

static void notch(outcome *o, peri_body *b, const units *s, const scene *c) {
    const double l = s->length, lo[3] = {3 * l, 2.3 * l, -l}, edge1[3] = {0, 9 * l, 0}, edge2[3] = {0, 0, 9 * l};
    const double from[2] = {6 * l, 3.3 * l}, to[2] = {6 * l, 9 * l};
    (void)extreme_fails(o, b, c->space == PERI_SPACE_SOLID ? peri_cut_rectangle(b, PERI_CUT_INITIAL, lo, edge1, edge2)
                                                           : peri_cut_segment(b, PERI_CUT_INITIAL, from, to));
}

/* Pulled apart by its ends, loaded, damped, thrown at a plane and a ball: everything that acts has other units. */
static peri_body *pull(outcome *o, const units *s, const scene *c, record *r) {
    const double t = time_unit(s), v = speed_unit(s), l = s->length, width = c->space == PERI_SPACE_SOLID ? 7 : 12;
    const double left[3] = {-0.06 * v, 0, 0}, right[3] = {0.06 * v, 0.01 * v, 0}, down[3] = {0, -0.05 * v, 0}, up[3] = {0, 1, 0};
    const double pressure[3] = {0, 2e-3 * s->stress, 0}, weight[3] = {0, -1e-3 * s->stress / l, 0}, floor_[3] = {0, 0.3 * l, 0};
    const double ball[3] = {0.5 * width * l, -2.5 * l, l};
    int32_t sets[2], loads[2], plane = -1, round = -1, k;
    double force[3];
    peri_advance_desc run;
    peri_body *b = bar(o, s, c, 1);
    if (o->status < 0) return b;
    notch(o, b, s, c);
    sets[0] = slab(o, b, s, 0, 1);
    sets[1] = slab(o, b, s, width - 1, width);
    if (c->criterion == PERI_CRITERION_NODE_ENERGY) /* bonds within a grip neither lengthen nor shorten: rounding would decide */
        for (k = 0; k < 2; ++k) (void)extreme_fails(o, b, peri_set_no_fail(b, sets[k], 1));
    loads[0] = peri_prescribe_velocity(b, sets[0], PERI_AXIS_X, left, NULL, NULL);
    (void)extreme_fails(o, b, loads[0]);
    (void)extreme_fails(o, b, peri_prescribe_velocity(b, sets[1], PERI_AXIS_XY, right, NULL, NULL));
    loads[1] = peri_apply_layer_traction(b, slab(o, b, s, 2, 4), (dim_of(c) == 3 ? 2 * l : 1) * l, pressure, NULL, NULL);
    (void)extreme_fails(o, b, loads[1]);
    (void)extreme_fails(o, b, peri_apply_body_force(b, PERI_ALL, weight, NULL, NULL));
    (void)extreme_fails(o, b, peri_add_velocity(b, PERI_ALL, down));
    plane = plane_obstacle(b, floor_, up, 0.3 * s->stress / (l * l), NULL, NULL);
    (void)extreme_fails(o, b, plane);
    if (!c->exact) {
        round = ball_obstacle(b, ball, 3.2 * l, 0, NULL, NULL);
        (void)extreme_fails(o, b, round);
    }
    peri_advance_desc_init(&run);
    if (c->exact) run.steps = STEPS;
    else run.duration = 9 * t;
    run.damping = 0.02 / t;
    if (o->status == PERI_OK) (void)extreme_fails(o, b, peri_advance(b, &run));
    keep_all(r, o, b, s, c, 0);
    if (!extreme_fails(o, b, peri_get_reaction(b, loads[0], force))) keep(r, "reaction", force, dim_of(c), s->stress * cube(s, c) / l);
    if (!extreme_fails(o, b, peri_get_reaction(b, loads[1], force))) keep(r, "load", force, dim_of(c), s->stress * cube(s, c) / l);
    const double unit = s->stress * cube(s, c) / l;
    if (!extreme_fails(o, b, peri_get_obstacle_force(b, plane, force, NULL))) keep(r, "plane", force, dim_of(c), unit);
    if (!c->exact && !extreme_fails(o, b, peri_get_obstacle_force(b, round, force, NULL))) keep(r, "ball", force, dim_of(c), unit);
    return b;
}

/* Held at one end, under tractions, pressures in a crack and over all faces. */
static peri_body *hold(outcome *o, const units *s, const scene *c, record *r) {
    const double l = s->length, width = c->space == PERI_SPACE_SOLID ? 7 : 12, high = c->space == PERI_SPACE_SOLID ? 4 : 5;
    const double along[3] = {1, 0, 0}, value[3] = {1e-3 * s->stress, 2e-4 * s->stress, 0}, area = high * l * (dim_of(c) == 3 ? 3 * l : 1);
    const int32_t axes = PERI_AXIS_XY | (c->space == PERI_SPACE_SOLID ? PERI_AXIS_Z : 0);
    double *u, force[3];
    int64_t n;
    int32_t held;
    peri_solve_desc statics;
    peri_matrix *matrix = NULL;
    peri_body *b = bar(o, s, c, 0);
    if (o->status < 0) return b;
    notch(o, b, s, c);
    held = peri_prescribe_displacement(b, slab(o, b, s, 0, 2), axes, NULL, NULL, NULL);
    (void)extreme_fails(o, b, held);
    (void)extreme_fails(o, b, peri_apply_traction(b, slab(o, b, s, 3, width), area, along, value, NULL, NULL));
    (void)extreme_fails(o, b, peri_apply_pressure(b, PERI_ALL, 1e-4 * s->stress, NULL, NULL));
    (void)extreme_fails(o, b, peri_apply_bond_pressure_for_comparison(b, PERI_ALL, 5e-4 * s->stress, NULL, NULL));
    peri_solve_desc_init(&statics);
    if (o->status == PERI_OK) (void)extreme_fails(o, b, peri_solve(b, &statics, NULL));
    keep_all(r, o, b, s, c, 1);
    if (!extreme_fails(o, b, peri_get_reaction(b, held, force))) keep(r, "reaction", force, dim_of(c), s->stress * cube(s, c) / l);
    u = extreme_read(o, b, PERI_FIELD_DISPLACEMENT);
    n = peri_size_of_field(b, PERI_FIELD_DISPLACEMENT);
    if (u && !extreme_fails(o, b, peri_multiply_stiffness(b, u, u, n))) keep(r, "K u", u, n, s->stress * cube(s, c) / l);
    free(u);
    if (o->status == PERI_OK && !extreme_fails(o, b, peri_matrix_create(b, &matrix))) {
        double *entries = (double *)malloc((size_t)peri_matrix_entries(matrix) * sizeof *entries);
        if (entries && !extreme_fails(o, b, peri_get_matrix(matrix, NULL, NULL, entries)))
            keep(r, "K", entries, peri_matrix_entries(matrix), s->stress * cube(s, c) / (l * l));
        free(entries);
        peri_matrix_destroy(matrix);
    }
    return b;
}

typedef peri_body *(*act_fn)(outcome *o, const units *s, const scene *c, record *r);

/* Acts a scene in units s and compares with what it was in units of one. */
static void compare(outcome *o, const extreme *row, act_fn act, const units *s, const scene *c, const record *want) {
    record got = {{0}, {0}, {0}, 0, 0};
    const char *name;
    const outcome before = *o;
    double error;
    o->status = PERI_OK;
    *o = extreme_end(*o, act(o, s, c, &got));
    error = apart(want, &got, &name);
    extreme_note(o, row, c->precision, o->status == PERI_OK ? error : 0,
                 "%s; lengths %g, moduli %g, densities %g, thickness %g; space %d, geometry %d", name, s->length, s->stress, s->density,
                 s->thickness, (int)c->space, (int)c->geometry);
    if (before.status < 0) {
        o->status = before.status;
        o->field = before.field;
    }
    drop(&got);
}

/* Every length with every modulus and density; spaces and geometries take turns. choice: the law; value: criterion; other: 0 motion,
   1 equilibrium, 2 motion of clouds and weights of all kinds. */
static outcome every_unit(const extreme *row, int32_t precision) {
    static const double lengths[] = {1e-9, 1e-4, 1e6}, stresses[] = {1e-3, 1e5, 1e13}, densities[] = {1e-6, 1e2, 1e5};
    const act_fn act = row->other == 1 ? hold : pull;
    outcome o = {PERI_OK, "", 0};
    record want[6];
    int k;
    memset(want, 0, sizeof want);
    for (k = 0; k < 33 && o.status == PERI_OK; ++k) { /* but for motion of lattices: each pair of units, not each three */
        if (k >= 6 && row->other != 0 && (k + (k - 6) / 3 + (k - 6) / 9) % 3) continue;
        scene c = {PERI_SPACE_SOLID - k % 3, precision, row->choice, PERI_GEOMETRY_LINEAR - k / 3 % 2, (int32_t)row->value, 0, 0};
        const int at = k % 6;
        if (row->other == 2) c.source = 1 + at % 3;
        if (k < 6) {
            o = extreme_end(o, act(&o, &one, &c, &want[at]));
            if (row->other != 1 && (want[at].broken < 10 || want[at].broken > 2000))
                extreme_note(&o, row, precision, NAN, "%d bonds broke in units of one", (int)want[at].broken);
        } else {
            const int n = k - 6;
            units s = {lengths[n / 9], stresses[n / 3 % 3], densities[n % 3], 1};
            s.thickness = s.length;
            /* spaces change with k, densities with n: turned by the modulus, so that they meet in all ways */
            c.space = PERI_SPACE_PLANE_STRESS + (n + n / 3 + n / 9) % 3;
            c.geometry = PERI_GEOMETRY_NONLINEAR + n / 2 % 2;
            if (row->other == 2) c.source = 1 + PERI_SPACE_SOLID - c.space;
            compare(&o, row, act, &s, &c, &want[(PERI_SPACE_SOLID - c.space) + 3 * (PERI_GEOMETRY_LINEAR - c.geometry)]);
        }
    }
    for (k = 0; k < 6; ++k) drop(&want[k]);
    return o;
}

/* Powers of two, of which L sqrt(rho/E) is one, too. */
static outcome same_bits(const extreme *row, int32_t precision) {
    static const units two[3] = {{9.3132257461547852e-10, 1099511627776.0, 9.5367431640625e-7, 0.03125},
                                 {1048576.0, 0.0009765625, 65536.0, 4096.0},
                                 {7.8886090522101181e-31, 6.2230152778611417e-61, 6.2230152778611417e-61, 1.2621774483536189e-29}};
    outcome o = {PERI_OK, "", 0};
    int32_t law, space;
    for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law)
        for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space) {
            const scene c = {space, precision, law, PERI_GEOMETRY_NONLINEAR, PERI_CRITERION_STRETCH, 1, 0};
            const act_fn act = row->other == 0 ? pull : hold;
            record want = {{0}, {0}, {0}, 0, 0};
            int k;
            o = extreme_end(o, act(&o, &one, &c, &want));
            for (k = 0; k < 3 && o.status == PERI_OK; ++k) compare(&o, row, act, &two[k], &c, &want);
            drop(&want);
        }
    return o;
}

/* The thickness counts in energies, forces and momenta, and in nothing else. */
static outcome every_thickness(const extreme *row, int32_t precision) {
    static const double thick[] = {1e-9, 1e-3, 1e6};
    outcome o = {PERI_OK, "", 0};
    int32_t law, space;
    for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law)
        for (space = PERI_SPACE_PLANE_STRESS; space <= PERI_SPACE_PLANE_STRAIN; ++space) {
            const int by_energy = law != PERI_LAW_BOND_BASED && space == PERI_SPACE_PLANE_STRAIN;
            const int32_t criterion = by_energy ? PERI_CRITERION_BOND_ENERGY : PERI_CRITERION_STRETCH;
            const scene c = {space, precision, law, PERI_GEOMETRY_NONLINEAR, criterion, 0, 0};
            record want = {{0}, {0}, {0}, 0, 0};
            int k;
            o = extreme_end(o, pull(&o, &one, &c, &want));
            for (k = 0; k < 3 && o.status == PERI_OK; ++k) {
                units s = one;
                s.thickness = thick[k];
                compare(&o, row, pull, &s, &c, &want);
            }
            drop(&want);
        }
    return o;
}

/* Lengths, moduli and densities of all powers of ten^value, from ten^-other to ten^other: right, or refused by PERI_ERROR_RANGE. choice: 1
   = none may be refused. */
static outcome far_units(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    const int most = (int)(row->other / row->value + 0.5);
    record want[2][3];
    int k, a, e, d, space, right = 0;
    memset(want, 0, sizeof want);
    for (k = 0; k < 2; ++k)
        for (space = 0; space < 3; ++space) {
            const scene c = {PERI_SPACE_PLANE_STRESS + space, precision, k ? PERI_LAW_CORRESPONDENCE : PERI_LAW_BOND_BASED,
                             PERI_GEOMETRY_NONLINEAR, PERI_CRITERION_STRETCH, 0, 0};
            o = extreme_end(o, pull(&o, &one, &c, &want[k][space]));
        }
    for (a = -most; a <= most; ++a)
        for (e = -most; e <= most; ++e)
            for (d = -most; d <= most && o.status == PERI_OK; ++d) {
                const double ten = pow(10, row->value);
                const units s = {pow(ten, a), pow(ten, e), pow(ten, d), pow(ten, a)};
                scene c = {PERI_SPACE_PLANE_STRESS + (a + e + d + 3 * most) % 3, precision, 0, PERI_GEOMETRY_NONLINEAR,
                           PERI_CRITERION_STRETCH, 0, 0};
                k = (a + d + 2 * most) % 2;
                c.law = k ? PERI_LAW_CORRESPONDENCE : PERI_LAW_BOND_BASED;
                compare(&o, row, pull, &s, &c, &want[k][c.space - PERI_SPACE_PLANE_STRESS]);
                right += o.status == PERI_OK;
                if (o.status == PERI_ERROR_RANGE && !row->choice) o.status = PERI_OK;
                else if (o.status < 0)
                    printf("    refused: lengths %g, moduli %g, densities %g, %s\n", s.length, s.stress, s.density, o.field);
            }
    if (right < 1 && o.status == PERI_OK) o.error = NAN;
    for (k = 0; k < 2; ++k)
        for (space = 0; space < 3; ++space) drop(&want[k][space]);
    return o;
}

/* A body in units of which one is ten^value, choice: 0 length, 1 modulus, 2 density, 3 thickness; planes where other is 2. */
static outcome one_far_unit(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    units s = one;
    record r = {{0}, {0}, {0}, 0, 0};
    const scene c = {row->other == 2 ? PERI_SPACE_PLANE_STRAIN : PERI_SPACE_SOLID, precision, PERI_LAW_LPS, PERI_GEOMETRY_NONLINEAR,
                     PERI_CRITERION_STRETCH, 0, 0};
    double *const which[4] = {&s.length, &s.stress, &s.density, &s.thickness};
    *which[row->choice] = pow(10, row->value);
    o = extreme_end(o, pull(&o, &s, &c, &r));
    drop(&r);
    return o;
}

/* An estimate of a scene refuses what the body would refuse. */
static outcome planned_far(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    int k;
    for (k = 0; k < 3 * 41; ++k) {
        const double ten = pow(10, 15.0 * (k % 41 - 20)), l = k / 41 == 0 ? ten : 1;
        peri_body_desc d;
        peri_material_desc m;
        peri_plan_desc p;
        peri_plan_report report;
        peri_error error;
        peri_body *b = NULL;
        outcome built = {PERI_OK, "", 0};
        int i, same;
        extreme_desc(&d, PERI_SPACE_PLANE_STRESS + k % 3, precision, 2 * l);
        extreme_material(&m, PERI_LAW_LPS, 0.2, 0.1);
        if (k / 41 == 1) m.young = ten;
        if (k / 41 == 2) m.density = ten;
        peri_plan_desc_init(&p);
        p.body = &d;
        p.material = &m;
        p.spacing = l;
        for (i = 0; i < 3; ++i) p.hi[i] = 5 * l;
        if (!extreme_fails(&built, NULL, peri_body_create(&d, &b, NULL)) && !extreme_fails(&built, b, peri_add_material(b, &m))
            && !extreme_fails(&built, b, peri_add_box(b, material_id(b, 1), p.lo, p.hi, l)))
            (void)extreme_fails(&built, b, peri_build(b));
        same = peri_plan(&p, &report, &error) == built.status && strcmp(built.field, error.field) == 0;
        if (built.status == PERI_OK) /* a box without correction: exact (peri.h) */
            same = same && fabs(report.stable_step - peri_stable_step(b)) <= 1e-5 * peri_stable_step(b);
        extreme_note(&o, row, precision, same ? 0 : 1, "%g of kind %d, space %d: built %d %s, planned %d %s", ten, k / 41, d.space,
                     (int)built.status, built.field, (int)error.code, error.field);
        built = extreme_end(built, b);
        if (built.status == NOT_FINITE) o.status = NOT_FINITE;
    }
    return o;
}

/* Constants in the caller's units: value is the horizon, other the modulus; choice 1: the critical energy in place of the micromodulus. */
static outcome constants(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    const double h = row->value;
    peri_body_desc d;
    peri_material_desc m;
    peri_body *b = NULL;
    double got = 0, want;
    extreme_desc(&d, PERI_SPACE_SOLID, precision, h);
    extreme_material(&m, row->choice ? PERI_LAW_LPS : PERI_LAW_BOND_BASED, 0.25, 0);
    m.young = row->other;
    if (row->choice) {
        m.criterion = PERI_CRITERION_BOND_ENERGY;
        m.fracture_energy = row->other;
    }
    if (!extreme_fails(&o, NULL, peri_body_create(&d, &b, NULL)) && !extreme_fails(&o, b, peri_add_material(b, &m)))
        (void)extreme_fails(&o, b, row->choice ? peri_get_critical_energy(b, material_id(b, 1), &got)
                                               : peri_get_bond_constants(b, material_id(b, 1), material_id(b, 1), &got, NULL));
    /* c = 18 K/(pi h^4), K = E/1.5; w0 = 4 G0/(pi h^4) */
    want = (row->choice ? 4 * row->other : 12 * row->other) / 3.14159265358979323846 / h / h / h / h;
    if (o.status == PERI_OK) extreme_note(&o, row, precision, fabs(got / want - 1), "%g, not %g", got, want);
    return extreme_end(o, b);
}

/* A material that no point has, of a modulus and density beyond all others, and a bar of another. */
static outcome unused(const extreme *row, int32_t precision) {
    static const double far_[4] = {1e-300, 1e-100, 1e100, 1e300};
    outcome o = {PERI_OK, "", 0};
    double want = 0;
    int k;
    for (k = -1; k < 16 && o.status == PERI_OK; ++k) {
        const double lo[3] = {0, 0, 0}, hi[3] = {5, 4, 3}, ground[3] = {0, -1, 0}, up[3] = {0, 1, 0};
        peri_body_desc d;
        peri_material_desc m, other;
        peri_body *b = NULL;
        int32_t id = 0;
        extreme_desc(&d, PERI_SPACE_SOLID, precision, 2);
        extreme_material(&m, PERI_LAW_LPS, 0.3, 0.1);
        other = m;
        if (k >= 0) other.young = far_[k % 4];
        if (k >= 0) other.density = far_[k / 4];
        (void)extreme_fails(&o, NULL, peri_body_create(&d, &b, NULL));
        if (k >= 0) (void)extreme_fails(&o, b, peri_add_material(b, &other));
        id = peri_add_material(b, &m);
        (void)extreme_fails(&o, b, id);
        (void)extreme_fails(&o, b, peri_add_box(b, id, lo, hi, 1));
        if (!extreme_fails(&o, b, peri_build(b))) {
            (void)extreme_fails(&o, b, plane_obstacle(b, ground, up, 1, NULL, NULL));
            if (k < 0) want = peri_stable_step(b);
            extreme_note(&o, row, precision, fabs(peri_stable_step(b) / want - 1), "unused modulus %g, density %g", other.young,
                         other.density);
        } else
            printf("    unused modulus %g, density %g\n", other.young, other.density);
        o = extreme_end(o, b);
    }
    return o;
}

/* Obstacles told in lengths of value: the normal of a plane, or (choice 1) the radius of a ball and the distance of its centre, which
   touches the body in the same plane; choice 2: the place of the plane is that far to the side. */
static outcome obstacle(const extreme *row, int32_t precision) {
    const double size = row->value, lo[3] = {0, 0, 0}, hi[3] = {4, 4, 4}, up[3] = {0, row->choice ? 1 : size, 0};
    const double place[3] = {row->choice == 2 ? size : 0, 1.25, 0}, centre[3] = {2, 1.25 - size, 2};
    outcome o = {PERI_OK, "", 0};
    peri_body_desc d;
    peri_material_desc m;
    peri_body *b = NULL;
    int32_t id;
    double force[3];
    extreme_desc(&d, PERI_SPACE_SOLID, precision, 2);
    extreme_material(&m, PERI_LAW_BOND_BASED, 0, 0);
    (void)extreme_fails(&o, NULL, peri_body_create(&d, &b, NULL));
    (void)extreme_fails(&o, b, peri_add_material(b, &m));
    (void)extreme_fails(&o, b, peri_add_box(b, material_id(b, 1), lo, hi, 1));
    if (extreme_fails(&o, b, peri_build(b))) return extreme_end(o, b);
    id = row->choice == 1 ? ball_obstacle(b, centre, size, 2, NULL, NULL) : plane_obstacle(b, place, up, 2, NULL, NULL);
    if (!extreme_fails(&o, b, id) && !extreme_fails(&o, b, peri_get_obstacle_force(b, id, force, NULL)))
        /* one layer of 16 points is 0.75 deep: 2 * 0.75 * 16 = 24 */
        extreme_note(&o, row, precision, fabs(force[1] / 24 - 1) + fabs(force[0]) + fabs(force[2]), "force %g %g %g", force[0], force[1],
                     force[2]);
    return extreme_end(o, b);
}

/* Some 30 steps add up rounding twice, 30^2 units of 1.1e-16, of places that are 100 times the extensions and depths. Where bonds are in
   single precision the same data are the same floats, but for one in a million: one that is not leaves 6e-8 in each step. */
#define MOTION {1e-11, 6e-5, 6e-5}
/* Two equilibria of a residual of 1e-8, 1e-5, 1e-4, in a bar whose softest motion (bending) is 100 times softer than a bond. */
#define REST {2e-6, 2e-3, 2e-2}
#define NONE {0, 0, 0}
#define TRUTH "dimensional analysis: numbers over their units do not depend on the units"

static const extreme rows[] = {
    {"motion in all units, bond-based", TRUTH, every_unit, PERI_CRITERION_STRETCH, 0, PERI_LAW_BOND_BASED, PERI_OK, NULL, MOTION},
    {"motion in all units, LPS", TRUTH, every_unit, PERI_CRITERION_STRETCH, 0, PERI_LAW_LPS, PERI_OK, NULL, MOTION},
    {"motion in all units, Oterkus", TRUTH, every_unit, PERI_CRITERION_STRETCH, 0, PERI_LAW_OTERKUS, PERI_OK, NULL, MOTION},
    {"motion in all units, correspondence", TRUTH, every_unit, PERI_CRITERION_STRETCH, 0, PERI_LAW_CORRESPONDENCE, PERI_OK, NULL, MOTION},
    {"motion in all units, bonds break by energy", TRUTH, every_unit, PERI_CRITERION_BOND_ENERGY, 0, PERI_LAW_LPS, PERI_OK, NULL, MOTION},
    {"motion in all units, nodes break by energy", TRUTH, every_unit, PERI_CRITERION_NODE_ENERGY, 0, PERI_LAW_CORRESPONDENCE, PERI_OK,
     NULL, MOTION},
    {"motion in all units, clouds and weights, LPS", TRUTH, every_unit, PERI_CRITERION_STRETCH, 2, PERI_LAW_LPS, PERI_OK, NULL, MOTION},
    {"motion in all units, clouds and weights, correspondence", TRUTH, every_unit, PERI_CRITERION_STRETCH, 2, PERI_LAW_CORRESPONDENCE,
     PERI_OK, NULL, MOTION},
    {"equilibrium in all units, bond-based", TRUTH, every_unit, PERI_CRITERION_STRETCH, 1, PERI_LAW_BOND_BASED, PERI_OK, NULL, REST},
    {"equilibrium in all units, LPS", TRUTH, every_unit, PERI_CRITERION_STRETCH, 1, PERI_LAW_LPS, PERI_OK, NULL, REST},
    {"equilibrium in all units, Oterkus", TRUTH, every_unit, PERI_CRITERION_STRETCH, 1, PERI_LAW_OTERKUS, PERI_OK, NULL, REST},
    {"equilibrium in all units, correspondence", TRUTH, every_unit, PERI_CRITERION_STRETCH, 1, PERI_LAW_CORRESPONDENCE, PERI_OK, NULL,
     REST},
    {"motion in powers of two", "such scaling rounds nothing: the same bits", same_bits, 0, 0, 0, PERI_OK, NULL, NONE},
    {"equilibrium in powers of two", "such scaling rounds nothing: the same bits", same_bits, 0, 1, 0, PERI_OK, NULL, NONE},
    {"plates of any thickness", "energies, forces, momenta by thickness; motion the same", every_thickness, 0, 0, 0, PERI_OK, NULL, MOTION},
    {"units of 1e-30 to 1e30", TRUTH, far_units, 30, 30, 1, PERI_OK, NULL, MOTION},
    {"units of 1e-300 to 1e300", "right, or refused by name", far_units, 100, 300, 0, PERI_OK, NULL, MOTION},
    {"units of 1e-240 to 1e240", "right, or refused by name", far_units, 60, 240, 0, PERI_OK, NULL, MOTION},
    {"lengths of 1e-300", "cells below double", one_far_unit, -300, 0, 0, PERI_ERROR_RANGE, "spacing", NONE},
    {"lengths of 1e300", "cells beyond double", one_far_unit, 300, 0, 0, PERI_ERROR_RANGE, "spacing", NONE},
    {"lengths of 1e-105", "cells of 1e-315, which have lost digits", one_far_unit, -105, 0, 0, PERI_ERROR_RANGE, NULL, NONE},
    {"lengths of 1e102", "energies of 1e306, times what 84 cells hold", one_far_unit, 102, 0, 0, PERI_ERROR_RANGE, NULL, NONE},
    {"plane, lengths of 1e-200", "cells below double", one_far_unit, -200, 2, 0, PERI_ERROR_RANGE, "spacing", NONE},
    {"moduli of 1e-300", "energies below double", one_far_unit, -300, 0, 1, PERI_ERROR_RANGE, NULL, NONE},
    {"moduli of 1e300", "energies beyond double", one_far_unit, 300, 0, 1, PERI_ERROR_RANGE, NULL, NONE},
    {"densities of 1e-300", "momenta below double", one_far_unit, -300, 0, 2, PERI_ERROR_RANGE, NULL, NONE},
    {"densities of 1e300", "momenta beyond double", one_far_unit, 300, 0, 2, PERI_ERROR_RANGE, NULL, NONE},
    {"plates 1e-300 thick", "energies below double", one_far_unit, -300, 2, 3, PERI_ERROR_RANGE, NULL, NONE},
    {"plates 1e300 thick", "energies beyond double", one_far_unit, 300, 2, 3, PERI_ERROR_RANGE, NULL, NONE},
    {"planned in units of 1e-300 to 1e300", "peri.h: refuses what the build refuses, by the same codes and fields", planned_far, 0, 0, 0,
     PERI_OK, NULL, NONE},
    {"micromodulus, horizon 1e-9", "12 E/(pi h^4)", constants, 1e-9, 1e13, 0, PERI_OK, NULL, {1e-14, 1e-14, 1e-14}},
    {"micromodulus, horizon 1e70", "12 E/(pi h^4)", constants, 1e70, 1e13, 0, PERI_OK, NULL, {1e-14, 1e-14, 1e-14}},
    {"micromodulus, horizon 1e-80", "beyond double", constants, 1e-80, 1, 0, PERI_ERROR_RANGE, NULL, NONE},
    {"micromodulus, horizon 1e80", "below double", constants, 1e80, 1, 0, PERI_ERROR_RANGE, NULL, NONE},
    {"critical energy, horizon 1e-9", "4 G0/(pi h^4)", constants, 1e-9, 1, 1, PERI_OK, NULL, {1e-14, 1e-14, 1e-14}},
    {"critical energy, horizon 1e-80", "beyond double", constants, 1e-80, 1, 1, PERI_ERROR_RANGE, NULL, NONE},
    {"critical energy, horizon 1e80", "below double", constants, 1e80, 1, 1, PERI_ERROR_RANGE, NULL, NONE},
    {"a material that no point has, of any numbers", "what no point has acts nowhere", unused, 0, 0, 0, PERI_OK, NULL, {1e-12, 1e-6, 1e-6}},
    {"plane obstacle, normal of 1e-200", "only its direction counts", obstacle, 1e-200, 0, 0, PERI_OK, NULL, {1e-15, 1e-15, 1e-15}},
    {"plane obstacle, normal of 1e200", "only its direction counts", obstacle, 1e200, 0, 0, PERI_OK, NULL, {1e-15, 1e-15, 1e-15}},
    {"plane obstacle, placed 1e200 to the side", "the plane is the same", obstacle, 1e200, 0, 2, PERI_OK, NULL, {1e-15, 1e-15, 1e-15}},
    {"ball obstacle as large as 1e5", "a plane but for 4.5/(2 radius) of the depth 0.75", obstacle, 1e5, 0, 1, PERI_OK, NULL,
     {3e-5, 3e-5, 3e-5}},
    {"ball obstacle as large as 1e300", "its surface is lost in rounding", obstacle, 1e300, 0, 1, PERI_ERROR_RANGE, NULL, NONE},
};
const extreme_table extreme_units = EXTREME_TABLE("units", rows);
