/* SPDX-License-Identifier: MIT */
/* test_on_step.c - a rule of failure of the caller's: bonds that on_step cuts.

   SOURCE OF TRUTH: what equilibrium is: no force density is left on a point that nothing holds, and the forces of the two grips balance. A
   bond that the rule would cut stands nowhere. A ladder whose rungs break one after the other takes as many equilibria. */
#include "solid.h"
#include "equilibrium.h"

enum { NX = 20, NY = 16, N = NX * NY, WIDTH = 28 };

typedef struct rule {
    double  limit;      /* of von Mises's stress                                                                          */
    int64_t calls, cut; /* cut: bonds, in all; last: by the last call                                                     */
    int64_t last;
} rule;

static void stress_over(peri_body *b, double limit, char *over) {
    double s[3 * N];
    int i;
    MUST(b, peri_get_field(b, PERI_FIELD_STRESS, s, 3 * N));
    for (i = 0; i < N; ++i) {
        const double a = s[3 * i], c = s[3 * i + 1], t = s[3 * i + 2];
        over[i] = sqrt(a * a - a * c + c * c + 3 * t * t) > limit;
    }
}

/* Bonds both ends of which are over the limit; pairs may be NULL. */
static int64_t bonds_over(peri_body *b, double limit, int32_t *pairs) {
    static int32_t rows[N * WIDTH];
    char over[N];
    const int32_t width = peri_family_width(b);
    int64_t count = 0;
    int32_t i, k;
    stress_over(b, limit, over);
    MUST(b, peri_get_families(b, 0, N, rows, N * WIDTH));
    for (i = 0; i < N; ++i)
        for (k = 0; k < width; ++k) {
            const int32_t o = rows[i * width + k];
            if (o <= i || !over[i] || !over[o] || peri_bond_is_intact(b, i, o) != 1) continue;
            if (pairs) pairs[2 * count] = i, pairs[2 * count + 1] = o;
            ++count;
        }
    return count;
}

static int32_t cut_over(void *user, peri_body *b) {
    static int32_t pairs[N * WIDTH];
    rule *r = (rule *)user;
    const int64_t count = bonds_over(b, r->limit, pairs);
    r->last = count > 0 ? MUST(b, peri_cut_pairs(b, PERI_CUT_NOW, count, pairs)) : 0;
    r->cut += r->last;
    r->calls++;
    return 0;
}

/* A notched plate of the correspondence model, of which three rows at the foot and at the head are held. */
static peri_body *plate(int32_t geometry, int32_t *foot, int32_t *head, double pull) {
    const double edge[2] = {-1, 8}, tip[2] = {6, 8}, up[2] = {0, pull};
    specimen p = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_CORRESPONDENCE, 0.3, 1, 3.015, NX, NY, 1);
    p.desc.geometry = geometry;
    p.material.young = 2e3;
    peri_body *b = specimen_make(&p);
    MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, edge, tip));
    *foot = (int32_t)MUST(b, peri_prescribe_displacement(b, slab(b, 1, 0, 3), PERI_AXIS_XY, NULL, NULL, NULL));
    *head = (int32_t)MUST(b, peri_prescribe_displacement(b, slab(b, 1, NY - 3, NY), PERI_AXIS_XY, up, NULL, NULL));
    return b;
}

/* The largest force density that is left on points that nothing holds. */
static double left_over(peri_body *b) {
    double f[2 * N], most = 0;
    int i;
    MUST(b, peri_get_field(b, PERI_FIELD_FORCE_DENSITY, f, 2 * N));
    for (i = 2 * 3 * NX; i < 2 * (NY - 3) * NX; ++i) most = fmax(most, fabs(f[i]));
    return most;
}

/* Both geometries, both controls, one load step and three; forces are of the order of 2 without the equilibrium after the cuts. */
static void cuts_leave_an_equilibrium(void) {
    int way;
    for (way = 0; way < 8; ++way) {
        int32_t foot, head;
        rule r = {2.4, 0, 0, 0};
        peri_body *b = plate(way & 1 ? PERI_GEOMETRY_LINEAR : PERI_GEOMETRY_NONLINEAR, &foot, &head, 0.013);
        peri_solve_desc st = statics_of(1e-9);
        peri_solve_report report;
        peri_energy e;
        double curve[3][6], low[2], high[2];
        int d;
        st.steps = way & 2 ? 3 : 1;
        st.control = way & 4 ? PERI_CONTROL_FRACTURE : PERI_CONTROL_LOAD;
        st.on_step = cut_over;
        st.user = &r;
        st.curve_load = head;
        st.curve = curve[0];
        st.curve_rows = 3;
        report = solve(b, &st);
        MUST(b, peri_get_reaction(b, foot, low));
        MUST(b, peri_get_reaction(b, head, high));
        MUST(b, peri_get_energy(b, &e));
        printf("    %d: %d bonds in %d calls, force left %.1e\n", way, (int)r.cut, (int)r.calls, left_over(b));
        CHECK(r.cut > 20 && r.last == 0 && bonds_over(b, r.limit, NULL) == 0);
        CHECK(left_over(b) < 1e-6 && report.residual <= 1e-9);
        CHECK(report.steps == st.steps && report.curve_rows == st.steps && peri_step_count(b) == st.steps);
        CHECK(report.broken == 0 && peri_broken_count(b) == r.cut && curve[st.steps - 1][5] == (double)r.cut);
        for (d = 0; d < 2; ++d) {
            CHECK(fabs(low[d] + high[d]) <= 1e-7 * fabs(high[1]));
            CHECK(fabs(curve[st.steps - 1][3 + d] - high[d]) <= 1e-9 * fabs(high[1]));
        }
        CHECK(fabs(e.error) <= (way & 1 ? 1e-6 : 1e-2) * e.external); /* the work of a step goes by the mean of its ends */
        st.load_from = st.load_to; /* the same equilibrium again */
        st.steps = 1;
        r.calls = 0;
        (void)solve(b, &st);
        CHECK(r.calls == 1 && r.last == 0);
        MUST(b, peri_get_reaction(b, head, low));
        CHECK(fabs(low[1] - high[1]) <= 1e-6 * fabs(high[1]));
        peri_body_destroy(b);
    }
}

/* Cuts a bond at each call, for so many calls. */
typedef struct scissors {
    int32_t calls, cuts, said;
} scissors;
static int32_t snip(void *user, peri_body *b) {
    scissors *s = (scissors *)user;
    const int32_t at = 8 * NX + 2 * s->calls % NX, pair[2] = {at, at + 1};
    if (s->calls++ < s->cuts) MUST(b, peri_cut_pairs(b, PERI_CUT_NOW, 1, pair));
    return s->calls == s->cuts ? s->said : 0;
}

/* `breaks` limits the rounds, and a callback that stops is not asked again. */
static void rounds_end(void) {
    int way;
    for (way = 0; way < 6; ++way) {
        int32_t foot, head;
        scissors s = {0, way % 3 == 0 ? 4 : 3, way % 3 == 2 ? 1 : 0};
        peri_body *b = plate(PERI_GEOMETRY_LINEAR, &foot, &head, 1e-3);
        peri_solve_desc st = statics_of(1e-9);
        peri_solve_report report;
        peri_error error;
        st.on_step = snip;
        st.user = &s;
        st.breaks = 3;
        st.control = way < 3 ? PERI_CONTROL_LOAD : PERI_CONTROL_FRACTURE;
        const int32_t code = peri_solve(b, &st, &report);
        MUST(b, peri_get_error(b, &error));
        if (way % 3 == 0) CHECK(code == PERI_ERROR_CONVERGENCE && strcmp(error.field, "breaks") == 0 && s.calls == 4 && report.ended == 0);
        if (way % 3 == 1) CHECK(code == PERI_OK && s.calls == 4 && report.steps == 1 && report.ended == PERI_ENDED_LOAD);
        if (way % 3 == 2) CHECK(code == PERI_STOPPED && s.calls == 3 && report.ended == PERI_ENDED_STOPPED && left_over(b) > 1e-6);
        peri_body_destroy(b);
    }
}

static int32_t slit(void *user, peri_body *b) {
    const double edge[2] = {-1, 8}, tip[2] = {6, 8};
    return *(int *)user && peri_broken_count(b) == 0 ? (void)MUST(b, peri_cut_segment(b, PERI_CUT_NOW, edge, tip)), 0 : 0;
}

/* What on_step cuts hands its load to bonds that their criterion then breaks, at the same factor: the bonds that break where the slit is
   there from the start, the geometry being linear. */
static void criteria_follow_the_cuts(void) {
    const double up[2] = {0, 0.0093}, edge[2] = {-1, 8}, tip[2] = {6, 8};
    double *damage[2];
    int late;
    for (late = 0; late < 2; ++late) {
        peri_solve_desc st = statics_of(1e-9);
        specimen p = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, 0.3, 1, 3.015, NX, NY, 1);
        p.desc.geometry = PERI_GEOMETRY_LINEAR;
        p.material.young = 2e3;
        p.material.critical_stretch = 1.15e-3; /* the mean strain is 0.93e-3 */
        peri_body *b = specimen_make(&p);
        if (!late) MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, edge, tip));
        MUST(b, peri_prescribe_displacement(b, slab(b, 1, 0, 3), PERI_AXIS_XY, NULL, NULL, NULL));
        MUST(b, peri_prescribe_displacement(b, slab(b, 1, NY - 3, NY), PERI_AXIS_XY, up, NULL, NULL));
        MUST(b, peri_set_no_fail(b, slab(b, 1, 0, 5), 1)); /* nor at the corners of the grips */
        MUST(b, peri_set_no_fail(b, slab(b, 1, NY - 5, NY), 1));
        st.on_step = slit;
        st.user = &late;
        const peri_solve_report report = solve(b, &st);
        CHECK(report.broken > 10 && report.steps == 1 && left_over(b) < 1e-6);
        printf("    %d bonds broken, force left %.1e\n", (int)report.broken, left_over(b));
        damage[late] = get(b, PERI_FIELD_DAMAGE);
        peri_body_destroy(b);
    }
    CHECK(furthest(damage[0], damage[1], N) == 0);
    free(damage[0]);
    free(damage[1]);
}

/* Under fracture control events follow each other, and so does what on_step makes of them. */
static void events_ask_once(void) {
    const double up[2] = {0, 0.1}, edge[2] = {-1, 8}, tip[2] = {6, 8};
    scissors s = {0, 3, 0};
    peri_solve_desc st = statics_of(1e-9);
    specimen p = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, 0.3, 1, 3.015, NX, NY, 1);
    p.desc.geometry = PERI_GEOMETRY_LINEAR;
    p.material.young = 2e3;
    p.material.critical_stretch = 2e-3;
    peri_body *b = specimen_make(&p);
    MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, edge, tip));
    MUST(b, peri_prescribe_displacement(b, slab(b, 1, 0, 3), PERI_AXIS_XY, NULL, NULL, NULL));
    MUST(b, peri_prescribe_displacement(b, slab(b, 1, NY - 3, NY), PERI_AXIS_XY, up, NULL, NULL));
    st.control = PERI_CONTROL_FRACTURE;
    st.breaks = 5;
    st.on_step = snip;
    st.user = &s;
    const peri_solve_report report = solve(b, &st);
    CHECK(report.ended == PERI_ENDED_BREAKS && report.broken >= 5 && s.calls >= 6);
    CHECK(report.steps == s.calls && left_over(b) < 1e-6);
    peri_body_destroy(b);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(cuts_leave_an_equilibrium);
    RUN(rounds_end);
    RUN(criteria_follow_the_cuts);
    RUN(events_ask_once);
    return test_end("test_on_step");
}
