/* SPDX-License-Identifier: MIT
 *
 * The one instance of the volume kernel that kernels of every width share: as narrow as the
 * narrowest of them (backend/chunk_table.c). */
#include "volume.h"

#ifdef SPTI_HAVE_SSE2
#define SPT_LANES 4
#else
#define SPT_LANES 1
#endif
#include "volume_kernel.h"

void spti_volume_cut(const spt_bound *bound, size_t count, spti_volume_rays *rays) {
    for (size_t at = 0; at < count; at += SPT_LANES) {
        interval_ray ray;
        volume_interval inside;
        ray.length = ray.reach = spt_splat(0.0f); /* concern hulls */
        for (int axis = 0; axis < 3; ++axis) {
            ray.origin[axis] = spt_load(&rays->origin[axis][at]);
            ray.direction[axis] = spt_load(&rays->direction[axis][at]);
        }
        interval_of_volume(bound, &ray, &inside);
        spt_store(&rays->t_min[at], spt_max(inside.in, spt_load(&rays->t_min[at])));
        spt_store(&rays->t_max[at], spt_min(inside.out, spt_load(&rays->t_max[at])));
    }
}
