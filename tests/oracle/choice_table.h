/* SPDX-License-Identifier: MIT
 *
 * Evaluations that the ten kinds take by settings: the columns both, lost and sampled of
 * sweep_mean.csv as a full report writes it. Written by choice_table.sh:
 *     sh tests/oracle/choice_table.sh build/report/sweep_mean.csv >tests/oracle/choice_table.h */
#ifndef TESTS_ORACLE_CHOICE_TABLE_H
#define TESTS_ORACLE_CHOICE_TABLE_H

#include <stdint.h>

typedef struct choice_row {
    const char *setting, *method;
    double value, evaluations; /* geometric mean a ray */
    uint64_t lost;             /* rays of distance bounds */
    uint64_t sampled;          /* evaluations of the few rays that the test counts, all together */
} choice_row;

static const choice_row choice_table[] = {
    {"relaxation", "relaxed", 1, 14.1384059, 0, 379393},
    {"relaxation", "relaxed", 1.1, 12.9738139, 0, 347054},
    {"relaxation", "relaxed", 1.2, 12.4288076, 0, 329730},
    {"relaxation", "relaxed", 1.3, 12.2243084, 0, 321395},
    {"relaxation", "relaxed", 1.4, 12.0328483, 0, 314158},
    {"relaxation", "relaxed", 1.5, 12.0287756, 0, 313034},
    {"relaxation", "relaxed", 1.6, 12.2403115, 0, 317542},
    {"relaxation", "relaxed", 1.7, 12.5200798, 0, 324732},
    {"relaxation", "relaxed", 1.8, 12.7908569, 0, 333467},
    {"relaxation", "relaxed", 1.9, 13.0517567, 0, 341280},
    {"relaxation", "relaxed", 1.95, 13.2499187, 0, 354485},
    {"extrapolation", "adaptive", 0, 14.1384059, 0, 379393},
    {"extrapolation", "adaptive", 0.2, 11.9915829, 0, 322207},
    {"extrapolation", "adaptive", 0.4, 10.9634318, 0, 292142},
    {"extrapolation", "adaptive", 0.6, 10.2560174, 0, 270843},
    {"extrapolation", "adaptive", 0.7, 10.000696, 0, 262956},
    {"extrapolation", "adaptive", 0.76, 9.87743676, 0, 258931},
    {"extrapolation", "adaptive", 0.8, 9.80419624, 0, 256573},
    {"extrapolation", "adaptive", 0.84, 9.74329971, 0, 254488},
    {"extrapolation", "adaptive", 0.88, 9.69043229, 0, 252585},
    {"extrapolation", "adaptive", 0.92, 9.6510033, 0, 251297},
    {"extrapolation", "adaptive", 0.96, 9.64715542, 0, 251029},
    {"extrapolation", "adaptive", 0.98, 9.6992302, 0, 252882},
    {"extrapolation", "adaptive", 1, 11.4241813, 0, 325374},
    {"extrapolation", "enhanced", 0, 14.1384059, 0, 379393},
    {"extrapolation", "enhanced", 0.2, 12.0304684, 0, 323062},
    {"extrapolation", "enhanced", 0.4, 11.0429678, 0, 293899},
    {"extrapolation", "enhanced", 0.6, 10.3918436, 0, 274129},
    {"extrapolation", "enhanced", 0.7, 10.1889424, 0, 267406},
    {"extrapolation", "enhanced", 0.76, 10.1160936, 0, 264404},
    {"extrapolation", "enhanced", 0.8, 10.0863398, 0, 263363},
    {"extrapolation", "enhanced", 0.84, 10.0767741, 0, 262528},
    {"extrapolation", "enhanced", 0.88, 10.0827719, 0, 262454},
    {"extrapolation", "enhanced", 0.92, 10.1152268, 0, 263128},
    {"extrapolation", "enhanced", 0.96, 10.1973699, 0, 265432},
    {"extrapolation", "enhanced", 0.98, 10.3377322, 0, 271182},
    {"extrapolation", "enhanced", 1, 14.4159248, 0, 466623},
    {"slope_blend", "auto_relaxed", 0.05, 12.5188924, 0, 324787},
    {"slope_blend", "auto_relaxed", 0.1, 11.8264902, 0, 305689},
    {"slope_blend", "auto_relaxed", 0.2, 11.0719343, 0, 285966},
    {"slope_blend", "auto_relaxed", 0.3, 10.6521923, 0, 275638},
    {"slope_blend", "auto_relaxed", 0.4, 10.3924249, 0, 270172},
    {"slope_blend", "auto_relaxed", 0.5, 10.2292211, 0, 266666},
    {"slope_blend", "auto_relaxed", 0.6, 10.1274756, 0, 264770},
    {"slope_blend", "auto_relaxed", 0.7, 10.0834518, 0, 264781},
    {"slope_blend", "auto_relaxed", 0.8, 10.1086561, 0, 267139},
    {"slope_blend", "auto_relaxed", 0.9, 10.2414133, 0, 273590},
    {"slope_blend", "auto_relaxed", 1, 11.392034, 0, 324581},
    {"step_cap", "adaptive", 1, 14.1384059, 0, 379393},
    {"step_cap", "adaptive", 2, 10.1805229, 0, 263384},
    {"step_cap", "adaptive", 3, 9.87526676, 0, 256601},
    {"step_cap", "adaptive", 4, 9.76152546, 0, 254190},
    {"step_cap", "adaptive", 5, 9.71339393, 0, 253123},
    {"step_cap", "adaptive", 6, 9.69043229, 0, 252585},
    {"step_cap", "adaptive", 7, 9.67882441, 0, 252343},
    {"step_cap", "adaptive", 8, 9.67361325, 0, 252219},
    {"step_cap", "adaptive", 9, 9.67042349, 0, 252138},
    {"step_cap", "adaptive", 10, 9.66800214, 0, 252097},
    {"step_cap", "adaptive", 100, 9.66261531, 0, 251945},
    {"method", "basic", 0, 14.1384059, 0, 379393},
    {"method", "relaxed", 1, 12.0328483, 0, 314158},
    {"method", "auto_relaxed", 2, 10.1274756, 0, 264770},
    {"method", "enhanced", 3, 10.0827719, 0, 262454},
    {"method", "adaptive", 4, 9.69043229, 0, 252585},
};
enum { choice_rows = sizeof choice_table / sizeof choice_table[0] };

#endif
