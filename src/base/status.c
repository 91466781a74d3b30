/* SPDX-License-Identifier: MIT
 *
 * The status names and the version. */
#include <spheretrace/base.h>

#include "compiler.h"

const char *spt_status_name(spt_status status) {
    switch (status) {
    case SPT_OK:
        return "SPT_OK";
    case SPT_BAD_ARGUMENT:
        return "SPT_BAD_ARGUMENT";
    case SPT_BUFFER_TOO_SMALL:
        return "SPT_BUFFER_TOO_SMALL";
    case SPT_UNSUPPORTED:
        return "SPT_UNSUPPORTED";
    }
    return "unknown status";
}

int spt_version(void) {
    return SPT_VERSION_MAJOR * 10000 + SPT_VERSION_MINOR * 100 + SPT_VERSION_PATCH;
}
