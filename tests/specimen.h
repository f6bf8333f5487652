/* SPDX-License-Identifier: MIT */
/* specimen.h - a body of one material in a box, described by the library's own structs with the defaults of the tests: fill in what the
   test is about, make it. What is refused fails the test. */
#ifndef SPECIMEN_H
#define SPECIMEN_H

#include "peri_test.h"

typedef struct specimen {
    peri_body_desc desc;
    peri_material_desc  material;
    double         lo[3], hi[3], spacing;
    double         scatter; /* > 0: points are moved at random by up to this share of half a spacing, from seed              */
    uint64_t       seed;
} specimen;

/* One thread (most bodies are too small to share), unit modulus and density, no fracture; poisson where the law lets one choose. From the
   origin to (nx, ny, nz) cells of `spacing`; horizon over spacing is `reach`. */
static inline specimen specimen_of(int32_t space, int32_t law, double poisson, double spacing, double reach, int nx, int ny, int nz) {
    specimen s;
    memset(&s, 0, sizeof s);
    peri_body_desc_init(&s.desc);
    s.desc.space = space;
    s.desc.horizon = reach * spacing;
    s.desc.threads = 1;
    peri_material_desc_init(&s.material, law);
    s.material.young = 1;
    s.material.density = 1;
    if (law != PERI_LAW_BOND_BASED) s.material.poisson = poisson;
    s.spacing = spacing;
    s.hi[0] = nx * spacing;
    s.hi[1] = ny * spacing;
    s.hi[2] = nz * spacing;
    return s;
}

/* Without points, with its material. */
static inline peri_body *specimen_start(const specimen *s) {
    peri_body *b = NULL;
    (void)MUST(NULL, peri_body_create(&s->desc, &b, NULL));
    (void)MUST(b, peri_add_material(b, &s->material));
    return b;
}

/* With its box, built. */
static inline peri_body *specimen_make(const specimen *s) {
    peri_body *b = specimen_start(s);
    const int32_t material = peri_id(b, PERI_KIND_MATERIAL, 1);
    if (s->scatter > 0) (void)MUST(b, peri_add_perturbed_box(b, material, s->lo, s->hi, s->spacing, s->scatter, s->seed));
    else (void)MUST(b, peri_add_box(b, material, s->lo, s->hi, s->spacing));
    (void)MUST(b, peri_build(b));
    return b;
}

/* What peri_add_material says of a description in a body without points; a refusal names the field and the entry. */
static inline int32_t material_status(int32_t space, const peri_material_desc *m, const char *field, int64_t index) {
    peri_body_desc d;
    peri_body *b = NULL;
    peri_error error;
    peri_body_desc_init(&d);
    d.space = space;
    d.horizon = 3;
    (void)MUST(NULL, peri_body_create(&d, &b, NULL));
    const int32_t status = peri_add_material(b, m);
    (void)MUST(b, peri_get_error(b, &error));
    CHECK(status >= 0 || (strcmp(error.field, field) == 0 && error.index == index));
    peri_body_destroy(b);
    return status;
}

/* The plan of its box; measure: as in peri_plan_desc. */
static inline peri_plan_report specimen_plan(const specimen *s, int32_t measure) {
    peri_plan_desc p;
    peri_plan_report r;
    memset(&r, 0, sizeof r);
    peri_plan_desc_init(&p);
    p.body = &s->desc;
    p.material = &s->material;
    p.spacing = s->spacing;
    p.measure = measure;
    if (s->scatter > 0) p.source = PERI_SOURCE_PERTURBED, p.amount = s->scatter;
    memcpy(p.hi, s->hi, sizeof p.hi);
    CHECK(peri_plan(&p, &r, NULL) == PERI_OK);
    return r;
}

#endif
