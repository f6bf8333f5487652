/* SPDX-License-Identifier: MIT */
/* mesh.c - closed meshes: triangles in 3D, the sides of a polygon in 2D. How deep a place is in them, and their volume.

   The nearest place of the surface is found on a tree of boxes (halves of the faces by their middles along the longest axis). Which side a
   place is on follows from the pseudo-normal of what is nearest, a face, an edge or a corner: that of a corner is the sum of the normals of
   its faces weighed by their angles (Baerentzen, Aanaes 2005), exact for every closed surface that does not pass through itself. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

/* ---- the block -------------------------------------------------------------------------------------------------- */

static int64_t peri__mesh_bytes(int64_t vertices, int64_t faces) {
    return (int64_t)sizeof(peri__mesh) + 8 * (3 * vertices * 2 + 3 * faces + 9 * faces + 6 * (2 * faces - 1)) + 4 * (3 * faces + faces);
}

/* Sets the pointers of a block that was made or copied. */
static void peri__bind_mesh(peri__mesh *mesh) {
    double *next = (double *)(void *)(mesh + 1);
    mesh->vertex = next;
    mesh->vertex_normal = next += 3 * mesh->vertices;
    mesh->face_normal = next += 3 * mesh->vertices;
    mesh->edge_normal = next += 3 * mesh->faces;
    mesh->box = next += 9 * mesh->faces;
    mesh->face = (int32_t *)(void *)(next + 6 * (2 * mesh->faces - 1));
    mesh->order = mesh->face + 3 * mesh->faces;
}

static const double *peri__vertex_of(const peri__mesh *mesh, int64_t face, int k) {
    return &mesh->vertex[3 * (int64_t)mesh->face[face * mesh->corners + k % mesh->corners]];
}

/* ---- normals ---------------------------------------------------------------------------------------------------- */

static void peri__way_to(const double *from, const double *to, double *way) {
    for (int d = 0; d < 3; ++d) way[d] = to[d] - from[d];
}

static double peri__length(const double *a) { return sqrt(peri__dot(a, a, 3)); }

/* The unit normals of the faces and corners; returns the first face that has none, or -1. */
static int64_t peri__mesh_normals(peri__mesh *mesh) {
    for (int64_t f = 0; f < mesh->faces; ++f) {
        double a[3], b[3], *normal = &mesh->face_normal[3 * f];
        peri__way_to(peri__vertex_of(mesh, f, 0), peri__vertex_of(mesh, f, 1), a);
        peri__way_to(peri__vertex_of(mesh, f, 0), peri__vertex_of(mesh, f, 2), b);
        if (mesh->corners == 2) {
            normal[0] = a[1];
            normal[1] = -a[0];
        } else
            peri__cross(a, b, normal);
        const double size = peri__length(normal), widest = fmax(peri__dot(a, a, 3), peri__dot(b, b, 3));
        if (!(size > (mesh->corners == 2 ? 0.0 : 1e-12 * widest))) return f;
        for (int d = 0; d < 3; ++d) normal[d] /= size;
        for (int k = 0; k < mesh->corners; ++k) {
            double out[3], back[3], angle = 1.0, *sum = &mesh->vertex_normal[3 * (int64_t)mesh->face[f * mesh->corners + k]];
            peri__way_to(peri__vertex_of(mesh, f, k), peri__vertex_of(mesh, f, k + 1), out);
            peri__way_to(peri__vertex_of(mesh, f, k), peri__vertex_of(mesh, f, k + mesh->corners - 1), back);
            if (mesh->corners == 3) {
                double cross[3];
                peri__cross(out, back, cross);
                angle = atan2(peri__length(cross), peri__dot(out, back, 3));
            }
            for (int d = 0; d < 3; ++d) sum[d] += angle * normal[d];
        }
    }
    return -1;
}

typedef struct peri__edge { /* of a face, from its lower to its higher vertex                                             */
    int32_t low, high, face, corner; /* corner: where it begins on the face                                              */
} peri__edge;

static int peri__compare_edges(const void *first, const void *second) {
    const peri__edge *a = (const peri__edge *)first, *b = (const peri__edge *)second;
    if (a->low != b->low) return a->low < b->low ? -1 : 1;
    if (a->high != b->high) return a->high < b->high ? -1 : 1;
    return a->face < b->face ? -1 : a->face > b->face;
}

/* Does the face go along the edge upwards? */
static int peri__goes_up(const peri__mesh *mesh, const peri__edge *e) { return mesh->face[3 * (int64_t)e->face + e->corner] == e->low; }

/* Joins the faces at their edges, 3D; returns a face with an edge that is not of two faces, once in each direction, or -1. */
static int64_t peri__mesh_edges(peri__mesh *mesh, peri__edge *edge) {
    for (int64_t e = 0; e < 3 * mesh->faces; ++e) {
        const int32_t a = mesh->face[e], b = mesh->face[e % 3 == 2 ? e - 2 : e + 1];
        edge[e].low = a < b ? a : b;
        edge[e].high = a < b ? b : a;
        edge[e].face = (int32_t)(e / 3);
        edge[e].corner = (int32_t)(e % 3);
    }
    qsort(edge, (size_t)(3 * mesh->faces), sizeof *edge, peri__compare_edges);
    for (int64_t e = 0; e < 3 * mesh->faces; e += 2) {
        const peri__edge *a = &edge[e], *b = a + 1;
        const int last = e + 1 == 3 * mesh->faces;
        if (last || a->low != b->low || a->high != b->high || peri__goes_up(mesh, a) == peri__goes_up(mesh, b)) return a->face;
        if (e + 2 < 3 * mesh->faces && b[1].low == a->low && b[1].high == a->high) return b[1].face;
        for (int d = 0; d < 3; ++d)
            mesh->edge_normal[9 * (int64_t)a->face + 3 * a->corner + d] = mesh->edge_normal[9 * (int64_t)b->face + 3 * b->corner + d] =
                mesh->face_normal[3 * (int64_t)a->face + d] + mesh->face_normal[3 * (int64_t)b->face + d];
    }
    return -1;
}

/* ---- the tree: the left half of a node follows it, the right one follows that; a leaf is one face ------------------ */

typedef struct peri__keyed {
    double  key;
    int32_t face;
} peri__keyed;

static int peri__compare_keys(const void *first, const void *second) {
    const peri__keyed *a = (const peri__keyed *)first, *b = (const peri__keyed *)second;
    return a->key < b->key ? -1 : a->key > b->key ? 1 : a->face < b->face ? -1 : a->face > b->face;
}

/* The box of faces order[begin, end). Returns its longest axis. */
static int peri__bound_faces(const peri__mesh *mesh, int64_t begin, int64_t end, double *box) {
    int axis = 0;
    for (int d = 0; d < 3; ++d) {
        box[d] = HUGE_VAL;
        box[3 + d] = -HUGE_VAL;
        for (int64_t n = begin; n < end; ++n)
            for (int k = 0; k < mesh->corners; ++k) {
                const double at = peri__vertex_of(mesh, mesh->order[n], k)[d];
                box[d] = fmin(box[d], at);
                box[3 + d] = fmax(box[3 + d], at);
            }
        if (box[3 + d] - box[d] > box[3 + axis] - box[axis]) axis = d;
    }
    return axis;
}

typedef struct peri__branch {
    int64_t node, begin, end;
} peri__branch;

static peri__branch peri__left_of(const peri__branch *at) {
    const peri__branch left = { at->node + 1, at->begin, (at->begin + at->end) / 2 };
    return left;
}

static peri__branch peri__right_of(const peri__branch *at) {
    const int64_t middle = (at->begin + at->end) / 2;
    const peri__branch right = { at->node + 2 * (middle - at->begin), middle, at->end };
    return right;
}

/* keyed: [faces] scratch. Halves go on a stack of at most 64: the smaller ones of 2^31 faces. */
static void peri__grow_tree(peri__mesh *mesh, peri__keyed *keyed) {
    peri__branch stack[64];
    int height = 1;
    stack[0].node = stack[0].begin = 0;
    stack[0].end = mesh->faces;
    for (int64_t f = 0; f < mesh->faces; ++f) mesh->order[f] = (int32_t)f;
    while (height > 0) {
        const peri__branch at = stack[--height];
        const int axis = peri__bound_faces(mesh, at.begin, at.end, &mesh->box[6 * at.node]);
        if (at.end - at.begin == 1) continue;
        for (int64_t n = at.begin; n < at.end; ++n) {
            keyed[n].key = 0.0;
            keyed[n].face = mesh->order[n];
            for (int k = 0; k < mesh->corners; ++k) keyed[n].key += peri__vertex_of(mesh, mesh->order[n], k)[axis];
        }
        qsort(keyed + at.begin, (size_t)(at.end - at.begin), sizeof *keyed, peri__compare_keys);
        for (int64_t n = at.begin; n < at.end; ++n) mesh->order[n] = keyed[n].face;
        stack[height++] = peri__right_of(&at);
        stack[height++] = peri__left_of(&at);
    }
}

/* ---- the nearest place ------------------------------------------------------------------------------------------- */

/* nearest = (1-t) a + t b, t in [0, 1]; returns t. */
static double peri__nearest_on_segment(const double *a, const double *b, const double *y, double *nearest) {
    double way[3], to[3];
    peri__way_to(a, b, way);
    peri__way_to(a, y, to);
    const double t = fmax(0.0, fmin(1.0, peri__dot(way, to, 3) / peri__dot(way, way, 3)));
    for (int d = 0; d < 3; ++d) nearest[d] = t == 1.0 ? b[d] : a[d] + t * way[d];
    return t;
}

/* Is y, a place beside the triangle, above the plane through edge k and the normal, on the inner side? */
static int peri__is_inside_edge(const peri__mesh *mesh, int64_t f, int k, const double *y) {
    double way[3], to[3], inward[3];
    peri__way_to(peri__vertex_of(mesh, f, k), peri__vertex_of(mesh, f, k + 1), way);
    peri__way_to(peri__vertex_of(mesh, f, k), y, to);
    peri__cross(&mesh->face_normal[3 * f], way, inward);
    return peri__dot(inward, to, 3) > 0.0;
}

/* The place of a face nearest to y; returns the pseudo-normal there. */
static const double *peri__nearest_on_face(const peri__mesh *mesh, int64_t f, const double *y, double *nearest) {
    const int corners = mesh->corners;
    double best = HUGE_VAL;
    const double *normal = &mesh->face_normal[3 * f];
    if (corners == 3 && peri__is_inside_edge(mesh, f, 0, y) && peri__is_inside_edge(mesh, f, 1, y) && peri__is_inside_edge(mesh, f, 2, y)) {
        double to[3];
        peri__way_to(peri__vertex_of(mesh, f, 0), y, to);
        const double height = peri__dot(to, normal, 3);
        for (int d = 0; d < 3; ++d) nearest[d] = y[d] - height * normal[d];
        return normal;
    }
    for (int k = 0; k < (corners == 3 ? 3 : 1); ++k) {
        double at[3], way[3];
        const double t = peri__nearest_on_segment(peri__vertex_of(mesh, f, k), peri__vertex_of(mesh, f, k + 1), y, at);
        peri__way_to(at, y, way);
        if (!(peri__dot(way, way, 3) < best)) continue;
        best = peri__dot(way, way, 3);
        memcpy(nearest, at, sizeof at);
        const int32_t vertex = mesh->face[f * corners + (t < 0.5 ? k : (k + 1) % corners)];
        if (t == 0.0 || t == 1.0) normal = &mesh->vertex_normal[3 * (int64_t)vertex];
        else normal = corners == 3 ? &mesh->edge_normal[9 * f + 3 * k] : &mesh->face_normal[3 * f];
    }
    return normal;
}

static double peri__square_to_box(const double *box, const double *y) {
    double square = 0.0;
    for (int d = 0; d < 3; ++d) square += peri__square(fmax(0.0, fmax(box[d] - y[d], y[d] - box[3 + d])));
    return square;
}

/* Nearer halves first; of two faces equally near that which comes first. What is further out than `reach` is -HUGE_VAL deep. */
static double peri__mesh_depth(const peri__mesh *mesh, const double *place, double reach, double *normal) {
    const double y[3] = { place[0], place[1], mesh->corners == 3 ? place[2] : 0.0 };
    peri__branch stack[64];
    double best = HUGE_VAL, way[3] = { 0.0 };
    const double *pseudo = mesh->face_normal;
    int height = 1;
    if (peri__square_to_box(mesh->box, y) > reach * reach) return -HUGE_VAL;
    stack[0].node = stack[0].begin = 0;
    stack[0].end = mesh->faces;
    while (height > 0) {
        const peri__branch at = stack[--height];
        if (!(peri__square_to_box(&mesh->box[6 * at.node], y) < best)) continue;
        if (at.end - at.begin == 1) {
            double nearest[3], to[3];
            const double *side = peri__nearest_on_face(mesh, mesh->order[at.begin], y, nearest);
            peri__way_to(y, nearest, to);
            const double square = peri__dot(to, to, 3);
            if (!(square < best)) continue;
            best = square;
            pseudo = side;
            memcpy(way, to, sizeof way);
            continue;
        }
        const peri__branch left = peri__left_of(&at), right = peri__right_of(&at);
        const int first = peri__square_to_box(&mesh->box[6 * right.node], y) < peri__square_to_box(&mesh->box[6 * left.node], y);
        stack[height++] = first ? left : right;
        stack[height++] = first ? right : left;
    }
    const int inside = peri__dot(way, pseudo, 3) > 0.0;
    const double distance = sqrt(best);
    for (int d = 0; d < mesh->corners; ++d) normal[d] = (inside ? way[d] : -way[d]) / (distance + DBL_MIN);
    return inside ? distance : -distance;
}

/* ---- volume ------------------------------------------------------------------------------------------------------ */

/* Sums over the simplices of the origin and the faces: the volume, int y, and int y y. */
static double peri__mesh_moments(const peri__mesh *mesh, double *first, double *second) {
    const int n = mesh->corners;
    double volume = 0.0;
    for (int64_t f = 0; f < mesh->faces; ++f) {
        double sum[3] = { 0.0 }, cross[3];
        const double *a = peri__vertex_of(mesh, f, 0), *b = peri__vertex_of(mesh, f, 1), *c = n == 3 ? peri__vertex_of(mesh, f, 2) : NULL;
        peri__cross(a, b, cross);
        const double part = n == 3 ? peri__dot(cross, c, 3) / 6.0 : 0.5 * cross[2];
        for (int k = 0; k < n; ++k)
            for (int d = 0; d < 3; ++d) sum[d] += peri__vertex_of(mesh, f, k)[d];
        volume += part;
        for (int d = 0; d < 3; ++d) first[d] += part * sum[d] / (n + 1);
        for (int r = 0; r < 3; ++r)
            for (int s = 0; s < 3; ++s) {
                double products = sum[r] * sum[s];
                for (int k = 0; k < n; ++k) products += peri__vertex_of(mesh, f, k)[r] * peri__vertex_of(mesh, f, k)[s];
                second[3 * r + s] += part * products / ((n + 1) * (n + 2));
            }
    }
    return volume;
}

/* The volume, < 0 where the faces look inwards; the centre, and the moments of inertia about it. */
static double peri__mesh_bulk(const peri__mesh *mesh, double *centre, double *inertia) {
    double first[3] = { 0.0 }, second[9] = { 0.0 };
    const double volume = peri__mesh_moments(mesh, first, second);
    for (int d = 0; d < 3; ++d) centre[d] = first[d] / volume;
    for (int k = 0; k < 9; ++k) second[k] -= volume * centre[k / 3] * centre[k % 3];
    const double trace = second[0] + second[4] + second[8];
    for (int k = 0; k < 9; ++k) inertia[k] = (k % 4 == 0 ? trace : 0.0) - second[k];
    if (mesh->corners == 2)
        for (int k = 0; k < 8; ++k) inertia[k] = 0.0;
    return volume;
}
