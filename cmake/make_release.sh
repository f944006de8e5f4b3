#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Makes the files of a release from a finished build: Debian package, source archive, wheel, and their sums. The source
# archive holds the commit that is checked out. Refuses a build, or pages, of another version than the sources.
#
#   cmake/make_release.sh BUILD FOLDER
set -euo pipefail
[[ $# == 2 ]] || { sed -n '3,6s/^# \{0,1\}//p' "$0" >&2; exit 2; }
build=$(realpath "$1")
mkdir -p "$2"
folder=$(realpath "$2")
cd "$(dirname "$0")/.."
fail() { echo "make_release: $*" >&2; exit 1; }

version=$(sed -n 's/^project(polargrain VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
[[ "polargrain $version" == $("$build/app/polargrain" --version) ]] || fail "the build is not of version $version"
grep -qxF "version: $version" CITATION.cff || fail "CITATION.cff is not of version $version"
grep -qF "\"version\": \"$version\"" .zenodo.json || fail ".zenodo.json is not of version $version"
grep -qE "^## $version \([0-9-]+\)$" CHANGELOG.md || fail "CHANGELOG.md has no dated heading for version $version"
git diff --quiet HEAD || fail "there are changes that are not committed"
[[ -z $(ls -A "$folder") ]] || fail "$folder is not empty"

SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
export SOURCE_DATE_EPOCH
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
/usr/bin/python3 -B cmake/make_wheel.py "$build" "$folder" >/dev/null
cpack --config "$build/CPackConfig.cmake" -B "$work" >"$work/said" 2>&1 || { cat "$work/said"; fail "there is no Debian package"; }
mv "$work"/*.deb "$folder"
git archive --prefix="polargrain-$version/" -o "$folder/polargrain-$version.tar.gz" HEAD
(cd "$folder" && sha256sum polargrain* >"$work/sums" && mv "$work/sums" SHA256SUMS && cat SHA256SUMS)
