/* SPDX-License-Identifier: MIT
 *
 * One loop over points for each function of shapes.h. Not linked into anything: the compiler must
 * report that it vectorised every one of them, see vectorise.sh. */
#include <spheretrace/shapes.h>

#define COUNT 256

/* What a callback gets: see spt_distance_batch_fn. */
#define LOOP(name, value) \
    void vectorise_##name(const float *restrict x, const float *restrict y, \
                          const float *restrict z, float *restrict distance); \
    void vectorise_##name(const float *restrict x, const float *restrict y, \
                          const float *restrict z, float *restrict distance) { \
        for (int i = 0; i < COUNT; ++i) { \
            const spt_point p = spt_point_of(x[i], y[i], z[i]); \
            distance[i] = (value); \
        } \
    }

/* What an operator on points yields, as one number. */
static inline float sum(spt_point p) {
    return p.x + 2 * p.y + 3 * p.z;
}

/* What an operator on surfaces yields, as one number. */
static inline float both(spt_surface surface) {
    return surface.distance + (float)surface.material;
}

static const spt_point half = {1, 2, 3};
static const spt_point a = {1, 2, 3}, b = {-1, 3, 2};
static const spt_half_space planes[6] = {
    {{0.850650808f, 0.525731112f, 0}, 1}, {{0.850650808f, -0.525731112f, 0}, 1},
    {{0, 0.850650808f, 0.525731112f}, 1}, {{0, 0.850650808f, -0.525731112f}, 1},
    {{0.525731112f, 0, 0.850650808f}, 1}, {{-0.525731112f, 0, 0.850650808f}, 1}};
extern const spt_arc vectorise_arc;
extern const spt_rotation vectorise_rotation;

LOOP(sphere, spt_sphere(p, 1))
LOOP(plane, spt_plane(p, spt_point_of(0.6f, 0.8f, 0), 1))
LOOP(box, spt_box(p, half))
LOOP(rounded_box, spt_rounded_box(p, half, 0.25f))
LOOP(torus, spt_torus(p, 2, 0.5f))
LOOP(capped_torus, spt_capped_torus(p, 0.6f, 0.8f, 2, 0.5f))
LOOP(capsule, spt_capsule(p, a, b, 0.5f))
LOOP(cylinder, spt_cylinder(p, 1, 2))
LOOP(cone, spt_cone(p, 2, 0.6f, 0.8f))
LOOP(ellipsoid, spt_ellipsoid(p, half))
LOOP(toroidal_capsule, spt_toroidal_capsule(p, &vectorise_arc))
LOOP(polytope, spt_polytope(p, 6, planes))
LOOP(slabs, spt_slabs(p, 6, planes))
LOOP(generalised_distance, spt_generalised_distance(p, 6, planes, 7))
LOOP(generalised_slabs, spt_generalised_slabs(p, 6, planes, 7))
LOOP(generalised_distance_by_squaring, spt_generalised_distance_by_squaring(p, 6, planes, 5))
LOOP(generalised_slabs_by_squaring, spt_generalised_slabs_by_squaring(p, 6, planes, 5))
LOOP(union, spt_union(p.x, p.y))
LOOP(intersection, spt_intersection(p.x, p.y))
LOOP(difference, spt_difference(p.x, p.y))
LOOP(smooth_union, spt_smooth_union(p.x, p.y, 0.5f))
LOOP(smooth_intersection, spt_smooth_intersection(p.x, p.y, 0.5f))
LOOP(smooth_difference, spt_smooth_difference(p.x, p.y, 0.5f))
LOOP(surface_union, both(spt_surface_union(spt_surface_of(p.x, 1), spt_surface_of(p.y, 2))))
LOOP(surface_intersection,
     both(spt_surface_intersection(spt_surface_of(p.x, 1), spt_surface_of(p.y, 2))))
LOOP(surface_difference,
     both(spt_surface_difference(spt_surface_of(p.x, 1), spt_surface_of(p.y, 2))))
LOOP(surface_smooth_union,
     both(spt_surface_smooth_union(spt_surface_of(p.x, 1), spt_surface_of(p.y, 2), 0.5f)))
LOOP(surface_smooth_intersection,
     both(spt_surface_smooth_intersection(spt_surface_of(p.x, 1), spt_surface_of(p.y, 2), 0.5f)))
LOOP(surface_smooth_difference,
     both(spt_surface_smooth_difference(spt_surface_of(p.x, 1), spt_surface_of(p.y, 2), 0.5f)))
LOOP(translate, sum(spt_translate(p, a)))
LOOP(rotate, sum(spt_rotate(p, &vectorise_rotation)))
LOOP(scale, sum(spt_scale(p, 3)))
LOOP(repeat, sum(spt_repeat(p, half)))
LOOP(twist, sum(spt_twist(p, 0.5f)))
LOOP(bend, sum(spt_bend(p, 0.5f)))
LOOP(positive, spt_positive(p.x) * spt_positive(p.x))
LOOP(negative, 1 / (spt_negative(p.x) - 1))
LOOP(clamp, p.y - 2 * spt_clamp(p.x, 0, 1))
LOOP(choose, spt_choose(p.x > p.y, p.x *p.x, spt_root(p.z)))
LOOP(sin, spt_sin(p.x))
LOOP(cos, spt_cos(p.x))
LOOP(exp, spt_exp(p.x))
LOOP(log, spt_log(p.x))

/* What a callback reads from its user pointer: no constants. */
typedef struct scene {
    spt_point a, b;
    spt_half_space planes[6];
    float size, blend;
} scene;
extern const scene vectorise_scene;
static const scene *const s = &vectorise_scene;

LOOP(box_of_scene, spt_box(p, s->a))
LOOP(capsule_of_scene, spt_capsule(p, s->a, s->b, s->size))
LOOP(cone_of_scene, spt_cone(p, s->size, s->a.x, s->a.y))
LOOP(slabs_of_scene, spt_slabs(p, 6, s->planes))
LOOP(generalised_slabs_of_scene, spt_generalised_slabs(p, 6, s->planes, s->size))
LOOP(repeat_of_scene, sum(spt_repeat(p, s->a)))
LOOP(smooth_of_scene,
     spt_smooth_difference(spt_box(spt_translate(p, s->a), s->b), spt_sphere(p, s->size), s->blend))
LOOP(clamp_of_scene, spt_clamp(p.x, s->size, s->blend))
