#!/bin/bash
# SPDX-License-Identifier: MIT
#
# Whether gcc vectorises a loop over each function of shapes.h, with the flags that field.h names,
# at every width it can build. Names those it does not. Run from the root of the tree.
source=tests/headers/vectorise.c
report=$(mktemp) || exit 1
trap 'rm -f "$report"' EXIT
failed=0
widths=0

# width BYTES FLAGS: compiles; each loop has a line of its own in the source and in the report.
width() {
  local bytes=$1 line loop
  shift
  gcc "$@" -fsyntax-only -x c /dev/null 2>/dev/null || { echo "gcc knows no $*"; return; }
  if ! gcc -std=c99 -O3 -fno-math-errno -ffp-contract=off "$@" -Iinclude -fopt-info-vec \
    -c $source -o /dev/null 2>"$report"; then
    cat "$report"
    failed=1
    return
  fi
  widths=$((widths + 1))
  while IFS=: read -r line loop; do
    grep -q "^$source:$line:.*loop vectorized using $bytes byte" "$report" ||
      { echo "$loop: not vectorised to $bytes bytes"; failed=1; }
  done < <(sed -n '/^LOOP(/{=;s/LOOP(\([a-z_0-9]*\).*/\1/p}' $source | paste -d: - -)
}

width 16
width 32 -mavx2
width 64 -mavx512f -mprefer-vector-width=512
[ $widths -gt 0 ] && exit $failed
