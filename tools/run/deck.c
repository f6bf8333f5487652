/* SPDX-License-Identifier: MIT */
/* deck.c - decks: sections "[kind name]" of lines "key value ..."; '#' begins a comment. */
#include "run.h"
#include <stdlib.h>
#include <string.h>

static run_section *last(run_deck *deck) { return &deck->section[deck->sections - 1]; }

static int begin_section(run_deck *deck, run_text *text) {
    char       *head = text->token[0], *tail = text->token[text->count - 1];
    run_section *section;
    if (text->count > 2) return run_fail(text->fault, text->path, text->line, head, "a section is [kind] or [kind name]");
    if (tail[strlen(tail) - 1] != ']') return run_fail(text->fault, text->path, text->line, head, "the section does not end with ]");
    if (run_grow((void **)&deck->section, deck->sections, &deck->capacity, sizeof *deck->section) < 0)
        return run_fail(text->fault, text->path, text->line, head, "no memory");
    tail[strlen(tail) - 1] = 0;
    section = &deck->section[deck->sections++];
    memset(section, 0, sizeof *section);
    section->kind = head + 1;
    section->name = text->count == 2 ? tail : head + strlen(head);
    section->line = text->line;
    return 0;
}

static int add_entry(run_deck *deck, run_text *text) {
    run_section *section;
    run_entry   *entry;
    int64_t      k;
    if (deck->sections == 0) return run_fail(text->fault, text->path, text->line, text->token[0], "stands before the first section");
    section = last(deck);
    for (k = 0; k < section->entries; ++k) /* these may stand often */
        if (run_same(section->entry[k].key, text->token[0]) && strcmp(text->token[0], "probe") && strcmp(text->token[0], "without_ball") &&
            strcmp(text->token[0], "material_of"))
            return run_fail(text->fault, text->path, text->line, text->token[0], "is given twice");
    if (text->count < 2) return run_fail(text->fault, text->path, text->line, text->token[0], "has no value");
    if (text->count > RUN_TOKENS) return run_fail(text->fault, text->path, text->line, text->token[0], "has too many values");
    if (run_grow((void **)&section->entry, section->entries, &section->capacity, sizeof *section->entry) < 0)
        return run_fail(text->fault, text->path, text->line, text->token[0], "no memory");
    entry = &section->entry[section->entries++];
    memset(entry, 0, sizeof *entry);
    entry->key = text->token[0];
    entry->line = text->line;
    entry->count = text->count - 1;
    for (k = 0; k < entry->count; ++k) entry->value[k] = text->token[k + 1];
    return 0;
}

static int read_sections(run_deck *deck) {
    while (run_text_next(&deck->text, " \t\r", 1) > 0)
        if ((deck->text.token[0][0] == '[' ? begin_section(deck, &deck->text) : add_entry(deck, &deck->text)) < 0) return -1;
    if (deck->sections == 0) return run_fail(deck->text.fault, deck->text.path, 0, "deck", "holds no section");
    return 0;
}

int run_deck_read(run_deck *deck, const char *path, run_fault *fault) {
    memset(deck, 0, sizeof *deck);
    return run_text_open(&deck->text, path, fault) < 0 ? -1 : read_sections(deck);
}

int run_deck_of(run_deck *deck, const char *bytes, size_t size, const char *path, run_fault *fault) {
    memset(deck, 0, sizeof *deck);
    return run_text_of(&deck->text, bytes, size, path, fault) < 0 ? -1 : read_sections(deck);
}

void run_deck_free(run_deck *deck) {
    int64_t k;
    for (k = 0; k < deck->sections; ++k) free(deck->section[k].entry);
    free(deck->section);
    deck->section = NULL;
    deck->sections = 0;
    run_text_close(&deck->text);
}

run_entry *run_find(run_section *section, const char *key) {
    int64_t k;
    for (k = 0; k < section->entries; ++k)
        if (run_same(section->entry[k].key, key)) {
            section->entry[k].used = 1;
            return &section->entry[k];
        }
    return NULL;
}

int run_fail_at(run_deck *deck, const run_section *section, const run_entry *entry, const char *key, const char *text) {
    char where[170];
    (void)snprintf(where, sizeof where, "[%.40s%s%.60s] %.60s", section->kind, section->name[0] ? " " : "", section->name, key);
    return run_fail(deck->text.fault, deck->text.path, entry != NULL ? entry->line : section->line, where, text);
}

static int numbers(run_deck *deck, run_section *section, run_entry *entry, int count, double *to) {
    char text[80];
    int  k;
    if (entry->count != count) {
        (void)snprintf(text, sizeof text, "has %d values, but %d belong there", entry->count, count);
        return run_fail_at(deck, section, entry, entry->key, text);
    }
    for (k = 0; k < count; ++k)
        if (run_number(entry->value[k], &to[k]) < 0) return run_fail_at(deck, section, entry, entry->key, "is not a finite number");
    return 0;
}

int run_vector(run_deck *deck, run_section *section, const char *key, int count, double *to) {
    run_entry *entry = run_find(section, key);
    return entry == NULL ? run_fail_at(deck, section, NULL, key, "is missing") : numbers(deck, section, entry, count, to);
}

int run_string(run_deck *deck, run_section *section, const char *key, const char **to) {
    run_entry *entry = run_find(section, key);
    if (entry == NULL) return run_fail_at(deck, section, NULL, key, "is missing");
    if (entry->count != 1) return run_fail_at(deck, section, entry, key, "is one word");
    *to = entry->value[0];
    return 0;
}

static int choose(run_deck *deck, run_section *section, run_entry *entry, const run_choice *choice, int32_t *to) {
    char   text[250] = "is one of:";
    size_t length = strlen(text);
    for (; entry->count == 1 && choice->name != NULL; ++choice) {
        if (run_same(entry->value[0], choice->name)) {
            *to = choice->value;
            return 0;
        }
        if (length + strlen(choice->name) + 2 < sizeof text)
            length += (size_t)snprintf(text + length, sizeof text - length, " %s", choice->name);
    }
    return run_fail_at(deck, section, entry, entry->key, entry->count == 1 ? text : "is one word");
}

static int take_one(run_deck *deck, run_section *section, run_entry *entry, const run_key *key, int dim, char *to) {
    long long whole;
    if (key->kind == RUN_NUMBER) return numbers(deck, section, entry, 1, (double *)(void *)to);
    if (key->kind == RUN_VECTOR) return numbers(deck, section, entry, dim, (double *)(void *)to);
    if (key->kind == RUN_CHOICE) return choose(deck, section, entry, key->choices, (int32_t *)(void *)to);
    if (entry->count != 1 || run_whole(entry->value[0], &whole) < 0 || (key->kind == RUN_I32 && (whole > INT32_MAX || whole < INT32_MIN)))
        return run_fail_at(deck, section, entry, entry->key, "is not a whole number");
    if (key->kind == RUN_I32) *(int32_t *)(void *)to = (int32_t)whole;
    else *(int64_t *)(void *)to = (int64_t)whole;
    return 0;
}

int run_take(run_deck *deck, run_section *section, const run_key *keys, int dim, void *to) {
    for (; keys->key != NULL; ++keys) {
        run_entry *entry = run_find(section, keys->key);
        if (entry != NULL && take_one(deck, section, entry, keys, dim, (char *)to + keys->offset) < 0) return -1;
    }
    return 0;
}

int run_all_used(run_deck *deck, run_section *section) {
    int64_t k;
    for (k = 0; k < section->entries; ++k)
        if (!section->entry[k].used) return run_fail_at(deck, section, &section->entry[k], section->entry[k].key, "no such key here");
    return 0;
}
