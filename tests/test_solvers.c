/* SPDX-License-Identifier: MIT */
/* test_solvers.c - the linear solver and the stiffness, on small bodies of every law and space.

   SOURCE OF TRUTH: Cholesky's factorisation, written in equilibrium.h, of the assembled stiffness with the supports taken out; finite
   differences of the forces, whose order is known; objectivity, f(Q y) = Q f(y). The stiffness itself is held against the forces, so no
   test rests on the solver alone. */
#include "held_body.h"

/* ---- the dense answer --------------------------------------------------------------------------------------------- */

/* |u - dense| <= |K^-1| |residual| <= soft*tolerance*scale; asked to 1e-12 this is below 1e-9 of the largest displacement. Reactions to
   1e-9 of the scale: |K| |K^-1| 1e-12. */
static void holds_dense(peri_body *b, int32_t space, const char *what) {
    task t = task_of(b, space, WIND);
    peri_solve_desc s = statics_of(1e-12);
    double *u, *r, *force, total[3], sum[3] = {0, 0, 0};
    int dim = peri_dimension(b), d;
    int64_t k;
    solve_densely(&t);
    apply_wind(&t, WIND);
    (void)solve(b, &s);
    u = get(b, PERI_FIELD_DISPLACEMENT);
    r = get(b, PERI_FIELD_REACTION);
    force = forces_of(b, r, space);
    if (!(furthest(u, t.u, t.n) <= 1e-9 * largest(t.u, t.n)) || !(furthest(force, t.reaction, t.n) <= 1e-9 * scale_of(&t))) {
        printf("    %s: displacement off by %.2g, reaction by %.2g\n", what, furthest(u, t.u, t.n) / largest(t.u, t.n),
               furthest(force, t.reaction, t.n) / scale_of(&t));
        test_bad++;
    }
    /* the totals of the three supports, where they do not own the same dofs: the later takes y from the grip */
    for (k = 0; k < t.n; ++k) sum[k % dim] += t.reaction[k];
    for (d = 0; d < dim; ++d) total[d] = 0;
    for (k = 0; k < 3; ++k) {
        double part[3] = {0, 0, 0};
        (void)MUST(b, peri_get_reaction(b, k == 0 ? t.grip : k == 1 ? t.roller : t.pull, part));
        for (d = 0; d < dim; ++d) total[d] += part[d];
    }
    for (d = 0; d < dim; ++d) CHECK_NEAR(total[d], sum[d], 0, 1e-9 * scale_of(&t));
    free(u);
    free(r);
    free(force);
    end_task(&t);
}

static void equals_a_dense_factorisation(void) {
    int32_t space;
    int k, broken, moments;
    for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
        for (k = 0; k < ALL_LAWS; ++k)
            for (broken = 0; broken <= 1; ++broken)
                for (moments = 0; moments <= 1; ++moments) {
                    scene s = small_scene(space, PERI_GEOMETRY_LINEAR, moments ? PERI_CORRECTION_MOMENT : PERI_CORRECTION_NONE);
                    char what[80];
                    (void)sprintf(what, "%s %s%s%s", space_name[space % 100], law_text(k), broken ? ", cut" : "",
                                  moments ? ", moments" : "");
                    holds_dense(held_body(&s, law_of(k), 0.3, 0, broken), space, what);
                    if (k < LAWS && (!moments || test_long)) {
                        (void)strcat(what, ", lattice");
                        holds_dense(held_body(&s, law_of(k), 0.2, 1, broken), space, what);
                    }
                }
}

/* ---- the stiffness ------------------------------------------------------------------------------------------------ */

/* All that a stiffness must be, at the present displacements. y: present places (linear: reference). */
static void check_stiffness(peri_body *b, const scene *s, double amplitude, const char *what) {
    int dim = dim_of(s->space), axis, d;
    int64_t n, i, k, points = peri_point_count(b);
    double *a, *u = random_field(points * dim, amplitude, 5), *x = random_field(points * dim, 1, 6), *y, *out, *f, *force;
    double most = 0, off = 0, skew = 0, row;
    put(b, PERI_FIELD_DISPLACEMENT, u);
    a = dense_stiffness(b, &n);
    out = (double *)calloc((size_t)n, sizeof *out);
    (void)MUST(b, peri_multiply_stiffness(b, x, out, n));
    for (i = 0; i < n; ++i) {
        double sum = 0;
        row = 0;
        for (k = 0; k < n; ++k) {
            sum += a[i * n + k] * x[k];
            row += fabs(a[i * n + k]);
            skew = fmax(skew, fabs(a[i * n + k] - a[k * n + i]));
        }
        off = fmax(off, fabs(sum - out[i]));
        most = fmax(most, row);
    }
    if (!(off <= 1e-13 * most) || !(skew <= 1e-14 * most)) {
        printf("    %s: product off by %.2g, skew %.2g of the row sum\n", what, off / most, skew / most);
        test_bad++;
    }
    memcpy(out, x, (size_t)n * sizeof *out); /* in place */
    (void)MUST(b, peri_multiply_stiffness(b, out, out, n));
    f = get(b, PERI_FIELD_FORCE_DENSITY);
    force = forces_of(b, f, s->space);
    y = get(b, s->geometry == PERI_GEOMETRY_LINEAR ? PERI_FIELD_POSITION : PERI_FIELD_CURRENT_POSITION);
    /* translations: nothing. turns W y: f(Q y) = Q f(y) gives K W y = -W f, 0 where the geometry is linear */
    for (axis = 0; axis < (dim == 3 ? 6 : 3); ++axis) {
        int p = dim == 3 ? axis % 3 : 0, q = dim == 3 ? (axis + 1) % 3 : 1;
        for (i = 0; i < points; ++i)
            for (d = 0; d < dim; ++d) {
                if (axis < dim) x[i * dim + d] = d == axis;
                else x[i * dim + d] = d == p ? -y[i * dim + q] : d == q ? y[i * dim + p] : 0;
            }
        (void)MUST(b, peri_multiply_stiffness(b, x, out, n));
        for (i = 0; i < points; ++i)
            for (d = 0; d < dim; ++d) {
                double want = 0;
                if (axis >= dim && s->geometry != PERI_GEOMETRY_LINEAR)
                    want = d == p ? force[i * dim + q] : d == q ? -force[i * dim + p] : 0;
                if (!(fabs(out[i * dim + d] - want) <= 1e-13 * most * largest(x, n))) {
                    if (test_bad++ < 3) printf("    %s: rigid motion %d gives %.3g, not %.3g\n", what, axis, out[i * dim + d], want);
                }
            }
    }
    free(a);
    free(u);
    free(x);
    free(y);
    free(f);
    free(force);
    free(out);
}

static void stiffness_of(int32_t space, int32_t geometry, int32_t correction) {
    int k, broken;
    for (k = 0; k < ALL_LAWS; ++k)
        for (broken = 0; broken <= 1; ++broken) {
            scene s = small_scene(space, geometry, correction);
            peri_body *b = small_body(&s, law_of(k), 0.2, -1, broken);
            char what[80];
            (void)sprintf(what, "%s %s %s correction %d%s", space_name[space % 100], law_text(k),
                          geometry == PERI_GEOMETRY_LINEAR ? "linear" : "nonlinear", (int)correction, broken ? ", cut" : "");
            check_stiffness(b, &s, 0.05 * H, what);
            peri_body_destroy(b);
            if (k == ALL_LAWS - 1 || (correction != PERI_CORRECTION_NONE && !test_long)) continue;
            b = lattice_body(&s, law_of(k), 0.3, broken);
            (void)strcat(what, ", lattice");
            check_stiffness(b, &s, 0.05 * H, what);
            peri_body_destroy(b);
        }
}
static void stiffness_is_its_product(void) {
    int32_t space, correction;
    for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
        for (correction = PERI_CORRECTION_NONE; correction < peri__end_correction; ++correction) {
            stiffness_of(space, PERI_GEOMETRY_LINEAR, correction);
            stiffness_of(space, PERI_GEOMETRY_NONLINEAR, correction);
        }
}

/* Cells that count in part, and bonds with a law of their own between two materials: the stiffness and its difference quotient. */
static peri_body *patchwork(const scene *s, int32_t quadrature) {
    const double lo[3] = {0, 0, 0}, middle[3] = {3 * H, 4 * H, 3 * H}, next[3] = {3 * H, 0, 0}, hi[3] = {6 * H, 4 * H, 3 * H};
    peri_body_desc d;
    peri_body *b = NULL;
    peri_material_desc m;
    int32_t first, other;
    peri_body_desc_init(&d);
    d.space = s->space;
    d.geometry = s->geometry;
    d.horizon = s->reach * H;
    d.quadrature = quadrature;
    d.threads = 1;
    if (s->space != PERI_SPACE_SOLID) d.thickness = THICK;
    (void)MUST(NULL, peri_body_create(&d, &b, NULL));
    first = add_law(b, PERI_LAW_BOND_BASED, 0, -1);
    peri_material_desc_init(&m, PERI_LAW_BOND_BASED);
    m.young = 2 * YOUNG;
    m.density = DENSITY;
    other = (int32_t)MUST(b, peri_add_material(b, &m));
    m.young = 0.1 * YOUNG;
    (void)MUST(b, peri_set_interface(b, first, other, &m));
    (void)MUST(b, peri_add_perturbed_box(b, first, lo, middle, H, 0.6, 4));
    (void)MUST(b, peri_add_box(b, other, next, hi, H));
    (void)MUST(b, peri_build(b));
    return b;
}
static void stiffness_of_a_patchwork(void) {
    int32_t space, geometry, quadrature;
    for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
        for (geometry = PERI_GEOMETRY_NONLINEAR; geometry < peri__end_geometry; ++geometry)
            for (quadrature = PERI_QUADRATURE_FULL; quadrature < peri__end_quadrature; ++quadrature) {
                scene s = scene_of(space, geometry, PERI_INFLUENCE_CONSTANT, PERI_CORRECTION_NONE, 2.2);
                char what[80];
                peri_body *b;
                if (quadrature == PERI_QUADRATURE_PARTIAL_CENTROID) continue;
                if (space == PERI_SPACE_SOLID && quadrature > PERI_QUADRATURE_PARTIAL) continue;
                b = patchwork(&s, quadrature);
                (void)sprintf(what, "%s patchwork, quadrature %d", space_name[space % 100], (int)quadrature);
                check_stiffness(b, &s, 0.05 * H, what);
                peri_body_destroy(b);
            }
}

/* What cannot be multiplied, assembled or solved says so: wrong counts, numbers that are not finite, bodies that are not built, the
   centroid rule, which is no derivative of an energy. */
static void what_has_no_stiffness(void) {
    scene s = scene_of(PERI_SPACE_PLANE_STRESS, PERI_GEOMETRY_LINEAR, PERI_INFLUENCE_CONSTANT, PERI_CORRECTION_NONE, 2);
    peri_body *b = scene_body(&s);
    peri_matrix *m = (peri_matrix *)1;
    peri_solve_desc st;
    double v[400] = {0};
    peri_solve_desc_init(&st);
    (void)add_law(b, PERI_LAW_LPS, 0.3, -1);
    CHECK(peri_solve(b, &st, NULL) == PERI_ERROR_ORDER && peri_matrix_create(b, &m) == PERI_ERROR_ORDER && m == NULL);
    CHECK(peri_multiply_stiffness(b, v, v, 0) == PERI_ERROR_ORDER);
    CHECK(peri_apply_pressure(b, PERI_ALL, 1, NULL, NULL) == PERI_ERROR_ORDER);
    peri_body_destroy(b);
    b = patchwork(&s, PERI_QUADRATURE_FULL);
    CHECK(peri_multiply_stiffness(b, v, v, 47) == PERI_ERROR_CAPACITY && peri_multiply_stiffness(b, v, v, 49) == PERI_ERROR_CAPACITY);
    CHECK(peri_multiply_stiffness(b, v, NULL, 48) == PERI_ERROR_ARGUMENT && peri_multiply_stiffness(b, v, v, 48) == PERI_OK);
    v[13] = NAN;
    CHECK(peri_multiply_stiffness(b, v, v, 48) == PERI_ERROR_RANGE);
    peri_body_destroy(b);
    b = patchwork(&s, PERI_QUADRATURE_PARTIAL_CENTROID);
    v[13] = 0;
    CHECK(peri_solve(b, &st, NULL) == PERI_ERROR_LAW && peri_matrix_create(b, &m) == PERI_ERROR_LAW);
    CHECK(peri_multiply_stiffness(b, v, v, 48) == PERI_ERROR_LAW);
    CHECK(peri_apply_pressure(b, PERI_ALL, 1, NULL, NULL) == PERI_ERROR_LAW);
    peri_body_destroy(b);
}

/* The central difference of the forces along a random direction: K exact, its error falls by 4 at each halving until rounding, which at
   steps of d is about 1e-15/d of the product. Where the geometry is linear there is no error at all. */
static void product_is_the_difference_of_forces(void) {
    int32_t space, geometry;
    int k, broken, turn;
    for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
        for (geometry = PERI_GEOMETRY_NONLINEAR; geometry < peri__end_geometry; ++geometry)
            for (k = 0; k < ALL_LAWS; ++k)
                for (broken = 0; broken <= 1; ++broken) {
                    scene s = small_scene(space, geometry, PERI_CORRECTION_NONE);
                    peri_body *b = small_body(&s, law_of(k), 0.2, -1, broken);
                    int64_t n = peri_point_count(b) * dim_of(space), i;
                    double *u = random_field(n, 0.03 * H, 5), *v = random_field(n, 1, 8), *w = (double *)calloc((size_t)n, sizeof *w);
                    double *kv = (double *)calloc((size_t)n, sizeof *w), error[3], d = 0.02 * H;
                    put(b, PERI_FIELD_DISPLACEMENT, u);
                    (void)MUST(b, peri_multiply_stiffness(b, v, kv, n));
                    for (turn = 0; turn < 3; ++turn, d *= 0.5) {
                        double *f[2], *force[2];
                        int side;
                        for (side = 0; side < 2; ++side) {
                            for (i = 0; i < n; ++i) w[i] = u[i] + (side ? d : -d) * v[i];
                            put(b, PERI_FIELD_DISPLACEMENT, w);
                            f[side] = get(b, PERI_FIELD_FORCE_DENSITY);
                            force[side] = forces_of(b, f[side], space);
                        }
                        for (i = 0, error[turn] = 0; i < n; ++i)
                            error[turn] = fmax(error[turn], fabs((force[0][i] - force[1][i]) / (2 * d) - kv[i]) / largest(kv, n));
                        for (side = 0; side < 2; ++side) {
                            free(f[side]);
                            free(force[side]);
                        }
                    }
                    if (geometry == PERI_GEOMETRY_LINEAR) CHECK(error[0] < 1e-12 && error[2] < 1e-11);
                    else if (!(error[0] > 1e-7 && error[0] / error[1] > 3.7 && error[0] / error[1] < 4.3 && error[1] / error[2] > 3.9
                               && error[1] / error[2] < 4.1)) {
                        printf("    %s %s%s: errors %.3g %.3g %.3g\n", space_name[space % 100], law_text(k), broken ? ", cut" : "",
                               error[0], error[1], error[2]);
                        test_bad++;
                    }
                    free(u);
                    free(v);
                    free(w);
                    free(kv);
                    peri_body_destroy(b);
                }
}

/* ---- Matrix Market ------------------------------------------------------------------------------------------------ */

typedef struct text {
    char   *at;
    int64_t length, room, refuse; /* refuse: the write that fails, from 1 */
} text;
static int32_t keep_text(void *user, const void *bytes, int64_t count) {
    text *t = (text *)user;
    if (t->refuse > 0 && --t->refuse == 0) return 1;
    if (t->length + count + 1 > t->room) {
        t->room = 2 * (t->length + count + 1);
        t->at = (char *)realloc(t->at, (size_t)t->room);
    }
    memcpy(t->at + t->length, bytes, (size_t)count);
    t->length += count;
    t->at[t->length] = 0;
    return 0;
}

/* The file holds the lower triangle, from 1, in 16 digits; the header is that of the format. */
static void matrix_market_reads_back(void) {
    int k;
    for (k = 0; k < ALL_LAWS; ++k) {
        scene s = small_scene(k % 2 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRAIN, PERI_GEOMETRY_NONLINEAR, PERI_CORRECTION_NONE);
        peri_body *b = small_body(&s, law_of(k), 0.3, -1, 1);
        text t = {NULL, 0, 0, 0};
        peri_matrix *m = NULL;
        int64_t n, count = 0, lower = 0;
        double *a, *u = random_field(peri_point_count(b) * dim_of(s.space), 0.05 * H, 5);
        long rows = 0, columns = 0, entries = 0;
        char *line;
        put(b, PERI_FIELD_DISPLACEMENT, u);
        a = dense_stiffness(b, &n);
        (void)MUST(b, peri_matrix_create(b, &m));
        CHECK(peri_export_matrix_to(m, keep_text, &t) == PERI_OK);
        line = strchr(t.at, '\n');
        CHECK(line && strncmp(t.at, "%%MatrixMarket matrix coordinate real symmetric\n", 48) == 0);
        CHECK(sscanf(line + 1, "%ld %ld %ld", &rows, &columns, &entries) == 3 && rows == n && columns == n);
        for (line = strchr(line + 1, '\n'); line && line[1]; line = strchr(line + 1, '\n'), ++count) {
            char *end;
            long row = strtol(line + 1, &end, 10), column = strtol(end, &end, 10);
            double value = strtod(end, &end);
            CHECK(*end == '\n' && row >= column && column >= 1 && row <= n);
            if (!(fabs(value - a[(row - 1) * n + column - 1]) <= 5e-15 * fabs(value))) test_bad++;
            if (value != 0) lower++;
        }
        CHECK(count == entries);
        for (n *= n, count = 0; n-- > 0;) count += a[n] != 0;
        CHECK(2 * lower - rows == count); /* all that is not 0 is in it, once; no diagonal entry is 0 */
        t.refuse = 5;
        CHECK(peri_export_matrix_to(m, keep_text, &t) == PERI_ERROR_WRITE);
        CHECK(peri_export_matrix_to(NULL, keep_text, &t) == PERI_ERROR_ARGUMENT);
        CHECK(peri_export_matrix_to(m, NULL, &t) == PERI_ERROR_ARGUMENT);
        peri_body_destroy(b); /* the matrix lives on */
        CHECK(peri_matrix_rows(m) == rows && peri_get_matrix(m, NULL, NULL, NULL) == PERI_OK);
        peri_matrix_destroy(m);
        peri_matrix_destroy(NULL);
        free(t.at);
        free(a);
        free(u);
    }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(equals_a_dense_factorisation);
    RUN(stiffness_is_its_product);
    RUN(stiffness_of_a_patchwork);
    RUN(what_has_no_stiffness);
    RUN(product_is_the_difference_of_forces);
    RUN(matrix_market_reads_back);
    return test_end("test_solvers");
}
