/* SPDX-License-Identifier: MIT
 *
 * What the oracle tests share: running the library with every rule at every width, fields computed
 * in double, and random worlds whose first hits are known. */
#ifndef TESTS_ORACLE_HARNESS_H
#define TESTS_ORACLE_HARNESS_H

#include "reference.h"
#include "tolerance.h"

/* Visits every step rule of the library at every width that runs here, and names both in the
 * context of the checks:
 *     oracle_run run = oracle_first_run;
 *     while (oracle_next(&run, convex)) ... run.method, run.rule, run.lanes ...
 * convex 0 leaves out the convex rule. rule is REFERENCE_RULES where the reference has none. */
typedef struct oracle_run {
    int state;
    uint32_t lanes;
    const spt_method *method;
    reference_rule rule;
} oracle_run;
static const oracle_run oracle_first_run = {0, 0, NULL, REFERENCE_BASIC};
int oracle_next(oracle_run *run, int convex);

/* The library's step rule that does the same as the reference's. */
const spt_method *oracle_method(reference_rule rule);

/* The settings with the run's rule and width. */
spt_settings oracle_settings(const oracle_run *run);

/* Calls spt_trace and checks that it says SPT_OK and ran the width that was asked for. */
void oracle_trace(const spt_field *field, const spt_settings *settings, size_t count,
                  const spt_ray *rays, spt_hit *hits);
spt_hit oracle_trace_one(const spt_field *field, const spt_settings *settings, const spt_ray *ray);

/* The library's view of a field of the reference: a batch callback that computes each value in
 * double at the float position and rounds it, so that the field's own error is half an ulp. The
 * field must outlive it. */
spt_field oracle_field(const reference_field *field, int convex);

/* Whether two hits are the same bits in every field. */
int oracle_same_hit(const spt_hit *a, const spt_hit *b);

/* ---- Worlds -------------------------------------- */

enum { world_spheres = 6 };

/* 1 to 6 spheres, half of the worlds with the floor y = -3, all lengths times scale. */
typedef struct world {
    int count, has_floor;
    double scale;
    double center[world_spheres][3], radius[world_spheres];
} world;

/* t: the first hit in [t_min, t_max], +infinity where there is none; gap: how far the ray's line is
 * from grazing anything, over scale: world length to a ball, for the floor the sine to it, and 0.4
 * times how far the first hit is from t_max. Where gap > 0.02 a hit is then decided: tolerances are
 * at most 5e-4 in these worlds and cosines at least 0.02, so that it is found within 0.025. */
typedef struct world_hit {
    double t, gap;
} world_hit;

world world_draw(void);
spt_ray world_ray(void);
reference_field world_field(const world *w);
world_hit world_trace(const world *w, const spt_ray *ray);

/* A world with rays, their truth, and settings, with the step rules'
 * parameters at their defaults or anywhere in their legal ranges. Not to be copied: field looks at
 * the world beside it. */
enum { drawn_rays = 24 };
typedef struct drawn {
    world scene;
    reference_field field;
    spt_settings settings;
    spt_ray rays[drawn_rays];
    world_hit truth[drawn_rays];
} drawn;
void oracle_draw(drawn *out);

/* Its settings with the run's rule and width. */
spt_settings oracle_drawn_settings(const drawn *d, const oracle_run *run);

#endif
