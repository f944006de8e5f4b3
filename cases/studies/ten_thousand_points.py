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
    nodes = {}

    def node(i, j):  # in halves of an element
        if (i, j) not in nodes:
            at = [0.5 * (grid[k // 2] + grid[(k + 1) // 2]) for grid, k in ((x, i), (y, j))]
            nodes[i, j] = (len(nodes) + 1, *at)
        return nodes[i, j][0]

    quads = [[node(2 * i, 2 * j), node(2 * i + 2, 2 * j), node(2 * i + 2, 2 * j + 2), node(2 * i, 2 * j + 2), node(2 * i + 1, 2 * j),
              node(2 * i + 2, 2 * j + 1), node(2 * i + 1, 2 * j + 2), node(2 * i, 2 * j + 1)]
             for j in range(down) for i in range(across)]
    top = 2 * down
    row = [[node(2 * i, 0), node(2 * i + 2, 0), node(2 * i + 1, 0)] for i in range(across)]
    head = [[node(2 * i + 2, top), node(2 * i, top), node(2 * i + 1, top)] for i in range(across)]
    sides = [[node(0, 2 * j + 2), node(0, 2 * j), node(0, 2 * j + 1)] for j in range(down)]
    sides += [[node(2 * across, 2 * j), node(2 * across, 2 * j + 2), node(2 * across, 2 * j + 1)] for j in range(down)]
    groups = [(1, "base", 8, row), (1, "sides", 8, sides), (1, "footing", 8, head[:under]), (1, "surface", 8, head[under:]),
              (2, "ground", 16, quads)]
    elements = [f"{kind} 2 {tag} {tag} " + " ".join(map(str, member))
                for tag, (_, _, kind, members) in enumerate(groups, start=1) for member in members]
    file.write_text("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + f"$PhysicalNames\n{len(groups)}\n" +
                    "".join(f'{dimension} {tag} "{name}"\n' for tag, (dimension, name, _, _) in enumerate(groups, start=1)) +
                    f"$EndPhysicalNames\n$Nodes\n{len(nodes)}\n" +
                    "".join(f"{number} {a:.17g} {b:.17g} 0\n" for number, a, b in nodes.values()) +
                    f"$EndNodes\n$Elements\n{len(elements)}\n" + "".join(f"{k} {text}\n" for k, text in enumerate(elements, start=1)) +
                    "$EndElements\n", encoding="utf-8")


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
