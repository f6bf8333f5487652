/* SPDX-License-Identifier: MIT */
/* laws.inl - the laws there are, in the role that is asked for, and the list of them. */
#include "bond_based.inl"
#include "lps.inl"
#include "oterkus.inl"
#include "correspondence.inl"

#ifndef PERI_LAW_LIST
/* X(name, number) for every law */
#define PERI_LAW_LIST(X)            \
    X(bond_based, PERI_LAW_BOND_BASED)  \
    X(lps, PERI_LAW_LPS)                \
    X(oterkus, PERI_LAW_OTERKUS)        \
    PERI_GRADIENT_LAW_LIST(X)

/* and for those with a gradient */
#define PERI_GRADIENT_LAW_LIST(X) X(correspondence, PERI_LAW_CORRESPONDENCE)
#endif
