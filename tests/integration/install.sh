#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Installs into a folder of its own, hides the source tree where this user may (else trusts that no file names it),
# and uses what was installed as a user would from another folder: run, check, pack, bench, point, and a contact law of
# the user's own (docs/own_contact_law) built against the CMake package and taken by cells, pack, specimens, replays
# and polargrain-liggghts.
#
#   tests/integration/install.sh SOURCE BUILD
set -euo pipefail
source=$(realpath "$1")
build=$(realpath "$2")

say() { echo "$(printf %3d $SECONDS) s $*"; }
fail() { echo "FAILED: $*" >&2; exit 1; }
same() { cmp "$1" "$2" || fail "$3"; }
# refused STATUS WORDS COMMAND...: the command ends with this status and says these words.
refused() {
  local wanted=$1 words=$2 status=0
  shift 2
  "$@" >said 2>&1 || status=$?
  ((status == wanted)) || { cat said; fail "status $status in place of $wanted: $*"; }
  grep -qF -- "$words" said || { cat said; fail "nothing said of '$words': $*"; }
}

# The part that needs the source tree; the rest runs when it is out of sight.
if [[ ${3:-} != hidden ]]; then
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
  cmake --install "$build" --prefix "$work/prefix" >/dev/null
  small=(--set steps.count=2 --set mesh.rectangle.elements=[1,2] --quiet)
  (cd "$work" && "$build/app/polargrain" run cases/biaxial/case.yaml -o as_built -w 2 "${small[@]}")
  if grep -rlF "$source" "$work/prefix"; then fail "these installed files name the source tree"; fi
  cp "$0" "$work/install.sh"
  cd "$work"
  if unshare -m true 2>/dev/null; then
    unshare -m bash -c 'mount -t tmpfs none "$1" && exec bash ./install.sh "$1" "$2" hidden' - "$source" / ||
      exit 1
  else
    echo "the source tree cannot be hidden here"
    bash ./install.sh "$source" "$build" hidden
  fi
  exit
fi

work=$PWD
small=(--set steps.count=2 --set mesh.rectangle.elements=[1,2] --quiet)
export PATH="$work/prefix/bin:$PATH"
mkdir -p elsewhere
cd elsewhere

say "-- a run from another folder"
polargrain run cases/biaxial/case.yaml -w 2 "${small[@]}"
same results/biaxial/history.csv ../as_built/history.csv "the installed program gives another history"
polargrain verify results/biaxial -w 2 | grep -x "all agrees" || fail "the run of the installed program is not verified"
polargrain check cases/slope/case.yaml >/dev/null  # its mesh needs the module for Gmsh

if [[ -d ../prefix/lib/python3 ]]; then
  say "-- Python, and the cell as a behaviour of other codes"
  printf 'script: cells/hooke_radii.in\npacking: cases/biaxial/packing400.csv\n' >cell.yaml
  PYTHONPATH=../prefix/lib/python3/dist-packages POLARGRAIN_CELL=cell.yaml /usr/bin/python3 -B -c '
import ctypes, pathlib, polargrain
prefix = pathlib.Path("../prefix").resolve()
assert polargrain.program.program() == str(prefix / "bin/polargrain"), polargrain.program.program()
polargrain.Cell("cases/biaxial/packing400.csv", "cells/hooke_radii.in").step([[1, 0], [0, 0.9999]])
library = ctypes.CDLL(str(prefix / "lib/polargrain/libPolargrainCell.so"))
# An array of three extents, whose product has room for 400 discs: the file of the cell was found, and what it names.
kind = ctypes.c_int.in_dll(library, "PolargrainCell_InternalStateVariablesTypes").value
assert (kind >> 6 & 127) * (kind >> 13 & 127) * (kind >> 20 & 127) > 10000, kind
' || fail "the installed Python package or behaviour does not work"
fi

say "-- manual, completion, examples"
for page in polargrain polargrain-run polargrain-examples; do
  man=$work/prefix/share/man/man1/$page.1
  [[ -s $man ]] || fail "there is no manual page $page"
  ! command -v groff >/dev/null || [[ -z $(groff -man -Tutf8 -wall -z "$man" 2>&1) ]] || fail "groff has something to say of $man"
done
grep -qF '\-\-resume' "$work/prefix/share/man/man1/polargrain-run.1" || fail "the manual of run does not know --resume"
# completed WORD...: what is proposed for the last of the words.
completed() {
  bash -c 'source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _polargrain; echo "${COMPREPLY[*]}"' - \
    "$work/prefix/share/bash-completion/completions/polargrain" "$@"
}
[[ $(completed polargrain ch) == check ]] || fail "ch is not completed: $(completed polargrain ch)"
[[ $(completed polargrain run --res) == --resume ]] || fail "--res is not completed: $(completed polargrain run --res)"
[[ $(completed polargrain examples slo) == slope ]] || fail "slo is not completed: $(completed polargrain examples slo)"
[[ -z $(completed polargrain run ca) ]] || fail "files are not left to bash"
polargrain examples >said
grep -q '^  biaxial  *Biaxial compression' said || fail "the example biaxial is not listed"
polargrain examples slope -o my_slope >/dev/null
polargrain check my_slope/case.yaml >/dev/null
refused 2 "did you mean 'slope'?" polargrain examples slop
refused 2 "is there already" polargrain examples slope -o my_slope

say "-- bench"
polargrain bench cases/biaxial/case.yaml --quick -w 2 --set steps.count=1 --set mesh.rectangle.elements=[1,1] --quiet >/dev/null
grep -q reference bench-results/bench.csv || fail "bench made no table"

say "-- a contact law of the user's own"
cp -r ../prefix/share/doc/polargrain/docs/own_contact_law law
# A second one beside it, that takes the name of another law.
cp -r law taken
sed -i 's|hooke/stiffening, 40|hooke/radii, 40|' taken/normal_hooke_stiffening.hpp
build_law() { cmake -G Ninja -S $1 -B $1/build -DCMAKE_BUILD_TYPE=$2 -DCMAKE_PREFIX_PATH="$work/prefix" && cmake --build $1/build; }
build_law taken Debug >taken.said 2>&1 &
build_law law Release >law.said 2>&1 || { cat law.said; fail "the law is not built"; }
wait $! || { cat taken.said; fail "the law with the name of another one is not built"; }
library=law/build/own_contact_law.so

polargrain-liggghts -contact "$library" -in law/two_grains.in -log none >said
# 900 N by hand; the engine prints the variable with six digits and more.
awk '/^force/ { found = 1; if ($2 < 900 * (1 - 1e-9) || $2 > 900 * (1 + 1e-9)) exit 1 } END { if (!found) exit 1 }' said ||
  { grep '^force' said; fail "two grains do not push each other with 900 N"; }

say "-- a packing made under it"
# Without stiffening the law is the stock one: all that follows has the same bits under both.
for law in stock own; do
  cat >$law.pack.yaml <<SPECIFICATION
grains: 40
sizes: {law: uniform, radius: [3 mm, 7 mm]}
density: 2650
thickness: 100 mm
script: cells/hooke_radii.in
pressure: 100 kPa
friction: 0.2
seed: 1
SPECIFICATION
done
sed -i "s|^script: .*|script: law/cells.in\ncontact_library: $library|" own.pack.yaml
refused 2 "own.pack.yaml:6: packing: contact_library: '$library' is a program" polargrain pack own.pack.yaml -o own.h5
for law in stock own; do
  polargrain pack $law.pack.yaml -o $law.h5 --quiet --trust-scripts >/dev/null
  polargrain pack $law.h5 --export $law.data >/dev/null
done
same stock.data own.data "a packing made under the law differs from one made under the stock law"

say "-- cells under it"
for law in stock own; do
  sed "s|packing400.csv|$law.h5|" ../prefix/share/polargrain/cases/biaxial/case.yaml >$law.yaml
done
sed -i "s|^    packing: .*|&\n    contact_library: $library|; s|cells/hooke_radii.in|law/cells.in|" own.yaml
cat >path.csv <<'PATH_OF_STRAIN'
h11,h12,h21,h22,w,k1,k2
5e-4,0,0,-1e-3,0,0,0
0,1e-3,0,0,0,0,0
0,0,0,-1e-3,0,0,0
PATH_OF_STRAIN
for law in stock own; do
  polargrain point $law.yaml sand path.csv -o $law.csv --replay $law.replay --set materials.sand.loop=engine --trust-scripts
  polargrain run $law.yaml -o results/$law -w 2 "${small[@]}" --set materials.sand.loop=engine --trust-scripts
done
same stock.csv own.csv "the law without stiffening is not the stock law"
same results/stock/history.csv results/own/history.csv "a run under the law without stiffening is not one under the stock law"
refused 2 "own.yaml:16: material 'sand': contact_library: '$library' is a program" polargrain verify results/own
polargrain verify results/own --trust-scripts | grep -x "all agrees" || fail "a run under the law is not verified"
# So is its replay, which names the library.
command=$(sed -n 's/^#   \(polargrain-liggghts .*\)/\1/p' own.replay/in.replay)
(cd own.replay && $command -log none >said)
grep '^ *cell: increment' own.replay/README.md | sed 's/^ *//' >expected
sed -n '/^cell: increment/s/ unbalanced.*//p' own.replay/said | diff - expected || fail "the replay of the law gives other digits"
# With it the same overlaps carry more than the pressure that the packing was made under, which is told.
sed '/stiffening /s/1 0$/1 500/' law/cells.in >stiffer.in
refused 1 "carries 582.78 kPa" \
  polargrain point own.yaml sand path.csv --set materials.sand.script=stiffer.in --trust-scripts

say "-- a specimen under it"
for law in stock own; do cp -r ../prefix/share/polargrain/liggghts_inputs/specimen $law.specimen; done
# Both in LIGGGHTS's own loop: a law of the user's own has no kernels.
sed -i '/^suffix/d' stock.specimen/seating.in
sed -i 's|^pair_style .*|pair_style gran model hooke/radii tangential history|' stock.specimen/material.in
sed -i 's|^pair_style .*|fix stiffening all property/global stiffening peratomtypepair 1 0\npair_style gran model hooke/stiffening tangential history|' \
  own.specimen/material.in
# The grains of the packing in a box with room around them, as specimen.py cuts them.
sed -E '/xy xz yz/d; s/^.* ([xy]lo [xy]hi)$/-0.05 0.15 \1/' stock.data >specimen.data
for law in stock own; do
  mkdir $law.specimen/restart
  (cd $law.specimen && polargrain-liggghts -contact "../$library" -in seating.in -var data ../specimen.data -var steps 200 -log none >said)
  # Rows of the history, without the seconds that the engine tells between them.
  grep -E '^ +[0-9]+ ' $law.specimen/said >$law.rows
done
(($(wc -l <own.rows) >= 3)) || fail "the specimen has no history"
same stock.rows own.rows "a specimen under the law without stiffening is not one under the stock law"

say "-- what goes wrong is said"
trusted=(polargrain check own.yaml --trust-scripts --set)
refused 2 "there is no file 'missing.so'" "${trusted[@]}" materials.sand.contact_library=missing.so
refused 2 "is no shared library" "${trusted[@]}" materials.sand.contact_library=path.csv
refused 1 "it is no library of contact laws" polargrain point own.yaml sand path.csv --trust-scripts \
  --set materials.sand.contact_library=../prefix/lib/polargrain/polargrain_gmsh.so
refused 2 "there is no such file" polargrain-liggghts -contact missing.so -in law/two_grains.in -log none
version=$(polargrain --version | sed 's/^[^ ]* //')
sed "s/${version//./\\.}/${version%?}x/" "$library" >older.so  # as long as it was
refused 1 "it was built for polargrain ${version%?}x" polargrain run own.yaml -w 1 "${small[@]}" --trust-scripts \
  --set materials.sand.contact_library=older.so
refused 2 "another law is called hooke/radii already" \
  polargrain-liggghts -contact taken/build/own_contact_law.so -in law/two_grains.in -log none
echo "all well"
