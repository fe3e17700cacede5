# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
"""Draws the figures of docs/explanation/findings.md: what the models of two studies expect over fill and height of the
lift (figures 16 to 18 of the source), and the predicted front of one (22 and 23).

    findings_figure.py grid > grid.csv
    lhd_loading predict --out STUDY --points grid.csv --file SURFACE.csv
    findings_figure.py SURFACE_OF_THE_SOURCE.csv SURFACE.csv
    lhd_loading export --what front --out STUDY --file FRONT.csv
    findings_figure.py front FRONT.csv
"""

import csv
import pathlib
import sys

import numpy as np

IMAGES = pathlib.Path(__file__).parent
sys.path.insert(0, str(IMAGES.parent / "cookbook"))
from matplotlib.colors import ListedColormap  # noqa: E402
from plot_style import GREY, style  # noqa: E402

ALPHA, BETA = np.linspace(0.2, 2, 37), np.linspace(0, 1, 21)
POINTS = {"plus": (1.2, 0.8, "+"), "circle": (0.3, 0.6, "o"), "cross": (1.8, 0.1, "x")}
RESPONSES = {"production": "production [kg/s]", "joint_damage": "joint damage [s]", "rock_spill": "rock spill"}


def write_grid():
    rows = csv.writer(sys.stdout, lineterminator="\n")
    rows.writerow(["alpha", "beta", "gamma", "kappa"])
    rows.writerows([f"{a:.4g}", f"{b:.4g}", 0.5, 0.5] for b in BETA for a in ALPHA)


def surfaces(file):
    with open(file, newline="") as stream:
        head, *rows = csv.reader(stream)
    names = [name.split(" [")[0] for name in head]
    values = np.array(rows, float)
    return {name: values[:, names.index(name)].reshape(len(BETA), len(ALPHA)) for name in RESPONSES}


def draw(files):
    plt = style("findings")
    figure, axes = plt.subplots(2, 3, figsize=(9.4, 5.2), sharex=True, sharey=True)
    for row, (file, whose) in zip(axes, zip(files, ("the source's settings", "ours"))):
        for panel, (name, values) in zip(row, surfaces(file).items()):
            lines = panel.contour(ALPHA, BETA, values, levels=8, cmap="plasma", linewidths=1.4)
            panel.clabel(lines, fontsize=7.5, fmt=lambda value: f"{value:.3g}")
            for alpha, beta, mark in POINTS.values():
                filled = {"facecolors": "none", "edgecolors": GREY} if mark == "o" else {"color": GREY}
                panel.scatter([alpha], [beta], marker=mark, s=60, zorder=3, **filled)
            panel.set_title(f"{RESPONSES[name]}, {whose}", fontsize=9, color=GREY)
    for panel in axes[1]:
        panel.set_xlabel("alpha")
    for panel in axes[:, 0]:
        panel.set_ylabel("beta")
    figure.tight_layout()
    figure.savefig(IMAGES / "findings.svg", metadata={"Date": None})


def draw_front(file):
    plt = style("front")
    with open(file, newline="") as stream:
        head, *rows = csv.reader(stream)
    column = dict(zip((name.split(" [")[0] for name in head), np.array(rows, float).T))
    panels = [("production", "joint_damage", "rock_spill"), ("production", "rock_spill", "joint_damage"),
              ("joint_damage", "rock_spill", "production"), ("production", "joint_damage", "alpha"),
              ("production", "joint_damage", "beta"), ("production", "joint_damage", "kappa")]
    figure, axes = plt.subplots(2, 3, figsize=(9.4, 5.2))
    seen_on_black = ListedColormap(plt.get_cmap("plasma")(np.linspace(0.2, 1, 64)))
    for panel, (x, y, colour) in zip(axes.flat, panels):
        dots = panel.scatter(column[x], column[y], c=column[colour], cmap=seen_on_black, s=9, linewidths=0)
        bar = figure.colorbar(dots, ax=panel)
        bar.set_label(RESPONSES.get(colour, colour), fontsize=8, color=GREY)
        bar.outline.set_visible(False)
        panel.set_xlabel(RESPONSES[x], fontsize=8)
        panel.set_ylabel(RESPONSES[y], fontsize=8)
    figure.tight_layout(w_pad=2)
    figure.savefig(IMAGES / "findings_front.svg", metadata={"Date": None})


if sys.argv[1:] == ["grid"]:
    write_grid()
elif sys.argv[1:2] == ["front"]:
    draw_front(sys.argv[2])
else:
    draw(sys.argv[1:3])
