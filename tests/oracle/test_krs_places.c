/* SPDX-License-Identifier: MIT
 *
 * spt_krs_locate(): which instance, where on its kernel, plain normals, what is left alone; and the
 * identities and weights made from it. Left out: blended normals, see test_krs_normals.c, and
 * parameters of kernels, see test_krs_parameters.c. */
#include "krs_places.h"
#include "../check.h"
#include "../rules.h"

#include <math.h>
#include <string.h>

static float points[krs_most_points][3], values[krs_most_points];
static krs_place places[krs_most_points];
static krs_drawn sample;
static spt_krs krs;

static double apart(const double a[3], const double b[3]) {
    const double way[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    return surface_length(way);
}

/* ---- The instance ---------------------------------------------------------------------------- */

/* What rounding may do to a normal: the point and the nearest one are off by `off`, which turns the
 * gradient by at most 2 sqrt(3) times as much as such a step along the worst of the axes does. Where
 * differences do not find it of length 1 it turns within their steps: anything is allowed. */
static double turned_nearby(const krs_instance *one, const double p[3], double off) {
    const krs_body *const body = &one->body;
    double here[3], there[3], most = 0;
    krs_body_gradient(body, p, here);
    if (fabs(surface_length(here) - 1) > 1e-4) return HUGE_VAL;
    for (int i = 0; i < 6; ++i) {
        double at[3] = {p[0], p[1], p[2]};
        at[i / 2] += i % 2 != 0 ? off : -off;
        krs_body_gradient(body, at, there);
        most = fmax(most, surface_angle(here, there));
    }
    return 3.5 * most + ldexp(32, -24);
}

/* One place against the instance that is nearest by more than rounding: returns whether the normal
 * was held to a hundredth. */
static int check_place(const float point[3], float value, const krs_place *place) {
    double p[3], margin, seen[3], back[3], normal[3], truth[3], gradient[3];
    size_t which;
    krs_widen(point, p);
    krs_widen(place->point, seen);
    const double rounding = krs_rounding(sample.levels, sample.mirrors, p);
    krs_expansion_distance(&sample.truth, p, &which, &margin);
    if (!(margin > 2 * rounding)) return 0;
    const krs_instance *const one = &sample.truth.instances[which];
    CHECK_SAY(place->kernel == (int32_t)one->kernel && place->mirrors == one->mirrors,
              "kernel %d, mirrors %llx instead of %u, %llx", place->kernel,
              (unsigned long long)place->mirrors, one->kernel, (unsigned long long)one->mirrors);
    krs_to_kernel(&sample.truth, one->kernel, one->mirrors, p, truth);
    CHECK_SAY(apart(truth, seen) <= rounding, "the kernel's point is off by %g",
              apart(truth, seen));
    /* Out again: each mirror in turn, from the kernel's own on. */
    for (int axis = 0; axis < 3; ++axis) back[axis] = seen[axis];
    for (uint32_t i = one->kernel; i < sample.levels; ++i) {
        if ((place->mirrors >> i & 1) != 0) krs_reflect(&sample.truth, i, back);
    }
    CHECK_SAY(apart(back, p) <= rounding, "back at the point but for %g", apart(back, p));
    krs_instance alone = *one;
    alone.body = krs_body_of(&sample.kernels[one->kernel]);
    CHECK(fabs(krs_body_distance(&alone.body, seen) - (double)value) <= 2 * rounding);
    CHECK(!(place->scale < 1) && !(place->scale > 1));
    const double allowed = turned_nearby(&alone, truth, rounding);
    krs_widen(place->normal, normal);
    krs_expansion_gradient(&sample.truth, which, p, gradient);
    CHECK_SAY(surface_angle(normal, gradient) <= allowed, "normal off by %g, allowed %g",
              surface_angle(normal, gradient), allowed);
    CHECK(fabs(surface_length(normal) - 1) < 1e-6);
    krs_widen(place->kernel_normal, normal);
    krs_body_gradient(&alone.body, truth, gradient);
    CHECK_SAY(surface_angle(normal, gradient) <= allowed, "kernel's normal off by %g, allowed %g",
              surface_angle(normal, gradient), allowed);
    CHECK(fabs(surface_length(normal) - 1) < 1e-6);
    return allowed < 1e-2;
}

static void krs_places_of_instances(void) {
    static const uint32_t kind_sets[] = {
        KRS_SPHERES,          KRS_CAPSULES, KRS_LEAVES, KRS_FIELDS, KRS_SPHERES | KRS_HALF_SPACES,
        KRS_SOLID | KRS_EMPTY};
    for (uint32_t levels = 0; levels <= krs_most_levels; ++levels) {
        for (int set = 0; set < 6; ++set) {
            const size_t count = levels < 6 ? 60 : 15;
            size_t decided = 0;
            check_context("%u levels, kernels %#x", levels, kind_sets[set]);
            do krs_draw(&sample, levels, kind_sets[set], 0);
            while (sample.truth.count == 0);
            krs_build(&sample, widths[(levels + (uint32_t)set) % width_count], &krs);
            krs_draw_points(&sample, count, points);
            const spt_field field = spt_krs_field(&krs);
            krs_values(&field, count, (const float(*)[3])points, values);
            krs_locate_points(&krs, 0, 0, count, (const float(*)[3])points, places);
            for (size_t i = 0; i < count; ++i)
                decided += (size_t)check_place(points[i], values[i], &places[i]);
            CHECK_SAY(decided > count / 3, "%zu of %zu", decided, count);
        }
    }
}

/* Of equal distances the higher kernel has it, and the bits of mirrors below it are clear. */
static void krs_places_of_equals(void) {
    const spt_kernel ball = spt_kernel_sphere(-1, 0.5f, 0, 0.25f);
    sample.levels = 3;
    for (int i = 0; i < 4; ++i) sample.kernels[i] = i < 3 ? ball : spt_kernel_empty();
    for (uint32_t i = 0; i < 3; ++i) {
        sample.mirrors[i].normal[0] = 1;
        sample.mirrors[i].normal[1] = sample.mirrors[i].normal[2] = 0;
        sample.mirrors[i].offset = 4 * (float)i;
    }
    krs_build(&sample, 0, &krs);
    for (int i = 0; i < 100; ++i) {
        for (int axis = 0; axis < 3; ++axis) points[i][axis] = (float)check_uniform(-1, 1);
        points[i][0] -= 1 - 10 * (float)(i % 2); /* the second half: about the image in mirror 2 */
    }
    for (int i = 1; i < 100; i += 2) points[i][0] = 16 - points[i - 1][0];
    krs_locate_points(&krs, 0, 0, 100, (const float(*)[3])points, places);
    for (int i = 0; i < 100; ++i) {
        CHECK_SAY(places[i].kernel == 2 && places[i].mirrors == (i % 2 != 0 ? 4 : 0),
                  "kernel %d, mirrors %llx at x = %g", places[i].kernel,
                  (unsigned long long)places[i].mirrors, (double)points[i][0]);
    }
}

static void krs_places_where_all_is_empty(void) {
    for (uint32_t levels = 0; levels <= 5; ++levels) {
        krs_draw(&sample, levels, KRS_EMPTY, 0);
        krs_build(&sample, 0, &krs);
        CHECK(!krs.bounded && krs.straddles == 0);
        for (int i = 0; i < 40; ++i) {
            for (int axis = 0; axis < 3; ++axis) points[i][axis] = (float)check_uniform(-9, 9);
        }
        krs_locate_points(&krs, 0, 0, 40, (const float(*)[3])points, places);
        for (int i = 0; i < 40; ++i) {
            CHECK(places[i].kernel == -1);
            for (int axis = 0; axis < 3; ++axis) CHECK(!(fabsf(places[i].normal[axis]) > 0));
        }
    }
}

/* ---- What is looked at ----------------------------------------------------------------------- */

enum { ray_count = 60 };

typedef struct ask {
    spt_ray rays[ray_count];
    spt_hit hits[ray_count];
    int32_t active[ray_count];
} ask;

/* Points at p = o + t d, of all outcomes and four components, half of the rays active. */
static void draw_rays(ask *all) {
    for (int i = 0; i < ray_count; ++i) {
        spt_ray *const ray = &all->rays[i];
        const float t = (float)check_uniform(0, 4);
        double way[3];
        surface_random_unit(way);
        for (int axis = 0; axis < 3; ++axis) {
            ray->direction[axis] = (float)(3 * way[axis]);
            ray->origin[axis] = (float)check_uniform(-2, 2);
            points[i][axis] = ray->origin[axis] + t * ray->direction[axis];
        }
        ray->t_min = 0;
        ray->t_max = 100;
        all->hits[i] = (spt_hit){t, 0, i % SPT_OUTCOMES, 1, 0, i / 5 % 4, 0, 0, 0};
        all->active[i] = i % 3 != 0 ? -1 : 0;
        if (all->hits[i].outcome == SPT_BAD_RAY) ray->origin[1] = NAN;
        if (all->hits[i].outcome == SPT_MISS) all->hits[i].t = INFINITY;
    }
}

static void krs_places_looked_at(void) {
    static ask all;
    static krs_place wanted[ray_count], found[ray_count], before[ray_count];
    const spt_settings settings = spt_settings_default();
    krs_draw(&sample, 4, KRS_SOLID, 0);
    krs_build(&sample, 0, &krs);
    draw_rays(&all);
    krs_locate_points(&krs, 0, 0, ray_count, (const float(*)[3])points, wanted);
    for (int run = 0; run < 16; ++run) {
        const int32_t component = run % 4;
        const spt_krs_places view = krs_places_of(found);
        spt_rays rays = spt_rays_of(all.rays);
        spt_hits hits = spt_hits_of(all.hits);
        const int by_component = (run & 4) != 0, by_active = (run & 8) != 0;
        if (!by_component) hits.component.first = NULL;
        if (by_active) rays.active = (spt_column){all.active, sizeof all.active[0]};
        memset(found, 0x5a, sizeof found);
        memcpy(before, found, sizeof found);
        CHECK(spt_krs_locate(&krs, component, &settings, ray_count, &rays, &hits, &view) == SPT_OK);
        for (int i = 0; i < ray_count; ++i) {
            const int looked_at = all.hits[i].outcome == SPT_HIT &&
                                  (!by_component || all.hits[i].component == component) &&
                                  (!by_active || all.active[i] != 0);
            CHECK_SAY(memcmp(&found[i], looked_at ? &wanted[i] : &before[i],
                             offsetof(krs_place, kernel) + sizeof found[i].kernel) == 0,
                      "ray %d, component %d, run %d", i, all.hits[i].component, run);
        }
    }
    /* Without outcomes all t are hits; here those that are one. */
    spt_hits hits = spt_hits_of(all.hits + 1);
    const spt_krs_places view = krs_places_of(found + 1);
    const spt_rays rays = spt_rays_of(all.rays + 1);
    hits.outcome.first = hits.component.first = NULL;
    CHECK(spt_krs_locate(&krs, 0, &settings, 1, &rays, &hits, &view) == SPT_OK);
    CHECK(memcmp(&found[1], &wanted[1], offsetof(krs_place, kernel) + sizeof found[1].kernel) == 0);
}

/* Each sink alone, and all but one: the same values, and nothing else is written. */
static void krs_places_wanted_or_not(void) {
    static ask all;
    static krs_place wanted[ray_count], found[ray_count];
    const spt_settings settings = spt_settings_default();
    krs_draw(&sample, 5, KRS_SOLID, 0);
    krs_build(&sample, 0, &krs);
    draw_rays(&all);
    for (int i = 0; i < ray_count; ++i) all.hits[i].outcome = SPT_MISS;
    all.hits[7].outcome = SPT_HIT;
    all.hits[7].t = 1;
    all.rays[7].origin[1] = 0.5f;
    const spt_rays rays = spt_rays_of(all.rays);
    const spt_hits hits = spt_hits_of(all.hits);
    const spt_krs_places view = krs_places_of(wanted);
    memset(wanted, 0x5a, sizeof wanted);
    const int32_t component = all.hits[7].component;
    CHECK(spt_krs_locate(&krs, component, &settings, ray_count, &rays, &hits, &view) == SPT_OK);
    CHECK(wanted[7].kernel >= 0 && wanted[7].kernel <= 5);
    for (int only = 0; only < 2; ++only) {
        for (int column = 0; column < 14; ++column) {
            spt_krs_places some = krs_places_of(found);
            spt_sink *const sinks[14] = {&some.kernel,
                                         &some.mirrors,
                                         &some.u,
                                         &some.v,
                                         &some.scale,
                                         &some.point.axis[0],
                                         &some.point.axis[1],
                                         &some.point.axis[2],
                                         &some.normal.axis[0],
                                         &some.normal.axis[1],
                                         &some.normal.axis[2],
                                         &some.kernel_normal.axis[0],
                                         &some.kernel_normal.axis[1],
                                         &some.kernel_normal.axis[2]};
            krs_place expected;
            memset(found, 0x5a, sizeof found);
            memcpy(&expected, &found[7], sizeof expected);
            for (int i = 0; i < 14; ++i) {
                const size_t offset = (size_t)((char *)sinks[i]->first - (char *)found),
                             size = i == 1 ? sizeof(uint64_t) : sizeof(float);
                if ((i == column) == only)
                    memcpy((char *)&expected + offset, (char *)&wanted[7] + offset, size);
                else
                    sinks[i]->first = NULL;
            }
            CHECK(spt_krs_locate(&krs, component, &settings, ray_count, &rays, &hits, &some) ==
                  SPT_OK);
            CHECK_SAY(memcmp(&expected, &found[7], sizeof expected) == 0, "column %d", column);
        }
    }
}

/* ---- Made from it ---------------------------------------------------------------------------- */

/* All 2047 instances of 10 levels: of so many 32-bit numbers two are equal once in
 * 2000 models. */
static void krs_identities_differ(void) {
    static uint32_t numbers[krs_most_instances];
    size_t count = 0, equal = 0;
    for (uint32_t kernel = 0; kernel <= 10; ++kernel) {
        for (uint64_t path = 0; path < UINT64_C(1) << (10 - kernel); ++path)
            numbers[count++] = spt_krs_identity((int32_t)kernel, path << kernel, 0);
    }
    CHECK(count == krs_most_instances);
    for (size_t i = 0; i < count; ++i) {
        for (size_t j = 0; j < i; ++j) equal += numbers[i] == numbers[j];
    }
    CHECK_SAY(equal == 0, "%zu pairs", equal);
    /* What differs below `from` only is the same, above it is not; at 64 nothing is left. */
    for (uint32_t from = 0; from <= 64; ++from) {
        for (uint32_t bit = 0; bit < 64; ++bit) {
            const uint64_t other = UINT64_C(0x123456789abcdef) ^ UINT64_C(1) << bit;
            CHECK((spt_krs_identity(3, UINT64_C(0x123456789abcdef), from) ==
                   spt_krs_identity(3, other, from)) == (bit < from));
        }
    }
}

static void krs_triplanar_weights(void) {
    for (int i = 0; i < 200; ++i) {
        double normal[3], power[3], sum = 0;
        float given[3], weights[3];
        surface_random_unit(normal);
        if (i % 4 == 0) normal[i / 4 % 3] = 0;
        surface_unit(normal);
        for (int axis = 0; axis < 3; ++axis) given[axis] = (float)normal[axis];
        for (uint32_t sharpness = 0; sharpness <= 6; ++sharpness) {
            spt_triplanar(given, sharpness, weights);
            sum = 0;
            for (int axis = 0; axis < 3; ++axis) {
                power[axis] = pow(fabs((double)given[axis]), ldexp(1, (int)sharpness));
                sum += power[axis];
            }
            CHECK(fabs((double)weights[0] + (double)weights[1] + (double)weights[2] - 1) < 1e-6);
            for (int axis = 0; axis < 3; ++axis) /* 64 factors, each rounded */
                CHECK(fabs((double)weights[axis] - power[axis] / sum) < 1e-5);
        }
    }
    const float none[3] = {0, 0, 0};
    for (uint32_t sharpness = 0; sharpness <= 6; ++sharpness) {
        float weights[3];
        spt_triplanar(none, sharpness, weights);
        for (int axis = 0; axis < 3; ++axis) CHECK(fabsf(weights[axis] - 1.0f / 3) < 1e-7f);
    }
}

void suite_krs_places(void) {
    RUN(krs_places_of_instances);
    RUN(krs_places_of_equals);
    RUN(krs_places_where_all_is_empty);
    RUN(krs_places_looked_at);
    RUN(krs_places_wanted_or_not);
    RUN(krs_identities_differ);
    RUN(krs_triplanar_weights);
}
