/* SPDX-License-Identifier: MIT */
/* oracle_scene.h - random scenes for the laws of physics: a scene is all choices that a seed makes, and its body, built from them.

   A scene is small, some 30 to 130 points, and of any size in the caller's units. Bounds of rounding follow from what stands here:
     stiffness  4/dt^2 of the stable step is the largest eigenvalue of K over rho, or a bound of it; row sums of |K|, which bound the sum
                of the sizes of all terms that make a force over |u|, are up to 4.4 times that (accuracy.md, Stable step): 5 are taken
     rounding   a force is two sums over a family (what it gathers, then the bonds), and the constants of a law are a third: 4 width + 64
                roundings of such terms; where K^-1 of a family enters (eigenvalues up to 50 apart), up to 50 times as many
     moving     a bond vector whose ends were rounded anew is off by the rounding of its ends over its length; weights follow by the
                slope of w */
#ifndef ORACLE_SCENE_H
#define ORACLE_SCENE_H

#include "criterion.h"
#include "scene.h"

#define MOST       160 /* points of a scene                                                                              */
#define MATERIALS  3
#define CRACKS     2

typedef enum origin { /* how the points came to be                                                                       */
    ORIGIN_BOX, ORIGIN_LONG_CELLS, ORIGIN_PERTURBED, ORIGIN_BALL, ORIGIN_SHAPE, ORIGIN_TWO_BOXES, ORIGIN_LATTICE_POINTS, ORIGIN_CLOUD,
    ORIGIN_OWN_FAMILIES, ORIGINS
} origin;

typedef enum act { /* what else acts in runs                                                                             */
    ACT_NOTHING, ACT_BODY_FORCE, ACT_LAYER, ACT_PRESSURE, ACT_BOND_PRESSURE, ACT_DISPLACEMENT, ACT_VELOCITY, ACTS
} act;

typedef struct crack { /* a segment, or a disc; in spacings                                                              */
    int32_t standing;
    double  at[3], to[3], normal[3], radius;
} crack;

typedef struct scene {
    uint64_t           seed, dice;
    peri_body_desc     desc;
    peri_material_desc material[MATERIALS], joint;
    int                materials, interfaced, mixed, breakable, gradient, dim, scattered;
    origin             origin;
    double             spacing, stress, density; /* the units of the scene                                               */
    double             lo[3], cells[3], cell[3];  /* of lattices: corner, cells and their edges, in spacings              */
    double             scatter;
    crack              crack[CRACKS];
    int                cracks;
    act                act;
    double             value[3], ball[3], ball_radius, plane[3], plane_normal[3];
    int                has_ball, has_plane, integrator;
    double             damping;
    /* of the built body */
    peri_body *body, *fresh; /* a clone from before anybody moved it: some criteria know the path                          */
    int64_t    count, dofs;
    int32_t    width;
    double     x[3 * MOST], volume[MOST], rho[MOST];
    int32_t    kind[MOST];              /* of the material of each point                                                  */
    double     u[3 * MOST], p[3 * MOST], q[3 * MOST], v[3 * MOST], load[3 * MOST];
    double     size;                    /* largest displacement in u, p and q                                             */
    double     stiff, rate;     /* see stiffness(), with the bonds that are live; 2 over the stable step [T^-1]            */
    double     reach;           /* largest distance of two coordinates                                                    */
    double     extent, shortest, slope, cancel; /* of the body about the origin; of a bond; see measure_bonds               */
} scene;

static double draw(scene *s) { return test_random(&s->dice); }
static double between(scene *s, double lo, double hi) { return lo + (hi - lo) * draw(s); }
static int below(scene *s, int n) { return (int)(draw(s) * n); }
static double power(scene *s, int lo, int hi) { return pow(10.0, between(s, lo, hi)); }

static int is_planar(int32_t quadrature) {
    return quadrature == PERI_QUADRATURE_PARTIAL_CENTROID || quadrature == PERI_QUADRATURE_PARTIAL_MOMENT;
}
static int is_exact(int32_t quadrature) { return quadrature == PERI_QUADRATURE_PARTIAL || is_planar(quadrature); }
static int has_moments(int32_t influence) {
    return influence != PERI_INFLUENCE_INVERSE_4 && influence != PERI_INFLUENCE_POLE_HALF && influence != PERI_INFLUENCE_POLE_QUARTER;
}

static int32_t falling(void *user, double q, double *w) {
    (void)user;
    *w = 1.0 / (1.0 + q * q);
    return 0;
}

/* Do cells differ, and lie off a lattice? */
static int is_scattered(const scene *s) {
    return s->origin == ORIGIN_PERTURBED || s->origin == ORIGIN_CLOUD || (s->origin == ORIGIN_OWN_FAMILIES && s->scattered);
}

/* ---- choices ------------------------------------------------------------------------------------------------------ */

static void choose_desc(scene *s) {
    peri_body_desc *d = &s->desc;
    peri_body_desc_init(d);
    d->space = peri__first_space + below(s, peri__count_space);
    s->dim = dim_of(d->space);
    d->precision = below(s, 2) ? PERI_PRECISION_DOUBLE : peri__first_precision + below(s, peri__count_precision);
    d->geometry = peri__first_geometry + below(s, peri__count_geometry);
    d->influence = below(s, 3) ? peri__first_influence + below(s, peri__count_influence) : PERI_INFLUENCE_CONSTANT;
    d->influence_fn = falling;
    d->quadrature = peri__first_quadrature + below(s, s->dim == 3 ? 3 : peri__count_quadrature);
    if (is_exact(d->quadrature) && below(s, s->dim == 3 ? 10 : 4)) d->quadrature = PERI_QUADRATURE_FULL; /* parts of cells take long */
    d->correction = is_planar(d->quadrature) ? PERI_CORRECTION_NONE : peri__first_correction + below(s, peri__count_correction);
    if (d->correction >= PERI_CORRECTION_MOMENT && below(s, s->dim == 3 ? 4 : 2)) d->correction = PERI_CORRECTION_NONE; /* so do fits */
    d->break_timing = peri__first_break_timing + below(s, peri__count_break_timing);
    d->kernel = peri__first_kernel + below(s, peri__count_kernel);
    d->instructions = peri__first_instructions + below(s, peri__count_instructions);
    d->threads = below(s, 64) ? 1 : 2;
    d->ledger = below(s, 8) > 0;
    d->number = 1 + below(s, 127);
    d->moments = peri__first_moments + d->number % peri__count_moments;
    d->thickness = between(s, 0.3, 3) * s->spacing;
}

static peri_material_desc choose_material(scene *s, int32_t law) {
    peri_material_desc m;
    const int bonds = law == PERI_LAW_BOND_BASED;
    const double s0 = between(s, 0.02, 0.08);
    peri_material_desc_init(&m, law);
    m.young = s->stress * between(s, 0.2, 1);
    m.density = s->density * between(s, 1, 4);
    if (!bonds) m.poisson = below(s, 5) ? between(s, -0.2, 0.42) : bond_nu(s->desc.space);
    if (law == PERI_LAW_CORRESPONDENCE) m.stabilization = below(s, 4) ? between(s, 0.05, 0.5) : 0;
    if (!s->breakable) return m;
    if (!bonds) m.criterion = peri__first_criterion + below(s, peri__count_criterion);
    if (m.criterion > PERI_CRITERION_NODE_ENERGY) {
        give_criterion(&m, m.criterion, s0, s->desc.horizon, s->desc.horizon * sqrt(m.density / m.young));
        return m;
    }
    if (m.criterion != PERI_CRITERION_STRETCH || (below(s, 2) && has_moments(s->desc.influence)))
        m.fracture_energy = m.young * s->desc.horizon * s0 * s0;
    else m.critical_stretch = s0;
    return m;
}

static void choose_materials(scene *s) {
    const int only_states = !has_moments(s->desc.influence), only_bonds = is_planar(s->desc.quadrature);
    int32_t law = only_bonds ? PERI_LAW_BOND_BASED : peri__first_law + only_states + below(s, peri__count_law - only_states);
    if (only_bonds && only_states) s->desc.influence = PERI_INFLUENCE_LINEAR;
    s->materials = below(s, 2) ? 1 : 1 + below(s, MATERIALS);
    s->mixed = below(s, 2);
    s->breakable = below(s, 2);
    for (int k = 0; k < s->materials; ++k) {
        s->material[k] = choose_material(s, law);
        s->gradient |= law == PERI_LAW_CORRESPONDENCE;
        if (s->mixed && !only_bonds) law = peri__first_law + only_states + below(s, peri__count_law - only_states);
    }
    s->interfaced = s->materials > 1 && below(s, 2);
    for (int k = 0; k < 2; ++k) s->interfaced = s->interfaced && s->material[k].law == PERI_LAW_BOND_BASED;
    if (s->interfaced) s->joint = choose_material(s, PERI_LAW_BOND_BASED);
}

/* Lattices, mostly of some 40 points, of up to 100 in the plane, 125 in space, whose horizon is now and then a whole number of spacings. */
static void choose_shape(scene *s) {
    const int whole = below(s, 3) == 0, exact = is_exact(s->desc.quadrature), small = exact || below(s, 3);
    const double reach = s->dim == 2 ? (whole ? 2 + below(s, 2) : between(s, 1.3, 3.1)) : (whole ? 1 + below(s, 2) : between(s, 1.2, 2.1));
    s->origin = (origin)below(s, ORIGINS);
    s->desc.horizon = (exact ? 1 + 0.5 * (reach - 1) : reach) * s->spacing;
    s->scatter = between(s, 0.2, 1);
    s->scattered = below(s, 2);
    for (int d = 0; d < s->dim; ++d) {
        s->lo[d] = below(s, 2) ? 0 : between(s, -30, 30);
        s->cells[d] = s->dim == 3 ? 3 + below(s, small ? 2 : 3) : small ? 5 + below(s, 4) : 6 + below(s, 5);
        s->cell[d] = s->origin == ORIGIN_LONG_CELLS ? between(s, 0.9, 1.04) : 1;
    }
    if (is_scattered(s) || s->origin == ORIGIN_LONG_CELLS) /* no point may be lonely */
        s->desc.horizon = fmax(s->desc.horizon, 2 * s->spacing);
    if (s->desc.influence == PERI_INFLUENCE_POLE_HALF) s->desc.horizon = between(s, 1.5, 1.8) * s->spacing; /* no lattice at the pole */
}

static void choose_acts(scene *s) {
    s->cracks = below(s, 2) ? below(s, CRACKS + 1) : 0;
    for (int k = 0; k < s->cracks; ++k)
        for (int d = 0; d < 3; ++d) {
            s->crack[k].standing = peri__first_standing + below(s, peri__count_standing);
            s->crack[k].at[d] = s->lo[d] + between(s, 0, s->cells[d]);
            s->crack[k].to[d] = s->lo[d] + between(s, 0, s->cells[d]);
            s->crack[k].normal[d] = between(s, -1, 1);
            s->crack[k].radius = between(s, 0.7, 2);
        }
    s->act = (act)below(s, ACTS);
    s->has_ball = below(s, 4) == 0;
    s->has_plane = below(s, 4) == 0;
    for (int d = 0; d < s->dim; ++d) {
        s->value[d] = between(s, -1, 1);
        s->ball[d] = s->lo[d] + (d ? between(s, 0, s->cells[d]) : -1);
        s->plane[d] = s->lo[d] + (d ? between(s, 0, s->cells[d]) : 0.8);
        s->plane_normal[d] = d ? between(s, -0.5, 0.5) : 1;
    }
    s->ball_radius = between(s, 1.6, 3);
    s->integrator = peri__first_integrator + below(s, peri__count_integrator);
    s->damping = below(s, 3) ? 0 : between(s, 0, 0.2); /* over the stable step                                           */
}

/* ---- points ------------------------------------------------------------------------------------------------------- */

/* Where a scene stands, other than where its seed puts it: x goes to length (turn x + shift), point i to order[i], and the units of stress,
   density and thickness by these factors. `plain`: neither turned nor in another order, so that the library lays the points again. */
typedef struct frame {
    double  turn[9], shift[3], length, stress, density, thickness;
    int     plain;
    int32_t order[MOST];
} frame;

static frame same_frame(void) {
    frame f;
    memset(&f, 0, sizeof f);
    f.turn[0] = f.turn[4] = f.turn[8] = f.length = f.stress = f.density = f.thickness = 1;
    f.plain = 1;
    for (int k = 0; k < MOST; ++k) f.order[k] = k;
    return f;
}

/* A vector by a frame: factor turn v; a place is shifted, too. */
static void turned(const frame *f, int dim, double factor, const double *v, double *out) {
    for (int a = 0; a < dim; ++a) {
        out[a] = 0;
        for (int c = 0; c < dim; ++c) out[a] += f->turn[3 * a + c] * v[c];
        out[a] *= factor;
    }
}

/* From spacings of the scene to the caller's place in the frame. */
static void placed(const scene *s, const frame *f, const double *v, double *out) {
    turned(f, s->dim, s->spacing, v, out);
    for (int d = 0; d < s->dim; ++d) out[d] = f->length * (out[d] + f->shift[d]);
}

static int32_t most_of_them(void *user, int64_t index, const double *x) {
    uint64_t state = *(const uint64_t *)user + (uint64_t)index;
    (void)x;
    return test_random(&state) < 0.9;
}

static void add_lattice(const scene *s, peri_body *b, const int32_t *ids, const frame *f) {
    double lo[3], hi[3], top[3], middle[3];
    const double spacing = s->spacing * f->length;
    for (int d = 0; d < s->dim; ++d) {
        top[d] = s->lo[d] + s->cells[d] * s->cell[d];
        middle[d] = s->lo[d] + 0.5 * s->cells[d];
    }
    placed(s, f, s->lo, lo);
    placed(s, f, top, hi);
    placed(s, f, middle, middle);
    switch (s->origin) {
    case ORIGIN_PERTURBED: MUST(b, peri_add_perturbed_box(b, ids[0], lo, hi, spacing, s->scatter, s->seed)); break;
    case ORIGIN_BALL: MUST(b, peri_add_ball(b, ids[0], middle, (s->dim == 2 ? 4.5 : 2.5) * spacing, spacing)); break;
    case ORIGIN_SHAPE: MUST(b, peri_add_shape(b, ids[0], lo, hi, spacing, most_of_them, (void *)(uintptr_t)&s->seed)); break;
    case ORIGIN_TWO_BOXES:
        middle[0] = lo[0] + floor(s->cells[0] / 2) * spacing;
        hi[0] = middle[0];
        MUST(b, peri_add_box(b, ids[0], lo, hi, spacing));
        placed(s, f, top, hi);
        lo[0] = middle[0];
        MUST(b, peri_add_box(b, ids[s->materials - 1], lo, hi, spacing));
        break;
    default: MUST(b, peri_add_box(b, ids[0], lo, hi, spacing));
    }
}

/* Points of the caller's: on the sites of a lattice, or off them by up to a fifth, volumes likewise. Materials in bands. */
static void lay_points(scene *s) {
    const int64_t nx = (int64_t)s->cells[0], ny = (int64_t)s->cells[1], nz = s->dim == 3 ? (int64_t)s->cells[2] : 1;
    const int cloud = is_scattered(s);
    const double cell = pow(s->spacing, s->dim);
    s->count = nx * ny * nz;
    for (int64_t i = 0; i < s->count; ++i) {
        const double site[3] = {(double)(i % nx), (double)(i / nx % ny), (double)(i / nx / ny)};
        for (int d = 0; d < s->dim; ++d)
            s->x[i * s->dim + d] = s->spacing * (s->lo[d] + site[d] + 0.5 + (cloud ? 0.2 * s->scatter * between(s, -1, 1) : 0));
        s->volume[i] = cell * (cloud ? between(s, 0.8, 1.2) : 1);
        s->kind[i] = (int32_t)(i * s->materials / s->count);
    }
}

static int is_laid(const scene *s) { return s->origin >= ORIGIN_LATTICE_POINTS; }

static void add_points(const scene *s, peri_body *b, const int32_t *ids, const frame *f) {
    double x[3 * MOST], volume[MOST];
    int32_t material[MOST];
    for (int64_t i = 0; i < s->count; ++i) {
        const int32_t to = f->order[i];
        turned(f, s->dim, 1, &s->x[i * s->dim], &x[to * s->dim]);
        for (int d = 0; d < s->dim; ++d) x[to * s->dim + d] = f->length * (x[to * s->dim + d] + f->shift[d]);
        volume[to] = s->volume[i] * pow(f->length, s->dim);
        material[to] = ids[s->kind[i]];
    }
    MUST(b, peri_add_points(b, s->count, x, volume, material));
}

/* Families of the caller's: all within the horizon, as [T] 3.11 has them. */
static void set_families(const scene *s, peri_body *b, const frame *f) {
    static int32_t rows[MOST * MOST];
    const double reach = s->desc.horizon * (1 + 1e-9);
    int32_t from[MOST];
    for (int64_t i = 0; i < s->count; ++i) from[f->order[i]] = (int32_t)i;
    for (int64_t i = 0; i < s->count; ++i) {
        int64_t width = 0;
        for (int64_t j = 0; j < s->count; ++j) {
            double square = 0;
            for (int d = 0; d < s->dim; ++d) square += pow(s->x[from[i] * s->dim + d] - s->x[from[j] * s->dim + d], 2);
            if (i != j && square <= reach * reach) rows[i * s->count + width++] = (int32_t)j;
        }
        while (width < s->count) rows[i * s->count + width++] = (int32_t)i;
    }
    MUST(b, peri_set_families(b, (int32_t)s->count, rows));
}

/* ---- bodies ------------------------------------------------------------------------------------------------------- */

static double time_factor(const frame *f) { return f->length * sqrt(f->density / f->stress); }

/* The scene in a frame, or NULL where it cannot be built; *status says why. */
static peri_body *body_in(const scene *s, const frame *f, int32_t *status) {
    peri_body_desc d = s->desc;
    peri_body *b = NULL;
    int32_t ids[MATERIALS];
    peri_material_desc m[MATERIALS + 1];
    d.horizon *= f->length;
    d.thickness *= f->thickness;
    *status = peri_body_create(&d, &b, NULL); /* builds may leave out spaces and precisions                              */
    if (*status != PERI_OK) return NULL;
    for (int k = 0; k <= MATERIALS; ++k) {
        m[k] = k < MATERIALS ? s->material[k] : s->joint;
        m[k].young *= f->stress;
        m[k].density *= f->density;
        m[k].fracture_energy *= f->stress * f->length;
        m[k].strength *= f->stress;
        m[k].cohesion *= f->stress;
        m[k].rate /= time_factor(f);
        m[k].delay *= time_factor(f);
    }
    for (int k = 0; k < s->materials; ++k) ids[k] = (int32_t)MUST(b, peri_add_material(b, &m[k]));
    if (s->interfaced) MUST(b, peri_set_interface(b, ids[0], ids[1], &m[MATERIALS]));
    if (f->plain && !is_laid(s)) add_lattice(s, b, ids, f);
    else add_points(s, b, ids, f);
    if (s->origin == ORIGIN_OWN_FAMILIES) set_families(s, b, f);
    *status = peri_build(b);
    if (*status == PERI_OK) return b;
    peri_body_destroy(b);
    return NULL;
}

/* Cuts the cracks of one standing, or (0) of all but those in place. */
static void cut_cracks(const scene *s, peri_body *b, const frame *f, int in_place) {
    for (int k = 0; k < s->cracks; ++k) {
        const crack *c = &s->crack[k];
        double at[3], to[3], normal[3];
        if ((c->standing == PERI_CUT_IN_PLACE) != in_place) continue;
        placed(s, f, c->at, at);
        placed(s, f, c->to, to);
        turned(f, s->dim, 1, c->normal, normal);
        if (s->dim == 2) MUST(b, peri_cut_segment(b, c->standing, at, to));
        else MUST(b, peri_cut_disc(b, c->standing, at, normal, c->radius * s->spacing * f->length));
    }
}

/* ---- what bounds follow from -------------------------------------------------------------------------------------- */

/* w(q) of docs/theory.md, to know its slope. */
static double weight_of(int32_t influence, double q, double edge) {
    const double r = q < 1 ? 1 - q : 0;
    switch (influence) {
    case PERI_INFLUENCE_LINEAR: return r;
    case PERI_INFLUENCE_CUBIC: return 1 - 3 * q * q + 2 * q * q * q;
    case PERI_INFLUENCE_QUINTIC: return r * r * r * (1 + 3 * q + 6 * q * q);
    case PERI_INFLUENCE_SEPTIC: return r * r * r * r * (1 + 4 * q + 10 * q * q + 20 * q * q * q);
    case PERI_INFLUENCE_POWER_2: return r * r;
    case PERI_INFLUENCE_POWER_3: return r * r * r;
    case PERI_INFLUENCE_GAUSSIAN: return exp(-q * q);
    case PERI_INFLUENCE_PROPORTIONAL: return q;
    case PERI_INFLUENCE_INVERSE: return 1 / q;
    case PERI_INFLUENCE_INVERSE_4: return 1 / (q * q * q * q);
    case PERI_INFLUENCE_POLE_EDGE: return 1 / (1 + edge - q);
    case PERI_INFLUENCE_POLE_HALF: return 1 / fabs(2 * q - 1);
    case PERI_INFLUENCE_POLE_QUARTER: return exp(1 / (q - 0.25));
    case PERI_INFLUENCE_USER: return 1 / (1 + q * q);
    default: return 1;
    }
}

/* Lengths of bonds; the largest sum of |q dw/dq| |xi|^2 of a family's live bonds over that of w |xi|^2, and of |w| |xi|^2. */
static void measure_bonds(scene *s) {
    static int32_t rows[MOST * MOST];
    double total = 0;
    MUST(s->body, peri_get_families(s->body, 0, s->count, rows, s->count * s->width));
    for (int64_t i = 0; i < s->count; ++i) total += s->volume[i];
    const double edge = 0.5 * pow(total / (double)s->count, 1.0 / s->dim) / s->desc.horizon;
    s->shortest = HUGE_VAL;
    s->slope = s->cancel = 0;
    for (int64_t i = 0; i < s->count; ++i) {
        double change = 0, sum = 1e-300, size = 0;
        for (int32_t k = 0; k < s->width && rows[i * s->width + k] != i; ++k) {
            const int32_t j = rows[i * s->width + k];
            double square = 0;
            if (s->cracks && peri_bond_is_intact(s->body, (int32_t)i, j) != 1) continue;
            for (int d = 0; d < s->dim; ++d) square += pow(s->x[i * s->dim + d] - s->x[j * s->dim + d], 2);
            const double q = sqrt(square) / s->desc.horizon, w = weight_of(s->desc.influence, q, edge);
            s->shortest = fmin(s->shortest, sqrt(square));
            change += fabs(weight_of(s->desc.influence, q * (1 + 1e-6), edge) - w) * 1e6 * square;
            size += fabs(w) * square;
            sum += w * square;
        }
        s->slope = fmax(s->slope, change / fabs(sum));
        s->cancel = fmax(s->cancel, size / fabs(sum));
    }
}

static double state_unit(const scene *s) { return s->desc.precision == PERI_PRECISION_SINGLE ? ULP32 : ULP64; }
static double bond_unit(const scene *s) { return s->desc.precision == PERI_PRECISION_DOUBLE ? ULP64 : ULP32; }
static double roundings(const scene *s) { return (4.0 * s->width + 64) * (s->gradient ? 50 : 1); }

/* Of a force over its scale. */
static double rounding(const scene *s) { return roundings(s) * bond_unit(s); }

/* Of a bond vector over its length, where its ends are `shift` farther from the origin. */
static double ends_of(const scene *s, double shift) {
    return 8 * ((s->extent + shift) * ULP64 + s->reach * state_unit(s)) / s->shortest;
}

/* The same where the points were placed anew. Of partial cells whose faces are cut anew the parts are off, too: what is less than 1e-12 is
   no part, and in space they are integrals to 1e-10 of a cell; the correction by volumes knows parts as float (theory.md). */
static double moving(const scene *s, double shift) {
    const double parts = (!is_exact(s->desc.quadrature) ? 0 : s->dim == 3 ? 4e-10 : 4e-12)
                       + (s->desc.correction == PERI_CORRECTION_VOLUME && s->desc.quadrature != PERI_QUADRATURE_FULL ? ULP32 : 0);
    return (rounding(s) + (8 + 2 * s->slope) * ends_of(s, shift) + parts) * s->cancel * (s->gradient ? 50 : 1);
}

/* Bound of the row sums of the stiffness over rho [T^-2], obstacles included. */
static double stiffness(const peri_body *b) { return 5 * 4 / pow(peri_stable_step(b), 2); }

/* ---- the scene of a seed ------------------------------------------------------------------------------------------ */

/* A smooth field and noise, up to some hundredths of a spacing. */
static void choose_motion(scene *s, double *u) {
    double gradient[9], wave[3], noise = 0.03 * draw(s), smooth = 0.02 * draw(s);
    for (int k = 0; k < 9; ++k) gradient[k] = between(s, -0.01, 0.01);
    for (int k = 0; k < 3; ++k) wave[k] = between(s, -1, 1) / s->spacing;
    for (int64_t i = 0; i < s->count; ++i)
        for (int a = 0; a < s->dim; ++a) {
            double sum = 0, phase = 0;
            for (int c = 0; c < s->dim; ++c) {
                sum += gradient[3 * a + c] * (s->x[i * s->dim + c] - s->spacing * s->lo[c]);
                phase += wave[c] * s->x[i * s->dim + c];
            }
            u[i * s->dim + a] = sum + s->spacing * (smooth * sin(phase + a) + noise * between(s, -1, 1));
        }
}

static void know_body(scene *s) {
    const int64_t n = s->count = peri_point_count(s->body);
    double material[MOST];
    CHECK(n <= MOST);
    s->dofs = n * s->dim;
    s->width = peri_family_width(s->body);
    MUST(s->body, peri_get_field(s->body, PERI_FIELD_POSITION, s->x, s->dofs));
    MUST(s->body, peri_get_field(s->body, PERI_FIELD_VOLUME, s->volume, n));
    MUST(s->body, peri_get_field(s->body, PERI_FIELD_MATERIAL, material, n));
    for (int64_t i = 0; i < n; ++i) {
        s->kind[i] = (int32_t)material[i] - 1;
        s->rho[i] = s->material[s->kind[i]].density;
    }
    s->extent = largest(s->x, s->dofs) + s->spacing;
    for (int64_t k = s->dim; k < s->dofs; ++k) s->reach = fmax(s->reach, fabs(s->x[k] - s->x[k % s->dim]));
}

/* Makes the scene of a seed. PERI_OK, or why it has no body: a family without weight, or an influence function that is not finite there. */
static int32_t scene_make(scene *s, uint64_t seed) {
    const frame f = same_frame();
    int32_t status = PERI_OK;
    memset(s, 0, sizeof *s);
    s->seed = seed;
    s->dice = seed * UINT64_C(7919) + 1;
    s->spacing = power(s, -8, 3);
    s->stress = power(s, -3, 11);
    s->density = power(s, -3, 4);
    choose_desc(s);
    choose_shape(s);
    choose_materials(s);
    choose_acts(s);
    if (is_laid(s)) lay_points(s);
    s->body = body_in(s, &f, &status);
    if (!s->body) return status;
    know_body(s);
    cut_cracks(s, s->body, &f, 0);
    choose_motion(s, s->u);
    choose_motion(s, s->p);
    choose_motion(s, s->q);
    choose_motion(s, s->v);
    s->size = fmax(largest(s->u, s->dofs), fmax(largest(s->p, s->dofs), largest(s->q, s->dofs)));
    put(s->body, PERI_FIELD_DISPLACEMENT, s->u);
    cut_cracks(s, s->body, &f, 1);
    measure_bonds(s);
    s->stiff = stiffness(s->body);
    s->rate = 2 / peri_stable_step(s->body);
    MUST(s->body, peri_body_clone(s->body, &s->fresh, NULL));
    return PERI_OK;
}

static void scene_free(scene *s) {
    peri_body_destroy(s->body);
    peri_body_destroy(s->fresh);
}

/* In a line, by the numbers of the enums less their hundreds. */
static void describe(const scene *s) {
    static const char *const origins[ORIGINS] = {"box", "box of long cells", "perturbed box", "ball", "shape", "two boxes",
                                                 "lattice of points", "cloud", "given families"};
    const peri_body_desc *d = &s->desc;
    printf("    scene %d: %s, precision %d, geometry %d, influence %d, quadrature %d, correction %d, kernel %d; %s, %d points, %s\n",
           (int)s->seed, space_name[d->space % 100], (int)d->precision % 100, (int)d->geometry % 100, (int)d->influence % 100,
           (int)d->quadrature % 100, (int)d->correction % 100, (int)d->kernel % 100, origins[s->origin], (int)s->count,
           peri_kernel_text(s->body));
    for (int k = 0; k < s->materials; ++k)
        printf("      %s, Poisson's ratio %.3g, criterion %d, E %.3g, density %.3g\n", law_name[s->material[k].law % 100],
               s->material[k].poisson, (int)s->material[k].criterion % 100, s->material[k].young, s->material[k].density);
    printf("      horizon %.3g, %d cracks, act %d%s%s%s, integrator %d, damping %.2g; roundings %.3g, slope %.3g, cancellation %.3g\n",
           d->horizon / s->spacing, s->cracks, (int)s->act, s->has_ball ? ", ball" : "", s->has_plane ? ", plane" : "",
           s->interfaced ? ", interface" : "", s->integrator % 100, s->damping, roundings(s), s->slope, s->cancel);
}

#endif
