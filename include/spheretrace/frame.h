/* SPDX-License-Identifier: MIT
 *
 * Whole pictures of a scene: cameras, tiles with culling and cone marching, passes of rising
 * resolution that can be interrupted, and depth buffers. Shading is the caller's.
 *
 * A picture is traced tile by tile. A tile first leaves out the components that its bundle of rays
 * cannot meet, then walks cones of 16x16 and of 4x4 pixels through what is empty (Bálint & Valasek
 * 2018, section 4, with the step that makes it safe), and only then traces rays, from where their
 * cone stopped.
 *
 * LAYOUTS of spt_settings inside spt_frame, spt_pass, spt_depth, spt_camera_ray and
 * spt_frame_progress are frozen, as those of spt_ray and spt_hit are; new members go to the ends of
 * structures that begin with their size.
 *
 * THREADS. Tiles are independent: any number of threads may trace any tiles in any order, and the
 * results are the same bits. A spt_frame is a plain description: copy it for each thread and give
 * each copy a workspace (and statistics) of its own. */
#ifndef SPHERETRACE_FRAME_H
#define SPHERETRACE_FRAME_H

#include "base.h"
#include "scene.h"
#include "trace.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Cameras ------------------------------------------------------------------------------- */

typedef enum spt_camera_kind {
    SPT_CAMERA_PINHOLE = 1,      /* all rays start at eye */
    SPT_CAMERA_ORTHOGRAPHIC = 2, /* all rays run along forward */
    SPT_CAMERA_RAYS = 3          /* the caller's callback */
} spt_camera_kind;

/* A ray of a caller's camera. It comes preset: t_min 0, t_max +infinity, path 0, active. */
typedef struct spt_camera_ray {
    spt_ray ray;    /* where a direction is not of length 1 within 1e-5, its block of 4x4 pixels
                     * goes without cones and culling */
    float path;     /* world length travelled before (spt_rays.path) */
    int32_t active; /* 0: no ray here; the pixel's results are left as they are */
} spt_camera_ray;

/* The rays through count (1 .. SPT_BATCH) points of the image: x[i] from 0 at the left edge to
 * frame.width at the right, y[i] from 0 at the top to frame.height at the bottom. Must answer
 * the same for the same point, from any thread. Asked for whole chunks of 16x16 pixels, so also
 * for points of the image outside of the frame's region. Secondary rays are traced by a camera,
 * too: one whose callback makes the shadow ray of a pixel from its hit gives a shadow pass,
 * which can run at a lower resolution, be interrupted and be resumed like any other. */
typedef void spt_camera_fn(void *user, size_t count, const float *x, const float *y,
                           spt_camera_ray *rays);

/* A camera. The point of the image plane at (x, y) belongs to the ray
 *     pinhole       from eye along forward + x right + y up
 *     orthographic  from eye + x right + y up along forward
 * brought to unit length, so that t is the distance. The image shows the window x_low .. x_high
 * (left to right), y_low .. y_high (bottom to top): a window that is not centred is an off-axis
 * camera, pixels need not be square, and low > high mirrors.
 * The three axes must be finite and span space; unit vectors at right angles are usual. */
typedef struct spt_camera {
    size_t struct_size; /* set by the functions below */
    uint32_t kind;      /* spt_camera_kind */
    float eye[3];
    float right[3], up[3], forward[3];
    float x_low, x_high, y_low, y_high; /* pinhole: tangents; orthographic: in units of the axes */
    float t_min, t_max;                 /* of all rays: t_min >= 0 and finite, t_max may be
                                         * +infinity. Not used with SPT_CAMERA_RAYS */
    spt_camera_fn *rays;                /* SPT_CAMERA_RAYS */
    void *user;
} spt_camera;

/* A pinhole camera with square pixels.
 *   eye, target  where it is, and a point in the middle of the picture; not the same
 *   up           what is up in the picture; not along the line of sight
 *   tangent      half the picture's width at distance 1: tan(horizontal field of view / 2), > 0
 *   width, height  of the picture, for its aspect
 * t_min 0, t_max +infinity. Returns SPT_BAD_ARGUMENT for a NULL pointer, a number that is not
 * finite, or vectors that span no picture. */
SPT_API spt_status spt_camera_pinhole(spt_camera *camera, const float eye[3], const float target[3],
                                      const float up[3], float tangent, uint32_t width,
                                      uint32_t height);

/* The same for an orthographic camera; half_width is half the picture's width in world units. */
SPT_API spt_status spt_camera_orthographic(spt_camera *camera, const float eye[3],
                                           const float target[3], const float up[3],
                                           float half_width, uint32_t width, uint32_t height);

/* A camera of the caller's rays. */
static inline spt_camera spt_camera_of_rays(spt_camera_fn *rays, void *user) {
    spt_camera camera = {0, 0, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, 0,
                         0, 0, 0,         0,         0,         NULL,      NULL};
    camera.struct_size = sizeof camera;
    camera.kind = SPT_CAMERA_RAYS;
    camera.rays = rays;
    camera.user = user;
    return camera;
}

/* The rays that a frame of width x height pixels traces through count points (as in spt_camera_fn;
 * a pixel's centre is at +0.5), with the same bits. Any count. Returns SPT_BAD_ARGUMENT for a bad
 * camera, a size of 0 or a NULL pointer. */
SPT_API spt_status spt_camera_rays(const spt_camera *camera, uint32_t width, uint32_t height,
                                   size_t count, const float *x, const float *y,
                                   spt_camera_ray *rays);

/* ---- Frames -------------------------------------------------------------------------------- */

/* Pixels on a side of a tile. Tiles are counted from the image's upper left corner, so that a part
 * of an image holds the same bits as the whole. */
#define SPT_TILE 64

enum {
    SPT_FRAME_NO_CONES = 1u << 0,  /* rays start at t_min, or at the entry of a bound */
    SPT_FRAME_NO_CULLING = 1u << 1 /* no component is left out for a whole tile */
};

/* One resolution of a schedule (Bálint & Valasek 2018, section 4): numerator / denominator of the
 * full size on each side, rounded up, in (0, 1]; and the share of settings.budget that a ray of it
 * may take, in (0, 1]. */
typedef struct spt_pass {
    uint32_t numerator, denominator;
    float share;
} spt_pass;

/* The schedules of the paper by their number of resolutions: 1: full size; 2: 1/2, 1; 4: 1/4, 1/2,
 * 3/4, 1; 6: sixths. All but the last pass have a share of 1/8, the last one the rest (the paper's
 * six shares are printed with one missing). NULL for any other number. */
SPT_API const spt_pass *spt_passes(size_t count);

/* Called after each tile with how many are done; a result other than 0 ends the call. */
typedef int spt_progress_fn(void *user, size_t done, size_t total);

/* Colours of count (1 .. SPT_BATCH) pixels of a pass: colours[i * channels + c]. rays and hits are
 * those of the pixels; where nothing is active, hits are misses. x, y as in spt_camera_fn. */
typedef void spt_shade_fn(void *user, size_t count, const float *x, const float *y,
                          const spt_ray *rays, const spt_hit *hits, float *colours);

typedef struct spt_frame {
    size_t struct_size; /* set by spt_frame_init() */
    const spt_scene *scene;
    const spt_camera *camera;
    spt_settings settings;             /* spt_frame_init() sets pixel_radius for the camera */
    uint32_t width, height;            /* of the whole image, pixels, 1 .. 2^22 */
    uint32_t left, top, right, bottom; /* the region that is traced: left <= x < right, top <= y <
                                        * bottom. Results are counted in it: (y - top) *
                                        * (right - left) + x - left */
    uint32_t flags;                    /* SPT_FRAME_*; default 0 */
    spt_column t_max;                  /* by pixel of the region, in t: rays end there too (a depth
                                        * buffer, see spt_frame_t_of_depth()); absent: no. Not in
                                        * passes of lower resolution */
    const spt_pass *passes;            /* for spt_frame_advance(): the last must be of full size;
                                        * NULL: a single one */
    size_t pass_count;                 /* 1 .. 16 where passes is not NULL */
    spt_shade_fn *shade;               /* for spt_frame_advance(), or NULL */
    void *shade_user;
    uint32_t channels;         /* floats a colour has, 1 .. 16 where shade is not NULL */
    spt_progress_fn *progress; /* for spt_frame_trace(), or NULL */
    void *progress_user;
    void *workspace;            /* of the thread, any alignment; */
    size_t workspace_size;      /* at least spt_frame_workspace() */
    spt_statistics *statistics; /* of the thread, or NULL */
} spt_frame;

/* A frame of the whole image: default settings, pixel_radius half the lesser side of a pixel at
 * distance 1 (0 for orthographic cameras, whose epsilon becomes half a pixel, and for the caller's
 * rays, who sets it by himself), one pass, no colours, no workspace yet. Returns SPT_BAD_ARGUMENT
 * for a NULL pointer, a bad camera or a size outside its range. */
SPT_API spt_status spt_frame_init(spt_frame *frame, const spt_scene *scene,
                                  const spt_camera *camera, uint32_t width, uint32_t height);

/* Bytes of workspace for a thread that traces this frame: about 47 KiB a component and 180 KiB, or
 * 13 KiB a component of more than 256. 0 for a bad frame. */
SPT_API size_t spt_frame_workspace(const spt_frame *frame);

/* How many tiles cover the region; 0 for a bad frame, and an empty region is one. */
SPT_API size_t spt_frame_tiles(const spt_frame *frame);

/* The pixels of the region in tile index: area receives left, top, right, bottom in the whole
 * image. Returns SPT_BAD_ARGUMENT for a bad frame or an index not below spt_frame_tiles(). */
SPT_API spt_status spt_frame_area(const spt_frame *frame, size_t index, uint32_t area[4]);

/* Traces one tile of the region. image: sinks for the whole region (spt_hits), of which only this
 * tile's pixels are written. Results are those of spt_scene_trace() for the same rays, but that
 * each component is traced from where the cone along it stopped; evaluations are those of the ray
 * itself, and the statistics count those of cones apart. Returns SPT_BAD_ARGUMENT, with nothing
 * written, for a bad frame, index or image, or no workspace, SPT_BUFFER_TOO_SMALL for one too
 * small. */
SPT_API spt_status spt_frame_tile(const spt_frame *frame, size_t index, const spt_hits *image);

/* Traces the tiles first .. first + count - 1, calling frame->progress after each. done receives
 * how many were traced, less than count if progress ended the call; it may be NULL. Status as
 * spt_frame_tile(). */
SPT_API spt_status spt_frame_trace(const spt_frame *frame, size_t first, size_t count,
                                   const spt_hits *image, size_t *done);

/* ---- Progressive frames -------------------------------------------------------------------- */

/* How far a progressive frame is. */
typedef struct spt_frame_progress {
    uint32_t pass;        /* the pass at work; pass_count when finished */
    uint32_t restarted;   /* 1: this call found the frame changed and began anew */
    uint64_t pixels;      /* of this pass that are done, and */
    uint64_t pixel_count; /* all of it */
    uint64_t evaluations; /* since the start, cones included */
} spt_frame_progress;

/* Bytes of state that spt_frame_advance() keeps for this frame between calls; 0 for a bad frame.
 * The calls work in the state, which points into itself: where it was moved they begin anew.
 * They do not use frame->workspace. */
SPT_API size_t spt_frame_state_size(const spt_frame *frame);

/* Begins anew: before the first spt_frame_advance() with this state, and whenever the scene has
 * changed in a way that the frame does not show (a callback that answers differently). state is the
 * caller's memory, any alignment; SPT_BUFFER_TOO_SMALL below spt_frame_state_size(). */
SPT_API spt_status spt_frame_restart(const spt_frame *frame, void *state, size_t state_size);

/* Goes on with a progressive frame for about `evaluations` evaluations: it stops after the batch of
 * at most SPT_BATCH with which it has spent them, wherever the rays are, and a later call goes on
 * from there; only a bracket that is closed, and starts that are skipped, go to their end. A chunk
 * counts as 64 of them besides, so that an empty picture takes its time, too. The results of any
 * division into calls have the same bits.
 *   image     sinks for the region, written by the last pass, each pixel once its chunk is
 *             finished; or NULL
 *   progress  receives how far it is, or NULL
 * A pass of lower resolution walks a cone for every pixel of it and, where there is frame->shade to
 * colour it, traces the ray in its middle, with a pixel_radius as much larger as its pixels are;
 * each ray of the next pass starts at the least t of all cones that its pixel overlaps, so that
 * resolutions need not divide one another (section 4 of the paper takes the closest one, which
 * loses pixels). Begins anew by itself when the camera, the settings, the size or the passes of the
 * frame differ from the last call's (the numbers in them, and the pointers to the caller's). */
SPT_API spt_status spt_frame_advance(const spt_frame *frame, void *state, size_t state_size,
                                     uint64_t evaluations, const spt_hits *image,
                                     spt_frame_progress *progress);

/* The same for about `seconds` (>= 0) of the caller's clock: how many evaluations that is comes
 * from what those so far took. A clock that stands still over 2^16 evaluations gives
 * SPT_UNSUPPORTED. */
SPT_API spt_status spt_frame_advance_for(const spt_frame *frame, void *state, size_t state_size,
                                         double seconds, spt_clock_fn *clock, void *clock_user,
                                         const spt_hits *image, spt_frame_progress *progress);

/* The best picture so far, at any moment between calls: for every pixel of the region the colour
 * that frame->shade gave it, or where the last pass has not been yet the bilinear colour of the
 * finest pass below that has been there on all four sides; 0 where there is none. picture: the
 * first channel of each pixel, frame->channels floats one after another. Returns SPT_BAD_ARGUMENT
 * without frame->shade, or for a state that was begun with another frame, SPT_BUFFER_TOO_SMALL
 * below spt_frame_state_size(). */
SPT_API spt_status spt_frame_picture(const spt_frame *frame, const void *state, size_t state_size,
                                     const spt_sink *picture);

/* ---- Depth buffers ------------------------------------------------------------------------- */

typedef enum spt_depth_kind {
    SPT_DEPTH_LINEAR = 1,   /* length along the camera's forward axis */
    SPT_DEPTH_DEVICE = 2,   /* 0 at near_plane to 1 at far_plane, as Direct3D and Vulkan have it */
    SPT_DEPTH_DEVICE_GL = 3 /* -1 at near_plane to 1 at far_plane, as OpenGL has it */
} spt_depth_kind;

/* What numbers a depth buffer holds. Planes are lengths along forward, > 0, different, one may be
 * +infinity; near_plane > far_plane is a reversed buffer. Pinhole cameras: hyperbolic in the depth;
 * orthographic: linear, planes finite, which may then be 0 or negative. */
typedef struct spt_depth {
    uint32_t kind;               /* spt_depth_kind */
    float near_plane, far_plane; /* not used with SPT_DEPTH_LINEAR */
} spt_depth;

/* Depth out: from the t of each pixel of the region (+infinity for a miss) to what a depth buffer
 * holds; device depths are clamped to their range. In place is legal. Returns SPT_BAD_ARGUMENT for
 * bad arguments, SPT_UNSUPPORTED for a camera of the caller's rays. */
SPT_API spt_status spt_frame_depth(const spt_frame *frame, const spt_depth *depth,
                                   const spt_column *t, const spt_sink *to);

/* Depth in: the t of each pixel at which its ray reaches the depth that a buffer holds, for
 * spt_frame.t_max; the far plane gives +infinity where it is at infinity, else its distance. */
SPT_API spt_status spt_frame_t_of_depth(const spt_frame *frame, const spt_depth *depth,
                                        const spt_column *from, const spt_sink *t);

#ifdef __cplusplus
}
#endif
#endif
