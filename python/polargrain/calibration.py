# SPDX-License-Identifier: GPL-2.0-or-later
"""Parameters of contacts from laboratory curves."""
import collections.abc
import pathlib
import tempfile

from .errors import RunError
from .program import call, data_file, worker_count
from .specification import specification_words
from .table import read_table


class Calibration:
    """The result of a calibration (docs/element_tests.md), from its folder.

    parameters -- {name: (best, low, high)}, the last two the 95 % interval from linearising around the best
    record     -- Table of all evaluations: parameters, misfit (mean square of the differences, in errors), differences
    script     -- path of the script with the best values; page: path of calibration.html
    """

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.record = read_table(self.folder / "record.csv")
        self.script = self.folder / "best.in"
        self.page = self.folder / "calibration.html"
        found = read_table(self.folder / "parameters.csv")
        self.parameters = {str(row["parameter"]): (float(row["best"]), float(row["low_95"]), float(row["high_95"]))
                           for row in found.rows}

    def __repr__(self):
        return "<polargrain.Calibration " + ", ".join(f"{name} {best:.4g}" for name, (best, *_) in self.parameters.items()) + ">"


def calibrate(laboratory, specification, output, overrides=None, *, workers=None, trust_scripts=False):
    """Finds values of variables of a script with which laboratory tests of cells give given curves.

    laboratory    -- CSV file of the curves, or a Table (a dict of columns)
    specification -- a file, or a dict with its keys: packing, script, parameters, tests, targets, ...
    output        -- folder; the same call goes on from what is there, the record of another calibration is refused
    Returns a Calibration. Raises InputError; RunError when the search did not converge, whose `result` is what it found.
    """
    output = pathlib.Path(output)
    output.mkdir(parents=True, exist_ok=True)
    if isinstance(laboratory, collections.abc.Mapping):
        rows = zip(*laboratory.values(), strict=True)
        text = [",".join(laboratory), *(",".join(_cell(value) for value in row) for row in rows)]
        laboratory = output / "laboratory.csv"
        laboratory.write_text("\n".join(text) + "\n", encoding="utf-8")
    with tempfile.TemporaryDirectory() as folder:
        try:
            call("calibrate", data_file(laboratory), *specification_words(specification, overrides, folder), "-o", output,
                 "-w", worker_count(workers), "--quiet", *(["--trust-scripts"] if trust_scripts else []), hidden=folder)
        except RunError as error:
            error.result = Calibration(output) if (output / "parameters.csv").is_file() else None
            raise
    return Calibration(output)


def _cell(value):
    return value if isinstance(value, str) else repr(float(value))
