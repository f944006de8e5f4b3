#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Makes the wheel, installs it into a virtual environment, and uses it from an empty folder with nothing else in the
# environment: the package finds its programs, these find their scripts, cases and modules, and pip removes all of it.
# Ends with status 77 (skipped) where there is no such Python.
#
#   tests/integration/wheel.sh BUILD
set -euo pipefail
build=$(realpath "$1")
python=/usr/bin/python3
$python -c "import ensurepip, numpy, venv" 2>/dev/null || { echo "skipped: there is no $python with venv and numpy"; exit 77; }
make=$(dirname "$(realpath "$0")")/../../cmake/make_wheel.py
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

fail() { echo "FAILED: $*" >&2; exit 1; }

wheel=$($python -B "$make" "$build" made)
cp "$wheel" first.whl
[[ $($python -B "$make" "$build" made) == "$wheel" ]] && cmp first.whl "$wheel" || fail "the same build gives another wheel"

$python -m venv --system-site-packages venv
in_environment() { (cd empty && env -i HOME="$work/home" PATH="$work/venv/bin:/usr/bin:/bin" "$@"); }
pip() { in_environment "$work/venv/bin/python" -m pip --disable-pip-version-check "$@"; }
files_of() { find venv ! -type d ! -path "*/site-packages/pip/*" | sort; }  # pip leaves empty folders
mkdir empty home
files_of >before
pip install --quiet --no-index --no-deps "$work/$wheel"
if pip check | grep "^polargrain "; then fail "the package needs what is not there"; fi  # others of the system may be broken

in_environment python -c '
import importlib.metadata, os, polargrain
assert polargrain.__file__.startswith("'"$work"'/venv/"), polargrain.__file__
assert polargrain.program.program() == "'"$work"'/venv/bin/polargrain", polargrain.program.program()
about = importlib.metadata.metadata("polargrain")
assert about["Version"] == polargrain.__version__ and about["License"] == "GPL-2.0-or-later", about
assert all(file.locate().is_file() for file in importlib.metadata.files("polargrain"))
answer = polargrain.Cell("cases/biaxial/packing400.csv", "cells/hooke_radii.in").step([[1, 0], [0, 0.9999]])
assert answer.stress[1, 1] < -100e3, answer.stress
' || fail "the package does not step a cell"
version=$(in_environment python -c 'import polargrain; print(polargrain.__version__)')
[[ $(in_environment polargrain --version) == "polargrain $version" ]] || fail "the program is not of version $version"
in_environment polargrain check cases/slope/case.yaml >/dev/null || fail "the program does not find its module for Gmsh"
in_environment polargrain-liggghts -log none </dev/null >/dev/null || fail "polargrain-liggghts does not start"

small=(--set steps.count=2 --set mesh.rectangle.elements=[1,2] --quiet)
in_environment polargrain run cases/biaxial/case.yaml -o results -w 2 "${small[@]}"
(cd empty && "$build/app/polargrain" run cases/biaxial/case.yaml -o as_built -w 2 "${small[@]}")
cmp empty/{results,as_built}/history.csv || fail "the program of the wheel gives another history"

pip uninstall --quiet --yes polargrain
files_of | diff before - || fail "pip leaves something behind"
