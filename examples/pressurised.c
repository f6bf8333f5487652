/* SPDX-License-Identifier: MIT */
/* pressurised.c - fluid at 10 MPa opens a crack 10 m long in rock, far from any boundary: what hydraulic fracturing starts from.

   The crack is a row of cut bonds; peri_apply_pressure loads whatever surface they leave. The exact answer is Westergaard's, with
   z = x + iy, r = sqrt(z^2 - a^2), Z = P (z/r - 1) and its integral Zb = P (r - z):
       2 mu u_x = (1 - 2 nu) Re Zb - y Im Z,   2 mu u_y = 2 (1 - nu) Im Zb - y Re Z,
   and Sneddon's ellipse for the faces, 4 (1 - nu^2) P/E sqrt(a^2 - x^2) apart. The edges of the block are moved by it, so that the block
   acts as if it were infinite. Writes out/pressurised.png: the displacement, 300 times enlarged. */
#include "picture.h"

enum { N = 160 }; /* points along a side of the block, 40 of them along the crack */
static const double A = 5, SIDE = 40, P = 10e6, YOUNG = 30e9, NU = 0.2; /* half the crack, side [m]; pressure, modulus [Pa] */
static double positions[N * N][2], u[N * N][2];
static void westergaard(const double *at, double *value) {
    const double x = fabs(at[0]), y = fabs(at[1]), mu = YOUNG / (2 * (1 + NU)), size = hypot(x - A, y) * hypot(x + A, y);
    const double turn = 0.5 * (atan2(y, x - A) + atan2(y, x + A)), re = sqrt(size) * cos(turn), im = sqrt(size) * sin(turn); /* r */
    const double z_re = P * ((x * re + y * im) / size - 1), z_im = P * (y * re - x * im) / size;
    value[0] = copysign(1, at[0]) * ((1 - 2 * NU) * P * (re - x) - y * z_im) / (2 * mu);
    value[1] = copysign(1, at[1]) * (2 * (1 - NU) * P * (im - y) - y * z_re) / (2 * mu);
}

static int32_t far_field(void *user, double load_factor, int64_t count, const int32_t *points, double *value) {
    int64_t k;
    (void)user;
    (void)load_factor; /* of one step: 1 */
    for (k = 0; k < count; ++k) westergaard(positions[points[k]], &value[2 * k]);
    return 0;
}

static int32_t outside(void *limit, int64_t index, const double *x) {
    return index >= 0 && fmax(fabs(x[0]), fabs(x[1])) > *(const double *)limit;
}

int main(void) {
    const double h = SIDE / N, horizon = 2 * h, lo[2] = {-SIDE / 2, -SIDE / 2}, hi[2] = {SIDE / 2, SIDE / 2};
    const double left[2] = {-A + 1e-6, 0}, right[2] = {A - 1e-6, 0}; /* bonds that only touch the tips stay whole */
    const double near_lo[2] = {-A - 2 * horizon, -2 * horizon}, near_hi[2] = {A + 2 * horizon, 2 * horizon};
    double limit = SIDE / 2 - 2 * horizon, off = 0, all = 0, want[2];
    peri_solve_desc statics;
    peri_body_desc desc;
    peri_material_desc rock;
    int i;

    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_PLANE_STRAIN;
    desc.geometry = PERI_GEOMETRY_LINEAR;
    desc.horizon = horizon;
    desc.influence = PERI_INFLUENCE_POWER_3; /* short-sighted: keeps the tip sharp */
    peri_body *block = must_create(&desc);
    peri_material_desc_init(&rock, PERI_LAW_CORRESPONDENCE);
    rock.young = YOUNG, rock.poisson = NU, rock.density = 2600;
    const int32_t material = must(block, peri_add_material(block, &rock));
    must(block, peri_add_box(block, material, lo, hi, h)), must(block, peri_build(block));
    must(block, peri_get_field(block, PERI_FIELD_POSITION, positions[0], 2 * N * N));
    must(block, peri_cut_segment(block, PERI_CUT_INITIAL, left, right));
    const int32_t crack = must(block, peri_select_box(block, "crack", near_lo, near_hi));
    must(block, peri_apply_pressure(block, crack, P, NULL, NULL));
    const int32_t edge = must(block, peri_select_if(block, "edge", outside, &limit));
    must(block, peri_prescribe_displacement(block, edge, PERI_AXIS_XY, NULL, far_field, NULL));
    peri_solve_desc_init(&statics);
    must(block, peri_solve(block, &statics, NULL));
    must(block, peri_get_field(block, PERI_FIELD_DISPLACEMENT, u[0], 2 * N * N));

    printf("opening [mm]      peri   Westergaard (of these points)   Sneddon (of the faces)\n");
    for (i = (N + 1) * N / 2; i < (N + 1) * N / 2 + 20; i += 4) { /* the row above the crack, from its middle to the tip */
        westergaard(positions[i], want);
        printf("  x = %.3f m %8.3f %8.3f %31.3f\n", positions[i][0], 1e3 * (u[i][1] - u[i - N][1]), 2e3 * want[1],
               4e3 * (1 - NU * NU) * P / YOUNG * sqrt(A * A - positions[i][0] * positions[i][0]));
    }
    for (i = 0; i < N * N; ++i) {
        westergaard(positions[i], want);
        off += pow(u[i][0] - want[0], 2) + pow(u[i][1] - want[1], 2);
        all += want[0] * want[0] + want[1] * want[1];
    }
    printf("all displacements: root mean square error %.2f %%\n", 100 * sqrt(off / all));
    must(block, picture("out/pressurised.png", block, PERI_FIELD_DISPLACEMENT, "displacement [m]", 0, 0, 900, 300));
    peri_body_destroy(block);
    return 0;
}
