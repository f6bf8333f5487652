/* SPDX-License-Identifier: MIT */
/* families.c - families of every size and shape: one bond to all bonds, lines and planes, clouds, families of the caller, and what the
   search, the quadratures and the corrections make of them. */
#include "dense.h"

enum shape { LINE, PLANE, BOX, GRADED, CLOUD, PAIR, OBLIQUE, TILTED }; /* from CLOUD on with points up to 1.3 apart */

typedef struct scene {
    const extreme *row;
    outcome       *o;
    peri_body     *body;
    peri_body_desc desc;
    peri_material_desc  material;
    enum shape     shape;
} scene;

typedef double (*probe_fn)(scene *s);

/* ---- bodies ------------------------------------------------------------------------------------------------------- */

static peri_body *lattice(scene *s, int nx, int ny, int nz) {
    const double lo[3] = {0, 0, 0}, hi[3] = {nx, ny, nz}, fine_lo[3] = {nx, 0, 0}, fine_hi[3] = {nx + 1, ny, nz};
    peri_body *b = NULL;
    outcome *o = s->o;
    if (extreme_fails(o, NULL, peri_body_create(&s->desc, &b, NULL))) return NULL;
    (void)(extreme_fails(o, b, peri_add_material(b, &s->material)) || extreme_fails(o, b, peri_add_box(b, material_id(b, 1), lo, hi, 1))
           || (s->shape == GRADED && extreme_fails(o, b, peri_add_box(b, material_id(b, 1), fine_lo, fine_hi,
                                                                      s->desc.space == PERI_SPACE_SOLID ? 0.5 : 0.25)))
           || extreme_fails(o, b, peri_build(b)));
    if (o->status >= 0) return b;
    peri_body_destroy(b);
    return NULL;
}

/* Unit cells, or points of the mean volume 1: a pair 0.9 apart; 20 points along x or (1, 2, 3); 8 x 8 points in the plane of x and y or 6 x
   6 across (1, 2, 3), about a spacing apart; a box; a cloud of volumes over six orders of magnitude; a box beside one of finer cells. */
static peri_body *make(scene *s) {
    const int dim = s->desc.space == PERI_SPACE_SOLID ? 3 : 2;
    const double along[3] = {1 / sqrt(14.0), 2 / sqrt(14.0), 3 / sqrt(14.0)}, across[3] = {2 / sqrt(5.0), -1 / sqrt(5.0), 0};
    const double third[3] = {3 / sqrt(70.0), 6 / sqrt(70.0), -5 / sqrt(70.0)};
    double x[3 * 64], volume[64];
    uint64_t seed = 5;
    int count, i, d;
    switch (s->shape) {
    case LINE: return lattice(s, 20, 1, 1);
    case PLANE: return lattice(s, 8, 8, 1);
    case BOX: return dim == 3 ? lattice(s, 5, 5, 5) : lattice(s, 9, 9, 1);
    case GRADED: return dim == 3 ? lattice(s, 3, 3, 3) : lattice(s, 5, 6, 1);
    case PAIR: count = 2; break;
    case OBLIQUE: count = 20; break;
    case TILTED: count = 36; break;
    default: count = dim == 3 ? 40 : 64;
    }
    for (i = 0; i < count; ++i) {
        const double p = 0.3 * test_random(&seed), q = 0.3 * test_random(&seed), spread = pow(10, 6 * test_random(&seed) - 3);
        volume[i] = s->shape == CLOUD ? spread : s->shape == PAIR ? 0.5 + i : 1;
        for (d = 0; d < dim; ++d) {
            const double axis = dim == 2 ? (d + 1) / sqrt(5.0) : along[d];
            if (s->shape == CLOUD) x[i * dim + d] = (dim == 3 ? 3 : 7) * test_random(&seed);
            else if (s->shape == TILTED) x[i * dim + d] = (i % 6 + p) * across[d] + (i / 6 + q) * third[d];
            else x[i * dim + d] = (s->shape == PAIR ? 0.9 * i : i + p) * axis;
        }
    }
    return dense_cloud(s->o, &s->desc, &s->material, count, x, volume);
}

typedef struct setting { /* of a loop                                                                                     */
    int32_t geometry, quadrature, correction, space; /* space: the first                                                  */
    double  horizon;
    enum shape first, last;
} setting;

static setting plain(double horizon, enum shape first, enum shape last) {
    setting c = {PERI_GEOMETRY_NONLINEAR, PERI_QUADRATURE_FULL, PERI_CORRECTION_NONE, PERI_SPACE_PLANE_STRESS, 0, LINE, LINE};
    c.horizon = horizon;
    c.first = first;
    c.last = last;
    return c;
}

/* The worst error of a probe over spaces, laws and shapes; planes only in 3D, and corrections only of laws that have them. */
static void each(outcome *o, const extreme *row, int32_t precision, const setting *c, probe_fn probe) {
    int32_t space, law;
    int shape;
    for (space = c->space; space < peri__end_space; ++space)
        for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law)
            for (shape = (int)c->first; shape <= (int)c->last && o->status >= 0; ++shape) {
                scene s;
                double error;
                s.row = row;
                s.o = o;
                s.shape = (enum shape)shape;
                if (space != PERI_SPACE_SOLID && (shape == PLANE || shape == TILTED)) continue;
                if (law != PERI_LAW_BOND_BASED && c->correction != PERI_CORRECTION_NONE
                    && c->correction != PERI_CORRECTION_MOMENT) continue;
                extreme_desc(&s.desc, space, precision, c->horizon);
                s.desc.geometry = c->geometry;
                s.desc.quadrature = c->quadrature;
                s.desc.correction = c->correction;
                extreme_material(&s.material, law, 0.3, 0);
                s.body = make(&s);
                error = s.body ? probe(&s) : NAN;
                dense_note(o, error, space, law);
                *o = extreme_end(*o, s.body);
            }
}

/* ---- who is in a family ------------------------------------------------------------------------------------------- */

/* How many pairs are bonded that should not be, or not bonded that should: all pairs are tried. */
static double strangers(scene *s) {
    const int64_t n = peri_point_count(s->body), width = peri_family_width(s->body);
    const int dim = peri_dimension(s->body);
    const double h = s->desc.horizon * (1 + 1e-8);
    double *x = extreme_read(s->o, s->body, PERI_FIELD_POSITION), wrong = 0;
    int32_t *row = (int32_t *)malloc((size_t)width * sizeof *row);
    int64_t i, j, k;
    int d;
    for (i = 0; x && row && i < n; ++i) {
        if (extreme_fails(s->o, s->body, peri_get_families(s->body, i, 1, row, width))) break;
        for (j = k = 0; j < n; ++j) {
            double square = 0;
            int bonded;
            if (j == i) continue;
            for (d = 0; d < dim; ++d) square += pow(x[j * dim + d] - x[i * dim + d], 2);
            bonded = k < width && row[k] == j;
            k += bonded;
            wrong += bonded != (sqrt(square) <= h);
        }
    }
    free(x), free(row);
    return wrong;
}

static double family_probe(scene *s) {
    dense_scatter(s->o, s->body, s->row->other, 19);
    return extreme_worst(strangers(s), dense_error(s->o, s->body, &s->desc, &s->material));
}

/* All shapes at the horizon row->value; graded bodies and clouds, too. */
static outcome families(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    const setting c = plain(row->value, LINE, (enum shape)row->choice);
    each(&o, row, precision, &c, family_probe);
    return o;
}

/* A bond for every pair of 1369 points within 18.3 spacings: families above 1024 bonds. */
static outcome wide(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    scene s;
    s.row = row;
    s.o = &o;
    s.shape = BOX;
    extreme_desc(&s.desc, PERI_SPACE_PLANE_STRESS, precision, row->value);
    extreme_material(&s.material, PERI_LAW_LPS, 0.3, 0);
    s.body = lattice(&s, 37, 37, 1);
    dense_scatter(&o, s.body, 0.1, 23);
    if (s.body) {
        dense_note(&o, peri_family_width(s.body) > 1024 ? 0 : 1, PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS);
        dense_note(&o, dense_error(&o, s.body, &s.desc, &s.material), PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS);
    }
    return extreme_end(o, s.body);
}

/* Sizes of families where the horizon is a hair from a shell of the lattice: choice 2D, other 3D. */
static outcome shell(const extreme *row, int32_t precision) {
    static const double spacings[5] = {1, 0.1, 1.0 / 3, 1e-9, 7e5};
    outcome o = {PERI_OK, "", 0};
    int32_t space;
    int k, n, d;
    for (space = PERI_SPACE_PLANE_STRAIN; space < peri__end_space; ++space)
        for (k = 0; k < 5 && o.status >= 0; ++k) {
            const double h = spacings[k];
            double lo[3], hi[3];
            peri_body_desc desc;
            peri_material_desc m;
            peri_body *b = NULL;
            extreme_desc(&desc, space, precision, row->value * h);
            extreme_material(&m, PERI_LAW_LPS, 0.3, 0);
            for (d = 0, n = space == PERI_SPACE_SOLID ? 8 : 20; d < 3; ++d) {
                lo[d] = 1000 * h;
                hi[d] = lo[d] + n * h;
            }
            (void)(extreme_fails(&o, NULL, peri_body_create(&desc, &b, NULL)) || extreme_fails(&o, b, peri_add_material(b, &m))
                   || extreme_fails(&o, b, peri_add_box(b, material_id(b, 1), lo, hi, h)) || extreme_fails(&o, b, peri_build(b)));
            if (o.status >= 0)
                dense_note(&o, fabs(peri_family_width(b) - (space == PERI_SPACE_SOLID ? row->other : row->choice)), space, PERI_LAW_LPS);
            o = extreme_end(o, b);
        }
    return o;
}

/* ---- one point, two points ---------------------------------------------------------------------------------------- */

static outcome alone(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    const double x[3] = {1, 2, 3}, volume = 1;
    peri_body_desc d;
    peri_material_desc m;
    extreme_desc(&d, row->choice, precision, row->value);
    extreme_material(&m, PERI_LAW_LPS, 0.3, 0);
    return extreme_end(o, dense_cloud(&o, &d, &m, 1, x, &volume));
}

/* Two points of volumes V and W swing against each other as (v/omega) sin(omega t), with a quarter of a period for 500 steps. With
   t_i = X e/(L^2 V_j), X = D^2 bulk where theta counts and B where K is singular: omega^2 = X/(rho L^2) (2 + V/W + W/V); with a
   micromodulus c (V + W)/(rho L). Corrections set c to X (1/V + 1/W)/L, or to c V0/(V + W) where V0 is the volume of the horizon. */
static double swing_probe(scene *s) {
    const dense_moduli law = dense_moduli_of(&s->material, s->desc.space);
    const double length = 0.9, v = 0.5, w = 1.5, pi = 3.14159265358979323846, h = s->desc.horizon;
    const int dim = peri_dimension(s->body);
    const double x = s->material.law == PERI_LAW_CORRESPONDENCE ? dim * (dim + 2) * law.mu : dim * dim * law.bulk;
    double square = x / (length * length) * (2 + v / w + w / v), omega, velocity[6], u[6], apart = 0, step;
    peri_advance_desc run;
    int d;
    if (s->material.law == PERI_LAW_BOND_BASED && s->desc.correction <= PERI_CORRECTION_VOLUME) {
        square = dense_micromodulus(s->desc.space, h) * (v + w) / length;
        if (s->desc.correction == PERI_CORRECTION_VOLUME) square *= (dim == 3 ? 4.0 / 3 * pi * h * h * h : pi * h * h) / (v + w);
    }
    omega = sqrt(square);
    step = 0.5 * pi / omega / 500;
    for (d = 0; d < dim; ++d) {
        const double along = (dim == 3 ? (d + 1) / sqrt(14.0) : (d + 1) / sqrt(5.0)), speed = 0.1 * omega;
        velocity[d] = -w / (v + w) * speed * along;
        velocity[dim + d] = v / (v + w) * speed * along;
    }
    if (extreme_fails(s->o, s->body, peri_set_field(s->body, PERI_FIELD_VELOCITY, velocity, 2 * dim))) return NAN;
    peri_advance_desc_init(&run);
    run.steps = 500;
    run.time_step = step;
    if (extreme_fails(s->o, s->body, peri_advance(s->body, &run))) return NAN;
    if (extreme_fails(s->o, s->body, peri_get_field(s->body, PERI_FIELD_DISPLACEMENT, u, 2 * dim))) return NAN;
    for (d = 0; d < dim; ++d) apart += (u[dim + d] - u[d]) * (dim == 3 ? (d + 1) / sqrt(14.0) : (d + 1) / sqrt(5.0));
    if (extreme_fails(s->o, s->body, peri_get_field(s->body, PERI_FIELD_VELOCITY, velocity, 2 * dim))) return NAN;
    for (d = 0, square = 0; d < 2 * dim; ++d) square += velocity[d] * velocity[d];
    return extreme_worst(fabs(apart / 0.1 - 1), sqrt(square) / (0.1 * omega));
}

static outcome swing(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    setting c = plain(row->value, PAIR, PAIR);
    for (c.correction = PERI_CORRECTION_NONE; c.correction < peri__end_correction; ++c.correction)
        each(&o, row, precision, &c, swing_probe);
    return o;
}

/* ---- points at nearly the same place ------------------------------------------------------------------------------ */

static outcome twins(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    int32_t space, law;
    for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
        for (law = PERI_LAW_BOND_BASED; law < peri__end_law && o.status >= 0; ++law) {
            const int dim = space == PERI_SPACE_SOLID ? 3 : 2;
            double x[3 * 65], volume[65];
            uint64_t seed = 29;
            peri_body_desc d;
            peri_material_desc m;
            peri_body *b;
            int i, a, at;
            extreme_desc(&d, space, precision, 2);
            extreme_material(&m, law, 0.3, 0);
            for (i = 0; i < 64; ++i) {
                for (a = 0, at = i; a < dim; ++a, at /= dim == 3 ? 4 : 8)
                    x[i * dim + a] = at % (dim == 3 ? 4 : 8) + (i ? 0.6 * test_random(&seed) : 0);
                volume[i] = 1;
            }
            volume[64] = 1;
            for (a = 0; a < dim; ++a) x[64 * dim + a] = a ? 0 : row->value;
            b = dense_cloud(&o, &d, &m, 65, x, volume);
            dense_scatter(&o, b, row->other, 31);
            if (b) dense_note(&o, dense_error(&o, b, &d, &m), space, law);
            o = extreme_end(o, b);
        }
    return o;
}

/* ---- lines and planes in equilibrium ------------------------------------------------------------------------------ */

static int32_t first_end(void *user, int64_t index, const double *x) {
    (void)x;
    return *(const int *)user == LINE ? index < 2 : index % 8 == 0;
}

static int32_t other_end(void *user, int64_t index, const double *x) {
    (void)x;
    return *(const int *)user == LINE ? index > 17 : index % 8 == 7;
}

/* Pulled at its ends, along itself (choice: the axis), by a force density of 1e-3. Then the bonds carry what was put on. */
static double pulled_probe(scene *s) {
    const int axis = s->row->choice % 10, dim = peri_dimension(s->body);
    int shape = (int)s->shape;
    double force[3] = {0, 0, 0}, back[3] = {0, 0, 0}, *f, *u, worst = 0, moved = 0;
    const int64_t n = peri_point_count(s->body);
    peri_solve_desc p;
    int32_t pull, hold;
    int64_t i;
    int d;
    force[axis] = 1e-3;
    back[axis] = -1e-3;
    pull = peri_apply_body_force(s->body, peri_select_if(s->body, NULL, other_end, &shape), force, NULL, NULL);
    hold = peri_apply_body_force(s->body, peri_select_if(s->body, NULL, first_end, &shape), back, NULL, NULL);
    if (extreme_fails(s->o, s->body, pull) || extreme_fails(s->o, s->body, hold)) return NAN;
    peri_solve_desc_init(&p);
    p.loose = PERI_LOOSE_REFUSED - 1 + s->row->choice / 10;
    if (extreme_fails(s->o, s->body, peri_solve(s->body, &p, NULL))) return NAN;
    (void)(extreme_fails(s->o, s->body, peri_remove_load(s->body, pull)) || extreme_fails(s->o, s->body, peri_remove_load(s->body, hold)));
    f = extreme_read(s->o, s->body, PERI_FIELD_FORCE_DENSITY);
    u = extreme_read(s->o, s->body, PERI_FIELD_DISPLACEMENT);
    for (i = 0; f && u && i < n; ++i) {
        const double want = axis > 0 ? 0 : first_end(&shape, i, NULL) ? 1e-3 : other_end(&shape, i, NULL) ? -1e-3 : 0;
        for (d = 0; d < dim; ++d) worst = extreme_worst(worst, fabs(f[i * dim + d] - (d == axis ? want : 0)) / 1e-3);
        for (d = s->shape == LINE ? 1 : 2; d < dim; ++d) worst = extreme_worst(worst, fabs(u[i * dim + d]));
        moved = extreme_worst(moved, fabs(u[i * dim]));
    }
    free(f), free(u);
    if (axis > 0) return extreme_worst(worst, moved);
    return moved > 1e-4 ? worst : NAN; /* 20 cells under a stress of 2e-3 */
}

static outcome pulled(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    setting c = plain(3, row->value > 1 ? PLANE : LINE, row->value > 1 ? PLANE : LINE);
    for (c.geometry = row->choice % 10 ? PERI_GEOMETRY_LINEAR : PERI_GEOMETRY_NONLINEAR; c.geometry < peri__end_geometry; ++c.geometry)
        each(&o, row, precision, &c, pulled_probe);
    return o;
}

/* 200 steps of small swings within a line or a plane: points stay in it to the last bit, at rest as a whole, and the energy within
   (omega dt)^2/4 of what it was. */
static double flat_probe(scene *s) {
    const int dim = peri_dimension(s->body), span = s->shape == LINE ? 1 : 2;
    const int64_t n = peri_size_of_field(s->body, PERI_FIELD_DISPLACEMENT);
    double *u, momentum[3] = {0, 0, 0}, worst = 0;
    peri_energy before, e;
    peri_advance_desc run;
    int64_t i;
    dense_scatter(s->o, s->body, 0.001, 83);
    u = extreme_read(s->o, s->body, PERI_FIELD_DISPLACEMENT);
    for (i = 0; u && i < n; ++i)
        if (i % dim >= span) u[i] = 0;
    if (u) (void)extreme_fails(s->o, s->body, peri_set_field(s->body, PERI_FIELD_DISPLACEMENT, u, n));
    free(u);
    peri_advance_desc_init(&run);
    run.steps = 200;
    run.safety = 0.2;
    if (s->o->status < 0 || extreme_fails(s->o, s->body, peri_get_energy(s->body, &before))) return NAN;
    if (extreme_fails(s->o, s->body, peri_advance(s->body, &run))) return NAN;
    if (extreme_fails(s->o, s->body, peri_get_energy(s->body, &e))) return NAN;
    if (extreme_fails(s->o, s->body, peri_get_momentum(s->body, momentum, NULL))) return NAN;
    u = extreme_read(s->o, s->body, PERI_FIELD_DISPLACEMENT);
    for (i = 0; u && i < n; ++i)
        if (i % dim >= span && u[i] != 0) worst = 1;
    free(u);
    for (i = 0; i < dim; ++i) /* of points of up to 1e-3 speeds of sound each */
        if (!(fabs(momentum[i]) <= 200 * (s->desc.precision == PERI_PRECISION_DOUBLE ? 1.11e-16 : 5.96e-8) * 1e-3 * (double)n)) worst = 1;
    return extreme_worst(worst, fabs(e.error) / before.initial);
}

static outcome flat(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    const setting c = plain(row->value, LINE, PLANE);
    each(&o, row, precision, &c, flat_probe);
    return o;
}

/* ---- families of the caller --------------------------------------------------------------------------------------- */

enum given { HUB, CHAIN, ALL_PAIRS, ONE_SIDED, TWICE, NO_SUCH, LONELY, MORE_POINTS, NO_WEIGHT, NO_WIDTH };

/* Points along a line of slope 1, a spacing apart: bonds as long as the body, which is within one horizon. Point 0 is the hub. */
static outcome given(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    const int n = (int)row->value, kind = row->choice, width = kind == CHAIN ? 2 : kind == NO_WIDTH ? 0 : n - 1;
    int32_t *rows_ = (int32_t *)malloc((size_t)n * (size_t)n * sizeof *rows_), space, law;
    double *x = (double *)malloc((size_t)n * 3 * sizeof *x), *volume = (double *)malloc((size_t)n * sizeof *volume);
    uint64_t seed = 37;
    int i, k;
    for (i = 0; i < n * width; ++i) rows_[i] = i / width;
    for (i = 0; i < n && kind == CHAIN; ++i) {
        if (i > 0) rows_[2 * i] = i - 1;
        if (i + 1 < n) rows_[2 * i + 1] = i + 1;
    }
    for (i = 0; i < n && kind != CHAIN; ++i)
        for (k = 0; k < width; ++k)
            if (kind == ALL_PAIRS || i == 0 || k == 0) rows_[i * width + k] = i == 0 ? k + 1 : kind == ALL_PAIRS && k >= i ? k + 1 : k;
    if (kind == ONE_SIDED) rows_[width * 3] = 3;
    if (kind == TWICE) rows_[width * 2 + 1] = 0;
    if (kind == NO_SUCH) rows_[width * 2] = n;
    if (kind == LONELY) rows_[width * 3] = 3, rows_[2] = 0;
    for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
        for (law = PERI_LAW_BOND_BASED; law < peri__end_law && o.status >= 0; ++law) {
            const int dim = space == PERI_SPACE_SOLID ? 3 : 2;
            peri_body_desc d;
            peri_material_desc m;
            peri_body *b = NULL;
            extreme_desc(&d, space, precision, row->other);
            extreme_material(&m, law, 0.3, 0);
            if (kind == NO_WEIGHT) d.influence = PERI_INFLUENCE_LINEAR;
            for (i = 0; i < n; ++i) {
                volume[i] = 1;
                for (k = 0; k < dim; ++k) x[i * dim + k] = i + (i ? 0.5 * test_random(&seed) : 0); /* exact differences from the origin */
            }
            (void)(extreme_fails(&o, NULL, peri_body_create(&d, &b, NULL)) || extreme_fails(&o, b, peri_add_material(b, &m))
                   || extreme_fails(&o, b, peri_add_points(b, n, x, volume, NULL))
                   || extreme_fails(&o, b, peri_set_families(b, width, rows_))
                   || (kind == MORE_POINTS && extreme_fails(&o, b, peri_add_points(b, 1, x, volume, NULL)))
                   || extreme_fails(&o, b, peri_build(b)));
            if (o.status >= 0) {
                dense_note(&o, peri_family_width(b) == width ? 0 : 1, space, law);
                dense_scatter(&o, b, 0.2, 41);
                dense_note(&o, dense_error(&o, b, &d, &m), space, law);
            }
            o = extreme_end(o, b);
        }
    free(rows_), free(x), free(volume);
    return o;
}

/* ---- quadratures and corrections ---------------------------------------------------------------------------------- */

/* Whatever the weights: nothing moves at rest; nor under a shift; the law's closed form of W under e = 0.02 |xi| where it divides by the
   moments of its family; W is not negative and forces sum to 0 under any displacement. */
static double weights_probe(scene *s) {
    const int dim = peri_dimension(s->body), divides = s->material.law == PERI_LAW_LPS || s->material.law == PERI_LAW_OTERKUS;
    const dense_moduli law = dense_moduli_of(&s->material, s->desc.space);
    const double gradient[9] = {0.02, 0, 0, 0, 0.02, 0, 0, 0, 0.02}, two[4] = {0.02, 0, 0, 0.02}, shift[3] = {2, -1, 0.5};
    const double closed = 0.5 * dim * dim * law.bulk * 0.02 * 0.02;
    const int64_t n = peri_point_count(s->body);
    double worst = 0, sum[3] = {0, 0, 0}, size = 0, *f, *w, *volume = extreme_read(s->o, s->body, PERI_FIELD_VOLUME);
    int64_t i;
    int d;
    f = extreme_read(s->o, s->body, PERI_FIELD_FORCE_DENSITY);
    for (i = 0; f && i < n * dim; ++i) worst = extreme_worst(worst, fabs(f[i]));
    free(f);
    extreme_affine(s->o, s->body, dim == 3 ? gradient : two, NULL);
    w = extreme_read(s->o, s->body, PERI_FIELD_ENERGY_DENSITY);
    for (i = 0; w && divides && i < n; ++i) worst = extreme_worst(worst, fabs(w[i] / closed - 1));
    free(w);
    dense_scatter(s->o, s->body, 0.3, 43);
    if (extreme_fails(s->o, s->body, peri_add_displacement(s->body, PERI_ALL, shift))) return NAN;
    f = extreme_read(s->o, s->body, PERI_FIELD_FORCE_DENSITY);
    w = extreme_read(s->o, s->body, PERI_FIELD_ENERGY_DENSITY);
    for (i = 0; f && w && volume && i < n; ++i) {
        if (w[i] < 0) worst = extreme_worst(worst, -w[i]);
        for (d = 0; d < dim; ++d) {
            sum[d] += f[i * dim + d] * volume[i];
            size += fabs(f[i * dim + d]) * volume[i];
        }
    }
    free(f), free(w), free(volume);
    for (d = 0; d < dim && s->desc.quadrature != PERI_QUADRATURE_PARTIAL_CENTROID; ++d) worst = extreme_worst(worst, fabs(sum[d]) / size);
    return worst;
}

/* What may be combined, over the shapes from `other` to `choice`, at the horizon row->value. */
static outcome weights(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    setting c = plain(row->value, (enum shape)row->other, (enum shape)row->choice);
    c.space = PERI_SPACE_PLANE_STRAIN;
    for (c.quadrature = PERI_QUADRATURE_FULL; c.quadrature <= PERI_QUADRATURE_PARTIAL; ++c.quadrature)
        for (c.correction = PERI_CORRECTION_NONE; c.correction < peri__end_correction; ++c.correction)
            if (c.quadrature != PERI_QUADRATURE_RAMP || c.correction == PERI_CORRECTION_NONE) each(&o, row, precision, &c, weights_probe);
    return o;
}

/* The two rules of the plane, which are of bond-based bodies. */
static outcome weights_in_2d(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    int shape;
    for (shape = LINE; shape <= OBLIQUE && o.status >= 0; ++shape) {
        scene s;
        if (shape == PLANE || shape == (int)row->other) continue;
        s.row = row;
        s.o = &o;
        s.shape = (enum shape)shape;
        extreme_desc(&s.desc, PERI_SPACE_PLANE_STRAIN, precision, row->value);
        s.desc.quadrature = row->choice;
        extreme_material(&s.material, PERI_LAW_BOND_BASED, 0.25, 0);
        s.body = make(&s);
        if (s.body) dense_note(&o, weights_probe(&s), PERI_SPACE_PLANE_STRAIN, PERI_LAW_BOND_BASED);
        o = extreme_end(o, s.body);
    }
    return o;
}

#define REFUSED {0, 0, 0}
#define EXACT {0, 0, 0}
static const extreme rows[] = {
    {"one point", "peri.h: no neighbour within its horizon", alone, 3, 0, PERI_SPACE_SOLID, PERI_ERROR_FAMILY, "horizon", REFUSED},
    {"one point, a short horizon", "peri.h: smaller than the spacing", alone, 0.5, 0, PERI_SPACE_PLANE_STRESS, PERI_ERROR_HORIZON,
     "horizon", REFUSED},
    {"two points", "closed forms of omega; Verlet's amplitude is (omega dt)^2/8 larger; 500 steps of rounding", swing, 3, 0, 0, PERI_OK,
     NULL,
     {1.24e-6, 3e-5, 3e-5}},
    {"two points, horizon of 1000", "closed forms of omega; Verlet's amplitude is (omega dt)^2/8 larger; 500 steps of rounding", swing,
     1000, 0, 0, PERI_OK,
     NULL, {1.24e-6, 3e-5, 3e-5}},
    {"families of one spacing", "all pairs tried; the laws written out", families, 1, 0.1, GRADED, PERI_OK, NULL, ROUNDINGS(100)},
    {"families of 1.5 spacings", "all pairs tried; the laws written out", families, 1.5, 0.1, TILTED, PERI_OK, NULL, ROUNDINGS(100)},
    {"families of 3 spacings, thrown", "all pairs tried; the laws written out", families, 3, 4, TILTED, PERI_OK, NULL, ROUNDINGS(100)},
    {"horizon of 20 spacings", "all pairs tried; the laws written out", families, 20, 0.1, TILTED, PERI_OK, NULL, ROUNDINGS(200)},
    {"horizon of 1e6 spacings", "all pairs tried; the laws written out", families, 1e6, 0.1, TILTED, PERI_OK, NULL, ROUNDINGS(200)},
    {"families above 1024", "the laws written out; sums of 1060 terms", wide, 18.3, 0, 0, PERI_OK, NULL, ROUNDINGS(1060)},
    {"a shell at the horizon", "28 and 122 points within 3 spacings", shell, 3, 122, 28, PERI_OK, NULL, EXACT},
    {"a shell a hair beyond", "28 and 122; comparisons have a tolerance of 1e-8", shell, 3 - 1e-12, 122, 28, PERI_OK, NULL, EXACT},
    {"a shell a hair within", "28 and 122 points within 3 spacings", shell, 3 + 1e-12, 122, 28, PERI_OK, NULL, EXACT},
    {"a shell clearly beyond", "4 and 30 points are 3 spacings away: (3,0), and (2,2,1)", shell, 3 - 1e-7, 92, 24, PERI_OK, NULL, EXACT},
    {"points 1e-3 apart", "the laws written out", twins, 1e-3, 0.1, 0, PERI_OK, NULL, ROUNDINGS(100)},
    {"points 1e-6 apart", "the laws written out", twins, 1e-6, 0.1, 0, PERI_OK, NULL, ROUNDINGS(100)},
    {"points 1e-9 apart", "the laws written out", twins, 1e-9, 0.1, 0, PERI_OK, NULL, ROUNDINGS(100)},
    {"points 1e-11 apart", "the laws written out", twins, 1e-11, 0.1, 0, PERI_OK, NULL, ROUNDINGS(100)},
    {"points 1e-13 apart", "peri.h: at the same place", twins, 1e-13, 0, 0, PERI_ERROR_COINCIDENT, "positions", REFUSED},
    {"points at one place", "peri.h: at the same place", twins, 0, 0, 0, PERI_ERROR_COINCIDENT, "positions", REFUSED},
    {"a line pulled, not held", "peri.h: no support holds it", pulled, 1, 0, 10, PERI_ERROR_LOOSE, NULL, REFUSED},
    {"a line pulled, pinned", "equilibrium: bonds carry the loads, and none across", pulled, 1, 0, 20, PERI_OK, NULL, {1e-6, 1e-3, 1e-2}},
    {"a line pulled, balanced", "equilibrium: bonds carry the loads, and none across", pulled, 1, 0, 30, PERI_OK, NULL, {1e-6, 1e-3, 1e-2}},
    {"a line bent, balanced", "peri.h: what is not resisted is left out", pulled, 1, 0, 31, PERI_OK, NULL, {1e-6, 1e-6, 1e-6}},
    {"a plane pulled, pinned", "equilibrium: bonds carry the loads, and none across", pulled, 2, 0, 20, PERI_OK, NULL, {1e-6, 1e-3, 1e-2}},
    {"a plane pulled, balanced", "equilibrium: bonds carry the loads, and none across", pulled, 2, 0, 30, PERI_OK, NULL, {1e-6, 1e-3,
     1e-2}},
    {"a plane bent, balanced", "peri.h: what is not resisted is left out", pulled, 2, 0, 32, PERI_OK, NULL, {1e-6, 1e-6, 1e-6}},
    {"lines and planes in motion", "Verlet within (omega dt)^2/4, omega dt <= 0.4; no force across; no net force", flat, 3, 0, 0, PERI_OK,
     NULL, {0.04, 0.04, 0.04}},
    {"a hub of 1100 bonds", "the laws written out; sums of 1100 terms", given, 1101, 3000, HUB, PERI_OK, NULL, ROUNDINGS(1100)},
    {"a chain of 1024 points", "the laws written out", given, 1024, 3000, CHAIN, PERI_OK, NULL, ROUNDINGS(100)},
    {"all pairs of 64 points", "the laws written out", given, 64, 200, ALL_PAIRS, PERI_OK, NULL, ROUNDINGS(100)},
    {"a family that is one-sided", "peri.h: not mutual", given, 9, 2, ONE_SIDED, PERI_ERROR_IBOND, "ibond", REFUSED},
    {"a neighbour given twice", "peri.h: given twice", given, 9, 2, TWICE, PERI_ERROR_IBOND, "ibond", REFUSED},
    {"a neighbour that is no point", "peri.h: number out of range", given, 9, 2, NO_SUCH, PERI_ERROR_IBOND, "ibond", REFUSED},
    {"a point without a bond", "peri.h: a point has no neighbour", given, 9, 2, LONELY, PERI_ERROR_FAMILY, NULL, REFUSED},
    {"points after families", "peri.h: the given families are not valid", given, 9, 2, MORE_POINTS, PERI_ERROR_IBOND, "ibond", REFUSED},
    {"bonds beyond w", "peri.h: no neighbour with a weight", given, 9, 0.5, NO_WEIGHT, PERI_ERROR_FAMILY, NULL, REFUSED},
    {"families of no width", "peri.h: a count that is not allowed", given, 9, 2, NO_WIDTH, PERI_ERROR_ARGUMENT, "width", REFUSED},
    {"weights at 1 spacing", "Newton's third law, closed forms, W >= 0", weights, 1, LINE, GRADED, PERI_OK, NULL, ROUNDINGS(500)},
    {"weights at 1.5 spacings", "Newton's third law, closed forms, W >= 0", weights, 1.5, LINE, BOX, PERI_OK, NULL, ROUNDINGS(500)},
    {"weights of clouds", "Newton's third law, closed forms, W >= 0", weights, 1.5, CLOUD, CLOUD, PERI_OK, NULL, ROUNDINGS(500)},
    {"weights of a tilted plane", "Newton's third law, closed forms, W >= 0", weights, 3, TILTED, TILTED, PERI_OK, NULL, ROUNDINGS(500)},
    {"weights at 8 spacings, thin bodies", "Newton's third law, closed forms, W >= 0", weights, 8, PAIR, OBLIQUE, PERI_OK, NULL,
     ROUNDINGS(500)},
    {"centroid rule", "nothing moves at rest; W >= 0", weights_in_2d, 2, CLOUD, PERI_QUADRATURE_PARTIAL_CENTROID, PERI_OK, NULL,
     ROUNDINGS(500)},
    {"moment rule", "Newton's third law, W >= 0", weights_in_2d, 2, -1, PERI_QUADRATURE_PARTIAL_MOMENT, PERI_OK, NULL, ROUNDINGS(500)},
};
const extreme_table extreme_families = EXTREME_TABLE("families", rows);
