/* SPDX-License-Identifier: MIT
 *
 * The section on accuracy: each part of the library against double, with the bounds of the headers
 * drawn in. Nothing is computed here but which row is a subject's worst. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../page.h"

enum { most_values = 40, most_lines = 12, most_subjects = 64 };

/* Room for the lines of one plot. */
typedef struct canvas {
    plot drawn;
    int lines;
    double x[most_lines][most_values], y[most_lines][most_values];
} canvas;

/* ---- Plots ----------------------------------------------------------------------------------- */

static canvas empty(const char *title, const char *x, const char *y) {
    canvas one = {0};
    one.drawn.title = title;
    one.drawn.x.title = x;
    one.drawn.y.title = y;
    one.drawn.x.logarithmic = one.drawn.y.logarithmic = 1;
    one.drawn.width = 500;
    one.drawn.height = 340;
    return one;
}

/* A column of a subject; look: whose look it has, or NULL for that of its own name. */
static void line(canvas *to, const csv_table *table, const char *subject, const char *column,
                 const char *name, const char *look, plot_style style) {
    char where[96];
    double *const x = to->x[to->lines], *const y = to->y[to->lines];
    snprintf(where, sizeof where, "subject=%s", subject);
    const int count = csv_points(table, where, "value", column, x, y, most_values);
    if (count == 0) return;
    plot_series *const series = plot_add(&to->drawn, name, style, count, x, y);
    if (look != NULL) series->look = plot_look_of(look);
    ++to->lines;
}

/* Median, 95 of 100 and the worst, with what is promised where something is. */
static void quantiles(canvas *to, const csv_table *table, const char *subject) {
    line(to, table, subject, "error_50", "median", "error_50", PLOT_LINE);
    line(to, table, subject, "error_95", "95 of 100", "error_95", PLOT_LINE);
    line(to, table, subject, "error_100", "worst", "error_100", PLOT_LINE);
    line(to, table, subject, "promised", "promised", "promised", PLOT_DASHED);
}

/* Two plots under one caption; names: of the files. */
static void pair(page *out, const char *first_name, const canvas *first, const char *second_name,
                 const canvas *second) {
    const char *const names[] = {first_name, second_name};
    plot both[2];
    both[0] = first->drawn;
    both[1] = second->drawn;
    page_figures(out, names, both, 2);
}

static void end(page *out) {
    page_source(out, "accuracy");
    page_figure_end(out);
}

static int row_of(const csv_table *table, const char *subject, const char *value) {
    return csv_next(table, -1, "subject=%s,value=%s", subject, value);
}

/* The last row of a subject: the largest number of levels, the farthest distance. */
static int last_row(const csv_table *table, const char *subject) {
    int last = -1;
    for (int row = -1; (row = csv_next(table, row, "subject=%s", subject)) >= 0;) last = row;
    return last;
}

static int worst_row(const csv_table *table, const char *subject) {
    int worst = -1;
    for (int row = -1; (row = csv_next(table, row, "subject=%s", subject)) >= 0;) {
        const double error = csv_number(table, row, "error_100");
        if (worst < 0 || error > csv_number(table, worst, "error_100")) worst = row;
    }
    return worst;
}

static void hits(page *out, const csv_table *table) {
    canvas usual = empty("Hits, epsilon 1e-4 (the default)", "distance", "off the surface");
    canvas least =
        empty("Hits, no epsilon: the rounding floor alone", "distance", "off the surface");
    quantiles(&usual, table, "hit");
    quantiles(&least, table, "hit_floor");
    pair(out, "accuracy_hit", &usual, "accuracy_hit_floor", &least);
    page_words(out,
               "How far hits on bodies a tenth as large as they are far away lie from the true "
               "crossing, along the normal, in world length. Near the eye the default tolerance of "
               "`1e-4` decides; from about `200` on it is what float32 can resolve, which grows "
               "with the distance. A ray that missed would count as infinitely wrong.");
    end(out);
    canvas probes = empty("Hits by probes", "distance", "of the most that is allowed");
    canvas ends = empty("Ends of bounding intervals", "distance", "of the widening, lost");
    ends.drawn.y.logarithmic = probes.drawn.y.logarithmic = 0;
    quantiles(&probes, table, "binary");
    line(&ends, table, "bound_sphere", "error_100", "sphere, worst", "error_100", PLOT_LINE);
    line(&ends, table, "bound_box", "error_100", "box, worst", "enhanced", PLOT_LINE);
    line(&ends, table, "bound_box", "promised", "too narrow", "promised", PLOT_DASHED);
    pair(out, "accuracy_binary", &probes, "accuracy_bound", &ends);
    page_words(out,
               "*Left:* tracing by probes stops short of the surface; shown is how much of the "
               "header's bound for the ray's cosine that is. *Right:* intervals of rays in bounds "
               "are widened so that "
               "rounding cannot cut off what is inside; shown is how much of the widening rounding "
               "takes away. All of it, `1`, would be an interval that is too narrow.");
    end(out);
}

static void normals(page *out, const csv_table *table) {
    static const struct {
        const char *way, *name, *look;
    } ways[] = {{"tetrahedron", "four values", "relaxed"},
                {"central", "six values", "enhanced"},
                {"gradient", "gradient callback", "auto_relaxed"}};
    canvas both[2] = {
        empty("Normals by distance, balls of radius 1", "largest coordinate", "angle, radians"),
        empty("Normals by curvature, at coordinates of 1", "radius of the ball", "angle, radians")};
    for (int k = 0; k < 2; ++k) {
        for (int i = 0; i < 3; ++i) {
            char subject[64];
            snprintf(subject, sizeof subject, "normal_%s_%s", k == 0 ? "distance" : "curvature",
                     ways[i].way);
            line(&both[k], table, subject, "error_100", ways[i].name, ways[i].look, PLOT_LINE);
            line(&both[k], table, subject, "promised", i == 0 ? "promised" : NULL, "promised",
                 PLOT_DASHED);
        }
    }
    pair(out, "accuracy_normal_distance", &both[0], "accuracy_normal_curvature", &both[1]);
    page_words(out,
               "The largest angle between normals and true ones. Dashed above: the promise for "
               "four values; below: for six, both for coordinates of up to a hundred features. "
               "Differences lose what float32 loses: six values are an order of magnitude better "
               "than four, as a rule, and at coordinates of a million features only a gradient "
               "callback gives normals worth the name. *Right:* the library learns the size of a "
               "feature from the ball's bound. What stands out for six values on large balls are "
               "single points whose step crosses a power of two, where positions lose a bit.");
    end(out);
}

static void secondary(page *out, const csv_table *table) {
    canvas starts = empty("Origins of secondary rays", "distance", "tolerances from where meant");
    canvas steps = empty("Jumps between pixels", "rounds of spt_refine()", "half pixels");
    steps.drawn.x.logarithmic = 0;
    quantiles(&starts, table, "offset_cross");
    line(&starts, table, "offset_stay", "error_100", "staying, worst", "relaxed", PLOT_LINE);
    line(&steps, table, "refining", "error_50", "median", "error_50", PLOT_LINE);
    line(&steps, table, "refining", "error_95", "95 of 100", "error_95", PLOT_LINE);
    line(&steps, table, "refining", "error_100", "worst", "error_100", PLOT_LINE);
    pair(out, "accuracy_offset", &starts, "accuracy_refining", &steps);
    page_words(out, "*Left:* how far the origin of a refracted ray is from where it should be, two "
                    "of its tolerances beyond the surface; the dashed line is where it would no "
                    "longer be clear of it. *Right:* what the heights above the surface of "
                    "neighbouring pixels differ by, which shows as rings in normals and textures. "
                    "As traced the median is ");
    page_number(out, table, row_of(table, "refining", "0"), "error_50", "%.2g");
    page_words(out, " half pixels, after the usual three rounds ");
    page_number(out, table, row_of(table, "refining", "3"), "error_50", "%.2g");
    page_words(out, "; the worst are at silhouettes, where rounds help least. The header promises "
                    "no figure.");
    end(out);
    canvas places = empty("Light through glass: where it leaves", "tolerance", "world length");
    canvas ways = empty("Light through glass: which way", "tolerance", "radians");
    quantiles(&places, table, "glass_place");
    quantiles(&ways, table, "glass_direction");
    pair(out, "accuracy_glass_place", &places, "accuracy_glass_direction", &ways);
    page_words(out, "Paths through six bodies of glass of size one, with up to eight reflections "
                    "inside, against exact crossings and Snell's law. The place follows the "
                    "tolerance; the direction is that of float32 on flat faces and follows the "
                    "tolerance on round ones. Paths that pass an edge or the critical angle too "
                    "closely to be decided are left out. The header promises no figure.");
    end(out);
}

static void reflections(page *out, const csv_table *table) {
    canvas fold = empty("Distances of reflection sequences", "levels", "units (see caption)");
    canvas above = empty("The Möbius bound: above the distance", "levels", "units (see caption)");
    canvas below = empty("The Möbius bound: below the distance", "levels", "of the distance");
    canvas float32 = empty("Through Möbius levels, one by one", "levels", "units (see caption)");
    below.drawn.y.logarithmic = 0;
    quantiles(&fold, table, "krs");
    line(&above, table, "moekrs_above", "error_95", "95 of 100", "error_95", PLOT_LINE);
    line(&above, table, "moekrs_above", "error_100", "worst", "error_100", PLOT_LINE);
    line(&above, table, "moekrs_above", "promised", "promised", "promised", PLOT_DASHED);
    pair(out, "accuracy_krs", &fold, "accuracy_moekrs_above", &above);
    page_words(out, "Units of the last place, `2^-24` of the largest number that takes part: one "
                    "unit is the least that float32 can tell. *Left:* kernel-reflection sequences "
                    "of up to ");
    page_number(out, table, last_row(table, "krs"), "value", "");
    page_words(out, " levels, against the fold in double: errors grow far more slowly than the "
                    "bound, which counts every rounding at its worst. *Right:* the lower bound of "
                    "Möbius sequences is above the distance by rounding only.");
    end(out);
    quantiles(&below, table, "moekrs_below");
    line(&float32, table, "level_point", "error_100", "points, worst", "error_100", PLOT_LINE);
    line(&float32, table, "level_point", "error_50", "points, median", "error_50", PLOT_LINE);
    line(&float32, table, "level_normal", "error_50", "normals, median", "auto_relaxed", PLOT_LINE);
    line(&float32, table, "level_radius", "error_50", "radii, median", "relaxed", PLOT_LINE);
    pair(out, "accuracy_moekrs_below", &below, "accuracy_levels", &float32);
    page_words(out, "*Left:* how much less than the distance that bound is, anywhere around the "
                    "model; nothing is promised of that. The deeper a model, the less of the "
                    "distance is left, and the shorter are the steps: with ");
    page_number(out, table, last_row(table, "moekrs_below"), "value", "");
    page_words(out, " levels half of the points are short by more than ");
    page_number(out, table, last_row(table, "moekrs_below"), "error_50", "%.2f");
    page_words(out, " of it. *Right:* points, normals and radii of balls as "
                    "the innermost kernel sees them. Points keep their digits at any depth. Radii "
                    "come out larger by some units a level, which is the safe side for probes; "
                    "those that come out smaller do so by ");
    page_number(out, table, worst_row(table, "level_radius_small"), "error_100", "%.1g");
    page_words(out, " units of the coordinates at most.");
    end(out);
}

static void maps(page *out, const csv_table *table) {
    canvas products =
        empty("Products of maps, in double: 95 of 100", "maps in one", "2^-53, relative");
    canvas rays =
        empty("Rays against a mapped ball, in float32", "maps in one", "of what is allowed");
    static const char *const subjects[] = {"map_point", "map_vector", "region_center",
                                           "region_radius", "exit"};
    static const char *const names[] = {"points", "vectors", "centers of balls", "radii of balls",
                                        "exits"};
    for (int i = 0; i < 5; ++i)
        line(&products, table, subjects[i], "error_95", names[i], NULL, PLOT_LINE);
    rays.drawn.y.logarithmic = 0;
    quantiles(&rays, table, "conformal_hit");
    pair(out, "accuracy_maps", &products, "accuracy_conformal", &rays);
    page_words(out, "*Left:* what a long product loses: maps multiplied into one matrix, in units "
                    "of double. One in twenty products of ");
    page_number(out, table, last_row(table, "region_radius"), "value", "");
    page_words(out, " maps leaves a radius off by more than ");
    page_number(out, table, last_row(table, "region_radius"), "error_95", "%.1e");
    page_words(out, " of them. So models keep a map for each level, which even in float32 loses "
                    "next to nothing (the figure before). The header promises no figure. *Right:* "
                    "`spt_conformal_trace()` against the image of a ball under such a product: how "
                    "far hits are off it. What rounding does to a product of many maps comes on "
                    "top, of which the header does not speak.");
    end(out);
}

/* By name, not by number. */
static void shapes(page *out, const csv_table *table) {
    static const char *const columns[][3] = {{"error_95", "95 of 100", "error_95"},
                                             {"error_100", "worst", "error_100"},
                                             {"promised", "promised", "promised"}};
    const char *names[most_values];
    double place[most_values], value[3][most_values];
    canvas one = empty("Shapes in float32", NULL, "2^-24 of (coordinates + size) L");
    int count = 0;
    for (int row = -1; count < most_values && (row = csv_next(table, row, "subject=shape")) >= 0;) {
        names[count] = csv_text(table, row, "value");
        place[count] = count;
        for (int k = 0; k < 3; ++k) value[k][count] = csv_number(table, row, columns[k][0]);
        ++count;
    }
    one.drawn.width = 700;
    one.drawn.height = 400;
    one.drawn.x.logarithmic = 0;
    one.drawn.x.names = names;
    one.drawn.x.name_count = count;
    for (int k = 0; k < 3; ++k)
        plot_add(&one.drawn, columns[k][1], PLOT_POINTS, count, place, value[k])->look =
            plot_look_of(columns[k][2]);
    page_figure(out, "accuracy_shapes", &one.drawn);
    page_words(out, "The shapes and operators of `shapes.h` against the same formulas in double, "
                    "and what the header promises: the same for all, twice as much for general "
                    "exponents.");
    end(out);
}

static void functions(page *out, const csv_table *table) {
    canvas arcs = empty("Toroidal capsules by flatness", "sagitta over chord", "of the arc's size");
    canvas angles = empty("Sine and cosine", "angles up to", "absolute error");
    line(&arcs, table, "arc_usual", "error_100", "around the center, worst", "relaxed", PLOT_LINE);
    line(&arcs, table, "arc_usual", "error_50", "around the center, median", "basic", PLOT_LINE);
    line(&arcs, table, "arc", "error_100", "worst", "error_100", PLOT_LINE);
    line(&arcs, table, "arc", "error_50", "median", "error_50", PLOT_LINE);
    line(&arcs, table, "arc", "promised", "promised", "promised", PLOT_DASHED);
    line(&angles, table, "sine", "error_100", "sine, worst", "error_100", PLOT_LINE);
    line(&angles, table, "cosine", "error_100", "cosine, worst", "error_95", PLOT_LINE);
    line(&angles, table, "sine", "error_50", "sine, median", "error_50", PLOT_LINE);
    line(&angles, table, "sine", "promised", "promised", "promised", PLOT_DASHED);
    pair(out, "accuracy_arc", &arcs, "accuracy_functions", &angles);
    page_words(out, "*Left:* branches of trees are tubes around arcs. Counted from the center of "
                    "the circle, as they are usually written, flat arcs lose all digits; counted "
                    "from the middle of the arc none. *Right:* the library's own sine and cosine, "
                    "which give the same bits everywhere.");
    end(out);
}

/* ---- Promises -------------------------------------------------------------------------------- */

/* The row of a subject that uses most of what is promised; -1 where nothing is. */
static int tightest(const csv_table *table, const char *subject) {
    double most = -1;
    int worst = -1;
    for (int row = -1; (row = csv_next(table, row, "subject=%s", subject)) >= 0;) {
        const double promised = csv_number(table, row, "promised");
        const double used = csv_number(table, row, "error_100") / promised;
        if (!(promised > 0) || !(used > most)) continue;
        most = used;
        worst = row;
    }
    return worst;
}

/* What subjects with a promise are called; others by their names in the table. */
static const char *name_of(const char *subject) {
    static const char *const names[][2] = {
        {"hit", "hits, default tolerance"},
        {"hit_floor", "hits, rounding floor alone"},
        {"binary", "hits by probes"},
        {"normal_distance_tetrahedron", "normals, four values, by distance"},
        {"normal_distance_central", "normals, six values, by distance"},
        {"normal_curvature_tetrahedron", "normals, four values, by curvature"},
        {"normal_curvature_central", "normals, six values, by curvature"},
        {"offset_stay", "origins of secondary rays, staying"},
        {"offset_cross", "origins of secondary rays, crossing"},
        {"krs", "distances of reflection sequences"},
        {"conformal_hit", "hits on a mapped ball"},
        {"moekrs_above", "Möbius bound, above the distance"},
        {"moekrs_below", "Möbius bound, below the distance (median)"},
        {"bound_sphere", "ray intervals of spheres"},
        {"bound_box", "ray intervals of boxes"},
        {"shape", "shapes and operators"},
        {"arc", "toroidal capsules by flatness"}};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; ++i) {
        if (strcmp(names[i][0], subject) == 0) return names[i][1];
    }
    return subject;
}

static void promises(page *out, const csv_table *table) {
    const char *subjects[most_subjects];
    const int count = csv_distinct(table, "subject", subjects, most_subjects);
    page_table(out,
               "The promises of the headers. Each part at the value of its parameter that "
               "uses most of what is promised; units and where it says so are below.",
               "part|its worst value||error|promised|verdict");
    for (int i = 0; i < count; ++i) {
        const int row = tightest(table, subjects[i]);
        if (row < 0) continue;
        const int kept = csv_number(table, row, "error_100") <= csv_number(table, row, "promised");
        page_row(out);
        page_cell(out, NULL, "%s", name_of(subjects[i]));
        page_cell(out, "quiet", "%s", csv_text(table, row, "parameter"));
        page_cell_number(out, NULL, table, row, "value", "");
        page_cell_number(out, NULL, table, row, "error_100", "%.3g");
        page_cell_number(out, NULL, table, row, "promised", "%.3g");
        page_cell(out, kept ? "good" : "bad", kept ? "kept" : "exceeded");
    }
    page_table_end(out);
    page_source(out, "accuracy");
    page_fold(out, "Units, and what the headers say");
    page_table(out, "Errors are in these units.", "part|unit|what the header says");
    for (int i = 0; i < count; ++i) {
        const int row = tightest(table, subjects[i]);
        if (row < 0) continue;
        page_row(out);
        page_cell(out, NULL, "%s", name_of(subjects[i]));
        page_cell_number(out, NULL, table, row, "unit", "");
        page_cell_number(out, NULL, table, row, "source", "");
    }
    page_table_end(out);
    page_fold_end(out);
}

void page_accuracy(page *out) {
    csv_table *const table = csv_open(out->tables, "accuracy");
    page_section(out, "accuracy", "Accuracy of the parts");
    page_begin(out);
    page_words(out, "Each part of the library alone, in the precision in which it runs, against "
                    "the mathematics in double or long double: the median, what nineteen of twenty "
                    "samples keep to, and the worst. Where a public header promises a bound, it is "
                    "drawn dashed. Of some parts no header promises any; there the figures say "
                    "what to expect.");
    page_end(out);
    promises(out, table);
    page_heading(out, "Rays and bounds");
    hits(out, table);
    page_heading(out, "At the surface");
    normals(out, table);
    secondary(out, table);
    page_heading(out, "Reflection sequences and conformal maps");
    reflections(out, table);
    maps(out, table);
    page_heading(out, "Shapes");
    shapes(out, table);
    functions(out, table);
    csv_close(table);
}
