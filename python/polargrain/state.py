# SPDX-License-Identifier: GPL-2.0-or-later
"""States of cells as values."""
from . import _cells
from .files import input_file, no_input, write_whole

_MARK = b"polargrain state 2\n"
_MARK_WITHOUT_PACKING = b"polargrain state 1\n"  # of 0.3.0
_NAME = 32  # digits


class State:
    """All that a cell needs to go on: its box, its grains, the histories of their contacts.

    A value: it never changes, keeping one is saving, giving one back to a cell is going back. States can be compared,
    pickled, and sent to other processes and machines of the same type. What is in them is the business of the engine.

    bytes   -- as they are kept
    name    -- 32 hexadecimal digits; equal states have equal names
    packing -- Packing.name of the grains that it is of: no other cells take it; "" where nobody knows
    len()   -- number of bytes
    """

    __slots__ = ("_kept", "_packing")

    def __init__(self, kept, packing):
        self._kept, self._packing = kept, packing

    @staticmethod
    def of_bytes(text, packing=""):
        """The state whose `bytes` and `packing` these are."""
        return State(_cells.State.of_bytes(text), packing)

    @property
    def bytes(self):
        return self._kept.bytes

    @property
    def name(self):
        return self._kept.name

    @property
    def packing(self):
        return self._packing

    def save(self, file):
        """Writes it to a file, whole or not at all. A pipe or a device (/dev/null) takes the bytes and stays."""
        if self.packing:
            head = _MARK + self.packing.encode() + b"\n"
        else:
            head = _MARK_WITHOUT_PACKING
        write_whole(file, head + self.name.encode() + b"\n" + self.bytes)

    @staticmethod
    def load(file):
        """The state in a file that `save` wrote. Raises InputError when it is missing, no state, or damaged."""
        try:
            with open(input_file(file), "rb") as stream:
                text = stream.read()
        except OSError as error:
            raise no_input(file, error.strerror) from error
        packing = b""
        if text.startswith(_MARK):
            packing, text = _line(text[len(_MARK):])
        elif text.startswith(_MARK_WITHOUT_PACKING):
            text = text[len(_MARK_WITHOUT_PACKING):]
        else:
            text = b""
        name, text = _line(text)
        if name is None or packing is None:
            raise no_input(file, "holds no state of a cell; name a file that State.save wrote")
        state = State.of_bytes(text, packing.decode(errors="replace"))
        if state.name.encode() != name:
            raise no_input(file, "is damaged: its content is not what was written; take another copy")
        return state

    def __len__(self):
        return len(self._kept)

    def __eq__(self, other):
        return self.name == other.name if isinstance(other, State) else NotImplemented

    def __hash__(self):
        return hash(self.name)

    def __reduce__(self):
        return _again, (self.bytes, self.packing)

    def __repr__(self):
        return f"<polargrain.State {self.name[:8]}>"


def _again(text, packing):
    return State.of_bytes(text, packing)


def _line(text):
    """The name that a text begins with, and what stands behind its line; None where there is no such line."""
    return (text[:_NAME], text[_NAME + 1:]) if text[_NAME:_NAME + 1] == b"\n" else (None, b"")
