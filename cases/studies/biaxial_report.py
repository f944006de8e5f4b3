# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables and figures of biaxial.py, from the folders of its runs. The tables need no packages, the figures matplotlib."""
import csv
import json
import re

STRAINS = (0.005, 0.01, 0.02, 0.03, 0.05)  # where stress ratios are tabled
GROUPS = {"rolling": "With rolling resistance", "small": "With rolling resistance, cells of 100 grains",
          "sliding": "Without rolling resistance",
          "wide": "0.5 m x 1 m, with rolling resistance", "widesliding": "0.5 m x 1 m, without rolling resistance",
          "law": "The law in closed form: friction 40 to 32 degrees over a plastic shear of 0.1"}
COLOURS = ("#b5651d", "#2e7d32", "#8e24aa", "#c62828", "#00838f", "#f9a825", "#5d4037", "#3949ab", "#7cb342", "#d81b60")


def columns(file):
    """Columns of a CSV file by name."""
    with open(file, newline="") as text:
        rows = list(csv.reader(text))
    return {name: [float(row[i]) for row in rows[1:] if len(row) == len(rows[0])] for i, name in enumerate(rows[0])}


def history(folder):
    """Columns of history.csv; nothing when the run has not come to its first step."""
    file = folder / "history.csv"
    found = columns(file) if file.exists() else {}
    return found if len(found.get("axial_strain", [])) > 1 else None


def read_json(file):
    return json.loads(file.read_text()) if file.exists() else {}


def at(strains, values, strain):
    """Straight between the rows; nothing beyond the last."""
    for k in range(1, len(strains)):
        if strains[k] >= strain * (1 - 1e-6):
            share = (strain - strains[k - 1]) / (strains[k] - strains[k - 1])
            return values[k - 1] + share * (values[k] - values[k - 1])
    return None


def mean(values):
    known = [value for value in values if value is not None]
    return sum(known) / len(known) if known else None


def figures(run, output):
    """What a run has to show, by the names of the columns of table.csv."""
    curve = history(output / run.name)
    strains, ratios, volumes = (curve[name] for name in ("axial_strain", "stress_ratio", "volume_strain"))
    peak = max(range(len(ratios)), key=ratios.__getitem__)
    row = {"run": run.name, "group": run.group, "last_strain": strains[-1]}
    row.update({f"ratio_{100 * strain:g}%": at(strains, ratios, strain) for strain in STRAINS})
    row.update(peak=ratios[peak], peak_strain=strains[peak],
               residual=mean(ratio for strain, ratio in zip(strains, ratios) if strain >= 0.875 * strains[-1]),
               largest_contraction=-min(volumes), last_volume_strain=volumes[-1])
    band = read_json(output / run.name / "band.json")
    row.update({name: band.get(name) for name in ("inclination_degrees", "thickness", "resolution", "onset_strain",
                                                  "rotation_inside", "rotation_outside", "reason")})
    summary = read_json(output / run.name / "summary.json")
    rest = summary.get("materials", {}).get("rest", {})
    row.update(mismatch=rest.get("stress_mismatch_mean"), largest_mismatch=rest.get("stress_mismatch_largest"),
               evaluations=summary.get("cells", {}).get("evaluations"), status=summary.get("status", ""))
    return row


def text(value, form, factor=1.0, unit=""):
    return "-" if value is None else format(factor * value, form) + unit


def markdown(head, rows):
    return "\n".join("| " + " | ".join(row) + " |" for row in [head, ["---"] * len(head), *rows]) + "\n"


def group_tables(rows):
    """A row a run, and what the two scales differ from the mean of the specimens of grains."""
    ratios = [f"ratio_{100 * strain:g}%" for strain in STRAINS]
    head = ["run", *(name[6:-1] + " %" for name in ratios), "peak (at)", "last eighth (to)", "contraction",
            "volume strain", "band", "thickness", "onset", "rotation in, out", "mismatch, largest"]
    table = [[row["run"], *(text(row[name], ".2f") for name in ratios),
              f"**{row['peak']:.2f}** ({100 * row['peak_strain']:.1f} %)",
              f"{row['residual']:.2f} ({100 * row['last_strain']:.1f} %)", f"{100 * row['largest_contraction']:.2f} %",
              f"{100 * row['last_volume_strain']:.1f} %",
              text(row["inclination_degrees"], ".1f", 1, " deg"),
              text(row["thickness"], ".0f", 1000, " mm"), text(row["onset_strain"], ".1f", 100, " %"),
              text(row["rotation_inside"], ".2f") + ", " + text(row["rotation_outside"], ".2f"),
              text(row["mismatch"], ".2f") + ", " + text(row["largest_mismatch"], ".2f")] for row in rows]
    written = markdown(head, table)
    reasons = [f"- {row['run']}: no band: {row['reason']}" for row in rows if row["reason"]]
    written += "\n" + "\n".join(reasons) + "\n" if reasons else ""
    specimens = [row for row in rows if row["run"].startswith("grains")]
    others = [row for row in rows if row not in specimens]
    if not specimens or not others:
        return written
    compared = [*ratios, "peak", "residual"]
    means = {name: mean(row[name] for row in specimens) for name in compared}
    inclination = mean(abs(row["inclination_degrees"]) for row in specimens if row["inclination_degrees"] is not None)
    thickness = mean(row["thickness"] for row in specimens)

    def difference(row, name):
        return "-" if None in (row[name], means[name]) else f"{100 * (row[name] / means[name] - 1):+.0f} %"

    lines = [[f"mean of {len(specimens)} of grains", *(text(means[name], ".2f") for name in compared),
              text(inclination, ".0f", 1, " deg"), text(thickness, ".0f", 1000, " mm")]]
    lines += [[row["run"], *(difference(row, name) for name in compared),
               "-" if None in (row["inclination_degrees"], inclination)
               else f"{abs(row['inclination_degrees']) - inclination:+.0f} deg",
               "-" if None in (row["thickness"], thickness) else f"{1000 * (row['thickness'] - thickness):+.0f} mm"]
              for row in others]
    return written + "\n" + markdown(["against grains", *(name[6:-1] + " %" for name in ratios), "peak",
                                      "last eighth", "band", "thickness"], lines)


def write_tables(rows, output):
    with open(output / "table.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, rows[0].keys())
        writer.writeheader()
        writer.writerows(rows)
    parts = []
    for group, title in GROUPS.items():
        of_group = [row for row in rows if row["group"] == group]
        if of_group:
            parts.append(f"## {title}\n\n{group_tables(of_group)}")
    (output / "table.md").write_text("# Biaxial compression: runs\n\n" + "\n".join(parts))


def draw_curves(plt, runs, output, picture):
    """Stress ratio and volume strain over axial strain; specimens of grains share a colour."""
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
    colours = iter(COLOURS * len(runs))
    grains_named = False
    for run in runs:
        curve = history(output / run.name)
        style = {"color": "#9e9e9e", "linewidth": 0.7} if run.grains else {"color": next(colours), "linewidth": 1.1}
        label = "grains" if run.grains and not grains_named else None if run.grains else run.name
        grains_named = grains_named or bool(run.grains)
        for axis, values, factor in ((axes[0], "stress_ratio", 1), (axes[1], "volume_strain", 100)):
            axis.plot([100 * strain for strain in curve["axial_strain"]], [factor * value for value in curve[values]],
                      label=label, **style)
    axes[0].set_ylabel("stress ratio")
    axes[1].set_ylabel("volume strain, % (dilation positive)")
    for axis in axes:
        axis.set_xlabel("axial strain, %")
        axis.grid(alpha=0.3)
    axes[0].legend(fontsize=7)
    figure.savefig(picture, dpi=80)
    plt.close(figure)


def draw_fields(plt, runs, output, picture):
    """Shear strain (above) and rotation (below) of the increment in which bands are looked for."""
    figure, axes = plt.subplots(2, len(runs), figsize=(2.1 * len(runs), 7.2), layout="constrained", squeeze=False)
    for column, run in enumerate(runs):
        samples = columns(output / f"{run.name}.samples.csv")
        x, y = samples["x"], samples["y"]
        height = max(y) - min(y)
        # Marks about as wide as what they stand for, in a picture 3 inches high, 72 points an inch.
        sizes = [area * (72 * 3.0 / height) ** 2 for area in samples["area"]]
        for axis, values, colour_map, sided in ((axes[0][column], samples["shear"], "viridis", False),
                                                (axes[1][column], samples["rotation"], "RdBu", True)):
            high = sorted(abs(value) for value in values)[int(0.97 * (len(values) - 1))] or 1.0
            marks = axis.scatter(x, y, c=values, s=sizes, marker="o" if run.grains else "s", cmap=colour_map,
                                 vmin=-high if sided else 0.0, vmax=high, linewidths=0)
            axis.set_aspect("equal")
            axis.set_axis_off()
            figure.colorbar(marks, ax=axis, shrink=0.6)
        axes[0][column].set_title(run.name, fontsize=7)
    figure.savefig(picture, dpi=60)
    plt.close(figure)


def draw(runs, output):
    try:
        import matplotlib
    except ImportError:
        print("no figures: python3-matplotlib is not installed")
        return
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    for group in GROUPS:
        of_group = [run for run in runs if run.group == group]
        if of_group:
            draw_curves(plt, of_group, output, output / f"curves-{group}.png")
        with_samples = [run for run in of_group if (output / f"{run.name}.samples.csv").exists()]
        if with_samples:
            draw_fields(plt, with_samples, output, output / f"fields-{group}.png")


def write(runs, output):
    """table.md, table.csv and the figures of runs that have a history."""
    if not runs:
        print("no run has come to its first step: no tables")
        return
    runs = sorted(runs, key=lambda run: (not run.grains, [int(part) if part.isdigit() else part
                                                          for part in re.split(r"(\d+)", run.name)]))
    write_tables([figures(run, output) for run in runs], output)
    draw(runs, output)
    print(f"{output / 'table.md'}: {len(runs)} runs")
