/* SPDX-License-Identifier: MIT
 *
 * A plot as SVG: where everything goes, axes, grid, marks and legend. */
#include <math.h>
#include <string.h>

#include "page_text.h"
#include "plot_parts.h"

typedef struct plot_layout {
    plot_frame frame;
    plot_lines title, x_title, y_title;
    plot_tick x_tick[plot_most_ticks], y_tick[plot_most_ticks];
    int x_ticks, y_ticks;
    double y_label_width;  /* of the longest */
    double x_label_height; /* of the highest */
    int slanted;           /* names on the x axis that have no room side by side */
    int legend_columns, legend_rows;
    double legend_width; /* of a column */
    double width, height;
} plot_layout;

static double clamped(double value, double low, double high) {
    return value < low ? low : value > high ? high : value;
}

static double slot_width(const plot_frame *frame) {
    return (frame->right - frame->left) / (frame->x.high - frame->x.low);
}

/* A slanted name in two lines where those of its neighbours leave room for them. */
enum { slanted_slot = 50, slanted_width = 120 };
static plot_lines slanted_lines(const plot_frame *frame, const char *name) {
    return plot_wrap(name, slanted_width, plot_text_size, slot_width(frame) > slanted_slot ? 2 : 1);
}

/* Names side by side, in as many lines as they need, or slanted, which may need room on the left. */
static void layout_names(plot_layout *layout) {
    const plot_axis *const axis = layout->frame.x.axis;
    const double slot = slot_width(&layout->frame) - 6;
    double longest = 0, reach = 0;
    int lines = 1;
    layout->slanted = 0;
    for (int i = 0; i < axis->name_count; ++i) {
        const plot_lines cut = plot_wrap(axis->names[i], slot, plot_text_size, 3);
        const plot_lines turned = slanted_lines(&layout->frame, axis->names[i]);
        if (cut.width > slot) layout->slanted = 1;
        if (cut.count > lines) lines = cut.count;
        longest = fmax(longest, turned.width);
        reach = fmax(reach, .79 * turned.width + 16 - (i + .5) * (slot + 6));
    }
    if (layout->slanted) layout->frame.left = fmax(layout->frame.left, reach);
    layout->frame.x.from = layout->frame.left;
    layout->x_label_height = layout->slanted ? .62 * longest + (slot > slanted_slot ? 26 : 12)
                                             : lines * plot_line_height;
}

/* Whether a series stands in the legend: the first of its name. */
static int is_in_legend(const plot *drawn, int index) {
    if (drawn->series[index].name == NULL) return 0;
    for (int i = 0; i < index; ++i) {
        const char *const name = drawn->series[i].name;
        if (name != NULL && strcmp(name, drawn->series[index].name) == 0) return 0;
    }
    return 1;
}

/* How far the last number of the x axis would reach beyond the picture. */
static double overhang(plot_layout *layout) {
    const plot_frame *const frame = &layout->frame;
    double most = 0;
    layout->x_ticks = plot_ticks(&frame->x, 60, layout->x_tick);
    for (int i = 0; i < layout->x_ticks; ++i) {
        const plot_tick *const tick = &layout->x_tick[i];
        if (tick->name != NULL || tick->text[0] == '\0') continue;
        const double end = plot_place(&frame->x, tick->at) + .5 * plot_tick_width(tick);
        most = fmax(most, end - (layout->width - 4));
    }
    return most;
}

static void layout_legend(plot_layout *layout) {
    const plot *const drawn = layout->frame.drawn;
    double longest = 0;
    int names = 0;
    for (int i = 0; i < drawn->series_count; ++i) {
        if (!is_in_legend(drawn, i)) continue;
        ++names;
        longest = fmax(longest, plot_width(drawn->series[i].name, plot_text_size));
    }
    layout->legend_width = longest + 48;
    layout->legend_columns = (int)clamped((layout->width - 24) / layout->legend_width, 1, 6);
    layout->legend_rows = (names + layout->legend_columns - 1) / layout->legend_columns;
}

/* The frame from what stands around it. Labels of the y axis need its height, which the labels of
 * the x axis take from, which need the width that the former leave: once more makes them agree. */
static void lay_out(plot_layout *layout, const plot *drawn) {
    plot_frame *const frame = &layout->frame;
    frame->drawn = drawn;
    layout->width = drawn->width > 0 ? drawn->width : 560;
    const double height = drawn->height > 0 ? drawn->height : 380;
    frame->x = plot_scale_of(drawn, 0);
    frame->y = plot_scale_of(drawn, 1);
    layout->title = plot_wrap(drawn->title != NULL ? drawn->title : "", layout->width - 24,
                              1.1 * plot_title_size, 3);
    layout_legend(layout);
    frame->left = 70;
    frame->top = 20;
    frame->bottom = height - 60;
    double beyond = 0;
    for (int round = 0; round < 2; ++round) {
        frame->right = layout->width - 16 - fmax(plot_mark_margin(drawn), beyond);
        frame->x.from = frame->left;
        frame->x.to = frame->right;
        frame->y.from = frame->bottom;
        frame->y.to = frame->top;
        layout->y_ticks = plot_ticks(&frame->y, 34, layout->y_tick);
        layout->y_label_width = 0;
        for (int i = 0; i < layout->y_ticks; ++i) {
            layout->y_label_width =
                fmax(layout->y_label_width, plot_tick_width(&layout->y_tick[i]));
        }
        layout->y_title = plot_wrap(drawn->y.title != NULL ? drawn->y.title : "",
                                    frame->bottom - frame->top + 8, plot_text_size, 3);
        frame->left = 8 + (layout->y_title.count > 0 ? 12 : 0) +
                      layout->y_title.count * plot_line_height +
                      fmin(layout->y_label_width, .45 * layout->width) + 4;
        frame->x.from = frame->left;
        layout->x_title = plot_wrap(drawn->x.title != NULL ? drawn->x.title : "",
                                    frame->right - frame->left, plot_text_size, 2);
        layout->x_label_height = plot_line_height;
        layout->slanted = 0;
        if (drawn->x.names != NULL) layout_names(layout);
        beyond = overhang(layout);
        plot_layout_marks(frame);
        frame->top = 12 + layout->title.count * 20 + frame->mark_rows * plot_line_height;
        frame->bottom = fmax(frame->top + 140, height - 12 - layout->x_label_height -
                                                   layout->x_title.count * plot_line_height);
        frame->y.from = frame->bottom;
        frame->y.to = frame->top;
    }
    layout->y_ticks = plot_ticks(&frame->y, 34, layout->y_tick);
    (void)overhang(layout);
    layout->height = frame->bottom + 12 + layout->x_label_height +
                     layout->x_title.count * plot_line_height +
                     (layout->legend_rows > 0 ? 8 + layout->legend_rows * 19 : 0);
}

static int is_labelled(const plot_tick *tick) {
    return tick->name != NULL || tick->text[0] != '\0';
}

static void draw_grid(FILE *file, const plot_layout *layout) {
    const plot_frame *const frame = &layout->frame;
    for (int strong = 0; strong < 2; ++strong) {
        int begun = 0;
        for (int i = 0; i < layout->y_ticks; ++i) {
            const double y = plot_place(&frame->y, layout->y_tick[i].at);
            if (is_labelled(&layout->y_tick[i]) != strong) continue;
            if (!begun) fputs("<path d=\"", file);
            begun = 1;
            fprintf(file, "M%.1f %.1fH%.1f", frame->left, y, frame->right);
        }
        for (int i = 0; i < layout->x_ticks; ++i) {
            const double x = plot_place(&frame->x, layout->x_tick[i].at);
            if (is_labelled(&layout->x_tick[i]) != strong || frame->x.axis->names != NULL) continue;
            if (!begun) fputs("<path d=\"", file);
            begun = 1;
            fprintf(file, "M%.1f %.1fV%.1f", x, frame->top, frame->bottom);
        }
        if (begun) fprintf(file, "\" stroke=\"%s\"/>\n", strong ? "#d9d9d9" : "#f0f0f0");
    }
}

/* Names of the x axis: slanted ones as many as there is room for. */
static void draw_name(FILE *file, const plot_layout *layout, int index) {
    const plot_frame *const frame = &layout->frame;
    const char *const name = layout->x_tick[index].name;
    const double x = plot_place(&frame->x, layout->x_tick[index].at);
    const double slot = slot_width(frame);
    if (!layout->slanted) {
        const plot_lines cut = plot_wrap(name, slot - 6, plot_text_size, 3);
        for (int i = 0; i < cut.count; ++i) {
            plot_text(file, x, frame->bottom + 16 + i * 15, "middle", "", cut.line[i]);
        }
        return;
    }
    const int stride = slot < 14 ? (int)ceil(14 / slot) : 1;
    if (index % stride != 0) return;
    const plot_lines cut = slanted_lines(frame, name);
    char turn[96];
    snprintf(turn, sizeof turn, " transform=\"rotate(-38 %.1f %.1f)\"", x + 4, frame->bottom + 14);
    for (int i = 0; i < cut.count; ++i) {
        plot_text(file, x + 4, frame->bottom + 14 + i * 15, "end", turn, cut.line[i]);
    }
}

static void draw_axes(FILE *file, const plot_layout *layout) {
    const plot_frame *const frame = &layout->frame;
    fprintf(file,
            "<path d=\"M%.1f %.1fV%.1fH%.1f\" fill=\"none\" stroke=\"#555\" "
            "stroke-width=\"1.2\"/>\n",
            frame->left, frame->top, frame->bottom, frame->right);
    for (int i = 0; i < layout->y_ticks; ++i) {
        const plot_tick *const tick = &layout->y_tick[i];
        const double y = plot_place(&frame->y, tick->at) + 4.5;
        if (tick->name != NULL) {
            plot_text(file, frame->left - 7, y, "end", "", tick->name);
        } else if (tick->text[0] != '\0') {
            plot_tick_text(file, frame->left - 7, y, "end", tick);
        }
    }
    for (int i = 0; i < layout->x_ticks; ++i) {
        const plot_tick *const tick = &layout->x_tick[i];
        if (tick->name != NULL) {
            draw_name(file, layout, i);
        } else if (tick->text[0] != '\0') {
            plot_tick_text(file, plot_place(&frame->x, tick->at), frame->bottom + 17, "middle",
                           tick);
        }
    }
    const double below = frame->bottom + 6 + layout->x_label_height;
    for (int i = 0; i < layout->x_title.count; ++i) {
        plot_text(file, .5 * (frame->left + frame->right), below + (i + .8) * plot_line_height,
                  "middle", "", layout->x_title.line[i]);
    }
    for (int i = 0; i < layout->y_title.count; ++i) {
        char turn[96];
        const double x = frame->left - layout->y_label_width - 17 -
                         (layout->y_title.count - 1 - i) * plot_line_height,
                     y = .5 * (frame->top + frame->bottom);
        snprintf(turn, sizeof turn, " transform=\"rotate(-90 %.1f %.1f)\"", x, y);
        plot_text(file, x, y, "middle", turn, layout->y_title.line[i]);
    }
}

static void draw_legend(FILE *file, const plot_layout *layout) {
    const plot *const drawn = layout->frame.drawn;
    const double top = layout->height - layout->legend_rows * 19 - 2;
    for (int i = 0, place = 0; i < drawn->series_count; ++i) {
        const plot_series *const series = &drawn->series[i];
        if (!is_in_legend(drawn, i)) continue;
        const plot_look look = plot_look_at(series->look);
        const double x = 14 + place % layout->legend_columns * layout->legend_width;
        const double y = top + place / layout->legend_columns * 19 + 5;
        ++place;
        if (series->style == PLOT_BARS) {
            fprintf(file, "<path d=\"M%.1f %.1fh18v14h-18z\" fill=\"%s\"/>", x + 8, y - 7,
                    look.colour);
            plot_bar_marker(file, &look, x + 17, y);
        } else {
            const char *const dash = series->style == PLOT_DASHED ? "7 4" : look.dash;
            if (series->style != PLOT_POINTS) {
                fprintf(file, "<path d=\"M%.1f %.1fh30\" stroke=\"%s\" stroke-width=\"%s\"", x, y,
                        look.colour, look.strong ? "4.2" : "1.7");
                if (dash != NULL) fprintf(file, " stroke-dasharray=\"%s\"", dash);
                fputs("/>", file);
            }
            plot_marker(file, &look, x + 15, y, look.strong ? 5.6 : 3.8);
        }
        plot_text(file, x + 36, y + 4.5, "start", "", series->name);
    }
}

static int has_data(const plot_frame *frame) {
    return plot_hidden(frame, frame->left - 1e9, frame->right + 1e9, frame->top - 1e9,
                       frame->bottom + 1e9) > 0;
}

void plot_svg(FILE *file, const plot *drawn) {
    plot_layout layout;
    lay_out(&layout, drawn);
    const plot_frame *const frame = &layout.frame;
    fprintf(file,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\" role=\"img\" "
            "font-family=\"system-ui,sans-serif\" font-size=\"%d\" fill=\"%s\" aria-label=\"",
            layout.width, ceil(layout.height), plot_text_size, PLOT_INK);
    page_escape(file, drawn->title != NULL ? drawn->title : "plot");
    fprintf(file, "\">\n<path d=\"M0 0h%.0fv%.0fh%.0fz\" fill=\"#fff\"/>\n", layout.width,
            ceil(layout.height), -layout.width);
    for (int i = 0; i < layout.title.count; ++i) {
        plot_text(file, 12, 19 + i * 20, "start", " font-size=\"16\" font-weight=\"600\"",
                  layout.title.line[i]);
    }
    draw_grid(file, &layout);
    plot_draw_series(file, frame);
    draw_axes(file, &layout);
    plot_draw_marks(file, frame);
    plot_draw_values(file, frame);
    draw_legend(file, &layout);
    if (!has_data(frame)) {
        plot_text(file, .5 * (frame->left + frame->right), .5 * (frame->top + frame->bottom),
                  "middle", plot_halo, "nothing was measured");
    }
    fputs("</svg>\n", file);
}
