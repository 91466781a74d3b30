/* SPDX-License-Identifier: MIT
 *
 * How the defaults of trace.h follow from counts: what is swept over which fields, and the rule
 * that takes one of the values. For the report, which measures, and for the test, which compares.
 * Left out: whether rays are lost, which the report finds out. */
#ifndef TESTS_ORACLE_CHOICE_H
#define TESTS_ORACLE_CHOICE_H

#include <scenes/scenes.h>

enum { choice_stops = 2, choice_kinds = 10, choice_width = 160, choice_height = 120 };

/* The rays that the test counts: every fourth in each direction. From every fifth on the rule takes
 * the value beside it for slope_blend. */
enum { choice_every = 4 };

/* The ten kinds of field, by scene, and the stops: half a pixel, or the absolute tolerance. */
extern const char *const choice_kind[choice_kinds];
extern const char *const choice_stop[choice_stops];

/* Values of a setting, from the one that is nearest to basic steps on, and the step rule they are
 * tried with: one that reads it. The first rule of a setting chooses its default. */
enum { choice_most_values = 16 };
typedef struct choice_sweep {
    const char *setting; /* its name in spt_settings */
    const char *method;
    int count;
    float values[choice_most_values];
} choice_sweep;
enum { choice_sweeps = 5 };
extern const choice_sweep choice_sweep_of[choice_sweeps];

/* The step rules that need no licence, from basic steps on in the order of what they dare. */
enum { choice_methods = 5 };
extern const char *const choice_method[choice_methods];

/* A setting by its name. */
float *choice_setting(spt_settings *settings, const char *setting);

/* The settings of a sweep: those given, with a rule, a stop, and a budget that no ray of the kinds
 * uses up. */
spt_settings choice_settings(const spt_settings *given, const char *method, int stop,
                             float pixel_radius);

/* The rays of every nth pixel in each direction (1: of all) of a scene's picture of choice_width x
 * choice_height; pixel_radius is that of the whole picture. rays holds a picture. Returns how many
 * there are. */
size_t choice_rays(const scene *shown, int every, spt_ray *rays, float *pixel_radius);

/* The evaluations of a scene's rays: their sum, and the sum of their squares. Zeros where the trace
 * is refused. hits receives count results. */
typedef struct choice_count {
    uint64_t sum, squares;
} choice_count;
choice_count choice_evaluations(const scene *shown, const spt_settings *settings, size_t count,
                                const spt_ray *rays, spt_hit *hits);

/* THE RULE. Of the values with which no ray of a distance bound is lost: the one with the least
 * geometric mean of evaluations, over the ten kinds and both stops. Values within half a percent of
 * that are as good, and the first of them, the nearest to basic steps, is taken. */
typedef struct choice_value {
    double evaluations; /* geometric mean a ray */
    uint64_t lost;
} choice_value;

/* The place of the chosen value, -1 where all lose rays. */
int choice_pick(const choice_value *values, int count);

#endif
