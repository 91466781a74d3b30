/* SPDX-License-Identifier: MIT
 *
 * What the models are built with: random numbers, vectors, a world that is filled component by
 * component, and trees from the forks of one route (Szécsi et al. 2016, section 9.2). Left out:
 * the models themselves. */
#ifndef EXAMPLES_MODEL_BUILD_H
#define EXAMPLES_MODEL_BUILD_H

#include "models.h"

#define X(name) extern const model model_##name;
#include "models_list.h"
#undef X

/* ---- Numbers ------------------------------------------------------------------------------- */

/* Random numbers of a model: start with any state. Uniform in [low, high). */
double model_random(uint32_t *state, double low, double high);

double model_dot(const double a[3], const double b[3]);
void model_cross(const double a[3], const double b[3], double product[3]);
void model_unit(double v[3]); /* of some length; brought to length 1 */

/* ---- Worlds -------------------------------------------------------------------------------- */

/* An empty world. */
void model_begin(model_world *world);

/* Adds a component of one material, white, without leaves, and returns it to be changed; or NULL
 * where the library refused it, or the world is full. */
model_component *model_add_krs(model_world *world, const spt_krs_model *described,
                               model_material material);

/* The same for a field that is made of the component which was added last: bent, twisted. */
model_component *model_distort(model_world *world, const spt_distortion *distortion);

/* Makes the scene of what was added. Returns 0 if that is nothing. */
int model_finish(model_world *world);

#endif
