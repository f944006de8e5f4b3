#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Which method when: the user time of explicit steps over that of Newton's method at equal error, over rows of elements, stiffness
and discs or spheres (docs/theory/explicit.md).

    python3 explicit_break_even.py -o RESULTS [--packings 5] [--rows 2,4,8,16] [--kinds discs,stiff,spheres]

A column of 2 elements by so many rows between rough plates is compressed by a fixed strain. The reference is Newton's method in ten
times as many steps; where that ends early (spheres), explicit steps at a quarter of the slowest pace. Error: root mean square, over the
rows of the table, of the difference of the plates' force to the reference, over the reference's last force. The user time of explicit
steps at the error of Newton's method lies on a straight line, in logarithms, through the two paces about it; beyond the slowest pace
the time of that is a lower bound. Besides: their user time at an error of 1 %, which is more than that of Newton's method.

discs    100 discs, contacts of the script, to 1 %
stiff    the same with contacts ten times as stiff
spheres  60 spheres, contacts of the script, to 0.5 %

What is there already is not run again. User time is that of all processes of a run, on one worker.
"""
import argparse
import csv
import json
import math
import pathlib
import resource
import shutil
import subprocess

from intervals import interval

HERE = pathlib.Path(__file__).resolve().parent
CELLS = HERE / "../../liggghts_inputs/cells"
# Script, grains, strain, factor of the stiffness, and fastest pace: the stiffer the grains, the slower for the same error.
KINDS = {"discs": ("hooke_radii.in", "grains: 100\nthickness: 100 mm\n", 0.01, 1.0, 6e-4),
         "stiff": ("hooke_radii.in", "grains: 100\nthickness: 100 mm\n", 0.01, 10.0, 7.5e-5),
         "spheres": ("spheres_hooke_radii.in", "grains: 60\ndimension: 3\n", 0.005, 1.0, 7.5e-5)}
SLOWER = [1, 2, 4, 8]  # than the fastest pace
WIDTH = 0.2  # m, of two elements
STEPS = 10
CASE = """title: A column between rough plates
mesh: {{rectangle: {{size: [{width} m, {height} m], elements: [2, {rows}]}}, element: Q8R}}
deformation: large
materials: {{sand: {{model: cell, script: {script}, packing: {packing}, lc: 50 mm}}}}
regions: {{all: sand}}
boundary:
  - {{on: bottom, fix: [u1, u2]}}
  - {{on: top, fix: [u1], move: {{u2: {shortening} mm}}}}
  - {{on: [left, right], pressure: 100 kPa}}
steps: {{{steps}}}
monitors:
  top_force: {{on: top, reaction: u2}}
  bottom_force: {{on: bottom, reaction: u2}}
output: {{every: 1000}}
"""
PACKING = ("title: dense\n{grains}script: {script}\nsizes: {{law: uniform, radius: [3 mm, 7 mm]}}\ndensity: 2650\npressure: 100 kPa\n"
           "friction: 0\nseed: {seed}\n")


class Study:
    def __init__(self, program, place):
        self.program, self.place = program, place

    def prepare(self, kind, seed):
        """@returns names of script and packing, which lie in the folder of the study"""
        script, grains, _, stiffer, _ = KINDS[kind]
        own = self.place / f"{kind}.in"
        if not own.exists():
            text = (CELLS / script).read_text(encoding="utf-8")
            for line in text.splitlines():
                if "contactModulus peratomtypepair" in line:
                    text = text.replace(line, " ".join(line.split()[:-1] + [f"{stiffer * float(line.split()[-1]):g}"]))
            own.write_text(text, encoding="utf-8")
        packing = self.place / f"{kind}_{seed}.h5"
        if not packing.exists():
            packing.with_suffix(".yaml").write_text(PACKING.format(grains=grains, script=own.name, seed=seed), encoding="utf-8")
            subprocess.run([self.program, "pack", f"{packing.stem}.yaml", "-o", packing.name, "--quiet"], cwd=self.place, check=True)
        return own.name, packing.name

    def run(self, name, kind, seed, rows, steps, count=STEPS):
        """@returns forces of the plates at the tenths of the way, fewer where the run has ended early, and user time in s"""
        out = self.place / f"{kind}-{rows}-{seed}-{name}"
        if not (out / "user_seconds").exists():
            shutil.rmtree(out, ignore_errors=True)  # of a run that was broken off
            script, packing = self.prepare(kind, seed)
            height = 0.5 * WIDTH * rows
            case = self.place / f"{out.name}.yaml"
            case.write_text(CASE.format(width=WIDTH, height=height, rows=rows, script=script, packing=packing, steps=f"count: {count}, {steps}",
                                        shortening=f"{-1e3 * KINDS[kind][2] * height:.10g}"), encoding="utf-8")
            before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
            with open(self.place / f"{out.name}.log", "w", encoding="utf-8") as log:
                subprocess.run([self.program, "run", case.name, "-o", out.name, "-w", "1", "--quiet"], cwd=self.place, stdout=log,
                               stderr=subprocess.STDOUT, check=False)
            seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
            (out / "user_seconds").write_text(f"{seconds:.3f}\n", encoding="utf-8")
        with open(out / "history.csv", encoding="utf-8") as file:
            forces = [0.5 * (float(row["top_force"]) - float(row["bottom_force"])) for row in csv.DictReader(file)]
        stride = count // STEPS
        return forces[::stride], float((out / "user_seconds").read_text(encoding="utf-8"))


def error_of(forces, reference):
    """nan where one has ended early"""
    if len(forces) <= STEPS or len(reference) <= STEPS:
        return math.nan
    return math.sqrt(sum((one - other) ** 2 for one, other in zip(forces, reference)) / STEPS) / abs(reference[-1] - reference[0])


def time_at(error, points):
    """@param points pairs of error and user time, fast to slow @returns user time at an error, and whether it is a lower bound"""
    best = points[0]
    if best[0] <= error:
        return best[1], False
    for point in points[1:]:
        if point[0] <= error:
            share = math.log(best[0] / error) / math.log(best[0] / point[0])
            return math.exp(math.log(best[1]) + share * math.log(point[1] / best[1])), False
        if point[0] < best[0]:
            best = point
    return points[-1][1], True


def compare(study, kind, rows, seed):
    newton, newton_seconds = study.run("newton", kind, seed, rows, "tolerance: 1e-2")
    fine, _ = study.run("fine", kind, seed, rows, "tolerance: 2e-3", 10 * STEPS)
    paces = [KINDS[kind][4] / slower for slower in SLOWER]
    explicit = {pace: study.run(f"{pace:g}", kind, seed, rows, f"method: explicit, pace: {pace:g}") for pace in paces}
    own = len(fine) <= STEPS  # Newton's method has no reference to offer
    if own:
        slow = paces[-1] / 4
        fine, _ = study.run(f"{slow:g}", kind, seed, rows, f"method: explicit, pace: {slow:g}")
    points = [(error_of(forces, fine), seconds) for forces, seconds in explicit.values()]
    error = error_of(newton, fine)
    figure = {"newton": error, "newton_seconds": newton_seconds, "reached": (len(newton) - 1) / STEPS, "own_reference": own,
              "explicit": points}
    if not math.isnan(error):
        seconds, bound = time_at(error, points)
        figure.update(ratio=seconds / newton_seconds, bound=bound)
    figure["one_percent"] = time_at(0.01, points)[0] / newton_seconds
    return figure


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("-o", "--output", type=pathlib.Path, required=True)
    arguments.add_argument("--packings", type=int, default=5)
    arguments.add_argument("--rows", default="2,4,8,16")
    arguments.add_argument("--kinds", default="discs,stiff,spheres")
    arguments.add_argument("--program", type=pathlib.Path, default=HERE / "../../build/release/app/polargrain")
    options = arguments.parse_args()
    place = options.output.resolve()
    place.mkdir(parents=True, exist_ok=True)
    study = Study(str(options.program.resolve()), place)
    print("| grains | rows | n | Newton reaches, % of the way | error of Newton, % | user time, s | error at the fastest pace, % | " +
          " | ".join(f"at 1/{slower}" for slower in SLOWER[1:]) + " | user time over Newton's at equal error | lower bounds among them | at 1 % |")
    print("|" + "---|" * (9 + len(SLOWER)))
    everything = {}
    for kind in options.kinds.split(","):
        for rows in map(int, options.rows.split(",")):
            figures = [compare(study, kind, rows, seed) for seed in range(1, options.packings + 1)]
            everything[f"{kind} {rows}"] = figures
            ratios = [one["ratio"] for one in figures if "ratio" in one]
            print(f"| {kind} | {rows} | {len(figures)} | {interval([100 * one['reached'] for one in figures])} | "
                  f"{interval([100 * one['newton'] for one in figures])} | {interval([one['newton_seconds'] for one in figures])} | " +
                  " | ".join(interval([100 * one["explicit"][k][0] for one in figures]) for k in range(len(SLOWER))) +
                  f" | {interval(ratios)} | {sum(one.get('bound', False) for one in figures)} of {len(ratios)} | "
                  f"{interval([one['one_percent'] for one in figures])} |", flush=True)
    (place / "break_even.json").write_text(json.dumps(everything, indent=1), encoding="utf-8")


if __name__ == "__main__":
    main()
