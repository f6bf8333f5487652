/* SPDX-License-Identifier: MIT */
/* peri_view.h - pictures of bodies as PNG, and animated ones (APNG): a tool beside the library, C99 and C++11, libc and libm.

     peri_picture_save    draws a body and writes it: a field in colours, colour bar, axes, title, cracks, deformed by a factor
     peri_movie_open, peri_movie_add (from a peri_frame_fn), peri_movie_close    the same over time, one animated PNG
     peri_picture_draw, then peri_picture_rectangle, _line, _text, peri_picture_write    a picture that you add to

       peri_picture_desc d;  peri_picture_desc_init(&d);  d.field = PERI_FIELD_DAMAGE;  d.title = "glass";
       peri_picture_save("out.png", body, &d);

   All return PERI_OK or a negative peri_status. The colours rise evenly in lightness (Oklab): for eyes that see all colours, for those
   that do not, and in grey. Include it in any C or C++ file: all functions are static. */
#ifndef PERI_VIEW_H
#define PERI_VIEW_H

#if defined(_MSC_VER) && !defined(_CRT_SECURE_NO_WARNINGS)
#define _CRT_SECURE_NO_WARNINGS /* MSVC: fopen is the C99 way to open a file */
#endif

#ifndef PERI_H
#include "../peri.h"
#endif
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PERI_PICTURE_FN static PERI_UNUSED_

/* Entries of the palette. Shades of a field begin at SHADE; fragments have the colours from PIECE on. */
enum {
    PERI_PICTURE_PAPER = 0,
    PERI_PICTURE_INK = 1,
    PERI_PICTURE_GREY = 2,
    PERI_PICTURE_LIGHT = 3,
    PERI_PICTURE_CRACK = 4,
    PERI_PICTURE_PIECE = 5,
    PERI_PICTURE_PIECES = 8,
    PERI_PICTURE_SHADE = 16,
    PERI_PICTURE_SHADES = 240
};

typedef enum peri_picture_palette {
    PERI_PICTURE_SEQUENTIAL = 1, /* indigo to yellow */
    PERI_PICTURE_DIVERGING = 2,  /* blue, white at the middle of the range, orange */
    PERI_PICTURE_GREYS = 3
} peri_picture_palette;

typedef struct peri_picture {
    int            width, height;
    unsigned char *pixels; /* [height][width] entries of the palette, rows from the top */
    unsigned char  palette[768];
} peri_picture;

typedef struct peri_picture_desc {
    int32_t     field;        /* Default PERI_FIELD_DAMAGE; of PERI_FIELD_FRAGMENT each piece has a colour */
    int32_t     component;    /* -1 (default): the magnitude of vectors, the first component of tensors */
    int32_t     palette;      /* Default PERI_PICTURE_SEQUENTIAL */
    int32_t     along;        /* 3D: seen along axis 0, 1 or 2 (default: from above) */
    int32_t     width;        /* pixels, at most. Default 1000 */
    int32_t     bar;          /* 1 (default): the colour bar with its numbers */
    int32_t     axes;         /* 1 (default) */
    int32_t     cracks;       /* 1: lines along the cracks, 2D. Default 0 */
    int32_t     show_time;    /* 1: after the title. Default 0 */
    double      lo, hi;       /* the range of the colours. lo = hi (default): that of the field */
    double      magnify;      /* displacements are drawn times this. Default 1 */
    double      box[4];       /* x0 y0 x1 y1 that is shown [L]. All 0 (default): the body */
    double      length_scale; /* numbers at the axes are lengths times this: 1e3 for mm. Default 1 */
    double      field_scale;  /* likewise at the bar */
    double      time_scale;   /* likewise in the title */
    const char *title;        /* Default NULL */
    const char *label;        /* of the bar: "damage", "stress [MPa]". Default NULL */
    const char *length_unit;  /* Default NULL */
    const char *time_unit;    /* Default NULL */
} peri_picture_desc;

PERI_PICTURE_FN void peri_picture_desc_init(peri_picture_desc *desc) {
    memset(desc, 0, sizeof *desc);
    desc->field = PERI_FIELD_DAMAGE;
    desc->component = -1;
    desc->palette = PERI_PICTURE_SEQUENTIAL;
    desc->along = 2;
    desc->width = 1000;
    desc->bar = desc->axes = 1;
    desc->magnify = desc->length_scale = desc->field_scale = desc->time_scale = 1.0;
}

/* ---- palettes ------------------------------------------------------------------------------------------------- */

/* sRGB of a colour of Oklab by lightness, chroma and hue in degrees (B. Ottosson, 2020). */
PERI_PICTURE_FN void peri_picture_oklab(double lightness, double chroma, double hue, unsigned char *rgb) {
    static const double to[3][3] = {{4.0767416621, -3.3077115913, 0.2309699292},
                                    {-1.2684380046, 2.6097574011, -0.3413193965},
                                    {-0.0041960863, -0.7034186147, 1.7076147010}};
    const double a = chroma * cos(hue * 0.017453292519943295), b = chroma * sin(hue * 0.017453292519943295);
    const double l = pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
    const double m = pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
    const double s = pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
    int k;
    for (k = 0; k < 3; ++k) {
        const double linear = fmin(fmax(to[k][0] * l + to[k][1] * m + to[k][2] * s, 0.0), 1.0);
        const double shown = linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055;
        rgb[k] = (unsigned char)(255.0 * shown + 0.5);
    }
}

PERI_PICTURE_FN void peri_picture_colours(unsigned char *palette, int32_t which) {
    static const unsigned char fixed[13][3] = {
        {255, 255, 255}, {32, 32, 32},   {150, 150, 150}, {222, 222, 222}, {213, 94, 0},                       /* paper to crack */
        {0, 114, 178},   {230, 159, 0},  {0, 158, 115},   {204, 121, 167}, {86, 180, 233}, {213, 94, 0},       /* Okabe and Ito, 2008 */
        {240, 228, 66},  {110, 110, 110}};
    int k;
    memset(palette, 255, 768);
    memcpy(palette, fixed, sizeof fixed);
    for (k = 0; k < PERI_PICTURE_SHADES; ++k) {
        unsigned char *rgb = palette + 3 * (PERI_PICTURE_SHADE + k);
        const double t = (double)k / (PERI_PICTURE_SHADES - 1), side = fabs(2.0 * t - 1.0);
        if (which == PERI_PICTURE_DIVERGING) peri_picture_oklab(0.97 - 0.52 * side, 0.12 * side, t < 0.5 ? 255.0 : 50.0, rgb);
        else if (which == PERI_PICTURE_GREYS) peri_picture_oklab(0.25 + 0.67 * t, 0.0, 0.0, rgb);
        else peri_picture_oklab(0.25 + 0.67 * t, t < 0.5 ? 0.10 - 0.02 * t : 0.09 + 0.14 * (t - 0.5), 290.0 - 185.0 * t, rgb);
    }
}

PERI_PICTURE_FN unsigned char peri_picture_shade(double value, double lo, double hi) {
    const double most = PERI_PICTURE_SHADES - 1, at = (value - lo) / (hi - lo);
    return (unsigned char)(PERI_PICTURE_SHADE + (int)(at > 0.0 ? (at < 1.0 ? at * most + 0.5 : most) : 0.0));
}

/* ---- pixels: x to the right, y down, from the upper left corner; what lies outside is left out ------------------- */

PERI_PICTURE_FN void peri_picture_destroy(peri_picture *picture) {
    free(picture->pixels);
    memset(picture, 0, sizeof *picture);
}

PERI_PICTURE_FN int32_t peri_picture_create(peri_picture *picture, int width, int height, int32_t palette) {
    memset(picture, 0, sizeof *picture);
    if (width < 1 || height < 1 || width > 32000 || height > 32000) return PERI_ERROR_RANGE;
    picture->pixels = (unsigned char *)calloc((size_t)width, (size_t)height);
    if (!picture->pixels) return PERI_ERROR_MEMORY;
    picture->width = width;
    picture->height = height;
    peri_picture_colours(picture->palette, palette);
    return PERI_OK;
}

/* [x0, x1) x [y0, y1) */
PERI_PICTURE_FN void peri_picture_rectangle(peri_picture *picture, double x0, double y0, double x1, double y1, int colour) {
    const int left = (int)fmax(x0, 0.0), right = (int)fmin(x1, picture->width), below = (int)fmin(y1, picture->height);
    int y;
    for (y = (int)fmax(y0, 0.0); y < below && left < right; ++y)
        memset(picture->pixels + (size_t)y * (size_t)picture->width + left, colour, (size_t)(right - left));
}

/* A line of `thick` pixels. */
PERI_PICTURE_FN void peri_picture_line(peri_picture *picture, double x0, double y0, double x1, double y1, double thick, int colour) {
    const double length = fmin(hypot(x1 - x0, y1 - y0), 1e5);
    const int steps = 1 + (int)(2.0 * length);
    int k;
    for (k = 0; k <= steps; ++k) {
        const double x = floor(x0 + (x1 - x0) * k / steps - 0.5 * thick + 0.5);
        const double y = floor(y0 + (y1 - y0) * k / steps - 0.5 * thick + 0.5);
        if (x > -1e4 && x < 1e5 && y > -1e4 && y < 1e5) peri_picture_rectangle(picture, x, y, x + thick, y + thick, colour);
    }
}

/* Letters of 5 x 7 dots times `size`, 6 apart, some 2 longer below the line; upwards: turned by a quarter. x, y: the upper left corner,
   of turned ones the lower left. */
PERI_PICTURE_FN void peri_picture_text(peri_picture *picture, double x, double y, int size, int upwards, int colour, const char *text) {
    static const char *const letters[95] = {
        "@@@@@@@@@", "DDDDD@D@@", "JJ@@@@@@@", "JJ_J_JJ@@", "DOTNE^D@@", "YYBDHSS@@", "LRTHURM@@", "DD@@@@@@@", "BDHHHDB@@",
        "HDBBBDH@@", "@DUNUD@@@", "@DD_DD@@@", "@@@@@FDH@", "@@@_@@@@@", "@@@@@LL@@", "AABDHPP@@", "NQSUYQN@@", "DLDDDDN@@",
        "NQAFHP_@@", "NQAFAQN@@", "BFJR_BB@@", "_P^AAQN@@", "FHP^QQN@@", "_ABDDHH@@", "NQQNQQN@@", "NQQOABL@@", "@LL@LL@@@",
        "@LL@LDH@@", "BDHPHDB@@", "@@_@_@@@@", "HDBABDH@@", "NQAFD@D@@", "NQWUWPO@@", "DJQQ_QQ@@", "^QQ^QQ^@@", "NQPPPQN@@",
        "^QQQQQ^@@", "_PP^PP_@@", "_PP^PPP@@", "NQPSQQO@@", "QQQ_QQQ@@", "NDDDDDN@@", "GBBBBRL@@", "QRTXTRQ@@", "PPPPPP_@@",
        "Q[UUQQQ@@", "QYYUSSQ@@", "NQQQQQN@@", "^QQ^PPP@@", "NQQQURM@@", "^QQ^TRQ@@", "OPPNAA^@@", "_DDDDDD@@", "QQQQQQN@@",
        "QQQQJJD@@", "QQQUU[Q@@", "QQJDJQQ@@", "QQJDDDD@@", "_ABDHP_@@", "NHHHHHN@@", "PPHDBAA@@", "NBBBBBN@@", "DJQ@@@@@@",
        "@@@@@@@_@", "HD@@@@@@@", "@@NAOQO@@", "PP^QQQ^@@", "@@NPPPN@@", "AAOQQQO@@", "@@NQ_PN@@", "FIH\\HHH@@", "@@OQQQOAN",
        "PP^QQQQ@@", "D@LDDDN@@", "B@FBBBBRL", "PPRTXTR@@", "LDDDDDN@@", "@@ZUUUU@@", "@@^QQQQ@@", "@@NQQQN@@", "@@^QQQ^PP",
        "@@OQQQOAA", "@@VYPPP@@", "@@OPNA^@@", "HH^HHIF@@", "@@QQQQO@@", "@@QQQJD@@", "@@QQUUJ@@", "@@QJDJQ@@", "@@QQQQOAN",
        "@@_BDH_@@", "BDDHDDB@@", "DDDDDDD@@", "HDDBDDH@@", "@@IV@@@@@"
    };
    int k, row, dot;
    for (k = 0; text[k]; ++k) {
        const char *letter = letters[text[k] >= 32 && text[k] < 127 ? text[k] - 32 : '?' - 32];
        for (row = 0; row < 9; ++row)
            for (dot = 0; dot < 5; ++dot)
                if (((letter[row] - 64) >> (4 - dot)) & 1) {
                    const double right = (6 * k + dot) * size, down = row * size;
                    const double px = upwards ? x + down : x + right, py = upwards ? y - right - size : y + down;
                    peri_picture_rectangle(picture, px, py, px + size, py + size, colour);
                }
    }
}

PERI_PICTURE_FN double peri_picture_text_width(const char *text, int size) {
    return *text ? 6.0 * size * (double)strlen(text) - size : 0.0;
}

/* ---- numbers at axes and bars ---------------------------------------------------------------------------------- */

typedef struct peri_picture_ticks {
    double first, step; /* at first + k*step */
    int    count;
    int    decimals; /* -1: numbers with an exponent */
} peri_picture_ticks;

/* Round numbers within [lo, hi], about `wanted` of them. */
PERI_PICTURE_FN peri_picture_ticks peri_picture_ticks_of(double lo, double hi, int wanted) {
    peri_picture_ticks t;
    const double rough = (hi - lo) / (wanted > 1 ? wanted : 1), power = pow(10.0, floor(log10(rough))), most = fmax(fabs(lo), fabs(hi));
    t.step = power * (rough / power < 1.5 ? 1.0 : rough / power < 3.5 ? 2.0 : rough / power < 7.5 ? 5.0 : 10.0);
    t.first = ceil(lo / t.step - 1e-6) * t.step;
    t.count = (int)floor((hi - t.first) / t.step + 1e-6) + 1;
    t.decimals = most >= 1e5 || most < 1e-2 ? -1 : (int)fmax(0.0, -floor(log10(t.step) + 1e-6));
    return t;
}

PERI_PICTURE_FN const char *peri_picture_tick(const peri_picture_ticks *t, int k, char *text, size_t capacity) {
    double value = t->first + k * t->step;
    if (fabs(value) < 1e-6 * t->step) value = 0.0;
    if (t->decimals >= 0) (void)snprintf(text, capacity, "%.*f", t->decimals, value);
    else (void)snprintf(text, capacity, "%g", floor(value / t->step * 1e3 + 0.5) * 1e-3 * t->step);
    return text;
}

PERI_PICTURE_FN double peri_picture_widest(const peri_picture_ticks *t, int size) {
    char text[32];
    double most = 0.0;
    int k;
    for (k = 0; k < t->count; ++k) most = fmax(most, peri_picture_text_width(peri_picture_tick(t, k, text, sizeof text), size));
    return most;
}

/* ---- what is drawn --------------------------------------------------------------------------------------------- */

/* The points in the plane of the picture: place, half the sides of the cell, value; in the order in which they are drawn. */
typedef struct peri_picture_points {
    int64_t  count;
    double  *x;    /* [count*2] where they are drawn */
    double  *half; /* [count*2] */
    double  *value;
    int64_t *order;
    double   rest[4]; /* the box of the body at rest */
    double   cell;    /* mean side */
} peri_picture_points;

PERI_PICTURE_FN void peri_picture_points_free(peri_picture_points *p) {
    free(p->x);
    free(p->half);
    free(p->value);
    free(p->order);
    memset(p, 0, sizeof *p);
}

typedef struct peri_picture_deep {
    double  depth;
    int64_t point;
} peri_picture_deep;

PERI_PICTURE_FN int peri_picture_nearer(const void *a, const void *b) {
    const peri_picture_deep *p = (const peri_picture_deep *)a, *q = (const peri_picture_deep *)b;
    return p->depth < q->depth ? -1 : p->depth > q->depth ? 1 : p->point < q->point ? -1 : 1;
}

PERI_PICTURE_FN double peri_picture_value(const double *f, int components, int dim, int component) {
    double square = 0.0;
    int k;
    if (component >= 0) return f[component];
    if (components != dim) return f[0];
    for (k = 0; k < dim; ++k) square += f[k] * f[k];
    return components == 1 ? f[0] : sqrt(square);
}

/* Cells stretch as the body does there, so that no gaps open between them; those of damaged points keep their size. */
PERI_PICTURE_FN int32_t peri_picture_place(peri_picture_points *p, peri_body *body, const peri_picture_desc *desc, const double *x,
                                           const double *u, const double *volume, const double *damage, const double *strain) {
    const int dim = peri_dimension(body), right = dim == 2 ? 0 : desc->along == 0 ? 1 : 0, up = dim == 2 ? 1 : desc->along == 2 ? 1 : 2;
    peri_picture_deep *deep = (peri_picture_deep *)malloc((size_t)p->count * sizeof *deep);
    int64_t i;
    int d;
    if (!deep) return PERI_ERROR_MEMORY;
    for (i = 0; i < p->count; ++i) {
        const int axis[2] = {right, up};
        const double half = 0.5 * (dim == 2 ? sqrt(volume[i]) : cbrt(volume[i]));
        p->cell += 2.0 * half / (double)p->count;
        for (d = 0; d < 2; ++d) {
            const double at = x[i * dim + axis[d]], stretch = strain ? desc->magnify * strain[i * (dim == 2 ? 3 : 6) + axis[d]] : 0.0;
            p->half[2 * i + d] = half * (1.0 + (strain && damage[i] < 0.1 ? fmin(fmax(stretch, -0.5), 0.5) : 0.0));
            p->x[2 * i + d] = at + desc->magnify * u[i * dim + axis[d]];
            p->rest[d] = i ? fmin(p->rest[d], at - half) : at - half;
            p->rest[2 + d] = i ? fmax(p->rest[2 + d], at + half) : at + half;
        }
        deep[i].point = i;
        if (dim == 2) deep[i].depth = 0.0;
        else deep[i].depth = (desc->along == 1 ? -1.0 : 1.0) * (x[i * dim + desc->along] + desc->magnify * u[i * dim + desc->along]);
    }
    if (dim == 3) qsort(deep, (size_t)p->count, sizeof *deep, peri_picture_nearer);
    for (i = 0; i < p->count; ++i) p->order[i] = deep[i].point;
    free(deep);
    return PERI_OK;
}

PERI_PICTURE_FN int32_t peri_picture_read(peri_picture_points *p, peri_body *body, const peri_picture_desc *desc) {
    const int dim = peri_dimension(body);
    const int64_t n = peri_point_count(body), size = peri_size_of_field(body, desc->field);
    const int components = n > 0 && size > 0 ? (int)(size / n) : 0;
    const int64_t tensor = n * (dim == 2 ? 3 : 6);
    double *numbers = NULL, *x, *u, *volume, *damage, *strain, *f;
    int32_t result;
    int64_t i;
    memset(p, 0, sizeof *p);
    if (n < 1) return PERI_ERROR_EMPTY;
    if (components < 1 || desc->component >= components) return PERI_ERROR_FIELD;
    p->count = n;
    p->x = (double *)malloc((size_t)n * 2 * sizeof(double));
    p->half = (double *)malloc((size_t)n * 2 * sizeof(double));
    p->value = (double *)malloc((size_t)n * sizeof(double));
    p->order = (int64_t *)malloc((size_t)n * sizeof(int64_t));
    numbers = (double *)malloc((size_t)(n * (2 * dim + 2) + tensor + size) * sizeof(double));
    result = p->x && p->half && p->value && p->order && numbers ? PERI_OK : PERI_ERROR_MEMORY;
    if (result == PERI_OK) {
        x = numbers, u = x + n * dim, volume = u + n * dim, damage = volume + n, strain = damage + n, f = strain + tensor;
        if ((result = peri_get_field(body, PERI_FIELD_POSITION, x, n * dim)) >= 0 &&
            (result = peri_get_field(body, PERI_FIELD_DISPLACEMENT, u, n * dim)) >= 0 &&
            (result = peri_get_field(body, PERI_FIELD_VOLUME, volume, n)) >= 0 &&
            (result = peri_get_field(body, desc->field, f, size)) >= 0 &&
            (result = peri_get_field(body, PERI_FIELD_DAMAGE, damage, n)) >= 0) {
            if (peri_get_field(body, PERI_FIELD_STRAIN, strain, tensor) < 0) strain = NULL; /* it is of cosmetic use alone */
            result = peri_picture_place(p, body, desc, x, u, volume, damage, strain);
        }
        for (i = 0; i < n && result >= 0; ++i)
            p->value[i] = peri_picture_value(f + i * components, components, dim, desc->component);
    }
    free(numbers);
    if (result < 0) peri_picture_points_free(p);
    return result;
}

/* Fills in what the description leaves open: the box and the range of the colours. */
PERI_PICTURE_FN void peri_picture_settle(peri_picture_desc *desc, const peri_picture_points *p, double spare) {
    const double away = 0.05 * fmax(p->rest[2] - p->rest[0], p->rest[3] - p->rest[1]);
    int64_t i;
    int d;
    if (!(desc->box[0] < desc->box[2] && desc->box[1] < desc->box[3])) {
        memcpy(desc->box, p->rest, sizeof desc->box);
        for (d = 0; d < 2; ++d) { /* room for what moved, not for pieces that flew away */
            for (i = 0; i < p->count; ++i) {
                desc->box[d] = fmin(desc->box[d], fmax(p->x[2 * i + d] - p->half[2 * i + d], p->rest[d] - away));
                desc->box[2 + d] = fmax(desc->box[2 + d], fmin(p->x[2 * i + d] + p->half[2 * i + d], p->rest[2 + d] + away));
            }
            desc->box[d] = fmin(desc->box[d], p->rest[d] - spare * away);
            desc->box[2 + d] = fmax(desc->box[2 + d], p->rest[2 + d] + spare * away);
        }
    }
    if (!(desc->lo < desc->hi)) {
        desc->lo = HUGE_VAL, desc->hi = -HUGE_VAL;
        for (i = 0; i < p->count; ++i) desc->lo = fmin(desc->lo, p->value[i]), desc->hi = fmax(desc->hi, p->value[i]);
        if (desc->palette == PERI_PICTURE_DIVERGING) desc->hi = fmax(fabs(desc->lo), fabs(desc->hi)), desc->lo = -desc->hi;
        if (!(desc->lo < desc->hi)) desc->hi = desc->lo + (desc->lo != 0.0 ? fabs(desc->lo) : 1.0);
    }
}

/* Where things are [pixels]. */
typedef struct peri_picture_frame {
    int                size; /* of letters */
    double             left, right, top, bottom, scale;
    int                width, height;
    peri_picture_ticks x, y, bar;
} peri_picture_frame;

PERI_PICTURE_FN peri_picture_frame peri_picture_layout(const peri_picture_desc *desc, double cell) {
    const double wide = desc->box[2] - desc->box[0], high = desc->box[3] - desc->box[1], l = desc->length_scale;
    const int bar = desc->bar && desc->field != PERI_FIELD_FRAGMENT, width = desc->width > 160 ? desc->width : 160;
    peri_picture_frame f;
    int wanted = 7;
    double s, inner;
    f.size = width >= 750 ? (width + 50) / 800 + 1 : 1;
    s = f.size;
    f.left = f.right = f.bottom = f.top = 6.0 * s;
    f.y = peri_picture_ticks_of(l * desc->box[1], l * desc->box[3], high > 0.3 * wide ? 4 : 2);
    f.bar = peri_picture_ticks_of(desc->field_scale * desc->lo, desc->field_scale * desc->hi, 4);
    if (desc->title || desc->show_time || (bar && desc->label)) f.top += 14.0 * s;
    if (desc->axes) {
        f.left += peri_picture_widest(&f.y, f.size) + 6.0 * s + (desc->length_unit ? 12.0 * s : 0.0);
        f.bottom += (desc->length_unit ? 24.0 : 13.0) * s;
    }
    if (bar) f.right += 18.0 * s + peri_picture_widest(&f.bar, f.size) + 4.0 * s;
    inner = fmax(width - f.left - f.right, 32.0);
    do f.x = peri_picture_ticks_of(l * desc->box[0], l * desc->box[2], wanted);
    while (--wanted > 1 && f.x.count * (peri_picture_widest(&f.x, f.size) + 8.0 * s) > inner);
    f.scale = fmin(inner / wide, 2.0 * inner / high);
    if (f.scale * cell >= 2.0) f.scale = floor(f.scale * cell + 1e-6) / cell; /* whole pixels for a cell */
    f.width = (int)(ceil(f.scale * wide - 1e-6) + f.left + f.right);
    f.height = (int)(fmax(ceil(f.scale * high - 1e-6), bar ? 40.0 * s : 8.0 * s) + f.top + f.bottom);
    return f;
}

PERI_PICTURE_FN void peri_picture_draw_axes(peri_picture *picture, const peri_picture_desc *desc, const peri_picture_frame *f) {
    const double s = f->size, x0 = f->left, x1 = f->width - f->right, y0 = f->top, y1 = f->height - f->bottom, l = desc->length_scale;
    double wide;
    char text[64];
    int k;
    peri_picture_rectangle(picture, x0 - s, y0 - s, x1 + s, y0, PERI_PICTURE_GREY);
    peri_picture_rectangle(picture, x0 - s, y1, x1 + s, y1 + s, PERI_PICTURE_GREY);
    peri_picture_rectangle(picture, x0 - s, y0 - s, x0, y1 + s, PERI_PICTURE_GREY);
    peri_picture_rectangle(picture, x1, y0 - s, x1 + s, y1 + s, PERI_PICTURE_GREY);
    for (k = 0; k < f->x.count; ++k) {
        const double at = floor(x0 + f->scale * ((f->x.first + k * f->x.step) / l - desc->box[0]) + 0.5);
        const double half = 0.5 * peri_picture_text_width(peri_picture_tick(&f->x, k, text, sizeof text), f->size);
        peri_picture_rectangle(picture, at - s, y1 + s, at, y1 + 4 * s, PERI_PICTURE_GREY);
        peri_picture_text(picture, floor(fmin(fmax(at - half, 0.0), f->width - 2 * half)), y1 + 5 * s, f->size, 0, PERI_PICTURE_INK,
                          text);
    }
    for (k = 0; k < f->y.count; ++k) {
        const double at = floor(y1 - f->scale * ((f->y.first + k * f->y.step) / l - desc->box[1]) + 0.5);
        peri_picture_rectangle(picture, x0 - 4 * s, at, x0 - s, at + s, PERI_PICTURE_GREY);
        peri_picture_tick(&f->y, k, text, sizeof text);
        peri_picture_text(picture, floor(x0 - 6 * s - peri_picture_text_width(text, f->size)),
                          floor(fmin(fmax(at - 3 * s, 0.0), f->height - 9 * s)), f->size, 0, PERI_PICTURE_INK, text);
    }
    if (!desc->length_unit) return;
    (void)snprintf(text, sizeof text, "%s", desc->length_unit);
    wide = peri_picture_text_width(text, f->size);
    peri_picture_text(picture, floor(0.5 * (x0 + x1 - wide)), f->height - 11 * s, f->size, 0, PERI_PICTURE_INK, text);
    if (wide < y1 - y0) peri_picture_text(picture, 3 * s, floor(0.5 * (y0 + y1 + wide)), f->size, 1, PERI_PICTURE_INK, text);
}

PERI_PICTURE_FN void peri_picture_draw_bar(peri_picture *picture, const peri_picture_desc *desc, const peri_picture_frame *f) {
    const double s = f->size, x0 = f->width - f->right + 8 * s, x1 = x0 + 9 * s, y0 = f->top, y1 = f->height - f->bottom;
    char text[32];
    int k;
    for (k = 0; k < (int)(y1 - y0); ++k)
        peri_picture_rectangle(picture, x0, y1 - 1 - k, x1, y1 - k, peri_picture_shade(k, 0, fmax(y1 - y0 - 1, 1.0)));
    for (k = 0; k < f->bar.count; ++k) {
        const double t = ((f->bar.first + k * f->bar.step) / desc->field_scale - desc->lo) / (desc->hi - desc->lo);
        const double at = floor(y1 - t * (y1 - y0 - 1) - 0.5);
        peri_picture_rectangle(picture, x1, at, x1 + 3 * s, at + s, PERI_PICTURE_GREY);
        peri_picture_text(picture, x1 + 5 * s, floor(fmin(fmax(at - 3 * s, 0.0), f->height - 9 * s)), f->size, 0, PERI_PICTURE_INK,
                          peri_picture_tick(&f->bar, k, text, sizeof text));
    }
}

/* Along paths of cracks, as the body is drawn; thin white on both sides. */
PERI_PICTURE_FN int32_t peri_picture_draw_cracks(peri_picture *picture, peri_body *body, const peri_picture_desc *desc,
                                                 const peri_picture_frame *f) {
    peri_cracks *cracks[2] = {NULL, NULL}; /* at rest, now */
    int64_t *start = NULL, p, k, count = 0, paths = 0;
    double *vertex = NULL;
    int32_t result = PERI_OK;
    int which, pass;
    for (which = 0; which < 2 && result >= 0; ++which) {
        peri_cracks_desc c;
        peri_cracks_desc_init(&c);
        c.current = which;
        result = peri_cracks_create(body, &c, &cracks[which]);
    }
    if (result >= 0) {
        count = peri_cracks_vertices(cracks[0]), paths = peri_cracks_paths(cracks[0]);
        if (peri_cracks_vertices(cracks[1]) != count || peri_cracks_paths(cracks[1]) != paths) result = PERI_ERROR_STATE;
    }
    if (result >= 0) {
        start = (int64_t *)malloc((size_t)(paths + 1) * sizeof *start);
        vertex = (double *)malloc((size_t)(4 * count + 1) * sizeof *vertex);
        result = start && vertex ? PERI_OK : PERI_ERROR_MEMORY;
    }
    for (which = 0; which < 2 && result >= 0; ++which)
        result = peri_get_cracks(cracks[which], start, vertex + 2 * count * which, NULL, NULL);
    for (k = 0; k < 2 * count && result >= 0; ++k) vertex[k] += desc->magnify * (vertex[2 * count + k] - vertex[k]);
    for (pass = 0; pass < 2 && result >= 0; ++pass)
        for (p = 0; p < paths; ++p)
            for (k = start[p]; k + 1 < start[p + 1]; ++k)
                peri_picture_line(picture, f->left + f->scale * (vertex[2 * k] - desc->box[0]),
                                  f->height - f->bottom - f->scale * (vertex[2 * k + 1] - desc->box[1]),
                                  f->left + f->scale * (vertex[2 * k + 2] - desc->box[0]),
                                  f->height - f->bottom - f->scale * (vertex[2 * k + 3] - desc->box[1]),
                                  pass ? f->size + 1.0 : f->size + 3.0, pass ? PERI_PICTURE_CRACK : PERI_PICTURE_PAPER);
    free(start);
    free(vertex);
    peri_cracks_destroy(cracks[0]);
    peri_cracks_destroy(cracks[1]);
    return result;
}

PERI_PICTURE_FN void peri_picture_draw_title(peri_picture *picture, peri_body *body, const peri_picture_desc *desc,
                                             const peri_picture_frame *f) {
    const double s = f->size, spare = f->width - 12.0 * s;
    char text[200] = "", time[64] = "";
    const char *label = desc->bar && desc->field != PERI_FIELD_FRAGMENT && desc->label ? desc->label : "";
    size_t fits = (size_t)(spare / (6.0 * s));
    double wide;
    if (desc->show_time)
        (void)snprintf(time, sizeof time, "%st = %.3g%s%s", desc->title ? ", " : "", peri_time(body) * desc->time_scale,
                       desc->time_unit ? " " : "", desc->time_unit ? desc->time_unit : "");
    (void)snprintf(text, sizeof text, "%s%s", desc->title ? desc->title : "", time);
    if (strlen(text) > fits) text[fits] = 0;
    peri_picture_text(picture, fmin(f->left, 6 * s), 5 * s, f->size, 0, PERI_PICTURE_INK, text);
    wide = peri_picture_text_width(label, f->size);
    if (*label && peri_picture_text_width(text, f->size) + wide + 12.0 * s < spare) /* else there is no room for it */
        peri_picture_text(picture, floor(f->width - 6 * s - wide), 5 * s, f->size, 0, PERI_PICTURE_INK, label);
}

/* The picture of a body, to be freed by peri_picture_destroy. */
PERI_PICTURE_FN int32_t peri_picture_draw_settled(peri_picture *picture, peri_body *body, peri_picture_desc *desc, double spare) {
    peri_picture_points p;
    peri_picture_frame f;
    int64_t k;
    int32_t result;
    memset(picture, 0, sizeof *picture);
    if (desc->along < 0 || desc->along > 2 || desc->component < -1 || desc->width < 1 || !(fabs(desc->magnify) < HUGE_VAL) ||
        !(desc->length_scale > 0 && desc->length_scale < HUGE_VAL && desc->field_scale > 0 && desc->field_scale < HUGE_VAL))
        return PERI_ERROR_RANGE;
    if (desc->palette < PERI_PICTURE_SEQUENTIAL || desc->palette > PERI_PICTURE_GREYS) return PERI_ERROR_CHOICE;
    if ((result = peri_picture_read(&p, body, desc)) < 0) return result;
    peri_picture_settle(desc, &p, spare);
    f = peri_picture_layout(desc, p.cell);
    result = peri_picture_create(picture, f.width, f.height, desc->palette);
    for (k = 0; k < p.count && result >= 0; ++k) {
        const int64_t i = p.order[k];
        const double x = f.left + f.scale * (p.x[2 * i] - desc->box[0]);
        const double y = f.height - f.bottom - f.scale * (p.x[2 * i + 1] - desc->box[1]);
        const double wide = f.scale * p.half[2 * i] + 0.25, high = f.scale * p.half[2 * i + 1] + 0.25;
        const double right = f.width - f.right, below = f.height - f.bottom;
        const int colour = desc->field == PERI_FIELD_FRAGMENT ? PERI_PICTURE_PIECE + (int)fmod(fabs(p.value[i]), PERI_PICTURE_PIECES)
                                                              : peri_picture_shade(p.value[i], desc->lo, desc->hi);
        if (x + wide > f.left && x - wide < right && y + high > f.top && y - high < below)
            peri_picture_rectangle(picture, fmax(floor(x - wide + 0.5), f.left), fmax(floor(y - high + 0.5), f.top),
                                   fmin(floor(x + wide + 0.5), right), fmin(floor(y + high + 0.5), below), colour);
    }
    peri_picture_points_free(&p);
    if (result >= 0 && desc->cracks && peri_dimension(body) == 2) result = peri_picture_draw_cracks(picture, body, desc, &f);
    if (result < 0) {
        peri_picture_destroy(picture);
        return result;
    }
    if (desc->axes) peri_picture_draw_axes(picture, desc, &f);
    if (desc->bar && desc->field != PERI_FIELD_FRAGMENT) peri_picture_draw_bar(picture, desc, &f);
    peri_picture_draw_title(picture, body, desc, &f);
    return PERI_OK;
}

PERI_PICTURE_FN int32_t peri_picture_draw(peri_picture *picture, peri_body *body, const peri_picture_desc *desc) {
    peri_picture_desc settled = *desc;
    return peri_picture_draw_settled(picture, body, &settled, 0.0);
}

/* ---- PNG --------------------------------------------------------------------------------------------------------- */

typedef struct peri_picture_stream {
    unsigned char *bytes;
    size_t         count;
    uint32_t       bits; /* not yet a whole byte, lowest bit first */
    int            held; /* how many */
} peri_picture_stream;

/* Numbers fill the bytes from the lowest bit upwards. */
PERI_PICTURE_FN void peri_picture_put(peri_picture_stream *out, uint32_t value, int bits) {
    out->bits |= value << out->held;
    for (out->held += bits; out->held >= 8; out->held -= 8) {
        out->bytes[out->count++] = (unsigned char)(out->bits & 255u);
        out->bits >>= 8;
    }
}

/* Codes come highest bit first. */
PERI_PICTURE_FN void peri_picture_put_code(peri_picture_stream *out, uint32_t code, int bits) {
    while (bits-- > 0) peri_picture_put(out, (code >> bits) & 1u, 1);
}

/* A literal byte (0-255), the end (256) or a length symbol (257 and up) in the fixed code of RFC 1951, 3.2.6. */
PERI_PICTURE_FN void peri_picture_put_symbol(peri_picture_stream *out, uint32_t symbol) {
    if (symbol < 144) peri_picture_put_code(out, 0x30u + symbol, 8);
    else if (symbol < 256) peri_picture_put_code(out, 0x190u + symbol - 144u, 9);
    else if (symbol < 280) peri_picture_put_code(out, symbol - 256u, 7);
    else peri_picture_put_code(out, 0xC0u + symbol - 280u, 8);
}

/* "Repeat `length` bytes (3 to 257) from `distance` bytes back." Both numbers are written like small floats: a symbol for exponent and
   leading bits, then the other bits as they are. */
PERI_PICTURE_FN void peri_picture_put_match(peri_picture_stream *out, uint32_t length, uint32_t distance) {
    int extra = 0;
    for (length -= 3; length >> extra >= 8u; ++extra) {}
    peri_picture_put_symbol(out, 257u + 4u * (uint32_t)extra + (length >> extra));
    peri_picture_put(out, length & ((1u << extra) - 1u), extra);
    extra = 0;
    for (distance -= 1; distance >> extra >= 4u; ++extra) {}
    peri_picture_put_code(out, 2u * (uint32_t)extra + (distance >> extra), 5);
    peri_picture_put(out, distance & ((1u << extra) - 1u), extra);
}

/* zlib: the longest of some matches at each byte (RFC 1950, 1951), one block of fixed codes. *bytes is to be freed. */
PERI_PICTURE_FN int32_t peri_picture_deflate(const unsigned char *data, size_t count, unsigned char **bytes, size_t *size) {
    enum { HASHES = 32768, TRIES = 24, LONGEST = 257, WINDOW = 32768 };
    peri_picture_stream out;
    int32_t *newest = (int32_t *)malloc(HASHES * sizeof *newest), *older = (int32_t *)malloc((count + 1) * sizeof *older);
    uint32_t a = 1, b = 0; /* Adler-32 */
    size_t i, k, done = 0;
    memset(&out, 0, sizeof out);
    out.bytes = (unsigned char *)malloc(count + count / 8 + 64);
    if (!newest || !older || !out.bytes) {
        free(newest), free(older), free(out.bytes);
        return PERI_ERROR_MEMORY;
    }
    for (k = 0; k < HASHES; ++k) newest[k] = -1;
    peri_picture_put(&out, 0x0178u, 16); /* head of zlib */
    peri_picture_put(&out, 3u, 3);       /* the last block, fixed codes */
    for (i = 0; i < count; ++i) {
        size_t best = 0, distance = 0;
        if (i + 3 <= count) {
            const uint32_t three = data[i] | (uint32_t)data[i + 1] << 8 | (uint32_t)data[i + 2] << 16, hash = (three * 2654435761u) >> 17;
            int32_t at = newest[hash];
            int tries = i < done ? 0 : TRIES; /* within a match nothing is sought, only remembered */
            for (; tries > 0 && at >= 0 && i - (size_t)at <= WINDOW; --tries, at = older[at]) {
                for (k = 0; k < LONGEST && i + k < count && data[i + k] == data[(size_t)at + k]; ++k) {}
                if (k > best) best = k, distance = i - (size_t)at;
                if (k == LONGEST) break;
            }
            older[i] = newest[hash];
            newest[hash] = (int32_t)i;
        }
        a = (a + data[i]) % 65521u;
        b = (b + a) % 65521u;
        if (i < done) continue;
        if (best >= 3) peri_picture_put_match(&out, (uint32_t)best, (uint32_t)distance);
        else peri_picture_put_symbol(&out, data[i]);
        done = i + (best >= 3 ? best : 1);
    }
    peri_picture_put_symbol(&out, 256);
    peri_picture_put(&out, 0, 7);
    for (k = 0; k < 4; ++k) out.bytes[out.count++] = (unsigned char)((b << 16 | a) >> (24 - 8 * k) & 255u);
    free(newest), free(older);
    *bytes = out.bytes;
    *size = out.count;
    return PERI_OK;
}

PERI_PICTURE_FN void peri_picture_number(unsigned char *to, uint32_t value) {
    int k;
    for (k = 0; k < 4; ++k) to[k] = (unsigned char)(value >> (24 - 8 * k) & 255u);
}

PERI_PICTURE_FN uint32_t peri_picture_crc(uint32_t crc, const unsigned char *data, size_t count) {
    size_t i;
    int k;
    for (i = 0; i < count; ++i)
        for (crc ^= data[i], k = 0; k < 8; ++k) crc = crc & 1u ? crc >> 1 ^ 0xEDB88320u : crc >> 1;
    return crc;
}

PERI_PICTURE_FN int peri_picture_chunk(FILE *file, const char *type, const unsigned char *data, size_t count) {
    unsigned char head[8], tail[4];
    peri_picture_number(head, (uint32_t)count);
    memcpy(head + 4, type, 4);
    peri_picture_number(tail, ~peri_picture_crc(peri_picture_crc(0xFFFFFFFFu, head + 4, 4), data, count));
    return fwrite(head, 1, 8, file) == 8 && fwrite(data, 1, count, file) == count && fwrite(tail, 1, 4, file) == 4;
}

PERI_PICTURE_FN int peri_picture_head(FILE *file, const peri_picture *picture) {
    static const unsigned char signature[8] = {137, 80, 78, 71, 13, 10, 26, 10};
    unsigned char header[13] = {0};
    peri_picture_number(header, (uint32_t)picture->width);
    peri_picture_number(header + 4, (uint32_t)picture->height);
    header[8] = 8; /* bits */
    header[9] = 3; /* palette */
    return fwrite(signature, 1, 8, file) == 8 && peri_picture_chunk(file, "IHDR", header, 13);
}

/* IDAT, or fdAT with its number, of the pixels of a rectangle. */
PERI_PICTURE_FN int32_t peri_picture_data(FILE *file, const peri_picture *picture, const int *box, int64_t number) {
    const size_t wide = (size_t)(box[2] - box[0]), high = (size_t)(box[3] - box[1]), row = wide + 1;
    unsigned char *data = (unsigned char *)malloc(row * high), *packed = NULL, *whole;
    size_t y, size = 0;
    int32_t result;
    if (!data) return PERI_ERROR_MEMORY;
    for (y = 0; y < high; ++y) { /* a row: filter 0 (none), then pixels */
        data[y * row] = 0;
        memcpy(data + y * row + 1, picture->pixels + (y + (size_t)box[1]) * (size_t)picture->width + box[0], wide);
    }
    result = peri_picture_deflate(data, row * high, &packed, &size);
    free(data);
    if (result < 0) return result;
    if (number < 0) result = peri_picture_chunk(file, "IDAT", packed, size) ? PERI_OK : PERI_ERROR_WRITE;
    else if ((whole = (unsigned char *)malloc(size + 4)) == NULL) result = PERI_ERROR_MEMORY;
    else {
        peri_picture_number(whole, (uint32_t)number);
        memcpy(whole + 4, packed, size);
        result = peri_picture_chunk(file, "fdAT", whole, size + 4) ? PERI_OK : PERI_ERROR_WRITE;
        free(whole);
    }
    free(packed);
    return result;
}

PERI_PICTURE_FN int32_t peri_picture_write(const char *path, const peri_picture *picture) {
    const int box[4] = {0, 0, picture->width, picture->height};
    FILE *file = fopen(path, "wb");
    const int good = file && peri_picture_head(file, picture) && peri_picture_chunk(file, "PLTE", picture->palette, 768);
    int32_t result = good ? PERI_OK : PERI_ERROR_WRITE;
    if (result >= 0) result = peri_picture_data(file, picture, box, -1);
    if (result >= 0 && !peri_picture_chunk(file, "IEND", picture->palette, 0)) result = PERI_ERROR_WRITE;
    if (file && fclose(file) != 0 && result >= 0) result = PERI_ERROR_WRITE;
    return result;
}

PERI_PICTURE_FN int32_t peri_picture_save(const char *path, peri_body *body, const peri_picture_desc *desc) {
    peri_picture picture;
    int32_t result = peri_picture_draw(&picture, body, desc);
    if (result >= 0) result = peri_picture_write(path, &picture);
    peri_picture_destroy(&picture);
    return result;
}

/* ---- animated PNG: what of a frame is as in the one before is not written again ---------------------------------- */

typedef struct peri_movie {
    FILE             *file;
    peri_picture_desc desc;
    peri_picture      last;
    double            seconds; /* of a frame */
    uint32_t          frames, chunks;
} peri_movie;

/* Open box and range are those of the first frame, the box with room around it. */
PERI_PICTURE_FN int32_t peri_movie_open(peri_movie *movie, const char *path, const peri_picture_desc *desc, double seconds_per_frame) {
    memset(movie, 0, sizeof *movie);
    if (!(seconds_per_frame > 0.0 && seconds_per_frame < 60.0)) return PERI_ERROR_RANGE;
    movie->desc = *desc;
    movie->seconds = seconds_per_frame;
    movie->file = fopen(path, "wb");
    return movie->file ? PERI_OK : PERI_ERROR_WRITE;
}

/* The rectangle in which two pictures differ. */
PERI_PICTURE_FN void peri_movie_changed(const peri_picture *a, const peri_picture *b, int *box) {
    int x, y;
    box[0] = a->width, box[1] = a->height, box[2] = box[3] = 0;
    for (y = 0; y < a->height; ++y)
        for (x = 0; x < a->width; ++x)
            if (a->pixels[(size_t)y * (size_t)a->width + (size_t)x] != b->pixels[(size_t)y * (size_t)a->width + (size_t)x]) {
                box[0] = x < box[0] ? x : box[0], box[2] = x >= box[2] ? x + 1 : box[2];
                box[1] = y < box[1] ? y : box[1], box[3] = y + 1;
            }
    if (box[2] == 0) box[0] = box[1] = 0, box[2] = box[3] = 1;
}

PERI_PICTURE_FN int peri_movie_control(peri_movie *movie, const int *box) {
    unsigned char control[26] = {0};
    peri_picture_number(control, movie->chunks++);
    peri_picture_number(control + 4, (uint32_t)(box[2] - box[0]));
    peri_picture_number(control + 8, (uint32_t)(box[3] - box[1]));
    peri_picture_number(control + 12, (uint32_t)box[0]);
    peri_picture_number(control + 16, (uint32_t)box[1]);
    peri_picture_number(control + 20, (uint32_t)(1e3 * movie->seconds + 0.5) << 16 | 1000u);
    return peri_picture_chunk(movie->file, "fcTL", control, 26);
}

/* Adds the body as it is; also from a peri_frame_fn. */
PERI_PICTURE_FN int32_t peri_movie_add(peri_movie *movie, peri_body *body) {
    unsigned char count[8] = {0};
    peri_picture picture;
    int box[4] = {0, 0, 0, 0};
    int32_t result;
    if (!movie->file) return PERI_ERROR_ORDER;
    if ((result = peri_picture_draw_settled(&picture, body, &movie->desc, 1.0)) < 0) return result;
    box[2] = picture.width, box[3] = picture.height;
    if (movie->frames == 0) {
        result = peri_picture_head(movie->file, &picture) && peri_picture_chunk(movie->file, "acTL", count, 8) &&
                         peri_picture_chunk(movie->file, "PLTE", picture.palette, 768)
                     ? PERI_OK
                     : PERI_ERROR_WRITE;
    } else if (picture.width != movie->last.width || picture.height != movie->last.height) {
        result = PERI_ERROR_CAPACITY;
    } else {
        peri_movie_changed(&picture, &movie->last, box);
    }
    if (result >= 0 && !peri_movie_control(movie, box)) result = PERI_ERROR_WRITE;
    if (result >= 0) result = peri_picture_data(movie->file, &picture, box, movie->frames ? (int64_t)movie->chunks++ : -1);
    if (result < 0) {
        peri_picture_destroy(&picture);
        return result;
    }
    peri_picture_destroy(&movie->last);
    movie->last = picture;
    movie->frames++;
    return PERI_OK;
}

PERI_PICTURE_FN int32_t peri_movie_close(peri_movie *movie) {
    unsigned char count[8] = {0};
    int good = movie->file && movie->frames > 0;
    if (good) good = peri_picture_chunk(movie->file, "IEND", count, 0);
    peri_picture_number(count, movie->frames);
    if (good) good = fseek(movie->file, 33, SEEK_SET) == 0 && peri_picture_chunk(movie->file, "acTL", count, 8); /* after IHDR */
    if (movie->file && fclose(movie->file) != 0) good = 0;
    peri_picture_destroy(&movie->last);
    movie->file = NULL;
    return good ? PERI_OK : PERI_ERROR_WRITE;
}

#endif
