# SPDX-License-Identifier: GPL-2.0-or-later
"""Files that are there, and files that are written whole."""
import errno
import os
import stat

from .errors import InputError


def why_no_input(file):
    """Why a file cannot be read, in words that follow its name; empty when it can. Who opens a pipe that nobody writes to
    waits for ever."""
    name = os.fspath(file)
    if "\0" in os.fsdecode(name):
        return "cannot be the name of a file: there is a NUL in it"
    try:
        mode = os.stat(name).st_mode
    except FileNotFoundError:
        return "there is no such file"
    except OSError as error:
        return f"cannot be read: {error.strerror}"
    if stat.S_ISDIR(mode):
        return "is a directory; give the name of a file in it"
    return "" if stat.S_ISREG(mode) else "is a pipe or a device; write its output into a file, and name that file"


def no_input(file, message):
    """The InputError of a file."""
    return InputError(f"{file}: {message}", [(str(file), 0, message)])


def input_file(file):
    """The same file, for whoever opens it. Raises InputError when it cannot be read."""
    reason = why_no_input(file)
    if reason:
        raise no_input(file, reason)
    return file


def write_whole(file, content):
    """Writes bytes to a file, whole or not at all. Through a link the file is written that it leads to; what is no file, such as
    /dev/null or a pipe, takes the bytes as they are, and stays. Raises OSError."""
    place = os.path.realpath(file)
    if os.path.exists(place) and not os.path.isfile(place):
        # A pipe that nobody reads is an error, not something to wait for.
        with open(os.open(place, os.O_WRONLY | os.O_NONBLOCK | os.O_NOCTTY), "wb") as stream:
            os.set_blocking(stream.fileno(), True)
            stream.write(content)
        return
    if not os.path.isdir(os.path.dirname(place)):
        raise FileNotFoundError(errno.ENOENT, "there is no such folder", os.path.dirname(place))
    part = place + ".part"
    with open(part, "wb") as stream:
        stream.write(content)
    os.replace(part, place)
