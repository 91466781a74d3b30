/* SPDX-License-Identifier: MIT
 *
 * What names look like: colours that people who do not see all of them can tell apart (Okabe and
 * Ito's, and Tol's "muted" for more), markers and dashes; and text. */
#include <stdlib.h>
#include <string.h>

#include "page_text.h"
#include "plot_parts.h"

enum {
    circle,
    square,
    triangle,
    diamond,
    wedge,
    cross,
    plus,
    star,
    marker_count,
    bar = marker_count
};

static const struct {
    const char *name;
    plot_look look;
} named[] = {
    {"basic", {"#6e6e6e", NULL, circle, 1, 0}},
    {"relaxed", {"#e69f00", NULL, square, 0, 0}},
    {"enhanced", {"#0072b2", NULL, triangle, 0, 0}},
    {"auto_relaxed", {"#009e73", NULL, diamond, 0, 0}},
    {"adaptive", {"#d55e00", NULL, circle, 0, 1}},
    {"convex", {"#cc79a7", NULL, wedge, 0, 0}},
    {"keinert_listing_1", {"#882255", "2 3", cross, 0, 0}},
    {"keinert_listing_2", {"#aa4499", "2 3", plus, 0, 0}},
    {"balint_algorithm_1", {"#999933", "9 3 2 3", cross, 0, 0}},
    {"balint_algorithm_2", {"#117733", "9 3 2 3", plus, 0, 0}},
    {"balint_algorithm_3", {"#332288", "9 3 2 3", star, 0, 0}},
    {"scalar", {"#000000", "6 3", square, 1, 0}},
    {"scalar_basic", {"#6e6e6e", "6 3", square, 1, 0}},
    {"scalar_adaptive", {"#000000", "6 3", diamond, 1, 0}},
    {"plain_scalar", {"#000000", "6 3", square, 1, 0}},
    {"llvmpipe", {"#2a8cc7", "4 2", wedge, 1, 0}},
    {"llvmpipe_basic", {"#7fb9dd", "4 2", triangle, 1, 0}},
    {"llvmpipe_adaptive", {"#2a8cc7", "4 2", wedge, 1, 0}},
    {"direct", {"#1b1b1b", NULL, circle, 0, 0}},
    {"frame", {"#d55e00", NULL, square, 0, 1}},
    {"passes_1", {"#56b4e9", NULL, triangle, 0, 0}},
    {"passes_2", {"#009e73", NULL, diamond, 0, 0}},
    {"passes_4", {"#0072b2", NULL, wedge, 0, 0}},
    {"passes_6", {"#882255", NULL, star, 0, 0}},
    {"error_50", {"#56b4e9", NULL, circle, 1, 0}},
    {"error_95", {"#0072b2", NULL, triangle, 0, 0}},
    {"error_100", {"#882255", NULL, square, 0, 0}},
    {"promised", {"#1b1b1b", "7 4", bar, 0, 0}},
};
enum { named_count = sizeof named / sizeof named[0] };

static const char *const palette[] = {"#0072b2", "#e69f00", "#009e73", "#cc79a7",
                                      "#882255", "#2a8cc7", "#999933", "#332288",
                                      "#d55e00", "#44aa99", "#6e6e6e", "#117733"};
enum { palette_count = sizeof palette / sizeof palette[0] };

plot_look plot_look_at(int look) {
    if (look >= 0 && look < named_count) return named[look].look;
    const int turn = look < 0 ? -(look + 1) : look - named_count;
    const plot_look own = {palette[turn % palette_count], NULL, (turn + turn / 24) % marker_count,
                           turn / marker_count % 2, 0};
    return own;
}

int plot_look_of(const char *name) {
    enum { most = 200, longest = 47 };
    static char others[most][longest + 1];
    static int other_count;
    for (int i = 0; i < named_count; ++i) {
        if (strcmp(named[i].name, name) == 0) return i;
    }
    for (int i = 0; i < other_count; ++i) {
        if (strncmp(others[i], name, longest) == 0) return named_count + i;
    }
    if (other_count == most) return named_count + (int)(strlen(name) % most);
    strncpy(others[other_count], name, longest);
    return named_count + other_count++;
}

plot_series *plot_add(plot *drawn, const char *name, plot_style style, int count, const double *x,
                      const double *y) {
    if (drawn->series_count == plot_most_series) {
        fprintf(stderr, "plot: too many series in %s\n", drawn->title);
        exit(1);
    }
    const plot_series series = {name, style, name != NULL ? plot_look_of(name) : 0, count, x, y,
                                NULL, NULL};
    drawn->series[drawn->series_count] = series;
    return &drawn->series[drawn->series_count++];
}

void plot_add_mark(plot *drawn, int vertical, double at, const char *words) {
    if (drawn->mark_count == plot_most_marks) {
        fprintf(stderr, "plot: too many marks in %s\n", drawn->title);
        exit(1);
    }
    const plot_mark mark = {vertical, at, words};
    drawn->marks[drawn->mark_count++] = mark;
}

void plot_marker(FILE *file, const plot_look *look, double x, double y, double r) {
    const double s = r * .9, t = r * 1.2, d = r * 1.3;
    const int lines = look->marker >= cross;
    switch (look->marker) {
    case circle:
        fprintf(file, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\"", x, y, r);
        break;
    case square:
        fprintf(file, "<path d=\"M%.1f %.1fh%.1fv%.1fh%.1fz\"", x - s, y - s, 2 * s, 2 * s, -2 * s);
        break;
    case triangle:
        fprintf(file, "<path d=\"M%.1f %.1fl%.1f %.1fh%.1fz\"", x, y - t, t, 1.8 * t, -2 * t);
        break;
    case wedge:
        fprintf(file, "<path d=\"M%.1f %.1fl%.1f %.1fh%.1fz\"", x, y + t, -t, -1.8 * t, 2 * t);
        break;
    case diamond:
        fprintf(file, "<path d=\"M%.1f %.1fl%.1f %.1fl%.1f %.1fl%.1f %.1fz\"", x, y - d, d, d, -d,
                d, -d, -d);
        break;
    case cross:
        fprintf(file, "<path d=\"M%.1f %.1fl%.1f %.1fm0 %.1fl%.1f %.1f\"", x - r, y - r, 2 * r,
                2 * r, -2 * r, -2 * r, 2 * r);
        break;
    case bar:
        fprintf(file, "<path d=\"M%.1f %.1fh%.1f\"", x - t, y, 2 * t);
        break;
    default:
        fprintf(file, "<path d=\"M%.1f %.1fh%.1fM%.1f %.1fv%.1f", x - t, y, 2 * t, x, y - t, 2 * t);
        if (look->marker == star) {
            fprintf(file, "M%.1f %.1fl%.1f %.1fm0 %.1fl%.1f %.1f", x - s, y - s, 2 * s, 2 * s,
                    -2 * s, -2 * s, 2 * s);
        }
        fputc('"', file);
    }
    fprintf(file, " fill=\"%s\" stroke=\"%s\" stroke-width=\"%s\"/>",
            lines          ? "none"
            : look->hollow ? "#fff"
                           : look->colour,
            lines || look->hollow ? look->colour : "#fff", lines || look->hollow ? "1.6" : ".7");
}

void plot_bar_marker(FILE *file, const plot_look *look, double x, double y) {
    plot_look inner = *look;
    inner.colour = "#fff";
    inner.hollow = 0;
    plot_marker(file, &inner, x, y, 3.2);
    if (!look->hollow || look->marker >= cross) return;
    fprintf(file, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"1.4\" fill=\"%s\"/>", x, y, look->colour);
}

/* Letters of sans-serif fonts are half as wide as high on average; narrow and wide ones differ. */
double plot_width(const char *text, double size) {
    double width = 0;
    for (; *text != '\0'; ++text) {
        if (((unsigned char)*text & 0xc0) == 0x80) continue; /* the rest of a letter of UTF-8 */
        if (strchr("iljtfrI.,:;'|()[]- ", *text) != NULL) {
            width += .38;
        } else if (strchr("mwMW%@", *text) != NULL || (*text >= 'A' && *text <= 'Z')) {
            width += .8;
        } else {
            width += .63;
        }
    }
    return width * size;
}

plot_lines plot_wrap(const char *text, double width, double size, int most) {
    plot_lines lines = {0};
    const size_t longest = sizeof lines.line[0] - 1;
    while (*text != '\0' && lines.count < most && lines.count < plot_most_lines) {
        char *const line = lines.line[lines.count];
        const int last = lines.count + 1 == most;
        size_t best = 0;
        for (size_t i = 1; i <= longest; ++i) {
            if (i < longest && text[i] != ' ' && text[i] != '\0') continue;
            memcpy(line, text, i);
            line[i] = '\0';
            if (best == 0 || last || plot_width(line, size) <= width) best = i;
            if (best != i || text[i] == '\0') break;
        }
        line[best] = '\0';
        const double wide = plot_width(line, size);
        if (wide > lines.width) lines.width = wide;
        ++lines.count;
        text += best;
        text += strspn(text, " ");
    }
    return lines;
}

void plot_text(FILE *file, double x, double y, const char *anchor, const char *attributes,
               const char *text) {
    fprintf(file, "<text x=\"%.1f\" y=\"%.1f\"", x, y);
    if (strcmp(anchor, "start") != 0) fprintf(file, " text-anchor=\"%s\"", anchor);
    fprintf(file, "%s>", attributes);
    /* 10^-4: what follows the sign stands high. */
    for (const char *high = strchr(text, '^'); high != NULL; high = strchr(text, '^')) {
        const size_t length = strspn(high + 1, "-0123456789");
        char part[128];
        snprintf(part, sizeof part, "%.*s", (int)(high - text), text);
        page_escape(file, part);
        fprintf(file,
                "<tspan dy=\"-5\" font-size=\"%d\">%.*s</tspan><tspan dy=\"5\">\u200b</tspan>",
                plot_small_size, (int)length, high + 1);
        text = high + 1 + length;
    }
    page_escape(file, text);
    fputs("</text>\n", file);
}

void plot_tick_text(FILE *file, double x, double y, const char *anchor, const plot_tick *tick) {
    fprintf(file, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\">%s", x, y, anchor, tick->text);
    if (tick->power != plot_no_power) {
        fprintf(file, "<tspan dy=\"-5\" font-size=\"%d\">%s%d</tspan>", plot_small_size,
                tick->power < 0 ? "−" : "", abs(tick->power));
    }
    fputs("</text>\n", file);
}

double plot_tick_width(const plot_tick *tick) {
    char power[16] = "";
    if (tick->name != NULL) return plot_width(tick->name, plot_text_size);
    if (tick->power != plot_no_power)
        snprintf(power, sizeof power, "%s%d", tick->power < 0 ? "0" : "", abs(tick->power));
    return plot_width(tick->text, plot_text_size) + plot_width(power, plot_small_size);
}
