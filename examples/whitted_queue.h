/* SPDX-License-Identifier: MIT
 *
 * Queues of rays, which the library reads where they lie, and what a thread keeps of a generation
 * while it is traced. Belongs to whitted_render.c. */
#ifndef EXAMPLES_WHITTED_QUEUE_H
#define EXAMPLES_WHITTED_QUEUE_H

#include "whitted.h"

typedef struct whitted_ray {
    spt_ray ray;     /* unit direction */
    float path;      /* travelled before */
    float weight[3]; /* of the light that it finds, in its pixel; of a shadow ray: that light */
    uint32_t pixel;
    int32_t from;                     /* what it begins on, as in glass_world.h */
    int32_t inside;                   /* a ball, GLASS_BODY, or GLASS_NOTHING: in the air */
    int32_t active;                   /* whether it can meet the body */
    int16_t reflections, refractions; /* that it may still take */
} whitted_ray;

typedef struct whitted_queue {
    whitted_ray *rays;
    size_t count, capacity;
} whitted_queue;

/* Room for one more ray, counted in; NULL where memory ran out. */
whitted_ray *whitted_push(whitted_queue *queue);

/* Its columns. */
spt_rays whitted_columns(const whitted_queue *queue);

/* How light divides where a ray meets glass. */
typedef struct whitted_split {
    float reflected[3], refracted[3]; /* unit directions */
    float reflectance;                /* the part that is reflected; 1: all, in total reflection */
} whitted_split;

/* By Snell and Fresnel, unpolarised.
 *   normal  of unit length, outward; (0, 0, 0): against the ray
 *   index   of the glass; is_inside: whether the ray comes from within */
whitted_split whitted_split_at(const float direction[3], const float normal[3], float index,
                               int is_inside);

/* A thread's own. */
typedef struct whitted_work {
    const glass_world *world;
    const whitted_settings *settings;
    spt_field field;
    spt_settings tracing; /* of secondary rays */
    whitted_queue air, body, next_air, next_body, shadows;
    /* As long as the queue that is being traced: */
    size_t room;
    spt_hit *hits;
    float *normals, *origins; /* threes */
    float *paths;
    int32_t *starts, *wanted, *objects;
    whitted_split *splits;
    float pixel_radius; /* half a pixel at distance 1, also where rays go without cones */
    float *pixels;
    int failed; /* memory ran out, or the library refused */
    whitted_statistics statistics;
} whitted_work;

/* Makes room for a generation of so many rays; 0 where memory ran out. */
int whitted_reserve(whitted_work *work, size_t count);

void whitted_free(whitted_work *work);

/* Traces a queue against the body, refines its hits and finds their normals: work->hits, normals.
 * Rays that are not active miss. */
void whitted_land(whitted_work *work, const whitted_queue *queue, whitted_kind kind);

/* One generation: of rays in the air, and of rays in the body. */
void whitted_trace_air(whitted_work *work, whitted_kind kind);
void whitted_trace_body(whitted_work *work);

/* A ray came to a matt point: adds its light but the sun's, and asks for that. */
void whitted_shade(whitted_work *work, const whitted_ray *ray, int object, const float point[3]);

/* Adds the light of the shadow queue to the pixels, as far as it comes through, and empties it. */
void whitted_trace_shadows(whitted_work *work);

/* Adds weight * light to the ray's pixel. */
static inline void whitted_add(const whitted_work *work, const whitted_ray *ray,
                               const float weight[3], const float light[3]) {
    float *const pixel = &work->pixels[3 * (size_t)ray->pixel];
    for (int c = 0; c < 3; ++c) pixel[c] += weight[c] * light[c];
}

#endif
