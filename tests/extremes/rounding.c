/* SPDX-License-Identifier: MIT */
/* rounding.c - whole lives of bodies while the machine rounds up, down or toward zero, or takes denormal numbers for zero. Each operation
   is then off by one unit in its last place where it was by half of one, so answers are those of rounding to nearest within a multiple of
   the unit roundoff; what is counted stays as it is. */
#include "scenes.h"
#include <fenv.h>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

enum { NEAREST, UPWARD, DOWNWARD, ZEROWARD, FLUSHED };

/* A mode that the machine lacks is left as it is. */
static void set_mode(int mode) {
    int way = FE_TONEAREST;
#ifdef FE_UPWARD
    if (mode == UPWARD) way = FE_UPWARD;
#endif
#ifdef FE_DOWNWARD
    if (mode == DOWNWARD) way = FE_DOWNWARD;
#endif
#ifdef FE_TOWARDZERO
    if (mode == ZEROWARD) way = FE_TOWARDZERO;
#endif
#if defined(__SSE2__)
    _mm_setcsr((_mm_getcsr() & ~0x8040u) | (mode == FLUSHED ? 0x8040u : 0)); /* flush to zero, denormals are zero */
#endif
    (void)fesetround(way);
}

typedef struct trace { /* what a life came to                                                                             */
    uint64_t counted;
    double  *number; /* fields one after the other, each over its largest entry                                           */
    int64_t  count, room;
} trace;

static void note_field(trace *t, outcome *o, peri_body *b, int32_t field) {
    const int64_t n = peri_size_of_field(b, field);
    double *x = extreme_read(o, b, field), largest = 0;
    if (!x) return;
    if (t->count + n > t->room) {
        t->room = 2 * (t->count + n);
        t->number = (double *)realloc(t->number, (size_t)t->room * sizeof *t->number);
    }
    for (int64_t i = 0; i < n; ++i) largest = fmax(largest, fabs(x[i]));
    for (int64_t i = 0; i < n; ++i) t->number[t->count++] = largest > 0 ? x[i] / largest : 0;
    free(x);
}

/* The larger of the differences of numbers; spoiled where counts differ. Frees both. */
static double compare(outcome *o, trace *a, trace *b) {
    double most = 0;
    if (o->status >= 0 && (a->counted != b->counted || a->count != b->count)) *o = scene_spoiled(*o, "what is counted");
    else
        for (int64_t i = 0; o->status >= 0 && i < a->count; ++i) most = extreme_worst(most, fabs(a->number[i] - b->number[i]));
    free(a->number);
    free(b->number);
    return most;
}

static void count_in(trace *t, int64_t number) { (void)scene_swallow(&t->counted, &number, (int64_t)sizeof number); }

/* Families, sets and cuts of a body; both ends of each bond must agree about it. */
static void note_bonds(trace *t, outcome *o, peri_body *b) {
    const int64_t n = peri_point_count(b), width = peri_family_width(b);
    int32_t *rows = (int32_t *)malloc((size_t)(n * width) * sizeof *rows);
    (void)extreme_fails(o, b, peri_get_families(b, 0, n, rows, n * width));
    (void)scene_swallow(&t->counted, rows, n * width * (int64_t)sizeof *rows);
    for (int64_t k = 0; k < n * width; ++k) {
        const int32_t i = (int32_t)(k / width), j = rows[k];
        if (i == j) continue;
        count_in(t, peri_bond_is_intact(b, i, j));
        if (peri_bond_is_intact(b, i, j) != peri_bond_is_intact(b, j, i)) *o = scene_spoiled(*o, "a bond broken at one end");
    }
    free(rows);
    count_in(t, peri_cut_count(b));
    count_in(t, peri_broken_count(b));
}

/* A lattice or a cloud of a law, 2D or 3D, by a quadrature. */
static peri_body *body_of(outcome *o, int32_t law, int32_t precision, int32_t rule, int32_t correction, int solid, int cloud, double s0) {
    const double lo[3] = {0, 0, 0}, hi[3] = {8, 5, 3};
    peri_body_desc d;
    peri_material_desc m;
    peri_body *b = NULL;
    extreme_desc(&d, solid ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRESS, precision, 2.2);
    d.quadrature = rule;
    d.correction = correction;
    extreme_material(&m, law, 0.2, s0);
    if (!cloud) return extreme_box(o, &d, &m, hi, 1);
    if (extreme_fails(o, NULL, peri_body_create(&d, &b, NULL)) || extreme_fails(o, b, peri_add_material(b, &m)) ||
        extreme_fails(o, b, peri_add_perturbed_box(b, material_id(b, 1), lo, hi, 1, 0.8, 5)))
        return b;
    (void)extreme_fails(o, b, peri_build(b));
    return b;
}

/* Families, weights, cuts and fields under an even strain, of every law, quadrature and correction. */
static outcome strained(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    const double pull[9] = {1.1e-2, 4e-3, 0, 0, -2e-2, 0, 1e-3, 0, 5e-3}, flat[4] = {1.1e-2, 4e-3, 0, -2e-2};
    const double from[2] = {5, -1}, to[2] = {5, 3}, corner[3] = {5, -1, -1}, up[3] = {0, 4, 0}, along[3] = {0, 0, 9}, lo[3] = {2, 2, 0};
    const double hi[3] = {5.5, 5.5, 4};
    for (int k = 0; k < 32; ++k) {
        trace t[2];
        const int solid = k / 4 % 2, cloud = k / 8 % 2, fine = k / 16;
        if (fine && solid && (k % 4 != 1 || !cloud)) continue; /* one law: exact parts in 3D take their time */
        memset(t, 0, sizeof t);
        for (int odd = 0; odd < 2 && o.status >= 0; ++odd) {
            set_mode(odd ? row->choice : NEAREST);
            peri_body *b = body_of(&o, scene_laws[k % 4], precision, fine ? PERI_QUADRATURE_PARTIAL : PERI_QUADRATURE_FULL,
                                   fine && !cloud ? PERI_CORRECTION_MOMENT : PERI_CORRECTION_NONE, solid, cloud, 0);
            if (o.status >= 0) {
                count_in(&t[odd], solid ? peri_cut_rectangle(b, PERI_CUT_INITIAL, corner, up, along)
                         : peri_cut_segment(b, PERI_CUT_INITIAL, from, to));
                count_in(&t[odd], peri_size_of_set(b, peri_select_box(b, NULL, lo, hi)));
                count_in(&t[odd], peri_size_of_set(b, peri_select_ball(b, NULL, hi, 3)));
                note_bonds(&t[odd], &o, b);
                extreme_affine(&o, b, solid ? pull : flat, NULL);
                for (int32_t field = PERI_FIELD_VOLUME; field <= PERI_FIELD_FORCE_STRESS; ++field)
                    /* of damage, parts of cells are kept to 6e-8 */
                    if (!fine || (field != PERI_FIELD_DAMAGE && field != PERI_FIELD_DAMAGE_GROWN))
                        note_field(&t[odd], &o, b, field);
                note_field(&t[odd], &o, b, PERI_FIELD_FORCE_DENSITY);
            }
            o = extreme_end(o, b);
            set_mode(NEAREST);
        }
        o.error = extreme_worst(o.error, compare(&o, &t[0], &t[1]));
    }
    return o;
}

/* A bar whose halves part at a speed that breaks bonds by far: what breaks, and where all goes. Momentum stays that of the start. */
static outcome torn(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    const double half[3] = {5, 99, 99}, zero[3] = {-9, -9, -9};
    for (int k = 0; k < 16; ++k) {
        trace t[2];
        memset(t, 0, sizeof t);
        for (int odd = 0; odd < 2 && o.status >= 0; ++odd) {
            const double apart[3] = {-0.5, 0.03, 0};
            double start[3] = {0, 0, 0}, end[3] = {0, 0, 0};
            peri_energy e;
            peri_advance_desc run;
            set_mode(odd ? row->choice : NEAREST);
            peri_body *b = body_of(&o, scene_laws[k % 4], precision, PERI_QUADRATURE_FULL, PERI_CORRECTION_NONE, k / 4 % 2, k / 8, 0.1);
            if (o.status >= 0) {
                (void)extreme_fails(&o, b, peri_add_velocity(b, peri_select_box(b, NULL, zero, half), apart));
                (void)extreme_fails(&o, b, peri_get_momentum(b, start, NULL));
                peri_advance_desc_init(&run);
                run.steps = 12;
                run.time_step = 0.1;
                (void)extreme_fails(&o, b, peri_advance(b, &run));
                note_bonds(&t[odd], &o, b);
                HOLDS(peri_broken_count(b) > 10);
                note_field(&t[odd], &o, b, PERI_FIELD_DISPLACEMENT);
                (void)extreme_fails(&o, b, peri_get_momentum(b, end, NULL));
                (void)extreme_fails(&o, b, peri_get_energy(b, &e));
                for (int d = 0; d < 3; ++d) o.error = extreme_worst(o.error, fabs(end[d] - start[d]) / fabs(start[0]));
                HOLDS(fabs(e.error) < 0.05 * e.initial);
            }
            o = extreme_end(o, b);
            set_mode(NEAREST);
        }
        o.error = extreme_worst(o.error, compare(&o, &t[0], &t[1]));
    }
    return o;
}

/* Equilibria by each method, from a support and a load. */
static outcome solved(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    for (int k = 0; k < 4 * 5; ++k) {
        trace t[2];
        if (k / 4 && k / 4 != 1 + k % 4) continue; /* multilevel with each law, each other way with one */
        memset(t, 0, sizeof t);
        for (int odd = 0; odd < 2 && o.status >= 0; ++odd) {
            peri_solve_desc s;
            set_mode(odd ? row->choice : NEAREST);
            peri_body *b = scene_plate(&o, scene_laws[k % 4], precision, PERI_SPACE_PLANE_STRAIN);
            peri_solve_desc_init(&s);
            s.method = k / 4 < 3 ? PERI_METHOD_NEWTON : k / 4 == 3 ? PERI_METHOD_BICGSTAB : PERI_METHOD_RELAXATION;
            s.preconditioner = k / 4 < 3 ? PERI_PRECONDITIONER_MULTILEVEL + k / 4 : PERI_PRECONDITIONER_MULTILEVEL;
            s.fracture = 0;
            s.tolerance = precision == PERI_PRECISION_DOUBLE ? 1e-9 : precision == PERI_PRECISION_MIXED ? 1e-5 : 2e-3;
            (void)extreme_fails(&o, b, peri_solve(b, &s, NULL));
            note_field(&t[odd], &o, b, PERI_FIELD_DISPLACEMENT);
            o = extreme_end(o, b);
            set_mode(NEAREST);
        }
        o.error = extreme_worst(o.error, compare(&o, &t[0], &t[1]));
    }
    return o;
}

static int32_t keep_text(void *user, const void *bytes, int64_t count) {
    char *text = (char *)user;
    const size_t used = strlen(text);
    if (used + (size_t)count > 999) return 1;
    memcpy(text + used, bytes, (size_t)count);
    return 0;
}

/* Numbers of the history as text, read back, against those of the ledger; and a plan of the same body. */
static outcome told(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    const double pull[4] = {1.1e-2, 4e-3, 0, -2e-2};
    int64_t bytes[2] = {0, 0};
    for (int k = 0; k < 8; ++k) {
        const int mode = k / 4 ? row->choice : NEAREST;
        char text[1000] = "", *at = text;
        peri_energy e;
        peri_body_desc d;
        peri_material_desc m;
        peri_plan_desc plan;
        peri_plan_report report;
        set_mode(mode);
        peri_body *b = body_of(&o, scene_laws[k % 4], precision, PERI_QUADRATURE_FULL, PERI_CORRECTION_NONE, 0, 0, 0);
        if (o.status >= 0) {
            extreme_affine(&o, b, pull, NULL);
            (void)extreme_fails(&o, b, peri_get_energy(b, &e));
            (void)extreme_fails(&o, b, peri_export_history_to(b, 0, keep_text, text));
            extreme_desc(&d, PERI_SPACE_PLANE_STRESS, precision, 2.2);
            extreme_material(&m, scene_laws[k % 4], 0.2, 0);
            peri_plan_desc_init(&plan);
            plan.body = &d;
            plan.material = &m;
            plan.spacing = 1;
            plan.hi[0] = 8;
            plan.hi[1] = 5;
            (void)extreme_fails(&o, NULL, peri_plan(&plan, &report, NULL));
            HOLDS(report.points == 40 && report.entries == peri_entry_count(b) && report.width == peri_family_width(b));
            bytes[k / 4] += report.bytes;
        }
        set_mode(NEAREST);
        HOLDS(strtol(at, &at, 10) == 0 && strtod(at + 1, &at) == 0);
        for (int n = 0; o.status >= 0 && n < 9; ++n) {
            const double value = (&e.kinetic)[n], read = strtod(at + 1, &at);
            o.error = extreme_worst(o.error, fabs(read - value) / fmax(fabs(value), 1e-30));
        }
        HOLDS(strcmp(at, ",0,0\n") == 0);
        o = extreme_end(o, b);
    }
    HOLDS(bytes[0] == bytes[1]);
    return o;
}

static const char *const fields = "the same body in rounding to nearest; families, sets and cuts alike, fields to some roundings";
static const char *const motion = "the same, after 12 steps, bonds broken alike and at both ends; momentum is conserved";
static const char *const rest = "the equilibrium is one, whatever the way to it: differences are those of the residual that is allowed";
static const char *const words = "peri.h, base.c: 16 digits, right to a few units of the last; a plan counts what is built";

/* strained: 40 bonds by 20 operations of 2u, where stresses cancel over a tenth of the largest entry: 8e3 u. Single: over the strain of
   2e-2, too. torn: 12 steps of them. solved: the tolerance times a condition number of 1e3 of the plate, in residuals over loads. */
#define OF_FIELDS {1e-12, 1e-3, 5e-2}
#define OF_MOTION {1e-11, 1e-3, 1e-2}
#define OF_REST {1e-6, 1e-2, 5e-1}
#define OF_WORDS {2e-15, 2e-15, 2e-15}
static const extreme rows[] = {
    {"fields, rounding up", fields, strained, 0, 0, UPWARD, PERI_OK, NULL, OF_FIELDS},
    {"fields, rounding down", fields, strained, 0, 0, DOWNWARD, PERI_OK, NULL, OF_FIELDS},
    {"fields, rounding toward zero", fields, strained, 0, 0, ZEROWARD, PERI_OK, NULL, OF_FIELDS},
    {"fields, denormals flushed", fields, strained, 0, 0, FLUSHED, PERI_OK, NULL, OF_FIELDS},
    {"motion and fracture, rounding up", motion, torn, 0, 0, UPWARD, PERI_OK, NULL, OF_MOTION},
    {"motion and fracture, rounding down", motion, torn, 0, 0, DOWNWARD, PERI_OK, NULL, OF_MOTION},
    {"motion and fracture, rounding toward zero", motion, torn, 0, 0, ZEROWARD, PERI_OK, NULL, OF_MOTION},
    {"motion and fracture, denormals flushed", motion, torn, 0, 0, FLUSHED, PERI_OK, NULL, OF_MOTION},
    {"equilibria, rounding up", rest, solved, 0, 0, UPWARD, PERI_OK, NULL, OF_REST},
    {"equilibria, rounding down", rest, solved, 0, 0, DOWNWARD, PERI_OK, NULL, OF_REST},
    {"equilibria, rounding toward zero", rest, solved, 0, 0, ZEROWARD, PERI_OK, NULL, OF_REST},
    {"equilibria, denormals flushed", rest, solved, 0, 0, FLUSHED, PERI_OK, NULL, OF_REST},
    {"numbers as text and plans, rounding up", words, told, 0, 0, UPWARD, PERI_OK, NULL, OF_WORDS},
    {"numbers as text and plans, rounding down", words, told, 0, 0, DOWNWARD, PERI_OK, NULL, OF_WORDS},
    {"numbers as text and plans, rounding toward zero", words, told, 0, 0, ZEROWARD, PERI_OK, NULL, OF_WORDS},
    {"numbers as text and plans, denormals flushed", words, told, 0, 0, FLUSHED, PERI_OK, NULL, OF_WORDS},
};
const extreme_table extreme_rounding = EXTREME_TABLE("rounding", rows);
