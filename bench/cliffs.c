/* SPDX-License-Identifier: MIT */
/* cliffs.c - what each setting costs over the best path of its law and storage: ns per directed bond over those of the plain body, timed
   in turns. A ratio of much more than 3 is a cliff: a setting for which passes go another, slower way. By the public API alone. */
#include "scene.h"

typedef struct setting { /* what differs from a whole body of one material, whose bonds may break by their stretch            */
    const char *name;
    int32_t     criterion, correction, influence, materials;
    double      m;
    int         beside; /* 1: the last material is of another law                                                                */
    int         harmed; /* 1: 2 % of the bonds cut and a crack                                                                   */
    int         bonds;  /* 1: of bond-based bodies, too; 2: of them only                                                         */
    int         clouds; /* 1: of clouds, too                                                                                     */
} setting;

#define EDGE 18 /* points, in slabs of one material each                                                                       */

static const setting settings[] = {
    { "harmed: 2 % of bonds cut, a crack", 0, 0, 0, 1, 3, 0, 1, 1, 1 },
    { "energy of bonds", PERI_CRITERION_BOND_ENERGY, 0, 0, 1, 3, 0, 0, 0, 1 },
    { "energy of points", PERI_CRITERION_NODE_ENERGY, 0, 0, 1, 3, 0, 0, 0, 1 },
    { "principal stress", PERI_CRITERION_PRINCIPAL_STRESS, 0, 0, 1, 3, 0, 0, 0, 1 },
    { "von Mises", PERI_CRITERION_VON_MISES, 0, 0, 1, 3, 0, 0, 0, 1 },
    { "confined stretch", PERI_CRITERION_CONFINED_STRETCH, 0, 0, 1, 3, 0, 0, 1, 1 },
    { "rate stretch", PERI_CRITERION_RATE_STRETCH, 0, 0, 1, 3, 0, 0, 1, 1 },
    { "moment correction", 0, PERI_CORRECTION_MOMENT, 0, 1, 3, 0, 0, 1, 1 },
    { "energy correction", 0, PERI_CORRECTION_ENERGY, 0, 1, 3, 0, 0, 2, 1 },
    { "w = 1/q", 0, 0, PERI_INFLUENCE_INVERSE, 1, 3, 0, 0, 1, 1 },
    { "2 materials", 0, 0, 0, 2, 3, 0, 0, 1, 1 },
    { "3 materials, moment correction", 0, PERI_CORRECTION_MOMENT, 0, 3, 3, 0, 0, 1, 1 },
    { "another law beside", 0, 0, 0, 2, 3, 1, 0, 1, 1 },
    { "another law beside, harmed", 0, 0, 0, 2, 3, 1, 1, 1, 0 },
    { "m = 2", 0, 0, 0, 1, 2, 0, 0, 1, 1 },
    { "m = 6", 0, 0, 0, 1, 6, 0, 0, 1, 0 },
};

typedef struct best_path { /* of a law and a storage */
    int32_t law, precision, cloud;
} best_path;

static void add_materials(peri_body *body, const best_path *p, const setting *s) {
    for (int32_t k = 0; k < s->materials; ++k) {
        const int other = s->beside && k + 1 == s->materials;
        peri_material_desc m;
        peri_material_desc_init(&m, other ? (p->law == PERI_LAW_LPS ? PERI_LAW_BOND_BASED : PERI_LAW_LPS) : p->law);
        if (m.law != PERI_LAW_BOND_BASED) m.poisson = 0.3;
        m.young = 1 + k, m.density = 1;
        if (s->criterion) m.criterion = s->criterion;
        if (s->criterion == PERI_CRITERION_BOND_ENERGY || s->criterion == PERI_CRITERION_NODE_ENERGY) m.fracture_energy = 1e6;
        else if (s->criterion == PERI_CRITERION_PRINCIPAL_STRESS || s->criterion == PERI_CRITERION_VON_MISES) m.strength = 1e6;
        else m.critical_stretch = 0.5;
        if (s->criterion == PERI_CRITERION_CONFINED_STRETCH) m.compression = 0.25;
        if (s->criterion == PERI_CRITERION_RATE_STRETCH) m.rate = 1;
        need(body, peri_add_material(body, &m));
        const int32_t id = peri_id(body, PERI_KIND_MATERIAL, k + 1);
        const double lo[3] = { (double)k * EDGE / s->materials, 0, 0 }, hi[3] = { (k + 1.0) * EDGE / s->materials, EDGE, EDGE };
        need(body, p->cloud ? peri_add_perturbed_box(body, id, lo, hi, 1.0, 1.0, 7 + (uint64_t)k) : peri_add_box(body, id, lo, hi, 1.0));
    }
}

/* A body, ready for steps, and the number of its directed bonds. */
static peri_body *body_of(const best_path *p, const setting *s, int64_t *bonds) {
    peri_body_desc d;
    peri_body *body = NULL;
    bench_facts facts;
    peri_body_desc_init(&d);
    d.space = PERI_SPACE_SOLID, d.precision = p->precision, d.horizon = s->m, d.threads = 1, d.ledger = 0;
    if (s->correction) d.correction = s->correction;
    if (s->influence) d.influence = s->influence;
    need(NULL, peri_body_create(&d, &body, NULL));
    add_materials(body, p, s);
    need(body, peri_build(body));
    *bonds = peri_entry_count(body);
    memset(&facts, 0, sizeof facts);
    facts.points = peri_point_count(body);
    if (s->harmed) scene_harm(body, &facts);
    else scene_shake(body);
    return body;
}

/* The rows of a path. Returns how many are over the bar of 3; the worst ratio to *worst. */
static int rows_of(bench_run *run, table *t, const best_path *p, double *worst) {
    static const char *const laws[] = { "?", "bond-based", "LPS", "Oterkus", "correspondence" };
    static const setting plain = { "whole, stretch", 0, 0, 0, 1, 3, 0, 0, 1, 1 };
    int over = 0;
    int64_t bonds[2];
    peri_body *const base = body_of(p, &plain, &bonds[0]);
    for (size_t n = 0; n < sizeof settings / sizeof settings[0]; ++n) {
        const setting *s = &settings[n];
        const int bond_based = p->law == PERI_LAW_BOND_BASED;
        if ((bond_based ? s->bonds == 0 : s->bonds == 2) || (p->cloud && !s->clouds)) continue;
        double best[2] = { 1e300, 1e300 };
        peri_body *const bodies[2] = { base, body_of(p, s, &bonds[1]) };
        int64_t steps[2];
        for (int k = 0; k < 2; ++k) (void)scene_steps(bodies[k], 1, 1), steps[k] = enough_steps(scene_steps(bodies[k], 1, 1));
        for (int64_t r = 0; r < run->repeats; ++r)
            for (int k = 0; k < 2; ++k) {
                const double taken = scene_steps(bodies[k], steps[k], 1) * 1e9 / (double)(steps[k] * bonds[k]);
                if (taken < best[k]) best[k] = taken;
            }
        peri_body_destroy(bodies[1]);
        put_text(t, laws[p->law % 100]);
        put_text(t, p->precision == PERI_PRECISION_SINGLE ? "f32" : "f64");
        put_text(t, p->cloud ? "cloud" : "lattice");
        put_text(t, s->name);
        put_number(t, best[0]);
        put_number(t, best[1]);
        put_number(t, best[1] / best[0]);
        over += best[1] > 3 * best[0];
        if (best[1] / best[0] > *worst) *worst = best[1] / best[0];
    }
    peri_body_destroy(base);
    return over;
}

void bench_cliffs(bench_run *run) {
    static const column columns[] = {
        { "law", "law", -15, 0 },     { "reals", "precision", -6, 0 }, { "families", "families", -9, 0 }, { "setting", "setting", -36, 0 },
        { "plain", "plain_ns_per_bond", 8, 2 }, { "ns/bond", "ns_per_bond", 8, 2 }, { "ratio", "ratio", 7, 2 },
    };
    static const int32_t laws[] = { PERI_LAW_BOND_BASED, PERI_LAW_LPS, PERI_LAW_OTERKUS, PERI_LAW_CORRESPONDENCE };
    double worst = 0;
    int over = 0;
    table t;
    printf("\nCliffs: settings over the plain body of the law, 18^3 points, horizon of 3 spacings, one thread");
    table_open(&t, "out/cliffs.csv", columns, (int)(sizeof columns / sizeof columns[0]));
    for (int law = 0; law < 4; ++law)
        for (int path = 0; path < 3; ++path) {
            const best_path p = { laws[law], path == 1 ? PERI_PRECISION_SINGLE : PERI_PRECISION_DOUBLE, path == 2 };
            over += rows_of(run, &t, &p, &worst);
        }
    table_close(&t);
    printf("bar 3.00: setting over plain, worst %.2f, %d rows over\n", worst, over);
}
