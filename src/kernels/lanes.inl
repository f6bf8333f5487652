/* lanes.inl - the kernels of one instruction set: its vectors, and all that works on them. */
#include "vector.inl"
#include "columns.inl"
#include "list.inl"
#include "pointwise.inl"
#include "passes.inl"
#include "march.inl"
#include "solve.inl"
#undef PERI_LANES_FN
#undef PERI_LANES_TARGET
