/* SPDX-License-Identifier: MIT
 *
 * THE LIST of test suites; each is a function suite_NAME in some file of tests. */
SUITE(shapes)
SUITE(scenes)
SUITE(scenes_known)
SUITE(image)
SUITE(oracle)
SUITE(papers)
SUITE(properties)
SUITE(parity)
SUITE(golden)
SUITE(callback_values)
SUITE(ray_parameters)
SUITE(scale)
SUITE(grazing)
SUITE(no_bound)
SUITE(calls)
SUITE(host)
