/* SPDX-License-Identifier: MIT */
/* bench.h - a clock, an allocator that counts, and a way out, for the bench programs. */
#ifndef BENCH_H
#define BENCH_H

#include "../peri.h"
#include "../src/base/enums.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#ifdef _OPENMP
#include <omp.h>
#endif

static inline double seconds(void) {
#ifdef _OPENMP
    return omp_get_wtime();
#else
    return (double)clock() / CLOCKS_PER_SEC;
#endif
}

/* Time of the processor, all threads together: that of the wall on an idle machine, for one thread, and not disturbed by others. */
static inline double processor_seconds(void) { return (double)clock() / CLOCKS_PER_SEC; }

static uint64_t bytes_now, bytes_most;

static inline void *count_allocate(void *user, uint64_t bytes) {
    (void)user;
    bytes_now += bytes;
    if (bytes_now > bytes_most) bytes_most = bytes_now;
    return malloc((size_t)bytes);
}

static inline void count_release(void *user, void *pointer, uint64_t bytes) {
    (void)user;
    if (pointer) bytes_now -= bytes;
    free(pointer);
}

static inline void need(peri_body *body, int64_t result) {
    peri_error error = { 0, 0, -1, 0.0, "", "" };
    char text[256] = "";
    if (result >= 0) return;
    (void)peri_get_error(body, &error);
    (void)peri_format_error(&error, text, sizeof text);
    fprintf(stderr, "bench: %s\n", text);
    exit(1);
}

#endif
