# SPDX-License-Identifier: GPL-2.0-or-later
"""Prepared sets of grains."""
import hashlib
import tempfile

import numpy as np

from . import _cells
from .program import call, data_file
from .specification import specification_words

Packing = _cells.Packing
Packing.__doc__ = """Grains in a periodic box, at rest: what cells start from. Read by `read_packing`, made by `pack`.

dimension    -- 2: discs; 3: spheres in space
box          -- base vectors of the periodic box as columns, m; shape (2, 2) or (3, 3)
thickness    -- of discs, out of the plane, m
positions    -- centres, m; shape (n, 2) or (n, 3)
radii        -- m; shape (n,)
masses       -- kg; shape (n,)
pressure     -- mean normal stress at rest when it was made, compression positive, Pa; 0: not recorded
volume       -- of the box, m^3
grain_volume -- of the grains, m^3
name         -- 32 hexadecimal digits; packings of the same grains, wherever they lie, have the same name
len()        -- number of grains
"""


def _name(packing):
    of_discs = [packing.thickness] if packing.dimension == 2 else []
    grains = np.concatenate([[packing.dimension], of_discs, packing.radii, packing.masses])
    return hashlib.blake2b(grains.tobytes(), digest_size=16).hexdigest()


Packing.name = property(_name)


def read_packing(file):
    """The packing in a file (HDF5 of `pack`, or CSV). Raises InputError naming file and line."""
    return _cells.read_packing(str(data_file(file)))


def pack(specification, output, overrides=None, *, trust_scripts=False):
    """Makes a packing and keeps it in a file. Returns the Packing.

    specification -- a file, or a dict with its keys (docs/user_guide.md, Packings): grains, sizes, density, thickness,
                     script, pressure, friction, seed, ...
    output        -- file to write, NAME.h5
    overrides     -- {key: value} in place of what stands there
    Equal specifications give equal files. Raises InputError; RunError when the grains do not come to rest.
    """
    with tempfile.TemporaryDirectory() as folder:
        call("pack", *specification_words(specification, overrides, folder), "-o", output, "--quiet",
             *(["--trust-scripts"] if trust_scripts else []), hidden=folder)
    return read_packing(output)
