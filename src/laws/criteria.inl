/* SPDX-License-Identifier: MIT */
/* criteria.inl - the criteria there are, in the role that is asked for, and the list of them. */
#include "stretch.inl"
#include "bond_energy.inl"
#include "node_energy.inl"
#include "principal_stress.inl"
#include "von_mises.inl"
#include "mohr_coulomb.inl"
#include "confined_stretch.inl"
#include "rate_stretch.inl"
#include "delayed_stretch.inl"

#ifndef PERI_CRITERION_LIST
/* X(name, number) for every criterion */
#define PERI_CRITERION_LIST(X)                         \
    X(stretch, PERI_CRITERION_STRETCH)                 \
    X(bond_energy, PERI_CRITERION_BOND_ENERGY)         \
    X(node_energy, PERI_CRITERION_NODE_ENERGY)         \
    PERI_STRESS_CRITERION_LIST(X)                      \
    X(confined_stretch, PERI_CRITERION_CONFINED_STRETCH) \
    X(rate_stretch, PERI_CRITERION_RATE_STRETCH)       \
    X(delayed_stretch, PERI_CRITERION_DELAYED_STRETCH)

/* and for those of stress */
#define PERI_STRESS_CRITERION_LIST(X)                  \
    X(principal_stress, PERI_CRITERION_PRINCIPAL_STRESS) \
    X(von_mises, PERI_CRITERION_VON_MISES)             \
    X(mohr_coulomb, PERI_CRITERION_MOHR_COULOMB)
#endif
