#!/bin/sh
# SPDX-License-Identifier: MIT
#
# README shows only programs that are built and run: what stands between the markers
# "README: begin" and "README: end" of an example stands in README.md, and no other C does.
set -eu
readme=$(cat README.md)
marked=0
for example in examples/*.c; do
  snippet=$(sed -n '/README: begin/,/README: end/p' "$example" | grep -v 'README: ' || true)
  [ -n "$snippet" ] || continue
  marked=$((marked + 1))
  case $readme in
  *"$snippet"*) ;;
  *) echo "README.md lacks the marked part of $example, or differs from it"; exit 1 ;;
  esac
done
blocks=$(grep -c '^```c$' README.md || true)
[ "$marked" -gt 0 ] && [ "$blocks" -eq "$marked" ] && exit 0
echo "README.md shows $blocks C blocks, the examples mark $marked"
exit 1
