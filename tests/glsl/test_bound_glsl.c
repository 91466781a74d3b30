/* SPDX-License-Identifier: MIT
 *
 * Bounding volumes in shaders: where rays are in them, against spt_bound_interval(), bit by bit. */
#include "glsl_check.h"

#include <spheretrace/bound.h>

#include <math.h>
#include <string.h>

#include "../../src/bound/bound.glsl.h"
#include "../../src/bound/bound_check.h"
#include "../../src/glsl/writer.h"

enum { bounds_a_kind = 12, rays_a_bound = 1200, rays = bounds_a_kind * rays_a_bound, planes = 7 };

/* A volume, and where rays are to be sent to see all of it. */
typedef struct place {
    spt_bound bound;
    spt_bound_plane plane[planes];
    float middle[3], arm;
} place;

static place places[bounds_a_kind];

/* ---- Volumes -------------------------------------------------------------------------------- */

static float power_of_ten(double low, double high) {
    return (float)pow(10.0, check_uniform(low, high));
}

static float within(float arm) {
    return arm * (float)check_uniform(-1, 1);
}

static void random_unit(float unit[3]) {
    double v[3], square = 0;
    for (int i = 0; i < 3; ++i) {
        v[i] = check_uniform(-1, 1);
        square += v[i] * v[i];
    }
    for (int i = 0; i < 3; ++i) unit[i] = (float)(v[i] / sqrt(square));
}

/* A rotation, from a random quaternion. */
static void random_axes(float axis[3][3]) {
    double q[4], square = 0;
    for (int i = 0; i < 4; ++i) {
        q[i] = check_uniform(-1, 1);
        square += q[i] * q[i];
    }
    for (int i = 0; i < 4; ++i) q[i] /= sqrt(square);
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        axis[i][i] = (float)(1 - 2 * (q[j] * q[j] + q[k] * q[k]));
        axis[i][j] = (float)(2 * (q[i] * q[j] - q[k] * q[3]));
        axis[i][k] = (float)(2 * (q[i] * q[k] + q[j] * q[3]));
    }
}

/* Axes that are those of the coordinates, every third time. */
static void some_axes(int number, float axis[3][3]) {
    random_axes(axis);
    for (int i = 0; number % 3 == 0 && i < 9; ++i)
        axis[i / 3][i % 3] = i / 3 == i % 3 ? 1.0f : 0.0f;
}

static void set_box(place *at, int some) {
    for (int axis = 0; axis < 3; ++axis) {
        if (!some || check_random() % 2 == 0) {
            at->bound.low[axis] = at->middle[axis] - at->arm * (float)check_uniform(0.1, 1);
        }
        if (!some || check_random() % 2 == 0) {
            at->bound.high[axis] = at->middle[axis] + at->arm * (float)check_uniform(0.1, 1);
        }
    }
}

static void make_planes(place *at, int number) {
    const int slab = at->bound.kind == SPT_BOUND_SLAB;
    for (int i = 0; i < planes; ++i) {
        float *const normal = at->plane[i].normal;
        double along = 0;
        random_unit(normal);
        /* Of any length, and along an axis. */
        const float length = number % 4 == 0 ? power_of_ten(-9, 9) : 1.0f;
        for (int axis = 0; axis < 3; ++axis) {
            if (number % 3 == 0) normal[axis] = axis == i % 3 ? (i < 3 ? 1.0f : -1.0f) : 0.0f;
            normal[axis] *= length;
            along += (double)normal[axis] * (double)at->middle[axis];
        }
        at->plane[i].offset = (float)(along + (double)length * (double)at->arm);
        for (int axis = 0; slab && axis < 3; ++axis) at->bound.axis[0][axis] = normal[axis];
        at->bound.range[0] = (float)(along - 0.5 * (double)length * (double)at->arm);
        at->bound.range[1] = at->plane[i].offset;
    }
    at->bound.planes = at->plane;
    at->bound.plane_count = planes;
    if (number % 2 == 1) set_box(at, number % 4 == 1);
}

static void make_place(place *at, uint32_t kind, int number) {
    float axis[3][3], half[3], end[3];
    const float far = number % 4 == 3 ? power_of_ten(6, 12) : power_of_ten(-2, 4);
    at->arm = power_of_ten(-2, 3);
    if (at->arm < 1e-5f * far) at->arm = 1e-5f * far; /* or it has no size */
    some_axes(number, axis);
    for (int i = 0; i < 3; ++i) {
        at->middle[i] = within(far);
        half[i] = at->arm * (float)check_uniform(0.05, 1);
        end[i] = at->middle[i] + at->arm * (number % 3 == 0 ? (float)(i == number % 2) : within(1));
    }
    at->bound = spt_bound_sphere(at->middle[0], at->middle[1], at->middle[2], at->arm);
    if (kind == SPT_BOUND_BOX) {
        at->bound = spt_bound_of_kind(SPT_BOUND_BOX);
        set_box(at, 0);
        if (number % 4 == 0) at->bound.high[1] = at->bound.low[1];
    } else if (kind == SPT_BOUND_ORIENTED_BOX) {
        at->bound = spt_bound_oriented_box(at->middle, axis, half);
    } else if (kind == SPT_BOUND_ELLIPSOID) {
        at->bound = spt_bound_ellipsoid(at->middle, axis, half);
    } else if (kind == SPT_BOUND_CAPSULE) {
        at->bound = spt_bound_capsule(at->middle, number % 5 == 4 ? at->middle : end, half[0]);
    } else if (kind == SPT_BOUND_CYLINDER) {
        at->bound = spt_bound_cylinder(at->middle, end, half[0]);
    } else if (kind == SPT_BOUND_SLAB || kind == SPT_BOUND_POLYTOPE) {
        at->bound = spt_bound_of_kind((spt_bound_kind)kind);
        make_planes(at, number);
    }
}

/* ---- Rays ----------------------------------------------------------------------------------- */

/* A ray of every sort towards a volume: origin, t_min, direction, t_max. */
static void make_ray(const place *at, int number, float ray[8]) {
    float unit[3], low[3], high[3], *const origin = ray, *const direction = ray + 4;
    const int sort = number % 11, axis = number / 11 % 3, other = (axis + 1) % 3;
    spt_bound_extent(&at->bound, low, high);
    random_unit(unit);
    for (int i = 0; i < 3; ++i) {
        const float reach = sort == 3 ? 0.3f : sort == 9 ? 0.0f : 1.5f;
        origin[i] = at->middle[i] + within(at->arm * reach);
        /* Every second one is aimed at it. */
        direction[i] = number % 2 == 0 ? unit[i] : at->middle[i] - origin[i] + within(at->arm) / 4;
    }
    switch (sort) {
    case 1: /* along an axis of the coordinates, */
        for (int i = 0; i < 3; ++i) direction[i] = i == axis ? copysignf(1, unit[i]) : 0.0f;
        break;
    case 2: /* in a plane of two of them, */
        direction[axis] = copysignf(0, unit[axis]);
        break;
    case 4: /* on a face of the box around it, */
    case 5: /* and in that face, too, */
        origin[axis] = unit[axis] < 0 ? low[axis] : high[axis];
        if (!(fabsf(origin[axis]) < 1e18f)) origin[axis] = at->middle[axis];
        if (sort == 5) direction[axis] = 0.0f;
        if (number % 2 == 0) direction[other] = 0.0f;
        break;
    case 6: { /* from afar, */
        const float far = power_of_ten(2, 17);
        for (int i = 0; i < 3; ++i) {
            origin[i] -= far * unit[i];
            direction[i] = unit[i];
        }
        break;
    }
    case 7: { /* with a direction of any length, */
        const float length = power_of_ten(-8, 8);
        for (int i = 0; i < 3; ++i) direction[i] *= length;
        break;
    }
    case 8: /* along its own axis, */
    case 9: /* from its middle, */
        for (int i = 0; i < 3; ++i) {
            const int tube =
                at->bound.kind == SPT_BOUND_CAPSULE || at->bound.kind == SPT_BOUND_CYLINDER;
            direction[i] = tube ? at->bound.end[i] - at->bound.center[i] : at->bound.axis[axis][i];
        }
        if (!(fabsf(direction[0]) + fabsf(direction[1]) + fabsf(direction[2]) > 0))
            direction[0] = 1;
        break;
    case 10: /* and touching the ball in it. */
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3, k = (i + 2) % 3;
            direction[i] = unit[j] - unit[k]; /* at right angles to (1, 1, 1): */
            origin[i] = at->middle[i] + at->arm * 0.577350269f - 3 * at->arm * direction[i];
        }
        break;
    default:
        break;
    }
    ray[3] = number % 5 == 0 ? at->arm * (float)check_uniform(0, 3) : 0.0f;
    ray[7] = number % 7 == 0 ? at->arm * (float)check_uniform(0, 3) : 1e18f;
}

/* ---- Comparing ------------------------------------------------------------------------------ */

/* The pieces, the functions of all places, and one that chooses among them. */
static int write_functions(char *text, size_t capacity) {
    spt_glsl_options options = spt_glsl_options_default();
    spti_glsl out;
    options.target = SPT_GLSL_COMPUTE_450;
    memset(&out, 0, sizeof out);
    out.options = &options;
    out.buffer = text;
    out.capacity = capacity;
    for (size_t i = 0; i < sizeof spti_glsl_bound / sizeof *spti_glsl_bound; ++i) {
        spti_glsl_expand(&out, spti_glsl_bound[i].text, NULL);
    }
    for (int i = 0; i < bounds_a_kind; ++i) {
        spt_bound copy;
        if (!spti_bound_copy(&copy, &places[i].bound)) return 0;
        spti_glsl_clip(&out, i, &copy);
    }
    spti_glsl_put(&out,
                  "vec2 clip(int i, vec3 o, vec3 d, float span, float reach, vec2 range) {\n");
    for (int i = 0; i < bounds_a_kind; ++i) {
        spti_glsl_format(&out, "    if (i == %d) return spt_clip_%d(o, d, span, reach, range);\n",
                         i, i);
    }
    spti_glsl_put(&out, "    return range;\n}\n");
    if (out.status != SPT_OK || out.length >= capacity) return 0;
    text[out.length] = '\0';
    return 1;
}

/* Signs of zero may differ: 0 is the same t. */
static int same(float a, float b) {
    return check_same_bits(a, b) || (a >= 0 && a <= 0 && b >= 0 && b <= 0);
}

static void check_kind(uint32_t kind) {
    static const char statements[] =
        "    vec3 o = q[0].xyz, d = q[1].xyz;\n"
        "    precise float span = sqrt((d.x * d.x + d.y * d.y) + d.z * d.z);\n"
        "    float reach = max(max(abs(o.x), abs(o.y)), abs(o.z));\n"
        "    r[0].xy = clip(int(q[2].x), o, d, span, reach, vec2(q[0].w, q[1].w));\n"
        "    r[0].zw = vec2(0.0);\n";
    static char text[1 << 17];
    static float in[rays][12], out[rays][4];
    int inside = 0, cut = 0;
    check_context("bound of kind %u", kind);
    for (int i = 0; i < bounds_a_kind; ++i) {
        make_place(&places[i], kind, i);
        for (int j = 0; j < rays_a_bound; ++j) {
            float *const ray = in[i * rays_a_bound + j];
            make_ray(&places[i], j, ray);
            ray[8] = (float)i;
        }
    }
    CHECK(write_functions(text, sizeof text));
    CHECK(engine_values(text, statements, rays, 3, in[0], 1, out[0]) == ENGINE_OK);
    for (int i = 0; i < rays; ++i) {
        const float *const ray = in[i];
        float from, to;
        CHECK(spt_bound_interval(&places[(int)ray[8]].bound, ray, ray + 4, ray[3], ray[7], &from,
                                 &to) == SPT_OK);
        const int is_in = from <= to;
        CHECK_SAY(
            is_in == (out[i][0] <= out[i][1]) &&
                (!is_in || (same(from, out[i][0]) && same(to, out[i][1]))),
            "volume %d, ray %d from %.9g %.9g %.9g along %.9g %.9g %.9g: C %.9g to %.9g, GLSL "
            "%.9g to %.9g",
            (int)ray[8], i % rays_a_bound % 11, (double)ray[0], (double)ray[1], (double)ray[2],
            (double)ray[4], (double)ray[5], (double)ray[6], (double)from, (double)to,
            (double)out[i][0], (double)out[i][1]);
        inside += is_in;
        cut += is_in && (from > ray[3] || to < ray[7]);
    }
    /* There is something to compare: rays that miss, and intervals that are not the ray's own. */
    CHECK_SAY(rays - inside > rays / 10, "%d of %d are inside", inside, rays);
    CHECK_SAY(cut > rays / 4, "%d of %d are cut", cut, rays);
}

static void B1_sphere(void) {
    check_kind(SPT_BOUND_SPHERE);
}

static void B1_box(void) {
    check_kind(SPT_BOUND_BOX);
}

static void B1_oriented_box(void) {
    check_kind(SPT_BOUND_ORIENTED_BOX);
}

static void B1_capsule(void) {
    check_kind(SPT_BOUND_CAPSULE);
}

static void B1_cylinder(void) {
    check_kind(SPT_BOUND_CYLINDER);
}

static void B1_ellipsoid(void) {
    check_kind(SPT_BOUND_ELLIPSOID);
}

static void B1_slab(void) {
    check_kind(SPT_BOUND_SLAB);
}

static void B1_polytope(void) {
    check_kind(SPT_BOUND_POLYTOPE);
}

void suite_bound_glsl(void) {
    if (!engine_here(engine_gl_open(), "EGL")) return;
    RUN(B1_sphere);
    RUN(B1_box);
    RUN(B1_oriented_box);
    RUN(B1_capsule);
    RUN(B1_cylinder);
    RUN(B1_ellipsoid);
    RUN(B1_slab);
    RUN(B1_polytope);
}
