#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Boxes of grains in real time against their own moduli (docs/theory/explicit.md): waves in a bar, and a column on a shaken base.

    python3 boxes_in_real_time.py -o RESULTS [--packings 10] [--parts wave,shaking] [--kinds discs,spheres]

wave     a bar of 20 elements is pushed at its end to a strain of 1e-5. Speed of the wave, as the free end tells of it, over that of the
         modulus by Newton's method, with and without what the bar moves when it is not pushed; and that movement over that of the wave
shaking  a column of 5 elements with damping is shaken at 0.7 of its first frequency. Amplitude of its head over that of the continuum
         with the same shear modulus, u(H) / u(0) = 1 / cos(k H), k^2 = (w^2 - i w damping) / c^2

100 discs or 200 spheres a box. Means over the packings and their 95 % intervals.
"""
import argparse
import cmath
import csv
import math
import pathlib
import subprocess

from intervals import table

HERE = pathlib.Path(__file__).resolve().parent
SCRIPT = {"discs": "hooke_radii.in", "spheres": "spheres_hooke_radii.in"}
GRAINS = {"discs": "grains: 100\nthickness: 100 mm\n", "spheres": "grains: 200\ndimension: 3\n"}
PACKING = ("title: dense\n{grains}script: cells/{script}\nsizes: {{law: uniform, radius: [3 mm, 7 mm]}}\ndensity: 2650\n"
           "pressure: 100 kPa\nfriction: 0\nseed: {seed}\n")
CASE = """title: Boxes in real time
mesh: {{rectangle: {{size: [{size}], elements: [{elements}]}}, element: {element}}}
continuum: cauchy
materials: {{sand: {{model: cell, script: cells/{script}, packing: {packing}, density: 2000 kg/m3{more}}}}}
regions: {{all: sand}}
boundary:
{boundary}steps: {{{steps}}}
monitors:
{monitors}output: {{every: 100000}}
"""
DENSITY, WIDTH, STRAIN = 2000.0, 0.1, 1e-5
STILL = ", unbalanced_force_ratio: 1e-5"
REAL = "method: explicit, time: real, tolerance: 1e-4"


class Study:
    def __init__(self, program, place):
        self.program, self.place = program, place

    def run(self, kind, seed, **case):
        packing = self.place / f"{kind}_{seed}.h5"
        if not packing.exists():
            packing.with_suffix(".yaml").write_text(PACKING.format(grains=GRAINS[kind], script=SCRIPT[kind], seed=seed), encoding="utf-8")
            subprocess.run([self.program, "pack", f"{packing.stem}.yaml", "-o", packing.name, "--quiet"], cwd=self.place, check=True)
        (self.place / "case.yaml").write_text(CASE.format(script=SCRIPT[kind], packing=packing.name, **case), encoding="utf-8")
        subprocess.run(["rm", "-rf", "out"], cwd=self.place, check=True)
        subprocess.run([self.program, "run", "case.yaml", "-o", "out", "-w", "1", "--quiet"], cwd=self.place, check=True)
        with open(self.place / "out/history.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        return {key: [float(row[key]) for row in rows] for key in rows[0]}

    def push(self, times, accelerations):
        lines = [f"{time:.12g},{value:.12g}" for time, value in zip(times, accelerations)]
        (self.place / "push.csv").write_text("\n".join(["time,acceleration"] + lines) + "\n", encoding="utf-8")


def least_squares(columns, values):
    """Factors of the columns whose sum is nearest to the values."""
    n = len(columns)
    rows = [[sum(a * b for a, b in zip(one, other)) for other in columns] + [sum(a * b for a, b in zip(one, values))] for one in columns]
    for k in range(n):
        for row in range(n):
            if row != k:
                factor = rows[row][k] / rows[k][k]
                rows[row] = [a - factor * b for a, b in zip(rows[row], rows[k])]
    return [rows[k][n] / rows[k][k] for k in range(n)]


def wave(study, kind, seed):
    length, rise = 2.0, 2e-3
    common = {"element": "Q4", "size": f"{length} m, {WIDTH} m", "monitors": "  end: {on: right, displacement: u1}\n  force: {on: left, reaction: u1}\n"}
    sides = "  - {on: [bottom, top], fix: [u2]}\n"
    force = study.run(kind, seed, **common, elements="1, 1", more=STILL, steps="count: 4, tolerance: 1e-6", boundary=sides +
                      f"  - {{on: right, fix: [u1]}}\n  - {{on: left, move: {{u1: {4e3 * STRAIN * length:.10g} mm}}}}\n")["force"]
    speed = math.sqrt((force[4] - force[1]) / (3 * WIDTH * STRAIN) / DENSITY)

    def end(strain):
        study.push([0, 0.5 * rise, rise], [0, 2 * strain * speed / rise, 0])
        history = study.run(kind, seed, **common, elements="20, 1", more="", steps=f"{REAL}, count: 200, duration: {2.6 * length / speed:.8g} s",
                            boundary=sides + "  - {on: left, accelerate: {u1: push.csv}}\n"
                            f"  - {{on: right, pressure: {force[0] / WIDTH:.12g} Pa}}\n")
        return history["time"], [one - history["end"][0] for one in history["end"]]

    def ratio(times, way):
        behind = [(time, one) for time, one in zip(times, way) if 1.3 * length / speed + rise <= time <= 2.5 * length / speed]
        at_zero, slope = least_squares([[1.0] * len(behind), [time for time, _ in behind]], [one for _, one in behind])
        return length / (-at_zero / slope - 0.5 * rise) / speed

    times, pushed = end(STRAIN)
    _, left = end(0.0)
    return {"speed over that of the modulus": ratio(times, [one - other for one, other in zip(pushed, left)]),
            "with the movement without a push": ratio(times, pushed), "that movement, % of the wave's": 100 * left[-1] / (STRAIN * length)}


def shaking(study, kind, seed):
    height, cycles = 0.5, 10
    common = {"element": "Q8R", "size": f"{WIDTH} m, {height} m", "elements": "1, 5", "more": STILL, "monitors":
              "  head: {on: top, displacement: u1}\n  foot: {on: bottom, displacement: u1}\n  force: {on: bottom, reaction: u1}\n"}
    force = study.run(kind, seed, **common, steps="count: 4, tolerance: 1e-5", boundary="  - {on: bottom, fix: [u1, u2]}\n"
                      f"  - {{on: top, fix: [u2], move: {{u1: {4e3 * STRAIN * height:.10g} mm}}}}\n  - {{on: left, tie: right}}\n")["force"]
    speed = math.sqrt(-(force[4] - force[1]) / (3 * WIDTH * STRAIN) / DENSITY)
    first = math.pi * speed / (2 * height)
    frequency, damping = 0.7 * first, 0.2 * first
    # Damped relative to the base: the motion over that of the base, by itself.
    share = frequency / (frequency - 1j * damping)
    transfer = abs(1 + share * (1 / cmath.cos(cmath.sqrt(frequency ** 2 - 1j * damping * frequency) / speed * height) - 1))
    duration = cycles * 2 * math.pi / frequency
    times = [duration * k / (60 * cycles) for k in range(60 * cycles + 1)]

    def moved(acceleration):
        study.push(times, [acceleration * min(1, frequency * time / (6 * math.pi)) * math.sin(frequency * time) for time in times])
        return study.run(kind, seed, **common, boundary="  - {on: bottom, fix: [u2], accelerate: {u1: push.csv}}\n  - {on: top, fix: [u2]}\n"
                         "  - {on: left, tie: right}\n", steps=f"{REAL}, count: {40 * cycles}, duration: {duration:.8g} s, mass_damping: {damping:.6g}")

    shaken, left = moved(STRAIN * height / transfer * frequency ** 2), moved(0.0)

    def amplitude(of):
        last = [k for k, time in enumerate(shaken["time"]) if time > 0.7 * duration]
        at = [shaken["time"][k] for k in last]
        parts = [[math.cos(frequency * time) for time in at], [math.sin(frequency * time) for time in at], [1.0] * len(at), at]
        return math.hypot(*least_squares(parts, [shaken[of][k] - left[of][k] for k in last])[:2])

    return {"amplitude over that of the continuum": amplitude("head") / amplitude("foot") / transfer, "amplitude over the base's": transfer}


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("-o", "--output", type=pathlib.Path, required=True)
    arguments.add_argument("--packings", type=int, default=10)
    arguments.add_argument("--parts", default="wave,shaking")
    arguments.add_argument("--kinds", default="discs,spheres")
    arguments.add_argument("--program", type=pathlib.Path, default=HERE / "../../build/release/app/polargrain")
    options = arguments.parse_args()
    options.output.mkdir(parents=True, exist_ok=True)
    study = Study(str(options.program.resolve()), options.output.resolve())
    for part in options.parts.split(","):
        measure = {"wave": wave, "shaking": shaking}[part]
        groups = {kind: [measure(study, kind, seed) for seed in range(1, options.packings + 1)] for kind in options.kinds.split(",")}
        table(part, groups, list(next(iter(groups.values()))[0]))


if __name__ == "__main__":
    main()
