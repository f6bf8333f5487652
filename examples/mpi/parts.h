/* SPDX-License-Identifier: MIT */
/* parts.h - what the examples with MPI share: who owns which cell of a box, ghosts, the two hooks, output. A call that fails ends all. */
#ifndef PARTS_H
#define PARTS_H

#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../peri.h"

#define PART_FRAMES 500

typedef struct part {
    int      rank, ranks;
    int32_t  dim, deep; /* layers of ghosts */
    int64_t  cells[3], count, points;
    int     *owner;  /* [count] of each cell of the box */
    uint8_t *mine;   /* [count] 1: owned, 2: ghost */
    int64_t *ids;    /* [points] cell of each point */
    int32_t *ghosts; /* [ghost_count] points, by owners: sorted for peri_set_part */
    int64_t  ghost_count, sent;
    int32_t *send, *receive;         /* points to be sent, and received, by rank */
    int64_t *send_from, *receive_from; /* [ranks+1] */
    char    *out, *in;
    MPI_Request *request;
    double   time[PART_FRAMES]; /* of the frames written */
    int      frames;
} part;

static inline int64_t must(const peri_body *body, int64_t result) {
    peri_error error = {0, 0, -1, 0, "", ""};
    char text[256] = "";
    if (result >= 0) return result;
    if (body) (void)peri_get_error(body, &error);
    (void)peri_format_error(&error, text, (int64_t)sizeof text);
    fprintf(stderr, "error %ld: %s\n", (long)result, text);
    MPI_Abort(MPI_COMM_WORLD, 1);
    return result;
}

static inline void *room(int64_t count, size_t size) {
    void *made = calloc((size_t)count + 1, size);
    if (!made) MPI_Abort(MPI_COMM_WORLD, 1);
    return made;
}

/* Gives the cells lo..hi to the ranks first..last - 1: halves of the longest edge, as the numbers of ranks are. */
static inline void bisect(part *p, const int64_t *lo, const int64_t *hi, int first, int last) {
    int64_t middle_hi[3], middle_lo[3];
    int axis = 0;
    if (last - first == 1) {
        for (int64_t z = lo[2]; z < hi[2]; ++z)
            for (int64_t y = lo[1]; y < hi[1]; ++y)
                for (int64_t x = lo[0]; x < hi[0]; ++x) p->owner[(z * p->cells[1] + y) * p->cells[0] + x] = first;
        return;
    }
    for (int d = 1; d < p->dim; ++d)
        if (hi[d] - lo[d] > hi[axis] - lo[axis]) axis = d;
    memcpy(middle_hi, hi, sizeof middle_hi), memcpy(middle_lo, lo, sizeof middle_lo);
    const int half = (last - first) / 2;
    middle_hi[axis] = middle_lo[axis] = lo[axis] + (hi[axis] - lo[axis]) * half / (last - first);
    bisect(p, lo, middle_hi, first, first + half);
    bisect(p, middle_lo, hi, first + half, last);
}

/* Marks in taken[count] what rank `own` has: 1 its cells, 2 those up to `deep` cells away. */
static inline void mark(const part *p, int own, uint8_t *taken) {
    memset(taken, 0, (size_t)p->count);
    for (int64_t i = 0; i < p->count; ++i) {
        const int64_t x = i % p->cells[0], y = i / p->cells[0] % p->cells[1], z = i / p->cells[0] / p->cells[1], r = p->deep;
        if (p->owner[i] != own) continue;
        for (int64_t c = z - r; c <= z + r; ++c)
            for (int64_t b = y - r; b <= y + r; ++b)
                for (int64_t a = x - r; a <= x + r; ++a)
                    if (a >= 0 && b >= 0 && c >= 0 && a < p->cells[0] && b < p->cells[1] && c < p->cells[2]) {
                        const int64_t j = (c * p->cells[1] + b) * p->cells[0] + a;
                        taken[j] = p->owner[j] == own ? 1 : 2;
                    }
    }
}

/* The part of this process of a box of cells, with ghosts. Each process works out all lists: enough for a hundred of them. */
static inline void part_of_box(part *p, int32_t dim, const int64_t *cells, int32_t deep) {
    const int64_t lo[3] = {0, 0, 0};
    memset(p, 0, sizeof *p);
    MPI_Comm_rank(MPI_COMM_WORLD, &p->rank), MPI_Comm_size(MPI_COMM_WORLD, &p->ranks);
    p->dim = dim, p->deep = deep, p->cells[2] = 1;
    for (int d = 0; d < dim; ++d) p->cells[d] = cells[d];
    p->count = p->cells[0] * p->cells[1] * p->cells[2];
    p->owner = (int *)room(p->count, sizeof *p->owner);
    bisect(p, lo, p->cells, 0, p->ranks);
    p->mine = (uint8_t *)room(p->count, 1);
    uint8_t *taken = (uint8_t *)room(p->count, 1);
    int32_t *local = (int32_t *)room(p->count, sizeof *local);
    p->ids = (int64_t *)room(p->count, sizeof *p->ids);
    p->ghosts = (int32_t *)room(p->count, sizeof *p->ghosts);
    mark(p, p->rank, p->mine);
    for (int64_t i = 0; i < p->count; ++i) {
        if (!p->mine[i]) continue;
        if (p->mine[i] == 2) p->ghosts[p->ghost_count++] = (int32_t)p->points;
        local[i] = (int32_t)p->points;
        p->ids[p->points++] = i;
    }
    p->send_from = (int64_t *)room(p->ranks + 1, sizeof *p->send_from);
    p->receive_from = (int64_t *)room(p->ranks + 1, sizeof *p->receive_from);
    p->receive = (int32_t *)room(p->ghost_count, sizeof *p->receive);
    p->request = (MPI_Request *)room(2 * p->ranks, sizeof *p->request);
    for (int pass = 0; pass < 2; ++pass) { /* counts, then writes */
        if (pass) p->send = (int32_t *)room(p->sent, sizeof *p->send);
        p->sent = 0;
        for (int other = 0, received = 0; other < p->ranks; ++other) {
            mark(p, other, taken);
            for (int64_t i = 0; i < p->count; ++i) {
                if (p->owner[i] == other && p->mine[i] == 2) p->receive[received++] = local[i];
                if (taken[i] != 2 || p->owner[i] != p->rank) continue;
                if (pass) p->send[p->sent] = local[i];
                p->sent++;
            }
            p->send_from[other + 1] = p->sent, p->receive_from[other + 1] = received;
        }
    }
    free(taken), free(local);
}

static inline int32_t part_takes(void *user, int64_t index, const double *x) { return (void)x, ((const part *)user)->mine[index] != 0; }

static inline int32_t exchange(void *user, int32_t type, int32_t planes, void **plane) {
    part *p = (part *)user;
    const size_t size = type == PERI_TYPE_F32 ? 4 : 8, point = size * (size_t)planes;
    int requests = 0, failed = 0;
    if (!p->out) p->out = (char *)room(p->sent, 48), p->in = (char *)room(p->ghost_count, 48);
    for (int other = 0; other < p->ranks; ++other) {
        const int64_t from = p->receive_from[other], count = p->receive_from[other + 1] - from;
        if (count > 0)
            failed |= MPI_Irecv(p->in + (size_t)from * point, (int)((size_t)count * point), MPI_BYTE, other, 0, MPI_COMM_WORLD, &p->request[requests++]);
    }
    for (int64_t k = 0; k < p->sent; ++k)
        for (int32_t d = 0; d < planes; ++d)
            memcpy(p->out + (size_t)k * point + (size_t)d * size, (const char *)plane[d] + (size_t)p->send[k] * size, size);
    for (int other = 0; other < p->ranks; ++other) {
        const int64_t from = p->send_from[other], count = p->send_from[other + 1] - from;
        if (count > 0)
            failed |= MPI_Isend(p->out + (size_t)from * point, (int)((size_t)count * point), MPI_BYTE, other, 0, MPI_COMM_WORLD, &p->request[requests++]);
    }
    failed |= MPI_Waitall(requests, p->request, MPI_STATUSES_IGNORE);
    for (int64_t k = 0; k < p->ghost_count; ++k)
        for (int32_t d = 0; d < planes; ++d)
            memcpy((char *)plane[d] + (size_t)p->receive[k] * size, p->in + (size_t)k * point + (size_t)d * size, size);
    return failed ? -1 : 0;
}

static inline int32_t reduce(void *user, int32_t reduction, int64_t count, double *values) {
    const MPI_Op op = reduction == PERI_REDUCTION_SUM ? MPI_SUM : MPI_MAX;
    return (void)user, MPI_Allreduce(MPI_IN_PLACE, values, (int)count, MPI_DOUBLE, op, MPI_COMM_WORLD) == MPI_SUCCESS ? 0 : -1;
}

static inline void part_set(part *p, peri_body *b, const double *origin, double length, double mean_volume) {
    peri_part_desc desc;
    peri_part_desc_init(&desc);
    memcpy(desc.origin, origin, (size_t)p->dim * sizeof *origin);
    desc.length = length, desc.mean_volume = mean_volume;
    desc.ghost_count = p->ghost_count, desc.ghosts = p->ghosts, desc.ids = p->ids;
    desc.exchange = exchange, desc.reduce = reduce, desc.user = p;
    must(b, peri_set_part(b, &desc));
}

/* NAME_RANK.vtu, and NAME.pvtu, which has them all: ParaView opens that. */
static inline void part_show(const part *p, peri_body *b, const char *name) {
    char path[300];
    (void)snprintf(path, sizeof path, "%s_%d.vtu", name, p->rank);
    must(b, peri_export_vtu(b, path));
    (void)snprintf(path, sizeof path, "%s.pvtu", name);
    FILE *file = p->rank == 0 ? fopen(path, "w") : NULL;
    const char *base = strrchr(name, '/') ? strrchr(name, '/') + 1 : name;
    if (file) fprintf(file, "<?xml version=\"1.0\"?>\n<VTKFile type=\"PUnstructuredGrid\">\n<PUnstructuredGrid>\n<PPoints><PDataArray type=\"Float64\" "
                            "NumberOfComponents=\"3\"/></PPoints>\n<PPointData>"
                            "<PDataArray type=\"Float64\" Name=\"displacement\" NumberOfComponents=\"3\"/>"
                            "<PDataArray type=\"Float64\" Name=\"damage\"/><PDataArray type=\"Float64\" Name=\"fragment\"/></PPointData>\n");
    for (int k = 0; file && k < p->ranks; ++k) fprintf(file, "<Piece Source=\"%s_%d.vtu\"/>\n", base, k);
    if (file) fprintf(file, "</PUnstructuredGrid>\n</VTKFile>\n"), (void)fclose(file);
}

/* The next of a series: NAME_000, NAME_001, ...; NAME.pvd has them all with their times. */
static inline void part_frame(part *p, peri_body *b, const char *name) {
    char path[256];
    const char *base = strrchr(name, '/') ? strrchr(name, '/') + 1 : name;
    if (p->frames == PART_FRAMES) return;
    (void)snprintf(path, sizeof path, "%s_%03d", name, p->frames);
    part_show(p, b, path);
    p->time[p->frames++] = peri_time(b);
    (void)snprintf(path, sizeof path, "%s.pvd", name);
    FILE *file = p->rank == 0 ? fopen(path, "w") : NULL;
    if (file) fprintf(file, "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\">\n<Collection>\n");
    for (int k = 0; file && k < p->frames; ++k) fprintf(file, "<DataSet timestep=\"%.9g\" file=\"%s_%03d.pvtu\"/>\n", p->time[k], base, k);
    if (file) fprintf(file, "</Collection>\n</VTKFile>\n"), (void)fclose(file);
}

/* NAME.bin: dim components of displacement and the damage of each cell, in the order of the cells. */
static inline void part_write(const part *p, peri_body *b, const char *name) {
    const int32_t width = p->dim + 1;
    double *u = (double *)room(p->points * p->dim, sizeof *u), *damage = (double *)room(p->points, sizeof *damage);
    double *own = (double *)room(p->count * width, sizeof *own), *all = (double *)room(p->count * width, sizeof *all);
    char path[256];
    must(b, peri_get_field(b, PERI_FIELD_DISPLACEMENT, u, p->points * p->dim));
    must(b, peri_get_field(b, PERI_FIELD_DAMAGE, damage, p->points));
    for (int64_t k = 0; k < p->points; ++k) {
        if (p->mine[p->ids[k]] != 1) continue;
        memcpy(own + p->ids[k] * width, u + k * p->dim, (size_t)p->dim * sizeof *u);
        own[p->ids[k] * width + p->dim] = damage[k];
    }
    MPI_Reduce(own, all, (int)(p->count * width), MPI_DOUBLE, MPI_SUM, 0, MPI_COMM_WORLD); /* one is no 0 */
    (void)snprintf(path, sizeof path, "%s.bin", name);
    FILE *file = p->rank == 0 ? fopen(path, "wb") : NULL;
    if (file) (void)fwrite(all, sizeof *all, (size_t)(p->count * width), file), (void)fclose(file);
    free(u), free(damage), free(own), free(all);
}

static inline void part_free(part *p) {
    free(p->owner), free(p->mine), free(p->ids), free(p->ghosts), free(p->send), free(p->receive), free(p->send_from);
    free(p->receive_from), free(p->out), free(p->in), free(p->request);
}

#endif
