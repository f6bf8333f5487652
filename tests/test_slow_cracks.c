/* SPDX-License-Identifier: MIT */
/* test_slow_cracks.c - cracks without inertia: fracture control, the order in which bonds break, parts that come off.

   SOURCE OF TRUTH: reciprocity (work = elastic energy + 1/2 f e' of every bond that broke, f its force before, e' its extension after);
   Irwin, Kies: G = P^2/2 dC/da, C the compliance of the beams of a double cantilever, whose cube root is linear in a; ASTM E399 with
   Griffith; point symmetry; what one bond at a time breaks. */
#include "solid.h"
#include "equilibrium.h"

#define ROWS_MOST 600

/* ---- what every event must satisfy -------------------------------------------------------------------------------- */

typedef struct opened { /* a bond that broke at the last event, and the force that it gave up                             */
    int32_t i, j;
    double  force;
} opened;

typedef struct witness {
    double *x, c, s0, volume;       /* places; micromodulus, critical stretch; of a point                                 */
    opened  list[200];
    int     count, pairs;           /* pairs: events at which two or more broke                                           */
    double  fracture, worst_ledger, worst_stretch;
} witness;

static double extension(const witness *w, const double *u, int32_t i, int32_t j) {
    double sum = 0, square = 0;
    int d;
    for (d = 0; d < 2; ++d) {
        const double xi = w->x[j * 2 + d] - w->x[i * 2 + d];
        sum += xi * (u[j * 2 + d] - u[i * 2 + d]);
        square += xi * xi;
    }
    return sum / sqrt(square);
}

static int32_t bond_opens(void *user, int32_t i, int32_t j, double time, double stretch) {
    witness *w = (witness *)user;
    (void)time;
    if (w->count < 200) {
        w->list[w->count].i = i;
        w->list[w->count].j = j;
        w->list[w->count].force = w->c * stretch * w->volume * w->volume;
    }
    w->count++;
    w->worst_stretch = fmax(w->worst_stretch, fabs(stretch / w->s0 - 1));
    return 0;
}

static int32_t at_event(void *user, peri_body *b) {
    witness *w = (witness *)user;
    double *u = get(b, PERI_FIELD_DISPLACEMENT);
    peri_energy e;
    int k;
    (void)MUST(b, peri_get_energy(b, &e));
    for (k = 0; k < w->count && k < 200; ++k) w->fracture += 0.5 * w->list[k].force * extension(w, u, w->list[k].i, w->list[k].j);
    w->pairs += w->count > 1;
    if (w->count > 0) w->worst_ledger = fmax(w->worst_ledger, fabs(w->fracture / e.fracture - 1));
    w->count = 0;
    free(u);
    return 0;
}

static void watch(witness *w, peri_body *b) {
    const int32_t material = peri_id(b, PERI_KIND_MATERIAL, 1), other = peri_id(b, PERI_KIND_MATERIAL, 2);
    double *volume = get(b, PERI_FIELD_VOLUME);
    memset(w, 0, sizeof *w);
    w->x = get(b, PERI_FIELD_POSITION);
    w->volume = volume[0];
    (void)MUST(b, peri_get_bond_constants(b, material, other > 0 ? other : material, &w->c, &w->s0));
    (void)MUST(b, peri_on_break(b, bond_opens, w));
    free(volume);
}

/* ---- double cantilever -------------------------------------------------------------------------------------------- */

#define ARM    6  /* rows of points of each */
#define LENGTH 54
#define CRACK  20

/* Two arms of unit thickness, E = 1, spacing 1, pulled apart at their ends by `way` each. Arms do not break, bonds between them do: without
   that guide a crack between two arms in bending turns into one of them. */
static peri_body *cantilevers(int32_t geometry, double way, int32_t *pulled) {
    const double before[2] = {-1, 0}, tip[2] = {CRACK, 0}, up[2] = {0, way}, down[2] = {0, -way};
    const double lo[2][2] = {{0, 0}, {0, -ARM}}, hi[2][2] = {{LENGTH, ARM}, {LENGTH, 0}}, ends[2][2] = {{-1, 0}, {-1, -ARM - 1}};
    const double end[2][2] = {{1.1, ARM + 1}, {1.1, 0}};
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 3, 1, 1, 1);
    int32_t material[2], k, support[2];
    peri_body *b = NULL;
    s.desc.geometry = geometry;
    (void)MUST(NULL, peri_body_create(&s.desc, &b, NULL));
    for (k = 0; k < 2; ++k) {
        material[k] = (int32_t)MUST(b, peri_add_material(b, &s.material));
        (void)MUST(b, peri_add_box(b, material[k], lo[k], hi[k], 1));
    }
    s.material.fracture_energy = 1e-4;
    (void)MUST(b, peri_set_interface(b, material[0], material[1], &s.material));
    (void)MUST(b, peri_build(b));
    (void)MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, before, tip));
    for (k = 0; k < 2; ++k)
        support[k] = (int32_t)MUST(b, peri_select_box(b, NULL, ends[k], end[k]));
    for (k = 0; k < 2; ++k)
        support[k] = (int32_t)MUST(b, peri_prescribe_displacement(b, support[k], PERI_AXIS_Y, k ? down : up, NULL, NULL));
    (void)MUST(b, peri_prescribe_displacement(b, slab(b, 0, LENGTH - 1.1, LENGTH + 1), PERI_AXIS_X, NULL, NULL, NULL));
    *pulled = support[0];
    return b;
}

/* One column of the lattice takes 18 bonds. Each breaks at its limit, at a factor of its own; work = elastic energy + 1/2 f e'; the cube
   root of the compliance is linear in the crack's length, and with the compliance so found the mean of G is the energy of fracture per
   length; the highest load in each column falls as 1/(a + correction), as G = const asks for. */
static void a_double_cantilever(void) {
    enum { COLUMN = 18, COLUMNS = 6 };
    int32_t pulled;
    peri_body *b = cantilevers(PERI_GEOMETRY_LINEAR, 2, &pulled);
    double rows[ROWS_MOST][6], work = 0, a[COLUMNS + 1], root[COLUMNS + 1], top[COLUMNS], slope, shift, mean = 0, taken = 0;
    peri_solve_desc st = statics_of(1e-9);
    peri_solve_report r;
    peri_energy e;
    witness w;
    int k, column = 0, count = 0;
    watch(&w, b);
    st.control = PERI_CONTROL_FRACTURE;
    st.criticality = 1;
    st.breaks = 63;
    st.curve_load = pulled;
    st.curve = rows[0];
    st.curve_rows = ROWS_MOST;
    st.on_step = at_event;
    st.user = &w;
    r = solve(b, &st);
    (void)MUST(b, peri_get_energy(b, &e));
    CHECK(r.ended == PERI_ENDED_BREAKS && r.curve_rows == 64 && r.broken >= COLUMN * COLUMNS && r.lost_parts == 0);
    CHECK(e.damping == 0 && fabs(e.error) <= 1e-9 * e.external);
    CHECK_NEAR(e.elastic + e.fracture, e.external, 1e-6, 0);
    CHECK(w.worst_ledger < 1e-6 && w.worst_stretch < 1e-6 && w.pairs > 10); /* mirrored bonds break together */
    for (k = 0; k < r.curve_rows; ++k) {
        const double *row = rows[k], *last = k ? rows[k - 1] : NULL;
        work += 0.5 * (row[4] + (last ? last[4] : 0)) * (row[2] - (last ? last[2] : 0)) * 2;
        if (row[5] == COLUMN * column && column <= COLUMNS) {
            a[column] = CRACK + column;
            root[column] = cbrt(row[2] / row[4]);
            top[column < COLUMNS ? column : 0] = column < COLUMNS ? 0 : top[0];
            column++;
        }
        if (column > 0 && column <= COLUMNS) top[column - 1] = fmax(top[column - 1], row[4]);
    }
    CHECK_NEAR(work, e.external, 1e-9, 0);
    CHECK(column == COLUMNS + 1);
    slope = (root[COLUMNS] - root[0]) / COLUMNS;
    shift = root[0] / slope - CRACK;
    for (k = 0; k <= COLUMNS; ++k) CHECK_NEAR(root[k], slope * (a[k] + shift), 2e-3, 0);
    CHECK(shift > 0 && shift < 2 * ARM); /* 0.64 of the arm for isotropic beams on their own foundation (Kanninen 1973), and shear */
    for (k = 0; k < COLUMNS; ++k) CHECK_NEAR(top[k] * (a[k] + shift + 0.5), top[0] * (a[0] + shift + 0.5), 0.02, 0);
    for (k = 0; k < r.curve_rows; ++k)
        if (rows[k][5] > 0 && rows[k][5] <= COLUMN * COLUMNS) {
            const double at = CRACK + rows[k][5] / COLUMN + shift;
            mean += rows[k][4] * rows[k][4] * 3 * slope * slope * slope * at * at;
            count++;
        }
    mean /= count;
    taken = e.fracture / ((double)r.broken / COLUMN);
    printf("    correction %.2f arms, G %.4g from the loads, %.4g from the ledger, G0 %.4g\n", shift / ARM, mean, taken, 1e-4);
    CHECK_NEAR(mean, taken, 0.06, 0);
    CHECK(taken > 1e-4 && taken < 2e-4);
    free(w.x);
    peri_body_destroy(b);
}

/* ---- a beam that snaps -------------------------------------------------------------------------------------------- */

/* [T] 5.1: 150 mm x 600 mm x 150 mm, E, G0; points of the lattice carry it 2.5 h from its ends. */
static peri_body *notched_beam(double h, double notch, double deflection, int32_t *pushed) {
    const double depth = 0.15, half = 0.3 + 2 * h, below[2] = {0, -h}, tip[2] = {0, notch * depth}, down[2] = {0, -deflection};
    const double at[3][2] = {{-0.3 + 0.5 * h, 0.5 * h}, {0.3 - 0.5 * h, 0.5 * h}, {0, depth - 0.5 * h}};
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, h, 3, 1, 1, 1);
    peri_body *b;
    int k;
    s.desc.geometry = PERI_GEOMETRY_LINEAR;
    s.desc.thickness = 0.15;
    s.material.young = 35.77e9;
    s.material.density = 2400;
    s.material.fracture_energy = 9.8;
    s.lo[0] = -half;
    s.hi[0] = half;
    s.hi[1] = depth;
    b = specimen_make(&s);
    (void)MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, below, tip));
    for (k = 0; k < 3; ++k) {
        const int32_t set = (int32_t)MUST(b, peri_select_ball(b, NULL, at[k], 0.6 * h));
        (void)MUST(b, peri_set_no_fail(b, (int32_t)MUST(b, peri_select_ball(b, NULL, at[k], 3 * h)), 1));
        *pushed = (int32_t)MUST(b, peri_prescribe_displacement(b, set, k ? PERI_AXIS_Y : PERI_AXIS_XY, k == 2 ? down : NULL, NULL, NULL));
    }
    return b;
}

/* Load at which a crack of alpha of the depth grows: K = P S/(B W^1.5) f(a/W) (ASTM E399 A3.5.3), K^2 = E G0. */
static double griffith_of(double alpha) {
    const double f = 3 * sqrt(alpha) * (1.99 - alpha * (1 - alpha) * (2.15 - 3.93 * alpha + 2.7 * alpha * alpha)) /
                     (2 * (1 + 2 * alpha) * pow(1 - alpha, 1.5));
    return sqrt(35.77e9 * 9.8) * 0.15 * pow(0.15, 1.5) / (0.6 * f);
}

/* Load over deflection, through all of the softening, down to the ligament under the load, which is kept from breaking. The
   peak is Griffith's within the width of the lattice's own (test_bending.c: energies_and_peak); with a short notch the deflection goes
   back from the peak on. Work is elastic energy and fracture all along. */
static double snaps(double h, double notch) {
    double rows[ROWS_MOST][6], work = 0, peak = 0, at = 0, back = HUGE_VAL, least = HUGE_VAL;
    int32_t pushed;
    peri_body *b = notched_beam(h, notch, 1e-4, &pushed);
    peri_solve_desc st = statics_of(1e-9);
    peri_solve_report r;
    peri_energy e;
    int k, last;
    st.control = PERI_CONTROL_FRACTURE;
    st.curve_load = pushed;
    st.curve = rows[0];
    st.curve_rows = ROWS_MOST;
    r = solve(b, &st);
    (void)MUST(b, peri_get_energy(b, &e));
    CHECK(r.curve_rows <= ROWS_MOST && r.curve_rows > 30);
    last = (int)(r.curve_rows < ROWS_MOST ? r.curve_rows : ROWS_MOST) - 1;
    for (k = 0; k <= last; ++k) {
        work += 0.5 * (rows[k][4] + (k ? rows[k - 1][4] : 0)) * (rows[k][2] - (k ? rows[k - 1][2] : 0));
        if (-rows[k][4] > peak) {
            peak = -rows[k][4];
            at = -rows[k][2];
            back = at;
            least = peak;
        }
        least = fmin(least, -rows[k][4]);
        if (-rows[k][4] < 0.8 * peak) back = fmin(back, -rows[k][2]);
    }
    printf("    h %4.1f mm, notch %.2f: peak %.0f N at %.1f um, %.3f of Griffith's %.0f; back to %.1f um; %d bonds, %d rounds, %.1f "
           "passes per bond; least %.0f N\n", 1e3 * h, notch, peak, 1e6 * at, peak / griffith_of(notch), griffith_of(notch), 1e6 * back,
           (int)r.broken, (int)r.steps, (double)r.passes / (double)r.broken, least);
    CHECK_NEAR(e.external, work, 1e-9, 0);
    CHECK_NEAR(e.external, e.elastic + e.fracture + e.damping, 1e-7, 0);
    CHECK(e.damping > 0 && e.damping < 0.01 * e.external); /* of the last bonds alone: no event follows them */
    CHECK(peak > 0.8 * griffith_of(notch) && peak < 1.3 * griffith_of(notch));
    CHECK(r.ended == PERI_ENDED_LOAD && r.load_factor == 1 && least < 0.3 * peak);
    peri_body_destroy(b);
    return back / at;
}
static void beams_snap(void) {
    for (double h = 0.01; h > (test_long ? 0.004 : 0.008); h *= 0.5) {
        const double deep = snaps(h, 0.5), shallow = snaps(h, 0.2);
        CHECK(shallow < 0.75 && shallow < deep); /* there is more to give back beside a shallow notch */
    }
}

/* ---- two cracks --------------------------------------------------------------------------------------------------- */

static int32_t not_in_notch(void *user, int64_t index, const double *x) {
    const double h = *(const double *)user;
    (void)index;
    return !(fabs(x[1] - 0.1) < 0.4 * h && (x[0] < 0.025 || x[0] > 0.175));
}
static int32_t steady(void *user, double time, int64_t count, const int32_t *points, double *value) {
    int64_t k;
    (void)time;
    (void)points;
    for (k = 0; k < count; ++k) value[2 * k] = *(const double *)user; /* at any factor */
    return 0;
}

/* Nooru-Mohamed: 200 mm x 200 mm x 50 mm of concrete with two notches of 25 mm, a row of points high; E 30 GPa, nu 0.2, G0 110 J/m^2, plane
   strain. Two frames in the shape of an L move apart (`opening`); a shear force pushes the upper from the left, the lower from the right,
   and stays. To y[points]: the damage. Returns the largest distance of damage above a half from the middle. */
typedef struct sheared {
    double *x, *damage, bow, worst; /* worst: of the damage, to its mirror image through the centre                       */
    int64_t points;
    peri_solve_report report;
} sheared;

static sheared nooru_mohamed(int32_t law, int cells, double force, double opening, int steps, double criticality) {
    double h = 0.2 / cells, strip = 3 * h, middle = 0.5 * h + 1e-6, s[2], zero[2] = {0, 0}, up[2] = {0, 0.5 * opening};
    const double down[2] = {0, -0.5 * opening}, lo[2] = {0, 0}, hi[2] = {0.2, 0.2}, top[2] = {0, 0.2 - strip}, bottom[2] = {0.2, strip};
    const double left[2][2] = {{0, 0.1 + middle}, {strip, 0.2}}, right[2][2] = {{0.2 - strip, 0}, {0.2, 0.1 - middle}};
    const double left_edge[2] = {h, 0.2}, right_edge[2] = {0.2 - h, 0};
    specimen p = specimen_of(PERI_SPACE_PLANE_STRAIN, law, 0.2, h, 4.01, 1, 1, 1);
    peri_solve_desc st = statics_of(0);
    peri_body *b;
    sheared out;
    int64_t i;
    int32_t held[4];
    int k;
    memset(&out, 0, sizeof out);
    p.desc.geometry = PERI_GEOMETRY_LINEAR;
    p.desc.thickness = 0.05;
    p.material.young = 30e9;
    p.material.density = 2400;
    p.material.fracture_energy = 110;
    b = specimen_start(&p);
    (void)MUST(b, peri_add_shape(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo, hi, h, not_in_notch, &h));
    (void)MUST(b, peri_build(b));
    held[0] = (int32_t)MUST(b, peri_select_box(b, NULL, top, hi));
    held[1] = (int32_t)MUST(b, peri_select_box(b, NULL, left[0], left[1]));
    held[2] = (int32_t)MUST(b, peri_select_box(b, NULL, lo, bottom));
    held[3] = (int32_t)MUST(b, peri_select_box(b, NULL, right[0], right[1]));
    for (k = 0; k < 4; ++k) {
        (void)MUST(b, peri_set_no_fail(b, held[k], 1));
        (void)MUST(b, peri_prescribe_displacement(b, held[k], PERI_AXIS_Y, k < 2 ? up : down, NULL, NULL));
    }
    s[0] = force / (0.05 * 0.1);
    s[1] = -s[0];
    (void)MUST(b, peri_apply_layer_traction(b, (int32_t)MUST(b, peri_select_box(b, NULL, left[0], left_edge)), 0.1, zero, steady, &s[0]));
    (void)MUST(b, peri_apply_layer_traction(b, (int32_t)MUST(b, peri_select_box(b, NULL, right_edge, right[1])), 0.1, zero, steady, &s[1]));
    st.loose = PERI_LOOSE_PINNED; /* the slide along x, which the two forces balance */
    if (criticality >= 0) st.criticality = criticality;
    st.steps = steps;
    out.report = solve(b, &st);
    out.points = peri_point_count(b);
    out.x = get(b, PERI_FIELD_POSITION);
    out.damage = get(b, PERI_FIELD_DAMAGE_GROWN);
    for (i = 0; i < out.points; ++i) {
        if (out.damage[i] > 0.3) out.bow = fmax(out.bow, fabs(out.x[2 * i + 1] - 0.1));
        out.worst = fmax(out.worst, fabs(out.damage[i] - out.damage[out.points - 1 - i]));
    }
    peri_body_destroy(b);
    return out;
}
static void end_sheared(sheared *s) {
    free(s->x);
    free(s->damage);
}

/* How far the furthest point of the cracks of one is from those of the other. */
static double apart(const sheared *a, const sheared *b) {
    double most = 0;
    int64_t i, j;
    for (i = 0; i < a->points; ++i) {
        double least = HUGE_VAL;
        if (!(a->damage[i] > 0.3)) continue;
        for (j = 0; j < b->points; ++j)
            if (b->damage[j] > 0.3) least = fmin(least, hypot(a->x[2 * i] - b->x[2 * j], a->x[2 * i + 1] - b->x[2 * j + 1]));
        most = fmax(most, least);
    }
    return most;
}

/* The default breaks the bonds that one at a time does, within two spacings, for less; all at once goes elsewhere. Cracks are images of
   each other through the centre, and bow. */
static void follows(int32_t law, int cells, double force, double opening, int steps, double bow) {
    const double h = 0.2 / cells;
    sheared one = nooru_mohamed(law, cells, force, opening, steps, 1), some = nooru_mohamed(law, cells, force, opening, steps, -1);
    sheared all = nooru_mohamed(law, cells, force, opening, steps, 0);
    const double here = fmax(apart(&one, &some), apart(&some, &one)), there = fmax(apart(&one, &all), apart(&all, &one));
    printf("    %s, %.2f mm, %.0f kN: bow %.1f mm one by one, %.1f by default, %.1f all at once; apart %.1f and %.1f mm; %.1f, %.1f and "
           "%.1f passes per bond\n", law_name[law % 100], 1e3 * h, 1e-3 * force, 1e3 * one.bow, 1e3 * some.bow, 1e3 * all.bow, 1e3 * here,
           1e3 * there, (double)one.report.passes / (double)one.report.broken, (double)some.report.passes / (double)some.report.broken,
           (double)all.report.passes / (double)all.report.broken);
    CHECK(one.report.broken > 200 && one.report.ended == PERI_ENDED_LOAD);
    CHECK(here < 2.1 * h && there > 2.9 * h);
    CHECK(one.worst < 1e-9 && some.worst < 1e-9);
    CHECK(one.bow >= bow && some.bow >= bow);
    CHECK((double)some.report.passes < 0.75 * (double)one.report.passes);
    end_sheared(&one);
    end_sheared(&some);
    end_sheared(&all);
}
static void two_cracks_bow(void) {
    follows(PERI_LAW_BOND_BASED, 21, 20e3, 1e-4, 5, 0.025);
    if (test_long) follows(PERI_LAW_BOND_BASED, 41, 20e3, 1.5e-4, 20, 0.04);
}

/* At the defaults, LPS, 10 kN. */
static void concrete_in_shear(void) {
    sheared s = nooru_mohamed(PERI_LAW_LPS, 41, 10e3, 1.5e-4, 20, -1);
    printf("    LPS, 4.88 mm, 10 kN: bow %.1f mm, image off by %.1g\n", 1e3 * s.bow, s.worst);
    CHECK(s.bow >= 0.025 && s.worst < 1e-9);
    end_sheared(&s);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(a_double_cantilever);
    RUN(beams_snap);
    RUN(two_cracks_bow);
    LONG_RUN(concrete_in_shear);
    return test_end("test_slow_cracks");
}
