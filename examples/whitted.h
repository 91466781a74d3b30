/* SPDX-License-Identifier: MIT
 *
 * A Whitted renderer (Whitted 1980) for worlds of glass, in queues of rays: all rays of a
 * generation are traced, refined and offset by one call each. What Keinert et al. 2014, section 4
 * measure: two reflections, eight refractions, with and without the optimisation for convex bodies.
 * Left out: files. */
#ifndef EXAMPLES_WHITTED_H
#define EXAMPLES_WHITTED_H

#include "glass_world.h"

/* What a ray is for. */
typedef enum whitted_kind {
    WHITTED_PRIMARY,
    WHITTED_OUTSIDE, /* reflected by something, or come out of glass */
    WHITTED_INSIDE,  /* in the body, to the way out */
    WHITTED_SHADOW,
    WHITTED_SHADOW_INSIDE, /* the part of a shadow ray in the body */
    whitted_kinds
} whitted_kind;

typedef struct whitted_settings {
    const spt_method *method; /* of all tracing but the backward marches */
    int convex;               /* rays inside by spt_trace_convex(), else by spt_trace() */
    uint32_t refinements;     /* rounds of spt_refine(), 0 to 16 */
    int reflections;          /* a path may take: outer ones, and partial ones inside */
    int refractions;          /* into and out of glass, and total reflections, which cost as much */
    float least_weight;       /* what counts for less is not followed; 0: all is */
    float epsilon;            /* as spt_settings.epsilon */
    int pixel_cone;           /* rays end at half a pixel */
    uint32_t budget, max_lanes;
    int threads;
    float *inside_evaluations; /* receives, for each pixel, those of its rays of WHITTED_INSIDE;
                                * or NULL */
} whitted_settings;

/* The default rule, convex, 3 refinements, 2 reflections, 8 refractions, weight 1/256, epsilon and
 * budget of the library, cones, one thread. */
whitted_settings whitted_settings_default(void);

typedef struct whitted_statistics {
    spt_statistics of[whitted_kinds]; /* the tracing */
    uint64_t calls;                   /* of the library, with rays */
    uint64_t secondary;               /* origins that were asked of spt_offset() */
    uint64_t near, at_hit;            /* those that were no SPT_START_CLEAR */
    uint64_t self_hits; /* outside rays that left the body and met it again: convex bodies are
                          * never met again */
    uint64_t slivers;   /* rays that found no way out, since the body is thinner there than the
                          * tolerance, and went straight on */
    uint64_t undecided; /* rays out of budget */
    double cpu_seconds; /* of the process */
} whitted_statistics;

/* Renders a picture: pixels receives width * height * 3 numbers of linear light, row by row from
 * the top. The bits are the same for any number of threads. Returns 0, with nothing of use written,
 * where memory ran out or the library refused. statistics are overwritten. */
int whitted_render(glass_world *world, const whitted_settings *settings, int width, int height,
                   float *pixels, whitted_statistics *statistics);

/* Light from 0 up as a picture can show it, 0 to 1 (the fit of Narkowicz 2015). */
void whitted_develop(float *pixels, size_t count);

/* The light at one point of the image plane (x, y as for spt_camera_rays()) in double precision,
 * by recursion, with balls and ground in closed form and the convex body by bisection of its
 * reference: what the renderer comes to as tolerance and least weight go to 0. */
void whitted_exact(const glass_world *world, const whitted_settings *settings, int width,
                   int height, double x, double y, double light[3]);

#endif
