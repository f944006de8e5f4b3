# SPDX-License-Identifier: GPL-2.0-or-later
"""States of cells as values."""
from . import _cells
from .files import input_file, no_input, write_whole

State = _cells.State

_MARK = b"polargrain state 1\n"


def save(state, file):
    """Writes a state to a file, whole or not at all. A pipe or a device (/dev/null) takes the bytes and stays."""
    write_whole(file, _MARK + state.name.encode() + b"\n" + state.bytes)


def load(file):
    """The state in a file that `save` wrote. Raises InputError when it is missing, no state, or damaged."""
    try:
        with open(input_file(file), "rb") as stream:
            text = stream.read()
    except OSError as error:
        raise no_input(file, error.strerror) from error
    head = len(_MARK)
    if not text.startswith(_MARK) or text[head + 32:head + 33] != b"\n":
        raise no_input(file, "holds no state of a cell; name a file that State.save wrote")
    state = State.of_bytes(text[head + 33:])
    if state.name.encode() != text[head:head + 32]:
        raise no_input(file, "is damaged: its content is not what was written; take another copy")
    return state


State.save = save
State.load = staticmethod(load)
