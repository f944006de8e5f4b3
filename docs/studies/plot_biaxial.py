#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Draws the figures of docs/studies/biaxial.md from result directories.

    plot_biaxial.py curves PICTURE.png LABEL=DIR[,DIR...] ...     stress ratio and volume strain over axial strain;
                                                                  directories of one label share a colour
    plot_biaxial.py fields PICTURE.png LABEL=SAMPLES.csv ...      shear strain and rotation side by side, from the
                                                                  files of `polargrain band DIR --fields SAMPLES.csv`
Needs python3-matplotlib.
"""
import csv
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

COLOURS = ("#1f4e79", "#616161", "#b5651d", "#2e7d32", "#8e24aa")


def columns(file, names):
    with open(file, newline="") as text:
        rows = list(csv.DictReader(text))
    return [np.array([float(row[name]) for row in rows]) for name in names]


def curves(picture, sets):
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
    for colour, (label, places) in zip(COLOURS, sets):
        for number, place in enumerate(places.split(",")):
            strain, ratio, volume = columns(pathlib.Path(place) / "history.csv",
                                            ("axial_strain", "stress_ratio", "volume_strain"))
            if volume[0] > 0.5:  # a run without volume strain at its start
                volume[0] = 0.0
            name = label if number == 0 else None
            axes[0].plot(100 * strain, ratio, color=colour, linewidth=0.9, label=name)
            axes[1].plot(100 * strain, 100 * volume, color=colour, linewidth=0.9, label=name)
    axes[0].set_ylabel("stress ratio")
    axes[0].set_ylim(top=8.5)
    axes[1].set_ylabel("volume strain, % (dilation positive)")
    for axis in axes:
        axis.set_xlabel("axial strain, %")
        axis.grid(alpha=0.3)
    axes[0].legend(fontsize=7, loc="upper right")
    figure.savefig(picture, dpi=100)


def fields(picture, sets):
    figure, axes = plt.subplots(2, len(sets), figsize=(2.3 * len(sets), 7.4), layout="constrained", squeeze=False)
    for column, (label, file) in enumerate(sets):
        x, y, area, shear, rotation = columns(file, ("x", "y", "area", "shear", "rotation"))
        size = 0.6 * np.sqrt(area / ((x.max() - x.min()) * (y.max() - y.min()))) * 330
        for axis, values, colours, low in ((axes[0][column], shear, "viridis", 0.0),
                                           (axes[1][column], rotation, "RdBu", None)):
            high = np.quantile(np.abs(values), 0.97) or 1.0
            marks = axis.scatter(x, y, c=values, s=size**2 * 0.6, marker="s" if len(x) < 200 else "o", cmap=colours,
                                 vmin=-high if low is None else low, vmax=high, linewidths=0)
            axis.set_aspect("equal")
            axis.set_axis_off()
            figure.colorbar(marks, ax=axis, shrink=0.6)
        axes[0][column].set_title(label, fontsize=9)
    figure.savefig(picture, dpi=55)


def main(arguments):
    if len(arguments) < 3 or arguments[0] not in ("curves", "fields"):
        sys.exit(__doc__)
    sets = [tuple(word.split("=", 1)) for word in arguments[2:]]
    (curves if arguments[0] == "curves" else fields)(arguments[1], sets)


if __name__ == "__main__":
    main(sys.argv[1:])
