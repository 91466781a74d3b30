#!/bin/sh
# SPDX-License-Identifier: MIT
#
# Every combination of step rule, feature, target and program (matrix.c) through all validators:
# glslangValidator reads and links them, glslc -O reads those for Vulkan as well, and spirv-val
# what both make of them. usage: validators.sh BUILD_FOLDER (EXE as in the Makefile). What is left
# in BUILD_FOLDER/glsl/matrix/table.txt is how long each shader is.
set -u
skip() {
  echo "skipped: $*"
  [ "${SPT_REQUIRE:-}" != 1 ]
  exit
}
folder=$1/glsl/matrix
rm -rf "$folder" && mkdir -p "$folder" || exit 1
"$1/glsl_matrix${EXE:-}" "$folder" || exit 1
command -v glslangValidator >/dev/null || skip 'validators, no glslangValidator (glslang-tools)'
command -v spirv-val >/dev/null || skip 'validators, no spirv-val (spirv-tools)'
command -v glslc >/dev/null || skip 'validators, no glslc'
cd "$folder" || exit 1

# The status of xargs says whether any failed; the log holds what they said.
check() {
  what=$1
  shift
  "$@" >log 2>&1 || {
    grep -v -e '^[^ :]*$' log | head -20
    echo "FAILED validators: $what"
    exit 1
  }
  echo "$what: $(wc -l <list) shaders are well"
}

find . -name '*.frag' -o -name '*.comp' ! -name '*.vulkan.comp' >list
check 'glslangValidator' xargs -P 2 -n 64 glslangValidator <list
find . -name '*_330_picture_all*.frag' >list
check 'glslangValidator -l' xargs -P 2 -n 1 glslangValidator -l <list
find . -name '*.vulkan.comp' >list
check 'glslangValidator -V' xargs -P 2 -I {} \
  glslangValidator -V --target-env vulkan1.1 -o {}.1.spv {} <list
check 'glslc -O' xargs -P 2 -n 32 glslc -O --target-env=vulkan1.1 -fshader-stage=comp -c <list
find . -name '*.spv' >list
check 'spirv-val' xargs -P 2 -n 1 spirv-val --target-env vulkan1.1 <list
rm -f list log ./*.spv
