/* SPDX-License-Identifier: MIT
 *
 * scene_city.h as GLSL. */
#ifndef EXAMPLES_SCENE_CITY_GLSL_H
#define EXAMPLES_SCENE_CITY_GLSL_H

#define CITY_GLSL_PRELUDE \
    "uint city_hash(int column, int row) {\n" \
    "    uint hash = uint(column) * 0x9e3779b1u + uint(row) * 0x85ebca77u;\n" \
    "    hash ^= hash >> 15;\n" \
    "    hash *= 0x2c1b3c6du;\n" \
    "    hash ^= hash >> 13;\n" \
    "    hash *= 0x297a2d39u;\n" \
    "    return hash ^ (hash >> 16);\n" \
    "}\n" \
    "\n" \
    "// A tower on its shoulders, seen from the middle of its foot; its size is drawn from " \
    "hash.\n" \
    "float city_tower(uint hash, vec3 q) {\n" \
    "    float r = float(hash & 15u) / 16.0;\n" \
    "    float squared = r * r;\n" \
    "    SPT_PRECISE float height = 0.625 + 2.0 * r + 7.0 * (squared * squared);\n" \
    "    SPT_PRECISE float narrow = height * (0.5 + 0.5 * (float((hash >> 4) & 7u) / 8.0));\n" \
    "    SPT_PRECISE float x = q.x - (1.375 - 0.5 * (float((hash >> 8) & 15u) / 16.0));\n" \
    "    SPT_PRECISE float z = q.z - (1.375 - 0.5 * (float((hash >> 12) & 15u) / 16.0));\n" \
    "    SPT_PRECISE float y = q.y - narrow;\n" \
    "    SPT_PRECISE float top = q.y - height;\n" \
    "    float foot = max(x, z);\n" \
    "    float shaft = foot + 0.25;\n" \
    "    vec3 off_foot = max(vec3(x, y, z), 0.0);\n" \
    "    vec3 off_shaft = max(vec3(x + 0.25, top, z + 0.25), 0.0);\n" \
    "    SPT_PRECISE float foot_squared = off_foot.x * off_foot.x +\n" \
    "        off_foot.y * off_foot.y + off_foot.z * off_foot.z;\n" \
    "    SPT_PRECISE float shaft_squared = off_shaft.x * off_shaft.x +\n" \
    "        off_shaft.y * off_shaft.y + off_shaft.z * off_shaft.z;\n" \
    "    float depth = min(max(foot, y), max(shaft, top));\n" \
    "    return sqrt(min(foot_squared, shaft_squared)) + min(depth, 0.0);\n" \
    "}\n"

#define GLSL_city \
    "    int column = spt_nearest(spt_limit(p.x / 4.0, 4194304.0));\n" \
    "    int row = spt_nearest(spt_limit(p.z / 4.0, 4194304.0));\n" \
    "    SPT_PRECISE float seen_x = p.x - 4.0 * float(column);\n" \
    "    SPT_PRECISE float seen_z = p.z - 4.0 * float(row);\n" \
    "    float x = abs(seen_x);\n" \
    "    float z = abs(seen_z);\n" \
    "    // the least way to another tower: over the border of the cell and a kerb\n" \
    "    float street = min(abs(2.0 - x), abs(2.0 - z)) + 0.625;\n" \
    "    float own = city_tower(city_hash(column, row), vec3(x, p.y, z));\n" \
    "    float towers = max(spt_union(own, street), p.y - 8.0);\n" \
    "    return spt_union(towers, p.y);\n"

#endif
