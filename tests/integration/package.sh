#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Makes the Debian package and looks into it: it holds what cmake --install puts into place (tests/integration/install.sh
# uses that), needs the packages whose libraries the programs load, and its programs run where it is unpacked.
#
#   tests/integration/package.sh BUILD
set -euo pipefail
build=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

fail() { echo "FAILED: $*" >&2; exit 1; }

cpack --config "$build/CPackConfig.cmake" -B made >made.said || { cat made.said; fail "there is no package"; }
package=$(echo made/polargrain_*.deb)
dpkg-deb -x "$package" unpacked
DESTDIR=$work/installed cmake --install "$build" --prefix /usr >/dev/null
files_of() { (cd "$1" && find . ! -type d | sort); }
diff <(files_of installed) <(files_of unpacked) || fail "the package and cmake --install differ"

# Whatever library a program asks for is of a package that the package depends on, by its name or one that it provides.
depends=$(dpkg-deb -f "$package" Depends | tr ',' '\n' | awk '{ print $1 }')
for file in unpacked/usr/bin/* unpacked/usr/lib/polargrain/* $(find unpacked -name "_cells*.so"); do
  for library in $(readelf -d "$file" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p'); do
    path=$(ldd "$file" | awk -v name="$library" '$1 == name { print $3 }')
    [[ -n $path ]] || continue  # the dynamic linker itself, of libc6
    path=$(realpath "$path")  # some packages name it without the /usr that /lib leads to
    owner=$({ dpkg -S "$path" || dpkg -S "${path#/usr}"; } 2>/dev/null | cut -d: -f1)
    names=$(dpkg-query -W -f '${Package},${Provides}' "$owner" | tr ',' '\n' | awk '{ print $1 }')
    grep -qxF "$names" <<<"$depends" || fail "$file needs $library of $owner; the package depends on" $depends
  done
done

echo "polargrain $(dpkg-deb -f "$package" Version)" | cmp - <(unpacked/usr/bin/polargrain --version) || fail "another version"
if [[ -d unpacked/usr/lib/python3 ]]; then
  PYTHONPATH=unpacked/usr/lib/python3/dist-packages /usr/bin/python3 -B -c '
import polargrain
assert polargrain.program.program() == "'"$work"'/unpacked/usr/bin/polargrain", polargrain.program.program()
polargrain.Cell("cases/biaxial/packing400.csv", "cells/hooke_radii.in").step([[1, 0], [0, 0.9999]])
' || fail "the unpacked Python package does not step a cell"
fi
unpacked/usr/bin/polargrain check cases/slope/case.yaml >/dev/null || fail "the unpacked program does not find its cases"
