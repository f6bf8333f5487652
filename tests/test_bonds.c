/* SPDX-License-Identifier: MIT */
/* test_bonds.c - bonds read in bulk (peri_get_bonds).

   SOURCE OF TRUTH: the force density of a point is the sum over its bonds, and the elastic energy of the ledger the sum over all, whatever
   the law; the two ends of a bond pull with equal and opposite forces; a bond of a bond-based law pulls with c s V_j and holds c s^2 |xi|
   V_j/4; families, lengths and which bonds are cut as told by the other calls. */
#include "pool.h"
#include "refusal.h"
#include "scene.h"
#include "specimen.h"

typedef struct story { /* a body, and what is done to it                                                                  */
    int32_t space, law, geometry, precision, correction, quadrature, moments;
    double  scatter;
    int     fields, cuts, kind; /* kind: see make                                                                        */
} story;

enum { ELASTIC, PLASTIC, VISCOUS, SOFTENING, OWN_LAW, OWN_STRESS, MIXED };

/* f = s + 20 s^2, and W its integral. */
static int32_t stiffening(void *user, const peri_bond_row *row) {
    (void)user;
    for (int32_t k = 0; k < row->count; ++k) {
        const double s = row->stretch[k];
        row->force[k] = s + 20 * s * s;
        if (row->tangent) row->tangent[k] = 1 + 40 * s;
        if (row->energy) row->energy[k] = 0.5 * s * s + 20 * s * s * s / 3;
    }
    return 0;
}

/* P = H + H^T, and W = (H:H + H:H^T)/2 */
static int32_t symmetric_stress(void *user, const peri_stress_block *block) {
    const int dim = *(const int *)user;
    for (int64_t n = 0; n < block->count; ++n) {
        const double *h = block->gradient + n * dim * dim;
        double *p = block->stress + n * dim * dim;
        for (int a = 0; a < dim; ++a)
            for (int c = 0; c < dim; ++c) {
                p[a * dim + c] = h[a * dim + c] + h[c * dim + a];
                block->energy[n] += 0.5 * h[a * dim + c] * p[a * dim + c];
                for (int q = 0; block->tangent && q < dim * dim; ++q)
                    block->tangent[(n * dim * dim + a * dim + c) * dim * dim + q] = (q == a * dim + c) + (q == c * dim + a);
            }
    }
    return 0;
}

static void add_kind(peri_body *b, const story *t, const specimen *s, int *dim) {
    const int32_t one = peri_id(b, PERI_KIND_MATERIAL, 1);
    peri_softening_desc soft;
    peri_material_desc other = s->material;
    double lo[3] = {0}, hi[3];
    memcpy(hi, s->hi, sizeof hi);
    if (t->kind == SOFTENING) {
        peri_softening_desc_init(&soft, PERI_SOFTENING_BILINEAR);
        soft.strength = 0.004;
        soft.fracture_energy = 1e-3;
        MUST(b, peri_set_softening(b, one, one, &soft));
    }
    if (t->kind == OWN_LAW) MUST(b, peri_set_bond_law(b, one, one, 0, stiffening, dim));
    if (t->kind != MIXED) return;
    other.law = t->law == PERI_LAW_BOND_BASED ? PERI_LAW_CORRESPONDENCE : PERI_LAW_BOND_BASED;
    other.poisson = NAN;
    if (other.law == PERI_LAW_CORRESPONDENCE) other.poisson = 0.2;
    lo[0] = s->hi[0];
    hi[0] = 1.5 * s->hi[0];
    MUST(b, peri_add_box(b, (int32_t)MUST(b, peri_add_material(b, &other)), lo, hi, s->spacing));
}

static peri_body *make(const story *t, int *dim) {
    const int cells = t->space == PERI_SPACE_SOLID ? 4 : 8;
    specimen s = specimen_of(t->space, t->law, 0.2, 0.1, 2.2, cells, cells, cells);
    *dim = t->space == PERI_SPACE_SOLID ? 3 : 2;
    s.desc.geometry = t->geometry;
    s.desc.precision = t->precision;
    if (t->correction) s.desc.correction = t->correction;
    if (t->quadrature) s.desc.quadrature = t->quadrature;
    if (t->moments) s.desc.moments = t->moments;
    if (t->kind == PLASTIC) s.material.yield_shear = 2e-3;
    if (t->kind == VISCOUS) {
        s.material.relaxations = 1;
        s.material.relaxation_part[0] = 0.5;
        s.material.relaxation_time[0] = 1;
    }
    if (t->kind == OWN_STRESS) {
        s.material.stress = symmetric_stress;
        s.material.stress_user = dim;
    }
    peri_body *b = specimen_start(&s);
    const int32_t one = peri_id(b, PERI_KIND_MATERIAL, 1);
    if (t->scatter > 0) MUST(b, peri_add_perturbed_box(b, one, s.lo, s.hi, s.spacing, t->scatter, 7));
    else MUST(b, peri_add_box(b, one, s.lo, s.hi, s.spacing));
    add_kind(b, t, &s, dim);
    MUST(b, peri_build(b));
    return b;
}

/* Moves the body at random by about 1 % of a spacing over a strain of that size, and does what else the story tells. */
static void live(peri_body *b, const story *t) {
    const int64_t n = peri_point_count(b), dim = peri_dimension(b);
    double *u = get(b, PERI_FIELD_POSITION), *grown = (double *)calloc((size_t)n, sizeof *grown);
    uint64_t state = 11;
    chance some = {5, 0.2};
    for (int64_t k = 0; k < n * dim; ++k) u[k] = 0.02 * u[k] + 1e-3 * (test_random(&state) - 0.5);
    if (t->cuts) MUST(b, peri_cut_if(b, PERI_CUT_NOW, by_chance, &some));
    for (int64_t i = 0; i < n; ++i) grown[i] = 0.01 * test_random(&state);
    if (t->fields) put(b, PERI_FIELD_EIGENSTRAIN, grown);
    for (int64_t i = 0; i < n; ++i) grown[i] = 0.5 + test_random(&state);
    if (t->fields) put(b, PERI_FIELD_STIFFNESS, grown);
    put(b, PERI_FIELD_DISPLACEMENT, u);
    free(u);
    free(grown);
}

static double *bonds_of(peri_body *b, int32_t set, int32_t bond, int64_t *count) {
    const int64_t size = MUST(b, peri_size_of_bonds(b, set, bond));
    double *out = (double *)malloc((size_t)size * sizeof *out);
    MUST(b, peri_get_bonds(b, set, bond, out, size));
    if (count) *count = size;
    return out;
}

/* Rows add up to the force densities and to the elastic energy; bound: of the sum of the absolute parts. */
static void check_sums(peri_body *b, double bound) {
    const int64_t dim = peri_dimension(b), n = peri_point_count(b);
    const double thick = 1;
    int64_t count;
    double *i = bonds_of(b, PERI_ALL, PERI_BOND_POINT, &count), *f = bonds_of(b, PERI_ALL, PERI_BOND_FORCE, NULL);
    double *w = bonds_of(b, PERI_ALL, PERI_BOND_ENERGY, NULL), *volume = get(b, PERI_FIELD_VOLUME);
    double *force = get(b, PERI_FIELD_FORCE_DENSITY);
    double *density = get(b, PERI_FIELD_ENERGY_DENSITY), *scale = (double *)calloc((size_t)n, sizeof *scale);
    double off = 0, energy = 0, whole = 0;
    peri_energy e;
    CHECK(count == peri_entry_count(b));
    for (int64_t k = 0; k < count; ++k) {
        const int64_t at = (int64_t)i[k];
        for (int64_t d = 0; d < dim; ++d) force[at * dim + d] -= f[k * dim + d];
        for (int64_t d = 0; d < dim; ++d) scale[at] += fabs(f[k * dim + d]);
        density[at] -= w[k];
        energy += w[k] * volume[at] * thick;
        whole += fabs(w[k]) * volume[at] * thick;
    }
    for (int64_t k = 0; k < n * dim; ++k) off = fmax(off, fabs(force[k]) / (scale[k / dim] + 1e-30));
    CHECK(off < bound);
    MUST(b, peri_get_energy(b, &e));
    CHECK(e.elastic > 0 && fabs(energy - e.elastic) < bound * whole);
    for (int64_t k = 0; k < n; ++k) CHECK(fabs(density[k]) * volume[k] < bound * whole);
    if (off >= bound || fabs(energy - e.elastic) >= bound * whole) printf("    off %g, energy %g of %g\n", off, energy, e.elastic);
    free(i), free(f), free(w), free(volume), free(force), free(density), free(scale);
}

/* V_i f_ij = -V_j f_ji, to rounding of the largest. */
static void check_pairs(peri_body *b, double bound) {
    const int64_t dim = peri_dimension(b);
    int64_t count;
    double *i = bonds_of(b, PERI_ALL, PERI_BOND_POINT, &count), *j = bonds_of(b, PERI_ALL, PERI_BOND_OTHER, NULL), most = 0, off = 0;
    double *f = bonds_of(b, PERI_ALL, PERI_BOND_FORCE, NULL), *volume = get(b, PERI_FIELD_VOLUME);
    for (int64_t k = 0; k < count; ++k)
        for (int64_t l = 0; l < count; ++l) {
            if (i[l] != j[k] || j[l] != i[k]) continue;
            for (int64_t d = 0; d < dim; ++d) {
                const double own = volume[(int64_t)i[k]] * f[k * dim + d];
                most = fmax(most, fabs(own));
                off = fmax(off, fabs(own + volume[(int64_t)j[k]] * f[l * dim + d]));
            }
        }
    CHECK(most > 0 && off < bound * most);
    free(i), free(j), free(f), free(volume);
}

#define STRESS PERI_SPACE_PLANE_STRESS
#define STRAIN PERI_SPACE_PLANE_STRAIN
#define SOLID PERI_SPACE_SOLID
#define LINEAR PERI_GEOMETRY_LINEAR
#define FINITE PERI_GEOMETRY_NONLINEAR

/* All laws in 2D and 3D, small and finite, of the three precisions, lattices and clouds, cut, with fields of material, corrected. */
static void rows_add_up(void) {
    static const int32_t space[3] = {STRESS, STRAIN, SOLID};
    for (int32_t law = PERI_LAW_BOND_BASED; law <= PERI_LAW_CORRESPONDENCE; ++law)
        for (int32_t precision = PERI_PRECISION_DOUBLE; precision <= PERI_PRECISION_SINGLE; ++precision)
            for (int k = 0; k < 6; ++k) {
                const story t = {space[k % 3], law, k < 3 ? FINITE : LINEAR, precision, k == 1 ? PERI_CORRECTION_MOMENT : 0,
                                 k == 5 ? PERI_QUADRATURE_PARTIAL : 0, k == 4 ? PERI_MOMENTS_WHOLE : 0, k % 2 ? 0.5 : 0,
                                 k == 3 || k == 2, k > 1, ELASTIC};
                int dim;
                peri_body *b = make(&t, &dim);
                live(b, &t);
                check_sums(b, precision == PERI_PRECISION_DOUBLE ? 1e-12 : 2e-5);
                if (k == 1) check_pairs(b, precision == PERI_PRECISION_DOUBLE ? 1e-13 : 1e-5);
                peri_body_destroy(b);
            }
}

/* Laws of bonds, inelastic ones, stresses of the caller, and two laws side by side. */
static void other_laws_add_up(void) {
    static const struct {
        int32_t law;
        int     kind;
    } with[7] = {{PERI_LAW_LPS, PLASTIC}, {PERI_LAW_LPS, VISCOUS}, {PERI_LAW_BOND_BASED, SOFTENING}, {PERI_LAW_BOND_BASED, OWN_LAW},
                 {PERI_LAW_CORRESPONDENCE, OWN_STRESS}, {PERI_LAW_LPS, MIXED}, {PERI_LAW_BOND_BASED, MIXED}};
    for (int n = 0; n < 7; ++n)
        for (int k = 0; k < 4; ++k) {
            const story t = {k % 2 ? SOLID : STRAIN, with[n].law, k < 2 ? FINITE : LINEAR, PERI_PRECISION_DOUBLE, 0, 0, 0,
                             k == 1 ? 0.3 : 0, 0, k == 2, with[n].kind};
            int dim;
            peri_body *b = make(&t, &dim);
            live(b, &t);
            if (with[n].kind == PLASTIC || with[n].kind == VISCOUS) (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 3, 0.01, 0);
            check_sums(b, 1e-12);
            if (k == 0) check_pairs(b, 1e-13);
            peri_body_destroy(b);
        }
}

/* c s V_j along the bond, c s^2 |xi| V_j/4 in it; both 0 once it is cut. */
static void bond_based_by_hand(void) {
    const story t = {STRESS, PERI_LAW_BOND_BASED, FINITE, PERI_PRECISION_DOUBLE, 0, 0, 0, 0.6, 0, 1, ELASTIC};
    int dim;
    peri_body *b = make(&t, &dim);
    int64_t count, dead = 0;
    double c, s0;
    live(b, &t);
    MUST(b, peri_get_bond_constants(b, peri_id(b, PERI_KIND_MATERIAL, 1), peri_id(b, PERI_KIND_MATERIAL, 1), &c, &s0));
    double *is = bonds_of(b, PERI_ALL, PERI_BOND_POINT, &count), *js = bonds_of(b, PERI_ALL, PERI_BOND_OTHER, NULL);
    double *length = bonds_of(b, PERI_ALL, PERI_BOND_LENGTH, NULL), *volume = bonds_of(b, PERI_ALL, PERI_BOND_VOLUME, NULL);
    double *weight = bonds_of(b, PERI_ALL, PERI_BOND_WEIGHT, NULL), *intact = bonds_of(b, PERI_ALL, PERI_BOND_INTACT, NULL);
    double *stretch = bonds_of(b, PERI_ALL, PERI_BOND_STRETCH, NULL), *force = bonds_of(b, PERI_ALL, PERI_BOND_FORCE, NULL);
    double *energy = bonds_of(b, PERI_ALL, PERI_BOND_ENERGY, NULL);
    double *x = get(b, PERI_FIELD_POSITION), *u = get(b, PERI_FIELD_DISPLACEMENT), *v = get(b, PERI_FIELD_VOLUME);
    for (int64_t k = 0; k < count; ++k) {
        const int32_t i = (int32_t)is[k], j = (int32_t)js[k];
        const double xi[2] = {x[2 * j] - x[2 * i], x[2 * j + 1] - x[2 * i + 1]};
        const double y[2] = {xi[0] + u[2 * j] - u[2 * i], xi[1] + u[2 * j + 1] - u[2 * i + 1]};
        const double long_ = hypot(xi[0], xi[1]), now = hypot(y[0], y[1]), s = now / long_ - 1, whole = peri_bond_is_intact(b, i, j);
        CHECK_NEAR(length[k], long_, 1e-12, 0);
        CHECK_NEAR(volume[k], v[j], 1e-12, 0);
        CHECK_NEAR(weight[k], v[j], 1e-12, 0);
        CHECK_NEAR(intact[k], whole, 0, 0);
        CHECK_NEAR(stretch[k], s, 1e-10, 1e-13);
        for (int d = 0; d < 2; ++d) CHECK_NEAR(force[2 * k + d], whole * c * s * v[j] * y[d] / now, 1e-9, 1e-12 * c * v[j]);
        CHECK_NEAR(energy[k], whole * c * s * s * long_ * v[j] / 4, 1e-9, 1e-14 * c * v[j]);
        dead += whole == 0;
    }
    CHECK(dead > 10 && dead == peri_broken_count(b) * 2);
    free(is), free(js), free(length), free(volume), free(weight), free(intact), free(stretch), free(force), free(energy);
    free(x), free(u), free(v);
    peri_body_destroy(b);
}

/* Correspondence, small strains, uniform: K = m/2 in the plane, so that a bond holds 1/2 V_j (sigma xi).(e xi) 2/m; e is the strain less
   the eigenstrain. Of points whose family is whole. */
static void gradient_by_hand(void) {
    const story t = {STRAIN, PERI_LAW_CORRESPONDENCE, LINEAR, PERI_PRECISION_DOUBLE, 0, 0, 0, 0, 0, 0, ELASTIC};
    const double h[2][2] = {{2e-3, 1e-3}, {-3e-3, 5e-4}}, eigen = 1e-3;
    const double e[2] = {h[0][0] - eigen, h[1][1] - eigen}; /* beside h[0][1] and h[1][0]: sigma is symmetric */
    int dim, whole = 0;
    peri_body *b = make(&t, &dim);
    const int64_t n = peri_point_count(b);
    double *x = get(b, PERI_FIELD_POSITION), *u = get(b, PERI_FIELD_DISPLACEMENT), *grown = (double *)malloc((size_t)n * sizeof *grown);
    for (int64_t i = 0; i < n; ++i) {
        grown[i] = eigen;
        for (int a = 0; a < 2; ++a) u[2 * i + a] = h[a][0] * x[2 * i] + h[a][1] * x[2 * i + 1];
    }
    put(b, PERI_FIELD_EIGENSTRAIN, grown);
    put(b, PERI_FIELD_DISPLACEMENT, u);
    for (int32_t i = 0; i < n; ++i) {
        double s[3], m = 0;
        int64_t count;
        if (fmin(x[2 * i], x[2 * i + 1]) < 0.22 || fmax(x[2 * i], x[2 * i + 1]) > 0.58) continue;
        const int32_t set = (int32_t)MUST(b, peri_select_points(b, NULL, 1, &i));
        double *j = bonds_of(b, set, PERI_BOND_OTHER, &count), *w = bonds_of(b, set, PERI_BOND_ENERGY, NULL);
        MUST(b, peri_get_field_at(b, PERI_FIELD_STRESS, 1, &i, s, 3));
        for (int pass = 0; pass < 2; ++pass)
            for (int64_t k = 0; k < count; ++k) {
                const double p = x[2 * (int)j[k]] - x[2 * i], q = x[2 * (int)j[k] + 1] - x[2 * i + 1];
                const double work = (s[0] * p + s[2] * q) * (e[0] * p + h[0][1] * q) + (s[2] * p + s[1] * q) * (h[1][0] * p + e[1] * q);
                if (!pass) m += 0.01 * (p * p + q * q);
                else CHECK_NEAR(w[k], 0.01 * work / m, 1e-9, 1e-14);
            }
        free(j), free(w);
        whole++;
    }
    CHECK(whole == 16);
    free(x), free(u), free(grown);
    peri_body_destroy(b);
}

/* Of a set: its rows of all, point after point; partial volumes add up to the area of the disk. */
static void sets_and_rows(void) {
    const story t = {STRESS, PERI_LAW_LPS, LINEAR, PERI_PRECISION_DOUBLE, 0, PERI_QUADRATURE_PARTIAL, 0, 0, 0, 0, ELASTIC};
    const int32_t some[3] = {36, 5, 60};
    int dim;
    peri_body *b = make(&t, &dim);
    const int32_t set = (int32_t)MUST(b, peri_select_points(b, NULL, 3, some));
    int64_t count, all, at = 0;
    live(b, &t);
    for (int32_t what = PERI_BOND_POINT; what <= PERI_BOND_ENERGY; ++what) {
        const int parts = what == PERI_BOND_FORCE ? 2 : 1;
        double *mine = bonds_of(b, set, what, &count), *whole = bonds_of(b, PERI_ALL, what, &all);
        double *point = bonds_of(b, PERI_ALL, PERI_BOND_POINT, NULL);
        at = 0;
        for (int64_t k = 0; k < all; ++k) {
            const int32_t i = (int32_t)point[k / parts];
            if (i != 5 && i != 36 && i != 60) continue;
            CHECK(at < count && mine[at] == whole[k]);
            at++;
        }
        CHECK(at == count && all == parts * peri_entry_count(b));
        free(mine), free(whole), free(point);
    }
    double *point = bonds_of(b, set, PERI_BOND_POINT, &count), *volume = bonds_of(b, set, PERI_BOND_VOLUME, NULL), sum = 0.01;
    for (int64_t k = 0; k < count; ++k) sum += point[k] == 36 ? volume[k] : 0;
    CHECK_NEAR(sum, acos(-1.0) * 0.22 * 0.22, 1e-6, 0); /* partial volumes are single */
    free(point), free(volume);
    peri_body_destroy(b);
}

static void refused(void) {
    const story t = {STRESS, PERI_LAW_CORRESPONDENCE, FINITE, PERI_PRECISION_DOUBLE, 0, 0, 0, 0, 0, 0, ELASTIC};
    int dim;
    double out[8];
    peri_body *b = make(&t, &dim), *none = NULL;
    const int64_t size = peri_size_of_bonds(b, PERI_ALL, PERI_BOND_FORCE);
    CHECK(peri_size_of_bonds(NULL, PERI_ALL, PERI_BOND_FORCE) == PERI_ERROR_ARGUMENT);
    CHECK(peri_get_bonds(NULL, PERI_ALL, PERI_BOND_FORCE, out, 8) == PERI_ERROR_ARGUMENT);
    REFUSE(b, PERI_ERROR_CHOICE, peri_size_of_bonds(b, PERI_ALL, PERI_BOND_ENERGY + 1));
    REFUSE(b, PERI_ERROR_CHOICE, peri_get_bonds(b, PERI_ALL, PERI_BOND_POINT - 1, out, 8));
    FIELD_IS("bond");
    REFUSE(b, PERI_ERROR_ID_NONE, peri_size_of_bonds(b, 7, PERI_BOND_POINT));
    REFUSE(b, PERI_ERROR_ID_NONE, peri_get_bonds(b, 7, PERI_BOND_POINT, out, 8));
    REFUSE(b, PERI_ERROR_ARGUMENT, peri_get_bonds(b, PERI_ALL, PERI_BOND_POINT, NULL, size));
    REFUSE(b, PERI_ERROR_CAPACITY, peri_get_bonds(b, PERI_ALL, PERI_BOND_FORCE, out, size - 1));
    CHECK(seen.value == (double)size && size == 2 * peri_entry_count(b));
    specimen s = specimen_of(STRESS, PERI_LAW_LPS, 0.2, 0.1, 2.2, 3, 3, 0);
    none = specimen_start(&s);
    REFUSE(none, PERI_ERROR_ORDER, peri_size_of_bonds(none, PERI_ALL, PERI_BOND_POINT));
    REFUSE(none, PERI_ERROR_ORDER, peri_get_bonds(none, PERI_ALL, PERI_BOND_POINT, out, 8));
    peri_body_destroy(none);
    peri_body_destroy(b);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(rows_add_up);
    RUN(other_laws_add_up);
    RUN(bond_based_by_hand);
    RUN(gradient_by_hand);
    RUN(sets_and_rows);
    RUN(refused);
    return test_end("test_bonds");
}
