/* SPDX-License-Identifier: MIT */
/* material.c - engineering constants to those of the laws: micromodulus, moduli of the plane, critical stretch and energy. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_COOKIE_MATERIAL (UINT64_C(0x7065726900010000) + sizeof(peri_material_desc))

/* What a law differs in. Where p is proportional to A and that vanishes nothing is gathered. */
static void peri__set_traits(peri__law *law, int32_t kind) {
    law->kind = kind;
    law->gather = law->gauge = law->pairwise = 0;
    switch (kind) {
#define PERI_CASE(name, number)                                                                                        \
    case number:                                                                                                       \
        law->gather = PERI__BY_A_##name && law->a == 0.0 ? PERI__NO_GATHER : PERI__GATHER_##name;                      \
        law->gauge = PERI__GAUGE_##name;                                                                               \
        law->pairwise = PERI__PAIRWISE_##name;                                                                         \
        break;
        PERI_LAW_LIST(PERI_CASE)
#undef PERI_CASE
    default: break;
    }
}

static peri__law peri__traits_of(int32_t kind) {
    peri__law law;
    memset(&law, 0, sizeof law);
    law.a = 1.0;
    peri__set_traits(&law, kind);
    return law;
}

static int peri__is_pairwise(int32_t kind) { return peri__traits_of(kind).pairwise; }

static int peri__has_gradient(int32_t kind) { return (peri__traits_of(kind).gather & PERI__GRADIENT) != 0; }

PERI_API void peri_material_desc_init(peri_material_desc *m, int32_t law) {
    if (!m) return;
    memset(m, 0, sizeof *m);
    m->cookie = PERI_COOKIE_MATERIAL;
    m->law = law;
    m->poisson = (double)NAN;
    m->criterion = PERI_CRITERION_STRETCH;
    m->stabilization = peri__has_gradient(law) ? 0.2 : 0.0;
}

static double peri__bond_poisson(int32_t space) { return space == PERI_SPACE_PLANE_STRESS ? 1.0 / 3.0 : 0.25; }

static double peri__poisson(const peri_material_desc *m, int32_t space) {
    return m->law == PERI_LAW_BOND_BASED ? peri__bond_poisson(space) : m->poisson;
}

static double peri__young(const peri_material_desc *m, int32_t space) {
    return m->young > 0.0 ? m->young : 3.0 * (1.0 - 2.0 * peri__poisson(m, space)) * m->bulk;
}

/* The elasticity of a material in units of stress. A vanishes to the last bit at the Poisson ratio of a bond-based material. */
static peri__law peri__law_of(const peri_material_desc *m, int32_t space, double stress) {
    peri__law law;
    int dim = space == PERI_SPACE_SOLID ? 3 : 2;
    double nu = peri__poisson(m, space);
    law.young = peri__young(m, space) / stress;
    law.mu = law.young / (2.0 * (1.0 + nu));
    law.lambda = law.young * nu / ((1.0 + nu) * (space == PERI_SPACE_PLANE_STRESS ? 1.0 - nu : 1.0 - 2.0 * nu));
    /* lambda + 2 mu/dim, by forms that cancel no digits near nu = -1 */
    law.bulk = space == PERI_SPACE_PLANE_STRESS ? law.young / (2.0 * (1.0 - nu))
             : space == PERI_SPACE_PLANE_STRAIN ? law.young / (2.0 * (1.0 + nu) * (1.0 - 2.0 * nu)) : law.young / (3.0 * (1.0 - 2.0 * nu));
    law.a = dim * (law.lambda - law.mu);
    law.b = dim * (dim + 2) * law.mu;
    if (fabs(nu - peri__bond_poisson(space)) < 1e-9) law.a = 0.0;
    law.stabilization = m->stabilization;
    peri__set_traits(&law, m->law);
    return law;
}

/* Is the spring of Oterkus in a whole family less than shear asks for? See peri__calibrate; q m = D (D + 2) mu in the ball. */
static int peri__is_soft(peri_body *b, const peri__law *law, double edge) {
    const int dim = b->dim;
    double plain, length, m;
    if (law->kind != PERI_LAW_OTERKUS || !peri__moment(b, dim - 1, edge, &plain) || !peri__moment(b, dim, edge, &length)
        || !peri__moment(b, dim + 1, edge, &m))
        return 0;
    const double room = m * plain / (length * length) - 1.0;
    return (dim + 2) * law->mu * room > law->bulk * dim * (1.0 + room);
}

/* Fills the units of time and energy from those of length, stress and density. Results are products of units with numbers between 1e-30 and
   1e30 or so: units that leave double no room for that are refused. */
static int32_t peri__fill_units(peri_body *b, peri__model *m) {
    const double volume = m->length * m->length * (b->dim == 3 ? m->length : b->desc.thickness);
    m->time = m->length * (sqrt(m->density) / sqrt(m->stress)); /* the ratio itself may leave the range */
    m->energy = m->stress * volume;
    const double units[] = { volume, m->time, m->length / m->time, m->stress / m->length, m->stress / m->length / m->length, m->density,
                             m->density * volume, m->energy, m->energy / m->length, m->energy / m->length / m->length,
                             m->energy * m->time, m->energy * m->time / m->length };
    for (size_t k = 0; k < sizeof units / sizeof *units; ++k)
        if (!(units[k] > 1e-250 && units[k] < 1e250))
            return peri__fail(b, PERI_ERROR_RANGE, "spacing, young, density", -1, units[k]);
    return PERI_OK;
}

/* w0 of the energy criteria, see bond_energy.inl. Per unit thickness in 2D. */
static double peri__critical_energy(const peri_material_desc *m, int32_t space, double horizon) {
    double h3 = horizon * horizon * horizon;
    return space == PERI_SPACE_SOLID ? 4.0 * m->fracture_energy / (PERI_PI * h3 * horizon) : 1.5 * m->fracture_energy / h3;
}

/* What a crack takes over G0 where the energy of points is held to the w0 of a bond, `across` spacings to the horizon; live: see
   peri__takes_over. Few of the bonds of a point cross the crack beside it, the fewer the farther it is: the mean of a family that is to
   break the last of them is far above what the bonds in the plane need. What is taken goes with w0. Fitted to strips torn slowly, constant
   w, 2 to 9 spacings in the plane and 2 to 4 in 3D: docs/accuracy.md, Fracture energy. */
static double peri__node_share(int32_t space, double across, int32_t live) {
    const double most = space == PERI_SPACE_SOLID ? (live ? 12.0 : 15.5) : live ? 9.4 : 13.3;
    const double lost = space == PERI_SPACE_SOLID ? (live ? 1.4 : 1.35) : live ? 1.45 : 1.42;
    return most * (1.0 - lost / fmax(across, 2.0));
}

typedef struct peri__fracture { /* what limits follow from                                                                */
    const peri_material_desc *material;
    int32_t space;
    double  horizon; /* inner units                                                                                      */
    double  unit;    /* of energy per area                                                                               */
    double  stress;  /* of stress                                                                                        */
    double  energy;  /* G0, inner units                                                                                  */
    double  c;       /* of a pairwise law with the same central bonds                                                    */
    double  moment;  /* of the influence function: I4 in 3D, I3 in the plane, see peri__constants                        */
    double  across;  /* spacings to the horizon                                                                          */
    int32_t live;    /* 1: bonds that are left take over what broken ones carried                                        */
} peri__fracture;

static double peri__limit_of_stress(const peri__fracture *g, double limit) { return limit > 0.0 ? limit / g->stress : PERI_NEVER; }

#define PERI_CRITERION_ROLE_LIMIT
#include "criteria.inl"
#undef PERI_CRITERION_ROLE_LIMIT

/* Does what a bond carried go to those that are left? Of correspondence it goes to H, which the bonds average: not so. */
static int32_t peri__takes_over(const peri_body *b, const peri_material_desc *m) {
    return b->desc.moments == PERI_MOMENTS_LIVE && !peri__has_gradient(m->law);
}

static double peri__limit_of(const peri__fracture *fracture) {
    switch (fracture->material->criterion) {
#define PERI_CASE(name, number) case number: return peri__limit_##name(fracture);
        PERI_CRITERION_LIST(PERI_CASE)
#undef PERI_CASE
    default: return PERI_NEVER;
    }
}

/* How the criterion of a material is seen. */
static int32_t peri__seen_by(int32_t criterion) {
    switch (criterion) {
#define PERI_CASE(name, number) case number: return PERI__SEEN_##name;
        PERI_CRITERION_LIST(PERI_CASE)
#undef PERI_CASE
    default: return PERI__BY_STRETCH;
    }
}

static int peri__is_by_stretch(int32_t seen) {
    return !(seen & (PERI__BY_WORK | PERI__BY_NODE_ENERGY | PERI__BY_ROWS | PERI__BY_STRESS));
}

/* The least critical stretch of any kind. */
static double peri__least_critical(const peri__pair *pair) {
    double least = PERI_NEVER;
#define PERI_CASE(name, number)                                                                                        \
    if (peri__is_by_stretch(PERI__SEEN_##name) && pair->limit[(number) - peri__first_criterion] < least)               \
        least = pair->limit[(number) - peri__first_criterion];
    PERI_CRITERION_LIST(PERI_CASE)
#undef PERI_CASE
    return least;
}

/* s + a least > s0 is met by no s below s0/(1 + a). */
static void peri__set_stretch(peri__pair *pair) {
    const double least = peri__least_critical(pair);
    pair->s0 = least < PERI_NEVER ? least / (1.0 + pair->compression) : PERI_NEVER;
}

/* Can bonds of this pair break? */
static int peri__is_breakable(const peri__pair *pair) {
    int breakable = 0;
    for (int32_t k = 0; k < peri__count_criterion; ++k) breakable |= pair->limit[k] < PERI_NEVER;
    return breakable;
}

static uint32_t peri__criteria_of(const peri__pair *pair) {
    uint32_t criteria = 0;
    for (int32_t k = 0; k < peri__count_criterion; ++k) criteria |= (uint32_t)(pair->limit[k] < PERI_NEVER) << k;
    return criteria;
}

/* What criteria ask of a material: fields that none but theirs may have, and those that they cannot do without. */
static int32_t peri__check_criterion(peri_body *b, const peri_material_desc *m) {
    const int32_t seen = peri__seen_by(m->criterion), mohr = m->criterion == PERI_CRITERION_MOHR_COULOMB;
    const int by_energy = (seen & (PERI__BY_WORK | PERI__BY_NODE_ENERGY)) != 0, by_stress = (seen & PERI__BY_STRESS) != 0;
    const int rated = m->criterion == PERI_CRITERION_RATE_STRETCH, delayed = m->criterion == PERI_CRITERION_DELAYED_STRETCH;
    const int confined = m->criterion == PERI_CRITERION_CONFINED_STRETCH, limited = m->fracture_energy > 0.0 || m->critical_stretch > 0.0;
    const struct {
        const char *name;
        double      value, end; /* below `end`                                                                            */
        int         taken, needed;
    } field[] = {
        { "strength", m->strength, HUGE_VAL, by_stress, by_stress && !mohr },
        { "cohesion", m->cohesion, HUGE_VAL, mohr, mohr },
        { "friction_angle", m->friction_angle, 0.5 * PERI_PI, mohr, 0 },
        { "compression", m->compression, 1e3 * (1.0 + DBL_EPSILON), confined, 0 },
        { "rate", m->rate, HUGE_VAL, rated, rated },
        { "rate_power", m->rate_power, 10.0 * (1.0 + DBL_EPSILON), rated, 0 },
        { "delay", m->delay, HUGE_VAL, delayed, delayed },
        { "fracture_energy", m->fracture_energy, HUGE_VAL, !by_stress, by_energy },
        { "critical_stretch", m->critical_stretch, HUGE_VAL, !by_stress, (confined || rated || delayed) && !limited },
    };
    for (size_t k = 0; k < sizeof field / sizeof *field; ++k)
        if (!(field[k].value >= 0.0 && field[k].value < field[k].end))
            return peri__fail(b, PERI_ERROR_RANGE, field[k].name, -1, field[k].value);
    if (by_energy && peri__is_pairwise(m->law)) return peri__fail(b, PERI_ERROR_CRITERION, "criterion", -1, m->criterion);
    for (size_t k = 0; k < sizeof field / sizeof *field; ++k)
        if ((field[k].value > 0.0 && !field[k].taken) || (field[k].value <= 0.0 && field[k].needed))
            return peri__fail(b, PERI_ERROR_CRITERION, field[k].name, -1, m->criterion);
    if (seen != PERI__BY_STRETCH && peri__is_planar(b->desc.quadrature))
        return peri__fail(b, PERI_ERROR_CRITERION, "quadrature", -1, b->desc.quadrature);
    return PERI_OK;
}

/* What a material is beyond the elasticity of its law: bits of peri__inelastic. */
static int32_t peri__inelastic_of(const peri_material_desc *m) {
    return (m->yield_shear > 0.0 || m->relaxations > 0 ? PERI__FLOWS : 0) | (m->stress ? PERI__OWN_STRESS : 0);
}

/* Notes what material k, which is used, asks of the body for that. */
static void peri__note_inelastic(peri__model *m, int32_t k, const peri_material_desc *material) {
    const int32_t inelastic = peri__inelastic_of(material), past = material->yield_shear > 0.0 ? 2 : 1 + material->relaxations;
    m->inelastic |= inelastic;
    m->past.raw[k] = (inelastic & PERI__OWN_STRESS) != 0;
    if (inelastic & PERI__FLOWS && past > m->past.bond) m->past.bond = past;
    if (inelastic & PERI__OWN_STRESS && material->history > m->past.point) m->past.point = material->history;
}

/* Times at which parts of the stiffness in shear relax. */
static int32_t peri__check_relaxations(peri_body *b, const peri_material_desc *m) {
    double whole = 0.0;
    if (m->relaxations < 0 || m->relaxations > PERI_RELAXATIONS) return peri__fail(b, PERI_ERROR_RANGE, "relaxations", -1, m->relaxations);
    for (int k = 0; k < m->relaxations; ++k) {
        const double part = m->relaxation_part[k], time = m->relaxation_time[k];
        if (!(part > 0.0 && part <= 1.0)) return peri__fail(b, PERI_ERROR_RANGE, "relaxation_part", k, part);
        if (!(time > 0.0 && peri__finite(time))) return peri__fail(b, PERI_ERROR_RANGE, "relaxation_time", k, time);
        whole += part;
    }
    return whole <= 1.0 + 1e-12 ? PERI_OK : peri__fail(b, PERI_ERROR_RANGE, "relaxation_part", -1, whole);
}

static int32_t peri__check_inelastic(peri_body *b, const peri_material_desc *m) {
    const int32_t inelastic = peri__inelastic_of(m);
    PERI_NEED_NUMBER(b, m->yield_shear >= 0.0, m->yield_shear);
    const int32_t status = peri__check_relaxations(b, m);
    if (status < 0) return status;
    if (m->history < 0 || m->history > PERI_HISTORY) return peri__fail(b, PERI_ERROR_RANGE, "history", -1, m->history);
    if (m->history > 0 && !m->stress) return peri__fail(b, PERI_ERROR_ARGUMENT, "stress", -1, 0.0);
    if (m->yield_shear > 0.0 && m->relaxations > 0) return peri__fail(b, PERI_ERROR_MATERIAL, "relaxations", -1, m->relaxations);
    if (inelastic & PERI__FLOWS && m->law != PERI_LAW_LPS)
        return peri__fail(b, PERI_ERROR_LAW, m->relaxations > 0 ? "relaxations" : "yield_shear", -1, m->law);
    if (m->stress && !peri__has_gradient(m->law)) return peri__fail(b, PERI_ERROR_LAW, "stress", -1, m->law);
    if (inelastic && peri__seen_by(m->criterion) != PERI__BY_STRETCH)
        return peri__fail(b, PERI_ERROR_CRITERION, "criterion", -1, m->criterion);
    return PERI_OK;
}

/* What only some laws can have. */
static int32_t peri__check_law(peri_body *b, const peri_material_desc *m) {
    int32_t space = b->desc.space, bonds = m->law == PERI_LAW_BOND_BASED;
    PERI_NEED_CHOICE(b, law, m->law);
    PERI_NEED_CHOICE(b, criterion, m->criterion);
    PERI_NEED_NUMBER(b, m->stabilization >= 0.0, m->stabilization);
    if (!peri__has_gradient(m->law) && m->stabilization != 0.0)
        return peri__fail(b, PERI_ERROR_LAW, "stabilization", -1, m->stabilization);
    const int32_t status = peri__check_criterion(b, m);
    if (status < 0) return status;
    if (!bonds && peri__is_planar(b->desc.quadrature))
        return peri__fail(b, PERI_ERROR_LAW, "quadrature", -1, b->desc.quadrature);
    if (!bonds) PERI_NEED_NUMBER(b, m->poisson > -1.0 && m->poisson < 0.5, m->poisson);
    if (bonds && m->poisson == m->poisson && fabs(m->poisson - peri__bond_poisson(space)) > 1e-9)
        return peri__fail(b, PERI_ERROR_POISSON, "poisson", -1, peri__bond_poisson(space));
    return peri__check_inelastic(b, m);
}

static int32_t peri__check_material(peri_body *b, const peri_material_desc *m, int need_density) {
    PERI_NEED(b, m, "desc");
    if (m->cookie != PERI_COOKIE_MATERIAL) return peri__fail(b, PERI_ERROR_DESCRIPTOR, "desc", -1, 0.0);
    PERI_NEED_NUMBER(b, m->young >= 0.0, m->young);
    PERI_NEED_NUMBER(b, m->bulk >= 0.0, m->bulk);
    PERI_NEED_NUMBER(b, m->fracture_energy >= 0.0, m->fracture_energy);
    PERI_NEED_NUMBER(b, m->critical_stretch >= 0.0, m->critical_stretch);
    if (need_density) PERI_NEED_NUMBER(b, m->density > 0.0, m->density);
    if ((m->young > 0.0) == (m->bulk > 0.0)) return peri__fail(b, PERI_ERROR_MATERIAL, "bulk", -1, m->bulk);
    if (m->fracture_energy > 0.0 && m->critical_stretch > 0.0)
        return peri__fail(b, PERI_ERROR_MATERIAL, "critical_stretch", -1, m->critical_stretch);
    return peri__check_law(b, m);
}

PERI_API int32_t peri_add_material(peri_body *b, const peri_material_desc *m) {
    PERI_NEED_UNBUILT(b);
    int32_t status = peri__check_material(b, m, 1);
    if (status < 0) return status;
    status = peri__check_room(b, PERI_KIND_MATERIAL, PERI_MATERIAL_LIMIT, "peri_add_material");
    if (status < 0) return status;
    b->materials[b->material_count] = *m;
    return peri__id(b, PERI_KIND_MATERIAL, b->material_count++);
}

/* The indices of two materials. */
static int32_t peri__find_materials(peri_body *b, int32_t i, int32_t j, int32_t *index) {
    const int64_t p = peri__find(b, PERI_KIND_MATERIAL, i, "i"), q = p < 0 ? p : peri__find(b, PERI_KIND_MATERIAL, j, "j");
    if (q < 0) return (int32_t)q;
    index[0] = (int32_t)p;
    index[1] = (int32_t)q;
    return PERI_OK;
}

/* Of bond-based materials the interface is bond-based, and has a stiffness of its own; else it is of the law of an end that is not, and
   has a strength. */
static int32_t peri__check_interface(peri_body *b, int32_t i, int32_t j, int32_t law) {
    const int32_t ends[2] = { b->materials[i].law, b->materials[j].law };
    const int springs = peri__is_pairwise(ends[0]) && peri__is_pairwise(ends[1]);
    const int fits = (law == ends[0] || law == ends[1]) && peri__is_pairwise(law) == springs;
    return fits ? PERI_OK : peri__fail(b, PERI_ERROR_LAW, "law", -1, law);
}

PERI_API int32_t peri_set_interface(peri_body *b, int32_t first, int32_t second, const peri_material_desc *material) {
    int32_t at[2] = { 0, 0 };
    PERI_NEED_UNBUILT(b);
    int32_t status = peri__find_materials(b, first, second, at);
    if (status == PERI_OK && first == second) status = peri__fail(b, PERI_ERROR_MATERIAL, "j", second, 0.0);
    if (status == PERI_OK) status = peri__check_material(b, material, 0);
    if (status < 0) return status;
    const int32_t i = at[0], j = at[1];
    status = peri__check_interface(b, i, j, material->law);
    if (status < 0) return status;
    for (int64_t k = 0; k < b->interface_count; ++k) {
        peri__interface *face = &b->interfaces[k];
        if ((face->i == i && face->j == j) || (face->i == j && face->j == i)) {
            face->material = *material;
            return PERI_OK;
        }
    }
    if (!peri__grow(&b->memory, &b->interfaces, &b->interface_capacity, b->interface_count + 1, sizeof *b->interfaces))
        return peri__fail(b, PERI_ERROR_MEMORY, "peri_set_interface", -1, 0.0);
    peri__interface *face = &b->interfaces[b->interface_count++];
    face->i = i;
    face->j = j;
    face->material = *material;
    return PERI_OK;
}

/* Constants of the bonds of one material in units of stress and length; c per unit thickness in 2D.
     3D            c = 9K/(2 pi I3 h^4)   s0^2 = 2 G0/(pi c I4 h^5)      [T] 1.24, 1.39: 18K/(pi h^4), 5G0/(9Kh) for w = 1
     plane strain  c = 16E/(5 pi I2 h^3)  s0^2 = G0/(c I3 h^4)           [P] C.15, C.20
     plane stress  c = 3E/(pi I2 h^3)     s0^2 = G0/(c I3 h^4)           [P] C.18, C.20
   The central bonds of a state-based law with w are those of a bond-based one with w |xi|, so its moments are one higher. It has no c
   of its own; this one serves s0. It takes the energy of an opening crack, G = K_I^2/E', and so goes with E', in plane strain and 3D
   E/(1 - nu^2): springs alone, which go with mu, would have 4/3/(1 + nu) of that, and the dilatation of the ends has the rest. */
static int32_t peri__constants(peri_body *b, const peri_material_desc *m, double stress, double length, double edge,
                               peri__pair *pair) {
    int32_t space = b->desc.space, states = m->law != PERI_LAW_BOND_BASED;
    /* the limits of energies need no c */
    int solid = space == PERI_SPACE_SOLID, stretch = peri__is_by_stretch(peri__seen_by(m->criterion));
    double h = b->desc.horizon / length, modulus = peri__young(m, space) / stress, ic = 1.0, is = 1.0;
    for (int32_t k = 0; k < peri__count_criterion; ++k) pair->limit[k] = PERI_NEVER;
    pair->c = 0.0;
    if (!states || (stretch && m->fracture_energy > 0.0)) {
        if (!peri__moment(b, (solid ? 3 : 2) + states, edge, &ic) || !peri__moment(b, (solid ? 4 : 3) + states, edge, &is))
            return peri__fail(b, PERI_ERROR_INFLUENCE, "influence", -1, 0.0);
        if (states && space != PERI_SPACE_PLANE_STRESS) modulus *= (15.0 / 16.0) / (1.0 - m->poisson * m->poisson);
        if (solid) {
            double bulk = modulus / 1.5; /* K = E/(3(1-2 nu)), nu = 1/4 */
            pair->c = 9.0 * bulk / (2.0 * PERI_PI * ic * h * h * h * h);
        } else {
            pair->c = (space == PERI_SPACE_PLANE_STRAIN ? 3.2 : 3.0) * modulus / (PERI_PI * ic * h * h * h);
        }
    }
    const peri__fracture fracture = { m, space, h, stress * length, stress, m->fracture_energy / (stress * length), pair->c, is,
                                      edge > 0.0 ? 0.5 / edge : 0.0, peri__takes_over(b, m) };
    pair->limit[m->criterion - peri__first_criterion] = peri__limit_of(&fracture);
    if (m->criterion == PERI_CRITERION_MOHR_COULOMB)
        pair->limit[PERI_CRITERION_PRINCIPAL_STRESS - peri__first_criterion] = peri__limit_principal_stress(&fracture);
    pair->friction = tan(m->friction_angle);
    pair->compression = m->compression;
    pair->rate = m->rate;
    pair->power = m->rate_power > 0.0 ? m->rate_power : 1.0;
    pair->delay = m->delay;
    peri__set_stretch(pair);
    return PERI_OK;
}

static double peri__lower(double a, double b) { return a < b ? a : b; }

/* What goes with a limit is that of the material with the lower one; of equal ones what breaks first. */
static void peri__take_lower(const peri__pair *p, const peri__pair *q, peri__pair *pair) {
#define PERI_LIMIT_(of, name) (of)->limit[PERI_CRITERION_##name - peri__first_criterion]
#define PERI_TAKE_(name, member, first)                                                                                \
    if (PERI_LIMIT_(q, name) < PERI_LIMIT_(p, name) || (PERI_LIMIT_(q, name) == PERI_LIMIT_(p, name) && (first)))      \
        pair->member = q->member;
    PERI_TAKE_(MOHR_COULOMB, friction, q->friction < p->friction)
    PERI_TAKE_(CONFINED_STRETCH, compression, q->compression < p->compression)
    PERI_TAKE_(RATE_STRETCH, power, q->rate > p->rate)
    PERI_TAKE_(RATE_STRETCH, rate, q->rate > p->rate)
    PERI_TAKE_(DELAYED_STRETCH, delay, q->delay < p->delay)
#undef PERI_TAKE_
#undef PERI_LIMIT_
}

/* The same for the bonds between materials i and j, c as of the end i; own: of each material by itself. */
static int32_t peri__pair_constants(peri_body *b, int32_t i, int32_t j, double stress, double length, double edge,
                                    const peri__pair *own, peri__pair *pair) {
    const peri__pair *p = &own[i], *q = &own[j];
    for (int64_t k = 0; k < b->interface_count; ++k) {
        const peri__interface *face = &b->interfaces[k];
        if ((face->i == i && face->j == j) || (face->i == j && face->j == i)) {
            const int32_t status = peri__constants(b, &face->material, stress, length, edge, pair);
            if (!peri__is_pairwise(face->material.law)) pair->c = p->c; /* the ends are as stiff as they are */
            return status;
        }
    }
    *pair = *p;
    for (int32_t k = 0; k < peri__count_criterion; ++k) pair->limit[k] = peri__lower(p->limit[k], q->limit[k]);
    peri__take_lower(p, q, pair);
    peri__set_stretch(pair);
    if (i != j && b->materials[i].law == PERI_LAW_BOND_BASED && b->materials[j].law == PERI_LAW_BOND_BASED)
        pair->c = 2.0 * p->c * q->c / (p->c + q->c);
    return PERI_OK;
}

/* The law of the bonds between two materials, or NULL. */
static peri__bond_law *peri__declared_law(const peri_body *b, int32_t i, int32_t j) {
    for (int64_t k = 0; k < b->bond_law_count; ++k) {
        peri__bond_law *law = &b->bond_laws[k];
        if ((law->i == i && law->j == j) || (law->i == j && law->j == i)) return law;
    }
    return NULL;
}

PERI_API int32_t peri_get_bond_constants(peri_body *b, int32_t first, int32_t second, double *c, double *s0) {
    int32_t at[2] = { 0, 0 };
    PERI_NEED_BODY(b);
    int32_t status = peri__find_materials(b, first, second, at);
    if (status < 0) return status;
    const int32_t i = at[0], j = at[1];
    if (c && (b->materials[i].law != PERI_LAW_BOND_BASED || b->materials[j].law != PERI_LAW_BOND_BASED))
        return peri__fail(b, PERI_ERROR_LAW, "c", -1, 0.0);
    int solid = b->desc.space == PERI_SPACE_SOLID;
    double edge = 0.0, length = b->desc.horizon, stress = peri__young(&b->materials[i], b->desc.space);
    peri__pair pair, own[PERI_MATERIAL_LIMIT];
    const peri__bond_law *law = peri__declared_law(b, i, j);
    if (s0 && law && !law->fn) { /* tables are fitted to the families */
        PERI_NEED_BUILT(b);
    }
    if (b->desc.influence == PERI_INFLUENCE_POLE_EDGE) {
        PERI_NEED_BUILT(b);
        edge = 0.5 * b->model->spacing / b->model->horizon;
    }
    const int32_t former = peri__enter(b, PERI__IN_CALLBACK); /* influence_fn may be called */
    status = peri__constants(b, &b->materials[i], stress, length, edge, &own[i]);
    if (status == PERI_OK) status = peri__constants(b, &b->materials[j], stress, length, edge, &own[j]);
    if (status == PERI_OK) status = peri__pair_constants(b, i, j, stress, length, edge, own, &pair);
    peri__leave(b, former);
    status = peri__heed_influence(b, status);
    if (status < 0) return status;
    const double unit = stress / length / length / length / (solid ? length : b->desc.thickness), micromodulus = pair.c * unit;
    if (c && !(micromodulus >= DBL_MIN && peri__finite(micromodulus))) return peri__fail(b, PERI_ERROR_RANGE, "c", -1, micromodulus);
    if (c) *c = micromodulus;
    const double stretch = peri__least_critical(&pair);
    if (s0) *s0 = stretch < PERI_NEVER ? stretch : HUGE_VAL;
    if (s0 && law && !law->fn) *s0 = law->last;
    return PERI_OK;
}

PERI_API int32_t peri_get_critical_energy(peri_body *b, int32_t material, double *w0) {
    PERI_NEED_BODY(b);
    const int64_t at = peri__find(b, PERI_KIND_MATERIAL, material, "material");
    if (at < 0) return (int32_t)at;
    PERI_NEED(b, w0, "w0");
    const peri_material_desc *m = &b->materials[at];
    const double h = b->desc.horizon, last = b->desc.space == PERI_SPACE_SOLID ? h : b->desc.thickness;
    double critical = peri__critical_energy(m, b->desc.space, 1.0) / h / h / h / last;
    if (m->criterion == PERI_CRITERION_NODE_ENERGY) {
        PERI_NEED_BUILT(b);
        critical /= peri__node_share(b->desc.space, b->model->horizon / b->model->spacing, peri__takes_over(b, m));
    }
    const int by_energy = (peri__seen_by(m->criterion) & (PERI__BY_WORK | PERI__BY_NODE_ENERGY)) != 0;
    if (by_energy && !(critical >= DBL_MIN && peri__finite(critical)))
        return peri__fail(b, PERI_ERROR_RANGE, "w0", -1, critical);
    *w0 = by_energy ? critical : HUGE_VAL;
    return PERI_OK;
}
