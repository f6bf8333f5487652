/* SPDX-License-Identifier: MIT */
/* criteria.inl - the criteria there are, in the role that is asked for, and the list of them. */
#include "stretch.inl"
#include "bond_energy.inl"
#include "node_energy.inl"

#ifndef PERI_CRITERION_LIST
/* X(name, number) for every criterion */
#define PERI_CRITERION_LIST(X)                 \
    X(stretch, PERI_CRITERION_STRETCH)         \
    X(bond_energy, PERI_CRITERION_BOND_ENERGY) \
    X(node_energy, PERI_CRITERION_NODE_ENERGY)
#endif
