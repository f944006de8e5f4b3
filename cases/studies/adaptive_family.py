#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""A family of scenes nobody tuned: what `model: adaptive` says of its error, and what its error is.

    python3 adaptive_family.py RESULTS --program build/release/app/polargrain              all of it
    python3 adaptive_family.py RESULTS --program ... --half even --tolerances 1,3          while something is changed
    python3 adaptive_family.py RESULTS --report                                            the table of what there is

30 scenes of six kinds (a block in shear, a punch, a wall, a slope, a notched plate, cycles), meshes, packings and loads drawn
with fixed seeds: 20 to 23 have 500 points and more, 24 to 29 spheres for discs. Each is run with a cell at every point (`cell`), again with cells that are read a little nearer to rest (what
two full runs differ by is no error of adaptivity: the scatter), and with `adaptive` at each tolerance. Scenes of even number may be looked at while the
adaptivity is worked on; those of odd number are for the table at the end. Runs that are done are not made again, unless
their case or the program has changed.

    error    mean over the elements of the norm of the in-plane stress's difference from the full run (controlled rotations: of skew and
             couple stress too), over the confining pressure; the largest of all steps
    curve    largest difference of the load curve over its range
    bound    what the run itself says the first error is at most, with 95 % confidence (error_bound)
    saved    DEM steps of the full run over those of the adaptive one, audits included
"""
import argparse
import hashlib
import itertools
import json
import math
import os
import pathlib
import random
import statistics
import subprocess
import sys

from built_package import polargrain

ROOT = pathlib.Path(__file__).resolve().parents[2]
KINDS = ["shear", "punch", "wall", "slope", "notched", "cyclic"]
COUNT = 30
LARGE = range(20, 24)    # scenes of 500 points and more
SPHERES = range(24, 30)  # scenes whose packings are of 200 spheres, in few elements
GROUPS = {"discs": range(20), "500 points and more": LARGE, "spheres": SPHERES}
DIAMETER = 0.01       # m, mean diameter of the grains of all packings
CONFINING = 100e3     # Pa


class Scene:
    def __init__(self, number):
        self.number = number
        self.draw = random.Random(1000 + number)
        self.kind = KINDS[number // 2 % len(KINDS)]
        self.name = f"{number:02d}-{self.kind}"
        large = number in LARGE
        self.spheres = number in SPHERES
        most = 5 if self.spheres else 7
        self.controlled = self.draw.random() < 0.25
        self.rolling = not self.controlled and self.draw.random() < 0.5
        self.packing_seed = self.draw.randrange(1, 7)
        self.loose = self.draw.random() < 0.3
        self.triangles = self.draw.random() < 0.25
        self.columns = 12 if large else self.draw.randrange(3, most)
        self.rows = 11 if large else self.draw.randrange(3, most)
        self.steps = 5 if large else self.draw.randrange(6, 11)
        self.size = self.draw.choice([0.3, 0.5, 1.0])  # m, of an element

    @property
    def script(self):
        if self.spheres:
            return "spheres_li_chu.in" if self.controlled or self.rolling else "spheres_hooke_radii.in"
        return "hooke_li_chu.in" if self.controlled else "hooke_rolling.in" if self.rolling else "hooke_radii.in"

    @property
    def packing(self):
        law = self.script.removeprefix("hooke_").removesuffix(".in")
        return f"{'loose' if self.loose else 'dense'}-{law}-{self.packing_seed}"

    def place(self, x, y):
        """Where a node of the unit grid lies, m."""
        width, height = self.columns * self.size, self.rows * self.size
        if self.kind == "slope":  # the surface falls from the height on the left to half of it on the right
            fall = min(max((x - 0.35) / 0.4, 0.0), 1.0)
            return width * x * 1.5, height * y * (1.0 - 0.5 * fall)
        return width * x, height * y

    def kept(self, column, row):
        """Whether a place of the grid has an element: the notch is cut from the left at half of the height."""
        return self.kind != "notched" or column > 0 or row != self.rows // 2

    def mesh(self):
        """The text of a mesh for Gmsh (format 2.2), elements with nodes at the middles of their sides."""
        nodes, elements, edges = {}, [], {}

        def node(i, j):  # of the grid twice as fine
            return nodes.setdefault((i, j), len(nodes) + 1)

        for column in range(self.columns):
            for row in range(self.rows):
                if not self.kept(column, row):
                    continue
                i, j = 2 * column, 2 * row
                corners = [(i, j), (i + 2, j), (i + 2, j + 2), (i, j + 2)]
                pieces = [corners[:3], [corners[0], *corners[2:]]] if self.triangles else [corners]
                for piece in pieces:
                    sides = [(a, b) for a, b in zip(piece, piece[1:] + piece[:1])]
                    middles = [((a[0] + b[0]) // 2, (a[1] + b[1]) // 2) for a, b in sides]
                    elements.append((9 if self.triangles else 16, [node(*p) for p in piece + middles]))
                    for (a, b), middle in zip(sides, middles):
                        edges.setdefault(middle, []).append((a, b))
        lines = []
        for middle, sides in sorted(edges.items()):
            if len(sides) == 1:
                lines.append((self.side_of(*middle), [node(*sides[0][0]), node(*sides[0][1]), node(*middle)]))
        names = sorted({name for name, _ in lines})
        text = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(names) + 1)]
        text += [f'1 {k + 1} "{name}"' for k, name in enumerate(names)] + ['2 100 "ground"', "$EndPhysicalNames"]
        text += ["$Nodes", str(len(nodes))]
        for (i, j), number in nodes.items():
            x, y = self.place(i / (2 * self.columns), j / (2 * self.rows))
            text.append(f"{number} {x:.17g} {y:.17g} 0")
        text += ["$EndNodes", "$Elements", str(len(lines) + len(elements))]
        for name, ends in lines:
            tag = names.index(name) + 1
            text.append(f"{len(text)} 8 2 {tag} {tag} " + " ".join(map(str, ends)))
        for kind, corners in elements:
            text.append(f"{len(text)} {kind} 2 100 100 " + " ".join(map(str, corners)))
        return "\n".join(text + ["$EndElements", ""])

    def side_of(self, i, j):
        if j == 0:
            return "bottom"
        if j == 2 * self.rows:
            footing = self.kind == "punch" and i < 2 * max(1, self.columns // 3)
            crest = self.kind == "slope" and i < 0.6 * self.columns
            return "footing" if footing else "crest" if crest else "top"
        return "left" if i == 0 else "right" if i == 2 * self.columns else "notch"

    def case(self, model):
        """The text of the case with a model and its keys."""
        draw = random.Random(2000 + self.number)
        width, height = self.columns * self.size, self.rows * self.size
        pressed = "{{on: {}, pressure: 100 kPa}}".format
        w = ", w" if self.controlled else ""
        # Spheres are several times as stiff against the pressure: they are where discs are at a quarter of the strain.
        strain = draw.uniform(0.004, 0.02) * (0.25 if self.spheres else 1.0)
        sign = draw.choice([-1, 1])
        stages, body = None, ""
        if self.kind in ("shear", "cyclic"):
            axis, length = ("u1", height) if self.kind == "shear" or draw.random() < 0.5 else ("u2", height)
            amount = strain * length * (sign if axis == "u1" else -1)
            move = f"{amount:.6g}"
            if self.kind == "cyclic":
                back = draw.uniform(-0.5, 0.5)
                move = f"[[0, 0], [1, {amount:.6g}], [2, {back * amount:.6g}], [3, {amount:.6g}]]"
                stages = 3
            other = f", fix: [{'u2' if axis == 'u1' else 'u1'}{w}]"
            boundary = [f"{{on: bottom, fix: [u1, u2{w}]}}", f"{{on: top{other}, move: {{{axis}: {move}}}}}",
                        pressed("[left, right]")]
            watched = ("top", axis)
        elif self.kind == "punch":
            boundary = ["{on: bottom, fix: [u1, u2]}", "{on: [left, right], fix: [u1]}", pressed("top"),
                        f"{{on: footing, fix: [u1], move: {{u2: {-0.5 * strain * height:.6g}}}}}"]
            watched = ("footing", "u2")
        elif self.kind == "wall":  # pushed into the ground, or drawn away from it
            amount = strain * width * (sign if sign > 0 else -0.4)
            boundary = ["{on: bottom, fix: [u2]}", "{on: right, fix: [u1]}", pressed("top"),
                        f"{{on: left, move: {{u1: {amount:.6g}}}}}"]
            watched = ("left", "u1")
        elif self.kind == "slope":  # below water of 10 m, then loaded by its weight and on its crest
            load = draw.uniform(120, 260)
            boundary = ["{on: bottom, fix: [u1, u2]}", "{on: [left, right], fix: [u1]}", pressed("top"),
                        f"{{on: crest, pressure: [[0, 100 kPa], [1, {load:.4g} kPa]]}}"]
            body = "body:\n  - {unit_weight: 10 kN/m3, factor: [[0, 0], [1, 1]]}\n"
            watched = ("crest", "u2")
        else:
            boundary = ["{on: bottom, fix: [u1, u2]}",
                        f"{{on: top, fix: [u1{w}], move: {{u2: {-0.5 * strain * height:.6g}}}}}",
                        pressed("[left, right, notch]")]
            watched = ("top", "u2")
        what = "displacement" if self.kind == "slope" else "reaction"
        steps = f"count: {self.steps}"
        if stages:
            each = max(3, self.steps // 2)
            steps = "stages: [" + ", ".join(f"{{until: {k}, count: {each}}}" for k in range(1, stages + 1)) + "]"
        rotations = "rotations: controlled" if self.controlled else "lc: 10 mm"
        return (f"title: {self.name}\nmesh: {{file: {self.name}.msh}}\n"
                f"materials:\n  sand: {{{model}, script: {ROOT}/liggghts_inputs/cells/{self.script}, "
                f"packing: packings/{self.packing}.h5, {rotations}}}\n"
                "regions: {ground: sand}\nboundary:\n" + "".join(f"  - {item}\n" for item in boundary) + body +
                f"steps: {{{steps}, cut: 6, iterations: 30, tolerance: 2e-3, noise: 2}}\n"
                f"monitors: {{load: {{on: {watched[0]}, {what}: {watched[1]}}}}}\n")


def run(command, log, seconds=None):
    """Runs a program; its words go to a file. @returns its exit status"""
    with open(log, "w") as out:
        try:
            return subprocess.run([str(word) for word in command], stdout=out, stderr=out, timeout=seconds).returncode
        except subprocess.TimeoutExpired:
            return -1


def need(status, what, log):
    if status != 0:
        sys.exit(f"error: {what} failed with status {status}:\n{log.read_text()[-2000:]}")


def packing_of(scene, results, program):
    file = results / "packings" / f"{scene.packing}.h5"
    if file.exists():
        return
    spec = file.with_suffix(".yaml")
    kind = "grains: 200\ndimension: 3" if scene.spheres else "grains: 100\nthickness: 100 mm"
    spec.write_text(f"title: {scene.packing}\n{kind}\nsizes: {{law: uniform, radius: [3 mm, 7 mm]}}\ndensity: 2650\n"
                    f"script: {ROOT}/liggghts_inputs/cells/{scene.script}\npressure: 100 kPa\n"
                    f"friction: {0.3 if scene.loose else 0}\nseed: {scene.packing_seed}\n")
    log = file.with_suffix(".log")
    need(run([program, "pack", spec, "-o", file], log), f"packing {scene.packing}", log)


def fields(file):
    """Element stresses and couple stresses of a field file: two lists of tuples."""
    found = polargrain.Fields(file).cell_data
    return found["stress"].tolist(), found["couple_stress"].tolist()


def difference(scene, one, other):
    """Mean over the elements of the norm of the difference, a share of the confining pressure."""
    total = 0.0
    for (s, m), (t, n) in zip(zip(*one), zip(*other)):
        d = [a - b for a, b in zip(s, t)]
        shear, skew = 0.5 * (d[3] + d[4]), 0.5 * (d[4] - d[3])
        squared = d[0] ** 2 + d[1] ** 2 + 2 * shear ** 2
        if scene.controlled:
            squared += 2 * skew ** 2 + sum((a - b) ** 2 for a, b in zip(m, n)) / DIAMETER ** 2
        total += math.sqrt(squared)
    return total / len(one[0]) / CONFINING


def history(directory):
    rows = polargrain.Result(directory).history
    return list(zip(rows["time"].tolist(), rows["load"].tolist()))


def compare(scene, full, other):
    """@returns error of the elements and of the curve, over the steps that both have taken"""
    rows = list(zip(history(full), history(other)))
    # A run that ends within a step shows how far it came: at another time than the full run's step.
    while rows and abs(rows[-1][0][0] - rows[-1][1][0]) > 1e-9:
        rows.pop()
    steps = len(rows)
    if steps < 2:
        return math.nan, math.nan, 0
    a, b = [one[1] for one, _ in rows], [other[1] for _, other in rows]
    scale = max(a) - min(a) or 1.0
    curve = max(abs(p - q) for p, q in zip(a, b)) / scale
    files = [f"fields/step-{k:05d}.vtu" for k in range(steps)]
    error = max(difference(scene, fields(full / name), fields(other / name)) for name in files
                if (full / name).exists() and (other / name).exists())
    return error, curve, steps - 1


def make(scene, results, program, tolerances, seconds, fingerprint):
    packing_of(scene, results, program)
    (results / f"{scene.name}.msh").write_text(scene.mesh())
    runs = {"full": "model: cell", "again": "model: cell, unbalanced_force_ratio: 4e-3"}
    runs |= {f"{t}": f"model: adaptive, adaptive: {{tolerance: {t} %}}" for t in tolerances}
    for label, model in runs.items():
        case, directory = results / f"{scene.name}-{label}.yaml", results / f"{scene.name}-{label}"
        text = scene.case(model)
        # A run with a cell a point does not depend on the adaptivity.
        mark = hashlib.sha256((text + ("" if "model: cell" in model else fingerprint)).encode()).hexdigest()
        done = directory / "done"
        if done.exists() and done.read_text() == mark:
            continue
        case.write_text(text)
        log = results / f"{scene.name}-{label}.log"
        status = run([program, "run", case, "-w", "1", "--quiet", "-o", directory], log, seconds)
        if status == 2 or not (directory / "summary.json").exists() and status != -1:
            need(status or 2, f"{scene.name} {label}", log)
        done.write_text(mark)
        print(f"{scene.name} {label}: status {status}", file=sys.stderr, flush=True)


def summary(directory):
    data = json.loads((directory / "summary.json").read_text())
    found = {}

    def walk(item):
        for key, value in item.items() if isinstance(item, dict) else []:
            if isinstance(value, dict):
                walk(value)
            else:
                found.setdefault(key, value)

    walk(data)
    return found


def rows_of(scene, results, tolerances):
    full = results / f"{scene.name}-full"
    if not (full / "summary.json").exists():
        return
    base = summary(full)
    scatter = compare(scene, full, results / f"{scene.name}-again") if (
        results / f"{scene.name}-again" / "summary.json").exists() else (math.nan, math.nan, 0)
    for t in tolerances:
        directory = results / f"{scene.name}-{t}"
        if not (directory / "summary.json").exists():
            continue
        said = summary(directory)
        error, curve, steps = compare(scene, full, directory)
        yield {"scene": scene.name, "number": scene.number, "tolerance": t / 100, "points": int(said.get("points", 0)),
               "controlled": scene.controlled, "scatter": scatter[0], "scatter_curve": scatter[1],
               "error": error, "curve": curve, "bound": said.get("error_bound", math.nan),
               "measured": said.get("history_error_mean", math.nan),
               "saved": base["dem_steps"] / said["dem_steps"] if said["status"] == "done" else math.nan, "cells": int(said.get("cells", 0)),
               "full": base["status"], "status": said["status"], "steps": steps,
               "vouched": said.get("vouched_for", math.nan), "dem": said["dem_steps"], "dem_full": base["dem_steps"],
               "audits": said.get("audit_runs", 0), "runs": said.get("cell_runs", 0)}


def report(scenes, results, tolerances):
    rows = [row for scene in scenes for row in rows_of(scene, results, tolerances)]
    percent = "{:.2f}".format
    print("| scene | points | tolerance | scatter | error | curve | bound | within | saved | cells | steps | status |")
    print("|---|---|---|---|---|---|---|---|---|---|---|---|")
    for r in rows:
        within = "yes" if r["error"] <= r["tolerance"] else "twice" if r["error"] <= 2 * r["tolerance"] else "no"
        covered = "" if not r["bound"] < r["error"] else " (not covered)"
        status = "done" if r["status"] == "done" and r["full"] == "done" else f"{r['status']}, full {r['full']}"
        saved = f"{r['saved']:.1f}" if r["saved"] > 0.0 else ""
        if r["vouched"] == 0:
            status += ", not vouched for"
        print(f"| {r['scene']}{' (w)' if r['controlled'] else ''} | {r['points']} | {100 * r['tolerance']:g} % | "
              f"{percent(100 * r['scatter'])} | {percent(100 * r['error'])} | {percent(100 * r['curve'])} | "
              f"{percent(100 * r['bound'])}{covered} | {within} | {saved} | {r['cells']} | {r['steps']} | {status} |")
    print()
    print("| scenes | tolerance | runs | within | within twice | curve within | bound covers | said beyond | saved, median | least |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    for group, half, t in itertools.product(GROUPS, ("even", "odd", "all"), tolerances):
        odd = {"even": (0,), "odd": (1,), "all": (0, 1)}[half]
        some = [r for r in rows if r["tolerance"] == t / 100 and r["number"] in GROUPS[group] and r["number"] % 2 in odd]
        if not some:
            continue
        n = len(some)
        count = lambda test: sum(1 for r in some if test(r))
        saved = [r["saved"] for r in some if r["saved"] > 0.0] or [math.nan]
        print(f"| {group}, {half} | {t} % | {n} | {count(lambda r: r['error'] <= r['tolerance'])} | "
              f"{count(lambda r: r['error'] <= 2 * r['tolerance'])} | {count(lambda r: r['curve'] <= r['tolerance'])} | "
              f"{count(lambda r: r['error'] <= r['bound'])} | {count(lambda r: r['vouched'] == 0)} | "
              f"{statistics.median(saved):.1f} | {min(saved):.1f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", type=pathlib.Path)
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build/release/app/polargrain")
    parser.add_argument("--half", choices=["even", "odd", "all"], default="all")
    parser.add_argument("--scenes", help="numbers, 0,2,4 (default: all of the half)")
    parser.add_argument("--tolerances", default="1,3,10")
    parser.add_argument("--seconds", type=float, default=600, help="a run may take")
    parser.add_argument("--report", action="store_true", help="run nothing")
    options = parser.parse_args()
    tolerances = [int(t) for t in options.tolerances.split(",")]
    numbers = [n for n in range(COUNT) if options.half == "all" or n % 2 == (options.half == "odd")]
    if options.scenes:
        numbers = [int(n) for n in options.scenes.split(",")]
    scenes = [Scene(n) for n in numbers]
    results = options.results.resolve()
    if not options.report:
        program = options.program.resolve()
        if not program.exists():
            sys.exit(f"error: there is no program {program}: build it, or name it with --program")
        (results / "packings").mkdir(parents=True, exist_ok=True)
        os.environ.setdefault("POLARGRAIN_DATA", str(ROOT))
        fingerprint = hashlib.sha256(program.read_bytes()).hexdigest()
        for scene in scenes:
            make(scene, results, program, tolerances, options.seconds, fingerprint)
    report(scenes, results, tolerances)


if __name__ == "__main__":
    main()
