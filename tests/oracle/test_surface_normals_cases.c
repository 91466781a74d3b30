/* SPDX-License-Identifier: MIT
 *
 * Normals (spt_normals): how far the differences reach, fields without a gradient, the caller's own
 * gradient, and which hits get one. */
#include "surface_sampled.h"
#include "../check.h"

#include <float.h>
#include <math.h>
#include <string.h>

static const float no_t = 0;

/* ---- The step ------------------------------------------------------------------------------ */

typedef struct listener {
    float point[3];
    double nearest, farthest; /* of what was asked, from the point */
    int faults;
} listener;

static float listen(void *user, float x, float y, float z) {
    listener *self = user;
    const double offset[3] = {(double)x - (double)self->point[0],
                              (double)y - (double)self->point[1],
                              (double)z - (double)self->point[2]};
    const double distance = surface_length(offset);
    if (!isfinite(distance)) ++self->faults;
    if (distance > self->farthest) self->farthest = distance;
    if (distance < self->nearest) self->nearest = distance;
    return y;
}

/* At least an eighth of a pixel, so that what is finer than the picture does not show; and never so
 * far that another feature is met. */
static void normals_step(void) {
    for (surface_run run = surface_runs(0); surface_next(&run);) {
        spt_settings settings = spt_settings_default();
        spt_field field = spt_field_default();
        settings.max_lanes = run.lanes;
        if (!run.point) continue; /* the listener hears single points */
        for (int i = 0; i < 12; ++i) {
            static const float path = 5;
            listener heard = {{0, 0, 0}, HUGE_VAL, 0, 0};
            const spt_ray ray = {{0, 0, 0}, 0, {0, 0, 2}, 100};
            const float t = 7, detail = i % 2 == 0 ? 0.5f : 1e-3f;
            const double eighth = pow(10, i / 4 - 4) * (5 + 14) / 4;
            spt_rays rays = spt_rays_of(&ray);
            const spt_hits hits = sampled_t(&t, 1);
            float normal[3];
            const spt_vector_sinks sinks = spt_vector_sinks_of(normal);
            rays.path.first = &path;
            settings.pixel_radius = (float)pow(10, i / 4 - 4);
            heard.point[2] = 14;
            field.point = listen;
            field.user = &heard;
            CHECK(spt_normals(&field, 1, &settings, (spt_normal_rule)(i / 2 % 2), detail, 1, &rays,
                              &hits, &sinks) == SPT_OK);
            CHECK_SAY(heard.nearest >= eighth * (1 - 1e-5) - 1e-6, "%g, an eighth is %g",
                      heard.nearest, eighth);
            /* sqrt(3) times the larger of the two lengths that may decide, and times two should it be
             * a power of two. The step of the errors at 14, (u 14.5 detail^2)^(1/3) or
             * sqrt(u 14.5 detail), is below detail / 30 for 0.5; for 1e-3 below any eighth here. */
            CHECK_SAY(heard.farthest <= 2 * sqrt(3) * fmax(eighth, (double)detail / 30),
                      "%g, an eighth is %g", heard.farthest, eighth);
            CHECK(heard.faults == 0);
            CHECK(fabs((double)normal[1] - 1) < 1e-6);
        }
    }
}

/* ---- No gradient, the caller's gradient ------------------------------------------------------ */

typedef struct half_and_half {
    float low, high; /* y where x < 0.5, and a value of the other half */
    int of_y;
} half_and_half;

static float half_value(void *user, float x, float y, float z) {
    const half_and_half *self = user;
    (void)z;
    if (x < 0.5f) return self->of_y ? y : self->low;
    return self->high;
}

static void normals_without_gradient(void) {
    const float values[] = {0, 5, -5, 3e38f, INFINITY, -INFINITY, NAN};
    for (surface_run run = surface_runs(0); surface_next(&run);) {
        const spt_settings given = spt_settings_default();
        const spt_settings settings = surface_settings(&run, &given);
        if (!run.point) continue;
        for (int i = 0; i < 7; ++i) {
            for (int cut = 0; cut < 2; ++cut) {
                half_and_half halves = {0, 0, 0};
                spt_field field = spt_field_default();
                static surface_sampled at;
                at.count = 1;
                at.point[0][0] = 0.5f; /* some values from either half */
                at.point[0][1] = at.point[0][2] = 0.25f;
                halves.low = halves.high = values[i];
                halves.of_y = cut;
                if (cut && !(values[i] >= INFINITY) && values[i] > -INFINITY) continue;
                field.point = half_value;
                field.user = &halves;
                for (int rule = 0; rule < 2; ++rule) {
                    memset(at.normal, 0x7f, sizeof at.normal);
                    CHECK(sampled_normals(&field, &settings, (spt_normal_rule)rule, 0, &at) ==
                          SPT_OK);
                    for (int axis = 0; axis < 3; ++axis) {
                        CHECK_SAY(fabsf(at.normal[0][axis]) <= 0, "value %d, axis %d: %g", i, axis,
                                  (double)at.normal[0][axis]);
                    }
                }
            }
        }
    }
}

static float gradient_length;

static void gradient_of_place(void *user, size_t n, const float *x, const float *y, const float *z,
                              float *gradient_x, float *gradient_y, float *gradient_z) {
    (void)user;
    for (size_t i = 0; i < n; ++i) {
        gradient_x[i] = x[i] * gradient_length;
        gradient_y[i] = y[i] * gradient_length;
        gradient_z[i] = z[i] * gradient_length;
    }
}

static float asked_in_vain(void *user, float x, float y, float z) {
    ++*(int *)user;
    return x + y + z;
}

/* Of any length down to the least normal number and up to the largest; zero and what is not finite
 * give none. */
static void normals_of_the_caller(void) {
    const float lengths[] = {1, -1, 1e-3f, 1e-36f, 3e38f, 1e30f, 0, NAN, INFINITY};
    for (surface_run run = surface_runs(0); surface_next(&run);) {
        const spt_settings given = spt_settings_default();
        const spt_settings settings = surface_settings(&run, &given);
        if (!run.point) continue;
        for (int i = 0; i < 9; ++i) {
            static surface_sampled at;
            int asked = 0;
            spt_field field = spt_field_default();
            const surface_body unit = surface_sphere(0, 0, 0, 1);
            field.point = asked_in_vain;
            field.user = &asked;
            field.gradient = gradient_of_place;
            gradient_length = lengths[i];
            sampled_draw(&unit, 0, 100, &at);
            CHECK(sampled_normals(&field, &settings, SPT_NORMAL_CENTRAL, 0, &at) == SPT_OK);
            CHECK(asked == 0);
            for (size_t k = 0; k < at.count; ++k) {
                for (int axis = 0; axis < 3; ++axis) {
                    const double n = (double)at.normal[k][axis], p = (double)at.point[k][axis];
                    const double sign = lengths[i] < 0 ? -1 : 1;
                    if (i >= 6) {
                        CHECK_SAY(fabs(n) <= 0, "length %d: %g", i, n);
                    } else {
                        CHECK_SAY(fabs(n - sign * p) <= 1e-6, "length %d: %g for %g", i, n, p);
                    }
                }
            }
        }
    }
}

/* ---- Which hits ---------------------------------------------------------------------------- */

static void normals_of_hits_only(void) {
    enum { count = 9 };
    const surface_body bodies[2] = {surface_sphere(0, 0, 0, 1), surface_sphere(3, 0, 0, 1)};
    const reference_field references[2] = {surface_body_field(&bodies[0]),
                                           surface_body_field(&bodies[1])};
    for (surface_run run = surface_runs(0); surface_next(&run);) {
        const spt_settings given = spt_settings_default();
        const spt_settings settings = surface_settings(&run, &given);
        const spt_field fields[2] = {surface_field(&run, &references[0], 0),
                                     surface_field(&run, &references[1], 0)};
        static const int32_t outcomes[count] = {SPT_HIT,   SPT_HIT,       SPT_MISS,
                                                SPT_LIMIT, SPT_NONFINITE, SPT_BAD_RAY,
                                                SPT_HIT,   SPT_HIT,       SPT_HIT};
        int32_t outcome[count], component[count], active[count];
        float t[count], normal[count][3], before[count][3];
        static surface_sampled at;
        spt_rays rays;
        spt_hits hits = sampled_t(t, count);
        const spt_vector_sinks sinks = spt_vector_sinks_of(normal[0]);
        at.count = count;
        rays = sampled_rays(&at);
        for (int i = 0; i < count; ++i) {
            at.point[i][0] = 1.5f; /* between the two, so that they differ */
            at.point[i][1] = 0.5f;
            at.point[i][2] = 0;
            t[i] = 0;
            outcome[i] = outcomes[i];
            component[i] = i % 2;
            active[i] = -1;
        }
        t[2] = t[5] = INFINITY;
        active[6] = 0;
        at.point[7][0] = NAN;
        t[8] = INFINITY;
        rays.active.first = active;
        rays.active.stride = sizeof active[0];
        hits.outcome.first = outcome;
        hits.outcome.stride = sizeof outcome[0];
        hits.component.first = component;
        hits.component.stride = sizeof component[0];
        memset(normal, 0x5a, sizeof normal);
        memcpy(before, normal, sizeof normal);
        CHECK(spt_normals(fields, 2, &settings, SPT_NORMAL_CENTRAL, 0, count, &rays, &hits,
                          &sinks) == SPT_OK);
        for (int i = 0; i < count; ++i) {
            for (int axis = 0; axis < 3; ++axis) {
                /* (1.5, 0.5) and (-1.5, 0.5) over their length */
                static const double beside[2][3] = {{0.948683298, 0.316227766, 0},
                                                    {-0.948683298, 0.316227766, 0}};
                const double wanted = i < 2 ? beside[i][axis] : 0;
                if (i == 6) {
                    CHECK(check_same_bits(normal[i][axis], before[i][axis]));
                } else {
                    CHECK_SAY(fabs((double)normal[i][axis] - wanted) <= 2e-5, "%d: %g for %g", i,
                              (double)normal[i][axis], wanted);
                }
            }
        }
    }
}

static void normals_refuse(void) {
    const surface_body ball = surface_sphere(0, 0, 0, 1);
    const reference_field reference = surface_body_field(&ball);
    const spt_field field = oracle_field(&reference, 0);
    const spt_settings settings = spt_settings_default();
    const float bad[] = {-1, NAN, INFINITY, -INFINITY};
    static surface_sampled at;
    spt_rays rays;
    const spt_hits hits = sampled_t(&no_t, 1);
    at.count = 1;
    at.point[0][0] = 1;
    memset(at.normal, 0x5a, sizeof at.normal);
    for (int i = 0; i < 4; ++i) {
        CHECK(sampled_normals(&field, &settings, SPT_NORMAL_CENTRAL, bad[i], &at) ==
              SPT_BAD_ARGUMENT);
    }
    CHECK(sampled_normals(&field, &settings, (spt_normal_rule)2, 0, &at) == SPT_BAD_ARGUMENT);
    CHECK(sampled_normals(NULL, &settings, SPT_NORMAL_CENTRAL, 0, &at) == SPT_BAD_ARGUMENT);
    rays = sampled_rays(&at);
    for (int axis = 0; axis < 3; ++axis) {
        spt_vector_sinks sinks = spt_vector_sinks_of(at.normal[0]);
        sinks.axis[axis].first = NULL;
        CHECK(spt_normals(&field, 1, &settings, SPT_NORMAL_CENTRAL, 0, 1, &rays, &hits, &sinks) ==
              SPT_BAD_ARGUMENT);
    }
    CHECK(check_bits(at.normal[0][0]) == 0x5a5a5a5au);
}

void suite_surface_normals_cases(void) {
    RUN(normals_step);
    RUN(normals_without_gradient);
    RUN(normals_of_the_caller);
    RUN(normals_of_hits_only);
    RUN(normals_refuse);
}
