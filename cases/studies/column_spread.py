#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Columns of finite elements whose cells spread their slips, between plates that hold them: against layers of grains.

    python3 column_spread.py -o RESULTS [--spread 5.4...] [--elements 10] [--columns 5] [--rolling 0.2] [--friction 0.5463] [--pressure 100]
                             [--radius 3 7] [--packed-with 0] [--mirrors] [--height 20] [--explicit PACE...] [--spheres]
                             [--rotations none|free|controlled...]
                             [--layers FOLDER] [--programs FOLDER...]

A column has tied sides and stands under constant normal stress; each tenth of its height has a packing of its own, by default those of
layer_spread.py. Elements have one point. FOLDER, of `polargrain layer`, has layers of the same grains. Prints tables in Markdown: mean and
95 % interval, differences from the layers, and differences of other kinds of columns from the first. What is there already is not made
again: a folder for each kind of grains.
"""
import argparse
import math
import os
import pathlib
import statistics

from built_package import polargrain
from intervals import difference_of_means, shown, table
from layer_spread import HEIGHT, SCRIPT, of_column, of_layer
from polargrain.table import read_table
from runs import ROOT, Failed, Programs

REGIONS = 10
FRICTION = 0.5463024898437905  # of both scripts
SPHERES = "cells/spheres_hooke_radii.in"
PACKING = {"density": 2650.0, "thickness": "100 mm", "script": "cells/hooke_radii.in", "grains": 100}
PACKING_OF_SPHERES = {"density": 2650.0, "dimension": 3, "script": SPHERES, "grains": 200}
ITERATIONS = """  cut: 8
  tolerance: 2e-2
  noise: 2
  acceleration: 5
  jumps: 100
  iterations: 15"""
CASE = """title: A column of cells whose slips are spread
continuum: {continuum}
mesh:
  rectangle: {{size: [{size:.8g} m, {height:g} m], elements: [1, {elements}], regions: {{{regions}}}, levels: {{{levels}}}}}
  element: Q4R
materials:
{materials}
regions: {{{assigned}}}
boundary:
  - {{on: left, tie: right}}
  - {{on: bottom, fix: [u1, u2{held}]}}
{top}  - {{on: top, move: {{u1: [[0, 0], [1, {first:g} m], [2, {last:g} m]]}}, pressure: {pressure:g} Pa}}
steps:
  stages:
    - {{until: 1, count: 12}}
    - {{until: 2, count: 58}}
{method}
monitors:
  shear_force: {{on: top, reaction: u1}}
  displacement: {{on: top, displacement: u1}}
{monitors}
"""


def case(spread, pace, rotations, options, packings, script):
    kind, of_cells = {"none": ("cauchy", ""), "free": ("cosserat", ", lc: from packing"), "controlled": ("cosserat", ", rotations: controlled")}[rotations]
    hold = "" if options.mirrors else ", hold: [bottom, top]"
    height, elements = options.height * options.diameter, options.elements
    size, region = height / elements, height / REGIONS
    return CASE.format(
        continuum=f"{{kind: {kind}, spread: {spread * options.diameter:g} m{hold}}}" if spread else kind, elements=elements,
        held="" if rotations == "none" else ", w", top="" if rotations == "none" else "  - {on: top, fix: [w]}\n", size=size,
        method=f"  method: explicit\n  pace: {pace:g}" if pace else ITERATIONS, height=height, pressure=options.pressure, first=0.4 * options.diameter, last=5.0 * options.diameter,
        regions=", ".join(f"r{k}: [0, {k * region:.6g} m, {size:.8g} m, {(k + 1) * region:.6g} m]" for k in range(REGIONS)),
        levels=", ".join(f"l{k}: {k * size:.8g} m" for k in range(1, elements)),
        materials="\n".join(f"  s{k}: {{model: cell, script: {script}, packing: {packing}{of_cells}}}" for k, packing in enumerate(packings)),
        assigned=", ".join(f"r{k}: s{k}" for k in range(REGIONS)),
        monitors="\n".join(f"  l{k}: {{on: l{k}, displacement: u1}}" for k in range(1, elements)))


def rows_of(history, options):
    """Displacement (d), ratio of stresses and shear of every element, by step."""
    elements = options.elements
    size = options.height * options.diameter / elements
    ways = [[0.0] * len(history["displacement"]), *(history[f"l{k}"] for k in range(1, elements)), history["displacement"]]
    return [(ways[-1][step] / options.diameter, history["shear_force"][step] / size / options.pressure,
             [(ways[k + 1][step] - ways[k][step]) / size for k in range(elements)]) for step in range(len(ways[0]))]


def script_of(place, options):
    """The script of cells with other coefficients of friction."""
    script = SPHERES if options.spheres else SCRIPT
    text = (ROOT / "liggghts_inputs" / script).read_text(encoding="utf-8")
    values = {"coefficientFriction": options.friction}
    if not options.spheres:
        values["coefficientRollingFriction"] = options.rolling
    for name, value in values.items():
        before, line, after = text.partition(f"property/global {name} peratomtypepair 1 ")
        if not line:
            raise Failed(f"{script} has changed")
        text = before + line + f"{value:.17g}" + after[after.index("\n"):]
    file = place / "cell.in"
    file.write_text(text, encoding="utf-8")
    return file.name


def title_of(spread, pace, rotations):
    return f"{spread:g}" + (f", explicit {pace:g}" if pace else "") + (f", rotations {rotations}" if rotations != "none" else "")


def name_of(number, spread, pace, rotations, options):
    return (f"column{number}-{options.elements}-{spread:g}" + ("-mirrors" if options.mirrors else "") + (f"-explicit{pace:g}" if pace else "")
            + (f"-high{options.height:g}" if options.height != HEIGHT else "") + (f"-{rotations}" if rotations != "none" else ""))


def differences(title, columns, layers):
    """Mean of columns less mean of layers, with its 95 % interval, by the figure."""
    print(f"{title} less grains: " + ", ".join(f"{key} {difference_of_means([one[key] for one in columns], [one[key] for one in layers])}"
                                              for key in columns[0]) + "\n", flush=True)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("-o", "--output", type=pathlib.Path, required=True)
    arguments.add_argument("--spread", type=float, nargs="+", default=[5.0], help="d; 0: none")
    arguments.add_argument("--elements", type=int, default=10, help="a multiple of 10")
    arguments.add_argument("--columns", type=int, default=5)
    arguments.add_argument("--rolling", type=float, default=0.2, help="coefficient of rolling friction")
    arguments.add_argument("--friction", type=float, default=FRICTION, help="coefficient of sliding friction")
    arguments.add_argument("--pressure", type=float, default=100.0, help="kPa")
    arguments.add_argument("--radius", type=float, nargs=2, default=[3.0, 7.0], help="least and largest, mm")
    arguments.add_argument("--packed-with", type=float, default=0.0, metavar="FRICTION", help="more of it packs more loosely")
    arguments.add_argument("--mirrors", action="store_true", help="ends that mirror slips, in place of plates that hold them")
    arguments.add_argument("--height", type=float, default=HEIGHT, help="d")
    arguments.add_argument("--explicit", type=float, nargs="+", default=[0.0], metavar="PACE", help="of explicit steps; 0: iterations")
    arguments.add_argument("--spheres", action="store_true", help="200 in a cell, without rolling resistance; iterations do not balance them")
    arguments.add_argument("--rotations", nargs="+", choices=["none", "free", "controlled"], default=["none"], help="micro-rotations of the continuum and its cells")
    arguments.add_argument("--layers", type=pathlib.Path)
    arguments.add_argument("--programs", type=pathlib.Path, nargs="+", metavar="FOLDER")
    options = arguments.parse_args()
    options.pressure *= 1e3
    options.diameter = 1e-3 * sum(options.radius)
    packing_of_all = {**(PACKING_OF_SPHERES if options.spheres else PACKING), "pressure": options.pressure, "friction": options.packed_with,
                      "sizes": {"law": "uniform", "radius": [1e-3 * radius for radius in options.radius]}}
    programs = Programs(options.programs)
    place = options.output.resolve()
    place.mkdir(parents=True, exist_ok=True)
    script = script_of(place, options)
    if options.packed_with:  # such a packing keeps springs, which belong to its script
        packing_of_all["script"] = str(place / script)
    kinds = [(spread, pace, rotations) for spread in options.spread for pace in options.explicit for rotations in options.rotations]
    figures, costs = {kind: [] for kind in kinds}, {kind: [] for kind in kinds}
    for number in range(options.columns):
        seeds = [100 + 20 * number + 2 * k for k in range(REGIONS)]
        packings = [place / f"grains{packing_of_all['grains']}-seed{seed}.h5" for seed in seeds]
        for seed, packing in zip(seeds, packings):
            if not packing.exists():
                polargrain.pack({**packing_of_all, "seed": seed}, packing)
        for kind in kinds:
            name = name_of(number, *kind, options)
            file = place / f"{name}.yaml"
            file.write_text(case(*kind, options, [packing.name for packing in packings], script), encoding="utf-8")
            seconds = math.nan
            if not (place / name / "history.csv").exists():
                before = os.times().children_user
                try:
                    programs.call(place / f"{name}.log", programs.find("polargrain"), "run", file, "-o", place / name, "--quiet")
                    seconds = os.times().children_user - before
                except Failed as failure:
                    print(f"{name} stops early: {failure}", flush=True)
            history = read_table(place / name / "history.csv")
            figures[kind].append(of_column(rows_of(history, options), options.height))
            costs[kind].append({"iterations": statistics.mean(history["iterations"]), "largest": max(history["iterations"]), "seconds": seconds})
            print(name, figures[kind][-1], costs[kind][-1], flush=True)
    groups = {title_of(*kind): figures[kind] for kind in kinds}
    if options.layers:
        groups["grains"] = [of_layer(layer, options.diameter, options.pressure) for layer in sorted(options.layers.glob("layer*-seed*"))]
    keys = list(figures[kinds[0]][0])
    table("spread, d", groups, keys)
    if options.layers:
        for kind in kinds:
            differences(title_of(*kind), figures[kind], groups["grains"])
    for kind in kinds[1:]:
        pairs = list(zip(figures[kind], figures[kinds[0]]))
        print(f"{title_of(*kind)} less {title_of(*kinds[0])}, column by column: "
              + ", ".join(f"{key} {shown([one[key] - other[key] for one, other in pairs], 3)}" for key in keys) + "\n", flush=True)
    table("costs (seconds: user time)", {title_of(*kind): costs[kind] for kind in kinds}, ["iterations", "largest", "seconds"])
    for kind in kinds[1:]:
        print(f"seconds of {title_of(*kind)} over {title_of(*kinds[0])}: "
              + shown([one["seconds"] / other["seconds"] for one, other in zip(costs[kind], costs[kinds[0]])], 2), flush=True)


if __name__ == "__main__":
    main()
