/* SPDX-License-Identifier: MIT
 *
 * scene_dodecahedron.h as GLSL, and scene_glass.h, the same turned. The six heights in two vectors:
 * those over normals (short, long, 0) and over (short, -long, 0), each with its two rotations. */
#ifndef EXAMPLES_SCENE_DODECAHEDRON_GLSL_H
#define EXAMPLES_SCENE_DODECAHEDRON_GLSL_H

#define DODECAHEDRON_GLSL_PRELUDE \
    "// Over the faces of a regular dodecahedron.\n" \
    "void dodecahedron_heights(vec3 p, out vec3 sums, out vec3 differences) {\n" \
    "    SPT_PRECISE vec3 added = 0.525731112 * p + 0.850650808 * p.yzx;\n" \
    "    SPT_PRECISE vec3 subtracted = 0.525731112 * p - 0.850650808 * p.yzx;\n" \
    "    sums = abs(added);\n" \
    "    differences = abs(subtracted);\n" \
    "}\n" \
    "\n" \
    "float dodecahedron_greatest(vec3 sums, vec3 differences) {\n" \
    "    vec3 greater = max(sums, differences);\n" \
    "    return max(max(greater.x, greater.y), greater.z);\n" \
    "}\n"

#define DODECAHEDRON_P32_GLSL_PRELUDE \
    DODECAHEDRON_GLSL_PRELUDE \
    "\n" \
    "vec3 dodecahedron_power_32(vec3 a) {\n" \
    "    vec3 a2 = a * a;\n" \
    "    SPT_PRECISE vec3 a4 = a2 * a2;\n" \
    "    SPT_PRECISE vec3 a8 = a4 * a4 + 1.0e-9;\n" \
    "    SPT_PRECISE vec3 a16 = a8 * a8;\n" \
    "    return a16 * a16;\n" \
    "}\n" \
    "\n" \
    "// Generalised distance with exponent 32 (Akleman & Chen 1999).\n" \
    "float dodecahedron_p32(vec3 p) {\n" \
    "    vec3 sums, differences;\n" \
    "    dodecahedron_heights(p, sums, differences);\n" \
    "    float greatest = dodecahedron_greatest(sums, differences) + 1.17549435e-38;\n" \
    "    float inverse = 1.0 / greatest;\n" \
    "    SPT_PRECISE vec3 pairs = dodecahedron_power_32(sums * inverse) +\n" \
    "                             dodecahedron_power_32(differences * inverse);\n" \
    "    SPT_PRECISE float sum = pairs.x + pairs.y + pairs.z;\n" \
    "    float root_8 = sqrt(sqrt(sqrt(sum)));\n" \
    "    SPT_PRECISE float d = greatest * sqrt(sqrt(root_8)) - 1.0;\n" \
    "    return d;\n" \
    "}\n"

#define GLSL_dodecahedron \
    "    vec3 sums, differences;\n" \
    "    dodecahedron_heights(p, sums, differences);\n" \
    "    return dodecahedron_greatest(sums, differences) - 1.0;\n"

#define GLSL_dodecahedron_p32 "    return dodecahedron_p32(p);\n"

#define GLSL_glass \
    "    SPT_PRECISE vec3 q = vec3(0.850650808 * p.x + 0.525731112 * p.y,\n" \
    "                              0.850650808 * p.y - 0.525731112 * p.x, p.z);\n" \
    "    return dodecahedron_p32(q);\n"

#endif
