# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
"""Draws the two figures of docs/answer.md: answer_figures.py RUNS.csv FRONT.csv PILES.csv

RUNS and FRONT: `lhd_strategies export --what runs` and `--what front`; PILES: rows of benchmarks/studies/unseen_piles.py.
"""

import csv
import pathlib
import sys

IMAGES = pathlib.Path(__file__).parent
sys.path.insert(0, str(IMAGES.parent / "cookbook"))
from plot_style import BLUE, GREEN, GREY, ORANGE, VIOLET, style  # noqa: E402

plt = style("answer")
FAMILIES = {"slice": BLUE, "drive_and_curl": ORANGE, "steps": GREEN, "edge_dropped": VIOLET}


def table(file):
    with open(file, newline="") as stream:
        return list(csv.DictReader(line for line in stream if not line.startswith("#")))


def column(rows, name):
    return [float(row[next(key for key in row if key.split(" [")[0] == name)]) for row in rows]


def family_of(row):
    return row["family [1]"]


def save(figure, name):
    figure.tight_layout()
    figure.savefig(IMAGES / name, metadata={"Date": None})


def trade_off(runs, front):
    figure, axes = plt.subplots(figsize=(6.0, 3.6))
    done = [row for row in runs if row["status"] == "done"]
    for family, colour in FAMILIES.items():
        mine = [row for row in done if family_of(row) == family]
        axes.scatter(column(mine, "production"), column(mine, "energy"), s=18, color=colour, linewidths=0,
                     label=family.replace("_", " "))
        ends = [row for row in front if family_of(row) == family]
        axes.scatter(column(ends, "production"), column(ends, "energy"), s=3, color=colour, alpha=0.5, linewidths=0)
    axes.set_xlabel("production with a haul of 120 s [kg/s]")
    axes.set_ylabel("energy [kJ/t]")
    axes.legend()
    save(figure, "answer_trade_off.svg")


def unseen_piles(rows):
    strategies, kinds = list(dict.fromkeys(row["strategy"] for row in rows)), list(dict.fromkeys(row["kind"] for row in rows))
    figure, panels = plt.subplots(1, 2, figsize=(7.2, 3.2))
    for axes, response, label in zip(panels, ("production", "energy"), ("production [kg/s]", "energy [kJ/t]")):
        for at, kind in enumerate(kinds):
            for pile in dict.fromkeys(row["pile"] for row in rows if row["kind"] == kind):
                mine = {row["strategy"]: float(row[response]) for row in rows if (row["kind"], row["pile"]) == (kind, pile)}
                places = [at * (len(strategies) + 1) + k for k in range(len(strategies))]
                axes.plot(places, [mine.get(name, float("nan")) for name in strategies], "-", color=GREY, alpha=0.4,
                          linewidth=0.8)
                for place, name, colour in zip(places, strategies, FAMILIES.values()):
                    axes.plot(place, mine.get(name, float("nan")), "o", color=colour, markersize=4)
        axes.set_ylabel(label)
        axes.set_ylim(bottom=0)
        axes.set_xticks([at * (len(strategies) + 1) + (len(strategies) - 1) / 2 for at in range(len(kinds))],
                        [kind.replace("_", "\n") for kind in kinds])
    for name, colour in zip(strategies, FAMILIES.values()):
        panels[1].plot([], [], "o", color=colour, markersize=4, label=name.replace("_", " "))
    panels[1].legend()
    save(figure, "answer_unseen_piles.svg")


def main():
    runs, front, piles = (table(file) for file in sys.argv[1:4])
    trade_off(runs, front)
    unseen_piles(piles)


if __name__ == "__main__":
    main()
