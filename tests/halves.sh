#!/bin/sh
# SPDX-License-Identifier: MIT
#
# Runs the test program in two halves at once, and ends with the sum of both.
# usage: halves.sh COMMAND...
set -u
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$@" 1/2 >"$folder/first" 2>&1 &
other=$!
"$@" 2/2 >"$folder/second" 2>&1
status=$?
wait "$other" || status=1
[ "$status" = 77 ] && cat "$folder/second" && exit 77
for half in first second; do grep -vE '^[0-9]+ passed, |^random numbers' "$folder/$half"; done
grep -h '^random numbers' "$folder/first"
grep -hE '^[0-9]+ passed, ' "$folder/first" "$folder/second" | awk '
  {passed += $1; failed += $3; skipped += $5; ++halves}
  END {
    printf "%d passed, %d failed", passed, failed + (halves < 2)
    if (skipped) printf ", %d skipped", skipped
    printf "\n"
    exit halves < 2
  }' || status=1
exit "$status"
