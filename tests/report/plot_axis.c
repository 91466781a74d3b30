/* SPDX-License-Identifier: MIT
 *
 * Ranges of axes and their ticks: at 1, 2 and 5 times powers of ten, as many as there is room for.
 */
#include <float.h>
#include <math.h>

#include "plot_parts.h"

int plot_has_place(const plot_scale *scale, double value) {
    return isfinite(value) && (!scale->axis->logarithmic || value > 0);
}

static double inner(const plot_scale *scale, double value) {
    return scale->axis->logarithmic ? log10(value) : value;
}

double plot_place(const plot_scale *scale, double value) {
    return scale->from + (inner(scale, value) - scale->low) / (scale->high - scale->low) *
                             (scale->to - scale->from);
}

static void include(plot_scale *scale, double value) {
    if (!plot_has_place(scale, value)) return;
    const double at = inner(scale, value);
    if (at < scale->low) scale->low = at;
    if (at > scale->high) scale->high = at;
}

/* The range of what is drawn; returns whether there are bars, which begin at 0. */
static int include_all(plot_scale *scale, const plot *drawn, int is_y) {
    int bars = 0;
    for (int i = 0; i < drawn->series_count; ++i) {
        const plot_series *const series = &drawn->series[i];
        for (int k = 0; k < series->count; ++k) {
            include(scale, is_y ? series->y[k] : series->x[k]);
            if (is_y && series->low != NULL) include(scale, series->low[k]);
            if (is_y && series->high != NULL) include(scale, series->high[k]);
        }
        bars |= series->style == PLOT_BARS && series->count > 0;
    }
    for (int i = 0; i < drawn->mark_count; ++i) {
        if (drawn->marks[i].vertical != is_y) include(scale, drawn->marks[i].at);
    }
    return bars && is_y;
}

plot_scale plot_scale_of(const plot *drawn, int is_y) {
    const plot_axis *const axis = is_y ? &drawn->y : &drawn->x;
    plot_scale scale = {axis, DBL_MAX, -DBL_MAX, 0, 1};
    if (axis->names != NULL) {
        scale.low = -.5;
        scale.high = (axis->name_count > 0 ? axis->name_count : 1) - .5;
        return scale;
    }
    const int bars = include_all(&scale, drawn, is_y);
    if (scale.low > scale.high) { /* nothing to be seen */
        scale.low = 0;
        scale.high = 1;
    }
    /* Amounts are compared from 0 on where that leaves them half of the height. */
    const int from_zero =
        is_y && !axis->logarithmic && scale.low >= 0 && (bars || scale.low <= .5 * scale.high);
    const int to_zero = bars && !axis->logarithmic && !from_zero && scale.high <= 0;
    if (from_zero) scale.low = 0;
    if (to_zero) scale.high = 0;
    double span = scale.high - scale.low;
    /* What differs by rounding only is one value. */
    if (!(span > 1e-9 * (fabs(scale.low) + fabs(scale.high)))) {
        const double about = axis->logarithmic || scale.high == 0 ? 1 : fabs(scale.high);
        if (!from_zero) scale.low -= .5 * about;
        scale.high += from_zero ? about : .5 * about;
        span = 0;
    }
    /* The shortest bar of a logarithmic axis is to be seen, and numbers stand at their ends. */
    if (!from_zero) scale.low -= (bars ? axis->logarithmic ? .15 : .08 : .04) * span;
    if (!to_zero) scale.high += (bars ? .08 : .04) * span;
    if ((axis->low != 0 || axis->high != 0) && axis->low < axis->high) {
        if (plot_has_place(&scale, axis->low)) scale.low = inner(&scale, axis->low);
        if (plot_has_place(&scale, axis->high)) scale.high = inner(&scale, axis->high);
        if (!(scale.low < scale.high)) scale.high = scale.low + 1;
    }
    return scale;
}

static plot_tick tick_at(double at) {
    plot_tick tick = {at, "", plot_no_power, NULL};
    return tick;
}

/* mantissa times a power of ten: as it is, or with the power behind it where most ticks are so long
 * that people count zeros. */
static void label(plot_tick *tick, double mantissa, int power, int long_ones, int decimals) {
    if (tick->at == 0) {
        snprintf(tick->text, sizeof tick->text, "0");
    } else if (!long_ones) {
        const double size = fabs(tick->at);
        const char *const minus = tick->at < 0 ? "−" : "";
        if (size >= 9999.5 && decimals == 0) {
            const long whole = lround(size);
            snprintf(tick->text, sizeof tick->text, "%s%ld\u202f%03ld", minus, whole / 1000,
                     whole % 1000);
        } else {
            snprintf(tick->text, sizeof tick->text, "%s%.*f", minus, decimals, size);
        }
    } else {
        tick->power = power;
        if (mantissa == 1) {
            snprintf(tick->text, sizeof tick->text, "10");
        } else {
            snprintf(tick->text, sizeof tick->text, "%s%.*g·10", mantissa < 0 ? "−" : "", 4,
                     fabs(mantissa));
        }
    }
}

static int decimals_of(double step) {
    const double digits = -floor(log10(step) + 1e-9);
    return digits > 0 ? (int)digits : 0;
}

/* Equal distances between low and high, which are values. */
static int even_ticks(double low, double high, double most, plot_tick *ticks) {
    const double raw = (high - low) / (most > 1 ? most : 1);
    const double power = pow(10, floor(log10(raw)));
    const double step = (raw <= power * 1.0001 ? 1
                         : raw <= 2 * power    ? 2
                         : raw <= 5 * power    ? 5
                                               : 10) *
                        power;
    const double largest = fmax(fabs(low), fabs(high));
    const int long_ones = largest >= 999999.5 || step < 1e-4;
    const int common = (int)floor(log10(largest) + 1e-9);
    int count = 0;
    for (double k = ceil(low / step - 1e-6); k <= high / step + 1e-6; ++k) {
        if (count == plot_most_ticks) break;
        plot_tick *const tick = &ticks[count++];
        *tick = tick_at(k * step);
        label(tick, k * step / pow(10, common), common, long_ones, decimals_of(step));
    }
    return count;
}

/* Powers of ten, all or each second, third .., with 2 and 5 between where there is room for it, and
 * fine lines at the others. */
static int power_ticks(const plot_scale *scale, double room, plot_tick *ticks) {
    const double decade = fabs(scale->to - scale->from) / (scale->high - scale->low);
    const int first = (int)floor(scale->low), last = (int)ceil(scale->high);
    const int long_ones = scale->low < -3.5 || scale->high > 5.01;
    static const int strides[] = {1, 2, 3, 5, 10, 20, 50, 100};
    int stride = 0, count = 0;
    while (stride < 7 && strides[stride] * decade < room) ++stride;
    /* From ten thousand on numbers are as wide as powers. */
    const int wide = long_ones || scale->high > 4;
    const int middle = .3 * decade > (wide ? 1.05 : .68) * room;
    const int fine = decade >= 28 && (last - first) * 9 < 60;
    for (int power = first; power <= last; ++power) {
        for (int digit = 1; digit < 10; ++digit) {
            const double at = power + log10(digit);
            const int shown =
                digit == 1 ? power % strides[stride] == 0 : middle && (digit == 2 || digit == 5);
            if (at < scale->low - 1e-9 || at > scale->high + 1e-9) continue;
            if (!shown && (digit == 1 ? strides[stride] > 5 : !fine)) continue;
            if (count == plot_most_ticks) return count;
            ticks[count] = tick_at(digit * pow(10, power));
            if (shown) label(&ticks[count], digit, power, long_ones, power < 0 ? -power : 0);
            ++count;
        }
    }
    return count;
}

int plot_ticks(const plot_scale *scale, double room, plot_tick ticks[plot_most_ticks]) {
    const plot_axis *const axis = scale->axis;
    const double most = fabs(scale->to - scale->from) / room;
    if (axis->names != NULL) {
        int count = 0;
        for (; count < axis->name_count && count < plot_most_ticks; ++count) {
            ticks[count] = tick_at(count);
            ticks[count].name = axis->names[count];
        }
        return count;
    }
    if (!axis->logarithmic) return even_ticks(scale->low, scale->high, most, ticks);
    if (scale->high - scale->low >= .85) return power_ticks(scale, room, ticks);
    /* Less than a decade has too few powers; at its upper end values stand closest. */
    const double low = pow(10, scale->low), high = pow(10, scale->high);
    const int count = even_ticks(low, high, most, ticks);
    if (count > 1 && fabs(plot_place(scale, ticks[count - 1].at) -
                          plot_place(scale, ticks[count - 2].at)) < .7 * room) {
        return even_ticks(low, high, .6 * most, ticks);
    }
    return count;
}
