#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Runs ctest on a machine that is made busy: no test's verdict may depend on how fast the machine is.
#
#   tests/busy.sh [-n LOOPS] [-c] [-r TIMES] [CTEST ARGUMENTS...]
#     -n LOOPS   so many endless loops beside the tests [8]
#     -c         tests and loops share one core
#     -r TIMES   each test so many times, until it fails [1]
#
#   tests/busy.sh                        all tests of the preset `release` beside eight loops
#   tests/busy.sh -c -r 10 -L faults     those of faults ten times, on a ninth of a core
set -euo pipefail
cd "$(dirname "$0")/.."

loops=8 times=1
declare -a where=()
# Not `getopts`: it would refuse ctest's own options, which follow these.
while (($#)); do
  case $1 in
    -n) loops=${2:?-n asks for a number of loops}; shift 2 ;;
    -c) where=(taskset -c 0); shift ;;
    -r) times=${2:?-r asks for a number of times}; shift 2 ;;
    -h | --help) sed -n '3,11s/^# \{0,1\}//p' "$0"; exit ;;
    *) break ;;
  esac
done

# A loop ends with this script, however that ends.
busy='while [[ -d /proc/$0 ]]; do for ((k = 0; k < 100000; ++k)); do :; done; done'
for ((k = 0; k < loops; ++k)); do "${where[@]}" bash -c "$busy" $$ & done
trap 'kill $(jobs -p) 2>/dev/null || true' EXIT
"${where[@]}" ctest --preset release --repeat "until-fail:$times" "$@"
