/* SPDX-License-Identifier: MIT */
/* semicircle.c - a half disc of PMMA with an inclined notch in bending: [T] 5.2, Figs 5.10 to 5.18.

   R 50 mm, 5 mm thick, notch 15 mm at beta to the load, supports 21.5 mm from the middle ([T] has 26, a misprint), E 2.94 GPa, nu 0.38.
   Kinks measured: 0, 23, 62, 83 degrees at beta 0, 10, 30, 50; x at heights of 17, 21.4, 30, 40 mm in the figures. Plane stress, LPS on
   whole families (PERI_MOMENTS_WHOLE), spacing 0.5 mm, horizon 4 spacings. Three forces in balance: equilibria until a bond breaks, then
   motion, the forces growing by a tenth per millisecond and waves damped. On the lattice and on one that is turned by 20 degrees: what
   differs between the two is the say that the lattice has. */
#include "gallery.h"

enum { HEIGHTS = 4 };
static const double mm = 1e-3, R = 50e-3, notch = 15e-3, span = 21.5e-3, h = 0.5e-3, height[HEIGHTS] = {17, 21.4, 30, 40};

typedef struct test {
    double       cosine, sine, first; /* of the turn of the lattice; the load factor at the first break, 0 before it */
    broken_bonds bonds;
} test;

/* The lattice stays and the test is turned: from a place in the disc to that in the body, and back. */
static void to_body(const test *t, double x, double y, double *to) {
    to[0] = t->cosine * x - t->sine * y, to[1] = t->sine * x + t->cosine * y;
}
static void to_disc(const test *t, double *at) {
    const double x = at[0];
    at[0] = t->cosine * x + t->sine * at[1], at[1] = -t->sine * x + t->cosine * at[1];
}

static int32_t inside(void *user, int64_t index, const double *x) {
    double at[2] = {x[0], x[1]};
    (void)index, to_disc((const test *)user, at);
    return at[1] >= 0 && hypot(at[0], at[1]) <= R;
}

static int32_t note(void *user, int32_t i, int32_t j, double time, double stretch) {
    test *t = (test *)user;
    const int32_t status = note_bond(&t->bonds, i, j, time, stretch);
    double *at = &t->bonds.at[3 * (t->bonds.count - 1)];
    to_disc(t, at);
    return status ? status : t->first <= 0 || at[1] > 43 * mm;
}

/* 3000 N down on top and up at both supports, times the factor. */
typedef struct press {
    const test *t;
    double      place[2], density[2];
} press;

static int32_t in_spot(void *user, int64_t index, const double *x) {
    double at[2] = {x[0], x[1]};
    const press *p = (const press *)user;
    (void)index, to_disc(p->t, at);
    return hypot(at[0] - p->place[0], at[1] - p->place[1]) <= 2 * mm;
}

static int32_t grow(void *user, double time, int64_t count, const int32_t *points, double *value) {
    const press *p = (const press *)user;
    const double factor = p->t->first > 0 ? p->t->first * (1 + 100 * time) : time;
    (void)points;
    for (int64_t k = 0; k < 2 * count; ++k) value[k] = factor * p->density[k % 2];
    return 0;
}

static void bonds_of(const char *name, const broken_bonds *bonds) {
    FILE *file = table(name, "x,y");
    for (int64_t k = 0; k < bonds->count; ++k) fprintf(file, "%.5g,%.5g\n", bonds->at[3 * k], bonds->at[3 * k + 1]);
    fclose(file);
}

static void bend(FILE *figures, double beta, double turn, const double *ways, double kink) {
    const double degree = 57.29577951308232, sine = sin(beta / degree), cosine = cos(beta / degree), lo[2] = {-1.05 * R, -1.05 * R};
    const double hi[2] = {1.05 * R, 1.05 * R}, spot[3][2] = {{0, R}, {-span, 0}, {span, 0}};
    test t = {cos(turn / degree), sin(turn / degree), 0, {NULL, NULL, 0, 0}};
    press forces[3];
    double from[2], to[2], size[3] = {0, 0, 0}, arm[3] = {0, 0, 0}, none[2] = {0, 0}, *volume;
    char what[96];
    peri_body_desc desc;
    peri_material_desc pmma;
    peri_solve_desc statics;
    peri_advance_desc run;

    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_PLANE_STRESS, desc.geometry = PERI_GEOMETRY_LINEAR, desc.thickness = 5 * mm, desc.horizon = 4.000001 * h;
    desc.moments = PERI_MOMENTS_WHOLE, desc.threads = 1;
    peri_body *disc = must_create(&desc);
    peri_material_desc_init(&pmma, PERI_LAW_LPS);
    pmma.young = 2.94e9, pmma.poisson = 0.38, pmma.density = 1180, pmma.fracture_energy = 500;
    const int32_t material = must(disc, peri_add_material(disc, &pmma));
    must(disc, peri_add_shape(disc, material, lo, hi, h, inside, &t)), must(disc, peri_build(disc));
    to_body(&t, -h * sine / cosine, -h, from), to_body(&t, notch * sine, notch * cosine, to);
    must(disc, peri_cut_segment(disc, PERI_CUT_INITIAL, from, to));
    volume = field_of(disc, PERI_FIELD_VOLUME), t.bonds.x = field_of(disc, PERI_FIELD_POSITION);
    for (int k = 0; k < 3; ++k) { /* where the forces act; nothing breaks near them */
        const press p = {&t, {spot[k][0], spot[k][1]}, {0, 0}};
        forces[k] = p;
        for (int64_t i = 0; i < peri_point_count(disc); ++i) {
            double at[2] = {t.bonds.x[2 * i], t.bonds.x[2 * i + 1]};
            if (!in_spot(&forces[k], i, at)) continue;
            to_disc(&t, at), size[k] += volume[i], arm[k] += volume[i] * at[0];
        }
        arm[k] /= size[k];
        to_body(&t, spot[k][0], spot[k][1], to);
        must(disc, peri_set_no_fail(disc, must(disc, peri_select_ball(disc, NULL, to, 6 * mm)), 1));
    }
    const double share = (arm[0] - arm[1]) / (arm[2] - arm[1]), total[3] = {-3000, 3000 * (1 - share), 3000 * share};
    for (int k = 0; k < 3; ++k) { /* no moment is left */
        to_body(&t, 0, total[k] / (size[k] * desc.thickness), forces[k].density);
        must(disc, peri_apply_body_force(disc, must(disc, peri_select_if(disc, NULL, in_spot, &forces[k])), none, grow, &forces[k]));
    }
    must(disc, peri_on_break(disc, note, &t));
    peri_solve_desc_init(&statics);
    statics.steps = 50, statics.loose = PERI_LOOSE_PINNED, statics.tolerance = 1e-6;
    must(disc, peri_solve(disc, &statics, NULL));
    t.first = peri_load_factor(disc), t.bonds.count = 0;
    peri_advance_desc_init(&run);
    run.duration = 10e-3, run.damping = 2e4;
    must(disc, peri_advance(disc, &run));
    snprintf(what, sizeof what, "semicircle_%.0f%s", beta, turn == 0 ? "" : "_turned");
    if (turn == 0) map_of(what, disc, PERI_FIELD_DAMAGE, 0);
    else bonds_of(what, &t.bonds);

    const double found = 90 - beta - direction(&t.bonds, notch * sine, notch * cosine, 4 * h, 5 * mm, 0, 1);
    const char *lattice = turn == 0 ? "" : ", lattice turned";
    snprintf(what, sizeof what, "beta %.0f%s: kink", beta, lattice);
    figure(figures, what, remainder(-found, 360), kink, 12, "degrees");
    for (int q = 0; ways && q < HEIGHTS; ++q) {
        double sum = 0, count = 0;
        for (int64_t k = 0; k < t.bonds.count; ++k)
            if (fabs(t.bonds.at[3 * k + 1] - height[q] * mm) < 1.2 * h) sum += t.bonds.at[3 * k] / mm, count += 1;
        snprintf(what, sizeof what, "beta %.0f%s: x at a height of %g mm", beta, lattice, height[q]);
        figure(figures, what, sum / count, ways[q], q < 2 ? 4 * h / mm : 4, "mm");
    }
    printf("    %ld broken, %.0f N\n", (long)t.bonds.count, 3000 * t.first * (1 + 100 * peri_time(disc)));
    free((void *)t.bonds.x), free(t.bonds.at), free(volume);
    peri_body_destroy(disc);
}

int main(void) {
    static const double straight[HEIGHTS] = {0, 0, 0, 0}, way_30[HEIGHTS] = {4.7, 2.6, 0.7, 0}, way_50[HEIGHTS] = {6, 4.1, 1.6, 0.2};
    FILE *f = figures_of("semicircle");
    for (int turn = 0; turn <= 20; turn += 20)
        bend(f, 0, turn, straight, 0), bend(f, 10, turn, NULL, 23), bend(f, 30, turn, way_30, 62), bend(f, 50, turn, way_50, 83);
    fclose(f);
    return 0;
}
