#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Makes manual pages of what a program says under --help: one of the program, one of each command.
#
#   cmake/make_manual.sh PROGRAM FOLDER
set -euo pipefail
program=$1
folder=$2
name=$(basename "$program")
version=$("$program" --version | sed 's/^[^ ]* //')
rm -rf "$folder"
mkdir -p "$folder"

# Text that groff would take for a request or a hyphen stands for itself.
safe() { sed -e 's/\\/\\e/g' -e 's/-/\\-/g' -e "s/^\([.']\)/\\\\\&\1/"; }
heading() { echo ".SH $1"; }
as_it_stands() { echo .nf; safe; echo .fi; }

# page NAME SUMMARY HELP: a help is text, a line "Usage: ...", sections "Options:" and the like, an epilogue.
page() {
  local help=$3
  echo ".TH $(tr '[:lower:]' '[:upper:]' <<<"$1" | safe) 1 \"\" \"$name $version\" \"User commands\""
  heading NAME
  echo "$(safe <<<"$1") \\- $(safe <<<"$2")"
  heading SYNOPSIS
  sed -n 's/^Usage: //p' <<<"$help" | safe
  heading DESCRIPTION
  sed '/^Usage: /,$d' <<<"$help" | as_it_stands
  sed '1,/^Usage: /d' <<<"$help" | safe | awk '
    function begin(name) { if (open) print ".fi"; print ".SH " name "\n.nf"; open = 1 }
    /^(Positionals|Options|Subcommands):$/ { begin(toupper(substr($0, 1, length($0) - 1))); next }
    /^Try:$/ { begin("EXAMPLES"); next }
    open { print }
    END { if (open) print ".fi" }'
  heading "SEE ALSO"
  echo "The documentation, in share/doc/polargrain; its beginning is docs/README.md."
}

help=$("$program" --help)
page "$name" "granular materials on two scales" "$help" >"$folder/$name.1"
# "  run                         Run a case": the name, and the first line of what it does.
sed -n '/^Subcommands:/,/^$/p' <<<"$help" | sed -nE 's/^  ([a-z]+) +([^ ].*)$/\1 \2/p' | while read -r command summary; do
  page "$name-$command" "${summary%.}" "$("$program" "$command" --help)" >"$folder/$name-$command.1"
done
