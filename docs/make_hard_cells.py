#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs the hard cases with boxes of grains and prints the rows of the table in docs/hard_cells.md.

usage: docs/make_hard_cells.py POLARGRAIN [DIRECTORY]      from the root of the project; some minutes

One element (4 points, 100 discs each), model adaptive. Packings are made first, into DIRECTORY.
"""
import csv
import json
import os
import re
import subprocess
import sys

PROGRAM = os.path.abspath(sys.argv[1])
PLACE = os.path.abspath(sys.argv[2] if len(sys.argv) > 2 else "hard_cells")
ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))

PACKINGS = {
    "dense": os.path.join(ROOT, "cases/footing_cells/packing100.h5"),
    "loose": ["friction=0.5"],
}

CASE = """title: "{title}"
mesh: {{rectangle: {{size: [0.1 m, 0.1 m], elements: [1, 1]}}}}
materials:
  sand: {{model: adaptive, script: cells/hooke_radii.in, packing: {packing}, G: 16 MPa, Gc: 14 MPa, lc: 20 mm,
    tolerance: {tolerance}}}
regions: {{all: sand}}
boundary:
{boundary}
steps: {{count: {count}, cut: 6, iterations: 20, tolerance: {balance}}}
monitors:
  top_force: {{on: top, reaction: u2}}
  top_shear: {{on: top, reaction: u1}}
  pressure: -top_force / 0.1 m
  shear: top_shear / 0.1 m
output: {{every: 100, table: [pressure, shear]}}
"""

SUPPORTS = "  - {on: bottom, fix: [u1, u2]}\n"
SMOOTH = "  - {on: bottom, fix: [u2]}\n  - {on: bottom_left, fix: [u1]}\n"
CASES = [
    ("shear to a displacement of 30 % of the height", "dense", 60,
     SUPPORTS + "  - {on: top, move: {u1: 30 mm}, fix: [u2]}\n"),
    # A share of 100 kPa would be no tolerance here: a cell a point, and a tighter balance.
    ("unloading from 100 to 1 kPa, then an axial stress of 2.5 kPa", "dense", 40, SMOOTH
     + "  - {on: [left, right], pressure: [[0, 100 kPa], [0.5, 1 kPa]]}\n"
     "  - {on: top, pressure: [[0, 100 kPa], [0.5, 1 kPa], [1, 2.5 kPa]]}\n", "0", "1e-3"),
    ("loose, contracting, constant volume, 3 %", "loose", 30,
     SMOOTH + "  - {on: top, move: {u2: -3 mm}}\n  - {on: right, move: {u1: 3 mm}}\n  - {on: left, fix: [u1]}\n"),
    ("a point that separates: extension of 2 %", "dense", 20,
     SMOOTH + "  - {on: top, move: {u2: 2 mm}}\n  - {on: left, fix: [u1]}\n  - {on: right, fix: [u1]}\n"),
    ("cyclic compression, 0.5 %, four reversals", "dense", 40,
     SMOOTH + "  - {on: top, move: {u2: [[0, 0], [0.2, -0.5 mm], [0.4, 0], [0.6, -0.5 mm], [0.8, 0], [1, -0.5 mm]]}}\n"
     "  - {on: [left, right], pressure: 100 kPa}\n"),
]


def packing(name):
    made = PACKINGS[name]
    if isinstance(made, str):
        return made
    file = os.path.join(PLACE, name + "100.h5")
    if not os.path.exists(file):
        command = [PROGRAM, "pack", "cases/packings/dense400.yaml", "--quiet", "-o", file, "--set", "grains=100"]
        for setting in made:
            command += ["--set", setting]
        subprocess.run(command, check=True, cwd=ROOT)
    return file


def main():
    os.makedirs(PLACE, exist_ok=True)
    print("| case | steps committed | iterations | cuts | cell runs | axial stress, kPa | shear stress, kPa | what happened |")
    print("|---|---|---|---|---|---|---|---|")
    for number, (title, grains, count, boundary, *rest) in enumerate(CASES):
        tolerance, balance = rest or ("2 %", "1e-2")
        file = os.path.join(PLACE, f"case{number}.yaml")
        with open(file, "w", encoding="utf-8") as out:
            out.write(CASE.format(title=title, packing=packing(grains), boundary=boundary, count=count,
                                  tolerance=tolerance, balance=balance))
        results = os.path.join(PLACE, f"results{number}")
        subprocess.run([PROGRAM, "run", file, "-o", results, "--quiet"], cwd=ROOT, stderr=subprocess.DEVNULL)
        with open(os.path.join(results, "summary.json"), encoding="utf-8") as text:
            summary = json.load(text)
        with open(os.path.join(results, "history.csv"), encoding="utf-8") as text:
            last = list(csv.DictReader(text))[-1]
        figures = next(iter(summary["materials"].values()))
        end = "to the end" if summary["status"] == "done" else "stopped, " + re.sub(r"\s+checkpoint:.*", "; a checkpoint of the step before is there", summary["message"], flags=re.S)
        print(f"| {title} | {summary['steps_committed']} of {count} | {summary['iterations']} | {summary['cuts']} "
              f"| {figures['cell_runs']:.0f} | {-float(last['pressure']) / 1e3:.4g} | {float(last['shear']) / 1e3:.4g} | {end} |",
              flush=True)


main()
