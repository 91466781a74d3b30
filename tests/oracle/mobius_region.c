/* SPDX-License-Identifier: MIT
 *
 * Solids under chains, and what rounding may do to their images. */
#include "mobius_region.h"
#include "../check.h"

#include <math.h>

solid solid_of(const spt_region *region) {
    solid one;
    const place center = place_of(region->center);
    one.kind = (spt_region_kind)region->kind;
    for (int i = 0; i < 3; ++i) one.center[i] = center.at[i];
    one.radius = (extended)region->radius;
    return one;
}

extended solid_distance(const solid *one, const extended p[3]) {
    if (one->kind == SPT_REGION_HALF_SPACE) return extended_dot(one->center, p) - one->radius;
    return (one->kind == SPT_REGION_BALL ? 1 : -1) *
           (extended_distance(one->center, p) - one->radius);
}

static void solid_inverted(const chain_step *step, solid *one) {
    const place middle = place_of(step->vector);
    const extended square = (extended)step->number * (extended)step->number;
    extended way[3], power;
    if (one->kind == SPT_REGION_HALF_SPACE) {
        const extended inside = one->radius - extended_dot(one->center, middle.at);
        if (!(fabsl(inside) > 0)) return; /* a plane through the center */
        for (int i = 0; i < 3; ++i)
            one->center[i] = middle.at[i] + one->center[i] * square / (2 * inside);
        one->radius = square / (2 * fabsl(inside));
        one->kind = inside > 0 ? SPT_REGION_OUTSIDE : SPT_REGION_BALL;
        return;
    }
    for (int i = 0; i < 3; ++i) way[i] = one->center[i] - middle.at[i];
    power = (extended_length(way) - one->radius) * (extended_length(way) + one->radius);
    if (!(fabsl(power) > 0)) {
        /* Of a ball all beyond the plane, seen from the center. */
        const extended sign = one->kind == SPT_REGION_BALL ? -1 : 1;
        for (int i = 0; i < 3; ++i) one->center[i] = sign * way[i] / one->radius;
        one->radius = extended_dot(one->center, middle.at) + sign * square / (2 * one->radius);
        one->kind = SPT_REGION_HALF_SPACE;
        return;
    }
    for (int i = 0; i < 3; ++i) one->center[i] = middle.at[i] + way[i] * (square / power);
    one->radius *= square / fabsl(power);
    /* What holds the center gets infinity. */
    one->kind =
        (one->kind == SPT_REGION_BALL) == (power > 0) ? SPT_REGION_BALL : SPT_REGION_OUTSIDE;
}

static void solid_step(const chain_step *step, int back, solid *one) {
    chain single;
    place center = {{one->center[0], one->center[1], one->center[2]}, 0};
    single.count = 1;
    single.steps[0] = *step;
    if (step->kind == CHAIN_INVERSION) {
        solid_inverted(step, one);
    } else if (one->kind == SPT_REGION_HALF_SPACE) {
        place on = {{0, 0, 0}, 0};
        for (int i = 0; i < 3; ++i) on.at[i] = one->center[i] * one->radius;
        chain_vector(&single, back, on, one->center);
        on = chain_image(&single, back, on);
        one->radius = extended_dot(one->center, on.at);
    } else {
        one->radius *= chain_scale(&single, back, center);
        center = chain_image(&single, back, center);
        for (int i = 0; i < 3; ++i) one->center[i] = center.at[i];
    }
}

solid chain_solid(const chain *one, int back, solid from) {
    for (int i = 0; i < one->count; ++i)
        solid_step(&one->steps[back ? one->count - 1 - i : i], back, &from);
    return from;
}

place solid_mirrored(const solid *one, place p) {
    extended way[3], length, factor;
    if (one->kind == SPT_REGION_HALF_SPACE) {
        const extended beyond = solid_distance(one, p.at);
        for (int i = 0; i < 3; ++i) p.at[i] -= 2 * beyond * one->center[i];
        return p;
    }
    if (p.infinite) {
        for (int i = 0; i < 3; ++i) p.at[i] = one->center[i];
        p.infinite = 0;
        return p;
    }
    for (int i = 0; i < 3; ++i) way[i] = p.at[i] - one->center[i];
    length = extended_length(way);
    if (!(length > 0)) return place_infinite();
    factor = one->radius / length;
    for (int i = 0; i < 3; ++i) p.at[i] = one->center[i] + way[i] * factor * factor;
    return p;
}

void solid_coefficients(const solid *one, extended coefficient[5]) {
    extended largest = 0;
    if (one->kind == SPT_REGION_HALF_SPACE) {
        coefficient[0] = 0;
        for (int i = 0; i < 3; ++i) coefficient[1 + i] = -one->center[i];
        coefficient[4] = -2 * one->radius;
    } else {
        const extended sign = one->kind == SPT_REGION_BALL ? 1 : -1;
        const extended length = extended_length(one->center);
        coefficient[0] = sign;
        for (int i = 0; i < 3; ++i) coefficient[1 + i] = sign * one->center[i];
        coefficient[4] = sign * (length - one->radius) * (length + one->radius);
    }
    for (int i = 0; i < 5; ++i) largest = fmaxl(largest, fabsl(coefficient[i]));
    for (int i = 0; i < 5; ++i) coefficient[i] /= largest;
}

solid_error chain_solid_error(const chain *one, int back, const solid *from) {
    const moduli n = chain_moduli(one, back);
    const place pole = chain_image(one, !back, place_infinite());
    const place center = {{from->center[0], from->center[1], from->center[2]}, 0};
    const int plane = from->kind == SPT_REGION_HALF_SPACE;
    solid_error error = {0, 0, 1};
    extended c, of_pole, way, scale;
    place mirrored, image;
    if (pole.infinite) { /* similar: only the image of the center and the scale are off */
        scale = chain_scale(one, back, center);
        image = chain_image(one, back, center);
        error.center = error_of_point(&n, center, image, scale);
        error.radius = 2 * error_relative(&n, center, scale);
        return error;
    }
    c = chain_lower(one, back, pole);
    of_pole = error_of_pole(&n, pole, c);
    mirrored = solid_mirrored(from, pole);
    if (plane) {
        way = fabsl(solid_distance(from, pole.at));
        error.nearness = way / (extended_length(pole.at) + fabsl(from->radius));
        /* Of the distance of the pole also the given normal's and offset's rounding. */
        of_pole += extended_length(pole.at) + fabsl(from->radius);
        error.radius = 2 * n.c / c + of_pole / way;
    } else {
        extended ratio;
        way = extended_distance(pole.at, center.at);
        ratio = from->radius / way;
        error.nearness = fabsl((1 - ratio) * (1 + ratio));
        if (!(way > 0)) error.nearness = HUGE_VALL;
        scale = 1 / (c * way * c * way);
        error.radius = 2 * error_relative(&n, center, scale) +
                       2 * (ratio * ratio / error.nearness) * of_pole / way;
        of_pole *= ratio * ratio;
    }
    if (!mirrored.infinite) {
        scale = chain_scale(one, back, mirrored);
        image = chain_image(one, back, mirrored);
        error.center = error_of_point(&n, mirrored, image, scale) + scale * of_pole;
    }
    return error;
}

spt_region region_draw(const double center[3], double extent) {
    const uint32_t pick = check_random() % 8;
    spt_region region;
    double length = 0;
    for (int i = 0; i < 3; ++i) {
        region.center[i] = check_uniform(-1, 1);
        length += region.center[i] * region.center[i];
    }
    length = sqrt(length);
    if (pick < 2) {
        region.kind = SPT_REGION_HALF_SPACE;
        region.radius = check_uniform(-2, 2) * extent;
        for (int i = 0; i < 3; ++i) {
            region.center[i] /= length;
            region.radius += region.center[i] * center[i];
        }
        return region;
    }
    region.kind = pick < 4 ? SPT_REGION_OUTSIDE : SPT_REGION_BALL;
    region.radius = extent * pow(10, check_uniform(pick < 6 ? -0.5 : -9, 0.5));
    for (int i = 0; i < 3; ++i) region.center[i] = center[i] + 2 * extent * region.center[i];
    return region;
}
