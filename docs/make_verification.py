#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes docs/verification.md and docs/hard_cases.md from what the tests print.

Usage: docs/make_verification.py BUILD_FOLDER [--long]

Runs every test executable whose name is given in SECTIONS, and with --long those of LONG, and collects the lines that
begin with "[figure]", the outcome of each test case and the processor time of the executable (wall times depend on what
else the machine does). A figure is printed by the test beside the check it belongs to, so the pages cannot say anything
the tests have not measured.
"""
import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys

SECTIONS = [
    ("Elastoplastic law (B.1 to B.7)", "elastoplastic_test", "Return mapping, apex, tangents of all variants."),
    ("Plane-strain limits and rates (B.3)", "elastoplastic_verification_test",
     "Mohr-Coulomb limits, order of the integration, cones with mobilised strength."),
    ("Elements", "fem_element_test", "Zero modes, rigid motions, shape functions of every element."),
    ("Patch tests (E.1, E.1b)", "fem_patch_test", "Fields that elements must have exactly."),
    ("Elastic shear layer (E.3)", "fem_shear_layer_test", "Closed form, boundary layers of the rotation."),
    ("Glide layer", "fem_glide_layer_test", "Published exact solution."),
    ("Hole in a plate (E.2)", "fem_hole_test", "Stress concentration, Kaloni and Ariman 1967."),
    ("Classical limit", "fem_cauchy_test", "`continuum: cauchy` against the Cosserat continuum without coupling."),
    ("Ground at rest", "fem_geostatic_test", "Gravity, initial stress, stages."),
    ("Softening shear layer (E.4)", "fem_softening_layer_test", "Onset width, load table, snap-back."),
    ("Biaxial compression with a weak corner (E.5)", "fem_biaxial_test", "Localisation, Newton's rate."),
    ("Strip footing (E.6)", "fem_footing_test", "Prandtl's bearing capacity from above."),
    ("Large displacements", "fem_large_test", "Rotation of the stress, pressure that follows the boundary."),
    ("Hard cases", "fem_hard_cases_test", "Each runs to its end, or stops and says why."),
    ("Friction and dilatancy from a micro scale (B.9)", "informed_material_test", "Order of both updates, discs."),
    ("Both two-scale schemes against the cell alone (E.8)", "informed_engine_test", "Peak of a biaxial test."),
    ("Newton's method", "fem_solver_test", "Work balance, quadratic rate, steps that are cut."),
    ("Noise, untrue tangents, absurd corrections", "fem_noise_test",
     "What the solver makes of them, and that it says so."),
    ("Cell: lattices of two radii (C.8)", "dem_polar_test",
     "Couple modulus against lattices that are bent, row by row; cells of grains in all three loops."),
    ("Cell: hexagonal lattice (E.7 a)", "dem_lattice_test", "Exact moduli at any size, rotation and flip of the box."),
    ("Cell: Rowe's packing (E.7 c)", "dem_rowe_test", "Stress ratio of sliding rows, closed form."),
    ("Cell: limits and identities (C.2 to C.6)", "dem_limits_test", "Skew and couple stress, work, covariance."),
    ("Cell: tangent (C.7)", "dem_tangent_test", "Against differences of the cell, before and after yield."),
    ("Cell: independent code", "dem_paths_test", "Two strain paths computed with YADE."),
    ("Cell: as a value", "dem_cell_test", "Same request, same bits; rigid rotation; large shear."),
    ("The same bits on every processor", "processors_test", "Runs as on Haswell, Zen, Nehalem, and without fused multiply-add."),
    ("Prescribed boundary (C.5)", "dem_boundary_test", "Why cells do not prescribe one: moduli that follow the size."),
]

LONG = [("Many elements", "fem_many_elements_test", "The hard case of 50,000 elements.")]

# Rows of the table at the top: what, reference, tolerance asked for, executable, expression whose group is an error.
# The largest magnitude of all that match is shown.
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
    rows = ["| problem | reference | error asked for | largest error | test | time, s |", "|---|---|---|---|---|---|"]
    for what, reference, asked, name, expression in SUMMARY:
        if name not in results:
            continue
        figures, _, seconds = results[name]
        errors = [abs(float(error)) for figure in figures for error in re.findall(expression, figure)]
        if not errors:
            sys.exit(f"no figure of {name} matches {expression}")
        rows.append(f"| {what} | {reference} | {asked} | {max(errors):.2g} | `{name}` | {seconds:.1f} |")
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
            rows.append(f"| {name} | {iterations} | {cuts} | {float(stress):.6g} | {error or ''} | {outcome} |")
        else:
            others.append(f"- {figure}")
    return "\n".join([
        "# Hard cases", "",
        "Written by `docs/make_verification.py` from `fem_hard_cases_test` and `fem_many_elements_test`:",
        "biaxial compression or extension of a block, ten steps a leg, to a tolerance of 1e-8. The error is relative to",
        "the Mohr-Coulomb stress at which a homogeneous block must end; there is none where friction at the platens or a stop leaves no exact answer.",
        "[The same kind of cases with boxes of grains](hard_cells.md).", "",
        "| case | iterations | cuts | axial stress, kPa | error | what happened |", "|---|---|---|---|---|---|",
        *rows, "", "Others:", "", *others, ""])


def main():
    build = pathlib.Path(sys.argv[1])
    sections = SECTIONS + (LONG if "--long" in sys.argv[2:] else [])
    executables = {}
    for _, name, _ in sections:
        executable = next((path for path in sorted(build.rglob(name)) if path.is_file()), None)
        if executable is None:
            print(f"{name}: not built, left out", file=sys.stderr)
        else:
            executables[name] = executable
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        results = dict(zip(executables, pool.map(run, executables.values())))
    lines = ["# Verification", "",
             "Written by `docs/make_verification.py` from what the tests print; tolerances and their reasons stand in",
             "the tests. Numbers like E.4 are sections of the theory. Times are processor seconds of the whole test.", "",
             *summary_table(results), ""]
    failed = 0
    for title, name, about in sections:
        if name not in results:
            continue
        figures, cases, seconds = results[name]
        bad = [case for case, outcome in cases if outcome == "FAILED"]
        failed += len(bad)
        lines += [f"## {title}", "", f"{about} `{name}`: {len(cases)} cases, {seconds:.1f} s, "
                  + (f"**failed: {', '.join(bad)}**." if bad else "all pass."), ""]
        lines += [f"- {figure}" for figure in figures] + [""]
    folder = pathlib.Path(__file__).parent
    hard = [figure for name in ("fem_hard_cases_test", "fem_many_elements_test") if name in results
            for figure in results[name][0]]
    (folder / "hard_cases.md").write_text(hard_cases_page(hard))
    (folder / "verification.md").write_text("\n".join(lines))
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
