#!/bin/sh
# SPDX-License-Identifier: MIT
#
# What programs carry of the static library. usage: left_out_sizes.sh sizes|map BUILD FOLDER, from
# the top of the tree. Links left_out_program.c in FOLDER once for each program and reads the map
# that the linker writes: of each object of the archive, all sections that are loaded. Prints rows.
# sizes: program, what it names, instruction sets, bytes of the library, of which code, objects,
# constants, unwind tables; bytes more than the first; what is promised. map: of the first program,
# object, bytes, of which code. (The linker's --gc-sections takes nothing from these programs: each
# object has one section of code, and an object that nobody needs is not linked at all.)
set -eu
mode=$1
build=$2
folder=$3
archive=$build/libspheretrace.a
setup=$(cat "$build/setup")
compiler=${setup%% -*}
[ -f "$archive" ]
mkdir -p "$folder"

link_program() { # link_program USE FLAG...: writes the program and its map
  use=$1
  shift
  $compiler -std=c99 -O2 -DUSE="$use" -Iinclude tests/report/left_out_program.c "$@" -lm \
    -Wl,-Map,"$folder/map" -o "$folder/program"
}

# Lines of a map are " SECTION ADDRESS SIZE FILE", broken behind long names of sections. What the
# linker took away stands before the words "Linker script", or has size 0; what is not loaded has
# no address. Prints object, section, bytes.
objects_of_map() {
  awk '
    function hex(text, i, value) {
      value = 0
      for (i = 3; i <= length(text); ++i) {
        value = 16 * value + index("0123456789abcdef", substr(text, i, 1)) - 1
      }
      return value
    }
    /^Linker script and memory map/ {map = 1}
    !map {next}
    /^ [^ ]+$/ {section = $1; next}
    /^ [^ ]/ {section = $1; address = $2; size = $3; file = $4}
    /^ +0x[0-9a-f]+ +0x[0-9a-f]+ [^ ]/ {address = $1; size = $2; file = $3}
    file ~ /libspheretrace\.a\(/ && address !~ /^0x0+$/ {
      object = file
      sub(/.*\(/, "", object)
      sub(/\.o\)$/, "", object)
      if (hex(size) > 0) print object, section, hex(size)
    }
    {file = ""}
  ' "$folder/map"
}

sets=$(ar t "$archive" | sed -n 's/^basic_\(.*\)\.o$/\1/p' | sort -u)
ar t "$archive" | grep -q '^compact_ssse3\.o$' && sets="$sets ssse3"
sets=$(echo $sets)

least=
row() { # row PROGRAM FEATURES PROMISED USE ARGUMENT...
  program=$1
  features=$2
  promised=$3
  shift 3
  link_program "$@"
  "$folder/program"
  bytes=$(objects_of_map | awk '
    {all += $3; objects += !($1 in seen); seen[$1] = 1}
    $2 ~ /^\.text/ {code += $3}
    $2 ~ /^\.(eh_frame|gcc_except)/ {unwind += $3}
    END {printf "%d,%d,%d,%d,%d", all, code, objects, all - code - unwind, unwind}')
  least=${least:-${bytes%%,*}}
  echo "$program,$features,$sets,$bytes,$((${bytes%%,*} - least)),$promised"
}

if [ "$mode" = map ]; then
  link_program nothing "$archive"
  objects_of_map | awk '
    {all[$1] += $3}
    $2 ~ /^\.text/ {code[$1] += $3}
    END {for (object in all) print all[object], code[object] + 0, object}' | sort -k1,1nr -k3 |
    while read -r bytes code object; do echo "minimal,$object,$bytes,$code"; done
  exit
fi

row minimal 'one sphere; basic' 40960 nothing "$archive"
for method in relaxed enhanced auto_relaxed adaptive convex; do
  row "$method" "minimal; spt_$method()" '' "$method" "$archive"
done
row rules 'minimal; all step rules' '' rules "$archive"
row bounds 'minimal; bound.h' '' bounds "$archive"
row normals 'minimal; spt_normals()' '' normals "$archive"
row surface 'minimal; all of surface.h' '' surface "$archive"
row scene 'minimal; spt_scene_trace()' '' scene "$archive"
row frame 'minimal; a frame' '' frame "$archive"
row krs 'minimal; a kernel-reflection sequence' '' krs "$archive"
row mobius 'minimal; a field under a map' '' mobius "$archive"
row glsl 'minimal; the emitter' '' glsl "$archive"
row everything 'all of these' '' everything "$archive"
row archive 'the whole archive' '' nothing -Wl,--whole-archive "$archive" -Wl,--no-whole-archive
