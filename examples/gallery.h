/* SPDX-License-Identifier: MIT
 *
 * The pictures of the gallery: which scene, which kind, how traced, side by side. */
#ifndef EXAMPLES_GALLERY_H
#define EXAMPLES_GALLERY_H

/* Renders every picture into the folder, which is created if need be, each panel width x height
 * and the large ones, if wanted, 1920 x 1080. Prints a line for each and the folder at the end.
 * Returns the program's exit status. */
int gallery_render(const char *folder, int width, int height, int samples, int threads, int large);

#endif
