/* SPDX-License-Identifier: MIT */
/* test_images.c - which images make a periodic cell, and that a bond of one is counted once.

   SOURCE OF TRUTH: a cell whose every bond is found from both of its ends feels no force in sum, so that its momentum stays, to rounding;
   images that do not give that are refused, and the point that is named is an image at the fault. A straight cut through the cell meets, of
   each bond vector (p, q) of the lattice, q bonds per column: on 3 spacings 18 per column. A cell of one point has 14 bonds, one per pair
   of vectors +-(p, q). */
#include "pool.h"
#include "specimen.h"

#define CELL 12
#define RIM  3
#define WIDE (CELL + 2 * RIM)

typedef enum fault { NONE, ROUND, LEFT_ONLY, THIN, NO_CORNERS, OFF_BY_ONE, OFF_IN_A_CORNER, SHIFTED, HEAVY, FAULTS } fault;
typedef enum order { FRAME, OWNED_FIRST, IMAGES_FIRST, MIXED, ORDERS } order;

typedef struct cell {
    int32_t ghosts[WIDE * WIDE], owners[WIDE * WIDE], owned[CELL * CELL];
    int64_t count, own, points;
    double  x[WIDE * WIDE * 2], volume[WIDE * WIDE];
} cell;

/* Is place (x, y), of the frame around the cell, left out? */
static int is_missing(int what, int x, int y) {
    const int in_x = x >= 0 && x < CELL, in_y = y >= 0 && y < CELL;
    if (what == LEFT_ONLY) return x >= CELL;
    if (what == THIN) return x < 1 - RIM || x >= CELL + RIM - 1 || y < 1 - RIM || y >= CELL + RIM - 1;
    if (what == NO_CORNERS) return !in_x && !in_y;
    if (what == ROUND && !in_x && !in_y) { /* those alone that an owned point is bonded to */
        const int p = x < 0 ? -x : x - CELL + 1, q = y < 0 ? -y : y - CELL + 1;
        return p * p + q * q > 9;
    }
    return 0;
}

static int32_t owner_of(int what, int x, int y) {
    const int off = (what == OFF_BY_ONE && x < 0) || (what == OFF_IN_A_CORNER && x == -1 && y == -1);
    return (y + CELL) % CELL * CELL + (x + CELL + off) % CELL;
}

/* Points by `how`; place[id in the cell] is where the owned ones come to be. */
static void fill_cell(cell *c, int what, int how) {
    const double h = 1.0 / 8;
    int32_t place[CELL * CELL];
    memset(c, 0, sizeof *c);
    for (int pass = 0; pass < 4; ++pass) /* 0, 1: the points; 2, 3: the owners of images, which are known then */
        for (int k = 0, n = 0; k < WIDE * WIDE * (1 + (how == OWNED_FIRST || how == IMAGES_FIRST)); ++k) {
            const int turn = k / (WIDE * WIDE), at = how == MIXED ? k * 145 % (WIDE * WIDE) : k % (WIDE * WIDE);
            const int x = at % WIDE - RIM, y = at / WIDE - RIM, in = x >= 0 && x < CELL && y >= 0 && y < CELL;
            if ((how == OWNED_FIRST || how == IMAGES_FIRST) && in != (turn == (how == IMAGES_FIRST))) continue;
            if (is_missing(what, x, y)) continue;
            if (pass == 0 && in) place[y * CELL + x] = n;
            if (pass == 1) {
                c->x[2 * n] = h * (x + 0.5) + (what == SHIFTED && x == -1 && y == 4 ? 0.01 * h : 0), c->x[2 * n + 1] = h * (y + 0.5);
                c->volume[n] = h * h * (what == HEAVY && x == CELL && y == 4 ? 1.01 : 1);
                c->points = n + 1;
            }
            if (pass == 2 && in) c->owned[c->own++] = n;
            if (pass == 3 && !in) c->ghosts[c->count] = n, c->owners[c->count++] = place[owner_of(what, x, y)];
            ++n;
        }
}

static peri_body *start_cell(const cell *c, int32_t law, int32_t *status) {
    const double h = 1.0 / 8;
    specimen s = specimen_of(PERI_SPACE_PLANE_STRAIN, law, 0.25, h, 3, 1, 1, 0);
    peri_part_desc p;
    s.material.critical_stretch = 0.01;
    peri_body *b = specimen_start(&s);
    MUST(b, peri_add_points(b, c->points, c->x, c->volume, NULL));
    peri_part_desc_init(&p), p.length = h, p.mean_volume = h * h;
    p.ghost_count = c->count, p.ghosts = c->ghosts, p.owners = c->owners;
    MUST(b, peri_set_part(b, &p));
    *status = peri_build(b);
    return b;
}

/* Of every order of points: whole frames, and those without what no owned point is bonded to, are cells, whose momentum stays. */
static void cells_keep_their_momentum(void) {
    static cell c;
    for (int how = 0; how < ORDERS; ++how)
        for (int what = NONE; what <= ROUND; ++what) {
            int32_t status;
            double before[2], after[2];
            const double v[2] = {0.01, 0.002};
            peri_advance_desc a;
            fill_cell(&c, what, how);
            peri_body *b = start_cell(&c, PERI_LAW_BOND_BASED, &status);
            CHECK(status == PERI_OK);
            MUST(b, peri_add_velocity(b, peri_select_points(b, NULL, 30, c.owned), v));
            MUST(b, peri_get_momentum(b, before, NULL));
            peri_advance_desc_init(&a), a.steps = 50;
            MUST(b, peri_advance(b, &a));
            MUST(b, peri_get_momentum(b, after, NULL));
            for (int d = 0; d < 2; ++d) CHECK_NEAR(after[d], before[d], 0, 1e-14);
            peri_body_destroy(b);
        }
}

static void other_images_are_refused(void) {
    static cell c;
    for (int how = 0; how < ORDERS; ++how)
        for (int what = LEFT_ONLY; what < FAULTS; ++what) {
            int32_t status;
            int named = 0;
            peri_error e;
            memset(&e, 0, sizeof e);
            fill_cell(&c, what, how);
            peri_body *b = start_cell(&c, PERI_LAW_BOND_BASED, &status);
            CHECK(status == PERI_ERROR_PART && peri_get_error(b, &e) == PERI_OK && strcmp(e.field, "ghosts") == 0);
            for (int64_t k = 0; k < c.count; ++k) named += c.ghosts[k] == e.index;
            CHECK(named == 1);
            const double *at = c.x + 2 * e.index; /* the image, or one across the cell that misses it */
            if (what == OFF_BY_ONE) CHECK(at[0] < 0 || at[0] > CELL / 8.0);
            if (what == OFF_IN_A_CORNER) CHECK((at[0] < 0.4 || at[0] > CELL / 8.0 - 0.4) && (at[1] < 0.4 || at[1] > CELL / 8.0 - 0.4));
            if (what == HEAVY) CHECK(c.x[2 * e.index] > CELL / 8.0 && fabs(c.x[2 * e.index + 1] - 4.5 / 8) < 1e-9);
            peri_body_destroy(b);
        }
}

/* ---- counts ------------------------------------------------------------------------------------------------------------ */

static int64_t told;
static int32_t count_breaks(void *user, int32_t i, int32_t j, double time, double stretch) {
    (void)user, (void)i, (void)j, (void)time, (void)stretch;
    return told++, 0;
}

static int32_t crosses(void *user, int32_t i, int32_t j, const double *xi, const double *xj) {
    (void)i, (void)j;
    return (xi[1] < *(const double *)user) != (xj[1] < *(const double *)user);
}

/* A cut from side to side, by a segment, by a question and by pairs. */
static void cuts_are_counted_once(void) {
    static cell c;
    static int32_t pairs[2 * WIDE * WIDE * 28];
    const double from[2] = {-1, 6.0 / 8 + 1e-4}, to[2] = {3, 6.0 / 8 + 1e-4};
    double line = 6.0 / 8;
    for (int how = 0; how < ORDERS; ++how)
        for (int by = 0; by < 3; ++by) {
            int32_t status;
            int64_t cut, count = 0;
            fill_cell(&c, NONE, how);
            peri_body *b = start_cell(&c, PERI_LAW_BOND_BASED, &status);
            CHECK(status == PERI_OK);
            for (int32_t i = 0; by == 2 && i < c.points; ++i)
                for (int32_t j = 0; j < i; ++j) {
                    if (!crosses(&line, i, j, c.x + 2 * i, c.x + 2 * j) || peri_bond_is_intact(b, i, j) != 1) continue;
                    pairs[count++] = i, pairs[count++] = j;
                }
            if (by == 0) cut = peri_cut_segment(b, PERI_CUT_INITIAL, from, to);
            else if (by == 1) cut = peri_cut_if(b, PERI_CUT_INITIAL, crosses, &line);
            else cut = peri_cut_pairs(b, PERI_CUT_INITIAL, count / 2, pairs);
            CHECK(cut == 18 * CELL && peri_cut_count(b) == 18 * CELL);
            peri_body_destroy(b);
        }
}

/* Halves that fly apart: both sides of the upper one break, each bond of which is told of once. */
static void breaks_are_told_once(void) {
    static cell c;
    const double v[2] = {0, 1};
    int64_t broken = 0;
    for (int how = 0; how < ORDERS; ++how) {
        int32_t status, upper[CELL * CELL], count = 0;
        peri_advance_desc a;
        fill_cell(&c, NONE, how);
        peri_body *b = start_cell(&c, PERI_LAW_BOND_BASED, &status);
        CHECK(status == PERI_OK);
        for (int k = 0; k < CELL * CELL; ++k)
            if (c.x[2 * c.owned[k] + 1] > 6.0 / 8) upper[count++] = c.owned[k];
        MUST(b, peri_add_velocity(b, peri_select_points(b, NULL, count, upper), v));
        MUST(b, peri_on_break(b, count_breaks, NULL));
        told = 0;
        peri_advance_desc_init(&a), a.steps = 4, a.time_step = 0.01;
        MUST(b, peri_advance(b, &a));
        CHECK(told == peri_broken_count(b) && told > 18 * CELL / 2);
        CHECK(how == 0 || told == broken);
        broken = told;
        peri_body_destroy(b);
    }
}

/* In a cell of one point all bonds are to its own images. */
static void a_point_and_its_images(void) {
    const double h = 1.0 / 8;
    int64_t cut = 0;
    int32_t ghosts[49], owners[49], count = 0;
    double x[98], volume[49];
    for (int k = 0; k < 49; ++k) {
        x[2 * k] = h * (k % 7 - 3), x[2 * k + 1] = h * (k / 7 - 3), volume[k] = h * h;
        if (k != 24) ghosts[count] = k, owners[count++] = 24;
    }
    specimen s = specimen_of(PERI_SPACE_PLANE_STRAIN, PERI_LAW_BOND_BASED, 0.25, h, 3, 1, 1, 0);
    peri_part_desc p;
    peri_body *b = specimen_start(&s);
    MUST(b, peri_add_points(b, 49, x, volume, NULL));
    peri_part_desc_init(&p), p.length = h, p.mean_volume = h * h, p.ghost_count = count, p.ghosts = ghosts, p.owners = owners;
    MUST(b, peri_set_part(b, &p));
    MUST(b, peri_build(b));
    for (int line = -3; line < 3; ++line) {
        const double from[2] = {-3, (line + 0.51) * h}, to[2] = {3, (line + 0.51) * h};
        cut += peri_cut_segment(b, PERI_CUT_INITIAL, from, to);
    }
    CHECK(cut == 11); /* of vectors +-(p, q) one each, without q = 0: 5, 5 and 1 */
    peri_body_destroy(b);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(cells_keep_their_momentum);
    RUN(other_images_are_refused);
    RUN(cuts_are_counted_once);
    RUN(breaks_are_told_once);
    RUN(a_point_and_its_images);
    return test_end("test_images");
}
