#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes docs/verification.md and docs/hard_cases.md from the figures that the tests print.

Usage: docs/make_verification.py                         pages from the kept figures (docs/data/verification.txt)
       docs/make_verification.py BUILD_FOLDER [--long]   runs the tests first and keeps their figures

Runs every test executable that SECTIONS names, and with --long those of LONG. Keeps the lines that begin with "[figure]",
the outcome of each test case and the processor time of the executable. A test prints a figure beside its check, so the
pages contain only measured figures. The figures of an executable that is not built stay as they are.
"""
import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys

DOCS = pathlib.Path(__file__).parent
KEPT = DOCS / "data/verification.txt"

# Topic and executable.
SECTIONS = [
    ("Elastoplastic law (B.1 to B.7)", "elastoplastic_test"),
    ("Plane-strain limits and rates (B.3)", "elastoplastic_verification_test"),
    ("Elements", "fem_element_test"),
    ("Patch tests (E.1, E.1b)", "fem_patch_test"),
    ("Elastic shear layer (E.3)", "fem_shear_layer_test"),
    ("Glide layer", "fem_glide_layer_test"),
    ("Hole in a plate (E.2)", "fem_hole_test"),
    ("Classical limit", "fem_cauchy_test"),
    ("Ground at rest", "fem_geostatic_test"),
    ("Softening shear layer (E.4)", "fem_softening_layer_test"),
    ("Biaxial compression with a weak corner (E.5)", "fem_biaxial_test"),
    ("Strip footing (E.6)", "fem_footing_test"),
    ("Large displacements", "fem_large_test"),
    ("Hard cases", "fem_hard_cases_test"),
    ("Friction and dilatancy from a micro scale (B.9)", "informed_material_test"),
    ("Both two-scale schemes against the cell alone (E.8)", "informed_engine_test"),
    ("Newton's method", "fem_solver_test"),
    ("Noise, untrue tangents, absurd corrections", "fem_noise_test"),
    ("Cell: lattices of two radii (C.8)", "dem_polar_test"),
    ("Cell: hexagonal lattice (E.7 a)", "dem_lattice_test"),
    ("Cell: Rowe's packing (E.7 c)", "dem_rowe_test"),
    ("Cell: limits and identities (C.2 to C.6)", "dem_limits_test"),
    ("Cell: tangent (C.7)", "dem_tangent_test"),
    ("Cell: independent code", "dem_paths_test"),
    ("Cell: as a value", "dem_cell_test"),
    ("The same bits on every processor", "processors_test"),
    ("Cell of spheres: lattices (C.9)", "sphere_lattice_test"),
    ("Cell of spheres: Rowe's packings (C.9)", "sphere_rowe_test"),
    ("Cell of spheres: as a value", "sphere_cell_test"),
    ("Cell of spheres: controlled rotations (C.9)", "sphere_cosserat_test"),
    ("Cell of spheres: tangent (C.9)", "sphere_tangent_test"),
    ("Cell of spheres: independent code", "sphere_paths_test"),
    ("Contact laws (D)", "contact_law_test"),
    ("Contact laws in a script (D.5)", "contact_standalone_test"),
    ("Specimen: lattice between platens", "specimen_lattice_test"),
]

LONG = [
    ("Many elements", "fem_many_elements_test"),
]

# Rows of the table: what, reference, error asked for, executable, expression whose groups are errors, the exact value if
# the groups are values. The largest magnitude of all that match is shown.
N = r"(-?[0-9.]+(?:e[-+]?[0-9]+)?)"
SUMMARY = [
    ("E.1 patch tests, all elements", "exact fields", "1e-10", "fem_patch_test", rf"^E\.1 .*relative error {N}"),
    ("E.1b pure bending", "exact fields", "1e-10", "fem_patch_test", rf"^E\.1b .*relative error {N}"),
    ("E.2 hole in a plate, 9 pairs (a/b, N)", "Kaloni and Ariman 1967", "1e-2", "fem_hole_test", rf"relative error {N}"),
    ("E.3 shear layer, 20 elements", "closed form", "1e-6", "fem_shear_layer_test", rf"Q8R 20 elements.*stress {N}"),
    ("glide layer, u_x(1)", "published exact solution", "1e-6", "fem_glide_layer_test", rf"u_x\(1\) {N}"),
    ("glide layer, w", "published exact solution", "1e-5", "fem_glide_layer_test", rf"error of w {N}"),
    ("E.4 load table, 40, 80 and 160 elements", "independent solution", "1e-3", "fem_softening_layer_test",
     rf"largest error of the stress {N}"),
    ("E.4 onset width, 2 materials on 3 meshes", "closed form", "3e-2", "fem_softening_layer_test",
     rf"onset.*relative error {N}"),
    ("E.5 load tables, lc 3 and 1 mm, 2 meshes each", "independent solution", "2e-3", "fem_biaxial_test",
     rf"largest relative error {N}"),
    ("E.6 footing, h = b/8, above 2 + pi", "Prandtl", "3.5e-2", "fem_footing_test", rf"b/8: .*by {N}"),
    ("B.3 plane-strain limits", "Mohr-Coulomb", "1e-6", "elastoplastic_verification_test", rf"s22 error {N}"),
    ("B.7 tangents, 12 variants", "complex step", "1e-10", "elastoplastic_test", rf"smooth \d+ error {N}"),
    ("B.7 tangents, 12 variants, 1,200 states each", "central differences", "1e-6", "elastoplastic_test",
     rf"central differences error {N}"),
    ("classical limit, Gc = 1e-9 G, 4 elements", "continuum without rotations", "1e-6", "fem_cauchy_test",
     rf"Gc = 1e-9 G, \w+: {N}"),
    ("large rotation by a full circle, stress over E", "0", "1e-7", "fem_large_test", rf"stress over E {N}"),
    ("pressure all round at large strain, width", "exp(-p/E)", "1e-5", "fem_large_test", rf"of the width {N}"),
    ("stiffness of a following pressure", "central differences", "1e-11", "fem_large_test",
     rf"against central differences {N}"),
    ("hard cases with an exact end", "Mohr-Coulomb", "1e-3", "fem_hard_cases_test", rf"kPa, relative error {N}"),
    ("E.7 a hexagonal lattice: G, G + Gc, Gc, couple modulus", "closed form", "1e-3", "dem_lattice_test",
     rf"(?:G|Gc|modulus) {N}", 1),
    ("C.8 couple modulus of lattices of two radii", "lattices bent row by row", "1e-3", "dem_polar_test", rf"{N} of the exact", 1),
    ("E.7 c Rowe's packing of discs, mu 0.2 and 0.3", "Rowe 1962", "2e-2", "dem_rowe_test", rf"within {N} of"),
    ("C.6 skew stress over 2 mu p, 400 discs", "1", "3e-2", "dem_limits_test", rf"2 mu p .*0\.04: {N}", 1),
    ("C.6 couple stress over (4/pi) mu_th r_c p", "1", "1e-1", "dem_limits_test", rf"6 rad/m: {N}", 1),
    ("C.4 virtual work, discs", "work of the stress", "1e-6", "dem_limits_test", rf"that of the stress: {N}"),
    ("work over stored energy without slip, discs", "1", "1e-2", "dem_limits_test", rf"contacts stored: {N}", 1),
    ("packing and path turned by 90 degrees, discs", "0", "1e-3", "dem_limits_test",
     rf"90 degrees: {N} of the pressure away, couple stress {N}"),
    ("rigid rotation by 0.2 rad, discs", "0", "2e-3", "dem_cell_test", rf"0\.2 rad differs by {N}"),
    ("C.7 condensed tangent at rest, discs", "central differences", "2e-2", "dem_tangent_test", rf"at rest: columns {N}"),
    ("two strain paths of discs, 3 increments, %", "independent code", "3", "dem_paths_test", rf"stress {N} % in 3"),
    ("C.9 lattices of spheres, stresses of each strain", "closed form", "2e-3", "sphere_lattice_test", rf"stress {N}"),
    ("C.9 Rowe's packings of spheres", "closed form", "2e-4", "sphere_rowe_test", rf"within {N} of"),
    ("rotation by 0.25 rad on top of a strain, 500 spheres", "0", "1e-9", "sphere_cell_test", rf"0\.25 rad on top: .*by {N}"),
    ("C.9 mode 2: 1, 8 and 27 cells of lattices, moduli", "closed form", "1e-3", "sphere_cosserat_test", rf"moduli {N} from closed"),
    ("C.9 mode 2: rotation by 0.2 rad on top", "0", "1e-8", "sphere_cosserat_test", rf"on top: stress {N}, couple stress {N}"),
    ("C.9 skew stress over (3 pi / 4) mu p", "1", "5e-2", "sphere_cosserat_test", rf"0\.08: {N}", 1),
    ("C.9 couple stress over its limit, without and with torsion", "1", "1e-1", "sphere_cosserat_test", rf"torsion \w+: {N}", 1),
    ("C.9 condensed tangent at rest, Hertz", "central differences", "2e-2", "sphere_tangent_test", rf"Hertz.*tangent {N} of"),
    ("C.9 mode 2: condensed tangent at rest", "central differences", "2e-2", "sphere_tangent_test",
     rf"at rest, controlled.*tangent {N} of .*forces, {N} in the couples, {N} mixed"),
    ("C.9 tangent with sliding, rolling and torsion", "dense solution", "1e-9", "sphere_tangent_test",
     rf"forces {N}, couples {N} from the dense"),
    ("contact forces of 1,000 spheres, sum of differences, %", "independent code", "1", "sphere_paths_test", rf"forces {N} % of their"),
]


def run(executable):
    """Figures, (name, outcome) of the cases, and processor seconds of one test executable."""
    process = subprocess.Popen([executable], stdout=subprocess.PIPE, text=True)
    output = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    figures = re.findall(r"^\[figure\] (.*)$", output, re.M)
    cases = re.findall(r"^\[ +(OK|FAILED) +\] (\S+?),?(?: where .*)? \(\d+ ms\)$", output, re.M)
    if process.returncode != 0 and not any(outcome == "FAILED" for outcome, _ in cases):
        cases.append(("FAILED", f"exit status {process.returncode}"))
    return figures, [(name, outcome) for outcome, name in cases], usage.ru_utime + usage.ru_stime


def summary_table(results):
    rows = ["| problem | reference | error asked for | largest error |", "|---|---|---|---|"]
    for what, reference, asked, name, expression, *exact in SUMMARY:
        if name not in results:
            continue
        found = [value for figure in results[name][0] for match in re.finditer(expression, figure) for value in match.groups()]
        if not found:
            sys.exit(f"no figure of {name} matches {expression}")
        error = max(abs(float(value) - sum(exact)) for value in found)
        rows.append(f"| {what} | {reference} | {asked} | {error:.2g} |")
    return rows


def hard_cases_page(figures):
    """A table of the hard cases that ran; the others, refused or of another kind, below it."""
    rows, others = [], []
    for figure in figures:
        match = re.match(r"(.*?): (to the end|stopped, .*?); time (\S+) of (\d+), iterations (\d+), cuts (\d+), "
                         r"axial stress (\S+) kPa(?:, relative error (\S+?))?,", figure)
        if match:
            name, outcome, time, of, iterations, cuts, stress, error = match.groups()
            outcome = outcome if outcome == "to the end" else f"{outcome} (at {time} of {of})"
            rows.append(f"    {name:<44}{iterations:>10}{cuts:>6}{float(stress):>14.6g}{error or '':>15}  {outcome}")
        else:
            others.append(f"    {figure}")
    return "\n".join([
        "# Hard cases", "",
        "*What happens in cases that break other solvers? For users who doubt a run. With grains: [hard cells](hard_cells.md).*", "",
        "`docs/make_verification.py` writes this page from `fem_hard_cases_test` and `fem_many_elements_test`. A block is",
        "compressed or extended in ten steps a leg, to a tolerance of 1e-8. The error is relative to the Mohr-Coulomb stress",
        "at which a homogeneous block must end. With friction at the platens, or after a stop, there is no exact answer.", "",
        f"    {'case':<44}{'iterations':>10}{'cuts':>6}{'stress, kPa':>14}{'error':>15}  what happened", *rows, "", "Refused cases, and cases of another kind:", "", *others, ""])


def keep(results):
    """The raw figures, one executable after the other."""
    lines = ["Figures of the tests, written by docs/make_verification.py BUILD_FOLDER. Do not edit."]
    for name, (figures, cases, seconds) in results.items():
        lines += ["", f"== {name}: {len(cases)} cases, {seconds:.1f} s"]
        lines += [f"-- failed: {case}" for case, outcome in cases if outcome == "FAILED"] + figures
    KEPT.parent.mkdir(exist_ok=True)
    KEPT.write_text("\n".join(lines) + "\n")


def kept():
    """@returns what keep() was given; cases that passed have no names"""
    results = {}
    for line in KEPT.read_text().splitlines()[1:] if KEPT.exists() else []:
        begin = re.fullmatch(r"== (\S+): (\d+) cases, (\S+) s", line)
        failed = re.fullmatch(r"-- failed: (\S+)", line)
        if begin:
            figures, cases = [], [("", "OK")] * int(begin[2])
            results[begin[1]] = (figures, cases, float(begin[3]))
        elif failed:
            cases[cases.index(("", "OK"))] = (failed[1], "FAILED")
        elif line:
            figures.append(line)
    return results


def run_tests(build, sections):
    executables = {}
    for _, name in sections:
        executable = next((path for path in sorted(build.rglob(name)) if path.is_file()), None)
        if executable is None:
            print(f"{name}: not built, its figures stay as they are", file=sys.stderr)
        else:
            executables[name] = executable
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        return dict(zip(executables, pool.map(run, executables.values())))


def verification_page(results):
    lines = ["# Verification", "",
             "*How well does the program solve problems with exact or published answers? For users who want evidence.*", "",
             "`docs/make_verification.py` writes this page from the figures that the tests print. Each test checks its figures and fails",
             "beyond the error asked for. All figures are in [data/verification.txt](data/verification.txt). Labels such as E.4 are cited in the",
             "code; [theory](theory.md) explains the others. To measure again:", "",
             "    docs/make_verification.py build/release --long", "",
             "## Errors", "",
             "Errors are relative where the reference is not zero. Rows with % are in per cent.", "",
             *summary_table(results), "", "## Tests", ""]
    total = sum(len(cases) for _, cases, _ in results.values())
    bad = [f"{case} of `{name}`" for name, (_, cases, _) in results.items() for case, outcome in cases if outcome == "FAILED"]
    lines.append(f"{len(results)} programs with {total} cases: " + (f"**failed: {', '.join(bad)}**." if bad else "all pass."))
    return lines + ["", "More paths of cells of discs and spheres: [data/exact_paths.csv](data/exact_paths.csv). [Hard cases](hard_cases.md) have",
                    "a page of their own.", ""]


def pages(results):
    """@returns texts of the pages by their names"""
    hard = [figure for name in ("fem_hard_cases_test", "fem_many_elements_test") if name in results
            for figure in results[name][0]]
    return {"hard_cases.md": hard_cases_page(hard), "verification.md": "\n".join(verification_page(results))}


def main():
    sections = SECTIONS + (LONG if "--long" in sys.argv[2:] else [])
    results = kept()
    if len(sys.argv) > 1:
        results |= run_tests(pathlib.Path(sys.argv[1]), sections)
        order = [name for _, name in SECTIONS + LONG]
        results = {name: results[name] for name in sorted(results, key=order.index)}
        keep(results)
    for name, text in pages(results).items():
        (DOCS / name).write_text(text)
    sys.exit(1 if any(outcome == "FAILED" for _, cases, _ in results.values() for _, outcome in cases) else 0)


if __name__ == "__main__":
    main()
