/* SPDX-License-Identifier: MIT */
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

/* ---- base: knows nobody ---------------------------------------------------------------- */
#include "src/base/compiler.h"     /* what compilers and machines differ in                                        */
#include "src/base/enums.h"        /* where the values of each enum begin and end                                     */
#include "src/base/pairs.h"        /* limits of the bonds between two materials                                           */
#include "src/base/types.h"        /* every internal struct, and the glossary of symbols                           */
#include "src/base/solver.h"       /* what a static solve takes                                                   */
#include "src/base/bond_laws.h"    /* laws of bonds: what they are, and what passes ask of them                        */
#include "src/base/obstacles.h"    /* shapes, places and motion of obstacles                                           */
#include "src/base/inline.h"       /* what is small and used everywhere                                            */
#include "src/laws/law.h"          /* what laws differ in, and the list of them                                    */
#include "src/laws/criteria.h"     /* when bonds break, and the list of criteria                              */
#include "src/base/base.c"         /* the instruction set, constants, small arithmetic                             */
PERI_SMALL
#include "src/base/text.c"         /* numbers to text                                                              */
PERI_SMALL_END
#include "src/base/real.c"         /* access to reals of either precision                                          */
PERI_SMALL
#include "src/base/status.c"       /* status texts, the error record, the log                                      */
#include "src/base/ids.c"          /* ids of materials, sets, loads, obstacles                                        */
PERI_SMALL_END
#include "src/base/memory.c"       /* the allocator hook, aligned arrays, growing arrays                           */
#include "src/base/parallel.c"     /* one loop over blocks of points; sums in a fixed order                        */
#include "src/base/tensor.c"       /* symmetric matrices, small linear systems                                     */

/* ---- geometry: points, cells, and the parts of cells within a horizon ------------------ */
#include "src/geometry/points.c"   /* boxes, balls, shapes, arrays    -> points and cells                          */
#include "src/geometry/overlap.c"  /* disk, ball; polygon, polyhedron -> exact partial areas and volumes           */
#include "src/geometry/cells.c"    /* vertices and corners            -> points, volumes; parts of cells           */
#include "src/geometry/partial_volumes.c"    /* a cell and a horizon            -> the part within                           */
#include "src/geometry/mesh.c"     /* a closed mesh and a place       -> how deep that is in it                    */
#include "src/geometry/solids.c"   /* a shape and a place             -> the same; volume, inertia                 */

/* ---- families: who is bonded, with what weight, and where that is kept ----------------- */
#include "src/families/influence.c"  /* w(q) and its moments                                                       */
#include "src/families/search.c"     /* points                        -> those within reach of each other          */
#include "src/families/weights.c" /* bonds                         -> lengths and weights                       */
#include "src/families/neighbors.c"  /* points                        -> families (Ibond)                          */
#include "src/families/agreement.c"  /* families of the caller       -> do they belong to the horizon?              */
#include "src/families/moments.c"    /* directions of bonds           -> tensors, moments of families             */
#include "src/families/balance.c"    /* weights                       -> weights that balance uniform strain         */
#include "src/families/correction.c" /* weights                       -> weights that surfaces need                */
#include "src/families/stencil.c"      /* points of lattices            -> families by columns, Ibond compressed     */
#include "src/families/rows.c"       /* the family of a point, wherever it is stored                               */
#include "src/families/span.c"       /* families                      -> do they span the space?                   */

/* ---- laws: what materials make of live families ---------------------------------------- */
PERI_SMALL
#include "src/laws/material.c"     /* engineering constants           -> those of the laws, critical values        */
PERI_SMALL_END
#include "src/laws/calibration.c"  /* live families                   -> constants of state-based laws             */
#include "src/laws/bond_laws.c"    /* stretches and histories of bonds -> forces, where bonds are not linear          */
PERI_SMALL
#include "src/laws/softening.c"    /* strength, fracture energy, families -> tables of bonds that soften              */
PERI_SMALL_END
#include "src/laws/traction.c"     /* the stress of points             -> what planes of bonds bear                       */
#include "src/laws/stiffness.c"    /* live families                   -> row sums that bound the frequency            */

/* ---- kernels: one text, six instantiations -> peri__ops_d2 ... -------------------------- */
#ifdef PERI_SPLIT                  /* objects of their own (src/kernels/unit.c)                                    */
extern PERI_SHARED const peri__ops peri__ops_d2, peri__ops_d3, peri__ops_m2, peri__ops_m3, peri__ops_f2, peri__ops_f3;
#else
#define PERI_T_REAL 64
#define PERI_T_BOND 64
#define PERI_T_DIM 2
#include "src/kernels/kernels.inl"
#define PERI_T_REAL 64
#define PERI_T_BOND 64
#define PERI_T_DIM 3
#include "src/kernels/kernels.inl"
#define PERI_T_REAL 64
#define PERI_T_BOND 32
#define PERI_T_DIM 2
#include "src/kernels/kernels.inl"
#define PERI_T_REAL 64
#define PERI_T_BOND 32
#define PERI_T_DIM 3
#include "src/kernels/kernels.inl"
#define PERI_T_REAL 32
#define PERI_T_BOND 32
#define PERI_T_DIM 2
#include "src/kernels/kernels.inl"
#define PERI_T_REAL 32
#define PERI_T_BOND 32
#define PERI_T_DIM 3
#include "src/kernels/kernels.inl"
#endif

/* ---- contact: which points touch, and how they push each other -------------------------- */
#include "src/contact/contact.c"   /* what is declared, and lists                                                  */
#include "src/contact/search.c"    /* exposed points                -> those that may come to touch                */
#include "src/contact/force.c"     /* points that touch             -> force, energy, loss                         */
#include "src/contact/tangent.c"   /* and                           -> tangent                                     */
#include "src/contact/world.c"     /* bodies that share a world                                                    */
#include "src/contact/near.c"      /* their exposed points          -> those that may come to touch another body   */
#include "src/contact/between.c"   /* points of two that touch      -> force, energy, loss                         */

/* ---- body: what there is, and what may be done to it ----------------------------------- */
PERI_SMALL
#include "src/body/arrays.c"       /* what a body keeps                                                            */
PERI_SMALL_END
#include "src/body/flow.c"         /* inelastic extensions of bonds -> force, energy, tangent                         */
#include "src/body/part.c"         /* parts of larger bodies, periodic cells: what they ask each other              */
#include "src/body/ghosts.c"       /* whether ghosts are as their owners                                              */
PERI_SMALL
#include "src/body/body.c"         /* create, build, destroy                                                       */
#include "src/body/clone.c"        /* copies; counts                                                               */
#include "src/body/sets.c"         /* selections of points                                                         */
PERI_SMALL_END
#include "src/body/own_stress.c"   /* stresses of the caller        -> force, energy, tangent                         */
#include "src/body/state.c"        /* units; the force of bonds, energies                                          */
#include "src/body/loads.c"        /* loads and supports            -> force, work                                 */
#include "src/body/free_bodies.c"  /* places of obstacles, and how free ones move                                  */
#include "src/body/obstacles.c"    /* obstacles                     -> force, work                                 */
#include "src/body/stale.c"        /* a change                      -> what is stale -> up to date again           */
#include "src/body/sides.c"        /* adjacent points, when their bonds broke                                        */
#include "src/body/motion.c"       /* displacement and velocity from outside, reset                                */
#include "src/body/cracks.c"       /* initial cracks, no-fail zones, break events                                  */
PERI_SMALL
#include "src/body/callbacks.c"    /* how runs begin and end; a body that a callback was left in by a jump          */
#include "src/body/boundary.c"     /* supports and loads, added and removed                                        */
#include "src/body/obstacle_desc.c" /* obstacles, added, removed, read and set                                     */
#include "src/body/contact_desc.c" /* contact between materials, declared                                          */
#include "src/body/world_desc.c"   /* worlds, who is in them, contact between bodies as declared                      */
#include "src/body/point_fields.c" /* eigenstrain, strength, stiffness and density by point, strength by bond   */
PERI_SMALL_END
#include "src/body/reactions.c"    /* forces of supports, loads and obstacles                                      */
#include "src/body/fragments.c"    /* points joined by live bonds; what they are as rigid bodies                      */
#include "src/body/strain.c"       /* dilatation, strain and stress of points                                      */
#include "src/body/strength.c"     /* and what criteria ask of them                                                */

/* ---- dynamics -------------------------------------------------------------------------- */
#include "src/dynamics/frequency.c" /* the highest frequency, by Lanczos's method                                  */
#include "src/dynamics/stretched.c" /* what deformation does to it                                                  */
#include "src/dynamics/failure.c"  /* state-based bonds that break                                                 */
#include "src/dynamics/explicit.c" /* stable step, the step loop                                                   */
#include "src/dynamics/sleep.c"    /* bodies of a world that rest                                                  */
#include "src/dynamics/world.c"    /* the same for several bodies                                                   */
#include "src/dynamics/evaluate.c" /* displacements of the caller   -> forces, breaks                               */

/* ---- statics --------------------------------------------------------------------------- */
#ifndef PERI_NO_STATICS
#include "src/statics/tangent.c"   /* products with the tangent stiffness, its diagonal                            */
#include "src/statics/touch.c"     /* obstacles in equilibria: what holds, and what may come to hold              */
#include "src/statics/rigid_modes.c"     /* parts and points that can move without resistance                            */
#include "src/statics/levels.c"    /* levels of nodes: smoothing, V-cycle                                          */
#include "src/statics/coarsen.c"   /* which nodes a coarser level has, its stiffness                               */
#include "src/statics/multilevel.c" /* elasticity on these levels, as a preconditioner                             */
#include "src/statics/conjugate.c" /* conjugate gradients                                                          */
#include "src/statics/kept.c"      /* what a solve leaves to the next                                              */
#include "src/statics/matrix.c"    /* the tangent assembled, BiCGSTAB                                              */
#include "src/statics/equilibrium.c" /* Newton's method                                                            */
#include "src/statics/relax.c"     /* adaptive dynamic relaxation                                                  */
#include "src/statics/fracture.c"  /* which bonds break at an equilibrium                                          */
#include "src/statics/step.c"      /* an equilibrium, its work, its row of the curve                               */
#include "src/statics/path.c"      /* the load factor that the next bond to break asks for                         */
#include "src/statics/statics.c"   /* load steps, quasi-static fracture                                            */
#include "src/statics/implicit.c"  /* the same with inertia: steps in time                                         */
#include "src/statics/surface.c"   /* tractions and pressures that pass the patch test                             */
#endif

/* ---- output ---------------------------------------------------------------------------- */
#include "src/output/fields.c"     /* fields by copy and by view, the ledger                                       */
#include "src/output/world_energy.c" /* the ledger of a world                                                      */
PERI_SMALL
#include "src/output/checkpoint.c" /* the state                     -> bytes, and back                             */
PERI_SMALL_END
#ifndef PERI_NO_OUTPUT
PERI_SMALL
#include "src/output/output.c"     /* VTU, CSV                                                                     */
#include "src/output/bonds.c"      /* bonds, row after row                                                          */
#include "src/output/probes.c"     /* fields at some points, and at any places                                       */
#include "src/output/paths.c"      /* broken bonds                  -> cracks and tips in 2D                       */
#include "src/output/cracks.c"     /* and in 3D; VTP                                                               */
#include "src/output/outline.c"    /* fragments                     -> closed polygons and triangle meshes           */
PERI_SMALL_END
#endif

/* ---- advice ---------------------------------------------------------------------------- */
#ifndef PERI_NO_ADVICE
PERI_SMALL
#include "src/advice/estimate.c"     /* a body that is only described  -> its bonds and columns                      */
#include "src/advice/plan_step.c"    /* its stable step                                                             */
#include "src/advice/plan.c"       /* what a scene would cost                                                      */
#include "src/advice/choose.c"     /* the knobs for an accuracy or a budget                                        */
PERI_SMALL_END
#endif

/* ---- what a build leaves out, answering that it is ------------------------------------- */
#include "src/without/without.c"

#ifdef PERI_UNCALLED
#pragma GCC diagnostic pop
#endif
#if defined(PERI_AS_WRITTEN) && defined(__clang__)
#pragma float_control(pop)
#elif defined(PERI_AS_WRITTEN)
#pragma GCC pop_options
#endif
#undef PERI_IMPL
