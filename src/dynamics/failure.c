/* SPDX-License-Identifier: MIT */
/* failure.c - state-based bonds that meet their criterion are taken out.

   A bond of a state-based body is in the sums of both its ends, so when it breaks the constants of both change, and with them the force of
   every bond that they have. Only the points that lose a bond, and those next to them, are done again. As with bond-based bonds the
   step is closed with the old force (PERI_BREAK_AT_STEP_END), so that breaking takes just the difference of two elastic energies, at
   one displacement, out of the ledger. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

static void peri__mark(peri_body *b, int64_t i, uint8_t mark, int64_t *count) {
    if (!b->marked[i]) b->near_dying[(*count)++] = (int32_t)i;
    if (!b->marked[i] || mark == 1) b->marked[i] = mark;
}

/* The points that lose a bond (1) and their neighbours (2); both ends of a bond lose it if one finds it over its limit. */
static int64_t peri__mark_dying(peri_body *b) {
    const peri__model *m = b->model;
    int64_t count = 0;
    peri__row row;
    for (int64_t block = 0; block < m->blocks; ++block) {
        if (b->sums[block].n == 0) continue;
        for (int64_t n = block * PERI_BLOCK; n < peri__min((block + 1) * PERI_BLOCK, m->points); ++n) {
            const int64_t i = m->record_reals ? peri__nth(m, n) : n;
            peri__read_row(b, i, &row);
            for (int64_t k = 0; k < row.count; ++k) {
                if (!(b->dying[i * m->words + k / 32] >> (k % 32) & 1)) continue;
                int64_t j = row.ids[k], back = peri__find_bond(m, j, i);
                b->dying[j * m->words + back / 32] |= (uint32_t)1 << (back % 32);
                peri__mark(b, i, 1, &count);
                peri__mark(b, j, 1, &count);
            }
        }
    }
    for (int64_t n = 0, losing = count; n < losing; ++n) {
        int64_t i = b->near_dying[n];
        peri__read_row(b, i, &row);
        for (int64_t k = 0; k < row.count; ++k)
            if (peri__is_alive(b, i, k)) peri__mark(b, row.ids[k], 2, &count);
    }
    return count;
}

/* Energy of the points that lose a bond. */
static double peri__energy_at_stake(peri_body *b, peri__operands *operands, int64_t count) {
    peri__sums sums;
    memset(&sums, 0, sizeof sums);
    for (int64_t n = 0; n < count; ++n)
        if (b->marked[b->near_dying[n]] == 1) b->ops->energy(operands, b->near_dying[n], b->near_dying[n] + 1, &sums);
    return sums.a;
}

/* Breaks the bonds in `dying`. Serial: few points lose a bond in a step, and their order is fixed. */
static void peri__break_states(peri_body *b, const peri__operands *at) {
    const peri__model *m = b->model;
    peri__operands operands = *at;
    int64_t count = peri__mark_dying(b);
    operands.breaking = 0;
    operands.out = NULL;
    b->ops->add_point_forces(&operands, b->near_dying, count, -1);
    double energy = peri__energy_at_stake(b, &operands, count);
    for (int64_t n = 0; n < count; ++n) {
        int64_t i = b->near_dying[n];
        for (int64_t k = 0; k < m->count[i]; ++k) {
            uint32_t flag = (uint32_t)1 << (k % 32), *alive = &b->alive[i * m->words + k / 32];
            if (b->marked[i] != 1 || !(b->dying[i * m->words + k / 32] & flag)) continue;
            *alive &= ~flag;
            b->dying[i * m->words + k / 32] &= ~flag;
            b->now.broken++;
        }
        if (b->marked[i] == 1) {
            if (b->masks) peri__group_masks(m, i / PERI_GROUP, (uint32_t)1 << (i % PERI_GROUP), b->alive, b->masks);
            peri__row row;
            peri__read_row(b, i, &row);
            peri__set_constants(b, i, &row);
            peri__set_gather_row_sum(b, i, &row);
        }
    }
    for (int64_t n = 0; n < count; ++n)
        if (b->marked[b->near_dying[n]] == 1) b->ops->gather_rows(&operands, b->near_dying[n], b->near_dying[n] + 1, NULL);
    b->now.ledger.fracture += energy - peri__energy_at_stake(b, &operands, count);
    b->ops->add_point_forces(&operands, b->near_dying, count, 1);
    for (int64_t n = 0; n < count; ++n) {
        peri__set_row_sum(b, b->near_dying[n]);
        b->marked[b->near_dying[n]] = 0;
    }
    peri__find_largest_row_sum(b);
}
