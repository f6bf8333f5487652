/* SPDX-License-Identifier: MIT */
/* scene.h - a body of a case row, harm done to it, and steps taken with it, by the public API: included where the library is linked
   (runs.c) and where it is compiled in (cases.c). */
#ifndef SCENE_H
#define SCENE_H

#include "suite.h"

/* splitmix64 of a number: the same scenes on every machine. */
static inline uint64_t scene_hash(uint64_t z) {
    z += UINT64_C(0x9E3779B97F4A7C15);
    z = (z ^ (z >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94D049BB133111EB);
    return z ^ (z >> 31);
}

/* Displacements of up to 1e-3 spacings, every point its own: strains of the order at which brittle solids break. */
static inline void scene_shake(peri_body *body) {
    const int64_t size = peri_size_of_field(body, PERI_FIELD_DISPLACEMENT);
    double *u = doubles(size);
    for (int64_t k = 0; k < size; ++k) u[k] = 1e-3 * ((double)(scene_hash((uint64_t)k) >> 11) / 4503599627370496.0 - 1.0);
    need(body, peri_set_field(body, PERI_FIELD_DISPLACEMENT, u, size));
    free(u);
}

/* Young's modulus, density and spacing 1, Poisson's ratio 0.3 where it is free, all else by default. NULL where the library refuses the
   precision. Without a ledger, which costs nothing per step here, but an energy pass whenever displacements are written. */
static inline peri_body *scene_build(const bench_case *c, bench_facts *facts) {
    const double lo[3] = { 0, 0, 0 }, hi[3] = { (double)c->edge[0], (double)c->edge[1], (double)c->edge[2] };
    peri_body_desc desc;
    peri_material_desc material;
    peri_body *body = NULL;
    const uint64_t before = bytes_now;
    double start;
    memset(facts, 0, sizeof *facts);
    peri_body_desc_init(&desc);
    desc.space = c->space;
    desc.precision = c->precision;
    desc.geometry = c->geometry;
    desc.threads = c->threads;
    desc.horizon = c->m;
    desc.ledger = 0;
    desc.allocate = count_allocate;
    desc.release = count_release;
    if (peri_body_create(&desc, &body, NULL) < 0) {
        if (c->precision == PERI_PRECISION_MIXED) return NULL;
        exit(1);
    }
    peri_material_desc_init(&material, c->law);
    if (c->law != PERI_LAW_BOND_BASED) material.poisson = 0.3;
    material.young = 1.0;
    material.density = 1.0;
    material.critical_stretch = c->critical;
    need(body, peri_add_material(body, &material));
    const int32_t id = peri_id(body, PERI_KIND_MATERIAL, 1);
    need(body, c->cloud ? peri_add_perturbed_box(body, id, lo, hi, 1.0, 1.0, 7) : peri_add_box(body, id, lo, hi, 1.0));
    bytes_most = bytes_now;
    start = c->threads == 1 ? processor_seconds() : seconds();
    const int32_t built = peri_build(body);
    if (built < 0 && c->precision == PERI_PRECISION_MIXED) {
        peri_body_destroy(body);
        return NULL;
    }
    need(body, built);
    facts->build = (c->threads == 1 ? processor_seconds() : seconds()) - start;
    facts->points = peri_point_count(body);
    facts->bonds = peri_entry_count(body);
    facts->width = peri_family_width(body);
    facts->peak = (double)(bytes_most - before) / (double)facts->points;
    facts->bytes = (double)(bytes_now - before) / (double)facts->points;
    return body;
}

static inline int32_t scene_harmed(void *user, int32_t i, int32_t j, const double *xi, const double *xj) {
    (void)user;
    (void)xi;
    (void)xj;
    return scene_hash((uint64_t)i << 32 | (uint64_t)j) % 50 == 0;
}

/* Every 50th bond cut by a hash of its ends, and a crack: half of the middle plane (2D: line) of a cube or square. */
static inline void scene_harm(peri_body *body, bench_facts *facts) {
    const int32_t dim = peri_dimension(body);
    const double edge = pow((double)facts->points, 1.0 / dim), middle[3] = { edge / 2, edge / 2, edge / 2 };
    const double up[3] = { 0, 0, 1 }, left[2] = { 0, edge / 2 };
    const uint64_t before = bytes_now;
    need(body, peri_reset(body));
    need(body, peri_cut_if(body, PERI_CUT_INITIAL, scene_harmed, NULL));
    need(body, dim == 2 ? peri_cut_segment(body, PERI_CUT_INITIAL, left, middle)
                        : peri_cut_disc(body, PERI_CUT_INITIAL, middle, up, 0.4 * edge));
    scene_shake(body);
    facts->bytes += ((double)bytes_now - (double)before) / (double)facts->points;
}

/* Seconds that `steps` steps take: of the processor for one thread, else of the wall. */
static inline double scene_steps(peri_body *body, int64_t steps, int32_t threads) {
    peri_advance_desc run;
    double start;
    peri_advance_desc_init(&run);
    run.steps = steps;
    start = threads == 1 ? processor_seconds() : seconds();
    need(body, peri_advance(body, &run));
    return (threads == 1 ? processor_seconds() : seconds()) - start;
}

/* Seconds of one step: the least of `repeats` timings of several, after one that is not counted. */
static inline double scene_best(peri_body *body, int64_t repeats) {
    const int64_t steps = enough_steps(scene_steps(body, 1, 1));
    double best = 1e300;
    for (int64_t r = 0; r < repeats; ++r) {
        const double taken = scene_steps(body, steps, 1) / (double)steps;
        if (taken < best) best = taken;
    }
    return best;
}

#endif
