/* SPDX-License-Identifier: MIT
 *
 * spt_moekrs_locate() on the surfaces of explicit instances: which instance it is, the way to its
 * kernel and back, normals in both spaces, scale; equal bits at every width. */
#include "moekrs_ask.h"
#include "moekrs_model.h"
#include "../check.h"
#include "../rules.h"

#include <math.h>
#include <string.h>

enum { per_model = 60 };

typedef struct place {
    int32_t kernel;
    uint64_t mirrors;
    float point[3], normal[3], kernel_normal[3], u, v, scale;
} place;

static moekrs_model model;
static spt_moekrs built;
static spt_ray rays[per_model];
static spt_hit hits[per_model];
static place places[per_model];
static int on[per_model]; /* the instance that a point lies on */

static spt_krs_places view_of(place *array) {
    spt_krs_places view;
    const ptrdiff_t stride = sizeof *array;
    spt_sink *const sinks[] = {&view.kernel,
                               &view.mirrors,
                               &view.point.axis[0],
                               &view.point.axis[1],
                               &view.point.axis[2],
                               &view.normal.axis[0],
                               &view.normal.axis[1],
                               &view.normal.axis[2],
                               &view.kernel_normal.axis[0],
                               &view.kernel_normal.axis[1],
                               &view.kernel_normal.axis[2],
                               &view.u,
                               &view.v,
                               &view.scale};
    for (int i = 0; i < 14; ++i) sinks[i]->stride = stride;
    view.kernel.first = &array->kernel;
    view.mirrors.first = &array->mirrors;
    for (int axis = 0; axis < 3; ++axis) {
        view.point.axis[axis].first = &array->point[axis];
        view.normal.axis[axis].first = &array->normal[axis];
        view.kernel_normal.axis[axis].first = &array->kernel_normal[axis];
    }
    view.u.first = &array->u;
    view.v.first = &array->v;
    view.scale.first = &array->scale;
    return view;
}

static void locate(uint32_t lanes) {
    const spt_rays from = spt_rays_of(rays);
    const spt_hits at = spt_hits_of(hits);
    const spt_krs_places view = view_of(places);
    spt_settings settings = spt_settings_default();
    settings.max_lanes = lanes;
    memset(places, 0x5a, sizeof places);
    CHECK(spt_moekrs_locate(&built, 0, &settings, per_model, &from, &at, &view) == SPT_OK);
}

/* Points on instances, as rays that end where they begin. */
static void draw_points(void) {
    for (int i = 0; i < per_model; ++i) {
        const moekrs_instance *one =
            &model.instance[on[i] = (int)(check_random() % (uint32_t)model.count)];
        double n[3], length;
        memset(&hits[i], 0, sizeof hits[i]);
        memset(&rays[i], 0, sizeof rays[i]);
        hits[i].outcome = SPT_HIT;
        rays[i].direction[2] = 1;
        rays[i].t_max = 1;
        do {
            for (int axis = 0; axis < 3; ++axis) n[axis] = check_uniform(-1, 1);
            length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        } while (!(length > 0.1));
        for (int axis = 0; axis < 3; ++axis) {
            rays[i].origin[axis] = (float)(one->center[axis] + n[axis] / length * one->radius);
        }
    }
}

/* Whether instance k is the nearest at p by more than the margin. */
static int is_alone(int k, const float p[3], double margin) {
    const wide at[3] = {(wide)p[0], (wide)p[1], (wide)p[2]};
    const wide distance = moekrs_region_distance(&model.instance[k].region, at);
    for (int other = 0; other < model.count; ++other) {
        if (other == k) continue;
        if (moekrs_region_distance(&model.instance[other].region, at) <
            distance + 4 * (wide)margin) {
            return 0;
        }
    }
    return 1;
}

static double apart(const float a[3], const wide b[3]) {
    const wide d[3] = {(wide)a[0] - b[0], (wide)a[1] - b[1], (wide)a[2] - b[2]};
    return (double)moekrs_length(d);
}

/* How much longer a short vector at q is in the world; off by the square of its length and what
 * long double cancels: 1e-9. */
static double scale_at(const moekrs_instance *one, const wide q[3]) {
    const wide step = 1e-7L * (1 + moekrs_length(q));
    wide a[3] = {q[0] + step, q[1], q[2]}, b[3] = {q[0] - step, q[1], q[2]};
    moekrs_to_world(&model, one->kernel, one->mirrors, a, a);
    moekrs_to_world(&model, one->kernel, one->mirrors, b, b);
    for (int axis = 0; axis < 3; ++axis) a[axis] -= b[axis];
    return (double)(moekrs_length(a) / (2 * step));
}

/* The margin's world length is margin / scale in the kernel's space, there an angle of that over
 * the kernel's radius, which maps keep; what turns it is off by the relative part. */
static void check_place(int i, int *seen) {
    const moekrs_instance *one = &model.instance[on[i]];
    const spt_kernel *kernel = &model.kernels[one->kernel];
    const float *p = rays[i].origin;
    const wide at[3] = {(wide)p[0], (wide)p[1], (wide)p[2]};
    const moekrs_error error = moekrs_margin(&model, p, 0);
    wide q[3], back[3], normal[3];
    moekrs_region shape;
    double scale, angle, center[3];
    if (error.absolute > 0.01 * one->radius || !is_alone(on[i], p, error.absolute)) return;
    ++*seen;
    CHECK_SAY(places[i].kernel == one->kernel && places[i].mirrors == one->mirrors,
              "kernel %d, mirrors %llx for %d, %llx", places[i].kernel,
              (unsigned long long)places[i].mirrors, one->kernel, (unsigned long long)one->mirrors);
    if (places[i].kernel != one->kernel || places[i].mirrors != one->mirrors) return;
    for (int axis = 0; axis < 3; ++axis) {
        q[axis] = (wide)places[i].point[axis];
        center[axis] = (double)kernel->a[axis];
    }
    moekrs_to_world(&model, one->kernel, one->mirrors, q, back);
    CHECK_SAY(apart(p, back) <= error.absolute, "%g away, margin %g", apart(p, back),
              error.absolute);
    moekrs_to_kernel(&model, one->kernel, one->mirrors, at, q);
    scale = scale_at(one, q);
    angle = 2 * error.absolute / (scale * (double)kernel->radius) + error.relative;
    CHECK_SAY(fabs((double)places[i].scale / scale - 1) <= angle + 4 * error.absolute / one->radius,
              "scale %.9g for %.9g, margin %g", (double)places[i].scale, scale, angle);
    moekrs_region_normal(&one->region, at, normal);
    CHECK_SAY(apart(places[i].normal, normal) <= angle + 2 * error.absolute / one->radius,
              "normal off by %g, margin %g", apart(places[i].normal, normal), angle);
    shape = moekrs_ball(center, (double)kernel->radius);
    moekrs_region_normal(&shape, q, normal);
    CHECK_SAY(apart(places[i].kernel_normal, normal) <= angle, "in the kernel off by %g, margin %g",
              apart(places[i].kernel_normal, normal), angle);
}

static void moekrs_places_of_instances(void) {
    int seen = 0;
    for (int draw = 0; draw < 100; ++draw) {
        const moekrs_flavour flavour = draw % 3 == 0   ? MOEKRS_PLAIN
                                       : draw % 3 == 1 ? MOEKRS_INSIDE_OUT
                                                       : MOEKRS_SIMILAR;
        check_context("draw %d", draw);
        moekrs_draw(&model, draw % (moekrs_levels + 1), flavour,
                    draw % 4 == 0 ? check_random() : 0);
        moekrs_built(&model, 0, &built);
        draw_points();
        locate(0);
        for (int i = 0; i < per_model; ++i) check_place(i, &seen);
    }
    CHECK_SAY(seen > 100 * per_model / 4, "%d seen", seen);
}

static void moekrs_places_bits(void) {
    static place first[per_model];
    for (int draw = 0; draw < 8; ++draw) {
        moekrs_draw(&model, 1 + draw, draw % 2 == 0 ? MOEKRS_PLAIN : MOEKRS_CUT, 0);
        draw_points();
        for (int width = 0; width < width_count; ++width) {
            for (int inner = 0; inner < width_count; ++inner) {
                check_context("draw %d, %u lanes of %u", draw, widths[width], widths[inner]);
                moekrs_built(&model, widths[inner], &built);
                locate(widths[width]);
                if (width == 0 && inner == 0) memcpy(first, places, sizeof first);
                CHECK(memcmp(first, places, sizeof first) == 0);
            }
        }
    }
}

/* Only hits of the component; misses and inactive rays keep what was there. */
static void moekrs_places_that_are_meant(void) {
    static place untouched;
    static int32_t active[per_model];
    const spt_hits at = spt_hits_of(hits);
    const spt_krs_places view = view_of(places);
    const spt_settings settings = spt_settings_default();
    spt_rays from = spt_rays_of(rays);
    memset(&untouched, 0x5a, sizeof untouched);
    moekrs_draw(&model, 3, MOEKRS_PLAIN, 0);
    moekrs_built(&model, 0, &built);
    draw_points();
    for (int i = 0; i < per_model; ++i) {
        hits[i].component = i % 3;
        active[i] = i % 5 != 0;
    }
    from.active.first = active;
    from.active.stride = sizeof *active;
    memset(places, 0x5a, sizeof places);
    CHECK(spt_moekrs_locate(&built, 1, &settings, per_model, &from, &at, &view) == SPT_OK);
    for (int i = 0; i < per_model; ++i) {
        const int meant = i % 3 == 1 && i % 5 != 0;
        CHECK_SAY((memcmp(&places[i], &untouched, sizeof untouched) == 0) == !meant, "ray %d", i);
    }
}

/* A ball that is cut at the mirror has a crease there, by 0.4 of a unit on either side; smooth over
 * 0.2 the normals of two places 2e-3 apart differ by no more than their share of it, 8e-3,
 * twice. */
static void moekrs_places_smooth(void) {
    for (int smooth = 0; smooth < 2; ++smooth) {
        spt_moekrs_model description;
        double square = 0;
        memset(&model, 0, sizeof model);
        model.levels = 1;
        model.kernels[0] = spt_kernel_sphere(0.2f, 0, 0, 0.5f);
        model.kernels[1] = spt_kernel_empty();
        moekrs_expand(&model);
        description = moekrs_description(&model);
        description.smooth = smooth ? 0.2f : 0.0f;
        CHECK(spt_moekrs_build(&description, &built) == SPT_OK);
        draw_points();
        for (int i = 0; i < 2; ++i) {
            rays[i].origin[0] = i == 0 ? -1e-3f : 1e-3f;
            rays[i].origin[1] = sqrtf(0.21f);
            rays[i].origin[2] = 0;
        }
        locate(0);
        for (int axis = 0; axis < 3; ++axis) {
            const double d = (double)places[0].normal[axis] - (double)places[1].normal[axis];
            square += d * d;
        }
        CHECK_SAY(smooth ? sqrt(square) < 0.016 : sqrt(square) > 0.7, "smooth %d: %g", smooth,
                  sqrt(square));
        CHECK((places[0].mirrors ^ places[1].mirrors) == 1);
    }
}

static void moekrs_locate_refuses(void) {
    const spt_rays from = spt_rays_of(rays);
    const spt_hits at = spt_hits_of(hits);
    const spt_krs_places view = view_of(places);
    spt_settings settings = spt_settings_default();
    static place before[per_model];
    moekrs_draw(&model, 2, MOEKRS_PLAIN, 0);
    moekrs_built(&model, 0, &built);
    draw_points();
    memset(places, 0x5a, sizeof places);
    memset(before, 0x5a, sizeof before);
#define REFUSED(...) CHECK(spt_moekrs_locate(__VA_ARGS__) == SPT_BAD_ARGUMENT)
    REFUSED(NULL, 0, &settings, per_model, &from, &at, &view);
    REFUSED(&built, 0, NULL, per_model, &from, &at, &view);
    REFUSED(&built, 0, &settings, per_model, NULL, &at, &view);
    REFUSED(&built, 0, &settings, per_model, &from, NULL, &view);
    REFUSED(&built, 0, &settings, per_model, &from, &at, NULL);
    settings.epsilon = 0;
    REFUSED(&built, 0, &settings, per_model, &from, &at, &view);
#undef REFUSED
    CHECK(memcmp(before, places, sizeof before) == 0);
}

void suite_moekrs_locate(void) {
    RUN(moekrs_places_of_instances);
    RUN(moekrs_places_bits);
    RUN(moekrs_places_that_are_meant);
    RUN(moekrs_places_smooth);
    RUN(moekrs_locate_refuses);
}
