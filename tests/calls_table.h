/* SPDX-License-Identifier: MIT */
/* calls_table.h - the table "Calls and statuses" of docs/manual.md, as test_promises_calls.c reads it, and which of its pairs were
   reached. */
#ifndef CALLS_TABLE_H
#define CALLS_TABLE_H

#include "scene.h"

enum { CALLS_OF_TABLE = 160, STATUSES = peri__count_status };

static struct {
    char name[64];
    int  row, never, listed[STATUSES], reached[STATUSES];
} table_rows[CALLS_OF_TABLE];
static int calls_of_table, rows_of_table;

static int of_status(int32_t status) { return (int)(status - peri__first_status); }
static int call_named(const char *name, size_t length) {
    for (int k = 0; k < calls_of_table; ++k)
        if (strlen(table_rows[k].name) == length && strncmp(table_rows[k].name, name, length) == 0) return k;
    return -1;
}

/* ---- the table and the statuses ------------------------------------------------------------------------------------------------ */

static struct {
    const char *name; /* without PERI_ERROR_ */
    int32_t     status;
} status_names[STATUSES];
static int name_count;

static void read_names(void) { /* of the enum of peri.h */
    FILE *file = fopen("peri.h", "r"); /* tests run at the root of the repository */
    char line[256], name[64];
    int status;
    static char text[STATUSES][64];
    CHECK(file != NULL);
    while (file && name_count < STATUSES && fgets(line, sizeof line, file)) {
        if (sscanf(line, " PERI_%63[A-Z_] = %d", name, &status) != 2 || status >= peri__end_status || status < peri__first_status) continue;
        (void)snprintf(text[name_count], 64, "%s", strncmp(name, "ERROR_", 6) == 0 ? name + 6 : name);
        status_names[name_count].name = text[name_count];
        status_names[name_count++].status = status;
    }
    if (file) (void)fclose(file);
    CHECK(name_count == STATUSES);
}
static int32_t status_named(const char *name, size_t length) {
    for (int k = 0; k < name_count; ++k)
        if (strlen(status_names[k].name) == length && strncmp(status_names[k].name, name, length) == 0) return status_names[k].status;
    return 1000;
}
static const char *name_of(int k) {
    for (int n = 0; n < name_count; ++n)
        if (of_status(status_names[n].status) == k) return status_names[n].name;
    return "?";
}

/* "ID stands for ID_NONE, ID_KIND, ID_BODY and ID_GONE." */
static void list(int call, const char *name, size_t length) {
    if (length == 2 && strncmp(name, "ID", 2) == 0) {
        for (int32_t s = PERI_ERROR_ID_GONE; s <= PERI_ERROR_ID_NONE; ++s) table_rows[call].listed[of_status(s)] = 1;
        return;
    }
    const int32_t status = status_named(name, length);
    if (status == 1000) {
        test_bad++;
        printf("    no status %.*s\n", (int)length, name);
    } else table_rows[call].listed[of_status(status)] = 1;
}
static void read_row(char *line) {
    char *cells = strstr(line, " | "), *at = line;
    const int first = calls_of_table;
    if (!cells) return;
    while ((at = strstr(at, "`peri_")) != NULL && at < cells && calls_of_table < CALLS_OF_TABLE) {
        const size_t length = strcspn(++at, "`");
        (void)snprintf(table_rows[calls_of_table].name, 64, "%.*s", (int)length, at);
        table_rows[calls_of_table].row = rows_of_table;
        table_rows[calls_of_table++].never = strncmp(cells + 3, "never", 5) == 0;
        at += length + 1;
    }
    rows_of_table++;
    for (at = cells + 3; *at && *at != '|' && strncmp(at, "never", 5) != 0;) {
        const size_t length = strspn(at, "ABCDEFGHIJKLMNOPQRSTUVWXYZ_");
        for (int k = first; k < calls_of_table && length > 0; ++k) list(k, at, length);
        at += length > 0 ? length : 1;
    }
}
static void read_table(void) {
    FILE *file = fopen("docs/manual.md", "r");
    static char line[2048];
    int here = 0;
    CHECK(file != NULL);
    while (file && fgets(line, sizeof line, file)) {
        if (line[0] == '#') here = strcmp(line, "## Calls and statuses\n") == 0;
        if (here && strncmp(line, "| `peri_", 8) == 0) read_row(line);
    }
    if (file) (void)fclose(file);
    CHECK(calls_of_table > 90 && rows_of_table > 50);
}

static void reach(const char *call, int64_t status) { /* `call` as text: the first peri_...( of it */
    const char *at = call;
    while ((at = strstr(at, "peri_")) != NULL && (at[strspn(at, "abcdefghijklmnopqrstuvwxyz0123456789_")] != '('
                                                  || (at > call && (at[-1] == '_' || at[-1] == '`')))) at += 5;
    if (!at || status < peri__first_status || status >= peri__end_status || status == PERI_OK) return;
    const int k = call_named(at, strspn(at, "abcdefghijklmnopqrstuvwxyz0123456789_"));
    if (k >= 0 && status > 0 && !table_rows[k].listed[of_status((int32_t)status)]) return; /* a count */
    if (k >= 0) table_rows[k].reached[of_status((int32_t)status)]++;
    else {
        test_bad++;
        printf("    %s is not in the table\n", at);
    }
}

/* Rows of misuse.h, and refusals of wrong_calls.h. */
static void read_refusals(const char *path, const char *before) {
    FILE *file = fopen(path, "r");
    static char line[1024];
    int count = 0;
    CHECK(file != NULL);
    while (file && fgets(line, sizeof line, file)) {
        const int is_row = strncmp(line, "ROW(", 4) == 0 || strncmp(line, "SET(", 4) == 0 || strncmp(line, "    REFUSE(", 11) == 0;
        char *status = is_row ? strstr(line, before) : NULL;
        if (!status) continue;
        status += strlen(before);
        const size_t length = strspn(status, "ABCDEFGHIJKLMNOPQRSTUVWXYZ_");
        const int32_t value = status_named(status, length);
        CHECK(value != 1000);
        reach(status + length, value);
        count++;
    }
    if (file) (void)fclose(file);
    CHECK(count > 40);
}
static void read_left_out(void) {
    FILE *file = fopen("tests/switches.c", "r");
    static char line[1024];
    CHECK(file != NULL);
    while (file && fgets(line, sizeof line, file))
        for (char *at = line; (at = strstr(at, "peri_")) != NULL; at += 5) {
            const int k = call_named(at, strspn(at, "abcdefghijklmnopqrstuvwxyz0123456789_"));
            if (k >= 0 && table_rows[k].listed[of_status(PERI_ERROR_LEFT_OUT)]) table_rows[k].reached[of_status(PERI_ERROR_LEFT_OUT)]++;
        }
    if (file) (void)fclose(file);
}

#endif
