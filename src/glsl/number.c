/* SPDX-License-Identifier: MIT
 *
 * Float literals. Not by the C library, whose numbers depend on the locale. */
#include <math.h>

#include "../base/arguments.h"
#include "writer.h"

enum { DIGITS = 9 }; /* so many tell any two floats apart */

/* Whether `rounded` in the place of `scaled`, which stands for the number, reads back as the same
 * float: multiplying by tens loses 1e-14 in all. */
static int reads_back(double number, double scaled, double rounded) {
    const double read = number * (rounded / scaled);
    return (float)(read * (1 - 1e-13)) == (float)number &&
           (float)(read * (1 + 1e-13)) == (float)number;
}

/* Brings a positive number to 9 digits before the point, as few of them other than trailing zeros
 * as tell it apart, and gives the decimal exponent of the first. */
static double few_digits(double number, int *exponent) {
    double scaled = number, unit = 1e8;
    *exponent = DIGITS - 1;
    for (int i = 0; i < 64 && scaled >= 999999999.5; ++i) {
        scaled /= 10;
        *exponent += 1;
    }
    for (int i = 0; i < 64 && scaled < 1e8; ++i) {
        scaled *= 10;
        *exponent -= 1;
    }
    for (; unit > 1; unit /= 10) {
        const double rounded = floor(scaled / unit + 0.5) * unit;
        if (!reads_back(number, scaled, rounded)) continue;
        *exponent += rounded >= 1e9;
        return rounded >= 1e9 ? 1e8 : rounded;
    }
    return floor(scaled + 0.5);
}

size_t spti_glsl_number(float number, int brackets, char text[24]) {
    const int negative = number < 0.0f;
    const double magnitude = (double)fabsf(number);
    char digits[DIGITS];
    int exponent = 0, last = DIGITS - 1;
    size_t length = 0;
    if (!(magnitude >=
          (double)FLT_MIN)) { /* no subnormal numbers: some implementations lose them */
        memcpy(text, "0.0", 4);
        return 3;
    }
    double rest = few_digits(magnitude, &exponent);
    for (int i = DIGITS - 1; i >= 0; --i) {
        const double shorter = floor(rest / 10);
        digits[i] = (char)('0' + (int)(rest - 10 * shorter));
        rest = shorter;
    }
    for (int i = DIGITS - 1; i > 0 && digits[i] == '0'; --i) last = i - 1;
    /* As people write them: in full from 0.001 to a million. */
    const int plain = exponent >= -3 && exponent < 6;
    const int whole = !plain ? 1 : exponent >= 0 ? exponent + 1 : 0; /* digits before the point */
    if (negative && brackets) text[length++] = '(';
    if (negative) text[length++] = '-';
    if (whole == 0) {
        text[length++] = '0';
        text[length++] = '.';
        for (int i = -1; i > exponent; --i) text[length++] = '0';
    }
    for (int i = 0; i <= last || i < whole; ++i) {
        if (i == whole && i > 0) text[length++] = '.';
        text[length++] = i <= last ? digits[i] : '0';
    }
    if (last < whole) {
        text[length++] = '.';
        text[length++] = '0';
    }
    if (!plain) {
        const int size = exponent < 0 ? -exponent : exponent;
        text[length++] = 'e';
        if (exponent < 0) text[length++] = '-';
        if (size >= 10) text[length++] = (char)('0' + size / 10);
        text[length++] = (char)('0' + size % 10);
    }
    if (negative && brackets) text[length++] = ')';
    text[length] = '\0';
    return length;
}
