/* SPDX-License-Identifier: MIT */
/* table.c - rows of figures, as aligned text and as CSV. */
#include "suite.h"

void table_open(table *t, const char *path, const column *columns, int count) {
    t->csv = fopen(path, "w");
    t->columns = columns;
    t->count = count;
    t->at = 0;
    printf("\n");
    for (int k = 0; k < count; ++k) {
        printf("%*s%s", columns[k].width, columns[k].title, k + 1 < count ? " " : "\n");
        if (t->csv) fprintf(t->csv, "%s%s", columns[k].name, k + 1 < count ? "," : "\n");
    }
}

/* What stands between this entry and the next. */
static void next(table *t) {
    const int last = ++t->at == t->count;
    printf(last ? "\n" : " ");
    if (t->csv) fprintf(t->csv, last ? "\n" : ",");
    if (last) t->at = 0;
    (void)fflush(stdout);
}

void put_text(table *t, const char *text) {
    printf("%*s", t->columns[t->at].width, text);
    if (t->csv) fprintf(t->csv, strchr(text, ',') ? "\"%s\"" : "%s", text);
    next(t);
}

void put_number(table *t, double value) {
    const column *c = &t->columns[t->at];
    if (value != value) printf("%*s", c->width, "-");
    else printf("%*.*f", c->width, c->decimals, value);
    if (t->csv && value == value) fprintf(t->csv, "%.6g", value);
    next(t);
}

void table_close(table *t) {
    if (t->csv) (void)fclose(t->csv);
    t->csv = NULL;
}
