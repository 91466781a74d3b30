/* SPDX-License-Identifier: MIT
 *
 * How many instructions spt_trace() takes with each of its options, in a pass of the kernel and in
 * the whole call, for 16 rays: this program runs its own calls one instruction at a time. Needs no
 * tool, but Linux on x86-64. Left out: what a callback takes, and padding, which does nothing.
 *
 * usage: left_out_count off|quick|full. Prints option (off: none), rule, instruction set,
 * instructions of a pass, of the call (empty: not counted). off: without options and calls, for
 * kernels that have none; quick: options that concern kernels, and all of the default rule on the
 * widest set; full: all, and calls of the default rule. */
#define _GNU_SOURCE
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <ucontext.h>

#include "../../src/trace/method.h"
#include "../rules.h"
#include "left_out_options.h"

enum { rays_of_a_call = 16, passes = 2, trap_flag = 0x100 };

/* ---- One instruction at a time -------------------------------------------------------------- */

/* Where execution is: in a function from its first instruction until it is back at the address that
 * lay on the stack there. 0: not in it. */
static volatile struct {
    uintptr_t call, kernel, callback;
    uintptr_t call_end, kernel_end, callback_end;
    unsigned long in_call, in_kernel;
    int waiting; /* passes until the steps begin */
    int on;
    int kernel_only; /* they end with the kernel */
} steps;

/* What compilers put before loops to align them: 0x66 .. 0f 1f and 0x90. */
static int is_padding(const unsigned char *code) {
    while (*code == 0x66 || *code == 0x2e) ++code;
    return *code == 0x90 || (code[0] == 0x0f && code[1] == 0x1f);
}

/* Called before each instruction. */
static void step(int signal_number, siginfo_t *info, void *context) {
    greg_t *const registers = ((ucontext_t *)context)->uc_mcontext.gregs;
    const uintptr_t at = (uintptr_t)registers[REG_RIP];
    uintptr_t back;
    (void)signal_number;
    (void)info;
    memcpy(&back, (const void *)(uintptr_t)registers[REG_RSP], sizeof back);
    if (at == steps.callback_end) steps.callback_end = 0;
    if (at == steps.call_end) steps.call_end = 0;
    if (at == steps.kernel_end) {
        steps.kernel_end = 0;
        if (steps.kernel_only) steps.on = 0;
    }
    registers[REG_EFL] =
        steps.on ? registers[REG_EFL] | trap_flag : registers[REG_EFL] & ~trap_flag;
    if (at == steps.callback) steps.callback_end = back;
    if (at == steps.call) steps.call_end = back;
    if (at == steps.kernel) steps.kernel_end = back;
    if (steps.callback_end != 0 || is_padding((const unsigned char *)at)) return;
    if (steps.call_end != 0) steps.in_call += 1;
    if (steps.kernel_end != 0) steps.in_kernel += 1;
}

static void begin_steps(void) {
    steps.on = 1;
    raise(SIGTRAP);
}

/* ---- Calls ---------------------------------------------------------------------------------- */

static spt_ray ray[rays_of_a_call];
static spt_hit hit[rays_of_a_call];

/* An ellipsoid by a lower bound, in whose corner over-relaxed probes are rejected; a convex one. */
static void distance(void *user, size_t n, const float *x, const float *y, const float *z,
                     float *to) {
    (void)user;
    if (steps.waiting > 0 && --steps.waiting == 0) begin_steps();
    for (size_t i = 0; i < n; ++i) {
        const float across = 2.0f * x[i];
        to[i] = 0.5f * (sqrtf(across * across + y[i] * y[i] + z[i] * z[i]) - 1.0f);
    }
}

static option_call plain_call(const spt_method *method, int lanes) {
    spt_field field = spt_field_default();
    spt_settings settings = spt_settings_default();
    field.batch = distance;
    field.flags = SPT_FIELD_CONVEX;
    settings.method = method;
    settings.max_lanes = (uint32_t)lanes;
    settings.budget = passes;
    return option_call_of(&field, &settings, ray, hit);
}

static void run(const option_call *call) {
    if (option_call_run(call, rays_of_a_call) != SPT_OK) exit(1);
}

/* ---- Counting ------------------------------------------------------------------------------- */

static unsigned wants_of(const option_call *call) {
    const int flags = call->hits.flags.first != NULL || call->counted;
    const int fallbacks = call->hits.fallbacks.first != NULL || call->counted;
    return (call->hits.candidate_t.first != NULL ? SPTI_WANT_CANDIDATE : 0u) |
           (flags ? SPTI_WANT_SLOPE : 0u) | (fallbacks ? SPTI_WANT_FALLBACKS : 0u);
}

static void prepare_steps(const option_call *call) {
    const spti_isa built = spti_isa_choose(call->settings.max_lanes);
    memset((void *)&steps, 0, sizeof steps);
    steps.call = (uintptr_t)spt_trace;
    steps.callback = (uintptr_t)distance;
    steps.kernel = (uintptr_t)call->settings.method->march[built][wants_of(call)];
}

/* Of the last pass. */
static unsigned long count_kernel(const option_call *call) {
    prepare_steps(call);
    steps.waiting = passes;
    steps.kernel_only = 1;
    run(call);
    if (steps.on || steps.in_kernel == 0) exit(1);
    return steps.in_kernel;
}

static unsigned long count_call_of(const option_call *call) {
    run(call); /* what is linked at the first call is linked now */
    prepare_steps(call);
    begin_steps();
    run(call);
    steps.on = 0;
    raise(SIGTRAP);
    if (steps.in_kernel == 0 || steps.in_kernel >= steps.in_call) exit(1);
    return steps.in_call;
}

static void count(const char *name, const char *isa, const option_call *call, int whole) {
    const char *const method = spt_method_name(call->settings.method);
    printf("%s,%s,%s,%lu,", name, method, isa, count_kernel(call));
    if (whole)
        printf("%lu\n", count_call_of(call));
    else
        printf("\n");
}

typedef enum count_extent { COUNT_OFF, COUNT_QUICK, COUNT_FULL } count_extent;

static void count_rule(const spt_method *method, int lanes, const char *isa, count_extent extent) {
    const option_call plain = plain_call(method, lanes);
    const int whole = method == spt_adaptive() &&
                      (extent == COUNT_FULL || (extent == COUNT_QUICK && lanes == spt_lanes()));
    spt_hit expected[rays_of_a_call];
    count("off", isa, &plain, whole);
    memcpy(expected, hit, sizeof hit);
    for (int i = 0; extent != COUNT_OFF && i < option_count; ++i) {
        option_call with = plain;
        options[i].add(&with);
        if (extent == COUNT_QUICK && !whole && wants_of(&with) == 0) continue;
        count(options[i].name, isa, &with, whole);
        for (int k = 0; k < rays_of_a_call; ++k) {
            if (memcmp(&hit[k].t, &expected[k].t, sizeof hit[k].t) != 0) exit(1);
        }
    }
}

/* Rays that are still under way after the last pass, some by probes that were rejected. */
static void aim(void) {
    for (int i = 0; i < rays_of_a_call; ++i) {
        const spt_ray aimed = {{0.9f, 0.1f * (float)i - 0.7f, -3.0f}, 0, {-0.25f, 0, 1}, INFINITY};
        ray[i] = aimed;
    }
}

int main(int argument_count, char **arguments) {
    static const char *const isas[] = {"scalar", "sse2", "avx2", "avx512"};
    static const int lanes[] = {1, 4, 8, 16};
    const char *const wish = argument_count > 1 ? arguments[1] : "off";
    const count_extent extent = strcmp(wish, "full") == 0    ? COUNT_FULL
                                : strcmp(wish, "quick") == 0 ? COUNT_QUICK
                                                             : COUNT_OFF;
    struct sigaction action;
    memset(&action, 0, sizeof action);
    action.sa_sigaction = step;
    action.sa_flags = SA_SIGINFO;
    sigaction(SIGTRAP, &action, NULL);
    aim();
    for (int i = 0; i < rule_count; ++i) {
        for (int set = 0; set < width_count && lanes[set] <= spt_lanes(); ++set) {
            count_rule(rules[i].method(), lanes[set], isas[set], extent);
        }
    }
    return 0;
}
