/* SPDX-License-Identifier: MIT */
/* test_memory.c - the allocator that fails, at every one of the allocations of a whole small life of a body; the allocator that
   returns unaligned dirty memory; NULL in every argument.

   SOURCE OF TRUTH: peri.h: "PERI_ERROR_MEMORY: the allocator returned NULL", "a call that fails has changed nothing", "release
   gets the size that allocate was asked for", "any alignment will do". A call that failed is made again at once and the life
   goes on: it must end in the same bits as the life in which nothing failed. Every block carries its size, so that leaks,
   double releases and wrong sizes are counted here, without a sanitizer (and are seen by one, too). */
#include "peri_test.h"

/* ---- the allocator ------------------------------------------------------------------------------------------------ */

typedef struct pool {
    int64_t  blocks, bytes; /* live */
    int64_t  calls, fail_at; /* fail call number fail_at (from 0); -1 = never */
    unsigned offset;         /* of the pointers from malloc's */
    int      wrong;
} pool;

static const uint64_t mark = UINT64_C(0x5EED0F5EED0F5EED);

static void *pool_allocate(void *user, uint64_t bytes) {
    pool *p = (pool *)user;
    unsigned char *raw;
    if (p->calls++ == p->fail_at) return NULL;
    raw = (unsigned char *)malloc((size_t)bytes + 16 + p->offset);
    if (!raw) return NULL;
    memset(raw, 0xAA, (size_t)bytes + 16 + p->offset);
    memcpy(raw + p->offset, &bytes, 8);
    memcpy(raw + p->offset + 8, &mark, 8);
    p->blocks++;
    p->bytes += (int64_t)bytes;
    return raw + p->offset + 16;
}
static void pool_release(void *user, void *pointer, uint64_t bytes) {
    pool *p = (pool *)user;
    unsigned char *at = (unsigned char *)pointer - 16;
    uint64_t size, seal;
    if (!pointer) return;
    memcpy(&size, at, 8);
    memcpy(&seal, at + 8, 8);
    if (size != bytes || seal != mark) p->wrong++;
    p->blocks--;
    p->bytes -= (int64_t)bytes;
    memset(at, 0x55, (size_t)size + 16);
    free(at - p->offset);
}

/* ---- a life, in steps --------------------------------------------------------------------------------------------- */

#define TEXT_MAX 200000
typedef struct life {
    int        dim, precision;
    pool      *memory;
    peri_body *body, *copy;
    int32_t    a, b, set, support, load, seen_breaks;
    int        met; /* a failure was met, and dealt with, in a frame */
    char      *text; /* what the writers wrote, one after the other */
    int64_t    length;
    double     sum; /* of all that was looked at on the way */
} life;

static int32_t keep(void *user, const void *bytes, int64_t count) {
    life *l = (life *)user;
    if (l->length + count > TEXT_MAX) return 1;
    memcpy(l->text + l->length, bytes, (size_t)count);
    l->length += count;
    return 0;
}
static int32_t inner(void *user, int64_t index, const double *x) {
    (void)user;
    (void)index;
    return x[0] > 0.25;
}
static int32_t long_pairs(void *user, int32_t i, int32_t j, const double *xi, const double *xj) {
    (void)user;
    return i % 7 == 0 && j % 5 == 0 && fabs(xi[0] - xj[0]) > 0.15;
}
static int32_t lift(void *user, double time, int64_t count, const int32_t *points, double *value) {
    int64_t i;
    (void)points;
    for (i = 0; i < count; ++i) value[i * *(const int *)user] *= 1 + time;
    return 0;
}
static int32_t count_break(void *user, int32_t i, int32_t j, double time, double stretch) {
    (void)i, (void)j, (void)time, (void)stretch;
    ++*(int32_t *)user;
    return 0;
}
static int32_t look(void *user, peri_body *b) { /* a frame that takes memory itself */
    life *l = (life *)user;
    peri_view v;
    int32_t r = peri_view_field(b, PERI_FIELD_DAMAGE_GROWN, &v);
    if (r == PERI_ERROR_MEMORY) { /* the run itself goes on */
        l->met = 1;
        r = peri_view_field(b, PERI_FIELD_DAMAGE_GROWN, &v);
    }
    return r == PERI_OK ? 0 : 1;
}
static int32_t advance(life *l, peri_body *b, int64_t steps, int frames) {
    peri_advance_desc r;
    peri_advance_desc_init(&r);
    r.steps = steps;
    r.damping = 0.1;
    r.frame_steps = 7;
    r.on_frame = frames ? look : NULL;
    r.user = l;
    return peri_advance(b, &r);
}
static int64_t add_material(life *l, double young, double stretch) {
    peri_material_desc m;
    peri_material_desc_init(&m, PERI_LAW_BOND_BASED);
    m.young = young;
    m.density = 2;
    m.critical_stretch = stretch;
    return peri_add_material(l->body, &m);
}
static int64_t create(life *l) {
    peri_body_desc d;
    peri_body_desc_init(&d);
    d.space = l->dim == 2 ? PERI_SPACE_PLANE_STRAIN : PERI_SPACE_SOLID;
    d.precision = l->precision;
    d.quadrature = l->precision == PERI_PRECISION_DOUBLE ? PERI_QUADRATURE_PARTIAL : PERI_QUADRATURE_FULL;
    d.horizon = 0.25;
    d.threads = 1; /* a small body, some hundred lives */
    d.allocate = pool_allocate;
    d.release = pool_release;
    d.memory_user = l->memory;
    return peri_body_create(&d, &l->body, NULL);
}
static int64_t all_views(life *l) {
    int32_t f, r;
    for (f = PERI_FIELD_POSITION; f < peri__end_field; ++f) {
        peri_view v;
        r = peri_view_field(l->body, f, &v);
        if (r != PERI_OK) return r;
    }
    return PERI_OK;
}
static int64_t readings(life *l) {
    double p[3], q[3], f[3] = {0, 0, 0}, *x;
    peri_energy e;
    int32_t r, field;
    double sum = 0;
    if ((r = peri_get_energy(l->body, &e)) < 0) return r;
    if ((r = peri_get_momentum(l->body, p, q)) < 0) return r;
    if ((r = peri_get_reaction(l->body, l->support, f)) < 0) return r;
    for (field = PERI_FIELD_POSITION; field < peri__end_field; ++field) {
        int64_t n = peri_size_of_field(l->body, field), i;
        x = (double *)calloc((size_t)n, sizeof *x);
        r = peri_get_field(l->body, field, x, n);
        for (i = 0; r >= 0 && i < n; ++i) sum += x[i] * (double)(i % 17);
        free(x);
        if (r < 0) return r;
    }
    l->sum += sum + e.kinetic + e.elastic + e.external + e.obstacle + e.damping + p[0] + q[0] + f[0];
    return PERI_OK;
}
static int64_t families(life *l) {
    int64_t n = peri_point_count(l->body), k;
    int32_t w = peri_family_width(l->body), *rows = (int32_t *)calloc((size_t)(n * w), sizeof *rows);
    int32_t r = peri_get_families(l->body, 0, n, rows, n * w);
    for (k = 0; r >= 0 && k < n * w; ++k) l->sum += rows[k] * 1e-3;
    free(rows);
    return r;
}

#define LIFE_STEPS 34
static int64_t live(life *l, int step) {
    const double lo[3] = {0, 0, 0}, hi[3] = {0.8, 0.5, 0.4}, edge[3] = {0.1, 1, 1}, far[3] = {0.75, -1, -1}, top[3] = {1, 1, 1};
    const double a[3] = {0.4, 0, 0}, z[3] = {0.4, 0.27, 0}, n[3] = {1, 0, 0}, v[3] = {0.3, 0.02, 0.01}, up[3] = {0, 1, 0};
    const double extra[6] = {0.85, 0.05, 0.05, 0.95, 0.05, 0.05}, flat[4] = {0.85, 0.05, 0.95, 0.05}, vol[2] = {1e-3, 1e-3};
    const int32_t picked[3] = {3, 9, 5}, pair[2] = {0, 1}, mats[2] = {l->b, l->a};
    peri_material_desc m;
    switch (step) {
    case 0: return create(l);
    case 1: return l->a = (int32_t)add_material(l, 3, 0.02);
    case 2: return l->b = (int32_t)add_material(l, 5, 0.03);
    case 3:
        peri_material_desc_init(&m, PERI_LAW_BOND_BASED);
        m.young = 4;
        m.density = 1;
        m.critical_stretch = 0.025;
        return peri_set_interface(l->body, l->a, l->b, &m);
    case 4:
        if (l->dim == 2) return peri_add_perturbed_box(l->body, l->a, lo, hi, 0.1, 0.7, 3);
        return peri_add_box(l->body, l->a, lo, hi, 0.1);
    case 5: return peri_add_points(l->body, 2, l->dim == 2 ? flat : extra, vol, mats);
    case 6: return peri_build(l->body);
    case 7: return l->set = peri_select_box(l->body, "left", lo, edge);
    case 8: return peri_select_ball(l->body, "middle", a, 0.21);
    case 9: return peri_select_if(l->body, NULL, inner, NULL);
    case 10: return peri_select_points(l->body, "some", 3, picked);
    case 11: return peri_cut_pairs(l->body, PERI_CUT_INITIAL, 1, pair);
    case 12: return l->dim == 2 ? peri_cut_segment(l->body, PERI_CUT_INITIAL, a, z) : peri_cut_disc(l->body, PERI_CUT_INITIAL, a, n, 0.22);
    case 13: return peri_cut_if(l->body, PERI_CUT_INITIAL, long_pairs, NULL);
    case 14: return peri_set_no_fail(l->body, l->set, 1);
    case 15: return peri_on_break(l->body, count_break, &l->seen_breaks);
    case 16: return peri_add_velocity(l->body, peri_id(l->body, PERI_KIND_SET, 3), v);
    case 17: return l->support = peri_prescribe_displacement(l->body, l->set, PERI_AXIS_X | PERI_AXIS_Y, NULL, NULL, NULL);
    case 18: return l->load = peri_apply_layer_traction(l->body, peri_find_set(l->body, "middle"), 0.2, v, lift, &l->dim);
    case 19: return peri_apply_body_force(l->body, PERI_ALL, v, NULL, NULL);
    case 20: return plane_obstacle(l->body, lo, up, 0, NULL, NULL);
    case 21: return ball_obstacle(l->body, far, l->dim == 2 ? 1.07 : 1.5, 0, NULL, NULL);
    case 22: return advance(l, l->body, 20, 0);
    case 23: return readings(l);
    case 24: return all_views(l);
    case 25: return peri_export_vtu_to(l->body, keep, l);
    case 26: return peri_export_history_to(l->body, 1, keep, l);
    case 27: return families(l);
    case 28: return peri_body_clone(l->body, &l->copy, NULL);
    case 29: return l->dim == 2 ? peri_cut_segment(l->body, PERI_CUT_NOW, z, top) : peri_cut_triangle(l->body, PERI_CUT_NOW, z, top, far);
    case 30: return advance(l, l->copy, 15, 1);
    case 31: return advance(l, l->body, 8, 0);
    case 32: return peri_reset(l->body);
    case 33: return advance(l, l->body, 10, 0);
    default: return PERI_OK;
    }
}

/* One life with failure at allocation number fail_at; returns the allocations that it made. The final state to *end. */
static int64_t whole_life(life *l, pool *p) {
    int step;
    l->memory = p;
    l->text = (char *)calloc(1, TEXT_MAX);
    for (step = 0; step < LIFE_STEPS; ++step) {
        int64_t before = p->calls, keep_length = l->length, r = live(l, step);
        double sum = l->sum;
        int hit = p->fail_at >= before && p->fail_at < p->calls;
        if (l->met) hit = 0;
        if (hit && r != PERI_ERROR_MEMORY) {
            test_bad++;
            printf("    allocation %d failed in step %d, which returned %d\n", (int)p->fail_at, step, (int)r);
        }
        if (hit) {
            peri_error e;
            if (step == 0) CHECK(l->body == NULL);
            if (step == 28) CHECK(l->copy == NULL);
            if (step != 28) CHECK(step == 0 || (peri_get_error(l->body, &e) == PERI_OK && e.code == PERI_ERROR_MEMORY));
            l->length = keep_length;
            l->sum = sum;
            r = live(l, step); /* again, now with memory */
        }
        if (r < 0) {
            test_bad++;
            printf("    dimension %d: step %d gave %d (%s) [failing %d]\n", l->dim, step, (int)r, peri_status_text((int32_t)r),
                   (int)p->fail_at);
            break;
        }
    }
    return p->calls;
}

static int equal(peri_body *a, peri_body *b) {
    const int32_t fields[4] = {PERI_FIELD_DISPLACEMENT, PERI_FIELD_VELOCITY, PERI_FIELD_DAMAGE, PERI_FIELD_FORCE_DENSITY};
    int k, same = a && b && peri_broken_count(a) == peri_broken_count(b) && peri_cut_count(a) == peri_cut_count(b);
    for (k = 0; k < 4 && same; ++k) {
        int64_t n = peri_size_of_field(a, fields[k]);
        double *x = (double *)calloc((size_t)n, sizeof *x), *y = (double *)calloc((size_t)n, sizeof *y);
        same = peri_get_field(a, fields[k], x, n) == PERI_OK && peri_get_field(b, fields[k], y, n) == PERI_OK &&
               memcmp(x, y, (size_t)n * sizeof *x) == 0;
        free(x);
        free(y);
    }
    return same;
}

static void fail_each(int dim, int precision) {
    pool calm = {0, 0, 0, -1, 0, 0}, p;
    life first;
    int64_t total, n;
    memset(&first, 0, sizeof first);
    first.dim = dim;
    first.precision = precision;
    total = whole_life(&first, &calm);
    CHECK(first.seen_breaks > 0 && first.length > 1000 && first.sum == first.sum);
    for (n = 0; n < total && test_bad < 10; ++n) {
        life l;
        memset(&p, 0, sizeof p);
        p.fail_at = n;
        memset(&l, 0, sizeof l);
        l.dim = dim;
        l.precision = precision;
        (void)whole_life(&l, &p);
        CHECK(p.calls > n);
        CHECK(equal(first.body, l.body) && equal(first.copy, l.copy));
        CHECK(l.length == first.length && memcmp(l.text, first.text, (size_t)l.length) == 0);
        CHECK(l.sum == first.sum && l.seen_breaks == first.seen_breaks);
        peri_body_destroy(l.body); /* destroyable wherever it stopped */
        peri_body_destroy(l.copy);
        if (p.blocks != 0 || p.bytes != 0 || p.wrong != 0) {
            test_bad++;
            printf("    failing allocation %d: %d blocks, %d bytes left, %d wrong sizes\n", (int)n, (int)p.blocks, (int)p.bytes,
                   p.wrong);
        }
        free(l.text);
    }
    printf("    %dD: %d allocations, each failed once\n", dim, (int)total);
    CHECK(total >= 10);
    peri_body_destroy(first.copy); /* in this order, too */
    peri_body_destroy(first.body);
    CHECK(calm.blocks == 0 && calm.bytes == 0 && calm.wrong == 0);
    free(first.text);
}
static void every_allocation_fails_once_2d(void) { fail_each(2, PERI_PRECISION_DOUBLE); }
static void every_allocation_fails_once_3d(void) { fail_each(3, PERI_PRECISION_SINGLE); }
static void every_allocation_fails_once_mixed(void) { fail_each(3, PERI_PRECISION_MIXED); }

static void unaligned_dirty_memory(void) {
    int dim;
    unsigned offset;
    for (dim = 2; dim <= 3; ++dim) {
        pool calm = {0, 0, 0, -1, 0, 0};
        life a;
        memset(&a, 0, sizeof a);
        a.dim = dim;
        a.precision = dim == 2 ? PERI_PRECISION_DOUBLE : PERI_PRECISION_SINGLE;
        (void)whole_life(&a, &calm);
        for (offset = 1; offset <= 9; offset += 4) {
            pool p = {0, 0, 0, -1, 0, 0};
            life b;
            memset(&b, 0, sizeof b);
            b.dim = dim;
            b.precision = a.precision;
            p.offset = offset;
            (void)whole_life(&b, &p);
            CHECK(equal(a.body, b.body) && equal(a.copy, b.copy) && a.sum == b.sum && a.length == b.length);
            CHECK(memcmp(a.text, b.text, (size_t)a.length) == 0);
            peri_body_destroy(b.body);
            peri_body_destroy(b.copy);
            CHECK(p.blocks == 0 && p.bytes == 0 && p.wrong == 0);
            free(b.text);
        }
        peri_body_destroy(a.body);
        peri_body_destroy(a.copy);
        CHECK(calm.blocks == 0 && calm.wrong == 0);
        free(a.text);
    }
}

/* ---- NULL --------------------------------------------------------------------------------------------------------- */

#define NO(call) CHECK((call) == PERI_ERROR_ARGUMENT)

/* SOURCE OF TRUTH: "a required pointer is NULL" is PERI_ERROR_ARGUMENT; the functions without a status give 0. */
static void null_body_everywhere(void) {
    double d[8] = {0, 0, 0, 0, 0, 0, 0, 0};
    int32_t i[4] = {0, 0, 0, 0};
    peri_error e;
    peri_view v;
    peri_energy en;
    peri_advance_desc r;
    peri_material_desc m;
    peri_body *c = NULL;
    peri_advance_desc_init(&r);
    peri_material_desc_init(&m, PERI_LAW_BOND_BASED);
    peri_advance_desc_init(NULL);
    peri_material_desc_init(NULL, PERI_LAW_BOND_BASED);
    peri_body_desc_init(NULL);
    peri_body_destroy(NULL);
    NO(peri_get_error(NULL, &e));
    NO(peri_unlock(NULL));
    NO(peri_id(NULL, PERI_KIND_MATERIAL, 1));
    NO(peri_add_material(NULL, &m));
    NO(peri_set_interface(NULL, 0, 0, &m));
    NO(peri_get_bond_constants(NULL, 0, 0, d, d));
    NO(peri_add_box(NULL, 0, d, d, 1));
    NO(peri_add_ball(NULL, 0, d, 1, 1));
    NO(peri_add_shape(NULL, 0, d, d, 1, inner, NULL));
    NO(peri_add_perturbed_box(NULL, 0, d, d, 1, 1, 1));
    NO(peri_add_points(NULL, 1, d, d, NULL));
    NO(peri_set_families(NULL, 1, i));
    NO(peri_build(NULL));
    CHECK(peri_dimension(NULL) == 0 && peri_point_count(NULL) == 0 && peri_family_width(NULL) == 0);
    CHECK(peri_entry_count(NULL) == 0 && peri_cut_count(NULL) == 0 && peri_broken_count(NULL) == 0);
    CHECK(peri_step_count(NULL) == 0 && peri_time(NULL) == 0 && peri_load_factor(NULL) == 0 && peri_stable_step(NULL) == 0);
    NO(peri_get_families(NULL, 0, 1, i, 4));
    NO(peri_bond_is_intact(NULL, 0, 1));
    NO(peri_reset(NULL));
    NO(peri_body_clone(NULL, &c, &e));
    CHECK(c == NULL && e.code == PERI_ERROR_ARGUMENT);
    NO(peri_select_box(NULL, NULL, d, d));
    NO(peri_select_ball(NULL, NULL, d, 1));
    NO(peri_select_if(NULL, NULL, inner, NULL));
    NO(peri_select_points(NULL, NULL, 1, i));
    NO(peri_find_set(NULL, "x"));
    NO(peri_size_of_set(NULL, PERI_ALL));
    NO(peri_get_set(NULL, PERI_ALL, i, 4));
    NO(peri_cut_segment(NULL, PERI_CUT_INITIAL, d, d));
    NO(peri_cut_polyline(NULL, PERI_CUT_INITIAL, 2, d));
    NO(peri_cut_disc(NULL, PERI_CUT_INITIAL, d, d, 1));
    NO(peri_cut_triangle(NULL, PERI_CUT_INITIAL, d, d, d));
    NO(peri_cut_rectangle(NULL, PERI_CUT_INITIAL, d, d, d));
    NO(peri_cut_pairs(NULL, PERI_CUT_INITIAL, 1, i));
    NO(peri_cut_if(NULL, PERI_CUT_INITIAL, long_pairs, NULL));
    NO(peri_set_no_fail(NULL, PERI_ALL, 1));
    NO(peri_on_break(NULL, count_break, NULL));
    NO(peri_add_displacement(NULL, PERI_ALL, d));
    NO(peri_add_velocity(NULL, PERI_ALL, d));
    NO(peri_prescribe_displacement(NULL, PERI_ALL, PERI_AXIS_X, d, NULL, NULL));
    NO(peri_prescribe_velocity(NULL, PERI_ALL, PERI_AXIS_X, d, NULL, NULL));
    NO(peri_apply_body_force(NULL, PERI_ALL, d, NULL, NULL));
    NO(peri_apply_layer_traction(NULL, PERI_ALL, 1, d, NULL, NULL));
    NO(peri_remove_load(NULL, 0));
    NO(peri_get_reaction(NULL, 0, d));
    NO(plane_obstacle(NULL, d, d, 0, NULL, NULL));
    NO(ball_obstacle(NULL, d, 1, 0, NULL, NULL));
    NO(peri_get_obstacle_force(NULL, 0, d, NULL));
    NO(peri_advance(NULL, &r));
    NO(peri_size_of_field(NULL, PERI_FIELD_VELOCITY));
    NO(peri_get_field(NULL, PERI_FIELD_VELOCITY, d, 8));
    NO(peri_set_field(NULL, PERI_FIELD_VELOCITY, d, 8));
    NO(peri_view_field(NULL, PERI_FIELD_VELOCITY, &v));
    NO(peri_get_energy(NULL, &en));
    NO(peri_get_momentum(NULL, d, d));
    NO(peri_export_vtu_to(NULL, keep, NULL));
    NO(peri_export_history_to(NULL, 1, keep, NULL));
    NO(peri_export_vtu(NULL, "x"));
    NO(peri_export_history(NULL, "x", 0));
}

/* The same with a body and NULL for the rest; what may be NULL says so in peri.h and is accepted. */
static void null_arguments(void) {
    pool p = {0, 0, 0, -1, 0, 0};
    life l;
    peri_body *b;
    double *none = NULL, v[2] = {0, 0};
    int step;
    memset(&l, 0, sizeof l);
    l.dim = 2;
    l.precision = PERI_PRECISION_DOUBLE;
    l.memory = &p;
    for (step = 0; step <= 6; ++step) CHECK(live(&l, step) >= 0);
    b = l.body;
    NO(peri_get_error(b, NULL));
    NO(peri_get_families(b, 0, 1, NULL, 99));
    NO(peri_select_box(b, NULL, none, v));
    NO(peri_select_ball(b, NULL, none, 1));
    NO(peri_cut_segment(b, PERI_CUT_INITIAL, none, none));
    NO(peri_cut_polyline(b, PERI_CUT_INITIAL, 2, none));
    NO(peri_cut_pairs(b, PERI_CUT_INITIAL, 1, NULL));
    NO(peri_add_displacement(b, PERI_ALL, none));
    NO(peri_set_field(b, PERI_FIELD_VELOCITY, none, 10));
    NO(peri_get_energy(b, NULL));
    NO(peri_export_history(b, NULL, 1));
    CHECK(peri_get_momentum(b, NULL, NULL) == PERI_OK);
    CHECK(peri_get_bond_constants(b, peri_id(b, PERI_KIND_MATERIAL, 1), peri_id(b, PERI_KIND_MATERIAL, 2), NULL, NULL) == PERI_OK);
    CHECK(peri_on_break(b, NULL, NULL) == PERI_OK);
    CHECK(peri_prescribe_velocity(b, PERI_ALL, PERI_AXIS_X, NULL, NULL, NULL) == peri_id(b, PERI_KIND_LOAD, 1));
    NO(peri_get_reaction(b, peri_id(b, PERI_KIND_LOAD, 1), none));
    peri_body_destroy(b);
    CHECK(p.blocks == 0 && p.wrong == 0);
}

/* A run that is refused for memory has changed nothing. */
static int32_t run_or_nothing(peri_body *b, const peri_advance_desc *run) {
    const int64_t n = peri_size_of_field(b, PERI_FIELD_VELOCITY);
    double *before = (double *)calloc((size_t)(2 * n), sizeof *before), *after = (double *)calloc((size_t)(2 * n), sizeof *after);
    int32_t status;
    MUST(b, peri_get_field(b, PERI_FIELD_DISPLACEMENT, before, n));
    MUST(b, peri_get_field(b, PERI_FIELD_VELOCITY, before + n, n));
    status = peri_advance(b, run);
    MUST(b, peri_get_field(b, PERI_FIELD_DISPLACEMENT, after, n));
    MUST(b, peri_get_field(b, PERI_FIELD_VELOCITY, after + n, n));
    if (status == PERI_ERROR_MEMORY) {
        CHECK(memcmp(before, after, (size_t)(2 * n) * sizeof *before) == 0);
        CHECK(peri_step_count(b) == 0 && peri_time(b) == 0);
    } else CHECK(memcmp(before, after, (size_t)(2 * n) * sizeof *before) != 0);
    free(before);
    free(after);
    return status;
}

/* ---- a plate of one material --------------------------------------------------------------------------------------- */

/* Its families are also packed by columns, with a table, drafts and masks of their own. A cut plate is built, cloned and run; a call
   that fails for want of memory is made again, the run, too: it estimates the stable step in memory of its own.
   Returns the number of calls that failed, and the checksum of the motion. */
static int columns_life(pool *p, double *sum) {
    const double lo[2] = {0, 0}, hi[2] = {9, 7}, from[2] = {0, 3.5}, to[2] = {4, 3.5}, v[2] = {0.02, 0};
    peri_body_desc d;
    peri_material_desc m;
    peri_body *b = NULL, *copy = NULL;
    peri_advance_desc run;
    double *u;
    int64_t n = 0, i;
    int failed = 0, step;
    peri_body_desc_init(&d);
    d.space = PERI_SPACE_PLANE_STRESS;
    d.horizon = 2.5;
    d.allocate = pool_allocate;
    d.release = pool_release;
    d.memory_user = p;
    peri_material_desc_init(&m, PERI_LAW_BOND_BASED);
    m.young = m.density = 1;
    peri_advance_desc_init(&run);
    run.steps = 20;
    *sum = 0;
    for (step = 0; step < 8; ++step) {
        int64_t result = 0;
        int tries;
        for (tries = 0; tries < 2; ++tries) {
            switch (step) {
            case 0: result = peri_body_create(&d, &b, NULL); break;
            case 1: result = peri_add_material(b, &m); break;
            case 2: result = peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo, hi, 1.0); break;
            case 3: result = peri_build(b); break;
            case 4: result = peri_cut_segment(b, PERI_CUT_INITIAL, from, to); break;
            case 5: result = peri_body_clone(b, &copy, NULL); break;
            case 6: result = peri_add_velocity(copy, (int32_t)peri_select_box(copy, NULL, lo, to), v); break;
            default: result = run_or_nothing(copy, &run); break;
            }
            if (result != PERI_ERROR_MEMORY && !(step == 6 && result == PERI_ERROR_ID_NONE)) break;
            failed++;
        }
        CHECK(result >= 0);
        if (result < 0) break;
    }
    if (copy) {
        CHECK(peri_step_count(copy) == 20);
        n = peri_size_of_field(copy, PERI_FIELD_DISPLACEMENT);
        u = (double *)malloc((size_t)n * sizeof(double));
        MUST(copy, peri_get_field(copy, PERI_FIELD_DISPLACEMENT, u, n));
        for (i = 0; i < n; ++i) *sum += u[i] * (double)(i + 1);
        free(u);
    }
    peri_body_destroy(b);
    peri_body_destroy(copy);
    CHECK(p->blocks == 0 && p->bytes == 0 && p->wrong == 0);
    return failed;
}

static void every_allocation_of_columns_fails_once(void) {
    pool p = {0, 0, 0, -1, 0, 0};
    double whole, sum;
    int64_t calls, k;
    CHECK(columns_life(&p, &whole) == 0 && whole != 0);
    calls = p.calls;
    for (k = 0; k < calls; ++k) {
        p.calls = 0;
        p.fail_at = k;
        CHECK(columns_life(&p, &sum) == 1);
        CHECK(sum == whole);
    }
    printf("    plate of one material: %d allocations, each failed once\n", (int)calls);
    CHECK(calls > 30);
}

/* SOURCE OF TRUTH: peri.h: peri_memory holds the bytes that the body holds, as asked of its allocator. Interfaces are kept to the end. */
static void interfaces_are_counted(void) {
    const double lo[2] = {0, 0}, middle[2] = {4, 4}, half[2] = {4, 0}, hi[2] = {8, 4};
    int count;
    for (count = 0; count <= 40; count += 20) {
        pool p = {0, 0, 0, -1, 0, 0};
        peri_body_desc d;
        peri_material_desc m;
        peri_memory held;
        peri_body *b = NULL, *copy = NULL;
        int32_t mat[10], i, j, made = 0;
        peri_body_desc_init(&d);
        d.space = PERI_SPACE_PLANE_STRESS;
        d.horizon = 2;
        d.allocate = pool_allocate, d.release = pool_release, d.memory_user = &p;
        CHECK(peri_body_create(&d, &b, NULL) == PERI_OK);
        peri_material_desc_init(&m, PERI_LAW_BOND_BASED);
        m.young = m.density = 1;
        for (i = 0; i < 10; ++i) mat[i] = (int32_t)MUST(b, peri_add_material(b, &m));
        for (i = 0; i < 10; ++i)
            for (j = i + 1; j < 10; ++j)
                if (made < count && ++made) MUST(b, peri_set_interface(b, mat[i], mat[j], &m));
        CHECK(made == count && peri_get_memory(b, &held) == PERI_OK && held.total == p.bytes);
        MUST(b, peri_add_box(b, mat[0], lo, middle, 1));
        MUST(b, peri_add_box(b, mat[1], half, hi, 1));
        MUST(b, peri_build(b));
        CHECK(peri_get_memory(b, &held) == PERI_OK && held.total == p.bytes);
        CHECK(peri_body_clone(b, &copy, NULL) == PERI_OK);
        peri_body_destroy(b); /* what is shared lives on */
        CHECK(peri_get_memory(copy, &held) == PERI_OK && held.total == p.bytes);
        peri_body_destroy(copy);
        CHECK(p.blocks == 0 && p.bytes == 0 && p.wrong == 0);
    }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(every_allocation_fails_once_2d);
#ifdef __SANITIZE_ADDRESS__ /* the plane allocates in the same places, and is done here in a tenth of the time */
    if (test_long)
#endif
    {
        RUN(every_allocation_fails_once_3d);
        LONG_RUN(every_allocation_fails_once_mixed);
    }
    RUN(every_allocation_of_columns_fails_once);
    RUN(interfaces_are_counted);
    RUN(unaligned_dirty_memory);
    RUN(null_body_everywhere);
    RUN(null_arguments);
    return test_end("test_memory");
}
