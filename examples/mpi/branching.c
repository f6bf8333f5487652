/* SPDX-License-Identifier: MIT */
/* branching.c - a crack in a pane of glass splits in two, on as many processes as mpirun starts: the same bits for any number.

   The pane of examples/branching.c, coarser. Recursive bisection across the longer edge gives each process its points; ghosts are copied by
   non-blocking messages, one to each neighbour and step. Writes out/mpi_branching.bin: displacement and damage of all points in their
   order, which must not depend on the number of processes; and out/mpi_branching.pvtu with a piece per process.
     mpicc -O2 -std=c99 -I. examples/mpi/branching.c build/libperi.a -lm -o branching; mpirun -n 4 branching */
#include "parts.h"

static int32_t watch(void *user, peri_body *body) {
    const part *p = (const part *)user;
    const int64_t broken = peri_broken_count(body); /* collective */
    if (p->rank == 0) fprintf(stderr, "step %ld, t = %.3g s, %ld broken\n", (long)peri_step_count(body), peri_time(body), (long)broken);
    return 0;
}

int main(int argc, char **argv) {
    const double h = 1e-3, horizon = 3.015e-3, lo[2] = {-0.05, -0.02}, hi[2] = {0.05, 0.02}, from[2] = {-0.05, 0}, to[2] = {0, 0};
    const double upper[2] = {-0.05, 0.019}, lower[2] = {0.05, -0.019}, above[2] = {-0.05, 0.017}, below[2] = {0.05, -0.017};
    const double up[2] = {0, 4e6}, down[2] = {0, -4e6};
    const int64_t cells[2] = {100, 40};
    part p;
    peri_body *b = NULL;
    peri_body_desc desc;
    peri_material_desc glass;
    peri_advance_desc run;
    peri_energy energy;

    MPI_Init(&argc, &argv);
    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_PLANE_STRESS;
    desc.horizon = horizon;
    desc.threads = 1;
    must(b, peri_body_create(&desc, &b, NULL));
    peri_material_desc_init(&glass, PERI_LAW_BOND_BASED);
    glass.young = 72e9;          /* [Pa] */
    glass.density = 2440;        /* [kg/m^3] */
    glass.fracture_energy = 3.8; /* [J/m^2] */
    const int32_t material = (int32_t)must(b, peri_add_material(b, &glass));
    part_of_box(&p, 2, cells, peri_ghost_depth(b) * 4); /* whole cells within the horizon */
    must(b, peri_add_shape(b, material, lo, hi, h, part_takes, &p));
    part_set(&p, b, lo, h, h * h);
    must(b, peri_build(b));

    must(b, peri_cut_segment(b, PERI_CUT_INITIAL, from, to));
    must(b, peri_apply_layer_traction(b, (int32_t)must(b, peri_select_box(b, NULL, upper, hi)), 0.1, up, NULL, NULL));
    must(b, peri_apply_layer_traction(b, (int32_t)must(b, peri_select_box(b, NULL, lo, lower)), 0.1, down, NULL, NULL));
    must(b, peri_set_no_fail(b, (int32_t)must(b, peri_select_box(b, NULL, above, hi)), 1));
    must(b, peri_set_no_fail(b, (int32_t)must(b, peri_select_box(b, NULL, lo, below)), 1));
    peri_advance_desc_init(&run);
    run.duration = 25e-6;
    run.frame_steps = 50;
    run.on_frame = watch;
    run.user = &p;
    must(b, peri_advance(b, &run));

    must(b, peri_get_energy(b, &energy));
    if (p.rank == 0) printf("%d processes: kinetic %.12g, elastic %.12g, fracture %.12g J\n", p.ranks, energy.kinetic, energy.elastic, energy.fracture);
    part_write(&p, b, "out/mpi_branching");
    part_show(&p, b, "out/mpi_branching");
    part_free(&p);
    peri_body_destroy(b);
    MPI_Finalize();
    return 0;
}
