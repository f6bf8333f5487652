/* SPDX-License-Identifier: MIT */
/* test_fragments.c - state-based points that have lost most of their bonds: what they do, and the step that they need.

   Nothing here was recorded from the library. The truth is that forces are the derivative of the energy, that rigid motions cost
   nothing, that momentum is conserved, and the operator itself, read column by column. */
#include "failure.h"

/* ---- what is left of a family ------------------------------------------------------------------------------------- */

#define LEFT 6
typedef struct remnant {
    const char *name;
    int         count, bond[LEFT][3];
} remnant;

static const remnant flat[] = {
    {"nothing", 0, {{0, 0, 0}}},
    {"one bond", 1, {{1, 0, 0}}},
    {"one long bond", 1, {{2, 1, 0}}},
    {"two in line", 2, {{1, 0, 0}, {-2, 0, 0}}},
    {"two on one side", 2, {{1, 1, 0}, {2, 2, 0}}},
    {"a corner", 2, {{1, 0, 0}, {0, 1, 0}}},
    {"a flat corner", 2, {{2, 1, 0}, {2, 2, 0}}},
    {"a cross", 4, {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}}},
};
static const remnant solid[] = {
    {"nothing", 0, {{0, 0, 0}}},
    {"one bond", 1, {{0, 0, 1}}},
    {"one oblique bond", 1, {{1, 1, 1}}},
    {"two in line", 2, {{1, 1, 0}, {-1, -1, 0}}},
    {"three in a plane", 3, {{1, 0, 0}, {0, 1, 0}, {1, 1, 0}}},
    {"an oblique plane", 3, {{1, 1, 0}, {0, 1, 1}, {-1, 0, 1}}},
    {"a corner", 3, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
    {"three oblique", 3, {{1, 1, 1}, {1, -1, 0}, {0, 2, 1}}},
    {"a cross", 6, {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}},
};

/* A box whose middle point keeps only these bonds; the point to *p. */
static peri_body *reduced(kind k, int32_t geometry, const remnant *r, int32_t *p) {
    const int dim = dim_of(k.space), side = dim == 3 ? 5 : 7, middle = side / 2;
    peri_body *b = box(k, geometry, side, side, side);
    int32_t *rows = rows_of(b), width = peri_family_width(b), w, pairs[600];
    int64_t cut = 0;
    *p = middle + side * (middle + (dim == 3 ? side * middle : 0));
    for (w = 0; w < width; ++w) {
        int32_t j = rows[*p * width + w];
        int n, keep = j == *p, at[3];
        at[0] = j % side - middle;
        at[1] = j / side % side - middle;
        at[2] = dim == 3 ? j / (side * side) - middle : 0;
        for (n = 0; n < r->count; ++n) keep |= at[0] == r->bond[n][0] && at[1] == r->bond[n][1] && at[2] == r->bond[n][2];
        if (keep) continue;
        pairs[2 * cut] = *p;
        pairs[2 * cut++ + 1] = j;
    }
    CHECK(MUST(b, peri_cut_pairs(b, PERI_CUT_INITIAL, cut, pairs)) == cut);
    free(rows);
    return b;
}

static void all_finite(peri_body *b) {
    int32_t field;
    for (field = PERI_FIELD_POSITION; field < peri__end_field; ++field) {
        double *x = get(b, field), sum = 0;
        int64_t i;
        for (i = 0; i < peri_size_of_field(b, field); ++i) sum += fabs(x[i]);
        CHECK(sum < 1e12);
        free(x);
    }
}

static double elastic(peri_body *b, const double *u) {
    peri_energy e;
    put(b, PERI_FIELD_DISPLACEMENT, u);
    (void)MUST(b, peri_get_energy(b, &e));
    return e.elastic;
}

/* SOURCE OF TRUTH: every law is the derivative of an energy: force density times volume = -dE/du, by central differences of
   1e-5 H: their own error is 1e-9 of the largest force (third derivative: (1e-5)^2 over strains of 0.05), rounding of E less. */
static void force_is_derivative(peri_body *b, int32_t p, const double *u) {
    const int dim = peri_dimension(b);
    const double h = 1e-5 * H, volume = pow(H, dim) * (dim == 3 ? 1 : THICK);
    double *f, *moved = (double *)calloc((size_t)peri_size_of_field(b, PERI_FIELD_DISPLACEMENT), sizeof *moved), most;
    const int64_t n = peri_size_of_field(b, PERI_FIELD_DISPLACEMENT);
    const int32_t which[4] = {p, p + 1, p - 2, p + (dim == 3 ? 5 : 7)};
    int k, d;
    put(b, PERI_FIELD_DISPLACEMENT, u);
    f = get(b, PERI_FIELD_FORCE_DENSITY);
    most = largest(f, n) * volume;
    memcpy(moved, u, (size_t)n * sizeof *u);
    for (k = 0; k < 4; ++k)
        for (d = 0; d < dim; ++d) {
            double *at = &moved[dim * which[k] + d], was = *at, e;
            *at = was + h;
            e = elastic(b, moved);
            *at = was - h;
            e -= elastic(b, moved);
            *at = was;
            CHECK_NEAR(f[dim * which[k] + d] * volume, -e / (2 * h), 0, 1e-8 * most);
        }
    free(f);
    free(moved);
}

/* SOURCE OF TRUTH: objectivity: a rigid motion costs nothing (linear: u = W x). Rounding of displacements of a body's size. */
static void rotation_is_free(peri_body *b, int32_t geometry) {
    const int dim = peri_dimension(b);
    double *x = get(b, PERI_FIELD_POSITION), *u = get(b, PERI_FIELD_DISPLACEMENT), *f, c = cos(0.7), s = sin(0.7), q = 0.8;
    int64_t i;
    peri_energy e;
    for (i = 0; i < peri_point_count(b); ++i) { /* about the z axis, in 3D then about the x axis by a right angle */
        const double *a = &x[dim * i];
        double y[3];
        y[0] = c * a[0] - s * a[1];
        y[1] = s * a[0] + c * a[1];
        if (geometry == PERI_GEOMETRY_LINEAR) y[0] = a[0] - q * a[1], y[1] = a[1] + q * a[0];
        y[2] = dim == 3 ? a[2] : 0;
        if (dim == 3 && geometry == PERI_GEOMETRY_NONLINEAR) y[2] = y[1], y[1] = -a[2];
        if (dim == 3 && geometry == PERI_GEOMETRY_LINEAR) y[1] -= q * a[2], y[2] += q * a[1];
        memcpy(&u[dim * i], y, (size_t)dim * sizeof *y);
        u[dim * i] -= a[0];
        u[dim * i + 1] -= a[1];
        if (dim == 3) u[dim * i + 2] -= a[2];
    }
    put(b, PERI_FIELD_DISPLACEMENT, u);
    f = get(b, PERI_FIELD_FORCE_DENSITY);
    CHECK(largest(f, peri_size_of_field(b, PERI_FIELD_FORCE_DENSITY)) < 1e-11 * YOUNG / H);
    (void)MUST(b, peri_get_energy(b, &e));
    CHECK(e.elastic < 1e-24 * YOUNG);
    free(x);
    free(u);
    free(f);
}

/* SOURCE OF TRUTH: Newton's third law: linear and (nonlinear geometry) angular momentum stay to rounding; a point without bonds keeps
   its velocity to the last bit. */
static void momentum_stays(peri_body *b, int32_t p, const remnant *r, int32_t geometry) {
    const int dim = peri_dimension(b);
    double *v = random_field(peri_size_of_field(b, PERI_FIELD_VELOCITY), 0.05, 9), *w, was[3], now[3], spin[3], turned[3], size;
    int d;
    (void)MUST(b, peri_reset(b));
    put(b, PERI_FIELD_VELOCITY, v);
    (void)MUST(b, peri_get_momentum(b, was, spin));
    size = DENSITY * 0.05 * (double)peri_point_count(b) * pow(H, dim);
    (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 60, 0, 0);
    (void)MUST(b, peri_get_momentum(b, now, turned));
    for (d = 0; d < dim; ++d) CHECK_NEAR(now[d], was[d], 0, 1e-13 * size);
    for (d = 0; geometry == PERI_GEOMETRY_NONLINEAR && d < (dim == 3 ? 3 : 1); ++d) CHECK_NEAR(turned[d], spin[d], 0, 1e-13 * size);
    all_finite(b);
    w = get(b, PERI_FIELD_VELOCITY);
    CHECK((memcmp(&v[dim * p], &w[dim * p], (size_t)dim * sizeof *v) == 0) == (r->count == 0));
    free(v);
    free(w);
}

static void remnants(int32_t space, int32_t law, int32_t geometry, double nu) {
    const remnant *list = space == PERI_SPACE_SOLID ? solid : flat;
    const size_t count = space == PERI_SPACE_SOLID ? sizeof solid / sizeof *solid : sizeof flat / sizeof *flat;
    size_t n;
    for (n = 0; n < count; ++n) {
        kind k = kind_of(space, law, PERI_CRITERION_STRETCH, nu);
        int32_t p;
        int before = test_bad;
        peri_body *b;
        double *u;
        k.limit = 0;
        b = reduced(k, geometry, &list[n], &p);
        u = random_field(peri_size_of_field(b, PERI_FIELD_DISPLACEMENT), 0.05 * H, 3 + n);
        all_finite(b);
        put(b, PERI_FIELD_DISPLACEMENT, u);
        all_finite(b);
        force_is_derivative(b, p, u);
        rotation_is_free(b, geometry);
        momentum_stays(b, p, &list[n], geometry);
        if (test_bad > before) printf("    above: %s, nu %.2f, geometry %d, %s\n", law_name[law % 100], nu, (int)geometry, list[n].name);
        free(u);
        peri_body_destroy(b);
    }
}
static void remnants_of_families(void) {
    int32_t space, law, geometry;
    for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
        for (law = PERI_LAW_LPS; law < peri__end_law; ++law)
            for (geometry = PERI_GEOMETRY_NONLINEAR; geometry < peri__end_geometry; ++geometry) {
                if (!test_long && space == PERI_SPACE_SOLID && geometry == PERI_GEOMETRY_LINEAR) continue;
                remnants(space, law, geometry, 0.2);
                if (test_long || space == PERI_SPACE_PLANE_STRAIN) remnants(space, law, geometry, 0.45);
                if (test_long) remnants(space, law, geometry, -0.5);
            }
}

/* SOURCE OF TRUTH: the energy of the bonds that are left, whenever it is asked for: at the same place as after everything was made anew
   (forces are read first). */
static void energy_follows_the_cut(void) {
    const double a[2] = {0.6, -1}, z[2] = {0.6, 0.35};
    int32_t law, field;
    for (law = PERI_LAW_LPS; law < peri__end_law; ++law) {
        kind k = kind_of(PERI_SPACE_PLANE_STRAIN, law, PERI_CRITERION_STRETCH, 0.3);
        peri_body *b[2];
        double *u, *w[2], *f;
        peri_energy e[2];
        int n;
        k.limit = 0;
        for (n = 0; n < 2; ++n) {
            b[n] = box(k, PERI_GEOMETRY_NONLINEAR, 12, 6, 1);
            u = random_field(144, 0.1 * H, 4);
            put(b[n], PERI_FIELD_DISPLACEMENT, u);
            (void)MUST(b[n], peri_cut_segment(b[n], PERI_CUT_INITIAL, a, z));
            if (n) f = get(b[n], PERI_FIELD_FORCE_DENSITY), free(f);
            (void)MUST(b[n], peri_get_energy(b[n], &e[n]));
            free(u);
        }
        CHECK(e[0].elastic > 0 && e[0].elastic == e[1].elastic && e[0].initial == e[1].initial);
        for (field = PERI_FIELD_ENERGY_DENSITY; field <= PERI_FIELD_FORCE_STRESS; ++field) {
            const double up[2] = {0.6, 0.5};
            (void)MUST(b[1], peri_reset(b[1]));
            (void)MUST(b[0], peri_reset(b[0]));
            u = random_field(144, 0.1 * H, 5);
            for (n = 0; n < 2; ++n) {
                (void)go(b[n], PERI_INTEGRATOR_VELOCITY_VERLET, 1, 0, 0);
                put(b[n], PERI_FIELD_DISPLACEMENT, u);
                CHECK(peri_cut_segment(b[n], PERI_CUT_NOW, z, up) > 0);
                if (n) f = get(b[n], PERI_FIELD_FORCE_DENSITY), free(f);
                w[n] = get(b[n], field);
            }
            CHECK(memcmp(w[0], w[1], (size_t)peri_size_of_field(b[0], field) * sizeof *u) == 0);
            free(u);
            free(w[0]);
            free(w[1]);
        }
        peri_body_destroy(b[0]);
        peri_body_destroy(b[1]);
    }
}

static int32_t off_the_corner(void *user, int32_t i, int32_t j, const double *xi, const double *xj) {
    int dim = *(int *)user, d, in[2] = {1, 1};
    (void)i, (void)j;
    for (d = 0; d < dim; ++d) {
        in[0] &= xi[d] < 2 * H;
        in[1] &= xj[d] < 2 * H;
    }
    return in[0] != in[1];
}
/* SOURCE OF TRUTH: no bond, no force: a piece of 2 x 2 (x 2) points that is cut off and thrown, turning, keeps its momentum; the rest
   stays at rest to the last bit. */
static void a_fragment_flies_free(void) {
    int32_t space, law;
    for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
        for (law = PERI_LAW_LPS; law < peri__end_law; ++law) {
            int dim = dim_of(space), d;
            kind k = kind_of(space, law, PERI_CRITERION_STRETCH, 0.3);
            peri_body *b;
            double *x, *v, *w, was[3] = {0, 0, 0}, now[3] = {0, 0, 0}, throw_[3] = {-0.3, -0.7, -0.1};
            int64_t i, n;
            k.limit = 0;
            b = box(k, PERI_GEOMETRY_NONLINEAR, 6, 5, 4);
            CHECK(MUST(b, peri_cut_if(b, PERI_CUT_INITIAL, off_the_corner, &dim)) > 0);
            x = get(b, PERI_FIELD_POSITION);
            v = get(b, PERI_FIELD_VELOCITY);
            n = peri_point_count(b);
            for (i = 0; i < n; ++i) {
                const double *a = &x[dim * i];
                if (a[0] > 2 * H || a[1] > 2 * H || (dim == 3 && a[2] > 2 * H)) continue;
                for (d = 0; d < dim; ++d) v[dim * i + d] = throw_[d] + (d == 0 ? -2 * a[1] : d == 1 ? 2 * a[0] : 0);
                for (d = 0; d < dim; ++d) was[d] += v[dim * i + d];
            }
            put(b, PERI_FIELD_VELOCITY, v);
            (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 40, 0, 0);
            w = get(b, PERI_FIELD_VELOCITY);
            for (i = 0; i < n; ++i)
                for (d = 0; d < dim; ++d)
                    if (v[dim * i + d] != 0) now[d] += w[dim * i + d];
                    else CHECK(w[dim * i + d] == 0);
            for (d = 0; d < dim; ++d) CHECK_NEAR(now[d], was[d], 1e-13, 0);
            CHECK(memcmp(v, w, (size_t)(n * dim) * sizeof *v) != 0);
            free(x);
            free(v);
            free(w);
            peri_body_destroy(b);
        }
}

/* ---- the step ----------------------------------------------------------------------------------------------------- */

typedef struct shears { /* on_frame: at the first frame, the points near the middle are left with their shortest bonds      */
    int    frames;
    double error, total, stable;
} shears;

static int32_t shear_off(void *user, peri_body *b) {
    shears *s = (shears *)user;
    double *x = get(b, PERI_FIELD_POSITION);
    int32_t *rows = rows_of(b), width = peri_family_width(b), w, pairs[2];
    int64_t i;
    peri_energy e;
    for (i = 0; s->frames == 0 && i < peri_point_count(b); ++i)
        for (w = 0; w < width; ++w) {
            int32_t j = rows[i * width + w];
            if (fabs(x[2 * i] - 0.65) > 0.16 || fabs(x[2 * i + 1] - 0.45) > 0.16 || far(x, 2, i, j) < 1.1 * H) continue;
            if (peri_bond_is_intact(b, (int32_t)i, j) != 1) continue;
            pairs[0] = (int32_t)i;
            pairs[1] = j;
            CHECK(peri_cut_pairs(b, PERI_CUT_NOW, 1, pairs) == 1);
        }
    s->frames++;
    (void)MUST(b, peri_get_energy(b, &e));
    s->error = fmax(s->error, fabs(e.error));
    s->total = fmax(s->total, e.kinetic + e.elastic);
    s->stable = peri_stable_step(b);
    free(x);
    free(rows);
    return 0;
}
static peri_body *shaken(int32_t law, peri_advance_desc *r, shears *s) {
    kind k = kind_of(PERI_SPACE_PLANE_STRAIN, law, PERI_CRITERION_STRETCH, 0.4);
    peri_body *b;
    double *x, *v;
    int64_t i;
    k.limit = 0;
    b = box(k, PERI_GEOMETRY_NONLINEAR, 13, 9, 1);
    x = get(b, PERI_FIELD_POSITION);
    v = get(b, PERI_FIELD_VELOCITY);
    for (i = 0; i < 2 * peri_point_count(b); ++i) v[i] = 0.01 * sin(3 * x[i]);
    put(b, PERI_FIELD_VELOCITY, v);
    free(x);
    free(v);
    memset(s, 0, sizeof *s);
    peri_advance_desc_init(r);
    r->frame_steps = 10;
    r->on_frame = shear_off;
    r->user = s;
    return b;
}

/* SOURCE OF TRUTH: the contract of peri_advance and peri_advance_desc.time_step. Points with only short bonds are stiffer than before. */
static void the_step_follows(void) {
    int32_t law, integrator;
    for (law = PERI_LAW_LPS; law < peri__end_law; ++law)
        for (integrator = PERI_INTEGRATOR_VELOCITY_VERLET; integrator < peri__end_integrator; ++integrator) {
            peri_advance_desc r;
            shears s, fine;
            peri_body *b = shaken(law, &r, &s);
            peri_error error;
            const double before = peri_stable_step(b), part = 0.65;
            double after, chosen, steps;
            r.integrator = integrator;
            r.safety = part; /* stable is not yet exact: the error of the ledger goes with the square of the step */
            r.duration = 3; /* the step is the library's: it goes on with shorter ones and ends on the dot */
            (void)MUST(b, peri_advance(b, &r));
            after = peri_stable_step(b);
            CHECK(after < part * before && peri_time(b) == 3); /* so the step has to follow */
            steps = (double)peri_step_count(b);
            CHECK(steps > 3 / (part * before) + 1 && steps <= 10 + 3 / (part * after) + 1);
            peri_body_destroy(b);
            b = shaken(law, &r, &fine); /* a quarter of the step: the ledger's error is of second order */
            r.duration = 3;
            r.integrator = integrator;
            r.safety = part / 4;
            r.frame_steps = 40;
            (void)MUST(b, peri_advance(b, &r));
            if (integrator == PERI_INTEGRATOR_VELOCITY_VERLET)
                printf("    %-10s stable step %.4f, then %.4f; |error|/energy %.1e, at a quarter of the step %.1e\n", law_name[law % 100],
                       before, after, s.error / s.total, fine.error / fine.total);
            CHECK(s.error < 0.05 * s.total && fine.error < s.error / 8);
            peri_body_destroy(b);

            b = shaken(law, &r, &s); /* a given step that is too long by then */
            r.integrator = integrator;
            chosen = r.time_step = 0.5 * (before + after);
            r.steps = 50;
            CHECK(peri_advance(b, &r) == PERI_ERROR_STEP);
            CHECK(peri_step_count(b) == 10 && fabs(peri_time(b) - 10 * chosen) < 1e-12);
            CHECK(peri_get_error(b, &error) == PERI_OK && error.code == PERI_ERROR_STEP && strcmp(error.field, "time_step") == 0);
            CHECK_NEAR(error.value, peri_stable_step(b), 1e-12, 0);
            CHECK(peri_advance(b, &r) == PERI_ERROR_STEP && peri_step_count(b) == 10);
            r.time_step = (law == PERI_LAW_CORRESPONDENCE ? 0.8 : 1) * error.value; /* P = F S gets stiffer as it is stretched */
            (void)MUST(b, peri_advance(b, &r));
            CHECK(peri_step_count(b) == 60);
            all_finite(b);
            peri_body_destroy(b);

            b = shaken(law, &r, &s); /* forced */
            r.integrator = integrator;
            r.time_step = chosen;
            r.force_step = 1;
            r.steps = 12;
            (void)MUST(b, peri_advance(b, &r));
            CHECK(peri_step_count(b) == 12);
            peri_body_destroy(b);
        }
}

/* The same by bonds that break, without a frame: a plate pulled apart; a bond-based one only gets softer. */
static int32_t stretch_out(void *user, double time, int64_t count, const int32_t *points, double *value) {
    int64_t i;
    (void)points, (void)time;
    for (i = 0; i < count; ++i) value[2 * i] = *(const double *)user;
    return 0;
}
static void broken_bonds_shorten_the_step(void) {
    int32_t law;
    for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law) {
        double pull[2] = {-0.05, 0.05}, first, value;
        peri_body *b = box(kind_of(PERI_SPACE_PLANE_STRESS, law, PERI_CRITERION_STRETCH, 0.2), PERI_GEOMETRY_NONLINEAR, 20, 8, 1);
        peri_error error;
        peri_energy e;
        peri_advance_desc r;
        int64_t steps;
        int stops = 0;
        (void)MUST(b, peri_prescribe_velocity(b, slab(b, 0, 0.3), PERI_AXIS_X, NULL, stretch_out, &pull[0]));
        (void)MUST(b, peri_prescribe_velocity(b, slab(b, 1.7, 2), PERI_AXIS_X, NULL, stretch_out, &pull[1]));
        peri_advance_desc_init(&r);
        r.duration = 4;
        first = r.time_step = peri_stable_step(b);
        while (peri_advance(b, &r) == PERI_ERROR_STEP && stops < 300) {
            stops++;
            CHECK(peri_get_error(b, &error) == PERI_OK && error.value == peri_stable_step(b) && error.value < r.time_step);
            r.time_step = error.value;
            r.duration = 4 - peri_time(b);
            CHECK(peri_broken_count(b) > 0);
        }
        CHECK((stops > 0) == (law != PERI_LAW_BOND_BASED) && stops < 300);
        CHECK_NEAR(peri_time(b), 4, 1e-12, 0);
        CHECK(peri_broken_count(b) > 100);
        value = peri_stable_step(b);
        (void)MUST(b, peri_get_energy(b, &e));
        CHECK(fabs(e.error) < e.external);
        (void)MUST(b, peri_reset(b));
        CHECK(peri_stable_step(b) == first);
        r.time_step = 0;
        r.duration = 4;
        (void)MUST(b, peri_advance(b, &r));
        steps = peri_step_count(b);
        CHECK(peri_time(b) == 4 && peri_broken_count(b) > 100);
        if (law == PERI_LAW_BOND_BASED || peri_stable_step(b) > 0.9 * first) CHECK((double)steps <= 4 / (0.9 * first) + 1);
        else CHECK((double)steps > 4 / (0.9 * first) + 1);
        if (law == PERI_LAW_BOND_BASED) CHECK(value == first);
        printf("    %-10s stable step %.4f, after %4d breaks %.4f; %d times stopped; %d steps on its own\n", law_name[law % 100], first,
               (int)peri_broken_count(b), value, stops, (int)steps);
        peri_body_destroy(b);
    }
}

/* ---- is the stable step safe? ------------------------------------------------------------------------------------- */

/* Upper bound of the spectral radius of a[n][n] (destroyed): |A^1024|^(1/1024) in Frobenius's norm, by ten squarings. It exceeds the
   radius of a symmetric matrix by n^(1/2048) at most: 0.3 %. */
static double radius(double *a, int64_t n) {
    double *b = (double *)calloc((size_t)(n * n), sizeof *b), scale = 0, power = 1;
    int64_t i, j, k;
    int squaring;
    for (squaring = 0; squaring <= 10; ++squaring) {
        double norm = 0;
        for (i = 0; i < n * n; ++i) norm += a[i] * a[i];
        norm = sqrt(norm);
        scale += power * log(norm);
        if (squaring == 10) break;
        for (i = 0; i < n * n; ++i) a[i] /= norm;
        memset(b, 0, (size_t)(n * n) * sizeof *b);
        for (i = 0; i < n; ++i)
            for (k = 0; k < n; ++k)
                for (j = 0; a[i * n + k] != 0 && j < n; ++j) b[i * n + j] += a[i * n + k] * a[k * n + j];
        memcpy(a, b, (size_t)(n * n) * sizeof *b);
        power *= 0.5;
    }
    free(b);
    return exp(scale);
}

/* SOURCE OF TRUTH: the operator: column by column the force density over the density under unit displacements (linear geometry). An
   explicit step is stable up to 2/w, w^2 the largest eigenvalue. All points have one mass: the matrix is symmetric. */
static double margin(kind k, int32_t correction, int32_t influence, double horizon, double cut) {
    peri_body_desc d = plan(k.space);
    peri_body *b;
    chance c = {11, 0};
    double *a, *u, step, lambda;
    int64_t n, i, j;
    d.geometry = PERI_GEOMETRY_LINEAR;
    d.correction = correction;
    d.influence = influence;
    d.horizon = horizon * H;
    k.limit = 0;
    b = k.space == PERI_SPACE_SOLID ? make(&d, k, 4, 3, 3) : make(&d, k, 6, 5, 1);
    c.share = cut;
    if (cut > 0) CHECK(MUST(b, peri_cut_if(b, PERI_CUT_INITIAL, by_chance, &c)) > 0);
    n = peri_size_of_field(b, PERI_FIELD_DISPLACEMENT);
    a = (double *)calloc((size_t)(n * n), sizeof *a);
    u = (double *)calloc((size_t)n, sizeof *u);
    for (j = 0; j < n; ++j) {
        double *f;
        u[j] = 1;
        put(b, PERI_FIELD_DISPLACEMENT, u);
        f = get(b, PERI_FIELD_FORCE_DENSITY);
        for (i = 0; i < n; ++i) a[i * n + j] = -f[i] / DENSITY;
        u[j] = 0;
        free(f);
    }
    for (i = 0; i < n; ++i) /* the derivative of an energy is symmetric */
        for (j = 0; j < i; ++j) CHECK(fabs(a[i * n + j] - a[j * n + i]) <= 1e-11 * (a[i * n + i] + a[j * n + j] + YOUNG / (H * H)));
    step = peri_stable_step(b);
    lambda = radius(a, n);
    free(a);
    free(u);
    peri_body_destroy(b);
    return 2 / sqrt(lambda) / step;
}
static void stable_step_is_safe(void) {
    const double nus[4] = {0.1, 0.49, 0.25, -0.6}, cuts[3] = {0, 0.5, 0.85};
    const int32_t weights[3] = {PERI_INFLUENCE_CONSTANT, PERI_INFLUENCE_LINEAR, PERI_INFLUENCE_INVERSE};
    int32_t space, law, correction;
    int nu, w;
    for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law)
        for (nu = 0; nu < (law == PERI_LAW_BOND_BASED ? 1 : test_long ? 4 : 2); ++nu) {
            double least = 1e9, most = 0;
            for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
                for (correction = PERI_CORRECTION_NONE; correction < peri__end_correction; ++correction)
                    for (w = 0; w < (test_long ? 9 : 3); ++w) {
                        kind k = kind_of(space, law, PERI_CRITERION_STRETCH, nus[nu]);
                        double ratio;
                        if (!test_long && correction == PERI_CORRECTION_VOLUME) continue;
                        if (!test_long && space == PERI_SPACE_SOLID && correction != PERI_CORRECTION_NONE) continue;
                        ratio = margin(k, correction, weights[w / 3], w % 2 ? 2 : 3, cuts[w % 3]);
                        least = fmin(least, ratio);
                        most = fmax(most, ratio);
                        if (ratio < 1)
                            printf("    %s nu %.2f space %d correction %d influence %d cut %.2f: limit/stable step %.3f\n",
                                   law_name[law % 100], nus[nu], (int)space, (int)correction, (int)weights[w / 3], cuts[w % 3], ratio);
                        CHECK(ratio >= 1);
                    }
            printf("    %-10s nu %5.2f: true limit/stable step %.3f to %.3f\n", law_name[law % 100], nus[nu], least, most);
        }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(remnants_of_families);
    RUN(energy_follows_the_cut);
    RUN(a_fragment_flies_free);
    RUN(the_step_follows);
    RUN(broken_bonds_shorten_the_step);
    RUN(stable_step_is_safe);
    return test_end("test_fragments");
}
