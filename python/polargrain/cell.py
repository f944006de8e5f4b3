# SPDX-License-Identifier: GPL-2.0-or-later
"""A box of grains as a material point."""
import contextlib
import pathlib
import threading

import numpy as np

from . import _cells
from .arrays import real_array
from .engines import shared_engines
from .errors import InputError, StepFailed
from .program import data_file
from .state import State

_PLANE = [0, 1, 3, 4, 11, 14]  # places of s11 s12 s21 s22 m13 m23 among the eighteen
_NINE = [f"{i}{j}" for i in (1, 2, 3) for j in (1, 2, 3)]
_NAMES = [f"s{ij}" for ij in _NINE] + [f"m{ij}" for ij in _NINE]


class Answer:
    """The answer of a cell to an increment. Its arrays cannot be written to; take a copy to change one.

    stress        -- Pa, tension positive, first index the normal of the face; shape (2, 2) of discs, (3, 3) of spheres
    couple_stress -- N/m, first index the normal of the face, second the axis of the moment; of discs (m13, m23), shape
                     (2,); of spheres shape (3, 3)
    tangent       -- d (stress, couple stress) / d (strain, curvature), rows and columns in the order of `Cell.components`;
                     shape (6, 6) or (18, 18), in Pa where both are stress and strain, N where both are couple stress and
                     curvature, N/m and Pa m between. The strain is that of the Cosserat continuum,
                     eps_ij = h_ji - e_ijk w_k with the displacement gradient h_ij = d u_i / d x_j and the rotation w_k;
                     the curvature on which m_ij works is d w_j / d x_i
    state         -- the state of the grains after the increment; None when there is no answer
    quality       -- "good": within the tolerances of the cell; "unreliable": numbers that may guide an iteration;
                     "failed": no numbers
    message       -- why it is not good; or what the engine remarked on the packing
    step_factor   -- the fraction of the increment to try instead, in (0, 1), when it is not good
    diagnostics   -- void_ratio, coordination_number, sliding_fraction, ... by name; `polargrain.cell.diagnostics()` says
                     their units and meanings
    """

    def __init__(self, reply, dimension, packing):
        self.stress = reply.stress
        self.couple_stress = reply.couple_stress
        self.tangent = reply.tangent
        if dimension == 2:
            self.stress = self.stress[:2, :2]
            self.couple_stress = self.couple_stress[:2, 2]
            self.tangent = self.tangent[np.ix_(_PLANE, _PLANE)]
        for values in (self.stress, self.couple_stress, self.tangent):
            values.flags.writeable = False  # several who ask may hold the one answer of a packing at rest
        self.state = State(reply.state, packing) if reply.state is not None else None
        self.quality = reply.quality
        self.message = reply.message
        self.step_factor = reply.step_factor
        self.diagnostics = reply.diagnostics

    @property
    def vector(self):
        """Stress and couple stress in the order of the tangent, shape (6,) or (18,)."""
        return np.concatenate([np.ravel(self.stress), np.ravel(self.couple_stress)])

    def __repr__(self):
        stress = np.array2string(self.stress, precision=6, separator=", ").replace("\n", "")
        return f"<polargrain.Answer {self.quality}: stress {stress} Pa>"


def diagnostics():
    """The fields of `Answer.diagnostics`: {name: (unit, meaning)}."""
    return _cells.diagnostics_notes()


class Cell:
    """A periodic box of discs, or of spheres in space, that follows what its point feels.

        cell = Cell("packing.h5", "cells/hooke_radii.in")
        answer = cell.step([[1.0, 0.0], [0.0, 0.999]])
        print(answer.stress, cell.state)

    packing   -- a file (HDF5 of `polargrain pack`, CSV) or a Packing
    script    -- LIGGGHTS input script of the contacts; one that the program brings along by its name
    rotations -- "free": rotations of the grains follow their moments alone, stresses are symmetric, couple stresses zero.
                 "controlled": their mean rotation and its gradient are prescribed too
    engines   -- the processes that serve it; None: one worker that all such cells share
    settings  -- how it is loaded and read out, under the keys that a material of `model: cell` has for it
                 (docs/user_guide.md): inertial_number, unbalanced_force_ratio, unbalanced_moment_ratio, damping,
                 least_steps, most_relaxation_steps, tangent, loop, contact_library

    The packing is brought to rest with the first question. Any threads may ask one cell: its steps are taken one after the
    other, each from where the one before it ended. Raises InputError with all faults of what was given. Cells can
    be pickled, with their states.

    dimension  -- 2: discs; 3: spheres
    components -- names of the stresses and couple stresses in the order of vectors and tangents
    """

    def __init__(self, packing, script, *, rotations="free", engines=None, trust_scripts=False, **settings):
        script = data_file(script)
        words = {"script": script, "rotations": rotations, **settings}
        if not isinstance(packing, _cells.Packing):
            words["packing"], packing = data_file(packing), None
        directory = str(script.parent if script.is_absolute() else pathlib.Path.cwd())
        trusted = trust_scripts or (engines is not None and engines.trust_scripts)
        self._definition = _cells.Definition([(key, _word(value)) for key, value in words.items()], packing, directory,
                                             trusted)
        self._prepare(engines or shared_engines(trusted))

    def _prepare(self, engines):
        self._engines = engines
        self._lock = threading.RLock()  # held from reading where the cell is to being elsewhere
        self.dimension = self._definition.packing.dimension
        self.components = [_NAMES[place] for place in (_PLANE if self.dimension == 2 else range(18))]
        self._packing_name = self.packing.name
        self._state = None
        self._answer = None

    def twin(self):
        """Another cell of the same definition, at rest, served by the same engines. Cheaper than making it anew."""
        twin = object.__new__(Cell)
        twin._definition = self._definition
        twin._prepare(self._engines)
        if hasattr(self, "_initial"):
            twin._initial = self._initial
        return twin

    @property
    def has_controlled_rotations(self):
        """Whether its grains follow the rotation and the curvature that they are given."""
        return self._definition.has_controlled_rotations

    @property
    def packing(self):
        """The Packing that it starts from."""
        return self._definition.packing

    @property
    def at_rest(self):
        """The Answer of the packing at rest, before any step. Raises StepFailed when it cannot be brought to rest."""
        return _checked(self._ask_initial())

    @property
    def state(self):
        """Where its grains are: a State. Give it one that was kept to go back, or to go on elsewhere."""
        return self._state if self._state is not None else self.at_rest.state

    @state.setter
    def state(self, state):
        own = self._own(state)
        with self._lock:
            self._state = own
            self._answer = None

    @property
    def answer(self):
        """The Answer of the last step; before the first step, the one at rest; None once a state was given."""
        with self._lock:
            if self._answer is None and self._state is None:
                return self.at_rest
            return self._answer

    def reset(self):
        """Back to the packing at rest."""
        with self._lock:
            self._state = None
            self._answer = None

    def evaluate(self, F=None, rotation=None, curvature=None, *, displacement_gradient=None, state=None):
        """Its answer to an increment; the cell stays where it is. Returns an Answer of any quality.

        All increments are about the start of the step, from the cell's state or from `state`:

        F        -- deformation gradient of the step, d x_end / d x_start; shape (2, 2) or (3, 3)
        displacement_gradient -- in its place: F - 1, without the digits that the 1 takes away
        rotation -- change of the micro-rotation, rad, right-handed; a number about e_3, or shape (3,)
        curvature -- its gradient, rad/m; of discs (d w / d x_1, d w / d x_2), shape (2,); or d w_i / d x_j, shape (3, 3)

        Rotation and curvature are for cells with controlled rotations, which a free one does not feel: InputError.
        Raises RunError when no worker can answer.
        """
        question = self._question(F, rotation, curvature, displacement_gradient, state)
        return self._answer_of(self._engines._cells.evaluate([question])[0])

    def step(self, F=None, rotation=None, curvature=None, *, displacement_gradient=None):
        """The same, and goes there. Returns the Answer, whose quality is "good".

        Raises StepFailed, the cell staying where it was, when the answer is not good; its `step_factor` says how much of
        the increment to try instead.
        """
        with self._lock:
            return self._take(self.evaluate(F, rotation, curvature, displacement_gradient=displacement_gradient))

    def _take(self, answer):
        _checked(answer)
        self._state = answer.state
        self._answer = answer
        return answer

    def _ask_initial(self):
        if not hasattr(self, "_initial"):
            self._initial = self._answer_of(self._engines._cells.initial(self._definition))
        return self._initial

    def _question(self, F, rotation, curvature, displacement_gradient, state=None):
        if (F is None) == (displacement_gradient is None):
            raise TypeError("give one of F and displacement_gradient")
        h = np.zeros((3, 3))
        given = real_array(F if F is not None else displacement_gradient, "F or displacement_gradient")
        if given.shape not in ((2, 2), (3, 3)):
            raise ValueError(f"F or displacement_gradient: a matrix of 2 x 2 or 3 x 3 is expected, not of shape {given.shape}")
        if F is not None:
            given = given - np.eye(len(given))
        h[:len(given), :len(given)] = given
        w = np.zeros(3)
        if rotation is not None:
            _put(w, rotation, {(): slice(2, 3), (3,): slice(0, 3)}, "rotation: a number about e_3 or three numbers")
        k = np.zeros((3, 3))
        if curvature is not None:
            _put(k, curvature, {(2,): (2, slice(0, 2)), (3, 3): slice(0, 3)}, "curvature: two numbers or a matrix of 3 x 3")
        for name, values in (("F or displacement_gradient", h), ("rotation", w), ("curvature", k)):
            if not np.all(np.isfinite(values)):
                raise ValueError(f"{name}: finite numbers are expected")
        if not self._definition.has_controlled_rotations and (np.any(w) or np.any(k)):
            raise InputError("the rotations of this cell are free: it feels neither rotation nor curvature; make it "
                             "with rotations=\"controlled\", or leave them out")
        start = self._own(state) if state is not None else self._state
        return (self._definition, start._kept if start is not None else None, h, w, k)

    def _answer_of(self, reply):
        return Answer(reply, self.dimension, self._packing_name)

    def _own(self, state):
        """The same state. Raises InputError when it is of other grains: the cell would answer with its own, and mean nothing."""
        if not isinstance(state, State):
            raise TypeError(f"a State is expected, such as Cell.state gives; this is {state!r}")
        if state.packing not in ("", self._packing_name):
            raise InputError(f"this state is of the packing {state.packing}, and the cell is of {self._packing_name} "
                             "(Packing.name), whose grains are others; give it to a cell of its own packing")
        return state

    def __getstate__(self):
        return {"definition": self._definition, "engines": None if self._engines is shared_engines(False) else self._engines,
                "state": self._state}

    def __setstate__(self, kept):
        self._definition = kept["definition"]
        self._prepare(kept["engines"] or shared_engines(False))
        self._state = kept["state"]

    def __repr__(self):
        kind = "discs" if self.dimension == 2 else "spheres"
        return f"<polargrain.Cell of {len(self.packing)} {kind}>"


def step_together(cells, gradients, rotations=None, curvatures=None):
    """Steps several cells at once, shared out over the workers of their engines, which must be the same.

    gradients            -- a deformation gradient for each (Cell.step)
    rotations, curvatures -- one for each, or None
    Returns the Answers. Raises StepFailed for the first that is not good; then none of the cells has moved.
    """
    cells = list(cells)
    nothing = [None] * len(cells)
    if len({id(cell._engines) for cell in cells}) > 1:
        raise ValueError("cells that step together must share their engines: Cell(..., engines=engines)")
    if len({id(cell) for cell in cells}) < len(cells):
        raise ValueError("one cell cannot take two steps at once; make two of it")
    gradients, rotations, curvatures = (nothing if given is None else list(given) for given in (gradients, rotations, curvatures))
    for name, given in (("gradients", gradients), ("rotations", rotations), ("curvatures", curvatures)):
        if len(given) != len(cells):
            raise ValueError(f"{name}: one for each of the {len(cells)} cells is expected, found {len(given)}")
    with contextlib.ExitStack() as locks:
        for cell in sorted(cells, key=id):  # in one order, or two threads would wait for each other
            locks.enter_context(cell._lock)
        questions = [cell._question(F, w, k, None) for cell, F, w, k in
                     zip(cells, gradients, rotations, curvatures)]
        if not questions:
            return []
        replies = cells[0]._engines._cells.evaluate(questions)
        answers = [_checked(cell._answer_of(reply)) for cell, reply in zip(cells, replies)]
        return [cell._take(answer) for cell, answer in zip(cells, answers)]


def _checked(answer):
    if answer.quality != "good":
        raise StepFailed(answer)
    return answer


def _put(values, given, places, expected):
    given = real_array(given, expected.split(":")[0])
    if given.shape not in places:
        raise ValueError(f"{expected} are expected, not an array of shape {given.shape}")
    values[places[given.shape]] = given


def _word(value):
    """A value as a case would write it."""
    return repr(float(value)) if isinstance(value, (float, np.floating)) else str(value)
