/* SPDX-License-Identifier: MIT */
/* stretches.c - bodies stretched, squeezed, turned inside out, thrown about and collapsed, for each law in each space. */
#include "dense.h"

typedef struct scene { /* one body of the loop, and what it is made of                                                    */
    const extreme *row;
    outcome       *o;
    peri_body     *body;
    peri_body_desc desc;
    peri_material_desc  material[2]; /* the second only of the right half of a mixture                                          */
    int            cloud, mixture;
} scene;

typedef double (*probe_fn)(scene *s);

/* A box of 64 cells, its right half of the second material. */
static peri_body *mix(scene *s, int edge) {
    const double lo[3] = {0, 0, 0}, middle[3] = {edge / 2, 0, 0}, half[3] = {edge / 2, edge, edge}, hi[3] = {edge, edge, edge};
    outcome *o = s->o;
    peri_body *b = NULL;
    (void)(extreme_fails(o, NULL, peri_body_create(&s->desc, &b, NULL)) || extreme_fails(o, b, peri_add_material(b, &s->material[0]))
           || extreme_fails(o, b, peri_add_material(b, &s->material[1]))
           || extreme_fails(o, b, peri_add_box(b, material_id(b, 1), lo, half, 1))
           || extreme_fails(o, b, peri_add_box(b, material_id(b, 2), middle, hi, 1)) || extreme_fails(o, b, peri_build(b)));
    if (o->status >= 0) return b;
    peri_body_destroy(b);
    return NULL;
}

/* A unit lattice, or 64 points moved off one, with volumes of 0.5 to 1.5. All are short binary fractions with a mean volume of 1 and a
   corner at the origin: places are exact in single precision and in the units of the body, so points can be made to meet exactly. */
static peri_body *make(scene *s) {
    const int dim = s->desc.space == PERI_SPACE_SOLID ? 3 : 2, n = dim == 3 ? 5 : 9, edge = dim == 3 ? 4 : 8;
    double x[3 * 64], volume[64];
    uint64_t seed = 7;
    int i, d, at;
    if (s->mixture) return mix(s, edge);
    if (!s->cloud) return dense_box(s->o, &s->desc, s->material, n);
    for (i = 0; i < 64; ++i) {
        for (d = 0, at = i; d < dim; ++d, at /= edge) x[i * dim + d] = at % edge + (i > 0 ? floor(150 * test_random(&seed)) / 256 : 0);
        volume[i] = i < 32 ? 0.5 + floor(64 * test_random(&seed)) / 64 : 2 - volume[i - 32];
    }
    return dense_cloud(s->o, &s->desc, s->material, 64, x, volume);
}

/* The worst error of a probe over spaces, laws, and every step-th kind: lattices by each kernel, clouds, and mixtures
   with the next law. */
static outcome each(const extreme *row, int32_t precision, int32_t geometry, double stretch, int step, probe_fn probe) {
    outcome o = {PERI_OK, "", 0};
    int32_t space, law;
    int kind;
    for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
        for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law)
            for (kind = 0; kind < 5 && o.status >= 0; kind += step) {
                scene s;
                double error;
                s.row = row;
                s.o = &o;
                s.cloud = kind == 3;
                s.mixture = kind == 4;
                extreme_desc(&s.desc, space, precision, space == PERI_SPACE_SOLID ? 2 : 3);
                s.desc.geometry = geometry;
                s.desc.kernel = kind < 3 ? PERI_KERNEL_BEST + kind : PERI_KERNEL_BEST;
                extreme_material(&s.material[0], law, 0.3, stretch);
                extreme_material(&s.material[1], law == PERI_LAW_CORRESPONDENCE ? PERI_LAW_BOND_BASED : law + 1, 0.1, stretch);
                s.body = make(&s);
                error = s.body ? probe(&s) : NAN;
                dense_note(&o, error, space, law);
                o = extreme_end(o, s.body);
            }
    return o;
}

static int is_tensor(const scene *s) {
    return s->material[0].law == PERI_LAW_CORRESPONDENCE || (s->mixture && s->material[1].law == PERI_LAW_CORRESPONDENCE);
}

static double dense_of(scene *s) { return dense_error(s->o, s->body, &s->desc, s->material); }

static void stretch_by(scene *s, double x, double y, double z) {
    const double two[4] = {x - 1, 0, 0, y - 1}, three[9] = {x - 1, 0, 0, 0, y - 1, 0, 0, 0, z - 1};
    extreme_affine(s->o, s->body, s->desc.space == PERI_SPACE_SOLID ? three : two, NULL);
}

/* ---- uniform ------------------------------------------------------------------------------------------------------ */

/* Energy density of point i under the same stretch in all directions. */
static double closed_form(const scene *s, double stretch, const double *x, const double *volume, int64_t i) {
    const int dim = s->desc.space == PERI_SPACE_SOLID ? 3 : 2;
    const peri_material_desc *m = &s->material[s->mixture && x[i * dim] > (dim == 3 ? 2 : 4)];
    const dense_moduli law = dense_moduli_of(m, s->desc.space);
    const double green = s->desc.geometry == PERI_GEOMETRY_LINEAR ? stretch : stretch * (1 + 0.5 * stretch),
        h = s->desc.horizon * (1 + 1e-8);
    double sum = 0;
    int64_t j, count = peri_point_count(s->body);
    int d;
    if (m->law == PERI_LAW_CORRESPONDENCE) return 0.5 * dim * dim * law.bulk * green * green;
    if (m->law != PERI_LAW_BOND_BASED) return 0.5 * dim * dim * law.bulk * stretch * stretch;
    for (j = 0; j < count; ++j) {
        double square = 0;
        for (d = 0; d < dim; ++d) square += pow(x[j * dim + d] - x[i * dim + d], 2);
        if (square <= h * h) sum += sqrt(square) * volume[j];
    }
    return 0.25 * dense_micromodulus(s->desc.space, s->desc.horizon) * stretch * stretch * sum;
}

static double uniform_error(scene *s, double stretch) {
    double *x = extreme_read(s->o, s->body, PERI_FIELD_POSITION), *volume = extreme_read(s->o, s->body, PERI_FIELD_VOLUME);
    double *energy = extreme_read(s->o, s->body, PERI_FIELD_ENERGY_DENSITY), worst = 0;
    int64_t i;
    for (i = 0; x && volume && energy && i < peri_point_count(s->body); ++i)
        worst = extreme_worst(worst, fabs(energy[i] / closed_form(s, stretch, x, volume, i) - 1));
    free(x), free(volume), free(energy);
    return worst;
}

static double uniform_probe(scene *s) {
    const double to = s->row->value;
    stretch_by(s, to, to, to);
    return extreme_worst(uniform_error(s, to - 1), dense_of(s));
}

static outcome uniform(const extreme *row, int32_t precision) { return each(row, precision, row->choice, 0, 1, uniform_probe); }

static double strained_probe(scene *s) {
    stretch_by(s, s->row->value, s->row->other, 0.7);
    return dense_of(s);
}

static outcome strained(const extreme *row, int32_t precision) { return each(row, precision, row->choice, 0, 1, strained_probe); }

/* A mirror image: every length is as it was. */
static double mirrored_probe(scene *s) {
    double error, at_stake, *energy;
    int64_t i;
    stretch_by(s, -1, 1, 1);
    error = dense_of(s);
    energy = extreme_read(s->o, s->body, PERI_FIELD_ENERGY_DENSITY);
    for (at_stake = 0, i = 0; energy && i < peri_point_count(s->body); ++i) at_stake = extreme_worst(at_stake, fabs(energy[i]));
    free(energy);
    return extreme_worst(error, at_stake);
}

static outcome mirrored(const extreme *row, int32_t precision) {
    return each(row, precision, PERI_GEOMETRY_NONLINEAR, 0, 1, mirrored_probe);
}

/* ---- thrown about ------------------------------------------------------------------------------------------------- */

static double scattered_probe(scene *s) {
    dense_scatter(s->o, s->body, s->row->value, 11);
    return dense_of(s);
}

static outcome scattered(const extreme *row, int32_t precision) { return each(row, precision, row->choice, 0, 1, scattered_probe); }

/* Points 0 and 1 meet, at the place of point 2, which all others leave by up to row->value. */
static double meeting_probe(scene *s) {
    const int dim = peri_dimension(s->body);
    double *x = extreme_read(s->o, s->body, PERI_FIELD_POSITION), *u;
    int d, k;
    dense_scatter(s->o, s->body, s->row->value, 13);
    u = extreme_read(s->o, s->body, PERI_FIELD_DISPLACEMENT);
    for (d = 0; x && u && d < dim; ++d)
        for (k = 0; k < 3; ++k) u[k * dim + d] = x[2 * dim + d] - x[k * dim + d];
    if (u) (void)extreme_fails(s->o, s->body, peri_set_field(s->body, PERI_FIELD_DISPLACEMENT, u,
                                                             peri_size_of_field(s->body, PERI_FIELD_DISPLACEMENT)));
    free(x), free(u);
    return dense_of(s);
}

static outcome meeting(const extreme *row, int32_t precision) { return each(row, precision, PERI_GEOMETRY_NONLINEAR, 0, 1, meeting_probe); }

/* Displacements whose cubes leave the range of float are refused, before they are taken, where P = F S takes cubes. */
static double far_probe(scene *s) {
    const int64_t n = peri_size_of_field(s->body, PERI_FIELD_DISPLACEMENT);
    double u[3 * 125] = {0}, largest = 0;
    int64_t i;
    if (!is_tensor(s) || s->desc.precision == PERI_PRECISION_DOUBLE) return scattered_probe(s);
    u[4] = s->row->value;
    if (peri_set_field(s->body, PERI_FIELD_DISPLACEMENT, u, n) != PERI_ERROR_RANGE) return 1;
    if (extreme_fails(s->o, s->body, peri_get_field(s->body, PERI_FIELD_DISPLACEMENT, u, n))) return NAN;
    for (i = 0; i < n; ++i) largest = extreme_worst(largest, fabs(u[i]));
    return largest;
}

static outcome far_away(const extreme *row, int32_t precision) { return each(row, precision, PERI_GEOMETRY_NONLINEAR, 0, 1, far_probe); }

/* Turned by 2.5 about an axis along no bond. */
static double turned_probe(scene *s) {
    const double c = cos(2.5), sine = sin(2.5), axis[3] = {1 / sqrt(14.0), 2 / sqrt(14.0), 3 / sqrt(14.0)};
    double two[4], three[9];
    int a, b;
    for (a = 0; a < 3; ++a)
        for (b = 0; b < 3; ++b) {
            const double cross = a == b ? 0 : (b == (a + 1) % 3 ? -1 : 1) * axis[3 - a - b];
            three[3 * a + b] = (1 - c) * axis[a] * axis[b] + sine * cross - (a == b ? 1 - c : 0);
        }
    two[0] = two[3] = c - 1;
    two[1] = -sine, two[2] = sine;
    extreme_affine(s->o, s->body, peri_dimension(s->body) == 3 ? three : two, NULL);
    return dense_of(s);
}

static outcome turned(const extreme *row, int32_t precision) { return each(row, precision, PERI_GEOMETRY_NONLINEAR, 0, 1, turned_probe); }

/* ---- in time ------------------------------------------------------------------------------------------------------ */

static void advance(scene *s, int64_t steps, double safety, double time_step) {
    peri_advance_desc run;
    peri_advance_desc_init(&run);
    run.steps = steps;
    run.safety = safety;
    run.time_step = time_step;
    if (s->o->status >= 0) (void)extreme_fails(s->o, s->body, peri_advance(s->body, &run));
}

/* Momenta after a run through each other, over the sums of their sizes. Bonds that shrink to nothing push their ends aside, with
   1 - f0/f of what they resist along themselves: no step is stable for those, and the default safety has room for none. */
static double passing_probe(scene *s) {
    const int dim = peri_dimension(s->body), tensor = is_tensor(s);
    double linear[3] = {0}, angular[3] = {0}, size = 0, arm = 0, p = 0, l = 0, *at, *v, *volume;
    int64_t i;
    int d;
    dense_scatter(s->o, s->body, tensor ? 0.3 : s->row->value, 17);
    advance(s, 100, tensor ? 0.2 : 0.45, 0);
    if (s->o->status < 0 || extreme_fails(s->o, s->body, peri_get_momentum(s->body, linear, angular))) return NAN;
    at = extreme_read(s->o, s->body, PERI_FIELD_CURRENT_POSITION);
    v = extreme_read(s->o, s->body, PERI_FIELD_VELOCITY);
    volume = extreme_read(s->o, s->body, PERI_FIELD_VOLUME);
    for (i = 0; at && v && volume && i < peri_point_count(s->body); ++i) {
        double speed = 0, far_ = 0;
        for (d = 0; d < dim; ++d) {
            speed += v[i * dim + d] * v[i * dim + d];
            far_ += at[i * dim + d] * at[i * dim + d];
        }
        size += sqrt(speed) * volume[i];
        arm += sqrt(speed * far_) * volume[i];
    }
    free(at), free(v), free(volume);
    for (d = 0; d < 3; ++d) {
        p += linear[d] * linear[d];
        l += angular[d] * angular[d];
    }
    return size > 0 ? extreme_worst(sqrt(p) / size, sqrt(l) / arm) : NAN;
}

static outcome passing(const extreme *row, int32_t precision) { return each(row, precision, PERI_GEOMETRY_NONLINEAR, 0, 1, passing_probe); }

/* Stretched to ten times, with a critical stretch a little above or below 9: none or all bonds break in one step, and then all fly on. */
static double breaking_probe(scene *s) {
    const double all = 0.5 * (double)peri_entry_count(s->body), *const value = &s->row->value;
    double before, worst, step;
    peri_energy e, later;
    stretch_by(s, 10, 10, 10);
    if (extreme_fails(s->o, s->body, peri_get_energy(s->body, &e))) return NAN;
    before = e.elastic;
    step = 1e-9 * peri_stable_step(s->body); /* kinetic energy, and so the error of a step, of 1e-16 of what is stored */
    advance(s, 1, 1, step);
    if (s->o->status < 0 || extreme_fails(s->o, s->body, peri_get_energy(s->body, &e))) return NAN;
    worst = fabs(e.error) / before;
    if (*value > 9) return extreme_worst(worst, (double)peri_broken_count(s->body) + fabs(e.elastic / before - 1));
    worst = extreme_worst(worst, fabs((double)peri_broken_count(s->body) - all) + e.elastic / before + fabs(e.fracture / before - 1));
    advance(s, 50, 0.9, 0);
    if (s->o->status < 0 || extreme_fails(s->o, s->body, peri_get_energy(s->body, &later))) return NAN;
    return extreme_worst(worst, fabs(later.kinetic / e.kinetic - 1));
}

static outcome breaking(const extreme *row, int32_t precision) {
    return each(row, precision, PERI_GEOMETRY_NONLINEAR, row->value, 1, breaking_probe);
}

/* Where the last layer of cells begins. */
static double inside(const scene *s) {
    return (s->desc.space == PERI_SPACE_SOLID ? 4 : 8) - (s->cloud || s->mixture ? 1 : 0);
}

static int32_t is_rim(void *user, int64_t index, const double *x) {
    const scene *s = (const scene *)user;
    const double inner = inside(s);
    int d, rim = 0;
    (void)index;
    for (d = 0; d < (s->desc.space == PERI_SPACE_SOLID ? 3 : 2); ++d) rim |= x[d] < 1 || x[d] > inner;
    return rim;
}

/* Stretched, held at its rim and shaken: what the energy is off, over the most kinetic energy seen. The tangent of Saint Venant-Kirchhoff
   along F = f 1 is f^2 (lambda + 2 mu) + S; the stable step is that at rest. */
static double shaken_probe(scene *s) {
    const double stretch = s->row->value, square = stretch * stretch, dim = peri_dimension(s->body);
    const dense_moduli law = dense_moduli_of(s->material, s->desc.space);
    const double harder = square + 0.5 * (square - 1) * dim * law.bulk / (law.lambda + 2 * law.mu);
    const double tensor = s->material[0].law == PERI_LAW_CORRESPONDENCE ? sqrt(harder) : 1;
    const int64_t n = peri_size_of_field(s->body, PERI_FIELD_VELOCITY);
    double v[3 * 125], shake = 0, worst = 0;
    uint64_t seed = 3;
    peri_energy e;
    int64_t i;
    int32_t rim;
    int part;
    stretch_by(s, stretch, stretch, stretch);
    rim = peri_select_if(s->body, "rim", is_rim, s);
    rim = peri_prescribe_velocity(s->body, rim, peri_dimension(s->body) == 3 ? PERI_AXIS_XYZ : PERI_AXIS_XY, NULL, NULL, NULL);
    if (extreme_fails(s->o, s->body, rim)) return NAN;
    for (i = 0; i < n; ++i) v[i] = 2 * test_random(&seed) - 1;
    if (extreme_fails(s->o, s->body, peri_set_field(s->body, PERI_FIELD_VELOCITY, v, n))) return NAN;
    for (part = 0; part < 10; ++part) {
        advance(s, 40, s->row->other / tensor, 0);
        if (s->o->status < 0 || extreme_fails(s->o, s->body, peri_get_energy(s->body, &e))) return NAN;
        shake = extreme_worst(shake, e.kinetic);
        worst = extreme_worst(worst, fabs(e.error));
    }
    return worst / shake;
}

static outcome shaken(const extreme *row, int32_t precision) { return each(row, precision, PERI_GEOMETRY_NONLINEAR, 0, 3, shaken_probe); }

/* ---- in equilibrium ----------------------------------------------------------------------------------------------- */

/* |V f| of the points that are at an end, or of the others. */
static double forces_of(scene *s, int ends) {
    const int dim = peri_dimension(s->body);
    double *f = extreme_read(s->o, s->body, PERI_FIELD_FORCE_DENSITY), *x = extreme_read(s->o, s->body, PERI_FIELD_POSITION), sum = 0;
    double *volume = extreme_read(s->o, s->body, PERI_FIELD_VOLUME);
    int64_t i;
    for (i = 0; f && x && volume && i < peri_size_of_field(s->body, PERI_FIELD_POSITION); ++i) {
        const double at = x[i - i % dim];
        if (ends == (at < 1 || at > inside(s))) sum += pow(f[i] * volume[i / dim], 2);
    }
    free(f), free(x), free(volume);
    return sqrt(sum);
}

/* The residual over the reactions: what bonds and loads leave on points that are not held, over what they leave on the others without
   their supports. */
static double unbalanced(scene *s, const int32_t *support) {
    const double left = forces_of(s, 0);
    (void)extreme_fails(s->o, s->body, peri_remove_load(s->body, support[0]));
    (void)extreme_fails(s->o, s->body, peri_remove_load(s->body, support[1]));
    return left / forces_of(s, 1);
}

static int32_t at_left(void *user, int64_t index, const double *x) {
    (void)user, (void)index;
    return x[0] < 1;
}

static int32_t at_right(void *user, int64_t index, const double *x) {
    (void)index;
    return x[0] > *(const double *)user;
}

/* A box of 9 x 9 or 5^3 cells, both ends held, one drawn away to row->value times the length: what peri.h calls converged is so, by the
   forces of the laws written out. */
static double drawn_probe(scene *s) {
    const int dim = peri_dimension(s->body);
    double right = inside(s);
    const double away[3] = {(s->row->value - 1) * (right + 1), 0, 0};
    const int32_t axes = dim == 3 ? PERI_AXIS_XYZ : PERI_AXIS_XY;
    int32_t load[2];
    peri_solve_desc p;
    double error;
    load[0] = peri_prescribe_displacement(s->body, peri_select_if(s->body, NULL, at_left, NULL), axes, NULL, NULL, NULL);
    load[1] = peri_prescribe_displacement(s->body, peri_select_if(s->body, NULL, at_right, &right), axes, away, NULL, NULL);
    peri_solve_desc_init(&p);
    p.steps = (int64_t)s->row->other;
    if (extreme_fails(s->o, s->body, load[0]) || extreme_fails(s->o, s->body, load[1])) return NAN;
    if (extreme_fails(s->o, s->body, peri_solve(s->body, &p, NULL))) return NAN;
    error = unbalanced(s, load);
    return dense_of(s) <= 100 * (s->desc.precision == PERI_PRECISION_DOUBLE ? 1.11e-16 : 5.96e-8) ? error : NAN;
}

static outcome drawn(const extreme *row, int32_t precision) { return each(row, precision, PERI_GEOMETRY_NONLINEAR, 0, 5, drawn_probe); }

/* From row->choice: 0 collapsed, 1 inside out and shaken, 2 thrown about: loads on the free part. An equilibrium that is one, or a failure
   that is named, with numbers that are finite. */
static double wild_probe(scene *s) {
    const int32_t axes = peri_dimension(s->body) == 3 ? PERI_AXIS_XYZ : PERI_AXIS_XY;
    double right = inside(s);
    const double force[3] = {1e-3, -2e-3, 1e-3};
    peri_solve_desc p;
    int32_t load[3], status;
    if (s->row->choice == 0) stretch_by(s, 0, 0, 0);
    else if (s->row->choice == 1) stretch_by(s, -1, 1, 1);
    if (s->row->choice > 0) dense_scatter(s->o, s->body, s->row->value, 79);
    load[0] = peri_prescribe_velocity(s->body, peri_select_if(s->body, NULL, at_left, NULL), axes, NULL, NULL, NULL);
    load[2] = peri_apply_body_force(s->body, PERI_ALL, force, NULL, NULL);
    load[1] = peri_prescribe_velocity(s->body, peri_select_if(s->body, NULL, at_right, &right), axes, NULL, NULL, NULL);
    peri_solve_desc_init(&p);
    p.iterations = 100;
    p.newton = 12;
    p.halvings = 0;
    if (extreme_fails(s->o, s->body, load[0]) || extreme_fails(s->o, s->body, load[1]) || extreme_fails(s->o, s->body, load[2])) return NAN;
    status = peri_solve(s->body, &p, NULL);
    if (status == PERI_ERROR_INDEFINITE || status == PERI_ERROR_CONVERGENCE || status == PERI_ERROR_LOOSE) return 0;
    if (extreme_fails(s->o, s->body, status)) return NAN;
    return unbalanced(s, load);
}

static outcome wild(const extreme *row, int32_t precision) { return each(row, precision, PERI_GEOMETRY_NONLINEAR, 0, 2, wild_probe); }

static const extreme rows[] = {
    {"10 times as long", "closed forms of W under e = 9|xi|; the laws written out", uniform, 10, 0, PERI_GEOMETRY_NONLINEAR, PERI_OK, NULL,
     ROUNDINGS(100)},
    {"10 times as long, linear", "closed forms of W under e = 9|xi|; the laws written out", uniform, 10, 0, PERI_GEOMETRY_LINEAR, PERI_OK,
     NULL, ROUNDINGS(100)},
    {"a million times as long", "closed forms of W", uniform, 1e6, 0, PERI_GEOMETRY_NONLINEAR, PERI_OK, NULL, ROUNDINGS(100)},
    {"compressed by 99 %", "closed forms of W under e = -0.99|xi|; the laws written out", uniform, 0.01, 0, PERI_GEOMETRY_NONLINEAR,
     PERI_OK, NULL, ROUNDINGS(100)},
    {"collapsed into one point", "closed forms of W under e = -|xi|; no direction, no force", uniform, 0, 0, PERI_GEOMETRY_NONLINEAR,
     PERI_OK, NULL, ROUNDINGS(100)},
    {"stretched and sheared flat", "the laws written out", strained, 30, 0, PERI_GEOMETRY_NONLINEAR, PERI_OK, NULL, ROUNDINGS(100)},
    {"mirrored", "a mirror image has the lengths of its original: W = 0", mirrored, 0, 0, 0, PERI_OK, NULL, ROUNDINGS(100)},
    {"inside out and stretched", "the laws written out", strained, -3, 0.2, PERI_GEOMETRY_NONLINEAR, PERI_OK, NULL, ROUNDINGS(100)},
    {"inside out, linear", "the laws written out", strained, -3, 0.2, PERI_GEOMETRY_LINEAR, PERI_OK, NULL, ROUNDINGS(100)},
    {"points pass through each other", "the laws written out", scattered, 3, 0, PERI_GEOMETRY_NONLINEAR, PERI_OK, NULL, ROUNDINGS(100)},
    {"points pass, linear", "the laws written out", scattered, 3, 0, PERI_GEOMETRY_LINEAR, PERI_OK, NULL, ROUNDINGS(100)},
    {"thrown by 1e10 spacings", "the laws written out", scattered, 1e10, 0, PERI_GEOMETRY_NONLINEAR, PERI_OK, NULL, ROUNDINGS(100)},
    {"thrown by 1e10 spacings, linear", "the laws written out", scattered, 1e10, 0, PERI_GEOMETRY_LINEAR, PERI_OK, NULL, ROUNDINGS(100)},
    {"thrown by 9e14 spacings", "the laws written out; refused where the cubes of F leave the range of float", far_away, 9e14, 0, 0,
     PERI_OK,
     NULL, ROUNDINGS(100)},
    {"turned by 2.5", "the laws written out", turned, 0, 0, 0, PERI_OK, NULL, ROUNDINGS(100)},
    {"three points meet", "no direction, no force; the laws written out", meeting, 0.1, 0, 0, PERI_OK, NULL, ROUNDINGS(100)},
    {"three points meet, others 1e9 away", "no direction, no force; the laws written out", meeting, 1e9, 0, 0, PERI_OK, NULL,
     ROUNDINGS(100)},
    {"100 steps through each other", "both momenta stay 0, to 30 roundings per step", passing, 1.5, 0, 0, PERI_OK, NULL, ROUNDINGS(3000)},
    {"critical stretch just above", "no bond breaks", breaking, 9.009, 0, 0, PERI_OK, NULL, ROUNDINGS(1000)},
    {"critical stretch just below", "all bonds break; W goes into fracture; Newton's first law", breaking, 8.991, 0, 0, PERI_OK, NULL,
     ROUNDINGS(1000)},
    {"shaken at twice the length", "velocity-Verlet: within (omega dt)^2/4, omega dt <= 0.4, for ever", shaken, 2, 0.2, 0, PERI_OK, NULL,
     {0.04, 0.04, 0.04}},
    {"shaken at ten times the length", "velocity-Verlet: within (omega dt)^2/4, omega dt <= 0.4, for ever", shaken, 10, 0.2, 0, PERI_OK,
     NULL, {0.04, 0.04, 0.04}},
    {"drawn to twice the length", "peri.h: |residual| <= tolerance |reactions|; the laws written out", drawn, 2, 4, 0, PERI_OK, NULL,
     {1.1e-8, 1.1e-5, 1.1e-4}},
    {"drawn to ten times the length", "peri.h: |residual| <= tolerance |reactions|; the laws written out", drawn, 10, 12, 0, PERI_OK, NULL,
     {1.1e-8, 1.1e-5, 1.1e-4}},
    {"equilibrium from a collapsed body", "peri.h: |residual| <= tolerance |reactions|, or a named failure", wild, 0, 0, 0, PERI_OK, NULL,
     {1.1e-8, 1.1e-5, 1.1e-4}},
    {"equilibrium from inside out", "peri.h: |residual| <= tolerance |reactions|, or a named failure", wild, 0.3, 0, 1, PERI_OK, NULL,
     {1.1e-8, 1.1e-5, 1.1e-4}},
    {"equilibrium from a throw", "peri.h: |residual| <= tolerance |reactions|, or a named failure", wild, 3, 0, 2, PERI_OK, NULL,
     {1.1e-8, 1.1e-5, 1.1e-4}},
};
const extreme_table extreme_stretches = EXTREME_TABLE("stretches", rows);
