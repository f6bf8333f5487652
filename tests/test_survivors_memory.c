/* SPDX-License-Identifier: MIT */
/* test_survivors_memory.c - what `make mutants` found that no other test of memory looked at.

   SOURCE OF TRUTH: peri.h: what is taken is given back, whichever allocation fails, and a call that fails has changed nothing; the bytes
   that an allocator counts itself. */
#include "scene.h"

typedef struct heap {
    int64_t blocks, bytes, most, left; /* left: allocations that succeed from here on; < 0: all */
} heap;

static void *take(void *user, uint64_t bytes) {
    heap *h = (heap *)user;
    void *p = NULL;
    if (h->left != 0) p = malloc((size_t)bytes);
    if (h->left > 0) h->left--;
    if (!p) return NULL;
    h->blocks++;
    h->bytes += (int64_t)bytes;
    if (h->bytes > h->most) h->most = h->bytes;
    return p;
}
static void give(void *user, void *p, uint64_t bytes) {
    heap *h = (heap *)user;
    h->blocks--;
    h->bytes -= (int64_t)bytes;
    free(p);
}

static peri_body *plate_of(heap *h, int32_t law, int nx, int ny) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, law, 0.3, 1, 2.2, nx, ny, 1);
    memset(h, 0, sizeof *h);
    h->left = -1;
    s.desc.allocate = take;
    s.desc.release = give;
    s.desc.memory_user = h;
    return specimen_make(&s);
}

static int32_t side(peri_body *b, double from, double to) {
    const double lo[3] = {from, -1e9, -1e9}, hi[3] = {to, 1e9, 1e9};
    return (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi));
}

/* ---- each allocation fails once ------------------------------------------------------------------------------------- */

typedef int32_t (*call_fn)(peri_body *b, int32_t set);

static int32_t multiply(peri_body *b, int32_t set) {
    const int64_t n = 2 * peri_point_count(b);
    double *v = (double *)calloc((size_t)n, sizeof *v);
    int32_t status;
    (void)set;
    v[0] = 1;
    status = peri_multiply_stiffness(b, v, v, n);
    free(v);
    return status;
}
static int32_t assemble(peri_body *b, int32_t set) {
    peri_matrix *a = NULL;
    const int32_t status = peri_matrix_create(b, &a);
    (void)set;
    peri_matrix_destroy(a);
    return status;
}
static int32_t pull(peri_body *b, int32_t set) {
    const double normal[2] = {1, 0}, value[2] = {1e-3, 0};
    const int32_t load = peri_apply_traction(b, set, 6, normal, value, NULL, NULL);
    return load < 0 ? load : peri_remove_load(b, load);
}
static int32_t press(peri_body *b, int32_t set) {
    const int32_t load = peri_apply_pressure(b, set, 1e-3, NULL, NULL);
    return load < 0 ? load : peri_remove_load(b, load);
}
static int32_t settle(peri_body *b, int32_t method) {
    const double move[2] = {0.01, 0};
    const int32_t held = peri_prescribe_displacement(b, side(b, 0, 3), PERI_AXIS_XY, move, NULL, NULL);
    peri_solve_desc s;
    peri_solve_desc_init(&s);
    s.method = method;
    const int32_t status = peri_solve(b, &s, NULL);
    (void)MUST(b, peri_remove_load(b, held));
    return status;
}

/* What the first call that succeeds keeps (a product its memory, a body its rows of loads) is kept by no other. */
static void failed_calls_keep_nothing(void) {
    static const call_fn calls[4] = {multiply, assemble, pull, press};
    static const int32_t laws[2] = {PERI_LAW_LPS, PERI_LAW_CORRESPONDENCE};
    int c, l;
    for (l = 0; l < 2; ++l)
        for (c = 0; c < 4; ++c) {
            heap h;
            peri_body *b = plate_of(&h, laws[l], 9, 6);
            const int32_t set = side(b, 5, 9);
            double f[108];
            int64_t failures = 0, bytes, blocks;
            int32_t status = PERI_ERROR_MEMORY;
            MUST(b, peri_get_field(b, PERI_FIELD_FORCE_DENSITY, f, 108));
            bytes = h.bytes;
            blocks = h.blocks;
            for (; status == PERI_ERROR_MEMORY && failures < 40; ++failures) {
                h.left = failures;
                status = calls[c](b, set);
                h.left = -1;
                if (status == PERI_ERROR_MEMORY) CHECK(h.bytes - bytes <= 4096 && h.blocks - blocks <= 1); /* room for one load more */
            }
            CHECK(status == PERI_OK && failures > 2);
            bytes = h.bytes;
            blocks = h.blocks;
            MUST(b, calls[c](b, set));
            CHECK(h.bytes == bytes && h.blocks == blocks);
            peri_body_destroy(b);
            CHECK(h.bytes == 0 && h.blocks == 0);
        }
}

static void solves_give_all_back(void) {
    static const int32_t methods[3] = {PERI_METHOD_NEWTON, PERI_METHOD_BICGSTAB, PERI_METHOD_RELAXATION};
    int m;
    for (m = 0; m < 3; ++m) {
        heap h;
        peri_body *b = plate_of(&h, PERI_LAW_LPS, m ? 9 : 60, m ? 6 : 40);
        int64_t bytes, blocks;
        MUST(b, settle(b, methods[m]));
        bytes = h.bytes;
        blocks = h.blocks;
        MUST(b, settle(b, methods[m]));
        CHECK(h.blocks - blocks <= 3 && h.bytes - bytes <= 8192); /* a set, and its load */
        peri_body_destroy(b);
        CHECK(h.bytes == 0 && h.blocks == 0);
    }
}

/* "most memory of the solver at a time, beside the body": of a solve whose sets and loads are there, whatever the number of steps. */
static void bytes_of_a_solve_are_counted(void) {
    int steps, levels;
    for (levels = 0; levels < 2; ++levels)
        for (steps = 1; steps < 6; steps += 2) {
            const double move[2] = {0.01, 0};
            heap h;
            peri_body *b = plate_of(&h, PERI_LAW_LPS, 48, 32);
            peri_solve_desc s;
            peri_solve_report r;
            int64_t before;
            MUST(b, peri_prescribe_displacement(b, side(b, 0, 3), PERI_AXIS_XY, NULL, NULL, NULL));
            MUST(b, peri_prescribe_displacement(b, side(b, 45, 48), PERI_AXIS_X, move, NULL, NULL));
            peri_solve_desc_init(&s);
            s.steps = steps;
            s.tolerance = 0.1;
            s.preconditioner = levels ? PERI_PRECONDITIONER_MULTILEVEL : PERI_PRECONDITIONER_BLOCK_JACOBI;
            h.most = before = h.bytes;
            MUST(b, peri_solve(b, &s, &r));
            CHECK_NEAR(r.bytes, h.most - before, 0.02, 0);
            peri_body_destroy(b);
        }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(failed_calls_keep_nothing);
    RUN(solves_give_all_back);
    RUN(bytes_of_a_solve_are_counted);
    return test_end("test_survivors_memory");
}
