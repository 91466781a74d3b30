/* SPDX-License-Identifier: MIT
 *
 * What a test of shaders needs: check.h for the suites of glsl_suites.h, and the engines. */
#ifndef TESTS_GLSL_CHECK_H
#define TESTS_GLSL_CHECK_H

#include "../check.h"
#include "engine.h"

#define SUITE(name) void suite_##name(void);
#include "glsl_suites.h"
#undef SUITE

/* Whether the engine can be used; else says so, and the test counts as skipped (or failed, with
 * SPT_REQUIRE=1): if (!engine_here(engine_gl_open(), "EGL")) return; */
static inline int engine_here(int status, const char *what) {
    if (status != ENGINE_MISSING) return 1;
    check_skip(what);
    return 0;
}

#endif
