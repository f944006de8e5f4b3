#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Figure of docs/studies/biaxial_two_scale.md: plot_two_scale.py LABEL=RESULTS ..."""
import csv
import pathlib
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt


def main():
    figure, (top, bottom) = plt.subplots(1, 2, figsize=(10, 3.6))
    for argument in sys.argv[1:]:
        label, results = argument.rsplit("=", 1)
        with open(pathlib.Path(results) / "history.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        strain = [100 * float(row["axial_strain"]) for row in rows]
        top.plot(strain, [float(row["stress_ratio"]) for row in rows], label=label, lw=1.2)
        bottom.plot(strain, [100 * float(row["volume_strain"]) for row in rows], lw=1.2)
    top.set(xlabel="axial strain, %", ylabel="stress ratio")
    bottom.set(xlabel="axial strain, %", ylabel="volume strain, % (expansion positive)")
    top.legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(pathlib.Path(__file__).resolve().parent / "biaxial_two_scale.png", dpi=80)


if __name__ == "__main__":
    main()
