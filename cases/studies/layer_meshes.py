#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Columns of cells with controlled rotations on several meshes and packings, before their peak and through softening.

    python3 layer_meshes.py -o RESULTS [--packings 5] [--meshes 10 20 40] [--softening 5 10 20] [--layers FOLDER] [--program POLARGRAIN]

Columns 10 d high as in layer_column.yaml, each packing of 100 discs on each mesh (elements). Before the peak: the load and, of each
step, the rotations across the column, w = w0 (1 - cosh(y / l) / cosh(H / 2l)) with the decay length l. Behind it: the load and the thickness
of the band. FOLDER, of `polargrain layer`, has layers of grains whose rotations near the plates are measured too. What is there already
is not made again. Prints tables in Markdown: mean and 95 % interval over the packings; differences of meshes are of the same packing.
"""
import argparse
import os
import pathlib
import re
import statistics
import subprocess

import numpy
import scipy.optimize

from built_package import polargrain
from dumps import read_grains
from intervals import table
from layer import PLATE
from layer_study import COLUMN, DIAMETER, PRESSURE, band, read_column, write_column

HERE = pathlib.Path(__file__).resolve().parent
STAGES = {"before": "    - {until: 0.075, count: 3}\n",
          "softening": "    - {until: 0.2, count: 8}\n    - {measure: {on: above, from: below, displacement: u1}, grow: 5 mm, count: 25}\n"}
LIMIT = 900.0  # s, of a run


def write_case(file, stages):
    """layer_column.yaml with other steps: every one of them kept, corrections halved where they make matters worse."""
    text = (HERE / "layer_column.yaml").read_text(encoding="utf-8")
    first, last = text.index("  stages:"), text.index("  cut: 12")
    text = text[:first] + "  stages:\n" + stages + "  line_search: 3\n" + text[last:]
    file.write_text(text.replace("every: 5", "every: 1"), encoding="utf-8")


def run(program, place, kind, elements, seed):
    """@returns the folder of the results, whether it came to its end or not"""
    out = place / f"{kind}-{elements}-{seed}"
    if not (out / "summary.json").exists() and not (place / f"{out.name}.log").exists():
        write_column(place / f"column{elements}.msh", elements)
        write_case(place / f"{kind}.yaml", STAGES[kind])
        with open(place / f"{out.name}.log", "w", encoding="utf-8") as log:
            try:
                subprocess.run([program, "run", f"{kind}.yaml", "-o", out.name, "-w", "1", "--quiet", "--set", f"mesh.file=column{elements}.msh",
                                "--set", f"materials.sand.packing=cells{seed}.h5"], cwd=place, stdout=log, stderr=subprocess.STDOUT,
                               timeout=LIMIT, check=False)
            except subprocess.TimeoutExpired:
                print(f"broken off after {LIMIT:g} s", file=log)
    return polargrain.Result(out)


def decay_length(heights, rotations):
    """@returns decay length (m), rotation far from the plates (rad), what the fit leaves of that"""
    middle = 0.5 * (heights[0] + heights[-1])
    half = middle - heights[0]

    def profile(y, w0, length):
        return w0 * (1.0 - numpy.exp(numpy.logaddexp((y - middle) / length, (middle - y) / length) -
                                     numpy.logaddexp(half / length, -half / length)))

    fit, _ = scipy.optimize.curve_fit(profile, heights, rotations, [rotations[len(rotations) // 2], 0.4 * DIAMETER],
                                      bounds=([-1.0, 0.02 * DIAMETER], [1.0, COLUMN]))
    return fit[1], fit[0], numpy.sqrt(numpy.mean((profile(heights, *fit) - rotations) ** 2)) / abs(fit[0])


def before_the_peak(result, elements, step):
    start, end = read_column(result.fields(step - 1)), read_column(result.fields(step))
    length, far, rest = decay_length(start[0], end[2] - start[2])
    row, last = result.history.rows[step], result.history.rows[step - 1]
    return {"stress ratio": row["shear_force"] / (COLUMN / elements * PRESSURE), "decay length, d": length / DIAMETER,
            "rotation over shear": far / ((row["displacement"] - last["displacement"]) / COLUMN), "rest": rest}


def way_of(result):
    """The displacement between the nodes that are driven behind the peak, mm, of every step"""
    ways = []
    for number in range(len(result.times)):
        heights, moved, _ = read_column(result.fields(number))
        low, high = (int(numpy.abs(heights - share * COLUMN).argmin()) for share in (0.3, 0.7))
        ways.append(1e3 * (moved[high] - moved[low]))
    return ways


def through_softening(result, elements, until):
    """Figures while the driven way is at most `until`, mm: what all meshes have reached"""
    ratios = [row["shear_force"] / (COLUMN / elements * PRESSURE) for row in result.history.rows]
    ways = way_of(result)
    last = max(k for k, way in enumerate(ways) if way <= until)
    peak = ratios.index(max(ratios[:9]))
    behind = [ratio for ratio, way in zip(ratios, ways) if ways[peak] + 0.5 <= way <= until]
    start, end = read_column(result.fields(peak)), read_column(result.fields(last))
    width, _, _ = band(start[0], end[1] - start[1])
    return {"peak": max(ratios[:9]), "mean behind it": statistics.mean(behind), "thickness, d": width / DIAMETER,
            "iterations": sum(row["iterations"] for row in result.history.rows) / (len(ratios) - 1),
            "jumps": sum(row["jumps"] for row in result.history.rows), "way, mm": ways[-1]}


def compared(of_mesh, finest):
    """Relative differences, %, of a mesh from the finest, packing by packing."""
    return [{key: 100.0 * (one[key] / other[key] - 1.0) for key in one} for one, other in zip(of_mesh, finest)]


def near_plates(folder, frame):
    """Rotations of the grains of a layer by their distance from the outermost ones that are glued, over those far from it."""
    dumps = sorted((folder / "grains").glob("step-*.dump"))
    before, after = read_grains(dumps[frame - 1]), read_grains(dumps[frame])
    turned, height = after[:, 4] - before[:, 4], before[:, 2]
    whole = float(re.search(r"(\S+) ylo yhi", (folder / "layer.data").read_text(encoding="utf-8")).group(1)) / 1.3  # with room above
    outermost = read_grains(dumps[0])[:, 2]
    glued = numpy.minimum(outermost, whole - outermost) < PLATE
    low, high = height[glued & (height < 0.5 * whole)].max(), height[glued & (height > 0.5 * whole)].min()
    apart = numpy.minimum(height - low, high - height) / DIAMETER
    far = turned[~glued & (apart > 4.0)].mean()
    return {name: turned[~glued & (apart > least) & (apart <= most)].mean() / far
            for name, least, most in (("below 0", -3.0, 0.0), ("0 to 1 d", 0.0, 1.0), ("1 to 2 d", 1.0, 2.0), ("2 to 4 d", 2.0, 4.0))}


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("-o", "--output", type=pathlib.Path, required=True)
    arguments.add_argument("--packings", type=int, default=5)
    arguments.add_argument("--meshes", type=int, nargs="+", default=[10, 20, 40], help="before the peak")
    arguments.add_argument("--softening", type=int, nargs="*", default=[5, 10, 20], help="meshes that are led through their peak")
    arguments.add_argument("--layers", type=pathlib.Path)
    arguments.add_argument("--program", type=pathlib.Path, default=HERE / "../../build/release/app/polargrain")
    arguments.add_argument("--check", action="store_true", help="fail when meshes differ before the peak by more than the page says")
    options = arguments.parse_args()
    program = str(options.program.resolve())
    os.environ["POLARGRAIN_PROGRAM"] = program
    place = options.output.resolve()
    place.mkdir(parents=True, exist_ok=True)
    seeds = range(31, 31 + options.packings)
    for seed in seeds:
        if not (place / f"cells{seed}.h5").exists():
            polargrain.pack(HERE / "../packings/dense400.yaml", place / f"cells{seed}.h5",
                            {"grains": 100, "script": "cells/hooke_li_chu.in", "seed": seed})
    for step in (1, 2, 3):
        groups = {f"{elements} elements": [before_the_peak(run(program, place, "before", elements, seed), elements, step) for seed in seeds]
                  for elements in options.meshes}
        finest = list(groups.values())[-1]
        for name, figures in list(groups.items())[:-1]:
            groups[f"{name} against the finest, %"] = compared(figures, finest)
            for one in groups[f"{name} against the finest, %"] if options.check and step == 1 else []:
                if not (abs(one["stress ratio"]) < 1.0 and abs(one["decay length, d"]) < 20.0):
                    raise SystemExit(f"{name} differ from the finest mesh by more than the page says: {one}")
        table(f"before the peak, step {step} of a shear of 0.005", groups, list(finest[0]))
    if options.layers:
        layers = sorted(options.layers.glob("layer*-seed*"))
        groups = {f"step {frame}": [near_plates(folder, frame) for folder in layers] for frame in (1, 2, 3)}
        table("rotations of grains over those far from the plates, by distance from a plate", groups, list(groups["step 1"][0]))
    if options.softening:
        results = {(elements, seed): run(program, place, "softening", elements, seed) for seed in seeds for elements in options.softening}
        until = {seed: min(way_of(results[elements, seed])[-1] for elements in options.softening) for seed in seeds}
        groups = {f"{elements} elements": [through_softening(results[elements, seed], elements, until[seed]) for seed in seeds]
                  for elements in options.softening}
        finest = list(groups.values())[-1]
        for name, figures in list(groups.items())[:-1]:
            groups[f"{name} against the finest, %"] = compared(figures, finest)
        table("through softening", groups, list(finest[0]))


if __name__ == "__main__":
    main()
