#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""A triaxial specimen of 192 boxes of 500 spheres, to 10 % of strain, beside one box of the same packing.

    python3 triaxial_cylinder.py -o RESULTS [--plates rough|smooth] [--packings 3] [--program build/release/app/polargrain]

Before a band forms a specimen between smooth plates should carry what its grains carry; rough plates hold its ends, and it carries more.
Then `band` finds a plane, or says why there is no band. The stress is
that over the section of the moment, A (1 + volume strain) / (1 - axial strain). What is there already is not run again. Tables are
Markdown, with means over the packings and their 95 % intervals.
"""
import argparse
import csv
import json
import pathlib
import resource
import shutil

from intervals import table
from runs import Programs

HERE = pathlib.Path(__file__).resolve().parent
SPECIFICATION = ("title: dense spheres\ngrains: 500\ndimension: 3\nscript: cells/spheres_hooke_radii.in\n"
                 "sizes: {{law: uniform, radius: [0.3 mm, 0.7 mm]}}\ndensity: 2650\npressure: 100 kPa\nfriction: 0\nseed: {seed}\n")
PRESSURE = 100e3  # Pa
STRAINS = [0.002, 0.005, 0.01, 0.02, 0.03]
PLATES = {"rough": [],  # as the case has them
          "smooth": ["--set", "boundary=[{on: bottom, fix: [u3]}, {on: bottom_axis, fix: [u1, u2]}, {on: bottom_side_right, fix: [u2]}, "
                              "{on: top, move: {u3: -14 mm}}, {on: side, pressure: 100 kPa}]"]}


def curve(folder):
    """@returns (axial strain, stress ratio over the section of the moment) of each row of a result"""
    with open(folder / "history.csv", encoding="utf-8") as file:
        rows = [{key: float(value) for key, value in row.items() if value} for row in csv.DictReader(file)]
    return [(row["axial_strain"], row["axial_stress"] * (1 - row["axial_strain"]) / (1 + row["volume_strain"]) / PRESSURE)
            for row in rows]


def at(points, strain):
    for (x0, y0), (x1, y1) in zip(points, points[1:]):
        if x0 <= strain <= x1 + 1e-12:
            return y0 + (y1 - y0) * (strain - x0) / (x1 - x0)
    return float("nan")


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("-o", "--output", type=pathlib.Path, required=True)
    arguments.add_argument("--plates", choices=PLATES, default="rough")
    arguments.add_argument("--packings", type=int, default=3)
    arguments.add_argument("--program", type=pathlib.Path, default=HERE / "../../build/release/app/polargrain")
    options = arguments.parse_args()
    place, program = options.output.resolve(), options.program.resolve()
    place.mkdir(parents=True, exist_ok=True)
    cases = ["triaxial_cylinder", "triaxial_one_box"]
    for case in cases:
        shutil.copy(HERE / f"{case}.yaml", place)
    programs = Programs()
    stress, ends = {"cylinder": [], "one box": [], "difference, %": []}, []
    for seed in range(1, options.packings + 1):
        packing = place / f"spheres_seed{seed}.h5"
        if not packing.exists():
            packing.with_suffix(".yaml").write_text(SPECIFICATION.format(seed=seed), encoding="utf-8")
            programs.call(place / "pack.log", program, "pack", f"{packing.stem}.yaml", "-o", packing.name, "--quiet", folder=place)
        curves = []
        for case in cases:
            settings = PLATES[options.plates] if case == cases[0] else []
            out = place / (f"{case}-{options.plates}-{seed}" if settings else f"{case}-{seed}")
            if not (out / "user_seconds").exists():
                before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
                programs.call(place / f"{out.name}.log", program, "run", f"{case}.yaml", "-o", out.name, "--quiet",
                              "--set", f"materials.sand.packing={packing.name}", *settings, folder=place)
                seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
                (out / "user_seconds").write_text(f"{seconds:.2f}\n", encoding="utf-8")
            curves.append(curve(out))
            if case == cases[0]:
                specimen = out
        whole, box = curves
        names = [f"at {100 * strain:g} %" for strain in STRAINS]
        for name, values in zip(stress, ([at(whole, x) for x in STRAINS], [at(box, x) for x in STRAINS],
                                         [100 * (at(whole, x) / at(box, x) - 1) for x in STRAINS])):
            stress[name].append(dict(zip(names, values)))
        programs.call(place / "band.log", program, "band", specimen)
        band = json.loads((specimen / "band.json").read_text(encoding="utf-8"))
        estimate = json.loads((specimen / "summary.json").read_text(encoding="utf-8"))["quasi_static"]["error_estimate"]
        peak_strain, peak = max(whole, key=lambda point: point[1])
        print(f"packing {seed}: to {100 * whole[-1][0]:.2f} % of strain; "
              + (f"plane dips by {band['dip_degrees']:.1f} degrees, thickness {1e3 * band['thickness']:.1f} mm"
                 if band["found"] else f"no band: {band['reason']}"))
        ends.append({"peak": peak, "its strain, %": 100 * peak_strain, "at the end": whole[-1][1], "of one box": box[-1][1],
                     "estimated error, median, %": 100 * estimate["median"], "user time, s": float((specimen / "user_seconds").read_text())})
    print()
    table("stress ratio", stress, list(next(iter(stress.values()))[0]))
    table("cylinder to 10 %", {"192 boxes of 500 spheres": ends}, list(ends[0]))


if __name__ == "__main__":
    main()
