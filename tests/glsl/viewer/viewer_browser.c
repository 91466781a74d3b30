/* SPDX-License-Identifier: MIT
 *
 * Messages are JSON with a zero behind each, on the browser's file descriptors 3 and 4. What is
 * read of them is so little that it is found by its name. */
#define _POSIX_C_SOURCE 200809L
#include "viewer_browser.h"

#include <math.h>
#include <poll.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { patience = 90000 }; /* milliseconds for an answer */

static struct {
    pid_t process;
    int to, from;
    int last;          /* number of the last call */
    char session[128]; /* of the page */
    char *message;     /* the last that came */
    size_t room, length, rest;
    char page[1024]; /* its address */
    int loaded, complaints, is_phone;
    char *text;
} browser;

/* ---- Messages ------------------------------------------------------------------------------ */

/* The next message into browser.message; 0 if none came in time or the browser is gone. */
static int receive(void) {
    memmove(browser.message, browser.message + browser.length, browser.rest);
    browser.length = 0;
    for (size_t seen = 0;;) {
        char *const end =
            browser.rest > seen ? memchr(browser.message + seen, '\0', browser.rest - seen) : NULL;
        if (end != NULL) {
            browser.length = (size_t)(end - browser.message) + 1;
            browser.rest -= browser.length;
            return 1;
        }
        seen = browser.rest;
        if (browser.room - browser.rest < 65536) {
            char *const more = realloc(browser.message, 2 * browser.room + 65536);
            if (more == NULL) return 0;
            browser.message = more;
            browser.room = 2 * browser.room + 65536;
        }
        struct pollfd wait = {browser.from, POLLIN, 0};
        if (poll(&wait, 1, patience) <= 0) return 0;
        const ssize_t got =
            read(browser.from, browser.message + browser.rest, browser.room - browser.rest);
        if (got <= 0) return 0;
        browser.rest += (size_t)got;
    }
}

/* Where the value of the first member of that name in a message begins, or NULL. */
static const char *member(const char *message, const char *name) {
    char quoted[64];
    snprintf(quoted, sizeof quoted, "\"%s\":", name);
    const char *const at = strstr(message, quoted);
    return at != NULL ? at + strlen(quoted) : NULL;
}

static int event_is(const char *method) {
    const char *const at = strstr(browser.message, "\"method\":\"");
    return at != NULL && strncmp(at + 10, method, strlen(method)) == 0;
}

/* Takes note of what was not asked for. */
static void notice(void) {
    const char *const url = member(browser.message, "url");
    if (event_is("Page.loadEventFired")) browser.loaded = 1;
    const int stranger = event_is("Network.requestWillBeSent") && url != NULL &&
                         strncmp(url + 1, browser.page, strlen(browser.page)) != 0 &&
                         strncmp(url + 1, "data:", 5) != 0 &&
                         strstr(browser.message, "/three.") == NULL; /* what it is there for */
    const int error =
        event_is("Log.entryAdded") && strstr(browser.message, "\"level\":\"error\"") != NULL;
    if (stranger || error || event_is("Runtime.exceptionThrown")) {
        printf("the page complains: %.600s\n", browser.message);
        ++browser.complaints;
    }
}

/* Calls a method, of the page or, before there is one, of the browser, and waits for the answer,
 * which is then the message. Returns 0 where none came or it is an error. */
static int call(const char *method, const char *format, ...) {
    static char parameters[65536];
    static char request[66048];
    char answer[32];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(parameters, sizeof parameters, format, arguments);
    va_end(arguments);
    const int length =
        snprintf(request, sizeof request, "{\"id\":%d,%s%s%s\"method\":\"%s\",\"params\":{%s}}",
                 ++browser.last, browser.session[0] != '\0' ? "\"sessionId\":\"" : "",
                 browser.session, browser.session[0] != '\0' ? "\"," : "", method, parameters);
    if (length < 0 || (size_t)length >= sizeof request) return 0;
    for (size_t sent = 0; sent <= (size_t)length;) { /* with the zero */
        const ssize_t part = write(browser.to, request + sent, (size_t)length + 1 - sent);
        if (part <= 0) return 0;
        sent += (size_t)part;
    }
    snprintf(answer, sizeof answer, "{\"id\":%d,", browser.last);
    while (receive()) {
        if (strncmp(browser.message, answer, strlen(answer)) == 0) {
            if (strncmp(browser.message + strlen(answer), "\"error\"", 7) != 0) return 1;
            printf("%s: %s\n", method, browser.message);
            return 0;
        }
        notice();
    }
    printf("%s: the browser does not answer\n", method);
    return 0;
}

/* ---- The browser --------------------------------------------------------------------------- */

/* The process that becomes the browser. Does not return. */
static void become(const char *folder, const char *flag, const int to[2], const int from[2]) {
    char profile[512], angle[64];
    const char *const engine = getenv("VIEWER_ANGLE");
    snprintf(profile, sizeof profile, "--user-data-dir=%s/profile", folder);
    snprintf(angle, sizeof angle, "--use-angle=%s", engine != NULL ? engine : "swiftshader");
    dup2(to[0], 3); /* the lowest of the four already */
    dup2(from[1], 4);
    if (freopen("/dev/null", "r", stdin) == NULL || freopen("/dev/null", "w", stdout) == NULL ||
        freopen("/dev/null", "w", stderr) == NULL) {
        _exit(126);
    }
    execlp("chromium", "chromium", "--headless", "--no-sandbox", "--remote-debugging-pipe",
           "--disable-quic", "--no-first-run", "--disable-background-networking",
           "--disable-component-update", "--disable-sync", "--disable-gpu-watchdog",
           "--hide-scrollbars", "--use-gl=angle", angle, "--enable-unsafe-swiftshader",
           "--ignore-gpu-blocklist", profile, flag != NULL ? flag : "--no-pings", "about:blank",
           (char *)NULL);
    _exit(127);
}

/* Copies the string that is the value of a member. */
static int copy_member(const char *message, const char *name, char *copy, size_t size) {
    const char *const at = member(message, name);
    const size_t length = at != NULL && *at == '"' ? strcspn(at + 1, "\"") : 0;
    if (length == 0 || length >= size) return 0;
    memcpy(copy, at + 1, length);
    copy[length] = '\0';
    return 1;
}

/* Turns to the page that the browser has opened, and listens to it. */
static int attach(void) {
    char target[128];
    if (!call("Target.getTargets", "%s", "")) return 0;
    const char *info = browser.message;
    for (;;) { /* the target whose type is "page" */
        info = member(info, "targetId");
        if (info == NULL) return 0;
        const char *const type = member(info, "type");
        if (type != NULL && strncmp(type, "\"page\"", 6) == 0) break;
    }
    snprintf(target, sizeof target, "%.*s", (int)strcspn(info + 1, "\""), info + 1);
    if (!call("Target.attachToTarget", "\"targetId\":\"%s\",\"flatten\":true", target) ||
        !copy_member(browser.message, "sessionId", browser.session, sizeof browser.session)) {
        return 0;
    }
    return call("Page.enable", "%s", "") && call("Runtime.enable", "%s", "") &&
           call("Log.enable", "%s", "") && call("Network.enable", "%s", "");
}

int browser_open(const char *folder, const char *flag) {
    int to[2], from[2], status = 0;
    memset(&browser, 0, sizeof browser);
    browser.room = 1 << 20;
    browser.message = malloc(browser.room);
    browser.text = malloc(1);
    if (browser.message == NULL || browser.text == NULL || pipe(to) != 0 || pipe(from) != 0) {
        return 1;
    }
    signal(SIGPIPE, SIG_IGN);
    browser.process = fork();
    if (browser.process == 0) become(folder, flag, to, from);
    close(to[0]);
    close(from[1]);
    browser.to = to[1];
    browser.from = from[0];
    if (browser.process > 0 && attach()) return 0;
    const int gone = browser.process > 0 && waitpid(browser.process, &status, WNOHANG) > 0;
    if (gone) browser.process = 0;
    browser_close();
    return gone && WIFEXITED(status) && WEXITSTATUS(status) == 127 ? BROWSER_MISSING : 1;
}

void browser_close(void) {
    if (browser.process > 0) {
        browser.session[0] = '\0';
        call("Browser.close", "%s", "");
        while (receive()) continue; /* until it has closed its end */
        kill(browser.process, SIGTERM);
        waitpid(browser.process, NULL, 0);
    }
    close(browser.to);
    close(browser.from);
    free(browser.message);
    free(browser.text);
    memset(&browser, 0, sizeof browser);
}

void browser_screen(int width, int height, int density, int is_phone) {
    browser.is_phone = is_phone;
    call("Emulation.setDeviceMetricsOverride",
         "\"width\":%d,\"height\":%d,\"deviceScaleFactor\":%d,\"mobile\":%s", width, height,
         density, is_phone ? "true" : "false");
    call("Emulation.setTouchEmulationEnabled", "\"enabled\":%s,\"maxTouchPoints\":5",
         is_phone ? "true" : "false");
}

void browser_scheme(const char *scheme) {
    call("Emulation.setEmulatedMedia",
         "\"features\":[{\"name\":\"prefers-color-scheme\",\"value\":\"%s\"}]", scheme);
}

int browser_go(const char *url) {
    snprintf(browser.page, sizeof browser.page, "%s", url);
    browser.loaded = browser.complaints = 0;
    if (!call("Page.navigate", "\"url\":\"%s\"", url)) return 0;
    while (!browser.loaded && receive()) notice();
    return browser.loaded;
}

int browser_complaints(void) {
    return browser.complaints;
}

/* ---- JavaScript ---------------------------------------------------------------------------- */

/* Undoes the escapes of a string of JSON that begins behind its quote; ASCII is all that is asked
 * for, anything else becomes a question mark. */
static void unescape(const char *from, char *to) {
    for (; *from != '"' && *from != '\0'; ++from) {
        unsigned code;
        if (*from != '\\') {
            *to++ = *from;
        } else if (*++from == 'u' && sscanf(from + 1, "%4x", &code) == 1) {
            *to++ = code < 128 ? (char)code : '?';
            from += 4;
        } else {
            *to++ = *from == 'n' ? '\n' : *from == 't' ? '\t' : *from;
        }
    }
    *to = '\0';
}

const char *browser_text(const char *expression) {
    static char escaped[32768];
    size_t length = 0;
    for (; *expression != '\0' && length < sizeof escaped - 2; ++expression) {
        if (*expression == '"' || *expression == '\\') escaped[length++] = '\\';
        escaped[length++] = *expression == '\n' ? ' ' : *expression;
    }
    escaped[length] = '\0';
    free(browser.text);
    browser.text = NULL;
    const int good = call("Runtime.evaluate",
                          "\"awaitPromise\":true,\"expression\":"
                          "\"(async () => String(await (%s)))()\"",
                          escaped);
    const char *const value = good ? member(browser.message, "value") : NULL;
    if (good && (value == NULL || strstr(browser.message, "\"exceptionDetails\"") != NULL)) {
        printf("%.200s: %.600s\n", escaped, browser.message);
    } else if (good && *value == '"') {
        browser.text = malloc(strlen(value) + 1);
        if (browser.text != NULL) unescape(value + 1, browser.text);
    }
    if (browser.text == NULL) browser.text = calloc(1, 1);
    return browser.text != NULL ? browser.text : "";
}

double browser_number(const char *expression) {
    const char *const text = browser_text(expression);
    char *end = NULL;
    const double number = strtod(text, &end);
    return end != text ? number : (double)NAN;
}

/* ---- Hands --------------------------------------------------------------------------------- */

static void mouse(const char *type, double x, double y, const char *button, int buttons) {
    call("Input.dispatchMouseEvent",
         "\"type\":\"%s\",\"x\":%.2f,\"y\":%.2f,\"button\":\"%s\",\"buttons\":%d,\"clickCount\":%d",
         type, x, y, button, buttons, strcmp(type, "mouseMoved") != 0);
}

enum { steps = 6 }; /* of a movement */

void browser_drag(double x, double y, double to_x, double to_y, const char *button) {
    const int buttons = strcmp(button, "right") == 0 ? 2 : 1;
    mouse("mouseMoved", x, y, "none", 0);
    mouse("mousePressed", x, y, button, buttons);
    for (int i = 1; i <= steps; ++i) {
        mouse("mouseMoved", x + (to_x - x) * i / steps, y + (to_y - y) * i / steps, button,
              buttons);
    }
    mouse("mouseReleased", to_x, to_y, button, 0);
}

void browser_wheel(double x, double y, double lower) {
    call("Input.dispatchMouseEvent",
         "\"type\":\"mouseWheel\",\"x\":%.2f,\"y\":%.2f,\"deltaX\":0,\"deltaY\":%.2f", x, y, lower);
}

void browser_key(const char *key, int code) {
    for (int up = 0; up <= 1; ++up) {
        call("Input.dispatchKeyEvent",
             "\"type\":\"%s\",\"key\":\"%s\",\"code\":\"%s\",\"windowsVirtualKeyCode\":%d",
             up ? "keyUp" : "keyDown", key, key, code);
    }
}

static void touch(const char *type, const browser_finger *fingers, int count, int step) {
    char points[256];
    int length = 0;
    points[0] = '\0';
    for (int i = 0; i < count && strcmp(type, "touchEnd") != 0; ++i) {
        length += snprintf(points + length, sizeof points - (size_t)length,
                           "%s{\"x\":%.2f,\"y\":%.2f,\"id\":%d}", i == 0 ? "" : ",",
                           fingers[i].x + (fingers[i].to_x - fingers[i].x) * step / steps,
                           fingers[i].y + (fingers[i].to_y - fingers[i].y) * step / steps, i);
    }
    call("Input.dispatchTouchEvent", "\"type\":\"%s\",\"touchPoints\":[%s]", type, points);
}

void browser_touch(const browser_finger *fingers, int count) {
    touch("touchStart", fingers, count, 0);
    for (int i = 1; i <= steps; ++i) touch("touchMove", fingers, count, i);
    touch("touchEnd", fingers, count, steps);
}

void browser_click(double x, double y) {
    if (browser.is_phone) {
        const browser_finger finger = {x, y, x, y};
        touch("touchStart", &finger, 1, 0);
        touch("touchEnd", &finger, 1, 0);
    } else {
        mouse("mouseMoved", x, y, "none", 0);
        mouse("mousePressed", x, y, "left", 1);
        mouse("mouseReleased", x, y, "left", 0);
    }
}

/* ---- Eyes ---------------------------------------------------------------------------------- */

int browser_screenshot(const char *path) {
    static const char letters[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    if (!call("Page.captureScreenshot", "\"format\":\"png\"")) return 0;
    const char *at = member(browser.message, "data");
    FILE *const file = at != NULL ? fopen(path, "wb") : NULL;
    if (file == NULL) return 0;
    unsigned held = 0;
    int bits = 0;
    for (++at; *at != '"' && *at != '='; ++at) {
        const char *const letter = strchr(letters, *at);
        if (letter == NULL || *at == '\0') break;
        held = held << 6 | (unsigned)(letter - letters);
        bits += 6;
        if (bits < 8) continue;
        bits -= 8;
        putc((int)(held >> bits & 255), file);
    }
    return fclose(file) == 0;
}
