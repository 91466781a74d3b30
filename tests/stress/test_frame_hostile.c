/* SPDX-License-Identifier: MIT
 *
 * Rows A, F11 and R for frames: cameras that give anything as rays, components that answer with
 * anything, inactive pixels and depth limits. Every pixel gets a valid result within its budget and
 * none suffers from its neighbours. */
#include "test_frame_cases.h"

#include <float.h>
#include <math.h>
#include <string.h>

static frame_case self;
static spt_hit right[frame_pixels];
static spt_ray rays[frame_pixels];

#define FOR_EACH_WAY \
    stress_way way = stress_ways(STRESS_CONVEX | STRESS_ONCE | STRESS_OWN_RAYS); \
    stress_next(&way);

/* ---- Cameras --------------------------------------------------------------------------------- */

typedef enum mischief { NONE, BAD_RAYS, INACTIVE, LONG_RAYS, LATE_START, ALL_INACTIVE } mischief;

static struct {
    spt_camera behind; /* whose rays are spoilt */
    mischief what;
} odd;

/* Which pixels are spoilt: about a seventh, by place alone. */
static int spoilt(float x, float y) {
    const uint32_t hash = check_bits(x) * 2654435761u ^ check_bits(y) * 2246822519u;
    return (hash >> 16) % 7 == 0;
}

/* trace.h: SPT_BAD_RAY, in each of its ways. */
static void make_bad(spt_camera_ray *ray, uint32_t pick) {
    static const uint32_t worst[] = {0x7fc00000u, 0x7f800000u, 0xff800000u, 0xffc00001u};
    const float bad = stress_from_bits(worst[pick & 3]);
    switch (pick >> 2 & 7) {
    case 0:
        memset(ray->ray.direction, 0, sizeof ray->ray.direction);
        return;
    case 1:
    case 2:
        ray->ray.direction[pick >> 5 & 1] = bad;
        return;
    case 3:
        ray->ray.origin[pick >> 5 & 1] = bad;
        return;
    case 4:
        ray->ray.t_min = -5.0f;
        return;
    case 5:
        ray->ray.t_min = bad;
        return;
    case 6:
        ray->ray.t_max = stress_nan();
        return;
    default:
        ray->path = (pick & 32) != 0 ? bad : -1.0f;
        return;
    }
}

static void spoil(spt_camera_ray *ray, float x, float y) {
    const uint32_t pick = check_bits(x) * 40503u + check_bits(y) * 2654435761u;
    switch (odd.what) {
    case BAD_RAYS:
        make_bad(ray, pick >> 14);
        return;
    case INACTIVE:
    case ALL_INACTIVE:
        memset(&ray->ray, 0xff, sizeof ray->ray); /* NaN */
        ray->active = 0;
        return;
    case LONG_RAYS:
        for (int axis = 0; axis < 3; ++axis) ray->ray.direction[axis] *= 2.0f;
        return;
    case LATE_START:
        ray->ray.t_min = 6.5f;
        ray->path = 2.0f;
        return;
    default:
        return;
    }
}

static void odd_rays(void *user, size_t count, const float *x, const float *y,
                     spt_camera_ray *out) {
    (void)user;
    spt_camera_rays(&odd.behind, frame_width, frame_height, count, x, y, out);
    for (size_t i = 0; i < count; ++i) {
        if (odd.what == ALL_INACTIVE || spoilt(x[i], y[i])) spoil(&out[i], x[i], y[i]);
    }
}

static void prepare(const stress_way *way, mischief what, uint32_t flags) {
    frame_base(&self, way);
    odd.behind = self.camera;
    odd.what = what;
    self.camera = spt_camera_of_rays(odd_rays, NULL);
    self.frame.flags = flags;
    self.frame.settings.pixel_radius = 1e-5f; /* hardly a ray that passes by within the tolerance */
    frame_memory(&self);
}

static int pixel_is_spoilt(size_t pixel) {
    return spoilt((float)(pixel % frame_width) + 0.5f, (float)(pixel / frame_width) + 0.5f);
}

static void trace_right(const stress_way *way, uint32_t flags) {
    prepare(way, NONE, flags);
    frame_trace_whole(&self);
    memcpy(right, self.hits, sizeof right);
}

static int untouched(const spt_hit *hit) {
    spt_hit as_before;
    memset(&as_before, 0xa5, sizeof as_before);
    return stress_same_hit(hit, &as_before);
}

/* The same surface, found from another start: both t lie within the tolerance of it (6e-4
 * at most, at a slope of at least 0.01), and components 0 and 4 are the same sphere. */
static int same_surface(const spt_hit *a, const spt_hit *b) {
    const int32_t one = a->component == 4 ? 0 : a->component;
    const int32_t other = b->component == 4 ? 0 : b->component;
    if (a->outcome != b->outcome || one != other) return 0;
    return a->outcome != SPT_HIT || fabsf(a->t - b->t) <= 0.06f;
}

static void F11c_pixels_without_rays(void) {
    for (FOR_EACH_WAY) {
        trace_right(&way, SPT_FRAME_NO_CONES);
        for (int all = 0; all < 2; ++all) {
            size_t wrong = 0, calls = 0;
            prepare(&way, all ? ALL_INACTIVE : INACTIVE, SPT_FRAME_NO_CONES);
            frame_trace_whole(&self);
            for (size_t i = 0; i < frame_pixels; ++i) {
                wrong += all || pixel_is_spoilt(i) ? !untouched(&self.hits[i])
                                                   : !stress_same_hit(&self.hits[i], &right[i]);
            }
            for (int i = 0; i < union_parts; ++i) calls += self.world.parts[i].calls;
            CHECK_SAY(wrong == 0, "%u pixels are wrong", (unsigned)wrong);
            CHECK(!all || calls == 0);
            frame_advance_whole(&self, 100000);
            for (size_t i = 0; i < frame_pixels; ++i) {
                if (all || pixel_is_spoilt(i)) CHECK(untouched(&self.hits[i]));
            }
        }
    }
}

/* Of a whole union, and of one component alone, for which frames may take a shorter way. */
static void R12_rays_that_are_none(void) {
    for (FOR_EACH_WAY) {
        for (uint32_t i = 0; i < 8; ++i) {
            const uint32_t flags = i % 4;
            const size_t components = i < 4 ? union_parts : 1;
            size_t wrong = 0, others = 0;
            prepare(&way, NONE, flags);
            self.world.scene.count = components;
            frame_trace_whole(&self);
            memcpy(right, self.hits, sizeof right);
            prepare(&way, BAD_RAYS, flags);
            self.world.scene.count = components;
            frame_trace_whole(&self);
            for (size_t k = 0; k < frame_pixels; ++k) {
                const spt_hit *const hit = &self.hits[k];
                if (pixel_is_spoilt(k)) {
                    wrong += hit->outcome != SPT_BAD_RAY || hit->evaluations != 0;
                } else if (flags == (SPT_FRAME_NO_CONES | SPT_FRAME_NO_CULLING)) {
                    others += !stress_same_hit(hit, &right[k]);
                } else if (flags == SPT_FRAME_NO_CONES) { /* what is left out is another thing */
                    others += hit->outcome != right[k].outcome ||
                              hit->component != right[k].component ||
                              !check_same_bits(hit->t, right[k].t) ||
                              !check_same_bits(hit->residual, right[k].residual);
                } else { /* cones are those of a bundle: other starts, the same surface */
                    others += !same_surface(hit, &right[k]);
                }
            }
            CHECK_SAY(wrong == 0 && others == 0, "%u components, flags %u: %u bad rays, %u others",
                      (unsigned)components, flags, (unsigned)wrong, (unsigned)others);
        }
    }
}

/* A ray that is not of length 1 goes without cones; its t is in its own unit. */
static void R13_rays_of_other_lengths(void) {
    for (FOR_EACH_WAY) {
        prepare(&way, LONG_RAYS, SPT_FRAME_NO_CONES);
        frame_trace_whole(&self);
        memcpy(right, self.hits, sizeof right);
        prepare(&way, LONG_RAYS, 0);
        frame_trace_whole(&self);
        size_t wrong = 0, other = 0;
        for (size_t i = 0; i < frame_pixels; ++i) {
            if (pixel_is_spoilt(i)) {
                wrong += !check_same_bits(self.hits[i].t, right[i].t) ||
                         self.hits[i].evaluations > right[i].evaluations;
            } else {
                other += !same_surface(&self.hits[i], &right[i]);
            }
        }
        CHECK_SAY(wrong == 0 && other == 0, "%u long rays, %u others", (unsigned)wrong,
                  (unsigned)other);
    }
}

/* Some rays start behind what the others see. */
static void R14_rays_that_start_late(void) {
    for (FOR_EACH_WAY) {
        for (uint32_t flags = 0; flags < 4; flags += SPT_FRAME_NO_CULLING) {
            prepare(&way, LATE_START, flags | SPT_FRAME_NO_CONES);
            frame_trace_whole(&self);
            memcpy(right, self.hits, sizeof right);
            prepare(&way, LATE_START, flags);
            frame_trace_whole(&self);
            size_t wrong = 0;
            for (size_t i = 0; i < frame_pixels; ++i) {
                wrong += !same_surface(&self.hits[i], &right[i]);
                CHECK(!pixel_is_spoilt(i) || self.hits[i].t >= 6.5f);
            }
            CHECK_SAY(wrong == 0, "%u pixels differ", (unsigned)wrong);
        }
    }
}

/* ---- Components ------------------------------------------------------------------------------ */

static float nan_behind(const void *data, float x, float y, float z) {
    (void)data, (void)x, (void)y;
    return z > 7.5f ? stress_nan() : 8.0f - z;
}
static float minus_infinity_inside(const void *data, float x, float y, float z) {
    const float distance = stress_sphere_distance(data, x, y, z);
    return distance < 0.05f ? -stress_infinity() : distance;
}
static float plus_infinity(const void *data, float x, float y, float z) {
    (void)data, (void)x, (void)y, (void)z;
    return stress_infinity();
}
static float not_a_number(const void *data, float x, float y, float z) {
    (void)data, (void)x, (void)y, (void)z;
    return stress_nan();
}
static float jump(const void *data, float x, float y, float z) {
    (void)data;
    return z + 0.1f * x < 6.5f + y ? 0.5f : -0.5f;
}
static float noise(const void *data, float x, float y, float z) {
    uint32_t hash = check_bits(x) * 2654435761u ^ check_bits(y) * 40503u ^ check_bits(z);
    (void)data;
    hash = (hash ^ hash >> 15) * 2246822519u;
    return stress_from_bits(hash ^ hash >> 13);
}
static float creep(const void *data, float x, float y, float z) {
    (void)data;
    return 0.02f + 0.005f * sinf(40.0f * z + x - y);
}
static float zero(const void *data, float x, float y, float z) {
    (void)data, (void)x, (void)y, (void)z;
    return 0.0f;
}

static stress_distance_fn *const hostile[] = {
    nan_behind, minus_infinity_inside, plus_infinity, not_a_number, jump, noise, creep, zero};
enum { hostile_count = sizeof hostile / sizeof *hostile };

static void camera_rays(void) {
    for (size_t i = 0; i < frame_pixels; ++i) {
        const float x = (float)(i % frame_width) + 0.5f, y = (float)(i / frame_width) + 0.5f;
        spt_camera_ray ray;
        CHECK(spt_camera_rays(&self.camera, frame_width, frame_height, 1, &x, &y, &ray) == SPT_OK);
        rays[i] = ray.ray;
    }
}

/* calls == evaluations, cones apart. */
static void check_counts(const spt_statistics *statistics) {
    uint64_t points = 0, faults = 0, evaluations = 0, outcomes[SPT_OUTCOMES] = {0, 0, 0, 0, 0};
    for (size_t i = 0; i < frame_pixels; ++i) {
        evaluations += self.hits[i].evaluations;
        ++outcomes[(uint32_t)self.hits[i].outcome % SPT_OUTCOMES];
    }
    for (int i = 0; i < union_parts; ++i) {
        points += self.world.parts[i].points;
        faults += self.world.parts[i].faults;
    }
    CHECK(faults == 0);
    CHECK(statistics->rays == frame_pixels && statistics->evaluations == evaluations);
    CHECK(memcmp(statistics->outcomes, outcomes, sizeof outcomes) == 0);
    CHECK_SAY(points >= statistics->slots + statistics->cone_evaluations, "%u points",
              (unsigned)points);
}

static void A1e_frames_of_hostile_components(void) {
    static const stress_sphere in_the_way = {{0.3f, -0.3f, 5.0f}, 0.8f};
    for (FOR_EACH_WAY) {
        if (way.method == spt_convex()) continue; /* none of these is convex */
        for (int i = 0; i < 2 * hostile_count; ++i) {
            spt_statistics statistics = spt_statistics_default();
            frame_base(&self, &way);
            self.world.parts[4] = union_part_of(hostile[i / 2], &in_the_way);
            self.frame.flags = (uint32_t)(2 * (i % 2) + (i / 2 + way.index) % 2);
            self.frame.statistics = &statistics;
            self.frame.settings.budget = 60;
            frame_trace_whole(&self);
            camera_rays();
            union_check_hits(&self.world.scene, self.world.parts, &self.frame.settings,
                             frame_pixels, rays, self.hits);
            check_counts(&statistics);
            memset(self.hits, 0xa5, sizeof self.hits);
            frame_advance_whole(&self, 20000);
            for (size_t k = 0; k < frame_pixels; ++k) CHECK(self.hits[k].evaluations <= 60);
        }
    }
}

/* ---- Depth limits ---------------------------------------------------------------------------- */

/* NaN, negative and huge limits stop the pixel they belong to, and no other. */
static void R15_depth_limits(void) {
    static float t_max[frame_pixels];
    const float odd_limits[] = {stress_nan(), -1.0f, 0.0f, -stress_infinity(), 1e-30f};
    for (FOR_EACH_WAY) {
        for (uint32_t flags = 0; flags < 4; ++flags) {
            frame_base(&self, &way);
            self.frame.flags = flags;
            frame_trace_whole(&self);
            memcpy(right, self.hits, sizeof right);
            for (size_t i = 0; i < frame_pixels; ++i) {
                t_max[i] = i % 2 != 0 ? stress_infinity() : FLT_MAX;
                if (pixel_is_spoilt(i)) t_max[i] = odd_limits[i % 5];
            }
            self.frame.t_max.first = t_max;
            self.frame.t_max.stride = sizeof *t_max;
            frame_trace_whole(&self);
            size_t wrong = 0, others = 0;
            for (size_t i = 0; i < frame_pixels; ++i) {
                if (!pixel_is_spoilt(i)) {
                    others += !stress_same_hit(&self.hits[i], &right[i]);
                } else if (stress_is_nan(t_max[i])) {
                    wrong += self.hits[i].outcome != SPT_BAD_RAY;
                } else {
                    wrong += self.hits[i].outcome != SPT_MISS;
                }
            }
            CHECK_SAY(wrong == 0 && others == 0, "flags %u: %u limited, %u others", flags,
                      (unsigned)wrong, (unsigned)others);
        }
    }
}

void suite_frame_hostile(void) {
    RUN(F11c_pixels_without_rays);
    RUN(R12_rays_that_are_none);
    RUN(R13_rays_of_other_lengths);
    RUN(R14_rays_that_start_late);
    RUN(A1e_frames_of_hostile_components);
    RUN(R15_depth_limits);
    frame_free(&self);
}
