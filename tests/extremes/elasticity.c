/* SPDX-License-Identifier: MIT */
/* elasticity.c - ratios and moduli at the limits of what a solid can have.

   SOURCE OF TRUTH: linear elasticity, W = 1/2 K tr^2 + mu |dev|^2 with K and mu of the space from E and nu, each by the form that cancels
   no digits; the manual, where a material must be refused; Gershgorin and the energy that velocity-Verlet keeps, for the stable step.

   Errors are parts of (K + 2 mu)|strain|^2, or |strain|: the laws are sums of terms of that size, so that the smaller modulus is right to
   the rounding unit times the ratio of the two, which grows without bound as nu nears -1 or 1/2. */
#include "extremes.h"

#define COUNT(a) ((int)(sizeof(a) / sizeof(a)[0]))

static int dim_of(int32_t space) { return space == PERI_SPACE_SOLID ? 3 : 2; }
static double bond_ratio(int32_t space) { return space == PERI_SPACE_PLANE_STRESS ? 1.0 / 3.0 : 0.25; }

static double shear_of(double nu) { return 0.5 / (1 + nu); }
static double bulk_of(int32_t space, double nu) {
    if (space == PERI_SPACE_SOLID) return 1 / (3 * (1 - 2 * nu));
    return space == PERI_SPACE_PLANE_STRESS ? 0.5 / (1 - nu) : 0.5 / ((1 + nu) * (1 - 2 * nu));
}

/* ---- what is refused ---------------------------------------------------------------------------------------------- */

/* Offers a material to a body of each space; the first that is taken ends it. */
static void offer(outcome *o, const extreme *row, int32_t precision, const peri_material_desc *m, int32_t space) {
    outcome one = {PERI_OK, "", 0};
    peri_body_desc d;
    peri_body *b = NULL;
    extreme_desc(&d, space, precision, 3);
    if (!extreme_fails(&one, NULL, peri_body_create(&d, &b, NULL))) (void)extreme_fails(&one, b, peri_add_material(b, m));
    if (one.status != row->status || strcmp(one.field, row->field) != 0)
        printf("    law %d, space %d, poisson %.17g, young %g, bulk %g: %d %s\n", (int)m->law, (int)space, m->poisson, m->young,
               m->bulk, (int)one.status, one.field);
    if (o->status == row->status) *o = one;
    (void)extreme_end(one, b);
}

static outcome ratios_refused(const extreme *row, int32_t precision) {
    const double limits[] = {0.5, -1, nextafter(0.5, 1), nextafter(-1, -2), 0.6, -1.5, 1e300, -1e300, HUGE_VAL, -HUGE_VAL, NAN};
    const double others[] = {0, -0.2, 0.3, 0.5, -1, 0.25 + 1e-8, 1.0 / 3.0 - 1e-8, 2, -1e300, HUGE_VAL};
    const int n = row->choice ? COUNT(others) : COUNT(limits);
    outcome o = {row->status, row->field, 0};
    int32_t space, law;
    int k;
    for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
        for (law = row->choice ? PERI_LAW_BOND_BASED : PERI_LAW_LPS; law <= (row->choice ? PERI_LAW_BOND_BASED : PERI_LAW_CORRESPONDENCE);
             ++law)
            for (k = 0; k < n; ++k) {
                peri_material_desc m;
                extreme_material(&m, law, 0, 0);
                m.poisson = row->choice ? others[k] : limits[k];
                offer(&o, row, precision, &m, space);
            }
    return o;
}

/* choice 0: both moduli or neither; 1: E not a modulus; 2: K not a modulus. */
static outcome moduli_refused(const extreme *row, int32_t precision) {
    const double bad[] = {-1, -1e-300, NAN, HUGE_VAL, -HUGE_VAL};
    outcome o = {row->status, row->field, 0};
    int32_t law;
    int k;
    for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law)
        for (k = 0; k < (row->choice ? COUNT(bad) : 3); ++k) {
            peri_material_desc m;
            extreme_material(&m, law, 0.2, 0);
            if (row->choice == 0) {
                m.young = k == 0 ? 0 : 1;
                m.bulk = k == 0 ? 0 : k == 1 ? 1 / 1.8 : 4.9e-324; /* 1/1.8 agrees with nu = 0.2, and is one too many all the same */
            } else {
                m.young = row->choice == 1 ? bad[k] : 0;
                m.bulk = row->choice == 2 ? bad[k] : 0;
            }
            offer(&o, row, precision, &m, PERI_SPACE_SOLID);
        }
    return o;
}

/* ---- uniform strain ----------------------------------------------------------------------------------------------- */

static void count_remark(void *user, int32_t level, const char *text) {
    (void)text;
    *(int *)user += level == 1;
}

/* A block so small that only its middle has a whole family; bond-based, whose bonds take the mean of both ends: and its neighbours. */
static peri_body *block(outcome *o, int32_t space, int32_t precision, int32_t law, double nu, int32_t correction, int32_t geometry,
                        int *remarks) {
    const double more = law == PERI_LAW_BOND_BASED ? 1 : 0, edge = space == PERI_SPACE_SOLID ? 5 + 4 * more : 7 + 6 * more;
    const double lo[3] = {0, 0, 0}, hi[3] = {edge, edge, edge};
    peri_body_desc d;
    peri_material_desc m;
    peri_body *b = NULL;
    extreme_desc(&d, space, precision, space == PERI_SPACE_SOLID ? 2 : 3);
    d.correction = correction;
    d.geometry = geometry;
    d.log = remarks ? count_remark : NULL;
    d.log_user = remarks;
    extreme_material(&m, law, nu, 0);
    if (extreme_fails(o, NULL, peri_body_create(&d, &b, NULL)) || extreme_fails(o, b, peri_add_material(b, &m))
        || extreme_fails(o, b, peri_add_box(b, material_id(b, 1), lo, hi, 1)))
        return b;
    (void)extreme_fails(o, b, peri_build(b));
    return b;
}

/* The number of a field in the middle. */
static void middle(outcome *o, peri_body *b, int32_t field, double *out) {
    const int64_t parts = peri_size_of_field(b, field) / peri_point_count(b);
    double *x = extreme_read(o, b, field);
    if (x) memcpy(out, x + peri_point_count(b) / 2 * parts, (size_t)parts * sizeof *x);
    free(x);
}

/* Strains: alike in all directions, along one, two shears, and one of all. */
#define STRAINS 5
static const double strains[STRAINS][9] = {{1, 0, 0, 0, 1, 0, 0, 0, 1},
                                           {1, 0, 0, 0, 0, 0, 0, 0, 0},
                                           {0, 0.5, 0, 0.5, 0, 0, 0, 0, 0},
                                           {1, 0, 0, 0, -1, 0, 0, 0, 0},
                                           {0.7, 0.2, -0.4, 0.2, -0.3, 0.5, -0.4, 0.5, 0.9}};

/* The strain of a table in dim dimensions, times size: gradient[dim*dim]. */
static double strain_of(int which, int dim, double size, double *gradient, double *trace) {
    double square = 0;
    int a, c;
    *trace = 0;
    for (a = 0; a < dim; ++a)
        for (c = 0; c < dim; ++c) {
            gradient[a * dim + c] = size * strains[which][3 * a + c];
            square += gradient[a * dim + c] * gradient[a * dim + c];
            if (a == c) *trace += gradient[a * dim + c];
        }
    return square;
}

/* W and stress in the middle of a block under each strain. Oterkus without correction is calibrated on isotropic strain and on the mean
   of shear over its directions alone: on a lattice the others differ. */
static void strain_block(outcome *o, const extreme *row, peri_body *b, int32_t space, int32_t precision, int32_t law, double nu,
                         double size) {
    const int dim = dim_of(space);
    const double bulk = bulk_of(space, nu), shear = shear_of(nu), whole = bulk + 2 * shear;
    static const int place[2][9] = {{0, 2, 2, 1}, {0, 3, 5, 3, 1, 4, 5, 4, 2}};
    int k, a;
    for (k = 0; k < STRAINS && o->status == PERI_OK; ++k) {
        double gradient[9], trace, square = strain_of(k, dim, size, gradient, &trace), got = 0, want, tensor[2][6] = {{0}}, worst = 0;
        extreme_affine(o, b, gradient, NULL);
        middle(o, b, PERI_FIELD_ENERGY_DENSITY, &got);
        middle(o, b, PERI_FIELD_STRESS, tensor[0]);
        middle(o, b, PERI_FIELD_FORCE_STRESS, tensor[1]);
        want = 0.5 * bulk * trace * trace + shear * (square - trace * trace / dim);
        extreme_note(o, row, precision, fabs(got - want) / (whole * square), "energy: law %d, space %d, nu %.17g, strain %d: %g, not %g",
                     (int)law, (int)space, nu, k, got / square, want / square);
        for (a = 0; a < dim * dim; ++a) {
            const double stress = 2 * shear * gradient[a] + (a % (dim + 1) == 0 ? (bulk - 2 * shear / dim) * trace : 0);
            worst = extreme_worst(worst, fabs(tensor[0][place[dim - 2][a]] - stress));
            worst = extreme_worst(worst, fabs(tensor[1][place[dim - 2][a]] - stress));
        }
        extreme_note(o, row, precision, worst / (whole * sqrt(square)), "stress: law %d, space %d, nu %.17g, strain %d",
                     (int)law, (int)space, nu, k);
    }
}

/* choice: the first law; value: the last; ratios between -1 and 1/2 as other tells: 0 the usual ones, 1 near -1, 2 near 1/2. */
static outcome uniform_strain(const extreme *row, int32_t precision) {
    const double usual[] = {-0.5, -0.3, 0, 4.9e-324, 0.25, 1.0 / 3.0, 0.4999}, most = 0.5, least = -1;
    const double low[] = {-0.99, -0.999999, -1 + 1e-10, nextafter(least, 0)};
    const double high[] = {0.49999, 0.5 - 1e-7, 0.5 - 1e-10, nextafter(most, 0)};
    const double *ratios = row->other == 0 ? usual : row->other == 1 ? low : high;
    const int n = row->other == 0 ? COUNT(usual) : COUNT(low);
    outcome o = {PERI_OK, "", 0};
    int32_t law, space;
    int k;
    for (law = row->choice; law <= (int32_t)row->value; ++law)
        for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
            for (k = 0; k < (law == PERI_LAW_BOND_BASED ? 1 : n) && o.status == PERI_OK; ++k) {
                const double nu = law == PERI_LAW_BOND_BASED ? bond_ratio(space) : ratios[k];
                peri_body *b = block(&o, space, precision, law, nu, PERI_CORRECTION_MOMENT, PERI_GEOMETRY_LINEAR, NULL);
                if (o.status == PERI_OK) strain_block(&o, row, b, space, precision, law, nu, 1e-3);
                else printf("    law %d, space %d, nu %.17g\n", (int)law, (int)space, nu);
                o = extreme_end(o, b);
            }
    return o;
}

/* Oterkus near nu = -1: the spring that shear asks for would make the energy of other strains negative, and is held back (peri.h). Strain
   alike in all directions has the energy of the solid all the same, no strain a negative one, and the log says so where the bound
   mu <= K D (1 + r)/((D + 2) r) is passed, r = 1/8 in planes and 1/15 in 3D: in plane strain never, mu/K being 1 - 2 nu. */
static outcome held_back(const extreme *row, int32_t precision) {
    const double ratios[] = {-0.8, -0.99, -0.999999, -1 + 1e-10, nextafter(-1, 0)};
    outcome o = {PERI_OK, "", 0};
    int32_t space;
    int k, s;
    for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
        for (k = 0; k < COUNT(ratios) && o.status == PERI_OK; ++k) {
            const double nu = ratios[k];
            int remarks = 0;
            peri_body *b = block(&o, space, precision, PERI_LAW_OTERKUS, nu, PERI_CORRECTION_NONE, PERI_GEOMETRY_LINEAR, &remarks);
            if ((remarks > 0) != (space != PERI_SPACE_PLANE_STRAIN))
                extreme_note(&o, row, precision, NAN, "%d remarks: space %d, nu %.17g", remarks, (int)space, nu);
            for (s = 0; s < STRAINS && o.status == PERI_OK; ++s) {
                double gradient[9], trace, got = 0, square = strain_of(s, dim_of(space), 1e-3, gradient, &trace);
                const double want = 0.5 * bulk_of(space, nu) * trace * trace;
                extreme_affine(&o, b, gradient, NULL);
                middle(&o, b, PERI_FIELD_ENERGY_DENSITY, &got);
                if (s == 0) extreme_note(&o, row, precision, fabs(got / want - 1), "space %d, nu %.17g: bulk energy over its own",
                                         (int)space, nu);
                if (!(got > -row->bound[precision == PERI_PRECISION_DOUBLE ? 0 : 2] * bulk_of(space, nu) * square))
                    extreme_note(&o, row, precision, NAN, "negative: space %d, nu %.17g, strain %d", (int)space, nu, s);
            }
            o = extreme_end(o, b);
        }
    return o;
}

/* K given in place of E: the same solid. K = E/(3(1-2 nu)) in every space. */
static outcome bulk_for_young(const extreme *row, int32_t precision) {
    const double ratios[] = {nextafter(-1, 0), -0.5, 0, 0.4999, 0.5 - 1e-10, nextafter(0.5, 0)};
    outcome o = {PERI_OK, "", 0};
    int32_t law, space;
    int k;
    for (law = PERI_LAW_LPS; law < peri__end_law; ++law)
        for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
            for (k = 0; k < COUNT(ratios); ++k) {
                double energy[2] = {0, 1}, step[2];
                int way;
                for (way = 0; way < 2; ++way) {
                    const double lo[3] = {0, 0, 0}, hi[3] = {4, 3, 3}, gradient[9] = {1e-3, 2e-4, 0, 2e-4, 5e-4, 0, 0, 0, 0};
                    const double flat[4] = {1e-3, 2e-4, 2e-4, 5e-4};
                    peri_body_desc d;
                    peri_material_desc m;
                    peri_body *b = NULL;
                    peri_energy e;
                    extreme_desc(&d, space, precision, 2);
                    extreme_material(&m, law, ratios[k], 0);
                    if (way) m.bulk = 1 / (3 * (1 - 2 * ratios[k]));
                    if (way) m.young = 0;
                    (void)extreme_fails(&o, NULL, peri_body_create(&d, &b, NULL));
                    (void)extreme_fails(&o, b, peri_add_material(b, &m));
                    (void)extreme_fails(&o, b, peri_add_box(b, material_id(b, 1), lo, hi, 1));
                    if (!extreme_fails(&o, b, peri_build(b))) {
                        extreme_affine(&o, b, space == PERI_SPACE_SOLID ? gradient : flat, NULL);
                        if (!extreme_fails(&o, b, peri_get_energy(b, &e))) energy[way] = e.elastic;
                    }
                    step[way] = peri_stable_step(b);
                    o = extreme_end(o, b);
                }
                extreme_note(&o, row, precision, fabs(energy[1] / energy[0] - 1), "energy: law %d, space %d, nu %.17g", (int)law,
                             (int)space, ratios[k]);
                extreme_note(&o, row, precision, fabs(step[1] / step[0] - 1), "step: law %d, space %d, nu %.17g", (int)law,
                             (int)space, ratios[k]);
            }
    return o;
}

/* ---- contrast ----------------------------------------------------------------------------------------------------- */

/* Two blocks out of each other's reach in one body, the second of modulus (choice 1: density) ten^value of the first. Each moves as it
   would by itself: strained alike they have stresses, forces and energies as their moduli, and under one force density velocities as
   1/density. other 1: but in double precision it may be refused. */
static outcome contrast(const extreme *row, int32_t precision) {
    const double ratio = pow(10, row->value), young = row->choice ? 1 : ratio, density = row->choice ? ratio : 1;
    outcome o = {PERI_OK, "", 0};
    int32_t law, space;
    for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law)
        for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space && o.status == PERI_OK; ++space) {
            static const int32_t fields[4] = {PERI_FIELD_STRESS, PERI_FIELD_FORCE_STRESS, PERI_FIELD_FORCE_DENSITY,
                                              PERI_FIELD_ENERGY_DENSITY};
            const double lo[3] = {0, 0, 0}, hi[3] = {4, 4, 3}, lo2[3] = {64, 0, 0}, hi2[3] = {68, 4, 3}, push[3] = {1e-3, 2e-3, 0};
            const double solid[9] = {1e-3, 2e-4, 0, 0, -5e-4, 0, 0, 0, 3e-4}, plane[4] = {1e-3, 2e-4, 0, -5e-4};
            const double *gradient = space == PERI_SPACE_SOLID ? solid : plane;
            const int dim = dim_of(space);
            peri_body_desc d;
            peri_material_desc m;
            peri_body *b = NULL;
            peri_advance_desc run;
            double *x, *v, before[3] = {0};
            int64_t i, n;
            int k;
            extreme_desc(&d, space, precision, 2);
            extreme_material(&m, law, 0.3, 0);
            (void)extreme_fails(&o, NULL, peri_body_create(&d, &b, NULL));
            (void)extreme_fails(&o, b, peri_add_material(b, &m));
            m.young = young;
            m.density = density;
            (void)extreme_fails(&o, b, peri_add_material(b, &m));
            (void)extreme_fails(&o, b, peri_add_box(b, material_id(b, 1), lo, hi, 1));
            (void)extreme_fails(&o, b, peri_add_box(b, material_id(b, 2), lo2, hi2, 1));
            if (extreme_fails(&o, b, peri_build(b))) {
                o = extreme_end(o, b);
                if (row->other == 1 && precision != PERI_PRECISION_DOUBLE && o.status == PERI_ERROR_RANGE) o.status = PERI_OK;
                break;
            }
            x = extreme_read(&o, b, PERI_FIELD_POSITION);
            n = peri_point_count(b) / 2;
            for (i = 0; x && i < 2 * n; ++i) {
                for (k = 0; k < dim; ++k) before[k] = x[i * dim + k] - (k == 0 && i >= n ? 64 : 0);
                for (k = 0; k < dim; ++k)
                    x[i * dim + k] = gradient[k * dim] * before[0] + gradient[k * dim + 1] * before[1]
                                   + (dim == 3 ? gradient[k * dim + 2] * before[2] : 0);
            }
            if (x) (void)extreme_fails(&o, b, peri_set_field(b, PERI_FIELD_DISPLACEMENT, x, 2 * n * dim));
            for (k = 0; k < 4 && o.status == PERI_OK; ++k) {
                const int64_t half = peri_size_of_field(b, fields[k]) / 2;
                double *f = extreme_read(&o, b, fields[k]), most = 0, worst = 0;
                for (i = 0; f && i < half; ++i) {
                    most = extreme_worst(most, fabs(f[i]));
                    worst = extreme_worst(worst, fabs(f[half + i] / young - f[i]));
                }
                extreme_note(&o, row, precision, worst / most, "field %d: law %d, space %d", (int)fields[k], (int)law, (int)space);
                free(f);
            }
            (void)extreme_fails(&o, b, peri_reset(b));
            (void)extreme_fails(&o, b, peri_apply_body_force(b, PERI_ALL, push, NULL, NULL));
            peri_advance_desc_init(&run);
            run.steps = 10;
            if (o.status == PERI_OK) (void)extreme_fails(&o, b, peri_advance(b, &run));
            v = extreme_read(&o, b, PERI_FIELD_VELOCITY);
            for (i = 0; v && i < 2 * n; ++i) /* all points of a block alike: no bond is strained */
                for (k = 0; k < 2; ++k)
                    extreme_note(&o, row, precision, fabs(v[i * dim + k] / (push[k] * peri_time(b) / (i < n ? 1 : density)) - 1),
                                 "velocity: law %d, space %d, point %d", (int)law, (int)space, (int)i);
            free(v);
            free(x);
            o = extreme_end(o, b);
        }
    return o;
}

/* ---- the stable step ---------------------------------------------------------------------------------------------- */

/* A small block thrown into vibration at random, at 0.9 of the stable step. Where the geometry is linear, velocity-Verlet keeps
   1/2 v^2 + 1/2 w^2 u^2 (1 - (w dt)^2/4) of each mode, so that from rest the energy stays below 1/(1 - 0.81) times that of the start; and
   where w dt > 2 it doubles every few steps. The error is the largest energy over that bound; value: steps. */
static int32_t note_energy(void *user, peri_body *b) {
    peri_energy e;
    double *largest = (double *)user;
    if (peri_get_energy(b, &e) != PERI_OK) return 1;
    *largest = extreme_worst(*largest, e.kinetic + e.elastic);
    if (e.elastic < -1e-4 * *largest) *largest = NAN;
    return 0;
}

static outcome stable(const extreme *row, int32_t precision) {
    const double ratios[] = {nextafter(-1, 0), -1 + 1e-6, -0.9, 0, 0.4999, 0.5 - 1e-6, nextafter(0.5, 0)};
    outcome o = {PERI_OK, "", 0};
    int32_t space;
    int k, cut;
    for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
        for (k = 0; k < COUNT(ratios) && o.status == PERI_OK; ++k)
            for (cut = 0; cut < 2; ++cut) {
                const double from[2] = {-1, 2.3}, to[2] = {3.4, 2.3};
                const double corner[3] = {-1, 2.3, -1}, edge1[3] = {4.4, 0, 0}, edge2[3] = {0, 0, 9};
                const int32_t correction = k % 2 ? PERI_CORRECTION_MOMENT : PERI_CORRECTION_NONE;
                peri_body *b = block(&o, space, precision, row->choice, ratios[k], correction, PERI_GEOMETRY_LINEAR, NULL);
                int64_t n = peri_size_of_field(b, PERI_FIELD_VELOCITY), i;
                uint64_t seed = 7;
                double *v = n > 0 ? (double *)malloc((size_t)n * sizeof *v) : NULL, largest[1] = {0};
                peri_energy start;
                peri_advance_desc run;
                if (cut)
                    (void)extreme_fails(&o, b, space == PERI_SPACE_SOLID ? peri_cut_rectangle(b, PERI_CUT_INITIAL, corner, edge1, edge2)
                                                                         : peri_cut_segment(b, PERI_CUT_INITIAL, from, to));
                for (i = 0; v && i < n; ++i) v[i] = test_random(&seed) - 0.5;
                peri_advance_desc_init(&run);
                run.steps = (int64_t)row->value;
                run.frame_steps = 10;
                run.on_frame = note_energy;
                run.user = largest;
                if (v && !extreme_fails(&o, b, peri_set_field(b, PERI_FIELD_VELOCITY, v, n))
                    && !extreme_fails(&o, b, peri_get_energy(b, &start))) {
                    if (extreme_fails(&o, b, peri_advance(b, &run))) printf("    space %d, nu %.17g, cut %d\n", (int)space, ratios[k], cut);
                    else
                        extreme_note(&o, row, precision, largest[0] / start.kinetic * 0.19,
                                     "space %d, nu %.17g, cut %d: energy %g times that of the start",
                                     (int)space, ratios[k], cut, largest[0] / start.kinetic);
                }
                free(v);
                o = extreme_end(o, b);
            }
    return o;
}

/* ---- equilibrium -------------------------------------------------------------------------------------------------- */

static int32_t hold_affine(void *user, double time, int64_t count, const int32_t *points, double *value) {
    const double *table = (const double *)user; /* dim, then the displacements of all points                             */
    const int dim = (int)table[0];
    int64_t k;
    int d;
    for (k = 0; k < count; ++k)
        for (d = 0; d < dim; ++d) value[k * dim + d] = time * table[1 + points[k] * dim + d];
    return 0;
}

/* A plate or block whose rim, two horizons deep, is sheared: whole families of a lattice in uniform strain feel no force, so the inside
   follows. The strain keeps the volume: forces are those of mu however stiff the bulk is. Iterations are bounded by the default, 20000.
   value 1: ratios so near to 1/2 that forces round to more than the tolerance; then PERI_ERROR_CONVERGENCE is as good as the truth, as it
   is of any ratio where bonds are in single precision. */
#define MOST 512
static outcome sheared(const extreme *row, int32_t precision) {
    const double usual[] = {-0.999, -0.9, 0, 0.4999, 0.49999};
    const double high[] = {0.5 - 1e-6, 0.5 - 1e-8, 0.5 - 1e-10, 0.5 - 1e-13, nextafter(0.5, 0)};
    const double gradient[9] = {0.5e-3, 1e-3, 0, 1e-3, -0.5e-3, 0, 0, 0, 0};
    outcome o = {PERI_OK, "", 0};
    int32_t space, geometry;
    int k, a, c;
    for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
        for (geometry = PERI_GEOMETRY_NONLINEAR; geometry < peri__end_geometry; ++geometry)
            for (k = 0; k < (row->choice == PERI_LAW_BOND_BASED ? 1 : 5) && o.status == PERI_OK; ++k) {
                const int dim = dim_of(space);
                if (geometry == PERI_GEOMETRY_LINEAR && k % 2) continue; /* the simpler one at every other ratio */
                const double ratio = row->choice == PERI_LAW_BOND_BASED ? bond_ratio(space) : row->value == 0 ? usual[k] : high[k];
                const double edge = dim == 3 ? 8 : 12, grip = dim == 3 ? 3 : 4, lo[3] = {0, 0, 0}, hi[3] = {edge, edge, edge};
                peri_body_desc d;
                peri_material_desc m;
                peri_body *b = NULL;
                peri_solve_desc s;
                peri_solve_report r;
                double *x = NULL, *u, table[1 + 3 * MOST], error = 0;
                int32_t rim[MOST], count = 0, i, status, points;
                memset(&r, 0, sizeof r);
                extreme_desc(&d, space, precision, dim == 3 ? 1.5 : 2);
                d.geometry = geometry;
                extreme_material(&m, row->choice, ratio, 0);
                (void)extreme_fails(&o, NULL, peri_body_create(&d, &b, NULL));
                (void)extreme_fails(&o, b, peri_add_material(b, &m));
                (void)extreme_fails(&o, b, peri_add_box(b, material_id(b, 1), lo, hi, 1));
                if (!extreme_fails(&o, b, peri_build(b))) x = extreme_read(&o, b, PERI_FIELD_POSITION);
                points = x ? (int32_t)peri_point_count(b) : 0;
                table[0] = dim;
                for (i = 0; i < points; ++i) {
                    int inside = 1;
                    for (a = 0; a < dim; ++a) {
                        inside &= x[dim * i + a] > grip && x[dim * i + a] < edge - grip;
                        table[1 + dim * i + a] = 0;
                        for (c = 0; c < dim; ++c) table[1 + dim * i + a] += gradient[3 * a + c] * x[dim * i + c];
                    }
                    if (!inside) rim[count++] = i;
                }
                (void)extreme_fails(&o, b, peri_prescribe_displacement(b, peri_select_points(b, NULL, count, rim),
                                                                       dim == 3 ? PERI_AXIS_XYZ : PERI_AXIS_XY, NULL, hold_affine, table));
                peri_solve_desc_init(&s);
                status = o.status == PERI_OK ? peri_solve(b, &s, &r) : o.status;
                u = extreme_read(&o, b, PERI_FIELD_DISPLACEMENT);
                for (i = 0; u && i < dim * points; ++i) error = extreme_worst(error, fabs(u[i] - table[1 + i]) / (edge * 1e-3));
                if (status == PERI_OK)
                    extreme_note(&o, row, precision, error, "space %d, geometry %d, nu %.17g; %d iterations, residual %.1e", (int)space,
                                 (int)geometry, ratio, (int)r.iterations, r.residual);
                else if (status != PERI_ERROR_CONVERGENCE || (row->value == 0 && precision == PERI_PRECISION_DOUBLE)) {
                    printf("    space %d, geometry %d, nu %.17g: %d after %d iterations\n", (int)space, (int)geometry, ratio, (int)status,
                           (int)r.iterations);
                    (void)extreme_fails(&o, b, status);
                }
                free(x);
                free(u);
                o = extreme_end(o, b);
            }
    return o;
}

/* Sums of up to 32 bonds, each rounded four times, through weights that solve a system of moments of a condition of 100. */
#define SUMS {1e-12, 1e-5, 1e-5}
#define HOOKE "linear elasticity: W = 1/2 K tr^2 + mu |dev|^2, stress its derivative"
#define VERLET "velocity-Verlet keeps 1/2 v^2 + 1/2 w^2 u^2 (1 - (w dt)^2/4) of each mode; (w dt)^2/4 <= 0.81"
#define AFFINE "whole families in uniform strain feel no force: the inside follows the rim"
#define BLOCKS "blocks out of reach of each other: as each by itself"
#define NONE {0, 0, 0}

static const extreme rows[] = {
    {"ratios of -1, 1/2 and beyond", "peri.h: poisson in (-1, 1/2)", ratios_refused, 0, 0, 0, PERI_ERROR_RANGE, "poisson", NONE},
    {"other ratios of bond-based solids", "peri.h: fixed by the space, others are refused", ratios_refused, 0, 0, 1, PERI_ERROR_POISSON,
     "poisson", NONE},
    {"both moduli, or neither", "peri.h: give E or K, not both", moduli_refused, 0, 0, 0, PERI_ERROR_MATERIAL, "bulk", NONE},
    {"E of no solid", "peri.h: E > 0", moduli_refused, 0, 0, 1, PERI_ERROR_RANGE, "young", NONE},
    {"K of no solid", "peri.h: K > 0", moduli_refused, 0, 0, 2, PERI_ERROR_RANGE, "bulk", NONE},
    {"uniform strain, bond-based", HOOKE, uniform_strain, PERI_LAW_BOND_BASED, 0, PERI_LAW_BOND_BASED, PERI_OK, NULL, SUMS},
    {"uniform strain, LPS", HOOKE, uniform_strain, PERI_LAW_LPS, 0, PERI_LAW_LPS, PERI_OK, NULL, SUMS},
    {"uniform strain, LPS, ratio to -1", HOOKE, uniform_strain, PERI_LAW_LPS, 1, PERI_LAW_LPS, PERI_OK, NULL, SUMS},
    {"uniform strain, LPS, ratio to 1/2", HOOKE, uniform_strain, PERI_LAW_LPS, 2, PERI_LAW_LPS, PERI_OK, NULL, SUMS},
    {"uniform strain, Oterkus", HOOKE, uniform_strain, PERI_LAW_OTERKUS, 0, PERI_LAW_OTERKUS, PERI_OK, NULL, SUMS},
    {"uniform strain, Oterkus, ratio to 1/2", HOOKE, uniform_strain, PERI_LAW_OTERKUS, 2, PERI_LAW_OTERKUS, PERI_OK, NULL, SUMS},
    {"uniform strain, Oterkus, ratio to -1", "peri.h: never a spring that could make the energy negative; bulk energy is the solid's",
     held_back, 0, 0, 0, PERI_OK, NULL, SUMS},
    {"uniform strain, correspondence", HOOKE, uniform_strain, PERI_LAW_CORRESPONDENCE, 0, PERI_LAW_CORRESPONDENCE, PERI_OK, NULL, SUMS},
    {"uniform strain, correspondence, ratio to -1", HOOKE, uniform_strain, PERI_LAW_CORRESPONDENCE, 1, PERI_LAW_CORRESPONDENCE, PERI_OK,
     NULL, SUMS},
    {"uniform strain, correspondence, ratio to 1/2", HOOKE, uniform_strain, PERI_LAW_CORRESPONDENCE, 2, PERI_LAW_CORRESPONDENCE, PERI_OK,
     NULL, SUMS},
    {"K in place of E", "K = E/(3(1-2 nu)): the same solid", bulk_for_young, 0, 0, 0, PERI_OK, NULL, {1e-13, 1e-6, 1e-6}},
    {"moduli of 1 and 1e-16 in one body", BLOCKS, contrast, -16, 0, 0, PERI_OK, NULL, {1e-13, 2e-4, 2e-4}},
    {"moduli of 1 and 1e-24 in one body", BLOCKS, contrast, -24, 0, 0, PERI_OK, NULL, {1e-13, 2e-4, 2e-4}},
    {"moduli of 1 and 1e-40 in one body", "right, or refused in single", contrast, -40, 1, 0, PERI_OK, NULL, {1e-13, 2e-4, 2e-4}},
    {"moduli of 1 and 1e-240 in one body", "right, or refused in single", contrast, -240, 1, 0, PERI_OK, NULL, {1e-13, 2e-4, 2e-4}},
    {"moduli of 1 and 1e16 in one body", BLOCKS, contrast, 16, 0, 0, PERI_OK, NULL, {1e-13, 2e-4, 2e-4}},
    {"densities of 1 and 1e-11 in one body", BLOCKS, contrast, -11, 0, 1, PERI_OK, NULL, {1e-13, 2e-4, 2e-4}},
    {"densities of 1 and 1e11 in one body", BLOCKS, contrast, 11, 0, 1, PERI_OK, NULL, {1e-13, 2e-4, 2e-4}},
    {"densities of 1 and 1e24 in one body", BLOCKS, contrast, 24, 0, 1, PERI_OK, NULL, {1e-13, 2e-4, 2e-4}},
    {"densities of 1 and 1e40 in one body", "right, or refused in single", contrast, 40, 1, 1, PERI_OK, NULL, {1e-13, 2e-4, 2e-4}},
    {"moduli of 1 and 1e-260 in one body", "beyond what the unit of stress leaves", contrast, -260, 0, 0, PERI_ERROR_RANGE, NULL, NONE},
    {"moduli of 1 and 1e260 in one body", "beyond what the unit of stress leaves", contrast, 260, 0, 0, PERI_ERROR_RANGE, NULL, NONE},
    {"densities of 1 and 1e-260 in one body", "beyond what the unit of density leaves", contrast, -260, 0, 1, PERI_ERROR_RANGE, NULL, NONE},
    {"densities of 1 and 1e260 in one body", "beyond what the unit of density leaves", contrast, 260, 0, 1, PERI_ERROR_RANGE, NULL, NONE},
    {"stable step, LPS", VERLET, stable, 150, 0, PERI_LAW_LPS, PERI_OK, NULL, {1, 1, 1}},
    {"stable step, Oterkus", VERLET, stable, 150, 0, PERI_LAW_OTERKUS, PERI_OK, NULL, {1, 1, 1}},
    {"stable step, correspondence", VERLET, stable, 150, 0, PERI_LAW_CORRESPONDENCE, PERI_OK, NULL, {1, 1, 1}},
    {"sheared at rest, bond-based", AFFINE, sheared, 0, 0, PERI_LAW_BOND_BASED, PERI_OK, NULL, {1e-6, 1e-3, 1e-2}},
    {"sheared at rest, LPS", AFFINE, sheared, 0, 0, PERI_LAW_LPS, PERI_OK, NULL, {1e-6, 1e-3, 1e-2}},
    {"sheared at rest, LPS, ratio to 1/2", AFFINE, sheared, 1, 0, PERI_LAW_LPS, PERI_OK, NULL, {1e-6, 1e-3, 1e-2}},
    {"sheared at rest, Oterkus", AFFINE, sheared, 0, 0, PERI_LAW_OTERKUS, PERI_OK, NULL, {1e-6, 1e-3, 1e-2}},
    {"sheared at rest, Oterkus, ratio to 1/2", AFFINE, sheared, 1, 0, PERI_LAW_OTERKUS, PERI_OK, NULL, {1e-6, 1e-3, 1e-2}},
    {"sheared at rest, correspondence", AFFINE, sheared, 0, 0, PERI_LAW_CORRESPONDENCE, PERI_OK, NULL, {1e-6, 1e-3, 1e-2}},
    {"sheared at rest, correspondence, ratio to 1/2", AFFINE, sheared, 1, 0, PERI_LAW_CORRESPONDENCE, PERI_OK, NULL, {1e-6, 1e-3, 1e-2}},
};
const extreme_table extreme_elasticity = EXTREME_TABLE("elasticity", rows);
