/* SPDX-License-Identifier: MIT */
/* rigid_modes.c - what moves without resistance: connected parts whose supports leave rigid motions free, and points whose bonds span too
   little.

   The rigid motions of a part are t + omega x (y - centre)/radius of its present positions y (linear geometry: of x): 3 in 2D, 6 in 3D.
   Those in which no constrained component moves, and no point along the normal of an obstacle that holds it (touch.c), are free: the null
   space of the Gram matrix of these motions. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_RESISTED(b) ((b)->f32 ? 1e-5 : 1e-9) /* stiffness of a point in a direction, over its largest, that counts as some */

/* In part_of: points not looked at, of parts that hold, of the part under way, of parts that broke off and are left where they are. */
enum { PERI_UNSEEN = -2, PERI_HELD = -1, PERI_UNDER_WAY = -3, PERI_LOST = -4 };

#define PERI_WEIGHTLESS 1e-7 /* of the heaviest bond of a family: w vanishes at the horizon, but for rounding             */

static double peri__place(const peri_body *b, int64_t i, int32_t d) {
    int64_t at = d * b->model->stride + i;
    return peri__get_real(b->model->x, b->f32, at) + (b->desc.geometry == PERI_GEOMETRY_LINEAR ? 0.0 : peri__get_real(b->u, b->f32, at));
}

/* Component d of rigid motion r of a part at point i. */
static double peri__rigid(const peri_body *b, const peri__floating_part *part, int64_t i, int r, int32_t d) {
    const int32_t dim = b->dim;
    if (r < dim) return r == d ? 1.0 : 0.0;
    int axis = dim == 2 ? 2 : r - dim, u = (axis + 1) % 3, v = (axis + 2) % 3; /* turns u to v */
    if (d == u) return -(peri__place(b, i, v) - part->centre[v]) / part->radius;
    if (d == v) return (peri__place(b, i, u) - part->centre[u]) / part->radius;
    return 0.0;
}

/* Component d of free mode k of a part at point i. */
static double peri__mode(const peri_body *b, const peri__floating_part *part, int64_t i, int32_t k, int32_t d) {
    double sum = 0.0;
    for (int r = 0; r < b->dim * (b->dim + 1) / 2; ++r)
        if (part->mode[k][r] != 0.0) sum += part->mode[k][r] * peri__rigid(b, part, i, r, d);
    return sum;
}

/* The part of a vector at singular point i along what its bonds resist: the range of the inverse of its block. */
static void peri__to_resisted(const peri__solver *s, int64_t i, double *part) {
    const peri_body *b = s->body;
    const peri__model *m = b->model;
    double block[6], inverse[6], range[3];
    for (int k = 0; k < PERI_PACKED(m->dim); ++k) block[k] = peri__get_real(s->blocks, b->f32, k * m->stride + i);
    (void)peri__invert(m->dim, block, 0.5 * PERI_RESISTED(b), inverse); /* what was kept is no further apart than that */
    for (int d = 0; d < m->dim; ++d) {
        range[d] = 0.0;
        for (int c = 0; c < m->dim; ++c) range[d] += block[peri__packed(m->dim, d, c)] * part[c];
    }
    for (int d = 0; d < m->dim; ++d) {
        part[d] = 0.0;
        for (int c = 0; c < m->dim; ++c) part[d] += inverse[peri__packed(m->dim, d, c)] * range[c];
    }
}

/* Free mode k of a part at point i; at a singular point only along what its bonds resist, so that modes and singular directions are taken
   out one after the other, in any order. */
static void peri__mode_at(const peri__solver *s, const peri__floating_part *part, int64_t i, int32_t k, double *moved) {
    for (int32_t d = 0; d < s->body->dim; ++d) moved[d] = peri__mode(s->body, part, i, k, d);
    if (s->constrained[i] & PERI_SINGULAR) peri__to_resisted(s, i, moved);
}

static double peri__heaviest(const peri_body *b, const peri__row *row) {
    double heaviest = 0.0;
    for (int64_t k = 0; k < row->count; ++k) heaviest = fmax(heaviest, fabs(peri__get_real(row->weight, b->b32, k)));
    return heaviest;
}

/* The points that live bonds connect with `first`, to s->queue; their part_of becomes `mark`. Returns their number. */
static int64_t peri__connected(peri__solver *s, int64_t first, int32_t mark) {
    const peri_body *b = s->body;
    int64_t count = 1;
    s->queue[0] = (int32_t)first;
    s->part_of[first] = mark;
    for (int64_t n = 0; n < count; ++n) {
        int64_t i = s->queue[n];
        peri__row row;
        peri__read_row(b, i, &row);
        const double heaviest = peri__heaviest(b, &row);
        for (int64_t k = 0; k < row.count; ++k)
            if (s->part_of[row.ids[k]] == PERI_UNSEEN && peri__is_alive(b, i, k)
                && fabs(peri__get_real(row.weight, b->b32, k)) + fabs(peri__get_real(row.back, b->b32, k)) > PERI_WEIGHTLESS * heaviest) {
                s->part_of[row.ids[k]] = mark;
                s->queue[count++] = row.ids[k];
            }
    }
    return count;
}

/* Adds the rigid motions along the normals of what holds point i to the Gram matrix of what is constrained: s->counted, 0 none, 1 what is
   active, 2 all that is listed. */
static void peri__hold_contact(const peri__solver *s, const peri__floating_part *part, int64_t i, double *constrained) {
    const int dim = s->body->dim, motions = dim * (dim + 1) / 2;
    for (int64_t k = peri__first_contact(s, i); s->counted > 0 && k < s->contact_count && s->contacts[k].point == i; ++k) {
        double along[PERI_RIGID_MODES] = { 0.0 };
        if (s->counted == 1 && !s->contacts[k].active) continue;
        for (int r = 0; r < motions; ++r)
            for (int d = 0; d < dim; ++d) along[r] += s->contacts[k].normal[d] * peri__rigid(s->body, part, i, r, d);
        for (int r = 0; r < motions; ++r)
            for (int c = 0; c < motions; ++c) constrained[r * motions + c] += along[r] * along[c];
    }
}

/* Centre, radius and free modes of the part in s->queue. */
static void peri__free_modes(const peri__solver *s, int64_t count, peri__floating_part *part) {
    const peri_body *b = s->body;
    const int dim = b->dim, motions = dim * (dim + 1) / 2;
    double all[PERI_RIGID_MODES][PERI_RIGID_MODES] = { { 0.0 } }, constrained[PERI_RIGID_MODES * PERI_RIGID_MODES] = { 0.0 };
    double basis[PERI_RIGID_MODES * PERI_RIGID_MODES];
    double inner[PERI_RIGID_MODES * PERI_RIGID_MODES] = { 0.0 }, turned[PERI_RIGID_MODES * PERI_RIGID_MODES];
    int free_[PERI_RIGID_MODES], frees = 0;
    memset(part, 0, sizeof *part);
    for (int64_t n = 0; n < count; ++n)
        for (int d = 0; d < dim; ++d) part->centre[d] += peri__place(b, s->queue[n], d) / (double)count;
    for (int64_t n = 0; n < count; ++n) {
        double square = 0.0;
        for (int d = 0; d < dim; ++d) square += peri__square(peri__place(b, s->queue[n], d) - part->centre[d]);
        if (square > part->radius * part->radius) part->radius = sqrt(square);
    }
    if (!(part->radius > 0.0)) part->radius = 1.0;
    for (int64_t n = 0; n < count && s->contact_count > 0; ++n) peri__hold_contact(s, part, s->queue[n], constrained);
    for (int64_t n = 0; n < count; ++n)
        for (int d = 0; d < dim; ++d) {
            double motion[PERI_RIGID_MODES];
            for (int r = 0; r < motions; ++r) motion[r] = peri__rigid(b, part, s->queue[n], r, d);
            for (int r = 0; r < motions; ++r)
                for (int c = 0; c < motions; ++c) {
                    all[r][c] += motion[r] * motion[c];
                    if (s->constrained[s->queue[n]] >> d & 1) constrained[r * motions + c] += motion[r] * motion[c];
                }
        }
    peri__jacobi(motions, constrained, basis);
    for (int r = 0; r < motions; ++r)
        if (constrained[r * (motions + 1)] < 1e-10) free_[frees++] = r;
    /* among them those that move something: not the turn of a line of points about itself */
    for (int p = 0; p < frees; ++p)
        for (int q = 0; q < frees; ++q)
            for (int r = 0; r < motions; ++r)
                for (int c = 0; c < motions; ++c)
                    inner[p * frees + q] += basis[r * motions + free_[p]] * all[r][c] * basis[c * motions + free_[q]];
    peri__jacobi(frees, inner, turned);
    for (int p = 0; p < frees; ++p) {
        if (!(inner[p * (frees + 1)] > 1e-12 * (double)count)) continue;
        for (int r = 0; r < motions; ++r)
            for (int q = 0; q < frees; ++q) part->mode[part->modes][r] += basis[r * motions + free_[q]] * turned[q * frees + p];
        part->modes++;
    }
}

/* Leaves the free directions of a packed matrix; returns their number. */
static int peri__free_block(int dim, uint8_t constrained, double *block) {
    int frees = 0;
    for (int d = 0; d < dim; ++d) {
        frees += !(constrained >> d & 1);
        for (int c = 0; c < dim && (constrained >> d & 1); ++c) block[peri__packed(dim, d, c)] = 0.0;
    }
    return frees;
}

/* In how many free directions the bonds of a point resist at all, however little: the rank of the sum of n n. */
static int peri__directions(const peri_body *b, int64_t i, uint8_t constrained) {
    const peri__model *m = b->model;
    double spread[6] = { 0.0 }, inverse[6];
    peri__row row;
    peri__read_row(b, i, &row);
    const double heaviest = peri__heaviest(b, &row);
    for (int64_t k = 0; k < row.count; ++k) {
        double n[3] = { 0.0 }, square;
        if (!peri__is_alive(b, i, k) || !(fabs(peri__get_real(row.weight, b->b32, k)) > PERI_WEIGHTLESS * heaviest)) continue;
        for (int d = 0; d < m->dim; ++d) n[d] = peri__place(b, row.ids[k], d) - peri__place(b, i, d);
        square = peri__dot(n, n, m->dim);
        if (square > 0.0) peri__add_dyad(m->dim, 1.0 / square, n, 0.0, spread);
    }
    (void)peri__free_block(m->dim, constrained, spread);
    return peri__invert(m->dim, spread, b->f32 ? 1e-6 : 1e-9, inverse);
}

/* Holds, for each free mode of the part in s->queue, the component that it moves most, of a point that is not singular; and takes the mode
   out of the others. */
static void peri__pin(peri__solver *s, int64_t count, peri__floating_part *part) {
    const peri_body *b = s->body;
    for (int32_t k = 0; k < part->modes; ++k) {
        double most = 0.0;
        int64_t at = s->queue[0];
        int32_t axis = 0;
        for (int singular = 0; singular < 2 && most == 0.0; ++singular) /* of singular points where all do */
            for (int64_t n = 0; n < count; ++n)
                for (int32_t d = 0; d < b->dim; ++d) {
                    const int64_t i = s->queue[n];
                    double moved = fabs(peri__mode(b, part, i, k, d));
                    if (moved <= most * (1.0 + 1e-9) || (!singular && peri__directions(b, i, 0) < b->dim)) continue;
                    most = moved;
                    at = i;
                    axis = d;
                }
        s->constrained[at] = (uint8_t)(s->constrained[at] | 1 << axis);
        double pivot = peri__mode(b, part, at, k, axis);
        for (int32_t other = k + 1; other < part->modes; ++other) {
            double share = peri__mode(b, part, at, other, axis) / pivot;
            for (int r = 0; r < PERI_RIGID_MODES; ++r) part->mode[other][r] -= share * part->mode[k][r];
        }
    }
}

/* The inverse of the mass of the modes of all parts, at the present positions. */
static void peri__weigh_modes(peri__solver *s) {
    const peri_body *b = s->body;
    const peri__model *m = b->model;
    if (s->part_count == 0) return;
    for (int64_t p = 0; p < s->part_count; ++p) {
        memset(s->parts[p].inverse, 0, sizeof s->parts[p].inverse);
        s->parts[p].sum[0] = 0.0; /* the mass of the part */
    }
    for (int64_t i = 0; i < m->points; ++i) {
        peri__floating_part *part = s->part_of[i] < 0 ? NULL : &s->parts[s->part_of[i]];
        double mode[PERI_RIGID_MODES][3];
        if (part) part->sum[0] += peri__mass(b, i);
        for (int32_t k = 0; part && k < part->modes; ++k) peri__mode_at(s, part, i, k, mode[k]);
        for (int32_t d = 0; part && d < m->dim; ++d) {
            double moved[PERI_RIGID_MODES];
            for (int32_t k = 0; k < part->modes; ++k) moved[k] = mode[k][d];
            const double mass = peri__mass(b, i);
            for (int32_t p = 0; p < part->modes; ++p)
                for (int32_t q = 0; q < part->modes; ++q) part->inverse[p][q] += mass * moved[p] * moved[q];
        }
    }
    for (int64_t n = 0; n < s->part_count; ++n) { /* modes of singular points alone have no mass left: they are none any more */
        peri__floating_part *part = &s->parts[n];
        const int modes = part->modes;
        double mass[PERI_RIGID_MODES * PERI_RIGID_MODES], v[PERI_RIGID_MODES * PERI_RIGID_MODES];
        for (int p = 0; p < modes; ++p)
            for (int q = 0; q < modes; ++q) mass[p * modes + q] = part->inverse[p][q];
        peri__jacobi(modes, mass, v);
        for (int p = 0; p < modes; ++p)
            for (int q = 0; q < modes; ++q) {
                part->inverse[p][q] = 0.0;
                for (int e = 0; e < modes; ++e)
                    if (mass[e * (modes + 1)] > 1e-9 * part->sum[0])
                        part->inverse[p][q] += v[p * modes + e] * v[q * modes + e] / mass[e * (modes + 1)];
            }
    }
}

/* Has point i a bond that broke, to a point that is not of the part under way, or to `any`? */
static int peri__came_off(const peri__solver *s, int64_t i, int any) {
    const peri_body *b = s->body;
    const int64_t words = b->model->words;
    peri__row row;
    if (!b->alive) return 0;
    peri__read_row(b, i, &row);
    for (int64_t k = 0; k < row.count; ++k)
        if (!peri__is_alive(b, i, k) && (!b->uncut || b->uncut[i * words + k / 32] >> (k % 32) & 1)
            && (any || s->part_of[row.ids[k]] != PERI_UNDER_WAY))
            return 1;
    return 0;
}

/* Does a load act on point i, a support or an obstacle? */
static int peri__bears(const peri__solver *s, int64_t i) {
    int bears = s->constrained[i] != 0;
    for (int64_t k = peri__first_contact(s, i); k < s->contact_count && s->contacts[k].point == i && !bears; ++k)
        bears = s->contacts[k].active;
    return bears;
}

/* Is the part in s->queue one that broke off, and that nothing acts on? */
static int peri__broke_off(const peri__solver *s, int64_t count) {
    int off = 0;
    for (int64_t n = 0; n < count; ++n) {
        if (peri__bears(s, s->queue[n])) return 0;
        off = off || peri__came_off(s, s->queue[n], 0);
    }
    return off;
}

/* In linear geometry the part in s->queue is held by as little as stops its motions, and frees itself of stress. Else it is held as it is:
   what is left of a torn body may fold in ways that have no equilibrium near. */
static void peri__leave_part(peri__solver *s, int64_t count, peri__floating_part *part) {
    const peri_body *b = s->body;
    const int whole = b->desc.geometry != PERI_GEOMETRY_LINEAR;
    for (int64_t n = 0; n < count; ++n) {
        s->part_of[s->queue[n]] = PERI_LOST;
        if (whole) s->constrained[s->queue[n]] = (uint8_t)(s->constrained[s->queue[n]] | ((1 << b->dim) - 1));
    }
    if (!whole) peri__pin(s, count, part);
    s->report.lost_parts++;
    s->report.lost_points += count;
}

/* Marks the part in s->queue, which has so many free modes, where it would have more without obstacles. */
static void peri__note_leaning(peri__solver *s, int64_t count, int32_t modes) {
    peri__floating_part part;
    if (!s->leaning || s->contact_count == 0) return;
    s->counted = 0;
    peri__free_modes(s, count, &part);
    const int leans = part.modes > modes;
    s->leaning_count += leans;
    for (int64_t n = 0; n < count; ++n) s->leaning[s->queue[n]] = leans ? s->leaning_count : 0;
}

/* The active set of the next linear solve. bridged: springs are in it that are not in touch. */
static int32_t peri__choose_contacts(peri__solver *s) {
    const peri__model *m = s->body->model;
    peri__floating_part part;
    int64_t first = 0;
    const int32_t status = peri__list_contacts(s);
    s->bridged = 0;
    for (int32_t mark = 1; status == PERI_OK && mark <= s->leaning_count; ++mark) {
        int64_t count = 0;
        for (int64_t i = 0; i < m->points; ++i)
            if (s->leaning[i] == mark) s->queue[count++] = (int32_t)i;
        first = s->queue[0];
        s->counted = 1;
        peri__free_modes(s, count, &part);
        if (part.modes <= (s->part_of[first] < 0 ? 0 : s->parts[s->part_of[first]].modes)) continue;
        s->bridged = 1;
        for (int64_t n = 0; n < s->contact_count; ++n)
            if (s->leaning[s->contacts[n].point] == mark) s->contacts[n].active = 1;
    }
    s->hanging = s->bridged ? s->hanging + 1 : 0;
    return s->hanging > PERI_HANGING ? peri__set_error(&s->failure, PERI_ERROR_LOOSE, "loose", first, 0.0) : status;
}

/* Finds the floating parts and deals with them as the settings say. s->constrained holds the supports. */
static int32_t peri__find_floating_parts(peri__solver *s) {
    peri_body *b = s->body;
    const peri__model *m = b->model;
    const int refused = s->settings->loose == PERI_LOOSE_REFUSED;
    int held = 0;
    s->part_count = 0;
    s->report.loose = s->report.lost_parts = s->report.lost_points = 0;
    s->leaning_count = s->hanging = 0;
    const int32_t listed = peri__list_contacts(s);
    if (listed < 0) return listed;
    for (int64_t i = 0; i < m->points; ++i) s->part_of[i] = PERI_UNSEEN;
    for (int64_t i = 0; s->leaning && i < m->points; ++i) s->leaning[i] = 0;
    for (int64_t i = 0; i < m->points; ++i) {
        peri__floating_part part;
        if (s->part_of[i] != PERI_UNSEEN) continue;
        int64_t count = peri__connected(s, i, PERI_UNDER_WAY);
        s->counted = 2;
        peri__free_modes(s, count, &part);
        peri__note_leaning(s, count, part.modes);
        held = held || part.modes == 0;
        if (part.modes > 0 && refused && peri__broke_off(s, count)) {
            peri__leave_part(s, count, &part);
            continue;
        }
        for (int64_t n = 0; n < count; ++n) s->part_of[s->queue[n]] = PERI_HELD;
        if (part.modes == 0) continue;
        if (refused) return peri__set_error(&s->failure, PERI_ERROR_LOOSE, "loose", i, (double)part.modes);
        s->report.loose += part.modes;
        if (s->settings->loose == PERI_LOOSE_PINNED) {
            peri__pin(s, count, &part);
            continue;
        }
        if (!peri__grow(&b->scratch, &s->parts, &s->part_capacity, s->part_count + 1, sizeof *s->parts))
            return peri__fail(b, PERI_ERROR_MEMORY, "peri_solve", -1, 0.0);
        for (int64_t n = 0; n < count; ++n) s->part_of[s->queue[n]] = (int32_t)s->part_count;
        s->parts[s->part_count++] = part;
    }
    return refused && !held ? peri__set_error(&s->failure, PERI_ERROR_LOOSE, "loose", 0, (double)(m->dim * (m->dim + 1) / 2)) : PERI_OK;
}

/* Takes the free modes out of a vector of forces (spread by mass, as inertia would) or of displacements. */
static void peri__balance(peri__solver *s, void *vector, int forces) {
    const peri_body *b = s->body;
    const peri__model *m = b->model;
    if (s->part_count == 0) return;
    for (int64_t p = 0; p < s->part_count; ++p) memset(s->parts[p].sum, 0, sizeof s->parts[p].sum);
    for (int64_t i = 0; i < m->points; ++i) {
        peri__floating_part *part = s->part_of[i] < 0 ? NULL : &s->parts[s->part_of[i]];
        double mass = forces ? 1.0 : peri__mass(b, i);
        for (int32_t k = 0; part && k < part->modes; ++k) {
            double moved[3] = { 0.0 };
            peri__mode_at(s, part, i, k, moved);
            for (int32_t d = 0; d < m->dim; ++d) part->sum[k] += mass * moved[d] * peri__get_real(vector, b->f32, d * m->stride + i);
        }
    }
    for (int64_t p = 0; p < s->part_count; ++p) {
        double share[PERI_RIGID_MODES] = { 0.0 };
        for (int32_t k = 0; k < s->parts[p].modes; ++k)
            for (int32_t q = 0; q < s->parts[p].modes; ++q) share[k] += s->parts[p].inverse[k][q] * s->parts[p].sum[q];
        memcpy(s->parts[p].sum, share, sizeof share);
    }
    for (int64_t i = 0; i < m->points; ++i) {
        const peri__floating_part *part = s->part_of[i] < 0 ? NULL : &s->parts[s->part_of[i]];
        double mass = forces ? peri__mass(b, i) : 1.0;
        for (int32_t k = 0; part && k < part->modes; ++k) {
            double moved[3] = { 0.0 };
            peri__mode_at(s, part, i, k, moved);
            for (int32_t d = 0; d < m->dim; ++d) {
                int64_t at = d * m->stride + i;
                peri__put_real(vector, b->f32, at, peri__get_real(vector, b->f32, at) - mass * part->sum[k] * moved[d]);
            }
        }
    }
}

/* Inverts the diagonal blocks on what is free. Points whose bonds do not resist in all free directions are refused, or marked; those
   whose bonds push where they should resist are refused. */
static int32_t peri__invert_blocks(peri__solver *s) {
    peri_body *b = s->body;
    const peri__model *m = b->model;
    const int packed = PERI_PACKED(m->dim);
    const double cut = PERI_RESISTED(b);
    double last[6] = { 0.0 }, inverse[6] = { 0.0 };
    int spanned = 0;
    s->singular = 0;
    s->softest = HUGE_VAL;
    for (int64_t i = 0; i < m->points; ++i) {
        double block[6] = { 0.0 }, trace = 0.0;
        for (int k = 0; k < packed; ++k) block[k] = peri__get_real(s->blocks, b->f32, k * m->stride + i);
        for (int d = 0; d < m->dim; ++d) trace += block[d];
        if (trace > 0.0 && trace < s->softest) s->softest = trace;
        int frees = peri__free_block(m->dim, s->constrained[i], block);
        if (memcmp(block, last, sizeof block) != 0) { /* in a lattice most are equal */
            memcpy(last, block, sizeof last);
            spanned = peri__invert(m->dim, block, cut, inverse);
            if (peri__is_negative(m->dim, block, cut))
                return peri__set_error(&s->failure, PERI_ERROR_INDEFINITE, "peri_solve", i, 0.0);
        }
        if (spanned < frees && peri__directions(b, i, s->constrained[i]) == frees) { /* soft beside stiff */
            (void)peri__diagonal_block(b, i, block);
            (void)peri__free_block(m->dim, s->constrained[i], block);
            (void)peri__invert(m->dim, block, DBL_EPSILON, inverse);
            memset(last, 0, sizeof last);
            spanned = 0;
        } else if (spanned < frees) {
            if (s->settings->loose == PERI_LOOSE_REFUSED && (s->constrained[i] & PERI_LOADED || !peri__came_off(s, i, 1)))
                return peri__set_error(&s->failure, PERI_ERROR_LOOSE, "loose", i, 0.0);
            s->constrained[i] |= PERI_SINGULAR;
            s->singular++;
        }
        for (int k = 0; k < packed; ++k) peri__put_real(s->blocks, b->f32, k * m->stride + i, frees > 0 ? inverse[k] : 0.0);
    }
    return PERI_OK;
}

/* Takes out of a vector of forces, or of displacements, what the bonds of singular points do not resist. */
static void peri__drop_singular(peri__solver *s, void *vector) {
    const peri_body *b = s->body;
    const peri__model *m = b->model;
    for (int64_t i = 0; s->singular > 0 && i < m->points; ++i) {
        double part[3] = { 0.0 };
        if (!(s->constrained[i] & PERI_SINGULAR)) continue;
        for (int d = 0; d < m->dim; ++d) part[d] = peri__get_real(vector, b->f32, d * m->stride + i);
        peri__to_resisted(s, i, part);
        for (int d = 0; d < m->dim; ++d)
            if (!(s->constrained[i] >> d & 1)) peri__put_real(vector, b->f32, d * m->stride + i, part[d]);
    }
}
