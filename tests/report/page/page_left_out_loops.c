/* SPDX-License-Identifier: MIT
 *
 * What options leave in the loops when they are off, and take when they are on: instructions, which
 * are exact, and times. */
#include "page_left_out.h"

#include <stdlib.h>
#include <string.h>

enum { most_sets = 4, most_rules = 8, most_options = 24, most_scenes = 8 };

/* ---- Instructions: off ----------------------------------------------------------------------- */

static void cell_kernel(page *out, const csv_table *table, int row) {
    if (row < 0) {
        page_cell(out, "quiet", "–");
        return;
    }
    const int equal = csv_number(table, row, "cut") == csv_number(table, row, "off");
    page_cell_begin(out, equal ? "good" : "warn");
    page_number(out, table, row, "off", "%.0f");
    if (!equal) {
        page_words(out, " (cut: ");
        page_number(out, table, row, "cut", "%.0f");
        page_words(out, ")");
    }
    page_cell_end(out);
}

static void table_off(page *out, const csv_table *table) {
    const char *rules[most_rules], *sets[most_sets];
    char columns[256] = "step rule";
    const int rule_count = csv_distinct(table, "method", rules, most_rules);
    const int set_count = csv_distinct(table, "isa", sets, most_sets);
    for (int set = 0; set < set_count; ++set) {
        const size_t length = strlen(columns);
        snprintf(columns + length, sizeof columns - length, "|%s", sets[set]);
    }
    page_table(
        out,
        "Instructions of one pass of the kernel over sixteen rays that asks for nothing but t and "
        "outcome. A tick: exactly as many as from a source in which nothing optional stands. "
        "An exclamation mark: the compiler unrolled or branched in another way, see below.",
        columns);
    for (int rule = 0; rule < rule_count; ++rule) {
        page_row(out);
        page_cell(out, NULL, "%s", rules[rule]);
        for (int set = 0; set < set_count; ++set) {
            cell_kernel(out, table,
                        csv_next(table, -1, "method=%s,isa=%s", rules[rule], sets[set]));
        }
    }
    page_table_end(out);
    page_fold(out, "How far the code of both is the same");
    page_table(
        out,
        "*code*: the same instructions in the same registers and order. *operations*: in another "
        "order or other registers. *alone*: the same where the compiler sees this kernel "
        "alone; beside the other kernels of the library it decides in another way what to "
        "unroll. *arithmetic*: the same on floats, vectors and masks; jumps and moves "
        "differ.",
        columns);
    for (int rule = 0; rule < rule_count; ++rule) {
        page_row(out);
        page_cell(out, NULL, "%s", rules[rule]);
        for (int set = 0; set < set_count; ++set) {
            const int row = csv_next(table, -1, "method=%s,isa=%s", rules[rule], sets[set]);
            if (row < 0) {
                page_cell(out, "quiet", "–");
                continue;
            }
            page_cell_number(out, csv_number(table, row, "identical") > 0 ? "good" : "bad", table,
                             row, "same", "");
        }
    }
    page_table_end(out);
    page_fold_end(out);
    page_source(out, "instructions");
}

/* ---- Instructions: on ------------------------------------------------------------------------ */

/* More instructions with each option, of the default rule on the widest set. */
static void plot_on(page *out, const csv_table *table) {
    static const char *names[most_options];
    static double x[most_options], pass[most_options], call[most_options];
    static const char *const files[] = {"left_out_pass", "left_out_call"};
    const char *sets[most_sets];
    const int set_count = csv_distinct(table, "isa", sets, most_sets);
    plot drawn[2] = {{0}, {0}};
    int count = 0, last = -1;
    for (int row = csv_next(table, -1, "method=adaptive,isa=%s", sets[set_count - 1]); row >= 0;
         row = csv_next(table, row, "method=adaptive,isa=%s", sets[set_count - 1])) {
        if (count == most_options) break;
        last = row;
        names[count] = csv_text(table, row, "feature");
        x[count] = count;
        pass[count] = csv_number(table, row, "on") - csv_number(table, row, "off");
        call[count] = csv_number(table, row, "on_whole") - csv_number(table, row, "off_whole");
        ++count;
    }
    for (int i = 0; i < 2; ++i) {
        drawn[i].title = i == 0 ? "In a pass of the kernel" : "In the whole call";
        drawn[i].x.names = names;
        drawn[i].x.name_count = count;
        drawn[i].x.title = "option that is switched on";
        drawn[i].y.title = "more instructions";
        drawn[i].width = 470;
        plot_add(&drawn[i], NULL, PLOT_BARS, count, x, i == 0 ? pass : call);
    }
    page_figures(out, files, drawn, 2);
    page_words(out, "How many instructions each option adds, with the default rule on ");
    page_number(out, table, last, "isa", "");
    page_words(out, ", to the ");
    page_number(out, table, last, "off", "%.0f");
    page_words(out, " of a pass over sixteen rays, and to the ");
    page_number(out, table, last, "off_whole", "%.0f");
    page_words(out, " of a call with two passes, callbacks not counted. Few options reach into the "
                    "loop at all; the others are settled once a ray, when it begins or ends. ");
    page_source(out, "instructions");
    page_figure_end(out);
}

static void instructions(page *out) {
    csv_table *const table = csv_open(out->tables, "instructions");
    page_heading(out, "Loops: instructions");
    page_begin(out);
    if (csv_rows(table) == 0) {
        page_words(out, "Not counted on this machine: that takes Linux on x86-64.");
        page_end(out);
        csv_close(table);
        return;
    }
    page_words(out,
               "A result that nobody asks for, an input that is absent and a flag that is not set "
               "leave no instruction in the loop. To show it, everything optional was cut out of a "
               "copy of the source; the kernels of both were compared as code, and both were run "
               "one instruction at a time. The counts are exact, and need no clock.");
    page_end(out);
    table_off(out, table);
    plot_on(out, table);
    csv_close(table);
}

/* ---- Times ----------------------------------------------------------------------------------- */

typedef struct ratio_plot {
    const char *names[most_options];
    double x[most_scenes][most_options], ratio[most_scenes][most_options];
    double low[most_scenes][most_options], high[most_scenes][most_options];
} ratio_plot;

static int is_of(const char *kind, const char *const *kinds) {
    for (; *kinds != NULL; ++kinds) {
        if (strcmp(*kinds, kind) == 0) return 1;
    }
    return 0;
}

static int place_of(ratio_plot *of, int *count, const char *name) {
    for (int i = 0; i < *count; ++i) {
        if (strcmp(of->names[i], name) == 0) return i;
    }
    if (*count == most_options) return -1;
    of->names[*count] = name;
    return (*count)++;
}

/* Scenes stand beside each other at each feature. */
static int add_scene(const csv_table *table, const char *scene, const char *const *kinds, int place,
                     double shift, ratio_plot *of, int *count) {
    int points = 0;
    for (int row = csv_next(table, -1, "scene=%s", scene); row >= 0;
         row = csv_next(table, row, "scene=%s", scene)) {
        if (!is_of(csv_text(table, row, "kind"), kinds)) continue;
        if (strcmp(csv_text(table, row, "method"), "basic") == 0) continue;
        const int at = place_of(of, count, csv_text(table, row, "feature"));
        if (at < 0 || points == most_options) continue;
        of->x[place][points] = at + shift;
        of->ratio[place][points] = csv_number(table, row, "ratio");
        of->low[place][points] = csv_number(table, row, "low");
        of->high[place][points] = csv_number(table, row, "high");
        ++points;
    }
    return points;
}

static void plot_times(const csv_table *table, const char *const *kinds, ratio_plot *of,
                       plot *drawn) {
    const char *scenes[most_scenes];
    const int scene_count = csv_distinct(table, "scene", scenes, most_scenes);
    int count = 0;
    for (int scene = 0; scene < scene_count; ++scene) {
        const double shift = 0.12 * (scene - 0.5 * (scene_count - 1));
        const int points = add_scene(table, scenes[scene], kinds, scene, shift, of, &count);
        if (points == 0) continue;
        plot_series *const series =
            plot_add(drawn, scenes[scene], PLOT_POINTS, points, of->x[scene], of->ratio[scene]);
        series->low = of->low[scene];
        series->high = of->high[scene];
        series->look = plot_look_of(scenes[scene]);
    }
    drawn->x.names = of->names;
    drawn->x.name_count = count;
    drawn->y.title = "time, on over off";
    drawn->width = 720;
    plot_add_mark(drawn, 0, 1, "no difference");
}

static void times(page *out) {
    static const char *const of_calls[] = {"result", "input", "flag", "field", NULL};
    static const char *const of_pictures[] = {"query", "frame", "scene", NULL};
    static ratio_plot calls, pictures;
    csv_table *const table = csv_open(out->tables, "features");
    plot options = {0}, queries = {0};
    page_heading(out, "Loops: times");
    options.title = "Options of a call that traces rays";
    options.x.title = "option that is switched on";
    plot_times(table, of_calls, &calls, &options);
    page_figure(out, "left_out_options", &options);
    page_words(out,
               "What options take of time, with the default rule: the median over rounds in which "
               "both took turns, and the quartiles. The cheaper the distance of the scene, the "
               "more an option shows. A candidate between samples costs most, since it takes "
               "samples at the ends of rays that miss. A bound that fits the body pays for "
               "itself; `bound` is one around everything, which does not. ");
    page_source(out, "features");
    page_figure_end(out);
    queries.title = "Queries, frames and scenes";
    queries.x.title = "what is switched on";
    plot_times(table, of_pictures, &pictures, &queries);
    page_figure(out, "left_out_queries", &queries);
    page_words(
        out,
        "The same for what follows a hit (over tracing alone; of offset origins over "
        "tracing with normals), for what frames do by themselves (over frames without) and "
        "for a zone that no ray meets. Below the line it saves time; cones alone do not in every "
        "scene, and the tree's own callback for normals takes more than differences do. ");
    page_source(out, "features");
    page_figure_end(out);
    csv_close(table);
}

void left_out_loops(page *out) {
    instructions(out);
    times(out);
}
