/* SPDX-License-Identifier: MIT */
/* program_make.h - programs: calls that make a body: descriptors, materials, points, build, clone, plan. */
#ifndef PROGRAM_MAKE_H
#define PROGRAM_MAKE_H

#include "program_check.h"

static double young_of(const slot *o, double x) { return o->stress * x; }

static void empty_slot(slot *o) {
    int k;
    memset(o, 0, sizeof *o);
    o->space = PERI_SPACE_PLANE_STRESS;
    o->dim = 2;
    o->length = o->stress = o->density = 1.0;
    for (k = 0; k < 3; ++k) o->hi[k] = 4.0;
}

/* Frees the body of a slot, unless a call of it is under way: then that must be ignored. */
static void drop(program *p, int s) {
    slot *o = &p->slots[s];
    if (o->body && o->busy) {
        peri_body_destroy(o->body);
        HOLDS(p, peri_dimension(o->body) == o->dim);
        return;
    }
    peri_body_destroy(o->body);
    empty_slot(o);
}

static void fill_desc(program *p, int s, peri_body_desc *d) {
    /* less the first of each */
    static const int32_t influences[] = {0, 0, 0, 0, 0, 0, 0, 2, 2, 1, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 15};
    static const int32_t quadratures[] = {0, 0, 0, 0, 1, 2, 2, 4, 3, 1}, corrections[] = {0, 0, 0, 1, 2, 3, 4, 0}, kernels[] = {0, 0, 1, 2};
    static const int32_t precisions[] = {PERI_PRECISION_DOUBLE, PERI_PRECISION_DOUBLE, PERI_PRECISION_SINGLE, PERI_PRECISION_MIXED};
    static const double lengths[] = {1.0, 1.0, 1e-9, 3e4}, stresses[] = {1.0, 7e10}, densities[] = {1.0, 2440.0};
    slot *o = &p->slots[s];
    const int flags = draw(p), more = draw(p);
    peri_body_desc_init(d);
    o->space = d->space = choice(p, PERI_SPACE_PLANE_STRESS, 3);
    o->dim = d->space == PERI_SPACE_SOLID ? 3 : 2;
    o->length = lengths[flags % 4];
    o->stress = stresses[flags / 4 % 2];
    o->density = densities[flags / 8 % 2];
    d->precision = p->mood == MOOD_CHOICES ? choice(p, PERI_PRECISION_DOUBLE, 3) : precisions[flags / 16 % 4];
    d->kernel = p->mood == MOOD_CHOICES ? choice(p, PERI_KERNEL_BEST, 3) : PERI_KERNEL_BEST + kernels[flags / 64 % 4];
    d->geometry = choice(p, PERI_GEOMETRY_NONLINEAR, 2);
    d->influence = p->mood == MOOD_CHOICES ? choice(p, PERI_INFLUENCE_CONSTANT, 16) : PERI_INFLUENCE_CONSTANT + influences[below(p, 24)];
    if (p->mood == MOOD_CHOICES) d->quadrature = choice(p, PERI_QUADRATURE_FULL, 5);
    else d->quadrature = PERI_QUADRATURE_FULL + quadratures[below(p, o->dim == 3 ? 7 : 10)];
    d->correction = p->mood == MOOD_CHOICES ? choice(p, PERI_CORRECTION_NONE, 5) : PERI_CORRECTION_NONE + corrections[more % 8];
    if (p->mood == 0 && d->quadrature >= PERI_QUADRATURE_PARTIAL_CENTROID) d->correction = PERI_CORRECTION_NONE;
    d->break_timing = p->mood == MOOD_CHOICES ? choice(p, PERI_BREAK_WITHIN_STEP, 2) : PERI_BREAK_WITHIN_STEP + more / 8 % 2;
    d->moments = p->mood == MOOD_CHOICES ? choice(p, PERI_MOMENTS_LIVE, 2) : PERI_MOMENTS_LIVE + more / 4 % 2;
    d->ledger = more / 16 % 4 != 3;
    d->threads = 1;
    d->horizon = number(p, o->length, 3.5 * o->length);
    d->thickness = o->dim == 2 ? number(p, 0.25 * o->length, o->length) : 1.0;
    d->instructions = p->mood == MOOD_CHOICES ? choice(p, PERI_INSTRUCTIONS_BEST, 4) : PERI_INSTRUCTIONS_BEST;
    if (more / 64 == 3) d->number = o->number = 1 + flags % 127;
    if (d->influence == PERI_INFLUENCE_USER) d->influence_user = new_hook(p, s, INFLUENCE_KINDS);
    if (d->influence == PERI_INFLUENCE_USER) d->influence_fn = GIVEN(0, on_influence);
    d->allocate = GIVEN(1, pool_allocate);
    d->release = d->allocate ? pool_release : NULL;
    if (p->mood == MOOD_NULLS && draw(p) % 2) d->release = d->release ? NULL : pool_release;
    d->memory_user = &p->memory;
    if (more / 64 == 1) d->parallel_for = in_reverse;
    if (more / 64 == 2) d->log = on_log;
    d->log_user = p;
    o->quadrature = d->quadrature;
    o->heavy = o->dim == 3 && (d->quadrature == PERI_QUADRATURE_PARTIAL || d->correction >= PERI_CORRECTION_MOMENT);
    if (p->nulls == 2) d->cookie ^= 1;
    if (p->trace)
        printf("    space %d precision %d geometry %d influence %d quadrature %d correction %d kernel %d horizon %g, %g long\n", d->space,
               d->precision, d->geometry, d->influence, d->quadrature, d->correction, d->kernel, d->horizon, o->length);
}

static int64_t make_body(program *p, int s) {
    slot *o = &p->slots[s];
    peri_body_desc d;
    peri_error e;
    int k;
    drop(p, s);
    if (o->body) return 0;
    fill_desc(p, s, &d);
    for (k = 0; k < 3; ++k) o->hi[k] = 4.0 * o->length;
    o->family = ++p->families;
    o->wild = p->wild;
    const int32_t status = peri_body_create(GIVEN(3, &d), &o->body, &e);
    HOLDS(p, status == e.code && (status == PERI_OK) == (o->body != NULL) && e.field && e.text);
    if (o->body && !d.allocate) drop(p, s); /* not counted */
    if (o->body) HOLDS(p, peri_get_error(o->body, &o->record) == PERI_OK && o->record.code == PERI_OK);
    p->partial = 1;
    return status;
}

static void fill_material(program *p, int s, peri_material_desc *m, int32_t law) {
    static const double youngs[] = {1.0, 1.0, 2.0, 0.5};
    const slot *o = &p->slots[s];
    const int flags = draw(p);
    const double modulus = p->mood == MOOD_NUMBERS ? number(p, 0.0, 2.0) : youngs[flags % 4];
    peri_material_desc_init(m, law);
    if (flags / 4 % 4 == 3) m->bulk = young_of(o, modulus);
    else m->young = young_of(o, modulus);
    m->density = o->density * number(p, 0.5, 1.0);
    if (law != PERI_LAW_BOND_BASED) m->poisson = number(p, -0.5, 0.4375);
    if (p->mood == MOOD_CHOICES) m->criterion = choice(p, PERI_CRITERION_STRETCH, 3);
    else if (law != PERI_LAW_BOND_BASED) m->criterion = PERI_CRITERION_STRETCH + flags / 16 % 4 % 3;
    if (m->criterion != PERI_CRITERION_STRETCH || flags / 64 == 1) m->fracture_energy = o->stress * o->length * number(p, 1e-4, 1e-2);
    else if (flags / 64 > 1) m->critical_stretch = number(p, 0.005, 0.1);
    if (p->mood == MOOD_NUMBERS) m->stabilization = number(p, 0.0, 1.0);
    if (p->nulls == 1) m->cookie = 0;
    if (p->trace)
        printf("    law %d criterion %d young %g bulk %g poisson %g density %g G0 %g s0 %g k %g\n", m->law, m->criterion, m->young,
               m->bulk, m->poisson, m->density, m->fracture_energy, m->critical_stretch, m->stabilization);
}

static int32_t some_law(program *p) {
    static const int32_t laws[] = {0, 0, 0, 1, 1, 2, 3, 3}; /* less the first */
    return p->mood == MOOD_CHOICES ? choice(p, PERI_LAW_BOND_BASED, 4) : PERI_LAW_BOND_BASED + laws[below(p, 8)];
}

static int32_t materials_of(const slot *o) { return o->given[place_of(PERI_KIND_MATERIAL)]; }

static int64_t add_material(program *p, int s) {
    peri_material_desc m;
    const int bonds_only = p->mood == 0 && p->slots[s].quadrature >= PERI_QUADRATURE_PARTIAL_CENTROID;
    fill_material(p, s, &m, bonds_only ? PERI_LAW_BOND_BASED : some_law(p));
    const int64_t id = CALL(p, s, peri_add_material(p->slots[s].body, GIVEN(0, &m)));
    note_id(p, s, PERI_KIND_MATERIAL, id);
    return id;
}

static int64_t set_interface(program *p, int s) {
    peri_material_desc m;
    const int32_t count = materials_of(&p->slots[s]), i = some_id(p, s, PERI_KIND_MATERIAL);
    const int32_t j = p->mood == 0 && count > 1 ? id_at(p, s, PERI_KIND_MATERIAL, PERI_ID_INDEX(i) % count + 1)
                                                : some_id(p, s, PERI_KIND_MATERIAL);
    fill_material(p, s, &m, PERI_LAW_BOND_BASED);
    return CALL(p, s, peri_set_interface(p->slots[s].body, i, j, GIVEN(0, &m)));
}

/* ---- points ------------------------------------------------------------------------------------------------------- */

/* A box of whole cells, mostly; where it is accepted, places are chosen around it. */
static double some_box(program *p, int s, double *lo, double *hi) {
    static const double starts[] = {0.0, 0.0, 4.0, -0.5};
    slot *o = &p->slots[s];
    const int most = o->dim == 3 ? 5 : 10;
    const double spacing = o->length * (draw(p) % 4 ? 1.0 : number(p, 0.5, 2.0));
    int d;
    for (d = 0; d < 3; ++d) {
        lo[d] = o->length * starts[draw(p) % 4];
        hi[d] = lo[d] + o->length * (p->mood == MOOD_NUMBERS ? number(p, 1.0, 8.0) : (double)(1 + below(p, d == 0 ? most : most - 1)));
        if (p->wild) continue;
        if (lo[d] < o->lo[d]) o->lo[d] = lo[d];
        if (hi[d] > o->hi[d]) o->hi[d] = hi[d];
    }
    if (p->trace) printf("    box %g %g %g to %g %g %g by %g\n", lo[0], lo[1], lo[2], hi[0], hi[1], hi[2], spacing);
    return p->mood == MOOD_NUMBERS ? number(p, 0.5 * spacing, spacing) : spacing;
}

static int64_t add_box(program *p, int s) {
    double lo[3], hi[3];
    const double spacing = some_box(p, s, lo, hi);
    const int32_t material = some_id(p, s, PERI_KIND_MATERIAL);
    return CALL(p, s, peri_add_box(p->slots[s].body, material, GIVEN(0, lo), GIVEN(1, hi), spacing));
}

static int64_t add_ball(program *p, int s) {
    const double length = p->slots[s].length, radius = length * number(p, 0.5, 4.0), spacing = length * number(p, 0.75, 1.25);
    double centre[3];
    place(p, &p->slots[s], centre);
    if (radius / spacing > 20.0 && radius / spacing < 1e12) return 0; /* would take long */
    const int32_t material = some_id(p, s, PERI_KIND_MATERIAL);
    return CALL(p, s, peri_add_ball(p->slots[s].body, material, GIVEN(0, centre), radius, spacing));
}

static int64_t add_shape(program *p, int s) {
    double lo[3], hi[3], sites = 1.0;
    const double spacing = some_box(p, s, lo, hi);
    hook *h = new_hook(p, s, 5);
    int d;
    for (d = 0; d < p->slots[s].dim; ++d) sites *= fmax(1.0, (hi[d] - lo[d]) / spacing);
    if (sites > SITES_MOST && sites < 1e12) return 0;
    const int32_t material = some_id(p, s, PERI_KIND_MATERIAL);
    return CALL(p, s, peri_add_shape(p->slots[s].body, material, GIVEN(0, lo), GIVEN(1, hi), spacing, GIVEN(2, on_point), h));
}

static int64_t add_perturbed_box(program *p, int s) {
    double lo[3], hi[3];
    const double spacing = some_box(p, s, lo, hi), amount = number(p, 0.0, 1.0);
    const uint64_t seed = (uint64_t)draw(p);
    const int32_t material = some_id(p, s, PERI_KIND_MATERIAL);
    return CALL(p, s, peri_add_perturbed_box(p->slots[s].body, material, GIVEN(0, lo), GIVEN(1, hi), spacing, amount, seed));
}

/* A cloud: a lattice, each point moved by its own amount, or on a line, or all at random. */
static int64_t add_points(program *p, int s) {
    slot *o = &p->slots[s];
    const int kind = below(p, 4), across = 2 + below(p, o->dim == 3 ? 4 : 9);
    const double noise = kind == 0 ? 0.0 : 0.05 * below(p, 8);
    uint64_t dice = (uint64_t)draw(p) + 1;
    int64_t count = o->dim == 3 ? (int64_t)across * across * across : (int64_t)across * across, k;
    double volume = o->length * o->length * (o->dim == 3 ? o->length : 1.0);
    int d;
    if (kind == 3) count = across;
    for (k = 0; k < count; ++k) {
        int64_t rest = k;
        for (d = 0; d < o->dim; ++d) {
            dice = dice * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
            p->in[k * o->dim + d] = o->length * ((double)(rest % across) + 0.5 + noise * ((double)(dice >> 40) / 16777216.0 - 0.5));
            rest /= across;
        }
        p->other[k] = kind == 2 ? volume * (0.5 + (double)(dice >> 40) / 16777216.0) : volume;
        p->ids[k] = materials_of(o) > 0 ? id_at(p, s, PERI_KIND_MATERIAL, 1) : want_id(p, PERI_ERROR_ID_NONE, 0);
    }
    k = draw(p);
    if (p->mood == MOOD_NUMBERS) p->in[k % (count * o->dim)] = number(p, 0.0, o->length);
    if (p->mood == MOOD_NUMBERS && draw(p) % 2) p->other[k % count] = number(p, volume, 2.0 * volume);
    if (p->mood == MOOD_CHOICES) p->ids[k % count] = some_id(p, s, PERI_KIND_MATERIAL);
    for (d = 0; d < o->dim; ++d)
        if (!p->wild && o->hi[d] < o->length * across) o->hi[d] = o->length * across;
    if (p->mood == MOOD_CHOICES && draw(p) % 2) count = -(int64_t)draw(p);
    if (count <= 0) p->want = PERI_OK; /* no id is looked at */
    const int32_t *materials = p->mood == 0 && materials_of(o) == 1 ? NULL : GIVEN(2, p->ids);
    if (count > 0 && !materials && materials_of(o) != 1) p->want = materials_of(o) ? PERI_ERROR_ID_NONE : PERI_OK; /* which? */
    return CALL(p, s, peri_add_points(o->body, count, GIVEN(0, p->in), GIVEN(1, p->other), materials));
}

/* A mesh of quadrilaterals or hexahedra with a moved vertex, of which a corner may be wrong; or a grid. */
static int64_t add_cells(program *p, int s) {
    static const int32_t turn[8] = {0, 1, 3, 2, 4, 5, 7, 6};
    slot *o = &p->slots[s];
    const int dim = o->dim == 3 ? 3 : 2, across = 1 + below(p, 3), row = across + 1, corners = 1 << dim;
    const int32_t material = some_id(p, s, PERI_KIND_MATERIAL);
    int32_t order[27 * 8];
    const int64_t vertices = (int64_t)row * row * (dim == 3 ? row : 1), count = (int64_t)across * across * (dim == 3 ? across : 1);
    peri_cells_desc c;
    for (int64_t k = 0; k < vertices * dim; ++k) {
        const int64_t v = k / dim, at[3] = {v % row, v / row % row, v / row / row};
        p->in[k] = o->length * (double)at[k % dim];
    }
    for (int64_t k = 0; k < count * corners; ++k) {
        const int n = turn[k % corners];
        const int64_t cell = k / corners, x = cell % across, y = cell / across % across, z = cell / across / across;
        const int64_t at[3] = {x + (n & 1), y + (n >> 1 & 1), z + (n >> 2)};
        order[k] = (int32_t)(at[0] + row * at[1] + (dim == 3 ? row * row * at[2] : 0));
    }
    if (draw(p) % 2) {
        int32_t cells[3] = {across, 1 + below(p, 4), across};
        const double zero[3] = {0, 0, 0}, far[3] = {o->length * across, o->length * across, o->length * across};
        if (p->mood == MOOD_NUMBERS) cells[draw(p) % dim] = -(int32_t)draw(p);
        if (!p->wild) for (int d = 0; d < dim; ++d) o->hi[d] = fmax(o->hi[d], far[d]);
        return CALL(p, s, peri_add_grid(o->body, material, GIVEN(0, zero), GIVEN(1, far), GIVEN(2, cells)));
    }
    p->in[(dim == 3 ? row * row + row + 1 : row + 1) % vertices * dim] += 0.2 * o->length;
    peri_cells_desc_init(&c);
    c.vertex_count = vertices, c.vertices = GIVEN(0, p->in), c.cell_count = count, c.corners = GIVEN(1, order), c.cell_corners = corners;
    if (p->mood == MOOD_NUMBERS) order[draw(p) % (count * corners)] = (int32_t)draw(p) - 100;
    p->want = PERI_OK; /* no id is looked at; of several materials none is named: which status? */
    if (!p->wild) for (int d = 0; d < dim; ++d) o->hi[d] = fmax(o->hi[d], o->length * across);
    return CALL(p, s, peri_add_cells(o->body, GIVEN(2, &c)));
}

/* A chain, a ring, all with all, or what is no family at all. */
static int64_t set_families(program *p, int s) {
    const int64_t n = peri_point_count(p->slots[s].body), kind = below(p, 4);
    int32_t width = kind == 2 ? (int32_t)n - 1 : 2, i, k;
    if (n < 3 || n * (n - 1) > ROOM || (kind != 2 && n * 2 > ROOM)) return 0;
    for (i = 0; i < n; ++i)
        for (k = 0; k < width; ++k) {
            int32_t *id = &p->ids[i * width + k];
            if (kind == 2) *id = k < i ? k : k + 1;
            else *id = (int32_t)((i + (k ? 1 : n - 1)) % n);
            if (kind == 0 && (i == 0 || i == n - 1)) *id = k ? i : i ? i - 1 : 1;
            if (kind == 3) *id = some_point(p, n);
        }
    if (p->mood == MOOD_CHOICES && draw(p) % 2) width = -below(p, 3);
    return CALL(p, s, peri_set_families(p->slots[s].body, width, GIVEN(0, p->ids)));
}

static int64_t build(program *p, int s) {
    slot *o = &p->slots[s];
    const int64_t points = o->body ? peri_point_count(o->body) : 0;
    if (points > (o->heavy ? POINTS_MOST / 2 : POINTS_MOST)) return 0;
    return CALL(p, s, peri_build(o->body));
}

/* A copy in the other slot, and the memory of both. */
static int64_t clone(program *p, int s) {
    slot *from = &p->slots[s], *to = &p->slots[1 - s];
    peri_error e;
    peri_body *copy = NULL;
    if (!to->busy) drop(p, 1 - s);
    if (to->body) return 0;
    const int32_t status = peri_body_clone(from->body, GIVEN(0, &copy), &e);
    HOLDS(p, status == e.code && (status == PERI_OK) == (copy != NULL));
    if (!copy) return status;
    *to = *from;
    to->body = copy;
    to->busy = 0;
    HOLDS(p, peri_get_error(copy, &to->record) == PERI_OK && to->record.code == PERI_OK);
    print a = print_of(p, s, 0), b = print_of(p, 1 - s, 0);
    a.count[6] = b.count[6];
    if (from->busy == 0 && !same_print(a, b, PERI_OK)) blame(p, "a copy is as the body", __LINE__);
    p->partial = 1;
    return status;
}

/* ---- what it costs ------------------------------------------------------------------------------------------------ */

/* A box by plan and by deed: refused alike, and of the same size. */
static int64_t plan(program *p, int s) {
    slot was = p->slots[s], *o = &p->slots[s];
    peri_body_desc d;
    peri_material_desc m;
    peri_plan_desc q;
    peri_plan_report report;
    peri_error e, f;
    peri_body *b = NULL;
    memset(o->lo, 0, sizeof o->lo);
    memset(o->hi, 0, sizeof o->hi);
    fill_desc(p, s, &d);
    fill_material(p, s, &m, some_law(p));
    peri_plan_desc_init(&q);
    q.body = GIVEN(0, &d);
    q.material = GIVEN(3, &m);
    q.spacing = some_box(p, s, q.lo, q.hi);
    *o = was;
    if (p->mood == MOOD_CHOICES) q.source = choice(p, PERI_SOURCE_BOX, 3);
    if (p->mood == MOOD_NUMBERS) q.amount = number(p, 0.0, 1.0);
    const int64_t calls = p->memory.calls;
    const int32_t status = peri_plan(&q, &report, &e);
    HOLDS(p, status == e.code && p->memory.calls == calls);
    if (p->mood != 0 || q.source != PERI_SOURCE_BOX || (status == PERI_OK && report.points > POINTS_MOST)) return status;
    d.log = NULL;
    int64_t deed = peri_body_create(&d, &b, &f);
    if (deed >= 0) deed = peri_add_material(b, &m);
    if (deed >= 0) deed = peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), q.lo, q.hi, q.spacing);
    if (deed >= 0) deed = peri_build(b);
    if (deed < 0 && b) (void)peri_get_error(b, &f);
    if (p->trace) printf("    plan %d %s, deed %d %s\n", status, status < 0 ? e.field : "", (int)deed, deed < 0 ? f.field : "");
    const hook *h = (const hook *)d.influence_user;
    const int negative = h && h->kind == INFLUENCE_NEGATIVE;
    /* of negative functions, the plan looks at a whole family, which no point of a thin box has */
    if (deed != PERI_ERROR_MEMORY && !(negative && (deed == PERI_ERROR_INFLUENCE || status == PERI_ERROR_INFLUENCE))) {
        HOLDS(p, status == (int32_t)(deed < 0 ? deed : 0));
        HOLDS(p, status == PERI_OK || strcmp(e.field, f.field) == 0);
    }
    if (status == PERI_OK && deed >= 0) {
        peri_memory held;
        HOLDS(p, report.points == peri_point_count(b) && report.entries == peri_entry_count(b) && report.width == peri_family_width(b));
        HOLDS(p, peri_get_memory(b, &held) == PERI_OK);
        if (d.correction == PERI_CORRECTION_NONE) HOLDS(p, held.total == report.bytes);
        HOLDS(p, report.stable_step > 0.0 && report.peak >= 0);
    }
    peri_body_destroy(b);
    return status;
}

#endif
