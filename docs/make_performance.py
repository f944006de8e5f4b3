#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Makes the runs behind the tables of docs/performance.md on Newton's method and on adaptivity, and prints the tables.

usage: docs/make_performance.py POLARGRAIN [DIRECTORY]      from the root of the project; some five minutes of one core

One run after another on one worker, each into a folder of DIRECTORY. What is done there already is not made again.
Nothing in the tables depends on how busy the machine is.
"""
import csv
import json
import os
import subprocess
import sys

PROGRAM = os.path.abspath(sys.argv[1])
PLACE = os.path.abspath(sys.argv[2] if len(sys.argv) > 2 else "performance")
ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))

DEMO = "cases/biaxial/case.yaml"
FOOTING = "cases/footing_cells/case.yaml"
TWO_ELEMENTS = ["mesh.rectangle.elements=[1,2]", "boundary.1.move.u2=-32e-3", "steps.count=40", "steps.iterations=40"]
EIGHT_ELEMENTS = ["mesh.rectangle.elements=[2,4]"]
VOIGT = ["materials.sand.tangent=voigt"]
SMALL_STEPS = ["steps.count=46", "steps.iterations=40"]
ACCELERATED = ["steps.acceleration=5"]


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


def newton():
    print("| tangent | to 0.5 % | 1 % | 1.5 % | 2 % | 2.5 % | 3 % | 3.5 % | 4 % | cuts | cells run to 3 % |")
    print("|---|---|---|---|---|---|---|---|---|---|---|")
    for tangent, settings in (("condensed", []), ("voigt", VOIGT)):
        rows, _ = run(f"newton_{tangent}", DEMO, TWO_ELEMENTS + settings)
        cells = []
        for begin in range(0, 40, 5):
            iterations = [row["iterations"] for row in rows[begin:begin + 5]]
            cells.append(f"{sum(iterations) / len(iterations):.1f} ({max(iterations):.0f})" if iterations else "stopped")
        print(f"| `{tangent}` | {' | '.join(cells)} | {sum(row['cuts'] for row in rows):.0f} "
              f"| {sum(row['evaluations'] for row in rows[:30]):.0f} |")


def acceleration():
    print("| tangent | steps | iterations a step, mean and most | cuts | with acceleration | cuts |")
    print("|---|---|---|---|---|---|")
    for tangent, settings in (("voigt", VOIGT + SMALL_STEPS), ("condensed", [])):
        cells = []
        for words, more in (("plain", []), ("accelerated", ACCELERATED)):
            rows, _ = run(f"{words}_{tangent}", DEMO, EIGHT_ELEMENTS + settings + more)
            iterations = [row["iterations"] for row in rows]
            cells.append(f"{sum(iterations) / len(iterations):.1f}, {max(iterations):.0f} "
                         f"| {sum(row['cuts'] for row in rows):.0f}")
        print(f"| `{tangent}` | {len(rows)} | {' | '.join(cells)} |")


def adaptivity(case, material, curve, tolerances):
    name = os.path.basename(os.path.dirname(case))
    rows, full = run(f"{name}_0", case, [f"materials.{material}.model=adaptive", f"materials.{material}.tolerance=0",
                                         f"materials.{material}.audit=0"])
    reference = [row[curve] for row in rows]
    print(f"{case}, a cell at every point: {full['iterations']} iterations, {full['cells']['evaluations']} evaluations, "
          f"{full['cells']['dem_steps'] / 1e6:.2f} million DEM steps\n")
    print("| `tolerance` | error of the curve | times fewer DEM steps | cells | cell runs | iterations "
          "| audits: mean error / bound | worked with |")
    print("|---|---|---|---|---|---|---|---|")
    for tolerance in tolerances:
        rows, summary = run(f"{name}_{tolerance}", case, [f"materials.{material}.model=adaptive",
                                                         f"materials.{material}.tolerance={tolerance} %"])
        errors = [abs(row[curve] - expected) for row, expected in zip(rows, reference)]
        relative = max(error / abs(expected) for error, expected in zip(errors, reference))
        figures = next(iter(summary["materials"].values()))
        largest = max(map(abs, reference))
        print(f"| {tolerance} % | {max(errors) / largest:.2%} ({relative:.2%}), mean {sum(errors) / len(errors) / largest:.2%} "
              f"| {full['cells']['dem_steps'] / summary['cells']['dem_steps']:.1f} | {figures['cells']:.0f} "
              f"| {figures['cell_runs']:.0f} | {summary['iterations']} "
              f"| {figures['history_error_mean']:.4f} / {figures['error_bound']:.4f} "
              f"| {figures['tolerance_worked_with']:.2%} |")


os.makedirs(PLACE, exist_ok=True)
newton()
print()
acceleration()
print()
adaptivity(FOOTING, "soil", "pressure", [30, 5, 3, 1, 0.3])
print()
adaptivity(DEMO, "sand", "stress_ratio", [4, 2])
