/* SPDX-License-Identifier: MIT */
/* test_toughness.c - the energy that a crack takes, over the G0 of the material, of every law and criterion.

   SOURCE OF TRUTH: Griffith. A strip is torn along its middle: its grips open slowly, the less the farther ahead, so that the crack grows
   only as they do. What breaking takes (`fracture` of the ledger) over the area that the crack has grown by is G0. What the far field
   releases, W h with the energy density W of uniform opening, is that and what the lattice traps: it springs free as the crack jumps from
   row to row and is damped. The area: bonds broken across the middle, over those per length. */
#include "scene.h"

enum { NOTCH = 8 };

typedef struct strip {
    int32_t space, law, criterion, moments, influence;
    int     m; /* spacings to the horizon                                                                                */
    double  nu;
} strip;

typedef struct rip {
    const double *x;
    int64_t       across, beside; /* bonds broken, by whether they cross the middle                                      */
    double        per_length, length, grip, opening, rate;
    int           moving;
    double        from_area, from_energy, area, energy, released;
    int           looks;
} rip;

static const double G0 = 1e-6, FALL = 0.5; /* FALL: of the opening, from the first column to the last                    */

static double opens(const rip *r, double x, double time) { return r->opening * (1 - FALL * x / r->length) * (1 + r->rate * time); }

static int32_t in_grip(void *user, int64_t i, const double *x) {
    (void)i;
    return fabs(x[1]) > ((const rip *)user)->grip;
}

/* In peri_solve time is the load factor. */
static int32_t open_grips(void *user, double time, int64_t count, const int32_t *points, double *value) {
    const rip *r = (const rip *)user;
    for (int64_t k = 0; k < count; ++k) {
        const double *x = &r->x[2 * points[k]];
        value[2 * k] = 0;
        value[2 * k + 1] = (x[1] > 0 ? 1 : -1) * (r->moving ? opens(r, x[0], time) : time * opens(r, x[0], 0));
    }
    return 0;
}

static int32_t note_break(void *user, int32_t i, int32_t j, double time, double stretch) {
    rip *r = (rip *)user;
    (void)time, (void)stretch;
    if (r->x[2 * i + 1] * r->x[2 * j + 1] < 0) r->across++;
    else r->beside++;
    return 0;
}

/* Counts from the fifth spacing on, up to 85 % of the way. */
static int32_t look(void *user, peri_body *b) {
    rip *r = (rip *)user;
    peri_energy e;
    (void)MUST(b, peri_get_energy(b, &e));
    r->area = (double)r->across / r->per_length;
    r->energy = e.fracture;
    if (r->area < 5) {
        r->from_area = r->area;
        r->from_energy = r->energy;
        return 0;
    }
    r->released += pow(opens(r, NOTCH + r->area, peri_time(b)), 2);
    r->looks++;
    return r->area > 0.85 * (r->length - NOTCH);
}

static peri_body *strip_of(const strip *s, rip *r) {
    specimen p = specimen_of(s->space, s->law, s->nu, 1.0, s->m * 1.0000001, s->m <= 3 ? 36 : 44, 0, 1);
    p.lo[1] = -4 * s->m;
    p.hi[1] = 4 * s->m;
    p.desc.geometry = PERI_GEOMETRY_LINEAR;
    p.desc.influence = s->influence;
    p.desc.moments = s->moments;
    p.material.criterion = s->criterion;
    p.material.fracture_energy = G0;
    r->length = p.hi[0];
    r->grip = 3 * s->m;
    return specimen_make(&p);
}

typedef struct taken {
    double energy, released, beside; /* over G0; bonds broken beside the plane, over those across it                     */
} taken;

static taken tear(strip s) {
    rip r;
    memset(&r, 0, sizeof r);
    peri_body *b = strip_of(&s, &r);
    const int64_t n = peri_point_count(b);
    const double from[2] = {-1, 0}, to[2] = {NOTCH, 0}, duration = 3000;
    const double nu = s.law == PERI_LAW_BOND_BASED ? bond_nu(s.space) : s.nu;
    const double plane = s.space == PERI_SPACE_PLANE_STRESS ? 1 - nu * nu : (1 + nu) * (1 - 2 * nu) / (1 - nu);
    double *x = (double *)calloc((size_t)(2 * n), sizeof *x);
    peri_solve_desc solve;
    peri_advance_desc a;
    taken t = {0, 0, 0};
    (void)MUST(b, peri_get_field(b, PERI_FIELD_POSITION, x, 2 * n));
    r.x = x;
    r.opening = sqrt(G0 * r.grip * plane);
    r.rate = 1.8 / duration;
    for (int dx = -s.m; dx <= s.m; ++dx)
        for (int dy = 1; dy <= s.m; ++dy) r.per_length += dx * dx + dy * dy <= s.m * s.m ? dy : 0;
    (void)MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, from, to));
    const int32_t grips = (int32_t)MUST(b, peri_select_if(b, NULL, in_grip, &r));
    (void)MUST(b, peri_prescribe_displacement(b, grips, PERI_AXIS_XY, NULL, open_grips, &r));
    (void)MUST(b, peri_on_break(b, note_break, &r));
    peri_solve_desc_init(&solve);
    solve.fracture = 0;
    (void)MUST(b, peri_solve(b, &solve, NULL));
    r.moving = 1;
    peri_advance_desc_init(&a);
    a.damping = 0.1;
    a.duration = duration;
    a.frame_steps = 20;
    a.on_frame = look;
    a.user = &r;
    (void)MUST(b, peri_advance(b, &a));
    CHECK(r.area - r.from_area > 10);
    t.energy = (r.energy - r.from_energy) / (r.area - r.from_area) / G0;
    t.released = r.released / r.looks / pow(r.opening, 2);
    t.beside = (double)r.beside / (double)r.across;
    printf("    %-12s criterion %d, %s, m = %d, nu = %.2f, w %d, %s: taken %.3f, released %.3f of G0, %.2f beside\n",
           law_name[s.law % 100], s.criterion % 100, s.space == PERI_SPACE_PLANE_STRESS ? "stress" : "strain", s.m, nu, s.influence % 100,
           s.moments == PERI_MOMENTS_WHOLE ? "whole" : "live", t.energy, t.released, t.beside);
    free(x);
    peri_body_destroy(b);
    return t;
}

static void takes(strip s, double most_off) {
    const taken t = tear(s);
    CHECK_NEAR(t.energy, 1, 0, most_off);
    CHECK(t.released > 0.9 * t.energy); /* what is taken comes from the far field */
}

#define STRIP(space, law, criterion, moments, m, nu)                                                                   \
    { PERI_SPACE_PLANE_##space, PERI_LAW_##law, PERI_CRITERION_##criterion, PERI_MOMENTS_##moments, PERI_INFLUENCE_CONSTANT, m, nu }

/* Whole families: 5 % over the range of Poisson's ratio of plane stress, and up to 0.25 in plane strain, where s0 goes with
   E/(1 - nu^2). */
static void stretch(void) {
    static const strip s[] = {STRIP(STRESS, LPS, STRETCH, WHOLE, 3, 0.1), STRIP(STRESS, LPS, STRETCH, WHOLE, 3, 0.4),
                              STRIP(STRESS, OTERKUS, STRETCH, WHOLE, 3, 0.25), STRIP(STRAIN, LPS, STRETCH, WHOLE, 3, 0.1)};
    for (size_t k = 0; k < sizeof s / sizeof *s; ++k) takes(s[k], 0.05);
}

/* Bond-based cracks break more beside the plane: 13 % of the bonds. Above a ratio of 0.25 in plane strain the dilatation takes more. */
static void stretch_off(void) {
    const strip bonds = STRIP(STRESS, BOND_BASED, STRETCH, LIVE, 3, 0), tight = STRIP(STRAIN, LPS, STRETCH, WHOLE, 3, 0.35);
    takes(bonds, 0.15);
    takes(tight, 0.1);
}

static void energy_of_bonds(void) {
    const strip lps = STRIP(STRESS, LPS, BOND_ENERGY, WHOLE, 3, 0.25), oterkus = STRIP(STRESS, OTERKUS, BOND_ENERGY, WHOLE, 3, 0.25);
    takes(lps, 0.08);
    takes(oterkus, 0.05);
}

/* 7 times G0 without its own calibration. */
static void energy_of_points(void) {
    const strip lps = STRIP(STRESS, LPS, NODE_ENERGY, WHOLE, 3, 0.25);
    takes(lps, 0.1);
}

/* All laws and criteria at 3 and 5 spacings, and what steeper weights make of them. No bars but that G0 is met to a factor of two. */
static void table(void) {
    for (int32_t law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law)
        for (int32_t criterion = PERI_CRITERION_STRETCH; criterion <= PERI_CRITERION_NODE_ENERGY; ++criterion)
            for (int k = 0; k < 8; ++k) {
                const int ordinary = law == PERI_LAW_LPS || law == PERI_LAW_OTERKUS;
                strip s = {PERI_SPACE_PLANE_STRESS, law, criterion, k & 1 ? PERI_MOMENTS_WHOLE : PERI_MOMENTS_LIVE,
                           k & 2 ? PERI_INFLUENCE_LINEAR : PERI_INFLUENCE_CONSTANT, k & 4 ? 5 : 3, 0.25};
                if ((law == PERI_LAW_BOND_BASED && criterion != PERI_CRITERION_STRETCH) || (!ordinary && k & 1)) continue;
                if (criterion != PERI_CRITERION_STRETCH && k & 2) continue;
                const taken t = tear(s);
                CHECK(t.energy > 0.5 && t.energy < 2);
            }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(stretch);
    RUN(stretch_off);
    RUN(energy_of_bonds);
    RUN(energy_of_points);
    LONG_RUN(table);
    return test_end("test_toughness");
}
