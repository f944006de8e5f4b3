#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Explicit steps on packings drawn with fixed seeds: how far they go, how near to Newton's method, and what they say of their error.

    python3 explicit_packings.py -o RESULTS [--packings 10] [--parts far,careful,discs,biaxial,elements] [--program build/release/app/polargrain]

far      boxes of 200 spheres between rough plates (explicit_plates.yaml) to 8 % at two paces, and at the fast one with two DEM steps an
         explicit step: how many get there, processor time, and what haste adds to the stress
careful  the same to 0.3 % at a slow pace, against Newton's method with slow grains: difference of the stress ratio
discs    boxes of 100 discs to 4 % at three paces, against Newton's method in 80 steps: error before 1.5 % and behind, the estimate of
         the run for it, and how often the error is within the estimate
biaxial  cases/biaxial (200 boxes of 400 discs) as given, at three paces and with two DEM steps an explicit step, all against Newton's method in four times as many steps
         of slower grains: error and user time
elements cheap elements, with as many boxes and with a quarter or an eighth of them, of discs in the plane to 1.5 % and of spheres in
         space to 0.5 %, against meshes of half the size: error of the stress ratio, boxes and user time

What is there already is not run again. Tables are Markdown, with means over the packings and their 95 % intervals. Processor time is user
time of all processes of a run.
"""
import argparse
import csv
import json
import pathlib
import resource
import shutil
import subprocess

from intervals import interval, table

HERE = pathlib.Path(__file__).resolve().parent
GRAINS = {"spheres": "grains: 200\ndimension: 3\nscript: cells/spheres_hooke_radii.in",
          "discs": "grains: 100\nthickness: 100 mm\nscript: cells/hooke_radii.in",
          "discs400": "grains: 400\nthickness: 100 mm\nscript: cells/hooke_radii.in"}
SPECIFICATION = ("title: dense {kind}\n{grains}\nsizes: {{law: uniform, radius: [3 mm, 7 mm]}}\ndensity: 2650\npressure: 100 kPa\n"
                 "friction: 0\nseed: {seed}\n")
HEIGHT = 0.8  # m
# Element and number of elements; the last is the reference.
PLANE = [("Q8R", "[2, 4]", 32), ("Q4R", "[4, 8]", 32), ("Q8R", "[1, 2]", 8), ("Q4R", "[2, 4]", 8), ("Q8R", "[4, 8]", 128)]
SPACE = [("H20R", "[1, 1, 2]", 16), ("H8R", "[2, 2, 4]", 16), ("H8R", "[1, 1, 2]", 2), ("H20R", "[2, 2, 4]", 128)]
BLOCK_IN_SPACE = """title: Compression between rough plates in space
mesh: {box: {size: [0.4 m, 0.4 m, 0.8 m], elements: [1, 1, 2]}, element: H20R}
deformation: large
materials: {sand: {model: cell, script: cells/spheres_hooke_radii.in, packing: spheres_seed1.h5, lc: 80 mm}}
regions: {all: sand}
boundary:
  - {on: bottom, fix: [u1, u2, u3]}
  - {on: top, fix: [u1, u2], move: {u3: -4 mm}}
  - {on: [left, right, front, back], pressure: 100 kPa}
steps: {method: explicit, count: 10}
monitors:
  top_force: {on: top, reaction: u3}
  shortening: {on: top, displacement: u3}
  axial_strain: -shortening / 0.8 m
  stress_ratio: -top_force / (0.4 m * 0.4 m * 100 kPa)
output: {every: 1000}
"""
PEAK = 0.015  # strain up to which curves are compared before the peak


class Study:
    def __init__(self, program, place, seeds):
        self.program, self.place, self.seeds = program, place, seeds

    def packing(self, kind, seed):
        packing = self.place / f"{kind}_seed{seed}.h5"
        if not packing.exists():
            text = SPECIFICATION.format(kind=kind, grains=GRAINS[kind], seed=seed)
            packing.with_suffix(".yaml").write_text(text, encoding="utf-8")
            subprocess.run([self.program, "pack", f"{packing.stem}.yaml", "-o", packing.name, "--quiet"], cwd=self.place, check=True)
        return packing.name

    def run(self, name, kind, seed, strain, settings, case="explicit_plates.yaml", along="u2"):
        """@returns rows of history.csv as numbers, the summary, and the user time in s"""
        out = self.place / f"{name}-{seed}"
        if not (out / "user_seconds").exists():
            script = "spheres_hooke_radii" if kind == "spheres" else "hooke_radii"
            settings = [f"materials.sand.packing={self.packing(kind, seed)}", f"materials.sand.script=cells/{script}.in",
                        f"boundary.1.move.{along}={-1e3 * strain * HEIGHT:.10g} mm"] + settings
            command = [self.program, "run", case, "-o", out.name, "-w", "1", "--quiet"]
            for setting in settings:
                command += ["--set", setting]
            before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
            with open(self.place / f"{out.name}.log", "w", encoding="utf-8") as log:
                subprocess.run(command, cwd=self.place, stdout=log, stderr=subprocess.STDOUT, check=False)
            seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
            (out / "user_seconds").write_text(f"{seconds:.2f}\n", encoding="utf-8")
        with open(out / "history.csv", encoding="utf-8") as file:
            rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
        summary = json.loads((out / "summary.json").read_text(encoding="utf-8"))
        return rows, summary, float((out / "user_seconds").read_text(encoding="utf-8"))


def at(rows, strain, key="stress_ratio"):
    """The value of a column at a strain, straight between the rows; nan beyond the last."""
    for before, after in zip(rows, rows[1:]):
        if before["axial_strain"] <= strain <= after["axial_strain"] + 1e-12:
            share = (strain - before["axial_strain"]) / (after["axial_strain"] - before["axial_strain"])
            return before[key] + share * (after[key] - before[key])
    return float("nan")


def rms(values):
    return (sum(value * value for value in values) / len(values)) ** 0.5 if values else float("nan")


def far(study):
    groups = {}
    for pace, dem_steps in [("1.5e-4", 5), ("3.75e-5", 5), ("1.5e-4", 2)]:
        name = f"far-{pace}" + ("" if dem_steps == 5 else f"-d{dem_steps}")
        for seed in study.seeds:
            rows, summary, seconds = study.run(name, "spheres", seed, 0.08, [f"steps.pace={pace}", f"steps.dem_steps={dem_steps}"])
            measures = summary["quasi_static"]
            behind = [row["stress_ratio"] for row in rows if row["axial_strain"] > 0.02]
            groups.setdefault(f"pace {pace}, {dem_steps} DEM steps", []).append({
                "strain reached, %": 100 * rows[-1]["axial_strain"], "user time, s": seconds,
                "mean stress ratio from 2 % on": sum(behind) / len(behind),
                "estimated error, median, %": 100 * measures["error_estimate"]["median"],
                "grains' ratio, median, %": 100 * measures["grains_unbalanced"]["median"],
                "hot boxes, most, %": 100 * measures["hot_points"]["largest"]})
    table("2 x 4 elements, 200 spheres", groups, list(next(iter(groups.values()))[0]))
    fast, slow, few = groups.values()

    def more(hasty):
        return interval([100 * (one["mean stress ratio from 2 % on"] / other["mean stress ratio from 2 % on"] - 1)
                         for one, other in zip(hasty, slow)])

    print(f"{sum(one['strain reached, %'] > 7.999 for one in fast)} of {len(fast)} reach 8 %; "
          f"the fast ones carry {more(fast)} % more than the slow ones, those of two DEM steps {more(few)} %\n")


def careful(study):
    slow = ["steps.pace=1e-5", "steps.count=6"]
    newton = ["steps.method=newton", "steps.count=30", "steps.tolerance=2e-3", "materials.sand.inertial_number=1e-4",
              "materials.sand.most_relaxation_steps=100000", "steps.acceleration=5"]
    strains = [0.001, 0.002, 0.003]
    figures = {"difference to careful Newton, %": []}
    reached = 0
    for seed in study.seeds:
        rows, _, seconds = study.run("slow", "spheres", seed, 0.003, slow)
        reference, _, newton_seconds = study.run("newton", "spheres", seed, 0.003, newton)
        reached += reference[-1]["axial_strain"] > 0.00299
        one = {f"at {100 * strain:.1f} % of strain": 100 * (at(rows, strain) / at(reference, strain) - 1) for strain in strains}
        one["user time over Newton's"] = seconds / newton_seconds
        figures["difference to careful Newton, %"].append(one)
    table("200 spheres", figures, list(figures["difference to careful Newton, %"][0]))
    print(f"Newton's method: {reached} of {len(study.seeds)} reach 0.3 %\n")


def discs(study):
    groups = {}
    for pace in ["3e-4", "1.5e-4", "7.5e-5"]:
        for seed in study.seeds:
            reference, _, newton_seconds = study.run("discs-newton", "discs", seed, 0.04,
                                                     ["steps.method=newton", "steps.count=80", "steps.tolerance=1e-2"])
            rows, _, seconds = study.run(f"discs-{pace}", "discs", seed, 0.04, [f"steps.pace={pace}"])
            peak = max(row["stress_ratio"] for row in reference)
            errors = [(row["axial_strain"], (row["stress_ratio"] - at(reference, row["axial_strain"])) / row["stress_ratio"],
                       row["error_estimate"]) for row in rows[1:]]
            before = [(abs(error), estimate) for strain, error, estimate in errors if strain <= PEAK]
            groups.setdefault(f"pace {pace}", []).append({
                "rms before, % of peak": 100 * rms([row["stress_ratio"] / peak - at(reference, row["axial_strain"]) / peak
                                                    for row in rows[1:] if row["axial_strain"] <= PEAK]),
                "behind": 100 * rms([row["stress_ratio"] / peak - at(reference, row["axial_strain"]) / peak
                                     for row in rows[1:] if row["axial_strain"] > PEAK]),
                "peak": 100 * (max(row["stress_ratio"] for row in rows) / peak - 1),
                "error before, rms, %": 100 * rms([error for error, _ in before]),
                "estimated, rms, %": 100 * rms([estimate for _, estimate in before]),
                "rows within the estimate, %": 100 * sum(error <= estimate for error, estimate in before) / len(before),
                "user time over Newton's": seconds / newton_seconds})
    table("32 boxes of 100 discs", groups, list(next(iter(groups.values()))[0]))


def biaxial(study):
    """Errors of explicit steps and of Newton's method as the case has it, both in % of the peak of slow grains in short steps."""
    groups = {}
    for seed in study.seeds:
        def made(name, settings, at_seed=seed):
            return study.run(f"biaxial-{name}", "discs400", at_seed, 0.023, settings, case="biaxial.yaml")

        reference, _, _ = made("slow", ["steps.count=92", "materials.sand.inertial_number=1.5e-4", "materials.sand.unbalanced_force_ratio=2e-3"])
        peak = max(row["stress_ratio"] for row in reference)
        runs = {"Newton's method, 23 steps": made("newton", [])}
        for pace in ["6e-4", "3e-4", "1.5e-4"]:
            runs[f"explicit, pace {pace}"] = made(pace, ["steps.method=explicit", f"steps.pace={pace}"])
        runs["explicit, pace 1.5e-4, 2 DEM steps"] = made("1.5e-4-d2", ["steps.method=explicit", "steps.pace=1.5e-4", "steps.dem_steps=2"])
        newton_seconds = next(iter(runs.values()))[2]
        for name, (rows, _, seconds) in runs.items():
            errors = [(row["axial_strain"], 100 * (row["stress_ratio"] - at(reference, row["axial_strain"])) / peak) for row in rows[1:]]
            groups.setdefault(name, []).append({
                "rms before 1.5 %, % of peak": rms([error for strain, error in errors if strain <= PEAK]),
                "behind": rms([error for strain, error in errors if strain > PEAK]),
                "user time over Newton's": seconds / newton_seconds})
    table("cases/biaxial", groups, list(next(iter(groups.values()))[0]))


def compare_elements(study, title, kind, strain, pace, listed, case, mesh, along):
    """@param listed element, number of elements and boxes of each; the last is the reference @param mesh key of the mesh"""
    groups = {}
    for seed in study.seeds:
        runs = [study.run(f"elements-{kind}-{element}-{boxes}", kind, seed, strain,
                          [f"steps.pace={pace}", f"mesh.element={element}", f"mesh.{mesh}.elements={count}"], case=case, along=along)
                for element, count, boxes in listed]
        reference = runs[-1][0]
        for (element, _, boxes), (rows, _, seconds) in zip(listed[:-1], runs):
            errors = [row["stress_ratio"] - at(reference, row["axial_strain"]) for row in rows[1:]]
            groups.setdefault(f"{element}, {boxes} boxes", []).append({
                "error, rms, % of the last": 100 * rms(errors) / reference[-1]["stress_ratio"],
                "at the end": 100 * errors[-1] / reference[-1]["stress_ratio"],
                "user time over the reference's": seconds / runs[-1][2]})
    table(title, groups, list(next(iter(groups.values()))[0]))


def elements(study):
    (study.place / "block.yaml").write_text(BLOCK_IN_SPACE, encoding="utf-8")
    compare_elements(study, "in the plane, 100 discs", "discs", PEAK, "1.5e-4", PLANE, "explicit_plates.yaml", "rectangle", "u2")
    compare_elements(study, "in space, 200 spheres", "spheres", 0.005, "3.75e-5", SPACE, "block.yaml", "box", "u3")


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("-o", "--output", type=pathlib.Path, required=True)
    arguments.add_argument("--packings", type=int, default=10)
    arguments.add_argument("--parts", default="far,careful,discs,biaxial,elements")
    arguments.add_argument("--program", type=pathlib.Path, default=HERE / "../../build/release/app/polargrain")
    options = arguments.parse_args()
    parts = {"far": far, "careful": careful, "discs": discs, "biaxial": biaxial, "elements": elements}
    if unknown := sorted(set(options.parts.split(",")) - set(parts)):
        arguments.error(f"--parts: there is no {', '.join(unknown)}; there are {', '.join(parts)}")
    place = options.output.resolve()
    place.mkdir(parents=True, exist_ok=True)
    shutil.copy(HERE / "explicit_plates.yaml", place)
    shutil.copy(HERE / "../biaxial/case.yaml", place / "biaxial.yaml")
    study = Study(str(options.program.resolve()), place, range(1, options.packings + 1))
    for part in options.parts.split(","):
        parts[part](study)


if __name__ == "__main__":
    main()
