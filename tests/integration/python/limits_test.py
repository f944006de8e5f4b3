# SPDX-License-Identifier: GPL-2.0-or-later
"""Cases that come along, and those that `new` writes: in no step does a point carry more skew or couple stress than
its grains bear. Read from the stresses themselves, and not from what a run says of them. With --long the demo and the
tutorial whole."""
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy as np

import polargrain
from polargrain.program import program

SOURCE = pathlib.Path(os.environ["POLARGRAIN_SOURCE"])
FRICTION = 0.5463024898437905  # of the scripts that come along


def shares_of_limits(folder):
    """Largest skew and couple stress of all points and steps written, over their limits."""
    log = (folder / "run.log").read_text()
    skew = [float(x) for x in re.findall(r"skew stress ([0-9.e+-]+) times the pressure", log)]
    couple = [float(x) * 1e-3 for x in re.findall(r"couple stress ([0-9.e+-]+) mm times the pressure", log)]
    assert len(skew) == 1, log  # one packing
    result = polargrain.Result(folder)
    shares = [0.0, 0.0]
    for k in range(len(result.times)):
        points = result.integration_points(k).point_data
        s = points["stress"]  # 11 22 33 12 21
        pressure = np.maximum(0.0, -0.5 * (s[:, 0] + s[:, 1]))
        found = [np.abs(s[:, 4] - s[:, 3]), np.linalg.norm(points["couple_stress"], axis=1)]
        for i, limit in enumerate([skew[0], couple[0] if couple else math.inf]):
            if math.isinf(limit):
                continue
            # Four digits of the log; and of a point that has parted no more than rounding.
            over = found[i] > 1.001 * limit * pressure + 1e-9 * limit * pressure.max()
            shares[i] = max(shares[i], np.max(found[i][pressure > 1.0] / (limit * pressure[pressure > 1.0])))
            if over.any():
                raise AssertionError(f"{folder}: {found[i][over]} under {pressure[over]}, limit {limit}")
    return skew[0], shares


class Cases(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="polargrain_limits_"))

    def tearDown(self):
        shutil.rmtree(self.folder)

    def command(self, *words, cwd=None):
        done = subprocess.run([program(), *map(str, words)], cwd=cwd or self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)

    def look_at(self, case, *settings):
        self.command("run", case, "-o", self.folder / "out", "--quiet", "--set", "output.every=1",
                     *(word for setting in settings for word in ("--set", setting)))
        limit, shares = shares_of_limits(self.folder / "out")
        print(f"[figure] {case}: skew stress at most {shares[0]:.3f}, couple stress {shares[1]:.3f} of their limits; "
              f"skew limit {limit} p")
        # Grains that slide all alike bear 2 mu; how they are arranged moves it by some per cent.
        self.assertLess(limit, 1.25 * 2 * FRICTION)
        return shares

    def new(self, *words):
        self.command("new", *words, "-o", self.folder / "new")
        return self.folder / "new" / "case.yaml"


class Limits(Cases):
    def test_biaxial_of_every_scheme(self):
        for scheme in ("cell", "adaptive", "informed"):
            with self.subTest(scheme):
                case = self.new("biaxial", "--grains", 100, "--elements", 2, 4, "--scheme", scheme)
                self.look_at(case)
                shutil.rmtree(self.folder / "new")
                shutil.rmtree(self.folder / "out")

    def test_footing_of_every_scheme(self):
        for scheme in ("adaptive", "informed"):
            with self.subTest(scheme):
                case = self.new("footing", "--scheme", scheme)
                self.look_at(case)
                shutil.rmtree(self.folder / "new")
                shutil.rmtree(self.folder / "out")

    def test_footing_of_cells(self):
        self.look_at(SOURCE / "cases/footing_cells/case.yaml")

    def test_a_footing_pushed_far_reaches_the_limit(self):
        shares = self.look_at(SOURCE / "cases/footing_cells/case.yaml", "boundary.2.move.u2=-50 mm", "steps.count=5")
        self.assertGreater(shares[0], 0.999)

    def test_demo_of_eight_elements(self):
        self.look_at(SOURCE / "cases/biaxial/case.yaml", "mesh.rectangle.elements=[2, 4]")


class Long(Cases):
    def test_demo(self):
        self.look_at(SOURCE / "cases/biaxial/case.yaml")

    def test_spheres(self):
        self.look_at(SOURCE / "cases/spheres/case.yaml")

    def test_tutorial(self):
        for file in (SOURCE / "cases/tutorial").iterdir():
            shutil.copy(file, self.folder)
        self.command("pack", "grading.yaml", "-o", "sand.h5")
        self.look_at(self.folder / "cells.yaml", "materials.sand.script=sand.in")


if __name__ == "__main__":
    long = "--long" in sys.argv
    unittest.main(defaultTest="Long" if long else "Limits", argv=[a for a in sys.argv if a != "--long"])
