/* SPDX-License-Identifier: MIT */
/* output.c - VTU for ParaView, series of these, and CSV histories. */
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
#define PERI_VTU_FIELDS ((int64_t)(sizeof peri__vtu_fields / sizeof *peri__vtu_fields))

typedef struct peri__vtu { /* which fields a file has                                                                     */
    const int32_t *fields;
    int64_t        count, room; /* room: of `values`                                                                     */
    double        *values;      /* scratch for one field                                                                 */
    double        *fragments;   /* [points], behind it; NULL where they are not asked for                                 */
    int32_t        status;      /* of what the caller's laws made of fields                                               */
} peri__vtu;

/* As in 3D, whatever the space: vectors have z = 0 in 2D, tensors are xx yy zz xy yz xz, the deformation gradient is 1 in z. */
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

/* Which component in 2D is that in 3D, of a tensor xx yy xy or of a gradient by rows; -1: none, 0, and -2: 1. */
static int32_t peri__plane_component(int32_t components, int32_t d) {
    static const int32_t tensor[6] = { 0, 1, -1, 2, -1, -1 }, gradient[9] = { 0, 1, -1, 2, 3, -1, -1, -1, -2 };
    return components == 9 ? gradient[d] : components == 6 ? tensor[d] : d;
}

static void peri__emit_field(peri_body *b, peri__writer *w, int32_t field, peri__vtu *vtu) {
    const int32_t have = peri__components(field, b->dim), components = peri__vtu_components(field);
    const double fixed[2] = { 0.0, 1.0 }, *values = field == PERI_FIELD_FRAGMENT ? vtu->fragments : vtu->values;
    const int32_t status = field == PERI_FIELD_FRAGMENT ? PERI_OK : peri__compute(b, field, vtu->values);
    if (vtu->status == PERI_OK) vtu->status = status;
    peri__emit_length(w, b->model->points * components * 8);
    for (int64_t i = 0; i < b->model->points; ++i)
        for (int32_t d = 0; d < components; ++d) {
            const int32_t from = b->dim == 2 ? peri__plane_component(components, d) : d;
            peri__emit(w, from >= 0 && from < have ? &values[i * have + from] : &fixed[from == -2], sizeof *fixed);
        }
}

static void peri__begin_writer(peri__writer *w, peri_body *b, peri_write_fn write, void *user) {
    w->body = b;
    w->write = write;
    w->user = user;
    w->failed = 0;
    w->used = 0;
}

static int peri__vtu_has(const peri__vtu *vtu, int32_t field) {
    for (int64_t k = 0; k < vtu->count; ++k)
        if (vtu->fields[k] == field) return 1;
    return 0;
}

static void peri__emit_head(peri_body *b, peri__writer *w, const peri__vtu *vtu) {
    const uint16_t endian = 1;
    const int64_t n = b->model->points;
    peri__emit_text(w, "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"");
    peri__emit_text(w, *(const uint8_t *)&endian ? "LittleEndian" : "BigEndian");
    peri__emit_text(w, "\" header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"");
    peri__emit_integer(w, n);
    peri__emit_text(w, "\" NumberOfCells=\"");
    peri__emit_integer(w, n);
    peri__emit_text(w, "\">\n<Points>\n");
    int64_t offset = peri__emit_array(w, "Float64", "position", 3, 0, n * 24);
    peri__emit_text(w, "</Points>\n<PointData");
    if (peri__vtu_has(vtu, PERI_FIELD_DAMAGE)) peri__emit_text(w, " Scalars=\"damage\"");
    if (peri__vtu_has(vtu, PERI_FIELD_DISPLACEMENT)) peri__emit_text(w, " Vectors=\"displacement\"");
    peri__emit_text(w, ">\n");
    for (int64_t k = 0; k < vtu->count; ++k) {
        const int32_t field = vtu->fields[k], components = peri__vtu_components(field);
        offset = peri__emit_array(w, "Float64", peri__fields[field - peri__first_field].name, components, offset, n * 8 * components);
    }
    peri__emit_text(w, "</PointData>\n<Cells>\n");
    offset = peri__emit_array(w, "Int32", "connectivity", 1, offset, n * 4);
    offset = peri__emit_array(w, "Int32", "offsets", 1, offset, n * 4);
    (void)peri__emit_array(w, "UInt8", "types", 1, offset, n);
    peri__emit_text(w, "</Cells>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_");
}

/* Each point is a cell of its own: VTK_VERTEX. */
static void peri__emit_cells(peri__writer *w, int64_t n) {
    for (int32_t ends = 0; ends < 2; ++ends) {
        peri__emit_length(w, n * 4);
        for (int32_t i = 0; i < (int32_t)n; ++i) {
            int32_t id = i + ends;
            peri__emit(w, &id, sizeof id);
        }
    }
    peri__emit_length(w, n);
    for (int64_t i = 0; i < n; ++i) {
        const uint8_t vertex = 1;
        peri__emit(w, &vertex, 1);
    }
    peri__emit_text(w, "\n</AppendedData>\n</VTKFile>\n");
}

/* Scratch for the fields, and the fragments where they are asked for. */
static int32_t peri__open_vtu(peri_body *b, peri__vtu *vtu) {
    int32_t most = b->dim, status = PERI_OK;
    const int fragments = peri__vtu_has(vtu, PERI_FIELD_FRAGMENT);
    for (int64_t k = 0; k < vtu->count; ++k) {
        const int32_t components = peri__components(vtu->fields[k], b->dim);
        if (components > most) most = components;
    }
    vtu->status = PERI_OK;
    vtu->room = b->model->points * (most + fragments);
    vtu->values = (double *)peri__new(&b->scratch, vtu->room, sizeof(double));
    if (!vtu->values) return peri__fail(b, PERI_ERROR_MEMORY, "peri_export_vtu_to", -1, 0.0);
    vtu->fragments = fragments ? vtu->values + b->model->points * most : NULL;
    if (fragments) status = peri__fill_fragments(b, vtu->fragments);
    if (status < 0) peri__delete(&b->scratch, vtu->values, vtu->room, sizeof(double));
    return status;
}

static int32_t peri__write_vtu(peri_body *b, peri__vtu *vtu, peri_write_fn write, void *user) {
    peri__writer w;
    int32_t status = peri__open_vtu(b, vtu);
    if (status < 0) return status;
    peri__begin_writer(&w, b, write, user);
    peri__emit_head(b, &w, vtu);
    peri__emit_field(b, &w, PERI_FIELD_POSITION, vtu);
    for (int64_t k = 0; k < vtu->count; ++k) peri__emit_field(b, &w, vtu->fields[k], vtu);
    peri__emit_cells(&w, b->model->points);
    peri__delete(&b->scratch, vtu->values, vtu->room, sizeof(double));
    status = peri__finish(b, &w);
    return status < 0 ? status : vtu->status;
}

PERI_API int32_t peri_export_vtu_to(peri_body *b, peri_write_fn write, void *user) {
    peri__vtu vtu = { peri__vtu_fields, PERI_VTU_FIELDS, 0, NULL, NULL, PERI_OK };
    PERI_NEED_BUILT(b);
    PERI_NEED(b, write, "write");
    return peri__write_vtu(b, &vtu, write, user);
}

/* Are these fields, each once? Brings up to date what they are made of. NULL: those of peri_export_vtu. */
static int32_t peri__take_vtu_fields(peri_body *b, const int32_t *fields, int64_t count, peri__vtu *vtu) {
    vtu->fields = fields ? fields : peri__vtu_fields;
    vtu->count = fields ? count : PERI_VTU_FIELDS;
    PERI_NEED(b, !fields || count >= 0, "count");
    for (int64_t k = 0; fields && k < count; ++k) {
        if (!PERI_IS_ONE_OF(field, fields[k])) return peri__fail(b, PERI_ERROR_CHOICE, "fields", k, fields[k]);
        for (int64_t n = 0; n < k; ++n)
            if (fields[n] == fields[k]) return peri__fail(b, PERI_ERROR_ARGUMENT, "fields", k, fields[k]);
    }
    for (int64_t k = 0; fields && k < count; ++k) {
        const int32_t status = fields[k] == PERI_FIELD_FRAGMENT ? PERI_OK : peri__fields[fields[k] - peri__first_field].ensure(b);
        if (status < 0) return status;
    }
    return PERI_OK;
}

PERI_API int32_t peri_export_fields_to(peri_body *b, const int32_t *fields, int64_t count, peri_write_fn write, void *user) {
    peri__vtu vtu;
    PERI_NEED_BUILT(b);
    PERI_NEED(b, write, "write");
    const int32_t status = peri__take_vtu_fields(b, fields, count, &vtu);
    return status < 0 ? status : peri__write_vtu(b, &vtu, write, user);
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
    peri__begin_writer(&w, b, write, user);
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

/* ---- series of VTU ---------------------------------------------------------------------------------------------------

   The collection (.pvd) has an entry per frame, all of one length: its end is overwritten with the next entry and a new end in one piece,
   so that it is whole whenever the run stops. A frame that it has already, of a run that went on from an earlier state, takes the place of
   that and of all after it; what is left of them becomes blank lines. */

#define PERI_FRAMES 1000000
static const char peri__pvd_head[] = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
static const char peri__pvd_end[] = "</Collection>\n</VTKFile>\n";

typedef struct peri__series { /* of the files of a frame                                                                  */
    char   *text;         /* scratch: path of the VTU, then the entry and the end                                         */
    char   *entry;
    int64_t room, length; /* of `text`; of an entry                                                                       */
} peri__series;

/* A name as an attribute. */
static char *peri__put_attribute(char *out, const char *name) {
    for (; *name; ++name) {
        if (*name == '&') out = peri__put_text(out, "&amp;");
        else if (*name == '<') out = peri__put_text(out, "&lt;");
        else if (*name == '"') out = peri__put_text(out, "&quot;");
        else *out++ = *name;
    }
    return out;
}

/* run.pvd: run_000012.vtu, and its entry. */
static void peri__name_frame(const peri_body *b, const char *path, int64_t frame, peri__series *s) {
    size_t length = strlen(path);
    char *end = s->text, *digit;
    const char *name = s->text;
    if (length > 4 && strcmp(path + length - 4, ".pvd") == 0) length -= 4;
    memcpy(end, path, length);
    end = peri__put_text(end + length, "_000000.vtu");
    *end = '\0';
    for (digit = end - 5; frame > 0; frame /= 10) *digit-- = (char)('0' + frame % 10);
    for (const char *c = s->text; *c; ++c)
        if (*c == '/' || *c == '\\') name = c + 1;
    s->entry = end + 1;
    char *at = peri__put_text(s->entry, "<DataSet part=\"0\" file=\""), *time;
    time = at = peri__put_text(peri__put_attribute(at, name), "\" timestep=\"");
    at = peri__put_text(peri__put_double(at, peri__load_time(b)), "\"/>");
    while (at < time + 32) *at++ = ' ';
    *at++ = '\n';
    s->length = at - s->entry;
    memcpy(at, peri__pvd_end, sizeof peri__pvd_end);
}

/* Does the file have an entry, or its end, where that of the frame is to be? Leaves the file there. */
static int peri__find_frame(FILE *file, const peri__series *s, int64_t frame, long *end) {
    const long at = (long)(sizeof peri__pvd_head - 1) + (long)(frame * s->length);
    char head[sizeof peri__pvd_head], there[2];
    if (fread(head, 1, sizeof head - 1, file) != sizeof head - 1 || memcmp(head, peri__pvd_head, sizeof head - 1) != 0) return 0;
    if (fseek(file, 0, SEEK_END) != 0 || (*end = ftell(file)) < at + 2 || fseek(file, at, SEEK_SET) != 0) return 0;
    if (fread(there, 1, 2, file) != 2 || there[0] != '<' || (there[1] != 'D' && there[1] != '/')) return 0;
    return fseek(file, at, SEEK_SET) == 0;
}

/* The series, where the entry of the frame is to be; NULL: there is none, which is recorded. */
static FILE *peri__open_series(peri_body *b, const char *path, int64_t frame, const peri__series *s, long *end) {
    FILE *file = fopen(path, frame == 0 ? "wb" : "r+b");
    if (!file) (void)peri__fail(b, PERI_ERROR_WRITE, "path", -1, 0.0);
    if (!file || frame == 0 || peri__find_frame(file, s, frame, end)) return file;
    (void)fclose(file);
    (void)peri__fail(b, PERI_ERROR_WRITE, "frame", frame, 0.0);
    return NULL;
}

static int32_t peri__add_frame(peri_body *b, const char *path, int64_t frame, const peri__series *s) {
    const size_t bytes = (size_t)s->length + sizeof peri__pvd_end - 1;
    long end = 0, at;
    FILE *file = peri__open_series(b, path, frame, s, &end);
    if (!file) return b->error.code;
    int ok = frame > 0 || fwrite(peri__pvd_head, 1, sizeof peri__pvd_head - 1, file) == sizeof peri__pvd_head - 1;
    ok = ok && fwrite(s->entry, 1, bytes, file) == bytes;
    for (at = ftell(file); ok && at < end; ++at) ok = fputc('\n', file) != EOF;
    if (fclose(file) != 0 || !ok) return peri__fail(b, PERI_ERROR_WRITE, "path", -1, 0.0);
    return PERI_OK;
}

PERI_API int32_t peri_export_frame(peri_body *b, const char *path, int64_t frame, const int32_t *fields, int64_t count) {
    peri__series s;
    peri__vtu vtu;
    PERI_NEED_BUILT(b);
    PERI_NEED(b, path, "path");
    if (frame < 0 || frame >= PERI_FRAMES) return peri__fail(b, PERI_ERROR_RANGE, "frame", -1, (double)frame);
    int32_t status = peri__take_vtu_fields(b, fields, count, &vtu);
    if (status < 0) return status;
    s.room = 7 * (int64_t)strlen(path) + 256; /* the path, and the name with each of its characters as an entity */
    s.text = (char *)peri__new(&b->scratch, s.room, 1);
    if (!s.text) return peri__fail(b, PERI_ERROR_MEMORY, "path", -1, 0.0);
    peri__name_frame(b, path, frame, &s);
    if (frame > 0) { /* a gap is seen before its file is written */
        long end;
        FILE *series = peri__open_series(b, path, frame, &s, &end);
        status = series ? PERI_OK : b->error.code;
        if (series) (void)fclose(series);
    }
    FILE *file = status == PERI_OK ? fopen(s.text, "wb") : NULL;
    if (status == PERI_OK) status = file ? peri__write_vtu(b, &vtu, peri__to_file, file) : peri__fail(b, PERI_ERROR_WRITE, "path", -1, 0.0);
    if (file && fclose(file) != 0 && status == PERI_OK) status = peri__fail(b, PERI_ERROR_WRITE, "path", -1, 0.0);
    if (status == PERI_OK) status = peri__add_frame(b, path, frame, &s);
    peri__delete(&b->scratch, s.text, s.room, 1);
    return status;
}
#endif
