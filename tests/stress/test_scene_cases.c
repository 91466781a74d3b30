/* SPDX-License-Identifier: MIT
 *
 * The base scene, audited calls and the component-by-component trace of the scene tests. */
#include "test_scene_cases.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Components ---------------------------------------------------------------------------- */

static int finite_bits(float a) {
    return (check_bits(a) & 0x7f800000u) != 0x7f800000u;
}

static void part_batch(void *user, size_t n, const float *x, const float *y, const float *z,
                       float *distance) {
    union_part *part = user;
    const uintptr_t all = (uintptr_t)x | (uintptr_t)y | (uintptr_t)z | (uintptr_t)distance;
    ++part->calls;
    part->points += n;
    if (n == 0 || n % 16 != 0 || n > SPT_BATCH || (all & 63u) != 0) {
        ++part->faults;
        return;
    }
    for (size_t i = 0; i < n; ++i) {
        if (!(finite_bits(x[i]) && finite_bits(y[i]) && finite_bits(z[i]))) ++part->faults;
        distance[i] = part->distance(part->data, x[i], y[i], z[i]);
    }
}

static float part_point(void *user, float x, float y, float z) {
    union_part *part = user;
    ++part->calls;
    ++part->points;
    if (!(finite_bits(x) && finite_bits(y) && finite_bits(z))) ++part->faults;
    return part->distance(part->data, x, y, z);
}

union_part union_part_of(stress_distance_fn *distance, const void *data) {
    const union_part part = {distance, data, 0, 0, 0};
    return part;
}

spt_field union_field(const stress_way *way, union_part *part) {
    spt_field field = spt_field_default();
    if (way->point) {
        field.point = part_point;
    } else {
        field.batch = part_batch;
    }
    field.user = part;
    field.flags = way->method == spt_convex() ? SPT_FIELD_CONVEX : 0;
    return field;
}

float union_steep_sphere(const void *data, float x, float y, float z) {
    return 2.0f * stress_sphere_distance(data, x, y, z);
}

/* ---- The base scene ------------------------------------------------------------------------ */

static float low_floor(const void *data, float x, float y, float z) {
    (void)data, (void)x, (void)z;
    return y + 2.0f;
}

void union_base(union_scene *self, const stress_way *way) {
    static const stress_sphere ahead = {{0.0f, 0.0f, 10.0f}, 1.0f};
    static const stress_sphere before = {{1.2f, 0.2f, 8.0f}, 0.7f};
    static const stress_sphere steep = {{-1.0f, 0.5f, 6.0f}, 0.5f};
    memset(self, 0, sizeof *self);
    self->parts[0] = union_part_of(stress_sphere_distance, &ahead);
    self->parts[1] = union_part_of(stress_sphere_distance, &before);
    self->parts[2] = union_part_of(low_floor, NULL);
    self->parts[3] = union_part_of(union_steep_sphere, &steep);
    self->parts[4] = self->parts[0];
    self->bounds[0] = spt_bound_sphere(0.1f, 0.0f, 10.0f, 1.25f);
    self->bounds[1] = spt_bound_box(0.4f, -0.6f, 7.2f, 2.0f, 1.0f, 8.8f);
    for (int i = 0; i < union_parts; ++i) {
        self->fields[i] = union_field(way, &self->parts[i]);
        self->materials[i] = 100 + i;
    }
    self->fields[0].bound = &self->bounds[0];
    self->fields[1].bound = &self->bounds[1];
    self->fields[1].flags = SPT_FIELD_CONVEX;
    self->fields[3].lipschitz = 2.0f;
    self->scene = spt_scene_default();
    self->scene.fields = self->fields;
    self->scene.count = union_parts;
    self->scene.materials = self->materials;
}

spt_ray union_ray(size_t index) {
    const float scale = (float)(1u << index % 3);
    const spt_ray ray = {{0.05f * (float)(index % 5), 0.0f, 0.0f},
                         0.0f,
                         {((float)(index % 17) - 8.0f) * 0.03f * scale,
                          ((float)(index / 17 % 16) - 9.0f) * 0.03f * scale, scale},
                         40.0f / scale};
    return ray;
}

spt_settings union_settings(const stress_way *way) {
    spt_settings settings = spt_settings_default();
    settings.method = way->method;
    settings.max_lanes = way->lanes;
    settings.budget = 600;
    return settings;
}

/* ---- Every hit ----------------------------------------------------------------------------- */

/* One component as a case of its own, for the formulas of trace.h. */
static stress_case case_of(const spt_scene *scene, const union_part *parts, size_t component,
                           const spt_settings *settings, const spt_ray *ray) {
    stress_case what = stress_case_of(parts[component].distance, parts[component].data);
    what.lipschitz = scene->fields[component].lipschitz;
    what.bound = scene->fields[component].bound;
    what.settings = *settings;
    what.ray = *ray;
    return what;
}

/* Some component has this value at this t. */
static int value_of_any(const spt_scene *scene, const union_part *parts,
                        const spt_settings *settings, const spt_ray *ray, float t, float value) {
    for (size_t i = 0; i < scene->count; ++i) {
        const stress_case what = case_of(scene, parts, i, settings, ray);
        if (check_same_bits(stress_value(&what, t), value)) return 1;
    }
    return 0;
}

/* The library forms the tolerance and the candidate in float with fewer than ten operations, each
 * within 2^-24, on both sides of the comparison. */
static const double rounding = 1.0 / (1 << 20);

/* Some component has this ratio at this t (trace.h, candidate_ratio). Where f is denormal it is
 * rounded to 2^-149 when it is brought to the ray's own unit of length, and once more. */
static int ratio_of_any(const spt_scene *scene, const union_part *parts,
                        const spt_settings *settings, const spt_ray *ray, const spt_hit *hit) {
    const double world = (double)hit->candidate_t * stress_length(ray->direction);
    for (size_t i = 0; i < scene->count; ++i) {
        const stress_case what = case_of(scene, parts, i, settings, ray);
        const double value = fabs((double)stress_value(&what, hit->candidate_t));
        const double near = fmax(world, (double)settings->epsilon);
        const double ratio = value / (double)what.lipschitz / near;
        const double least = 2.0 * 0x1p-149 * fmax(1.0, 1.0 / near);
        if (stress_within((double)hit->candidate_ratio, ratio, rounding * ratio + least)) return 1;
    }
    return 0;
}

static void check_surface(const spt_scene *scene, const union_part *parts,
                          const spt_settings *settings, const spt_ray *ray, const spt_hit *hit) {
    const int known = hit->component >= 0 && (size_t)hit->component < scene->count;
    CHECK_SAY(known, "component %d", (int)hit->component);
    if (!known) return;
    const stress_case what = case_of(scene, parts, (size_t)hit->component, settings, ray);
    const int stopped =
        (hit->flags & SPT_FLAG_INSIDE) != 0 && (settings->flags & SPT_STOP_INSIDE) != 0;
    const int cut = scene->zone_count != 0 && hit->residual < 0.0f;
    CHECK_SAY(check_same_bits(hit->residual, stress_value(&what, hit->t)),
              "residual %.9g at t %.9g where f is %.9g", (double)hit->residual, (double)hit->t,
              (double)stress_value(&what, hit->t));
    CHECK(hit->evaluations >= 1);
    if ((hit->flags & SPT_FLAG_STEEP) == 0 && !stopped && !cut) {
        const double r = fabs((double)hit->residual) / (double)what.lipschitz;
        CHECK_SAY(r < stress_tolerance(&what, hit->t) * (1.0 + rounding), "r %.9g", r);
    }
}

static void check_undecided(const spt_scene *scene, const union_part *parts,
                            const spt_settings *settings, const spt_ray *ray, const spt_hit *hit) {
    CHECK_SAY(check_same_bits(hit->residual, stress_infinity()) ||
                  value_of_any(scene, parts, settings, ray, hit->t, hit->residual),
              "residual %.9g at t %.9g is no component's", (double)hit->residual, (double)hit->t);
    CHECK_SAY(hit->evaluations == settings->budget, "undecided after %u evaluations",
              (unsigned)hit->evaluations);
}

static void check_hit(const spt_scene *scene, const union_part *parts, const spt_settings *settings,
                      const spt_ray *ray, const spt_hit *hit) {
    const float infinity = stress_infinity();
    const int somewhere =
        hit->outcome == SPT_HIT || hit->outcome == SPT_LIMIT || hit->outcome == SPT_NONFINITE;
    CHECK_SAY(hit->outcome >= 0 && hit->outcome < SPT_OUTCOMES, "outcome %d", (int)hit->outcome);
    CHECK(hit->evaluations <= settings->budget);
    CHECK(hit->fallbacks == 0 || hit->fallbacks < hit->evaluations);
    CHECK((hit->flags & ~(uint32_t)(SPT_FLAG_STEEP | SPT_FLAG_INSIDE)) == 0);
    if (somewhere) {
        CHECK_SAY(hit->t >= ray->t_min && hit->t <= ray->t_max, "t %.9g", (double)hit->t);
    } else {
        CHECK(check_same_bits(hit->t, infinity) && check_same_bits(hit->residual, infinity));
    }
    if (hit->outcome == SPT_HIT) check_surface(scene, parts, settings, ray, hit);
    if (hit->outcome != SPT_HIT) CHECK(hit->component == -1);
    if (hit->outcome == SPT_LIMIT) check_undecided(scene, parts, settings, ray, hit);
    if (hit->outcome == SPT_BAD_RAY) CHECK(hit->evaluations == 0 && hit->flags == 0);
    if (hit->outcome == SPT_NONFINITE) {
        CHECK(stress_is_nan(hit->residual) || check_same_bits(hit->residual, -infinity));
        CHECK(value_of_any(scene, parts, settings, ray, hit->t, hit->residual));
    } else {
        CHECK(!stress_is_nan(hit->residual));
    }
    CHECK(hit->candidate_ratio >= 0.0f);
    if (hit->candidate_ratio <= FLT_MAX) {
        CHECK(hit->candidate_t >= ray->t_min && hit->candidate_t <= ray->t_max);
        CHECK_SAY(ratio_of_any(scene, parts, settings, ray, hit), "ratio %.9g at t %.9g",
                  (double)hit->candidate_ratio, (double)hit->candidate_t);
    }
}

void union_check_hits(const spt_scene *scene, const union_part *parts, const spt_settings *settings,
                      size_t count, const spt_ray *rays, const spt_hit *hits) {
    for (size_t i = 0; i < count; ++i) check_hit(scene, parts, settings, &rays[i], &hits[i]);
}

/* ---- Calls --------------------------------------------------------------------------------- */

unsigned char *union_memory(size_t size, int fill) {
    static unsigned char *memory;
    static size_t room;
    if (memory == NULL || size > room) {
        free(memory);
        memory = malloc(size + 1); /* of no bytes is no NULL */
        room = memory != NULL ? size : 0;
    }
    if (memory != NULL) memset(memory, fill, size);
    return memory;
}

void union_record(stress_way *way, const spt_hit *hits, size_t count) {
    for (size_t i = 0; i < count; ++i) {
        unsigned char bytes[sizeof *hits];
        memcpy(bytes, &hits[i], sizeof bytes);
        for (size_t k = 0; k < sizeof bytes; ++k) {
            way->results = (way->results ^ bytes[k]) * 0x100000001b3u; /* FNV-1a */
        }
    }
}

static void check_counts(const stress_way *way, const spt_scene *scene, const union_part *parts,
                         const spt_hit *hits, size_t count, const spt_statistics *statistics) {
    uint64_t outcomes[SPT_OUTCOMES] = {0, 0, 0, 0, 0}, evaluations = 0, fallbacks = 0;
    uint64_t calls = 0, points = 0, faults = 0;
    for (size_t i = 0; i < count; ++i) {
        if (hits[i].outcome >= 0 && hits[i].outcome < SPT_OUTCOMES) ++outcomes[hits[i].outcome];
        evaluations += hits[i].evaluations;
        fallbacks += hits[i].fallbacks;
    }
    for (size_t i = 0; i < scene->count; ++i) {
        calls += parts[i].calls;
        points += parts[i].points;
        faults += parts[i].faults;
    }
    CHECK_SAY(statistics->lanes == way->lanes, "%u lanes ran", (unsigned)statistics->lanes);
    CHECK(statistics->rays == count);
    CHECK(memcmp(statistics->outcomes, outcomes, sizeof outcomes) == 0);
    CHECK_SAY(statistics->evaluations == evaluations, "%u evaluations, hits say %u",
              (unsigned)statistics->evaluations, (unsigned)evaluations);
    CHECK(statistics->fallbacks == fallbacks);
    CHECK(statistics->slots == points && points >= evaluations);
    CHECK(statistics->cone_evaluations == 0 && statistics->culled == 0);
    CHECK(!stress_is_nan(statistics->largest_slope));
    CHECK_SAY(faults == 0, "the callbacks saw %u broken promises", (unsigned)faults);
    if (way->point) {
        CHECK_SAY(calls == evaluations, "%u calls, %u evaluations", (unsigned)calls,
                  (unsigned)evaluations);
    } else {
        CHECK(calls == statistics->passes);
    }
}

void union_trace(stress_way *way, const spt_scene *scene, union_part *parts,
                 const spt_settings *settings, size_t count, const spt_ray *rays, spt_hit *hits) {
    const size_t size = spt_scene_workspace(scene, settings);
    unsigned char *const workspace = union_memory(size, 0xff); /* NaN, and no number of anything */
    const spt_rays in = spt_rays_of(rays);
    const spt_hits out = spt_hits_of(hits);
    spt_statistics statistics = spt_statistics_default();
    CHECK(size > 0 && workspace != NULL);
    if (workspace == NULL) return;
    for (size_t i = 0; i < scene->count; ++i) {
        parts[i].calls = parts[i].points = parts[i].faults = 0;
    }
    memset(hits, 0xa5, count * sizeof *hits);
    CHECK(spt_scene_trace(scene, settings, count, &in, &out, workspace, size, &statistics) ==
          SPT_OK);
    union_check_hits(scene, parts, settings, count, rays, hits);
    check_counts(way, scene, parts, hits, count, &statistics);
    union_record(way, hits, count);
}

/* ---- Component by component ---------------------------------------------------------------- */

static void begin(union_expected *expected) {
    memset(expected, 0, sizeof *expected);
    expected->decided = 1;
    expected->ratio = stress_infinity();
    expected->hit.t = expected->hit.residual = stress_infinity();
    expected->hit.candidate_ratio = stress_infinity();
    expected->hit.component = -1;
}

static void add(union_expected *expected, const spt_hit *hit, size_t component,
                const spt_settings *settings) {
    const int ends = hit->outcome == SPT_HIT || hit->outcome == SPT_NONFINITE;
    spt_hit *const first = &expected->hit;
    expected->evaluations += hit->evaluations;
    expected->fallbacks += hit->fallbacks;
    expected->flags |= hit->flags;
    if (hit->candidate_ratio < expected->ratio) expected->ratio = hit->candidate_ratio;
    if (expected->evaluations > settings->budget || hit->outcome == SPT_LIMIT) {
        expected->decided = 0;
    }
    if (hit->outcome == SPT_BAD_RAY) *first = *hit;
    if (!ends || first->outcome == SPT_BAD_RAY) return;
    if (check_same_bits(hit->t, first->t) && hit->outcome != first->outcome) {
        expected->decided = 0;
    }
    if (hit->t < first->t) {
        *first = *hit;
        first->component = hit->outcome == SPT_HIT ? (int32_t)component : -1;
    }
}

void union_separately(const spt_scene *scene, const spt_settings *settings, size_t count,
                      const spt_ray *rays, union_expected *expected) {
    enum { window = 64 };
    for (size_t i = 0; i < count; ++i) begin(&expected[i]);
    for (size_t i = 0; i < scene->count; ++i) {
        spt_settings own = *settings;
        if ((scene->fields[i].flags & SPT_FIELD_CONVEX) != 0) own.method = spt_convex();
        for (size_t first = 0; first < count; first += window) {
            spt_hit hits[window];
            const size_t left = count - first < window ? count - first : window;
            const spt_rays in = spt_rays_of(rays + first);
            const spt_hits out = spt_hits_of(hits);
            CHECK(spt_trace(&scene->fields[i], &own, left, &in, &out, NULL) == SPT_OK);
            for (size_t k = 0; k < left; ++k) add(&expected[first + k], &hits[k], i, settings);
        }
    }
}

size_t union_compare(const union_expected *expected, size_t count, const spt_hit *hits) {
    size_t decided = 0;
    for (size_t i = 0; i < count; ++i) {
        const union_expected *const right = &expected[i];
        const spt_hit *const hit = &hits[i];
        if (!right->decided) continue;
        ++decided;
        CHECK_SAY(hit->outcome == right->hit.outcome && check_same_bits(hit->t, right->hit.t) &&
                      check_same_bits(hit->residual, right->hit.residual) &&
                      hit->component == right->hit.component,
                  "ray %u: outcome %d of %d at %.9g, residual %.9g, alone %d of %d at %.9g, %.9g",
                  (unsigned)i, (int)hit->outcome, (int)hit->component, (double)hit->t,
                  (double)hit->residual, (int)right->hit.outcome, (int)right->hit.component,
                  (double)right->hit.t, (double)right->hit.residual);
        CHECK_SAY(hit->evaluations <= right->evaluations &&
                      hit->evaluations >= right->hit.evaluations,
                  "ray %u: %u evaluations, alone %u to %u", (unsigned)i, (unsigned)hit->evaluations,
                  (unsigned)right->hit.evaluations, (unsigned)right->evaluations);
        CHECK(hit->fallbacks <= right->fallbacks && hit->fallbacks >= right->hit.fallbacks);
        CHECK((hit->flags & ~right->flags) == 0 && (right->hit.flags & ~hit->flags) == 0);
        CHECK(hit->candidate_ratio >= right->ratio &&
              hit->candidate_ratio <= right->hit.candidate_ratio);
    }
    return decided;
}
