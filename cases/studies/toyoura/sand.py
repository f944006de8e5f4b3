# SPDX-License-Identifier: GPL-2.0-or-later
"""Toyoura sand as cells of discs: the contact law with three parameters, its packings, and runs of polargrain with them.

A packing is made once a seed and stays the same sand: for other parameters and another pressure the grains are brought, still
without friction, from the pressure they are under to the one asked for. Made anew for each modulus it would be another packing,
and two packings of some hundred discs differ in strength by more than the laboratory's tests do.
"""
import math
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[3]
D50 = 0.01  # m, mean diameter of the discs; see docs/studies/toyoura.md on the size of the grains
DENSITY, THICKNESS = 2650, 0.1  # kg/m^3, m; as cases/packings/dense400.yaml
PACKING_MODULUS = 9e8  # Pa, with which the packings are made
PACKING_PRESSURE = 49e3  # Pa
NAMES = ("modulus", "friction", "rolling")


def add_programs(parser):
    build = ROOT / "build/release/app"
    parser.add_argument("--program", default=str(build / "polargrain"))
    parser.add_argument("--liggghts", help="polargrain-liggghts [beside the program, or in standalone/ there]")


def programs(given):
    """Absolute paths of polargrain and polargrain-liggghts."""
    folder = pathlib.Path(given.program).parent
    beside = folder / "polargrain-liggghts"
    liggghts = given.liggghts or (beside if beside.exists() else folder / "standalone/polargrain-liggghts")
    for program in (given.program, liggghts):
        if not os.access(program, os.X_OK):
            sys.exit(f"{pathlib.Path(sys.argv[0]).name}: {program} cannot be run; build it, or name it with --program and --liggghts")
    return os.path.abspath(given.program), os.path.abspath(liggghts)


def run(command, folder):
    # One thread each: the runs themselves are what is parallel.
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, env={**os.environ, "OMP_NUM_THREADS": "1"})
    if done.returncode:
        raise RuntimeError(f"{' '.join(command)} in {folder} ended with status {done.returncode}: {done.stderr[-2000:]}")


def write_script(path, parameters):
    """cells/hooke_rolling.in with these parameters."""
    script = (ROOT / "liggghts_inputs/cells/hooke_rolling.in").read_text()
    for pattern, value in (("contactModulus peratomtypepair 1 ", parameters["modulus"]),
                           ("coefficientFriction peratomtypepair 1 ", parameters["friction"]),
                           ("coefficientRollingFriction peratomtypepair 1 ", parameters["rolling"])):
        script, count = re.subn(f"({pattern})[-0-9.e]+", lambda found: found.group(1) + f"{value:.8g}", script)
        assert count == 1, pattern
    path.write_text(script)


def make_packing(polargrain, folder, seed, grains):
    """The packing of a seed as a LIGGGHTS data file, under PACKING_PRESSURE; kept in the folder."""
    data = folder / f"seed{seed}.data"
    if not data.exists():
        folder.mkdir(parents=True, exist_ok=True)
        script = folder / f"seed{seed}.in"
        write_script(script, {"modulus": PACKING_MODULUS, "friction": 0, "rolling": 0})
        run([polargrain, "pack", str(ROOT / "cases/packings/dense400.yaml"), "-o", f"seed{seed}.h5", "--quiet",
             "--set", f"grains={grains}", "--set", f"seed={seed}", "--set", f"pressure={PACKING_PRESSURE}",
             "--set", f"script={script}"], folder)
        run([polargrain, "pack", f"seed{seed}.h5", "--export", f"new{seed}.data"], folder)
        os.replace(folder / f"new{seed}.data", data)
    return data


# Newton's method for the mean stress, with a bulk modulus that is known well enough. The normal stresses differ by some percent then:
# without friction, almost nothing holds them equal, and what would correct them makes the grains slip into another packing.
CONSOLIDATION = """# The packing without friction, brought to another pressure.
variable        packing index {packing}
include         smooth.in
fix             cell all cell/load inertial_number 1.2e-2 damping 0.24 least_steps 20 unbalanced 1e-3 1e-3 most_relaxation_steps 200000
variable        loading equal f_cell
variable        done equal f_cell[10]
variable        lack equal (f_cell[1]+f_cell[2])/2+{pressure:.10g}
variable        off equal abs(v_lack)/{pressure:.10g}
variable        strain equal -v_lack/{stiffness:.10g}
fix_modify      cell increment 0 0 0 0 0 0 0
variable        trial loop 20
label           trial
run             ${{loading}} post no
label           rest
if              "${{done}} == 1" then "jump SELF rested"
run             20 pre no post no
jump            SELF rest
label           rested
if              "${{off}} < 1e-3" then "jump SELF reached"
fix_modify      cell increment ${{strain}} 0 0 ${{strain}} 0 0 0
next            trial
jump            SELF trial
print           "pressure not reached"
quit
label           reached
dump            grains all custom 1 grains.dump id x y radius
dump_modify     grains format "%d %.17g %.17g %.17g"
run             0 post no
variable        width equal lx
variable        tilt equal xy
variable        height equal ly
print           "${{width}} ${{tilt}} ${{height}}" file box.txt
"""


def consolidate(liggghts, packing, parameters, pressure, folder):
    """Writes packing.csv: the packing under a pressure (Pa) with the contact modulus of the parameters."""
    write_script(folder / "smooth.in", {**parameters, "friction": 0, "rolling": 0})
    stiffness = 0.06 * parameters["modulus"]  # stress over strain in each direction, slightly above the cell's own
    (folder / "consolidate.in").write_text(CONSOLIDATION.format(packing=packing, pressure=pressure, stiffness=stiffness))
    (folder / "box.txt").unlink(missing_ok=True)
    run([liggghts, "-in", "consolidate.in", "-log", "consolidate.log", "-screen", "none"], folder)
    if not (folder / "box.txt").exists():
        raise RuntimeError(f"{folder}: the pressure was not reached, see consolidate.log there")
    width, tilt, height = map(float, (folder / "box.txt").read_text().split())
    lines = (folder / "grains.dump").read_text().splitlines()[9:]
    with open(folder / "packing.csv", "w") as file:
        file.write(f"# cell xx={width:.17g} xy={tilt:.17g} yx=0 yy={height:.17g} z={THICKNESS:g}\nid,x,y,r,mass,Izz\n")
        for number, x, y, radius in sorted([*map(float, line.split())] for line in lines):
            mass = DENSITY * math.pi * radius**2 * THICKNESS
            file.write(f"{number:.0f},{x:.17g},{y:.17g},{radius:.17g},{mass:.17g},{mass * radius**2 / 2:.17g}\n")


def material(parameters, packing):
    """A material of a case: model informed; G and Gc are the affine estimates of docs/theory.md C.7. Cells that collapse far
    behind the peak do not come to rest within an unbalanced ratio of 5e-3; with 4e-2 they do, and the curve of an element
    changes by 0.5 % at 1 % of strain and at the peak, and by up to 4 % before."""
    shear = 16e6 * parameters["modulus"] / 6e8
    return (f"{{model: informed, script: cell.in, packing: {packing}, G: {shear:.6g}, Gc: {shear:.6g}, lc: {1.5 * D50:g}, "
            "drift_shear: 0.004, dilatancy_limits: [-0.5, 0.8], unbalanced_force_ratio: 4e-2, unbalanced_moment_ratio: 4e-2}")
