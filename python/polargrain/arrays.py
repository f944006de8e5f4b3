# SPDX-License-Identifier: GPL-2.0-or-later
"""Arrays of real numbers."""
import numpy as np


def real_array(values, name):
    """Numbers of a user as an array of floats. Raises ValueError for values that numpy would turn into numbers without a word:
    complex numbers, truth values, texts, dates, and arrays that hide some of theirs (masked)."""
    given = np.asarray(values)
    if np.ma.is_masked(values):
        raise ValueError(f"{name}: real numbers are expected, and some of these are masked")
    if given.dtype.kind == "O":
        kinds = {type(value) for value in given.ravel()} & {str, bytes, bool, type(None)}
        if kinds:
            raise ValueError(f"{name}: real numbers are expected, not {kinds.pop().__name__}")
    elif given.dtype.kind not in "fiu":
        raise ValueError(f"{name}: real numbers are expected, not {given.dtype}")
    return given.astype(float)
