/* SPDX-License-Identifier: MIT */
/* cases.c - the library compiled into a table of functions. Compiled twice into one program: as users do, -O2, and with all that the
   compiler has, -O3 -march=native; CASES names the two. It also looks inside bodies for what no API tells: the
   number of columns, which the limits of a kernel depend on. */
#define PERI_STATIC
#define PERI_IMPLEMENTATION
#include "scene.h"

#ifndef CASES
#define CASES cases_plain
#endif

static void look_inside(const peri_body *body, bench_facts *facts) {
    const peri__model *m = body->model;
    facts->columns = m->stencil.columns;
    facts->kept = m->stencil.kept;
    facts->slots = m->record_reals;
}

static peri_body *build(const bench_case *c, bench_facts *facts) {
    peri_body *body = scene_build(c, facts);
    if (!body) return NULL;
    look_inside(body, facts);
    scene_shake(body);
    return body;
}

static void harm(peri_body *body, bench_facts *facts) { scene_harm(body, facts); }
static double steps(peri_body *body, int64_t count, int32_t threads) { return scene_steps(body, count, threads); }
static void destroy(peri_body *body) { peri_body_destroy(body); }

static void read_state(peri_body *body, double *u, double *v, int64_t size) {
    need(body, peri_get_field(body, PERI_FIELD_DISPLACEMENT, u, size));
    need(body, peri_get_field(body, PERI_FIELD_VELOCITY, v, size));
}

static double *field(peri_body *body, int32_t which) {
    const int64_t size = peri_size_of_field(body, which);
    double *out = doubles(size);
    need(body, peri_get_field(body, which, out, size));
    return out;
}

static void read_textbook(peri_body *body, const bench_case *c, textbook_input *t) {
    const double nu = c->law == PERI_LAW_LPS ? 0.3 : 0.0, mu = 0.5 / (1.0 + nu), bulk = 1.0 / (3.0 * (1.0 - 2.0 * nu));
    memset(t, 0, sizeof *t);
    t->n = peri_point_count(body);
    t->width = peri_family_width(body);
    t->bonds = peri_entry_count(body);
    t->dim = peri_dimension(body);
    t->lps = c->law == PERI_LAW_LPS;
    t->id = (int32_t *)malloc((size_t)(t->n * t->width) * sizeof *t->id);
    if (!t->id) exit(1);
    need(body, peri_get_families(body, 0, t->n, t->id, t->n * t->width));
    t->x = field(body, PERI_FIELD_POSITION);
    t->u = field(body, PERI_FIELD_DISPLACEMENT);
    t->force = field(body, PERI_FIELD_FORCE_DENSITY);
    t->volume = field(body, PERI_FIELD_VOLUME);
    const int32_t id = peri_id(body, PERI_KIND_MATERIAL, 1);
    need(body, peri_get_bond_constants(body, id, id, t->lps ? NULL : &t->c, &t->s0));
    if (t->dim == 3) { /* E = 1; the table of laws in peri.h */
        t->a = 3.0 * bulk - 5.0 * mu;
        t->b = 15.0 * mu;
    } else {
        t->a = 2.0 * nu / (1.0 - nu * nu) - 2.0 * mu;
        t->b = 8.0 * mu;
    }
}

extern const suite CASES;
const suite CASES = { build, harm, steps, read_state, read_textbook, destroy };
