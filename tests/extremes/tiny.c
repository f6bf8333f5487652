/* SPDX-License-Identifier: MIT */
/* tiny.c - strains, velocities and loads next to nothing, and processors that take denormals for 0.

   SOURCE OF TRUTH: linearity of small strains, exact to the last bit under powers of two; conservation of energy. */
#include "moving.h"

#if defined(__SSE2__) || defined(_M_X64)
#include <xmmintrin.h>
#define FLUSHES
#endif

/* A field without symmetry of size 1e-2, times scale. */
static void waves(outcome *o, peri_body *b, int32_t field, double scale) {
    const int64_t n = peri_size_of_field(b, PERI_FIELD_POSITION);
    double *x = n > 0 ? (double *)malloc((size_t)n * sizeof *x) : NULL;
    int64_t i;
    for (i = 0; x && i < n; ++i) x[i] = (double)(float)(1e-2 * sin(1.7 * (double)i)) * scale;
    if (x) (void)extreme_fails(o, b, peri_set_field(b, field, x, n));
    free(x);
}

/* choice 0: linear geometry, displacements of 1e-2 times 2^-value (where bonds are single: 2^-other): the same bits, smaller. choice 1:
   those of finite geometry against linear. */
static outcome tiny(const extreme *row, int32_t precision) {
    const double scale = ldexp(1, -(int)(precision == PERI_PRECISION_DOUBLE ? row->value : row->other));
    outcome o = {PERI_OK, "", 0};
    int32_t law, space;
    int cloud;
    for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law)
        for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
            for (cloud = 0; cloud < 2 && o.status == PERI_OK; ++cloud) {
                scene s = scene_of(space, precision, law, PERI_GEOMETRY_LINEAR);
                shown large, small;
                peri_body *b;
                s.cloud = cloud;
                b = small_body(&o, &s);
                waves(&o, b, PERI_FIELD_DISPLACEMENT, row->choice ? scale : 1);
                show(&o, b, &large);
                if (row->choice) {
                    o = extreme_end(o, b);
                    s.geometry = PERI_GEOMETRY_NONLINEAR;
                    b = small_body(&o, &s);
                }
                waves(&o, b, PERI_FIELD_DISPLACEMENT, scale);
                show(&o, b, &small);
                compare(&o, row, &s, &large, &small, row->choice ? 1 : scale, "tiny");
                forget(&large);
                forget(&small);
                o = extreme_end(o, b);
            }
    return o;
}

/* Displacements and velocities below the normal range of the state, and a run: no number grows beyond the energy that it began with. */
static outcome denormal(const extreme *row, int32_t precision) {
    const double least = precision == PERI_PRECISION_SINGLE ? ldexp(1, -140) : ldexp(1, -1060);
    outcome o = {PERI_OK, "", 0};
    int32_t law, space;
    for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law)
        for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space && o.status == PERI_OK; ++space) {
            scene s = scene_of(space, precision, law, PERI_GEOMETRY_NONLINEAR);
            peri_body *b;
            peri_advance_desc run;
            double *u, *v;
            int64_t i, n;
            s.stretch = 1e-3;
            b = small_body(&o, &s);
            n = peri_size_of_field(b, PERI_FIELD_DISPLACEMENT);
            waves(&o, b, PERI_FIELD_DISPLACEMENT, least);
            waves(&o, b, PERI_FIELD_VELOCITY, least);
            peri_advance_desc_init(&run);
            run.steps = 50;
            run.damping = 0.01;
            if (o.status == PERI_OK) (void)extreme_fails(&o, b, peri_advance(b, &run));
            u = extreme_read(&o, b, PERI_FIELD_DISPLACEMENT);
            v = extreme_read(&o, b, PERI_FIELD_VELOCITY);
            for (i = 0; u && v && i < n; ++i)
                extreme_note(&o, row, precision, (fabs(u[i]) + fabs(v[i])) / least, "law %d, space %d", (int)law, (int)space);
            if (peri_broken_count(b) != 0) extreme_note(&o, row, precision, NAN, "law %d, space %d: bonds broke", (int)law, (int)space);
            free(u);
            free(v);
            o = extreme_end(o, b);
        }
    return o;
}

/* A body held at one side, under a load (choice 1: a displacement of the other side) of 1e-3 times `size`; linear geometry. */
static double *settle(outcome *o, const scene *s, int displaced, double size, int64_t *n, int32_t *status) {
    const double lo[3] = {-1, -1, -1}, hi[3] = {1, 99, 99}, far_lo[3] = {4, -1, -1}, far_hi[3] = {99, 99, 99};
    const double value[3] = {1e-3 * size, 4e-4 * size, 0};
    const int32_t axes = s->space == PERI_SPACE_SOLID ? PERI_AXIS_XYZ : PERI_AXIS_XY;
    peri_body *b = small_body(o, s);
    peri_solve_desc st;
    int32_t set;
    double *u;
    (void)extreme_fails(o, b, peri_prescribe_displacement(b, peri_select_box(b, NULL, lo, hi), axes, NULL, NULL, NULL));
    set = peri_select_box(b, NULL, far_lo, far_hi);
    (void)extreme_fails(o, b, displaced ? peri_prescribe_displacement(b, set, axes, value, NULL, NULL)
                                        : peri_apply_body_force(b, set, value, NULL, NULL));
    peri_solve_desc_init(&st);
    *status = o->status == PERI_OK ? peri_solve(b, &st, NULL) : o->status;
    u = extreme_read(o, b, PERI_FIELD_DISPLACEMENT);
    *n = u ? peri_size_of_field(b, PERI_FIELD_DISPLACEMENT) : 0;
    *o = extreme_end(*o, b);
    return u;
}

/* Linearity: displacements of a tiny load are those of a load of one, times as tiny; or a status says that they cannot be had. */
static outcome faint(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    int32_t law;
    for (law = PERI_LAW_BOND_BASED; law < peri__end_law && o.status == PERI_OK; ++law) {
        const scene s = scene_of(law % 2 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRAIN, precision, law, PERI_GEOMETRY_LINEAR);
        int32_t status[2];
        int64_t n, i;
        double *large = settle(&o, &s, row->choice, 1, &n, &status[0]), *small = settle(&o, &s, row->choice, row->value, &n, &status[1]);
        double most = 0, worst = 0;
        for (i = 0; large && small && i < n; ++i) {
            most = extreme_worst(most, fabs(large[i]));
            worst = extreme_worst(worst, fabs(small[i] / row->value - large[i]));
        }
        if (status[0] != PERI_OK) extreme_note(&o, row, precision, NAN, "a load of one: %d", (int)status[0]);
        else if (status[1] == PERI_OK) extreme_note(&o, row, precision, worst / most, "law %d", (int)law);
        else if (status[1] != PERI_ERROR_RANGE && status[1] != PERI_ERROR_CONVERGENCE) o.status = status[1];
        free(large);
        free(small);
    }
    return o;
}

/* A run with numbers below the normal range taken as 0 by the processor, against one without. */
static outcome flushed(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
#ifdef FLUSHES
    int32_t law, space;
    for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law)
        for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space && o.status == PERI_OK; ++space) {
            const unsigned control = _mm_getcsr();
            scene s = scene_of(space, precision, law, PERI_GEOMETRY_NONLINEAR);
            shown seen[2];
            int way, cloud;
            for (cloud = 0; cloud < 2; ++cloud) {
                for (way = 0; way < 2; ++way) {
                    const double left[3] = {-0.2, 0.05, 0}, lo[3] = {-1, -1, -1}, hi[3] = {1, 99, 99}, down[3] = {0, -1e-3, 0};
                    peri_body *b;
                    peri_advance_desc run;
                    s.stretch = 0.02;
                    s.cloud = cloud;
                    if (way) _mm_setcsr(control | 0x8040u); /* flush to zero, denormals are zeros                        */
                    b = small_body(&o, &s);
                    (void)extreme_fails(&o, b, peri_add_velocity(b, peri_select_box(b, NULL, lo, hi), left));
                    (void)extreme_fails(&o, b, peri_apply_body_force(b, PERI_ALL, down, NULL, NULL));
                    peri_advance_desc_init(&run);
                    run.steps = 30;
                    if (o.status == PERI_OK) (void)extreme_fails(&o, b, peri_advance(b, &run));
                    show(&o, b, &seen[way]);
                    o = extreme_end(o, b);
                    _mm_setcsr(control);
                }
                compare(&o, row, &s, &seen[0], &seen[1], 1, "flushed");
                forget(&seen[0]);
                forget(&seen[1]);
            }
        }
#else
    (void)row;
    (void)precision;
#endif
    return o;
}

#define NONE {0, 0, 0}

static const extreme rows[] = {
    {"strains of 2^-60, linear", "twice as small, by a power of two: the same bits", tiny, 60, 60, 0, PERI_OK, NULL, NONE},
    {"strains of 2^-400 (single bonds: 2^-90), linear", "twice as small, by a power of two: the same bits", tiny, 400, 90, 0, PERI_OK,
     NULL, NONE},
    /* second-order terms of 1e-2 2^-33 = 1e-12; sums of 30 bonds */
    {"strains of 1e-12", "finite strain is linear but for the strain itself", tiny, 33, 33, 1, PERI_OK, NULL, {1e-10, 1e-5, 1e-5}},
    {"strains of 1e-29", "finite strain is linear but for the strain itself", tiny, 90, 90, 1, PERI_OK, NULL, {1e-13, 1e-5, 1e-5}},
    {"below the normal range", "energy is conserved: nothing grows", denormal, 0, 0, 0, PERI_OK, NULL, {1, 1, 1}},
    {"loads of 1e-20", "linearity", faint, 1e-20, 0, 0, PERI_OK, NULL, {1e-6, 1e-3, 1e-2}},
    {"loads of 1e-33", "linearity, or a status", faint, 1e-33, 0, 0, PERI_OK, NULL, {1e-6, 1e-3, 1e-2}},
    {"loads of 1e-150", "linearity, or a status", faint, 1e-150, 0, 0, PERI_OK, NULL, {1e-6, 1e-3, 1e-2}},
    {"loads of 1e-300", "linearity, or a status", faint, 1e-300, 0, 0, PERI_OK, NULL, {1e-6, 1e-3, 1e-2}},
    {"supports moved by 1e-20", "linearity", faint, 1e-20, 0, 1, PERI_OK, NULL, {1e-6, 1e-3, 1e-2}},
    {"supports moved by 1e-25", "linearity, or a status", faint, 1e-25, 0, 1, PERI_OK, NULL, {1e-6, 1e-3, 1e-2}},
    {"supports moved by 1e-33", "linearity, or a status", faint, 1e-33, 0, 1, PERI_OK, NULL, {1e-6, 1e-3, 1e-2}},
    {"supports moved by 1e-150", "linearity, or a status", faint, 1e-150, 0, 1, PERI_OK, NULL, {1e-6, 1e-3, 1e-2}},
    {"supports moved by 1e-300", "linearity, or a status", faint, 1e-300, 0, 1, PERI_OK, NULL, {1e-6, 1e-3, 1e-2}},
    /* what is flushed is below 1e-38 of numbers of 1e-3 */
    {"denormals flushed by the processor", "what is flushed is nothing beside the rest", flushed, 0, 0, 0, PERI_OK, NULL,
     {1e-14, 1e-6, 1e-6}},
};
const extreme_table extreme_tiny = EXTREME_TABLE("tiny", rows);
