/* SPDX-License-Identifier: MIT
 *
 * Hits of a scene and what follows from them, in columns. */
#include "surface_scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Primary rays ---------------------------------------------------------------------------- */

static void write_rays(surface_scene *self) {
    spt_ray rays[surface_scene_most];
    static spt_ray all[surface_scene_most * 4];
    scene_rays_tiled(self->shown, 40, 26, all, NULL, &self->settings.pixel_radius);
    for (size_t i = 0; i < self->count; ++i) {
        spt_ray *const ray = &rays[i];
        *ray = all[i * (40 * 26) / self->count];
        if (i % 7 == 0) { /* of another length */
            const float length = ldexpf(1, (int)(i % 40) - 20);
            for (int axis = 0; axis < 3; ++axis) ray->direction[axis] *= length;
            ray->t_max /= length;
        }
        if (i % 50 == 3) ray->t_min = 0.4f * ray->t_max;
        if (i % 90 == 4) ray->direction[i % 3] = NAN;
        if (i % 90 == 5) ray->t_max = -1;
        if (i % 90 == 6) ray->t_max = INFINITY;
        for (int axis = 0; axis < 3; ++axis) {
            self->in[IN_ORIGIN + axis][i] = surface_bits(ray->origin[axis]);
            self->in[IN_DIRECTION + axis][i] = surface_bits(ray->direction[axis]);
        }
        self->in[IN_T_MIN][i] = surface_bits(ray->t_min);
        self->in[IN_T_MAX][i] = surface_bits(ray->t_max);
        self->in[IN_PATH][i] = surface_bits(0.25f * (float)(i % 3));
        self->in[IN_ACTIVE][i] = i % 31 != 30;
        self->in[IN_CROSS][i] = i % 2;
        self->in[IN_TANGENT][i] = surface_bits(0.01f + 0.02f * (float)(i % 9));
        self->in[IN_RADIUS][i] = surface_bits(0.02f * (float)(i % 4));
    }
}

static void trace(surface_scene *self) {
    surface_call call;
    surface_scene_call(&call, self, DOOR_CONVEX, 1);
    const spt_rays rays = surface_rays(&call);
    const spt_hits hits = surface_hits(&call);
    const size_t size = spt_scene_workspace(&self->parts.scene, &self->settings);
    void *const workspace = malloc(size);
    if (workspace == NULL) abort();
    if (spt_scene_trace(&self->parts.scene, &self->settings, self->count, &rays, &hits, workspace,
                        size, NULL) != SPT_OK) {
        abort();
    }
    free(workspace);
    for (int column = 0; column < 9; ++column) {
        memcpy(self->hits[column], self->out[column], sizeof self->hits[column]);
    }
}

void surface_scene_make(surface_scene *self, const scene *shown, size_t count) {
    memset(self, 0, sizeof *self);
    self->shown = shown;
    self->count = count;
    self->settings = spt_settings_default();
    self->settings.budget = 60;
    write_rays(self);
    trace(self);
}

/* ---- Calls ----------------------------------------------------------------------------------- */

int surface_scene_has(const surface_scene *self, surface_door door) {
    return door != DOOR_CONVEX || self->shown->bound != NULL;
}

void surface_scene_clear(const surface_scene *self, surface_door door, surface_scene_outputs out) {
    const uint32_t read = surface_table[door].outputs_kept | surface_table[door].outputs_changed;
    memset(out, 0xa5, sizeof(surface_scene_outputs));
    for (int column = 0; column < 9; ++column) {
        if (!SURFACE_HAS(read, column)) continue;
        memcpy(out[column], self->hits[column], sizeof self->hits[column]);
    }
}

void surface_scene_call(surface_call *call, surface_scene *self, surface_door door, int lanes) {
    memset(call, 0, sizeof *call);
    scene_parts_of(self->shown, SCENE_OBJECTS, lanes, &self->parts);
    self->whole = scene_field(self->shown, lanes);
    self->settings.max_lanes = (uint32_t)lanes;
    surface_scene_clear(self, door, self->out);
    const int many = (surface_table[door].takes & TAKES_FIELDS) != 0;
    call->door = door;
    call->fields = many ? self->parts.fields : &self->whole;
    call->field_count = many ? self->parts.scene.count : 1;
    call->settings = &self->settings;
    call->count = self->count;
    for (int column = 0; column < surface_inputs; ++column) {
        call->in[column].first = self->in[column];
        call->in[column].stride = 4;
    }
    for (int column = 0; column < surface_outputs; ++column) {
        call->out[column].first = self->out[column];
        call->out[column].stride = (ptrdiff_t)surface_width(column);
    }
    call->crossing_step = 4;
    call->most_crossings = surface_most_crossings;
    call->iterations = 3;
    call->checks = 2;
    call->samples = 3;
    call->distance = 0.1f;
    call->rule = SPT_NORMAL_CENTRAL;
}

/* ---- From one call to the next --------------------------------------------------------------- */

/* Secondary rays leave by the normal, turned a little, on the side that was asked for. */
static void write_secondary(surface_scene *self, size_t i) {
    const float sign = self->in[IN_CROSS][i] != 0 ? -1.0f : 1.0f;
    const float turned[] = {0.3f * (float)(i % 3) - 0.3f, 0.2f * (float)(i % 5) - 0.4f,
                            0.1f * (float)(i % 7) - 0.3f};
    for (int axis = 0; axis < 3; ++axis) {
        const float normal = surface_float(self->in[IN_NORMAL + axis][i]);
        const float origin = surface_float(self->out[OUT_VECTOR + axis][i]);
        const float direction = sign * normal + turned[axis];
        const float away = 0.4f * direction;
        self->in[IN_ORIGIN + axis][i] = self->in[IN_POINT + axis][i] = surface_bits(origin);
        self->in[IN_DIRECTION + axis][i] = surface_bits(direction);
        self->in[IN_TO + axis][i] = surface_bits(origin + away);
    }
    self->in[IN_T_MIN][i] = surface_bits(0.0f);
    self->in[IN_T_MAX][i] = surface_bits(i % 4 != 0 ? 5.0f : INFINITY);
    self->in[IN_PATH][i] = self->out[OUT_NEW_PATH][i];
}

void surface_scene_go_on(surface_scene *self, surface_door door) {
    for (size_t i = 0; i < self->count; ++i) {
        const int hit = self->hits[OUT_OUTCOME][i] == SPT_HIT && self->in[IN_ACTIVE][i] != 0;
        if (door == DOOR_REFINE) {
            self->hits[OUT_T][i] = self->out[OUT_T][i];
            self->hits[OUT_RESIDUAL][i] = self->out[OUT_RESIDUAL][i];
        }
        for (int axis = 0; axis < 3 && door == DOOR_NORMALS; ++axis) {
            self->in[IN_NORMAL + axis][i] = hit ? self->out[OUT_VECTOR + axis][i] : 0;
        }
        if (door != DOOR_OFFSET) continue;
        for (int axis = 0; axis < 3 && !hit; ++axis) { /* primary rays that hit nothing stay */
            self->in[IN_POINT + axis][i] = self->in[IN_ORIGIN + axis][i];
            self->in[IN_TO + axis][i] = self->in[IN_ORIGIN + axis][i];
        }
        if (hit) write_secondary(self, i);
    }
}
