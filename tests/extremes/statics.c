/* SPDX-License-Identifier: MIT */
/* statics.c - equilibria against closed forms: chains of springs, weak links, loads and load factors at their limits, refused numbers. */
#include "extremes.h"

#define PI 3.14159265358979323846
#define LINKS 12

static double default_tolerance(int32_t precision) {
    return precision == PERI_PRECISION_DOUBLE ? 1e-8 : precision == PERI_PRECISION_MIXED ? 1e-5 : 1e-4;
}

static peri_body *empty_of(outcome *o, int32_t precision, int32_t space, int32_t geometry, double horizon) {
    peri_body_desc d;
    peri_body *b = NULL;
    extreme_desc(&d, space, precision, horizon);
    d.geometry = geometry;
    (void)extreme_fails(o, NULL, peri_body_create(&d, &b, NULL));
    return b;
}

static int32_t code_of(const peri_body *b, peri_error *e) {
    memset(e, 0, sizeof *e);
    return peri_get_error(b, e) == PERI_OK ? e->code : PERI_OK;
}

/* ---- chains ------------------------------------------------------------------------------------------------------- */

/* A row of points a unit apart, horizon 1.5, moving along x only, the first one held: springs in series. Bonds among the first half are of
   stiffness first*c V^2, the others second*c, that between the halves of `middle`, or the harmonic mean of both where that is 0. */
static peri_body *chain(outcome *o, int32_t precision, double first, double second, double middle) {
    const double zero[3] = {0, 0, 0}, one[3] = {0.5, 0, 0};
    double x[3 * LINKS] = {0}, v[LINKS];
    int32_t of[LINKS];
    peri_material_desc m;
    peri_body *b = empty_of(o, precision, PERI_SPACE_SOLID, PERI_GEOMETRY_LINEAR, 1.5);
    int k;
    extreme_material(&m, PERI_LAW_BOND_BASED, 0, 0);
    for (k = 0; k < LINKS; ++k) {
        x[3 * k] = k;
        v[k] = 1;
    }
    m.young = first;
    if (o->status < 0 || extreme_fails(o, b, peri_add_material(b, &m))) return b;
    m.young = second;
    if (extreme_fails(o, b, peri_add_material(b, &m))) return b;
    for (k = 0; k < LINKS; ++k) of[k] = material_id(b, k < LINKS / 2 ? 1 : 2);
    m.young = middle;
    if (middle > 0 && extreme_fails(o, b, peri_set_interface(b, material_id(b, 1), material_id(b, 2), &m))) return b;
    if (extreme_fails(o, b, peri_add_points(b, LINKS, x, v, of)) || extreme_fails(o, b, peri_build(b))) return b;
    (void)extreme_fails(o, b, peri_prescribe_displacement(b, PERI_ALL, PERI_AXIS_Y | PERI_AXIS_Z, zero, NULL, NULL));
    (void)extreme_fails(o, b, peri_prescribe_displacement(b, peri_select_box(b, NULL, zero, one), PERI_AXIS_X, zero, NULL, NULL));
    return b;
}

/* Displacement of point k under a force F at the end: F times the sum of compliances. c = 12 E/(pi h^4), unit volumes. */
static double chain_moves(int k, double force, double first, double second, double middle) {
    const double spring = 12 / (PI * pow(1.5, 4)), between = middle > 0 ? middle : 2 / (1 / first + 1 / second);
    double sum = 0;
    int link;
    for (link = 1; link <= k; ++link) sum += 1 / (link < LINKS / 2 ? first : link > LINKS / 2 ? second : between);
    return force / spring * sum;
}

/* Each elongation is off by the residuals beyond it, at most sqrt(n) of their norm: the displacements, too, as part of themselves. */
static void compare_chain(outcome *o, peri_body *b, double force, const extreme *row, double middle, int method, int preconditioner) {
    double *u = extreme_read(o, b, PERI_FIELD_DISPLACEMENT), *r = extreme_read(o, b, PERI_FIELD_REACTION);
    int k;
    for (k = 1; u && k < LINKS; ++k) {
        const double want = chain_moves(k, force, row->value, row->other, middle);
        extreme_take(o, fabs(u[3 * k] / want - 1), "point, method, preconditioner", k, method, preconditioner);
    }
    if (r) extreme_take(o, fabs(r[0] / force + 1), "reaction, method, preconditioner", 0, method, preconditioner);
    free(u);
    free(r);
}

typedef enum reach { WITHIN, WITHIN_IN_DOUBLE, BEYOND } reach;

static void pull_chain(outcome *o, int32_t precision, const extreme *row, double middle, double tolerance, int beyond, int method,
                       int pre) {
    const double lo[3] = {LINKS - 1.5, 0, 0}, hi[3] = {LINKS, 0, 0}, force[3] = {0.125, 0, 0};
    peri_body *b = chain(o, precision, row->value, row->other, middle);
    peri_solve_desc s;
    peri_error e;
    int32_t code;
    if (o->status >= 0) {
        (void)extreme_fails(o, b, peri_apply_body_force(b, peri_select_box(b, NULL, lo, hi), force, NULL, NULL));
        peri_solve_desc_init(&s);
        s.tolerance = tolerance;
        s.method = method;
        s.preconditioner = pre;
        code = peri_solve(b, &s, NULL);
        if (!beyond) (void)extreme_fails(o, b, code);
        else if (code != PERI_ERROR_CONVERGENCE || code_of(b, &e) != code || !(e.value > default_tolerance(precision)))
            extreme_take(o, HUGE_VAL, "status, method, preconditioner", code, method, pre);
        if (!beyond || (precision != PERI_PRECISION_SINGLE && method == PERI_METHOD_NEWTON))
            compare_chain(o, b, force[0], row, middle, method, pre);
    }
    *o = extreme_end(*o, b);
}

static outcome series(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    const int beyond = row->choice == BEYOND || (row->choice == WITHIN_IN_DOUBLE && precision == PERI_PRECISION_SINGLE);
    const double tolerance = row->choice == WITHIN_IN_DOUBLE && !beyond ? 1e-4 : 0;
    int pre;
    for (pre = PERI_PRECONDITIONER_MULTILEVEL; pre <= PERI_PRECONDITIONER_NONE && o.status >= 0; ++pre)
        pull_chain(&o, precision, row, 0, tolerance, beyond, PERI_METHOD_NEWTON, pre);
    if (o.status >= 0) pull_chain(&o, precision, row, 0, tolerance, beyond, PERI_METHOD_BICGSTAB, PERI_PRECONDITIONER_MULTILEVEL);
    return o;
}

/* One link of row->other times the others' stiffness in the middle. */
static outcome weak_link(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    extreme plain = *row;
    int pre;
    plain.value = plain.other = 1;
    for (pre = PERI_PRECONDITIONER_MULTILEVEL; pre <= PERI_PRECONDITIONER_NONE && o.status >= 0; ++pre)
        pull_chain(&o, precision, &plain, row->other, precision == PERI_PRECISION_SINGLE ? 0 : 1e-4, precision == PERI_PRECISION_SINGLE,
                   PERI_METHOD_NEWTON, pre);
    return o;
}

static outcome relaxed(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    pull_chain(&o, precision, row, 0, 0, 0, PERI_METHOD_RELAXATION, PERI_PRECONDITIONER_MULTILEVEL);
    return o;
}

/* ---- plates ------------------------------------------------------------------------------------------------------- */

/* A box of cells of unit size, held at its first two layers in x, or not at all. */
static peri_body *plate(outcome *o, int32_t precision, int32_t space, int32_t law, int32_t geometry, int held) {
    const double lo[3] = {0, 0, 0}, hi[3] = {6, 4, space == PERI_SPACE_SOLID ? 3 : 1}, grip[3] = {2, 4, 3};
    peri_material_desc m;
    peri_body *b = empty_of(o, precision, space, geometry, 2.2);
    extreme_material(&m, law, 0.3, 0);
    if (o->status < 0 || extreme_fails(o, b, peri_add_material(b, &m)) || extreme_fails(o, b, peri_add_box(b, material_id(b, 1), lo, hi, 1))
        || extreme_fails(o, b, peri_build(b)) || !held)
        return b;
    (void)extreme_fails(o, b,
                        peri_prescribe_displacement(b, peri_select_box(b, NULL, lo, grip),
                                                    space == PERI_SPACE_SOLID ? PERI_AXIS_XYZ : PERI_AXIS_XY, NULL, NULL, NULL));
    return b;
}

static int32_t load_plate(outcome *o, peri_body *b, double size) {
    const double lo[3] = {5, 0, 0}, hi[3] = {6, 4, 3};
    double force[3];
    int32_t load = -1;
    force[0] = size;
    force[1] = -0.5 * size;
    force[2] = 0.25 * size;
    if (o->status < 0) return load;
    load = peri_apply_body_force(b, peri_select_box(b, NULL, lo, hi), force, NULL, NULL);
    (void)extreme_fails(o, b, load);
    return load;
}

/* |u/scale - v| over |v|; scale 0: |u| over |v|. */
static double apart(const double *u, double scale, const double *v, int64_t n) {
    double off = 0, size = 0;
    int64_t k;
    for (k = 0; k < n; ++k) {
        const double d = scale != 0 ? u[k] / scale - v[k] : u[k];
        off += d * d;
        size += v[k] * v[k];
    }
    return sqrt(off / size);
}

typedef void (*each_fn)(outcome *o, const extreme *row, int32_t precision, int32_t space, int32_t law);
static outcome each(const extreme *row, int32_t precision, each_fn one) {
    outcome o = {PERI_OK, "", 0};
    int32_t space, law;
    for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
        for (law = PERI_LAW_BOND_BASED; law < peri__end_law && o.status >= 0; ++law) one(&o, row, precision, space, law);
    return o;
}

/* The answer to a load of 1e-3, linear, to 1e-12 in double. */
static double *reference(outcome *o, int32_t space, int32_t law) {
    peri_body *b = plate(o, PERI_PRECISION_DOUBLE, space, law, PERI_GEOMETRY_LINEAR, 1);
    peri_solve_desc s;
    double *u = NULL;
    peri_solve_desc_init(&s);
    s.tolerance = 1e-12;
    (void)load_plate(o, b, 1e-3);
    if (o->status >= 0 && !extreme_fails(o, b, peri_solve(b, &s, NULL))) u = extreme_read(o, b, PERI_FIELD_DISPLACEMENT);
    *o = extreme_end(*o, b);
    return u;
}

/* Loads of row->value times the reference's; choice: geometry. The load is near the softest mode: |K^-1| |f| is within 10 |u|. */
static void scale_one(outcome *o, const extreme *row, int32_t precision, int32_t space, int32_t law) {
    double *want = reference(o, space, law), *u = NULL;
    peri_body *b = plate(o, precision, space, law, row->choice, 1);
    peri_solve_desc s;
    peri_solve_desc_init(&s);
    (void)load_plate(o, b, 1e-3 * row->value);
    if (o->status >= 0 && !extreme_fails(o, b, peri_solve(b, &s, NULL))) u = extreme_read(o, b, PERI_FIELD_DISPLACEMENT);
    if (u && want) extreme_take(o, apart(u, row->value, want, peri_size_of_field(b, PERI_FIELD_DISPLACEMENT)), "space, law", space, law, 0);
    free(u);
    free(want);
    *o = extreme_end(*o, b);
}
static outcome scaled(const extreme *row, int32_t precision) { return each(row, precision, scale_one); }

/* A load, or where choice is 1 a prescribed displacement, of row->value: an equilibrium, or a status that says that there is none. */
static void heavy_one(outcome *o, const extreme *row, int32_t precision, int32_t space, int32_t law) {
    const double lo[3] = {5, 0, 0}, hi[3] = {6, 4, 3}, far[3] = {row->value, 0, 0};
    int32_t geometry, code;
    for (geometry = PERI_GEOMETRY_NONLINEAR; geometry < peri__end_geometry && o->status >= 0; ++geometry) {
        peri_body *b = plate(o, precision, space, law, geometry, 1);
        peri_solve_desc s;
        peri_solve_desc_init(&s);
        s.iterations = 500;
        s.newton = 10;
        s.halvings = 1;
        if (row->choice == 0) (void)load_plate(o, b, row->value);
        else if (o->status >= 0)
            (void)extreme_fails(o, b, peri_prescribe_displacement(b, peri_select_box(b, NULL, lo, hi), PERI_AXIS_X, far, NULL, NULL));
        if (o->status >= 0) {
            code = peri_solve(b, &s, NULL);
            if (code == PERI_OK && row->choice == 0) { /* free points feel no force; |loads| = 12 row->value or less */
                double *f = extreme_read(o, b, PERI_FIELD_FORCE_DENSITY);
                int64_t k;
                for (k = 0; f && k < peri_size_of_field(b, PERI_FIELD_FORCE_DENSITY); ++k)
                    extreme_take(o, fabs(f[k]) / (20 * row->value * default_tolerance(precision)), "residual, space, law, geometry", space,
                                 law, geometry);
                free(f);
            } else if (code != PERI_OK && code != PERI_ERROR_CONVERGENCE && code != PERI_ERROR_INDEFINITE && code != PERI_ERROR_RANGE)
                extreme_take(o, HUGE_VAL, "status, space, law", -code, space, law);
            if (code != PERI_OK) (void)extreme_fails(o, b, peri_reset(b));
        }
        *o = extreme_end(*o, b);
        if (o->status < 0 && o->field[0] == 0)
            o->field = law == PERI_LAW_BOND_BASED ? "bond-based" : law == PERI_LAW_LPS ? "LPS" : "other law";
    }
}
static outcome heavy(const extreme *row, int32_t precision) { return each(row, precision, heavy_one); }

/* No load: no displacement, in no iteration. other > 0: from displacements of that size, back to nothing: as near as the rounding of
   forces, 2 to 4 u |K| |u|, is over |K^-1|: 500 times that, the condition of these plates. */
static void idle_one(outcome *o, const extreme *row, int32_t precision, int32_t space, int32_t law) {
    int method;
    for (method = PERI_METHOD_NEWTON; method <= PERI_METHOD_RELAXATION && o->status >= 0; ++method) {
        peri_body *b = plate(o, precision, space, law, PERI_GEOMETRY_LINEAR, 1);
        const int64_t n = o->status < 0 ? 0 : peri_size_of_field(b, PERI_FIELD_DISPLACEMENT);
        double *start = (double *)calloc((size_t)n + 1, sizeof *start), *u = NULL;
        peri_solve_report r;
        peri_solve_desc s;
        uint64_t seed = 9;
        int64_t k;
        memset(&r, 0, sizeof r);
        peri_solve_desc_init(&s);
        s.method = method;
        for (k = 0; k < n; ++k) start[k] = row->other * (2 * test_random(&seed) - 1);
        if (row->other > 0) (void)extreme_fails(o, b, peri_set_field(b, PERI_FIELD_DISPLACEMENT, start, n));
        if (o->status >= 0 && !extreme_fails(o, b, peri_solve(b, &s, &r))) u = extreme_read(o, b, PERI_FIELD_DISPLACEMENT);
        for (k = 0; u && k < n && row->other == 0; ++k) extreme_take(o, fabs(u[k]), "space, law, method", space, law, method);
        if (row->other == 0 && r.iterations != 0) extreme_take(o, 1, "iterations, space, law, method", space, law, method);
        if (u && row->other > 0) extreme_take(o, apart(u, 0, start, n), "space, law, method", space, law, method);
        free(u);
        free(start);
        *o = extreme_end(*o, b);
    }
}
static outcome idle(const extreme *row, int32_t precision) { return each(row, precision, idle_one); }

/* u = G x everywhere. */
static int32_t affine_value(void *user, double time, int64_t count, const int32_t *points, double *value) {
    const double *x = (const double *)user;
    const int dim = (int)x[0];
    int64_t k;
    int d;
    for (k = 0; k < count; ++k)
        for (d = 0; d < dim; ++d) value[k * dim + d] = time * (0.01 * x[1 + points[k] * dim + d] + 0.003 * x[1 + points[k] * dim]);
    return 0;
}

/* All is held, by displacements (choice 0) or velocities (1): reactions are what a free body would feel there, less the loads, and balance
   them. Each is a sum of some 40 bonds. */
static void held_one(outcome *o, const extreme *row, int32_t precision, int32_t space, int32_t law) {
    peri_body *b = plate(o, precision, space, law, PERI_GEOMETRY_NONLINEAR, 0),
        *free_body = plate(o, precision, space, law, PERI_GEOMETRY_NONLINEAR, 0);
    const int dim = space == PERI_SPACE_SOLID ? 3 : 2;
    const int64_t n = o->status < 0 ? 0 : peri_size_of_field(b, PERI_FIELD_POSITION);
    double *x = (double *)calloc((size_t)n + 2, sizeof *x), *u = NULL, *r = NULL, *f = NULL;
    peri_solve_report report;
    peri_solve_desc s;
    int64_t k;
    peri_solve_desc_init(&s);
    x[0] = dim;
    if (o->status >= 0) {
        const int32_t axes = PERI_AXIS_XY | (dim == 3 ? PERI_AXIS_Z : 0);
        (void)extreme_fails(o, b, peri_get_field(b, PERI_FIELD_POSITION, x + 1, n));
        if (row->choice == 0) (void)extreme_fails(o, b, peri_prescribe_displacement(b, PERI_ALL, axes, NULL, affine_value, x));
        else (void)extreme_fails(o, b, peri_prescribe_velocity(b, PERI_ALL, axes, NULL, NULL, NULL));
    }
    (void)load_plate(o, b, 1e-3);
    (void)load_plate(o, free_body, 1e-3);
    if (o->status >= 0 && !extreme_fails(o, b, peri_solve(b, &s, &report))) {
        u = extreme_read(o, b, PERI_FIELD_DISPLACEMENT);
        r = extreme_read(o, b, PERI_FIELD_REACTION);
        if (report.iterations != 0) extreme_take(o, HUGE_VAL, "iterations, space, law", space, law, 0);
        if (u) (void)extreme_fails(o, free_body, peri_set_field(free_body, PERI_FIELD_DISPLACEMENT, u, n));
        if (u) f = extreme_read(o, free_body, PERI_FIELD_FORCE_DENSITY);
        for (k = 0; u && k < n; ++k) {
            const double want = row->choice ? 0 : 0.01 * x[1 + k] + 0.003 * x[1 + k / dim * dim];
            extreme_take(o, fabs(u[k] - want) / 0.1, "displacement, space, law", space, law, 0);
        }
        for (k = 0; f && r && k < n; ++k) extreme_take(o, fabs(f[k] + r[k]) / 0.01, "reaction, space, law", space, law, 0);
    }
    free(x);
    free(u);
    free(r);
    free(f);
    *o = extreme_end(*o, free_body);
    *o = extreme_end(*o, b);
}
static outcome all_held(const extreme *row, int32_t precision) { return each(row, precision, held_one); }

/* ---- load factors ------------------------------------------------------------------------------------------------- */

/* Linear: u = factor u(1), whatever way it was come by. From row->value to row->other in choice steps, from the equilibrium there. */
static void factor_one(outcome *o, const extreme *row, int32_t precision, int32_t space, int32_t law) {
    double *want = reference(o, space, law), *u = NULL;
    peri_body *b = plate(o, precision, space, law, PERI_GEOMETRY_LINEAR, 1);
    peri_solve_report r;
    peri_solve_desc s;
    peri_solve_desc_init(&s);
    s.load_to = row->value;
    (void)load_plate(o, b, 1e-3);
    if (o->status >= 0) (void)extreme_fails(o, b, peri_solve(b, &s, NULL));
    s.load_from = row->value;
    s.load_to = row->other;
    s.steps = row->choice;
    if (o->status >= 0 && !extreme_fails(o, b, peri_solve(b, &s, &r))) u = extreme_read(o, b, PERI_FIELD_DISPLACEMENT);
    if (u && (r.load_factor != row->other || r.steps != row->choice)) extreme_take(o, HUGE_VAL, "steps", space, law, 0);
    if (u && want) extreme_take(o, apart(u, row->other, want, peri_size_of_field(b, PERI_FIELD_DISPLACEMENT)), "space, law", space, law, 0);
    free(u);
    free(want);
    *o = extreme_end(*o, b);
}
static outcome factors(const extreme *row, int32_t precision) { return each(row, precision, factor_one); }

/* ---- numbers of a solve ------------------------------------------------------------------------------------------- */

typedef enum number {
    TOLERANCE, ENERGY, ITERATIONS, NEWTON_MOST, BREAKS, FROM, TO, LOAD_STEPS, HALVINGS, CRITICALITY, CURVE, ROWS, METHOD, PRE, LOOSE
} number;

/* One number of row->choice is row->value. Where it is refused nothing has moved. */
static outcome number_of(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    const double start[2] = {0.001, 0.002};
    const int64_t whole = fabs(row->value) < 9e18 ? (int64_t)row->value : row->value < 0 ? INT64_MIN : INT64_MAX;
    const int32_t small = (int32_t)(row->choice >= CURVE || row->choice == METHOD ? whole : 0);
    peri_body *b = plate(&o, precision, PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, PERI_GEOMETRY_LINEAR, 1);
    double *u = NULL, *want = reference(&o, PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS);
    peri_solve_desc s;
    int64_t k;
    int32_t code;
    peri_solve_desc_init(&s);
    if (row->choice == TOLERANCE) s.tolerance = row->value;
    if (row->choice == ENERGY) s.energy_tolerance = row->value;
    if (row->choice == ITERATIONS) s.iterations = whole;
    if (row->choice == NEWTON_MOST) s.newton = whole;
    if (row->choice == BREAKS) s.breaks = whole;
    if (row->choice == FROM) s.load_from = row->value;
    if (row->choice == TO) s.load_to = row->value;
    if (row->choice == LOAD_STEPS) s.steps = whole;
    if (row->choice == HALVINGS) s.halvings = whole;
    if (row->choice == CRITICALITY) s.criticality = row->value;
    if (row->choice == CURVE) s.curve_load = small;
    if (row->choice == ROWS) s.curve_rows = whole;
    if (row->choice == METHOD) s.method = small;
    if (row->choice == PRE) s.preconditioner = small;
    if (row->choice == LOOSE) s.loose = small;
    (void)load_plate(&o, b, 1e-3);
    if (o.status >= 0) (void)extreme_fails(&o, b, peri_add_displacement(b, PERI_ALL, start));
    if (o.status >= 0) {
        code = peri_solve(b, &s, NULL);
        u = extreme_read(&o, b, PERI_FIELD_DISPLACEMENT);
        for (k = 0; u && k < peri_size_of_field(b, PERI_FIELD_DISPLACEMENT) && code < 0 && code != PERI_ERROR_CONVERGENCE; ++k)
            if (fabs(u[k] - start[k % 2]) > 1e-9) o.error = 1;
        if (u && want && code >= 0) extreme_take(&o, apart(u, 1, want, peri_size_of_field(b, PERI_FIELD_DISPLACEMENT)), "", 0, 0, 0);
        if (o.error == 0 || code >= 0) (void)extreme_fails(&o, b, code);
    }
    free(u);
    free(want);
    return extreme_end(o, b);
}

/* A tolerance out of reach: PERI_ERROR_CONVERGENCE, and what is there is as good as the precision has. value: the tolerance. */
static void limit_one(outcome *o, const extreme *row, int32_t precision, int32_t space, int32_t law) {
    double *want = reference(o, space, law), *u = NULL;
    int32_t geometry, method;
    for (geometry = PERI_GEOMETRY_NONLINEAR; geometry < peri__end_geometry; ++geometry)
        for (method = PERI_METHOD_NEWTON; method <= PERI_METHOD_BICGSTAB && o->status >= 0; ++method) {
            peri_body *b = plate(o, precision, space, law, geometry, 1);
            const double size = geometry == PERI_GEOMETRY_LINEAR ? 1e-3 : 1e-16; /* where both geometries agree */
            peri_solve_desc s;
            peri_error e;
            peri_solve_desc_init(&s);
            s.tolerance = row->value;
            s.method = method;
            s.iterations = 200;
            s.halvings = 0; /* else what is left is a smaller load's */
            (void)load_plate(o, b, size);
            if (o->status >= 0) {
                const int32_t code = peri_solve(b, &s, NULL);
                if (code != PERI_ERROR_CONVERGENCE || code_of(b, &e) != code || !(e.value > row->value))
                    extreme_take(o, HUGE_VAL, "status, space, law", -code, space, law);
                u = extreme_read(o, b, PERI_FIELD_DISPLACEMENT);
                if (u && want)
                    extreme_take(o, apart(u, size / 1e-3, want, peri_size_of_field(b, PERI_FIELD_DISPLACEMENT)),
                                 "space, law, geometry*10+method",
                                 space, law, geometry * 10 + method);
                free(u);
            }
            *o = extreme_end(*o, b);
        }
    free(want);
}
static outcome limit(const extreme *row, int32_t precision) { return each(row, precision, limit_one); }

static int32_t stop_iteration(void *user, int64_t iteration, double residual) {
    int64_t *left = (int64_t *)user;
    (void)iteration;
    (void)residual;
    return --*left <= 0;
}

static int32_t stop_step(void *user, peri_body *b) {
    (void)b;
    return stop_iteration(user, 0, 0);
}

/* Stopped at the row->choice-th iteration, or at the first load step of two; then on, to the same end. */
static void stop_one(outcome *o, const extreme *row, int32_t precision, int32_t space, int32_t law) {
    double *want = reference(o, space, law), *u = NULL;
    int method, at_step;
    for (method = PERI_METHOD_NEWTON; method < peri__end_method; ++method)
        for (at_step = 0; at_step < 2 && o->status >= 0; ++at_step) {
            peri_body *b = plate(o, precision, space, law, PERI_GEOMETRY_LINEAR, 1);
            peri_solve_report r;
            peri_solve_desc s;
            int64_t left = row->choice;
            int32_t code;
            peri_solve_desc_init(&s);
            s.method = method;
            s.user = &left;
            s.steps = 2;
            if (at_step) s.on_step = stop_step;
            else s.on_iteration = stop_iteration;
            if (at_step) left = 1;
            (void)load_plate(o, b, 1e-3);
            if (o->status < 0) return;
            code = peri_solve(b, &s, &r);
            if (code != PERI_STOPPED || r.steps != at_step || r.load_factor != 0.5 * at_step || (!at_step && r.iterations != row->choice))
                extreme_take(o, HUGE_VAL, "stopped, space, law, method", space, law, method);
            s.on_step = NULL;
            s.on_iteration = NULL;
            s.load_from = r.load_factor;
            s.steps = 1;
            if (!extreme_fails(o, b, peri_solve(b, &s, &r))) u = extreme_read(o, b, PERI_FIELD_DISPLACEMENT);
            if (u) extreme_take(o, apart(u, 1, want, peri_size_of_field(b, PERI_FIELD_DISPLACEMENT)), "space, law, method", space, law,
                                method);
            free(u);
            u = NULL;
            *o = extreme_end(*o, b);
        }
    free(want);
}
static outcome stopped(const extreme *row, int32_t precision) { return each(row, precision, stop_one); }

/* ---- rows --------------------------------------------------------------------------------------------------------- */

#define SERIES "springs in series: the sum of compliances, c = 12 E/(pi h^4), harmonic means between materials"
#define OUT_OF_REACH "; rounding of displacements times the stiff springs is beyond the tolerance: PERI_ERROR_CONVERGENCE"
#define SCALING "a linear body scales: the answer to 1e-3, to 1e-12, times the load; small loads are linear in any geometry"
#define REFUSED "peri.h: the range of the field"
/* sqrt(12) tolerances and 30 roundings; 10 tolerances of a plate */
#define CHAIN {3.5e-8, 3.7e-5, 3.6e-4}
#define PLATE {1e-7, 1e-4, 1e-3}
#define NONE {0, 0, 0}

static const extreme rows[] = {
    {"chain of equal springs", SERIES, series, 1, 1, WITHIN, PERI_OK, NULL, CHAIN},
    {"chain of equal springs, relaxation", SERIES, relaxed, 1, 1, 0, PERI_OK, NULL, CHAIN},
    {"stiffness 1 : 1e-9 from the grip", SERIES, series, 1, 1e-9, WITHIN, PERI_OK, NULL, CHAIN},
    {"stiffness 1 : 1e-12 from the grip", SERIES, series, 1, 1e-12, WITHIN, PERI_OK, NULL, CHAIN},
    {"stiffness 1e-9 : 1 from the grip, tolerance 1e-4", SERIES OUT_OF_REACH " in single precision", series, 1e-9, 1, WITHIN_IN_DOUBLE,
     PERI_OK, NULL, {3.5e-4, 3.5e-4, 3.5e-4}},
    /* 2^-53 u times the stiff springs, of 1.3e-3 and 1.3 loads, sqrt(12) of that, u six links long: and as much again */
    {"stiffness 1e-12 : 1 from the grip", SERIES OUT_OF_REACH, series, 1e-12, 1, BEYOND, PERI_OK, NULL, {1e-2, 1e-2, 0}},
    {"stiffness 1e-15 : 1 from the grip", SERIES OUT_OF_REACH, series, 1e-15, 1, BEYOND, PERI_OK, NULL, {10, 10, 0}},
    {"a link of 1e-9 in a chain, tolerance 1e-4", SERIES OUT_OF_REACH " in single precision", weak_link, 0, 1e-9, 0, PERI_OK, NULL,
     {3.5e-4, 3.5e-4, 3.5e-4}},
    {"loads of 2^-100, linear", SCALING, scaled, 0x1p-100, 0, PERI_GEOMETRY_LINEAR, PERI_OK, NULL, PLATE},
    {"loads of 2^-100", SCALING, scaled, 0x1p-100, 0, PERI_GEOMETRY_NONLINEAR, PERI_OK, NULL, PLATE},
    {"loads of 2^-20", SCALING, scaled, 0x1p-20, 0, PERI_GEOMETRY_LINEAR, PERI_OK, NULL, PLATE},
    {"loads of 2^40, linear", SCALING, scaled, 0x1p40, 0, PERI_GEOMETRY_LINEAR, PERI_OK, NULL, PLATE},
    {"loads of 1e30", "an equilibrium, or a status", heavy, 1e30, 0, 0, PERI_OK, NULL, {1, 1, 1}},
    {"loads of 1e300", "an equilibrium, or a status", heavy, 1e300, 0, 0, PERI_OK, NULL, {1, 1, 1}},
    {"displacements of 1e30", "an equilibrium, or a status", heavy, 1e30, 0, 1, PERI_OK, NULL, NONE},
    {"displacements of 1e300", "an equilibrium, or a status", heavy, 1e300, 0, 1, PERI_OK, NULL, NONE},
    {"no load", "no load, no displacement", idle, 0, 0, 0, PERI_OK, NULL, NONE},
    {"no load, displaced by 1e-3", "no load, no displacement, but for rounding over stiffness", idle, 0, 1e-3, 0, PERI_OK, NULL,
     {1e-12, 5e-4, 5e-4}},
    {"displacement prescribed everywhere", "a free body of that displacement: its forces are minus the reactions", all_held, 0, 0, 0,
     PERI_OK, NULL, {1e-14, 5e-6, 5e-6}},
    {"velocity prescribed everywhere", "a free body of no displacement: its forces are minus the reactions", all_held, 0, 0, 1, PERI_OK,
     NULL, {1e-14, 5e-6, 5e-6}},
    {"load factor from 0 to 0", SCALING, factors, 0, 0, 1, PERI_OK, NULL, NONE},
    {"load factor from 0 to -1", SCALING, factors, 0, -1, 3, PERI_OK, NULL, PLATE},
    {"load factor from 1 to -1", SCALING, factors, 1, -1, 4, PERI_OK, NULL, PLATE},
    {"load factor from 1 back to 0", SCALING, factors, 1, 0, 3, PERI_OK, NULL, PLATE},
    {"load factor from 1 to 1", SCALING, factors, 1, 1, 2, PERI_OK, NULL, PLATE},
    {"load factor from -3 to 1e-20", SCALING, factors, -3, 0x1p-66, 2, PERI_OK, NULL, PLATE},
    {"load factor of 1e12", SCALING, factors, 0, 1e12, 2, PERI_OK, NULL, PLATE},
    {"tolerance of 1e-300", "no residual is that small, but 0: the best there is, 100 roundings on K^-1", limit, 1e-300, 0, 0, PERI_OK,
     NULL, {1e-11, 1e-3, 1e-3}},
    {"stopped at the first iteration", "what is left is the same problem", stopped, 0, 0, 1, PERI_OK, NULL, PLATE},
    {"stopped at the third iteration", "what is left is the same problem", stopped, 0, 0, 3, PERI_OK, NULL, PLATE},
    {"tolerance of 0", "peri.h: the default", number_of, 0, 0, TOLERANCE, PERI_OK, NULL, PLATE},
    {"tolerance of 1", REFUSED, number_of, 1, 0, TOLERANCE, PERI_ERROR_RANGE, "tolerance", NONE},
    {"tolerance of -1e-300", REFUSED, number_of, -1e-300, 0, TOLERANCE, PERI_ERROR_RANGE, "tolerance", NONE},
    {"tolerance of NaN", REFUSED, number_of, NAN, 0, TOLERANCE, PERI_ERROR_RANGE, "tolerance", NONE},
    {"energy_tolerance of NaN", REFUSED, number_of, NAN, 0, ENERGY, PERI_ERROR_RANGE, "energy_tolerance", NONE},
    {"energy_tolerance of 1", REFUSED, number_of, 1, 0, ENERGY, PERI_ERROR_RANGE, "energy_tolerance", NONE},
    {"energy_tolerance of 1e-300", "residual rules", number_of, 1e-300, 0, ENERGY, PERI_OK, NULL, PLATE},
    {"one iteration", "a plate takes more", number_of, 1, 0, ITERATIONS, PERI_ERROR_CONVERGENCE, "iterations", NONE},
    {"iterations of INT64_MAX", "as many as it takes", number_of, 1e19, 0, ITERATIONS, PERI_OK, NULL, PLATE},
    {"no iteration", REFUSED, number_of, 0, 0, ITERATIONS, PERI_ERROR_ARGUMENT, "iterations", NONE},
    {"iterations of INT64_MIN", REFUSED, number_of, -1e19, 0, ITERATIONS, PERI_ERROR_ARGUMENT, "iterations", NONE},
    {"one Newton iteration, linear", "peri.h: the first iteration ends it", number_of, 1, 0, NEWTON_MOST, PERI_OK, NULL, PLATE},
    {"no Newton iteration", REFUSED, number_of, 0, 0, NEWTON_MOST, PERI_ERROR_ARGUMENT, "newton", NONE},
    {"breaks of 0, nothing breaks", "nothing breaks", number_of, 0, 0, BREAKS, PERI_OK, NULL, PLATE},
    {"breaks of -1", REFUSED, number_of, -1, 0, BREAKS, PERI_ERROR_ARGUMENT, "breaks", NONE},
    {"load_from of NaN", "peri.h: from where the body stands, 0 here", number_of, NAN, 0, FROM, PERI_OK, NULL, PLATE},
    {"load_from of infinity", REFUSED, number_of, HUGE_VAL, 0, FROM, PERI_ERROR_RANGE, "load_from", NONE},
    {"load_to of NaN", REFUSED, number_of, NAN, 0, TO, PERI_ERROR_RANGE, "load_to", NONE},
    {"load_to of infinity", REFUSED, number_of, HUGE_VAL, 0, TO, PERI_ERROR_RANGE, "load_to", NONE},
    {"steps of 0", REFUSED, number_of, 0, 0, LOAD_STEPS, PERI_ERROR_ARGUMENT, "steps", NONE},
    {"halvings of 61", REFUSED, number_of, 61, 0, HALVINGS, PERI_ERROR_ARGUMENT, "halvings", NONE},
    {"halvings of 60", REFUSED, number_of, 60, 0, HALVINGS, PERI_OK, NULL, PLATE},
    {"criticality of NaN", REFUSED, number_of, NAN, 0, CRITICALITY, PERI_ERROR_RANGE, "criticality", NONE},
    {"criticality of 1.1", REFUSED, number_of, 1.1, 0, CRITICALITY, PERI_ERROR_RANGE, "criticality", NONE},
    {"curve of load 7", "no such load", number_of, 7, 0, CURVE, PERI_ERROR_ID_NONE, "curve_load", NONE},
    {"curve_rows without a curve", REFUSED, number_of, 5, 0, ROWS, PERI_ERROR_ARGUMENT, "curve", NONE},
    {"method of 0", REFUSED, number_of, 0, 0, METHOD, PERI_ERROR_CHOICE, "method", NONE},
    {"preconditioner of 4", REFUSED, number_of, 4, 0, PRE, PERI_ERROR_CHOICE, "preconditioner", NONE},
    {"loose of 0", REFUSED, number_of, 0, 0, LOOSE, PERI_ERROR_CHOICE, "loose", NONE},
};
const extreme_table extreme_statics = EXTREME_TABLE("statics", rows);
