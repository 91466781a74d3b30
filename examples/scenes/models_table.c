/* SPDX-License-Identifier: MIT
 *
 * The table of models. Each is in the model_*.c of its name or kind. */
#include "model_build.h"

#include <string.h>

const model *const models[] = {
#define X(name) &model_##name,
#include "models_list.h"
#undef X
};
const size_t model_count = sizeof models / sizeof models[0];

const model *model_named(const char *name) {
    for (size_t i = 0; i < model_count; ++i) {
        if (strcmp(models[i]->name, name) == 0) return models[i];
    }
    return NULL;
}
