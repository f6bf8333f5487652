/* SPDX-License-Identifier: MIT */
/* test_convergence.c - the first part of the convergence study [C], its section 5: a square of 10 mm under constant strain, three problems
   times three laws times five influence functions times five horizons, by static solves.

   SOURCE OF TRUTH: Hooke's law in plane strain for the displacements; the orders printed in [C] tables 3, 4 and 5; sums over the infinite
   lattice for the moduli to which a law converges that misses those of the solid. */
#include "study.h"

#define SIDE  10e-3 /* [m], [C] table 1                                                                                      */
#define STIFF 1000e9
#define LOAD  1e6   /* [Pa]                                                                                              */

enum { UNIAXIAL, BIAXIAL, SIMPLE, PROBLEMS };
static const char *const problem_name[PROBLEMS] = {"uniaxial", "isotropic", "shear"};

/* ours = 0: supports on the outermost row or column, the load on the outermost row, as [C] 34 has it. ours = 1: supports two horizons deep
   that move as the solid does there, the load by peri_apply_traction. */
typedef struct study {
    const study_law *law;
    int    problem, shape, cells, ours;
    double ratio, young, nu;
} study;

typedef struct outcome {
    double  error;  /* [C] 36 over the analytic value: mean displacement of the middle fifth of the loaded edge              */
    double  spread; /* root mean square error of the displacements of all points, over the largest                          */
    double  across; /* shear: largest displacement across the shear on the middle column, over the largest along it             */
    int32_t status;
} outcome;

static study study_of(const study_law *law, int problem, int shape, double ratio, int cells) {
    study s;
    s.law = law;
    s.problem = problem;
    s.shape = shape;
    s.cells = cells;
    s.ratio = ratio;
    s.young = STIFF;
    s.nu = 0;
    s.ours = 0;
    return s;
}

/* sigma = lambda tr(eps) + 2 mu eps. Uniaxial: eps_yy = T/(lambda + 2 mu), eps_xx = 0 by the rollers. Isotropic: eps_xx = eps_yy =
   T/(2 (lambda + mu)). Shear: the rollers leave u_x(y), gamma = T/mu. With E and nu: the values of [C] 5.1. */
static void solid_at(const study *s, const double *x, double *u) {
    const double mu = STIFF / (2 * (1 + s->nu)), lambda = 2 * mu * s->nu / (1 - 2 * s->nu), both = LOAD / (2 * (lambda + mu));
    u[0] = s->problem == BIAXIAL ? both * x[0] : s->problem == SIMPLE ? LOAD / mu * x[1] : 0;
    u[1] = s->problem == BIAXIAL ? both * x[1] : s->problem == UNIAXIAL ? LOAD / (lambda + 2 * mu) * x[1] : 0;
}

typedef struct grip {
    const study  *s;
    const double *x;
} grip;

static int32_t move(void *user, double time, int64_t count, const int32_t *points, double *value) {
    const grip *g = (const grip *)user;
    int64_t k;
    (void)time;
    for (k = 0; k < count; ++k) solid_at(g->s, &g->x[2 * points[k]], &value[2 * k]);
    return 0;
}

static void support(peri_body *b, grip *g, int32_t set, int32_t axes) {
    (void)MUST(b, peri_prescribe_displacement(b, set, axes, NULL, g->s->ours ? move : NULL, g));
}

/* The load on the top (axis 1) or right (axis 0) edge; the status says whether the law can take it. */
static int32_t load(peri_body *b, const study *s, int axis, double depth, double along_x, double along_y) {
    const double h = SIDE / s->cells, from = SIDE - (s->ours ? depth : h);
    const int32_t set = axis ? study_box(b, 0, from, SIDE, SIDE) : study_box(b, from, 0, SIDE, SIDE);
    double value[2], normal[2] = {0, 0};
    value[0] = along_x;
    value[1] = along_y;
    normal[axis] = 1;
    if (s->ours) return peri_apply_traction(b, set, SIDE, normal, value, NULL, NULL);
    return (int32_t)MUST(b, peri_apply_layer_traction(b, set, SIDE, value, NULL, NULL));
}

static outcome compare(peri_body *b, const study *s, const double *x) {
    const int n = s->cells, axis = s->problem == SIMPLE ? 0 : 1;
    double corner[2] = {SIDE, SIDE}, want[2], *u = get(b, PERI_FIELD_DISPLACEMENT), mean = 0, most;
    int i, k, seen = 0;
    outcome o = {0, 0, 0, PERI_OK};
    solid_at(s, corner, want);
    most = want[axis];
    if (s->ours) corner[1] -= 0.5 * SIDE / n; /* where the points are */
    solid_at(s, corner, want);
    for (i = 0; i < n; ++i) {
        const int64_t at = 2 * ((int64_t)(n - 1) * n + i);
        if (fabs(x[at] / SIDE - 0.5) > 0.1 + 1e-9) continue;
        mean += u[at + axis];
        seen++;
    }
    o.error = mean / seen / want[axis] - 1;
    for (i = 0; i < n * n; ++i) {
        solid_at(s, &x[2 * i], want);
        for (k = 0; k < 2; ++k) o.spread += pow((u[2 * i + k] - want[k]) / most, 2) / ((double)n * n);
    }
    o.spread = sqrt(o.spread);
    for (i = 0; s->problem == SIMPLE && i < n; ++i) o.across = fmax(o.across, fabs(u[2 * (i * n + n / 2) + 1]) / most);
    free(u);
    return o;
}

static outcome solve(const study *s) {
    const double lo[2] = {0, 0}, h = SIDE / s->cells, depth = fmin(2 * s->ratio * h, 0.5 * SIDE), held = s->ours ? depth : h;
    peri_body *b = study_square(s->law, s->shape, s->ratio, s->cells, lo, SIDE, s->young, s->nu);
    double *x = get(b, PERI_FIELD_POSITION);
    const int32_t bottom = study_box(b, 0, 0, SIDE, held), left = study_box(b, 0, 0, held, SIDE);
    const int32_t right = study_box(b, SIDE - held, 0, SIDE, SIDE);
    peri_solve_report r;
    grip g;
    outcome o = {0, 0, 0, PERI_OK};
    g.s = s;
    g.x = x;
    if (s->problem == BIAXIAL) {
        support(b, &g, left, PERI_AXIS_X);
        support(b, &g, bottom, PERI_AXIS_Y);
        o.status = load(b, s, 0, depth, LOAD, 0);
    } else {
        support(b, &g, left, s->problem == UNIAXIAL ? PERI_AXIS_X : PERI_AXIS_Y);
        support(b, &g, right, s->problem == UNIAXIAL ? PERI_AXIS_X : PERI_AXIS_Y);
        support(b, &g, bottom, PERI_AXIS_X | PERI_AXIS_Y);
    }
    if (o.status >= 0) o.status = load(b, s, 1, depth, s->problem == SIMPLE ? LOAD : 0, s->problem == SIMPLE ? 0 : LOAD);
    if (o.status >= 0) {
        (void)MUST(b, study_solve(b, s->ours ? 1e-9 : 1e-7, 20000, &r));
        o = compare(b, s, x);
    }
    free(x);
    peri_body_destroy(b);
    return o;
}

/* Errors on grids of first, 2 first, .. up to last cells, and their order, printed as one cell of a table in long runs. */
static double order_of(study s, int first, int last, double *error) {
    double h[8], e[8];
    int count = 0;
    for (s.cells = first; s.cells <= last; s.cells *= 2, ++count) {
        h[count] = 1.0 / s.cells;
        e[count] = error[count] = solve(&s).error;
    }
    return study_order(count, h, e);
}

/* ---- which moduli ------------------------------------------------------------------------------------------------- */

/* [C] eq. 7 prints t = (w/m) (2 K theta |xi| + 8 G e). Its results, Silling's law converging on isotropic strain, ask for the energy of the
   solid there: W = (2 A + B) eps^2/2 = 2 (lambda + mu) eps^2, so A = 2 lambda - 2 mu with B = 8 mu, which is 2 K theta with K = lambda + mu
   and 8 G on the deviatoric part of e; [C] 13, W = 2 K s^2, has the same K. The other readings act like solids with other constants:
     3D K and all of e     A = 2K             lambda + mu of 8/3 of the right one (nu = 0): displacement -5/8 off
     3D K, deviatoric e    A = 2K - 4G        of 2/3: +1/2 off
   E' and nu' below have mu' = mu and lambda' = A/2 + mu. Strains are off by O(1) where families are cut off, 2 horizons under the load. */
static void the_moduli_behind_the_tables(void) {
    static const double reading[3][3] = {{1, 0, 0}, {1.3125, 0.3125, -0.625}, {0.75, -0.25, 0.5}}; /* E'/E, nu', error */
    int k;
    for (k = 0; k < 3; ++k) {
        study s = study_of(&SILLING, BIAXIAL, CUBIC, 3.5, 40);
        const double nu = reading[k][1], mu = reading[k][0] * STIFF / (2 * (1 + nu)), lambda = 2 * mu * nu / (1 - 2 * nu);
        double measured;
        CHECK_NEAR(STIFF / (2 * (lambda + mu)), 1 + reading[k][2], 1e-12, 0);
        CHECK_NEAR(mu, STIFF / 2, 1e-12, 0);
        s.young = reading[k][0] * STIFF;
        s.nu = nu;
        measured = (1 + solve(&s).error) * (1 + nu) * (1 - 2 * nu) - 1; /* from the solid of E, nu' to that of E, 0 */
        if (test_long) printf("    reading %d: isotropic displacement off by %+.3f, expected %+.3f\n", k + 1, measured, reading[k][2]);
        CHECK(fabs(measured - reading[k][2]) < 2 * s.ratio / s.cells * (1 + reading[k][2]));
    }
}

/* Of the infinite lattice, families of 2 r + 1 squared: w |xi|^2 n_y^4 and w |xi|^2 n_x^2 n_y^2 over m, the sum of w |xi|^2. */
typedef struct moments {
    double s4, s22;
} moments;

static moments lattice_moments(const study *s) {
    const int reach = (int)s->ratio;
    moments f = {0, 0};
    double m = 0;
    int i, j;
    for (i = -reach; i <= reach; ++i)
        for (j = -reach; j <= reach; ++j) {
            const double r = sqrt((double)(i * i + j * j)), q = r / s->ratio;
            const double w = s->shape == CUBIC ? pow(1 - q, 3) : s->shape == LINEAR ? 1 - q : 1;
            if (r == 0 || q > 1) continue;
            m += w * r * r;
            f.s4 += w * pow(j, 4) / (r * r);
            f.s22 += w * pow((double)i * j / r, 2);
        }
    f.s4 /= m;
    f.s22 /= m;
    return f;
}

/* ---- the tables --------------------------------------------------------------------------------------------------- */

static void print_errors(const study *s, int count, const double *error, double order, double printed) {
    int k;
    if (!test_long) return;
    printf("    %-8s %-8s %-6s RF %.1f  order %.4f", s->law->name, problem_name[s->problem], shape_name[s->shape], s->ratio, order);
    if (printed > 0) printf(" [C] %.4f", printed);
    printf("  errors %%");
    for (k = 0; k < count; ++k) printf(" %.3f", 100 * error[k]);
    printf("\n");
}

/* [C] does not say on which grids its orders were taken, only that they end at 200: hence its own tolerance here, 0.1. */
static void check_order(const study_law *law, int problem, int shape, double ratio, int last, double printed) {
    study s = study_of(law, problem, shape, ratio, 0);
    double error[8], order = order_of(s, last > 100 ? 25 : 20, last, error);
    print_errors(&s, last > 100 ? 4 : last > 40 ? 3 : 2, error, order, printed);
    CHECK_NEAR(order, printed, 0, 0.1);
}

static void table_3(void) {
    static const double printed[SHAPES][PROBLEMS] = {{0.9860, 1.0005, 0.9704}, {0.9939, 0.9999, 0.9247}, {0.9991, 0.9996, 1.0370},
                                                     {0.9999, 0.9999, 1.0192}, {0.9999, 0.9999, 1.0166}};
    int shape, problem;
    for (shape = 0; shape < SHAPES; ++shape)
        for (problem = 0; problem < PROBLEMS; ++problem)
            if (test_long || shape % 3 == problem) /* each shape in one problem */
                check_order(&GRADIENT, problem, shape, 1.5, test_long ? 80 : 40, printed[shape][problem]);
}

static void table_4(void) {
    static const double printed[5][PROBLEMS] = {{0.9999, 0.9999, 1.0166}, {0.9988, 0.9996, 1.0423}, {0.9930, 0.9960, 1.0423},
                                                {0.9760, 0.9875, 1.0222}, {0.9922, 1.0027, 1.0080}};
    int k, problem;
    for (k = 0; k < 5; ++k)
        for (problem = 0; problem < PROBLEMS; ++problem)
            if (test_long || (k == 4 && problem == 2) || (k < 2 && (problem + k) % 2 == 0))
                check_order(&GRADIENT, problem, CUBIC, 1.5 + 0.5 * k, test_long && k < 3 ? 80 : 40, printed[k][problem]);
}

/* [C] 16 calibrates b on simple shear along the axes of the coordinates, S = sum w |xi|^2 n_x^2 n_y^2; the library on the mean over the
   directions of shear, S = m/8, so that bodies may be turned. What [C] computed for (lambda, mu) is then the solid of mu' = mu m/(8 S) and
   the same bulk modulus lambda + mu, with S of the lattice: all the same inside, and at faces but for S/m of half a family. STIFF, nu = 0:
   lambda = 0. The error is against the displacement of the solid of [C], mu, not of mu'. RF 1.5 is left out: diagonal neighbours, the only
   ones that see this shear, weigh 1/200 of the next ones in Cubic, and no solid has mu'. */
static void order_of_oterkus(double ratio, int last, double printed) {
    study s = study_of(&OTERKUS, SIMPLE, CUBIC, ratio, last > 100 ? 25 : 20);
    const double stiffer = 1 / (8 * lattice_moments(&s).s22);
    double h[8], error[8], order;
    int count = 0;
    s.nu = 0.5 * (1 - stiffer); /* lambda'/(2 (lambda' + mu')) */
    s.young = STIFF * stiffer * (1 + s.nu);
    for (; s.cells <= last; s.cells *= 2, ++count) {
        h[count] = 1.0 / s.cells;
        error[count] = (1 + solve(&s).error) * (1 + s.nu) - 1;
    }
    order = study_order(count, h, error);
    print_errors(&s, count, error, order, printed);
    CHECK_NEAR(order, printed, 0, 0.1);
}

static void table_5(void) {
    static const double silling[5] = {1.0227, 1.0037, 0.9992, 0.9976, 0.9980}, oterkus[5] = {0, 0.9966, 1.0075, 1.0099, 1.0150};
    const int last = test_long ? 200 : 40;
    int k;
    for (k = 0; k < 5; ++k) check_order(&SILLING, BIAXIAL, CUBIC, 1.5 + 0.5 * k, last, silling[k]);
    for (k = 1; k < 5; ++k) order_of_oterkus(1.5 + 0.5 * k, last, oterkus[k]);
}

/* ---- where plain laws go ------------------------------------------------------------------------------------------ */

/* The infinite lattice under uniform strain. The energy of eps_yy = e is C11 e^2/2, that of shear gamma G gamma^2/2:
     Silling  C11 = A/2 + B S4, G = B S22;   Oterkus  theta = 2 e sum(w |xi| n_y^2)/sum(w |xi|) = e, b m = 4 mu,
     a = (K - b m)/4 with K = 2 (lambda + mu): C11 = 2 a + 2 b m S4, G = 2 b m S22.
   A body under traction takes up the strain of these moduli but for layers at its edges, whose part of the error falls as h: so
   2 error(h/2) - error(h) tends to (modulus of the solid)/(modulus of the lattice) - 1, which is not 0 whatever h. */
static double lattice_limit(const study *s) {
    const double mu = STIFF / 2;
    const moments f = lattice_moments(s);
    double stiff;
    if (s->problem == SIMPLE) return mu / (8 * mu * f.s22) - 1;
    if (s->problem == BIAXIAL) return 0; /* all bonds alike: exact by the calibration of either */
    stiff = s->law->law == PERI_LAW_OTERKUS ? 0.5 * (2 * mu - 4 * mu) + 8 * mu * f.s4 : -mu + 8 * mu * f.s4; /* lambda = 0 */
    return 2 * mu / stiff - 1;
}

/* What is left beside the linear part is of the corners, where strain is off by O(1) on squares 2 horizons wide: at RF 3.5 and 80 points
   (7/80)^2 of the body, of which the middle of the edge, 5 such widths away, feels a tenth: 1e-3. */
static void plain_laws_tend_to_the_lattice(void) {
    static const int shapes[2] = {CONST, CUBIC};
    static const double ratios[2] = {2.5, 3.5};
    int law, problem, k, l;
    for (law = 0; law < 2; ++law)
        for (problem = 0; problem < PROBLEMS; ++problem)
            for (k = 0; k < 2; ++k)
                for (l = test_long ? 0 : 1; l < 2; ++l) {
                    study s = study_of(law ? &OTERKUS : &SILLING, problem, shapes[k], ratios[l], 0);
                    double error[8], limit = lattice_limit(&s), order = order_of(s, 40, 80, error);
                    print_errors(&s, 2, error, order, 0);
                    if (test_long) printf("      tends to %.2f %%, lattice %.2f %%\n", 100 * (2 * error[1] - error[0]), 100 * limit);
                    CHECK_NEAR(2 * error[1] - error[0], limit, 0, 1e-3);
                }
}

/* [C] 5.2: the gradient law is right for constant strain, but nothing resists what alternates from point to point. Cubic families converge
   (table 4); across the shear the middle column strays, [C] by 4 % at RF 3.5 and 0.5 % at RF 1.5 with 200 points, falling with h.
   Wide families of other shapes do not converge: off by more than a fifth still at 40 points, where every stable law is within 6 %.
   Stabilized, all are within 6 %. */
static void the_gradient_law_oscillates(void) {
    const study_law stable = {PERI_LAW_CORRESPONDENCE, PERI_CORRECTION_NONE, 0.2, "stable"};
    static const double ratios[2] = {1.5, 3.5};
    int shape, k;
    for (k = 0; k < 2; ++k) {
        study s = study_of(&GRADIENT, SIMPLE, CUBIC, ratios[k], 20);
        double coarse = solve(&s).across, fine;
        s.cells = 40;
        fine = solve(&s).across;
        if (test_long) printf("    RF %.1f: across the shear %.4f, %.4f on 20, 40 points\n", ratios[k], coarse, fine);
        CHECK(fine < 0.6 * coarse && fine > 0);
        s.law = &stable;
        CHECK(solve(&s).across < 0.25 * fine);
    }
    for (shape = CONST; shape < (test_long ? CUBIC : LINEAR); ++shape) {
        study s = study_of(&GRADIENT, UNIAXIAL, shape, 3, 40);
        double wild = solve(&s).error, tame;
        s.law = &stable;
        tame = solve(&s).error;
        if (test_long) printf("    %-6s RF 3: error %.3f, stabilized %.3f\n", shape_name[shape], wild, tame);
        if (shape != QUADR) CHECK(fabs(wild) > 0.2);
        CHECK(fabs(tame) < 0.06);
    }
}

/* The whole study on 20 and 40 points: order, and error on 40. Silling's and Oterkus's laws converge on isotropic strain, the gradient law
   on all three with Cubic or at RF 1.5. That Oterkus's fails on isotropic strain, as [C] finds, is not in its equations 11 to 13: they
   calibrate it there; that it converges on shear, is of its axes (order_of_oterkus). */
static void the_whole_matrix(void) {
    static const study_law *const laws[3] = {&SILLING, &OTERKUS, &GRADIENT};
    int law, shape, k, problem;
    for (law = 0; law < 3; ++law)
        for (shape = 0; shape < SHAPES; ++shape)
            for (k = 0; k < 5; ++k) {
                printf("    %-8s %-6s RF %.1f", laws[law]->name, shape_name[shape], 1.5 + 0.5 * k);
                for (problem = 0; problem < PROBLEMS; ++problem) {
                    double error[8], order = order_of(study_of(laws[law], problem, shape, 1.5 + 0.5 * k, 0), 20, 40, error);
                    int converges = law == 2 ? shape == CUBIC || k == 0 : problem == BIAXIAL;
                    printf("  %s %6.2f %9.3f %%", problem_name[problem], order, 100 * error[1]);
                    if (converges) CHECK_NEAR(order, 1, 0, 0.1);
                }
                printf("\n");
            }
}

/* ---- our means ---------------------------------------------------------------------------------------------------- */

static const study_law means[3] = {{PERI_LAW_CORRESPONDENCE, PERI_CORRECTION_NONE, 0.2, "stable"},
                                   {PERI_LAW_LPS, PERI_CORRECTION_MOMENT, 0, "LPS+m"},
                                   {PERI_LAW_OTERKUS, PERI_CORRECTION_MOMENT, 0, "Ot.+m"}};

/* Stabilized correspondence is exact: the area vectors of the load are what uniform stress makes of its bonds, and the stabilization sees
   no linear field. 1e-6 = tolerance of the solve 1e-9 times the condition of this body, below 4 n^2 = 1e3 for loads that vary slowly.
   Corrected ordinary laws have the moduli of the solid inside and beside flat edges; what is left is strain of order one within some
   cells of corners, and for Oterkus, whose theta is off near edges, within some cells of an edge: displacements are off by O(h). The bar
   of the study is 0.5 % at 200 points, and order 0.9; here on 40 points, where supports and loads still take a third of the body, it is
   met but for the order, of which half is asked. At RF 1.5 diagonal neighbours weigh next to nothing in Quadr and Cubic: to make them
   good takes factors above the limit of the correction: neither comes near the bar there, both are printed only. */
static void means_converge(const study_law *law, int shape, double ratio, double nu, int first, int last, double least) {
    const int steep = ratio < 2 && shape >= QUADR && law->law != PERI_LAW_CORRESPONDENCE;
    int problem;
    for (problem = 0; problem < PROBLEMS; ++problem) {
        study s = study_of(law, problem, shape, ratio, first);
        double h[8], spread[8], order, worst = 0;
        int count = 0;
        s.nu = nu;
        s.ours = 1;
        for (; s.cells <= last; s.cells *= 2, ++count) {
            const outcome o = solve(&s);
            h[count] = 1.0 / s.cells;
            spread[count] = fmax(o.spread, 1e-12);
            worst = fabs(o.error);
            CHECK(o.status >= 0 || (o.status == PERI_ERROR_AREA && steep));
            if (o.status < 0) return;
        }
        order = study_order(count, h, spread);
        if (test_long)
            printf("    %-7s %-9s %-6s RF %.1f nu %.1f: on %d points %.4f %%, of all %.4f %%, order %.2f\n", law->name,
                   problem_name[problem], shape_name[shape], ratio, nu, last, 100 * worst, 100 * spread[count - 1], order);
        if (law->law == PERI_LAW_CORRESPONDENCE) CHECK(spread[count - 1] < 1e-6 && worst < 1e-6);
        else if (!steep) CHECK((order >= least || spread[count - 1] < 1e-6) && spread[count - 1] <= 0.005 && worst <= 0.005);
    }
}

static void our_means(void) {
    int law, shape, k;
    for (law = 0; law < 3; ++law)
        for (shape = 0; shape < SHAPES; ++shape)
            for (k = 0; k < 5; ++k)
                if (test_long || ((shape + k) % 5 == 0 && (shape + law) % 2 == 0))
                    means_converge(&means[law], shape, 1.5 + 0.5 * k, (shape + k) % 2 ? 0.3 : 0, 20, 40, 0.45);
}

static void our_means_at_200(void) {
    static const int shapes[2] = {CONST, CUBIC};
    int law, k;
    for (law = 0; law < 3; ++law)
        for (k = 0; k < 2; ++k) {
            means_converge(&means[law], shapes[k], 2, 0.3, 100, 200, 0.9);
            means_converge(&means[law], shapes[k], 3, 0, 100, 200, 0.9);
        }
}

/* With the supports and the measure of [C], points half a cell from the faces are held, and read, as if they were on them: h/SIDE of the
   displacement is missed whatever the law; with surface layers left to the plain supports, up to twice that. Order 1. */
static void our_means_on_its_supports(void) {
    int law, problem;
    for (law = 0; law < 3; ++law)
        for (problem = 0; problem < PROBLEMS; ++problem) {
            study s = study_of(&means[law], problem, CUBIC, 3, 0);
            double error[8], order = order_of(s, 25, test_long ? 200 : 50, error);
            print_errors(&s, test_long ? 4 : 2, error, order, 0);
            CHECK(order >= 0.9 && order <= 1.1);
            CHECK(fabs(error[test_long ? 3 : 1]) < 2.0 / (test_long ? 200 : 50));
        }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(the_moduli_behind_the_tables);
    RUN(table_3);
    RUN(table_4);
    RUN(table_5);
    RUN(plain_laws_tend_to_the_lattice);
    RUN(the_gradient_law_oscillates);
    RUN(our_means);
    RUN(our_means_on_its_supports);
    LONG_RUN(the_whole_matrix);
    LONG_RUN(our_means_at_200);
    return test_end("test_convergence");
}
