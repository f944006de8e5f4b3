#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Peak angles of the spheres of study 2 against void ratio, by the way their packings are made.

    python3 preparation.py -o results                                  packings that fell, 49 kPa, calibrated contacts
    python3 preparation.py -o results --ways fell pressed --pressures 4.9 9.8 49 98 392

Packings that `fell` have their bedding across the major stress, as the laboratory's; `pressed` ones are isotropic. Each friction of the
preparation leads to a void ratio of its own, measured at 4.9 kPa; each packing has a seed of its own. What is told is the straight line through
all packings with its 95 % interval, and that line at the void ratios of the laboratory's rows. What is there already is not made
again: results/preparation.
"""
import argparse
import csv
import functools
import math
import pathlib
import re
import statistics
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from intervals import Line  # noqa: E402
from study import laboratory  # noqa: E402

# Friction while packings are made, which lead to void ratios from 0.65 to 0.86.
FRICTIONS = {"fell": [0.1, 0.15, 0.22, 0.32, 0.5, 0.8], "pressed": [0.06, 0.09, 0.13, 0.19, 0.3]}
CONTACTS = {"modulus": 4.03e9, "friction": 0.495, "rolling": 0.438}  # calibrated; modulus in Pa
REST = ["inertial_number=0.05", "pressure_tolerance=5e-3", "unbalanced_force_ratio=5e-3"]
MIDDLE = 0.74  # void ratio, of the laboratory's rows


def strain_or_laboratory(text):
    return text if text == "laboratory" else float(text)


def options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True)
    parser.add_argument("--ways", nargs="+", choices=tuple(FRICTIONS), default=["fell"])
    parser.add_argument("--frictions", type=float, nargs="+", help="while packings are made [0.1 to 0.8, or 0.06 to 0.3]")
    parser.add_argument("--pressures", type=float, nargs="+", default=[49.0], help="kPa [49]")
    parser.add_argument("--packings", type=int, default=3, help="of each friction [3]")
    parser.add_argument("--grains", type=int, default=500)
    parser.add_argument("--strain", type=float, default=10.0, help="end of the tests, %% [10]")
    parser.add_argument("--until", type=strain_or_laboratory, default=math.inf, metavar="STRAIN", help="look for peaks up to this strain, %%; `laboratory`: 1.3 times that of the laboratory's peak, 3 %% at least [the end]")
    parser.add_argument("--tables", action="store_true", help="run nothing")
    parser.add_argument("--check", action="store_true", help="fail unless looser packings are weaker, and (ways fell and pressed) most contacts lie along the fall")
    parser.add_argument("--program", default="polargrain")
    return parser.parse_args()


class Study:
    def __init__(self, given):
        self.given = given
        self.folder = given.output.resolve() / "preparation"

    def call(self, *arguments, most=0):
        done = subprocess.run([self.given.program, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        if done.returncode > most:
            raise SystemExit(f"{' '.join(map(str, arguments))}\n{done.stderr}")
        return done.stdout

    def prepare(self):
        self.folder.mkdir(parents=True, exist_ok=True)
        text = (HERE / "spheres_packing.yaml").read_text()
        text = re.sub(r"(?m)^grains: .*$", f"grains: {self.given.grains}", text)
        (self.folder / "pressed.yaml").write_text(text)
        (self.folder / "fell.yaml").write_text(text + "deposition: {bedding_angle: 0}\n")
        # The largest friction of all, so that none of the packings slides under its own script.
        script = re.sub(r"(?m)^(variable +friction +index) .*$", rf"\1 {max(friction for way in self.given.ways for friction in self.frictions(way)):g}",
                        (HERE / "spheres_preparation.in").read_text())
        (self.folder / "spheres_preparation.in").write_text(script)
        script = (HERE / "spheres.in").read_text()
        for variable, value in CONTACTS.items():
            script = re.sub(rf"(?m)^(variable +{variable} +index) .*$", rf"\1 {value:g}", script)
        (self.folder / "calibrated.in").write_text(script)

    def frictions(self, way):
        return self.given.frictions or FRICTIONS[way]

    def packing(self, way, friction, number):
        """@returns name of a packing, and the seed that no other of this way has"""
        known = FRICTIONS[way]
        place = known.index(friction) if friction in known else len(known) + self.frictions(way).index(friction)
        return f"{way}-{friction:g}-{number}", 100 * place + number

    def make(self, way, friction, number):
        name, seed = self.packing(way, friction, number)
        if (self.folder / f"{name}.txt").exists():
            return
        told = self.call("pack", self.folder / f"{way}.yaml", "-o", self.folder / f"{name}.h5", "--set", f"friction={friction:g}",
                         "--set", f"seed={seed}")
        (self.folder / f"{name}.txt").write_text(told)

    def test(self, way, friction, number, pressure):
        name, _ = self.packing(way, friction, number)
        output = self.folder / f"{name}-{pressure:g}kPa"
        if pathlib.Path(f"{output}.csv").exists():
            return
        settings = [word for setting in [*REST, f"pressure={pressure:g} kPa"] for word in ("--set", setting)]
        script = self.folder / "calibrated.in"
        self.call("pack", "--settle", self.folder / f"{name}.h5", script, "-o", f"{output}.h5", "--quiet", *settings)
        self.call("element", "--test", "biaxial", "--pressure", f"{pressure:g}kPa", f"{output}.h5", script, "-o", output, "--quiet",
                  "--set", f"axial_strain={self.given.strain:g} %", "--set", f"rows={round(10 * self.given.strain)}",
                  "--set", "inertial_number=2e-3", "--set", "tolerance=1e-2", most=1)
        pathlib.Path(f"{output}.h5").unlink()

    def figures(self, way, friction, number, pressure, until):
        """The figures of one packing up to a strain (%); None while it has not been tested."""
        name, _ = self.packing(way, friction, number)
        file = self.folder / f"{name}-{pressure:g}kPa.csv"
        if not file.exists():
            return None
        told = (self.folder / f"{name}.txt").read_text()
        number_after = lambda words: float(re.search(rf"{words} +([-0-9.e]+)", told).group(1))
        with open(file, newline="") as table:
            rows = [row for row in csv.DictReader(table) if float(row["stage"]) > 0 and 100 * float(row["axial_strain"]) < until + 1e-6]
        angles = [float(row["friction_angle_deg"]) for row in rows]
        strains = [100 * float(row["axial_strain"]) for row in rows]
        volumes = [100 * float(row["volume_strain"]) for row in rows]
        peak = max(range(len(rows)), key=lambda k: angles[k])
        return {"void ratio": number_after("void ratio"), "contacts": number_after("coordination number"), "fabric": number_after("fabric"),
                "upright": abs(float(re.search(r"fabric .*? along \([^,]*, ([^,]*),", told).group(1))),
                "peak angle": angles[peak], "at strain": strains[peak], "at end": strains[peak] > 0.95 * strains[-1], "b": float(rows[peak]["b"]),
                "volume at 2 %": next((v for s, v in zip(strains, volumes) if s > 1.99), math.nan)}

    @functools.cache
    def all_figures(self, way, pressure, until=math.inf):
        found = [self.figures(way, friction, number, pressure, until) for number in range(1, self.given.packings + 1)
                 for friction in self.frictions(way)]
        return [one for one in found if one]


def line_of(found):
    """Peak angle over void ratio."""
    return Line([one["void ratio"] for one in found], [one["peak angle"] for one in found])


def until(given, row=None):
    """The strain (%) up to which a peak is looked for, of a row of the laboratory's."""
    if given.until != "laboratory":
        return given.until
    return max(3.0, 1.3 * float(row["eps_a_at_peak_pct"] or 1.5)) if row else math.inf


def tables(study):
    given = study.given
    peaks = laboratory()[1]
    text = ("| packings | side pressure, kPa | n | void ratios | slope, degrees a unit | angle at 0.74 | scatter of a packing | "
            "at strain, % | at the end of the test | volume strain at 2 %, % | fabric: largest, its direction's part along x2 |\n" + "|---" * 11 + "|\n")
    rows = ("\n| packings | side pressure, kPa | void ratio | n | angle, laboratory | predicted | difference |\n" + "|---" * 7 + "|\n")
    sums = ""
    for pressure in given.pressures:
        of_laboratory = [(float(row["void_ratio"]), float(row["phi_peak_deg"])) for row in peaks if float(row["sigma3_kPa"]) == pressure]
        if len(of_laboratory) > 2:
            line = Line(*zip(*of_laboratory))
            text += (f"| laboratory | {pressure:g} | {len(of_laboratory)} | {of_laboratory[0][0]:.3f} to {of_laboratory[-1][0]:.3f} | "
                     f"{line.slope:.0f} +- {line.half_of_slope:.0f} | {line.at(MIDDLE)[0]:.1f} +- {line.at(MIDDLE)[1]:.1f} | {line.scatter:.1f} | | | | |\n")
    for way in given.ways:
        differences = []
        for pressure in given.pressures:
            found = study.all_figures(way, pressure, until(given))
            if len(found) < 3:
                continue
            column = lambda key: [one[key] for one in found]
            line = line_of(found)
            middle = line.at(MIDDLE)
            text += (f"| {way} | {pressure:g} | {len(found)} | {min(column('void ratio')):.3f} to {max(column('void ratio')):.3f} | "
                     f"{line.slope:.0f} +- {line.half_of_slope:.0f} | {middle[0]:.1f} +- {middle[1]:.1f} | {line.scatter:.1f} | "
                     f"{statistics.mean(column('at strain')):.1f} | {sum(column('at end'))} | {statistics.mean(column('volume at 2 %')):.2f} | {statistics.mean(column('fabric')):.3f}, {statistics.mean(column('upright')):.2f} |\n")
            for row in peaks:
                if float(row["sigma3_kPa"]) != pressure:
                    continue
                found = study.all_figures(way, pressure, until(given, row))
                angle, half = line_of(found).at(float(row["void_ratio"]))
                difference = angle - float(row["phi_peak_deg"])
                fitted = (row["sigma3_kPa"], row["void_ratio"]) == ("49", "0.717")
                if not fitted:
                    differences.append(difference)
                rows += (f"| {way} | {row['sigma3_kPa']} | {row['void_ratio']} | {len(found)} | {float(row['phi_peak_deg']):.1f} | "
                         f"{angle:.1f} +- {half:.1f} | {difference:+.1f}{' (fitted)' if fitted else ''} |\n")
        if differences:
            sums += (f"\n{way}: {sum(abs(d) <= 1.5 for d in differences)} of {len(differences)} within 1.5 degrees; mean difference "
                     f"{statistics.mean(differences):+.2f}, root mean square {math.sqrt(statistics.mean(d * d for d in differences)):.2f} degrees\n")
    return text + rows + sums


def check(study):
    given = study.given
    found = {way: study.all_figures(way, given.pressures[0]) for way in given.ways}
    for way, figures in found.items():
        slope = line_of(figures).slope
        assert slope < -20, f"{way}: the peak angle changes by {slope:.0f} degrees a unit of void ratio"
    if len(found) < len(FRICTIONS):
        return
    fell, pressed = (statistics.mean(one["upright"] for one in found[way]) for way in ("fell", "pressed"))
    assert fell > 0.8 > pressed + 0.2, f"the direction of most contacts has {fell:.2f} along the fall, of pressed packings {pressed:.2f}"


def main():
    given = options()
    study = Study(given)
    if not given.tables:
        study.prepare()
        # One packing of each friction first, so that what is broken off has lines.
        for number in range(1, given.packings + 1):
            for pressure in given.pressures:
                for way in given.ways:
                    for friction in study.frictions(way):
                        study.make(way, friction, number)
                        study.test(way, friction, number, pressure)
    if given.check:
        check(study)
    text = tables(study)
    (study.folder.parent / "preparation.md").write_text(text)
    print(text)


if __name__ == "__main__":
    main()
