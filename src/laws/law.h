/* SPDX-License-Identifier: MIT */
/* law.h - what laws differ in, and the list of them.

   The half of a bond that its end i gives is a force density, per weight w,
       (p g + q e) M            along the bond M; e its extension, g its gauge: |xi| or 1
     + Q xi + k eta             of laws with a gradient
   p and Q are what the point makes of its family: of the dilatation theta = d sum w g e V, or of the displacement gradient
   H = (sum w eta xi V) K^-1. The constants d, p/theta, q, k and K^-1 are calibrated on the family, live or whole (calibration.c). A
   pairwise law has none: its q is c/(2 |xi|), c of the pair of materials.

   A law is one file and its place in laws.inl, included in three roles: its traits (here), its calibration, and of laws with a gradient its
   stress. */
#ifndef PERI_LAW_H
#define PERI_LAW_H

#define PERI_LAW_ROLE_TRAITS
#include "laws.inl"
#undef PERI_LAW_ROLE_TRAITS

PERI_SAME_COUNT(law, PERI_LAW_LIST, peri__count_law);

#endif
