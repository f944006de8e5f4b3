# SPDX-License-Identifier: GPL-2.0-or-later
"""The processes in which the grains of cells live."""
import atexit
import weakref

from . import _cells
from .program import program


class Engines:
    """Worker processes of the program, each with engines for the cells that ask it.

    workers       -- how many; results do not depend on it, to the last bit. More than one serve `step_together`
    trust_scripts -- run scripts of cells that can do more than set up a cell, and libraries of contact laws, as the
                     program does under --trust-scripts

    They start with the first question and end with `close`, with the `with` block, or with the interpreter. A worker that
    dies is replaced, and what it held is made again; after a RunError that ends them all the next question starts others.
    Questions may come from any thread; one at a time is served, the interpreter is free for other threads meanwhile, and
    Ctrl-C ends it. A process made by fork cannot use the engines of its parent (RunError): use multiprocessing's "spawn".
    """

    def __init__(self, workers=1, *, trust_scripts=False):
        if int(workers) < 1:
            raise ValueError("workers: at least one")
        self.workers = int(workers)
        self.trust_scripts = bool(trust_scripts)
        self._cells = _cells.Engines([program(), "worker"], self.workers, self.trust_scripts)
        _ALL.add(self)

    def close(self):
        """Ends the workers now; the next question starts others."""
        self._cells.close()

    def counts(self):
        """The costs of cells since the workers were started last: evaluations, dem_steps, workers_lost, engine_seconds
        (s, summed over the workers), as a dict."""
        return self._cells.counts()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def __reduce__(self):
        return _again, (self.workers, self.trust_scripts)


_ALL = weakref.WeakSet()
_SHARED = {}


def _again(workers, trust_scripts):
    return Engines(workers, trust_scripts=trust_scripts)


def shared_engines(trust_scripts=False):
    """The engines of all cells without engines of their own: one worker, started by the first question."""
    if trust_scripts not in _SHARED:
        _SHARED[trust_scripts] = Engines(trust_scripts=trust_scripts)
    return _SHARED[trust_scripts]


@atexit.register
def _close_all():
    for engines in list(_ALL):
        engines.close()
