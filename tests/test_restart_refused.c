/* SPDX-License-Identifier: MIT */
/* States that are not taken: of other scenes, damaged, cut short; where the callback or memory fails.

   SOURCE OF TRUTH: a state is taken whole or not at all: after each refusal the body is what a clone of it is, to the last bit. */
#include "refusal.h"
#include "restart_scene.h"

/* Four by four points: a file of less than 5 kB. */
static specimen little(void) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, 0.2, 0.37, 2.1, 4, 4, 0);
    s.material.critical_stretch = 0.003;
    return s;
}
static peri_body *little_body(const specimen *s) {
    const double lo[2] = { 0, 0 }, hi[2] = { 0.5, 2 }, push[2] = { 0.02, 0.01 }, pull[2] = { -0.1, 0 };
    const double place[2] = { 0, -0.1 }, up[2] = { 0, 1 };
    peri_body *b = specimen_make(s);
    const int32_t set = (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi));
    (void)MUST(b, peri_prescribe_velocity(b, set, PERI_AXIS_X, pull, NULL, NULL));
    (void)MUST(b, plane_obstacle(b, place, up, 0, NULL, NULL));
    (void)MUST(b, peri_add_velocity(b, PERI_ALL, push));
    return b;
}

/* ---- damage -------------------------------------------------------------------------------------------------------- */

static uint64_t as_is(peri_body *b) { /* some of what shows at once if anything is taken */
    double u[32], t = peri_time(b);
    uint64_t h = 0, word;
    (void)MUST(b, peri_get_field(b, PERI_FIELD_DISPLACEMENT, u, 32));
    for (int k = 0; k < 32; ++k) memcpy(&word, &u[k], 8), h = h * 31 + word;
    memcpy(&word, &t, 8);
    return h * 31 + word + (uint64_t)peri_broken_count(b);
}

typedef struct damaged {
    buffer     file, copy;
    peri_body *body, *still;
    uint64_t   before;
} damaged;
static damaged start(void) {
    const specimen s = little();
    damaged d = { { NULL, 0, 0, 0 }, { NULL, 0, 0, 0 }, NULL, NULL, 0 };
    peri_body *from = little_body(&s);
    scene_run(from, 25);
    CHECK(peri_broken_count(from) > 0);
    save(from, &d.file);
    peri_body_destroy(from);
    CHECK(d.file.count < 5000);
    d.copy.data = (unsigned char *)malloc((size_t)d.file.count * 2);
    d.body = little_body(&s);
    scene_run(d.body, 3);
    (void)MUST(NULL, peri_body_clone(d.body, &d.still, NULL));
    d.before = as_is(d.body);
    return d;
}
static void end(damaged *d) {
    CHECK(same_state(d->body, d->still));
    (void)MUST(d->body, load(d->body, &d->file)); /* and the sound one is taken */
    CHECK(as_is(d->body) != d->before);
    peri_body_destroy(d->body);
    peri_body_destroy(d->still);
    free(d->file.data);
    free(d->copy.data);
}
static void refused(damaged *d) {
    peri_error e;
    const int32_t status = load(d->body, &d->copy);
    CHECK(status == PERI_ERROR_STATE && as_is(d->body) == d->before);
    CHECK(peri_get_error(d->body, &e) == PERI_OK && e.code == status && e.value >= 0 && e.value <= (double)d->copy.count);
}

static void every_byte_and_every_length(void) {
    damaged d = start();
    for (int64_t k = 0; k < d.file.count; ++k) {
        memcpy(d.copy.data, d.file.data, (size_t)d.file.count);
        d.copy.count = d.file.count;
        d.copy.data[k] = (unsigned char)(d.copy.data[k] ^ (k % 3 ? 1u << k % 8 : 0xFFu));
        refused(&d);
        memcpy(d.copy.data, d.file.data, (size_t)d.file.count);
        d.copy.count = k;
        refused(&d);
    }
    end(&d);
}

/* Several bytes, words in another order, a part of the file repeated, left out, or put elsewhere. */
static void mutate(damaged *d, uint64_t *seed) {
    const int64_t n = d->file.count, from = (int64_t)(test_random(seed) * (double)(n / 8)) * 8;
    const int64_t to = (int64_t)(test_random(seed) * (double)(n / 8)) * 8, part = 8 + (int64_t)(test_random(seed) * 40) * 8;
    const int way = (int)(test_random(seed) * 5);
    memcpy(d->copy.data, d->file.data, (size_t)n);
    d->copy.count = n;
    if (way == 0)
        for (int k = 0; k < 4; ++k) d->copy.data[(int64_t)(test_random(seed) * (double)n)] = (unsigned char)(256 * test_random(seed));
    else if (way == 1) {
        memcpy(d->copy.data + from, d->file.data + to, 8);
        memcpy(d->copy.data + to, d->file.data + from, 8);
    } else if (way == 2) {
        const int64_t length = from + part < n ? part : n - from;
        memmove(d->copy.data + from + length, d->copy.data + from, (size_t)(n - from));
        d->copy.count = n + length;
    } else if (way == 3) {
        const int64_t length = from + part < n ? part : n - from;
        memmove(d->copy.data + from, d->copy.data + from + length, (size_t)(n - from - length));
        d->copy.count = n - length;
    } else {
        const int64_t length = from + part < n && to + part < n ? part : 8;
        memmove(d->copy.data + to, d->file.data + from, (size_t)length);
    }
    if (d->copy.count >= n && memcmp(d->copy.data, d->file.data, (size_t)n) == 0) d->copy.data[from] ^= 1; /* none was made */
}
static void mutants(int64_t count, uint64_t seed) {
    damaged d = start();
    for (int64_t k = 0; k < count; ++k) {
        mutate(&d, &seed);
        refused(&d);
    }
    end(&d);
}
static void some_mutants(void) { mutants(5000, 1); }
static void a_million_mutants(void) { mutants(1000000, 2); }

/* ---- other scenes ---------------------------------------------------------------------------------------------------- */

static buffer file;
static void foreign(peri_body *b, const char *field) {
    peri_body *still = NULL;
    (void)MUST(NULL, peri_body_clone(b, &still, NULL));
    REFUSE(b, PERI_ERROR_STATE, load(b, &file));
    if (!seen.field || strcmp(seen.field, field) != 0) {
        test_bad++;
        printf("    expected %s, got %s\n", field, seen.field ? seen.field : "nothing");
    }
    CHECK(same_state(b, still));
    peri_body_destroy(b);
    peri_body_destroy(still);
}

static void other_scenes(void) {
    const double by[2] = { 0.1, 0 }, place[2] = { 0, -0.1 }, up[2] = { 0, 1 };
    const specimen s = little();
    specimen o;
    peri_body *b = little_body(&s);
    save(b, &file);
    peri_body_destroy(b);
    o = s, o.hi[0] += 0.37, foreign(little_body(&o), "points");
    o = s, o.scatter = 0.01, foreign(little_body(&o), "points");
    o = s, o.lo[0] += 4e-3, o.hi[0] += 4e-3, foreign(little_body(&o), "points");
    o = s, o.desc.horizon *= 1.2, foreign(little_body(&o), "families");
    o = s, o.desc.influence = PERI_INFLUENCE_LINEAR, foreign(little_body(&o), "families");
    o = s, o.material.young *= 1.01, foreign(little_body(&o), "materials");
    o = s, o.material.poisson = 0.21, foreign(little_body(&o), "materials");
    o = s, o.material.critical_stretch *= 2, foreign(little_body(&o), "materials");
    o = s, o.desc.thickness = 2, foreign(little_body(&o), "peri_body_desc");
    o = s, o.desc.precision = PERI_PRECISION_MIXED, foreign(little_body(&o), "peri_body_desc");
    o = s, o.desc.geometry = PERI_GEOMETRY_LINEAR, foreign(little_body(&o), "peri_body_desc");
    o = s, o.desc.break_timing = PERI_BREAK_AFTER_DRIFT, foreign(little_body(&o), "peri_body_desc");
    b = little_body(&s), (void)MUST(b, peri_apply_body_force(b, PERI_ALL, by, NULL, NULL)), foreign(b, "loads");
    b = little_body(&s), (void)MUST(b, peri_remove_load(b, peri_id(b, PERI_KIND_LOAD, 1))), foreign(b, "loads");
    b = little_body(&s), (void)MUST(b, plane_obstacle(b, place, up, 0, NULL, NULL)), foreign(b, "obstacles");
    b = little_body(&s), (void)MUST(b, peri_set_no_fail(b, peri_id(b, PERI_KIND_SET, 1), 1)), foreign(b, "peri_set_no_fail");
    peri_contact_desc c;
    peri_contact_desc_init(&c);
    b = little_body(&s), (void)MUST(b, peri_set_contact(b, PERI_ALL, PERI_ALL, &c)), foreign(b, "peri_set_contact");
    file.data[8] ^= 3; /* a later version */
    foreign(little_body(&s), "version");
    file.data[8] ^= 3;
    for (int64_t k = 0; k < file.count; k += 8)
        for (int n = 0; n < 4; ++n) {
            const unsigned char byte = file.data[k + n];
            file.data[k + n] = file.data[k + 7 - n];
            file.data[k + 7 - n] = byte;
        }
    b = little_body(&s);
    CHECK(load(b, &file) == PERI_ERROR_STATE);
    peri_body_destroy(b);
    free(file.data);
}

/* ---- what fails ------------------------------------------------------------------------------------------------------- */

static int64_t calls_left;
static int32_t fail_write(void *user, const void *from, int64_t count) { return calls_left-- > 0 ? write_bytes(user, from, count) : -3; }
static int32_t fail_read(void *user, void *to, int64_t count) { return calls_left-- > 0 ? read_bytes(user, to, count) : -3; }
static int32_t nosy_write(void *user, const void *from, int64_t count) { /* may read the body, and change nothing */
    (void)from, (void)count;
    CHECK(peri_reset((peri_body *)user) == PERI_ERROR_ORDER && peri_time((peri_body *)user) > 0);
    return 0;
}

static void callbacks_that_fail(void) {
    const specimen s = little();
    buffer sound = { NULL, 0, 0, 0 }, part = { NULL, 0, 0, 0 };
    peri_body *a = little_body(&s), *b = little_body(&s), *still = NULL;
    scene_run(a, 15);
    save(a, &sound);
    (void)MUST(NULL, peri_body_clone(b, &still, NULL));
    int32_t status = PERI_ERROR_WRITE;
    int64_t most = 0;
    for (; status < 0 && most < 200; ++most) {
        calls_left = most;
        part.count = 0;
        status = peri_save_state_to(a, fail_write, &part);
        if (status < 0) REFUSE(a, PERI_ERROR_WRITE, status);
    }
    CHECK(most > 20 && part.count == sound.count && memcmp(part.data, sound.data, (size_t)part.count) == 0);
    for (int64_t k = 0; k < most - 1; ++k) {
        calls_left = k;
        sound.at = 0;
        const int32_t said = peri_load_state_from(b, fail_read, &sound);
        if (said < 0) REFUSE(b, PERI_ERROR_STATE, said);
        if (said == PERI_OK) break;
        CHECK(seen.value == (double)sound.at);
        FIELD_IS("peri_read_fn");
    }
    CHECK(same_state(b, still) || same_state(b, a));
    peri_body_destroy(b);
    b = little_body(&s);
    calls_left = 7;
    sound.at = 0;
    REFUSE(b, PERI_ERROR_STATE, peri_load_state_from(b, fail_read, &sound));
    CHECK(same_state(b, still));
    (void)MUST(a, peri_save_state_to(a, nosy_write, a));
    REFUSE(a, PERI_ERROR_ARGUMENT, peri_save_state_to(a, NULL, NULL));
    REFUSE(a, PERI_ERROR_ARGUMENT, peri_load_state_from(a, NULL, NULL));
    peri_body_destroy(a);
    peri_body_destroy(b);
    peri_body_destroy(still);
    free(sound.data);
    free(part.data);
}

static int64_t grants;
static void *grant(void *user, uint64_t size) {
    (void)user;
    return grants-- > 0 ? malloc((size_t)size) : NULL;
}
static void take_back(void *user, void *pointer, uint64_t size) {
    (void)user, (void)size;
    free(pointer);
}

/* Into a body without flags of bonds, which it takes: each allocation fails once, and then none. */
static void short_memory(void) {
    const double from[2] = { 0.8, -1 }, to[2] = { 0.8, 1 };
    buffer cut = { NULL, 0, 0, 0 };
    specimen s = little();
    s.material.critical_stretch = 0;
    s.desc.allocate = grant;
    s.desc.release = take_back;
    grants = 1000000;
    peri_body *a = little_body(&s), *b = little_body(&s), *still = NULL;
    (void)MUST(a, peri_cut_segment(a, PERI_CUT_INITIAL, from, to));
    scene_run(a, 5);
    grants = 0;
    REFUSE(a, PERI_ERROR_MEMORY, peri_save_state_to(a, write_bytes, &cut));
    CHECK(cut.count == 0);
    grants = 1000000;
    save(a, &cut);
    (void)MUST(NULL, peri_body_clone(b, &still, NULL));
    int32_t status = PERI_ERROR_MEMORY;
    int64_t most = 0;
    for (; status == PERI_ERROR_MEMORY && most < 20; ++most) {
        peri_memory m[2];
        grants = most;
        (void)MUST(b, peri_get_memory(b, &m[0]));
        status = load(b, &cut);
        grants = 1000000;
        (void)MUST(b, peri_get_memory(b, &m[1]));
        if (status < 0) CHECK(memcmp(&m[0], &m[1], sizeof m[0]) == 0 && same_state(b, still));
    }
    CHECK(status == PERI_OK && most > 4 && same_state(a, b));
    peri_body_destroy(a);
    peri_body_destroy(b);
    peri_body_destroy(still);
    free(cut.data);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(every_byte_and_every_length);
    RUN(some_mutants);
    LONG_RUN(a_million_mutants);
    RUN(other_scenes);
    RUN(callbacks_that_fail);
    RUN(short_memory);
    return test_end("test_restart_refused");
}
