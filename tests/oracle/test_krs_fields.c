/* SPDX-License-Identifier: MIT
 *
 * Callers' fields as kernels: both forms of callback, scribbling over points, constants, values that
 * are no numbers, gradients, and a model as the kernel of another. */
#include "krs_places.h"
#include "../check.h"
#include "../rules.h"

#include <math.h>

enum { most_points = 320 };

static float points[most_points][3], values[most_points], others[most_points];
static krs_place places[most_points];
static krs_drawn sample;
static spt_krs krs;

static void evaluate(size_t count, float *out) {
    const spt_field field = spt_krs_field(&krs);
    krs_values(&field, count, (const float(*)[3])points, out);
}

/* ---- Forms of callback ------------------------------------------------------------------------- */

/* All of a model's fields are asked this way. */
typedef enum form { FORM_BATCH, FORM_POINT, FORM_SCRIBBLES, forms } form;

static float one_point(void *user, float x, float y, float z) {
    const reference_field *const field = user;
    const double p[3] = {(double)x, (double)y, (double)z};
    return (float)field->distance(field->user, p);
}

/* Leaves rubbish where the points were, as field.h allows. */
static void scribbling(void *user, size_t n, const float *x, const float *y, const float *z,
                       float *distance) {
    const float *const columns[3] = {x, y, z};
    for (size_t i = 0; i < n; ++i) distance[i] = one_point(user, x[i], y[i], z[i]);
    for (int axis = 0; axis < 3; ++axis) {
        float *const writable = (float *)(uintptr_t)columns[axis];
        for (size_t i = 0; i < n; ++i) writable[i] = i % 2 != 0 ? NAN : -1e30f;
    }
}

static void use_form(form how) {
    for (uint32_t i = 0; i <= sample.levels; ++i) {
        if (sample.kernels[i].kind != SPT_KERNEL_FIELD) continue;
        if (how == FORM_POINT) {
            sample.fields[i].batch = NULL;
            sample.fields[i].point = one_point;
        } else if (how == FORM_SCRIBBLES) {
            sample.fields[i].batch = scribbling;
        }
    }
}

static void krs_fields_of_any_form(void) {
    for (int how = 0; how < forms; ++how) {
        for (uint32_t levels = 0; levels <= 6; ++levels) {
            for (int width = 0; width < width_count; ++width) {
                check_context("form %d, %u levels, %u lanes", how, levels, widths[width]);
                krs_draw(&sample, levels, levels % 2 != 0 ? KRS_SOLID : KRS_FIELDS, 0);
                use_form((form)how);
                krs_build(&sample, widths[width], &krs);
                krs_draw_points(&sample, 48, points);
                evaluate(48, values);
                const spt_field field = spt_krs_field(&krs);
                krs_point_values(&field, 48, (const float(*)[3])points, others);
                for (int i = 0; i < 48; ++i) {
                    double p[3];
                    krs_widen(points[i], p);
                    const double truth = krs_expansion_distance(&sample.truth, p, NULL, NULL);
                    CHECK_SAY(fabs((double)values[i] - truth) <=
                                  krs_rounding(levels, sample.mirrors, p),
                              "%g for %g", (double)values[i], truth);
                    CHECK(check_same_bits(values[i], others[i]));
                }
            }
        }
    }
}

/* A field that is so many times the distance is divided by as much. */
static void krs_fields_of_any_constant(void) {
    krs_draw(&sample, 3, KRS_FIELDS, 0);
    krs_draw_points(&sample, most_points, points);
    krs_build(&sample, 0, &krs);
    evaluate(most_points, values);
    for (int power = -60; power <= 60; power += 20) { /* by powers of two: to the bit */
        for (int i = 0; i <= 3; ++i) {
            sample.bodies[i].factor = ldexp(2, power);
            sample.references[i] = surface_body_field(&sample.bodies[i]);
            sample.fields[i].lipschitz = (float)sample.references[i].lipschitz;
        }
        krs_build(&sample, 0, &krs);
        evaluate(most_points, others);
        for (int i = 0; i < most_points; ++i) CHECK(check_same_bits(values[i], others[i]));
    }
}

/* ---- No numbers ------------------------------------------------------------------------------ */

/* The distance to the unit ball at the origin, but what `value` says where x > 0. */
typedef struct broken {
    float value;
} broken;

static float broken_point(void *user, float x, float y, float z) {
    const broken *const self = user;
    const double square = (double)x * (double)x + (double)y * (double)y + (double)z * (double)z;
    return x > 0 ? self->value : (float)(sqrt(square) - 1);
}

static void broken_batch(void *user, size_t n, const float *x, const float *y, const float *z,
                         float *distance) {
    for (size_t i = 0; i < n; ++i) distance[i] = broken_point(user, x[i], y[i], z[i]);
}

/* Balls around a broken field as kernel `place` of 3 levels, one mirror a level, all at y = 4 and
 * farther up, so that the fields of all images are broken where x > 0. */
static void build_broken(const spt_field *field, uint32_t place, int balls, uint32_t lanes) {
    sample.levels = 3;
    for (uint32_t i = 0; i <= 3; ++i) {
        sample.kernels[i] = i == place ? spt_kernel_field(field)
                            : balls    ? spt_kernel_sphere(0, 1, -1, 0.5f)
                                       : spt_kernel_empty();
        if (i == 3) break;
        sample.mirrors[i] = (spt_mirror){{0, 1, 0}, 4 * (float)(1 << i)};
    }
    krs_build(&sample, lanes, &krs);
}

static void krs_fields_that_are_no_numbers(void) {
    static const float odd[] = {NAN, -INFINITY, INFINITY};
    for (int run = 0; run < 3 * 4 * 2 * width_count; ++run) {
        broken self = {odd[run % 3]};
        const uint32_t place = (uint32_t)(run / 3 % 4), lanes = widths[run / 24];
        spt_field field = spt_field_default();
        field.user = &self;
        if (run / 12 % 2 != 0)
            field.point = broken_point;
        else
            field.batch = broken_batch;
        check_context("%g from kernel %u, %u lanes", (double)self.value, place, lanes);
        for (int i = 0; i < most_points; ++i) {
            for (int axis = 0; axis < 3; ++axis) points[i][axis] = (float)check_uniform(-3, 3);
            points[i][1] *= 4;
        }
        /* What is there without the field. */
        const spt_kernel nothing = spt_kernel_empty();
        build_broken(&field, place, 1, lanes);
        sample.kernels[place] = nothing;
        krs_build(&sample, lanes, &krs);
        evaluate(most_points, others);
        build_broken(&field, place, 1, lanes);
        evaluate(most_points, values);
        for (int i = 0; i < most_points; ++i) {
            const float value = values[i];
            if (!(points[i][0] > 0)) {
                CHECK_SAY(fabsf(value) < 100, "%g", (double)value);
            } else if (run % 3 == 0) {
                CHECK_SAY(isnan(value), "%g", (double)value);
            } else if (run % 3 == 1) {
                CHECK_SAY(isinf(value) && value < 0, "%g", (double)value);
            } else { /* as if it were not there */
                CHECK(check_same_bits(value, others[i]));
            }
        }
    }
}

/* A ray from where the field is sound to where it is not, past all bodies. */
static void krs_rays_into_no_numbers(void) {
    static const float odd[] = {NAN, -INFINITY, INFINITY};
    for (int run = 0; run < 3 * 4 * 2; ++run) {
        broken self = {odd[run % 3]};
        const spt_ray ray = {{-4, -3, 0.5f}, 0, {1, 0, 0}, 50};
        spt_field field = spt_field_default();
        field.user = &self;
        field.batch = broken_batch;
        build_broken(&field, (uint32_t)(run / 3 % 4), run / 12, 0);
        const spt_field model = spt_krs_field(&krs);
        for (oracle_run way = oracle_first_run; oracle_next(&way, 0);) {
            spt_settings settings = oracle_settings(&way);
            const spt_hit hit = oracle_trace_one(&model, &settings, &ray);
            if (run % 3 == 2) {
                CHECK_SAY(hit.outcome == SPT_MISS, "outcome %d", hit.outcome);
                continue;
            }
            /* x > 0 from t = 4 on; a rule may see it up to a step later */
            CHECK_SAY(hit.outcome == SPT_NONFINITE && hit.t > 4 && hit.t < 16, "outcome %d at %g",
                      hit.outcome, (double)hit.t);
            CHECK(run % 3 == 0 ? isnan(hit.residual) : isinf(hit.residual) && hit.residual < 0);
        }
    }
}

/* ---- Gradients ------------------------------------------------------------------------------- */

/* The field has a gradient callback if all of its fields do; it says what spt_krs_locate() says,
 * blended with `smooth`. */
static void krs_fields_with_gradients(void) {
    static float room[6 * SPT_BATCH + 16];
    float *const x = room + (64 - (uintptr_t)room % 64) % 64 / sizeof(float);
    for (int draw = 0; draw < 24; ++draw) {
        enum { count = 64 };
        double a[3], b[3];
        int compared = 0;
        krs_draw(&sample, (uint32_t)draw % 7, draw % 2 != 0 ? KRS_SOLID : KRS_FIELDS, 0.3);
        spt_krs_model model = krs_model_of(&sample);
        model.smooth = draw % 3 == 0 ? 0 : 0.25f;
        model.max_lanes = widths[draw % width_count];
        CHECK(spt_krs_build(&model, &krs) == SPT_OK);
        const spt_field field = spt_krs_field(&krs);
        CHECK(field.gradient != NULL);
        if (field.gradient == NULL) continue;
        krs_draw_points(&sample, count, points);
        krs_locate_points(&krs, 0, 0, count, (const float(*)[3])points, places);
        for (int axis = 0; axis < 3; ++axis) {
            for (int i = 0; i < count; ++i) x[axis * SPT_BATCH + i] = points[i][axis];
        }
        field.gradient(field.user, count, x, x + SPT_BATCH, x + 2 * SPT_BATCH, x + 3 * SPT_BATCH,
                       x + 4 * SPT_BATCH, x + 5 * SPT_BATCH);
        for (int i = 0; i < count; ++i) {
            for (int axis = 0; axis < 3; ++axis) a[axis] = (double)x[(3 + axis) * SPT_BATCH + i];
            krs_widen(places[i].normal, b);
            if (!(surface_length(a) > 0 && surface_length(b) > 0)) continue;
            CHECK_SAY(surface_angle(a, b) < 1e-5, "%g apart", surface_angle(a, b));
            ++compared;
        }
        CHECK_SAY(compared > count / 2, "%d", compared);
    }
}

/* One field without: no callback, no blending, and locate says nothing but where. */
static void krs_fields_without_gradients(void) {
    krs_draw(&sample, 3, KRS_FIELDS, 0);
    sample.fields[1].gradient = NULL;
    krs_build(&sample, 0, &krs);
    CHECK(spt_krs_field(&krs).gradient == NULL);
    spt_krs_model model = krs_model_of(&sample);
    model.smooth = 0.125f;
    static spt_krs refused;
    CHECK(spt_krs_build(&model, &refused) == SPT_BAD_ARGUMENT);
    krs_draw_points(&sample, most_points, points);
    krs_locate_points(&krs, 0, 0, most_points, (const float(*)[3])points, places);
    int without = 0;
    for (int i = 0; i < most_points; ++i) {
        double normal[3];
        krs_widen(places[i].normal, normal);
        if (places[i].kernel == 1) {
            CHECK(!(surface_length(normal) > 0));
            ++without;
        } else {
            CHECK(fabs(surface_length(normal) - 1) < 1e-6);
        }
    }
    CHECK(without > 10 && without < most_points - 10);
}

/* ---- Models within models ---------------------------------------------------------------------- */

static double inner_distance(const void *user, const double p[3]) {
    const krs_expansion *const inner = user;
    return krs_expansion_distance(inner, p, NULL, NULL);
}

/* The oracle sees the inner model's instances, the library its field. The mirrors stand beyond the
 * inner model, and beyond all that the lower of them made of it. */
static void krs_fields_that_are_models(void) {
    static krs_drawn inner;
    static krs_expansion truth;
    static spt_krs inner_krs;
    for (uint32_t levels = 0; levels <= 3; ++levels) {
        for (int width = 0; width < width_count; ++width) {
            krs_draw(&inner, 3, KRS_SOLID, 0);
            krs_build(&inner, widths[width], &inner_krs);
            const spt_field model = spt_krs_field(&inner_krs);
            reference_field twin = {inner_distance, &inner.truth, 1};
            const spt_field twin_field = oracle_field(&twin, 0);
            spt_kernel told[4];
            double center[3];
            krs_widen(inner_krs.bound.center, center);
            double reach = surface_length(center) + (double)inner_krs.bound.radius;
            sample.levels = levels;
            for (uint32_t i = 0; i <= levels; ++i) {
                const int is_model = i == 0 || i == levels;
                sample.kernels[i] =
                    is_model ? spt_kernel_field(&model) : spt_kernel_sphere(0, 1, 0, 0.5f);
                told[i] = is_model ? spt_kernel_field(&twin_field) : sample.kernels[i];
                if (i == levels) break;
                sample.mirrors[i] = krs_draw_mirror(reach + 0.5);
                reach += 2 * (reach + 0.5);
            }
            sample.reach = fmin(reach, 40);
            krs_expand(&truth, levels, told, sample.mirrors);
            krs_build(&sample, widths[width], &krs);
            CHECK(krs.bounded && krs.straddles == 0);
            for (int i = 0; i < 40; ++i) {
                for (int axis = 0; axis < 3; ++axis)
                    points[i][axis] = (float)(check_uniform(-1, 1) * sample.reach);
            }
            evaluate(40, values);
            for (int i = 0; i < 40; ++i) {
                double p[3];
                krs_widen(points[i], p);
                const double exact = krs_expansion_distance(&truth, p, NULL, NULL);
                /* the inner fold begins at a point that the outer has rounded */
                const double rounding = krs_rounding(levels, sample.mirrors, p) +
                                        krs_rounding(3, inner.mirrors, p) +
                                        ldexp(3 + 4, -22) * sample.reach;
                CHECK_SAY(fabs((double)values[i] - exact) <= rounding, "%g for %g",
                          (double)values[i], exact);
            }
        }
    }
}

void suite_krs_fields(void) {
    RUN(krs_fields_of_any_form);
    RUN(krs_fields_of_any_constant);
    RUN(krs_fields_that_are_no_numbers);
    RUN(krs_rays_into_no_numbers);
    RUN(krs_fields_with_gradients);
    RUN(krs_fields_without_gradients);
    RUN(krs_fields_that_are_models);
}
