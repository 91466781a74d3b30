/* SPDX-License-Identifier: MIT
 *
 * The scalar loops, one for every scene and step rule. Compiled by itself with -O3 -march=native
 * (and -ffp-contract=off, as everything: a fused operation would be another result). */
#include "scalar_loop.h"

#include <float.h>
#include <string.h>

#include "bench_scenes.h"
#include "scalar_bound.h"

/* Masks for the sake of vectors; for one number each is an instruction. */
#include <spheretrace/shapes_math.h>
#define spt_positive(x) spt_greatest((x), 0)
#define spt_negative(x) spt_least((x), 0)

#define SPT_LANES 1
#define SCENE(...)
#include "scenes/scene_source.h"
#include "scenes/scenes_list.h"

typedef float scalar_distance_fn(spt_point p);

/* The step rules, as constants. */
typedef enum scalar_rule {
#define X(scene, method, convex) rule_##method,
    BENCH_METHODS(X, any)
#undef X
} scalar_rule;

typedef struct scalar_ray {
    float origin[3], direction[3], t_max;
    float scale; /* radius in t = scale * f */
    float epsilon, pixel_radius, floor_at_0;
} scalar_ray;

SPT_SHAPE float scalar_floor(const scalar_ray *ray, float t) {
    return SCALAR_FLOOR * t + ray->floor_at_0;
}

SPT_SHAPE float scalar_tolerance(const scalar_ray *ray, float t, float floor) {
    return scalar_max(ray->epsilon, scalar_max(ray->pixel_radius * t, floor));
}

SPT_SHAPE float scalar_sample(scalar_distance_fn *distance, const scalar_ray *ray, float t) {
    return distance(spt_point_of(ray->origin[0] + t * ray->direction[0],
                                 ray->origin[1] + t * ray->direction[1],
                                 ray->origin[2] + t * ray->direction[2]));
}

/* Whether spheres of radius a and b, `apart`, overlap by more than rounding can feign. With a probe
 * beyond the first sphere, apart > a, none that is inside does: the margin covers the rounding. */
SPT_SHAPE int scalar_overlap(float a, float b, float apart, float floor) {
    return apart * (1.0f + SCALAR_FLOOR) + floor < a + b;
}

SPT_SHAPE void scalar_leave(bench_hit *hit, spt_outcome outcome, uint32_t evaluations, float t,
                            float value) {
    hit->t = outcome != SPT_MISS ? t : INFINITY;
    hit->residual = outcome != SPT_MISS ? value : INFINITY;
    hit->outcome = (int32_t)outcome;
    hit->evaluations = evaluations;
}

/* The last certified sample. */
typedef struct scalar_standing {
    float t, value, r;
    uint32_t evaluations;
} scalar_standing;

/* Between the last certified sample and one at b on the other side. Seldom: a field that is no
 * distance bound. */
static void scalar_close_bracket(scalar_distance_fn *distance, const scalar_ray *ray,
                                 uint32_t budget, const scalar_standing *at, float b, float fb,
                                 bench_hit *hit) {
    float a = at->t, fa = at->value;
    uint32_t evaluations = at->evaluations;
    for (int turn = 0;; ++turn) {
        const float width = b - a, margin = 0.05f * width;
        const float before = fa * ray->scale, behind = fb * ray->scale;
        const float chord = a + width * (before / (before - behind));
        const float split = turn % 2 == 0 ? chord : a + 0.5f * width;
        const float t = split > a + margin ? scalar_min(split, b - margin) : a + margin;
        const int narrow = width <= scalar_tolerance(ray, a, scalar_floor(ray, a));
        if (narrow || !(t > a && t < b) || turn == 40) {
            scalar_leave(hit, SPT_HIT, evaluations, a, fa);
            return;
        }
        if (evaluations >= budget) {
            scalar_leave(hit, SPT_LIMIT, evaluations, a, fa);
            return;
        }
        const float value = scalar_sample(distance, ray, t), radius = value * ray->scale;
        const int close = fabsf(radius) < scalar_tolerance(ray, t, scalar_floor(ray, t));
        const int number = value >= -FLT_MAX;
        ++evaluations;
        if (!number || close) {
            scalar_leave(hit, number ? SPT_HIT : SPT_NONFINITE, evaluations, t, value);
            return;
        }
        if (radius < 0.0f) {
            b = t;
            fb = value;
        } else {
            a = t;
            fa = value;
        }
    }
}

/* What a rule remembers: the next radius over this one of the planar rules, the mean slope M of
 * auto_relaxed, the last step and the radius before it of convex. */
typedef struct scalar_memory {
    float ratio, slope, step, before;
} scalar_memory;

SPT_SHAPE float scalar_step(scalar_rule rule, const spt_settings *settings, const scalar_ray *ray,
                            const scalar_memory *memory, float t, float r, int *missed) {
    if (rule == rule_relaxed) return settings->relaxation * r;
    if (rule == rule_enhanced || rule == rule_adaptive) {
        const float step = r + settings->extrapolation * (r * memory->ratio);
        return rule == rule_adaptive ? scalar_min(step, settings->step_cap * r) : step;
    }
    if (rule == rule_auto_relaxed) return r * (2.0f / (1.0f - scalar_min(memory->slope, 0.98f)));
    if (rule == rule_convex && memory->step > 0.0f) {
        const float margin = 0.5f * scalar_floor(ray, t);
        const float drop = (memory->before - r) + (margin + margin);
        *missed = !(drop > 0.0f);
        return (r - margin) / drop * memory->step;
    }
    return r;
}

SPT_SHAPE void scalar_accepted(scalar_rule rule, const spt_settings *settings, float step,
                               float before, float after, scalar_memory *memory) {
    if (rule == rule_enhanced || rule == rule_adaptive) {
        const float drop = scalar_min(scalar_max(before - after, -0.98f * step), step);
        memory->ratio = (step - drop) / (step + drop);
    } else if (rule == rule_auto_relaxed) {
        memory->slope += settings->slope_blend * ((after - before) / step - memory->slope);
    } else if (rule == rule_convex) {
        memory->step = step;
        memory->before = before;
    }
}

/* The sample at t_min. Returns whether the ray ends there. */
SPT_SHAPE int scalar_start(scalar_distance_fn *distance, scalar_ray *ray, scalar_standing *at,
                           bench_hit *hit) {
    at->value = scalar_sample(distance, ray, at->t);
    at->evaluations = 1;
    ray->scale = at->value < 0.0f ? -ray->scale : ray->scale;
    at->r = at->value * ray->scale;
    const int number = at->value >= -FLT_MAX;
    const float tolerance = scalar_tolerance(ray, at->t, scalar_floor(ray, at->t));
    if (number && !(at->r < tolerance)) return 0;
    scalar_leave(hit, number ? SPT_HIT : SPT_NONFINITE, 1, at->t, at->value);
    return 1;
}

/* Whether the ray ends with a certified sample at t. */
SPT_SHAPE int scalar_ends(scalar_distance_fn *distance, const scalar_ray *ray, uint32_t budget,
                          const scalar_standing *at, float t, float value, float floor,
                          bench_hit *hit) {
    const float tolerance = scalar_tolerance(ray, t, floor), r = value * ray->scale;
    if (r >= tolerance) return 0;
    if (!(value >= -FLT_MAX)) {
        scalar_leave(hit, SPT_NONFINITE, at->evaluations, t, value);
    } else if (!(-tolerance < r)) {
        scalar_close_bracket(distance, ray, budget, at, t, value, hit);
    } else {
        scalar_leave(hit, SPT_HIT, at->evaluations, t, value);
    }
    return 1;
}

/* A rejected probe that may be reached later; t 0: none. */
typedef struct scalar_pending {
    float t, value, r;
} scalar_pending;

/* One ray, marched from at->t. */
SPT_SHAPE void scalar_march(scalar_distance_fn *distance, scalar_rule rule,
                            const spt_settings *settings, scalar_ray *ray, float t_min,
                            bench_hit *hit) {
    const int probes = rule != rule_basic && rule != rule_convex;
    const int keeps = probes && rule != rule_enhanced;
    scalar_memory memory = {0.0f, -1.0f, 0.0f, 0.0f}; /* all make a plain first step */
    scalar_pending pending = {0.0f, 0.0f, 0.0f};
    scalar_standing at = {t_min, 0.0f, 0.0f, 0};
    if (scalar_start(distance, ray, &at, hit)) return;
    for (int plain = 0;;) {
        int missed = !(at.t + at.r <= ray->t_max);
        float step = at.r;
        if (!plain && !missed) {
            step = scalar_step(rule, settings, ray, &memory, at.t, at.r, &missed);
            step = scalar_max(scalar_min(step, ray->t_max - at.t), at.r);
            if (keeps && at.t < pending.t && pending.t - pending.r < at.t + step) step = at.r;
        }
        const float next = scalar_min(at.t + step, ray->t_max);
        if (missed || !(at.t < next) || at.evaluations == settings->budget) {
            scalar_leave(hit, missed ? SPT_MISS : SPT_LIMIT, at.evaluations, at.t, at.value);
            return;
        }
        const float value = scalar_sample(distance, ray, next), r = value * ray->scale;
        const float made = next - at.t, floor = scalar_floor(ray, next);
        ++at.evaluations;
        plain = probes && next > at.t + at.r && !scalar_overlap(at.r, r, made, floor);
        if (plain) {
            if (rule == rule_auto_relaxed) memory.slope = -1.0f;
            pending = (scalar_pending){r > 0.0f ? next : 0.0f, value, r};
            continue;
        }
        if (scalar_ends(distance, ray, settings->budget, &at, next, value, floor, hit)) return;
        scalar_accepted(rule, settings, made, at.r, r, &memory);
        at = (scalar_standing){next, value, r, at.evaluations};
        if (!keeps || !(at.t < pending.t)) continue;
        const float there = scalar_floor(ray, pending.t), leap = pending.t - at.t;
        if (!scalar_overlap(at.r, pending.r, leap, there)) continue;
        scalar_accepted(rule, settings, leap, at.r, pending.r, &memory);
        at = (scalar_standing){pending.t, pending.value, pending.r, at.evaluations};
        if (at.r < scalar_tolerance(ray, at.t, there)) {
            scalar_leave(hit, SPT_HIT, at.evaluations, at.t, at.value);
            return;
        }
    }
}

SPT_SHAPE void scalar_trace(scalar_distance_fn *distance, scalar_rule rule, const spt_field *field,
                            const spt_settings *settings, size_t count, const spt_ray *rays,
                            bench_hit *hits) {
    const float inverse_lipschitz = 1.0f / field->lipschitz;
    const float extent = field->bound != NULL ? scalar_bound_size(field->bound) : 0.0f;
    const float size = scalar_max(settings->size, extent);
    for (size_t i = 0; i < count; ++i) {
        const spt_ray *from = &rays[i];
        const float *const d = from->direction, *const o = from->origin;
        const float length = sqrtf(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        const float reach = scalar_max(scalar_max(fabsf(o[0]), fabsf(o[1])), fabsf(o[2]));
        float t_min = from->t_min, t_max = from->t_max;
        if (field->bound != NULL) {
            scalar_narrow(field->bound, from, length, reach, &t_min, &t_max);
        }
        if (!(t_min <= t_max)) {
            scalar_leave(&hits[i], SPT_MISS, 0, 0.0f, 0.0f);
            continue;
        }
        scalar_ray ray = {{o[0], o[1], o[2]},
                          {d[0], d[1], d[2]},
                          t_max,
                          inverse_lipschitz / length,
                          settings->epsilon / length,
                          settings->pixel_radius,
                          (SCALAR_FLOOR * reach + SCALAR_FLOOR * size) / length};
        scalar_march(distance, rule, settings, &ray, t_min, &hits[i]);
    }
}

#define LOOP(scene, method, convex) \
    static void trace_##scene##_##method(const spt_field *field, const spt_settings *settings, \
                                         size_t count, const spt_ray *rays, bench_hit *hits) { \
        scalar_trace(scene_##scene##_distance, rule_##method, field, settings, count, rays, hits); \
    }
#define LOOPS(scene, ...) BENCH_METHODS(LOOP, scene)
BENCH_SCENES(LOOPS)

static void prepare_scenes(void) {
#define SCENE(...)
#define SCENE_BUILT(scene, ...) scene_##scene##_prepare();
#include "scenes/scenes_list.h"
}

scalar_trace_fn *scalar_loop_of(const char *scene, const char *method) {
    static const struct {
        const char *scene, *method;
        scalar_trace_fn *trace;
    } loops[] = {
#define ENTRY(scene, method, convex) {#scene, #method, trace_##scene##_##method},
#define ENTRIES(scene, ...) BENCH_METHODS(ENTRY, scene)
        BENCH_SCENES(ENTRIES)};
    prepare_scenes();
    for (size_t i = 0; i < sizeof loops / sizeof loops[0]; ++i) {
        if (strcmp(loops[i].scene, scene) == 0 && strcmp(loops[i].method, method) == 0) {
            return loops[i].trace;
        }
    }
    return NULL;
}
