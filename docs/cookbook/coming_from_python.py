# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
import subprocess
import sys

import numpy as np

program, csv = sys.argv[1:3]


def force(depth, rake):  # stands for measurements: kN, of m and deg
    return 20 + 300 * depth**1.5 * (1 + ((rake - 30) / 40) ** 2)


rng = np.random.default_rng(1)
depth, rake = rng.uniform(0.1, 0.6, 40), rng.uniform(10, 60, 40)
runs, points = csv + ".runs", csv + ".points"
np.savetxt(runs, np.c_[depth, rake, force(depth, rake)], delimiter=",", header="depth,rake,force", comments="")

grid = np.array([(d, r) for r in (20.0, 35.0, 50.0) for d in np.linspace(0.15, 0.55, 41)])
np.savetxt(points, grid, delimiter=",", header="depth,rake", comments="")

subprocess.run([program, runs, points, csv], check=True)

table = np.genfromtxt(csv, delimiter=",", names=True)
error = np.abs(table["mean"] - force(*grid.T))
print(f"largest error of {len(table)} predictions below 0.5 kN: {bool(error.max() < 0.5)}")
