#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes docs/performance.md from the kept figures of docs/data/performance, and measures some of them again.

usage: docs/make_performance.py                             the page, from the kept figures
       docs/make_performance.py POLARGRAIN [DIRECTORY]      from the root of the project; some five minutes of one core

Each file of docs/data/performance names its command and machine in its first two lines; what the command printed stands
below. With POLARGRAIN the runs behind the tables on Newton's method, acceleration and adaptivity are made again, one after
another on one worker, each into a folder of DIRECTORY. Runs that are done there already are not made again. Their figures
do not depend on how busy the machine is. To keep the figures of another bench, put its output in the place of the old one.
"""
import csv
import json
import os
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
KEPT = os.path.join(ROOT, "docs/data/performance")
SELF = "docs/make_performance.py build/release/app/polargrain"

DEMO = "cases/biaxial/case.yaml"
FOOTING = "cases/footing_cells/case.yaml"
EIGHT_ELEMENTS = ["mesh.rectangle.elements=[2,4]"]
VOIGT = ["materials.sand.tangent=voigt"]
CONDENSED = ["materials.sand.tangent=condensed"]
SMALL_STEPS = ["steps.count=46", "steps.iterations=40"]
ACCELERATED = ["steps.acceleration=5"]


def kept(name):
    """@returns command, machine, and what the command printed"""
    with open(os.path.join(KEPT, name), encoding="utf-8") as text:
        lines = text.read().splitlines()
    return lines[0].removeprefix("# command: "), lines[1].removeprefix("# machine: "), lines[2:]


def speed_words():
    """Conclusions from the table of speed against error, with its figures."""
    head, *rows = csv.reader(kept("bench_quick.csv")[2])
    runs = {(row[0], row[1].split(",")[0]): row for row in rows}

    def figure(what, setting, column="error of stress_ratio"):
        return float(runs[what, setting][head.index(column)].removesuffix(" %"))

    scatter = [f"{figure('standard deviation', f'{grains} grains'):.0f} %" for grains in (400, 800, 100)]
    given = figure("as given", "", "DEM steps")
    return f"""- **Scatter comes first**: three packings of 400 discs have a standard deviation of {scatter[0]} of the range, of 800 discs {scatter[1]}, of 100 discs {scatter[2]}.
- The case as given is {figure("as given", ""):.1f} % off its reference at worst and {figure("as given", "", "error of the peak"):.1f} % at its peak, with {figure("reference", "unbalanced ratio 1e-3", "DEM steps") / given:.1f} times fewer DEM steps."""


def keep(name, command, machine, rows):
    with open(os.path.join(KEPT, name), "w", encoding="utf-8", newline="") as text:
        text.write(f"# command: {command}\n# machine: {machine}\n")
        csv.writer(text, lineterminator="\n").writerows(rows)


def run(name, case, settings):
    """@returns the rows of history.csv behind the start, as numbers; summary.json"""
    results = os.path.join(PLACE, name)
    summary_file = os.path.join(results, "summary.json")
    if not os.path.exists(summary_file):
        command = [PROGRAM, "run", case, "-o", results, "-w", "1", "--quiet"]
        for setting in settings:
            command += ["--set", setting]
        subprocess.run(command, cwd=ROOT, stderr=subprocess.DEVNULL)
    with open(summary_file, encoding="utf-8") as text:
        summary = json.load(text)
    if summary["status"] != "done":
        print(f"{name}: {summary['message']}", file=sys.stderr)
    with open(os.path.join(results, "history.csv"), encoding="utf-8") as text:
        rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(text)]
    return rows[1:], summary


def acceleration():
    table = [["tangent", "steps", "iterations a step, mean and most", "cuts", "with acceleration", "cuts"]]
    for tangent, settings in (("voigt", VOIGT + SMALL_STEPS), ("condensed", CONDENSED)):
        cells = []
        for words, more in (("plain", []), ("accelerated", ACCELERATED)):
            rows, _ = run(f"{words}_{tangent}", DEMO, EIGHT_ELEMENTS + settings + more)
            iterations = [row["iterations"] for row in rows]
            cells += [f"{sum(iterations) / len(iterations):.1f}, {max(iterations):.0f}", f"{sum(row['cuts'] for row in rows):.0f}"]
        table.append([f"`{tangent}`", len(rows), *cells])
    keep("acceleration.csv", SELF, "any", table)


def adaptivity(case, material, curve, tolerances):
    name = os.path.basename(os.path.dirname(case))
    rows, full = run(f"{name}_0", case, [f"materials.{material}.model=adaptive", f"materials.{material}.adaptive.tolerance=0",
                                         f"materials.{material}.adaptive.audit=0"])
    reference = [row[curve] for row in rows]
    table = [["`tolerance`", "error of the curve", "times fewer DEM steps", "cells", "cell runs", "iterations",
              "audits: mean error / bound", "worked with"]]
    for tolerance in tolerances:
        rows, summary = run(f"{name}_{tolerance}", case, [f"materials.{material}.model=adaptive",
                                                         f"materials.{material}.adaptive.tolerance={tolerance} %"])
        errors = [abs(row[curve] - expected) for row, expected in zip(rows, reference)]
        relative = max(error / abs(expected) for error, expected in zip(errors, reference))
        figures = next(iter(summary["materials"].values()))
        largest = max(map(abs, reference))
        table.append([f"{tolerance} %",
                      f"{max(errors) / largest:.2%} ({relative:.2%}), mean {sum(errors) / len(errors) / largest:.2%}",
                      f"{full['cells']['dem_steps'] / summary['cells']['dem_steps']:.1f}", f"{figures['cells']:.0f}",
                      f"{figures['cell_runs']:.0f}", summary["iterations"],
                      f"{figures['history_error_mean']:.4f} / {figures['error_bound']:.4f}",
                      f"{figures['tolerance_worked_with']:.2%}"])
    keep(f"adaptive_{name}.csv", SELF, "any", table)


# Sections of the page: heading, words, file, columns (all if empty). Beginnings of the lines of a text
# file that are shown, or of the rows of a table that are left out.
SECTIONS = [
    ("A cell", """By default a cell of 400 discs costs 1.1 ms with its tangent, at an error of 1.1 +- 0.4 %. Eight packings, ten increments of
isochoric strain 1e-3. The error is the largest relative difference of a normal stress from a slow run (inertial number 1e-4, tolerance 1e-4), over 3
and over 10 increments. "reference" is that run at half its care; "yardstick" is LIGGGHTS's own loop at a tenth of the stable time step.""",
     "cell_bench.txt", [],
     ["            inertial", " reference", " yardstick", "   default", "             1.2e-03     0.12      2e-02", "             2.0e-04     0.12      5e-03"]),
    ("", """- At the default rate peaks are 1.6 +- 1.1 % too high.
- Answers from one state scatter by 3e-5 to 5e-5 of the pressure. The estimate of noise is 2.5e-4.

Nanoseconds a grain and step, over a bare loop of the same physics:""", "step_bench.txt", [],
     ["  ", "bare loop", "discs: hooke/radii history ", "discs: hooke/radii li_chu", "discs: full: ", "engine: full: ", "liggghts: hooke/stiffness history  ", "lammps: hooke/stiffness history  "]),
    ("", "The condensed tangent, milliseconds.", "tangent_bench.csv", [], ["by fronts, SSE2", "UMFPACK", "plain twin"]),
    ("A cell of spheres", """1,000 spheres of `cases/spheres`, five increments of 1e-3 of triaxial compression at constant volume, one packing. "+tangent" is the
additional time of the condensed tangent. "off" is the deviator against a slow run.""", "sphere_bench.txt", [],
     ["contacts", "hooke/radii, history", "and torsion"]),
    ("", """**Why not faster** (`perf record` of `sphere_bench`, `cell_bench`): a tangent is two thirds of an evaluation at inertial number 1e-3. Elimination in
single precision is 58 % of it. Of a disc's step lists and motion are 30 %.

A sphere and step. The divider takes a quarter of the AVX-512 pass: eight lanes take twice as long as four.""", "sphere_step_bench.txt", [], ["hooke", "  ", "clean", "AVX", "lammps"]),
    ("Packings", """Processor seconds to rest under 100 kPa, radii 3 to 7 mm. Both loops make the same void ratio: ten packings of 300 spheres differ by
-0.007 +- 0.013 with friction 0.5, 0.004 +- 0.006 without.""", "pack_bench.csv",
     ["packing", "grains", "seconds", "DEM steps"], ["discs"]),
    ("A coupled run", """`cases/biaxial` (200 cells, 23 steps, 19,244 evaluations) takes 16 s of processor time on that EPYC, 36 s with `condensed`, `./bootstrap demo` 46 s. `spheres_512` takes 17 minutes with `informed`, 14 with `cell` in explicit steps.

Fewer tangents: `tangent: secant` ([when](howto/method.md#which-tangent)) beside `condensed`, the same packings with one worker; means with 95 % intervals.""", "tangents.csv", [], []),
    ("The coordinator", """10,000 cells with states of 55 kB and simulated workers that answer at once. "Own" is processor time of the coordinator. It saturates where that is
all of an evaluation of 2.9 ms.""", "coupler_scale.csv", ["workers", "other load", "own, us an evaluation", "saturates at"], ["8"]),
    ("Adaptivity", """`model: adaptive` ([explanation](adaptivity.md)) against a cell at every point. Error of the load curve as a share of its largest value; largest relative error
of a step in brackets. `cases/footing_cells` (560 points; full run: 11,243 evaluations):""", "adaptive_footing_cells.csv",
     ["`tolerance`", "error of the curve", "times fewer DEM steps", "audits: mean error / bound"], ["30 %", "0.3 %"]),
    ("", """`cases/biaxial` (200 points; full run: 28,844 evaluations). The bound exceeds the tolerance behind the peak, and the runs say so:""",
     "adaptive_biaxial.csv", ["`tolerance`", "error of the curve", "times fewer DEM steps", "audits: mean error / bound"], []),
    ("Speed against error", """`cases/biaxial` on 2 x 4 elements (32 points, 400 discs, 23 steps to 2.3 %). Errors are the largest difference from the reference over its range. Packings
are compared with the mean of the three largest packings ([all rows](data/performance/bench_quick.csv)).""", "bench_quick.csv",
     ["what", "setting", "DEM steps", "error of stress_ratio", "error of the peak"], ["cell size", "mean", "standard deviation", "equilibrium", "step size", "adaptivity"]),
    ("", speed_words(), "", [], []),
    ("Finite elements", """Elastoplastic block between rough plates in full plastic flow, seconds a Newton iteration. The solution grows like n^1.23.""", "fem_bench.csv",
     ["unknowns", "assembly, s", "factorisation and solution, s", "peak, MiB"], ["1,011", "4,323", "20,199"]),
]


def table(lines, columns, left_out):
    head, *rows = csv.reader(lines)
    rows = [row for row in rows if not row[0].startswith(tuple(left_out))]
    chosen = [head.index(column) for column in columns] or range(len(head))
    return ["| " + " | ".join(row[place] for place in chosen) + " |" if row else "|" + "---|" * len(chosen) for row in [head, [], *rows]]


def page():
    """@returns the text of docs/performance.md"""
    lines = ["# Performance", "",
             "*What does a computation cost, and what accuracy does it buy? For users who plan runs.*", "",
             "`docs/make_performance.py` writes this page from the outputs of the commands below, kept in [data/performance](data/performance).",
             "Times differ by some ten per cent between machines; ratios within a table do not. Contact models in the stock loop:",
             "[contact_loop.csv](data/performance/contact_loop.csv).", ""]
    for heading, words, name, columns, shown in SECTIONS:
        lines += [f"## {heading}", ""] if heading else []
        lines += [words, ""]
        if not name:
            continue
        command, machine, printed = kept(name)
        lines += [f"`{command}`" + ("" if machine == "any" else f" ({machine}):"), ""]
        if name.endswith(".csv"):
            lines += table(printed, columns, shown)
        else:
            lines += ["```", *[line for line in printed if line.startswith(tuple(shown)) and line.strip()], "```"]
        lines.append("")
    return "\n".join(lines)


if __name__ == "__main__":
    if len(sys.argv) > 1:
        PROGRAM = os.path.abspath(sys.argv[1])
        PLACE = os.path.abspath(sys.argv[2] if len(sys.argv) > 2 else "performance")
        os.makedirs(PLACE, exist_ok=True)
        acceleration()
        adaptivity(FOOTING, "soil", "pressure", [30, 5, 3, 1, 0.3])
        adaptivity(DEMO, "sand", "stress_ratio", [4, 2])
    with open(os.path.join(ROOT, "docs/performance.md"), "w", encoding="utf-8") as text:
        text.write(page())
