/* SPDX-License-Identifier: MIT
 *
 * Woods: a few trees, doubled again and again by mirrors without kernels of their own (Szécsi et
 * al. 2016, section 9.2). */
#include "model_grow.h"

#include <math.h>

#define QUARTER 1.5707963267948966 /* a quarter turn */

void model_plant(model_wood *wood, const model_plot *plots, int count, int doublings,
                 uint32_t seed) {
    model_plot all[MODEL_PLOTS << MODEL_DOUBLINGS];
    double turn = model_random(&seed, 0, 4 * QUARTER);
    for (int i = 0; i < count; ++i) all[i] = plots[i];
    for (int level = 0; level < doublings; ++level) {
        const double x = cos(turn), z = sin(turn);
        double edge = 0;
        for (int i = 0; i < count; ++i)
            edge = fmax(edge, x * all[i].x + z * all[i].z + all[i].radius);
        const spt_mirror mirror = {{(float)x, 0, (float)z}, (float)edge};
        wood->mirrors[level] = mirror;
        for (int i = 0; i < count; ++i) {
            const double beyond = x * all[i].x + z * all[i].z - edge;
            const model_plot image = {all[i].x - 2 * beyond * x, all[i].z - 2 * beyond * z,
                                      all[i].radius};
            all[count + i] = image;
        }
        count *= 2;
        turn += QUARTER * model_random(&seed, 0.75, 1.25);
    }
    wood->doublings = (uint32_t)doublings;
}

void model_multiply(model_sketch *sketch, const model_wood *wood) {
    for (uint32_t i = 0; i < wood->doublings; ++i) {
        sketch->mirrors[sketch->levels] = wood->mirrors[i];
        sketch->kernels[++sketch->levels] = spt_kernel_empty();
    }
}
