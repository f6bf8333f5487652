/* test_mixtures.c - laws that differ in one body, and energy criteria, by columns.

   SOURCE OF TRUTH: the reference kernel, which goes from bond to bond of a row and takes each end's half from the law of its material: the
   force, the energy and the bonds that break must be the same but for the order of sums; and the momentum that the body is given stays. */
#include "scene.h"
#include "specimen.h"

#define SIDE 10

typedef struct mixture {
    int32_t space, precision, laws[2], criterion;
} mixture;

/* Two halves of a box, pulled apart. */
static peri_body *body_of(const mixture *x, int32_t kernel) {
    const double length = x->space == PERI_SOLID ? SIDE : 2 * SIDE, pull[3] = {0.04, 0.01, 0.005};
    specimen s = specimen_of(x->space, x->laws[0], 0.2, 1, 2.6, (int)length / 2, SIDE, 6);
    peri_material right = s.material;
    peri_body *b;
    s.desc.precision = x->precision;
    s.desc.kernel = kernel;
    s.desc.ledger = 1;
    for (int half = 0; half < 2; ++half) {
        peri_material *m = half ? &right : &s.material;
        peri_material_init(m, x->laws[half]);
        m->young = 1 + half;
        m->density = 1;
        if (x->laws[half] != PERI_BOND_BASED) {
            m->poisson = 0.2 + 0.1 * half;
            m->criterion = x->criterion;
        }
        m->fracture_energy = 4e-4;
    }
    b = specimen_start(&s);
    (void)MUST(b, peri_add_material(b, &right));
    (void)MUST(b, peri_add_box(b, 0, s.lo, s.hi, 1));
    const double lo[3] = {s.hi[0], 0, 0}, hi[3] = {length, s.hi[1], s.hi[2]};
    (void)MUST(b, peri_add_box(b, 1, lo, hi, 1));
    (void)MUST(b, peri_build(b));
    (void)MUST(b, peri_add_velocity(b, (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi)), pull));
    return b;
}

static double apart(peri_body *a, peri_body *b, int32_t field, double *size) {
    const int64_t n = peri_field_size(a, field);
    double *x = (double *)malloc((size_t)n * sizeof *x), *y = (double *)malloc((size_t)n * sizeof *y), most = 0;
    *size = 0;
    (void)MUST(a, peri_read(a, field, x, n));
    (void)MUST(b, peri_read(b, field, y, n));
    for (int64_t k = 0; k < n; ++k) {
        most = fmax(most, fabs(x[k] - y[k]));
        *size = fmax(*size, fabs(y[k]));
    }
    free(x);
    free(y);
    return most;
}

static void compare(const mixture *x) {
    const double round = x->precision == PERI_F64 ? 1e-12 : 2e-4;
    peri_body *fast = body_of(x, PERI_KERNEL_BEST), *plain = body_of(x, PERI_KERNEL_REFERENCE);
    peri_run run;
    double size, start[3], end[3], angular[3];
    int64_t broken = 0;
    (void)MUST(fast, peri_read_momentum(fast, start, angular));
    CHECK(strstr(peri_kernel_text(fast), "columns") != NULL);
    peri_run_init(&run);
    run.time_step = 0.2;
    for (int stretch = 0; stretch < 6; ++stretch) {
        run.steps = 10;
        (void)MUST(fast, peri_advance(fast, &run));
        (void)MUST(plain, peri_advance(plain, &run));
        broken = peri_broken_count(plain);
        CHECK(peri_broken_count(fast) == broken || x->precision != PERI_F64);
        if (broken > 0 && x->precision != PERI_F64) break; /* rounding may break another bond first from here on */
        CHECK(apart(fast, plain, PERI_FORCE_DENSITY, &size) <= round * size);
        CHECK(apart(fast, plain, PERI_ENERGY_DENSITY, &size) <= round * size);
    }
    CHECK(broken > 10 || x->precision != PERI_F64);
    (void)MUST(fast, peri_read_momentum(fast, end, angular));
    for (int d = 0; d < 2; ++d) CHECK_NEAR(end[d], start[d], x->precision == PERI_F64 ? 1e-12 : 1e-5, 0);
    peri_body_destroy(fast);
    peri_body_destroy(plain);
}

static void every_pair_of_laws(void) {
    static const int32_t precisions[3] = {PERI_F64, PERI_F32, PERI_MIXED};
    for (int32_t space = PERI_PLANE_STRAIN; space <= PERI_SOLID; ++space)
        for (int p = 0; p < 3; ++p)
            for (int32_t a = PERI_BOND_BASED; a < PERI_MODEL_COUNT_; ++a)
                for (int32_t z = a + 1; z < PERI_MODEL_COUNT_; ++z) {
                    /* each pair in double in each space, in one of the others in each; all with --long */
                    if (!test_long && p > 0 && (a + z + space) % 2 != p - 1) continue;
                    const mixture x = {space, precisions[p], {a, z}, PERI_CRITERION_STRETCH};
                    compare(&x);
                }
}

static void every_criterion(void) {
    for (int32_t criterion = PERI_CRITERION_BOND_ENERGY; criterion < PERI_CRITERION_COUNT_; ++criterion)
        for (int32_t space = PERI_PLANE_STRAIN; space <= PERI_SOLID; ++space)
            for (int32_t law = PERI_LPS; law < PERI_MODEL_COUNT_; ++law) {
                const mixture alone = {space, PERI_F64, {law, law}, criterion};
                const mixture beside = {space, PERI_F64, {law, PERI_BOND_BASED}, criterion};
                if (test_long || (criterion + space + law) % 2) compare(&alone);
                if (test_long || (criterion + space + law) % 2 == 0) compare(&beside);
            }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(every_pair_of_laws);
    RUN(every_criterion);
    return test_end("test_mixtures");
}
