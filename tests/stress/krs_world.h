/* SPDX-License-Identifier: MIT
 *
 * A small world for the calls of krs_calls.h: callers' fields that audit how they are asked, a model
 * of every sort made of them and of the library's own kernels, rays that meet them, and hits. */
#ifndef TESTS_KRS_WORLD_H
#define TESTS_KRS_WORLD_H

#include "krs_calls.h"

#include <string.h>

enum { krs_most = 72, krs_witnesses = 3, krs_levels = 3, krs_fill = 0xa5 };

/* How the callers' fields of a world are. */
enum {
    KRS_POINT = 1u << 0,    /* callbacks for one point */
    KRS_GRADIENT = 1u << 1, /* with gradient callbacks */
    krs_forms = 4
};

/* A caller's field: a ball, of twice its distance. */
typedef struct krs_witness {
    float center[3], radius;
    float (*answer)(const struct krs_witness *self, float x, float y, float z); /* or NULL */
    int scribbles;           /* over its points, as field.h permits */
    void (*visit)(void *to); /* called from each callback, or NULL */
    void *visited;
    size_t calls, points, faults; /* broken promises of field.h */
    float fault[3];               /* the first of them */
} krs_witness;

typedef struct krs_world {
    uint32_t form, lanes;
    krs_witness witness[krs_witnesses];
    spt_bound inner_bound[krs_witnesses], map_bound;
    spt_field inner[krs_witnesses];
    spt_kernel kernels[krs_levels + 1], mapped_kernels[krs_levels + 1];
    spt_mirror mirrors[krs_levels];
    spt_mobius maps[krs_levels];
    spt_krs_model model;
    spt_moekrs_model mapped_model;
    spt_distortion distortion, unmapping;
    spt_krs krs;
    spt_moekrs moekrs;
    spt_conformal conformal;
    spt_distorted distorted, unmapped;
    spt_field fields[KRS_DOOR_UNMAPPED + 1]; /* by door */
    spt_probe probes[2];
    spt_binary binary;
    spt_settings settings;
    spt_statistics statistics;
    uint32_t in[krs_inputs][krs_most];
    uint32_t found[2][krs_hit_sinks][krs_most];
    unsigned char out[krs_outputs][krs_most][8];
} krs_world;

/* Fills the world, whose address stays in it. Returns 0 where a model was refused. */
int krs_world_make(krs_world *world, uint32_t form, uint32_t lanes);

/* Makes the models anew of what describes them. */
int krs_world_models(krs_world *world);

/* Other models of the same kernels, mirrors and maps, and hits on them: `variant` of them is 0 to
 * krs_variants - 1, of which the first is that of krs_world_make(). */
enum { krs_variants = 4 };
int krs_world_vary(krs_world *world, int variant);

/* A call on it that is right in everything; empties the outputs and what the witnesses saw. */
void krs_world_call(krs_call *call, krs_world *world, krs_door door);

float krs_witness_distance(const krs_witness *self, float x, float y, float z);
size_t krs_world_calls(const krs_world *world);
size_t krs_world_faults(const krs_world *world);
void krs_world_visit(krs_world *world, void (*visit)(void *to), void *visited);

/* Equality byte by byte, holes between members included, which assignments copy or not: they are no
 * values that anybody forgot to set. */
#if defined(__has_feature)
#if __has_feature(memory_sanitizer)
#include <sanitizer/msan_interface.h>
#define KRS_SETTLE_HOLES(memory, size) __msan_unpoison(memory, size)
#endif
#endif
#ifndef KRS_SETTLE_HOLES
#define KRS_SETTLE_HOLES(memory, size) ((void)(memory), (void)(size))
#endif

static inline int krs_same_bytes(void *a, void *b, size_t size) {
    KRS_SETTLE_HOLES(a, size);
    KRS_SETTLE_HOLES(b, size);
    return memcmp(a, b, size) == 0;
}

#endif
