/* SPDX-License-Identifier: MIT */
/* png.h - pictures of fields, for the examples.
     picture_write   writes an 8-bit palette PNG (one block of fixed Huffman codes, matches one byte or one row back)
     picture_field   draws the points of a body as squares coloured by a field, with a colour bar
   Both return PERI_OK or a negative peri_status. */
#ifndef PERI_EXAMPLE_PNG_H
#define PERI_EXAMPLE_PNG_H

#include "example.h"
#include <string.h>

/* ---- PNG -------------------------------------------------------------------------------------------------- */

typedef struct png_stream {
    unsigned char *bytes;
    size_t         count;
    uint32_t       bits; /* not yet a whole byte, lowest bit first */
    int            held; /* how many */
} png_stream;

/* Numbers fill the bytes from the lowest bit upwards. */
static inline void png_put(png_stream *out, uint32_t value, int bits) {
    out->bits |= value << out->held;
    for (out->held += bits; out->held >= 8; out->held -= 8) {
        out->bytes[out->count++] = (unsigned char)(out->bits & 255u);
        out->bits >>= 8;
    }
}

/* Huffman codes come highest bit first. */
static inline void png_put_code(png_stream *out, uint32_t code, int bits) {
    while (bits-- > 0) png_put(out, (code >> bits) & 1u, 1);
}

/* A literal byte (0-255), the end (256) or a length symbol (257 and up) in the fixed code of RFC 1951, 3.2.6. */
static inline void png_put_symbol(png_stream *out, uint32_t symbol) {
    if (symbol < 144) png_put_code(out, 0x30u + symbol, 8);
    else if (symbol < 256) png_put_code(out, 0x190u + symbol - 144u, 9);
    else if (symbol < 280) png_put_code(out, symbol - 256u, 7);
    else png_put_code(out, 0xC0u + symbol - 280u, 8);
}

/* "Repeat `length` bytes (3 to 257) from `distance` bytes back." Both numbers are written like small floats: a symbol
   for exponent and leading bits, then the other bits as they are. */
static inline void png_put_match(png_stream *out, uint32_t length, uint32_t distance) {
    int extra = 0;
    for (length -= 3; length >> extra >= 8u; ++extra) {}
    png_put_symbol(out, 257u + 4u * (uint32_t)extra + (length >> extra));
    png_put(out, length & ((1u << extra) - 1u), extra);
    extra = 0;
    for (distance -= 1; distance >> extra >= 4u; ++extra) {}
    png_put_code(out, 2u * (uint32_t)extra + (distance >> extra), 5);
    png_put(out, distance & ((1u << extra) - 1u), extra);
}

/* How many bytes from `at` on (257 at most) equal those `distance` before them. */
static inline size_t png_match(const unsigned char *data, size_t at, size_t count, size_t distance) {
    size_t n = 0;
    if (distance > at || distance > 32768) return 0;
    while (n < 257 && at + n < count && data[at + n] == data[at + n - distance]) ++n;
    return n;
}

static inline void png_number(unsigned char *to, uint32_t value) {
    int k;
    for (k = 0; k < 4; ++k) to[k] = (unsigned char)(value >> (24 - 8 * k) & 255u);
}

static inline uint32_t png_crc(uint32_t crc, const unsigned char *data, size_t count) {
    size_t i;
    int k;
    for (i = 0; i < count; ++i)
        for (crc ^= data[i], k = 0; k < 8; ++k) crc = crc & 1u ? crc >> 1 ^ 0xEDB88320u : crc >> 1;
    return crc;
}

static inline int png_chunk(FILE *file, const char *type, const unsigned char *data, size_t count) {
    unsigned char head[8], tail[4];
    png_number(head, (uint32_t)count);
    memcpy(head + 4, type, 4);
    png_number(tail, ~png_crc(png_crc(0xFFFFFFFFu, head + 4, 4), data, count));
    return fwrite(head, 1, 8, file) == 8 && fwrite(data, 1, count, file) == count && fwrite(tail, 1, 4, file) == 4;
}

/* index[width*height] holds palette entries, rows from the top; palette[256*3] holds red, green, blue. */
static inline int32_t picture_write(const char *path, int width, int height, const unsigned char *index,
                                    const unsigned char *palette) {
    static const unsigned char signature[8] = {137, 80, 78, 71, 13, 10, 26, 10};
    const size_t row = (size_t)width + 1, count = row * (size_t)height; /* a row: filter 0 (none), then pixels */
    unsigned char header[13] = {0}, *data;
    png_stream out = {0};
    uint32_t a = 1, b = 0; /* Adler-32 */
    size_t i;
    FILE *file;
    int good;

    if (width < 1 || height < 1) return PERI_ERROR_ARGUMENT;
    data = (unsigned char *)malloc(count);
    out.bytes = (unsigned char *)malloc(count + count / 8 + 64);
    if (!data || !out.bytes) {
        free(data);
        free(out.bytes);
        return PERI_ERROR_MEMORY;
    }
    for (i = 0; i < (size_t)height; ++i) {
        data[i * row] = 0;
        memcpy(data + i * row + 1, index + i * (size_t)width, (size_t)width);
    }
    png_put(&out, 0x0178u, 16); /* zlib header */
    png_put(&out, 3u, 3);       /* last block, fixed code */
    for (i = 0; i < count;) {
        const size_t run = png_match(data, i, count, 1), above = png_match(data, i, count, row);
        const size_t length = run > above ? run : above;
        if (length >= 3) png_put_match(&out, (uint32_t)length, run > above ? 1u : (uint32_t)row);
        else png_put_symbol(&out, data[i]);
        i += length >= 3 ? length : 1;
    }
    png_put_symbol(&out, 256);
    png_put(&out, 0, 7);
    for (i = 0; i < count; ++i) {
        a = (a + data[i]) % 65521u;
        b = (b + a) % 65521u;
    }
    png_number(out.bytes + out.count, b << 16 | a);

    png_number(header, (uint32_t)width);
    png_number(header + 4, (uint32_t)height);
    header[8] = 8; /* bits */
    header[9] = 3; /* palette */
    file = fopen(path, "wb");
    good = file != NULL && fwrite(signature, 1, 8, file) == 8 && png_chunk(file, "IHDR", header, 13) &&
           png_chunk(file, "PLTE", palette, 768) && png_chunk(file, "IDAT", out.bytes, out.count + 4) &&
           png_chunk(file, "IEND", header, 0);
    if (file != NULL && fclose(file) != 0) good = 0;
    free(data);
    free(out.bytes);
    return good ? PERI_OK : PERI_ERROR_WRITE;
}

/* ---- fields ----------------------------------------------------------------------------------------------- */

/* Entry 0 is white, 1 to 255 go from dark indigo over blue and green to light yellow, brighter with every entry: also
   readable in grey and by the colour-blind. */
static inline void picture_palette(unsigned char *palette) {
    static const double anchor[6][3] = {{34, 16, 66},   {58, 66, 136},  {38, 114, 142},
                                        {42, 164, 128}, {134, 206, 74}, {253, 231, 76}};
    int i, k;
    memset(palette, 255, 3);
    for (i = 1; i < 256; ++i) {
        const double at = 5.0 * (i - 1) / 254.0;
        const int low = at < 4.0 ? (int)at : 4;
        for (k = 0; k < 3; ++k)
            palette[3 * i + k] =
                (unsigned char)(anchor[low][k] + (at - low) * (anchor[low + 1][k] - anchor[low][k]) + 0.5);
    }
}

static inline unsigned char picture_colour(double value, double lo, double hi) {
    const double at = (value - lo) / (hi - lo);
    return (unsigned char)(at > 0.0 ? (at < 1.0 ? 1.5 + 254.0 * at : 255.0) : 1.0);
}

/* Fills the rectangle [x0, x1) x [y0, y1), rows from the bottom, as far as it lies in the picture. */
static inline void picture_rectangle(unsigned char *index, int width, int height, double x0, double y0, double x1,
                                     double y1, unsigned char colour) {
    const int left = (int)fmax(x0, 0.0), right = (int)fmin(x1, width);
    int y = (int)fmax(y0, 0.0), top = (int)fmin(y1, height);
    for (; y < top && left < right; ++y)
        memset(index + (size_t)(height - 1 - y) * (size_t)width + left, colour, (size_t)(right - left));
}

/* Draws each point as a square of the size of its cell at position + magnify * displacement, coloured by a field from
   lo (dark) to hi (bright); lo = hi takes the range of the field. Of a vector field the magnitude counts. The
   picture is up to pixels_wide wide. A 3D body is seen from above: later points hide earlier ones (boxes number z
   last). */
static inline int32_t picture_field(const char *path, peri_body *body, int32_t field, double lo, double hi,
                                    int pixels_wide, double magnify) {
    enum { MARGIN = 10, BAR = 14 };
    const int64_t n = peri_point_count(body), size = peri_size_of_field(body, field);
    const int dim = peri_dimension(body);
    int64_t i, k;
    double *x, *u, *v, *f, box[2][2] = {{0, 0}, {0, 0}}, cell = 0, scale, spread, range[2] = {HUGE_VAL, -HUGE_VAL};
    unsigned char palette[768], *index = NULL;
    int width, height, step, d;
    int32_t result = PERI_ERROR_MEMORY;

    if (n < 1) return PERI_ERROR_EMPTY;
    if (size < n) return PERI_ERROR_FIELD;
    x = (double *)malloc((size_t)(n * dim) * sizeof *x);
    u = (double *)malloc((size_t)(n * dim) * sizeof *u);
    v = (double *)malloc((size_t)n * sizeof *v);
    f = (double *)malloc((size_t)size * sizeof *f);
    if (!x || !u || !v || !f) goto done;
    if ((result = peri_get_field(body, PERI_FIELD_POSITION, x, n * dim)) < 0) goto done;
    if ((result = peri_get_field(body, PERI_FIELD_DISPLACEMENT, u, n * dim)) < 0) goto done;
    if ((result = peri_get_field(body, PERI_FIELD_VOLUME, v, n)) < 0) goto done;
    if ((result = peri_get_field(body, field, f, size)) < 0) goto done;

    for (i = 0; i < n; ++i) {
        double square = 0.0;
        for (k = 0; size > n && k < dim; ++k) square += f[i * dim + k] * f[i * dim + k];
        f[i] = size > n ? sqrt(square) : f[i];
        range[0] = fmin(range[0], f[i]);
        range[1] = fmax(range[1], f[i]);
        v[i] = 0.5 * (dim == 2 ? sqrt(v[i]) : cbrt(v[i])); /* half the side of the cell */
        cell += 2.0 * v[i] / (double)n;
        for (d = 0; d < 2; ++d)  { /* the body at rest */
            box[0][d] = i ? fmin(box[0][d], x[i * dim + d] - v[i]) : x[d] - v[0];
            box[1][d] = i ? fmax(box[1][d], x[i * dim + d] + v[i]) : x[d] + v[0];
        }
    }
    if (!(lo < hi)) {
        lo = range[0];
        hi = range[1] > range[0] ? range[1] : range[0] + 1.0;
    }
    /* Room for the moved points, but not for fragments that flew far away. */
    spread = 0.05 * fmax(box[1][0] - box[0][0], box[1][1] - box[0][1]);
    for (d = 0; d < 2; ++d) {
        const double least = box[0][d] - spread, most = box[1][d] + spread;
        for (i = 0; i < n; ++i) {
            const double at = x[i * dim + d] += magnify * u[i * dim + d];
            if (at - v[i] < box[0][d]) box[0][d] = fmax(at - v[i], least);
            if (at + v[i] > box[1][d]) box[1][d] = fmin(at + v[i], most);
        }
    }
    /* A whole number of pixels for the average cell, where that is 2 or more. */
    scale = fmax(pixels_wide - 3 * MARGIN - BAR, 1) / (box[1][0] - box[0][0]);
    if (scale * cell >= 2.0) scale = floor(scale * cell + 1e-6) / cell;
    width = (int)ceil(scale * (box[1][0] - box[0][0]) - 1e-6) + 3 * MARGIN + BAR;
    height = (int)ceil(scale * (box[1][1] - box[0][1]) - 1e-6) + 2 * MARGIN;
    index = (unsigned char *)calloc((size_t)width, (size_t)height);
    result = PERI_ERROR_MEMORY;
    if (!index) goto done;
    for (i = 0; i < n; ++i) {
        const double cx = MARGIN + scale * (x[i * dim] - box[0][0]), half = scale * v[i] + 0.25;
        const double cy = MARGIN + scale * (x[i * dim + 1] - box[0][1]);
        if (cx < MARGIN || cy < MARGIN || cx > width - 2 * MARGIN - BAR || cy > height - MARGIN) continue;
        picture_rectangle(index, width, height, floor(cx - half + 0.5), floor(cy - half + 0.5),
                          floor(cx + half + 0.5), floor(cy + half + 0.5), picture_colour(f[i], lo, hi));
    }
    for (step = MARGIN; step < height - MARGIN; ++step)
        picture_rectangle(index, width, height, width - MARGIN - BAR, step, width - MARGIN, step + 1,
                          picture_colour(step, MARGIN, height - MARGIN - 1));
    picture_palette(palette);
    result = picture_write(path, width, height, index, palette);
done:
    free(x);
    free(u);
    free(v);
    free(f);
    free(index);
    return result;
}

#endif
