/* SPDX-License-Identifier: MIT
 *
 * Small pictures of the worlds of glass: against the same in double precision, with and without the
 * optimisation for convex bodies, and in light that nothing takes away. */
#include "whitted_check.h"

#include "whitted.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { width = 80, height = 45, count = width * height, numbers = 3 * count };

static float through[numbers], convex[numbers], again[numbers], inside[count];

/* Pictures in double precision, how much they change near pixel centres, and half a pixel away. */
static double exact[numbers], spread[numbers], half_pixel[numbers];

static int report(const char *world, const char *what, double found, double most) {
    const int good = found <= most; /* NaN is not */
    printf("%-6s %-52s %9.3g, at most %9.3g%s\n", world, what, found, most,
           good ? "" : "  <-- wrong");
    return good;
}

/* ---- Energy -------------------------------------------------------------------------------- */

/* In light of 1 from everywhere every pixel is 1: what is not followed sees the light at once. A
 * path divides at most 10 times into at most 56 ends, each weight rounded twice an event. */
static int check_furnace(const glass_world *world) {
    glass_ball balls[8];
    glass_world furnace = glass_furnace(world, balls);
    whitted_settings settings = whitted_settings_default();
    whitted_statistics statistics;
    double worst = 0;
    if (!whitted_render(&furnace, &settings, width, height, convex, &statistics)) return 0;
    for (int i = 0; i < numbers; ++i) {
        const double off = fabs((double)convex[i] - 1);
        if (!(off <= worst)) worst = off;
    }
    return report(world->name, "white furnace: farthest from 1", worst, 56 * 20 * 0x1p-24);
}

/* ---- Against double precision -------------------------------------------------------------- */

/* How far from pixel centres the exact picture is looked at, too, in pixels: its spread there tells
 * how much an error of the renderer weighs. A pixel is 0.07 wide in the world and 0.5 degrees, so
 * this is 1.4e-3 and 1.8e-4: more than an offset of 2 epsilon along the surface at a glancing
 * angle, and twice the error of normals by six values. */
static const double aside = 0.02;

/* A path of several surfaces has several such errors. */
static const double more = 4;

static void find_exact(const glass_world *world, const whitted_settings *settings) {
    for (int i = 0; i < count; ++i) {
        const double x = i % width + 0.5, y = i / width + 0.5;
        whitted_exact(world, settings, width, height, x, y, &exact[3 * i]);
        for (int c = 0; c < 3; ++c) spread[3 * i + c] = 0;
        for (int corner = 0; corner < 4; ++corner) {
            double light[3];
            whitted_exact(world, settings, width, height, x + (corner % 2 ? aside : -aside),
                          y + (corner / 2 ? aside : -aside), light);
            for (int c = 0; c < 3; ++c) {
                spread[3 * i + c] = fmax(spread[3 * i + c], fabs(light[c] - exact[3 * i + c]));
            }
        }
        whitted_exact(world, settings, width, height, x + 0.5, y, &half_pixel[3 * i]);
    }
}

/* Pixels whose light is off by more than the spread explains. Edges that pass between the five
 * points of a pixel, but not between the renderer's ray and the exact one, are among them. */
static int count_off(const float *pixels) {
    int off = 0;
    for (int i = 0; i < count; ++i) {
        int good = 1;
        for (int c = 3 * i; c < 3 * i + 3; ++c) {
            good &= fabs((double)pixels[c] - exact[c]) <= more * spread[c] + 1e-3;
        }
        off += !good;
    }
    return off;
}

static double median_error(const float *pixels) {
    /* by counting in steps of 2 % */
    enum { steps = 1200 };
    static int histogram[steps];
    int sum = 0, step = 0, looked_at = 0;
    memset(histogram, 0, sizeof histogram);
    for (int i = 0; i < count; ++i) {
        if (!(inside[i] > 0)) continue;
        for (int c = 3 * i; c < 3 * i + 3; ++c) {
            const double error = fmax(fabs((double)pixels[c] - exact[c]), 1e-10);
            const int place = (int)(log(error * 1e10) / log(1.02));
            ++histogram[place < steps ? place : steps - 1];
            ++looked_at;
        }
    }
    while (step < steps && (sum += histogram[step]) * 2 < looked_at) ++step;
    return 1e-10 * pow(1.02, step + 1);
}

/* The darkest number in pixels that see into the glass: of the picture over the exact one. */
static double darkness(const float *pixels) {
    double darkest = 1, exact_darkest = 1;
    for (int i = 0; i < numbers; ++i) {
        if (!(inside[i / 3] > 0)) continue;
        if (!((double)pixels[i] >= darkest)) darkest = (double)pixels[i];
        exact_darkest = fmin(exact_darkest, exact[i]);
    }
    return exact_darkest / darkest;
}

static double evaluations_inside(const whitted_statistics *statistics) {
    const spt_statistics *const traced = &statistics->of[WHITTED_INSIDE];
    return (double)traced->evaluations / (double)traced->rays;
}

static int check_exact(glass_world *world) {
    whitted_settings settings = whitted_settings_default();
    whitted_statistics first, second;
    int good = 1;
    settings.pixel_cone = 0;
    settings.epsilon = 1e-5f;
    settings.least_weight = 0;
    settings.budget = 1000;
    settings.inside_evaluations = inside;
    settings.convex = 0;
    if (!whitted_render(world, &settings, width, height, through, &first)) return 0;
    settings.convex = 1;
    if (!whitted_render(world, &settings, width, height, convex, &second)) return 0;
    find_exact(world, &settings);
    good &= report(world->name, "through: pixels off the exact ones", count_off(through), 4);
    good &= report(world->name, "convex: pixels off the exact ones", count_off(convex), 4);
    good &= report(world->name, "convex: median error inside", median_error(convex), 1e-3);
    good &= report(world->name, "convex: darkest inside, exact over found", darkness(convex), 2);
    good &= report(world->name, "evaluations inside, convex over through",
                   evaluations_inside(&second) / evaluations_inside(&first), 0.5);
    good &=
        report(world->name, "self-intersections", (double)(first.self_hits + second.self_hits), 0);
    good &= report(world->name, "rays undecided", (double)(first.undecided + second.undecided), 0);
    return good;
}

/* ---- With cones ---------------------------------------------------------------------------- */

static double mean_off(const float *pixels) {
    double sum = 0;
    for (int i = 0; i < numbers; ++i) sum += fabs((double)pixels[i] - exact[i]);
    return sum / numbers;
}

/* Rays that end at half a pixel are off by no more, on average, than the exact picture changes over
 * half a pixel. */
static int check_cones(glass_world *world) {
    whitted_settings settings = whitted_settings_default();
    whitted_statistics first, second, third;
    double half = 0;
    int good = 1;
    settings.convex = 0;
    if (!whitted_render(world, &settings, width, height, through, &first)) return 0;
    settings.convex = 1;
    if (!whitted_render(world, &settings, width, height, convex, &second)) return 0;
    settings.threads = 3;
    if (!whitted_render(world, &settings, width, height, again, &third)) return 0;
    for (int i = 0; i < numbers; ++i) half += fabs(half_pixel[i] - exact[i]) / numbers;
    good &= report(world->name, "cones, through: mean error over half a pixel's",
                   mean_off(through) / half, 1);
    good &= report(world->name, "cones, convex: mean error over half a pixel's",
                   mean_off(convex) / half, 1);
    good &= report(world->name, "cones: evaluations inside, convex over through",
                   evaluations_inside(&second) / evaluations_inside(&first), 1);
    good &= report(world->name, "cones: self-intersections",
                   (double)(first.self_hits + second.self_hits), 0);
    good &= report(world->name, "bits that depend on threads",
                   memcmp(convex, again, sizeof convex) != 0, 0);
    return good;
}

int whitted_check(void) {
    static const char *const names[] = {"glass", "jewel"};
    int good = 1;
    for (size_t i = 0; i < sizeof names / sizeof names[0]; ++i) {
        glass_world world;
        if (!glass_world_named(names[i], &world)) return 0;
        good &= check_furnace(&world);
        good &= check_exact(&world);
        good &= check_cones(&world);
    }
    return good;
}
