/* SPDX-License-Identifier: MIT
 *
 * Quaternions where sizes and cancellation matter, in double. */
#include "quaternion.h"

#include <math.h>
#include <string.h>

double spti_power_below(double x) {
    const uint64_t exponent = UINT64_C(0x7ff0000000000000), least = UINT64_C(0x0010000000000000);
    const uint64_t most = UINT64_C(0x7fc0000000000000);
    uint64_t bits;
    double power;
    memcpy(&bits, &x, sizeof bits);
    bits &= exponent;
    if (bits < least) bits = least;
    if (bits > most) bits = most;
    memcpy(&power, &bits, sizeof power);
    return power;
}

double spti_quaternion_largest(spt_quaternion q) {
    const double components[4] = {q.real, q.x, q.y, q.z};
    double largest = 0.0;
    int i;
    for (i = 0; i < 4; ++i) {
        if (fabs(components[i]) > largest) largest = fabs(components[i]);
    }
    return largest;
}

/* ---- Sums of products, as if in twice the precision (Ogita, Rump and Oishi 2005) ------------- */

typedef struct precise_sum {
    double rounded, rests;
} precise_sum;

/* The upper half of a number: both have 26 bits (Veltkamp 1968). */
static double upper_half(double x) {
    const double spread = x * 134217729.0;
    return spread - (spread - x);
}

static void add_product(precise_sum *sum, double x, double y) {
    const double x_high = upper_half(x), x_low = x - x_high;
    const double y_high = upper_half(y), y_low = y - y_high;
    const double product = x * y, next = sum->rounded + product, part = next - sum->rounded;
    /* what was rounded off of the product (Dekker 1971), and of the sum (Knuth) */
    sum->rests += ((x_high * y_high - product) + x_high * y_low + x_low * y_high) + x_low * y_low;
    sum->rests += (sum->rounded - (next - part)) + (product - part);
    sum->rounded = next;
}

/* Halves of numbers from 1e300 on overflow: the sum is then a plain one. */
static double total_of(const precise_sum *sum) {
    return fabs(sum->rests) <= DBL_MAX ? sum->rounded + sum->rests : sum->rounded;
}

/* Of row `component` of the product's four sums. */
static void add_row(precise_sum *sum, int component, spt_quaternion p, spt_quaternion q) {
    static const int place[4][4] = {{0, 1, 2, 3}, {1, 0, 3, 2}, {2, 3, 0, 1}, {3, 2, 1, 0}};
    static const double sign[4][4] = {{1.0, -1.0, -1.0, -1.0},
                                      {1.0, 1.0, 1.0, -1.0},
                                      {1.0, -1.0, 1.0, 1.0},
                                      {1.0, 1.0, -1.0, 1.0}};
    const double left[4] = {p.real, p.x, p.y, p.z}, right[4] = {q.real, q.x, q.y, q.z};
    int i;
    for (i = 0; i < 4; ++i) {
        add_product(sum, left[i] * sign[component][i], right[place[component][i]]);
    }
}

spt_quaternion spti_quaternion_sum_of_products(spt_quaternion p, spt_quaternion q, spt_quaternion r,
                                               spt_quaternion s) {
    double component[4];
    int i;
    for (i = 0; i < 4; ++i) {
        precise_sum sum = {0.0, 0.0};
        add_row(&sum, i, p, q);
        add_row(&sum, i, r, s);
        component[i] = total_of(&sum);
    }
    return spt_quaternion_of(component[0], component[1], component[2], component[3]);
}

/* ---- Lengths ------------------------------------------------------------------------------- */

double spti_quaternion_length(spt_quaternion q) {
    const double power = spti_power_below(spti_quaternion_largest(q));
    return sqrt(spt_quaternion_square(spt_quaternion_scaled(q, 1.0 / power))) * power;
}

spt_quaternion spti_quaternion_unit(spt_quaternion q) {
    const double power = spti_power_below(spti_quaternion_largest(q));
    const spt_quaternion scaled = spt_quaternion_scaled(q, 1.0 / power);
    precise_sum square = {0.0, 0.0};
    double length;
    add_row(&square, 0, spt_quaternion_conjugate(scaled), scaled);
    length = sqrt(total_of(&square));
    if (!(length > 0.0)) return scaled;
    return spt_quaternion_of(scaled.real / length, scaled.x / length, scaled.y / length,
                             scaled.z / length);
}

spt_quaternion spti_quaternion_quotient(spt_quaternion p, spt_quaternion q) {
    const double factor = 1.0 / spti_power_below(spti_quaternion_largest(q));
    const spt_quaternion under = spt_quaternion_scaled(q, factor);
    const spt_quaternion product =
        spt_quaternion_product(spt_quaternion_scaled(p, factor), spt_quaternion_conjugate(under));
    const double square = spt_quaternion_square(under);
    return spt_quaternion_of(product.real / square, product.x / square, product.y / square,
                             product.z / square);
}
