/* SPDX-License-Identifier: MIT */
/* ranks.h - parts of one body, a thread each, joined by hooks that copy between them: what MPI would do, without it. A part that waits
   longer than RANKS_PATIENCE for the others is let go, and the meeting has failed. */
#ifndef RANKS_H
#define RANKS_H

#include <pthread.h>
#include <time.h>

#include "specimen.h"

#define RANKS_MOST 4
#define RANKS_PATIENCE 20 /* s */

typedef struct world {
    pthread_mutex_t lock;
    pthread_cond_t  all;
    int             ranks, there, turn, hung;
    double         *values[RANKS_MOST];
    void *const    *plane[RANKS_MOST];
    int64_t         messages, bytes; /* sent by exchanges                                                                  */
    int64_t         exchanges, reductions; /* of rank 0                                                                    */
} world;

typedef struct rank {
    world   *w;
    int      rank;
    int32_t *owner, *there; /* of ghost k: which rank owns it, and as which point                                           */
    int32_t *ghost;
    int64_t  ghosts, points;
    int64_t *ids;
    int      fail_exchange; /* > 0: so many exchanges from now one fails                                                   */
    int      from[RANKS_MOST];
} rank;

/* 0 when all are here; 1 where some did not come. */
static inline int world_meet(world *w) {
    struct timespec until = {time(NULL) + RANKS_PATIENCE, 0};
    (void)pthread_mutex_lock(&w->lock);
    const int turn = w->turn;
    if (++w->there == w->ranks) {
        w->there = 0;
        w->turn++;
        (void)pthread_cond_broadcast(&w->all);
    }
    while (turn == w->turn && !w->hung)
        if (pthread_cond_timedwait(&w->all, &w->lock, &until) != 0) w->hung = 1;
    const int hung = w->hung;
    (void)pthread_mutex_unlock(&w->lock);
    return hung;
}

static inline int32_t rank_exchange(void *user, int32_t type, int32_t planes, void **plane) {
    rank *r = (rank *)user;
    world *w = r->w;
    const size_t size = type == PERI_TYPE_F32 ? 4 : 8;
    w->plane[r->rank] = plane;
    if (world_meet(w)) return -99;
    for (int64_t k = 0; k < r->ghosts; ++k)
        for (int32_t d = 0; d < planes; ++d)
            memcpy((char *)plane[d] + (size_t)r->ghost[k] * size, (char *)w->plane[r->owner[k]][d] + (size_t)r->there[k] * size, size);
    (void)pthread_mutex_lock(&w->lock);
    for (int n = 0; n < w->ranks; ++n) w->messages += r->from[n];
    w->bytes += r->ghosts * planes * (int64_t)size;
    w->exchanges += r->rank == 0;
    (void)pthread_mutex_unlock(&w->lock);
    if (world_meet(w)) return -99;
    return r->fail_exchange > 0 && --r->fail_exchange == 0 ? -5 : 0;
}

static inline int32_t rank_reduce(void *user, int32_t reduction, int64_t count, double *values) {
    rank *r = (rank *)user;
    world *w = r->w;
    double total[16];
    if (count > 16) return -98;
    w->values[r->rank] = values;
    if (world_meet(w)) return -99;
    memcpy(total, w->values[0], (size_t)count * sizeof *total);
    for (int n = 1; n < w->ranks; ++n)
        for (int64_t k = 0; k < count; ++k)
            if (reduction == PERI_REDUCTION_SUM) total[k] += w->values[n][k];
            else if (w->values[n][k] > total[k]) total[k] = w->values[n][k];
    w->reductions += r->rank == 0;
    if (world_meet(w)) return -99;
    memcpy(values, total, (size_t)count * sizeof *total);
    return world_meet(w) ? -99 : 0;
}

/* Which points of x[count][dim] part `own` has: 1 its own, 2 ghosts, up to `reach` away from one of its own. Fills r; returns how many. */
static inline int64_t rank_take(rank *r, const double *x, int64_t count, int32_t dim, const int *part, double reach, uint8_t *take) {
    int32_t *local = (int32_t *)malloc((size_t)(count * RANKS_MOST) * sizeof *local);
    int64_t  points[RANKS_MOST] = {0}, g = 0;
    memset(take, 0, (size_t)count);
    for (int own = 0; own < r->w->ranks; ++own) /* where every rank has each point */
        for (int64_t i = 0; i < count; ++i) {
            int within = part[i] == own;
            for (int64_t j = 0; j < count && !within; ++j) {
                double square = 0;
                if (part[j] != own) continue;
                for (int32_t d = 0; d < dim; ++d) square += (x[i * dim + d] - x[j * dim + d]) * (x[i * dim + d] - x[j * dim + d]);
                within = square < reach * reach;
            }
            local[own * count + i] = within ? (int32_t)points[own]++ : -1;
            if (own == r->rank && within) take[i] = part[i] == own ? 1 : 2;
        }
    r->points = points[r->rank];
    r->ids = (int64_t *)calloc((size_t)r->points, sizeof *r->ids);
    r->ghost = (int32_t *)calloc((size_t)r->points, sizeof *r->ghost);
    r->owner = (int32_t *)calloc((size_t)r->points, sizeof *r->owner);
    r->there = (int32_t *)calloc((size_t)r->points, sizeof *r->there);
    for (int64_t i = 0; i < count; ++i) {
        if (!take[i]) continue;
        r->ids[local[r->rank * count + i]] = i;
        if (take[i] == 1) continue;
        r->ghost[g] = local[r->rank * count + i];
        r->owner[g] = part[i];
        r->from[part[i]] = 1;
        r->there[g++] = local[part[i] * count + i];
    }
    r->ghosts = g;
    free(local);
    return r->points;
}

static inline void rank_free(rank *r) { free(r->ids), free(r->ghost), free(r->owner), free(r->there); }

/* Runs work(ranks + k) on a thread each. */
static inline void world_run(world *w, rank *ranks, size_t size, void *(*work)(void *)) {
    pthread_t thread[RANKS_MOST];
    (void)pthread_mutex_init(&w->lock, NULL);
    (void)pthread_cond_init(&w->all, NULL);
    for (int k = 0; k < w->ranks; ++k) CHECK(pthread_create(&thread[k], NULL, work, (char *)ranks + (size_t)k * size) == 0);
    for (int k = 0; k < w->ranks; ++k) CHECK(pthread_join(thread[k], NULL) == 0);
    (void)pthread_mutex_destroy(&w->lock);
    (void)pthread_cond_destroy(&w->all);
    CHECK(!w->hung);
}

#endif
