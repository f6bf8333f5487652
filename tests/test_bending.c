/* SPDX-License-Identifier: MIT */
/* test_bending.c - a notched beam in three-point bending, broken step by step: [T] 5.1, after Carpinteri.

   THE BEAM  [T] gives 150 mm x 600 mm, E, G0, plane stress, a horizon of 15 mm = 3 spacings and 3720 points: 124 x 30 cells of 5 mm, so
   600 mm is taken as the span (4 times the depth, as in Carpinteri's beams and in ASTM E399), with two columns more at each end. Thickness
   and notch are not printed. Taken: 150 mm (his beams are square in section) and half the depth: linear fracture mechanics has no
   snap-back there (it has below 0.3 of the depth), so that the whole softening can be had under a prescribed displacement.

   SOURCE OF TRUTH
     network   the same springs put together here and solved by conjugate gradients of this file. Each state of broken springs has one
               stiffness and one largest stretch, so that by linearity the whole path follows break by break, without load steps.
     ASTM E399 A3.5.3 (Srawley 1976, after Tada): K = P S/(B W^1.5) f(a/W), to 0.5 % for S = 4 W; Griffith: K^2 = E R in plane stress.
     lattice   energy of the bonds that cross a unit of a lattice plane, and Young's modulus along the lattice, as finite sums. */
#include "specimen.h"

#define YOUNG 35.77e9 /* [Pa]                                                                                             */
#define G0 9.8        /* [J/m^2]                                                                                          */
#define DEPTH 0.15    /* [m], and thickness                                                                               */
#define SPAN 0.6      /* [m] nominal; the supports are points, half a spacing nearer to the middle each                   */
#define PI 3.14159265358979323846

typedef struct beam {
    double h;                        /* spacing [m]                                                                       */
    int    cols, rows, notch, ratio; /* notch: rows cut; ratio: horizon over spacing                                      */
} beam;

static beam beam_of(double h, int ratio, double notch) {
    beam b;
    b.h = h;
    b.cols = (int)(SPAN / h + 0.5) + 4;
    b.rows = (int)(DEPTH / h + 0.5);
    b.notch = (int)(notch * b.rows);
    b.ratio = ratio;
    return b;
}

static double span_of(const beam *b) { return SPAN - b->h; }
static double micromodulus(const beam *b) { return 9 * YOUNG / (PI * pow(b->ratio * b->h, 3)); }                /* [T] 1.24 */
static double limit_of(const beam *b) { return sqrt(4 * PI * G0 / (9 * YOUNG * b->ratio * b->h)); }            /* [T] 1.40 */
static int point_of(const beam *b, int col, int row) { return row * b->cols + col; }
static int col_of(const beam *b, int point) { return point % b->cols; }
static int mirror_of(const beam *b, int point) { return point + b->cols - 1 - 2 * col_of(b, point); }

/* The points that are held: two at the top in the middle, one over each support. */
static void held_points(const beam *b, int32_t *held) {
    held[0] = point_of(b, b->cols / 2 - 1, b->rows - 1);
    held[1] = held[0] + 1;
    held[2] = point_of(b, 2, 0);
    held[3] = point_of(b, b->cols - 3, 0);
}

/* Points within a horizon of those, where the load crushes: their bonds do not break. */
static int guarded(const beam *b, int point) {
    int32_t held[4];
    int k;
    held_points(b, held);
    for (k = 0; k < 4; ++k) {
        int p = col_of(b, point) - col_of(b, held[k]), q = point / b->cols - held[k] / b->cols;
        if (p * p + q * q <= b->ratio * b->ratio) return 1;
    }
    return 0;
}
static int32_t take_guarded(void *user, int64_t index, const double *x) {
    (void)x;
    return guarded((const beam *)user, (int)index);
}

/* ---- linear fracture mechanics ------------------------------------------------------------------------------------ */

/* Load at which a crack of depth alpha W has energy release rate R in a plate of modulus E. */
static double griffith_load(const beam *b, double alpha, double modulus, double resistance) {
    double f = 3 * sqrt(alpha) * (1.99 - alpha * (1 - alpha) * (2.15 - 3.93 * alpha + 2.7 * alpha * alpha)) /
               (2 * (1 + 2 * alpha) * pow(1 - alpha, 1.5));
    return sqrt(modulus * resistance) * pow(DEPTH, 2.5) / (span_of(b) * f);
}

/* Of the lattice over that of the solid: Young's modulus along it, and the energy to break all bonds across one of its planes. */
typedef struct lattice {
    double modulus, energy;
    int    bonds; /* that cross the plane, per row                                                                        */
} lattice;

static lattice lattice_of(int ratio) {
    lattice l = {0, 0, 0};
    double c11 = 0, c12 = 0;
    int p, q;
    for (p = 1; p <= ratio; ++p) /* the half with p > 0, and p = 0 for c11, c12: p^4 and p^2 q^2 vanish                      */
        for (q = -ratio; q <= ratio; ++q) {
            double length = sqrt(p * p + q * q);
            if (p * p + q * q > ratio * ratio) continue;
            c11 += 9 / (PI * pow(ratio, 3)) * pow(p, 4) / pow(length, 3);
            c12 += 9 / (PI * pow(ratio, 3)) * pow(p * q, 2) / pow(length, 3);
            l.energy += 2 / pow(ratio, 4) * p * length; /* c s0^2/2 = 2 G0/horizon^4                                      */
            l.bonds += p;
        }
    l.modulus = c11 - c12 * c12 / c11;
    return l;
}

/* ---- the network -------------------------------------------------------------------------------------------------- */

typedef struct spring {
    int    i, j, alive, safe;
    double n[2], k, length; /* direction, force per elongation, length                                                    */
} spring;

typedef struct network {
    const beam *b;
    spring     *s;
    int64_t     springs, size, broken;
    double     *u, *r, *p, *q, *d; /* answer to a unit deflection, residual, direction, product, 1/diagonal or 0 where held */
    double      stiffness;         /* load per deflection                                                                 */
} network;

static network network_of(const beam *b) {
    network n;
    int col, row, p, q, half = b->cols / 2;
    memset(&n, 0, sizeof n);
    n.b = b;
    n.size = 2 * (int64_t)b->cols * b->rows;
    n.s = (spring *)calloc((size_t)(n.size * 2 * b->ratio * b->ratio), sizeof *n.s);
    n.u = (double *)calloc((size_t)n.size * 5, sizeof *n.u);
    n.r = n.u + n.size;
    n.p = n.r + n.size;
    n.q = n.p + n.size;
    n.d = n.q + n.size;
    for (row = 0; row < b->rows; ++row)
        for (col = 0; col < b->cols; ++col)
            for (q = 0; q <= b->ratio; ++q)
                for (p = q ? -b->ratio : 1; p <= b->ratio; ++p) {
                    spring *s = &n.s[n.springs];
                    int other = col + p;
                    if (p * p + q * q > b->ratio * b->ratio || other < 0 || other >= b->cols || row + q >= b->rows) continue;
                    s->i = point_of(b, col, row);
                    s->j = point_of(b, other, row + q);
                    s->length = b->h * sqrt(p * p + q * q);
                    s->n[0] = p * b->h / s->length;
                    s->n[1] = q * b->h / s->length;
                    s->k = micromodulus(b) * pow(b->h, 4) * DEPTH / s->length;
                    s->alive = (col < half) == (other < half) || row + 0.5 + q * (half - 0.5 - col) / p > b->notch + 1e-9;
                    s->safe = guarded(b, s->i) || guarded(b, s->j);
                    n.springs++;
                }
    return n;
}

static void network_free(network *n) {
    free(n->s);
    free(n->u);
}

static double elongation(const spring *s, const double *u) {
    return (u[2 * s->j] - u[2 * s->i]) * s->n[0] + (u[2 * s->j + 1] - u[2 * s->i + 1]) * s->n[1];
}

static void network_multiply(const network *n, const double *u, double *out) {
    int64_t k;
    int a;
    memset(out, 0, (size_t)n->size * sizeof *out);
    for (k = 0; k < n->springs; ++k) {
        const spring *s = &n->s[k];
        double f = s->alive ? s->k * elongation(s, u) : 0;
        for (a = 0; a < 2; ++a) {
            out[2 * s->i + a] -= f * s->n[a];
            out[2 * s->j + a] += f * s->n[a];
        }
    }
}

static double dot(const double *a, const double *b, int64_t n) {
    double sum = 0;
    while (n-- > 0) sum += a[n] * b[n];
    return sum;
}

/* Conjugate gradients from the last answer, with the diagonal as preconditioner, to 1e-9 of the load. */
static void network_solve(network *n) {
    int32_t held[4];
    int64_t k;
    int a, it;
    double rho = 0, last;
    held_points(n->b, held);
    memset(n->d, 0, (size_t)n->size * sizeof *n->d);
    for (k = 0; k < n->springs; ++k)
        for (a = 0; a < 2; ++a) {
            double add = n->s[k].alive ? n->s[k].k * n->s[k].n[a] * n->s[k].n[a] : 0;
            n->d[2 * n->s[k].i + a] += add;
            n->d[2 * n->s[k].j + a] += add;
        }
    for (k = 0; k < n->size; ++k) n->d[k] = 1 / n->d[k];
    for (a = 0; a < 4; ++a) n->d[2 * held[a] + 1] = 0;
    n->d[2 * held[2]] = 0;
    n->u[2 * held[0] + 1] = n->u[2 * held[1] + 1] = -1;
    for (it = 0; it < 100000; ++it) {
        double alpha;
        if (it % 1000 == 0) {
            network_multiply(n, n->u, n->q);
            n->stiffness = -(n->q[2 * held[0] + 1] + n->q[2 * held[1] + 1]);
            for (k = 0; k < n->size; ++k) n->r[k] = n->d[k] > 0 ? -n->q[k] : 0;
            memset(n->p, 0, (size_t)n->size * sizeof *n->p);
        }
        if (sqrt(dot(n->r, n->r, n->size)) < 1e-9 * n->stiffness) break;
        last = rho;
        for (rho = 0, k = 0; k < n->size; ++k) rho += n->r[k] * n->r[k] * n->d[k];
        for (k = 0; k < n->size; ++k) n->p[k] = n->d[k] * n->r[k] + (it % 1000 ? rho / last : 0) * n->p[k];
        network_multiply(n, n->p, n->q);
        alpha = rho / dot(n->p, n->q, n->size);
        for (k = 0; k < n->size; ++k) {
            n->u[k] += alpha * n->p[k];
            if (n->d[k] > 0) n->r[k] -= alpha * n->q[k];
        }
    }
    network_multiply(n, n->u, n->q);
    n->stiffness = -(n->q[2 * held[0] + 1] + n->q[2 * held[1] + 1]);
}

/* Stretch over its limit at unit deflection, of the worst spring. */
static double network_worst(const network *n) {
    double worst = 0;
    int64_t k;
    for (k = 0; k < n->springs; ++k)
        if (n->s[k].alive && !n->s[k].safe) worst = fmax(worst, elongation(&n->s[k], n->u) / n->s[k].length);
    return worst / limit_of(n->b);
}

static void network_break(network *n, double above) {
    int64_t k;
    for (k = 0; k < n->springs; ++k)
        if (n->s[k].alive && !n->s[k].safe && elongation(&n->s[k], n->u) > above * limit_of(n->b) * n->s[k].length) {
            n->s[k].alive = 0;
            n->broken++;
        }
}

/* Deflection prescribed: the springs that break, and the load. */
static double network_bend(network *n, double deflection, double criticality) {
    double worst;
    if (n->stiffness == 0) network_solve(n);
    while ((worst = network_worst(n)) * deflection > 1) {
        network_break(n, fmax(1 / deflection, criticality * worst * (1 - 1e-6)));
        network_solve(n);
    }
    return deflection * n->stiffness;
}

/* The largest load on the way to a deflection, with infinitely small steps. */
static double network_peak(network *n, double deflection, double *at) {
    double peak = 0, reached = 0;
    for (;;) {
        double next;
        network_solve(n);
        next = 1 / network_worst(n);
        if (next > reached) {
            reached = next;
            if (fmin(next, deflection) * n->stiffness > peak) peak = n->stiffness * (*at = fmin(next, deflection));
        }
        if (reached >= deflection) return peak;
        network_break(n, (1 - 1e-6) / next);
    }
}

/* ---- the body ----------------------------------------------------------------------------------------------------- */

typedef struct bending {
    peri_body *body;
    int32_t    load;           /* the support that pushes the top down by the deflection                                  */
    double     energy, least;  /* of the bonds that broke, at the stretch at which they broke, and at their limit         */
    int        broken, aside;  /* bonds; those of them that do not cross the middle                                       */
    beam       b;
} bending;

static int32_t count_break(void *user, int32_t i, int32_t j, double time, double stretch) {
    bending *t = (bending *)user;
    const beam *b = &t->b;
    int p = col_of(b, j) - col_of(b, i), q = j / b->cols - i / b->cols, half = b->cols / 2;
    double unit = 0.5 * micromodulus(b) * sqrt(p * p + q * q) * pow(b->h, 5) * DEPTH;
    (void)time;
    CHECK(stretch > limit_of(b));
    t->energy += unit * stretch * stretch;
    t->least += unit * pow(limit_of(b), 2);
    t->broken++;
    t->aside += (col_of(b, i) < half) == (col_of(b, j) < half);
    return 0;
}

static void bending_free(bending *t) {
    peri_body_destroy(t->body);
    free(t);
}

static bending *bending_of(const beam *b, double deflection, int32_t geometry) {
    double below[2], tip[2], down[2], c, s0;
    int32_t held[4], set, concrete;
    bending *t = (bending *)calloc(1, sizeof *t);
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, b->h, b->ratio, b->cols, b->rows, 1);
    held_points(b, held);
    below[0] = tip[0] = down[0] = 0;
    below[1] = -b->h;
    tip[1] = b->notch * b->h;
    down[1] = -deflection;
    t->b = *b;
    s.lo[0] = -0.5 * b->cols * b->h;
    s.hi[0] = 0.5 * b->cols * b->h;
    s.desc.geometry = geometry;
    s.desc.thickness = DEPTH;
    s.material.young = YOUNG;
    s.material.density = 2400;
    s.material.fracture_energy = G0;
    t->body = specimen_make(&s);
    concrete = peri_id(t->body, PERI_KIND_MATERIAL, 1);
    CHECK(peri_point_count(t->body) == (int64_t)b->cols * b->rows);
    (void)MUST(t->body, peri_get_bond_constants(t->body, concrete, concrete, &c, &s0));
    CHECK_NEAR(c * DEPTH, micromodulus(b), 1e-12, 0); /* c is per true volume                                            */
    CHECK_NEAR(s0, limit_of(b), 1e-12, 0);
    if (b->notch > 0) (void)MUST(t->body, peri_cut_segment(t->body, PERI_CUT_INITIAL, below, tip));
    (void)MUST(t->body, peri_on_break(t->body, count_break, t));
    (void)MUST(t->body, peri_set_no_fail(t->body, peri_select_if(t->body, "guarded", take_guarded, &t->b), 1));
    set = peri_select_points(t->body, "left", 1, held + 2);
    (void)MUST(t->body, peri_prescribe_displacement(t->body, set, PERI_AXIS_X | PERI_AXIS_Y, NULL, NULL, NULL));
    set = peri_select_points(t->body, "right", 1, held + 3);
    (void)MUST(t->body, peri_prescribe_displacement(t->body, set, PERI_AXIS_Y, NULL, NULL, NULL));
    set = peri_select_points(t->body, "top", 2, held);
    t->load = (int32_t)MUST(t->body, peri_prescribe_displacement(t->body, set, PERI_AXIS_Y, down, NULL, NULL));
    return t;
}

/* Rows of the curve: load factor, mean displacement x y, force x y, broken bonds. */
enum { FACTOR, MOVE_X, MOVE_Y, FORCE_X, FORCE_Y, BROKEN, WIDE };

/* In `steps` steps; the curve is the caller's to free. Row -1 is the beam at rest: curve - WIDE was allocated. */
static double *bend(bending *t, int steps, double criticality) {
    double *curve = (double *)calloc((size_t)(steps + 1) * WIDE, sizeof *curve);
    peri_solve_desc st;
    peri_solve_report report;
    peri_solve_desc_init(&st);
    st.steps = steps;
    st.criticality = criticality;
    st.curve_load = t->load;
    st.curve = curve + WIDE;
    st.curve_rows = steps;
    (void)MUST(t->body, peri_solve(t->body, &st, &report));
    CHECK(report.curve_rows == steps && report.broken == t->broken && peri_broken_count(t->body) == t->broken);
    return curve;
}
static double load_of(const double *curve, int row) { return -curve[row * WIDE + FORCE_Y]; }
static double peak_of(const double *curve, int steps) {
    double peak = 0;
    for (; steps > 0; --steps) peak = fmax(peak, load_of(curve, steps));
    return peak;
}

/* ---- cases -------------------------------------------------------------------------------------------------------- */

/* Load, deflection and broken bonds of each step are those of the network. Load: its error is residual . (displacements under a unit
   deflection), at most 1e-8 |load| sqrt(points) <= 7e-7 |load| here and for the network. */
static double network_agrees(const beam *b, double deflection, int steps, double criticality) {
    bending *t = bending_of(b, deflection, PERI_GEOMETRY_LINEAR);
    network n = network_of(b);
    double *curve = bend(t, steps, criticality);
    double end = load_of(curve, steps);
    int k;
    for (k = 1; k <= steps; ++k) {
        double load = network_bend(&n, deflection * k / steps, criticality);
        CHECK_NEAR(curve[k * WIDE + FACTOR], k / (double)steps, 1e-14, 0);
        CHECK_NEAR(curve[k * WIDE + MOVE_Y], -deflection * k / steps, 1e-12, 0);
        CHECK_NEAR(load_of(curve, k), load, 1.5e-6, 0);
        CHECK(curve[k * WIDE + BROKEN] == (double)n.broken);
    }
    CHECK(n.broken > 0);
    printf("    h %4.1f mm, notch %2d of %2d rows, %2d steps, criticality %.1f: peak %7.1f N, end %7.1f N, %3d bonds broken, %d aside\n",
           1e3 * b->h, b->notch, b->rows, steps, criticality, peak_of(curve, steps), end, t->broken, t->aside);
    network_free(&n);
    free(curve);
    bending_free(t);
    return end;
}
/* Bonds that all break at once where many are over their limit also break beside the crack, the more the larger the step. The order in
   which the worst go, one by one, does not depend on the load: then the end is the same for any number of steps. */
static void curves_are_those_of_the_network(void) {
    beam notched = beam_of(0.01, 3, 0.5), whole = beam_of(0.01, 3, 0);
    double few, many;
    if (test_long) (void)network_agrees(&notched, 62e-6, 4, 0);
    if (test_long) (void)network_agrees(&notched, 62e-6, 4, 0.5);
    few = network_agrees(&notched, 62e-6, 4, 1);
    many = network_agrees(&notched, 62e-6, test_long ? 20 : 7, 1);
    CHECK_NEAR(few, many, 1.5e-6, 0);
    if (test_long) (void)network_agrees(&whole, 68e-6, 4, 0);
}
/* Rows are the deflections and loads at which the network's next spring breaks, back and forth. */
static void the_controlled_path_is_that_of_the_network(void) {
    beam b = beam_of(0.015, 3, 0.2);
    bending *t = bending_of(&b, 62e-6, PERI_GEOMETRY_LINEAR);
    network n = network_of(&b);
    peri_solve_report r;
    peri_solve_desc st;
    double curve[60 * WIDE];
    (void)MUST(t->body, peri_on_break(t->body, NULL, NULL)); /* bonds break at their limit, not over it */
    peri_solve_desc_init(&st);
    st.control = PERI_CONTROL_FRACTURE;
    st.breaks = test_long ? 35 : 24; /* the load is reached soon after */
    st.criticality = 1;
    st.curve_load = t->load;
    st.curve_rows = 60, st.curve = curve;
    (void)MUST(t->body, peri_solve(t->body, &st, &r));
    CHECK(r.ended == PERI_ENDED_BREAKS && r.curve_rows > 0);
    for (int k = 0; k < r.curve_rows; ++k, network_break(&n, (1 - 1e-6) * network_worst(&n))) {
        network_solve(&n);
        CHECK_NEAR(-curve[k * WIDE + MOVE_Y] * network_worst(&n), 1, 2e-6, 0);
        CHECK_NEAR(load_of(curve, k) * network_worst(&n), n.stiffness, 2e-6, 0);
        CHECK(curve[k * WIDE + BROKEN] == (double)n.broken && r.curve_rows == st.breaks + 1);
    }
    network_free(&n), bending_free(t);
}
static void bonds_break_at_their_limit(void) {
    beam b = beam_of(0.01, 3, 0.5);
    network n = network_of(&b);
    double share;
    network_solve(&n);
    for (share = 1 - 1e-5; share < 1 + 2e-5; share += 2e-5) {
        bending *t = bending_of(&b, share / network_worst(&n), PERI_GEOMETRY_LINEAR);
        free(bend(t, 1, 1));
        CHECK((t->broken > 0) == (share > 1));
        bending_free(t);
    }
    network_free(&n);
}
static void so_is_that_of_the_thesis(void) {
    beam b = beam_of(0.005, 3, 0.5);
    (void)network_agrees(&b, 62e-6, 31, 0);
    (void)network_agrees(&b, 62e-6, 31, 1);
}

/* Small as they are, finite turns change little: a bond that turns by w is longer by w^2/2, where the limit is 1.1e-4 and the halves of the
   beam turn by 62 um over 0.3 m: 2e-8/1.1e-4 = 2e-4, bonds over the crack with twice the turn 8e-4. */
static void finite_turns_change_little(void) {
    beam b = beam_of(0.01, 3, 0.5);
    bending *small = bending_of(&b, 62e-6, PERI_GEOMETRY_LINEAR), *finite = bending_of(&b, 62e-6, PERI_GEOMETRY_NONLINEAR);
    double *want = bend(small, 5, 0), *got = bend(finite, 5, 0), off = 0;
    int k;
    for (k = 1; k <= 5; ++k) {
        off = fmax(off, fabs(load_of(got, k) / load_of(want, k) - 1));
        CHECK(got[k * WIDE + BROKEN] == want[k * WIDE + BROKEN]);
    }
    printf("    loads differ by up to %.1e\n", off);
    CHECK(off > 0 && off < 1e-3 && small->broken > 0);
    free(want);
    free(got);
    bending_free(small);
    bending_free(finite);
}

/* Bonds that break one by one do so at deflections that do not depend on the steps, and a beam that has lost bonds is never stiffer. So
   the peak recorded in steps of d is at most the true one, that of the network without steps, and less by at most d times the first
   stiffness: of first order in the step. */
static void peaks_converge(double h, double deflection) {
    beam b = beam_of(h, 3, 0.5);
    network n = network_of(&b);
    double at = 0, peak = network_peak(&n, deflection, &at);
    int steps;
    printf("    h %4.1f mm: peak of the network %.1f N at %.2f um\n", 1e3 * h, peak, 1e6 * at);
    CHECK(at < deflection);
    for (steps = 10; steps <= (test_long ? 40 : 10); steps *= 2) {
        bending *t = bending_of(&b, deflection, PERI_GEOMETRY_LINEAR);
        double *curve = bend(t, steps, 1), got = peak_of(curve, steps);
        printf("    %2d steps: %.1f N, below by %.1f %%, bound %.1f %%\n", steps, got, 100 - 100 * got / peak,
               100 * load_of(curve, 1) / peak);
        CHECK(got <= peak * (1 + 1.5e-6) && got >= peak - load_of(curve, 1));
        free(curve);
        bending_free(t);
    }
    network_free(&n);
}
static void peaks_converge_with_the_step(void) {
    peaks_converge(0.0075, 47.4e-6);
    if (test_long) peaks_converge(0.005, 47.4e-6);
}

/* The crack keeps to the middle and to its mirror image: of each bond, as of its mirror image, 1 = whole. */
static void check_symmetry(const bending *t) {
    const beam *b = &t->b;
    int32_t i, j, p, q, n = b->cols * b->rows;
    for (i = 0; i < n; ++i)
        for (q = 0; q <= b->ratio; ++q)
            for (p = q ? -b->ratio : 1; p <= b->ratio; ++p) {
                j = i + p + q * b->cols;
                if (p * p + q * q > b->ratio * b->ratio || j >= n || abs(col_of(b, i) - b->cols / 2) > 3 * b->ratio) continue;
                CHECK(peri_bond_is_intact(t->body, i, j) == peri_bond_is_intact(t->body, mirror_of(b, i), mirror_of(b, j)));
            }
}

/* ENERGY  Between two recorded steps the beam is loaded with the bonds that it has, a straight line in load over deflection, and then loses
   some at rest: external is the sum of those trapezia. Elastic: half load times deflection. Fracture: the bonds at the stretch at which
   they broke. What is left of the work, damping, is what the beam gave off as it found its next equilibrium, by motions that statics
   leaves out: no less than zero, and nothing only where breaking bonds is a continuous process.
   So the crack takes R = (external - elastic)/area, where the bonds alone take their least, G0 but for the lattice sum: the area is least/
   (energy of the lattice). R is higher by the trapping of the crack between rows.
   PEAK  A crack grows at Griffith's load for E of the lattice and R. Its tip is blunt: bonds up to a horizon long reach past it and are
   the first to soften, so that it acts as one between 0 and half a horizon longer. Hence bounds on the peak. With more points in a
   horizon R goes to G0 and with smaller horizons the bounds close. */
typedef struct griffith {
    double over_nominal, low, high; /* peak over Griffith's load: of E and G0; bounds of that                             */
    double resistance, overshoot;   /* R and fracture over least                                                          */
} griffith;

static griffith energy_and_peak(const beam *b, double deflection, int steps, double criticality) {
    bending *t = bending_of(b, deflection, PERI_GEOMETRY_LINEAR);
    double *curve = bend(t, steps, criticality), step = deflection / steps, work = 0, alpha = b->notch / (double)b->rows, peak, nominal;
    lattice l = lattice_of(b->ratio);
    peri_energy e;
    griffith g;
    int k;
    (void)MUST(t->body, peri_get_energy(t->body, &e));
    for (k = 1; k <= steps; ++k)
        work += k == 1 ? 0.5 * step * load_of(curve, 1) : 0.5 * step * load_of(curve, k - 1) * (1 + k / (k - 1.0));
    CHECK_NEAR(e.external, work, 1e-5, 0);
    CHECK_NEAR(e.elastic, 0.5 * load_of(curve, steps) * deflection, 1e-5, 0);
    CHECK_NEAR(e.fracture, t->energy, 1e-9, 0);
    CHECK(e.damping > 0 && e.fracture > t->least && fabs(e.error) < 1e-6 * e.external); /* residual . displacements: see above */
    check_symmetry(t);
    peak = peak_of(curve, steps);
    nominal = griffith_load(b, alpha, YOUNG, G0);
    g.over_nominal = peak / nominal;
    g.resistance = (e.external - e.elastic) / t->least;
    g.overshoot = e.fracture / t->least;
    g.low = griffith_load(b, alpha + 0.5 * b->ratio * b->h / DEPTH, YOUNG * l.modulus, G0 * l.energy) / nominal;
    g.high = griffith_load(b, alpha, YOUNG * l.modulus, G0 * l.energy * g.resistance) / nominal;
    printf("    horizon %4.1f mm = %d h, %5ld points: %.1f N = %.3f of Griffith's (%.3f .. %.3f), end %.2f; R %.3f, bonds %.3f; lattice E "
           "%.3f, G %.3f; %d broken, %d aside\n", 1e3 * b->ratio * b->h, b->ratio, (long)peri_point_count(t->body), peak, g.over_nominal,
           g.low, g.high, load_of(curve, steps) / peak, g.resistance, g.overshoot, l.modulus, l.energy, t->broken, t->aside);
    CHECK(g.over_nominal >= g.low && g.over_nominal <= g.high);
    CHECK(load_of(curve, steps) < 0.7 * peak);
    CHECK(t->aside <= 0.1 * t->broken);
    free(curve);
    bending_free(t);
    return g;
}

static void energies_and_peak(void) {
    beam b = beam_of(test_long ? 0.005 : 0.0075, 3, 0.5);
    const double resistance = energy_and_peak(&b, 62e-6, 31, 0).resistance;
    if (test_long) CHECK_NEAR(resistance, 1.56, 0, 0.01); /* docs/manual.md, peri_energy */
    if (test_long) (void)energy_and_peak(&b, 62e-6, 31, 1);
}

/* R falls towards G0 with the number of points in a horizon; the bounds of the peak close with the horizon. */
static void refinement(void) {
    static const struct { double h, deflection; int ratio, steps; } at[] = {
        {0.005, 62e-6, 3, 31}, {0.0025, 56e-6, 3, 28}, {0.00375, 50e-6, 4, 50}, {0.0025, 48e-6, 6, 48}};
    griffith g[4];
    int k;
    for (k = 0; k < 4; ++k) {
        beam b = beam_of(at[k].h, at[k].ratio, 0.5);
        g[k] = energy_and_peak(&b, at[k].deflection, at[k].steps, 0);
    }
    /* docs/manual.md, peri_energy: 1.56, 1.29, 1.12 times G0 at a horizon of 3, 4, 6 spacings */
    CHECK_NEAR(g[2].resistance, 1.29, 0, 0.01);
    CHECK_NEAR(g[3].resistance, 1.12, 0, 0.01);
    CHECK(g[2].resistance - 1 < 0.6 * (g[0].resistance - 1));
    CHECK(g[3].resistance - 1 < 0.6 * (g[2].resistance - 1));
    CHECK(g[1].high / g[1].low < g[0].high / g[0].low);
}

/* Without a notch the beam holds until the outermost bonds reach their limit: E s0 at the height of the outermost row, in beam theory with
   the local effect of the load (Timoshenko, Goodier, Theory of Elasticity, art. 40: 3 P S/(2 B W^2) - 0.133 P/(B W/2)). The skin of a
   bond-based body is soft over a horizon; two skins that lose up to a quarter of it take up to horizon/depth off the section modulus. */
static void strength_without_a_notch(void) {
    double h, last = 1;
    for (h = 0.01; h > (test_long ? 0.002 : 0.004); h /= 2) {
        beam b = beam_of(h, 3, 0);
        double stress = YOUNG * lattice_of(3).modulus * limit_of(&b) / (1 - h / DEPTH), *curve, want, error;
        const double below = 1 - 1e-4; /* just before the first bond breaks                                               */
        network n = network_of(&b);
        bending *t;
        network_solve(&n);
        t = bending_of(&b, below / network_worst(&n), PERI_GEOMETRY_LINEAR);
        curve = bend(t, 1, 0);
        want = stress * pow(DEPTH, 2) / (1.5 * span_of(&b) / DEPTH - 0.266);
        error = load_of(curve, 1) / below / want - 1;
        printf("    h %4.1f mm: %.0f N, %.3f of beam theory\n", 1e3 * h, load_of(curve, 1) / below, 1 + error);
        CHECK(t->broken == 0 && fabs(error) < 3 * h / DEPTH && fabs(error) < 0.7 * last);
        last = fabs(error);
        network_free(&n);
        free(curve);
        bending_free(t);
    }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(curves_are_those_of_the_network);
    RUN(the_controlled_path_is_that_of_the_network);
    RUN(bonds_break_at_their_limit);
    LONG_RUN(so_is_that_of_the_thesis);
    RUN(finite_turns_change_little);
    RUN(peaks_converge_with_the_step);
    RUN(energies_and_peak);
    LONG_RUN(refinement);
    RUN(strength_without_a_notch);
    return test_end("test_bending");
}
