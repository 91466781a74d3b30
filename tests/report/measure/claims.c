/* SPDX-License-Identifier: MIT
 *
 * claims.csv: the headlines of the three papers beside what the tables of this run say. What is
 * compared, and when it counts as reached, stands at each claim; it is the same for all runs. */
#include "claims_verdict.h"

#include <math.h>
#include <string.h>

/* ---- Keinert et al. ------------------------------------------------------------------------- */

/* Times as fast, like against like: the default rule against the basic one in the paper's four
 * cases, where the field takes as much of the time as in the paper. The mean has to be the
 * paper's mean. */
static void judge_relaxation(const claims_tables *tables, const claims_claim *claim,
                             claims_verdict *verdict) {
    const csv_table *const steps = tables->steps;
    const char *const judged = "claim=1,callback=costly,way=adaptive";
    const double printed = claims_value(steps, judged, "printed", "printed");
    verdict->ours = claims_spread_where(steps, judged, "printed", "faster");
    verdict->verdict = claims_gain_is(verdict->ours, printed, claim->printed_high);
    claims_say(
        verdict,
        "Time of the paper's four cases in the geometric mean (quartiles of rounds; the paper's "
        "mean is %.2f): the default rule against the basic one with fields that take %.2f of its "
        "time. Over-relaxation itself: %.2f. ",
        printed, claims_value(steps, "claim=1,callback=costly,way=basic", "printed", "field_share"),
        claims_value(steps, "claim=1,callback=costly,way=relaxed", "printed", "faster"));
    claims_say(
        verdict,
        "Evaluations: %.2f times fewer. With our own fields the rule's longer step eats that up: "
        "%.2f; built without vectors: %.2f.",
        claims_value(steps, judged, "printed", "fewer"),
        claims_value(steps, "claim=1,callback=vectors,way=adaptive", "printed", "faster"),
        claims_value(steps, "claim=1,callback=scalar,way=adaptive", "printed", "faster"));
}

/* Times as fast, as above: what the library does by default for a convex body against going through
 * it by the default rule. */
static void judge_convex(const claims_tables *tables, const claims_claim *claim,
                         claims_verdict *verdict) {
    const csv_table *const steps = tables->steps;
    const char *const judged = "case=glass,callback=costly,way=convex";
    verdict->ours = claims_spread_where(steps, judged, "faster", "faster");
    verdict->verdict = claims_gain_is(verdict->ours, claim->printed_low, claim->printed_high);
    claims_say(
        verdict,
        "Time of tracing and refining a frame's rays (quartiles of rounds) with a field that "
        "takes %.2f of it: backwards by the secant against through by the default rule; without "
        "the secant %.2f. Evaluations: %.2f times fewer. ",
        claims_value(steps, "case=glass,callback=costly,way=basic", "faster", "field_share"),
        claims_value(steps, "case=glass,callback=costly,way=backwards", "faster", "faster"),
        claims_value(steps, judged, "faster", "fewer"));
    claims_say(
        verdict, "With our own field %.2f; whole frames with all their shading %.2f.",
        claims_value(steps, "case=glass,callback=vectors,way=convex", "faster", "faster"),
        claims_value(steps, "case=glass_frame,callback=vectors,way=convex", "faster", "faster"));
}

/* ---- Bálint & Valasek ----------------------------------------------------------------------- */

/* The row with the most, or the least, gain, of those with a share of rays still under way; and of
 * all scenes, since errors that one never comes to have fewer. */
static int best_row(const csv_table *table, const char *where, int most, double open) {
    const claims_mean all = claims_mean_where(table, where, "gain", "scenes");
    int best = -1;
    for (int row = -1; (row = csv_next(table, row, where)) >= 0;) {
        const double gain = csv_number(table, row, "gain");
        if (csv_number(table, row, "open") < open) continue;
        if (csv_number(table, row, "scenes") < all.most) continue;
        if (best < 0 || (gain > csv_number(table, best, "gain")) == most) best = row;
    }
    report_expect(best >= 0, "no comparison of errors");
    return best;
}

static claims_spread gain_of(const csv_table *table, int row) {
    claims_spread spread;
    spread.middle = csv_number(table, row, "gain");
    spread.low = csv_number(table, row, "gain_low");
    spread.high = csv_number(table, row, "gain_high");
    return spread;
}

/* In how many budgets the gain is above 1, and of how many. */
static int ahead(const csv_table *table, const char *where, int *budgets) {
    int number = 0;
    *budgets = 0;
    for (int row = -1; (row = csv_next(table, row, where)) >= 0; ++*budgets) {
        number += csv_number(table, row, "gain") > 1;
    }
    return number;
}

/* The least, or most, of the ten kinds of scene in their mean, by error_means.csv. */
static double of_kinds(const csv_table *means, int most) {
    const claims_mean of = claims_mean_where(means, "schedule=direct,method=enhanced", "budget",
                                             "error_time_over_relaxed");
    return most ? of.most : of.least;
}

/* "Up to": the best budget, of those at which one of a hundred relaxed rays is still under way:
 * where none is, errors differ by what single rays leave. The square of the error times time, as
 * in the paper, the relaxed rule's over the enhanced rule's. */
static void judge_enhanced(const claims_tables *tables, const claims_claim *claim,
                           claims_verdict *verdict) {
    const csv_table *const error = tables->error;
    const double open = 0.01;
    const int best = best_row(error, "question=product,method=enhanced,against=relaxed", 1, open);
    const int adaptive =
        best_row(error, "question=product,method=adaptive,against=relaxed", 1, open);
    verdict->ours = gain_of(error, best);
    verdict->verdict = claims_gain_is(verdict->ours, claim->printed_high, claim->printed_high);
    claims_say(
        verdict,
        "Squared error x time (as in the paper) of the relaxed rule (omega 1.2) over the "
        "enhanced one: geometric mean of the paper's scenes at %s evaluations (by scene %.2f to "
        "%.2f; low and high: the clock's noise). RMS error x time: %.2f. The default rule: %.2f "
        "and %.2f. ",
        csv_text(error, best, "budget"), csv_number(error, best, "least"),
        csv_number(error, best, "most"), csv_number(error, best, "gain_root"),
        csv_number(error, adaptive, "gain"), csv_number(error, adaptive, "gain_root"));
    claims_say(verdict,
               "Ten kinds of scene against omega 1.4 in error_means.csv: RMS x time up to %.2f.",
               of_kinds(tables->means, 1));
}

/* The same at the worst budget of all, and better than the basic rule as well to count as exceeded:
 * that the paper's is from 64 iterations on only. */
static void judge_always(const claims_tables *tables, const claims_claim *claim,
                         claims_verdict *verdict) {
    const csv_table *const error = tables->error;
    const char *const judged = "question=product,method=enhanced,against=relaxed";
    const char *const by_default = "question=product,method=adaptive,against=relaxed";
    const int worst = best_row(error, judged, 0, 0);
    const int basic = best_row(error, "question=product,method=enhanced,against=basic", 0, 0);
    const int adaptive = best_row(error, by_default, 0, 0);
    int budgets = 0;
    (void)claim;
    verdict->ours = gain_of(error, worst);
    verdict->verdict =
        claims_gain_is(verdict->ours, 1, gain_of(error, basic).low > 1 ? 1 : HUGE_VAL);
    const int number = ahead(error, judged, &budgets);
    claims_say(
        verdict,
        "As claim 3 at the worst number of evaluations: %s. Ahead at %d of %d; against the basic "
        "rule %.2f at worst. The default rule is ahead at %d and comes to %.2f at worst. Ten "
        "kinds of scene against omega 1.4: RMS x time %.2f at worst. ",
        csv_text(error, worst, "budget"), number, budgets, csv_number(error, basic, "gain"),
        ahead(error, by_default, &budgets), csv_number(error, adaptive, "gain"),
        of_kinds(tables->means, 0));
    if (verdict->verdict == claims_not_reached) {
        claims_say(
            verdict,
            "With few its first step is plain where the relaxed one is long; with so many that all "
            "rays end the error is the same and its step takes longer.");
    }
}

/* "Up to": the best budget. Time to the same error, of single rays over frames with cones of 16x16
 * and 4x4 pixels, which is what the library does by default; the enhanced rule, as in the paper. */
static void judge_resolution(const claims_tables *tables, const claims_claim *claim,
                             claims_verdict *verdict) {
    const csv_table *const error = tables->error;
    const int best = best_row(error, "question=time,method=enhanced,schedule=frame", 1, 0);
    const int two = best_row(error, "question=time,method=enhanced,schedule=passes_2", 1, 0);
    const int adaptive = best_row(error, "question=time,method=adaptive,schedule=frame", 1, 0);
    verdict->ours = gain_of(error, best);
    verdict->verdict = claims_gain_is(verdict->ours, claim->printed_high, claim->printed_high);
    claims_say(
        verdict,
        "Time to the same error: geometric mean of the paper's scenes at the error of %s "
        "evaluations (by scene %.2f to %.2f; low and high: the clock's noise); enhanced rays one "
        "by one against behind cones of 16x16 and 4x4 pixels. The default rule: %.2f. ",
        csv_text(error, best, "budget"), csv_number(error, best, "least"),
        csv_number(error, best, "most"), csv_number(error, adaptive, "gain"));
    claims_say(verdict,
               "Two resolutions as the paper has them (a cone for every coarse pixel) "
               "come to %.2f.",
               csv_number(error, two, "gain"));
}

/* ---- Szécsi et al. -------------------------------------------------------------------------- */

/* Times as fast, the default rule on both sides. */
static void judge_cones(const claims_tables *tables, const claims_claim *claim,
                        claims_verdict *verdict) {
    const claims_mean by_levels =
        claims_mean_where(tables->levels, "way=cones", "faster", "faster");
    verdict->ours = claims_spread_where(tables->levels, "way=cones", "faster", "faster");
    verdict->verdict = claims_gain_is(verdict->ours, claim->printed_low, claim->printed_high);
    claims_say(
        verdict,
        "Time of a tree with the default rule: rays one by one over rays behind cones; geometric "
        "mean over the numbers of levels (%.2f to %.2f) and quartiles of rounds. The basic rule: "
        "%.2f. Evaluations: %.2f times fewer.",
        by_levels.least, by_levels.most,
        claims_value(tables->levels, "way=cones_basic", "faster", "faster"),
        claims_value(tables->levels, "way=cones", "fewer", "fewer"));
}

/* The time of an evaluation, all of the trace included, on a straight line by levels: R^2 >= 0.98;
 * and the time of pictures grows no more than the number of levels. Pictures themselves are on no
 * line: how many evaluations a ray takes depends on how much of the view is covered. */
static void judge_linear(const claims_tables *tables, const claims_claim *claim,
                         claims_verdict *verdict) {
    const csv_table *const lines = tables->lines;
    const char *const pictures = "way=direct_unbounded,column=nanoseconds";
    const double alone = claims_value(lines, "way=evaluation", "straight", "straight");
    const double grows = claims_value(lines, pictures, "straight", "grows");
    const double levels_grow = claims_value(lines, pictures, "straight", "levels_grow");
    (void)claim;
    verdict->ours.middle =
        claims_value(lines, "way=direct_unbounded,column=per_evaluation", "straight", "straight");
    verdict->ours.low = fmin(verdict->ours.middle, alone);
    verdict->ours.high = fmax(verdict->ours.middle, alone);
    const int holds = verdict->ours.low >= 0.98 && grows <= levels_grow;
    verdict->verdict = holds ? claims_reached : claims_not_reached;
    claims_say(
        verdict,
        "Time of an evaluation while a tree is traced from %.0f to %.0f levels (low and high: "
        "that and an evaluation by itself). The time of pictures grows %.1f times where levels "
        "grow %.0f times and instances double with each; their line has R² %.2f since "
        "evaluations a ray depend on the view.",
        claims_value(lines, pictures, "straight", "fewest"),
        claims_value(lines, pictures, "straight", "most"), grows, levels_grow,
        claims_value(lines, pictures, "straight", "straight"));
}

/* Evaluations over those of direct tracing by the basic rule, as the paper traces, with probes that
 * end so early that hits err alike. A cost: the range over levels has to stay below. */
static void judge_binary(const claims_tables *tables, const claims_claim *claim,
                         claims_verdict *verdict) {
    const claims_mean fewer =
        claims_mean_where(tables->levels, "way=binary_same_error", "fewer", "fewer");
    verdict->ours.middle = 1 / claims_mean_of(&fewer);
    verdict->ours.low = 1 / fewer.most;
    verdict->ours.high = 1 / fewer.least;
    verdict->verdict = claims_cost_is(verdict->ours, claim->printed_high);
    claims_say(
        verdict,
        "Evaluations over direct basic tracing at the same error: geometric mean and range over "
        "the numbers of levels. With the default end of probes: %.2f. Time: %.2f. The default "
        "rule takes %.2f times fewer evaluations than the basic one on top of that.",
        1 / claims_value(tables->levels, "way=binary", "fewer", "fewer"),
        1 / claims_value(tables->levels, "way=binary_same_error", "faster", "faster"),
        claims_value(tables->levels, "way=direct", "fewer", "fewer"));
}

/* Of the time of the primary rays alone, which is what the paper's 25 % are of; those by the
 * default rule and, as shadow rays are, without cones. A quarter of the pixels. */
static void judge_shadows(const claims_tables *tables, const claims_claim *claim,
                          claims_verdict *verdict) {
    const csv_table *const table = tables->secondary;
    const char *const judged = "pass=shadow_quarter_samples"; /* as the paper finds penumbrae */
    const claims_mean by_model = claims_mean_where(table, judged, "share", "share");
    verdict->ours = claims_spread_where(table, judged, "share", "share");
    verdict->verdict = claims_cost_is(verdict->ours, claim->printed_high);
    claims_say(
        verdict,
        "Time over that of the primary rays alone (not of a frame) traced one by one: geometric "
        "mean of %d models (%.2f to %.2f) and quartiles of rounds; penumbrae from the samples as "
        "in the paper. ",
        by_model.count, by_model.least, by_model.most);
    claims_say(
        verdict,
        "Looked for between samples too: %.2f; a quarter of each side: %.2f. Of primary rays "
        "by the basic rule %.2f; of cheaper ones behind cones %.2f.",
        claims_value(table, "pass=shadow_quarter", "share", "share"),
        claims_value(table, "pass=shadow_sixteenth", "share", "share"),
        claims_value(table, judged, "share", "of_basic"),
        claims_value(table, judged, "share", "of_cones"));
}

/* The mean time of a pixel over the models of all numbers of levels. */
static double mean_time(const csv_table *levels, const char *way) {
    double sum = 0;
    int count = 0;
    for (int row = csv_next(levels, -1, "way=%s", way); row >= 0;
         row = csv_next(levels, row, "way=%s", way)) {
        sum += csv_number(levels, row, "nanoseconds");
        ++count;
    }
    return sum / count;
}

/* In levels: the mean time of ambient occlusion at all hits over the slope of the line of pictures
 * by the default rule, which is what a level more takes in the mean. */
static void judge_occlusion(const claims_tables *tables, const claims_claim *claim,
                            claims_verdict *verdict) {
    const csv_table *const levels = tables->levels;
    const double slope =
        claims_value(tables->lines, "way=direct,column=nanoseconds", "straight", "slope");
    const claims_mean time =
        claims_mean_where(levels, "way=occlusion", "nanoseconds", "nanoseconds");
    verdict->ours.middle = mean_time(levels, "occlusion") / slope;
    verdict->ours.low = time.least / slope;
    verdict->ours.high = time.most / slope;
    verdict->verdict = claims_cost_is(verdict->ours, claim->printed_high);
    claims_say(
        verdict,
        "Time of 5 samples at every hit in slopes of the line of pictures: mean and range over "
        "the numbers of levels; 5 samples ask all levels 5 times so that it grows with them. One "
        "sample: %.2f; 5 at a quarter of the pixels: %.2f.",
        mean_time(levels, "occlusion_1_sample") / slope,
        mean_time(levels, "occlusion_quarter") / slope);
}

/* ---- THE LIST ------------------------------------------------------------------------------- */

static const char keinert[] = "Keinert et al. 2014", balint[] = "Bálint & Valasek 2018";
static const char szecsi[] = "Szécsi et al. 2016";

static const claims_claim list[] = {
    {keinert, "4", "Over-relaxation traces faster", 22.470 / 21.11, 20.409 / 16.829,
     "times as fast", judge_relaxation},
    {keinert, "4", "Convex bodies traced backwards make glass faster", 3.03 / 2.73, 3.03 / 2.73,
     "times as fast", judge_convex},
    {balint, "5", "Enhanced tracing has less error x time than relaxed", (double)NAN, 1.5,
     "times less", judge_enhanced},
    {balint, "5", "Enhanced tracing is better at every number of iterations", (double)NAN,
     (double)NAN, "times less", judge_always},
    {balint, "5", "Resolutions that rise trace faster", (double)NAN, 1.2, "times as fast",
     judge_resolution},
    {szecsi, "11", "A phase of low resolution traces faster", 1.3, 1.5, "times as fast",
     judge_cones},
    {szecsi, "11", "Time is linear in the number of levels", (double)NAN, (double)NAN,
     "R² of a line", judge_linear},
    {szecsi, "11", "Binary tracing takes twice the iterations of direct tracing", 2, 2,
     "times as many", judge_binary},
    {szecsi, "11", "Soft shadows at quarter resolution cost 25 % of primary ray casting", 0.25,
     0.25, "of their time", judge_shadows},
    {szecsi, "11", "Ambient occlusion costs as much as one level more", 1, 1, "levels",
     judge_occlusion},
};
enum { CLAIMS = sizeof list / sizeof list[0] };

static int cells(const report_options *options) {
    (void)options;
    return 1;
}

static void measure(const report_options *options, int cell, FILE *rows) {
    const char *const folder = options->output;
    const claims_tables tables = {
        csv_open(folder, "claim_steps"), csv_open(folder, "claim_levels"),
        csv_open(folder, "claim_lines"), csv_open(folder, "claim_secondary"),
        csv_open(folder, "claim_error"), csv_open(folder, "error_means")};
    (void)cell;
    for (int i = 0; i < CLAIMS; ++i) {
        claims_verdict verdict;
        memset(&verdict, 0, sizeof verdict);
        list[i].judge(&tables, &list[i], &verdict);
        fprintf(rows, "%d,%s,%s,%s", i + 1, list[i].paper, list[i].section, list[i].text);
        claims_write(rows, list[i].printed_low);
        claims_write(rows, list[i].printed_high);
        fprintf(rows, ",%s", list[i].unit);
        claims_write_spread(rows, verdict.ours);
        fprintf(rows, ",%s,%s\n", verdict.verdict, verdict.why);
    }
    csv_close(tables.steps);
    csv_close(tables.levels);
    csv_close(tables.lines);
    csv_close(tables.secondary);
    csv_close(tables.error);
    csv_close(tables.means);
}

const report_part report_claims = {
    "claims",
    "number,paper,section,claim,printed_low,printed_high,unit,ours,ours_low,ours_high,verdict,why",
    cells,
    measure,
    0,
    {0.1, 0.1}};
