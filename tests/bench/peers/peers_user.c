/* SPDX-License-Identifier: MIT
 *
 * Embree's callbacks for the village. Built with all that the machine has, as its user would. */
#include "peers_user.h"

#include <string.h>

#include "peers_march.h"
#include "peers_packet.h"

enum { PACKET = 16 };

/* Rows of a ray of Embree's packets: row r of lane k of N is ((float *)rayhit)[r * N + k]. */
enum {
    ROW_ORIGIN = 0,
    ROW_T_NEAR = 3,
    ROW_DIRECTION = 4,
    ROW_T_FAR = 8,
    ROW_NORMAL = 12,
    ROW_U = 15,
    ROW_V = 16,
    ROW_PRIMITIVE = 17,
    ROW_GEOMETRY = 18,
    ROW_INSTANCE = 19
};

void peers_user_bounds(const struct RTCBoundsFunctionArguments *arguments) {
    const peers_village *const village = arguments->geometryUserPtr;
    const peers_object *const object = &village->objects[arguments->primID];
    struct RTCBounds *const box = arguments->bounds_o;
    box->lower_x = object->low[0];
    box->lower_y = object->low[1];
    box->lower_z = object->low[2];
    box->upper_x = object->high[0];
    box->upper_y = object->high[1];
    box->upper_z = object->high[2];
}

/* The normal is left to whoever shades, as it is on the other side of the race. */
static void write_hit(const struct RTCIntersectFunctionNArguments *arguments, unsigned lane,
                      float t) {
    const unsigned n = arguments->N;
    float *const row = (float *)arguments->rayhit + lane;
    unsigned *const id = (unsigned *)arguments->rayhit + lane;
    row[ROW_T_FAR * n] = t;
    for (unsigned axis = 0; axis < 3; ++axis) row[(ROW_NORMAL + axis) * n] = 0;
    row[ROW_U * n] = 0;
    row[ROW_V * n] = 0;
    id[ROW_PRIMITIVE * n] = arguments->primID;
    id[ROW_GEOMETRY * n] = arguments->geomID;
    id[ROW_INSTANCE * n] = arguments->context->instID[0];
}

static float trace_ray(const peers_step *step, const peers_object *object, const peers_ray *ray) {
    if (object->house == NULL) {
        return step->adaptive ? peers_march_adaptive(NULL, step, ray)
                              : peers_march_basic(NULL, step, ray);
    }
    return step->adaptive ? peers_march_adaptive(object->house, step, ray)
                          : peers_march_basic(object->house, step, ray);
}

static void intersect_ray(const struct RTCIntersectFunctionNArguments *arguments,
                          const peers_step *step, const peers_object *object, unsigned lane) {
    const unsigned n = arguments->N;
    const float *const row = (const float *)arguments->rayhit + lane;
    peers_ray ray;
    for (unsigned axis = 0; axis < 3; ++axis) {
        ray.origin[axis] = row[(ROW_ORIGIN + axis) * n];
        ray.direction[axis] = row[(ROW_DIRECTION + axis) * n];
    }
    ray.t_in = row[ROW_T_NEAR * n];
    ray.t_out = row[ROW_T_FAR * n];
    if (!peers_clip(object, &ray)) return;
    const float t = trace_ray(step, object, &ray);
    if (t >= 0 && t < row[ROW_T_FAR * n]) write_hit(arguments, lane, t);
}

static spt_wide trace_lanes(const peers_step *step, const peers_object *object,
                            const peers_lanes *rays) {
    if (object->house == NULL) {
        return step->adaptive ? peers_march_adaptive_lanes(NULL, step, rays)
                              : peers_march_basic_lanes(NULL, step, rays);
    }
    return step->adaptive ? peers_march_adaptive_lanes(object->house, step, rays)
                          : peers_march_basic_lanes(object->house, step, rays);
}

/* A number's bits in every lane. */
static spt_wide splat_bits(unsigned bits) {
    float number;
    memcpy(&number, &bits, sizeof number);
    return spt_splat(number);
}

static void write_hits(const struct RTCIntersectFunctionNArguments *arguments, unsigned first,
                       spt_mask hit, spt_wide t) {
    const struct {
        unsigned row;
        spt_wide value;
    } rows[] = {{ROW_T_FAR, t},
                {ROW_NORMAL, spt_splat(0)},
                {ROW_NORMAL + 1, spt_splat(0)},
                {ROW_NORMAL + 2, spt_splat(0)},
                {ROW_U, spt_splat(0)},
                {ROW_V, spt_splat(0)},
                {ROW_PRIMITIVE, splat_bits(arguments->primID)},
                {ROW_GEOMETRY, splat_bits(arguments->geomID)},
                {ROW_INSTANCE, splat_bits(arguments->context->instID[0])}};
    for (unsigned i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        float *const place = (float *)arguments->rayhit + rows[i].row * PACKET + first;
        spt_store(place, spt_select(hit, rows[i].value, spt_load(place)));
    }
}

/* Lanes first .. first + SPT_LANES - 1 of a packet of 16. */
static void intersect_lanes(const struct RTCIntersectFunctionNArguments *arguments,
                            const peers_step *step, const peers_object *object, unsigned first) {
    const float *const row = (const float *)arguments->rayhit + first;
    const int *const valid = arguments->valid + first;
    float number[SPT_LANES];
    peers_lanes rays;
    for (int axis = 0; axis < 3; ++axis) {
        rays.origin[axis] = spt_load(row + (ROW_ORIGIN + axis) * PACKET);
        rays.direction[axis] = spt_load(row + (ROW_DIRECTION + axis) * PACKET);
    }
    rays.t_in = spt_load(row + ROW_T_NEAR * PACKET);
    rays.t_out = spt_load(row + ROW_T_FAR * PACKET);
    for (int lane = 0; lane < SPT_LANES; ++lane) number[lane] = (float)valid[lane];
    rays.alive = spt_less(spt_load(number), spt_splat(0)); /* -1: valid */
    peers_clip_lanes(object, &rays);
    if (!spt_any(rays.alive)) return;
    const spt_wide t = trace_lanes(step, object, &rays);
    const spt_mask hit = spt_mask_and(spt_less_equal(spt_splat(0), t),
                                      spt_less(t, spt_load(row + ROW_T_FAR * PACKET)));
    if (spt_any(hit)) write_hits(arguments, first, hit, t);
}

void peers_user_intersect(const struct RTCIntersectFunctionNArguments *arguments) {
    const peers_village *const village = arguments->geometryUserPtr;
    const peers_object *const object = &village->objects[arguments->primID];
    const peers_step *const step = &village->step;
    if (arguments->N == PACKET && !village->ray_by_ray) {
        for (unsigned first = 0; first < PACKET; first += SPT_LANES) {
            intersect_lanes(arguments, step, object, first);
        }
        return;
    }
    for (unsigned lane = 0; lane < arguments->N; ++lane) {
        if (arguments->valid[lane] != 0) intersect_ray(arguments, step, object, lane);
    }
}
