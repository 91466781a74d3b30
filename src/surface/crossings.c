/* SPDX-License-Identifier: MIT
 *
 * All crossings of rays with a surface. A hit is a crossing if the ray is on the other side once it
 * has left the tolerance again; so each stretch is traced from the hit before it, with its start
 * skipped, and tells what that hit was. */
#include <float.h>
#include <math.h>

#include "landing.h"

enum { MOST_CROSSINGS = 1024 };

/* A window of rays, by place. */
typedef struct crossing_window {
    size_t first, count;
    float cursor[SPT_BATCH]; /* where the stretch begins: at the last hit */
    float t[SPT_BATCH];
    float entered[SPT_BATCH]; /* t where the ray came inside */
    float inside_for[SPT_BATCH];
    int32_t outcome[SPT_BATCH];
    uint32_t flags[SPT_BATCH];
    uint32_t number[SPT_BATCH];
    int32_t active[SPT_BATCH]; /* 0: at its end */
    unsigned char inside[SPT_BATCH], began_inside[SPT_BATCH];
} crossing_window;

typedef struct crossing_call {
    const spt_field *field;
    spt_settings settings;
    const spt_rays *rays;
    const spt_crossings *crossings;
    spt_statistics *counted;
} crossing_call;

static void end(crossing_window *window, size_t place, int32_t outcome) {
    window->active[place] = 0;
    window->outcome[place] = outcome;
}

/* The ray goes through the surface at its cursor. Returns 0 where there is no room to say so. */
static int cross(const crossing_call *call, crossing_window *window, size_t place) {
    const spt_crossings *const crossings = call->crossings;
    const uint32_t number = window->number[place];
    const float t = window->cursor[place];
    if (number == crossings->most) return 0;
    if (crossings->t.first != NULL) {
        spt_sink t_of_ray = crossings->t;
        t_of_ray.first = (char *)t_of_ray.first + (ptrdiff_t)number * crossings->t_step;
        spti_write(&t_of_ray, window->first + place, t);
    }
    if (window->inside[place]) window->inside_for[place] += t - window->entered[place];
    window->entered[place] = t;
    window->inside[place] = !window->inside[place];
    window->number[place] = number + 1;
    return 1;
}

/* What the stretch behind each cursor tells. */
static void take(const crossing_call *call, crossing_window *window, int first_stretch) {
    for (size_t place = 0; place < window->count; ++place) {
        const int32_t outcome = window->outcome[place];
        const unsigned char inside = (window->flags[place] & SPT_FLAG_INSIDE) != 0;
        if (window->active[place] == 0) continue;
        if (first_stretch) {
            window->inside[place] = window->began_inside[place] = inside;
        } else if (inside != window->inside[place] && !cross(call, window, place)) {
            end(window, place, SPT_HIT);
            continue;
        }
        window->cursor[place] = window->t[place];
        if (outcome != SPT_HIT) end(window, place, outcome);
    }
}

static void write(const crossing_call *call, crossing_window *window, spt_statistics *sum) {
    const spt_crossings *const crossings = call->crossings;
    for (size_t place = 0; place < window->count; ++place) {
        const size_t index = window->first + place;
        float direction[3];
        if (!spti_is_active(call->rays, index)) continue;
        for (int axis = 0; axis < 3; ++axis) {
            direction[axis] = spti_read(&call->rays->direction[axis], index, 0.0f);
        }
        if (window->inside[place] && window->outcome[place] == SPT_MISS) {
            const float t_max = spti_read(&call->rays->t_max, index, INFINITY);
            window->inside_for[place] += t_max - window->entered[place];
        }
        const float length = spti_length(direction[0], direction[1], direction[2]);
        const float inside_for = window->inside_for[place];
        sum->rays += 1;
        sum->outcomes[window->outcome[place]] += 1;
        spti_write_integer(&crossings->number, index, (int32_t)window->number[place]);
        spti_write_integer(&crossings->inside, index, window->began_inside[place]);
        spti_write(&crossings->thickness, index, inside_for > 0.0f ? inside_for * length : 0.0f);
        spti_write_integer(&crossings->outcome, index, window->outcome[place]);
    }
}

/* One window, a stretch of each ray a round. */
static void trace_window(const crossing_call *call, size_t first, size_t count,
                         spt_statistics *sum) {
    const uint32_t rounds = 2 * call->crossings->most + 2;
    spt_settings settings = call->settings;
    crossing_window window;
    spt_rays rays = spti_rays_from(call->rays, first);
    spt_hits hits;
    int any = 1;
    memset(&hits, 0, sizeof hits);
    window.first = first;
    window.count = count;
    hits.t.first = window.t;
    hits.outcome.first = window.outcome;
    hits.flags.first = window.flags;
    hits.t.stride = hits.outcome.stride = hits.flags.stride = 4;
    for (size_t place = 0; place < count; ++place) {
        window.active[place] = spti_is_active(call->rays, first + place) ? -1 : 0;
        window.cursor[place] = spti_read(&call->rays->t_min, first + place, 0.0f);
        window.entered[place] = window.cursor[place];
        window.inside_for[place] = 0.0f;
        window.outcome[place] = SPT_MISS;
        window.number[place] = 0;
        window.inside[place] = window.began_inside[place] = 0;
    }
    rays.t_min.first = window.cursor;
    rays.active.first = window.active;
    rays.t_min.stride = rays.active.stride = 4;
    for (uint32_t round = 0; round <= rounds && any; ++round) {
        spt_trace(call->field, &settings, count, &rays, &hits, call->counted);
        take(call, &window, round == 0);
        settings.flags |= SPT_SKIP_START;
        any = 0;
        for (size_t place = 0; place < count; ++place) any |= window.active[place] != 0;
    }
    for (size_t place = 0; place < count; ++place) {
        if (window.active[place] != 0) end(&window, place, SPT_LIMIT);
    }
    write(call, &window, sum);
}

static int crossings_fit(const spt_crossings *crossings, size_t count) {
    if (crossings->most == 0 || crossings->most > MOST_CROSSINGS) return 0;
    if (crossings->t.first != NULL && crossings->most > 1 && crossings->t_step == 0) return 0;
    return spti_sink_fits(&crossings->t, count) && spti_fits(crossings->t_step, crossings->most) &&
           spti_sink_fits(&crossings->number, count) && spti_sink_fits(&crossings->inside, count) &&
           spti_sink_fits(&crossings->thickness, count) &&
           spti_sink_fits(&crossings->outcome, count);
}

spt_status spt_crossings_of(const spt_field *field, const spt_settings *settings, size_t count,
                            const spt_rays *rays, const spt_crossings *crossings,
                            spt_statistics *statistics) {
    spt_statistics counts = spt_statistics_default(), sum = spt_statistics_default();
    crossing_call call;
    spt_hits none;
    memset(&none, 0, sizeof none);
    call.field = field;
    call.rays = rays;
    call.crossings = crossings;
    call.counted = statistics != NULL ? &counts : NULL;
    if (!spti_door(field, 1, settings, &call.settings, count, rays, &none)) return SPT_BAD_ARGUMENT;
    if ((call.settings.flags & SPT_STOP_INSIDE) != 0 ||
        (statistics != NULL && statistics->struct_size < sizeof *statistics)) {
        return SPT_BAD_ARGUMENT;
    }
    /* Whether the rule may trace the field. */
    if (spt_trace(field, &call.settings, 0, NULL, NULL, NULL) != SPT_OK) return SPT_BAD_ARGUMENT;
    if (crossings == NULL || !crossings_fit(crossings, count)) return SPT_BAD_ARGUMENT;
    for (size_t first = 0; first < count; first += SPT_BATCH) {
        trace_window(&call, first, spti_window(first, count), &sum);
    }
    if (statistics != NULL) spti_add_statistics(statistics, &counts, &sum);
    return SPT_OK;
}
