/* SPDX-License-Identifier: MIT
 *
 * The same algorithms for GPUs: writes GLSL for fields, scenes and models, holding only what the
 * scene and the settings need. Left out: compiling and running it, which is the host's.
 *
 * WHAT IS WRITTEN is text that a person can read and change: functions with the names of this
 * library, indented and commented with where they come from. All identifiers begin with spt_, Spt_,
 * Spt or SPT_, but for the names of uniforms (below) and what a caller's own text brings. The same
 * arguments give the same bytes, in every locale.
 *
 *     struct SptRay { vec3 origin; float t_min; vec3 direction; float t_max; float path; };
 *     struct SptHit { float t, residual; int outcome, evaluations; ... };
 *     float  spt_map(vec3 p)                     the field
 *     SptHit spt_trace(SptRay ray, int budget)   spt_trace() of trace.h for one ray
 *
 * and what SPT_GLSL_NORMAL and so on ask for. Of a scene the functions that concern one component
 * take its number first: spt_map(int component, vec3 p).
 *
 * SAME BITS. Where a target has `precise`, or an output that can be `invariant`, and the field is
 * made of + - * / sqrt abs min max, then t, residual, outcome and evaluations are those of the C
 * library, bit for bit, on an implementation of GLSL that rounds division and square root correctly
 * (Mesa's llvmpipe and lavapipe and SwiftShader do). GLSL allows 2.5 units in the last place for
 * division, and contraction in targets without either; there they agree to about 2e-6. Where they
 * differ on purpose:
 *   infinity     has no literal in GLSL: 3.0e38 stands for it (t and residual of a miss). Origins
 *                and t_max count up to 1e18 of world length, and rays without end take other
 *                numbers of evaluations
 *   scenes       are traced component by component, not in the order of spt_scene_trace(): t,
 *                residual, outcome and component are the same, but evaluations and fallbacks are
 *                sums, flags those of all, and a budget counts for each component. The candidate
 *                is that of the component that is hit, for a miss the least of all
 *   subnormal numbers  may be zero on a GPU, and constants below FLT_MIN are written as 0.0
 *   odd rays and fields  NaN, rays that are bad, fields that are no distance bounds, and directions
 *                whose length is not from 1e-18 to 1e18, need SPT_GLSL_GUARDS (which spt_trace()
 *                always has): without it such a ray ends somewhere, within its budget
 *
 * SOURCE of what is written: that of the functions it mirrors, named in the text. */
#ifndef SPHERETRACE_GLSL_H
#define SPHERETRACE_GLSL_H

#include "base.h"
#include "field.h"
#include "frame.h"
#include "scene.h"
#include "trace.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- The caller's own fields --------------------------------------------------------------- */

/* A field with a callback brings its text in spt_field.glsl: the body of float NAME(vec3 p), in
 * GLSL as all targets have it (3.30 core and 3.00 es), with `return`. It may call the functions of
 * shapes.h by their names, with vec3 for spt_point and float for spt_real:
 *     field.glsl = "return spt_smooth_union(spt_sphere(p, 1.0), spt_box(p, vec3(0.8)), 0.1);"
 * and functions of its own from spt_field.glsl_prelude, which are written before it, once for all
 * fields whose prelude is equal. Names of its own must differ over all preludes, and not begin with
 * spt, Spt, SPT or gl_. For loops that no compiler is to unroll SPT_ZERO is 0, and spt_time (or
 * what names calls it) is the time: in Shadertoy iTime, else 0 unless options.uniforms asks for it
 * (in a library it is then the host's). For bits equal to the callback's write
 * `SPT_PRECISE float d = ...; return d;` with every sum and product in the callback's order.
 * Refused with SPT_BAD_ARGUMENT: an empty text, one with a byte that is not printable ASCII, a tab
 * or a newline, with # or a backslash or a quote, with brackets or comments that are not closed, or
 * brackets nested deeper than 256, or longer than 2^20. What else is wrong with it the compiler of
 * the host tells, with the text's own line numbers (but in libraries): body i is source string
 * 2 i + 1, its prelude 2 i + 2.
 * Without text a field is written if it came from spt_krs_field(), spt_moekrs_field(),
 * spt_conformal_field(), spt_distorted_field() or spt_level_set_field(), and its kernels or inner
 * fields can be written; else the answer is SPT_UNSUPPORTED. The number of fields, with inner ones,
 * is at most SPT_GLSL_FIELDS, and they are nested at most SPT_GLSL_DEPTH deep. */
#define SPT_GLSL_FIELDS 256
#define SPT_GLSL_DEPTH 8

/* Places at which a field's callback and its text can be compared, and what the callback answers
 * there: half of them at random in the field's bound (in [-1, 1]^3 without one of finite extent),
 * half moved from such ones towards the surface, where differences matter. Run a program of
 * SPT_GLSL_POINTS on them and compare: it finds a disagreement that a trace would hide.
 *   samples    1 to 2^20
 *   seed       equal seeds, equal points
 *   points     receives 4 * samples floats: x, y, z and the distance that the callback answers
 * Returns SPT_BAD_ARGUMENT for a bad field, a NULL pointer or samples out of range; nothing is
 * written then. */
SPT_API spt_status spt_glsl_check_field(const spt_field *field, uint32_t samples, uint32_t seed,
                                        float *points);

/* ---- What is written ----------------------------------------------------------------------- */

typedef enum spt_glsl_target {
    /* Functions only: no version, main, uniform or global, for hosts that bring these (three.js,
     * engines), once a shader; several fields are a scene. What others call can be replaced: who
     * defines SPT_OWN_MAP brings spt_map() before, SPT_OWN_RAY and SPT_OWN_HIT the structures, and
     * so on for every function. The settings are macros that can be defined before, too; what the
     * numbers of the options below are to a program, arguments are here. */
    SPT_GLSL_LIBRARY = 0,
    SPT_GLSL_FRAGMENT_330 = 1,    /* desktop OpenGL 3.3 core */
    SPT_GLSL_FRAGMENT_300_ES = 2, /* WebGL 2, OpenGL ES 3.0 */
    SPT_GLSL_SHADERTOY = 3,       /* mainImage(), with that site's own uniforms */
    SPT_GLSL_COMPUTE_310_ES = 4,  /* OpenGL ES 3.1 with GL_EXT_gpu_shader5, for `precise` */
    SPT_GLSL_COMPUTE_430 = 5,     /* OpenGL 4.3 */
    SPT_GLSL_COMPUTE_450 = 6,     /* OpenGL 4.5 */
    SPT_GLSL_VULKAN_450 = 7       /* Vulkan: compute, buffers in set 0, push constants */
} spt_glsl_target;
#define SPT_GLSL_TARGETS 8

/* What main() does. Not used with SPT_GLSL_LIBRARY. Shadertoy has pictures only, compute targets
 * have no pictures; the rest is SPT_UNSUPPORTED.
 *   PICTURE  rays of the camera, colours. `view` chooses what is shown: 0 the scene in the light,
 *            1 evaluations over the budget as a heat map, 2 the residual over the tolerance (log
 *            scale), 3 outcomes, 4 normals, 5 components
 *   HITS     rays in, hits out.
 *   POINTS   points in, distances of the first field out (or of field_number)
 *   CONES    rays of the camera, t out: the low-resolution pass (Bálint & Valasek 2018, section 4).
 *            Each pixel of it answers for the block of the full picture that it covers; a PICTURE
 *            or HITS program with SPT_GLSL_STARTS reads the result and begins its rays there
 *
 * WHERE RAYS, POINTS AND HITS ARE, numbers counted from 0 in the order given:
 *   compute, Vulkan  std430 buffers. Binding 0: vec4[], a ray is (origin, t_min), (direction,
 *                    t_max), and with SPT_GLSL_PATH (path, 0, 0, 0); a point is (x, y, z, any).
 *                    Binding 1: vec4[], a hit is (t, residual, evaluations, outcome), and then,
 *                    each only where one of its members was asked for, (component, flags,
 *                    candidate_t, candidate_ratio) and (normal, fallbacks); of a point (distance,
 *                                 0, 0, 0).
 *                    Local size 8x8; ray x + y * size.x for x < size.x, y < size.y. Vulkan: set 0,
 *                    and one block of push constants: size, budget, and what options.uniforms asks
 *                    for and the program may use, in the order of spt_glsl_name
 *   fragment         rays and points in textures RGBA32F of the size of the viewport, read by
 *                    texelFetch (ray_origin: (origin, t_min); ray_direction: (direction, t_max);
 *                    ray_path: (path, ...)); hits in as many RGBA32F attachments as above
 *   CONES            as the first number of a vec4, rows of blocks from the bottom in a fragment
 *                    program, from the top in a buffer; STARTS reads a texture of any format that
 *                    has it first (R32F), counted as gl_FragCoord or the invocation counts pixels
 * Counts, outcomes, flags and numbers of components are written as floats. */
typedef enum spt_glsl_program {
    SPT_GLSL_PICTURE = 0,
    SPT_GLSL_HITS = 1,
    SPT_GLSL_POINTS = 2,
    SPT_GLSL_CONES = 3
} spt_glsl_program;
#define SPT_GLSL_PROGRAMS 4

/* What beside t, residual, outcome and evaluations is wanted. What is not asked for leaves nothing
 * behind. In a program the results appear where the comment above says; a library gets the
 * function. Which program has which:
 *   library   all but STARTS and DEPTH_WRITE
 *   HITS      all but OFFSET, SHADOW, OCCLUSION, DEPTH_WRITE
 *   PICTURE   all but FALLBACKS, OFFSET, PLACE
 *   POINTS    ARRAYS, MERGED
 *   CONES     GUARDS, ARRAYS, MERGED
 * Others are SPT_UNSUPPORTED, and so are: CONVEX with BINARY; CONVEX, BINARY and PLACE with a
 * scene; SHADOW with SPT_CANDIDATE_CLOSEST; CONVEX with SPT_CANDIDATE_*; STARTS in Shadertoy and
 * Vulkan; DEPTH_WRITE with an orthographic camera. BINARY with settings.flags, and CONVEX with
 * SPT_STOP_INSIDE or without a bound, are SPT_BAD_ARGUMENT, as in the calls that they mirror. */
enum {
    /* NaN, bad rays, brackets around sign changes, directions of any length: what trace.h says of
     * them, within the ranges above. With SPT_GLSL_CONVEX, _BINARY and _REFINE directions from 1e-18
     * to 1e18 long. */
    SPT_GLSL_GUARDS = 1u << 0,
    /* SptHit.flags: the Lipschitz audit, and starts inside. */
    SPT_GLSL_FLAGS = 1u << 1,
    /* SptHit.candidate_t and candidate_ratio; settings.flags choose which (SPT_CANDIDATE_*). */
    SPT_GLSL_CANDIDATE = 1u << 2,
    /* SptHit.fallbacks. */
    SPT_GLSL_FALLBACKS = 1u << 3,
    /* SptHit.component, of a scene; and spt_material(component) where the scene has materials. */
    SPT_GLSL_COMPONENT = 1u << 4,
    /* SptRay.path. */
    SPT_GLSL_PATH = 1u << 5,
    /* spt_hit_normal(ray, hit, detail), detail as in spt_normals(). A PICTURE has it by itself. */
    SPT_GLSL_NORMAL = 1u << 6,
    /* spt_refine(ray, hit, iterations): discontinuity reduction, of each hit; of rays that began
     * inside only together with SPT_GLSL_FLAGS. */
    SPT_GLSL_REFINE = 1u << 7,
    /* spt_offset(), spt_offset_checked(): dynamic epsilon for secondary rays. */
    SPT_GLSL_OFFSET = 1u << 8,
    /* spt_soft_shadow(). In a PICTURE by plain steps, whatever the rule. */
    SPT_GLSL_SHADOW = 1u << 9,
    /* spt_ambient_occlusion(). */
    SPT_GLSL_OCCLUSION = 1u << 10,
    /* spt_trace_convex() in the place of spt_trace(), of one field with a bound. Rays that are not
     * turned back ask f at their start once more than is counted. */
    SPT_GLSL_CONVEX = 1u << 11,
    /* spt_binary_trace() in the place of spt_trace(), of one field, by probes: of a MöKRS model its
     * own, else f / lipschitz. */
    SPT_GLSL_BINARY = 1u << 12,
    /* Rays begin where a pass of CONES ended. With a pixel cone the bits are then no longer those
     * of rays from t_min. */
    SPT_GLSL_STARTS = 1u << 13,
    /* gl_FragDepth, and misses are discarded, so that triangles and fields are one picture. */
    SPT_GLSL_DEPTH_WRITE = 1u << 14,
    /* Constants of kernel-reflection sequences in arrays and a loop: shorter texts. Otherwise
     * unrolled, each kernel only what it needs (17 to 23 times as fast on llvmpipe). */
    SPT_GLSL_ARRAYS = 1u << 15,
    /* A scene as one field, the least of all over their Lipschitz constants, of which residual is
     * the value: one march, with the component of the least. Bounds are not used: texts must answer
     * everywhere. For implementations that run both sides of every branch. */
    SPT_GLSL_MERGED = 1u << 16,
    /* int spt_kernel_at(vec3 p) of a KRS or MöKRS model, the number of the nearest kernel, which
     * HITS gives as component. */
    SPT_GLSL_PLACE = 1u << 17
};

/* Parameters that may become uniforms, the bits of spt_glsl_options.uniforms; the others are
 * constants in the text. Those marked * are uniforms always (not in a library). */
typedef enum spt_glsl_name {
    SPT_GLSL_NAME_SIZE = 0,      /* * ivec2: pixels of the picture, rays or points in a row, rows */
    SPT_GLSL_NAME_BUDGET,        /* * int: settings.budget. In a library the caller passes it */
    SPT_GLSL_NAME_EPSILON,       /* float: settings.epsilon and so on */
    SPT_GLSL_NAME_PIXEL_RADIUS,  /* float */
    SPT_GLSL_NAME_RELAXATION,    /* float */
    SPT_GLSL_NAME_EXTRAPOLATION, /* float */
    SPT_GLSL_NAME_SLOPE_BLEND,   /* float */
    SPT_GLSL_NAME_STEP_CAP,      /* float */
    SPT_GLSL_NAME_EYE,           /* vec3: of the camera (frame.h) */
    SPT_GLSL_NAME_RIGHT,         /* vec3 */
    SPT_GLSL_NAME_UP,            /* vec3 */
    SPT_GLSL_NAME_FORWARD,       /* vec3 */
    SPT_GLSL_NAME_WINDOW,        /* vec4: x_low, x_high, y_low, y_high */
    SPT_GLSL_NAME_RANGE,         /* vec2: t_min, t_max of the camera */
    SPT_GLSL_NAME_LIGHT,         /* vec3: unit vector towards the light */
    SPT_GLSL_NAME_LIGHT_TANGENT, /* float: tangent of the light's angular radius */
    SPT_GLSL_NAME_OCCLUSION,     /* float: distance between samples of ambient occlusion */
    SPT_GLSL_NAME_DEPTH,         /* vec2 (a, b): depth = a + b / z, z along forward */
    SPT_GLSL_NAME_TIME,          /* float: for callers' texts. Shadertoy: iTime */
    SPT_GLSL_NAME_VIEW,          /* int: what PICTURE shows; constant 0 */
    SPT_GLSL_NAME_RAY_ORIGIN,    /* * sampler2D */
    SPT_GLSL_NAME_RAY_DIRECTION, /* * sampler2D */
    SPT_GLSL_NAME_RAY_PATH,      /* * sampler2D */
    SPT_GLSL_NAME_STARTS         /* * sampler2D: what CONES wrote */
} spt_glsl_name;
#define SPT_GLSL_NAMES 24

/* The name that is used where the caller gives none: "spt_size", "spt_budget" and so on; NULL for
 * a number out of range. In Shadertoy the size is iResolution, and time iTime. */
SPT_API const char *spt_glsl_default_name(uint32_t name);

/* What spt_glsl_emit() writes. Make one with spt_glsl_options_default(). */
typedef struct spt_glsl_options {
    size_t struct_size;
    const spt_field *field; /* one field, traced as spt_trace() does; or */
    const spt_scene *scene; /* a scene, traced as spt_scene_trace() does; the other is NULL. Scenes
                             * with zones are SPT_UNSUPPORTED */
    const spt_settings *settings; /* method, numbers and flags; max_lanes is not used */
    const spt_camera *camera;     /* PICTURE, CONES: pinhole or orthographic; else it may be NULL */
    uint32_t target;              /* spt_glsl_target */
    uint32_t program;             /* spt_glsl_program */
    uint32_t features;            /* SPT_GLSL_GUARDS and so on */
    uint32_t uniforms;            /* bit SPT_GLSL_NAME_...: that parameter is a uniform */
    const char *const *names; /* SPT_GLSL_NAMES of them, or NULL; each NULL or a name: at most 64
                                   * letters, digits and underlines, no digit first, none that is
                                   * reserved in any target or begins with spt_, Spt or SPT_ (but
                                   * its own default) or gl_, no two underlines in a row, no two
                                   * equal, and none that the text has for something else: names
                                   * with a prefix of one's own, as u_epsilon, never do */
    uint32_t iterations;      /* SPT_GLSL_REFINE: 0 to 16. Default 3 */
    uint32_t samples;         /* SPT_GLSL_OCCLUSION: 1 to 16. Default 5 */
    uint32_t cone_size; /* CONES and SPT_GLSL_STARTS: pixels of the picture on a side of a block, 2
                          * to 64. Default 8 */
    uint32_t field_number; /* POINTS: which component of a scene. Default 0 */
    float detail;          /* SPT_GLSL_NORMAL: as in spt_normals(). Default 0 */
    float light[3];        /* towards the light, of any length but zero. Default (0.4, 0.8, 0.45) */
    float light_tangent;   /* > 0. Default 0.05 */
    float occlusion;       /* > 0. Default 0.1 */
    float depth[2];        /* see SPT_GLSL_NAME_DEPTH; from spt_glsl_depth(). Default 0, 0 */
} spt_glsl_options;

static inline spt_glsl_options spt_glsl_options_default(void) {
    spt_glsl_options options = {
        0,     NULL, NULL,  NULL, NULL, 0, SPT_GLSL_HITS, 0,
        0,     NULL, 3,     5,    8,    0, 0.0f,          {0.4f, 0.8f, 0.45f},
        0.05f, 0.1f, {0, 0}};
    options.struct_size = sizeof options;
    return options;
}

/* The numbers for SPT_GLSL_DEPTH_WRITE: coefficients[0] + coefficients[1] / z is what a depth
 * buffer (frame.h; of kind SPT_DEPTH_DEVICE, or of SPT_DEPTH_DEVICE_GL with the default
 * glDepthRange, which are then the same) holds in [0, 1] at depth z along forward, of a pinhole
 *               camera. near_plane or
 * far_plane may be +infinity, near_plane > far_plane is a reversed buffer. Returns SPT_BAD_ARGUMENT
 * for planes that are not positive or are equal, or a NULL pointer. */
SPT_API spt_status spt_glsl_depth(float near_plane, float far_plane, float coefficients[2]);

/* Writes a shader.
 *   buffer    receives the text, terminated by a zero; may be NULL where capacity is 0
 *   capacity  bytes of it
 *   length    receives how long the text is, without the zero; may be NULL. So call it twice, as
 *             snprintf(): first with (NULL, 0, &length)
 * Returns SPT_BUFFER_TOO_SMALL where capacity <= length, with *length set and as much of the text
 * as fits, terminated. SPT_BAD_ARGUMENT or SPT_UNSUPPORTED, with nothing written, for: a NULL
 * pointer; both or neither of field and scene; a field, settings, scene, camera or number outside
 * its documented range; a bad name or text; an unknown bit, target or program; a combination that
 * is excluded above; settings.flags of SPT_CHECK_CONVEX. SPT_UNSUPPORTED also for fields that
 * cannot be written, bounds by callback, cameras of the caller's rays, and t_max of the camera
 * beyond 1e18 (0 < t_max = +infinity becomes 1e18).
 * Cost: the text is made twice, about 25 us for a KiB of it; 40 KiB of stack. No memory is
 * allocated, and a text is read as far as its zero. */
SPT_API spt_status spt_glsl_emit(const spt_glsl_options *options, char *buffer, size_t capacity,
                                 size_t *length);

#ifdef __cplusplus
}
#endif
#endif
