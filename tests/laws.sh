#!/bin/bash
# SPDX-License-Identifier: MIT
#
# The laws of the tree that a compiler does not check. usage: laws.sh BUILD_FOLDER
# Prints a line for each broken one; silent and 0 where all hold.
set -u
build=$1
archive=$build/libspheretrace.a
shared=$build/libspheretrace.so
failed=0
broken() { printf 'law broken: %s\n' "$*"; failed=1; }
none() { # none TITLE COMMAND...: the command must print nothing
  local title=$1 out
  shift
  out=$("$@" 2>&1)
  [ -z "$out" ] || broken "$title"$'\n'"$out"
}

extra() { git ls-files | cut -d/ -f1 | sort -u |
  grep -vxE 'include|src|examples|tests|Makefile|LICENSE|README\.md|\..*'; }
none "the top level holds only the agreed names" extra

# Includes go one way. backend/isa.h is the choice of a width and belongs to the base.
order() {
  local rank="base=0 lanes=1 bound=2 methods=3 trace=4"
  grep -no '#include "[^"]*"' src/*/*.[ch] | while IFS=: read -r file _ include; do
    local room to target
    room=$(basename "$(dirname "$file")")
    target=${include#*\"}
    target=${target%\"}
    case $target in ../*) to=${target#../}; to=${to%%/*} ;; *) to=$room ;; esac
    [ "$room" = backend ] || [ "$target" = ../backend/isa.h ] && continue
    local a b
    a=$(printf '%s\n' $rank | sed -n "s/^$room=//p")
    b=$(printf '%s\n' $rank | sed -n "s/^$to=//p")
    [ -n "$a" ] && [ -n "$b" ] && [ "$b" -le "$a" ] || echo "$file includes $target"
  done
}
none "includes go one way" order

foreign() { nm -g --defined-only "$archive" | awk 'NF == 3 && $3 !~ /^spti?_/ {print $3}'; }
none "the static library defines only spt_ and spti_ names" foreign
exported() { nm -D --defined-only "$shared" |
  awk '$2 != "A" && $3 !~ /^spt_[a-z0-9_]+@@SPHERETRACE_[0-9]+$/ {print $3}'; }
none "the shared library exports only spt_ names" exported
undefined() { nm -u "$archive" | sed -n 's/^ *U //p' | sort -u | grep -vxE \
  'spti?_[a-z0-9_]*|mem(cpy|set|move|cmp)|(sqrt|fabs|floor)f?|__cpu_model|_GLOBAL_OFFSET_TABLE_'; }
none "the library needs only memory functions and libm" undefined
writable() { size -A "$archive" |
  awk '$1 ~ /^\.(data|bss|tdata|tbss)/ && $1 !~ /^\.data\.rel\.ro/ && $2 > 0 {print $1, $2}'; }
none "the library has no writable data" writable

# Wide instructions only in the objects built for them.
wide() {
  find "$build/src" -name '*.o' ! -name '*avx*' | while read -r object; do
    [ "$(objdump -d "$object" | grep -cE '%[yz]mm')" = 0 ] || echo "$object"
  done
}
none "no wide SIMD outside the objects for it" wide

# A static link carries only the methods it names.
carried() {
  printf '%s\n' '#include <spheretrace/trace.h>' 'int main(void) { spt_settings s =' \
    'spt_settings_default(); return spt_trace(0, &s, 0, 0, 0, 0) != SPT_BAD_ARGUMENT; }' \
    >"$build/minimal.c"
  cc -std=c99 -Iinclude "$build/minimal.c" "$archive" -lm -o "$build/minimal" || return
  "$build/minimal" || echo "the minimal program failed"
  nm "$build/minimal" | grep -oE 'spti_march_[a-z_]+' | grep -v '^spti_march_adaptive_' | sort -u
}
none "a static link carries only the methods it names" carried

# A result that nobody asked for leaves no instruction: the kernels without any touch none of the
# arrays that hold such results, the last ones of a chunk.
untouched() {
  local room arrays first
  room=$(( (256 + 16) * 4 ))
  arrays=$(awk '/SPTI_X,/ {on = 1} on {print} /SPTI_ARRAYS/ {exit}' src/trace/chunk.h |
    grep -oE 'SPTI_(STEEPEST|FALLBACKS|CANDIDATE_T|CANDIDATE_RATIO),' | wc -l)
  [ "$arrays" = 4 ] || echo "the arrays of optional results are not where this check looks"
  printf '#include "../src/trace/chunk.h"\n#include <stdio.h>\nint main(void) {%s}\n' \
    'printf("%d %d\n", SPTI_STEEPEST, SPTI_ARRAYS);' >"$build/arrays.c"
  cc -std=c99 -I. -Itests -Iinclude "$build/arrays.c" -o "$build/arrays" || return
  first=$("$build/arrays" | awk -v room=$room '{printf "%d %d", $1 * room, $2 * room}')
  for object in "$build"/src/methods/*_*.o; do
    case $object in *_scalar.o | *_sse2.o | *_avx2.o | *_avx512.o) ;; *) continue ;; esac
    objdump -d --no-show-raw-insn "$object" | awk -v range="$first" -v object="$object" '
      function hex(text,  i, n) {
        for (i = 1; i <= length(text); ++i) n = n * 16 + index("0123456789abcdef", substr(text, i, 1)) - 1
        return n
      }
      BEGIN {split(range, r, " ")}
      /^[0-9a-f]+ <.*>:$/ {name = $2}
      name ~ /pass_0/ {line = $0
        while (match(line, /0x[0-9a-f]+\(%/)) {
          offset = hex(substr(line, RSTART + 2, RLENGTH - 4)); line = substr(line, RSTART + RLENGTH)
          if (offset >= r[1] && offset < r[2]) {print object ": " $0}}
        seen[name] = 1}
      END {if (!("<pass_0>:" in seen)) print object ": no pass_0"}'
  done
}
none "results that nobody asked for leave no instruction" untouched

exit $failed
