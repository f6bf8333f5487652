/* SPDX-License-Identifier: MIT */
/* test_hole.c - a round hole in a plate under tension S.

   WHAT CAN BE COMPARED  The stress at the rim, 3 S, is that of a point. A family there lies on one side, averages over a horizon, in which
   Kirsch's stress falls by up to 7 S horizon/a, and sees the steps of the lattice: next to the rim the stress stays some 10 % too low
   however fine the lattice is (printed). So stresses are compared away from the rim, and the 3 S is had by going on to the rim
   with Kirsch's own powers, c0 + c2 (a/r)^2 + c4 (a/r)^4, fitted to the ligament beyond a horizon.

   SOURCE OF TRUTH
     Kirsch 1898 (Timoshenko, Goodier, Theory of Elasticity, art. 35): stresses and displacements about a hole in an infinite plate.
     Prescribed on a frame two horizons wide, they make the finite plate part of the infinite one, with no correction for its width.
     Finite width, d = 2 a over W: K = (2 + (1 - d/W)^3)/(1 - d/W), Heywood 1952, after Howland's series of 1930; at d/W = 0.2 both give
     3.14.
   BOUNDS  A hole made of cells has its rim where it should be to half a spacing, so a stress has an error of half a spacing times its
   slope over the radius: 7 S/a at the rim, 2.69 S/a at 1.3 a. */
#include "peri_test.h"

#define YOUNG  200e9 /* [Pa]                                                                                              */
#define NU     0.3
#define RADIUS 0.01  /* [m]                                                                                               */
#define STRESS 100e6 /* [Pa]                                                                                              */

typedef struct plate {
    int32_t law, correction;
    int     cells;      /* per radius                                                                                    */
    int     framed;     /* Kirsch's displacements on a frame outside, or a strip with tractions on its ends              */
    int     wide, high; /* half sides in radii                                                                           */
} plate;

static double spacing_of(const plate *p) { return RADIUS / p->cells; }
static double horizon_of(const plate *p) { return 3 * spacing_of(p); }

/* The strip is 10 a wide, so that d/W = 0.2, and long enough that its ends do not matter (16 a: 1 % of K; 24 a and 32 a: the same). */
static plate plate_of(int32_t law, int32_t correction, int cells, int framed) {
    plate p;
    p.law = law;
    p.correction = correction;
    p.cells = cells;
    p.framed = framed;
    p.wide = framed ? 3 : 5;
    p.high = framed ? 3 : 12;
    return p;
}

/* Tension STRESS along y. */
static void kirsch(const double *x, double *u, double *sigma) {
    double r = sqrt(x[0] * x[0] + x[1] * x[1]), cs = x[0] / r, sn = x[1] / r, c2 = cs * cs - sn * sn, s2 = 2 * cs * sn;
    double mu = YOUNG / (2 * (1 + NU)), kappa = (3 - NU) / (1 + NU), p = RADIUS / r, q = p * p;
    double ur = STRESS * RADIUS / (8 * mu) * ((kappa - 1 - 2 * c2) / p + 2 * p * (1 - (kappa + 1) * c2) + 2 * p * q * c2);
    double ut = STRESS * RADIUS / (8 * mu) * (2 / p + 2 * p * (kappa - 1) + 2 * p * q) * s2;
    double rr = STRESS / 2 * (1 - q - (1 - 4 * q + 3 * q * q) * c2), tt = STRESS / 2 * (1 + q + (1 + 3 * q * q) * c2);
    double rt = STRESS / 2 * (1 + 2 * q - 3 * q * q) * s2;
    u[0] = ur * cs - ut * sn;
    u[1] = ur * sn + ut * cs;
    sigma[0] = rr * cs * cs + tt * sn * sn - 2 * rt * sn * cs;
    sigma[1] = rr * sn * sn + tt * cs * cs + 2 * rt * sn * cs;
    sigma[2] = (rr - tt) * sn * cs + rt * c2;
}

static int32_t outside_hole(void *user, int64_t index, const double *x) {
    (void)user, (void)index;
    return x[0] * x[0] + x[1] * x[1] > RADIUS * RADIUS;
}
static int32_t in_frame(void *user, int64_t index, const double *x) {
    const plate *p = (const plate *)user;
    (void)index;
    return fabs(x[0]) > p->wide * RADIUS || fabs(x[1]) > p->high * RADIUS;
}

static int32_t kirsch_support(void *user, double time, int64_t count, const int32_t *points, double *value) {
    const double *x = (const double *)user;
    int64_t k;
    double sigma[3];
    for (k = 0; k < count; ++k) {
        kirsch(&x[2 * points[k]], &value[2 * k], sigma);
        value[2 * k] *= time;
        value[2 * k + 1] *= time;
    }
    return 0;
}

typedef struct solved {
    peri_body *body;
    int64_t    n, iterations;
    double    *x, *sigma;
} solved;

static double *read_field(peri_body *b, int32_t field) {
    int64_t n = MUST(b, peri_size_of_field(b, field));
    double *out = (double *)calloc((size_t)n, sizeof *out);
    (void)MUST(b, peri_get_field(b, field, out, n));
    return out;
}

static void free_solved(solved *s) {
    peri_body_destroy(s->body);
    free(s->x);
    free(s->sigma);
}

static solved solve_plate(const plate *p) {
    const double margin = p->framed ? 2 * horizon_of(p) : 0, up[2] = {0, STRESS}, down[2] = {0, -STRESS};
    double hi[2], lo[2], deep[2];
    peri_body_desc d;
    peri_material_desc m;
    peri_solve_desc st;
    peri_solve_report report;
    peri_body *b = NULL;
    solved s;
    hi[0] = p->wide * RADIUS + margin;
    hi[1] = p->high * RADIUS + margin;
    lo[0] = -hi[0];
    lo[1] = -hi[1];
    peri_body_desc_init(&d);
    d.space = PERI_SPACE_PLANE_STRESS;
    d.geometry = PERI_GEOMETRY_LINEAR;
    d.correction = p->correction;
    d.horizon = horizon_of(p);
    d.threads = 1;
    CHECK(peri_body_create(&d, &b, NULL) == PERI_OK);
    peri_material_desc_init(&m, p->law);
    m.young = YOUNG;
    m.poisson = NU;
    m.density = 7850;
    (void)MUST(b, peri_add_material(b, &m));
    (void)MUST(b, peri_add_shape(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo, hi, spacing_of(p), outside_hole, NULL));
    (void)MUST(b, peri_build(b));
    s.body = b;
    s.n = peri_point_count(b);
    s.x = read_field(b, PERI_FIELD_POSITION);
    peri_solve_desc_init(&st);
    if (p->framed) {
        int32_t frame = (int32_t)MUST(b, peri_select_if(b, "frame", in_frame, (void *)p));
        (void)MUST(b, peri_prescribe_displacement(b, frame, PERI_AXIS_X | PERI_AXIS_Y, NULL, kirsch_support, s.x));
    } else {
        int32_t top, bottom;
        deep[0] = lo[0];
        deep[1] = hi[1] - 2 * d.horizon;
        top = peri_select_box(b, "top", deep, hi);
        deep[0] = hi[0];
        deep[1] = lo[1] + 2 * d.horizon;
        bottom = peri_select_box(b, "bottom", lo, deep);
        (void)MUST(b, peri_apply_traction(b, top, 2 * hi[0], up, up, NULL, NULL));
        (void)MUST(b, peri_apply_traction(b, bottom, 2 * hi[0], down, down, NULL, NULL));
        st.loose = PERI_LOOSE_PINNED;
    }
    (void)MUST(b, peri_solve(b, &st, &report));
    s.iterations = report.iterations;
    s.sigma = read_field(b, PERI_FIELD_STRESS);
    return s;
}

/* The ligament: r/a and sigma_yy/S along it, from the rim. */
typedef struct ligament {
    double r[200], stress[200];
    int    count;
} ligament;

typedef struct hole {
    double   line, field; /* |sigma - Kirsch|/S from 1.3 a to 2.5 a: largest of sigma_yy on the ligament; root mean square of all */
    ligament way;
} hole;

/* The stress at the rim: that of the fit of (a/r)^0, ^2, ^4 and, with terms = 4, ^-2 to the ligament from `from` to 2.5 a. */
static double at_rim(const ligament *way, double from, int terms) {
    double a[4][5] = {{0}}, sum = 0;
    int i, j, k;
    for (i = 0; i < way->count; ++i) {
        double power[4], q = way->r[i] * way->r[i];
        power[0] = 1;
        power[1] = 1 / q;
        power[2] = 1 / (q * q);
        power[3] = q;
        for (k = 0; k < terms && way->r[i] > from && way->r[i] < 2.5; ++k) {
            for (j = 0; j < terms; ++j) a[k][j] += power[k] * power[j];
            a[k][4] += power[k] * way->stress[i];
        }
    }
    for (i = 0; i < terms; ++i) /* Gauss, Jordan: positive definite                                                       */
        for (j = 0; j < terms; ++j) {
            double f = a[j][i] / a[i][i];
            for (k = i; k < 5 && j != i; ++k) a[j][k] -= f * a[i][k];
        }
    for (i = 0; i < terms; ++i) sum += a[i][4] / a[i][i];
    return sum;
}
static double beyond(const plate *p) { return 1 + horizon_of(p) / RADIUS; }

static hole measure(const plate *p) {
    solved s = solve_plate(p);
    hole e;
    int64_t i, count = 0;
    int k;
    memset(&e, 0, sizeof e);
    for (i = 0; i < s.n; ++i) {
        const double *x = &s.x[2 * i], *sigma = &s.sigma[3 * i];
        double r = sqrt(x[0] * x[0] + x[1] * x[1]) / RADIUS, u[2], want[3];
        int on = x[0] > 0 && x[1] > 0 && x[1] < spacing_of(p);
        kirsch(x, u, want);
        if (on && e.way.count < 200) {
            e.way.r[e.way.count] = r;
            e.way.stress[e.way.count++] = sigma[1] / STRESS;
        }
        if (r < 1.3 || r > 2.5) continue;
        if (on) e.line = fmax(e.line, fabs(sigma[1] - want[1]) / STRESS);
        for (k = 0; k < 3; ++k, ++count) e.field += pow((sigma[k] - want[k]) / STRESS, 2);
    }
    e.field = sqrt(e.field / (double)count);
    printf("    %s, %-14s %-6s a = %2d h: ", p->framed ? "plate" : "strip", p->law == PERI_LAW_LPS ? "LPS" : "correspondence",
           p->correction == PERI_CORRECTION_MOMENT ? "moment" : "none", p->cells);
    if (p->framed) printf("errors of ligament %.4f, field %.4f; ", e.line, e.field);
    printf("K %.3f, next to the rim %.3f; %ld points, %ld iterations\n", at_rim(&e.way, beyond(p), 3), e.way.stress[0], (long)s.n,
           (long)s.iterations);
    free_solved(&s);
    return e;
}

/* Stresses away from the rim, and K: within the bounds, and the field better than of first order. LPS without correction has the moduli
   of the lattice sum and is soft or stiff near the rim, so that its field does not converge at a fixed ratio: shown, not asked for. */
static void hole_in_an_infinite_plate(void) {
    static const int32_t law[3][2] = {
        {PERI_LAW_LPS, PERI_CORRECTION_MOMENT}, {PERI_LAW_CORRESPONDENCE, PERI_CORRECTION_NONE}, {PERI_LAW_LPS, PERI_CORRECTION_NONE}};
    int k, cells;
    for (k = 0; k < (test_long ? 3 : 2); ++k) {
        double last = 0;
        for (cells = 10; cells <= (test_long ? 40 : 20); cells *= 2) {
            plate p = plate_of(law[k][0], law[k][1], cells, 1);
            hole e = measure(&p);
            CHECK(e.line < 0.5 * 2.69 / cells || k == 2);
            CHECK(fabs(at_rim(&e.way, beyond(&p), 3) - 3) < 0.5 * 7 / cells || k == 2);
            if (cells > 10 && k < 2) CHECK(e.field < 0.5 * last);
            last = e.field;
        }
    }
}

/* What the width adds to the stresses of the infinite plate: the difference of both on the same lattice, in which the steps of the rim
   cancel, over K of that plate. It holds a part that grows with r^2, so four powers go on to the rim.
   Bound: edges, where families are cut in half, act as if they were up to a spacing away. S W is given, so with K = 3.14 and
   dK/d(d/W) = 1.53: the hole 0.2 h/a x 1.53, the sides 0.2 h/a x 3.14 + 0.04 h/a x 1.53, together h/a. */
static void hole_in_a_strip(void) {
    const double width = 0.2, heywood = (2 + pow(1 - width, 3)) / (1 - width);
    int k, i, cells;
    for (k = 0; k < 2; ++k) {
        double last = 1;
        for (cells = 10; cells <= (test_long ? 40 : 10); cells *= 2) {
            int32_t law = k ? PERI_LAW_CORRESPONDENCE : PERI_LAW_LPS, correction = k ? PERI_CORRECTION_NONE : PERI_CORRECTION_MOMENT;
            plate strip = plate_of(law, correction, cells, 0), whole = plate_of(law, correction, cells, 1);
            hole e = measure(&strip), f = measure(&whole);
            double factor;
            for (i = 0; i < e.way.count && i < f.way.count; ++i) e.way.stress[i] -= f.way.stress[i];
            e.way.count = i;
            factor = 3 + 3 * at_rim(&e.way, beyond(&strip), 4) / at_rim(&f.way, beyond(&whole), 3);
            printf("    K %.4f, by Heywood %.4f\n", factor, heywood);
            CHECK_NEAR(factor, heywood, 0, 1.0 / cells);
            CHECK(fabs(factor - heywood) < 0.7 * last);
            last = fabs(factor - heywood);
        }
    }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(hole_in_an_infinite_plate);
    RUN(hole_in_a_strip);
    return test_end("test_hole");
}
