/* SPDX-License-Identifier: MIT */
/* extras/peri_view.h: pictures are PNG files whose chunks have the right sums and whose data inflate to the pixels that were drawn; colours
   rise evenly; texts lie within the picture; bars, axes, cracks and pieces are where the body says; movies have the frames that were added.
   SOURCE OF TRUTH: RFC 1950, 1951, the PNG specification (third edition) by a reader of our own, which shares no code with the writer; the
   relative luminance of sRGB (IEC 61966-2-1); simulated colour vision by Vienot, Brettel and Mollon (1999); geometry by hand. */
#include "../extras/peri_view.h"
#include "peri_test.h"
#include <float.h>

/* ---- a reader of PNG: one block of fixed Huffman codes -------------------------------------------------------- */

typedef struct png_file {
    unsigned char *bytes;
    size_t         size;
} png_file;

static png_file load(const char *path) {
    png_file f = {NULL, 0};
    FILE *file = fopen(path, "rb");
    if (!file) return f;
    f.bytes = (unsigned char *)malloc(1 << 22);
    if (f.bytes) f.size = fread(f.bytes, 1, 1 << 22, file);
    (void)fclose(file);
    return f;
}

static uint32_t number(const unsigned char *p) { return (uint32_t)p[0] << 24 | (uint32_t)p[1] << 16 | (uint32_t)p[2] << 8 | p[3]; }

/* The remainder of a division of polynomials over {0, 1}, bit by bit. */
static uint32_t crc_by_bits(const unsigned char *p, size_t n) {
    uint32_t r = 0xFFFFFFFFu;
    for (size_t i = 0; i < 8 * n; ++i) {
        const uint32_t bit = ((uint32_t)p[i / 8] >> (i % 8) & 1u) ^ (r & 1u);
        r = r >> 1 ^ (bit ? 0xEDB88320u : 0u);
    }
    return ~r;
}

typedef struct bits {
    const unsigned char *p;
    size_t at, most; /* in bits */
} bits;

static uint32_t take(bits *b, int n) {
    uint32_t v = 0;
    for (int k = 0; k < n; ++k, ++b->at)
        if (b->at < b->most) v |= ((uint32_t)b->p[b->at / 8] >> (b->at % 8) & 1u) << k;
    return v;
}

static uint32_t symbol(bits *b) { /* RFC 1951, 3.2.6 */
    uint32_t code = 0;
    for (int length = 1; length <= 9; ++length) {
        code = code << 1 | take(b, 1);
        if (length == 7 && code < 0x18) return 256 + code;
        if (length == 8 && code >= 0x30 && code < 0xC0) return code - 0x30;
        if (length == 8 && code >= 0xC0 && code < 0xC8) return 280 + code - 0xC0;
        if (length == 9 && code >= 0x190) return 144 + code - 0x190;
    }
    return 999;
}

/* Bytes written to out, or 0 where the data are bad. The tables are those of RFC 1951, 3.2.5. */
static size_t inflate(const unsigned char *data, size_t size, unsigned char *out, size_t capacity) {
    static const int base[29] = {3, 4, 5, 6, 7, 8, 9, 10, 11, 13, 15, 17, 19, 23, 27, 31, 35, 43, 51, 59,
                                 67, 83, 99, 115, 131, 163, 195, 227, 258};
    static const int more[29] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0};
    static const int from[30] = {1, 2, 3, 4, 5, 7, 9, 13, 17, 25, 33, 49, 65, 97, 129, 193, 257, 385, 513, 769, 1025, 1537, 2049, 3073,
                                 4097, 6145, 8193, 12289, 16385, 24577};
    bits b = {data + 2, 0, 8 * (size - 2)};
    size_t n = 0;
    uint32_t s, a = 1, c = 0;
    if (size < 8 || (data[0] * 256 + data[1]) % 31 != 0 || (data[0] & 15) != 8 || (data[1] & 32) != 0) return 0;
    if (take(&b, 3) != 3) return 0;
    while ((s = symbol(&b)) != 256) {
        if (s > 285 || n >= capacity) return 0;
        if (s < 256) out[n++] = (unsigned char)s;
        else {
            size_t length = (size_t)base[s - 257] + take(&b, more[s - 257]), distance;
            uint32_t d = 0;
            for (int k = 0; k < 5; ++k) d = d << 1 | take(&b, 1);
            if (d > 29) return 0;
            distance = (size_t)from[d] + take(&b, d < 4 ? 0 : (int)d / 2 - 1);
            if (distance > n || n + length > capacity) return 0;
            for (; length > 0; --length, ++n) out[n] = out[n - distance];
        }
    }
    for (size_t i = 0; i < n; ++i) a = (a + out[i]) % 65521, c = (c + a) % 65521;
    data += 2 + (b.at + 7) / 8;
    return number(data) == (c << 16 | a) ? n : 0;
}

typedef struct png {
    int good, width, height, frames, told_frames; /* frames: of fcTL; told: of acTL */
    int box_outside, number_wrong;
    unsigned char palette[768], *pixels;
    size_t bytes; /* of data */
} png;

static void paste(png *p, const unsigned char *data, size_t size, const uint32_t *box) {
    const size_t row = (size_t)box[0] + 1, whole = row * box[1];
    unsigned char *raw = (unsigned char *)malloc(whole + 1);
    if (!raw || inflate(data, size, raw, whole + 1) != whole) p->good = 0;
    for (uint32_t y = 0; y < box[1] && p->good; ++y) {
        if (raw[y * row] != 0) p->good = 0;
        memcpy(p->pixels + (y + box[3]) * (size_t)p->width + box[2], raw + y * row + 1, box[0]);
    }
    p->bytes += size;
    free(raw);
}

/* Reads all chunks; the pixels are those of the last frame. */
static png read_png(const char *path) {
    png p;
    png_file f = load(path);
    uint32_t box[4] = {0, 0, 0, 0}, next = 0;
    int ended = 0;
    memset(&p, 0, sizeof p);
    p.good = f.size > 8 && memcmp(f.bytes, "\211PNG\r\n\032\n", 8) == 0;
    for (size_t at = 8; p.good && at + 12 <= f.size;) {
        const unsigned char *c = f.bytes + at;
        const uint32_t n = number(c);
        if (n > f.size - at - 12 || number(c + 8 + n) != crc_by_bits(c + 4, n + 4) || ended) { p.good = 0; break; }
        if (!memcmp(c + 4, "IHDR", 4)) {
            p.width = (int)number(c + 8), p.height = (int)number(c + 12);
            p.good = n == 13 && p.width > 0 && p.height > 0 && p.width < 4000 && p.height < 4000 && c[16] == 8 && c[17] == 3 && at == 8;
            p.pixels = (unsigned char *)calloc((size_t)p.width, (size_t)p.height);
            box[0] = (uint32_t)p.width, box[1] = (uint32_t)p.height;
        } else if (!memcmp(c + 4, "PLTE", 4)) memcpy(p.palette, c + 8, n < 768 ? n : 768);
        else if (!memcmp(c + 4, "acTL", 4)) p.told_frames = (int)number(c + 8);
        else if (!memcmp(c + 4, "fcTL", 4)) {
            p.frames++;
            p.number_wrong |= number(c + 8) != next++;
            for (int k = 0; k < 4; ++k) box[k] = number(c + 12 + 4 * k);
            p.box_outside |= box[0] + box[2] > (uint32_t)p.width || box[1] + box[3] > (uint32_t)p.height || !box[0] || !box[1];
        } else if (!memcmp(c + 4, "IDAT", 4)) paste(&p, c + 8, n, box);
        else if (!memcmp(c + 4, "fdAT", 4)) {
            p.number_wrong |= number(c + 8) != next++;
            if (!p.box_outside) paste(&p, c + 12, n - 4, box);
        } else if (!memcmp(c + 4, "IEND", 4)) ended = 1;
        else p.good = 0;
        at += 12 + n;
    }
    p.good = p.good && ended;
    free(f.bytes);
    return p;
}

/* ---- bodies ----------------------------------------------------------------------------------------------------- */

static peri_body *plate(int cracked) {
    const double lo[2] = {0, 0}, hi[2] = {0.2, 0.1}, from[2] = {0.1, -0.01}, to[2] = {0.1, 0.11};
    peri_body_desc d;
    peri_material_desc m;
    peri_body *body = NULL;
    peri_body_desc_init(&d);
    d.space = PERI_SPACE_PLANE_STRESS, d.horizon = 0.0301, d.threads = 1;
    peri_material_desc_init(&m, PERI_LAW_BOND_BASED);
    m.young = 1e9, m.density = 1000;
    CHECK(peri_body_create(&d, &body, NULL) == PERI_OK);
    CHECK(peri_add_box(body, peri_add_material(body, &m), lo, hi, 0.01) == 200);
    CHECK(peri_build(body) == PERI_OK);
    if (cracked) CHECK(peri_cut_segment(body, PERI_CUT_NOW, from, to) > 0);
    return body;
}

static int64_t of_colour(const peri_picture *p, int lo, int hi, double x0, double x1) {
    int64_t n = 0;
    for (int y = 0; y < p->height; ++y)
        for (int x = (int)(x0 * p->width); x < (int)(x1 * p->width); ++x) {
            const int c = p->pixels[y * p->width + x];
            n += c >= lo && c <= hi;
        }
    return n;
}

/* ---- cases -------------------------------------------------------------------------------------------------------- */

static void what_is_written_is_read(void) {
    static const char *path = "build/view.png";
    uint32_t random = 1;
    for (int kind = 0; kind < 4; ++kind) { /* one colour, stripes, noise, noise that repeats 20,000 pixels later */
        peri_picture p;
        png q;
        CHECK(peri_picture_create(&p, 200 + kind, 301, PERI_PICTURE_SEQUENTIAL) == PERI_OK);
        for (int k = 0; k < p.width * p.height; ++k) {
            random = random * 1664525u + 1013904223u;
            p.pixels[k] = (unsigned char)(kind == 0 ? 7 : kind == 1 ? k % 5 : (int)(random >> 24));
            if (kind == 3 && k >= 20000) p.pixels[k] = p.pixels[k - 20000];
        }
        CHECK(peri_picture_write(path, &p) == PERI_OK);
        q = read_png(path);
        CHECK(q.good && q.width == p.width && q.height == p.height);
        CHECK(q.good && memcmp(q.pixels, p.pixels, (size_t)(p.width * p.height)) == 0);
        CHECK(memcmp(q.palette, p.palette, 768) == 0);
        if (kind < 2) CHECK(q.bytes < 1500);                               /* 60,000 pixels */
        if (kind == 3) CHECK(q.bytes < 9 * 20000 / 8 + 40301 / 3);         /* the first 20,000 by at most 9 bits, the others by matches */
        free(q.pixels);
        peri_picture_destroy(&p);
    }
    (void)remove(path);
}

static double linear(int c) {
    const double v = c / 255.0;
    return v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
}

static double luminance(const unsigned char *rgb) { return 0.2126 * linear(rgb[0]) + 0.7152 * linear(rgb[1]) + 0.0722 * linear(rgb[2]); }

/* The luminance that eyes without long (0) or medium (1) cones see, by the projections of Vienot et al.: red and green become one. */
static double seen(const unsigned char *rgb, int which) {
    const double r = linear(rgb[0]), g = linear(rgb[1]), b = linear(rgb[2]);
    const double both = which ? 0.29275 * r + 0.70725 * g : 0.11238 * r + 0.88762 * g;
    const double blue = b + (which ? -0.02234 : 0.00401) * (r - g);
    return (0.2126 + 0.7152) * both + 0.0722 * blue;
}

static void shades_rise_evenly(void) {
    unsigned char palette[768];
    for (int32_t which = PERI_PICTURE_SEQUENTIAL; which <= PERI_PICTURE_GREYS; which += 2) {
        double least = HUGE_VAL, most = 0;
        peri_picture_colours(palette, which);
        for (int k = 0; k + 8 < PERI_PICTURE_SHADES; ++k) { /* over 8 entries: a step of one is below the 255th of a colour */
            const unsigned char *a = palette + 3 * (PERI_PICTURE_SHADE + k), *b = a + 24;
            const double rise = pow(luminance(b), 1 / 3.0) - pow(luminance(a), 1 / 3.0); /* lightness of CIE is linear in this */
            least = fmin(least, rise), most = fmax(most, rise);
            for (int eye = 0; eye < 2; ++eye) CHECK(seen(b, eye) > seen(a, eye));
            CHECK(luminance(a + 3) > luminance(a) - 1e-12 || which == PERI_PICTURE_GREYS);
        }
        CHECK(least > 0);
        CHECK(most < 1.8 * least);
    }
    peri_picture_colours(palette, PERI_PICTURE_DIVERGING);
    for (int k = 0; k < PERI_PICTURE_SHADES / 2 - 4; ++k) { /* lightest in the middle, equal on both sides */
        const unsigned char *a = palette + 3 * (PERI_PICTURE_SHADE + k), *b = palette + 3 * (255 - k);
        CHECK(luminance(a + 12) > luminance(a) && luminance(b - 12) > luminance(b));
        CHECK(fabs(pow(luminance(a), 1 / 3.0) - pow(luminance(b), 1 / 3.0)) < 0.06);
        if (k < 60) CHECK(a[2] > a[0] + 40 && b[0] > b[2] + 40); /* blue and orange: for all eyes */
    }
    CHECK(peri_picture_shade(-1, 0, 1) == PERI_PICTURE_SHADE && peri_picture_shade(2, 0, 1) == 255 && peri_picture_shade(1, 0, 1) == 255);
    CHECK(peri_picture_shade(0, 0, 1) == PERI_PICTURE_SHADE && peri_picture_shade(0.5, 0, 1) == 136);
}

static void letters_are_within_the_picture(void) {
    static const char *text = "Hgjpqy 0123456789 -+.e []";
    for (int upwards = 0; upwards < 2; ++upwards) {
        peri_picture p;
        const int wide = (int)peri_picture_text_width(text, 2), w = upwards ? 18 : wide, h = upwards ? wide : 18;
        int64_t whole, cut;
        CHECK(peri_picture_create(&p, w + 20, h + 20, 1) == PERI_OK);
        peri_picture_text(&p, 10, upwards ? 10 + h : 10, 2, upwards, PERI_PICTURE_INK, text);
        whole = of_colour(&p, 1, 1, 0, 1);
        for (int y = 0; y < p.height; ++y) /* nothing beside the box that text_width and 9 rows span */
            for (int x = 0; x < p.width; ++x)
                if (x < 10 || y < 10 || x >= w + 10 || y >= h + 10) CHECK(p.pixels[y * p.width + x] == 0);
        CHECK(whole > 4 * 200 && whole % 4 == 0); /* 25 letters of about 12 dots */
        peri_picture_text(&p, -1e3, 5, 2, upwards, PERI_PICTURE_INK, "outside");
        peri_picture_text(&p, 5, 1e3, 2, upwards, PERI_PICTURE_INK, "outside");
        cut = of_colour(&p, 1, 1, 0, 1);
        CHECK(cut == whole);
        peri_picture_destroy(&p);
    }
    for (char a = 33; a < 127; ++a) /* no two letters look alike */
        for (char b = 33; b < a; ++b) {
            unsigned char dots[2][54];
            for (int k = 0; k < 2; ++k) {
                peri_picture p;
                const char one[2] = {k ? b : a, 0};
                CHECK(peri_picture_create(&p, 6, 9, 1) == PERI_OK);
                peri_picture_text(&p, 0, 0, 1, 0, 1, one);
                memcpy(dots[k], p.pixels, 54);
                peri_picture_destroy(&p);
            }
            CHECK(memcmp(dots[0], dots[1], 54) != 0);
        }
}

static void ticks_are_round_numbers(void) {
    static const double range[6][2] = {{0, 1}, {-50, 50}, {0, 0.6}, {3, 3.07}, {-2e-6, 5e-6}, {1e7, 9e7}};
    for (int k = 0; k < 6; ++k) {
        const peri_picture_ticks t = peri_picture_ticks_of(range[k][0], range[k][1], 5);
        const double mantissa = t.step / pow(10, floor(log10(t.step) + 1e-9));
        CHECK(t.count >= 3 && t.count <= 9);
        CHECK(fabs(mantissa - 1) < 1e-9 || fabs(mantissa - 2) < 1e-9 || fabs(mantissa - 5) < 1e-9);
        for (int j = 0; j < t.count; ++j) {
            char text[32];
            const double at = t.first + j * t.step;
            CHECK(at > range[k][0] - 1e-6 * t.step && at < range[k][1] + 1e-6 * t.step);
            CHECK(fabs(strtod(peri_picture_tick(&t, j, text, sizeof text), NULL) - at) < 1e-3 * t.step); /* the text says the number */
        }
    }
}

static void the_body_is_where_it_should_be(void) {
    peri_body *body = plate(0);
    peri_picture p;
    peri_picture_desc d;
    double *u = (double *)calloc(400, sizeof *u);
    peri_picture_desc_init(&d);
    d.field = PERI_FIELD_POSITION, d.component = 0, d.bar = 0, d.axes = 0, d.width = 212; /* margins of 6: 10 pixels for each cell */
    CHECK(peri_picture_draw(&p, body, &d) == PERI_OK);
    CHECK(p.width == 212 && p.height == 112);
    for (int i = 0; i < 20; ++i) /* the colour of the column that is there: x of its points, over the range of all */
        for (int y = 6; y < 106; y += 9)
            CHECK(p.pixels[y * p.width + 6 + 10 * i + 5] == peri_picture_shade(0.005 + 0.01 * i, 0.005, 0.195));
    CHECK(of_colour(&p, PERI_PICTURE_SHADE, 255, 0, 1) == 200 * 100);
    peri_picture_destroy(&p);
    /* a part of it, from (0.04, 0.02) on: 20 pixels for each cell, y upwards; the length of a vector */
    d.component = -1, d.box[0] = 0.04, d.box[1] = 0.02, d.box[2] = 0.14, d.box[3] = 0.07, d.lo = 0, d.hi = 0.2;
    CHECK(peri_picture_draw(&p, body, &d) == PERI_OK);
    CHECK(p.width == 212 && p.height == 112);
    for (int i = 0; i < 10; ++i)
        for (int j = 0; j < 5; ++j)
            CHECK(p.pixels[(p.height - 6 - 20 * j - 10) * p.width + 6 + 20 * i + 10] ==
                  peri_picture_shade(hypot(0.045 + 0.01 * i, 0.025 + 0.01 * j), 0, 0.2));
    peri_picture_destroy(&p);
    peri_picture_desc_init(&d);
    d.field = PERI_FIELD_POSITION, d.component = 0, d.bar = 0, d.axes = 0, d.width = 212;
    /* displacements are magnified: a shift of 1/8 of the length by ten times 1/80, to the right edge of a box that is given */
    for (int k = 0; k < 200; ++k) u[2 * k] = 0.0025;
    CHECK(peri_set_field(body, PERI_FIELD_DISPLACEMENT, u, 400) == PERI_OK);
    d.magnify = 10, d.box[2] = 0.2, d.box[3] = 0.1;
    CHECK(peri_picture_draw(&p, body, &d) == PERI_OK);
    CHECK(p.pixels[50 * p.width + 6 + 23] == PERI_PICTURE_PAPER && p.pixels[50 * p.width + 6 + 27] == PERI_PICTURE_SHADE);
    peri_picture_destroy(&p);
    free(u);
    peri_body_destroy(body);
}

static void bars_axes_and_titles_are_drawn(void) {
    peri_body *body = plate(0);
    peri_picture p;
    peri_picture_desc d;
    int64_t plain;
    int colour = 256;
    peri_picture_desc_init(&d);
    d.width = 600, d.lo = 0, d.hi = 1, d.title = "plate", d.label = "damage", d.length_unit = "m";
    CHECK(peri_picture_draw(&p, body, &d) == PERI_OK);
    for (int y = 0; y < p.height; ++y) { /* the bar: every shade, downwards darker */
        int here = 0;
        for (int x = 7 * p.width / 8; x < p.width; ++x)
            if (p.pixels[y * p.width + x] > here) here = p.pixels[y * p.width + x];
        if (here < PERI_PICTURE_SHADE) continue;
        CHECK(here <= colour);
        if (colour < 256) CHECK(colour - here <= 2);
        else CHECK(here == 255);
        colour = here;
    }
    CHECK(colour == PERI_PICTURE_SHADE);
    plain = of_colour(&p, PERI_PICTURE_INK, PERI_PICTURE_INK, 0, 1);
    CHECK(of_colour(&p, PERI_PICTURE_INK, PERI_PICTURE_INK, 0, 0.1) > 50);  /* numbers at the left, */
    CHECK(of_colour(&p, PERI_PICTURE_INK, PERI_PICTURE_INK, 0.93, 1) > 50); /* and at the bar */
    for (int x = 0; x < p.width; ++x) CHECK(p.pixels[x] == 0 && p.pixels[(p.height - 1) * p.width + x] == 0); /* nothing is cut off */
    peri_picture_destroy(&p);
    d.title = NULL;
    CHECK(peri_picture_draw(&p, body, &d) == PERI_OK);
    CHECK(plain - of_colour(&p, PERI_PICTURE_INK, PERI_PICTURE_INK, 0, 1) > 40); /* five letters */
    peri_picture_destroy(&p);
    d.title = "a title that is much longer than the picture is wide, of which what fits is drawn, and the rest is left out, as it must be";
    d.width = 160;
    CHECK(peri_picture_draw(&p, body, &d) == PERI_OK);
    for (int y = 0; y < p.height; ++y) CHECK(p.pixels[y * p.width + p.width - 1] == 0);
    peri_picture_destroy(&p);
    peri_body_destroy(body);
}

static void cracks_and_pieces_are_drawn(void) {
    peri_body *body = plate(1);
    peri_picture p;
    peri_picture_desc d;
    double x = 0;
    int64_t n = 0;
    peri_picture_desc_init(&d);
    d.cracks = 1, d.bar = 0, d.axes = 0, d.width = 412;
    CHECK(peri_picture_draw(&p, body, &d) == PERI_OK);
    for (int k = 0; k < p.width * p.height; ++k)
        if (p.pixels[k] == PERI_PICTURE_CRACK) x += k % p.width + 0.5, ++n;
    CHECK(n >= 180 && fabs(x / (double)n - 206) < 1.5); /* across the plate, in its middle */
    peri_picture_destroy(&p);
    d.cracks = 0, d.field = PERI_FIELD_FRAGMENT;
    CHECK(peri_picture_draw(&p, body, &d) == PERI_OK);
    CHECK(of_colour(&p, PERI_PICTURE_PIECE, PERI_PICTURE_PIECE, 0, 1) == 200 * 200);
    CHECK(of_colour(&p, PERI_PICTURE_PIECE + 1, PERI_PICTURE_PIECE + 1, 0, 1) == 200 * 200);
    CHECK(of_colour(&p, PERI_PICTURE_PIECE, PERI_PICTURE_PIECE, 0.51, 1) == 0);
    peri_picture_destroy(&p);
    peri_body_destroy(body);
}

static void solids_hide_what_is_behind(void) {
    const double lo[3] = {0, 0, 0}, hi[3] = {0.03, 0.04, 0.05};
    static const double near_[3] = {0.025, 0.005, 0.045}; /* of the cells that are seen: greatest x, least y, greatest z */
    peri_body_desc d;
    peri_material_desc m;
    peri_body *body = NULL;
    peri_body_desc_init(&d);
    d.space = PERI_SPACE_SOLID, d.horizon = 0.0301, d.threads = 1;
    peri_material_desc_init(&m, PERI_LAW_BOND_BASED);
    m.young = 1e9, m.density = 1000;
    CHECK(peri_body_create(&d, &body, NULL) == PERI_OK);
    CHECK(peri_add_box(body, peri_add_material(body, &m), lo, hi, 0.01) == 60);
    CHECK(peri_build(body) == PERI_OK);
    for (int32_t along = 0; along < 3; ++along) {
        peri_picture p;
        peri_picture_desc v;
        peri_picture_desc_init(&v);
        v.along = v.component = along, v.field = PERI_FIELD_POSITION, v.bar = v.axes = 0, v.width = 300, v.lo = 0, v.hi = 0.1;
        CHECK(peri_picture_draw(&p, body, &v) == PERI_OK);
        CHECK(p.pixels[p.height / 2 * p.width + p.width / 2] == peri_picture_shade(near_[along], 0, 0.1));
        peri_picture_destroy(&p);
    }
    peri_body_destroy(body);
}

static void movies_have_their_frames(void) {
    static const char *path = "build/view_movie.png", *one = "build/view_one.png";
    peri_body *body = plate(0);
    peri_picture_desc d;
    peri_movie movie;
    png p, q;
    const double from[2] = {0.05, 0.02}, to[2] = {0.05, 0.08};
    peri_picture_desc_init(&d);
    d.lo = 0, d.hi = 0.6, d.show_time = 1;
    CHECK(peri_movie_open(&movie, path, &d, 0.1) == PERI_OK);
    CHECK(peri_movie_add(&movie, body) == PERI_OK);
    CHECK(peri_movie_add(&movie, body) == PERI_OK); /* nothing has changed: a frame of one pixel */
    CHECK(peri_cut_segment(body, PERI_CUT_NOW, from, to) > 0);
    CHECK(peri_movie_add(&movie, body) == PERI_OK);
    d = movie.desc; /* the box of the first frame */
    CHECK(peri_movie_close(&movie) == PERI_OK);
    CHECK(peri_movie_add(&movie, body) == PERI_ERROR_ORDER);
    p = read_png(path);
    CHECK(p.good && p.frames == 3 && p.told_frames == 3 && !p.box_outside && !p.number_wrong);
    CHECK(peri_picture_save(one, body, &d) == PERI_OK);
    q = read_png(one);
    CHECK(q.good && q.frames == 0 && p.width == q.width && p.height == q.height);
    CHECK(q.good && p.good && memcmp(p.pixels, q.pixels, (size_t)(p.width * p.height)) == 0); /* frames on top of each other are the last */
    CHECK(p.bytes < 2 * q.bytes + 200);
    free(p.pixels);
    free(q.pixels);
    (void)remove(path);
    (void)remove(one);
    peri_body_destroy(body);
}

static void what_is_wrong_is_refused(void) {
    peri_body *body = plate(0);
    peri_picture p;
    peri_picture_desc d;
    peri_movie movie;
    peri_picture_desc_init(&d);
    d.field = 1;
    CHECK(peri_picture_draw(&p, body, &d) == PERI_ERROR_FIELD && !p.pixels);
    peri_picture_desc_init(&d);
    d.component = 1;
    CHECK(peri_picture_draw(&p, body, &d) == PERI_ERROR_FIELD && !p.pixels);
    peri_picture_desc_init(&d);
    d.palette = 9;
    CHECK(peri_picture_draw(&p, body, &d) == PERI_ERROR_CHOICE && !p.pixels);
    peri_picture_desc_init(&d);
    d.magnify = HUGE_VAL;
    CHECK(peri_picture_draw(&p, body, &d) == PERI_ERROR_RANGE && !p.pixels);
    peri_picture_desc_init(&d);
    CHECK(peri_picture_save("build/no/such/folder.png", body, &d) == PERI_ERROR_WRITE);
    CHECK(peri_movie_open(&movie, "build/no/such/folder.png", &d, 0.1) == PERI_ERROR_WRITE);
    CHECK(peri_movie_open(&movie, "build/view.png", &d, 0) == PERI_ERROR_RANGE);
    CHECK(peri_picture_create(&p, 0, 5, 1) == PERI_ERROR_RANGE && peri_picture_create(&p, 5, 99999, 1) == PERI_ERROR_RANGE);
    peri_body_destroy(body);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(what_is_written_is_read);
    RUN(shades_rise_evenly);
    RUN(letters_are_within_the_picture);
    RUN(ticks_are_round_numbers);
    RUN(the_body_is_where_it_should_be);
    RUN(bars_axes_and_titles_are_drawn);
    RUN(cracks_and_pieces_are_drawn);
    RUN(solids_hide_what_is_behind);
    RUN(movies_have_their_frames);
    RUN(what_is_wrong_is_refused);
    return test_end("test_view");
}
