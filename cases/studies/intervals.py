# SPDX-License-Identifier: GPL-2.0-or-later
"""Means over packings with their 95 % intervals (Student's t), and tables of them: no study compares single packings."""
import math
import statistics

# Student's t, 97.5 %, by the number of values; beyond 30 that of 30.
STUDENT = [math.inf, math.inf, 12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228, 2.201, 2.179, 2.160, 2.145,
           2.131, 2.120, 2.110, 2.101, 2.093, 2.086, 2.080, 2.074, 2.069, 2.064, 2.060, 2.056, 2.052, 2.048, 2.045]


def mean_and_half(values):
    """@returns mean of the finite values and half of its interval; nan where too few are known"""
    values = [value for value in values if math.isfinite(value)]
    if not values:
        return math.nan, math.nan
    if len(values) < 2:
        return values[0], math.nan
    half = STUDENT[min(len(values), len(STUDENT) - 1)] * statistics.stdev(values) / math.sqrt(len(values))
    return statistics.mean(values), half


def shown(values, digits):
    """Mean and half of its interval with so many digits behind the point, or the value of one alone; a dash where none is known."""
    mean, half = mean_and_half(values)
    if math.isnan(mean):
        return "-"
    return f"{mean:.{digits}f}" + ("" if math.isnan(half) else f" +- {half:.{digits}f}")


def interval(values):
    """Mean and half of its interval as text; a dash where fewer than two values are known."""
    mean, half = mean_and_half(values)
    return "-" if math.isnan(half) else f"{mean:.3g} +- {half:.2g}"


def difference_of_means(first, second):
    """Mean of the first less mean of the second, and half of its interval (each group's own added in squares), as text."""
    (mean, half), (other, half_of_other) = mean_and_half(first), mean_and_half(second)
    return f"{mean - other:+.3f} +- {math.hypot(half, half_of_other):.3f}"


def markdown(title, groups, keys):
    """A Markdown table: a row a group, of a list of figures (dictionaries), one a packing; a column a key."""
    lines = [f"| {title} | n | " + " | ".join(keys) + " |", "|" + "---|" * (len(keys) + 2)]
    lines += [f"| {name} | {len(figures)} | " + " | ".join(interval([one[key] for one in figures]) for key in keys) + " |"
              for name, figures in groups.items()]
    return "\n".join(lines) + "\n"


def table(title, groups, keys):
    """Prints it."""
    print(markdown(title, groups, keys))


def line(places, groups):
    """The straight line through the means of groups of values, weighted by how well each is known.

    places -- of the groups
    groups -- lists of values, two and more each
    @returns its value at place 0, half of the 95 % interval of that (the scatter of each group counts as known), its slope, and
             half of the interval of the slope
    """
    weights = [len(values) / statistics.variance(values) for values in groups]
    means = [statistics.mean(values) for values in groups]
    w, wx, wxx = (sum(weight * place ** power for weight, place in zip(weights, places)) for power in (0, 1, 2))
    wy, wxy = (sum(weight * place ** power * mean for weight, place, mean in zip(weights, places, means)) for power in (0, 1))
    determinant = w * wxx - wx * wx
    return ((wxx * wy - wx * wxy) / determinant, 1.96 * math.sqrt(wxx / determinant),
            (w * wxy - wx * wy) / determinant, 1.96 * math.sqrt(w / determinant))


class Line:
    """The straight line of least squares through single values that scatter alike about it.

    places, values -- three and more
    slope, half_of_slope -- and half of its 95 % interval (Student's t with n - 2 degrees of freedom)
    scatter -- standard deviation of a value from the line
    """

    def __init__(self, places, values):
        self.n, self.middle, self.mean = len(places), statistics.mean(places), statistics.mean(values)
        self.spread = sum((place - self.middle) ** 2 for place in places)
        self.slope = sum((place - self.middle) * value for place, value in zip(places, values)) / self.spread
        squares = sum((value - self.mean - self.slope * (place - self.middle)) ** 2 for place, value in zip(places, values))
        self.scatter = math.sqrt(squares / (self.n - 2))
        self.student = STUDENT[min(self.n - 1, len(STUDENT) - 1)]  # a mean has n - 1 degrees of freedom
        self.half_of_slope = self.student * self.scatter / math.sqrt(self.spread)

    def at(self, place):
        """@returns value of the line, and half of its 95 % interval"""
        half = self.student * self.scatter * math.sqrt(1 / self.n + (place - self.middle) ** 2 / self.spread)
        return self.mean + self.slope * (place - self.middle), half
