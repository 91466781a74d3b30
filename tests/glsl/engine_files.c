/* SPDX-License-Identifier: MIT
 *
 * What engines share that run other programs: a folder for files, and showing a shader. */
#define _GNU_SOURCE /* nftw, mkdtemp */
#include "engine.h"

#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static char folder[256];

static int remove_one(const char *path, const struct stat *status, int kind, struct FTW *walk) {
    (void)status;
    (void)kind;
    (void)walk;
    return remove(path);
}

static void remove_folder(void) {
    nftw(folder, remove_one, 8, FTW_DEPTH | FTW_PHYS);
}

const char *engine_folder(void) {
    const char *where = getenv("TMPDIR");
    if (folder[0] != '\0') return folder;
    snprintf(folder, sizeof folder, "%s/spt_glsl_XXXXXX", where != NULL ? where : "/tmp");
    if (mkdtemp(folder) == NULL) {
        folder[0] = '\0';
        return NULL;
    }
    atexit(remove_folder);
    return folder;
}

char *engine_read_file(const char *name, size_t *size) {
    char path[512];
    size_t length = 0;
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "rb");
    if (file == NULL) return NULL;
    fseek(file, 0, SEEK_END);
    const long end = ftell(file);
    rewind(file);
    char *bytes = malloc((size_t)end + 1);
    if (bytes != NULL) {
        length = fread(bytes, 1, (size_t)end, file);
        bytes[length] = '\0';
    }
    if (size != NULL) *size = length;
    fclose(file);
    return bytes;
}

void engine_print_numbered(const char *text) {
    for (int line = 1; *text != '\0'; ++line) {
        const size_t length = strcspn(text, "\n");
        printf("%4d  %.*s\n", line, (int)length, text);
        text += length + (text[length] == '\n');
    }
}
