#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Contact parameters of Toyoura sand from one plane strain compression test, by nonlinear least squares (scipy).

    python3 calibrate.py -o results/toyoura --jobs 16                        search, then predictions
    python3 calibrate.py -o results/toyoura --evaluations 1 --starts 1       to see that it works

What is fitted: the pre-peak branch and the peak at 49 kPa, nothing else. Three unknowns: contact modulus, coefficient of
sliding friction, coefficient of rolling friction. Each evaluation compresses one element of the model `informed` for each of
the packings and compares their mean curve. A point of the search and its neighbours for the derivatives are evaluated at the
same time, each packing by a process of its own.

record.csv has a row an evaluation; those that are there already are not made again, so that a search that was broken off
goes on. best.txt has the result, prediction-*.csv the curves of each packing at 49 and 98 kPa with it.
"""
import argparse
import csv
import math
import os
import pathlib
import shutil
import sys
from concurrent.futures import ThreadPoolExecutor

import numpy
from scipy.optimize import least_squares

import sand
from laboratory import CURVES

# What is fitted: the laboratory's curve at 49 kPa after its start, up to the peak.
PEAK_STRAIN = 2.05  # %
RATIO = [point for point in CURVES[49]["ratio"] if 0 < point[0] <= PEAK_STRAIN]
VOLUME = [point for point in CURVES[49]["volume"] if 0 < point[0] <= PEAK_STRAIN]
RATIO_SCATTER = 0.2   # what counts as one: the laboratory's 1.5 degrees are 0.5 in the ratio
VOLUME_SCATTER = 0.2  # %
# The search works on the logarithms, of the modulus in MPa. Several starts, as friction may be traded for rolling.
STARTS = [(9e8, 0.4, 0.3), (9e8, 0.8, 0.3), (9e8, 0.4, 0.8)]
LIMITS = [(1e8, 1e10), (0.1, 1.5), (0.02, 3.0)]
UNITS = numpy.array([1e6, 1.0, 1.0])
# For the derivatives each parameter is raised by so much: well above what the noise of the grains would drown.
DIFFERENCE = 0.12
# The search has converged when the misfit falls by less than this share, or when a correction of the logarithms is
# shorter than 0.005 of their length (about 7: 3 % of a parameter).
MISFIT_TOLERANCE, STEP_TOLERANCE = 0.02, 0.005

# One point, in effect: of all that the element could do but deform evenly, shear is left, and held by G and Gc as w is fixed.
CASE = """title: One element of Toyoura sand at {kpa:g} kPa
mesh: {{rectangle: {{size: [10 mm, 10 mm], elements: [1, 1]}}, element: Q4}}
materials:
  sand: {material}
regions: {{all: sand}}
boundary:
  - {{on: bottom, fix: [u2]}}
  - {{on: left, fix: [u1]}}
  - {{on: [left, right], fix: [w]}}
  - {{on: top, move: {{u2: -{move:g} mm}}}}
  - {{on: right, pressure: {kpa:g} kPa}}
steps: {{tolerance: 2e-3, line_search: 3, acceleration: 5, stages: [{{until: {first:.6g}, count: 16}}, {{until: 1, count: {count}}}]}}
monitors:
  top_force: {{on: top, reaction: u2}}
  shortening: {{on: top, displacement: u2}}
  axial_strain: -shortening / 10 mm
  stress_ratio: -top_force / {kpa:g} kPa / 10 mm
output: {{every: 1000, checkpoint_minutes: 60}}
"""


def options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True)
    parser.add_argument("--evaluations", type=int, default=15, help="most corrections of a search [15]")
    parser.add_argument("--starts", type=int, default=len(STARTS), help="searches, each from a start of its own [3]")
    parser.add_argument("--grains", type=int, default=400, help="discs of a cell [400]")
    parser.add_argument("--packings", type=int, default=6, help="seeds 1, 2, ... whose mean curve is calibrated [6]")
    parser.add_argument("--no-predictions", action="store_true")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="processes at a time [cores]")
    sand.add_programs(parser)
    return parser.parse_args()


class Calibration:
    def __init__(self, given):
        self.given = given
        self.output = given.output.resolve()
        self.polargrain, self.liggghts = sand.programs(given)
        self.seeds = range(1, given.packings + 1)
        self.pool = ThreadPoolExecutor(given.jobs)
        self.work = self.output / "work"
        self.packings = dict(zip(self.seeds, self.pool.map(
            lambda seed: sand.make_packing(self.polargrain, self.output / "packings", seed, given.grains), self.seeds)))
        self.record = self.output / "record.csv"
        self.known = {}
        self.columns = [*sand.NAMES, "misfit", "peak", "peak_strain"] + [f"difference{k}" for k in range(10)]
        if self.record.exists():
            with open(self.record, newline="") as file:
                for row in csv.DictReader(file):
                    self.known[tuple(row[name] for name in sand.NAMES)] = row
        else:
            self.record.parent.mkdir(parents=True, exist_ok=True)
            self.record.write_text(",".join(self.columns) + "\n")

    def curve(self, key, pressure, seed, strain):
        """Axial strain, volume strain (%, contraction positive) and stress ratio, along compression to `strain`."""
        parameters = dict(zip(sand.NAMES, map(float, key)))
        folder = self.work / "-".join([*key, f"{pressure:g}", str(seed)])
        folder.mkdir(parents=True, exist_ok=True)
        sand.consolidate(self.liggghts, self.packings[seed], parameters, pressure, folder)
        sand.write_script(folder / "cell.in", parameters)
        (folder / "case.yaml").write_text(CASE.format(
            kpa=pressure / 1e3, move=10 * strain, first=0.004 / strain, count=round((strain - 0.004) / 1e-3),
            material=sand.material(parameters, "packing.csv")))
        try:
            sand.run([self.polargrain, "run", "case.yaml", "-o", "out", "--quiet", "-w", "1"], folder)
        except RuntimeError as error:  # a cell may collapse; what it did until then counts, and is drawn on
            print(error, file=sys.stderr, flush=True)
        with open(folder / "out/history.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        shutil.rmtree(folder)
        return numpy.array([[100 * float(row["axial_strain"]), float(row["stress_ratio"]),
                             -100 * float(row["volume_strain"])] for row in rows]).T

    def evaluate(self, keys):
        """Rows of the record for parameters; those that are not known yet all at the same time."""
        missing = [key for key in dict.fromkeys(keys) if key not in self.known]
        runs = {key: [self.pool.submit(self.curve, key, 49e3, seed, 0.03) for seed in self.seeds] for key in missing}
        for key in missing:
            # The mean over the packings: one alone is known to some degrees of friction angle only.
            axial = numpy.linspace(0, 3, 61)
            curves = [run.result() for run in runs[key]]
            ratio, volume = (numpy.mean([numpy.interp(axial, curve[0], curve[k]) for curve in curves], axis=0) for k in (1, 2))
            terms = differences(axial, ratio, volume)
            row = dict(zip(self.columns, [*key, f"{numpy.mean(numpy.square(terms)):.6g}", f"{ratio.max():.4f}",
                                          f"{axial[ratio.argmax()]:.3f}", *(f"{term:.6g}" for term in terms)]))
            self.known[key] = row
            with open(self.record, "a") as file:
                file.write(",".join(row.values()) + "\n")
            print(f"{len(self.known):3d}", ", ".join(f"{name} {row[name]}" for name in self.columns[:6]), flush=True)
        return [self.known[key] for key in keys]

    def search(self, start):
        """Least squares from a start; returns what scipy says."""
        def keys(logarithms):
            neighbours = numpy.vstack([logarithms, logarithms + DIFFERENCE * numpy.eye(3)])
            return [tuple(f"{value:.6g}" for value in UNITS * numpy.exp(each)) for each in neighbours]

        def vectors(logarithms):
            rows = self.evaluate(keys(logarithms))
            return [numpy.array([float(row[name]) for name in self.columns[6:]]) for row in rows]

        limits = numpy.log(numpy.array(LIMITS).T / UNITS)
        return least_squares(lambda x: vectors(x)[0], numpy.log(start / UNITS), bounds=limits,
                             jac=lambda x: (numpy.array(vectors(x)[1:]) - vectors(x)[0]).T / DIFFERENCE,
                             ftol=MISFIT_TOLERANCE, xtol=STEP_TOLERANCE, gtol=None, max_nfev=self.given.evaluations)

    def calibrate(self):
        report = ""
        for number, start in enumerate(STARTS[:self.given.starts], start=1):
            result = self.search(start)
            found = ", ".join(f"{value:.4g}" for value in UNITS * numpy.exp(result.x))
            report += (f"start {number} = {', '.join(f'{value:.4g}' for value in start)}: ends at {found}, "
                       f"misfit {numpy.mean(result.fun**2):.4g}, {result.nfev} corrections, {result.message}\n")
            best = min(self.known, key=lambda key: float(self.known[key]["misfit"]))
            text = "".join(f"{name} = {value}\n" for name, value in zip(sand.NAMES, best))
            (self.output / "best.txt").write_text(f"{text}misfit = {self.known[best]['misfit']}\n"
                                                  f"evaluations = {len(self.known)}\n{report}")
        print((self.output / "best.txt").read_text(), flush=True)
        return best

    def predict(self, key):
        def one(pressure, seed):
            curve = self.curve(key, pressure, seed, 0.06)
            numpy.savetxt(self.output / f"prediction-{pressure / 1e3:g}kPa-seed{seed}.csv", curve.T, delimiter=",",
                          fmt="%.6g", comments="", header="axial_strain,stress_ratio,volume_strain")
            return f"{pressure / 1e3:g} kPa, seed {seed}: peak {curve[1].max():.3f} at {curve[0][curve[1].argmax()]:.2f} %"
        for line in [self.pool.submit(one, pressure, seed) for pressure in (49e3, 98e3) for seed in self.seeds]:
            print(line.result(), flush=True)


def differences(axial, ratio, volume):
    """Calculated less measured, each over its scatter; the peak of the curve counts as a point."""
    terms = [(numpy.interp(strain, axial, ratio) - value) / RATIO_SCATTER for strain, value in RATIO]
    terms.append((ratio.max() - RATIO[-1][1]) / RATIO_SCATTER)
    terms += [(numpy.interp(strain, axial, volume) - value) / VOLUME_SCATTER for strain, value in VOLUME]
    return numpy.array(terms)


def main():
    given = options()
    calibration = Calibration(given)
    best = calibration.calibrate()
    if not given.no_predictions:
        calibration.predict(best)


if __name__ == "__main__":
    main()
