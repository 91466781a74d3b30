/* SPDX-License-Identifier: MIT
 *
 * scene_village.h as GLSL. Every house is a call with literals, for the reason that
 * scene_boxes.glsl.h gives. */
#ifndef EXAMPLES_SCENE_VILLAGE_GLSL_H
#define EXAMPLES_SCENE_VILLAGE_GLSL_H

#include "village_houses.h"

#define VILLAGE_BODIES_GLSL \
    "// A point as a house sees it: across and along its ridge by magnitude, and its height.\n" \
    "vec3 village_seen(vec3 p, float x, float z, float cosine, float sine) {\n" \
    "    float from_x = p.x - x;\n" \
    "    float from_z = p.z - z;\n" \
    "    SPT_PRECISE float across = cosine * from_x + sine * from_z;\n" \
    "    SPT_PRECISE float along = cosine * from_z - sine * from_x;\n" \
    "    return vec3(abs(across), p.y, abs(along));\n" \
    "}\n" \
    "\n" \
    "float village_walls(vec3 q, float width, float depth, float height) {\n" \
    "    float sides = spt_intersection(q.x - width, q.z - depth);\n" \
    "    return spt_intersection(sides, abs(q.y - height) - height);\n" \
    "}\n" \
    "\n" \
    "float village_roof(vec3 q, float depth, float height, float ridge) {\n" \
    "    SPT_PRECISE float slope = 0.6 * q.x + 0.8 * (q.y - ridge);\n" \
    "    // without precise, some compilers make one subtraction of two: not of a maximum\n" \
    "    float over_wall = max(q.z - depth, -3.0e38);\n" \
    "    float gable = over_wall - 0.12;\n" \
    "    SPT_PRECISE float eaves = (height + height) - q.y;\n" \
    "    return spt_intersection(spt_intersection(slope, gable), eaves);\n" \
    "}\n"

#define VILLAGE_GLSL_PRELUDE \
    VILLAGE_BODIES_GLSL \
    "\n" \
    "// Its place, turn, half sizes of the walls and height of the ridge.\n" \
    "float house(vec3 p, float x, float z, float cosine, float sine, float width, float depth,\n" \
    "            float height, float ridge) {\n" \
    "    vec3 q = village_seen(p, x, z, cosine, sine);\n" \
    "    float walls = village_walls(q, width, depth, height);\n" \
    "    return spt_union(walls, village_roof(q, depth, height, ridge));\n" \
    "}\n"

#define GLSL_village_ground \
    "spt_intersection(spt_intersection(abs(p.x) - 12.5, abs(p.z) - 12.5), " \
    "abs(p.y + 0.25) - 0.25)"

#define VILLAGE_HOUSE(x, z, cosine, sine, width, depth, height, ridge) \
    "house(p, " #x ", " #z ", " #cosine ", " #sine ", " #width ", " #depth ", " #height \
    ", " #ridge ")"
#define VILLAGE_STEP(...) "    d = spt_union(d, " VILLAGE_HOUSE(__VA_ARGS__) ");\n"
#define GLSL_village \
    "    float d = " GLSL_village_ground ";\n" VILLAGE_HOUSE_LIST(VILLAGE_STEP) "    return d;\n"

#define VILLAGE_HOUSE_PART(...) "    return " VILLAGE_HOUSE(__VA_ARGS__) ";\n",
#define VILLAGE_SEEN(x, z, cosine, sine) "village_seen(p, " #x ", " #z ", " #cosine ", " #sine ")"
#define VILLAGE_WALLS_PART(x, z, cosine, sine, width, depth, height, ridge) \
    "    return village_walls(" VILLAGE_SEEN(x, z, cosine, sine) ", " #width ", " #depth \
                                                                 ", " #height ");\n",
#define VILLAGE_ROOF_PART(x, z, cosine, sine, width, depth, height, ridge) \
    "    return village_roof(" VILLAGE_SEEN(x, z, cosine, sine) ", " #depth ", " #height \
                                                                ", " #ridge ");\n",
#define GLSL_village_house \
    (const char *const[]) { \
        VILLAGE_HOUSE_LIST(VILLAGE_HOUSE_PART) \
    }
#define GLSL_village_walls \
    (const char *const[]) { \
        VILLAGE_HOUSE_LIST(VILLAGE_WALLS_PART) \
    }
#define GLSL_village_roof \
    (const char *const[]) { \
        VILLAGE_HOUSE_LIST(VILLAGE_ROOF_PART) \
    }

#endif
