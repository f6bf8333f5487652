/* SPDX-License-Identifier: MIT */
/* isa.inl - what works on the vectors of one instruction set. */
#include "vector.inl"
#include "columns.inl"
#include "list.inl"
#include "pointwise.inl"
#undef PERI_COMPACT
#undef PERI_PIECEWISE
#undef PERI_ISA_FN
#undef PERI_ISA_TARGET
