#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Undrained tests of loose, medium and dense grains: phase transformation, flow to zero, and a saturated specimen beside the box.

    python3 undrained.py -o RESULTS [--packings 5] [--specimens 3] [--program build/release/app/polargrain]

Discs in biaxial compression, spheres in triaxial compression, 100 kPa, to 10 % of strain; grains resist rolling. A box at constant
volume is dry. A saturated specimen of the same boxes of discs, one element, is closed and loaded by its total stresses; it is compared
to 1 % of strain, or until 20 kPa are left. Specimens of spheres are not balanced to 1e-4, and loose ones flow before 0.3 %. What is
there already is not run again. Tables are Markdown, with 95 % intervals.
"""
import argparse
import csv
import math
import pathlib
import signal
import sys

from intervals import table
from runs import Failed, Programs

HERE = pathlib.Path(__file__).resolve().parent
PRESSURE = 100e3  # Pa
KINDS = {
    "discs": {"test": "biaxial", "grains": 400, "space": "thickness: 100 mm", "script": "cells/hooke_li_chu.in",
              "ways": {"loose": (0.546, 0.2), "medium": (0.4, 0.1), "dense": (0.0, 0.0)}},
    "spheres": {"test": "triaxial", "grains": 1000, "space": "dimension: 3", "script": "cells/spheres_li_chu.in",
                "ways": {"loose": (0.546, 0.2), "medium": (0.3, 0.1), "dense": (0.0, 0.0)}},
}
PACKING = """title: {name}
grains: {grains}
sizes: {{law: uniform, radius: [3 mm, 7 mm]}}
density: 2650
{space}
script: {script}
pressure: 100 kPa
friction: {friction}
{rolling}seed: {seed}
"""
SPECIMEN = """title: A closed saturated specimen of {name}
continuum: cauchy
deformation: large
mesh: {{rectangle: {{size: [10 mm, 10 mm], elements: [1, 1]}}}}
materials: {{sand: {{model: cell, script: {script}, packing: {name}.h5}}}}
regions: {{all: sand}}
water: {{bulk_modulus: 1000 GPa, undrained: true}}
boundary:
  - {{on: bottom, fix: [u2]}}
  - {{on: bottom_left, fix: [u1]}}
  - {{on: top, move: {{u2: [[0 s, 0 mm], [1 s, -0.1 mm]]}}}}
  - {{on: [left, right], pressure: 100 kPa}}
steps: {{duration: 1 s, count: 10, tolerance: 1e-4, line_search: 3}}
monitors:
  p: {{on: all, water: pressure}}
output: {{every: 100}}
"""


def columns(file):
    """@returns the columns of a table as lists of numbers"""
    with open(file, encoding="utf-8") as text:
        rows = list(csv.DictReader(text))
    return {name: [float(row[name]) for row in rows if row[name]] for name in rows[0] if name not in ("packing", "test")}


def figures(file):
    """What an undrained test shows; the angle at phase transformation is that of the least p', where p' rises again by 5 %."""
    test = columns(file)
    p, angle, strain = test["p_Pa"], test["friction_angle_deg"], test["axial_strain"]
    least = min(range(len(p)), key=p.__getitem__)
    flows = p[least] < 0.01 * PRESSURE
    turns = not flows and p[least] < 0.99 * PRESSURE and max(p[least:]) > 1.05 * p[least]
    return {"void ratio": test["void_ratio"][0], "least p', kPa": 1e-3 * p[least], "at strain, %": 100 * strain[least],
            "angle there, deg": angle[least] if turns else math.nan, "p' at 10 %, kPa": 1e-3 * p[-1], "flows": float(flows),
            "turns": float(turns)}


def difference(box, mesh):
    """Largest difference of the pore pressure of the box and of the specimen, per cent of the pressure at the start."""
    test, history = columns(box), columns(mesh)
    worst = 0.0
    for amount, pressure in zip(history["time"], history["p"]):
        strain = 0.01 * amount
        of_box = min(range(len(test["axial_strain"])), key=lambda row: abs(test["axial_strain"][row] - strain))
        if amount > 0.0 and abs(test["axial_strain"][of_box] - strain) < 1e-9:
            if test["p_Pa"][of_box] < 0.2 * PRESSURE:
                break
            worst = max(worst, abs(pressure - test["pore_pressure_Pa"][of_box]))
    return 100 * worst / PRESSURE


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("-o", "--output", type=pathlib.Path, required=True)
    arguments.add_argument("--packings", type=int, default=5)
    arguments.add_argument("--specimens", type=int, default=3, help="so many of them beside their box")
    arguments.add_argument("--program", type=pathlib.Path, default=HERE / "../../build/release/app/polargrain")
    options = arguments.parse_args()
    place, program = options.output.resolve(), options.program.resolve()
    place.mkdir(parents=True, exist_ok=True)
    programs = Programs()
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, programs.stop)
    for kind, what in KINDS.items():
        tests, specimens = {}, {}
        for way, (friction, rolling) in what["ways"].items():
            for seed in range(1, options.packings + 1):
                name = f"{kind}_{way}_{seed}"
                log = place / f"{name}.log"

                def run(made, *command):
                    if not (place / made).exists():
                        programs.call(log, program, *command, "--quiet", folder=place)

                (place / f"{name}.yaml").write_text(PACKING.format(
                    name=name, friction=friction, seed=seed, rolling=f"rolling_friction: {rolling}\n" if friction else "", **what),
                    encoding="utf-8")
                run(f"{name}.h5", "pack", f"{name}.yaml", "-o", f"{name}.h5")
                run(f"{name}.csv", "element", "--test", what["test"], "--pressure", "100kPa", f"{name}.h5", what["script"], "-o", name,
                    "--set", "drainage=undrained", "--set", "axial_strain=10%")
                tests.setdefault(way, []).append(figures(place / f"{name}.csv"))
                if seed > options.specimens or kind == "spheres":
                    continue
                (place / f"{name}.case.yaml").write_text(SPECIMEN.format(name=name, script=what["script"]),
                                                         encoding="utf-8")
                try:
                    run(f"{name}.mesh/summary.json", "run", f"{name}.case.yaml", "-o", f"{name}.mesh")
                except Failed as error:
                    if programs.stopped:
                        sys.exit("undrained.py: stopped; the same command goes on")
                    print(f"{name}: the specimen ended early\n{error}")
                specimens.setdefault(way, []).append(
                    {"largest difference, %": difference(place / f"{name}.csv", place / f"{name}.mesh/history.csv")})
        table(f"{kind}, {what['test']}", tests, list(next(iter(tests.values()))[0]))
        if specimens:
            table(f"{kind}, saturated specimen", specimens, ["largest difference, %"])


if __name__ == "__main__":
    main()
