/* SPDX-License-Identifier: MIT
 *
 * JavaScript that is brought into the page, and C that calls it. */
#include "viewer_ask.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

const char *folder;
int checks, failures;

void check(int good, const char *format, ...) {
    va_list arguments;
    ++checks;
    if (good) return;
    ++failures;
    va_start(arguments, format);
    fputs("viewer_drive: ", stdout);
    vprintf(format, arguments);
    putchar('\n');
    va_end(arguments);
}

/* ---- What is asked of the page ------------------------------------------------------------- */

/* Brought into the page. `painter.full` is the picture of one sample a pixel (viewer_draw.js). */
static const char probe[] =
    "(window.kept = {}, window.probe = {"
    "  settled: () => new Promise(resolve => {" /* what became of the picture */
    "    const end = performance.now() + 60000;"
    "    const look = () => {"
    "      const state = document.documentElement.dataset.state;"
    "      if (state === 'drawn' || state === 'failed') resolve(state);"
    "      else if (performance.now() > end) resolve('late');"
    "      else setTimeout(look, 10);"
    "    };"
    "    look();"
    "  }),"
    "  keep: name => { kept[name] = painter.pixels(painter.full); },"
    "  share: (a, odd) => {" /* of the pixels of a picture, those that are odd */
    "    let n = 0;"
    "    for (let i = 0; i < a.length; i += 4) n += odd(i);"
    "    return 4 * n / a.length;"
    "  },"
    "  differing: (a, b, levels) => a.length !== b.length ? 1 : probe.share(a, i =>"
    "    [0, 1, 2].some(k => Math.abs(a[i + k] - b[i + k]) > levels)),"
    "  strangers: colours => {" /* the share of pixels that have none of these colours */
    "    const a = painter.pixels(painter.full);"
    "    const near = (c, i) => c.every((v, k) => Math.abs(255 * v - a[i + k]) < 2);"
    "    return probe.share(a, i => !colours.some(c => near(c, i)));"
    "  },"
    "  place: (id, across, down) => {"
    "    const element = document.getElementById(id);"
    "    element.scrollIntoView({block: 'nearest'});"
    "    const {left, top, width, height} = element.getBoundingClientRect();"
    "    return (left + across * width) + ' ' + (top + down * height);"
    "  },"
    "  choice: (name, label) => [...document.getElementsByName(name)]"
    "    .find(e => e.nextSibling.textContent === label).id,"
    "  height: id => document.getElementById(id).offsetHeight,"
    "  text: id => document.getElementById(id).textContent"
    "}, 0)";

double number(const char *format, ...) {
    static char expression[2048];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(expression, sizeof expression, format, arguments);
    va_end(arguments);
    return browser_number(expression);
}

const char *text(const char *format, ...) {
    static char expression[2048];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(expression, sizeof expression, format, arguments);
    va_end(arguments);
    return browser_text(expression);
}

int is_settled(const char *after) {
    const char *const state = text("probe.settled()");
    const int good = strcmp(state, "drawn") == 0;
    check(good, "%s: %s", after, state);
    return good;
}

void keep(const char *name) {
    text("probe.keep('%s')", name);
}

double differing(const char *one, const char *other, int levels) {
    return number("probe.differing(kept.%s, kept.%s, %d)", one, other, levels);
}

double strangers(const char *colours) {
    return number("probe.strangers(%s)", colours);
}

place on(const char *id, double across, double down) {
    place at = {0, 0};
    const char *const words = text("probe.place('%s', %g, %g)", id, across, down);
    check(sscanf(words, "%lf %lf", &at.x, &at.y) == 2, "no element %s", id);
    return at;
}

void press_at(const char *id, double across) {
    const place at = on(id, across, 0.5);
    browser_click(at.x, at.y);
    is_settled(id);
}

void press(const char *id) {
    press_at(id, 0.5);
}

void choose(const char *name, const char *label) {
    char id[64];
    snprintf(id, sizeof id, "%s", text("probe.choice('%s', '%s')", name, label));
    press(id);
    check(number("document.getElementById('%s').checked ? 1 : 0", id) == 1, "'%s' is not chosen",
          label);
}

void screenshot(const char *name) {
    char path[512];
    snprintf(path, sizeof path, "%s/%s.png", folder, name);
    check(browser_screenshot(path), "no picture %s", path);
}

int load(const char *file) {
    char url[600];
    snprintf(url, sizeof url, "file://%s", file);
    check(browser_go(url), "%s does not load", file);
    browser_text(probe);
    return is_settled(file);
}

void no_complaints(const char *file) {
    const int complaints = browser_complaints();
    check(complaints == 0, "%s: %d complaints", file, complaints);
}

void load_failing(const char *file) {
    char url[600];
    snprintf(url, sizeof url, "file://%s", file);
    check(browser_go(url), "%s does not load", file);
    browser_text(probe);
    check(strcmp(text("probe.settled()"), "failed") == 0, "%s does not notice", file);
}
