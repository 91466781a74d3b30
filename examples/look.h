/* SPDX-License-Identifier: MIT
 *
 * How the scenes look in pictures: colours, gloss, the ground. A scene itself has no material. */
#ifndef EXAMPLES_LOOK_H
#define EXAMPLES_LOOK_H

/* The colour at p is base + swing * cos(turns . p + phase): a smooth function of position. A rule
 * with thresholds would draw stripes, since a hit lies up to one tolerance off the surface. */
typedef struct look {
    const char *scene;
    float base[3], swing[3]; /* linear albedo */
    float turns[3];          /* radians of hue per world unit, along each axis */
    float gloss;             /* 0 matt to 1 polished */
    float eye[3], target[3]; /* a view that shows all of it in a wide picture ... */
    float field_of_view;     /* ... horizontal, degrees; 0: the scene's own view will do */
    int has_ground;          /* the field holds a ground plane of its own ... */
    float ground;            /* ... at this height; else the pictures put one under the object */
} look;

/* The look of a scene by its name; a neutral one for a name that is not listed. */
const look *look_of(const char *scene);

/* The albedo of the object at a point. */
void look_albedo(const look *chosen, const float point[3], float albedo[3]);

/* The albedo of the ground at a point: squares of the given side, averaged over a footprint (both
 * world lengths), so that they fade towards the horizon instead of flickering. */
void look_ground_albedo(float x, float z, float side, float footprint, float albedo[3]);

/* The light of the sky (linear) in a unit direction. */
void look_sky(const float direction[3], float light[3]);

#endif
