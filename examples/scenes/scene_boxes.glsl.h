/* SPDX-License-Identifier: MIT
 *
 * scene_boxes.h as GLSL. Every box is a call with literals: in an array its numbers would be copied
 * to the stack at each evaluation by some compilers of shaders, and 25 times as slow. */
#ifndef EXAMPLES_SCENE_BOXES_GLSL_H
#define EXAMPLES_SCENE_BOXES_GLSL_H

#define BOXES_GLSL_PRELUDE \
    "// Of several boxes (square of the least distance from outside, least depth inside).\n" \
    "vec2 boxes_add(vec2 least, vec3 p, vec3 center, vec3 extent) {\n" \
    "    SPT_PRECISE vec3 q = abs(p - center) - extent;\n" \
    "    vec3 off = max(q, 0.0);\n" \
    "    SPT_PRECISE float squared = q.x * off.x + q.y * off.y + q.z * off.z;\n" \
    "    return vec2(min(least.x, squared), min(least.y, max(q.x, max(q.y, q.z))));\n" \
    "}\n"

/* Of none. */
#define BOXES_NONE "vec2(3.40282347e38, 0.0)"
#define BOXES_RETURN "    return sqrt(least.x) + least.y;\n"

#define TOWN_GLSL_PRELUDE \
    BOXES_GLSL_PRELUDE \
    "\n" \
    "float tower_width(int i, int k) {\n" \
    "    return 0.25 + float((i * 7 + k * 5) % 9) / 64.0;\n" \
    "}\n" \
    "\n" \
    "vec2 tower(vec2 least, vec3 p, int i, int k) {\n" \
    "    float height = 0.25 + float((i * 37 + k * 61 + i * k * 13) % 23) / 32.0;\n" \
    "    vec3 extent = vec3(tower_width(i, k), height, tower_width(k, i));\n" \
    "    return boxes_add(least, p, vec3(float(i - 4), height, float(k - 4)), extent);\n" \
    "}\n"

#define TOWN_GROUND(least) "boxes_add(" least ", p, vec3(0.0, -0.25, 0.0), vec3(5.0, 0.25, 5.0))"
#define TOWN_TOWER(least, i, k) "tower(" least ", p, " #i ", " #k ")"
#define TOWN_ROWS(X) \
    TOWN_ROW(X, 0) \
    TOWN_ROW(X, 1) \
    TOWN_ROW(X, 2) \
    TOWN_ROW(X, 3) \
    TOWN_ROW(X, 4) \
    TOWN_ROW(X, 5) \
    TOWN_ROW(X, 6) \
    TOWN_ROW(X, 7) \
    TOWN_ROW(X, 8)
#define TOWN_ROW(X, k) X(0, k) X(1, k) X(2, k) X(3, k) X(4, k) X(5, k) X(6, k) X(7, k) X(8, k)

#define TOWN_STEP(i, k) "    least = " TOWN_TOWER("least", i, k) ";\n"
#define GLSL_village_boxes \
    "    vec2 least = " TOWN_GROUND(BOXES_NONE) ";\n" TOWN_ROWS(TOWN_STEP) BOXES_RETURN

#define TOWN_PART(call) "    vec2 least = " call ";\n" BOXES_RETURN
#define TOWN_TOWER_PART(i, k) TOWN_PART(TOWN_TOWER(BOXES_NONE, i, k)),
#define GLSL_village_boxes_box \
    (const char *const[]) { \
        TOWN_PART(TOWN_GROUND(BOXES_NONE)), TOWN_ROWS(TOWN_TOWER_PART) \
    }

#define SLABS_GLSL_PRELUDE \
    BOXES_GLSL_PRELUDE \
    "\n" \
    "vec2 slab(vec2 least, vec3 p, int i) {\n" \
    "    vec3 center = vec3(0.0, float(i - 6) * 0.1875, 0.0);\n" \
    "    return boxes_add(least, p, center, vec3(1.0, 0.0078125, 0.75));\n" \
    "}\n"

#define SLABS_LIST(X) X(0) X(1) X(2) X(3) X(4) X(5) X(6) X(7) X(8) X(9) X(10) X(11) X(12)
#define SLABS_STEP(i) "    least = slab(least, p, " #i ");\n"
#define GLSL_slabs "    vec2 least = " BOXES_NONE ";\n" SLABS_LIST(SLABS_STEP) BOXES_RETURN
#define SLABS_PART(i) "    vec2 least = slab(" BOXES_NONE ", p, " #i ");\n" BOXES_RETURN,
#define GLSL_slabs_slab \
    (const char *const[]) { \
        SLABS_LIST(SLABS_PART) \
    }

#endif
