# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures of results, with matplotlib; each draws into `ax` (a new one when None) and returns it."""
import numpy as np


def _axes(ax):
    if ax is not None:
        return ax
    import matplotlib.pyplot as pyplot
    return pyplot.subplots()[1]


def plot_history(result, y="stress_ratio", x="axial_strain", ax=None, **line):
    """A column of a Result's history (or of any Table) over another; `line` goes to matplotlib's plot."""
    ax = _axes(ax)
    table = result.history if hasattr(result, "history") else result
    ax.plot(table[x], table[y], **line)
    ax.set_xlabel(x)
    ax.set_ylabel(y)
    return ax


def plot_field(fields, name, component=None, *, magnification=1.0, ax=None, **collection):
    """A field of the elements of Fields, as colours on the moved mesh.

    component     -- by its name or number, of a field that has several
    magnification -- of the displacements
    collection    -- goes to matplotlib's PolyCollection (cmap, ...)
    """
    from matplotlib.collections import PolyCollection
    ax = _axes(ax)
    values = fields.cell_data[name]
    title = f"{name}, {fields.units[name]}" if fields.units.get(name, "1") != "1" else name
    if values.ndim == 2:
        number = component if isinstance(component, int) else fields.components[name].index(component)
        values = values[:, number]
        title = f"{name} {fields.components[name][number]}" + title[len(name):]
    moved = fields.points[:, :2] + magnification * fields.point_data["displacement"][:, :2]
    drawn = ax.add_collection(PolyCollection([moved[outline] for outline in fields.outlines()], array=values, **collection))
    ax.figure.colorbar(drawn, ax=ax, label=title)
    ax.autoscale()
    ax.set_aspect("equal")
    ax.set_xlabel("x1, m")
    ax.set_ylabel("x2, m")
    return ax


def plot_element(result, ax=None):
    """Stress ratio over axial strain of all packings of an ElementResult, with their mean and its 95 % interval."""
    ax = _axes(ax)
    for name, curve in result.curves.items():
        ax.plot(curve["axial_strain"], curve["stress_ratio"], linewidth=0.8, label=name)
    if result.mean is not None:
        strain, mean, half = (result.mean[column] for column in ("axial_strain", "stress_ratio", "stress_ratio_half_95"))
        ax.plot(strain, mean, color="black", label="mean")
        ax.fill_between(strain, mean - half, mean + half, color="black", alpha=0.15, label="95 %")
    ax.set_xlabel("axial_strain")
    ax.set_ylabel("stress_ratio")
    ax.legend()
    return ax


def plot_packing(packing, ax=None, **collection):
    """The discs of a Packing in their periodic box."""
    from matplotlib.collections import EllipseCollection
    if packing.dimension != 2:
        raise ValueError("a packing of spheres in space has no picture in the plane")
    ax = _axes(ax)
    size = 2.0 * np.asarray(packing.radii)
    ax.add_collection(EllipseCollection(size, size, np.zeros(len(size)), units="x", offsets=packing.positions,
                                        offset_transform=ax.transData, facecolor="tan", edgecolor="black", linewidth=0.3,
                                        **collection))
    corner = np.array([[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]]) @ np.asarray(packing.box).T
    ax.plot(*corner.T, color="black", linewidth=0.8)
    ax.set_aspect("equal")
    ax.autoscale()
    ax.set_xlabel("x1, m")
    ax.set_ylabel("x2, m")
    return ax
