#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""A strip footing on ground of 10,080 points, each with grains of its own where it needs them: cases/footing_cells on a fine mesh.

    python3 ten_thousand_points.py -o RESULTS [--elements 60 42] [--set KEY=VALUE ...] [--workers 2] [--programs FOLDER]

Writes footing.msh (eight-noded elements, graded towards the footing as in cases/footing), runs `adaptive` on it and prints what it cost by part and how
many cells there were over the time.
"""
import argparse
import json
import pathlib
import shutil
import subprocess

import numpy

from gmsh_mesh import Grid

HERE = pathlib.Path(__file__).resolve().parent
CASE = HERE.parent / "footing_cells"
FOOTING, WIDTH, DEPTH = 1.0, 6.0, 4.0  # m; half of the ground, the left side is the plane of symmetry


def graded(start, end, count, last_over_first):
    """@returns `count` + 1 places whose distances grow in proportion"""
    sizes = last_over_first ** numpy.linspace(0.0, 1.0, count)
    return start + (end - start) * numpy.concatenate([[0.0], numpy.cumsum(sizes) / sizes.sum()])


def write_mesh(file, across, down):
    under = max(2, round(0.28 * across))
    x = numpy.concatenate([graded(0.0, FOOTING, under, 1.0), graded(FOOTING, WIDTH, across - under, 4.0)[1:]])
    y = DEPTH - graded(0.0, DEPTH, down, 2.6)[::-1]  # finest at the top
    grid = Grid(x, y)
    grid.name("base", "line", grid.bottom())
    grid.name("sides", "line", grid.left() + grid.right())
    grid.name("footing", "line", grid.top(last=under))
    grid.name("surface", "line", grid.top(first=under))
    grid.name("ground", "quad", grid.quads)
    grid.write(file)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("-o", "--output", type=pathlib.Path, required=True)
    arguments.add_argument("--elements", type=int, nargs=2, default=(60, 42), metavar=("ACROSS", "DOWN"))
    arguments.add_argument("--set", action="append", default=[], dest="settings")
    arguments.add_argument("--workers", type=int, default=2)
    arguments.add_argument("--programs", type=pathlib.Path, default=HERE / "../../build/release/app")
    options = arguments.parse_args()
    place = options.output.resolve()
    place.mkdir(parents=True, exist_ok=True)
    write_mesh(place / "footing.msh", *options.elements)
    shutil.copy(CASE / "packing100.h5", place)
    case = (CASE / "case.yaml").read_text(encoding="utf-8")
    case = case.replace("../footing/footing.msh", "footing.msh").replace("560", str(4 * options.elements[0] * options.elements[1]))
    (place / "case.yaml").write_text(case, encoding="utf-8")
    command = [str((options.programs / "polargrain").resolve()), "run", "case.yaml", "-o", "out", "-w", str(options.workers)]
    for setting in options.settings:
        command += ["--set", setting]
    subprocess.run(command, cwd=place, check=True)
    summary = json.loads((place / "out/summary.json").read_text(encoding="utf-8"))
    print(json.dumps(summary["materials"], indent=2))


if __name__ == "__main__":
    main()
