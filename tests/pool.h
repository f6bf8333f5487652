/* SPDX-License-Identifier: MIT */
/* pool.h - an allocator that counts and can fail, with memory that is never zero by chance. */
#ifndef POOL_H
#define POOL_H

#include "peri_test.h"

typedef struct pool {
    int64_t blocks, bytes, peak, calls, fail_at; /* fail_at: number of the call that fails, from 0; -1 = none */
    int     wrong;
} pool;

static inline void *pool_take(void *user, uint64_t bytes) {
    pool *p = (pool *)user;
    unsigned char *raw;
    if (p->calls++ == p->fail_at) return NULL;
    raw = (unsigned char *)malloc((size_t)bytes + 16);
    if (!raw) return NULL;
    memset(raw, 0xAA, (size_t)bytes + 16);
    memcpy(raw, &bytes, 8);
    p->blocks++;
    p->bytes += (int64_t)bytes;
    if (p->bytes > p->peak) p->peak = p->bytes;
    return raw + 16;
}
static inline void pool_give(void *user, void *pointer, uint64_t bytes) {
    pool *p = (pool *)user;
    unsigned char *raw = (unsigned char *)pointer - 16;
    uint64_t size;
    if (!pointer) return;
    memcpy(&size, raw, 8);
    if (size != bytes) p->wrong++;
    p->blocks--;
    p->bytes -= (int64_t)size;
    memset(raw, 0x55, (size_t)size + 16);
    free(raw);
}
static inline void hook(peri_body_desc *d, pool *p) {
    d->allocate = pool_take;
    d->release = pool_give;
    d->memory_user = p;
}

#endif
