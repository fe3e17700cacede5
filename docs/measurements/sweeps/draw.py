# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
"""Figure of docs/explanation/findings.md, and tables, from what strategy_sweep printed, VARIABLE.txt beside this file.

    strategy_sweep --piles FOLDER --vary alpha > alpha.txt     # and beta, gamma, kappa
    python3 draw.py            # draws ../../images/sweeps.svg
    python3 draw.py alpha      # prints the table of a variable
"""

import pathlib
import re
import sys

HERE = pathlib.Path(__file__).parent
VARIABLES = ["alpha", "beta", "kappa", "gamma"]
HEAD = ["Production [kg/s]", "Damage per cycle [s]", "Spill", "Fill (struck)", "Stalled", "Tracking error [m]", "Energy [kJ/t]",
        "Pin load range [kN]", "Cycle [s]"]
COLUMNS = [0, 1, 2, 4, 5, 6, 7, 8, 9]  # of those printed; the share of the payload stays out
DRAWN = [(0, "production [kg/s]"), (3, "fill (struck)"), (1, "damage per cycle [s]"), (6, "energy [kJ/t]")]  # of HEAD


def rows(variable):
    """(value, [(mean, half width of 95 %) as text]), in the order of HEAD."""
    found = []
    for line in (HERE / f"{variable}.txt").read_text().splitlines()[2:]:
        pairs = re.findall(r"(-?[\d.]+) \+- ([\d.]+)", line)
        found.append((float(line.split()[0]), [pairs[k] for k in COLUMNS]))
    return found


def table(variable):
    lines = [f"| {variable} | " + " | ".join(HEAD) + " |", "|---" * (1 + len(HEAD)) + "|"]
    for value, pairs in rows(variable):
        lines.append(f"| {value:g} | " + " | ".join(f"{mean} ± {half}" for mean, half in pairs) + " |")
    return "\n".join(lines)


def draw(file):
    import matplotlib

    matplotlib.use("svg")
    import matplotlib.pyplot as plt

    blue, grey = "#3d85c6", "#8a8a8a"  # to be read on white and on black; no background
    plt.rcParams.update({
        "svg.hashsalt": "sweeps", "svg.fonttype": "none", "font.family": "sans-serif", "font.size": 9, "savefig.transparent": True,
        "axes.edgecolor": grey, "axes.labelcolor": grey, "xtick.color": grey, "ytick.color": grey, "axes.spines.top": False,
        "axes.spines.right": False})
    figure, axes = plt.subplots(len(DRAWN), len(VARIABLES), figsize=(9, 8), sharex="col", sharey="row", layout="constrained")
    for across, variable in enumerate(VARIABLES):
        data = rows(variable)
        for down, (measure, title) in enumerate(DRAWN):
            plot = axes[down][across]
            mean, half = zip(*((float(m), float(h)) for m, h in (pairs[measure] for _, pairs in data)))
            plot.errorbar([value for value, _ in data], mean, yerr=half, color=blue, marker="o", markersize=4, linewidth=1.4,
                          elinewidth=1, capsize=2)
            plot.grid(axis="y", color=grey, alpha=0.25, linewidth=0.6)
            if across == 0:
                plot.set_ylabel(title)
        axes[-1][across].set_xlabel(variable)
    for row in axes:
        row[0].set_ylim(bottom=0)
    figure.align_ylabels()
    figure.savefig(file, metadata={"Date": None})


def main():
    if len(sys.argv) > 1:
        print(table(sys.argv[1]))
    else:
        draw(HERE.parent.parent / "images" / "sweeps.svg")


main()
