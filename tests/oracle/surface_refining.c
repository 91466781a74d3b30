/* SPDX-License-Identifier: MIT
 *
 * One hit to be refined: see surface_refining.h. */
#include "surface_refining.h"
#include "../check.h"

#include <spheretrace/surface.h>

#include <math.h>

/* A field that counts what is asked of it. */
typedef struct counted {
    const reference_field *field;
    uint32_t calls;
} counted;

static float counted_point(void *user, float x, float y, float z) {
    counted *self = user;
    const real position[3] = {(real)x, (real)y, (real)z};
    ++self->calls;
    return (float)self->field->distance(self->field->user, position);
}

double refining_allowance(const refining_task *what, double t) {
    const double reach = what->path + t * oracle_length(&what->ray);
    return (double)what->settings->pixel_radius * reach;
}

double refining_off(const refining_task *what, double t, double f) {
    return what->side * f / (double)what->field->lipschitz - refining_allowance(what, t);
}

/* What rounding makes of it: f / lipschitz and the allowance are each a few operations. */
static double off_rounding(const refining_task *what, double t, double f) {
    return 0x1p-21 * (fabs(f) / (double)what->field->lipschitz + refining_allowance(what, t));
}

/* f at the float position that t stands for, as the callback gives it. */
static float value_at(const refining_task *what, float t) {
    real position[3];
    for (int axis = 0; axis < 3; ++axis) {
        const float along = t * what->ray.direction[axis];
        position[axis] = (real)(what->ray.origin[axis] + along);
    }
    return (float)what->field->distance(what->field->user, position);
}

double refining_iterate(const refining_task *what, double t, double f, uint32_t rounds) {
    double apart = refining_off(what, t, f);
    for (uint32_t i = 0; i < rounds; ++i) {
        const double moved = t + apart / oracle_length(&what->ray);
        const double next = fmin(fmax(moved, (double)what->ray.t_min), (double)what->ray.t_max);
        double p[3], value;
        surface_point(&what->ray, next, p);
        {
            const real position[3] = {(real)p[0], (real)p[1], (real)p[2]};
            value = (double)what->field->distance(what->field->user, position);
        }
        if (!(fabs(refining_off(what, next, value)) < fabs(apart))) break;
        t = next;
        apart = refining_off(what, next, value);
    }
    return t;
}

spt_hit refining_hit(const refining_task *what, float t) {
    spt_hit hit = {0, 0, SPT_HIT, 7, 0, 0, 0, 0, 0};
    hit.t = t;
    hit.residual = value_at(what, t);
    if (what->side < 0) hit.flags = SPT_FLAG_INSIDE;
    return hit;
}

spt_hit refining_run(const surface_run *run, const refining_task *what, uint32_t rounds,
                     const spt_hit *before) {
    const spt_settings settings = surface_settings(run, what->settings);
    const float path = (float)what->path;
    spt_field field = surface_field(run, what->field, 0);
    spt_rays rays = spt_rays_of(&what->ray);
    spt_hit hit = *before;
    const spt_hits hits = spt_hits_of(&hit);
    counted count = {NULL, 0};
    count.field = what->field;
    if (run->point) {
        field.point = counted_point;
        field.user = &count;
    }
    rays.path.first = &path;
    CHECK(spt_refine(&field, 1, &settings, rounds, 1, &rays, &hits) == SPT_OK);
    if (run->point) {
        CHECK_SAY(hit.evaluations - before->evaluations == count.calls, "%u for %u",
                  hit.evaluations - before->evaluations, count.calls);
    }
    return hit;
}

void refining_check(const refining_task *what, uint32_t rounds, const spt_hit *before,
                    const spt_hit *after) {
    const double t0 = (double)before->t, t1 = (double)after->t, f0 = (double)before->residual,
                 f1 = (double)after->residual;
    CHECK_SAY(fabs(refining_off(what, t1, f1)) <= fabs(refining_off(what, t0, f0)) +
                                                      off_rounding(what, t0, f0) +
                                                      off_rounding(what, t1, f1),
              "off by %g, before %g", refining_off(what, t1, f1), refining_off(what, t0, f0));
    CHECK_SAY(after->t >= what->ray.t_min && after->t <= what->ray.t_max, "%.9g", t1);
    CHECK(check_same_bits(after->residual, value_at(what, after->t)));
    CHECK(after->evaluations - before->evaluations <= rounds);
    if (rounds == 1) {
        const double most =
            fabs(f0) / (double)what->field->lipschitz + refining_allowance(what, t0);
        const double moved = fabs(t1 - t0) * oracle_length(&what->ray);
        CHECK_SAY(moved <= most + off_rounding(what, t0, f0) + surface_rounding(&what->ray, t1),
                  "moved %g of %g", moved, most);
    }
    CHECK(after->outcome == before->outcome && after->flags == before->flags &&
          after->component == before->component && after->fallbacks == before->fallbacks &&
          check_same_bits(after->candidate_t, before->candidate_t) &&
          check_same_bits(after->candidate_ratio, before->candidate_ratio));
}
