/* SPDX-License-Identifier: MIT */
/* unit.c - the kernels of one precision and dimension as an object of their own, for developers:
   cc -DPERI_SPLIT -DPERI_T_REAL=64 -DPERI_T_BOND=64 -DPERI_T_DIM=2 -I. -c src/kernels/unit.c; then peri_impl.c with -DPERI_SPLIT. */
#include "peri.h"
#define PERI_IMPL

#include <float.h>
#include <math.h>
#include <string.h>

#include "src/base/compiler.h"
#include "src/base/enums.h"
#include "src/base/pairs.h"
#include "src/base/types.h"
#include "src/base/bond_laws.h"
#include "src/base/inline.h"
#include "src/laws/law.h"
#include "src/laws/criteria.h"

/* what kernels call of the parts above them */
PERI_SHARED double  peri__add_up(double *part);
PERI_SHARED double  peri__family_volume(const peri__model *m, int64_t i);
PERI_SHARED void    peri__group_masks(const peri__model *m, int64_t g, uint32_t lanes, const uint32_t *flags, uint16_t *masks);
PERI_SHARED void    peri__row_of(const peri__model *m, int64_t i, peri__row *row);
PERI_SHARED int64_t peri__bond_slot(const peri__model *m, int64_t i, const peri__row *row, int64_t k);
PERI_SHARED int64_t peri__pull_slot(const peri__model *m, int64_t slot, int32_t d);
PERI_SHARED double  peri__least_stretch(const peri__operands *s, int64_t i);
PERI_SHARED double  peri__least_limit(const peri__operands *s, int64_t i, int32_t criterion);
PERI_SHARED int     peri__respond(const peri__operands *o, int64_t i, int64_t first, peri__bunch *bunch);
PERI_SHARED double  peri__secant(double stretch, double force, double tangent);
PERI_SHARED int64_t peri__find_bond(const peri__model *m, int64_t i, int64_t j);

#include "src/kernels/kernels.inl"
