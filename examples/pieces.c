/* SPDX-License-Identifier: MIT */
/* pieces.c - a pane of glass falls on a round stone and goes to pieces.

   Prints the largest pieces with their mass and speed, and writes out/pieces.png: each piece in its colour, filled
   from its outline. */
#include "picture.h"

enum { WIDTH = 900, HEIGHT = 600, LISTED = 10 };
static const double lo[2] = {0, 0}, hi[2] = {0.6, 0.3}, h = 8e-3, fall = 12; /* [m], [m/s] */

/* Along a row of pixels an edge that comes down, with its piece on the left, begins the colour of the piece, and one
   that goes up ends it. */
static void fill(int *change, const double *p, const double *q, int colour) {
    const double scale = WIDTH / 0.9, left = -0.15, bottom = -0.2;
    for (int y = 0; y < HEIGHT; ++y) {
        const double at = bottom + (HEIGHT - y - 0.5) / scale;
        if ((p[1] > at) == (q[1] > at)) continue;
        const int x = (int)((p[0] + (q[0] - p[0]) * (at - p[1]) / (q[1] - p[1]) - left) * scale);
        if (x < WIDTH) change[y * WIDTH + (x > 0 ? x : 0)] += p[1] > at ? colour : -colour;
    }
}

static void draw(peri_body *pane, const int32_t *piece_of) {
    static int change[WIDTH * HEIGHT];
    peri_picture view;
    int64_t vertices, faces;
    must(pane, peri_picture_create(&view, WIDTH, HEIGHT, PERI_PICTURE_SEQUENTIAL));
    must(pane, peri_size_of_outline(pane, -1, &vertices, &faces));
    double *vertex = (double *)malloc((size_t)vertices * 2 * sizeof *vertex);
    int32_t *face = (int32_t *)malloc((size_t)faces * 3 * sizeof *face), *owner = face + 2 * faces;
    if (!vertex || !face) exit(EXIT_FAILURE);
    must(pane, peri_get_outline(pane, -1, vertex, vertices, face, owner, NULL, faces));
    for (int64_t k = 0; k < faces; ++k)
        fill(change, &vertex[2 * face[2 * k]], &vertex[2 * face[2 * k + 1]], 1 + piece_of[owner[k]] * 97 % 255);
    for (int k = 0, colour = 0; k < WIDTH * HEIGHT; ++k)
        view.pixels[k] = (unsigned char)(colour = (k % WIDTH ? colour : 0) + change[k]);
    for (int k = 0; k < 256 * 3; ++k) view.palette[k] = (unsigned char)(k < 3 ? 255 : 40 + k / 3 * (53 + 34 * (k % 3)) % 200);
    must(pane, peri_picture_write("out/pieces.png", &view));
    peri_picture_destroy(&view), free(vertex), free(face);
}

int main(void) {
    const double down[2] = {0, -fall};
    peri_body_desc desc;
    peri_material_desc glass;
    peri_obstacle_desc stone;
    peri_advance_desc run;
    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_PLANE_STRESS, desc.horizon = 3.015 * h, desc.thickness = 4e-3;
    peri_body *pane = must_create(&desc);
    peri_material_desc_init(&glass, PERI_LAW_BOND_BASED);
    glass.young = 70e9, glass.density = 2500, glass.fracture_energy = 135;
    must(pane, peri_add_box(pane, must(pane, peri_add_material(pane, &glass)), lo, hi, h));
    must(pane, peri_build(pane));
    must(pane, peri_add_velocity(pane, PERI_ALL, down));
    peri_obstacle_desc_init(&stone, PERI_SHAPE_BALL);
    stone.place[0] = 0.25, stone.place[1] = -0.05, stone.radius = 0.05;
    must(pane, peri_add_obstacle(pane, &stone));
    peri_advance_desc_init(&run);
    run.duration = 1.2e-3;
    must(pane, peri_advance(pane, &run));

    const int64_t points = peri_point_count(pane), count = must(pane, peri_find_fragments(pane, NULL, 0));
    int32_t *piece_of = (int32_t *)malloc((size_t)points * sizeof *piece_of);
    peri_fragment *piece = (peri_fragment *)malloc((size_t)count * sizeof *piece);
    if (!piece_of || !piece) return EXIT_FAILURE;
    must(pane, peri_find_fragments(pane, piece_of, points));
    must(pane, peri_get_fragments(pane, piece, count));
    printf("%ld pieces, those of %d points or more:\n", (long)count, LISTED);
    for (int64_t k = 0; k < count; ++k)
        if (piece[k].points >= LISTED)
            printf("%5ld: %5ld points, %8.3f g, %5.1f m/s\n", (long)k, (long)piece[k].points, 1e3 * piece[k].mass,
                   hypot(piece[k].velocity[0], piece[k].velocity[1]));
    draw(pane, piece_of);
    free(piece_of), free(piece);
    peri_body_destroy(pane);
    return 0;
}
