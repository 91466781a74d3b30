/* SPDX-License-Identifier: MIT
 *
 * The idea introduced here: a whole frame. Two fields make a scene, a camera looks at it, and the
 * library traces the picture tile by tile; what each pixel shows comes back as an array. */
#include <spheretrace/spheretrace.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static float ball(void *user, float x, float y, float z) {
    (void)user;
    return sqrtf(x * x + y * y + z * z) - 1.0f;
}

static float floor_below(void *user, float x, float y, float z) {
    (void)user, (void)x, (void)z;
    return y + 1.0f;
}

enum { width = 64, height = 24 };

/* README: begin */
/* The component that each pixel shows, -1 for the sky. Returns 0 where something is refused. */
static int trace_picture(int32_t *shown) {
    const spt_bound around_the_ball = spt_bound_sphere(0.0f, 0.0f, 0.0f, 1.0f);
    const float eye[3] = {0.0f, 1.0f, 4.0f}, target[3] = {0.0f, 0.0f, 0.0f}, up[3] = {0, 1, 0};
    spt_field fields[2] = {spt_field_default(), spt_field_default()};
    spt_scene scene = spt_scene_default();
    spt_camera camera;
    spt_frame frame;
    spt_hits image = {0}; /* of all that a hit tells only what is asked for */
    fields[0].point = ball;
    fields[0].bound = &around_the_ball; /* rays and tiles that miss it do not ask the ball */
    fields[1].point = floor_below;
    fields[0].flags = fields[1].flags = SPT_FIELD_CONVEX;
    scene.fields = fields;
    scene.count = 2;
    image.component.first = shown;
    image.component.stride = sizeof *shown;
    /* A character is twice as high as wide. */
    if (spt_camera_pinhole(&camera, eye, target, up, 0.8f, width, 2 * height) != SPT_OK) return 0;
    camera.t_max = 40.0f;
    if (spt_frame_init(&frame, &scene, &camera, width, height) != SPT_OK) return 0;
    frame.workspace_size = spt_frame_workspace(&frame); /* a thread needs one of its own */
    frame.workspace = malloc(frame.workspace_size);
    if (frame.workspace == NULL) return 0;
    const spt_status status = spt_frame_trace(&frame, 0, spt_frame_tiles(&frame), &image, NULL);
    free(frame.workspace);
    return status == SPT_OK;
}
/* README: end */

int main(void) {
    static int32_t shown[width * height];
    int seen[3] = {0, 0, 0};
    if (!trace_picture(shown)) return 1;
    for (int row = 0; row < height; ++row) {
        for (int column = 0; column < width; ++column) {
            const int32_t component = shown[row * width + column];
            ++seen[component + 1];
            putchar(" O."[component + 1]);
        }
        putchar('\n');
    }
    /* The ball in the middle, the floor below it, the sky in the corners above. */
    const int32_t middle = shown[height / 2 * width + width / 2];
    const int32_t below = shown[(height - 1) * width + width / 2];
    return middle == 0 && below == 1 && shown[0] == -1 && seen[0] > 0 ? 0 : 1;
}
