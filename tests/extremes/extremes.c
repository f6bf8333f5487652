/* SPDX-License-Identifier: MIT */
/* extremes.c - plays every row of every table in double, mixed and single precision: see extremes.h.
     extremes WORD     only rows whose subject or name contains WORD
     extremes --long   longer runs where a scene has them
     extremes --some   a row in one precision, in turn, and of a scene with many rows every other one (make test)
   A row counts as one test per precision. */
#include "extremes.h"
#include <stdarg.h>

#ifndef LONGEST
#define LONGEST 10.0 /* [s] of a row in one precision, under sanitizers, too */
#endif

extreme_pool extreme_memory;
int extreme_long;

/* ---- memory ------------------------------------------------------------------------------------------------------- */

enum { POOL_HEAD = 32 }; /* before a block: its size, and what malloc gave */

static void *pool_allocate(void *user, uint64_t bytes) {
    extreme_pool *pool = (extreme_pool *)user;
    const size_t room = (size_t)bytes + POOL_HEAD + pool->offset;
    unsigned char *raw, *at;
    if (++pool->calls == pool->fail_at || bytes > SIZE_MAX / 2) return NULL;
    if (pool->limit && (bytes > (uint64_t)pool->limit || pool->bytes + (int64_t)bytes > pool->limit)) return NULL;
    raw = (unsigned char *)malloc(room);
    if (!raw) return NULL;
    memset(raw, 0xFF, room); /* NaN in every precision */
    at = raw + POOL_HEAD + pool->offset;
    memcpy(at - 8, &bytes, sizeof bytes);
    memcpy(at - 16, &raw, sizeof raw);
    pool->blocks++;
    pool->bytes += (int64_t)bytes;
    return at;
}

static void pool_release(void *user, void *pointer, uint64_t bytes) {
    extreme_pool *pool = (extreme_pool *)user;
    unsigned char *at = (unsigned char *)pointer, *raw;
    uint64_t size;
    if (!at) return;
    memcpy(&size, at - 8, sizeof size);
    memcpy(&raw, at - 16, sizeof raw);
    pool->wrong += size != bytes;
    pool->blocks--;
    pool->bytes -= (int64_t)size;
    memset(raw, 0xFF, (size_t)(at - raw) + (size_t)size);
    free(raw);
}

/* ---- what scenes share -------------------------------------------------------------------------------------------- */

void extreme_desc(peri_body_desc *desc, int32_t space, int32_t precision, double horizon) {
    peri_body_desc_init(desc);
    desc->space = space;
    desc->precision = precision;
    desc->horizon = horizon;
    desc->threads = 1;
    desc->allocate = pool_allocate;
    desc->release = pool_release;
    desc->memory_user = &extreme_memory;
}

void extreme_material(peri_material_desc *material, int32_t law, double poisson, double stretch) {
    peri_material_desc_init(material, law);
    material->young = 1;
    material->density = 1;
    if (law != PERI_LAW_BOND_BASED) material->poisson = poisson;
    material->critical_stretch = stretch;
}

peri_body *extreme_box(outcome *o, const peri_body_desc *desc, const peri_material_desc *material, const double *hi, double spacing) {
    const double lo[3] = {0, 0, 0};
    peri_body *b = NULL;
    if (extreme_fails(o, NULL, peri_body_create(desc, &b, NULL))) return NULL;
    if (!extreme_fails(o, b, peri_add_material(b, material)) && !extreme_fails(o, b, peri_add_box(b, material_id(b, 1), lo, hi, spacing)))
        (void)extreme_fails(o, b, peri_build(b));
    return b;
}

int extreme_fails(outcome *o, const peri_body *b, int64_t result) {
    peri_error record;
    if (result >= 0) return 0;
    if (o->status >= 0) {
        o->status = (int32_t)result;
        o->field = "";
        if (b && peri_get_error(b, &record) == PERI_OK && record.code == (int32_t)result && record.field) o->field = record.field;
    }
    return 1;
}

double extreme_worst(double a, double b) { return a >= b ? a : b >= a ? b : NAN; }

double extreme_roundoff(int32_t precision) { return precision == PERI_PRECISION_DOUBLE ? 0x1p-53 : 0x1p-24; }

void extreme_take(outcome *o, double error, const char *what, int a, int b, int c) {
    static char text[64];
    if (error <= o->error) return;
    o->error = extreme_worst(error, o->error);
    (void)sprintf(text, "%.40s %d %d %d", what, a % 1000, b % 1000, c % 1000);
    o->field = text;
}

void extreme_note(outcome *o, const extreme *row, int32_t precision, double error, const char *format, ...) {
    const double bound = row->bound[precision == PERI_PRECISION_DOUBLE ? 0 : precision == PERI_PRECISION_MIXED ? 1 : 2], before = o->error;
    o->error = extreme_worst(before, error);
    if (!(error <= bound) && !(error <= before)) {
        va_list arguments;
        va_start(arguments, format);
        printf("    %.1e: ", error);
        (void)vprintf(format, arguments);
        printf("\n");
        va_end(arguments);
    }
}

double *extreme_read(outcome *o, peri_body *b, int32_t field) {
    const int64_t n = peri_size_of_field(b, field);
    double *x = n < 0 ? NULL : (double *)malloc((size_t)n * sizeof *x + 1);
    if (n < 0) (void)extreme_fails(o, b, n);
    if (x && extreme_fails(o, b, peri_get_field(b, field, x, n))) {
        free(x);
        x = NULL;
    }
    return x;
}

void extreme_affine(outcome *o, peri_body *b, const double *gradient, const double *origin) {
    const int64_t n = peri_size_of_field(b, PERI_FIELD_POSITION);
    const int dim = peri_dimension(b);
    double *x = extreme_read(o, b, PERI_FIELD_POSITION), at[3];
    int64_t i;
    int k, l;
    for (i = 0; x && i < n; i += dim) {
        for (k = 0; k < dim; ++k) at[k] = x[i + k] - (origin ? origin[k] : 0.0);
        for (k = 0; k < dim; ++k) {
            x[i + k] = 0;
            for (l = 0; l < dim; ++l) x[i + k] += gradient[k * dim + l] * at[l];
        }
    }
    if (x) (void)extreme_fails(o, b, peri_set_field(b, PERI_FIELD_DISPLACEMENT, x, n));
    free(x);
}

int32_t extreme_slab(outcome *o, peri_body *b, int axis, double from, double to) {
    double lo[3] = {-1e6, -1e6, -1e6}, hi[3] = {1e6, 1e6, 1e6};
    int32_t set;
    lo[axis] = from;
    hi[axis] = to;
    set = peri_select_box(b, NULL, lo, hi);
    (void)extreme_fails(o, b, set);
    return set;
}

/* A field that cannot be had is named by its status, which is no wrong number. */
static int is_finite_field(peri_body *b, int32_t field) {
    const int64_t n = peri_size_of_field(b, field);
    double *x = n < 0 ? NULL : (double *)malloc((size_t)n * sizeof *x + 1);
    int good = 1;
    int64_t i;
    if (x && peri_get_field(b, field, x, n) == PERI_OK)
        for (i = 0; i < n; ++i) good &= x[i] - x[i] == 0.0;
    free(x);
    return good;
}

outcome extreme_end(outcome o, peri_body *b) {
    int32_t field;
    if (b && peri_family_width(b) > 0 && o.status != PERI_ERROR_UNSTABLE) {
        peri_energy e;
        double linear[3] = {0, 0, 0}, angular[3] = {0, 0, 0}, sum = 0;
        int good = 1, k;
        for (field = PERI_FIELD_POSITION; field < peri__end_field; ++field) good &= is_finite_field(b, field);
        if (peri_get_energy(b, &e) == PERI_OK)
            sum = e.kinetic + e.elastic + e.external + e.obstacle + e.damping + e.fracture + e.initial + e.error;
        if (peri_get_momentum(b, linear, angular) == PERI_OK)
            for (k = 0; k < 3; ++k) sum += linear[k] + angular[k];
        if (!good || sum - sum != 0.0) {
            o.status = NOT_FINITE;
            o.field = "";
        }
    }
    peri_body_destroy(b);
    return o;
}

/* ---- rows --------------------------------------------------------------------------------------------------------- */

static const char *status_name(int32_t status) {
    switch (status) {
    case NOT_FINITE: return "NOT FINITE";
    case SPOILED: return "SPOILED";
    default: return peri_status_text(status);
    }
}

/* Rows play in one precision, in turn. Those of a scene with three or more go round by themselves, and the turn moves on every three
   rows, for rows go by threes where laws, spaces or kernels do; the others by their place in the table. Of a scene with four rows or
   more every other one plays, with six or more every third. What takes longest plays where `longest` says. */
static int is_spared(const extreme_table *table, int at, int precision) {
    static const char *const longest[] = {"a reset after fracture", /* test_stale, test_states */
                                          "weights of clouds", "weights at 1 spacing", /* test_families, test_quadrature */
                                          "families above 1024",                       /* a hub of 1100 bonds */
                                          "each allocation fails once, multilevel, 3D", /* the same in 2D; test_memory */
                                          "units of 1e-240 to 1e240"};                 /* of 1e-300 to 1e300 */
    int row, rows = 0, before = 0;
    for (row = 0; row < (int)(sizeof longest / sizeof longest[0]); ++row)
        if (strcmp(table->rows[at].name, longest[row]) == 0) return 1;
    for (row = 0; row < table->count; ++row)
        if (table->rows[row].play == table->rows[at].play) {
            rows++;
            before += row < at;
        }
    if (rows >= 4) {
        const int every = rows >= 6 ? 3 : 2;
        return before % every || (before / every + before / every / 3) % 3 != precision;
    }
    return (rows == 3 ? before : at) % 3 != precision;
}

static void play(const extreme_table *table, int at, int some) {
    const char *const subject = table->subject;
    const extreme *const row = &table->rows[at];
    static const int32_t precisions[3] = {PERI_PRECISION_DOUBLE, PERI_PRECISION_MIXED, PERI_PRECISION_SINGLE};
    static const char *const names[3] = {"double", "mixed", "single"};
    char line[3][96];
    double spent = 0;
    int k, wrong = 0;
    for (k = 0; k < 3; ++k) {
        const clock_t start = clock();
        (void)strcpy(line[k], "-");
        if (some && is_spared(table, at, k)) continue;
        memset(&extreme_memory, 0, sizeof extreme_memory);
        const outcome o = row->play(row, precisions[k]);
        const double seconds = (double)(clock() - start) / (double)CLOCKS_PER_SEC;
        int good = o.status == row->status;
        spent += seconds;
        if (row->status >= 0) good &= o.error <= row->bound[k];
        if (row->status < 0 && row->field) good &= strcmp(o.field, row->field) == 0;
        good &= extreme_memory.blocks == 0 && extreme_memory.wrong == 0 && (seconds <= LONGEST || extreme_long);
        if (o.status >= 0) (void)snprintf(line[k], sizeof line[k], "%.1e", o.error);
        else (void)snprintf(line[k], sizeof line[k], "%s %s", status_name(o.status), o.field);
        if (good) test_passed++;
        else {
            test_failed++;
            wrong = 1;
            printf("  FAIL %s: %s, %s precision: got %s, expected %s %s", subject, row->name, names[k], line[k], status_name(row->status),
                   row->field ? row->field : "");
            if (row->status >= 0) printf("to %.1e", row->bound[k]);
            if (o.status >= 0 && o.field[0]) printf("; worst: %s", o.field);
            if (extreme_memory.blocks || extreme_memory.wrong) printf("; memory: %d left", (int)extreme_memory.blocks);
            if (seconds > LONGEST) printf("; %.1f s", seconds);
            printf("\n    truth: %s\n", row->truth);
        }
    }
    if (!wrong) printf("  pass %-12s %-58s %-14s %-14s %-14s %.2f s\n", subject, row->name, line[0], line[1], line[2], spent);
    (void)fflush(stdout);
}

int main(int argc, char **argv) {
    const extreme_table *const tables[] = {&extreme_units,    &extreme_elasticity, &extreme_tiny,    &extreme_motion, &extreme_stretches,
                                           &extreme_families, &extreme_damage,   &extreme_cracks,   &extreme_time,   &extreme_pairs,
                                           &extreme_statics,  &extreme_solids,     &extreme_trusses, &extreme_sizes,
                                           &extreme_callbacks, &extreme_allocation, &extreme_hooks, &extreme_rounding};
    const int some = argc > 1 && strcmp(argv[1], "--some") == 0;
    size_t t;
    int k;
    test_begin(argc, argv);
    extreme_long = test_long;
    for (t = 0; t < sizeof tables / sizeof tables[0]; ++t)
        for (k = 0; k < tables[t]->count; ++k) {
            const extreme *row = &tables[t]->rows[k];
            if (!test_filter || strstr(row->name, test_filter) || strstr(tables[t]->subject, test_filter)) play(tables[t], k, some);
        }
    return test_end("extremes");
}
