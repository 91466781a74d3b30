/* SPDX-License-Identifier: MIT
 *
 * Paths of light through a body as a renderer makes them with the library, many at a time: trace,
 * normals, bend, offset, trace on. Left out: what is right, which is in glass_path.h. */
#ifndef TESTS_ORACLE_GLASS_RUN_H
#define TESTS_ORACLE_GLASS_RUN_H

#include "glass_path.h"

#include <spheretrace/surface.h>

enum { glass_rays = 256 };

/* Where a secondary ray begins: the library's way, or that of the paper. */
typedef enum glass_start {
    GLASS_OFFSET, /* spt_offset() */
    GLASS_PRINTED /* along the normal by 2 max(epsilon_min, |f|): Keinert et al. 2014, 3.3 */
} glass_start;

typedef struct glass_run {
    glass_body *body;
    double index;
    spt_settings settings; /* SPT_SKIP_START is for secondary rays only */
    glass_start start;
    float epsilon_min; /* of the paper's way */
    uint32_t checks;   /* of spt_offset() */
    int march;         /* rays in the body are marched forward by spt_trace() */
    int declared;      /* the field says that it is convex */
    int gradient;      /* it has a gradient; else central differences */
} glass_run;

typedef struct glass_record {
    int count; /* of events; a path without an exit or a mirror is cut at glass_events */
    glass_event_kind kind[glass_events];
    int face[glass_events];
    double point[glass_events][3], direction[glass_events][3], length[glass_events];
    int32_t start[glass_events]; /* spt_start */
    int lost;                    /* a ray inside came to no hit, or its flags were wrong */
    int doubtful;  /* a start was not clear, or a ray was stopped that left the face it was near */
    int returned;  /* the ray that had left the body hit it again */
    int secondary; /* rays traced after the first */
} glass_record;

/* Follows count rays, at most glass_rays, unit directions. */
void glass_trace(const glass_run *run, int count, const spt_ray *rays, glass_record *records);

/* What the run does, for the bound of its errors. */
glass_tracer glass_tracer_of(const glass_run *run);

/* The true path of a ray, with that bound; 0 where it does not meet the body. */
int glass_follow_ray(const glass_run *run, const spt_ray *ray, glass_path *path);

/* A random ray from three radii away towards somewhere in the body. */
spt_ray glass_ray_towards(const glass_body *body);

/* The distance of two points. */
double glass_apart(const double a[3], const double b[3]);

#endif
