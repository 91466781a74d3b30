/* SPDX-License-Identifier: MIT
 *
 * What the tests of scenes share: rays with all their columns, a guarded call of spt_scene_trace(),
 * and what the components of a scene give one by one, which is what the scene must give. */
#ifndef TESTS_ORACLE_SCENE_RUN_H
#define TESTS_ORACLE_SCENE_RUN_H

#include <spheretrace/scene.h>

/* A ray with all its columns. */
typedef struct scene_ray {
    spt_ray ray;
    float path;
    int32_t active;
} scene_ray;

spt_rays scene_rays_of(const scene_ray *array);

/* ---- Runs ---------------------------------------------------------------------------------- */

/* Visits the step rules that may trace a scene (the convex one if every field is convex), and names
 * them in the context of the checks, after a title:
 *     for (scene_rules walk = scene_first_rule(&united, title); scene_next_rule(&walk);) ... */
typedef struct scene_rules {
    const spt_method *method;
    const char *title;
    int place, all_convex;
} scene_rules;
scene_rules scene_first_rule(const spt_scene *united, const char *title);
int scene_next_rule(scene_rules *walk);

/* Calls spt_scene_trace() with a workspace of just the size that it asks for, at an odd address
 * and between guards, and checks that it says SPT_OK, keeps the guards and counts in the
 * statistics what the results say. */
void scene_run(const spt_scene *united, const spt_settings *settings, size_t count,
               const scene_ray *rays, spt_hit *hits);

/* The same call for any columns; statistics may be NULL. */
void scene_call(const spt_scene *united, const spt_settings *settings, size_t count,
                const spt_rays *rays, const spt_hits *hits, spt_statistics *statistics);

/* ---- The components one by one ------------------------------------------------------------- */

/* What a scene must say of a ray, from spt_trace() of each component by itself. An event is a hit,
 * or a value that is no distance.
 *   first      the event with the least t, of equals that of the lowest component: t, residual,
 *              outcome, component, and the component's own evaluations and flags. A miss where
 *              there is none; fallbacks and the candidate, of all components, are known then, too
 *   promised   the least t of an event of a component without SPT_FLAG_STEEP, or +infinity
 *   sum        evaluations of all components, none cut short by another's hit
 *   any        flags that some component showed
 *   undecided  the ray is inactive, or the budget may bind: nothing is expected */
typedef struct scene_expected {
    spt_hit first;
    float promised;
    uint64_t sum;
    uint32_t any;
    int undecided;
} scene_expected;

/* One component of a scene by itself, as scene.h says it is traced: by the secant rule where it is
 * convex, else by the rule of the settings. */
void scene_trace_alone(const spt_scene *united, size_t index, const spt_settings *settings,
                       size_t count, const spt_rays *rays, spt_hit *hits);

/* Expects for count rays; the budget of the settings should never bind. */
void scene_expect(const spt_scene *united, const spt_settings *settings, size_t count,
                  const scene_ray *rays, scene_expected *expected);

/* Adds what one more component gives: expected is as of those before it, or of none with
 * scene_expect_nothing(). */
void scene_expect_nothing(scene_expected *expected);
void scene_expect_also(scene_expected *expected, const spt_hit *alone, int32_t component);

/* Checks results against it: t, residual, outcome and component by their bits, the rest as far as
 * it is known. A component that breaks its promise may have an event inside what its own sphere
 * said is free: other components' events may then come first, so that such a one, and only it, may
 * be passed over. */
void scene_check(const spt_scene *united, const spt_settings *settings, size_t count,
                 const scene_ray *rays, const scene_expected *expected, const spt_hit *hits);

#endif
