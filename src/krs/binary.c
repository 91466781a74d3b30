/* SPDX-License-Identifier: MIT
 *
 * Binary sphere tracing: a step rule of its own in the driver, whose samples are clearances of balls
 * instead of distances. In plain C, since what it does beside the probes is little. */
#define SPT_LANES 1
#include <float.h>
#include <math.h>

#include "../bound/bound_check.h"
#include "../trace/slot.h"
#include "own_pass.h"

#include <spheretrace/mobius.h>

/* Its numbers. */
enum { BONUS, PENALTY, RATIO, FIRST };

/* The radius of a ray's probe, in t; 0 before the first. */
enum { RADIUS = SPTI_MEMORY };

/* World length of a length in t. */
static float in_world(const spti_chunk *chunk, size_t slot, float length) {
    return length / fabsf(chunk->array[SPTI_SCALE][slot]);
}

/* The tolerance at t, in t, as ray_kernel.h has it. */
static float tolerance_at(const spti_chunk *chunk, const spti_march *march, size_t slot, float t) {
    const float floor = ray_floor(chunk->array[SPTI_FLOOR_AT_0][slot], t);
    return ray_tolerance(chunk->array[SPTI_EPSILON][slot], march->pixel_radius,
                         chunk->array[SPTI_PATH][slot], floor, t);
}

/* The radius to begin with. Without a bound, so far at most as the ray's origin is from that of
 * coordinates, or 1: what is met on the way should not be far out of scale with that, where fields
 * may know nothing any more. */
static float first_radius(const spti_chunk *chunk, const spti_march *march, size_t slot) {
    const float whole = chunk->array[SPTI_T_MAX][slot] - chunk->array[SPTI_T][slot];
    const float unit = fabsf(chunk->array[SPTI_SCALE][slot]);
    float extent = spti_own_numbers_of(march).number[FIRST];
    if (!(extent > 0.0f) && march->bound != NULL) {
        float low[3], high[3];
        spt_bound_extent(march->bound, low, high);
        for (int axis = 0; axis < 3; ++axis) {
            const float side = 0.25f * high[axis] - 0.25f * low[axis];
            if (side > extent && side <= FLT_MAX) extent = side;
        }
    }
    if (extent > 0.0f) return extent * unit;
    const float reach = chunk->array[SPTI_FLOOR_AT_0][slot] / SPTI_FLOOR;
    const float most = reach > unit ? reach : unit;
    return 0.125f * whole < most ? 0.125f * whole : most;
}

/* What comes of a ray's probe. */
typedef enum binary_end { GOES_ON, HITS, MISSES, IS_NONFINITE } binary_end;

/* A probe that was not free ends the ray if none smaller is worth trying. */
static binary_end end_at(spti_chunk *chunk, size_t slot, float clearance) {
    if (clearance == clearance) return HITS;
    chunk->array[SPTI_VALUE][slot] = clearance;
    return IS_NONFINITE;
}

static binary_end feel(spti_chunk *chunk, const spti_march *march, size_t slot) {
    const spti_own_numbers numbers = spti_own_numbers_of(march);
    const float clearance = chunk->distance[slot], t_max = chunk->array[SPTI_T_MAX][slot];
    const int is_free = isgreaterequal(clearance, 0.0f);
    float t = chunk->array[SPTI_T][slot], radius = chunk->array[RADIUS][slot];
    if (!is_free) {
        chunk->array[SPTI_VALUE][slot] = in_world(chunk, slot, radius);
        chunk->array[SPTI_FALLBACKS][slot] += 1.0f;
        if (!(radius > 0.0f)) return end_at(chunk, slot, clearance);
        radius *= numbers.number[PENALTY];
    } else if (radius > 0.0f) {
        /* First the advance, then the growth: the paper prints it the other way round. */
        t += 2.0f * radius;
        radius *= numbers.number[BONUS];
        chunk->array[SPTI_T][slot] = t < t_max ? t : t_max;
    } else {
        radius = first_radius(chunk, march, slot);
    }
    if (!(t < t_max)) return MISSES;
    const float least = numbers.number[RATIO] * tolerance_at(chunk, march, slot, t);
    const float rest = 0.5f * (t_max - t), most = rest > 2.0f * least ? rest : 2.0f * least;
    if (radius > most) radius = most;
    /* The tolerance may have grown by more than the bonus. */
    if (is_free && radius < 2.0f * least) radius = 2.0f * least;
    /* Nor is a free one too small for t, which may then go on; any other is the last. */
    if (is_free && !(t + 2.0f * radius > t)) radius = t * 0x1p-22f;
    if (!(radius > least) || !(t + 2.0f * radius > t)) return end_at(chunk, slot, clearance);
    chunk->array[RADIUS][slot] = radius;
    spti_slot_point(chunk, slot, slot, t + radius);
    return GOES_ON;
}

static int binary_pass(spti_chunk *chunk, const spti_march *march, size_t count, int first) {
    unsigned any = 0;
    for (size_t group = 0; group * SPTI_GROUP < count; ++group) {
        spti_fates fates = {0, 0, 0, 0, 0, 0, 0};
        for (size_t i = 0; i < SPTI_GROUP && group * SPTI_GROUP + i < count; ++i) {
            const size_t slot = group * SPTI_GROUP + i;
            const uint16_t bit = (uint16_t)(1u << i);
            if (first) chunk->array[SPTI_VALUE][slot] = INFINITY;
            const binary_end end = feel(chunk, march, slot);
            if (end != GOES_ON) fates.finished |= bit;
            if (end == HITS) fates.hit |= bit;
            if (end == MISSES) fates.missed |= bit;
            if (end == IS_NONFINITE) fates.nonfinite |= bit;
        }
        chunk->fates[group] = fates;
        any |= fates.finished;
    }
    return any != 0;
}

/* The probe as the field that the driver evaluates. */
typedef struct binary_probe {
    spti_own_field own;
    spt_probe probe;
} binary_probe;

static void ask(void *user, size_t n, const float *x, const float *y, const float *z,
                float *clearance) {
    const binary_probe *const asked = user;
    const spt_probe *const probe = &asked->probe;
    SPTI_ALIGNED(64) float radius[SPT_BATCH];
    for (size_t slot = 0; slot < n; ++slot) {
        radius[slot] = in_world(asked->own.chunk, slot, asked->own.chunk->array[RADIUS][slot]);
        if (!(radius[slot] >= FLT_MIN)) radius[slot] = FLT_MIN;
    }
    if (probe->batch != NULL) {
        probe->batch(probe->user, n, x, y, z, radius, clearance);
        return;
    }
    for (size_t slot = 0; slot < n; ++slot) {
        clearance[slot] = probe->point(probe->user, x[slot], y[slot], z[slot], radius[slot]);
    }
}

static int take_probe(spti_call *call, binary_probe *asked, const spt_probe *probe) {
    asked->probe = spt_probe_default();
    if (probe == NULL || !spti_copy_sized(&asked->probe, probe, sizeof *probe)) return 0;
    if (asked->probe.batch == NULL && asked->probe.point == NULL) return 0;
    call->field = spt_field_default();
    call->field.batch = ask;
    call->field.user = asked;
    if (asked->probe.bound == NULL) return 1;
    call->field.bound = &call->bound;
    return spti_bound_copy(&call->bound, asked->probe.bound);
}

static int take_numbers(spt_binary *to, const spt_binary *from) {
    *to = spt_binary_default();
    if (from != NULL && !spti_copy_sized(to, from, sizeof *to)) return 0;
    return to->bonus > 1.0f && to->bonus <= 8.0f && to->penalty > 0.0f && to->penalty < 1.0f &&
           to->probe_ratio > 0.0f && to->probe_ratio <= 1.0f &&
           spti_within(to->first, 0.0f, FLT_MAX);
}

spt_status spt_binary_trace(const spt_probe *probe, const spt_binary *binary,
                            const spt_settings *settings, size_t count, const spt_rays *rays,
                            const spt_hits *hits, spt_statistics *statistics) {
    binary_probe asked;
    spt_binary numbers;
    spti_call call;
    memset(&call, 0, sizeof call);
    if (!take_probe(&call, &asked, probe) || !take_numbers(&numbers, binary)) {
        return SPT_BAD_ARGUMENT;
    }
    const spti_own_numbers own = {
        {numbers.bonus, numbers.penalty, numbers.probe_ratio, numbers.first}};
    return spti_trace_by(&call, &asked.own, binary_pass, &own, settings, count, rays, hits,
                         statistics);
}

/* ---- Fields as probes ------------------------------------------------------------------------ */

static void field_clearance(void *user, size_t n, const float *x, const float *y, const float *z,
                            const float *radius, float *clearance) {
    const spt_field *const field = user;
    SPTI_ALIGNED(64) float distance[SPT_BATCH];
    spti_ask_groups(field, n, x, y, z, distance);
    for (size_t i = 0; i < n; ++i) clearance[i] = distance[i] / field->lipschitz - radius[i];
}

static float field_clearance_at(void *user, float x, float y, float z, float radius) {
    const spt_field *const field = user;
    return field->point(field->user, x, y, z) / field->lipschitz - radius;
}

spt_probe spt_probe_of_field(const spt_field *field) {
    spt_probe probe = spt_probe_default();
    spt_field copy;
    spt_bound bound;
    if (!spti_field_copy(&copy, &bound, field)) return probe;
    if (copy.batch != NULL) {
        probe.batch = field_clearance;
    } else {
        probe.point = field_clearance_at;
    }
    probe.user = (void *)(uintptr_t)field; /* only read */
    probe.bound = copy.bound;
    return probe;
}
