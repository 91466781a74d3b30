/* SPDX-License-Identifier: MIT
 *
 * What the models are built with: see model_build.h. */
#include "model_build.h"

#include <math.h>
#include <string.h>

/* splitmix32 */
double model_random(uint32_t *state, double low, double high) {
    uint32_t x = *state += 0x9e3779b9u;
    x = (x ^ (x >> 16)) * 0x85ebca6bu;
    x = (x ^ (x >> 13)) * 0xc2b2ae35u;
    return low + (high - low) * ((x ^ (x >> 16)) / 4294967296.0);
}

double model_dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

void model_cross(const double a[3], const double b[3], double product[3]) {
    product[0] = a[1] * b[2] - a[2] * b[1];
    product[1] = a[2] * b[0] - a[0] * b[2];
    product[2] = a[0] * b[1] - a[1] * b[0];
}

void model_unit(double v[3]) {
    const double length = sqrt(model_dot(v, v));
    for (int axis = 0; axis < 3; ++axis) v[axis] /= length;
}

void model_begin(model_world *world) {
    memset(world->components, 0, sizeof world->components);
    world->count = 0;
}

model_component *model_add_krs(model_world *world, const spt_krs_model *described,
                               model_material material) {
    if (world->count == MODEL_COMPONENTS) return NULL;
    const size_t place = world->count;
    spt_krs *const krs = &world->krs[place];
    if (spt_krs_build(described, krs) != SPT_OK) return NULL;
    const model_component component = {.krs = krs, .material = material, .tint = {1, 1, 1}};
    world->fields[place] = spt_krs_field(krs);
    world->components[place] = component;
    world->count = place + 1;
    return &world->components[place];
}

model_component *model_distort(model_world *world, const spt_distortion *distortion) {
    if (world->count == 0) return NULL;
    const size_t place = world->count - 1;
    spt_distorted *const distorted = &world->distorted[place];
    const spt_field inner = world->fields[place];
    if (spt_distorted_field(&inner, distortion, distorted, &world->fields[place]) != SPT_OK) {
        return NULL;
    }
    world->components[place].distorted = distorted;
    return &world->components[place];
}

int model_finish(model_world *world) {
    world->scene = spt_scene_default();
    world->scene.fields = world->fields;
    world->scene.count = world->count;
    return world->count > 0;
}
