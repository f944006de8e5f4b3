#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Checks of the code and of the pages by tools. Ends with status 77 (skipped) where the tool is not installed.
#
#   tests/style.sh format [--fix]     clang-format, all files
#   tests/style.sh tidy [FOLDER...]   clang-tidy: all but the grains, or these folders (half an hour on two cores)
#   tests/style.sh pages              doxygen: comments without warnings; pages in build/doxygen/html
#   tests/style.sh words [PAGE...]    Markdown: long sentences, clauses without a subject, words in all
#   tests/style.sh links [PAGE...]    Markdown: dead links, pages that README.md does not lead to
#   tests/style.sh comments           comments and texts of the sources: clauses without a subject
#   tests/style.sh paper              docs/paper: sections, words and references that JOSS asks for
#   tests/style.sh made               docs: pages of figures are as their commands write them
#   tests/style.sh keys               Markdown: keys, commands and options that the reference leaves out
#   tests/style.sh includes           sources: includes that run upwards between folders
#   tests/style.sh names              sources: names that two files of a library hide, which cannot be compiled as one
#   tests/style.sh figures            README, settings, recipes: numbers that no command, code or test gives
set -euo pipefail
cd "$(dirname "$0")/.."

need() { command -v "$1" >/dev/null || { echo "skipped: there is no $1"; exit 77; }; }
sources() { find app band bench common coupler dem element fem grains_io python tests \( -name '*.cpp' -o -name '*.hpp' \) | sort; }

case "${1:-}" in
  format)
    need clang-format
    if [[ ${2:-} == --fix ]]; then
      sources | xargs clang-format -i
    else
      sources | xargs clang-format --dry-run -Werror
    fi
    ;;
  tidy)
    need clang-tidy
    # Precompiled headers are g++'s: clang reads the headers themselves, once for all files that are compiled as one.
    commands=$(mktemp -d)
    trap 'rm -rf "$commands"' EXIT
    cmake --preset release -B "$commands" >/dev/null
    sed -i 's/ -Winvalid-pch//g; s/ -include [^ ]*cmake_pch\.hxx//g' "$commands/compile_commands.json"
    folders=("${@:2}")
    ((${#folders[@]})) || folders=(app band common coupler element fem grains_io)
    # Warnings and parameters that g++ knows and clang does not are in the compile commands. The count of what was found in
    # headers of others is not shown.
    find "${folders[@]/#/$commands/}" -name 'unity_*.cxx' | sort | xargs -P 2 -n 1 clang-tidy -p "$commands" --quiet \
      --config-file=.clang-tidy --warnings-as-errors='*' --extra-arg=-Wno-unknown-warning-option \
      --extra-arg=-Wno-unused-command-line-argument 2>/dev/null
    ;;
  pages)
    need doxygen
    mkdir -p build
    doxygen docs/Doxyfile
    ;;
  words | links | comments | keys | paper | made)
    need python3
    python3 -B tests/pages.py "$@"
    ;;
  figures | includes | names)
    need python3
    python3 -B "tests/$1.py"
    ;;
  *)
    sed -n '3,18s/^# \{0,1\}//p' "$0" >&2
    exit 2
    ;;
esac
