# SPDX-License-Identifier: GPL-2.0-or-later
"""Grains as the scripts of specimens and layers write them (grains/step-*.dump)."""
import numpy


def read_grains(dump):
    """@returns a row a grain, by number: id, x, y, radius (m), rotation (rad)"""
    lines = dump.read_text(encoding="utf-8").splitlines()
    first = next(k for k, line in enumerate(lines) if line.startswith("ITEM: ATOMS"))
    rows = numpy.array([[float(word) for word in line.split()] for line in lines[first + 1:]])
    return rows[rows[:, 0].argsort()]
