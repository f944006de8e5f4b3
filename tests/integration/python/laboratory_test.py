# SPDX-License-Identifier: GPL-2.0-or-later
"""Packings, laboratory tests and calibrations from Python: those of the program."""
import subprocess
import unittest

import numpy as np

import polargrain
from polargrain.program import data_file, program
from support import SCRIPT, InFolder

PACKINGS = ["cases/footing_cells/packing100.h5", "cases/studies/dense100_seed2.h5"]
TEST = {"packing": PACKINGS, "script": SCRIPT, "test": "biaxial", "pressure": "100 kPa", "axial_strain": "1 %", "rows": 5}
GRAINS = {"grains": 40, "sizes": {"law": "uniform", "radius": ["3 mm", "7 mm"]}, "density": 2650.0, "thickness": "100 mm",
          "script": SCRIPT, "pressure": "100 kPa", "friction": 0.0, "seed": 1}


class Laboratory(InFolder):
    def test_tests_are_those_of_the_program(self):
        result = polargrain.element_test(TEST, {"rows": 4}, output=self.folder / "here")
        subprocess.run([program(), "element", "--test", "biaxial", "--pressure", "100kPa", *PACKINGS, SCRIPT, "--set",
                        "axial_strain=1 %", "--set", "rows=4", "-o", self.folder / "there", "--quiet"], check=True,
                       cwd=data_file(PACKINGS[0]).parents[2])
        self.assertEqual((self.folder / "here.csv").read_bytes(), (self.folder / "there.csv").read_bytes())
        self.assertEqual(list(result.curves), ["packing100", "dense100_seed2"])
        curves = [curve["stress_ratio"] for curve in result.curves.values()]
        np.testing.assert_allclose(result.mean["stress_ratio"], np.mean(curves, axis=0), rtol=1e-14)
        curve = result.curves["packing100"]
        self.assertEqual(list(curve["row"][curve["stage"] == 1]), [0, 1, 2, 3, 4])

    def test_tests_that_end_early_leave_their_curves(self):
        with self.assertRaises(polargrain.RunError) as caught:
            polargrain.element_test(TEST, {"packing": [str(data_file(PACKINGS[0]))], "axial_strain": "50 %", "rows": 1,
                                           "cuts": 0, "jumps": 0})
        self.assertIn("packing100", str(caught.exception))
        curve = caught.exception.result.curves["packing100"]
        self.assertEqual(list(curve["row"][curve["stage"] == 1]), [0])

    def test_packings_are_those_of_the_specification(self):
        packing = polargrain.pack(GRAINS, self.folder / "forty.h5")
        self.assertEqual(len(packing), 40)
        self.assertTrue(np.all((packing.radii >= 3e-3) & (packing.radii <= 7e-3)))
        # Discs of their density, as thick as the box.
        np.testing.assert_allclose(packing.masses, 2650.0 * np.pi * packing.radii**2 * 0.1, rtol=1e-12)
        np.testing.assert_allclose(packing.volume, np.linalg.det(packing.box) * packing.thickness, rtol=1e-12)
        at_rest = polargrain.Cell(packing, SCRIPT).at_rest
        np.testing.assert_allclose(-0.5 * np.trace(at_rest.stress), 100e3, rtol=2e-3)  # it is made to 1e-3
        with self.assertRaisesRegex(polargrain.InputError, "unknown key 'grain'"):
            polargrain.pack({**GRAINS, "grain": 3}, self.folder / "other.h5")
        with self.assertRaisesRegex(polargrain.InputError, "^specification.yaml:1: packing: the key 'seed' is missing"):
            polargrain.pack({key: value for key, value in GRAINS.items() if key != "seed"}, self.folder / "other.h5")

    def test_calibrations_find_what_a_curve_was_made_with(self):
        script = self.folder / "sand.in"
        script.write_text("variable friction index 0.5\n" + data_file(SCRIPT).read_text())
        words = script.read_text().splitlines()
        place = next(k for k, line in enumerate(words) if "coefficientFriction " in line)
        words[place] = " ".join(words[place].split()[:-1]) + " ${friction}"
        script.write_text("\n".join(words) + "\n")
        test = {"test": "biaxial", "pressure": "100 kPa", "axial_strain": "1 %", "rows": 5}
        curve = polargrain.element_test({"packing": PACKINGS[0], "script": script, **test}).curves["packing100"]
        found = polargrain.calibrate(
            {"strain": curve["axial_strain"][1:], "ratio": curve["stress_ratio"][1:]},
            {"packing": PACKINGS[0], "script": script, "parameters": {"friction": {"bounds": [0.2, 1.0], "start": 0.4}},
             "tests": {"one": test}, "targets": [{"column": "stress_ratio", "error": 0.01, "lab": "ratio", "lab_along": "strain"}]},
            self.folder / "calibration", {"search_tolerance": 0.01})
        # The search ends when it stands still to 0.01 of the way between the bounds, of a logarithm of 1.6.
        self.assertAlmostEqual(found.parameters["friction"][0] / 0.5, 1.0, delta=0.02)
        self.assertEqual(found.record["friction"][found.record["misfit"].argmin()], found.parameters["friction"][0])
        self.assertTrue(found.script.is_file() and found.page.is_file())


if __name__ == "__main__":
    unittest.main()
