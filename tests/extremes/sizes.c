/* SPDX-License-Identifier: MIT */
/* sizes.c - counts near what 32 bits can number, requests of nothing, buffers one entry short or long, and more materials, sets, loads,
   supports and obstacles than anybody has. */
#include "scenes.h"

/* ---- as many points as ids can number ----------------------------------------------------------------------------- */

/* Bonds of a lattice of n cells per axis: for each vector within the horizon, in cells, as many as there are pairs of cells. */
static int64_t lattice_bonds(const int64_t *n, int dim, double horizon, int64_t *vectors) {
    const int64_t reach = (int64_t)floor(horizon * (1 + 1e-8));
    int64_t v[3], bonds = 0;
    *vectors = 0;
    for (v[0] = -reach; v[0] <= reach; ++v[0])
        for (v[1] = -reach; v[1] <= reach; ++v[1])
            for (v[2] = dim == 3 ? -reach : 0; v[2] <= (dim == 3 ? reach : 0); ++v[2]) {
                const double square = (double)(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
                int64_t pairs = square > 0 && square <= horizon * horizon * (1 + 2e-8);
                int d;
                for (d = 0; d < dim; ++d) pairs *= n[d] > llabs(v[d]) ? n[d] - llabs(v[d]) : 0;
                bonds += pairs;
                *vectors += pairs > 0;
            }
    return bonds;
}

/* A plan of value cells along the first `choice` axes, and one along the others, in 3D where choice is 3. */
static outcome planned(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    const int dim = row->choice == 3 ? 3 : 2;
    int64_t n[3], vectors, bonds;
    peri_body_desc d;
    peri_material_desc m;
    peri_plan_desc plan;
    peri_plan_report report;
    peri_error error;
    int k;
    for (k = 0; k < 4; ++k) {
        extreme_desc(&d, dim == 3 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRAIN, precision, row->other);
        extreme_material(&m, scene_laws[k], 0.2, 0.01);
        peri_plan_desc_init(&plan);
        plan.body = &d;
        plan.material = &m;
        plan.spacing = 1;
        for (int a = 0; a < dim; ++a) {
            plan.hi[a] = a < row->choice ? row->value : 1;
            n[a] = plan.hi[a] < 9e18 ? (int64_t)plan.hi[a] : INT64_MAX;
        }
        o.status = peri_plan(&plan, &report, &error);
        o.field = error.field;
        HOLDS(extreme_memory.calls == 0);
        if (o.status != PERI_OK) HOLDS(report.points == 0 && report.entries == 0 && report.bytes == 0 && report.stable_step == 0);
        if (SIZE_MAX < UINT64_MAX && o.status == PERI_ERROR_TOO_LARGE && row->status == PERI_OK) { /* 32-bit addresses: right */
            o.status = PERI_OK;
            continue;
        }
        if (o.status != PERI_OK) return o;
        bonds = lattice_bonds(n, dim, row->other, &vectors);
        o.error += fabs((double)(report.points - n[0] * n[1] * (dim == 3 ? n[2] : 1)));
        o.error += fabs((double)(report.entries - bonds)) + fabs((double)(report.width - vectors));
        HOLDS(report.bytes > report.points && report.peak >= report.bytes && report.stable_step > 0 && report.stable_step < row->other);
    }
    return o;
}

static int64_t asked;
static int32_t ask(void *user, int64_t index, const double *x) {
    (void)user, (void)index, (void)x;
    asked++;
    return 1;
}

/* A shape of value^dim cells, by the function `choice`, under an allocator with a megabyte; then one that fits. */
static outcome too_many_points(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0}, after = {PERI_OK, "", 0};
    const double lo[3] = {0, 0, 0}, hi[3] = {row->value, row->value, row->value}, small[3] = {5, 5, 5};
    peri_body_desc d;
    peri_material_desc m;
    peri_body *b = NULL;
    int64_t made = 0;
    extreme_desc(&d, row->other > 2 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRESS, precision, 2);
    extreme_material(&m, PERI_LAW_LPS, 0.1, 0);
    asked = 0;
    if (extreme_fails(&o, NULL, peri_body_create(&d, &b, NULL)) || extreme_fails(&o, b, peri_add_material(b, &m))) return extreme_end(o, b);
    extreme_memory.limit = 1 << 20;
    switch (row->choice) {
    case 0: made = peri_add_box(b, material_id(b, 1), lo, hi, 1); break;
    case 1: made = peri_add_perturbed_box(b, material_id(b, 1), lo, hi, 1, 1, 7); break;
    case 2: made = peri_add_ball(b, material_id(b, 1), hi, row->value / 2, 1); break;
    default: made = peri_add_shape(b, material_id(b, 1), lo, hi, 1, ask, NULL); break;
    }
    (void)extreme_fails(&o, b, made);
    extreme_memory.limit = 0;
    if (made >= 0 || peri_point_count(b) != 0 || asked != 0) o.status = SPOILED;
    (void)extreme_fails(&after, b, peri_add_box(b, material_id(b, 1), lo, small, 1));
    (void)extreme_fails(&after, b, peri_build(b));
    if (after.status < 0 || peri_point_count(b) != (row->other > 2 ? 125 : 25)) o.status = SPOILED;
    return extreme_end(o, b);
}

/* Two boxes that only together are too many: the second is refused before memory is asked for. */
static outcome one_box_too_many(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    const double lo[2] = {0, 0}, hi[2] = {4, 4}, far_lo[2] = {0, 10}, far_hi[2] = {row->value, 11};
    peri_body_desc d;
    peri_material_desc m;
    peri_body *b = NULL;
    int64_t calls;
    extreme_desc(&d, PERI_SPACE_PLANE_STRESS, precision, 2);
    extreme_material(&m, PERI_LAW_BOND_BASED, 0, 0);
    if (extreme_fails(&o, NULL, peri_body_create(&d, &b, NULL)) || extreme_fails(&o, b, peri_add_material(b, &m)) ||
        extreme_fails(&o, b, peri_add_box(b, material_id(b, 1), lo, hi, 1)))
        return extreme_end(o, b);
    calls = extreme_memory.calls;
    extreme_memory.limit = 1 << 20;
    (void)extreme_fails(&o, b, peri_add_box(b, material_id(b, 1), far_lo, far_hi, 1));
    if (extreme_memory.calls != calls || peri_point_count(b) != 16) o.status = SPOILED;
    extreme_memory.limit = 0;
    if (peri_build(b) != PERI_OK) o.status = SPOILED;
    return extreme_end(o, b);
}

/* Families of all points, under an allocator that cannot hold them; then under one that can. Bonds of a lattice that is pulled evenly
   are in balance as a whole. */
static outcome too_many_bonds(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    const double lo[2] = {0, 0}, hi[2] = {row->value, 12}, pull[4] = {1e-3, 0, 0, 0};
    const int64_t n = 12 * (int64_t)row->value;
    peri_body_desc d;
    peri_material_desc m;
    peri_body *b = NULL;
    int64_t blocks, i;
    double *f, net = 0, size = 0;
    extreme_desc(&d, PERI_SPACE_PLANE_STRESS, precision, 1e4);
    extreme_material(&m, row->choice, 0.2, 0);
    if (extreme_fails(&o, NULL, peri_body_create(&d, &b, NULL)) || extreme_fails(&o, b, peri_add_material(b, &m)) ||
        extreme_fails(&o, b, peri_add_box(b, material_id(b, 1), lo, hi, 1)))
        return extreme_end(o, b);
    blocks = extreme_memory.blocks;
    extreme_memory.limit = 2 << 20;
    ENDS(PERI_ERROR_MEMORY, peri_build(b));
    HOLDS(extreme_memory.blocks == blocks && peri_family_width(b) == 0);
    extreme_memory.limit = 0;
    if (extreme_fails(&o, b, peri_build(b))) return extreme_end(o, b);
    HOLDS(peri_entry_count(b) == n * (n - 1) && peri_family_width(b) == n - 1);
    extreme_affine(&o, b, pull, NULL);
    f = extreme_read(&o, b, PERI_FIELD_FORCE_DENSITY);
    for (i = 0; f && i < n; ++i) {
        net += f[2 * i];
        size += fabs(f[2 * i]);
    }
    free(f);
    HOLDS(size > 0);
    o.error = fabs(net) / size;
    return extreme_end(o, b);
}

/* ---- extents ------------------------------------------------------------------------------------------------------ */

/* Pairs of points a cell apart, `value` horizons from each other, along the first `choice` axes: each is a bar of its own, and pulled by
   1e-3 has the force c s V, c of the infinite body. */
static outcome pairs_far_apart(const extreme *row, int32_t precision) {
    enum { PAIRS = 5 };
    outcome o = {PERI_OK, "", 0};
    const double pi = 3.14159265358979323846, h = 1.5, s = 1e-3;
    double x[2 * PAIRS * 3], volume[2 * PAIRS], u[2 * PAIRS * 3], *f;
    int dim, k, d, built;
    for (dim = 2; dim <= 3; ++dim) {
        const double c = dim == 3 ? 12 / (pi * h * h * h * h) : 9 / (pi * h * h * h);
        peri_body_desc desc;
        peri_material_desc m;
        peri_body *b = NULL;
        extreme_desc(&desc, dim == 3 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRESS, precision, h);
        extreme_material(&m, PERI_LAW_BOND_BASED, 0, 0);
        for (k = 0; k < 2 * PAIRS; ++k) {
            volume[k] = 1;
            for (d = 0; d < dim; ++d) {
                x[k * dim + d] = d < row->choice ? h * row->value * (double)(k / 2) : 0;
                u[k * dim + d] = 0;
            }
            x[k * dim] += k % 2;
            u[k * dim] = s * (k % 2);
        }
        if (extreme_fails(&o, NULL, peri_body_create(&desc, &b, NULL)) || extreme_fails(&o, b, peri_add_material(b, &m)) ||
            extreme_fails(&o, b, peri_add_points(b, 2 * PAIRS, x, volume, NULL)))
            return extreme_end(o, b);
        built = peri_build(b);
        /* places beyond its digits: refused, not wrong */
        if (built != PERI_OK && precision == PERI_PRECISION_SINGLE && built != PERI_ERROR_MEMORY) {
            peri_body_destroy(b);
            continue;
        }
        if (extreme_fails(&o, b, built)) return extreme_end(o, b);
        HOLDS(peri_entry_count(b) == 2 * PAIRS && peri_family_width(b) == 1);
        (void)extreme_fails(&o, b, peri_set_field(b, PERI_FIELD_DISPLACEMENT, u, 2 * PAIRS * dim));
        f = extreme_read(&o, b, PERI_FIELD_FORCE_DENSITY);
        for (k = 0; f && k < 2 * PAIRS; ++k)
            for (d = 0; d < dim; ++d)
                o.error = extreme_worst(o.error, fabs(f[k * dim + d] - (d ? 0 : k % 2 ? -c * s : c * s)) / (c * s));
        free(f);
        o = extreme_end(o, b);
    }
    return o;
}

/* A lattice of spacing 1 with that horizon. */
static outcome horizon_of(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    const double hi[3] = {4, 4, 4};
    int32_t rule, law;
    for (rule = PERI_QUADRATURE_FULL; rule <= PERI_QUADRATURE_PARTIAL; ++rule)
        for (law = 0; law < 4; ++law) {
            outcome one = {PERI_OK, "", 0};
            peri_body_desc d;
            peri_material_desc m;
            extreme_desc(&d, (int32_t)row->other, precision, row->value);
            d.quadrature = rule;
            extreme_material(&m, scene_laws[law], 0.2, 0.01);
            one = extreme_end(one, extreme_box(&one, &d, &m, hi, 1));
            if (one.status != row->status) return one;
            o = one;
        }
    return o;
}

/* A box of cells of that size, in a body of horizon 3. */
static outcome spacing_of(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    const double hi[3] = {4, 4, 4};
    peri_body_desc d;
    peri_material_desc m;
    peri_body *b;
    extreme_desc(&d, (int32_t)row->other, precision, 3);
    extreme_material(&m, PERI_LAW_BOND_BASED, 0, 0);
    b = extreme_box(&o, &d, &m, hi, row->value);
    return extreme_end(o, b);
}

/* ---- nothing, and one entry less or more -------------------------------------------------------------------------- */

#define GUARD 12345.25

static outcome nothing(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    int k;
    for (k = 0; k < 4; ++k) {
        peri_body *b = scene_plate(&o, scene_laws[k], precision, row->choice), *empty = NULL;
        double x[3] = {GUARD, GUARD, GUARD};
        int32_t ids[2] = {-7, -7};
        peri_body_desc d;
        peri_advance_desc run;
        peri_error e;
        if (o.status < 0) return extreme_end(o, b);
        const int32_t dim = peri_dimension(b), edge = peri_find_set(b, "edge");
        const int64_t n = peri_point_count(b), cut = peri_cut_count(b);
        HOLDS(cut > 0 && edge == peri_id(b, PERI_KIND_SET, 1));
        ENDS(PERI_ERROR_CAPACITY, peri_get_field(b, PERI_FIELD_DISPLACEMENT, x, 0));
        ENDS(PERI_ERROR_CAPACITY, peri_get_field(b, PERI_FIELD_STRESS, x, INT64_MIN));
        ENDS(PERI_ERROR_CAPACITY, peri_set_field(b, PERI_FIELD_VELOCITY, x, 0));
        ENDS(PERI_ERROR_CAPACITY, peri_set_field(b, PERI_FIELD_VELOCITY, x, INT64_MIN));
        ENDS(PERI_ERROR_CAPACITY, peri_multiply_stiffness(b, x, x, 0));
        ENDS(PERI_ERROR_CAPACITY, peri_get_set(b, edge, ids, 0));
        ENDS(PERI_ERROR_CAPACITY, peri_get_families(b, 0, 1, ids, 0));
        ENDS(PERI_OK, peri_get_families(b, 0, 0, ids, 0));
        ENDS(PERI_OK, peri_get_families(b, n, 0, ids, 0));
        ENDS(PERI_ERROR_INDEX, peri_get_families(b, n + 1, 0, ids, 2));
        ENDS(PERI_ERROR_INDEX, peri_get_families(b, -1, 1, ids, 2));
        ENDS(PERI_ERROR_INDEX, peri_get_families(b, 0, -1, ids, 2));
        ENDS(PERI_ERROR_INDEX, peri_get_families(b, INT64_MAX, INT64_MAX, ids, INT64_MAX));
        ENDS(PERI_ERROR_INDEX, peri_get_families(b, 1, INT64_MAX, ids, INT64_MAX));
        ENDS(PERI_ERROR_EMPTY, peri_select_points(b, "none", 0, ids)); /* "an empty selection is an error" */
        ENDS(PERI_ERROR_ARGUMENT, peri_select_points(b, "none", -1, ids));
        ENDS(0, peri_cut_pairs(b, PERI_CUT_INITIAL, 0, NULL));
        ENDS(PERI_ERROR_ARGUMENT, peri_cut_pairs(b, PERI_CUT_INITIAL, -1, ids));
        ENDS(dim == 2 ? PERI_ERROR_ARGUMENT : PERI_ERROR_CRACK, peri_cut_polyline(b, PERI_CUT_INITIAL, 0, x));
        ENDS(dim == 2 ? PERI_ERROR_ARGUMENT : PERI_ERROR_CRACK, peri_cut_polyline(b, PERI_CUT_INITIAL, INT64_MIN, x));
        peri_advance_desc_init(&run);
        ENDS(PERI_ERROR_ARGUMENT, peri_advance(b, &run));
        HOLDS(x[0] == GUARD && x[2] == GUARD && ids[0] == -7 && ids[1] == -7);
        HOLDS(peri_cut_count(b) == cut && peri_find_set(b, "none") == PERI_ERROR_NAME && peri_step_count(b) == 0);
        peri_body_desc_init(&d);
        d.space = row->choice;
        d.horizon = 1;
        (void)extreme_fails(&o, NULL, peri_body_create(&d, &empty, NULL));
        ENDS(PERI_ERROR_EMPTY, peri_add_points(empty, 0, NULL, NULL, NULL));
        ENDS(PERI_ERROR_EMPTY, peri_set_families(empty, 1, ids));
        ENDS(PERI_ERROR_MATERIAL, peri_build(empty));
        HOLDS(peri_point_count(empty) == 0 && peri_get_error(empty, &e) == PERI_OK && e.code == PERI_ERROR_MATERIAL);
        peri_body_destroy(empty);
        o = extreme_end(o, b);
    }
    return o;
}

/* Buffers of one entry too few are refused with the right size, and untouched; those of one too many are left alone behind their end. */
static outcome off_by_one(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    int32_t k, field;
    for (k = 0; k < 4; ++k) {
        peri_body *b = scene_plate(&o, scene_laws[k], precision, row->choice);
        peri_error e;
        if (o.status < 0) return extreme_end(o, b);
        for (field = PERI_FIELD_POSITION; field < peri__end_field; ++field) {
            const int64_t n = peri_size_of_field(b, field);
            double *x = (double *)malloc((size_t)(n + 1) * sizeof *x), last;
            x[0] = x[n] = GUARD;
            ENDS(PERI_ERROR_CAPACITY, peri_get_field(b, field, x, n - 1));
            HOLDS(peri_get_error(b, &e) == PERI_OK && e.value == (double)n && x[0] == GUARD);
            ENDS(PERI_OK, peri_get_field(b, field, x, n));
            last = x[n - 1];
            HOLDS(x[n] == GUARD);
            ENDS(PERI_OK, peri_get_field(b, field, x, n + 1));
            HOLDS(x[n] == GUARD && x[n - 1] == last);
            ENDS(PERI_OK, peri_get_field(b, field, x, INT64_MAX));
            HOLDS(x[n] == GUARD);
            if (field == PERI_FIELD_DISPLACEMENT || field == PERI_FIELD_VELOCITY) {
                ENDS(PERI_ERROR_CAPACITY, peri_set_field(b, field, x, n - 1));
                ENDS(PERI_ERROR_CAPACITY, peri_set_field(b, field, x, n + 1));
                ENDS(PERI_ERROR_CAPACITY, peri_set_field(b, field, x, INT64_MAX));
                ENDS(PERI_ERROR_CAPACITY, peri_multiply_stiffness(b, x, x, n - 1));
                ENDS(PERI_ERROR_CAPACITY, peri_multiply_stiffness(b, x, x, n + 1));
                HOLDS(peri_get_error(b, &e) == PERI_OK && e.value == (double)n);
            } else if (field != PERI_FIELD_DENSITY && (field < PERI_FIELD_EIGENSTRAIN || field > PERI_FIELD_STIFFNESS))
                ENDS(PERI_ERROR_FIELD, peri_set_field(b, field, x, n));
            free(x);
        }
        ENDS(PERI_ERROR_CHOICE, peri_size_of_field(b, peri__end_field));
        ENDS(PERI_ERROR_CHOICE, peri_size_of_field(b, 0));
        const int32_t edge = peri_find_set(b, "edge"), foreign = edge ^ 1 << 20;
        const int64_t n = peri_point_count(b), width = peri_family_width(b), held = peri_size_of_set(b, edge);
        int32_t *ids = (int32_t *)malloc((size_t)(n * width + 1) * sizeof *ids);
        ids[0] = ids[n * width] = ids[held] = -7;
        ENDS(PERI_ERROR_CAPACITY, peri_get_families(b, 0, n, ids, n * width - 1));
        HOLDS(peri_get_error(b, &e) == PERI_OK && e.value == (double)(n * width) && ids[0] == -7);
        ENDS(PERI_ERROR_CAPACITY, peri_get_set(b, edge, ids, held - 1));
        HOLDS(peri_get_error(b, &e) == PERI_OK && e.value == (double)held && ids[0] == -7);
        ENDS(PERI_OK, peri_get_set(b, edge, ids, held));
        HOLDS(ids[0] == 0 && ids[held] == -7);
        ENDS(PERI_OK, peri_get_families(b, 0, n, ids, n * width));
        HOLDS(ids[0] == 1 && ids[n * width] == -7);
        ENDS(PERI_ERROR_INDEX, peri_get_families(b, 1, n, ids, n * width));
        free(ids);
        ENDS(PERI_ERROR_ID_NONE, peri_size_of_set(b, 1));
        ENDS(PERI_ERROR_ID_GONE, peri_size_of_set(b, edge + 1));
        ENDS(PERI_ERROR_ID_BODY, peri_size_of_set(b, foreign));
        ENDS(PERI_ERROR_ID_KIND, peri_size_of_set(b, material_id(b, 1)));
        ENDS(PERI_ERROR_INDEX, peri_bond_is_intact(b, 0, (int32_t)n));
        ENDS(PERI_ERROR_INDEX, peri_bond_is_intact(b, INT32_MIN, INT32_MAX));
        ENDS(PERI_ERROR_ID_GONE, peri_remove_load(b, peri_id(b, PERI_KIND_LOAD, 2) + 1));
        ENDS(PERI_ERROR_ID_GONE, peri_id(b, PERI_KIND_LOAD, 3));
        ENDS(PERI_ERROR_ID_NONE, peri_remove_load(b, INT32_MIN));
        o = extreme_end(o, b);
    }
    return o;
}

/* ---- many of a kind ----------------------------------------------------------------------------------------------- */

/* As many materials, all alike, as a body takes: one body of one material. And no more. */
static outcome materials(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    const double pull[9] = {1e-3, 4e-4, 0, 0, -2e-3, 0, 1e-4, 0, 0}, flat[4] = {1e-3, 4e-4, 0, -2e-3};
    const int dim = row->choice == PERI_SPACE_SOLID ? 3 : 2;
    for (int k = 0; k < 4; ++k) {
        double *f[2] = {NULL, NULL}, largest = 0;
        int64_t n = 0;
        for (int many = 0; many < 2; ++many) {
            const int32_t count = many ? 120 : 1;
            double x[3 * 360], volume[360];
            int32_t ids[360], given[120], id = 0;
            peri_body_desc d;
            peri_material_desc m;
            peri_body *b = NULL;
            extreme_desc(&d, row->choice, precision, 2.1);
            extreme_material(&m, scene_laws[k], 0.2, 0);
            (void)extreme_fails(&o, NULL, peri_body_create(&d, &b, NULL));
            for (int32_t q = 0; q < count; ++q) HOLDS(PERI_ID_INDEX(given[q] = peri_add_material(b, &m)) == q + 1);
            if (many) ENDS(PERI_ERROR_TOO_LARGE, peri_add_material(b, &m));
            for (int i = 0; i < 360; ++i) {
                const int at[3] = {i % 10, i / 10 % 6, i / 60}, flat_at[2] = {i % 20, i / 20};
                for (int a = 0; a < dim; ++a) x[i * dim + a] = dim == 3 ? at[a] : flat_at[a];
                volume[i] = 1;
                ids[i] = given[id = (id + 77) % count]; /* 77 and 120 share no factor: all of them in turn */
            }
            if (extreme_fails(&o, b, peri_add_points(b, 360, x, volume, ids)) || extreme_fails(&o, b, peri_build(b)))
                return extreme_end(o, b);
            extreme_affine(&o, b, dim == 3 ? pull : flat, NULL);
            f[many] = extreme_read(&o, b, PERI_FIELD_FORCE_DENSITY);
            n = peri_size_of_field(b, PERI_FIELD_FORCE_DENSITY);
            o = extreme_end(o, b);
        }
        for (int64_t i = 0; f[0] && f[1] && i < n; ++i) largest = fmax(largest, fabs(f[0][i]));
        for (int64_t i = 0; f[0] && f[1] && i < n; ++i) o.error = extreme_worst(o.error, fabs(f[1][i] - f[0][i]) / largest);
        free(f[0]);
        free(f[1]);
    }
    return o;
}

/* `value` parts of a load act as the whole. */
static outcome many_loads(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    const double whole[2] = {0.3, -0.2}, part[2] = {0.3 / row->value, -0.2 / row->value};
    for (int k = 0; k < 4; ++k) {
        peri_body *b = scene_plate(&o, scene_laws[k], precision, PERI_SPACE_PLANE_STRAIN);
        double *f;
        if (o.status < 0) return extreme_end(o, b);
        (void)extreme_fails(&o, b, peri_remove_load(b, peri_id(b, PERI_KIND_LOAD, 1)));
        (void)extreme_fails(&o, b, peri_remove_load(b, peri_id(b, PERI_KIND_LOAD, 2)));
        for (int i = 0; i < (int)row->value; ++i) HOLDS(PERI_ID_INDEX(peri_apply_body_force(b, PERI_ALL, part, NULL, NULL)) == i + 3);
        f = extreme_read(&o, b, PERI_FIELD_FORCE_DENSITY);
        for (int64_t i = 0; f && i < peri_size_of_field(b, PERI_FIELD_FORCE_DENSITY); ++i)
            o.error = extreme_worst(o.error, fabs(f[i] / whole[i % 2] - 1));
        free(f);
        for (int i = 0; i < (int)row->value; ++i) (void)extreme_fails(&o, b, peri_remove_load(b, peri_id(b, PERI_KIND_LOAD, i + 3)));
        f = extreme_read(&o, b, PERI_FIELD_FORCE_DENSITY);
        for (int64_t i = 0; f && i < peri_size_of_field(b, PERI_FIELD_FORCE_DENSITY); ++i) HOLDS(f[i] == 0);
        free(f);
        o = extreme_end(o, b);
    }
    return o;
}

/* `value` supports on all points: the last one wins, and carries the body alone. */
static outcome many_supports(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    const int count = (int)row->value;
    peri_body *b = scene_plate(&o, PERI_LAW_LPS, precision, PERI_SPACE_PLANE_STRAIN);
    peri_advance_desc run;
    double *u;
    if (o.status < 0) return extreme_end(o, b);
    for (int i = 0; i < count; ++i) {
        const double value[2] = {1e-3 * (i + 1) / count, 0};
        HOLDS(PERI_ID_INDEX(peri_prescribe_displacement(b, PERI_ALL, PERI_AXIS_XY, value, NULL, NULL)) == i + 3);
    }
    peri_advance_desc_init(&run);
    run.steps = 1;
    (void)extreme_fails(&o, b, peri_advance(b, &run));
    u = extreme_read(&o, b, PERI_FIELD_DISPLACEMENT);
    for (int64_t i = 0; u && i < peri_size_of_field(b, PERI_FIELD_DISPLACEMENT); ++i)
        o.error = extreme_worst(o.error, fabs(u[i] - (i % 2 ? 0 : 1e-3)) / 1e-3);
    free(u);
    return extreme_end(o, b);
}

/* `value` obstacles that touch nothing change no force; their stiffness, equal to that of a bond over the square of a spacing each, bounds
   the stable step by 2/sqrt(sum). */
static outcome many_obstacles(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    const double place[2] = {0, -7}, up[2] = {0, 1}, centre[2] = {-9, -9}, pull[4] = {1e-3, 0, 2e-3, 0};
    for (int k = 0; k < 4; ++k) {
        peri_body *b = scene_plate(&o, scene_laws[k], precision, PERI_SPACE_PLANE_STRAIN);
        double *before, *after, step;
        if (o.status < 0) return extreme_end(o, b);
        extreme_affine(&o, b, pull, NULL);
        before = extreme_read(&o, b, PERI_FIELD_FORCE_DENSITY);
        step = peri_stable_step(b);
        for (int i = 0; i < (int)row->value; ++i)
            HOLDS(PERI_ID_INDEX(i % 2 ? plane_obstacle(b, place, up, 1, NULL, NULL)
                                      : ball_obstacle(b, centre, 2, 1, NULL, NULL)) == i + 1);
        after = extreme_read(&o, b, PERI_FIELD_FORCE_DENSITY);
        for (int64_t i = 0; before && after && i < peri_size_of_field(b, PERI_FIELD_FORCE_DENSITY); ++i) HOLDS(before[i] == after[i]);
        o.error = extreme_worst(o.error, fabs(peri_stable_step(b) * sqrt(4 / (step * step) + row->value) / 2 - 1));
        for (int i = 0; i < (int)row->value; ++i)
            (void)extreme_fails(&o, b, peri_remove_obstacle(b, peri_id(b, PERI_KIND_OBSTACLE, i + 1)));
        HOLDS(peri_stable_step(b) == step);
        free(before);
        free(after);
        o = extreme_end(o, b);
    }
    return o;
}

/* `value` sets, each found by its name, which differs in its last letters; and names of a million letters. */
static outcome many_sets(const extreme *row, int32_t precision) {
    enum { LETTERS = 1000000 };
    outcome o = {PERI_OK, "", 0};
    char name[32], *huge = (char *)malloc(LETTERS + 1);
    peri_body *b = scene_plate(&o, PERI_LAW_BOND_BASED, precision, PERI_SPACE_PLANE_STRAIN);
    if (o.status < 0) {
        free(huge);
        return extreme_end(o, b);
    }
    for (int i = 0; i < (int)row->value; ++i) {
        const int32_t point = i % 54;
        (void)snprintf(name, sizeof name, "a set with number %d", i);
        HOLDS(PERI_ID_INDEX(peri_select_points(b, name, 1, &point)) == i + 2);
    }
    for (int i = 0; i < (int)row->value; i += 7) {
        int32_t point = -1;
        (void)snprintf(name, sizeof name, "a set with number %d", i);
        const int32_t set = peri_id(b, PERI_KIND_SET, i + 2);
        HOLDS(peri_find_set(b, name) == set && peri_get_set(b, set, &point, 1) == PERI_OK && point == i % 54);
        ENDS(PERI_ERROR_NAME, peri_select_points(b, name, 1, &point));
    }
    memset(huge, 'x', LETTERS);
    huge[LETTERS] = 0;
    for (int32_t k = 0; k < 2; ++k) {
        huge[LETTERS - 1] = (char)('a' + k);
        const int32_t set = peri_select_points(b, huge, 1, &k);
        HOLDS(PERI_ID_INDEX(set) == (int)row->value + 2 + k && peri_find_set(b, huge) == set);
        ENDS(PERI_ERROR_NAME, peri_select_points(b, huge, 1, &k));
    }
    free(huge);
    return extreme_end(o, b);
}

static const char *const counts = "peri.h: exact of a box; points are cells, bonds are counted vector by vector, families are the vectors";
static const char *const large = "peri.h: more points or bonds than 32-bit ids can number, or than can be addressed; nothing is allocated";
static const char *const lack = "peri.h: the allocator returned NULL; a call that fails has changed nothing, so a small box then builds";

static const extreme rows[] = {
    {"plan of 1290^3 points", counts, planned, 1290, 3, 3, PERI_OK, NULL, {0, 0, 0}},
    {"plan of 46340^2 points", counts, planned, 46340, 3, 2, PERI_OK, NULL, {0, 0, 0}},
    {"plan of 46340^2 points, horizon 40", counts, planned, 46340, 40, 2, PERI_OK, NULL, {0, 0, 0}},
    {"plan of 2147483000 points in a line", counts, planned, 2147483000.0, 3, 1, PERI_OK, NULL, {0, 0, 0}},
    {"plan of 1291^3 points", large, planned, 1291, 3, 3, PERI_ERROR_TOO_LARGE, "spacing", {0, 0, 0}},
    {"plan of 46341^2 points", large, planned, 46341, 3, 2, PERI_ERROR_TOO_LARGE, "spacing", {0, 0, 0}},
    {"plan of 2^31 points in a line", large, planned, 2147483648.0, 3, 1, PERI_ERROR_TOO_LARGE, "spacing", {0, 0, 0}},
    {"plan of 1e15 points in a line", large, planned, 1e15, 3, 1, PERI_ERROR_TOO_LARGE, "spacing", {0, 0, 0}},
    {"plan of 1e308 points in a line", large, planned, 1e308, 3, 1, PERI_ERROR_TOO_LARGE, "spacing", {0, 0, 0}},
    {"plan of 46340^2 points, each with all others", large, planned, 46340, 1e9, 2, PERI_ERROR_TOO_LARGE, "horizon", {0, 0, 0}},
    {"box of 1290^3 points, a megabyte", lack, too_many_points, 1290, 3, 0, PERI_ERROR_MEMORY, NULL, {0, 0, 0}},
    {"perturbed box of 1290^3 points, a megabyte", lack, too_many_points, 1290, 3, 1, PERI_ERROR_MEMORY, NULL, {0, 0, 0}},
    {"ball in 1290^3 cells, a megabyte", lack, too_many_points, 1290, 3, 2, PERI_ERROR_MEMORY, NULL, {0, 0, 0}},
    {"shape in 46340^2 cells, a megabyte, not asked", lack, too_many_points, 46340, 2, 3, PERI_ERROR_MEMORY, NULL, {0, 0, 0}},
    {"box of 1291^3 points", large, too_many_points, 1291, 3, 0, PERI_ERROR_TOO_LARGE, "spacing", {0, 0, 0}},
    {"perturbed box of 46341^2 points", large, too_many_points, 46341, 2, 1, PERI_ERROR_TOO_LARGE, "spacing", {0, 0, 0}},
    {"ball in 1e100 cells", large, too_many_points, 1e50, 2, 2, PERI_ERROR_TOO_LARGE, "spacing", {0, 0, 0}},
    {"shape in 1291^3 cells", large, too_many_points, 1291, 3, 3, PERI_ERROR_TOO_LARGE, "spacing", {0, 0, 0}},
    {"a second box that makes it 2^31", large, one_box_too_many, 2147483583.0, 0, 0, PERI_ERROR_TOO_LARGE, "points", {0, 0, 0}},
    /* the net force is the rounding of n - 1 bonds per point, which add up like a random walk at worst linearly: 600 u */
    {"families of all 600 points in two megabytes", "every pair is a bond; bonds pull both ends alike, so the net force is zero",
     too_many_bonds, 50, 0, PERI_LAW_BOND_BASED, PERI_OK, NULL, {1.4e-13, 1.4e-13, 7.2e-5}},
    {"families of all 1200 points in two megabytes, LPS", "the same, beyond the 1024 bonds of a row that is copied",
     too_many_bonds, 100, 0, PERI_LAW_LPS, PERI_OK, NULL, {2.7e-13, 2.7e-13, 1.5e-4}},
    /* integer places are exact in double; the stretch 1e-3 is off by u/s = 1e3 u of the displacements */
    {"pairs 1e9 horizons apart, in a line", "a pair is a bar: f = c s V, c = 9E/(pi h^3) in plane stress, 12E/(pi h^4) in 3D",
     pairs_far_apart, 1e9, 0, 1, PERI_OK, NULL, {1e-12, 1e-6, 1e-3}},
    {"pairs 1e9 horizons apart, in space", "the same", pairs_far_apart, 1e9, 0, 3, PERI_OK, NULL, {1e-12, 1e-6, 1e-3}},
    {"pairs 1e3 horizons apart, in space", "the same; single precision: bonds of length 1 at places of 6e3, which are exact",
     pairs_far_apart, 1e3, 0, 3, PERI_OK, NULL, {1e-12, 1e-6, 1e-3}},
    {"a horizon of 1e-200 spacings", "peri.h: the horizon is smaller than the spacing of the points", horizon_of, 1e-200, PERI_SPACE_SOLID,
     0, PERI_ERROR_HORIZON, NULL, {0, 0, 0}},
    {"a horizon of 1e-200 spacings, 2D", "the same", horizon_of, 1e-200, PERI_SPACE_PLANE_STRESS, 0, PERI_ERROR_HORIZON, NULL, {0, 0, 0}},
    {"a horizon of 5e-324 spacings", "the same", horizon_of, 5e-324, PERI_SPACE_SOLID, 0, PERI_ERROR_HORIZON, NULL, {0, 0, 0}},
    {"cells of 1e-300", large, spacing_of, 1e-300, PERI_SPACE_SOLID, 0, PERI_ERROR_TOO_LARGE, "spacing", {0, 0, 0}},
    {"cells of 5e-324", large, spacing_of, 5e-324, PERI_SPACE_PLANE_STRAIN, 0, PERI_ERROR_TOO_LARGE, "spacing", {0, 0, 0}},
    {"cells of 1e300: one, which is 4 wide", "peri.h: at least one cell, that tiles the box; smaller than the horizon 3 it is not",
     spacing_of, 1e300, PERI_SPACE_SOLID, 0, PERI_ERROR_HORIZON, NULL, {0, 0, 0}},
    {"nothing asked for, 2D", "peri.h: PERI_ERROR_CAPACITY, _INDEX, _EMPTY, _ARGUMENT, or no work done; nothing changed", nothing, 0, 0,
     PERI_SPACE_PLANE_STRAIN, PERI_OK, NULL, {0, 0, 0}},
    {"nothing asked for, 3D", "the same", nothing, 0, 0, PERI_SPACE_SOLID, PERI_OK, NULL, {0, 0, 0}},
    {"one entry less and more, 2D", "peri.h: PERI_ERROR_CAPACITY with the size; what fits is filled to its end and no further", off_by_one,
     0, 0, PERI_SPACE_PLANE_STRESS, PERI_OK, NULL, {0, 0, 0}},
    {"one entry less and more, 3D", "the same", off_by_one, 0, 0, PERI_SPACE_SOLID, PERI_OK, NULL, {0, 0, 0}},
    /* another order of the same operations: sums of 40 bonds, each off by a few u over the strain of 2e-3 */
    {"120 materials, all alike, and one more, 2D", "materials with the same numbers are one material; peri.h: at most 120", materials, 0, 0,
     PERI_SPACE_PLANE_STRESS, PERI_OK, NULL, {1e-12, 1e-4, 1e-3}},
    {"120 materials, all alike, and one more, 3D", "the same", materials, 0, 0, PERI_SPACE_SOLID, PERI_OK, NULL, {1e-12, 1e-4, 1e-3}},
    /* n additions, each off by u at most */
    {"4000 loads", "a load of a number of equal parts is the sum of them", many_loads, 4000, 0, 0, PERI_OK, NULL, {9e-13, 9e-13, 4.8e-4}},
    {"1500 supports on the same points", "peri.h: later supports win", many_supports, 1500, 0, 0, PERI_OK, NULL, {4e-16, 4e-16, 2.4e-7}},
    {"3000 obstacles out of reach", "no force where there is no touch; the step by 2/sqrt(lambda + sum of stiffness over density)",
     many_obstacles, 3000, 0, 0, PERI_OK, NULL, {1e-12, 1e-12, 1e-12}},
    {"3000 sets, and names of a million letters", "peri.h: an id, by its name; a name that is taken is refused", many_sets, 3000, 0, 0,
     PERI_OK, NULL, {0, 0, 0}},
};
const extreme_table extreme_sizes = EXTREME_TABLE("sizes", rows);
