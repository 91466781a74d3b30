/* SPDX-License-Identifier: MIT
 *
 * The idea introduced here: a surface is a function that returns a distance. One ray against one
 * callback; the exit status says whether the answer was right. */
/* README: begin */
#include <spheretrace/spheretrace.h>

#include <math.h>
#include <stdio.h>

/* Signed distance to a ball of radius 1 at the origin. */
static float ball(void *user, float x, float y, float z) {
    (void)user;
    return sqrtf(x * x + y * y + z * z) - 1.0f;
}

int main(void) {
    spt_field field = spt_field_default();
    field.point = ball;
    const spt_settings settings = spt_settings_default();
    const spt_ray ray = {{0.0f, 0.6f, -3.0f}, 0.0f, {0.0f, 0.0f, 1.0f}, INFINITY};
    spt_hit hit;
    const spt_rays rays = spt_rays_of(&ray);
    const spt_hits hits = spt_hits_of(&hit);
    if (spt_trace(&field, &settings, 1, &rays, &hits, NULL) != SPT_OK) return 1;
    if (hit.outcome != SPT_HIT) return 1;
    printf("t = %.4f after %u evaluations\n", (double)hit.t, hit.evaluations);
    /* It enters the ball at z = -0.8 and stops within epsilon of it, seen at a cosine of 0.8. */
    return fabsf(hit.t - 2.2f) < settings.epsilon / 0.8f ? 0 : 1;
}
/* README: end */
