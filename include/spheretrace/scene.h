/* SPDX-License-Identifier: MIT
 *
 * Scenes: the union of many fields, traced lazily. A ray asks a component only where no other
 * can be nearer, so that 41 objects cost little more than the two or three that the ray meets.
 * Smooth unions are no unions of surfaces: blend them inside one field. Cameras are in frame.h.
 *
 * WHAT COMES BACK is the first surface on the ray, as if every component had been traced by
 * itself with spt_trace() and the nearest hit taken: t, residual and outcome have the same bits,
 * as long as the fields keep their Lipschitz promises (of one that does not, what it hides
 * behind its true distance may be passed over). A component whose field has SPT_FIELD_CONVEX is
 * traced with spt_convex(), the others with settings.method. So nothing that is left out because
 * it cannot be met (by a bound, by a tile's list) changes a result, and neither do a ray's
 * neighbours. */
#ifndef SPHERETRACE_SCENE_H
#define SPHERETRACE_SCENE_H

#include "base.h"
#include "field.h"
#include "trace.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A ball that rays jump over: what lies in it is not there for them, so that it can be drawn by
 * other means (Szécsi et al. 2016, section 8.4). A surface that crosses the ball's boundary is cut
 * there, and shows the cut where it is solid: a ray that comes from outside and leaves the ball
 * into a body hits it there, with the residual f < 0 of that point and no SPT_FLAG_INSIDE. A ray
 * that begins in a ball begins where it leaves it, and one that comes to a ball inside of a body
 * goes on behind it. World units, finite; radius > 0. */
typedef struct spt_zone {
    float center[3];
    float radius;
    int32_t component; /* of which component; -1: of all */
} spt_zone;

/* A hard union of fields. All arrays are the caller's and must live as long as the calls that are
 * handed the scene; none is written. */
typedef struct spt_scene {
    size_t struct_size;       /* set by spt_scene_default() */
    const spt_field *fields;  /* count of them, all of one struct_size. Each has its own Lipschitz
                               * constant, flags and bound: a bound saves the evaluations of the
                               * rays that miss it, and lets a frame's tiles cull the component */
    size_t count;             /* at least 1, at most 2^23 */
    const int32_t *materials; /* count numbers that mean something to the caller, or NULL */
    const spt_zone *zones;    /* zone_count of them, or NULL */
    size_t zone_count;        /* at most 2^16. A ray looks at each about once for every component
                               * that it asks, and once more for every ball it jumps over */
} spt_scene;

/* A scene of no fields yet, without materials and zones. */
static inline spt_scene spt_scene_default(void) {
    spt_scene scene = {0, NULL, 0, NULL, NULL, 0};
    scene.struct_size = sizeof scene;
    return scene;
}

/* The material of a hit: of spt_hits.component, or -1 where nothing was hit or the scene has no
 * materials. */
static inline int32_t spt_scene_material(const spt_scene *scene, int32_t component) {
    if (scene->materials == NULL || component < 0) return -1;
    return scene->materials[component];
}

/* The bytes of workspace that a call of spt_scene_trace() needs for this scene: about 42 KiB a
 * component and 140 KiB. 0 where the scene or the settings break their rules. */
SPT_API size_t spt_scene_workspace(const spt_scene *scene, const spt_settings *settings);

/* Traces count rays against the union.
 *   scene, settings   as documented; settings.budget counts evaluations of components, all together
 *   rays, hits        as for spt_trace(). In addition:
 *                     component   which field was hit; -1: none. Of equally near hits the lower
 *                     residual    f of the component that decided the outcome
 *                     flags       SPT_FLAG_STEEP if any component asked showed it, SPT_FLAG_INSIDE
 *                                 if the ray began inside any that was asked. Each component has
 *                                 its own inside: a ray that begins in one looks for the way out
 *                                 of it, and for the way into the others
 *                     candidate   the least over the samples of all components, each of which is
 *                                 asked only inside its bound
 *                     SPT_LIMIT   t and residual are those of the component that would have been
 *                                 asked next; up to t the ray is free of all, but t need not grow
 *                                 with the budget
 *                     SPT_NONFINITE is the outcome where a component answers so before any hit
 *   workspace         memory of the calling thread for the time of the call, any alignment
 *   workspace_size    its bytes, at least spt_scene_workspace()
 *   statistics        or NULL; largest_slope is of f / lipschitz, of whichever component;
 *                     evaluations, slots and utilisation are those of the components'
 *                     batches: rays whose nearest component is the same are evaluated together
 *                     (task buffers: Szécsi et al. 2016, section 10)
 * Returns SPT_BAD_ARGUMENT as spt_trace() does, and for a bad component or zone, or a component
 * number outside -1 .. count - 1; SPT_BUFFER_TOO_SMALL for a workspace too small. Nothing is
 * written then, not even the workspace.
 * Cost beside the callbacks: a bound's test for every component and ray (about 2 ns), and about
 * 15 ns each time that a ray turns to another component.
 * Source: Szécsi et al. 2016, section 5.1, generalised from sphere tracing of kernels to any field
 * and step rule by keeping a component's march, and not only its free distance. */
SPT_API spt_status spt_scene_trace(const spt_scene *scene, const spt_settings *settings,
                                   size_t count, const spt_rays *rays, const spt_hits *hits,
                                   void *workspace, size_t workspace_size,
                                   spt_statistics *statistics);

#ifdef __cplusplus
}
#endif
#endif
