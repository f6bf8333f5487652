/* SPDX-License-Identifier: MIT */
/* test_frame.c - what a body answers does not depend on how it lies in the axes of the coordinates.

   SOURCE OF TRUTH: space is alike in all directions. A scene whose points, displacements and loads are turned or mirrored together has the
   same energies, times and scalars, and forces turned the same way.

   Rounding: turned places are off by u = 1.1e-16 of the size of the body, a vector of a bond by some 10 u of its length, and what is made
   of it by 10 u times how steeply w changes there, |xi| w'/w: up to 60 beside the poles, whose weights of both signs cancel in m, besides.
   That makes 1e-12, 1e-10 with poles. The moment correction solves a system that magnifies it by less than the inverse of the least share
   that its factors, 10 at most, leave of a direction: a hundred times more.

   Left out by name, for the axes are in what they mean: PERI_QUADRATURE_PARTIAL, PERI_QUADRATURE_PARTIAL_CENTROID and
   PERI_QUADRATURE_PARTIAL_MOMENT in turns that are none of a square: the cells of points that the caller gives are squares or cubes along
   the axes (theory.md, Quadrature). They are held under exchanged and reversed axes. Horizons of 2.05 and 3.05 spacings: no bond of the
   lattice ends at them, where rounding would decide. */
#include "solid.h"

/* ---- scenes ------------------------------------------------------------------------------------------------------- */

#define MOST 400 /* points */

enum { LATTICE, JITTERED, BALL, CLOUDS };

typedef struct cloud {
    int    dim, count;
    double x[3 * MOST], volume[MOST], u[3 * MOST];
} cloud;

/* Points of about unit spacing about the origin, and displacements of 2 % of that at random. */
static void fill(cloud *c, int dim, int kind, int side) {
    uint64_t seed = (uint64_t)(kind + 10 * dim);
    int i, k, n = side * side * (dim == 3 ? side : 1);
    c->dim = dim;
    c->count = 0;
    for (i = 0; i < n; ++i) {
        double *x = &c->x[c->count * dim], square = 0;
        const int at[3] = {i % side, i / side % side, i / side / side};
        for (k = 0; k < dim; ++k) {
            x[k] = at[k] - 0.5 * (side - 1) + (kind == JITTERED ? 0.6 * (test_random(&seed) - 0.5) : 0);
            square += x[k] * x[k];
        }
        if (kind == BALL && square > 0.26 * side * side) continue;
        c->volume[c->count] = kind == JITTERED ? 0.7 + 0.6 * test_random(&seed) : 1;
        for (k = 0; k < dim; ++k) c->u[c->count * dim + k] = 0.04 * (test_random(&seed) - 0.5);
        c->count++;
    }
}

typedef struct turn {
    double r[3][3];
} turn;

static void apply(const turn *t, int dim, const double *in, double *out) {
    int a, b;
    for (a = 0; a < dim; ++a)
        for (out[a] = 0, b = 0; b < dim; ++b) out[a] += t->r[a][b] * in[b];
}

static void apply_back(const turn *t, int dim, const double *in, double *out) {
    int a, b;
    for (a = 0; a < dim; ++a)
        for (out[a] = 0, b = 0; b < dim; ++b) out[a] += t->r[b][a] * in[b];
}

/* By an angle in the plane. */
static turn turn_by(double angle) {
    turn t = {{{cos(angle), -sin(angle), 0}, {sin(angle), cos(angle), 0}, {0, 0, 1}}};
    return t;
}

/* Of a unit quaternion, which is one of a random point in a ball. */
static turn random_turn(uint64_t *seed) {
    double q[4], square = 2;
    turn t;
    int a, b;
    while (square > 1 || square < 0.1)
        for (square = 0, a = 0; a < 4; ++a) {
            q[a] = 2 * test_random(seed) - 1;
            square += q[a] * q[a];
        }
    for (a = 0; a < 3; ++a)
        for (b = 0; b < 3; ++b) {
            const double sign = (b - a + 3) % 3 == 1 ? -1 : 1;
            t.r[a][b] = a == b ? 1 - 2 * (q[(a + 1) % 3 + 1] * q[(a + 1) % 3 + 1] + q[(a + 2) % 3 + 1] * q[(a + 2) % 3 + 1]) / square
                               : 2 * (q[a + 1] * q[b + 1] + sign * q[0] * q[3 - a - b + 1]) / square;
        }
    return t;
}

/* Mirrors: axes exchanged, one of them reversed. Signed permutations are exact: squares stay squares. */
static turn signed_permutation(int dim, int number) {
    turn t = {{{0}}};
    const int shift = dim == 3 ? number % 3 : number % 2;
    int a;
    for (a = 0; a < dim; ++a) t.r[a][(a + shift) % dim] = (number >> a & 1) ? -1 : 1;
    return t;
}

typedef struct scene {
    int32_t law, space, correction, quadrature, influence, geometry;
    double  reach;
} scene;

static int32_t hump(void *user, double q, double *w) {
    (void)user;
    *w = 1 + q * (1 - q);
    return 0;
}

enum { SHOWN_STEP = 5, SHOWN = 7 };
static const char *const shown_name[SHOWN] = {"force", "energy density", "dilatation", "strain", "stress", "stable step",
                                              "energy"};

typedef struct answer {
    int32_t status;
    double  elastic, step, force[3 * MOST], density[MOST], theta[MOST], strain[MOST], stress[MOST];
} answer;

static void norm_of(peri_body *b, int32_t field, double *out) {
    double *tensor = get(b, field);
    const int dim = peri_dimension(b), parts = parts_of(dim);
    int64_t i;
    int k;
    for (i = 0; i < peri_point_count(b); ++i)
        for (out[i] = 0, k = 0; k < parts; ++k) out[i] += (k < dim ? 1 : 2) * pow(tensor[i * parts + k], 2);
    for (i = 0; i < peri_point_count(b); ++i) out[i] = sqrt(out[i]);
    free(tensor);
}

static void copy_field(peri_body *b, int32_t field, double *out) {
    (void)MUST(b, peri_get_field(b, field, out, peri_size_of_field(b, field)));
}

static peri_body *body_of(const scene *s, const cloud *c, const turn *t) {
    double x[3 * MOST];
    specimen p = specimen_of(s->space, s->law, 0.2, 1, s->reach, 1, 1, 1);
    peri_body *b;
    int i;
    p.desc.correction = s->correction;
    p.desc.quadrature = s->quadrature;
    p.desc.influence = s->influence;
    p.desc.influence_fn = hump;
    p.desc.geometry = s->geometry;
    b = specimen_start(&p);
    for (i = 0; i < c->count; ++i) apply(t, c->dim, &c->x[i * c->dim], &x[i * c->dim]);
    (void)MUST(b, peri_add_points(b, c->count, x, c->volume, NULL));
    return b;
}

static void answer_of(const scene *s, const cloud *c, const turn *t, answer *o) {
    double u[3 * MOST];
    peri_energy e;
    peri_body *b = body_of(s, c, t);
    int i;
    memset(o, 0, sizeof *o);
    o->status = peri_build(b);
    if (o->status == PERI_OK) {
        for (i = 0; i < c->count; ++i) apply(t, c->dim, &c->u[i * c->dim], &u[i * c->dim]);
        put(b, PERI_FIELD_DISPLACEMENT, u);
        (void)MUST(b, peri_get_energy(b, &e));
        o->elastic = e.elastic;
        o->step = peri_stable_step(b);
        copy_field(b, PERI_FIELD_FORCE_DENSITY, u);
        for (i = 0; i < c->count; ++i) apply_back(t, c->dim, &u[i * c->dim], &o->force[i * c->dim]);
        copy_field(b, PERI_FIELD_ENERGY_DENSITY, o->density);
        copy_field(b, PERI_FIELD_DILATATION, o->theta);
        norm_of(b, PERI_FIELD_STRAIN, o->strain);
        norm_of(b, PERI_FIELD_STRESS, o->stress);
    }
    peri_body_destroy(b);
}

static double apart(const double *a, const double *b, int n) {
    double most = 0, size = 0;
    int k;
    for (k = 0; k < n; ++k) {
        most = fmax(most, fabs(a[k] - b[k]));
        size = fmax(size, fabs(a[k]));
    }
    return size > 0 ? most / size : most;
}

/* Poles take w'/w to 60 and more; the moment correction solves a system, that of the equilibrium one of the whole body, to 1e-12. */
static double bound_of(const scene *s) {
    const int pole = s->influence >= PERI_INFLUENCE_POLE_EDGE && s->influence <= PERI_INFLUENCE_POLE_QUARTER;
    const double solved = s->correction == PERI_CORRECTION_MOMENT ? 100 : s->correction == PERI_CORRECTION_EQUILIBRIUM ? 1000 : 1;
    return (pole ? 1e-10 : 1e-12) * solved;
}

static void compare(const scene *s, int kind, const cloud *c, const answer *a, const answer *b) {
    const double off[SHOWN] = {apart(a->force, b->force, c->count * c->dim), apart(a->density, b->density, c->count),
                               apart(a->theta, b->theta, c->count), apart(a->strain, b->strain, c->count),
                               apart(a->stress, b->stress, c->count), apart(&a->step, &b->step, 1), apart(&a->elastic, &b->elastic, 1)};
    int k;
    CHECK(a->status == b->status);
    if (a->status < 0) return;
    CHECK(fabs(a->elastic) > 0 && a->step > 0);
    for (k = 0; k < SHOWN; ++k) {
        /* the stable step is estimated from one start, which does not turn: within the 3 % of its margin, in twelve bits */
        const double bound = k == SHOWN_STEP ? 0.01 : bound_of(s);
        if (!(off[k] < bound)) {
            CHECK(off[k] < bound);
            if (test_bad <= 10)
                printf("      %s, %s, %s, quadrature %d, influence %d, m %.2f, cloud %d: %s off by %.2g\n", law_name[s->law % 100],
                       space_name[s->space % 100], correction_name[s->correction % 100], (int)s->quadrature, (int)s->influence, s->reach,
                       kind, shown_name[k], off[k]);
        }
    }
}

/* What the library takes (theory.md): bond-based laws no weights without moments; others no corrections of volume, and by energy the same
   as none, nor the rules of centroids, which take no correction. */
static int is_taken(const scene *s) {
    const int bonds = s->law == PERI_LAW_BOND_BASED, planar = s->quadrature >= PERI_QUADRATURE_PARTIAL_CENTROID;
    if (bonds && (s->influence == PERI_INFLUENCE_INVERSE_4 || s->influence == PERI_INFLUENCE_POLE_HALF
                  || s->influence == PERI_INFLUENCE_POLE_QUARTER)) return 0;
    if (!bonds && (s->correction == PERI_CORRECTION_VOLUME || s->correction == PERI_CORRECTION_ENERGY)) return 0;
    return !planar || (bonds && s->space != PERI_SPACE_SOLID && s->correction == PERI_CORRECTION_NONE);
}

static const double reaches[2] = {2.05, 3.05};

/* All laws, corrections, quadratures first..last and influence functions in a space: every `stride`-th of them, with one of the clouds,
   horizons and turns of the table, in turn; in long runs all of them with all clouds and horizons. */
static void all_of(int32_t space, int32_t first, int32_t last, int stride, int turns, const turn *table) {
    static cloud c;
    static answer a, b;
    const turn none = turn_by(0);
    const int dim = dim_of(space);
    int number = 0, seen = 0, tried = 0, way, k;
    scene s;
    s.space = space;
    for (s.law = PERI_LAW_BOND_BASED; s.law < peri__end_law; ++s.law)
        for (s.correction = PERI_CORRECTION_NONE; s.correction < peri__end_correction; ++s.correction)
            for (s.quadrature = first; s.quadrature <= last; ++s.quadrature)
                for (s.influence = PERI_INFLUENCE_CONSTANT; s.influence <= PERI_INFLUENCE_USER; ++s.influence) {
                    if (!is_taken(&s) || (!test_long && ++tried % stride)) continue;
                    for (way = 0; way < 2 * CLOUDS; ++way) {
                        const int kind = way % CLOUDS;
                        if (!test_long && way != number % (2 * CLOUDS)) continue;
                        s.reach = reaches[way / CLOUDS];
                        s.geometry = (number + way) % 2 ? PERI_GEOMETRY_LINEAR : PERI_GEOMETRY_NONLINEAR;
                        fill(&c, dim, kind, dim == 2 ? 6 : first == PERI_QUADRATURE_FULL ? 4 : 3); /* parts of cells in 3D take long */
                        answer_of(&s, &c, &none, &a);
                        for (k = 0; k < turns; ++k) {
                            if (k != (number / 2 + way) % turns) continue;
                            answer_of(&s, &c, &table[k], &b);
                            compare(&s, kind, &c, &a, &b);
                            seen += a.status == PERI_OK;
                        }
                    }
                    number++;
                }
    CHECK(number >= 20 && seen > 0.9 * number);
}

static void turned_planes(void) {
    const turn table[5] = {turn_by(0.25 * PI), turn_by(0.3), turn_by(1), turn_by(0.5 * PI - 1e-3), turn_by(-2)};
    all_of(PERI_SPACE_PLANE_STRESS, PERI_QUADRATURE_FULL, PERI_QUADRATURE_RAMP, 1, 5, table);
    all_of(PERI_SPACE_PLANE_STRAIN, PERI_QUADRATURE_FULL, PERI_QUADRATURE_RAMP, 1, test_long ? 5 : 2, table);
}

static void turned_solids(void) {
    turn table[5];
    uint64_t seed = 3;
    int k;
    for (k = 0; k < 5; ++k) table[k] = k == 4 ? turn_by(0.25 * PI) : random_turn(&seed);
    all_of(PERI_SPACE_SOLID, PERI_QUADRATURE_FULL, PERI_QUADRATURE_RAMP, 5, test_long ? 5 : 3, table);
}

/* Permuted axes, mirrored or not, keep squares squares. */
static void mirrored(void) {
    static const int numbers[5] = {1, 4, 5, 6, 2};
    turn table[5];
    int32_t space;
    int k;
    for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space) {
        const int deep = space == PERI_SPACE_SOLID, count = deep && !test_long ? 3 : 5;
        for (k = 0; k < 5; ++k) table[k] = signed_permutation(dim_of(space), numbers[k]);
        all_of(space, PERI_QUADRATURE_PARTIAL, PERI_QUADRATURE_PARTIAL_MOMENT, deep ? 7 : 3, count, table);
    }
}
/* ---- lattices along the axes by columns, and turned ones by the list ----------------------------------------------- */

static void columns_and_lists(void) {
    static const double hi[3] = {12, 11, 10}, zero[3] = {0, 0, 0};
    static const char *const kept[2] = {"columns", "list"};
    int32_t space, law;
    for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; space += 2)
        for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law) {
            const int dim = dim_of(space);
            const turn turns[2] = {turn_by(0), turn_by(0.7)};
            specimen p = specimen_of(space, law, 0.3, 1, 2.05, 1, 1, 1);
            double *x = NULL, *u[2], *f[2], v[1500];
            peri_energy e[2];
            int k;
            int64_t i, n = 0;
            for (k = 0; k < 2; ++k) {
                peri_body *b;
                p.desc.kernel = k == 0 ? PERI_KERNEL_BEST : PERI_KERNEL_LIST;
                b = specimen_start(&p);
                if (k == 0) (void)MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), zero, hi, 1));
                else (void)MUST(b, peri_add_points(b, n, x, v, NULL));
                (void)MUST(b, peri_build(b));
                CHECK(strncmp(peri_kernel_text(b), kept[k], strlen(kept[k])) == 0);
                if (k == 0) {
                    x = get(b, PERI_FIELD_POSITION);
                    n = peri_point_count(b);
                    CHECK(n <= 1500);
                    for (i = 0; i < n && i < 1500; ++i) v[i] = 1;
                }
                u[k] = random_field(n * dim, 0.01, 9);
                for (i = 0; i < n && k == 0; ++i) {
                    double y[3];
                    apply(&turns[1], dim, &x[i * dim], y);
                    memcpy(&x[i * dim], y, (size_t)dim * sizeof *y);
                }
                for (i = 0; i < n && k == 1; ++i) apply(&turns[1], dim, &u[0][i * dim], &u[1][i * dim]);
                put(b, PERI_FIELD_DISPLACEMENT, u[k]);
                (void)MUST(b, peri_get_energy(b, &e[k]));
                f[k] = get(b, PERI_FIELD_FORCE_DENSITY);
                peri_body_destroy(b);
            }
            for (i = 0; i < n; ++i) {
                double back[3];
                apply_back(&turns[1], dim, &f[1][i * dim], back);
                memcpy(&f[1][i * dim], back, (size_t)dim * sizeof *back);
            }
            CHECK(apart(f[0], f[1], (int)n * dim) < 1e-12);
            CHECK_NEAR(e[1].elastic, e[0].elastic, 1e-12, 0);
            for (k = 0; k < 2; ++k) {
                free(u[k]);
                free(f[k]);
            }
            free(x);
        }
}

/* ---- loads and breaking ------------------------------------------------------------------------------------------- */

/* The points of the upper half along the first axis of the cloud as it lies unturned. */
static int32_t upper_half(peri_body *b, const cloud *c) {
    int32_t points[MOST];
    int i, count = 0;
    for (i = 0; i < c->count; ++i)
        if (c->x[i * c->dim] > 0) points[count++] = i;
    return (int32_t)MUST(b, peri_select_points(b, NULL, count, points));
}

/* A traction with shear on one face and a pressure: the forces turn with the normal and the value. Of solids the face has no axis of its
   own. */
static void turned_loads(void) {
    static cloud c;
    int32_t space, law, correction;
    uint64_t seed = 8;
    for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; space += 2)
        for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law)
            for (correction = PERI_CORRECTION_NONE; correction < peri__end_correction; correction += 3) {
                const scene s = {law, space, correction, PERI_QUADRATURE_FULL, PERI_INFLUENCE_LINEAR, PERI_GEOMETRY_LINEAR, 2.05};
                static const double normal[3] = {1, 0, 0}, value[3] = {0.01, 0.02, -0.015};
                const int dim = dim_of(space), pressed = correction == PERI_CORRECTION_MOMENT;
                double force[2][3 * MOST], read[3 * MOST];
                int k, i;
                fill(&c, dim, JITTERED, dim == 3 ? 6 : 9);
                for (k = 0; k < 2; ++k) {
                    const turn t = k == 0 ? turn_by(0) : dim == 3 ? random_turn(&seed) : turn_by(1.1);
                    peri_body *b = body_of(&s, &c, &t);
                    double n[3], v[3];
                    (void)MUST(b, peri_build(b));
                    apply(&t, dim, normal, n);
                    apply(&t, dim, value, v);
                    if (pressed) (void)MUST(b, peri_apply_pressure(b, upper_half(b, &c), 0.1, NULL, NULL));
                    (void)MUST(b, peri_apply_traction(b, upper_half(b, &c), dim == 3 ? 36 : 9, n, v, NULL, NULL));
                    copy_field(b, PERI_FIELD_FORCE_DENSITY, read);
                    for (i = 0; i < c.count; ++i) apply_back(&t, dim, &read[i * dim], &force[k][i * dim]);
                    peri_body_destroy(b);
                }
                CHECK(largest(force[0], c.count * dim) > 0);
                CHECK(apart(force[0], force[1], c.count * dim) < 1e-10);
            }
}

/* Bodies torn by a start with velocities break the same bonds in the same steps, under every criterion. 1e-9: rounding grows over 30 steps
   of a motion without order. */
static void turned_breaks(void) {
    static cloud c;
    int32_t space, law, criterion;
    uint64_t seed = 21;
    for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; space += 2)
        for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law)
            for (criterion = PERI_CRITERION_STRETCH; criterion <= PERI_CRITERION_NODE_ENERGY; ++criterion) {
                const int dim = dim_of(space);
                double moved[2][3 * MOST], read[3 * MOST], speed[3 * MOST];
                int64_t broken[2];
                int k, i, d;
                if (law == PERI_LAW_BOND_BASED && criterion != PERI_CRITERION_STRETCH) continue;
                fill(&c, dim, JITTERED, dim == 3 ? 5 : 8);
                for (k = 0; k < 2; ++k) {
                    const turn t = k == 0 ? turn_by(0) : dim == 3 ? random_turn(&seed) : turn_by(0.8);
                    specimen p = specimen_of(space, law, 0.2, 1, 2.05, 1, 1, 1);
                    peri_body *b;
                    p.material.criterion = criterion;
                    p.material.fracture_energy = criterion == PERI_CRITERION_NODE_ENERGY ? 0.005 : 0.02;
                    b = specimen_start(&p);
                    for (i = 0; i < c.count; ++i) {
                        double v[3] = {0, 0, 0};
                        apply(&t, dim, &c.x[i * dim], &read[i * dim]);
                        for (d = 0; d < dim; ++d) v[d] = 0.05 * c.x[i * dim + d] + c.u[i * dim + d];
                        apply(&t, dim, v, &speed[i * dim]);
                    }
                    (void)MUST(b, peri_add_points(b, c.count, read, c.volume, NULL));
                    (void)MUST(b, peri_build(b));
                    put(b, PERI_FIELD_VELOCITY, speed);
                    (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 30, 0.1, 0);
                    broken[k] = peri_broken_count(b);
                    copy_field(b, PERI_FIELD_DISPLACEMENT, read);
                    for (i = 0; i < c.count; ++i) apply_back(&t, dim, &read[i * dim], &moved[k][i * dim]);
                    peri_body_destroy(b);
                }
                CHECK(broken[0] > 0 && broken[0] == broken[1]);
                CHECK(apart(moved[0], moved[1], c.count * dim) < 1e-9);
            }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(turned_planes);
    RUN(turned_solids);
    RUN(mirrored);
    RUN(columns_and_lists);
    RUN(turned_loads);
    RUN(turned_breaks);
    return test_end("test_frame");
}
