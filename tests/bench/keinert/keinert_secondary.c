/* SPDX-License-Identifier: MIT
 *
 * What an evaluation of secondary rays costs beside one of primary rays, in the same calls of
 * spt_trace(), and what a hit costs until its secondary rays can start. Writes
 * keinert_secondary.csv. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "keinert_bench.h"

/* Rays a call: those of a picture's tile of 64 x 64. */
enum { CALL = 4096, ROUNDS = 15 };

static const float towards_the_sun[3] = {-0.7011f, 0.6210f, 0.3506f};

/* BARE are the reflected rays once more, without SPT_SKIP_START. */
typedef enum ray_kind { PRIMARY, REFLECTED, SHADOW, BARE, KINDS } ray_kind;
static const char *const kind_names[KINDS] = {"primary", "reflected", "shadow", "no flag"};

typedef enum step { STEP_REFINE, STEP_TETRAHEDRON, STEP_CENTRAL, STEP_OFFSET, STEPS } step;
static const char *const step_names[STEPS] = {"spt_refine (3 rounds)", "spt_normals (tetrahedron)",
                                              "spt_normals (central)", "spt_offset (4 checks)"};

/* A ray with what it has travelled. */
typedef struct second_ray {
    spt_ray ray;
    float path;
} second_ray;

/* The rays of one call, and what comes of the primary ones. */
typedef struct second_call {
    const scene *shown;
    float pixel_radius;
    const spt_ray *primary;
    size_t count, secondary_count;
    spt_hit hits[CALL];
    float normals[3 * CALL], origins[3 * CALL], paths[CALL];
    int32_t starts[CALL];
    second_ray rays[BARE][CALL]; /* the secondary kinds */
} second_call;

static spt_settings settings_of(const second_call *call, ray_kind kind, int lanes) {
    spt_settings settings = bench_settings("adaptive", call->pixel_radius, lanes);
    settings.flags = kind == PRIMARY || kind == BARE ? 0 : SPT_SKIP_START;
    return settings;
}

static spt_rays columns_of(const second_call *call, ray_kind kind) {
    if (kind == PRIMARY) return spt_rays_of(call->primary);
    const second_ray *const first = call->rays[kind == BARE ? REFLECTED : kind];
    const ptrdiff_t stride = (ptrdiff_t)sizeof *first;
    spt_rays rays = spt_rays_of(&first->ray);
    for (int axis = 0; axis < 3; ++axis) {
        rays.origin[axis].stride = rays.direction[axis].stride = stride;
    }
    rays.t_min.stride = rays.t_max.stride = rays.path.stride = stride;
    rays.path.first = &first->path;
    return rays;
}

static size_t count_of(const second_call *call, ray_kind kind) {
    return kind == PRIMARY ? call->count : call->secondary_count;
}

/* budget: 1, to see what a ray costs before it has gone anywhere; or 0, the usual one. */
static void trace(const second_call *call, ray_kind kind, int lanes, uint32_t budget,
                  const spt_hits *hits, spt_statistics *statistics) {
    const spt_field field = scene_field(call->shown, lanes);
    const spt_rays rays = columns_of(call, kind);
    spt_settings settings = settings_of(call, kind, lanes);
    if (budget != 0) settings.budget = budget;
    keinert_expect(spt_trace(&field, &settings, count_of(call, kind), &rays, hits, statistics),
                   "spt_trace");
}

/* A step from the hits of a call to the starts of its secondary rays; refined hits are thrown
 * away, so that all steps see the same ones. */
static void take_step(second_call *call, step taken) {
    static spt_hit refined[CALL];
    const spt_field field = scene_field(call->shown, spt_lanes());
    const spt_settings settings = settings_of(call, REFLECTED, spt_lanes());
    const spt_rays rays = columns_of(call, PRIMARY);
    const spt_hits hits = spt_hits_of(call->hits), moved = spt_hits_of(refined);
    const spt_vectors normals = spt_vectors_of(call->normals);
    const spt_vector_sinks sinks = spt_vector_sinks_of(call->normals);
    const spt_starts starts = {spt_vector_sinks_of(call->origins),
                               {call->paths, (ptrdiff_t)sizeof *call->paths},
                               {call->starts, (ptrdiff_t)sizeof *call->starts}};
    const size_t count = call->count;
    spt_status status = SPT_OK;
    if (taken == STEP_REFINE) {
        memcpy(refined, call->hits, count * sizeof *refined);
        status = spt_refine(&field, 1, &settings, 3, count, &rays, &moved);
    } else if (taken == STEP_OFFSET) {
        status = spt_offset(&field, 1, &settings, count, &rays, &hits, &normals, NULL, 4, &starts);
    } else {
        const spt_normal_rule rule =
            taken == STEP_CENTRAL ? SPT_NORMAL_CENTRAL : SPT_NORMAL_TETRAHEDRON;
        status = spt_normals(&field, 1, &settings, rule, 0.0f, count, &rays, &hits, &sinks);
    }
    keinert_expect(status, step_names[taken]);
}

/* The secondary rays of all hits: mirrored, and to the sun. */
static void gather(second_call *call) {
    size_t number = 0;
    for (size_t i = 0; i < call->count; ++i) {
        const float *const d = call->primary[i].direction, *const n = &call->normals[3 * i];
        second_ray ray;
        if (call->hits[i].outcome != SPT_HIT || call->starts[i] == SPT_START_AT_HIT) continue;
        memcpy(ray.ray.origin, &call->origins[3 * i], sizeof ray.ray.origin);
        ray.ray.t_min = 0.0f;
        ray.ray.t_max = call->primary[i].t_max;
        ray.path = call->paths[i];
        memcpy(ray.ray.direction, towards_the_sun, sizeof ray.ray.direction);
        call->rays[SHADOW][number] = ray;
        const float along = d[0] * n[0] + d[1] * n[1] + d[2] * n[2];
        for (int axis = 0; axis < 3; ++axis) {
            ray.ray.direction[axis] = d[axis] - 2.0f * along * n[axis];
        }
        call->rays[REFLECTED][number] = ray;
        ++number;
    }
    call->secondary_count = number;
}

/* ---- Timing -------------------------------------------------------------------------------- */

/* What a call took, of processor time: repeated until the clock can tell. */
typedef struct second_times {
    double tracing[KINDS], starting[KINDS]; /* starting: with a budget of one evaluation */
    double steps[STEPS];
    double hits;
    spt_statistics counted[KINDS], started[KINDS];
} second_times;

static double time_tracing(const second_call *call, ray_kind kind, uint32_t budget, double least) {
    static bench_hit found[CALL];
    const spt_hits sinks = bench_hits_of(found);
    const double before = bench_seconds();
    double seconds;
    int times = 0;
    do {
        trace(call, kind, spt_lanes(), budget, &sinks, NULL);
        seconds = bench_seconds() - before;
        ++times;
    } while (seconds < least);
    return seconds / times;
}

static double time_step(second_call *call, step taken, double least) {
    const double before = bench_seconds();
    double seconds;
    int times = 0;
    do {
        take_step(call, taken);
        seconds = bench_seconds() - before;
        ++times;
    } while (seconds < least);
    return seconds / times;
}

/* Results of secondary rays with a single lane, which are to be the same. */
static size_t count_different(const second_call *call) {
    static bench_hit one[CALL], wide[CALL];
    size_t different = 0;
    for (int kind = REFLECTED; kind < KINDS; ++kind) {
        const spt_hits ones = bench_hits_of(one), wides = bench_hits_of(wide);
        trace(call, (ray_kind)kind, 1, 0, &ones, NULL);
        trace(call, (ray_kind)kind, spt_lanes(), 0, &wides, NULL);
        for (size_t i = 0; i < call->secondary_count; ++i) {
            different += memcmp(&one[i], &wide[i], sizeof one[i]) != 0;
        }
    }
    return different;
}

static size_t run_call(const bench_options *options, second_call *call, second_times *times) {
    const spt_hits hits = spt_hits_of(call->hits);
    spt_statistics *const counted = times->counted, *const started = times->started;
    for (int kind = 0; kind < KINDS; ++kind) {
        counted[kind] = started[kind] = spt_statistics_default();
    }
    trace(call, PRIMARY, spt_lanes(), 0, &hits, &counted[PRIMARY]);
    for (int taken = 0; taken < STEPS; ++taken) {
        times->steps[taken] = time_step(call, (step)taken, options->slice_seconds);
    }
    gather(call);
    times->hits = (double)counted[PRIMARY].outcomes[SPT_HIT];
    for (int kind = 0; kind < KINDS; ++kind) {
        static bench_hit found[CALL];
        const spt_hits sinks = bench_hits_of(found);
        const ray_kind traced = (ray_kind)kind;
        if (kind != PRIMARY) trace(call, traced, spt_lanes(), 0, &sinks, &counted[kind]);
        trace(call, traced, spt_lanes(), 1, &sinks, &started[kind]);
        times->tracing[kind] = time_tracing(call, traced, 0, options->slice_seconds);
        times->starting[kind] = time_tracing(call, traced, 1, options->slice_seconds);
    }
    return count_different(call);
}

/* ---- The tables ---------------------------------------------------------------------------- */

static double process_seconds(void *user) {
    (void)user;
    return bench_seconds();
}

static double of_evaluation(const second_times *times, int kind) {
    return 1e9 * times->tracing[kind] / (double)times->counted[kind].evaluations;
}

/* Of an evaluation behind a ray's first. */
static double of_further(const second_times *times, int kind) {
    const uint64_t first = times->started[kind].evaluations;
    const double further = (double)(times->counted[kind].evaluations - first);
    return 1e9 * (times->tracing[kind] - times->starting[kind]) / further;
}

static void print_kind(FILE *file, const scene *shown, const second_times *times, int kind) {
    double each[ROUNDS], ratios[ROUNDS], further[ROUNDS], further_ratios[ROUNDS], start[ROUNDS];
    spt_statistics sum = spt_statistics_default();
    for (int round = 0; round < ROUNDS; ++round) {
        const spt_statistics *const counted = &times[round].counted[kind];
        each[round] = of_evaluation(&times[round], kind);
        ratios[round] = each[round] / of_evaluation(&times[round], PRIMARY);
        further[round] = of_further(&times[round], kind);
        further_ratios[round] = further[round] / of_further(&times[round], PRIMARY);
        start[round] = 1e9 * times[round].starting[kind] / fmax((double)counted->rays, 1);
        sum.rays += counted->rays;
        sum.evaluations += counted->evaluations;
        sum.slots += counted->slots;
        sum.passes += counted->passes;
    }
    const double rays = (double)sum.rays, evaluations = (double)sum.evaluations;
    const double one = bench_median(each, ROUNDS), ratio = bench_median(ratios, ROUNDS);
    const double begun = bench_median(start, ROUNDS), next = bench_median(further, ROUNDS);
    const double next_ratio = bench_median(further_ratios, ROUNDS);
    const double a_pass = evaluations / (double)sum.passes;
    const double used = spt_utilisation(&sum);
    const char *const judged = ratio <= 1.1 ? "   reached" : "   NOT REACHED";
    printf("%-12s%-11s%9.0f%11.2f%12.1f%8.1f%9.2f%8.3f%9.1f%9.2f%8.3f%s\n", shown->name,
           kind_names[kind], rays / ROUNDS, evaluations / rays, a_pass, 100 * used, one, ratio,
           begun, next, next_ratio, kind == PRIMARY ? "" : judged);
    fprintf(file, "%s,%s,%.1f,%.4f,%.2f,%.4f,%.4f,%.4f,%.3f,%.4f,%.4f\n", shown->name,
            kind_names[kind], rays / ROUNDS, evaluations / rays, a_pass, used, one, ratio, begun,
            next, next_ratio);
}

static void print_steps(FILE *file, const scene *shown, const second_times *times) {
    spt_field_cost cost = {0, 0};
    const spt_field field = scene_field(shown, spt_lanes());
    keinert_expect(spt_field_measure(&field, process_seconds, NULL, &cost), "spt_field_measure");
    printf("%-12sns a hit:", shown->name);
    for (int taken = 0; taken < STEPS; ++taken) {
        double each[ROUNDS];
        for (int round = 0; round < ROUNDS; ++round) {
            each[round] = 1e9 * times[round].steps[taken] / fmax(times[round].hits, 1);
        }
        const double middle = bench_median(each, ROUNDS);
        printf("  %s %.1f", step_names[taken], middle);
        fprintf(file, "%s,%s a hit,,,,,%.4f,,,,\n", shown->name, step_names[taken], middle);
    }
    printf("\n%-12scallback: %.2f ns an evaluation by 16, %.2f by 256\n", "", cost.nanoseconds_16,
           cost.nanoseconds_256);
    fprintf(file, "%s,callback by 16,,,,,%.4f,,,,\n%s,callback by 256,,,,,%.4f,,,,\n", shown->name,
            cost.nanoseconds_16, shown->name, cost.nanoseconds_256);
}

int keinert_secondary(const bench_options *options) {
    static const char *const names[] = {"primitives", "village", "city", "mandelbulb", "jewel"};
    static second_call call;
    static second_times times[ROUNDS];
    size_t different = 0;
    FILE *file = bench_open(options, "keinert_secondary.csv",
                            "scene,what,rays_per_call,evaluations_per_ray,evaluations_per_pass,"
                            "utilisation,ns,ratio_to_primary,ns_per_ray_with_one_evaluation,"
                            "ns_per_further_evaluation,ratio_to_primary_of_further");
    printf(
        "\nSecondary rays in calls of spt_trace() for all hits of %d primary rays; goal: at most "
        "1.1 of a primary evaluation\n(start: ns of a ray with a budget of one evaluation; "
        "further: ns of an evaluation behind the first)\n%-12s%-11s%9s%11s%12s%8s%9s%8s%9s%9s%8s"
        "\n",
        CALL, "scene", "rays", "a call", "evals/ray", "evals/pass", "used %", "ns/eval", "ratio",
        "start", "further", "ratio");
    for (size_t i = 0; i < sizeof names / sizeof names[0]; ++i) {
        bench_picture picture =
            bench_picture_of(scene_named(names[i]), options->width, options->height);
        call.shown = scene_named(names[i]);
        call.pixel_radius = picture.pixel_radius;
        call.count = CALL;
        for (int round = 0; round < ROUNDS; ++round) {
            call.primary = picture.rays + bench_slice_start(&picture, CALL, round);
            different += run_call(options, &call, &times[round]);
        }
        for (int kind = 0; kind < KINDS; ++kind) print_kind(file, call.shown, times, kind);
        print_steps(file, call.shown, times);
        fflush(stdout);
        bench_picture_free(&picture);
    }
    fclose(file);
    if (different > 0) printf("%zu secondary results differ from those of one lane\n", different);
    return different == 0;
}
