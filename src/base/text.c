/* SPDX-License-Identifier: MIT */
/* text.c - numbers to text: no printf, so no locale and no stdio. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

static char *peri__put_text(char *out, const char *text) {
    size_t length = strlen(text);
    memcpy(out, text, length);
    return out + length;
}

static char *peri__put_integer(char *out, int64_t value) {
    char digits[24];
    int count = 0;
    uint64_t rest = value < 0 ? (uint64_t)0 - (uint64_t)value : (uint64_t)value;
    if (value < 0) *out++ = '-';
    do {
        digits[count++] = (char)('0' + (int)(rest % 10));
        rest /= 10;
    } while (rest > 0);
    while (count > 0) *out++ = digits[--count];
    return out;
}

/* d.ddddddddddddddde[-]ddd, 16 significant digits, right to a few units of the last. At most 26 characters. */
static char *peri__put_double(char *out, double value) {
    if (value != value) return peri__put_text(out, "nan");
    if (value < 0.0) {
        *out++ = '-';
        value = -value;
    }
    if (value == 0.0) return peri__put_text(out, "0");
    if (value > DBL_MAX) return peri__put_text(out, "inf");
    int exponent = (int)floor(log10(value));
    /* two factors: 10^exponent alone over- or underflows at the ends of the range */
    int half = exponent / 2;
    double scaled = value / pow(10.0, half) / pow(10.0, exponent - half) * 1e15;
    if (scaled < 1e15) {
        scaled *= 10.0;
        exponent--;
    }
    if (scaled >= 9999999999999999.5) {
        scaled /= 10.0;
        exponent++;
    }
    char digits[32];
    char *end = peri__put_integer(digits, (int64_t)(scaled + 0.5));
    while (end > digits + 1 && end[-1] == '0') --end;
    *out++ = digits[0];
    if (end > digits + 1) {
        *out++ = '.';
        memcpy(out, digits + 1, (size_t)(end - digits - 1));
        out += end - digits - 1;
    }
    if (exponent != 0) {
        *out++ = 'e';
        out = peri__put_integer(out, exponent);
    }
    return out;
}
