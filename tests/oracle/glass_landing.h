/* SPDX-License-Identifier: MIT
 *
 * Hits in front of simple surfaces, for spt_offset(): what it must write is judged in double. Left
 * out: bodies and paths, see glass_run.h. */
#ifndef TESTS_ORACLE_GLASS_LANDING_H
#define TESTS_ORACLE_GLASS_LANDING_H

#include <spheretrace/surface.h>

typedef enum landing_kind {
    LANDING_GROUND, /* z < place */
    LANDING_BALL,   /* of radius `width`, its top at z = place */
    LANDING_SHEET,  /* z within `width` below place */
    LANDING_GAP,    /* free for `width` above place, filled below and above it */
    LANDING_KINDS
} landing_kind;

/* A surface, and f = distance / weak: a bound that underestimates for weak > 1. */
typedef struct landing {
    landing_kind kind;
    double place, width, weak;
    unsigned calls;  /* of the callback, */
    unsigned points; /* and how many it was asked for, padding included */
} landing;

/* The signed distance, not weakened, and its unit gradient. */
double landing_distance(const landing *surface, const double p[3]);
void landing_normal(const landing *surface, const double p[3], float normal[3]);
spt_field landing_field(landing *surface);

/* One hit, and what to do with it. */
typedef struct landing_case {
    spt_ray ray;
    spt_hit hit;
    float path, normal[3];
    int32_t cross;
} landing_case;

/* What came out. */
typedef struct landing_result {
    float origin[3], path;
    int32_t start;
} landing_result;

/* A hit at height `over` above (below with a minus) the surface near place, by a ray of a random
 * direction that comes from that side, or from inside where `inside`. */
landing_case landing_hit(const landing *surface, double over, int inside, double path);

/* Calls spt_offset() for the cases of one surface. */
void landing_offset(const spt_field *field, const spt_settings *settings, uint32_t checks,
                    size_t count, const landing_case *cases, landing_result *results);

/* The depth that a new origin is to have, twice the next ray's tolerance, and that tolerance. */
double landing_tolerance(const spt_settings *settings, const landing_result *result);

/* Checks that the state says what is true. */
void landing_expect_true(const landing *surface, const spt_settings *settings,
                         const landing_case *one, const landing_result *result);

/* The clearance of a point on the side that was asked for, f / lipschitz, in double. */
double landing_clearance(const landing *surface, const landing_case *one, const double p[3]);

#endif
