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
  local rank="base=0 lanes=1 bound=2 methods=3 trace=4 surface=5 scene=6 krs=6 frame=7 glsl=8"
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
# bcmp is what clang makes of memcmp() == 0.
undefined() { nm -u "$archive" | sed -n 's/^ *U //p' | sort -u | grep -vxE \
  'spti?_[a-z0-9_]*|mem(cpy|set|move|cmp|chr)|bcmp|str(len|cmp|ncmp|chr|spn|cspn)|(sqrt|fabs|floor)f?|__cpu_model|_GLOBAL_OFFSET_TABLE_'; }
none "the library needs only memory functions and libm" undefined
writable() { size -A "$archive" |
  awk '$1 ~ /^\.(data|bss|tdata|tbss)/ && $1 !~ /^\.data\.rel\.ro/ && $2 > 0 {print $1, $2}'; }
none "the library has no writable data" writable

# Loops are bounded by an integer or a list: none runs until something happens.
unbounded() { awk '{
    code = $0
    gsub(/"[^"]*"/, "", code)
    sub(/\/\*.*/, "", code)
    if (code ~ /(^|[^A-Za-z_])(while|do|goto)([^A-Za-z_]|$)/ && code !~ /^ *(\*|\/\/)/) {
      print FILENAME ":" FNR ":" $0
    }
  }' src/*/*.[ch]; }
none "all loops in src are for loops" unbounded

# A level of recursion stays within 32 KiB: no frame is larger.
frames() {
  local file
  for file in src/base/*.c src/bound/*.c src/trace/*.c \
      src/surface/*.c src/scene/*.c src/krs/*.c src/frame/*.c; do
    cc -std=c99 -O3 -ffp-contract=off -fno-math-errno -DSPTI_HAVE_SSE2 -Iinclude -Wvla \
      -Wframe-larger-than=32768 -c "$file" -o "$build/frame.o"
  done
}
none "no stack frame above 32 KiB" frames

# C++ users may have fast mathematics on: the headers hold no guard against it.
fast() {
  local header
  command -v g++ >/dev/null || return
  for header in include/spheretrace/*.h; do
    printf '#include "%s"\n' "$header" >"$build/alone.cc"
    g++ -std=c++11 -ffast-math -Wall -Wextra -Werror -I. -Iinclude -fsyntax-only "$build/alone.cc"
  done
}
none "headers compile as C++ with -ffast-math" fast

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

# One sphere and basic tracing: code of the library for all instruction sets, as gcc makes it.
small() {
  local bytes
  bytes=$(sh tests/report/left_out_sizes.sh sizes "$build" "$build/sizes" 2>/dev/null |
    awk -F, '$1 == "minimal" {print $5}')
  [ "${bytes:-99999}" -le 40960 ] || echo "${bytes:-unknown} bytes of code"
}
case $(cat "$build/setup") in
  cc\ *|gcc\ *) [ "$(uname -m)" = x86_64 ] && none "the smallest program carries at most 40 KiB" small ;;
esac

# A result that nobody asked for leaves no instruction: the kernels without any have the same
# floating-point, vector and mask instructions, loads and stores among them, as a copy of the source
# from which everything optional was cut out (order, jumps and registers are the compiler's whim).
lean() {
  local copy=$build/lean isa flags rule
  rm -rf "$copy" && mkdir -p "$copy" && cp -r include src "$copy" || return
  awk '/if \(wants & SPTI_WANT_/ {skipping = 1; block = /\{$/; match($0, /^ */); indent = RLENGTH}
    !skipping {print}
    skipping && block {match($0, /^ */); if (/^ *\}$/ && RLENGTH == indent) skipping = 0}
    skipping && !block && /;$/ {skipping = 0}' src/trace/march_kernel.h \
    >"$copy/src/trace/march_kernel.h"
  grep -q 'if (wants' "$copy/src/trace/march_kernel.h" && echo "the cut left something"
  [ "$(grep -c 'if (wants' src/trace/march_kernel.h)" -ge 6 ] || echo "there is nothing to cut"
  for rule in $(sed -n 's/^ *X(\([a-z_]*\)).*/\1/p' src/methods/methods.h); do
    for isa in 1 '4 -msse2' '8 -mavx2' '16 -mavx512f'; do
      flags="-std=c99 -O2 -ffp-contract=off -fno-math-errno -fPIC -DSPTI_MARCH=table
        -DSPT_LANES=$isa"
      for tree in . "$copy"; do
        cc $flags -DSPTI_RULE="\"../methods/$rule.h\"" -I$tree/include -c $tree/src/backend/march.c \
          -o "$copy/march.o" || return
        objdump -d --no-show-raw-insn "$copy/march.o" | awk '/^[0-9a-f]+ </ {on = /<pass_0>/}
          on && $2 ~ /(ps|ss)$|^[vk]/ {print $2}' | sort >"$copy/$([ $tree = . ] && echo whole || echo cut)"
      done
      [ -s "$copy/whole" ] || echo "$rule $isa: no pass_0"
      cmp -s "$copy/whole" "$copy/cut" || echo "$rule, $isa lanes: differs"
    done
  done
}
[ "$(uname -m)" = x86_64 ] && none "results that nobody asked for leave no instruction" lean

exit $failed
