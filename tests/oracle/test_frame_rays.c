/* SPDX-License-Identifier: MIT
 *
 * Cameras: rays against double precision, the builders, and what is refused. */
#include "frame_camera.h"
#include "../check.h"

#include <spheretrace/frame.h>

#include <math.h>
#include <string.h>

enum { points = 300, cameras = 4 };

static float nowhere(void *user, float x, float y, float z) {
    (void)user;
    return x * x + y * y + z * z;
}

/* A frame needs a scene; its cameras are what is looked at here. */
static spt_scene any_scene(spt_field *field) {
    spt_scene world = spt_scene_default();
    *field = spt_field_default();
    field->point = nowhere;
    world.fields = field;
    world.count = 1;
    return world;
}

static const double eye[3] = {3, 2, -7}, target[3] = {0.5, -1, 2};

/* Points of the image: its corners, its middle, pixel centres and others. */
static void draw_points(uint32_t width, uint32_t height, size_t count, float *x, float *y) {
    for (size_t i = 0; i < count; ++i) {
        x[i] = (float)(check_random() % (width + 1));
        y[i] = (float)(check_random() % (height + 1));
        if (i % 3 != 0 && x[i] < (float)width) x[i] += 0.5f;
        if (i % 3 != 0 && y[i] < (float)height) y[i] += 0.5f;
        if (i % 5 == 0) x[i] = (float)check_uniform(0, width);
        if (i % 7 == 0) y[i] = (float)check_uniform(0, height);
        if (i < 4) x[i] = (i & 1) != 0 ? (float)width : 0;
        if (i < 4) y[i] = (i & 2) != 0 ? (float)height : 0;
    }
}

static void check_ray(const spt_camera *camera, uint32_t width, uint32_t height, double x, double y,
                      const spt_camera_ray *given) {
    const camera_ray truth = camera_ray_at(camera, width, height, x, y);
    double square = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double o = (double)given->ray.origin[axis], d = (double)given->ray.direction[axis];
        CHECK_SAY(fabs(d - truth.direction[axis]) <= truth.direction_error,
                  "point %g %g: direction[%d] %.9g, truth %.9g +- %.2g", x, y, axis, d,
                  truth.direction[axis], truth.direction_error);
        CHECK_SAY(fabs(o - truth.origin[axis]) <= truth.origin_error[axis],
                  "point %g %g: origin[%d] %.9g, truth %.9g", x, y, axis, o, truth.origin[axis]);
        square += d * d;
    }
    /* Of floats below 1 the last place is 2^-24. */
    CHECK_SAY(fabs(sqrt(square) - 1) <= 4 * 0x1p-24, "length 1 %+.3g", sqrt(square) - 1);
    CHECK(check_same_bits(given->ray.t_min, camera->t_min));
    CHECK(check_same_bits(given->ray.t_max, camera->t_max));
    CHECK(check_same_bits(given->path, 0) && given->active != 0);
}

static void check_camera(const spt_camera *camera, uint32_t width, uint32_t height) {
    float x[points], y[points];
    spt_camera_ray rays[points];
    draw_points(width, height, points, x, y);
    memset(rays, 0xa5, sizeof rays);
    CHECK(spt_camera_rays(camera, width, height, points, x, y, rays) == SPT_OK);
    for (int i = 0; i < points; ++i) {
        check_ray(camera, width, height, (double)x[i], (double)y[i], &rays[i]);
    }
}

static const uint32_t sizes[][2] = {{1, 1},       {7, 5},         {64, 64},       {3, 1000},
                                    {1921, 1081}, {65536, 65536}, {46341, 46341}, {1u << 22, 2}};
enum { size_count = sizeof sizes / sizeof sizes[0] };

static void frame_rays_against_double(void) {
    for (int kind = SPT_CAMERA_PINHOLE; kind <= SPT_CAMERA_ORTHOGRAPHIC; ++kind) {
        for (uint32_t variant = 0; variant < CAMERA_VARIANTS; ++variant) {
            for (int i = 0; i < cameras; ++i) {
                const uint32_t *size = sizes[check_random() % size_count];
                const double tangent = exp(check_uniform(-4, 2));
                spt_camera camera = camera_draw((spt_camera_kind)kind, variant, eye, target, 1,
                                                tangent, exp(check_uniform(-2, 2)));
                camera.t_min = (float)check_uniform(0, 2);
                camera.t_max = i == 0 ? INFINITY : (float)check_uniform(2, 90);
                check_context("kind %d, variant %u, %ux%u", kind, variant, size[0], size[1]);
                check_camera(&camera, size[0], size[1]);
            }
        }
    }
}

/* The same point gives the same bits wherever it stands and among however many. */
static void frame_rays_any_count(void) {
    enum { most = 700 };
    static float x[most], y[most];
    static spt_camera_ray whole[most], part[most + 1];
    static const size_t counts[] = {0, 1, 3, 4, 5, 15, 16, 17, 255, 256, 257, 511, 513, 699};
    for (int kind = SPT_CAMERA_PINHOLE; kind <= SPT_CAMERA_ORTHOGRAPHIC; ++kind) {
        const spt_camera camera = camera_draw(
            (spt_camera_kind)kind, CAMERA_OFF_AXIS | CAMERA_SKEWED, eye, target, 1, 0.7, 1.4);
        draw_points(640, 457, most, x, y);
        CHECK(spt_camera_rays(&camera, 640, 457, most, x, y, whole) == SPT_OK);
        for (size_t i = 0; i < sizeof counts / sizeof counts[0]; ++i) {
            const size_t count = counts[i], first = check_random() % (most - count);
            spt_camera_ray untouched;
            memset(part, 0xa5, sizeof part);
            untouched = part[0];
            CHECK(spt_camera_rays(&camera, 640, 457, count, x + first, y + first, part) == SPT_OK);
            CHECK_SAY(memcmp(part, whole + first, count * sizeof *part) == 0, "%zu from %zu", count,
                      first);
            CHECK(memcmp(&part[count], &untouched, sizeof untouched) == 0);
        }
    }
}

/* ---- Rays of the caller -------------------------------------------------------------------- */

typedef struct recorder {
    size_t calls, points, faults;
} recorder;

/* Answers by x and y alone, a few rays with every member set. */
static void recorded_rays(void *user, size_t count, const float *x, const float *y,
                          spt_camera_ray *rays) {
    recorder *seen = user;
    ++seen->calls;
    seen->points += count;
    seen->faults += count == 0 || count > SPT_BATCH;
    for (size_t i = 0; i < count; ++i) {
        spt_camera_ray *out = &rays[i];
        seen->faults += !check_same_bits(out->ray.t_min, 0) || !(out->ray.t_max > 3e38f) ||
                        !check_same_bits(out->path, 0) || out->active == 0;
        for (int axis = 0; axis < 3; ++axis) {
            out->ray.origin[axis] = x[i] * (float)(axis + 1) - y[i];
            out->ray.direction[axis] = (x[i] + 2 * y[i]) * (float)(axis + 1);
        }
        if ((int)x[i] % 2 == 0) continue; /* the rest as it was preset */
        out->ray.t_min = x[i] / 3;
        out->ray.t_max = y[i];
        out->path = x[i];
        out->active = (int32_t)y[i] % 3 - 1;
    }
}

static void frame_rays_of_the_caller(void) {
    float x[points], y[points];
    spt_camera_ray rays[points];
    recorder seen = {0, 0, 0};
    const spt_camera camera = spt_camera_of_rays(recorded_rays, &seen);
    draw_points(640, 480, points, x, y);
    memset(rays, 0xa5, sizeof rays);
    CHECK(spt_camera_rays(&camera, 640, 480, points, x, y, rays) == SPT_OK);
    CHECK_SAY(seen.points == points && seen.faults == 0, "%zu points, %zu faults", seen.points,
              seen.faults);
    for (int i = 0; i < points; ++i) {
        const int preset = (int)x[i] % 2 == 0;
        for (int axis = 0; axis < 3; ++axis) {
            CHECK(check_same_bits(rays[i].ray.origin[axis], x[i] * (float)(axis + 1) - y[i]));
            CHECK(check_same_bits(rays[i].ray.direction[axis],
                                  (x[i] + 2 * y[i]) * (float)(axis + 1)));
        }
        CHECK(check_same_bits(rays[i].ray.t_min, preset ? 0 : x[i] / 3));
        CHECK(check_same_bits(rays[i].ray.t_max, preset ? INFINITY : y[i]));
        CHECK(check_same_bits(rays[i].path, preset ? 0 : x[i]));
        CHECK((rays[i].active != 0) == (preset || (int32_t)y[i] % 3 - 1 != 0));
    }
}

/* ---- Builders ------------------------------------------------------------------------------ */

static void draw_vector(double scale, float v[3]) {
    for (int axis = 0; axis < 3; ++axis) v[axis] = (float)check_uniform(-scale, scale);
}

/* By the words of frame.h: target in the middle, up is up, the plane at distance 1 is seen from
 * -tangent to tangent and as far upwards as the aspect says. */
static void check_builder(int pinhole, uint32_t width, uint32_t height) {
    float from[3], to[3], up[3], x, y;
    double forward[3], right[3], upwards[3], plane[3];
    const float half = (float)exp(check_uniform(-3, 2));
    spt_camera camera;
    spt_camera_ray given;
    do {
        draw_vector(5, from);
        draw_vector(5, to);
        draw_vector(1, up);
        for (int axis = 0; axis < 3; ++axis) {
            forward[axis] = (double)to[axis] - (double)from[axis];
            upwards[axis] = (double)up[axis];
        }
        camera_unit(forward);
        camera_unit(upwards);
        camera_cross(forward, upwards, right);
    } while (sqrt(camera_dot(right, right)) < 0.1);
    CHECK((pinhole ? spt_camera_pinhole : spt_camera_orthographic)(&camera, from, to, up, half,
                                                                   width, height) == SPT_OK);
    CHECK(check_same_bits(camera.t_min, 0) && check_same_bits(camera.t_max, INFINITY));
    CHECK(camera.kind == (pinhole ? SPT_CAMERA_PINHOLE : SPT_CAMERA_ORTHOGRAPHIC));
    camera_unit(right);
    camera_cross(right, forward, upwards);
    for (int corner = 0; corner < 9; ++corner) {
        const double a = (corner % 3 - 1) * (double)half;
        const double b = (1 - corner / 3) * (double)half * height / width;
        x = (float)(corner % 3) / 2 * (float)width;
        y = (float)(corner / 3) / 2 * (float)height;
        CHECK(spt_camera_rays(&camera, width, height, 1, &x, &y, &given) == SPT_OK);
        for (int axis = 0; axis < 3; ++axis) plane[axis] = a * right[axis] + b * upwards[axis];
        /* Axes in float: to - from is off by u of itself, the cross product by 4 u of 1, which its
         * length of at least 0.1 makes 40 u, and the second one by 50 u. a right + b up is then off
         * by 60 u of |a| + |b|, and what is brought to length 1 by that over its
         * length. */
        for (int axis = 0; axis < 3; ++axis) {
            double ray = forward[axis] + plane[axis], length = sqrt(1 + a * a + b * b), o;
            o = (double)from[axis] + (pinhole ? 0 : plane[axis]);
            ray = pinhole ? ray / length : forward[axis];
            CHECK_SAY(fabs((double)given.ray.direction[axis] - ray) < 100 * 0x1p-24,
                      "corner %d: direction[%d] %.9g, truth %.9g", corner, axis,
                      (double)given.ray.direction[axis], ray);
            CHECK_SAY(fabs((double)given.ray.origin[axis] - o) <
                          100 * 0x1p-24 * (fabs(o) + fabs(a) + fabs(b)),
                      "corner %d: origin[%d] %.9g, truth %.9g", corner, axis,
                      (double)given.ray.origin[axis], o);
        }
    }
}

static void frame_rays_builders(void) {
    for (int i = 0; i < 60; ++i) {
        const uint32_t *size = sizes[check_random() % (size_count - 1)];
        check_context("%s, %ux%u", i % 2 != 0 ? "pinhole" : "orthographic", size[0], size[1]);
        check_builder(i % 2, size[0], size[1]);
    }
}

/* Half the lesser side of a pixel at distance 1; for parallel rays in world units. */
static void frame_rays_pixel_radius(void) {
    const uint32_t width = 320, height = 180;
    spt_field field;
    const spt_scene world = any_scene(&field);
    for (uint32_t variant = 0; variant < CAMERA_SKEWED; ++variant) {
        for (int kind = SPT_CAMERA_PINHOLE; kind <= SPT_CAMERA_ORTHOGRAPHIC; ++kind) {
            const spt_camera camera =
                camera_draw((spt_camera_kind)kind, variant, eye, target, 1, 0.8, 1.5);
            const double across = fabs((double)camera.x_high - (double)camera.x_low) / width;
            const double down = fabs((double)camera.y_high - (double)camera.y_low) / height;
            const double radius = fmin(across, down) / 2;
            spt_frame frame;
            check_context("kind %d, variant %u", kind, variant);
            CHECK(spt_frame_init(&frame, &world, &camera, width, height) == SPT_OK);
            CHECK(frame.width == width && frame.height == height);
            CHECK(frame.left == 0 && frame.top == 0);
            CHECK(frame.right == width && frame.bottom == height);
            /* Axes of length 1 within u, a few operations. */
            if (kind == SPT_CAMERA_PINHOLE) {
                CHECK(fabs((double)frame.settings.pixel_radius - radius) <= 16 * 0x1p-24 * radius);
                CHECK(check_same_bits(frame.settings.epsilon, spt_settings_default().epsilon));
            } else {
                CHECK(check_same_bits(frame.settings.pixel_radius, 0));
                CHECK(fabs((double)frame.settings.epsilon - radius) <= 16 * 0x1p-24 * radius);
            }
        }
    }
}

/* ---- Refused ------------------------------------------------------------------------------- */

static const float bad_numbers[] = {NAN, INFINITY, -INFINITY};

static void refused(spt_status status, const spt_camera *camera, const spt_camera *before) {
    CHECK_SAY(status == SPT_BAD_ARGUMENT, "%s", spt_status_name(status));
    CHECK(memcmp(camera, before, sizeof *camera) == 0);
}

typedef spt_status builder(spt_camera *, const float *, const float *, const float *, float,
                           uint32_t, uint32_t);

static void check_builder_refuses(builder *build) {
    const float from[3] = {1, 2, 3}, to[3] = {-1, 0, 2}, up[3] = {0, 1, 0};
    const float along[3] = {-4, -4, -2}, none[3] = {0, 0, 0};
    static const float bad_halves[] = {0, -1, NAN, INFINITY, -INFINITY};
    spt_camera camera, before;
    memset(&camera, 0xa5, sizeof camera);
    before = camera;
    CHECK(build(NULL, from, to, up, 1, 4, 3) == SPT_BAD_ARGUMENT);
    refused(build(&camera, NULL, to, up, 1, 4, 3), &camera, &before);
    refused(build(&camera, from, NULL, up, 1, 4, 3), &camera, &before);
    refused(build(&camera, from, to, NULL, 1, 4, 3), &camera, &before);
    refused(build(&camera, from, from, up, 1, 4, 3), &camera, &before);
    refused(build(&camera, from, to, along, 1, 4, 3), &camera, &before);
    refused(build(&camera, from, to, none, 1, 4, 3), &camera, &before);
    refused(build(&camera, from, to, up, 1, 0, 3), &camera, &before);
    refused(build(&camera, from, to, up, 1, 4, 0), &camera, &before);
    for (int i = 0; i < 5; ++i) {
        refused(build(&camera, from, to, up, bad_halves[i], 4, 3), &camera, &before);
    }
    for (int place = 0; place < 9; ++place) {
        for (int i = 0; i < 3; ++i) {
            float bad[9] = {1, 2, 3, -1, 0, 2, 0, 1, 0};
            bad[place] = bad_numbers[i];
            refused(build(&camera, bad, bad + 3, bad + 6, 1, 4, 3), &camera, &before);
        }
    }
    CHECK(build(&camera, from, to, up, 1, 4, 3) == SPT_OK);
}

static void frame_rays_builders_refuse(void) {
    check_context("pinhole");
    check_builder_refuses(spt_camera_pinhole);
    check_context("orthographic");
    check_builder_refuses(spt_camera_orthographic);
}

static void check_bad_camera(const spt_camera *camera, const char *why) {
    const float x[2] = {1, 2}, y[2] = {1, 0};
    spt_camera_ray rays[2], before[2];
    spt_field field;
    const spt_scene world = any_scene(&field);
    spt_frame frame, untouched;
    memset(rays, 0xa5, sizeof rays);
    memcpy(before, rays, sizeof rays);
    memset(&frame, 0xa5, sizeof frame);
    untouched = frame;
    CHECK_SAY(spt_camera_rays(camera, 4, 3, 2, x, y, rays) == SPT_BAD_ARGUMENT, "%s", why);
    CHECK_SAY(memcmp(rays, before, sizeof rays) == 0, "%s", why);
    CHECK_SAY(spt_frame_init(&frame, &world, camera, 4, 3) == SPT_BAD_ARGUMENT, "%s", why);
    CHECK_SAY(memcmp(&frame, &untouched, sizeof frame) == 0, "%s", why);
}

static void frame_rays_bad_numbers(void) {
    for (int kind = SPT_CAMERA_PINHOLE; kind <= SPT_CAMERA_ORTHOGRAPHIC; ++kind) {
        const spt_camera good = camera_draw((spt_camera_kind)kind, 0, eye, target, 1, 0.8, 1.5);
        spt_camera bad = good;
        float *const finite[] = {
            bad.eye,    bad.eye + 1, bad.eye + 2, bad.right,   bad.right + 1,   bad.right + 2,
            bad.up,     bad.up + 1,  bad.up + 2,  bad.forward, bad.forward + 1, bad.forward + 2,
            &bad.x_low, &bad.x_high, &bad.y_low,  &bad.y_high, &bad.t_min};
        for (size_t place = 0; place < sizeof finite / sizeof finite[0]; ++place) {
            for (int i = 0; i < 3; ++i) {
                bad = good;
                *finite[place] = bad_numbers[i];
                check_context("kind %d, number %zu", kind, place);
                check_bad_camera(&bad, "not finite");
            }
        }
        check_context("kind %d", kind);
        bad = good;
        bad.t_min = -1;
        check_bad_camera(&bad, "t_min negative");
        bad = good;
        bad.t_max = NAN;
        check_bad_camera(&bad, "t_max NaN");
        bad = good;
        memset(bad.right, 0, sizeof bad.right);
        check_bad_camera(&bad, "right 0");
        bad = good;
        memcpy(bad.up, bad.right, sizeof bad.up);
        check_bad_camera(&bad, "up is right");
        bad = good;
        bad.struct_size = 0;
        check_bad_camera(&bad, "struct_size 0");
    }
}

static void frame_rays_refuse(void) {
    const float x[1] = {1}, y[1] = {1};
    recorder seen = {0, 0, 0};
    spt_camera good = camera_draw(SPT_CAMERA_PINHOLE, 0, eye, target, 1, 0.8, 1.5), bad;
    spt_camera_ray ray;
    for (uint32_t kind = 0; kind < 9; ++kind) {
        if (kind == SPT_CAMERA_PINHOLE || kind == SPT_CAMERA_ORTHOGRAPHIC) continue;
        bad = good;
        bad.kind = kind; /* SPT_CAMERA_RAYS among them, without a callback */
        check_bad_camera(&bad, "kind");
    }
    CHECK(spt_camera_rays(NULL, 4, 3, 1, x, y, &ray) == SPT_BAD_ARGUMENT);
    CHECK(spt_camera_rays(&good, 0, 3, 1, x, y, &ray) == SPT_BAD_ARGUMENT);
    CHECK(spt_camera_rays(&good, 4, 0, 1, x, y, &ray) == SPT_BAD_ARGUMENT);
    CHECK(spt_camera_rays(&good, 4, 3, 1, NULL, y, &ray) == SPT_BAD_ARGUMENT);
    CHECK(spt_camera_rays(&good, 4, 3, 1, x, NULL, &ray) == SPT_BAD_ARGUMENT);
    CHECK(spt_camera_rays(&good, 4, 3, 1, x, y, NULL) == SPT_BAD_ARGUMENT);
    CHECK(seen.calls == 0);
}

void suite_frame_rays(void) {
    RUN(frame_rays_against_double);
    RUN(frame_rays_any_count);
    RUN(frame_rays_of_the_caller);
    RUN(frame_rays_builders);
    RUN(frame_rays_pixel_radius);
    RUN(frame_rays_builders_refuse);
    RUN(frame_rays_bad_numbers);
    RUN(frame_rays_refuse);
}
