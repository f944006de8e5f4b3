#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Study 2, the specimen: plane strain compression at two scales into its band, with the calibrated spheres (docs/studies/toyoura.md).

    python3 specimens.py -o results                      specimens of three packings at 49 and 98 kPa, other meshes and lengths
    python3 specimens.py -o results --only '49kPa-4x8-lc2-*'
    python3 specimens.py -o results --only '*-spread*'    boxes in explicit steps, whose slips are spread over 5.4 d50
    python3 specimens.py -o results --report             tables and figure of what is there
    python3 specimens.py -o results --list

`results` is the folder of study.py, whose calibration is taken. What is there already is not made again, and a run that was broken off goes on.
Into results/spheres/specimens: a folder a specimen, with band.json; specimens.md; with --figure the picture.
"""
import argparse
import csv
import dataclasses
import fnmatch
import json
import math
import pathlib
import shutil

import study

D50 = 5.0      # mm, of the spheres (spheres_packing.yaml)
WIDTH = 90.0   # mm
HEIGHT = 180.0
END = 0.05     # axial strain
SPREAD = 5.4   # d50: of layers of discs (docs/studies/internal_length.md)
PACE = 3e-4    # of explicit steps
# Void ratio of the specimen and of its weak element, by pressure (kPa): of the two curves, and of a looser row of the peaks.
SANDS = {49: (0.716, 0.740), 98: (0.656, 0.721)}


@dataclasses.dataclass(frozen=True)
class Specimen:
    pressure: int
    across: int   # elements; twice as many along the height
    lc: float     # mm
    seed: int     # of both packings
    spread: float = 0.0  # of slips, d50: boxes themselves in explicit steps, elements of one point, and no lc

    @property
    def group(self):
        length = f"spread{self.spread:g}" if self.spread else f"lc{self.lc:g}"
        return f"{self.pressure}kPa-{self.across}x{2 * self.across}-{length}"

    @property
    def name(self):
        return f"{self.group}-seed{self.seed}"


SPECIMENS = [*(Specimen(pressure, 4, 2, seed) for seed in (1, 2, 3) for pressure in SANDS),
             *(Specimen(49, across, lc, seed) for seed in (1, 2, 3) for across, lc in ((4, 5), (4, 10), (6, 2), (6, 5), (12, 2))),
             *(Specimen(pressure, 8, 0, seed, SPREAD) for seed in range(1, 7) for pressure in SANDS)]


def options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True)
    parser.add_argument("--only", metavar="NAME,...", default="*", help="these specimens; * stands for anything")
    parser.add_argument("--list", action="store_true", help="name the specimens and end")
    parser.add_argument("--report", action="store_true", help="run nothing")
    parser.add_argument("--strain", type=float, default=100 * END, help="axial strain at the end, %%, in steps of 0.1 %% [5]")
    parser.add_argument("--grains", type=int, help="of a packing [that of the specification]")
    parser.add_argument("--figure", type=pathlib.Path, help="draw curves and strains (matplotlib)")
    parser.add_argument("--program", default="polargrain")
    parser.add_argument("--workers", type=int, default=1)
    return parser.parse_args()


class Specimens:
    def __init__(self, given):
        self.given = given
        # Of its tests nothing but the packings is needed: a few rows.
        self.study = study.Study(argparse.Namespace(output=given.output, kind="spheres", program=given.program, workers=given.workers,
                                                    grains=given.grains, strain=None, seeds=list(range(1, 7))))
        self.folder = self.study.folder / "specimens"

    def packing(self, pressure, void_ratio, seed):
        """The file of a packing, under the calibrated contacts at its pressure; made with a short test where there is none.
        @returns nothing where no packing of the seed has that void ratio"""
        name = f"specimen-{pressure}-{void_ratio:.3f}"
        self.study.run_test(name, pressure, void_ratio, 0.002, seed)
        file = self.study.tests / f"{name}-seed{seed}.csv"
        if not file.exists():
            return None
        with open(file, newline="") as table:
            packing = next(csv.DictReader(table))["packing"]
        return next((self.study.output / "packings").glob(f"*/{packing}.h5"))

    def run(self, one):
        output = self.folder / one.name
        if (output / "band.json").exists():
            return
        self.folder.mkdir(parents=True, exist_ok=True)
        shutil.copy(study.HERE / "specimen.yaml", self.study.folder)  # the script must lie beside the case
        size = WIDTH / one.across
        strain = self.given.strain / 100
        settings = [f"mesh.rectangle.elements=[{one.across}, {2 * one.across}]", f"mesh.rectangle.patch=[{size:g} mm, {size:g} mm]",
                    f"boundary.2.move.u2={-strain * HEIGHT:.10g} mm", f"boundary.3.pressure={one.pressure} kPa"]
        if not one.spread:
            settings.append(f"steps.count={round(1000 * strain)}")
        for sand, void_ratio in zip(("sand", "weak_sand"), SANDS[one.pressure]):
            packing = self.packing(one.pressure, void_ratio, one.seed)
            if packing is None:
                print(f"{one.name}: no packing of void ratio {void_ratio:g}")
                return
            if one.spread:
                settings.append(f"materials.{sand}={{model: cell, script: best.in, packing: {packing}}}")
            else:
                settings += [f"materials.{sand}.packing={packing}", f"materials.{sand}.lc={one.lc:g} mm"]
        if one.spread:
            settings += ["mesh.element=Q4R", f"continuum={{kind: cauchy, spread: {one.spread * D50:g} mm}}",
                         f"steps={{count: {round(1000 * strain)}, method: explicit, pace: {PACE:g}}}"]
        command = ["run", self.study.folder / "specimen.yaml", "-o", output, "--checkpoint-minutes", 2, "--quiet",
                   *(word for setting in settings for word in ("--set", setting))]
        if (output / "checkpoint.h5").exists():
            command.append("--resume")
        if self.study.command(*command, "-w", self.given.workers):
            print(f"{one.name} did not come to its end")
            return
        # Most of what follows the peak, at about 2.4 %.
        self.study.command("band", output, "--from", 0.6 * strain, "--to", strain, "--fields", output / "samples.csv")

    def curve(self, one):
        file = self.folder / one.name / "history.csv"
        if not file.exists():
            return None
        with open(file, newline="") as table:
            rows = list(csv.DictReader(table))
        column = {name: [float(row[name]) for row in rows] for name in ("axial_strain", "volume_strain", "top_force")}
        column["stress_ratio"] = [-force / (1e-3 * WIDTH * 1e3 * one.pressure) for force in column["top_force"]]
        return column

    def figures(self, one):
        """The row of a specimen in the table; nothing where there is no band.json."""
        file, curve = self.folder / one.name / "band.json", self.curve(one)
        if curve is None or not file.exists():
            return None
        band = json.loads(file.read_text())
        strain, ratio, volume = curve["axial_strain"], curve["stress_ratio"], curve["volume_strain"]
        peak = max(range(len(ratio)), key=lambda k: ratio[k])
        low, high = max(0, peak - 4), min(len(ratio) - 1, peak + 4)
        dilatancy = (volume[high] - volume[low]) / (strain[high] - strain[low]) if high > low else math.nan
        angle = math.degrees(math.asin((ratio[peak] - 1) / (ratio[peak] + 1)))
        psi = math.degrees(math.asin(dilatancy / (2 + dilatancy)))

        def number(key, factor):
            return factor * band[key] if band["found"] and band.get(key) is not None else math.nan

        return {"angle": angle, "strain": 100 * strain[peak], "last": ratio[-1], "volume": 100 * volume[-1],
                "onset": number("onset_strain", 100), "inclination": number("inclination_degrees", 1), "thickness": number("thickness", 1000 / D50),
                "Roscoe": 45 + psi / 2, "Arthur": 45 + (angle + psi) / 4, "Coulomb": 45 + angle / 2}

    def table(self):
        keys = (("angle", "angle at peak", 1), ("strain", "strain at peak, %", 1), ("last", "last ratio", 2), ("volume", "last volume strain, %", 2),
                ("onset", "onset of a band, %", 1), ("inclination", "inclination, degrees", 1), ("Roscoe", "Roscoe", 1), ("Arthur", "Arthur", 1),
                ("Coulomb", "Mohr-Coulomb", 1), ("thickness", "thickness, d50", 1))
        text = "| specimen | n | " + " | ".join(title for _, title, _ in keys) + " |\n|" + "---|" * (len(keys) + 2) + "\n"
        for group in dict.fromkeys(one.group for one in SPECIMENS):
            found = [figures for figures in (self.figures(one) for one in SPECIMENS if one.group == group) if figures]
            if found:
                text += f"| {group} | {len(found)} | " + " | ".join(study.shown([f[key] for f in found], digits) for key, _, digits in keys) + " |\n"
        return text


def draw(specimens, file):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    curves, _ = study.laboratory()
    shown = [one for one in SPECIMENS if (specimens.folder / one.name / "samples.csv").exists()]
    figure, axes = plt.subplots(1, 2 + min(3, len(shown)), figsize=(15, 5), layout="constrained")
    for axis, pressure, name in ((axes[0], 49, "TATS86-16a"), (axes[1], 98, "LT88-9-HW1.9")):
        for one in SPECIMENS:
            curve = specimens.curve(one)
            if one.pressure == pressure and curve:
                axis.plot([100 * e for e in curve["axial_strain"]], curve["stress_ratio"], lw=1, label=one.name)
        points = [(float(r["eps_a_pct"]), float(r["sigma1_over_sigma3"])) for r in curves if r["id"] == name and r["sigma1_over_sigma3"]]
        axis.plot(*zip(*points), "ko", ms=4, label="laboratory")
        axis.set(xlabel="axial strain, %", ylabel="stress ratio", xlim=(0, 100 * END), title=f"{pressure} kPa")
        axis.legend(fontsize=7)
    for axis, one in zip(axes[2:], shown):
        with open(specimens.folder / one.name / "samples.csv", newline="") as table:
            rows = list(csv.DictReader(line for line in table if not line.startswith("#")))
        x, y, shear = ([float(row[name]) for row in rows] for name in ("x", "y", "shear"))
        colour = axis.tricontourf([1000 * v for v in x], [1000 * v for v in y], [100 * v for v in shear], 20)
        figure.colorbar(colour, ax=axis, label="shear strain behind the peak, %")
        axis.set(title=one.name, aspect="equal", xlabel="mm")
    figure.savefig(file, dpi=80)


def main():
    given = options()
    chosen = [one for one in SPECIMENS if any(fnmatch.fnmatch(one.name, pattern) for pattern in given.only.split(","))]
    if given.list:
        print("\n".join(one.name for one in chosen))
        return
    specimens = Specimens(given)
    if not (specimens.study.folder / "best.in").exists():
        raise SystemExit(f"{specimens.study.folder} has no best.in: run study.py -o {given.output} first")
    if not given.report:
        for one in chosen:
            specimens.run(one)
    text = specimens.table()
    (specimens.study.folder / "specimens.md").write_text(text)
    print(text)
    if given.figure:
        draw(specimens, given.figure)


if __name__ == "__main__":
    main()
