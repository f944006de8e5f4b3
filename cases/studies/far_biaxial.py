#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""How far biaxial tests with bands are followed, and what it takes: far_biaxial.yaml with ten packings, in every scheme.

    python3 far_biaxial.py -o RESULTS [--packings 10] [--schemes cell,explicit,informed,fixed_point,adaptive] [--set KEY=VALUE ...] [--programs FOLDER]

Packings of 100 dense discs with the seeds 1 to 10. What is there already is not run again. Prints a table in Markdown: strain reached, iterations a step,
jumps that were passed and the largest residual of one of them, peak and mean stress ratio behind 5 % of strain, user time of all processes;
then how far the curves of other schemes are from those of `cell`, packing by packing. --set adds settings to every
run, under a name of their own (--name); --compare NAME prints how far its curves are from those without.
"""
import argparse
import pathlib
import resource
import shutil
import subprocess

import numpy

from built_package import polargrain
from intervals import table

HERE = pathlib.Path(__file__).resolve().parent
SCHEMES = {"cell": [], "explicit": ["steps={method: explicit, count: 150}"], "informed": ["materials.sand.model=informed"],
           "fixed_point": ["materials.sand.model=informed", "materials.sand.informed.update=fixed_point"],
           "adaptive": ["materials.sand.model=adaptive"]}
STRAIN = 0.15
SPECIFICATION = ("title: 100 dense discs\ngrains: 100\nsizes: {{law: uniform, radius: [3 mm, 7 mm]}}\ndensity: 2650\n"
                 "thickness: 100 mm\nscript: cells/hooke_rolling.in\npressure: 100 kPa\nfriction: 0\nseed: {seed}\n")


def make_packing(program, place, seed):
    packing = place / f"dense100_seed{seed}.h5"
    if not packing.exists():
        specification = packing.with_suffix(".yaml")
        specification.write_text(SPECIFICATION.format(seed=seed), encoding="utf-8")
        subprocess.run([program, "pack", specification.name, "-o", packing.name, "--quiet"], cwd=place, check=True)
    return packing


def run(program, place, name, seed, settings, workers):
    out = place / f"{name}-{seed}"
    if not (out / "summary.json").exists():
        command = [program, "run", "far_biaxial.yaml", "-o", out.name, "-w", str(workers), "--quiet", "--set",
                   f"materials.sand.packing={make_packing(program, place, seed).name}"]
        for setting in settings:
            command += ["--set", setting]
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        with open(place / f"{out.name}.log", "w", encoding="utf-8") as log:
            subprocess.run(command, cwd=place, stdout=log, stderr=subprocess.STDOUT, check=False)
        seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
        (out / "user_seconds").write_text(f"{seconds:.2f}\n", encoding="utf-8")
    return polargrain.Result(out).history, float((out / "user_seconds").read_text(encoding="utf-8"))


def column(history, key):
    return numpy.nan_to_num(numpy.asarray(history[key], dtype=float))


def figures(history, seconds):
    strain, ratio = column(history, "axial_strain"), column(history, "stress_ratio")
    behind = ratio[strain > 0.05]
    return {"strain reached": strain[-1], "iterations a step": column(history, "iterations").sum() / max(1, len(strain) - 1),
            "cuts": column(history, "cuts").sum(), "jumps": column(history, "jumps").sum(),
            "largest residual passed": column(history, "jump_residual").max(), "peak": ratio.max(),
            "mean behind 5 %": behind.mean() if behind.size else numpy.nan, "user time, s": seconds}


def difference(one, other):
    """@returns root mean square and mean difference of two curves behind 0.5 % of strain, over the mean of the first"""
    ends = min(column(one, "axial_strain")[-1], column(other, "axial_strain")[-1])
    at = numpy.linspace(0.005, ends, 400)
    a, b = (numpy.interp(at, column(history, "axial_strain"), column(history, "stress_ratio")) for history in (one, other))
    return {"rms difference": numpy.sqrt(((b - a) ** 2).mean()) / a.mean(), "mean difference": (b - a).mean() / a.mean(),
            "difference of the peak": b.max() / a.max() - 1.0}


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("-o", "--output", type=pathlib.Path, required=True)
    arguments.add_argument("--packings", type=int, default=10)
    arguments.add_argument("--schemes", default=",".join(SCHEMES))
    arguments.add_argument("--set", action="append", default=[], dest="settings")
    arguments.add_argument("--name", default="", help="of runs with --set, before the name of the scheme")
    arguments.add_argument("--compare", default="", help="name of runs with --set, held against those without")
    arguments.add_argument("--workers", type=int, default=2)
    arguments.add_argument("--programs", type=pathlib.Path, default=HERE / "../../build/release/app")
    arguments.add_argument("--check", action="store_true", help="fail when fewer than nine tenths of the runs reach the end")
    options = arguments.parse_args()
    place = options.output.resolve()
    place.mkdir(parents=True, exist_ok=True)
    shutil.copy(HERE / "far_biaxial.yaml", place)
    program = str((options.programs / "polargrain").resolve())
    seeds = range(1, options.packings + 1)
    schemes = options.schemes.split(",")
    if unknown := sorted(set(schemes) - set(SCHEMES)):
        arguments.error(f"--schemes: there is no {', '.join(unknown)}; the schemes are {', '.join(SCHEMES)}")

    found, compared, far, curves = {}, {}, {}, {}
    for scheme in schemes:
        settings = SCHEMES[scheme] + options.settings
        runs = [run(program, place, options.name + scheme, seed, settings, options.workers) for seed in seeds]
        histories = curves[scheme] = [history for history, _ in runs]
        found[scheme] = [figures(*one) for one in runs]
        far[scheme] = sum(one["strain reached"] > STRAIN - 1e-6 for one in found[scheme])
        if options.compare:
            others = [run(program, place, options.compare + scheme, seed, settings, options.workers)[0] for seed in seeds]
            compared[scheme] = [difference(*pair) for pair in zip(histories, others)]
    table("scheme", found, list(next(iter(found.values()))[0]))
    for scheme, reached in far.items():
        print(f"{scheme}: {reached} of {len(seeds)} reach {100 * STRAIN:g} %, the least {min(one['strain reached'] for one in found[scheme]):.3f}")
    if "cell" in curves and len(curves) > 1:
        print()
        against = {scheme: [difference(*pair) for pair in zip(curves["cell"], histories)] for scheme, histories in curves.items() if scheme != "cell"}
        table("against `cell`", against, list(next(iter(against.values()))[0]))
    if compared:
        print()
        table(f"{options.compare} against without", compared, list(next(iter(compared.values()))[0]))
    if options.check and any(reached < 0.9 * len(seeds) for reached in far.values()):
        raise SystemExit("fewer than nine tenths of the runs reach the end")


if __name__ == "__main__":
    main()
