/* SPDX-License-Identifier: MIT */
/* refusal.h - calls that must fail: the code, the whole record, and which codes were seen. */
#ifndef REFUSAL_H
#define REFUSAL_H

#include "scene.h"

static int reached[peri__count_status]; /* by code less the first */
static peri_error seen; /* the record of the last refusal */

/* The call must have returned `code` and left a complete record of it (where there is a body to keep it). */
static void refuse(const peri_body *b, int32_t code, int64_t result, const char *text, int line) {
    if (result != code) {
        test_bad++;
        printf("    line %d: %s gave %d (%s), expected %d\n", line, text, (int)result, peri_status_text((int32_t)result), code);
    } else reached[code - peri__first_status] = 1;
    if (!b) return;
    memset(&seen, 0, sizeof seen);
    if (peri_get_error(b, &seen) != PERI_OK || seen.code != code || !seen.field || !seen.text || !seen.text[0] || seen.reserved) {
        test_bad++;
        printf("    line %d: %s: record: code %d, index %d, field %s, text %s\n", line, text, (int)seen.code, (int)seen.index,
               seen.field ? seen.field : "NULL", seen.text ? seen.text : "NULL");
    }
}
#define REFUSE(body, code, call)  refuse((body), (code), (int64_t)(call), #call, __LINE__)
#define REFUSE_CONST(code, call)  refuse(NULL, (code), (int64_t)(call), #call, __LINE__) /* no body: no record */
#define FIELD_IS(name)            CHECK(seen.field && strstr(seen.field, name) != NULL)

static inline int32_t take_none(void *user, int64_t index, const double *x) {
    (void)user;
    (void)index;
    (void)x;
    return 0;
}
static inline int32_t take_left(void *user, int64_t index, const double *x) {
    (void)user;
    (void)index;
    return x[0] < 0.2;
}
static inline int32_t write_nothing(void *user, const void *bytes, int64_t count) {
    (void)bytes;
    (void)count;
    return user ? 0 : 1;
}
static inline int32_t stop_now(void *user, peri_body *b) {
    (void)b;
    ++*(int *)user;
    return 1;
}

#endif
