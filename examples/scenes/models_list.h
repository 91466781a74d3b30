/* SPDX-License-Identifier: MIT
 *
 * THE LIST of models: X(name) for each `const model model_NAME`. The including file defines X. */
X(tree)
X(twisted_tree)
X(grove)
X(forest)
X(coral)
X(terrain)
X(rock)
X(fish)
X(sponge)
X(palm)
X(reef)
