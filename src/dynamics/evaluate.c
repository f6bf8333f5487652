/* SPDX-License-Identifier: MIT */
/* evaluate.c - forces at a displacement of the caller's, whose time loop or solver that is.

   Either the body stays as it is, and its memory of products with the stiffness (change_u, ...) serves instead of u, f and the response. Or
   bonds are to break, and it moves there, since what criteria keep of the past is the body's. It then does what a step of explicit.c does
   after the drift, but for supports, and the impulse of bonds that broke within the step goes to the caller instead of to v. The work by
   which the caller moves the body counts as `initial`: the change of kinetic and elastic energy, and what fracture took meanwhile. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_COOKIE_EVALUATE (UINT64_C(0x7065726900070000) + sizeof(peri_evaluate_desc))

PERI_API void peri_evaluate_desc_init(peri_evaluate_desc *e) {
    if (!e) return;
    memset(e, 0, sizeof *e);
    e->cookie = PERI_COOKIE_EVALUATE;
    e->type = PERI_TYPE_F64;
    e->bonds = e->external = 1;
    e->time = e->load_factor = (double)NAN;
}

static int32_t peri__check_evaluate(peri_body *b, const peri_evaluate_desc *e) {
    PERI_NEED(b, e, "desc");
    if (e->cookie != PERI_COOKIE_EVALUATE) return peri__fail(b, PERI_ERROR_DESCRIPTOR, "desc", -1, 0.0);
    PERI_NEED_FLAG(b, e->nodal);
    PERI_NEED_FLAG(b, e->bonds);
    PERI_NEED_FLAG(b, e->external);
    PERI_NEED_FLAG(b, e->fracture);
    PERI_NEED_FLAG(b, e->energy);
    if (e->type != PERI_TYPE_F64 && e->type != PERI_TYPE_F32) return peri__fail(b, PERI_ERROR_CHOICE, "type", -1, e->type);
    PERI_NEED(b, e->point_stride >= 0, "point_stride");
    PERI_NEED(b, e->component_stride >= 0, "component_stride");
    PERI_NEED_NUMBER(b, e->time_step >= 0.0, e->time_step);
    if (!peri__is_nan(e->time)) PERI_NEED_NUMBER(b, 1, e->time);
    if (!peri__is_nan(e->load_factor)) PERI_NEED_NUMBER(b, 1, e->load_factor);
    PERI_NEED(b, e->bonds || (e->external && !e->fracture), "bonds");
    PERI_NEED(b, e->fracture || !(e->velocity || e->time_step > 0.0), "fracture");
    PERI_NEED(b, e->velocity || !(e->time_step > 0.0), "velocity");
    PERI_NEED(b, e->time_step > 0.0 || !e->impulse, "time_step");
    PERI_NEED(b, e->impulse || !(e->time_step > 0.0 && b->closing), "impulse");
    return PERI_OK;
}

/* ---- between arrays of the caller and planes ------------------------------------------------------------------------ */

typedef struct peri__carrier {
    const peri_body *body;
    int64_t          point, component; /* strides of the array                                                            */
    int32_t          f32;              /* its precision                                                                   */
    const void      *in;               /* the array, of which planes are made; or                                         */
    void            *out;              /* which is made of them                                                           */
    void            *planes;           /* real [dim][stride]                                                              */
    double           factor;           /* the unit, or 1 over it of `in`                                                  */
    int              by_volume;        /* out: times the volume of the point                                              */
    uint64_t         headroom;         /* in: from the limit to 2^63, by bits of doubles without their sign               */
} peri__carrier;

static peri__carrier peri__carrier_of(const peri_body *b, const peri_evaluate_desc *e) {
    peri__carrier c;
    memset(&c, 0, sizeof c);
    c.body = b;
    c.point = e->point_stride > 0 ? e->point_stride : b->dim;
    c.component = e->component_stride > 0 ? e->component_stride : 1;
    c.f32 = e->type == PERI_TYPE_F32;
    return c;
}

/* The sign bit of what this returns is set where |x| reaches the limit or is no number. Sizes ascend with their bits. */
PERI_INLINE uint64_t peri__beyond(double x, uint64_t headroom) {
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return (bits & UINT64_MAX >> 1) + headroom;
}

static uint64_t peri__headroom(double limit) {
    uint64_t bits;
    memcpy(&bits, &limit, sizeof bits);
    return (UINT64_C(1) << 63) - bits;
}

/* The points [begin, end): `from` and `to` are the precisions; dimension and strides are constants where arrays are as the library's. */
#define PERI_TAKE_POINTS_(from, to, dims, point_stride, component_stride)                                                     \
    {                                                                                                                  \
        const from *in = (const from *)c->in;                                                                          \
        to *PERI_RESTRICT planes = (to *)c->planes;                                                                    \
        for (int64_t i = begin; i < end; ++i)                                                                          \
            for (int32_t d = 0; d < (dims); ++d) {                                                                     \
                const double x = (double)in[i * (point_stride) + d * (component_stride)] * factor;                     \
                over |= peri__beyond(x, headroom);                                                                     \
                planes[d * stride + i] = (to)x;                                                                        \
            }                                                                                                          \
    }
#define PERI_GIVE_POINTS_(from, to, dims, point_stride, component_stride)                                                     \
    {                                                                                                                  \
        const from *planes = (const from *)c->planes;                                                                  \
        to *PERI_RESTRICT out = (to *)c->out;                                                                          \
        for (int64_t i = begin; i < end; ++i)                                                                          \
            for (int32_t d = 0; d < (dims); ++d)                                                                       \
                out[i * (point_stride) + d * (component_stride)] =                                                     \
                    (to)((double)planes[d * stride + i] * (volume ? volume[i] : 1.0) * factor);                        \
    }
#define PERI_BY_LAYOUT_(what, from, to)                                                                                \
    {                                                                                                                  \
        if (c->point == 2 && c->component == 1 && dim == 2) what(from, to, 2, 2, 1)                                    \
        else if (c->point == 3 && c->component == 1 && dim == 3) what(from, to, 3, 3, 1)                               \
        else what(from, to, dim, c->point, c->component)                                                               \
    }
#define PERI_BY_PRECISION_(what, from_single, to_single)                                                               \
    {                                                                                                                  \
        if (from_single && to_single) PERI_BY_LAYOUT_(what, float, float)                                              \
        else if (from_single) PERI_BY_LAYOUT_(what, float, double)                                                     \
        else if (to_single) PERI_BY_LAYOUT_(what, double, float)                                                       \
        else PERI_BY_LAYOUT_(what, double, double)                                                                     \
    }

/* sums->bad: the first point beyond the limit. */
PERI_VECTOR_CODE static void peri__carry_in(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__carrier *c = (const peri__carrier *)context;
    const int32_t dim = c->body->dim;
    const int64_t stride = c->body->model->stride;
    const double factor = c->factor;
    const uint64_t headroom = c->headroom;
    uint64_t over = 0;
    const peri__domain *part = c->body->model->part;
    PERI_BY_PRECISION_(PERI_TAKE_POINTS_, c->f32, c->body->f32)
    for (int64_t i = begin; over >> 63 && sums->bad < 0 && i < end; ++i)
        for (int32_t d = 0; d < dim; ++d) {
            const double x = peri__get_real(c->in, c->f32, i * c->point + d * c->component) * factor;
            if (peri__beyond(x, headroom) >> 63 && !(part && part->depth[i])) sums->bad = i;
        }
}

PERI_VECTOR_CODE static void peri__carry_out(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__carrier *c = (const peri__carrier *)context;
    const int32_t dim = c->body->dim;
    const int64_t stride = c->body->model->stride;
    const double factor = c->factor, *volume = c->by_volume ? c->body->model->volume : NULL;
    (void)sums;
    PERI_BY_PRECISION_(PERI_GIVE_POINTS_, c->body->f32, c->f32)
    for (int64_t i = begin; c->body->model->part && i < end; ++i)
        for (int32_t d = 0; peri__is_ghost(c->body->model, i) && d < dim; ++d)
            peri__put_real(c->out, c->f32, i * c->point + d * c->component, 0.0);
}

/* An array of displacements or velocities to planes; refused where the body cannot hold it, as `like` does. */
static int32_t peri__take_array(peri_body *b, peri__carrier c, const void *in, const void *like, double unit, void *planes,
                                const char *name) {
    c.in = in;
    c.factor = 1.0 / unit;
    c.planes = planes;
    c.headroom = peri__headroom(peri__state_limit(b, like) * (b->f32 ? 1.0 - (double)FLT_EPSILON : 1.0));
    peri__for_points(b, b->model->points, 1, peri__carry_in, &c, b->sums);
    const int64_t bad = peri__total(b->sums, b->model->points).bad;
    for (int32_t d = 0; bad >= 0 && d < b->dim; ++d) {
        const double value = peri__get_real(in, c.f32, bad * c.point + d * c.component);
        if (peri__beyond(value * c.factor, c.headroom) >> 63) return peri__fail(b, PERI_ERROR_RANGE, name, bad, value);
    }
    return PERI_OK;
}

/* `time`: 1 of forces, the unit of time of impulses. */
static void peri__give_array(const peri_body *b, const peri_evaluate_desc *e, void *planes, double time, void *out) {
    peri__carrier c = peri__carrier_of(b, e);
    if (!out) return;
    c.out = out;
    c.planes = planes;
    c.by_volume = e->nodal;
    c.factor = time * (e->nodal ? b->model->energy / b->model->length : peri__force_unit(b->model));
    peri__for_points(b, b->model->points, 1, peri__carry_out, &c, NULL);
}

/* ---- the body stays ------------------------------------------------------------------------------------------------ */

/* f += loads. */
static int32_t peri__external_at(peri_body *b, const peri_evaluate_desc *e, void *f) {
    const double time = peri__is_nan(e->time) ? peri__load_time(b) : e->time;
    const double factor = peri__is_nan(e->load_factor) ? b->now.load_factor : e->load_factor;
    const int32_t former = peri__enter(b, PERI__IN_CALLBACK);
    const int32_t status = peri__apply_loads_at(b, time, factor, f);
    peri__leave(b, former);
    return status;
}

/* u, f: as of the body. */
static int32_t peri__evaluate_there(peri_body *b, const peri_evaluate_desc *e, const void *u, void *f, peri_evaluate_report *report) {
    const peri__model *m = b->model;
    int32_t status = PERI_OK;
    memset(f, 0, peri__vector_bytes(b));
    if (e->external) status = peri__external_at(b, e, f);
    if (status < 0) return status;
    if (e->bonds && e->force) {
        peri__operands operands = peri__operands_of(b);
        operands.u = u;
        operands.f = f;
        if (!m->pairwise) operands.response = (char *)b->change_response + (size_t)m->margin * peri__bond_real(b);
        operands.node = NULL;
        peri__sum_forces(b, &operands, NULL);
        status = peri__heed_laws(b);
        if (status < 0) return status;
    }
    peri__give_array(b, e, f, 1.0, e->force);
    if (report && e->energy) report->energy = peri__energy_under(b, u, NULL) * m->energy;
    return peri__heed_laws(b);
}

/* ---- the body moves there ------------------------------------------------------------------------------------------- */

/* Takes the time and the load factor, and sets f to what acts on the body where it is. */
static int32_t peri__act(peri_body *b, const peri_evaluate_desc *e) {
    if (!peri__is_nan(e->time)) {
        b->now.still = 0;
        b->now.time = e->time;
    }
    if (!peri__is_nan(e->load_factor)) b->now.load_factor = e->load_factor;
    b->now.loaded = 1;
    memset(b->f, 0, peri__vector_bytes(b));
    int32_t status = e->external ? peri__apply_loads(b, peri__load_time(b), 0.0) : PERI_OK;
    if (e->external && status == PERI_OK) status = peri__apply_obstacles(b, peri__load_time(b), 0.0);
    return status;
}

static void peri__exchange(void *a, void *b, size_t bytes) {
    unsigned char *p = (unsigned char *)a, *q = (unsigned char *)b, kept[PERI_BLOCK * sizeof(double)];
    for (size_t at = 0; at < bytes; at += sizeof kept) {
        const size_t some = bytes - at < sizeof kept ? bytes - at : sizeof kept;
        memcpy(kept, p + at, some);
        memcpy(p + at, q + at, some);
        memcpy(q + at, kept, some);
    }
}

/* The force and the breaks of the body where it is, f holding what else acts on it. */
static int32_t peri__evaluate_body(peri_body *b, const peri_evaluate_desc *e, peri_evaluate_report *report) {
    const double fracture = b->now.ledger.fracture;
    const int64_t broken = b->now.broken;
    peri__operands operands = peri__operands_of(b);
    operands.step = e->time_step / b->model->time;
    if (!(e->time_step > 0.0)) operands.closing = NULL;
    const int broke = peri__forces_and_breaks(b, &operands);
    int32_t status = peri__heed_laws(b);
    if (status == PERI_OK && e->external && broke && b->contact) (void)peri__ready_after_breaks(b, operands.step);
    if (status == PERI_OK && e->external) status = peri__touch_now(b);
    if (b->desc.ledger) b->now.ledger.before -= b->now.ledger.fracture - fracture;
    peri__give_array(b, e, b->f, 1.0, e->force);
    if (!b->closing) memset(b->f, 0, peri__vector_bytes(b)); /* f is out of date as soon as the caller has it */
    peri__give_array(b, e, b->closing ? b->closing : b->f, b->model->time, e->impulse);
    if (broke && b->closing) memset(b->closing, 0, peri__vector_bytes(b));
    if (broke) peri__note_breaks(b, peri__load_time(b));
    if (b->before && broke) peri__report_breaks(b);
    if (!report) return status;
    report->broken = b->now.broken - broken;
    if (e->energy) report->energy = peri__elastic_energy(b, NULL) * b->model->energy;
    return status;
}

/* u, v: where the body moves, laid out as in the body; NULL: nothing else than now. Where a load or an obstacle fails it moves back. */
static int32_t peri__evaluate_here(peri_body *b, const peri_evaluate_desc *e, void *u, void *v, peri_evaluate_report *report) {
    const peri__progress was = b->now;
    int32_t status = peri__note_energy(b);
    if (status < 0) return status;
    const int32_t former = peri__begin_run(b);
    peri__changed(b, PERI__MOTION);
    if (u) peri__exchange(b->u, u, peri__vector_bytes(b));
    if (v) peri__exchange(b->v, v, peri__vector_bytes(b));
    const int32_t shared = peri__share_ghosts(b);
    status = peri__agree(b, shared < 0 ? shared : peri__act(b, e), 0, NULL);
    if (status == PERI_OK) {
        status = peri__evaluate_body(b, e, report);
    } else {
        if (u) peri__exchange(b->u, u, peri__vector_bytes(b));
        if (v) peri__exchange(b->v, v, peri__vector_bytes(b));
        b->now.still = was.still;
        b->now.time = was.time;
        b->now.load_factor = was.load_factor;
        b->now.loaded = was.loaded;
    }
    peri__still_ghosts(b);
    peri__end_run(b, former);
    return status == PERI_OK ? peri__heed_callbacks(b) : status;
}

/* Checks all, and takes what the caller gives to the planes of change_u and change_f. */
static int32_t peri__take_place(peri_body *b, const peri_evaluate_desc *e) {
    int32_t status = peri__check_evaluate(b, e);
    if (status < 0) return status;
    if (e->fracture && b->running) return peri__fail(b, PERI_ERROR_ORDER, "peri_unlock", -1, 0.0);
    if (e->fracture) status = peri__check_whole(b);
    if (status < 0) return status;
    if (!peri__need_change(b)) return peri__fail(b, PERI_ERROR_MEMORY, "displacement", -1, 0.0);
    const peri__carrier carrier = peri__carrier_of(b, e);
    const size_t margin = (size_t)b->model->margin * peri__real(b);
    void *u = (char *)b->change_u + margin, *f = (char *)b->change_f + margin;
    (void)peri__ensure(b, PERI__STALE_MASKS | PERI__STALE_CONSTANTS);
    if (e->displacement) status = peri__take_array(b, carrier, e->displacement, b->u, b->model->length, u, "displacement");
    if (e->velocity && status == PERI_OK)
        status = peri__take_array(b, carrier, e->velocity, b->v, peri__velocity_unit(b->model), f, "velocity");
    return status;
}

static int32_t peri__evaluate(peri_body *b, const peri_evaluate_desc *e, peri_evaluate_report *report) {
    const size_t margin = (size_t)b->model->margin * peri__real(b);
    void *u = (char *)b->change_u + margin, *f = (char *)b->change_f + margin;
    int32_t status = peri__agree(b, PERI_OK, 0, NULL);
    if (status < 0) return status;
    if (e->fracture) return peri__evaluate_here(b, e, e->displacement ? u : NULL, e->velocity ? f : NULL, report);
    if (!e->displacement) u = b->u;
    status = peri__share_vector(b, u, 1);
    return status < 0 ? status : peri__evaluate_there(b, e, u, f, report);
}

/* The report, of all parts, where directions of bonds were counted. */
static int32_t peri__end_evaluate(peri_body *b, int32_t status, peri_evaluate_report *report) {
    double sum[2] = { report ? report->energy : 0.0, report ? (double)report->broken : 0.0 };
    status = peri__end_together(b, status);
    if (status >= 0 && b->model->part) {
        const int32_t reduced = peri__reduce(b, PERI_REDUCTION_SUM, 2, sum);
        if (reduced < 0) return reduced;
    }
    if (report) report->energy = sum[0];
    if (report) report->broken = (int64_t)(0.5 * sum[1]);
    return status;
}

PERI_API int32_t peri_evaluate(peri_body *b, const peri_evaluate_desc *e, peri_evaluate_report *report) {
    if (report) memset(report, 0, sizeof *report);
    PERI_NEED_CHANGEABLE(b);
    b->told = 0;
    const int32_t status = peri__take_place(b, e);
    return peri__end_evaluate(b, status < 0 ? status : peri__evaluate(b, e, report), report);
}
