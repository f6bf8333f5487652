/* SPDX-License-Identifier: MIT */
/* memory.c - the allocator hook. Every allocation of the library goes through peri__new and can fail.
   Blocks are aligned to 64 bytes on top of whatever the hook returns; the hook's own pointer is kept just before them. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_ALIGN 64

static void *peri__malloc(void *user, uint64_t bytes) {
    (void)user;
    return bytes > SIZE_MAX ? NULL : malloc((size_t)bytes);
}

static void peri__free(void *user, void *pointer, uint64_t bytes) {
    (void)user;
    (void)bytes;
    free(pointer);
}

/* Before a block lies what the hook gave. Blocks that a call takes for itself also know each other: where a callback leaves the call by a
   jump, peri_unlock finds them by that. */
struct peri__taken {
    peri__taken *next;
    uint64_t     bytes;
    void        *raw;
};

/* What the hook is asked for where count items of size bytes are wanted, of those that stay; and of those of calls. */
static uint64_t peri__block_bytes(int64_t count, size_t size) { return (uint64_t)count * size + PERI_ALIGN + sizeof(void *); }
static uint64_t peri__scratch_bytes(int64_t count, size_t size) { return (uint64_t)count * size + PERI_ALIGN + sizeof(peri__taken); }

static peri__taken *peri__head_of(void *block) { return (peri__taken *)((uintptr_t)block - sizeof(peri__taken)); }

/* Memory for count items of size bytes, as the hook gives it; NULL where that fails or the size does not fit. count 0 gives a block. */
static void *peri__new_unset(const peri__memory *memory, int64_t count, size_t size) {
    if (count < 0 || (uint64_t)count > ((uint64_t)SIZE_MAX / 2 - PERI_ALIGN * 2) / size) return NULL;
    const size_t head = memory->taken ? sizeof(peri__taken) : sizeof(void *);
    const uint64_t bytes = memory->taken ? peri__scratch_bytes(count, size) : peri__block_bytes(count, size);
    void *raw = memory->allocate(memory->user, bytes);
    if (!raw) return NULL;
    const uintptr_t place = ((uintptr_t)raw + head + PERI_ALIGN - 1) & ~(uintptr_t)(PERI_ALIGN - 1);
    if (!memory->taken) {
        memcpy((void *)(place - sizeof(void *)), &raw, sizeof raw);
        return (void *)place;
    }
    peri__taken *taken = peri__head_of((void *)place);
    taken->next = *memory->taken;
    taken->bytes = bytes;
    taken->raw = raw;
    *memory->taken = taken;
    return (void *)place;
}

/* The same, all zero. */
static void *peri__new(const peri__memory *memory, int64_t count, size_t size) {
    void *made = peri__new_unset(memory, count, size);
    if (made) memset(made, 0, (size_t)count * size);
    return made;
}

/* The same, the last `rest` items zero: for large arrays of which all others are written before they are read. */
static void *peri__new_tail(const peri__memory *memory, int64_t count, size_t size, int64_t rest) {
    char *made = (char *)peri__new_unset(memory, count, size);
    if (made) memset(made + (size_t)(count - rest) * size, 0, (size_t)rest * size);
    return made;
}

/* Gives back a block of a call: mostly one of the last that were taken. */
static void peri__delete_taken(const peri__memory *memory, peri__taken *taken) {
    peri__taken **at = memory->taken;
    while (*at != taken) at = &(*at)->next;
    *at = taken->next;
    memory->release(memory->user, taken->raw, taken->bytes);
}

/* Gives back all of them. */
static void peri__delete_all_taken(const peri__memory *memory) {
    while (*memory->taken) peri__delete_taken(memory, *memory->taken);
}

/* count and size as at peri__new. */
static void peri__delete(const peri__memory *memory, void *pointer, int64_t count, size_t size) {
    void *raw;
    if (!pointer) return;
    if (memory->taken) {
        peri__delete_taken(memory, peri__head_of(pointer));
        return;
    }
    memcpy(&raw, (void *)((uintptr_t)pointer - sizeof(void *)), sizeof raw);
    memory->release(memory->user, raw, peri__block_bytes(count, size));
}

static void *peri__copy(const peri__memory *memory, const void *from, int64_t count, size_t size) {
    void *to = peri__new_unset(memory, count, size);
    if (to && count > 0) memcpy(to, from, (size_t)count * size);
    return to;
}

/* Makes room for `need` items in a growing array; 0 where memory is short, the array then being as it was. */
static int peri__grow(const peri__memory *memory, void *array_pointer, int64_t *capacity, int64_t need, size_t size) {
    void *old, *grown;
    if (need <= *capacity) return 1;
    int64_t room = *capacity < 8 ? 8 : *capacity;
    while (room < need) room = room > INT64_MAX / 2 ? need : room * 2;
    grown = peri__new(memory, room, size);
    if (!grown) return 0;
    memcpy(&old, array_pointer, sizeof old);
    if (old) memcpy(grown, old, (size_t)*capacity * size);
    peri__delete(memory, old, *capacity, size);
    memcpy(array_pointer, &grown, sizeof grown);
    *capacity = room;
    return 1;
}

/* Users of a shared model. Clones may be destroyed on different threads, so the count is atomic where the compiler offers it. */
#if defined(__GNUC__) || defined(__clang__)
static int32_t peri__count_users(volatile int32_t *users, int32_t change) {
    return __atomic_add_fetch(users, change, __ATOMIC_ACQ_REL);
}
#elif defined(_MSC_VER)
#include <intrin.h>
static int32_t peri__count_users(volatile int32_t *users, int32_t change) {
    return (int32_t)_InterlockedExchangeAdd((volatile long *)users, change) + change;
}
#else
static int32_t peri__count_users(volatile int32_t *users, int32_t change) { return *users += change; }
#endif
