/* SPDX-License-Identifier: MIT
 *
 * Where hits lie in a model, and their normals, smoothed near mirrors. One point after the other, by
 * the same operations as the kernels, so that what is nearest here was nearest there. */
#include "locate.h"

#include <math.h>
#include <string.h>

#include "../base/arguments.h"
#include "../surface/landing.h"
#define SPT_LANES 1
#include "fold_kernel.h"
#include "pull_kernel.h"

/* What a point met on its way down to its kernel, by level. */
typedef struct locate_trail {
    float beyond[SPT_KRS_LEVELS];     /* the mirror, before it was folded */
    spt_quaternion u[SPT_KRS_LEVELS]; /* of the map, of length 1 */
    float shrink[SPT_KRS_LEVELS];     /* lengths at the mirror are so many times the world's */
} locate_trail;

/* The direction of u = a - x c, which is (pole - x) c. */
static void find_denominator(const spt_built_map *map, shape_points x, spt_quaternion *u) {
    const spt_quaternion c = spt_quaternion_of((double)map->c[0], (double)map->c[1],
                                               (double)map->c[2], (double)map->c[3]);
    const spt_quaternion a = spt_quaternion_of((double)map->a[0], (double)map->a[1],
                                               (double)map->a[2], (double)map->a[3]);
    const spt_quaternion away =
        spt_quaternion_of(0, (double)map->pole[0] - (double)x.x, (double)map->pole[1] - (double)x.y,
                          (double)map->pole[2] - (double)x.z);
    *u = map->c_length > 0.0f ? spt_quaternion_product(away, c) : a;
    const double square = spt_quaternion_square(*u);
    *u = square > 0 ? spt_quaternion_scaled(*u, 1 / sqrt(square)) : spt_quaternion_of(1, 0, 0, 0);
}

/* Through mirror `level`, and map level - 1. */
static shape_points step_down(const spti_stretch *model, uint32_t level, shape_points x,
                              pull_scale *scale, locate_trail *trail, uint64_t *used) {
    if (level < model->levels) {
        const int has_mirror = model->maps == NULL || !(model->unmirrored >> level & 1);
        const float beyond = model->maps == NULL ? fold_beyond(&model->mirrors[level], x) : x.x;
        trail->beyond[level] = has_mirror ? beyond : -INFINITY;
        trail->shrink[level] = scale->shrink;
        if (has_mirror && beyond > 0.0f) *used |= UINT64_C(1) << level;
        x = model->maps == NULL ? fold_point(&model->mirrors[level], x)
                                : pull_mirror(model, level, x);
    }
    if (model->maps != NULL && level > 0) {
        find_denominator(&model->maps[level - 1], x, &trail->u[level - 1]);
        x = pull_level(&model->maps[level - 1], x, scale);
    }
    return x;
}

/* 0 on this side of the mirror, 1 on the other, and in between within the width. */
static double blend(double beyond, double width) {
    if (!(width > 0)) return beyond > 0 ? 1 : 0;
    const double s = (beyond + width) / (2 * width);
    if (!(s > 0)) return 0;
    return s < 1 ? s * s * (3 - 2 * s) : 1;
}

/* Appendix C: sign(lambda) u g u*, for u of length 1, which keeps the length of g. */
static void push_vector(const spt_built_map *map, spt_quaternion u, double g[3]) {
    const spt_quaternion vector = spt_quaternion_of(0, g[0], g[1], g[2]);
    const spt_quaternion pushed =
        spt_quaternion_product(spt_quaternion_product(u, vector), spt_quaternion_conjugate(u));
    g[0] = (double)map->orientation * pushed.x;
    g[1] = (double)map->orientation * pushed.y;
    g[2] = (double)map->orientation * pushed.z;
}

/* Widths of the blend at mirrors: in the space of the mirror, and in the world. */
typedef struct locate_widths {
    double smooth, footprint;
} locate_widths;

/* A kernel's gradient in the world. */
static void climb(const spti_stretch *model, const locate_trail *trail, uint32_t kernel,
                  const locate_widths *widths, double g[3]) {
    for (uint32_t level = kernel; level <= model->levels; ++level) {
        if (model->maps != NULL && level > 0) {
            push_vector(&model->maps[level - 1], trail->u[level - 1], g);
        }
        if (level == model->levels) break;
        const double pixel = widths->footprint * (double)trail->shrink[level];
        const double width = pixel > widths->smooth ? pixel : widths->smooth;
        const double part = 2 * blend((double)trail->beyond[level], width);
        if (model->maps != NULL) {
            g[0] -= part * g[0];
            continue;
        }
        const float *const normal = model->mirrors[level].normal;
        double along = 0;
        for (int axis = 0; axis < 3; ++axis) along += (double)normal[axis] * g[axis];
        for (int axis = 0; axis < 3; ++axis) g[axis] -= part * along * (double)normal[axis];
    }
}

static double length(const double v[3]) {
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* The normal of the kernel that was found. A blend that cancels says nothing: then that without. */
static void find_normal(const spti_stretch *model, const locate_trail *trail,
                        const locate_widths *widths, spti_place *place) {
    const locate_widths none = {0, 0};
    const uint32_t kernel = (uint32_t)place->kernel;
    double own[3], world[3];
    spti_kernel_gradient(&model->kernels[kernel], place->point, own);
    memcpy(world, own, sizeof world);
    climb(model, trail, kernel, widths, world);
    if (!(length(world) >= 1e-3)) {
        memcpy(world, own, sizeof world);
        climb(model, trail, kernel, &none, world);
    }
    const double size = length(world);
    const int good = size > 0.5e-3 && size <= 2;
    for (int axis = 0; axis < 3; ++axis) {
        place->kernel_normal[axis] = (float)own[axis];
        place->normal[axis] = good ? (float)(world[axis] / size) : 0.0f;
    }
}

/* The distance of kernel `level` from where the way down is, in the world. */
static float distance_there(const spti_stretch *model, uint32_t level, shape_points x,
                            const pull_scale *scale) {
    const float point[3] = {x.x, x.y, x.z};
    const float distance = spti_kernel_distance(&model->kernels[level], point);
    return model->maps != NULL ? pull_radius(scale, distance) : distance;
}

void spti_find_place(const spti_stretch *model, const float point[3], float smooth, float footprint,
                     spti_place *place) {
    const locate_widths widths = {(double)smooth, (double)footprint};
    locate_trail trail;
    shape_points x = {shape_in_range(point[0]), shape_in_range(point[1]), shape_in_range(point[2])};
    pull_scale scale = {1.0f, 0.0f, 0.0f};
    float least = INFINITY;
    uint64_t used = 0;
    memset(place, 0, sizeof *place);
    place->kernel = -1;
    place->scale = 1.0f;
    memcpy(place->point, point, sizeof place->point);
    for (uint32_t level = model->levels + 1; level-- > 0;) {
        x = step_down(model, level, x, &scale, &trail, &used);
        if (model->kernels[level].kind == SPT_KERNEL_EMPTY) continue;
        const float distance = distance_there(model, level, x, &scale);
        if (!(distance < least) && place->kernel >= 0) continue;
        least = distance;
        place->kernel = (int32_t)level;
        place->mirrors = used;
        place->point[0] = x.x;
        place->point[1] = x.y;
        place->point[2] = x.z;
        place->scale = 1.0f / scale.shrink; /* which is no less than FLT_MIN */
    }
    if (place->kernel < 0) return;
    find_normal(model, &trail, &widths, place);
    spti_kernel_parameters(&model->kernels[place->kernel], place->point, &place->u, &place->v);
}

void spti_place_gradients(const spti_stretch *model, float smooth, size_t n, const float *x,
                          const float *y, const float *z, float *gradient_x, float *gradient_y,
                          float *gradient_z) {
    for (size_t i = 0; i < n; ++i) {
        const float point[3] = {x[i], y[i], z[i]};
        spti_place place;
        spti_find_place(model, point, smooth, 0.0f, &place);
        gradient_x[i] = place.normal[0];
        gradient_y[i] = place.normal[1];
        gradient_z[i] = place.normal[2];
    }
}

static void write_vector(const spt_vector_sinks *sinks, size_t index, const float vector[3]) {
    for (int axis = 0; axis < 3; ++axis) spti_write(&sinks->axis[axis], index, vector[axis]);
}

static void write_place(const spt_krs_places *places, size_t index, const spti_place *place) {
    spti_write_integer(&places->kernel, index, place->kernel);
    if (places->mirrors.first != NULL) {
        memcpy((char *)places->mirrors.first + (ptrdiff_t)index * places->mirrors.stride,
               &place->mirrors, sizeof place->mirrors);
    }
    write_vector(&places->point, index, place->point);
    write_vector(&places->normal, index, place->normal);
    write_vector(&places->kernel_normal, index, place->kernel_normal);
    spti_write(&places->u, index, place->u);
    spti_write(&places->v, index, place->v);
    spti_write(&places->scale, index, place->scale);
}

static int places_fit(const spt_krs_places *places, size_t count) {
    const spt_vector_sinks *const vectors[] = {&places->point, &places->normal,
                                               &places->kernel_normal};
    const spt_sink *const sinks[] = {&places->kernel, &places->mirrors, &places->u, &places->v,
                                     &places->scale};
    int fit = 1;
    for (size_t i = 0; i < sizeof sinks / sizeof *sinks; ++i) {
        fit &= spti_sink_fits(sinks[i], count);
    }
    for (size_t i = 0; i < sizeof vectors / sizeof *vectors; ++i) {
        for (int axis = 0; axis < 3; ++axis) fit &= spti_sink_fits(&vectors[i]->axis[axis], count);
    }
    return fit;
}

/* All hits of a window are of one field here; which component's they are to be is read besides. */
static void locate_window(const spti_stretch *model, float smooth, int32_t component,
                          const spt_settings *settings, const spti_wish *wish,
                          const spt_krs_places *places) {
    const spt_column components = spti_column_of(&wish->hits->component);
    spti_landing landing;
    spti_land(wish, &landing);
    for (size_t slot = 0; slot < landing.count; ++slot) {
        const size_t index = wish->first + landing.place[slot];
        const float t = landing.t[slot];
        float point[3];
        spti_place place;
        if (spti_read_integer(&components, index, component) != component) continue;
        for (int axis = 0; axis < 3; ++axis) point[axis] = spti_point(&landing, axis, slot, t);
        spti_find_place(model, point, smooth, spti_allowance(settings, &landing, slot, t), &place);
        write_place(places, index, &place);
    }
}

spt_status spti_locate(const spti_stretch *model, float smooth, int32_t component,
                       const spt_settings *settings, size_t count, const spt_rays *rays,
                       const spt_hits *hits, const spt_krs_places *places) {
    spt_settings copy;
    if (!spti_settings_copy(&copy, settings)) return SPT_BAD_ARGUMENT;
    if (count == 0) return SPT_OK;
    if (rays == NULL || hits == NULL || places == NULL) return SPT_BAD_ARGUMENT;
    if (!spti_views_fit(rays, hits, count) || !places_fit(places, count)) return SPT_BAD_ARGUMENT;
    if (hits->t.first == NULL) return SPT_BAD_ARGUMENT;
    for (size_t first = 0; first < count; first += SPT_BATCH) {
        spti_wish wish;
        spti_wish_begin(&wish, rays, hits, first, count, 1);
        if (wish.component == 0) {
            locate_window(model, smooth, component, &copy, &wish, places);
        }
    }
    return SPT_OK;
}
