/* SPDX-License-Identifier: MIT
 *
 * Memory of the queues, and how light divides at glass. */
#include "whitted_queue.h"

#include <math.h>
#include <stdlib.h>

whitted_ray *whitted_push(whitted_queue *queue) {
    if (queue->count == queue->capacity) {
        const size_t capacity = queue->capacity > 0 ? 2 * queue->capacity : 4096;
        whitted_ray *const rays = realloc(queue->rays, capacity * sizeof *rays);
        if (rays == NULL) return NULL;
        queue->rays = rays;
        queue->capacity = capacity;
    }
    return &queue->rays[queue->count++];
}

spt_rays whitted_columns(const whitted_queue *queue) {
    const ptrdiff_t stride = (ptrdiff_t)sizeof *queue->rays;
    spt_rays columns = spt_rays_of(&queue->rays->ray);
    for (int axis = 0; axis < 3; ++axis) {
        columns.origin[axis].stride = columns.direction[axis].stride = stride;
    }
    columns.t_min.stride = columns.t_max.stride = stride;
    columns.path.first = &queue->rays->path;
    columns.path.stride = stride;
    columns.active.first = &queue->rays->active;
    columns.active.stride = stride;
    return columns;
}

static int grow(void *array, size_t bytes) {
    void **const place = array;
    void *const moved = realloc(*place, bytes);
    if (moved == NULL) return 0;
    *place = moved;
    return 1;
}

int whitted_reserve(whitted_work *work, size_t count) {
    if (count <= work->room) return 1;
    const size_t room = count + count / 2;
    work->room = 0;
    if (!grow(&work->hits, room * sizeof *work->hits) ||
        !grow(&work->normals, room * 3 * sizeof *work->normals) ||
        !grow(&work->origins, room * 3 * sizeof *work->origins) ||
        !grow(&work->paths, room * sizeof *work->paths) ||
        !grow(&work->starts, room * sizeof *work->starts) ||
        !grow(&work->wanted, room * sizeof *work->wanted) ||
        !grow(&work->objects, room * sizeof *work->objects) ||
        !grow(&work->splits, room * sizeof *work->splits)) {
        work->failed = 1;
        return 0;
    }
    work->room = room;
    return 1;
}

void whitted_free(whitted_work *work) {
    void *const all[] = {work->air.rays,       work->body.rays,    work->next_air.rays,
                         work->next_body.rays, work->shadows.rays, work->hits,
                         work->normals,        work->origins,      work->paths,
                         work->starts,         work->wanted,       work->objects,
                         work->splits};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; ++i) free(all[i]);
}

whitted_split whitted_split_at(const float direction[3], const float normal[3], float index,
                               int is_inside) {
    const float from = is_inside ? index : 1.0f, into = is_inside ? 1.0f : index;
    const float ratio = from / into, side = is_inside ? -1.0f : 1.0f;
    whitted_split split;
    float towards[3], square = 0.0f, cosine = 0.0f;
    for (int axis = 0; axis < 3; ++axis) square += normal[axis] * normal[axis];
    for (int axis = 0; axis < 3; ++axis) {
        towards[axis] = square > 0.5f ? side * normal[axis] : -direction[axis];
        cosine -= towards[axis] * direction[axis];
    }
    /* Differences over an edge may give a normal that the ray does not see. */
    if (!(cosine > 0.0f)) cosine = 0.0f;
    const float sine_square = ratio * ratio * spt_greatest(1.0f - cosine * cosine, 0.0f);
    const float cosine_into = sqrtf(spt_greatest(1.0f - sine_square, 0.0f));
    const float across =
        (from * cosine - into * cosine_into) / (from * cosine + into * cosine_into);
    const float along = (from * cosine_into - into * cosine) / (from * cosine_into + into * cosine);
    split.reflectance =
        sine_square < 1.0f ? spt_least(0.5f * (across * across + along * along), 1.0f) : 1.0f;
    for (int axis = 0; axis < 3; ++axis) {
        split.reflected[axis] = direction[axis] + 2.0f * cosine * towards[axis];
        split.refracted[axis] =
            ratio * direction[axis] + (ratio * cosine - cosine_into) * towards[axis];
    }
    return split;
}
