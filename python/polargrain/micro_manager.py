# SPDX-License-Identifier: GPL-2.0-or-later
"""A cell as a micro simulation of preCICE's Micro Manager: its points are those of any solver that preCICE couples.

The module that the Micro Manager is told of (`micro_file_name`) holds two lines:

    from polargrain.micro_manager import micro_simulation
    MicroSimulation = micro_simulation("packing.h5", "cells/hooke_radii.in")

What goes to and fro are vectors with as many components as the packing has dimensions, and numbers:

| read | |
|---|---|
| displacement_gradient_1, _2 (, _3) | rows of d u_i / d x_j at the end of the step, since the start of the run |
| rotation | micro-rotation since the start, rad; of discs a number, about e_3 (cells with controlled rotations) |
| curvature | of discs (d w / d x_1, d w / d x_2) since the start, rad/m (the same) |
| curvature_1, _2, _3 | of spheres rows of d w_i / d x_j (the same) |

| written | |
|---|---|
| stress_1, _2 (, _3) | rows of the stress: on the face with the normal e_1, e_2 (, e_3); Pa, tension positive |
| couple_stress | of discs (m13, m23), N/m (cells with controlled rotations) |
| couple_stress_1, _2, _3 | of spheres rows: on the face with the normal e_1, ... (the same) |
| tangent_1, _2, ... | with tangent=True: Answer.tangent row by row, in vectors of as many components |
"""
import numpy as np

from .cell import Cell
from .errors import StepFailed

_MOST_CUTS = 6


def micro_simulation(packing, script, *, tangent=False, **settings):
    """The class that the Micro Manager makes its simulations of.

    packing, script, settings -- as of Cell
    tangent                   -- whether the tangent is written
    All simulations of a process share the definition of the cell, and its engines; give each process of the Micro Manager
    as many workers as it should have: engines=Engines(workers).
    """
    template = Cell(packing, script, **settings)

    class MicroSimulation:
        """One cell, by the calls of the Micro Manager."""

        def __init__(self, sim_id):
            self._id = sim_id
            self._cell = template.twin()
            self._given = _Given(np.zeros((3, 3)), np.zeros(3), np.zeros((3, 3)))

        def initialize(self, *_):
            """The answer of the packing at rest."""
            return _written(self._cell, self._cell.at_rest, tangent)

        def solve(self, macro_data, dt):
            """Goes to what is read; returns what is written. The time step has no meaning: grains are at rest at its end.

            A step that the cell cannot follow is halved, at most six times; then StepFailed.
            """
            wanted = _given(macro_data, self._cell.dimension)
            answer = self._go(self._given, wanted, _MOST_CUTS)
            self._given = wanted
            return _written(self._cell, answer, tangent)

        def _go(self, start, end, cuts):
            try:
                return self._cell.step(**start.increment_to(end, self._cell.has_controlled_rotations))
            except StepFailed:
                if cuts == 0:
                    raise
                kept = self._cell.state
                try:
                    middle = start.halfway_to(end)
                    self._go(start, middle, cuts - 1)
                    return self._go(middle, end, cuts - 1)
                except StepFailed:
                    self._cell.state = kept
                    raise

        def get_state(self):
            """A value: it can be copied, pickled, and given to another simulation."""
            return self._cell.state, self._given

        def set_state(self, state):
            self._cell.state, self._given = state

        def get_global_id(self):
            return self._id

        def set_global_id(self, sim_id):
            self._id = sim_id

    return MicroSimulation


class _Given:
    """The last input: displacement gradient, rotation, curvature since the start of the run; a value."""

    def __init__(self, gradient, rotation, curvature):
        self.gradient, self.rotation, self.curvature = gradient, rotation, curvature

    def increment_to(self, end, is_controlled):
        """The step from here, about its start. Gradients multiply, and are pushed to the start of the step."""
        back = np.linalg.inv(np.eye(3) + self.gradient)
        step = {"displacement_gradient": (end.gradient - self.gradient) @ back}
        if is_controlled:
            step["rotation"] = end.rotation - self.rotation
            step["curvature"] = (end.curvature - self.curvature) @ back
        return step

    def halfway_to(self, end):
        return _Given(*(0.5 * (one + other) for one, other in
                        ((self.gradient, end.gradient), (self.rotation, end.rotation), (self.curvature, end.curvature))))


def _given(data, dimension):
    gradient, rotation, curvature = np.zeros((3, 3)), np.zeros(3), np.zeros((3, 3))
    for row in range(dimension):
        gradient[row, :dimension] = data[f"displacement_gradient_{row + 1}"]
    if dimension == 2:
        rotation[2] = data.get("rotation", 0.0)
        curvature[2, :2] = data.get("curvature", 0.0)
    else:
        rotation[:] = data.get("rotation", 0.0)
        for row in range(3):
            curvature[row] = data.get(f"curvature_{row + 1}", 0.0)
    return _Given(gradient, rotation, curvature)


def _written(cell, answer, with_tangent):
    data = {f"stress_{row + 1}": stress for row, stress in enumerate(answer.stress)}
    if cell.has_controlled_rotations:
        if cell.dimension == 2:
            data["couple_stress"] = answer.couple_stress
        else:
            data.update({f"couple_stress_{row + 1}": couple for row, couple in enumerate(answer.couple_stress)})
    if with_tangent:
        parts = answer.tangent.reshape(-1, cell.dimension)
        data.update({f"tangent_{number + 1}": part for number, part in enumerate(parts)})
    return data
