/* SPDX-License-Identifier: MIT */
/* overlap.c - exact overlaps: disk and polygon, ball and box, ball and polyhedron. All about the origin. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

typedef struct peri__overlap {
    double area, moment[2]; /* integrals of 1, x, y over the overlap                                                     */
} peri__overlap;

/* Adds the signed overlap of the disk with triangle (0, a, b) where a-b lies all inside (a triangle) or all outside (a sector). */
static void peri__overlap_piece(peri__overlap *o, double radius, const double *a, const double *b, int inside) {
    double cross = a[0] * b[1] - a[1] * b[0];
    if (inside) {
        o->area += 0.5 * cross;
        o->moment[0] += cross * (a[0] + b[0]) / 6.0;
        o->moment[1] += cross * (a[1] + b[1]) / 6.0;
    } else {
        double la = sqrt(a[0] * a[0] + a[1] * a[1]), lb = sqrt(b[0] * b[0] + b[1] * b[1]);
        double angle = atan2(cross, a[0] * b[0] + a[1] * b[1]), cube = radius * radius * radius / 3.0;
        o->area += 0.5 * radius * radius * angle;
        o->moment[0] += cube * (b[1] / lb - a[1] / la); /* integral of r cos over the sector */
        o->moment[1] += cube * (a[0] / la - b[0] / lb);
    }
}

/* Where the edge a-b passes the circle: a + cut[k] (b - a), from 0 to 1; returns how many pieces there are, none of an edge without
   length. */
static int peri__cut_edge(double radius, const double *a, const double *b, double *cut) {
    double d[2];
    int cuts = 1;
    cut[0] = 0.0;
    d[0] = b[0] - a[0];
    d[1] = b[1] - a[1];
    /* |a + t d|^2 = radius^2 */
    double dd = d[0] * d[0] + d[1] * d[1], ad = a[0] * d[0] + a[1] * d[1];
    double aa = a[0] * a[0] + a[1] * a[1] - radius * radius, root = ad * ad - dd * aa;
    if (dd == 0.0) return 0;
    if (root > 0.0) {
        /* the two roots without cancellation */
        double q = -(ad + (ad >= 0.0 ? sqrt(root) : -sqrt(root)));
        double t0 = q / dd, t1 = q != 0.0 ? aa / q : 0.0;
        if (t0 > t1) {
            double t = t0;
            t0 = t1;
            t1 = t;
        }
        if (t0 > 0.0 && t0 < 1.0) cut[cuts++] = t0;
        if (t1 > 0.0 && t1 < 1.0) cut[cuts++] = t1;
    }
    cut[cuts] = 1.0;
    return cuts;
}

/* The ends of the piece from cut[0] to cut[1]; is it within the circle? */
static int peri__edge_piece(double radius, const double *a, const double *b, const double *cut, double *p, double *q) {
    double d[2], mid = 0.5 * (cut[0] + cut[1]), x[2];
    for (int e = 0; e < 2; ++e) {
        d[e] = b[e] - a[e];
        x[e] = a[e] + mid * d[e];
        p[e] = a[e] + cut[0] * d[e];
        q[e] = cut[1] < 1.0 ? a[e] + cut[1] * d[e] : b[e];
    }
    return x[0] * x[0] + x[1] * x[1] < radius * radius;
}

/* Overlap of the disk of the given radius about the origin with a polygon, vertices counter-clockwise: the sum over its edges of the
   signed overlap with the triangle that the edge spans with the origin. */
static peri__overlap peri__disk_polygon(double radius, double polygon[][2], int vertices) {
    peri__overlap o;
    memset(&o, 0, sizeof o);
    for (int k = 0; k < vertices; ++k) {
        const double *a = polygon[k], *b = polygon[(k + 1) % vertices];
        double cut[4];
        const int cuts = peri__cut_edge(radius, a, b, cut);
        for (int c = 0; c < cuts; ++c) {
            double p[2], q[2];
            const int inside = peri__edge_piece(radius, a, b, &cut[c], p, q);
            peri__overlap_piece(&o, radius, p, q, inside);
        }
    }
    return o;
}

static peri__overlap peri__disk_rectangle(double radius, const double *centre, double half_x, double half_y) {
    double p[4][2];
    for (int k = 0; k < 4; ++k) {
        p[k][0] = centre[0] + (k == 1 || k == 2 ? half_x : -half_x);
        p[k][1] = centre[1] + (k >= 2 ? half_y : -half_y);
    }
    return peri__disk_polygon(radius, p, 4);
}

/* Volume of the overlap of the ball with a box: exact areas of slices z = const, integrated by Gauss-Legendre between the heights
   where a slice's circle passes an edge or a corner of the rectangle. There the area has a kink like (z - z0)^(3/2), which
   z = z0 + (z1 - z0) sin^2(pi t/2) makes smooth. */
static double peri__ball_box(double radius, const double *centre, const double *half, const double *gauss_x,
                             const double *gauss_w) {
    double lo = centre[2] - half[2], hi = centre[2] + half[2], kink[20], volume = 0.0;
    double edge[4], square[8];
    int kinks = 0;
    if (lo < -radius) lo = -radius;
    if (hi > radius) hi = radius;
    if (!(hi > lo)) return 0.0;
    for (int s = 0; s < 2; ++s) {
        edge[s] = peri__square(centre[0] + (s ? half[0] : -half[0]));
        edge[2 + s] = peri__square(centre[1] + (s ? half[1] : -half[1]));
    }
    for (int s = 0; s < 4; ++s) {
        square[s] = edge[s];
        square[4 + s] = edge[s / 2] + edge[2 + s % 2];
    }
    kink[kinks++] = lo;
    kink[kinks++] = hi;
    for (int s = 0; s < 8; ++s) {
        double rest = radius * radius - square[s], z = rest > 0.0 ? sqrt(rest) : -1.0;
        if (z < 0.0) continue;
        if (z > lo && z < hi) kink[kinks++] = z;
        if (-z > lo && -z < hi) kink[kinks++] = -z;
    }
    for (int a = 1; a < kinks; ++a)
        for (int c = a; c > 0 && kink[c] < kink[c - 1]; --c) {
            double t = kink[c];
            kink[c] = kink[c - 1];
            kink[c - 1] = t;
        }
    for (int a = 0; a + 1 < kinks; ++a) {
        double width = kink[a + 1] - kink[a];
        if (width <= 1e-14 * radius) continue;
        for (int g = 0; g < PERI_GAUSS; ++g) {
            double sine = sin(0.5 * PERI_PI * gauss_x[g]), z = kink[a] + width * sine * sine;
            double slope = 0.5 * PERI_PI * sin(PERI_PI * gauss_x[g]) * width, rest = radius * radius - z * z;
            if (rest > 0.0) volume += gauss_w[g] * slope * peri__disk_rectangle(sqrt(rest), centre, half[0], half[1]).area;
        }
    }
    return volume;
}

/* Parts below this are a touch, or the rounding of one: no part. */
#define PERI_NO_PART 1e-12

static double peri__volume_of_overlap(peri__overlap o, double whole, double *centroid) {
    if (!(o.area > PERI_NO_PART * whole)) return 0.0;
    if (centroid) {
        centroid[0] = o.moment[0] / o.area;
        centroid[1] = o.moment[1] / o.area;
    }
    return o.area / whole;
}

/* ---- ball and polyhedron -------------------------------------------------------------------------------------------

   The part of the ball in the cone from its centre over a flat face is R^3/3 Omega less the part D of it beyond the plane of the face, at
   the distance h; summed over a closed surface, R^3/3 Omega is the ball where its centre is within and else nothing. D is a sum over the
   edges a-b of the face of what lies over the triangle (F, a, b), F the foot of the perpendicular: of pieces of edges within the circle in
   which the ball meets the plane
       D = R^3/3 Omega - h area,   tan(Omega/2) = cross(a, b)/(|a'| |b'| + h (|a'| + |b'|) + a.b + h^2),   |a'|^2 = |a|^2 + h^2
   (van Oosterom, Strackee 1983), of those outside the sector of a cap, D = phi/6 (R - h)^2 (2 R + h). */

static double peri__beyond_triangle(double radius, double h, const double *a, const double *b) {
    const double cross = a[0] * b[1] - a[1] * b[0], dot = a[0] * b[0] + a[1] * b[1];
    const double la = sqrt(a[0] * a[0] + a[1] * a[1] + h * h), lb = sqrt(b[0] * b[0] + b[1] * b[1] + h * h);
    return radius * radius * radius / 1.5 * atan2(cross, la * lb + h * (la + lb) + dot + h * h) - h * cross / 6.0;
}

static double peri__beyond_sector(double radius, double h, const double *a, const double *b) {
    const double angle = atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
    return angle / 6.0 * peri__square(radius - h) * (2.0 * radius + h);
}

/* Sum of the cross products of successive vertices: twice the area times the normal. */
static void peri__face_normal(double x[][3], int sides, double *normal) {
    normal[0] = normal[1] = normal[2] = 0.0;
    for (int k = 1; k + 1 < sides; ++k) {
        double a[3], b[3], cross[3];
        for (int d = 0; d < 3; ++d) a[d] = x[k][d] - x[0][d], b[d] = x[k + 1][d] - x[0][d];
        peri__cross(a, b, cross);
        for (int d = 0; d < 3; ++d) normal[d] += cross[d];
    }
}

/* What a flat face that looks outwards adds to the overlap, but for R^3/3 Omega. */
static double peri__ball_face(double radius, double x[][3], int sides) {
    double normal[3], along[3] = { 0.0, 0.0, 0.0 }, across[3], p[4][2], h = 0.0, sum = 0.0;
    peri__face_normal(x, sides, normal);
    const double size = sqrt(peri__dot(normal, normal, 3));
    if (!(size > 0.0)) return 0.0;
    for (int d = 0; d < 3; ++d) normal[d] /= size;
    for (int k = 0; k < sides; ++k) h += peri__dot(normal, x[k], 3) / sides;
    if (!(fabs(h) < radius)) return 0.0;
    int least = fabs(normal[0]) < fabs(normal[1]) ? 0 : 1;
    if (fabs(normal[2]) < fabs(normal[least])) least = 2;
    along[least] = 1.0;
    peri__cross(normal, along, across);
    const double width = sqrt(peri__dot(across, across, 3));
    for (int d = 0; d < 3; ++d) across[d] /= width;
    peri__cross(across, normal, along);
    for (int k = 0; k < sides; ++k) {
        p[k][0] = peri__dot(along, x[k], 3);
        p[k][1] = peri__dot(across, x[k], 3);
    }
    const double circle = sqrt((radius - h) * (radius + h)), away = fabs(h);
    for (int k = 0; k < sides; ++k) {
        double cut[4], a[2], b[2];
        const int cuts = peri__cut_edge(circle, p[k], p[(k + 1) % sides], cut);
        for (int c = 0; c < cuts; ++c)
            sum += peri__edge_piece(circle, p[k], p[(k + 1) % sides], &cut[c], a, b) ? peri__beyond_triangle(radius, away, a, b)
                                                                                      : peri__beyond_sector(radius, away, a, b);
    }
    return h > 0.0 ? -sum : sum;
}

/* The solid angle that a triangle spans at the origin, > 0 where it looks away. */
static double peri__solid_angle(double x[][3]) {
    double cross[3], length[3];
    for (int k = 0; k < 3; ++k) length[k] = sqrt(peri__dot(x[k], x[k], 3));
    peri__cross(x[1], x[2], cross);
    return 2.0 * atan2(peri__dot(x[0], cross, 3), length[0] * length[1] * length[2] + peri__dot(x[0], x[1], 3) * length[2]
                                                      + peri__dot(x[1], x[2], 3) * length[0] + peri__dot(x[2], x[0], 3) * length[1]);
}
