/* status.c - status texts, the error record, the log. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

PERI_API const char *peri_status_text(int32_t status) {
#define PERI_STATUS_CASE_(name, value, text)                                                                           \
    case PERI_##name:                                                                                                  \
        return text;
    switch (status) {
        PERI_STATUS_LIST(PERI_STATUS_CASE_)
    default:
        return "unknown status";
    }
#undef PERI_STATUS_CASE_
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

/* What the log itself brings about is not told to it. */
static void peri__log(peri_body *b, int32_t level, const char *text) {
    int32_t running = b->running;
    if (!b->desc.log || running > 2) return;
    b->running = 3;
    b->desc.log(b->desc.log_user, level, text);
    b->running = running;
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
    if ((b)->running > 1) return peri__fail((b), PERI_ERROR_ORDER, "callback", -1, 0.0)
#define PERI_NEED_IDLE(b)                                                                                              \
    PERI_NEED_BUILT(b);                                                                                                \
    if ((b)->running) return peri__fail((b), PERI_ERROR_ORDER, "callback", -1, 0.0)

static int32_t peri__check_material_id(peri_body *b, int32_t material) {
    if (material < 0 || material >= b->material_count)
        return peri__fail(b, PERI_ERROR_MATERIAL, "material", material, 0.0);
    return PERI_OK;
}
