/* SPDX-License-Identifier: MIT
 *
 * machine.csv: on what the report was measured. */
#define _POSIX_C_SOURCE 200809L
#include "report_run.h"

#include <string.h>
#include <sys/utsname.h>
#include <time.h>
#include <unistd.h>

static void row(FILE *file, const char *what, const char *value) {
    fprintf(file, "%s,", what);
    for (; *value != '\0'; ++value) fputc(*value == ',' || *value == '\n' ? ' ' : *value, file);
    fputc('\n', file);
}

static void processor_name(char *name, size_t size) {
    char line[256];
    FILE *const file = fopen("/proc/cpuinfo", "r");
    snprintf(name, size, "unknown");
    while (file != NULL && fgets(line, sizeof line, file) != NULL) {
        const char *const colon = strchr(line, ':');
        if (strncmp(line, "model name", 10) != 0 || colon == NULL) continue;
        snprintf(name, size, "%s", colon + 2);
        name[strcspn(name, "\n")] = '\0';
        break;
    }
    if (file != NULL) fclose(file);
}

void report_machine(const report_options *options) {
    bench_options folder = {0};
    char text[256];
    struct utsname system;
    const time_t now = time(NULL);
    folder.output = options->output;
    FILE *const file = bench_open(&folder, "machine.csv", "what,value");
    processor_name(text, sizeof text);
    row(file, "processor", text);
    snprintf(text, sizeof text, "%ld", sysconf(_SC_NPROCESSORS_ONLN));
    row(file, "cores", text);
    snprintf(text, sizeof text, "%d", spt_lanes());
    row(file, "lanes", text);
#ifdef __clang__
    row(file, "compiler", __VERSION__);
#else
    row(file, "compiler", "gcc " __VERSION__);
#endif
    snprintf(text, sizeof text, "%d", spt_version());
    row(file, "library", text);
    if (uname(&system) >= 0) {
        snprintf(text, sizeof text, "%.60s %.60s %.60s", system.sysname, system.release,
                 system.machine);
        row(file, "system", text);
    }
    row(file, "mode", options->quick ? "quick" : "full");
    strftime(text, sizeof text, "%Y-%m-%d %H:%M UTC", gmtime(&now));
    row(file, "begun", text);
    fclose(file);
}
