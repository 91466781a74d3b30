/* SPDX-License-Identifier: MIT
 *
 * The models of nature, all of the list: they are built, keep the promises of their fields, give
 * the same bits at every width, are seen by their cameras, and trees are cut at mirrors as little
 * as they say. Left out: what they look like. */
#include "../check.h"

#include "scenes/models.h"
#include "test_scenes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* How much of a model's trees may lie beyond mirrors. The mirrors of a wood cut nothing. */
typedef struct cutting {
    const char *name;
    uint32_t own; /* levels of a tree itself */
    double share; /* of the surface of L_i that is beyond mirror i, at most */
    double depth; /* how far, world units */
} cutting;

static const cutting trees[] = {{"tree", 17, 0.15, 0.6},
                                {"twisted_tree", 17, 0.15, 0.6},
                                {"grove", 17, 0.25, 0.9},
                                {"forest", 17, 0.25, 0.9}};

static model_world world;

/* For every model in each of the first variants. */
static void for_every_model(int variants, void (*test)(const model *shown)) {
    for (size_t i = 0; i < model_count; ++i) {
        for (int variant = 0; variant < variants; ++variant) {
            const int built = models[i]->build(&world, variant);
            check_context("%s, variant %d", models[i]->name, variant);
            CHECK(built);
            if (built) test(models[i]);
        }
    }
}

/* ---- What was built -------------------------------------------------------------------------- */

static void complete(const model *shown) {
    CHECK(world.count >= 1 && world.count <= MODEL_COMPONENTS);
    CHECK(world.scene.count == world.count && world.scene.fields == world.fields);
    CHECK(shown->haze > 0 && shown->t_max > 0 && shown->description[0] != '\0');
    for (size_t k = 0; k < world.count; ++k) {
        const model_component *const one = &world.components[k];
        CHECK((one->krs != NULL) != (one->moekrs != NULL));
        CHECK((unsigned)one->material < model_materials);
        CHECK((unsigned)one->leaf_material < model_materials);
        CHECK(one->tint[0] > 0 && one->tint[1] > 0 && one->tint[2] > 0);
    }
}

static void models_are_built(void) {
    for_every_model(3, complete);
}

static void models_by_name(void) {
    for (size_t i = 0; i < model_count; ++i) CHECK(model_named(models[i]->name) == models[i]);
    CHECK(model_named("no such model") == NULL);
}

/* ---- Fields ---------------------------------------------------------------------------------- */

/* A point from before the eye to twice as far as what it looks at, and as far to the sides. */
static void draw_in_view(const model *shown, double p[3]) {
    const double away = apart(shown->eye, shown->target), along = check_uniform(0, 2);
    for (int axis = 0; axis < 3; ++axis) {
        p[axis] = shown->eye[axis] + along * (shown->target[axis] - shown->eye[axis]) +
                  0.4 * away * check_uniform(-1, 1);
    }
}

static void fill_view(const model *shown, points *set) {
    for (int i = 0; i < SPT_BATCH; ++i) {
        double p[3];
        draw_in_view(shown, p);
        for (int axis = 0; axis < 3; ++axis) column(set, axis)[i] = (float)p[axis];
    }
}

/* By the callback for one point, and by copies of the model for each width. */
static void same_bits(const model *shown) {
    static const uint32_t widths[] = {1, 4, 8, 16};
    static points set;
    fill_view(shown, &set);
    for (size_t k = 0; k < world.count; ++k) {
        float expected[SPT_BATCH];
        spt_field single = world.fields[k];
        evaluate(&single, &set, 0, SPT_BATCH);
        memcpy(expected, column(&set, 3), sizeof expected);
        if (single.point != NULL) {
            single.batch = NULL;
            evaluate(&single, &set, 0, SPT_BATCH);
            CHECK(differing(expected, column(&set, 3), SPT_BATCH) == 0);
        }
        if (world.components[k].distorted != NULL) continue;
        for (int i = 0; i < 4; ++i) {
            static spt_krs krs;
            static spt_moekrs moekrs;
            spt_field field;
            if (world.components[k].krs != NULL) {
                krs = *world.components[k].krs;
                krs.max_lanes = widths[i];
                field = spt_krs_field(&krs);
            } else {
                moekrs = *world.components[k].moekrs;
                moekrs.max_lanes = widths[i];
                field = spt_moekrs_field(&moekrs);
            }
            evaluate(&field, &set, 0, SPT_BATCH);
            const int count = differing(expected, column(&set, 3), SPT_BATCH);
            CHECK_SAY(count == 0, "component %d, %u lanes: %d differ", (int)k, (unsigned)widths[i],
                      count);
        }
    }
}

static void models_same_bits_at_every_width(void) {
    for_every_model(1, same_bits);
}

/* What krs.h allows a sequence of n levels to be off, 2^-22 (n + 4) (|p| + largest offset), which
 * is here as far as the camera sees twice over; ten times that of conformal ones, whose maps magnify
 * roundings. */
static double rounding_of(const model *shown, size_t component) {
    const double zero[3] = {0, 0, 0};
    const double size = 4 * (apart(shown->eye, zero) + apart(shown->target, zero)) + 1;
    const model_component *const one = &world.components[component];
    const double levels = one->krs != NULL ? one->krs->levels : 10.0 * one->moekrs->levels;
    double offsets = 0;
    if (one->krs != NULL) {
        for (uint32_t i = 0; i < one->krs->levels; ++i) {
            offsets = fmax(offsets, fabs((double)one->krs->mirrors[i].offset));
        }
    }
    return (levels + 4) * (size + offsets) / 4194304;
}

/* Pairs of points from a hundredth of a pixel's width to a tenth of the view apart. */
static void lipschitz(const model *shown) {
    static points set, other;
    const double away = apart(shown->eye, shown->target);
    double steepest = 0;
    fill_view(shown, &set);
    for (int i = 0; i < SPT_BATCH; ++i) {
        const double length = away * pow(10, check_uniform(-4, -1));
        for (int axis = 0; axis < 3; ++axis) {
            column(&other, axis)[i] =
                column(&set, axis)[i] + (float)(length * check_uniform(-1, 1));
        }
    }
    for (size_t k = 0; k < world.count; ++k) {
        const double rounding = 2 * rounding_of(shown, k);
        const double allowed = (double)world.fields[k].lipschitz;
        evaluate(&world.fields[k], &set, 0, SPT_BATCH);
        evaluate(&world.fields[k], &other, 0, SPT_BATCH);
        for (int i = 0; i < SPT_BATCH; ++i) {
            double p[3], q[3];
            for (int axis = 0; axis < 3; ++axis) {
                p[axis] = (double)column(&set, axis)[i];
                q[axis] = (double)column(&other, axis)[i];
            }
            const double way = apart(p, q);
            const double change = fabs((double)column(&set, 3)[i] - (double)column(&other, 3)[i]);
            CHECK_SAY(change <= allowed * way + rounding, "component %d: %g over %g", (int)k,
                      change, way);
            if (way > 100 * rounding) steepest = fmax(steepest, change / way / allowed);
        }
    }
    CHECK_SAY(steepest > 0.5, "steepest %g", steepest);
}

static void models_lipschitz_promise(void) {
    for_every_model(1, lipschitz);
}

/* ---- Cameras --------------------------------------------------------------------------------- */

enum { wide = 32, high = 18, view_rays = wide * high };

static void take_rays(const model *shown, spt_ray *rays, float *pixel_radius) {
    static spt_camera_ray seen[view_rays];
    static float x[view_rays], y[view_rays];
    const float up[3] = {0, 1, 0};
    const double tangent = tan(shown->field_of_view / 2 * 3.14159265358979323846 / 180);
    float eye[3], target[3];
    spt_camera camera;
    for (int axis = 0; axis < 3; ++axis) {
        eye[axis] = (float)shown->eye[axis];
        target[axis] = (float)shown->target[axis];
    }
    CHECK(spt_camera_pinhole(&camera, eye, target, up, (float)tangent, wide, high) == SPT_OK);
    camera.t_max = (float)shown->t_max;
    for (int i = 0; i < view_rays; ++i) {
        x[i] = (float)(i % wide) + 0.5f;
        y[i] = (float)(i / wide) + 0.5f;
    }
    CHECK(spt_camera_rays(&camera, wide, high, view_rays, x, y, seen) == SPT_OK);
    for (int i = 0; i < view_rays; ++i) rays[i] = seen[i].ray;
    *pixel_radius = (float)(tangent / wide);
}

/* A good part of the picture shows the model, every ray ends, and none sees a broken promise. */
static void seen_by_camera(const model *shown) {
    static spt_ray rays[view_rays];
    static spt_hit hits[view_rays];
    spt_settings settings = spt_settings_default();
    int met = 0, seen_components = 0;
    uint32_t seen = 0;
    take_rays(shown, rays, &settings.pixel_radius);
    settings.budget = 1024;
    const size_t size = spt_scene_workspace(&world.scene, &settings);
    void *const workspace = malloc(size);
    const spt_rays in = spt_rays_of(rays);
    const spt_hits out = spt_hits_of(hits);
    CHECK(size > 0 && workspace != NULL);
    CHECK(spt_scene_trace(&world.scene, &settings, view_rays, &in, &out, workspace, size, NULL) ==
          SPT_OK);
    free(workspace);
    for (int i = 0; i < view_rays; ++i) {
        CHECK(hits[i].outcome == SPT_HIT || hits[i].outcome == SPT_MISS);
        CHECK((hits[i].flags & (SPT_FLAG_STEEP | SPT_FLAG_INSIDE)) == 0);
        if (hits[i].outcome != SPT_HIT) continue;
        ++met;
        seen |= 1u << hits[i].component;
    }
    for (size_t k = 0; k < world.count; ++k) seen_components += (int)(seen >> k & 1);
    CHECK_SAY(met > view_rays / 8, "%d of %d rays hit", met, (int)view_rays);
    CHECK_SAY(2 * seen_components >= (int)world.count, "%d components of %d are seen",
              seen_components, (int)world.count);
}

static void models_are_seen(void) {
    for_every_model(1, seen_by_camera);
}

/* ---- Trees ----------------------------------------------------------------------------------- */

static void little_is_cut(const cutting *allowed) {
    enum { samples = 500 };
    for (size_t k = 0; k < world.count; ++k) {
        static spt_krs_faults faults;
        const model_component *const one = &world.components[k];
        if (one->leaf_kernels == 0) continue;
        CHECK(one->krs->levels >= allowed->own);
        CHECK(spt_krs_check(one->krs, samples, 1, &faults) == SPT_OK);
        for (uint32_t i = 0; i < one->krs->levels; ++i) {
            const double share = i < allowed->own ? allowed->share : 0;
            CHECK(faults.samples[i] > 0);
            CHECK_SAY((double)faults.discarded[i] <= share * faults.samples[i] &&
                          (double)faults.depth[i] <= allowed->depth,
                      "component %d, mirror %u: %u of %u, %g deep", (int)k, (unsigned)i,
                      (unsigned)faults.discarded[i], (unsigned)faults.samples[i],
                      (double)faults.depth[i]);
        }
    }
}

static void models_trees_are_hardly_cut(void) {
    for (size_t i = 0; i < sizeof trees / sizeof trees[0]; ++i) {
        check_context("%s", trees[i].name);
        CHECK(model_named(trees[i].name)->build(&world, 0));
        little_is_cut(&trees[i]);
    }
}

void suite_models(void) {
    RUN(models_are_built);
    RUN(models_by_name);
    RUN(models_same_bits_at_every_width);
    RUN(models_lipschitz_promise);
    RUN(models_are_seen);
    RUN(models_trees_are_hardly_cut);
}
