/* SPDX-License-Identifier: MIT */
// cxx_throws.cpp - callbacks in C++11 that throw, out of a library compiled as C. It must be compiled with -fexceptions, so that the
// exception finds its way through its frames. SOURCE OF TRUTH: peri.h (a body left by an exception is unlocked, then read, reset or
// destroyed), conservation of blocks, and an untouched body: after peri_reset the other moves bit by bit as that.
#include "../peri.h"
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <vector>

static long blocks;
static void *take(void *, uint64_t bytes) { return ++blocks, std::malloc(static_cast<std::size_t>(bytes)); }
static void give(void *, void *pointer, uint64_t) { --blocks, std::free(pointer); }

static bool thrown; // callbacks throw
static int32_t maybe() {
    if (thrown) throw std::runtime_error("from a callback");
    return 0;
}
static int32_t load(void *, double time, int64_t count, const int32_t *, double *value) {
    for (int64_t k = 0; k < count; ++k) value[2 * k] = 1e-3 * time;
    return maybe();
}
static int32_t frame(void *, peri_body *) { return maybe(); }
static int32_t iteration(void *, int64_t, double) { return maybe(); }
static int32_t influence(void *, double q, double *w) { return *w = 1 - 0.5 * q, maybe(); }
static int32_t point(void *, int64_t, const double *) { return maybe() + 1; }
static int32_t pairs(void *, int32_t, int32_t, const double *, const double *) { return maybe(); }
static int32_t write_all(void *, const void *, int64_t) { return maybe(); }

static peri_body *start() {
    const double lo[2] = {0, 0}, hi[2] = {9, 6};
    peri_body_desc d;
    peri_material_desc m;
    peri_body *body = nullptr;
    peri_body_desc_init(&d);
    d.space = PERI_SPACE_PLANE_STRESS;
    d.horizon = 2.2;
    d.influence = PERI_INFLUENCE_USER;
    d.influence_fn = influence;
    d.allocate = take;
    d.release = give;
    if (peri_body_create(&d, &body, nullptr) < 0) std::exit(2);
    peri_material_desc_init(&m, PERI_LAW_BOND_BASED);
    m.young = m.density = 1;
    if (peri_add_box(body, peri_add_material(body, &m), lo, hi, 1) != 54) std::exit(3);
    return body;
}
static int64_t act(peri_body *body, int which) {
    const double none[2] = {0, 0};
    peri_advance_desc a;
    peri_solve_desc s;
    switch (which) {
    case 0: return peri_build(body);
    case 1: return peri_apply_body_force(body, PERI_ALL, none, load, nullptr);
    case 2: return peri_select_if(body, nullptr, point, nullptr);
    case 3: return peri_cut_if(body, PERI_CUT_INITIAL, pairs, nullptr);
    case 4: return peri_export_vtu_to(body, write_all, nullptr);
    case 5:
        peri_solve_desc_init(&s);
        s.loose = PERI_LOOSE_BALANCED;
        s.on_iteration = iteration;
        return peri_solve(body, &s, nullptr);
    default:
        peri_advance_desc_init(&a);
        a.steps = 20;
        if (which == 6) a.on_frame = frame;
        return peri_advance(body, &a);
    }
}

int main() {
    int failed = 0;
    for (int which = 0; which < 8; ++which) {
        peri_body *body[2] = {start(), start()};
        std::vector<double> u[2];
        for (int step = 0; step < 8; ++step) {
            const bool thrower = step == which && step != 1; // adding a load asks it nothing
            bool caught = false;
            thrown = thrower;
            try {
                if (thrower) (void)act(body[0], step);
            } catch (const std::runtime_error &) {
                caught = true;
            }
            thrown = false;
            if (caught != thrower) ++failed;
            if (caught && peri_unlock(body[0]) != PERI_OK) ++failed;
            for (int k = 0; k < 2; ++k) {
                if (step > 4 && peri_reset(body[k]) != PERI_OK) ++failed;
                if (act(body[k], step) < 0) ++failed;
            }
        }
        for (int k = 0; k < 2; ++k) {
            u[k].resize(108);
            if (peri_get_field(body[k], PERI_FIELD_DISPLACEMENT, u[k].data(), 108) != PERI_OK) ++failed;
            peri_body_destroy(body[k]);
        }
        if (u[0] != u[1] || u[0][0] == 0.0 || blocks != 0) ++failed;
    }
    std::printf("cxx_throws: %d passed, %d failed\n", failed ? 0 : 1, failed);
    return failed;
}
