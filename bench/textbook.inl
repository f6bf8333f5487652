/* SPDX-License-Identifier: MIT */
/* textbook.inl - the loops of textbook.c for one type of real: REAL, ROOT, NAME(x). `dim` is a constant where these are inlined. */

typedef struct NAME(arrays) {
    const int32_t *id, *count; /* [n][width] and [n]                                                                             */
    uint8_t       *live;       /* [n][width] bond carries force                                                                  */
    REAL          *x, *u, *f;  /* [n][dim]                                                                                       */
    REAL          *length;     /* [n][width] |xi|                                                                                */
    REAL          *weight;     /* [n][width] V_j, bond-based times c                                                             */
    REAL          *press, *spring, *dilate; /* LPS: [n] A theta/m, B/m and D/m                                                   */
    REAL           a, s0;
} NAME(arrays);

/* Current places, y = xi + eta and |y|: by components, which -O2 would not make of a loop. */
#define SPAN(i, j)                                                                                                     \
    const REAL dx = x[(j) * dim] + u[(j) * dim] - (x[(i) * dim] + u[(i) * dim]);                                       \
    const REAL dy = x[(j) * dim + 1] + u[(j) * dim + 1] - (x[(i) * dim + 1] + u[(i) * dim + 1]);                       \
    const REAL dz = dim == 2 ? 0 : x[(j) * dim + 2] + u[(j) * dim + 2] - (x[(i) * dim + 2] + u[(i) * dim + 2]);        \
    const REAL now = ROOT(dim == 2 ? dx * dx + dy * dy : dx * dx + dy * dy + dz * dz);
#define ADD(part)                                                                                                      \
    {                                                                                                                  \
        const REAL force = part;                                                                                       \
        fx += force * dx;                                                                                              \
        fy += force * dy;                                                                                              \
        if (dim == 3) fz += force * dz;                                                                                \
    }
#define STORE(i)                                                                                                       \
    t->f[(i) * dim] = fx;                                                                                              \
    t->f[(i) * dim + 1] = fy;                                                                                          \
    if (dim == 3) t->f[(i) * dim + 2] = fz;

/* Pointers are taken out of the record: what is written to bytes could change it, for all that the compiler knows. */
static inline void NAME(bonds)(const NAME(arrays) *t, int64_t n, int64_t width, const int dim) {
    const int32_t *id = t->id;
    const REAL *x = t->x, *u = t->u, *length = t->length, *weight = t->weight, s0 = t->s0;
    uint8_t *live = t->live;
    for (int64_t i = 0; i < n; ++i) {
        const int64_t end = i * width + t->count[i];
        REAL fx = 0, fy = 0, fz = 0;
        for (int64_t k = i * width; k < end; ++k) {
            const int64_t j = id[k];
            if (!live[k]) continue;
            SPAN(i, j)
            const REAL s = (now - length[k]) / length[k];
            if (s > s0) live[k] = 0;
            ADD(weight[k] * s / now)
        }
        STORE(i)
    }
}

static inline void NAME(states)(const NAME(arrays) *t, int64_t n, int64_t width, const int dim) {
    const int32_t *id = t->id;
    const REAL *x = t->x, *u = t->u, *length = t->length, *weight = t->weight, *press = t->press, *spring = t->spring, s0 = t->s0;
    uint8_t *live = t->live;
    for (int64_t i = 0; i < n; ++i) {
        const int64_t end = i * width + t->count[i];
        REAL sum = 0;
        for (int64_t k = i * width; k < end; ++k) {
            const int64_t j = id[k];
            if (!live[k]) continue;
            SPAN(i, j)
            sum += weight[k] * length[k] * (now - length[k]);
        }
        t->press[i] = t->a * t->dilate[i] * sum * spring[i];
    }
    for (int64_t i = 0; i < n; ++i) {
        const int64_t end = i * width + t->count[i];
        REAL fx = 0, fy = 0, fz = 0;
        for (int64_t k = i * width; k < end; ++k) {
            const int64_t j = id[k];
            if (!live[k]) continue;
            SPAN(i, j)
            const REAL e = now - length[k];
            if (e > s0 * length[k]) live[k] = 0;
            ADD(weight[k] * ((press[i] + press[j]) * length[k] + (spring[i] + spring[j]) * e) / now)
        }
        STORE(i)
    }
}

#undef SPAN
#undef ADD
#undef STORE

static void NAME(force)(const NAME(arrays) *t, int64_t n, int64_t width, int32_t dim, int32_t lps) {
    if (lps && dim == 2) NAME(states)(t, n, width, 2);
    else if (lps) NAME(states)(t, n, width, 3);
    else if (dim == 2) NAME(bonds)(t, n, width, 2);
    else NAME(bonds)(t, n, width, 3);
}

static REAL *NAME(fresh)(int64_t count) {
    REAL *a = (REAL *)calloc((size_t)count, sizeof *a);
    if (!a) exit(1);
    return a;
}

static void NAME(fill)(NAME(arrays) *t, const textbook_input *in, const int32_t *count, uint8_t *live) {
    const int64_t n = in->n, width = in->width;
    t->id = in->id;
    t->count = count;
    t->live = live;
    t->x = NAME(fresh)(n * in->dim);
    t->u = NAME(fresh)(n * in->dim);
    t->f = NAME(fresh)(n * in->dim);
    t->length = NAME(fresh)(n * width);
    t->weight = NAME(fresh)(n * width);
    t->press = NAME(fresh)(n);
    t->spring = NAME(fresh)(n);
    t->dilate = NAME(fresh)(n);
    t->a = (REAL)(in->a / in->b);
    t->s0 = (REAL)in->s0;
    for (int64_t k = 0; k < n * in->dim; ++k) {
        t->x[k] = (REAL)in->x[k];
        t->u[k] = (REAL)in->u[k];
    }
    for (int64_t i = 0; i < n; ++i) {
        double moment = 0.0;
        for (int64_t k = i * width; k < i * width + count[i]; ++k) {
            const int64_t j = in->id[k];
            double square = 0.0;
            for (int32_t d = 0; d < in->dim; ++d)
                square += (in->x[j * in->dim + d] - in->x[i * in->dim + d]) * (in->x[j * in->dim + d] - in->x[i * in->dim + d]);
            t->length[k] = (REAL)sqrt(square);
            t->weight[k] = (REAL)((in->lps ? 1.0 : in->c) * in->volume[j]);
            moment += square * in->volume[j];
        }
        t->spring[i] = (REAL)(in->b / moment);
        t->dilate[i] = (REAL)(in->dim / moment);
    }
}

static double NAME(error)(const NAME(arrays) *t, const double *force, int64_t size) {
    double most = 0.0, apart = 0.0;
    for (int64_t k = 0; k < size; ++k) {
        if (fabs(force[k]) > most) most = fabs(force[k]);
        if (!(fabs((double)t->f[k] - force[k]) <= apart)) apart = fabs((double)t->f[k] - force[k]);
    }
    return apart / most;
}

static void NAME(clear)(NAME(arrays) *t) {
    free(t->x);
    free(t->u);
    free(t->f);
    free(t->length);
    free(t->weight);
    free(t->press);
    free(t->spring);
    free(t->dilate);
}
