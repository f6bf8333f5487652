/* SPDX-License-Identifier: MIT */
/* test_programs.c - random programs: any call, in any order, with any numbers, on bodies in any state. SOURCE OF TRUTH: see program.h.

   `test_programs --seeds DIRECTORY` writes the kept programs as files for the fuzzer; `test_programs --show FIRST COUNT` tells the calls of
   random programs; `test_programs --many FIRST COUNT` runs those. */
#include "peri_test.h"
#include "program_corpus.h"
#include "program_run.h"
#include <time.h>

#if defined(__SANITIZE_ADDRESS__)
#define SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SANITIZED 1
#endif
#endif
#ifdef SANITIZED
#define RANDOM_PROGRAMS 200
#define MANY_PROGRAMS   12000
#else
#define RANDOM_PROGRAMS 900
#define MANY_PROGRAMS   50000
#endif
#define LONGEST 240
#define RANDOM_SEEDS 300

static program life;

static size_t random_program(uint64_t seed, uint8_t *bytes) {
    uint64_t dice = seed * UINT64_C(0x2545F4914F6CDD1D);
    const size_t size = 40 + (size_t)(test_random(&dice) * (LONGEST - 40));
    size_t k;
    for (k = 0; k < size; ++k) bytes[k] = (uint8_t)(256.0 * test_random(&dice));
    return size;
}

static size_t kept_program(const char *hex, uint8_t *bytes) {
    const char digits[] = "0123456789abcdef";
    size_t k;
    for (k = 0; hex[2 * k] && hex[2 * k + 1]; ++k)
        bytes[k] = (uint8_t)(16 * (strchr(digits, hex[2 * k]) - digits) + (strchr(digits, hex[2 * k + 1]) - digits));
    return k;
}

static void check_program(const uint8_t *bytes, size_t size, const char *kind, int number) {
    const clock_t start = clock();
    double seconds;
    run_program(&life, bytes, size, 0);
    seconds = (double)(clock() - start) / CLOCKS_PER_SEC;
    if (life.fault) printf("    %s program %d: line %d, in %s: not true: %s\n", kind, number, life.fault_line, life.fault_call, life.fault);
    CHECK(life.fault == NULL);
    CHECK(seconds < 5.0);
}

static void kept_programs(void) {
    static uint8_t bytes[4096];
    int k;
    for (k = 0; k < CORPUS; ++k) check_program(bytes, kept_program(corpus[k], bytes), "kept", k);
}

/* Those that have found faults: a free obstacle that leaves the numbers, twice; a stable step that is none; a free obstacle that is close
   before any force was asked for. */
static void found_programs(void) {
    static const int found[4] = {120683, 134401, 153198, 191899};
    uint8_t bytes[LONGEST];
    int k;
    for (k = 0; k < 4; ++k) check_program(bytes, random_program((uint64_t)found[k] + 1, bytes), "random", found[k]);
}

static void random_programs(void) {
    uint8_t bytes[LONGEST];
    int k;
    for (k = 0; k < RANDOM_PROGRAMS; ++k) check_program(bytes, random_program((uint64_t)k + 1, bytes), "random", k);
}

static void many_programs(void) {
    uint8_t bytes[LONGEST];
    int k;
    for (k = RANDOM_PROGRAMS; k < MANY_PROGRAMS; ++k) check_program(bytes, random_program((uint64_t)k + 1, bytes), "random", k);
}

/* Beyond those that --long runs. */
static int many(int first, int count) {
    uint8_t bytes[LONGEST];
    int k;
    for (k = first; k < first + count; ++k) check_program(bytes, random_program((uint64_t)k + 1, bytes), "random", k);
    test_failed = test_bad > 0;
    test_passed = !test_failed;
    return test_end("test_programs");
}

/* Tells the calls of random programs. */
static int show(int first, int count) {
    uint8_t bytes[LONGEST];
    int k, faults = 0;
    for (k = first; k < first + count; ++k) {
        printf("program %d\n", k);
        run_program(&life, bytes, random_program((uint64_t)k + 1, bytes), 1);
        if (life.fault) printf("line %d, in %s: not true: %s\n", life.fault_line, life.fault_call, life.fault);
        faults += life.fault != NULL;
    }
    return faults;
}

/* Writes the kept programs, and some random ones, a file each. */
static int write_seeds(const char *directory) {
    static uint8_t bytes[4096];
    char path[1024];
    int k, failed = 0;
    for (k = 0; k < CORPUS + RANDOM_SEEDS; ++k) {
        const size_t size = k < CORPUS ? kept_program(corpus[k], bytes) : random_program((uint64_t)(k - CORPUS) + 1, bytes);
        FILE *file;
        if (strlen(directory) > sizeof path - 32) return 1;
        (void)sprintf(path, "%s/seed_%d", directory, k);
        file = fopen(path, "wb");
        failed += !file || fwrite(bytes, 1, size, file) != size;
        if (file) failed += fclose(file) != 0;
    }
    return failed;
}

int main(int argc, char **argv) {
    if (argc == 4 && strcmp(argv[1], "--show") == 0) return show(atoi(argv[2]), atoi(argv[3]));
    if (argc == 4 && strcmp(argv[1], "--many") == 0) return many(atoi(argv[2]), atoi(argv[3]));
    if (argc == 3 && strcmp(argv[1], "--seeds") == 0) return write_seeds(argv[2]);
    test_begin(argc, argv);
    RUN(kept_programs);
    RUN(found_programs);
    RUN(random_programs);
    LONG_RUN(many_programs);
    return test_end("test_programs");
}
