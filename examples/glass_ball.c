/* SPDX-License-Identifier: MIT
 *
 * The idea introduced here: a ray goes on. Where it meets glass it is refracted, starts anew inside,
 * safely off the surface, and is marched to the way out. All rays take each step together. */
#include <spheretrace/spheretrace.h>

#include <math.h>
#include <stdio.h>

enum { rays = 64 };

/* Of radius 1. */
static float ball(void *user, float x, float y, float z) {
    (void)user;
    return sqrtf(x * x + y * y + z * z) - 1.0f;
}

/* Snell's law for unit vectors and a normal against the ray. */
static void refract(const float in[3], const float normal[3], float ratio, float out[3]) {
    float cosine = 0.0f;
    for (int axis = 0; axis < 3; ++axis) cosine -= in[axis] * normal[axis];
    const float along = ratio * cosine - sqrtf(1.0f - ratio * ratio * (1.0f - cosine * cosine));
    for (int axis = 0; axis < 3; ++axis) out[axis] = ratio * in[axis] + along * normal[axis];
}

/* README: begin */
/* Traces rays to the glass, and within it to where they leave. Returns 0 if something is refused. */
static int pass_through(const spt_field *glass, const spt_settings *settings, spt_ray *outside,
                        spt_ray *inside, spt_hit *hits) {
    static float normals[rays][3], path[rays];
    static int32_t start[rays];
    const int32_t cross = 1; /* one value for all: to the other side of the surface */
    const spt_column crossing = {&cross, 0};
    const spt_rays in = spt_rays_of(outside), on = spt_rays_of(inside);
    const spt_hits found = spt_hits_of(hits);
    const spt_vectors normal = spt_vectors_of(normals[0]);
    const spt_vector_sinks to_normals = spt_vector_sinks_of(normals[0]);
    spt_starts starts = {spt_vector_sinks_of(inside[0].origin), {path, 4}, {start, 4}};
    for (int axis = 0; axis < 3; ++axis) starts.origin.axis[axis].stride = sizeof *inside;

    if (spt_trace(glass, settings, rays, &in, &found, NULL) != SPT_OK) return 0;
    if (spt_normals(glass, 1, settings, SPT_NORMAL_CENTRAL, 0, rays, &in, &found, &to_normals) !=
        SPT_OK) {
        return 0;
    }
    /* New origins, twice the tolerance inside, each looked at with up to four evaluations. */
    if (spt_offset(glass, 1, settings, rays, &in, &found, &normal, &crossing, 4, &starts) !=
        SPT_OK) {
        return 0;
    }
    for (int i = 0; i < rays; ++i) {
        if (hits[i].outcome != SPT_HIT || start[i] != SPT_START_CLEAR) return 0;
        refract(outside[i].direction, normals[i], 1.0f / 1.5f, inside[i].direction);
        inside[i].t_min = 0.0f;
        inside[i].t_max = INFINITY;
    }
    /* The body is convex: its exit is found from behind. */
    return spt_trace_convex(glass, settings, rays, &on, &found, NULL) == SPT_OK;
}
/* README: end */

int main(void) {
    static spt_ray outside[rays], inside[rays];
    static spt_hit hits[rays];
    const spt_bound around = spt_bound_sphere(0.0f, 0.0f, 0.0f, 1.25f);
    spt_field glass = spt_field_default();
    spt_settings settings = spt_settings_default();
    float worst = 0.0f;
    int evaluations = 0;
    glass.point = ball;
    glass.bound = &around;
    glass.flags = SPT_FIELD_CONVEX;
    settings.epsilon = 1e-5f;
    for (int i = 0; i < rays; ++i) {
        const spt_ray ray = {{0.9f * (float)i / rays, 0.0f, -3.0f}, 0.0f, {0, 0, 1}, INFINITY};
        outside[i] = ray;
    }
    if (!pass_through(&glass, &settings, outside, inside, hits)) return 1;
    for (int i = 0; i < rays; ++i) {
        /* In closed form: seen from the center, a chord at the angle b to the radius spans pi - 2 b,
         * so a ray that comes in at the angle a leaves at 2 b - a. */
        const float a = asinf(outside[i].origin[0]), b = asinf(outside[i].origin[0] / 1.5f);
        const float x = inside[i].origin[0] + hits[i].t * inside[i].direction[0];
        const float z = inside[i].origin[2] + hits[i].t * inside[i].direction[2];
        const float apart = hypotf(x - sinf(2.0f * b - a), z - cosf(2.0f * b - a));
        worst = apart > worst ? apart : worst;
        evaluations += (int)hits[i].evaluations;
    }
    printf("the way out, by %.1f evaluations a ray, at most %.0e off\n", (double)evaluations / rays,
           (double)worst);
    /* A hit within epsilon, at a cosine of at least 0.43 here, moves the exit by a few of them. */
    return worst < 10.0f * settings.epsilon ? 0 : 1;
}
