/* SPDX-License-Identifier: MIT
 *
 * Progressive frames for the tests: schedules, runs in steps, and a shade callback that remembers
 * which pixel of which pass got which colour. */
#ifndef TESTS_ORACLE_FRAME_ADVANCE_H
#define TESTS_ORACLE_FRAME_ADVANCE_H

#include "frame_views.h"

/* ---- Schedules ----------------------------------------------------------------------------- */

enum { schedule_most = 6 };

typedef struct schedule {
    const char *name;
    size_t count;
    spt_pass passes[schedule_most];
} schedule;

/* Those of the paper by spt_passes(), and some whose resolutions do not divide one another. */
extern const schedule schedules[];
extern const int schedule_count;
void schedule_set(spt_frame *frame, const schedule *which);

/* The size of a pass: rounded up. */
uint32_t schedule_size(uint32_t full, const spt_pass *pass);

/* ---- Runs ---------------------------------------------------------------------------------- */

/* A progressive frame at work; state and size come from frame_state(). */
typedef struct advance {
    spt_frame *frame;
    void *state;
    size_t size;
    spt_hit *hits; /* of the region, or NULL */
    spt_frame_progress progress;
    uint64_t cones; /* evaluations of cones so far */
    uint64_t rays;  /* traced to their end so far */
} advance;

/* Blank hits and a state just begun. which: 0 .. 3, the memory of the state. */
advance advance_begin(spt_frame *frame, int which, spt_hit *hits);
/* One call. It spends what it is given, unless it finishes, and at most a batch more and the cones
 * that it sends ahead; progress never goes back; nothing restarts. */
void advance_step(advance *a, uint64_t evaluations);
int advance_finished(const advance *a);
/* Calls until it is finished. */
void advance_run(advance *a, uint64_t evaluations);
/* The same where no pixel is inactive: every result has then been written. */
void advance_finish(advance *a, uint64_t evaluations);

/* ---- Colours ------------------------------------------------------------------------------- */

enum { log_pixels = 64 * 64, log_channels = 3 };

/* One resolution of a schedule as the shade callback has seen it so far. */
typedef struct log_level {
    uint32_t width, height;
    size_t count; /* known */
    unsigned char known[log_pixels];
    float colour[log_pixels * log_channels];
} log_level;

/* faults: points that are no pixel of the pass at work, pixels that are shaded twice, rays that are
 * not the camera's. judged and wrong: hits compared with the truth, if a field is given. */
typedef struct shade_log {
    const spt_frame *frame;
    const truth_field *field;
    int level; /* at work */
    size_t faults, judged, wrong;
    log_level levels[schedule_most];
} shade_log;

/* An empty log that shades the frame, with log_channels colours. The whole image must be traced. */
void shade_log_open(shade_log *log, spt_frame *frame, const truth_field *field);
void shade_log_fn(void *user, size_t count, const float *x, const float *y, const spt_ray *rays,
                  const spt_hit *hits, float *colours);

#endif
