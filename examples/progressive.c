/* SPDX-License-Identifier: MIT
 *
 * The idea introduced here: a frame that gets better. It is traced in passes of rising resolution,
 * a few evaluations a call, and can be looked at between any two; at the end it is, bit for bit,
 * the frame that one long call gives. */
#include "heat.h"
#include "shade.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { width = 480, height = 270, count = width * height, stages = 4, a_call = 5000 };

typedef struct painter {
    shading shader;
    shade_scratch scratch;
} painter;

/* The colours of some pixels of a pass, as spt_frame_advance() asks for them. */
static void paint(void *user, size_t pixels, const float *x, const float *y, const spt_ray *rays,
                  const spt_hit *hits, float *colours) {
    static const int middle_of_the_sun[SPT_BATCH];
    painter *with = user;
    (void)x, (void)y;
    shade_rays(&with->shader, &with->scratch, pixels, rays, hits, middle_of_the_sun,
               (float(*)[3])colours);
}

/* Puts the best picture so far into its place, two stages in a row. */
static int show(const spt_frame *frame, const void *state, size_t state_size, int stage,
                const spt_frame_progress *at, image *sheet) {
    static const float white[3] = {1.0f, 1.0f, 1.0f};
    static float picture[3 * count];
    const spt_sink pixels = {picture, 3 * sizeof *picture};
    const int left = stage % 2 * width, top = stage / 2 * height;
    char text[64];
    if (spt_frame_picture(frame, state, state_size, &pixels) != SPT_OK) return 0;
    for (int y = 0; y < height; ++y) {
        memcpy(image_at(sheet, left, top + y), picture + 3 * y * width,
               3 * width * sizeof *picture);
    }
    snprintf(text, sizeof text, "%.2f evaluations a pixel", (double)at->evaluations / count);
    heat_text(sheet, left + 8, top + height - 14, text, white);
    printf("%6.2f evaluations a pixel: pass %u, %.0f %% of it\n", (double)at->evaluations / count,
           (unsigned)at->pass + 1, 100.0 * (double)at->pixels / (double)at->pixel_count);
    return 1;
}

/* Goes on in short calls, and shows each pass but the last when it is finished, and the whole. */
static int advance_in_steps(const spt_frame *frame, void *state, size_t state_size,
                            const spt_hits *hits, image *sheet) {
    spt_frame_progress at = {0, 0, 0, 0, 0};
    size_t calls = 0, shown = 0;
    if (spt_frame_restart(frame, state, state_size) != SPT_OK) return 0;
    while (shown < stages) {
        if (spt_frame_advance(frame, state, state_size, a_call, hits, &at) != SPT_OK) return 0;
        ++calls;
        for (; shown < at.pass; ++shown) {
            if (!show(frame, state, state_size, (int)shown, &at, sheet)) return 0;
        }
    }
    printf("%zu calls\n", calls);
    return 1;
}

/* The same without a break. */
static int advance_at_once(const spt_frame *frame, void *state, size_t state_size,
                           const spt_hits *hits, float *picture) {
    const spt_sink pixels = {picture, 3 * sizeof *picture};
    return spt_frame_restart(frame, state, state_size) == SPT_OK &&
           spt_frame_advance(frame, state, state_size, UINT64_MAX, hits, NULL) == SPT_OK &&
           spt_frame_picture(frame, state, state_size, &pixels) == SPT_OK;
}

static spt_hit hits[count], hits_at_once[count];
static float picture[3 * count], picture_at_once[3 * count];

int main(int argument_count, char **arguments) {
    const scene *shown = scene_named(argument_count > 1 ? arguments[1] : "primitives");
    if (shown == NULL || argument_count > 3) {
        fprintf(stderr, "usage: progressive [SCENE [FILE]]\n");
        return 2;
    }
    static scene_parts parts;
    static painter with;
    scene_parts_of(shown, SCENE_OBJECTS, spt_lanes(), &parts);
    const spt_camera camera = scene_camera(shown, width, height);
    spt_frame frame;
    if (spt_frame_init(&frame, &parts.scene, &camera, width, height) != SPT_OK ||
        !shading_create(&with.shader, shown, SCENE_OBJECTS, frame.settings.epsilon,
                        frame.settings.pixel_radius, 1, 0) ||
        !shade_scratch_create(&with.scratch, &with.shader)) {
        return 1;
    }
    frame.passes = spt_passes(stages); /* a quarter, a half, three quarters, all */
    frame.pass_count = stages;
    frame.shade = paint;
    frame.shade_user = &with;
    frame.channels = 3;
    frame.workspace_size = spt_frame_workspace(&frame);
    frame.workspace = malloc(frame.workspace_size);
    const size_t state_size = spt_frame_state_size(&frame);
    void *state = malloc(state_size);
    image sheet = image_create(2 * width, 2 * height, 3);
    const spt_hits stepped = spt_hits_of(hits), at_once = spt_hits_of(hits_at_once);
    const spt_sink pixels = {picture, 3 * sizeof *picture};
    int status = 1;
    if (frame.workspace != NULL && state != NULL && sheet.pixels != NULL &&
        advance_in_steps(&frame, state, state_size, &stepped, &sheet) &&
        spt_frame_picture(&frame, state, state_size, &pixels) == SPT_OK &&
        advance_at_once(&frame, state, state_size, &at_once, picture_at_once)) {
        const int same = memcmp(hits, hits_at_once, sizeof hits) == 0 &&
                         memcmp(picture, picture_at_once, sizeof picture) == 0;
        printf("%s as without a break\n", same ? "the same bits" : "NOT the same bits");
        status = !same;
    }
    if (status == 0 && argument_count > 2 && image_write(arguments[2], &sheet) != 0) status = 2;
    free(frame.workspace);
    free(state);
    shade_scratch_free(&with.scratch);
    image_free(&sheet);
    return status;
}
