/* SPDX-License-Identifier: MIT */
/* dense.c - see dense.h. Formulas are those at peri_law in peri.h; e = (2 xi + eta).eta/(|xi+eta| + |xi|), without cancellation.

   Rounding. The sum (2 xi + eta).eta is uncertain by roundings of its terms, so e by roundings of reach = (2 |xi| + |eta|) |eta|/(|xi+eta|
   + |xi|); the direction of a force by roundings of (|xi| + |eta|)/|xi+eta|. Sizes are carried along each formula with these in place of e,
   sums in place of differences, and the condition of K. */
#include "dense.h"

#define PI 3.14159265358979323846

typedef struct node { /* what a point makes of its family; big_: the sizes of the terms                                   */
    int32_t      law;
    dense_moduli moduli;
    double       press, big_press, spring; /* w (press g + spring e) along the bond, g = |xi|, Oterkus 1                  */
    double       q[3][3], big_q, k;        /* w (q xi + k eta) more                                                       */
    double       energy, big_energy;
} node;

typedef struct dense {
    outcome             *o;
    peri_body           *body;
    const peri_body_desc *desc;
    int      dim, linear, whole;
    int64_t  points, width;
    double  *x, *u, *volume, *material, *force, *energy;
    int32_t *rows;
    node    *node;
    double   micromodulus;
} dense;

typedef struct bond {
    double xi[3], eta[3], y[3], length, now, e, reach, twist;
} bond;

dense_moduli dense_moduli_of(const peri_material_desc *m, int32_t space) {
    dense_moduli moduli;
    const double nu = m->law == PERI_LAW_BOND_BASED ? (space == PERI_SPACE_PLANE_STRESS ? 1.0 / 3 : 0.25) : m->poisson, young = m->young;
    moduli.mu = young / (2 * (1 + nu));
    moduli.lambda = space == PERI_SPACE_PLANE_STRESS ? young * nu / (1 - nu * nu) : young * nu / ((1 + nu) * (1 - 2 * nu));
    moduli.bulk = moduli.lambda + 2 * moduli.mu / (space == PERI_SPACE_SOLID ? 3 : 2);
    return moduli;
}

double dense_micromodulus(int32_t space, double h) {
    if (space == PERI_SPACE_SOLID) return 18 * (1 / 1.5) / (PI * h * h * h * h); /* K = E/(3 (1 - 2 nu)), nu = 1/4 */
    return (space == PERI_SPACE_PLANE_STRAIN ? 48.0 / 5 : 9.0) / (PI * h * h * h);
}

static double size_of(const double *a, int dim) {
    double sum = 0;
    int k;
    for (k = 0; k < dim; ++k) sum += a[k] * a[k];
    return sqrt(sum);
}

/* Bond k of row i; its other end, or -1 where it is padding or broken. */
static int64_t read_bond(const dense *s, int64_t i, int64_t k, bond *g) {
    const int64_t j = s->rows[i * s->width + k];
    double along = 0, moved;
    int d;
    if (j == i || (!s->whole && peri_bond_is_intact(s->body, (int32_t)i, (int32_t)j) != 1)) return -1;
    for (d = 0; d < s->dim; ++d) {
        g->xi[d] = s->x[j * s->dim + d] - s->x[i * s->dim + d];
        g->eta[d] = s->u[j * s->dim + d] - s->u[i * s->dim + d];
        g->y[d] = g->xi[d] + (s->linear ? 0 : g->eta[d]);
        along += (s->linear ? g->xi[d] : 2 * g->xi[d] + g->eta[d]) * g->eta[d];
    }
    g->length = size_of(g->xi, s->dim);
    g->now = size_of(g->y, s->dim);
    moved = size_of(g->eta, s->dim);
    g->e = along / (s->linear ? g->length : g->now + g->length);
    g->reach = s->linear ? moved : (2 * g->length + moved) * moved / (g->now + g->length);
    g->twist = s->linear || !(g->now > 0) ? 1 : (g->length + moved) / g->now;
    return j;
}

static double determinant(int dim, double a[3][3]) {
    if (dim == 2) return a[0][0] * a[1][1] - a[0][1] * a[1][0];
    return a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) - a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0])
         + a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
}

static void invert(int dim, double a[3][3], double out[3][3]) {
    const double det = determinant(dim, a);
    int p, q;
    if (dim == 2) {
        out[0][0] = a[1][1] / det, out[1][1] = a[0][0] / det;
        out[0][1] = -a[0][1] / det, out[1][0] = -a[1][0] / det;
        return;
    }
    for (p = 0; p < 3; ++p)
        for (q = 0; q < 3; ++q)
            out[q][p] = (a[(p + 1) % 3][(q + 1) % 3] * a[(p + 2) % 3][(q + 2) % 3]
                         - a[(p + 1) % 3][(q + 2) % 3] * a[(p + 2) % 3][(q + 1) % 3]) / det;
}

static double norm(int dim, double a[3][3]) {
    double sum = 0;
    int p, q;
    for (p = 0; p < dim; ++p)
        for (q = 0; q < dim; ++q) sum += a[p][q] * a[p][q];
    return sqrt(sum);
}

/* Smallest over largest eigenvalue of a symmetric matrix, by the roots of its characteristic polynomial. */
static double roundness(int dim, double a[3][3]) {
    double mean = 0, shear = 0, square = 0, turned, phi, b[3][3];
    int p, q;
    for (p = 0; p < dim; ++p) mean += a[p][p] / dim;
    for (p = 0; p < dim; ++p)
        for (q = 0; q < dim; ++q) {
            b[p][q] = a[p][q] - (p == q ? mean : 0);
            square += b[p][q] * b[p][q];
        }
    if (dim == 2) {
        shear = sqrt(square / 2);
        return (mean - shear) / (mean + shear);
    }
    shear = sqrt(square / 6);
    if (!(shear > 0)) return 1;
    turned = determinant(3, b) / (2 * shear * shear * shear);
    phi = acos(turned > 1 ? 1 : turned < -1 ? -1 : turned) / 3;
    return (mean + 2 * shear * cos(phi + 2 * PI / 3)) / (mean + 2 * shear * cos(phi));
}

/* T = w P K^-1 xi + k w (Y - F xi), W = SVK or Hooke + 1/2 k sum w |Y - F xi|^2 V. */
static void deform(const dense *s, int64_t i, double stiff, double shape[3][3], double stabilization) {
    node *n = &s->node[i];
    const int dim = s->dim;
    double inverse[3][3], h[3][3] = {{0}}, e[3][3], p[3][3], pulled = 0, condition, big_h, big_e, big_s, big_p;
    double trace = 0, square = 0, apart = 0, big_apart = 0;
    bond g;
    int64_t k, j;
    int a, c, d;
    invert(dim, shape, inverse);
    condition = norm(dim, shape) * norm(dim, inverse);
    n->k = stabilization * dim * (dim + 2) * n->moduli.mu / stiff;
    for (k = 0; k < s->width; ++k) {
        if ((j = read_bond(s, i, k, &g)) < 0) continue;
        pulled += size_of(g.eta, dim) * g.length * s->volume[j];
        for (a = 0; a < dim; ++a)
            for (c = 0; c < dim; ++c)
                for (d = 0; d < dim; ++d) h[a][d] += g.eta[a] * g.xi[c] * s->volume[j] * inverse[c][d];
    }
    big_h = pulled * norm(dim, inverse) * condition;
    big_e = big_h * (1 + (s->linear ? 0 : 0.5 * big_h));
    for (a = 0; a < dim; ++a)
        for (d = 0; d < dim; ++d) {
            e[a][d] = 0.5 * (h[a][d] + h[d][a]);
            for (c = 0; !s->linear && c < dim; ++c) e[a][d] += 0.5 * h[c][a] * h[c][d];
            square += e[a][d] * e[a][d];
        }
    for (a = 0; a < dim; ++a) trace += e[a][a];
    for (a = 0; a < dim; ++a)
        for (d = 0; d < dim; ++d) { /* P = F S; F = 1 in linear geometry */
            p[a][d] = 2 * n->moduli.mu * e[a][d] + (a == d ? n->moduli.lambda * trace : 0);
            for (c = 0; !s->linear && c < dim; ++c) p[a][d] += h[a][c] * (2 * n->moduli.mu * e[c][d]
                                                                          + (c == d ? n->moduli.lambda * trace : 0));
        }
    big_s = (2 * n->moduli.mu + dim * fabs(n->moduli.lambda)) * big_e;
    big_p = big_s * (1 + (s->linear ? 0 : big_h));
    for (a = 0; a < dim; ++a)
        for (d = 0; d < dim; ++d) {
            n->q[a][d] = -n->k * h[a][d];
            for (c = 0; c < dim; ++c) n->q[a][d] += p[a][c] * inverse[c][d];
        }
    n->big_q = big_p * norm(dim, inverse) * condition + n->k * big_h;
    for (k = 0; k < s->width; ++k) {
        double far_, big = 0, z[3];
        if ((j = read_bond(s, i, k, &g)) < 0) continue;
        for (a = 0; a < dim; ++a)
            for (z[a] = g.eta[a], d = 0; d < dim; ++d) z[a] -= h[a][d] * g.xi[d];
        far_ = size_of(z, dim);
        big = size_of(g.eta, dim) + big_h * g.length;
        apart += far_ * far_ * s->volume[j];
        big_apart += big * big * s->volume[j];
    }
    n->energy = 0.5 * n->moduli.lambda * trace * trace + n->moduli.mu * square + 0.5 * n->k * apart;
    n->big_energy = 0.5 * fabs(n->moduli.lambda) * dim * big_e * big_e + n->moduli.mu * big_e * big_e + 0.5 * n->k * big_apart;
}

/* Moments of the family of i, and what its moduli makes of them. */
static void respond(const dense *s, int64_t i, const peri_material_desc *m) {
    node *n = &s->node[i];
    const int dim = s->dim;
    double stiff = 0, length = 0, plain = 0, shape[3][3] = {{0}}, theta = 0, big_theta = 0, square = 0, big_square = 0;
    double whole = 0, bonds = 0, big_bonds = 0, d_, room;
    bond g;
    int64_t k, j;
    int a, c, bonded = 0;
    memset(n, 0, sizeof *n);
    n->law = m->law;
    n->moduli = dense_moduli_of(m, s->desc->space);
    for (k = 0; k < s->width; ++k) {
        const double gauge_lps = m->law == PERI_LAW_OTERKUS ? 0 : 1;
        j = s->rows[i * s->width + k];
        if (j != i) {
            double square_ = 0;
            for (a = 0; a < dim; ++a) square_ += pow(s->x[j * dim + a] - s->x[i * dim + a], 2);
            whole += square_ * s->volume[j];
        }
        if ((j = read_bond(s, i, k, &g)) < 0) continue;
        bonded = 1;
        stiff += g.length * g.length * s->volume[j];
        length += g.length * s->volume[j];
        plain += s->volume[j];
        for (a = 0; a < dim; ++a)
            for (c = 0; c < dim; ++c) shape[a][c] += g.xi[a] * g.xi[c] * s->volume[j];
        theta += (gauge_lps > 0 ? g.length : 1) * g.e * s->volume[j];
        big_theta += (gauge_lps > 0 ? g.length : 1) * g.reach * s->volume[j];
        square += g.e * g.e * s->volume[j];
        big_square += g.reach * g.reach * s->volume[j];
        bonds += 0.25 * s->micromodulus * g.e * g.e / g.length * s->volume[j];
        big_bonds += 0.25 * s->micromodulus * g.reach * g.reach / g.length * s->volume[j];
    }
    if (!bonded) return;
    switch (m->law) {
    case PERI_LAW_BOND_BASED:
        n->energy = bonds;
        n->big_energy = big_bonds;
        return;
    case PERI_LAW_LPS: { /* W = A/(2 D) theta^2 + B/(2 m) sum w e^2 V */
        const double big_a = dim * (n->moduli.lambda - n->moduli.mu), big_b = dim * (dim + 2) * n->moduli.mu;
        n->spring = big_b / stiff;
        n->press = big_a / stiff * (dim / stiff) * theta;
        n->big_press = fabs(big_a) / stiff * (dim / stiff) * big_theta;
        n->energy = big_a / (2 * dim) * pow(dim / stiff * theta, 2) + 0.5 * n->spring * square;
        n->big_energy = fabs(big_a) / (2 * dim) * pow(dim / stiff * big_theta, 2) + 0.5 * n->spring * big_square;
        return;
    }
    case PERI_LAW_OTERKUS: /* W = a theta^2 + b sum w e^2 V; spring = 2 b, from simple shear on the mean over its directions, a from
                               isotropic strain */
        d_ = dim / length;
        n->spring = n->moduli.mu / (stiff / (dim == 3 ? 15 : 8));
        room = stiff * plain / (length * length) - 1; /* q (1 - m sum(w V)/(sum w |xi| V)^2) + D^2 bulk sum(w V)/(...)^2 >= 0 */
        if (n->spring * room > n->moduli.bulk * dim * dim * plain / (length * length))
            n->spring = n->moduli.bulk * dim * dim * plain / (length * length) / room;
        n->press = (n->moduli.bulk - n->spring * stiff / (dim * dim)) * d_ * d_ * theta;
        n->big_press = (n->moduli.bulk + n->spring * stiff / (dim * dim)) * d_ * d_ * big_theta;
        n->energy = 0.5 * (n->moduli.bulk - n->spring * stiff / (dim * dim)) * pow(d_ * theta, 2) + 0.5 * n->spring * square;
        n->big_energy = 0.5 * (n->moduli.bulk + n->spring * stiff / (dim * dim)) * pow(d_ * big_theta, 2) + 0.5 * n->spring * big_square;
        return;
    default:
        if (roundness(dim, shape) > 0.02) { /* what the library takes for spanning the space */
            deform(s, i, stiff, shape, m->stabilization);
            return;
        }
        n->spring = dim * (dim + 2) * n->moduli.mu / whole;
        n->energy = 0.5 * n->spring * square;
        n->big_energy = 0.5 * n->spring * big_square;
    }
}

/* Adds to f what the end i gives to a bond, and its size to *big. sign: -1 where the bond is seen from the other end. */
static void half(const dense *s, int64_t i, const bond *g, double volume, double *f, double *big) {
    const node *n = &s->node[i];
    double central, size;
    int a, d;
    if (n->law == PERI_LAW_BOND_BASED) {
        central = 0.5 * s->micromodulus * g->e / g->length;
        size = 0.5 * s->micromodulus * g->reach / g->length;
    } else {
        const double gauge = n->law == PERI_LAW_OTERKUS ? 1 : g->length;
        central = n->press * gauge + n->spring * g->e;
        size = n->big_press * gauge + n->spring * g->reach;
    }
    *big += size * g->twist * volume + (n->big_q * g->length + n->k * size_of(g->eta, s->dim)) * volume;
    for (a = 0; a < s->dim; ++a) {
        if (g->now > 0) f[a] += central * g->y[a] / g->now * volume;
        f[a] += n->k * g->eta[a] * volume;
        for (d = 0; d < s->dim; ++d) f[a] += n->q[a][d] * g->xi[d] * volume;
    }
}

static double ratio(double error, double big) { return error <= 0 ? 0 : error / big; }

static double compare(const dense *s) {
    double worst = 0, net[3] = {0}, turn[3] = {0}, size = 0, sum = 0, arm = 0, stored = 0, big_stored = 0;
    peri_energy e;
    int64_t i, k, j;
    int a;
    for (i = 0; i < s->points; ++i) {
        const double *got = &s->force[i * s->dim];
        double f[3] = {0}, big = 0, apart = 0, place[3] = {0}, pull[3] = {0}, *v = s->volume;
        bond g;
        for (k = 0; k < s->width; ++k) {
            if ((j = read_bond(s, i, k, &g)) < 0) continue;
            half(s, i, &g, v[j], f, &big);
            half(s, j, &g, v[j], f, &big);
        }
        for (a = 0; a < s->dim; ++a) {
            apart += pow(got[a] - f[a], 2);
            net[a] += got[a] * v[i];
            pull[a] = got[a] * v[i];
            place[a] = s->x[i * s->dim + a] + (s->linear ? 0 : s->u[i * s->dim + a]);
        }
        sum += big * v[i];
        arm += big * v[i] * (size_of(&s->x[i * s->dim], s->dim) + size_of(&s->u[i * s->dim], s->dim));
        for (a = 0; a < 3; ++a) turn[a] += place[(a + 1) % 3] * pull[(a + 2) % 3] - place[(a + 2) % 3] * pull[(a + 1) % 3];
        worst = extreme_worst(worst, ratio(sqrt(apart), big));
        worst = extreme_worst(worst, ratio(fabs(s->energy[i] - s->node[i].energy), s->node[i].big_energy));
        stored += s->node[i].energy * v[i];
        big_stored += s->node[i].big_energy * v[i];
    }
    for (a = 0; a < 3; ++a) size += turn[a] * turn[a];
    worst = extreme_worst(worst, ratio(size_of(net, s->dim), sum));
    worst = extreme_worst(worst, ratio(sqrt(size), arm));
    if (extreme_fails(s->o, s->body, peri_get_energy(s->body, &e))) return NAN;
    return extreme_worst(worst, ratio(fabs(e.elastic - stored), big_stored));
}

double dense_error(outcome *o, peri_body *b, const peri_body_desc *d, const peri_material_desc *m) {
    dense s;
    double worst = NAN;
    int64_t i;
    if (!b || o->status < 0) return NAN;
    memset(&s, 0, sizeof s);
    s.o = o;
    s.body = b;
    s.desc = d;
    s.dim = peri_dimension(b);
    s.linear = d->geometry == PERI_GEOMETRY_LINEAR;
    s.whole = peri_cut_count(b) + peri_broken_count(b) == 0;
    s.points = peri_point_count(b);
    s.width = peri_family_width(b);
    s.micromodulus = dense_micromodulus(d->space, d->horizon);
    s.x = extreme_read(o, b, PERI_FIELD_POSITION);
    s.u = extreme_read(o, b, PERI_FIELD_DISPLACEMENT);
    s.volume = extreme_read(o, b, PERI_FIELD_VOLUME);
    s.material = extreme_read(o, b, PERI_FIELD_MATERIAL);
    s.force = extreme_read(o, b, PERI_FIELD_FORCE_DENSITY);
    s.energy = extreme_read(o, b, PERI_FIELD_ENERGY_DENSITY);
    s.rows = (int32_t *)malloc((size_t)(s.points * s.width) * sizeof *s.rows);
    s.node = (node *)malloc((size_t)s.points * sizeof *s.node);
    if (s.rows) (void)extreme_fails(o, b, peri_get_families(b, 0, s.points, s.rows, s.points * s.width));
    if (s.rows && s.node && o->status >= 0) {
        for (i = 0; i < s.points; ++i) respond(&s, i, &m[(int)s.material[i] - 1]);
        worst = compare(&s);
    }
    free(s.x), free(s.u), free(s.volume), free(s.material), free(s.force), free(s.energy), free(s.rows), free(s.node);
    return worst;
}

/* ---- bodies ------------------------------------------------------------------------------------------------------- */

static peri_body *built(outcome *o, peri_body *b) {
    if (o->status >= 0) (void)extreme_fails(o, b, peri_build(b));
    if (o->status >= 0) return b;
    peri_body_destroy(b);
    return NULL;
}

peri_body *dense_box(outcome *o, const peri_body_desc *d, const peri_material_desc *m, int n) {
    const double lo[3] = {0, 0, 0}, hi[3] = {n, n, n};
    peri_body *b = NULL;
    (void)(extreme_fails(o, NULL, peri_body_create(d, &b, NULL)) || extreme_fails(o, b, peri_add_material(b, m))
           || extreme_fails(o, b, peri_add_box(b, material_id(b, 1), lo, hi, 1)));
    return built(o, b);
}

peri_body *dense_cloud(outcome *o, const peri_body_desc *d, const peri_material_desc *m, int64_t count, const double *x,
                       const double *volume) {
    peri_body *b = NULL;
    (void)(extreme_fails(o, NULL, peri_body_create(d, &b, NULL)) || extreme_fails(o, b, peri_add_material(b, m))
           || extreme_fails(o, b, peri_add_points(b, count, x, volume, NULL)));
    return built(o, b);
}

void dense_scatter(outcome *o, peri_body *b, double size, uint64_t seed) {
    const int64_t n = b ? peri_size_of_field(b, PERI_FIELD_DISPLACEMENT) : 0;
    double *u = b ? extreme_read(o, b, PERI_FIELD_DISPLACEMENT) : NULL;
    int64_t i;
    for (i = 0; u && i < n; ++i) u[i] += size * (2 * test_random(&seed) - 1);
    if (u) (void)extreme_fails(o, b, peri_set_field(b, PERI_FIELD_DISPLACEMENT, u, n));
    free(u);
}

void dense_note(outcome *o, double error, int32_t space, int32_t law) {
    static const char *const names[4][5] = {
        {"", "", "", "", ""},
        {"", "bond-based in plane stress", "LPS in plane stress", "Oterkus in plane stress", "correspondence in plane stress"},
        {"", "bond-based in plane strain", "LPS in plane strain", "Oterkus in plane strain", "correspondence in plane strain"},
        {"", "bond-based in 3D", "LPS in 3D", "Oterkus in 3D", "correspondence in 3D"}};
    if (o->status < 0 || error <= o->error || o->error != o->error) return;
    o->error = error;
    o->field = names[space % 100][law % 100];
}
