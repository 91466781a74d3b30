/* SPDX-License-Identifier: MIT
 *
 * Elementary maps of points, each from its own geometry, and the moduli of their matrices. */
#include "mobius_chain.h"
#include "../check.h"

#include <math.h>

place place_of(const double point[3]) {
    place p = {{(extended)point[0], (extended)point[1], (extended)point[2]}, 0};
    return p;
}

place place_infinite(void) {
    place p = {{0, 0, 0}, 1};
    return p;
}

extended extended_dot(const extended a[3], const extended b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

extended extended_length(const extended a[3]) {
    return sqrtl(extended_dot(a, a));
}

extended extended_distance(const extended a[3], const extended b[3]) {
    const extended d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return extended_length(d);
}

extended extended_unit(void) {
    volatile extended unit = 1, sum;
    do {
        unit /= 2;
        sum = 1 + unit;
    } while (sum > 1);
    return unit;
}

/* ---- One step -------------------------------------------------------------------------------- */

static void unit_of(const double vector[3], extended unit[3]) {
    const place p = place_of(vector);
    const extended length = extended_length(p.at);
    for (int i = 0; i < 3; ++i) unit[i] = p.at[i] / length;
}

/* Rodrigues: v cos + (axis x v) sin + axis (axis . v) (1 - cos). */
static void rotated(const chain_step *step, int back, extended v[3]) {
    const extended angle = back ? -(extended)step->number : (extended)step->number;
    const extended half = sinl(angle / 2), sine = sinl(angle), less = 2 * half * half;
    extended axis[3], along, old[3];
    unit_of(step->vector, axis);
    along = extended_dot(axis, v);
    for (int i = 0; i < 3; ++i) old[i] = v[i];
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        v[i] = old[i] + (axis[j] * old[k] - axis[k] * old[j]) * sine +
               (axis[i] * along - old[i]) * less;
    }
}

static extended from_center(const chain_step *step, const extended p[3], extended offset[3]) {
    for (int i = 0; i < 3; ++i) offset[i] = p[i] - (extended)step->vector[i];
    return extended_length(offset);
}

static void inverted(const chain_step *step, place *p) {
    const extended radius = (extended)step->number;
    extended offset[3], length = 0;
    if (!p->infinite) {
        length = from_center(step, p->at, offset);
        if (!(length > 0)) {
            p->infinite = 1;
            return;
        }
    }
    for (int i = 0; i < 3; ++i) {
        p->at[i] = (extended)step->vector[i];
        if (!p->infinite) p->at[i] += radius * (radius * (offset[i] / length) / length);
    }
    p->infinite = 0;
}

static void step_point(const chain_step *step, int back, place *p) {
    extended unit[3], beyond;
    if (p->infinite && step->kind != CHAIN_INVERSION) return;
    switch (step->kind) {
    case CHAIN_TRANSLATION:
        for (int i = 0; i < 3; ++i) p->at[i] += (back ? -1 : 1) * (extended)step->vector[i];
        break;
    case CHAIN_DILATION:
        for (int i = 0; i < 3; ++i)
            p->at[i] = back ? p->at[i] / (extended)step->number : p->at[i] * (extended)step->number;
        break;
    case CHAIN_ROTATION:
        rotated(step, back, p->at);
        break;
    case CHAIN_REFLECTION:
        unit_of(step->vector, unit);
        beyond = extended_dot(unit, p->at) -
                 (extended)step->number / extended_length(place_of(step->vector).at);
        for (int i = 0; i < 3; ++i) p->at[i] -= 2 * beyond * unit[i];
        break;
    default:
        inverted(step, p);
    }
}

/* At a point before the step. */
static extended step_scale(const chain_step *step, int back, const place *p) {
    extended offset[3], ratio;
    switch (step->kind) {
    case CHAIN_DILATION:
        ratio = fabsl((extended)step->number);
        return back ? 1 / ratio : ratio;
    case CHAIN_INVERSION:
        ratio = (extended)step->number / from_center(step, p->at, offset);
        return ratio * ratio;
    default:
        return 1;
    }
}

static void step_vector(const chain_step *step, int back, const place *p, extended v[3]) {
    extended unit[3], length, along;
    switch (step->kind) {
    case CHAIN_TRANSLATION:
        return;
    case CHAIN_DILATION:
        for (int i = 0; i < 3; ++i) v[i] *= step->number < 0 ? -1 : 1;
        return;
    case CHAIN_ROTATION:
        rotated(step, back, v);
        return;
    case CHAIN_REFLECTION:
        unit_of(step->vector, unit);
        break;
    default: /* a reflection in the plane at right angles to the way from the center */
        length = from_center(step, p->at, unit);
        for (int i = 0; i < 3; ++i) unit[i] /= length;
    }
    along = extended_dot(unit, v);
    for (int i = 0; i < 3; ++i) v[i] -= 2 * along * unit[i];
}

/* ---- Chains ---------------------------------------------------------------------------------- */

static const chain_step *step_of(const chain *one, int back, int i) {
    return &one->steps[back ? one->count - 1 - i : i];
}

place chain_image(const chain *one, int back, place from) {
    for (int i = 0; i < one->count; ++i) step_point(step_of(one, back, i), back, &from);
    return from;
}

extended chain_scale(const chain *one, int back, place from) {
    extended scale = 1;
    for (int i = 0; i < one->count; ++i) {
        scale *= step_scale(step_of(one, back, i), back, &from);
        step_point(step_of(one, back, i), back, &from);
    }
    return scale;
}

void chain_vector(const chain *one, int back, place from, extended vector[3]) {
    for (int i = 0; i < one->count; ++i) {
        step_vector(step_of(one, back, i), back, &from, vector);
        step_point(step_of(one, back, i), back, &from);
    }
}

/* An inversion makes |p - q| into r^2 |p - q| / (|p - c| |q - c|). */
extended chain_apart(const chain *one, int back, place from, place other, extended apart) {
    for (int i = 0; i < one->count; ++i) {
        const chain_step *step = step_of(one, back, i);
        apart *= sqrtl(step_scale(step, back, &from)) * sqrtl(step_scale(step, back, &other));
        step_point(step, back, &from);
        step_point(step, back, &other);
    }
    return apart;
}

int chain_orientation(const chain *one) {
    int sign = 1;
    for (int i = 0; i < one->count; ++i) {
        const chain_step *step = &one->steps[i];
        if (step->kind == CHAIN_REFLECTION || step->kind == CHAIN_INVERSION) sign = -sign;
        if (step->kind == CHAIN_DILATION && step->number < 0) sign = -sign;
    }
    return sign;
}

/* ---- Errors ---------------------------------------------------------------------------------- */

static moduli step_moduli(const chain_step *step) {
    const extended length = extended_length(place_of(step->vector).at);
    const extended number = fabsl((extended)step->number);
    moduli n = {1, 0, 0, 1};
    if (step->kind == CHAIN_TRANSLATION) n.b = length;
    if (step->kind == CHAIN_REFLECTION) n.b = 2 * number / length;
    if (step->kind == CHAIN_DILATION) {
        n.a = sqrtl(number);
        n.d = 1 / n.a;
    }
    if (step->kind == CHAIN_INVERSION) { /* to the center, the unit sphere scaled, and back */
        n.a = n.d = length / number;
        n.b = number + length * (length / number);
        n.c = 1 / number;
    }
    return n;
}

moduli chain_moduli(const chain *one, int back) {
    moduli n = {1, 0, 0, 1};
    for (int i = 0; i < one->count; ++i) {
        const moduli m = step_moduli(&one->steps[i]), old = n;
        n.a = m.a * old.a + m.b * old.c;
        n.b = m.a * old.b + m.b * old.d;
        n.c = m.c * old.a + m.d * old.c;
        n.d = m.c * old.b + m.d * old.d;
    }
    if (back) { /* the inverse's matrix is [d* b*; c* a*] */
        const extended a = n.a;
        n.a = n.d;
        n.d = a;
    }
    return n;
}

int chain_close(const chain *one, extended off, extended error) {
    return off <= 16 * (one->count + 1) * (0x1p-53L + extended_unit()) * error;
}

void chain_count(chain_tally *tally, extended off, extended error) {
    ++tally->compared;
    tally->beyond += !(off <= 16 * (0x1p-53L + extended_unit()) * error);
}

int chain_sharp(const chain_tally *tally) {
    return tally->compared > 0 && tally->beyond * 1000 <= tally->compared;
}

extended error_of_denominator(const moduli *n, place from) {
    return n->c * extended_length(from.at) + n->d;
}

extended error_of_point(const moduli *n, place from, place image, extended scale) {
    const extended length = extended_length(from.at);
    return sqrtl(scale) *
           (n->a * length + n->b + extended_length(image.at) * error_of_denominator(n, from));
}

extended error_relative(const moduli *n, place from, extended scale) {
    return sqrtl(scale) * error_of_denominator(n, from);
}

extended error_of_pole(const moduli *n, place pole, extended c) {
    return error_of_denominator(n, pole) / c;
}

/* scale = 1 / (|c| |p - Q|)^2 at any p. */
extended chain_lower(const chain *one, int back, place pole) {
    place from = pole;
    const extended step = 1 + extended_length(pole.at);
    from.at[0] += step;
    return 1 / (sqrtl(chain_scale(one, back, from)) * extended_distance(from.at, pole.at));
}

/* ---- Drawing and building -------------------------------------------------------------------- */

chain_step chain_draw_step(chain_kind kind, const extended center[3], double extent) {
    chain_step step = {kind, {0, 0, 0}, 0};
    double direction[3], length = 0;
    for (int i = 0; i < 3; ++i) {
        direction[i] = check_uniform(-1, 1);
        length += direction[i] * direction[i];
    }
    length = sqrt(length);
    for (int i = 0; i < 3; ++i) step.vector[i] = direction[i] / length;
    switch (kind) {
    case CHAIN_TRANSLATION:
        for (int i = 0; i < 3; ++i) step.vector[i] *= extent * check_uniform(0.1, 4);
        break;
    case CHAIN_DILATION:
        step.number = exp(check_uniform(-1, 1)) * (check_random() % 4 == 0 ? -1 : 1);
        break;
    case CHAIN_ROTATION: {
        const double any = pow(10, check_uniform(-3, 3));
        step.number = check_uniform(-7, 7) * (check_random() % 8 == 0 ? 1e4 : 1);
        for (int i = 0; i < 3; ++i) step.vector[i] *= any;
        break;
    }
    case CHAIN_REFLECTION: {
        const double any = pow(10, check_uniform(-3, 3));
        for (int i = 0; i < 3; ++i) {
            step.vector[i] *= any;
            step.number += step.vector[i] * ((double)center[i] + extent * check_uniform(-2, 2));
        }
        break;
    }
    default: {
        const double away = extent * check_uniform(1.2, 4);
        step.number = extent * check_uniform(0.5, 3);
        for (int i = 0; i < 3; ++i) step.vector[i] = (double)center[i] + away * step.vector[i];
    }
    }
    return step;
}

void chain_draw(chain *one, int count, const double center[3], double extent) {
    place middle = place_of(center);
    one->count = count;
    for (int i = 0; i < count; ++i) {
        const chain_kind kind = (chain_kind)(check_random() % CHAIN_KINDS);
        chain_step *step = &one->steps[i];
        *step = chain_draw_step(kind, middle.at, extent);
        extent *= (double)step_scale(step, 0, &middle);
        step_point(step, 0, &middle);
    }
}

void chain_draw_wild(chain *one, int count) {
    static const extended origin[3] = {0, 0, 0};
    one->count = count;
    for (int i = 0; i < count; ++i) {
        const chain_kind kind = (chain_kind)(check_random() % CHAIN_KINDS);
        const double extent = pow(10, check_uniform(-7, 7));
        one->steps[i] = chain_draw_step(kind, origin, extent);
        if (kind == CHAIN_DILATION) one->steps[i].number *= extent;
    }
}

spt_status chain_elementary(const chain_step *step, spt_mobius *map) {
    switch (step->kind) {
    case CHAIN_TRANSLATION:
        return spt_mobius_translation(step->vector, map);
    case CHAIN_DILATION:
        return spt_mobius_dilation(step->number, map);
    case CHAIN_ROTATION:
        return spt_mobius_rotation(step->vector, step->number, map);
    case CHAIN_REFLECTION:
        return spt_mobius_reflection(step->vector, step->number, map);
    default:
        return spt_mobius_inversion(step->vector, step->number, map);
    }
}

spt_mobius chain_build(const chain *one) {
    spt_mobius map = spt_mobius_identity(), next = spt_mobius_identity();
    for (int i = 0; i < one->count; ++i) {
        CHECK(chain_elementary(&one->steps[i], &next) == SPT_OK);
        CHECK(spt_mobius_compose(&next, &map, &map) == SPT_OK);
    }
    return map;
}
