/* SPDX-License-Identifier: MIT */
/* world_crowd.h - a world of four brittle tiles that fly into each other. */
#ifndef WORLD_CROWD_H
#define WORLD_CROWD_H

#include "pool.h"
#include "world_scene.h"

enum { BODIES = 4 };

typedef struct crowd {
    peri_world *world;
    peri_body  *body[BODIES];
} crowd;

/* A tablet of brittle bars that fly into each other, of two precisions and horizons, and break. */
static inline void crowd_make(crowd *c, pool *p, peri_parallel_for_fn jobs, int threads) {
    peri_world_desc d;
    peri_contact_desc contact;
    peri_world_desc_init(&d);
    if (p) d.allocate = pool_take, d.release = pool_give, d.memory_user = p;
    CHECK(peri_world_create(&d, &c->world, NULL) == PERI_OK);
    for (int k = 0; k < BODIES; ++k) {
        bars s = bars_of(2, 2 + k % 2, 8, 8);
        const double v[2] = {k % 2 ? -40 : 40, k / 2 ? -30 : 30};
        const double way[2] = {k % 2 * 8.3 * s.spacing, k / 2 * 8.3 * s.spacing};
        s.material.fracture_energy = 0.3;
        s.desc.precision = k == 3 ? PERI_PRECISION_SINGLE : PERI_PRECISION_DOUBLE;
        s.desc.parallel_for = jobs;
        s.desc.threads = threads;
        c->body[k] = bar_at(&s, 0, 0);
        (void)MUST(c->body[k], peri_add_displacement(c->body[k], PERI_ALL, way));
        (void)MUST(c->body[k], peri_add_velocity(c->body[k], PERI_ALL, v));
        (void)world_must(c->world, peri_world_add(c->world, c->body[k]));
    }
    peri_contact_desc_init(&contact);
    contact.friction = 0.2;
    contact.restitution = 0.5;
    (void)world_must(c->world, peri_world_set_contact(c->world, NULL, NULL, &contact));
}

static inline void crowd_drop(crowd *c) {
    peri_body_destroy(c->body[0]);
    peri_world_destroy(c->world);
    for (int k = 1; k < BODIES; ++k) peri_body_destroy(c->body[k]);
}

static inline int same_crowd(const crowd *a, const crowd *b) {
    int same = 1;
    for (int k = 0; k < BODIES; ++k) same = same && same_motion(a->body[k], b->body[k]) && peri_time(a->body[k]) == peri_time(b->body[k]);
    return same;
}

static inline int64_t broken(const crowd *c) {
    int64_t sum = 0;
    for (int k = 0; k < BODIES; ++k) sum += peri_broken_count(c->body[k]);
    return sum;
}

#endif
