/* SPDX-License-Identifier: MIT
 *
 * Depth buffers both ways, against double precision, and frames whose rays end at a depth. */
#include "frame_camera.h"
#include "frame_views.h"
#include "../check.h"

#include <math.h>
#include <string.h>

enum { side_x = 33, side_y = 21, pixels = side_x * side_y };

static const double u = 0x1p-24;
static const double eye[3] = {3, 2, -7}, target[3] = {0.5, -1, 2};

typedef struct planes {
    uint32_t kind;
    double near_plane, far_plane;
} planes;

static const planes pinhole_planes[] = {
    {SPT_DEPTH_LINEAR, 0, 0},           {SPT_DEPTH_DEVICE, 0.1, 100},
    {SPT_DEPTH_DEVICE, 100, 0.1},       {SPT_DEPTH_DEVICE, 0.25, HUGE_VAL},
    {SPT_DEPTH_DEVICE, HUGE_VAL, 0.5},  {SPT_DEPTH_DEVICE, 3, 4},
    {SPT_DEPTH_DEVICE_GL, 0.1, 100},    {SPT_DEPTH_DEVICE_GL, 50, 1},
    {SPT_DEPTH_DEVICE_GL, 1, HUGE_VAL}, {SPT_DEPTH_DEVICE_GL, HUGE_VAL, 0.01},
};
static const planes parallel_planes[] = {
    {SPT_DEPTH_LINEAR, 0, 0},       {SPT_DEPTH_DEVICE, 0, 60},    {SPT_DEPTH_DEVICE, -20, 50},
    {SPT_DEPTH_DEVICE, 60, 0.5},    {SPT_DEPTH_DEVICE_GL, 0, 70}, {SPT_DEPTH_DEVICE_GL, 40, -5},
    {SPT_DEPTH_DEVICE_GL, -60, 30},
};
enum {
    pinhole_count = sizeof pinhole_planes / sizeof pinhole_planes[0],
    parallel_count = sizeof parallel_planes / sizeof parallel_planes[0]
};

/* A depth between the planes as a share of the way, in the buffer's numbers before clamping. h is
 * 1 / z for hyperbolic buffers and z for linear ones; so are the ends. slope: how much a change of
 * h changes it. */
typedef struct scale {
    double from, to; /* h at the near and at the far plane */
    int hyperbolic, gl;
} scale;

static scale scale_of(const planes *p, int pinhole) {
    scale s;
    s.hyperbolic = pinhole;
    s.gl = p->kind == SPT_DEPTH_DEVICE_GL;
    s.from = pinhole ? 1 / p->near_plane : p->near_plane;
    s.to = pinhole ? 1 / p->far_plane : p->far_plane;
    return s;
}

static double device_of(const scale *s, double h) {
    const double share = fmin(fmax((h - s->from) / (s->to - s->from), 0), 1);
    return s->gl ? 2 * share - 1 : share;
}

/* The cosine to the forward axis, and so length along it for 1 of the ray. */
static double cosine_of(const spt_frame *frame, size_t pixel) {
    const spt_camera *camera = frame->camera;
    const camera_ray ray = camera_ray_at(camera, frame->width, frame->height, frame_x(frame, pixel),
                                         frame_y(frame, pixel));
    double forward[3];
    for (int axis = 0; axis < 3; ++axis) forward[axis] = (double)camera->forward[axis];
    camera_unit(forward);
    return camera_dot(ray.direction, forward);
}

/* What float may do to z = t cos: the direction's rounding, a dot product of 3 terms, a product. */
static double z_error(const spt_frame *frame, size_t pixel) {
    const camera_ray ray = camera_ray_at(frame->camera, frame->width, frame->height,
                                         frame_x(frame, pixel), frame_y(frame, pixel));
    return 2 * ray.direction_error / cosine_of(frame, pixel) + 8 * u;
}

typedef struct depth_case {
    spt_field field;
    spt_scene scene;
    spt_camera camera;
    spt_frame frame;
} depth_case;

static float nowhere(void *user, float x, float y, float z) {
    (void)user;
    return x * x + y * y + z * z;
}

static void open_case(depth_case *c, int pinhole, uint32_t variant) {
    c->field = spt_field_default();
    c->field.point = nowhere;
    c->scene = spt_scene_default();
    c->scene.fields = &c->field;
    c->scene.count = 1;
    c->camera = camera_draw(pinhole ? SPT_CAMERA_PINHOLE : SPT_CAMERA_ORTHOGRAPHIC, variant, eye,
                            target, 1, 0.8, 1.5);
    CHECK(spt_frame_init(&c->frame, &c->scene, &c->camera, 64, 48) == SPT_OK);
    view_window(&c->frame, 7, 11, 7 + side_x, 11 + side_y);
}

/* Distances of all sizes, and a miss. */
static void draw_distances(float *t) {
    for (int i = 0; i < pixels; ++i) {
        t[i] = i % 17 == 0 ? INFINITY : (float)exp(check_uniform(-4, 6));
        if (i % 19 == 0) t[i] = 0;
    }
}

static void check_out(const depth_case *c, const planes *p, int pinhole) {
    static float t[pixels], to[2 * pixels];
    const spt_depth depth = {p->kind, (float)p->near_plane, (float)p->far_plane};
    const planes rounded = {p->kind, (double)depth.near_plane, (double)depth.far_plane};
    const scale s = scale_of(&rounded, pinhole);
    const spt_column from = {t, sizeof *t};
    const spt_sink sink = {to, 2 * sizeof *to};
    draw_distances(t);
    for (int i = 0; i < 2 * pixels; ++i) to[i] = 77;
    CHECK(spt_frame_depth(&c->frame, &depth, &from, &sink) == SPT_OK);
    for (size_t i = 0; i < pixels; ++i) {
        const double z = (double)t[i] * cosine_of(&c->frame, i), given = (double)to[2 * i];
        const double off = z_error(&c->frame, i);
        CHECK(check_same_bits(to[2 * i + 1], 77));
        if (p->kind == SPT_DEPTH_LINEAR) {
            CHECK_SAY(isinf(t[i]) ? isinf(to[2 * i]) && to[2 * i] > 0 : fabs(given - z) <= off * z,
                      "pixel %zu: t %g, depth %.9g, truth %.9g", i, (double)t[i], given, z);
        } else {
            const double h = s.hyperbolic ? 1 / z : z; /* of z = 0 infinite, clamped */
            const double truth = device_of(&s, h);
            const double part = isinf(h) ? 0 : off * h / fabs(s.to - s.from);
            CHECK_SAY(fabs(given - truth) <= (s.gl ? 2 : 1) * (part + 4 * u),
                      "pixel %zu: t %g, depth %.9g, truth %.9g", i, (double)t[i], given, truth);
            CHECK(given >= (s.gl ? -1 : 0) && given <= 1);
        }
    }
}

/* z at which the buffer has this number. */
static double depth_z(const planes *p, const scale *s, double given) {
    const double share = s->gl ? (given + 1) / 2 : given;
    const double h = s->from + share * (s->to - s->from);
    if (p->kind == SPT_DEPTH_LINEAR) return given;
    return s->hyperbolic ? 1 / h : h;
}

/* The error of h in float: u of each of its summands, and what that makes of z. */
static double depth_z_error(const planes *p, const scale *s, double given, double z) {
    const double share = s->gl ? (fabs(given) + 1) / 2 : fabs(given);
    const double off = 4 * u * (fabs(s->from) + share * (fabs(s->from) + fabs(s->to)));
    if (p->kind == SPT_DEPTH_LINEAR) return 0;
    return s->hyperbolic ? off * z * z / fmax(1 - off * z, 1e-9) : off;
}

static void check_in(const depth_case *c, const planes *p, int pinhole) {
    static float from[pixels], t[pixels];
    const spt_depth depth = {p->kind, (float)p->near_plane, (float)p->far_plane};
    const planes rounded = {p->kind, (double)depth.near_plane, (double)depth.far_plane};
    const scale s = scale_of(&rounded, pinhole);
    const spt_column column = {from, sizeof *from};
    const spt_sink sink = {t, sizeof *t};
    for (int i = 0; i < pixels; ++i) {
        const double low = s.gl ? -1 : 0;
        from[i] = (float)(p->kind == SPT_DEPTH_LINEAR ? exp(check_uniform(-4, 6))
                                                      : check_uniform(low, 1));
        if (i % 11 == 0) from[i] = p->kind == SPT_DEPTH_LINEAR ? INFINITY : 1;
        if (i % 13 == 0) from[i] = p->kind == SPT_DEPTH_LINEAR ? 0 : (float)low;
    }
    CHECK(spt_frame_t_of_depth(&c->frame, &depth, &column, &sink) == SPT_OK);
    for (size_t i = 0; i < pixels; ++i) {
        const double cosine = cosine_of(&c->frame, i), z = depth_z(&rounded, &s, (double)from[i]);
        const double off =
            z_error(&c->frame, i) * fabs(z) + depth_z_error(&rounded, &s, (double)from[i], z);
        /* At a plane at infinity, and where a summand's rounding may reach it. */
        if (isinf(z)) {
            CHECK_SAY(isinf(t[i]) && t[i] > 0, "pixel %zu: depth %g, t %g", i, (double)from[i],
                      (double)t[i]);
        } else if (off < fabs(z) / 4) {
            CHECK_SAY(fabs((double)t[i] * cosine - z) <= off + 1e-30,
                      "pixel %zu: depth %.9g, t %.9g, truth %.9g", i, (double)from[i], (double)t[i],
                      z / cosine);
        }
    }
}

/* There and back: the rounding of the stored depth, half an ulp of at most 1, is worth that much of
 * h, and h that much of z; besides, both ways' own errors. */
static void check_round_trip(const depth_case *c, const planes *p, int pinhole) {
    static float t[pixels], back[pixels];
    const spt_depth depth = {p->kind, (float)p->near_plane, (float)p->far_plane};
    const planes rounded = {p->kind, (double)depth.near_plane, (double)depth.far_plane};
    const scale s = scale_of(&rounded, pinhole);
    const spt_column t_column = {t, sizeof *t}, back_column = {back, sizeof *back};
    const spt_sink sink = {back, sizeof *back};
    int compared = 0;
    draw_distances(t);
    CHECK(spt_frame_depth(&c->frame, &depth, &t_column, &sink) == SPT_OK);
    /* In place is legal. */
    CHECK(spt_frame_t_of_depth(&c->frame, &depth, &back_column, &sink) == SPT_OK);
    for (size_t i = 0; i < pixels; ++i) {
        const double cosine = cosine_of(&c->frame, i), z = (double)t[i] * cosine;
        const double h = s.hyperbolic ? 1 / z : z, low = fmin(s.from, s.to);
        const double high = fmax(s.from, s.to), span = high - low;
        const double stored = device_of(&s, h);
        const double kept = span * (s.gl ? 2 : 1) * u;
        double off = 2 * z_error(&c->frame, i) * z;
        if (p->kind != SPT_DEPTH_LINEAR) {
            if (isinf(t[i]) || !(h > low && h < high)) continue; /* clamped */
            off += (s.hyperbolic ? 2 * kept * z * z : 2 * kept) +
                   2 * depth_z_error(&rounded, &s, stored, z);
            if (off > z / 4) continue;
        } else if (isinf(t[i])) {
            CHECK(isinf(back[i]));
            continue;
        }
        ++compared;
        CHECK_SAY(fabs((double)back[i] * cosine - z) <= off, "pixel %zu: t %.9g, back %.9g", i,
                  (double)t[i], (double)back[i]);
    }
    CHECK_SAY(compared > 10, "%d compared", compared);
}

static void all_cases(void (*check)(const depth_case *, const planes *, int)) {
    for (int pinhole = 0; pinhole < 2; ++pinhole) {
        const planes *list = pinhole ? pinhole_planes : parallel_planes;
        for (int i = 0; i < (pinhole ? pinhole_count : parallel_count); ++i) {
            for (uint32_t variant = 0; variant < CAMERA_VARIANTS; variant += 3) {
                depth_case c;
                open_case(&c, pinhole, variant);
                check_context("%s, variant %u, kind %u from %g to %g",
                              pinhole ? "pinhole" : "parallel", variant, list[i].kind,
                              list[i].near_plane, list[i].far_plane);
                check(&c, &list[i], pinhole);
            }
        }
    }
}

static void frame_depth_out(void) {
    all_cases(check_out);
}

static void frame_depth_in(void) {
    all_cases(check_in);
}

static void frame_depth_round_trip(void) {
    all_cases(check_round_trip);
}

/* ---- Refused ------------------------------------------------------------------------------- */

static void some_rays(void *user, size_t count, const float *x, const float *y,
                      spt_camera_ray *rays) {
    (void)user;
    for (size_t i = 0; i < count; ++i) {
        rays[i].ray.direction[0] = x[i];
        rays[i].ray.direction[1] = y[i];
        rays[i].ray.direction[2] = 1;
        memset(rays[i].ray.origin, 0, sizeof rays[i].ray.origin);
    }
}

static void check_refused(const spt_frame *frame, const spt_depth *depth, const spt_column *from,
                          const spt_sink *to, float *values, spt_status expected, const char *why) {
    float before[pixels];
    memcpy(before, values, sizeof before);
    CHECK_SAY(spt_frame_depth(frame, depth, from, to) == expected, "%s", why);
    CHECK_SAY(spt_frame_t_of_depth(frame, depth, from, to) == expected, "%s", why);
    CHECK_SAY(memcmp(before, values, sizeof before) == 0, "%s: written", why);
}

static void frame_depth_refuses(void) {
    static const spt_depth bad[] = {
        {0, 1, 2},
        {4, 1, 2},
        {SPT_DEPTH_DEVICE, 0, 2},
        {SPT_DEPTH_DEVICE, 1, -2},
        {SPT_DEPTH_DEVICE, 2, 2},
        {SPT_DEPTH_DEVICE, NAN, 2},
        {SPT_DEPTH_DEVICE, 1, NAN},
        {SPT_DEPTH_DEVICE_GL, -INFINITY, 2},
        {SPT_DEPTH_DEVICE_GL, INFINITY, INFINITY},
    };
    static const spt_depth bad_parallel[] = {{SPT_DEPTH_DEVICE, 1, INFINITY},
                                             {SPT_DEPTH_DEVICE, -INFINITY, 1},
                                             {SPT_DEPTH_DEVICE, 3, 3},
                                             {SPT_DEPTH_DEVICE_GL, NAN, 1}};
    static float t[pixels], to[pixels];
    const spt_column from = {t, sizeof *t}, absent = {NULL, 0};
    const spt_sink sink = {to, sizeof *to}, flat = {to, 0}, none = {NULL, 0};
    const spt_depth linear = {SPT_DEPTH_LINEAR, NAN, -1}; /* not used with this kind */
    spt_camera others;
    depth_case c;
    draw_distances(t);
    draw_distances(to);
    open_case(&c, 0, 0);
    for (size_t i = 0; i < sizeof bad_parallel / sizeof bad_parallel[0]; ++i) {
        check_refused(&c.frame, &bad_parallel[i], &from, &sink, to, SPT_BAD_ARGUMENT, "planes");
    }
    open_case(&c, 1, 0);
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i) {
        check_refused(&c.frame, &bad[i], &from, &sink, to, SPT_BAD_ARGUMENT, "planes");
    }
    check_refused(NULL, &linear, &from, &sink, to, SPT_BAD_ARGUMENT, "frame NULL");
    check_refused(&c.frame, NULL, &from, &sink, to, SPT_BAD_ARGUMENT, "depth NULL");
    check_refused(&c.frame, &linear, NULL, &sink, to, SPT_BAD_ARGUMENT, "column NULL");
    check_refused(&c.frame, &linear, &absent, &sink, to, SPT_BAD_ARGUMENT, "column absent");
    check_refused(&c.frame, &linear, &from, NULL, to, SPT_BAD_ARGUMENT, "sink NULL");
    check_refused(&c.frame, &linear, &from, &none, to, SPT_BAD_ARGUMENT, "sink absent");
    check_refused(&c.frame, &linear, &from, &flat, to, SPT_BAD_ARGUMENT, "sink of stride 0");
    c.frame.right = c.frame.width + 1;
    check_refused(&c.frame, &linear, &from, &sink, to, SPT_BAD_ARGUMENT, "region outside");
    open_case(&c, 1, 0);
    others = spt_camera_of_rays(some_rays, NULL);
    c.frame.camera = &others;
    check_refused(&c.frame, &linear, &from, &sink, to, SPT_UNSUPPORTED, "rays of the caller");
    open_case(&c, 1, 0);
    CHECK(spt_frame_depth(&c.frame, &linear, &from, &sink) == SPT_OK);
}

/* ---- Frames that end at a depth ------------------------------------------------------------ */

/* Rays end at the lesser of the camera's t_max and the column's. NaN is a bad ray, and what lies
 * before t_min a miss, of that pixel alone. */
static void frame_depth_limits_rays(void) {
    static view v;
    static spt_camera_ray rays[pixels];
    static spt_hit plain[pixels], hits[pixels], free_hits[pixels];
    static const float odd[] = {NAN, -INFINITY, -1, 0, INFINITY, 1e-30f};
    static float t_max[pixels];
    static const char *const names[] = {"village", "primitives", "sphere", "thin_torus"};
    for (int i = 0; i < 4; ++i) {
        uint32_t bad = 0, cut = 0;
        view_of(&v, scene_named(names[i]), SCENE_OBJECTS, 60, side_x, side_y);
        check_context("%s", names[i]);
        frame_trace(&v.frame, 0, free_hits);
        frame_rays(&v.frame, rays);
        for (int pixel = 0; pixel < pixels; ++pixel) {
            const double t = (double)free_hits[pixel].t;
            /* Before, at, and behind what is there. */
            t_max[pixel] = (float)(isinf(t) ? check_uniform(0, 70) : t * check_uniform(0.5, 1.5));
            if (check_random() % 5 == 0) t_max[pixel] = free_hits[pixel].t;
            if (check_random() % 4 == 0) t_max[pixel] = odd[check_random() % 6];
            if (!(t_max[pixel] >= rays[pixel].ray.t_max)) rays[pixel].ray.t_max = t_max[pixel];
        }
        v.frame.t_max.first = t_max;
        v.frame.t_max.stride = sizeof *t_max;
        frame_plain(&v.frame, rays, plain);
        frame_trace(&v.frame, SPT_FRAME_NO_CONES | SPT_FRAME_NO_CULLING, hits);
        frame_same(&v.frame, hits, plain, "plain");
        frame_trace(&v.frame, SPT_FRAME_NO_CONES, hits);
        frame_same_answer(&v.frame, hits, plain, "culled");
        frame_trace(&v.frame, 0, hits);
        for (int pixel = 0; pixel < pixels; ++pixel) {
            const int is_bad = isnan(t_max[pixel]);
            CHECK((hits[pixel].outcome == SPT_BAD_RAY) == is_bad);
            CHECK(is_bad || hits[pixel].outcome == SPT_MISS ||
                  (hits[pixel].t >= 0 && hits[pixel].t <= t_max[pixel]));
            if (t_max[pixel] < 0) CHECK(hits[pixel].outcome == SPT_MISS);
            /* Half a tolerance of the cone stop on either side of the end, either is right. */
            if (free_hits[pixel].outcome == SPT_HIT && t_max[pixel] > 1.1f * free_hits[pixel].t) {
                CHECK(hits[pixel].outcome == SPT_HIT);
            }
            bad += (uint32_t)is_bad;
            cut += free_hits[pixel].outcome == SPT_HIT && hits[pixel].outcome == SPT_MISS;
        }
        CHECK(bad > 5 && cut > 5);
    }
}

void suite_frame_depth(void) {
    RUN(frame_depth_out);
    RUN(frame_depth_in);
    RUN(frame_depth_round_trip);
    RUN(frame_depth_refuses);
    RUN(frame_depth_limits_rays);
}
