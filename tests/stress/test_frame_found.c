/* SPDX-License-Identifier: MIT
 *
 * Faults once found in frames, each as the smallest case that shows it: chunks without a ray,
 * regions of a caller's camera, empty skies, zones, states that were moved. Those of far and
 * enormous worlds are in test_frame_far.c. */
#include "test_frame_cases.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static frame_case self;
static spt_hit right[frame_pixels];

/* All widths, one method, one form: what frames do by themselves is the same for all. */
static int is_chosen(const stress_way *way) {
    return way->method == spt_basic() && !way->point;
}

#define FOR_EACH_WIDTH \
    stress_way way = stress_ways(STRESS_OWN_RAYS); \
    stress_next(&way);

static size_t chunks_of(uint64_t evaluations) {
    return (size_t)((evaluations + 63) / 64); /* frame.h, spt_frame_advance() */
}

/* ---- Chunks without a ray ------------------------------------------------------------------- */

enum { square = 64, square_pixels = square * square };

/* Straight ahead; nothing in the left half, which is whole chunks at full size and at half. */
static void half_camera(void *user, size_t count, const float *x, const float *y,
                        spt_camera_ray *rays) {
    (void)user;
    for (size_t i = 0; i < count; ++i) {
        rays[i].ray.origin[0] = (x[i] - 32.0f) / 20.0f;
        rays[i].ray.origin[1] = (y[i] - 32.0f) / 20.0f;
        rays[i].ray.direction[2] = 1.0f;
        rays[i].active = x[i] < 32.0f ? 0 : 1;
    }
}

typedef struct half_seen {
    size_t shaded, wrong;
} half_seen;

static void half_shade(void *user, size_t count, const float *x, const float *y,
                       const spt_ray *rays, const spt_hit *hits, float *colours) {
    half_seen *const seen = user;
    seen->shaded += count;
    for (size_t i = 0; i < count; ++i) {
        const int miss = hits[i].outcome == SPT_MISS && hits[i].t > FLT_MAX &&
                         hits[i].component == -1 && hits[i].evaluations == 0;
        seen->wrong += x[i] < 32.0f && !miss;
        seen->wrong += !check_same_bits(rays[i].origin[0], (x[i] - 32.0f) / 20.0f);
        colours[i] = x[i] + 100.0f * y[i] + (hits[i].outcome == SPT_HIT ? 0.25f : 0.0f);
    }
}

/* Pixels of all passes, of 1/4, 1/2, 3/4 and full size. */
static size_t pixels_of_passes(size_t passes) {
    const size_t side = square / 4;
    return passes == 1 ? square_pixels : side * side * (1 + 4 + 9 + 16);
}

/* Calls of one evaluation, so that each chunk's end is seen; returns how many ends were. */
static size_t advance_by_chunks(size_t passes, const half_seen *seen) {
    spt_frame_progress progress;
    size_t ends = 0, before = 0;
    memset(&progress, 0, sizeof progress);
    CHECK(spt_frame_restart(&self.frame, self.state, self.state_size) == SPT_OK);
    for (int call = 0; progress.pass < passes && call < 100000; ++call) {
        CHECK(spt_frame_advance(&self.frame, self.state, self.state_size, 1, &self.image,
                                &progress) == SPT_OK);
        CHECK(passes != 1 || progress.pixels == seen->shaded);
        CHECK(seen->shaded - before <= SPT_BATCH);
        ends += seen->shaded > before;
        before = seen->shaded;
    }
    return ends;
}

/* Where the camera has no ray for a whole chunk, its pixels are shaded as misses and counted, and
 * their results are left as they are. */
static void found_chunks_without_a_ray(void) {
    for (FOR_EACH_WIDTH) {
        for (size_t passes = 1; is_chosen(&way) && passes <= 4; passes += 3) {
            half_seen seen = {0, 0};
            frame_base(&self, &way);
            self.camera = spt_camera_of_rays(half_camera, NULL);
            CHECK(spt_frame_init(&self.frame, &self.world.scene, &self.camera, square, square) ==
                  SPT_OK);
            self.frame.settings.max_lanes = way.lanes;
            self.frame.passes = spt_passes(passes);
            self.frame.pass_count = passes;
            self.frame.shade = half_shade;
            self.frame.shade_user = &seen;
            self.frame.channels = 1;
            frame_memory(&self);
            memset(self.state, 0x42, self.state_size);
            const size_t ends = advance_by_chunks(passes, &seen);
            CHECK_SAY(seen.shaded == pixels_of_passes(passes), "%u shaded", (unsigned)seen.shaded);
            CHECK_SAY(ends == pixels_of_passes(passes) / SPT_BATCH, "%u ends", (unsigned)ends);
            CHECK(seen.wrong == 0);
            self.picture.stride = sizeof *self.colours;
            CHECK(spt_frame_picture(&self.frame, self.state, self.state_size, &self.picture) ==
                  SPT_OK);
            for (size_t i = 0; i < square_pixels; ++i) {
                const size_t x = i % square, y = i / square;
                const float place = (float)x + 0.5f + 100.0f * ((float)y + 0.5f);
                const int32_t left = (int32_t)0xa5a5a5a5u;
                const int hit = x >= 32 && self.hits[i].outcome == SPT_HIT;
                CHECK(check_same_bits(self.colours[i], place + (hit ? 0.25f : 0.0f)));
                CHECK((self.hits[i].outcome == left) == (x < 32));
            }
        }
    }
}

/* ---- Regions of a caller's camera ------------------------------------------------------------ */

typedef struct watched_camera {
    spt_camera camera;
    size_t points, outside;
} watched_camera;

static void watched_rays(void *user, size_t count, const float *x, const float *y,
                         spt_camera_ray *rays) {
    watched_camera *const watched = user;
    watched->points += count;
    for (size_t i = 0; i < count; ++i) {
        const int within = x[i] >= 0.0f && x[i] <= (float)frame_width && y[i] >= 0.0f &&
                           y[i] <= (float)frame_height;
        watched->outside += !within;
    }
    CHECK(spt_camera_rays(&watched->camera, frame_width, frame_height, count, x, y, rays) ==
          SPT_OK);
}

static void trace_or_advance(int progressively) {
    frame_memory(&self);
    memset(self.hits, 0xa5, sizeof self.hits);
    if (progressively) {
        frame_advance_whole(&self, 5000);
    } else {
        frame_trace_whole(&self);
    }
}

/* A region holds the bits of the whole, wherever it cuts the blocks that share a cone. */
static void found_regions_of_a_callers_camera(void) {
    static const uint32_t regions[][4] = {
        {21, 10, 62, 67}, {1, 3, 6, 70}, {47, 63, 50, 65}, {79, 0, 80, 1}};
    for (FOR_EACH_WIDTH) {
        for (int progressively = 0; is_chosen(&way) && progressively < 2; ++progressively) {
            watched_camera watched;
            frame_base(&self, &way);
            watched.camera = self.camera;
            watched.points = watched.outside = 0;
            self.camera = spt_camera_of_rays(watched_rays, &watched);
            trace_or_advance(progressively);
            memcpy(right, self.hits, sizeof right);
            for (size_t k = 0; k < sizeof regions / sizeof *regions; ++k) {
                const uint32_t *const region = regions[k];
                const uint32_t width = region[2] - region[0];
                size_t differ = 0;
                self.frame.left = region[0];
                self.frame.top = region[1];
                self.frame.right = region[2];
                self.frame.bottom = region[3];
                trace_or_advance(progressively);
                for (uint32_t y = region[1]; y < region[3]; ++y) {
                    differ += frame_differing(&self.hits[(y - region[1]) * width],
                                              &right[y * frame_width + region[0]], width);
                }
                CHECK_SAY(differ == 0, "region %u, progressively %d: %u pixels differ", (unsigned)k,
                          progressively, (unsigned)differ);
            }
            CHECK(watched.points > 0 && watched.outside == 0);
        }
    }
}

/* ---- Empty skies ----------------------------------------------------------------------------- */

/* One body, behind the camera and bounded: all of it is culled. */
static void sky_base(const stress_way *way) {
    static const stress_sphere behind = {{0.0f, 0.0f, -100.0f}, 1.0f};
    frame_base(&self, way);
    self.world.parts[0].data = &behind;
    self.world.bounds[0] = spt_bound_sphere(0.0f, 0.0f, -100.0f, 1.0f);
    self.world.scene.count = 1;
    self.frame.passes = NULL;
    frame_memory(&self);
}

static void expect_sky(void) {
    for (size_t i = 0; i < frame_pixels; ++i) {
        const spt_hit *const hit = &self.hits[i];
        CHECK(hit->outcome == SPT_MISS && hit->t > FLT_MAX && hit->evaluations == 0);
    }
    CHECK(self.shaded == frame_pixels && self.world.parts[0].points == 0);
}

/* A call ends in time where there is nothing to ask, too. */
static void found_empty_skies_take_their_time(void) {
    static const uint64_t calls[] = {1, 64, 65, 640};
    for (FOR_EACH_WIDTH) {
        for (size_t k = 0; is_chosen(&way) && k < sizeof calls / sizeof *calls; ++k) {
            spt_frame_progress progress;
            uint64_t before = 0;
            sky_base(&way);
            memset(&progress, 0, sizeof progress);
            CHECK(spt_frame_restart(&self.frame, self.state, self.state_size) == SPT_OK);
            for (int call = 0; progress.pass < 1 && call < 1000; ++call) {
                CHECK(spt_frame_advance(&self.frame, self.state, self.state_size, calls[k],
                                        &self.image, &progress) == SPT_OK);
                CHECK_SAY(progress.pixels - before <= SPT_BATCH * chunks_of(calls[k]),
                          "%u pixels in a call of %u", (unsigned)(progress.pixels - before),
                          (unsigned)calls[k]);
                CHECK(progress.evaluations == 0 && progress.restarted == 0);
                before = progress.pixels;
            }
            CHECK(progress.pass == 1 && progress.pixels == frame_pixels);
            expect_sky();
        }
    }
}

static double slow_clock(void *user) {
    size_t *const looks = user;
    return 1e-3 * (double)(*looks)++;
}

/* Between two looks at the clock there is a slice of SPT_BATCH evaluations, as long as nothing is
 * known of what they cost. */
static void found_empty_skies_look_at_the_clock(void) {
    for (FOR_EACH_WIDTH) {
        if (!is_chosen(&way)) continue;
        spt_frame_progress progress;
        uint64_t before = 0;
        sky_base(&way);
        memset(&progress, 0, sizeof progress);
        CHECK(spt_frame_restart(&self.frame, self.state, self.state_size) == SPT_OK);
        for (int call = 0; progress.pass < 1 && call < 1000; ++call) {
            size_t looks = 0;
            CHECK(spt_frame_advance_for(&self.frame, self.state, self.state_size, 1.5e-3,
                                        slow_clock, &looks, &self.image, &progress) == SPT_OK);
            CHECK(looks >= 2 && looks <= 3);
            CHECK(progress.pixels - before <= SPT_BATCH * chunks_of(SPT_BATCH) * (looks - 1));
            before = progress.pixels;
        }
        CHECK(progress.pass == 1);
        expect_sky();
    }
}

/* ---- Zones ----------------------------------------------------------------------------------- */

enum { zoned_side = 24, zoned_pixels = zoned_side * zoned_side };

/* A part of the picture of a sphere across the boundary of a zone, which is about the origin. */
static void zoned_base(const stress_way *way, const float eye[3]) {
    static const spt_zone zone = {{0.0f, 0.0f, 0.0f}, 1.0f, -1};
    static const stress_sphere body = {{0.0f, 0.0f, 2.0f}, 1.5f};
    static const float target[3] = {0.0f, 0.0f, 9.0f}, up[3] = {0.0f, 1.0f, 0.0f};
    frame_base(&self, way);
    CHECK(spt_camera_pinhole(&self.camera, eye, target, up, 0.01f, frame_width, frame_height) ==
          SPT_OK);
    self.world.parts[0].data = &body;
    self.world.bounds[0] = spt_bound_sphere(0.0f, 0.0f, 2.0f, 1.5f);
    self.world.scene.count = 1;
    self.world.scene.zones = &zone;
    self.world.scene.zone_count = 1;
    self.frame.right = self.frame.bottom = zoned_side;
    frame_memory(&self);
}

/* From in the zone the way out of the body is seen, at 3.5, from before it the cut, at 3; within
 * 0.01, as rays are off the axis by 0.015 at most, and the square of that counts. */
static void expect_zoned(int before, const char *what, unsigned number) {
    size_t differ = 0;
    for (size_t i = 0; i < zoned_pixels; ++i) {
        const spt_hit *const hit = &self.hits[i];
        differ +=
            !(check_same_bits(hit->t, right[i].t) &&
              check_same_bits(hit->residual, right[i].residual) && hit->flags == right[i].flags);
        CHECK(hit->outcome == SPT_HIT && hit->component == 0);
        CHECK(hit->flags == (before ? 0u : (uint32_t)SPT_FLAG_INSIDE));
        CHECK(fabsf(hit->t - (before ? 3.0f : 3.5f)) < 0.01f);
        CHECK(!before || (hit->residual > -0.51f && hit->residual < -0.49f));
    }
    CHECK_SAY(differ == 0, "%s, number %u: %u pixels differ", what, number, (unsigned)differ);
}

/* A camera in a zone, or before it, and a body across its far side: whether the body is bounded
 * and whether cones go ahead changes nothing. */
static void found_zones_that_bodies_leave(void) {
    static const float eyes[][3] = {{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -2.0f}};
    for (stress_way way = stress_ways(STRESS_CONVEX | STRESS_OWN_RAYS); stress_next(&way);) {
        for (int before = 0; before < 2; ++before) {
            zoned_base(&way, eyes[before]);
            for (unsigned number = 0; number < 8;
                 ++number) { /* the flags, without and with bound */
                self.world.fields[0].bound = number < 4 ? NULL : &self.world.bounds[0];
                self.frame.flags = number % 4;
                memset(self.hits, 0xa5, sizeof self.hits);
                frame_trace_whole(&self);
                if (number == 0) memcpy(right, self.hits, sizeof right);
                expect_zoned(before, before ? "before" : "in", number);
            }
        }
    }
}

/* ---- States that were moved ------------------------------------------------------------------ */

/* A place that is as far beyond a multiple of 64 as another one. */
static unsigned char *placed_as(const void *place, unsigned char *room) {
    return room + (((uintptr_t)place - (uintptr_t)room) & 63u);
}

/* Goes on with the state in a copy elsewhere, the old one given back or filled anew. Returns
 * whether it began anew; if not, it still points to where it was, and is left alone. */
static int go_on_elsewhere(int release) {
    spt_frame_progress progress;
    const size_t size = self.state_size;
    unsigned char *const room = malloc(size + 64), *const old = self.state;
    CHECK(room != NULL);
    unsigned char *const moved = placed_as(old, room);
    memcpy(moved, old, size);
    CHECK(spt_frame_picture(&self.frame, moved, size, &self.picture) == SPT_BAD_ARGUMENT);
    if (release) {
        free(old);
        self.state = NULL;
    }
    CHECK(spt_frame_advance(&self.frame, moved, size, 10000, &self.image, &progress) == SPT_OK);
    const int restarted = progress.restarted == 1;
    CHECK(restarted);
    if (restarted) {
        if (!release) memset(old, 0x55, size);
        memset(self.hits, 0xa5, sizeof self.hits);
        CHECK(spt_frame_advance(&self.frame, moved, size, UINT64_MAX, &self.image, &progress) ==
              SPT_OK);
        CHECK(progress.restarted == 0 && progress.pass == 4);
        CHECK(spt_frame_picture(&self.frame, moved, size, &self.picture) == SPT_OK);
        CHECK(frame_differing(self.hits, right, frame_pixels) == 0);
        size_t touched = 0;
        for (size_t i = 0; !release && i < size; ++i) touched += old[i] != 0x55;
        CHECK_SAY(touched == 0, "%u bytes written where the state was", (unsigned)touched);
    }
    free(room);
    return restarted;
}

/* A state elsewhere is none: nobody looks at where it was, and the frame begins anew. */
static void found_states_that_were_moved(void) {
    for (FOR_EACH_WIDTH) {
        for (int release = 0; is_chosen(&way) && release < 2; ++release) {
            spt_frame_progress progress;
            frame_base(&self, &way);
            CHECK(frame_advance_whole(&self, UINT64_MAX) == 1);
            memcpy(right, self.hits, sizeof right);
            CHECK(spt_frame_restart(&self.frame, self.state, self.state_size) == SPT_OK);
            CHECK(spt_frame_advance(&self.frame, self.state, self.state_size, 10000, &self.image,
                                    &progress) == SPT_OK);
            CHECK(progress.pass < 4 && progress.evaluations > 0);
            if (!go_on_elsewhere(release)) return; /* memory given back would be used */
        }
    }
}

void suite_frame_found(void) {
    RUN(found_chunks_without_a_ray);
    RUN(found_regions_of_a_callers_camera);
    RUN(found_empty_skies_take_their_time);
    RUN(found_empty_skies_look_at_the_clock);
    RUN(found_zones_that_bodies_leave);
    RUN(found_states_that_were_moved);
    frame_free(&self);
}
