/* stretches.c - bodies stretched, squeezed, turned inside out, thrown about and collapsed, for each law in each space. */
#include "dense.h"

typedef struct scene { /* one body of the loop, and what it is made of                                                    */
    const extreme *row;
    outcome       *o;
    peri_body     *body;
    peri_body_desc desc;
    peri_material  material;
    int            cloud;
} scene;

typedef double (*probe_fn)(scene *s);

/* A unit lattice, or 64 points moved off one, with volumes of 0.5 to 1.5. All are short binary fractions with a mean volume of 1 and a corner
   at the origin: places are exact in single precision and in the units of the body, so points can be made to meet exactly. */
static peri_body *make(scene *s) {
    const int n = s->desc.space == PERI_SOLID ? 5 : 9, edge = s->desc.space == PERI_SOLID ? 4 : 8, dim = s->desc.space == PERI_SOLID ? 3 : 2;
    double x[3 * 64], volume[64];
    uint64_t seed = 7;
    int i, d, at;
    if (!s->cloud) return dense_box(s->o, &s->desc, &s->material, n);
    for (i = 0; i < 64; ++i) {
        for (d = 0, at = i; d < dim; ++d, at /= edge) x[i * dim + d] = at % edge + (i > 0 ? floor(150 * test_random(&seed)) / 256 : 0);
        volume[i] = i < 32 ? 0.5 + floor(64 * test_random(&seed)) / 64 : 2 - volume[i - 32];
    }
    return dense_cloud(s->o, &s->desc, &s->material, 64, x, volume);
}

/* The worst error of a probe over spaces, laws, lattices by each kernel, and clouds. */
static outcome each(const extreme *row, int32_t precision, int32_t geometry, double stretch, probe_fn probe) {
    outcome o = {PERI_OK, "", 0};
    int32_t space, model;
    int kind;
    for (space = PERI_PLANE_STRESS; space <= PERI_SOLID; ++space)
        for (model = PERI_BOND_BASED; model <= PERI_CORRESPONDENCE; ++model)
            for (kind = 0; kind < 4 && o.status >= 0; ++kind) {
                scene s;
                double error;
                s.row = row;
                s.o = &o;
                s.cloud = kind == 3;
                extreme_desc(&s.desc, space, precision, space == PERI_SOLID ? 2 : 3);
                s.desc.geometry = geometry;
                s.desc.kernel = kind < 3 ? kind : PERI_KERNEL_BEST;
                extreme_material(&s.material, model, 0.3, stretch);
                s.body = make(&s);
                error = s.body ? probe(&s) : NAN;
                dense_note(&o, error, space, model);
                o = extreme_end(o, s.body);
            }
    return o;
}

static double dense_of(scene *s) { return dense_error(s->o, s->body, &s->desc, &s->material); }

static void stretch_by(scene *s, double x, double y, double z) {
    const double two[4] = {x - 1, 0, 0, y - 1}, three[9] = {x - 1, 0, 0, 0, y - 1, 0, 0, 0, z - 1};
    extreme_affine(s->o, s->body, s->desc.space == PERI_SOLID ? three : two, NULL);
}

/* ---- uniform ------------------------------------------------------------------------------------------------------ */

/* Energy density of point i under the same stretch in all directions. */
static double closed_form(const scene *s, double stretch, const double *x, const double *volume, int64_t i) {
    const dense_moduli law = dense_moduli_of(&s->material, s->desc.space);
    const int dim = s->desc.space == PERI_SOLID ? 3 : 2;
    const double green = s->desc.geometry == PERI_LINEAR ? stretch : stretch * (1 + 0.5 * stretch), h = s->desc.horizon * (1 + 1e-8);
    double sum = 0;
    int64_t j, count = peri_point_count(s->body);
    int d;
    if (s->material.model == PERI_CORRESPONDENCE) return 0.5 * dim * dim * law.bulk * green * green;
    if (s->material.model != PERI_BOND_BASED) return 0.5 * dim * dim * law.bulk * stretch * stretch;
    for (j = 0; j < count; ++j) {
        double square = 0;
        for (d = 0; d < dim; ++d) square += pow(x[j * dim + d] - x[i * dim + d], 2);
        if (square <= h * h) sum += sqrt(square) * volume[j];
    }
    return 0.25 * dense_micromodulus(s->desc.space, s->desc.horizon) * stretch * stretch * sum;
}

static double uniform_error(scene *s, double stretch) {
    double *x = extreme_read(s->o, s->body, PERI_POSITION), *volume = extreme_read(s->o, s->body, PERI_VOLUME);
    double *energy = extreme_read(s->o, s->body, PERI_ENERGY_DENSITY), worst = 0;
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

static outcome uniform(const extreme *row, int32_t precision) { return each(row, precision, row->choice, 0, uniform_probe); }

static double strained_probe(scene *s) {
    stretch_by(s, s->row->value, s->row->other, 0.7);
    return dense_of(s);
}

static outcome strained(const extreme *row, int32_t precision) { return each(row, precision, row->choice, 0, strained_probe); }

/* A mirror image: every length is as it was. */
static double mirrored_probe(scene *s) {
    double error, at_stake, *energy;
    int64_t i;
    stretch_by(s, -1, 1, 1);
    error = dense_of(s);
    energy = extreme_read(s->o, s->body, PERI_ENERGY_DENSITY);
    for (at_stake = 0, i = 0; energy && i < peri_point_count(s->body); ++i) at_stake = extreme_worst(at_stake, fabs(energy[i]));
    free(energy);
    return extreme_worst(error, at_stake);
}

static outcome mirrored(const extreme *row, int32_t precision) { return each(row, precision, PERI_NONLINEAR, 0, mirrored_probe); }

/* ---- thrown about ------------------------------------------------------------------------------------------------- */

static double scattered_probe(scene *s) {
    dense_scatter(s->o, s->body, s->row->value, 11);
    return dense_of(s);
}

static outcome scattered(const extreme *row, int32_t precision) { return each(row, precision, row->choice, 0, scattered_probe); }

/* Points 0 and 1 meet, at the place of point 2, which all others leave by up to row->value. */
static double meeting_probe(scene *s) {
    const int dim = peri_dimension(s->body);
    double *x = extreme_read(s->o, s->body, PERI_POSITION), *u;
    int d, k;
    dense_scatter(s->o, s->body, s->row->value, 13);
    u = extreme_read(s->o, s->body, PERI_DISPLACEMENT);
    for (d = 0; x && u && d < dim; ++d)
        for (k = 0; k < 3; ++k) u[k * dim + d] = x[2 * dim + d] - x[k * dim + d];
    if (u) (void)extreme_fails(s->o, s->body, peri_write(s->body, PERI_DISPLACEMENT, u, peri_field_size(s->body, PERI_DISPLACEMENT)));
    free(x), free(u);
    return dense_of(s);
}

static outcome meeting(const extreme *row, int32_t precision) { return each(row, precision, PERI_NONLINEAR, 0, meeting_probe); }

static const extreme rows[] = {
    {"10 times as long", "closed forms of W under e = 9|xi|; the laws written out", uniform, 10, 0, PERI_NONLINEAR, PERI_OK, NULL,
     ROUNDINGS(100)},
    {"10 times as long, linear", "closed forms of W under e = 9|xi|; the laws written out", uniform, 10, 0, PERI_LINEAR, PERI_OK, NULL,
     ROUNDINGS(100)},
    {"a million times as long", "closed forms of W", uniform, 1e6, 0, PERI_NONLINEAR, PERI_OK, NULL, ROUNDINGS(100)},
    {"compressed by 99 %", "closed forms of W under e = -0.99|xi|; the laws written out", uniform, 0.01, 0, PERI_NONLINEAR, PERI_OK, NULL,
     ROUNDINGS(100)},
    {"collapsed into one point", "closed forms of W under e = -|xi|; no direction, no force", uniform, 0, 0, PERI_NONLINEAR, PERI_OK, NULL,
     ROUNDINGS(100)},
    {"stretched and sheared flat", "the laws written out", strained, 30, 0, PERI_NONLINEAR, PERI_OK, NULL, ROUNDINGS(100)},
    {"mirrored", "a mirror image has the lengths of its original: W = 0", mirrored, 0, 0, 0, PERI_OK, NULL, ROUNDINGS(100)},
    {"inside out and stretched", "the laws written out", strained, -3, 0.2, PERI_NONLINEAR, PERI_OK, NULL, ROUNDINGS(100)},
    {"inside out, linear", "the laws written out", strained, -3, 0.2, PERI_LINEAR, PERI_OK, NULL, ROUNDINGS(100)},
    {"points pass through each other", "the laws written out", scattered, 3, 0, PERI_NONLINEAR, PERI_OK, NULL, ROUNDINGS(100)},
    {"points pass, linear", "the laws written out", scattered, 3, 0, PERI_LINEAR, PERI_OK, NULL, ROUNDINGS(100)},
    {"thrown by 1e10 spacings", "the laws written out", scattered, 1e10, 0, PERI_NONLINEAR, PERI_OK, NULL, ROUNDINGS(100)},
    {"thrown by 1e10 spacings, linear", "the laws written out", scattered, 1e10, 0, PERI_LINEAR, PERI_OK, NULL, ROUNDINGS(100)},
    {"thrown by 9e14 spacings", "the laws written out", scattered, 9e14, 0, PERI_NONLINEAR, PERI_OK, NULL, ROUNDINGS(100)},
    {"three points meet", "no direction, no force; the laws written out", meeting, 0.1, 0, 0, PERI_OK, NULL, ROUNDINGS(100)},
    {"three points meet, others 1e9 away", "no direction, no force; the laws written out", meeting, 1e9, 0, 0, PERI_OK, NULL,
     ROUNDINGS(100)},
};
const extreme_table extreme_stretches = EXTREME_TABLE("stretches", rows);
