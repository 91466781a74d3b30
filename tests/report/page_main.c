/* SPDX-License-Identifier: MIT
 *
 * report_page FOLDER [SECTION...]
 * Draws FOLDER/index.html, all sections or those that are named, from the tables in the folder. */
#include <stdlib.h>
#include <string.h>

#include "page.h"
#include "page_text.h"

static const struct {
    const char *name;
    page_section_fn *draw;
} sections[] = {
#define SECTION(name) {#name, page_##name},
#include "page_list.h"
#undef SECTION
};
enum { section_count = sizeof sections / sizeof sections[0] };

static const char *const style[] = {
    ":root{color-scheme:light}",
    "*{box-sizing:border-box}",
    "body{margin:0;background:#fff;color:#1b1b1b;font:17px/1.5 system-ui,sans-serif;"
    "overflow-wrap:break-word}",
    "main{max-width:1120px;margin:0 auto;padding:0 20px 60px}",
    "h1{font-size:1.9em;line-height:1.2;margin:1em 0 .3em}",
    "h2{font-size:1.45em;line-height:1.25;margin:2.6em 0 .5em;padding-top:.5em;"
    "border-top:2px solid #1b1b1b}",
    "h3{font-size:1.12em;margin:2em 0 .4em}",
    "p{max-width:46em;margin:.7em 0}",
    "a{color:#0a4f86}",
    "code{font:.9em ui-monospace,monospace;background:#f1f1ee;padding:.05em .25em;"
    "border-radius:3px}",
    "cite{font-style:normal;color:#5a3a00}",
    "data{font-variant-numeric:tabular-nums}",
    "nav ol{columns:2 18em;padding-left:1.4em;max-width:46em}",
    "figure{margin:1.6em 0}",
    "figcaption{max-width:50em;font-size:.92em;line-height:1.45;margin:.5em 0}",
    ".plot svg{display:block;width:100%;height:auto}",
    ".plots{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,430px),1fr));"
    "gap:12px}",
    ".plots svg{display:block;width:100%;height:auto;max-width:680px}",
    ".small{grid-template-columns:repeat(auto-fit,minmax(min(100%,300px),1fr))}",
    ".small svg{max-width:480px}",
    ".wide{overflow-x:auto}",
    ".wide svg{min-width:560px}",
    ".picture img{display:block;max-width:100%;height:auto;image-rendering:auto}",
    ".scroll{overflow-x:auto}",
    "table{border-collapse:collapse;font-size:.88em;line-height:1.35}",
    "th,td{padding:.28em .6em;border-bottom:1px solid #ddd;text-align:left;vertical-align:top}",
    "th{border-bottom:2px solid #777;vertical-align:bottom;background:#fff}",
    "td:first-child{min-width:7em}",
    "td.number{text-align:right;white-space:nowrap}",
    "td.good{background:#e2f2ea;color:#06402a}",
    "td.bad{background:#fbe3d8;color:#7a2100;font-weight:600}",
    "td.warn{background:#fdf3d3;color:#5c4300}",
    "td.quiet{color:#6a6a6a}",
    ".source{font-size:.92em;color:#555}",
    "details{margin:1em 0;border-left:3px solid #ccc;padding-left:12px}",
    "summary{cursor:pointer;color:#0a4f86}",
    "@media(max-width:600px){body{font-size:16px}main{padding:0 10px 40px}"
    "th,td{padding:.25em .45em}}",
    "@media print{body{font-size:10.5pt}main{max-width:none;padding:0}a{color:inherit}"
    "figure,tr{break-inside:avoid}h2,h3{break-after:avoid}.scroll{overflow:visible}"
    "details::details-content{content-visibility:visible;block-size:auto}}",
};

static void head(FILE *html) {
    fputs("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
          "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
          "style-src 'unsafe-inline'; img-src data:; base-uri 'none'; form-action 'none'\">\n"
          "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
          "<title>libspheretrace: what was measured</title>\n<style>\n",
          html);
    for (size_t i = 0; i < sizeof style / sizeof style[0]; ++i) fprintf(html, "%s\n", style[i]);
    fputs("</style>\n</head>\n<body>\n<main>\n<h1>libspheretrace: what was measured</h1>\n", html);
}

static void contents(const page *drawn, FILE *html) {
    fputs("<nav><ol>\n", html);
    for (int i = 0; i < drawn->section_count; ++i) {
        fputs("<li><a href=\"#", html);
        page_escape(html, drawn->section_id[i]);
        fputs("\">", html);
        page_markup(html, drawn->section_title[i]);
        fputs("</a></li>\n", html);
    }
    fputs("</ol></nav>\n", html);
}

static int is_quick(const char *folder) {
    if (!csv_exists(folder, "machine")) return 0;
    csv_table *const machine = csv_open(folder, "machine");
    const int quick = csv_next(machine, -1, "what=mode,value=quick") >= 0;
    csv_close(machine);
    return quick;
}

static int is_wanted(const char *name, int count, char **wanted) {
    for (int i = 0; i < count; ++i) {
        if (strcmp(wanted[i], name) == 0) return 1;
    }
    return count == 0;
}

static int is_section(const char *name) {
    for (int i = 0; i < section_count; ++i) {
        if (strcmp(sections[i].name, name) == 0) return 1;
    }
    return 0;
}

/* The list at the top names what is drawn below it: first the sections, then the file. */
static int write_page(page *drawn, const char *path) {
    char block[4096];
    size_t got;
    FILE *const file = fopen(path, "wb");
    if (file == NULL) return 0;
    head(file);
    contents(drawn, file);
    rewind(drawn->html);
    while ((got = fread(block, 1, sizeof block, drawn->html)) > 0) fwrite(block, 1, got, file);
    fputs("</main>\n</body>\n</html>\n", file);
    const int written = !ferror(file) && !ferror(drawn->html);
    return fclose(file) == 0 && written;
}

int main(int argc, char **argv) {
    page drawn = {0};
    char path[1024];
    for (int i = 2; i < argc; ++i) {
        if (!is_section(argv[i])) argc = 0;
    }
    if (argc < 2) {
        fprintf(stderr, "usage: report_page FOLDER [SECTION...]\nsections:");
        for (int i = 0; i < section_count; ++i) fprintf(stderr, " %s", sections[i].name);
        fputc('\n', stderr);
        return 2;
    }
    drawn.html = tmpfile();
    drawn.tables = argv[1];
    drawn.quick = is_quick(argv[1]);
    for (int i = 0; drawn.html != NULL && i < section_count; ++i) {
        if (is_wanted(sections[i].name, argc - 2, argv + 2)) sections[i].draw(&drawn);
    }
    if (drawn.html != NULL) page_finish(&drawn);
    const int length = snprintf(path, sizeof path, "%s/index.html", argv[1]);
    if (drawn.html == NULL || length >= (int)sizeof path || !write_page(&drawn, path)) {
        fprintf(stderr, "page: cannot write %s\n", path);
        return 1;
    }
    fclose(drawn.html);
    return 0;
}
