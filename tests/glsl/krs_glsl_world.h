/* SPDX-License-Identifier: MIT
 *
 * Random models of the library's own for the tests of their GLSL, and the comparison of a field's
 * callback with what a shader answers. Left out: what the models should be, see tests/oracle. */
#ifndef TESTS_GLSL_KRS_GLSL_WORLD_H
#define TESTS_GLSL_KRS_GLSL_WORLD_H

#include <spheretrace/spheretrace.h>

/* Kinds of kernels, as bits. */
enum {
    WORLD_EMPTY = 1u << SPT_KERNEL_EMPTY,
    WORLD_SPHERE = 1u << SPT_KERNEL_SPHERE,
    WORLD_HALF_SPACE = 1u << SPT_KERNEL_HALF_SPACE,
    WORLD_CAPSULE = 1u << SPT_KERNEL_CAPSULE,
    WORLD_LEAF = 1u << SPT_KERNEL_LEAF,
    WORLD_FIELD = 1u << SPT_KERNEL_FIELD,
    WORLD_OWN = WORLD_EMPTY | WORLD_SPHERE | WORLD_HALF_SPACE | WORLD_CAPSULE | WORLD_LEAF,
    WORLD_ANY = WORLD_OWN | WORLD_FIELD
};

/* Callers' fields with text: a turned box, a torus of lipschitz 2 whose text needs a prelude, and
 * the same with another radius by the same prelude; all within 1 of the origin. */
enum { WORLD_FIELDS = 3 };
const spt_field *world_field(int number);

/* What is the same, but NaN in z > 0.5 and -infinity in z < -0.5. */
const spt_field *world_field_with_nan(void);

/* What is nowhere: +infinity, with a Lipschitz constant. */
const spt_field *world_field_of_nothing(float lipschitz);

/* A random kernel within about 1 of the origin, of one of the kinds. */
spt_kernel world_kernel(uint32_t kinds);

/* Random models of kernels of these kinds; mirrors and maps stand anywhere. */
void world_krs(uint32_t levels, uint32_t kinds, spt_krs *krs);
void world_moekrs(uint32_t levels, uint32_t kinds, uint64_t unmirrored, spt_moekrs *moekrs);

/* A random map: some of a translation, a rotation, a dilation, a reflection, and an inversion. */
spt_mobius world_map(void);

/* How many points a comparison has. */
enum { WORLD_POINTS = 2048 };

/* Compares the field's callback with a shader of this target, at
 * random points in its bound and near its surface, at some far away, and in and around up to 8
 * places. Returns how many differ in a bit, and says where first; -1 where no shader was written or
 * ran, which is said, too. */
int world_differences_at(const spt_field *field, uint32_t target, uint32_t features,
                         float (*places)[3], int place_count, char said[512]);

/* The place is the origin. */
int world_differences(const spt_field *field, uint32_t target, uint32_t features, char said[512]);

/* The text of a program, or NULL where it is refused; to be freed. */
char *world_emit(const spt_glsl_options *options, spt_status *status);

/* Random rays about a field, those of a call, and their paths. */
enum { WORLD_RAYS = 512 };
void world_rays(const spt_field *field, spt_ray rays[WORLD_RAYS], float paths[WORLD_RAYS]);

/* Rays through a program of HITS of GL 4.5. */
typedef struct world_trace {
    const spt_field *field;
    const spt_settings *settings;
    uint32_t features;
    spt_ray rays[WORLD_RAYS];
    float paths[WORLD_RAYS];
    spt_hit hits[WORLD_RAYS]; /* what it answered; 3.0e38 as +infinity */
} world_trace;

/* Runs it; 0 and a text where that fails. */
int world_run(world_trace *trace, char said[512]);

/* In how many rays anything that was asked for has other bits than here; says which first. */
int world_wrong_hits(const world_trace *trace, const spt_hit expected[WORLD_RAYS], char said[512]);

#endif
