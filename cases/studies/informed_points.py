#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""`informed` against `cell` at one point: biaxial compression, unloading and reloading, cyclic shear (docs/studies/informed_points.md).

    python3 informed_points.py -o RESULTS [--packings 10] [--tests compression,reloading,cycles] [--set material.KEY=VALUE ... --name NAME]

Dense packings of 100 discs with the seeds 1 to 10, with rolling resistance (`rolling`: hooke_rolling.in) and without (`sliding`: hooke_radii.in), both
updates. What is there already is not run again. Prints tables in Markdown, means over the packings with 95 % intervals. Needs no
finite elements: every run is one of `polargrain element`.
"""
import argparse
import concurrent.futures
import csv
import pathlib
import subprocess

import numpy

from intervals import table

HERE = pathlib.Path(__file__).resolve().parent
KINDS = {"rolling": "hooke_rolling", "sliding": "hooke_radii"}
SCHEMES = {"cell": ["material.model=cell"], "frozen": ["material.model=informed"],
           "fixed_point": ["material.model=informed", "material.informed.update=fixed_point"]}
AMPLITUDES = {"0.02 %": "cycles0.02", "0.1 %": "cycles0.1", "0.5 %": "cycles0.5", "2 %": "cycles2"}
CYCLES, ROWS = 5, 80
PACKING = ("title: 100 dense discs\ngrains: 100\nsizes: {{law: uniform, radius: [3 mm, 7 mm]}}\ndensity: 2650\n"
           "thickness: 100 mm\nscript: cells/hooke_rolling.in\npressure: 100 kPa\nfriction: 0\nseed: {seed}\n")
POINT = ("title: One point\nmaterial: {{model: cell, script: cells/{script}.in, packing: {packing}, lc: 8 mm}}\n"
         "pressure: 100 kPa\nstages:\n{stages}")


def stages(test):
    if test == "compression":
        return "  - {test: biaxial, axial_strain: 10 %, rows: 100}\n"
    if test == "reloading":  # down to no deviator, half as far to the other side, and on
        return ("  - {test: biaxial, axial_strain: 1 %, rows: 20}\n  - {test: biaxial, deviator: 0 kPa, rows: 20}\n"
                "  - {test: biaxial, axial_strain: 4 %, rows: 60}\n")
    amplitude = next(text for text, name in AMPLITUDES.items() if name == test)
    return f"  - {{test: simple_shear, cycles: {CYCLES}, amplitude: {amplitude}, rows: {CYCLES * ROWS}}}\n"


class Study:
    def __init__(self, place, programs):
        self.place, self.program = place, str((programs / "polargrain").resolve())
        place.mkdir(parents=True, exist_ok=True)

    def packing(self, seed):
        name = f"dense100_seed{seed}.h5"
        if not (self.place / name).exists():
            specification = self.place / f"dense100_seed{seed}.yaml"
            specification.write_text(PACKING.format(seed=seed), encoding="utf-8")
            subprocess.run([self.program, "pack", specification.name, "-o", name, "--quiet"], cwd=self.place, check=True)
        return name

    def curve(self, kind, test, scheme, seed, settings, name):
        """@returns columns of the curve of one packing by their names; of a test that ended early what there is"""
        run = f"{name}{kind}-{test}-{scheme}-{seed}"
        if not (self.place / f"{run}.csv").exists():
            text = POINT.format(script=KINDS[kind], packing=self.packing(seed), stages=stages(test))
            (self.place / f"{run}.yaml").write_text(text, encoding="utf-8")
            command = [self.program, "element", f"{run}.yaml", "-o", run, "-w", "1", "--quiet"]
            for setting in SCHEMES[scheme] + settings:
                command += ["--set", setting]
            with open(self.place / f"{run}.log", "w", encoding="utf-8") as log:
                subprocess.run(command, cwd=self.place, stdout=log, stderr=subprocess.STDOUT, check=False)
        with open(self.place / f"{run}.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        return {key: numpy.array([float(row[key] or "nan") for row in rows]) for key in rows[0] if key != "packing"}


def between(strain, values, first, last):
    """Mean of a curve over a range of strain, nan where it does not reach its end."""
    if strain.max() < last - 1e-9:
        return numpy.nan
    at = numpy.linspace(first, last, 200)
    order = numpy.argsort(strain, kind="stable")
    return numpy.interp(at, strain[order], values[order]).mean()


def of_compression(cell, law):
    figures = {}
    ratios = [curve["s22_Pa"] / curve["s11_Pa"] for curve in (cell, law)]
    strains = [curve["axial_strain"] for curve in (cell, law)]
    figures["peak of cell"] = ratios[0].max()
    for what, first, last in (("0.5 to 3 %", 0.005, 0.03), ("5 to 7.5 %", 0.05, 0.075), ("7.5 to 10 %", 0.075, 0.1)):
        means = [between(strain, ratio, first, last) for strain, ratio in zip(strains, ratios)]
        figures[f"{what} [%]"] = 100.0 * (means[1] / means[0] - 1.0)
        if first < 0.01:
            figures["peak [%]"] = 100.0 * (ratios[1].max() / ratios[0].max() - 1.0)
    figures["volume at 10 % [%]"] = 100.0 * (law["volume_strain"][-1] - cell["volume_strain"][-1])
    figures["mismatch at peak"] = law["stress_mismatch"][int(ratios[1].argmax())]
    figures["mismatch, mean"] = law["stress_mismatch"].mean()
    return figures


def of_reloading(cell, law):
    """Strains from the last row of a stage: how far unloading goes back, its secant modulus, and what follows."""
    def parts(curve):
        deviator = curve["s11_Pa"] - curve["s22_Pa"]
        return [(curve["axial_strain"][curve["stage"] == stage], deviator[curve["stage"] == stage]) for stage in (1, 2, 3)]
    found = []
    for curve in (cell, law):
        (up, q_up), (down, q_down), (again, q_again) = parts(curve)
        if not again.size:
            return dict.fromkeys(("secant of unloading [%]", "plastic strain at no deviator [%]", "reloading to 1 % [%]",
                                  "behind 1.5 % [%]", "volume at 4 % [%]"), numpy.nan)
        found.append({"secant": q_up[-1] / (up[-1] - down[-1]), "rest": down[-1],
                      "again": between(again, q_again, down[-1] + 1e-3, 0.01), "behind": between(again, q_again, 0.015, 0.04),
                      "volume": curve["volume_strain"][-1]})
    one, other = found
    return {"secant of unloading [%]": 100.0 * (other["secant"] / one["secant"] - 1.0),
            "plastic strain at no deviator [%]": 100.0 * (other["rest"] - one["rest"]),
            "reloading to 1 % [%]": 100.0 * (other["again"] / one["again"] - 1.0),
            "behind 1.5 % [%]": 100.0 * (other["behind"] / one["behind"] - 1.0), "volume at 4 % [%]": 100.0 * (other["volume"] - one["volume"])}


def of_cycles(cell, law):
    """Of every cycle: root mean square of the difference of the shear stresses, over half of the range of the cell's."""
    figures = {}
    for number in (1, 2, CYCLES):
        rows = slice(1 + (number - 1) * ROWS, 1 + number * ROWS)
        one, other = cell["s12_Pa"][rows], law["s12_Pa"][rows]
        if one.size < ROWS or other.size < ROWS:
            one = other = numpy.full(ROWS, numpy.nan)
        half = 0.5 * (one.max() - one.min())
        strain = cell["e12"][rows] if one.size == ROWS else one
        area = [abs(numpy.trapezoid(stress, strain) if hasattr(numpy, "trapezoid") else numpy.trapz(stress, strain)) for stress in (one, other)]
        figures[f"rms, cycle {number} [%]"] = 100.0 * numpy.sqrt(((other - one) ** 2).mean()) / half
        figures[f"range, cycle {number} [%]"] = 100.0 * ((other.max() - other.min()) / (2.0 * half) - 1.0)
        figures[f"work, cycle {number} [%]"] = 100.0 * (area[1] / area[0] - 1.0)
    ends = min(cell["volume_strain"].size, law["volume_strain"].size) - 1
    figures["volume at the end, cell [%]"] = 100.0 * cell["volume_strain"][ends]
    figures["of the law [%]"] = 100.0 * law["volume_strain"][ends]
    figures["mismatch, mean"] = law["stress_mismatch"].mean()
    return figures


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("-o", "--output", type=pathlib.Path, required=True)
    arguments.add_argument("--packings", type=int, default=10)
    arguments.add_argument("--kinds", default=",".join(KINDS))
    arguments.add_argument("--tests", default="compression,reloading,cycles")
    arguments.add_argument("--schemes", default="frozen,fixed_point")
    arguments.add_argument("--set", action="append", default=[], dest="settings", help="of the runs of informed")
    arguments.add_argument("--name", default="", help="of runs with --set")
    arguments.add_argument("--jobs", type=int, default=2)
    arguments.add_argument("--programs", type=pathlib.Path, default=HERE / "../../build/release/app")
    options = arguments.parse_args()
    study = Study(options.output.resolve(), options.programs)
    seeds = range(1, options.packings + 1)
    for seed in seeds:
        study.packing(seed)
    measures = {"compression": of_compression, "reloading": of_reloading}
    tests = [one for test in options.tests.split(",") for one in (AMPLITUDES.values() if test == "cycles" else [test])]
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for test in tests:
            groups = {}
            for kind in options.kinds.split(","):
                cells = list(pool.map(lambda seed: study.curve(kind, test, "cell", seed, [], ""), seeds))
                for scheme in options.schemes.split(","):
                    laws = list(pool.map(lambda seed: study.curve(kind, test, scheme, seed, options.settings, options.name), seeds))
                    groups[f"{kind}, {scheme}"] = [measures.get(test, of_cycles)(*pair) for pair in zip(cells, laws)]
            table(test, groups, list(next(iter(groups.values()))[0]))


if __name__ == "__main__":
    main()
