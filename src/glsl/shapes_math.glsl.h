/* SPDX-License-Identifier: MIT
 *
 * shapes_math.h as GLSL. Left out: SPT_UNROLL and the types, which GLSL has its own of, and
 * spti_shape_zero(), which is 0.0: where the C code adds it the sign of zero does not count. */
#ifndef SPTI_SHAPES_MATH_GLSL_H
#define SPTI_SHAPES_MATH_GLSL_H

#include "../base/glsl_piece.h"

/* All functions of shapes_math.h by their names. Other than there
 *     spt_choose   takes a bool
 *     spt_bits_of and those beside it take and give uint
 *     spt_log(0)   is -infinity by its bits, since GLSL has no literal for it
 * What is double in C for the builders (spti_shape_sin_double and so on) is a pair of floats here,
 * at the end of the list: GLSL without double has to give the same 24 bits. */
static const spti_glsl_piece spti_glsl_shapes_math[] = {
    {"spt_point_of", "// A point or a vector.\n"
                     "vec3 spt_point_of(float x, float y, float z) {\n"
                     "    return vec3(x, y, z);\n"
                     "}\n"},
    {"spt_least", "// The smaller one; b if either is NaN.\n"
                  "float spt_least(float a, float b) {\n"
                  "    $precise float least = a < b ? a : b;\n"
                  "    return least;\n"
                  "}\n"},
    {"spt_greatest", "// The larger one; b if either is NaN.\n"
                     "float spt_greatest(float a, float b) {\n"
                     "    $precise float greatest = a > b ? a : b;\n"
                     "    return greatest;\n"
                     "}\n"},
    {"spt_bits_of", "// The bits of a number.\n"
                    "uint spt_bits_of(float x) {\n"
                    "    return floatBitsToUint(x);\n"
                    "}\n"},
    {"spt_real_of", "// The number of these bits.\n"
                    "float spt_real_of(uint bits) {\n"
                    "    return uintBitsToFloat(bits);\n"
                    "}\n"},
    {"spt_sign_bit", "// The sign bit of x, all others 0.\n"
                     "uint spt_sign_bit(float x) {\n"
                     "    return floatBitsToUint(x) & 0x80000000u;\n"
                     "}\n"},
    {"spt_positive", "// max(x, 0), and 0 if x is NaN.\n"
                     "float spt_positive(float x) {\n"
                     "    $precise float most = x > 0.0 ? x : 0.0;\n"
                     "    return most;\n"
                     "}\n"},
    {"spt_negative", "// min(x, 0), and 0 if x is NaN.\n"
                     "float spt_negative(float x) {\n"
                     "    $precise float least = x < 0.0 ? x : 0.0;\n"
                     "    return least;\n"
                     "}\n"},
    {"spt_clamp", "// x brought into [low, high]; low if x is NaN.\n"
                  "float spt_clamp(float x, float low, float high) {\n"
                  "    $precise float raised = x > low ? x : low;\n"
                  "    $precise float within = raised < high ? raised : high;\n"
                  "    return within;\n"
                  "}\n"},
    {"spt_choose", "// condition ? a : b, as C code that vectorises writes it.\n"
                   "float spt_choose(bool condition, float a, float b) {\n"
                   "    return condition ? a : b;\n"
                   "}\n"},
    {"spt_magnitude", "// |x|\n"
                      "float spt_magnitude(float x) {\n"
                      "    return abs(x);\n"
                      "}\n"},
    {"spt_root", "// The square root.\n"
                 "float spt_root(float x) {\n"
                 "    return sqrt(x);\n"
                 "}\n"},
    {"spt_dot",
     "// a.b, the products added from left to right. They are multiplied as vectors, since of\n"
     "// a.x * b.x + a.y * b.y compilers without `precise` take out an a.x = a.y.\n"
     "float spt_dot(vec3 a, vec3 b) {\n"
     "    $precise vec3 products = a * b;\n"
     "    $precise float sum = products.x + products.y + products.z;\n"
     "    return sum;\n"
     "}\n"},
    {"spt_length_2", "// The length of a vector in the plane.\n"
                     "float spt_length_2(float x, float y) {\n"
                     "    $precise float square = x * x + y * y;\n"
                     "    return sqrt(square);\n"
                     "}\n"},
    {"spt_length_3", "// The length of a vector in space, the squares added from left to right.\n"
                     "float spt_length_3(float x, float y, float z) {\n"
                     "    $precise float square = x * x + y * y + z * z;\n"
                     "    return sqrt(square);\n"
                     "}\n"},
    {"spt_limit",
     "// x brought into [-limit, limit], limit > 0; the limit of its sign for NaN. By bits, as\n"
     "// positive numbers are ordered as their bits are.\n"
     "float spt_limit(float x, float limit) {\n"
     "    uint sign_bit = floatBitsToUint(x) & 0x80000000u;\n"
     "    int magnitude = int(floatBitsToUint(x) ^ sign_bit);\n"
     "    int most = floatBitsToInt(limit);\n"
     "    return uintBitsToFloat(uint(min(magnitude, most)) | sign_bit);\n"
     "}\n"},
    {"spt_nearest", "// The nearest integer, halves away from zero; |x| < 2^31.\n"
                    "int spt_nearest(float x) {\n"
                    "    uint sign_bit = floatBitsToUint(x) & 0x80000000u;\n"
                    "    $precise float beyond = x + uintBitsToFloat(0x3f000000u | sign_bit);\n"
                    "    return int(beyond); // 0x3f000000 is 0.5\n"
                    "}\n"},

    /* ---- Sine, cosine, exponential, logarithm ------------------------------------------------ */

    {"spt_shape_sine", "// Sine on [-pi/2, pi/2]: r + r^3 P(r^2), P minimax of degree 3, relative\n"
                       "// error below 6.1e-9. GLSL's own has other bits on every machine.\n"
                       "float spt_shape_sine(float r) {\n"
                       "    $precise float z = r * r;\n"
                       "    $precise float p = 2.6057055e-6;\n"
                       "    p = p * z - 1.98095702e-4;\n"
                       "    p = p * z + 8.33306555e-3;\n"
                       "    p = p * z - 0.166666597;\n"
                       "    $precise float sine = r + r * z * p;\n"
                       "    return sine;\n"
                       "}\n"},
    {"spt_shape_reduce",
     "// x - turns * pi, pi in three parts of 8, 11 and 24 bits (Cody and Waite 1980): exact\n"
     "// products up to 13 bits of turns.\n"
     "float spt_shape_reduce(float x, float turns) {\n"
     "    $precise float rest = ((x - turns * 3.140625) - turns * 9.67502594e-4)\n"
     "                          - turns * 1.50995803e-7;\n"
     "    return rest;\n"
     "}\n"},
    {"spt_sin", "// sin(angle), |angle| <= 1e5; absolute error below 1.5e-7 up to 1e4.\n"
                "float spt_sin(float angle) {\n"
                "    float x = spt_limit(angle, 100000.0);\n"
                "    int n = spt_nearest(x * 0.318309873);\n"
                "    float sine = spt_shape_sine(spt_shape_reduce(x, float(n)));\n"
                "    return (n & 1) != 0 ? -sine : sine;\n"
                "}\n"},
    {"spt_cos", "// cos(angle) as -sin(angle - pi/2), with the quarter turn inside the reduction.\n"
                "float spt_cos(float angle) {\n"
                "    float x = spt_limit(angle, 100000.0);\n"
                "    $precise float turns = x * 0.318309873 - 0.5;\n"
                "    int n = spt_nearest(turns);\n"
                "    float sine = spt_shape_sine(spt_shape_reduce(x, float(n) + 0.5));\n"
                "    return (n & 1) != 0 ? sine : -sine;\n"
                "}\n"},
    {"spt_shape_exp",
     "// exp(x) for -86.5 < x < 89: 2^n exp(r), exp(r) = 1 + r + r^2 P(r), P minimax of degree\n"
     "// 4, relative error below 3.2e-9.\n"
     "float spt_shape_exp(float x) {\n"
     "    int n = spt_nearest(x * 1.44269502);\n"
     "    // ln 2 in two parts of 15 and 24 bits: the first product is exact\n"
     "    $precise float r = (x - float(n) * 0.693145752) - float(n) * 1.42860677e-6;\n"
     "    $precise float p = 1.38138863e-3;\n"
     "    p = p * r + 8.36906303e-3;\n"
     "    p = p * r + 4.16684225e-2;\n"
     "    p = p * r + 0.166665182;\n"
     "    p = p * r + 0.49999994;\n"
     "    $precise float mantissa = 1.0 + (r + r * r * p);\n"
     "    // 2^(n-1), since 2^128 is no float but 2 * mantissa * 2^127 may be one\n"
     "    float scale = uintBitsToFloat(uint(n + 126) << 23);\n"
     "    $precise float power = (mantissa + mantissa) * scale;\n"
     "    return power;\n"
     "}\n"},
    {"spt_shape_log",
     "// log(x / 2^doublings) for normal positive x = 2^n m, m in [sqrt(1/2), sqrt(2)). With\n"
     "// f = m - 1, s = f/(2 + f), z = s^2: log(m) = f - f^2/2 + s (f^2/2 + z P(z)), P minimax of\n"
     "// degree 2, relative error below 8.2e-10.\n"
     "float spt_shape_log(float x, float doublings) {\n"
     "    uint bits = floatBitsToUint(x) + 0x004afb0du; // 1 less sqrt(1/2), 0x3f3504f3\n"
     "    float n = float(int(bits >> 23) - 127) - doublings;\n"
     "    float f = uintBitsToFloat((bits & 0x007fffffu) + 0x3f3504f3u) - 1.0;\n"
     "    $precise float s = f / (2.0 + f);\n"
     "    $precise float z = s * s;\n"
     "    $precise float tail = z * (0.666667759 + z * (0.399774939 + z * 0.29873082));\n"
     "    $precise float half_square = 0.5 * f * f;\n"
     "    $precise float value = (s * (half_square + tail) + n * 1.42860677e-6) - half_square + f\n"
     "                           + n * 0.693145752;\n"
     "    return value;\n"
     "}\n"},
    {"spt_exp", "// exp(x): relative error below 1.5e-7; zero from -86.5 down.\n"
                "float spt_exp(float x) {\n"
                "    return x > -86.5 ? spt_shape_exp(spt_limit(x, 89.0)) : 0.0;\n"
                "}\n"},
    {"spt_log",
     "// log(x): error below 1 unit in the last place. -infinity for x <= 0.\n"
     "float spt_log(float x) {\n"
     "    bool small = x < 1.17549435e-38; // no normal number\n"
     "    float value = spt_shape_log(x * (small ? 16777216.0 : 1.0), small ? 24.0 : 0.0);\n"
     "    float above_zero = x <= 3.40282347e38 ? value : x; // x: it is infinite\n"
     "    return x > 0.0 ? above_zero : uintBitsToFloat(0xff800000u);\n"
     "}\n"},

    /* ---- Twice the precision, for the builders ----------------------------------------------- */

    {"SptPair",
     "// Three numbers, each the sum of two floats of which the first is the sum rounded (Dekker\n"
     "// 1971): 48 bits in place of the 53 of the double that C has.\n"
     "struct SptPair {\n"
     "    vec3 high;\n"
     "    vec3 low;\n"
     "};\n"},
    {"spt_pair_of_sum", "// a + b with what the rounding lost (Knuth).\n"
                        "SptPair spt_pair_of_sum(vec3 a, vec3 b) {\n"
                        "    $precise vec3 sum = a + b;\n"
                        "    $precise vec3 part = sum - a;\n"
                        "    $precise vec3 lost = (a - (sum - part)) + (b - part);\n"
                        "    return SptPair(sum, lost);\n"
                        "}\n"},
    {"spt_pair_add", "// a + b (Hida, Li and Bailey 2001).\n"
                     "SptPair spt_pair_add(SptPair a, SptPair b) {\n"
                     "    SptPair high = spt_pair_of_sum(a.high, b.high);\n"
                     "    SptPair low = spt_pair_of_sum(a.low, b.low);\n"
                     "    high = spt_pair_of_sum(high.high, high.low + low.high);\n"
                     "    return spt_pair_of_sum(high.high, high.low + low.low);\n"
                     "}\n"},
    {"spt_pair_subtract", "// a - b\n"
                          "SptPair spt_pair_subtract(SptPair a, SptPair b) {\n"
                          "    return spt_pair_add(a, SptPair(-b.high, -b.low));\n"
                          "}\n"},
    {"spt_pair_multiply",
     "// a * b. Each factor is split in halves of 12 bits, whose products are exact (Veltkamp).\n"
     "SptPair spt_pair_multiply(SptPair a, SptPair b) {\n"
     "    $precise vec3 product = a.high * b.high;\n"
     "    $precise vec3 a_scaled = 4097.0 * a.high;\n"
     "    $precise vec3 a_upper = a_scaled - (a_scaled - a.high);\n"
     "    $precise vec3 a_lower = a.high - a_upper;\n"
     "    $precise vec3 b_scaled = 4097.0 * b.high;\n"
     "    $precise vec3 b_upper = b_scaled - (b_scaled - b.high);\n"
     "    $precise vec3 b_lower = b.high - b_upper;\n"
     "    $precise vec3 lost = ((a_upper * b_upper - product) + a_upper * b_lower\n"
     "                          + a_lower * b_upper) + a_lower * b_lower;\n"
     "    $precise vec3 low = lost + (a.high * b.low + a.low * b.high);\n"
     "    return spt_pair_of_sum(product, low);\n"
     "}\n"},
    {"spt_pair_divide", "// a / b: what the quotient of the floats leaves is divided once more.\n"
                        "SptPair spt_pair_divide(SptPair a, SptPair b) {\n"
                        "    vec3 first = a.high / b.high;\n"
                        "    SptPair rest = spt_pair_subtract(\n"
                        "        a, spt_pair_multiply(SptPair(first, vec3(0.0)), b));\n"
                        "    return spt_pair_of_sum(first, rest.high / b.high);\n"
                        "}\n"},
    {"spt_pair_root", "// sqrt(a), by one step of Newton from the root of the float; 0 of 0.\n"
                      "SptPair spt_pair_root(SptPair a) {\n"
                      "    SptPair root = SptPair(sqrt(a.high), vec3(0.0));\n"
                      "    SptPair rest = spt_pair_subtract(a, spt_pair_multiply(root, root));\n"
                      "    vec3 divisor = 2.0 * max(root.high, 1.17549435e-38);\n"
                      "    return spt_pair_of_sum(root.high, rest.high / divisor);\n"
                      "}\n"},
    {"spt_pair_dot", "// a.b in all three components.\n"
                     "SptPair spt_pair_dot(SptPair a, SptPair b) {\n"
                     "    SptPair p = spt_pair_multiply(a, b);\n"
                     "    SptPair sum = spt_pair_add(SptPair(p.high.xxx, p.low.xxx),\n"
                     "                               SptPair(p.high.yyy, p.low.yyy));\n"
                     "    return spt_pair_add(sum, SptPair(p.high.zzz, p.low.zzz));\n"
                     "}\n"},
    {"spt_pair_cross",
     "// The cross product.\n"
     "SptPair spt_pair_cross(SptPair a, SptPair b) {\n"
     "    return spt_pair_subtract(\n"
     "        spt_pair_multiply(SptPair(a.high.yzx, a.low.yzx), SptPair(b.high.zxy, b.low.zxy)),\n"
     "        spt_pair_multiply(SptPair(a.high.zxy, a.low.zxy), SptPair(b.high.yzx, b.low.yzx)));\n"
     "}\n"},
    {"spt_pair_step", "// p z + (high + low): a step of Horner's scheme.\n"
                      "SptPair spt_pair_step(SptPair p, SptPair z, float high, float low) {\n"
                      "    SptPair constant = SptPair(vec3(high), vec3(low));\n"
                      "    return spt_pair_add(spt_pair_multiply(p, z), constant);\n"
                      "}\n"},
    {"spt_pair_sine",
     "// sin(angle - turns pi) for differences in [-pi/2, pi/2]: pi in three floats, then\n"
     "// r + r^3 P(r^2), P minimax of degree 7, the constants in two floats.\n"
     "SptPair spt_pair_sine(float angle, vec3 turns) {\n"
     "    SptPair n = SptPair(turns, vec3(0.0));\n"
     "    SptPair r = SptPair(vec3(angle), vec3(0.0));\n"
     "    r = spt_pair_subtract(r, spt_pair_multiply(n, SptPair(vec3(3.14159274), vec3(0.0))));\n"
     "    r = spt_pair_add(r, spt_pair_multiply(n, SptPair(vec3(8.74227766e-8), vec3(0.0))));\n"
     "    r = spt_pair_add(r, spt_pair_multiply(n, SptPair(vec3(3.43024902e-15), vec3(0.0))));\n"
     "    SptPair z = spt_pair_multiply(r, r);\n"
     "    SptPair p = SptPair(2.7211304e-15 * z.high - 7.64298726e-13, vec3(0.0));\n"
     "    p = spt_pair_step(p, z, 1.60589389e-10, 6.49673154e-18);\n"
     "    p = spt_pair_step(p, z, -2.50521062e-8, -7.02462793e-16);\n"
     "    p = spt_pair_step(p, z, 2.75573188e-6, 3.66476394e-14);\n"
     "    p = spt_pair_step(p, z, -1.98412701e-4, 2.7262049e-12);\n"
     "    p = spt_pair_step(p, z, 8.33333377e-3, -4.34617342e-10);\n"
     "    p = spt_pair_step(p, z, -0.166666672, 4.96705388e-9);\n"
     "    return spt_pair_add(r, spt_pair_multiply(spt_pair_multiply(r, z), p));\n"
     "}\n"},
};

#endif
