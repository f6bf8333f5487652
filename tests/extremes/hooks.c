/* SPDX-License-Identifier: MIT */
/* hooks.c - callbacks that stop at once and go on, files that fail at each of their pieces, and job systems of odd habits. */
#include "scenes.h"

/* ---- stopping ----------------------------------------------------------------------------------------------------- */

typedef struct stopper {
    int64_t calls, every; /* stops at each call whose number is a multiple of `every`; 0: never                           */
    int32_t with;         /* what it returns                                                                              */
} stopper;

static int32_t stop_frame(void *user, peri_body *b) {
    stopper *s = (stopper *)user;
    (void)b;
    return s->every && ++s->calls % s->every == 0 ? s->with : 0;
}
static int32_t stop_iteration(void *user, int64_t iteration, double residual) {
    (void)iteration, (void)residual;
    return stop_frame(user, NULL);
}

/* The largest difference of two arrays, over the largest entry of the first; frees both. */
static double apart(double *a, double *b, int64_t n) {
    double largest = 0, most = 0;
    for (int64_t i = 0; a && b && i < n; ++i) {
        largest = fmax(largest, fabs(a[i]));
        most = extreme_worst(most, fabs(a[i] - b[i]));
    }
    free(a);
    free(b);
    return largest > 0 ? most / largest : NAN;
}

/* A run of 12 steps that is stopped after each one, by a frame that returns `value`, against one that is not. */
static outcome stopped_run(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    for (int k = 0; k < 4; ++k) {
        double *u[2] = {NULL, NULL};
        int64_t n = 0;
        for (int stops = 0; stops < 2 && o.status >= 0; ++stops) {
            stopper s = {0, stops, (int32_t)row->value};
            peri_body *b = scene_plate(&o, scene_laws[k], precision, k % 2 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRESS);
            peri_advance_desc run;
            peri_advance_desc_init(&run);
            run.integrator = row->choice;
            run.time_step = 0.8 * peri_stable_step(b);
            run.damping = 0.02;
            run.on_frame = stop_frame;
            run.user = &s;
            for (int step = 0; step < (stops ? 12 : 1); ++step) {
                run.steps = 12 - step;
                run.frame_steps = 1;
                HOLDS(peri_advance(b, &run) == (stops ? PERI_STOPPED : PERI_OK));
                HOLDS(peri_step_count(b) == (stops ? step + 1 : 12));
            }
            u[stops] = extreme_read(&o, b, PERI_FIELD_DISPLACEMENT);
            n = peri_size_of_field(b, PERI_FIELD_DISPLACEMENT);
            o = extreme_end(o, b);
        }
        o.error = extreme_worst(o.error, apart(u[0], u[1], n));
    }
    return o;
}

/* A solve stopped at its first iteration (choice 0) or after each load step (1), and gone on with, against one that is not. */
static outcome stopped_solve(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    for (int k = 0; k < 4 * 3; ++k) {
        double *u[2] = {NULL, NULL};
        int64_t n = 0;
        for (int stops = 0; stops < 2 && o.status >= 0; ++stops) {
            stopper at = {0, stops, (int32_t)row->value};
            peri_body *b = scene_plate(&o, scene_laws[k % 4], precision, k % 2 ? PERI_SPACE_PLANE_STRAIN : PERI_SPACE_PLANE_STRESS);
            peri_solve_desc s;
            peri_solve_report report;
            peri_solve_desc_init(&s);
            s.method = PERI_METHOD_NEWTON + k / 4;
            s.fracture = 0;
            s.steps = row->choice ? 3 : 1;
            s.tolerance = precision == PERI_PRECISION_DOUBLE ? 1e-10 : precision == PERI_PRECISION_MIXED ? 1e-5 : 1e-3;
            s.user = &at;
            if (row->choice) s.on_step = stop_frame;
            else s.on_iteration = stop_iteration;
            for (int step = 1; stops && step <= (row->choice ? 3 : 1); ++step) {
                HOLDS(peri_solve(b, &s, &report) == PERI_STOPPED);
                if (row->choice) {
                    HOLDS(report.steps == 1 && fabs(report.load_factor - step / 3.0) < 1e-12);
                    s.load_from = report.load_factor;
                    s.steps--;
                } else
                    HOLDS(report.iterations == 1);
            }
            s.on_iteration = NULL;
            s.on_step = NULL;
            if (!row->choice || !stops) (void)extreme_fails(&o, b, peri_solve(b, &s, NULL));
            u[stops] = extreme_read(&o, b, PERI_FIELD_DISPLACEMENT);
            n = peri_size_of_field(b, PERI_FIELD_DISPLACEMENT);
            o = extreme_end(o, b);
        }
        o.error = extreme_worst(o.error, apart(u[0], u[1], n));
    }
    return o;
}

/* ---- files -------------------------------------------------------------------------------------------------------- */

typedef struct file { /* that fails at call number fail_at, from 1                                                        */
    int64_t  calls, fail_at, bytes;
    int32_t  with;
    uint64_t hash;
} file;

static int32_t write_file(void *user, const void *bytes, int64_t count) {
    file *f = (file *)user;
    if (++f->calls == f->fail_at) return f->with;
    f->bytes += count;
    return scene_swallow(&f->hash, bytes, count);
}

static int32_t save(peri_body *b, const peri_matrix *matrix, int which, file *f) {
    f->calls = f->bytes = 0;
    f->hash = DIGEST_START;
    switch (which) {
    case 0: return peri_export_vtu_to(b, write_file, f);
    case 1: return peri_export_history_to(b, 1, write_file, f);
    case 2: return peri_export_history_to(b, 0, write_file, f);
    default: return peri_export_matrix_to(matrix, write_file, f);
    }
}

/* VTU, history with and without its header, and matrix, failing at each call: PERI_ERROR_WRITE, no call after it, and the file made again
   has the bytes of the first. */
static outcome failing_file(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    for (int k = 0; k < 4; ++k) {
        peri_body *b = scene_plate(&o, scene_laws[k], precision, PERI_SPACE_PLANE_STRAIN);
        peri_matrix *matrix = NULL;
        if (o.status < 0) return extreme_end(o, b);
        (void)extreme_fails(&o, b, peri_matrix_create(b, &matrix));
        for (int which = 0; matrix && which < 4; ++which) {
            file whole = {0, 0, 0, 0, 0}, f = {0, 0, 0, (int32_t)row->value, 0};
            HOLDS(save(b, matrix, which, &whole) == PERI_OK && whole.calls > 0 && whole.bytes > 20);
            for (f.fail_at = 1; f.fail_at <= whole.calls; f.fail_at += f.fail_at < 50 ? 1 : 37) {
                peri_error e;
                HOLDS(save(b, matrix, which, &f) == PERI_ERROR_WRITE && f.calls == f.fail_at);
                if (which < 3) HOLDS(peri_get_error(b, &e) == PERI_OK && e.code == PERI_ERROR_WRITE);
            }
            f.fail_at = 0;
            HOLDS(save(b, matrix, which, &f) == PERI_OK && f.hash == whole.hash && f.bytes == whole.bytes);
        }
        peri_matrix_destroy(matrix);
        o = extreme_end(o, b);
    }
    return o;
}

/* ---- job systems -------------------------------------------------------------------------------------------------- */

enum { REVERSED, ODD_FIRST, SHUFFLED, THREADED, MEDDLING };

typedef struct jobs {
    int        habit;
    int64_t    calls, tasks, wrong;
    peri_body *body;
} jobs;

static void run_jobs(void *user, int64_t count, peri_task_fn task, void *context) {
    jobs *j = (jobs *)user;
    j->calls++;
    j->tasks += count;
    switch (j->habit) {
    case REVERSED:
        for (int64_t k = count - 1; k >= 0; --k) task(context, k);
        return;
    case ODD_FIRST:
        for (int64_t k = 1; k < count; k += 2) task(context, k);
        for (int64_t k = 0; k < count; k += 2) task(context, k);
        return;
    case SHUFFLED: { /* steps of the smallest number from 7 on that shares no factor with count */
        int64_t step = 7, at = 0;
        for (;; ++step) {
            int64_t a = step, b = count;
            while (b) {
                const int64_t rest = a % b;
                a = b;
                b = rest;
            }
            if (a == 1) break;
        }
        for (int64_t k = 0; k < count; ++k, at = (at + step) % count) task(context, at);
        return;
    }
    case THREADED:
#ifdef _OPENMP
#pragma omp parallel for schedule(static, 1) num_threads(3)
#endif
        for (int64_t k = 0; k < count; ++k) task(context, k);
        return;
    case MEDDLING: {
        const double v[3] = {1, 1, 1};
        if (j->body) {
            j->wrong += peri_reset(j->body) != PERI_ERROR_ORDER || peri_add_velocity(j->body, PERI_ALL, v) != PERI_ERROR_ORDER;
            j->wrong += peri_cut_if(j->body, PERI_CUT_INITIAL, NULL, NULL) != PERI_ERROR_ORDER || peri_build(j->body) != PERI_ERROR_ORDER;
            peri_body_destroy(j->body);
        }
        break;
    }
    default: break;
    }
    for (int64_t k = 0; k < count; ++k) task(context, k);
}

/* A body large enough to be shared out (1e5 bonds), under a job system: the bits of the serial one. */
static outcome odd_jobs(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    const double hi[3] = {17, 16, 16}, flat[2] = {100, 45};
    const int32_t fields[4] = {PERI_FIELD_DISPLACEMENT, PERI_FIELD_VELOCITY, PERI_FIELD_DAMAGE, PERI_FIELD_FORCE_STRESS};
    for (int k = row->choice % 2; k < 4; k += 2) { /* every other law */
        uint64_t hash[2] = {DIGEST_START, DIGEST_START};
        for (int odd = 0; odd < 2 && o.status >= 0; ++odd) {
            jobs j = {row->choice, 0, 0, 0, NULL};
            const int solid = k / 2 != row->choice / 2 % 2;
            const double pull[9] = {1.2e-2, 4e-4, 0, 0, -2e-3, 0, 1e-4, 0, 0}, plane[4] = {1.2e-2, 4e-4, 0, -2e-3};
            peri_body_desc d;
            peri_material_desc m;
            peri_advance_desc run;
            extreme_desc(&d, solid ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRESS, precision, solid ? 2.1 : 3);
            d.parallel_for = odd ? run_jobs : NULL;
            d.parallel_user = &j;
            if (k < 2) d.kernel = PERI_KERNEL_LIST;
            extreme_material(&m, scene_laws[k], 0.2, 0.0125);
            peri_body *b = j.body = extreme_box(&o, &d, &m, solid ? hi : flat, 1);
            if (o.status < 0) return extreme_end(o, b);
            extreme_affine(&o, b, solid ? pull : plane, NULL);
            peri_advance_desc_init(&run);
            run.steps = 2;
            (void)extreme_fails(&o, b, peri_advance(b, &run));
            for (int f = 0; f < 4; ++f) {
                double *x = extreme_read(&o, b, fields[f]);
                scene_digest(&hash[odd], x, peri_size_of_field(b, fields[f]));
                free(x);
            }
            HOLDS(j.wrong == 0 && (odd ? j.calls > 5 && j.tasks > 20 * j.calls : j.calls == 0));
            o = extreme_end(o, b);
        }
        HOLDS(hash[0] == hash[1]);
    }
    return o;
}

static const char *const stops = "peri.h: > 0 stops, the body is at a whole step and may go on: the same motion";
static const char *const halts = "peri.h: stopped on the way to an equilibrium, and found from there on; the equilibrium is one";
static const char *const bits = "peri.h: results do not depend on the choice, to the last bit; tasks in any order, on any threads";
static const char *const fails = "peri.h: nonzero is a failure; a call that fails has changed nothing, so the next file is whole";

static const extreme rows[] = {
    /* the velocity is brought to the whole step and back at each stop: u each time, and damping and forces take the rest */
    {"every frame stops, Verlet", stops, stopped_run, 1, 0, PERI_INTEGRATOR_VELOCITY_VERLET, PERI_OK, NULL, {1e-14, 1e-6, 1e-5}},
    {"every frame stops, central difference", stops, stopped_run, 1, 0, PERI_INTEGRATOR_CENTRAL_DIFFERENCE, PERI_OK, NULL,
     {1e-14, 1e-6, 1e-5}},
    {"every frame stops, by what reads as an id", stops, stopped_run, 1 << 27, 0, PERI_INTEGRATOR_VELOCITY_VERLET, PERI_OK, NULL,
     {1e-14, 1e-6, 1e-5}},
    {"every frame stops, by INT32_MAX", stops, stopped_run, INT32_MAX, 0, PERI_INTEGRATOR_VELOCITY_VERLET, PERI_OK, NULL,
     {1e-14, 1e-6, 1e-5}},
    /* residuals of the tolerance times the condition number of a strip 9 x 6, some 1e2 */
    {"the first iteration stops", halts, stopped_solve, 1, 0, 0, PERI_OK, NULL, {1e-8, 1e-3, 1e-1}},
    {"the first iteration stops, by 30", halts, stopped_solve, 30, 0, 0, PERI_OK, NULL, {1e-8, 1e-3, 1e-1}},
    {"every load step stops", halts, stopped_solve, 1, 0, 1, PERI_OK, NULL, {1e-8, 1e-3, 1e-1}},
    {"files that fail at each piece", fails, failing_file, 1, 0, 0, PERI_OK, NULL, {0, 0, 0}},
    {"files that fail by INT32_MIN", fails, failing_file, INT32_MIN, 0, 0, PERI_OK, NULL, {0, 0, 0}},
    {"jobs in reverse", bits, odd_jobs, 0, 0, REVERSED, PERI_OK, NULL, {0, 0, 0}},
    {"odd jobs first", bits, odd_jobs, 0, 0, ODD_FIRST, PERI_OK, NULL, {0, 0, 0}},
    {"jobs shuffled", bits, odd_jobs, 0, 0, SHUFFLED, PERI_OK, NULL, {0, 0, 0}},
    {"jobs on three threads", bits, odd_jobs, 0, 0, THREADED, PERI_OK, NULL, {0, 0, 0}},
    {"a job system that meddles", "peri.h: any change by a callback is PERI_ERROR_ORDER, destroying is ignored", odd_jobs, 0, 0, MEDDLING,
     PERI_OK, NULL, {0, 0, 0}},
};
const extreme_table extreme_hooks = EXTREME_TABLE("hooks", rows);
