/* SPDX-License-Identifier: MIT
 *
 * The numbers for the functions of shapes_list.h, which says what each letter stands for. Left out:
 * what is beyond the ranges that shapes.h states. */
#ifndef TESTS_GLSL_SHAPES_DRAW_H
#define TESTS_GLSL_SHAPES_DRAW_H

#include <math.h>
#include <string.h>

#include <spheretrace/shapes.h>

#include "../check.h"

/* What expressions call by name, beside the point and the numbers. */
static spt_half_space planes[16];
static spt_arc arc[1];
static spt_rotation rotation[1];

static float uniform(double low, double high) {
    return (float)check_uniform(low, high);
}

/* A length from 1e-6 to 1e6, in three of four cases from 0.05 to 3. */
static float draw_length(void) {
    if (check_random() % 4 != 0) return uniform(0.05, 3);
    return (float)pow(10, check_uniform(-6, 6));
}

/* Often near the shapes, sometimes on a plane of symmetry or far off; where `steps` is not 0 a
 * multiple of 1 / steps, so that equal distances come up. */
static float draw_coordinate(int steps) {
    const uint32_t choice = check_random() % 16;
    const float near_by = uniform(-3, 3);
    if (choice == 0) return check_random() % 2 == 0 ? 0.0f : -0.0f;
    if (steps != 0) return floorf(near_by * (float)steps) / (float)steps;
    return choice == 1 ? near_by * draw_length() : near_by;
}

static void draw_unit(float *a) {
    double square = 0, v[3];
    for (int i = 0; i < 100 && (square < 0.01 || square > 1); ++i) {
        square = 0;
        for (int k = 0; k < 3; ++k) {
            v[k] = check_uniform(-1, 1);
            square += v[k] * v[k];
        }
    }
    for (int k = 0; k < 3; ++k) a[k] = (float)(v[k] / sqrt(square));
}

static spt_point draw_point(int steps) {
    const float x = draw_coordinate(steps), y = draw_coordinate(steps), z = draw_coordinate(steps);
    return spt_point_of(x, y, z);
}

static float draw_normal_number(void) {
    uint32_t some = check_random();
    const uint32_t exponent = some >> 23 & 0xff;
    if (exponent == 0 || exponent == 0xff) some ^= 0x3f000000u; /* subnormal, infinite or NaN */
    return spt_real_of(some);
}

static float draw_angle(void) {
    const uint32_t choice = check_random() % 8;
    if (choice == 7) return draw_coordinate(0);
    if (choice == 0) return (float)(check_random() % 64) * 0.78539816f - 25.0f * 0.78539816f;
    return choice == 1 ? uniform(-1.2e5, 1.2e5) : uniform(-8, 8);
}

static int draw_arc(float *a, int steps) {
    arc[0] = spt_arc_of(draw_point(steps), draw_point(steps), draw_point(steps), draw_length());
    memcpy(a, arc, sizeof arc);
    return (int)(sizeof(spt_arc) / sizeof(float));
}

/* The two ends and the control point of an arc, which is near the chord or degenerate. */
static int draw_flat_arc(float *a) {
    const spt_point from = draw_point(0), to = draw_point(0);
    const uint32_t choice = check_random() % 8;
    const float along = uniform(0.1, 0.9);
    const float aside = choice == 1 ? 0 : (float)pow(10, check_uniform(-10, -1));
    a[0] = from.x, a[1] = from.y, a[2] = from.z;
    a[3] = to.x, a[4] = to.y, a[5] = to.z;
    if (choice == 0) memcpy(a + 3, a, 3 * sizeof *a);
    for (int k = 0; k < 3; ++k) {
        a[6 + k] = a[k] + along * (a[3 + k] - a[k]) + aside * uniform(-1, 1);
    }
    if (choice == 2) memcpy(a + 6, a, 3 * sizeof *a);
    return 9;
}

static int draw_rotation(float *a) {
    rotation[0] = spt_rotation_of(draw_point(0), draw_angle());
    memcpy(a, rotation, sizeof rotation);
    return (int)(sizeof(spt_rotation) / sizeof(float));
}

static int draw_planes(float *a) {
    for (int i = 0; i < 16; ++i) {
        draw_unit(a + 4 * i);
        a[4 * i + 3] = i % 2 == 0 ? uniform(0.2, 2) : 1;
    }
    memcpy(planes, a, sizeof planes);
    return 64;
}

static int draw_sine_and_cosine(float *a, double low, double high) {
    const double angle = check_uniform(low, high);
    a[0] = (float)sin(angle);
    a[1] = (float)cos(angle);
    return 2;
}

static float draw_whole(int low, int high) {
    return (float)(low + (int)(check_random() % (uint32_t)(high - low + 1)));
}

/* The letters that stand for one number. */
static float draw_number(char letter, int steps) {
    switch (letter) {
    case 'v':
    case 'f':
        return draw_coordinate(steps);
    case 'l':
        return steps != 0 ? draw_whole(1, 8) / (float)steps : draw_length();
    case 'z':
        return check_random() % 8 == 0 ? 0 : draw_length();
    case 'g':
        return draw_angle();
    case 'e':
        return uniform(-100, 100);
    case 'w':
        return draw_normal_number();
    case 'm':
        return draw_whole(-1000, 1000);
    case 'q':
        return draw_whole(1, 6);
    case 'n':
        return draw_whole(1, 16);
    case 'x':
        return check_random() % 2 == 0 ? uniform(2, 512) : uniform(2, 12);
    default:
        CHECK_SAY(0, "no such letter: %c", letter);
        return 0;
    }
}

/* Draws what a letter of the list stands for and returns how many numbers that is. */
static int draw(char letter, int steps, float *a) {
    switch (letter) {
    case 't':
        return draw_sine_and_cosine(a, 0, 3.14159265);
    case 'c':
        return draw_sine_and_cosine(a, 0.05, 1.5);
    case 'u':
        draw_unit(a);
        return 3;
    case 'P':
        return draw_planes(a);
    case 'A':
        return draw_arc(a, steps);
    case 'S':
        return draw_flat_arc(a);
    case 'R':
        return draw_rotation(a);
    default:
        a[0] = draw_number(letter, steps);
        return 1;
    }
}

static int draw_all(const char *arguments, int steps, float *a) {
    int count = 0;
    for (const char *letter = arguments; *letter != '\0'; ++letter) {
        count += draw(*letter, steps, a + count);
    }
    return count;
}

#endif
