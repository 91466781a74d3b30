/* SPDX-License-Identifier: MIT
 *
 * The cameras of the scenes: a pinhole's rays, by rows or by tiles. */
#include "scenes.h"

#include <math.h>

/* tile 16x16 pixels */
enum { tile_side = 16, tile_bits = 4 };

typedef struct pinhole {
    double eye[3], forward[3], right[3], up[3]; /* unit vectors */
    double half_pixel;                          /* at distance 1 */
    double t_max;
    int width, height;
} pinhole;

static void normalize(double v[3]) {
    const double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int axis = 0; axis < 3; ++axis) v[axis] /= length;
}

static void cross(const double a[3], const double b[3], double product[3]) {
    product[0] = a[1] * b[2] - a[2] * b[1];
    product[1] = a[2] * b[0] - a[0] * b[2];
    product[2] = a[0] * b[1] - a[1] * b[0];
}

static pinhole pinhole_of(const scene *shown, int width, int height) {
    const double radians = 3.14159265358979323846 / 180;
    const double vertical[3] = {0, 1, 0};
    pinhole camera;
    for (int axis = 0; axis < 3; ++axis) {
        camera.eye[axis] = shown->eye[axis];
        camera.forward[axis] = shown->target[axis] - shown->eye[axis];
    }
    normalize(camera.forward);
    cross(camera.forward, vertical, camera.right);
    normalize(camera.right);
    cross(camera.right, camera.forward, camera.up);
    camera.half_pixel = tan(shown->field_of_view / 2 * radians) / width;
    camera.t_max = shown->t_max;
    camera.width = width;
    camera.height = height;
    return camera;
}

static spt_ray ray_of(const pinhole *camera, int column, int row) {
    const double sideways = camera->half_pixel * (2 * column + 1 - camera->width);
    const double upwards = camera->half_pixel * (camera->height - 2 * row - 1);
    double direction[3];
    spt_ray ray;
    for (int axis = 0; axis < 3; ++axis) {
        direction[axis] =
            camera->forward[axis] + sideways * camera->right[axis] + upwards * camera->up[axis];
    }
    normalize(direction);
    for (int axis = 0; axis < 3; ++axis) {
        ray.origin[axis] = (float)camera->eye[axis];
        ray.direction[axis] = (float)direction[axis];
    }
    ray.t_min = 0;
    ray.t_max = (float)camera->t_max;
    return ray;
}

void scene_rays(const scene *shown, int width, int height, spt_ray *rays, float *pixel_radius) {
    const pinhole camera = pinhole_of(shown, width, height);
    for (int row = 0; row < height; ++row) {
        for (int column = 0; column < width; ++column) {
            *rays++ = ray_of(&camera, column, row);
        }
    }
    *pixel_radius = (float)camera.half_pixel;
}

/* Every second bit of a Morton index, which is one coordinate of the place in the tile. */
static int every_second_bit(int index) {
    int coordinate = 0;
    for (int bit = 0; bit < tile_bits; ++bit) coordinate |= (index >> bit) & (1 << bit);
    return coordinate;
}

void scene_rays_tiled(const scene *shown, int width, int height, spt_ray *rays, size_t *pixel,
                      float *pixel_radius) {
    const pinhole camera = pinhole_of(shown, width, height);
    for (int top = 0; top < height; top += tile_side) {
        for (int left = 0; left < width; left += tile_side) {
            for (int index = 0; index < tile_side * tile_side; ++index) {
                const int column = left + every_second_bit(index);
                const int row = top + every_second_bit(index >> 1);
                if (column >= width || row >= height) continue;
                *rays++ = ray_of(&camera, column, row);
                if (pixel != NULL) *pixel++ = (size_t)row * (size_t)width + (size_t)column;
            }
        }
    }
    *pixel_radius = (float)camera.half_pixel;
}
