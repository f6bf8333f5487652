/* SPDX-License-Identifier: MIT */
/* runs.c - the tangent, the price of what a scene uses, and whole runs: a game, fracture, a large body. By the public API alone, linked
   as `make lib` compiles it. */
#include "scene.h"

/* ---- operator ----------------------------------------------------------------------------------------------------- */

static void operator_row(bench_run *run, table *t, int32_t law, int32_t space, int32_t precision, int32_t cloud) {
    const int64_t edge = space == PERI_SPACE_SOLID ? 40 : 300;
    const bench_case c = { law, space, precision, PERI_GEOMETRY_LINEAR, 1, 0.0, cloud, { edge, edge, edge }, 3 };
    bench_facts facts;
    peri_body *body = scene_build(&c, &facts);
    double best = 1e300, *in, *out;
    char name[128];
    case_name(&c, name, sizeof name);
    put_text(t, name);
    if (!body) {
        for (int k = 1; k < t->count; ++k) put_number(t, NOTHING);
        return;
    }
    const int64_t size = peri_size_of_field(body, PERI_FIELD_DISPLACEMENT);
    in = doubles(size);
    out = doubles(size);
    scene_shake(body);
    need(body, peri_get_field(body, PERI_FIELD_DISPLACEMENT, in, size));
    for (int64_t r = -1; r < run->repeats; ++r) { /* the first brings the force up to date, too */
        const double start = processor_seconds();
        need(body, peri_multiply_stiffness(body, in, out, size));
        if (r >= 0 && processor_seconds() - start < best) best = processor_seconds() - start;
    }
    put_number(t, best * 1e9 / (double)facts.bonds);
    put_number(t, scene_best(body, run->repeats) * 1e9 / (double)facts.bonds);
    put_number(t, facts.bytes);
    free(in);
    free(out);
    peri_body_destroy(body);
}

void bench_operator(bench_run *run) {
    static const column columns[] = {
        { "case", "case", -40, 0 }, { "product", "product_ns_per_bond", 8, 2 }, { "step", "step_ns_per_bond", 8, 2 },
        { "bytes/pt", "bytes_per_point", 8, 0 },
    };
    static const int32_t laws[] = { PERI_LAW_BOND_BASED, PERI_LAW_LPS };
    static const int32_t reals[] = { PERI_PRECISION_DOUBLE, PERI_PRECISION_MIXED, PERI_PRECISION_SINGLE };
    table t;
    printf("\nLinear geometry, elastic: ns per bond of peri_multiply_stiffness, its vectors turned from and to the caller's layout, and\n"
           "of a step");
    table_open(&t, "out/operator.csv", columns, (int)(sizeof columns / sizeof columns[0]));
    for (int law = 0; law < 2; ++law)
        for (int real = 0; real < 3; ++real) {
            operator_row(run, &t, laws[law], PERI_SPACE_PLANE_STRESS, reals[real], 0);
            operator_row(run, &t, laws[law], PERI_SPACE_SOLID, reals[real], 0);
            operator_row(run, &t, laws[law], PERI_SPACE_SOLID, reals[real], 1);
        }
    table_close(&t);
}

/* ---- what a scene uses -------------------------------------------------------------------------------------------- */

typedef enum asked { NOTHING_ASKED, ENERGY_ASKED, STRESS_ASKED } asked;

/* Seconds of a step, and of reading what is asked for after it. */
static double step_and_ask(peri_body *body, int64_t repeats, asked what) {
    const int64_t size = peri_size_of_field(body, PERI_FIELD_STRESS);
    double best = 1e300, *stress = doubles(size);
    for (int64_t r = -1; r < repeats; ++r) {
        const double start = processor_seconds();
        peri_energy energy;
        (void)scene_steps(body, 1, 1);
        if (what >= ENERGY_ASKED) need(body, peri_get_energy(body, &energy));
        if (what >= STRESS_ASKED) need(body, peri_get_field(body, PERI_FIELD_STRESS, stress, size));
        if (r >= 0 && processor_seconds() - start < best) best = processor_seconds() - start;
    }
    free(stress);
    return best;
}

/* Seconds of what a step does once per point: where the line through the steps of bodies with 6 and with 18 bonds a point meets 0
   bonds. */
static double pointwise(const bench_case *like, int64_t repeats) {
    double time[2], bonds[2];
    for (int k = 0; k < 2; ++k) {
        bench_case c = *like;
        bench_facts facts;
        c.m = k == 0 ? 1.0 : 1.5;
        peri_body *body = scene_build(&c, &facts);
        if (!body) exit(1);
        scene_shake(body);
        time[k] = scene_best(body, repeats);
        bonds[k] = (double)facts.bonds;
        peri_body_destroy(body);
    }
    return (time[0] * bonds[1] - time[1] * bonds[0]) / (bonds[1] - bonds[0]);
}

static void unused_rows(bench_run *run, table *t, int32_t precision, const char *real) {
    static const struct use { const char *name; int32_t law; double critical; asked what; } uses[] = {
        { "bond-based, elastic", PERI_LAW_BOND_BASED, 0.0, NOTHING_ASKED }, { "+ damage", PERI_LAW_BOND_BASED, 0.5, NOTHING_ASKED },
        { "+ state-based (LPS)", PERI_LAW_LPS, 0.5, NOTHING_ASKED },        { "+ energy read each step", PERI_LAW_LPS, 0.5, ENERGY_ASKED },
        { "+ stress read each step", PERI_LAW_LPS, 0.5, STRESS_ASKED },
    };
    double ns = 0.0, bytes = 0.0;
    for (size_t k = 0; k < sizeof uses / sizeof uses[0]; ++k) {
        const bench_case c = { uses[k].law, PERI_SPACE_SOLID, precision, PERI_GEOMETRY_NONLINEAR, 1, uses[k].critical, 0,
                               { 40, 40, 40 }, 3 };
        bench_facts facts;
        peri_body *body = scene_build(&c, &facts);
        const char *part;
        if (!body) {
            put_text(t, uses[k].name);
            put_text(t, real);
            for (int n = 2; n < t->count; ++n) put_number(t, NOTHING);
            continue;
        }
        facts.columns = facts.bonds / 16; /* a lattice: what no API tells, as if all lanes held a bond */
        const bench_work w = work_of(&c, &facts);
        const double limit = limit_of(&run->machine, &c, &w, &part);
        scene_shake(body);
        const double now = step_and_ask(body, run->repeats, uses[k].what) * 1e9 / (double)facts.bonds;
        const double held = (double)bytes_now / (double)facts.points;
        if (k == 0) {
            const double alone = now - pointwise(&c, run->repeats) * 1e9 / (double)facts.bonds;
            put_text(t, "force pass alone");
            put_text(t, real);
            put_number(t, alone);
            put_number(t, NOTHING);
            put_number(t, NOTHING);
            put_number(t, NOTHING);
            put_number(t, 100.0 * limit / alone);
            ns = alone;
        }
        put_text(t, uses[k].name);
        put_text(t, real);
        put_number(t, now);
        put_number(t, now - ns);
        put_number(t, held);
        put_number(t, k == 0 ? NOTHING : held - bytes);
        put_number(t, uses[k].what == NOTHING_ASKED ? 100.0 * limit / now : NOTHING);
        ns = now;
        bytes = held;
        peri_body_destroy(body);
    }
}

void bench_unused(bench_run *run) {
    static const column columns[] = {
        { "3D 40^3, m=3, lattice", "scene", -26, 0 }, { "", "precision", -5, 0 },
        { "ns/bond", "ns_per_bond", 8, 2 },           { "added", "added_ns_per_bond", 8, 2 },
        { "bytes/pt", "bytes_per_point", 8, 0 },      { "added", "added_bytes_per_point", 8, 0 },
        { "share %", "share_percent", 7, 0 },
    };
    table t;
    printf("\nWhat a scene pays for what it uses, row by row one thing more. The force pass alone is the step of the first scene less\n"
           "what it does per point, by steps of bodies with 6 and 18 bonds a point");
    table_open(&t, "out/unused.csv", columns, (int)(sizeof columns / sizeof columns[0]));
    unused_rows(run, &t, PERI_PRECISION_DOUBLE, "f64");
    unused_rows(run, &t, PERI_PRECISION_MIXED, "mixed");
    unused_rows(run, &t, PERI_PRECISION_SINGLE, "f32");
    table_close(&t);
}

/* ---- a game ------------------------------------------------------------------------------------------------------- */

#define FRAMES 120

/* A block of 22 x 22 x 21 points in single precision, critical stretch 0.02, falls on the floor at `speed` (of sound: 1). A step to begin
   with; then three steps a frame, and current positions as floats. Runs are the same to the last bit, so the least time of a frame over
   runs is that of the same work. Frames are told apart by whether no bond is broken yet, some break in them, or only before them. */
static void play(bench_run *run, table *t, double speed) {
    static const char *const names[] = { "whole", "breaking", "in pieces" };
    const bench_case c = { PERI_LAW_BOND_BASED, PERI_SPACE_SOLID, PERI_PRECISION_SINGLE, PERI_GEOMETRY_NONLINEAR, 1, 0.02, 0,
                          { 22, 22, 21 }, 3 };
    const double down[3] = { 0, 0, -speed };
    double best[FRAMES], mean[3] = { 0, 0, 0 }, worst[3] = { 0, 0, 0 }, *rest;
    int64_t broken[FRAMES + 1], frames[3] = { 0, 0, 0 };
    bench_facts facts;
    peri_body *body = scene_build(&c, &facts);
    if (!body) exit(1);
    const int64_t size = peri_size_of_field(body, PERI_FIELD_POSITION);
    float *place = (float *)malloc((size_t)size * sizeof *place);
    rest = doubles(size);
    if (!place) exit(1);
    need(body, peri_get_field(body, PERI_FIELD_POSITION, rest, size));
    peri_obstacle_desc ground;
    peri_obstacle_desc_init(&ground, PERI_SHAPE_PLANE);
    ground.place[2] = -0.5;
    ground.normal[2] = 1;
    need(body, peri_add_obstacle(body, &ground));
    for (int k = 0; k < FRAMES; ++k) best[k] = 1e300;
    for (int64_t r = 0; r < run->repeats; ++r) {
        need(body, peri_reset(body));
        need(body, peri_add_velocity(body, PERI_ALL, down));
        (void)scene_steps(body, 1, 1);
        broken[0] = 0;
        for (int k = 0; k < FRAMES; ++k) {
            const double start = processor_seconds();
            peri_view view;
            (void)scene_steps(body, 3, 1);
            need(body, peri_view_field(body, PERI_FIELD_DISPLACEMENT, &view));
            for (int32_t d = 0; d < 3; ++d) {
                const float *u = (const float *)view.data + d * view.component_stride, scale = (float)view.scale;
                for (int64_t i = 0; i < view.count; ++i) place[3 * i + d] = (float)rest[3 * i + d] + scale * u[i * view.point_stride];
            }
            if (processor_seconds() - start < best[k]) best[k] = processor_seconds() - start;
            broken[k + 1] = peri_broken_count(body);
        }
    }
    for (int k = 0; k < FRAMES; ++k) {
        const int phase = broken[k + 1] == 0 ? 0 : broken[k + 1] > broken[k] ? 1 : 2;
        frames[phase]++;
        mean[phase] += 1e3 * best[k];
        if (1e3 * best[k] > worst[phase]) worst[phase] = 1e3 * best[k];
    }
    for (int phase = 0; phase < 3; ++phase) {
        put_text(t, names[phase]);
        put_number(t, speed);
        put_number(t, (double)facts.points);
        put_number(t, (double)frames[phase]);
        put_number(t, frames[phase] ? mean[phase] / (double)frames[phase] : NOTHING);
        put_number(t, frames[phase] ? worst[phase] : NOTHING);
        put_number(t, 3.0);
        put_number(t, phase ? (double)broken[FRAMES] : 0.0);
        put_number(t, 100.0 * (phase ? (double)broken[FRAMES] : 0.0) * 2.0 / (double)facts.bonds);
        put_number(t, (double)bytes_now / (double)facts.points);
    }
    free(rest);
    free(place);
    peri_body_destroy(body);
}

void bench_game(bench_run *run) {
    static const column columns[] = {
        { "block", "frames_are", -10, 0 }, { "speed", "speed", 6, 2 },       { "points", "points", 7, 0 }, { "frames", "frames", 6, 0 },
        { "mean ms", "mean_ms", 8, 2 },    { "worst ms", "worst_ms", 8, 2 }, { "bar", "bar_ms", 5, 1 },    { "broken", "broken", 8, 0 },
        { "%", "broken_percent", 5, 1 },   { "bytes/pt", "bytes_per_point", 8, 0 },
    };
    table t;
    printf("\nA game: a block falls, three steps a frame and positions read as floats, one core");
    table_open(&t, "out/game.csv", columns, (int)(sizeof columns / sizeof columns[0]));
    play(run, &t, 0.02);
    play(run, &t, 0.05);
    table_close(&t);
}

/* ---- fracture ----------------------------------------------------------------------------------------------------- */

void bench_branching(bench_run *run) {
    static const column columns[] = {
        { "branching", "precision", -10, 0 }, { "points", "points", 8, 0 }, { "steps", "steps", 6, 0 },
        { "s", "seconds", 8, 3 },             { "ns/bond", "ns_per_bond", 8, 2 }, { "broken", "broken", 8, 0 },
    };
    static const int32_t reals[] = { PERI_PRECISION_DOUBLE, PERI_PRECISION_MIXED, PERI_PRECISION_SINGLE };
    static const char *const names[] = { "f64", "mixed", "f32" };
    table t;
    (void)run;
    printf("\nCrack branching in glass, 43 us, as in the tests of branching: all of its steps, the best of three runs");
    table_open(&t, "out/branching_time.csv", columns, (int)(sizeof columns / sizeof columns[0]));
    for (int k = 0; k < 3; ++k) {
        double step, best = 1e300;
        int64_t steps;
        peri_advance_desc march;
        peri_body *body = glass_plate(reals[k], &step, &steps);
        put_text(&t, names[k]);
        if (!body) {
            for (int n = 1; n < t.count; ++n) put_number(&t, NOTHING);
            continue;
        }
        peri_advance_desc_init(&march);
        march.time_step = step;
        march.steps = steps;
        for (int r = 0; r < 3; ++r) {
            need(body, peri_reset(body));
            const double start = processor_seconds();
            need(body, peri_advance(body, &march));
            if (processor_seconds() - start < best) best = processor_seconds() - start;
        }
        put_number(&t, (double)peri_point_count(body));
        put_number(&t, (double)steps);
        put_number(&t, best);
        put_number(&t, best * 1e9 / ((double)steps * (double)peri_entry_count(body)));
        put_number(&t, (double)peri_broken_count(body));
        peri_body_destroy(body);
    }
    table_close(&t);
}

/* ---- 8 million points --------------------------------------------------------------------------------------------- */

/* Most memory that the process ever had, as the system counts it: 0 where it does not tell. */
static double resident_most(void) {
    FILE *file = fopen("/proc/self/status", "r");
    char line[256];
    double kib = 0.0;
    while (file && fgets(line, sizeof line, file))
        if (strncmp(line, "VmHWM:", 6) == 0) kib = atof(line + 6);
    if (file) (void)fclose(file);
    return kib * 1024.0;
}

void bench_large(bench_run *run) {
    static const column columns[] = {
        { "200^3, f32, m=3", "scene", -16, 0 }, { "points", "points", 9, 0 },     { "bonds", "bonds", 11, 0 },
        { "build s", "build_s", 8, 2 },         { "ns/bond", "build_ns_per_bond", 8, 1 }, { "step s", "step_s", 7, 3 },
        { "ns/bond", "ns_per_bond", 8, 2 },     { "held MB", "held_mb", 8, 0 },   { "most MB", "most_mb", 8, 0 },
        { "VmHWM MB", "vmhwm_mb", 9, 0 },       { "bar", "bar_mb", 6, 0 },
    };
    const bench_case c = { PERI_LAW_BOND_BASED, PERI_SPACE_SOLID, PERI_PRECISION_SINGLE, PERI_GEOMETRY_NONLINEAR, 1, 0.5, 0,
                          { 200, 200, 200 }, 3 };
    const double slow[3] = { 1e-3, 0, 0 };
    bench_facts facts;
    peri_body *body = scene_build(&c, &facts);
    const uint64_t most = bytes_most;
    table t;
    if (!body) exit(1);
    need(body, peri_add_velocity(body, PERI_ALL, slow));
    const double step = scene_best(body, run->repeats);
    printf("\nA large body, damage on");
    table_open(&t, "out/large.csv", columns, (int)(sizeof columns / sizeof columns[0]));
    put_text(&t, "lattice");
    put_number(&t, (double)facts.points);
    put_number(&t, (double)facts.bonds);
    put_number(&t, facts.build);
    put_number(&t, facts.build * 1e9 / (double)facts.bonds);
    put_number(&t, step);
    put_number(&t, step * 1e9 / (double)facts.bonds);
    put_number(&t, (double)bytes_now / 1e6);
    put_number(&t, (double)(bytes_most > most ? bytes_most : most) / 1e6);
    put_number(&t, resident_most() / 1e6);
    put_number(&t, 2000.0);
    table_close(&t);
    peri_body_destroy(body);
}
