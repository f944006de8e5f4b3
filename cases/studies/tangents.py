#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Does a secant do in place of a tangent? Iterations and processor time with `tangent: secant`, beside `condensed`.

usage: tangents.py [--packings N] [--output DIR] [--programs DIR]
Each packing of each scene is run with both, one after the other, with one worker. Half an hour of one core.
"""
import argparse
import csv
import json
import pathlib
import re
import resource
import sys

from intervals import shown
from runs import ROOT, Failed, Programs

SCENES = {
    "discs, sliding": ["biaxial", "--grains", "200", "--elements", "4", "8"],
    "discs, rolling": ["biaxial", "--grains", "200", "--elements", "4", "8", "--rolling"],
    "discs, footing": ["footing"],
    "spheres in space": ["triaxial3d", "--grains", "200", "--elements", "1", "2"],
}
TANGENTS = ["condensed", "secant"]


def runs_of(programs, scene, seed, place):
    """Both runs of a packing. @returns summaries by tangent"""
    case = place / f"{scene.replace(', ', '-').replace(' ', '-')}-{seed}"
    log = place / f"{case.name}.log"
    polargrain = programs.find("polargrain")
    if not (case / "packing.h5").exists():
        programs.call(log, polargrain, "new", *SCENES[scene], "--scheme", "cell", "--no-pack", "-o", case)
        specification = case / "packing.yaml"
        specification.write_text(re.sub(r"(?m)^seed: .*", f"seed: {seed}", specification.read_text()))
        programs.call(log, polargrain, "pack", specification, "-o", case / "packing.h5")
    material = re.search(r"(?m)^  (\w+):\n    model: cell", (case / "case.yaml").read_text()).group(1)
    summaries = {}
    for tangent in TANGENTS:
        result = case / tangent
        seconds = result / "processor_seconds"
        if not seconds.exists():
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            programs.call(log, polargrain, "run", case / "case.yaml", "--set", f"materials.{material}.tangent={tangent}",
                          "-w", "1", "--quiet", "-o", result)
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            seconds.write_text(str(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime))
        summaries[tangent] = json.loads((result / "summary.json").read_text())
        summaries[tangent]["processor"] = float(seconds.read_text())
    return summaries


def row(scene, found):
    """@param found summaries by tangent, one a packing"""
    def figures(tangent, figure):
        return [figure(one[tangent]) for one in found]

    def ratios(figure):
        return [figure(one["secant"]) / figure(one["condensed"]) for one in found]

    def iterations(one):
        return one["iterations"] / one["steps_committed"]

    return [scene, len(found), *(shown(figures(tangent, iterations), 1) for tangent in TANGENTS),
            shown(ratios(lambda one: one["cells"]["evaluations"]), 2), shown(ratios(lambda one: one["processor"]), 2)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--packings", type=int, default=5)
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("tangents"))
    parser.add_argument("--programs", type=pathlib.Path, action="append")
    given = parser.parse_args()
    programs = Programs(given.programs)
    place = given.output.resolve()
    place.mkdir(parents=True, exist_ok=True)
    rows = [["scene", "n", *(f"iterations a step, {tangent}" for tangent in TANGENTS), "evaluations, ratio", "processor time, ratio"]]
    for scene in SCENES:
        found = []
        for seed in range(1, given.packings + 1):
            try:
                found.append(runs_of(programs, scene, seed, place))
            except Failed as failed:
                print(f"{scene}, packing {seed}: {failed}", file=sys.stderr)
        if found:
            rows.append(row(scene, found))
            print(" | ".join(map(str, rows[-1])), flush=True)
    with open(ROOT / "docs/data/performance/tangents.csv", "w", encoding="utf-8", newline="") as text:
        text.write("# command: cases/studies/tangents.py\n# machine: any\n")
        csv.writer(text, lineterminator="\n").writerows(rows)


if __name__ == "__main__":
    main()
