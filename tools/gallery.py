# SPDX-License-Identifier: MIT
"""Draws what the programs of examples/gallery wrote to out/gallery, and writes docs/gallery.md with the pictures in docs/gallery."""
import csv
import os
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection

SOURCE, PICTURES, PAGE = "out/gallery", "docs/gallery", "docs/gallery.md"
plt.rcParams.update({"font.size": 8, "axes.titlesize": 9, "savefig.dpi": 100, "image.cmap": "viridis"})


def table(name):
    """Columns by name: numbers, or text where they are none."""
    with open(f"{SOURCE}/{name}.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    columns = {}
    for key in rows[0] if rows else []:
        values = [row[key] for row in rows]
        try:
            columns[key] = np.array([float(v) for v in values])
        except ValueError:
            columns[key] = np.array(values)
    return columns


def save(figure, name):
    figure.savefig(f"{PICTURES}/{name}.png", bbox_inches="tight", pad_inches=0.05, pil_kwargs={"optimize": True})
    plt.close(figure)


def spacing(p):
    xs = np.unique(np.round(p["x"], 9))
    return np.min(np.diff(xs))


def map_on(axes, p, unit=1e3, enlarge=0.0, label="", low=None, high=None, cmap="viridis", factor=1.0, bar=True):
    """Points as square cells coloured by value, moved by `enlarge` times their displacement. unit: of lengths; factor: of the value."""
    h = spacing(p) * unit / 2
    x, y = (p["x"] + enlarge * p["ux"]) * unit, (p["y"] + enlarge * p["uy"]) * unit
    corners = np.stack([np.stack([x + i * h, y + j * h], axis=1) for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1))], axis=1)
    cells = PolyCollection(corners, array=p["value"] * factor, cmap=cmap, edgecolors="face", linewidths=0.1, rasterized=True)
    cells.set_clim(low, high)
    axes.add_collection(cells)
    axes.set_aspect("equal")
    axes.set_xlim(x.min() - h, x.max() + h)
    axes.set_ylim(y.min() - h, y.max() + h)
    if bar:
        axes.figure.colorbar(cells, ax=axes, label=label, shrink=0.8)
    return cells


def sheet(columns, rows=1, width=7.5, height=3.6):
    return plt.subplots(rows, columns, figsize=(width, height), constrained_layout=True, squeeze=False)


def kalthoff():
    figure, ((left, right),) = sheet(2, height=4.2)
    map_on(left, table("kalthoff_whole"), label="damage [-]", low=0, high=1)
    left.set(title="whole plate, spacing 0.5 mm", xlabel="x [mm]", ylabel="y [mm]")
    for sign in (1, -1):
        left.plot([50, 50 + 40 * np.cos(np.radians(70))], [sign * 25, sign * (25 + 40 * np.sin(np.radians(70)))], "w--", lw=0.8)
    map_on(right, table("kalthoff_half"), label="damage [-]", low=0, high=1)
    right.plot([25, 25 + 25 * np.cos(np.radians(70))], [12.5, 12.5 + 25 * np.sin(np.radians(70))], "w--", lw=0.8)
    right.set(title="the grid of the thesis, [T] 5.1", xlabel="x [mm]", ylabel="y [mm]")
    save(figure, "kalthoff")


def branching():
    figure, ((left,), (right,)) = sheet(1, 2, height=6.2)
    map_on(left, table("branching"), label="damage [-]", low=0, high=0.6)
    left.set(title="damage at 43 us", xlabel="x [mm]", ylabel="y [mm]")
    tip = table("branching_tip")
    right.plot(tip["us"], tip["mm"])
    right.set(title="foremost broken bond", xlabel="time [us]", ylabel="x [mm]")
    save(figure, "branching")


def direction():
    figure, axes = sheet(3, 2, height=4.6)
    for k, nu in enumerate((0.1, 0.4)):
        psi = 0.5 * np.arctan(1 / (1 + nu))
        for j, m in enumerate((3, 5, 7)):
            one = axes[k][j]
            cells = map_on(one, table(f"direction_{k}_{m}"), unit=1, low=0, high=0.6, bar=False)
            one.plot([0, 0.45 * np.cos(psi)], [0, -0.45 * np.sin(psi)], "w--", lw=0.8)
            one.set(title=f"nu {nu}, m = {m}", xlabel="x [m]" if k else "", ylabel="" if j else "y [m]")
    figure.colorbar(cells, ax=axes, label="damage [-]", shrink=0.6)
    save(figure, "direction")


METHODS = ("double node", "internal nodes", "tensor")


def moduli():
    p = table("moduli")
    figure, axes = sheet(4, 2, width=9.5, height=4.4)
    plans = [("nu3", None, "m = 3", "nu [-]"), ("nu5", None, "m = 5", "nu [-]"), ("horizon", None, "m = 3, nu 0.1", "horizon [mm]"),
             ("m", 0.1, "horizon 0.3 mm, nu 0.1", "m [-]")]
    for j, (series, nu, title, label) in enumerate(plans):
        take = (p["series"] == series) & ((p["nu"] == nu) if nu else True)
        for k, method in enumerate(METHODS):
            axes[0][j].plot(p["at"][take], 100 * (p[f"E{k}"][take] / 71e9 - 1), "o-", ms=3, label=method)
            axes[1][j].plot(p["at"][take], 100 * (p[f"n{k}"][take] / p["nu"][take] - 1), "o-", ms=3, label=method)
        axes[0][j].set(title=title, ylabel="" if j else "error of E [%]")
        axes[1][j].set(xlabel=label, ylabel="" if j else "error of nu [%]")
        for i in (0, 1):
            axes[i][j].axhline(0, color="k", lw=0.5)
    axes[0][0].legend()
    save(figure, "moduli")
    figure, axes = sheet(2, 2, height=3.6)
    for j, (name, factor) in enumerate((("ux", 1 / 71e9), ("uy", -0.1 / 71e9))):
        p = table(f"moduli_{name}")
        limit = np.abs(p["value"]).max() * 1e6
        map_on(axes[0][j], p, label=f"{name} [um]", low=-limit, high=limit, factor=1e6)
        p["value"] = 1e8 * factor * p["x" if j == 0 else "y"]
        map_on(axes[1][j], p, label=f"{name} [um]", low=-limit, high=limit, factor=1e6)
        axes[0][j].set(title="LPS, m = 6", ylabel="y [mm]")
        axes[1][j].set(title="analytic", xlabel="x [mm]", ylabel="y [mm]")
    save(figure, "moduli_fields")


FUNCTIONS = ("1", "exp(-q²)", "q", "1 - q", "1/q", "q⁻⁴", "1/(1 + h/2δ - q)")


def influence():
    kernels, errors = table("influence_kernels"), table("influence_errors")
    figure, axes = sheet(7, 2, width=12, height=3.6)
    for k, name in enumerate(FUNCTIONS):
        top, low, p = axes[0][k], axes[1][k], {c: v[errors["function"] == k] for c, v in errors.items()}
        take = kernels["function"] == k
        top.plot(kernels["q"][take], kernels["kernel"][take], "o-", ms=2, label="kernel")
        inside = take & (kernels["q"] <= 1)
        top.plot(kernels["q"][inside], kernels["w"][inside] / kernels["w"][inside].max(), ":", label="w, scaled")
        top.axvline(1, color="r", lw=0.6)
        top.set(title=name, xlabel="q = |xi|/horizon")
        p["value"], p["ux"], p["uy"] = p["percent"], 0 * p["x"], 0 * p["x"]
        cells = map_on(low, p, low=-15, high=15, cmap="coolwarm", bar=False)
        low.set(xlabel="x [mm]", ylabel="" if k else "y [mm]")
    axes[0][0].legend(fontsize=6)
    figure.colorbar(cells, ax=axes[1], label="error of ux [%]", shrink=0.8)
    save(figure, "influence")


def beams():
    axis, series = table("beams"), table("beams_tip")
    figure, axes = sheet(3, 2, height=4.2)
    for k, name in enumerate(("force at the end", "moment at the end", "uniform load")):
        take = axis["case"] == k
        x, found, theory = axis["x"][take], axis["found"][take], axis["theory"][take]
        axes[0][k].plot(x, theory, "k-", lw=0.8, label="beam theory")
        axes[0][k].plot(x[::20], found[::20], "o", ms=3, label="20 x 400 points")
        axes[0][k].set(title=name, xlabel="x [mm]", ylabel="" if k else "deflection [mm]")
    axes[0][0].legend()
    for k, (name, label) in enumerate((("spacing", "spacing [mm], m = 3"), ("m", "m, horizon 0.6 mm"))):
        take = series["series"] == name
        axes[1][k].plot(series["at"][take], series["percent"][take], "o-", ms=3)
        axes[1][k].set(xlabel=label, ylabel="" if k else "error at the end [%]")
        axes[1][k].axhline(0, color="k", lw=0.5)
    axes[1][2].axis("off")
    save(figure, "beams")


def block():
    p = table("block")
    figure, axes = sheet(3, 1, height=2.9)
    for problem, name in enumerate(("uniaxial", "isotropic", "shear")):
        one = axes[0][problem]
        one.plot([8, 10], [0.8, 1], "k-", lw=0.8, label="solid")
        for law in dict.fromkeys(p["law"]):
            take = (p["problem"] == problem) & (p["law"] == law) & (p["y"] > 8)
            one.plot(p["y"][take], p["along"][take], "-", marker=".", markevery=4, lw=0.8, label=law)
        one.set(title=name, xlabel="y [mm]", ylabel="" if problem else "displacement over that of the top [-]")
    axes[0][0].legend(fontsize=6)
    save(figure, "block")


def pressure():
    p = table("pressure")
    panels = list(dict.fromkeys(p["panel"]))
    panels.insert(0, panels.pop())
    figure, axes = sheet(4, 2, width=10, height=4)
    for one, panel in zip(axes.flat, panels):
        take = p["panel"] == panel
        one.quiver(p["x"][take], p["y"][take], 75 * p["ux"][take], 75 * p["uy"][take], angles="xy", scale_units="xy", scale=1, width=0.004)
        one.plot([-5, 5], [0, 0], "r-", lw=1)
        one.set(title=panel, xlim=(-9, 9), ylim=(-6.5, 6.5), aspect="equal", xlabel="x [m]")
    for one in list(axes.flat)[len(panels):]:
        one.axis("off")
    axes[0][0].set_ylabel("y [m]; displacements x 75")
    save(figure, "pressure")


def concrete():
    figure, axes = sheet(2, 1, height=3.4)
    for one, force in zip(axes[0], (5, 10)):
        map_on(one, table(f"concrete_{force}"), label="damage [-]", low=0, high=0.6)
        one.set(title=f"{force} kN of shear, then 0.15 mm of opening", xlabel="x [mm]", ylabel="y [mm]")
    save(figure, "concrete")


WAYS = {0: (0, 0, 0, 0), 30: (4.7, 2.6, 0.7, 0), 50: (6, 4.1, 1.6, 0.2)}


def semicircle():
    figure, axes = sheet(2, 2, height=5)
    for one, beta in zip(axes.flat, (0, 10, 30, 50)):
        map_on(one, table(f"semicircle_{beta}"), label="damage [-]", low=0, high=0.6)
        turned = table(f"semicircle_{beta}_turned")
        one.plot(1e3 * turned["x"], 1e3 * turned["y"], "w,")
        if beta in WAYS:
            one.plot(WAYS[beta], (17, 21.4, 30, 40), "rx", ms=5)
        one.set(title=f"beta {beta} degrees", xlabel="x [mm]", ylabel="y [mm]")
    save(figure, "semicircle")


SCENES = [  # name of the program, title, what draws it, text, more pictures
    ("kalthoff", "Kalthoff and Winkler: notches struck in shear", kalthoff,
     "Steel, 100 x 200 mm, two notches 50 mm long and 50 mm apart, struck between them by a projectile at 32 m/s, which gives the edge half "
     "of that. Dashed: 70 degrees. Measured: about 70 degrees (Kalthoff 2000), and no crack from the far edge. The thesis ([T] 5.1) models "
     "half of a plate half as large with 50 x 50 points; the crack from the far edge there comes of that grid.", []),
    ("branching", "Crack branching in glass", branching,
     "The benchmark of PDMATLAB2D ([P]): a pane of 100 x 40 mm, notched to the middle, under 2 MPa from t = 0. The default step and rule of "
     "breaking beside a sixteenth of the step, and beside the published count.", []),
    ("direction", "Poisson's ratio turns a crack", direction,
     "A notched square, pulled and sheared alike ([T] 5.2, Figs 5.6 to 5.9). Dashed: direction of the crack by the largest principal stress "
     "of the plate without its notch, 1/2 arctan(1/(1+nu)).", []),
    ("semicircle", "Semicircular bend", semicircle,
     "PMMA, a notch of 15 mm at beta to the load ([T] 5.2, Figs 5.10 to 5.18). Crosses: places of the measured crack. Dots: bonds broken on a "
     "lattice that is turned by 20 degrees; that the two cracks differ is the lattice's doing, not the specimen's. docs/accuracy.md has other "
     "families and spacings.", []),
    ("concrete", "Nooru-Mohamed: shear, then tension", concrete,
     "Concrete, 200 x 200 x 50 mm, two notches of 25 mm ([T] 5.2, Figs 5.27 to 5.34), quasi-static, at the defaults of peri_solve. The experiment "
     "shows two bowed cracks, each the other turned by half a turn.", []),
    ("beams", "Three beams, bond-based", beams,
     "[T] 4.1, Figs 4.1 to 4.12: 30 x 1.5 mm, E 70 GPa. The thesis says that its largest errors are 4.5, 5.5 and 3.5 %; beams of few points "
     "across are soft, since families at their faces are cut off (no correction is used here).", []),
    ("moduli", "Young's modulus and Poisson's ratio of a plate in tension", moduli,
     "[T] 4.2, Figs 4.13 to 4.26: LPS, 8 x 2 mm, E 71 GPa. Three ways to measure; the errors fall with the horizon and with m as they do "
     "there, and the tensor method depends on m only.", ["moduli_fields"]),
    ("influence", "Influence functions", influence,
     "[T] 4.2.3, Figs 4.27 to 4.45: the kernel of the stiffness along a row, up to two horizons (red: one), and the error of the horizontal "
     "displacement of the right half of the plate. nu 0.1, m = 6.", []),
    ("block", "A square under constant strain", block,
     "[C] 5, Fig. 7: displacements along the vertical middle line by three laws, no correction, horizon in spacings.", []),
    ("pressure", "A crack under inner pressure", pressure,
     "[C] 6, Figs 12 to 15: displacements near the crack, 75 times enlarged. The references are those of [C] tables 7 and 8, whose crack and "
     "domain are not printed alike everywhere; the order is what can be compared: the law of the deformation gradient oscillates the more "
     "the wider its families are, and smoothing mends it.", []),
]


def verdict(row):
    off = abs(float(row["value"]) - float(row["reference"]))
    within = float(row["within"])
    return "" if within == 0 else "yes" if off <= within else "**missed**"


def page(scenes):
    lines = ["# Gallery", "",
             "Made by `make gallery`: the programs of [`examples/gallery`](../examples/gallery) write tables, `tools/gallery.py` draws them and",
             "writes this page. \"Within\" is what is asked of the difference; where none is given the line only tells.", ""]
    for name, title, _, text, more in scenes:
        lines += [f"## {title}", "", text, "", f"![{title}](gallery/{name}.png)", ""]
        for other in more:
            lines += [f"![{title}](gallery/{other}.png)", ""]
        path = f"{SOURCE}/{name}.figures.csv"
        if os.path.exists(path):
            lines += ["| figure | found | reference | within | holds |", "|---|---|---|---|---|"]
            with open(path, newline="") as file:
                for row in csv.DictReader(file):
                    unit = f" {row['unit']}" if row["unit"] else ""
                    within = f"{float(row['within']):.4g}" if float(row["within"]) else ""
                    lines.append(f"| {row['what']} | {float(row['value']):.4g}{unit} | {float(row['reference']):.4g} | {within} | {verdict(row)} |")
            lines.append("")
        lines.append(f"[`examples/gallery/{name}.c`](../examples/gallery/{name}.c)")
        lines.append("")
    return "\n".join(lines)


def main():
    wanted = sys.argv[1:]
    os.makedirs(PICTURES, exist_ok=True)
    for name, _, draw, _, _ in SCENES:
        if not wanted or name in wanted:
            draw()
            print("drew", name)
    if not wanted:
        with open(PAGE, "w") as file:
            file.write(page(SCENES))


main()
