/* SPDX-License-Identifier: MIT
 *
 * Operates the viewer that emit writes, and the other pages, and checks that each movement does
 * what it should. Left out: whether it is beautiful, for which pictures are left behind.
 * usage: viewer_drive FOLDER TESTS..., each of them
 *     page=FILE                 the viewer, on a large screen and on a phone
 *     mean=FILE,RULE,NUMBER     its mean of evaluations a ray, at 600x400, as the library has it
 *     shot=FILE,PICTURE         only a picture of it
 *     hybrid=FILE               triangles and field
 *     depth=FILE                the same of the scene sphere
 *     three=FILE                the page of three.js; not together with others
 *     none=FILE                 the viewer where there is no WebGL; not together with others */
#include "viewer_ask.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- The viewer on a large screen ---------------------------------------------------------- */

static void try_camera(void) {
    const place middle = on("canvas", 0.5, 0.5);
    keep("first");
    browser_drag(middle.x, middle.y, middle.x + 90, middle.y + 40, "left");
    is_settled("dragged");
    keep("turned");
    check(differing("first", "turned", 2) > 0.1, "dragging does not turn");
    browser_drag(middle.x + 90, middle.y + 40, middle.x, middle.y, "left");
    is_settled("dragged back");
    keep("back");
    /* Angles are sums of rounded numbers: a hundredth of the pixels is far more than that moves. */
    check(differing("first", "back", 2) < 0.01, "dragging back does not turn back: %g",
          differing("first", "back", 2));
    const double distance = number("orbit.distance");
    browser_wheel(middle.x, middle.y, -240);
    is_settled("wheel");
    keep("near");
    check(number("orbit.distance") < 0.8 * distance, "the wheel does not come nearer");
    check(differing("first", "near", 2) > 0.1, "the wheel changes no picture");
    browser_wheel(middle.x, middle.y, 240);
    is_settled("wheel back");
    check(fabs(number("orbit.distance") / distance - 1) < 1e-9, "the wheel is not even");
    browser_drag(middle.x, middle.y, middle.x + 60, middle.y, "right");
    is_settled("moved");
    check(number("Math.hypot(...add(orbit.target, data.camera.target, -1))") > 0.02 * distance,
          "the right button does not move");
    const double azimuth = number("orbit.azimuth");
    text("canvas.focus()");
    browser_key("ArrowRight", 39);
    is_settled("arrow");
    check(fabs(number("orbit.azimuth") - azimuth) > 0.05, "the arrow does not turn");
    press("reset");
    keep("back");
    check(differing("first", "back", 0) == 0, "a reset is not the first picture: %g",
          differing("first", "back", 0));
}

/* Every step rule that the page has, against the first. */
static void try_methods(void) {
    const int count = (int)number("data.methods.length");
    check(count >= 5, "%d step rules", count);
    choose("view", "Outcome");
    check(strangers("OUTCOMES.map(one => one[1])") == 0, "outcomes have other colours");
    for (int i = 0; i < count; ++i) {
        char label[64];
        snprintf(label, sizeof label, "%s",
                 text("document.getElementById('method-%d').nextSibling.textContent", i));
        choose("method", label);
        choose("view", "Outcome");
        keep(i == 0 ? "outcomes" : "others");
        if (i > 0) {
            const double share = differing("outcomes", "others", 2);
            /* Rays that graze within the tolerance may end on either side. */
            check(share < 0.003, "%s: %g of the outcomes are not those of the first rule", label,
                  share);
        }
        choose("view", "Evaluations");
        keep(i == 0 ? "evaluations" : "others");
        check(i == 0 || differing("evaluations", "others", 2) > 0.05,
              "%s takes the evaluations of the first rule", label);
    }
}

/* All sliders of the step rule, by the keyboard. */
static void try_every_slider(void) {
    const int sliders = (int)number("document.querySelectorAll('#tracing input').length");
    check(sliders >= 4, "%d sliders", sliders);
    for (int i = 0; i < sliders; ++i) {
        char before[1024];
        text("document.querySelectorAll('#tracing input')[%d].focus()", i);
        snprintf(before, sizeof before, "%s", text("JSON.stringify(state)"));
        browser_key("ArrowLeft", 37);
        is_settled("slider");
        check(strcmp(before, text("JSON.stringify(state)")) != 0, "slider %d does nothing", i);
    }
    press("reset");
}

static void try_sliders(void) {
    choose("method", "adaptive");
    choose("view", "Evaluations");
    check(number("probe.height('legend')") > 30, "no legend");
    check(strangers("Array.from({length: state.budget + 1}, (_, n) => heat(n / state.budget))") ==
              0,
          "the shader's palette is not that of the legend");
    keep("evaluations");
    press_at("slider-budget", 0.25);
    const double budget = number("state.budget");
    check(budget > 8 && budget < 40, "the budget is %g", budget);
    check(number("document.querySelector('.ticks span:last-child').textContent") == budget,
          "the legend does not end with the budget");
    keep("others");
    check(differing("evaluations", "others", 2) > 0.5, "the budget changes no picture");
    choose("view", "Outcome");
    check(strangers("[OUTCOMES[0][1], OUTCOMES[1][1]]") > 0.001, "a small budget is always enough");
    press("reset");
    check(number("state.budget") == number("data.values.budget"), "no reset");
    choose("view", "Evaluations");
    keep("others");
    check(differing("evaluations", "others", 0) == 0, "a reset is not the first picture");
    try_every_slider();
    choose("view", "Residual");
    keep("residual");
    check(differing("residual", "evaluations", 2) > 0.5, "residuals are evaluations");
    choose("view", "Normals");
    keep("normals");
    check(differing("residual", "normals", 2) > 0.5, "normals are residuals");
    choose("view", "Picture");
    text("document.getElementById('light').open = true");
    press_at("slider-azimuth", 0.9);
    keep("others");
    check(differing("first", "others", 2) > 0.1, "the light does not move");
    press("reset");
}

/* What goes wrong at others' places. */
static void try_failures(void) {
    text("window.loser = painter.gl.getExtension('WEBGL_lose_context')");
    text("(document.documentElement.dataset.state = '', loser.loseContext())");
    text("new Promise(resolve => setTimeout(resolve, 100))");
    text("loser.restoreContext()");
    is_settled("a lost context");
    keep("back");
    check(differing("first", "back", 0) == 0, "a lost context is not the first picture");
    text("data.methods[0].pieces = [data.text.replace('void main', 'void oops main')]");
    text("(made.clear(), choose(0))");
    check(strcmp(text("probe.settled()"), "failed") == 0, "a broken shader is not noticed");
    check(number("probe.height('failure')") > 100, "no message");
    check(strstr(text("probe.text('failure-log')"), "oops") != NULL,
          "the log does not show the line that is wrong");
}

static void try_page(const char *file) {
    browser_screen(400 + 340, 300, 1, 0);
    browser_scheme("dark");
    if (!load(file)) return;
    check(strstr(text("probe.text('engine')"), "SwiftShader") != NULL, "on another engine");
    check(number("probe.text('source-text').split('\\n').length") > 50, "the shader is not shown");
    press("smooth"); /* off: four samples a pixel take their time */
    try_camera();
    try_methods();
    try_sliders();
    no_complaints(file); /* before some are provoked */
    try_failures();
}

/* ---- The others ---------------------------------------------------------------------------- */

static void try_phone(const char *file) {
    browser_screen(390, 844, 2, 1);
    browser_scheme("light");
    if (!load(file)) return;
    screenshot("phone");
    check(number("document.documentElement.scrollWidth") <= 390, "wider than the screen");
    check(number("document.getElementById('panel').scrollWidth -"
                 " document.getElementById('panel').clientWidth") == 0,
          "the panel is wider than the screen");
    check(number("Math.min(...[...document.querySelectorAll('button, summary, .choice label,"
                 " .check')].map(e => e.offsetHeight))") >= 40,
          "something is too small for fingers");
    check(number("Math.min(...[...document.querySelectorAll('body *')].filter(e =>"
                 " e.offsetParent && e.childNodes.length === 1 && e.firstChild.nodeType === 3"
                 " && e.id !== 'source-text')"
                 ".map(e => parseFloat(getComputedStyle(e).fontSize)))") >= 13,
          "letters are too small");
    check(number("[...document.querySelectorAll('.choice span')].filter(e =>"
                 " e.scrollWidth > e.clientWidth + 1).length") == 0,
          "a label does not fit");
    const place middle = on("canvas", 0.5, 0.5);
    const browser_finger one = {middle.x - 60, middle.y, middle.x + 60, middle.y};
    const browser_finger two[2] = {{middle.x - 30, middle.y, middle.x - 90, middle.y},
                                   {middle.x + 30, middle.y, middle.x + 90, middle.y}};
    const double azimuth = number("orbit.azimuth");
    const double distance = number("orbit.distance");
    browser_touch(&one, 1);
    is_settled("a finger");
    check(fabs(number("orbit.azimuth") - azimuth) > 0.3, "a finger does not turn");
    browser_touch(two, 2);
    is_settled("two fingers");
    check(fabs(number("orbit.distance") / distance - 1.0 / 3) < 0.01,
          "two fingers that part threefold come to %g of the distance",
          number("orbit.distance") / distance);
    choose("view", "Evaluations");
    screenshot("phone_evaluations");
    no_complaints(file);
}

/* For pages of triangles and field. */
static const char layers[] =
    "(window.layers = () => {" /* numbers of pixels: see below */
    "  const shot = parts => {"
    "    paint(parts);"
    "    const pixels = new Uint32Array(canvas.width * canvas.height);"
    "    gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE,"
    "                  new Uint8Array(pixels.buffer));"
    "    return pixels;"
    "  };"
    "  const none = shot([]), field = shot(['field']), mesh = shot(['triangles']);"
    "  const one = shot(['triangles', 'field']), other = shot(['field', 'triangles']);"
    "  const count = odd => one.reduce((n, _, i) => n + odd(i), 0);"
    "  const both = i => mesh[i] !== none[i] && field[i] !== none[i] && field[i] !== mesh[i];"
    "  return [count(i => one[i] !== other[i]),"
    "          count(i => one[i] !== field[i] && one[i] !== mesh[i]),"
    "          count(i => both(i) && one[i] === mesh[i]),"
    "          count(i => both(i) && one[i] === field[i])].join(' ');"
    "},"
    "window.ball = radius => {" /* instead of the mesh, of as many corners */
    "  const at = (i, j) => {"
    "    const u = 2 * Math.PI * i / 100, v = Math.PI * j / 40;"
    "    const n = [Math.sin(v) * Math.cos(u), Math.cos(v), Math.sin(v) * Math.sin(u)];"
    "    return [...n.map(c => radius * c), ...n];"
    "  };"
    "  const numbers = [];"
    "  for (let i = 0; i < 100; ++i)"
    "    for (let j = 0; j < 40; ++j)"
    "      for (const [k, l] of [[0, 0], [1, 0], [1, 1], [0, 0], [1, 1], [0, 1]])"
    "        numbers.push(...at(i + k, j + l));"
    "  gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(numbers), gl.STATIC_DRAW);"
    "}, 0)";

typedef struct layer_counts {
    int order;          /* pixels that depend on the order of drawing */
    int neither;        /* that are of neither field nor mesh */
    int before, behind; /* the field, where the mesh is seen, or is not */
} layer_counts;

static layer_counts count_layers(void) {
    layer_counts counts = {-1, -1, -1, -1};
    const char *const words = text("layers()");
    check(sscanf(words, "%d %d %d %d", &counts.order, &counts.neither, &counts.before,
                 &counts.behind) == 4,
          "'%s'", words);
    check(counts.order == 0, "the order of drawing makes a difference to %d pixels", counts.order);
    check(counts.neither == 0, "%d pixels are neither field nor mesh", counts.neither);
    return counts;
}

static void try_hybrid(const char *file) {
    browser_screen(360, 240, 1, 0);
    browser_scheme("dark");
    if (!load(file)) return;
    browser_text(layers);
    const layer_counts counts = count_layers();
    check(counts.before > 100 && counts.behind > 100,
          "the mesh is before %d and behind %d pixels of the field", counts.before, counts.behind);
    screenshot("hybrid");
    no_complaints(file);
}

/* The field is a ball of radius 1, its hits lie up to half a pixel before it: half a hundredth. A
 * mesh two hundredths larger is all that is seen, one so much smaller is never seen. */
static void try_depth(const char *file) {
    browser_screen(360, 240, 1, 0);
    if (!load(file)) return;
    browser_text(layers);
    text("ball(1.02)");
    const layer_counts large = count_layers();
    check(large.before > 5000 && large.behind == 0, "a larger ball: %d pixels before, %d behind",
          large.before, large.behind);
    text("ball(0.98)");
    const layer_counts small = count_layers();
    check(small.before == 0 && small.behind > 5000, "a smaller ball: %d pixels before, %d behind",
          small.before, small.behind);
    no_complaints(file);
}

/* Beside three.module.js. */
static void try_three(const char *file) {
    browser_screen(360, 240, 1, 0);
    browser_scheme("dark");
    if (!load(file)) return;
    printf("%s\n", text("'three.js: ' + (window.__THREE__ || 'of an unknown revision')"));
    screenshot("three");
    no_complaints(file);
}

/* Reads "FILE,WORD,WORD". */
static int split(const char *value, char parts[3][512]) {
    int count = 0;
    for (;; ++value, ++count) {
        const size_t length = strcspn(value, ",");
        if (count == 3 || length >= 512) return 0;
        memcpy(parts[count], value, length);
        parts[count][length] = '\0';
        value += length;
        if (*value == '\0') return count + 1;
    }
}

/* The same rays as the library's: evaluations differ by rounding of the camera only. */
static void try_mean(const char *value) {
    char parts[3][512];
    double mean = 0;
    check(split(value, parts) == 3, "mean wants three words");
    browser_screen(600 + 340, 400, 1, 0);
    if (!load(parts[0])) return;
    choose("method", parts[1]);
    choose("view", "Evaluations");
    const char *const title = text("probe.text('legend-title')");
    check(sscanf(title, "Evaluations a ray: %lf", &mean) == 1, "the legend says '%s'", title);
    const double library = strtod(parts[2], NULL);
    check(fabs(mean - library) < 0.0051 + 0.001 * library,
          "%s: %g evaluations a ray, the library %g", parts[1], mean, library);
    printf("%s: %.2f evaluations a ray, the library %.2f\n", parts[1], mean, library);
}

static void try_shot(const char *value) {
    char parts[3][512];
    check(split(value, parts) == 2, "shot wants two words");
    browser_screen(960, 560, 1, 0);
    browser_scheme("dark");
    if (!load(parts[0])) return;
    screenshot(parts[1]);
    no_complaints(parts[0]);
}

static void try_none(const char *file) {
    load_failing(file);
    check(strstr(text("document.getElementById('failure').innerText"), "WebGL 2") != NULL,
          "no message that WebGL 2 is missing");
    check(number("probe.height('failure')") > 100, "the message is not seen");
    screenshot("no_webgl");
}

int main(int count, char **arguments) {
    if (count < 3) return 2;
    folder = arguments[1];
    /* Modules are loaded from a file only by a browser that is told to. */
    const char *flag = NULL;
    if (strncmp(arguments[2], "none=", 5) == 0) flag = "--disable-3d-apis";
    if (strncmp(arguments[2], "three=", 6) == 0) flag = "--allow-file-access-from-files";
    const int opened = browser_open(folder, flag);
    if (opened != 0) {
        printf("viewer_drive: %s\n", opened == BROWSER_MISSING ? "no chromium" : "no answer");
        return opened;
    }
    for (int i = 2; i < count; ++i) {
        const char *const value = strchr(arguments[i], '=') + 1;
        if (strncmp(arguments[i], "page=", 5) == 0) {
            try_page(value);
            try_phone(value);
        } else if (strncmp(arguments[i], "mean=", 5) == 0) {
            try_mean(value);
        } else if (strncmp(arguments[i], "shot=", 5) == 0) {
            try_shot(value);
        } else if (strncmp(arguments[i], "hybrid=", 7) == 0) {
            try_hybrid(value);
        } else if (strncmp(arguments[i], "depth=", 6) == 0) {
            try_depth(value);
        } else if (strncmp(arguments[i], "three=", 6) == 0) {
            try_three(value);
        } else if (strncmp(arguments[i], "none=", 5) == 0) {
            try_none(value);
        } else {
            check(0, "what is %s?", arguments[i]);
        }
    }
    browser_close();
    printf("%d checks, %d failed\n", checks, failures);
    return failures != 0;
}
