#!/usr/bin/env python3
# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
"""Holds a recorded contact problem's solution for whole steps against the law that the problem's file states.

    check.py NAME.h5...        NAME.solution.h5 lies beside it

Written from the text of the attribute `law` alone, in NumPy: no code of the solvers is in it. Prints, per file, by how much the
solution breaks each rule, in m/s, rad/s or of the load, and ends with 1 where that is more than the solution's own residual explains.
"""
import sys

import h5py
import numpy as np

LAW = (
    "0 <= p_n, u_n - min(bias - Sigma p_n, 1 m/s) >= 0, one of them 0.",
    "|p_t| <= friction p_n; u_t = -s p_t with s >= 0, and s = 0 inside the cone.",
    "Y = 1 / (1 + 4 tau / h), tau = max(damping_time, 2 step), Sigma = 4 Y / (h^2 stiffness).",
    "bias = -gap / h if gap > 0; else Y (u_n- - 4 gap / h), without u_n- where it is below -0.05 m/s.",
    "|m_t| <= rolling_arm P and |m_n| <= spinning_arm P, with friction's rule.",
    "Machine row: J w = target with lower <= p <= upper, complementary at the limits;",
    "stop: J w >= -gap / h, past the end -gap / recovery.",
)




def allowed(rule):
    """Of the load, for impulses. Speeds: what the solutions leave of their convergence, 5e-3 m/s or rad/s at most (README.md), twofold;
    a rule that is wrong shows at some 1 m/s. The rest is round-off of the sums, over masses of 10 kg and up."""
    if rule == "pull" or rule.endswith("over"):
        return 1e-8
    return 1e-4 if rule in ("momentum", "spin", "machine", "rows") else 1e-2


def arrays(group):
    found = {}
    group.visititems(lambda name, item: found.update({name: item[()]}) if isinstance(item, h5py.Dataset) else None)
    return found


def dot(a, b):
    return np.einsum("ij,ij->i", a, b)


class Motion:
    """Velocities of bodies and of the machine's parts."""

    def __init__(self, linear, angular, w, part_maps):
        parts = part_maps @ w if len(part_maps) else np.zeros((0, 6))
        self.linear = np.vstack([linear, parts[::-1, 3:]])  # part p is row -1 - p
        self.angular = np.vstack([angular, parts[::-1, :3]])

    def relative(self, a, b, arm_a, arm_b):
        at = lambda side, arm: self.linear[side] + np.cross(self.angular[side], arm)
        return at(b, arm_b) - at(a, arm_a)


def disc(impulse, speed, limit, load):
    """Friction's rule for vectors across the normal: excess over the limit, speed inside the cone, speed not against the impulse."""
    size = np.linalg.norm(impulse, axis=1)
    excess = np.max(size - limit, initial=0) / load
    inside = size < limit * (1 - 1e-3) - 1e-9 * load
    stuck = np.max(np.linalg.norm(speed[inside], axis=1), initial=0)
    slides = ~inside & (limit > 1e-6 * load)
    along = dot(speed[slides], impulse[slides]) / np.maximum(size[slides], 1e-300)
    across = np.linalg.norm(speed[slides] - along[:, None] * impulse[slides] / np.maximum(size[slides], 1e-300)[:, None], axis=1)
    return {"over": excess, "stuck": stuck, "along": np.max(along, initial=0), "across": np.max(across, initial=0)}


def check(name):
    with h5py.File(name) as file:
        problem, step, law = arrays(file), float(file.attrs["step"]), file.attrs["law"].decode()
    for rule in LAW:
        if rule not in law:
            sys.exit(f"{name}: the law in the file is not the one checked here, which says: {rule}")
    with h5py.File(name.replace(".h5", ".solution.h5")) as file:
        solution, said = arrays(file["substeps_1"]), dict(file["substeps_1"].attrs)
    part_maps = problem.get("machine/part_maps", np.zeros((0, 6, 0)))
    w = problem.get("machine/velocities", np.zeros((2, 0)))
    w_after = solution.get("machine_velocity", np.zeros((0, 1))).ravel()
    before = Motion(problem["bodies/velocity"], problem["bodies/angular_velocity"], w[0], part_maps)
    after = Motion(solution["velocity"], solution["angular_velocity"], w_after, part_maps)

    first, count = problem["pairs/first"], problem["pairs/count"]
    pair = np.repeat(np.arange(len(first)), count)
    a, b = problem["pairs/a"], problem["pairs/b"]
    arms = problem["points/arm_a"], problem["points/arm_b"]
    n = problem["points/normal"]
    u, u_before = (m.relative(a[pair], b[pair], *arms) for m in (after, before))
    p = solution["impulse"]
    p_n, u_n, approach, gap = dot(p, n), dot(u, n), dot(u_before, n), problem["points/gap"]
    load = p_n.sum()

    tau = np.maximum(problem["points/damping_time"], 2 * step)
    Y = 1 / (1 + 4 * tau / step)
    Sigma = 4 * Y / (step**2 * problem["points/stiffness"])
    bias = np.where(gap > 0, -gap / step, Y * (np.where(approach < -0.05, 0, approach) - 4 * gap / step))
    rest = u_n - np.minimum(bias - Sigma * p_n, 1.0)
    carries = p_n > 1e-6 * load / len(p_n)
    broken = {
        "pull": np.max(-p_n, initial=0) / load,
        "normal": max(np.max(np.abs(rest[carries]), initial=0), np.max(-rest, initial=0)),
    }
    friction = problem["points/friction"] * np.maximum(p_n, 0)
    for key, value in disc(p - p_n[:, None] * n, u - u_n[:, None] * n, friction, load).items():
        broken["friction " + key] = value

    normal, P = n[first], np.bincount(pair, np.maximum(p_n, 0), len(first))
    m, turn = solution["moment"], after.angular[b] - after.angular[a]
    m_n, turn_n = dot(m, normal), dot(turn, normal)
    for key, value in disc(m - m_n[:, None] * normal, turn - turn_n[:, None] * normal, problem["pairs/rolling_arm"] * P, load).items():
        if np.any(problem["pairs/rolling_arm"] > 0):
            broken["rolling " + key] = value
    if np.any(problem["pairs/spinning_arm"] > 0):
        for key, value in disc(m_n[:, None], turn_n[:, None], problem["pairs/spinning_arm"] * P, load).items():
            broken["spinning " + key] = value

    if "machine/rows/jacobian" in problem:
        row = {k.split("/")[-1]: v for k, v in problem.items() if k.startswith("machine/rows/")}
        speed, force = row["jacobian"] @ w_after, solution["row_impulses"].ravel()
        stop = row["kind"] == 1
        recovery = np.where(stop, row["recovery"], 1)
        wanted = np.where(stop, -row["gap"] / np.where(row["gap"] > 0, step, recovery), row["target"])
        between = (force > row["lower"] + 1e-6 * load) & (force < np.where(stop, np.inf, row["upper"] - 1e-6 * load))
        off = np.where(between, np.abs(speed - wanted), np.where(force <= row["lower"] + 1e-6 * load, np.maximum(0, wanted - speed), np.maximum(0, speed - wanted)))
        broken["rows"] = np.max(off, initial=0)

    # What keeps the laws of motion: momentum of each body, and what the machine received.
    impulse = np.zeros((len(problem["bodies/velocity"]) + len(part_maps), 6))
    for side, sign, arm in ((a, -1, arms[0]), (b, 1, arms[1])):
        np.add.at(impulse[:, 3:], side[pair], sign * p)
        np.add.at(impulse[:, :3], side[pair], sign * np.cross(arm, p))
        np.add.at(impulse[:, :3], side, sign * m)
    bodies = len(problem["bodies/velocity"])
    change = solution["velocity"] - problem["bodies/velocity"] - problem["bodies/external_velocity_change"]
    broken["momentum"] = np.max(np.abs(change - problem["bodies/inverse_mass"][:, None] * impulse[:bodies, 3:]))
    spin = np.einsum("bij,bj->bi", problem["bodies/inverse_inertia"], impulse[:bodies, :3])
    broken["spin"] = np.max(np.abs(solution["angular_velocity"] - problem["bodies/angular_velocity"] - spin))
    if len(part_maps):
        received = np.einsum("pij,pi->j", part_maps, impulse[bodies:][::-1]) + row["jacobian"].T @ force
        broken["machine"] = np.max(np.abs(w_after - w[1] - received) / np.max(np.abs(w[1])))

    print(f"{name}: {len(p)} points, {carries.sum()} of them loaded; residual of the solution", {k: f"{v:.1e}" for k, v in said.items() if k.startswith("residual")})
    for rule, value in broken.items():
        print(f"  {rule:18} {value:.2e}{'' if value <= allowed(rule) else '  BROKEN, allowed: %g' % allowed(rule)}")
    return all(value <= allowed(rule) for rule, value in broken.items())


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    sys.exit(not all([check(argument) for argument in sys.argv[1:]]))
