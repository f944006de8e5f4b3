# SPDX-License-Identifier: GPL-2.0-or-later
"""The notebook runs from its first cell to its last, and ends with a band."""
import json
import os
import pathlib
import unittest

import matplotlib

from support import InFolder

NOTEBOOK = pathlib.Path(os.environ["POLARGRAIN_SOURCE"]) / "python/notebooks/from_packing_to_band.ipynb"


class Notebook(InFolder):
    def test_ends_with_a_band(self):
        matplotlib.use("Agg")
        before = os.getcwd()
        os.chdir(self.folder)
        names = {}
        try:
            for number, cell in enumerate(json.loads(NOTEBOOK.read_text(encoding="utf-8"))["cells"]):
                if cell["cell_type"] == "code":
                    exec(compile("".join(cell["source"]), f"{NOTEBOOK.name}, cell {number}", "exec"), names)
        finally:
            os.chdir(before)
        # One band, 15 degrees around the planes of greatest shear at most: such packings and meshes give 37 to 54 degrees.
        band = names["band"]
        self.assertTrue(band["found"])
        self.assertAlmostEqual(abs(band["inclination_degrees"]), 45, delta=15)
        self.assertEqual(len(names["test"].curves), 3)


if __name__ == "__main__":
    unittest.main()
