/* SPDX-License-Identifier: MIT */
/* parallel.c - the one door to threads: a loop over blocks of PERI_BLOCK points.
   A task writes only what belongs to its own points and its own peri__sums; totals are then summed over blocks in order.
   So the bits do not depend on the number of threads, nor on who schedules them. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

/* A loop of less work than this, in bonds (about 100 us), is done by the calling thread: on a busy machine every loop that wakes threads
   waits until each of them has been let in. Blocks are handed out four at a time, so that a thread which the machine takes away holds
   up the others by four blocks and not by its share. */
#define PERI_THREAD_WORK 100000

typedef void (*peri__block_fn)(void *context, int64_t begin, int64_t end, peri__sums *sums);

typedef struct peri__loop {
    peri__block_fn fn;
    void          *context;
    int64_t        points;
    peri__sums    *sums;
    const uint8_t *skip; /* [blocks] 1: left out; or NULL                                                                 */
} peri__loop;

static void peri__block_task(void *context, int64_t k) {
    const peri__loop *loop = (const peri__loop *)context;
    peri__sums sums = { 0.0, 0.0, 0, -1 };
    if (!loop->skip || !loop->skip[k])
        loop->fn(loop->context, k * PERI_BLOCK, peri__min((k + 1) * PERI_BLOCK, loop->points), &sums);
    if (loop->sums) loop->sums[k] = sums;
}

/* Runs fn over the blocks of [0, points) that are not to be skipped. cost: work per point, in bonds. sums is [blocks], or NULL where totals
   are not needed. */
static void peri__for_blocks(const peri_body *b, int64_t points, int64_t cost, peri__block_fn fn, void *context,
                             peri__sums *sums, const uint8_t *skip) {
    peri__loop loop;
    int64_t blocks = (points + PERI_BLOCK - 1) / PERI_BLOCK;
    loop.fn = fn;
    loop.context = context;
    loop.points = points;
    loop.sums = sums;
    loop.skip = skip;
    int threaded = points * cost >= PERI_THREAD_WORK;
    if (threaded && b->desc.parallel_for) {
        const int32_t former = peri__enter(b, PERI__IN_CALLBACK); /* the hook may not change the body, whoever called */
        b->desc.parallel_for(b->desc.parallel_user, blocks, peri__block_task, &loop);
        peri__leave(b, former);
        return;
    }
#if defined(_OPENMP) && !defined(PERI_NO_OPENMP)
    if (threaded && b->desc.threads != 1) {
        int threads = b->desc.threads > 0 ? (int)b->desc.threads : omp_get_max_threads();
#pragma omp parallel for schedule(dynamic, 4) num_threads(threads)
        for (int64_t k = 0; k < blocks; ++k) peri__block_task(&loop, k);
        return;
    }
#endif
    for (int64_t k = 0; k < blocks; ++k) peri__block_task(&loop, k);
}

static void peri__for_points(const peri_body *b, int64_t points, int64_t cost, peri__block_fn fn, void *context, peri__sums *sums) {
    peri__for_blocks(b, points, cost, fn, context, sums, NULL);
}

/* The sum of PERI_BLOCK numbers, by halves, which are lost: the order does not depend on the width of vectors, and errors stay small. */
PERI_VECTOR_CODE PERI_SHARED double peri__add_up(double *part) {
    PERI_NO_CONTRACTION
    for (int half = PERI_BLOCK / 2; half > 0; half /= 2)
        for (int k = 0; k < half; ++k) part[k] += part[k + half];
    return part[0];
}

static peri__sums peri__total(const peri__sums *sums, int64_t points) {
    peri__sums total;
    int64_t blocks = (points + PERI_BLOCK - 1) / PERI_BLOCK;
    memset(&total, 0, sizeof total);
    total.bad = -1;
    for (int64_t k = 0; k < blocks; ++k) {
        total.a += sums[k].a;
        total.b += sums[k].b;
        total.n += sums[k].n;
        if (total.bad < 0) total.bad = sums[k].bad;
    }
    return total;
}
