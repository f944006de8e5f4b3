# SPDX-License-Identifier: GPL-2.0-or-later
"""What goes wrong becomes an exception with the words of the program, and leaves everything as it was."""
import os
import pathlib
import pickle
import signal
import subprocess
import sys
import time
import unittest

import numpy as np

import polargrain
from polargrain.program import program
from support import PACKING, SCRIPT, InFolder, controlled

INTERRUPTED = """
import numpy, sys
import polargrain
cell = polargrain.Cell({packing!r}, {script!r}, inertial_number=1e-9)  # minutes a step
for _ in range(2):
    try:
        print("asking", flush=True)
        cell.step(numpy.eye(2) * (1 - 1e-3))
    except KeyboardInterrupt:
        print("interrupted", flush=True)
print(polargrain.Cell({packing!r}, {script!r}).at_rest.quality, flush=True)
"""


class Errors(InFolder):
    def test_in_a_cell_are_told_all_at_once(self):
        with self.assertRaises(polargrain.InputError) as caught:
            polargrain.Cell("nothing.h5", "cells/hoke.in", dampin=0.2, inertial_number=-1)
        text = str(caught.exception)
        for words in ("there is no file 'nothing.h5'", "there is no file 'cells/hoke.in'",
                      "unknown key 'dampin'; did you mean 'damping'?", "inertial_number"):
            self.assertIn(words, text)
        self.assertEqual(len(caught.exception.faults), 4)

    def test_in_a_packing_name_file_and_line(self):
        file = self.folder / "packing.csv"
        file.write_text("# cell xx=1 xy=0 yx=0 yy=1 z=1\nid,x,y,r,mass,Izz\n1,0,0,zero,1,1\n")
        with self.assertRaises(polargrain.InputError) as caught:
            polargrain.read_packing(file)
        self.assertEqual(caught.exception.faults[0][:2], (str(file), 3))

    def test_in_a_case_have_the_words_of_the_program(self):
        case = self.folder / "case.yaml"
        case.write_text("mesh: {}\nmaterial: {}\n")
        said = subprocess.run([program(), "check", case], capture_output=True, text=True)
        with self.assertRaises(polargrain.InputError) as caught:
            polargrain.Case(case).check()
        self.assertEqual(str(caught.exception), said.stderr.strip())
        self.assertIn((str(case), 2), [fault[:2] for fault in caught.exception.faults])
        with self.assertRaises(polargrain.InputError):
            polargrain.run(case, output=self.folder / "results")
        self.assertFalse((self.folder / "results").exists())

    def test_of_a_step_leave_the_cell_where_it_was(self):
        cell = controlled()
        cell.step([[1, 0], [0, 0.999]])
        before = cell.state
        with self.assertRaises(polargrain.StepFailed) as caught:
            cell.step([[1, 1], [0, 1]])
        self.assertEqual(caught.exception.step_factor, 0.5)
        self.assertIn("at most 0.25 is taken", str(caught.exception))
        self.assertEqual(cell.state, before)

    def test_of_the_engine_are_told_and_end_no_interpreter(self):
        script = self.folder / "wrong.in"
        text = (polargrain.program.data_file(SCRIPT)).read_text()
        script.write_text(text.replace("gran model hooke/radii", "gran model hooke/nobody"))
        with self.assertRaisesRegex(polargrain.RunError, "hooke/nobody"):
            polargrain.Cell(PACKING, script).at_rest
        self.assertEqual(controlled().at_rest.quality, "good")  # with the same engines

    def test_of_shapes_are_found_before_anything_is_asked(self):
        cell = controlled()
        for F, rotation, curvature in ((np.eye(4), None, None), (np.eye(2), [1, 2], None), (np.eye(2), None, 1.0),
                                       ([[np.nan, 0], [0, 1]], None, None)):
            with self.assertRaises(ValueError):
                cell.step(F, rotation, curvature)
        with self.assertRaisesRegex(polargrain.InputError, "rotations of this cell are free"):
            polargrain.Cell(PACKING, SCRIPT).step(np.eye(2), 1e-3)

    def test_of_numbers_that_are_none_are_found_before_anything_is_asked(self):
        cell = controlled()
        good = np.eye(2)
        hidden = np.ma.masked_array(good, mask=[[True, False], [False, False]])
        for F in (good.astype(complex), good + 1e-3j, [[1 + 0j, 0], [0, 1]], [["1", "0"], ["0", "1"]], good.astype(str),
                  good.astype(bool), [[1, None], [0, 1]], hidden, np.array(good, dtype="M8[s]")):
            for question in ({"F": F}, {"displacement_gradient": F}, {"F": good, "curvature": F[0]}):
                with self.subTest(question), self.assertRaises(ValueError):
                    cell.step(**question)
        for rotation in (1e-3j, "0.1", True, None.__class__):
            with self.subTest(rotation), self.assertRaises((ValueError, TypeError)):
                cell.step(good, rotation)
        with self.assertRaises(ValueError):
            polargrain.find_band(np.zeros((30, 2)) + 1j, np.ones(30))
        self.assertFalse(hasattr(cell, "_initial"))  # nothing was asked
        cell.step(np.ones((2, 2), dtype=np.float32) * np.eye(2, dtype=np.int8))  # numbers of any size are numbers

    def test_of_names_with_a_nul_read_no_other_file(self):
        real = str(polargrain.program.data_file(PACKING))
        for ask in (lambda: polargrain.Cell(real + "\0x", SCRIPT), lambda: polargrain.Cell(real, SCRIPT + "\0x"),
                    lambda: polargrain.Cell(real, SCRIPT, rotations="free\0"), lambda: polargrain.read_packing(real + "\0"),
                    lambda: polargrain.Case("cases/biaxial/case.yaml\0"), lambda: polargrain.Result(str(self.folder) + "\0"),
                    lambda: polargrain.Case("cases/biaxial/case.yaml", {"title": "a\0b"}).check(),
                    lambda: polargrain.State.load(str(self.folder / "state") + "\0"), lambda: polargrain.Fields("a\0.vtu"),
                    lambda: polargrain.Cell(real, SCRIPT, dampin="\x1b")):
            with self.assertRaises(polargrain.InputError):
                ask()

    def test_of_files_wait_for_no_pipe(self):
        pipe = self.folder / "pipe"
        os.mkfifo(pipe)
        (self.folder / "circle").symlink_to("circle")
        for file in (pipe, self.folder / "circle", self.folder, pathlib.Path("/dev/zero")):
            for ask in (polargrain.State.load, polargrain.Fields, polargrain.read_packing,
                        lambda file: polargrain.Cell(file, SCRIPT), lambda file: polargrain.Cell(PACKING, file),
                        lambda file: polargrain.Case(file).check()):
                with self.subTest(file), self.assertRaises(polargrain.InputError):
                    ask(file)

    def test_ctrl_c_ends_a_question_and_not_the_cells(self):
        code = INTERRUPTED.format(packing=PACKING, script=SCRIPT)
        process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True, env=os.environ)
        for _ in range(2):
            self.assertEqual(process.stdout.readline(), "asking\n")
            time.sleep(0.5)  # until the engine is at work; when it is not yet, the test is of less, and holds
            process.send_signal(signal.SIGINT)
            self.assertEqual(process.stdout.readline(), "interrupted\n")
        self.assertEqual(process.stdout.readline(), "good\n")
        self.assertEqual(process.wait(600), 0)
        process.stdout.close()


if __name__ == "__main__":
    unittest.main()
