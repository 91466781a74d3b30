/* SPDX-License-Identifier: MIT
 *
 * The fields that scenes have from the library's own builders. */
#include "scene_krs_tree.h"
#include "scenes.h"
#include "scenes_widths.h"

/* A model for each width. */
typedef struct krs_tree {
    spt_krs krs[4];
    int ready;
} krs_tree;

/* The trunk is the last kernel. */
static void build(krs_tree *tree, uint32_t levels) {
    static const uint32_t lanes[4] = {1, 4, 8, 16};
    spt_kernel kernels[KRS_TREE_MOST + 1];
    spt_mirror mirrors[KRS_TREE_MOST];
    spt_krs_model model = spt_krs_model_default();
    krs_tree_route route;
    krs_tree_grow(&route);
    for (uint32_t j = 0; j <= levels; ++j) {
        kernels[levels - j] = spt_kernel_capsule(route.fork[j], route.fork[j + 1], route.control[j],
                                                 route.half_width[j]);
    }
    for (uint32_t j = 0; j < levels; ++j) {
        spt_mirror *const mirror = &mirrors[levels - 1 - j];
        for (int axis = 0; axis < 3; ++axis) mirror->normal[axis] = route.normal[j][axis];
        mirror->offset = route.offset[j];
    }
    model.levels = levels;
    model.kernels = kernels;
    model.mirrors = mirrors;
    for (int i = 0; i < 4; ++i) {
        model.max_lanes = lanes[i];
        if (spt_krs_build(&model, &tree->krs[i]) != SPT_OK) return;
    }
    tree->ready = 1;
}

/* A field without callbacks, which all calls refuse, where the library refused the model. */
static spt_field field_of(krs_tree *tree, uint32_t levels, int lanes) {
    if (!tree->ready) build(tree, levels);
    if (!tree->ready) return spt_field_default();
    spt_field field = spt_krs_field(&tree->krs[batch_index(lanes)]);
    if (lanes == 0) {
        field.batch = NULL;
    } else {
        field.point = NULL;
    }
    return field;
}

#define TREE(levels) \
    scene_field_fn scene_krs_tree_##levels##_field; \
    spt_field scene_krs_tree_##levels##_field(int lanes) { \
        static krs_tree tree; \
        return field_of(&tree, levels, lanes); \
    }
TREE(16)
TREE(28)
