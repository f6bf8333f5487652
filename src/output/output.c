/* SPDX-License-Identifier: MIT */
/* output.c - VTU for ParaView and CSV histories, through a write callback. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

typedef struct peri__writer {
    peri_body    *body;
    peri_write_fn write;
    void         *user;
    int32_t       failed;
    int64_t       used;
    char          buffer[4096];
} peri__writer;

static void peri__flush(peri__writer *w) {
    const int32_t former = peri__enter(w->body, PERI__IN_CALLBACK);
    if (w->used > 0 && !w->failed && w->write(w->user, w->buffer, w->used) != 0) w->failed = 1;
    peri__leave(w->body, former);
    w->used = 0;
}

static void peri__emit(peri__writer *w, const void *bytes, size_t count) {
    const char *from = (const char *)bytes;
    while (count > 0) {
        size_t room = sizeof w->buffer - (size_t)w->used, part = count < room ? count : room;
        memcpy(w->buffer + w->used, from, part);
        w->used += (int64_t)part;
        from += part;
        count -= part;
        if (w->used == (int64_t)sizeof w->buffer) peri__flush(w);
    }
}

static void peri__emit_text(peri__writer *w, const char *text) { peri__emit(w, text, strlen(text)); }

static void peri__emit_integer(peri__writer *w, int64_t value) {
    char text[32] = "";
    peri__emit(w, text, (size_t)(peri__put_integer(text, value) - text));
}

static int32_t peri__finish(peri_body *b, peri__writer *w) {
    peri__flush(w);
    return w->failed ? peri__fail(b, PERI_ERROR_WRITE, "write", -1, 0.0) : PERI_OK;
}

/* ---- VTU ---------------------------------------------------------------------------------------------------------- */

static const int32_t peri__vtu_fields[] = { PERI_FIELD_DISPLACEMENT, PERI_FIELD_VELOCITY, PERI_FIELD_DAMAGE, PERI_FIELD_ENERGY_DENSITY,
                                            PERI_FIELD_MATERIAL, PERI_FIELD_VOLUME, PERI_FIELD_STRESS, PERI_FIELD_FRAGMENT };
#define PERI_VTU_FIELDS (sizeof peri__vtu_fields / sizeof *peri__vtu_fields)

/* As in 3D, whatever the space: vectors have z = 0 in 2D, tensors are xx yy zz xy yz xz. */
static int32_t peri__vtu_components(int32_t field) { return peri__components(field, 3); }

/* The opening tag of an appended array, and the offset of the one after it (8 bytes of length, then the data). */
static int64_t peri__emit_array(peri__writer *w, const char *type, const char *name, int32_t components, int64_t offset,
                                int64_t bytes) {
    peri__emit_text(w, "<DataArray type=\"");
    peri__emit_text(w, type);
    peri__emit_text(w, "\" Name=\"");
    peri__emit_text(w, name);
    peri__emit_text(w, "\" NumberOfComponents=\"");
    peri__emit_integer(w, components);
    peri__emit_text(w, "\" format=\"appended\" offset=\"");
    peri__emit_integer(w, offset);
    peri__emit_text(w, "\"/>\n");
    return offset + 8 + bytes;
}

static void peri__emit_length(peri__writer *w, int64_t bytes) {
    uint64_t length = (uint64_t)bytes;
    peri__emit(w, &length, sizeof length);
}

/* The fragment of each point, known before anything is written. A body that was never asked for them keeps nothing. Parts have none: 0 of
   points that are owned, and -1 of ghosts, to tell them apart by. */
static int32_t peri__fill_fragments(peri_body *b, double *out) {
    const int known = b->fragment_of != NULL;
    for (int64_t i = 0; b->model->part && i < b->model->points; ++i) out[i] = -peri__is_ghost(b->model, i);
    const int32_t status = b->model->part ? PERI_OK : peri__label_fragments(b);
    if (status < 0 || b->model->part) return status;
    peri__compute(b, PERI_FIELD_FRAGMENT, out);
    peri__forget_fragments(b, known);
    return PERI_OK;
}

/* `values` is scratch for one field; or holds the fragments. */
static void peri__emit_field(peri_body *b, peri__writer *w, int32_t field, double *values) {
    static const int32_t plane[6] = { 0, 1, 3, 2, 3, 3 }; /* of a tensor xx yy xy; 3: none                                */
    int32_t have = peri__components(field, b->dim), components = peri__vtu_components(field);
    const double zero = 0.0;
    if (field != PERI_FIELD_FRAGMENT) peri__compute(b, field, values);
    peri__emit_length(w, b->model->points * components * 8);
    for (int64_t i = 0; i < b->model->points; ++i)
        for (int32_t d = 0; d < components; ++d) {
            int32_t from = components == 6 && b->dim == 2 ? plane[d] : d;
            peri__emit(w, from < have ? &values[i * have + from] : &zero, sizeof zero);
        }
}

PERI_API int32_t peri_export_vtu_to(peri_body *b, peri_write_fn write, void *user) {
    peri__writer w;
    const uint16_t endian = 1;
    int64_t n, offset = 0;
    PERI_NEED_BUILT(b);
    PERI_NEED(b, write, "write");
    n = b->model->points;
    const int64_t room = n * (PERI_PACKED(b->dim) + 1);
    double *values = (double *)peri__new(&b->scratch, room, sizeof(double));
    if (!values) return peri__fail(b, PERI_ERROR_MEMORY, "peri_export_vtu_to", -1, 0.0);
    double *fragments = values + n * PERI_PACKED(b->dim);
    const int32_t status = peri__fill_fragments(b, fragments);
    if (status < 0) {
        peri__delete(&b->scratch, values, room, sizeof(double));
        return status;
    }
    w.body = b;
    w.write = write;
    w.user = user;
    w.failed = 0;
    w.used = 0;

    peri__emit_text(&w, "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"");
    peri__emit_text(&w, *(const uint8_t *)&endian ? "LittleEndian" : "BigEndian");
    peri__emit_text(&w, "\" header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"");
    peri__emit_integer(&w, n);
    peri__emit_text(&w, "\" NumberOfCells=\"");
    peri__emit_integer(&w, n);
    peri__emit_text(&w, "\">\n<Points>\n");
    offset = peri__emit_array(&w, "Float64", "position", 3, offset, n * 24);
    peri__emit_text(&w, "</Points>\n<PointData Scalars=\"damage\" Vectors=\"displacement\">\n");
    for (size_t k = 0; k < PERI_VTU_FIELDS; ++k) {
        const int32_t field = peri__vtu_fields[k], components = peri__vtu_components(field);
        offset = peri__emit_array(&w, "Float64", peri__fields[field - peri__first_field].name, components, offset, n * 8 * components);
    }
    peri__emit_text(&w, "</PointData>\n<Cells>\n");
    offset = peri__emit_array(&w, "Int32", "connectivity", 1, offset, n * 4);
    offset = peri__emit_array(&w, "Int32", "offsets", 1, offset, n * 4);
    (void)peri__emit_array(&w, "UInt8", "types", 1, offset, n);
    peri__emit_text(&w, "</Cells>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_");

    peri__emit_field(b, &w, PERI_FIELD_POSITION, values);
    for (size_t k = 0; k < PERI_VTU_FIELDS; ++k) {
        const int32_t field = peri__vtu_fields[k];
        peri__emit_field(b, &w, field, field == PERI_FIELD_FRAGMENT ? fragments : values);
    }
    for (int32_t ends = 0; ends < 2; ++ends) { /* each point is a cell of its own: VTK_VERTEX */
        peri__emit_length(&w, n * 4);
        for (int32_t i = 0; i < (int32_t)n; ++i) {
            int32_t id = i + ends;
            peri__emit(&w, &id, sizeof id);
        }
    }
    peri__emit_length(&w, n);
    for (int64_t i = 0; i < n; ++i) {
        const uint8_t vertex = 1;
        peri__emit(&w, &vertex, 1);
    }
    peri__emit_text(&w, "\n</AppendedData>\n</VTKFile>\n");
    peri__delete(&b->scratch, values, room, sizeof(double));
    return peri__finish(b, &w);
}

/* ---- CSV ---------------------------------------------------------------------------------------------------------- */

PERI_API int32_t peri_export_history_to(peri_body *b, int32_t header, peri_write_fn write, void *user) {
    peri__writer w;
    peri_energy e;
    PERI_NEED_BUILT(b);
    PERI_NEED_FLAG(b, header);
    PERI_NEED(b, write, "write");
    int32_t status = peri_get_energy(b, &e);
    if (status < 0) return status;
    w.body = b;
    w.write = write;
    w.user = user;
    w.failed = 0;
    w.used = 0;
    if (header)
        peri__emit_text(&w, "step,time,kinetic,elastic,contact,external,obstacle,damping,fracture,initial,error,broken,cut\n");
    const double numbers[10] = { peri_time(b), e.kinetic,  e.elastic,  e.contact, e.external,
                                 e.obstacle,   e.damping,  e.fracture, e.initial, e.error };
    peri__emit_integer(&w, b->now.steps);
    for (int k = 0; k < 10; ++k) {
        char text[40] = "";
        peri__emit_text(&w, ",");
        peri__emit(&w, text, (size_t)(peri__put_double(text, numbers[k]) - text));
    }
    peri__emit_text(&w, ",");
    peri__emit_integer(&w, peri_broken_count(b));
    peri__emit_text(&w, ",");
    peri__emit_integer(&w, peri_cut_count(b));
    peri__emit_text(&w, "\n");
    return peri__finish(b, &w);
}

#ifndef PERI_NO_STDIO
/* Opens path, writes a VTU (history = 0) or a line of history, closes. */
static int32_t peri__save(peri_body *b, const char *path, const char *mode, int history) {
    PERI_NEED_BUILT(b);
    PERI_NEED(b, path, "path");
    FILE *file = fopen(path, mode);
    if (!file) return peri__fail(b, PERI_ERROR_WRITE, "path", -1, 0.0);
    int32_t status = history ? peri_export_history_to(b, mode[0] == 'w', peri__to_file, file)
                             : peri_export_vtu_to(b, peri__to_file, file);
    if (fclose(file) != 0 && status == PERI_OK) status = peri__fail(b, PERI_ERROR_WRITE, "path", -1, 0.0);
    return status;
}

PERI_API int32_t peri_export_vtu(peri_body *b, const char *path) { return peri__save(b, path, "wb", 0); }

PERI_API int32_t peri_export_history(peri_body *b, const char *path, int32_t append) {
    PERI_NEED_BUILT(b);
    PERI_NEED_FLAG(b, append);
    return peri__save(b, path, append ? "ab" : "wb", 1);
}
#endif
