/* SPDX-License-Identifier: MIT
 *
 * Kernel-reflection sequences: models of up to 2^65 - 1 instances of a few bodies, whose distance
 * costs one fold and one body a level (Szécsi et al. 2016). Also deformations of fields by maps of
 * known Lipschitz constant. Left out: conformal maps between the levels, which are in mobius.h.
 *
 * A MODEL of n levels has kernels K_0 .. K_n and mirrors 0 .. n-1, planes normal . p = offset, and
 * is built from the leaf to the trunk:
 *     L_0 = K_0,    L_(i+1) = K_(i+1)  with  L_i  and the mirror image of L_i in mirror i
 * so that K_i stands there 2^(n-i) times. (Section 3; what the paper calls kernel sets.)
 *
 * WHAT MUST HOLD for the distance to be that of the whole union: all of L_i, its images included,
 * on the side normal . p <= offset of mirror i. What lies beyond is cut off and replaced by the
 * image of what does not, and the distance is a lower bound of that to the geometry so cut, still
 * with Lipschitz constant 1; corals, rocks and terrain are made so (section 9.1). The paper calls
 * it an underestimate; of the distance to the union without cuts it is an overestimate.
 * spt_krs.straddles tells which levels may be cut, by balls around all of a level, which says
 * little of the upper ones; spt_krs_check() samples how much is.
 *
 * LEVEL OF DETAIL comes from settings.pixel_radius: rays stop at half a pixel, which thickens what
 * is thinner and merges what is closer, continuously with the distance (section 4). What is shaded
 * there should vary as little: spt_krs_locate() smooths normals over the width of a pixel. Moving
 * pictures want spt_refine(), and spt_relaxed() or spt_basic(): what longer steps leave below half
 * a pixel varies more from frame to frame where rays graze (by 38 % in a wood). */
#ifndef SPHERETRACE_KRS_H
#define SPHERETRACE_KRS_H

#include "base.h"
#include "bound.h"
#include "field.h"
#include "surface.h"
#include "trace.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The most levels of a model. */
#define SPT_KRS_LEVELS 64

/* ---- Kernels ------------------------------------------------------------------------------- */

typedef enum spt_kernel_kind {
    SPT_KERNEL_EMPTY = 0,      /* nothing: costs nothing */
    SPT_KERNEL_SPHERE = 1,     /* within radius of a */
    SPT_KERNEL_HALF_SPACE = 2, /* a . p <= radius, a of any length from FLT_MIN on */
    SPT_KERNEL_CAPSULE = 3,    /* within radius of the arc from a through control to b, straight
                                * where control is on their line: a toroidal capsule (9.2) */
    SPT_KERNEL_LEAF = 4,       /* within radius of a flat leaf with tips a and b, bounded by two
                                * arcs, `width` to each side of the middle; control: a vector across
                                * its plane, whose part along the tips does not count */
    SPT_KERNEL_FIELD = 5       /* a caller's field; lipschitz is divided by */
} spt_kernel_kind;
#define SPT_KERNEL_KINDS 6

/* A kernel as the caller describes it. Make one with the functions below, which zero what a kind
 * does not use. Lengths in world units, 0 or from 1e-15 to 1e18; coordinates up to 1e18. Refused
 * with SPT_BAD_ARGUMENT where it is used: a non-finite number, radius < 0 (but of a half space),
 * width <= 0 or more than half the distance of the tips, tips that coincide, a vector of no length
 * (or along the tips), a field that spt_trace() would refuse. */
typedef struct spt_kernel {
    uint32_t kind; /* spt_kernel_kind */
    float a[3], b[3], control[3];
    float radius, width;
    const spt_field *field; /* its callbacks, user, lipschitz and bound are read when the model is
                             * built; SPT_KERNEL_FIELD only */
} spt_kernel;

static inline spt_kernel spt_kernel_empty(void) {
    const spt_kernel kernel = {SPT_KERNEL_EMPTY, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, 0, 0, NULL};
    return kernel;
}

static inline spt_kernel spt_kernel_sphere(float x, float y, float z, float radius) {
    spt_kernel kernel = spt_kernel_empty();
    kernel.kind = SPT_KERNEL_SPHERE;
    kernel.a[0] = x;
    kernel.a[1] = y;
    kernel.a[2] = z;
    kernel.radius = radius;
    return kernel;
}

static inline spt_kernel spt_kernel_half_space(float normal_x, float normal_y, float normal_z,
                                               float offset) {
    spt_kernel kernel = spt_kernel_sphere(normal_x, normal_y, normal_z, offset);
    kernel.kind = SPT_KERNEL_HALF_SPACE;
    return kernel;
}

static inline spt_kernel spt_kernel_capsule(const float a[3], const float b[3],
                                            const float control[3], float radius) {
    spt_kernel kernel = spt_kernel_sphere(a[0], a[1], a[2], radius);
    int axis;
    kernel.kind = SPT_KERNEL_CAPSULE;
    for (axis = 0; axis < 3; ++axis) {
        kernel.b[axis] = b[axis];
        kernel.control[axis] = control[axis];
    }
    return kernel;
}

static inline spt_kernel spt_kernel_leaf(const float tip[3], const float other_tip[3],
                                         const float across[3], float width, float radius) {
    spt_kernel kernel = spt_kernel_capsule(tip, other_tip, across, radius);
    kernel.kind = SPT_KERNEL_LEAF;
    kernel.width = width;
    return kernel;
}

static inline spt_kernel spt_kernel_field(const spt_field *field) {
    spt_kernel kernel = spt_kernel_empty();
    kernel.kind = SPT_KERNEL_FIELD;
    kernel.field = field;
    return kernel;
}

/* The plane normal . p = offset that L_i is mirrored at. normal of any finite length but zero: one
 * of unit length (|normal|^2 within 2^-22 of 1) is taken as it is, any other is brought to it
 * together with the offset, since a fold with a wrong length overestimates. */
typedef struct spt_mirror {
    float normal[3], offset;
} spt_mirror;

/* The mirror through a point. */
static inline spt_mirror spt_mirror_at(const float point[3], const float normal[3]) {
    spt_mirror mirror;
    int axis;
    mirror.offset = 0.0f;
    for (axis = 0; axis < 3; ++axis) {
        mirror.normal[axis] = normal[axis];
        mirror.offset += normal[axis] * point[axis];
    }
    return mirror;
}

/* ---- Models -------------------------------------------------------------------------------- */

/* A model as the caller describes it. */
typedef struct spt_krs_model {
    size_t struct_size;        /* set by spt_krs_model_default() */
    uint32_t levels;           /* n, 0 to SPT_KRS_LEVELS */
    const spt_kernel *kernels; /* n + 1 of them: K_0 .. K_n */
    const spt_mirror *mirrors; /* n of them; may be NULL with 0 levels */
    const spt_bound *bound;    /* of the whole model, where the caller knows a better one than the
                                 * ball that spt_krs_build() finds; or NULL */
    float smooth;              /* normals are blended within this distance of a mirror, world
                                 * length, >= 0. Default 0: not. (Section 8.1) */
    uint32_t max_lanes;        /* as in spt_settings. Default 0 */
} spt_krs_model;

static inline spt_krs_model spt_krs_model_default(void) {
    spt_krs_model model = {0, 0, NULL, NULL, NULL, 0.0f, 0};
    model.struct_size = sizeof model;
    return model;
}

/* A kernel as it is evaluated. */
typedef struct spt_built_kernel {
    uint32_t kind;
    float number[19]; /* of the shape */
    spt_distance_batch_fn *batch;
    spt_distance_fn *point;
    spt_gradient_batch_fn *gradient;
    void *user;
    float lipschitz;
    const char *glsl, *glsl_prelude;
} spt_built_kernel;

/* A model as it is evaluated: about 9 KiB of the caller's, filled by spt_krs_build(), not written
 * afterwards. It holds no pointer to the description nor into itself, and may be copied. */
typedef struct spt_krs {
    uint32_t levels;
    uint32_t max_lanes;
    uint64_t straddles; /* bit i: as far as enclosing balls tell, L_i may reach beyond mirror i */
    float smooth;
    uint32_t field_kernels;             /* how many kernels are callers' fields */
    int32_t bounded;                    /* whether the model has an end: */
    spt_bound bound;                    /* then this contains it */
    spt_mirror mirrors[SPT_KRS_LEVELS]; /* of unit normals */
    spt_built_kernel kernels[SPT_KRS_LEVELS + 1];
} spt_krs;

/* Builds a model. Nothing of the description need live on, but for the users of fields. Returns
 * SPT_BAD_ARGUMENT, with nothing written, for: a NULL pointer; levels > SPT_KRS_LEVELS; a bad
 * kernel; a mirror whose normal has no length, or whose offset exceeds 1e18; a bad bound; smooth
 * or max_lanes out of range; smooth > 0 with a field kernel that has no gradient callback.
 * Straddling is no error: see spt_krs.straddles.
 * Cost: about 0.2 us a level. */
SPT_API spt_status spt_krs_build(const spt_krs_model *model, spt_krs *krs);

/* The model as a field: lipschitz 1, its bound, batch and point callbacks, and, if all field
 * kernels have one, a gradient callback, which sees smooth. krs is not copied: it must stay where
 * it is as long as the field is used. The callbacks keep equal bits at every width.
 *     d = K_n(p);  for i = n-1 .. 0:  fold p at mirror i;  d = min(d, K_i(p))      (Algorithm 1)
 * without branches, with |d - exact| <= 2^-22 (n + 4) max(|p| + largest |offset|, reach of kernels,
 * 1), for coordinates of up to 1e18; what lies beyond has the distance of the nearest point within,
 * joined with the way to it.
 * Cost: about 1 ns a level of capsules and evaluation with 16 lanes. */
SPT_API spt_field spt_krs_field(const spt_krs *krs);

/* How many kernel instances a model of so many levels has, 2^(levels + 1) - 1; at 64 levels it is
 * rounded to 2^65. */
SPT_API double spt_krs_instances(uint32_t levels);

/* What a sampled check of a model found: of points on the surfaces of the instances that L_i has,
 * how many lie beyond mirror i, and so are cut off. */
typedef struct spt_krs_faults {
    uint32_t samples[SPT_KRS_LEVELS];   /* points of L_i that were looked at, those that a lower
                                         * mirror cut off left out */
    uint32_t discarded[SPT_KRS_LEVELS]; /* those beyond mirror i by more than rounding explains */
    float depth[SPT_KRS_LEVELS];        /* how far beyond, at most, world length; 0: none */
    float worst[SPT_KRS_LEVELS][3];     /* where, in the space of L_i */
} spt_krs_faults;

/* Samples a model's precondition, for tools and debug builds. Points are drawn on kernels of finite
 * extent and carried through random images to each level; kernels of field are drawn in their
 * bounds and moved along their gradients to their surfaces.
 *   samples  of each level, 1 to 2^20
 *   seed     equal seeds, equal points
 * Returns SPT_BAD_ARGUMENT for a NULL pointer or samples out of range, SPT_UNSUPPORTED for a model
 * without any kernel of finite extent. */
SPT_API spt_status spt_krs_check(const spt_krs *krs, uint32_t samples, uint32_t seed,
                                 spt_krs_faults *faults);

/* ---- Shading ------------------------------------------------------------------------------- */

/* What is known of a place on a model; each is optional (first NULL: not wanted). Places that are
 * not looked at keep what their sinks held.
 *   kernel         int32_t, the nearest kernel's number, 0 .. n; of equals the higher. -1: all are
 *                  empty
 *   mirrors        uint64_t, bit i set where mirror i was folded at on the way to that kernel (bits
 *                  below the kernel's number are clear): together they name the instance
 *   point          the place as the kernel sees it
 *   normal         unit, outward, world space; blended near mirrors over
 *                  max(smooth, pixel_radius (path + t |direction|)). Zero where there is no
 *                  gradient
 *   kernel_normal  that of the kernel, in its own space
 *   u, v           float, the kernel's own parameters:
 *                    sphere      longitude about y and latitude, both in [0, 1]
 *                    half space  coordinates in the plane, world length
 *                    capsule     along the arc from a to b, in [0, 1], and around it, in turns from
 *                                0 to 1
 *                    leaf        from tip to tip, and from edge to edge, in [0, 1]
 *                    field       0
 *   scale          float, how many times larger lengths are here than in the kernel's space: 1, but
 *                  for MöKRS (mobius.h) */
typedef struct spt_krs_places {
    spt_sink kernel, mirrors;
    spt_vector_sinks point, normal, kernel_normal;
    spt_sink u, v, scale;
} spt_krs_places;

/* Where hits lie in a model.
 *   component  hits.component of the hits that are meant, where that sink is there; else all hits
 *   settings   as traced; pixel_radius smooths normals (0: not)
 *   rays, hits as for spt_normals() (surface.h). For points of any other origin: rays from them,
 *              any direction, and t = 0
 * Returns SPT_BAD_ARGUMENT as spt_normals() does. */
SPT_API spt_status spt_krs_locate(const spt_krs *krs, int32_t component,
                                  const spt_settings *settings, size_t count, const spt_rays *rays,
                                  const spt_hits *hits, const spt_krs_places *places);

/* A number that differs from instance to instance, to vary colours by: a hash of what
 * spt_krs_locate() says. All kernels up to number `from` that stand on one instance of that kernel
 * share it; 0: each has its own. */
static inline uint32_t spt_krs_identity(int32_t kernel, uint64_t mirrors, uint32_t from) {
    const uint32_t own = kernel > 0 ? (uint32_t)kernel : 0;
    uint64_t hash = from < 64 ? mirrors >> from << from : 0;
    hash = (hash + (own > from ? own : from) * UINT64_C(0x2545f4914f6cdd1d)) *
           UINT64_C(0x9e3779b97f4a7c15);
    hash = (hash ^ hash >> 32) * UINT64_C(0xd6e8feb86659fd93);
    return (uint32_t)(hash >> 32);
}

/* Weights of three planar projections along x, y and z for a unit normal, of sum 1 (section 8.2,
 * after Geiss 2007): |n|^(2^sharpness), normalised. sharpness 0 to 6; 2 is usual. With `normal`
 * from the world the texture is the world's, with `kernel_normal` the kernel's. A zero normal gives
 * three thirds. */
static inline void spt_triplanar(const float normal[3], uint32_t sharpness, float weights[3]) {
    float sum = 0.0f;
    uint32_t i;
    int axis;
    for (axis = 0; axis < 3; ++axis) {
        weights[axis] = normal[axis] < 0.0f ? -normal[axis] : normal[axis];
        for (i = 0; i < sharpness; ++i) weights[axis] *= weights[axis];
        sum += weights[axis];
    }
    for (axis = 0; axis < 3; ++axis) {
        weights[axis] = sum > 0.0f ? weights[axis] / sum : 1.0f / 3.0f;
    }
}

/* ---- Distortion ---------------------------------------------------------------------------- */

/* Moves n points from the distorted world back to where the field is defined, in place. May give
 * infinity; NaN makes the distance NaN. Arrays as in spt_distance_batch_fn. */
typedef void spt_unmap_batch_fn(void *user, size_t n, float *x, float *y, float *z);

/* The deformations, with h the height over origin along axis:
 *   TWIST  a slice turns about the axis by rate h, right-handed
 *   BEND   what comes to stand at h was turned by rate h about the line along `side` through
 *          origin, as spt_bend() does. |rate| times the distance from that line stays below 1, or
 *          the body folds over itself
 *   TAPER  a slice is scaled about the axis by 1 + rate h, which must be at least 1/8 all over the
 *          field's bound
 *   SWAY   a slice with h > 0 moves along `side` by rate h^2 sin(phase + wave h): grass and trees
 *          in the wind, with phase as time passes
 *   MAP    the caller's */
typedef enum spt_distortion_kind {
    SPT_DISTORTION_TWIST = 1,
    SPT_DISTORTION_BEND = 2,
    SPT_DISTORTION_TAPER = 3,
    SPT_DISTORTION_SWAY = 4,
    SPT_DISTORTION_MAP = 5
} spt_distortion_kind;

/* A deformation of the space that a field lives in. Angles in radians, lengths in world units. */
typedef struct spt_distortion {
    size_t struct_size; /* set by spt_distortion_default() */
    uint32_t kind;      /* spt_distortion_kind */
    float origin[3];    /* default 0 */
    float axis[3];      /* of any length but zero. Default y */
    float side[3];      /* bend, sway: of any length but zero; at right angles to axis to 1e-3, and
                          * made so exactly. Default x */
    float rate;         /* twist, bend: radians per length; taper: per length; sway: per length */
    float wave;         /* sway: radians per length. Default 0 */
    float phase;        /* sway: radians, |phase| <= 1e4. Default 0 */
    spt_unmap_batch_fn *unmap; /* map: the inverse, from the world to the field, */
    void *user;                /* what it is handed, */
    float lipschitz;           /* its Lipschitz constant there, > 0, */
    const spt_bound *bound;    /* and a volume that contains the distorted body, in which that
                                * constant holds */
    const char *glsl;          /* the body of vec3 NAME(vec3 p), the same for a shader (glsl.h), or
                                * NULL, */
    const char *glsl_prelude;  /* and functions which that needs, or NULL */
} spt_distortion;

static inline spt_distortion spt_distortion_default(void) {
    spt_distortion distortion = {0, 0,    {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, 0,    0,
                                 0, NULL, NULL,      1,         NULL,      NULL, NULL};
    distortion.struct_size = sizeof distortion;
    return distortion;
}

/* A distorted field's memory: the caller's, not written after it was made. */
typedef struct spt_distorted {
    spt_field inner;
    spt_bound inner_bound, bound;
    spt_distortion distortion;
    float frame[3][3]; /* side, axis, and their cross product */
} spt_distorted;

/* Makes the field f(W(p)), W the inverse of the deformation, with the Lipschitz constant
 * lipschitz(f) * lipschitz(W). That of W is the largest over a convex region around the distorted
 * body, which is the result's bound: a cylinder about the axis (twist, taper) or `side` (bend), or
 * a box (sway). Points beyond the region stand for its nearest one, so that the constant holds
 * everywhere; that of a map only in its bound. (Hart 1996; Szécsi et al. 2016, section 5.2.)
 *     twist  (a + sqrt(a^2 + 4)) / 2, a = |rate| times the distance from the axis
 *     bend   1 + |rate| times the distance from the line of turning
 *     taper  the largest singular value of W's derivative, at the narrow end
 *     sway   as twist, with a = |rate| h sqrt(4 + (wave h)^2), the largest shear in any phase, h
 *            the top of the bound
 * The distance is a bound the worse the larger it is: tracing takes about so many times the
 * evaluations.
 *   field   must have a bound of finite extent (but with SPT_DISTORTION_MAP)
 *   memory  must live, unmoved, as long as *result is used
 *   result  with a gradient callback if the field has one
 * Returns SPT_BAD_ARGUMENT for a NULL pointer, a bad field, kind or number, a taper below 1/8,
 * angles beyond 1e4 in the bound, coordinates beyond 2^60 there or 1e18 of origin, a missing unmap
 * or bound, and a lipschitz constant of the result beyond 2^100 or below 2^-100; SPT_UNSUPPORTED
 * for a field without a bound of finite extent. Nothing is written then. Cost: about 2 ns an
 * evaluation with 16 lanes. */
SPT_API spt_status spt_distorted_field(const spt_field *field, const spt_distortion *distortion,
                                       spt_distorted *memory, spt_field *result);

/* Points of the distorted world as the inner field sees them, those outside the region as its
 * nearest one: for spt_krs_locate(), whose normals are then the undistorted ones (those of the
 * world: spt_normals() of the result). What is not finite gives NaN. Reads and writes columns,
 * which may be the same. Returns SPT_BAD_ARGUMENT for a NULL pointer and columns that are absent or
 * do not fit. */
SPT_API spt_status spt_distorted_points(const spt_distorted *distorted, size_t count,
                                        const spt_vectors *points,
                                        const spt_vector_sinks *undistorted);

#ifdef __cplusplus
}
#endif
#endif
