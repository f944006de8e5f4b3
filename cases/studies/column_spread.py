#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Columns of finite elements whose cells spread their slips, between ends that mirror slips: against layer_spread.py and layers of grains.

    python3 column_spread.py -o RESULTS [--spread 50] [--elements 10] [--columns 5] [--programs FOLDER...]

A column is 20 d high, with tied sides, under constant normal stress; each two diameters have a packing of their own, those of
layer_spread.py. Elements have one point. Prints a table in Markdown: mean and 95 % interval. What is there already is not made again.
"""
import argparse
import pathlib
import shutil

from built_package import polargrain
from intervals import table
from layer_spread import HEIGHT, of_column
from layer_study import DIAMETER, PRESSURE
from polargrain.table import read_table
from runs import ROOT, Failed, Programs

REGIONS = 10
PACKING = {"sizes": {"law": "uniform", "radius": ["3 mm", "7 mm"]}, "density": 2650.0, "thickness": "100 mm",
           "script": "cells/hooke_radii.in", "pressure": "100 kPa", "friction": 0.0, "grains": 100}
CASE = """title: A column of cells whose slips are spread
continuum: {{kind: cauchy, spread: {spread:g} mm}}
mesh:
  rectangle: {{size: [{size:.8g} m, {height:g} m], elements: [1, {elements}], regions: {{{regions}}}, levels: {{{levels}}}}}
  element: Q4R
materials:
{materials}
regions: {{{assigned}}}
boundary:
  - {{on: left, tie: right}}
  - {{on: bottom, fix: [u1, u2]}}
  - {{on: top, move: {{u1: [[0, 0], [1, 4 mm], [2, 50 mm]]}}, pressure: 100 kPa}}
steps:
  stages:
    - {{until: 1, count: 12}}
    - {{until: 2, count: 58}}
  cut: 8
  tolerance: 2e-2
  noise: 2
  acceleration: 5
  jumps: 100
  iterations: 15
monitors:
  shear_force: {{on: top, reaction: u1}}
  displacement: {{on: top, displacement: u1}}
{monitors}
"""


def case(spread, elements, packings):
    height = HEIGHT * DIAMETER
    size, region = height / elements, height / REGIONS
    return CASE.format(
        spread=spread, elements=elements, size=size, height=height,
        regions=", ".join(f"r{k}: [0, {k * region:.6g} m, {size:.8g} m, {(k + 1) * region:.6g} m]" for k in range(REGIONS)),
        levels=", ".join(f"l{k}: {k * size:.8g} m" for k in range(1, elements)),
        materials="\n".join(f"  s{k}: {{model: cell, script: cells/hooke_li_chu.in, packing: {packing}}}" for k, packing in enumerate(packings)),
        assigned=", ".join(f"r{k}: s{k}" for k in range(REGIONS)),
        monitors="\n".join(f"  l{k}: {{on: l{k}, displacement: u1}}" for k in range(1, elements)))


def rows_of(history, elements):
    """Displacement (d), ratio of stresses and shear of every element, by step."""
    size = HEIGHT * DIAMETER / elements
    ways = [[0.0] * len(history["displacement"]), *(history[f"l{k}"] for k in range(1, elements)), history["displacement"]]
    return [(ways[-1][step] / DIAMETER, history["shear_force"][step] / size / PRESSURE,
             [(ways[k + 1][step] - ways[k][step]) / size for k in range(elements)]) for step in range(len(ways[0]))]


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("-o", "--output", type=pathlib.Path, required=True)
    arguments.add_argument("--spread", type=float, default=50.0, help="mm")
    arguments.add_argument("--elements", type=int, default=10, help="a multiple of 10")
    arguments.add_argument("--columns", type=int, default=5)
    arguments.add_argument("--programs", type=pathlib.Path, nargs="+", metavar="FOLDER")
    options = arguments.parse_args()
    programs = Programs(options.programs)
    place = options.output.resolve()
    place.mkdir(parents=True, exist_ok=True)
    shutil.copytree(ROOT / "liggghts_inputs/cells", place / "cells", dirs_exist_ok=True)
    figures, costs = [], []
    for number in range(options.columns):
        seeds = [100 + 20 * number + 2 * k for k in range(REGIONS)]
        packings = [place / f"grains100-seed{seed}.h5" for seed in seeds]
        for seed, packing in zip(seeds, packings):
            if not packing.exists():
                polargrain.pack({**PACKING, "seed": seed}, packing)
        name = f"column{number}-{options.elements}-{options.spread:g}"
        file = place / f"{name}.yaml"
        file.write_text(case(options.spread, options.elements, [packing.name for packing in packings]), encoding="utf-8")
        if not (place / name / "history.csv").exists():
            try:
                programs.call(place / f"{name}.log", programs.find("polargrain"), "run", file, "-o", place / name, "--quiet")
            except Failed as failure:
                print(f"{name} stops early: {failure}", flush=True)
        history = read_table(place / name / "history.csv")
        figures.append(of_column(rows_of(history, options.elements)))
        costs.append({"iterations": sum(history["iterations"]) / len(history["iterations"]), "largest": max(history["iterations"])})
        print(name, figures[-1], costs[-1], flush=True)
    table("spread, mm", {f"{options.spread:g}": figures}, list(figures[0]))
    table("costs", {f"{options.spread:g}": costs}, list(costs[0]))


if __name__ == "__main__":
    main()
