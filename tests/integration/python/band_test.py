# SPDX-License-Identifier: GPL-2.0-or-later
"""The ruler of bands on fields that are known in closed form."""
import unittest

import numpy as np

import polargrain


class Bands(unittest.TestCase):
    def setUp(self):
        self.places = np.random.default_rng(1).uniform([0, 0], [0.2, 0.4], (1000, 2))

    def test_have_the_inclination_and_width_that_they_were_made_with(self):
        slope, width = np.radians(55.0), 0.03
        distance = (self.places - [0.1, 0.2]) @ [-np.sin(slope), np.cos(slope)]
        shear = 0.01 + 0.2 * np.exp(-4 * np.log(2) * (distance / width) ** 2)
        band = polargrain.find_band(self.places, shear)
        self.assertAlmostEqual(band["inclination_degrees"], 55.0, delta=0.5)
        # The profile is smoothed by a kernel as wide as the resolution: widths of Gaussians add up in squares.
        smoothed = np.hypot(width, band["resolution"])
        self.assertAlmostEqual(band["thickness"] / smoothed, 1.0, delta=0.05)

    def test_are_not_found_where_there_are_none(self):
        band = polargrain.find_band(self.places, np.full(1000, 0.01))
        self.assertFalse(band["found"])
        self.assertTrue(band["reason"])
        with self.assertRaises(ValueError):
            polargrain.find_band(self.places, [1.0])

    def test_gradients_of_an_affine_field_are_exact(self):
        h = np.array([[0.01, 0.3], [-0.02, -0.05]])
        gradients = polargrain.displacement_gradients(self.places, self.places @ h.T, 0.03)
        # To round-off of a fit over some tens of neighbours.
        np.testing.assert_allclose(gradients, np.broadcast_to(h, gradients.shape), atol=1e-11)


if __name__ == "__main__":
    unittest.main()
