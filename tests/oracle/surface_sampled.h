/* SPDX-License-Identifier: MIT
 *
 * Points of surfaces, the normals that are found there, and how far these are from the true ones. */
#ifndef TESTS_ORACLE_SURFACE_SAMPLED_H
#define TESTS_ORACLE_SURFACE_SAMPLED_H

#include "surface_oracle.h"

#include <spheretrace/surface.h>

enum { sampled_points = 500 };

/* Points, the normals found there and how far they are from the true ones. */
typedef struct surface_sampled {
    size_t count;
    float point[sampled_points][3], normal[sampled_points][3];
    double angle[sampled_points];
} surface_sampled;

/* Rays that begin at the points, and a view of t alone, one a ray. */
spt_rays sampled_rays(const surface_sampled *at);
spt_hits sampled_t(const float *t, size_t count);

/* spt_normals() at the points. */
spt_status sampled_normals(const spt_field *field, const spt_settings *settings,
                           spt_normal_rule rule, float detail, surface_sampled *at);

/* The same for a body, in the run's way; sorts the angles to the true normals, in radians. */
void sampled_measure(const surface_run *run, const surface_body *body, const spt_settings *given,
                     spt_normal_rule rule, float detail, surface_sampled *at);

/* A random point of the surface, not nearer than `margin` to where it is not smooth: the edges of a
 * box, and where a capsule's caps begin. And count of them, rounded to floats. */
void sampled_point(const surface_body *body, double margin, double p[3]);
void sampled_draw(const surface_body *body, double margin, size_t count, surface_sampled *at);

#endif
