# SPDX-License-Identifier: GPL-2.0-or-later
"""Cases run from Python, and what they leave as arrays."""
import csv
import json
import pathlib
import shutil
import tempfile
import unittest

import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

import polargrain
from support import InFolder

SMALL = {"steps.count": 2, "mesh.rectangle.elements": [1, 2]}


class Runs(InFolder):
    @classmethod
    def setUpClass(cls):
        results = tempfile.TemporaryDirectory()
        cls.addClassCleanup(results.cleanup)
        cls.steps = []
        cls.result = polargrain.run("cases/biaxial/case.yaml", SMALL, pathlib.Path(results.name) / "results", workers=2,
                                    progress=cls.steps.append)

    def test_tell_their_steps_and_leave_them_as_arrays(self):
        with open(self.result.directory / "history.csv", newline="") as text:
            rows = list(csv.DictReader(text))
        self.assertEqual([row["axial_strain"] for row in self.steps], [float(row["axial_strain"]) for row in rows])
        history = self.result.history
        np.testing.assert_array_equal(history["stress_ratio"], [float(row["stress_ratio"]) for row in rows])
        self.assertEqual(list(history.frame().columns), list(rows[0]))
        self.assertEqual(self.result.summary["status"], "done")
        self.assertEqual(len(self.result.costs["total"]), 3)  # the start is one

    def test_leave_fields_that_vtk_reads_alike(self):
        self.assertEqual(self.result.times, [0.0, 1.0])
        for fields in (self.result.fields(), self.result.integration_points()):
            reader = vtk.vtkXMLUnstructuredGridReader()
            reader.SetFileName(str(fields.file))
            reader.Update()
            grid = reader.GetOutput()
            np.testing.assert_array_equal(fields.points, vtk_to_numpy(grid.GetPoints().GetData()))
            self.assertEqual(len(fields.cells), grid.GetNumberOfCells())
            for number, cell in enumerate(fields.cells):
                ids = grid.GetCell(number).GetPointIds()
                self.assertEqual(list(cell), [ids.GetId(k) for k in range(ids.GetNumberOfIds())])
            for data, there in ((grid.GetPointData(), fields.point_data), (grid.GetCellData(), fields.cell_data)):
                self.assertEqual(list(there), [data.GetArrayName(k) for k in range(data.GetNumberOfArrays())])
                for name, values in there.items():
                    np.testing.assert_array_equal(values, vtk_to_numpy(data.GetArray(name)))
        self.assertEqual(self.result.fields().components["stress"], ["11", "22", "33", "12", "21"])
        self.assertEqual(self.result.fields().units["stress"], "Pa")

    def test_say_what_is_not_there(self):
        for ask in (lambda: self.result.fields(10), lambda: self.result.integration_points(10),
                    lambda: self.result.integration_points(-3)):
            with self.assertRaisesRegex(polargrain.InputError, r"names fields at 2 times.*there is no number"):
                ask()
        copy = self.folder / "copy"
        shutil.copytree(self.result.directory, copy)
        old = polargrain.Result(copy)  # any that lies there is opened by its directory
        np.testing.assert_array_equal(old.history["time"], self.result.history["time"])
        for name, ask in (("summary.json", lambda: old.summary), ("fields.pvd", old.fields), ("costs.csv", lambda: old.costs),
                          ("points.pvd", old.integration_points), ("history.csv", lambda: old.history)):
            good = (copy / name).read_bytes()
            for bad in (None, b"", good[:len(good) // 2] if name.endswith(("json", "pvd")) else None):
                (copy / name).unlink(missing_ok=True)
                if bad is not None:
                    (copy / name).write_bytes(bad)
                if bad == b"" and name.endswith("csv"):
                    continue  # an empty table
                with self.subTest(name), self.assertRaises(polargrain.InputError):
                    ask()
            (copy / name).write_bytes(good)
        good = old.fields().file.read_text()
        for cut in (good[:len(good) // 2], good.replace("Float64", "Float128"), good.replace("connectivity", "conn")):
            old.fields().file.write_text(cut)
            with self.subTest(cut[:20]), self.assertRaises(polargrain.InputError):
                polargrain.Fields(sorted(copy.glob("fields/step-*"))[-1])
            sorted(copy.glob("fields/step-*"))[-1].write_text(good)

    def test_show_the_grains_of_a_point(self):
        grains = self.result.grains(3, "last")
        self.assertEqual(list(grains), [2])
        kinds = grains[2].cell_data["kind"]  # 0: a grain in the box
        contacts = grains[2].point_data["coordination_number"][[cell[0] for cell, kind in zip(grains[2].cells, kinds) if kind == 0]]
        self.assertEqual(len(contacts), 400)
        self.assertAlmostEqual(contacts.mean(), self.result.integration_points().point_data["coordination_number"][3], delta=1e-12)

    def test_measure_their_band(self):
        measured = self.result.band(0.0, 0.023)
        with open(self.result.directory / "band.json") as text:
            self.assertEqual({**measured, "increments": None}, {**json.load(text), "increments": None})
        with self.assertRaisesRegex(polargrain.InputError, "are one frame"):
            self.result.band(0.023, 0.023)

    def test_that_do_not_converge_leave_what_they_committed(self):
        hard = {**SMALL, "boundary.1.move.u2": "-60 mm", "steps.cut": 0, "steps.iterations": 1}
        with self.assertRaises(polargrain.RunError) as caught:
            polargrain.run("cases/biaxial/case.yaml", hard, self.folder / "hard", workers=2)
        self.assertTrue(str(caught.exception))
        self.assertEqual(caught.exception.result.summary["status"], "failed")


if __name__ == "__main__":
    unittest.main()
