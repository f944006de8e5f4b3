# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables of numbers."""
import csv

import numpy as np

from .files import input_file


class Table(dict):
    """Columns by their names, NumPy arrays of one length: numbers, or texts where a cell is none.

    `rows` is a list of dicts; `frame()` is a pandas DataFrame of it, where pandas is installed.
    """

    @property
    def rows(self):
        """One dict a row."""
        return [dict(zip(self, values)) for values in zip(*self.values())]

    def frame(self):
        """The same as a pandas DataFrame. Raises ImportError without pandas."""
        import pandas
        return pandas.DataFrame(dict(self))


def read_table(file):
    """The Table in a CSV file that the program wrote. A cell with nothing in it is not a number (nan)."""
    with open(input_file(file), newline="", encoding="utf-8") as text:
        lines = csv.reader(line for line in text if not line.startswith("#"))
        names = next(lines, [])
        cells = [row for row in lines if len(row) == len(names)]
    return Table({name: _column([row[place] for row in cells]) for place, name in enumerate(names)})


def _column(cells):
    try:
        return np.array([float(cell) if cell else np.nan for cell in cells])
    except ValueError:
        return np.array(cells)
