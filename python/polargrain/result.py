# SPDX-License-Identifier: GPL-2.0-or-later
"""The result of a run."""
import json
import pathlib
import xml.etree.ElementTree as ElementTree

from .errors import InputError
from .fields import Fields
from .files import input_file, no_input
from .program import call
from .table import read_table


class Result:
    """The result directory of a run (docs/file_formats.md), read when it is asked for.

    directory -- where it lies
    """

    def __init__(self, directory):
        self.directory = pathlib.Path(directory)
        if not (self.directory / "history.csv").is_file():
            message = "is no result of a run: there is no history.csv in it"
            raise InputError(f"{directory}: {message}", [(str(directory), 0, message)])

    @property
    def history(self):
        """A Table with a row for each committed step: step, time, residuals, work, and the monitors of the case."""
        return read_table(self.directory / "history.csv")

    @property
    def costs(self):
        """A Table of where the wall time of each step went, s."""
        return read_table(self.directory / "costs.csv")

    @property
    def summary(self):
        """summary.json as a dict: status, errors, costs, figures of materials, proof."""
        file = input_file(self.directory / "summary.json")
        try:
            with open(file, encoding="utf-8") as text:
                return json.load(text)
        except (OSError, ValueError) as error:
            raise no_input(file, str(error)) from error

    @property
    def times(self):
        """Times, 0 to 1, at which there are fields."""
        return [time for time, _ in self._files("fields.pvd")]

    def fields(self, number=-1):
        """The Fields of the mesh: of the last of `times`, or of any, counted as a list is. InputError where there are not so
        many."""
        return Fields(self._file_at("fields.pvd", number))

    def integration_points(self, number=-1):
        """The Fields at the integration points; InputError where the case has `output: {points: no}`."""
        return Fields(self._file_at("points.pvd", number))

    def band(self, begin=None, end=None, *, window=None, contrast=None, strain=None, current=False):
        """Measures the shear band, by the ruler that grains and finite elements share (`polargrain band`).

        begin, end -- axial strains of the increment that it is looked for in [two thirds of the last; the last]
        window     -- axial strain of the increments for its onset [0.005]
        contrast   -- least shear of a band over the background [2]
        strain     -- column of the history with the axial strain [axial_strain]
        current    -- measure where places are at `begin`, not at the start of the run
        Returns a dict as band.json has it (docs/file_formats.md): found, or the reason; inclination_degrees, thickness (m),
        onset_strain, ...; and, of a band, "increments", the Table of band.csv.
        Raises InputError when the directory does not hold what is needed.
        """
        call("band", self.directory, *option_words({"from": begin, "to": end, "window": window, "contrast": contrast,
                                                    "strain": strain, "current": current}))
        with open(self.directory / "band.json", encoding="utf-8") as text:
            measured = json.load(text)
        if measured["found"]:
            measured["increments"] = read_table(self.directory / "band.csv")
        return measured

    def grains(self, point, steps=None):
        """The grains of an integration point: {step: Fields}, with grains as points and contacts as cells.

        point -- its number, as in `integration_points()`
        steps -- steps of the history [all]; "last"
        The way of the point is led again, with the same bits (docs/howto/point.md), and the files
        are left in DIR/grains. Raises InputError for a point without grains, RunError when they cannot be led again.
        """
        chosen = ["--last"] if steps == "last" else [word for step in steps or () for word in ("--step", step)]
        call("grains", self.directory, "--point", point, *chosen, "--quiet")
        return {int(file.stem.split("-")[1]): Fields(file) for _, file in self._files(f"grains/point-{point}.pvd")}

    def verify(self, workers=1):
        """Holds the result against its proof and evaluates some of its cells again. Returns the words of the program.

        Raises RunError when something differs.
        """
        return call("verify", self.directory, "-w", workers)

    def report(self):
        """Makes report.html and returns its path."""
        call("report", self.directory)
        return self.directory / "report.html"

    def _file_at(self, collection, number):
        files = self._files(collection)
        if not -len(files) <= number < len(files):
            raise no_input(self.directory / collection, f"names fields at {len(files)} times, the first being number 0; there "
                                                        f"is no number {number}")
        return files[number][1]

    def _files(self, collection):
        file = input_file(self.directory / collection)
        try:
            sets = ElementTree.parse(file).getroot().iter("DataSet")
            return [(float(one.get("timestep")), file.parent / one.get("file")) for one in sets]
        except (OSError, ElementTree.ParseError, TypeError, ValueError) as error:
            raise no_input(file, f"is no list of fields ({error})") from error

    def __repr__(self):
        return f"<polargrain.Result {self.directory}>"


def option_words(options):
    """Options of the command line by their names: --name value; --name alone for True."""
    words = []
    for name, value in options.items():
        if value is True:
            words.append(f"--{name}")
        elif value is not None and value is not False:
            words += [f"--{name}", value]
    return words
