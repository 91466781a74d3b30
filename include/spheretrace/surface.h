/* SPDX-License-Identifier: MIT
 *
 * What renderers do once rays have met a surface: hits without steps between neighbouring pixels,
 * normals, origins of secondary rays, paths through convex bodies, crossings, occlusion, shadows,
 * collision. Left out: materials and light, which are the caller's.
 *
 * All calls take rays and hits as spt_trace() does (trace.h), in columns that are read where they
 * lie, and hold to the same promises: equal bits at every width and in every company, no memory
 * allocated, nothing global, any number of threads. Here a level of recursion takes at most 64 KiB
 * of stack besides the callback's own. A sink may lie on a column of the same ray or point, not on
 * one of another; with spt_crossings_of() on none.
 *
 * FIELDS. Where a call takes fields and a count, the count is 1 for the field that was traced, or
 * that of a scene's components, of which hits.component then says which was hit: pass scene.fields
 * and scene.count. Results that concern one surface are those of its own field. Fields are asked as
 * far outside their bounds as points lie there: refined hits, points beside a surface and offset
 * origins by a few tolerances or steps, samples of ambient occlusion and bodies wherever they are.
 *
 * WITHOUT A FUNCTION, because the columns do it:
 *   the next hit behind t  spt_trace() with rays.t_min the column of t, and SPT_SKIP_START
 *   closest approach       spt_trace() with SPT_CANDIDATE_CLOSEST: candidate_t, candidate_ratio
 *   occlusion in a scene   spt_scene_trace() with no sink but the outcome
 * (Keinert et al. 2014, sections 3.2 to 3.5; Szécsi et al. 2016, section 8.5.) */
#ifndef SPHERETRACE_SURFACE_H
#define SPHERETRACE_SURFACE_H

#include "base.h"
#include "field.h"
#include "trace.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Three columns that make vectors or points. */
typedef struct spt_vectors {
    spt_column axis[3];
} spt_vectors;

/* The same to be written. As with every sink, an absent one (first NULL) is not wanted. */
typedef struct spt_vector_sinks {
    spt_sink axis[3];
} spt_vector_sinks;

/* The view of an array of x, y, z, x, y, z ...; not NULL. */
static inline spt_vectors spt_vectors_of(const float *triples) {
    spt_vectors vectors;
    int axis;
    for (axis = 0; axis < 3; ++axis) {
        vectors.axis[axis].first = &triples[axis];
        vectors.axis[axis].stride = 3 * (ptrdiff_t)sizeof *triples;
    }
    return vectors;
}

static inline spt_vector_sinks spt_vector_sinks_of(float *triples) {
    spt_vector_sinks sinks;
    int axis;
    for (axis = 0; axis < 3; ++axis) {
        sinks.axis[axis].first = &triples[axis];
        sinks.axis[axis].stride = 3 * (ptrdiff_t)sizeof *triples;
    }
    return sinks;
}

/* ---- The hit itself ------------------------------------------------------------------------ */

/* How much of a pixel's area a silhouette covers that its ray just misses, in [0, 1/2]: an estimate
 * for antialiasing, 1/2 where the ray touches and 0 from half a pixel on. For misses and rays out
 * of budget; 1 for a hit. candidate_ratio as in spt_hits, of a ray traced without SPT_CANDIDATE_*;
 * pixel_radius > 0 the picture's half pixel, of rays that were traced with a smaller one or with
 * none: those that end at half a pixel hit what they would just miss. */
static inline float spt_coverage(int32_t outcome, float candidate_ratio, float pixel_radius) {
    const float covered = 0.5f - candidate_ratio / (2.0f * pixel_radius);
    if (outcome == SPT_HIT) return 1.0f;
    if (outcome != SPT_MISS && outcome != SPT_LIMIT) return 0.0f;
    return covered > 0.0f ? covered : 0.0f;
}

/* When a candidate counts as a hit. */
typedef enum spt_force {
    SPT_FORCE_PIXEL, /* out of budget, and within half a pixel of the surface: of rays that were
                      * traced with a smaller pixel_radius than is given here, or none */
    SPT_FORCE_LIMIT, /* out of budget */
    SPT_FORCE_ALWAYS /* even a miss: the point that came closest, as seen from the eye ("forceHit"
                      * of Keinert et al. 2014, Listing 2) */
} spt_force;

/* The t to shade: that of the hit, or of the candidate (without SPT_CANDIDATE_*) where `force` lets
 * it count, or +infinity. Source: Keinert et al. 2014, section 3.2; its listing returns infinity
 * where the text returns the candidate, which is what force decides. */
static inline float spt_hit_or_candidate(const spt_hit *hit, spt_force force, float pixel_radius) {
    const int limit = hit->outcome == SPT_LIMIT;
    if (hit->outcome == SPT_HIT) return hit->t;
    if (limit && force == SPT_FORCE_LIMIT) return hit->candidate_t;
    if (limit && hit->candidate_ratio < pixel_radius) return hit->candidate_t;
    if ((limit || hit->outcome == SPT_MISS) && force == SPT_FORCE_ALWAYS) return hit->candidate_t;
    return INFINITY;
}

/* A field that undoes the half pixel by which the stop at half a pixel inflates bodies: the level
 * set that lies share * pixel_radius * distance from the eye inside the surface. */
typedef struct spt_level_set {
    spt_field inner; /* as given */
    float eye[3], path, widening;
} spt_level_set;

/* Makes that field: f + lipschitz share pixel_radius (path + |p - eye|), so that rays stop where
 *     f / lipschitz < (1 - share) pixel_radius (path + t |direction|)
 * or, where those are more, within epsilon or the rounding floor of the level set.
 *   field         the field to be seen. Its bound is kept, and must hold the body as deep as the
 *                 level set lies, not only its surface; so are SPT_FIELD_CONVEX and its gradient,
 *                 for the normals of the body itself
 *   eye           where all rays begin; path what they have travelled before (0: primary rays), as
 *                 in their spt_rays.path
 *   share         of the half pixel that is undone, in [0, 1]; 0 leaves all as it is. A ball whose
 *                 silhouette holds 2092 pixel centres is hit by 2185 rays at 0, by 2138 at 0.5 and
 *                 by 2092 at 1. What is thinner than 2 share half pixels may vanish
 *   settings      pixel_radius is read, and becomes what the rays are to be traced with
 *   memory        must live as long as *result is used; not moved
 *   result        a field with a batch callback. Its residuals are those of the level set
 * For starts outside. Returns SPT_BAD_ARGUMENT for a bad field, settings, a NULL pointer or numbers
 * out of range, the new lipschitz = lipschitz (1 + share pixel_radius) included; nothing is written
 * then. Cost: a square root an evaluation (1 to 2 ns), no more evaluations.
 * Source: Keinert et al. 2014, section 3.2, after Hart 1996. */
SPT_API spt_status spt_level_set_field(const spt_field *field, const float eye[3], float path,
                                       float share, spt_settings *settings, spt_level_set *memory,
                                       spt_field *result);

/* Discontinuity reduction: moves hits along their rays to where f is what the pixel cone allows,
 * f(p) / lipschitz = pixel_radius (path + t |direction|), by a fixed-point iteration. Tracing
 * leaves f anywhere below that, with steps between neighbouring pixels that show as rings in
 * normals and textures; afterwards it is larger on average and smooth. Run it before both.
 *   fields       see above; each is the one that was traced, with the settings that it was
 *   iterations   rounds of the iteration, 0 to 16; 3 is usual
 *   hits         t, residual and outcome must be there; t and residual are read and rewritten,
 *                evaluations, if there, added to; flags, if there, and component, with more than
 *                one field, are read. Only SPT_HIT without SPT_FLAG_STEEP is moved
 * Hits farther from the surface than four times the tolerance stay (cuts of zones, starts inside).
 * A move is kept only if it brings f closer to the aim, is never longer than |f| / lipschitz plus
 * the allowance, and stays in [t_min, t_max]; so a hit is never worse than before. Leave
 * settings.pixel_radius as traced; with 0 the aim is f = 0. Returns SPT_BAD_ARGUMENT as spt_trace()
 * does, for absent sinks and iterations > 16. Cost: one evaluation a round for every hit that still
 * moves.
 * Source: Keinert et al. 2014, section 3.4, Equation 3, read as p + d (f - err); the guards are
 * ours: unguarded it diverges where f does not fall along the ray, or falls twice as fast. */
SPT_API spt_status spt_refine(const spt_field *fields, size_t field_count,
                              const spt_settings *settings, uint32_t iterations, size_t count,
                              const spt_rays *rays, const spt_hits *hits);

/* ---- Normals ------------------------------------------------------------------------------- */

typedef enum spt_normal_rule {
    SPT_NORMAL_TETRAHEDRON, /* four values, error of first order in the step */
    SPT_NORMAL_CENTRAL /* six values, second order: 12 to 35 times as accurate on round shapes */
} spt_normal_rule;

/* Unit normals, outward (the gradient of f), at hits.
 *   rule      not used where a field has a gradient callback
 *   detail    the size of the least features, world length, > 0 and finite; 0: 1, or a quarter of
 *             the bound's least side where that is less. The step of the differences follows from
 *             it and from the largest coordinate by the errors' derivation, and is an eighth of a
 *             pixel at least: worst angle of six values 9e-5 at coordinates of 100 details, of four
 *             3e-3. Within a step of an edge the normals of its sides are blended, which refraction
 *             shows as dotted lines: polyhedra want the callback, or a small detail
 *   rays      origin, direction, path; spt_rays.active leaves a ray's results as they are
 *   hits      t must be there; outcome, if there: only hits get a normal, the others zero
 *   normals   all three sinks must be there
 * A zero or non-finite gradient gives (0, 0, 0), never NaN. Returns SPT_BAD_ARGUMENT as spt_trace()
 * does. Normals at any points: rays of origin p, any direction, and t = 0. */
SPT_API spt_status spt_normals(const spt_field *fields, size_t field_count,
                               const spt_settings *settings, spt_normal_rule rule, float detail,
                               size_t count, const spt_rays *rays, const spt_hits *hits,
                               const spt_vector_sinks *normals);

/* ---- Secondary rays ------------------------------------------------------------------------ */

/* How well a secondary ray's origin is off the surface. */
typedef enum spt_start {
    SPT_START_CLEAR = 0, /* beyond the tolerance, on the side that was asked for */
    SPT_START_NEAR = 1,  /* on that side, but within the tolerance */
    SPT_START_AT_HIT = 2 /* no offset came to that side: the hit point itself */
} spt_start;

/* What spt_offset() writes; path and start may be absent. */
typedef struct spt_starts {
    spt_vector_sinks origin;
    spt_sink path;  /* float: world length up to the hit, for spt_rays.path of the new ray */
    spt_sink start; /* int32_t, spt_start */
} spt_starts;

/* Origins of secondary rays: the hit point moved along the normal to twice the tolerance that the
 * next ray will have there, on its own side (dynamic epsilon).
 *   hits      t, residual and outcome must be there, flags if rays began inside; only hits are
 *             done, and those farther from the surface than four times the tolerance are
 *             SPT_START_AT_HIT
 *   normals   as spt_normals() gives them (outward); a zero normal gives SPT_START_AT_HIT
 *   cross     or NULL. int32_t: 0 stay on the side that the ray came from (reflection, shadow),
 *             else cross the surface (refraction); absent: stay
 *   checks    most evaluations that look whether the new origin is where it should be, 0 to 4. 0
 *             trusts f to be the exact distance. Otherwise other depths are tried, three in all,
 *             where a bound that underestimates has not crossed, a gap is thinner than the offset
 *             or a sheet was crossed twice
 * settings are those of the next ray; epsilon is the least tolerance. Trace on with SPT_SKIP_START,
 * which changes nothing for SPT_START_CLEAR; for a ray in the open together with SPT_STOP_INSIDE:
 * in a corner a start may lie within the tolerance of a second surface and, once it has skipped
 * that, inside, where the ray would look for the way out. Do not pass the flags of a hit so found
 * to the next call. Returns SPT_BAD_ARGUMENT as spt_trace() does.
 * Source: Keinert et al. 2014, section 3.3. As printed (2 max(epsilon, |f|) along the normal) the
 * origin lies at max(2 epsilon - |f|, |f|), which the half-pixel stop takes for a hit at once; here
 * it is 2 max(epsilon, tolerance) whatever f is. */
SPT_API spt_status spt_offset(const spt_field *fields, size_t field_count,
                              const spt_settings *settings, size_t count, const spt_rays *rays,
                              const spt_hits *hits, const spt_vectors *normals,
                              const spt_column *cross, uint32_t checks, const spt_starts *starts);

/* ---- Convex bodies ------------------------------------------------------------------------- */

/* As spt_trace(), for a CONVEX BODY wholly inside the field's bound: rays that begin inside the
 * body are not marched through it but backwards from where they leave the bound (Keinert et al.
 * 2014, section 3.5, case 3). All go by spt_convex() where the field has SPT_FIELD_CONVEX, else by
 * settings.method.
 *   field      with a bound
 *   settings   SPT_STOP_INSIDE is refused. With SPT_SKIP_START a ray that begins on the surface
 *              itself (within the tolerance) is one from inside if it runs into the body, for which
 *              it looks at f half way to its hit (f falls on the way in), one evaluation more; and
 *              a miss otherwise. A ray from inside looks at f where it leaves the bound, and with
 *              SPT_CHECK_CONVEX half way to its hit as well, one evaluation more: f < 0 or f > 0
 *              there betrays a body that sticks out or is not convex, and the ray is traced
 *              forward, with SPT_FLAG_NOT_CONVEX. Unbetrayed, such a body gives its last exit, not
 *              the first
 * Other results as from spt_trace(): t between t_min and t_max, SPT_FLAG_INSIDE for rays from
 * inside, whose residual is f at the hit up to rounding. SPT_LIMIT from inside leaves t where the
 * ray began. Rays from inside have no candidate. evaluations <= budget holds for both ways
 * together. Where rounding at the end of the bound, 2^-22 (|origin|_inf + t_out |direction| +
 * size), exceeds an eighth of the tolerance, or the bound has no end, the ray is traced forward:
 * with the usual epsilon of 1e-4 where that sum exceeds 52.
 * Returns SPT_BAD_ARGUMENT as spt_trace() does, and for a field without bound.
 * Cost: four evaluations a ray from inside a dodecahedron, where marching through takes eleven. */
SPT_API spt_status spt_trace_convex(const spt_field *field, const spt_settings *settings,
                                    size_t count, const spt_rays *rays, const spt_hits *hits,
                                    spt_statistics *statistics);

/* ---- Queries ------------------------------------------------------------------------------- */

/* Whether something stops each ray: *occluded (int32_t) becomes 0 where the ray is certainly free
 * (SPT_MISS), else 1: a hit, a start inside (SPT_STOP_INSIDE is implied), and rays that came to no
 * end. A bad ray gives 0. Returns as spt_trace(); an absent sink is SPT_BAD_ARGUMENT. */
SPT_API spt_status spt_occluded(const spt_field *field, const spt_settings *settings, size_t count,
                                const spt_rays *rays, const spt_sink *occluded,
                                spt_statistics *statistics);

/* What spt_crossings_of() writes, each sink optional. */
typedef struct spt_crossings {
    spt_sink t;         /* float: the first crossing of each ray; the sink's stride leads to the
                         * next ray, */
    ptrdiff_t t_step;   /* and this many bytes lead to the same ray's next crossing */
    uint32_t most;      /* room for so many a ray, 1 to 1024 */
    spt_sink number;    /* uint32_t: how many there are, at most `most` */
    spt_sink inside;    /* int32_t: 1 where the ray begins inside; crossings alternate from there */
    spt_sink thickness; /* float: world length inside bodies between t_min and t_max, up to the
                         * last crossing unless all were found; +infinity where the ray ends inside
                         * and t_max is +infinity */
    spt_sink outcome;   /* int32_t: how the search ended: SPT_MISS all were found; SPT_HIT there was
                         * no room for more; SPT_LIMIT, SPT_NONFINITE and SPT_BAD_RAY as in
                         * spt_hits, behind the last crossing */
} spt_crossings;

/* All crossings of each ray with the surface, in ascending order, for CSG and media: entries and
 * exits in turn. A ray that comes within the tolerance and turns back has not crossed; a sheet or a
 * gap thinner than the tolerance may be passed over whole; and a ray that stays within it up to
 * t_max counts as outside there. Each t is at most a tolerance before its
 * crossing, by the cosine. settings.budget counts for each stretch between two approaches, of which
 * there are at most 2 most + 2. SPT_STOP_INSIDE is refused. Elements of t behind the last crossing
 * are not written. Returns SPT_BAD_ARGUMENT as spt_trace() does, and for a bad structure. */
SPT_API spt_status spt_crossings_of(const spt_field *field, const spt_settings *settings,
                                    size_t count, const spt_rays *rays,
                                    const spt_crossings *crossings, spt_statistics *statistics);

/* How much of a light of angular radius atan(tangent) is seen past what a shadow ray misses, in
 * [0, 1]; 0 for a hit. candidate_ratio from a ray traced with SPT_CANDIDATE_PENUMBRA, through a
 * field or a scene; best with spt_basic(): the longer the steps, the fewer samples tell (mean and
 * worst of the ratio over the true tangent, of 20 000 rays past a ball: basic .98 and .87,
 * auto_relaxed .97 and .38, adaptive .95 and .38, relaxed .91 and .03). Not the physical penumbra:
 * half of it, on the light's side (the ray to the light's centre is dark). tangent > 0. Source:
 * Szécsi et al. 2016, section 8.5. */
static inline float spt_penumbra(int32_t outcome, float candidate_ratio, float tangent) {
    const float seen = candidate_ratio / tangent;
    if (outcome != SPT_MISS && outcome != SPT_LIMIT) return 0.0f;
    return seen < 1.0f ? seen : 1.0f;
}

/* The same for rays against one field: *visibility (float) becomes spt_penumbra(), smoothed by
 * v^2 (3 - 2 v) if wished.
 *   rays      from the points towards the light; t_max at the light
 *   tangent   column of the tangents of the light's angular radius, > 0, finite; not absent
 * A bad ray or tangent gives 0. Returns as spt_trace(). */
SPT_API spt_status spt_soft_shadow(const spt_field *field, const spt_settings *settings,
                                   const spt_column *tangent, int smooth, size_t count,
                                   const spt_rays *rays, const spt_sink *visibility,
                                   spt_statistics *statistics);

/* Ambient occlusion from samples of the distance along the normal: *openness (float) becomes
 *     1 - sum_i 2^-i (i D - clamp(f(p + i D n), 0, i D)) / sum_i 2^-i i D,  i = 1 .. samples
 * 1 above a plane, 0 in a closed gap.
 *   fields    the least of all is taken; each divided by its lipschitz, which darkens
 *   samples   1 to 16; 5 is usual
 *   distance  D, world length, > 0 and finite; 5 % of the scene is usual
 *   points, normals  as columns, normals of unit length. Not finite, or samples of a point beyond
 *             FLT_MAX: openness 0
 * A value that is NaN or -infinity closes its sample. Returns SPT_BAD_ARGUMENT for bad arguments.
 * Cost: samples * field_count evaluations a point.
 * Source: Evans 2006, Fast Approximations for Global Illumination on Dynamic Scenes. */
SPT_API spt_status spt_ambient_occlusion(const spt_field *fields, size_t field_count,
                                         uint32_t samples, float distance, size_t count,
                                         const spt_vectors *points, const spt_vectors *normals,
                                         const spt_sink *openness);

/* Balls, or capsules, to be tested against the fields. World units. */
typedef struct spt_bodies {
    spt_vectors from, to; /* ends of the axis; `to` absent (all three): balls around `from` */
    spt_column radius;    /* >= 0; absent: 0 */
} spt_bodies;

/* What spt_collide() writes, each optional. */
typedef struct spt_contacts {
    spt_sink distance;       /* float: from body to surface; negative: the axis is so much deeper
                              * than the radius allows */
    spt_vector_sinks normal; /* unit gradient where the axis is nearest: the way out; 0: none */
    spt_sink place;          /* float: where on the axis that is, from 0 at from to 1 at to */
    spt_sink component;      /* int32_t: of which field; -1: none */
} spt_contacts;

/* How far balls and capsules are from the surface, or how deep in it. Along a capsule's axis the
 * nearest place is found by splitting where it may still lie (Piyavskii 1972; Shubert 1972), until
 * it is known within settings.epsilon or settings.budget is used up, at most 64 evaluations a body
 * and field.
 * distance is never more than the true one; for an axis inside a body that holds if f is exact
 * there, since other fields understate depths. For exact fields it is less by at most epsilon and a
 * few rounding floors, 2^-22 (largest coordinate of the axis + size + distance), unless the
 * evaluations ran out: 64 tell how far an axis is from a surface that it runs along, d away, within
 * (length / 32)^2 / 8 d or length / 64, whichever is less. With a budget of 0 it is -infinity.
 * Bodies that are not finite, or of negative radius, get distance +infinity and component -1; so
 * does a body where all fields give +infinity. A value that is NaN or -infinity gives distance
 * -infinity and the place that was asked. The detail for normals is that of spt_normals() at 0.
 * Returns SPT_BAD_ARGUMENT for bad arguments.
 * Cost: a ball takes one evaluation a field and 30 ns, a capsule that touches a round shape about
 * seven and 30 ns each; normals six more for one field of them. */
SPT_API spt_status spt_collide(const spt_field *fields, size_t field_count,
                               const spt_settings *settings, size_t count, const spt_bodies *bodies,
                               const spt_contacts *contacts);

#ifdef __cplusplus
}
#endif
#endif
