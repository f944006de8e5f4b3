# SPDX-License-Identifier: GPL-2.0-or-later
"""Means over packings with their 95 % intervals (Student's t), and tables of them: no study compares single packings."""
import math
import statistics

STUDENT = [math.inf, math.inf, 12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262]  # 97.5 %, by the number of values


def mean_and_half(values):
    """@returns mean of the finite values and half of its interval; nan where too few are known"""
    values = [value for value in values if math.isfinite(value)]
    if not values:
        return math.nan, math.nan
    if len(values) < 2:
        return values[0], math.nan
    half = STUDENT[min(len(values), len(STUDENT) - 1)] * statistics.stdev(values) / math.sqrt(len(values))
    return statistics.mean(values), half


def interval(values):
    """Mean and half of its interval as text; a dash where fewer than two values are known."""
    mean, half = mean_and_half(values)
    return "-" if math.isnan(half) else f"{mean:.3g} +- {half:.2g}"


def table(title, groups, keys):
    """Prints a Markdown table: a row a group, of a list of figures (dictionaries), one a packing; a column a key."""
    print(f"| {title} | n | " + " | ".join(keys) + " |")
    print("|" + "---|" * (len(keys) + 2))
    for name, figures in groups.items():
        print(f"| {name} | {len(figures)} | " + " | ".join(interval([one[key] for one in figures]) for key in keys) + " |")
    print()
