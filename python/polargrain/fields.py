# SPDX-License-Identifier: GPL-2.0-or-later
"""Meshes and fields as runs leave them (VTU files, docs/file_formats.md)."""
import base64
import pathlib
import xml.etree.ElementTree as ElementTree
import zlib

import numpy as np

from .errors import InputError
from .files import input_file, no_input

_TYPES = {"Float64": "<f8", "Float32": "<f4", "Int64": "<i8", "Int32": "<i4", "UInt8": "<u1"}
_OUTLINES = {22: [0, 3, 1, 4, 2, 5], 23: [0, 4, 1, 5, 2, 6, 3, 7]}  # quadratic triangle, quadratic quadrilateral


class Fields:
    """A mesh with its fields at one time of a run; the integration points with theirs; or the grains of one of them.

    points       -- places as the mesh was made, m; shape (n, 3)
    cells        -- numbers of the nodes of each element, a list of integer arrays
    types        -- VTK's number of the type of each element, an integer array
    point_data   -- fields of the nodes (or integration points) by name; shape (n,) or (n, components)
    cell_data    -- fields of the elements, means over their volume
    components   -- names of the components of a field: {"stress": ["11", "22", "33", "12", "21"], ...}
    units        -- {"stress": "Pa", ...}
    """

    def __init__(self, file):
        self.file = pathlib.Path(file)
        try:
            root = ElementTree.parse(input_file(self.file)).getroot()
        except (OSError, ElementTree.ParseError) as error:
            raise InputError(f"{file}: {error}", [(str(file), 0, str(error))]) from error
        piece = root.find("UnstructuredGrid/Piece")
        if piece is None:
            message = "is no VTU file of an unstructured grid"
            raise InputError(f"{file}: {message}", [(str(file), 0, message)])
        try:
            self._read(root, piece)
        except (KeyError, TypeError, AttributeError, ValueError, zlib.error) as error:
            raise no_input(file, f"was cut or changed ({error!r})") from error

    def _read(self, root, piece):
        self._compressed = root.get("compressor") is not None
        self.components = {}
        self.units = {}
        self.point_data = self._arrays(piece.find("PointData"))
        self.cell_data = self._arrays(piece.find("CellData"))
        self.points = _values(piece.find("Points/DataArray"), self._compressed)
        cells = {array.get("Name"): _values(array, self._compressed) for array in piece.findall("Cells/DataArray")}
        self.types = cells["types"]
        self.cells = np.split(cells["connectivity"], cells["offsets"][:-1]) if len(cells["offsets"]) else []

    def outlines(self):
        """The nodes around each element, in order, those in the middle of its sides too."""
        return [cell[_OUTLINES[kind]] if kind in _OUTLINES else cell for kind, cell in zip(self.types, self.cells)]

    def _arrays(self, element):
        fields = {}
        for array in element if element is not None else ():
            name = array.get("Name")
            fields[name] = _values(array, self._compressed)
            count = int(array.get("NumberOfComponents", "1"))
            self.components[name] = [array.get(f"ComponentName{k}", str(k + 1)) for k in range(count)] if count > 1 else []
            for key in array.findall("InformationKey"):
                if key.get("name") == "UNITS_LABEL":
                    self.units[name] = key.text
        return fields

    def __repr__(self):
        return f"<polargrain.Fields of {len(self.points)} points, {len(self.cells)} cells: {', '.join(self.point_data)}>"


def _inflated(text):
    """Data of VTK's zlib compressor: the number of blocks, two sizes, the size of each compressed block; then the blocks."""
    count = int.from_bytes(base64.b64decode(text[:12])[:8], "little")
    size = 8 * (3 + count)
    end = -(-size // 3) * 4
    sizes = np.frombuffer(base64.b64decode(text[:end]), dtype="<u8")[3:]
    blocks, data = base64.b64decode(text[end:]), b""
    for size in sizes:
        data += zlib.decompress(blocks[:size])
        blocks = blocks[size:]
    return data


def _values(array, compressed):
    kind = np.dtype(_TYPES[array.get("type")])
    if array.get("format") == "ascii":
        values = np.array((array.text or "").split(), dtype=kind)
    elif compressed:
        values = np.frombuffer(_inflated((array.text or "").strip()), dtype=kind).copy()
    else:
        # In base64 a header of eight bytes with the number of bytes that follow.
        values = np.frombuffer(base64.b64decode((array.text or "").strip()), dtype=np.uint8)[8:].view(kind).copy()
    count = int(array.get("NumberOfComponents", "1"))
    return values.reshape(-1, count) if count > 1 else values
