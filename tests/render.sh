#!/bin/sh
# SPDX-License-Identifier: MIT
#
# The program render from outside: a picture is the same file for any number of threads and put
# together from any number of parts, what does not belong together is refused, and an interrupt
# leaves a picture behind. usage: render.sh BUILD_FOLDER (RUN and EXE as in the Makefile)
set -u
render="${RUN:-} $1/render${EXE:-}"
folder=$1/render_test
failed=0
wrong() { echo "render.sh: $*"; failed=1; }
run() { # run ARGUMENTS...: must succeed
  $render "$@" >"$folder/log" 2>&1 || { wrong "render $*"; cat "$folder/log"; }
}
same() { cmp -s "$1" "$2" || wrong "$1 and $2 differ"; }
refused() { # refused WORDS ARGUMENTS...: must say so and end with 2
  words=$1
  shift
  $render "$@" >"$folder/log" 2>&1
  [ $? = 2 ] || wrong "not refused: render $*"
  grep -q "$words" "$folder/log" || { wrong "render $*: no word of '$words'"; cat "$folder/log"; }
}
rm -rf "$folder"
mkdir -p "$folder" || exit 1

# A picture whole, as an image and as numbers; then from parts.
whole_and_parts() { # whole_and_parts NAME COUNTS ARGUMENTS...
  name=$folder/$1
  counts=$2
  shift 2
  run --threads 1 "$@" -o "$name.png"
  run --threads 3 "$@" -o "$name.pfm"
  for of in $counts; do
    parts=
    part=$of # the last one first: any order will do
    while [ "$part" -ge 1 ]; do
      run --threads $((part % 3 + 1)) --part "$part/$of" "$@" -o "$name.$of.$part"
      parts="$parts $name.$of.$part"
      part=$((part - 1))
    done
    run --merge $parts -o "$name.$of.png"
    run -o "$name.$of.pfm" --merge $parts
    same "$name.png" "$name.$of.png"
    same "$name.pfm" "$name.$of.pfm"
  done
}
size='--size 150x101'
whole_and_parts shaded '1 2 3 7' $size primitives
whole_and_parts normal 3 $size --kind normal --samples 3 primitives
whole_and_parts heat 7 $size --kind heat --method basic,adaptive --whole primitives
whole_and_parts depth 2 $size --kind depth --samples 1 twisted
whole_and_parts kept 2 $size --kind kept village
# More parts than tiles: some hold none.
whole_and_parts few 3 --size 20x10 --samples 1 primitives

# Rows 30 to 96 of a picture are those rows of the whole; a PFM begins with its last row.
run $size --region 0,30,150x67 primitives -o "$folder/region.pfm"
row=$((150 * 3 * 4))
tail -c $((67 * row)) "$folder/region.pfm" >"$folder/region.rows"
tail -c $((101 * row)) "$folder/shaded.pfm" | tail -c +$((4 * row + 1)) | head -c $((67 * row)) \
  >"$folder/shaded.rows"
same "$folder/region.rows" "$folder/shaded.rows"

# What a part must not be put together with.
part() { echo "$folder/shaded.3.$1"; }
refused 'missing' --merge "$(part 1)" "$(part 3)" -o "$folder/no.png"
refused 'once more' --merge "$(part 1)" "$(part 2)" "$(part 2)" "$(part 3)" -o "$folder/no.png"
refused 'count of parts' --merge "$(part 1)" "$folder/shaded.7.2" -o "$folder/no.png"
refused 'kind' --merge "$(part 1)" "$folder/normal.3.2" -o "$folder/no.png"
run --part 2/3 --size 150x102 primitives -o "$folder/other"
refused 'height' --merge "$(part 1)" "$folder/other" "$(part 3)" -o "$folder/no.png"
run --part 2/3 $size repeated -o "$folder/other"
refused 'scene' --merge "$(part 1)" "$folder/other" "$(part 3)" -o "$folder/no.png"
run --part 2/3 $size --samples 1 primitives -o "$folder/other"
refused 'samples' --merge "$(part 1)" "$folder/other" "$(part 3)" -o "$folder/no.png"
run --part 2/3 $size --no-shadows primitives -o "$folder/other"
refused 'shadows' --merge "$(part 1)" "$folder/other" "$(part 3)" -o "$folder/no.png"
run --part 2/3 $size --no-cones primitives -o "$folder/other"
refused 'tile flags' --merge "$(part 1)" "$folder/other" "$(part 3)" -o "$folder/no.png"
# Damage: a byte short, a byte long, a bit of another value, no part at all.
head -c -1 "$(part 2)" >"$folder/other"
refused 'damaged' --merge "$(part 1)" "$folder/other" "$(part 3)" -o "$folder/no.png"
{ cat "$(part 2)" && printf 0; } >"$folder/other"
refused 'damaged' --merge "$(part 1)" "$folder/other" "$(part 3)" -o "$folder/no.png"
{ head -c 5000 "$(part 2)" && printf '\377' && tail -c +5002 "$(part 2)"; } >"$folder/other"
refused 'damaged' --merge "$(part 1)" "$folder/other" "$(part 3)" -o "$folder/no.png"
refused 'no part' --merge "$folder/shaded.png" -o "$folder/no.png"
refused 'no/such' --merge "$folder/no/such" -o "$folder/no.png"
refused 'no use for' --merge "$(part 1)" --samples 3
refused 'K/N' --part 4/3 primitives
refused 'inside' $size --region 100,0,51x10 primitives
[ ! -e "$folder/no.png" ] || wrong 'a refused picture was written'

# An interrupt: status 130, what is missing is said, and the picture is there. 64 samples a pixel
# keep any machine busy for longer than it takes to interrupt it.
if command -v timeout >/dev/null && [ -z "${RUN:-}" ]; then
  # In the foreground: else the whole group is interrupted, render twice, and the second one kills.
  timeout --foreground --preserve-status -s INT 1 "$1/render" --threads 2 --size 1280x720 --samples 8 \
    mandelbulb -o "$folder/partial.ppm" >"$folder/log" 2>&1
  [ $? = 130 ] || wrong "status $? after an interrupt"
  grep -q 'tiles are missing' "$folder/log" || wrong 'nothing is said of missing tiles'
  [ "$(wc -c <"$folder/partial.ppm")" = $((1280 * 720 * 3 + 16)) ] || wrong 'no partial picture'
fi
[ "$failed" = 1 ] || rm -rf "$folder"
exit $failed
