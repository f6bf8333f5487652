/* SPDX-License-Identifier: MIT */
/* text.c - lines, tokens and numbers of text files. */
#include "run.h"
#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

int run_fail(run_fault *fault, const char *path, long line, const char *field, const char *text) {
    if (line > 0) (void)snprintf(fault->text, sizeof fault->text, "%.200s:%ld: %.80s: %.250s", path, line, field, text);
    else (void)snprintf(fault->text, sizeof fault->text, "%.200s: %.80s: %.250s", path, field, text);
    return -1;
}

int run_text_of(run_text *text, const char *bytes, size_t size, const char *path, run_fault *fault) {
    memset(text, 0, sizeof *text);
    text->path = path;
    text->fault = fault;
    text->bytes = (char *)malloc(size + 1);
    if (text->bytes == NULL) return run_fail(fault, path, 0, "file", "no memory");
    memcpy(text->bytes, bytes, size);
    text->bytes[size] = 0;
    text->size = size;
    if (memchr(bytes, 0, size) != NULL) return run_fail(fault, path, 0, "file", "is not text: it holds a zero byte");
    return 0;
}

int run_text_open(run_text *text, const char *path, run_fault *fault) {
    FILE   *file = fopen(path, "rb");
    size_t  room = 65536, size = 0, got;
    char   *bytes = NULL, *more;
    int     result;
    memset(text, 0, sizeof *text);
    if (file == NULL) return run_fail(fault, path, 0, "file", strerror(errno));
    for (;;) {
        more = (char *)realloc(bytes, room);
        if (more == NULL) break;
        bytes = more;
        got = fread(bytes + size, 1, room - size, file);
        size += got;
        if (size < room) break;
        if (room > (size_t)-1 / 4) { more = NULL; break; }
        room *= 2;
    }
    if (more == NULL) result = run_fail(fault, path, 0, "file", "no memory");
    else if (ferror(file)) result = run_fail(fault, path, 0, "file", "cannot be read");
    else result = run_text_of(text, bytes, size, path, fault);
    free(bytes);
    (void)fclose(file);
    return result;
}

void run_text_close(run_text *text) {
    free(text->bytes);
    text->bytes = NULL;
}

static void split(run_text *text, char *line, const char *separators) {
    char *at = line;
    text->count = 0;
    while (*at != 0) {
        at += strspn(at, separators);
        if (*at == 0) break;
        if (text->count < RUN_TOKENS) text->token[text->count] = at;
        ++text->count;
        at += strcspn(at, separators);
        if (*at != 0) *at++ = 0;
    }
}

int run_text_next(run_text *text, const char *separators, int hash) {
    text->count = 0;
    while (text->at < text->size) {
        char *line = text->bytes + text->at, *end = strchr(line, '\n'), *cut;
        text->at += end == NULL ? strlen(line) : (size_t)(end - line) + 1;
        if (end != NULL) *end = 0;
        ++text->line;
        cut = hash ? strchr(line, '#') : NULL;
        if (cut != NULL) *cut = 0;
        split(text, line, separators);
        if (text->count > 0) return 1;
    }
    return 0;
}

int run_number(const char *token, double *value) {
    char *end;
    *value = strtod(token, &end);
    return end != token && *end == 0 && isfinite(*value) ? 0 : -1;
}

int run_whole(const char *token, long long *value) {
    char *end;
    errno = 0;
    *value = strtoll(token, &end, 10);
    return end != token && *end == 0 && errno == 0 ? 0 : -1;
}

int run_same(const char *a, const char *b) {
    while (*a != 0 && tolower((unsigned char)*a) == tolower((unsigned char)*b)) ++a, ++b;
    return tolower((unsigned char)*a) == tolower((unsigned char)*b);
}

int run_copy(char *out, size_t capacity, const char *text) {
    const size_t length = strlen(text);
    if (length >= capacity) return -1;
    memcpy(out, text, length + 1);
    return 0;
}

int run_grow(void **array, int64_t count, int64_t *capacity, size_t size) {
    const int64_t room = *capacity > 0 ? 2 * *capacity : 16;
    void *more;
    if (count < *capacity) return 0;
    if ((uint64_t)room > (uint64_t)((size_t)-1 / 2) / size) return -1;
    more = realloc(*array, (size_t)room * size);
    if (more == NULL) return -1;
    *array = more;
    *capacity = room;
    return 0;
}
