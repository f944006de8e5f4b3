#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""How much of the thickness of a shear band is the camera's: specimens of grains measured by their own displacements, and by
image correlation of pictures of them, with one ruler (docs/studies/camera.md).

    python3 camera.py -o RESULTS SPECIMEN...       folders of liggghts_inputs/specimen/specimen.py
    python3 camera.py -o RESULTS --table            the tables and the figure alone, of what is there

Each specimen is drawn as textured discs, a picture every 0.25 % of axial strain, from 4 to 8 %. Square subsets are followed from
picture to picture by the peak of their correlation (scikit-image), and `polargrain band` measures the sum of their ways. The same
grains moved as is known tell what camera and ruler make of it: a slit (cut along a line and slid) and a smooth band. What is there
already is not made again. Needs scikit-image (Debian: python3-skimage), scipy, matplotlib.
"""
import argparse
import csv
import json
import math
import pathlib
import subprocess

import numpy
import scipy.ndimage
from skimage.registration import phase_cross_correlation

from intervals import interval

DIAMETER = 0.01            # m, d50
PIXELS = 16                # of a mean diameter
SUBSETS = (1.5, 3, 6)      # sides, mean diameters
STEP = 1.0                 # distance of the places, mean diameters
NEIGHBOURHOOD = 0.025      # m, radius that strains are taken from, of grains and places alike
FROM, TO, APART = 0.04, 0.08, 0.0025
NOISE = 2.0                # of the camera, grey levels of 256, standard deviation
LEAST = 0.4                # correlation of two subsets below which there is no displacement
INCLINATION = math.radians(55.0)   # of slit and smooth band
SLIDES = {"slit": 0.01, "smooth": 0.02}  # m, along the band
SMOOTH = 6.0               # width of the smooth band's shear at half maximum, mean diameters
KNOWN_PICTURES = 9


class Picture:
    """Draws discs; each has its own texture, which turns with it."""

    def __init__(self, low, high):
        self.low = low
        self.scale = PIXELS / DIAMETER
        self.shape = tuple(int(math.ceil(side * self.scale)) for side in (high - low)[::-1])
        noise = numpy.random.default_rng(20).normal(size=(1024, 1024))
        texture = scipy.ndimage.gaussian_filter(noise, 4.0, mode="wrap")  # 2 pixels of the picture
        self.texture = scipy.ndimage.spline_filter(texture / texture.std(), mode="grid-wrap")
        self.offsets = numpy.random.default_rng(21).uniform(0, 1024, size=(100000, 2))
        self.greys = numpy.random.default_rng(23).normal(130.0, 20.0, size=100000)  # no two grains are as bright
        self.noise = numpy.random.default_rng(22)

    def of(self, grains):
        """@param grains rows of id, x, y, radius, rotation @returns grey levels, row 0 at the bottom"""
        fine = numpy.zeros((2 * self.shape[0], 2 * self.shape[1]))  # four points a pixel
        scale = 2.0 * self.scale
        for name, x, y, radius, turned in grains:
            x, y, radius = (x - self.low[0]) * scale - 0.5, (y - self.low[1]) * scale - 0.5, radius * scale
            columns = numpy.arange(max(0, math.ceil(x - radius)), min(fine.shape[1] - 1, math.floor(x + radius)) + 1)
            rows = numpy.arange(max(0, math.ceil(y - radius)), min(fine.shape[0] - 1, math.floor(y + radius)) + 1)
            if not len(columns) or not len(rows):
                continue
            dx, dy = numpy.meshgrid(columns - x, rows - y)
            inside = dx * dx + dy * dy < radius * radius
            own = [math.cos(turned) * dx + math.sin(turned) * dy, math.cos(turned) * dy - math.sin(turned) * dx]
            at = [part[inside] + offset for part, offset in zip(own, self.offsets[int(name)])]
            grey = self.greys[int(name)] + 30.0 * scipy.ndimage.map_coordinates(self.texture, at, prefilter=False, mode="grid-wrap")
            fine[rows[0]:rows[-1] + 1, columns[0]:columns[-1] + 1][inside] = grey
        picture = fine.reshape(self.shape[0], 2, self.shape[1], 2).mean(axis=(1, 3))
        picture += self.noise.normal(scale=NOISE, size=picture.shape)
        return numpy.clip(numpy.round(picture), 0, 255)


def correlation(first, second):
    """Of two subsets as large, 1: they are alike."""
    first, second = first - first.mean(), second - second.mean()
    return float((first * second).sum() / max(1e-12, math.sqrt((first**2).sum() * (second**2).sum())))


def follow(before, after, place, side):
    """Way of the subset around a place (column, row of the first picture), pixels; None: it is not found again.
    First whole pixels; then the subset of the second picture is moved by them, so that both show the same."""
    half = side // 2
    start = numpy.round(place).astype(int)
    reference = before[start[1] - half:start[1] + half, start[0] - half:start[0] + half]
    window = numpy.hanning(2 * half + 2)[1:-1]
    window = numpy.outer(window, window)
    moved = numpy.zeros(2, dtype=int)
    for upsampling in (1, 20):
        at = start + moved
        seen = after[at[1] - half:at[1] + half, at[0] - half:at[0] + half]
        if (at < half).any() or reference.shape != window.shape or seen.shape != window.shape:
            return None
        shift, _, _ = phase_cross_correlation((seen - seen.mean()) * window, (reference - reference.mean()) * window,
                                              upsample_factor=upsampling, normalization=None)
        if upsampling == 1:
            moved = moved + numpy.round(shift[::-1]).astype(int)
    if correlation(reference, seen) < LEAST or numpy.abs(shift).max() > 1.5:
        return None
    return moved + shift[::-1]


def track(pictures, side):
    """Places of the first picture, and their ways to the last; nan where one was lost. Pixels."""
    step, rim = STEP * PIXELS, side // 2 + 2
    inside = pictures[0] > 40
    rows = numpy.where(inside.mean(axis=1) > 0.3)[0]
    columns = numpy.where(inside.mean(axis=0) > 0.3)[0]
    places = numpy.array([(x, y) for y in numpy.arange(rows[0] + rim, rows[-1] - rim + 1e-9, step)
                          for x in numpy.arange(columns[0] + rim, columns[-1] - rim + 1e-9, step)])
    ways = numpy.zeros_like(places)
    for before, after in zip(pictures, pictures[1:]):
        for k, (place, way) in enumerate(zip(places, ways)):
            if numpy.isfinite(way[0]):
                found = follow(before, after, place + way, side)
                ways[k] = numpy.nan if found is None else way + found
    return places, ways


def read_dump(file):
    with open(file) as text:
        for line in text:
            if line.startswith("ITEM: ATOMS"):
                names = line.split()[2:]
                break
        rows = numpy.loadtxt(text)
    rows = rows[:, [names.index(name) for name in ("id", "x", "y", "radius", "f_turned")]]
    return rows[numpy.argsort(rows[:, 0])]


def states_of(folder):
    """Grains at the strains of the pictures."""
    with open(folder / "history.csv", newline="") as table:
        strains = {int(row["step"]): float(row["axial_strain"]) for row in csv.DictReader(table)}
    files = {int(file.stem.split("-")[1]): file for file in folder.glob("grains/step-*.dump")}
    wanted = numpy.arange(FROM, TO + 1e-9, APART)
    return [read_dump(files[min(files, key=lambda step: abs(strains.get(step, 0.0) - strain))]) for strain in wanted]


def known_band(grains, kind):
    """The grains moved bit by bit as is known: along a line that cuts them, or by a tanh across a smooth band, turning with it."""
    middle = 0.5 * (grains[:, 1:3].min(axis=0) + grains[:, 1:3].max(axis=0))
    along = numpy.array([math.cos(INCLINATION), math.sin(INCLINATION)])
    away = (grains[:, 2] - middle[1]) * along[0] - (grains[:, 1] - middle[0]) * along[1]
    scale = SMOOTH * DIAMETER / (2.0 * math.acosh(math.sqrt(2.0)))
    share, slope = (away > 0, 0.0 * away) if kind == "slit" else (0.5 * numpy.tanh(away / scale), 0.5 / scale / numpy.cosh(away / scale)**2)
    states = []
    for part in numpy.linspace(0.0, 1.0, KNOWN_PICTURES):
        state = grains.copy()
        state[:, 1:3] -= part * SLIDES[kind] * numpy.outer(share, along)
        state[:, 4] += 0.5 * part * SLIDES[kind] * slope  # half the shear: the field's own rotation
        states.append(state)
    return states


def write_field(file, places, ways):
    with open(file, "w") as out:
        out.write("x,y,u,v\n")
        for place, way in zip(places, ways):
            out.write(",".join(f"{value:.9g}" for value in (*place, *way)) + "\n")


def measure(program, field):
    """@returns band.json of the field; the samples go beside it"""
    subprocess.run([program, "band", str(field), "--neighbourhood", str(NEIGHBOURHOOD), "--fields",
                    str(field.with_suffix(".samples"))], check=True, stdout=subprocess.DEVNULL)
    return json.loads(field.with_suffix(".band.json").read_text())


def make(given, states, name):
    """Fields of the grains themselves and of the camera with each subset, each measured."""
    places = states[0][:, 1:3]
    truth = given.output / f"{name}-grains.csv"
    if not truth.exists():
        write_field(truth, places, states[-1][:, 1:3] - places)
        measure(given.program, truth)
    pictures = None
    for subset in SUBSETS:
        field = given.output / f"{name}-camera{subset}.csv"
        if field.exists():
            continue
        if pictures is None:
            everything = numpy.vstack([state[:, 1:3] for state in states])
            picture = Picture(everything.min(axis=0) - 2 * DIAMETER, everything.max(axis=0) + 2 * DIAMETER)
            pictures = [picture.of(state) for state in states]
            numpy.savez_compressed(given.output / f"{name}-picture.npz", first=pictures[0].astype(numpy.uint8),
                                   last=pictures[-1].astype(numpy.uint8))
        places, ways = track(pictures, round(subset * PIXELS))
        write_field(field, (places + 0.5) / picture.scale + picture.low, ways / picture.scale)
        measure(given.program, field)
        print(f"{name}, subset of {subset} d50", flush=True)


def band_of(given, name, kind):
    file = given.output / f"{name}-{kind}.band.json"
    return json.loads(file.read_text()) if file.exists() else {"found": False}


def through_window(given, name, subset):
    """The grains that stand where the camera has places: the rim, which the camera leaves out, does not count."""
    field = given.output / f"{name}-window{subset}.csv"
    if not field.exists():
        rim = 0.5 * STEP * DIAMETER
        camera = numpy.genfromtxt(given.output / f"{name}-camera{subset}.csv", delimiter=",", names=True)
        grains = numpy.genfromtxt(given.output / f"{name}-grains.csv", delimiter=",", names=True)
        inside = numpy.logical_and.reduce([(grains[axis] > camera[axis].min() - rim) & (grains[axis] < camera[axis].max() + rim)
                                           for axis in ("x", "y")])
        kept = grains[inside]
        write_field(field, numpy.column_stack((kept["x"], kept["y"])), numpy.column_stack((kept["u"], kept["v"])))
        measure(given.program, field)
    return band_of(given, name, f"window{subset}")


def report(given):
    """Tables: means over the specimens, 95 % intervals of Student's t; differences are taken specimen by specimen."""
    for kind in ("specimen", "smooth", "slit"):
        names = sorted({file.name.rsplit("-", 1)[0] for file in given.output.glob(f"{kind}*-camera{SUBSETS[-1]}.band.json")})
        whole = [band["thickness"] / DIAMETER for band in (band_of(given, name, "grains") for name in names) if band["found"]]
        print(f"\n{kind}: {len(names)}; all grains, thickness {interval(whole)} d50 ({len(whole)} bands)\n")
        print("| side of the subset, d50 | n | thickness by the camera, d50 | by the grains in its window | difference, each by each "
              "| inclination, degrees apart | greatest shear over that of the grains | places lost, % |\n|---|---|---|---|---|---|---|---|")
        for subset in SUBSETS:
            bands = [(through_window(given, name, subset), band_of(given, name, f"camera{subset}")) for name in names]
            lost = [100.0 * ours["missing"] / (sum(1 for _ in open(given.output / f"{name}-camera{subset}.csv")) - 1)
                    for name, (_, ours) in zip(names, bands)]
            both = [(theirs, ours) for theirs, ours in bands if theirs["found"] and ours["found"]]
            figures = ([ours["thickness"] / DIAMETER for _, ours in both],
                       [theirs["thickness"] / DIAMETER for theirs, _ in both],
                       [(ours["thickness"] - theirs["thickness"]) / DIAMETER for theirs, ours in both],
                       [abs((ours["inclination_degrees"] - theirs["inclination_degrees"] + 90) % 180 - 90) for theirs, ours in both],
                       [ours["peak_shear"] / theirs["peak_shear"] for theirs, ours in both], lost)
            print(f"| {subset} | {len(both)} of {len(names)} | " + " | ".join(map(interval, figures)) + " |")


def draw(given, file):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    names = sorted({path.name.rsplit("-", 1)[0] for path in given.output.glob("specimen*-grains.csv")})
    name = given.show or names[0]
    figure, axes = plt.subplots(1, 3 + len(SUBSETS), figsize=(3.0 * (3 + len(SUBSETS)), 5.4), layout="constrained",
                                gridspec_kw={"width_ratios": [1] * (2 + len(SUBSETS)) + [1.9]})
    axes[0].imshow(numpy.load(given.output / f"{name}-picture.npz")["last"], cmap="gray", origin="lower")
    axes[0].set(title="the last picture", xticks=[], yticks=[])
    largest = None
    for axis, (column, title) in zip(axes[1:], [("grains", "grains"), *((f"camera{s}", f"subset {s} d50") for s in SUBSETS)]):
        samples = numpy.genfromtxt(given.output / f"{name}-{column}.samples", delimiter=",", names=True)
        largest = largest or numpy.quantile(samples["shear"], 0.98)
        points = axis.scatter(samples["x"] / DIAMETER, samples["y"] / DIAMETER, c=samples["shear"], s=14, vmin=0, vmax=largest, cmap="viridis",
                              marker="s")
        axis.set(title=title, aspect="equal", xlim=(-2, 22), ylim=(-1, 41), xticks=[0, 10, 20], yticks=[0, 10, 20, 30, 40] if column == "grains" else [])
    figure.colorbar(points, ax=axes[1:2 + len(SUBSETS)], label=f"shear strain, {FROM:.0%} to {TO:.0%}", shrink=0.6, location="bottom")
    for kind, colour in (("specimen", "C0"), ("smooth", "C2"), ("slit", "C1")):
        of = sorted({path.name.rsplit("-", 1)[0] for path in given.output.glob(f"{kind}*-camera{SUBSETS[-1]}.band.json")})
        for which, one in enumerate(of):
            for column, style, label in (("camera", "o-", "by the camera"), ("window", "x:", "by the grains in its window")):
                found = [(subset, band_of(given, one, f"{column}{subset}")) for subset in SUBSETS]
                found = [(subset, band["thickness"] / DIAMETER) for subset, band in found if band["found"]]
                if found:
                    axes[-1].plot(*zip(*found), style, color=colour, ms=5, lw=0.8, label=f"{kind}, {label}" if which == 0 else None)
    axes[-1].set(xlabel="side of the subset, d50", ylabel="thickness, d50", ylim=(0, 15), xlim=(0, None))
    axes[-1].legend(fontsize=8, loc="upper left")
    figure.savefig(file, dpi=60)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("specimens", type=pathlib.Path, nargs="*", metavar="SPECIMEN")
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True)
    parser.add_argument("--table", action="store_true", help="run nothing")
    parser.add_argument("--figure", type=pathlib.Path)
    parser.add_argument("--show", help="the specimen that is drawn [the first]")
    parser.add_argument("--program", default="polargrain")
    given = parser.parse_args()
    given.output.mkdir(parents=True, exist_ok=True)
    if not given.table:
        for folder in given.specimens:
            states = states_of(folder)
            for kind in SLIDES:
                make(given, known_band(states[0], kind), f"{kind}_{folder.name}")
            make(given, states, f"specimen_{folder.name}")
    report(given)
    if given.figure:
        draw(given, given.figure)


if __name__ == "__main__":
    main()
