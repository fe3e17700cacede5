# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
"""Draws the figure of docs/explanation/findings.md: what the models of two studies expect over fill and height of the lift.

    findings_figure.py grid > grid.csv
    lhd_loading predict --out STUDY --points grid.csv --file SURFACE.csv
    findings_figure.py SURFACE_OF_THE_SOURCE.csv SURFACE.csv
"""

import csv
import pathlib
import sys

import numpy as np

IMAGES = pathlib.Path(__file__).parent
sys.path.insert(0, str(IMAGES.parent / "cookbook"))
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


if sys.argv[1:] == ["grid"]:
    write_grid()
else:
    draw(sys.argv[1:3])
