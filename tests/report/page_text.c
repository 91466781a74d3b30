/* SPDX-License-Identifier: MIT
 *
 * Escapes, the few signs that text on the page knows, and how numbers are shown. */
#include "page_text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *escape_of(char letter) {
    switch (letter) {
    case '&':
        return "&amp;";
    case '<':
        return "&lt;";
    case '>':
        return "&gt;";
    case '"':
        return "&quot;";
    default:
        return NULL;
    }
}

static void escape_range(FILE *html, const char *from, const char *to) {
    for (; from < to; ++from) {
        const char *const escape = escape_of(*from);
        if (escape != NULL) {
            fputs(escape, html);
        } else {
            fputc(*from, html);
        }
    }
}

void page_escape(FILE *html, const char *text) {
    escape_range(html, text, text + strlen(text));
}

static int is_digit(char letter) {
    return letter >= '0' && letter <= '9';
}

/* Of ASCII; all bytes of other letters count, too. */
static int is_word(char letter) {
    return is_digit(letter) || (letter >= 'a' && letter <= 'z') ||
           (letter >= 'A' && letter <= 'Z') || (unsigned char)letter >= 0x80;
}

/* The sign that closes the one at `open`, or NULL if that is none: no word before it, no space
 * behind it, no space before its end (so that 2 * 3 and a*b are what they are). */
static const char *closing(const char *start, const char *open, const char *end) {
    const char sign = *open;
    if (open + 1 >= end || open[1] == ' ' || open[1] == sign) return NULL;
    if (sign != '`' && open > start && is_word(open[-1])) return NULL;
    for (const char *at = open + 1; at < end; ++at) {
        if (*at != sign) continue;
        if (sign == '`' || at[-1] != ' ') return at;
    }
    return NULL;
}

static void markup_range(FILE *html, const char *start, const char *end) {
    for (const char *at = start; at < end; ++at) {
        const char *close = NULL;
        if (*at == '`' || *at == '*' || *at == '^') close = closing(start, at, end);
        if (close != NULL) {
            const char *const element = *at == '`' ? "code" : *at == '*' ? "em" : "cite";
            fprintf(html, "<%s>", element);
            if (*at == '`') {
                escape_range(html, at + 1, close);
            } else {
                markup_range(html, at + 1, close);
            }
            fprintf(html, "</%s>", element);
            at = close;
        } else if (*at == '^' && at > start && is_digit(at[-1])) {
            const char *power = at + 1;
            if (power < end && *power == '-') ++power;
            while (power < end && is_digit(*power)) ++power;
            fputs("<sup>", html);
            escape_range(html, at + 1, power);
            fputs("</sup>", html);
            at = power - 1;
        } else {
            escape_range(html, at, at + 1);
        }
    }
}

void page_markup(FILE *html, const char *text) {
    markup_range(html, text, text + strlen(text));
}

void page_markup_format(FILE *html, const char *format, va_list arguments) {
    va_list again;
    va_copy(again, arguments);
    const int length = vsnprintf(NULL, 0, format, again);
    va_end(again);
    char *const text = length < 0 ? NULL : malloc((size_t)length + 1);
    if (text == NULL) {
        fprintf(stderr, "page: cannot format %s\n", format);
        exit(1);
    }
    vsnprintf(text, (size_t)length + 1, format, arguments);
    page_markup(html, text);
    free(text);
}

/* One conversion of a double, no other. */
static int is_format(const char *format) {
    int conversions = 0;
    for (const char *at = format; *at != '\0'; ++at) {
        if (*at != '%') continue;
        if (at[1] == '%') {
            ++at;
            continue;
        }
        at += 1 + strspn(at + 1, "+-#0 .123456789");
        if (*at == '\0' || strchr("efg", *at) == NULL) return 0;
        ++conversions;
    }
    return conversions == 1;
}

static const char *const minus = "−", *const narrow_space = "\u202f";

void page_rounded(FILE *html, const char *format, double number) {
    char text[128];
    if (!is_format(format)) {
        fprintf(stderr, "page: a number cannot be shown as %s\n", format);
        exit(1);
    }
    if (isinf(number)) {
        fprintf(html, "%s∞", number < 0 ? minus : "");
        return;
    }
    snprintf(text, sizeof text, format, number);
    const char *at = text;
    for (; *at != '\0' && !is_digit(*at); ++at) {
        if (*at == '-' && is_digit(at[1])) {
            fputs(minus, html);
        } else {
            escape_range(html, at, at + 1);
        }
    }
    const int whole = (int)strspn(at, "0123456789");
    for (int i = 0; i < whole; ++i) {
        if (i > 0 && whole > 4 && (whole - i) % 3 == 0) fputs(narrow_space, html);
        fputc(*at++, html);
    }
    if (*at == '.') fputc(*at++, html);
    while (is_digit(*at)) fputc(*at++, html);
    if (*at == 'e' && (at[1] == '+' || at[1] == '-')) {
        fputc('e', html);
        if (at[1] == '-') fputs(minus, html);
        at += 2;
        while (*at == '0' && is_digit(at[1])) ++at;
        while (is_digit(*at)) fputc(*at++, html);
    }
    page_escape(html, at);
}
