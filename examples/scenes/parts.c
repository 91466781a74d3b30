/* SPDX-License-Identifier: MIT
 *
 * The table of components. Their callbacks are in scenes_lanes.c and scenes_reference.c, built from
 * the same list. */
#include "parts.h"
#include "parts_source.h"
#include "scene_source.h"
#include "scenes_widths.h"
#include "village.h"

#include <string.h>

/* A line of the list: one component, or one for each entry of a table. */
typedef struct piece {
    const char *scene;
    scene_grain only; /* the grain that has it; SCENE_WHOLE: both finer ones */
    float lipschitz;  /* 0: the scene's */
    uint32_t flags;
    part_extent extent;
    part_place_fn *place; /* what an entry makes of the extent, or NULL */
    const void *table;    /* its entries, or NULL */
    size_t count, entry_size;
    spt_distance_batch_fn *batch[4];
    spt_distance_fn *point; /* NULL: the callbacks and all else but the extent are the scene's */
    part_reference_fn *reference;
    const char *glsl, *glsl_prelude; /* as in spt_field */
    const char *const *texts;        /* in the place of glsl, those of the entries of a table */
} piece;

static void placed_box_extent(const void *entry, part_extent *extent);
static void arches_extent(const void *entry, part_extent *extent);

#define DECLARE_PART(name) \
    DECLARE_BATCHES(name) \
    spt_distance_fn scene_##name##_point; \
    part_reference_fn part_##name##_reference;
#define PART(shown, name, ...) DECLARE_PART(shown##_##name)
#define PART_TABLE(shown, name, ...) DECLARE_PART(shown##_##name)
#define PART_WHOLE(shown, ...)
#include "parts_list.h"

#define CALLBACKS(name) \
    .batch = BATCHES(name), .point = scene_##name##_point, .reference = part_##name##_reference
static const piece pieces[] = {
#define PART(shown, name, ...) \
    {.scene = #shown, \
     .count = 1, \
     CALLBACKS(shown##_##name), \
     .glsl = "    return " GLSL_##shown##_##name ";\n", \
     __VA_ARGS__},
#define PART_TABLE(shown, name, distance_of, type, entries, number, ...) \
    {.scene = #shown, \
     .table = (entries), \
     .count = (number), \
     .entry_size = sizeof(type), \
     CALLBACKS(shown##_##name), \
     .texts = GLSL_##shown##_##name, \
     __VA_ARGS__},
#define PART_WHOLE(shown, ...) {.scene = #shown, .count = 1, __VA_ARGS__},
#include "parts_list.h"
};
enum { piece_count = sizeof pieces / sizeof pieces[0] };

static void placed_box_extent(const void *entry, part_extent *extent) {
    const placed_box *const box = entry;
    const double x = (double)box->center.x, y = (double)box->center.y, z = (double)box->center.z;
    const double half_x = (double)box->half.x, half_y = (double)box->half.y,
                 half_z = (double)box->half.z;
    const part_extent around =
        BOX(x - half_x, y - half_y, z - half_z, x + half_x, y + half_y, z + half_z);
    *extent = around;
}

/* From the place of the part to the nave, where the middle of the middle bay is at z = -1.2. */
static void arches_extent(const void *entry, part_extent *extent) {
    const arches_place *const place = entry;
    const double z = 2 * (double)place->bay - 1.2;
    if (place->side < 0) {
        const double left = -extent->high[0];
        extent->high[0] = -extent->low[0];
        extent->low[0] = left;
    }
    extent->low[2] += z;
    extent->high[2] += z;
}

/* The extent as floats, moved out by 16 roundings of its largest coordinate: those of the constants
 * in the source, of a turned house's unit vector and of these sums. */
static spt_bound rounded_outward(const part_extent *extent) {
    const double rounding = 1.0 / (1 << 20);
    double largest = 0;
    for (int axis = 0; axis < 3; ++axis) {
        if (extent->kind == SPT_BOUND_SPHERE) {
            largest = fmax(largest, fabs(extent->center[axis]) + extent->radius);
        } else {
            largest = fmax(largest, fmax(fabs(extent->low[axis]), fabs(extent->high[axis])));
        }
    }
    const double out = rounding * largest;
    if (extent->kind == SPT_BOUND_SPHERE) {
        return spt_bound_sphere((float)extent->center[0], (float)extent->center[1],
                                (float)extent->center[2], (float)(extent->radius + out));
    }
    return spt_bound_box((float)(extent->low[0] - out), (float)(extent->low[1] - out),
                         (float)(extent->low[2] - out), (float)(extent->high[0] + out),
                         (float)(extent->high[1] + out), (float)(extent->high[2] + out));
}

/* What a box and the scene's have in common: outside the scene's nothing is promised. */
static void clip(spt_bound *bound, const spt_bound *whole) {
    if (whole == NULL || whole->kind != SPT_BOUND_BOX || bound->kind != SPT_BOUND_BOX) return;
    for (int axis = 0; axis < 3; ++axis) {
        if (bound->low[axis] < whole->low[axis]) bound->low[axis] = whole->low[axis];
        if (bound->high[axis] > whole->high[axis]) bound->high[axis] = whole->high[axis];
    }
}

/* Entry of a piece as a field; bound receives its bound. */
static spt_field field_of(const scene *shown, const piece *one, size_t entry, int lanes,
                          spt_bound *bound) {
    spt_field field = scene_field(shown, lanes);
    part_extent extent = one->extent;
    const char *const user =
        one->table == NULL ? NULL : (const char *)one->table + entry * one->entry_size;
    if (one->place != NULL) one->place(user, &extent);
    if (extent.kind != 0) {
        *bound = rounded_outward(&extent);
        clip(bound, shown->bound);
        field.bound = bound;
    }
    if (one->point == NULL) return field;
    field.batch = lanes == 0 ? NULL : one->batch[batch_index(lanes)];
    field.point = lanes == 0 ? one->point : NULL;
    field.user = (void *)(uintptr_t)user; /* read only there */
    field.glsl = one->texts != NULL ? one->texts[entry] : one->glsl;
    field.glsl_prelude = one->glsl_prelude;
    field.flags = one->flags;
    if (one->lipschitz > 0) field.lipschitz = one->lipschitz;
    return field;
}

static int belongs(const piece *one, const scene *shown, scene_grain grain) {
    if (grain == SCENE_WHOLE || strcmp(one->scene, shown->name) != 0) return 0;
    return one->only == SCENE_WHOLE || one->only == grain;
}

void scene_parts_of(const scene *shown, scene_grain grain, int lanes, scene_parts *parts) {
    size_t count = 0;
    for (size_t i = 0; i < piece_count; ++i) {
        if (!belongs(&pieces[i], shown, grain)) continue;
        for (size_t entry = 0; entry < pieces[i].count; ++entry) {
            parts->fields[count] = field_of(shown, &pieces[i], entry, lanes, &parts->bounds[count]);
            ++count;
        }
    }
    if (count == 0) parts->fields[count++] = scene_field(shown, lanes);
    parts->scene = spt_scene_default();
    parts->scene.fields = parts->fields;
    parts->scene.count = count;
}

void scene_part_reference(const scene *shown, scene_grain grain, size_t index, size_t n,
                          const double *x, const double *y, const double *z, double *distance) {
    for (size_t i = 0; i < piece_count; ++i) {
        if (!belongs(&pieces[i], shown, grain)) continue;
        if (index < pieces[i].count && pieces[i].reference != NULL) {
            pieces[i].reference(index, n, x, y, z, distance);
            return;
        }
        index -= pieces[i].count;
    }
    shown->reference(n, x, y, z, distance);
}
