/* SPDX-License-Identifier: MIT
 *
 * Balls and half spaces seen through a map, with all that is known of them exactly: distances,
 * normals, where rays meet them. The library's field of them, and what float costs it. */
#ifndef TESTS_ORACLE_MOBIUS_WORLD_H
#define TESTS_ORACLE_MOBIUS_WORLD_H

#include "mobius_region.h"

#include <spheretrace/trace.h>

enum { mapped_most = 3, mapped_rays = 24 };

/* Not to be copied: the fields look at it. */
typedef struct mapped_world {
    chain steps;
    spt_mobius map;
    double extent, size; /* of the kernels, and about that of their images */
    int count;
    solid kernel[mapped_most], image[mapped_most];
    place pole; /* L(infinity) */
    spt_field inner, field;
    spt_conformal memory;
} mapped_world;

/* Kernels, numbers of float all: one ball; up to three; a half space, some with a ball. */
void mapped_draw(mapped_world *world, int n);
/* Builds the library's field of what steps, count and kernel say. */
void mapped_build(mapped_world *world);

/* A point whose preimage is about `reach` extents from the kernels, as floats. */
void mapped_point(const mapped_world *world, double reach, float p[3]);
place mapped_place(const float p[3]);

/* The distance from the union of the images; inside a single one negative. */
extended mapped_distance(const mapped_world *world, const place *p);
extended mapped_pole_distance(const mapped_world *world, const place *p);

/* What the library's callbacks say at a point. */
float mapped_value(const mapped_world *world, const float p[3]);
void mapped_gradient(const mapped_world *world, const float p[3], float gradient[3]);

/* WHAT FLOAT COSTS, u = 2^-24. The map's entries and the sums and products of L^-1 and |u| are off
 * by at most 32u of the moduli of the entries, as in mobius_chain.h for one step. So the preimage q
 * is off by 32u sqrt(scale) (|d| |x| + |b| + |q| (|c| |x| + |a|)), and with it the kernel's
 * distance, which the callback here rounds once; U = 1 / scale times that is length in the world,
 * and U itself is off by 2 (|a| + |x| |c|) / |u| of itself. Returns the sum, or +infinity where u
 * is not known to a hundredth: next to the pole. */
extended mapped_rounding(const mapped_world *world, const place *x);
/* Of a direction at a point of the boundary, in radians. */
extended mapped_turn(const mapped_world *world, const place *x);

/* What a ray must do.
 *   meets   whether it crosses an image before t_max, and
 *   t       where first, the cosine with the normal there
 *   clear   it neither grazes an image nor passes the pole closer than `gap`, world length, and a
 *           hollow image is bent less than by a tenth over ten gaps: radius cosine^2 > 10 gap */
typedef struct mapped_hit {
    int meets, clear;
    extended t, cosine;
} mapped_hit;
mapped_hit mapped_trace(const mapped_world *world, const spt_ray *ray, double gap);

/* A ray from a point outside to about a point of an image. */
int mapped_ray(const mapped_world *world, spt_ray *ray);

/* The farthest t may be from the truth at a clear hit: the field is at least (1 - k) / (1 + k) of
 * the distance, k = f / (d - f), d the distance from the pole, and below the tolerance or by its
 * rounding above; over the cosine, and a tenth more for hollow images. */
extended mapped_slack(const mapped_world *world, const spt_settings *settings, const spt_ray *ray,
                      const mapped_hit *truth);

#endif
