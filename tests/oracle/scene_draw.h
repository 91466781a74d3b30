/* SPDX-License-Identifier: MIT
 *
 * Random scenes of simple bodies, their fields computed in double and rounded, with and without
 * bounds, licences and faults, and random rays through them. */
#ifndef TESTS_ORACLE_SCENE_DRAW_H
#define TESTS_ORACLE_SCENE_DRAW_H

#include "scene_run.h"

typedef enum drawn_kind {
    BODY_SPHERE,
    BODY_BOX,
    BODY_TORUS, /* around y */
    BODY_PLANE, /* y = center, inside below */
    BODY_SHEET, /* a rectangle across z, without an inside */
    drawn_kinds
} drawn_kind;

typedef struct drawn_body {
    drawn_kind kind;
    float center[3];
    float half[3];      /* box and sheet; sheet: half[2] 0 */
    float radius, tube; /* sphere; torus: of the ring and of the tube */
} drawn_body;

/* What a component does beyond x = wall. */
typedef enum drawn_fault {
    FAULT_NONE,
    FAULT_NAN,
    FAULT_MINUS_INFINITE,
    FAULT_INFINITE, /* legal: nothing is there */
    FAULT_STEEP,    /* everywhere: its values are 1.7 times what it declares */
    drawn_faults
} drawn_fault;

enum { drawn_components = 40, drawn_bodies = 4, drawn_zones = 8 };

/* A union of bodies, its values times factor. */
typedef struct drawn_component {
    drawn_body bodies[drawn_bodies];
    int count;
    int hidden[drawn_bodies]; /* a body that scene_component_visible() leaves out */
    drawn_fault fault;
    float wall, factor;
} drawn_component;

/* Not to be copied: the scene looks at what is beside it. */
typedef struct drawn_scene {
    spt_scene scene;
    drawn_component components[drawn_components];
    spt_field fields[drawn_components];
    spt_bound bounds[drawn_components];
    spt_zone zones[drawn_zones];
} drawn_scene;

enum {
    DRAW_FAULTS = 1u << 0, /* some components have faults */
    DRAW_UNITED = 1u << 1, /* components of several bodies */
    DRAW_BALLS = 1u << 2,  /* spheres only */
    DRAW_SOLID = 1u << 3,  /* no sheets */
    DRAW_STEEP = 1u << 4,  /* half of the components are steeper than they declare */
};

/* count components (1 .. drawn_components) of bodies about (0, 0, 8), at most 4 away on each axis,
 * each with a random bound or none, a random Lipschitz constant, and the batch callback or that for
 * one point. */
void scene_draw(drawn_scene *out, size_t count, uint32_t selection);

/* Gives the scene 1 to drawn_zones zones anywhere among the bodies, that cut what they meet. */
void scene_draw_zones(drawn_scene *out);

/* Copies a scene with all lengths times 2^power. */
void scene_scaled(const drawn_scene *from, int power, drawn_scene *out);

/* f in double at n points, and the same without hidden bodies. user is the component. */
void scene_component_value(const drawn_component *self, size_t n, const double *x, const double *y,
                           const double *z, double *distance);
void scene_component_visible(const drawn_component *self, size_t n, const double *x,
                             const double *y, const double *z, double *distance);

/* A ball around a body; of a plane its radius is infinite. */
void scene_body_ball(const drawn_body *self, double center[3], double *radius);

/* A ray through the scenes, beginning anywhere among or before their bodies: unit directions, all
 * columns at their defaults; and one with a direction of any length, with t_min, t_max and path. */
scene_ray scene_draw_plain_ray(void);
scene_ray scene_draw_ray(void);

/* Settings with the budget out of reach for nearly all rays, and other numbers at their defaults or
 * anywhere. */
spt_settings scene_draw_settings(void);

#endif
