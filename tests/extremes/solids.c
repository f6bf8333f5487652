/* SPDX-License-Identifier: MIT */
/* solids.c - equilibria of bodies: against factorised matrices, uniform stress; floating, breaking. */
#include "extremes.h"

static double tolerance_of(int32_t precision) {
    return precision == PERI_PRECISION_DOUBLE ? 1e-8 : precision == PERI_PRECISION_MIXED ? 1e-5 : 1e-4;
}

static double value_of(const peri_body *b) {
    peri_error e;
    memset(&e, 0, sizeof e);
    (void)peri_get_error(b, &e);
    return e.value;
}

static int dimension(int32_t space) { return space == PERI_SPACE_SOLID ? 3 : 2; }

/* A box of unit cells, of one material, or where ratio is not 1 of two, the second from the middle on. */
typedef struct solid {
    int32_t precision, space, law, geometry, correction, kernel;
    int     nx, ny, nz;
    double  horizon, poisson, stretch, ratio;
} solid;

static peri_body *body_of(outcome *o, const solid *s) {
    const double lo[3] = {0, 0, 0}, hi[3] = {s->nx, s->ny, s->nz}, split = s->nx / 2;
    double middle_hi[3], middle_lo[3] = {0, 0, 0};
    peri_body_desc d;
    peri_material_desc m;
    peri_body *b = NULL;
    extreme_desc(&d, s->space, s->precision, s->horizon);
    d.geometry = s->geometry;
    d.correction = s->correction;
    d.kernel = s->kernel;
    extreme_material(&m, s->law, s->poisson, s->stretch);
    if (extreme_fails(o, NULL, peri_body_create(&d, &b, NULL)) || extreme_fails(o, b, peri_add_material(b, &m))) return b;
    memcpy(middle_hi, hi, sizeof hi);
    middle_hi[0] = middle_lo[0] = split;
    if (s->ratio == 1) (void)extreme_fails(o, b, peri_add_box(b, material_id(b, 1), lo, hi, 1));
    else {
        m.young = s->ratio;
        (void)extreme_fails(o, b, peri_add_material(b, &m));
        (void)extreme_fails(o, b, peri_add_box(b, material_id(b, 1), lo, middle_hi, 1));
        (void)extreme_fails(o, b, peri_add_box(b, material_id(b, 2), middle_lo, hi, 1));
    }
    if (o->status >= 0) (void)extreme_fails(o, b, peri_build(b));
    return b;
}

static solid plain(int32_t precision, int32_t space, int32_t law) {
    solid s;
    memset(&s, 0, sizeof s);
    s.precision = precision;
    s.space = space;
    s.law = law;
    s.geometry = PERI_GEOMETRY_LINEAR;
    s.correction = PERI_CORRECTION_NONE;
    s.kernel = PERI_KERNEL_BEST;
    s.nx = 6;
    s.ny = 4;
    s.nz = space == PERI_SPACE_SOLID ? 3 : 1;
    s.horizon = 2.2;
    s.poisson = 0.3;
    s.ratio = 1;
    return s;
}

/* ---- factorised --------------------------------------------------------------------------------------------------- */

typedef struct dense {
    int64_t n;
    double *k, *l, *u, *load;     /* stiffness, its factor on free dofs, the answer, the load */
    double  soft, stiff, scale, size; /* bounds of |K^-1| and |K|, the scale of residuals, |u| */
} dense;

static double norm(const double *x, int64_t n) {
    double sum = 0;
    int64_t i;
    for (i = 0; i < n; ++i) sum += x[i] * x[i];
    return sqrt(sum);
}

static void substitute(const double *l, int64_t n, double *x) {
    int64_t i, k;
    for (i = 0; i < n; ++i) {
        for (k = 0; k < i; ++k) x[i] -= l[i * n + k] * x[k];
        x[i] /= l[i * n + i];
    }
    for (i = n; i-- > 0;) {
        for (k = i + 1; k < n; ++k) x[i] -= l[k * n + i] * x[k];
        x[i] /= l[i * n + i];
    }
}

static void end_dense(dense *a) {
    free(a->k);
    free(a->l);
    free(a->u);
    free(a->load);
}

/* Columns of the stiffness from the forces of unit displacements of a linear body, bond by bond in double; Cholesky; held: x < 2. */
static int solve_densely(outcome *o, const solid *like, dense *a) {
    solid s = *like;
    peri_body *b;
    double *x, *v, *e, *f, sum, loads = 0, reactions = 0;
    int64_t i, j, k, n, dim = dimension(s.space);
    memset(a, 0, sizeof *a);
    s.precision = PERI_PRECISION_DOUBLE;
    s.kernel = PERI_KERNEL_REFERENCE;
    b = body_of(o, &s);
    if (o->status < 0) {
        *o = extreme_end(*o, b);
        return 0;
    }
    a->n = n = peri_size_of_field(b, PERI_FIELD_POSITION);
    a->k = (double *)calloc((size_t)(n * n), sizeof *a->k);
    a->l = (double *)calloc((size_t)(n * n), sizeof *a->l);
    a->u = (double *)calloc((size_t)n, sizeof *a->u);
    a->load = (double *)calloc((size_t)n, sizeof *a->load);
    e = (double *)calloc((size_t)n, sizeof *e);
    f = (double *)calloc((size_t)n, sizeof *f);
    x = extreme_read(o, b, PERI_FIELD_POSITION);
    v = extreme_read(o, b, PERI_FIELD_VOLUME);
    for (j = 0; j < n && o->status >= 0; ++j) {
        e[j] = 1;
        (void)extreme_fails(o, b, peri_set_field(b, PERI_FIELD_DISPLACEMENT, e, n));
        (void)extreme_fails(o, b, peri_get_field(b, PERI_FIELD_FORCE_DENSITY, f, n));
        e[j] = 0;
        for (i = 0; i < n; ++i) a->k[i * n + j] = -f[i] * v[i / dim];
    }
    for (i = 0; i < n; ++i)
        if (x[i / dim * dim] > s.nx - 1) a->load[i] = 1e-3 * (i % dim == 0 ? 1 : i % dim == 1 ? -0.5 : 0.25);
    for (i = 0; i < n && o->status >= 0; ++i) {
        sum = 0;
        for (j = 0; j < n; ++j) sum += fabs(a->k[i * n + j]);
        if (sum > a->stiff) a->stiff = sum;
        for (j = 0; j <= i; ++j) {
            const int held = x[i / dim * dim] < 2 || x[j / dim * dim] < 2;
            sum = held ? i == j : a->k[i * n + j];
            for (k = 0; k < j && !held; ++k) sum -= a->l[i * n + k] * a->l[j * n + k];
            if (i == j && !(sum > 0)) o->status = PERI_ERROR_INDEFINITE;
            a->l[i * n + j] = i == j ? sqrt(sum) : sum / a->l[j * n + j];
        }
        a->u[i] = x[i / dim * dim] < 2 ? 0 : a->load[i];
    }
    if (o->status >= 0) {
        substitute(a->l, n, a->u);
        for (i = 0; i < n; ++i) {
            sum = 0;
            for (j = 0; j < n; ++j) sum += a->k[i * n + j] * a->u[j];
            if (x[i / dim * dim] < 2) reactions += sum * sum;
            else loads += a->load[i] * a->load[i];
        }
        a->scale = sqrt(loads > reactions ? loads : reactions);
        a->size = norm(a->u, n);
        memcpy(e, a->u, (size_t)n * sizeof *e);
        for (k = 0; k < 30; ++k) { /* inverse iteration, from what the load excites */
            const double before = norm(e, n);
            for (i = 0; i < n; ++i) e[i] /= before;
            substitute(a->l, n, e);
            for (i = 0; i < n; ++i) e[i] = x[i / dim * dim] < 2 ? 0 : e[i];
        }
        a->soft = 1.1 * norm(e, n);
    }
    free(e);
    free(f);
    free(x);
    free(v);
    *o = extreme_end(*o, b);
    return o->status >= 0;
}

/* |u - dense| <= |K^-1| (residual + 8 roundings of K u, 100 of the factorisation in double), as a part of that. A tolerance below the
   rounding of K u may be out of reach: then by the residual that is told. */
static void compare(outcome *o, const dense *a, const solid *s, const peri_solve_desc *st, const char *what, int c) {
    peri_body *b = body_of(o, s);
    const double force[3] = {1e-3, -0.5e-3, 0.25e-3}, rounding = extreme_roundoff(s->precision) * a->stiff * a->size;
    double *u = NULL, off = 0, left = st->tolerance > 0 ? st->tolerance : tolerance_of(s->precision);
    int64_t k;
    int32_t code;
    if (o->status >= 0) {
        const int32_t axes = s->space == PERI_SPACE_SOLID ? PERI_AXIS_XYZ : PERI_AXIS_XY;
        (void)extreme_fails(o, b, peri_prescribe_displacement(b, extreme_slab(o, b, 0, 0, 2), axes, NULL, NULL, NULL));
        (void)extreme_fails(o, b, peri_apply_body_force(b, extreme_slab(o, b, 0, s->nx - 1, s->nx), force, NULL, NULL));
    }
    if (o->status >= 0) {
        code = peri_solve(b, st, NULL);
        if (code == PERI_ERROR_CONVERGENCE && st->method == PERI_METHOD_BICGSTAB) left = 1;
        else if (code == PERI_ERROR_CONVERGENCE && 8 * rounding > left * a->scale) left = value_of(b);
        else (void)extreme_fails(o, b, code);
        u = extreme_read(o, b, PERI_FIELD_DISPLACEMENT);
        for (k = 0; u && k < a->n; ++k) off += (u[k] - a->u[k]) * (u[k] - a->u[k]);
        extreme_take(o, sqrt(off) / (a->soft * (left * a->scale + 8 * rounding + 1e-14 * a->stiff * a->size)), what, s->space, s->law, c);
        free(u);
    }
    *o = extreme_end(*o, b);
}

/* Spaces and laws, preconditioners and methods. value: Poisson's ratio; other: horizon, or < 0: minus the stiffness of the second half;
   choice: correction. */
static outcome factorised(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    int32_t space, law, pre;
    for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
        for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law) {
            solid s = plain(precision, space, law);
            peri_solve_desc st;
            dense a;
            s.poisson = row->value;
            if (row->other > 0) s.horizon = row->other;
            else s.ratio = -row->other;
            s.correction = row->choice;
            if (space == PERI_SPACE_SOLID) s.nx = 5;
            if (space == PERI_SPACE_SOLID) s.ny = 3;
            if (solve_densely(&o, &s, &a)) {
                peri_solve_desc_init(&st);
                for (pre = PERI_PRECONDITIONER_MULTILEVEL; pre < peri__end_preconditioner; ++pre) {
                    st.preconditioner = pre;
                    compare(&o, &a, &s, &st, "space, law, preconditioner", pre);
                }
                st.method = PERI_METHOD_BICGSTAB;
                st.iterations = 300;
                compare(&o, &a, &s, &st, "space, law, BiCGSTAB", 0);
            }
            end_dense(&a);
            if (o.status < 0) return o;
        }
    return o;
}

/* ---- uniform stress ----------------------------------------------------------------------------------------------- */

/* A floating block of correspondence pulled at two faces: the stress of the traction, and Hooke's strain. Stresses are off by residuals
   times the points across, 10; strains by that over the smaller of E and the moduli. */
static outcome uniform(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    int32_t space, loose;
    for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
        for (loose = PERI_LOOSE_PINNED; loose <= PERI_LOOSE_BALANCED && o.status >= 0; ++loose) {
            const double pull = 1e-3, value[3] = {1e-3, 0, 0}, against[3] = {-1e-3, 0, 0}, out[3] = {1, 0, 0}, in[3] = {-1, 0, 0};
            const double nu = row->value, lambda = nu / ((1 + nu) * (1 - 2 * nu)), mu = 0.5 / (1 + nu);
            const double hard = space == PERI_SPACE_PLANE_STRESS ? 2 / (1 - nu) + mu : fabs(lambda) + 2 * mu;
            const double want = pull * (space == PERI_SPACE_PLANE_STRAIN ? 1 - nu * nu : 1), floor = 8 * hard * extreme_roundoff(precision);
            solid s = plain(precision, space, PERI_LAW_CORRESPONDENCE);
            peri_body *b;
            peri_solve_desc st;
            double *stress, *strain, tolerance = tolerance_of(precision);
            int64_t k, part = space == PERI_SPACE_SOLID ? 6 : 3;
            int32_t code;
            s.horizon = 1.6;
            s.nx = 9;
            s.ny = 5;
            s.nz = space == PERI_SPACE_SOLID ? 4 : 1;
            s.poisson = nu;
            b = body_of(&o, &s);
            if (o.status >= 0) {
                const double area = s.ny * s.nz;
                (void)extreme_fails(&o, b, peri_apply_traction(b, extreme_slab(&o, b, 0, s.nx - 4, s.nx), area, out,
                    value, NULL, NULL));
                (void)extreme_fails(&o, b, peri_apply_traction(b, extreme_slab(&o, b, 0, 0, 4), area, in, against, NULL, NULL));
            }
            peri_solve_desc_init(&st);
            st.loose = loose;
            st.iterations = floor > 0.01 * tolerance ? 300 : 20000;
            if (o.status >= 0) {
                code = peri_solve(b, &st, NULL);
                if (code == PERI_ERROR_CONVERGENCE && floor > 0.01 * tolerance) tolerance = value_of(b); /* out of reach */
                else (void)extreme_fails(&o, b, code);
                stress = extreme_read(&o, b, PERI_FIELD_STRESS);
                strain = extreme_read(&o, b, PERI_FIELD_STRAIN);
                for (k = 0; stress && k < peri_point_count(b) * part; ++k)
                    extreme_take(&o, fabs(stress[k] - (k % part == 0 ? pull : 0)) / pull / (100 * tolerance + 10 * floor),
                                 "stress, space, loose", space, loose, 0);
                for (k = 0; strain && k < peri_point_count(b); ++k)
                    extreme_take(&o, fabs(strain[part * k] - want) / pull / (100 * tolerance + 10 * floor) * fmin(1, mu),
                                 "strain, space, loose", space, loose, 0);
                free(stress);
                free(strain);
            }
            o = extreme_end(o, b);
        }
    return o;
}

/* ---- floating ---------------------------------------------------------------------------------------------------- */

/* Loads that balance: refused, or held just so: the strains of both ways are the same, the elastic energy is half of F.u (Clapeyron), and
   what is balanced stays where its centre of mass was. Loads of one direction alone are all left out. */
static outcome floating(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    const double tolerance = tolerance_of(precision);
    int32_t space, law, loose;
    (void)row;
    for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
        for (law = PERI_LAW_BOND_BASED; law < peri__end_law && o.status >= 0; ++law) {
            const solid s = plain(precision, space, law);
            const double pull[3] = {1e-3, 0, 0}, against[3] = {-1e-3, 0, 0};
            const int dim = dimension(space), part = dim == 3 ? 6 : 3;
            double *strain[2] = {NULL, NULL};
            for (loose = PERI_LOOSE_REFUSED; loose <= PERI_LOOSE_BALANCED && o.status >= 0; ++loose) {
                peri_body *b = body_of(&o, &s);
                peri_solve_desc st;
                peri_solve_report r;
                double work = 0, drift[3] = {0, 0, 0}, most = 0, *u = NULL;
                peri_energy e;
                int64_t k;
                int32_t code, load = -1;
                peri_solve_desc_init(&st);
                st.loose = loose;
                if (o.status >= 0) {
                    (void)extreme_fails(&o, b, peri_apply_body_force(b, extreme_slab(&o, b, 0, s.nx - 1, s.nx), pull, NULL, NULL));
                    load = peri_apply_body_force(b, extreme_slab(&o, b, 0, 0, 1), against, NULL, NULL);
                    (void)extreme_fails(&o, b, load);
                }
                if (o.status < 0) {
                    o = extreme_end(o, b);
                    continue;
                }
                code = peri_solve(b, &st, &r);
                if (loose == PERI_LOOSE_REFUSED) {
                    if (code != PERI_ERROR_LOOSE) extreme_take(&o, HUGE_VAL, "refused, space, law", space, law, 0);
                    o = extreme_end(o, b);
                    continue;
                }
                (void)extreme_fails(&o, b, code);
                if (r.loose != dim * (dim + 1) / 2) extreme_take(&o, HUGE_VAL, "motions, space, law", space, law, (int)r.loose);
                u = extreme_read(&o, b, PERI_FIELD_DISPLACEMENT);
                strain[loose - PERI_LOOSE_PINNED] = extreme_read(&o, b, PERI_FIELD_STRAIN);
                for (k = 0; u && k < peri_point_count(b); ++k) { /* unit volumes */
                    const int column = (int)(k % s.nx);
                    int d;
                    work += (column == s.nx - 1 ? 1e-3 : column == 0 ? -1e-3 : 0) * u[k * dim];
                    most = fmax(most, fabs(u[k * dim]));
                    for (d = 0; d < dim; ++d) drift[d] += u[k * dim + d];
                }
                if (o.status >= 0) (void)extreme_fails(&o, b, peri_get_energy(b, &e));
                if (o.status >= 0)
                    extreme_take(&o, fabs(2 * e.elastic / work - 1) / tolerance, "energy, space, law, loose", space, law, loose);
                if (loose == PERI_LOOSE_BALANCED)
                    extreme_take(&o, norm(drift, 3) / most / (double)peri_point_count(b) / tolerance, "drift, space, law", space, law, 0);
                free(u);
                if (loose == PERI_LOOSE_BALANCED && o.status >= 0) { /* only one of the two is left */
                    (void)extreme_fails(&o, b, peri_remove_load(b, load));
                    (void)extreme_fails(&o, b, peri_apply_body_force(b, extreme_slab(&o, b, 0, 0, s.nx), against, NULL, NULL));
                    (void)extreme_fails(&o, b, peri_apply_body_force(b, extreme_slab(&o, b, 0, s.nx - 1, s.nx), against, NULL, NULL));
                    (void)extreme_fails(&o, b, peri_reset(b));
                    (void)extreme_fails(&o, b, peri_solve(b, &st, &r));
                    u = extreme_read(&o, b, PERI_FIELD_DISPLACEMENT);
                    for (k = 0; u && k < peri_size_of_field(b, PERI_FIELD_DISPLACEMENT); ++k)
                        extreme_take(&o, fabs(u[k]) / most / tolerance, "left out, space, law", space, law, 0);
                    free(u);
                }
                o = extreme_end(o, b);
            }
            if (strain[0] && strain[1]) {
                double most = 0;
                int64_t k;
                for (k = 0; k < s.nx * s.ny * s.nz * part; ++k) most = fmax(most, fabs(strain[0][k]));
                for (k = 0; k < s.nx * s.ny * s.nz * part; ++k)
                    extreme_take(&o, fabs(strain[0][k] - strain[1][k]) / most / (10 * tolerance), "strain, space, law", space, law, 0);
            }
            free(strain[0]);
            free(strain[1]);
        }
    return o;
}

/* ---- all breaks --------------------------------------------------------------------------------------------------- */

static int32_t swell(void *user, double time, int64_t count, const int32_t *points, double *value) {
    const double *x = (const double *)user;
    const int dim = (int)x[0];
    int64_t k;
    int d;
    for (k = 0; k < count; ++k)
        for (d = 0; d < dim; ++d) value[k * dim + d] = 0.1 * time * x[1 + points[k] * dim + d];
    return 0;
}

/* A swelling by 10 % against a critical stretch of 1e-4, prescribed everywhere (choice 0) or at the rim (1): every bond breaks in the first
   step; nothing is left that pulls or stores. What is then free is loose. Correspondence pushes rows beside the rim together: its swelling
   there is not uniform, and bonds between them stay. */
static outcome burst(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    int32_t space, law, loose;
    for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
        for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law)
            for (loose = PERI_LOOSE_REFUSED; loose <= PERI_LOOSE_BALANCED && o.status >= 0; ++loose) {
                const int dim = dimension(space);
                const int32_t axes = dim == 3 ? PERI_AXIS_XYZ : PERI_AXIS_XY;
                solid s = plain(precision, space, law);
                peri_body *b;
                peri_solve_desc st;
                peri_energy e;
                int64_t n, k;
                double *x = NULL, *r;
                int32_t code;
                s.stretch = 1e-4;
                s.geometry = PERI_GEOMETRY_NONLINEAR;
                b = body_of(&o, &s);
                n = o.status < 0 ? 0 : peri_size_of_field(b, PERI_FIELD_POSITION);
                x = (double *)calloc((size_t)n + 1, sizeof *x);
                x[0] = dim;
                if (o.status >= 0) (void)extreme_fails(&o, b, peri_get_field(b, PERI_FIELD_POSITION, x + 1, n));
                for (k = 0; k < (row->choice ? 2 * dim : 1) && o.status >= 0; ++k) {
                    const int wide = k / 2 == 0 ? s.nx : k / 2 == 1 ? s.ny : s.nz;
                    const int32_t set = row->choice == 0 ? PERI_ALL : extreme_slab(&o, b, (int)k / 2, k % 2 ? wide - 1 : 0,
                        k % 2 ? wide : 1);
                    (void)extreme_fails(&o, b, peri_prescribe_displacement(b, set, axes, NULL, swell, x));
                }
                peri_solve_desc_init(&st);
                st.loose = loose;
                st.steps = 3;
                st.criticality = 0; /* at once: what is torn bond by bond may fold */
                if (o.status >= 0) {
                    const int stuck = row->choice && loose == PERI_LOOSE_REFUSED;
                    peri_solve_report report;
                    code = peri_solve(b, &st, &report);
                    if (code != PERI_OK || (law != PERI_LAW_CORRESPONDENCE && (report.lost_parts > 0) != stuck))
                        extreme_take(&o, HUGE_VAL, "status, space, law, loose", space * 10 + law, loose, -code);
                    if (peri_broken_count(b) * 2 != peri_entry_count(b) && !(row->choice && law == PERI_LAW_CORRESPONDENCE))
                        extreme_take(&o, 1, "broken, space, law, loose", space, law, loose);
                    r = extreme_read(&o, b, PERI_FIELD_REACTION);
                    for (k = 0; r && k < n && !(row->choice && law == PERI_LAW_CORRESPONDENCE); ++k)
                        extreme_take(&o, fabs(r[k]), "reaction, space, law, loose", space, law, loose);
                    free(r);
                    if (o.status >= 0 && !extreme_fails(&o, b, peri_get_energy(b, &e)) && !(row->choice && law == PERI_LAW_CORRESPONDENCE))
                        extreme_take(&o, fabs(e.elastic), "energy, space, law, loose", space, law, loose);
                }
                free(x);
                o = extreme_end(o, b);
            }
    return o;
}

/* ---- rows --------------------------------------------------------------------------------------------------------- */

#define CHOLESKY "Cholesky's factors of the stiffness from forces of unit displacements; |K^-1| times what residual and rounding allow"
#define HOOKE "peri.h: surface tractions make uniform stress exact; Hooke's law; CONVERGENCE where moduli times rounding pass the tolerance"
#define ONES {1, 1, 1}
#define NONE {0, 0, 0}

static const extreme rows[] = {
    {"plates and blocks", CHOLESKY, factorised, 0.3, 2.2, PERI_CORRECTION_NONE, PERI_OK, NULL, ONES},
    {"moment correction", CHOLESKY, factorised, 0.3, 2.2, PERI_CORRECTION_MOMENT, PERI_OK, NULL, ONES},
    {"all points in all families", CHOLESKY, factorised, 0.3, 20, PERI_CORRECTION_NONE, PERI_OK, NULL, ONES},
    {"Poisson's ratio 0.499999", CHOLESKY, factorised, 0.499999, 2.2, PERI_CORRECTION_NONE, PERI_OK, NULL, ONES},
    {"Poisson's ratio -0.9999", CHOLESKY, factorised, -0.9999, 2.2, PERI_CORRECTION_NONE, PERI_OK, NULL, ONES},
    {"stiffness 1 : 1e-6, all laws", CHOLESKY, factorised, 0.3, -1e-6, PERI_CORRECTION_NONE, PERI_OK, NULL, ONES},
    {"stiffness 1 : 1e6, all laws", CHOLESKY, factorised, 0.3, -1e6, PERI_CORRECTION_NONE, PERI_OK, NULL, ONES},
    {"stiffness 1 : 1e-9, all laws", CHOLESKY, factorised, 0.3, -1e-9, PERI_CORRECTION_NONE, PERI_OK, NULL, ONES},
    {"uniform stress, Poisson's ratio 0.3", HOOKE, uniform, 0.3, 0, 0, PERI_OK, NULL, ONES},
    {"uniform stress, Poisson's ratio 0.4999", HOOKE, uniform, 0.4999, 0, 0, PERI_OK, NULL, ONES},
    {"uniform stress, Poisson's ratio 0.4999999", HOOKE, uniform, 0.4999999, 0, 0, PERI_OK, NULL, ONES},
    {"uniform stress, Poisson's ratio -0.999999", HOOKE, uniform, -0.999999, 0, 0, PERI_OK, NULL, ONES},
    {"floating, loads in balance and not", "Clapeyron; strains of both ways; peri.h: what drives the motion is left out", floating, 0, 0,
     0, PERI_OK, NULL, {10, 10, 10}},
    {"all breaks, all is held", "every stretch is 0.1 > 1e-4: all bonds break", burst, 0, 0, 0, PERI_OK, NULL, NONE},
    {"all breaks, the rim is held", "every stretch is 0.1 > 1e-4: all bonds break, and the points that nothing holds are left", burst, 0, 0,
     1, PERI_OK, NULL, NONE},
};
const extreme_table extreme_solids = EXTREME_TABLE("solids", rows);
