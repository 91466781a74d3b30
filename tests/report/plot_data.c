/* SPDX-License-Identifier: MIT
 *
 * The data of a plot: lines, points and bars with their errors, cut at the edges. */
#include <math.h>

#include "plot_parts.h"

typedef struct plot_point {
    double x, y;
    int there;
} plot_point;

static plot_point point_of(const plot_frame *frame, const plot_series *series, int index) {
    plot_point point = {0, 0, 0};
    if (!plot_has_place(&frame->x, series->x[index]) ||
        !plot_has_place(&frame->y, series->y[index])) {
        return point;
    }
    point.x = plot_place(&frame->x, series->x[index]);
    point.y = plot_place(&frame->y, series->y[index]);
    point.there = 1;
    return point;
}

static int is_inside(const plot_frame *frame, const plot_point *point) {
    return point->there && point->x >= frame->left - .01 && point->x <= frame->right + .01 &&
           point->y >= frame->top - .01 && point->y <= frame->bottom + .01;
}

/* Narrows the share from..to of a line to where start + share * way lies in low..high. */
static int cut(double start, double way, double low, double high, double *from, double *to) {
    if (fabs(way) < 1e-9) return start >= low && start <= high;
    const double a = (low - start) / way, b = (high - start) / way;
    *from = fmax(*from, fmin(a, b));
    *to = fmin(*to, fmax(a, b));
    return *from <= *to;
}

/* The part of a line that is inside of the frame (Liang and Barsky). */
static int clip(const plot_frame *frame, plot_point *a, plot_point *b) {
    const double dx = b->x - a->x, dy = b->y - a->y;
    double from = 0, to = 1;
    if (!a->there || !b->there || !cut(a->x, dx, frame->left, frame->right, &from, &to) ||
        !cut(a->y, dy, frame->top, frame->bottom, &from, &to)) {
        return 0;
    }
    b->x = a->x + to * dx;
    b->y = a->y + to * dy;
    a->x += from * dx;
    a->y += from * dy;
    return 1;
}

static void draw_path(FILE *file, const plot_frame *frame, const plot_series *series,
                      const plot_look *look) {
    plot_point before = {0, 0, 0};
    int begun = 0;
    for (int i = 1; i < series->count; ++i) {
        plot_point a = point_of(frame, series, i - 1), b = point_of(frame, series, i);
        if (!clip(frame, &a, &b)) {
            before.there = 0;
            continue;
        }
        if (!begun) fputs("<path fill=\"none\" d=\"", file);
        begun = 1;
        if (!before.there || fabs(before.x - a.x) + fabs(before.y - a.y) > .01) {
            fprintf(file, "M%.1f %.1f", a.x, a.y);
        }
        fprintf(file, "L%.1f %.1f", b.x, b.y);
        before = b;
    }
    if (!begun) return;
    const char *const dash = series->style == PLOT_DASHED ? "7 4" : look->dash;
    fprintf(file, "\" stroke=\"%s\" stroke-width=\"%s\" stroke-linejoin=\"round\"", look->colour,
            look->strong ? "4.2" : "1.7");
    if (dash != NULL) fprintf(file, " stroke-dasharray=\"%s\"", dash);
    fputs("/>\n", file);
}

static void draw_error(FILE *file, const plot_frame *frame, const plot_series *series, int index,
                       double x, const char *colour) {
    plot_point low = {x, 0, 1}, high = {x, 0, 1};
    if (series->low == NULL || series->high == NULL) return;
    if (!isfinite(series->low[index]) || !plot_has_place(&frame->y, series->high[index])) return;
    /* An error down to 0 ends at the edge of a logarithmic axis. */
    low.y = plot_has_place(&frame->y, series->low[index])
                ? plot_place(&frame->y, series->low[index])
                : frame->bottom;
    high.y = plot_place(&frame->y, series->high[index]);
    if (!clip(frame, &low, &high)) return;
    fprintf(file,
            "<path fill=\"none\" stroke=\"%s\" stroke-width=\"1.3\" d=\"M%.1f %.1fV%.1fM%.1f "
            "%.1fh7M%.1f %.1fh7\"/>\n",
            colour, x, low.y, high.y, x - 3.5, low.y, x - 3.5, high.y);
}

static void draw_points(FILE *file, const plot_frame *frame, const plot_series *series,
                        const plot_look *look) {
    const int points = series->style == PLOT_POINTS, many = points && series->count > 300;
    const double radius = many ? 2 : look->strong ? 5.6 : 3.8;
    /* Of long lines some markers tell enough. */
    const int stride = points || series->count <= 40 ? 1 : series->count / 20;
    for (int i = 0; i < series->count; ++i) {
        const plot_point point = point_of(frame, series, i);
        if (i % stride == 0 && point.there) {
            draw_error(file, frame, series, i, point.x, look->colour);
        }
        if (i % stride != 0 || !is_inside(frame, &point)) continue;
        plot_marker(file, look, point.x, point.y, radius);
        fputc('\n', file);
    }
}

/* The width of a place on the axis: of a name, or between the two closest bars. */
static double slot_of(const plot_frame *frame) {
    double slot = frame->right - frame->left;
    if (frame->x.axis->names != NULL) return slot / (frame->x.high - frame->x.low);
    for (int s = 0; s < frame->drawn->series_count; ++s) {
        const plot_series *const series = &frame->drawn->series[s];
        for (int i = 1; series->style == PLOT_BARS && i < series->count; ++i) {
            const plot_point a = point_of(frame, series, i - 1), b = point_of(frame, series, i);
            if (a.there && b.there && fabs(a.x - b.x) > 0) slot = fmin(slot, fabs(a.x - b.x));
        }
    }
    return slot;
}

/* Bars of how many series stand beside each other, and of how many all bars are. */
static int bar_series(const plot *drawn, int *bars) {
    int count = 0;
    *bars = 0;
    for (int s = 0; s < drawn->series_count; ++s) {
        if (drawn->series[s].style != PLOT_BARS) continue;
        ++count;
        *bars += drawn->series[s].count;
    }
    return count;
}

static void draw_bars(FILE *file, const plot_frame *frame, const plot_series *series,
                      const plot_look *look, int place) {
    int bars;
    const int beside = bar_series(frame->drawn, &bars);
    const double slot = slot_of(frame), width = .8 * slot / beside;
    const double zero = frame->y.axis->logarithmic
                            ? frame->bottom
                            : fmin(fmax(plot_place(&frame->y, 0), frame->top), frame->bottom);
    for (int i = 0; i < series->count; ++i) {
        const plot_point point = point_of(frame, series, i);
        if (!point.there) continue;
        const double left = point.x + (place - .5 * beside) * width, middle = left + .5 * width;
        const double end = fmin(fmax(point.y, frame->top), frame->bottom);
        const double top = fmin(zero, end), high = fabs(zero - end);
        fprintf(file,
                "<path d=\"M%.1f %.1fh%.1fv%.1fh%.1fz\" fill=\"%s\" stroke=\"#fff\" "
                "stroke-width=\".8\"/>\n",
                left, top, width, high, -width, look->colour);
        if (beside > 1 && width >= 10 && high >= 17) {
            plot_bar_marker(file, look, middle, zero < end ? zero + 9 : zero - 9);
            fputc('\n', file);
        }
        draw_error(file, frame, series, i, middle, PLOT_INK);
    }
}

void plot_draw_values(FILE *file, const plot_frame *frame) {
    const plot *const drawn = frame->drawn;
    int bars;
    const int beside = bar_series(drawn, &bars);
    if (bars > 16) return;
    const double width = .8 * slot_of(frame) / beside;
    for (int s = 0, place = 0; s < drawn->series_count; ++s) {
        const plot_series *const series = &drawn->series[s];
        if (series->style != PLOT_BARS) continue;
        for (int i = 0; series->low == NULL && i < series->count; ++i) {
            const plot_point point = point_of(frame, series, i);
            char text[24];
            const double size = fabs(series->y[i]);
            snprintf(text, sizeof text, size >= 999.5 && size < 1e6 ? "%.0f" : "%.3g",
                     series->y[i]);
            if (!is_inside(frame, &point) || plot_width(text, plot_small_size) > width / .8 + 4)
                continue;
            const double x = point.x + (place - .5 * beside + .5) * width;
            const int below = !frame->y.axis->logarithmic && series->y[i] < 0;
            char attributes[160];
            snprintf(attributes, sizeof attributes, " font-size=\"%d\"%s", plot_small_size,
                     plot_halo);
            plot_text(file, x, below ? point.y + 13 : point.y - 4, "middle", attributes, text);
        }
        ++place;
    }
}

void plot_draw_series(FILE *file, const plot_frame *frame) {
    const plot *const drawn = frame->drawn;
    for (int s = 0, place = 0; s < drawn->series_count; ++s) {
        const plot_look look = plot_look_at(drawn->series[s].look);
        if (drawn->series[s].style != PLOT_BARS) continue;
        draw_bars(file, frame, &drawn->series[s], &look, place++);
    }
    /* The strong line lies below the others, broad enough to be seen where they are the same. */
    for (int strong = 1; strong >= 0; --strong) {
        for (int s = 0; s < drawn->series_count; ++s) {
            const plot_series *const series = &drawn->series[s];
            const plot_look look = plot_look_at(series->look);
            if (series->style == PLOT_BARS || look.strong != strong) continue;
            if (series->style != PLOT_POINTS) draw_path(file, frame, series, &look);
            draw_points(file, frame, series, &look);
        }
    }
}

int plot_hidden(const plot_frame *frame, double left, double right, double top, double bottom) {
    int hidden = 0;
    for (int s = 0; s < frame->drawn->series_count; ++s) {
        const plot_series *const series = &frame->drawn->series[s];
        for (int i = 0; i < series->count; ++i) {
            const plot_point b = point_of(frame, series, i);
            const plot_point a =
                i > 0 && series->style < PLOT_POINTS ? point_of(frame, series, i - 1) : b;
            const double far = a.there && b.there ? fmax(fabs(b.x - a.x), fabs(b.y - a.y)) : 0;
            const int steps = (int)fmin(far / 6, 200) + 1;
            for (int k = 0; b.there && k < steps; ++k) {
                const double x = far > 0 ? b.x + (a.x - b.x) * k / steps : b.x;
                const double y = far > 0 ? b.y + (a.y - b.y) * k / steps : b.y;
                const int inside = x > left && x < right && y > top - 3 && y < bottom + 3;
                hidden += inside * (k == 0 ? 3 : 1);
            }
        }
    }
    return hidden;
}
