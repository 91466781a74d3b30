/* SPDX-License-Identifier: MIT
 *
 * Row F10 for the functions that make cameras and frames, and rows F7 and R for the rays that a
 * camera gives: any count between guard pages, and only rays that can be traced. Where the rays
 * should point is asked of the oracle tests. */
#include "test_frame_cases.h"
#include "stress_guard.h"

#include <float.h>
#include <math.h>
#include <string.h>

static const float eye[3] = {1.0f, 2.0f, 3.0f}, target[3] = {0.0f, 0.5f, 9.0f},
                   up[3] = {0.0f, 1.0f, 0.0f};

typedef spt_status camera_maker(spt_camera *, const float *, const float *, const float *, float,
                                uint32_t, uint32_t);

static spt_status pinhole(spt_camera *camera, const float *from, const float *to,
                          const float *upward, float tangent, uint32_t width, uint32_t height) {
    return spt_camera_pinhole(camera, from, to, upward, tangent, width, height);
}

static spt_status orthographic(spt_camera *camera, const float *from, const float *to,
                               const float *upward, float half_width, uint32_t width,
                               uint32_t height) {
    return spt_camera_orthographic(camera, from, to, upward, half_width, width, height);
}

static camera_maker *const makers[] = {pinhole, orthographic};
enum { maker_count = 2 };

static void refuse(camera_maker *make, const float *from, const float *to, const float *upward,
                   float opening, uint32_t width, uint32_t height, const char *why) {
    spt_camera camera, before;
    memset(&camera, 0x5a, sizeof camera);
    memset(&before, 0x5a, sizeof before);
    CHECK_SAY(make(&camera, from, to, upward, opening, width, height) == SPT_BAD_ARGUMENT, "%s",
              why);
    CHECK_SAY(memcmp(&camera, &before, sizeof camera) == 0, "%s: written", why);
}

static void F10u_camera_makers(void) {
    const float infinity = stress_infinity(), bad[] = {stress_nan(), infinity, -infinity};
    const float openings[] = {0.0f, -0.0f, -1.0f, stress_nan(), infinity, -infinity};
    for (int i = 0; i < maker_count; ++i) {
        camera_maker *const make = makers[i];
        spt_camera camera;
        check_context("%s", i == 0 ? "pinhole" : "orthographic");
        CHECK(make(&camera, eye, target, up, 0.5f, 40, 30) == SPT_OK);
        CHECK(camera.struct_size == sizeof camera && camera.kind == (uint32_t)(1 + i));
        CHECK(check_same_bits(camera.t_min, 0.0f) && check_same_bits(camera.t_max, infinity));
        CHECK(make(NULL, eye, target, up, 0.5f, 40, 30) == SPT_BAD_ARGUMENT);
        refuse(make, NULL, target, up, 0.5f, 40, 30, "eye NULL");
        refuse(make, eye, NULL, up, 0.5f, 40, 30, "target NULL");
        refuse(make, eye, target, NULL, 0.5f, 40, 30, "up NULL");
        refuse(make, eye, target, up, 0.5f, 0, 30, "width 0");
        refuse(make, eye, target, up, 0.5f, 40, 0, "height 0");
        for (int k = 0; k < 6; ++k) refuse(make, eye, target, up, openings[k], 40, 30, "opening");
        refuse(make, eye, eye, up, 0.5f, 40, 30, "target is eye");
        for (int k = 0; k < 9; ++k) {
            float vector[3];
            memcpy(vector, eye, sizeof vector);
            vector[k / 3] = bad[k % 3];
            refuse(make, vector, target, up, 0.5f, 40, 30, "eye not finite");
            memcpy(vector, target, sizeof vector);
            vector[k / 3] = bad[k % 3];
            refuse(make, eye, vector, up, 0.5f, 40, 30, "target not finite");
            memcpy(vector, up, sizeof vector);
            vector[k / 3] = bad[k % 3];
            refuse(make, eye, target, vector, 0.5f, 40, 30, "up not finite");
        }
        static const float zero[3] = {0.0f, 0.0f, 0.0f}, ahead[3] = {1.0f, 2.0f, 7.0f};
        static const float along[3] = {0.0f, 0.0f, 2.0f}, back[3] = {0.0f, 0.0f, -1e-3f};
        refuse(make, eye, ahead, zero, 0.5f, 40, 30, "up zero");
        refuse(make, eye, ahead, along, 0.5f, 40, 30, "up along the line of sight");
        refuse(make, eye, ahead, back, 0.5f, 40, 30, "up against the line of sight");
    }
    check_context("%s", "");
}

/* Very large and very small numbers either span a picture or are refused; what is accepted gives
 * rays that can be traced. */
static void F10v_camera_makers_at_the_limits(void) {
    static const float sizes[] = {1e-38f, 1e-30f, 1e-10f, 1e10f, 1e18f, 1e30f, 3e38f};
    size_t accepted = 0;
    for (int i = 0; i < maker_count * 7 * 7; ++i) {
        const float far = sizes[i / 2 % 7], tall = sizes[i / 14 % 7];
        const float from[3] = {0.0f, 0.0f, 0.0f}, to[3] = {0.3f * far, 0.0f, far};
        const float upward[3] = {0.0f, tall, 0.1f * tall};
        const float x = 20.0f, y = 15.0f;
        spt_camera camera;
        spt_camera_ray ray;
        if (makers[i % 2](&camera, from, to, upward, 0.5f, 40, 30) != SPT_OK) continue;
        ++accepted;
        CHECK(spt_camera_rays(&camera, 40, 30, 1, &x, &y, &ray) == SPT_OK);
        const double length = stress_length(ray.ray.direction);
        CHECK_SAY(stress_within(length, 1.0, 1e-5), "size %g, up %g: length %.9g", (double)far,
                  (double)tall, length);
        CHECK(ray.active != 0);
    }
    CHECK_SAY(accepted > 60, "%u accepted", (unsigned)accepted);
}

/* ---- Frames ---------------------------------------------------------------------------------- */

static void refuse_frame(const spt_scene *scene, const spt_camera *camera, uint32_t width,
                         uint32_t height, const char *why) {
    spt_frame frame, before;
    memset(&frame, 0x5a, sizeof frame);
    memset(&before, 0x5a, sizeof before);
    CHECK_SAY(spt_frame_init(&frame, scene, camera, width, height) == SPT_BAD_ARGUMENT, "%s", why);
    CHECK_SAY(memcmp(&frame, &before, sizeof frame) == 0, "%s: written", why);
}

static void F10w_frame_init(void) {
    const uint32_t most = 1u << 22;
    static union_scene world;
    for (stress_way way = stress_ways(STRESS_CONVEX | STRESS_ONCE); stress_next(&way);) {
        spt_camera camera, bad;
        spt_frame frame;
        union_base(&world, &way);
        CHECK(spt_camera_pinhole(&camera, eye, target, up, 0.5f, 40, 30) == SPT_OK);
        CHECK(spt_frame_init(NULL, &world.scene, &camera, 40, 30) == SPT_BAD_ARGUMENT);
        refuse_frame(NULL, &camera, 40, 30, "scene NULL");
        refuse_frame(&world.scene, NULL, 40, 30, "camera NULL");
        refuse_frame(&world.scene, &camera, 0, 30, "width 0");
        refuse_frame(&world.scene, &camera, 40, 0, "height 0");
        refuse_frame(&world.scene, &camera, most + 1, 30, "width");
        refuse_frame(&world.scene, &camera, 40, most + 1, "height");
        refuse_frame(&world.scene, &camera, UINT32_MAX, UINT32_MAX, "both");
        bad = camera;
        bad.struct_size = 0;
        refuse_frame(&world.scene, &bad, 40, 30, "struct_size");
        bad = camera;
        bad.kind = 9;
        refuse_frame(&world.scene, &bad, 40, 30, "kind");
        bad = camera;
        bad.up[1] = stress_nan();
        refuse_frame(&world.scene, &bad, 40, 30, "up");
        bad = spt_camera_of_rays(NULL, NULL);
        refuse_frame(&world.scene, &bad, 40, 30, "no callback");
        memset(&frame, 0x5a, sizeof frame);
        CHECK(spt_frame_init(&frame, &world.scene, &camera, most, most) == SPT_OK);
        CHECK(frame.struct_size == sizeof frame && frame.width == most && frame.right == most);
        CHECK(frame.left == 0 && frame.top == 0 && frame.bottom == most && frame.flags == 0);
        CHECK(frame.passes == NULL && frame.shade == NULL && frame.workspace == NULL);
        CHECK(frame.progress == NULL && frame.statistics == NULL && frame.t_max.first == NULL);
        CHECK(spt_frame_tiles(&frame) == ((size_t)1 << 16) * ((size_t)1 << 16));
    }
}

static void F10x_schedules(void) {
    for (size_t count = 0; count < 20; ++count) {
        const spt_pass *const passes = spt_passes(count);
        const int there = count == 1 || count == 2 || count == 4 || count == 6;
        CHECK((passes != NULL) == there);
        double shares = 0.0;
        for (size_t i = 0; there && i < count; ++i) {
            CHECK(passes[i].numerator >= 1 && passes[i].numerator <= passes[i].denominator);
            CHECK(passes[i].share > 0.0f && passes[i].share <= 1.0f);
            shares += (double)passes[i].share;
        }
        if (!there) continue;
        CHECK(passes[count - 1].numerator == passes[count - 1].denominator);
        CHECK(stress_within(shares, 1.0, 1e-6));
    }
    CHECK(spt_passes(SIZE_MAX) == NULL);
}

/* ---- Rays ------------------------------------------------------------------------------------ */

static void F10y_camera_rays(void) {
    const float x[2] = {0.5f, 1.5f}, y[2] = {0.5f, 0.5f};
    spt_camera camera, bad;
    spt_camera_ray rays[2], before[2];
    CHECK(spt_camera_pinhole(&camera, eye, target, up, 0.5f, 40, 30) == SPT_OK);
    memset(rays, 0x5a, sizeof rays);
    memset(before, 0x5a, sizeof before);
    bad = camera;
    bad.forward[0] = stress_nan();
    CHECK(spt_camera_rays(NULL, 40, 30, 2, x, y, rays) == SPT_BAD_ARGUMENT);
    CHECK(spt_camera_rays(&bad, 40, 30, 2, x, y, rays) == SPT_BAD_ARGUMENT);
    CHECK(spt_camera_rays(&camera, 0, 30, 2, x, y, rays) == SPT_BAD_ARGUMENT);
    CHECK(spt_camera_rays(&camera, 40, 0, 2, x, y, rays) == SPT_BAD_ARGUMENT);
    CHECK(spt_camera_rays(&camera, 40, 30, 2, NULL, y, rays) == SPT_BAD_ARGUMENT);
    CHECK(spt_camera_rays(&camera, 40, 30, 2, x, NULL, rays) == SPT_BAD_ARGUMENT);
    CHECK(spt_camera_rays(&camera, 40, 30, 2, x, y, NULL) == SPT_BAD_ARGUMENT);
    CHECK(spt_camera_rays(&camera, 40, 30, 0, x, y, rays) == SPT_OK);
    CHECK(memcmp(rays, before, sizeof rays) == 0);
}

enum { most_rays = 600 };

static void constant_rays(void *user, size_t count, const float *x, const float *y,
                          spt_camera_ray *rays) {
    size_t *const wrong = user;
    *wrong += count == 0 || count > SPT_BATCH;
    for (size_t i = 0; i < count; ++i) {
        *wrong += !check_same_bits(rays[i].ray.t_min, 0.0f) || rays[i].active == 0 ||
                  !check_same_bits(rays[i].ray.t_max, stress_infinity()) ||
                  !check_same_bits(rays[i].path, 0.0f);
        rays[i].ray.origin[0] = x[i];
        rays[i].ray.origin[1] = y[i];
        rays[i].ray.origin[2] = 0.0f;
        memset(rays[i].ray.direction, 0, sizeof rays[i].ray.direction);
        rays[i].ray.direction[2] = 1.0f;
    }
}

/* Any count has the bits of one at a time, and nothing outside is read or written. */
static void F7d_camera_rays_between_guard_pages(void) {
    static const size_t counts[] = {0, 1, 3, 4, 5, 15, 16, 17, 255, 256, 257, most_rays};
    static spt_camera_ray right[most_rays];
    stress_guard guard[3];
    int made = 1;
    size_t wrong = 0;
    spt_camera cameras[3];
    for (int i = 0; i < 3; ++i) made &= stress_guard_make(&guard[i], most_rays * sizeof *right);
    if (!made) {
        check_skip("F7d: no guard pages here");
        return;
    }
    CHECK(spt_camera_pinhole(&cameras[0], eye, target, up, 0.5f, 40, 30) == SPT_OK);
    CHECK(spt_camera_orthographic(&cameras[1], eye, target, up, 0.5f, 40, 30) == SPT_OK);
    cameras[2] = spt_camera_of_rays(constant_rays, &wrong);
    for (int i = 0; i < 3; ++i) {
        for (size_t k = 0; k < most_rays; ++k) {
            const float x = (float)(k % 47) - 3.0f, y = 0.37f * (float)(k / 13);
            CHECK(spt_camera_rays(&cameras[i], 40, 30, 1, &x, &y, &right[k]) == SPT_OK);
        }
        for (int k = 0; k < 12; ++k) {
            const size_t count = counts[k];
            float *const x = stress_guard_top(&guard[0], count * sizeof *x);
            float *const y = stress_guard_top(&guard[1], count * sizeof *y);
            spt_camera_ray *const rays = stress_guard_top(&guard[2], count * sizeof *rays);
            memset(guard[2].first, 0x5a, guard[2].size);
            for (size_t j = 0; j < count; ++j) {
                x[j] = (float)(j % 47) - 3.0f;
                y[j] = 0.37f * (float)(j / 13);
            }
            CHECK(spt_camera_rays(&cameras[i], 40, 30, count, x, y, rays) == SPT_OK);
            CHECK(stress_guard_is_filled(&guard[2], rays, count * sizeof *rays, 0x5a));
            CHECK_SAY(count == 0 || memcmp(rays, right, count * sizeof *rays) == 0,
                      "camera %d, %u rays", i, (unsigned)count);
        }
    }
    CHECK(wrong == 0);
    for (int i = 0; i < 3; ++i) stress_guard_free(&guard[i]);
}

void suite_frame_camera_contract(void) {
    RUN(F10u_camera_makers);
    RUN(F10v_camera_makers_at_the_limits);
    RUN(F10w_frame_init);
    RUN(F10x_schedules);
    RUN(F10y_camera_rays);
    RUN(F7d_camera_rays_between_guard_pages);
}
