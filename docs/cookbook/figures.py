# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
"""Runs the programs of the cookbook and draws what they write: figures.py PROGRAMS IMAGES"""

import pathlib
import subprocess
import sys
import tempfile

import numpy as np
from plot_style import BLUE, GREEN, GREY, ORANGE, style

plt = style("cookbook")


def rows(table, what):
    return table[table["what"] == what]


def dots(axes, x, y, label=None, colour=ORANGE, size=16, **more):
    axes.scatter(x, y, s=size, color=colour, linewidths=0, label=label, zorder=3, **more)


def cross(axes, x, y, label):
    axes.plot(x, y, "x", color=GREEN, markersize=10, markeredgewidth=2.5, label=label, zorder=4)


def labels(axes, x, y):
    axes.set_xlabel(x)
    axes.set_ylabel(y)


def contours(axes, table, x, y, z, levels):
    nx, ny = len(np.unique(table[x])), len(np.unique(table[y]))
    grid = [table[name].reshape(nx, ny) for name in (x, y, z)]
    lines = axes.contour(*grid, levels=levels, colors=BLUE, linewidths=1)
    axes.clabel(lines, fmt="%g", fontsize=8)


def noisy_simulator(axes, table):
    model, runs = rows(table, "model")[::10], rows(table, "run")
    half = 1.96 * model["deviation"]
    axes.fill_between(model["depth"], model["energy"] - half, model["energy"] + half, color=BLUE, alpha=0.25,
                      linewidth=0, label="95 %")
    axes.plot(model["depth"], model["energy"], color=BLUE, label="model")
    axes.plot(model["depth"], model["exact"], "--", color=GREEN, label="exact")
    dots(axes, runs["depth"], runs["energy"], "runs", size=9)
    labels(axes, "depth of the cut [m]", "energy [kJ/t]")
    axes.legend(ncol=2)


def mixed_variables(axes, table):
    found = rows(table, "found")
    passes = found["passes"][0]
    for lip, (name, colour) in enumerate((("straight", BLUE), ("spade", ORANGE), ("toothed", GREEN))):
        for what, style in (("model", "-"), ("exact", ":")):
            part = rows(table, what)
            part = part[part["lip"] == lip][::3]
            axes.plot(part["bucket"], part["cost"], style, color=colour, label=name if what == "model" else None)
        runs = rows(table, "run")
        runs = runs[(runs["lip"] == lip) & (runs["passes"] == passes)]
        dots(axes, runs["bucket"], runs["cost"], colour=colour)
    axes.plot([], [], ":", color=GREY, label="exact")
    cross(axes, found["bucket"], found["cost"], "found")
    labels(axes, "bucket [m³]", f"cost at {passes:.0f} passes [EUR/t]")
    axes.legend(ncol=2)


def constrained_front(axes, table):
    runs, front = rows(table, "run"), rows(table, "front")
    broken = runs["force"] > 120
    dots(axes, runs["production"][~broken], runs["power"][~broken], "runs within the limit", BLUE)
    dots(axes, runs["production"][broken], runs["power"][broken], "runs beyond it", GREY)
    dots(axes, front["production"], front["power"], "front, simulated", size=9)
    production = np.linspace(front["production"].min(), front["production"].max(), 61)
    depth = np.minimum(production / (5.4 * 0.3), np.sqrt(0.08))  # the speed is 0.3 m/s at least
    power = (80 + 500 * depth**2) * production / (5.4 * depth)
    axes.plot(production, power, color=GREEN, label="exact front", linewidth=1)
    axes.set(xlim=(0, 4), ylim=(0, 350))  # the dearest runs are outside
    labels(axes, "production [t/s]", "power [kW]")
    axes.legend()


def exact_constraint(axes, table):
    found = rows(table, "found")
    contours(axes, rows(table, "model"), "width", "length", "resistance", np.arange(120, 300, 20))
    width = np.linspace(2.4, 4, 41)
    axes.plot(width, 4 / (0.6 * width), color=GREY, label="volume 4 m³, exact")
    axes.fill_between(width, 1.2, 4 / (0.6 * width), color=GREY, alpha=0.2, linewidth=0)
    axes.fill_between([2, 2.4], 1.2, 2.8, color=GREY, alpha=0.2, linewidth=0)
    runs = rows(table, "run")
    dots(axes, runs["width"], runs["length"], "runs")
    cross(axes, found["width"], found["length"], "found")
    axes.set(xlim=(1.97, 4.03), ylim=(1.17, 2.83))
    labels(axes, "width [m]", "length [m]")
    axes.legend(bbox_to_anchor=(1.0, 1.0), loc="upper left", title="resistance [kN]")


def external_code(axes, table):
    for colour, slope in zip((BLUE, ORANGE, GREEN, GREY), np.unique(table["slope"])):
        part = table[table["slope"] == slope]
        v = np.linspace(0.5, 2.5, 41)
        axes.plot(v, v**2 / (2 * 9.81 * (np.sin(np.radians(slope)) + 0.05)), color=colour, linewidth=1)
        dots(axes, part["speed"], part["distance"], f"{slope:g}°", colour)
    axes.plot([], [], color=GREY, linewidth=1, label="v²/2a")
    labels(axes, "speed [m/s]", "distance [m]")
    axes.legend(title="slope")


def resume(axes, table):
    for call, colour in ((1, BLUE), (2, ORANGE)):
        part = table[table["call"] == call]
        dots(axes, part["distance"], part["cycle"], f"made by call {call}: {len(part)}", colour, size=24)
    labels(axes, "distance [m]", "cycle [s]")
    axes.legend()


def reliability(axes, table):
    depth = table["found"][0]
    axes.plot(table["depth"], 100 * table["reliability"], color=BLUE)
    axes.plot([table["depth"][0], depth, depth], [99, 99, 0], "--", color=ORANGE, linewidth=1.2)
    axes.annotate(f"99 % at {depth:.3f} m", (depth, 45), xytext=(-6, 0), textcoords="offset points", ha="right",
                  color=ORANGE)
    axes.set(xlim=(table["depth"][0], table["depth"][-1]), ylim=(0, 103))
    labels(axes, "depth of the cut [m]", "piles that keep the limit [%]")


def calibration(axes, table):
    runs, measured, curve = (rows(table, what) for what in ("run", "measured", "calibrated"))
    axes.axis("off")
    left, right = axes.figure.add_subplot(121), axes.figure.add_subplot(122)
    dots(left, runs["first"][:12], runs["second"][:12], "first design", BLUE)
    dots(left, runs["first"][12:], runs["second"][12:], "by improvement")
    best = runs[runs["value"].argmin()]
    cross(left, best["first"], best["second"], "best")
    labels(left, "friction [deg]", "cohesion [kPa]")
    left.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=2, columnspacing=1, handletextpad=0.3)
    right.plot(curve["first"], curve["value"], color=GREEN, label="calibrated")
    dots(right, measured["first"], measured["value"], "measured", size=24)
    labels(right, "depth [m]", "force [kN]")
    right.legend()


def two_fidelities(axes, table):
    curve, runs, rough = (rows(table, what) for what in ("curve", "run", "rough"))
    curve = curve[::3]
    half = 1.96 * curve["deviation"]
    axes.fill_between(curve["angle"], curve["both"] - half, curve["both"] + half, color=BLUE, alpha=0.25, linewidth=0)
    axes.plot(curve["angle"], curve["both"], color=BLUE, linewidth=5, alpha=0.6, label="both, with 95 %")
    axes.plot(curve["angle"], curve["alone"], "-.", color=GREY, label="simulation alone")
    axes.plot(curve["angle"], curve["exact"], color=GREEN, linewidth=1.2, label="exact")
    dots(axes, runs["angle"], runs["exact"], "simulation: 6 runs", size=30)
    axes.scatter(rough["angle"], rough["estimate"], s=12, facecolors="none", edgecolors=ORANGE, label="estimate: 25 runs")
    labels(axes, "angle of the boom [deg]", "torque [kN m]")
    axes.legend(fontsize=8)


def coming_from_python(axes, table):
    depth = np.linspace(0.15, 0.55, 41)  # as in coming_from_python.py
    for k, (rake, colour) in enumerate(((20, BLUE), (35, ORANGE), (50, GREEN))):
        part = slice(41 * k, 41 * (k + 1))
        axes.plot(depth, table["mean"][part], color=colour, label=f"{rake}°")
        exact = 20 + 300 * depth**1.5 * (1 + ((rake - 30) / 40) ** 2)
        axes.plot(depth[::4], exact[::4], "o", color=colour, markersize=4)
    axes.plot([], [], "o", color=GREY, markersize=4, label="exact")
    labels(axes, "depth of the cut [m]", "predicted force [kN]")
    axes.legend(title="rake")


RECIPES = [noisy_simulator, mixed_variables, constrained_front, exact_constraint, external_code, resume, reliability,
           calibration, two_fidelities, coming_from_python]


def command(recipe, programs, csv):
    program = programs / recipe
    script = pathlib.Path(__file__).with_name(recipe + ".py")
    return [sys.executable, script, program, csv] if script.exists() else [program, csv]


def main():
    programs, images = map(pathlib.Path, sys.argv[1:3])
    images.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        for draw in RECIPES:
            csv = pathlib.Path(folder) / (draw.__name__ + ".csv")
            subprocess.run(command(draw.__name__, programs, str(csv)), check=True, stdout=subprocess.DEVNULL)
            table = np.genfromtxt(csv, delimiter=",", names=True, dtype=None, encoding="utf-8")
            figure, axes = plt.subplots(layout="constrained")
            draw(axes, table)
            figure.savefig(images / (draw.__name__ + ".svg"), metadata={"Date": None})
            plt.close(figure)


main()
