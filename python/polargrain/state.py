# SPDX-License-Identifier: GPL-2.0-or-later
"""States of cells as values."""
from . import _cells
from .errors import InputError

State = _cells.State

_MARK = b"polargrain state 1\n"


def save(state, file):
    """Writes a state to a file, whole or not at all."""
    import os
    import pathlib
    file = pathlib.Path(file)
    part = file.with_name(file.name + ".part")
    part.write_bytes(_MARK + state.name.encode() + b"\n" + state.bytes)
    os.replace(part, file)


def load(file):
    """The state in a file that `save` wrote. Raises InputError when it is missing, no state, or damaged."""
    try:
        with open(file, "rb") as stream:
            text = stream.read()
    except OSError as error:
        raise InputError(f"{file}: {error.strerror}", [(str(file), 0, error.strerror)]) from error
    head = len(_MARK)
    if not text.startswith(_MARK) or text[head + 32:head + 33] != b"\n":
        raise _no_state(file, "holds no state of a cell; name a file that State.save wrote")
    state = State.of_bytes(text[head + 33:])
    if state.name.encode() != text[head:head + 32]:
        raise _no_state(file, "is damaged: its content is not what was written; take another copy")
    return state


def _no_state(file, message):
    return InputError(f"{file}: {message}", [(str(file), 0, message)])


State.save = save
State.load = staticmethod(load)
