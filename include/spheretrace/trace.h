/* SPDX-License-Identifier: MIT
 *
 * Tracing: rays in, hits out, by a choice of step rules.
 * What to do at a hit (normals, secondary rays, shading) is not here.
 *
 * A ray is the set of points origin + t direction, t_min <= t <= t_max. Its direction may have any
 * finite length but zero, and t is the ray's own parameter: in an instance scaled by s the host
 * transforms origin and direction and keeps t. Lengths called "world" below are t |direction|.
 *
 * A surface counts as reached at t when |f| / lipschitz < tolerance(t), with
 *     tolerance(t) = max(epsilon, pixel_radius (path + t |direction|), floor(t))
 *     floor(t)     = 2^-22 (|origin|_inf + t |direction| + size)
 * in world length. The floor is what float32 positions can resolve; without it about half of all
 * rays beyond 1e4 stall short of the surface.
 *
 * PROMISES. The results are the same bits for every width, thread count, order and number of rays
 * in a call, and for every compiler, as long as the callback's are. No memory is allocated, nothing
 * global is written, the control bits of the floating-point environment are left alone. Functions
 * may be called from any number of threads at once, and from inside callbacks; a level of recursion
 * takes at most 32 KiB of stack besides the callback's own. Callers keep the stack aligned as the
 * platform's ABI demands (16 bytes on x86-64). */
#ifndef SPHERETRACE_TRACE_H
#define SPHERETRACE_TRACE_H

#include "base.h"
#include "field.h"

#include <float.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Rays ---------------------------------------------------------------------------------- */

/* Rays as columns of float (active: int32_t), each with its own stride (base.h).
 *   origin, direction  must be present
 *   t_min   >= 0 and finite; absent: 0
 *   t_max   +infinity for a ray without end; absent: +infinity. The library lowers it so far that
 *           positions stay finite. A miss then takes 30 to 110 evaluations, unless the field has a
 *           bound: give one, or a t_max
 *   path    world length already travelled when the ray starts, >= 0, so that secondary rays
 *           inherit the pixel cone; counts up to 2^126; absent: 0
 *   active  0: leave this ray's results as they are and do not look at it; absent: all active
 * For separate arrays begin with all columns absent, `spt_rays rays = {0};` (in C++ `{}`), and set
 * rays.origin[0].first = x; rays.origin[0].stride = sizeof *x; and so on. */
typedef struct spt_rays {
    spt_column origin[3], direction[3], t_min, t_max, path, active;
} spt_rays;

/* One ray of an array of structures. Layout frozen: 32 bytes. */
typedef struct spt_ray {
    float origin[3], t_min, direction[3], t_max;
} spt_ray;

/* The view of an array of spt_ray; not NULL. */
static inline spt_rays spt_rays_of(const spt_ray *array) {
    spt_rays rays;
    spt_column absent;
    int axis;
    absent.first = NULL;
    absent.stride = 0;
    for (axis = 0; axis < 3; ++axis) {
        rays.origin[axis].first = &array->origin[axis];
        rays.origin[axis].stride = (ptrdiff_t)sizeof *array;
        rays.direction[axis].first = &array->direction[axis];
        rays.direction[axis].stride = (ptrdiff_t)sizeof *array;
    }
    rays.t_min.first = &array->t_min;
    rays.t_min.stride = (ptrdiff_t)sizeof *array;
    rays.t_max.first = &array->t_max;
    rays.t_max.stride = (ptrdiff_t)sizeof *array;
    rays.path = absent;
    rays.active = absent;
    return rays;
}

/* ---- Hits ---------------------------------------------------------------------------------- */

/* How a ray ended.
 *
 *                  t                          residual                       evaluations
 *   SPT_MISS       +infinity                  +infinity                      0 .. budget
 *   SPT_HIT        t_min <= t <= t_max        f(t), |f| / lipschitz <        1 .. budget
 *                                             tolerance(t) (but see
 *                                             SPT_FLAG_STEEP, SPT_STOP_INSIDE)
 *   SPT_LIMIT      the last t up to which     f there; +infinity where       budget
 *                  the ray is known free      nothing was evaluated
 *   SPT_NONFINITE  where f was NaN or -inf    that value, the only NaN       1 .. budget
 *                                             that ever comes out
 *   SPT_BAD_RAY    +infinity                  +infinity                      0
 *
 * SPT_LIMIT means undecided: the budget ran out first; the candidate below is the best guess.
 * SPT_BAD_RAY: origin, direction, t_min or path not finite, t_min or path negative, t_max NaN, or
 * no component of the direction reaches FLT_MIN. t_min > t_max is no bad ray but a miss. */
typedef enum spt_outcome {
    SPT_MISS = 0,
    SPT_HIT = 1,
    SPT_LIMIT = 2,
    SPT_NONFINITE = 3,
    SPT_BAD_RAY = 4
} spt_outcome;
#define SPT_OUTCOMES 5

enum {
    /* The field changed faster than its Lipschitz constant between two samples, so it is no
     * distance bound and surfaces may have been stepped over. A hit with this flag is a root of f
     * or a jump of f through zero, not certainly the first; on a jump |f| may exceed the
     * tolerance, up to infinity. Exact fields never set it. */
    SPT_FLAG_STEEP = 1u << 0,
    /* The first sample was inside (f < 0): the ray looked for the way out. With SPT_SKIP_START the
     * first sample is the first that is not skipped. */
    SPT_FLAG_INSIDE = 1u << 1,
    /* spt_trace_convex(): a sample betrayed that the body is not convex or sticks out of its bound,
     * and the ray was traced forward instead (surface.h). */
    SPT_FLAG_NOT_CONVEX = 1u << 2
};

/* Results as columns, each optional (first NULL: not wanted, and the work it needs is left out).
 * A sink may lie on a column of the same ray (t over t_max, say), not on one of another ray.
 *   t                float, the ray parameter
 *   residual         float, f at t as the callback gave it
 *   outcome          int32_t, spt_outcome
 *   evaluations      uint32_t, values asked of the callback for this ray, at most the budget;
 *                    padding is not counted
 *   flags            uint32_t, SPT_FLAG_*
 *   component        int32_t, index of the field that was hit: 0 for a single field; -1: none
 *   candidate_t,     float, the sample that came closest to the surface as seen from the eye
 *   candidate_ratio  (Keinert 3.2), and its |f| / lipschitz / max(path + t |direction|, epsilon):
 *                    the least over the samples up to which the ray is free, the earlier of
 *                    equals. Divided by 2 pixel_radius it is how many pixels the ray passed from
 *                    the silhouette; for a hit it is the hit itself as a rule, and says nothing of
 *                    bodies passed on the way. Both are +infinity where there was no finite sample
 *   fallbacks        uint32_t, over-relaxed probes that were rejected, counted to 2^24 */
typedef struct spt_hits {
    spt_sink t, residual, outcome, evaluations, flags, component, candidate_t, candidate_ratio,
        fallbacks;
} spt_hits;

/* One hit of an array of structures. Layout frozen: 36 bytes. */
typedef struct spt_hit {
    float t, residual;
    int32_t outcome;
    uint32_t evaluations, flags;
    int32_t component;
    float candidate_t, candidate_ratio;
    uint32_t fallbacks;
} spt_hit;

/* The view of an array of spt_hit, not NULL, every result wanted. Set the first of a sink to NULL
 * to leave its work out. */
static inline spt_hits spt_hits_of(spt_hit *array) {
    spt_hits hits;
    const ptrdiff_t stride = (ptrdiff_t)sizeof *array;
    hits.t.first = &array->t;
    hits.residual.first = &array->residual;
    hits.outcome.first = &array->outcome;
    hits.evaluations.first = &array->evaluations;
    hits.flags.first = &array->flags;
    hits.component.first = &array->component;
    hits.candidate_t.first = &array->candidate_t;
    hits.candidate_ratio.first = &array->candidate_ratio;
    hits.fallbacks.first = &array->fallbacks;
    hits.t.stride = hits.residual.stride = hits.outcome.stride = hits.evaluations.stride = stride;
    hits.flags.stride = hits.component.stride = hits.fallbacks.stride = stride;
    hits.candidate_t.stride = hits.candidate_ratio.stride = stride;
    return hits;
}

/* ---- Step rules ---------------------------------------------------------------------------- */

/* A step rule. Each is an object that a function returns, so that a static link carries only the
 * rules a program names. All are safe: for a field that keeps its promise none steps over a
 * crossing of zero. r is the radius of the unbounding sphere at the current sample. */
typedef struct spt_method spt_method;

/* Steps of r (Hart 1996; Keinert et al. 2014, Listing 1). */
SPT_API const spt_method *spt_basic(void);

/* Steps of relaxation * r; where the sphere at the far end does not reach back it returns to the
 * plain step. A rejected probe is remembered and reached for free once the sphere of a later sample
 * meets its own (Keinert et al. 2014, section 3.1, with its "trivial extension"). */
SPT_API const spt_method *spt_relaxed(void);

/* Steps to where the next sphere would touch this one if the surface were a plane, as the last two
 * samples see it (Bálint & Valasek 2018, section 3, Equation 1). */
SPT_API const spt_method *spt_enhanced(void);

/* The same step from a slope averaged along the ray (Bán & Valasek 2023), with the recovery of
 * rejected probes. */
SPT_API const spt_method *spt_auto_relaxed(void);

/* The step of spt_enhanced(), at most step_cap * r, with the recovery of rejected probes. The
 * default: of the rules that need no licence it takes the fewest evaluations on average and, like
 * all of them, loses nothing of a field that keeps its promise. Of one that does not, every rule
 * that probes may lose more than spt_basic(); `make report` shows how much. */
SPT_API const spt_method *spt_adaptive(void);

/* For fields with SPT_FIELD_CONVEX, refused without: along a ray a convex f lies above its secant,
 * so the secant's root is a safe step, and a rising f is a certain miss. Starts inside the body
 * take plain steps. */
SPT_API const spt_method *spt_convex(void);

/* "basic", "relaxed" and so on; NULL for NULL. */
SPT_API const char *spt_method_name(const spt_method *method);

/* ---- Settings ------------------------------------------------------------------------------ */

enum {
    /* The ray starts on a surface that is not meant (a secondary ray): steps of one tolerance
     * until |f| / lipschitz reaches the tolerance, and only then starts to trace. What lies in the
     * skipped stretch is not seen. Each step is an evaluation. A ray that comes to its field's
     * bound from more than a tolerance away begins there in the open, and skips nothing. */
    SPT_SKIP_START = 1u << 0,
    /* A ray whose first sample is inside ends there at once: SPT_HIT with SPT_FLAG_INSIDE.
     * Otherwise it is traced to the way out. */
    SPT_STOP_INSIDE = 1u << 1,
    /* What the candidate of a ray is (at most one of the two; neither: as spt_hits says). Both look
     * between the samples, too: the spheres of two neighbours meet in a circle, whose radius is a
     * lower bound of the distance to any surface there, and exact for one that touches it. A ray
     * that hits nothing takes one more sample, at t_max, if the budget and a t_max below 2^62 in
     * world length (or so) allow; the outcome is that without it. spt_convex() takes plain steps,
     * and more of them. Of a field with a bound only the way inside it counts. In frames cones and
     * culling leave out what they pass: use SPT_FRAME_NO_CONES | SPT_FRAME_NO_CULLING.
     * PENUMBRA: the least of that distance over t |direction|, an estimate of the tangent of the
     *   angle by which the ray misses a surface as seen from its own origin, whatever its path; see
     *   spt_penumbra() (surface.h)
     * CLOSEST: the least of that distance, world length, a lower bound; and where the ray passes
     *   closest. With the rules' default numbers it is 0.9 of the true distance on average */
    SPT_CANDIDATE_PENUMBRA = 1u << 2,
    SPT_CANDIDATE_CLOSEST = 1u << 3,
    /* Read by spt_trace_convex() only: each ray from inside checks what it relies on. */
    SPT_CHECK_CONVEX = 1u << 4
};

typedef struct spt_settings {
    size_t struct_size;       /* set by spt_settings_default() */
    const spt_method *method; /* spt_basic() .. spt_convex() */
    uint32_t budget;          /* most evaluations a ray may take, rejected probes included; 0 is
                               * legal and gives SPT_LIMIT at the start. Default 128 */
    float epsilon;            /* absolute tolerance, world length, > 0. Default 1e-4 */
    float pixel_radius;       /* half a pixel at distance 1, >= 0; 0: no pixel cone. For a pinhole
                               * camera tan(fov / 2) / pixels, the lesser of both axes. Default 0 */
    float size;               /* largest coordinate the callback works with, for the rounding
                               * floor, world length, >= 0; 0: unknown. A bound of the field
                               * counts by itself. Default 0 */
    float relaxation;         /* spt_relaxed: step over r, in [1, 2). Default 1.4 */
    float extrapolation;      /* spt_enhanced, spt_adaptive: weight of the inferred second radius,
                               * in [0, 1]. Default 0.88 */
    float slope_blend;        /* spt_auto_relaxed: weight of the newest slope, in (0, 1]. Default
                               * 0.6 */
    float step_cap;           /* spt_adaptive: longest step over r, in [1, 100]. Default 6 */
    uint32_t max_lanes;       /* 1, 4, 8 or 16: no wider than this; 0: the widest there is. A width
                               * the machine lacks falls to the next lower one */
    uint32_t flags;           /* SPT_SKIP_START and so on. Default 0 */
} spt_settings;

/* The defaults above. The numbers of the rules are those with the fewest evaluations over ten kinds
 * of scene and two stops; within half a per cent the one that is nearest to spt_basic(). */
static inline spt_settings spt_settings_default(void) {
    spt_settings settings = {0, NULL, 128, 1e-4f, 0.0f, 0.0f, 1.4f, 0.88f, 0.6f, 6.0f, 0, 0};
    settings.struct_size = sizeof settings;
    settings.method = spt_adaptive();
    return settings;
}

/* ---- The call ------------------------------------------------------------------------------ */

/* What a call did. Every call ADDS to the counts, so that one structure sums many calls; threads
 * use one each. */
typedef struct spt_statistics {
    size_t struct_size;              /* set by spt_statistics_default() */
    uint64_t rays;                   /* active rays */
    uint64_t outcomes[SPT_OUTCOMES]; /* rays by spt_outcome */
    uint64_t evaluations;            /* values asked for rays */
    uint64_t slots;      /* the same with padding: lanes that ran through the callback */
    uint64_t passes;     /* batches evaluated, of at most SPT_BATCH points each */
    uint64_t fallbacks;  /* over-relaxed probes that were rejected */
    float largest_slope; /* of f seen between two samples, rounding deducted, over all calls; more
                          * than lipschitz means: no distance bound */
    uint32_t lanes;      /* the width that ran last: 1, 4, 8 or 16 */
    uint64_t cone_evaluations; /* values asked for cones (frame.h), in none of the above */
    uint64_t kept, culled;     /* components that tiles kept and left out, summed over tiles */
} spt_statistics;

/* All counts zero. */
static inline spt_statistics spt_statistics_default(void) {
    spt_statistics statistics = {0, 0, {0, 0, 0, 0, 0}, 0, 0, 0, 0, 0.0f, 0, 0, 0, 0};
    statistics.struct_size = sizeof statistics;
    return statistics;
}

/* The share of evaluated lanes that held a ray, in [0, 1]; 1 where nothing ran. */
static inline double spt_utilisation(const spt_statistics *statistics) {
    return statistics->slots != 0 ? (double)statistics->evaluations / (double)statistics->slots
                                  : 1.0;
}

/* The widest vectors, in floats, that this machine and its operating system run and this library
 * was built for: 1, 4, 8 or 16. Costs about a nanosecond. */
SPT_API int spt_lanes(void);

/* Traces count rays against one field.
 *   field, settings  as documented above; copied as far as their struct_size reaches
 *   count            number of rays; with 0 nothing is traced, and rays and hits may be NULL; field
 *                    and settings are checked all the same
 *   rays             where to read them
 *   hits             where to write the results; sinks may be absent, the structure may not
 *   statistics       or NULL
 * Returns SPT_BAD_ARGUMENT, with nothing written and no callback called, for: a NULL pointer; a
 * struct_size smaller than the first version's; a field without callback; any number outside its
 * documented range; an unknown flag; an absent origin or direction column; a sink of stride 0 with
 * count > 1; a count whose columns cannot lie in memory; spt_convex() without SPT_FIELD_CONVEX. */
SPT_API spt_status spt_trace(const spt_field *field, const spt_settings *settings, size_t count,
                             const spt_rays *rays, const spt_hits *hits,
                             spt_statistics *statistics);

#ifdef __cplusplus
}
#endif
#endif
