/* SPDX-License-Identifier: MIT
 *
 * What the tests of stiff, extreme and hostile cases share: the ways to run a case (every method,
 * width and form of callback), a case with its base scene, a callback that audits how it is
 * called, and the checks that every result must pass. Guarded memory is in stress_guard.h. */
#ifndef TESTS_STRESS_H
#define TESTS_STRESS_H

#include <spheretrace/bound.h>
#include <spheretrace/trace.h>

#include "check.h"

#include <stddef.h>
#include <stdint.h>

/* ---- Ways: the lists that every test loops over -------------------------------------------- */

enum {
    STRESS_CONVEX = 1u << 0,   /* the field is a convex function: spt_convex() runs as well */
    STRESS_BATCH = 1u << 1,    /* only the batch callback makes sense */
    STRESS_OWN_RAYS = 1u << 2, /* ways trace different rays: their results are not compared */
    STRESS_ONCE = 1u << 3      /* methods only, at the widest, with the batch callback */
};

typedef struct stress_way {
    const spt_method *method;
    const char *name;       /* of the method */
    uint32_t lanes;         /* settings.max_lanes, and the width that must run */
    int point;              /* the callback for one point instead of the batch */
    int index;              /* how many ways came before */
    uint32_t selection;     /* STRESS_* */
    int place;              /* in the product of the lists */
    uint64_t results;       /* hash of all results of this way so far */
    uint64_t first_results; /* of the first way of the same method */
    const spt_method *hashed;
} stress_way;

/*     for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) { ... }
 * runs the body once per method, width and form. A width that the machine lacks is left out, and
 * said so once. Results recorded by stress_run() must be the same bits for all widths and forms of
 * a method. */
stress_way stress_ways(uint32_t selection);
int stress_next(stress_way *way);

/* How many widths there are, and each: 1, 4, 8, 16. */
#define STRESS_WIDTHS 4
extern const uint32_t stress_widths[STRESS_WIDTHS];

/* ---- Cases --------------------------------------------------------------------------------- */

typedef float stress_distance_fn(const void *data, float x, float y, float z);

typedef struct stress_case {
    stress_distance_fn *distance; /* both forms of callback are made of it */
    const void *data;
    float lipschitz;
    const spt_bound *bound;
    spt_ray ray;
    float path;
    spt_settings settings; /* its method and max_lanes come from the way */
} stress_case;

typedef struct stress_sphere {
    float center[3], radius;
} stress_sphere;

/* |p - center| - radius; data is a stress_sphere. */
stress_distance_fn stress_sphere_distance;
/* data is a float: the value everywhere. */
stress_distance_fn stress_constant_distance;
/* p.y */
stress_distance_fn stress_floor_distance;

/* S0: the unit sphere at (0, 0, 10), origin 0, direction z, t in [0, 100], epsilon 1e-4, budget
 * 128. The hit is at 9. */
stress_case stress_base(void);
stress_case stress_case_of(stress_distance_fn *distance, const void *data);

/* ---- The audited callback ------------------------------------------------------------------ */

#define STRESS_RECORD 512

/* What the callback saw. Make one with stress_probe_of(). */
typedef struct stress_probe {
    stress_distance_fn *distance;
    const void *data;
    int single;      /* one ray only: all points of a batch must be the same */
    size_t calls;    /* of either callback */
    size_t points;   /* with padding */
    size_t faults;   /* broken promises of field.h */
    size_t recorded; /* the first point of each call, as long as there is room */
    float position[STRESS_RECORD][3];
    float value[STRESS_RECORD];
} stress_probe;

void stress_probe_of(stress_probe *probe, const stress_case *what, int single);
/* The field of a case for a way; user is the probe. */
spt_field stress_field(const stress_way *way, const stress_case *what, stress_probe *probe);
spt_settings stress_settings(const stress_way *way, const stress_case *what);

/* ---- Running ------------------------------------------------------------------------------- */

/* Traces the ray of a case and checks all that holds for every result: the table of outcomes in
 * trace.h, the counts, the candidate, the width that ran, how the callback was called. probe may be
 * NULL. Largest_slope of the call is left in stress_slope. */
spt_hit stress_run(stress_way *way, const stress_case *what, stress_probe *probe);
extern float stress_slope;

/* The checks of stress_run() on a result from elsewhere. */
void stress_check_hit(const stress_case *what, const spt_hit *hit);

/* Traces many rays of a case, statistics checked; the ray of the case is not used. */
void stress_run_many(const stress_way *way, const stress_case *what, size_t count,
                     const spt_ray *rays, spt_hit *hits);

/* The ray ended so, at t within the tolerance (t and tolerance are ignored where t is +infinity
 * by the outcome), after low to high evaluations. */
void stress_expect(const spt_hit *hit, spt_outcome outcome, double t, double tolerance);
void stress_expect_evaluations(const spt_hit *hit, uint32_t low, uint32_t high);

/* All bits of two hits are the same. */
int stress_same_hit(const spt_hit *a, const spt_hit *b);

/* The call is refused: SPT_BAD_ARGUMENT, not a byte of hits or statistics changed, no callback. */
void stress_refused(const stress_way *way, const stress_case *what);

/* ---- Numbers ------------------------------------------------------------------------------- */

double stress_length(const float vector[3]);
/* trace.h: max(epsilon, pixel_radius (path + t len), floor(t)), world length, in double. */
double stress_tolerance(const stress_case *what, float t);
/* Where the library asks for a value: origin + t * direction, one product and one sum an axis. */
void stress_position(const spt_ray *ray, float t, float position[3]);
float stress_value(const stress_case *what, float t);
/* The distance from |a| to the next float. */
double stress_ulp(double a);
int stress_is_nan(float a);
float stress_nan(void);
float stress_infinity(void);
float stress_from_bits(uint32_t bits);
/* a * 2^exponent, exact while in range. */
float stress_scaled(float a, int exponent);
int stress_within(double a, double b, double tolerance);

#endif
