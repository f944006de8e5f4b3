# SPDX-License-Identifier: GPL-2.0-or-later
"""A cell driven from Python: the answers of the program, to the bit; states as values."""
import concurrent.futures
import multiprocessing
import os
import pickle
import threading
import unittest

import numpy as np

import polargrain
from support import PACKING, SCRIPT, InFolder, controlled

CASE = """title: One cell
mesh: {rectangle: {size: [0.1 m, 0.1 m], elements: [1, 1]}}
materials:
  sand: {model: cell, rotations: controlled, script: cells/hooke_radii.in, packing: cases/biaxial/packing400.csv}
regions: {all: sand}
boundary: [{on: bottom, fix: [u1, u2]}, {on: [left, right, top], pressure: 100 kPa}]
steps: {count: 1}
"""
PATH = [{"h11": 5e-4, "h22": -1e-3}, {"h12": 1e-3, "h21": -2e-4, "w": 3e-4}, {"h22": -1e-3, "k1": 0.05, "k2": -0.02}]


def shear(amount):
    return [[1.0, amount], [0.0, 1.0 - amount]]


def go_on(cell, answers):
    """Of another process: one more step of a cell that was sent there."""
    answers.put(cell.step(shear(1e-3)).vector.tobytes())


class Answers(InFolder):
    def test_are_those_of_the_program_along_a_path(self):
        (self.folder / "case.yaml").write_text(CASE)
        table = polargrain.Case(self.folder / "case.yaml").point("sand", PATH)
        cell = controlled()
        answers = [cell.at_rest]
        for row in PATH:
            h = np.array([[row.get("h11", 0), row.get("h12", 0)], [row.get("h21", 0), row.get("h22", 0)]])
            # The command is of small deformation, where no stress turns with the continuum: its cells are led along the
            # strain alone, and turned by what the grains turn beyond it.
            turn = 0.5 * (h[1, 0] - h[0, 1])
            answers.append(cell.step(displacement_gradient=0.5 * (h + h.T), rotation=row.get("w", 0.0) - turn,
                                     curvature=[row.get("k1", 0), row.get("k2", 0)]))
        columns = [table[name] for name in ("s11", "s12", "s21", "s22", "m1", "m2")]
        np.testing.assert_array_equal(np.array([answer.vector for answer in answers]), np.transpose(columns))
        self.assertEqual(answers[-1].diagnostics["void_ratio"], table["void_ratio"][-1])

    def test_to_small_increments_follow_the_tangent(self):
        # Loaded slowly and read out late, differences over 1e-6 are within 5 % of the tangent where the cell is unloaded: of its
        # 800 contacts some open or begin to slide at once. Compressed along x2, its two shear stiffnesses are 20 % apart:
        # rows or columns that were mistaken for each other would show.
        cell = controlled(unbalanced_force_ratio=1e-5, unbalanced_moment_ratio=1e-5, inertial_number=1e-4)
        for _ in range(4):
            cell.step(displacement_gradient=np.diag([3e-4, -5e-4]))
        nothing = np.zeros((2, 2))
        start = cell.evaluate(displacement_gradient=nothing)
        step = -1e-6
        turned = cell.evaluate(displacement_gradient=nothing, rotation=step).vector
        columns = []
        for i, j in ((0, 0), (1, 0), (0, 1), (1, 1)):  # eps_11 = h_11, eps_12 = h_21, eps_21 = h_12, eps_22 = h_22
            h = np.zeros((2, 2))
            h[i, j] = step
            columns.append((cell.evaluate(displacement_gradient=h).vector - start.vector) / step)
        bend = 1e-3  # rad/m: over grains of 1 cm as much as the strains above
        for direction in np.eye(2):
            answer = cell.evaluate(displacement_gradient=nothing, curvature=bend * direction)
            columns.append((answer.vector - start.vector) / bend)
        found = np.transpose(columns)
        scale = np.sqrt(np.outer(np.diag(found), np.diag(found)))
        self.assertLess(np.max(np.abs(found - start.tangent) / scale), 0.05)
        by_rotation = start.tangent[:, 2] - start.tangent[:, 1]  # eps_12 = h_21 - w, eps_21 = h_12 + w
        self.assertLess(np.max(np.abs((turned - start.vector) / step - by_rotation)[:4]) / scale[1, 1], 0.05)

    def test_turn_with_a_rigid_rotation(self):
        # Exact: stress -> R stress R^T. What is left is the motion that grains at rest still have: 1e-5 of the pressure.
        cell = controlled(unbalanced_force_ratio=1e-5, unbalanced_moment_ratio=1e-5, inertial_number=1e-4)
        for _ in range(3):
            before = cell.step(shear(1e-3))
        turn = 0.1
        R = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
        after = cell.evaluate(R, turn)
        np.testing.assert_allclose(after.stress, R @ before.stress @ R.T, rtol=0, atol=1.0)

    def test_of_spheres_have_all_components(self):
        cell = polargrain.Cell("cases/spheres/packing1000.csv", "cells/spheres_hooke_radii.in")
        F = np.eye(3)
        F[2, 2] -= 1e-4
        answer = cell.step(F)
        self.assertEqual((answer.stress.shape, answer.tangent.shape, len(cell.components)), ((3, 3), (18, 18), 18))
        # Compression along x3 alone: its stress grows most, and the diagonal of the tangent says how, within 10 %.
        change = np.diag(answer.stress - cell.at_rest.stress)
        self.assertEqual(np.argmin(change), 2)
        place = cell.components.index("s33")
        self.assertLess(abs(change[2] / (-1e-4 * cell.at_rest.tangent[place, place]) - 1), 0.1)

    def test_of_several_cells_at_once_are_those_of_each(self):
        with polargrain.Engines(workers=2) as engines:
            cells = [controlled(engines=engines) for _ in range(3)]
            gradients = [shear(amount) for amount in (1e-4, 5e-4, 1e-3)]
            together = polargrain.step_together(cells, gradients)
            with self.assertRaisesRegex(ValueError, "gradients: one for each of the 3 cells is expected, found 2"):
                polargrain.step_together(cells, gradients[:2])
        for gradient, answer in zip(gradients, together):
            np.testing.assert_array_equal(answer.vector, controlled().step(gradient).vector)


class States(InFolder):
    def setUp(self):
        super().setUp()
        self.cell = controlled()
        self.cell.step(shear(1e-3))
        self.state = self.cell.state
        self.next = self.cell.step(shear(1e-3)).vector

    def test_bring_a_cell_back_and_to_another(self):
        self.assertNotEqual(self.cell.state, self.state)
        self.cell.state = self.state
        np.testing.assert_array_equal(self.cell.step(shear(1e-3)).vector, self.next)
        self.cell.reset()
        self.assertEqual(self.cell.state, self.cell.at_rest.state)
        for values in (self.cell.at_rest.stress, self.cell.at_rest.couple_stress, self.cell.at_rest.tangent):
            with self.assertRaises(ValueError):
                values *= -1e-3

    def test_are_kept_in_files(self):
        self.state.save(self.folder / "state")
        self.assertEqual(polargrain.State.load(self.folder / "state"), self.state)
        damaged = bytearray((self.folder / "state").read_bytes())
        damaged[-1] ^= 1
        (self.folder / "state").write_bytes(damaged)
        with self.assertRaisesRegex(polargrain.InputError, "is damaged"):
            polargrain.State.load(self.folder / "state")

    def test_are_written_through_links_and_into_streams_and_take_nothings_place(self):
        (self.folder / "far").mkdir()
        link = self.folder / "link"
        link.symlink_to("far/state")
        for _ in range(2):  # where nothing is yet, and where something is
            self.state.save(link)
            self.assertTrue(link.is_symlink())
            self.assertEqual(polargrain.State.load(self.folder / "far" / "state"), self.state)
        with self.assertRaisesRegex(FileNotFoundError, "there is no such folder: .*nowhere'"):
            self.state.save(self.folder / "nowhere" / "state")
        # By links: should this fail, no device of the machine is lost.
        (self.folder / "null").symlink_to("/dev/null")
        self.state.save(self.folder / "null")
        self.assertTrue((self.folder / "null").is_char_device())
        (self.folder / "full").symlink_to("/dev/full")
        with self.assertRaises(OSError):
            self.state.save(self.folder / "full")
        os.mkfifo(self.folder / "pipe")
        with self.assertRaises(OSError):  # nobody reads
            self.state.save(self.folder / "pipe")
        self.assertTrue((self.folder / "pipe").is_fifo())

    def test_are_pickled_with_their_cells_into_other_processes(self):
        self.assertEqual(pickle.loads(pickle.dumps(self.state)), self.state)
        self.cell.state = self.state
        processes = multiprocessing.get_context("spawn")
        answers = processes.Queue()
        other = processes.Process(target=go_on, args=(self.cell, answers))
        other.start()
        self.assertEqual(answers.get(timeout=600), self.next.tobytes())
        other.join()

    def test_of_other_packings_are_refused(self):
        lines = polargrain.program.data_file(PACKING).read_text().splitlines()
        first = lines[2].split(",")
        first[3] = str(0.999 * float(first[3]))  # its radius
        (self.folder / "other.csv").write_text("\n".join([*lines[:2], ",".join(first), *lines[3:]]) + "\n")
        self.state.save(self.folder / "state")
        kept = [self.state, polargrain.State.load(self.folder / "state"), pickle.loads(pickle.dumps(self.state))]
        for packing in ("cases/footing_cells/packing100.h5", self.folder / "other.csv"):
            other = polargrain.Cell(packing, SCRIPT, rotations="controlled")
            for state in kept:
                with self.assertRaisesRegex(polargrain.InputError, f"{self.cell.packing.name}.*{other.packing.name}"):
                    other.state = state
                with self.assertRaises(polargrain.InputError):
                    other.evaluate(shear(1e-3), state=state)
        self.assertEqual(self.state.packing, self.cell.packing.name)

    def test_are_taken_by_cells_of_the_same_grains(self):
        lines = polargrain.program.data_file(PACKING).read_text().splitlines()
        # The numbers of grains are labels.
        numbered = [f"{1 + int(number)},{rest}" for number, rest in (line.split(",", 1) for line in lines[2:])]
        (self.folder / "same.csv").write_text("\n".join([*lines[:2], *numbered]) + "\n")
        same = polargrain.Cell(self.folder / "same.csv", SCRIPT, rotations="controlled")
        for state in (self.state, polargrain.State.of_bytes(self.state.bytes)):  # the second is of no known packing
            same.state = state
            np.testing.assert_array_equal(same.step(shear(1e-3)).vector, self.next)


class Threads(InFolder):
    def test_of_one_cell_take_its_steps_one_after_the_other(self):
        alone = controlled()
        for _ in range(8):
            alone.step(shear(1e-4))
        shared = controlled()
        with concurrent.futures.ThreadPoolExecutor(4) as threads:
            answers = list(threads.map(shared.step, [shear(1e-4)] * 8))
        self.assertEqual(shared.state, alone.state)
        self.assertEqual(len({answer.state for answer in answers}), 8)  # no two steps from one place

    def test_of_cells_together_wait_for_each_other(self):
        with polargrain.Engines(workers=2) as engines:
            cells = [controlled(engines=engines) for _ in range(2)]
            orders = [cells, cells[::-1], cells, cells[::-1]]
            with concurrent.futures.ThreadPoolExecutor(4) as threads:
                list(threads.map(lambda order: polargrain.step_together(order, [shear(1e-4)] * 2), orders))
            alone = controlled(engines=engines)
            for _ in orders:
                alone.step(shear(1e-4))
            for cell in cells:
                self.assertEqual(cell.state, alone.state)


class Workers(InFolder):
    def test_outlive_the_thread_that_started_them(self):
        with polargrain.Engines() as engines:
            cell = controlled(engines=engines)
            thread = threading.Thread(target=cell.step, args=(shear(1e-4),))
            thread.start()
            thread.join()
            cell.step(shear(1e-4))
            self.assertEqual(engines.counts()["workers_lost"], 0)

    def test_are_not_those_of_a_forked_process(self):
        cell = controlled()
        cell.at_rest
        answers = multiprocessing.get_context("fork").Queue()

        def ask():
            try:
                cell.step(shear(1e-4))
            except polargrain.RunError as error:
                answers.put(str(error))

        child = multiprocessing.get_context("fork").Process(target=ask)
        child.start()
        self.assertIn("forked", answers.get(timeout=600))
        child.join()
        cell.step(shear(1e-4))  # the parent's go on


if __name__ == "__main__":
    unittest.main()
