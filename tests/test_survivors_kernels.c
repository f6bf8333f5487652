/* SPDX-License-Identifier: MIT */
/* test_survivors_kernels.c - small random bodies: what `make mutants` found that no other quick test of families and kernels looked at.

   SOURCE OF TRUTH: families found here, pair by pair; and that the three ways to work on bonds (columns, the list, the reference, which has
   every quantity by its formula) are one and the same, to the rounding of sums: with any mixture of laws, quadratures, corrections, sources
   of points, precisions, and bonds that are cut. */
#include "scene.h"

static int pick(uint64_t *seed, int count) {
    const int k = (int)(test_random(seed) * count);
    return k < count ? k : count - 1;
}

typedef struct scene {
    peri_body_desc desc;
    peri_material_desc material[2];
    int materials, source, cut;
    uint64_t seed;
} scene;

static scene draw(uint64_t seed) {
    static const double ratios[3] = {1.6, 2.2, 3.01};
    scene s;
    int k;
    memset(&s, 0, sizeof s);
    peri_body_desc_init(&s.desc);
    s.desc.threads = 1;
    s.desc.space = PERI_SPACE_PLANE_STRESS + pick(&seed, 3);
    const int solid = s.desc.space == PERI_SPACE_SOLID;
    s.desc.precision = pick(&seed, 2) ? PERI_PRECISION_DOUBLE : PERI_PRECISION_MIXED + pick(&seed, 2);
    s.desc.geometry = PERI_GEOMETRY_NONLINEAR + pick(&seed, 2);
    s.desc.influence = PERI_INFLUENCE_CONSTANT + pick(&seed, 5);
    s.desc.horizon = ratios[pick(&seed, solid ? 2 : 3)];
    s.materials = 1 + pick(&seed, 2);
    int bonds = 1;
    for (k = 0; k < 2; ++k) {
        const int32_t law = PERI_LAW_BOND_BASED + pick(&seed, 4);
        peri_material_desc_init(&s.material[k], law);
        s.material[k].young = 1 + k;
        s.material[k].density = 1 + 2 * k;
        if (law != PERI_LAW_BOND_BASED) s.material[k].poisson = 0.2 + 0.1 * k;
        if (k < s.materials) bonds = bonds && law == PERI_LAW_BOND_BASED;
    }
    s.desc.quadrature = PERI_QUADRATURE_FULL + (pick(&seed, 2) ? pick(&seed, bonds && !solid ? 5 : 3) : 0);
    const int planar = s.desc.quadrature > PERI_QUADRATURE_PARTIAL;
    if (pick(&seed, 2) && !planar) s.desc.correction = pick(&seed, 2) ? PERI_CORRECTION_MOMENT : PERI_CORRECTION_VOLUME + pick(&seed, 2);
    s.source = pick(&seed, 5);
    s.cut = pick(&seed, 2);
    s.seed = seed;
    return s;
}

/* The same points whatever the kernel: a box; two of different spacings; a moved one; a ball and a box; a cloud of uneven volumes. */
static peri_body *make(const scene *s, int32_t kernel) {
    peri_body_desc d = s->desc;
    peri_body *b = NULL;
    int32_t m[2];
    const int solid = d.space == PERI_SPACE_SOLID;
    const double lo[3] = {0, 0, 0}, hi[3] = {solid ? 6 : 18, solid ? 5 : 7, 4}, apart = s->source == 3 ? 9 : 0;
    const double lo2[3] = {hi[0] + apart, 0, 0}, hi2[3] = {hi[0] + apart + 4, hi[1], 4};
    int k;
    d.kernel = kernel;
    MUST(NULL, peri_body_create(&d, &b, NULL));
    for (k = 0; k < 2; ++k) m[k] = k < s->materials ? (int32_t)MUST(b, peri_add_material(b, &s->material[k])) : m[0];
    if (s->source == 2) MUST(b, peri_add_perturbed_box(b, m[0], lo, hi, 1, 0.7, s->seed));
    else if (s->source == 3) MUST(b, peri_add_ball(b, m[0], hi, 3.2, 1));
    else if (s->source < 4) MUST(b, peri_add_box(b, m[0], lo, hi, 1));
    if (s->source < 4 && (s->source == 1 || s->materials == 2)) MUST(b, peri_add_box(b, m[1], lo2, hi2, s->source == 1 ? 0.8 : 1));
    if (s->source == 4) {
        double x[3 * 150], v[150];
        int32_t of[150];
        uint64_t seed = s->seed;
        const int dim = solid ? 3 : 2;
        for (k = 0; k < 150; ++k) {
            const int at[3] = {k % (solid ? 6 : 15), solid ? k / 6 % 5 : k / 15, k / 30};
            int e;
            for (e = 0; e < dim; ++e) x[k * dim + e] = at[e] + 0.4 * test_random(&seed);
            v[k] = 0.5 + test_random(&seed);
            of[k] = m[k % 2];
        }
        MUST(b, peri_add_points(b, 150, x, v, of));
    }
    MUST(b, peri_build(b));
    return b;
}

static int32_t every_fifth(void *user, int32_t i, int32_t j, const double *xi, const double *xj) {
    (void)user;
    (void)xi;
    (void)xj;
    return (i * 7 + j * 3) % 5 == 0;
}

static void compare(peri_body *a, peri_body *b, int32_t field, double tolerance, const scene *s, int n) {
    double *p = get(a, field), *q = get(b, field);
    const int64_t count = peri_size_of_field(a, field);
    const double size = largest(p, count) + 1e-300;
    double worst = 0;
    int64_t k;
    for (k = 0; k < count; ++k) worst = fmax(worst, fabs(p[k] - q[k]) / size);
    if (!(worst <= tolerance)) {
        test_bad++;
        printf("    scene %d: field %d differs by %.2g: laws %d %d, quadrature %d, correction %d, precision %d, source %d, %s\n", n, field,
               worst, s->material[0].law, s->materials == 2 ? s->material[1].law : 0, s->desc.quadrature, s->desc.correction,
               s->desc.precision, s->source, peri_kernel_text(b));
    }
    free(p);
    free(q);
}

static void agree(int from, int to, int solid) {
    static const int32_t fields[4] = {PERI_FIELD_FORCE_DENSITY, PERI_FIELD_ENERGY_DENSITY, PERI_FIELD_DAMAGE, PERI_FIELD_DILATATION};
    static const int32_t kernels[2] = {PERI_KERNEL_LIST, PERI_KERNEL_BEST};
    int n, k, f;
    for (n = from; n < to; ++n) {
        const scene s = draw((uint64_t)n * 7919 + 1);
        if ((s.desc.space == PERI_SPACE_SOLID) != solid) continue;
        const double tolerance = s.desc.precision == PERI_PRECISION_DOUBLE ? 1e-11 : 3e-4;
        peri_body *b[3] = {make(&s, PERI_KERNEL_REFERENCE), NULL, NULL};
        double *u = random_field(peri_size_of_field(b[0], PERI_FIELD_DISPLACEMENT), 0.02, s.seed);
        for (k = 0; k < 3; ++k) {
            if (k) b[k] = make(&s, kernels[k - 1]);
            put(b[k], PERI_FIELD_DISPLACEMENT, u);
            if (s.cut) MUST(b[k], peri_cut_if(b[k], PERI_CUT_NOW, every_fifth, NULL));
        }
        for (k = 1; k < 3; ++k) {
            for (f = 0; f < 4; ++f) compare(b[0], b[k], fields[f], tolerance, &s, n);
            CHECK_NEAR(peri_stable_step(b[k]), peri_stable_step(b[0]), tolerance, 0);
            CHECK(peri_entry_count(b[k]) == peri_entry_count(b[0]) && peri_broken_count(b[k]) == peri_broken_count(b[0]));
        }
        for (k = 0; k < 3; ++k) peri_body_destroy(b[k]);
        free(u);
    }
}

static void planes_agree(void) { agree(0, 60, 0); }
static void more_planes_agree(void) { agree(60, 160, 0); }
static void solids_agree(void) { agree(0, 25, 1); }

/* Whole cells: the points within the horizon, no more and no less. */
static void families_are_the_pairs(void) {
    int n;
    for (n = 0; n < 30; ++n) {
        scene s = draw((uint64_t)n * 104729 + 5);
        s.desc.quadrature = PERI_QUADRATURE_FULL;
        s.desc.precision = PERI_PRECISION_DOUBLE;
        s.desc.correction = PERI_CORRECTION_NONE;
        peri_body *b = make(&s, n % 2 ? PERI_KERNEL_BEST : PERI_KERNEL_LIST);
        double *x = get(b, PERI_FIELD_POSITION);
        const int64_t points = peri_point_count(b), width = peri_family_width(b);
        const int dim = peri_dimension(b);
        int32_t *rows = (int32_t *)malloc((size_t)(points * width) * sizeof *rows);
        int64_t i, j, wrong = 0;
        MUST(b, peri_get_families(b, 0, points, rows, points * width));
        for (i = 0; i < points; ++i) {
            int64_t at = 0;
            for (j = 0; j < points; ++j) {
                double square = 0;
                int d;
                for (d = 0; d < dim; ++d) square += (x[j * dim + d] - x[i * dim + d]) * (x[j * dim + d] - x[i * dim + d]);
                if (j != i && square <= s.desc.horizon * s.desc.horizon * (1 + 1e-9)) wrong += at >= width || rows[i * width + at++] != j;
            }
            for (; at < width; ++at) wrong += rows[i * width + at] != i;
        }
        CHECK(wrong == 0);
        free(rows);
        free(x);
        peri_body_destroy(b);
    }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(planes_agree);
    RUN(more_planes_agree);
    RUN(solids_agree);
    RUN(families_are_the_pairs);
    return test_end("test_survivors_kernels");
}
