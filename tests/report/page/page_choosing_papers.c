/* SPDX-License-Identifier: MIT
 *
 * Two questions that papers leave open: when over-relaxation should be taken up again, and what the
 * bonus and the penalty of binary tracing should be. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "page_choosing.h"

/* ---- Re-arming ------------------------------------------------------------------------------- */

static const struct {
    const char *policy, *name, *words;
} policies[] = {
    {"latch_forgetting", "never (the paper)", "never again, probes forgotten: as the paper has it"},
    {"after_1_forgetting", "after 1, forgetting", "after one plain step, probes forgotten"},
    {"latch", "never, keeping", "never again, probes kept"},
    {"after_1", "after 1", "after one plain step: `spt_relaxed`"},
    {"after_2", "after 2", "after two plain steps"},
    {"after_4", "after 4", "after four"},
    {"after_8", "after 8", "after eight"},
    {"growing", "radius grows", "when the radius grows"},
    {"halving", "halving", "the excess over `1` halved, an eighth of the most back at each sample"},
    {"slope", "slope", "from the slope of the radius, at most omega"}};
enum { policy_count = sizeof policies / sizeof policies[0] };

/* The omega with the fewest evaluations. */
static int best_row(const csv_table *means, const char *policy) {
    int best = -1;
    for (int row = -1; (row = csv_next(means, row, "policy=%s", policy)) >= 0;) {
        if (best < 0 ||
            csv_number(means, row, "evaluations") < csv_number(means, best, "evaluations")) {
            best = row;
        }
    }
    return best;
}

static void rearming_table(page *out, const csv_table *means) {
    page_table(
        out,
        "Policies, each with the omega that suits it best. *Rejected*: probes a ray. *Lost*: "
        "what is missed or hit too late, of the nine kinds that are bounds, and of the "
        "Mandelbulb's estimate.",
        "over-relaxes again|best omega|evaluations|rejected|lost|lost, Mandelbulb");
    for (int i = 0; i < policy_count; ++i) {
        const int row = best_row(means, policies[i].policy);
        page_row(out);
        page_cell_begin(out, NULL);
        page_words(out, policies[i].words);
        page_cell_end(out);
        page_cell_number(out, NULL, means, row, "omega", "");
        page_cell_number(out, NULL, means, row, "evaluations", "%.2f");
        page_cell_number(out, NULL, means, row, "fallbacks", "%.2f");
        page_cell_number(out, csv_number(means, row, "lost") > 0 ? "bad" : "good", means, row,
                         "lost", "");
        page_cell_number(out, NULL, means, row, "estimate_lost", "");
    }
    page_table_end(out);
    page_source(out, "rearm_mean");
}

static void evaluations_of(page *out, const csv_table *means, const char *policy) {
    page_number(out, means, best_row(means, policy), "evaluations", "%.2f");
}

static void rearming_answer(page *out, const csv_table *means, const csv_table *sweep) {
    page_begin(out);
    page_words(out,
               "*The answer.* If probes are forgotten and over-relaxation ends for good at the "
               "first rejected one, a larger omega fails sooner: the best that was tried is ");
    page_number(out, means, best_row(means, "latch_forgetting"), "omega", "");
    page_words(out, ", beside the ^1.2 of Keinert et al. (2014, section 4)^: ");
    evaluations_of(out, means, "latch_forgetting");
    page_words(out, " evaluations a ray against ");
    page_number(out, sweep, choosing_method_row(sweep, "basic"), "both", "%.2f");
    page_words(out, " with basic steps. Probes that are kept and reached for free make failure "
                    "cheap: ");
    evaluations_of(out, means, "after_1");
    page_words(out, " after one plain step, ");
    evaluations_of(out, means, "after_2");
    page_words(out, " after two, ");
    evaluations_of(out, means, "after_4");
    page_words(out, " after four. Halving what goes beyond, and taking it back step by step, "
                    "gives ");
    evaluations_of(out, means, "halving");
    page_words(out, ". To compare with policies that look at the radius: omega from the measured "
                    "slope takes ");
    evaluations_of(out, means, "slope");
    page_words(out, " when capped, `auto_relaxed` ");
    page_number(out, sweep, choosing_method_row(sweep, "auto_relaxed"), "both", "%.2f");
    page_words(out, ", and `adaptive` ");
    page_number(out, sweep, choosing_method_row(sweep, "adaptive"), "both", "%.2f");
    page_words(out, ". Those choose omega anew at every step, from the last two samples, and are "
                    "armed always: they need no such policy.");
    page_end(out);
}

void choosing_rearming(page *out) {
    csv_table *const means = csv_open(out->tables, "rearm_mean");
    csv_table *const sweep = csv_open(out->tables, "sweep_mean");
    static const char *const marked[] = {"basic", "auto_relaxed", "adaptive"};
    static choosing_plot drawn;
    choosing_plot_begin(&drawn, "Over-relaxation and its return", "omega", "evaluations a ray");
    drawn.drawn.width = 680;
    drawn.drawn.height = 460;
    for (int i = 0; i < policy_count; ++i) {
        char where[64];
        snprintf(where, sizeof where, "policy=%s", policies[i].policy);
        choosing_line(&drawn, means, where, "omega", "evaluations", policies[i].name);
    }
    for (int i = 0; i < 3; ++i) {
        plot_add_mark(&drawn.drawn, 0,
                      csv_number(sweep, choosing_method_row(sweep, marked[i]), "both"), marked[i]);
    }
    drawn.drawn.y.low = 9;
    drawn.drawn.y.high = 16;
    page_begin(out);
    page_words(out,
               "Keinert et al. leave open when to over-relax again after a probe was rejected, "
               "and how to adapt omega (^section 5^). Ten policies, built as step rules and "
               "run in the library's own driver, over the ten kinds of scene and both stops:");
    page_end(out);
    page_figure(out, "choosing_rearm", &drawn.drawn);
    page_words(out,
               "Evaluations a ray, geometric means, by the factor omega with which a policy "
               "begins. *Forgetting* policies start anew from the certified sphere; all others "
               "keep the rejected probe and jump to it once a later sphere meets its own. "
               "Lines: step rules of the library with their defaults. ");
    page_source(out, "rearm_mean");
    page_figure_end(out);
    rearming_table(out, means);
    rearming_answer(out, means, sweep);
    csv_close(means);
    csv_close(sweep);
}

/* ---- Binary tracing -------------------------------------------------------------------------- */

enum { most_values = 16 };

static void heat_table(page *out, const csv_table *means) {
    const char *bonuses[most_values], *penalties[most_values];
    char columns[256] = "bonus";
    const int rows = csv_distinct(means, "bonus", bonuses, most_values);
    const int cells = csv_distinct(means, "penalty", penalties, most_values);
    for (int i = 0; i < cells; ++i) {
        const size_t used = strlen(columns);
        snprintf(columns + used, sizeof columns - used, "|penalty `%s`", penalties[i]);
    }
    page_table(out,
               "Probes a ray above the least of all pairs, percent; geometric means over eight "
               "bodies and both stops. Green: within `2.5`.",
               columns);
    for (int i = 0; i < rows; ++i) {
        page_row(out);
        page_cell_begin(out, NULL);
        page_words(out, "`%s`", bonuses[i]);
        page_cell_end(out);
        for (int k = 0; k < cells; ++k) {
            const int row = csv_next(means, -1, "bonus=%s,penalty=%s", bonuses[i], penalties[k]);
            const double above = csv_number(means, row, "above_least");
            page_cell_number(out,
                             above <= 2.5 ? "good"
                             : above > 50 ? "bad"
                             : above > 20 ? "warn"
                                          : NULL,
                             means, row, "above_least", "%.1f");
        }
    }
    page_table_end(out);
    page_source(out, "binary_mean");
}

static void binary_plots(page *out, const csv_table *means) {
    static const char *const files[] = {"choosing_binary_bonus", "choosing_binary_penalty"};
    static const struct {
        int plot;
        const char *where, *name;
    } lines[] = {{0, "penalty=0.1", "penalty 0.1"}, {0, "penalty=0.2", "penalty 0.2"},
                 {0, "penalty=0.3", "penalty 0.3"}, {0, "penalty=0.4", "penalty 0.4"},
                 {0, "penalty=0.6", "penalty 0.6"}, {1, "bonus=1.1", "bonus 1.1"},
                 {1, "bonus=1.5", "bonus 1.5"},     {1, "bonus=2", "bonus 2"},
                 {1, "bonus=3", "bonus 3"},         {1, "bonus=6", "bonus 6"}};
    static choosing_plot both[2];
    plot drawn[2];
    choosing_plot_begin(&both[0], "Bonus", "bonus", "probes a ray");
    choosing_plot_begin(&both[1], "Penalty", "penalty", "probes a ray");
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; ++i) {
        choosing_line(&both[lines[i].plot], means, lines[i].where,
                      lines[i].plot == 0 ? "bonus" : "penalty", "probes", lines[i].name);
    }
    for (int i = 0; i < 2; ++i) {
        drawn[i] = both[i].drawn;
        drawn[i].y.low = 20;
        drawn[i].y.high = 50;
    }
    plot_add_mark(&drawn[0], 1, 2, "the paper");
    plot_add_mark(&drawn[1], 1, 0.3, "the paper");
    page_figures(out, files, drawn, 2);
    page_words(out,
               "Probes a ray by the bonus and by the penalty, geometric means over eight bodies "
               "and both stops. Marks: the paper's pair. ");
    page_source(out, "binary_mean");
    page_figure_end(out);
}

static void best_table(page *out, const csv_table *best) {
    page_table(out,
               "The best pair of each body and stop, and what it saves against the paper's pair.",
               "body|stop|bonus|penalty|probes|probes, the paper's|saved, %");
    for (int row = 0; row < csv_rows(best); ++row) {
        page_row(out);
        page_cell(out, NULL, "%s", csv_text(best, row, "body"));
        page_cell(out, NULL, "%s",
                  strcmp(csv_text(best, row, "stop"), "absolute") == 0 ? "absolute"
                                                                       : "half a pixel");
        page_cell_number(out, NULL, best, row, "bonus", "");
        page_cell_number(out, NULL, best, row, "penalty", "");
        page_cell_number(out, NULL, best, row, "probes", "%.1f");
        page_cell_number(out, NULL, best, row, "paper_probes", "%.1f");
        page_cell_number(out, NULL, best, row, "saved", "%.1f");
    }
    page_table_end(out);
    page_source(out, "binary_best");
}

static void endless_answer(page *out) {
    csv_table *const endless = csv_open(out->tables, "binary_endless");
    const int two = csv_next(endless, -1, "bonus=2"), less = csv_next(endless, -1, "bonus=1.5");
    page_begin(out);
    page_words(out,
               "*Should the default move?* Not by the means alone: a ray that meets nothing, with "
               "neither a bound nor an end, reaches the end of what float32 can say after ");
    page_number(out, endless, two, "probes", "");
    page_words(out, " probes with a bonus of `2` and after ");
    page_number(out, endless, less, "probes", "");
    page_words(out, " with `1.5`; the default budget is ");
    page_number(out, endless, two, "budget", "");
    page_words(out, ", and a miss that stays undecided is worse than a few probes more. ");
    if (csv_number(endless, two, "decided") > 0 && !(csv_number(endless, less, "decided") > 0)) {
        page_words(out, "So a bonus of `1.5` is out. ");
    }
    page_source(out, "binary_endless");
    page_end(out);
    csv_close(endless);
}

static void binary_answer(page *out, const csv_table *means, const csv_table *best) {
    const int plane = csv_next(best, -1, "body=plane,stop=absolute");
    double lost = 0;
    int least = 0;
    for (int row = 0; row < csv_rows(means); ++row) {
        lost += csv_number(means, row, "lost");
        if (csv_number(means, row, "probes") < csv_number(means, least, "probes")) least = row;
    }
    page_begin(out);
    page_words(out, "*The answer.* The best pair is a bonus of ");
    page_number(out, means, least, "bonus", "");
    page_words(out, " and a penalty of ");
    page_number(out, means, least, "penalty", "");
    page_words(out, "; ^2.0 and 0.3 (section 6.1)^ take ");
    page_number(out, means, csv_next(means, -1, "bonus=2,penalty=0.3"), "above_least", "%.1f");
    page_words(out, " %% more. A bonus of `1.5` at the same penalty takes ");
    page_number(out, means, csv_next(means, -1, "bonus=1.5,penalty=0.3"), "above_least", "%.1f");
    page_words(out,
               " %% more. What moves the optimum (the question of ^section 12^) is how the free "
               "balls along a ray change: in front of one body met head-on they shrink "
               "steadily, and a bold probe succeeds; along a plane or among many bodies they stay "
               "as they are for long, and each bold probe fails. At the plane the best bonus is ");
    page_number(out, best, plane, "bonus", "");
    page_words(out, " and the best penalty ");
    page_number(out, best, plane, "penalty", "");
    page_words(out, ", which saves ");
    page_number(out, best, plane, "saved", "%.0f");
    page_words(out, " %%. A small penalty throws away what a failed probe has shown, a large one "
                    "fails again. ");
    page_words(out, lost > 0 ? "Some pairs lose rays." : "No pair loses a ray.");
    page_end(out);
    endless_answer(out);
}

void choosing_binary(page *out) {
    csv_table *const means = csv_open(out->tables, "binary_mean");
    csv_table *const best = csv_open(out->tables, "binary_best");
    page_begin(out);
    page_words(out,
               "Binary tracing asks whether balls are free, larger ones by a bonus after one "
               "that was, smaller ones by a penalty after one that was not. Szecsi et al. took "
               "^2.0 and 0.3 (section 6.1)^ and did not analyse the choice (^section 12^). Here "
               "all pairs are held to the same error: `probe_ratio` goes with the penalty.");
    page_end(out);
    binary_plots(out, means);
    heat_table(out, means);
    binary_answer(out, means, best);
    page_fold(out, "By body and stop");
    best_table(out, best);
    page_fold_end(out);
    csv_close(means);
    csv_close(best);
}
