# SPDX-License-Identifier: GPL-2.0-or-later
"""A case of the program as an object, and its run."""
import os
import pathlib
import tempfile

from .errors import RunError
from .program import call, data_file, worker_count
from .result import Result
from .specification import settings
from .table import read_table


class Case:
    """A case file with values of it changed.

        case = Case("cases/biaxial/case.yaml", {"steps.count": 10, "materials.sand.lc": "5 mm"})
        result = case.run("results/mine", workers=2)

    file          -- the case (docs/user_guide.md); one that the program brings along by its name
    overrides     -- {key: value}, as `--set key=value` has them: lists and numbers as Python's, units in texts;
                     a text names a file from the case, a pathlib.Path one from the current folder
    trust_scripts -- run scripts and libraries that can do more than set up cells (--trust-scripts)
    """

    def __init__(self, file, overrides=None, *, trust_scripts=False):
        self.file = data_file(file)
        self.overrides = dict(overrides or {})
        self.trust_scripts = trust_scripts

    def changed(self, overrides):
        """Another Case, with these values changed too."""
        return Case(self.file, {**self.overrides, **overrides}, trust_scripts=self.trust_scripts)

    def check(self):
        """The remarks of the program on it. Raises InputError with all faults at once."""
        return call("check", self.file, *self._words())

    def run(self, output=None, *, workers=None, resume=False, progress=None, checkpoint_minutes=None):
        """Runs it to its end, in processes of its own. Returns the Result.

        output   -- result directory [results/NAME in the current folder]
        workers  -- worker processes [one a core]; results do not depend on it
        resume   -- go on from the checkpoint in `output`, where there is one
        progress -- called with each committed step, a dict of its row of history.csv; True prints a line each, with the
                    monitors of the case
        Raises InputError, with nothing run or written; RunError when a step did not converge or the workers were lost,
        its `result` being what was committed (None where there is nothing). On Ctrl-C the run ends behind its last
        step, from which `resume` goes on.
        """
        if output is None:  # as the program itself has it
            output = pathlib.Path("results") / (self.file.resolve().parent.name if self.file.stem == "case" else self.file.stem)
        output = pathlib.Path(output)
        words = ["-o", output, "-w", worker_count(workers), "--quiet", *self._words()]
        if resume and (output / "checkpoint.h5").exists():
            words.append("--resume")
        if checkpoint_minutes is not None:
            words += ["--checkpoint-minutes", checkpoint_minutes]
        follower = _Follower(output / "history.csv", print_row if progress is True else progress)
        try:
            call("run", self.file, *words, on_wait=follower.look if progress else None)
        except RunError as error:
            error.result = Result(output) if (output / "history.csv").is_file() else None
            raise
        follower.look()
        return Result(output)

    def point(self, material, path, output=None):
        """Takes one point of a material along a path, as `polargrain point`. Returns a Table, a row an increment.

        path   -- a CSV file, or rows of increments as dicts: h11, h12, h21, h22, w, k1, k2; what is left out is 0
        output -- CSV file to keep
        Raises InputError; RunError when an increment failed.
        """
        with tempfile.TemporaryDirectory() as folder:
            if not isinstance(path, (str, os.PathLike)):
                names = ["h11", "h12", "h21", "h22", "w", "k1", "k2"]
                rows = [",".join(repr(float(row.get(name, 0.0))) for name in names) for row in path]
                path = pathlib.Path(folder) / "path.csv"
                path.write_text("\n".join([",".join(names), *rows]) + "\n", encoding="utf-8")
            output = output or pathlib.Path(folder) / "answers.csv"
            call("point", self.file, material, path, "-o", output, *self._words())
            return read_table(output)

    def _words(self):
        return [*(["--trust-scripts"] if self.trust_scripts else []), *settings(self.overrides)]

    def __repr__(self):
        return f"<polargrain.Case {self.file}>"


def run(case, overrides=None, output=None, **options):
    """Runs a case, a Case or its file, with values changed; options as Case.run. Returns the Result."""
    case = case if isinstance(case, Case) else Case(case)
    return case.changed(overrides or {}).run(output, **options)


def print_row(row):
    """A line for a step: its first monitors."""
    names = list(row)
    monitors = names[names.index("internal_work") + 1:]
    print(f"step {row['step']:g}:", ", ".join(f"{name} {row[name]:.6g}" for name in monitors), flush=True)


class _Follower:
    """Tells of rows of a history as they come."""

    def __init__(self, file, tell):
        self.file = file
        self.tell = tell
        self.told = 0
        # A history that lies there from an earlier run is not this one's until the program has begun it anew.
        self.before = _stamp(file)

    def look(self):
        if not self.tell or _stamp(self.file) in (None, self.before):
            return
        rows = read_table(self.file).rows
        for row in rows[self.told:]:
            self.tell(row)
        self.told = max(self.told, len(rows))


def _stamp(file):
    try:
        status = os.stat(file)
    except OSError:
        return None
    return status.st_ino, status.st_mtime_ns, status.st_size
