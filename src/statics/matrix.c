/* SPDX-License-Identifier: MIT */
/* matrix.c - the tangent stiffness assembled by rows (compressed), Matrix Market, and BiCGSTAB on it ([T] 3.2, 3.3).

   The energy of point o is a function of the displacements of o and its family, so the stiffness is a sum over points o of a small dense
   matrix. With the bonds' directions n, lengths L and y = L n, and d eta_j = du_j - du_o:
       springs         sum_j w [q n n + (p g + q e)/L (1 - n n)] on d eta_j
       theta           pressure_factor theta_factor l l,      l = sum_j w g n.d eta_j
       correspondence  dH : A : dH,  dH = sum_j d eta_j (w K^-1 xi_j),  and  k (sum_j w |d eta_j|^2 - tr(dH K dH^T)) */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

struct peri_matrix {
    peri__memory memory;
    int32_t  dim;
    int64_t  points, pairs; /* pairs: coupled points, both directions and own                                            */
    int64_t *start;         /* [points+1] first pair of a point                                                          */
    int32_t *column;        /* [pairs] the other point, ascending                                                        */
    double  *block;         /* [pairs][dim][dim], inner units                                                            */
    double   unit;
};

PERI_API void peri_matrix_destroy(peri_matrix *a) {
    if (!a) return;
    const peri__memory memory = a->memory;
    peri__delete(&memory, a->start, a->points + 1, sizeof *a->start);
    peri__delete(&memory, a->column, a->pairs, sizeof *a->column);
    peri__delete(&memory, a->block, a->pairs * a->dim * a->dim, sizeof *a->block);
    peri__delete(&memory, a, 1, sizeof *a);
}

/* The points that i couples with, ascending: its family, and where theta or F counts the families of that. Returns their number. */
static int64_t peri__coupled(const peri_body *b, int64_t i, int32_t *mark, int32_t *list) {
    const peri__model *m = b->model;
    int64_t count = 1, own;
    peri__row row;
    list[0] = (int32_t)i;
    mark[i] = (int32_t)i + 1;
    peri__read_row(b, i, &row);
    for (int64_t k = 0; k < row.count; ++k)
        if (peri__is_alive(b, i, k)) {
            mark[row.ids[k]] = (int32_t)i + 1;
            list[count++] = row.ids[k];
        }
    own = count;
    for (int64_t n = 1; n < own && m->gathers; ++n) {
        peri__read_row(b, list[n], &row);
        for (int64_t k = 0; k < row.count; ++k)
            if (mark[row.ids[k]] != (int32_t)i + 1 && peri__is_alive(b, list[n], k)) {
                mark[row.ids[k]] = (int32_t)i + 1;
                list[count++] = row.ids[k];
            }
    }
    peri__sort_row(list, count);
    return count;
}

/* dP for a change d of H at the deformation f of a correspondence point. */
static void peri__change_of_stress(const peri_body *b, int64_t i, const peri__deformation *f, double d[3][3], double out[3][3]) {
    peri__law room;
    const peri__law *law = peri__law_at(b, i, &room);
    double e[3][3], h[3][3];
    memcpy(h, f->h, sizeof h);
    peri__elastic_strain_of(b, i, f, e);
    peri__stress_change(law, b->dim, b->desc.geometry == PERI_GEOMETRY_LINEAR, h, e, d, out);
}

typedef struct peri__element { /* the stiffness of the energy of one point: of its live family and itself, ascending      */
    int64_t  count, self;
    int32_t *id;     /* [count]                                                                                          */
    double  *pull;   /* [count][dim]: w g n of theta, or w K^-1 xi of H; of the point itself minus their sum             */
    double  *spring; /* [count][dim][dim]; of the point itself their sum                                                 */
} peri__element;

/* Fills the element of point o; returns what multiplies pull x pull of theta, NaN where a law of bonds failed. tensor[a][d][c][e]: V
   dP_ad/dH_ce less the stabilisation. */
static double peri__fill_element(const peri_body *b, int64_t o, peri__element *e, double tensor[3][3][3][3], int *tensors) {
    const peri__model *m = b->model;
    const int dim = m->dim, linear = b->desc.geometry == PERI_GEOMETRY_LINEAR;
    const peri__law *law = &m->laws[m->material[o]];
    const double volume = m->volume[o];
    double stabilization = 0.0, pressure_factor = 0.0, theta_factor = 0.0, p = 0.0, self[3] = { 0.0 }, springs[9] = { 0.0 };
    peri__deformation f;
    peri__bunch bunch;
    peri__row row;
    peri__read_row(b, o, &row);
    bunch.point = -1;
    bunch.failed = bunch.asked = 0;
    e->count = 0;
    e->self = -1;
    *tensors = 0;
    if (!law->pairwise) {
        pressure_factor = peri__get_constant(b, o, PERI__PRESSURE_FACTOR);
        theta_factor = peri__get_constant(b, o, PERI__THETA_FACTOR);
        if (pressure_factor != 0.0) p = pressure_factor * peri__dilatation(b, o, &row, peri__eigenstrain_at(b, o));
    }
    if (law->gather & PERI__GRADIENT) {
        stabilization = peri__get_constant(b, o, PERI__STABILIZATION);
        *tensors = peri__get_constant(b, o, PERI__SHAPE_INVERSE) != 0.0;
        peri__deform(b, o, &row, &f);
    }
    for (int64_t k = peri__next_bond(&row, -1); k >= 0; k = peri__next_bond(&row, row.ids[k])) {
        if (!peri__is_alive(b, o, k)) continue;
        if (row.ids[k] > o && e->self < 0) e->self = e->count++;
        double xi[3], eta[3], n[3], length = 0.0, w = peri__weight_of(m, o, row.weight, k), bond = peri__get_real(row.bond, b->b32, k);
        double gauge = peri__law_gauge(law, bond), *pull = &e->pull[e->count * dim], *spring = &e->spring[e->count * dim * dim];
        double extension, slope;
        peri__ask_bond(b, o, &row, k, &bunch, &extension, &slope);
        extension *= bond;
        peri__pull_of(b, o, row.ids[k], xi, eta);
        for (int d = 0; d < dim; ++d) length += peri__square(n[d] = xi[d] + (linear ? 0.0 : eta[d]));
        length = sqrt(length) + DBL_MIN;
        for (int d = 0; d < dim; ++d) n[d] /= length;
        const double q = peri__spring(b, o, row.ids[k], bond), along = volume * w * q * slope;
        const double across = linear ? 0.0 : volume * w * (p * gauge + q * extension) / length;
        for (int a = 0; a < dim; ++a) {
            pull[a] = w * gauge * n[a];
            for (int c = 0; c < dim; ++c)
                spring[a * dim + c] = (along - across) * n[a] * n[c] + (a == c ? across + volume * w * stabilization : 0.0);
        }
        if (*tensors) {
            (void)peri__by_inverse(b, o, xi, pull);
            for (int a = 0; a < dim; ++a) pull[a] *= w;
        }
        for (int a = 0; a < dim; ++a) self[a] -= pull[a];
        for (int a = 0; a < dim * dim; ++a) springs[a] += spring[a];
        e->id[e->count++] = row.ids[k];
    }
    if (bunch.failed) return (double)NAN;
    if (e->self < 0) e->self = e->count++;
    e->id[e->self] = (int32_t)o;
    memcpy(&e->pull[e->self * dim], self, (size_t)dim * sizeof *self);
    memcpy(&e->spring[e->self * dim * dim], springs, (size_t)(dim * dim) * sizeof *springs);
    for (int c = 0; *tensors && c < dim; ++c)
        for (int q = 0; q < dim; ++q) {
            double unit[3][3] = { { 0.0 } }, out[3][3];
            unit[c][q] = 1.0;
            peri__change_of_stress(b, o, &f, unit, out);
            for (int a = 0; a < dim; ++a)
                for (int d = 0; d < dim; ++d) tensor[a][d][c][q] = volume * out[a][d];
        }
    return *tensors || law->pairwise ? 0.0 : volume * pressure_factor * theta_factor;
}

/* K of the shape tensor of point o: what the stabilisation takes back. */
static void peri__shape_of(const peri_body *b, int64_t o, double shape[3][3]) {
    peri__row row;
    peri__read_row(b, o, &row);
    peri__moments sum = peri__family_moments(b, o, &row, 1);
    for (int a = 0; a < b->dim; ++a)
        for (int c = 0; c < b->dim; ++c) shape[a][c] = sum.shape[peri__packed(b->dim, a, c)];
}

static void peri__add_element(peri_matrix *a, const peri_body *b, int64_t o, const peri__element *e, double theta,
                              double tensor[3][3][3][3], int tensors) {
    const int dim = a->dim;
    const double stabilization = tensors ? b->model->volume[o] * peri__get_constant(b, o, PERI__STABILIZATION) : 0.0;
    double shape[3][3] = { { 0.0 } };
    if (stabilization != 0.0) peri__shape_of(b, o, shape);
    for (int64_t p = 0; p < e->count; ++p) {
        int64_t at = a->start[e->id[p]];
        for (int64_t q = 0; q < e->count; ++q) {
            const double *left = &e->pull[p * dim], *right = &e->pull[q * dim];
            const double *spring = p == q || q == e->self ? &e->spring[p * dim * dim] : p == e->self ? &e->spring[q * dim * dim] : NULL;
            if (!spring && theta == 0.0 && !tensors) continue;
            while (a->column[at] != e->id[q]) ++at;
            for (int r = 0; r < dim; ++r)
                for (int c = 0; c < dim; ++c) {
                    double sum = theta * left[r] * right[c];
                    for (int d = 0; tensors && d < dim; ++d)
                        for (int s = 0; s < dim; ++s) {
                            sum += left[d] * tensor[r][d][c][s] * right[s];
                            if (r == c) sum -= stabilization * left[d] * shape[d][s] * right[s];
                        }
                    if (spring) sum += p == q ? spring[r * dim + c] : -spring[r * dim + c];
                    a->block[(at * dim + r) * dim + c] += sum;
                }
        }
    }
}

/* Which points couple: start and column. */
static int32_t peri__couple(peri_body *b, peri_matrix *a, int32_t *mark, int32_t *list) {
    for (int64_t i = 0; i < a->points; ++i) a->start[i + 1] = a->start[i] + peri__coupled(b, i, mark, list);
    a->pairs = a->start[a->points];
    if (a->pairs > INT32_MAX) return peri__fail(b, PERI_ERROR_TOO_LARGE, "matrix", -1, (double)a->pairs);
    a->column = (int32_t *)peri__new(&a->memory, a->pairs, sizeof *a->column);
    a->block = (double *)peri__new(&a->memory, a->pairs * a->dim * a->dim, sizeof *a->block);
    if (!a->column || !a->block) return peri__fail(b, PERI_ERROR_MEMORY, "matrix", -1, 0.0);
    memset(mark, 0, (size_t)a->points * sizeof *mark);
    for (int64_t i = 0; i < a->points; ++i) {
        int64_t count = peri__coupled(b, i, mark, list);
        memcpy(&a->column[a->start[i]], list, (size_t)count * sizeof *list);
    }
    return PERI_OK;
}

/* *matrix of `memory`: b->memory, or b->scratch where a call assembles it for itself. */
static int32_t peri__assemble(peri_body *b, const peri__memory *memory, peri_matrix **matrix) {
    const peri__model *m = b->model;
    peri__element e;
    peri_matrix *a = (peri_matrix *)peri__new(memory, 1, sizeof *a);
    int32_t *mark = (int32_t *)peri__new(&b->memory, m->points, sizeof *mark), status = PERI_ERROR_MEMORY;
    int32_t *list = (int32_t *)peri__new(&b->memory, m->points, sizeof *list);
    const int64_t room = m->width + 1;
    e.id = (int32_t *)peri__new(&b->memory, room, sizeof *e.id);
    e.pull = (double *)peri__new(&b->memory, room * m->dim, sizeof *e.pull);
    e.spring = (double *)peri__new(&b->memory, room * m->dim * m->dim, sizeof *e.spring);
    if (a) {
        a->memory = *memory;
        a->dim = m->dim;
        a->points = m->points;
        a->unit = m->energy / peri__square(m->length);
        a->start = (int64_t *)peri__new(memory, a->points + 1, sizeof *a->start);
    }
    (void)peri__ensure(b, PERI__STALE_CONSTANTS);
    if (a && a->start && mark && list && e.id && e.pull && e.spring) status = peri__couple(b, a, mark, list);
    else status = peri__fail(b, PERI_ERROR_MEMORY, "matrix", -1, 0.0);
    for (int64_t o = 0; status == PERI_OK && o < m->points; ++o) {
        double tensor[3][3][3][3];
        int tensors;
        double theta = peri__fill_element(b, o, &e, tensor, &tensors);
        if (peri__is_nan(theta)) status = peri__fail(b, PERI_ERROR_CALLBACK, "peri_bond_law_fn", o, 0.0);
        else peri__add_element(a, b, o, &e, theta, tensor, tensors);
    }
    peri__delete(&b->memory, mark, m->points, sizeof *mark);
    peri__delete(&b->memory, list, m->points, sizeof *list);
    peri__delete(&b->memory, e.id, room, sizeof *e.id);
    peri__delete(&b->memory, e.pull, room * m->dim, sizeof *e.pull);
    peri__delete(&b->memory, e.spring, room * m->dim * m->dim, sizeof *e.spring);
    if (status == PERI_OK) *matrix = a;
    else peri_matrix_destroy(a);
    return status;
}

PERI_API int32_t peri_matrix_create(peri_body *b, peri_matrix **matrix) {
    if (matrix) *matrix = NULL;
    PERI_NEED_BUILT(b);
    PERI_NEED_WHOLE(b, "peri_matrix_create");
    PERI_NEED(b, matrix, "matrix");
    if (b->model->centroid) return peri__fail(b, PERI_ERROR_LAW, "quadrature", -1, b->desc.quadrature);
    if (b->model->inelastic) return peri__fail(b, PERI_ERROR_LAW, "peri_matrix_create", -1, 0.0);
    return peri__assemble(b, &b->memory, matrix);
}

PERI_API int64_t peri_matrix_rows(const peri_matrix *a) { return a ? a->points * a->dim : PERI_ERROR_ARGUMENT; }

PERI_API int64_t peri_matrix_entries(const peri_matrix *a) { return a ? a->pairs * a->dim * a->dim : PERI_ERROR_ARGUMENT; }

PERI_API int32_t peri_get_matrix(const peri_matrix *a, int64_t *start, int32_t *column, double *value) {
    int64_t at = 0;
    if (!a) return PERI_ERROR_ARGUMENT;
    for (int64_t row = 0; row < a->points * a->dim; ++row) {
        if (start) start[row] = at;
        for (int64_t k = a->start[row / a->dim]; k < a->start[row / a->dim + 1]; ++k)
            for (int32_t d = 0; d < a->dim; ++d, ++at) {
                if (column) column[at] = a->column[k] * a->dim + d;
                if (value) value[at] = a->unit * a->block[(k * a->dim + row % a->dim) * a->dim + d];
            }
    }
    if (start) start[a->points * a->dim] = at;
    return PERI_OK;
}

PERI_API int32_t peri_export_matrix_to(const peri_matrix *a, peri_write_fn write, void *user) {
    char line[160], *end;
    const int64_t rows = peri_matrix_rows(a);
    static const char head[] = "%%MatrixMarket matrix coordinate real symmetric\n";
    if (!a || !write) return PERI_ERROR_ARGUMENT;
    end = peri__put_text(peri__put_integer(peri__put_text(peri__put_integer(line, rows), " "), rows), " ");
    int64_t lower = (peri_matrix_entries(a) - rows) / 2 + rows;
    end = peri__put_text(peri__put_integer(end, lower), "\n");
    if (write(user, head, (int64_t)sizeof head - 1) || write(user, line, end - line)) return PERI_ERROR_WRITE;
    for (int64_t row = 0; row < rows; ++row)
        for (int64_t k = a->start[row / a->dim]; k < a->start[row / a->dim + 1]; ++k)
            for (int32_t d = 0; d < a->dim; ++d) {
                int64_t column = (int64_t)a->column[k] * a->dim + d;
                if (column > row) continue;
                end = peri__put_text(peri__put_integer(peri__put_text(peri__put_integer(line, row + 1), " "), column + 1), " ");
                end = peri__put_text(peri__put_double(end, a->unit * a->block[(k * a->dim + row % a->dim) * a->dim + d]), "\n");
                if (write(user, line, end - line)) return PERI_ERROR_WRITE;
            }
    return PERI_OK;
}

/* ---- BiCGSTAB ----------------------------------------------------------------------------------------------------- */

/* out = A in. */
static void peri__multiply_matrix(const peri_matrix *a, const double *in, double *out) {
    for (int64_t i = 0; i < a->points; ++i)
        for (int32_t r = 0; r < a->dim; ++r) {
            double row = 0.0;
            for (int64_t k = a->start[i]; k < a->start[i + 1]; ++k)
                for (int32_t c = 0; c < a->dim; ++c) row += a->block[(k * a->dim + r) * a->dim + c] * in[a->column[k] * a->dim + c];
            out[i * a->dim + r] = row;
        }
}

/* x.y over free dofs: those whose `scale` is not 0. */
static double peri__free_dot(const double *scale, const double *x, const double *y, int64_t n) {
    double sum = 0.0;
    for (int64_t k = 0; k < n; ++k) sum += scale[k] != 0.0 ? x[k] * y[k] : 0.0;
    return sum;
}

/* BiCGSTAB with the diagonal as preconditioner (van der Vorst 1992). work: [9][n]: [0] is the right-hand side and becomes what is left of
   it, on constrained dofs minus the reaction; [1] the solution, [8] the best one so far: the residual may grow without end. */
static int32_t peri__bicgstab(peri__solver *s, const peri_matrix *a, double *work, int64_t n, double reach, double loads) {
    double *r = work, *x = work + n, *shadow = work + 2 * n, *p = work + 3 * n, *v = work + 4 * n, *t = work + 5 * n, *y = work + 6 * n;
    double *scale = work + 7 * n, *best = work + 8 * n, least = HUGE_VAL, rho = 1.0, alpha = 1.0, omega = 1.0;
    for (int64_t i = 0; i < a->points; ++i)
        for (int64_t k = a->start[i]; k < a->start[i + 1]; ++k)
            for (int32_t d = 0; a->column[k] == i && d < a->dim; ++d) {
                double diagonal = a->block[(k * a->dim + d) * a->dim + d];
                scale[i * a->dim + d] = diagonal > 0.0 && !(s->constrained[i] >> d & 1) ? 1.0 / diagonal : 0.0;
            }
    memcpy(shadow, r, (size_t)n * sizeof *r);
    for (;;) {
        peri__sums sums = { peri__free_dot(scale, r, r, n), 0.0, 0, -1 };
        for (int64_t k = 0; k < n; ++k) sums.b += scale[k] == 0.0 ? r[k] * r[k] : 0.0;
        double residual = peri__measure(s, sums, loads), next = peri__free_dot(scale, shadow, r, n);
        if (residual <= reach * s->scale || peri__is_nothing(s, residual, loads)) return PERI_OK;
        if (residual < least) {
            least = residual;
            memcpy(best, x, (size_t)n * sizeof *x);
        }
        if (s->left <= 0 || !(residual < HUGE_VAL)) break;
        double beta = omega != 0.0 ? next / rho * alpha / omega : 0.0;
        if (next == 0.0 || beta == 0.0) { /* broken down: again from here */
            memcpy(shadow, r, (size_t)n * sizeof *r);
            next = peri__free_dot(scale, r, r, n);
            beta = 0.0;
        }
        rho = next;
        for (int64_t k = 0; k < n; ++k) {
            p[k] = r[k] + beta * (p[k] - omega * v[k]);
            y[k] = scale[k] * p[k];
        }
        peri__multiply_matrix(a, y, v);
        alpha = rho / peri__free_dot(scale, shadow, v, n);
        if (!peri__finite(alpha)) break; /* broken down */
        for (int64_t k = 0; k < n; ++k) {
            x[k] += alpha * y[k];
            r[k] -= alpha * v[k];
            y[k] = scale[k] * r[k];
        }
        peri__multiply_matrix(a, y, t);
        double norm = peri__free_dot(scale, t, t, n);
        omega = norm > 0.0 ? peri__free_dot(scale, t, r, n) / norm : 0.0;
        for (int64_t k = 0; k < n; ++k) {
            x[k] += omega * y[k];
            r[k] -= omega * t[k];
        }
        int32_t status = peri__count_iteration(s, residual / (s->scale > 0.0 ? s->scale : residual));
        if (status != PERI_OK) return status;
    }
    memcpy(x, best, (size_t)n * sizeof *x);
    return PERI_ERROR_CONVERGENCE;
}

/* Adds the springs of obstacles, V k n n. */
static void peri__add_contact(peri_matrix *a, const peri__solver *s) {
    const int dim = a->dim;
    for (int64_t k = 0; k < s->contact_count; ++k) {
        const peri__hold *c = &s->contacts[k];
        int64_t at = a->start[c->point];
        if (!c->active) continue;
        while (a->column[at] != c->point) ++at;
        for (int r = 0; r < dim; ++r)
            for (int q = 0; q < dim; ++q)
                a->block[(at * dim + r) * dim + q] += s->body->model->volume[c->point] * c->stiffness * c->normal[r] * c->normal[q];
    }
}

/* As peri__conjugate, by BiCGSTAB on the assembled tangent. */
static int32_t peri__solve_assembled(peri__solver *s, double reach, double loads) {
    peri_body *b = s->body;
    const peri__model *m = b->model;
    const int64_t n = m->points * m->dim;
    peri_matrix *a = NULL;
    int32_t status = peri__assemble(b, &b->scratch, &a);
    if (status < 0) return status;
    peri__add_contact(a, s);
    double *work = (double *)peri__new(&b->scratch, 9 * n, sizeof *work);
    int64_t bytes = s->bytes + 9 * n * (int64_t)sizeof *work + a->pairs * (m->dim * m->dim * 8 + 4);
    if (bytes > s->report.bytes) s->report.bytes = bytes;
    if (work) {
        for (int64_t k = 0; k < n; ++k)
            work[k] = peri__get_real(s->k.r, b->f32, k % m->dim * m->stride + k / m->dim);
        status = peri__bicgstab(s, a, work, n, reach, loads);
        s->slope = 0.0;
        for (int64_t k = 0; k < n; ++k) s->slope += work[n + k] * peri__get_real(s->k.r, b->f32, k % m->dim * m->stride + k / m->dim);
        for (int64_t k = 0; k < n; ++k) {
            int64_t at = k % m->dim * m->stride + k / m->dim;
            peri__put_real(s->k.d, b->f32, at, peri__get_real(s->k.d, b->f32, at) + work[n + k]);
        }
    } else
        status = peri__fail(b, PERI_ERROR_MEMORY, "matrix", -1, 0.0);
    peri__balance(s, s->k.d, 0);
    peri__delete(&b->scratch, work, 9 * n, sizeof *work);
    peri_matrix_destroy(a);
    return status;
}
