/* SPDX-License-Identifier: MIT */
/* criterion.h - the fields that each criterion asks for, such that bonds break at a stretch of about s0. */
#ifndef CRITERION_H
#define CRITERION_H

#include "peri_test.h"

static inline void give_criterion(peri_material_desc *m, int32_t criterion, double s0, double horizon, double time) {
    m->criterion = criterion;
    switch (criterion) {
    case PERI_CRITERION_STRETCH: m->critical_stretch = s0; break;
    case PERI_CRITERION_BOND_ENERGY:
    case PERI_CRITERION_NODE_ENERGY: m->fracture_energy = m->young * s0 * s0 * horizon; break;
    case PERI_CRITERION_PRINCIPAL_STRESS:
    case PERI_CRITERION_VON_MISES: m->strength = m->young * s0; break;
    case PERI_CRITERION_MOHR_COULOMB:
        m->cohesion = 0.8 * m->young * s0;
        m->friction_angle = 0.5;
        m->strength = m->young * s0;
        break;
    case PERI_CRITERION_CONFINED_STRETCH:
        m->critical_stretch = s0;
        m->compression = 0.25;
        break;
    case PERI_CRITERION_RATE_STRETCH:
        m->critical_stretch = 0.7 * s0;
        m->rate = s0 / time;
        m->rate_power = 0.3;
        break;
    case PERI_CRITERION_DELAYED_STRETCH:
        m->critical_stretch = 0.7 * s0;
        m->delay = time;
        break;
    default: break;
    }
}

#endif
