#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The internal length of the grains alone: moduli and limits of skew and couple stress of cells with controlled rotations.

    python3 internal_length.py [--program POLARGRAIN] [-o RESULTS] [--size reduced|full] [--jobs 2]

reduced: 3 packings of 100 discs; full: 10 of 100, 10 of 400 and 3 of 1,600 (about half an hour of two cores). Each packing, under each contact law, is
sheared at constant volume to three states; from each state it is bent (curvature k1) and its grains are turned against the box (micro-rotation).
What is there already is not made again. Prints tables in Markdown: mean and 95 % interval over the packings.

docs/studies/internal_length.md shows the full size and says what follows.
"""
import argparse
import concurrent.futures
import json
import math
import os
import pathlib

import numpy

from built_package import polargrain
from intervals import interval

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
FRICTION = math.tan(0.5)
DIAMETER = 0.01  # m, mean
STATES = (0.0, 0.01, 0.04)  # axial strain at constant volume
STRAIN = 1e-3               # of an increment on the way there
CURVATURES = (0.002, 0.01, 0.03, 0.1, 0.3, 0.6, 1.0, 1.5, 2.0, 2.5, 3.0, 3.6)  # rad/m, reached one after the other
TURNS = (1e-5, 1e-4, 3e-4, 1e-3, 2e-3, 4e-3, 7e-3, 1e-2, 1.5e-2, 2e-2, 2.5e-2, 3e-2)  # rad

S11, S12, S21, S22, M13 = range(5)  # places in the vector of a cell's stresses
DENSE = {"sizes": {"law": "uniform", "radius": ["3 mm", "7 mm"]}, "density": 2650.0, "thickness": "100 mm", "script": "cells/hooke_radii.in",
         "pressure": "100 kPa", "friction": 0.0}

# name: coefficient of rolling resistance, rolling friction force
LAWS = {"no rolling resistance": (0.0, False), "0.2": (0.2, False), "0.4": (0.4, False),
        "0.4, with rolling friction force": (0.4, True)}


def script_of(rolling, force):
    text = (ROOT / "liggghts_inputs/cells/hooke_li_chu.in").read_text(encoding="utf-8")
    lines = []
    for line in text.splitlines():
        if "coefficientRollingFriction " in line:
            line = line.replace("peratomtypepair 1 0.2", f"peratomtypepair 1 {rolling}")
        if line.startswith("pair_style") and rolling == 0.0:
            line = "pair_style gran model hooke/radii tangential li_chu"
        if line.startswith("pair_style") and force:
            lines += ["fix force_ratio all property/global rollingFrictionForceStiffnessRatio peratomtypepair 1 0.1",
                      "fix force_friction all property/global coefficientRollingFrictionForce peratomtypepair 1 0.05"]
            line += " rollingFrictionForce on"
        lines.append(line)
    return "\n".join(lines) + "\n"


class Study:
    def __init__(self, place):
        self.place = place
        place.mkdir(parents=True, exist_ok=True)
        for name, (rolling, force) in LAWS.items():
            self.script(name).write_text(script_of(rolling, force), encoding="utf-8")

    def script(self, law):
        return self.place / f"law{list(LAWS).index(law)}.in"

    def packing(self, grains, seed):
        packing = self.place / f"grains{grains}-seed{seed}.h5"
        if not packing.exists():
            polargrain.pack({**DENSE, "grains": grains, "seed": seed}, packing)
        return packing

    def answers(self, grains, seed, law, state):
        """@returns what the cell answers to CURVATURES and to TURNS from the state on, that of the state itself first"""
        file = self.place / f"grains{grains}-seed{seed}-law{list(LAWS).index(law)}-{state:g}.json"
        if file.exists():
            return [numpy.array(rows) for rows in json.loads(file.read_text(encoding="utf-8"))]
        with polargrain.Engines() as engines:
            cell = polargrain.Cell(self.packing(grains, seed), self.script(law), rotations="controlled", engines=engines,
                                   unbalanced_force_ratio=1e-4, unbalanced_moment_ratio=1e-4, inertial_number=2e-4)
            shear = {"displacement_gradient": numpy.diag([STRAIN, -STRAIN])}
            start = follow(cell, [shear] * round(state / STRAIN))[-1:] or [cell.at_rest.vector]
            sheared = cell.state
            nothing = numpy.zeros((2, 2))
            bent = follow(cell, [{"displacement_gradient": nothing, "curvature": [b - a, 0.0]}
                                 for a, b in zip((0.0, *CURVATURES), CURVATURES)])
            cell.state = sheared
            turned = follow(cell, [{"displacement_gradient": nothing, "rotation": b - a}
                                   for a, b in zip((0.0, *TURNS), TURNS)])
        both = [numpy.array(start + rows) for rows in (bent, turned)]
        file.write_text(json.dumps([rows.tolist() for rows in both]), encoding="utf-8")
        return both

    def figures(self, grains, seed, law, state):
        bent, turned = self.answers(grains, seed, law, state)
        skew_of = lambda rows: rows[:, S21] - rows[:, S12]
        pressure_of = lambda row: -0.5 * (row[S11] + row[S22])
        start, pressure = bent[0], pressure_of(bent[0])
        couple = bent[1:, M13] - start[M13]
        skew = skew_of(turned[1:]) - skew_of(turned[:1])
        return {"pressure": pressure / 1e3, "ratio": abs(start[S11] - start[S22]) / (2.0 * pressure), "B": couple[0] / CURVATURES[0],
                "B at 0.3": couple[CURVATURES.index(0.3)] / 0.3,
                "m/p": bent[-1, M13] / pressure_of(bent[-1]) * 1e3 if len(couple) == len(CURVATURES) else math.nan,
                "Gc": skew[0] / (4.0 * TURNS[0]) / 1e6,
                "skew/p": skew_of(turned[-1:])[0] / pressure_of(turned[-1])}


def follow(cell, increments):
    """Leads a cell along increments, as far as it answers. @returns the good answers: stresses and couple stresses"""
    answers = []
    for increment in increments:
        answer = cell.evaluate(**increment)
        if answer.quality == "failed":
            break
        cell.state = answer.state
        if answer.quality == "good":
            answers.append(answer.vector)
    return answers


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--program", help="[that of the package polargrain]")
    arguments.add_argument("-o", "--results", default="internal_length")
    arguments.add_argument("--size", choices=("reduced", "full"), default="reduced")
    arguments.add_argument("--jobs", type=int, default=2)
    options = arguments.parse_args()
    if options.program:
        os.environ["POLARGRAIN_PROGRAM"] = str(pathlib.Path(options.program).resolve())
    study = Study(pathlib.Path(options.results).resolve())
    packings = {100: range(1, 4)} if options.size == "reduced" else {100: range(1, 11), 400: range(1, 11), 1600: range(1, 4)}
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        list(pool.map(lambda pair: study.packing(*pair), [(n, seed) for n, seeds in packings.items() for seed in seeds]))
        wanted = [(n, seed, law, state) for law in LAWS for state in STATES for n, seeds in packings.items() for seed in seeds]
        found = dict(zip(wanted, pool.map(lambda one: study.figures(*one), wanted)))
    print("| rolling resistance | state | grains | p, kPa | q/p | B, N | B at 0.3 rad/m, N | m/p at 3.6 rad/m, mm | Gc, MPa | (s21 - s12) / p |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    for law in LAWS:
        for state in STATES:
            for grains, seeds in packings.items():
                rows = [found[grains, seed, law, state] for seed in seeds]
                cells = [interval([row[key] for row in rows])
                         for key in ("pressure", "ratio", "B", "B at 0.3", "m/p", "Gc", "skew/p")]
                print(f"| {law} | {100 * state:g} % | {grains} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
