/* SPDX-License-Identifier: MIT
 *
 * scene_mandelbulb.h as GLSL. */
#ifndef EXAMPLES_SCENE_MANDELBULB_GLSL_H
#define EXAMPLES_SCENE_MANDELBULB_GLSL_H

#define MANDELBULB_GLSL_PRELUDE \
    "// The eighth power without angles, by three complex squarings of (y, r) and of (z, x).\n" \
    "vec3 mandelbulb_power(vec3 q, vec3 p) {\n" \
    "    float xx = q.x * q.x;\n" \
    "    float yy = q.y * q.y;\n" \
    "    float zz = q.z * q.z;\n" \
    "    float xz = q.x * q.z;\n" \
    "    SPT_PRECISE float rr = max(xx + zz, 1.0e-5);\n" \
    "    SPT_PRECISE float even_2 = yy - rr;\n" \
    "    SPT_PRECISE float odd_2 = q.y + q.y;\n" \
    "    SPT_PRECISE float product_2 = even_2 * odd_2;\n" \
    "    SPT_PRECISE float even_4 = even_2 * even_2 - rr * (odd_2 * odd_2);\n" \
    "    SPT_PRECISE float odd_4 = product_2 + product_2;\n" \
    "    SPT_PRECISE float product_4 = even_4 * odd_4;\n" \
    "    SPT_PRECISE float even_8 = even_4 * even_4 - rr * (odd_4 * odd_4);\n" \
    "    SPT_PRECISE float odd_8 = product_4 + product_4;\n" \
    "    SPT_PRECISE float cosine_2 = zz - xx;\n" \
    "    SPT_PRECISE float sine_2 = xz + xz;\n" \
    "    SPT_PRECISE float turn_2 = cosine_2 * sine_2;\n" \
    "    SPT_PRECISE float cosine_4 = cosine_2 * cosine_2 - sine_2 * sine_2;\n" \
    "    SPT_PRECISE float sine_4 = turn_2 + turn_2;\n" \
    "    SPT_PRECISE float turn_4 = cosine_4 * sine_4;\n" \
    "    SPT_PRECISE float cosine_8 = cosine_4 * cosine_4 - sine_4 * sine_4;\n" \
    "    SPT_PRECISE float sine_8 = turn_4 + turn_4;\n" \
    "    SPT_PRECISE float scale = odd_8 / (rr * (rr * rr) * sqrt(rr));\n" \
    "    SPT_PRECISE vec3 next =\n" \
    "        vec3(scale * sine_8 + p.x, even_8 + p.y, scale * cosine_8 + p.z);\n" \
    "    return next;\n" \
    "}\n" \
    "\n" \
    "float mandelbulb_square(vec3 q) {\n" \
    "    SPT_PRECISE float square = q.x * q.x + q.y * q.y + q.z * q.z;\n" \
    "    return square;\n" \
    "}\n"

#define GLSL_mandelbulb \
    "    vec3 q = p;\n" \
    "    float squared = mandelbulb_square(q);\n" \
    "    SPT_PRECISE float derivative = 1.0;\n" \
    "    for (int i = SPT_ZERO; i < 6; ++i) {\n" \
    "        SPT_PRECISE float cubed = squared * (squared * squared);\n" \
    "        if (!(squared <= 256.0)) break;\n" \
    "        derivative = 8.0 * (cubed * sqrt(squared)) * derivative + 1.0;\n" \
    "        q = mandelbulb_power(q, p);\n" \
    "        squared = mandelbulb_square(q);\n" \
    "    }\n" \
    "    SPT_PRECISE float kept = squared + 1.0e-30;\n" \
    "    SPT_PRECISE float d = 0.25 * spt_log(kept) * sqrt(kept) / derivative;\n" \
    "    return d;\n"

#endif
