/* bench.c - performance tables: `bench [repeats] [words of a case name]`. One row a case, as CSV too (out/bench.csv).

   ns per directed bond per step, minimum of `repeats` timings; bytes per point of everything the body holds (counted by an allocator
   hook), and the most that it holds during peri_build; and beside it the textbook loop over stored ids, weights and lengths in the same
   run, so that the ratio holds on a noisy machine.
   Figures are for one thread unless the row says otherwise. */
#include "bench.h"

typedef struct bench_case {
    const char *name;
    int32_t     model, space, precision, geometry, threads, damage, cloud;
    int64_t     edge; /* points per edge of the cube or square                                                           */
    double      m;    /* horizon over spacing                                                                            */
} bench_case;

static const bench_case cases[] = {
    { "2D plane stress, m=3, f64", PERI_BOND_BASED, PERI_PLANE_STRESS, PERI_F64, PERI_NONLINEAR, 1, 1, 0, 300, 3 },
    { "2D plane stress, m=3, f32", PERI_BOND_BASED, PERI_PLANE_STRESS, PERI_F32, PERI_NONLINEAR, 1, 1, 0, 300, 3 },
    { "2D m=3, f64, linear", PERI_BOND_BASED, PERI_PLANE_STRESS, PERI_F64, PERI_LINEAR, 1, 1, 0, 300, 3 },
    { "3D m=3, f64, elastic", PERI_BOND_BASED, PERI_SOLID, PERI_F64, PERI_NONLINEAR, 1, 0, 0, 40, 3 },
    { "3D m=3, f64, damage", PERI_BOND_BASED, PERI_SOLID, PERI_F64, PERI_NONLINEAR, 1, 1, 0, 40, 3 },
    { "3D m=3, f32, damage", PERI_BOND_BASED, PERI_SOLID, PERI_F32, PERI_NONLINEAR, 1, 1, 0, 40, 3 },
    { "3D m=3, f64, damage, perturbed", PERI_BOND_BASED, PERI_SOLID, PERI_F64, PERI_NONLINEAR, 1, 1, 1, 40, 3 },
    { "3D m=3, f32, damage, perturbed", PERI_BOND_BASED, PERI_SOLID, PERI_F32, PERI_NONLINEAR, 1, 1, 1, 40, 3 },
    { "2D m=3, f64, damage, perturbed", PERI_BOND_BASED, PERI_PLANE_STRESS, PERI_F64, PERI_NONLINEAR, 1, 1, 1, 300, 3 },
    { "3D m=3, f64, damage, 2 threads", PERI_BOND_BASED, PERI_SOLID, PERI_F64, PERI_NONLINEAR, 2, 1, 0, 40, 3 },
    { "LPS 2D m=3, f64, damage", PERI_LPS, PERI_PLANE_STRESS, PERI_F64, PERI_NONLINEAR, 1, 1, 0, 300, 3 },
    { "LPS 3D m=3, f64, damage", PERI_LPS, PERI_SOLID, PERI_F64, PERI_NONLINEAR, 1, 1, 0, 40, 3 },
    { "LPS 3D m=3, f32, damage", PERI_LPS, PERI_SOLID, PERI_F32, PERI_NONLINEAR, 1, 1, 0, 40, 3 },
    { "LPS 3D m=3, f64, damage, perturbed", PERI_LPS, PERI_SOLID, PERI_F64, PERI_NONLINEAR, 1, 1, 1, 40, 3 },
    { "LPS 3D m=3, f32, damage, perturbed", PERI_LPS, PERI_SOLID, PERI_F32, PERI_NONLINEAR, 1, 1, 1, 40, 3 },
    { "LPS 2D m=3, f64, damage, perturbed", PERI_LPS, PERI_PLANE_STRESS, PERI_F64, PERI_NONLINEAR, 1, 1, 1, 300, 3 },
    { "correspondence 3D m=3, f64, damage", PERI_CORRESPONDENCE, PERI_SOLID, PERI_F64, PERI_NONLINEAR, 1, 1, 0, 40, 3 },
};

/* The loop of a textbook: every bond by itself, double precision, no damage, force only. */
static double textbook(peri_body *body, const double *x, const double *u, double *f, int64_t repeats) {
    int64_t n = peri_point_count(body), width = peri_family_width(body), bonds = peri_bond_count(body);
    int32_t dim = peri_dimension(body), *ids = (int32_t *)malloc((size_t)(n * width) * sizeof *ids);
    double *length = (double *)malloc((size_t)(n * width) * sizeof(double)), best = 1e300;
    need(body, peri_read_families(body, 0, n, ids, n * width));
    for (int64_t i = 0; i < n; ++i)
        for (int64_t k = 0; k < width; ++k) {
            double square = 0.0;
            for (int32_t d = 0; d < dim; ++d)
                square += (x[ids[i * width + k] * dim + d] - x[i * dim + d]) * (x[ids[i * width + k] * dim + d] - x[i * dim + d]);
            length[i * width + k] = sqrt(square);
        }
    for (int64_t r = 0; r < repeats; ++r) {
        double start = seconds(), elapsed;
        for (int64_t i = 0; i < n; ++i) {
            double sum[3] = { 0.0, 0.0, 0.0 };
            for (int64_t k = 0; k < width && ids[i * width + k] != i; ++k) {
                int64_t j = ids[i * width + k];
                double y[3], square = 0.0;
                for (int32_t d = 0; d < dim; ++d) {
                    y[d] = x[j * dim + d] + u[j * dim + d] - x[i * dim + d] - u[i * dim + d];
                    square += y[d] * y[d];
                }
                double now = sqrt(square), s = (now - length[i * width + k]) / length[i * width + k];
                for (int32_t d = 0; d < dim; ++d) sum[d] += s * y[d] / now;
            }
            for (int32_t d = 0; d < dim; ++d) f[i * dim + d] = sum[d];
        }
        elapsed = (seconds() - start) * 1e9 / (double)bonds;
        if (elapsed < best) best = elapsed;
    }
    free(ids);
    free(length);
    return best;
}

static void run_case(const bench_case *c, int64_t repeats, FILE *csv) {
    peri_body_desc desc;
    peri_material material;
    peri_run run;
    peri_body *body = NULL;
    const double lo[3] = { 0, 0, 0 }, hi[3] = { (double)c->edge, (double)c->edge, (double)c->edge };
    const double slow[3] = { 1e-6, 0, 0 };
    double start, build, best = 1e300, plain = 0.0;
    bytes_now = 0;
    peri_body_desc_init(&desc);
    desc.space = c->space;
    desc.precision = c->precision;
    desc.geometry = c->geometry;
    desc.threads = c->threads;
    desc.horizon = c->m;
    desc.allocate = count_allocate;
    desc.release = count_release;
    if (peri_body_create(&desc, &body, NULL) < 0) exit(1);
    peri_material_init(&material, c->model);
    if (c->model != PERI_BOND_BASED) material.poisson = 0.3;
    material.young = 1.0;
    material.density = 1.0;
    material.critical_stretch = c->damage ? 0.5 : 0.0;
    need(body, peri_add_material(body, &material));
    need(body, c->cloud ? peri_add_perturbed_box(body, 0, lo, hi, 1.0, 1.0, 7) : peri_add_box(body, 0, lo, hi, 1.0));
    start = seconds();
    bytes_most = bytes_now;
    need(body, peri_build(body));
    const uint64_t peak = bytes_most;
    build = (seconds() - start) * 1e9 / (double)peri_bond_count(body);
    need(body, peri_add_velocity(body, PERI_ALL, slow));
    peri_run_init(&run);
    run.steps = 2;
    for (int64_t r = 0; r < repeats; ++r) {
        start = seconds();
        need(body, peri_advance(body, &run));
        double elapsed = (seconds() - start) * 1e9 / (double)(run.steps * peri_bond_count(body));
        if (r > 0 && elapsed < best) best = elapsed;
    }
    double per_point = (double)bytes_now / (double)peri_point_count(body), most = (double)peak / (double)peri_point_count(body);
    if (c->precision == PERI_F64 && c->threads == 1) {
        int64_t size = peri_field_size(body, PERI_POSITION);
        double *x = (double *)malloc((size_t)size * sizeof(double)), *u = (double *)malloc((size_t)size * sizeof(double));
        double *f = (double *)malloc((size_t)size * sizeof(double));
        need(body, peri_read(body, PERI_POSITION, x, size));
        need(body, peri_read(body, PERI_DISPLACEMENT, u, size));
        plain = textbook(body, x, u, f, repeats);
        free(x);
        free(u);
        free(f);
    }
    printf("%-36s %8.2f %9.2f %9.0f %9.0f %9.1f\n", c->name, best, plain, per_point, most, build);
    if (csv) fprintf(csv, "%s,%.4g,%.4g,%.6g,%.6g,%.4g\n", c->name, best, plain, per_point, most, build);
    peri_body_destroy(body);
}

int main(int argc, char **argv) {
    int64_t repeats = argc > 1 ? atol(argv[1]) : 7;
    FILE *csv = fopen("out/bench.csv", "w");
    if (repeats < 2) repeats = 2;
    if (csv) fprintf(csv, "case,ns_per_bond,textbook_ns_per_bond,bytes_per_point,peak_bytes_per_point,build_ns_per_bond\n");
    printf("%-36s %8s %9s %9s %9s %9s\n", "case", "ns/bond", "textbook", "bytes/pt", "peak", "build");
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k)
        if (argc < 3 || strstr(cases[k].name, argv[2])) run_case(&cases[k], repeats, csv);
    if (csv) (void)fclose(csv);
    return 0;
}
