#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""How the bands of study 1 turn: inclination and dilatancy of bands, in increments of axial strain.

    python3 biaxial_inclination.py RESULTS informed-8x16 grains-800 [--current] [--programs FOLDER...]

RESULTS: what biaxial.py left; then the groups, as its table names them. A band between two halves that do not strain leaves its own direction as
long as it is. Where its principal strains are those of the specimen, upright and level, that is Roscoe's angle, 45 degrees and half of
the angle of dilatancy. A band that lies steeper has principal strains that lean.
"""
import argparse
import json
import math
import pathlib
import tempfile

from built_package import polargrain  # noqa: F401 (finds the package)
from intervals import shown
from polargrain.table import read_table
from runs import Failed, Programs

INCREMENTS = [(0.025, 0.03), (0.03, 0.035), (0.035, 0.04), (0.04, 0.05), (0.05, 0.06), (0.06, 0.08), (0.04, 0.08)]


def dilatancy(samples, band):
    """Angle of dilatancy in a band, degrees: its sine is volume strain over shear strain, both summed over what lies within half of its thickness.

    samples -- columns x, y, area, shear, volume_strain; band -- what `polargrain band` found
    @returns nan where nothing lies in the band
    """
    angle = math.radians(band["inclination_degrees"])
    centre = band["centre"]
    inside = abs(math.cos(angle) * (samples["y"] - centre[1]) - math.sin(angle) * (samples["x"] - centre[0])) < 0.5 * band["thickness"]
    shear, volume = ((samples["area"] * samples[key])[inside].sum() for key in ("shear", "volume_strain"))
    return math.degrees(math.asin(max(-1.0, min(1.0, volume / shear)))) if shear > 0.0 else math.nan


def measure(programs, folder, scratch, increment, words):
    """@returns inclination and angle of dilatancy of the band in an increment, degrees; nothing without a band"""
    place = pathlib.Path(scratch) / folder.name  # the ruler leaves its file beside the fields; the study's own stays
    place.mkdir(exist_ok=True)
    for name in ("grains", "fields", "history.csv"):
        if (folder / name).exists() and not (place / name).exists():
            (place / name).symlink_to((folder / name).resolve())
    try:
        programs.call(place / "log", programs.find("polargrain"), "band", place, "--from", increment[0], "--to", increment[1], "--fields",
                      place / "samples.csv", *words)
    except Failed as failure:
        raise SystemExit(str(failure)) from failure
    band = json.loads((place / "band.json").read_text(encoding="utf-8"))
    if not band["found"]:
        return None
    return abs(band["inclination_degrees"]), dilatancy(read_table(place / "samples.csv"), band)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", type=pathlib.Path, metavar="RESULTS")
    parser.add_argument("groups", nargs="+", metavar="GROUP")
    parser.add_argument("--current", action="store_true", help="measure where places are when an increment begins, not at the start")
    parser.add_argument("--programs", type=pathlib.Path, nargs="+", metavar="FOLDER", help="where polargrain is [build/release/app]")
    options = parser.parse_args()
    programs = Programs(options.programs)
    print("| group | axial strain, % | n | inclination, degrees | dilatancy | Roscoe | steeper by |\n" + "|---" * 7 + "|")
    with tempfile.TemporaryDirectory() as scratch:
        for group in options.groups:
            ending = "seed" if group.split("-")[0] in ("grains", "rough") else "pair"
            folders = sorted(path.parent for path in options.results.glob(f"{group}-{ending}*/history.csv")
                             if path.parent.name.removeprefix(f"{group}-{ending}").isdigit())
            if not folders:
                raise SystemExit(f"biaxial_inclination.py: {options.results} has no results of {group}; biaxial.py --only '{group}-*' makes them")
            for increment in INCREMENTS:
                found = [measure(programs, folder, scratch, increment, ["--current"] * options.current) for folder in folders]
                found = [one for one in found if one is not None]
                inclinations, angles = ([one[key] for one in found] for key in (0, 1))
                print(f"| {group} | {100 * increment[0]:g} to {100 * increment[1]:g} | {len(found)} of {len(folders)} | {shown(inclinations, 1)} | "
                      f"{shown(angles, 1)} | {shown([45 + angle / 2 for angle in angles], 1)} | "
                      f"{shown([one - 45 - angle / 2 for one, angle in found], 1)} |", flush=True)


if __name__ == "__main__":
    main()
