/* SPDX-License-Identifier: MIT */
/* damage.c - nothing left, hardly anything left, limits at both ends of the numbers, and what a reset leaves. */
#include "dense.h"

typedef struct scene {
    const extreme *row;
    outcome       *o;
    peri_body     *body;
    peri_body_desc desc;
    peri_material_desc  material;
    int            cloud;
} scene;

typedef double (*probe_fn)(scene *s);

/* A unit lattice, or points moved off one. */
static peri_body *make(scene *s) {
    const int n = s->desc.space == PERI_SPACE_SOLID ? 4 : 8, dim = s->desc.space == PERI_SPACE_SOLID ? 3 : 2;
    double x[3 * 64], volume[64];
    uint64_t seed = 47;
    int i, d, at;
    if (!s->cloud) return dense_box(s->o, &s->desc, &s->material, n);
    for (i = 0; i < 64; ++i) {
        for (d = 0, at = i; d < dim; ++d, at /= n) x[i * dim + d] = at % n + 0.5 * test_random(&seed);
        volume[i] = 0.5 + test_random(&seed);
    }
    return dense_cloud(s->o, &s->desc, &s->material, 64, x, volume);
}

typedef struct setting {
    int32_t geometry, criterion, timing, except; /* except: a law left out                                                 */
    double  limit; /* critical stretch, or fracture energy where it is negative: -G0                                        */
} setting;

static setting plain(double limit) {
    setting c = {PERI_GEOMETRY_NONLINEAR, PERI_CRITERION_STRETCH, PERI_BREAK_WITHIN_STEP, 0, 0};
    c.limit = limit;
    return c;
}

static void start(scene *s, const extreme *row, outcome *o, int32_t precision, const setting *c, int32_t space, int32_t law, int cloud) {
    s->row = row;
    s->o = o;
    s->cloud = cloud;
    extreme_desc(&s->desc, space, precision, space == PERI_SPACE_SOLID ? 2 : 3);
    s->desc.geometry = c->geometry;
    s->desc.break_timing = c->timing;
    extreme_material(&s->material, law, 0.3, c->limit > 0 ? c->limit : 0);
    s->material.criterion = c->criterion;
    if (c->limit < 0) s->material.fracture_energy = -c->limit;
    s->body = make(s);
}

/* The worst error of a probe over spaces, laws that can have the criterion, lattices and clouds. */
static void each(outcome *o, const extreme *row, int32_t precision, const setting *c, probe_fn probe) {
    int32_t space, law;
    int cloud;
    for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
        for (law = c->criterion == PERI_CRITERION_STRETCH ? PERI_LAW_BOND_BASED : PERI_LAW_LPS; law < peri__end_law; ++law)
            for (cloud = 0; cloud < 2 && o->status >= 0; ++cloud) {
                scene s;
                if (law == c->except) continue;
                start(&s, row, o, precision, c, space, law, cloud);
                if (s.body) dense_note(o, probe(&s), space, law);
                *o = extreme_end(*o, s.body);
            }
}

static outcome all(const extreme *row, int32_t precision, setting c, probe_fn probe) {
    outcome o = {PERI_OK, "", 0};
    each(&o, row, precision, &c, probe);
    return o;
}

static double advance(scene *s, int64_t steps, double safety, double time_step) {
    peri_advance_desc run;
    peri_advance_desc_init(&run);
    run.steps = steps;
    run.safety = safety;
    run.time_step = time_step;
    return s->o->status < 0 || extreme_fails(s->o, s->body, peri_advance(s->body, &run)) ? NAN : 0;
}

static void expand(scene *s, double strain) {
    const double two[4] = {strain, 0, 0, strain}, three[9] = {strain, 0, 0, 0, strain, 0, 0, 0, strain};
    extreme_affine(s->o, s->body, s->desc.space == PERI_SPACE_SOLID ? three : two, NULL);
}

/* Largest size of a number of a field. */
static double largest(scene *s, int32_t field) {
    const int64_t n = peri_size_of_field(s->body, field);
    double *x = extreme_read(s->o, s->body, field), most = 0;
    int64_t i;
    for (i = 0; x && i < n; ++i) most = extreme_worst(most, fabs(x[i]));
    free(x);
    return x ? most : NAN;
}

static double dense_of(scene *s) { return dense_error(s->o, s->body, &s->desc, &s->material); }

static double bonds_of(const scene *s) { return 0.5 * (double)peri_entry_count(s->body); }

/* ---- nothing left ------------------------------------------------------------------------------------------------- */

static int32_t any(void *user, int32_t i, int32_t j, const double *xi, const double *xj) {
    (void)user, (void)i, (void)j, (void)xi, (void)xj;
    return 1;
}

/* Every bond cut, at rest or (choice) after a step under strain: damage is 1, all that bonds carry is 0, points fly straight, and no part
   is held. */
static double cut_all_probe(scene *s) {
    static const int32_t nothing[4] = {PERI_FIELD_ENERGY_DENSITY, PERI_FIELD_FORCE_DENSITY, PERI_FIELD_STRESS, PERI_FIELD_FORCE_STRESS};
    const int64_t n = peri_size_of_field(s->body, PERI_FIELD_VELOCITY);
    const int late = s->row->choice;
    double worst, before[3 * 64], after[3 * 64], *v, time;
    peri_solve_desc p;
    int64_t i;
    int k;
    dense_scatter(s->o, s->body, 0.1, 53);
    if (late) (void)advance(s, 3, 0.9, 0);
    worst = fabs((double)peri_cut_if(s->body, late ? PERI_CUT_NOW : PERI_CUT_INITIAL, any, NULL) - bonds_of(s));
    worst += fabs((double)(late ? peri_broken_count(s->body) : peri_cut_count(s->body)) - bonds_of(s));
    for (k = 0; k < 4; ++k) worst = extreme_worst(worst, largest(s, nothing[k]));
    worst = extreme_worst(worst, fabs(largest(s, PERI_FIELD_DAMAGE) - 1));
    worst = extreme_worst(worst, fabs(largest(s, PERI_FIELD_DAMAGE_GROWN) - late));
    worst = extreme_worst(worst, dense_of(s));
    if (!late) dense_scatter(s->o, s->body, 0.1, 59);
    if (extreme_fails(s->o, s->body, peri_get_field(s->body, PERI_FIELD_DISPLACEMENT, before, n))) return NAN;
    for (i = 0; i < n; ++i) after[i] = 0.5 - (double)(i % 5);
    if (extreme_fails(s->o, s->body, peri_set_field(s->body, PERI_FIELD_VELOCITY, after, n))) return NAN;
    time = peri_time(s->body);
    (void)advance(s, 20, 0.9, 0);
    time = peri_time(s->body) - time;
    if (!(time > 0) || s->o->status < 0 || extreme_fails(s->o, s->body, peri_get_field(s->body, PERI_FIELD_DISPLACEMENT, after, n)))
        return NAN;
    for (i = 0; i < n; ++i) worst = extreme_worst(worst, fabs((after[i] - before[i]) / ((0.5 - (double)(i % 5)) * time) - 1));
    v = extreme_read(s->o, s->body, PERI_FIELD_VELOCITY);
    for (i = 0; v && i < n; ++i) worst = extreme_worst(worst, fabs(v[i] / (0.5 - (double)(i % 5)) - 1));
    free(v);
    peri_solve_desc_init(&p);
    if (peri_solve(s->body, &p, NULL) != PERI_ERROR_LOOSE) return 1;
    return worst;
}

static outcome cut_all(const extreme *row, int32_t precision) { return all(row, precision, plain(0), cut_all_probe); }

/* ---- hardly anything left ----------------------------------------------------------------------------------------- */

/* Point 0 keeps its bonds with 1 and (row->value 2) with 2, or (3) with 1 and the one above it; the rest is whole. */
static int32_t loosen(void *user, int32_t i, int32_t j, const double *xi, const double *xj) {
    const scene *s = (const scene *)user;
    const int32_t kept = (int32_t)s->row->value, above = s->desc.space == PERI_SPACE_SOLID ? 4 : 8;
    (void)xi, (void)xj;
    return i == 0 && !(j == 1 || (kept == 2 && j == 2) || (kept == 3 && j == above));
}

/* The laws written out on what is left; and after that the energy of small swings, 100 steps. */
static double hanging_probe(scene *s) {
    double worst, stored;
    peri_energy e;
    if (extreme_fails(s->o, s->body, peri_cut_if(s->body, PERI_CUT_INITIAL, loosen, s))) return NAN;
    dense_scatter(s->o, s->body, 0.3, 61);
    worst = dense_of(s);
    if (extreme_fails(s->o, s->body, peri_reset(s->body))) return NAN;
    dense_scatter(s->o, s->body, 0.001, 67);
    if (extreme_fails(s->o, s->body, peri_get_energy(s->body, &e))) return NAN;
    stored = e.initial;
    (void)advance(s, 100, 0.2, 0);
    if (s->o->status < 0 || extreme_fails(s->o, s->body, peri_get_energy(s->body, &e))) return NAN;
    return fabs(e.error) <= s->row->other * stored ? worst : 1;
}

static outcome hanging(const extreme *row, int32_t precision) { return all(row, precision, plain(0), hanging_probe); }

static int32_t apart(void *user, int32_t i, int32_t j, const double *xi, const double *xj) {
    const double middle = *(const double *)user;
    (void)i, (void)j;
    return (xi[0] < middle) != (xj[0] < middle);
}

static int32_t is_left(void *user, int64_t index, const double *x) {
    (void)index;
    return x[0] < *(const double *)user;
}

/* Halves that fly apart with +-value: their centres go straight. Elastic energy: rounding of displacements u makes extensions of up to
   4 roundings of u, and W is at most D (D+2)/2 times their square. */
static double flying_probe(scene *s) {
    double middle = s->desc.space == PERI_SPACE_SOLID ? 2 : 4, speed[3] = {0, 0, 0}, way[2] = {0, 0}, mass[2] = {0, 0};
    double worst = 0, rounding, stray;
    double *x, *u, *volume;
    const int dim = peri_dimension(s->body);
    peri_energy start_, e;
    int64_t i;
    int k;
    int32_t left;
    if (extreme_fails(s->o, s->body, peri_cut_if(s->body, PERI_CUT_INITIAL, apart, &middle))) return NAN;
    left = peri_select_if(s->body, NULL, is_left, &middle);
    speed[0] = s->row->value;
    (void)extreme_fails(s->o, s->body, peri_add_velocity(s->body, PERI_ALL, speed));
    speed[0] *= -2;
    (void)extreme_fails(s->o, s->body, peri_add_velocity(s->body, left, speed));
    if (s->o->status < 0 || extreme_fails(s->o, s->body, peri_get_energy(s->body, &start_))) return NAN;
    (void)advance(s, 100, 0.9, 0);
    if (s->o->status < 0 || extreme_fails(s->o, s->body, peri_get_energy(s->body, &e))) return NAN;
    x = extreme_read(s->o, s->body, PERI_FIELD_POSITION);
    u = extreme_read(s->o, s->body, PERI_FIELD_DISPLACEMENT);
    volume = extreme_read(s->o, s->body, PERI_FIELD_VOLUME);
    for (i = 0; x && u && volume && i < peri_point_count(s->body); ++i) {
        k = x[i * dim] < middle;
        way[k] += u[i * dim] * volume[i];
        mass[k] += volume[i];
    }
    for (k = 0; k < 2; ++k) worst = extreme_worst(worst, fabs(way[k] / mass[k] / (s->row->value * peri_time(s->body)) * (k ? -1 : 1) - 1));
    free(x), free(u), free(volume);
    rounding = s->desc.precision == PERI_PRECISION_SINGLE ? 5.96e-8 : 1.11e-16;
    stray = 4 * rounding * s->row->value * peri_time(s->body);
    if (!(e.elastic <= 0.5 * dim * (dim + 2) * stray * stray * (mass[0] + mass[1]))) return 1;
    return extreme_worst(worst, fabs(e.kinetic / start_.kinetic - 1));
}

static outcome flying(const extreme *row, int32_t precision) { return all(row, precision, plain(0), flying_probe); }

/* ---- limits ------------------------------------------------------------------------------------------------------- */

/* Uniform strain row->other with the limit row->value (-G0, or s0) and a tiny step: choice 1: all bonds break, 0: none does. Broken bonds
   take the elastic energy with them. */
static double limit_probe(scene *s) {
    double broken, stored;
    peri_energy e;
    expand(s, s->row->other);
    if (extreme_fails(s->o, s->body, peri_get_energy(s->body, &e))) return NAN;
    stored = e.elastic;
    (void)advance(s, 1, 0.9, 1e-10 * peri_stable_step(s->body)); /* no energy moves */
    if (s->o->status < 0 || extreme_fails(s->o, s->body, peri_get_energy(s->body, &e))) return NAN;
    broken = (double)peri_broken_count(s->body);
    if (broken != (s->row->choice ? bonds_of(s) : 0)) return 1;
    if (!(stored > 0)) return broken + e.fracture;
    return s->row->choice ? extreme_worst(fabs(e.fracture / stored - 1), e.elastic / stored) : fabs(e.elastic / stored - 1) + e.fracture;
}

/* In both geometries, at both timings. Where a < 0 short bonds of Oterkus's law push under uniform strain: no work is done on them. */
static outcome limits_of(const extreme *row, int32_t precision, int32_t criterion) {
    outcome o = {PERI_OK, "", 0};
    setting c = plain(row->value);
    c.criterion = criterion;
    if (criterion == PERI_CRITERION_BOND_ENERGY) c.except = PERI_LAW_OTERKUS;
    for (c.geometry = PERI_GEOMETRY_NONLINEAR; c.geometry < peri__end_geometry; ++c.geometry)
        for (c.timing = PERI_BREAK_WITHIN_STEP; c.timing < peri__end_break_timing; ++c.timing) each(&o, row, precision, &c, limit_probe);
    return o;
}

static outcome limit(const extreme *row, int32_t precision) { return limits_of(row, precision, PERI_CRITERION_STRETCH); }
static outcome work_limit(const extreme *row, int32_t precision) { return limits_of(row, precision, PERI_CRITERION_BOND_ENERGY); }
static outcome node_limit(const extreme *row, int32_t precision) { return limits_of(row, precision, PERI_CRITERION_NODE_ENERGY); }

static int32_t is_right(void *user, int64_t index, const double *x) {
    (void)index;
    return x[0] > *(const double *)user;
}

/* Ends held and drawn apart by 1 %, with a critical stretch of 1e-12: what is between comes off and bears nothing. Not of clouds: there a
   crack may run along one grip, and the rest stay whole on the other. */
static double torn_probe(scene *s) {
    double left = 1, right = s->desc.space == PERI_SPACE_SOLID ? 3 : 7;
    const double away[3] = {0.01 * (right + 1), 0, 0};
    const int32_t axes = s->desc.space == PERI_SPACE_SOLID ? PERI_AXIS_XYZ : PERI_AXIS_XY;
    peri_solve_desc p;
    peri_solve_report r;
    int32_t load[2];
    if (s->cloud) return 0;
    load[0] = peri_prescribe_displacement(s->body, peri_select_if(s->body, NULL, is_left, &left), axes, NULL, NULL, NULL);
    load[1] = peri_prescribe_displacement(s->body, peri_select_if(s->body, NULL, is_right, &right), axes, away, NULL, NULL);
    if (extreme_fails(s->o, s->body, load[0]) || extreme_fails(s->o, s->body, load[1])) return NAN;
    peri_solve_desc_init(&p);
    p.criticality = 0;
    return peri_solve(s->body, &p, &r) == PERI_OK && r.ended != 0 && r.broken > 0 && r.lost_parts > 0 ? 0 : 1;
}

static outcome torn(const extreme *row, int32_t precision) { return all(row, precision, plain(row->value), torn_probe); }

/* A material of which one number, by choice, is row->value. */
static outcome refused(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    peri_body_desc d;
    peri_material_desc m;
    peri_body *b = NULL;
    extreme_desc(&d, PERI_SPACE_SOLID, precision, 3);
    extreme_material(&m, PERI_LAW_LPS, 0.3, row->choice == 0 ? row->value : 0);
    if (row->choice == 1) m.fracture_energy = row->value;
    if (row->choice == 2) m.fracture_energy = m.critical_stretch = row->value;
    if (row->choice > 2) m.criterion = row->choice;
    if (!extreme_fails(&o, NULL, peri_body_create(&d, &b, NULL))) (void)extreme_fails(&o, b, peri_add_material(b, &m));
    return extreme_end(o, b);
}

/* Two points 0.9 apart break where X s^2 (1/V + 1/W)/2 passes w0 (work on the bond, and mean energy of its ends, alike), or s passes s0;
   X = D^2 bulk, of correspondence D (D+2) mu. A part in 10^4 below it they do not. */
static outcome threshold(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    const double v[2] = {0.5, 1.5}, pi = 3.14159265358979323846, h = 2;
    int32_t space, law, side;
    for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
        for (law = row->choice == PERI_CRITERION_STRETCH ? PERI_LAW_BOND_BASED : PERI_LAW_LPS; law < peri__end_law; ++law)
            for (side = 0; side < 2 && o.status >= 0; ++side) {
                const int dim = space == PERI_SPACE_SOLID ? 3 : 2;
                double x[6] = {0, 0, 0, 0, 0, 0}, u[6] = {0, 0, 0, 0, 0, 0}, stiff = 0, w0 = 0, s = 0.01;
                dense_moduli moduli;
                peri_body_desc d;
                peri_material_desc m;
                peri_body *b;
                scene t;
                extreme_desc(&d, space, precision, h);
                extreme_material(&m, law, 0.3, 0);
                moduli = dense_moduli_of(&m, space);
                m.criterion = row->choice;
                if (row->choice == PERI_CRITERION_STRETCH) m.critical_stretch = s;
                else {
                    m.fracture_energy = row->value;
                    stiff = law == PERI_LAW_CORRESPONDENCE ? dim * (dim + 2) * moduli.mu : dim * dim * moduli.bulk;
                    w0 = (dim == 3 ? 4 / (pi * h) : 1.5) * row->value / (h * h * h);
                }
                x[dim] = 0.9;
                t.o = &o;
                t.body = b = dense_cloud(&o, &d, &m, 2, x, v);
                if (b && row->choice == PERI_CRITERION_NODE_ENERGY) /* of the spacing, too */
                    (void)extreme_fails(&o, b, peri_get_critical_energy(b, material_id(b, 1), &w0));
                if (row->choice != PERI_CRITERION_STRETCH) s = sqrt(2 * w0 / (stiff * (1 / v[0] + 1 / v[1])));
                u[dim] = 0.9 * s * (side ? 1 + 1e-4 : 1 - 1e-4);
                if (b && !extreme_fails(&o, b, peri_set_field(b, PERI_FIELD_DISPLACEMENT, u, 2 * dim))) {
                    (void)advance(&t, 1, 0.9, 1e-9 * peri_stable_step(b));
                    dense_note(&o, peri_broken_count(b) == side ? 0 : 1, space, law);
                }
                o = extreme_end(o, b);
            }
    return o;
}

/* Bonds with an end in the zone do not break, the others do; row->value: how many points the zone keeps of 64. */
static double no_fail_probe(scene *s) {
    const int64_t n = peri_point_count(s->body), width = peri_family_width(s->body);
    int32_t points[64], row[64], i;
    double want = 0;
    int64_t k;
    for (i = 0; i < 64; ++i) points[i] = i;
    if (extreme_fails(s->o, s->body, peri_set_no_fail(s->body, PERI_ALL, 1))) return NAN;
    if (s->row->value < 64) {
        const int32_t rest = peri_select_points(s->body, NULL, 64 - (int64_t)s->row->value, points + (int)s->row->value);
        if (extreme_fails(s->o, s->body, peri_set_no_fail(s->body, rest, 0))) return NAN;
    }
    for (i = 0; i < n; ++i) {
        if (extreme_fails(s->o, s->body, peri_get_families(s->body, i, 1, row, width))) return NAN;
        for (k = 0; k < width; ++k) want += row[k] > i && i >= (int32_t)s->row->value;
    }
    expand(s, 0.5);
    (void)advance(s, 1, 0.9, 1e-9 * peri_stable_step(s->body));
    return fabs((double)peri_broken_count(s->body) - want);
}

static outcome no_fail(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    setting c = plain(0.1);
    for (c.criterion = PERI_CRITERION_STRETCH; c.criterion <= PERI_CRITERION_NODE_ENERGY; ++c.criterion) {
        c.except = c.criterion == PERI_CRITERION_BOND_ENERGY ? PERI_LAW_OTERKUS : 0; /* see limits_of */
        each(&o, row, precision, &c, no_fail_probe);
        c.limit = -1e-12;
    }
    return o;
}

/* ---- reset -------------------------------------------------------------------------------------------------------- */

static double set_going(scene *s) {
    dense_scatter(s->o, s->body, 0.06, 73);
    return advance(s, 30, 0.3, 0);
}

/* What a body shows after a run through fracture, the same to the last bit after a reset as of a fresh body. */
static double reset_probe(scene *s) {
    scene fresh = *s;
    double worst = 0;
    peri_energy a, b;
    int32_t field;
    (void)set_going(s);
    if (peri_broken_count(s->body) < 1) worst = 1;
    if (extreme_fails(s->o, s->body, peri_cut_if(s->body, PERI_CUT_NOW, any, NULL)) || extreme_fails(s->o, s->body, peri_reset(s->body)))
        return NAN;
    if (peri_broken_count(s->body) + peri_step_count(s->body) != 0 || peri_time(s->body) != 0) worst = 1;
    (void)set_going(s);
    fresh.body = make(&fresh);
    if (!fresh.body) return NAN;
    (void)set_going(&fresh);
    for (field = PERI_FIELD_POSITION; field < peri__end_field && s->o->status >= 0; ++field) {
        const int64_t n = peri_size_of_field(s->body, field);
        double *x = extreme_read(s->o, s->body, field), *y = extreme_read(s->o, fresh.body, field);
        if (!x || !y || memcmp(x, y, (size_t)n * sizeof *x) != 0) worst = extreme_worst(worst, field);
        free(x), free(y);
    }
    if (!extreme_fails(s->o, s->body, peri_get_energy(s->body, &a)) && !extreme_fails(s->o, fresh.body, peri_get_energy(fresh.body, &b))
        && memcmp(&a, &b, sizeof a) != 0) worst = extreme_worst(worst, 100);
    if (peri_broken_count(s->body) != peri_broken_count(fresh.body)) worst = extreme_worst(worst, 101);
    *s->o = extreme_end(*s->o, fresh.body);
    return worst;
}

static outcome reset(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    setting c = plain(0.03);
    for (c.criterion = PERI_CRITERION_STRETCH; c.criterion <= PERI_CRITERION_NODE_ENERGY; ++c.criterion) {
        each(&o, row, precision, &c, reset_probe);
        c.limit = -2e-3;
    }
    return o;
}

#define REFUSED {0, 0, 0}
#define EXACT {0, 0, 0}
static const extreme rows[] = {
    {"every bond cut at rest", "damage 1, nothing carried, Newton's first law, loose", cut_all, 0, 0, 0, PERI_OK, NULL, ROUNDINGS(1000)},
    {"every bond cut in motion", "damage 1, nothing carried, Newton's first law, loose", cut_all, 0, 0, 1, PERI_OK, NULL, ROUNDINGS(1000)},
    {"a point on one bond", "the laws written out; Verlet within (omega dt)^2/4, omega dt <= 0.4", hanging, 1, 0.04, 0, PERI_OK, NULL,
     ROUNDINGS(100)},
    {"a point on two collinear bonds", "the laws written out; Verlet within (omega dt)^2/4, omega dt <= 0.4", hanging, 2, 0.04, 0, PERI_OK,
     NULL, ROUNDINGS(100)},
    {"a point on two bonds", "the laws written out; Verlet within (omega dt)^2/4, omega dt <= 0.4", hanging, 3, 0.04, 0, PERI_OK, NULL,
     ROUNDINGS(100)},
    {"a point on none", "the laws written out; Verlet within (omega dt)^2/4, omega dt <= 0.4", hanging, 0, 0.04, 0, PERI_OK, NULL,
     ROUNDINGS(100)},
    {"halves flying at 1000 c", "Newton's first law; elastic energy of 4 roundings of u", flying, 1000, 0, 0, PERI_OK, NULL,
     ROUNDINGS(1000)},
    {"halves flying at 1e8 c", "Newton's first law; elastic energy of 4 roundings of u", flying, 1e8, 0, 0, PERI_OK, NULL, ROUNDINGS(1000)},
    {"no critical stretch, ten times as long", "peri.h: with neither, bonds do not break", limit, 0, 9, 0, PERI_OK, NULL, EXACT},
    {"critical stretch of 1e-12, at rest", "only bonds longer than at rest break", limit, 1e-12, 0, 0, PERI_OK, NULL, EXACT},
    {"critical stretch of 1e-12, just beyond", "all break, and W with them: sums of 1400 bonds", limit, 1e-12, 1.001e-12, 1, PERI_OK,
     NULL, ROUNDINGS(1400)},
    {"critical stretch of 1e-12, just below", "none breaks", limit, 1e-12, 0.999e-12, 0, PERI_OK, NULL, ROUNDINGS(100)},
    {"critical stretch of 1e-300, compressed", "only bonds longer than at rest break", limit, 1e-300, -0.5, 0, PERI_OK, NULL,
     ROUNDINGS(100)},
    {"critical stretch of 1e300, ten times as long", "none breaks", limit, 1e300, 9, 0, PERI_OK, NULL, ROUNDINGS(100)},
    {"fracture energy of 1e-300", "all break, and W with them: sums of 1400 bonds", limit, -1e-300, 0.01, 1, PERI_OK, NULL,
     ROUNDINGS(1400)},
    {"fracture energy of 1e300", "none breaks", limit, -1e300, 9, 0, PERI_OK, NULL, ROUNDINGS(100)},
    {"work on bonds, 1e-30", "all break, and W with them: sums of 1400 bonds", work_limit, -1e-30, 0.01, 1, PERI_OK, NULL, ROUNDINGS(1400)},
    {"work on bonds, 1e-300", "all break, and W with them: sums of 1400 bonds", work_limit, -1e-300, 0.01, 1, PERI_OK, NULL,
     ROUNDINGS(1400)},
    {"work on bonds, 1e300", "none breaks", work_limit, -1e300, 9, 0, PERI_OK, NULL, ROUNDINGS(100)},
    {"work on bonds, 1e-300, compressed", "only bonds longer than at rest break", work_limit, -1e-300, -0.1, 0, PERI_OK, NULL,
     ROUNDINGS(100)},
    {"energy of ends, 1e-30", "all break, and W with them: sums of 1400 bonds", node_limit, -1e-30, 0.01, 1, PERI_OK, NULL,
     ROUNDINGS(1400)},
    {"energy of ends, 1e-300", "all break, and W with them: sums of 1400 bonds", node_limit, -1e-300, 0.01, 1, PERI_OK, NULL,
     ROUNDINGS(1400)},
    {"energy of ends, 1e300", "none breaks", node_limit, -1e300, 9, 0, PERI_OK, NULL, ROUNDINGS(100)},
    {"energy of ends, 1e-300, compressed", "only bonds longer than at rest break", node_limit, -1e-300, -0.1, 0, PERI_OK, NULL,
     ROUNDINGS(100)},
    {"critical stretch not a number", "peri.h: a number is not finite", refused, NAN, 0, 0, PERI_ERROR_RANGE, "critical_stretch", REFUSED},
    {"critical stretch infinite", "peri.h: a number is not finite", refused, HUGE_VAL, 0, 0, PERI_ERROR_RANGE, "critical_stretch", REFUSED},
    {"critical stretch negative", "peri.h: > 0", refused, -1, 0, 0, PERI_ERROR_RANGE, "critical_stretch", REFUSED},
    {"fracture energy not a number", "peri.h: a number is not finite", refused, NAN, 0, 1, PERI_ERROR_RANGE, "fracture_energy", REFUSED},
    {"fracture energy infinite", "peri.h: a number is not finite", refused, HUGE_VAL, 0, 1, PERI_ERROR_RANGE, "fracture_energy", REFUSED},
    {"fracture energy negative", "peri.h: > 0", refused, -1e-9, 0, 1, PERI_ERROR_RANGE, "fracture_energy", REFUSED},
    {"both limits", "peri.h: not both", refused, 1, 0, 2, PERI_ERROR_MATERIAL, NULL, REFUSED},
    {"work on bonds without its energy", "peri.h: lacks its fracture energy", refused, 0, 0, PERI_CRITERION_BOND_ENERGY,
     PERI_ERROR_CRITERION, NULL, REFUSED},
    {"a criterion that is none", "peri.h: not a value of this enum", refused, 0, 0, PERI_CRITERION_DELAYED_STRETCH + 1, PERI_ERROR_CHOICE,
     "criterion", REFUSED},
    {"two points, critical stretch", "s > s0", threshold, 0, 0, PERI_CRITERION_STRETCH, PERI_OK, NULL, EXACT},
    {"two points, work on the bond", "X s^2 (1/V + 1/W)/2 > w0", threshold, 1e-3, 0, PERI_CRITERION_BOND_ENERGY, PERI_OK, NULL, EXACT},
    {"two points, energy of ends", "X s^2 (1/V + 1/W)/2 > w0", threshold, 1e-3, 0, PERI_CRITERION_NODE_ENERGY, PERI_OK, NULL, EXACT},
    {"two points, work of 1e-12", "X s^2 (1/V + 1/W)/2 > w0", threshold, 1e-12, 0, PERI_CRITERION_BOND_ENERGY, PERI_OK, NULL, EXACT},
    {"torn in equilibrium", "peri.h: what broke off bears nothing", torn, 1e-12, 0, 0, PERI_OK, NULL, EXACT},
    {"no point may fail", "peri.h: never break", no_fail, 64, 0, 0, PERI_OK, NULL, EXACT},
    {"all but one may not fail", "peri.h: with an end in the set never", no_fail, 63, 0, 0, PERI_OK, NULL, EXACT},
    {"half may not fail", "peri.h: with an end in the set never", no_fail, 32, 0, 0, PERI_OK, NULL, EXACT},
    {"a reset after fracture", "the same bits as a fresh body", reset, 0, 0, 0, PERI_OK, NULL, EXACT},
};
const extreme_table extreme_damage = EXTREME_TABLE("damage", rows);
