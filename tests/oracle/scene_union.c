/* SPDX-License-Identifier: MIT
 *
 * The slow union in double. Rays advance side by side, so that a component is asked for many at
 * once. */
#include "scene_union.h"
#include "tolerance.h"
#include "../check.h"

#include <math.h>
#include <string.h>

enum { most_steps = 10000, block = 128, most_components = 128 };

/* Least step: t is off by no more. It is 1/5 of the least tolerance. */
static const double stride = 2e-5;

typedef struct march {
    const scene_ray *ray;
    union_truth *truth;
    double length, t, t_max;
    double before; /* the t of the sample before */
    double close;  /* where the distance fell below the gap and has stayed so, or +infinity */
    signed char side[most_components];
    int behind; /* it is behind the surface, on the way to deep */
} march;

/* The distance to the nearest component, and by how much the next one is farther. */
typedef struct nearest {
    double distance, second;
    int32_t component;
} nearest;

static void ask(const union_field *field, size_t count, march *const *live, int first,
                nearest *found) {
    double x[block], y[block], z[block], f[block];
    for (size_t i = 0; i < count; ++i) {
        const spt_ray *ray = &live[i]->ray->ray;
        x[i] = (double)ray->origin[0] + live[i]->t * (double)ray->direction[0];
        y[i] = (double)ray->origin[1] + live[i]->t * (double)ray->direction[1];
        z[i] = (double)ray->origin[2] + live[i]->t * (double)ray->direction[2];
        found[i].distance = found[i].second = HUGE_VAL;
        found[i].component = -1;
    }
    for (size_t component = 0; component < field->count; ++component) {
        field->values(field->user, component, count, x, y, z, f);
        for (size_t i = 0; i < count; ++i) {
            double distance = f[i] / (double)field->fields[component].lipschitz;
            if (first) {
                live[i]->side[component] = distance < 0 ? -1 : 1;
                if (distance < 0) live[i]->truth->inside = 1;
            }
            distance *= live[i]->side[component];
            if (distance < found[i].distance) {
                found[i].second = found[i].distance;
                found[i].distance = distance;
                found[i].component = (int32_t)component;
            } else if (distance < found[i].second) {
                found[i].second = distance;
            }
        }
    }
}

static double tolerance_of(const spt_settings *settings, const march *m) {
    const double seen = (double)m->ray->path + m->t * m->length;
    return fmax(oracle_tolerance(settings, &m->ray->ray, m->t),
                (double)settings->pixel_radius * seen);
}

/* One sample. 0: all is known. */
static int advance(const spt_settings *settings, march *m, const nearest *found) {
    union_truth *truth = m->truth;
    const double tolerance = tolerance_of(settings, m);
    const double floor_here = 2 * oracle_floor(settings, &m->ray->ray, m->t);
    const double distance = found->distance;
    if (distance < union_gap && !(m->close < HUGE_VAL)) m->close = m->t;
    if (distance < tolerance + floor_here && !(truth->near < HUGE_VAL)) truth->near = m->before;
    if (!m->behind && distance < stride) {
        m->behind = 1;
        truth->t = m->t;
        truth->component = found->component;
        truth->lead = found->second - distance;
    }
    if (m->behind) {
        truth->deep = m->t;
        if (distance < -tolerance - floor_here) return 0;
        if ((m->t - truth->near) * m->length > 0.05) truth->clear = 0;
        if (!truth->clear) return 0;
    } else if (distance >= union_gap && m->close < HUGE_VAL) {
        truth->clear = 0; /* it grazed something */
        return 0;
    }
    m->before = m->t;
    m->t += fmax(fabs(distance) / 2, stride) / m->length;
    return m->t <= m->t_max;
}

/* Where the ray ended. */
static void finish(march *m) {
    union_truth *truth = m->truth;
    const double end = (m->t_max - truth->t) * m->length;
    if (!m->behind) {
        /* t_max just before a surface, or too far to look for one */
        if (m->close < HUGE_VAL || !(m->ray->ray.t_max <= FLT_MAX)) truth->clear = 0;
    } else if (!(end > 0.05)) {
        truth->clear = 0;
    }
}

static void find_block(const union_field *field, const spt_settings *settings, size_t count,
                       march *marches) {
    march *live[block];
    nearest found[block];
    size_t left = 0;
    for (size_t i = 0; i < count; ++i) {
        if (marches[i].t <= marches[i].t_max) live[left++] = &marches[i];
    }
    for (int step = 0; step < most_steps && left > 0; ++step) {
        size_t kept = 0;
        ask(field, left, live, step == 0, found);
        for (size_t i = 0; i < left; ++i) {
            if (step == 0 && !(found[i].distance > union_gap)) live[i]->truth->clear = 0;
            if (live[i]->truth->clear && advance(settings, live[i], &found[i])) {
                live[kept++] = live[i];
            } else {
                finish(live[i]);
            }
        }
        left = kept;
    }
    for (size_t i = 0; i < left; ++i) live[i]->truth->clear = 0; /* undecided */
}

void union_find_truth(const union_field *field, const spt_settings *settings, size_t count,
                      const scene_ray *rays, union_truth *truth) {
    static march marches[block];
    CHECK(field->count <= most_components);
    for (size_t first = 0; first < count; first += block) {
        const size_t size = count - first < block ? count - first : block;
        for (size_t i = 0; i < size; ++i) {
            const union_truth unknown = {HUGE_VAL, HUGE_VAL, HUGE_VAL, HUGE_VAL, -1, 0, 1};
            march *m = &marches[i];
            memset(m, 0, sizeof *m);
            m->ray = &rays[first + i];
            m->truth = &truth[first + i];
            *m->truth = unknown;
            m->length = oracle_length(&m->ray->ray);
            m->t = m->before = (double)m->ray->ray.t_min;
            m->t_max = (double)m->ray->ray.t_max;
            if (!(m->t_max <= (double)FLT_MAX)) m->t_max = 200 / m->length;
            m->close = HUGE_VAL;
        }
        find_block(field, settings, size, marches);
    }
}

/* At a hit its component is within the tolerance and the rounding of a float. */
static double distance_at(const union_field *field, const scene_ray *ray, const spt_hit *hit) {
    double p[3], f;
    for (int axis = 0; axis < 3; ++axis) {
        p[axis] = (double)ray->ray.origin[axis] + (double)hit->t * (double)ray->ray.direction[axis];
    }
    field->values(field->user, (size_t)hit->component, 1, &p[0], &p[1], &p[2], &f);
    return fabs(f) / (double)field->fields[hit->component].lipschitz;
}

static void check_hit(const union_field *field, const spt_settings *settings, const scene_ray *ray,
                      const union_truth *truth, const spt_hit *hit) {
    const double length = oracle_length(&ray->ray), t = (double)hit->t;
    const double world = truth->t * length;
    march at = {0};
    at.ray = ray;
    at.length = length;
    at.t = t;
    CHECK_SAY(truth->near <= t && t <= truth->deep, "t %.9g, truth %.9g in [%.9g, %.9g]", t,
              truth->t, truth->near, truth->deep);
    CHECK_SAY(t * length <= world + 2e-3 * (1 + world) && fabs(t - truth->t) * length < 0.05,
              "t %.9g, truth %.9g", t, truth->t);
    CHECK_SAY(hit->component >= 0 && (size_t)hit->component < field->count, "component %d",
              hit->component);
    if (hit->component < 0 || (size_t)hit->component >= field->count) return;
    CHECK_SAY(distance_at(field, ray, hit) <
                  tolerance_of(settings, &at) + 2 * oracle_floor(settings, &ray->ray, t),
              "component %d is %.9g away", hit->component, distance_at(field, ray, hit));
    /* Within 0.05 of the truth no distance changes by more: the others are still farther than the
     * tolerance, which is below 0.02. */
    CHECK_SAY(hit->component == truth->component || truth->lead < 0.07, "component %d, truth %d",
              hit->component, truth->component);
}

size_t union_check(const union_field *field, const spt_settings *settings, size_t count,
                   const scene_ray *rays, const union_truth *truth, const spt_hit *hits,
                   size_t *hit_count) {
    size_t clear = 0;
    *hit_count = 0;
    for (size_t i = 0; i < count; ++i) {
        const int hit = truth[i].t < HUGE_VAL;
        if (!truth[i].clear) continue;
        ++clear;
        *hit_count += hit != 0;
        CHECK_SAY(hits[i].outcome == (hit ? SPT_HIT : SPT_MISS),
                  "ray %lu: outcome %d at %.9g, truth %.9g", (unsigned long)i, hits[i].outcome,
                  (double)hits[i].t, truth[i].t);
        if (hit && hits[i].outcome == SPT_HIT) {
            check_hit(field, settings, &rays[i], &truth[i], &hits[i]);
        } else if (!hit) {
            CHECK(hits[i].component == -1);
        }
    }
    return clear;
}
