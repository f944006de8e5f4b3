#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Where the numbers of README.md, docs/settings.md and docs/howto come from.

Every number in their prose and tables (commands, code and keys aside) stands in a phrase of this list. The phrase names
where its number comes from: a value in the code or in a case, a kept output of a command, or the test of the page itself.
`tests/figures.py` looks all of them up again: a default that changes, or a page that does, fails.
"""
import csv
import math
import re
import sys

import pages

DIGIT = re.compile(r"(?<![\w.])\d[\d.,]*(?:e-?\d+)?")
SCOPE = ["README.md", "docs/settings.md"] + sorted(str(page.relative_to(pages.ROOT)) for page in (pages.ROOT / "docs/howto").glob("*.md"))


def text(name):
    return (pages.ROOT / name).read_text(encoding="utf-8")


def found(name, pattern):
    """The number that a pattern finds in a file."""
    match = re.search(pattern, text(name), re.S)
    if not match:
        raise LookupError(f"{name} holds no '{pattern}'")
    return float(match.group(1).replace(",", ""))


def code(name, pattern):
    return lambda: found(name, pattern)


def bench(what, column, over="as given"):
    """A figure of `polargrain bench --quick`, as docs/performance.md shows it, over that of another row."""
    def value():
        lines = [line for line in text("docs/data/performance/bench_quick.csv").splitlines() if not line.startswith("#")]
        head, *rows = csv.reader(lines)
        rows = {row[0] + (" " + row[1] if row[0].startswith("standard") else ""): row for row in rows}
        number = lambda row: float(rows[row][head.index(column)].removesuffix(" %"))
        return number(what) / number(over) if over else number(what)
    return value


def student(degrees, share=0.975):
    """The quantile of Student's t by one degree of freedom, in closed form."""
    assert degrees == 1
    return math.tan(math.pi * (share - 0.5))


DEMO = "cases/biaxial/case.yaml"
CELL = "common/cell.hpp"
# Page, words in it, where the number comes from, least and largest value that the words allow.
FIGURES = [
    ("README.md", "at 2.3 % of strain", code(DEMO, r"u2: -(\S+) mm"), 18.4, 18.4),  # of 800 mm
    ("README.md", "two of its 200 points", code(DEMO, r"elements: \[5, (\d+)\]"), 10, 10),  # with four points each
    ("README.md", "a band in 128 boxes of 500 spheres, 2 cores", code("cases/toyoura/case.yaml", r"its band, 128 boxes of (\d+) spheres"), 500, 500),
    ("README.md", "50 times fewer grain steps, 0.60 %", code("docs/studies/adaptive_scenes.md", r"load curve over its range \|  \| ([\d.]+) %"), 0.6, 0.6),
    ("README.md", "a footing on 10,080 points", code("docs/studies/adaptive_scenes.md", r"times fewer \| 10,553,767 \| 211,591, (\d+) "), 50, 50),
    ("README.md", "10 cm x 20 cm by 2 %", code("README.md", r"move: \{u2: -(\d+) mm"), 4, 4),
    ("README.md", "Make 100 grains", code("README.md", r"-o first --grains (\d+)"), 100, 100),
    ("docs/settings.md", "some six times the DEM steps", bench("reference", "DEM steps"), 5.5, 6.5),
    ("docs/settings.md", "Peaks scatter by about 10 % with 100 grains", bench("standard deviation 100 grains", "error of the peak", None), 8, 12),
    ("docs/settings.md", "(`inertial_number`, 6e-4)", code(CELL, r"inertial_number = (\S+);"), 6e-4, 6e-4),
    ("docs/settings.md", "1e-3 saves two fifths of the DEM steps", bench("loading rate", "DEM steps"), 0.55, 0.65),
    ("docs/settings.md", "raises the error of the curve by two thirds", bench("loading rate", "error of stress_ratio"), 1.6, 1.75),
    ("docs/settings.md", "at most 2.5 `lc`", code("app/remarks/lengths.hpp", r"kMostElementOverLength = ([\d.]+)"), 2.5, 2.5),
    ("docs/howto/cyclic.md", "a multiple of 4; the default is 40 per cycle", code("app/element/read_stage.cpp", r"kRowsOfCycle = (\d+)"), 40, 40),
    ("docs/howto/experiment.md", "a band at 45 degrees", code("docs/howto/experiment.md", r'\)" (\d+) 0\.03'), 45, 45),
    ("docs/howto/no-convergence.md", "`jumps` (50 with cells)", code("coupler/case/read_steps.cpp", r"\"jumps\", 0, parts.result.needs_workers\(\) \? (\d+)"), 50, 50),
    ("docs/howto/packings-interval.md", "the interval is 12.7 times the standard error", lambda: student(1), 12.65, 12.75),
    ("docs/howto/space.md", "The stress ends at 300.3 kPa", code("docs/howto/space.md", r"grep -q ',(\d+)"), 300250, 300350),
    ("docs/howto/resume.md", "Checkpoints come every ten minutes", code("coupler/case/case.hpp", r"checkpoint_minutes = ([\d.]+)"), 10, 10),
    ("docs/howto/resume.md", "with a checkpoint and status 3", code("app/commands/command_line.cpp", r"kStopped = (\d+)"), 3, 3),
    ("docs/howto/stiffness-and-steps.md", "should stay below 1 %", code("docs/howto/stiffness-and-steps.md", r"\$c > ([\d.]+)\)"), 0.01, 0.01),
    ("docs/howto/stiffness-and-steps.md", "warns above 5 %", code("common/overlap_limit.hpp", r"kMostMeanOverlap = ([\d.]+)"), 0.05, 0.05),
    ("docs/howto/stiffness-and-steps.md", "Keep `inertial_number: 6e-4`", code(CELL, r"inertial_number = (\S+);"), 6e-4, 6e-4),
    ("docs/howto/sweep.md", "Beyond 1 % of it", code("dem/cell/packing_check.hpp", r"kPressureTolerance = ([\d.]+)"), 0.01, 0.01),
    ("docs/howto/safety.md", "halves the interval to 0.01", code("app/safety/safety.hpp", r"resolution = ([\d.]+)"), 0.01, 0.01),
    ("docs/howto/verify.md", "It evaluates sixteen boxes again", code("app/run/sample.cpp", r"kMost = (\d+)"), 16, 16),
    ("docs/howto/wall.md", "32 kN/m for 2 m2 of 16 kN/m3, and the surcharge of 0.2 kPa", code("docs/howto/wall.md", r"base_force \$\)\" (\d+)"), 32400, 32400),
    ("docs/howto/wall.md", "by default it is the 1 kPa of the packing", code("docs/howto/wall.md", r"\npressure: (\d+) kPa"), 1, 1),
]
# Words whose numbers are no figures of ours: versions, counts of a list, values to choose and their reasons.
CHOSEN = {
    "README.md": ["On Debian 12", "GPL-2.0-or-later", "0.3 % in 3 increments, 0.6 % in 10", "| the same run with 1 and with 2 workers |", "| below 2e-14 |",  # tests/pages.py, made
                  "| 25 to 60 s |"],  # docs/performance.md: 46 s of processor time on two fast cores
    "docs/settings.md": ["100 grains", "400 grains", "Beyond 1e-2", "Take 5e-3 with", "1e-3 with `cell`, 1e-8 without", "about 1e-3 per step",
                         "0.6 to 0.9 `lc`"],  # sqrt(2/3) M of packings with M of 0.75 to 1.1 (docs/theory/grains.md, C.6)
    "docs/howto/calibrate.md": ["95 % intervals"],
    "docs/howto/gmsh.md": ["4 and 8 nodes, triangles with 6", "8 and 20 nodes", "tetrahedra with 10", "wedges with 15"],
    "docs/howto/internal-length.md": ["95 % intervals"],
    "docs/howto/own-sand.md": ["at least 100 discs, and 400"],
    "docs/howto/packing.md": ["0 gives the densest state"],
    "docs/howto/packings-interval.md": ["95 % interval"],
    "docs/howto/point.md": ["scale factor 1,", "from 1 to 1,"],
    "docs/howto/stiffness-and-steps.md": ["Take 100 grains to learn and 400 to show", "about 1e-3", "1e-3 with `cell`, 5e-3 with `adaptive`, and 1e-8"],
    "docs/howto/sweep.md": ["count from 0"],
}


def plain(name):
    """A page without code, keys and where its links lead to; one line of text."""
    prose = re.sub(r"\]\([^)]*\)", "]", pages.without_code(text(name)))
    return " ".join(" ".join(re.sub(r"^\d+\. ", "", line) for line in prose.splitlines()).split())


def main():
    faults, told = [], 0
    phrases = {}
    for page, words, value, least, largest in FIGURES:
        phrases.setdefault(page, []).append(words)
        try:
            number = value()
        except (LookupError, KeyError) as error:
            faults.append(f"{page}: '{words}': {error}")
            continue
        told += 1
        if not least * (1 - 1e-12) <= number <= largest * (1 + 1e-12):
            faults.append(f"{page}: '{words}': it is {number:g} now, expected {least:g} to {largest:g}")
    for page in SCOPE:
        rest = plain(page)
        for words in phrases.get(page, []) + CHOSEN.get(page, []):
            if words not in rest:
                faults.append(f"{page}: '{words}' is not there any more")
            rest = rest.replace(words, "")
        rest = re.sub(r"`[^`]*`", "", rest)
        for match in DIGIT.finditer(rest):
            faults.append(f"{page}: '{rest[max(0, match.start() - 40):match.end() + 20]}': where does {match.group(0)} come from?")
    print(f"{len(SCOPE)} pages, {told} figures looked up, {sum(map(len, CHOSEN.values()))} phrases with chosen values")
    print("\n".join(faults))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
