#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""A layer of grains sheared between rough plates: the experiment that a cell cannot make, and its band.

    python3 layer.py -o RESULTS [--grains 1600] [--seed 1] [--rolling 0.2] [--shear 0.15] [--programs FOLDER...]

A square periodic packing of so many discs (or --packing FILE), opened above and below: the outermost grains, three radii deep,
are glued to two rough plates; the sides stay periodic; the normal stress is that of the packing. RESULTS: history.csv,
grains/step-*.dump, log.txt. What is there already is not made again.
"""
import argparse
import math
import pathlib
import re
import sys

from runs import ROOT, Failed, Programs

PLATE = 0.015  # m; three mean radii
SPECIFICATION = ("title: {grains} dense discs\ngrains: {grains}\nsizes: {{law: uniform, radius: [3 mm, 7 mm]}}\ndensity: 2650\n"
                 "thickness: 100 mm\nscript: cells/hooke_radii.in\npressure: 100 kPa\nfriction: 0\nseed: {seed}\n")


def run(command, log, folder=None):
    try:
        Programs().call(log, *command, folder=folder)
    except Failed as failure:
        sys.exit(str(failure))


def make_packing(polargrain, grains, seed, packing):
    if packing.exists():
        return
    specification = packing.with_suffix(".yaml")
    specification.write_text(SPECIFICATION.format(grains=grains, seed=seed), encoding="utf-8")
    run([polargrain, "pack", specification.name, "-o", packing.name, "--quiet"], packing.with_suffix(".log"), packing.parent)


def open_packing(polargrain, packing, data):
    """Writes the grains in a box with room above and below. @returns the heights where the plates begin, m"""
    export = data.with_suffix(".periodic")
    run([polargrain, "pack", packing, "--export", export], data.with_suffix(".log"))
    text = export.read_text(encoding="utf-8")
    bounds = {axis: [float(x) for x in re.search(rf"(\S+) (\S+) {axis}lo {axis}hi", text).groups()] for axis in "xyz"}
    bottom, top = bounds["y"]
    room = 0.3 * (top - bottom)
    text = re.sub(r"\S+ \S+ ylo yhi", f"{bottom - room:.17g} {top + room:.17g} ylo yhi", text)
    data.write_text(text, encoding="utf-8")
    export.unlink()
    return bottom + PLATE, top - PLATE


def shear(polargrain, liggghts, packing, place, rolling, amount, rate=0.12, frame=0.005):
    """Shears the layer by `amount` (displacement over height). What is there already is not made again."""
    if (place / "done").exists():
        return
    (place / "grains").mkdir(parents=True, exist_ok=True)
    low, high = open_packing(polargrain, packing, place / "layer.data")
    step = 1.2e-5  # s, about; frames are those of the script's own step
    row_steps = max(1, round(frame / (rate * step) / 10))
    command = [liggghts, "-in", "layer.in", "-log", "none", "-var", "data", (place / "layer.data").resolve(), "-var", "folder",
               place.resolve(), "-var", "low", low, "-var", "high", high, "-var", "steps", 10 * row_steps, "-var", "row_steps",
               row_steps, "-var", "frames", math.ceil(amount / frame), "-var", "rate", rate, "-var", "rolling", rolling]
    if rolling == 0.0:
        command += ["-var", "rolling_model", "off"]
    run(command, place / "log.txt", ROOT / "liggghts_inputs/specimen")
    (place / "done").touch()


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("-o", "--output", type=pathlib.Path, required=True)
    arguments.add_argument("--packing", type=pathlib.Path)
    arguments.add_argument("--grains", type=int, default=1600)
    arguments.add_argument("--seed", type=int, default=1)
    arguments.add_argument("--rolling", type=float, default=0.2)
    arguments.add_argument("--shear", type=float, default=0.15)
    arguments.add_argument("--rate", type=float, default=0.12, help="1/s [0.12: inertial number 2e-4]")
    arguments.add_argument("--programs", type=pathlib.Path, nargs="+", metavar="FOLDER")
    options = arguments.parse_args()
    options.output.mkdir(parents=True, exist_ok=True)
    programs = Programs(options.programs)
    polargrain, liggghts = programs.find("polargrain"), programs.find("polargrain-liggghts")
    packing = options.packing or options.output / "packing.h5"
    if not options.packing:
        make_packing(polargrain, options.grains, options.seed, packing)
    shear(polargrain, liggghts, packing, options.output, options.rolling, options.shear, options.rate)


if __name__ == "__main__":
    main()
