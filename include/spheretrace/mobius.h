/* SPDX-License-Identifier: MIT
 *
 * Quaternions and Möbius maps, and what they are for here: fields under conformal maps,
 * kernel-reflection sequences with a map between their levels (MöKRS), and tracing by probes that
 * only answer whether a ball is free (Szécsi et al. 2016, sections 6 and 7, appendices A to C).
 * Left out: models without maps, which are in krs.h and cost a third.
 *
 * A Möbius map takes a point p of space, as the pure quaternion p = x i + y j + z k, to
 * (a p + b)(c p + d)^-1. It takes balls, outsides of balls and half spaces into one another and
 * keeps angles. Not every a, b, c, d will do: the map must take space to itself, which is so if
 *     Re(a* c) = 0,  Re(b* d) = 0,  a* d + c* b = lambda, real and not 0
 * (x* the conjugate); with lambda < 0 it changes the orientation. (The paper says any a, b, c, d in
 * H.) Maps are kept with |lambda| = 1 and the sign apart, since a long product loses lambda.
 *
 * Maps are built in double; what is evaluated point by point, in float32, for points with
 * coordinates of up to 1e18; what lies beyond is joined to the nearest point within, as in krs.h.
 * Callbacks that are made here and there take up to 14 KiB of stack of their own, which is to be
 * added to what trace.h says of a level of recursion, also in spt_conformal_trace(). */
#ifndef SPHERETRACE_MOBIUS_H
#define SPHERETRACE_MOBIUS_H

#include "base.h"
#include "bound.h"
#include "field.h"
#include "krs.h"
#include "trace.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Quaternions --------------------------------------------------------------------------- */

/* real + x i + y j + z k */
typedef struct spt_quaternion {
    double real, x, y, z;
} spt_quaternion;

static inline spt_quaternion spt_quaternion_of(double scalar, double x, double y, double z) {
    spt_quaternion quaternion;
    quaternion.real = scalar;
    quaternion.x = x;
    quaternion.y = y;
    quaternion.z = z;
    return quaternion;
}

static inline spt_quaternion spt_quaternion_conjugate(spt_quaternion q) {
    return spt_quaternion_of(q.real, -q.x, -q.y, -q.z);
}

static inline spt_quaternion spt_quaternion_sum(spt_quaternion p, spt_quaternion q) {
    return spt_quaternion_of(p.real + q.real, p.x + q.x, p.y + q.y, p.z + q.z);
}

static inline spt_quaternion spt_quaternion_scaled(spt_quaternion q, double factor) {
    return spt_quaternion_of(q.real * factor, q.x * factor, q.y * factor, q.z * factor);
}

/* p q; of two pure ones the real part is minus their scalar product. */
static inline spt_quaternion spt_quaternion_product(spt_quaternion p, spt_quaternion q) {
    return spt_quaternion_of(p.real * q.real - p.x * q.x - p.y * q.y - p.z * q.z,
                             p.real * q.x + p.x * q.real + p.y * q.z - p.z * q.y,
                             p.real * q.y - p.x * q.z + p.y * q.real + p.z * q.x,
                             p.real * q.z + p.x * q.y - p.y * q.x + p.z * q.real);
}

/* |q|^2 */
static inline double spt_quaternion_square(spt_quaternion q) {
    return q.real * q.real + q.x * q.x + q.y * q.y + q.z * q.z;
}

/* ---- Maps ---------------------------------------------------------------------------------- */

/* p -> (a p + b)(c p + d)^-1 with a* d + c* b = orientation. */
typedef struct spt_mobius {
    spt_quaternion a, b, c, d;
    int32_t orientation; /* sign of lambda: 1 keeps the orientation of space, -1 reverses it */
} spt_mobius;

/* p */
SPT_API spt_mobius spt_mobius_identity(void);

/* Elementary maps (Table 1, mended). Each returns SPT_BAD_ARGUMENT, with nothing written, for a
 * NULL pointer and numbers that are not finite or not as said. */

/* scale p; scale != 0, 1e-30 to 1e30 in magnitude; negative ones are point reflections. */
SPT_API spt_status spt_mobius_dilation(double scale, spt_mobius *map);
/* p + by */
SPT_API spt_status spt_mobius_translation(const double by[3], spt_mobius *map);
/* Right-handed by an angle in radians about an axis through the origin, of any length but zero.
 * |angle| <= 1e5. (With r = cos(angle/2) + axis sin(angle/2): r p r*.) */
SPT_API spt_status spt_mobius_rotation(const double axis[3], double angle, spt_mobius *map);
/* In the plane normal . p = offset, normal of any length but zero. In x = 0 it is i p i; the paper
 * prints -i p i, a half turn. */
SPT_API spt_status spt_mobius_reflection(const double normal[3], double offset, spt_mobius *map);
/* In the sphere of that center and radius > 0: center + radius^2 (p - center) / |p - center|^2. In
 * the unit sphere it is [0 1; -1 0]; the paper's [0 1; 1 0], "p^-1", is its point reflection. */
SPT_API spt_status spt_mobius_inversion(const double center[3], double radius, spt_mobius *map);

/* The map of a matrix. Refused with SPT_BAD_ARGUMENT where it breaks the group condition: entries
 * not finite; |lambda| < 1e-6 (|a| |d| + |b| |c|); Re(a* c), or the real part of the images of four
 * test points, above 1e-5 of their size, which covers Re(b* d) and a lambda that is not real. So
 * [r 0; 0 r] is a rotation for an r of any length, and [r 0; 0 r*] is none. */
SPT_API spt_status spt_mobius_matrix(spt_quaternion a, spt_quaternion b, spt_quaternion c,
                                     spt_quaternion d, spt_mobius *map);

/* outer(inner(p)). result may be one of them. SPT_BAD_ARGUMENT also where an entry of the product
 * is not finite. */
SPT_API spt_status spt_mobius_compose(const spt_mobius *outer, const spt_mobius *inner,
                                      spt_mobius *result);

/* The map that undoes it; exact. */
SPT_API spt_mobius spt_mobius_inverse(const spt_mobius *map);

/* ---- What maps do -------------------------------------------------------------------------- */

/* The image of a point. Returns 0, and +infinity in all three coordinates, where that is infinity:
 * at the map's pole. Coordinates that are not finite (infinity itself) go to the image of
 * infinity. */
SPT_API int spt_mobius_point(const spt_mobius *map, const double point[3], double image[3]);

/* How many times lengths grow at a point: 1 / |c p + d|^2; +infinity at the pole. */
SPT_API double spt_mobius_scale(const spt_mobius *map, const double point[3]);

/* The image of a vector that is attached to a point, unit for unit: a normal of a surface goes to
 * the normal of its image, outward to outward (Appendix C; Equation 3 as printed has the length
 * |DL|). Zero at the pole. point is the place before the map, vector is as long as its image. */
SPT_API void spt_mobius_vector(const spt_mobius *map, const double point[3], const double vector[3],
                               double image[3]);

typedef enum spt_region_kind {
    SPT_REGION_BALL = 1,      /* |p - center| <= radius */
    SPT_REGION_OUTSIDE = 2,   /* |p - center| >= radius, infinity included */
    SPT_REGION_HALF_SPACE = 3 /* center . p <= radius, center of unit length */
} spt_region_kind;

/* What Möbius maps take into one another. */
typedef struct spt_region {
    uint32_t kind; /* spt_region_kind */
    double center[3];
    double radius; /* > 0 of a ball */
} spt_region;

/* The image of a region, by its center and radius, without the cancellation of the coefficients of
 * Appendix A. The boundary's image is a plane where the boundary passes the pole, within 2^-40 of
 * its distance. To pull a region back, map it by the inverse. Returns SPT_BAD_ARGUMENT for a NULL
 * pointer, an unknown kind, numbers that are not finite, a radius that is not positive, a normal
 * that is not of unit length to 1e-6, and where the image's numbers overflow. image is written only
 * with SPT_OK and may be the region. */
SPT_API spt_status spt_mobius_region(const spt_mobius *map, const spt_region *region,
                                     spt_region *image);

/* A sphere or plane by the coefficients of alpha |p|^2 - 2 beta . p + gamma = 0: what the paper
 * computes with (Equation 2). In double: a small ball far away loses its radius in gamma. */
typedef struct spt_sphere_coefficients {
    double alpha, beta[3], gamma;
} spt_sphere_coefficients;

/* Those of a region's boundary, with alpha > 0 for a ball, < 0 for an outside, 0 for a half space:
 * inside the region the form is negative. */
SPT_API spt_sphere_coefficients spt_region_coefficients(const spt_region *region);

/* The sphere or plane whose image under the map is the given one (Appendix A), scaled so that the
 * largest coefficient is 1; the sign of the form is kept. */
SPT_API spt_sphere_coefficients spt_mobius_pull_back(const spt_mobius *map,
                                                     const spt_sphere_coefficients *image);

/* Where the line origin + t direction meets a sphere or plane (Appendix B, with the conjugates that
 * print lost). Returns how many there are, 0 to 2, ascending in t; a line that lies in a plane has
 * none. A tangent counts twice. */
SPT_API int spt_sphere_meets_line(const spt_sphere_coefficients *sphere, const double origin[3],
                                  const double direction[3], double t[2]);

/* How far one can go from a point in a unit direction without leaving the unbounding ball of a
 * kernel seen through a map from kernel space to the world: rho >= 0 is the kernel's distance at
 * the point's preimage. The ball's center is not the point (section 6). +infinity where the way
 * never leaves it, which may then be all but a ball, or a half space. */
SPT_API double spt_mobius_exit(const spt_mobius *map, const double point[3],
                               const double direction[3], double rho);

/* ---- A field under one map ----------------------------------------------------------------- */

/* One level of maps as it is evaluated: L, and what follows from it, in float32. */
typedef struct spt_built_map {
    float a[4], b[4], c[4], d[4]; /* real, x, y, z */
    float c_length;               /* |c| */
    float orientation;            /* 1 or -1 */
    float pole[3];                /* L(infinity); +infinity where c = 0 */
    float center[3];              /* L^-1(infinity); 0 where c = 0 */
    float least;                  /* of |a - p c|: nearer to the pole that is rounding */
    float whole[4];  /* a ball in which all is that was mapped: center, radius; or FLT_MAX */
    int32_t inverts; /* whether the preimage of p is better computed as */
    float matrix[9]; /* center + matrix (p - pole) / |p - pole|^2, row by row */
    float c_inverse; /* |c|^-2 */
} spt_built_map;

/* A field in a space that a map takes to the world: the caller's memory, about 0.5 KiB. max_lanes,
 * as in spt_settings, may be set after it was made. */
typedef struct spt_conformal {
    spt_built_kernel kernels[2]; /* the field, and nothing else */
    spt_built_map map;
    spt_bound bound;
    uint32_t max_lanes;
} spt_conformal;

/* Makes the field of the mapped body: the radius of the largest ball around a point that is free,
 * as far as the inner field's ball tells, f / (lipschitz |DL^-1| (1 + ...)): section 6, centred. A
 * lower bound of the distance with lipschitz 1, on both sides, which tends to it at the surface; so
 * every step rule and driver traces it.
 *   field   as for spt_trace(); its bound is mapped, and dropped if the image has no end
 *   memory  must live, unmoved, as long as *result is used
 *   result  with a gradient callback if the field has one
 * Returns SPT_BAD_ARGUMENT for a NULL pointer, a bad field, or a map that spt_moekrs_build()
 * refuses. As for spt_moekrs_field() rounding adds about 2^-20 of the coordinates seen, as lengths
 * in the world, but times |a| |d| + |b| |c| of the map (|lambda| = 1), which products of many maps
 * make large: chains belong into the levels of a model. Cost: 2 to 4 ns an evaluation. */
SPT_API spt_status spt_conformal_field(const spt_field *field, const spt_mobius *map,
                                       spt_conformal *memory, spt_field *result);

/* Traces rays against it by exits of the off-centre unbounding balls (section 6): steps that are
 * longer than any centred ball allows, and end where spt_trace() of the field would. Starts inside
 * the body end there at once, SPT_HIT with SPT_FLAG_INSIDE. settings.method is not used, flags must
 * be 0. rays, hits, statistics and what is returned as for spt_trace(); candidates are not looked
 * for (+infinity), flags tell SPT_FLAG_INSIDE only. */
SPT_API spt_status spt_conformal_trace(const spt_conformal *conformal, const spt_settings *settings,
                                       size_t count, const spt_rays *rays, const spt_hits *hits,
                                       spt_statistics *statistics);

/* ---- Probes and binary tracing ------------------------------------------------------------- */

/* Which of n balls are certainly free of the surface and of the inside: clearance[i] >= 0 where the
 * ball around x, y, z of the given radius (> 0) is. Negative: not, or not certainly. NaN counts as
 * negative, but a ray whose last probe it was ends as SPT_NONFINITE. Arrays as in
 * spt_distance_batch_fn. */
typedef void spt_probe_batch_fn(void *user, size_t n, const float *x, const float *y,
                                const float *z, const float *radius, float *clearance);

/* The same for one ball. */
typedef float spt_probe_fn(void *user, float x, float y, float z, float radius);

/* A body that answers probes. */
typedef struct spt_probe {
    size_t struct_size;        /* set by spt_probe_default() */
    spt_probe_batch_fn *batch; /* preferred */
    spt_probe_fn *point;       /* used where batch is NULL; one of the two must be there */
    void *user;
    const spt_bound *bound; /* as in spt_field; or NULL */
} spt_probe;

static inline spt_probe spt_probe_default(void) {
    spt_probe probe = {0, NULL, NULL, NULL, NULL};
    probe.struct_size = sizeof probe;
    return probe;
}

/* A field as a body that answers probes: free where f / lipschitz >= radius. The field is not
 * copied and must live as long as the probe; what it must be is checked when the probe is traced,
 * by the answers (a NULL pointer gives a probe without callbacks, which is refused there). */
SPT_API spt_probe spt_probe_of_field(const spt_field *field);

/* How a ray feels its way. */
typedef struct spt_binary {
    size_t struct_size; /* set by spt_binary_default() */
    float bonus;   /* how much larger a probe is after one that was free, in (1, 8]. Default 2 */
    float penalty; /* and after one that was not, in (0, 1). Default 0.3 */
    float probe_ratio; /* the ray ends at probes of this times the tolerance, or of what t
                         * resolves, in (0, 1]. Default 0.1 */
    float first;       /* radius of the first probe, world length, >= 0. Default 0: half the bound's
                        * largest half side; without a bound an eighth of the ray, and no more than
                        * its origin's largest coordinate, or 1 */
} spt_binary;

static inline spt_binary spt_binary_default(void) {
    spt_binary binary = {0, 2.0f, 0.3f, 0.1f, 0.0f};
    binary.struct_size = sizeof binary;
    return binary;
}

/* Binary sphere tracing (Algorithm 2, mended: the ray advances before its probe grows, ends at
 * t_max and after `budget` probes). Each probe is a ball that touches the end of what is free of
 * the ray: free, the ray advances by its diameter; not, a smaller one is tried. The first is a
 * point, at t_min.
 *   binary      or NULL for the defaults
 *   settings    budget counts probes, and method is not used; flags must be 0. probe_ratio times
 *               the tolerance (trace.h) is what ends a ray
 *   hits        t        for a hit short of the surface by at most
 *                        (probe_ratio tolerance / penalty) (1 + c) / c, where c is the cosine of
 *                        the ray with the normal: 0.67 tolerances head-on. +infinity for a miss
 *               residual radius of the last probe that was not free, world length; +infinity for a
 *                        miss, and where nothing was asked
 *               flags SPT_FLAG_INSIDE where not even the point at t_min is free; fallbacks the
 *                        probes that were not free, candidates +infinity
 *               SPT_LIMIT up to t the ray is free
 *               A ray that begins inside ends at t_min as SPT_HIT
 * Returns SPT_BAD_ARGUMENT as spt_trace() does.
 * Cost: about twice the evaluations of sphere tracing; use spt_moekrs_field() where there is one.
 * */
SPT_API spt_status spt_binary_trace(const spt_probe *probe, const spt_binary *binary,
                                    const spt_settings *settings, size_t count,
                                    const spt_rays *rays, const spt_hits *hits,
                                    spt_statistics *statistics);

/* ---- MöKRS --------------------------------------------------------------------------------- */

/* A Möbius kernel-reflection sequence of n levels (section 7):
 *     L_0 = K_0,    L_(i+1) = G_i ( K_(i+1)  with  L_i  and the mirror image of L_i in x = 0 )
 * with L_i on the side x <= 0 (else cut, as in krs.h). Any other mirror is a part of G_i. */
typedef struct spt_moekrs_model {
    size_t struct_size;        /* set by spt_moekrs_model_default() */
    uint32_t levels;           /* n, 0 to SPT_KRS_LEVELS */
    const spt_kernel *kernels; /* n + 1 of them: K_0 .. K_n */
    const spt_mobius *maps;    /* n of them: G_0 .. G_(n-1); may be NULL with 0 levels */
    uint64_t unmirrored;       /* bit i: level i has no mirror image, only the map. Default 0 */
    const spt_bound *bound;    /* of the whole model in the world, or NULL: a ball is looked for */
    float smooth;              /* as in spt_krs_model, in the space of the mirror. Default 0 */
    uint32_t max_lanes;        /* as in spt_settings. Default 0 */
} spt_moekrs_model;

static inline spt_moekrs_model spt_moekrs_model_default(void) {
    spt_moekrs_model model = {0, 0, NULL, NULL, 0, NULL, 0.0f, 0};
    model.struct_size = sizeof model;
    return model;
}

/* A model as it is evaluated: about 15 KiB of the caller's, filled by spt_moekrs_build(), not
 * written afterwards. */
typedef struct spt_moekrs {
    uint32_t levels;
    uint32_t max_lanes;
    uint64_t unmirrored;
    uint64_t straddles; /* bit i: as far as enclosing balls tell, L_i may reach beyond x = 0 */
    float smooth;
    uint32_t field_kernels; /* how many kernels are callers' fields */
    int32_t bounded;        /* whether the model has an end that enclosing balls find: */
    spt_bound bound;        /* then this contains it */
    spt_built_map maps[SPT_KRS_LEVELS];
    spt_built_kernel kernels[SPT_KRS_LEVELS + 1];
} spt_moekrs;

/* Builds a model, as spt_krs_build() does. Refused are maps that are not in the group (as
 * spt_mobius_matrix() tests it, and with lambda 1 or -1 to 1e-5) or whose numbers float32 cannot
 * hold: entries beyond 2^63, and, since |lambda| counts beside |a| |d| + |b| |c|, inversions in
 * spheres that are more than 700 radii away from the origin, or chains that amount to such. */
SPT_API spt_status spt_moekrs_build(const spt_moekrs_model *model, spt_moekrs *moekrs);

/* The model as a field: a lower bound of the distance, lipschitz 1, in one pass without branches,
 * which tends to the distance at the surface; with it every step rule, cone and frame traces MöKRS,
 * which the paper holds to be impossible. How much of the distance it is depends on the maps: around
 * random models, as medians, 0.94 with one level, 0.7 with four, 0.4 with 28. moekrs is not copied.
 * It is above the distance by rounding only: by about 2^-20 of the coordinates that the levels see, as
 * lengths in the world. At the image of infinity itself, where kernel space has no point, it is 0.
 * Cost: about 2 ns a level and evaluation with 16 lanes. */
SPT_API spt_field spt_moekrs_field(const spt_moekrs *moekrs);

/* The model as a body that answers probes (Algorithm 3, mended): a ball is carried through the
 * maps, by center and radius, and tested against each kernel; one that comes out inside-out at any
 * level is not free. clearance is that of the level that decided, in its own units. */
SPT_API spt_probe spt_moekrs_probe(const spt_moekrs *moekrs);

/* Where hits lie in a model, as spt_krs_locate(); `scale` then differs from 1. */
SPT_API spt_status spt_moekrs_locate(const spt_moekrs *moekrs, int32_t component,
                                     const spt_settings *settings, size_t count,
                                     const spt_rays *rays, const spt_hits *hits,
                                     const spt_krs_places *places);

#ifdef __cplusplus
}
#endif
#endif
