#!/usr/bin/env python3
# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
"""What drives a bucket into a pile: force of rock and floor against it by depth of its edge behind the pile's toe, while
a drive-in goes forward. One row per class of depth: of each cycle the mean over the class, of these the median and the
tenths from both ends.

    penetration.py table.csv LOG...
"""

import argparse
import csv
import pathlib
import statistics

import h5py

DRIVE_IN = 1
ENDS = [0, 0.25, 0.5, 0.75, 1, 1.25, 1.5, 1.75, 2]  # of the classes [m]
MOVES = 0.1  # m/s; slower it stands, and the force is that of the wheels
LEAST = 5  # cycles of a class that is told of


def signals_of(file):
    names = [name.decode() for name in file["signals/columns"][()]]
    return dict(zip(names, file["signals/values"][()].T))


def forces_by_class(log):
    """Class of depth to a force [kN] for each cycle that came through it."""
    found = {}
    with h5py.File(log) as file:
        signals = signals_of(file)
        for name, cycle in file["cycles"].items():
            inward = (signals["cycle"] == int(name) + 1) & (signals["stage"] == DRIVE_IN) & (signals["drive_speed"] > MOVES)
            depth = signals["tip_x"][inward] - cycle["plan/toe_m"][()]
            force = -signals["bucket_force_x"][inward] / 1e3
            for lower, upper in zip(ENDS, ENDS[1:]):
                inside = force[(depth >= lower) & (depth < upper)]
                if len(inside):
                    found.setdefault((lower, upper), []).append(inside.mean())
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("table", type=pathlib.Path)
    parser.add_argument("logs", type=pathlib.Path, nargs="+")
    given = parser.parse_args()
    forces = {}
    for log in given.logs:
        for depths, values in forces_by_class(log).items():
            forces.setdefault(depths, []).extend(values)
    with open(given.table, "w", newline="") as file:
        file.write(f"# penetration.py, {len(given.logs)} logs\n")
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow(["from [m]", "to [m]", "cycles", "median [kN]", "lower tenth [kN]", "upper tenth [kN]"])
        for (lower, upper), values in sorted(forces.items()):
            if len(values) >= LEAST:
                tenths = statistics.quantiles(values, n=10)
                rows.writerow([lower, upper, len(values)] + [round(v) for v in (statistics.median(values), tenths[0], tenths[-1])])


if __name__ == "__main__":
    main()
