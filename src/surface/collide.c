/* SPDX-License-Identifier: MIT
 *
 * How far balls and capsules are from the surface. Where along its axis a capsule is nearest is
 * searched for by splitting the stretch between two samples that may come nearest (Piyavskii 1972;
 * Shubert 1972), many capsules at a time, one sample each a round.
 *
 * A value that is NaN or -infinity certifies nothing: it ends its body's search with a distance of
 * -infinity, and the place is where it was. +infinity says that no surface is anywhere. */
#include <float.h>
#include <math.h>

#include "../base/arguments.h"
#include "landing.h"

enum {
    MOST_SAMPLES = 64,        /* a body and field */
    SEARCHES = 2 * SPTI_GROUP /* side by side: as many as a frame below 32 KiB holds */
};

typedef struct collide_call {
    const spt_field *fields;
    size_t field_count;
    spt_settings settings;
    unsigned most; /* samples a body and field */
    const spt_bodies *bodies;
    const spt_contacts *contacts;
    spti_target target; /* the field that is asked, and */
    int32_t component;  /* which it is */
} collide_call;

/* A window of bodies, and what is known of them. */
typedef struct collide_window {
    SPTI_ALIGNED(64) float x[SPT_BATCH], y[SPT_BATCH], z[SPT_BATCH], distance[SPT_BATCH];
    size_t first, count;
    float radius[SPT_BATCH];
    float half[SPT_BATCH];  /* of the axis; -1: no body */
    float reach[SPT_BATCH]; /* largest magnitude in it */
    float bound[SPT_BATCH]; /* no surface is nearer to the axis; +infinity where none is known */
    float place[SPT_BATCH]; /* where on the axis that field is nearest */
    int32_t component[SPT_BATCH];
    float middle[SPT_BATCH];       /* the value in the middle, as certain() has it */
    unsigned char open[SPT_BATCH]; /* bodies that need more than that, in order */
    size_t open_count;
} collide_window;

typedef struct collide_axis {
    float from[3], to[3];
} collide_axis;

/* One capsule against one field. Places ascend; bound[i] is how near a surface may come to the
 * stretch of axis before sample i, the last one to that behind all. */
typedef struct collide_search {
    collide_axis axis;
    double length; /* of it; in double, whose range squares any float */
    float reach;
    uint32_t body; /* in the window */
    unsigned count;
    unsigned nearest;  /* the stretch to be split, and */
    float next;        /* the place */
    float best, where; /* the least sample, the earlier of equals */
    float place[MOST_SAMPLES], value[MOST_SAMPLES], bound[MOST_SAMPLES + 1];
} collide_search;

/* The capsules of a window that are searched side by side. */
typedef struct collide_pool {
    size_t active, next; /* next: of window->open */
    collide_search searches[SEARCHES];
} collide_pool;

/* ---- Bodies --------------------------------------------------------------------------------- */

static void read_axis(const spt_bodies *bodies, size_t index, collide_axis *axis) {
    for (int i = 0; i < 3; ++i) {
        axis->from[i] = spti_read(&bodies->from.axis[i], index, 0.0f);
        axis->to[i] = spti_read(&bodies->to.axis[i], index, axis->from[i]);
    }
}

static double length_of(const collide_axis *axis) {
    double square = 0;
    for (int i = 0; i < 3; ++i) {
        const double edge = (double)axis->to[i] - (double)axis->from[i];
        square += edge * edge;
    }
    return sqrt(square);
}

/* Infinite where a number is not finite. */
static float reach_of(const collide_axis *axis) {
    float reach = 0.0f;
    for (int i = 0; i < 3; ++i) {
        const float from = fabsf(axis->from[i]), to = fabsf(axis->to[i]);
        if (!(from <= FLT_MAX) || !(to <= FLT_MAX)) return INFINITY;
        reach = from > reach ? from : reach;
        reach = to > reach ? to : reach;
    }
    return reach;
}

static void put_point(const collide_axis *axis, float place, collide_window *window, size_t slot) {
    double point[3];
    for (int i = 0; i < 3; ++i) {
        const double from = (double)axis->from[i];
        point[i] = from + (double)place * ((double)axis->to[i] - from);
    }
    window->x[slot] = (float)point[0];
    window->y[slot] = (float)point[1];
    window->z[slot] = (float)point[2];
}

/* Off by so much may a value be that was asked for on an axis, the rounding of the point, of f and
 * of what is made of it included. */
static float noise_of(const collide_call *call, float reach, float length) {
    return SPTI_FLOOR * reach + SPTI_FLOOR * call->target.size + SPTI_FLOOR * fabsf(length);
}

/* How far the surface is certainly away, by a value of the field. */
static float certain(const collide_call *call, float reach, float value) {
    const float length = value * (1.0f / call->target.field.lipschitz);
    if (length > FLT_MAX) return INFINITY;
    if (!(length >= -FLT_MAX)) return -INFINITY;
    return length - noise_of(call, reach, length);
}

/* How exactly a least value is wanted. */
static float tolerance_of(const collide_call *call, float reach, float best) {
    const float noise = noise_of(call, reach, best), epsilon = call->settings.epsilon;
    return epsilon > noise ? epsilon : noise;
}

/* Takes in what a field came to; the first of equal ones stays. */
static void settle(collide_window *window, size_t body, int32_t component, float bound,
                   float place) {
    if (!(bound < window->bound[body])) return;
    window->bound[body] = bound;
    window->place[body] = place;
    window->component[body] = component;
}

/* ---- The search on an axis ------------------------------------------------------------------ */

/* How near a surface may come to a stretch of axis, `apart` long, whose ends are at least a and b
 * away from any, and where (*at, from its beginning). Outside, nothing is in the balls around the
 * ends, and the nearest point outside of both is on the circle in which they meet. Where they do
 * not meet, or inside, what holds is that the signed distance changes by no more than the way. */
static float stretch_bound(double a, double b, double apart, double *at) {
    const double least = a < b ? a : b;
    double bound;
    *at = 0;
    if (!(a <= (double)FLT_MAX) || !(b <= (double)FLT_MAX) || !(apart > 0)) return (float)least;
    if (least > 0 && a + b > apart) {
        *at = 0.5 * (apart + (a - b) * (a + b) / apart);
        const double square = (a - *at) * (a + *at);
        bound = square > 0 ? sqrt(square) : 0;
    } else {
        *at = 0.5 * (apart + (a - b));
        bound = 0.5 * (a + b - apart);
    }
    return *at > 0 && *at < apart && bound < least ? (float)bound : (float)least;
}

/* The same for a stretch of a search; *place is where to split it. */
static float bound_of(const collide_search *search, unsigned stretch, float *place) {
    const double length = search->length;
    if (stretch == 0) { /* from the first end to the first sample */
        *place = 0.0f;
        return (float)((double)search->value[0] - (double)search->place[0] * length);
    }
    const float begin = search->place[stretch - 1], value = search->value[stretch - 1];
    if (stretch == search->count) {
        *place = 1.0f;
        return (float)((double)value - (1 - (double)begin) * length);
    }
    double at;
    const double apart = ((double)search->place[stretch] - (double)begin) * length;
    const float bound = stretch_bound((double)value, (double)search->value[stretch], apart, &at);
    *place = (float)((double)begin + at / length);
    return bound;
}

static void set_bound(collide_search *search, unsigned stretch) {
    float place;
    search->bound[stretch] = bound_of(search, stretch, &place);
}

static void begin_search(const collide_call *call, const collide_window *window, size_t body,
                         collide_search *search) {
    read_axis(call->bodies, window->first + body, &search->axis);
    search->length = length_of(&search->axis);
    search->reach = window->reach[body];
    search->body = (uint32_t)body;
    search->count = 1;
    search->place[0] = search->where = 0.5f;
    search->value[0] = search->best = window->middle[body];
    set_bound(search, 0);
    set_bound(search, 1);
}

/* Puts the sample at search->next in its place. */
static void add_sample(collide_search *search, float value) {
    const unsigned at = search->nearest, behind = search->count - at;
    memmove(&search->place[at + 1], &search->place[at], behind * sizeof(float));
    memmove(&search->value[at + 1], &search->value[at], behind * sizeof(float));
    memmove(&search->bound[at + 2], &search->bound[at + 1], behind * sizeof(float));
    search->place[at] = search->next;
    search->value[at] = value;
    search->count += 1;
    if (value < search->best) {
        search->best = value;
        search->where = search->next;
    }
    set_bound(search, at);
    set_bound(search, at + 1);
}

/* Whether there is more to ask: chooses the stretch that may come nearest, and where to split it.
 * enough: a bound that is of no interest, since another field has it already. */
static int go_on(const collide_call *call, collide_search *search, float enough) {
    unsigned nearest = 0;
    for (unsigned i = 1; i <= search->count; ++i) {
        if (search->bound[i] < search->bound[nearest]) nearest = i;
    }
    const float bound = search->bound[nearest];
    search->nearest = nearest;
    if (search->count >= call->most || !(bound < enough)) return 0;
    if (!(search->best - bound > tolerance_of(call, search->reach, search->best))) return 0;
    bound_of(search, nearest, &search->next);
    /* A stretch without a number between its ends is as it is. */
    return (nearest == 0 || search->next > search->place[nearest - 1]) &&
           (nearest == search->count || search->next < search->place[nearest]);
}

/* Ends the searches that have come to one, begins others, and puts down the next points. */
static void turn(const collide_call *call, collide_pool *pool, collide_window *window) {
    for (size_t i = 0; i < SEARCHES;) {
        collide_search *const search = &pool->searches[i];
        if (i == pool->active) {
            if (pool->next == window->open_count) return;
            begin_search(call, window, window->open[pool->next], search);
            pool->next += 1;
            pool->active += 1;
        }
        if (go_on(call, search, window->bound[search->body])) {
            put_point(&search->axis, search->next, window, i);
            ++i;
            continue;
        }
        settle(window, search->body, call->component, search->bound[search->nearest],
               search->where);
        pool->active -= 1;
        if (pool->active != i) *search = pool->searches[pool->active];
    }
}

/* In a frame of its own: no more than this and the window are on the stack. */
static SPTI_NOINLINE void search_axes(const collide_call *call, collide_window *window) {
    collide_pool pool;
    pool.active = pool.next = 0;
    for (size_t round = 0; round < window->open_count * MOST_SAMPLES; ++round) {
        turn(call, &pool, window);
        if (pool.active == 0) break;
        spti_ask(&call->target.field, pool.active, window->x, window->y, window->z,
                 window->distance);
        for (size_t i = 0; i < pool.active; ++i) {
            collide_search *const search = &pool.searches[i];
            add_sample(search, certain(call, search->reach, window->distance[i]));
        }
    }
}

/* ---- Windows -------------------------------------------------------------------------------- */

static void begin_window(const collide_call *call, size_t first, size_t count,
                         collide_window *window) {
    window->first = first;
    window->count = count;
    for (size_t body = 0; body < count; ++body) {
        collide_axis axis;
        const float radius = spti_read(&call->bodies->radius, first + body, 0.0f);
        read_axis(call->bodies, first + body, &axis);
        const float reach = reach_of(&axis);
        const int good = reach <= FLT_MAX && spti_within(radius, 0.0f, FLT_MAX);
        /* Not less than it is. */
        window->radius[body] = radius;
        window->half[body] = good ? (float)(length_of(&axis) * (0.5 + 0x1p-23)) : -1.0f;
        window->reach[body] = reach;
        window->bound[body] = good && call->most == 0 ? -INFINITY : INFINITY;
        window->place[body] = 0.0f;
        window->component[body] = -1;
    }
}

/* Asks for the middle of every axis, which is all that balls and most far capsules need. */
static void ask_middles(const collide_call *call, collide_window *window) {
    size_t asked = 0;
    for (size_t body = 0; body < window->count; ++body) {
        collide_axis axis;
        if (!(window->half[body] >= 0.0f)) continue;
        read_axis(call->bodies, window->first + body, &axis);
        put_point(&axis, 0.5f, window, asked++);
    }
    spti_ask(&call->target.field, asked, window->x, window->y, window->z, window->distance);
    asked = 0;
    window->open_count = 0;
    for (size_t body = 0; body < window->count; ++body) {
        const float half = window->half[body], reach = window->reach[body];
        if (!(half >= 0.0f)) continue;
        const float value = certain(call, reach, window->distance[asked++]);
        const float bound = value - half;
        window->middle[body] = value;
        if (call->most > 1 && bound < window->bound[body] &&
            value - bound > tolerance_of(call, reach, value)) {
            window->open[window->open_count++] = (unsigned char)body;
        } else {
            settle(window, body, call->component, bound, half > 0.0f ? 0.5f : 0.0f);
        }
    }
}

/* Those where the axis is nearest, as of rays that hit there at t = 0; zero where no surface is. */
static SPTI_NOINLINE void write_normals(const collide_call *call, collide_window *window) {
    static const float ahead[3] = {0, 0, 1};
    float normals[3][SPT_BATCH];
    int32_t outcomes[SPT_BATCH];
    float *const points[3] = {window->x, window->y, window->z};
    spt_rays rays;
    spt_hits hits;
    spt_vector_sinks sinks;
    memset(&rays, 0, sizeof rays);
    memset(&hits, 0, sizeof hits);
    for (int i = 0; i < 3; ++i) {
        rays.origin[i].first = points[i];
        rays.origin[i].stride = sizeof *points[i];
        rays.direction[i].first = &ahead[i];
        sinks.axis[i].first = normals[i];
        sinks.axis[i].stride = sizeof *normals[i];
    }
    hits.t.first = window->distance;
    hits.outcome.first = outcomes;
    hits.component.first = window->component;
    hits.t.stride = hits.outcome.stride = hits.component.stride = sizeof(float);
    for (size_t body = 0; body < window->count; ++body) {
        collide_axis axis;
        outcomes[body] = window->component[body] >= 0 ? SPT_HIT : SPT_MISS;
        if (outcomes[body] != SPT_HIT) continue;
        read_axis(call->bodies, window->first + body, &axis);
        put_point(&axis, window->place[body], window, body);
        window->distance[body] = 0.0f; /* t */
    }
    spt_normals(call->fields, call->field_count, &call->settings, SPT_NORMAL_CENTRAL, 0.0f,
                window->count, &rays, &hits, &sinks);
    for (size_t body = 0; body < window->count; ++body) {
        for (int i = 0; i < 3; ++i) {
            spti_write(&call->contacts->normal.axis[i], window->first + body, normals[i][body]);
        }
    }
}

/* Rounded so that it is never more. */
static float body_distance(float bound, float radius) {
    if (!(bound <= FLT_MAX)) return INFINITY;
    if (!(bound >= -FLT_MAX)) return -INFINITY;
    const double exact = (double)bound - (double)radius;
    const double less = exact - 0x1p-24 * fabs(exact);
    return less > -(double)FLT_MAX ? (float)less : -INFINITY;
}

static void write_window(const collide_call *call, collide_window *window) {
    const spt_contacts *const contacts = call->contacts;
    for (size_t body = 0; body < window->count; ++body) {
        const size_t index = window->first + body;
        const float distance = body_distance(window->bound[body], window->radius[body]);
        spti_write(&contacts->distance, index, distance);
        spti_write(&contacts->place, index, window->place[body]);
        spti_write_integer(&contacts->component, index, window->component[body]);
    }
}

static void collide_window_of(collide_call *call, size_t first, size_t count) {
    const spt_vector_sinks *const normal = &call->contacts->normal;
    collide_window window;
    begin_window(call, first, count, &window);
    for (size_t index = 0; index < call->field_count && call->most > 0; ++index) {
        spti_target_of(&call->target, call->fields, index, &call->settings);
        call->component = (int32_t)index;
        ask_middles(call, &window);
        if (window.open_count > 0) search_axes(call, &window);
    }
    if (normal->axis[0].first != NULL || normal->axis[1].first != NULL ||
        normal->axis[2].first != NULL) {
        write_normals(call, &window);
    }
    write_window(call, &window);
}

static int bodies_fit(const spt_bodies *bodies, size_t count) {
    int ends = 0;
    for (int i = 0; i < 3; ++i) {
        ends += bodies->to.axis[i].first != NULL;
        if (!spti_column_fits(&bodies->to.axis[i], count)) return 0;
    }
    return (ends == 0 || ends == 3) && spti_vectors_fit(&bodies->from, count) &&
           spti_column_fits(&bodies->radius, count);
}

static int contacts_fit(const spt_contacts *contacts, size_t count) {
    for (int i = 0; i < 3; ++i) {
        if (!spti_sink_fits(&contacts->normal.axis[i], count)) return 0;
    }
    return spti_sink_fits(&contacts->distance, count) && spti_sink_fits(&contacts->place, count) &&
           spti_sink_fits(&contacts->component, count);
}

spt_status spt_collide(const spt_field *fields, size_t field_count, const spt_settings *settings,
                       size_t count, const spt_bodies *bodies, const spt_contacts *contacts) {
    collide_call call;
    if (!spti_fields_are_good(fields, field_count)) return SPT_BAD_ARGUMENT;
    if (!spti_settings_copy(&call.settings, settings)) return SPT_BAD_ARGUMENT;
    if (count == 0) return SPT_OK;
    if (bodies == NULL || contacts == NULL) return SPT_BAD_ARGUMENT;
    if (!bodies_fit(bodies, count) || !contacts_fit(contacts, count)) return SPT_BAD_ARGUMENT;
    call.fields = fields;
    call.field_count = field_count;
    call.most = call.settings.budget < MOST_SAMPLES ? call.settings.budget : MOST_SAMPLES;
    call.bodies = bodies;
    call.contacts = contacts;
    for (size_t first = 0; first < count; first += SPT_BATCH) {
        collide_window_of(&call, first, spti_window(first, count));
    }
    return SPT_OK;
}
