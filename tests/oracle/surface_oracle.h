/* SPDX-License-Identifier: MIT
 *
 * What the oracle tests of surface.h share: simple shapes placed anywhere, with distances and
 * gradients in double, their fields as batch and as point callbacks, and crossings certified in
 * double. Left out: the queries themselves. */
#ifndef TESTS_ORACLE_SURFACE_ORACLE_H
#define TESTS_ORACLE_SURFACE_ORACLE_H

#include "analytic.h"
#include "harness.h"

/* ---- Runs ---------------------------------------------------------------------------------- */

/* Visits every width that runs here with both forms of callback, and with every step rule if asked
 * for; each run is named in the context of the checks:
 *     for (surface_run run = surface_runs(selection); surface_next(&run);) ... */
enum {
    SURFACE_ALL_RULES = 1u << 0, /* else the default rule alone */
    SURFACE_CONVEX = 1u << 1     /* the field is convex: spt_convex() as well */
};
typedef struct surface_run {
    unsigned selection;
    int state, point; /* point: the callback for one point instead of the batch */
    uint32_t lanes;
    const spt_method *method;
} surface_run;
surface_run surface_runs(unsigned selection);
int surface_next(surface_run *run);

/* The settings with the run's width and rule. */
spt_settings surface_settings(const surface_run *run, const spt_settings *given);

/* A field computed in double at the float position and rounded, in the run's form of callback. The
 * reference field must outlive it. */
spt_field surface_field(const surface_run *run, const reference_field *field, uint32_t flags);

/* ---- Bodies -------------------------------------------------------------------------------- */

typedef struct surface_body {
    analytic_shape shape;
    double center[3];
    double axis[3][3]; /* the shape's own axes: rows of unit length at right angles */
    double factor;     /* f = factor * distance; below 0 all but the shape is solid */
} surface_body;

/* Upright, with factor 1; and turned at random. */
surface_body surface_place_at(analytic_shape shape, double x, double y, double z);
surface_body surface_sphere(double x, double y, double z, double radius);
surface_body surface_plane(double height);
void surface_turn(surface_body *body);

/* The signed distance (f over |factor|) and its unit gradient. */
double surface_distance(const surface_body *body, const double p[3]);
void surface_gradient(const surface_body *body, const double p[3], double gradient[3]);

/* The body as a field of the reference; the body must outlive it. */
reference_field surface_body_field(const surface_body *body);

/* The least distance of some bodies, and which has it. */
typedef struct surface_group {
    const surface_body *bodies;
    size_t count;
} surface_group;
double surface_group_distance(const surface_group *group, const double p[3], size_t *which);
reference_field surface_group_field(const surface_group *group);

/* ---- Vectors ------------------------------------------------------------------------------- */

double surface_dot(const double a[3], const double b[3]);
double surface_length(const double a[3]);
void surface_unit(double a[3]);
/* In radians, between vectors of any length. */
double surface_angle(const double a[3], const double b[3]);
void surface_random_unit(double a[3]);

/* ---- Rays ---------------------------------------------------------------------------------- */

/* From origin towards target, the direction of the given length, t in [0, t_max]. */
spt_ray surface_aim(const double origin[3], const double target[3], double length, double t_max);
/* origin + t direction of the float ray, in double. */
void surface_point(const spt_ray *ray, double t, double p[3]);

/* The tolerance law of trace.h with a path behind the ray, world length. */
double surface_tolerance(const spt_settings *settings, const spt_ray *ray, double path, double t);

/* What rounding lets a value of f / lipschitz at t be off: each coordinate of origin + t direction
 * is rounded twice, the value once: 2^-24 (2 sqrt(3) + 1) of the largest number, taken as 2^-21. */
double surface_rounding(const spt_ray *ray, double t);

/* The crossings of a field with |f| <= lipschitz * distance on [t_min, t_max] of the ray (finite). An interval whose middle is farther from the surface than its half length holds
 * none, others are halved down to 1e-8 of the whole: nothing is passed over but what is thinner.
 *   t        receives the first `most` crossings, ascending
 *   extreme  most + 1 numbers, or NULL: the largest |f| / lipschitz from each crossing to the next,
 *            the first from t_min on, the last up to t_max: how clear it is that they are two
 * Returns how many there are. */
int surface_crossings(const reference_field *field, const spt_ray *ray, int most, double *t,
                      double *extreme);

/* The least value of a function along [low, high] on which it falls and then rises (as the distance
 * to a convex body along a line does), and where. */
typedef double surface_function(const void *user, double x);
double surface_least(surface_function *function, const void *user, double low, double high,
                     double *where);

#endif
