#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Pictures of the program's pages and of the documentation's for docs/gallery.md, taken by chromium without a window:
#   docs/make_screenshots.sh POLARGRAIN      from the root of the project, with chromium and mkdocs; two minutes on two cores
set -euo pipefail
polargrain=$(realpath "$1")
images=$(realpath docs/images)
source=$PWD
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# picture NAME WIDTH HEIGHT FILE [OPTION...]: in a frame, since no window of chromium is narrower than 500 pixels.
picture() {
  echo "<body style='margin:0'><iframe src='file://$4' style='border:0;width:$2px;height:$3px'></iframe>" >frame.html
  chromium --headless --no-sandbox --disable-gpu --hide-scrollbars --virtual-time-budget=5000 "--window-size=$2,$3" "${@:5}" \
    "--screenshot=$images/$1.png" "file://$PWD/frame.html" 2>/dev/null
}
# widths NAME HEIGHT FILE: as a wide window, a narrow one and a telephone show a page, side by side at 0.6 of their size.
widths() {
  local left=0 width
  echo "<body style='margin:0;background:#888'>" >frame.html
  for width in 1200 800 420; do
    echo "<iframe src='file://$3' style='border:0;width:${width}px;height:$2px;position:absolute;top:0;left:${left}px;transform:scale(0.6);transform-origin:0 0'></iframe>" >>frame.html
    left=$((left + width * 6 / 10 + 10))
  done
  chromium --headless --no-sandbox --disable-gpu --hide-scrollbars --virtual-time-budget=8000 "--window-size=$((left - 10)),$(($2 * 6 / 10))" \
    "--screenshot=$images/$1.png" "file://$PWD/frame.html" 2>/dev/null
}
cd "$work"
"$polargrain" run "$source/cases/biaxial/case.yaml" -o result --quiet --set "title=Biaxial compression of 32 boxes of 400 grains between rough plates" --set mesh.rectangle.elements=[2,4] --set materials.sand.lc=80mm --set output.every=1
"$polargrain" report result >/dev/null
widths report 1500 "$work/result/report.html"
picture report_narrow_dark 420 1100 "$work/result/report.html" --blink-settings=preferredColorScheme=0
"$polargrain" check "$source/cases/tutorial/gravity.yaml" --picture check.html >/dev/null
picture check 1000 860 "$work/check.html"
"$polargrain" element "$source/cases/element_tests/unloading.yaml" -o element --quiet
widths element 1300 "$work/element.html"
known="$source/cases/element_tests/known_sand"
"$polargrain" calibrate "$known/curve.csv" "$known/spec.yaml" -o fit --quiet
widths calibration 1300 "$work/fit/calibration.html"
"$polargrain" bench "$source/cases/footing_cells/case.yaml" -o bench --quick --set steps.count=2 >/dev/null
widths bench 1500 "$work/bench/bench.html"
"$source/cmake/make_site.py" "$source" "$work/site" >/dev/null
picture site 1200 800 "$work/site/site/docs/tutorial.html"
