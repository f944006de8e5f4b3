# SPDX-License-Identifier: GPL-2.0-or-later
"""Shear bands in scattered points: the ruler that grains and finite elements share."""
import numpy as np

from . import _cells
from .arrays import real_array


def find_band(positions, shear, areas=None, *, contrast=2.0):
    """Looks for the straight band of greatest shear in an increment.

    positions -- of grains or integration points, m; shape (n, 2); at least 20
    shear     -- greatest engineering shear strain of the increment at each, sqrt((h11 - h22)^2 + (h12 + h21)^2); shape (n,)
    areas     -- m^2 that each stands for; shape (n,) [equal shares of the rectangle around them]
    contrast  -- a profile whose peak is less than this many times its background is no band
    Returns a dict: found; and either reason, or inclination_degrees (from the x1 axis, in (-90, 90]), thickness (full width at
    half maximum, m), resolution (m; a band about as thick is not resolved), centre (m), peak_shear, background_shear.
    """
    positions = real_array(positions, "positions")[:, :2]
    shear = real_array(shear, "shear")
    areas = np.full(len(shear), np.prod(np.ptp(positions, axis=0)) / len(shear)) if areas is None else real_array(areas, "areas")
    if not len(positions) == len(shear) == len(areas):
        raise ValueError(f"positions, shear and areas: as many of each are expected, not {len(positions)}, {len(shear)} "
                         f"and {len(areas)}")
    if not (np.all(np.isfinite(positions)) and np.all(np.isfinite(shear)) and np.all(areas > 0)):
        raise ValueError("positions and shear must be finite, areas positive")
    return _cells.find_band(positions, shear, areas, float(contrast))


def displacement_gradients(positions, displacements, radius):
    """Displacement gradients at scattered points, by weighted least squares over the neighbours within a radius.

    positions, displacements -- m; shape (n, 2)
    radius                   -- m; 2.5 mean distances of the points see about 20 neighbours
    Returns h_ij = d u_i / d x_j, shape (n, 2, 2); not a number where a point has less than three neighbours, or they stand in
    a line. An affine field is reproduced exactly; what varies is smoothed over a width of 0.74 radius.
    """
    positions = real_array(positions, "positions")[:, :2]
    displacements = real_array(displacements, "displacements")[:, :2]
    if positions.shape != displacements.shape:
        raise ValueError("positions and displacements: as many of each are expected")
    return _cells.displacement_gradients(positions, displacements, float(radius)).reshape(-1, 2, 2)
