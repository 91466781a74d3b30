/* SPDX-License-Identifier: MIT
 *
 * Scenes and models alike, for emit. */
#include "emit_subject.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *emit_subject_name(size_t number) {
    if (number < scene_count) return scenes[number]->name;
    return number - scene_count < model_count ? models[number - scene_count]->name : NULL;
}

const char *emit_subject_description(size_t number) {
    if (number < scene_count) return scenes[number]->description;
    return number - scene_count < model_count ? models[number - scene_count]->description : NULL;
}

/* ---- Colours ------------------------------------------------------------------------------- */

/* Pictures colour a material by its number: fract((number + 1) * turns) in each channel, from 0.25
 * to 0.85. So a material gets a number whose colour is like it. */
static int32_t number_like(const float wanted[3]) {
    static const double turns[3] = {0.618034, 0.754878, 0.569840};
    double least = 3.0;
    int32_t best = 0;
    for (int32_t number = 0; number < 4096; ++number) {
        double apart = 0.0;
        for (int c = 0; c < 3; ++c) {
            const double turned = (number + 1) * turns[c];
            const double difference = 0.25 + 0.6 * (turned - floor(turned)) - (double)wanted[c];
            apart += difference * difference;
        }
        if (apart < least) {
            least = apart;
            best = number;
        }
    }
    return best;
}

static void colour(emit_subject *subject) {
    static const float colours[model_materials][3] = {
        {0.40f, 0.32f, 0.26f}, /* bark */ {0.34f, 0.50f, 0.25f},   /* leaf */
        {0.42f, 0.52f, 0.28f}, /* grass */ {0.80f, 0.70f, 0.52f},  /* sand */
        {0.50f, 0.48f, 0.46f}, /* rock */ {0.82f, 0.42f, 0.38f},   /* coral */
        {0.80f, 0.64f, 0.30f}, /* sponge */ {0.84f, 0.52f, 0.28f}, /* fish */
    };
    for (size_t i = 0; i < subject->world->count; ++i) {
        const model_component *const component = &subject->world->components[i];
        const int leafy = component->leaf_kernels > 0;
        subject->materials[i] =
            number_like(colours[leafy ? component->leaf_material : component->material]);
    }
    subject->world->scene.materials = subject->materials;
}

/* ---- Scenes and models --------------------------------------------------------------------- */

int emit_subject_open(emit_subject *subject, const char *name) {
    const scene *const shown = scene_named(name);
    const model *const grown = shown == NULL ? model_named(name) : NULL;
    memset(subject, 0, sizeof *subject);
    if (shown != NULL) {
        subject->name = shown->name;
        subject->description = shown->description;
        memcpy(subject->eye, shown->eye, sizeof subject->eye);
        memcpy(subject->target, shown->target, sizeof subject->target);
        subject->field_of_view = shown->field_of_view;
        subject->t_max = shown->t_max;
        subject->shown = shown;
        subject->field = scene_field(shown, 0);
        return 1;
    }
    if (grown == NULL) return 0;
    subject->world = malloc(sizeof *subject->world);
    if (subject->world == NULL || !grown->build(subject->world, 0)) {
        free(subject->world);
        return 0;
    }
    subject->name = grown->name;
    subject->description = grown->description;
    memcpy(subject->eye, grown->eye, sizeof subject->eye);
    memcpy(subject->target, grown->target, sizeof subject->target);
    subject->field_of_view = grown->field_of_view;
    subject->t_max = grown->t_max;
    colour(subject);
    return 1;
}

void emit_subject_close(emit_subject *subject) {
    free(subject->world);
    subject->world = NULL;
}

double emit_subject_tangent(const emit_subject *subject) {
    return tan(subject->field_of_view * (3.14159265358979323846 / 360.0));
}

spt_camera emit_subject_camera(const emit_subject *subject, uint32_t width, uint32_t height) {
    static const float up[3] = {0.0f, 1.0f, 0.0f};
    spt_camera camera;
    float eye[3], target[3];
    memset(&camera, 0, sizeof camera);
    for (int axis = 0; axis < 3; ++axis) {
        eye[axis] = (float)subject->eye[axis];
        target[axis] = (float)subject->target[axis];
    }
    /* Eyes and targets of the list differ, and none looks straight up or down. */
    (void)spt_camera_pinhole(&camera, eye, target, up, (float)emit_subject_tangent(subject), width,
                             height);
    camera.t_max = (float)subject->t_max;
    return camera;
}
