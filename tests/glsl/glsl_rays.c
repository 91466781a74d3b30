/* SPDX-License-Identifier: MIT
 *
 * Rays for bodies of about unit size around the origin. */
#include "glsl_scenes.h"

#include <math.h>
#include <string.h>

static uint32_t random_state;

/* splitmix32 */
static float draw(float low, float high) {
    uint32_t x = random_state += 0x9e3779b9u;
    x = (x ^ (x >> 16)) * 0x85ebca6bu;
    x = (x ^ (x >> 13)) * 0xc2b2ae35u;
    x ^= x >> 16;
    return low + (high - low) * ((float)(x >> 8) / 16777216.0f);
}

static void draw_vector(float v[3], float most) {
    for (int axis = 0; axis < 3; ++axis) v[axis] = draw(-most, most);
}

static spt_ray ordinary_ray(int number) {
    spt_ray ray;
    float target[3], length = 0.0f, scale;
    memset(&ray, 0, sizeof ray);
    draw_vector(target, 1.1f);
    draw_vector(ray.origin, 1);
    /* Every fourth begins among the bodies; the others before them, some far away. */
    if (number % 4 != 0) {
        ray.origin[2] = number % 16 == 5 ? -40.0f : -draw(2, 5);
        if (number % 16 == 9) ray.origin[1] = number % 32 == 9 ? 300.0f : 3e4f;
    }
    for (int axis = 0; axis < 3; ++axis) {
        ray.direction[axis] = target[axis] - ray.origin[axis];
        length += ray.direction[axis] * ray.direction[axis];
    }
    /* Unit, times a power of two, times anything; some along an axis. */
    scale = number % 3 == 0   ? 1.0f
            : number % 3 == 1 ? ldexpf(1, (int)draw(-20, 20))
                              : draw(0.05f, 30);
    for (int axis = 0; axis < 3; ++axis) ray.direction[axis] *= scale / sqrtf(length);
    if (number % 19 == 7) {
        ray.direction[0] = ray.direction[1] = 0.0f;
        ray.direction[2] = scale;
    }
    ray.t_min = number % 5 == 2 ? draw(0, 3) / scale : 0.0f;
    ray.t_max = number % 6 == 1   ? draw(0, 6) / scale
                : number % 6 == 3 ? 0.99e18f / scale
                                  : 1e3f / scale;
    return ray;
}

/* Spoils a ray in one of the ways that trace.h names. */
static void spoil(spt_ray *ray, float *path, int way) {
    const int axis = way % 3;
    switch (way % 11) {
    case 0:
        ray->origin[axis] = NAN;
        break;
    case 1:
        ray->direction[axis] = INFINITY;
        break;
    case 2:
        ray->direction[axis] = NAN;
        break;
    case 3:
        memset(ray->direction, 0, sizeof ray->direction);
        break;
    case 4:
        ray->t_min = -1;
        break;
    case 5:
        ray->t_min = NAN;
        break;
    case 6:
        ray->t_max = NAN;
        break;
    case 7:
        ray->t_max = -INFINITY;
        break;
    case 8:
        ray->origin[axis] = -INFINITY;
        break;
    case 9:
        *path = -1;
        break;
    default:
        *path = NAN;
        break;
    }
}

void glsl_rays(int odd, int count, spt_ray *rays, float *paths) {
    random_state = 1996;
    for (int i = 0; i < count; ++i) {
        rays[i] = ordinary_ray(i);
        paths[i] = i % 2 == 0 ? 0.0f : draw(0, 20);
        if (odd && i % 7 == 3) spoil(&rays[i], &paths[i], i / 7);
    }
}
