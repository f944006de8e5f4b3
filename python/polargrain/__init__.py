# SPDX-License-Identifier: GPL-2.0-or-later
"""Granular materials on two scales: boxes of grains as material points, and finite elements over them.

    Cell, Engines, State, step_together        a box of grains, driven by you
    Case, run, Result                          a case of the program, its run, and what it left
    InputError, RunError, StepFailed           what goes wrong

Units are SI, tension is positive, the first index of a stress is the normal of the face. Grains live in processes of the
program `polargrain`: see `polargrain.program`. The pages of the project have a chapter on this package (docs/python.md).
"""
from .case import Case, run
from .cell import Answer, Cell, step_together
from .engines import Engines
from .errors import InputError, RunError, StepFailed
from .packing import Packing, read_packing
from .result import Result
from .state import State
from .version import VERSION as __version__

__all__ = ["Answer", "Case", "Cell", "Engines", "InputError", "Packing", "Result", "RunError", "State", "StepFailed",
           "__version__", "read_packing", "run", "step_together"]
