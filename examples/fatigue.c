/* SPDX-License-Identifier: MIT */
/* fatigue.c - a crack that grows by cycles of load: the remaining life of bonds (Silling, Askari 2014) in a loop of one's own. A cycle
   takes A strain^m of the life of a bond near the crack; one with none left is cut. A double cantilever, and Paris's exponent out of it.
   cc -O2 examples/fatigue.c peri_impl.c -lm */
#include "example.h"

enum { NX = 56, NY = 16, N = NX * NY, NOTCH = 14, WIDTH = 32, GROWN = 6 };
static const double mm = 1e-3, taken = 1e6, exponent = 4; /* [m], A, m */
static double x[N][2], u[N][2], damage[N], life[N * WIDTH], strain[N * WIDTH];
static int32_t family[N * WIDTH], pairs[2 * N];

static peri_body *cantilever(void) {
    const double lo[2] = {0, 0}, hi[2] = {NX * mm, NY * mm}, from[2] = {0, NY / 2 * mm}, to[2] = {NOTCH * mm, NY / 2 * mm};
    peri_body_desc desc;
    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_PLANE_STRESS, desc.geometry = PERI_GEOMETRY_LINEAR;
    desc.horizon = 3.01 * mm;
    peri_body *body = must_create(&desc);
    peri_material_desc glass;
    peri_material_desc_init(&glass, PERI_LAW_BOND_BASED);
    glass.young = 72e9, glass.density = 2440;
    (void)must(body, peri_add_box(body, must(body, peri_add_material(body, &glass)), lo, hi, mm));
    (void)must(body, peri_build(body));
    (void)must(body, peri_cut_segment(body, PERI_CUT_INITIAL, from, to));
    for (int side = 0; side < 2; ++side) { /* what opens it, from 0 to this and back in each cycle */
        const double corner[2] = {0, (side ? NY - 4 : 0) * mm}, end[2] = {4 * mm, (side ? NY : 4) * mm}, pull[2] = {0, side ? 1e9 : -1e9};
        (void)must(body, peri_apply_body_force(body, must(body, peri_select_box(body, NULL, corner, end)), pull, NULL, NULL));
    }
    return body;
}

/* Strains of the bonds across the line of the crack that are within a horizon of it; the others have 0. Cycles until one has no life. */
static double strains(peri_body *body, int width) {
    double least = HUGE_VAL;
    for (int k = 0; k < N * width; ++k) {
        const int i = k / width, j = family[k];
        strain[k] = 0;
        const int across = i / NX < NY / 2 && j / NX >= NY / 2 && damage[i] + damage[j] > 0;
        if (!across || !must(body, peri_bond_is_intact(body, i, j))) continue;
        const double xi = x[j][0] - x[i][0], yi = x[j][1] - x[i][1];
        strain[k] = fmax(0, (xi * (u[j][0] - u[i][0]) + yi * (u[j][1] - u[i][1])) / (xi * xi + yi * yi));
        least = fmin(least, life[k] / (taken * pow(strain[k], exponent)));
    }
    return least;
}

int main(void) {
    peri_body *body = cantilever();
    const int width = peri_family_width(body);
    double cycles = 0, tip = 0, at[GROWN + 1][2], sum[4] = {0};
    peri_solve_desc solve;
    peri_solve_desc_init(&solve);
    solve.loose = PERI_LOOSE_PINNED;
    (void)must(body, peri_get_field(body, PERI_FIELD_POSITION, x[0], 2 * N));
    (void)must(body, peri_get_families(body, 0, N, family, N * WIDTH));
    for (int k = 0; k < N * width; ++k) life[k] = 1;
    for (int grown = 0, count = 0; grown <= GROWN; count = 0, tip = 0) {
        (void)must(body, peri_solve(body, &solve, NULL));
        (void)must(body, peri_get_field(body, PERI_FIELD_DISPLACEMENT, u[0], 2 * N));
        (void)must(body, peri_get_field(body, PERI_FIELD_DAMAGE, damage, N));
        for (int i = NY / 2 * NX; i < NY / 2 * NX + NX; ++i) tip += damage[i] / damage[NY / 2 * NX + NOTCH / 2]; /* [mm], on the mean */
        if (tip >= NOTCH + 1 + grown) at[grown][0] = cycles, at[grown++][1] = u[N - NX][1] - u[0][1];
        const double next = strains(body, width); /* cycles until the next bond is cut, and those that are as good as */
        for (int k = 0; k < N * width; ++k) {
            life[k] -= strain[k] > 0 ? next * taken * pow(strain[k], exponent) : 0;
            if (strain[k] > 0 && life[k] < 0.03) pairs[2 * count] = k / width, pairs[2 * count++ + 1] = family[k];
        }
        cycles += next;
        (void)must(body, peri_cut_pairs(body, PERI_CUT_NOW, count, pairs));
    }
    for (int k = 0; k < GROWN; ++k) { /* by mm: logs of the growth per cycle and of K, as the root of the growth of the opening */
        const double rate = -log(at[k + 1][0] - at[k][0]), stress = 0.5 * log(at[k + 1][1] - at[k][1]);
        sum[0] += rate / GROWN, sum[1] += stress / GROWN, sum[2] += rate * stress / GROWN, sum[3] += stress * stress / GROWN;
    }
    const double paris = (sum[2] - sum[0] * sum[1]) / (sum[3] - sum[1] * sum[1]);
    printf("fatigue: %d mm in %.3g cycles, exponent of Paris %.2f, of the bonds %.2f\n", GROWN, cycles, paris, exponent);
    peri_body_destroy(body);
    return fabs(paris / exponent - 1) < 0.05 ? EXIT_SUCCESS : EXIT_FAILURE;
}
