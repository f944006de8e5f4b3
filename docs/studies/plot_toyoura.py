#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Figure of docs/studies/toyoura.md from what cases/studies/toyoura/calibrate.py left: plot_toyoura.py RESULTS"""
import csv
import pathlib
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "cases/studies/toyoura"))
from laboratory import CURVES  # noqa: E402


def main():
    results = pathlib.Path(sys.argv[1])
    figure, axes = plt.subplots(2, 3, figsize=(11, 6))
    for column, (pressure, label) in enumerate([("49", "49 kPa: fitted up to the peak"), ("98", "98 kPa: predicted")]):
        top, bottom = axes[0][column], axes[1][column]
        for name in sorted(results.glob(f"prediction-{pressure}kPa-seed*.csv")):
            axial, ratio, volume = numpy.loadtxt(name, delimiter=",", skiprows=1).T
            top.plot(axial, ratio, lw=1, label="cell, seed " + name.stem[-1])
            bottom.plot(axial, volume, lw=1)
        laboratory = CURVES[int(pressure)]
        top.plot(*zip(*laboratory["ratio"]), "ko", ms=4, label="laboratory")
        bottom.plot(*zip(*laboratory["volume"]), "ko", ms=4)
        top.set(title=label, ylabel="stress ratio", xlim=(0, 6))
        bottom.set(xlabel="axial strain, %", ylabel="volume strain, % (dilation negative)", xlim=(0, 6), ylim=(-5, 1))
        top.legend(fontsize=7)
    with open(results / "record.csv", newline="") as file:
        misfits = [float(row["misfit"]) for row in csv.DictReader(file)]
    search = axes[0][2]
    search.semilogy(range(1, len(misfits) + 1), misfits, ".", label="each")
    search.semilogy(range(1, len(misfits) + 1), numpy.minimum.accumulate(misfits), label="best so far")
    search.set(title="search", xlabel="evaluation", ylabel="misfit")
    search.legend(fontsize=7)
    axes[1][2].axis("off")
    figure.tight_layout()
    figure.savefig(HERE / "toyoura.png", dpi=80)


if __name__ == "__main__":
    main()
