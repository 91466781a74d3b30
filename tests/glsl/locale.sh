#!/bin/sh
# SPDX-License-Identifier: MIT
#
# The texts of the emitter are the same bytes where numbers are printed with a comma: makes such a
# locale in the build folder and runs the test for it there. usage: locale.sh BUILD_FOLDER (RUN and
# EXE as in the Makefile)
set -u
skip() {
  echo "skipped: $*"
  [ "${SPT_REQUIRE:-}" != 1 ]
  exit
}
command -v localedef >/dev/null || skip 'the emitter in other locales, no localedef'
[ -e /usr/share/i18n/locales/de_DE ] || skip 'the emitter in other locales, no de_DE (package locales)'
folder=$1/locale
mkdir -p "$folder" || exit 1
localedef -i de_DE -f UTF-8 "$folder/de_DE.UTF-8" || skip 'the emitter in other locales, no UTF-8'
LOCPATH=$folder LC_ALL=de_DE.UTF-8 SPT_COMMA=1 ${RUN:-} "$1/check${EXE:-}" H1a >"$folder/log" 2>&1 || {
  cat "$folder/log"
  exit 1
}
