#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""A band of cells that softens as slowly as one of grains: a column in which every slip drags its neighbours along.

    python3 layer_spread.py -o RESULTS [--lengths 0 4 5 6 8] [--kernel helmholtz] [--columns 5] [--layers FOLDER] [--program POLARGRAIN]

A column of places, a cell each, periodic along its height, under constant normal stress. What slips at place j is spread over its
neighbours with weights W, in height the square of a hyperbolic secant whose full width at half maximum is the length (0: not at all), so
that a cell is sheared by the mean over the slips around it (helmholtz: the weights of the finite elements, docs/theory/spread.md), and a place slips when the mean of its neighbours' strengths, with the same
weights, is the shear stress T of the column (virtual work):

    shear of cell i     g_i = sum_j W_ij a_j
    balance of place j  sum_i W_ij s21_i + stiffness min(0, a_j) = T          (an increment of slip does not go backwards freely)
    balance of cell i   s22_i = -p

Rotations of the grains are free, there is no couple stress and no other length. Each cell has a packing of its own. What is driven is the
displacement less what is elastic, so that a column may snap back. Lengths in mean diameters of the grains. What is there already is not
made again; FOLDER, of `polargrain layer`, has layers of grains to compare with. Prints tables in Markdown: mean and 95 % interval.
"""
import argparse
import json
import math
import os
import pathlib
import statistics

import numpy

from built_package import polargrain
from dumps import read_grains
from intervals import table
from layer_study import DIAMETER, PRESSURE, band
from polargrain.table import read_table

HERE = pathlib.Path(__file__).resolve().parent
SCRIPT = "cells/hooke_li_chu.in"
HEIGHT = 20.0         # of a column, d
STIFFNESS = 2e7       # Pa; above that of a packing at rest
FIRST, STEP = 0.03, 0.08  # driven displacement of a step before and behind 0.4 d, d
TOLERANCE, ITERATIONS, MEMORY = 0.01, 10, 5  # of the normal stress; acceleration by so many former iterations
ACCEPTED = (0.03, 0.03, 0.03, 0.1, 0.3, 1.0)  # of the normal stress, when no iteration comes to the tolerance: by the number of cuts
VISCOSITY = 1e-3      # of the stiffness, on an increment of slip: what is spread leaves fast oscillations of the slips undetermined
FURTHEST = 0.01       # shear or rise by which an iteration may change a cell
SOFTEST = 0.1         # of the packing's stiffness at rest: below that iterations overshoot
WIDTHS = {1: 2.0 * math.log(2.0), 2: 3.35669398}  # of (1 - l^2 lap)^-1 once and twice, l
WAYS = (0.5, 1.0, 1.5, 2.0, 3.0, 4.0)   # past the peak, d


def weights(places, spacing, length, kernel):
    """@returns W: columns and rows add up to 1"""
    if length == 0.0:
        return numpy.eye(places)
    if kernel.startswith("helmholtz"):  # helmholtz2: that of the finite elements (docs/theory/spread.md)
        times = 2 if kernel.endswith("2") else 1
        apart = length / WIDTHS[times] / spacing
        neighbours = numpy.roll(numpy.eye(places), 1, axis=0) + numpy.roll(numpy.eye(places), -1, axis=0)
        once = numpy.linalg.inv((1.0 + 2.0 * apart**2) * numpy.eye(places) - apart**2 * neighbours)
        return numpy.linalg.matrix_power(once, times)
    apart = numpy.abs(numpy.subtract.outer(numpy.arange(places), numpy.arange(places)))
    apart = numpy.minimum(apart, places - apart) * spacing
    kernel = numpy.cosh(numpy.minimum(2.0 * math.acosh(math.sqrt(2.0)) * apart / length, 300.0)) ** -2.0
    return kernel / kernel.sum(axis=0)


class Column:
    """@param cells from bottom to top @param spacing d"""

    def __init__(self, cells, spacing, length, kernel):
        self.cells = cells
        self.spread = weights(len(cells), spacing, length, kernel)
        self.heights = numpy.full(len(cells), spacing)  # current, d
        self.at_rest = [statistics.mean(cell.at_rest.tangent[k, k] for cell in cells) for k in (2, 3)]
        self.stress = statistics.mean(cell.at_rest.stress[1, 0] for cell in cells)
        self.slips = numpy.zeros(len(cells))  # of the last step
        self.rises = numpy.zeros(len(cells))
        self.drive = FIRST
        self.iterations = self.evaluations = 0
        self.rests = []  # of each step, parts of the normal stress

    def ask(self, slips, rises):
        """@returns answers to these increments, or None"""
        shear = self.spread @ slips
        answers = [cell.evaluate(displacement_gradient=[[0.0, g], [0.0, e]]) for cell, g, e in zip(self.cells, shear, rises)]
        self.evaluations += len(answers)
        return answers if all(answer.quality != "failed" for answer in answers) else None

    def step(self, drive, accepted):
        """@param accepted unbalanced part of the normal stress @returns whether it came so far"""
        count = len(self.cells)
        x = numpy.concatenate([self.slips * (drive / self.drive), self.rises * (drive / self.drive), [self.stress]])
        best, tried, moves = None, [], []
        for iteration in range(ITERATIONS):
            answers = self.ask(x[:count], x[count:-1])
            if answers is None:
                return False
            self.iterations += 1
            s21, s22 = (numpy.array([answer.stress[1, k] for answer in answers]) for k in (0, 1))
            back = x[:count] < 0.0
            shear = self.spread @ x[:count]
            rest = numpy.concatenate([self.spread.T @ s21 + STIFFNESS * (back + VISCOSITY) * x[:count] - x[-1], s22 + PRESSURE,
                                      [(self.heights @ shear - self.heights.sum() * (x[-1] - self.stress) / STIFFNESS - drive) * PRESSURE]])
            size = max(numpy.abs(rest[:-1]).max(), abs(rest[-1] / drive)) / PRESSURE
            if all(answer.quality == "good" for answer in answers) and (best is None or size < best[0]):
                best = (size, x.copy(), answers)
            if size < TOLERANCE and best is not None and best[0] == size:
                break
            tangent = numpy.array([answer.tangent[2:4, 2:4] for answer in answers])
            for k in (0, 1):
                tangent[:, k, k] = numpy.maximum(tangent[:, k, k], SOFTEST * self.at_rest[k])
            matrix = numpy.zeros((2 * count + 1, 2 * count + 1))
            matrix[:count, :count] = self.spread.T @ (tangent[:, 0, 0, None] * self.spread) + STIFFNESS * numpy.diag(back + VISCOSITY)
            matrix[:count, count:-1] = self.spread.T * tangent[:, 0, 1]
            matrix[count:-1, :count] = tangent[:, 1, 0, None] * self.spread
            matrix[count:-1, count:-1] = numpy.diag(tangent[:, 1, 1])
            matrix[:count, -1] = -1.0
            matrix[-1, :count] = self.heights @ self.spread * PRESSURE
            matrix[-1, -1] = -self.heights.sum() / STIFFNESS * PRESSURE
            tried.append(x.copy())
            moves.append(-numpy.linalg.solve(matrix, rest))
            move = accelerated(tried[-MEMORY:], moves[-MEMORY:]) - x
            largest = max(numpy.abs(self.spread @ move[:count]).max(), numpy.abs(move[count:-1]).max())
            x = x + move * min(1.0, FURTHEST / largest)
        if best is None or best[0] > accepted:
            return False
        self.rests.append(best[0])
        _, x, answers = best
        for cell, answer in zip(self.cells, answers):
            cell.state = answer.state
        self.slips, self.rises, self.stress = x[:count], x[count:-1], x[-1]
        self.drive = drive
        self.heights = self.heights * (1.0 + self.rises)
        return True


def accelerated(tried, moves):
    """Anderson's combination of former iterations: that whose moves cancel best."""
    if len(moves) < 2:
        return tried[-1] + moves[-1]
    scale = numpy.concatenate([numpy.ones(len(moves[-1]) - 1), [1e-8]])  # strains beside a stress
    differences = numpy.diff(numpy.array(moves), axis=0).T
    places = numpy.diff(numpy.array(tried), axis=0).T
    factors = numpy.linalg.lstsq(scale[:, None] * differences, scale * moves[-1], rcond=1e-6)[0]
    return tried[-1] + moves[-1] - (places + differences) @ factors


def run(file, packings, places, length, kernel, way, engines):
    """Shears a column until `way` past its peak. @returns rows of displacement (d), ratio and shear of every cell; and costs"""
    if file.exists():
        kept = json.loads(file.read_text(encoding="utf-8"))
        return kept["rows"], kept["costs"]
    column = Column([polargrain.Cell(packing, SCRIPT, engines=engines) for packing in packings], HEIGHT / places, length, kernel)
    rows = [(0.0, column.stress / PRESSURE, [0.0] * places)]
    total, displacement, driven, peak = numpy.zeros(places), 0.0, 0.0, (0.0, 0.0)
    steps = cut = 0
    while displacement < peak[1] + way and driven < way + 4.0:
        drive = (FIRST if driven < 0.4 else STEP) * 0.5 ** cut
        if not column.step(drive, ACCEPTED[cut]):
            cut += 1
            if cut == len(ACCEPTED):
                break
            continue
        cut = 0 if cut > 2 else max(0, cut - 1)  # a jump is passed; small steps would go back and forth over it
        steps += 1
        driven += drive
        shear = column.spread @ column.slips
        displacement += float(column.heights @ shear)
        total += shear
        rows.append((displacement, column.stress / PRESSURE, total.tolist()))
        peak = max(peak, (column.stress / PRESSURE, displacement))
    costs = {"steps": steps, "iterations": column.iterations / steps, "rest, mean": statistics.mean(column.rests), "rest, largest": max(column.rests), "evaluations": column.evaluations}
    file.write_text(json.dumps({"rows": rows, "costs": costs}), encoding="utf-8")
    return rows, costs


def about(displacements, ratios, at, reach=0.25):
    near = [ratio for place, ratio in zip(displacements, ratios) if abs(place - at) <= reach]
    return statistics.mean(near) if near else math.nan


def softening(displacements, ratios):
    """Peak of the running mean over half a diameter, where it is, and what is left of it."""
    running = [about(displacements, ratios, at) for at in displacements]
    peak = max(running)
    peak_at = displacements[running.index(peak)]
    last = displacements[-1]
    left = {f"{way:g} d": about(displacements, ratios, peak_at + way) / peak if peak_at + way < last + 0.3 else math.nan for way in WAYS}
    return {"peak": peak, "at": peak_at, **left}


def thickness(rows, centre, height):
    """Of the band in a window of a diameter of displacement about `centre`; nan beyond the curve"""
    displacements = [row[0] for row in rows]
    if displacements[-1] < centre + 0.3:
        return math.nan
    first, last = (min(range(len(rows)), key=lambda k: abs(displacements[k] - at)) for at in (centre - 0.5, centre + 0.5))
    shear = numpy.array(rows[last][2]) - numpy.array(rows[first][2])
    shear = numpy.roll(shear, len(shear) // 2 - int(shear.argmax()))
    spacing = height / len(shear)
    moved = numpy.concatenate([[0.0], numpy.cumsum(shear * spacing)])
    return band(numpy.arange(len(moved)) * spacing * DIAMETER, moved * DIAMETER)[0] / DIAMETER


WINDOWS = (1.0, 2.0, 3.0, 4.0)  # middles, past the peak, d


def of_column(rows, height=HEIGHT):
    figures = softening([row[0] for row in rows], [row[1] for row in rows])
    return {**figures, **{f"thickness {at:g} d": thickness(rows, figures["at"] + at, height) for at in WINDOWS}}


def of_layer(folder, diameter=DIAMETER, pressure=PRESSURE):
    """The same of a layer of grains that `polargrain layer` has sheared."""
    history = read_table(folder / "history.csv")
    displacements = [value / diameter for value in history["displacement"]]
    figures = softening(displacements, [value / pressure for value in history["shear_stress"]])
    dumps = {int(file.stem.split("-")[1]): file for file in (folder / "grains").glob("step-*.dump")}
    places = {step: place for step, place in zip(history["step"], displacements)}
    known = [(places.get(step, 0.0), file) for step, file in sorted(dumps.items())]
    for at in WINDOWS:
        centre = figures["at"] + at
        if known[-1][0] < centre + 0.3:
            figures[f"thickness {at:g} d"] = math.nan
            continue
        before, after = (read_grains(min(known, key=lambda one: abs(one[0] - place))[1]) for place in (centre - 0.5, centre + 0.5))
        figures[f"thickness {at:g} d"] = band(0.5 * (before[:, 2] + after[:, 2]), after[:, 1] - before[:, 1])[0] / diameter
    return figures


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("-o", "--output", type=pathlib.Path, required=True)
    arguments.add_argument("--lengths", type=float, nargs="+", default=[0.0, 4.0, 5.0, 6.0, 8.0])
    arguments.add_argument("--kernel", choices=["sech2", "helmholtz", "helmholtz2"], default="sech2")
    arguments.add_argument("--columns", type=int, default=5)
    arguments.add_argument("--places", type=int, default=20)
    arguments.add_argument("--grains", type=int, default=100, help="of a cell")
    arguments.add_argument("--way", type=float, default=4.5, help="past the peak, d")
    arguments.add_argument("--layers", type=pathlib.Path)
    arguments.add_argument("--program")
    arguments.add_argument("--check", action="store_true", help="fail when the longest spread does not soften more slowly in a thicker band than none")
    options = arguments.parse_args()
    if options.program:
        os.environ["POLARGRAIN_PROGRAM"] = str(pathlib.Path(options.program).resolve())
    place = options.output.resolve()
    place.mkdir(parents=True, exist_ok=True)
    specification = {"sizes": {"law": "uniform", "radius": ["3 mm", "7 mm"]}, "density": 2650.0, "thickness": "100 mm",
                     "script": "cells/hooke_radii.in", "pressure": "100 kPa", "friction": 0.0, "grains": options.grains}
    groups, costs = {}, {}
    for number, length in [(number, length) for length in options.lengths for number in range(options.columns)]:
        packings = []
        for k in range(20):
            packings.append(place / f"grains{options.grains}-seed{100 + 20 * number + k}.h5")
            if not packings[-1].exists():
                polargrain.pack({**specification, "seed": 100 + 20 * number + k}, packings[-1])
        name = f"column{number}-{options.grains}-{options.places}-{length:g}" + ("" if options.kernel == "sech2" else "-" + options.kernel)
        # Finer meshes have the same packings at the same heights.
        here = [packings[k * 20 // options.places] for k in range(options.places)]
        with polargrain.Engines() as engines:
            rows, cost = run(place / f"{name}.json", here, options.places, length, options.kernel, options.way, engines)
        groups.setdefault(f"{length:g} d", []).append(of_column(rows))
        costs.setdefault(f"{length:g} d", []).append(cost)
        print(name, groups[f"{length:g} d"][-1], cost, flush=True)
    if options.check:
        mean = lambda length, key: statistics.mean(one[key] for one in groups[f"{length:g} d"])
        least, most = min(options.lengths), max(options.lengths)
        if not (mean(most, "1 d") > mean(least, "1 d") + 0.1 and abs(mean(most, "thickness 1 d") / most - 1.0) < 0.25):
            raise SystemExit("the spread does not set thickness and softening as the page says")
    if options.layers:
        groups["grains"] = [of_layer(folder) for folder in sorted(options.layers.glob("layer*-seed*"))]
    keys = list(next(iter(groups.values()))[0])
    table("length of the spread", groups, keys)
    table("costs", costs, ("steps", "iterations", "rest, mean", "rest, largest", "evaluations"))


if __name__ == "__main__":
    main()
