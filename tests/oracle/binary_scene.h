/* SPDX-License-Identifier: MIT
 *
 * Scenes of balls, half spaces and boxes in double, the probes that they answer, and where rays
 * meet them: the oracle of the tests of binary tracing. Algorithm 2 as printed is here, too. */
#ifndef TESTS_ORACLE_BINARY_SCENE_H
#define TESTS_ORACLE_BINARY_SCENE_H

#include <spheretrace/mobius.h>

typedef enum binary_kind { BINARY_BALL, BINARY_HALF_SPACE, BINARY_BOX } binary_kind;

typedef struct binary_body {
    binary_kind kind;
    double center[3]; /* of a half space the unit normal */
    double size[3];   /* ball: radius; half space: offset; box: half sides */
} binary_body;

enum { binary_bodies = 6 };
typedef struct binary_scene {
    int count;
    binary_body body[binary_bodies];
    int only_says;           /* probes are answered by 0 or -1, without a distance */
    uint64_t asked, refused; /* first probes of batches: all there are of a call with one ray */
} binary_scene;

/* 1 to 6 bodies within about 10 scale of the origin. */
void binary_draw(binary_scene *scene, double scale);

/* A ray from about there to about there, or to the middle of a body; its direction of the given
 * length. */
spt_ray binary_ray(const binary_scene *scene, double scale, double length);

/* Signed, exact. */
double binary_body_distance(const binary_body *body, const double p[3]);
double binary_distance(const binary_scene *scene, const double p[3], int *which);

/* Where the ray, t in double, is inside the body shrunk by `shrink` (world length, >= 0), first and
 * last: from > to where nowhere. */
void binary_inside(const binary_body *body, const spt_ray *ray, double shrink, double *from,
                   double *to);

/* The first t in [t_min, t_max] inside any shrunk body, +infinity where there is none. */
double binary_first(const binary_scene *scene, const spt_ray *ray, double shrink, int *which);

/* The cosine of the ray with the body's outward normal at t, turned to the ray. */
double binary_cosine(const binary_body *body, const spt_ray *ray, double t);

double binary_length(const spt_ray *ray);
void binary_at(const spt_ray *ray, double t, double p[3]);

/* The scene as probes, by batches or point by point. */
spt_probe binary_probe(binary_scene *scene, int point);

/* Algorithm 2 as printed (the probe grows before the ray advances), or with that mended, on a field
 * along the ray: gap(t) is the distance at t. Ends also at t_max and after `most` probes. */
typedef struct binary_end {
    double t;
    int probes;
} binary_end;
binary_end binary_printed(double (*gap)(double t), int mended, double first, double stop,
                          double t_max, int most);

#endif
