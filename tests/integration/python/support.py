# SPDX-License-Identifier: GPL-2.0-or-later
"""What the tests of the Python package share."""
import pathlib
import tempfile
import unittest

import polargrain

PACKING = "cases/biaxial/packing400.csv"
SCRIPT = "cells/hooke_radii.in"


class InFolder(unittest.TestCase):
    """A test with a folder of its own: `self.folder`."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)


def controlled(**settings):
    """A cell of 400 discs with controlled rotations."""
    return polargrain.Cell(PACKING, SCRIPT, rotations="controlled", **settings)
