/* SPDX-License-Identifier: MIT
 *
 * The rays that the Whitted renderer traces, recorded so that they can be traced again and again:
 * the library's part of a frame, without the renderer's. Left out: shadow rays. */
#ifndef TESTS_BENCH_KEINERT_RECORD_H
#define TESTS_BENCH_KEINERT_RECORD_H

#include <whitted_queue.h>

/* Eye rays, rays that go on in the air, and rays in the body: WHITTED_PRIMARY to WHITTED_INSIDE. */
enum { KEINERT_KINDS = WHITTED_INSIDE + 1 };

typedef struct keinert_record {
    whitted_queue of[KEINERT_KINDS];
    float pixel_radius;
} keinert_record;

/* Renders a picture with the renderer's default settings, but every `step`-th tile only, and keeps
 * the rays as they were traced. Ends the program where memory runs out. */
void keinert_record_rays(const glass_world *world, const spt_field *field, int width, int height,
                         size_t step, keinert_record *record);
void keinert_record_free(keinert_record *record);

/* What rays of a kind are traced with. */
spt_settings keinert_record_settings(const keinert_record *record, whitted_kind kind,
                                     const spt_method *method);

#endif
