/* SPDX-License-Identifier: MIT
 *
 * spt_trace(), for the rules that a scene needs, of one field or a union. */
#include "../base/arguments.h"
#include "../methods/convex.glsl.h"
#include "../trace/method.h"
#include "../surface/reverse.glsl.h"
#include "../trace/trace.glsl.h"
#include "pieces.h"
#include "write.h"

/* ---- Tracing -------------------------------------------------------------------------------- */

/* Rules without linking their objects: spt_convex() for the convex components of a scene, and what
 * it comes to where it may take plain steps only. */
static const spt_method convex_rule = {
    .name = "convex", .memory = 2, .needs_convex = 1, .glsl = &rule_glsl};
static const spti_rule_glsl plain = {"", "", "", "", "plain steps"};

/* The conditions of a march: those of the program, without what belongs to a rule, with it. */
static uint64_t conditions_of(uint64_t base, const spt_method *method, int is_plain) {
    const uint64_t any = SPTI_GLSL_BIT(guards) | SPTI_GLSL_BIT(skip_start);
    uint64_t bits = base;
    if (!is_plain) {
        if (method->probes) bits |= SPTI_GLSL_BIT(probes) | SPTI_GLSL_BIT(striding);
        if (method->pending) bits |= SPTI_GLSL_BIT(pending) | SPTI_GLSL_BIT(eye);
        if (method->blends) bits |= SPTI_GLSL_BIT(blends);
        if (method->needs_convex) bits |= SPTI_GLSL_BIT(secant);
        if (method->needs_convex && !(base & SPTI_GLSL_BIT(between)))
            bits |= SPTI_GLSL_BIT(striding);
        if (method->glsl->accepted[0] != '\0') bits |= SPTI_GLSL_BIT(remembers);
    }
    if (bits & (SPTI_GLSL_BIT(flags) | SPTI_GLSL_BIT(remembers))) {
        bits |= SPTI_GLSL_BIT(first) | SPTI_GLSL_BIT(stepping);
    }
    if (bits & (SPTI_GLSL_BIT(probes) | SPTI_GLSL_BIT(between))) bits |= SPTI_GLSL_BIT(stepping);
    if (bits & (SPTI_GLSL_BIT(skip_start) | SPTI_GLSL_BIT(stop_inside)))
        bits |= SPTI_GLSL_BIT(first);
    if ((bits & any) || ((bits & SPTI_GLSL_BIT(pixel)) && (bits & SPTI_GLSL_BIT(path)))) {
        bits |= SPTI_GLSL_BIT(eye);
    }
    if ((bits & SPTI_GLSL_BIT(candidate)) && !(bits & SPTI_GLSL_BIT(between))) {
        bits |= SPTI_GLSL_BIT(eye);
    }
    if ((bits & (SPTI_GLSL_BIT(between) | SPTI_GLSL_BIT(remembers))) ||
        ((bits & SPTI_GLSL_BIT(pending)) && (bits & SPTI_GLSL_BIT(flags)))) {
        bits |= SPTI_GLSL_BIT(paired);
    }
    return bits;
}

/* method: NULL for plain steps. begins: in the place of the march's first part, or NULL. */
static void write_march(spti_glsl *out, const char *name, const spt_method *method,
                        const char *begins) {
    const int is_plain =
        method == NULL || (method->needs_convex && spti_glsl_has(out, SPTI_GLSL_BIT(penumbra)));
    const spti_rule_glsl *const rule = is_plain ? &plain : method->glsl;
    const char *const arguments[10] = {
        name, rule->declared, rule->step, rule->accepted, rule->rejected, rule->title, "", "", "",
        ""};
    const uint64_t base = out->conditions;
    out->conditions = conditions_of(base, method, is_plain);
    for (int part = 0; spti_glsl_march[part] != NULL; ++part) {
        const int first = part == 0 && begins != NULL;
        spti_glsl_expand(out, first ? begins : spti_glsl_march[part], arguments);
    }
    out->conditions = base;
}

/* One call for a component, by its rule: `name` with "_convex" behind it for those that have one of
 * their own. */
static void call_march(spti_glsl *out, const char *name, int some, int all) {
    if (!some || all) {
        spti_glsl_format(out, "        SptHit hit = %s%s(component, ray, budget, best.t);\n", name,
                         all ? "_convex" : "");
        return;
    }
    spti_glsl_put(out, "        bool convex = ");
    int found = 0;
    for (uint32_t i = 0; i < out->component_count; ++i) {
        if (!out->components[i].convex) continue;
        spti_glsl_format(out, found ? " ||\n            component == %d" : "component == %d",
                         (int)i);
        found = 1;
    }
    spti_glsl_format(out,
                     ";\n        SptHit hit;\n"
                     "        if (convex) hit = %s_convex(component, ray, budget, best.t);\n"
                     "        else hit = %s(component, ray, budget, best.t);\n",
                     name, name);
}

static const char union_begins[] =
    "// A hard union: each component is traced by itself, and the first event counts.\n"
    "SptHit $0(SptRay ray, int budget) {\n"
    "    SptHit best;\n"
    "    best.t = best.residual = 3.0e38;\n"
    "    best.outcome = $miss;\n"
    "    best.evaluations = 0;\n"
    "[flags]    best.flags = 0;\n"
    "[component]    best.component = -1;\n"
    "[candidate]    best.candidate_t = best.candidate_ratio = 3.0e38;\n"
    "[fallbacks]    best.fallbacks = 0;\n"
    "    for (int component = $zero; component < $n; ++component) {\n";

static const char union_ends[] =
    "        best.evaluations += hit.evaluations;\n"
    "[flags]        best.flags |= hit.flags;\n"
    "[candidate]        // Of a hit its own; else the least of all.\n"
    "[candidate]        bool hits = hit.outcome == $hit && hit.t < best.t;\n"
    "[candidate]        bool less = hit.candidate_ratio < best.candidate_ratio;\n"
    "[candidate]        if (hits || (less && hit.outcome != $hit && best.outcome != $hit)) {\n"
    "[candidate]            best.candidate_ratio = hit.candidate_ratio;\n"
    "[candidate]            best.candidate_t = hit.candidate_t;\n"
    "[candidate]        }\n"
    "[fallbacks]        best.fallbacks += hit.fallbacks;\n"
    "[guards]        if (hit.outcome == $bad) best.outcome = $bad;\n"
    "        if (hit.t < best.t) {\n"
    "            best.t = hit.t;\n"
    "            best.residual = hit.residual;\n"
    "            best.outcome = hit.outcome;\n"
    "[component]            best.component = hit.component;\n"
    "        }\n"
    "    }\n"
    "    return best;\n"
    "}\n";

static void write_trace(spti_glsl *out, const spt_method *method, const char *name,
                        const char *march, const char *convex) {
    const char *const arguments[10] = {name, "", "", "", "", "", "", "", "", ""};
    int some = 0, all = 1;
    if (!spti_glsl_has(out, SPTI_GLSL_BIT(many))) {
        spti_glsl_begin_guard(out, name);
        write_march(out, name, out->components[0].convex ? &convex_rule : method, NULL);
        spti_glsl_end_guard(out, name);
        return;
    }
    for (uint32_t i = 0; i < out->component_count; ++i) {
        some |= out->components[i].convex;
        all &= out->components[i].convex;
    }
    if (!all) write_march(out, march, method, NULL);
    if (some && !all) spti_glsl_put(out, "\n");
    if (some) write_march(out, convex, &convex_rule, NULL);
    spti_glsl_put(out, "\n");
    spti_glsl_begin_guard(out, name);
    spti_glsl_expand(out, union_begins, arguments);
    call_march(out, march, some, all);
    spti_glsl_expand(out, union_ends, arguments);
    spti_glsl_end_guard(out, name);
}

void spti_glsl_write_trace(spti_glsl *out) {
    write_trace(out, out->settings.method, "spt_trace", "spt_march", "spt_march_convex");
}

/* The same for shadow rays, whose candidate is the tangent of the angle by which they miss. In
 * pictures by plain steps: the longer ones of other rules leave dark lines in penumbras. */
void spti_glsl_write_trace_shadow(spti_glsl *out) {
    const int picture = out->options->target != SPT_GLSL_LIBRARY;
    const uint64_t base = out->conditions;
    out->conditions |= SPTI_GLSL_BIT(candidate) | SPTI_GLSL_BIT(between) | SPTI_GLSL_BIT(penumbra);
    out->conditions &= ~SPTI_GLSL_BIT(closest);
    write_trace(out, picture ? NULL : out->settings.method, "spt_trace_shadow", "spt_march_shadow",
                "spt_march_shadow_convex");
    out->conditions = base;
}

/* The way back of spt_trace_convex(), which has a path in any case. */
void spti_glsl_write_trace_back(spti_glsl *out) {
    const uint64_t base = out->conditions;
    const spt_method *const method =
        out->components[0].convex ? &convex_rule : out->settings.method;
    out->conditions |= SPTI_GLSL_BIT(path) | SPTI_GLSL_BIT(stop_inside) | SPTI_GLSL_BIT(back);
    out->conditions &= ~(SPTI_GLSL_BIT(skip_start) | SPTI_GLSL_BIT(candidate) |
                         SPTI_GLSL_BIT(between) | SPTI_GLSL_BIT(penumbra) | SPTI_GLSL_BIT(closest));
    write_march(out, "spt_trace_back", method, spti_glsl_back_begins);
    out->conditions = base;
}
