/* SPDX-License-Identifier: MIT
 *
 * From hits on the models of nature to colours. */
#ifndef EXAMPLES_MODELS_SHADE_H
#define EXAMPLES_MODELS_SHADE_H

#include "models_surface.h"

/* What a thread needs for itself. */
typedef struct models_desk {
    models_points points;
    void *workspace;
    size_t workspace_size;
} models_desk;

/* Returns 0 where memory ran out; nothing is to be freed then. */
int models_desk_create(models_desk *desk, const models_stage *stage);
void models_desk_free(models_desk *desk);

/* The colours (linear, 0 to 1) of at most SPT_BATCH rays of unit direction. */
spt_status models_shade(const models_stage *stage, models_desk *desk, size_t count,
                        const spt_ray *rays, const spt_hit *hits, float (*colours)[3]);

#endif
