# SPDX-License-Identifier: GPL-2.0-or-later
"""Prepared sets of grains."""
from . import _cells
from .program import call, data_file

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
len()        -- number of grains
"""


def read_packing(file):
    """The packing in a file (HDF5 of `polargrain pack`, or CSV). Raises InputError naming file and line."""
    return _cells.read_packing(str(data_file(file)))
