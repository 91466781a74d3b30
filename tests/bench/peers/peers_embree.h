/* SPDX-License-Identifier: MIT
 *
 * The village in Embree 3: as user geometry and as triangles, asked ray by ray and in packets of
 * 16. */
#ifndef TESTS_BENCH_PEERS_EMBREE_H
#define TESTS_BENCH_PEERS_EMBREE_H

#include "../frame/frame_picture.h"
#include "peers_user.h"

typedef enum peers_kind {
    PEERS_USER, /* user geometry */
    PEERS_TRIANGLES,
    PEERS_ROBUST, /* triangles with RTC_SCENE_FLAG_ROBUST: nothing passes between two */
    peers_kinds
} peers_kind;

typedef struct peers_embree {
    RTCDevice device;
    RTCScene worlds[peers_kinds];
    peers_village village;
} peers_embree;

/* What a ray met. cosine: between ray and surface, where the scene knows a normal. */
typedef struct peers_hit {
    float t; /* +infinity: nothing */
    float cosine;
} peers_hit;

peers_embree *peers_embree_of(const peers_step *step);
void peers_embree_free(peers_embree *embree);

/* Seconds for the tiles of a slice: of Embree's calls alone, rays laid out as it wants them before
 * and results taken out after. hits: by pixel. */
double peers_embree_run(const peers_embree *embree, peers_kind kind, int packets,
                        const frame_picture *picture, frame_slice slice, peers_hit *hits);

/* The triangles of the village, added to a scene. */
void peers_add_triangles(RTCDevice device, RTCScene world);

#endif
