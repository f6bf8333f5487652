/* SPDX-License-Identifier: MIT */
/* test_moduli.c - Young's modulus and Poisson's ratio as measured on a plate in tension: [T] 4.2.

   THE PLATE  8 mm x 2 mm, plane stress, E = 71 GPa, points at the multiples of the spacing (as in [T] Fig. 3.4: the cells make it larger by
   one spacing), the ends pulled by the force of a uniform stress, on the last column of points as in [T] (LAYER) or on the face as the
   law feels it (FACE). Measured ([T] 4.1-4.17), sigma = force/section:
     double node    strains from the displacements of the two points a horizon away from the central one, along x and y
     internal node  means of u_x/x and u_y/y over the points that are two horizons away from all edges
     tensor         E and nu of Hooke's law from the tensors of strain (4.14) and of collapsed stress (4.10) at the central point

   SOURCE OF TRUTH
     solid    E and nu as given. A family in the bulk that gives uniform strains the energy of the solid gives the tensors of it, too; and
              correspondence under FACE is to be in uniform stress all over.
     lattice  LPS without correction: t = w/m (A theta |xi| + B e), summed here over an ideal lattice
     [T]      table 4.2 (m = 6, horizon 0.3 mm, nu = 0.1). Its headings are exchanged: what stands under Young's modulus is the error of
              Poisson's ratio, and the other way round; and so are the names of the rows w = |xi| and w = horizon - |xi|. Read so, the
              columns of the tensor method agree with the lattice: to 0.02 points where w is so steep that the edge of the horizon has no
              say, to 0.5 where it has (its volume correction is not printed alike in Fig. 3.7 and Fig. C.3); and E by double node agrees
              to 0.8 points where w has no pole. nu by the node methods does not: how the plate was held is not printed.
     poles    [T] 4.2.3. The asymptote at h/2 is |h/(2 |xi| - h)|: so over its section, under its figures and in table 4.2; the list before
              them has lost the bars, and w may not be negative there. At m = 6 points are at the pole, so that what the table has of it is
              a matter of rounding; any w is on its line, where the error of E is -1/9 of that of nu. The asymptote at h/4 is
              exp(1/(|xi| - h/4)), whose exponent has a unit: the row is met in mm. The library, whose w knows of no unit, takes h. */
#include "disk_area.h"
#include "specimen.h"

#define YOUNG  71e9
#define STRESS 100e6
#define MM     1e-3

enum { LAYER, FACE };
enum { DOUBLE_NODE, INTERNAL, TENSOR, METHODS };
enum { HALF = PERI_INFLUENCE_POLE_HALF, QUARTER = PERI_INFLUENCE_USER }; /* QUARTER: of [T], in mm                        */

typedef struct plate {
    int32_t law, correction, influence, quadrature;
    double  nu, horizon;
    int     ratio, load;
    /* of the built plate */
    peri_body *body;
    double     h;
    int        cols, rows, centre;
} plate;

typedef struct moduli { /* relative errors                                                                                 */
    double young[METHODS], poisson[METHODS];
} moduli;

static plate plate_of(int32_t law, int32_t correction, double nu) {
    plate p;
    memset(&p, 0, sizeof p);
    p.law = law;
    p.correction = correction;
    p.influence = PERI_INFLUENCE_CONSTANT;
    p.quadrature = PERI_QUADRATURE_FULL;
    p.nu = law == PERI_LAW_BOND_BASED ? 1.0 / 3 : nu;
    p.horizon = 0.3 * MM;
    p.ratio = 3;
    p.load = LAYER;
    return p;
}

static double *get(peri_body *b, int32_t field) {
    int64_t n = MUST(b, peri_size_of_field(b, field));
    double *x = (double *)calloc((size_t)(n < 0 ? 0 : n) + 1, sizeof *x);
    (void)MUST(b, peri_get_field(b, field, x, n));
    return x;
}

/* ---- influence functions and the lattice ---------------------------------------------------------------------------- */

static double at_half(double q) { return fabs(1 / (2 * q - 1)); }
static double at_quarter(double q, double horizon) { return exp(1 / ((q - 0.25) * horizon)); }
static int32_t quarter_pole(void *user, double q, double *w) {
    *w = at_quarter(q, *(const double *)user);
    return 0;
}

static double influence_of(int32_t influence, double q, double ratio, double horizon) {
    double in_mm = horizon / MM;
    switch (influence) {
        case PERI_INFLUENCE_LINEAR: return q < 1 ? 1 - q : 0;
        case PERI_INFLUENCE_GAUSSIAN: return exp(-q * q);
        case PERI_INFLUENCE_PROPORTIONAL: return q;
        case PERI_INFLUENCE_INVERSE: return 1 / q;
        case PERI_INFLUENCE_INVERSE_4: return pow(q, -4);
        case PERI_INFLUENCE_POLE_EDGE: return 1 / (1 + 0.5 / ratio - q);
        case HALF: return at_half(q);
        case PERI_INFLUENCE_POLE_QUARTER: return at_quarter(q, 1);
        case QUARTER: return at_quarter(q, in_mm);
        default: return 1;
    }
}

/* Of the unit cell around (i, j), in the disk. */
static double part_of_cell(int i, int j, double ratio) {
    const double lo[2] = {i - 0.5, j - 0.5}, hi[2] = {i + 0.5, j + 0.5};
    double moment[2];
    return area_in_disk(lo, hi, ratio, moment);
}

/* sum T xi V of an LPS point of the lattice under the strains ex, ey. */
static void lattice_stress(const plate *p, double ex, double ey, double *s) {
    const double h = p->horizon / p->ratio, mu = YOUNG / (2 * (1 + p->nu)), lambda = YOUNG * p->nu / (1 - p->nu * p->nu);
    double m = 0, theta = 0;
    int i, j, pass, reach = p->ratio + 1;
    s[0] = s[1] = 0;
    for (pass = 0; pass < 2; ++pass)
        for (i = -reach; i <= reach; ++i)
            for (j = -reach; j <= reach; ++j) {
                const double q = sqrt(i * i + j * j) / p->ratio, r = q * p->horizon, x = i * h, y = j * h;
                double v = q <= 1 + 1e-9 ? 1 : 0, e, w, t;
                if (p->quadrature == PERI_QUADRATURE_RAMP) v = fmin(1, fmax(0, p->ratio * (1 - q) + 0.5)); /* [T] Fig. 3.7 */
                if (p->quadrature == PERI_QUADRATURE_PARTIAL) v = part_of_cell(i, j, p->ratio);
                if ((i == 0 && j == 0) || v == 0) continue;
                e = (ex * x * x + ey * y * y) / r;
                w = influence_of(p->influence, q, p->ratio, p->horizon) * v * h * h;
                if (pass == 0) {
                    m += w * r * r;
                    theta += 2 * w * r * e;
                } else {
                    t = w / m * ((2 * lambda - 2 * mu) * theta / m * r + 8 * mu * e) / r;
                    s[0] += t * x * x;
                    s[1] += t * y * y;
                }
            }
}

/* Hooke's law solved for E and nu ([T] 4.17); returns their errors. */
static void hooke(const double *strain, const double *stress, double nu, double *young, double *poisson) {
    const double det = stress[1] * strain[1] - strain[0] * stress[0];
    *poisson = (stress[0] * strain[1] - strain[0] * stress[1]) / det / nu - 1;
    *young = (stress[1] * stress[1] - stress[0] * stress[0]) / det / YOUNG - 1;
}

/* What the tensor method must find on this lattice; returns its lateral strain per unit of strain in tension. As C11 = C22, any strain
   would do, but for rounding. */
static double lattice_moduli(const plate *p, double *young, double *poisson) {
    double strain[2] = {1, 0}, s[2];
    lattice_stress(p, 1, 0, s);
    strain[1] = -s[1] / s[0];
    lattice_stress(p, strain[0], strain[1], s);
    hooke(strain, s, p->nu, young, poisson);
    return strain[1];
}

/* ---- the plate ------------------------------------------------------------------------------------------------------ */

static int32_t build(plate *p, double length, double width) {
    static double in_mm;
    specimen s;
    int32_t status;
    p->h = p->horizon / p->ratio;
    p->cols = 2 * (int)(length / p->h / 2 + 0.5) + 1;
    p->rows = 2 * (int)(width / p->h / 2 + 0.5) + 1;
    p->centre = p->rows / 2 * p->cols + p->cols / 2;
    in_mm = p->horizon / MM;
    s = specimen_of(PERI_SPACE_PLANE_STRESS, p->law, p->nu, p->h, p->ratio, p->cols, p->rows, 1);
    for (int d = 0; d < 2; ++d) {
        s.hi[d] *= 0.5;
        s.lo[d] = -s.hi[d];
    }
    s.desc.geometry = PERI_GEOMETRY_LINEAR;
    s.desc.correction = p->correction;
    s.desc.influence = p->influence;
    s.desc.influence_fn = quarter_pole;
    s.desc.influence_user = &in_mm;
    s.desc.quadrature = p->quadrature;
    s.desc.horizon = p->horizon;
    s.material.young = YOUNG;
    s.material.density = 2780;
    p->body = specimen_start(&s);
    CHECK(MUST(p->body, peri_add_box(p->body, peri_id(p->body, PERI_KIND_MATERIAL, 1), s.lo, s.hi, p->h)) == p->cols * p->rows);
    status = peri_build(p->body);
    if (p->influence == HALF && p->ratio % 2 == 0) CHECK(status == PERI_ERROR_INFLUENCE); /* infinite at h/2, where points are */
    else (void)MUST(p->body, status);
    return status;
}

static void pull(const plate *p, double side) {
    const double deep = (p->load == LAYER ? 1 : 2 * p->ratio) * p->h, width = p->rows * p->h, end = 0.5 * p->cols * p->h;
    const double value[2] = {side * STRESS, 0}, out[2] = {side, 0}, lo[2] = {side < 0 ? -end : end - deep, -width};
    const double hi[2] = {lo[0] + deep, width};
    const int32_t set = (int32_t)MUST(p->body, peri_select_box(p->body, NULL, lo, hi));
    if (p->load == LAYER) (void)MUST(p->body, peri_apply_layer_traction(p->body, set, width, value, NULL, NULL));
    else (void)MUST(p->body, peri_apply_traction(p->body, set, width, out, value, NULL, NULL));
}

static void hold(const plate *p, int32_t point, int32_t axes) {
    const int32_t set = (int32_t)MUST(p->body, peri_select_points(p->body, NULL, 1, &point));
    (void)MUST(p->body, peri_prescribe_displacement(p->body, set, axes, NULL, NULL, NULL));
}

static void tensor_method(const plate *p, moduli *m) {
    double *strain = get(p->body, PERI_FIELD_STRAIN), *stress = get(p->body, PERI_FIELD_FORCE_STRESS);
    hooke(&strain[3 * p->centre], &stress[3 * p->centre], p->nu, &m->young[TENSOR], &m->poisson[TENSOR]);
    free(strain);
    free(stress);
}

/* NaN where the plate has no internal nodes. */
static void node_methods(const plate *p, moduli *m) {
    double *x = get(p->body, PERI_FIELD_POSITION), *u = get(p->body, PERI_FIELD_DISPLACEMENT);
    double strain[METHODS][2] = {{0}}, count[2] = {0, 0};
    int i, k;
    strain[DOUBLE_NODE][0] = u[2 * (p->centre + p->ratio)] / p->horizon; /* the central point is at rest */
    strain[DOUBLE_NODE][1] = u[2 * (p->centre + p->ratio * p->cols) + 1] / p->horizon;
    for (i = 0; i < p->cols * p->rows; ++i) {
        const int col = i % p->cols, row = i / p->cols, margin = 2 * p->ratio;
        if (col < margin || col >= p->cols - margin || row < margin || row >= p->rows - margin) continue;
        for (k = 0; k < 2; ++k)
            if (k == 0 ? col != p->cols / 2 : row != p->rows / 2) {
                strain[INTERNAL][k] += u[2 * i + k] / x[2 * i + k];
                count[k]++;
            }
    }
    for (k = 0; k < 2; ++k) strain[INTERNAL][k] /= count[k];
    for (k = 0; k < TENSOR; ++k) {
        m->young[k] = STRESS / strain[k][0] / YOUNG - 1;
        m->poisson[k] = -strain[k][1] / strain[k][0] / p->nu - 1;
    }
    free(x);
    free(u);
}

/* Pulls the plate and measures; prints the errors in %. */
static moduli measure(plate p) {
    moduli m;
    peri_solve_desc st;
    int k;
    memset(&m, 0, sizeof m);
    if (build(&p, 8 * MM, 2 * MM) != PERI_OK) printf("  refused");
    else {
        pull(&p, -1);
        pull(&p, 1);
        hold(&p, p.centre, PERI_AXIS_X | PERI_AXIS_Y);
        hold(&p, p.centre + p.cols / 2, PERI_AXIS_Y);
        peri_solve_desc_init(&st);
        st.tolerance = 1e-9;
        (void)MUST(p.body, peri_solve(p.body, &st, NULL));
        node_methods(&p, &m);
        tensor_method(&p, &m);
        for (k = 0; k < METHODS; ++k) printf("  %8.2f", 100 * m.young[k]);
        printf("  ");
        for (k = 0; k < METHODS; ++k) printf("  %8.2f", 100 * m.poisson[k]);
    }
    printf("\n");
    peri_body_destroy(p.body);
    return m;
}

/* ---- cases ---------------------------------------------------------------------------------------------------------- */

static const char *const law_name[] = {"", "bond-based", "LPS", "Oterkus", "correspondence"};
static const double nus[] = {0.1, 0.2, 0.3, 0.4, 0.45};
static const char head[] = "errors in %: E by double node, internal nodes, tensor; nu by the same";

/* [T] table 4.2 as it is to be read: errors of E by the three methods, of nu by the same. */
typedef struct printed {
    int32_t     influence;
    const char *name;
    double      young[METHODS], poisson[METHODS], bound; /* of the tensor method, in points                               */
} printed;
static const printed table_4_2[] = {
    {PERI_INFLUENCE_INVERSE, "1/|xi|", {4.55, 0.58, 0.32}, {9.49, 5.74, -2.87}, 0.5},
    {PERI_INFLUENCE_CONSTANT, "1", {4.94, -1.20, 0.32}, {14.27, 7.13, -2.90}, 0.5},
    {PERI_INFLUENCE_GAUSSIAN, "exp -(|xi|/h)^2", {4.37, -0.39, 0.16}, {12.16, 6.61, -1.47}, 0.5},
    {PERI_INFLUENCE_PROPORTIONAL, "|xi|", {5.39, -2.62, 0.45}, {16.32, 7.34, -4.08}, 0.5},
    {PERI_INFLUENCE_LINEAR, "h - |xi|", {2.98, 0.05, -0.24}, {8.53, 5.22, 2.13}, 0.5},
    {PERI_INFLUENCE_INVERSE_4, "|xi|^-4", {11.78, 11.28, 9.23}, {-86.20, -79.56, -83.03}, 0.5},
    {PERI_INFLUENCE_POLE_EDGE, "pole at the edge", {4.93, -5.60, -1.30}, {42.37, 33.52, 11.68}, 0.5},
    {HALF, "pole at h/2", {-21.49, 3.63, 19.15}, {243.61, 164.66, -172.33}, 0},
    {QUARTER, "pole at h/4", {40.01, -30.62, 37.93}, {142.26, 143.21, -341.38}, 0.02},
};
#define ROWS ((int)(sizeof table_4_2 / sizeof *table_4_2))

static plate row_of_table(const printed *row) {
    plate p = plate_of(PERI_LAW_LPS, PERI_CORRECTION_NONE, 0.1);
    p.ratio = 6;
    p.quadrature = PERI_QUADRATURE_RAMP;
    p.influence = row->influence;
    return p;
}

/* The tensor method on a family of the bulk under uniform strain: as the lattice has it to rounding. The fields are linear in the
   strain, so E and nu come out whatever the strain; that of tension is taken. Returns whether the body was built. */
static int tensor_method_of_the_bulk(plate p, double room, moduli *m) {
    double young, poisson, lateral, *x, *u;
    int i;
    if (build(&p, room * p.horizon / p.ratio, room * p.horizon / p.ratio) != PERI_OK) {
        peri_body_destroy(p.body);
        return 0;
    }
    lateral = lattice_moduli(&p, &young, &poisson);
    x = get(p.body, PERI_FIELD_POSITION);
    u = get(p.body, PERI_FIELD_DISPLACEMENT);
    for (i = 0; i < p.cols * p.rows; ++i) {
        u[2 * i] = 1e-3 * x[2 * i];
        u[2 * i + 1] = 1e-3 * lateral * x[2 * i + 1];
    }
    (void)MUST(p.body, peri_set_field(p.body, PERI_FIELD_DISPLACEMENT, u, 2 * p.cols * p.rows));
    tensor_method(&p, m);
    CHECK_NEAR(m->young[TENSOR], young, 0, 1e-9);
    CHECK_NEAR(m->poisson[TENSOR], poisson, 0, 1e-9);
    free(x);
    free(u);
    peri_body_destroy(p.body);
    return 1;
}

/* And as [T] found it. */
static void tensor_method_of_table_4_2(void) {
    int k;
    for (k = 0; k < ROWS; ++k) {
        const printed *row = &table_4_2[k];
        moduli m;
        if (!tensor_method_of_the_bulk(row_of_table(row), 14, &m)) continue;
        CHECK_NEAR(100 * m.young[TENSOR], row->young[TENSOR], 0, row->bound);
        CHECK_NEAR(100 * m.poisson[TENSOR], row->poisson[TENSOR], 0, row->bound);
    }
}

/* The formulas of the poles under every quadrature, where some cells are partial and others beyond the horizon. The pole at h/4 has no
   unit: whatever the horizon, the moduli are the same; with the exponent of [T] they are not, and at m = 6 those of the library are off
   its table by more than 1.5 points (docs/theory.md: 2). */
static void poles_of_the_text(void) {
    static const int32_t poles[3] = {PERI_INFLUENCE_POLE_HALF, PERI_INFLUENCE_POLE_QUARTER, QUARTER};
    static const int ratios[3] = {3, 5, 7};
    int32_t quadrature;
    int n, r;
    make_gauss();
    for (n = 0; n < 3; ++n)
        for (r = 0; r < 3; ++r)
            for (quadrature = PERI_QUADRATURE_FULL; quadrature <= PERI_QUADRATURE_PARTIAL; ++quadrature) {
                plate p = plate_of(PERI_LAW_LPS, PERI_CORRECTION_NONE, 0.1);
                moduli fine, coarse;
                p.influence = poles[n];
                p.ratio = ratios[r];
                p.quadrature = quadrature;
                CHECK(tensor_method_of_the_bulk(p, 2 * p.ratio + 4, &fine));
                p.horizon *= 10;
                CHECK(tensor_method_of_the_bulk(p, 2 * p.ratio + 4, &coarse));
                if (poles[n] != QUARTER) CHECK_NEAR(fine.young[TENSOR], coarse.young[TENSOR], 0, 1e-9);
                else CHECK(fabs(fine.young[TENSOR] - coarse.young[TENSOR]) > 0.01);
                CHECK_NEAR(9 * fine.young[TENSOR], -fine.poisson[TENSOR], 0, 1e-9);
            }
    for (n = 0; n < ROWS; ++n)
        if (table_4_2[n].influence == QUARTER) {
            plate p = row_of_table(&table_4_2[n]);
            moduli m;
            p.influence = PERI_INFLUENCE_POLE_QUARTER;
            CHECK(tensor_method_of_the_bulk(p, 14, &m));
            CHECK(fabs(100 * m.young[TENSOR] - table_4_2[n].young[TENSOR]) > 1.5);
        }
}

/* In the plate the strain near the centre is uniform but for what is left of the disturbance by the edges, three horizons away. */
static void tensor_method_is_of_the_lattice(const plate *p, const moduli *m) {
    double young, poisson;
    (void)lattice_moduli(p, &young, &poisson);
    CHECK_NEAR(m->young[TENSOR], young, 0, 0.001);
    CHECK_NEAR(m->poisson[TENSOR], poisson, 0, 0.001);
}

/* Without correction LPS has the moduli of its lattice, 2 % and 3 % to 17 % off here. */
static void without_correction(void) {
    int k;
    printf("    %s\n", head);
    for (k = 0; k < 5; k += 2) {
        plate p = plate_of(PERI_LAW_LPS, PERI_CORRECTION_NONE, nus[k]);
        moduli m;
        printf("    nu = %.2f", p.nu);
        m = measure(p);
        tensor_method_is_of_the_lattice(&p, &m);
        CHECK(fabs(m.young[TENSOR]) > 0.01 && fabs(m.poisson[TENSOR]) > 0.03);
    }
}

/* The bar: 1 % by the tensor method. Where families in the bulk are exact only the variation of strain within a horizon is left: 0.1 %.
   Young's modulus by nodes, which sees the soft and stiff layers at the faces, to 1 %, too. */
static void below_one_percent(void) {
    int32_t law;
    int k;
    printf("    %s\n", head);
    for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law)
        for (k = 0; k < 5; ++k) {
            plate p = plate_of(law, law == PERI_LAW_CORRESPONDENCE ? PERI_CORRECTION_NONE : PERI_CORRECTION_MOMENT, nus[k]);
            moduli m;
            if (law == PERI_LAW_BOND_BASED && k > 0) continue;
            printf("    %-14s nu = %.2f", law_name[law % 100], p.nu);
            m = measure(p);
            CHECK(fabs(m.young[TENSOR]) <= 0.001 && fabs(m.poisson[TENSOR]) <= 0.001);
            CHECK(fabs(m.young[DOUBLE_NODE]) <= 0.01 && fabs(m.young[INTERNAL]) <= 0.01);
        }
}

/* Correspondence under a traction that it feels as one: uniform stress, so every method is exact, up to the residual of 1e-9. */
static void uniform_stress(void) {
    int k, i;
    printf("    %s\n", head);
    for (k = 0; k < 5; k += 2) {
        plate p = plate_of(PERI_LAW_CORRESPONDENCE, PERI_CORRECTION_NONE, nus[k]);
        moduli m;
        p.load = FACE;
        p.influence = k == 2 ? PERI_INFLUENCE_LINEAR : PERI_INFLUENCE_CONSTANT;
        printf("    nu = %.2f", p.nu);
        m = measure(p);
        for (i = 0; i < METHODS; ++i) CHECK(fabs(m.young[i]) < 1e-7 && fabs(m.poisson[i]) < 1e-6);
    }
}

/* ---- tables ---------------------------------------------------------------------------------------------------------- */

/* [T] Figs. 4.17, 4.18, horizon 0.3 mm: errors at m = 5 are smaller than at m = 3. Here that of E by each method, and both by the
   tensor method. */
static void table_of_ratios(void) {
    moduli m[2];
    int k, i, fine;
    printf("    %s\n", head);
    for (k = 0; k < 5; ++k) {
        for (fine = 0; fine < 2; ++fine) {
            plate p = plate_of(PERI_LAW_LPS, PERI_CORRECTION_NONE, nus[k]);
            p.quadrature = PERI_QUADRATURE_RAMP;
            p.ratio = fine ? 5 : 3;
            printf("    LPS, none    nu = %.2f, m = %d", p.nu, p.ratio);
            m[fine] = measure(p);
            p.correction = PERI_CORRECTION_MOMENT;
            printf("    LPS, moment  nu = %.2f, m = %d", p.nu, p.ratio);
            (void)measure(p);
        }
        for (i = 0; i < METHODS; ++i) CHECK(fabs(m[1].young[i]) < fabs(m[0].young[i]));
        CHECK(fabs(m[1].poisson[TENSOR]) < fabs(m[0].poisson[TENSOR]));
    }
}

/* [T] Fig. 4.19, m = 3: the node methods become better as the horizon gets smaller, the tensor method stays as it is from a horizon of a
   quarter of the width on; with the moment correction the former go to zero, at least like the horizon. */
static void convergence_with_the_horizon(void) {
    int32_t correction;
    printf("    %s\n", head);
    for (correction = PERI_CORRECTION_NONE; correction < peri__end_correction; correction += 3) {
        double last = HUGE_VAL;
        int k;
        for (k = 0; k < 4; ++k) {
            plate p = plate_of(PERI_LAW_LPS, correction, 0.1);
            moduli m;
            p.horizon = 0.6 * MM / (1 << k);
            p.quadrature = PERI_QUADRATURE_RAMP;
            printf("    LPS, %-6s horizon %.3f mm", correction == PERI_CORRECTION_NONE ? "none" : "moment", p.horizon / MM);
            m = measure(p);
            if (correction == PERI_CORRECTION_NONE && k > 0) tensor_method_is_of_the_lattice(&p, &m);
            CHECK(fabs(m.young[DOUBLE_NODE]) < (correction == PERI_CORRECTION_NONE ? 1 : 0.6) * last);
            last = fabs(m.young[DOUBLE_NODE]);
        }
    }
}

/* [T] Figs. 4.20 to 4.23, horizon 0.3 mm: by the tensor method what the lattice has. */
static void convergence_with_m(void) {
    int k, ratio;
    printf("    %s\n", head);
    for (k = 0; k < 5; ++k)
        for (ratio = 2; k != 2 && ratio <= 6; ++ratio) {
            plate p = plate_of(PERI_LAW_LPS, PERI_CORRECTION_NONE, nus[k]);
            moduli m;
            p.quadrature = PERI_QUADRATURE_RAMP;
            p.ratio = ratio;
            printf("    LPS, none    nu = %.2f, m = %d", p.nu, ratio);
            m = measure(p);
            tensor_method_is_of_the_lattice(&p, &m);
        }
}

/* [T] table 4.2, solved; the bound as above, and the strain not quite uniform. Moment corrected, all but the poles inside are to be within
   1 %: there no weights that are not negative make up for bonds that all lie along the axes. */
static void influence_functions(void) {
    int k, i;
    printf("    %s\n", head);
    for (k = 0; k < ROWS; ++k) {
        const printed *row = &table_4_2[k];
        plate p = row_of_table(row);
        moduli m;
        printf("    %-16s [T]   ", row->name);
        for (i = 0; i < METHODS; ++i) printf("  %8.2f", row->young[i]);
        printf("  ");
        for (i = 0; i < METHODS; ++i) printf("  %8.2f", row->poisson[i]);
        printf("\n%20s none  ", "");
        m = measure(p);
        if (row->influence == HALF) continue;
        CHECK_NEAR(100 * m.young[TENSOR], row->young[TENSOR], 0, row->bound + 0.1);
        CHECK_NEAR(100 * m.poisson[TENSOR], row->poisson[TENSOR], 0, row->bound + 0.1);
        if (k < 6) CHECK_NEAR(100 * m.young[DOUBLE_NODE], row->young[DOUBLE_NODE], 0, 0.8);
        p.correction = PERI_CORRECTION_MOMENT;
        printf("%20s moment", "");
        m = measure(p);
        if (row->influence != QUARTER) CHECK(fabs(m.young[TENSOR]) < 0.01 && fabs(m.poisson[TENSOR]) < 0.01);
    }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(tensor_method_of_table_4_2);
    RUN(poles_of_the_text);
    RUN(without_correction);
    RUN(below_one_percent);
    RUN(uniform_stress);
    LONG_RUN(table_of_ratios);
    LONG_RUN(convergence_with_the_horizon);
    LONG_RUN(convergence_with_m);
    LONG_RUN(influence_functions);
    return test_end("test_moduli");
}
