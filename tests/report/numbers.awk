# SPDX-License-Identifier: MIT
#
# Reads index.html (records end before each <) in its folder, beside the tables, and prints what is
# wrong with it: see numbers.sh. Bytes, not letters: LC_ALL=C.
function fail(words) {
  if (++failures <= 40) print "index.html, around line " line ": " words
}

function plain(text) {
  gsub(/&lt;/, "<", text)
  gsub(/&gt;/, ">", text)
  gsub(/&quot;/, "\"", text)
  gsub(/&amp;/, "\\&", text)
  return text
}

function attribute(tag, name,   at) {
  at = index(tag, " " name "=\"")
  if (at == 0) return ""
  tag = substr(tag, at + length(name) + 3)
  return substr(tag, 1, index(tag, "\"") - 1)
}

function exists(file,   unused, found) {
  if (file in existing) return existing[file]
  found = (getline unused < file) >= 0
  close(file)
  return existing[file] = found
}

function load(table,   text, number, count, i, header, cells) {
  loaded[table] = 1
  RS = "\n"
  while ((getline text < (table ".csv")) > 0) {
    sub(/\r$/, "", text)
    count = split(text, cells, ",")
    for (i = 1; i <= count; ++i) {
      if (number == 0) header[i] = cells[i]
      cell[table, number + 1, header[i]] = cells[i]
    }
    ++number
  }
  close(table ".csv")
  RS = "<"
  if (number == 0) fail("no table " table ".csv")
}

# What is seen must be the cell, or its number rounded: half a unit in the last place that is seen.
function compare(value, seen, where,   number, point, power, decimals, error) {
  if (seen == value) return
  if (value == "") {
    if (seen != "\342\200\223") fail(where ": an empty cell is shown as " seen)
    return
  }
  if (value ~ /^[+-]?inf/) {
    if (seen !~ /\342\210\236$/) fail(where ": " value " is shown as " seen)
    return
  }
  if (value !~ /^[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?$/) {
    fail(where ": " value " is shown as " seen)
    return
  }
  gsub(/\342\200\257/, "", seen)
  gsub(/\342\210\222/, "-", seen)
  if (!match(seen, /-?[0-9]+(\.[0-9]+)?(e-?[0-9]+)?/)) {
    fail(where ": no number in " seen)
    return
  }
  number = substr(seen, RSTART, RLENGTH)
  if ((substr(seen, 1, RSTART - 1) substr(seen, RSTART + RLENGTH)) ~ /[0-9]/) {
    fail(where ": more than a number in " seen)
  }
  power = 0
  if (match(number, /e/)) power = substr(number, RSTART + 1) + 0
  sub(/e.*/, "", number)
  point = index(number, ".")
  decimals = point ? length(number) - point : 0
  error = number * 10 ^ power - value
  if (error < 0) error = -error
  # 1e-9: what decimal numbers lose in double precision.
  if (error > (0.5 + 1e-9) * 10 ^ (power - decimals) + 1e-12 * (value < 0 ? -value : value)) {
    fail(where ": " value " is shown as " seen)
  }
}

function check_data(value, title, seen,   parts, table, place) {
  ++numbers
  if (split(title, parts, ", ") != 3 || parts[1] !~ /\.csv$/ || parts[2] !~ /^line [0-9]+$/) {
    fail("a number whose title is " title)
    return
  }
  table = substr(parts[1], 1, length(parts[1]) - 4)
  place = substr(parts[2], 6) + 0
  if (!(table in loaded)) load(table)
  if (!((table, place, parts[3]) in cell)) fail("no " title)
  else if (cell[table, place, parts[3]] != value) {
    fail(title " is " cell[table, place, parts[3]] ", not " value)
  }
  compare(value, seen, title)
}

# Digits that are neither a number's nor a paper's nor code must be part of a name or behind the word
# that they number.
function check_text(text,   before, number, after) {
  if (text ~ /[`^]|(^|[ (])\*[A-Za-z]/) fail("a sign that marks nothing: " text)
  before = ""
  while (match(text, /[0-9]+(\.[0-9]+)*/)) {
    number = substr(text, RSTART, RLENGTH)
    before = before substr(text, 1, RSTART - 1)
    after = substr(text, RSTART + RLENGTH)
    if (before !~ /[A-Za-z_0-9]$/ && !(number !~ /\./ && after ~ /^(st|nd|rd|th|D)([^a-z]|$)/) &&
        tolower(before) !~ numbered) {
      fail("a number that is in no table: " substr(before, length(before) - 40) number \
           substr(after, 1, 40))
    }
    before = before number
    text = after
  }
}

function check_tag(name, tag,   target, rest) {
  if (!(name in known)) fail("an element that the page does not need: " name)
  if (tag ~ / on[a-z]+ *=/) fail("a script: " tag)
  if (attribute(tag, "id") != "") {
    if (attribute(tag, "id") in ids) fail("twice the same id: " attribute(tag, "id"))
    ids[attribute(tag, "id")] = 1
  }
  if (tag ~ / (src|srcset|poster|data|action|background)=/ && \
      attribute(tag, "src") !~ /^data:image\/png;base64,/) fail("a request: " substr(tag, 1, 80))
  target = attribute(tag, "href")
  if (target ~ /^#/) wanted[substr(target, 2)] = 1
  else if (target != "" && (target !~ /^[A-Za-z0-9_.-]+\.(csv|svg)$/ || !exists(target))) {
    fail("a link to what is not here: " target)
  }
  rest = tag
  if (name == "svg") sub(/ xmlns="http:\/\/www\.w3\.org\/2000\/svg"/, "", rest)
  if (rest ~ /:\/\/|javascript:|url\(|@import/) fail("a request: " substr(rest, 1, 80))
  if (exempt["svg"] && rest ~ /[ "MLHVhvl](-?nan|-?inf)[ "MLHVhvl]/) fail("no place: " rest)
}

BEGIN {
  RS = "<"
  line = 1
  count = split("html head meta title style body main h1 h2 h3 nav ol li a section p em cite code " \
                "sup data figure figcaption div table thead tbody tr th td details summary b span " \
                "img svg path circle text tspan", list, " ")
  for (i = 1; i <= count; ++i) known[list[i]] = 1
  count = split("p td th li figcaption summary h1 h2 h3 caption", list, " ")
  for (i = 1; i <= count; ++i) block[list[i]] = 1
  count = split("data cite code svg style title", list, " ")
  for (i = 1; i <= count; ++i) is_exempt[list[i]] = 1
  numbered = "(figure|section|algorithm|listing|equation|theorem|table|level|claim)s? " \
             "([0-9][0-9.]*(,| and| to) )*$"
}

NR > 1 {
  end = index($0, ">")
  if (end == 0) fail("a < that begins no element")
  tag = substr($0, 1, end - 1)
  text = substr($0, end + 1)
  if (tag ~ /^!/) {
    if (tag != "!DOCTYPE html") fail("<" tag)
  } else if (tag ~ /^\//) {
    name = substr(tag, 2)
    if (depth == 0 || stack[depth] != name) fail("</" name "> ends <" stack[depth] ">")
    if (depth > 0) --depth
    if (name in is_exempt) --exempted
    if (name in is_exempt) --exempt[name]
    if (name == "data") check_data(value, title, plain(seen))
    if (name in block) {
      check_text(plain(words))
      words = ""
    }
  } else {
    name = tag
    sub(/[ \/].*/, "", name)
    check_tag(name, tag)
    if (tag ~ /Content-Security-Policy/ && tag ~ /default-src 'none'/) ++policies
    if (tag !~ /\/$/ && name != "meta" && name != "img") {
      stack[++depth] = name
      if (name in is_exempt) {
        ++exempted
        ++exempt[name]
      }
    }
    if (name == "data") {
      value = plain(attribute(tag, "value"))
      title = plain(attribute(tag, "title"))
      seen = ""
    }
    if (name in block) words = ""
  }
  if (exempt["style"] && text ~ /:\/\/|url\(|@import/) fail("a request in the style")
  if (exempt["data"]) seen = seen text
  else if (!exempted) {
    words = words text
    if (depth > 0 && !in_block() && text ~ /[0-9]/) fail("a number outside of all blocks: " text)
  }
  line += gsub(/\n/, "\n")
}

function in_block(   i) {
  for (i = 1; i <= depth; ++i) if (stack[i] in block) return 1
  return 0
}

END {
  if (depth != 0) fail("<" stack[depth] "> is not ended")
  if (policies != 1) fail("no policy against requests")
  for (id in wanted) if (!(id in ids)) fail("a link to #" id ", which is not here")
  if (numbers <= 100) fail("only " numbers + 0 " numbers")
  print numbers + 0 " numbers, " failures + 0 " faults"
  exit failures > 0
}
