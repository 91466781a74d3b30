/* SPDX-License-Identifier: MIT
 *
 * Verdicts, reasons and means over the rows of tables. */
#include "claims_verdict.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

const char claims_exceeded[] = "exceeded", claims_reached[] = "reached";
const char claims_not_reached[] = "not reached";

const char *claims_gain_is(claims_spread ours, double enough, double most) {
    if (ours.low >= most) return claims_exceeded;
    return ours.middle >= enough ? claims_reached : claims_not_reached;
}

const char *claims_cost_is(claims_spread ours, double most) {
    if (ours.high <= most) return claims_exceeded;
    return ours.middle <= most ? claims_reached : claims_not_reached;
}

void claims_say(claims_verdict *verdict, const char *format, ...) {
    const size_t used = strlen(verdict->why);
    va_list values;
    va_start(values, format);
    const int more = vsnprintf(verdict->why + used, sizeof verdict->why - used, format, values);
    va_end(values);
    report_expect(more >= 0 && (size_t)more < sizeof verdict->why - used, "a cell is too long");
    report_expect(strchr(verdict->why, ',') == NULL, "a comma within a cell");
}

double claims_mean_of(const claims_mean *of) {
    report_expect(of->count > 0, "a mean of nothing");
    return exp(of->logarithms / of->count);
}

claims_mean claims_mean_where(const csv_table *table, const char *where, const char *known,
                              const char *column) {
    claims_mean of = {0, 0, 0, 0};
    for (int row = -1; (row = csv_next(table, row, where)) >= 0;) {
        if (isnan(csv_number(table, row, known))) continue;
        const double value = csv_number(table, row, column);
        report_expect(value > 0, "a geometric mean of what is not positive");
        of.least = of.count == 0 ? value : fmin(of.least, value);
        of.most = of.count == 0 ? value : fmax(of.most, value);
        of.logarithms += log(value);
        ++of.count;
    }
    return of;
}

double claims_value(const csv_table *table, const char *where, const char *known,
                    const char *column) {
    const claims_mean of = claims_mean_where(table, where, known, column);
    return claims_mean_of(&of);
}

claims_spread claims_spread_where(const csv_table *table, const char *where, const char *known,
                                  const char *name) {
    char low[64], high[64];
    claims_spread spread;
    snprintf(low, sizeof low, "%s_low", name);
    snprintf(high, sizeof high, "%s_high", name);
    spread.middle = claims_value(table, where, known, name);
    spread.low = claims_value(table, where, known, low);
    spread.high = claims_value(table, where, known, high);
    return spread;
}
