/* SPDX-License-Identifier: MIT */
/* test_strengths.c - criteria of stress under uniform strain: principal stress, von Mises, Mohr-Coulomb.

   SOURCE OF TRUTH: Hooke's law of a uniform strain, and what the stress puts on planes, worked out here: bonds break where the worst plane
   has the limit, first those along the vector of the lattice whose plane has the most. Rankine: along the
   largest principal stress; Mohr-Coulomb: 45 degrees - phi/2 off it. Von Mises's stress of a bar is its tension, of shear sqrt(3) tau. */
#include "solid.h"
#include "equilibrium.h"
#include "pool.h"

#define LIMIT 0.004 /* stress; over YOUNG a strain of about 1.3e-3 */
#define TAN(degrees) tan((degrees) * PI / 180)

typedef struct strength {
    int32_t criterion;
    double  friction; /* degrees */
} strength;

static void take_strength(peri_material_desc *m, strength c) {
    m->criterion = c.criterion;
    if (c.criterion == PERI_CRITERION_MOHR_COULOMB) {
        m->cohesion = LIMIT;
        m->friction_angle = c.friction * PI / 180;
    } else
        m->strength = LIMIT;
}

/* sigma[6]: what the plane with the normal n bears: the value that is held to LIMIT. */
static double on_plane(strength c, int dim, const double *sigma, const double *n) {
    double t[3], normal = 0, square = 0, length = 0;
    int a, k;
    for (a = 0; a < dim; ++a) length += n[a] * n[a];
    for (a = 0; a < dim; ++a) {
        t[a] = 0;
        for (k = 0; k < dim; ++k) t[a] += sigma[packed(dim, a, k)] * n[k] / sqrt(length);
        normal += t[a] * n[a] / sqrt(length);
        square += t[a] * t[a];
    }
    if (c.criterion == PERI_CRITERION_PRINCIPAL_STRESS) return normal;
    return sqrt(fmax(0, square - normal * normal)) + TAN(c.friction) * normal;
}

/* By the second invariant of the deviator, sigma across the plane included. */
static double von_mises(const solid *s, const double *sigma) {
    const int dim = dim_of(s->space);
    double full[3] = {sigma[0], sigma[1], dim == 3 ? sigma[2] : s->space == PERI_SPACE_PLANE_STRAIN ? s->nu * (sigma[0] + sigma[1]) : 0};
    const double mean = (full[0] + full[1] + full[2]) / 3;
    double j2 = 0;
    int k;
    for (k = 0; k < 3; ++k) j2 += 0.5 * (full[k] - mean) * (full[k] - mean);
    for (k = dim; k < parts_of(dim); ++k) j2 += sigma[k] * sigma[k];
    return sqrt(3 * j2);
}

/* The principal values of xx yy zz xy yz xz, descending: the roots of the characteristic cubic, by Viete's cosines. */
static void principal(const double *s, double *value) {
    const double mean = (s[0] + s[1] + s[2]) / 3, x = s[0] - mean, y = s[1] - mean, z = s[2] - mean;
    const double size = sqrt((x * x + y * y + z * z + 2 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5])) / 6);
    const double det = x * (y * z - s[4] * s[4]) - s[3] * (s[3] * z - s[4] * s[5]) + s[5] * (s[3] * s[4] - y * s[5]);
    const double angle = acos(fmax(-1, fmin(1, det / (2 * size * size * size)))) / 3;
    int k;
    for (k = 0; k < 3; ++k) value[k] = mean + 2 * size * cos(angle + (k == 0 ? 0 : k == 1 ? -2 : 2) * PI / 3);
}

/* The most of any plane: Rankine, Mohr-Coulomb. In planes of those normal to them. */
static double most_of_planes(const solid *s, strength c, const double *sigma) {
    const int dim = dim_of(s->space);
    double n[3];
    if (c.criterion == PERI_CRITERION_VON_MISES) return von_mises(s, sigma);
    if (dim == 2) {
        const double mean = 0.5 * (sigma[0] + sigma[1]), radius = hypot(0.5 * (sigma[0] - sigma[1]), sigma[2]);
        if (c.criterion == PERI_CRITERION_PRINCIPAL_STRESS) return mean + radius;
        return radius / cos(c.friction * PI / 180) + mean * TAN(c.friction);
    }
    principal(sigma, n);
    if (c.criterion == PERI_CRITERION_PRINCIPAL_STRESS) return n[0];
    return 0.5 * ((n[0] - n[2]) / cos(c.friction * PI / 180) + (n[0] + n[2]) * TAN(c.friction));
}

/* That of the best vector of the lattice within the horizon: the first bonds to break lie along it. */
static double most_of_lattice(const solid *s, strength c, const double *sigma) {
    const int dim = dim_of(s->space), m = (int)s->ratio;
    double most = -HUGE_VAL;
    int x, y, z;
    if (c.criterion == PERI_CRITERION_VON_MISES) return von_mises(s, sigma);
    for (x = -m; x <= m; ++x)
        for (y = -m; y <= m; ++y)
            for (z = dim == 3 ? -m : 0; z <= (dim == 3 ? m : 0); ++z) {
                const double n[3] = {x, y, z};
                if (x * x + y * y + z * z == 0 || x * x + y * y + z * z > s->ratio * s->ratio + 1e-9) continue;
                most = fmax(most, on_plane(c, dim, sigma, n));
            }
    return most;
}

/* Points whose families lack directions: a horizon from two faces, whose bonds are left whole. */
static int32_t by_an_edge(void *user, int64_t index, const double *x) {
    const double *hi = (const double *)user; /* [3] and the horizon */
    int faces = 0, d;
    (void)index;
    for (d = 0; d < 3; ++d) faces += hi[d] > 0 && (x[d] < hi[3] || x[d] > hi[d] - hi[3]);
    return faces >= 2;
}
static void spare_edges(peri_body *b, const specimen *p, int dim) {
    double hi[4] = {p->hi[0], p->hi[1], dim == 3 ? p->hi[2] : 0, p->desc.horizon};
    MUST(b, peri_set_no_fail(b, (int32_t)MUST(b, peri_select_if(b, NULL, by_an_edge, hi)), 1));
}

typedef struct first {
    strength      c;
    const double *sigma;
    int           dim;
    double        most, margin;
    int64_t       count, wrong; /* bonds that broke; those whose plane has less than the most */
    const double *x;
} first;

static int32_t note_first(void *user, int32_t i, int32_t j, double time, double stretch) {
    first *f = (first *)user;
    double n[3];
    int a;
    (void)time;
    (void)stretch;
    for (a = 0; a < f->dim; ++a) n[a] = f->x[j * f->dim + a] - f->x[i * f->dim + a];
    f->count++;
    if (f->c.criterion != PERI_CRITERION_VON_MISES && on_plane(f->c, f->dim, f->sigma, n) < f->most * (1 - 3 * f->margin)) f->wrong++;
    return 0;
}

/* Bonds that break where the body has the strain `factor` times eps, and is turned by `turn`. */
static int64_t broken_at(peri_body *b, const double *eps, double factor, double turn) {
    const int dim = peri_dimension(b);
    double h[9], scaled[6];
    int k;
    MUST(b, peri_reset(b));
    for (k = 0; k < parts_of(dim); ++k) scaled[k] = factor * eps[k];
    strain_matrix(dim, scaled, h);
    for (k = 0; turn != 0 && k < dim; ++k) { /* R (1 + eps) - 1, about z */
        const double x = h[k] + (k == 0), y = h[dim + k] + (k == 1);
        h[k] = cos(turn) * x - sin(turn) * y - (k == 0);
        h[dim + k] = sin(turn) * x + cos(turn) * y - (k == 1);
    }
    stretch_by(b, h);
    peri_evaluate_desc e;
    peri_evaluate_report r;
    peri_evaluate_desc_init(&e);
    e.fracture = 1;
    MUST(b, peri_evaluate(b, &e, &r));
    return r.broken;
}

/* As above, in equilibrium, all points being held: the factor at which the first bonds break is that of the limit. */
typedef struct hold {
    const double *x, *eps;
    int           dim;
    double        turn; /* about z */
} hold;
static int32_t strained(void *user, double time, int64_t count, const int32_t *points, double *value) {
    const hold *h = (const hold *)user;
    int64_t k;
    int a, c;
    for (k = 0; k < count; ++k)
        for (a = 0; a < h->dim; ++a) {
            value[k * h->dim + a] = 0;
            for (c = 0; c < h->dim; ++c) value[k * h->dim + a] += time * h->eps[packed(h->dim, a, c)] * h->x[points[k] * h->dim + c];
        }
    for (k = 0; h->turn != 0 && k < count; ++k) { /* R (x + u) - x */
        double *u = &value[k * h->dim];
        const double *at = &h->x[points[k] * h->dim], x = at[0] + u[0], y = at[1] + u[1];
        u[0] = cos(h->turn) * x - sin(h->turn) * y - at[0];
        u[1] = sin(h->turn) * x + cos(h->turn) * y - at[1];
    }
    return 0;
}

static const strength all_strengths[] = {{PERI_CRITERION_PRINCIPAL_STRESS, 0}, {PERI_CRITERION_VON_MISES, 0},
                                         {PERI_CRITERION_MOHR_COULOMB, 0},     {PERI_CRITERION_MOHR_COULOMB, 30}};
enum { STRENGTHS = 4, STATES = 4 };

/* Tension, shear, compression and a bit of all, as stress; the strain of which is by Hooke's law. */
static void strain_of(const solid *s, int state, double *eps, double *sigma) {
    static const double states[STATES][6] = {
        {1, 0, 0, 0, 0, 0}, {0, 0, 0, 0.5, 0, 0}, {0, -2, 0, 0, 0, 0}, {0.9, -0.4, 0.2, 0.35, -0.1, 0.3}};
    const int dim = dim_of(s->space);
    const moduli e = moduli_of(s->space, s->nu);
    double trace = 0;
    int k;
    for (k = 0; k < parts_of(dim); ++k) sigma[k] = LIMIT * states[state][dim == 2 && k == 2 ? 3 : k];
    for (k = 0; k < dim; ++k) trace += sigma[k];
    for (k = 0; k < parts_of(dim); ++k) eps[k] = (sigma[k] - (k < dim ? e.lambda * trace / (2 * e.mu + dim * e.lambda) : 0)) / (2 * e.mu);
}

/* None breaks 0.1 % below, those of the right direction 0.1 % above; whatever law, space, kernel, precision. */
static void at_the_limit(const solid *s, strength c, int state, int32_t kernel, double turn) {
    const int dim = dim_of(s->space);
    specimen p = solid_specimen(s, 8, dim == 3 ? 7 : 9, dim == 3 ? 6 : 1);
    first f;
    double eps[6], sigma[6];
    const double margin = s->geometry == PERI_GEOMETRY_NONLINEAR ? 1e-2 : s->precision == PERI_PRECISION_DOUBLE ? 1e-3 : 3e-3;
    strain_of(s, state, eps, sigma);
    f.c = c;
    f.sigma = sigma;
    f.dim = dim;
    f.margin = margin;
    f.count = f.wrong = 0;
    f.most = most_of_lattice(s, c, sigma);
    const double most = most_of_planes(s, c, sigma);
    if (!(f.most > 0.05 * LIMIT)) return; /* Rankine under compression */
    p.desc.kernel = kernel;
    take_strength(&p.material, c);
    peri_body *b = specimen_make(&p);
    double *x = get(b, PERI_FIELD_POSITION);
    f.x = x;
    spare_edges(b, &p, dim);
    MUST(b, peri_on_break(b, note_first, &f));
    const int64_t below = broken_at(b, eps, LIMIT / most * (1 - margin), turn);
    CHECK(below == 0 && f.count == 0);
    const int64_t above = broken_at(b, eps, LIMIT / most * (1 + margin), turn);
    CHECK(above > 0 && f.wrong == 0 && f.count == above);
    if (below != 0 || above == 0 || f.wrong)
        printf("    %s %s criterion %d, state %d, kernel %d: %d and %d bonds, %d wrong\n", space_name[s->space % 100],
               law_name[s->law % 100], (int)c.criterion, state, (int)kernel, (int)below, (int)above, (int)f.wrong);
    free(x);
    peri_body_destroy(b);
}

static void uniform_states(void) {
    static const int32_t spaces[3] = {PERI_SPACE_PLANE_STRESS, PERI_SPACE_PLANE_STRAIN, PERI_SPACE_SOLID};
    int k, c, state;
    int32_t law, precision;
    for (k = 0; k < 3; ++k)
        for (law = peri__first_law; law < peri__end_law; ++law)
            for (c = 0; c < STRENGTHS; ++c)
                for (state = 0; state < STATES; ++state) {
                    solid s = solid_of(spaces[k], law, PERI_CORRECTION_NONE);
                    if (k == 2) s.ratio = 2;
                    at_the_limit(&s, all_strengths[c], state, (c + state) % 3 ? PERI_KERNEL_BEST : PERI_KERNEL_LIST, 0);
                    if (law == PERI_LAW_LPS && k < 2) at_the_limit(&s, all_strengths[c], state, PERI_KERNEL_REFERENCE, 0);
                    if (law == PERI_LAW_LPS && k == 0)
                        for (precision = PERI_PRECISION_MIXED; precision <= PERI_PRECISION_SINGLE; ++precision) {
                            s.precision = precision;
                            at_the_limit(&s, all_strengths[c], state, PERI_KERNEL_BEST, 0);
                        }
                }
}

/* Frames: large turns change nothing, where the geometry is not linear; which changes stress by some times the strain. */
static void turned_states(void) {
    int c, k;
    for (c = 0; c < STRENGTHS; ++c)
        for (k = 0; k < 2; ++k) {
            solid s = solid_of(k ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRAIN, k ? PERI_LAW_BOND_BASED : PERI_LAW_CORRESPONDENCE,
                               PERI_CORRECTION_NONE);
            if (k) s.ratio = 2;
            s.geometry = PERI_GEOMETRY_NONLINEAR;
            at_the_limit(&s, all_strengths[c], 3, PERI_KERNEL_BEST, 2.0);
        }
}

static int32_t note_factor(void *user, int32_t i, int32_t j, double time, double stretch) {
    double *factor = (double *)user;
    (void)i;
    (void)j;
    (void)stretch;
    if (*factor == 0) *factor = time;
    return 0;
}

static void equilibria(void) {
    int c, way;
    for (c = 0; c < STRENGTHS; ++c)
        for (way = 0; way < 4; ++way) {
            solid s = solid_of(way & 1 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRAIN, way & 1 ? PERI_LAW_LPS : PERI_LAW_CORRESPONDENCE,
                               PERI_CORRECTION_NONE);
            double eps[6], sigma[6], factor = 0;
            if (way & 1) s.ratio = 2;
            if (way & 2) s.geometry = PERI_GEOMETRY_NONLINEAR;
            specimen p = solid_specimen(&s, 8, 8, way & 1 ? 6 : 1);
            strain_of(&s, 3, eps, sigma);
            const double most = most_of_planes(&s, all_strengths[c], sigma);
            take_strength(&p.material, all_strengths[c]);
            peri_body *b = specimen_make(&p);
            double *x = get(b, PERI_FIELD_POSITION);
            hold h = {x, eps, dim_of(s.space), way & 2 ? 2.0 : 0};
            peri_solve_desc st = statics_of(1e-9);
            peri_solve_report r;
            MUST(b, peri_prescribe_displacement(b, PERI_ALL, all_axes(h.dim), NULL, strained, &h));
            spare_edges(b, &p, h.dim);
            MUST(b, peri_on_break(b, note_factor, &factor));
            st.load_to = 3;
            st.control = PERI_CONTROL_FRACTURE;
            st.breaks = 1;
            if (way & 2) { /* load steps of a body that is turned far: between two of them */
                st.control = PERI_CONTROL_LOAD;
                st.load_to = 1.01 * LIMIT / most;
                st.steps = 3;
                st.criticality = 0;
                st.load_from = 0.98 * LIMIT / most;
            }
            memset(&r, 0, sizeof r);
            (void)peri_solve(b, &st, &r);
            if (way & 2) CHECK(r.broken > 0 && factor > 0.991 * LIMIT / most && factor < 1.011 * LIMIT / most);
            else CHECK_NEAR(factor, LIMIT / most, 1e-6, 0);
            free(x);
            peri_body_destroy(b);
        }
}

/* Cuts leave the stress of a uniform strain as it is, though the families beside them are others than before: what is left along the
   tension breaks. Of 8 points in each of 9 rows 7 + 6 + 5 bonds lie along x, of which 6 meet the middle. */
static void beside_cuts(void) {
    for (int32_t law = peri__first_law; law < peri__end_law; ++law) {
        solid s = solid_of(PERI_SPACE_PLANE_STRAIN, law, PERI_CORRECTION_NONE);
        specimen p = solid_specimen(&s, 8, 9, 1);
        const double from[2] = {4 * H, -1}, to[2] = {4 * H, 10};
        double eps[6], sigma[6], h[4];
        peri_evaluate_desc e;
        peri_evaluate_report r;
        int k;
        strain_of(&s, 0, eps, sigma);
        take_strength(&p.material, all_strengths[0]);
        peri_body *b = specimen_make(&p);
        CHECK(broken_at(b, eps, 1 - 1e-3, 0) == 0);
        CHECK(MUST(b, peri_cut_segment(b, PERI_CUT_NOW, from, to)) > 9 * 6);
        for (k = 0; k < 3; ++k) eps[k] *= 1 + 1e-3;
        strain_matrix(2, eps, h);
        stretch_by(b, h);
        peri_evaluate_desc_init(&e);
        e.fracture = 1;
        MUST(b, peri_evaluate(b, &e, &r));
        CHECK(r.broken == 9 * (7 + 6 + 5 - 6));
        peri_body_destroy(b);
    }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(uniform_states);
    RUN(turned_states);
    RUN(equilibria);
    RUN(beside_cuts);
    return test_end("test_strengths");
}
