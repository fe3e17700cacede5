# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
"""Ore thrown from the end of a belt 4 m above a pile, lumps of random size braked by air.

A simulator of the study throw.json: reads a request, writes a reply, and needs Python alone.
"""

import json
import math
import random
import sys

with open(sys.argv[1]) as file:
    request = json.load(file)
speed, angle = request["x"]["speed"], math.radians(request["x"]["angle"])
diameter = random.Random(request["seed"]).lognormvariate(math.log(0.1), 0.3)  # of this lump [m]

x, z = 0.0, 4.0
vx, vz = speed * math.cos(angle), speed * math.sin(angle)
drag = 0.75 * 0.5 * 1.2 / (4000.0 * diameter)  # drag coefficient 0.5, air 1.2 kg/m3, ore 4000 kg/m3 [1/m]
dt = 1e-4
while z > 0.0:
    v = math.hypot(vx, vz)
    vx -= dt * drag * v * vx
    vz -= dt * (9.81 + drag * v * vz)
    x += dt * vx
    z += dt * vz
print(f"a lump of {diameter:.3f} m flies {x:.2f} m")

with open(sys.argv[2], "w") as file:
    json.dump({"values": {"reach": x, "impact": 0.5 * (vx**2 + vz**2)}}, file)
