# SPDX-License-Identifier: GPL-2.0-or-later
"""A cell under the calls of preCICE's Micro Manager, by a host that makes them in its order."""
import copy
import pickle
import unittest

import numpy as np

import polargrain
from polargrain.micro_manager import micro_simulation
from support import PACKING, SCRIPT, controlled


class Manager:
    """As the Micro Manager: makes simulations, steps them together, iterates from checkpoints, copies states of active
    simulations to those that become active."""

    def __init__(self, micro_class, count):
        self.micro_class = micro_class
        self.sims = [micro_class(number) for number in range(count)]
        self.initial = [sim.initialize() for sim in self.sims]

    def window(self, iterations):
        """Steps with each of these lists of data, each from the start of the window."""
        checkpoint = [sim.get_state() for sim in self.sims]
        for data in iterations:
            for sim, state in zip(self.sims, checkpoint):
                sim.set_state(state)
            written = [sim.solve(one, 0.1) for sim, one in zip(self.sims, data)]
        return written


def data(h, w=0.0, k=(0.0, 0.0)):
    return {"displacement_gradient_1": np.array(h[0]), "displacement_gradient_2": np.array(h[1]), "rotation": w,
            "curvature": np.array(k)}


class MicroManager(unittest.TestCase):
    def test_gets_the_answers_of_cells(self):
        manager = Manager(micro_simulation(PACKING, SCRIPT, rotations="controlled", tangent=True), 2)
        np.testing.assert_array_equal(manager.initial[0]["stress_1"], controlled().at_rest.stress[0])
        first = [data([[0, 1e-3], [0, -1e-3]], 1e-4, (0.01, 0)), data([[1e-3, 0], [0, -2e-3]])]
        second = [data([[0, 2e-3], [0, -2e-3]], 2e-4, (0.02, 0)), data([[2e-3, 0], [0, -4e-3]])]
        manager.window([second, first])  # an iteration that was too far, then the one that is kept
        written = manager.window([second])
        cell = controlled()
        cell.step(displacement_gradient=[[0, 1e-3], [0, -1e-3]], rotation=1e-4, curvature=[0.01, 0])
        # What is read counts from the start of the run: the second step is the difference, seen from the shape after the first.
        back = np.linalg.inv([[1, 1e-3, 0], [0, 1 - 1e-3, 0], [0, 0, 1]])
        h, k = np.zeros((3, 3)), np.zeros((3, 3))
        h[:2, :2] = np.subtract([[0, 2e-3], [0, -2e-3]], [[0, 1e-3], [0, -1e-3]])
        k[2, 0] = 0.02 - 0.01
        answer = cell.step(displacement_gradient=h @ back, rotation=1e-4, curvature=k @ back)
        np.testing.assert_array_equal([written[0]["stress_1"], written[0]["stress_2"]], answer.stress)
        np.testing.assert_array_equal(written[0]["couple_stress"], answer.couple_stress)
        tangent = np.concatenate([written[0][f"tangent_{number}"] for number in range(1, 19)]).reshape(6, 6)
        np.testing.assert_array_equal(tangent, answer.tangent)

    def test_gets_the_answers_of_spheres(self):
        packing, script = "cases/spheres/packing1000.csv", "cells/spheres_hooke_radii.in"
        sim = micro_simulation(packing, script, rotations="controlled")(0)
        h, w, k = np.diag([0, 0, -1e-4]), np.array([1e-5, 0, 2e-5]), np.diag([0.01, 0, 0])
        read = {"rotation": w}
        for row in range(3):
            read[f"displacement_gradient_{row + 1}"], read[f"curvature_{row + 1}"] = h[row], k[row]
        written = sim.solve(read, 0.1)
        answer = polargrain.Cell(packing, script, rotations="controlled").step(displacement_gradient=h, rotation=w, curvature=k)
        np.testing.assert_array_equal([written[f"stress_{row}"] for row in (1, 2, 3)], answer.stress)
        np.testing.assert_array_equal([written[f"couple_stress_{row}"] for row in (1, 2, 3)], answer.couple_stress)

    def test_copies_states_from_one_to_another(self):
        manager = Manager(micro_simulation(PACKING, SCRIPT), 3)
        one, other, third = manager.sims
        one.solve(data([[0, 0], [0, -1e-3]]), 0.1)
        other.set_state(copy.deepcopy(one.get_state()))
        third.set_state(pickle.loads(pickle.dumps(one.get_state())))
        further = data([[0, 1e-3], [0, -1e-3]])
        expected = one.solve(further, 0.1)
        for sim in (other, third):
            np.testing.assert_array_equal(sim.solve(further, 0.1)["stress_2"], expected["stress_2"])
        other.set_global_id(7)
        self.assertEqual(other.get_global_id(), 7)

    def test_has_steps_cut_that_are_too_large(self):
        sim = micro_simulation(PACKING, SCRIPT)(0)
        written = sim.solve(data([[0, 0.3], [0, 0.05]]), 0.1)  # a cell takes 0.25 at once
        self.assertTrue(np.all(np.isfinite(written["stress_1"])))
        before = sim.get_state()
        with self.assertRaises(polargrain.StepFailed):
            sim.solve(data([[0, 100.0], [0, 0]]), 0.1)
        self.assertEqual(sim.get_state()[0], before[0])


if __name__ == "__main__":
    unittest.main()
