#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Figures of docs/studies/toyoura.md from what calibrate.py and specimen.py of cases/studies/toyoura left:
plot_toyoura.py RESULTS. Of the specimens only what is there is drawn."""
import csv
import json
import pathlib
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "cases/studies/toyoura"))
from laboratory import CURVES  # noqa: E402
from sand import D50  # noqa: E402

PRESSURES = (49, 98)


def finish(figure, name):
    figure.tight_layout()
    figure.savefig(HERE / name, dpi=80)


def draw_laboratory(top, bottom, pressure, end):
    top.plot(*zip(*CURVES[pressure]["ratio"]), "ko", ms=4, label="laboratory")
    bottom.plot(*zip(*CURVES[pressure]["volume"]), "ko", ms=4)
    top.set(ylabel="stress ratio", xlim=(0, end))
    bottom.set(xlabel="axial strain, %", ylabel="volume strain, % (dilation negative)", xlim=(0, end))


def draw_calibration(results):
    figure, axes = plt.subplots(2, 3, figsize=(11, 6))
    for column, (pressure, title) in enumerate(zip(PRESSURES, ("49 kPa: fitted up to the peak", "98 kPa: predicted"))):
        top, bottom = axes[0][column], axes[1][column]
        curves = [numpy.loadtxt(name, delimiter=",", skiprows=1).T
                  for name in sorted(results.glob(f"prediction-{pressure}kPa-seed*.csv"))]
        axial = numpy.linspace(0, min(curve[0][-1] for curve in curves), 200)
        for panel, k in ((top, 1), (bottom, 2)):
            for curve in curves:
                panel.plot(curve[0], curve[k], color="0.7", lw=0.8)
            panel.plot(axial, numpy.mean([numpy.interp(axial, curve[0], curve[k]) for curve in curves], axis=0), "C0",
                       label="mean of the packings (grey: each)")
        draw_laboratory(top, bottom, pressure, 6)
        bottom.set(ylim=(-5, 1))
        top.set(title=title)
        top.legend(fontsize=7)
    with open(results / "record.csv", newline="") as file:
        misfits = [float(row["misfit"]) for row in csv.DictReader(file)]
    search = axes[0][2]
    search.semilogy(range(1, len(misfits) + 1), misfits, ".", label="each")
    search.semilogy(range(1, len(misfits) + 1), numpy.minimum.accumulate(misfits), label="best so far")
    search.set(title="searches", xlabel="evaluation", ylabel="misfit")
    search.legend(fontsize=7)
    axes[1][2].axis("off")
    finish(figure, "toyoura.png")


def specimens(results, pressure):
    """Folders of a pressure, the smallest specimen first."""
    folders = [path for path in results.glob(f"specimen-{pressure}-*") if (path / "band-end.csv").exists()]
    return sorted(folders, key=lambda path: [float(word) for word in path.name.split("-")[2:]])


def draw_specimens(results):
    figure, axes = plt.subplots(2, 2, figsize=(10, 6.5), squeeze=False)
    for column, pressure in enumerate(PRESSURES):
        top, bottom = axes[0][column], axes[1][column]
        for folder in specimens(results, pressure):
            _, _, width, across = folder.name.split("-")
            with open(folder / "out/history.csv", newline="") as file:
                rows = list(csv.DictReader(file))
            axial = [100 * float(row["axial_strain"]) for row in rows]
            top.plot(axial, [float(row["stress_ratio"]) for row in rows], lw=1,
                     label=f"{width} d50 wide, {across} elements across")
            bottom.plot(axial, [-100 * float(row["volume_strain"]) for row in rows], lw=1)
        draw_laboratory(top, bottom, pressure, 7.5)
        top.set(title=f"{pressure} kPa")
        top.legend(fontsize=7)
    finish(figure, "toyoura_specimen.png")


def draw_fields(results):
    """Shear strain and micro-rotation in the last third, of the widest specimen of each pressure."""
    widest = [specimens(results, pressure)[-1] for pressure in PRESSURES]
    figure, axes = plt.subplots(1, 4, figsize=(11, 5.5))
    for column, (pressure, folder) in enumerate(zip(PRESSURES, widest)):
        places = numpy.genfromtxt(folder / "band-end.csv", delimiter=",", names=True)
        band = json.loads((folder / "band-end.json").read_text())
        x, y = places["x"] / D50, places["y"] / D50
        for axis, name, colours in ((axes[2 * column], "shear", "viridis"), (axes[2 * column + 1], "rotation", "RdBu_r")):
            largest = numpy.abs(places[name]).max()
            side = numpy.sqrt(numpy.median(places["area"])) / D50
            columns, rows = round(numpy.ptp(x) / side) + 1, round(numpy.ptp(y) / side) + 1
            grid = numpy.full((rows, columns), numpy.nan)
            grid[numpy.rint((y - y.min()) / side).astype(int), numpy.rint((x - x.min()) / side).astype(int)] = places[name]
            drawn = axis.imshow(grid, origin="lower", cmap=colours, extent=(0, columns * side, 0, rows * side),
                                vmin=0 if name == "shear" else -largest, vmax=largest)
            if band.get("found"):
                centre = numpy.array(band["centre"]) / D50
                slope = numpy.tan(numpy.radians(band["inclination_degrees"]))
                axis.axline(centre, slope=slope, color="k", lw=0.8, ls="--")
            axis.set_title(f"{pressure} kPa: " + ("shear strain" if name == "shear" else "rotation, rad"), fontsize=9)
            axis.set(xlabel="d50", xlim=(0, columns * side), ylim=(0, rows * side))
            figure.colorbar(drawn, ax=axis, shrink=0.7)
    finish(figure, "toyoura_fields.png")


def main():
    results = pathlib.Path(sys.argv[1])
    draw_calibration(results)
    if all(specimens(results, pressure) for pressure in PRESSURES):
        draw_specimens(results)
        draw_fields(results)


if __name__ == "__main__":
    main()
