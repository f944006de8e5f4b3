#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Earth pressure of ground of grains on a smooth wall, active and passive, over packings, internal lengths and meshes.

    python3 wall.py -o RESULTS [--packings 5] [--program build/release/app/polargrain]

K is the force on the wall over that of the vertical stress. Rankine's is that of the friction of the same packing in a biaxial test
under the mean stress: the mobilised angle, largest and at 5 % of strain. What is there already is not run again. Tables are Markdown,
with 95 % intervals.
"""
import argparse
import csv
import math
import pathlib
import shutil
import signal
import sys

from intervals import table
from runs import Failed, Programs

HERE = pathlib.Path(__file__).resolve().parent
VARIANTS = {"8 x 4, lc 1 mm": ("[8, 4]", "1 mm"), "8 x 4, lc 1 cm": ("[8, 4]", "10 mm"), "8 x 4, lc 5 cm": ("[8, 4]", "50 mm"),
            "16 x 8, lc 1 cm": ("[16, 8]", "10 mm")}
WAYS = {"active": ("-2 mm", list(VARIANTS)), "passive": ("4 mm", ["8 x 4, lc 1 cm"])}


def column(file, name):
    with open(file, encoding="utf-8") as text:
        return [float(row[name]) for row in csv.DictReader(text)]


def rankine(degrees, way):
    sine = math.sin(math.radians(degrees))
    return (1 - sine) / (1 + sine) if way == "active" else (1 + sine) / (1 - sine)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("-o", "--output", type=pathlib.Path, required=True)
    arguments.add_argument("--packings", type=int, default=5)
    arguments.add_argument("--program", type=pathlib.Path, default=HERE / "../../build/release/app/polargrain")
    options = arguments.parse_args()
    place, program = options.output.resolve(), options.program.resolve()
    place.mkdir(parents=True, exist_ok=True)
    for file in ("wall.yaml", "wall_packing.yaml"):
        shutil.copy(HERE / file, place)
    programs = Programs()
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, programs.stop)

    def run(made, *command):
        if not (place / made).exists():
            programs.call(place / "log", program, *command, "--quiet", folder=place)

    rows = {way: {} for way in WAYS}
    for seed in range(1, options.packings + 1):
        packing = f"packing{seed}.h5"
        run(packing, "pack", "wall_packing.yaml", "-o", packing, "--set", f"seed={seed}")
        test = f"biaxial{seed}"
        run(f"{test}.csv", "element", "--test", "biaxial", "--pressure", "10kPa", packing, "cells/hooke_radii.in", "-o", test,
            "--set", "axial_strain=5%", "--set", "jumps=500")
        angles = column(place / f"{test}.csv", "friction_angle_deg")
        for way, (move, variants) in WAYS.items():
            rows[way].setdefault("Rankine", []).append(
                {"K at the end": rankine(angles[-1], way), "extreme K": rankine(max(angles), way)})
            for name in variants:
                elements, length = VARIANTS[name]
                out = f"{way}-{name}-{seed}".replace(" ", "")
                try:
                    run(f"{out}/summary.json", "run", "wall.yaml", "-o", out, "--set", f"materials.sand.packing={packing}", "--set",
                        f"materials.sand.lc={length}", "--set", f"mesh.rectangle.elements={elements}", "--set",
                        f"boundary.3.move.u1=[[0, 0], [1, 0], [2, {move}]]", "--set",
                        f"boundary.1.move.u1=[[0, 0], [1, 0], [2, {move}]]")
                except Failed as error:
                    if programs.stopped:
                        sys.exit("wall.py: stopped; the same command goes on")
                    print(f"{out}: ended early\n{error}")
                    continue
                values = column(place / out / "history.csv", "K")[4:]
                rows[way].setdefault(name, []).append(
                    {"K at the end": values[-1], "extreme K": min(values) if way == "active" else max(values)})
    for way, groups in rows.items():
        table(way, groups, ["K at the end", "extreme K"])


if __name__ == "__main__":
    main()
