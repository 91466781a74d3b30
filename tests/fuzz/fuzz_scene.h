/* SPDX-License-Identifier: MIT
 *
 * The harness for scenes and frames, which libFuzzer drives and the unit run as well. A component is
 * a field of fuzz.h, moved; rays and settings are those of fuzz.h. */
#ifndef TESTS_FUZZ_SCENE_H
#define TESTS_FUZZ_SCENE_H

#include <spheretrace/frame.h>

#include "fuzz.h"

enum { fuzz_most_parts = 12, fuzz_most_zones = 6, fuzz_most_passes = 4, fuzz_most_pixels = 480 };

typedef struct fuzz_part {
    fuzz_field distance; /* its points and faults are counted here */
    float offset[3];
    spt_bound bound;
} fuzz_part;

typedef struct fuzz_scene_case {
    fuzz_part parts[fuzz_most_parts];
    spt_field fields[fuzz_most_parts];
    spt_zone zones[fuzz_most_zones];
    spt_scene scene;
    fuzz_case rest; /* rays and settings; its field is not used */

    int has_frame; /* there is a camera that makes one */
    spt_camera camera;
    spt_frame frame; /* without workspace */
    spt_pass passes[fuzz_most_passes];
    float depths[fuzz_most_pixels]; /* for frame.t_max */
    uint32_t slice;                 /* evaluations a call */
} fuzz_scene_case;

/* Fills the case, whose address stays in it. */
void fuzz_scene_read(fuzz_scene_case *what, const uint8_t *data, size_t size);

float fuzz_part_value(const fuzz_part *part, float x, float y, float z);

/* Points that all callbacks saw, with padding; and the broken promises of field.h. */
uint64_t fuzz_scene_points(const fuzz_scene_case *what);
uint64_t fuzz_scene_faults(const fuzz_scene_case *what);
void fuzz_scene_clear(fuzz_scene_case *what);

/* Whether scene and settings keep the rules of scene.h. */
int fuzz_scene_is_legal(const fuzz_scene_case *what);

/* At least so many bytes for a workspace (0) or a state (1), filled with a value, and after them
 * some that fuzz_memory_kept() finds unwritten. */
void *fuzz_memory(int which, size_t size, int value);
int fuzz_memory_kept(int which, size_t size);

/* What scene.h says of the result of a ray (t_min, t_max and path as given). */
void fuzz_scene_check_hit(const fuzz_scene_case *what, const spt_settings *settings,
                          const fuzz_ray *ray, const spt_hit *hit);

/* What frame.h says of the frame of a case. */
void fuzz_scene_frame(fuzz_scene_case *what);

/* Reads any bytes as a scene, rays and a frame, traces them and checks all that. Returns 0. */
int fuzz_scene_input(const uint8_t *data, size_t size);

#endif
