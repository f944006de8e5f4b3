#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Specimens of Toyoura sand in plane strain compression, predicted: calibrate.py's parameters and packings, nothing fitted.

    python3 specimen.py -o results/toyoura --jobs 16              after calibrate.py -o results/toyoura
    python3 specimen.py -o results/toyoura --sizes 6:2 --strain 0.5     to see that it works

The specimens have the laboratory's proportions (height over width 2.5 at 49 kPa, 2 at 98 kPa) between smooth platens, but
are fewer grains wide: --sizes WIDTH:ELEMENTS, width in d50 and elements across it. Several sizes show what that does. The
patch in the corner, where a band may begin, is the packing that is weakest at 49 kPa; the rest that of the others whose peak is
nearest to the mean.

specimen-PRESSURE-WIDTH-ELEMENTS/ are result directories of polargrain; those that are done are kept, those that were broken
off go on. specimen.csv has their figures.
"""
import argparse
import csv
import json
import os
import pathlib
import sys
from concurrent.futures import ThreadPoolExecutor

import numpy

import sand

PROPORTIONS = {49: 2.5, 98: 2.0}  # height over width
# Up to so much axial strain (%) in steps of so much, then in those of --step: in the band a step is several times as large.
FIRST_STEPS = [(0.4, 0.025), (1.8, 0.1)]

CASE = """title: Toyoura sand at {kpa} kPa, {width:g} d50 wide
mesh:
  rectangle: {{size: [{w:.6g}, {h:.6g}], elements: [{across}, {along}], patch: [{patch:.6g}, {patch:.6g}]}}
materials:
  sand: {sand}
  weak: {weak}
regions: {{rest: sand, patch: weak}}
boundary:
  - {{on: bottom, fix: [u2]}}                  # smooth platens
  - {{on: bottom_left, fix: [u1]}}
  - {{on: top, move: {{u2: -{move:.8g}}}}}
  - {{on: [left, right], pressure: {kpa} kPa}}
steps:
  tolerance: 5e-3
  cut: 8
  line_search: 3
  acceleration: 5
  stages: [{stages}]
monitors:
  top_force: {{on: top, reaction: u2}}
  shortening: {{on: top, displacement: u2}}
  axial_strain: -shortening / {h:.6g} m
  stress_ratio: -top_force / {kpa} kPa / {w:.6g} m
output: {{every: 1, checkpoint_minutes: 2, table: [axial_strain, stress_ratio, volume_strain]}}
"""


def options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True, help="results of calibrate.py")
    parser.add_argument("--sizes", nargs="+", default=["12:4", "18:4", "18:6", "30:10"], metavar="WIDTH:ELEMENTS",
                        help="specimens [12:4 18:4 18:6 30:10]: width in d50, elements across")
    parser.add_argument("--pressures", nargs="+", type=int, default=[49, 98], help="kPa, 49 or 98 [both]")
    parser.add_argument("--strain", type=float, default=8.0, help="axial strain at the end, %% [8]")
    parser.add_argument("--step", type=float, default=0.05, help="of axial strain from 1.8 %% on, %% [0.05]")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="worker processes of all runs together [cores]")
    sand.add_programs(parser)
    return parser.parse_args()


def parameters_of(results):
    try:
        lines = (results / "best.txt").read_text().splitlines()
    except FileNotFoundError:
        sys.exit(f"specimen.py: no best.txt in {results}; run calibrate.py -o {results} first")
    return {name: float(value) for name, value in (line.split(" = ") for line in lines[:len(sand.NAMES)])}


def seeds_of(results):
    """The packing of the sand and that of its weak corner."""
    peaks = {int(path.stem.rpartition("seed")[2]): numpy.loadtxt(path, delimiter=",", skiprows=1)[:, 1].max()
             for path in results.glob("prediction-49kPa-seed*.csv")}
    if len(peaks) < 2:
        sys.exit(f"specimen.py: fewer than two prediction-49kPa-seed*.csv in {results}; run calibrate.py -o {results} first")
    mean = numpy.mean(list(peaks.values()))
    weakest = min(peaks, key=peaks.get)
    del peaks[weakest]
    return min(peaks, key=lambda seed: abs(peaks[seed] - mean)), weakest


def stages(end, last_step):
    """The stages of steps up to an axial strain in %."""
    result, start = [], 0.0
    for until, step in [*FIRST_STEPS, (end, last_step)]:
        until = min(until, end)
        if until > start:
            result.append(f"{{until: {until / end:.10g}, count: {max(1, round((until - start) / step))}}}")
        start = max(start, until)
    return ", ".join(result)


class Specimen:
    def __init__(self, results, pressure, size):
        width, _, across = size.partition(":")
        self.pressure, self.width, self.across = pressure, float(width), int(across)
        self.along = round(self.across * PROPORTIONS[pressure])
        self.folder = results / f"specimen-{pressure}-{width}-{across}"
        self.cells = 4 * self.across * self.along

    def prepare(self, given, parameters, seeds):
        self.folder.mkdir(exist_ok=True)
        _, liggghts = sand.programs(given)
        for seed in seeds:
            if not (self.folder / f"packing{seed}.csv").exists():
                sand.consolidate(liggghts, given.output / "packings" / f"seed{seed}.data", parameters, self.pressure * 1e3,
                                 self.folder)
                os.replace(self.folder / "packing.csv", self.folder / f"packing{seed}.csv")
        sand.write_script(self.folder / "cell.in", parameters)
        width = self.width * sand.D50
        height = width * self.along / self.across
        (self.folder / "case.yaml").write_text(CASE.format(
            kpa=self.pressure, width=self.width, w=width, h=height, across=self.across, along=self.along, patch=0.3 * width,
            sand=sand.material(parameters, f"packing{seeds[0]}.csv"), weak=sand.material(parameters, f"packing{seeds[1]}.csv"),
            move=height * given.strain / 100, stages=stages(given.strain, given.step)))

    def done(self):
        summary = self.folder / "out/summary.json"
        return summary.exists() and json.loads(summary.read_text())["status"] == "done"

    def compress(self, polargrain, workers):
        if not self.done():
            resume = ["--resume"] if (self.folder / "out/checkpoint.h5").exists() else []
            try:
                sand.run([polargrain, "run", "case.yaml", "-o", "out", "--quiet", "-w", str(workers), *resume], self.folder)
            except RuntimeError as error:  # what was reached counts, and the others go on
                print(error, file=sys.stderr, flush=True)

    def figures(self, polargrain):
        """A row of specimen.csv; lengths in d50, angles in degrees, strains in %."""
        with open(self.folder / "out/history.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        strain, ratio, volume = (numpy.array([float(row[name]) for row in rows])
                                 for name in ("axial_strain", "stress_ratio", "volume_strain"))
        peak, last = strain[ratio.argmax()], strain[-1]
        row = {"pressure": self.pressure, "width": self.width, "elements": f"{self.across} x {self.along}",
               "strain_reached": 100 * last, "peak": ratio.max(), "peak_strain": 100 * peak,
               "residual": ratio[strain > last - 0.01].mean(), "volume_strain": -100 * volume[-1]}
        # One percent from the peak on, and the last third, where the band is at its end.
        begin = min(peak, last - 0.005)
        for name, begin, end in (("peak", begin, min(begin + 0.01, last)), ("end", last * 2 / 3, last)):
            sand.run([polargrain, "band", "out", "--from", f"{begin:.9g}", "--to", f"{end:.9g}", "--fields", f"band-{name}.csv"],
                     self.folder)
            text = (self.folder / "out/band.json").read_text()
            (self.folder / f"band-{name}.json").write_text(text)
            band = json.loads(text)
            if band.get("found"):
                row |= {f"inclination_{name}": band["inclination_degrees"], f"thickness_{name}": band["thickness"] / sand.D50,
                        f"resolution_{name}": band["resolution"] / sand.D50,
                        f"rotation_inside_{name}": band["rotation_inside"], f"rotation_outside_{name}": band["rotation_outside"]}
                if band["onset_strain"] is not None:
                    row[f"onset_{name}"] = 100 * band["onset_strain"]
            else:
                row[f"no_band_{name}"] = band["reason"].replace(",", ";")
        return row


def main():
    given = options()
    given.output = given.output.resolve()
    polargrain, _ = sand.programs(given)
    parameters, seeds = parameters_of(given.output), seeds_of(given.output)
    specimens = [Specimen(given.output, pressure, size) for pressure in given.pressures for size in given.sizes]
    for specimen in specimens:
        specimen.prepare(given, parameters, seeds)
    print(f"sand: packing {seeds[0]}, weak corner: packing {seeds[1]}", flush=True)
    # All at the same time, each with workers in proportion to its cells.
    cells = sum(specimen.cells for specimen in specimens)
    with ThreadPoolExecutor(max(1, min(given.jobs, len(specimens)))) as pool:
        def one(specimen):
            specimen.compress(polargrain, max(1, round(given.jobs * specimen.cells / cells)))
            print(f"{specimen.folder.name}: {'done' if specimen.done() else 'not done'}", flush=True)
        list(pool.map(one, sorted(specimens, key=lambda specimen: -specimen.cells)))
    rows = [specimen.figures(polargrain) for specimen in specimens]
    columns = list(dict.fromkeys(name for row in rows for name in row))
    with open(given.output / "specimen.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, columns)
        writer.writeheader()
        writer.writerows({name: f"{value:.5g}" if isinstance(value, float) else value for name, value in row.items()}
                         for row in rows)
    print((given.output / "specimen.csv").read_text())


if __name__ == "__main__":
    main()
