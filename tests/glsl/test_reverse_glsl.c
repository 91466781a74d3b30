/* SPDX-License-Identifier: MIT
 *
 * spt_trace_convex() of the GLSL against that of C: t, residual, outcome, evaluations and flags, bit
 * by bit, of rays from outside, inside and the surface. */
#include "glsl_check.h"
#include "surface_glsl_world.h"

#include <math.h>
#include <stdio.h>

static surface_case traced;
static float answers[SURFACE_RAYS][SURFACE_RESULTS];

/* Counts of what the rays met, so that nothing goes untested. */
typedef struct convex_count {
    int inside, betrayed, misses, limits;
} convex_count;

static void check_convex(int i, convex_count *count) {
    const spt_hit *const hit = &traced.hits[i];
    const float *const glsl = answers[i];
    const int has_flags = (traced.features & SPT_GLSL_FLAGS) != 0;
    CHECK_SAY(surface_agrees(glsl[0], hit->t), "t of ray %d: %.9g, in C %.9g", i, (double)glsl[0],
              (double)hit->t);
    CHECK_SAY(surface_agrees(glsl[1], hit->residual), "residual of ray %d: %.9g, in C %.9g", i,
              (double)glsl[1], (double)hit->residual);
    CHECK_SAY(glsl[2] == (float)hit->evaluations, "evaluations of ray %d: %g, in C %u", i,
              (double)glsl[2], hit->evaluations);
    CHECK_SAY(glsl[3] == (float)hit->outcome, "outcome of ray %d: %g, in C %d", i, (double)glsl[3],
              hit->outcome);
    CHECK_SAY(!has_flags || glsl[4] == (float)hit->flags, "flags of ray %d: %g, in C %u", i,
              (double)glsl[4], hit->flags);
    count->inside += (hit->flags & SPT_FLAG_INSIDE) != 0;
    count->betrayed += (hit->flags & SPT_FLAG_NOT_CONVEX) != 0;
    count->misses += hit->outcome == SPT_MISS;
    count->limits += hit->outcome == SPT_LIMIT;
}

/* Puts origins on the surface, up to a tolerance or two off, with rays both ways. */
static void begin_at_surface(void) {
    surface_draw(&traced, 0);
    surface_trace(&traced);
    for (int i = 0; i < SURFACE_RAYS; ++i) {
        spt_ray *const ray = &traced.rays[i];
        const float off = (float)check_uniform(-2, 2) * traced.settings.epsilon;
        if (traced.hits[i].outcome != SPT_HIT) continue;
        for (int axis = 0; axis < 3; ++axis) {
            ray->origin[axis] += traced.hits[i].t * ray->direction[axis];
            ray->origin[axis] += off * traced.normals[i][axis];
            if (i % 4 == 0) ray->direction[axis] = (float)check_uniform(-1, 1);
        }
        ray->t_min = 0;
    }
}

/* Bad rays, and one without end. */
static void spoil(void) {
    for (int i = 5; i < SURFACE_RAYS; i += 64) {
        traced.rays[i].origin[i / 64 % 3] = NAN;
        traced.rays[i + 1].direction[2] = INFINITY;
        traced.rays[i + 2].t_min = -1;
        traced.rays[i + 3].t_max = NAN;
        traced.rays[i + 4].t_max = INFINITY;
        for (int axis = 0; axis < 3; ++axis) traced.rays[i + 5].direction[axis] = 0;
    }
}

enum { AT_SURFACE = -1 };

/* inside: the share of rays that begin there, or AT_SURFACE. */
static convex_count convex_of(const surface_world *world, int variant, const spt_method *method,
                              uint32_t budget, uint32_t flags, int guards, double inside) {
    convex_count count = {0, 0, 0, 0};
    char statements[512];
    surface_set_variant(&traced, world, variant);
    if (inside < 0) {
        begin_at_surface();
    } else {
        surface_draw(&traced, inside);
    }
    if (guards) spoil();
    traced.settings.method = method;
    traced.settings.budget = budget;
    traced.settings.flags = flags;
    check_context("%s, variant %d, %s, budget %u, flags %u, guards %d", world->name, variant,
                  spt_method_name(method), budget, flags, guards);
    snprintf(statements, sizeof statements,
             "    hit = spt_trace_convex(ray, %u);\n"
             "    r[0] = vec4(hit.t, hit.residual, float(hit.evaluations), float(hit.outcome));\n"
             "%s",
             budget,
             (traced.features & SPT_GLSL_FLAGS) != 0 ? "    r[1].x = float(hit.flags);\n" : "");
    if (!surface_ask(&traced, SPT_GLSL_CONVEX | (guards ? SPT_GLSL_GUARDS : 0), statements,
                     answers))
        return count;
    const spt_rays rays = surface_rays(&traced);
    const spt_hits hits = spt_hits_of(traced.hits);
    CHECK(spt_trace_convex(world->fields, &traced.settings, SURFACE_RAYS, &rays, &hits, NULL) ==
          SPT_OK);
    for (int i = 0; i < SURFACE_RAYS; ++i) check_convex(i, &count);
    return count;
}

/* From inside and outside, by every rule. */
static void V1_convex(void) {
    const spt_method *const methods[] = {spt_basic(), spt_relaxed(), spt_enhanced(),
                                         spt_auto_relaxed(), spt_adaptive()};
    for (int i = 0; i < 5; ++i) {
        const convex_count count = convex_of(surface_world_named("sphere"), i % SURFACE_VARIANTS,
                                             methods[i], 128, 0, 0, 0.6);
        CHECK_SAY(count.inside > 200 && count.misses > 50, "%d inside, %d misses", count.inside,
                  count.misses);
        CHECK(count.betrayed == 0);
    }
    for (int variant = 0; variant < SURFACE_VARIANTS; ++variant) {
        const convex_count count = convex_of(surface_world_named("dodecahedron"), variant,
                                             spt_adaptive(), 128, 0, variant == 1, 0.6);
        CHECK_SAY(count.inside > 200 && count.misses > 50, "%d inside, %d misses", count.inside,
                  count.misses);
    }
}

/* Starts on the surface. */
static void V2_convex_from_surface(void) {
    for (int variant = 0; variant < SURFACE_VARIANTS; ++variant) {
        const convex_count round = convex_of(surface_world_named("sphere"), variant, spt_adaptive(),
                                             128, SPT_SKIP_START, 0, AT_SURFACE);
        const convex_count flat = convex_of(surface_world_named("dodecahedron"), variant,
                                            spt_basic(), 128, SPT_SKIP_START, 1, AT_SURFACE);
        CHECK_SAY(round.inside > 200 && flat.inside > 200, "%d and %d inside", round.inside,
                  flat.inside);
        /* Rays from outside that come to the bound, and so begin, within the tolerance. */
        const convex_count tight = convex_of(surface_world_named("tight sphere"), variant,
                                             spt_adaptive(), 128, SPT_SKIP_START, 0, 0);
        CHECK_SAY(tight.misses < SURFACE_RAYS / 2, "%d misses", tight.misses);
        CHECK_SAY(round.misses > 200 && flat.misses > 200, "%d and %d misses", round.misses,
                  flat.misses);
    }
}

/* Bodies that are not convex, or stick out of their bounds, and budgets that end on the way. */
static void V3_convex_betrayed(void) {
    int limits = 0;
    for (int variant = 0; variant < SURFACE_VARIANTS; ++variant) {
        convex_count count = convex_of(surface_world_named("cut sphere"), variant, spt_adaptive(),
                                       128, 0, variant == 2, 0.6);
        /* With the least epsilon all are traced forward from the first. */
        CHECK_SAY(variant == 3 ? count.betrayed == 0 : count.betrayed > 50, "%d betrayed",
                  count.betrayed);
        count = convex_of(surface_world_named("torus"), variant, spt_relaxed(), 128, SPT_SKIP_START,
                          0, AT_SURFACE);
        CHECK(count.inside > 50);
    }
    for (uint32_t budget = 0; budget < 8; ++budget) {
        const uint32_t flags = budget % 2 != 0 ? (uint32_t)SPT_SKIP_START : 0u;
        const double inside = flags != 0 ? (double)AT_SURFACE : 0.6;
        limits += convex_of(surface_world_named("cut sphere"), 1, spt_adaptive(), budget, flags, 1,
                            inside)
                      .limits;
    }
    CHECK_SAY(limits > 500, "%d rays out of budget", limits);
    /* What the guards are for. */
    convex_of(surface_world_named("broken sphere"), 2, spt_adaptive(), 128, 0, 1, 0.6);
    convex_of(surface_world_named("broken sphere"), 1, spt_basic(), 128, SPT_SKIP_START, 1, 0.6);
}

void suite_reverse_glsl(void) {
    RUN(V1_convex);
    RUN(V2_convex_from_surface);
    RUN(V3_convex_betrayed);
}
