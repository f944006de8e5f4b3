#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Columns of finite elements whose cells spread their slips, between plates that hold them: against layers of grains.

    python3 column_spread.py -o RESULTS [--spread 50] [--elements 10] [--columns 5] [--rolling 0.2] [--mirrors] [--layers FOLDER] [--programs FOLDER...]

A column is 20 d high, with tied sides, under constant normal stress; each two diameters have a packing of their own, those of
layer_spread.py. Elements have one point. FOLDER, of `polargrain layer`, has layers of grains with the same rolling friction. Prints a
table in Markdown: mean and 95 % interval, and differences of the means. What is there already is not made again.
"""
import argparse
import pathlib

from built_package import polargrain
from intervals import difference_of_means, table
from layer_spread import HEIGHT, SCRIPT, of_column, of_layer
from layer_study import DIAMETER, PRESSURE
from polargrain.table import read_table
from runs import ROOT, Failed, Programs

REGIONS = 10
PACKING = {"sizes": {"law": "uniform", "radius": ["3 mm", "7 mm"]}, "density": 2650.0, "thickness": "100 mm",
           "script": "cells/hooke_radii.in", "pressure": "100 kPa", "friction": 0.0, "grains": 100}
CASE = """title: A column of cells whose slips are spread
continuum: {{kind: cauchy, spread: {spread:g} mm{hold}}}
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


def case(spread, elements, packings, script, hold):
    height = HEIGHT * DIAMETER
    size, region = height / elements, height / REGIONS
    return CASE.format(
        spread=spread, hold=", hold: [bottom, top]" if hold else "", elements=elements, size=size, height=height,
        regions=", ".join(f"r{k}: [0, {k * region:.6g} m, {size:.8g} m, {(k + 1) * region:.6g} m]" for k in range(REGIONS)),
        levels=", ".join(f"l{k}: {k * size:.8g} m" for k in range(1, elements)),
        materials="\n".join(f"  s{k}: {{model: cell, script: {script}, packing: {packing}}}" for k, packing in enumerate(packings)),
        assigned=", ".join(f"r{k}: s{k}" for k in range(REGIONS)),
        monitors="\n".join(f"  l{k}: {{on: l{k}, displacement: u1}}" for k in range(1, elements)))


def rows_of(history, elements):
    """Displacement (d), ratio of stresses and shear of every element, by step."""
    size = HEIGHT * DIAMETER / elements
    ways = [[0.0] * len(history["displacement"]), *(history[f"l{k}"] for k in range(1, elements)), history["displacement"]]
    return [(ways[-1][step] / DIAMETER, history["shear_force"][step] / size / PRESSURE,
             [(ways[k + 1][step] - ways[k][step]) / size for k in range(elements)]) for step in range(len(ways[0]))]


def script_of(place, rolling):
    """The script of cells with another coefficient of rolling friction."""
    text = (ROOT / "liggghts_inputs" / SCRIPT).read_text(encoding="utf-8")
    before, line, after = text.partition("coefficientRollingFriction peratomtypepair 1 ")
    if not line:
        raise Failed(f"{SCRIPT} has changed")
    file = place / f"rolling{rolling:g}.in"
    file.write_text(before + line + f"{rolling:g}" + after[after.index("\n"):], encoding="utf-8")
    return file.name


def differences(columns, layers):
    """Mean of columns less mean of layers, with its 95 % interval, by the figure."""
    print("columns less grains: " + ", ".join(f"{key} {difference_of_means([one[key] for one in columns], [one[key] for one in layers])}"
                                              for key in columns[0]) + "\n", flush=True)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("-o", "--output", type=pathlib.Path, required=True)
    arguments.add_argument("--spread", type=float, default=50.0, help="mm")
    arguments.add_argument("--elements", type=int, default=10, help="a multiple of 10")
    arguments.add_argument("--columns", type=int, default=5)
    arguments.add_argument("--rolling", type=float, default=0.2, help="coefficient of rolling friction")
    arguments.add_argument("--mirrors", action="store_true", help="ends that mirror slips, in place of plates that hold them")
    arguments.add_argument("--layers", type=pathlib.Path)
    arguments.add_argument("--programs", type=pathlib.Path, nargs="+", metavar="FOLDER")
    options = arguments.parse_args()
    programs = Programs(options.programs)
    place = options.output.resolve()
    place.mkdir(parents=True, exist_ok=True)
    script = script_of(place, options.rolling)
    figures, costs = [], []
    for number in range(options.columns):
        seeds = [100 + 20 * number + 2 * k for k in range(REGIONS)]
        packings = [place / f"grains100-seed{seed}.h5" for seed in seeds]
        for seed, packing in zip(seeds, packings):
            if not packing.exists():
                polargrain.pack({**PACKING, "seed": seed}, packing)
        name = f"column{number}-{options.elements}-{options.spread:g}-{options.rolling:g}{'-mirrors' if options.mirrors else ''}"
        file = place / f"{name}.yaml"
        file.write_text(case(options.spread, options.elements, [packing.name for packing in packings], script, not options.mirrors), encoding="utf-8")
        if not (place / name / "history.csv").exists():
            try:
                programs.call(place / f"{name}.log", programs.find("polargrain"), "run", file, "-o", place / name, "--quiet")
            except Failed as failure:
                print(f"{name} stops early: {failure}", flush=True)
        history = read_table(place / name / "history.csv")
        figures.append(of_column(rows_of(history, options.elements)))
        costs.append({"iterations": sum(history["iterations"]) / len(history["iterations"]), "largest": max(history["iterations"])})
        print(name, figures[-1], costs[-1], flush=True)
    groups = {f"{options.spread:g}": figures}
    if options.layers:
        groups["grains"] = [of_layer(layer) for layer in sorted(options.layers.glob("layer*-seed*"))]
    table("spread, mm", groups, list(figures[0]))
    if options.layers:
        differences(figures, groups["grains"])
    table("costs", {f"{options.spread:g}": costs}, list(costs[0]))


if __name__ == "__main__":
    main()
