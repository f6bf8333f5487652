/* SPDX-License-Identifier: MIT */
/* test_pieces.c - fragments: which there are, how they are numbered as they split, and what they are as rigid bodies.
   SOURCE OF TRUTH: a flood fill over the families bond by bond (pieces.h), the rule of peri.h for the numbers, and the definitions of mass,
   momenta and inertia, summed about the origin and carried to the centre by the theorem of parallel axes. */
#include "pieces.h"

#define POINTS 2000
#define FRAMES 5

/* ---- numbers ------------------------------------------------------------------------------------------------------ */

typedef struct census {
    int64_t count;
    int32_t of[POINTS], parent[POINTS];
} census;

/* What the numbers become by the rule of peri.h, of pieces as flood() has them; count 0: the first time. */
static void renumber(census *c, const int32_t *piece, int64_t n) {
    static int32_t size[POINTS], number[POINTS], keeper[POINTS];
    const int64_t former = c->count;
    for (int64_t i = 0; i < n; ++i) size[i] = 0;
    for (int64_t i = 0; i < n; ++i) size[piece[i]]++;
    for (int64_t f = 0; f < former; ++f) keeper[f] = -1;
    for (int64_t i = 0; i < n; ++i) /* ascending: of equal ones the least point comes first */
        if (former > 0 && piece[i] == i && (keeper[c->of[i]] < 0 || size[i] > size[keeper[c->of[i]]])) keeper[c->of[i]] = (int32_t)i;
    for (int64_t i = 0; i < n; ++i) {
        if (piece[i] != i) continue;
        if (former > 0 && keeper[c->of[i]] == i) number[i] = c->of[i];
        else {
            c->parent[c->count] = former > 0 ? c->of[i] : -1;
            number[i] = (int32_t)c->count++;
        }
    }
    for (int64_t i = 0; i < n; ++i) c->of[i] = number[piece[i]];
}

static int64_t frames_seen, splits_seen, pieces_seen;

static void compare_numbers(peri_body *b, census *c) {
    static int32_t piece[POINTS], of[POINTS];
    static peri_fragment out[POINTS];
    const int64_t n = peri_point_count(b), former = c->count;
    CHECK(n <= POINTS);
    flood(b, piece);
    renumber(c, piece, n);
    CHECK(MUST(b, peri_find_fragments(b, of, n)) == c->count);
    CHECK(memcmp(of, c->of, (size_t)n * sizeof *of) == 0);
    MUST(b, peri_get_fragments(b, out, POINTS));
    for (int64_t f = 0; f < c->count; ++f) {
        int32_t points = 0, first = -1;
        for (int64_t i = n - 1; i >= 0; --i)
            if (of[i] == f) points++, first = (int32_t)i;
        CHECK(out[f].points == points && out[f].first == first && out[f].parent == c->parent[f] && out[f].held == 0);
    }
    frames_seen++;
    splits_seen += former > 0 && c->count > former;
    pieces_seen += c->count;
}

static void one_life(int source, int dim) {
    static census c;
    peri_body *b = random_scene(source, dim);
    c.count = 0;
    for (int frame = 0; frame < FRAMES; ++frame) {
        if (frame > 0 || throw_die(2)) break_some(b);
        compare_numbers(b, &c);
    }
    MUST(b, peri_reset(b)); /* whole again: numbered anew */
    c.count = 0;
    compare_numbers(b, &c);
    break_some(b);
    compare_numbers(b, &c);
    peri_body_destroy(b);
}

static void numbers_are_those_of_a_flood_fill(void) {
    const int lives = test_long ? 200 : 20;
    frames_seen = splits_seen = pieces_seen = 0;
    for (int life = 0; life < lives; ++life) {
        dice = (uint64_t)life;
        one_life(life % SOURCES, life / SOURCES % 2 + 2);
        if (test_bad) {
            printf("    life %d\n", life);
            return;
        }
    }
    CHECK(splits_seen > lives && pieces_seen > 5 * frames_seen);
}


/* ---- bonds that break by themselves ------------------------------------------------------------------------------------ */

static int32_t look(void *user, peri_body *b) {
    compare_numbers(b, (census *)user);
    return 0;
}

/* A plate that flies apart from its middle, and one that is pulled apart slowly: all ways in which bonds die. */
static void bonds_that_break_are_noticed(void) {
    static const int32_t laws[4] = {PERI_LAW_BOND_BASED, PERI_LAW_LPS, PERI_LAW_OTERKUS, PERI_LAW_CORRESPONDENCE};
    for (int k = 0; k < 5; ++k) {
        static census c;
        specimen s = specimen_of(PERI_SPACE_PLANE_STRAIN, laws[k % 4], 0.3, 0.1, 2.2, 14, 9, 1);
        s.material.critical_stretch = 0.02;
        if (k == 4) s.desc.geometry = PERI_GEOMETRY_LINEAR;
        peri_body *b = specimen_make(&s);
        double *x = field(b, PERI_FIELD_POSITION);
        c.count = 0;
        compare_numbers(b, &c);
        CHECK(c.count == 1);
        if (k < 4) {
            peri_advance_desc r;
            for (int64_t i = 0; i < peri_point_count(b); ++i) x[2 * i] = 2 * (x[2 * i] - 0.7), x[2 * i + 1] -= 0.3 * x[2 * i];
            MUST(b, peri_set_field(b, PERI_FIELD_VELOCITY, x, peri_size_of_field(b, PERI_FIELD_VELOCITY)));
            peri_advance_desc_init(&r);
            r.steps = 60;
            r.frame_steps = 4;
            r.on_frame = look;
            r.user = &c;
            MUST(b, peri_advance(b, &r));
        } else {
            const double lo[2] = {0, 0}, left[2] = {0.2, 0.9}, right[2] = {1.2, 0}, hi[2] = {1.4, 0.9};
            const double pull[2] = {0.1, 0}, in[2] = {0.7, 0.4}, side[2] = {0.9, 0.6};
            peri_solve_desc r;
            const int32_t ends[2] = {(int32_t)MUST(b, peri_select_box(b, NULL, lo, left)),
                (int32_t)MUST(b, peri_select_box(b, NULL, right, hi))};
            MUST(b, peri_prescribe_displacement(b, ends[0], PERI_AXIS_XY, NULL, NULL, NULL));
            MUST(b, peri_prescribe_displacement(b, ends[1], PERI_AXIS_XY, pull, NULL, NULL));
            MUST(b, peri_set_no_fail(b, (int32_t)MUST(b, peri_select_box(b, NULL, in, side)), 1)); /* which holds nothing */
            peri_solve_desc_init(&r);
            r.loose = PERI_LOOSE_PINNED;
            MUST(b, peri_solve(b, &r, NULL));
            static int32_t piece[POINTS], of[POINTS];
            static peri_fragment out[POINTS];
            flood(b, piece);
            renumber(&c, piece, peri_point_count(b));
            CHECK(MUST(b, peri_find_fragments(b, of, POINTS)) == c.count);
            MUST(b, peri_get_fragments(b, out, POINTS));
            for (int64_t f = 0; f < c.count; ++f) { /* held: a point in a grip */
                int held = 0;
                for (int64_t i = 0; i < peri_point_count(b); ++i) held |= of[i] == f && (x[2 * i] < 0.2 || x[2 * i] > 1.2);
                CHECK(out[f].held == held);
            }
        }
        CHECK(c.count > 1);
        free(x);
        peri_body_destroy(b);
    }
}

/* ---- sums ----------------------------------------------------------------------------------------------------------------- */

/* Sums over the points of a fragment: mass, its first and second moments, momentum, angular momentum about the origin. */
typedef struct sums {
    double mass, first[3], second[3][3], momentum[3], turn[3], lo[3], hi[3];
} sums;

static void add_up(peri_body *b, const int32_t *of, int32_t fragment, double density, sums *s) {
    const int dim = peri_dimension(b);
    double *volume = field(b, PERI_FIELD_VOLUME), *place = field(b, PERI_FIELD_CURRENT_POSITION), *velocity = field(b, PERI_FIELD_VELOCITY);
    memset(s, 0, sizeof *s);
    for (int d = 0; d < dim; ++d) s->lo[d] = HUGE_VAL, s->hi[d] = -HUGE_VAL;
    for (int64_t i = 0; i < peri_point_count(b); ++i) {
        double x[3] = {0, 0, 0}, p[3] = {0, 0, 0};
        const double mass = density * volume[i];
        if (of[i] != fragment) continue;
        for (int d = 0; d < dim; ++d) {
            x[d] = place[i * dim + d], p[d] = mass * velocity[i * dim + d];
            s->lo[d] = fmin(s->lo[d], x[d]), s->hi[d] = fmax(s->hi[d], x[d]);
        }
        s->mass += mass;
        for (int d = 0; d < 3; ++d) {
            s->first[d] += mass * x[d];
            s->momentum[d] += p[d];
            s->turn[d] += x[(d + 1) % 3] * p[(d + 2) % 3] - x[(d + 2) % 3] * p[(d + 1) % 3];
            for (int e = 0; e < 3; ++e) s->second[d][e] += mass * x[d] * x[e];
        }
    }
    free(volume), free(place), free(velocity);
}

static void compare_sums(const peri_fragment *f, const sums *s, int dim, double eps) {
    static const int pair[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}};
    double trace = 0, moment[6];
    CHECK_NEAR(f->mass, s->mass, eps, 0);
    for (int k = 0; k < 6; ++k) { /* about the centre: less M c c */
        const int d = pair[k][0], e = pair[k][1];
        moment[k] = s->second[d][e] - s->first[d] * s->first[e] / s->mass;
        if (k < 3) trace += moment[k];
    }
    for (int k = 0; k < 6; ++k) CHECK_NEAR(f->inertia[k], k < 3 ? trace - moment[k] : -moment[k], 0, 100 * eps * s->mass);
    for (int d = 0; d < 3; ++d) {
        const int e = (d + 1) % 3, g = (d + 2) % 3;
        const double own = (s->first[e] * s->momentum[g] - s->first[g] * s->momentum[e]) / s->mass; /* of the centre */
        CHECK_NEAR(f->centre[d], s->first[d] / s->mass, 0, 10 * eps);
        CHECK_NEAR(f->velocity[d], s->momentum[d] / s->mass, 0, 10 * eps);
        CHECK_NEAR(f->angular[d], s->turn[d] - own, 0, 100 * eps * s->mass);
        CHECK_NEAR(f->lo[d], s->lo[d], 0, 10 * eps);
        CHECK_NEAR(f->hi[d], s->hi[d], 0, 10 * eps);
        if (d >= dim) CHECK(f->centre[d] == 0 && f->lo[d] == 0 && f->hi[d] == 0 && f->velocity[d] == 0);
    }
}

static void sums_are_those_of_the_points(void) {
    static int32_t of[POINTS];
    static peri_fragment out[POINTS];
    for (int k = 0; k < (test_long ? 200 : 20); ++k) {
        const int dim = 2 + k / SOURCES % 2;
        dice = 1000 + (uint64_t)k;
        peri_body *b = random_scene(k % SOURCES, dim);
        double whole[3] = {0, 0, 0}, linear[3];
        for (int cut = 0; cut < 3; ++cut) break_some(b);
        move_about(b);
        const int64_t count = MUST(b, peri_find_fragments(b, of, POINTS));
        MUST(b, peri_get_fragments(b, out, POINTS));
        for (int32_t f = 0; f < count; ++f) {
            sums s;
            if (f < 20) {
                add_up(b, of, f, dim == 2 ? 7 * 0.3 : 7, &s); /* density, and thickness */
                compare_sums(&out[f], &s, dim, 1e-13);
            }
            for (int d = 0; d < 3; ++d) whole[d] += out[f].mass * out[f].velocity[d];
        }
        MUST(b, peri_get_momentum(b, linear, NULL));
        for (int d = 0; d < dim; ++d) CHECK_NEAR(whole[d], linear[d], 1e-12, 1e-12);
        peri_body_destroy(b);
    }
}

/* ---- a life of its own ---------------------------------------------------------------------------------------------------- */

/* A clone knows what its body knew; the field and the file say the same; nothing is taken before it is asked for. */
static int64_t written;
static int names_fragment;
static int32_t note_bytes(void *user, const void *bytes, int64_t count) {
    (void)user;
    written += count;
    for (int64_t k = 0; k + 15 < count; ++k)
        if (memcmp((const char *)bytes + k, "Name=\"fragment\"", 15) == 0) names_fragment++;
    return 0;
}

static void clones_fields_and_files(void) {
    static int32_t of[POINTS], its[POINTS];
    peri_memory before, after;
    peri_body *b, *copy = NULL;
    dice = 7;
    b = random_scene(BOX, 2);
    const int64_t n = peri_point_count(b);
    knife k = {{1, 0.3, 0}, 1.9, 2};
    MUST(b, peri_cut_if(b, PERI_CUT_NOW, by_knife, &k));
    MUST(b, peri_get_memory(b, &before));
    CHECK(MUST(b, peri_find_fragments(b, of, n)) == 2);
    MUST(b, peri_get_memory(b, &after));
    CHECK(after.fields > before.fields && after.total - before.total == after.fields - before.fields);
    MUST(NULL, peri_body_clone(b, &copy, NULL));
    k.at = 1.6;
    MUST(copy, peri_cut_if(copy, PERI_CUT_NOW, by_knife, &k)); /* off the larger one */
    CHECK(MUST(copy, peri_find_fragments(copy, its, n)) == 3 && MUST(b, peri_find_fragments(b, NULL, 0)) == 2);
    for (int64_t i = 0; i < n; ++i) CHECK(its[i] == of[i] || its[i] == 2);
    double *values = field(copy, PERI_FIELD_FRAGMENT);
    for (int64_t i = 0; i < n; ++i) CHECK(values[i] == its[i]);
    free(values);
    MUST(copy, peri_export_vtu_to(copy, note_bytes, NULL));
    CHECK(written > 8 * n && names_fragment == 1);
    peri_body_destroy(b);
    MUST(copy, peri_reset(copy));
    CHECK(MUST(copy, peri_find_fragments(copy, its, n)) == 1 && its[n - 1] == 0);
    peri_body_destroy(copy);
}

/* Whatever allocation fails, the call is refused, and what it would have said it says when there is memory. */
static int64_t allowed;
static void *sometimes(void *user, uint64_t bytes) {
    (void)user;
    return allowed-- > 0 ? malloc((size_t)bytes) : NULL;
}
static void give_back(void *user, void *pointer, uint64_t bytes) {
    (void)user, (void)bytes;
    free(pointer);
}

static void memory_may_fail(void) {
    static int32_t piece[POINTS], of[POINTS];
    for (int64_t fail = 0; fail < 12; ++fail) {
        static census c;
        specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 2.1, 12, 9, 1);
        knife k = {{1, 0.2, 0}, 4.4, 2};
        int64_t vertices, faces;
        s.desc.allocate = sometimes;
        s.desc.release = give_back;
        allowed = INT64_MAX;
        peri_body *b = specimen_make(&s);
        c.count = 0;
        for (int part = 0; part < 2; ++part) {
            if (part) MUST(b, peri_cut_if(b, PERI_CUT_NOW, by_knife, &k));
            allowed = fail;
            const int64_t count = peri_find_fragments(b, of, POINTS);
            const int32_t sized = peri_size_of_outline(b, -1, &vertices, &faces);
            const int32_t file = peri_export_vtu_to(b, note_bytes, NULL);
            CHECK((count == 1 + part || count == PERI_ERROR_MEMORY) && (sized == PERI_OK || sized == PERI_ERROR_MEMORY));
            CHECK(file == PERI_OK || file == PERI_ERROR_MEMORY);
            CHECK(fail > 0 || (count < 0 && sized < 0 && file < 0));
            CHECK(fail < 11 || (count > 0 && sized == PERI_OK && file == PERI_OK));
            allowed = INT64_MAX;
            flood(b, piece);
            renumber(&c, piece, peri_point_count(b));
            CHECK(MUST(b, peri_find_fragments(b, of, POINTS)) == c.count && memcmp(of, c.of, 108 * sizeof *of) == 0);
        }
        peri_body_destroy(b);
    }
}

/* ---- what they cost ------------------------------------------------------------------------------------------------------- */

static double seconds_of(peri_body *b, int steps) {
    const clock_t start = clock();
    peri_advance_desc r;
    peri_advance_desc_init(&r);
    r.steps = steps;
    if (steps > 0) MUST(b, peri_advance(b, &r));
    else for (int k = 0; k < 1000; ++k) MUST(b, peri_find_fragments(b, NULL, 0));
    return (double)(clock() - start) / CLOCKS_PER_SEC / (steps > 0 ? steps : 1000);
}

static void free_where_nothing_broke(void) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 3.015, 100, 60, 1);
    s.material.critical_stretch = 0.1;
    peri_body *b = specimen_make(&s);
    double step = HUGE_VAL, look_again = HUGE_VAL;
    MUST(b, peri_find_fragments(b, NULL, 0));
    for (int k = 0; k < 5; ++k) step = fmin(step, seconds_of(b, 10)), look_again = fmin(look_again, seconds_of(b, 0));
    CHECK(look_again <= 0.01 * step);
    peri_body_destroy(b);
}

/* ---- where the body is now ------------------------------------------------------------------------------------------------ */

/* SOURCE OF TRUTH: a rigid motion changes nothing that is relative to the body. A square is moved by 5 in x: what was met by a cut, a
   box, a ball or a probe at its first place is met by the same, moved by 5, at its new one; 162 bonds cross the middle of a square of
   10 x 10 points with a horizon of 3 spacings (counted here, pair by pair). */
static void cuts_selections_and_probes_in_place(void) {
    const double from[2] = {-0.5, 0.5}, to[2] = {1.5, 0.5}, by[2] = {5, 0}, lo[2] = {0.2, 0.3}, hi[2] = {0.7, 0.6}, at[2] = {0.62, 0.33};
    const double far_from[2] = {4.5, 0.5}, far_to[2] = {6.5, 0.5}, far_lo[2] = {5.2, 0.3}, far_hi[2] = {5.7, 0.6}, far_at[2] = {5.62, 0.33};
    int32_t points[100], moved[100];
    int crossing = 0;
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 3, 10, 10, 1);
    peri_body *b = specimen_make(&s);
    const double corner[2] = {3, 2}, back[2] = {4, 4};
    CHECK(peri_find_point(b, corner) == 12); /* of four equally near ones: cells 2 and 3 of rows 1 and 2 */
    MUST(b, peri_add_displacement(b, PERI_ALL, back));
    CHECK(peri_find_point_in_place(b, corner) == 0);
    peri_body_destroy(b);
    s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 0.1, 3, 10, 10, 1);
    b = specimen_make(&s);
    for (int i = 0; i < 100; ++i)
        for (int j = i + 1; j < 100; ++j) {
            const int x = j % 10 - i % 10, y = j / 10 - i / 10;
            crossing += x * x + y * y <= 9 && i / 10 < 5 && j / 10 >= 5;
        }
    CHECK(crossing == 162);
    for (int ball = 0; ball < 2; ++ball) {
        MUST(b, peri_reset(b));
        const int32_t set = ball ? peri_select_ball(b, NULL, lo, 0.25) : peri_select_box(b, NULL, lo, hi);
        const int64_t count = MUST(b, peri_size_of_set(b, set));
        MUST(b, peri_get_set(b, set, points, 100));
        MUST(b, peri_add_displacement(b, PERI_ALL, by));
        const int32_t other = ball ? peri_select_ball_in_place(b, NULL, far_lo, 0.25) : peri_select_box_in_place(b, NULL, far_lo, far_hi);
        CHECK(count > 5 && MUST(b, peri_size_of_set(b, other)) == count);
        MUST(b, peri_get_set(b, other, moved, 100));
        CHECK(memcmp(points, moved, (size_t)count * sizeof *points) == 0);
    }
    CHECK(peri_select_box_in_place(b, NULL, lo, hi) == PERI_ERROR_EMPTY);
    CHECK(peri_find_point(b, at) == 36 && peri_find_point_in_place(b, far_at) == 36); /* in the cell 6, 3 */
    CHECK(peri_find_point(b, far_at) == 39 && peri_find_point_in_place(b, at) == 30);
    CHECK(MUST(b, peri_cut_segment(b, PERI_CUT_NOW, far_from, far_to)) == 0);
    CHECK(MUST(b, peri_cut_segment(b, PERI_CUT_IN_PLACE, far_from, far_to)) == crossing);
    MUST(b, peri_reset(b));
    CHECK(MUST(b, peri_cut_segment(b, PERI_CUT_NOW, from, to)) == crossing);
    peri_body_destroy(b);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(numbers_are_those_of_a_flood_fill);
    RUN(bonds_that_break_are_noticed);
    RUN(sums_are_those_of_the_points);
    RUN(clones_fields_and_files);
    RUN(memory_may_fail);
    RUN(free_where_nothing_broke);
    RUN(cuts_selections_and_probes_in_place);
    return test_end("test_pieces");
}
