/* SPDX-License-Identifier: MIT
 *
 * The palette and the legend of pictures that show numbers. The letters are in bitmap_font.h. */
#include "heat.h"

#include "bitmap_font.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

/* sRGB; lightness (CIE L*) rises in even steps, so that the picture also reads in grey. */
static const unsigned char palette[9][3] = {
    {6, 6, 24},    {38, 21, 92},   {92, 22, 123},   {151, 34, 116},  {207, 56, 86},
    {240, 98, 58}, {250, 150, 60}, {252, 206, 106}, {253, 253, 222},
};

void heat_colour(float value, float rgb[3]) {
    const float cut = value > 0.0f ? (value < 1.0f ? value : 1.0f) : 0.0f;
    const int cell = cut < 1.0f ? (int)(cut * 8.0f) : 7;
    const float weight = cut * 8.0f - (float)cell;
    for (int c = 0; c < 3; ++c) {
        /* Blended as the eye sees it, in sRGB; pictures hold linear light. */
        const float low = (float)palette[cell][c], high = (float)palette[cell + 1][c];
        rgb[c] = image_linear((low + weight * (high - low)) / 255.0f);
    }
}

void heat_fill(image *picture, int x, int y, int width, int height, const float rgb[3]) {
    for (int row = y < 0 ? 0 : y; row < y + height && row < picture->height; ++row) {
        for (int column = x < 0 ? 0 : x; column < x + width && column < picture->width; ++column) {
            memcpy(image_at(picture, column, row), rgb, 3 * sizeof(float));
        }
    }
}

int heat_text_width(const char *text) {
    return (int)strlen(text) * 6 - 1;
}

void heat_text(image *picture, int x, int y, const char *text, const float rgb[3]) {
    for (; *text != '\0'; ++text, x += 6) {
        const unsigned char *glyph = bitmap_glyph((char)toupper((unsigned char)*text));
        for (int row = 0; row < 7; ++row) {
            for (int column = 0; column < 5; ++column) {
                if (glyph[row] >> (4 - column) & 1) {
                    heat_fill(picture, x + column, y + row, 1, 1, rgb);
                }
            }
        }
    }
}

void heat_legend(image *picture, int x, int y, int width, const char *title, double largest,
                 const char *unit) {
    static const float black[3] = {0.0f, 0.0f, 0.0f}, white[3] = {0.8f, 0.8f, 0.8f};
    heat_fill(picture, x, y, width, heat_legend_height, black);
    heat_text(picture, x + 6, y + 4, title, white);
    const int first = x + 6, bar = width - 12;
    for (int i = 0; i < bar; ++i) {
        float rgb[3];
        heat_colour(((float)i + 0.5f) / (float)bar, rgb);
        heat_fill(picture, first + i, y + 14, 1, 7, rgb);
    }
    for (int i = 0; i <= 4; ++i) {
        char number[32];
        const int at = first + (bar - 1) * i / 4;
        snprintf(number, sizeof number, "%g%s", largest * i / 4.0, i == 4 ? unit : "");
        int left = at - heat_text_width(number) / 2;
        if (i == 0) left = at;
        if (i == 4) left = at - heat_text_width(number) + 1;
        heat_fill(picture, at, y + 21, 1, 3, white);
        heat_text(picture, left, y + 25, number, white);
    }
}
