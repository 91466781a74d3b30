/* SPDX-License-Identifier: MIT
 *
 * Progressive frames that are interrupted, changed, looked at and begun anew: whatever happens on
 * the way, the finished frame has the bits of one that ran through. */
#include "test_frame_cases.h"

#include <float.h>
#include <math.h>
#include <string.h>

static frame_case self;
static spt_hit right[frame_pixels];
static float right_colours[frame_pixels * frame_channels];

#define FOR_EACH_WAY \
    stress_way way = stress_ways(STRESS_CONVEX | STRESS_ONCE | STRESS_OWN_RAYS); \
    stress_next(&way);

static void take_picture(void) {
    memset(self.colours, 0xa5, sizeof self.colours);
    CHECK(spt_frame_picture(&self.frame, self.state, self.state_size, &self.picture) == SPT_OK);
}

static size_t colours_differing(void) {
    size_t differ = 0;
    for (size_t i = 0; i < frame_pixels * frame_channels; ++i) {
        differ += !check_same_bits(self.colours[i], right_colours[i]);
    }
    return differ;
}

/* What an uninterrupted run gives. */
static void run_through(void) {
    memset(self.hits, 0xa5, sizeof self.hits);
    CHECK(frame_advance_whole(&self, UINT64_MAX) == 1);
    take_picture();
    memcpy(right, self.hits, sizeof right);
    memcpy(right_colours, self.colours, sizeof right_colours);
}

static void expect_right(const char *what, unsigned number) {
    CHECK_SAY(frame_differing(self.hits, right, frame_pixels) == 0, "%s %u: %u pixels differ", what,
              number, (unsigned)frame_differing(self.hits, right, frame_pixels));
    take_picture();
    CHECK_SAY(colours_differing() == 0, "%s %u: %u colours differ", what, number,
              (unsigned)colours_differing());
}

/* ---- Interruptions --------------------------------------------------------------------------- */

/* One run in calls of a budget, or of any budgets; how the calls count is checked. */
static void run_in_pieces(uint64_t budget) {
    enum { most_calls = 2000000 };
    spt_frame_progress last, now;
    spt_statistics *const before = self.frame.statistics;
    memset(&last, 0, sizeof last);
    memset(self.hits, 0xa5, sizeof self.hits);
    CHECK(spt_frame_restart(&self.frame, self.state, self.state_size) == SPT_OK);
    for (int i = 0; last.pass < self.frame.pass_count && i < most_calls; ++i) {
        const uint64_t most = budget != 0 ? budget : 1 + check_random() % 5000;
        spt_statistics statistics = spt_statistics_default();
        self.frame.statistics = &statistics;
        CHECK(spt_frame_advance(&self.frame, self.state, self.state_size, most, &self.image,
                                &now) == SPT_OK);
        const uint64_t spent = statistics.evaluations + statistics.cone_evaluations;
        const uint64_t told = now.evaluations - last.evaluations;
        CHECK_SAY(told == spent, "told of %lu, spent %lu", (unsigned long)told,
                  (unsigned long)spent);
        CHECK(now.restarted == 0 && now.pass >= last.pass && now.evaluations >= last.evaluations);
        CHECK(now.pass > last.pass || now.pixels >= last.pixels);
        CHECK(now.pixels <= now.pixel_count);
        CHECK_SAY(spent < most + SPT_BATCH, "%lu for %lu", (unsigned long)spent,
                  (unsigned long)most);
        /* A chunk that is finished counts as 64, whatever it asked. */
        CHECK_SAY(spent >= most || now.pass > last.pass ||
                      spent + 64 * (now.pixels - last.pixels) >= most,
                  "%lu for %lu", (unsigned long)spent, (unsigned long)most);
        last = now;
    }
    self.frame.statistics = before;
    CHECK(last.pass == self.frame.pass_count);
}

static void resume_after_any_interruption(void) {
    static const uint64_t budgets[] = {1, 17, 256, 999, 20000, UINT64_MAX / 2, 0};
    for (FOR_EACH_WAY) {
        frame_base(&self, &way);
        run_through();
        for (int i = 0; i < 7; ++i) {
            if (budgets[i] == 1 && way.method != spt_adaptive()) continue;
            memset(self.workspace, 0x80 + i, self.workspace_size);
            run_in_pieces(budgets[i]);
            expect_right("budget", (unsigned)budgets[i]);
        }
    }
}

/* The same with every schedule, without cones and culling, and without colours. */
static void resume_with_every_schedule(void) {
    static const size_t schedules[] = {1, 2, 4, 6};
    for (FOR_EACH_WAY) {
        for (uint32_t i = 0; i < 8; ++i) {
            frame_base(&self, &way);
            self.frame.passes = spt_passes(schedules[i % 4]);
            self.frame.pass_count = schedules[i % 4];
            self.frame.flags = i % 4;
            frame_memory(&self);
            run_through();
            run_in_pieces(3000);
            expect_right("schedule", (unsigned)schedules[i % 4]);
            self.frame.shade = NULL;
            frame_memory(&self);
            run_in_pieces(3000);
            CHECK(frame_differing(self.hits, right, frame_pixels) == 0);
        }
    }
}

/* Each call may come with another workspace and other statistics; nothing is kept there. */
static void resume_with_another_workspace(void) {
    for (FOR_EACH_WAY) {
        spt_frame_progress progress;
        uint64_t evaluations = 0, rays = 0;
        frame_base(&self, &way);
        run_through();
        memset(self.hits, 0xa5, sizeof self.hits);
        memset(&progress, 0, sizeof progress);
        CHECK(spt_frame_restart(&self.frame, self.state, self.state_size) == SPT_OK);
        for (int i = 0; progress.pass < 4 && i < 100000; ++i) {
            spt_statistics statistics = spt_statistics_default();
            memset(self.workspace, i & 255, self.workspace_size);
            self.frame.statistics = i % 3 != 0 ? &statistics : NULL;
            const uint64_t before = progress.evaluations;
            CHECK(spt_frame_advance(&self.frame, self.state, self.state_size, 7777, &self.image,
                                    &progress) == SPT_OK);
            CHECK(progress.restarted == 0);
            evaluations = statistics.evaluations + statistics.cone_evaluations;
            rays += statistics.rays;
            CHECK(i % 3 == 0 || evaluations == progress.evaluations - before);
        }
        CHECK(rays > 0 && rays < 2 * frame_pixels);
        self.frame.statistics = NULL;
        expect_right("workspace", 0);
    }
}

/* ---- What changes on the way ----------------------------------------------------------------- */

typedef void change_fn(void);

static void change_camera(void) {
    self.camera.eye[0] += 0.25f;
}
static void change_t_max(void) {
    self.camera.t_max = 9.5f;
}
static void change_epsilon(void) {
    self.frame.settings.epsilon = 1e-2f;
}
static void change_method(void) {
    self.frame.settings.method = spt_relaxed();
}
static void change_passes(void) {
    static const spt_pass others[] = {{1, 4, 0.125f}, {1, 2, 0.125f}, {2, 3, 0.125f}, {1, 1, 0.5f}};
    self.frame.passes = others;
}
static void change_flags(void) {
    self.frame.flags ^= SPT_FRAME_NO_CONES;
}
static void change_budget(void) {
    self.frame.settings.budget = 40;
}
static void change_region(void) {
    self.frame.left = 3;
    self.frame.right -= 2;
}
static void change_scene_pointer(void) {
    static spt_scene other;
    other = self.world.scene;
    other.count -= 2;
    self.frame.scene = &other;
}

static void other_shade(void *user, size_t count, const float *x, const float *y,
                        const spt_ray *rays, const spt_hit *hits, float *colours) {
    (void)user, (void)y, (void)rays, (void)hits;
    for (size_t i = 0; i < count * frame_channels; ++i) colours[i] = x[0] > 9.0f ? 0.25f : 0.5f;
}
static void change_shade(void) {
    self.frame.shade = other_shade;
}
static void change_shade_user(void) {
    static frame_case other;
    other.frame = self.frame;
    self.frame.shade_user = &other;
}
static void change_channels(void) {
    self.frame.channels = 2;
}
static void change_t_max_column(void) {
    static const float limit = 12.0f;
    self.frame.t_max.first = &limit;
}
static void change_zones(void) {
    static const spt_zone zone = {{0.0f, 0.0f, 4.0f}, 0.5f, -1};
    self.world.scene.zones = &zone;
    self.world.scene.zone_count = 1;
}

static change_fn *const changes[] = {
    change_shade,  change_shade_user, change_channels, change_t_max_column, change_zones,
    change_camera, change_t_max,      change_epsilon,  change_method,       change_passes,
    change_flags,  change_budget,     change_region,   change_scene_pointer};
enum { change_count = sizeof changes / sizeof *changes };

/* The frame begins anew by itself, once, and ends as the changed frame does. */
static void resume_begins_anew_when_the_frame_changes(void) {
    for (FOR_EACH_WAY) {
        if (way.method == spt_relaxed()) continue;
        for (int i = 0; i < change_count; ++i) {
            if (way.method == spt_convex() && changes[i] == change_method) continue;
            spt_frame_progress progress;
            frame_base(&self, &way);
            CHECK(spt_frame_restart(&self.frame, self.state, self.state_size) == SPT_OK);
            for (int call = 0; call < 3; ++call) {
                CHECK(spt_frame_advance(&self.frame, self.state, self.state_size, 4000, &self.image,
                                        &progress) == SPT_OK);
                CHECK(progress.restarted == 0);
            }
            changes[i]();
            CHECK(spt_frame_picture(&self.frame, self.state, self.state_size, &self.picture) ==
                  SPT_BAD_ARGUMENT); /* of another frame */
            for (int call = 0; call < 100000; ++call) {
                CHECK(spt_frame_advance(&self.frame, self.state, self.state_size, 4000, &self.image,
                                        &progress) == SPT_OK);
                CHECK_SAY(progress.restarted == (call == 0), "change %d, call %d: restarted %u", i,
                          call, (unsigned)progress.restarted);
                if (progress.pass == self.frame.pass_count) break;
            }
            memcpy(right, self.hits, sizeof right);
            take_picture();
            memcpy(right_colours, self.colours, sizeof right_colours);
            memset(self.hits, 0xa5, sizeof self.hits);
            frame_advance_whole(&self, UINT64_MAX);
            expect_right("change", (unsigned)i);
        }
    }
}

/* A scene that answers differently does not show in the frame: restart says it. */
static void resume_restarts_when_told(void) {
    static const stress_sphere moved = {{0.4f, 0.1f, 9.0f}, 1.0f};
    for (FOR_EACH_WAY) {
        spt_frame_progress progress;
        frame_base(&self, &way);
        self.world.bounds[0].radius = 4.0f;
        self.world.parts[0].data = self.world.parts[4].data = &moved;
        run_through();
        frame_base(&self, &way);
        self.world.bounds[0].radius = 4.0f;
        CHECK(spt_frame_restart(&self.frame, self.state, self.state_size) == SPT_OK);
        CHECK(spt_frame_advance(&self.frame, self.state, self.state_size, 9000, &self.image,
                                &progress) == SPT_OK);
        self.world.parts[0].data = self.world.parts[4].data = &moved;
        CHECK(spt_frame_advance(&self.frame, self.state, self.state_size, 10, &self.image,
                                &progress) == SPT_OK);
        CHECK(progress.restarted == 0);
        run_in_pieces(9000);
        expect_right("restart", 0);
    }
}

/* ---- Looking at it --------------------------------------------------------------------------- */

/* Pictures at any moment: everything is there, nothing moves, nobody is called; black first, the
 * colours of the hits last. */
static void resume_pictures_on_the_way(void) {
    for (FOR_EACH_WAY) {
        frame_base(&self, &way);
        run_through();
        CHECK(spt_frame_restart(&self.frame, self.state, self.state_size) == SPT_OK);
        take_picture();
        for (size_t i = 0; i < frame_pixels * frame_channels; ++i) {
            CHECK(self.colours[i] >= 0.0f && self.colours[i] <= 0.0f);
        }
        spt_frame_progress progress;
        size_t before = 0;
        memset(&progress, 0, sizeof progress);
        for (int i = 0; progress.pass < 4 && i < 100000; ++i) {
            CHECK(spt_frame_advance(&self.frame, self.state, self.state_size, 5000, NULL,
                                    &progress) == SPT_OK);
            const size_t shaded = self.shaded, calls = self.world.parts[4].calls;
            take_picture();
            CHECK(self.shaded == shaded && self.world.parts[4].calls == calls);
            size_t seen = 0;
            for (size_t k = 0; k < frame_pixels; ++k) {
                const float *const colour = &self.colours[k * frame_channels];
                CHECK(fabsf(colour[0]) <= 1.0f && colour[1] >= 0.0f && colour[1] <= 5.0f &&
                      fabsf(colour[2]) <= 200.0f);
                seen += colour[1] > 0.0f;
            }
            CHECK_SAY(seen >= before, "%u pixels seen, %u before", (unsigned)seen,
                      (unsigned)before);
            before = seen;
        }
        CHECK(before == frame_pixels && colours_differing() == 0);
        for (size_t k = 0; k < frame_pixels; ++k) { /* what shade() makes of the hit */
            const spt_hit *const hit = &right[k];
            const float *const colour = &right_colours[k * frame_channels];
            const int met = hit->outcome == SPT_HIT;
            CHECK(check_same_bits(colour[0], met ? 1.0f / hit->t : 0.0f));
            CHECK(check_same_bits(colour[1], met ? (float)(hit->component + 1) : 0.5f));
        }
    }
}

/* Beyond the end nothing happens; with no evaluations to spend at most a batch does. */
static void resume_at_the_ends(void) {
    for (FOR_EACH_WAY) {
        spt_frame_progress end, again;
        frame_base(&self, &way);
        CHECK(spt_frame_restart(&self.frame, self.state, self.state_size) == SPT_OK);
        CHECK(spt_frame_advance(&self.frame, self.state, self.state_size, 0, &self.image, &again) ==
              SPT_OK);
        CHECK(again.evaluations <= SPT_BATCH && again.pass == 0);
        CHECK(spt_frame_advance(&self.frame, self.state, self.state_size, UINT64_MAX, &self.image,
                                &end) == SPT_OK);
        CHECK(end.pass == 4 && end.evaluations > frame_pixels);
        const size_t calls = self.world.parts[2].calls, shaded = self.shaded;
        memset(self.hits, 0xa5, sizeof self.hits);
        memcpy(right, self.hits, sizeof right);
        CHECK(spt_frame_advance(&self.frame, self.state, self.state_size, UINT64_MAX, &self.image,
                                &again) == SPT_OK);
        CHECK(again.pass == 4 && again.evaluations == end.evaluations && again.restarted == 0);
        CHECK(self.world.parts[2].calls == calls && self.shaded == shaded);
        CHECK(frame_differing(self.hits, right, frame_pixels) == 0);
    }
}

/* Without cones and culling the last pass traces what spt_scene_trace() traces for a frame. */
static void resume_ends_as_tiles_do(void) {
    for (FOR_EACH_WAY) {
        frame_base(&self, &way);
        self.frame.flags = SPT_FRAME_NO_CONES | SPT_FRAME_NO_CULLING;
        frame_memory(&self);
        frame_trace_whole(&self);
        memcpy(right, self.hits, sizeof right);
        memset(self.hits, 0xa5, sizeof self.hits);
        frame_advance_whole(&self, 100000);
        CHECK(frame_differing(self.hits, right, frame_pixels) == 0);
    }
}

void suite_frame_resume(void) {
    RUN(resume_after_any_interruption);
    RUN(resume_with_every_schedule);
    RUN(resume_with_another_workspace);
    RUN(resume_begins_anew_when_the_frame_changes);
    RUN(resume_restarts_when_told);
    RUN(resume_pictures_on_the_way);
    RUN(resume_at_the_ends);
    RUN(resume_ends_as_tiles_do);
    frame_free(&self);
}
