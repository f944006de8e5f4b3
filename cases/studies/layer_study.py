#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""How thick is the band in a sheared layer: of grains, and of cells with controlled rotations.

    python3 layer_study.py -o RESULTS [--size reduced|full] [--jobs 2] [--programs FOLDER]

Layers: ten packings of 1,600 discs (40 d high) with rolling coefficients 0, 0.2 and 0.4 (reduced: two packings, 0.2). Columns of
cells (layer_column.yaml): COLUMNS (reduced: the first of them). Both are measured with one ruler: a straight line and a tanh, fitted to the displacements along the layer in a
window of time; thickness is the full width at half maximum of the shear rate of the tanh. Nothing is smoothed before.
What is there already is not made again. Prints tables in Markdown and, with matplotlib, writes layer.png.
"""
import argparse
import concurrent.futures
import math
import pathlib
import shutil
import statistics
import subprocess

import numpy
import scipy.optimize

import layer
from built_package import polargrain
from dumps import read_grains
from gmsh_mesh import Grid
from internal_length import DIAMETER
from intervals import table
from polargrain.table import read_table

HERE = pathlib.Path(__file__).resolve().parent
PRESSURE = 1e5   # Pa
WINDOW = 6       # frames of 0.005 of shear over which a layer's displacements are taken
COLUMN = 0.1     # m, height of the columns
COLUMNS = ((10, "dense100_seed2"), (20, "dense100_seed2"), (10, "dense100_seed3"), (10, "dense400_seed1"), (20, "dense400_seed1"),
           (10, "dense400_seed4"))  # elements, packing of the cells


def band(height, displacement):
    """@returns thickness (full width at half maximum of the rate, m), place (m), the fit's own explained share"""
    whole = height.max() - height.min()
    jump = displacement[height.argmax()] - displacement[height.argmin()]

    def profile(y, base, slope, half, place, length):
        return base + slope * y / whole + half * numpy.tanh((y - place) / length)

    best = None
    for place in numpy.linspace(height.min() + 0.1 * whole, height.max() - 0.1 * whole, 12):
        for length in (0.3 * DIAMETER, DIAMETER, 4.0 * DIAMETER):
            try:
                fit, _ = scipy.optimize.curve_fit(profile, height, displacement, [0.5 * jump, 0.1 * jump, 0.5 * jump, place, length],
                                                  maxfev=4000)
            except RuntimeError:  # this start leads nowhere
                continue
            rest = ((profile(height, *fit) - displacement) ** 2).sum()
            if best is None or rest < best[0]:
                best = (rest, fit)
    rest, fit = best
    share = 1.0 - rest / ((displacement - displacement.mean()) ** 2).sum()
    return 2.0 * math.acosh(math.sqrt(2.0)) * abs(fit[4]), fit[3], share


# --- layers of grains

def layer_figures(place):
    rows = read_table(place / "history.csv").rows
    ratio = [row["shear_stress"] / PRESSURE for row in rows]
    dumps = sorted((place / "grains").glob("step-*.dump"))
    figures = {"peak": max(ratio), "peak at": rows[ratio.index(max(ratio))]["displacement"] / DIAMETER,
               "residual": statistics.mean(ratio[-len(rows) // 10:])}
    for name, frame in (("thickness early", 20), ("thickness", len(dumps) - 1)):
        before, after = read_grains(dumps[frame - WINDOW]), read_grains(dumps[frame])
        width, _, _ = band(0.5 * (before[:, 2] + after[:, 2]), after[:, 1] - before[:, 1])
        figures[name] = width / DIAMETER
    return figures


# --- columns of cells

def write_column(file, elements):
    """A column one element wide, with the sets of nodes `below` and `above` at 0.3 and 0.7 of its height."""
    size = COLUMN / elements
    grid = Grid([0.0, size], [k * size for k in range(elements + 1)])
    grid.name("bottom", "line", grid.bottom())
    grid.name("top", "line", grid.top())
    grid.name("left", "line", grid.left())
    grid.name("right", "line", grid.right())
    for name, share in (("below", 0.3), ("above", 0.7)):
        grid.name(name, "point", [[grid.node(i, 2 * round(share * elements))] for i in (0, 2, 1)])
    grid.name("sand", "quad", grid.quads)
    grid.write(file)


def run_column(program, place, elements, packing, workers):
    """@returns the folder of the results"""
    out = place / f"column{elements}-{packing.stem}"
    if not (out / "summary.json").exists():
        command = [program, "run", "layer_column.yaml", "-o", out.name, "-w", str(workers), "--quiet", "--set",
                   f"mesh.file=column{elements}.msh", "--set", f"materials.sand.packing={packing.name}"]
        with open(place / f"{out.name}.log", "w", encoding="utf-8") as log:
            subprocess.run(command, cwd=place, stdout=log, stderr=subprocess.STDOUT, check=False)
    return out


def read_column(fields):
    """@returns heights (m), displacements along the layer (m) and micro-rotations (rad) of the nodes on the left side"""
    left = numpy.flatnonzero(fields.points[:, 0] < 1e-9)
    left = left[fields.points[left, 1].argsort()]
    rotation = fields.point_data.get("micro_rotation", numpy.full(len(fields.points), math.nan))
    return fields.points[left, 1], fields.point_data["displacement"][left, 0], rotation[left]


def column_figures(out, elements):
    result = polargrain.Result(out)
    rows = result.history.rows
    ratio = [row["shear_force"] / (COLUMN / elements * PRESSURE) for row in rows]
    widths = []
    for before, after in ((-7, -5), (-5, -3), (-3, -1)):
        start, end = read_column(result.fields(before)), read_column(result.fields(after))
        width, _, _ = band(start[0], end[1] - start[1])
        widths.append(width / DIAMETER)
    return {"peak": max(ratio), "peak at": rows[ratio.index(max(ratio))]["displacement"] / DIAMETER,
            "residual": statistics.mean(ratio[-10:]), "thickness": statistics.median(widths),
            "followed to": rows[-1]["displacement"] / DIAMETER,
            "iterations": sum(row["iterations"] for row in rows) / max(1, len(rows) - 1), "jumps": sum(row["jumps"] for row in rows)}


def draw(place, layers, columns):
    try:
        import matplotlib
        matplotlib.use("Agg")
        from matplotlib import pyplot
    except ImportError:
        return
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(10, 4.2))
    for out in layers:
        history = read_table(out / "history.csv")
        left.plot(1e3 * history["displacement"], history["shear_stress"] / PRESSURE, color="0.7", lw=0.6)
        dumps = sorted((out / "grains").glob("step-*.dump"))
        before, after = read_grains(dumps[-1 - WINDOW]), read_grains(dumps[-1])
        moved = after[:, 1] - before[:, 1]
        height = 0.5 * (before[:, 2] + after[:, 2])
        _, centre, _ = band(height, moved)
        right.plot((moved - moved.min()) / (moved.max() - moved.min()), (height - centre) / DIAMETER, ".", color="0.75", ms=1)
    for name, (out, elements) in columns.items():
        result = polargrain.Result(out)
        history = result.history
        left.plot(1e3 * history["displacement"], history["shear_force"] / (COLUMN / elements * PRESSURE), lw=1.2, label=name)
        start, end = read_column(result.fields(-3)), read_column(result.fields(-1))
        moved = end[1] - start[1]
        _, centre, _ = band(start[0], moved)
        right.plot(moved / moved[-1], (start[0] - centre) / DIAMETER, ".-", lw=1.2, ms=3, label=name)
    left.set(xlabel="displacement of the upper plate, mm", ylabel="shear stress over normal stress", xlim=(0, 58))
    right.set(xlabel="share of the displacement of the last window", ylabel="height from the band, mean diameters", ylim=(-6, 6))
    right.legend(frameon=False, title="columns of cells (grey: grains)", fontsize=8)
    figure.tight_layout()
    figure.savefig(place / "layer.png", dpi=110)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("-o", "--output", type=pathlib.Path, required=True)
    arguments.add_argument("--size", choices=("reduced", "full"), default="reduced")
    arguments.add_argument("--jobs", type=int, default=2)
    arguments.add_argument("--programs", type=pathlib.Path, default=HERE / "../../build/release/app")
    arguments.add_argument("--check", action="store_true", help="fail when the bands are not what the page says")
    options = arguments.parse_args()
    place = options.output.resolve()
    place.mkdir(parents=True, exist_ok=True)
    polargrain = str((options.programs / "polargrain").resolve())
    liggghts = str((options.programs / "standalone/polargrain-liggghts").resolve())
    full = options.size == "full"

    seeds, coefficients = (range(1, 11), (0.0, 0.2, 0.4)) if full else (range(1, 3), (0.2,))
    layers = {(rolling, seed): place / f"layer-r{rolling:g}-s{seed}" for rolling in coefficients for seed in seeds}

    def one_layer(key):
        rolling, seed = key
        layer.shear(polargrain, liggghts, place / f"grains1600-s{seed}.h5", layers[key], rolling, 0.16)

    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        list(pool.map(lambda seed: layer.make_packing(polargrain, 1600, seed, place / f"grains1600-s{seed}.h5"), seeds))
        list(pool.map(one_layer, layers))
    table("rolling coefficient, layers of grains",
          {f"{rolling:g}": [layer_figures(layers[rolling, seed]) for seed in seeds] for rolling in coefficients},
          ("peak", "peak at", "residual", "thickness early", "thickness"))

    shutil.copy(HERE / "layer_column.yaml", place)
    wanted = COLUMNS if full else COLUMNS[:1]
    columns = {}
    for elements, name in wanted:
        write_column(place / f"column{elements}.msh", elements)
        shutil.copy(HERE / f"{name}.h5", place)
        columns[f"{elements}, {name}"] = (run_column(polargrain, place, elements, place / f"{name}.h5", options.jobs), elements)
    figures = {name: [column_figures(*column)] for name, column in columns.items()}
    table("elements and cells of a column", figures, ("peak", "peak at", "residual", "thickness", "followed to", "iterations", "jumps"))
    draw(place, [layers[0.2, seed] for seed in seeds], columns)
    if options.check:
        thickness = statistics.mean(layer_figures(layers[0.2, seed])["thickness"] for seed in seeds)
        thin = max(one["thickness"] for (one,) in figures.values())
        if not (3.0 < thickness < 8.0 and thin < 1.5):
            raise SystemExit(f"bands of {thickness:.2g} d in layers and up to {thin:.2g} d in columns: not what the page says")


if __name__ == "__main__":
    main()
