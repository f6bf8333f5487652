# SPDX-License-Identifier: MIT
"""Pictures of out/tradeoff.csv: error against time and against memory, one per problem -> out/tradeoff_PROBLEM.png.

Dots: all runs, by law. Line: those that no other run beats in both. Its knees are labelled with their knobs."""
import csv
import math
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.ticker import FuncFormatter, LogLocator

TITLES = {
    "uniform": ("Uniform strain of 64 x 64 spacings, plane stress", "elastic energy of a square against elasticity, surfaces included"),
    "uniform_3d": ("Uniform strain of 24 x 24 x 24 spacings, 3D", "elastic energy of a cube against elasticity, surfaces included"),
    "cantilever": ("Cantilever under a force at its end, plane stress", "deflection of the tip against Timoshenko and Goodier"),
    "cantilever_3d": ("Bar under end moments, 3D", "deflection of the tip against the exact solution"),
    "hole": ("Plate with a hole, plane stress", "stress 1.3 to 2.5 radii from the middle against Kirsch, root mean square"),
    "p_wave": ("P wave, plane strain", "speed of a packet over two wavelengths against elastodynamics"),
    "p_wave_3d": ("P wave, 3D", "speed of a packet over one wavelength against elastodynamics"),
    "crack": ("Crack under tension, plane stress", "energy release rate against K²/E (Tada, Paris, Irwin)"),
    "edge_cracks": ("Cracks in both edges, plane stress", "energy release rate against K²/E (Tada, Paris, Irwin: to 1 %)"),
    "branching": ("Crack branching in glass, horizon 1 mm", "path of the upper tip against the finest run"),
}
LAWS = [("bond-based", "bond", "o", "#0072b2"), ("LPS", "LPS", "s", "#d55e00"),
        ("Oterkus", "Oterkus", "^", "#009e73"), ("correspondence", "corr.", "D", "#cc79a7")]
SHORT = {law: short for law, short, _, _ in LAWS}
ONLY = {"uniform": "64", "uniform_3d": "24"}  # the resolution that is compared
FLOOR = 1e-6  # smaller errors are drawn here, as bench/tradeoff_table.c takes them
KNEES = 10


def label(row):
    """The resolution, and the knobs that differ from the defaults."""
    words = [SHORT[row["law"]]]
    if row["correction"] != "none":
        words[0] += "+" + row["correction"]
    if row["problem"] != "branching":
        words.append("m " + row["m"])
    moves = row["safety"] != ""
    usual = {"influence": "constant", "quadrature": "whole", "precision": "double", "geometry": "nonlinear" if moves else "linear"}
    words += [row[k].replace("linear", "lin. geometry") if k == "geometry" else row[k] for k, value in usual.items() if row[k] != value]
    if row["stabilization"] not in ("", "0.2"):
        words.append("stab. " + row["stabilization"])
    if row["tolerance"] not in ("", "default"):
        words.append("tol. " + row["tolerance"])
    if row["safety"] not in ("", "0.9"):
        words.append("dt " + row["safety"])
    if row["integrator"] == "central difference":
        words.append("c.d.")
    return row["across"] + " | " + ", ".join(words)


def knees(front):
    """Points of a front, by rising cost, each with a third less error than the one before."""
    kept = []
    for point in front:
        if not kept or point[1] < kept[-1][1] / 1.5:
            kept.append(point)
    while len(kept) > KNEES:  # the one that gains least
        gains = [kept[i - 1][1] / kept[i][1] for i in range(1, len(kept) - 1)]
        del kept[1 + gains.index(min(gains))]
    return kept


def panel(axes, rows, cost, scale, flag, unit):
    """One panel; errors in per cent, labels in a column at its right, joined to their points."""
    for law, _, marker, colour in LAWS:
        own = [r for r in rows if r["law"] == law]
        axes.plot([scale * float(r[cost]) for r in own], [100 * max(r["y"], FLOOR) for r in own], marker, color=colour, markersize=3,
                  alpha=0.35, markeredgewidth=0, linestyle="none", label=law)
    front = sorted(((scale * float(r[cost]), 100 * max(r["y"], FLOOR), r) for r in rows if r[flag] == "1"), key=lambda p: (p[0], -p[1]))
    axes.plot([p[0] for p in front], [p[1] for p in front], "k-", linewidth=1.2, label="best", zorder=4)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel(unit)
    axes.set_ylabel("error [%]")
    axes.grid(True, which="major", linewidth=0.4, alpha=0.6)
    low, high = axes.get_ylim()
    axes.set_ylim(low, min(high, 150))
    for axis, ends in ((axes.xaxis, axes.get_xlim()), (axes.yaxis, axes.get_ylim())):
        short = math.log10(ends[1] / ends[0]) < 2.5
        axis.set_major_locator(LogLocator(subs=(1, 2, 5) if short else (1,), numticks=20))
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    chosen = knees(front)
    for place, (x, y, row) in enumerate(chosen):
        height = 0.97 - 0.94 * (place + 0.5) / max(len(chosen), 1)
        colour = next(c for law, _, _, c in LAWS if law == row["law"])
        axes.plot([x], [y], "o", color=colour, markeredgecolor="black", markersize=6, zorder=5)
        axes.annotate(label(row), xy=(x, y), xycoords="data", xytext=(1.03, height), textcoords="axes fraction", fontsize=8.5,
                      va="center", ha="left", annotation_clip=False,
                      arrowprops={"arrowstyle": "-", "linewidth": 0.5, "color": "0.45", "shrinkA": 2, "shrinkB": 3, "relpos": (0, 0.5)})


def draw(problem, rows, across):
    title, truth = TITLES[problem]
    figure, (above, below) = plt.subplots(2, 1, figsize=(11.5, 9.5))
    figure.subplots_adjust(left=0.08, right=0.63, top=0.885, bottom=0.065, hspace=0.24)
    figure.suptitle(title, x=0.08, y=0.975, ha="left", fontsize=14)
    if any(row["y"] <= FLOOR for row in rows):
        truth += f"; {100 * FLOOR:g} %: or less"
    figure.text(0.08, 0.93, "error: " + truth, fontsize=10)
    figure.text(0.645, 0.895, across + " | law+correction,\nm: spacings to the horizon, what is not default", fontsize=8.5)
    what = "run" if rows[0]["safety"] else "evaluate" if problem.startswith("uniform") else "solve"
    panel(above, rows, "seconds", 1, "front_time", "processor time of one thread: build and " + what + " [s]")
    panel(below, rows, "bytes", 1e-6, "front_bytes", "memory at the most [MB]")
    figure.legend(*above.get_legend_handles_labels(), fontsize=8.5, loc="center left", bbox_to_anchor=(0.07, 0.905), ncols=5,
                  frameon=False, markerscale=1.8, handletextpad=0.3)
    path = "out/tradeoff_" + problem + ".png"
    figure.savefig(path, dpi=130)
    plt.close(figure)
    print(path)


ACROSS = {"uniform": "spacings to the side", "uniform_3d": "spacings to the side", "cantilever": "spacings to the depth",
          "cantilever_3d": "spacings to the depth", "hole": "spacings to the radius", "p_wave": "spacings to the wavelength",
          "p_wave_3d": "spacings to the wavelength", "crack": "spacings along the crack",
          "edge_cracks": "spacings along a crack", "branching": "spacings to the horizon"}


def main():
    by_problem = {}
    with open("out/tradeoff.csv", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            if row["status"] != "ok":
                continue
            if row["across"] != ONLY.get(row["problem"], row["across"]):
                continue
            row["y"] = float(row["guarded"]) if row["guarded"] != "inf" else float(row["error"])
            by_problem.setdefault(row["problem"], []).append(row)
    for problem, rows in by_problem.items():
        if len(sys.argv) < 2 or problem in sys.argv[1:]:
            draw(problem, rows, ACROSS[problem])


main()
