#!/bin/sh
# SPDX-License-Identifier: MIT
#
# What an option that is off leaves in the kernels of step rules, and what it takes when it is on.
# usage: left_out_instructions.sh quick|full BUILD FOLDER, from the top of the tree. Compiles the
# kernels, in FOLDER, from a copy of the source from which all that is optional was cut; compares
# their code with that of the library for a call without options; and counts the instructions of
# both (left_out_count.c). Prints rows: option, step rule, instruction set; instructions of a pass
# of the kernel with nothing to leave out, off, on; of a call off, on; 1 where what is off
# leaves nothing: the code is the same but for its order and registers, or runs no more instructions;
# and how much the same it is:
#   code        the same instructions in the same registers and order; padding and addresses aside
#   operations  the same instructions in another order or other registers
#   alone       the same operations where the compiler sees this kernel alone, of the source as it
#               is and of the one that was cut; beside the library's other kernels it decides in
#               another way what to unroll and where to branch
#   arithmetic  the same instructions on floats, vectors and masks, loads and stores among them;
#               others (jumps, moves of integers) differ
set -eu
extent=$1
build=$2
folder=$3
archive=$build/libspheretrace.a
setup=$(cat "$build/setup") # compiler, common flags, and those of each instruction set
compiler=${setup%% -*}
common=$(printf '%s\n' ${setup%% scalar *} | grep '^-' | grep -v '^-[Wp]')
[ "$(uname -sm)" = 'Linux x86_64' ]
rm -rf "$folder"
mkdir -p "$folder/library" "$folder/cut" "$folder/alone"

# The flags of an instruction set stand in the setup between its name and the next one's.
sets='scalar sse2 ssse3 avx2 avx512'
flags_of() {
  of=
  for word in $setup; do
    case " $sets " in *" $word "*) of=$word && continue ;; esac
    [ "$of" != "$1" ] || printf '%s ' "$word"
  done
}

# ---- The source without what is optional ---------------------------------------------------------

# Both with the kernel of a call without options alone.
cp -r include src "$folder/alone"
sed '/^INSTANCE([1-7])/d; s/pass_[1-7]/pass_0/g' src/backend/march.c \
  >"$folder/alone/src/backend/march.c"
cp -r "$folder/alone/include" "$folder/alone/src" "$folder/cut"
awk '/if \(wants & SPTI_WANT_/ {skipping = 1; block = /\{$/; match($0, /^ */); indent = RLENGTH}
  !skipping {print}
  skipping && block {match($0, /^ */); if (/^ *\}$/ && RLENGTH == indent) skipping = 0}
  skipping && !block && /;$/ {skipping = 0}' src/trace/march_kernel.h \
  >"$folder/cut/src/trace/march_kernel.h"
[ "$(grep -c 'if (wants' src/trace/march_kernel.h)" -ge 6 ]
! grep -q 'if (wants' "$folder/cut/src/trace/march_kernel.h"

# The kernel of a call without options, an instruction a line, without padding and addresses.
kernel_code() {
  objdump -d --no-show-raw-insn "$1" | awk '
    /^[0-9a-f]+ </ {on = /<pass_0>/; next}
    on && NF > 1 && $2 !~ /^(nop|data16|cs$|xchg$)/ {
      sub(/^ *[0-9a-f]+:\t/, "")
      sub(/ *#.*/, "")
      if ($1 ~ /^(j|call)/) $0 = $1
      gsub(/0x[0-9a-f]+\(%rip\)/, "(%rip)")
      print
    }' | sed 's/[ \t]*$//'
}

# How much the kernels of two objects are the same.
same() {
  kernel_code "$1" >"$folder/one"
  kernel_code "$2" >"$folder/other"
  [ -s "$folder/one" ] && [ -s "$folder/other" ] || exit 1
  cmp -s "$folder/one" "$folder/other" && echo code && return
  for file in one other; do
    awk '{print $1}' "$folder/$file" | sort >"$folder/$file.operations"
    grep -E '(ps|ss)$|^[vk]' "$folder/$file.operations" >"$folder/$file.arithmetic" || true
  done
  cmp -s "$folder/one.operations" "$folder/other.operations" && echo operations && return
  cmp -s "$folder/one.arithmetic" "$folder/other.arithmetic" && echo arithmetic && return
  echo no
}

compile() { # compile SOURCE RULE SET: of the cut source or the one that is alone
  $compiler -fPIC $have $(flags_of "$3") $common -I"$folder/$1/include" \
    -DSPTI_RULE="\"../methods/$2.h\"" -DSPTI_MARCH="spti_march_$2_$3" \
    -c "$folder/$1/src/backend/march.c" -o "$folder/$1/$2_$3.o"
}

rules=$(sed -n 's/^ *X(\([a-z_]*\)).*/\1/p' src/methods/methods.h)
have=
: >"$folder/same"
(cd "$folder/library" && ar x "$(cd "$OLDPWD" && realpath "$archive")")
for set in $sets; do
  [ -f "$folder/library/basic_$set.o" ] || [ -f "$folder/library/compact_$set.o" ] || continue
  have="$have -DSPTI_HAVE_$(echo "$set" | tr a-z A-Z)"
done
for set in $sets; do
  for rule in $rules; do
    object=${rule}_$set.o
    [ -f "$folder/library/$object" ] || continue
    compile cut "$rule" "$set"
    how=$(same "$folder/library/$object" "$folder/cut/$object")
    if [ "$how" = arithmetic ] || [ "$how" = no ]; then
      compile alone "$rule" "$set"
      case $(same "$folder/alone/$object" "$folder/cut/$object") in
        code | operations) how=alone ;;
      esac
    fi
    echo "$rule,$set,$how" >>"$folder/same"
  done
done

# ---- Counts --------------------------------------------------------------------------------------

count() { # count EXTENT OBJECT...: of a program in which these come before those of the library
  wish=$1
  shift
  $compiler -std=c99 -O2 $have -Iinclude tests/report/left_out_count.c "$@" "$archive" -lm \
    -o "$folder/count"
  "$folder/count" "$wish"
}

count off "$folder"/cut/*.o >"$folder/counts.cut"
count "$extent" >"$folder/counts"
awk -F, '
  FILENAME ~ /same$/ {same[$1 "," $2] = $3; next}
  FILENAME ~ /cut$/ {cut[$2 "," $3] = $4; next}
  {kernel = $2 "," $3}
  $1 == "off" {off[kernel] = $4; whole[kernel] = $5; next}
  {
    leaves_nothing = same[kernel] ~ /^(code|operations)$/ ||
      (cut[kernel] > 0 && off[kernel] > 0 && off[kernel] + 0 <= cut[kernel] + 0)
    print $1 "," kernel "," cut[kernel] "," off[kernel] "," $4 "," whole[kernel] "," $5 "," \
      leaves_nothing "," same[kernel]
  }' "$folder/same" "$folder/counts.cut" "$folder/counts"
