/* SPDX-License-Identifier: MIT */
/* test_mixtures.c - laws that differ in one body, and criteria of energy, by columns and by the list, there of stress, too.

   SOURCE OF TRUTH: the reference kernel, which goes from bond to bond of a row and takes each end's half from the law of its material: the
   force, the energy and the bonds that break must be the same but for the order of sums; and the momentum that the body is given stays. */
#include "scene.h"
#include "specimen.h"

#define SIDE 10

static int32_t limit_instructions = PERI_INSTRUCTIONS_BEST, thread_count = 1;

typedef struct mixture {
    int32_t space, precision, laws[2], criterion;
    int32_t kernel; /* compared with the reference                                                                           */
} mixture;

/* Two halves of a box, pulled apart. */
static peri_body *body_of(const mixture *x, int32_t kernel) {
    const double length = x->space == PERI_SPACE_SOLID ? SIDE : 2 * SIDE, pull[3] = {0.04, 0.01, 0.005};
    specimen s = specimen_of(x->space, x->laws[0], 0.2, 1, 2.6, (int)length / 2, SIDE, 6);
    peri_material_desc right = s.material;
    peri_body *b;
    s.desc.precision = x->precision;
    s.desc.kernel = kernel;
    s.desc.instructions = limit_instructions;
    s.desc.threads = thread_count;
    s.desc.ledger = 1;
    for (int half = 0; half < 2; ++half) {
        peri_material_desc *m = half ? &right : &s.material;
        peri_material_desc_init(m, x->laws[half]);
        m->young = 1 + half;
        m->density = 1;
        if (x->laws[half] != PERI_LAW_BOND_BASED) {
            m->poisson = 0.2 + 0.1 * half;
            m->criterion = x->criterion;
        }
        if (x->criterion == PERI_CRITERION_PRINCIPAL_STRESS && m->poisson > 0) m->strength = 0.02;
        else m->fracture_energy = 4e-4;
        if (m->criterion == PERI_CRITERION_CONFINED_STRETCH) m->compression = 0.25;
    }
    b = specimen_start(&s);
    (void)MUST(b, peri_add_material(b, &right));
    (void)MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), s.lo, s.hi, 1));
    const double lo[3] = {s.hi[0], 0, 0}, hi[3] = {length, s.hi[1], s.hi[2]};
    (void)MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 2), lo, hi, 1));
    (void)MUST(b, peri_build(b));
    (void)MUST(b, peri_add_velocity(b, (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi)), pull));
    return b;
}

static double apart(peri_body *a, peri_body *b, int32_t field, double *size) {
    const int64_t n = peri_size_of_field(a, field);
    double *x = (double *)malloc((size_t)n * sizeof *x), *y = (double *)malloc((size_t)n * sizeof *y), most = 0;
    *size = 0;
    (void)MUST(a, peri_get_field(a, field, x, n));
    (void)MUST(b, peri_get_field(b, field, y, n));
    for (int64_t k = 0; k < n; ++k) {
        most = fmax(most, fabs(x[k] - y[k]));
        *size = fmax(*size, fabs(y[k]));
    }
    free(x);
    free(y);
    return most;
}

static void compare(const mixture *x) {
    const double round = x->precision == PERI_PRECISION_DOUBLE ? 1e-12 : 2e-4;
    peri_body *fast = body_of(x, x->kernel), *plain = body_of(x, PERI_KERNEL_REFERENCE);
    peri_advance_desc run;
    double size, start[3], end[3], angular[3];
    int64_t broken = 0;
    (void)MUST(fast, peri_get_momentum(fast, start, angular));
    CHECK((strstr(peri_kernel_text(fast), "columns") != NULL) == (x->kernel == PERI_KERNEL_BEST));
    peri_advance_desc_init(&run);
    run.time_step = 0.2;
    for (int stretch = 0; stretch < 4; ++stretch) {
        run.steps = 10;
        (void)MUST(fast, peri_advance(fast, &run));
        (void)MUST(plain, peri_advance(plain, &run));
        broken = peri_broken_count(plain);
        CHECK(peri_broken_count(fast) == broken || x->precision != PERI_PRECISION_DOUBLE);
        if (broken > 0 && x->precision != PERI_PRECISION_DOUBLE) break; /* rounding may break another bond first from here on */
        CHECK(apart(fast, plain, PERI_FIELD_FORCE_DENSITY, &size) <= round * size);
        CHECK(apart(fast, plain, PERI_FIELD_ENERGY_DENSITY, &size) <= round * size);
    }
    CHECK(broken > 10 || x->precision != PERI_PRECISION_DOUBLE);
    (void)MUST(fast, peri_get_momentum(fast, end, angular));
    for (int d = 0; d < 2; ++d) CHECK_NEAR(end[d], start[d], x->precision == PERI_PRECISION_DOUBLE ? 1e-12 : 1e-5, 0);
    peri_body_destroy(fast);
    peri_body_destroy(plain);
}

static void every_pair_of_laws(void) {
    static const int32_t precisions[3] = {PERI_PRECISION_DOUBLE, PERI_PRECISION_SINGLE, PERI_PRECISION_MIXED};
    for (int32_t space = PERI_SPACE_PLANE_STRAIN; space <= PERI_SPACE_SOLID; ++space)
        for (int p = 0; p < 3; ++p)
            for (int32_t a = PERI_LAW_BOND_BASED; a < peri__end_law; ++a)
                for (int32_t z = a + 1; z < peri__end_law; ++z) {
                    /* each pair in one precision, in the plane or in solids; all with --long */
                    if (!test_long && ((a + z + space) % 3 != p || space == PERI_SPACE_PLANE_STRAIN + (a + z) % 2)) continue;
                    const mixture x = {space, precisions[p], {a, z}, PERI_CRITERION_STRETCH, PERI_KERNEL_BEST};
                    compare(&x);
                }
}

static void every_criterion(void) {
    for (int32_t criterion = PERI_CRITERION_BOND_ENERGY; criterion <= PERI_CRITERION_NODE_ENERGY; ++criterion)
        for (int32_t space = PERI_SPACE_PLANE_STRAIN; space <= PERI_SPACE_SOLID; ++space)
            for (int32_t law = PERI_LAW_LPS; law < peri__end_law; ++law) {
                const mixture alone = {space, PERI_PRECISION_DOUBLE, {law, law}, criterion, PERI_KERNEL_BEST};
                const mixture beside = {space, PERI_PRECISION_DOUBLE, {law, PERI_LAW_BOND_BASED}, criterion, PERI_KERNEL_BEST};
                /* each law under each criterion beside another law in one space, and alone where that is a plane; all with --long */
                const int turn = (criterion + space + law) % 2;
                if (test_long || (turn == 0 && space != PERI_SPACE_SOLID)) compare(&alone);
                if (test_long || turn == 1) compare(&beside);
            }
}

/* Pairs of laws, and criteria of one law, on the list. */
static void on_the_list(void) {
    static const int32_t criteria[4] = {PERI_CRITERION_BOND_ENERGY, PERI_CRITERION_NODE_ENERGY, PERI_CRITERION_CONFINED_STRETCH,
                                        PERI_CRITERION_PRINCIPAL_STRESS};
    static const int32_t precisions[3] = {PERI_PRECISION_DOUBLE, PERI_PRECISION_SINGLE, PERI_PRECISION_MIXED};
    for (int32_t space = PERI_SPACE_PLANE_STRAIN; space <= PERI_SPACE_SOLID; ++space)
        for (int p = 0; p < 3; ++p)
            for (int32_t law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law)
                for (int n = 0; n < 5; ++n) {
                    const int32_t other = n < 4 ? law : law + 1 < peri__end_law ? law + 1 : PERI_LAW_LPS;
                    const mixture x = {space, precisions[p], {law, other}, n < 4 ? criteria[n] : PERI_CRITERION_STRETCH, PERI_KERNEL_LIST};
                    /* criteria see laws with a dilatation or a gradient; each of these in one precision, those of energy in double, where
                       bonds are counted; some in solids; all with --long */
                    if (n < 4 && law == PERI_LAW_BOND_BASED) continue;
                    const int chosen = n < 2 ? p == 0 && space != PERI_SPACE_SOLID : (law + n + space) % 3 == p;
                    if (test_long || (chosen && (space != PERI_SPACE_SOLID || (law + n) % 4 == 0))) compare(&x);
                }
}

static void energies_of_mixtures_on_the_list(void) {
    for (int32_t law = PERI_LAW_BOND_BASED; law <= PERI_LAW_OTERKUS; law += PERI_LAW_OTERKUS - PERI_LAW_BOND_BASED) {
        const mixture nodes = {PERI_SPACE_PLANE_STRAIN, PERI_PRECISION_DOUBLE, {PERI_LAW_LPS, law}, PERI_CRITERION_NODE_ENERGY,
                               PERI_KERNEL_LIST};
        mixture bonds = nodes;
        bonds.criterion = PERI_CRITERION_BOND_ENERGY;
        compare(&nodes);
        compare(&bonds);
    }
}

/* Bodies whose bonds break move alike, to the last bit, whatever the vectors and the number of threads. */
static void bits(void) {
    const mixture all[6] = {
        {PERI_SPACE_PLANE_STRAIN, PERI_PRECISION_DOUBLE, {PERI_LAW_BOND_BASED, PERI_LAW_LPS}, PERI_CRITERION_STRETCH, PERI_KERNEL_LIST},
        {PERI_SPACE_PLANE_STRAIN, PERI_PRECISION_SINGLE, {PERI_LAW_LPS, PERI_LAW_LPS}, PERI_CRITERION_BOND_ENERGY, PERI_KERNEL_LIST},
        {PERI_SPACE_SOLID, PERI_PRECISION_SINGLE, {PERI_LAW_CORRESPONDENCE, PERI_LAW_CORRESPONDENCE}, PERI_CRITERION_NODE_ENERGY,
         PERI_KERNEL_LIST},
        {PERI_SPACE_PLANE_STRAIN, PERI_PRECISION_DOUBLE, {PERI_LAW_CORRESPONDENCE, PERI_LAW_CORRESPONDENCE}, PERI_CRITERION_NODE_ENERGY,
         PERI_KERNEL_BEST},
        {PERI_SPACE_PLANE_STRAIN, PERI_PRECISION_MIXED, {PERI_LAW_LPS, PERI_LAW_LPS}, PERI_CRITERION_CONFINED_STRETCH, PERI_KERNEL_LIST},
        {PERI_SPACE_SOLID, PERI_PRECISION_SINGLE, {PERI_LAW_LPS, PERI_LAW_LPS}, PERI_CRITERION_CONFINED_STRETCH, PERI_KERNEL_BEST},
    };
    for (size_t k = 0; k < sizeof all / sizeof all[0]; ++k) {
        double *u[4];
        int64_t n = 0;
        for (int way = 0; way < 4; ++way) {
            peri_advance_desc run;
            limit_instructions = PERI_INSTRUCTIONS_BEST + way;
            thread_count = way == 1 ? 3 : 1;
            peri_body *b = body_of(&all[k], all[k].kernel);
            peri_advance_desc_init(&run);
            run.time_step = 0.2;
            run.steps = 20;
            (void)MUST(b, peri_advance(b, &run));
            CHECK(peri_broken_count(b) > 0);
            n = peri_size_of_field(b, PERI_FIELD_DISPLACEMENT);
            u[way] = (double *)malloc((size_t)n * sizeof(double));
            (void)MUST(b, peri_get_field(b, PERI_FIELD_DISPLACEMENT, u[way], n));
            peri_body_destroy(b);
        }
        for (int way = 1; way < 4; ++way) CHECK(memcmp(u[0], u[way], (size_t)n * sizeof(double)) == 0);
        for (int way = 0; way < 4; ++way) free(u[way]);
    }
    limit_instructions = PERI_INSTRUCTIONS_BEST;
    thread_count = 1;
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(every_pair_of_laws);
    RUN(every_criterion);
    RUN(on_the_list);
    RUN(energies_of_mixtures_on_the_list);
    RUN(bits);
    return test_end("test_mixtures");
}
