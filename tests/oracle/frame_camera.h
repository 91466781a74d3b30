/* SPDX-License-Identifier: MIT
 *
 * The cameras of frame.h in double, with a bound on what float rounding may do to each number, and
 * random cameras of every sort. Left out: cameras of the caller's rays, which are the caller's. */
#ifndef TESTS_ORACLE_FRAME_CAMERA_H
#define TESTS_ORACLE_FRAME_CAMERA_H

#include <spheretrace/frame.h>

/* The ray of a point, and how far each number of it may be off in float. */
typedef struct camera_ray {
    double origin[3], direction[3]; /* the direction of length 1 */
    double origin_error[3], direction_error;
} camera_ray;

/* The ray of the point (x, y) of an image of width x height pixels, pinhole or orthographic. */
camera_ray camera_ray_at(const spt_camera *camera, uint32_t width, uint32_t height, double x,
                         double y);

/* What makes a random camera differ from the usual one. */
enum {
    CAMERA_OFF_AXIS = 1u << 0, /* the window is not centred */
    CAMERA_OBLONG = 1u << 1,   /* pixels are not square */
    CAMERA_MIRROR_X = 1u << 2, /* low > high */
    CAMERA_MIRROR_Y = 1u << 3, /* likewise */
    CAMERA_SKEWED = 1u << 4,   /* axes neither of length 1 nor at right angles */
    CAMERA_VARIANTS = 1u << 5  /* one more than all of them */
};

/* A camera near `eye` that looks at `target`, both moved at random by up to `spread`. tangent: half
 * the width of its window, in the plane at distance 1 (pinhole) or in world units. */
spt_camera camera_draw(spt_camera_kind kind, uint32_t variant, const double eye[3],
                       const double target[3], double spread, double tangent, double aspect);

double camera_dot(const double a[3], const double b[3]);
void camera_cross(const double a[3], const double b[3], double product[3]);
void camera_unit(double v[3]);

#endif
