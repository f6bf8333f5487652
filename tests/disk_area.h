/* SPDX-License-Identifier: MIT */
/* disk_area.h - areas of rectangles in disks, by Gauss's rule over chords: for the tests of quadrature, and on purpose by
   another method than the library's closed forms. */
#ifndef DISK_AREA_H
#define DISK_AREA_H

#include <math.h>

#define PI 3.14159265358979323846

/* Gauss-Legendre on 0..1: zeros of the Legendre polynomial by Newton's method. Call make_gauss first. */
enum { G = 20 };
static double gauss_x[G], gauss_w[G];

static inline void make_gauss(void) {
    int k, n, turn;
    for (k = 0; k < G; ++k) {
        double x = cos(PI * (k + 0.75) / (G + 0.5)), slope = 1;
        for (turn = 0; turn < 30; ++turn) {
            double a = 1.0, b = x;
            for (n = 2; n <= G; ++n) {
                const double next = ((2 * n - 1) * x * b - (n - 1) * a) / n;
                a = b;
                b = next;
            }
            slope = G * (x * b - a) / (x * x - 1);
            x -= b / slope;
        }
        gauss_x[k] = 0.5 * (1 + x);
        gauss_w[k] = 1 / ((1 - x * x) * slope * slope);
    }
}

static inline void sort_ascending(double *a, int n) {
    int i, j;
    for (i = 1; i < n; ++i)
        for (j = i; j > 0 && a[j] < a[j - 1]; --j) {
            const double swap = a[j];
            a[j] = a[j - 1];
            a[j - 1] = swap;
        }
}

/* Area of the rectangle lo..hi within R of the origin, and its first moments (unless NULL). The chord through x = R sin t runs
   from max(lo_y, -R cos t) to min(hi_y, R cos t); between the places where the circle crosses the upper or lower side it is
   analytic in t, and 20 points per piece give all digits. */
static inline double area_in_disk(const double *lo, const double *hi, double R, double *moment) {
    double cut[6], area = 0, mx = 0, my = 0;
    int cuts = 2, i, k;
    cut[0] = fmax(-R, fmin(R, lo[0]));
    cut[1] = fmax(-R, fmin(R, hi[0]));
    for (k = 0; k < 4; ++k) {
        const double y = k < 2 ? lo[1] : hi[1], x = fabs(y) < R ? (k % 2 ? -1 : 1) * sqrt((R - y) * (R + y)) : lo[0];
        if (x > lo[0] && x < hi[0]) cut[cuts++] = x;
    }
    sort_ascending(cut, cuts);
    for (i = 1; i < cuts; ++i) {
        const double t0 = asin(cut[i - 1] / R), t1 = asin(cut[i] / R);
        for (k = 0; k < G; ++k) {
            const double t = t0 + (t1 - t0) * gauss_x[k], half = R * cos(t), w = (t1 - t0) * gauss_w[k] * half;
            const double top = fmin(hi[1], half), low = fmax(lo[1], -half);
            if (top <= low) continue;
            area += w * (top - low);
            mx += w * (top - low) * R * sin(t);
            my += w * 0.5 * (top * top - low * low);
        }
    }
    if (moment) {
        moment[0] = mx;
        moment[1] = my;
    }
    return area;
}

#endif
