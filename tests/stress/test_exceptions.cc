/* SPDX-License-Identifier: MIT
 *
 * Row G6: a C++ callback throws through the library's frames. The caller must catch what was
 * thrown, at every width and with every method, and the next call must give the same bits. A
 * program of its own: 0 when all held. C++11. */
#include <spheretrace/trace.h>

#include <cmath>
#include <cstdio>
#include <cstring>

namespace {

struct Surface {
    int calls_left; /* before one throws; negative: none does */
};

struct Thrown {
    const Surface *by;
};

float distance(Surface &surface, float x, float y, float z) {
    if (surface.calls_left-- == 0) throw Thrown{&surface};
    const float dz = z - 10.0f;
    return std::sqrt(x * x + y * y + dz * dz) - 1.0f;
}

extern "C" void batch_callback(void *user, size_t n, const float *x, const float *y, const float *z,
                               float *result) {
    Surface &surface = *static_cast<Surface *>(user);
    const int calls_left = surface.calls_left;
    for (size_t i = 0; i < n; ++i) {
        surface.calls_left = calls_left; /* a batch counts as one */
        result[i] = distance(surface, x[i], y[i], z[i]);
    }
}

extern "C" float point_callback(void *user, float x, float y, float z) {
    return distance(*static_cast<Surface *>(user), x, y, z);
}

spt_status trace(const spt_method *method, uint32_t lanes, bool point, Surface &surface,
                 spt_hit &hit) {
    const spt_ray ray = {{0.0f, 0.0f, 0.0f}, 0.0f, {0.0f, 0.0f, 1.0f}, 100.0f};
    const spt_rays rays = spt_rays_of(&ray);
    const spt_hits hits = spt_hits_of(&hit);
    spt_settings settings = spt_settings_default();
    spt_field field = spt_field_default();
    settings.method = method;
    settings.max_lanes = lanes;
    field.batch = point ? nullptr : batch_callback;
    field.point = point_callback;
    field.user = &surface;
    field.flags = SPT_FIELD_CONVEX;
    return spt_trace(&field, &settings, 1, &rays, &hits, nullptr);
}

/* Throws in call 0, then in call 1, and compares the results before and after. */
bool survives(const spt_method *method, uint32_t lanes, bool point) {
    Surface quiet = {-1};
    spt_hit before, after;
    if (trace(method, lanes, point, quiet, before) != SPT_OK) return false;
    if (before.outcome != SPT_HIT || std::fabs(before.t - 9.0f) > 1e-4f) return false;
    for (int call = 0; call < 2; ++call) {
        Surface loud = {call};
        spt_hit hit;
        bool caught = false;
        try {
            trace(method, lanes, point, loud, hit);
        } catch (const Thrown &thrown) {
            caught = thrown.by == &loud;
        }
        if (!caught) return false;
    }
    quiet.calls_left = -1;
    if (trace(method, lanes, point, quiet, after) != SPT_OK) return false;
    return std::memcmp(&before, &after, sizeof before) == 0;
}

} // namespace

int main() {
    const spt_method *const methods[] = {spt_basic(),        spt_relaxed(),  spt_enhanced(),
                                         spt_auto_relaxed(), spt_adaptive(), spt_convex()};
    const uint32_t widths[] = {1, 4, 8, 16};
    int failed = 0, ran = 0;
    for (const spt_method *method : methods) {
        for (const uint32_t lanes : widths) {
            if (static_cast<int>(lanes) > spt_lanes()) continue;
            for (int point = 0; point < 2; ++point) {
                ++ran;
                if (survives(method, lanes, point != 0)) continue;
                ++failed;
                std::printf("FAILED G6_exception: method %s, %u lanes, %s\n",
                            spt_method_name(method), static_cast<unsigned>(lanes),
                            point != 0 ? "one point" : "batch");
            }
        }
    }
    std::printf("G6_exception: %d of %d passed\n", ran - failed, ran);
    return failed != 0 || ran == 0;
}
