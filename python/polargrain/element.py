# SPDX-License-Identifier: GPL-2.0-or-later
"""Laboratory tests of one material point."""
import pathlib
import tempfile

import numpy as np

from .errors import RunError
from .program import call, worker_count
from .specification import specification_words
from .table import Table, read_table


class ElementResult:
    """The result of a laboratory test of one point (docs/element_tests.md).

    curves -- {packing: Table}, a row for each recorded row: axial_strain, volume_strain, s11_Pa, p_Pa, q_Pa, stress_ratio,
              friction_angle_deg, void_ratio, ... (tension positive, p and q positive in compression)
    mean   -- Table of the means over the packings: n, and for each column its mean and half the width of its 95 % interval
              (_half_95); None of a single packing
    """

    def __init__(self, table, mean):
        names = table.pop("packing")
        self.curves = {str(name): Table({column: values[names == name] for column, values in table.items()})
                       for name in dict.fromkeys(names)}
        self.mean = mean

    def __repr__(self):
        return f"<polargrain.ElementResult of {', '.join(self.curves)}>"


def element_test(specification, overrides=None, *, output=None, workers=None, trust_scripts=False):
    """Does with a material point what a soil laboratory does with a specimen. Returns an ElementResult.

    specification -- a file, or a dict with its keys (docs/element_tests.md): packing (a file or a list of them) and script,
                     or material; pressure; test, or stages; ...
    overrides     -- {key: value} in place of what stands there
    output        -- NAME: keeps NAME.csv, NAME.html and NAME_mean.csv
    workers       -- worker processes [one a core]; results do not depend on it
    Raises InputError; RunError when a test ended early, whose `result` is what there is of the curves.
    """
    with tempfile.TemporaryDirectory() as folder:
        name = pathlib.Path(output or pathlib.Path(folder) / "element")
        words = specification_words(specification, overrides, folder)
        try:
            call("element", *words, "-o", name, "-w", worker_count(workers), "--quiet",
                 *(["--trust-scripts"] if trust_scripts else []), hidden=folder)
        except RunError as error:
            error.result = _result(name)
            raise
        return _result(name)


def _result(name):
    table, mean = (name.with_name(name.name + ending) for ending in (".csv", "_mean.csv"))
    if not table.is_file():
        return None
    columns = read_table(table)
    columns["packing"] = np.array([str(packing) for packing in columns["packing"]])
    return ElementResult(columns, read_table(mean) if len(set(columns["packing"])) > 1 and mean.is_file() else None)
