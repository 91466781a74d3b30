/* SPDX-License-Identifier: MIT
 *
 * Building Embree's scenes and asking them. */
#include "peers_embree.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PACKET = 16, TILE_RAYS = SPT_TILE * SPT_TILE };

static void report(void *user, enum RTCError code, const char *text) {
    (void)user;
    fprintf(stderr, "Embree: error %d: %s\n", (int)code, text);
    exit(1);
}

/* The objects and their boxes, as the library's frames have them. */
static void fill_village(peers_village *village) {
    scene_parts *const parts = frame_allocate(sizeof *parts);
    scene_parts_of(scene_named("village"), SCENE_OBJECTS, 1, parts);
    village->count = (unsigned)parts->scene.count;
    for (unsigned i = 0; i < village->count; ++i) {
        peers_object *const object = &village->objects[i];
        object->house = parts->fields[i].user;
        frame_expect(spt_bound_extent(parts->fields[i].bound, object->low, object->high),
                     "spt_bound_extent");
    }
    free(parts);
}

static void add_objects(peers_embree *embree, RTCScene world) {
    RTCGeometry geometry = rtcNewGeometry(embree->device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, embree->village.count);
    rtcSetGeometryUserData(geometry, &embree->village);
    rtcSetGeometryBoundsFunction(geometry, peers_user_bounds, NULL);
    rtcSetGeometryIntersectFunction(geometry, peers_user_intersect);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(world, geometry);
    rtcReleaseGeometry(geometry);
}

peers_embree *peers_embree_of(const peers_step *step) {
    peers_embree *const embree = frame_allocate(sizeof *embree);
    embree->device = rtcNewDevice("threads=1");
    if (embree->device == NULL) report(NULL, rtcGetDeviceError(NULL), "no device");
    rtcSetDeviceErrorFunction(embree->device, report, NULL);
    embree->village.step = *step;
    fill_village(&embree->village);
    for (int kind = 0; kind < peers_kinds; ++kind) {
        const RTCScene world = rtcNewScene(embree->device);
        embree->worlds[kind] = world;
        rtcSetSceneBuildQuality(world, RTC_BUILD_QUALITY_HIGH);
        rtcSetSceneFlags(world, kind == PEERS_ROBUST ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
        if (kind == PEERS_USER) {
            add_objects(embree, world);
        } else {
            peers_add_triangles(embree->device, world);
        }
        rtcCommitScene(world);
    }
    return embree;
}

void peers_embree_free(peers_embree *embree) {
    for (int kind = 0; kind < peers_kinds; ++kind) rtcReleaseScene(embree->worlds[kind]);
    rtcReleaseDevice(embree->device);
    free(embree);
}

static void fill_single(struct RTCRayHit *to, const spt_ray *ray) {
    memset(to, 0, sizeof *to);
    to->ray.org_x = ray->origin[0];
    to->ray.org_y = ray->origin[1];
    to->ray.org_z = ray->origin[2];
    to->ray.dir_x = ray->direction[0];
    to->ray.dir_y = ray->direction[1];
    to->ray.dir_z = ray->direction[2];
    to->ray.tnear = ray->t_min;
    to->ray.tfar = ray->t_max;
    to->ray.mask = ~0u;
    to->hit.geomID = RTC_INVALID_GEOMETRY_ID;
    to->hit.primID = RTC_INVALID_GEOMETRY_ID;
    to->hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
}

static void fill_packet(struct RTCRayHit16 *to, unsigned lane, const spt_ray *ray) {
    to->ray.org_x[lane] = ray->origin[0];
    to->ray.org_y[lane] = ray->origin[1];
    to->ray.org_z[lane] = ray->origin[2];
    to->ray.dir_x[lane] = ray->direction[0];
    to->ray.dir_y[lane] = ray->direction[1];
    to->ray.dir_z[lane] = ray->direction[2];
    to->ray.tnear[lane] = ray->t_min;
    to->ray.tfar[lane] = ray->t_max;
    to->ray.time[lane] = 0;
    to->ray.mask[lane] = ~0u;
    to->ray.id[lane] = 0;
    to->ray.flags[lane] = 0;
    to->hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
    to->hit.primID[lane] = RTC_INVALID_GEOMETRY_ID;
    to->hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
}

static peers_hit hit_of(const spt_ray *ray, unsigned geometry, float t, float x, float y, float z) {
    const float along = x * ray->direction[0] + y * ray->direction[1] + z * ray->direction[2];
    const float length = spt_length_3(x, y, z);
    peers_hit hit;
    hit.t = geometry != RTC_INVALID_GEOMETRY_ID ? t : INFINITY;
    hit.cosine = length > 0 ? fabsf(along) / length : 0;
    return hit;
}

/* One tile at a time, so that rays and results stay in the second cache. Memory for either form;
 * Embree wants it aligned to 64. */
static union tile_memory {
    struct RTCRayHit single[TILE_RAYS];
    struct RTCRayHit16 packet[TILE_RAYS / PACKET];
} tile;

static double run_single(RTCScene world, size_t count, const spt_ray *rays, const size_t *pixel,
                         peers_hit *hits) {
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (size_t i = 0; i < count; ++i) fill_single(&tile.single[i], &rays[i]);
    const double before = bench_seconds();
    for (size_t i = 0; i < count; ++i) rtcIntersect1(world, &context, &tile.single[i]);
    const double seconds = bench_seconds() - before;
    for (size_t i = 0; i < count; ++i) {
        const struct RTCRayHit *const found = &tile.single[i];
        hits[pixel[i]] = hit_of(&rays[i], found->hit.geomID, found->ray.tfar, found->hit.Ng_x,
                                found->hit.Ng_y, found->hit.Ng_z);
    }
    return seconds;
}

/* 16 rays that follow one another are a block of 4x4 pixels. */
static double run_packets(RTCScene world, size_t count, const spt_ray *rays, const size_t *pixel,
                          peers_hit *hits) {
    RTC_ALIGN(64) int all[PACKET];
    RTC_ALIGN(64) int some[PACKET];
    struct RTCIntersectContext context;
    const size_t whole = count / PACKET, rest = count % PACKET;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (size_t i = 0; i < (whole + (rest > 0)) * PACKET; ++i) {
        const spt_ray *const ray = &rays[i < count ? i : count - 1];
        fill_packet(&tile.packet[i / PACKET], i % PACKET, ray);
    }
    for (size_t lane = 0; lane < PACKET; ++lane) {
        all[lane] = -1;
        some[lane] = lane < rest ? -1 : 0;
    }
    const double before = bench_seconds();
    for (size_t i = 0; i < whole; ++i) rtcIntersect16(all, world, &context, &tile.packet[i]);
    if (rest > 0) rtcIntersect16(some, world, &context, &tile.packet[whole]);
    const double seconds = bench_seconds() - before;
    for (size_t i = 0; i < count; ++i) {
        const struct RTCRayHit16 *const found = &tile.packet[i / PACKET];
        const size_t k = i % PACKET;
        hits[pixel[i]] = hit_of(&rays[i], found->hit.geomID[k], found->ray.tfar[k],
                                found->hit.Ng_x[k], found->hit.Ng_y[k], found->hit.Ng_z[k]);
    }
    return seconds;
}

double peers_embree_run(const peers_embree *embree, peers_kind kind, int packets,
                        const frame_picture *picture, frame_slice slice, peers_hit *hits) {
    const RTCScene world = embree->worlds[kind];
    double seconds = 0;
    for (size_t i = slice.begin; i < slice.end; ++i) {
        const size_t start = picture->first[i], count = picture->first[i + 1] - start;
        const spt_ray *const rays = picture->rays + start;
        const size_t *const pixel = picture->pixel + start;
        seconds += packets ? run_packets(world, count, rays, pixel, hits)
                           : run_single(world, count, rays, pixel, hits);
    }
    return seconds;
}
