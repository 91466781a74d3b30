/* SPDX-License-Identifier: MIT
 *
 * Asking spt_krs_locate(). */
#include "krs_places.h"
#include "../check.h"

static spt_sink sink_of(void *first) {
    const spt_sink sink = {first, (ptrdiff_t)sizeof(krs_place)};
    return sink;
}

spt_krs_places krs_places_of(krs_place *array) {
    spt_krs_places places;
    places.kernel = sink_of(&array->kernel);
    places.mirrors = sink_of(&array->mirrors);
    for (int axis = 0; axis < 3; ++axis) {
        places.point.axis[axis] = sink_of(&array->point[axis]);
        places.normal.axis[axis] = sink_of(&array->normal[axis]);
        places.kernel_normal.axis[axis] = sink_of(&array->kernel_normal[axis]);
    }
    places.u = sink_of(&array->u);
    places.v = sink_of(&array->v);
    places.scale = sink_of(&array->scale);
    return places;
}

void krs_locate_points(const spt_krs *krs, float pixel_radius, float path, size_t count,
                       const float (*points)[3], krs_place *places) {
    static const float direction[3] = {0, 0, 1};
    static float zeros[krs_most_points];
    const spt_krs_places view = krs_places_of(places);
    spt_settings settings = spt_settings_default();
    spt_rays rays = {0};
    spt_hits hits = {0};
    CHECK(count <= krs_most_points);
    for (int axis = 0; axis < 3; ++axis) {
        rays.origin[axis].first = &points[0][axis];
        rays.origin[axis].stride = (ptrdiff_t)sizeof points[0];
        rays.direction[axis].first = &direction[axis];
    }
    rays.path.first = &path;
    hits.t.first = zeros;
    hits.t.stride = (ptrdiff_t)sizeof zeros[0];
    settings.pixel_radius = pixel_radius;
    CHECK(spt_krs_locate(krs, 0, &settings, count, &rays, &hits, &view) == SPT_OK);
}
