/* SPDX-License-Identifier: MIT */
/* search.c - what peri_build costs on clouds: `search [repeats]`. ns per directed bond of random points, whole cells, bond-based, about 109
   bonds a point in 3D and 28 in 2D: the whole build by number of points and of threads, minimum of the repeats. One thread by processor
   time, which other work on the machine disturbs little; more by the clock on the wall.

     fresh  with malloc, in a process that has not had the memory before: the system makes each page when it is first written
     pages  of that, what the pages take: one byte written to each of as many
     warm   with a hook that hands out memory which the process has written already: search, weights and constants alone */
#include "bench.h"

typedef struct arena {
    char    *memory;
    uint64_t used, room;
} arena;

static void *arena_allocate(void *user, uint64_t bytes) {
    arena *a = (arena *)user;
    const uint64_t at = a->used, rounded = (bytes + 63) / 64 * 64;
    if (rounded > a->room - at) return NULL;
    a->used += rounded;
    return a->memory + at;
}

static void arena_release(void *user, void *pointer, uint64_t bytes) { /* all at once, when the body is gone */
    (void)user;
    (void)pointer;
    (void)bytes;
}

static double unit(uint64_t *state) { /* uniform in [0, 1), the same on every machine */
    uint64_t z = (*state += UINT64_C(0x9E3779B97F4A7C15));
    z = (z ^ (z >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94D049BB133111EB);
    return (double)((z ^ (z >> 31)) >> 11) * (1.0 / 9007199254740992.0);
}

static double now(int32_t threads) { return threads > 1 ? seconds() : (double)clock() / CLOCKS_PER_SEC; }

/* Points on average one per unit of volume; by malloc where there is no arena. */
static peri_body *cloud(int32_t space, int32_t precision, int32_t threads, int64_t points, arena *from) {
    const int dim = space == PERI_SPACE_SOLID ? 3 : 2;
    const double edge = pow((double)points, 1.0 / dim);
    double *x = (double *)malloc((size_t)(points * dim) * sizeof *x), *volume = (double *)malloc((size_t)points * sizeof *volume);
    uint64_t state = 1;
    peri_body_desc desc;
    peri_material_desc material;
    peri_body *body = NULL;
    if (!x || !volume) exit(1);
    for (int64_t k = 0; k < points * dim; ++k) x[k] = edge * unit(&state);
    for (int64_t k = 0; k < points; ++k) volume[k] = 1.0;
    peri_body_desc_init(&desc);
    desc.space = space;
    desc.precision = precision;
    desc.threads = threads;
    desc.horizon = 3.0;
    if (from) {
        desc.allocate = arena_allocate;
        desc.release = arena_release;
        desc.memory_user = from;
        from->used = 0;
    }
    if (peri_body_create(&desc, &body, NULL) < 0) exit(1);
    peri_material_desc_init(&material, PERI_LAW_BOND_BASED);
    material.young = material.density = 1.0;
    need(body, peri_add_material(body, &material));
    need(body, peri_add_points(body, points, x, volume, 0));
    free(x);
    free(volume);
    return body;
}

/* Seconds of the fastest build. */
static double best_build(int32_t space, int32_t precision, int32_t threads, int64_t points, int64_t repeats, arena *from, int64_t *bonds) {
    double best = 1e300;
    for (int64_t r = 0; r < repeats; ++r) {
        peri_body *body = cloud(space, precision, threads, points, from);
        const double start = now(threads);
        need(body, peri_build(body));
        const double elapsed = now(threads) - start;
        *bonds = peri_entry_count(body);
        if (elapsed < best) best = elapsed;
        peri_body_destroy(body);
    }
    return best;
}

/* Seconds in which the system makes the pages of so many bytes, at best. */
static double best_pages(uint64_t bytes, int64_t repeats) {
    double best = 1e300;
    for (int64_t r = 0; r < repeats; ++r) {
        const double start = now(1);
        volatile char *memory = (volatile char *)malloc((size_t)bytes);
        if (!memory) exit(1);
        for (uint64_t k = 0; k < bytes; k += 4096) memory[k] = 1;
        if (now(1) - start < best) best = now(1) - start;
        free((void *)(uintptr_t)memory);
    }
    return best;
}

static void run_case(int32_t space, int32_t precision, int32_t threads, int64_t points, int64_t repeats) {
    arena warm = { NULL, 0, UINT64_C(2800) * (uint64_t)points + 2000000 };
    int64_t bonds = 1;
    const double fresh = best_build(space, precision, threads, points, repeats, NULL, &bonds);
    warm.memory = (char *)malloc((size_t)warm.room);
    if (!warm.memory) exit(1);
    memset(warm.memory, 1, (size_t)warm.room);
    const double again = best_build(space, precision, threads, points, repeats, &warm, &bonds);
    const uint64_t bytes = warm.used;
    free(warm.memory);
    printf("%s %s %8lld %7d %12.1f %8.2f %8.2f %8.2f\n", space == PERI_SPACE_SOLID ? "3D" : "2D",
           precision == PERI_PRECISION_DOUBLE ? "f64" : "f32", (long long)points, (int)threads, (double)bonds / (double)points,
               fresh * 1e9 / (double)bonds,
           best_pages(bytes, repeats) * 1e9 / (double)bonds, again * 1e9 / (double)bonds);
    (void)fflush(stdout);
}

int main(int argc, char **argv) {
    const int64_t repeats = argc > 1 ? atol(argv[1]) : 7;
    printf("\nBuild of random clouds, ns per directed bond\n         points threads bonds/point    fresh    pages     warm\n");
    for (int64_t points = 10000; points <= 1000000; points *= 10)
        run_case(PERI_SPACE_SOLID, PERI_PRECISION_DOUBLE, 1, points, repeats);
    for (int64_t points = 10000; points <= 1000000; points *= 10)
        run_case(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, 1, points, repeats);
    run_case(PERI_SPACE_SOLID, PERI_PRECISION_SINGLE, 1, 1000000, repeats);
    run_case(PERI_SPACE_SOLID, PERI_PRECISION_DOUBLE, 2, 1000000, repeats);
    return 0;
}
