/* SPDX-License-Identifier: MIT */
/* bits.c - prints one number per scene, made of every bit of the displacements after a run through fracture: the library must give the same
   ones whatever vectors it was built for (checks.sh compares builds). */
#include "peri_test.h"

static uint64_t hash_of(const double *values, int64_t count) {
    uint64_t hash = 0;
    for (int64_t k = 0; k < count; ++k) {
        uint64_t bits;
        memcpy(&bits, &values[k], sizeof bits);
        hash = (hash ^ bits) * UINT64_C(0x100000001B3);
    }
    return hash;
}

static uint64_t run(int32_t law, int32_t precision, int32_t kernel, int cloud, int dim) {
    const double lo[3] = {0, 0, 0}, hi[3] = {dim == 3 ? 13 : 21, dim == 3 ? 6 : 9, 4};
    const double half[3] = {dim == 3 ? 6 : 10, 9, 5}, pull[3] = {0.12, 0.02, 0};
    peri_body_desc d;
    peri_material_desc m;
    peri_advance_desc run;
    peri_body *b = NULL;
    peri_body_desc_init(&d);
    d.space = dim == 3 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRAIN;
    d.precision = precision;
    d.kernel = kernel;
    d.horizon = 2.6;
    CHECK(peri_body_create(&d, &b, NULL) == PERI_OK);
    peri_material_desc_init(&m, law);
    m.young = m.density = 1;
    m.critical_stretch = 0.03;
    if (law != PERI_LAW_BOND_BASED) m.poisson = 0.2;
    const int32_t id = (int32_t)MUST(b, peri_add_material(b, &m));
    MUST(b, cloud ? peri_add_perturbed_box(b, id, lo, hi, 1.0, 1.0, 9) : peri_add_box(b, id, lo, hi, 1.0));
    MUST(b, peri_build(b));
    MUST(b, peri_add_velocity(b, (int32_t)MUST(b, peri_select_box(b, NULL, lo, half)), pull));
    peri_advance_desc_init(&run);
    run.steps = 14;
    MUST(b, peri_advance(b, &run));
    CHECK(peri_broken_count(b) > 10);
    const int64_t n = peri_size_of_field(b, PERI_FIELD_DISPLACEMENT);
    double *u = (double *)malloc((size_t)n * sizeof *u);
    MUST(b, peri_get_field(b, PERI_FIELD_DISPLACEMENT, u, n));
    const uint64_t hash = hash_of(u, n);
    free(u);
    peri_body_destroy(b);
    return hash;
}

int main(void) {
    static const int32_t precisions[3] = {PERI_PRECISION_DOUBLE, PERI_PRECISION_MIXED, PERI_PRECISION_SINGLE};
    for (int32_t law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law)
        for (int p = 0; p < 3; ++p)
            for (int way = 0; way < 6; ++way) { /* columns, a cloud, the list; each in the plane and in solids */
                const int32_t kernel = way / 2 == 2 ? PERI_KERNEL_LIST : PERI_KERNEL_BEST;
                printf("%d %d %d %016llx\n", (int)law, p, way,
                       (unsigned long long)run(law, precisions[p], kernel, way / 2 == 1, 2 + way % 2));
            }
    return test_bad != 0;
}
