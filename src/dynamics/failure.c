/* SPDX-License-Identifier: MIT */
/* failure.c - bonds that meet their criterion are taken out; those of pairwise bodies by the force pass itself.

   A bond of a state-based body is in the sums of both its ends, so when it breaks the constants of both change, and with them the
   force of every bond that they have. Only the points that lose a bond, and those next to them, are done again.
   Under PERI_BREAK_WITHIN_STEP the difference D of the force before and after acts until the moment t of the break, a part of the
   step: what that leaves after the half kick that opened the step goes to `closing` (see PERI_FN(part)). Breaking takes the difference
   of two elastic energies as it is at that moment: that at the end of the step and what D, which has grown from met D, has done from t
   on, sum V D.v (1 - t) dt (1 + met)/2, below 0. The bonds of a step are taken by the quarter in which they break; those of a quarter
   share its means. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_QUARTERS 4
#define PERI_PART_QUARTERS 16 /* of parts, each of which goes by its middle: part.c                                      */

typedef struct peri__deaths { /* the bonds in `dying` that break up to the end of a quarter                              */
    peri_body            *body;
    const peri__operands *operands;
    int                   quarter, quarters;
    int64_t               bonds, count;  /* directed; points that lose one, then their neighbours too                    */
    double                late, share;   /* sums over the bonds: (1 - t) (1 + met)/2, share                              */
} peri__deaths;

static void peri__mark(peri_body *b, int64_t i, uint8_t mark, int64_t *count) {
    if (b->marked[i]) return;
    b->near_dying[(*count)++] = (int32_t)i;
    b->marked[i] = mark;
}

static int peri__is_dying(const peri_body *b, int64_t i) {
    uint32_t some = 0;
    for (int32_t word = 0; word < b->model->words; ++word) some |= b->dying[i * b->model->words + word];
    return some != 0;
}

/* Is bond k of row i in the quarter? As its lower end sees it: with centroids the ends differ. Of parts a deep ghost keeps nothing of how
   long its bonds have been over their limit. */
static int peri__parts(const peri__deaths *s, int64_t i, const peri__row *row, int64_t k, peri__parting *parting) {
    const int64_t j = row->ids[k];
    if (!(s->body->dying[i * s->body->model->words + k / 32] >> (k % 32) & 1)) return 0;
    if (i < j || (s->body->model->part && s->body->model->part->depth[j] > 1)) *parting = s->body->ops->part(s->operands, i, row, k);
    else {
        peri__row other;
        peri__read_row(s->body, j, &other);
        *parting = s->body->ops->part(s->operands, j, &other, peri__find_bond(s->body->model, j, i));
    }
    return s->quarter == s->quarters - 1 || parting->moment * s->quarters < s->quarter + 1;
}

/* The points that lose a bond (1) and their neighbours (2); both ends of a bond lose it if one finds it over its limit. */
static void peri__mark_dying(peri__deaths *s) {
    peri_body *b = s->body;
    const peri__model *m = b->model;
    peri__row row;
    for (int64_t block = 0; block < m->blocks; ++block) {
        if (b->sums[block].n == 0) continue;
        for (int64_t n = block * PERI_BLOCK; n < peri__min((block + 1) * PERI_BLOCK, m->points); ++n) {
            const int64_t i = m->record_reals ? peri__nth(m, n) : n;
            if (!peri__is_dying(b, i)) continue;
            peri__read_row(b, i, &row);
            for (int64_t k = 0; k < row.count; ++k) {
                peri__parting parting;
                if (!peri__parts(s, i, &row, k, &parting)) continue;
                const int64_t j = row.ids[k], back = peri__find_bond(m, j, i);
                b->dying[j * m->words + back / 32] |= (uint32_t)1 << (back % 32);
                s->bonds++;
                s->late += (1.0 - parting.moment) * 0.5 * (1.0 + parting.met);
                s->share += parting.share;
                peri__mark(b, i, 1, &s->count);
                peri__mark(b, j, 1, &s->count);
            }
        }
    }
    for (int64_t n = 0, losing = s->count; n < losing; ++n) {
        int64_t i = b->near_dying[n];
        peri__read_row(b, i, &row);
        for (int64_t k = 0; k < row.count; ++k)
            if (peri__is_alive(b, i, k)) peri__mark(b, row.ids[k], 2, &s->count);
    }
}

/* Takes the bonds of point i that part out, and makes its constants anew. */
static void peri__part_point(peri__deaths *s, int64_t i) {
    peri_body *b = s->body;
    const peri__model *m = b->model;
    peri__row row;
    peri__read_row(b, i, &row);
    for (int64_t k = 0; k < row.count; ++k) {
        const uint32_t flag = (uint32_t)1 << (k % 32);
        peri__parting parting;
        if (!peri__parts(s, i, &row, k, &parting)) continue;
        b->alive[i * m->words + k / 32] &= ~flag;
        b->now.broken += !peri__is_ghost(m, i);
    }
    if (b->masks) peri__group_masks(m, i / PERI_GROUP, (uint32_t)1 << (i % PERI_GROUP), b->alive, b->masks);
    peri__set_constants(b, i, &row);
    peri__set_gather_row_sum(b, i, &row);
}

/* Energy of the points that lose a bond. */
static double peri__energy_at_stake(const peri__deaths *s) {
    const peri_body *b = s->body;
    peri__sums sums;
    memset(&sums, 0, sizeof sums);
    for (int64_t n = 0; n < s->count; ++n)
        if (b->marked[b->near_dying[n]] == 1) b->ops->energy((void *)s->operands, b->near_dying[n], b->near_dying[n] + 1, &sums);
    return sums.a;
}

/* sum V f.v of the points whose force changes. */
static double peri__power_at_stake(const peri__deaths *s) {
    const peri_body *b = s->body;
    const peri__model *m = b->model;
    double power = 0.0;
    for (int64_t n = 0; n < s->count; ++n)
        for (int32_t d = 0; d < m->dim && !peri__is_ghost(m, b->near_dying[n]); ++d) {
            const int64_t i = b->near_dying[n], at = d * m->stride + i;
            power += m->volume[i] * peri__get_real(b->f, b->f32, at) * peri__get_real(b->v, b->f32, at);
        }
    return power;
}

/* Serial: few points lose a bond in a step, and their order is fixed. */
static void peri__break_quarter(peri__deaths *s) {
    peri_body *b = s->body;
    const peri__operands *o = s->operands;
    peri__mark_dying(s);
    if (s->count == 0) return;
    const double middle = (s->quarter + 0.5) / s->quarters;
    const double late = !b->model->part ? s->late / (double)s->bonds : o->closing ? 1.0 - middle : 0.0;
    const double time = 0.5 * o->step * (b->model->part ? 2.0 * middle - 1.0 : s->share / (double)s->bonds);
    double power = peri__power_at_stake(s), energy = 0.0;
    b->ops->add_point_forces(o, b->near_dying, s->count, -1, time);
    energy = peri__energy_at_stake(s);
    for (int64_t n = 0; n < s->count; ++n)
        if (b->marked[b->near_dying[n]] == 1) peri__part_point(s, b->near_dying[n]);
    for (int64_t n = 0; n < s->count; ++n) {
        const int64_t i = b->near_dying[n];
        for (int32_t word = 0; b->marked[i] == 1 && word < b->model->words; ++word)
            b->dying[i * b->model->words + word] &= b->alive[i * b->model->words + word];
        if (b->marked[i] == 1) b->ops->gather_rows((void *)o, i, i + 1, NULL);
    }
    energy -= peri__energy_at_stake(s);
    b->ops->add_point_forces(o, b->near_dying, s->count, 1, time);
    power -= peri__power_at_stake(s);
    b->now.ledger.fracture += energy + late * o->step * power;
    for (int64_t n = 0; n < s->count; ++n) {
        peri__set_row_sum(b, b->near_dying[n]);
        b->marked[b->near_dying[n]] = 0;
    }
}

/* Breaks the bonds in `dying`. */
static void peri__break_states(peri_body *b, const peri__operands *at) {
    peri__operands operands = *at;
    operands.breaking = 0;
    operands.out = NULL;
    const int quarters = b->model->part ? PERI_PART_QUARTERS : PERI_QUARTERS;
    for (int quarter = 0; quarter < quarters; ++quarter) {
        peri__deaths deaths = { b, &operands, quarter, quarters, 0, 0, 0.0, 0.0 };
        peri__break_quarter(&deaths);
    }
    peri__find_largest_row_sum(b);
}

/* ---- inelastic bodies ---------------------------------------------------------------------------------------------

   What bonds that flow give is in none of the above. Bonds break where the step ends, in one; then the force is summed again. */

/* Keeps f, that of loads alone as yet, where the impulses of others go. */
static void peri__keep_force(peri_body *b, peri__operands *operands) {
    memcpy(b->closing, b->f, peri__vector_bytes(b));
    operands->closing = NULL;
}

/* Takes out the bonds in `dying`, at both ends, and brings constants up to date. */
static void peri__part_all(peri_body *b) {
    const peri__model *m = b->model;
    peri__row row;
    for (int64_t i = 0; i < m->points; ++i) {
        if (!peri__is_dying(b, i)) continue;
        peri__read_row(b, i, &row);
        for (int64_t k = 0; k < row.count; ++k) {
            const int64_t j = row.ids[k], back = peri__find_bond(m, j, i);
            if (!(b->dying[i * m->words + k / 32] >> (k % 32) & 1)) continue;
            b->now.broken += peri__is_alive(b, i, k) + peri__is_alive(b, j, back);
            peri__take_out(b, i, k, j, back);
        }
    }
    memset(b->dying, 0, (size_t)(m->points * m->words) * sizeof *b->dying); /* peri_reset may mend them */
    b->now.stale |= PERI__STALE_MASKS | PERI__STALE_CONSTANTS;
    (void)peri__ensure(b, PERI__STALE_MASKS | PERI__STALE_CONSTANTS);
}

/* Breaks the `count` (directed) bonds in `dying`, and forgets the force that was kept. */
static void peri__break_inelastic(peri_body *b, const peri__operands *at, int64_t count) {
    peri__operands operands = *at;
    if (count > 0) {
        const double energy = peri__elastic_energy(b, NULL);
        peri__part_all(b);
        b->now.ledger.fracture += energy - peri__elastic_energy(b, NULL);
        memcpy(b->f, b->closing, peri__vector_bytes(b));
        operands.breaking = 0;
        operands.step = 0.0;
        peri__bond_forces(b, &operands);
    }
    memset(b->closing, 0, peri__vector_bytes(b));
}

static void peri__close_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri_body *b = (const peri_body *)context;
    const peri__model *m = b->model;
    (void)sums;
    for (int32_t d = 0; d < m->dim; ++d)
        for (int64_t i = begin; i < end; ++i) {
            const int64_t at = d * m->stride + i;
            const double impulse = peri__get_real(b->closing, b->f32, at);
            if (impulse == 0.0) continue;
            peri__put_real(b->v, b->f32, at, peri__get_real(b->v, b->f32, at) + impulse / peri__density_at(b, i));
            peri__put_real(b->closing, b->f32, at, 0.0);
        }
}

/* v takes what the bonds that broke in the step still give. */
static void peri__close_step(peri_body *b) { peri__for_points(b, b->model->points, 1, peri__close_block, b, NULL); }
