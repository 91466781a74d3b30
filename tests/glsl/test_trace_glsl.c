/* SPDX-License-Identifier: MIT
 *
 * Equal bits on GPUs: what emitted shaders answer for rays is what the C library answers, on every
 * engine that is here. */
#include "glsl_check.h"
#include "glsl_job.h"
#include "rules.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define ALL_HITS (SPT_GLSL_FLAGS | SPT_GLSL_CANDIDATE | SPT_GLSL_FALLBACKS | SPT_GLSL_COMPONENT)
#define NUMBERS \
    (1u << SPT_GLSL_NAME_EPSILON | 1u << SPT_GLSL_NAME_PIXEL_RADIUS | \
     1u << SPT_GLSL_NAME_RELAXATION | 1u << SPT_GLSL_NAME_EXTRAPOLATION | \
     1u << SPT_GLSL_NAME_SLOPE_BLEND | 1u << SPT_GLSL_NAME_STEP_CAP)

/* With a small epsilon the rounding floor decides. */
static const glsl_case cases[] = {
    {"plain", 0, 0, 0, 80, 1e-4f, 0, 0},
    {"all", SPT_GLSL_GUARDS | ALL_HITS | SPT_GLSL_PATH, 0, 0, 60, 1e-5f, 2e-3f, 1.5f},
    {"skip start", SPT_GLSL_GUARDS | SPT_GLSL_FALLBACKS, SPT_SKIP_START, 0, 60, 1e-7f, 1e-3f, 0},
    {"stop inside", SPT_GLSL_FLAGS, SPT_STOP_INSIDE, 0, 100, 1e-7f, 0, 2},
    {"penumbra", SPT_GLSL_GUARDS | SPT_GLSL_CANDIDATE, SPT_CANDIDATE_PENUMBRA, 0, 60, 1e-4f, 0, 0},
    {"closest", SPT_GLSL_CANDIDATE | SPT_GLSL_FALLBACKS | SPT_GLSL_PATH, SPT_CANDIDATE_CLOSEST, 0,
     80, 1e-4f, 1e-3f, 0},
    {"all flags", SPT_GLSL_GUARDS | ALL_HITS | SPT_GLSL_PATH,
     SPT_SKIP_START | SPT_STOP_INSIDE | SPT_CANDIDATE_CLOSEST, 0, 30, 1e-6f, 2e-3f, 1},
    {"uniforms", SPT_GLSL_GUARDS | SPT_GLSL_CANDIDATE, 0, NUMBERS, 60, 1e-4f, 1e-3f, 0},
    {"arrays", SPT_GLSL_GUARDS | SPT_GLSL_ARRAYS | SPT_GLSL_FLAGS, 0, 0, 60, 1e-4f, 1e-3f, 0},
    {"small budget", SPT_GLSL_GUARDS | ALL_HITS, SPT_CANDIDATE_PENUMBRA, 0, 5, 1e-4f, 0, 0},
    {"floor", SPT_GLSL_GUARDS | SPT_GLSL_CANDIDATE | SPT_GLSL_FALLBACKS, 0, 0, 90, 1e-8f, 0, 0.5f},
    {"skip and stop", SPT_GLSL_PATH, SPT_SKIP_START | SPT_STOP_INSIDE, 0, 80, 1e-4f, 1e-3f, 0},
};
enum { case_count = sizeof cases / sizeof cases[0] };

static const uint32_t targets[] = {SPT_GLSL_COMPUTE_450, SPT_GLSL_FRAGMENT_330,
                                   SPT_GLSL_COMPUTE_310_ES, SPT_GLSL_FRAGMENT_300_ES,
                                   SPT_GLSL_COMPUTE_430};
static const char *const target_names[SPT_GLSL_TARGETS] = {"library", "330", "300 es", "Shadertoy",
                                                           "310 es",  "430", "450",    "Vulkan"};
enum { target_count = sizeof targets / sizeof targets[0] };

static char said[2048];

/* How an engine errs: whether operations stay as they are written, and how much sines do. */
typedef struct precision {
    int keeps_bits;
    float sine;
} precision;
/* sin and cos to an ulp, pow to 30 (of about 1) */
static const precision mesa = {1, 4e-6f};
static const precision swiftshader = {1, 1.9e-4f};
/* A text without `precise`: c + (x + d) becomes (c + d) + x there, with constants c and d. */
static const precision swiftshader_without = {0, 1.9e-4f};

static struct {
    int rays, different;
    int estimated, outcomes; /* of subjects with transcendental functions: rays, other outcomes */
} compared;

static void check_bits_of(const glsl_job *job, int demanded) {
    const int different = glsl_job_differences(job, said, sizeof said);
    compared.rays += GLSL_RAYS;
    compared.different += different;
    if (demanded) {
        CHECK_SAY(different == 0, "%d of %d rays differ; %s", different, GLSL_RAYS, said);
        return;
    }
    const int far = glsl_job_far(job, said, sizeof said);
    CHECK_SAY(far == 0, "%d of %d rays end elsewhere; %s", far, GLSL_RAYS, said);
}

static void check_places_of(const glsl_job *job, float sine) {
    int outcomes;
    const float error = job->subject->wobble * sine + 2e-6f;
    const int wrong = glsl_job_wrong(job, error, &outcomes, said, sizeof said);
    CHECK_SAY(wrong == 0, "%d of %d rays end in the open; %s", wrong, GLSL_RAYS, said);
    compared.estimated += GLSL_RAYS;
    compared.outcomes += outcomes;
}

static void check_job(const glsl_job *job, const precision *engine) {
    if ((job->subject->traits & GLSL_TRANSCENDENTAL) != 0) {
        check_places_of(job, engine->sine);
    } else {
        check_bits_of(job, engine->keeps_bits);
    }
}

static void report(const char *engine) {
    printf("%s: %d of %d rays have the bits of C\n", engine, compared.rays - compared.different,
           compared.rays);
    printf("    with transcendental functions %d of %d rays have another outcome\n",
           compared.outcomes, compared.estimated);
    CHECK(compared.rays > 0 && compared.estimated > 0);
    /* The silhouette moves by what the functions err, far less than a pixel. */
    CHECK(compared.outcomes * 1000 < compared.estimated);
    memset(&compared, 0, sizeof compared);
}

static void say_where(const glsl_subject *subject, const glsl_case *how, const rule *one,
                      uint32_t target, const char *engine) {
    check_context("%s, %s, %s, %s, %s", subject->name, how->name, one->name, target_names[target],
                  engine);
}

/* The next case that a subject and a step rule allow, or NULL. */
static const glsl_case *next_case(const glsl_subject *subject, const rule *one, uint32_t target,
                                  int *turn) {
    for (int tries = 0; tries < case_count; ++tries) {
        const glsl_case *how = &cases[(*turn)++ % case_count];
        if (glsl_job_allowed(subject, how, one->method(), target)) return how;
    }
    return NULL;
}

/* SPT_THOROUGH=1 asks for all combinations, which take minutes. */
static int thorough(void) {
    const char *asked = getenv("SPT_THOROUGH");
    return asked != NULL && strcmp(asked, "1") == 0;
}

/* Bodies are hit and missed, so that the comparisons below compare something. */
static void T0_subjects(void) {
    static glsl_job job;
    int count;
    const glsl_subject *all = glsl_subjects(&count);
    for (int i = 0; i < count; ++i) {
        int outcomes[SPT_OUTCOMES] = {0};
        check_context("%s", all[i].name);
        CHECK(glsl_job_make(&job, &all[i], &cases[1], spt_adaptive(), SPT_GLSL_COMPUTE_450));
        for (int k = 0; k < GLSL_RAYS; ++k) ++outcomes[job.expected[k].outcome];
        CHECK_SAY(outcomes[SPT_HIT] >= 30 && outcomes[SPT_MISS] >= 50 &&
                      outcomes[SPT_BAD_RAY] >= 50,
                  "%d hits, %d misses", outcomes[SPT_HIT], outcomes[SPT_MISS]);
        glsl_job_release(&job);
    }
}

/* Every subject with every step rule: of the cases one in six, on one of the targets in turn; so
 * each rule and each case meets each target with some subject. */
static void T1_llvmpipe(void) {
    static glsl_job job;
    const int every = thorough() ? 1 : 6;
    int count, turn = 0;
    const glsl_subject *all = glsl_subjects(&count);
    for (int i = 0; i < count * rule_count * case_count; ++i) {
        const glsl_subject *subject = &all[i / case_count / rule_count];
        const rule *one = &rules[i / case_count % rule_count];
        const glsl_case *how = &cases[i % case_count];
        const uint32_t target = targets[turn % target_count];
        if (!glsl_job_allowed(subject, how, one->method(), target)) continue;
        if ((i + i / case_count) % every != 0) continue;
        ++turn;
        say_where(subject, how, one, target, engine_gl_name());
        const int made = glsl_job_make(&job, subject, how, one->method(), target);
        CHECK(made);
        if (made) {
            CHECK(glsl_job_run(&job, ENGINE_GLSLANG) == ENGINE_OK);
            check_job(&job, &mesa);
        }
        glsl_job_release(&job);
    }
    report(engine_gl_name());
}

/* Vulkan: every second pair of a subject and a step rule, with one case and one compiler in turn. */
static void check_vulkan(engine_device device, int turn) {
    static glsl_job job;
    int count, runs = 0;
    const glsl_subject *all = glsl_subjects(&count);
    if (!engine_here(engine_vulkan_use(device), device == ENGINE_LAVAPIPE
                                                    ? "no lavapipe (mesa-vulkan-drivers)"
                                                    : "no SwiftShader (chromium)")) {
        return;
    }
    for (int pair = 0; pair < count * rule_count; ++pair) {
        const glsl_subject *subject = &all[pair / rule_count];
        const rule *one = &rules[pair % rule_count];
        const glsl_case *how = next_case(subject, one, SPT_GLSL_VULKAN_450, &turn);
        const int second = (pair + pair / rule_count) % 2 == (int)device;
        if (how == NULL || !(second || thorough())) continue;
        const engine_compiler compiler = runs++ % 2 == 0 ? ENGINE_GLSLANG : ENGINE_GLSLC;
        say_where(subject, how, one, SPT_GLSL_VULKAN_450, engine_vulkan_name());
        const int made = glsl_job_make(&job, subject, how, one->method(), SPT_GLSL_VULKAN_450);
        CHECK(made);
        const int status = made ? glsl_job_run(&job, compiler) : ENGINE_FAILED;
        if (made &&
            engine_here(status, compiler == ENGINE_GLSLC ? "no glslc" : "no glslangValidator")) {
            CHECK(status == ENGINE_OK);
            check_job(&job, device == ENGINE_LAVAPIPE ? &mesa : &swiftshader);
        }
        glsl_job_release(&job);
    }
    report(engine_vulkan_name());
}

static void T2_lavapipe(void) {
    check_vulkan(ENGINE_LAVAPIPE, 0);
}

static void T3_swiftshader(void) {
    check_vulkan(ENGINE_VULKAN_SWIFTSHADER, 3);
}

/* In one page of a browser: the same, with other cases. */
static void check_browser(engine_browser browser, int turn, const precision *engine) {
    int count, jobs = 0;
    const glsl_subject *all = glsl_subjects(&count);
    const int most = count * rule_count;
    glsl_job *job = malloc((size_t)most * sizeof *job);
    engine_fragment *runs = malloc((size_t)most * sizeof *runs);
    const rule **used = malloc((size_t)most * sizeof *used);
    int *statuses = malloc((size_t)most * sizeof *statuses);
    CHECK(job != NULL && runs != NULL && used != NULL && statuses != NULL);
    for (int pair = 0; pair < most; ++pair) {
        const glsl_subject *subject = &all[pair / rule_count];
        const rule *one = &rules[pair % rule_count];
        const glsl_case *how = next_case(subject, one, SPT_GLSL_FRAGMENT_300_ES, &turn);
        if (how == NULL) continue;
        say_where(subject, how, one, SPT_GLSL_FRAGMENT_300_ES, "browser");
        const int made =
            glsl_job_make(&job[jobs], subject, how, one->method(), SPT_GLSL_FRAGMENT_300_ES);
        CHECK(made);
        used[jobs] = one;
        jobs += made;
    }
    for (int i = 0; i < jobs; ++i) runs[i] = glsl_job_fragment(&job[i]);
    const int status = engine_browser_fragments(browser, jobs, runs, statuses);
    if (engine_here(status, "no Chromium with WebGL 2 on the processor")) {
        CHECK(status == ENGINE_OK);
        for (int i = 0; i < jobs; ++i) {
            say_where(job[i].subject, job[i].how, used[i], SPT_GLSL_FRAGMENT_300_ES,
                      engine_browser_name());
            CHECK(statuses[i] == ENGINE_OK);
            if (statuses[i] == ENGINE_OK) check_job(&job[i], engine);
        }
        report(engine_browser_name());
    }
    for (int i = 0; i < jobs; ++i) glsl_job_release(&job[i]);
    free(job);
    free(runs);
    free(used);
    free(statuses);
}

static void T4_browser(void) {
    check_browser(ENGINE_SWIFTSHADER, 1, &swiftshader_without);
}

/* ANGLE translates the text for the driver; `invariant` outputs keep the bits. */
static void T5_angle(void) {
    check_browser(ENGINE_ANGLE_LLVMPIPE, 2, &mesa);
}

void suite_trace_glsl(void) {
    RUN(T0_subjects);
    RUN(T1_llvmpipe);
    RUN(T2_lavapipe);
    RUN(T3_swiftshader);
    RUN(T4_browser);
    RUN(T5_angle);
}
