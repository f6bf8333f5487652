/* SPDX-License-Identifier: MIT */
/* checkpoint.c - the state of a body as bytes, and back.

   All is 64-bit words of the machine; a mark tells the order of their bytes. First the head: magic, version and mark, the words that say of
   which scene the state is, and their checksum. Then sections in a fixed order: name, number, length in bytes, the checksum of these three
   and the bytes; the bytes, filled up to whole words with 0. The last section is empty, and its number is the checksum of all checksums.
     A checksum takes word after word to h = (h ^ word) p, turned: for a given h a one-to-one map of the word, and for a given word of h, so
   that no change of one word goes unseen.
     What is read goes to memory of its own. Nothing of the body changes before all is read and verified, nor where memory is short.

   What a body keeps is in three lists: PERI_PROGRESS_LIST, the arrays of arrays.c by their role, and peri__list_sections below, of vectors,
   loads and obstacles. Contents cannot lead out of arrays: no place or count is read from them. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_STATE_MAGIC   UINT64_C(0x5045524949524550) /* PERIIREP, in either order of bytes                            */
#define PERI_STATE_VERSION 1
#define PERI_STATE_MARK    UINT64_C(0x0102030405060708)

/* ---- checksums ------------------------------------------------------------------------------------------------------ */

static uint64_t peri__hash_word(uint64_t h, uint64_t word) {
    h = (h ^ word) * UINT64_C(0x9E3779B97F4A7C15);
    return h << 29 | h >> 35;
}

/* Of bytes; those of the last word that are not there count as 0. */
static uint64_t peri__hash(uint64_t h, const void *bytes, int64_t count) {
    const unsigned char *at = (const unsigned char *)bytes;
    uint64_t word;
    for (; count >= 8; count -= 8, at += 8) {
        memcpy(&word, at, 8);
        h = peri__hash_word(h, word);
    }
    word = 0;
    if (count > 0) memcpy(&word, at, (size_t)count);
    return count > 0 ? peri__hash_word(h, word) : h;
}

/* ---- the scene ------------------------------------------------------------------------------------------------------- */

typedef enum peri__scene_word { /* words of the head, in order                                                           */
    PERI__MAGIC_WORD,
    PERI__VERSION_WORD,
    PERI__MARK_WORD,
    PERI__KIND_WORD,      /* precision, space, geometry, timing, thickness                                               */
    PERI__COUNT_WORD,     /* points                                                                                      */
    PERI__POINTS_WORD,    /* places, volumes, materials of points                                                        */
    PERI__MATERIALS_WORD, /* as they were given, interfaces too                                                          */
    PERI__FAMILIES_WORD,  /* with all that follows from the rest: weights, constants of bonds                            */
    PERI__NO_FAIL_WORD,
    PERI__LOADS_WORD,     /* kinds, sets, axes                                                                           */
    PERI__OBSTACLES_WORD, /* kinds                                                                                       */
    PERI__CONTACT_WORD,   /* as it acts between materials                                                                */
    PERI__SUM_WORD,
    PERI__HEAD_WORDS
} peri__scene_word;

static const char *peri__word_name(int k) {
    static const char *const names[PERI__HEAD_WORDS] = { "", "version", "byte order", "peri_body_desc", "points", "points", "materials",
                                                         "families", "peri_set_no_fail", "loads", "obstacles",
                                                         "peri_set_contact", "" };
    return names[k];
}

static uint64_t peri__hash_numbers(uint64_t h, const double *a, int count) {
    for (int k = 0; k < count; ++k) {
        uint64_t word = 1; /* of what is no number: its bits differ from compiler to compiler                             */
        if (!peri__is_nan(a[k])) memcpy(&word, &a[k], sizeof word);
        h = peri__hash_word(h, word);
    }
    return h;
}

static uint64_t peri__hash_material(uint64_t h, const peri_material_desc *d) {
    const double numbers[16] = { d->law, d->criterion, d->young, d->bulk, d->poisson, d->density, d->fracture_energy, d->critical_stretch,
                                 d->stabilization, d->strength, d->cohesion, d->friction_angle, d->compression, d->rate, d->rate_power,
                                 d->delay };
    const double inelastic[4] = { d->yield_shear, d->relaxations, d->history, d->stress != NULL };
    h = peri__hash_numbers(h, numbers, 16);
    if (!peri__inelastic_of(d)) return h;
    h = peri__hash_numbers(peri__hash_numbers(h, inelastic, 4), d->relaxation_part, d->relaxations);
    return peri__hash_numbers(h, d->relaxation_time, d->relaxations);
}

static uint64_t peri__hash_materials(const peri_body *b) {
    uint64_t h = (uint64_t)b->material_count;
    for (int32_t k = 0; k < b->material_count; ++k) h = peri__hash_material(h, &b->materials[k]);
    for (int64_t k = 0; k < b->interface_count; ++k) {
        const peri__interface *between = &b->interfaces[k];
        h = peri__hash_word(peri__hash_word(h, (uint64_t)between->i), (uint64_t)between->j);
        h = peri__hash_material(h, &between->material);
    }
    for (int64_t k = 0; k < b->bond_law_count; ++k) {
        double numbers[PERI_BOND_LAW_NUMBERS];
        const int count = peri__bond_law_numbers(&b->bond_laws[k], numbers);
        h = peri__hash_numbers(h, numbers, count);
    }
    return h;
}

static uint64_t peri__hash_loads(const peri_body *b) {
    uint64_t h = (uint64_t)b->load_count;
    for (int64_t s = 0; s < b->load_count; ++s) {
        const peri__load *load = &b->loads[s];
        const uint64_t words[3] = { (uint64_t)load->kind, (uint64_t)load->axes, (uint64_t)load->count };
        if (load->kind == PERI__FREE) { /* removed: the rest is gone */
            h = peri__hash_word(h, 0);
            continue;
        }
        h = peri__hash_word(peri__hash(h, words, sizeof words), load->value != NULL);
        for (int64_t k = 0; k < load->count; ++k) h = peri__hash_word(h, (uint64_t)peri__set_point(b, load->set, k));
    }
    return h;
}

static uint64_t peri__hash_obstacles(const peri_body *b) {
    uint64_t h = (uint64_t)b->obstacle_count;
    for (int64_t k = 0; k < b->obstacle_count; ++k) {
        const peri__obstacle *o = &b->obstacles[k];
        h = peri__hash_word(h, (uint64_t)(8 * (int64_t)o->kind + 4 * (o->kept != NULL) + 2 * (o->free != NULL)));
    }
    return h;
}

static uint64_t peri__hash_contact(const peri_body *b) {
    uint64_t h = 0;
    for (int32_t k = 0; b->contact && k < b->model->materials * b->model->materials; ++k) {
        const peri__touch *t = &b->contact->touch[k];
        const double numbers[6] = { t->on, t->distance, t->stiffness, t->friction, t->friction_speed, t->loss };
        h = peri__hash_numbers(h, numbers, 6);
    }
    return h;
}

static uint64_t peri__hash_no_fail(const peri_body *b) {
    uint64_t h = 0;
    for (int64_t i = 0; b->no_fail && i < b->model->points; ++i)
        if (b->no_fail[i]) h = peri__hash_word(h, (uint64_t)i);
    return h;
}

static void peri__write_head(const peri_body *b, uint64_t words[PERI__HEAD_WORDS]) {
    const peri__model *m = b->model;
    peri__array arrays[PERI_MODEL_ARRAYS];
    const double kind[5] = { b->desc.precision, b->desc.space, b->desc.geometry, b->desc.break_timing, b->desc.thickness };
    const double reach[3] = { m->horizon, (double)m->margin, m->record_reals };
    memset(words, 0, PERI__HEAD_WORDS * sizeof *words);
    words[PERI__MAGIC_WORD] = PERI_STATE_MAGIC;
    words[PERI__VERSION_WORD] = PERI_STATE_VERSION;
    words[PERI__MARK_WORD] = PERI_STATE_MARK;
    words[PERI__KIND_WORD] = peri__hash_numbers(0, kind, 5);
    words[PERI__COUNT_WORD] = (uint64_t)m->points;
    words[PERI__POINTS_WORD] = peri__hash_numbers(peri__hash_numbers(0, &m->length, 1), m->origin, 3);
    words[PERI__MATERIALS_WORD] = peri__hash_materials(b);
    words[PERI__FAMILIES_WORD] = peri__hash_numbers((uint64_t)m->bonds, reach, 3);
    peri__list_model(b, m, arrays);
    for (int k = 0; k < PERI_MODEL_ARRAYS; ++k) {
        const void *array = peri__model_array(m, &arrays[k]);
        const int of_points = arrays[k].purpose == PERI__POINTS && arrays[k].place != offsetof(peri__model, count);
        uint64_t *word = &words[of_points ? PERI__POINTS_WORD : PERI__FAMILIES_WORD];
        *word = peri__hash_word(*word, array ? (uint64_t)arrays[k].count : 0);
        if (array) *word = peri__hash(*word, array, arrays[k].count * (int64_t)arrays[k].size);
    }
    words[PERI__NO_FAIL_WORD] = peri__hash_no_fail(b);
    words[PERI__LOADS_WORD] = peri__hash_loads(b);
    words[PERI__OBSTACLES_WORD] = peri__hash_obstacles(b);
    words[PERI__CONTACT_WORD] = peri__hash_contact(b);
    words[PERI__SUM_WORD] = peri__hash(0, words, PERI__SUM_WORD * (int64_t)sizeof *words);
}

/* ---- the sections ------------------------------------------------------------------------------------------------------- */

typedef struct peri__section {
    uint64_t name, number;
    char    *data;  /* of the body; NULL where it has no such array                                                       */
    int64_t  bytes;
    int      array; /* of flags, which may be missing: its index in the list of arrays; else -1                           */
    int64_t  at;    /* where its bytes begin in what was read; -1 where it was missing                                    */
} peri__section;

#define PERI_STATE_WORD_(type, name) +1
enum { PERI__PROGRESS_WORDS = 0 PERI_PROGRESS_LIST(PERI_STATE_WORD_), PERI__LEDGER_WORDS = sizeof(peri__ledger) / sizeof(double),
       PERI__STATE_WORDS = PERI__PROGRESS_WORDS + PERI__LEDGER_WORDS + 3 };

/* Members of progress as words: numbers of either kind are told apart by their type alone. */
static uint64_t peri__word_of_double(double a) {
    uint64_t word;
    memcpy(&word, &a, sizeof word);
    return word;
}
static double peri__word_as_double(uint64_t word) {
    double a;
    memcpy(&a, &word, sizeof a);
    return a;
}
static uint64_t peri__word_of_int64_t(int64_t a) { return (uint64_t)a; }
static int64_t peri__word_as_int64_t(uint64_t word) { return (int64_t)word; }
static uint64_t peri__word_of_int32_t(int32_t a) { return (uint64_t)(int64_t)a; }
static int32_t peri__word_as_int32_t(uint64_t word) { return (int32_t)(int64_t)word; }
static uint64_t peri__word_of_uint32_t(uint32_t a) { return a; }
static uint32_t peri__word_as_uint32_t(uint64_t word) { return (uint32_t)word; }

/* Progress, and what belongs to it. A body that is saved by on_frame is whole, though its run is under way. */
static void peri__progress_to_words(const peri_body *b, uint64_t *words) {
    const peri__progress *now = &b->now;
    int n = 0;
#define PERI_TO_WORD_(type, name) words[n++] = peri__word_of_##type(now->name);
    PERI_PROGRESS_LIST(PERI_TO_WORD_)
#undef PERI_TO_WORD_
    memcpy(&words[n], &now->ledger, sizeof now->ledger);
    n += PERI__LEDGER_WORDS;
    words[n++] = peri__word_of_double(b->largest_row_sum);
    words[n++] = peri__word_of_double(b->sharp);
    words[n] = peri__word_of_int32_t(b->softens);
}

static void peri__progress_from_words(peri_body *b, const uint64_t *words) {
    peri__progress *now = &b->now;
    int n = 0;
#define PERI_FROM_WORD_(type, name) now->name = peri__word_as_##type(words[n++]);
    PERI_PROGRESS_LIST(PERI_FROM_WORD_)
#undef PERI_FROM_WORD_
    memcpy(&now->ledger, &words[n], sizeof now->ledger);
    n += PERI__LEDGER_WORDS;
    b->largest_row_sum = peri__word_as_double(words[n++]);
    b->sharp = peri__word_as_double(words[n++]);
    b->softens = peri__word_as_int32_t(words[n]);
    now->torn = 0;
    now->fragments = 0;
}

/* Up to eight letters. */
static uint64_t peri__section_name(const char *name) {
    const int64_t length = peri__min(8, (int64_t)strlen(name));
    uint64_t word = 0;
    for (int64_t k = 0; k < length; ++k) word |= (uint64_t)(unsigned char)name[k] << (8 * k);
    return word;
}

static void peri__put_section(peri__section **end, const char *name, int64_t number, void *data, int64_t bytes, int array) {
    peri__section *s = (*end)++;
    s->name = peri__section_name(name);
    s->number = (uint64_t)number;
    s->data = (char *)data;
    s->bytes = bytes;
    s->array = array;
    s->at = -1;
}

static int64_t peri__most_sections(const peri_body *b) { return 6 + PERI_ARRAYS + 3 * b->load_count + 11 * b->obstacle_count; }

/* Where an obstacle is and goes, what it keeps of points, and of a free one all: what that is made of follows from the scene. */
static void peri__list_obstacle(peri__section **end, peri__obstacle *o, int64_t k, int64_t points) {
    peri__put_section(end, "position", k, o->position, sizeof o->position, -1);
    peri__put_section(end, "turn", k, o->turn, sizeof o->turn, -1);
    peri__put_section(end, "velocity", k, o->velocity, sizeof o->velocity, -1);
    peri__put_section(end, "spin", k, o->spin, sizeof o->spin, -1);
    peri__put_section(end, "pushed", k, o->force, sizeof o->force, -1);
    peri__put_section(end, "moment", k, o->moment, sizeof o->moment, -1);
    peri__put_section(end, "lost", k, (void *)&o->lost, sizeof o->lost, -1);
    if (o->kept) peri__put_section(end, "kept", k, o->kept, points * PERI_KEPT * (int64_t)sizeof *o->kept, -1);
    if (o->free) peri__put_section(end, "free", k, (void *)o->free, sizeof *o->free, -1);
}

/* In the order of the file. words: of progress. */
static int64_t peri__list_sections(const peri_body *b, uint64_t *words, peri__section *list) {
    const peri__model *m = b->model;
    const int64_t vector = m->stride * m->dim * (int64_t)peri__real(b);
    peri__section *end = list;
    peri__array arrays[PERI_ARRAYS];
    peri__put_section(&end, "progress", 0, words, PERI__STATE_WORDS * (int64_t)sizeof *words, -1);
    peri__put_section(&end, "u", 0, b->u, vector, -1);
    peri__put_section(&end, "v", 0, b->v, vector, -1);
    peri__put_section(&end, "f", 0, b->f, vector, -1);
    peri__list_arrays(b, arrays);
    for (int k = 0; k < PERI_ARRAYS; ++k) {
        const peri__role role = arrays[k].role;
        void *array = peri__array_of(b, &arrays[k]);
        if (role != PERI__BONDS_LEFT && (!array || (role != PERI__FOLLOWS && role != PERI__HISTORY && role != PERI__FIELD))) continue;
        peri__put_section(&end, arrays[k].name, 0, array, arrays[k].count * (int64_t)arrays[k].size, role == PERI__BONDS_LEFT ? k : -1);
    }
    for (int64_t k = 0; k < b->load_count; ++k) {
        const peri__load *load = &b->loads[k];
        const int64_t reals = load->count * m->dim * (int64_t)sizeof(double);
        if (load->kind == PERI__FREE) continue;
        if (load->value) peri__put_section(&end, "value", k, load->value, reals, -1);
        if (load->force) peri__put_section(&end, "force", k, load->force, PERI__SUPPORT_PLANES * reals, -1);
        if (load->force) peri__put_section(&end, "stepped", k, (void *)&load->stepped, sizeof load->stepped, -1);
    }
    for (int64_t k = 0; k < b->obstacle_count; ++k)
        if (b->obstacles[k].kind) peri__list_obstacle(&end, &b->obstacles[k], k, m->points);
    if (b->contact) peri__put_section(&end, "crowd", 0, (void *)&b->contact->crowd, sizeof b->contact->crowd, -1);
    if (b->contact && b->contact->drag)
        peri__put_section(&end, "drag", 0, b->contact->drag, m->stride * m->dim * (int64_t)sizeof *b->contact->drag, -1);
    return end - list;
}

/* Bytes with what fills the last word. */
static int64_t peri__whole_words(int64_t bytes) { return (bytes + 7) / 8 * 8; }

static uint64_t peri__section_sum(const uint64_t *head, const void *data, int64_t bytes) {
    return peri__hash(peri__hash(0, head, 3 * (int64_t)sizeof *head), data, bytes);
}

/* ---- to bytes --------------------------------------------------------------------------------------------------------- */

typedef struct peri__saver {
    peri_write_fn write;
    void         *user;
    uint64_t      sum; /* of all checksums                                                                                */
} peri__saver;

static int32_t peri__save_section(peri__saver *s, uint64_t name, uint64_t number, const void *data, int64_t bytes) {
    uint64_t head[4] = { name, number, (uint64_t)bytes, 0 };
    const char zero[8] = { 0 };
    head[3] = peri__section_sum(head, data, bytes);
    s->sum = peri__hash_word(s->sum, head[3]);
    int32_t said = s->write(s->user, head, sizeof head);
    if (said == 0 && bytes > 0) said = s->write(s->user, data, bytes);
    if (said == 0 && bytes % 8 > 0) said = s->write(s->user, zero, 8 - bytes % 8);
    return said;
}

PERI_API int32_t peri_save_state_to(peri_body *b, peri_write_fn write, void *user) {
    PERI_NEED_CHANGEABLE(b);
    PERI_NEED_WHOLE(b, "peri_save_state_to");
    PERI_NEED(b, write, "write");
    const int32_t status = b->running ? PERI_OK : peri__check_whole(b);
    if (status < 0) return status;
    const int64_t most = peri__most_sections(b);
    uint64_t head[PERI__HEAD_WORDS], words[PERI__STATE_WORDS];
    peri__saver s = { write, user, 0 };
    peri__section *list = (peri__section *)peri__new(&b->scratch, most, sizeof *list);
    if (!list) return peri__fail(b, PERI_ERROR_MEMORY, "state", -1, 0.0);
    peri__progress_to_words(b, words);
    peri__write_head(b, head);
    s.sum = head[PERI__SUM_WORD];
    const int64_t count = peri__list_sections(b, words, list);
    const int32_t former = peri__enter(b, PERI__IN_CALLBACK);
    int32_t said = write(user, head, sizeof head);
    for (int64_t k = 0; k < count && said == 0; ++k)
        if (list[k].data) said = peri__save_section(&s, list[k].name, list[k].number, list[k].data, list[k].bytes);
    if (said == 0) said = peri__save_section(&s, peri__section_name("end"), s.sum, "", 0);
    peri__leave(b, former);
    peri__delete(&b->scratch, list, most, sizeof *list);
    return said == 0 ? PERI_OK : peri__fail(b, PERI_ERROR_WRITE, "peri_write_fn", -1, said);
}

/* ---- and back --------------------------------------------------------------------------------------------------------- */

typedef struct peri__loader {
    peri_body   *body;
    peri_read_fn read;
    void        *user;
    int64_t      offset; /* bytes read so far                                                                             */
    uint64_t     sum;
    char        *bytes;  /* of all sections                                                                               */
} peri__loader;

static int32_t peri__load_fail(const peri__loader *l, int64_t offset, const char *field) {
    return peri__fail(l->body, PERI_ERROR_STATE, field, -1, (double)offset);
}

static int32_t peri__load_bytes(peri__loader *l, void *to, int64_t count) {
    if (l->read(l->user, to, count) != 0) return peri__load_fail(l, l->offset, "peri_read_fn");
    l->offset += count;
    return PERI_OK;
}

static int32_t peri__load_head(peri__loader *l) {
    uint64_t words[PERI__HEAD_WORDS], own[PERI__HEAD_WORDS];
    const int32_t status = peri__load_bytes(l, words, sizeof words);
    if (status < 0) return status;
    peri__write_head(l->body, own);
    for (int k = 0; k < PERI__HEAD_WORDS; ++k)
        if (words[k] != own[k]) return peri__load_fail(l, k * 8, peri__word_name(k));
    l->sum = own[PERI__SUM_WORD];
    return PERI_OK;
}

/* What is named where a section is another than the one expected: an array that only one of both has, "" where none is to blame. */
static const char *peri__odd_array(const peri_body *b, uint64_t found, uint64_t expected) {
    const char *missing = "", *more = "";
    peri__array arrays[PERI_ARRAYS];
    peri__list_arrays(b, arrays);
    for (int k = 0; k < PERI_ARRAYS && found != expected; ++k) {
        const peri__role role = arrays[k].role;
        const uint64_t name = peri__section_name(arrays[k].name);
        if (role != PERI__FOLLOWS && role != PERI__HISTORY && role != PERI__FIELD) continue;
        if (name == expected) missing = arrays[k].name;
        if (name == found && !peri__array_of(b, &arrays[k])) more = arrays[k].name;
    }
    return *more ? more : missing;
}

/* The sections that the body expects, in order; flags of bonds may be missing. */
static int32_t peri__load_sections(peri__loader *l, peri__section *list, int64_t count) {
    int64_t room = 0;
    for (int64_t k = 0; k <= count; ++k) {
        uint64_t head[4];
        const int64_t begin = l->offset;
        int32_t status = peri__load_bytes(l, head, sizeof head);
        if (status < 0) return status;
        while (k < count && list[k].array >= 0 && head[0] != list[k].name) k++;
        const uint64_t name = k < count ? list[k].name : peri__section_name("end"), number = k < count ? list[k].number : l->sum;
        const int64_t bytes = k < count ? list[k].bytes : 0, whole = peri__whole_words(bytes);
        if (head[0] != name || head[1] != number || head[2] != (uint64_t)bytes)
            return peri__load_fail(l, begin, peri__odd_array(l->body, head[0], name));
        status = whole > 0 ? peri__load_bytes(l, l->bytes + room, whole) : PERI_OK;
        if (status < 0) return status;
        if (head[3] != peri__section_sum(head, l->bytes + room, whole)) return peri__load_fail(l, begin, "");
        l->sum = peri__hash_word(l->sum, head[3]);
        if (k < count) list[k].at = room;
        room += whole;
    }
    return PERI_OK;
}

/* Is the array of flags at this member of the body among what was read? */
static int peri__was_read(const peri_body *b, const peri__section *list, int64_t count, size_t place) {
    peri__array arrays[PERI_ARRAYS];
    peri__list_arrays(b, arrays);
    for (int64_t k = 0; k < count; ++k)
        if (list[k].array >= 0 && list[k].at >= 0 && arrays[list[k].array].place == place) return 1;
    return 0;
}

/* Memory for flags that were read, where the body has none. 0 where memory is short: the body is as before. */
static int peri__need_sections(peri_body *b, peri__section *list, int64_t count) {
    const peri__model *m = b->model;
    const int had = b->alive != NULL;
    peri__array arrays[PERI_ARRAYS];
    if (peri__was_read(b, list, count, offsetof(peri_body, alive)) && !peri__need_alive(b)) return 0;
    if (peri__was_read(b, list, count, offsetof(peri_body, uncut)) && !b->uncut) {
        b->uncut = peri__new_flags(b);
        if (!b->uncut && !had) {
            peri__delete(&b->memory, b->alive, m->points * m->words, sizeof *b->alive);
            peri__delete(&b->memory, b->masks, m->stencil.columns, sizeof *b->masks);
            b->alive = NULL;
            b->masks = NULL;
        }
        if (!b->uncut) return 0;
    }
    peri__list_arrays(b, arrays);
    for (int64_t k = 0; k < count; ++k)
        if (list[k].array >= 0) list[k].data = (char *)peri__array_of(b, &arrays[list[k].array]);
    return 1;
}

/* What was read becomes the body's. */
static void peri__take_sections(peri_body *b, const char *bytes, const peri__section *list, int64_t count, const uint64_t *words) {
    const peri__model *m = b->model;
    b->stop = 0;
    peri__forget_solver(b);
    peri__forget_seat(b->seat);
    peri__forget_contact(b->contact, m); /* its lists are made anew, as those of clones are; and so are fragments         */
    for (int64_t k = 0; k < count; ++k) {
        if (list[k].at >= 0) memcpy(list[k].data, bytes + list[k].at, (size_t)list[k].bytes);
        else if (list[k].data) peri__set_flags(m, (uint32_t *)(void *)list[k].data);
    }
    peri__progress_from_words(b, words);
    peri__weigh_fields(b);
    peri__clear_arrays(b, 0);
    for (int64_t k = 0; k < b->obstacle_count; ++k)
        if (b->obstacles[k].kind) peri__update_axes(&b->obstacles[k], b->dim);
    for (int64_t g = 0; b->masks && g < m->stencil.groups; ++g) peri__group_masks(m, g, ~(uint32_t)0, b->alive, b->masks);
}

/* All that is read goes to `list` and l->bytes. */
static int32_t peri__load_all(peri__loader *l, peri__section *list, int64_t count) {
    const int32_t former = peri__enter(l->body, PERI__IN_CALLBACK);
    int32_t status = peri__load_head(l);
    if (status == PERI_OK) status = peri__load_sections(l, list, count);
    peri__leave(l->body, former);
    return status;
}

PERI_API int32_t peri_load_state_from(peri_body *b, peri_read_fn read, void *user) {
    PERI_NEED_IDLE(b);
    PERI_NEED_WHOLE(b, "peri_load_state_from");
    PERI_NEED(b, read, "read");
    const int64_t most = peri__most_sections(b);
    uint64_t words[PERI__STATE_WORDS];
    peri__loader l = { b, read, user, 0, 0, NULL };
    int64_t count = 0, room = 0;
    int32_t status = PERI_OK;
    peri__section *list = (peri__section *)peri__new(&b->scratch, most, sizeof *list);
    if (list) {
        count = peri__list_sections(b, words, list);
        for (int64_t k = 0; k < count; ++k) room += peri__whole_words(list[k].bytes);
        l.bytes = (char *)peri__new_unset(&b->scratch, room, 1);
    }
    if (!l.bytes) status = peri__fail(b, PERI_ERROR_MEMORY, "state", -1, 0.0);
    if (status == PERI_OK) status = peri__load_all(&l, list, count);
    if (status == PERI_OK && !peri__need_sections(b, list, count)) status = peri__fail(b, PERI_ERROR_MEMORY, "state", -1, 0.0);
    if (status == PERI_OK) peri__take_sections(b, l.bytes, list, count, words);
    peri__delete(&b->scratch, l.bytes, room, 1);
    peri__delete(&b->scratch, list, most, sizeof *list);
    return status;
}

/* ---- files ------------------------------------------------------------------------------------------------------------- */

#ifndef PERI_NO_STDIO
static int32_t peri__to_file(void *user, const void *bytes, int64_t count) {
    return fwrite(bytes, 1, (size_t)count, (FILE *)user) != (size_t)count;
}

static int32_t peri__from_file(void *user, void *bytes, int64_t count) {
    return fread(bytes, 1, (size_t)count, (FILE *)user) != (size_t)count;
}

PERI_API int32_t peri_save_state(peri_body *b, const char *path) {
    PERI_NEED_CHANGEABLE(b);
    PERI_NEED(b, path, "path");
    FILE *file = fopen(path, "wb");
    if (!file) return peri__fail(b, PERI_ERROR_WRITE, "path", -1, 0.0);
    int32_t status = peri_save_state_to(b, peri__to_file, file);
    if (fclose(file) != 0 && status == PERI_OK) status = peri__fail(b, PERI_ERROR_WRITE, "path", -1, 0.0);
    return status;
}

PERI_API int32_t peri_load_state(peri_body *b, const char *path) {
    PERI_NEED_IDLE(b);
    PERI_NEED(b, path, "path");
    FILE *file = fopen(path, "rb");
    if (!file) return peri__fail(b, PERI_ERROR_STATE, "path", -1, 0.0);
    const int32_t status = peri_load_state_from(b, peri__from_file, file);
    (void)fclose(file);
    return status;
}
#endif
