/* SPDX-License-Identifier: MIT
 *
 * The idea introduced here: what follows a trace. The figures 7 to 10 of Keinert et al. 2014 made
 * again by the public calls, as pairs without and with over-relaxation, screen-space candidates and
 * discontinuity reduction, and the improvements measured.
 *     figures FOLDER    draws keinert_fig7.png and so on into a folder that is there
 *     figures --check   measures small pictures only */
#include "figures.h"

#include <stdio.h>
#include <string.h>

static int (*const figures[])(const figure_wish *) = {figure_7, figure_8, figure_9, figure_10};

int main(int argument_count, char **arguments) {
    figure_wish wish = {640, 360, NULL};
    int good = 1;
    if (argument_count > 2 || (argument_count == 2 && strcmp(arguments[1], "--help") == 0)) {
        fprintf(stderr, "usage: figures FOLDER | --check\n");
        return 2;
    }
    if (argument_count == 2 && strcmp(arguments[1], "--check") != 0) {
        wish.folder = arguments[1];
    } else {
        wish.width = 256;
        wish.height = 144;
    }
    for (size_t i = 0; i < sizeof figures / sizeof figures[0]; ++i) good &= figures[i](&wish);
    return !good;
}
