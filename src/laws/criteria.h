/* SPDX-License-Identifier: MIT */
/* criteria.h - when bonds break, and the list of criteria. A bond breaks where its value passes the limit of its pair of materials,
   peri__pair.limit, PERI_NEVER where neither material has the criterion.

   A criterion is one file and its place in criteria.inl, included in four roles: how it is seen (here); its limit, from the fracture
   energy; whether a bond is over it, for the kernels; and by how much, for equilibria. */
#ifndef PERI_CRITERIA_H
#define PERI_CRITERIA_H

#define PERI_CRITERION_ROLE_TRAITS
#include "criteria.inl"
#undef PERI_CRITERION_ROLE_TRAITS

PERI_SAME_COUNT(criterion, PERI_CRITERION_LIST, peri__count_criterion);

#endif
