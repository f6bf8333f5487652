/* SPDX-License-Identifier: MIT */
/* tradeoff_statics.c - problems at rest: uniform strain, a cantilever, a plate with a hole, a crack. Young's modulus 1 throughout. */
#include "tradeoff.h"

enum { SOLVE = 150 }; /* evaluations of all bonds that build and solve take, about */

/* ---- uniform strain ----------------------------------------------------------------------------------------------- */

/* A square or cube of side 1 under four uniform strains of 1e-5: along an axis, equal in all directions, shear along the axes and along
   the diagonals. Error: of the elastic energy of the whole body, surfaces included, against 1/2 lambda (tr eps)^2 + mu eps:eps; the
   largest of the four. Seconds: build and one evaluation of the energy. */
outcome run_uniform(const knobs *k) {
    const double size = 1e-5, spacing = 1 / k->across, lo[3] = { 0, 0, 0 }, hi[3] = { 1, 1, 1 };
    const peri_material_desc material = trial_material(k);
    const int dim = dimension_of(k);
    double lambda, mu, worst = 0, *x;
    trial t;
    lame_of(k, &lambda, &mu);
    trial_create(&t, k, spacing, &material);
    trial_build(&t, lo, hi, spacing, NULL);
    trial_pause(&t);
    x = trial_read(&t, PERI_FIELD_POSITION);
    for (int kind = 0; kind < 4 && trial_fine(&t); ++kind) {
        const int64_t n = peri_point_count(t.body);
        double *u = (double *)calloc((size_t)(n * dim), sizeof *u), h[3][3] = { { 0 } }, trace = 0, square = 0;
        peri_energy energy;
        if (!u) exit(1);
        if (kind == 0) h[0][0] = size;
        for (int a = 0; kind == 1 && a < dim; ++a) h[a][a] = size;
        if (kind == 2) h[0][1] = h[1][0] = size;
        if (kind == 3) h[0][0] = size, h[1][1] = -size;
        for (int a = 0; a < dim; ++a) trace += h[a][a];
        for (int a = 0; a < dim; ++a)
            for (int c = 0; c < dim; ++c) square += h[a][c] * h[a][c];
        for (int64_t i = 0; i < n; ++i)
            for (int a = 0; a < dim; ++a)
                for (int c = 0; c < dim; ++c) u[i * dim + a] += h[a][c] * x[i * dim + c];
        trial_note(&t, peri_set_field(t.body, PERI_FIELD_DISPLACEMENT, u, n * dim));
        trial_resume(&t);
        trial_note(&t, peri_get_energy(t.body, &energy));
        if (kind == 0) trial_pause(&t);
        if (trial_fine(&t)) worst = fmax(worst, fabs(energy.elastic / (0.5 * lambda * trace * trace + mu * square) - 1));
        free(u);
    }
    free(x);
    return trial_end(&t, worst);
}

double work_uniform(const knobs *k) { return 20 * family_of(k) * pow(k->across, dimension_of(k)); }

/* ---- cantilever --------------------------------------------------------------------------------------------------- */

/* Depth (and width) 1. In 2D a force at the end of a beam of length 10, plane stress (Timoshenko, Goodier, sections 20, 21, no mean
   rotation of the root); in 3D moments at the end of a bar of length 6 (section 102, exact for any section). The root, two horizons of
   more beam, has the exact displacements, so that what is compared has no wall in it. The load is as peri_apply_traction spreads
   it. The tip goes down by a thousandth of the length: squares of rotations are 1e-6. Error: of the deflection of the axis at the tip. */
typedef struct beam {
    const double *x;
    double        nu, slope; /* slope: P/EI in 2D, the curvature in 3D                                                   */
    int           dim;
} beam;

static double beam_length(int dim) { return dim == 3 ? 6 : 10; }

static double deflection(const beam *b, double x) {
    const double l = beam_length(b->dim);
    return b->dim == 3 ? 0.5 * b->slope * x * x : b->slope * (l * x * x / 2 - x * x * x / 6 + (0.2 + 0.225 * b->nu) * x);
}

static int32_t root(void *user, double time, int64_t count, const int32_t *points, double *value) {
    const beam *b = (const beam *)user;
    const double l = beam_length(b->dim), s = b->slope, nu = b->nu;
    for (int64_t k = 0; k < count; ++k) {
        const double *at = &b->x[b->dim * points[k]], x = at[0], y = at[1];
        double *u = &value[b->dim * k];
        if (b->dim == 2) {
            u[0] = s * (-(l * x - x * x / 2) * y - (2 + nu) / 6 * y * y * y + (2 + nu) / 40 * y);
            u[1] = deflection(b, x) + s * nu * (l - x) * y * y / 2;
        } else {
            u[0] = -s * x * y;
            u[1] = deflection(b, x) + 0.5 * s * nu * (y * y - at[2] * at[2]);
            u[2] = s * nu * y * at[2];
        }
        for (int d = 0; d < b->dim; ++d) u[d] *= time;
    }
    return 0;
}

static int32_t couple(void *user, double time, int64_t count, const int32_t *points, double *value) {
    const beam *b = (const beam *)user;
    for (int64_t k = 0; k < count; ++k) {
        value[3 * k] = -time * b->slope * b->x[3 * points[k] + 1];
        value[3 * k + 1] = value[3 * k + 2] = 0;
    }
    return 0;
}

outcome run_cantilever(const knobs *k) {
    const int dim = dimension_of(k);
    const double l = beam_length(dim), h = 1 / k->across, deep = 2 * ceil(k->m) * h, out[3] = { 1, 0, 0 };
    const double lo[3] = { -deep, -0.5, -0.5 }, hi[3] = { l, 0.5, 0.5 };
    const peri_material_desc material = trial_material(k);
    beam b = { NULL, k->poisson, 0, dim };
    double force[3] = { 0, 0, 0 }, *x, *u, sum = 0, want = 0;
    int32_t held, end;
    trial t;
    b.slope = dim == 3 ? 2e-3 / l : 3e-3 / (l * l);
    if (dim == 2) force[1] = b.slope / 12;
    trial_create(&t, k, h, &material);
    trial_build(&t, lo, hi, h, NULL);
    trial_pause(&t);
    b.x = x = trial_read(&t, PERI_FIELD_POSITION);
    trial_resume(&t);
    held = trial_box(&t, -deep, -1, 0, 1);
    end = trial_box(&t, l - 2 * k->m * h, -1, l, 1);
    if (trial_fine(&t))
        trial_note(&t, peri_prescribe_displacement(t.body, held, PERI_AXIS_XY | (dim == 3 ? PERI_AXIS_Z : 0), NULL, root, &b));
    if (trial_fine(&t))
        trial_note(&t, peri_apply_traction(t.body, end, 1, out, force, dim == 3 ? couple : NULL, &b));
    trial_solve(&t, PERI_LOOSE_REFUSED, 0);
    u = trial_read(&t, PERI_FIELD_DISPLACEMENT);
    trial_pause(&t);
    for (int64_t i = 0; u && i < peri_point_count(t.body); ++i) {
        const double *at = &x[dim * i];
        if (at[0] < l - 0.6 * h || fabs(at[1]) > 0.6 * h || (dim == 3 && fabs(at[2]) > 0.6 * h)) continue;
        sum += u[dim * i + 1];
        want += deflection(&b, at[0]);
    }
    free(x);
    free(u);
    return trial_end(&t, sum / want - 1);
}

double work_cantilever(const knobs *k) {
    const int dim = dimension_of(k);
    return SOLVE * family_of(k) * (beam_length(dim) * k->across + 2 * k->m) * pow(k->across, dim - 1);
}

/* ---- a plate with a hole ------------------------------------------------------------------------------------------ */

/* A hole of radius 1 in an infinite plate under tension along y: Kirsch's displacements on a frame two horizons wide outside of a square
   of half side 3, plane stress. Families at the rim lie on one side and average over a horizon, and the rim is made of cells, so what is
   compared is the stress (PERI_FIELD_STRESS) of all points 1.3 to 2.5 radii from the middle. Error: the root of the mean square of what
   it is off, over that of Kirsch's. (What comes to the rim itself by extrapolation, the factor 3, has up to 1.2/across of the cells in it,
   of either sign, whatever the law: tests/test_hole.c.) */
static const double far_stress = 1e-4;
static const double band[2] = { 1.3, 2.5 };

/* Displacement and stress xx yy xy. */
static void kirsch(const double *x, double nu, double *u, double *sigma) {
    const double r = hypot(x[0], x[1]), cs = x[0] / r, sn = x[1] / r, c2 = cs * cs - sn * sn, s2 = 2 * cs * sn;
    const double p = 1 / r, q = p * p, kappa = (3 - nu) / (1 + nu), scale = far_stress * (1 + nu) / 4, half = 0.5 * far_stress;
    const double ur = scale * ((kappa - 1 - 2 * c2) / p + 2 * p * (1 - (kappa + 1) * c2) + 2 * p * q * c2);
    const double ut = scale * (2 / p + 2 * p * (kappa - 1) + 2 * p * q) * s2;
    const double rr = half * (1 - q - (1 - 4 * q + 3 * q * q) * c2), tt = half * (1 + q + (1 + 3 * q * q) * c2);
    const double rt = half * (1 + 2 * q - 3 * q * q) * s2;
    u[0] = ur * cs - ut * sn;
    u[1] = ur * sn + ut * cs;
    sigma[0] = rr * cs * cs + tt * sn * sn - 2 * rt * sn * cs;
    sigma[1] = rr * sn * sn + tt * cs * cs + 2 * rt * sn * cs;
    sigma[2] = (rr - tt) * sn * cs + rt * c2;
}

static int32_t outside_hole(void *user, int64_t index, const double *x) {
    (void)user;
    (void)index;
    return x[0] * x[0] + x[1] * x[1] > 1;
}

static int32_t in_frame(void *user, int64_t index, const double *x) {
    (void)user;
    (void)index;
    return fmax(fabs(x[0]), fabs(x[1])) > 3;
}

static int32_t kirsch_support(void *user, double time, int64_t count, const int32_t *points, double *value) {
    const beam *plate = (const beam *)user;
    double sigma[3];
    for (int64_t k = 0; k < count; ++k) {
        kirsch(&plate->x[2 * points[k]], plate->nu, &value[2 * k], sigma);
        value[2 * k] *= time;
        value[2 * k + 1] *= time;
    }
    return 0;
}

outcome run_hole(const knobs *k) {
    const double h = 1 / k->across, side = 3 + 2 * ceil(k->m) * h, lo[2] = { -side, -side }, hi[2] = { side, side };
    const peri_material_desc material = trial_material(k);
    beam plate = { NULL, k->poisson, 0, 2 };
    double *x, *sigma, off = 0, all = 0;
    int32_t frame = -1;
    trial t;
    trial_create(&t, k, h, &material);
    trial_build(&t, lo, hi, h, outside_hole);
    trial_pause(&t);
    plate.x = x = trial_read(&t, PERI_FIELD_POSITION);
    trial_resume(&t);
    if (trial_fine(&t)) trial_note(&t, frame = peri_select_if(t.body, NULL, in_frame, NULL));
    if (trial_fine(&t)) trial_note(&t, peri_prescribe_displacement(t.body, frame, PERI_AXIS_XY, NULL, kirsch_support, &plate));
    trial_solve(&t, PERI_LOOSE_REFUSED, 0);
    sigma = trial_read(&t, PERI_FIELD_STRESS);
    trial_pause(&t);
    for (int64_t i = 0; sigma && i < peri_point_count(t.body); ++i) {
        const double r = hypot(x[2 * i], x[2 * i + 1]);
        double u[2], want[3];
        if (r < band[0] || r > band[1]) continue;
        kirsch(&x[2 * i], k->poisson, u, want);
        for (int c = 0; c < 3; ++c) { /* xy stands for yx, too */
            off += (c == 2 ? 2 : 1) * pow(sigma[3 * i + c] - want[c], 2);
            all += (c == 2 ? 2 : 1) * want[c] * want[c];
        }
    }
    free(x);
    free(sigma);
    return trial_end(&t, sqrt(off / all));
}

double work_hole(const knobs *k) {
    return SOLVE * family_of(k) * pow(6 * k->across + 4 * k->m, 2);
}

/* ---- energy release rate ------------------------------------------------------------------------------------------ */

/* A crack of length 2 a = 1 in the middle of a plate of width 2 b = 2 a/0.3 (to a spacing) and twice that height, tension S on its ends,
   plane stress. Its elastic energy with the crack, and with the crack a spacing longer at each tip: under given loads, G = dU/(2 h).
   Truth: G = K^2/E, K = S sqrt(pi a) (1 - 0.025 r^2 + 0.06 r^4) sqrt(sec(pi r/2)), r = a/b (Tada, Paris, Irwin, The Stress Analysis of
   Cracks Handbook, 2.1: to 0.1 %; at r = 0.3 1.0576 against 1.0577 of Isida's series), its mean over the spacing. */
static const double SHORT_OF = 1e-3; /* [spacings] the tips end before the borders of cells, in single precision, too: bonds that would only
                                        touch them stay whole */

static double middle_rate(double half, double half_width) {
    const double r = half / half_width, f = 1 - 0.025 * r * r + 0.06 * pow(r, 4);
    return far_stress * far_stress * PI * half * f * f / cos(0.5 * PI * r);
}

/* Cracks of length 1 in both edges of a plate of width 2 b = 2/0.3 (to a spacing) and twice that height, both growing. Truth: K =
   S sqrt(pi a) (1 + 0.122 cos(pi r/2)^4) sqrt(tan(pi r/2)/(pi r/2)), r = a/b (the same book, section 2: to 0.5 %, so 1 % of G). */
static double edge_rate(double length, double half_width) {
    const double t = 0.5 * PI * length / half_width, f = 1 + 0.122 * pow(cos(t), 4);
    return far_stress * far_stress * PI * length * f * f * tan(t) / t;
}

static double crack_half_width(const knobs *k, int edges) { /* the tips lie between columns */
    const int n = (int)(k->across + 0.5), width = (int)(k->across / 0.3 + 0.5);
    return edges ? width / k->across : 0.5 * (width + (width - n) % 2) / k->across;
}

static outcome grow(const knobs *k, int edges) {
    const double h = 1 / k->across, b = crack_half_width(k, edges), deep = 2 * k->m * h, length = edges ? 1 : 0.5;
    const double lo[2] = { -b, -2 * b }, hi[2] = { b, 2 * b }, up[2] = { 0, 1 }, down[2] = { 0, -1 };
    const double pull[2] = { 0, far_stress }, push[2] = { 0, -far_stress };
    const peri_material_desc material = trial_material(k);
    double (*rate)(double, double) = edges ? edge_rate : middle_rate;
    double energy[2] = { 0, 0 }, want;
    trial t;
    trial_create(&t, k, h, &material);
    trial_build(&t, lo, hi, h, NULL);
    for (int longer = 0; longer < 2; ++longer) {
        const double end = length + longer * h - SHORT_OF * h;
        peri_energy ledger;
        for (int side = -1; side <= 1; side += 2) {
            const double from[2] = { edges ? side * 2 * b : 0, 0 }, to[2] = { edges ? side * (b - end) : side * end, 0 };
            if (trial_fine(&t)) trial_note(&t, peri_cut_segment(t.body, longer ? PERI_CUT_NOW : PERI_CUT_INITIAL, from, to));
        }
        if (longer == 0) {
            const int32_t top = trial_box(&t, -b, 2 * b - deep, b, 2 * b), bottom = trial_box(&t, -b, -2 * b, b, deep - 2 * b);
            if (trial_fine(&t)) trial_note(&t, peri_apply_traction(t.body, top, 2 * b, up, pull, NULL, NULL));
            if (trial_fine(&t)) trial_note(&t, peri_apply_traction(t.body, bottom, 2 * b, down, push, NULL, NULL));
        }
        trial_solve(&t, PERI_LOOSE_PINNED, longer);
        if (trial_fine(&t)) trial_note(&t, peri_get_energy(t.body, &ledger));
        if (trial_fine(&t)) energy[longer] = ledger.elastic;
    }
    trial_pause(&t);
    want = (rate(length, b) + 4 * rate(length + 0.5 * h, b) + rate(length + h, b)) / 6;
    return trial_end(&t, (energy[1] - energy[0]) / (2 * h * want) - 1);
}

outcome run_crack(const knobs *k) { return grow(k, 0); }
outcome run_edges(const knobs *k) { return grow(k, 1); }

double work_crack(const knobs *k) { return 1.5 * SOLVE * family_of(k) * 8 * pow(crack_half_width(k, 0) * k->across, 2); }
double work_edges(const knobs *k) { return 1.5 * SOLVE * family_of(k) * 8 * pow(crack_half_width(k, 1) * k->across, 2); }
