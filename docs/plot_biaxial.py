#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Draws the picture of a biaxial run: the curves of history.csv and the deviatoric strain of its last fields.

usage: docs/plot_biaxial.py RESULTS PICTURE.png      (needs python3-vtk9 and python3-matplotlib)
"""
import csv
import pathlib
import sys

import matplotlib
import matplotlib.collections

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import vtk
from vtk.util.numpy_support import vtk_to_numpy


def read_fields(file):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(file))
    reader.Update()
    return reader.GetOutput()


def element_outlines(grid, magnification):
    """Corner and mid-side nodes of each 8-node element, in the order of its outline, at magnified displacement."""
    points = vtk_to_numpy(grid.GetPoints().GetData())[:, :2]
    displacement = vtk_to_numpy(grid.GetPointData().GetArray("displacement"))[:, :2]
    moved = points + magnification * displacement
    outlines = []
    for k in range(grid.GetNumberOfCells()):
        ids = grid.GetCell(k).GetPointIds()
        nodes = [ids.GetId(n) for n in (0, 4, 1, 5, 2, 6, 3, 7)]
        outlines.append(moved[nodes])
    return outlines


def cell_means(grid, name):
    data = grid.GetCellData().GetArray(name)
    if data is not None:
        return vtk_to_numpy(data)
    values = vtk_to_numpy(grid.GetPointData().GetArray(name))
    means = []
    for k in range(grid.GetNumberOfCells()):
        ids = grid.GetCell(k).GetPointIds()
        means.append(sum(values[ids.GetId(n)] for n in range(ids.GetNumberOfIds())) / ids.GetNumberOfIds())
    return means


def draw_field(figure, axes, grid, name, label):
    collection = matplotlib.collections.PolyCollection(
        element_outlines(grid, 1.0), array=cell_means(grid, name), edgecolors="0.4", linewidths=0.4, cmap="viridis")
    axes.add_collection(collection)
    axes.autoscale()
    axes.set_aspect("equal")
    axes.set_axis_off()
    figure.colorbar(collection, ax=axes, label=label, shrink=0.75)


def main(results, picture):
    with open(results / "history.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    strain = [100 * float(row["axial_strain"]) for row in rows]
    ratio = [float(row["stress_ratio"]) for row in rows]
    volume = [100 * float(row["volume_strain"]) for row in rows]
    grid = read_fields(sorted((results / "fields").glob("*.vtu"))[-1])

    figure, (curves, shear, voids) = plt.subplots(1, 3, figsize=(11, 4), width_ratios=[1.5, 1, 1], layout="constrained")
    curves.plot(strain, ratio, "o-", color="#1f4e79", markersize=3)
    curves.set_xlabel("axial strain, %")
    curves.set_ylabel("stress ratio", color="#1f4e79")
    curves.grid(alpha=0.3)
    right = curves.twinx()
    right.plot(strain, volume, "s-", color="#b5651d", markersize=3)
    right.set_ylabel("volume strain, % (dilation positive)", color="#b5651d")
    draw_field(figure, shear, grid, "deviatoric_strain", "deviatoric strain")
    draw_field(figure, voids, grid, "void_ratio", "void ratio of the cells")
    figure.savefig(picture, dpi=110)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
