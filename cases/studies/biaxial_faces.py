# SPDX-License-Identifier: GPL-2.0-or-later
"""The effects of the faces of a specimen of grains: how dense it is inside, and where it strains before its peak."""
import numpy

from built_package import polargrain
from dumps import read_grains

LAYER = 0.03         # m, next to a face: three mean diameters
NEIGHBOURS = 0.025   # m, over which the strain of a grain is taken
GRID = 0.0005        # m, of the points that grains cover


def solid_share(x, y, radius, margin=0.02):
    """The share that discs cover of the rectangle around them, less a margin (m) on each side."""
    across = numpy.arange(x.min() + margin, x.max() - margin, GRID)
    up = numpy.arange(y.min() + margin, y.max() - margin, GRID)
    covered = numpy.zeros((len(across), len(up)), bool)
    for a, b, r in zip(x, y, radius):
        i = slice(*numpy.searchsorted(across, [a - r, a + r]))
        j = slice(*numpy.searchsorted(up, [b - r, b + r]))
        covered[i, j] |= (across[i, None] - a) ** 2 + (up[None, j] - b) ** 2 < r * r
    return covered.mean()


def read_cut(data):
    """@returns x, y and radius of the grains that were cut from the packing, m"""
    rows = data.read_text(encoding="utf-8").split("Atoms", 1)[1].splitlines()
    grains = numpy.array([[float(word) for word in row.split()] for row in rows if row.strip()])
    return grains[:, 4], grains[:, 5], 0.5 * grains[:, 2]


def shear(before, after):
    """Greatest engineering shear strain of each grain's neighbourhood."""
    gradient = polargrain.displacement_gradients(before[:, 1:3], after[:, 1:3] - before[:, 1:3], NEIGHBOURS)
    return numpy.hypot(gradient[:, 0, 0] - gradient[:, 1, 1], gradient[:, 0, 1] + gradient[:, 1, 0])


def faces(folder):
    """Figures of a specimen with frames every 0.1 % of axial strain, to 2 % at least.

    @returns a dictionary; empty when it has not come that far. Shares of the shear inside (further than LAYER from any face): at
             the platens and at the membranes, from 0 to 1 % and from 1 to 2 %; axial strain of the middle half of the height over
             that of the whole at 1 %; change of the density inside by the seating, %
    """
    dumps = sorted((folder / "grains").glob("step-*.dump"))
    if len(dumps) < 21:
        return {}
    frames = [read_grains(dumps[frame]) for frame in (0, 10, 20)]
    found = {}
    for name, before, after in (("0 to 1 %", frames[0], frames[1]), ("1 to 2 %", frames[1], frames[2])):
        x, y, values = before[:, 1], before[:, 2], shear(before, after)
        known = numpy.isfinite(values)
        side, end = (numpy.minimum(place - place.min(), place.max() - place) for place in (x, y))
        inside = values[(side > LAYER) & (end > LAYER) & known].mean()
        found[f"shear at platens, {name}"] = values[(end <= LAYER) & known].mean() / inside
        found[f"at membranes, {name}"] = values[(side <= LAYER) & known].mean() / inside
    height = frames[0][:, 2]
    middle = abs(height - 0.5 * (height.min() + height.max())) < 0.25 * numpy.ptp(height)
    moved = frames[1][:, 2] - height
    whole = numpy.ptp(height) - numpy.ptp(frames[1][:, 2])
    found["strain of the middle at 1 %"] = -numpy.polyfit(height[middle], moved[middle], 1)[0] / (whole / numpy.ptp(height))
    cut = solid_share(*read_cut(folder / "specimen.data"))
    found["density by the seating, %"] = 100 * (solid_share(*frames[0][:, 1:4].T) / cut - 1)
    return found
