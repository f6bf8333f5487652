/* SPDX-License-Identifier: MIT */
/* trusses.c - equilibria of bars against closed forms: hinged, hanging, buckling, slender. */
#include "extremes.h"

#define PI 3.14159265358979323846

/* ---- hinged, hanging ---------------------------------------------------------------------------------------------- */

/* A square of 3 x 3 points, held, and more points on one bond to its corner: choice 0, one, pulled along it: k e = F, and what pulls across
   is refused or left out; 1, a square that turns about that corner: loose, whatever is chosen. Bonds of sqrt(2), horizon 1.5. */
static outcome joined(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    const double lo[2] = {-0.5, -0.5}, hi[2] = {2.5, 2.5}, bar = 9 / (PI * pow(1.5, 3)) / sqrt(2.0), pull = 1e-3 * sqrt(0.5);
    const double force[2] = {pull + (row->other > 0 ? 2e-4 : 0), pull - (row->other > 0 ? 2e-4 : 0)};
    int32_t loose, pre;
    for (loose = PERI_LOOSE_REFUSED; loose < peri__end_loose; ++loose)
        for (pre = PERI_PRECONDITIONER_MULTILEVEL; pre < peri__end_preconditioner; ++pre) {
            const int count = row->choice ? 9 : 1;
            double x[18], v[9];
            peri_body_desc d;
            peri_material_desc m;
            peri_body *b = NULL;
            peri_solve_desc st;
            int k;
            extreme_desc(&d, PERI_SPACE_PLANE_STRESS, precision, 1.5);
            d.geometry = PERI_GEOMETRY_LINEAR;
            extreme_material(&m, PERI_LAW_BOND_BASED, 0, 0);
            for (k = 0; k < count; ++k) {
                x[2 * k] = 3 + k % 3;
                x[2 * k + 1] = 3 + k / 3;
                v[k] = 1;
            }
            if (extreme_fails(&o, NULL, peri_body_create(&d, &b, NULL)) || extreme_fails(&o, b, peri_add_material(b, &m))
                || extreme_fails(&o, b, peri_add_box(b, material_id(b, 1), lo, hi, 1))
                || extreme_fails(&o, b, peri_add_points(b, count, x, v, NULL))
                || extreme_fails(&o, b, peri_build(b)))
                return extreme_end(o, b);
            (void)extreme_fails(&o, b, peri_prescribe_displacement(b, extreme_slab(&o, b, 0, -1, 2.5), PERI_AXIS_XY, NULL, NULL, NULL));
            (void)extreme_fails(&o, b, peri_apply_body_force(b, extreme_slab(&o, b, 0, 2.5, 9), force, NULL, NULL));
            peri_solve_desc_init(&st);
            st.loose = loose;
            st.preconditioner = pre;
            if (o.status >= 0) {
                const int32_t code = peri_solve(b, &st, NULL),
                              expected = row->choice || loose == PERI_LOOSE_REFUSED ? PERI_ERROR_LOOSE : PERI_OK;
                peri_error e;
                if (code != expected) extreme_take(&o, HUGE_VAL, "status, loose, preconditioner", -code, loose, pre);
                if (code == PERI_ERROR_LOOSE && (peri_get_error(b, &e) != PERI_OK || e.index < 9))
                    extreme_take(&o, HUGE_VAL, "point", 0, 0, 0);
                if (code == PERI_OK) {
                    double u[20];
                    (void)extreme_fails(&o, b, peri_get_field(b, PERI_FIELD_DISPLACEMENT, u, 20));
                    extreme_take(&o, fabs(u[18] + u[19] - sqrt(2.0) * 1e-3 / bar) / (sqrt(2.0) * 1e-3 / bar),
                                 "along, loose, preconditioner", loose, pre, 0);
                    extreme_take(&o, fabs(u[18] - u[19]) / (1e-3 / bar), "across, loose, preconditioner", loose, pre, 0);
                }
            }
            o = extreme_end(o, b);
        }
    return o;
}

/* ---- a truss that buckles ----------------------------------------------------------------------------------------- */

/* A strut of two bonds, 0 and 2 held and pushed together by 0.1 each, point 1 in the middle on a hundredth of a spring from 3, above it.
   Straight it is in balance, unstable as that is. Under a load of 1e-3 downwards it bows to -v, where 2 k (1 - L) v/L = k v/100 - 1e-3,
   L^2 = 0.81 + v^2. */
static outcome strut(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    const double x[8] = {0, 0, 1, 0, 2, 0, 1, 1}, v[4] = {1, 1, 1, 1}, right[2] = {0.1, 0}, left[2] = {-0.1, 0},
                 spring = 9 / (PI * pow(1.2, 3));
    const int32_t ends[3] = {0, 2, 3}, middle = 1;
    const double push[2] = {0, -1e-3};
    double low = 0.1, high = 0.5, u[8] = {0};
    peri_body_desc d;
    peri_material_desc m;
    peri_body *b = NULL;
    peri_solve_desc s;
    int k;
    extreme_desc(&d, PERI_SPACE_PLANE_STRESS, precision, 1.2);
    extreme_material(&m, PERI_LAW_BOND_BASED, 0, 0);
    if (extreme_fails(&o, NULL, peri_body_create(&d, &b, NULL)) || extreme_fails(&o, b, peri_add_material(b, &m))) return extreme_end(o, b);
    (void)extreme_fails(&o, b, peri_add_material(b, &m));
    m.young = 0.01;
    (void)extreme_fails(&o, b, peri_set_interface(b, material_id(b, 1), material_id(b, 2), &m));
    const int32_t strut_id = material_id(b, 1), of[4] = {strut_id, strut_id, strut_id, material_id(b, 2)};
    (void)extreme_fails(&o, b, peri_add_points(b, 4, x, v, of));
    if (o.status >= 0) (void)extreme_fails(&o, b, peri_build(b));
    if (o.status < 0) return extreme_end(o, b);
    (void)extreme_fails(&o, b, peri_prescribe_displacement(b, peri_select_points(b, NULL, 3, ends), PERI_AXIS_XY, NULL, NULL, NULL));
    (void)extreme_fails(&o, b, peri_prescribe_displacement(b, peri_select_points(b, NULL, 1, &ends[0]), PERI_AXIS_X, right, NULL, NULL));
    (void)extreme_fails(&o, b, peri_prescribe_displacement(b, peri_select_points(b, NULL, 1, &ends[1]), PERI_AXIS_X, left, NULL, NULL));
    if (row->choice) (void)extreme_fails(&o, b, peri_apply_body_force(b, peri_select_points(b, NULL, 1, &middle), push, NULL, NULL));
    peri_solve_desc_init(&s);
    s.steps = 10;
    if (o.status >= 0) (void)extreme_fails(&o, b, peri_solve(b, &s, NULL));
    if (o.status >= 0) (void)extreme_fails(&o, b, peri_get_field(b, PERI_FIELD_DISPLACEMENT, u, 8));
    for (k = 0; k < 60; ++k) {
        const double y = 0.5 * (low + high), length = sqrt(0.81 + y * y);
        if (2 * spring * (1 - length) * y / length - 0.01 * spring * y + 1e-3 > 0) low = y;
        else high = y;
    }
    extreme_take(&o, fabs(u[3] + (row->choice ? low : 0)) / low, "bow", 0, 0, 0);
    extreme_take(&o, fabs(u[2]), "aside", 0, 0, 0);
    return extreme_end(o, b);
}

/* ---- slender ------------------------------------------------------------------------------------------------------ */

/* Two rows of 1000 points, horizon 1.5: chords and posts k = c, braces k/sqrt(2). Pulled by P at the end: posts shorten by v,
   -v (k + kd) = kd e, P = 2 k e + kd (e + v) per cell. Bent by F at the end, held to 1.5: F L^3/(3 k/2), to the end effects of 2/L. */
static outcome slender(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    const double k = 9 / (PI * pow(1.5, 3)), kd = k / sqrt(2.0), load = 1e-9, pull[2] = {load, 0}, bend[2] = {0, load}, length = 998;
    const double lo[2] = {0, 0}, hi[2] = {1000, 2};
    const int within = row->choice == 0 ? precision != PERI_PRECISION_SINGLE : precision == PERI_PRECISION_DOUBLE;
    double *u = NULL;
    peri_body_desc d;
    peri_material_desc m;
    peri_body *b = NULL;
    peri_solve_desc st;
    int32_t code;
    extreme_desc(&d, PERI_SPACE_PLANE_STRESS, precision, 1.5);
    d.geometry = PERI_GEOMETRY_LINEAR;
    extreme_material(&m, PERI_LAW_BOND_BASED, 0, 0);
    if (extreme_fails(&o, NULL, peri_body_create(&d, &b, NULL)) || extreme_fails(&o, b, peri_add_material(b, &m))) return extreme_end(o, b);
    (void)extreme_fails(&o, b, peri_add_box(b, material_id(b, 1), lo, hi, 1));
    if (o.status >= 0 && !extreme_fails(&o, b, peri_build(b))) {
        (void)extreme_fails(&o, b, peri_prescribe_displacement(b, extreme_slab(&o, b, 0, 0, 2), PERI_AXIS_XY, NULL, NULL, NULL));
        (void)extreme_fails(&o, b, peri_apply_body_force(b, extreme_slab(&o, b, 0, 999, 1000), row->choice ? bend : pull, NULL, NULL));
    }
    peri_solve_desc_init(&st);
    if (row->choice) st.tolerance = 1e-4;
    st.preconditioner = (int32_t)row->value;
    st.iterations = 6000;
    if (o.status >= 0) {
        code = peri_solve(b, &st, NULL);
        if (within) (void)extreme_fails(&o, b, code);
        else if (code != PERI_ERROR_CONVERGENCE && code != PERI_OK) (void)extreme_fails(&o, b, code);
        u = extreme_read(&o, b, PERI_FIELD_DISPLACEMENT);
        if (u && row->choice == 0) {
            const double v = -kd / (k + kd), want = 2 * load / (2 * k + kd * (1 + v)) * 500;
            extreme_take(&o, fabs((u[2 * 750] - u[2 * 250]) / want - 1), "elongation", 0, 0, 0);
            extreme_take(&o, fabs((u[2 * 1500] - u[2 * 500] - (u[2 * 1501] - u[2 * 501])) / want), "sides", 0, 0, 0);
        } else if (u && code == PERI_OK) /* two points of the load at the end */
            extreme_take(&o, fabs(u[2 * 999 + 1] / (2 * load * pow(length, 3) / (1.5 * k)) - 1), "deflection", 0, 0, 0);
        free(u);
    }
    return extreme_end(o, b);
}

/* ---- rows --------------------------------------------------------------------------------------------------------- */

#define NONE {0, 0, 0}

static const extreme rows[] = {
    {"a point on one bond, pulled along it", "c V^2/|xi| e = F", joined, 0, 0, 0, PERI_OK, NULL, {1e-8, 1e-5, 1e-4}},
    {"a point on one bond, pulled aslant", "c V^2/|xi| e = F; peri.h: the force on what is not resisted is left out", joined, 0, 1, 0,
     PERI_OK, NULL, {1e-8, 1e-5, 1e-4}},
    {"a square on one bond", "peri.h: hinges are found, whatever is chosen", joined, 0, 1, 1, PERI_OK, NULL, NONE},
    {"a straight strut, pushed together", "peri.h: it stays straight until something pushes it aside", strut, 0, 0, 0, PERI_OK, NULL, NONE},
    {"the same, with a push aside", "its equation of balance, by bisection", strut, 0, 0, 1, PERI_OK, NULL, {1e-6, 1e-3, 1e-2}},
    {"a strip 1 : 500 points, pulled", "a truss of chords, posts and braces", slender, PERI_PRECONDITIONER_MULTILEVEL, 0, 0, PERI_OK, NULL,
     {1e-6, 1e-3, 1e-2}},
    {"the same, block Jacobi", "a truss of chords, posts and braces", slender, PERI_PRECONDITIONER_BLOCK_JACOBI, 0, 0, PERI_OK, NULL,
     {1e-6, 1e-3, 1e-2}},
    {"a strip 1 : 500 points, bent", "F L^3/(3 E I) of two chords, E I = k/2", slender, PERI_PRECONDITIONER_MULTILEVEL, 0, 1, PERI_OK, NULL,
     {0.01, 0.01, 0.01}},
};
const extreme_table extreme_trusses = EXTREME_TABLE("trusses", rows);
