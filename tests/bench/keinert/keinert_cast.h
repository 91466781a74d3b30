/* SPDX-License-Identifier: MIT
 *
 * Ways to cast rays, and a picture that they are tried on. Belongs to keinert_cast.c. */
#ifndef TESTS_BENCH_KEINERT_CAST_H
#define TESTS_BENCH_KEINERT_CAST_H

#include "../frame/frame_picture.h"
#include "keinert_bench.h"

typedef enum cast_kind {
    CAST_TRACE,     /* spt_trace() */
    CAST_SCALAR,    /* the same with the callback that was built without vectors */
    CAST_FRAME,     /* a frame with cones */
    CAST_LISTING_1, /* the paper's, which stops at a constant distance */
    CAST_LISTING_2  /* and at half a pixel; with an omega of 1 it is the first with that stop */
} cast_kind;

typedef struct cast_rule {
    const char *name;
    cast_kind kind;
    const char *method; /* of the library */
    float relaxation;
    int against; /* its place in the list */
    int judged;
} cast_rule;

/* One scene, and a buffer for the hits of one contender at a time. */
typedef struct cast_track {
    const bench_options *options;
    scene shown;
    frame_picture *picture;
    bench_hit *hits;  /* by ray */
    bench_hit *image; /* by pixel, of frames */
    double *last_t;   /* of each ray: truth.h */
} cast_track;

typedef struct cast_runner {
    const cast_rule *rule;
    const cast_track *track;
    frame_tracer *tracer; /* of a frame, or NULL */
    float *depth;         /* of each ray's hit before the surface; NAN: none, or another surface */
} cast_runner;

void cast_enter(cast_runner *runner, const cast_rule *rule, const cast_track *track);
void cast_leave(cast_runner *runner);

/* Casts the rays of a slice into the track's hits. */
void cast_slice(const cast_runner *runner, frame_slice slice);

/* Casts the whole picture, and fills in what the hits are worth. */
void cast_judge(cast_runner *runner, keinert_row *row);

/* Results of a single lane that are not as those of the picture that was judged last. */
size_t cast_count_different(const cast_runner *runner);

#endif
