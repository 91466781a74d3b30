/* SPDX-License-Identifier: MIT
 *
 * Rows F7, F8 and F11: every count and placement of rays and results, between guard pages; columns
 * of any alignment and stride; inactive rays. The results must be the same bits throughout. */
#include "stress.h"
#include "stress_guard.h"

#include <math.h>
#include <string.h>

enum { most = 257, inputs = 10, outputs = 9, offsets = 16 };
enum { t_min_column = 6, t_max_column, path_column, active_column };

static const size_t counts[] = {0, 1, 3, 4, 5, 7, 8, 9, 15, 16, 17, 33, 255, 256, 257};
enum { count_of_counts = sizeof counts / sizeof counts[0] };

/* What a column holds: the same rays in every test, hits and misses, each with its own x. */
static float input_of(int column, size_t ray) {
    const float spread = (float)ray - 128.0f;
    switch (column) {
    case 0:
        return 0.01f * spread;
    case 1:
        return 0.002f * (float)(ray % 37);
    case 3:
        return 0.0005f * spread;
    case 5:
        return 1.0f;
    case t_max_column:
        return 100.0f;
    case path_column:
        return 0.5f;
    default:
        return 0.0f;
    }
}

static spt_column *column_of(spt_rays *rays, int column) {
    spt_column *const rest[] = {&rays->t_min, &rays->t_max, &rays->path, &rays->active};
    if (column < 3) return &rays->origin[column];
    return column < 6 ? &rays->direction[column - 3] : rest[column - 6];
}

static spt_sink *sink_of(spt_hits *hits, int column) {
    spt_sink *const all[outputs] = {&hits->t,           &hits->residual,        &hits->outcome,
                                    &hits->evaluations, &hits->flags,           &hits->component,
                                    &hits->candidate_t, &hits->candidate_ratio, &hits->fallbacks};
    return all[column];
}

static void write_input(void *to, int column, size_t ray, int32_t active) {
    const float value = input_of(column, ray);
    if (column == active_column) {
        memcpy(to, &active, sizeof active);
    } else {
        memcpy(to, &value, sizeof value);
    }
}

/* The results of all rays from plain arrays; hits[i] is that of ray i whatever the count. */
static void expected_hits(const stress_way *way, spt_hit hits[most]) {
    stress_case what = stress_base();
    spt_ray array[most];
    what.path = input_of(path_column, 0);
    for (size_t i = 0; i < most; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            array[i].origin[axis] = input_of(axis, i);
            array[i].direction[axis] = input_of(3 + axis, i);
        }
        array[i].t_min = input_of(t_min_column, i);
        array[i].t_max = input_of(t_max_column, i);
    }
    stress_run_many(way, &what, most, array, hits);
}

static spt_status trace(const stress_way *way, size_t count, const spt_rays *rays,
                        const spt_hits *hits, stress_probe *probe) {
    const stress_case what = stress_base();
    const spt_settings settings = stress_settings(way, &what);
    stress_probe_of(probe, &what, 0);
    const spt_field field = stress_field(way, &what, probe);
    const spt_status status = spt_trace(&field, &settings, count, rays, hits, NULL);
    CHECK(probe->faults == 0);
    return status;
}

/* ---- F7: counts and guard pages ------------------------------------------------------------ */

static stress_guard input_memory[inputs], output_memory[outputs];

static int make_memory(void) {
    int made = 1;
    for (int i = 0; i < inputs; ++i) {
        made &= stress_guard_make(&input_memory[i], (most + offsets) * sizeof(float));
    }
    for (int i = 0; i < outputs; ++i) {
        made &= stress_guard_make(&output_memory[i], (most + offsets) * sizeof(float));
    }
    return made;
}

static void free_memory(void) {
    for (int i = 0; i < inputs; ++i) stress_guard_free(&input_memory[i]);
    for (int i = 0; i < outputs; ++i) stress_guard_free(&output_memory[i]);
}

/* count floats, an offset away from the upper or the lower guard. */
static unsigned char *place(const stress_guard *guard, size_t count, size_t offset, int top) {
    if (!top) return guard->first + offset * sizeof(float);
    return stress_guard_top(guard, (count + offset) * sizeof(float));
}

static void trace_guarded(const stress_way *way, size_t count, size_t offset, int top,
                          const spt_hit *expected) {
    static stress_probe probe;
    unsigned char *out[outputs];
    spt_rays rays;
    spt_hits hits;
    for (int column = 0; column < inputs; ++column) {
        unsigned char *first = place(&input_memory[column], count, offset, top);
        memset(input_memory[column].first, 0xff, input_memory[column].size); /* NaN */
        for (size_t i = 0; i < count; ++i) write_input(first + 4 * i, column, i, -1);
        column_of(&rays, column)->first = first;
        column_of(&rays, column)->stride = 4;
    }
    for (int column = 0; column < outputs; ++column) {
        out[column] = place(&output_memory[column], count, offset, top);
        memset(output_memory[column].first, 0xa5, output_memory[column].size);
        sink_of(&hits, column)->first = out[column];
        sink_of(&hits, column)->stride = 4;
    }
    CHECK(trace(way, count, &rays, &hits, &probe) == SPT_OK);
    CHECK(count != 0 || probe.calls == 0);
    for (int column = 0; column < outputs; ++column) {
        CHECK(stress_guard_is_filled(&output_memory[column], out[column], 4 * count, 0xa5));
        int same = 1;
        for (size_t i = 0; i < count; ++i) {
            same &= memcmp(out[column] + 4 * i, (const char *)&expected[i] + 4 * column, 4) == 0;
        }
        CHECK_SAY(same, "column %d of %u rays, offset %u", column, (unsigned)count,
                  (unsigned)offset);
    }
}

static void F7_counts_between_guard_pages(void) {
    static spt_hit expected[most];
    if (!make_memory()) {
        check_skip("F7: no guard pages here");
        return;
    }
    for (stress_way way = stress_ways(STRESS_CONVEX | STRESS_OWN_RAYS); stress_next(&way);) {
        expected_hits(&way, expected);
        for (int i = 0; i < count_of_counts; ++i) {
            trace_guarded(&way, counts[i], 0, 0, expected);
            for (size_t offset = 0; offset < offsets; ++offset) {
                trace_guarded(&way, counts[i], offset, offset % 2 == 0, expected);
            }
        }
    }
    free_memory();
}

static void F7b_no_rays_no_arrays(void) {
    for (stress_way way = stress_ways(STRESS_CONVEX | STRESS_OWN_RAYS); stress_next(&way);) {
        static stress_probe probe;
        CHECK(trace(&way, 0, NULL, NULL, &probe) == SPT_OK);
        CHECK(probe.calls == 0);
    }
}

/* ---- F8: any alignment, any stride --------------------------------------------------------- */

/* base.h: values need no alignment, strides may be negative, and 0 means one value for all. */
static void trace_strided(const stress_way *way, ptrdiff_t stride, size_t shift,
                          const spt_hit *expected) {
    static stress_probe probe;
    static unsigned char in[inputs][most * 41 + 64], out[outputs][most * 41 + 64];
    const size_t count = 65, step = (size_t)(stride < 0 ? -stride : stride);
    spt_rays rays;
    spt_hits hits;
    memset(out, 0xa5, sizeof out);
    for (int column = 0; column < inputs; ++column) {
        const size_t first = stride < 0 ? (count - 1) * step : 0;
        column_of(&rays, column)->first = in[column] + shift + first;
        column_of(&rays, column)->stride = stride;
        for (size_t i = 0; i < count; ++i) {
            const size_t at = stride < 0 ? first - i * step : i * step;
            write_input(in[column] + shift + at, column, i, -1);
        }
    }
    column_of(&rays, 5)->stride = 0; /* direction z is 1 for all */
    column_of(&rays, t_max_column)->stride = 0;
    for (int column = 0; column < outputs; ++column) {
        sink_of(&hits, column)->first = out[column] + shift;
        sink_of(&hits, column)->stride = (ptrdiff_t)step;
    }
    CHECK(trace(way, count, &rays, &hits, &probe) == SPT_OK);
    for (int column = 0; column < outputs; ++column) {
        int same = 1, clean = 1;
        for (size_t i = 0; i < count; ++i) {
            const unsigned char *at = out[column] + shift + i * step;
            same &= memcmp(at, (const char *)&expected[i] + 4 * column, 4) == 0;
            for (size_t gap = 4; gap < step; ++gap) clean &= at[gap] == 0xa5;
        }
        CHECK_SAY(same, "column %d, stride %d, shift %u", column, (int)stride, (unsigned)shift);
        CHECK(clean);
    }
}

static void F8_unaligned_views(void) {
    static const ptrdiff_t strides[] = {4, 12, 36, 5, 37, -4, -41};
    static spt_hit expected[most];
    for (stress_way way = stress_ways(STRESS_CONVEX | STRESS_OWN_RAYS); stress_next(&way);) {
        expected_hits(&way, expected);
        for (int i = 0; i < 7; ++i) {
            for (size_t shift = 0; shift < 8; ++shift) {
                trace_strided(&way, strides[i], shift, expected);
            }
        }
    }
}

/* Each result alone: the others are left out, and this one does not change by it. */
static void F8b_one_sink_alone(void) {
    static spt_hit expected[most];
    static stress_probe probe;
    for (stress_way way = stress_ways(STRESS_CONVEX | STRESS_OWN_RAYS); stress_next(&way);) {
        expected_hits(&way, expected);
        for (int wanted = 0; wanted < outputs; ++wanted) {
            float in[inputs][33];
            uint32_t out[33];
            spt_rays rays;
            spt_hits hits;
            for (int column = 0; column < inputs; ++column) {
                for (size_t i = 0; i < 33; ++i) write_input(&in[column][i], column, i, -1);
                column_of(&rays, column)->first = in[column];
                column_of(&rays, column)->stride = 4;
                if (column >= outputs) continue;
                sink_of(&hits, column)->first = column == wanted ? out : NULL;
                sink_of(&hits, column)->stride = 4;
            }
            CHECK(trace(&way, 33, &rays, &hits, &probe) == SPT_OK);
            for (size_t i = 0; i < 33; ++i) {
                CHECK(memcmp(&out[i], (const char *)&expected[i] + 4 * wanted, 4) == 0);
            }
        }
    }
}

/* ---- F11: inactive rays -------------------------------------------------------------------- */

/* Every point of a batch must be that of an active ray, and those beyond the evaluations must be
 * copies. Rays are parallel and each has its own x. */
typedef struct watcher {
    const int32_t *active;
    size_t distinct, strangers;
} watcher;

static float watched_distance(float x, float y, float z) {
    return stress_sphere_distance(stress_base().data, x, y, z);
}

static void watch(watcher *self, float x, unsigned char seen[most]) {
    for (size_t i = 0; i < most; ++i) {
        if (!check_same_bits(x, input_of(0, i))) continue;
        self->strangers += self->active[i] == 0;
        self->distinct += !seen[i];
        seen[i] = 1;
        return;
    }
    ++self->strangers;
}

static void watched_batch(void *user, size_t n, const float *x, const float *y, const float *z,
                          float *distance) {
    unsigned char seen[most] = {0};
    for (size_t i = 0; i < n; ++i) {
        watch(user, x[i], seen);
        distance[i] = watched_distance(x[i], y[i], z[i]);
    }
}

static float watched_point(void *user, float x, float y, float z) {
    unsigned char seen[most] = {0};
    watch(user, x, seen);
    return watched_distance(x, y, z);
}

static float watched_input[active_column][most];
static int32_t watched_active[most];

/* Parallel rays; those to be poisoned hold nothing but NaN. */
static void write_watched(int poison_inactive) {
    for (int column = 0; column < active_column; ++column) {
        for (size_t i = 0; i < most; ++i) {
            const int poisoned = poison_inactive && watched_active[i] == 0;
            watched_input[column][i] =
                poisoned ? stress_nan() : input_of(column == 3 ? 4 : column, i);
        }
    }
}

static void trace_watched(const stress_way *way, watcher *self, int masked, spt_hit hits[most],
                          spt_statistics *statistics) {
    const stress_case what = stress_base();
    const spt_settings settings = stress_settings(way, &what);
    const spt_hits sinks = spt_hits_of(hits);
    spt_field field = spt_field_default();
    spt_rays rays;
    field.batch = way->point ? NULL : watched_batch;
    field.point = watched_point;
    field.user = self;
    field.flags = SPT_FIELD_CONVEX;
    for (int column = 0; column < active_column; ++column) {
        column_of(&rays, column)->first = watched_input[column];
        column_of(&rays, column)->stride = 4;
    }
    rays.active.first = masked ? watched_active : NULL;
    rays.active.stride = 4;
    *statistics = spt_statistics_default();
    memset(hits, 0xa5, most * sizeof hits[0]);
    CHECK(spt_trace(&field, &settings, most, &rays, &sinks, statistics) == SPT_OK);
}

static void F11_inactive_rays(void) {
    static spt_hit masked[most], all[most], untouched;
    memset(&untouched, 0xa5, sizeof untouched);
    for (stress_way way = stress_ways(STRESS_CONVEX | STRESS_OWN_RAYS); stress_next(&way);) {
        for (int part = 0; part <= 4; ++part) { /* none, a quarter, half ... of the rays are off */
            watcher self = {watched_active, 0, 0};
            spt_statistics statistics, unmasked;
            size_t off = 0;
            for (size_t i = 0; i < most; ++i) {
                watched_active[i] = (int)(check_random() & 3u) < part ? 0 : -1;
                off += watched_active[i] == 0;
            }
            write_watched(1);
            trace_watched(&way, &self, 1, masked, &statistics);
            CHECK(self.strangers == 0);
            CHECK_SAY(self.distinct == statistics.evaluations, "%u points for %u evaluations",
                      (unsigned)self.distinct, (unsigned)statistics.evaluations);
            CHECK(statistics.rays == most - off);
            CHECK(part != 4 || (off == most && statistics.slots == 0));
            write_watched(0);
            trace_watched(&way, &self, 0, all, &unmasked);
            for (size_t i = 0; i < most; ++i) {
                CHECK(stress_same_hit(&masked[i], watched_active[i] ? &all[i] : &untouched));
            }
        }
    }
}

void suite_views(void) {
    RUN(F7_counts_between_guard_pages);
    RUN(F7b_no_rays_no_arrays);
    RUN(F8_unaligned_views);
    RUN(F8b_one_sink_alone);
    RUN(F11_inactive_rays);
}
