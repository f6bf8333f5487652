/* search.c - what peri_build costs on clouds: `search [repeats]`. ns per directed bond of random points, whole cells, bond-based, about 113
   bonds a point in 3D and 28 in 2D: the whole build by number of points and of threads, minimum of the repeats. One thread by processor
   time, which other work on the machine disturbs little; more by the clock on the wall. */
#include "bench.h"

static double unit(uint64_t *state) { /* uniform in [0, 1), the same on every machine */
    uint64_t z = (*state += UINT64_C(0x9E3779B97F4A7C15));
    z = (z ^ (z >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94D049BB133111EB);
    return (double)((z ^ (z >> 31)) >> 11) * (1.0 / 9007199254740992.0);
}

static double now(int32_t threads) { return threads > 1 ? seconds() : (double)clock() / CLOCKS_PER_SEC; }

/* Points on average one per unit of volume. */
static peri_body *cloud(int32_t space, int32_t precision, int32_t threads, int64_t points) {
    const int dim = space == PERI_SOLID ? 3 : 2;
    const double edge = pow((double)points, 1.0 / dim);
    double *x = (double *)malloc((size_t)(points * dim) * sizeof *x), *volume = (double *)malloc((size_t)points * sizeof *volume);
    uint64_t state = 1;
    peri_body_desc desc;
    peri_material material;
    peri_body *body = NULL;
    if (!x || !volume) exit(1);
    for (int64_t k = 0; k < points * dim; ++k) x[k] = edge * unit(&state);
    for (int64_t k = 0; k < points; ++k) volume[k] = 1.0;
    peri_body_desc_init(&desc);
    desc.space = space;
    desc.precision = precision;
    desc.threads = threads;
    desc.horizon = 3.0;
    if (peri_body_create(&desc, &body, NULL) < 0) exit(1);
    peri_material_init(&material, PERI_BOND_BASED);
    material.young = material.density = 1.0;
    need(body, peri_add_material(body, &material));
    need(body, peri_add_points(body, points, x, volume, 0));
    free(x);
    free(volume);
    return body;
}

static void run_case(int32_t space, int32_t precision, int32_t threads, int64_t points, int64_t repeats) {
    double best = 1e300;
    int64_t bonds = 1;
    for (int64_t r = 0; r < repeats; ++r) {
        peri_body *body = cloud(space, precision, threads, points);
        const double start = now(threads);
        need(body, peri_build(body));
        const double elapsed = now(threads) - start;
        bonds = peri_bond_count(body);
        if (elapsed < best) best = elapsed;
        peri_body_destroy(body);
    }
    printf("%s %s %8lld points, %d thread%s %8.1f bonds/point %8.2f ns/bond\n", space == PERI_SOLID ? "3D" : "2D",
           precision == PERI_F64 ? "f64" : "f32", (long long)points, (int)threads, threads > 1 ? "s" : " ",
           (double)bonds / (double)points, best * 1e9 / (double)bonds);
    (void)fflush(stdout);
}

int main(int argc, char **argv) {
    const int64_t repeats = argc > 1 ? atol(argv[1]) : 5;
    for (int64_t points = 10000; points <= 1000000; points *= 10) run_case(PERI_SOLID, PERI_F64, 1, points, repeats);
    for (int64_t points = 10000; points <= 1000000; points *= 10) run_case(PERI_PLANE_STRESS, PERI_F64, 1, points, repeats);
    run_case(PERI_SOLID, PERI_F32, 1, 1000000, repeats);
    run_case(PERI_SOLID, PERI_F64, 2, 1000000, repeats);
    return 0;
}
