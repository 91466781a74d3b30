#!/bin/sh
# SPDX-License-Identifier: MIT
#
# The pages that emit writes, operated in Chromium on SwiftShader as a person would, by mouse,
# fingers and keys: the viewer on a large screen, on a phone and without WebGL, its mean of
# evaluations against the library's, triangles and field in one depth buffer, and a page of three.js
# (its shader is compiled with three's prologue by glslangValidator; it is run where THREE names a
# three.module.js). Leaves pictures in BUILD_FOLDER/viewer.
# usage: viewer.sh BUILD_FOLDER (with emit and render in it; CC, RUN and EXE as in the Makefile)
# Ends with 77 where there is no Chromium or compiler of C, and fails there with SPT_REQUIRE=1.
set -u
emit="${RUN:-} $1/emit${EXE:-}"
render="${RUN:-} $1/render${EXE:-}"
mkdir -p "$1/viewer" || exit 1
folder=$(cd "$1/viewer" && pwd)
here=$(dirname "$0")/viewer
failed=0
wrong() { echo "viewer.sh: $*"; failed=1; }
skip() {
  echo "skipped: $*"
  [ "${SPT_REQUIRE:-}" = 1 ] && exit 1
}
command -v chromium >/dev/null 2>&1 || { skip 'the pages, no chromium'; exit 77; }
command -v timeout >/dev/null 2>&1 || { skip 'the pages, no timeout'; exit 77; }
${CC:-cc} -std=c99 -O1 -o "$folder/drive" "$here"/viewer_*.c -lm || exit 1
drive() { # drive TESTS...
  rm -rf "$folder/profile"
  timeout 300 "$folder/drive" "$folder" "$@" || wrong "$1 and so on"
  sleep 1 # the last of its processes still write
  rm -rf "$folder/profile"
}
page() { # page KIND NAME SCENE OPTIONS...
  kind=$1
  name=$2
  shift 2
  $emit "--$kind" "$folder/$name.html" "$@" || wrong "emit --$kind $*"
  ! grep -q '://' "$folder/$name.html" || wrong "$name.html: an outside link"
}

page page viewer smooth_union --features normal
page page primitives primitives --features normal
means=
for rule in basic adaptive; do
  mean=$($render --kind heat --whole --no-cones --no-culling --samples 1 --size 600x400 \
    --method $rule primitives -o "$folder/heat.png" | sed 's/.* rays, \([0-9.]*\) eval.*/\1/')
  means="$means mean=$folder/primitives.html,$rule,$mean"
done
page hybrid hybrid primitives --features normal
page hybrid ball sphere --features normal
page page village village
page page tree tree --features normal
drive "page=$folder/viewer.html" $means "hybrid=$folder/hybrid.html" \
  "depth=$folder/ball.html" "shot=$folder/village.html,village" "shot=$folder/tree.html,tree"
drive "none=$folder/viewer.html"

# What three.js puts before a ShaderMaterial's text, as far as it matters.
prologue='#version 300 es
#define varying in
layout(location = 0) out highp vec4 pc_fragColor;
#define gl_FragColor pc_fragColor
precision highp float;
precision highp int;
uniform mat4 viewMatrix;
uniform vec3 cameraPosition;
uniform bool isOrthographic;'
for scene in primitives village tree; do
  page three "three_$scene" $scene
  { echo "$prologue"
    sed -n '/id="fragment">$/,/^<\/script>$/p' "$folder/three_$scene.html" |
      sed '1d; $d; /#include </d'; } >"$folder/three_$scene.frag"
  grep -q 'SptHit spt_trace' "$folder/three_$scene.frag" || wrong "three_$scene.frag: no shader"
  if command -v glslangValidator >/dev/null 2>&1; then
    glslangValidator -S frag "$folder/three_$scene.frag" >"$folder/log" || {
      wrong "three_$scene.frag"; cat "$folder/log"; }
  else
    skip 'shaders for three.js, no glslangValidator'
  fi
done
if [ -n "${THREE:-}" ]; then
  cp "$(dirname "$THREE")"/three.*.js "$folder" || wrong "no $THREE"
  drive "three=$folder/three_primitives.html"
else
  echo 'three.js is not run: THREE names no three.module.js'
fi
exit $failed
