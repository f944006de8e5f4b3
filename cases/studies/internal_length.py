#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""What the grains alone say of internal length: moduli and limits of skew and couple stress of cells with controlled rotations.

    python3 internal_length.py [--program POLARGRAIN] [-o RESULTS] [--size reduced|full] [--jobs 2]

reduced: 3 packings of 100 discs; full: 10 of 100, 10 of 400 and 3 of 1,600 (about half an hour of two cores). Each packing, under each contact law, is
sheared at constant volume to three states; from each state it is bent (curvature k1) and its grains are turned against the box (micro-rotation).
What is there already is not made again. Prints tables in Markdown: mean and 95 % interval over the packings.

docs/studies/internal_length.md shows the full size and says what follows.
"""
import argparse
import concurrent.futures
import csv
import math
import pathlib
import statistics
import subprocess

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
FRICTION = math.tan(0.5)
DIAMETER = 0.01  # m, mean
STATES = (0.0, 0.01, 0.04)  # axial strain at constant volume
STRAIN = 1e-3               # of an increment on the way there
CURVATURES = (0.002, 0.01, 0.03, 0.1, 0.3, 0.6, 1.0, 1.5, 2.0, 2.5, 3.0, 3.6)  # rad/m, reached one after the other
TURNS = (1e-5, 1e-4, 3e-4, 1e-3, 2e-3, 4e-3, 7e-3, 1e-2, 1.5e-2, 2e-2, 2.5e-2, 3e-2)  # rad

# name: coefficient of rolling resistance, rolling friction force
LAWS = {"no rolling resistance": (0.0, False), "0.2": (0.2, False), "0.4": (0.4, False),
        "0.4, with rolling friction force": (0.4, True)}
STUDENT = {2: 12.71, 3: 4.303, 4: 3.182, 5: 2.776, 10: 2.262}  # 97.5 %, by number of packings

CASE = """title: One cell
mesh: {{rectangle: {{size: [0.1 m, 0.1 m], elements: [1, 1]}}}}
materials:
  sand: {{model: cell, rotations: controlled, script: {script}, packing: {packing}, unbalanced_force_ratio: 1e-4,
         unbalanced_moment_ratio: 1e-4, inertial_number: 2e-4}}
regions: {{all: sand}}
boundary:
  - {{on: bottom, fix: [u1, u2]}}
  - {{on: [left, right, top], pressure: 100 kPa}}
steps: {{count: 1}}
"""


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
    def __init__(self, program, place):
        self.program, self.place = program, place
        place.mkdir(parents=True, exist_ok=True)
        for name, (rolling, force) in LAWS.items():
            self.script(name).write_text(script_of(rolling, force), encoding="utf-8")

    def script(self, law):
        return self.place / f"law{list(LAWS).index(law)}.in"

    def packing(self, grains, seed):
        packing = self.place / f"grains{grains}-seed{seed}.h5"
        if not packing.exists():
            specification = packing.with_suffix(".yaml")
            specification.write_text(
                f"title: {grains} dense discs\ngrains: {grains}\nsizes: {{law: uniform, radius: [3 mm, 7 mm]}}\ndensity: 2650\n"
                f"thickness: 100 mm\nscript: cells/hooke_radii.in\npressure: 100 kPa\nfriction: 0\nseed: {seed}\n", encoding="utf-8")
            subprocess.run([self.program, "pack", specification.name, "-o", packing.name], cwd=self.place, check=True,
                           stdout=subprocess.DEVNULL)
        return packing

    def answers(self, grains, seed, law, state, kind):
        """@returns rows of the path from the state on, the state itself first"""
        name = f"grains{grains}-seed{seed}-law{list(LAWS).index(law)}-{state:g}-{kind}"
        out = self.place / f"{name}.csv"
        steps = round(state / STRAIN)
        if not out.exists():
            targets = CURVATURES if kind == "k1" else TURNS
            path = self.place / f"{name}.path.csv"
            rows = [f"{STRAIN},{-STRAIN},0" for _ in range(steps)]
            rows += [f"0,0,{b - a:.17g}" for a, b in zip((0.0, *targets), targets)]
            path.write_text(f"h11,h22,{kind}\n" + "\n".join(rows) + "\n", encoding="utf-8")
            case = self.place / f"{name}.yaml"
            case.write_text(CASE.format(script=self.script(law).name, packing=f"grains{grains}-seed{seed}.h5"),
                            encoding="utf-8")
            run = subprocess.run([self.program, "point", case.name, "sand", path.name, "-o", out.name], cwd=self.place,
                                 capture_output=True, text=True)
            if run.returncode != 0 and not out.exists():
                raise SystemExit(f"{name}: {run.stderr}")
        with open(out, encoding="utf-8") as text:
            rows = [row for row in csv.DictReader(text)]
        good = [row for row in rows if row["status"] == "good"]
        return [{key: float(value) for key, value in row.items() if key != "status"} for row in good][steps:]

    def figures(self, grains, seed, law, state):
        bent = self.answers(grains, seed, law, state, "k1")
        turned = self.answers(grains, seed, law, state, "w")
        start = bent[0]
        pressure = -0.5 * (start["s11"] + start["s22"])
        ratio = abs(start["s11"] - start["s22"]) / (2.0 * pressure)
        couple = [(row["m1"] - start["m1"]) for row in bent[1:]]
        skew = [(row["s21"] - row["s12"]) - (turned[0]["s21"] - turned[0]["s12"]) for row in turned[1:]]
        last = -0.5 * (bent[-1]["s11"] + bent[-1]["s22"])
        last_turned = -0.5 * (turned[-1]["s11"] + turned[-1]["s22"])
        return {"pressure": pressure / 1e3, "ratio": ratio, "B": couple[0] / CURVATURES[0],
                "B at 0.3": couple[CURVATURES.index(0.3)] / 0.3,
                "m/p": bent[-1]["m1"] / last * 1e3 if len(couple) == len(CURVATURES) else math.nan,
                "Gc": skew[0] / (4.0 * TURNS[0]) / 1e6,
                "skew/p": (turned[-1]["s21"] - turned[-1]["s12"]) / last_turned}


def interval(values):
    values = [value for value in values if math.isfinite(value)]
    if len(values) < 2:
        return "-"
    mean = statistics.mean(values)
    half = STUDENT.get(len(values), 2.2) * statistics.stdev(values) / math.sqrt(len(values))
    return f"{mean:.3g} +- {half:.2g}"


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--program", default="polargrain")
    arguments.add_argument("-o", "--results", default="internal_length")
    arguments.add_argument("--size", choices=("reduced", "full"), default="reduced")
    arguments.add_argument("--jobs", type=int, default=2)
    options = arguments.parse_args()
    program = str(pathlib.Path(options.program).resolve()) if "/" in options.program else options.program
    study = Study(program, pathlib.Path(options.results).resolve())
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
