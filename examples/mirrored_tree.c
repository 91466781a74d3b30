/* SPDX-License-Identifier: MIT
 *
 * The idea introduced here: geometry out of mirrors. Thirteen branches and twelve mirrors make a tree
 * of 8191 branches, whose distance costs thirteen. */
#include <spheretrace/spheretrace.h>

#include <math.h>
#include <stdio.h>

enum { levels = 12, width = 72, height = 44 };

/* README: begin */
/* A branch on each level, from the trunk to the twigs. The mirror that goes on from its upper end
 * doubles all that grows there. */
static spt_status grow(spt_krs *tree) {
    spt_kernel branches[levels + 1];
    spt_mirror mirrors[levels];
    spt_krs_model model = spt_krs_model_default();
    float fork[3] = {0, 0, 0}, ahead[3] = {0.06f, 1, 0}, length = 1.3f, radius = 0.09f;
    for (int level = levels; level >= 0; --level) {
        const float turn = 2.4f * (float)level; /* the golden angle: no two forks are alike */
        const float side[3] = {cosf(turn), 0.3f, sinf(turn)};
        const float along = side[0] * ahead[0] + side[1] * ahead[1] + side[2] * ahead[2];
        float end[3], middle[3], away[3];
        for (int axis = 0; axis < 3; ++axis) away[axis] = along * ahead[axis] - side[axis];
        if (level < levels) mirrors[level] = spt_mirror_at(fork, away);
        for (int axis = 0; axis < 3; ++axis) {
            middle[axis] = fork[axis] + length * (0.49f * ahead[axis] - 0.04f * away[axis]);
            if (level < levels) ahead[axis] = 0.85f * ahead[axis] - 0.45f * away[axis];
            end[axis] = fork[axis] + length * ahead[axis];
        }
        branches[level] = spt_kernel_capsule(fork, end, middle, radius);
        const float size = sqrtf(ahead[0] * ahead[0] + ahead[1] * ahead[1] + ahead[2] * ahead[2]);
        for (int axis = 0; axis < 3; ++axis) {
            fork[axis] = end[axis];
            ahead[axis] /= size;
        }
        length *= 0.8f;
        radius *= 0.74f;
    }
    model.levels = levels;
    model.kernels = branches;
    model.mirrors = mirrors;
    return spt_krs_build(&model, tree); /* branches and mirrors are not needed any more */
}
/* README: end */

/* From which the picture is seen, for rays that are parallel. */
static void look(spt_ray *rays, float left, float bottom, float size) {
    for (int i = 0; i < width * height; ++i) {
        const float across = (float)(i % width) / width, up = 1.0f - (float)(i / width) / height;
        const spt_ray ray = {{left + size * across, bottom + size * up, 40.0f}, 0, {0, 0, -1}, 80};
        rays[i] = ray;
    }
}

int main(void) {
    static spt_krs tree;
    static spt_ray seen[width * height];
    static spt_hit found[width * height];
    static int32_t branch[width * height];
    static uint64_t mirrored[width * height];
    spt_settings settings = spt_settings_default();
    spt_krs_places places = {0};
    int hits = 0, twigs = 0, instances = 0;
    if (grow(&tree) != SPT_OK) return 1;
    const spt_field field = spt_krs_field(&tree);
    const float *const center = tree.bound.center;
    look(seen, center[0] - 3.5f, -0.1f, 7.0f);
    settings.epsilon = 0.04f; /* twigs are to be seen between the characters */
    const spt_rays rays = spt_rays_of(seen);
    const spt_hits to_hits = spt_hits_of(found);
    places.kernel.first = branch;
    places.kernel.stride = sizeof *branch;
    places.mirrors.first = mirrored;
    places.mirrors.stride = sizeof *mirrored;
    if (spt_trace(&field, &settings, width * height, &rays, &to_hits, NULL) != SPT_OK ||
        spt_krs_locate(&tree, 0, &settings, width * height, &rays, &to_hits, &places) != SPT_OK) {
        return 1;
    }
    for (int i = 0; i < width * height; ++i) {
        const int hit = found[i].outcome == SPT_HIT;
        const char *const shades = "'.:-=+*o#%@@@"; /* from twig to trunk */
        putchar(hit ? shades[branch[i]] : ' ');
        if (i % width == width - 1) putchar('\n');
        if (!hit) continue;
        hits += 1;
        twigs += branch[i] < 4;
        instances += i == 0 || branch[i] != branch[i - 1] || mirrored[i] != mirrored[i - 1];
    }
    printf("%.0f branches; %d rays met %d times another one, %d of them twigs\n",
           spt_krs_instances(levels), hits, instances, twigs);
    return spt_krs_instances(levels) == 8191.0 && hits > 700 && twigs > 500 && instances > 600 ? 0
                                                                                               : 1;
}
