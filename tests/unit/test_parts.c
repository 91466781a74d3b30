/* SPDX-License-Identifier: MIT
 *
 * Scenes taken apart: the least of the components is the scene, bit for bit, at every grain, width
 * and size of batch, and what each component says of itself (bound, convexity, Lipschitz constant)
 * is true and not said in vain. Left out: tracing them. */
#include "../check.h"

#include "scenes/parts.h"
#include "scenes/scene_deformed.h"
#include "test_scenes.h"

#include <math.h>
#include <string.h>

static scene_parts parts;

/* One component of one scene, as the tests below want it. */
typedef struct component {
    const scene *shown;
    scene_grain grain;
    size_t index;
    const spt_field *field;
} component;

static double component_at(const component *one, const double p[3]) {
    double distance;
    scene_part_reference(one->shown, one->grain, one->index, 1, &p[0], &p[1], &p[2], &distance);
    return distance;
}

/* Calls a check for every component of every scene at the finer grains. */
static void for_every_component(void (*check)(const component *one)) {
    for (size_t s = 0; s < scene_count; ++s) {
        for (int grain = SCENE_OBJECTS; grain < scene_grains; ++grain) {
            const int finest = strcmp(scenes[s]->name, "village") == 0;
            if (grain == SCENE_PRIMITIVES && !finest) continue; /* as SCENE_OBJECTS */
            scene_parts_of(scenes[s], (scene_grain)grain, spt_lanes(), &parts);
            for (size_t i = 0; i < parts.scene.count; ++i) {
                const component one = {scenes[s], (scene_grain)grain, i, &parts.scene.fields[i]};
                check_context("%s, grain %d, component %d", scenes[s]->name, grain, (int)i);
                check(&one);
            }
        }
    }
}

/* A random point of the box around the component's bound, or of the scene's region. */
static void draw_near(const component *one, double growth, double p[3]) {
    double low[3], high[3];
    if (one->field->bound != NULL) {
        box_of(one->field->bound, low, high);
    } else {
        region_of(one->shown, low, high);
    }
    for (int axis = 0; axis < 3; ++axis) {
        const double middle = 0.5 * (low[axis] + high[axis]);
        low[axis] = middle + growth * (low[axis] - middle);
        high[axis] = middle + growth * (high[axis] - middle);
    }
    draw_between(low, high, p);
}

/* ---- The union ----------------------------------------------------------------------------- */

static void parts_counts(void) {
    static const struct {
        const char *name;
        size_t count[scene_grains];
    } expected[] = {
        {"primitives", {1, 22, 22}}, {"village", {1, 41, 81}}, {"village_boxes", {1, 82, 82}},
        {"slabs", {1, 13, 13}},      {"arches", {1, 29, 29}},  {"twisted", {1, 2, 2}},
        {"bent", {1, 3, 3}},         {"repeated", {1, 5, 5}}};
    for (size_t s = 0; s < scene_count; ++s) {
        for (int grain = 0; grain < scene_grains; ++grain) {
            size_t count = 1;
            for (size_t i = 0; i < sizeof expected / sizeof expected[0]; ++i) {
                if (strcmp(expected[i].name, scenes[s]->name) == 0)
                    count = expected[i].count[grain];
            }
            check_context("%s, grain %d", scenes[s]->name, grain);
            scene_parts_of(scenes[s], (scene_grain)grain, 1, &parts);
            CHECK_SAY(parts.scene.count == count, "%d components", (int)parts.scene.count);
            CHECK(parts.scene.fields == parts.fields && count <= SCENE_PARTS_MOST);
        }
    }
}

/* The whole is the scene's own field. */
static void parts_whole_is_the_field(void) {
    for (size_t s = 0; s < scene_count; ++s) {
        for (int lanes = spt_lanes(); lanes >= 0; lanes = lanes == 0 ? -1 : narrower(lanes)) {
            const spt_field field = scene_field(scenes[s], lanes);
            check_context("%s, %d lanes", scenes[s]->name, lanes);
            scene_parts_of(scenes[s], SCENE_WHOLE, lanes, &parts);
            CHECK(parts.fields[0].batch == field.batch && parts.fields[0].point == field.point);
            CHECK(parts.fields[0].bound == field.bound && parts.fields[0].flags == field.flags);
            CHECK(check_same_bits(parts.fields[0].lipschitz, field.lipschitz));
        }
    }
}

/* The least of the components at all points of the set, asked for n at a time, in the components'
 * order: of equals (a zero and a negative zero) the last, as spt_union() has it. */
static void least_of(points *set, size_t n, float least[SPT_BATCH]) {
    for (size_t i = 0; i < parts.scene.count; ++i) {
        for (size_t first = 0; first < SPT_BATCH; first += n) {
            evaluate(&parts.fields[i], set, first, n);
        }
        for (int k = 0; k < SPT_BATCH; ++k) {
            least[k] = i == 0 ? column(set, 3)[k] : spt_union(least[k], column(set, 3)[k]);
        }
    }
}

/* Near and far: up to 1e12 times as far as the scene reaches. */
static void parts_least_is_the_scene(void) {
    static const float farther[] = {1, 30, 1e4f, 1e12f};
    static points set;
    float whole[SPT_BATCH], least[SPT_BATCH];
    for (size_t s = 0; s < scene_count; ++s) {
        for (size_t far = 0; far < sizeof farther / sizeof farther[0]; ++far) {
            const spt_field field = scene_field(scenes[s], spt_lanes());
            fill(scenes[s], &set);
            for (int i = 0; i < SPT_BATCH; ++i) {
                for (int axis = 0; axis < 3; ++axis) column(&set, axis)[i] *= farther[far];
            }
            evaluate(&field, &set, 0, SPT_BATCH);
            memcpy(whole, column(&set, 3), sizeof whole);
            for (int grain = 0; grain < scene_grains; ++grain) {
                for (int lanes = spt_lanes(); lanes >= 0;
                     lanes = lanes == 0 ? -1 : narrower(lanes)) {
                    check_context("%s, grain %d, %d lanes, %g times as far", scenes[s]->name, grain,
                                  lanes, (double)farther[far]);
                    scene_parts_of(scenes[s], (scene_grain)grain, lanes, &parts);
                    for (size_t n = 16; n <= SPT_BATCH; n *= 16) {
                        least_of(&set, n, least);
                        const int count = differing(whole, least, SPT_BATCH);
                        CHECK_SAY(count == 0, "%d of %d values differ", count, SPT_BATCH);
                    }
                }
            }
        }
    }
}

static void parts_least_is_the_reference(void) {
    for (size_t s = 0; s < scene_count; ++s) {
        for (int grain = 0; grain < scene_grains; ++grain) {
            double p[3][100], whole[100], distance[100], least[100] = {0};
            for (int i = 0; i < 100; ++i) {
                double point[3];
                draw_in_region(scenes[s], point);
                for (int axis = 0; axis < 3; ++axis) {
                    p[axis][i] = (i % 4 == 0 ? 1000 : 1) * point[axis];
                }
            }
            scenes[s]->reference(100, p[0], p[1], p[2], whole);
            scene_parts_of(scenes[s], (scene_grain)grain, 1, &parts);
            for (size_t k = 0; k < parts.scene.count; ++k) {
                scene_part_reference(scenes[s], (scene_grain)grain, k, 100, p[0], p[1], p[2],
                                     distance);
                for (int i = 0; i < 100; ++i) {
                    least[i] = k > 0 && least[i] < distance[i] ? least[i] : distance[i];
                }
            }
            check_context("%s, grain %d", scenes[s]->name, grain);
            CHECK(memcmp(whole, least, sizeof whole) == 0);
        }
    }
}

/* A component in double and in float is the same body: within the law of
 * scenes_reference_within_rounding, see there. Not for the fractal, nor where the scene's own bound
 * says that nothing is promised beyond it. */
static void close_to_reference(const component *one) {
    static points set;
    double size = 0;
    if (strcmp(one->shown->name, "mandelbulb") == 0) return;
    for (int axis = 0; axis < 3; ++axis) size += fabs(one->shown->eye[axis]);
    fill(one->shown, &set);
    evaluate(one->field, &set, 0, SPT_BATCH);
    for (int i = 0; i < SPT_BATCH; ++i) {
        const double p[3] = {(double)column(&set, 0)[i], (double)column(&set, 1)[i],
                             (double)column(&set, 2)[i]};
        const double error = fabs((double)column(&set, 3)[i] - component_at(one, p));
        const double sum = fabs(p[0]) + fabs(p[1]) + fabs(p[2]) + size;
        CHECK_SAY(error <= 2.5 * 0x1p-24 * (double)one->shown->lipschitz * sum,
                  "error %g at %g %g %g", error, p[0], p[1], p[2]);
    }
}

static void parts_reference_within_rounding(void) {
    for_every_component(close_to_reference);
}

/* ---- What components say of themselves ----------------------------------------------------- */

/* Whether its distance is the Euclidean one, so that a contained surface shows in its size. */
static int exact(const component *one) {
    static const char *const exact_scenes[] = {"primitives", "village_boxes", "slabs",
                                               "arches",     "repeated",      "sphere",
                                               "box",        "thin_torus"};
    for (size_t i = 0; i < sizeof exact_scenes / sizeof exact_scenes[0]; ++i) {
        if (strcmp(one->shown->name, exact_scenes[i]) == 0) return 1;
    }
    return strcmp(one->shown->name, "twisted") == 0 && one->index == 1; /* the plinth */
}

static double distance_to_bound(const spt_bound *bound, const double p[3]) {
    const double center[3] = {(double)bound->center[0], (double)bound->center[1],
                              (double)bound->center[2]};
    double nearest[3];
    if (bound->kind == SPT_BOUND_SPHERE) return apart(p, center) - (double)bound->radius;
    for (int axis = 0; axis < 3; ++axis) {
        nearest[axis] = fmin(fmax(p[axis], (double)bound->low[axis]), (double)bound->high[axis]);
    }
    return apart(p, nearest);
}

/* Points in and around the bound, of which two in three are close to where it ends. Outside, an
 * exact distance to what lies inside is at least that to the bound; the bounds are 16 roundings of
 * float wider than the bodies, which leaves the roundings of double no part in it. */
static void within_bound(const component *one) {
    static const double growths[] = {1.0001, 1.02, 1.8};
    int outside = 0;
    if (one->field->bound == NULL) return;
    for (int i = 0; i < 3000; ++i) {
        double p[3];
        draw_near(one, growths[i % 3], p);
        if (i % 2 == 0) { /* onto the end of an axis */
            double low[3], high[3];
            const int axis = i / 2 % 3;
            box_of(one->field->bound, low, high);
            p[axis] = (i / 6 % 2 == 0 ? low[axis] : high[axis]);
            p[axis] += (p[axis] - 0.5 * (low[axis] + high[axis])) * 1e-6;
        }
        if (inside_bound(one->field->bound, p)) continue;
        ++outside;
        const double distance = component_at(one, p);
        CHECK_SAY(distance > 0, "inside at %g %g %g", p[0], p[1], p[2]);
        CHECK_SAY(!exact(one) || distance >= distance_to_bound(one->field->bound, p),
                  "%g at %g %g %g", distance, p[0], p[1], p[2]);
    }
    CHECK_SAY(outside > 1000, "%d points outside", outside);
}

static void parts_bounds_contain_the_surface(void) {
    for_every_component(within_bound);
}

/* No side of the box around the bound is longer than 1.6 times what the body takes up of it, by
 * random points of the box that lie inside the body; or near it, if it is a bare tree. */
static void tight_bound(const component *one) {
    double low[3], high[3], least[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
    double most[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    const double near = strcmp(one->shown->name, "krs_tree_16") == 0 ? 0.25 : 0;
    int inside = 0;
    if (one->field->bound == NULL) return;
    box_of(one->field->bound, low, high);
    for (int i = 0; i < 3000; ++i) {
        double p[3];
        draw_between(low, high, p);
        if (component_at(one, p) > near) continue;
        ++inside;
        for (int axis = 0; axis < 3; ++axis) {
            least[axis] = fmin(least[axis], p[axis]);
            most[axis] = fmax(most[axis], p[axis]);
        }
    }
    CHECK_SAY(inside >= 50, "%d points inside", inside);
    for (int axis = 0; axis < 3; ++axis) {
        CHECK_SAY(high[axis] - low[axis] <= 1.6 * (most[axis] - least[axis]),
                  "axis %d: %g..%g for %g..%g", axis, low[axis], high[axis], least[axis],
                  most[axis]);
    }
}

static void parts_bounds_are_tight(void) {
    for_every_component(tight_bound);
}

/* Those without end are the only ones without bound. */
static void bounded(const component *one) {
    static const char *const endless[] = {"plane", "repeated", "blended", "city", "silhouette"};
    const char *const name = one->shown->name;
    int expected = 1;
    for (size_t i = 0; i < sizeof endless / sizeof endless[0]; ++i) {
        expected &= strcmp(name, endless[i]) != 0;
    }
    if (strcmp(name, "primitives") == 0 || strcmp(name, "arches") == 0) {
        expected = one->index + 1 < parts.scene.count; /* the ground comes last */
    }
    CHECK((one->field->bound != NULL) == expected);
}

static void parts_bounded_where_finite(void) {
    for_every_component(bounded);
}

/* What is said to be convex lies below its chords, and nothing else does: 1e-9, see
 * scenes_convex_where_they_say_so. */
static void convex_as_said(const component *one) {
    int broken = 0;
    for (int i = 0; i < 1500 && !(broken > 0 && one->field->flags == 0); ++i) {
        double p[3], q[3], middle[3];
        draw_near(one, 1.3, p);
        draw_near(one, 1.3, q);
        for (int axis = 0; axis < 3; ++axis) middle[axis] = 0.5 * (p[axis] + q[axis]);
        broken +=
            component_at(one, middle) > 0.5 * (component_at(one, p) + component_at(one, q)) + 1e-9;
    }
    CHECK_SAY((one->field->flags == SPT_FIELD_CONVEX) == (broken == 0), "flags %u, %d chords below",
              (unsigned)one->field->flags, broken);
}

static void parts_convex_as_they_say(void) {
    for_every_component(convex_as_said);
}

/* From p against the gradient, so that the slope between the two is the steepest there is at p. */
static void step_downhill(const component *one, const double p[3], double length, double q[3]) {
    const double flat[3] = {0, 0, 0};
    double gradient[3];
    for (int axis = 0; axis < 3; ++axis) {
        double ahead[3] = {p[0], p[1], p[2]}, behind[3] = {p[0], p[1], p[2]};
        ahead[axis] += 1e-6;
        behind[axis] -= 1e-6;
        gradient[axis] = component_at(one, ahead) - component_at(one, behind);
    }
    const double steep = fmax(apart(gradient, flat), 1e-12);
    for (int axis = 0; axis < 3; ++axis) q[axis] = p[axis] - length * gradient[axis] / steep;
}

/* Pairs of points in the bound, every second one down the gradient; 8 roundings as in
 * scenes_lipschitz_promise. */
static void slope_as_said(const component *one) {
    const double lipschitz = (double)one->field->lipschitz;
    double steepest = 0;
    if (strcmp(one->shown->name, "mandelbulb") == 0) return; /* an estimate */
    for (int i = 0; i < 2000; ++i) {
        double p[3], q[3];
        draw_near(one, 1, p);
        draw_near(one, 1, q);
        if (i % 2 == 1) step_downhill(one, p, 1e-4, q);
        const double slope = fabs(component_at(one, p) - component_at(one, q)) / apart(p, q);
        CHECK_SAY(slope <= lipschitz * (1 + 8 * 0x1p-24), "slope %.9g at %g %g %g", slope, p[0],
                  p[1], p[2]);
        steepest = fmax(steepest, slope);
    }
    CHECK_SAY(steepest > 0.5 * lipschitz, "steepest %g of %g", steepest, lipschitz);
}

static void parts_lipschitz_promise(void) {
    for_every_component(slope_as_said);
    check_context("the twisted tower");
    scene_parts_of(scene_named("twisted"), SCENE_OBJECTS, 1, &parts);
    const float reach = (float)TWISTED_TOWER_REACH;
    const float needed = spt_twist_lipschitz((float)TWISTED_RATE, reach);
    const spt_bound *const bound = parts.fields[0].bound;
    CHECK(parts.fields[0].lipschitz >= needed && parts.fields[0].lipschitz < needed + 2e-4f);
    CHECK(spt_length_2(bound->high[0], bound->high[2]) <= reach);
    CHECK(spt_length_2(bound->low[0], bound->low[2]) <= reach);
}

void suite_parts(void) {
    RUN(parts_counts);
    RUN(parts_whole_is_the_field);
    RUN(parts_least_is_the_scene);
    RUN(parts_least_is_the_reference);
    RUN(parts_reference_within_rounding);
    RUN(parts_bounds_contain_the_surface);
    RUN(parts_bounds_are_tight);
    RUN(parts_bounded_where_finite);
    RUN(parts_convex_as_they_say);
    RUN(parts_lipschitz_promise);
}
