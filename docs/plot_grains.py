#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Draws a run with its grains: a field on the moved mesh, and beside it the grains and force chains of two integration
points, one where the field is largest and one where it is least.

usage: docs/plot_grains.py RESULTS PICTURE.png [--step K] [--points A B] [--field NAME] [--program polargrain]
       (needs python3-vtk9 and python3-matplotlib; discs only)

The grains come from `polargrain grains`, which this calls.
"""
import argparse
import itertools
import pathlib
import shutil
import subprocess
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.collections
import matplotlib.patches
import matplotlib.patheffects
import matplotlib.pyplot as plt
import numpy
import PIL.Image
from plot_biaxial import read_fields
from vtk.util.numpy_support import vtk_to_numpy


def array(data, name):
    return vtk_to_numpy(data.GetArray(name))


def last_step(folder):
    return max(int(file.stem.split("-")[1]) for file in folder.glob("points-*.vtu"))


def draw_field(axes, results, step, name, chosen):
    grid = read_fields(results / f"fields/step-{step:05}.vtu")
    places = array(grid.GetPointData(), "displacement")[:, :2] + vtk_to_numpy(grid.GetPoints().GetData())[:, :2]
    triangles, values = [], []
    for element in range(grid.GetNumberOfCells()):
        cell = grid.GetCell(element)
        nodes = [cell.GetPointId(n) for n in range(cell.GetNumberOfPoints())]
        ring = {8: [0, 4, 1, 5, 2, 6, 3, 7], 6: [0, 3, 1, 4, 2, 5]}.get(len(nodes), range(len(nodes)))
        ring = [nodes[n] for n in ring]
        middle = len(places) + len(values)
        values.append(ring)
        triangles += [[a, b, middle] for a, b in zip(ring, ring[1:] + ring[:1])]
    at_nodes = array(grid.GetPointData(), name)
    at_middles = array(grid.GetCellData(), name)
    everywhere = numpy.vstack([places, [places[ring].mean(axis=0) for ring in values]])
    field = axes.tripcolor(everywhere[:, 0], everywhere[:, 1], triangles,
                           numpy.concatenate([at_nodes, at_middles]), shading="gouraud", cmap="magma_r")
    axes.add_collection(matplotlib.collections.LineCollection(
        [places[ring + ring[:1]] for ring in values], colors="0.5", linewidths=0.3))
    points = read_fields(results / f"fields/points-{step:05}.vtu")
    at = vtk_to_numpy(points.GetPoints().GetData())[:, :2] + array(points.GetPointData(), "displacement")[:, :2]
    for letter, point in zip("ab", chosen):
        axes.plot(*at[point], "o", markersize=9, markerfacecolor="none", markeredgecolor="white", markeredgewidth=3.5)
        axes.plot(*at[point], "o", markersize=9, markerfacecolor="none", markeredgecolor="C0", markeredgewidth=2)
        axes.annotate(letter, at[point], xytext=(7, 5), textcoords="offset points", color="C0", weight="bold",
                      fontsize=13, path_effects=[matplotlib.patheffects.withStroke(linewidth=3, foreground="white")])
    axes.set_aspect("equal")
    axes.set_axis_off()
    return field


def draw_grains(axes, grid, largest_rotation, force_scale):
    """@returns the discs, and the corners of the box"""
    nodes, cells = grid.GetPointData(), grid.GetCellData()
    kind = array(cells, "kind")
    box = array(grid.GetFieldData(), "box").reshape(3, 3)[:2, :2]
    places = vtk_to_numpy(grid.GetPoints().GetData())[:, :2]
    grains = numpy.flatnonzero(kind == 0)
    radii = array(nodes, "radius")[grains]
    rotation = array(nodes, "rotation")[grains, 2]
    lines = numpy.flatnonzero(kind == 1)
    ends = numpy.array([[grid.GetCell(int(c)).GetPointId(i) for i in (0, 1)] for c in lines])
    force = array(cells, "normal_force")[lines]
    side = box @ numpy.array([[0, 1, 1, 0], [0, 0, 1, 1]], float)
    outline = matplotlib.patches.Polygon(side.T, closed=True, facecolor="none", edgecolor="0.3", linewidth=1)
    axes.add_patch(outline)
    # Images of all that reaches into the box: it is periodic.
    copies = [box @ copy for copy in itertools.product((-1, 0, 1), repeat=2)]
    discs = matplotlib.collections.PatchCollection(
        [matplotlib.patches.Circle(place + copy, radius) for copy in copies
         for place, radius in zip(places[grains], radii)],
        cmap="coolwarm", edgecolor="0.75", linewidth=0.3)
    discs.set_array(numpy.tile(numpy.degrees(rotation), len(copies)))
    discs.set_clim(-largest_rotation, largest_rotation)
    chains = matplotlib.collections.LineCollection(
        [places[pair] + copy for copy in copies for pair in ends], colors="0.1", capstyle="round",
        linewidths=numpy.tile(numpy.maximum(force, 0.0) * force_scale, len(copies)))
    for collection in (discs, chains):
        axes.add_collection(collection)
        collection.set_clip_path(outline)
    axes.set_aspect("equal")
    axes.set_axis_off()
    return discs, side


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", type=pathlib.Path)
    parser.add_argument("picture")
    parser.add_argument("--step", type=int)
    parser.add_argument("--points", type=int, nargs=2)
    parser.add_argument("--field", default="deviatoric_strain")
    parser.add_argument("--program", default=shutil.which("polargrain") or "build/release/app/polargrain")
    asked = parser.parse_args()
    step = asked.step if asked.step is not None else last_step(asked.results / "fields")
    points = read_fields(asked.results / f"fields/points-{step:05}.vtu").GetPointData()
    field = array(points, asked.field)
    chosen = asked.points or [int(field.argmax()), int(field.argmin())]
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([asked.program, "grains", str(asked.results), "--quiet", "--step", str(step), "-o", folder]
                       + [word for point in chosen for word in ("--point", str(point))], check=True)
        grids = [read_fields(f"{folder}/point-{point}/step-{step:05}.vtu") for point in chosen]

    figure, (left, *right) = plt.subplots(1, 3, figsize=(12, 5.6), width_ratios=[0.75, 1, 1], layout="constrained")
    drawn = draw_field(left, asked.results, step, asked.field, chosen)
    figure.colorbar(drawn, ax=left, location="bottom", shrink=0.8, aspect=25, label=asked.field.replace("_", " "))
    forces = numpy.concatenate([array(grid.GetCellData(), "normal_force") for grid in grids])
    turned = numpy.degrees(numpy.concatenate([array(grid.GetPointData(), "rotation")[:, 2] for grid in grids]))
    corners = []
    for axes, letter, grid, point in zip(right, "ab", grids, chosen):
        discs, side = draw_grains(axes, grid, numpy.percentile(abs(turned), 99), 6 / forces.max())
        corners.append(side)
        stress = array(points, "stress")[point] / 1e3
        axes.set_title(f"{letter}: point {point}, {asked.field.replace('_', ' ')} {field[point]:.3f}\n"
                       f"s11 {stress[0]:.0f} kPa, s22 {stress[1]:.0f} kPa", fontsize=10)
    largest = 1.02 * max(numpy.ptp(side, axis=1).max() for side in corners)  # both boxes on one scale
    for axes, side in zip(right, corners):
        middle = side.mean(axis=1)
        axes.set_xlim(middle[0] - largest / 2, middle[0] + largest / 2)
        axes.set_ylim(middle[1] - largest / 2, middle[1] + largest / 2)
    figure.colorbar(discs, ax=right, location="bottom", shrink=0.5, aspect=35, extend="both",
                    label="rotation of the grains, degrees; lines: contacts, as thick as their normal force")
    figure.savefig(asked.picture, dpi=100)
    PIL.Image.open(asked.picture).convert("RGB").quantize(256).save(asked.picture, optimize=True)  # a third of the bytes


if __name__ == "__main__":
    main()
