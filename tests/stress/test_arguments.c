/* SPDX-License-Identifier: MIT
 *
 * Row F10: wrong arguments of spt_trace. Each must be refused with nothing written, compared byte
 * by byte, and no callback called; and a structure longer than the library knows is not read or
 * written beyond what it knows. */
#include "stress.h"
#include "stress_guard.h"

#include <string.h>

/* One call with everything it needs, to be spoilt in one place. */
typedef struct call {
    spt_field field;
    spt_settings settings;
    spt_statistics statistics;
    spt_ray ray[2];
    spt_hit hit[2];
    spt_rays rays;
    spt_hits hits;
    size_t count;
    stress_probe probe;
    /* What is handed over; NULL where the test wants NULL. */
    const spt_field *given_field;
    const spt_settings *given_settings;
    const spt_rays *given_rays;
    const spt_hits *given_hits;
    spt_statistics *given_statistics;
} call;

static void prepare(call *self, const stress_way *way) {
    const stress_case what = stress_base();
    stress_probe_of(&self->probe, &what, 0);
    self->field = stress_field(way, &what, &self->probe);
    self->settings = stress_settings(way, &what);
    self->statistics = spt_statistics_default();
    self->ray[0] = self->ray[1] = what.ray;
    memset(self->hit, 0x5a, sizeof self->hit);
    self->rays = spt_rays_of(self->ray);
    self->hits = spt_hits_of(self->hit);
    self->count = 2;
    self->given_field = &self->field;
    self->given_settings = &self->settings;
    self->given_rays = &self->rays;
    self->given_hits = &self->hits;
    self->given_statistics = &self->statistics;
}

static spt_status place_call(const call *self) {
    return spt_trace(self->given_field, self->given_settings, self->count, self->given_rays,
                     self->given_hits, self->given_statistics);
}

static void refuse(const call *self, const char *why) {
    static call before; /* probes are large */
    memcpy(&before, self, sizeof before);
    const spt_status status = place_call(self);
    CHECK_SAY(status == SPT_BAD_ARGUMENT, "%s: %s", why, spt_status_name(status));
    CHECK_SAY(memcmp(&before, self, sizeof before) == 0, "%s: something was written", why);
}

#define REFUSE(spoil) (prepare(&self, &way), (void)(spoil), refuse(&self, #spoil))

static void F10a_null_pointers(void) {
    static call self;
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        prepare(&self, &way);
        CHECK(place_call(&self) == SPT_OK && self.hit[1].outcome == SPT_HIT);
        REFUSE((self.field.batch = NULL, self.field.point = NULL));
        REFUSE(self.given_field = NULL);
        REFUSE(self.given_settings = NULL);
        REFUSE(self.given_rays = NULL);
        REFUSE(self.given_hits = NULL);
        REFUSE(self.settings.method = NULL);
        for (int axis = 0; axis < 3; ++axis) {
            REFUSE(self.rays.origin[axis].first = NULL);
            REFUSE(self.rays.direction[axis].first = NULL);
        }
    }
}

static void F10b_sizes_of_structures(void) {
    static call self;
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        REFUSE(self.field.struct_size = 0);
        REFUSE(self.field.struct_size = sizeof self.field - 1);
        REFUSE(self.settings.struct_size = 0);
        REFUSE(self.settings.struct_size = sizeof self.settings - 1);
        REFUSE(self.statistics.struct_size = 0);
        REFUSE(self.statistics.struct_size = sizeof self.statistics - 1);
    }
}

static void F10c_numbers_and_flags(void) {
    static const uint32_t lanes[] = {2, 3, 5, 6, 7, 9, 12, 15, 17, 32, 0xffffffffu};
    static call self;
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        for (int i = 0; i < 11; ++i) REFUSE(self.settings.max_lanes = lanes[i]);
        for (int bit = 5; bit < 32; ++bit) REFUSE(self.settings.flags = (uint32_t)1 << bit);
        REFUSE(self.settings.flags = SPT_CANDIDATE_PENUMBRA | SPT_CANDIDATE_CLOSEST);
        for (int bit = 1; bit < 32; ++bit) REFUSE(self.field.flags |= (uint32_t)1 << bit);
        if (way.method == spt_convex()) REFUSE(self.field.flags = 0);
    }
}

static spt_sink *sink(spt_hits *hits, int index) {
    spt_sink *const all[] = {&hits->t,           &hits->residual,        &hits->outcome,
                             &hits->evaluations, &hits->flags,           &hits->component,
                             &hits->candidate_t, &hits->candidate_ratio, &hits->fallbacks};
    return all[index];
}

static void F10d_counts_and_strides(void) {
    static const size_t counts[] = {SIZE_MAX, SIZE_MAX / 2, SIZE_MAX / 4, SIZE_MAX / 32 + 1};
    static call self;
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        for (int i = 0; i < 4; ++i) REFUSE(self.count = counts[i]);
        for (int i = 0; i < 9; ++i) {
            REFUSE(sink(&self.hits, i)->stride = 0);
            prepare(&self, &way);
            sink(&self.hits, i)->stride = 0; /* one ray has no second result to overwrite it */
            self.count = 1;
            CHECK(place_call(&self) == SPT_OK && self.hit[0].outcome == SPT_HIT);
            prepare(&self, &way);
            *sink(&self.hits, i) = (spt_sink){NULL, 0}; /* absent: its stride does not matter */
            CHECK(place_call(&self) == SPT_OK);
        }
    }
}

/* ---- Structures longer than this library knows ---------------------------------------------- */

enum { kinds_of_structure = 4, future = 4096 };

/* The known part lies against the upper guard: whoever reads the rest that struct_size claims, or
 * writes it, ends the program. */
static void F10e_longer_structures(void) {
    static call self;
    stress_guard guard[kinds_of_structure];
    int made = 1;
    for (int i = 0; i < kinds_of_structure; ++i) made &= stress_guard_make(&guard[i], 512);
    if (!made) {
        check_skip("F10e: no guard pages here");
        return;
    }
    spt_field *field = stress_guard_top(&guard[0], sizeof *field);
    spt_settings *settings = stress_guard_top(&guard[1], sizeof *settings);
    spt_statistics *statistics = stress_guard_top(&guard[2], sizeof *statistics);
    spt_bound *bound = stress_guard_top(&guard[3], sizeof *bound);
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        prepare(&self, &way);
        *field = self.field;
        *settings = self.settings;
        *statistics = self.statistics;
        *bound = spt_bound_box(-2.0f, -2.0f, 8.0f, 2.0f, 2.0f, 12.0f);
        field->bound = bound;
        field->struct_size += future;
        settings->struct_size += future;
        statistics->struct_size += future;
        bound->struct_size += future;
        self.given_field = field;
        self.given_settings = settings;
        self.given_statistics = statistics;
        CHECK(place_call(&self) == SPT_OK);
        CHECK(self.hit[0].outcome == SPT_HIT && self.hit[1].outcome == SPT_HIT);
        CHECK(statistics->rays == 2 && statistics->lanes == way.lanes);
        CHECK(statistics->struct_size == sizeof *statistics + future);
    }
    for (int i = 0; i < kinds_of_structure; ++i) stress_guard_free(&guard[i]);
}

void suite_arguments(void) {
    RUN(F10a_null_pointers);
    RUN(F10b_sizes_of_structures);
    RUN(F10c_numbers_and_flags);
    RUN(F10d_counts_and_strides);
    RUN(F10e_longer_structures);
}
