# SPDX-License-Identifier: GPL-2.0-or-later
"""The program that this package belongs to, and what it brings along.

Grains never live in the interpreter: LIGGGHTS ends its process on any error of a script, brings MPI with it, and leaves
handlers of signals behind. They live in workers, processes that the program starts for its own runs too, and whose end
costs nothing but the time to start others.
"""
import os
import pathlib
import signal
import subprocess
import threading

from . import _cells
from .errors import InputError, RunError
from .files import no_input

_PACKAGE = pathlib.Path(__file__).resolve().parent
_PLACES = (_PACKAGE.joinpath("../../../../bin/polargrain").resolve(),  # installed: PREFIX/lib/python3*/*-packages/polargrain
           _PACKAGE.joinpath("../../app/polargrain").resolve())  # in the folder of the build


def program():
    """The path of the program: $POLARGRAIN_PROGRAM; or the one installed, or built, with this package; or that of $PATH.

    Raises InputError when there is none.
    """
    return _cells.program_for_workers([str(place) for place in _PLACES])


def data_file(name):
    """The path of a file that the program brings along, such as "cells/hooke_radii.in" or "cases/biaxial/case.yaml".

    A file of that name here, from the current folder, comes first; what is found nowhere is returned as it was given, for
    the program to say so.
    """
    if "\0" in str(name):  # the system would read it to there, and find another file
        raise no_input(repr(str(name)), "cannot be the name of a file: there is a NUL in it")
    here = pathlib.Path(name)
    if here.exists():
        return here.resolve()
    share = pathlib.Path(program()).resolve().parents[1] / "share" / "polargrain"
    for place in (share / name, share / "liggghts_inputs" / name):
        if place.is_file():
            return place
    return here


def worker_count(workers):
    """How many worker processes a command is told to have: as many as were asked for, or one a core."""
    return workers or os.cpu_count() or 1


def call(*words, on_wait=None, hidden=None):
    """Carries a command of the program out. Returns its standard output, a text.

    on_wait -- called five times a second while it works
    hidden  -- a folder of ours, whose name nobody should meet in a message
    Raises InputError (exit status 2) and RunError (any other but 0) with its words; on Ctrl-C, or when on_wait raises
    something, the program ends in order before that goes on.
    """
    command = [program(), *(str(word) for word in words)]
    for word in command:
        if "\0" in word:
            raise no_input(repr(word), "there is a NUL in it, where the system would end it")
    # A group of its own: Ctrl-C reaches it through us, once.
    process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, text=True, errors="replace", start_new_session=True)
    texts = {}
    readers = [threading.Thread(target=lambda pipe=pipe: texts.__setitem__(pipe, pipe.read()), daemon=True)
               for pipe in (process.stdout, process.stderr)]
    for reader in readers:
        reader.start()
    try:
        _wait(process, on_wait)
    except BaseException:
        _end(process)
        raise
    finally:
        for reader in readers:
            reader.join()
        process.stdout.close()
        process.stderr.close()
    text = texts[process.stderr].strip().replace(f"{hidden}/", "")
    if process.returncode == 2:
        raise InputError(text, [_fault(line) for line in text.splitlines()])
    if process.returncode != 0:
        raise RunError(_without("error: ", text.splitlines()) or f"{command[0]} ended with status {process.returncode}")
    return texts[process.stdout]


def _wait(process, on_wait):
    while True:
        try:
            process.wait(0.2 if on_wait else None)
            return
        except subprocess.TimeoutExpired:
            on_wait()


def _end(process):
    process.send_signal(signal.SIGINT)
    try:
        process.wait(30)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()


def _without(word, lines):
    """The lines of errors; all lines where there is no error."""
    errors = [number for number, line in enumerate(lines) if line.startswith(word)]
    text = "\n".join(lines[errors[0]:] if errors else lines)
    return text[len(word):] if text.startswith(word) else text


def _fault(line):
    file, _, rest = line.partition(":")
    number, _, message = rest.partition(":")
    if number.isdigit():
        return file, int(number), message.strip()
    return "", 0, line
