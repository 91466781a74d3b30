/* SPDX-License-Identifier: MIT
 *
 * Reads the fields and hits that the calls of this room are given. */
#include "landing.h"

#include <float.h>
#include <math.h>

#include "../base/arguments.h"
#include "../bound/bound_check.h"

/* The fields stand as far apart as the caller's header says. */
static const spt_field *field_at(const spt_field *fields, size_t index) {
    const char *const first = (const char *)fields;
    return (const spt_field *)(const void *)(first + index * fields->struct_size);
}

int spti_fields_are_good(const spt_field *fields, size_t field_count) {
    if (fields == NULL || field_count == 0 || field_count > (size_t)1 << 23) return 0;
    for (size_t i = 0; i < field_count; ++i) {
        spt_field field;
        spt_bound bound;
        const spt_field *const given = field_at(fields, i);
        if (i > 0 && given->struct_size != fields->struct_size) return 0;
        if (!spti_field_copy(&field, &bound, given)) return 0;
    }
    return 1;
}

void spti_target_of(spti_target *target, const spt_field *fields, size_t index,
                    const spt_settings *settings) {
    spti_field_copy(&target->field, &target->bound, field_at(fields, index));
    target->inverse_lipschitz = 1.0f / target->field.lipschitz;
    target->size = settings != NULL ? settings->size : 0.0f;
    if (target->field.bound != NULL) {
        const float extent = spti_bound_size(&target->bound);
        target->field.bound = &target->bound;
        if (extent > target->size) target->size = extent;
    }
}

int spti_door(const spt_field *fields, size_t field_count, const spt_settings *settings,
              spt_settings *copy, size_t count, const spt_rays *rays, const spt_hits *hits) {
    if (!spti_fields_are_good(fields, field_count)) return 0;
    if (!spti_settings_copy(copy, settings)) return 0;
    if (count == 0) return 1;
    if (rays == NULL || hits == NULL || !spti_views_fit(rays, hits, count)) return 0;
    return field_count == 1 || hits->component.first != NULL;
}

float spti_length(float x, float y, float z) {
    float largest = fabsf(x), power;
    uint32_t bits;
    if (fabsf(y) > largest) largest = fabsf(y);
    if (fabsf(z) > largest) largest = fabsf(z);
    if (!(largest >= FLT_MIN)) return 0.0f;
    if (largest > 0x1p-40f && largest < 0x1p40f) return sqrtf(x * x + y * y + z * z);
    /* In units of the power of two below the largest; 2^127 has no normal inverse. */
    memcpy(&bits, &largest, sizeof bits);
    bits &= 0x7f800000u;
    memcpy(&power, &bits, sizeof power);
    if (power > 0x1p126f) power = 0x1p126f;
    const float inverse = 1.0f / power;
    x *= inverse;
    y *= inverse;
    z *= inverse;
    return sqrtf(x * x + y * y + z * z) * power;
}

void spti_wish_next(spti_wish *wish) {
    const int32_t last = wish->component;
    int32_t next = INT32_MAX;
    for (size_t i = 0; i < wish->window; ++i) {
        const int32_t component = wish->component_of[i];
        next = component > last && component < next ? component : next;
    }
    wish->component = next < INT32_MAX ? next : -1;
}

/* Takes the rays out whose word in a column, where there is one, is not as wanted. */
static void require(spti_wish *wish, const spt_column *column, int32_t wanted, int equal) {
    const char *word = column->first;
    if (word == NULL) return;
    word += (ptrdiff_t)wish->first * column->stride;
    for (size_t i = 0; i < wish->window; ++i, word += column->stride) {
        int32_t value;
        memcpy(&value, word, sizeof value);
        wish->component_of[i] = (value == wanted) == equal ? wish->component_of[i] : -1;
    }
}

void spti_wish_begin(spti_wish *wish, const spt_rays *rays, const spt_hits *hits, size_t first,
                     size_t count, size_t field_count) {
    const spt_column outcomes = spti_column_of(&hits->outcome);
    const spt_column components = spti_column_of(&hits->component);
    wish->rays = rays;
    wish->hits = hits;
    wish->first = first;
    wish->window = spti_window(first, count);
    for (size_t i = 0; i < wish->window; ++i) {
        int32_t component = 0;
        if (field_count > 1) component = spti_read_integer(&components, first + i, -1);
        if (component < 0 || (size_t)component >= field_count) component = -1;
        wish->component_of[i] = component;
    }
    require(wish, &outcomes, SPT_HIT, 1);
    require(wish, &rays->active, 0, 0);
    wish->component = -1;
    spti_wish_next(wish);
}

/* Reads a column for the places of a landing. */
static void read_column(const spti_wish *wish, const spt_column *column, float absent,
                        const spti_landing *landing, float *to) {
    const char *base = column->first;
    const ptrdiff_t stride = column->stride;
    if (base == NULL) {
        for (size_t slot = 0; slot < landing->count; ++slot) to[slot] = absent;
        return;
    }
    base += (ptrdiff_t)wish->first * stride;
    for (size_t slot = 0; slot < landing->count; ++slot) {
        memcpy(&to[slot], base + landing->place[slot] * stride, sizeof *to);
    }
}

/* What follows from a ray and its hit. Returns whether they are whole. */
static int measure(spti_landing *landing, size_t slot) {
    float reach = 0.0f, sum = 0.0f;
    for (int axis = 0; axis < 3; ++axis) {
        const float origin = fabsf(landing->origin[axis][slot]);
        reach = origin > reach ? origin : reach;
        sum += fabsf(spti_point(landing, axis, slot, landing->t[slot])) + origin;
        sum += fabsf(landing->direction[axis][slot]);
    }
    landing->reach[slot] = reach;
    landing->length[slot] = spti_length(landing->direction[0][slot], landing->direction[1][slot],
                                        landing->direction[2][slot]);
    /* A sum is finite if its terms are, but for the largest of numbers. */
    return sum <= FLT_MAX && fabsf(landing->t[slot]) <= FLT_MAX && landing->path[slot] >= 0.0f &&
           landing->path[slot] <= FLT_MAX && landing->length[slot] > 0.0f;
}

/* Moves a ray to the slot `to` before it. */
static void move_ray(spti_landing *landing, size_t slot, size_t to) {
    landing->place[to] = landing->place[slot];
    for (int axis = 0; axis < 3; ++axis) {
        landing->origin[axis][to] = landing->origin[axis][slot];
        landing->direction[axis][to] = landing->direction[axis][slot];
    }
    landing->length[to] = landing->length[slot];
    landing->path[to] = landing->path[slot];
    landing->reach[to] = landing->reach[slot];
    landing->t[to] = landing->t[slot];
}

void spti_land(const spti_wish *wish, spti_landing *landing) {
    const spt_column t = spti_column_of(&wish->hits->t);
    size_t count = 0;
    for (size_t i = 0; i < wish->window; ++i) {
        landing->place[count] = (uint16_t)i;
        count += wish->component_of[i] == wish->component;
    }
    landing->count = count;
    for (int axis = 0; axis < 3; ++axis) {
        read_column(wish, &wish->rays->origin[axis], 0.0f, landing, landing->origin[axis]);
        read_column(wish, &wish->rays->direction[axis], 0.0f, landing, landing->direction[axis]);
    }
    read_column(wish, &wish->rays->path, 0.0f, landing, landing->path);
    read_column(wish, &t, INFINITY, landing, landing->t);
    count = 0;
    for (size_t slot = 0; slot < landing->count; ++slot) {
        if (!measure(landing, slot)) continue;
        if (count < slot) move_ray(landing, slot, count);
        ++count;
    }
    landing->count = count;
}

float spti_tolerance(const spti_target *target, const spt_settings *settings, float travelled,
                     float magnitude) {
    const float cone = settings->pixel_radius * travelled;
    const float floor = SPTI_FLOOR * magnitude + SPTI_FLOOR * target->size;
    float tolerance = settings->epsilon;
    if (cone > tolerance) tolerance = cone;
    return floor > tolerance ? floor : tolerance;
}

spt_rays spti_rays_from(const spt_rays *rays, size_t first) {
    spt_rays from = *rays;
    spt_column *const columns[] = {&from.origin[0],    &from.origin[1],    &from.origin[2],
                                   &from.direction[0], &from.direction[1], &from.direction[2],
                                   &from.t_min,        &from.t_max,        &from.path,
                                   &from.active};
    for (size_t i = 0; i < sizeof columns / sizeof *columns; ++i) {
        if (columns[i]->first == NULL) continue;
        columns[i]->first = (const char *)columns[i]->first + (ptrdiff_t)first * columns[i]->stride;
    }
    return from;
}

void spti_add_statistics(spt_statistics *statistics, const spt_statistics *work,
                         const spt_statistics *rays) {
    statistics->rays += rays->rays;
    for (int i = 0; i < SPT_OUTCOMES; ++i) statistics->outcomes[i] += rays->outcomes[i];
    statistics->evaluations += work->evaluations;
    statistics->slots += work->slots;
    statistics->passes += work->passes;
    statistics->fallbacks += work->fallbacks;
    if (work->largest_slope > statistics->largest_slope) {
        statistics->largest_slope = work->largest_slope;
    }
    if (work->lanes != 0) statistics->lanes = work->lanes;
}
