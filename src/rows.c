/* rows.c - the family of a point, one row of Ibond, wherever it is stored. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

/* Row i: ids ascending, and what each bond weighs. Valid while `row` is. */
static void peri__read_row(const peri__model *m, int f32, int64_t i, peri__row *row) {
    const size_t at = (size_t)(i * m->width) * (f32 ? sizeof(float) : sizeof(double));
    row->count = m->count[i];
    row->ids = &m->ids[i * m->width];
    row->weight = (const char *)m->weight + at;
    row->bond = (const char *)m->bond + at;
    row->back = (const char *)m->back + at;
    row->part = m->part ? &m->part[i * m->width] : NULL;
}

/* Place of j in row i, or -1. */
static int64_t peri__find_bond(const peri__model *m, int64_t i, int64_t j) { return peri__find_listed(m, i, j); }
