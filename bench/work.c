/* SPDX-License-Identifier: MIT */
/* work.c - what a bond asks of the machine, counted from the kernels, and the least time that the machine needs for it.

   Operations are those of the vector kernels (columns.inl, list.inl) for one live bond: what the law asks for in
   the form that is computed, without the additions to zero that start a sum, and without the turning of records in registers. Lanes of a
   column that hold no bond do no work here; in the kernel they take their time. So do the conversions of mixed precision. D is the
   dimension; entries are c + l D + q D^2.

   Bytes are those of arrays that a step must read or write, each array once per pass: neighbours come from the cache. */
#include "suite.h"

typedef struct count { int c, l, q; } count;

typedef struct pass {
    int32_t     law, list; /* of which law, on the list or on columns                                                         */
    count       add, compare, mul;
    int         root, div;
    count       wide; /* of `add`, in mixed precision those in double: differences of the state, and sums                        */
    const char *equation;
} pass;

static const pass passes[] = {
    /* y = xi + eta: D + D; 2 xi + eta: D; (2 xi + eta).eta and y.y: 2 (D - 1) | 2 D */
    { PERI_LAW_BOND_BASED, 0, { -2, 5, 0 }, { 0, 0, 0 }, { 0, 2, 0 }, 1, 0, { 0, 1, 0 }, "eta, y, along = (2 xi + eta).eta, |y|" },
    { PERI_LAW_BOND_BASED, 0, { 2, 1, 0 }, { 1, 0, 0 }, { 4, 1, 0 }, 0, 1, { 0, 1, 0 },
      "f += c w along/((|y| + |xi|) |xi| |y|) y; along > s0 |xi| (|y| + |xi|)" },
    { PERI_LAW_LPS, 0, { 0, 5, 0 }, { 0, 0, 0 }, { 1, 2, 0 }, 1, 1, { 1, 1, 0 }, "as above; theta += w |xi| along/(|y| + |xi|)" },
    { PERI_LAW_LPS, 0, { -2, 5, 0 }, { 0, 0, 0 }, { 0, 2, 0 }, 1, 0, { 0, 1, 0 }, "eta, y, along, |y| again" },
    { PERI_LAW_LPS, 0, { 5, 1, 0 }, { 1, 0, 0 }, { 6, 1, 0 }, 0, 1, { 0, 1, 0 },
      "f += w ((q_i + q_j) along + (p_i + p_j) |xi| (|y| + |xi|))/((|y| + |xi|) |y|) y; breaking" },
    { PERI_LAW_CORRESPONDENCE, 0, { 0, 1, 1 }, { 0, 0, 0 }, { 0, 1, 1 }, 0, 0, { 0, 1, 1 }, "sum w eta xi" },
    { PERI_LAW_CORRESPONDENCE, 0, { 0, 4, 2 }, { 1, 0, 0 }, { 0, 3, 1 }, 0, 0, { 0, 2, 0 },
      "f += w ((Q_i + Q_j) xi + (k_i + k_j) eta); (2 xi + eta).eta > s0 (2 + s0) |xi|^2" },
    /* on the list xi is made of two places, and |xi| of xi: D + D, and |xi|^2: D - 1 | D */
    { PERI_LAW_BOND_BASED, 1, { -3, 8, 0 }, { 0, 0, 0 }, { 0, 3, 0 }, 2, 0, { 0, 2, 0 }, "xi, eta, y, along, |xi|, |y|" },
    { PERI_LAW_BOND_BASED, 1, { 2, 1, 0 }, { 1, 0, 0 }, { 6, 1, 0 }, 0, 1, { 0, 1, 0 },
      "f += c w along |xi|/(|xi| (|y| + |xi|) |xi| |y|) y; breaking" },
    { PERI_LAW_LPS, 1, { -1, 8, 0 }, { 0, 0, 0 }, { 3, 3, 0 }, 1, 1, { 1, 2, 0 },
      "xi, eta, y, along, |xi| |y|; theta += w along |xi|^2/(|xi| |y| + |xi|^2)" },
    { PERI_LAW_LPS, 1, { -3, 8, 0 }, { 0, 0, 0 }, { 0, 3, 0 }, 1, 0, { 0, 2, 0 }, "xi, eta, y, along, |xi| |y| again" },
    { PERI_LAW_LPS, 1, { 5, 1, 0 }, { 1, 0, 0 }, { 10, 1, 0 }, 0, 1, { 0, 1, 0 },
      "f += |xi|^2 ((w q_i + w' q_j) along + (w p_i + w' p_j) R)/(R |xi| |y|) y; R = |xi| |y| + |xi|^2; breaking" },
    { PERI_LAW_CORRESPONDENCE, 1, { 0, 2, 1 }, { 0, 0, 0 }, { 0, 1, 1 }, 0, 0, { 0, 2, 1 }, "xi, then as on columns" },
    { PERI_LAW_CORRESPONDENCE, 1, { 0, 5, 2 }, { 1, 0, 0 }, { 0, 3, 1 }, 0, 0, { 0, 3, 0 }, "xi, then as on columns" },
};

static double of(count k, int32_t dim) { return k.c + k.l * dim + k.q * dim * dim; }

/* Bytes of a step per point, and to *set those of its arrays, each once. */
static double traffic(const bench_case *c, const bench_facts *f, double *set) {
    const int32_t dim = c->space == PERI_SPACE_SOLID ? 3 : 2, states = c->law != PERI_LAW_BOND_BASED;
    const int32_t tensors = c->law == PERI_LAW_CORRESPONDENCE;
    /* of mixed precision 8 and 4 */
    const double state = c->precision == PERI_PRECISION_SINGLE ? 4 : 8, real = c->precision == PERI_PRECISION_DOUBLE ? 8 : 4;
    const double family = (double)f->bonds / (double)f->points;
    const double packed = tensors ? dim * (dim + 1) / 2 : 0, planes = tensors ? dim * dim : 1;
    /* march.inl: the first kick reads and writes u, v, f; the second v, and reads f; a byte of material each. Force: u read, f read and
       written. The constants of a law read; its response written, and read again with a constant */
    double bytes = 12 * dim * state + 2;
    *set = 3 * dim * state + 1;
    if (states) bytes += (dim + 2 + packed + planes + planes + 1) * state;
    if (states) *set += (2 + packed + planes) * state;
    if (f->columns > 0) { /* masks and the places of columns, in each pass; stored columns are shared */
        const double masks = c->critical > 0 ? 2.0 * (double)f->columns / (double)f->points : 0.0;
        const double columns = masks + 1.0 + 8.0 * (double)f->kept / (double)f->points;
        bytes += (1 + states) * columns;
        *set += columns;
    } else { /* places read, records written and read; in each pass ids, weights and flags, and the place and length of a row */
        const double list = family * (4 + real) + 12 + (c->critical > 0 ? 4.0 * (double)((f->width + 31) / 32) : 0.0);
        bytes += 2 * dim * state + 2 * f->slots * real + (1 + states) * list;
        *set += dim * state + f->slots * real + list;
    }
    return bytes;
}

bench_work work_of(const bench_case *c, const bench_facts *f) {
    const int32_t dim = c->space == PERI_SPACE_SOLID ? 3 : 2, list = f->columns == 0;
    bench_work w;
    memset(&w, 0, sizeof w);
    for (size_t k = 0; k < sizeof passes / sizeof passes[0]; ++k) {
        const pass *p = &passes[k];
        if (p->law != c->law || p->list != list) continue;
        w.add += of(p->add, dim) + of(p->compare, dim);
        w.mul += of(p->mul, dim);
        w.root += p->root;
        w.div += p->div;
        w.wide += c->precision == PERI_PRECISION_MIXED ? of(p->wide, dim) : 0.0;
        w.flop -= of(p->compare, dim);
    }
    w.flop += w.add + w.mul + w.root + w.div;
    w.bytes = traffic(c, f, &w.set) * (double)f->points / (double)f->bonds;
    w.set *= (double)f->points;
    return w;
}

void work_print(void) {
    static const column columns[] = {
        { "law", "law", -15, 0 },          { "families", "families", -9, 0 }, { "add", "add", 5, 0 },
        { "mul", "mul", 5, 0 },            { "compare", "compare", 8, 0 },    { "root", "root", 5, 0 },
        { "div", "div", 5, 0 },            { "wide", "wide", 5, 0 },
        { " of", "equation", -1, 0 },
    };
    table t;
    printf("\nOperations per directed bond in 3D, as counted from the kernels; wide: additions that mixed precision makes in double");
    table_open(&t, "out/work.csv", columns, (int)(sizeof columns / sizeof columns[0]));
    for (size_t k = 0; k < sizeof passes / sizeof passes[0]; ++k) {
        const pass *p = &passes[k];
        put_text(&t, p->law == PERI_LAW_BOND_BASED ? "bond-based" : p->law == PERI_LAW_LPS ? "LPS" : "correspondence");
        put_text(&t, p->list ? "list" : "columns");
        put_number(&t, of(p->add, 3));
        put_number(&t, of(p->mul, 3));
        put_number(&t, of(p->compare, 3));
        put_number(&t, p->root);
        put_number(&t, p->div);
        put_number(&t, of(p->wide, 3));
        put_text(&t, p->equation);
    }
    table_close(&t);
}

double limit_of(const machine *m, const bench_case *c, const bench_work *w, const char **part) {
    const int single = c->precision != PERI_PRECISION_DOUBLE, rung_most = RUNGS - 1;
    const double pairs = w->root < w->div ? w->root : w->div, sum = w->add - w->wide + w->mul;
    double limit = 0.0, flow, time[3];
    static const char *const names[3] = { "bytes", "roots", "adds" };
    int rung = 0;
    while (rung < rung_most && w->set >= (double)(262144 << 2 * (rung + 1))) rung++;
    flow = m->copy[rung] > m->update[rung] ? m->copy[rung] : m->update[rung];
    time[0] = w->bytes / flow;
    time[1] = pairs / m->pair[single] + (w->root - pairs) / m->root[single] + (w->div - pairs) / m->div[single];
    time[2] = sum / m->both[single] + w->wide / m->both[0];
    const double adds = (w->add - w->wide) / m->add[single] + w->wide / m->add[0];
    if (adds > time[2]) time[2] = adds;
    if (w->mul / m->mul[single] > time[2]) time[2] = w->mul / m->mul[single];
    for (int k = 0; k < 3; ++k)
        if (time[k] > limit) {
            limit = time[k];
            *part = names[k];
        }
    return limit;
}
