/* peri_impl.c - the library, in the order data flows through it. A part calls only parts above it.
   Compiled by `cc -c peri_impl.c`, or included by peri.h where PERI_IMPLEMENTATION is defined. */
#ifndef PERI_IMPLEMENTATION_DONE
#define PERI_IMPLEMENTATION_DONE
#include "peri.h"
#endif
#define PERI_IMPL

#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#ifndef PERI_NO_STDIO
#include <stdio.h>
#endif
#if defined(_OPENMP) && !defined(PERI_NO_OPENMP)
#include <omp.h>
#endif

#include "src/base.c"       /* compiler differences, small arithmetic, numbers to text                     */
#include "src/types.h"      /* every internal struct, and the glossary of symbols                          */
#include "src/status.c"     /* status texts, the error record, the log                                     */
#include "src/memory.c"     /* the allocator hook, aligned arrays, growing arrays                          */
#include "src/parallel.c"   /* one loop over blocks of points; sums in a fixed order                       */
#include "src/tensor.c"     /* symmetric matrices, small linear systems                                    */
#include "src/influence.c"  /* w(q) and its moments                                                        */
#include "src/material.c"   /* engineering constants           -> those of the laws, critical values       */
#include "src/points.c"     /* boxes, balls, shapes, arrays    -> points and cells                         */
#include "src/overlap.c"    /* disk and polygon, ball and box  -> exact partial areas and volumes          */
#include "src/parts.c"      /* a cell and a horizon            -> the part within                          */
#include "src/search.c"     /* points                          -> those within reach of each other         */
#include "src/quadrature.c" /* bonds                           -> lengths and weights                      */
#include "src/neighbors.c"  /* points                          -> families (Ibond)                         */
#include "src/correction.c" /* weights                         -> weights that surfaces need               */
#include "src/lanes.c"      /* points of lattices              -> families by columns, Ibond compressed     */
#include "src/rows.c"       /* the family of a point, wherever it is stored                                */

#define PERI_T_REAL 64
#define PERI_T_BOND 64
#define PERI_T_DIM 2
#include "src/kernels.inl"  /* the numerical kernels: one text, six instantiations -> peri__ops_d2 ...      */
#define PERI_T_REAL 64
#define PERI_T_BOND 64
#define PERI_T_DIM 3
#include "src/kernels.inl"
#define PERI_T_REAL 64
#define PERI_T_BOND 32
#define PERI_T_DIM 2
#include "src/kernels.inl"
#define PERI_T_REAL 64
#define PERI_T_BOND 32
#define PERI_T_DIM 3
#include "src/kernels.inl"
#define PERI_T_REAL 32
#define PERI_T_BOND 32
#define PERI_T_DIM 2
#include "src/kernels.inl"
#define PERI_T_REAL 32
#define PERI_T_BOND 32
#define PERI_T_DIM 3
#include "src/kernels.inl"

#include "src/response.c"   /* live families                   -> constants of state-based laws            */
#include "src/arrays.c"     /* what a body keeps                                                           */
#include "src/body.c"       /* create, build, reset, destroy                                               */
#include "src/clone.c"      /* copies; counts                                                              */
#include "src/sets.c"       /* selections of points                                                        */
#include "src/state.c"      /* access to the state in the user's units; energies                           */
#include "src/cracks.c"     /* initial cracks, no-fail zones, break events                                 */
#include "src/loads.c"      /* supports, loads, obstacles                                                  */
#include "src/failure.c"    /* state-based bonds that break                                                */
#include "src/explicit.c"   /* stable step, the step loop                                                  */
#include "src/strain.c"     /* dilatation, strain and stress of points                                     */
#include "src/tangent.c"    /* products with the tangent stiffness, its diagonal                           */
#include "src/loose.c"      /* parts and points that can move without resistance                           */
#include "src/grids.c"      /* regular grids: smoothing, V-cycle                                           */
#include "src/multilevel.c" /* elasticity on coarser grids, as a preconditioner                            */
#include "src/conjugate.c"  /* conjugate gradients                                                         */
#include "src/matrix.c"     /* the tangent assembled, BiCGSTAB                                             */
#include "src/equilibrium.c" /* Newton's method                                                             */
#include "src/relax.c"      /* adaptive dynamic relaxation                                                 */
#include "src/statics.c"    /* load steps, quasi-static fracture                                           */
#include "src/surface.c"    /* tractions and pressures that pass the patch test                            */
#include "src/fields.c"     /* fields by copy and by view, the ledger                                      */
#include "src/output.c"     /* VTU, CSV                                                                    */
#include "src/sketch.c"     /* a body that is only described  -> its bonds and columns                     */
#include "src/plan.c"       /* what a scene would cost                                                     */
#include "src/choose.c"     /* the knobs for an accuracy or a budget                                       */

#if defined(PERI_AS_WRITTEN) && defined(__clang__)
#pragma float_control(pop)
#elif defined(PERI_AS_WRITTEN)
#pragma GCC pop_options
#endif
#undef PERI_IMPL
