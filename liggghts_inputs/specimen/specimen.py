#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Biaxial compression of a specimen made of grains only: packing, cut, seating, compression, in one command.

    python3 specimen.py -o RESULTS                     800 discs, about two minutes
    python3 specimen.py -o RESULTS --grains 5000       the full size
    python3 specimen.py -o RESULTS --seed 2 --rolling 0

What is there already in RESULTS is not made again: a run that was broken off goes on from its last frame, and gives the
same bytes as one that was not. Other options for the same folder are refused.

Into RESULTS: history.csv (a row every 1e-4 of strain), grains/step-*.dump (id, x, y, radius, rotation, a file a frame),
restart/step-*.restart, packing.h5, specimen.data, options.txt, *.log. Then `polargrain band RESULTS` looks for the band.
"""
import argparse
import hashlib
import math
import pathlib
import re
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
COLUMNS = ("step,axial_strain,stress_ratio,volume_strain,width,height,top_force,bottom_force,unbalanced_ratio,"
           "membrane_grains")


def read_options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True, metavar="RESULTS")
    parser.add_argument("--grains", type=int, default=800, help="discs of the specimen, about [800]")
    parser.add_argument("--seed", type=int, default=1, help="of the packing [1]")
    parser.add_argument("--packing", type=pathlib.Path, help="a square packing made before, of --aspect times the "
                        "grains; its own grains and seed count")
    parser.add_argument("--specification", type=pathlib.Path, default=HERE / "../../cases/packings/dense400.yaml",
                        help="what to pack: sizes, pressure [cases/packings/dense400.yaml]")
    parser.add_argument("--rolling", type=float, default=0.2,
                        help="coefficient of rolling friction; 0: nothing resists rolling [0.2]")
    parser.add_argument("--friction", type=float, default=math.tan(0.5), help="coefficient of friction [tan 0.5]")
    parser.add_argument("--strain", type=float, default=0.10, help="axial strain at the end [0.1]")
    parser.add_argument("--rate", type=float, default=0.24, help="axial strain rate, 1/s [0.24: inertial number 3.9e-4]")
    parser.add_argument("--frame", type=float, default=0.001, help="axial strain between two frames [0.001]")
    parser.add_argument("--damping", type=float, default=0.2, help="damping ratio of the contacts [0.2]")
    parser.add_argument("--aspect", type=int, default=2, help="height over width, a whole number [2]")
    parser.add_argument("--platens", type=pathlib.Path, help="commands that make the platens other than smooth, included in compression.in")
    parser.add_argument("--programs", type=pathlib.Path, nargs="+", metavar="FOLDER",
                        help="where polargrain and polargrain-liggghts are [build/release/app, else the path]")
    return parser.parse_args()


def program(options, name):
    build = HERE / "../../build/release/app"
    places = options.programs or [build, build / "standalone"]
    for place in places:
        if (place / name).is_file():
            return str((place / name).resolve())
    return name


def stop(message):
    sys.exit(f"specimen.py: {message}")


def run(command, log, folder=None):
    """Runs a program of this project, its output into a log. On failure: the last lines of the log, and the end."""
    with open(log, "w") as out:
        try:
            status = subprocess.run([str(word) for word in command], stdout=out, stderr=subprocess.STDOUT,
                                    cwd=folder).returncode
        except FileNotFoundError:
            stop(f"there is no program {command[0]}: build the project, or say where it is with --programs")
    if status != 0:
        stop(f"{pathlib.Path(command[0]).name} ended with status {status}; the end of {log}:\n" +
             "\n".join(log.read_text().splitlines()[-12:]))


def remember(options):
    """Options belong to the folder: a run that goes on must be the one that was begun. Files count by what is in them."""
    def written(value):
        if not isinstance(value, pathlib.Path):
            return value
        if not value.is_file():
            stop(f"there is no file {value}")
        return hashlib.sha256(value.read_bytes()).hexdigest()

    text = "".join(f"{name} {written(value)}\n" for name, value in sorted(vars(options).items())
                   if name not in ("output", "programs", "strain") and (name, value) not in (("aspect", 2), ("platens", None)))
    file = options.output / "options.txt"
    if file.exists() and file.read_text() != text:
        stop(f"{options.output} holds a run with other options:\n{file.read_text()}"
             "give the same ones to go on, or another folder")
    file.write_text(text)


def write_whole(file, text):
    """A file that is there is complete: what was broken off is made again."""
    part = file.with_name(file.name + ".part")
    part.write_text(text)
    part.replace(file)


def make_packing(options):
    packing = options.output / "packing.h5"
    if options.packing:
        return options.packing
    if not packing.exists():
        print(f"packing {options.aspect * options.grains} grains, seed {options.seed} ...", flush=True)
        run([program(options, "polargrain"), "pack", options.specification, "-o", packing, "--quiet",
             "--set", f"grains={options.aspect * options.grains}", "--set", f"seed={options.seed}"], options.output / "pack.log")
    return packing


def cut(options, packing):
    """A slice of a square periodic packing, --aspect times as high as wide, in a box with room around it."""
    data = options.output / "specimen.data"
    if data.exists():
        return data
    export = options.output / "packing.data"
    run([program(options, "polargrain"), "pack", packing, "--export", export], options.output / "export.log")
    head, atoms = export.read_text().split("Atoms", 1)
    width, height, depth = (float(re.search(rf"\S+ (\S+) {axis}lo {axis}hi", head).group(1)) for axis in "xyz")
    width /= options.aspect
    grains = [words for words in (line.split() for line in atoms.splitlines()) if words and float(words[4]) < width]
    text = (f"specimen cut from {packing.name}\n\n{len(grains)} atoms\n1 atom types\n\n"
            f"{-width:.17g} {2 * width:.17g} xlo xhi\n{-0.2 * height:.17g} {1.2 * height:.17g} ylo yhi\n"
            f"{-depth:.17g} {depth:.17g} zlo zhi\n\nAtoms\n\n")
    text += "".join(f"{number} {' '.join(words[1:])}\n" for number, words in enumerate(grains, start=1))
    write_whole(data, text)
    export.unlink()
    return data


def variables(options):
    words = ["-var", "folder", options.output.resolve(), "-var", "damping", options.damping]
    return words if options.rolling else [*words, "-var", "rolling_model", "off", "-var", "rolling_force", "off"]


def time_step(options):
    """The one that the seating came to, s; the compression goes on with it."""
    return float(re.findall(r"^polargrain: time step (\S+) s", (options.output / "seating.log").read_text(), re.M)[-1])


def frames_done(options):
    """Steps of the restart files, ascending."""
    return sorted(int(file.stem.split("-")[1]) for file in (options.output / "restart").glob("step-*.restart"))


def trim_history(options, step):
    """Rows beyond the frame that the run goes on from will come again."""
    file = options.output / "history.csv"
    rows = file.read_text().splitlines()[1:] if file.exists() else []
    rows = [row for row in rows if row.count(",") == COLUMNS.count(",") and int(row.split(",")[0]) <= step]
    write_whole(file, "\n".join([COLUMNS, *rows]) + "\n")


def main():
    options = read_options()
    for folder in (options.output, options.output / "restart", options.output / "grains"):
        folder.mkdir(parents=True, exist_ok=True)
    remember(options)
    data = cut(options, make_packing(options))
    liggghts = program(options, "polargrain-liggghts")
    if not frames_done(options):
        print("seating ...", flush=True)
        run([liggghts, "-in", "seating.in", "-log", "none", "-var", "data", data.resolve(), *variables(options),
             "-var", "final_friction", options.friction, "-var", "final_rolling", options.rolling],
            options.output / "seating.log", HERE)
    steps = round(options.frame / (options.rate * time_step(options)))
    row_steps = max(1, round(steps / 10))
    steps = 10 * row_steps
    last = round(options.strain / options.frame) * steps
    done = frames_done(options)
    # The newest restart file may be half written when the run was killed: the one before it is not.
    start = done[-2] if len(done) > 1 and done[-1] < last else done[-1]
    if start >= last:
        print(f"{options.output} is complete")
        return
    trim_history(options, start)
    print(f"compressing from frame {start // steps} to {last // steps} ...", flush=True)
    run([liggghts, "-in", "compression.in", "-log", "none",
         "-var", "start", (options.output / f"restart/step-{start}.restart").resolve(),
         "-var", "frames", (last - start) // steps, "-var", "steps", steps, "-var", "row_steps", row_steps,
         "-var", "rate", options.rate, "-var", "friction", options.friction, "-var", "rolling", options.rolling,
         *(["-var", "platens", options.platens.resolve()] if options.platens else []),
         *variables(options)], options.output / "compression.log", HERE)
    for step in done + frames_done(options):  # the last two are enough to go on
        if step not in frames_done(options)[-2:]:
            (options.output / f"restart/step-{step}.restart").unlink(missing_ok=True)
    for remark in re.findall(r"^polargrain: (time step .* stiffened)", (options.output / "compression.log").read_text(), re.M):
        print(f"{remark}; strains grow more slowly from there")
    print(f"done: {options.output / 'history.csv'}")


if __name__ == "__main__":
    main()
