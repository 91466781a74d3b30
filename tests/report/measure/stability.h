/* SPDX-License-Identifier: MIT
 *
 * Stiff and extreme families of fields, each with a parameter that is swept until something gives,
 * and the truth in double beside them. Left out: who judges (stability_judge.h), and what is counted
 * by itself, planes far away and powers of two (stability_planes.c, stability_powers.c). */
#ifndef TESTS_REPORT_STABILITY_H
#define TESTS_REPORT_STABILITY_H

#include "../report.h"

enum { stability_most_values = 12, stability_numbers = 24 };

/* What is traced at one value of a family's parameter. Fields look at it: not to be copied. */
typedef struct stability_world stability_world;

/* The field in double, or the function that it stands for: negative inside. */
typedef double stability_value_fn(const stability_world *world, const double p[3]);

struct stability_world {
    spt_field field;
    spt_settings settings;            /* method is filled in by who traces */
    int bound;                        /* as the family's */
    double number[stability_numbers]; /* the family's own, numbers of float all */
    void *memory;                     /* the family's own, freed after use, or NULL */
    stability_value_fn *value;
    double slope; /* the Lipschitz constant of value */
    /* What float costs in the place where |f| is read: so many u = 2^-24 of the coordinates that
     * take part, which are the ray's, and up to `reach` in the callback. A position is off by 2.5u
     * of them (trace.h), a callback of a few operations by as much again: 8 where nothing else is
     * said, as for all exact shapes of the library's own tests. */
    double units, reach;
    stability_value_fn *more; /* what it costs besides at a place, world length; or NULL */
};

/* What a ray must do, t of the ray each, +infinity where it does not.
 *   first  where it first meets the body
 *   clear  where it first meets it so that no rounding lets it pass by
 *   last   the last place where a hit may be that overlooks nothing; 0: to be found from `clear` */
typedef struct stability_truth {
    double first, clear, last;
    int unknown; /* the truth could not be found: the ray counts as undecidable */
} stability_truth;

typedef struct stability_family {
    const char *name, *parameter;
    int bound;  /* whether |f| <= lipschitz times the distance, as far as floats allow */
    int convex; /* whether f is a convex function, so that spt_convex() has its licence */
    int count;
    double values[stability_most_values]; /* of the parameter, from harmless to extreme */
    void (*build)(stability_world *world, double value);
    void (*ray)(const stability_world *world, report_random *random, spt_ray *ray);
    void (*truth)(const stability_world *world, const spt_ray *ray, stability_truth *truth);
} stability_family;

/* THE LIST is stability_list.h. */
#define FAMILY(name) extern const stability_family stability_##name;
#include "stability_list.h"
#undef FAMILY

/* ---- What families share (stability_truth.c) ------------------------------------------------ */

/* A batch callback that computes world->value in double at the float position and rounds it once;
 * user: the world. */
spt_distance_batch_fn stability_in_double;

/* A world with defaults: the field is value in double, of Lipschitz constant 1. */
void stability_begin(stability_world *world, stability_value_fn *value);

/* A number as float, kept in double: what the callback and the truth both see. */
double stability_rounded(double number);

/* The unit ray from one point through another, rounded to float; t_min 0. */
void stability_aim(spt_ray *ray, const double from[3], const double through[3], double t_max);

void stability_point(const spt_ray *ray, double t, double p[3]);
double stability_dot(const double a[3], const double b[3]);
double stability_length(const double vector[3]);

/* What float costs at t, world length. */
double stability_rounding(const stability_world *world, const spt_ray *ray, double t);

/* Whether |value| at t is no more than the tolerance and rounding explain. */
int stability_near(const stability_world *world, const spt_ray *ray, double t);

/* The truth by sphere tracing world->value in double, from t_low to t_high and through what it only
 * grazes: steps of |value| / slope lead over nothing; those next to the surface are a quarter of
 * what float costs. */
void stability_walk(const stability_world *world, const spt_ray *ray, double t_low, double t_high,
                    stability_truth *truth);

/* The same over the whole ray: what most families have for `truth`. */
void stability_walk_ray(const stability_world *world, const spt_ray *ray, stability_truth *truth);

/* Where a ray is within a ball of radius > 0; returns 0 where nowhere at t >= 0. */
int stability_ball_interval(const spt_ray *ray, const double center[3], double radius, double *in,
                            double *out);

/* No crossing yet; and a crossing more, at t, clear of grazing or not. */
void stability_nothing(stability_truth *truth);
void stability_crossing(stability_truth *truth, double t, int clear);

/* Finds `last` where it is to be found: where the ray is no longer near the surface that it met at
 * `clear`, on whichever side. */
void stability_find_last(const stability_world *world, const spt_ray *ray, stability_truth *truth);

#endif
