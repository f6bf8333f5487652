/* SPDX-License-Identifier: MIT */
/* tradeoff_recipes.c - `tradeoff --recipes`: a few sets of knobs, and what each gives in every problem at every resolution: the table of
   src/advice/choose.c. Takes half an hour.

   State-based laws: the largest error over the Poisson ratios 0.1, 0.3 and 0.45 (branching, whose truth is bond-based: 1/3 alone), and the
   seconds and bytes of the slowest and the largest. Errors as measured, not guarded. */
#include "tradeoff.h"

typedef struct recipe {
    const char *name;
    int32_t     law, correction, influence, precision;
    double      m, stabilization; /* branching has its horizon given: m is the resolution                                */
} recipe;

static const recipe recipes[] = {
    { "bond_single", PERI_LAW_BOND_BASED, PERI_CORRECTION_NONE, PERI_INFLUENCE_CONSTANT, PERI_PRECISION_SINGLE, 3, -1 },
    { "bond", PERI_LAW_BOND_BASED, PERI_CORRECTION_NONE, PERI_INFLUENCE_CONSTANT, PERI_PRECISION_DOUBLE, 3, -1 },
    { "bond_moment", PERI_LAW_BOND_BASED, PERI_CORRECTION_MOMENT, PERI_INFLUENCE_LINEAR, PERI_PRECISION_DOUBLE, 2, -1 },
    { "lps_moment", PERI_LAW_LPS, PERI_CORRECTION_MOMENT, PERI_INFLUENCE_LINEAR, PERI_PRECISION_DOUBLE, 2, -1 },
    { "gradient_single", PERI_LAW_CORRESPONDENCE, PERI_CORRECTION_NONE, PERI_INFLUENCE_CONSTANT, PERI_PRECISION_SINGLE, 2, 0.2 },
    { "gradient", PERI_LAW_CORRESPONDENCE, PERI_CORRECTION_NONE, PERI_INFLUENCE_CONSTANT, PERI_PRECISION_DOUBLE, 2, 0.2 },
    { "gradient_steep", PERI_LAW_CORRESPONDENCE, PERI_CORRECTION_NONE, PERI_INFLUENCE_POWER_3, PERI_PRECISION_DOUBLE, 2, 0.2 }
};

static const double resolutions[] = { 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 0 };
static const double ratios[] = { 0.1, 0.3, 0.45 };
static const double LIMIT = 15; /* [s] expected of one run */

static void print_recipe(const recipe *r, const problem *p) {
    const double *across = p->run == run_branching ? p->across : resolutions;
    for (int a = 0; across[a] > 0; ++a) {
        outcome worst;
        char    series[200] = "";
        double  poisson = 0;
        const int known = r->law == PERI_LAW_BOND_BASED || p->run == run_branching;
        memset(&worst, 0, sizeof worst);
        worst.error = -1;
        for (int n = 0; n < (known ? 1 : 3) && worst.status == PERI_OK; ++n) {
            knobs k = knobs_of(p, r->law, p->ratio[0] > 0 ? r->m : across[a], across[a]);
            outcome o;
            k.correction = r->correction;
            k.influence = r->influence;
            k.precision = r->precision;
            k.stabilization = r->stabilization;
            if (!known) k.poisson = ratios[n];
            if (seconds_expected(p, &k) > LIMIT * (p->run == run_branching ? 10 : 1)) return;
            name_series(&k, p->moves, series, sizeof series);
            o = run_best(p, &k);
            if (o.error > worst.error) {
                worst.error = o.error;
                poisson = k.poisson;
            }
            worst.seconds = fmax(worst.seconds, o.seconds);
            if (o.bytes > worst.bytes) worst.bytes = o.bytes;
            worst.points = o.points;
            worst.bonds = o.bonds;
            worst.status = o.status;
            memcpy(worst.text, o.text, sizeof worst.text);
        }
        printf("%s,%s,%g,%.4g,%.4g,%lld,%lld,%lld,%.4g,\"%s\",\"%s\"\n", r->name, p->name, across[a], worst.error, worst.seconds,
               (long long)worst.bytes, (long long)worst.points, (long long)worst.bonds, poisson, series,
               worst.status == PERI_OK ? "ok" : worst.text);
        (void)fflush(stdout);
    }
}

int print_recipes(const char *only) {
    int found = 0;
    for (int i = 0; i < problem_count; ++i) {
        if (only && strcmp(only, problems[i].name) != 0) continue;
        found = 1;
        for (int r = 0; r < (int)(sizeof recipes / sizeof *recipes); ++r) print_recipe(&recipes[r], &problems[i]);
    }
    return found ? 0 : 1;
}
