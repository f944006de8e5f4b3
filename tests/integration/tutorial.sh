#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Runs the commands of docs/tutorial.md as they stand there, in a folder of its own, and looks at what they made.
#
#   tests/integration/tutorial.sh POLARGRAIN SOURCE
set -euo pipefail
program=$(realpath "$1")
source=$(realpath "$2")
fail() { echo "FAILED: $*" >&2; exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/bin"
ln -s "$program" "$work/bin/polargrain"
export PATH="$work/bin:$PATH" POLARGRAIN_DATA=$source
cd "$work"

# Indented lines of the page are commands.
sed -n 's/^    \([a-z].*\)$/\1/p' "$source/docs/tutorial.md" >commands
grep -c '^polargrain ' commands | xargs -I N test N -ge 9 || fail "the page has lost its commands"
{ echo "set -euo pipefail"; sed 's/^polargrain .*/echo "-- &"; &/' commands; } >all.sh
bash all.sh || fail "a command of the tutorial"

cd afternoon
grep -q '^friction,' fit/parameters.csv || fail "no friction was found"
# last FILE COLUMN ROW: a value of a table, rows from 1 behind the head; $ the last one.
value() { awk -F, -v name="$2" -v row="$3" 'NR == 1 { for (k = 1; k <= NF; ++k) if ($k == name) c = k } NR == row + 1 { print $c }' "$1"; }
near() { awk -v a="$1" -v b="$2" -v t="$3" 'BEGIN { d = a - b; if (d < 0) d = -d; exit !(d <= t * (b < 0 ? -b : b)) }'; }
# 2 m2 of ground of 16 kN/m3 on the base, step 4; 2 m of a surcharge of 20 kPa more at the end. Balance to 1e-6 of the loads.
near "$(value gravity/history.csv base_force 5)" 32000 1e-5 || fail "the base carries $(value gravity/history.csv base_force 5) N/m"
near "$(value gravity/history.csv base_force 9)" 72000 1e-5 || fail "the base carries $(value gravity/history.csv base_force 9) N/m"
# Before it moves the wall carries the pressure of the packing on 0.5 m and the half of an edge of the side below.
[[ $(wc -l <cells/history.csv) == 12 ]] || fail "ten steps were to be made: $(wc -l <cells/history.csv)"
near "$(value cells/history.csv shift 11)" 0.02 1e-9 || fail "the wall has gone $(value cells/history.csv shift 11) m"
awk -v a="$(value cells/history.csv earth_pressure 1)" -v b="$(value cells/history.csv earth_pressure 11)" \
  'BEGIN { exit !(a > 90e3 && a < 130e3 && b > 1.5 * a) }' || fail "the earth does not resist the wall"
[[ -s cells/report.html ]] || fail "there is no report"
