/* static_b.c - the other unit: see static_a.c. */
#define PERI_STATIC
#define PERI_IMPLEMENTATION
#include "../peri.h"
#include "static_scene.h"

double static_b_run(double *displacement, int32_t count);
double static_b_run(double *displacement, int32_t count) { return static_scene_run(displacement, count); }
