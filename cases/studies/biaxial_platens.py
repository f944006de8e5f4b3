#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Is it the smooth platens that make specimens weaker than the cells they are cut from? The same specimens with rough ones.

    python3 biaxial_platens.py -o RESULTS [--seeds 10] [--grains 800] [--aspect 2] [--strain 0.06] [--programs FOLDER...]

Each specimen twice: smooth, and with the grains at its platens held sideways and kept from turning; and a periodic cell of the whole
packing that it is cut from under the same test. What is there already is not made again. Prints tables in Markdown: mean
and 95 % interval, and differences of the same packing.
"""
import argparse
import pathlib
import statistics
import sys

from built_package import polargrain
from dumps import read_grains
from intervals import table
from polargrain.table import read_table
from runs import ROOT, Failed, Programs

RATE = 0.24     # 1/s
CLOSE = 0.0006  # m, within which grains count as at a platen
CARRIERS = {2: 5, 4: 2}  # as many grains may lie deeper than the one that CLOSE counts from, by aspect


def at_platens(dump, aspect):
    """@returns numbers of the grains at the lower and at the upper platen"""
    grains = read_grains(dump)
    foot, head = grains[:, 2] - grains[:, 3], -grains[:, 2] - grains[:, 3]
    return [grains[ends < sorted(ends)[CARRIERS[aspect]] + CLOSE, 0].astype(int) for ends in (foot, head)]


def rough(bottom, top):
    """@returns commands that hold these grains sideways and keep them from turning"""
    return (f"group bottom id {' '.join(map(str, bottom))}\ngroup top id {' '.join(map(str, top))}\n"
            "group platens union bottom top\ngroup others subtract all platens\nvelocity platens set 0.0 NULL NULL\n"
            "unfix integrate\nfix integrate others nve/sphere\nfix integrate_platens platens nve\n"
            "fix roughness platens setforce 0.0 NULL NULL\n")


def figures(table, last):
    rows = [(abs(row["axial_strain"]), row["stress_ratio"]) for row in table.rows]
    at = lambda strain: min(rows, key=lambda row: abs(row[0] - strain))[1]
    strain, peak = max((row for row in rows if row[0] <= last), key=lambda row: row[1])
    return {"at 1 %": at(0.01), "at 2 %": at(0.02), "peak": peak, "at strain, %": 100 * strain}


def difference(some, others):
    return [{key: 100 * (one[key] / other[key] - 1) for key in ("at 1 %", "at 2 %", "peak")} for one, other in zip(some, others)]


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("-o", "--output", type=pathlib.Path, required=True)
    arguments.add_argument("--seeds", type=int, default=10)
    arguments.add_argument("--grains", type=int, default=800, help="of a specimen")
    arguments.add_argument("--aspect", type=int, choices=tuple(CARRIERS), default=2, help="height over width")
    arguments.add_argument("--strain", type=float, default=0.06)
    arguments.add_argument("--programs", type=pathlib.Path, nargs="+", metavar="FOLDER")
    arguments.add_argument("--check", action="store_true", help="fail when rough platens do not make specimens stronger, as the page says")
    options = arguments.parse_args()
    programs = Programs(options.programs)
    place = options.output.resolve()
    place.mkdir(parents=True, exist_ok=True)
    found = {"smooth platens": [], "rough platens": [], "cell": []}
    try:
        for seed in range(1, options.seeds + 1):
            log = place / f"{seed}.log"
            packing = place / f"packing-{seed}.h5"
            if not packing.exists():
                polargrain.pack(ROOT / "cases/packings/dense400.yaml", packing, {"grains": options.grains * options.aspect, "seed": seed})
            for kind in ("smooth", "rough"):
                platens = []
                if kind == "rough":
                    commands = place / f"rough-{seed}.in"
                    commands.write_text(rough(*at_platens(min((place / f"smooth-{seed}/grains").glob("step-*.dump")), options.aspect)))
                    platens = ["--platens", commands]
                programs.call(log, sys.executable, ROOT / "liggghts_inputs/specimen/specimen.py", "-o", place / f"{kind}-{seed}", "--grains",
                              options.grains, "--seed", seed, "--packing", packing, "--aspect", options.aspect, "--strain", options.strain,
                              "--rate", RATE, *platens, "--programs", *programs.folders)
                found[f"{kind} platens"].append(figures(read_table(place / f"{kind}-{seed}/history.csv"), options.strain))
            cell = place / f"cell-{seed}"
            if not cell.with_suffix(".csv").exists():
                programs.call(log, programs.find("polargrain"), "element", "--pressure", "100kPa", packing,
                              ROOT / "liggghts_inputs/cells/hooke_li_chu_force.in", "-o", cell, "-w", 1, "--quiet", "--set", "inertial_number=1e-4",
                              "--set", f"stages=[{{e22: {-100 * options.strain:g} %, s11: hold, e12: hold, rows: {round(2000 * options.strain)}}}]")
            found["cell"].append(figures(read_table(cell.with_suffix(".csv")), options.strain))
    except Failed as failure:
        sys.exit(str(failure))
    table("stress ratio", found, list(found["cell"][0]))
    pairs = (("smooth platens", "cell"), ("rough platens", "cell"), ("rough platens", "smooth platens"))
    if options.check and statistics.mean(one["at 2 %"] for one in difference(found["rough platens"], found["smooth platens"])) < 5.0:
        sys.exit("rough platens do not make specimens stronger at 2 %: not what the page says")
    table("difference, %", {f"{one} against {other}": difference(found[one], found[other]) for one, other in pairs}, ["at 1 %", "at 2 %", "peak"])


if __name__ == "__main__":
    main()
