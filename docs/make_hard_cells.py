#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs the hard cases with boxes of grains (docs/hard_cells.md) and prints a table of them.

usage: docs/make_hard_cells.py POLARGRAIN [DIRECTORY [METHOD]]      from the root of the project; some minutes

One element (4 points, 100 discs each), model adaptive. Packings are made first, into DIRECTORY. METHOD: newton or automatic.
"""
import csv
import json
import os
import re
import subprocess
import sys

PROGRAM = os.path.abspath(sys.argv[1])
PLACE = os.path.abspath(sys.argv[2] if len(sys.argv) > 2 else "hard_cells")
METHOD = sys.argv[3] if len(sys.argv) > 3 else "newton"
ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))

PACKINGS = {
    "dense": os.path.join(ROOT, "cases/footing_cells/packing100.h5"),
    "loose": ["friction=0.5"],
}

CASE = """title: "{title}"
mesh: {{rectangle: {{size: [0.1 m, 0.1 m], elements: [1, 1]}}, element: {element}}}
materials:
  sand: {{model: adaptive, script: cells/hooke_radii.in, packing: {packing}, G: 16 MPa, Gc: 14 MPa, lc: 20 mm,
    {grains}}}
regions: {{all: sand}}
boundary:
{boundary}
steps: {{count: {count}, cut: 6, iterations: 20, jumps: 0, {balance}, method: {method}}}
monitors:
  top_force: {{on: top, reaction: u2}}
  top_shear: {{on: top, reaction: u1}}
  pressure: -top_force / 0.1 m
  shear: top_shear / 0.1 m
output: {{every: 100, table: [pressure, shear]}}
"""

# How the grains are loaded and when a step is balanced: as in cases/biaxial, and where the stress falls far below
# that of the packing (docs/hard_cells.md). A share of 100 kPa would be no tolerance there: a cell a point.
USUAL = {"element": "Q8R", "grains": "adaptive: {tolerance: 2 %}", "balance": "tolerance: 1e-2"}
LOW_STRESS = {
    "element": "Q8R",
    "grains": "adaptive: {tolerance: 0}, damping: 0.06, least_steps: 950, unbalanced_force_ratio: 1e-4,\n"
    "    unbalanced_moment_ratio: 1e-4, most_relaxation_steps: 200000",
    "balance": "tolerance: 3e-4, largest_strain: 1e-3",
}
LOW_STRESS_MOVED = {**LOW_STRESS, "balance": "tolerance: 1e-3"}  # displacements are given; strains are large

SUPPORTS = "  - {on: bottom, fix: [u1, u2]}\n"
SMOOTH = "  - {on: bottom, fix: [u2]}\n  - {on: bottom_left, fix: [u1]}\n"
TOP = [[0.0, 100.0], [0.2, 25.0], [0.35, 5.0], [0.5, 1.0], [1.0, 2.5]]  # time, kPa: the axial stress of UNLOADING
UNLOADING = (SMOOTH + "  - {on: [left, right], pressure: [[0, 100 kPa], [0.2, 25 kPa], [0.35, 5 kPa], [0.5, 1 kPa]]}\n"
             f"  - {{on: top, pressure: [{', '.join(f'[{time}, {value} kPa]' for time, value in TOP)}]}}\n")
CONSTANT_VOLUME = (SMOOTH + "  - {on: top, move: {u2: -3 mm}}\n  - {on: right, move: {u1: 3 mm}}\n"
                   "  - {on: left, fix: [u1]}\n")
EXTENSION = (SMOOTH + "  - {on: top, move: {u2: 2 mm}}\n  - {on: left, fix: [u1]}\n  - {on: right, fix: [u1]}\n")
CASES = [
    ("shear to a displacement of 30 % of the height", "dense", 60,
     SUPPORTS + "  - {on: top, move: {u1: 30 mm}, fix: [u2]}\n", USUAL),
    ("unloading from 100 to 1 kPa, then an axial stress of 2.5 kPa", "dense", 40, UNLOADING, LOW_STRESS),
    ("the same, loaded as usual", "dense", 40, UNLOADING, {**LOW_STRESS, "grains": "adaptive: {tolerance: 0}"}),
    # A bilinear element: all its nodes are moved, so that the strain is given everywhere.
    ("loose, contracting, constant volume, 3 %", "loose", 30, CONSTANT_VOLUME,
     {**LOW_STRESS_MOVED, "element": "Q4"}),
    ("the same, shorter ramps", "loose", 30, CONSTANT_VOLUME,
     {**LOW_STRESS_MOVED, "element": "Q4", "grains": LOW_STRESS["grains"].replace("least_steps: 950", "least_steps: 400")}),
    ("the same, middle nodes with free sides", "loose", 30, CONSTANT_VOLUME, LOW_STRESS_MOVED),
    ("a point that separates: extension of 2 %", "dense", 20, EXTENSION, LOW_STRESS_MOVED),
    ("cyclic compression, 0.5 %, four reversals", "dense", 40,
     SMOOTH + "  - {on: top, move: {u2: [[0, 0], [0.2, -0.5 mm], [0.4, 0], [0.6, -0.5 mm], [0.8, 0], [1, -0.5 mm]]}}\n"
     "  - {on: [left, right], pressure: 100 kPa}\n", USUAL),
]


def balance_of(settings, boundary):
    """Explicit steps find their pace by the boundary that moves; where none does, their number is to be given."""
    return settings["balance"] + (", explicit_steps: 8000" if METHOD == "automatic" and boundary is UNLOADING else "")


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


def axial_stress(boundary, last):
    """kPa, tension positive; text, as a stress that is given says so."""
    if boundary is not UNLOADING:
        return f"{-float(last['pressure']) / 1e3:.4g}"
    time = float(last["time"])
    (start, high), (end, low) = next(pair for pair in zip(TOP, TOP[1:]) if time <= pair[1][0])
    return f"{-(high + (low - high) * (time - start) / (end - start)):.4g} (given)"


def main():
    os.makedirs(PLACE, exist_ok=True)
    print("| case | steps committed | of these explicit | iterations | cuts | cell runs | axial stress, kPa | shear stress, kPa | what happened |")
    print("|---|---|---|---|---|---|---|---|---|")
    for number, (title, grains, count, boundary, settings) in enumerate(CASES):
        file = os.path.join(PLACE, f"case{number}.yaml")
        with open(file, "w", encoding="utf-8") as out:
            out.write(CASE.format(title=title, packing=packing(grains), boundary=boundary, count=count, method=METHOD,
                                  **{**settings, "balance": balance_of(settings, boundary)}))
        results = os.path.join(PLACE, f"results{number}")
        subprocess.run([PROGRAM, "run", file, "-o", results, "--quiet"], cwd=ROOT, stderr=subprocess.DEVNULL)
        with open(os.path.join(results, "summary.json"), encoding="utf-8") as text:
            summary = json.load(text)
        with open(os.path.join(results, "history.csv"), encoding="utf-8") as text:
            last = list(csv.DictReader(text))[-1]
        figures = next(iter(summary["materials"].values()))
        end = "to the end" if summary["status"] == "done" else "stopped, " + summary["message"].splitlines()[0] + "; a checkpoint of the step before is there"
        print(f"| {title} | {summary['steps_committed']} of {count} | {summary.get('automatic', {}).get('steps_explicit', 0)} | {summary['iterations']} | {summary['cuts']} "
              f"| {figures['cell_runs']:.0f} | {axial_stress(boundary, last)} | {float(last['shear']) / 1e3:.4g} | {end} |",
              flush=True)


main()
