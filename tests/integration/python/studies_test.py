# SPDX-License-Identifier: GPL-2.0-or-later
"""What the studies share: lines through means, the dilatancy of bands, mirror images of packings, packings twice as large, the density of discs."""
import math
import os
import pathlib
import sys
import tempfile
import unittest

import numpy as np

SOURCE = pathlib.Path(os.environ["POLARGRAIN_SOURCE"])
sys.path.insert(0, str(SOURCE / "cases/studies"))
sys.dont_write_bytecode = True

import polargrain  # noqa: E402
from biaxial import change  # noqa: E402
from biaxial_faces import GRID, solid_share  # noqa: E402
from biaxial_inclination import dilatancy  # noqa: E402
from intervals import Line, line  # noqa: E402


class Studies(unittest.TestCase):
    def test_a_line_through_two_means_hits_both(self):
        value, half, slope, _ = line([10.0, 5.0], [[1.0, 3.0], [2.0, 4.0]])
        self.assertAlmostEqual(slope, (2.0 - 3.0) / 5.0, 12)
        self.assertAlmostEqual(value, 4.0, 12)
        # 2 b - a, each mean with a variance of 2 / 2.
        self.assertAlmostEqual(half, 1.96 * math.sqrt(4.0 + 1.0), 12)

    def test_a_line_through_single_values_has_the_scatter_that_they_have(self):
        # 2 x + 1 and residuals 1, -1, -1, 1, which have neither mean nor slope; Student's t of two degrees of freedom is 4.303.
        known = Line([0.0, 1.0, 2.0, 3.0], [2.0, 2.0, 4.0, 8.0])
        self.assertAlmostEqual(known.slope, 2.0, 12)
        self.assertAlmostEqual(known.scatter, math.sqrt(4.0 / 2.0), 12)
        self.assertAlmostEqual(known.half_of_slope, 4.303 * math.sqrt(2.0 / 5.0), 12)
        value, half = known.at(3.5)
        self.assertAlmostEqual(value, 8.0, 12)
        self.assertAlmostEqual(half, 4.303 * math.sqrt(2.0 * (1.0 / 4.0 + 4.0 / 5.0)), 12)

    def test_discs_of_a_square_lattice_cover_a_quarter_of_pi(self):
        x, y = (places.ravel() for places in np.meshgrid(np.arange(20) * 0.01, np.arange(20) * 0.01))
        # The margin leaves whole cells of the lattice; the grid misses a rim of half a step a disc.
        self.assertAlmostEqual(solid_share(x, y, np.full(400, 0.005)), math.pi / 4.0, delta=GRID / 0.01)

    def test_a_band_between_rigid_halves_dilates_by_the_angle_at_which_they_part(self):
        # The upper half moves at 12 degrees from the band. u = w s / t with the unit vector w and the distance s from the lower edge: gradient w n / t,
        # volume strain w n / t, shear strain 1 / t for any angle between w and the normal n.
        angle, parting, thickness = math.radians(-55.0), math.radians(12.0), 0.02
        normal = np.array([-math.sin(angle), math.cos(angle)])
        moved = math.cos(parting) * np.array([math.cos(angle), math.sin(angle)]) + math.sin(parting) * normal
        gradient = np.outer(moved, normal) / thickness
        x, y = np.random.default_rng(1).uniform(-0.1, 0.1, (2, 500))
        inside = abs(normal[0] * x + normal[1] * y) < 0.5 * thickness
        shear = math.hypot(gradient[0, 0] - gradient[1, 1], gradient[0, 1] + gradient[1, 0])
        samples = {"x": 0.1 + x, "y": 0.2 + y, "area": 1e-4 + x * x, "shear": np.where(inside, shear, 0.0),
                   "volume_strain": np.where(inside, np.trace(gradient), 0.01)}
        band = {"inclination_degrees": -55.0, "centre": [0.1, 0.2], "thickness": thickness}
        self.assertAlmostEqual(dilatancy(samples, band), 12.0, 9)
        self.assertTrue(math.isnan(dilatancy(samples, {**band, "centre": [5.0, 5.0]})))

    def test_the_mirror_image_of_a_mirror_image_is_the_packing(self):
        whole = polargrain.read_packing(SOURCE / "cases/studies/dense100_seed2.h5")
        with tempfile.TemporaryDirectory() as folder:
            once, twice = (pathlib.Path(folder) / name for name in ("once.csv", "twice.csv"))
            change(SOURCE / "cases/studies/dense100_seed2.h5", once, mirrored=True, doubled=False)
            change(once, twice, mirrored=True, doubled=False)
            image, back = (polargrain.read_packing(file) for file in (once, twice))
        self.assertTrue(np.allclose(image.box, whole.box * [[1.0, -1.0], [1.0, 1.0]], rtol=0, atol=1e-15))
        for other, turned in ((image, -1.0), (back, 1.0)):
            apart = np.linalg.solve(other.box, (other.positions - whole.positions * [turned, 1.0]).T)
            self.assertLess(abs(apart - np.round(apart)).max(), 1e-12)
            self.assertTrue(np.array_equal(other.radii, whole.radii))

    def test_a_packing_twice_as_large_has_the_density_and_the_shares_of_the_packing(self):
        whole = polargrain.read_packing(SOURCE / "cases/studies/dense100_seed2.h5")
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "doubled.csv"
            change(SOURCE / "cases/studies/dense100_seed2.h5", file, mirrored=False, doubled=True)
            large = polargrain.read_packing(file)
        self.assertTrue(np.allclose(large.box, 2.0 * whole.box, rtol=1e-15, atol=0))
        self.assertTrue(np.allclose(large.masses / large.radii ** 2 / large.thickness, whole.masses / whole.radii ** 2 / whole.thickness, rtol=1e-14))
        apart = np.linalg.solve(large.box, large.positions.T) - np.linalg.solve(whole.box, whole.positions.T)
        self.assertLess(abs(apart - np.round(apart)).max(), 1e-12)


if __name__ == "__main__":
    unittest.main()
