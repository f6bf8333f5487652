/* SPDX-License-Identifier: MIT */
/* tensor.c - symmetric matrices of dimension 2 and 3, packed xx yy xy, or xx yy zz xy yz xz as VTK does; small linear systems. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_PACKED(dim) ((dim) * ((dim) + 1) / 2)

/* Eigenvalues (on the diagonal of a) and orthonormal eigenvectors (columns of v) of a symmetric a[n][n], by Jacobi's rotations: for
   matrices this small as exact as any way. */
static void peri__jacobi(int n, double *a, double *v) {
    for (int k = 0; k < n * n; ++k) v[k] = k % (n + 1) == 0 ? 1.0 : 0.0;
    for (int sweep = 0, turned = 1; sweep < 30 && turned; ++sweep) {
        turned = 0;
        for (int p = 0; p < n; ++p)
            for (int q = p + 1; q < n; ++q) {
                if (!(fabs(a[p * n + q]) > DBL_MIN)) continue;
                turned = 1;
                double phi = 0.5 * (a[q * n + q] - a[p * n + p]) / a[p * n + q];
                double t = (phi < 0.0 ? -1.0 : 1.0) / (fabs(phi) + sqrt(phi * phi + 1.0)), c = 1.0 / sqrt(t * t + 1.0), s = t * c;
                for (int k = 0; k < n; ++k) {
                    double x = a[k * n + p], y = a[k * n + q];
                    a[k * n + p] = c * x - s * y;
                    a[k * n + q] = s * x + c * y;
                }
                for (int k = 0; k < n; ++k) {
                    double x = a[p * n + k], y = a[q * n + k], vx = v[k * n + p], vy = v[k * n + q];
                    a[p * n + k] = c * x - s * y;
                    a[q * n + k] = s * x + c * y;
                    v[k * n + p] = c * vx - s * vy;
                    v[k * n + q] = s * vx + c * vy;
                }
                a[p * n + q] = a[q * n + p] = 0.0; /* but for rounding, which would never end */
            }
    }
}

/* The same of a packed one; full: [dim][dim]. */
static void peri__eigen(int32_t dim, const double *packed, double *full, double *v) {
    for (int p = 0; p < dim; ++p)
        for (int q = 0; q < dim; ++q) full[p * dim + q] = packed[peri__packed(dim, p, q)];
    peri__jacobi(dim, full, v);
}

/* Is there an eigenvalue below 0, by more than `cut` times the largest in size? */
static int peri__is_negative(int32_t dim, const double *packed, double cut) {
    double full[9], v[9], least = 0.0, size = 0.0;
    peri__eigen(dim, packed, full, v);
    for (int p = 0; p < dim; ++p) {
        if (full[p * (dim + 1)] < least) least = full[p * (dim + 1)];
        if (fabs(full[p * (dim + 1)]) > size) size = fabs(full[p * (dim + 1)]);
    }
    return least < -cut * size;
}

/* Inverse on the eigenvectors whose eigenvalue exceeds `cut` times the largest, nothing on the others. Returns how many there are. */
static int peri__invert(int32_t dim, const double *packed, double cut, double *inverse) {
    double full[9], v[9], largest = 0.0;
    int kept = 0;
    peri__eigen(dim, packed, full, v);
    for (int p = 0; p < dim; ++p)
        if (full[p * (dim + 1)] > largest) largest = full[p * (dim + 1)];
    for (int k = 0; k < PERI_PACKED(dim); ++k) inverse[k] = 0.0;
    for (int p = 0; p < dim; ++p) {
        if (!(full[p * (dim + 1)] > cut * largest)) continue;
        kept++;
        for (int a = 0; a < dim; ++a)
            for (int b = a; b < dim; ++b) inverse[peri__packed(dim, a, b)] += v[a * dim + p] * v[b * dim + p] / full[p * (dim + 1)];
    }
    return kept;
}

/* Solves G x = r for a positive definite G [n][n] with a row length of `row`, by Cholesky's factors in place. Directions without a positive
   pivot stay 0: which ones they are depends on the axes. x may be r. */
static void peri__solve(int n, int row, double *g, const double *r, double *x) {
    for (int k = 0; k < n; ++k) {
        const double pivot = g[k * row + k], root = pivot > 0.0 ? sqrt(pivot) : 0.0;
        g[k * row + k] = root;
        for (int i = k + 1; i < n; ++i) g[i * row + k] = root > 0.0 ? g[i * row + k] / root : 0.0;
        for (int i = k + 1; i < n; ++i)
            for (int j = k + 1; j <= i; ++j) g[i * row + j] -= g[i * row + k] * g[j * row + k];
    }
    for (int k = 0; k < n; ++k) {
        double sum = r[k];
        for (int j = 0; j < k; ++j) sum -= g[k * row + j] * x[j];
        x[k] = g[k * row + k] > 0.0 ? sum / g[k * row + k] : 0.0;
    }
    for (int k = n - 1; k >= 0; --k) {
        double sum = x[k];
        for (int j = k + 1; j < n; ++j) sum -= g[j * row + k] * x[j];
        x[k] = g[k * row + k] > 0.0 ? sum / g[k * row + k] : 0.0;
    }
}

static void peri__cross(const double *a, const double *b, double *out) {
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}
