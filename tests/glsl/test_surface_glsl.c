/* SPDX-License-Identifier: MIT
 *
 * The GLSL of the surface room against its C code, function by function, on rays and hits that C
 * traced. Everything is compared bit by bit: all of it is + - * / sqrt, and where C takes another
 * way (lengths and gradients in units of a power of two) that costs no bit. */
#include "glsl_check.h"
#include "surface_glsl_world.h"

#include <math.h>
#include <stdio.h>

static surface_case traced;
static float answers[SURFACE_RAYS][SURFACE_RESULTS];

/* Draws and traces rays, a tenth of them from inside, many of which must hit. */
static void trace_variant(const surface_world *world, int variant) {
    int hits = 0;
    surface_set_variant(&traced, world, variant);
    if (variant == 1) traced.settings.flags = SPT_STOP_INSIDE;
    surface_draw(&traced, 0.1);
    surface_trace(&traced);
    for (int i = 0; i < SURFACE_RAYS; ++i) hits += traced.hits[i].outcome == SPT_HIT;
    CHECK_SAY(hits > SURFACE_RAYS / 8, "%d hits", hits);
}

/* Compares a vector of the answers; -0 is 0, since C begins its sums with 0. */
static void check_vector(int ray, int at, const float expected[3], const char *what) {
    for (int axis = 0; axis < 3; ++axis) {
        const float glsl = answers[ray][at + axis] + 0.0f, c = expected[axis] + 0.0f;
        CHECK_SAY(check_same_bits(glsl, c), "%s of ray %d, axis %d: %.9g, in C %.9g", what, ray,
                  axis, (double)glsl, (double)c);
    }
}

/* ---- Hits ----------------------------------------------------------------------------------- */

/* What spt_normals() takes for the size of the least features where it is told 0. */
static double usual_detail(const spt_field *field) {
    float low[3], high[3], least = 1.0f;
    if (field->bound == NULL) return 1;
    CHECK(spt_bound_extent(field->bound, low, high) == SPT_OK);
    for (int axis = 0; axis < 3; ++axis) least = fminf(least, (high[axis] - low[axis]) / 4);
    return (double)least;
}

static void normals_of(const surface_world *world, int variant, float detail) {
    static float expected[SURFACE_RAYS][3];
    const spt_vector_sinks sinks = spt_vector_sinks_of(expected[0]);
    const spt_field *const last = &world->fields[world->count - 1];
    char statements[256];
    trace_variant(world, variant);
    const spt_rays rays = surface_rays(&traced);
    const spt_hits hits = surface_hits(&traced);
    CHECK(spt_normals(world->fields, world->count, &traced.settings, SPT_NORMAL_CENTRAL, detail,
                      SURFACE_RAYS, &rays, &hits, &sinks) == SPT_OK);
    snprintf(statements, sizeof statements,
             "    float detail = %s ? float(%.9g) : float(%.9g);\n"
             "    r[0] = vec4(spt_hit_normal(ray, hit, detail), 0.0);\n",
             world->count > 1 ? "hit.component == 0" : "true",
             detail > 0.0f ? (double)detail : usual_detail(world->fields),
             detail > 0.0f ? (double)detail : usual_detail(last));
    if (!surface_ask(&traced, SPT_GLSL_NORMAL, statements, answers)) return;
    for (int i = 0; i < SURFACE_RAYS; ++i) check_vector(i, 0, expected[i], "normal");
}

static void S1_normals(void) {
    for (int index = 0; index < SURFACE_WORLDS; ++index) {
        for (int variant = 0; variant < SURFACE_VARIANTS; ++variant) {
            normals_of(surface_world_of(index), variant, variant == 1 ? 0.01f : 0.0f);
        }
    }
}

/* Of any points, up to where a step is the last place of a coordinate. */
static void S2_normals_far_away(void) {
    static float expected[SURFACE_RAYS][3];
    const spt_vector_sinks sinks = spt_vector_sinks_of(expected[0]);
    surface_set_variant(&traced, surface_world_named("box"), 0);
    surface_draw(&traced, 0);
    for (int i = 0; i < SURFACE_RAYS; ++i) {
        traced.hits[i].t = 0;
        traced.hits[i].outcome = SPT_HIT;
        for (int axis = 0; axis < 3; ++axis) {
            traced.rays[i].origin[axis] *= (float)pow(10, check_uniform(-1, 12));
        }
    }
    const spt_rays rays = surface_rays(&traced);
    const spt_hits hits = surface_hits(&traced);
    CHECK(spt_normals(traced.world->fields, 1, &traced.settings, SPT_NORMAL_CENTRAL, 0.001f,
                      SURFACE_RAYS, &rays, &hits, &sinks) == SPT_OK);
    if (!surface_ask(&traced, SPT_GLSL_NORMAL,
                     "    r[0] = vec4(spt_hit_normal(ray, hit, 0.001), 0.0);\n", answers)) {
        return;
    }
    for (int i = 0; i < SURFACE_RAYS; ++i) check_vector(i, 0, expected[i], "normal");
}

/* Where there is none, it is (0, 0, 0): in the middle of the ball, and where f is not finite; and
 * neither steps nor gradients of any size over- or underflow. */
static void S2_no_normals(void) {
    static const float gradients[6][3] = {{0, 0, 0},      {INFINITY, 1, 0}, {3e-20f, 4e-20f, 0},
                                          {0, -1e30f, 0}, {NAN, 1, 0},      {0, 0, 2e38f}};
    static const float expected[6][3] = {{0, 0, 0},  {0, 0, 0}, {0.6f, 0.8f, 0},
                                         {0, -1, 0}, {0, 0, 0}, {0, 0, 1}};
    surface_set_variant(&traced, surface_world_named("sphere"), 0);
    surface_draw(&traced, 0);
    for (int i = 0; i < 6; ++i) {
        for (int axis = 0; axis < 3; ++axis) traced.rays[i].origin[axis] = gradients[i][axis];
    }
    if (!surface_ask(&traced, SPT_GLSL_NORMAL,
                     "    r[0] = vec4(spt_unit(ray.origin), 0.0);\n"
                     "    r[1] = vec4(spt_normal(vec3(0.0), 0.0078125), 0.0);\n",
                     answers)) {
        return;
    }
    for (int i = 0; i < 6; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            /* A root and a division of it: two units in the last place of 1 are ample. */
            CHECK_SAY(fabsf(answers[i][axis] - expected[i][axis]) <= 0x1p-23f, "%d: %.9g", i,
                      (double)answers[i][axis]);
            CHECK(answers[i][4 + axis] == 0.0f); /* f is even there: all differences are 0 */
        }
    }
}

static void refined_of(const surface_world *world, int variant, int iterations) {
    static spt_hit before[SURFACE_RAYS];
    char statements[256];
    int moved = 0;
    trace_variant(world, variant);
    for (int i = 0; i < SURFACE_RAYS; i += 8) { /* which a move must not pass */
        if (traced.hits[i].outcome != SPT_HIT) continue;
        if (i % 16 == 0) traced.rays[i].t_min = traced.hits[i].t;
        if (i % 16 == 8) traced.rays[i].t_max = traced.hits[i].t;
    }
    snprintf(statements, sizeof statements,
             "    spt_refine(ray, hit, %d);\n"
             "    r[0] = vec4(hit.t, hit.residual, float(hit.evaluations), float(hit.outcome));\n",
             iterations);
    if (!surface_ask(&traced, SPT_GLSL_REFINE, statements, answers)) return;
    for (int i = 0; i < SURFACE_RAYS; ++i) before[i] = traced.hits[i];
    const spt_rays rays = surface_rays(&traced);
    const spt_hits hits = surface_hits(&traced);
    CHECK(spt_refine(world->fields, world->count, &traced.settings, (uint32_t)iterations,
                     SURFACE_RAYS, &rays, &hits) == SPT_OK);
    for (int i = 0; i < SURFACE_RAYS; ++i) {
        const spt_hit *const hit = &traced.hits[i];
        CHECK_SAY(surface_agrees(answers[i][0], hit->t),
                  "t of ray %d: %.9g, in C %.9g, before %.9g", i, (double)answers[i][0],
                  (double)hit->t, (double)before[i].t);
        CHECK_SAY(surface_agrees(answers[i][1], hit->residual),
                  "residual of ray %d: %.9g, in C %.9g", i, (double)answers[i][1],
                  (double)hit->residual);
        CHECK(answers[i][2] == (float)hit->evaluations && answers[i][3] == (float)hit->outcome);
        moved += hit->t < before[i].t || hit->t > before[i].t;
    }
    /* Flat bodies of exact distance are hit where they are. */
    CHECK_SAY(moved > SURFACE_RAYS / 32 || traced.settings.pixel_radius <= 0.0f,
              "%d hits were moved", moved);
}

static void S3_refined_hits(void) {
    for (int index = 0; index < SURFACE_WORLDS; ++index) {
        for (int variant = 0; variant < SURFACE_VARIANTS; ++variant) {
            refined_of(surface_world_of(index), variant, variant == 2 ? 16 : 3);
        }
    }
}

/* ---- Secondary rays ------------------------------------------------------------------------- */

static void offsets_of(const surface_world *world, int variant, uint32_t checks) {
    static float expected[SURFACE_RAYS][3], path[SURFACE_RAYS];
    char statements[512], call[64];
    trace_variant(world, variant);
    for (int i = 0; i < SURFACE_RAYS; i += 4) { /* hits that are not trusted, and no normals */
        traced.hits[i].residual *= (float)check_uniform(-6, 6);
        for (int axis = 0; axis < 3; ++axis) {
            traced.normals[i][axis] *= i % 16 == 0 ? 0.125f : i % 16 == 4 ? 3.0f : 1.0f;
        }
    }
    const spt_rays rays = surface_rays(&traced);
    const spt_hits hits = surface_hits(&traced);
    const spt_vectors normals = spt_vectors_of(traced.normals[0]);
    const spt_column cross = {traced.cross, (ptrdiff_t)sizeof *traced.cross};
    spt_starts starts = {spt_vector_sinks_of(expected[0]), {path, (ptrdiff_t)sizeof *path}, {0}};
    CHECK(spt_offset(world->fields, world->count, &traced.settings, SURFACE_RAYS, &rays, &hits,
                     &normals, &cross, checks, &starts) == SPT_OK);
    snprintf(call, sizeof call,
             checks == 0 ? "spt_offset(ray, hit, normal, q[4].w > 0.5)"
                         : "spt_offset_checked(ray, hit, normal, q[4].w > 0.5, "
                           "%d)",
             (int)checks);
    snprintf(statements, sizeof statements,
             "    r[0] = vec4(%s, 0.0);\n    r[1].x = spt_travelled(ray, hit.t);\n", call);
    if (!surface_ask(&traced, SPT_GLSL_OFFSET, statements, answers)) return;
    for (int i = 0; i < SURFACE_RAYS; ++i) {
        if (traced.hits[i].outcome != SPT_HIT) continue; /* C leaves the others as they are */
        check_vector(i, 0, expected[i], "origin");
        CHECK_SAY(check_same_bits(answers[i][4], path[i]), "path of ray %d: %.9g, in C %.9g", i,
                  (double)answers[i][4], (double)path[i]);
    }
}

static void S4_offsets(void) {
    for (int index = 0; index < SURFACE_WORLDS; ++index) {
        for (int variant = 0; variant < SURFACE_VARIANTS; ++variant) {
            offsets_of(surface_world_of(index), variant, variant == 2 ? 4 : 0);
        }
    }
}

/* ---- Light ---------------------------------------------------------------------------------- */

static void shadows_of(const surface_world *world, int variant, const spt_method *method) {
    static float ratios[SURFACE_RAYS], seen[SURFACE_RAYS];
    const float tangent = 0.25f;
    const spt_column column = {&tangent, 0};
    const spt_sink sink = {seen, (ptrdiff_t)sizeof *seen};
    int partly = 0;
    surface_set_variant(&traced, world, variant);
    traced.settings.method = method;
    surface_draw(&traced, 0);
    check_context("%s, variant %d, %s", world->name, variant, spt_method_name(method));
    if (!surface_ask(&traced, SPT_GLSL_SHADOW,
                     "    r[0] = vec4(spt_soft_shadow(ray, 0.25, 128));\n", answers))
        return;
    const spt_rays rays = surface_rays(&traced);
    for (int i = 0; i < SURFACE_RAYS; ++i) ratios[i] = 1.0f;
    for (size_t field = 0; field < world->count; ++field) {
        CHECK(spt_soft_shadow(&world->fields[field], &traced.settings, &column, 1, SURFACE_RAYS,
                              &rays, &sink, NULL) == SPT_OK);
        /* Of a scene the least counts; smoothing keeps the order. */
        for (int i = 0; i < SURFACE_RAYS; ++i) ratios[i] = fminf(ratios[i], seen[i]);
    }
    for (int i = 0; i < SURFACE_RAYS; ++i) {
        CHECK_SAY(check_same_bits(answers[i][0], ratios[i]), "ray %d sees %.9g, in C %.9g", i,
                  (double)answers[i][0], (double)ratios[i]);
        partly += ratios[i] > 0.01f && ratios[i] < 0.99f;
    }
    CHECK_SAY(partly > 20, "%d in the penumbra", partly);
}

static void S5_soft_shadows(void) {
    const spt_method *const methods[] = {spt_basic(), spt_relaxed(), spt_enhanced(),
                                         spt_auto_relaxed(), spt_adaptive()};
    for (int index = 0; index < SURFACE_WORLDS; ++index) {
        shadows_of(surface_world_of(index), index % SURFACE_VARIANTS, methods[index % 5]);
    }
}

/* Returns how many points are open in part. */
static int occlusion_of(const surface_world *world, int samples, float distance) {
    static float points[SURFACE_RAYS][3], expected[SURFACE_RAYS];
    const spt_sink sink = {expected, (ptrdiff_t)sizeof *expected};
    const spt_vectors normals = spt_vectors_of(traced.normals[0]);
    const spt_vectors columns = spt_vectors_of(points[0]);
    char statements[256];
    int partly = 0;
    trace_variant(world, 0);
    for (int i = 0; i < SURFACE_RAYS; ++i) {
        const spt_ray *const ray = &traced.rays[i];
        const float t = traced.hits[i].outcome == SPT_HIT ? traced.hits[i].t : 0.0f;
        for (int axis = 0; axis < 3; ++axis) {
            points[i][axis] = ray->origin[axis] + t * ray->direction[axis];
            traced.rays[i].origin[axis] = points[i][axis]; /* what the shader is given */
        }
    }
    snprintf(statements, sizeof statements,
             "    r[0] = vec4(spt_ambient_occlusion(q[0].xyz, normal, float(%.9g), %d));\n",
             (double)distance, samples);
    if (!surface_ask(&traced, SPT_GLSL_OCCLUSION, statements, answers)) return 0;
    CHECK(spt_ambient_occlusion(world->fields, world->count, (uint32_t)samples, distance,
                                SURFACE_RAYS, &columns, &normals, &sink) == SPT_OK);
    for (int i = 0; i < SURFACE_RAYS; ++i) {
        CHECK_SAY(check_same_bits(answers[i][0], expected[i]), "ray %d: %.9g, in C %.9g", i,
                  (double)answers[i][0], (double)expected[i]);
        partly += expected[i] > 0.01f && expected[i] < 0.99f;
    }
    return partly;
}

static void S6_occlusion(void) {
    int partly = 0;
    for (int index = 0; index < SURFACE_WORLDS; ++index) {
        const int samples = index == 0 ? 16 : index == 1 ? 1 : 5;
        partly += occlusion_of(surface_world_of(index), samples, 0.125f);
        partly += occlusion_of(surface_world_of(index), 5, 0.3f);
    }
    CHECK_SAY(partly > SURFACE_RAYS, "%d points are partly open", partly);
}

void suite_surface_glsl(void) {
    RUN(S1_normals);
    RUN(S2_normals_far_away);
    RUN(S2_no_normals);
    RUN(S3_refined_hits);
    RUN(S4_offsets);
    RUN(S5_soft_shadows);
    RUN(S6_occlusion);
}
