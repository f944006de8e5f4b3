# SPDX-License-Identifier: GPL-2.0-or-later
"""Granular materials on two scales: boxes of grains as material points, and finite elements over them.

    Cell, Engines, State, step_together        a box of grains, driven by you
    Case, run, Result, Fields                  a case of the program, its run, and what it left
    read_packing, pack                         sets of grains
    element_test, calibrate                    laboratory tests of a material point, and parameters from them
    find_band, displacement_gradients          shear bands in scattered points
    plots                                      pictures, with matplotlib
    InputError, RunError, StepFailed           what goes wrong

Units are SI, tension is positive, the first index of a stress is the normal of the face. Grains live in processes of the
program `polargrain`: see `polargrain.program`. The pages of the project have a chapter on this package (docs/python.md).
"""
from .band import displacement_gradients, find_band
from .calibration import Calibration, calibrate
from .case import Case, run
from .cell import Answer, Cell, step_together
from .element import ElementResult, element_test
from .engines import Engines
from .errors import InputError, RunError, StepFailed
from .fields import Fields
from .packing import Packing, pack, read_packing
from .result import Result
from .state import State
from .version import VERSION as __version__

__all__ = ["Answer", "Calibration", "Case", "Cell", "ElementResult", "Engines", "Fields", "InputError", "Packing", "Result",
           "RunError", "State", "StepFailed", "__version__", "calibrate", "displacement_gradients", "element_test", "find_band",
           "pack", "read_packing", "run", "step_together"]
