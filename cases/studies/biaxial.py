#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Study 1 in one command: biaxial compression of specimens made of grains, and of the same sand at two scales.

    python3 biaxial.py                               the reduced size: 800 grains, 4 x 8 elements, some minutes
    python3 biaxial.py --size full                   all of it: finer meshes, three internal lengths, 5,000 grains
    python3 biaxial.py --size full --list            what that is, and what it costs
    python3 biaxial.py --only 'grains-800-*,informed-8x16-lc15'
    python3 biaxial.py --size full --jobs 4 -w 4     four runs at once, each two-scale run on four workers
    python3 biaxial.py --size full --report          only tables and figures, of what there is

The same command goes on where it was broken off (Ctrl-C, a time limit, a crash): runs that are complete are not made again, others go on from their last
checkpoint or frame, with the same bytes. A run that fails does not stop the others; it is named at the end with its log.

Into RESULTS, for every run: NAME/ (history.csv, fields or grains, band.json), NAME.log, NAME.samples.csv (the increment
that its band is looked for in). At the end: table.md, table.csv and, with matplotlib, curves-*.png and fields-*.png.

Names: grains-NUMBER-seedS, SCHEME-ELEMENTS-lcMILLIMETRES, law-ELEMENTS-... (the law in closed form, for objectivity);
-sliding: no rolling resistance; -wide: 0.5 m x 1 m instead of 0.2 m x 0.4 m; -cells100: cells of 100 grains, not 400.
"""
import argparse
import concurrent.futures
import dataclasses
import fnmatch
import os
import pathlib
import signal
import subprocess
import sys
import threading
import time

import biaxial_report

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]


@dataclasses.dataclass(frozen=True)
class Run:
    name: str
    size: str           # the smallest size of the study that it belongs to
    group: str          # runs of one group are compared with each other: same body, same contact law
    what: str           # for --list
    grains: int = 0     # a specimen made of grains
    seed: int = 0
    case: str = ""      # a run of polargrain
    settings: tuple = ()
    height: float = 0.4  # m

    @property
    def sliding(self):
        return "sliding" in self.group


def specimen(grains, seed, sliding, size):
    wide = grains > 1000
    return Run(f"grains-{grains}-seed{seed}" + ("-sliding" if sliding else ""), size,
               ("wide" if wide else "") + ("sliding" if sliding else "") or "rolling",
               f"specimen of {grains} grains", grains=grains, seed=seed)


def two_scale(scheme, across, lc, size="full", sliding=False, wide=False, small=False):
    """Smooth platens. The weak corner is 50 mm wide where elements are as small, else one element; 83 mm when wide.

    @param small  cells of 100 grains instead of 400: a quarter of the cost; their own peaks are 6.4 and 5.4
    """
    width = 0.5 if wide else 0.2
    patch = width / 6 if wide else max(0.05, width / across)
    materials = ("sand", "weak_sand")
    settings = [f"mesh.rectangle.elements=[{across}, {2 * across}]",
                f"mesh.rectangle.patch=[{patch:.6g} m, {patch:.6g} m]",
                *(f"materials.{sand}.lc={lc} mm" for sand in materials)]
    if sliding:
        settings += [f"materials.{sand}.script=cells/hooke_radii.in" for sand in materials]
    if small:
        settings += [f"materials.{sand}.packing=dense100_seed{seed}.h5" for sand, seed in zip(materials, (2, 3))]
    if wide:
        settings += ["mesh.rectangle.size=[0.5 m, 1 m]", "monitors.axial_strain=-shortening / 1 m",
                     "monitors.stress_ratio=-top_force / (0.5 m * 100 kPa)"]
    group = "small" if small else ("wide" if wide else "") + ("sliding" if sliding else "") or "rolling"
    name = (f"{scheme}-{across}x{2 * across}-lc{lc}" + ("-sliding" if sliding else "") + ("-wide" if wide else "") +
            ("-cells100" if small else ""))
    return Run(name, size, group, f"{8 * across * across} cells of {100 if small else 400} grains, each evaluated " +
               ("once a step" if scheme == "informed" else "in every iteration"),
               case=f"biaxial_{scheme}.yaml", settings=tuple(settings), height=2 * width)


def closed_form(across, words, settings):
    return Run(f"law-{across}x{2 * across}-{words}", "full", "law", "no cells, seconds", height=0.08,
               case="biaxial_elastoplastic.yaml",
               settings=(f"mesh.rectangle.elements=[{across}, {2 * across}]", *settings))


RUNS = [  # the longest first, so that none is left alone at the end
    *(two_scale("informed", 12, lc, wide=True) for lc in (10, 15)),
    two_scale("cell", 4, 15),
    *(specimen(5000, seed, sliding, "full") for sliding in (False, True) for seed in (1, 2, 3)),
    *(two_scale("informed", across, lc) for across in (12, 8) for lc in (5, 10, 15, 30)),
    *(two_scale("informed", 4, lc, "reduced" if lc == 15 else "full") for lc in (5, 10, 15, 30)),
    two_scale("informed", 12, 10, small=True),
    *(two_scale("informed", across, lc, small=True) for across in (8, 4) for lc in (5, 10, 15)),
    two_scale("informed", 2, 15, small=True),
    *(two_scale("cell", across, 15, small=True) for across in (4, 2)),
    two_scale("informed", 8, 15, sliding=True),
    two_scale("cell", 2, 15),
    two_scale("informed", 2, 15),
    two_scale("informed", 2, 15, "reduced", sliding=True),
    *(specimen(800, seed, sliding, "reduced") for sliding in (False, True) for seed in (1, 2, 3)),
    *(closed_form(across, words, settings) for across in (8, 12, 16) for words, settings in (
        ("lc3", ("materials.sand.lc=3 mm", "materials.weak_sand.lc=3 mm")), ("lc1", ()),
        ("cauchy", ("continuum=cauchy",)))),
]


def read_options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=pathlib.Path, default=pathlib.Path("results/biaxial_study"),
                        metavar="RESULTS", help="[results/biaxial_study]")
    parser.add_argument("--size", choices=("reduced", "full"), default="reduced", help="[reduced]")
    parser.add_argument("--only", metavar="NAME,...", help="these runs of any size; * stands for anything")
    parser.add_argument("--list", action="store_true", help="name the runs and end")
    parser.add_argument("--report", action="store_true", help="run nothing: tables and figures of what there is")
    parser.add_argument("-w", "--workers", type=int, default=2, help="of each two-scale run [2]")
    parser.add_argument("--jobs", type=int, help="runs at once [cores / workers]")
    parser.add_argument("--strain", type=float, default=0.08, help="axial strain at the end, in steps of 0.1 %% [0.08]")
    parser.add_argument("--programs", type=pathlib.Path, nargs="+", metavar="FOLDER",
                        default=[ROOT / "build/release/app", ROOT / "build/release/app/standalone"],
                        help="where polargrain and polargrain-liggghts are [build/release/app]")
    options = parser.parse_args()
    options.jobs = options.jobs or max(1, (os.cpu_count() or 1) // max(1, options.workers))
    return options


def stop(message):
    sys.exit(f"biaxial.py: {message}")


def chosen(options):
    if not options.only:
        return [run for run in RUNS if options.size == "full" or run.size == "reduced"]
    patterns = options.only.split(",")
    for pattern in patterns:
        if not fnmatch.filter([run.name for run in RUNS], pattern):
            stop(f"no run is called {pattern}; --size full --list names them all")
    return [run for run in RUNS if any(fnmatch.fnmatchcase(run.name, pattern) for pattern in patterns)]


class Failed(Exception):
    pass


class Study:
    """Carries runs out, each in folders and logs of its own, with paths relative to RESULTS: RESULTS can be moved."""

    def __init__(self, options):
        self.options = options
        self.output = options.output
        self.processes = set()
        self.stopped = False
        self.packing_locks = {run.grains * 10 + run.seed: threading.Lock() for run in RUNS if run.grains}
        self.polargrain = self.program("polargrain")

    def program(self, name):
        for place in self.options.programs:
            if (place / name).is_file():
                return str((place / name).resolve())
        stop(f"there is no {name} in {', '.join(map(str, self.options.programs))}: build the project, or name its "
             "folder with --programs")

    def call(self, run, *command):
        """A program, its output appended to the log of the run. @raises Failed with the end of the log"""
        log = self.output / f"{run.name}.log"
        with open(log, "a") as out:
            print("$", *command, file=out, flush=True)
            begin = out.tell()
            process = subprocess.Popen([str(word) for word in command], cwd=self.output, stdin=subprocess.DEVNULL,
                                       stdout=out, stderr=subprocess.STDOUT, start_new_session=True)
            self.processes.add(process)
            if self.stopped:  # a signal may have come before the process was known
                os.killpg(process.pid, signal.SIGTERM)
            status = process.wait()
            self.processes.discard(process)
        if status != 0:
            lines = log.read_text(errors="replace")[begin:].splitlines()[-8:]
            name = pathlib.Path(command[command[0] == sys.executable]).name
            raise Failed(f"{name} ended with status {status}; the end of {log}:\n    " +
                         "\n    ".join(lines))

    def packing(self, run):
        """Twice the grains, frictionless, so that specimens with and without rolling resistance share it. Large ones
        count as at rest sooner: what is left of their motion goes in the seating."""
        unbalanced = 1e-2 if run.grains > 1000 else 1e-3
        file = f"packings/{2 * run.grains}-seed{run.seed}.h5"
        part = f"packings/part-{2 * run.grains}-seed{run.seed}.h5"
        with self.packing_locks[run.grains * 10 + run.seed]:
            if not (self.output / file).exists() and not self.stopped:
                self.call(run, self.polargrain, "pack", ROOT / "cases/packings/dense400.yaml", "-o", part,
                          "--quiet", "--set", f"grains={2 * run.grains}", "--set", f"seed={run.seed}",
                          "--set", f"unbalanced_force_ratio={unbalanced:g}")
                (self.output / part).replace(self.output / file)
        return file

    def compute(self, run):
        strain = self.options.strain
        if run.grains:
            self.call(run, sys.executable, ROOT / "liggghts_inputs/specimen/specimen.py", "-o", run.name, "--grains",
                      run.grains, "--seed", run.seed, "--packing", self.packing(run), "--strain", strain,
                      "--rolling", 0 if run.sliding else 0.4, "--programs", *map(pathlib.Path.resolve,
                                                                              self.options.programs))
            return
        settings = list(run.settings)
        if run.group != "law":
            settings += [f"boundary.2.move.u2={-1000 * strain * run.height:.10g} mm",
                         f"steps.count={max(1, round(1000 * strain))}"]
        words = [word for setting in settings for word in ("--set", setting)]
        go_on = ["--resume"] if (self.output / run.name / "checkpoint.h5").exists() else []
        self.call(run, self.polargrain, "run", HERE / run.case, "-o", run.name, "-w", self.options.workers,
                  "--checkpoint-minutes", 2, *go_on, *words)

    def carry_out(self, run):
        """@returns what went wrong, or nothing"""
        if self.stopped:
            return None
        begin = time.monotonic()
        print(f"{run.name} ...", flush=True)
        trouble = None
        try:
            self.compute(run)
        except Failed as failure:
            trouble = str(failure)
        if not self.stopped:
            print(f"{run.name}: {'FAILED' if trouble else 'done'} after {time.monotonic() - begin:.0f} s", flush=True)
        return None if self.stopped else trouble

    def look_for_band(self, run):
        """In the second half of the run: 4 to 8 %."""
        last = biaxial_report.history(self.output / run.name)["axial_strain"][-1]
        try:
            self.call(run, self.polargrain, "band", run.name, "--from", last / 2, "--to", last, "--fields",
                      f"{run.name}.samples.csv")
        except Failed as failure:
            return str(failure)
        return None

    def stop(self, *_):
        """One signal to each program and its children, whoever else sends some: at a second one they end at once."""
        if not self.stopped:
            self.stopped = True
            for process in list(self.processes):
                os.killpg(process.pid, signal.SIGTERM)


def main():
    options = read_options()
    runs = chosen(options)
    if options.list:
        print("\n".join(f"{run.name:30} {run.size:8} {run.what}" for run in runs))
        return
    (options.output / "packings").mkdir(parents=True, exist_ok=True)
    study = Study(options)
    failures = {}
    if not options.report:
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            signal.signal(number, study.stop)
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            failures = {run.name: trouble for run, trouble in zip(runs, pool.map(study.carry_out, runs)) if trouble}
        if study.stopped:
            print("biaxial.py: stopped; the same command goes on", file=sys.stderr)
            sys.exit(3)
    there = [run for run in runs if biaxial_report.history(options.output / run.name)]
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
