/* SPDX-License-Identifier: MIT */
/* inline.h - what is small and used everywhere. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

PERI_INLINE int64_t peri__min(int64_t a, int64_t b) { return a < b ? a : b; }
PERI_INLINE double peri__square(double a) { return a * a; }

/* Place of entry (a, b) in the packed form. */
PERI_INLINE int peri__packed(int32_t dim, int a, int b) {
    return a == b ? a : dim == 2 ? 2 : a + b == 1 ? 3 : a + b == 3 ? 4 : 5;
}

PERI_INLINE int peri__is_ghost(const peri__model *m, int64_t i) { return m->part && m->part->depth[i]; }

/* Points that share a flag of `central`: a group, and in parts of bodies one, since groups depend on the partition. */
PERI_INLINE int64_t peri__central_of(const peri__model *m) { return m->part ? 1 : PERI_GROUP; }

/* The point at place k: the k-th in passes over the list. */
PERI_INLINE int64_t peri__nth(const peri__model *m, int64_t k) { return m->order ? m->order[k] : k; }

/* What sums with the weights of point i are too large by. In single precision w V_j and w V_i are rounded each for itself, and the forces
   on the two ends of a bond differ by that. Where volumes differ both ends therefore have the weight w V_i V_j, rounded once, and each
   divides its sums, in the precision of the state, by its own volume. */
PERI_INLINE double peri__share(const peri__model *m, int64_t i) { return m->mutual ? m->volume[i] : 1.0; }

/* The law of point i, its stiffness times a factor. */
PERI_INLINE const peri__law *peri__stiffened(const peri__model *m, int64_t i, double factor, peri__law *room) {
    if (factor == 1.0) return &m->laws[m->material[i]];
    *room = m->laws[m->material[i]];
    room->young *= factor;
    room->lambda *= factor;
    room->mu *= factor;
    room->a *= factor;
    room->b *= factor;
    room->bulk *= factor;
    return room;
}

/* The neighbour of entry `at` of the list. */
PERI_INLINE int64_t peri__entry_id(const peri__model *m, int64_t at) { return m->order ? m->order[m->ids[at]] : m->ids[at]; }
