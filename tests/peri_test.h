/* SPDX-License-Identifier: MIT */
/* peri_test.h - the test harness: one program per subject, each a list of RUN(case).

   A case is a function `static void name(void)`; it passes when no CHECK in it failed. Programs close with
   "<program>: N passed, N failed" and return the number of failed cases. `program word` runs only the cases whose name
   contains word; `program --long` also runs what LONG_RUN guards (make validate); `program -name` leaves out the case name. */
#ifndef PERI_TEST_H
#define PERI_TEST_H

#include "../peri.h"
#include "../src/base/enums.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static int test_passed, test_failed, test_bad, test_long;
static const char *test_filter, *test_left_out[8], *test_kept[8];

#define CHECK(condition)                                                                                               \
    do {                                                                                                               \
        if (!(condition)) {                                                                                            \
            test_bad++;                                                                                                \
            if (test_bad <= 10) printf("    %s:%d: not true: %s\n", __FILE__, __LINE__, #condition);                   \
        }                                                                                                              \
    } while (0)

/* |got - want| <= rel*|want| + abs */
#define CHECK_NEAR(got, want, rel, abs)                                                                                \
    test_near((double)(got), (double)(want), (double)(rel), (double)(abs), #got, __FILE__, __LINE__)

/* A call that must succeed; prints the error record of the body where it does not. Yields the value. */
#define MUST(body, call) test_must((body), (int64_t)(call), #call, __FILE__, __LINE__)

#define RUN(name) test_run(name, #name)
#define LONG_RUN(name)                                                                                                 \
    do {                                                                                                               \
        if (test_long) test_run(name, #name);                                                                          \
    } while (0)

static inline void test_near(double got, double want, double rel, double abs, const char *text, const char *file, int line) {
    if (!(fabs(got - want) <= rel * fabs(want) + abs)) {
        test_bad++;
        if (test_bad <= 10)
            printf("    %s:%d: %s = %.17g, expected %.17g (relative error %.3g)\n", file, line, text, got, want,
                   want != 0.0 ? fabs(got / want - 1.0) : fabs(got));
    }
}

static inline int64_t test_must(const peri_body *body, int64_t result, const char *text, const char *file, int line) {
    if (result < 0) {
        char buffer[256] = "";
        peri_error error;
        if (body && peri_get_error(body, &error) == PERI_OK) (void)peri_format_error(&error, buffer, sizeof buffer);
        test_bad++;
        printf("    %s:%d: %s failed: %s [%s]\n", file, line, text, peri_status_text((int32_t)result), buffer);
    }
    return result;
}

static inline void test_run(void (*function)(void), const char *name) {
    const clock_t start = clock();
    int k;
    int kept = !test_kept[0];
    if (test_filter && !strstr(name, test_filter)) return;
    for (k = 0; k < 8; ++k) {
        if (test_left_out[k] && strcmp(name, test_left_out[k]) == 0) return;
        if (test_kept[k] && strcmp(name, test_kept[k]) == 0) kept = 1;
    }
    if (!kept) return;
    test_bad = 0;
    function();
    if (test_bad) test_failed++;
    else test_passed++;
    printf("  %s %s %.2f s\n", test_bad ? "FAIL" : "pass", name, (double)(clock() - start) / CLOCKS_PER_SEC);
    (void)fflush(stdout);
}

static inline void test_begin(int argc, char **argv) {
    int k, out = 0, kept = 0;
    for (k = 1; k < argc; ++k) {
        if (strcmp(argv[k], "--long") == 0) test_long = 1;
        else if (argv[k][0] == '-' && out < 8) test_left_out[out++] = argv[k] + 1;
        else if (argv[k][0] == '+' && kept < 8) test_kept[kept++] = argv[k] + 1;
        else test_filter = argv[k];
    }
}

static inline int test_end(const char *program) {
    printf("%s: %d passed, %d failed\n", program, test_passed, test_failed);
    return test_failed;
}

/* A body of the descriptor with one material of unit modulus and density; critical_stretch 0: bonds do not break. */
static inline peri_body *test_unit_body(const peri_body_desc *desc, double critical_stretch) {
    peri_body *body = NULL;
    peri_material_desc m;
    CHECK(peri_body_create(desc, &body, NULL) == PERI_OK);
    peri_material_desc_init(&m, PERI_LAW_BOND_BASED);
    m.young = 1.0;
    m.density = 1.0;
    m.critical_stretch = critical_stretch;
    MUST(body, peri_add_material(body, &m));
    return body;
}

/* A fixed generator, uniform in [0, 1): the same numbers on every machine. */
static inline double test_random(uint64_t *state) {
    uint64_t z = (*state += UINT64_C(0x9E3779B97F4A7C15));
    z = (z ^ (z >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94D049BB133111EB);
    return (double)((z ^ (z >> 31)) >> 11) * (1.0 / 9007199254740992.0);
}

/* For peri_cut_if: a share of the bonds, at random. */
typedef struct chance {
    uint64_t seed;
    double   share;
} chance;
static inline int32_t by_chance(void *user, int32_t i, int32_t j, const double *xi, const double *xj) {
    chance *c = (chance *)user;
    (void)i, (void)j, (void)xi, (void)xj;
    return test_random(&c->seed) < c->share;
}

/* A peri_load_fn that notes the time it is asked for. */
static inline int32_t note_time(void *user, double time, int64_t count, const int32_t *points, double *value) {
    (void)count, (void)points, (void)value;
    *(double *)user = time;
    return 0;
}

/* The obstacles that most tests want: smooth, at rest or where `motion` says. NULL vectors: no descriptor. */
static inline int32_t plane_obstacle(peri_body *body, const double *place, const double *normal, double stiffness, peri_motion_fn motion,
                                     void *user) {
    peri_obstacle_desc desc;
    if (!place || !normal) return peri_add_obstacle(body, NULL);
    peri_obstacle_desc_init(&desc, PERI_SHAPE_PLANE);
    memcpy(desc.place, place, (size_t)peri_dimension(body) * sizeof *place);
    memcpy(desc.normal, normal, (size_t)peri_dimension(body) * sizeof *normal);
    desc.stiffness = stiffness;
    desc.motion = motion;
    desc.user = user;
    return peri_add_obstacle(body, &desc);
}

static inline int32_t ball_obstacle(peri_body *body, const double *centre, double radius, double stiffness, peri_motion_fn motion,
                                    void *user) {
    peri_obstacle_desc desc;
    if (!centre) return peri_add_obstacle(body, NULL);
    peri_obstacle_desc_init(&desc, PERI_SHAPE_BALL);
    memcpy(desc.place, centre, (size_t)peri_dimension(body) * sizeof *centre);
    desc.radius = radius;
    desc.stiffness = stiffness;
    desc.motion = motion;
    desc.user = user;
    return peri_add_obstacle(body, &desc);
}

#endif
