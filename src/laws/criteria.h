/* criteria.h - when bonds break, and the list of criteria. A bond breaks where its value passes the limit of its pair of materials,
   peri__pair.limit, PERI_NEVER where neither material has the criterion.

   A criterion is one file, included in four roles: what it keeps (here); its limit, from the fracture energy; whether a bond is over it,
   for the kernels; and by how much, for equilibria. */
#ifndef PERI_CRITERIA_H
#define PERI_CRITERIA_H

#define PERI_CRITERION_ROLE_KEEPS
#include "stretch.inl"
#include "bond_energy.inl"
#include "node_energy.inl"
#undef PERI_CRITERION_ROLE_KEEPS

/* X(name, number) for every criterion */
#define PERI_CRITERION_LIST(X)                 \
    X(stretch, PERI_CRITERION_STRETCH)         \
    X(bond_energy, PERI_CRITERION_BOND_ENERGY) \
    X(node_energy, PERI_CRITERION_NODE_ENERGY)

#define PERI_ONE(name, number) + 1
typedef char peri__criteria_listed[PERI_CRITERION_COUNT_ - 1 == 0 PERI_CRITERION_LIST(PERI_ONE) ? 1 : -1];
#undef PERI_ONE

#endif
