/* SPDX-License-Identifier: MIT
 *
 * The driver of every step rule: one pass over a chunk. A template, included once a file.
 * Parameters: SPT_LANES, and a step rule (methods/methods.h) included before. Defines the
 * halves of a pass, march_samples() and march_points().
 *
 * The logic is lane-local throughout: no ray decides anything for another, which is what makes the
 * results independent of width, order and neighbours.
 *
 * Where the papers' listings differ (each difference measured on adversarial rays): the overlap
 * test is strict, signed and has the margin of the rounding floor, since spheres that only touch
 * may touch on the surface (Keinert et al. 2014, Listing 2; Bálint & Valasek 2018, Algorithms 2-3);
 * a rejected probe goes back to exactly t + r, where Listing 2 lands short of it; t_max is tested
 * on certified intervals only; budgets count evaluations; the sign is that at t_min. */
#ifndef SPTI_MARCH_KERNEL_H
#define SPTI_MARCH_KERNEL_H

#include <float.h>

#include "ray_kernel.h"

/* Everything uniform, in all lanes. */
typedef struct march_constants {
    spti_parameters rule;
    spt_wide pixel_radius, margin;
    spt_mask first;
    uint32_t between; /* SPT_CANDIDATE_*: of candidates between samples */
    spt_wide inverse_lipschitz;
} march_constants;

/* A ray between two samples. */
typedef struct march_state {
    spt_wide t, value, radius;
    spt_wide memory[2];
    spt_wide pending_t, pending_value;
} march_state;

/* What was seen on the way, as far as it is wanted. */
typedef struct march_audit {
    spt_wide steepest, candidate_t, candidate_ratio;
} march_audit;

/* The constants of the rays of a vector. */
typedef struct march_rays {
    spt_wide scale, t_max, epsilon, path, floor_at_0;
} march_rays;

/* Where the arrays of a chunk are. In registers: compilers must think that the store of a vector
 * may change what the chunk says of it. */
typedef struct march_arrays {
    float (*array)[SPTI_ROOM];
    const float *distance;
} march_arrays;

SPTI_INLINE spt_wide march_load(const march_arrays *arrays, int array, size_t at) {
    return spt_load(&arrays->array[array][at]);
}

SPTI_INLINE void march_store(const march_arrays *arrays, int array, size_t at, spt_wide a) {
    spt_store(&arrays->array[array][at], a);
}

SPTI_INLINE void march_add_fate(uint16_t *fate, spt_mask lanes, unsigned shift) {
    *fate = (uint16_t)(*fate | spt_mask_bits(lanes) << shift);
}

SPTI_INLINE spt_wide march_tolerance(const march_constants *all, const march_rays *rays, spt_wide t,
                                     spt_wide floor) {
    return ray_tolerance(rays->epsilon, all->pixel_radius, rays->path, floor, t);
}

/* Whether the spheres of radius a and b, `step` apart, overlap by more than rounding can feign, in
 * the lanes of the mask. */
SPTI_INLINE spt_mask march_overlap(const march_constants *all, spt_mask mask, spt_wide a,
                                   spt_wide b, spt_wide step, spt_wide floor) {
    return spti_less_in(mask, spt_add(spt_mul(step, all->margin), floor), spt_add(a, b));
}

/* Takes the point at t, `apart` from any surface, where its ratio is the least so far. */
SPTI_INLINE void march_compare(const march_constants *all, const march_rays *rays, spt_wide apart,
                               spt_wide t, spt_mask certified, march_audit *audit) {
    spt_wide ratio;
    if (all->between & SPT_CANDIDATE_CLOSEST) {
        ratio = spt_div(spt_mul(apart, all->inverse_lipschitz), spt_abs(rays->scale));
    } else {
        const spt_wide path = all->between != 0 ? spt_splat(0.0f) : rays->path;
        ratio = spt_div(apart, spt_max(spt_add(path, t), rays->epsilon));
    }
    const spt_mask nearer = spt_mask_and(certified, spt_less(ratio, audit->candidate_ratio));
    audit->candidate_ratio = spt_select(nearer, ratio, audit->candidate_ratio);
    audit->candidate_t = spt_select(nearer, t, audit->candidate_t);
}

/* Screen-space candidate (Keinert et al. 2014, section 3.2): the least radius over distance from
 * the eye, measured along the whole path, and never divided by zero. Or, between the samples as
 * well, over the distance from the ray's origin, or over none. */
SPTI_INLINE void march_candidate(const march_constants *all, const march_rays *rays,
                                 const spti_pair *pair, const march_state *ray, spt_mask certified,
                                 march_audit *audit) {
    const spt_wide radius = spt_abs(ray->radius);
    if (all->between != 0) {
        spt_wide back;
        const spt_wide apart = ray_closest(pair->before, pair->after, pair->step, radius, &back);
        march_compare(all, rays, apart, spt_sub(ray->t, back), certified, audit);
    }
    march_compare(all, rays, radius, ray->t, certified, audit);
}

/* The Lipschitz audit: the slope between two samples that rounding cannot explain. Infinite values
 * say "nothing here" and have no slope. */
SPTI_INLINE void march_slope(const spti_pair *pair, spt_wide floor, spt_mask certified,
                             march_audit *audit) {
    const spt_wide change = spt_abs(spt_sub(pair->after, pair->before));
    const spt_wide most = spt_splat(FLT_MAX);
    const spt_wide beyond = spt_sub(change, spt_add(floor, floor));
    const spt_wide slope = spt_min(spt_div(beyond, pair->step), most);
    const spt_mask finite = spt_mask_and(certified, spt_less_equal(change, most));
    const spt_mask steeper = spti_less_in(finite, audit->steepest, slope);
    audit->steepest = spt_select(steeper, slope, audit->steepest);
}

/* The rule's memory after a certified sample, in the lanes of the mask. No ray leaps in its first
 * pass. */
SPTI_INLINE void march_accept(const march_constants *all, const spti_pair *pair, spt_mask moved,
                              march_state *ray) {
    spt_wide started[2], accepted[2];
    for (int i = 0; i < 2; ++i) started[i] = accepted[i] = ray->memory[i];
    rule_start(started);
    rule_accepted(&all->rule, pair, accepted);
    for (int i = 0; i < rule_memory; ++i) {
        accepted[i] = spt_select(all->first, started[i], accepted[i]);
        ray->memory[i] = spt_select(moved, accepted[i], ray->memory[i]);
    }
}

/* The point to evaluate next, for rays that go on. pending is a constant: 0 where no ray of the pass
 * keeps a probe. */
SPTI_INLINE spt_wide march_propose(const march_constants *all, const march_rays *rays,
                                   const march_state *ray, int pending, spt_mask rejected,
                                   spt_mask *missed) {
    const spt_mask inside = spt_less(rays->scale, spt_splat(0.0f));
    const spti_standing standing = {ray->radius, ray_floor(rays->floor_at_0, ray->t),
                                    spti_mask_not(inside)};
    const spt_mask covered = spt_less_equal(spt_add(ray->t, ray->radius), rays->t_max);
    spt_mask rising = spt_mask_splat(0);
    spt_wide step = rule_step(&all->rule, &standing, ray->memory, &rising);
    *missed = spti_mask_not(covered);
    if (rule_needs_convex && all->between != 0) {
        /* Between samples of plain steps something is to be seen; and where f rises it may still
         * fall as seen from the origin. */
        step = ray->radius;
        if (all->between & SPT_CANDIDATE_PENUMBRA) rising = spt_mask_splat(0);
    }
    if (rule_needs_convex) *missed = spt_mask_or(*missed, rising);
    if (rule_probes || rule_needs_convex) { /* otherwise it is the radius */
        step = spt_max(spt_min(step, spt_sub(rays->t_max, ray->t)), ray->radius);
        step = spt_select(rejected, ray->radius, step);
    }
    if (pending) {
        /* A probe beyond where the pending sphere begins is certified by that or not at all. */
        const spt_wide pending_radius = spt_mul(ray->pending_value, rays->scale);
        const spt_wide begins = spt_sub(ray->pending_t, pending_radius);
        const spt_mask ahead = spt_less(ray->t, ray->pending_t);
        const spt_mask beyond = spti_less_in(ahead, begins, spt_add(ray->t, step));
        step = spt_select(beyond, ray->radius, step);
    }
    return spt_min(spt_add(ray->t, step), rays->t_max);
}

/* What came back from the callback and what it means, lane by lane. */
typedef struct march_sample {
    spt_wide t, value, radius, floor, tolerance;
    spti_pair pair; /* with the certified sample before */
    spt_mask legal; /* neither NaN nor -infinity */
    spt_mask rejected, moved, hit, nonfinite, bracketed;
    spt_mask settled; /* one of the last three */
} march_sample;

/* A probe beyond the certified sphere counts only if its own sphere reaches back; what else it
 * shows, even NaN, is no event. (-infinity from inside looks like a large radius, hence legal.) A
 * probe that lands inside the surface could end the ray at t + radius with a bound of the residual;
 * but a hit's residual is f at the hit, and the evaluation that this costs is rare: one scene of
 * ten took 8.97 evaluations a ray instead of 8.95, the others the same. */
SPTI_INLINE void march_judge(const march_constants *all, const march_rays *rays,
                             const march_state *ray, march_sample *sample) {
    const spt_wide zero = spt_splat(0.0f), step = spt_sub(sample->t, ray->t);
    sample->radius = spt_mul(sample->value, rays->scale);
    sample->floor = ray_floor(rays->floor_at_0, sample->t);
    sample->tolerance = march_tolerance(all, rays, sample->t, sample->floor);
    sample->legal = spt_less_equal(spt_splat(-FLT_MAX), sample->value);
    sample->rejected = spt_mask_splat(0);
    spt_mask certified = spt_mask_splat(1);
    if (rule_probes) {
        /* A probe that is inside does not reach back either: its radius is negative, and the step
         * exceeds the other one. */
        const spt_mask over = spt_less(spt_add(ray->t, ray->radius), sample->t);
        const spt_mask reaches =
            march_overlap(all, sample->legal, ray->radius, sample->radius, step, sample->floor);
        sample->rejected = spt_mask_and_not(over, reaches);
        certified = spti_mask_not(sample->rejected);
    }
    const spt_mask number = rule_probes ? spt_mask_and(certified, sample->legal) : sample->legal;
    sample->bracketed = spti_not_less_in(number, spt_sub(zero, sample->tolerance), sample->radius);
    const spt_mask reached = spti_less_in(number, sample->radius, sample->tolerance);
    sample->nonfinite = spt_mask_and_not(certified, sample->legal);
    sample->moved = spt_mask_and_not(certified, sample->bracketed);
    sample->hit = spt_mask_and_not(reached, sample->bracketed);
    sample->settled = spt_mask_or(reached, sample->nonfinite);
    sample->pair.step = spt_max(step, spt_splat(FLT_MIN));
    sample->pair.before = ray->radius;
    sample->pair.after = sample->radius;
}

/* Goes where the sample is certified. The memory of a rule that may leap is brought up to date
 * behind the leap, with one division less, unless it must see both samples. */
SPTI_INLINE void march_move(const march_constants *all, const march_sample *sample,
                            march_state *ray) {
    if (rule_blends || !rule_pending) march_accept(all, &sample->pair, sample->moved, ray);
    if (rule_probes) {
        spt_wide turned_down[2] = {ray->memory[0], ray->memory[1]};
        rule_rejected(turned_down);
        for (int i = 0; i < rule_memory; ++i) {
            ray->memory[i] = spt_select(sample->rejected, turned_down[i], ray->memory[i]);
        }
    }
    ray->t = spt_select(sample->moved, sample->t, ray->t);
    ray->value = spt_select(sample->moved, sample->value, ray->value);
    ray->radius = spt_select(sample->moved, sample->radius, ray->radius);
}

/* Keeps a rejected probe that was outside, and goes to the kept one, at no evaluation, as soon as
 * the certified sphere meets its own (the "trivial extension" of Keinert et al. 2014, 3.1). The
 * sample's pair becomes that of the leap where there is one. */
SPTI_INLINE void march_leap(const march_constants *all, const march_rays *rays, unsigned wants,
                            march_sample *sample, march_state *ray, march_audit *audit) {
    const spt_wide zero = spt_splat(0.0f);
    const spt_mask outside = spti_less_in(sample->legal, zero, sample->radius);
    const spt_wide kept = spt_select(outside, sample->t, zero);
    ray->pending_t = spt_select(sample->rejected, kept, ray->pending_t);
    ray->pending_value = spt_select(sample->rejected, sample->value, ray->pending_value);
    const spt_wide radius = spt_mul(ray->pending_value, rays->scale);
    const spt_wide floor = ray_floor(rays->floor_at_0, ray->pending_t);
    const spt_wide leap = spt_sub(ray->pending_t, ray->t);
    const spt_mask ahead = spti_less_in(spti_mask_not(sample->settled), ray->t, ray->pending_t);
    const spt_mask leaps = march_overlap(all, ahead, ray->radius, radius, leap, floor);
    const spti_pair leapt = {spt_max(leap, spt_splat(FLT_MIN)), ray->radius, radius};
    if (wants & SPTI_WANT_SLOPE) march_slope(&leapt, floor, leaps, audit);
    if (rule_blends) {
        march_accept(all, &leapt, leaps, ray);
    } else {
        sample->pair.step = spt_select(leaps, leapt.step, sample->pair.step);
        sample->pair.before = spt_select(leaps, leapt.before, sample->pair.before);
        sample->pair.after = spt_select(leaps, leapt.after, sample->pair.after);
        sample->moved = spt_mask_or(sample->moved, leaps);
    }
    ray->t = spt_select(leaps, ray->pending_t, ray->t);
    ray->value = spt_select(leaps, ray->pending_value, ray->value);
    ray->radius = spt_select(leaps, radius, ray->radius);
    const spt_mask close =
        spti_less_in(leaps, ray->radius, march_tolerance(all, rays, ray->t, floor));
    sample->hit = spt_mask_or(sample->hit, close);
    sample->settled = spt_mask_or(sample->settled, close);
    if (wants & SPTI_WANT_CANDIDATE) march_candidate(all, rays, &leapt, ray, leaps, audit);
}

SPTI_INLINE void march_load_state(const march_arrays *arrays, size_t at, spt_wide scale,
                                  march_state *ray) {
    const spt_wide zero = spt_splat(0.0f);
    ray->t = march_load(arrays, SPTI_T, at);
    ray->value = march_load(arrays, SPTI_VALUE, at);
    ray->radius = spt_mul(ray->value, scale);
    ray->memory[0] = rule_memory > 0 ? march_load(arrays, SPTI_MEMORY, at) : zero;
    ray->memory[1] = rule_memory > 1 ? march_load(arrays, SPTI_MEMORY + 1, at) : zero;
}

SPTI_INLINE void march_store_state(const march_arrays *arrays, size_t at, const march_state *ray) {
    march_store(arrays, SPTI_T, at, ray->t);
    march_store(arrays, SPTI_VALUE, at, ray->value);
    for (int i = 0; i < rule_memory; ++i) march_store(arrays, SPTI_MEMORY + i, at, ray->memory[i]);
}

/* As ray_point(). */
SPTI_INLINE spt_wide march_point(const march_arrays *arrays, int axis, size_t at, spt_wide t) {
    const spt_wide along = spt_mul(t, march_load(arrays, SPTI_DIRECTION + axis, at));
    return spt_add(march_load(arrays, SPTI_ORIGIN + axis, at), along);
}

/* The points at t, to be evaluated next. */
SPTI_INLINE void march_store_points(const march_arrays *arrays, size_t at, spt_wide t) {
    for (int axis = 0; axis < 3; ++axis) {
        march_store(arrays, SPTI_X + axis, at, march_point(arrays, axis, at, t));
    }
}

/* One vector. wants is a constant. Adds the fates at `shift`, the vector's place in its group.
 * Returns whether any of its rays keeps a probe. */
SPTI_INLINE int march_vector(const march_arrays *arrays, const march_constants *all, size_t at,
                             unsigned shift, unsigned wants, spti_fates *fates) {
    const march_rays rays = {march_load(arrays, SPTI_SCALE, at), march_load(arrays, SPTI_T_MAX, at),
                             march_load(arrays, SPTI_EPSILON, at),
                             march_load(arrays, SPTI_PATH, at),
                             march_load(arrays, SPTI_FLOOR_AT_0, at)};
    march_audit audit;
    march_state ray;
    march_sample sample;
    sample.t = march_load(arrays, SPTI_PROBE, at);
    sample.value = spt_load(&arrays->distance[at]);
    march_load_state(arrays, at, rays.scale, &ray);
    march_judge(all, &rays, &ray, &sample);
    if (wants & SPTI_WANT_SLOPE) {
        const spt_mask number = spt_mask_and_not(sample.legal, sample.rejected);
        audit.steepest = march_load(arrays, SPTI_STEEPEST, at);
        march_slope(&sample.pair, sample.floor, number, &audit);
    }
    march_move(all, &sample, &ray);
    if (wants & SPTI_WANT_CANDIDATE) {
        const spt_mask number = spt_mask_and(sample.legal, sample.moved);
        audit.candidate_t = march_load(arrays, SPTI_CANDIDATE_T, at);
        audit.candidate_ratio = march_load(arrays, SPTI_CANDIDATE_RATIO, at);
        march_candidate(all, &rays, &sample.pair, &ray, number, &audit);
    }
    int keeps = 0;
    if (rule_pending) {
        /* Most vectors have no ray that keeps a probe, and leave it at that; nothing would change. */
        ray.pending_t = march_load(arrays, SPTI_PENDING_T, at);
        keeps = spt_any(spt_mask_or(sample.rejected, spt_less(ray.t, ray.pending_t)));
        if (keeps) {
            ray.pending_value = march_load(arrays, SPTI_PENDING_VALUE, at);
            march_leap(all, &rays, wants, &sample, &ray, &audit);
            march_store(arrays, SPTI_PENDING_T, at, ray.pending_t);
            march_store(arrays, SPTI_PENDING_VALUE, at, ray.pending_value);
        }
        if (!rule_blends) march_accept(all, &sample.pair, sample.moved, &ray);
    }

    march_add_fate(&fates->finished, sample.settled, shift);
    march_add_fate(&fates->hit, sample.hit, shift);
    march_add_fate(&fates->nonfinite, sample.nonfinite, shift);
    march_add_fate(&fates->bracketed, sample.bracketed, shift);

    march_store_state(arrays, at, &ray);
    if (wants & SPTI_WANT_SLOPE) march_store(arrays, SPTI_STEEPEST, at, audit.steepest);
    if (wants & SPTI_WANT_FALLBACKS) {
        const spt_wide before = march_load(arrays, SPTI_FALLBACKS, at);
        const spt_wide more = spt_add(before, spt_splat(1.0f));
        march_store(arrays, SPTI_FALLBACKS, at, spt_select(sample.rejected, more, before));
    }
    if (wants & SPTI_WANT_CANDIDATE) {
        march_store(arrays, SPTI_CANDIDATE_T, at, audit.candidate_t);
        march_store(arrays, SPTI_CANDIDATE_RATIO, at, audit.candidate_ratio);
    }
    return keeps;
}

/* The second half of a pass, in a loop of its own: one chain of dependent operations from sample to
 * next point is longer than what a processor looks ahead. What the first half found out it sees by
 * the probe: a rejected one is still beyond the certified sphere. */
SPTI_INLINE void march_on(const march_arrays *arrays, const march_constants *all, int pending,
                          size_t at, unsigned shift, spti_fates *fates) {
    const spt_wide zero = spt_splat(0.0f);
    const march_rays rays = {march_load(arrays, SPTI_SCALE, at), march_load(arrays, SPTI_T_MAX, at),
                             zero, zero, march_load(arrays, SPTI_FLOOR_AT_0, at)};
    const spt_wide probe = march_load(arrays, SPTI_PROBE, at);
    const spt_wide sampled = spt_mul(spt_load(&arrays->distance[at]), rays.scale);
    march_state ray;
    march_load_state(arrays, at, rays.scale, &ray);
    if (pending) {
        ray.pending_t = march_load(arrays, SPTI_PENDING_T, at);
        ray.pending_value = march_load(arrays, SPTI_PENDING_VALUE, at);
    }
    const spt_mask rejected =
        rule_probes ? spt_less(spt_add(ray.t, ray.radius), probe) : spt_mask_splat(0);
    spt_mask missed;
    const spt_wide next = march_propose(all, &rays, &ray, pending, rejected, &missed);
    march_add_fate(&fates->missed, missed, shift);
    march_add_fate(&fates->finished, spt_mask_or(missed, spti_mask_not(spt_less(ray.t, next))),
                   shift);
    march_store_points(arrays, at, next);
    /* A bracket is closed between t and the probe that crossed. */
    const spt_mask crossed = spti_less_in(spti_mask_not(rejected), sampled, zero);
    march_store(arrays, SPTI_PROBE, at, spt_select(crossed, probe, next));
}

SPTI_INLINE march_constants march_constants_of(const spti_march *march, int first) {
    const march_constants all = {{spt_splat(march->relaxation), spt_splat(march->extrapolation),
                                  spt_splat(march->slope_blend), spt_splat(march->step_cap)},
                                 spt_splat(march->pixel_radius),
                                 spt_splat(1.0f + SPTI_FLOOR),
                                 spt_mask_splat(first),
                                 march->between,
                                 spt_splat(march->inverse_lipschitz)};
    return all;
}

/* The first half of a pass (spti_march_fn): takes the samples in. wants is a constant of
 * SPTI_WANT_*. Returns whether any ray keeps a probe. */
SPTI_INLINE int march_samples(spti_chunk *chunk, const spti_march *march, size_t count, int first,
                              unsigned wants) {
    const march_arrays arrays = {chunk->array, chunk->distance};
    const march_constants all = march_constants_of(march, first);
    int keeps = 0;
    for (size_t group = 0; group * SPTI_GROUP < count; ++group) {
        spti_fates fates = {0, 0, 0, 0, 0, 0, 0};
        /* The whole group: its padding goes where the ray goes that it repeats. */
        for (unsigned shift = 0; shift < SPTI_GROUP; shift += SPT_LANES) {
            keeps |= march_vector(&arrays, &all, group * SPTI_GROUP + shift, shift, wants, &fates);
        }
        chunk->fates[group] = fates;
    }
    return keeps;
}

/* The second half, whatever is wanted: the next points. pending is a constant. Returns whether any
 * ray finished. */
SPTI_INLINE int march_points(spti_chunk *chunk, const spti_march *march, size_t count,
                             int pending) {
    const march_arrays arrays = {chunk->array, chunk->distance};
    const march_constants all = march_constants_of(march, 0);
    unsigned any = 0;
    for (size_t group = 0; group * SPTI_GROUP < count; ++group) {
        spti_fates fates = chunk->fates[group];
        const unsigned settled = fates.finished;
        const size_t left = count - group * SPTI_GROUP;
        for (unsigned shift = 0; shift < SPTI_GROUP; shift += SPT_LANES) {
            march_on(&arrays, &all, pending, group * SPTI_GROUP + shift, shift, &fates);
        }
        fates.missed = (uint16_t)(fates.missed & ~settled);
        /* Lanes behind the last ray hold nothing. */
        if (left < SPTI_GROUP) fates.finished &= (uint16_t)((1u << left) - 1u);
        chunk->fates[group] = fates;
        any |= fates.finished;
    }
    return any != 0;
}

#endif
