# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables and figures of biaxial.py, from the folders of its runs. The figures need matplotlib."""
import csv
import json
import math

import numpy

from biaxial_faces import faces
from built_package import polargrain
from intervals import interval, line, markdown, mean_and_half
from polargrain.table import read_table

DIAMETER = 0.01     # m, mean; twice that in packings twice as large
WIDTH_OF_800 = 0.2  # m, of a specimen of 800 grains
BEHIND = 0.02       # axial strain behind the peak over which the slope is taken
COLOURS = ("#b5651d", "#2e7d32", "#8e24aa", "#c62828", "#00838f", "#f9a825", "#5d4037", "#3949ab", "#7cb342", "#d81b60")
AT_FACES = ("shear at platens, 0 to 1 %", "at membranes, 0 to 1 %", "shear at platens, 1 to 2 %", "at membranes, 1 to 2 %",
            "strain of the middle at 1 %", "density by the seating, %")
TWO_SCALES = ("informed", "fixed_point", "cell", "controlled", "rough")
STRENGTHS = ("ratio at 1 %", "peak", "residual")


def curve(output, run):
    """The history of a run or the rows of its element test; None when it has not come to its first step."""
    file = output / f"{run.name}.csv" if run.kind == "element" else output / run.name / "history.csv"
    rows = read_table(file) if file.exists() else {}
    return rows if len(rows.get("axial_strain", ())) > 1 else None


def read_json(file):
    return json.loads(file.read_text(encoding="utf-8")) if file.exists() else {}


def figures(run, output):
    """The figures of a run: the columns of table.csv; nan where there is no figure."""
    rows = curve(output, run)
    strain, ratio, volume = (rows[name] for name in ("axial_strain", "stress_ratio", "volume_strain"))
    peak = ratio.argmax()
    behind = strain[peak] + BEHIND

    def at(place):
        return float(numpy.interp(place, strain, ratio)) if place <= 1.02 * strain[-1] else math.nan

    row = {"run": run.name, "group": run.group, "last strain": strain[-1]}
    row.update({f"ratio at {100 * place:g} %": at(place) for place in (0.005, 0.01, 0.02)})
    row.update(peak=ratio[peak], **{"at, %": 100 * strain[peak]})
    late = ratio[strain >= 0.06]
    row["residual"] = late.mean() if strain[-1] > 0.079 else math.nan
    row["fall behind the peak, per %"] = (ratio[peak] - at(behind)) / (100 * BEHIND)
    row["contraction, %"] = -100 * volume.min()
    row["volume strain, %"] = 100 * volume[-1]
    band = {key: value for key, value in read_json(output / run.name / "band.json").items() if value is not None}
    row["inclination, deg"] = abs(band.get("inclination_degrees", math.nan))
    row["thickness, d"] = band.get("thickness", math.nan) / (2 * DIAMETER if run.doubled else DIAMETER)
    row["onset, %"] = 100 * band.get("onset_strain", math.nan)
    row["rotation in the band"] = abs(band.get("rotation_inside", math.nan))
    row["rotation outside"] = abs(band.get("rotation_outside", math.nan))
    row["grains against the continuum"] = lag_of_grains(run, output, band)
    of_faces = faces(output / run.name) if run.kind == "grains" else {}
    row.update({key: of_faces.get(key, math.nan) for key in AT_FACES})
    summary = read_json(output / run.name / "summary.json")
    cells = summary.get("cells", {})
    row["mismatch"] = summary.get("materials", {}).get("rest", {}).get("stress_mismatch_mean", math.nan)
    row["evaluations"] = cells.get("evaluations", rows["evaluations"].sum() if run.kind == "element" else math.nan)
    row["DEM steps"] = cells.get("dem_steps", rows["step"][-1] if run.kind == "grains" else math.nan)
    row["iterations a step"] = rows["iterations"].sum() / max(1, len(strain) - 1) if "iterations" in rows else math.nan
    row["cuts"] = rows["cuts"].sum() if "cuts" in rows else math.nan
    return row


def lag_of_grains(run, output, band):
    """Mean rotation of the grains of the cells less that of the continuum, over the points in the band; against the sense of the band.

    Cells of `informed` follow the strain alone, their grains' rotations count from the continuum's; on a moved mesh they turn with it.
    """
    if run.scheme not in ("informed", "fixed_point") or not band.get("found"):
        return math.nan
    result = polargrain.Result(output / run.name)
    first = next((k for k, time in enumerate(result.times) if time >= 0.5 - 1e-9), None)
    if first is None:  # it is still on its way
        return math.nan
    before, after = (result.integration_points(k).point_data for k in (first, -1))
    shear = after["deviatoric_strain"] - before["deviatoric_strain"]
    inside = shear > 0.5 * shear.max()
    lag = (after["mean_rotation"] - before["mean_rotation"])[inside].mean()
    if run.large:
        lag -= (after["micro_rotation"] - before["micro_rotation"])[inside].mean()
    return lag * math.copysign(1.0, band["rotation_inside"])


def groups_of(rows):
    return {group: [row for row in rows if row["group"] == group] for group in dict.fromkeys(row["group"] for row in rows)}


def size_of(group):
    """Grains, of groups of specimens and of cells."""
    return int(group.split("-")[1])


def paired(ones, others, key):
    """Relative differences of realisations of the same packing, in %."""
    of_seed = {row["run"].split("-")[2]: row[key] for row in others}
    return [100 * (row[key] / of_seed[row["run"].split("-")[2]] - 1) for row in ones if row["run"].split("-")[2] in of_seed]


def specimens_text(groups):
    of_kind = {group: rows for group, rows in groups.items() if group.startswith("grains")}
    written = "## Specimens of grains\n\n" + markdown("group", of_kind, (
        "ratio at 0.5 %", "ratio at 1 %", "ratio at 2 %", "peak", "at, %", "residual", "contraction, %", "volume strain, %")) + "\n"
    written += markdown("group", of_kind, ("inclination, deg", "thickness, d", "onset, %", "rotation in the band", "rotation outside"))
    written += "\nBands found: " + ", ".join(
        f"{sum(math.isfinite(row['thickness, d']) for row in rows)} of {len(rows)} ({group})" for group, rows in of_kind.items()) + "\n"
    for group, rows in of_kind.items():
        plain = groups.get(f"grains-{size_of(group)}", [])
        if "-rate" in group and plain:
            written += f"\n{group} against the rate of the study, the same specimens, %: " + ", ".join(
                f"{key} {interval(paired(rows, plain, key))}" for key in ("ratio at 0.5 %", "ratio at 1 %", "ratio at 2 %", "peak", "residual"))
    return written + "\n"


def elements_text(groups):
    of_kind = {group: rows for group, rows in groups.items() if group.startswith("element")}
    return "## Periodic cells\n\n" + markdown("group", of_kind, (
        "ratio at 0.5 %", "ratio at 1 %", "ratio at 2 %", "peak", "at, %", "residual", "fall behind the peak, per %", "contraction, %",
        "volume strain, %", "evaluations")) + "".join(
            f"\n{group} against upright sides, %: " + ", ".join(
                f"{key} {interval(paired(rows, groups[group.removesuffix('-leaning')], key))}" for key in STRENGTHS) + "\n"
            for group, rows in of_kind.items() if group.endswith("-leaning") and group.removesuffix("-leaning") in groups) + "\n"


def faces_text(groups):
    """Specimens against the packings that they are cut from, and where that goes with their width; at one rate each."""
    of_kind = [group for group in groups if group.startswith("grains")]
    written = "## Specimens against the periodic packings that they are cut from\n\n"
    written += "| group | n | " + " | ".join(f"{key}, %" for key in STRENGTHS) + " |\n|" + "---|" * (len(STRENGTHS) + 2) + "\n"
    for group in of_kind:
        cells = groups.get(f"element-{2 * size_of(group)}", [])
        if cells:
            written += f"| {group} | {len(paired(groups[group], cells, 'peak'))} | " + " | ".join(
                interval(paired(groups[group], cells, key)) for key in STRENGTHS) + " |\n"
    written += "\n" + markdown("group", {group: groups[group] for group in of_kind}, AT_FACES)
    for rate in dict.fromkeys(group.partition("-rate")[2] for group in of_kind):
        enough = [group for group in of_kind if group.partition("-rate")[2] == rate and len(groups[group]) > 1]
        if len(enough) > 1:
            written += f"\n{', '.join(enough)}: straight lines in 1 / width\n\n"
            places = [1.0 / (WIDTH_OF_800 * math.sqrt(size_of(group) / 800)) for group in enough]
            for key in STRENGTHS:
                known = [[row[key] for row in groups[group] if math.isfinite(row[key])] for group in enough]
                if all(len(values) > 1 for values in known):
                    value, half, slope, of_slope = line(places, known)
                    written += (f"- {key}: {value:.3g} +- {half:.2g} for an infinite width, and {slope / DIAMETER:.3g} +- {of_slope / DIAMETER:.2g} "
                                "times diameter over width\n")
    return written + "\n"


def two_scale_text(groups):
    of_kind = {group: rows for group, rows in groups.items() if group.split("-")[0] in TWO_SCALES}
    return "## Two scales\n\n" + markdown("group", of_kind, (
        "ratio at 0.5 %", "ratio at 1 %", "ratio at 2 %", "peak", "at, %", "residual", "fall behind the peak, per %", "volume strain, %", "last strain")) + \
        "\n" + markdown("group", of_kind, ("inclination, deg", "thickness, d", "onset, %", "rotation in the band", "rotation outside",
                                           "grains against the continuum")) + \
        "\n" + markdown("group", of_kind, ("mismatch", "evaluations", "DEM steps", "iterations a step", "cuts")) + "\n"


def without_mesh(run):
    return run.group.replace(f"{run.across}x{2 * run.across}", "MESH")


def of_one_pair(runs):
    """@returns two-scale runs that differ by their mesh alone, the coarsest first, by (group without its mesh, pair)"""
    families = {}
    for run in sorted((run for run in runs if run.kind == "two_scale"), key=lambda run: run.across):
        families.setdefault((without_mesh(run), run.seed), []).append(run)
    return families


def meshes_text(runs, rows, output):
    """Pair by pair the next finer mesh against each, in %."""
    shown = {row["run"]: row for row in rows}
    compared = {}
    for (key, _), members in of_one_pair(runs).items():
        for coarse, fine in zip(members, members[1:]):
            name = key.replace("MESH", f"{fine.across}x{2 * fine.across}") + f" against {coarse.across}x{2 * coarse.across}"
            loads = loads_of_meshes(curve(output, coarse), curve(output, fine))
            if loads:
                compared.setdefault(name, []).append(loads | of_meshes(shown[coarse.name], shown[fine.name]))
    return "## Meshes\n\nDifferences of the same pair of packings, %; inclination in degrees\n\n" + markdown(
        "group", compared, list(next(iter(compared.values()))[0])) + "\n" if compared else ""


def loads_of_meshes(coarse, fine):
    """Differences of two histories at the same strains, as far as both came; nothing when one has not passed its peak by 1 % of strain."""
    ones, others = ({round(strain, 6): ratio for strain, ratio in zip(rows["axial_strain"], rows["stress_ratio"])} for rows in (coarse, fine))
    peak = max(ones, key=ones.get)
    behind = [strain for strain in ones if strain > peak and strain in others]
    if not behind or behind[-1] < peak + 0.01:
        return None
    apart = [100 * (others[strain] / ones[strain] - 1) for strain in behind]
    return {"load behind the peak, mean": sum(apart) / len(apart), "largest": max(map(abs, apart))}


def of_meshes(coarse, fine):
    """Differences of two rows of table.csv."""
    differences = {key: 100 * (fine[key] / coarse[key] - 1) for key in ("peak", "residual", "thickness, d", "volume strain, %")}
    return differences | {"inclination, deg": fine["inclination, deg"] - coarse["inclination, deg"]}


def law_text(groups):
    of_kind = {group: rows for group, rows in groups.items() if group.startswith("law")}
    lines = [f"| {group} | {rows[0]['peak']:.4f} | {rows[0]['at, %']:.3g} |" for group, rows in of_kind.items()]
    return "## The law in closed form\n\n| run | peak | at, % |\n|---|---|---|\n" + "\n".join(lines) + "\n"


def write_tables(runs, output):
    rows = [figures(run, output) for run in runs]
    with open(output / "table.csv", "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, rows[0].keys())
        writer.writeheader()
        writer.writerows(rows)
    groups = groups_of(rows)
    parts = {"grains": specimens_text, "element": elements_text, "law": law_text}
    written = [text(groups) for kind, text in parts.items() if any(group.startswith(kind) for group in groups)]
    if any(group.startswith("grains") for group in groups):
        written.append(faces_text(groups))
    if any(group.split("-")[0] in TWO_SCALES for group in groups):
        written += [two_scale_text(groups), meshes_text(runs, rows, output)]
    (output / "table.md").write_text("# Biaxial compression\n\nMeans and 95 % intervals.\n\n" + "\n".join(written), encoding="utf-8")


def mean_curve(output, runs, name):
    """@returns strains, mean and half of its interval at them; as far as all runs come"""
    curves = [curve(output, run) for run in runs]
    strain = numpy.linspace(0.0, min(rows["axial_strain"][-1] for rows in curves), 161)
    values = numpy.array([numpy.interp(strain, rows["axial_strain"], rows[name]) for rows in curves])
    mean, half = numpy.array([mean_and_half(column) for column in values.T]).T
    return strain, mean, numpy.nan_to_num(half)


def draw_curves(plt, runs, output, picture):
    """Means of groups over axial strain, with their 95 % intervals."""
    figure, axes = plt.subplots(1, 2, figsize=(10, 4.2), layout="constrained")
    for colour, group in zip(COLOURS, dict.fromkeys(run.group for run in runs)):
        of_group = [run for run in runs if run.group == group]
        for axis, name, factor in ((axes[0], "stress_ratio", 1), (axes[1], "volume_strain", 100)):
            strain, mean, half = mean_curve(output, of_group, name)
            axis.plot(100 * strain, factor * mean, color=colour, linewidth=1.2, label=f"{group}, n = {len(of_group)}")
            axis.fill_between(100 * strain, factor * (mean - half), factor * (mean + half), color=colour, alpha=0.18, linewidth=0)
    axes[0].set_ylabel("stress ratio")
    axes[1].set_ylabel("volume strain, % (dilation positive)")
    for axis in axes:
        axis.set_xlabel("axial strain, %")
        axis.grid(alpha=0.3)
    axes[0].legend(fontsize=8, frameon=False)
    figure.savefig(picture, dpi=90)
    plt.close(figure)


def scatter(axis, samples, values, marker, colour_map, least, most):
    """Marks about as wide as what they stand for, in a picture 3 inches high, 72 points an inch."""
    x, y = samples["x"], samples["y"]
    axis.set_aspect("equal")
    axis.set_axis_off()
    return axis.scatter(x, y, c=values, s=samples["area"] * (72 * 3.0 / (y.max() - y.min())) ** 2, marker=marker, cmap=colour_map, vmin=least,
                        vmax=most, linewidths=0)


def draw_fields(plt, runs, output, picture):
    """Shear strain (above) and rotation (below) of the increment in which bands are looked for."""
    figure, axes = plt.subplots(2, len(runs), figsize=(2.1 * len(runs), 7.2), layout="constrained", squeeze=False)
    for column, run in enumerate(runs):
        samples = read_table(output / f"{run.name}.samples.csv")
        for axis, values, colour_map, sided in ((axes[0][column], samples["shear"], "viridis", False),
                                                (axes[1][column], samples["rotation"], "RdBu", True)):
            high = numpy.quantile(abs(values), 0.97) or 1.0
            marks = scatter(axis, samples, values, "o" if run.kind == "grains" else "s", colour_map, -high if sided else 0.0, high)
            figure.colorbar(marks, ax=axis, shrink=0.6)
        axes[0][column].set_title(run.name, fontsize=7)
    figure.savefig(picture, dpi=60)
    plt.close(figure)


def draw_meshes(plt, runs, output, picture):
    """One pair of packings on its meshes: stress ratios, the finest mesh in a full line, and shear strains on one scale."""
    figure, axes = plt.subplots(1, 1 + len(runs), figsize=(3.6 + 1.7 * len(runs), 4.0), layout="constrained",
                                gridspec_kw={"width_ratios": [3.1] + [1] * len(runs)})
    families = list(dict.fromkeys(without_mesh(run) for run in runs))
    for run in runs:
        rows = curve(output, run)
        finest = run.across == max(other.across for other in runs if without_mesh(other) == without_mesh(run))
        axes[0].plot(100 * rows["axial_strain"], rows["stress_ratio"], color=COLOURS[families.index(without_mesh(run)) % len(COLOURS)],
                     linewidth=1.3 if finest else 1.0, linestyle="-" if finest else ":", label=run.group)
    axes[0].set_xlabel("axial strain, %")
    axes[0].set_ylabel("stress ratio")
    axes[0].grid(alpha=0.3)
    axes[0].legend(fontsize=8, frameon=False)
    samples = {run.name: read_table(output / f"{run.name}.samples.csv") for run in runs}
    most = max(numpy.quantile(rows["shear"], 0.98) for rows in samples.values())
    for axis, run in zip(axes[1:], runs):
        marks = scatter(axis, samples[run.name], samples[run.name]["shear"], "s", "viridis", 0.0, most)
        axis.set_title(run.group.replace("-", "\n"), fontsize=7)
    figure.colorbar(marks, ax=axes[-1], shrink=0.7, label="shear strain, second half of the run")
    figure.savefig(picture, dpi=90)
    plt.close(figure)


def draw(runs, output):
    try:
        import matplotlib
    except ImportError:
        print("no figures: python3-matplotlib is not installed")
        return
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    of_group = {group: [run for run in runs if run.group == group] for group in dict.fromkeys(run.group for run in runs)}
    # No means of single runs, no bodies without a band, no closed form; leaning cells cover the upright ones.
    shown = [run for group, members in of_group.items() if len(members) > 1 and "-2x4" not in group and "leaning" not in group
             for run in members if run.kind != "law"]
    if shown:
        draw_curves(plt, shown, output, output / "curves.png")
    with_fields = [run for run in runs if "-2x4" not in run.group and run.kind != "law" and (output / f"{run.name}.samples.csv").exists()]
    firsts = {run.group: run for run in reversed(with_fields)}
    if firsts:
        draw_fields(plt, list(firsts.values())[::-1], output, output / "fields.png")
    # Of each family the first pair, on the meshes that it has a band on.
    families = {}
    for (key, pair), members in sorted(of_one_pair(with_fields).items(), key=lambda family: family[0][1]):
        if len(members) > 1:
            families.setdefault(key, members)
    if families:
        draw_meshes(plt, [run for members in families.values() for run in members], output, output / "meshes.png")


def write(runs, output):
    """table.md, table.csv and the figures of runs that have a history."""
    if not runs:
        print("no run has come to its first step: no tables")
        return
    write_tables(runs, output)
    draw(runs, output)
    print(f"{output / 'table.md'}: {len(runs)} runs")
