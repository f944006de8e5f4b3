#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The cause of the thickness of a band in a column of cells: two controls of cases/studies/layer_study.py.

    python3 layer_controls.py cauchy -o RESULTS [--elements 5 10 20] [--programs FOLDER]
    python3 layer_controls.py scatter -o RESULTS

cauchy: columns 10 d high without micro-rotations, whose lowest element has a weaker packing. scatter: ten elements of 1 d with
controlled rotations, each with a packing of its own (seeds 20 to 29). What is there already is not made again. Prints where the plate's
displacement went.
"""
import argparse
import csv
import pathlib
import shutil
import subprocess

from gmsh_mesh import Grid

HERE = pathlib.Path(__file__).resolve().parent
HEIGHT = 0.1  # m
SCRIPT = "cells/hooke_li_chu.in"
CASE = """title: {title}
continuum: {continuum}
deformation: large
mesh: {{file: column{elements}.msh, element: Q8R}}
materials:
{materials}
regions: {{{regions}}}
boundary:
  - {{on: left, tie: right}}
  - {{on: bottom, fix: [{fixed}]}}
  - {{on: top, {held}move: {{u1: [[0, 0], [10, 200 mm]]}}, pressure: 100 kPa}}
steps:
  stages:
    - {{until: {until}, count: {first}}}
    - {{measure: {{on: row{above}, from: row{below}, displacement: u1}}, grow: {grow}, count: {count}}}
  cut: 12
  tolerance: 2e-2
  noise: 2
  acceleration: 5
  jumps: 20
monitors:
  shear_force: {{on: top, reaction: u1}}
  displacement: {{on: top, displacement: u1}}
{monitors}
output: {{every: 100, points: no, table: [displacement, shear_force]}}
"""


def write_mesh(file, elements):
    """A column one element wide; each element is a region e0, e1, ..., each row of corners a set of nodes row0, row1, ..."""
    size = HEIGHT / elements
    grid = Grid([0.0, size], [k * size for k in range(elements + 1)])
    for side in ("bottom", "top", "left", "right"):
        grid.name(side, "line", getattr(grid, side)())
    for row in range(elements + 1):
        grid.name(f"row{row}", "point", [[grid.node(i, 2 * row)] for i in (0, 2, 1)])
    for element in range(elements):
        grid.name(f"e{element}", "quad", [grid.quads[element]])
    grid.write(file)


def run(program, place, name, elements, materials, of_element, **words):
    """@returns the rows of history.csv, as numbers"""
    out = place / name
    if not (out / "summary.json").exists():
        write_mesh(place / f"column{elements}.msh", elements)
        text = CASE.format(elements=elements, materials="\n".join(f"  {key}: {value}" for key, value in materials.items()),
                           regions=", ".join(f"e{k}: {of_element(k)}" for k in range(elements)),
                           monitors="\n".join(f"  u{k}: {{on: row{k}, displacement: u1}}" for k in range(elements + 1)), **words)
        (place / f"{name}.yaml").write_text(text, encoding="utf-8")
        with open(place / f"{name}.log", "w", encoding="utf-8") as log:
            subprocess.run([program, "run", f"{name}.yaml", "-o", name, "-w", "1", "--quiet"], cwd=place, stdout=log,
                           stderr=subprocess.STDOUT, check=False)
    with open(out / "history.csv", encoding="utf-8") as file:
        return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]


def moved(first, last, elements):
    """@returns how much of the displacement between two rows of the history is each element's, mm"""
    return [1e3 * (last[f"u{k + 1}"] - last[f"u{k}"] - first[f"u{k + 1}"] + first[f"u{k}"]) for k in range(elements)]


def cauchy(program, place, meshes, check):
    for name in ("dense100_seed2", "dense100_seed3"):
        shutil.copy(HERE / f"{name}.h5", place)
    materials = {"weak": f"{{model: cell, script: {SCRIPT}, packing: dense100_seed2.h5}}",
                 "strong": f"{{model: cell, script: {SCRIPT}, packing: dense100_seed3.h5}}"}
    print("| elements | peak | weak element, mm | all others, mm | plate, mm | evaluations |\n|---|---|---|---|---|---|")
    for elements in meshes:
        rows = run(program, place, f"cauchy{elements}", elements, materials, lambda k: "strong" if k else "weak",
                   title="Cauchy column with one weak element", continuum="cauchy", fixed="u1, u2", held="", until=0.1, first=5,
                   below=0, above=max(1, 2 * elements // 10), grow="4 mm", count=24)
        ratio = [row["shear_force"] / (HEIGHT / elements * 1e5) for row in rows]
        peak = ratio.index(max(ratio))
        end = next((k for k in range(peak, len(rows)) if ratio[k] < 0.45), len(rows) - 1)
        way = moved(rows[peak], rows[end], elements)
        if check and not (way[0] > 0.0 and all(one < 0.0 for one in way[1:])):
            raise SystemExit(f"{elements} elements: the weak one is not all of the band, as the page says: {way} mm")
        print(f"| {elements} | {ratio[peak]:.3f} | {way[0]:.2f} | {sum(way[1:]):.2f} | {sum(way):.2f} | "
              f"{sum(row['evaluations'] for row in rows):.0f} |")


def scatter(program, place):
    specification = HERE / "../packings/dense400.yaml"
    for k in range(10):
        if not (place / f"cells{k}.h5").exists():
            subprocess.run([program, "pack", specification.resolve(), "--set", "grains=100", "--set", f"script={SCRIPT}", "--set",
                            f"seed={20 + k}", "-o", f"cells{k}.h5", "--quiet"], cwd=place, check=True)
    materials = {f"m{k}": f"{{model: cell, script: {SCRIPT}, packing: cells{k}.h5, rotations: controlled}}" for k in range(10)}
    rows = run(program, place, "scatter", 10, materials, lambda k: f"m{k}", title="Column whose elements have packings of their own",
               continuum="cosserat", fixed="u1, u2, w", held="fix: [w], ", until=0.12, first=6, below=1, above=9, grow="9 mm", count=36)
    for first in range(0, len(rows) - 6, 6):
        way = moved(rows[first], rows[first + 6], 10)
        print(f"steps {first} to {first + 6}, shares of the elements:", " ".join(f"{x / sum(map(abs, way)):.2f}" for x in way))


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("control", choices=("cauchy", "scatter"))
    arguments.add_argument("-o", "--output", type=pathlib.Path, required=True)
    arguments.add_argument("--elements", type=int, nargs="+", default=[5, 10, 20])
    arguments.add_argument("--programs", type=pathlib.Path, default=HERE / "../../build/release/app")
    arguments.add_argument("--check", action="store_true", help="fail when a band of `cauchy` is not the weak element alone")
    options = arguments.parse_args()
    place = options.output.resolve()
    place.mkdir(parents=True, exist_ok=True)
    program = str((options.programs / "polargrain").resolve())
    if options.control == "cauchy":
        cauchy(program, place, options.elements, options.check)
    else:
        scatter(program, place)


if __name__ == "__main__":
    main()
