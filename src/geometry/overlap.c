/* SPDX-License-Identifier: MIT */
/* overlap.c - exact overlaps: disk and polygon, ball and box. All about the origin. */
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

/* Overlap of the disk of the given radius about the origin with a polygon, vertices counter-clockwise: the sum over its edges of the
   signed overlap with the triangle that the edge spans with the origin. */
static peri__overlap peri__disk_polygon(double radius, double polygon[][2], int vertices) {
    peri__overlap o;
    memset(&o, 0, sizeof o);
    for (int k = 0; k < vertices; ++k) {
        const double *a = polygon[k], *b = polygon[(k + 1) % vertices];
        double d[2], cut[4] = { 0.0, 1.0, 1.0, 1.0 };
        int cuts = 1;
        d[0] = b[0] - a[0];
        d[1] = b[1] - a[1];
        /* |a + t d|^2 = radius^2 */
        double dd = d[0] * d[0] + d[1] * d[1], ad = a[0] * d[0] + a[1] * d[1];
        double aa = a[0] * a[0] + a[1] * a[1] - radius * radius, root = ad * ad - dd * aa;
        if (dd == 0.0) continue;
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
        for (int c = 0; c < cuts; ++c) {
            double p[2], q[2], mid = 0.5 * (cut[c] + cut[c + 1]), x = a[0] + mid * d[0], y = a[1] + mid * d[1];
            for (int e = 0; e < 2; ++e) {
                p[e] = a[e] + cut[c] * d[e];
                q[e] = cut[c + 1] < 1.0 ? a[e] + cut[c + 1] * d[e] : b[e];
            }
            peri__overlap_piece(&o, radius, p, q, x * x + y * y < radius * radius);
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
