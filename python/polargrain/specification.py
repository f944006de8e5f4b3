# SPDX-License-Identifier: GPL-2.0-or-later
"""The specification for a command, as a file of the user's or as a dict with the keys of that file."""
import collections.abc
import pathlib
import re

from .program import data_file


_PLAIN = re.compile(r"[\w./+@-]*")  # every reader of YAML takes it for a text


def yaml_of(value):
    """A value of Python in the words of a case or a specification. A path (pathlib) is meant from the current folder."""
    if isinstance(value, pathlib.PurePath):
        path = str(pathlib.Path(value).absolute())
        return path if _PLAIN.fullmatch(path) else "'" + path.replace("'", "''") + "'"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, collections.abc.Mapping):
        return "{" + ", ".join(f"{key}: {yaml_of(one)}" for key, one in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(yaml_of(one) for one in value) + "]"
    return repr(float(value)) if isinstance(value, float) else str(value)


def settings(overrides):
    """The words `--set key=value` for a dict."""
    return [word for key, value in (overrides or {}).items() for word in ("--set", f"{key}={yaml_of(value)}")]


def specification_words(specification, overrides, folder):
    """A file, or a dict, with overrides, as words of the command line.

    folder -- where the file of a dict may be written; it must live as long as the command
    What a dict names as `script` and `packing` lies beside the current folder or comes with the program; it is handed over
    as the user's own words, since the program looks beside the file for others.
    """
    if not isinstance(specification, collections.abc.Mapping):
        return [data_file(specification), *settings(overrides)]
    words = dict(specification)
    named = {key: _found(words.pop(key)) for key in ("script", "packing") if key in words}
    file = pathlib.Path(folder) / "specification.yaml"
    lines = [f"{key}: {yaml_of(value)}" for key, value in words.items()]
    file.write_text("\n".join(lines or ["{}"]) + "\n", encoding="utf-8")
    return [file, *settings({**named, **(overrides or {})})]


def _found(names):
    if isinstance(names, (list, tuple)):
        return [data_file(name) for name in names]
    return data_file(names)
