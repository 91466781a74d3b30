#!/bin/sh
# SPDX-License-Identifier: MIT
#
# The page of the report against the tables beside it: every number is that of its table's row and
# column, rounded; there are more than 100; no other number stands in the text; the page asks for
# nothing from anywhere; its elements are balanced; Chromium opens it without a complaint.
# usage: numbers.sh FOLDER
# Without Chromium the page is not opened, which is a failure with SPT_REQUIRE=1.
set -u
rules=$(cd "$(dirname "$0")" && pwd)/numbers.awk
cd "$1" || exit 1
[ -s index.html ] || { echo "numbers.sh: no index.html in $1"; exit 1; }
LC_ALL=C awk -f "$rules" index.html || exit 1

if ! command -v chromium >/dev/null 2>&1 || ! command -v timeout >/dev/null 2>&1; then
  echo 'skipped: opening the page, no chromium or timeout'
  [ "${SPT_REQUIRE:-}" != 1 ]
  exit
fi
profile=$(mktemp -d) || exit 1
timeout 120 chromium --headless --no-sandbox --disable-gpu --user-data-dir="$profile" \
  --enable-logging=stderr --dump-dom "file://$(pwd)/index.html" >"$profile/dom" 2>"$profile/log"
failed=$?
[ $failed = 0 ] || echo 'numbers.sh: Chromium does not open the page'
if grep CONSOLE "$profile/log"; then failed=1; fi
# An element that is not where it may be is moved or dropped on opening.
for element in data figure p li td svg; do
  written=$(grep -o "<$element[ >]" index.html | wc -l)
  opened=$(grep -o "<$element[ >]" "$profile/dom" | wc -l)
  [ "$written" = "$opened" ] || {
    echo "numbers.sh: $written of <$element> are written, Chromium has $opened"; failed=1; }
done
sleep 1 # the last of its processes still write
rm -rf "$profile"
exit $failed
