#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes docs/verification.md and docs/hard_cases.md from what the tests print.

Usage: docs/make_verification.py BUILD_FOLDER

Runs every test executable whose name is given in SECTIONS and collects the lines that begin with "[figure]" and the
time and outcome of each test case. A figure is printed by the test beside the check it belongs to, so the page
cannot say anything the tests have not measured.
"""
import pathlib
import re
import subprocess
import sys

SECTIONS = [
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
    ("Newton's method", "fem_solver_test", "Work balance, quadratic rate, steps that are cut."),
]


def run(executable):
    """Figures and (name, outcome, milliseconds) of the cases of one test executable."""
    result = subprocess.run([executable], capture_output=True, text=True, check=False)
    figures = re.findall(r"^\[figure\] (.*)$", result.stdout, re.M)
    cases = re.findall(r"^\[ +(OK|FAILED) +\] (\S+?),?(?: where .*)? \((\d+) ms\)$", result.stdout, re.M)
    return figures, [(name, outcome, int(time)) for outcome, name, time in cases]


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
        "Written by `docs/make_verification.py` from `fem_hard_cases_test`: biaxial compression or extension of a block,",
        "ten steps a leg. The error is relative to the Mohr-Coulomb stress at which a homogeneous block must end; there is",
        "none where friction at the platens or a stop leaves no exact answer.", "",
        "| case | iterations | cuts | axial stress, kPa | error | what happened |", "|---|---|---|---|---|---|",
        *rows, "", "Others:", "", *others, ""])


def main():
    build = pathlib.Path(sys.argv[1])
    lines = ["# Verification", "",
             "Written by `docs/make_verification.py` from what the tests print; tolerances and their reasons stand in",
             "the tests. Numbers like E.4 are sections of the theory.", ""]
    failed = 0
    for title, name, about in SECTIONS:
        executable = next((path for path in sorted(build.rglob(name)) if path.is_file()), None)
        if executable is None:
            print(f"{name}: not built, left out", file=sys.stderr)
            continue
        figures, cases = run(executable)
        bad = [case for case, outcome, _ in cases if outcome == "FAILED"]
        failed += len(bad)
        seconds = sum(time for _, _, time in cases) / 1000
        lines += [f"## {title}", "", f"{about} `{name}`: {len(cases)} cases, {seconds:.1f} s, "
                  + (f"**failed: {', '.join(bad)}**." if bad else "all pass."), ""]
        lines += [f"- {figure}" for figure in figures] + [""]
        if name == "fem_hard_cases_test":
            (pathlib.Path(__file__).parent / "hard_cases.md").write_text(hard_cases_page(figures))
    (pathlib.Path(__file__).parent / "verification.md").write_text("\n".join(lines))
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
