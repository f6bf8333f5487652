/* SPDX-License-Identifier: MIT */
/* status.c - status texts, the error record, the log. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

/* X(name, number, text) */
#define PERI_STATUS_LIST(X)                                                                                            \
    X(BRITTLE, 2, "success: as brittle bonds, the horizon being too large")                                            \
    X(STOPPED, 1, "a callback asked to stop; the body is at a whole step")                                             \
    X(OK, 0, "success")                                                                                                \
    X(ERROR_ARGUMENT, -1, "missing, NULL or given twice, or a count that is wrong")                                    \
    X(ERROR_CHOICE, -2, "not a value of this enum, or a flag that is not 0 or 1")                                      \
    X(ERROR_DESCRIPTOR, -3, "not filled by its init function, or of another version")                                  \
    X(ERROR_RANGE, -4, "a number is not finite or outside the range of its field")                                     \
    X(ERROR_ORDER, -5, "too early, too late, or from a callback that may not")                                         \
    X(ERROR_MEMORY, -6, "the allocator returned NULL")                                                                 \
    X(ERROR_TOO_LARGE, -7, "more than the library or memory takes; see the value")                                     \
    X(ERROR_CAPACITY, -8, "the buffer has the wrong size; it needs the value")                                         \
    X(ERROR_ID_NONE, -9, "no id: zero, a plain number, or what a failed call returned")                                \
    X(ERROR_ID_KIND, -10, "an id of another kind: of a load, say, not of a set")                                       \
    X(ERROR_ID_BODY, -11, "an id of another body")                                                                     \
    X(ERROR_ID_GONE, -12, "nothing has this id: it was removed, or never given")                                       \
    X(ERROR_INDEX, -13, "no point has this number")                                                                    \
    X(ERROR_NAME, -14, "a name that is taken, or that no set has")                                                     \
    X(ERROR_EMPTY, -15, "the body, the shape or the selection holds no point")                                         \
    X(ERROR_MATERIAL, -16, "the material contradicts itself, or is missing")                                           \
    X(ERROR_POISSON, -17, "bond-based: Poisson's ratio is fixed; it is the value")                                     \
    X(ERROR_LAW, -18, "this law has no such thing, or cannot take this")                                               \
    X(ERROR_CRITERION, -19, "the criterion cannot act on this law, or lacks its G0")                                   \
    X(ERROR_INFLUENCE, -20, "the influence function or its moments are not finite")                                    \
    X(ERROR_POINT, -21, "a place not finite, no volume, or a cell that crosses itself")                               \
    X(ERROR_COINCIDENT, -22, "two points are at the same place")                                                       \
    X(ERROR_HORIZON, -23, "the horizon is smaller than the spacing of the points")                                     \
    X(ERROR_FAMILY, -24, "a point has no neighbour, or none with a weight")                                            \
    X(ERROR_IBOND, -25, "given families: wrong number, not mutual, not of the horizon")                                \
    X(ERROR_CRACK, -26, "the crack has no extent, or is not for this space")                                           \
    X(ERROR_PAIR, -27, "the two points share no bond")                                                                 \
    X(ERROR_FIELD, -28, "this field cannot be used in this way: it is not stored")                                     \
    X(ERROR_AREA, -29, "the points feel another area than that of the face")                                           \
    X(ERROR_STEP, -30, "the time step exceeds the stable step, which is the value")                                    \
    X(ERROR_UNSTABLE, -31, "a point passed 1e9 speeds of sound: step, load or start")                                  \
    X(ERROR_CALLBACK, -32, "a callback failed, or wrote what is not finite")                                           \
    X(ERROR_LOOSE, -33, "no support holds this part against some motion")                                              \
    X(ERROR_INDEFINITE, -34, "the tangent is not positive: buckling or softening")                                     \
    X(ERROR_CONVERGENCE, -35, "no equilibrium within the iterations; value: residual")                                 \
    X(ERROR_WRITE, -36, "the file or the write callback failed")                                                       \
    X(ERROR_LEFT_OUT, -37, "left out of this build, by the switch that the field names")                               \
    X(ERROR_STATE, -38, "no saved state of such a body, or damaged; value: the byte")                                  \
    X(ERROR_PART, -39, "not of a part of a body; or its ghosts are not as owned")

#define PERI_STATUS_NUMBER_(name, number, text) PERI_SAME_NUMBER_(name, PERI_##name == (number))
PERI_STATUS_LIST(PERI_STATUS_NUMBER_)
PERI_SAME_COUNT(status, PERI_STATUS_LIST, peri__count_status);

/* Without a default, so that compilers tell of a status that the list has not. */
PERI_API const char *peri_status_text(int32_t status) {
#define PERI_STATUS_CASE_(name, number, text)                                                                          \
    case PERI_##name:                                                                                                  \
        return text;
    switch ((peri_status)status) {
        PERI_STATUS_LIST(PERI_STATUS_CASE_)
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

/* The record is not part of what `const` promises: bodies are made by the library, and none of them is a const object. */
static int32_t peri__fail_const(const peri_body *b, int32_t code, const char *field, int64_t index, double value) {
    return peri__fail((peri_body *)b, code, field, index, value);
}

PERI_API int32_t peri_version(void) { return PERI_VERSION_NUMBER; }

PERI_API int32_t peri_get_error(const peri_body *b, peri_error *error) {
    if (!b || !error) return PERI_ERROR_ARGUMENT;
    *error = b->error;
    return PERI_OK;
}

/* " is load 3 of body 7", of what was given as an id; written out where it is none. */
static char *peri__put_id(char *end, int64_t id) {
    static const char *const kinds[] = { "", "material ", "set ", "load ", "obstacle " };
    const int64_t kind = id >> 27, number = id >> 20 & 0x7F;
    end = peri__put_text(end, " is ");
    if (id == PERI_ALL) return peri__put_text(end, "PERI_ALL");
    if (kind < 1 || kind > peri__count_kind || number == 0) return peri__put_integer(end, id);
    end = peri__put_integer(peri__put_text(end, kinds[kind]), PERI_ID_INDEX(id));
    return peri__put_integer(peri__put_text(end, " of body "), number);
}

/* What is known beside the field. */
static void peri__put_details(char *end, const peri_error *error) {
    const char *start = end;
    const int is_id = error->code <= PERI_ERROR_ID_NONE && error->code >= PERI_ERROR_ID_GONE, listed = is_id && error->value != 0.0;
    if (error->code == PERI_ERROR_ORDER && strcmp(error->field, "peri_build") == 0) {
        end = peri__put_text(end, error->value != 0.0 ? " was called" : " was not called");
    } else {
        if (error->index >= 0 && (!is_id || listed)) end = peri__put_integer(peri__put_text(end, " index "), error->index);
        if (is_id) end = peri__put_id(end, listed ? (int64_t)error->value : error->index);
        else if (error->value != 0.0 || error->code == PERI_ERROR_RANGE || error->code == PERI_ERROR_CHOICE)
            end = peri__put_double(peri__put_text(end, end > start ? ", value " : " value "), error->value);
    }
    *end = '\0';
}

PERI_API int64_t peri_format_error(const peri_error *error, char *buffer, int64_t capacity) {
    char numbers[128];
    if (!error || !error->field || !error->text || capacity < 0 || (!buffer && capacity > 0)) return PERI_ERROR_ARGUMENT;
    peri__put_details(numbers, error);

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
    if ((b)->model || (b)->running)                                                                                    \
        return peri__fail((b), PERI_ERROR_ORDER, (b)->running ? "peri_unlock" : "peri_build", -1, (b)->running ? 0.0 : 1.0)
#define PERI_NEED_VECTOR(b, vector)                                                                                    \
    PERI_NEED(b, vector, #vector);                                                                                     \
    if (!peri__finite_vector(vector, (b)->dim))                                                                        \
        return peri__fail((b), PERI_ERROR_RANGE, #vector, -1, peri__not_finite(vector, (b)->dim))
#define PERI_NEED_CHOICE(b, group, choice)                                                                             \
    if (!PERI_IS_ONE_OF(group, choice)) return peri__fail((b), PERI_ERROR_CHOICE, peri__field_name(#choice), -1, (double)(choice))
#define PERI_NEED_FLAG(b, flag)                                                                                        \
    if ((flag) != 0 && (flag) != 1) return peri__fail((b), PERI_ERROR_CHOICE, peri__field_name(#flag), -1, (double)(flag))
#define PERI_NEED_NUMBER(b, condition, number)                                                                         \
    if (!(peri__finite(number) && (condition)))                                                                        \
        return peri__fail((b), PERI_ERROR_RANGE, peri__field_name(#number), -1, number)
/* Of a built body: what a callback within a step may not change; and the state, which no callback may. */
#define PERI_NEED_CHANGEABLE(b)                                                                                        \
    PERI_NEED_BUILT(b);                                                                                                \
    if ((b)->running > PERI__IN_FRAME) return peri__fail((b), PERI_ERROR_ORDER, "peri_unlock", -1, 0.0)
#define PERI_NEED_IDLE(b)                                                                                              \
    PERI_NEED_BUILT(b);                                                                                                \
    if ((b)->running) return peri__fail((b), PERI_ERROR_ORDER, "peri_unlock", -1, 0.0)
