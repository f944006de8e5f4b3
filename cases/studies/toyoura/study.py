#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Study 2: Toyoura sand calibrated on one plane strain compression test, all others predicted (docs/studies/toyoura.md).

    python3 study.py -o results --kind spheres            calibration, 23 tests with three packings each, tables
    python3 study.py -o results --kind discs
    python3 study.py -o results --tables --figure toyoura.png      tables and figure alone, of what is there
    python3 study.py -o quick --grains 60 --seeds 1 --evaluations 8 --tests 2 --strain 1   to see that it works

What is there already is not made again, so that the same command goes on where it was broken off: results/packings (shared),
results/KIND (what `polargrain calibrate` left), results/KIND/tests (curves), results/KIND.md (tables).
"""
import argparse
import csv
import math
import pathlib
import re
import statistics
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from intervals import mean_and_half, shown  # noqa: E402
SAND = (0.605, 0.977)    # least and largest void ratio of the sand (Lam and Tatsuoka 1988)
DISCS = (0.20, 0.36)     # of the discs, friction 0.03 to 0.5
LARGE = 0.30             # axial strain of the one test to large strain
PEAKS = 0.10             # of the predicted peaks: loose cells harden for longer than the sand, which has a band by then
LONG = 0.065             # axial strain of the tests that the laboratory's curves belong to


def options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True)
    parser.add_argument("--kind", choices=("spheres", "discs"), default="spheres")
    parser.add_argument("--seeds", type=int, nargs="+", default=[1, 2, 3], help="packings of each test [1 2 3]")
    parser.add_argument("--grains", type=int, help="of a packing [that of the specification]")
    parser.add_argument("--evaluations", type=int, help="most of the search [that of the specification]")
    parser.add_argument("--tests", type=int, help="so many of the predicted tests only")
    parser.add_argument("--strain", type=float, help="end of all tests, %%")
    parser.add_argument("--tables", action="store_true", help="run nothing")
    parser.add_argument("--figure", type=pathlib.Path, help="draw curves and peaks over the laboratory's (matplotlib)")
    parser.add_argument("--program", default="polargrain")
    parser.add_argument("--workers", type=int, default=1)
    return parser.parse_args()


def laboratory():
    """The table's rows: of curves, and of peaks."""
    with open(HERE / "laboratory.csv", newline="") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return [row for row in rows if not row["phi_peak_deg"]], [row for row in rows if row["phi_peak_deg"]]


def predicted_tests():
    """Name, pressure (kPa), void ratio, axial strain: the two curves, of which the first was calibrated up to its peak,
    and the peaks of the table."""
    tests = [("TATS86-16a", 49.0, 0.716, LONG), ("LT88-9-HW1.9", 98.0, 0.656, LONG)]
    for row in laboratory()[1]:
        tests.append((f"peak-{row['sigma3_kPa']}-{row['void_ratio']}", float(row["sigma3_kPa"]), float(row["void_ratio"]), PEAKS))
    return tests


class Study:
    def __init__(self, given):
        self.given = given
        self.output = given.output.resolve()
        self.folder = self.output / given.kind
        self.tests = self.folder / "tests"
        self.specification = self.output / "specification"

    def command(self, *arguments):
        return subprocess.run([self.given.program, *map(str, arguments)]).returncode

    def call(self, *arguments):
        return self.command(*arguments, "-w", self.given.workers, "--packings", self.output / "packings")

    def prepare(self):
        """The files beside this one, with other numbers where they are asked for."""
        self.tests.mkdir(parents=True, exist_ok=True)
        self.specification.mkdir(exist_ok=True)
        for file in [*HERE.glob("*.in"), *HERE.glob("*.yaml"), HERE / "laboratory.csv"]:
            text = file.read_text()
            if self.given.grains and file.name.endswith("_packing.yaml"):
                text = re.sub(r"(?m)^grains: .*$", f"grains: {self.given.grains}", text)
            if self.given.grains and file.name == f"{self.given.kind}.yaml":
                seeds = ", ".join(map(str, self.given.seeds))
                text = re.sub(r"seeds: \[[^]]*\]", f"seeds: [{seeds}], void_ratio_tolerance: 0.05", text)
            (self.specification / file.name).write_text(text)

    def calibrate(self):
        if (self.folder / "best.in").exists():
            return
        arguments = ["calibrate", self.specification / "laboratory.csv", self.specification / f"{self.given.kind}.yaml",
                     "-o", self.folder]
        if self.given.evaluations:
            arguments += ["--set", f"evaluations={self.given.evaluations}"]
        if self.call(*arguments) > 1:  # 1: not converged, which its summary says
            raise SystemExit("the calibration did not run")

    def void_ratio(self, sand):
        """Of the packing: the sand's, or for discs that of the same relative density."""
        if self.given.kind == "spheres":
            return sand
        return DISCS[0] + (sand - SAND[0]) / (SAND[1] - SAND[0]) * (DISCS[1] - DISCS[0])

    def run_test(self, name, pressure, void_ratio, strain, seed, row=1e-3, control="inertial_number: 2e-3\ntolerance: 1e-2\n"):
        output = self.tests / f"{name}-seed{seed}"
        if pathlib.Path(f"{output}.csv").exists():
            return
        if self.given.strain:
            strain = self.given.strain / 100
        tolerance = ", void_ratio_tolerance: 0.05" if self.given.grains else ""
        text = f"""packing: {{specification: {self.specification}/{self.given.kind}_packing.yaml, seeds: [{seed}]{tolerance}}}
void_ratio: {self.void_ratio(void_ratio):.4f}
script: best.in
test: biaxial
pressure: {pressure:g} kPa
axial_strain: {strain:.5g}
rows: {round(strain / row)}
{control}"""
        specification = self.folder / f"{name}-seed{seed}.yaml"  # a script must lie beside what names it
        specification.write_text(text)
        if self.call("element", specification, "-o", output, "--quiet") > 1:
            raise SystemExit(f"the test {name} did not run")

    def curve(self, name, seed):
        file = self.tests / f"{name}-seed{seed}.csv"
        if not file.exists():
            return None
        with open(file, newline="") as table:
            rows = [row for row in csv.DictReader(table) if float(row["stage"]) > 0]
        columns = ["axial_strain", "volume_strain", "stress_ratio", "friction_angle_deg", "void_ratio"]
        curve = {column: [float(row[column]) for row in rows] for column in columns}
        curve["b"] = [float(row["b"]) for row in rows] if rows and "b" in rows[0] else []
        return curve

    def figures(self, name):
        """Of each packing that has a curve: what the tables hold."""
        found = []
        for seed in self.given.seeds:
            curve = self.curve(name, seed)
            if curve is None or len(curve["axial_strain"]) < 2:
                continue
            strain, ratio = curve["axial_strain"], curve["stress_ratio"]
            peak = max(range(len(strain)), key=lambda k: curve["friction_angle_deg"][k])
            half = max(1, round(0.002 / (strain[1] - strain[0])))  # dilatancy over 0.4 % of strain
            slopes = [(curve["volume_strain"][k + half] - curve["volume_strain"][k - half]) / (strain[k + half] - strain[k - half])
                      for k in range(half, len(strain) - half)]
            at_six = [k for k in range(len(strain)) if abs(strain[k] - 0.06) < 1e-9]
            late = [ratio[k] for k in range(len(strain)) if strain[k] >= 0.05 - 1e-9]
            found.append({"angle": curve["friction_angle_deg"][peak], "strain": 100 * strain[peak], "start": curve["void_ratio"][0],
                          "dilatancy": max(slopes, default=math.nan), "b": curve["b"][peak] if curve["b"] else math.nan,
                          "residual": statistics.mean(late) if late else math.nan,
                          "volume": 100 * curve["volume_strain"][at_six[0]] if at_six else math.nan})
        return found


    def run_large(self, seed):
        """The calibrated test to a strain at which nothing changes any more, at twice the rate and error."""
        self.run_test("large", 49.0, 0.716, LARGE, seed, 2e-3,
                      "inertial_number: 4e-3\ntolerance: 2e-2\nlargest_increment: 2e-3\n")


def of_a_band(curve, softening=0.019):
    """What a specimen would show if from the peak on all strain went into a share of its height, the rest standing still: that
    share from the strain `softening` over which the laboratory's ratio falls to its plateau; then the plateau and the volume strain that
    come with it. The plateau is the mean beyond 22 % of strain; it is reached where the mean over 4 % of strain first is that low."""
    strain, ratio, volume = curve["axial_strain"], curve["stress_ratio"], curve["volume_strain"]
    peak = max(range(len(ratio)), key=lambda k: ratio[k])
    late = [value for at, value in zip(strain, ratio) if at >= 0.22]
    plateau = statistics.mean(late)
    smooth = [statistics.mean(ratio[max(0, k - 10):k + 11]) for k in range(len(ratio))]
    reached = next(k for k in range(peak, len(ratio)) if smooth[k] <= 1.05 * plateau)
    share = softening / (strain[reached] - strain[peak])
    return plateau, statistics.stdev(late), strain[reached], share, share * (volume[reached] - volume[peak])


def tables(study):
    peaks = laboratory()[1]
    by_name = {f"peak-{row['sigma3_kPa']}-{row['void_ratio']}": row for row in peaks}
    lines = ["| side pressure, kPa | void ratio | n | angle, laboratory | predicted | difference | strain at peak, % | predicted | dilatancy | b |",
             "|---|---|---|---|---|---|---|---|---|---|"]
    within = counted = 0
    differences = []
    for name, _, _, _ in predicted_tests():
        found = study.figures(name)
        row = by_name.get(name)
        if row is None or not found:
            continue
        angle = float(row["phi_peak_deg"])
        difference = mean_and_half([one["angle"] for one in found])[0] - angle
        fitted = (row["sigma3_kPa"], row["void_ratio"]) == ("49", "0.717")  # the density of the test that was calibrated
        if not fitted:
            counted += 1
            within += abs(difference) <= 1.5
            differences.append(difference)
        lines.append(f"| {row['sigma3_kPa']} | {row['void_ratio']} | {len(found)} | {angle:.1f} | {shown([f['angle'] for f in found], 1)} | "
                     f"{difference:+.1f}{' (fitted)' if fitted else ''} | {row['eps_a_at_peak_pct'] or '-'} | {shown([f['strain'] for f in found], 1)} | "
                     f"{shown([f['dilatancy'] for f in found], 2)} | {shown([f['b'] for f in found], 2)} |")
    text = "\n".join(lines) + "\n"
    if differences:
        text += (f"\n{within} of {counted} within 1.5 degrees; mean difference {statistics.mean(differences):+.2f}, root mean square "
                 f"{math.sqrt(statistics.mean(d * d for d in differences)):.2f} degrees\n")
    text += "\n| test | n | angle at peak | strain at peak, % | largest dilatancy | b at peak | mean ratio behind 5 % | volume strain at 6 %, % |\n|---|---|---|---|---|---|---|---|\n"
    for name in ("TATS86-16a", "LT88-9-HW1.9"):
        found = study.figures(name)
        if found:
            text += (f"| {name} | {len(found)} | " + " | ".join(shown([f[key] for f in found], digits) for key, digits in
                     (("angle", 1), ("strain", 1), ("dilatancy", 2), ("b", 2), ("residual", 2), ("volume", 2))) + " |\n")
    for seed in study.given.seeds:
        curve = study.curve("large", seed)
        if curve and curve["axial_strain"][-1] > 0.25:
            plateau, scatter, strain, share, volume = of_a_band(curve)
            text += (f"\nTo large strain, seed {seed}: ratio {plateau:.2f} beyond 22 % (it goes up and down by {scatter:.2f}), reached at {100 * strain:.0f} %. If a band takes "
                     f"all strain behind the peak, it is {100 * share:.1f} % of the height, and the specimen expands by {100 * volume:.2f} % while it softens.\n")
    return text


def draw(study, file):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    curves, peaks = laboratory()
    figure, axes = plt.subplots(2, 3, figsize=(13, 7.5), layout="constrained")
    for column, (name, title) in enumerate((("TATS86-16a", "49 kPa, void ratio 0.716: fitted up to the peak"),
                                            ("LT88-9-HW1.9", "98 kPa, void ratio 0.656: predicted"))):
        for row, (ours, theirs, factor, label) in enumerate((
                ("stress_ratio", "sigma1_over_sigma3", 1, "stress ratio"),
                ("volume_strain", "eps_v_pct_dilation_negative", -1, "volume strain, %, expansion positive"))):
            axis = axes[row][column]
            points = [(float(r["eps_a_pct"]), factor * float(r[theirs])) for r in curves if r["id"] == name and r[theirs]]
            for seed in study.given.seeds:
                curve = study.curve(name, seed)
                if curve:
                    axis.plot([100 * e for e in curve["axial_strain"]], [(100 if row else 1) * v for v in curve[ours]],
                              label=f"cell of seed {seed}")
            axis.plot(*zip(*points), "ko", ms=4, label="laboratory")
            axis.set(xlabel="axial strain, %", ylabel=label, xlim=(0, 100 * LONG), title=title if row == 0 else "")
        axes[0][column].legend()
    colours = {"4.9": "C0", "9.8": "C1", "49": "C2", "98": "C3", "392": "C4"}
    for row in peaks:
        colour = colours[row["sigma3_kPa"]]
        void_ratio, found = float(row["void_ratio"]), study.figures(f"peak-{row['sigma3_kPa']}-{row['void_ratio']}")
        for axis, theirs, ours in ((axes[0][2], "phi_peak_deg", "angle"), (axes[1][2], "eps_a_at_peak_pct", "strain")):
            if row[theirs]:
                axis.plot(void_ratio, float(row[theirs]), "o", color=colour, mfc="none")
            axis.plot([void_ratio] * len(found), [one[ours] for one in found], "x", color=colour)
    for pressure, colour in colours.items():
        axes[0][2].plot([], [], "s", color=colour, label=f"{pressure} kPa")
    axes[0][2].set(xlabel="void ratio at 4.9 kPa", ylabel="peak friction angle, degrees", title="o laboratory, x predicted, each packing")
    axes[1][2].set(xlabel="void ratio at 4.9 kPa", ylabel="axial strain at the peak, %")
    axes[0][2].legend()
    figure.savefig(file, dpi=80)


def main():
    given = options()
    study = Study(given)
    if not given.tables:
        study.prepare()
        study.calibrate()
        tests = predicted_tests()
        # One packing of every test first, so that a run that is broken off has all tests.
        for seed in given.seeds:
            for name, pressure, void_ratio, strain in tests[:given.tests]:
                study.run_test(name, pressure, void_ratio, strain, seed)
        if given.kind == "spheres" and not given.tests:
            study.run_large(given.seeds[0])
    text = tables(study)
    (study.output / f"{given.kind}.md").write_text(text)
    print(text)
    if given.figure:
        draw(study, given.figure)


if __name__ == "__main__":
    main()
