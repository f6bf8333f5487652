/* SPDX-License-Identifier: MIT */
/* tradeoff_table.c - the rows of one problem: which are run, what their neighbours say of them, which are on the fronts. */
#include "tradeoff.h"

enum { REPEATS = 3, CORRECTIONS = 10 };
static const double SHORT = 0.05;   /* [s] shorter runs are repeated, and the least time counts                          */
static const double COARSE = 0.2;   /* rows with larger errors are on no front                                           */
static const double LEAST = 1e-6;   /* smaller errors are as good as this                                                */
static const double STEP = 1.3;     /* from row to row of a front, where each is varied                                  */
static const double PER_BOND[5] = { 0, 1.5e-9, 2.5e-9, 3.5e-9, 4e-9 }; /* [s] about, by law                              */

static const int32_t laws[CORRECTIONS][2] = {
    { PERI_LAW_BOND_BASED, PERI_CORRECTION_NONE },     { PERI_LAW_BOND_BASED, PERI_CORRECTION_VOLUME },
    { PERI_LAW_BOND_BASED, PERI_CORRECTION_ENERGY }, { PERI_LAW_BOND_BASED, PERI_CORRECTION_MOMENT },
    { PERI_LAW_LPS, PERI_CORRECTION_NONE },            { PERI_LAW_LPS, PERI_CORRECTION_MOMENT },
    { PERI_LAW_OTERKUS, PERI_CORRECTION_NONE },        { PERI_LAW_OTERKUS, PERI_CORRECTION_MOMENT },
    { PERI_LAW_CORRESPONDENCE, PERI_CORRECTION_NONE }, { PERI_LAW_CORRESPONDENCE, PERI_CORRECTION_MOMENT }
};

static int same(double a, double b) { return fabs(a - b) < 1e-9 * (1 + fabs(a)); }

/* The horizon is given: its spacings are the resolution. */
static int tied(const problem *p) { return !(p->ratio[0] > 0); }

static int same_series(const problem *p, const knobs *a, const knobs *b) {
    return a->law == b->law && a->correction == b->correction && a->influence == b->influence && a->quadrature == b->quadrature &&
           a->precision == b->precision && a->geometry == b->geometry && a->integrator == b->integrator &&
           (tied(p) || same(a->m, b->m)) && same(a->poisson, b->poisson) &&
           same(a->stabilization, b->stabilization) && same(a->tolerance, b->tolerance) && same(a->safety, b->safety);
}

row *table_find(const table *t, const knobs *k) {
    for (int i = 0; i < t->count; ++i)
        if (same_series(t->p, &t->rows[i].k, k) && same(t->rows[i].k.across, k->across)) return &t->rows[i];
    return NULL;
}

double seconds_expected(const problem *p, const knobs *k) { return p->work(k) * PER_BOND[k->law % 100]; }

outcome run_best(const problem *p, const knobs *k) {
    outcome best = p->run(k);
    for (int n = 1; n < REPEATS && best.status == PERI_OK && best.seconds < SHORT; ++n) {
        const outcome again = p->run(k);
        best.seconds = fmin(best.seconds, again.seconds);
    }
    return best;
}

row *table_ask(table *t, const knobs *k, int stage, double limit) {
    row *r = table_find(t, k);
    double start = (double)clock() / CLOCKS_PER_SEC;
    if (r) return r;
    if (seconds_expected(t->p, k) > limit) return NULL;
    if (t->count == t->room) {
        t->room = 2 * t->room + 64;
        t->rows = (row *)realloc(t->rows, (size_t)t->room * sizeof *t->rows);
        if (!t->rows) exit(1);
    }
    r = &t->rows[t->count++];
    memset(r, 0, sizeof *r);
    r->k = *k;
    r->stage = stage;
    r->out = run_best(t->p, k);
    t->spent += (double)clock() / CLOCKS_PER_SEC - start;
    return r;
}

/* The resolution `by` places from that of k in the problem's list; 0: none. */
static double neighbour(const problem *p, const knobs *k, int by) {
    for (int i = 0; p->across[i] > 0; ++i)
        if (same(p->across[i], k->across)) return i + by < 0 ? 0 : p->across[i + by];
    return 0;
}

static knobs at_across(const problem *p, knobs k, double across) {
    if (tied(p)) k.m = across;
    k.across = across;
    return k;
}

/* A row and the next coarser one (of the coarsest: the next finer one), which guards it. */
static row *ask_guarded(table *t, const knobs *k, int stage, double limit) {
    const double coarser = neighbour(t->p, k, -1);
    const knobs other = at_across(t->p, *k, coarser > 0 ? coarser : neighbour(t->p, k, 1));
    (void)table_ask(t, &other, stage, limit);
    return table_ask(t, k, stage, limit);
}

/* ---- judging ------------------------------------------------------------------------------------------------------ */

/* Errors that pass through zero on their way from one resolution to the next are luck. So a row is taken for as wrong as the worst of its
   series at this resolution and finer ones, and no better than second order makes of the next coarser one. */
static void guard(const table *t, row *r) {
    const double coarser = neighbour(t->p, &r->k, -1);
    int others = 0;
    r->guarded = fmax(r->out.error, LEAST);
    for (int i = 0; i < t->count; ++i) {
        const row *o = &t->rows[i];
        const double ratio = o->k.across / r->k.across;
        const int finer = ratio > 1.001, next = same(o->k.across, coarser);
        if (!(finer || next) || o->out.status != PERI_OK || !same_series(t->p, &o->k, &r->k)) continue;
        r->guarded = fmax(r->guarded, o->out.error * (finer ? 1 : ratio * ratio));
        others++;
    }
    if (others == 0) r->guarded = HUGE_VAL;
}

static int compared(const table *t, const row *r) {
    return r->out.status == PERI_OK && (!(t->p->only > 0) || same(r->k.across, t->p->only));
}

/* Rows that no other row beats in both, error and seconds or bytes. */
static void front(table *t, int by_bytes) {
    for (int i = 0; i < t->count; ++i) {
        row *r = &t->rows[i];
        int on = compared(t, r) && r->guarded <= COARSE;
        for (int j = 0; on && j < t->count; ++j) {
            const row *o = &t->rows[j];
            const double cost = by_bytes ? (double)o->out.bytes : o->out.seconds, own = by_bytes ? (double)r->out.bytes : r->out.seconds;
            if (!compared(t, o) || j == i || !(o->guarded <= r->guarded && cost <= own)) continue;
            on = o->guarded >= r->guarded && cost >= own && j > i;
        }
        *(by_bytes ? &r->small : &r->fast) = on;
    }
}

void table_judge(table *t) {
    for (int i = 0; i < t->count; ++i)
        if (t->rows[i].out.status == PERI_OK) guard(t, &t->rows[i]);
    front(t, 0);
    front(t, 1);
}

/* ---- stages ------------------------------------------------------------------------------------------------------- */

static void main_grid(table *t) {
    const problem *p = t->p;
    static const int32_t shapes[] = { PERI_INFLUENCE_CONSTANT, PERI_INFLUENCE_LINEAR,   PERI_INFLUENCE_CUBIC,  PERI_INFLUENCE_POWER_2,
                                      PERI_INFLUENCE_POWER_3,  PERI_INFLUENCE_GAUSSIAN, PERI_INFLUENCE_INVERSE };
    int ratios = 0;
    while (p->ratio[ratios] > 0) ++ratios;
    for (int law = 0; law < CORRECTIONS; ++law)
        for (int m = 0; m < (tied(p) ? 1 : ratios); ++m)
            for (int a = 0; a < p->usual && p->across[a] > 0; ++a)
                for (int w = 0; w < (p->product ? 7 : 1); ++w)
                    for (int32_t q = PERI_QUADRATURE_FULL; q <= (p->product ? PERI_QUADRATURE_PARTIAL_MOMENT : PERI_QUADRATURE_FULL); ++q) {
                        knobs k = knobs_of(p, laws[law][0], tied(p) ? p->across[a] : p->ratio[m], p->across[a]);
                        k.correction = laws[law][1];
                        k.influence = shapes[w];
                        k.quadrature = q;
                        (void)table_ask(t, &k, 1, p->limit);
                    }
}

/* Values of one knob, by turns; 0: no more. Those that do nothing on this row are left out. */
static int vary(const problem *p, int knob, int choice, knobs *k) {
    static const int32_t shapes[] = { PERI_INFLUENCE_LINEAR,  PERI_INFLUENCE_CUBIC,    PERI_INFLUENCE_POWER_2,
                                      PERI_INFLUENCE_POWER_3, PERI_INFLUENCE_GAUSSIAN, PERI_INFLUENCE_INVERSE };
    static const double tolerances[] = { 1e-2, 1e-3, 1e-4, 1e-6, 1e-10 }, safeties[] = { 0.3, 0.5, 0.7, 1.0 };
    static const double stiff[] = { 0.1, 0.4, 0.8 };
    if (knob == 0 && choice < 2) k->precision = choice ? PERI_PRECISION_SINGLE : PERI_PRECISION_MIXED;
    else if (knob == 1 && choice < 6) k->influence = shapes[choice];
    else if (knob == 2 && choice < (k->space == PERI_SPACE_SOLID ? 2 : 4)) k->quadrature = PERI_QUADRATURE_RAMP + choice;
    else if (knob == 3 && choice < 1) k->geometry = p->moves ? PERI_GEOMETRY_LINEAR : PERI_GEOMETRY_NONLINEAR;
    else if (knob == 4 && choice < 3 && k->law == PERI_LAW_CORRESPONDENCE) k->stabilization = stiff[choice];
    else if (knob == 5 && choice < 5 && !p->moves && p->run != run_uniform) k->tolerance = tolerances[choice];
    else if (knob == 6 && choice < 4 && p->moves) k->safety = safeties[choice];
    else if (knob == 7 && choice < 1 && p->moves) k->integrator = PERI_INTEGRATOR_CENTRAL_DIFFERENCE;
    else return 0;
    return 1;
}
enum { KNOBS = 8 };

/* Rows on either front, each with errors a factor of `apart` below those of the one before; their knobs are copied because rows move. */
static int on_fronts(const table *t, double apart, knobs **k) {
    char *taken = (char *)calloc((size_t)t->count + 1, 1);
    int n = 0;
    *k = (knobs *)calloc((size_t)t->count + CORRECTIONS, sizeof **k);
    if (!*k || !taken) exit(1);
    for (int by_bytes = 0; by_bytes < 2; ++by_bytes)
        for (double below = HUGE_VAL;;) {
            int best = -1;
            for (int i = 0; i < t->count; ++i) {
                const row *r = &t->rows[i];
                if (!(by_bytes ? r->small : r->fast) || !(r->guarded < below)) continue;
                if (best < 0 || r->guarded > t->rows[best].guarded) best = i;
            }
            if (best < 0) break;
            below = t->rows[best].guarded / apart;
            if (!taken[best]) (*k)[n++] = t->rows[best].k;
            taken[best] = 1;
        }
    free(taken);
    return n;
}

/* Less is better, where errors fall as their cost rises. */
static double worth(const row *r) { return r->guarded * r->out.seconds * sqrt((double)r->out.bytes); }

/* Every row on a front with each other knob varied; then the best value of each knob that helped, all together and in all subsets. */
static void one_at_a_time(table *t, const knobs *base, int count) {
    for (int b = 0; b < count; ++b)
        for (int knob = 0; knob < KNOBS; ++knob)
            for (int choice = 0;; ++choice) {
                knobs k = base[b];
                if (!vary(t->p, knob, choice, &k)) break;
                (void)ask_guarded(t, &k, 2, t->p->limit);
            }
}

static void those_that_helped(table *t, const knobs *base, int count) {
    for (int b = 0; b < count; ++b) {
        const row *r = table_find(t, &base[b]);
        int best[KNOBS], helped = 0, list[KNOBS];
        double bar;
        if (!r) continue;
        for (int knob = 0; knob < KNOBS; ++knob) {
            bar = 0.9 * worth(r);
            best[knob] = -1;
            for (int choice = 0;; ++choice) {
                knobs k = base[b];
                const row *v;
                if (!vary(t->p, knob, choice, &k)) break;
                v = table_find(t, &k);
                if (!v || v->out.status != PERI_OK || !(worth(v) < bar)) continue;
                bar = worth(v);
                best[knob] = choice;
            }
            if (best[knob] >= 0) list[helped++] = knob;
        }
        for (int set = 1; set < 1 << helped; ++set) {
            knobs k = base[b];
            for (int n = 0; n < helped; ++n)
                if (set >> n & 1) (void)vary(t->p, list[n], best[list[n]], &k);
            (void)ask_guarded(t, &k, 3, t->p->limit);
        }
    }
}

/* The most accurate row of each law and correction: rows that are far from the fronts where they are coarse may be on them where fine. */
static int leaders(const table *t, knobs *k) {
    int n = 0;
    for (int law = 0; law < CORRECTIONS; ++law) {
        const row *best = NULL;
        for (int i = 0; i < t->count; ++i) {
            const row *r = &t->rows[i];
            if (r->k.law != laws[law][0] || r->k.correction != laws[law][1] || !compared(t, r)) continue;
            if (!best || r->guarded < best->guarded) best = r;
        }
        if (best && best->guarded < HUGE_VAL) k[n++] = best->k;
    }
    return n;
}

/* These and those on the fronts at all resolutions, until no new ones come there. */
static void whole_series(table *t) {
    for (int before = -1; before != t->count;) {
        knobs *base;
        int count = on_fronts(t, 1, &base);
        before = t->count;
        count += leaders(t, &base[count]);
        for (int b = 0; b < count; ++b)
            for (int a = 0; t->p->across[a] > 0; ++a) {
                const knobs k = at_across(t->p, base[b], t->p->across[a]);
                (void)table_ask(t, &k, 4, 4 * t->p->limit);
            }
        free(base);
        table_judge(t);
    }
}

void table_fill(table *t) {
    knobs *base;
    int count;
    main_grid(t);
    table_judge(t);
    count = on_fronts(t, STEP, &base);
    one_at_a_time(t, base, count);
    table_judge(t);
    those_that_helped(t, base, count);
    free(base);
    table_judge(t);
    whole_series(t);
}

/* ---- output ------------------------------------------------------------------------------------------------------- */

static const char *const law_name[] = { "", "bond-based", "LPS", "Oterkus", "correspondence" };
static const char *const correction_name[] = { "", "none", "volume", "energy", "moment" };
static const char *const quadrature_name[] = { "", "whole", "ramp", "partial", "centroid", "partial moment" };
static const char *const precision_name[] = { "", "double", "mixed", "single" };
static const char *const space_name[] = { "", "plane stress", "plane strain", "3D" };
static const char *const influence_name[] = { [PERI_INFLUENCE_CONSTANT % 100] = "constant", [PERI_INFLUENCE_LINEAR % 100] = "linear",
                                              [PERI_INFLUENCE_CUBIC % 100] = "cubic",       [PERI_INFLUENCE_POWER_2 % 100] = "power 2",
                                              [PERI_INFLUENCE_POWER_3 % 100] = "power 3",   [PERI_INFLUENCE_GAUSSIAN % 100] = "gaussian",
                                              [PERI_INFLUENCE_INVERSE % 100] = "inverse" };

void table_csv(const table *t, FILE *file) {
    for (int i = 0; i < t->count; ++i) {
        const row *r = &t->rows[i];
        const knobs *k = &r->k;
        const outcome *o = &r->out;
        fprintf(file, "%s,%s,%s,%s,%g,%g,%s,%s,%s,%s,", t->p->name, space_name[k->space % 100], law_name[k->law % 100],
                correction_name[k->correction % 100], k->m, k->across, influence_name[k->influence % 100],
                quadrature_name[k->quadrature % 100], precision_name[k->precision % 100],
                k->geometry == PERI_GEOMETRY_LINEAR ? "linear" : "nonlinear");
        if (k->law == PERI_LAW_CORRESPONDENCE) fprintf(file, "%g", k->stabilization < 0 ? 0.2 : k->stabilization);
        fprintf(file, ",");
        if (!t->p->moves && t->p->run != run_uniform) {
            if (k->tolerance > 0) fprintf(file, "%g", k->tolerance);
            else fprintf(file, "default");
        }
        fprintf(file, ",");
        const char *integrator = k->integrator == PERI_INTEGRATOR_VELOCITY_VERLET ? "Verlet" : "central difference";
        if (t->p->moves) fprintf(file, "%s,%g,", integrator, k->safety);
        else fprintf(file, ",,");
        fprintf(file, "%.6g,%lld,%lld,%lld,", k->poisson, (long long)o->points, (long long)o->bonds, (long long)o->bytes);
        if (o->status == PERI_OK) fprintf(file, "%.4g,%.4g,%.4g,", o->seconds, o->error, r->guarded);
        else fprintf(file, ",,,");
        fprintf(file, "%d,%d,%d,\"%s\"\n", r->stage, r->fast, r->small, o->status == PERI_OK ? "ok" : o->text);
    }
}

void name_series(const knobs *k, int32_t moves, char *text, size_t capacity) {
    const knobs usual = { k->space, k->law, PERI_CORRECTION_NONE, PERI_INFLUENCE_CONSTANT, PERI_QUADRATURE_FULL, PERI_PRECISION_DOUBLE,
                          moves ? PERI_GEOMETRY_NONLINEAR : PERI_GEOMETRY_LINEAR, PERI_INTEGRATOR_VELOCITY_VERLET,
                          k->m, k->across, k->poisson, -1, 0, 0.9 };
    int n = snprintf(text, capacity, "%s, m = %g", law_name[k->law % 100], k->m);
#define ADD(...) do { if (n >= 0 && (size_t)n < capacity) n += snprintf(text + n, capacity - (size_t)n, __VA_ARGS__); } while (0)
    if (k->correction != usual.correction) ADD(", %s correction", correction_name[k->correction % 100]);
    if (k->influence != usual.influence) ADD(", %s", influence_name[k->influence % 100]);
    if (k->quadrature != usual.quadrature) ADD(", %s volumes", quadrature_name[k->quadrature % 100]);
    if (k->precision != usual.precision) ADD(", %s", precision_name[k->precision % 100]);
    if (k->geometry != usual.geometry) ADD(", %s geometry", k->geometry == PERI_GEOMETRY_LINEAR ? "linear" : "nonlinear");
    if (k->stabilization >= 0) ADD(", stabilization %g", k->stabilization);
    if (k->tolerance > 0) ADD(", tolerance %g", k->tolerance);
    if (!same(k->safety, usual.safety)) ADD(", safety %g", k->safety);
    if (k->integrator != usual.integrator) ADD(", central difference");
#undef ADD
}

/* For each level of error the fastest and the smallest row that stays below it; where there is none, the best that there is. */
void table_choices(const table *t, FILE *file) {
    static const double levels[] = { 0.05, 0.01, 0.001 };
    fprintf(file, "### %s\n\nError: %s. Across: %s.\n\n", t->p->title, t->p->truth, t->p->feature);
    fprintf(file, "| for | least | take | across | s | MB | error |\n|---|---|---|---|---|---|---|\n");
    for (int level = 0; level < 3; ++level)
        for (int by_bytes = 0; by_bytes < 2; ++by_bytes) {
            const row *best = NULL, *closest = NULL;
            char name[200];
            for (int i = 0; i < t->count; ++i) {
                const row *r = &t->rows[i];
                if (!compared(t, r)) continue;
                if (!closest || r->guarded < closest->guarded) closest = r;
                if (r->guarded > levels[level]) continue;
                if (!best || (by_bytes ? r->out.bytes < best->out.bytes : r->out.seconds < best->out.seconds)) best = r;
            }
            if (!best && (by_bytes || !closest)) continue;
            name_series(best ? &best->k : &closest->k, t->p->moves, name, sizeof name);
            fprintf(file, "| %g %% | %s | %s | %g | %.3g | %.3g | %.2g %% |\n", 100 * levels[level],
                    !best ? "not reached; best" : by_bytes ? "memory" : "time", name, (best ? best : closest)->k.across,
                    (best ? best : closest)->out.seconds, 1e-6 * (double)(best ? best : closest)->out.bytes,
                    100 * (best ? best : closest)->guarded);
        }
    fprintf(file, "\n");
}
