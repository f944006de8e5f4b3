#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Study 1 in one command: biaxial compression of specimens made of grains, and of the same sand at two scales.

    python3 biaxial.py                               the reduced size: some seconds, of everything a little
    python3 biaxial.py --size page                   what docs/studies/biaxial.md shows: some fifteen minutes of one core
    python3 biaxial.py --size full                   30 specimens of 800 grains, 10 of 5,000, 3 of 20,000; finer meshes: a day
    python3 biaxial.py --size full --list            what that is
    python3 biaxial.py --only 'grains-800-*,informed-8x16-*'
    python3 biaxial.py --size full --jobs 4 -w 4     four runs at once, each two-scale run on four workers
    python3 biaxial.py --size full --report          only tables and figures, of what there is

The same command goes on where it was broken off (Ctrl-C, a time limit, a crash): runs that are complete are not made again, others go on from their last
checkpoint or frame, with the same bytes. A run that fails does not stop the others; it is named at the end with its log.

Into RESULTS, for every run: NAME/ or NAME.csv, NAME.log, NAME.samples.csv (the increment that its band is looked for in). At the
end: table.csv (a row a run), table.md (means with their 95 % intervals) and, with matplotlib, curves.png and fields.png.

Names. grains-NUMBER-seedS: a specimen; element-NUMBER-seedS: a periodic cell under the same test, of the packing that the specimen
of half the grains is cut from; SCHEME-ELEMENTS-pairK: two scales, cells of 400 grains from the packings of the seeds 2 K - 1 and 2 K, the
weaker one in the corner; rough-ELEMENTS-cellsNUMBER-seedS: between rough plates, rotations controlled, a cell a point (rough_plates.yaml), also with
grains twice as large or mirrored ones; law-...: the law in closed form, for objectivity.
"""
import argparse
import concurrent.futures
import dataclasses
import fnmatch
import os
import pathlib
import shutil
import signal
import sys
import threading
import time

import numpy

import biaxial_report
from built_package import polargrain
from runs import ROOT, Failed, Programs

HERE = pathlib.Path(__file__).resolve().parent
SCRIPT = "cells/hooke_li_chu_force.in"
RATE = 0.06  # 1/s, of the specimens: inertial number 1.0e-4
QUICK = 0.24  # 3.9e-4
SLOW = 1e-4  # inertial number of the cells in an element test
LENGTH = 3.5  # mm; what a sheared layer asks for (docs/studies/internal_length.md)
SPREAD = 50.0  # mm; of the same layers, five diameters
PLASTIC_LENGTH = 7.2  # mm; what layers ask for where the couple stress has a limit, with an elastic one of 1 to 10 mm


@dataclasses.dataclass(frozen=True)
class Run:
    name: str
    kind: str            # grains, element, two_scale, rough, law
    group: str           # runs of one group are realisations of one thing
    seed: int = 0        # of the packing; of two scales the number of the pair
    grains: int = 0      # of the specimen, of the cell
    rate: float = RATE   # 1/s, of a specimen
    inertial: float = SLOW
    leaning: bool = False
    case: str = ""
    scheme: str = ""
    across: int = 0      # elements
    width: float = 0.2   # m, of a specimen at two scales; the height is twice that
    lc: float = LENGTH   # mm
    large: bool = False  # deformation: equilibrium on the moved mesh
    spread: float = 0.0  # of slips, mm; in place of micro-rotations
    mirrored: bool = False
    doubled: bool = False  # packings, their grains with them, twice as large
    settings: tuple = ()  # of all its materials, or of a case in closed form


def specimens(grains, seeds, rate=RATE):
    group = f"grains-{grains}" + (f"-rate{rate:g}" if rate != RATE else "")
    return [Run(f"grains-{grains}-seed{seed}" + group[len(f"grains-{grains}"):], "grains", group, seed, grains, rate) for seed in seeds]


def elements(grains, seeds, inertial=SLOW, leaning=False):
    """Sides stay upright, or lean as they like: no shear stress."""
    ending = (f"-inertial{inertial:g}" if inertial != SLOW else "") + ("-leaning" if leaning else "")
    return [Run(f"element-{grains}-seed{seed}{ending}", "element", f"element-{grains}{ending}", seed, grains, inertial=inertial,
                leaning=leaning) for seed in seeds]


def two_scale(scheme, across, pairs, grains=400, lc=LENGTH, mirrored=False, large=False, spread=0.0, width=0.2, words="", settings=()):
    """Smooth platens; the corner is 50 mm wide where elements are as small, else one element."""
    group = (f"{scheme}-{across}x{2 * across}" + (f"-cells{grains}" if grains != 400 else "") + (f"-lc{lc:g}" if lc != LENGTH else "") +
             ("-mirrored" if mirrored else "") + ("-large" if large else "") + (f"-spread{spread:g}" if spread else "") + (f"-width{width:g}" if width != 0.2 else "") + (f"-{words}" if words else ""))
    return [Run(f"{group}-pair{pair}", "two_scale", group, pair, grains, scheme=scheme, across=across, lc=lc, mirrored=mirrored, large=large, spread=spread, width=width,
                case="biaxial_cell.yaml" if scheme in ("cell", "controlled") else "biaxial_informed.yaml", settings=tuple(settings))
            for pair in pairs]


def rough(across, seeds, grains=100, mirrored=False, doubled=False):
    """Between rough plates, one packing of hooke_li_chu.in, its grains' own couple stress."""
    group = f"rough-{across}x{2 * across}-cells{grains}" + ("-mirrored" if mirrored else "") + ("-doubled" if doubled else "")
    return [Run(f"{group}-seed{seed}", "rough", group, seed, grains, across=across, mirrored=mirrored, doubled=doubled, case="rough_plates.yaml")
            for seed in seeds]


def closed_form():
    return [Run(f"law-{across}x{2 * across}-{words}", "law", f"law-{across}x{2 * across}-{words}", case="biaxial_elastoplastic.yaml",
                settings=(f"mesh.rectangle.elements=[{across}, {2 * across}]", *settings))
            for across in (8, 12, 16) for words, settings in (
                ("lc3", ("materials.sand.lc=3 mm", "materials.weak_sand.lc=3 mm")), ("lc1", ()), ("cauchy", ("continuum=cauchy",)))]


SWEEP = {"drift0": ("informed: {drift_shear: 0}",), "drift0.003": ("informed: {drift_shear: 0.003}",), "drift0.03": ("informed: {drift_shear: 0.03}",),
         "unbalanced1e-3": ("unbalanced_force_ratio: 1e-3", "unbalanced_moment_ratio: 1e-3"), "inertial1e-4": ("inertial_number: 1e-4",)}


def sweep(pairs):
    """On 2 x 4 elements, which have no band: what the settings of the scheme do to the softening branch."""
    plain = two_scale("informed", 2, pairs) + two_scale("fixed_point", 2, pairs) + two_scale("cell", 2, pairs)
    return plain + [run for words, settings in SWEEP.items() for run in two_scale("informed", 2, pairs, words=words, settings=settings)]


def to(last):
    return range(1, last + 1)


RUNS = {  # by size; in one list the cheapest and most decisive first
    "reduced": [*specimens(50, to(2)), *specimens(100, to(2)), *elements(100, to(2)), *elements(200, to(2)),
                *two_scale("informed", 2, to(2), grains=100)],
    "page": [*elements(100, to(10)), *elements(400, to(10)), *elements(400, to(10), leaning=True), *elements(1600, to(10)),
             *specimens(800, to(10), QUICK), *specimens(200, to(10), QUICK), *specimens(800, to(4)), *two_scale("informed", 4, to(5))],
    "full": [*elements(100, to(30)), *elements(400, to(30)), *elements(400, to(10), 6e-4), *elements(400, to(10), 3e-5),
             *elements(1600, to(30)), *elements(6400, to(3)), *specimens(200, to(30)), *specimens(800, to(30)),
             *specimens(800, to(3), 0.02), *specimens(1600, to(10)), *closed_form(),
             *(run for scheme in ("informed", "fixed_point", "cell") for run in two_scale(scheme, 4, to(10))), *sweep(to(10)),
             *(run for scheme in ("informed", "fixed_point", "cell", "controlled") for run in two_scale(scheme, 8, to(10))),
             *two_scale("informed", 8, to(10), mirrored=True),
             *(run for across in (4, 8, 16) for run in two_scale("informed", across, to(10), large=True)), *two_scale("controlled", 8, to(10), large=True),
             *(run for lc in (5, 10) for run in two_scale("informed", 8, to(10), lc=lc)),
             *(run for lc in (5, 7, 10) for across in (8, 12, 16) for run in two_scale("informed", across, to(10), lc=lc, large=True)),
             *(run for lc in (PLASTIC_LENGTH, 3.2) for across in (8, 12, 16) for run in two_scale(
                 "informed", across, to(10), lc=lc, large=True, words=f"lp{PLASTIC_LENGTH}", settings=(f"lp: {PLASTIC_LENGTH} mm",))),
             *(run for across in (2, 4, 8) for run in rough(across, to(10))), *rough(4, to(10), mirrored=True), *rough(4, to(10), doubled=True),
             *rough(4, to(5), grains=400),
             *(run for scheme in ("informed", "fixed_point", "cell", "controlled") for run in two_scale(scheme, 16, to(10))),
             *(run for scheme, across in (("informed", 8), ("informed", 16), ("cell", 8)) for large in (False, True)
               for run in two_scale(scheme, across, to(10), large=large, spread=SPREAD)),
             *(run for large in (False, True) for run in two_scale("informed", 20, to(10), large=large, spread=SPREAD, width=0.5)),
             *specimens(5000, to(10)), *elements(10000, to(3)), *specimens(20000, to(3))]}
KNOWN = {run.name: run for runs in RUNS.values() for run in runs}


def runs_of(size):
    return list({run.name: run for run in (RUNS["page"] if size == "full" else []) + RUNS[size]}.values())


def read_options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=pathlib.Path, default=pathlib.Path("results/biaxial_study"),
                        metavar="RESULTS", help="[results/biaxial_study]")
    parser.add_argument("--size", choices=tuple(RUNS), default="reduced", help="[reduced]")
    parser.add_argument("--only", metavar="NAME,...", help="these runs of any size, in this order; * stands for anything")
    parser.add_argument("--list", action="store_true", help="name the runs and end")
    parser.add_argument("--report", action="store_true", help="run nothing: tables and figures of what there is")
    parser.add_argument("-w", "--workers", type=int, default=2, help="of each two-scale run [2]")
    parser.add_argument("--jobs", type=int, help="runs at once [cores / workers]")
    parser.add_argument("--strain", type=float, help="axial strain at the end, in steps of 0.1 %% [0.08; the reduced size 0.01]")
    parser.add_argument("--programs", type=pathlib.Path, nargs="+", metavar="FOLDER",
                        help="where polargrain and polargrain-liggghts are [build/release/app]")
    options = parser.parse_args()
    options.jobs = options.jobs or max(1, (os.cpu_count() or 1) // max(1, options.workers))
    options.strain = options.strain or (0.01 if options.size == "reduced" and not options.only else 0.08)
    return options


def stop(message):
    sys.exit(f"biaxial.py: {message}")


def chosen(options):
    if not options.only:
        return runs_of(options.size)
    names = []
    for pattern in options.only.split(","):
        found = fnmatch.filter(KNOWN, pattern)
        if not found:
            stop(f"no run is called {pattern}; --size full --list names them")
        names += found
    return [KNOWN[name] for name in dict.fromkeys(names)]


def change(packing, file, mirrored, doubled):
    """Writes the mirror image (x1 to -x1) of a packing that was made without friction, or the same twice as large, thickness too, or both."""
    whole = polargrain.read_packing(packing)
    scale = 2.0 if doubled else 1.0
    side = -1.0 if mirrored else 1.0
    box = scale * whole.box * [[1.0, side], [side, 1.0]]  # of a mirror image the second base vector leans the other way
    share = numpy.linalg.solve(box, (scale * whole.positions * [side, 1.0]).T)
    positions = (box @ (share - numpy.floor(share))).T
    (xx, xy), (yx, yy) = box.tolist()
    lines = [f"# cell xx={xx!r} xy={xy!r} yx={yx!r} yy={yy!r} z={scale * whole.thickness!r} p={whole.pressure!r}",
             "id,x,y,r,mass,Izz"]
    lines += [f"{number},{float(x)!r},{float(y)!r},{float(radius)!r},{float(mass)!r},{float(0.5 * mass * radius ** 2)!r}"
              for number, ((x, y), radius, mass) in enumerate(zip(positions, scale * whole.radii, scale ** 3 * whole.masses))]
    file.write_text("\n".join(lines) + "\n", encoding="utf-8")


class Study:
    """Carries runs out, each in folders and logs of its own, with paths relative to RESULTS: RESULTS can be moved."""

    def __init__(self, options):
        self.options = options
        self.output = options.output
        self.programs = Programs(options.programs)
        self.polargrain = self.programs.find("polargrain")
        os.environ["POLARGRAIN_PROGRAM"] = str(self.polargrain)  # of the Python package
        self.locks = {}
        self.new_lock = threading.Lock()

    def lock(self, name):
        """Files that two runs need are made by the first that comes."""
        with self.new_lock:
            return self.locks.setdefault(name, threading.Lock())

    def call(self, run, *command):
        self.programs.call(self.output / f"{run.name}.log", *command, folder=self.output)

    def packing(self, run, grains, seed, mirrored=False, doubled=False):
        """Made without friction. Large ones count as at rest sooner: what is left of their motion goes in the seating."""
        unbalanced = 1e-2 if grains > 5000 else 1e-3
        file = f"packings/{grains}-seed{seed}.h5"
        image = f"packings/{grains}-seed{seed}{'-mirrored' if mirrored else ''}{'-doubled' if doubled else ''}.csv"
        with self.lock(file):
            if not (self.output / file).exists():
                part = f"packings/part-{grains}-seed{seed}.h5"
                self.call(run, self.polargrain, "pack", ROOT / "cases/packings/dense400.yaml", "-o", part, "--quiet", "--set", f"grains={grains}",
                          "--set", f"seed={seed}", "--set", f"unbalanced_force_ratio={unbalanced:g}")
                (self.output / part).replace(self.output / file)
            if not (mirrored or doubled):
                return file
            if not (self.output / image).exists():
                change(self.output / file, self.output / image, mirrored, doubled)
        return image

    def compute(self, run):
        getattr(self, run.kind)(run)

    def grains(self, run):
        self.call(run, sys.executable, ROOT / "liggghts_inputs/specimen/specimen.py", "-o", run.name, "--grains", run.grains, "--seed",
                  run.seed, "--packing", self.packing(run, 2 * run.grains, run.seed), "--strain", self.options.strain, "--rate", run.rate,
                  "--programs", *self.programs.folders)

    def element(self, run):
        strain = self.options.strain
        with self.lock(run.name):
            if not (self.output / f"{run.name}.csv").exists():
                shear = "s12: 0 kPa" if run.leaning else "e12: hold"
                self.call(run, self.polargrain, "element", "--pressure", "100kPa", self.packing(run, run.grains, run.seed),
                          ROOT / "liggghts_inputs" / SCRIPT, "-o", run.name, "-w", 1, "--quiet", "--set", f"inertial_number={run.inertial:g}",
                          "--set", f"stages=[{{e22: {-100 * strain:g} %, s11: hold, {shear}, rows: {max(1, round(2000 * strain))}}}]")

    def weaker_last(self, run):
        """The seeds of a pair, that of the lower peak last."""
        peaks = {}
        for seed in (2 * run.seed - 1, 2 * run.seed):
            of_seed = elements(run.grains, [seed])[0]
            self.element(of_seed)
            peaks[seed] = biaxial_report.curve(self.output, of_seed)["stress_ratio"].max()
        return sorted(peaks, key=peaks.get, reverse=True)

    def two_scale(self, run):
        width, height = run.width, 2 * run.width
        patch = f"{max(0.05, width / run.across):.6g} m"
        settings = [f"mesh.rectangle.elements=[{run.across}, {2 * run.across}]", f"mesh.rectangle.patch=[{patch}, {patch}]"]
        if width != 0.2:
            settings += [f"mesh.rectangle.size=[{width:g} m, {height:g} m]", f"monitors.axial_strain=-shortening / {height:g} m",
                         f"monitors.stress_ratio=-top_force / ({width:g} m * 100 kPa)"]
        if run.large:
            settings.append("deformation=large")
        words = {"controlled": ["model: cell", "rotations: controlled"], "fixed_point": ["model: informed", "informed: {update: fixed_point}"]}.get(
            run.scheme, [f"model: {run.scheme}"])
        if run.spread:
            settings.append(f"continuum={{kind: cauchy, spread: {run.spread:g} mm}}")
        elif run.scheme != "controlled":
            words.append(f"lc: {run.lc:g} mm")
        for sand, seed in zip(("sand", "weak_sand"), self.weaker_last(run)):
            keys = [*words, f"script: {SCRIPT}", f"packing: {self.packing(run, run.grains, seed, run.mirrored)}",
                    "most_relaxation_steps: 100000", *run.settings]
            settings.append(f"materials.{sand}={{{', '.join(keys)}}}")
        self.finite_elements(run, settings + self.steps(2, height, 1000))

    def rough(self, run):
        keys = "model: cell, rotations: controlled, script: cells/hooke_li_chu.in, most_relaxation_steps: 100000"
        self.finite_elements(run, [f"mesh.rectangle.elements=[{run.across}, {2 * run.across}]",
                                   f"materials.sand={{{keys}, packing: {self.packing(run, run.grains, run.seed, run.mirrored, run.doubled)}}}",
                                   *self.steps(1, 0.8, 3000)])

    def law(self, run):
        self.finite_elements(run, run.settings)

    def steps(self, place, height, count):
        """@param place of the moving platen among the boundaries @param count of steps for a strain of 1"""
        return [f"boundary.{place}.move.u2={-1000 * self.options.strain * height:.10g} mm", f"steps.count={max(1, round(count * self.options.strain))}"]

    def finite_elements(self, run, settings):
        go_on = ["--resume"] if (self.output / run.name / "checkpoint.h5").exists() else []
        shutil.copy(HERE / run.case, self.output)  # packings are looked for beside the case
        self.call(run, self.polargrain, "run", run.case, "-o", run.name, "-w", self.options.workers, "--checkpoint-minutes", 2,
                  *go_on, *(word for setting in settings for word in ("--set", setting)))

    def carry_out(self, run):
        """@returns what went wrong, or nothing"""
        if self.programs.stopped:
            return None
        begin = time.monotonic()
        print(f"{run.name} ...", flush=True)
        trouble = None
        try:
            self.compute(run)
        except Failed as failure:
            trouble = str(failure)
        if self.programs.stopped:
            return None
        print(f"{run.name}: {'FAILED' if trouble else 'done'} after {time.monotonic() - begin:.0f} s", flush=True)
        return trouble

    def look_for_band(self, run):
        """In the second half of the run: 4 to 8 %."""
        if run.kind == "element":
            return None
        found, history = (self.output / run.name / name for name in ("band.json", "history.csv"))
        if found.exists() and found.stat().st_mtime >= history.stat().st_mtime:
            return None
        last = biaxial_report.curve(self.output, run)["axial_strain"][-1]
        try:
            self.call(run, self.polargrain, "band", run.name, "--from", last / 2, "--to", last, "--fields", f"{run.name}.samples.csv")
        except Failed as failure:
            return str(failure)
        return None


def main():
    options = read_options()
    runs = chosen(options)
    if options.list:
        print("\n".join(run.name for run in runs))
        return
    (options.output / "packings").mkdir(parents=True, exist_ok=True)
    study = Study(options)
    failures = {}
    if not options.report:
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            signal.signal(number, study.programs.stop)
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            failures = {run.name: trouble for run, trouble in zip(runs, pool.map(study.carry_out, runs)) if trouble}
        if study.programs.stopped:
            print("biaxial.py: stopped; the same command goes on", file=sys.stderr)
            sys.exit(3)
    there = [run for run in runs if biaxial_report.curve(options.output, run) is not None]
    for run in there:
        trouble = study.look_for_band(run)
        if trouble:
            failures.setdefault(run.name, trouble)
    biaxial_report.write(there, options.output)
    if failures:
        stop(f"{len(failures)} of {len(runs)} runs failed; the tables hold what there is of them\n" +
             "\n".join(f"  {name}: {trouble}" for name, trouble in failures.items()))


if __name__ == "__main__":
    main()
