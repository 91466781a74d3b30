/* SPDX-License-Identifier: MIT
 *
 * scene_arches.h as GLSL. The arcs are what spt_arc_of() makes of those there, written out, so that
 * no compiler of shaders has to build them. */
#ifndef EXAMPLES_SCENE_ARCHES_GLSL_H
#define EXAMPLES_SCENE_ARCHES_GLSL_H

/* The parts of a bay, which q.x >= 0 sees. */
#define ARCHES_BODIES_GLSL \
    "float arches_ring(vec3 q) {\n" \
    "    return spt_capped_torus(vec3(q.x, q.z, q.y - 1.6), 1.0, 0.0, 1.4, 0.16);\n" \
    "}\n" \
    "\n" \
    "float arches_pillar(vec3 q) {\n" \
    "    return spt_capsule(q, vec3(1.4, 0.0, 0.0), vec3(1.4, 1.6, 0.0), 0.16);\n" \
    "}\n" \
    "\n" \
    "float arches_foot(vec3 q) {\n" \
    "    return spt_rounded_box(q - vec3(1.4, 0.12, 0.0), vec3(0.3, 0.12, 0.3), 0.05);\n" \
    "}\n" \
    "\n" \
    "float arches_stone(vec3 q) {\n" \
    "    return spt_rounded_box(q - vec3(3.1, 0.2, 0.0), vec3(0.28, 0.2, 0.24), 0.05);\n" \
    "}\n" \
    "\n" \
    "// From (1.3, 1, 0) through (0.8, 1.55, 0) to (0, 2.3, 0).\n" \
    "float arches_brace(vec3 q) {\n" \
    "    return spt_toroidal_capsule(q, SptArc(\n" \
    "        vec3(0.6759585, 1.6759585, 0.0), vec3(0.70710677, 0.70710677, -0.0),\n" \
    "        vec3(-0.70710677, 0.70710677, 0.0), vec3(-0.0, -0.0, -1.0),\n" \
    "        0.086751394, 0.9192388, 0.99681526, 0.036710918, 0.07));\n" \
    "}\n" \
    "\n" \
    "// From (3.1, 0, 0) through (2.65, 1.35, 0) to (1.4, 2.1, 0).\n" \
    "float arches_buttress(vec3 q) {\n" \
    "    return spt_toroidal_capsule(q, SptArc(\n" \
    "        vec3(2.6384203, 1.3644356, 0.0), vec3(0.77724487, 0.62919825, -0.0),\n" \
    "        vec3(-0.62919825, 0.77724487, 0.0), vec3(-0.0, -0.0, -1.0),\n" \
    "        0.48173755, 1.3509256, 0.7592564, 0.49974006, 0.12));\n" \
    "}\n"

#define ARCHES_GLSL_PRELUDE \
    ARCHES_BODIES_GLSL \
    "\n" \
    "float arches_bay(vec3 p) {\n" \
    "    vec3 q = vec3(abs(p.x), p.y, p.z);\n" \
    "    float straight = spt_union(arches_ring(q), arches_pillar(q));\n" \
    "    float d = spt_union(straight, spt_union(arches_foot(q), arches_stone(q)));\n" \
    "    d = spt_union(d, arches_brace(q));\n" \
    "    return spt_union(d, arches_buttress(q));\n" \
    "}\n"

#define GLSL_arches_ridge "spt_capsule(p, vec3(0.0, 3.0, -3.6), vec3(0.0, 3.0, 1.2), 0.1)"
#define GLSL_arches_ground "p.y"
#define GLSL_arches \
    "    float z = abs(p.z + 1.2);\n" \
    "    float bay = arches_bay(vec3(p.x, p.y, min(z, abs(z - 2.0))));\n" \
    "    float ridge = " GLSL_arches_ridge ";\n" \
    "    return spt_union(spt_union(bay, ridge), p.y);\n"

#define ARCHES_PART_PRELUDE \
    ARCHES_BODIES_GLSL \
    "\n" \
    "// A point as a part at this side of this bay sees it.\n" \
    "vec3 arches_seen(vec3 p, float side, float bay) {\n" \
    "    // without precise, some compilers make one addition of two: not of a maximum\n" \
    "    float z = max(p.z + 1.2, -3.0e38);\n" \
    "    return vec3(side * p.x, p.y, abs(z - 2.0 * bay));\n" \
    "}\n" \
    "\n" \
    "// As one that both sides are folded to sees it.\n" \
    "vec3 arches_folded(vec3 p, float side, float bay) {\n" \
    "    vec3 q = arches_seen(p, side, bay);\n" \
    "    return vec3(abs(q.x), q.y, q.z);\n" \
    "}\n"

/* For the entries of arches_places. */
#define ARCHES_PART(part, seen, side, bay) \
    "    return arches_" part "(arches_" seen "(p, " side ", " bay "));\n"
#define ARCHES_BAY_PARTS(part, seen, side) \
    ARCHES_PART(part, seen, side, "-1.0"), ARCHES_PART(part, seen, side, "0.0"), \
        ARCHES_PART(part, seen, side, "1.0")
#define ARCHES_FOLDED_PARTS(part) \
    (const char *const[]) { \
        ARCHES_BAY_PARTS(part, "folded", "1.0") \
    }
#define ARCHES_SIDE_PARTS(part) \
    (const char *const[]) { \
        ARCHES_BAY_PARTS(part, "seen", "1.0"), ARCHES_BAY_PARTS(part, "seen", "-1.0") \
    }
#define GLSL_arches_ring ARCHES_FOLDED_PARTS("ring")
#define GLSL_arches_pillar ARCHES_SIDE_PARTS("pillar")
#define GLSL_arches_foot ARCHES_SIDE_PARTS("foot")
#define GLSL_arches_stone ARCHES_SIDE_PARTS("stone")
#define GLSL_arches_brace ARCHES_FOLDED_PARTS("brace")
#define GLSL_arches_buttress ARCHES_FOLDED_PARTS("buttress")

#endif
