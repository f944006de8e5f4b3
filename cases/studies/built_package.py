# SPDX-License-Identifier: GPL-2.0-or-later
"""The package `polargrain` for the studies: the one that Python finds, or else that of the release build of this tree."""
import importlib.util
import pathlib
import sys

if importlib.util.find_spec("polargrain") is None:
    sys.path.append(str(pathlib.Path(__file__).resolve().parents[2] / "build/release/python"))
try:
    import polargrain  # noqa: F401
except ImportError as error:
    sys.exit(f"the Python package polargrain is not there ({error}): build the project with it, or install it (docs/python.md)")
