/* SPDX-License-Identifier: MIT */
/* portable.c - the library in one file with a small program, for the compilers and C libraries of tests/check_hygiene.sh; on Windows after
   windows.h. SOURCE OF TRUTH: free fall is a parabola, u = b t^2/(2 rho), which the integrator follows exactly. */
#if defined(WINDOWS_MACROS)
#include "windows_macros.h"
#elif defined(_WIN32)
#include <windows.h>
#endif
#define PERI_IMPLEMENTATION
#include "../peri.h"
#include <stdio.h>

int main(void) {
    const double lo[2] = {0, 0}, hi[2] = {0.4, 0.3}, b[2] = {0, -9.81 * 2};
    double u[12][2], worst = 0;
    int32_t id;
    peri_body_desc desc;
    peri_material_desc m;
    peri_advance_desc run;
    peri_body *body;

    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_PLANE_STRESS;
    desc.horizon = 0.25;
    if (peri_body_create(&desc, &body, NULL) < 0) return 1;
    peri_material_desc_init(&m, PERI_LAW_BOND_BASED);
    m.young = 3;
    m.density = 2;
    id = peri_add_material(body, &m);
    if (peri_add_box(body, id, lo, hi, 0.1) != 12 || peri_build(body) < 0) return 2;
    if (peri_apply_body_force(body, PERI_ALL, b, NULL, NULL) < 0) return 3;
    peri_advance_desc_init(&run);
    run.duration = 1;
    if (peri_advance(body, &run) < 0 || peri_get_field(body, PERI_FIELD_DISPLACEMENT, u[0], 24) < 0) return 4;
    for (int k = 0; k < 12; ++k) worst = fmax(worst, fmax(fabs(u[k][0]), fabs(u[k][1] + 0.5 * 9.81)));
    peri_body_destroy(body);
    printf("portable: off by %.1e\n", worst);
    return !(worst <= 1e-11);
}
