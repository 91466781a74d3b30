/* SPDX-License-Identifier: MIT
 *
 * Solids with many crossings: see surface_solids.h. */
#include "surface_solids.h"
#include "../check.h"

#include <math.h>
#include <string.h>

static double solid_distance(const surface_solid *solid, const double p[3]) {
    double least = HUGE_VAL;
    if (!solid->shells) {
        const surface_group group = {solid->bodies, solid->count};
        return surface_group_distance(&group, p, NULL);
    }
    for (size_t i = 0; i + 1 < solid->count; i += 2) {
        const double outer = surface_distance(&solid->bodies[i], p),
                     inner = surface_distance(&solid->bodies[i + 1], p);
        least = fmin(least, fmax(outer, -inner));
    }
    return least;
}

static real solid_value(const void *user, const real position[3]) {
    const surface_solid *solid = user;
    const double p[3] = {position[0], position[1], position[2]};
    return (real)(solid->factor * solid_distance(solid, p));
}

reference_field solid_field(const surface_solid *solid) {
    reference_field field = {solid_value, NULL, 1};
    field.user = solid;
    field.lipschitz = (real)fabs(solid->factor);
    return field;
}

surface_solid solid_empty(void) {
    surface_solid solid;
    memset(&solid, 0, sizeof solid);
    solid.factor = 1;
    return solid;
}

static surface_body plate(double z, double thickness) {
    const analytic_shape shape = {ANALYTIC_BOX, 0, 0, {9, 9, thickness / 2}};
    return surface_place_at(shape, 0, 0, z);
}

void solid_draw(solid_kind kind, surface_solid *out) {
    const analytic_kind kinds[] = {ANALYTIC_SPHERE, ANALYTIC_BOX, ANALYTIC_CAPSULE};
    double toward[3], radius = 3;
    surface_random_unit(toward);
    out->shells = kind == SOLID_SHELLS || kind == SOLID_CUT;
    out->factor = pow(2, check_uniform(-4, 4));
    out->count = kind == SOLID_TORUS ? 1 : out->shells ? 6 : kind == SOLID_ROOM ? 3 : 6;
    for (size_t i = 0; i < out->count; ++i) {
        surface_body *one = &out->bodies[i];
        const double along = -3.5 + 1.2 * (double)i;
        switch (kind) {
        case SOLID_CHAIN:
            *one = surface_sphere(along * toward[0], along * toward[1], along * toward[2],
                                  check_uniform(0.3, 0.8));
            break;
        case SOLID_SHELLS:
            *one = surface_sphere(0.1, 0.2, -0.1, radius);
            radius -= check_uniform(0.1, 0.6);
            break;
        case SOLID_SLABS:
            *one = plate(along, pow(10, check_uniform(-1.5, 0)));
            break;
        case SOLID_TORUS:
            *one = surface_place_at(analytic_sample(ANALYTIC_TORUS, 3), 0.1, -0.2, 0.3);
            surface_turn(one);
            break;
        default: /* cut bodies, and rooms */
            *one =
                surface_place_at(analytic_sample(kinds[check_random() % 3], check_uniform(1, 2.5)),
                                 check_uniform(-1, 1), check_uniform(-1, 1), check_uniform(-1, 1));
            surface_turn(one);
            break;
        }
    }
    if (kind == SOLID_ROOM) out->factor = -out->factor;
}

spt_ray solid_ray(void) {
    double origin[3], target[3];
    const double away = check_random() % 3 == 0 ? 2.5 : 8, length = pow(2, check_uniform(-4, 4));
    surface_random_unit(origin);
    for (int axis = 0; axis < 3; ++axis) {
        origin[axis] *= away;
        target[axis] = check_uniform(-1, 1);
    }
    return surface_aim(origin, target, length, check_uniform(4, 16) / length);
}

spt_status solid_call(const spt_field *field, const spt_settings *settings, const spt_ray *ray,
                      uint32_t most, solid_crossings *found) {
    const spt_rays rays = spt_rays_of(ray);
    spt_crossings crossings;
    memset(&crossings, 0, sizeof crossings);
    memset(found, 0x5a, sizeof *found);
    crossings.t.first = found->t;
    crossings.t.stride = sizeof found->t;
    crossings.t_step = sizeof found->t[0];
    crossings.most = most;
    crossings.number.first = &found->number;
    crossings.inside.first = &found->inside;
    crossings.thickness.first = &found->thickness;
    crossings.outcome.first = &found->outcome;
    return spt_crossings_of(field, settings, 1, &rays, &crossings, NULL);
}

static double value_at(const reference_field *field, const spt_ray *ray, double t) {
    double p[3];
    surface_point(ray, t, p);
    {
        const real position[3] = {(real)p[0], (real)p[1], (real)p[2]};
        return (double)(field->distance(field->user, position) / field->lipschitz);
    }
}

/* |f| less a tolerance: again 1-Lipschitz, with crossings where |f| comes within it. */
typedef struct within {
    const reference_field *field;
    double tolerance;
} within;

static real within_value(const void *user, const real position[3]) {
    const within *self = user;
    const double value =
        (double)(self->field->distance(self->field->user, position) / self->field->lipschitz);
    return (real)(fabs(value) - self->tolerance);
}

/* Where |f| last comes within the tolerance between two crossings (or t_min and the first). */
static double approach(const reference_field *field, const spt_ray *ray, double tolerance,
                       double low, double high) {
    const within inner = {field, tolerance};
    const reference_field near = {within_value, &inner, 1};
    enum { most = 64 };
    double t[most];
    spt_ray part = *ray;
    int count;
    part.t_min = (float)low;
    part.t_max = (float)high;
    count = surface_crossings(&near, &part, most, t, NULL);
    /* `high` as a float may lie behind the crossing and beyond the tolerance again. */
    while (count > 0 && count <= most && t[count - 1] > high) --count;
    return count > 0 && count <= most ? t[count - 1] : low;
}

solid_truth solid_true_crossings(const reference_field *field, const spt_settings *settings,
                                 const spt_ray *ray) {
    solid_truth truth = {{0}, {0}, 0, 0, 1};
    double extreme[solid_room + 1];
    const double tolerance = surface_tolerance(settings, ray, 0, (double)ray->t_max);
    truth.count = surface_crossings(field, ray, solid_room, truth.t, extreme);
    truth.inside = value_at(field, ray, (double)ray->t_min) < 0;
    if (truth.count > solid_room) truth.clear = 0;
    for (int i = 0; truth.clear && i <= truth.count; ++i) {
        if (!(extreme[i] > 3 * tolerance)) truth.clear = 0;
    }
    for (int i = 0; truth.clear && i < truth.count; ++i) {
        const double exact = truth.t[i];
        truth.early[i] = approach(
            field, ray, surface_tolerance(settings, ray, 0, exact) + surface_rounding(ray, exact),
            i == 0 ? (double)ray->t_min : truth.t[i - 1], exact);
    }
    return truth;
}

static double thickness_of(const solid_crossings *found, const spt_ray *ray) {
    double sum = 0, entry = (double)ray->t_min;
    int inside = found->inside;
    for (uint32_t i = 0; i < found->number; ++i) {
        if (inside) sum += (double)found->t[i] - entry;
        entry = (double)found->t[i];
        inside = !inside;
    }
    if (inside && found->outcome == SPT_MISS) sum += (double)ray->t_max - entry;
    return sum * oracle_length(ray);
}

void solid_check(const reference_field *field, const spt_ray *ray, uint32_t most,
                 const solid_truth *truth, const solid_crossings *found) {
    const int room = truth->count < (int)most ? truth->count : (int)most;
    const double length = oracle_length(ray), thickness = thickness_of(found, ray);
    CHECK_SAY(found->inside == truth->inside, "inside %d", found->inside);
    if (found->outcome == SPT_LIMIT) {
        CHECK_SAY((int)found->number <= room, "%u of %d", found->number, room);
    } else {
        CHECK_SAY((int)found->number == room, "%u of %d", found->number, room);
        CHECK_SAY(found->outcome == SPT_MISS || truth->count >= (int)most, "outcome %d",
                  found->outcome);
        CHECK_SAY(found->outcome == SPT_HIT || truth->count <= (int)most, "outcome %d",
                  found->outcome);
    }
    for (int i = 0; i < (int)found->number && i < room; ++i) {
        const double t = (double)found->t[i], exact = truth->t[i];
        const double rounding = surface_rounding(ray, exact), early = truth->early[i];
        CHECK_SAY(t <= exact || fabs(value_at(field, ray, t)) <= rounding,
                  "crossing %d: %.9g for %.9g", i, t, exact);
        CHECK_SAY((t - early) * length >= -rounding, "crossing %d: %.9g for %.9g to %.9g", i, t,
                  early, exact);
        CHECK_SAY(i == 0 || found->t[i] >= found->t[i - 1], "crossing %d: %.9g", i, t);
    }
    for (uint32_t i = found->number; i < solid_room; ++i) {
        CHECK_SAY(check_bits(found->t[i]) == 0x5a5a5a5au, "element %u", i);
    }
    if (found->outcome == SPT_LIMIT) return;
    /* Each difference and each sum rounds, of numbers up to t_max. */
    CHECK_SAY(fabs((double)found->thickness - thickness) <=
                  0x1p-23 * (found->number + 2) * (double)ray->t_max * length,
              "thickness %.9g for %.9g", (double)found->thickness, thickness);
}
