/* status.c - status texts, the error record, the log. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

/* X(name, number, text) */
#define PERI_STATUS_LIST(X)                                                                                            \
    X(STOPPED, 1, "a callback asked to stop; the body is at a whole step and may go on")                               \
    X(OK, 0, "success")                                                                                                \
    X(ERROR_ARGUMENT, -1, "a required pointer is NULL, or a count or a choice is not one of the allowed values")       \
    X(ERROR_DESCRIPTOR, -2, "the descriptor was not filled by its init function, or is of another version")            \
    X(ERROR_MEMORY, -3, "the allocator returned NULL")                                                                 \
    X(ERROR_RANGE, -4, "a number is not finite or lies outside the range of its field")                                \
    X(ERROR_ORDER, -5, "this call comes too early or too late: points before peri_build, all else after it")           \
    X(ERROR_MATERIAL, -6, "no such material, or a material that contradicts itself")                                   \
    X(ERROR_POISSON, -7, "a bond-based material has a fixed Poisson ratio (1/4 in 3D and plane strain, 1/3 in plane stress); it must be") \
    X(ERROR_INFLUENCE, -8, "the influence function is not finite here, or has no finite moments to calibrate with")    \
    X(ERROR_POINT, -9, "a point has a position that is not finite, or a volume that is not positive and finite")       \
    X(ERROR_COINCIDENT, -10, "two points are at the same place")                                                       \
    X(ERROR_NO_POINTS, -11, "the body, or the shape just added, has no point")                                         \
    X(ERROR_HORIZON, -12, "the horizon is smaller than the spacing of the points")                                     \
    X(ERROR_FAMILY, -13, "a point has no neighbour within its horizon, or none with a weight")                         \
    X(ERROR_IBOND, -14, "the given families are not valid: id out of range, given twice, or not mutual")               \
    X(ERROR_TOO_LARGE, -15, "more points or bonds than 32-bit ids can number, or more than the memory can address")    \
    X(ERROR_SET, -16, "no such set, a name that is taken, or a selection that holds no point")                         \
    X(ERROR_ID, -17, "no such point, load or obstacle")                                                                \
    X(ERROR_CRACK, -18, "the crack has no extent, or is of a kind that this space does not have")                      \
    X(ERROR_PAIR, -19, "the two points share no bond")                                                                 \
    X(ERROR_STEP, -20, "the time step is larger than the stable step, which is the value")                             \
    X(ERROR_UNSTABLE, -21, "a point is faster than 1e9 speeds of sound or not finite: unstable step, load or start")   \
    X(ERROR_CALLBACK, -22, "a callback wrote a number that is not finite")                                             \
    X(ERROR_FIELD, -23, "the field cannot be used in this way: not stored, or not writable")                           \
    X(ERROR_CAPACITY, -24, "the buffer has the wrong size; it needs the value")                                        \
    X(ERROR_WRITE, -25, "the file could not be opened or written, or the write callback failed")                       \
    X(ERROR_CRITERION, -26, "the failure criterion cannot act on this model, or lacks its fracture energy")            \
    X(ERROR_MODEL, -27, "this model has no such constant, or cannot take this quadrature, interface or load")          \
    X(ERROR_LOOSE, -28, "no support holds this part of the body against some motion")                                  \
    X(ERROR_INDEFINITE, -29, "the tangent stiffness is not positive: buckling, softening or compression")              \
    X(ERROR_CONVERGENCE, -30, "no equilibrium within the iterations allowed; the value is the residual over its scale") \
    X(ERROR_LEFT_OUT, -31, "left out of this build, by the switch that the field names")

#define PERI_STATUS_NUMBER_(name, number, text) PERI_SAME_NUMBER_(name, PERI_##name == (number))
PERI_STATUS_LIST(PERI_STATUS_NUMBER_)
PERI_SAME_COUNT(status, PERI_STATUS_LIST, PERI_STATUS_COUNT_);

/* Without a default, so that compilers tell of a status that neither the list nor the count has. */
PERI_API const char *peri_status_text(int32_t status) {
#define PERI_STATUS_CASE_(name, number, text)                                                                          \
    case PERI_##name:                                                                                                  \
        return text;
    switch ((peri_status)status) {
        PERI_STATUS_LIST(PERI_STATUS_CASE_)
    case PERI_STATUS_COUNT_:
        break;
    }
#undef PERI_STATUS_CASE_
    return "unknown status";
}

static int32_t peri__set_error(peri_error *error, int32_t code, const char *field, int64_t index, double value) {
    if (error) {
        error->code = code;
        error->reserved = 0;
        error->index = index;
        error->value = value;
        error->field = field;
        error->text = peri_status_text(code);
    }
    return code;
}

/* Records the failure and returns its code. */
static int32_t peri__fail(peri_body *b, int32_t code, const char *field, int64_t index, double value) {
    return peri__set_error(&b->error, code, field, index, value);
}

PERI_API int32_t peri_last_error(const peri_body *b, peri_error *error) {
    if (!b || !error) return PERI_ERROR_ARGUMENT;
    *error = b->error;
    return PERI_OK;
}

PERI_API int64_t peri_error_format(const peri_error *error, char *buffer, int64_t capacity) {
    char numbers[96] = "", *end = numbers;
    if (!error || !error->field || !error->text || capacity < 0 || (!buffer && capacity > 0)) return PERI_ERROR_ARGUMENT;
    if (error->index >= 0) end = peri__put_integer(peri__put_text(end, " index "), error->index);
    if (error->value != 0.0 || error->code == PERI_ERROR_RANGE)
        end = peri__put_double(peri__put_text(end, end > numbers ? ", value " : " value "), error->value);
    *end = '\0';

    /* "text: field index i, value v", as much of it as there is */
    const char *part[4] = { error->text, error->field[0] || numbers[0] ? ": " : "", error->field,
                            error->field[0] || !numbers[0] ? numbers : numbers + 1 };
    int64_t length = 0;
    for (int k = 0; k < 4; ++k)
        for (const char *c = part[k]; *c; ++c, ++length)
            if (length + 1 < capacity) buffer[length] = *c;
    if (capacity > 0) buffer[peri__min(length, capacity - 1)] = '\0';
    return length;
}

/* From here on `who` is at work on the body. Returns who was before: peri__leave takes that back. So callbacks may nest. */
static int32_t peri__enter(const peri_body *b, int32_t who) {
    const int32_t former = b->running;
    ((peri_body *)b)->running = who;
    return former;
}

static void peri__leave(const peri_body *b, int32_t former) { ((peri_body *)b)->running = former; }

/* What the log itself brings about is not told to it. */
static void peri__log(peri_body *b, int32_t level, const char *text) {
    if (!b->desc.log || b->running == PERI__IN_LOG) return;
    const int32_t former = peri__enter(b, PERI__IN_LOG);
    b->desc.log(b->desc.log_user, level, text);
    peri__leave(b, former);
}

/* "m->young" names the field young. The text is constant, so its tail is too. */
static const char *peri__field_name(const char *expression) {
    const char *arrow = strstr(expression, "->");
    return arrow ? arrow + 2 : expression;
}

/* The checks that most public functions begin with. Arguments bear the names that they have in peri.h: the error record shows them. */
#define PERI_NEED_BODY(b)                                                                                              \
    if (!(b)) return PERI_ERROR_ARGUMENT
#define PERI_NEED(b, condition, field)                                                                                 \
    if (!(condition)) return peri__fail((b), PERI_ERROR_ARGUMENT, field, -1, 0.0)
#define PERI_NEED_BUILT(b)                                                                                             \
    PERI_NEED_BODY(b);                                                                                                 \
    if (!(b)->model) return peri__fail((b), PERI_ERROR_ORDER, "peri_build", -1, 0.0)
#define PERI_NEED_UNBUILT(b)                                                                                           \
    PERI_NEED_BODY(b);                                                                                                 \
    if ((b)->model || (b)->running) return peri__fail((b), PERI_ERROR_ORDER, (b)->running ? "callback" : "peri_build", -1, 0.0)
#define PERI_NEED_VECTOR(b, vector)                                                                                    \
    PERI_NEED(b, vector, #vector);                                                                                     \
    if (!peri__finite_vector(vector, (b)->dim)) return peri__fail((b), PERI_ERROR_RANGE, #vector, -1, 0.0)
#define PERI_NEED_NUMBER(b, condition, number)                                                                         \
    if (!(peri__finite(number) && (condition)))                                                                        \
        return peri__fail((b), PERI_ERROR_RANGE, peri__field_name(#number), -1, number)
/* Of a built body: what a callback within a step may not change; and the state, which no callback may. */
#define PERI_NEED_CHANGEABLE(b)                                                                                        \
    PERI_NEED_BUILT(b);                                                                                                \
    if ((b)->running > PERI__IN_FRAME) return peri__fail((b), PERI_ERROR_ORDER, "callback", -1, 0.0)
#define PERI_NEED_IDLE(b)                                                                                              \
    PERI_NEED_BUILT(b);                                                                                                \
    if ((b)->running) return peri__fail((b), PERI_ERROR_ORDER, "callback", -1, 0.0)

static int32_t peri__check_material_id(peri_body *b, int32_t material) {
    if (material < 0 || material >= b->material_count)
        return peri__fail(b, PERI_ERROR_MATERIAL, "material", material, 0.0);
    return PERI_OK;
}
