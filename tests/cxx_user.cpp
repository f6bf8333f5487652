/* SPDX-License-Identifier: MIT */
// cxx_user.cpp - a C++11 program that includes peri.h and links with the library compiled as C: declarations, enums, callbacks
// from lambdas. SOURCE OF TRUTH: free fall is a parabola, u = b t^2/(2 rho), which the integrator follows exactly.
#include "../peri.h"
#include <cmath>
#include <cstdio>
#include <memory>
#include <vector>

struct destroyer {
    void operator()(peri_body *body) const { peri_body_destroy(body); }
};

int main() {
    int failed = 0;
    const double lo[3] = {0, 0, 0}, hi[3] = {0.4, 0.3, 0.3}, b[3] = {0, 0, -9.81 * 2};
    peri_body_desc desc;
    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_SOLID;
    desc.horizon = 0.25;
    peri_body *raw = nullptr;
    peri_error error;
    if (peri_body_create(&desc, &raw, &error) != PERI_OK) return 1;
    std::unique_ptr<peri_body, destroyer> body(raw);
    peri_material_desc m;
    peri_material_desc_init(&m, PERI_LAW_BOND_BASED);
    m.young = 3;
    m.density = 2;
    const int32_t id = peri_add_material(body.get(), &m);
    if (peri_add_box(body.get(), id, lo, hi, 0.1) != 36 || peri_build(body.get()) != PERI_OK) return 2;
    if (peri_apply_body_force(body.get(), PERI_ALL, b, nullptr, nullptr) < 0) return 3;
    int frames = 0;
    peri_advance_desc run;
    peri_advance_desc_init(&run);
    run.duration = 1.0;
    run.frame_steps = 5;
    run.user = &frames;
    run.on_frame = [](void *user, peri_body *) -> int32_t { return ++*static_cast<int *>(user), 0; };
    if (peri_advance(body.get(), &run) != PERI_OK) return 4;
    std::vector<double> u(static_cast<std::size_t>(peri_size_of_field(body.get(), PERI_FIELD_DISPLACEMENT)));
    if (peri_get_field(body.get(), PERI_FIELD_DISPLACEMENT, u.data(), static_cast<int64_t>(u.size())) != PERI_OK) return 5;
    for (std::size_t k = 0; k < u.size(); ++k) {
        const double want = k % 3 == 2 ? -0.5 * 9.81 : 0.0;
        if (!(std::fabs(u[k] - want) <= 1e-12 * std::fabs(want) + 1e-12)) ++failed;
    }
    if (frames < 2 || u.size() != 108) ++failed;
    std::printf("cxx_user: %d passed, %d failed\n", failed ? 0 : 1, failed);
    return failed;
}
