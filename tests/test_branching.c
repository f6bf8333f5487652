/* SPDX-License-Identifier: MIT */
/* test_branching.c - crack branching in a glass plate, the benchmark of [P] (PDMATLAB2D): against an independent textbook
   program, mirrored, shuffled, on other threads, in other units, again after a reset and in a clone. The scene and
   the textbook program are in glass.h. */
#include "specimen.h"
#include "glass.h"

typedef struct event {
    int32_t i, j;
    double  time, stretch;
} event;

typedef struct trace {
    event   *e;
    int64_t  count, room;
    int64_t *history;      /* broken bonds by step; NULL: not wanted */
    const double *x;       /* positions, where `stop_x` is wanted */
    double   stop_x, tip;  /* stop when a bond has broken with its middle beyond stop_x */
} trace;

static int32_t on_break(void *user, int32_t i, int32_t j, double time, double stretch) {
    trace *t = (trace *)user;
    if (t->count == t->room) {
        t->room = 2 * t->room + 1024;
        t->e = (event *)realloc(t->e, (size_t)t->room * sizeof(event));
    }
    t->e[t->count].i = i;
    t->e[t->count].j = j;
    t->e[t->count].time = time;
    t->e[t->count++].stretch = stretch;
    if (t->x) t->tip = fmax(t->tip, 0.5 * (t->x[2 * i] + t->x[2 * j]));
    return 0;
}
static int32_t on_frame(void *user, peri_body *b) {
    trace *t = (trace *)user;
    if (t->history) t->history[peri_step_count(b)] = peri_broken_count(b);
    return t->x && t->tip >= t->stop_x;
}

static int32_t march(peri_body *b, const scene *s, int steps, trace *t) {
    peri_advance_desc r;
    peri_advance_desc_init(&r);
    r.steps = steps;
    r.time_step = s->dt;
    r.force_step = 1; /* 67 ns is what [P] takes; the safe estimate may be a little less */
    if (t) {
        (void)MUST(b, peri_on_break(b, on_break, t));
        r.frame_steps = 1;
        r.on_frame = on_frame;
        r.user = t;
    }
    return (int32_t)MUST(b, peri_advance(b, &r));
}

static double *get(peri_body *b, int32_t field) {
    int64_t n = MUST(b, peri_size_of_field(b, field));
    double *x = (double *)calloc((size_t)n + 1, sizeof *x);
    (void)MUST(b, peri_get_field(b, field, x, n));
    return x;
}

/* Displacement, velocity and damage of both bodies: the same bits? */
static int same_bits(peri_body *a, peri_body *b) {
    const int32_t fields[3] = {PERI_FIELD_DISPLACEMENT, PERI_FIELD_VELOCITY, PERI_FIELD_DAMAGE};
    int k, same = peri_point_count(a) == peri_point_count(b) && peri_broken_count(a) == peri_broken_count(b);
    for (k = 0; k < 3 && same; ++k) {
        double *x = get(a, fields[k]), *y = get(b, fields[k]);
        same = memcmp(x, y, (size_t)peri_size_of_field(a, fields[k]) * sizeof *x) == 0;
        free(x);
        free(y);
    }
    return same;
}

/* ---- cases -------------------------------------------------------------------------------------------------------- */

/* The full run through the library, made once, for all cases that look at it; main destroys it. */
static peri_body *full;
static trace full_trace;
static peri_body *full_run(void) {
    scene s = glass(300, 1);
    if (full) return full;
    full = plate(&s, NULL);
    full_trace.history = (int64_t *)calloc((size_t)s.steps + 1, sizeof(int64_t));
    (void)march(full, &s, s.steps, &full_trace);
    return full;
}

/* SOURCE OF TRUTH: the textbook program of glass.h, and the 992,916 directed bonds that [P]'s program reports. Broken bonds after
   every step, 642 of the whole plate, and in the end bond by bond. */
static void as_in_the_textbook(const scene *s, peri_body *b, const trace *run) {
    textbook t = textbook_make(s);
    const trace tr = *run;
    int64_t k, differ = 0, first = -1;
    int same = 1, a;
    CHECK(peri_entry_count(b) == t.directed);
    CHECK(peri_cut_count(b) == t.cut);
    textbook_run(&t, s);
    for (k = 1; k <= s->steps; ++k)
        if (tr.history[k] != t.history[k]) {
            differ++;
            if (first < 0) first = k;
        }
    CHECK(differ == 0);
    for (k = 0; k < tr.count; ++k) { /* every bond that broke here is broken there */
        for (a = 0; a < t.size[tr.e[k].i] && t.id[tr.e[k].i * t.width + a] != tr.e[k].j;) ++a;
        if (a == t.size[tr.e[k].i] || t.alive[tr.e[k].i * t.width + a]) same = 0;
    }
    CHECK(same && tr.count == peri_broken_count(b) && tr.count > 3 * s->nx);
    printf("    %d directed bonds, %d cut, %d broken (textbook %d); steps that differ: %d, the first %d\n", (int)t.directed,
           (int)t.cut, (int)tr.count, (int)t.history[s->steps], (int)differ, (int)first);
    textbook_free(&t);
}
static void textbook_breaks_the_same_bonds(void) {
    scene s = glass(150, 1);
    peri_body *b = plate(&s, NULL);
    trace t;
    memset(&t, 0, sizeof t);
    t.history = (int64_t *)calloc((size_t)s.steps + 1, sizeof(int64_t));
    (void)march(b, &s, s.steps, &t);
    as_in_the_textbook(&s, b, &t);
    CHECK(peri_entry_count(full_run()) == 992916);
    free(t.e);
    free(t.history);
    peri_body_destroy(b);
}
static void textbook_breaks_the_same_bonds_full(void) {
    scene s = glass(300, 1);
    peri_body *b = full_run();
    CHECK(s.steps == 642);
    as_in_the_textbook(&s, b, &full_trace);
}

/* Rows (of 2 columns around `column`) where damage > 0.3, gathered into clusters at most 2 rows apart. Centres in cells from
   mid-height; returns their number, at most 8. */
static int clusters(const double *damage, const scene *s, int col, double *centre) {
    int count = 0, last = -10, start = 0, row;
    for (row = 0; row < s->ny; ++row)
        if (fmax(damage[row * s->nx + col], damage[row * s->nx + col + 1]) > 0.3) {
            if (row - last > 3 && count < 8) {
                count++;
                start = row;
            }
            centre[count - 1] = 0.5 * (start + row) + 0.5 - 0.5 * s->ny;
            last = row;
        }
    return count;
}

/* SOURCE OF TRUTH: [P] fig. 9 and the problem's symmetry: one straight crack, then two branches, mirror images. */
static void one_crack_then_two_branches(void) {
    scene s = glass(300, 1);
    double *damage = get(full_run(), PERI_FIELD_DAMAGE), centre[8], reach = -1;
    int n, k, col, stem, split = -1, odd = 0;
    for (k = 0; k < s.nx * s.ny; ++k)
        if (damage[k] > 0.35) reach = fmax(reach, 0.5 * s.cell * site_x(&s, k));
    CHECK(reach > 0.02);
    col = (int)((reach + 0.05 - 0.003) / s.cell); /* 3 mm behind the tips */
    n = clusters(damage, &s, col, centre);
    CHECK(n == 2);
    if (n == 2) {
        CHECK(fabs(centre[0] + centre[1]) <= 1);           /* mirror images, to a cell */
        CHECK((centre[1] - centre[0]) * s.cell > 0.004);   /* and well apart */
        printf("    tips at x = %.4f, branches there at y = %.4f and %.4f\n", reach, centre[0] * s.cell, centre[1] * s.cell);
    }
    for (stem = (int)(0.01 / s.cell); stem + 1 < (int)(0.0555 / s.cell); ++stem) { /* notch and stem, x up to 0.005 */
        n = clusters(damage, &s, stem, centre);
        if (n != 1 || fabs(centre[0]) > 1) odd++;
    }
    CHECK(odd == 0);
    for (k = stem; k < col && split < 0; ++k)
        if (clusters(damage, &s, k, centre) == 2) split = k;
    printf("    the crack splits at about x = %.4f\n", split * s.cell - 0.05);
    for (k = 0; k < s.nx * s.ny; ++k) /* damage is symmetric as well, to one bond of 28 */
        if (fabs(damage[k] - damage[(s.ny - 1 - k / s.nx) * s.nx + k % s.nx]) > 1.01 / 28) odd++;
    CHECK(odd == 0);
    free(damage);
}

/* SOURCE OF TRUTH: the problem is its own mirror image. (1) The points given at mirrored places, through peri_add_points, move in
   mirror image. (2) The lower half of the box moves as its upper half, although families there come, and are summed, in another
   order. Both to 1e-6 of the largest displacement while the crack runs straight. */
static void mirrored(int nx) {
    scene s = glass(nx, 1);
    int n = nx * s.ny, *order = (int *)calloc((size_t)n, sizeof *order), k;
    options o;
    peri_body *a = plate(&s, NULL), *b;
    trace t;
    double *x = get(a, PERI_FIELD_POSITION), *u, *w, most = 0, worst = 0, self = 0;
    for (k = 0; k < n; ++k) order[k] = k;
    memset(&o, 0, sizeof o);
    o.order = order;
    o.mirror = 1;
    b = plate(&s, &o);
    memset(&t, 0, sizeof t);
    t.x = x;
    t.stop_x = 0.01;
    t.tip = -1;
    CHECK(march(a, &s, s.steps, &t) == PERI_STOPPED);
    CHECK(peri_broken_count(a) > 100);
    (void)march(b, &s, (int)peri_step_count(a), NULL);
    CHECK(peri_entry_count(a) == peri_entry_count(b) && peri_cut_count(a) == peri_cut_count(b));
    CHECK(peri_broken_count(a) == peri_broken_count(b));
    u = get(a, PERI_FIELD_DISPLACEMENT);
    w = get(b, PERI_FIELD_DISPLACEMENT);
    for (k = 0; k < n; ++k) {
        int image = (s.ny - 1 - k / nx) * nx + k % nx;
        self = fmax(self, hypot(u[2 * k] - u[2 * image], u[2 * k + 1] + u[2 * image + 1]));
        most = fmax(most, hypot(u[2 * k], u[2 * k + 1]));
        worst = fmax(worst, hypot(u[2 * k] - w[2 * k], u[2 * k + 1] + w[2 * k + 1]));
    }
    printf("    %d x %d, %d steps: mirrored points %.2e, own mirror image %.2e of the largest displacement\n", nx, s.ny,
           (int)peri_step_count(a), worst / most, self / most);
    CHECK(worst <= 1e-6 * most && self <= 1e-6 * most && most > 0);
    free(order);
    free(x);
    free(u);
    free(w);
    free(t.e);
    peri_body_destroy(a);
    peri_body_destroy(b);
}
static void mirrored_run(void) { mirrored(150); }
static void mirrored_run_full(void) { mirrored(300); }

static int by_pair(const void *a, const void *b) {
    const event *x = (const event *)a, *y = (const event *)b;
    if (x->i != y->i) return x->i < y->i ? -1 : 1;
    return (x->j > y->j) - (x->j < y->j);
}

/* SOURCE OF TRUTH: the numbering of points has no meaning. */
static void shuffled(int nx) {
    scene s = glass(nx, 1);
    int n = nx * s.ny, *order = (int *)calloc((size_t)n, sizeof *order), k, same = 1;
    uint64_t seed = 2024;
    options o;
    peri_body *a = plate(&s, NULL), *b;
    trace t, w;
    for (k = 0; k < n; ++k) order[k] = k;
    for (k = n - 1; k > 0; --k) {
        int r = (int)(test_random(&seed) * (k + 1)), keep = order[k];
        order[k] = order[r];
        order[r] = keep;
    }
    memset(&o, 0, sizeof o);
    o.order = order;
    b = plate(&s, &o);
    memset(&t, 0, sizeof t);
    memset(&w, 0, sizeof w);
    CHECK(peri_entry_count(a) == peri_entry_count(b) && peri_cut_count(a) == peri_cut_count(b));
    (void)march(a, &s, s.steps, &t);
    (void)march(b, &s, s.steps, &w);
    for (k = 0; k < w.count; ++k) {
        int32_t i = order[w.e[k].i], j = order[w.e[k].j];
        w.e[k].i = i < j ? i : j;
        w.e[k].j = i < j ? j : i;
    }
    CHECK(t.count == w.count && t.count > 100);
    if (t.count == w.count) {
        qsort(t.e, (size_t)t.count, sizeof(event), by_pair);
        qsort(w.e, (size_t)w.count, sizeof(event), by_pair);
        for (k = 0; k < t.count; ++k)
            if (by_pair(&t.e[k], &w.e[k]) != 0 || fabs(t.e[k].time - w.e[k].time) > 0.5 * s.dt) same = 0;
    }
    CHECK(same);
    printf("    %d x %d: %d bonds broken in order, %d shuffled\n", nx, s.ny, (int)t.count, (int)w.count);
    free(order);
    free(t.e);
    free(w.e);
    peri_body_destroy(a);
    peri_body_destroy(b);
}
static void shuffled_run(void) { shuffled(150); }
static void shuffled_run_full(void) { shuffled(300); }

static void backwards(void *user, int64_t count, peri_task_fn task, void *context) {
    (void)user;
    while (count-- > 0) task(context, count);
}

/* SOURCE OF TRUTH: the contract: the same bits for any number of threads and any order of a caller's tasks. */
static void bits(int nx, int32_t precision) {
    scene s = glass(nx, 1);
    options o;
    peri_body *one, *other;
    int threads;
    memset(&o, 0, sizeof o);
    o.precision = precision;
    o.threads = 1;
    one = plate(&s, &o);
    (void)march(one, &s, s.steps, NULL);
    CHECK(peri_broken_count(one) > 100);
    for (threads = 0; threads <= 3; ++threads) {
        o.threads = threads;
        o.parallel_for = threads ? NULL : backwards;
        if (threads == 1) continue;
        other = plate(&s, &o);
        (void)march(other, &s, s.steps, NULL);
        CHECK(same_bits(one, other));
        peri_body_destroy(other);
    }
    peri_body_destroy(one);
}
static void same_bits_on_any_threads(void) {
    bits(150, PERI_PRECISION_DOUBLE);
    if (!test_long) return; /* test_failure has single precision */
    bits(150, PERI_PRECISION_SINGLE);
    bits(150, PERI_PRECISION_MIXED);
}
static void same_bits_on_any_threads_full(void) { bits(300, PERI_PRECISION_DOUBLE); }

/* SOURCE OF TRUTH: physics has no units. Metres, millimetres, nanometres: same families, cuts, and breaks in the same order at
   the same times; float finds the same bonds too. Stretches to 1e-9: rounding (1e-16) grown over the run. */
static void units(int nx) {
    const double metre[3] = {1, 1e3, 1e9};
    peri_body *ref = NULL;
    trace t[3];
    int32_t *rows[2] = {NULL, NULL};
    size_t bytes = 0;
    int k, p, e;
    memset(t, 0, sizeof t);
    for (k = 0; k < 3; ++k)
        for (p = 0; p < 2; ++p) {
            scene s = glass(nx, metre[k]);
            options o;
            peri_body *b;
            double c = 0, s0 = 0;
            memset(&o, 0, sizeof o);
            o.precision = p ? PERI_PRECISION_SINGLE : PERI_PRECISION_DOUBLE;
            b = plate(&s, &o);
            if (!ref) bytes = (size_t)peri_point_count(b) * (size_t)peri_family_width(b) * sizeof(int32_t);
            if (!rows[0]) rows[0] = (int32_t *)calloc(1, bytes), rows[1] = (int32_t *)calloc(1, bytes);
            (void)MUST(b, peri_get_families(b, 0, peri_point_count(b), rows[ref ? 1 : 0], (int64_t)(bytes / 4)));
            if (ref) {
                CHECK(peri_family_width(b) == peri_family_width(ref) && memcmp(rows[0], rows[1], bytes) == 0);
                CHECK(peri_cut_count(b) == peri_cut_count(ref));
            }
            (void)MUST(b, peri_get_bond_constants(b, peri_id(b, PERI_KIND_MATERIAL, 1), peri_id(b, PERI_KIND_MATERIAL, 1), &c, &s0));
            CHECK_NEAR(c, 9 * s.young / (PI * pow(s.horizon, 3)), 1e-10, 0);
            CHECK_NEAR(s0, sqrt(4 * PI * s.g0 / (9 * s.young * s.horizon)), 1e-10, 0);
            if (p) { /* floats: a hundred steps, all finite, and the same scale of motion */
                double *u, most = 0;
                (void)march(b, &s, 100, NULL);
                u = get(b, PERI_FIELD_DISPLACEMENT);
                for (e = 0; e < 2 * s.nx * s.ny; ++e) most = u[e] == u[e] ? fmax(most, fabs(u[e])) : HUGE_VAL;
                CHECK(most > 1e-8 * s.m && most < 1e-4 * s.m);
                free(u);
            } else (void)march(b, &s, s.steps, &t[k]);
            if (!ref) ref = b;
            else peri_body_destroy(b);
        }
    CHECK(t[0].count > 100);
    for (k = 1; k < 3; ++k) {
        CHECK(t[k].count == t[0].count);
        for (e = 0; e < t[0].count && e < t[k].count; ++e) {
            CHECK(t[k].e[e].i == t[0].e[e].i && t[k].e[e].j == t[0].e[e].j);
            CHECK_NEAR(t[k].e[e].time, t[0].e[e].time, 1e-12, 0);
            CHECK_NEAR(t[k].e[e].stretch, t[0].e[e].stretch, 1e-9, 0);
        }
    }
    for (k = 0; k < 3; ++k) free(t[k].e);
    free(rows[0]);
    free(rows[1]);
    peri_body_destroy(ref);
}
static void same_in_metres_millimetres_nanometres(void) { units(150); }

/* 63 x 25 cells, horizon 3.5 cells, a notch along the middle row from the left edge to the middle point, pulled upwards. */
static peri_body *odd_plate(const scene *s, int32_t precision) {
    const double lo[2] = {-0.5 * s->nx * s->cell, -0.5 * s->ny * s->cell}, hi[2] = {-lo[0], -lo[1]};
    specimen p = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, s->cell, s->horizon / s->cell, s->nx, s->ny, 1);
    peri_body *b;
    const double a[2] = {lo[0], 0}, z[2] = {0, 0}, up[2] = {0, 4 * s->stress / s->cell};
    memcpy(p.lo, lo, sizeof lo);
    memcpy(p.hi, hi, sizeof hi);
    p.desc.horizon = s->horizon;
    p.desc.precision = precision;
    p.desc.threads = 0;
    p.material.young = s->young;
    p.material.density = s->density;
    p.material.fracture_energy = s->g0;
    b = specimen_make(&p);
    CHECK(peri_point_count(b) == s->nx * s->ny);
    (void)MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, a, z));
    (void)MUST(b, peri_apply_body_force(b, (int32_t)MUST(b, peri_select_box(b, NULL, a, hi)), up, NULL, NULL));
    return b;
}

/* SOURCE OF TRUTH: integer arithmetic. Horizon 3.5 cells (di^2 + dj^2 <= 12 of 12.25) and an odd number of rows, so that the
   notch runs through points: each of them loses all its bonds and flies free, and nothing is NaN. */
static void notch_through_points(void) {
    const double metre[3] = {1, 1e3, 1e9};
    int64_t broken[2][3];
    int k, p, i, j;
    for (p = 0; p < 2; ++p)
        for (k = 0; k < 3; ++k) {
            scene s = glass(60, metre[k]);
            peri_body *b;
            double *damage, *u;
            int64_t bonds = 0, cut = 0;
            int finite = 1, wrong = 0;
            s.nx = 63;
            s.ny = 25;
            s.horizon = 3.5 * s.cell;
            b = odd_plate(&s, p ? PERI_PRECISION_SINGLE : PERI_PRECISION_DOUBLE);
            for (i = 0; i < s.nx * s.ny; ++i)
                for (j = 0; j < i; ++j) {
                    int dx = (site_x(&s, i) - site_x(&s, j)) / 2, dy = (site_y(&s, i) - site_y(&s, j)) / 2;
                    if (dx * dx + dy * dy > 12) continue;
                    bonds++;
                    cut += meets_notch(&s, i, j);
                    wrong += peri_bond_is_intact(b, i, j) != !meets_notch(&s, i, j);
                }
            CHECK(wrong == 0 && peri_entry_count(b) == 2 * bonds && peri_cut_count(b) == cut);
            s.dt = 0.5 * peri_stable_step(b);
            (void)march(b, &s, 150, NULL);
            damage = get(b, PERI_FIELD_DAMAGE);
            u = get(b, PERI_FIELD_DISPLACEMENT);
            for (i = 0; i < s.nx * s.ny; ++i) {
                if (!(fabs(u[2 * i]) < s.m && fabs(u[2 * i + 1]) < s.m && damage[i] >= 0 && damage[i] <= 1)) finite = 0;
                if (site_y(&s, i) == 0 && site_x(&s, i) <= 0) CHECK(damage[i] == 1);
            }
            CHECK(finite);
            broken[p][k] = peri_broken_count(b);
            CHECK(broken[p][k] > 20);
            if (k && !p) CHECK(broken[p][k] == broken[p][0]);
            free(damage);
            free(u);
            peri_body_destroy(b);
        }
    printf("    broken after 150 steps: %d, in float %d\n", (int)broken[0][0], (int)broken[1][0]);
}

/* SOURCE OF TRUTH: the contract: no hidden state. */
static void reset_clone_and_neighbours(void) {
    scene s = glass(150, 1);
    peri_body *a = plate(&s, NULL), *b = plate(&s, NULL), *c = NULL, *d = plate(&s, NULL);
    int k;
    (void)march(a, &s, s.steps, NULL);
    CHECK(peri_broken_count(a) > 100);
    (void)march(b, &s, s.steps, NULL);
    CHECK(same_bits(a, b));
    (void)MUST(b, peri_reset(b)); /* reset and run again */
    CHECK(peri_broken_count(b) == 0 && peri_cut_count(b) == peri_cut_count(a) && peri_time(b) == 0);
    CHECK(!same_bits(a, b));
    (void)march(b, &s, s.steps / 2, NULL);
    (void)MUST(b, peri_body_clone(b, &c, NULL)); /* a clone in the middle of the run, both go on, one after the other */
    CHECK(same_bits(b, c) && peri_step_count(c) == s.steps / 2);
    (void)march(b, &s, s.steps - s.steps / 2, NULL);
    CHECK(!same_bits(b, c));
    (void)march(c, &s, s.steps - s.steps / 2, NULL);
    CHECK(same_bits(a, b) && same_bits(a, c));
    (void)MUST(c, peri_reset(c));
    (void)MUST(d, peri_reset(d));
    peri_body_destroy(b); /* the clone lives on */
    for (k = 0; k < s.steps; ++k) { /* two bodies by turns */
        (void)march(c, &s, 1, NULL);
        (void)march(d, &s, 1, NULL);
    }
    CHECK(same_bits(a, c) && same_bits(a, d));
    peri_body_destroy(a);
    peri_body_destroy(c);
    peri_body_destroy(d);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(textbook_breaks_the_same_bonds);
    RUN(one_crack_then_two_branches);
    RUN(mirrored_run);
    RUN(shuffled_run);
    RUN(same_bits_on_any_threads);
    RUN(same_in_metres_millimetres_nanometres);
    RUN(notch_through_points);
    RUN(reset_clone_and_neighbours);
    LONG_RUN(textbook_breaks_the_same_bonds_full);
    LONG_RUN(mirrored_run_full);
    LONG_RUN(shuffled_run_full);
    LONG_RUN(same_bits_on_any_threads_full);
    peri_body_destroy(full);
    free(full_trace.e);
    free(full_trace.history);
    return test_end("test_branching");
}
