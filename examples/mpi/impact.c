/* SPDX-License-Identifier: MIT */
/* impact.c - a steel ball goes through a glass plate, in 3D, on as many processes as mpirun starts: the same bits for any number.

   The plate of examples/impact.c, coarser; the ball moves at a given speed. Writes out/mpi_impact.pvd, a film of frames with a piece per
   process for ParaView, and out/mpi_impact.bin: displacement and damage of all points in their order. Process 0 tells how far it is, and what
   the ball bears.
     mpicc -O2 -std=c99 -I. examples/mpi/impact.c build/libperi.a -lm -o impact; mpirun -n 4 impact */
#include <math.h>

#include "parts.h"

static const double h = 5e-3, radius = 10e-3, speed = 60, duration = 40e-6; /* [m], [m/s], [s] */

/* Touches the lowest points, which lie h/2 inside the face z = 0, and goes up. */
static int32_t move_ball(void *user, double time, double *place, double *turn) {
    (void)user, (void)turn;
    place[2] = h / 2 - radius + speed * time;
    return 0;
}

static int32_t on_rim(void *user, int64_t index, const double *x) { return (void)user, (void)index, fabs(x[0]) > 40e-3 || fabs(x[1]) > 40e-3; }

static int32_t watch(void *user, peri_body *b) {
    part *p = (part *)user;
    double force[3];
    must(b, peri_get_obstacle_force(b, peri_id(b, PERI_KIND_OBSTACLE, 1), force, NULL)); /* this and the next: collective */
    const int64_t broken = peri_broken_count(b);
    if (p->rank == 0) fprintf(stderr, "%3.0f %%, %ld bonds broken, the ball bears %.0f N\n", 100 * peri_time(b) / duration, (long)broken, force[2]);
    part_frame(p, b, "out/mpi_impact");
    return 0;
}

int main(int argc, char **argv) {
    const double lo[3] = {-45e-3, -45e-3, 0}, hi[3] = {45e-3, 45e-3, 20e-3};
    const int64_t cells[3] = {18, 18, 4};
    part p;
    peri_body *b = NULL;
    peri_body_desc desc;
    peri_material_desc glass;
    peri_obstacle_desc ball;
    peri_advance_desc run;
    MPI_Init(&argc, &argv);
    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_SOLID;
    desc.horizon = 2.5 * h;
    desc.threads = 1;
    must(b, peri_body_create(&desc, &b, NULL));
    peri_material_desc_init(&glass, PERI_LAW_LPS);
    glass.young = 72e9; /* [Pa] */
    glass.poisson = 0.22;
    glass.density = 2440;        /* [kg/m^3] */
    glass.fracture_energy = 135; /* [J/m^2] */
    const int32_t material = (int32_t)must(b, peri_add_material(b, &glass));
    part_of_box(&p, 3, cells, peri_ghost_depth(b) * 3);
    must(b, peri_add_shape(b, material, lo, hi, h, part_takes, &p));
    part_set(&p, b, lo, h, h * h * h);
    must(b, peri_build(b));
    must(b, peri_prescribe_velocity(b, (int32_t)must(b, peri_select_if(b, NULL, on_rim, NULL)), PERI_AXIS_XYZ, NULL, NULL, NULL));
    peri_obstacle_desc_init(&ball, PERI_SHAPE_BALL);
    ball.radius = radius;
    ball.motion = move_ball;
    must(b, peri_add_obstacle(b, &ball));
    peri_advance_desc_init(&run);
    run.duration = duration;
    run.frame_steps = 10;
    run.on_frame = watch, run.user = &p;
    must(b, peri_advance(b, &run));
    const int64_t broken = peri_broken_count(b);
    if (p.rank == 0) printf("%d processes: %ld bonds broken in %ld steps\n", p.ranks, (long)broken, (long)peri_step_count(b));
    part_write(&p, b, "out/mpi_impact");
    part_free(&p);
    peri_body_destroy(b);
    MPI_Finalize();
    return 0;
}
