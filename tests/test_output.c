/* SPDX-License-Identifier: MIT */
/* test_output.c - what comes out: reads, views, VTU, CSV.

   SOURCE OF TRUTH: peri.h for what a view means and what is written; the VTK XML format (appended raw data: each array a UInt64
   byte count, then the numbers), which is parsed here from scratch; and consistency: file, view and read must agree. */
#include "scene.h"
#include <locale.h>

typedef struct buffer {
    char   *bytes;
    int64_t size, room;
    int     calls, fail_at; /* fail call number fail_at (from 1); 0 = never */
} buffer;

static int32_t collect(void *user, const void *bytes, int64_t count) {
    buffer *b = (buffer *)user;
    if (++b->calls == b->fail_at) return 1;
    if (b->size + count + 1 > b->room) {
        b->room = 2 * b->room + count + 4096;
        b->bytes = (char *)realloc(b->bytes, (size_t)b->room);
    }
    if (count > 0) memcpy(b->bytes + b->size, bytes, (size_t)count);
    b->size += count;
    b->bytes[b->size] = 0;
    return 0;
}

/* A plate or block of two materials, cracked, loaded, and run until it broke somewhere: every field has something to show. */
static peri_body *subject(int32_t space, int32_t precision) {
    const double lo[3] = {-3.1, 0.2, 1.3}, mid[3] = {-2.6, 0.8, 1.7}, lo2[3] = {-2.6, 0.2, 1.3}, hi2[3] = {-2.1, 0.8, 1.7};
    const double a[2] = {-2.6, 0.2}, z[2] = {-2.6, 0.4}, pull[3] = {0.4, 0.3, -0.2}, fast[3] = {0.6, 0.1, 0.2};
    const double corner[3] = {-2.6, 0.2, 1.3}, n[3] = {1, 0, 0};
    peri_body *b = empty(space, precision, PERI_GEOMETRY_NONLINEAR, 2.5 * H);
    peri_material_desc m;
    int k;
    for (k = 0; k < 2; ++k) {
        peri_material_desc_init(&m, PERI_LAW_BOND_BASED);
        m.young = YOUNG + k;
        m.density = DENSITY - k;
        m.critical_stretch = 0.05;
        (void)MUST(b, peri_add_material(b, &m));
    }
    (void)MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo, mid, H));
    (void)MUST(b, peri_add_perturbed_box(b, peri_id(b, PERI_KIND_MATERIAL, 2), lo2, hi2, H, space == PERI_SPACE_SOLID ? 0 : 0.8, 4));
    (void)MUST(b, peri_build(b));
    (void)MUST(b, space == PERI_SPACE_SOLID ? peri_cut_disc(b, PERI_CUT_INITIAL, corner, n, 0.25)
                                            : peri_cut_segment(b, PERI_CUT_INITIAL, a, z));
    (void)MUST(b, peri_apply_body_force(b, PERI_ALL, pull, NULL, NULL));
    (void)MUST(b, peri_add_velocity(b, (int32_t)MUST(b, peri_select_box(b, NULL, lo2, hi2)), fast));
    (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 30, 0, 0.05);
    CHECK(peri_broken_count(b) > 0 && peri_cut_count(b) > 0);
    return b;
}

/* ---- reads and views ---------------------------------------------------------------------------------------------- */

static double from_view(const peri_view *v, int64_t i, int k) {
    int64_t at = i * v->point_stride + k * v->component_stride;
    double x = v->type == PERI_TYPE_F64 ? ((const double *)v->data)[at]
             : v->type == PERI_TYPE_F32 ? (double)((const float *)v->data)[at]
                                   : (double)((const int32_t *)v->data)[at];
    return v->offset[k] + v->scale * x;
}

/* offset + scale*data, rounded twice, against the same by the library: 2 units of the larger of value and offset. */
static void views_agree(int32_t space, int32_t precision) {
    peri_body *b = subject(space, precision);
    int32_t f;
    int64_t n = peri_point_count(b), i;
    int dim = peri_dimension(b), k;
    for (f = PERI_FIELD_POSITION; f <= PERI_FIELD_CURRENT_POSITION; ++f) {
        int vector = f <= PERI_FIELD_FORCE_DENSITY || f == PERI_FIELD_CURRENT_POSITION, different = 0;
        double *x = get(b, f);
        peri_view v;
        memset(&v, 0, sizeof v);
        CHECK(peri_size_of_field(b, f) == n * (vector ? dim : 1));
        (void)MUST(b, peri_view_field(b, f, &v));
        CHECK(v.count == n && v.components == (vector ? dim : 1) && v.data != NULL);
        CHECK(v.type == PERI_TYPE_F64 || v.type == PERI_TYPE_F32 || v.type == PERI_TYPE_I32);
        for (i = 0; i < n; ++i)
            for (k = 0; k < v.components; ++k) {
                double want = x[i * v.components + k];
                CHECK_NEAR(from_view(&v, i, k), want, 2 * ULP64, 2 * ULP64 * fabs(v.offset[k]));
                if (want != x[k]) different = 1;
            }
        CHECK(different || f == PERI_FIELD_VOLUME); /* 3D: all cells alike */
        free(x);
    }
    peri_body_destroy(b);
}
static void views_and_reads_agree(void) {
    views_agree(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE);
    views_agree(PERI_SPACE_PLANE_STRAIN, PERI_PRECISION_SINGLE);
    views_agree(PERI_SPACE_SOLID, PERI_PRECISION_DOUBLE);
    views_agree(PERI_SPACE_SOLID, PERI_PRECISION_SINGLE);
    views_agree(PERI_SPACE_SOLID, PERI_PRECISION_MIXED);
}

/* "A stored field's view stays valid, and current." */
static void stored_views_stay_current(void) {
    const int32_t stored[5] = {PERI_FIELD_POSITION, PERI_FIELD_DISPLACEMENT, PERI_FIELD_VELOCITY, PERI_FIELD_FORCE_DENSITY,
                               PERI_FIELD_VOLUME};
    peri_body *b = subject(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE), *c = NULL;
    peri_view v[5];
    int k;
    for (k = 0; k < 5; ++k) (void)MUST(b, peri_view_field(b, stored[k], &v[k]));
    (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 7, 0, 0);
    (void)MUST(b, peri_body_clone(b, &c, NULL));
    (void)go(c, PERI_INTEGRATOR_VELOCITY_VERLET, 7, 0, 0); /* the clone's motion must not show */
    for (k = 0; k < 5; ++k) {
        double *x = get(b, stored[k]);
        int64_t i;
        for (i = 0; i < peri_size_of_field(b, stored[k]); ++i)
            CHECK_NEAR(from_view(&v[k], i / v[k].components, (int)(i % v[k].components)), x[i], 2 * ULP64,
                       2 * ULP64 * fabs(v[k].offset[i % v[k].components]));
        free(x);
    }
    peri_body_destroy(b);
    peri_body_destroy(c);
}

/* SOURCE OF TRUTH: definitions. Current = position + displacement; damage from the bonds that are (not) intact, whole cells:
   1 - (intact volume)/(family volume); grown damage leaves out what was cut at first, so damage of a cut-only body has none. */
static void derived_fields_by_definition(void) {
    peri_body *b = subject(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE);
    double *x = get(b, PERI_FIELD_POSITION), *u = get(b, PERI_FIELD_DISPLACEMENT), *y = get(b, PERI_FIELD_CURRENT_POSITION);
    double *vol = get(b, PERI_FIELD_VOLUME);
    double *damage = get(b, PERI_FIELD_DAMAGE), *grown = get(b, PERI_FIELD_DAMAGE_GROWN), *size = get(b, PERI_FIELD_FAMILY_SIZE);
    double *mat = get(b, PERI_FIELD_MATERIAL);
    int32_t width = peri_family_width(b), *rows;
    int64_t n = peri_point_count(b), i, k;
    rows = (int32_t *)calloc((size_t)(n * width), sizeof *rows);
    (void)MUST(b, peri_get_families(b, 0, n, rows, n * width));
    for (i = 0; i < n; ++i) {
        double all = 0, intact = 0;
        int count = 0;
        for (k = 0; k < width; ++k) {
            int32_t j = rows[i * width + k];
            if (j == i) continue;
            count++;
            all += vol[j];
            if (peri_bond_is_intact(b, (int32_t)i, j) == 1) intact += vol[j];
        }
        CHECK(size[i] == count);
        CHECK_NEAR(damage[i], 1 - intact / all, 1e-12, 1e-14);
        CHECK(grown[i] <= damage[i] + 1e-14 && grown[i] >= -1e-14);
        CHECK(mat[i] == (i < 30 ? 1 : 2));
        for (k = 0; k < 2; ++k) CHECK_NEAR(y[2 * i + k], x[2 * i + k] + u[2 * i + k], 4 * ULP64, 1e-15);
    }
    free(grown);
    free(damage);
    (void)MUST(b, peri_reset(b));
    grown = get(b, PERI_FIELD_DAMAGE_GROWN);
    damage = get(b, PERI_FIELD_DAMAGE);
    CHECK(largest(grown, n) == 0 && largest(damage, n) > 0.1);
    free(x);
    free(u);
    free(y);
    free(vol);
    free(damage);
    free(grown);
    free(size);
    free(mat);
    free(rows);
    peri_body_destroy(b);
}

/* SOURCE OF TRUTH: what was written is read, to the roundings of storing in own units: 3 u relative to each number. */
static void write_then_read(void) {
    int k;
    for (k = 0; k < 4; ++k) {
        int32_t precision = k & 1 ? PERI_PRECISION_SINGLE : PERI_PRECISION_DOUBLE;
        int32_t field = k & 2 ? PERI_FIELD_VELOCITY : PERI_FIELD_DISPLACEMENT;
        peri_body *b = subject(PERI_SPACE_SOLID, precision);
        int64_t n = peri_size_of_field(b, field), i;
        double *in = random_field(n, 0.3 * H, 77), *out, ulp = precision == PERI_PRECISION_DOUBLE ? ULP64 : ULP32;
        put(b, field, in);
        out = get(b, field);
        for (i = 0; i < n; ++i) CHECK_NEAR(out[i], in[i], 3 * ulp, 0);
        free(in);
        free(out);
        peri_body_destroy(b);
    }
}

/* ---- VTU ---------------------------------------------------------------------------------------------------------- */

/* The value of attribute `name` in the tag that starts at `tag`; "" where it has none. */
static const char *attribute(const char *tag, const char *name, char *value) {
    const char *end = strchr(tag, '>'), *at = tag;
    size_t len = strlen(name), k = 0;
    value[0] = 0;
    while (end && (at = strstr(at, name)) != NULL && at < end) {
        if (at[-1] == ' ' && at[len] == '=' && at[len + 1] == '"') {
            for (at += len + 2; *at != '"' && k < 63; ++at) value[k++] = *at;
            value[k] = 0;
            return value;
        }
        at += len;
    }
    return value;
}

typedef struct array {
    char        name[64], type[64];
    int         components, width;
    int64_t     count; /* numbers */
    const char *data;
} array;

static double number(const array *a, int64_t k) {
    const char *at = a->data + k * a->width;
    if (strcmp(a->type, "Float64") == 0) { double v; memcpy(&v, at, 8); return v; }
    if (strcmp(a->type, "Float32") == 0) { float v; memcpy(&v, at, 4); return (double)v; }
    if (strcmp(a->type, "Int64") == 0) { int64_t v; memcpy(&v, at, 8); return (double)v; }
    if (strcmp(a->type, "Int32") == 0) { int32_t v; memcpy(&v, at, 4); return (double)v; }
    return (double)*(const unsigned char *)at;
}

/* Reads all DataArrays of a VTU file; returns their number, 0 where the file is malformed. Only this machine's byte order. */
static int parse_vtu(const buffer *f, array *arrays, int most, int64_t *points, int64_t *cells) {
    char v[64];
    const char *head = f->bytes, *raw, *tag, *tail = "</VTKFile>";
    int count = 0;
    int64_t next = 0, base, end = f->size;
    const uint16_t one = 1;
    tag = strstr(head, "<VTKFile ");
    raw = strstr(head, "<AppendedData ");
    CHECK(strncmp(head, "<?xml", 5) == 0 || strncmp(head, "<VTKFile", 8) == 0);
    CHECK(tag && raw && strstr(head, "<UnstructuredGrid") && strstr(head, "<Piece "));
    if (!tag || !raw || !strstr(head, "<Piece ")) return 0;
    CHECK(strcmp(attribute(tag, "type", v), "UnstructuredGrid") == 0);
    CHECK(strcmp(attribute(tag, "header_type", v), "UInt64") == 0);
    CHECK(strcmp(attribute(tag, "byte_order", v), *(const char *)&one ? "LittleEndian" : "BigEndian") == 0);
    CHECK(strcmp(attribute(raw, "encoding", v), "raw") == 0);
    *points = strtol(attribute(strstr(head, "<Piece "), "NumberOfPoints", v), NULL, 10);
    *cells = strtol(attribute(strstr(head, "<Piece "), "NumberOfCells", v), NULL, 10);
    tag = strchr(raw, '>');
    tag = tag ? strchr(tag, '_') : NULL; /* the data begin behind the underscore */
    if (!tag) return 0;
    base = tag + 1 - head;
    while (end > base && (head[end - 1] == '\n' || head[end - 1] == ' ')) --end;
    CHECK(end - (int64_t)strlen(tail) > base && strncmp(head + end - strlen(tail), tail, strlen(tail)) == 0);
    for (tag = head; (tag = strstr(tag, "<DataArray ")) != NULL && tag < raw && count < most; ++tag) {
        array *a = &arrays[count];
        uint64_t bytes;
        CHECK(strcmp(attribute(tag, "format", v), "appended") == 0);
        (void)attribute(tag, "Name", a->name);
        (void)attribute(tag, "type", a->type);
        a->width = strstr(a->type, "64") ? 8 : strstr(a->type, "32") ? 4 : 1;
        a->components = attribute(tag, "NumberOfComponents", v)[0] ? atoi(v) : 1;
        CHECK(strtol(attribute(tag, "offset", v), NULL, 10) == next); /* one after the other, without gaps */
        if (base + next + 8 > end) return 0;
        memcpy(&bytes, head + base + next, 8);
        a->data = head + base + next + 8;
        a->count = (int64_t)bytes / a->width;
        next += 8 + (int64_t)bytes;
        if (bytes % (uint64_t)a->width || base + next > end) return 0;
        count++;
    }
    tag = head + base + next; /* and then only the closing tags */
    while (*tag == '\n' || *tag == ' ') ++tag;
    CHECK(strncmp(tag, "</AppendedData>", 15) == 0);
    return count;
}

static const array *find(const array *a, int count, const char *word) {
    int k;
    for (k = 0; k < count; ++k)
        if (strstr(a[k].name, word)) return &a[k];
    return NULL;
}

static void compare(const array *a, const double *want, int64_t n, int components, const char *what) {
    int64_t i;
    int k, shown = a ? a->components : 0;
    double tolerance;
    CHECK(a != NULL);
    if (!a) {
        printf("    no array %s\n", what);
        return;
    }
    CHECK(a->count == n * shown && (shown == components || (shown == 3 && components == 2)));
    if (a->count != n * shown) return;
    tolerance = strcmp(a->type, "Float32") == 0 ? ULP32 : 0; /* exactly, or rounded once to float */
    for (i = 0; i < n; ++i)
        for (k = 0; k < shown; ++k)
            CHECK_NEAR(number(a, i * shown + k), k < components ? want[i * components + k] : 0, tolerance, 0);
}

static void vtu(int32_t space, int32_t precision) {
    static const struct { const char *name; int32_t field; } fields[6] = {
        {"isplacement", PERI_FIELD_DISPLACEMENT}, {"elocity", PERI_FIELD_VELOCITY}, {"amage", PERI_FIELD_DAMAGE},
        {"nergy", PERI_FIELD_ENERGY_DENSITY},     {"aterial", PERI_FIELD_MATERIAL}, {"olume", PERI_FIELD_VOLUME}};
    peri_body *b = subject(space, precision);
    buffer f = {NULL, 0, 0, 0, 0}, g;
    array a[24];
    const array *connectivity, *offsets, *types, *place = NULL;
    int64_t n = peri_point_count(b), points = 0, cells = 0, i, last = 0;
    int dim = peri_dimension(b), count, k;
    double *x;
    memset(a, 0, sizeof a);
    (void)MUST(b, peri_export_vtu_to(b, collect, &f));
    count = parse_vtu(&f, a, 24, &points, &cells);
    CHECK(count >= 10 && points == n && cells > 0);
    for (k = 0; k < 6; ++k) {
        x = get(b, fields[k].field);
        compare(find(a, count, fields[k].name), x, n, k < 2 ? dim : 1, fields[k].name);
        free(x);
    }
    x = get(b, PERI_FIELD_STRESS); /* ParaView's order of a symmetric tensor is xx yy zz xy yz xz */
    for (i = 0; i < n; ++i)
        for (k = 0; k < 6; ++k) {
            static const int plane[6] = {0, 1, -1, 2, -1, -1};
            int from = dim == 3 ? k : plane[k];
            const array *stress = find(a, count, "tress");
            CHECK(stress && stress->components == 6);
            if (stress) CHECK_NEAR(number(stress, 6 * i + k), from < 0 ? 0 : x[i * (dim == 3 ? 6 : 3) + from], 0, 0);
        }
    free(x);
    for (k = 0; k < count; ++k) /* the array inside <Points>: three components, none of the fields */
        if (a[k].components == 3 && !strstr(a[k].name, "isplacement") && !strstr(a[k].name, "elocity")) place = &a[k];
    x = get(b, PERI_FIELD_POSITION);
    compare(place, x, n, dim, "points");
    free(x);
    connectivity = find(a, count, "connectivity");
    offsets = find(a, count, "offsets");
    types = find(a, count, "types");
    CHECK(connectivity && offsets && types && offsets->count == cells && types->count == cells);
    if (connectivity && offsets && types && test_bad == 0) {
        for (i = 0; i < connectivity->count; ++i) CHECK(number(connectivity, i) >= 0 && number(connectivity, i) < (double)n);
        for (i = 0; i < cells; ++i) {
            CHECK(number(types, i) == 1 || number(types, i) == 2); /* VTK_VERTEX, VTK_POLY_VERTEX */
            CHECK(number(offsets, i) > (double)last || (i == 0 && number(offsets, i) > 0));
            last = (int64_t)number(offsets, i);
        }
        CHECK(last == connectivity->count);
    }
    for (k = 1; k <= f.calls; ++k) { /* a writer that fails, at every call */
        memset(&g, 0, sizeof g);
        g.fail_at = k;
        CHECK(peri_export_vtu_to(b, collect, &g) == PERI_ERROR_WRITE && g.calls == k);
        free(g.bytes);
    }
    memset(&g, 0, sizeof g);
    (void)MUST(b, peri_export_vtu_to(b, collect, &g)); /* the same again afterwards */
    CHECK(g.size == f.size && memcmp(g.bytes, f.bytes, (size_t)f.size) == 0);
    free(g.bytes);
    if (space == PERI_SPACE_SOLID) { /* and through the file helper */
        FILE *file;
        char *text = (char *)calloc(1, (size_t)f.size + 1);
        const char *path = "test_output_tmp.vtu";
        (void)MUST(b, peri_export_vtu(b, path));
        file = fopen(path, "rb");
        CHECK(file != NULL && fread(text, 1, (size_t)f.size + 1, file) == (size_t)f.size);
        CHECK(memcmp(text, f.bytes, (size_t)f.size) == 0);
        if (file) (void)fclose(file);
        (void)remove(path);
        free(text);
    }
    free(f.bytes);
    peri_body_destroy(b);
}
static void vtu_holds_what_read_gives(void) {
    vtu(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE);
    vtu(PERI_SPACE_PLANE_STRAIN, PERI_PRECISION_SINGLE);
    vtu(PERI_SPACE_SOLID, PERI_PRECISION_DOUBLE);
}

/* Fields of the caller's choice, in its order, and no others; NULL are the usual ones. The deformation gradient is by rows, and 1 in z in
   2D. */
static void chosen_fields(void) {
    static const int32_t fields[5] = {PERI_FIELD_DEFORMATION_GRADIENT, PERI_FIELD_REACTION, PERI_FIELD_FRAGMENT, PERI_FIELD_STRAIN,
                                      PERI_FIELD_FORCE_DENSITY};
    static const int32_t some[3] = {0, 1, 2};
    const double more[3] = {1e-4, 2e-4, 0};
    static const int32_t twice[3] = {PERI_FIELD_DAMAGE, PERI_FIELD_VOLUME, PERI_FIELD_DAMAGE}, odd[2] = {PERI_FIELD_DAMAGE, 7};
    for (int space = PERI_SPACE_PLANE_STRAIN; space <= PERI_SPACE_SOLID; ++space) {
        peri_body *b = subject(space, PERI_PRECISION_DOUBLE);
        buffer f = {NULL, 0, 0, 0, 0}, usual = {NULL, 0, 0, 0, 0}, bare = {NULL, 0, 0, 0, 0};
        const int64_t n = peri_point_count(b);
        const int dim = peri_dimension(b);
        int64_t points = 0, cells = 0;
        peri_error e;
        array a[24];
        memset(a, 0, sizeof a);
        MUST(b, peri_add_displacement(b, (int32_t)MUST(b, peri_select_points(b, NULL, 3, some)), more)); /* forces are old then */
        MUST(b, peri_export_fields_to(b, fields, 5, collect, &f));
        CHECK(parse_vtu(&f, a, 24, &points, &cells) == 9 && points == n && cells == n);
        CHECK(strcmp(a[1].name, "deformation_gradient") == 0 && strcmp(a[2].name, "reaction") == 0);
        CHECK(strcmp(a[3].name, "fragment") == 0 && strcmp(a[4].name, "strain") == 0 && !strstr(f.bytes, "Scalars"));
        double *x = get(b, PERI_FIELD_DEFORMATION_GRADIENT);
        CHECK(a[1].components == 9 && a[1].count == 9 * n);
        for (int64_t k = 0; k < 9 * n; ++k) {
            const int64_t row = k % 9 / 3, column = k % 3;
            const double want = row < dim && column < dim ? x[k / 9 * dim * dim + row * dim + column] : row == column;
            CHECK_NEAR(number(&a[1], k), want, 0, 0);
        }
        free(x);
        x = get(b, PERI_FIELD_REACTION);
        compare(&a[2], x, n, dim, "reaction");
        free(x);
        x = get(b, PERI_FIELD_FRAGMENT);
        compare(&a[3], x, n, 1, "fragment");
        free(x);
        x = get(b, PERI_FIELD_FORCE_DENSITY);
        compare(&a[5], x, n, dim, "force_density");
        free(x);
        MUST(b, peri_export_vtu_to(b, collect, &usual));
        free(f.bytes);
        memset(&f, 0, sizeof f);
        MUST(b, peri_export_fields_to(b, NULL, 0, collect, &f));
        CHECK(f.size == usual.size && memcmp(f.bytes, usual.bytes, (size_t)f.size) == 0);
        MUST(b, peri_export_fields_to(b, fields, 0, collect, &bare)); /* places alone */
        CHECK(parse_vtu(&bare, a, 24, &points, &cells) == 4);
        CHECK(peri_export_fields_to(b, twice, 3, collect, &bare) == PERI_ERROR_ARGUMENT);
        CHECK(peri_get_error(b, &e) == PERI_OK && strcmp(e.field, "fields") == 0 && e.index == 2);
        CHECK(peri_export_fields_to(b, odd, 2, collect, &bare) == PERI_ERROR_CHOICE);
        CHECK(peri_get_error(b, &e) == PERI_OK && strcmp(e.field, "fields") == 0 && e.index == 1 && e.value == 7);
        CHECK(peri_export_fields_to(b, odd, -1, collect, &bare) == PERI_ERROR_ARGUMENT);
        CHECK(peri_export_fields_to(b, fields, 4, NULL, NULL) == PERI_ERROR_ARGUMENT);
        free(f.bytes);
        free(usual.bytes);
        free(bare.bytes);
        peri_body_destroy(b);
    }
}

/* ---- CSV ---------------------------------------------------------------------------------------------------------- */

static void history_line(peri_body *b, const char *line) {
    double v[13];
    peri_energy e;
    int k;
    char *end = NULL;
    for (k = 0; k < 13; ++k) {
        v[k] = strtod(line, &end);
        CHECK(end != line && *end == (k < 12 ? ',' : '\n'));
        line = end + 1;
    }
    (void)MUST(b, peri_get_energy(b, &e));
    CHECK(v[0] == (double)peri_step_count(b) && v[11] == (double)peri_broken_count(b) && v[12] == (double)peri_cut_count(b));
    CHECK_NEAR(v[1], peri_time(b), 1e-12, 0);
    CHECK_NEAR(v[2], e.kinetic, 1e-12, 0);
    CHECK_NEAR(v[3], e.elastic, 1e-12, 0);
    CHECK_NEAR(v[4], e.contact, 1e-12, 0);
    CHECK_NEAR(v[5], e.external, 1e-12, 0);
    CHECK_NEAR(v[6], e.obstacle, 1e-12, 0);
    CHECK_NEAR(v[7], e.damping, 1e-12, 0);
    CHECK_NEAR(v[8], e.fracture, 1e-12, 0);
    CHECK_NEAR(v[9], e.initial, 1e-12, 0);
    CHECK_NEAR(v[10], e.error, 1e-12, 1e-12 * (e.kinetic + e.elastic));
    CHECK(v[2] > 0 && v[3] > 0 && v[5] != 0 && v[7] > 0 && v[8] > 0 && v[9] > 0 && v[11] > 0 && v[12] > 0);
}

/* SOURCE OF TRUTH: peri_export_history_to's contract: step, time, the ledger in the order of peri_energy, broken and cut bonds. */
static void history(void) {
    static const char *const names[13] = {"step",     "time",    "kinetic",  "elastic", "contact", "external", "obstacle",
                                          "damping",  "fracture", "initial", "error",   "broken",   "cut"};
    peri_body *b = subject(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE);
    buffer f = {NULL, 0, 0, 0, 0}, g = {NULL, 0, 0, 0, 0};
    const char *at, *second;
    int k;
    (void)MUST(b, peri_export_history_to(b, 1, collect, &f));
    (void)MUST(b, peri_export_history_to(b, 0, collect, &g));
    at = f.bytes;
    for (k = 0; k < 13; ++k) { /* the names, in this order, one per column */
        const char *stop = strpbrk(at, ",\n"), *word = strstr(at, names[k]);
        CHECK(stop && word && word < stop && *stop == (k < 12 ? ',' : '\n'));
        if (!stop) break;
        at = stop + 1;
    }
    second = strchr(f.bytes, '\n');
    CHECK(second && strcmp(second + 1, g.bytes) == 0);
    history_line(b, g.bytes);
    CHECK(g.bytes[g.size - 1] == '\n' && strchr(g.bytes, '\n') == g.bytes + g.size - 1 && strchr(f.bytes, '\r') == NULL);
    for (k = 1; k <= f.calls; ++k) {
        buffer h = {NULL, 0, 0, 0, 0};
        h.fail_at = k;
        CHECK(peri_export_history_to(b, 1, collect, &h) == PERI_ERROR_WRITE);
        free(h.bytes);
    }
    /* a locale with a decimal comma must not get into the file */
    if (setlocale(LC_ALL, "de_DE.UTF-8") || setlocale(LC_ALL, "fr_FR.UTF-8") || setlocale(LC_ALL, "de_DE")) {
        buffer h = {NULL, 0, 0, 0, 0};
        (void)MUST(b, peri_export_history_to(b, 0, collect, &h));
        (void)setlocale(LC_ALL, "C");
        CHECK(strcmp(h.bytes, g.bytes) == 0);
        free(h.bytes);
    } else printf("    (no locale with a decimal comma here: not tried)\n");
    free(f.bytes);
    free(g.bytes);
    peri_body_destroy(b);
}

/* append = 0 starts the file with a header, 1 adds a line. */
static void history_file(void) {
    const char *path = "test_output_tmp.csv";
    peri_body *b = subject(PERI_SPACE_SOLID, PERI_PRECISION_SINGLE);
    char text[4096];
    size_t size;
    FILE *file;
    int lines = 0, round;
    for (round = 0; round < 2; ++round) { /* the second round starts the file again */
        (void)MUST(b, peri_export_history(b, path, 0));
        (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 5, 0, 0.05);
        (void)MUST(b, peri_export_history(b, path, 1));
        (void)MUST(b, peri_export_history(b, path, 1));
    }
    file = fopen(path, "rb");
    CHECK(file != NULL);
    if (file) {
        char *at = text, *last = text;
        size = fread(text, 1, sizeof text - 1, file);
        text[size] = 0;
        (void)fclose(file);
        for (; (at = strchr(at, '\n')) != NULL; ++at) {
            lines++;
            if (at[1]) last = at + 1;
        }
        CHECK(lines == 4 && strstr(text, "step") == text);
        history_line(b, last);
    }
    (void)remove(path);
    peri_body_destroy(b);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(views_and_reads_agree);
    RUN(stored_views_stay_current);
    RUN(derived_fields_by_definition);
    RUN(write_then_read);
    RUN(vtu_holds_what_read_gives);
    RUN(chosen_fields);
    RUN(history);
    RUN(history_file);
    return test_end("test_output");
}
