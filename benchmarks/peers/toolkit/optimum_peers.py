#!/usr/bin/python3
# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
"""Best of 60 runs by drawpoint.optimize and by other libraries: optimum_peers.py SEEDS [WAY ...]

Ways: drawpoint; optuna, its sampler TPE with constraints; openturns, EfficientGlobalOptimization after a Latin hypercube of
half of the runs, where there are no constraints and all inputs are numbers; latin, a Latin hypercube alone. All with
their default options and one thread. One CSV row per problem and way: quartiles of the gap over the seeds and CPU
seconds per search. Gap: what the best feasible run lies above the optimum, in units of the function, over the optimum
where there are constraints; of two objectives, the share of the hypervolume that a front of 20 000 runs has and the
runs have not, above its ideal point and below 1.1 of its length."""
import math
import sys
import time
import warnings
from dataclasses import dataclass, field

import numpy as np

import drawpoint

RUNS = 60


@dataclass
class Problem:
    """values(x): objectives, then constraints that hold at 0 or below."""
    name: str
    lower: list
    upper: list
    values: object
    objectives: int = 1
    optimum: float = 0.0
    integers: tuple = ()
    constraints: int = 0
    front: tuple = field(default=(), repr=False)

    def goals(self):
        return ["minimize"] * self.objectives + [("at_most", 0.0)] * self.constraints

    def kinds(self):
        return ["integer" if k in self.integers else "real" for k in range(len(self.lower))]


def branin(x):
    a, b = x
    return [(b - 5.1 / (4 * math.pi**2) * a * a + 5 / math.pi * a - 6) ** 2
            + 10 * (1 - 1 / (8 * math.pi)) * math.cos(a) + 10]


def goldstein_price(x):
    a, b = x
    first = 1 + (a + b + 1) ** 2 * (19 - 14 * a + 3 * a * a - 14 * b + 6 * a * b + 3 * b * b)
    second = 30 + (2 * a - 3 * b) ** 2 * (18 - 32 * a + 12 * a * a + 48 * b - 36 * a * b + 27 * b * b)
    return [math.log(first * second / 3)]


def hartmann(rates, places):
    heights, rates, places = np.array([1, 1.2, 3, 3.2]), np.array(rates), np.array(places)
    return lambda x: [-float(heights @ np.exp(-(rates * (np.asarray(x) - places) ** 2).sum(axis=1)))]


HARTMANN3 = hartmann([[3, 10, 30], [0.1, 10, 35], [3, 10, 30], [0.1, 10, 35]],
                     [[0.3689, 0.1170, 0.2673], [0.4699, 0.4387, 0.7470], [0.1091, 0.8732, 0.5547],
                      [0.0381, 0.5743, 0.8828]])
HARTMANN6 = hartmann([[10, 3, 17, 3.5, 1.7, 8], [0.05, 10, 17, 0.1, 8, 14], [3, 3.5, 1.7, 10, 17, 8],
                      [17, 8, 0.05, 10, 0.1, 14]],
                     [[0.1312, 0.1696, 0.5569, 0.0124, 0.8283, 0.5886], [0.2329, 0.4135, 0.8307, 0.3736, 0.1004, 0.9991],
                      [0.2348, 0.1451, 0.3522, 0.2883, 0.3047, 0.6650], [0.4047, 0.8828, 0.8732, 0.5743, 0.1091, 0.0381]])


def ackley(x):
    x = np.asarray(x)
    return [float(20 + math.e - 20 * math.exp(-0.2 * math.sqrt((x * x).mean())) - math.exp(np.cos(2 * math.pi * x).mean()))]


def welded_beam(x):
    h, l, t, b = x
    q = 0.25 * (h + t) ** 2
    arm, direct = math.sqrt(0.25 * l * l + q), 6000 / (math.sqrt(2) * h * l)
    twist = 6000 * (14 + 0.5 * l) * arm / (2 * math.sqrt(2) * h * l * (l * l / 12 + q))
    return [1.10471 * h * h * l + 0.04811 * t * b * (14 + l),
            math.sqrt(direct**2 + twist**2 + l * direct * twist / arm) - 13600, 504000 / (t * t * b) - 30000, h - b,
            2.1952 / (t**3 * b) - 0.25, 6000 - 64746.022 * (1 - 0.0282346 * t) * t * b**3]


def pressure_vessel(x):
    shell, head, r, l = 0.0625 * x[0], 0.0625 * x[1], x[2], x[3]
    return [0.6224 * shell * r * l + 1.7781 * head * r * r + 3.1661 * shell**2 * l + 19.84 * shell**2 * r,
            0.0193 * r - shell, 0.00954 * r - head, 1296000 - math.pi * r * r * l - 4 / 3 * math.pi * r**3]


def speed_reducer(x):
    a, b, c, d, e, f, g = x
    return [0.7854 * a * b * b * (3.3333 * c * c + 14.9334 * c - 43.0934) - 1.508 * a * (f * f + g * g)
            + 7.4777 * (f**3 + g**3) + 0.7854 * (d * f * f + e * g * g),
            27 / (a * b * b * c) - 1, 397.5 / (a * b * b * c * c) - 1, 1.93 * d**3 / (b * c * f**4) - 1,
            1.93 * e**3 / (b * c * g**4) - 1, math.sqrt((745 * d / (b * c)) ** 2 + 16.9e6) / (110 * f**3) - 1,
            math.sqrt((745 * e / (b * c)) ** 2 + 157.5e6) / (85 * g**3) - 1, b * c / 40 - 1, 5 * b / a - 1,
            a / (12 * b) - 1, (1.5 * f + 1.9) / d - 1, (1.1 * g + 1.9) / e - 1]


def four_bar_truss(x):  # RE21 of Tanabe and Ishibuchi (2020)
    a, b, c, d = x
    return [200 * (2 * a + math.sqrt(2) * b + math.sqrt(c) + d),
            0.01 * (2 / a + 2 * math.sqrt(2) / b - 2 * math.sqrt(2) / c + 2 / d)]


def hatch_cover(x):  # RE24
    a, b = x
    bending, shear, deflection, buckling = 4500 / (a * b), 1800 / b, 56.2e4 / (7e5 * a * b * b), 7e5 * a * a / 100
    limits = 1 - bending / 700, 1 - shear / 450, 1 - deflection / 1.5, 1 - bending / buckling
    return [a + 120 * b, sum(max(0.0, -g) for g in limits)]


ROOT2 = math.sqrt(2)
PROBLEMS = [
    Problem("Branin", [-5, 0], [10, 15], branin, optimum=0.39788735772973816),
    Problem("ln(Goldstein-Price/3)", [-2, -2], [2, 2], goldstein_price),
    Problem("Hartmann 3", [0] * 3, [1] * 3, HARTMANN3, optimum=-3.8627797869493365),
    Problem("Hartmann 6", [0] * 6, [1] * 6, HARTMANN6, optimum=-3.3223680114155147),
    Problem("Ackley 5", [-32.768] * 5, [30] * 5, ackley),
    Problem("welded beam", [0.125, 0.1, 0.1, 0.125], [2, 10, 10, 2], welded_beam, optimum=1.86164, constraints=5),
    Problem("pressure vessel", [1, 1, 10, 10], [99, 99, 200, 200], pressure_vessel, optimum=6059.714335, integers=(0, 1),
            constraints=3),
    Problem("speed reducer", [2.6, 0.7, 17, 7.3, 7.3, 2.9, 5.0], [3.6, 0.8, 28, 8.3, 8.3, 3.9, 5.5], speed_reducer,
            optimum=2994.471066, integers=(2,), constraints=11),
    Problem("four-bar truss", [1, ROOT2, ROOT2, 1], [3] * 4, four_bar_truss, objectives=2),
    Problem("hatch cover", [0.5, 4], [4, 50], hatch_cover, objectives=2),
]


def by_drawpoint(problem, seed):
    runs = []
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        drawpoint.optimize(problem.values, problem.lower, problem.upper, RUNS, goals=problem.goals(), seed=seed,
                           kinds=problem.kinds(), callback=lambda x, y: runs.append(list(y)))
    return runs


def by_latin(problem, seed):
    X = drawpoint.optimized_latin_hypercube(RUNS, problem.lower, problem.upper, seed=seed, kinds=problem.kinds())
    return [problem.values(x) for x in X]


def by_optuna(problem, seed):
    import optuna
    optuna.logging.set_verbosity(optuna.logging.ERROR)
    warnings.simplefilter("ignore")
    runs = []

    def objective(trial):
        x = [trial.suggest_int(f"x{k}", problem.lower[k], problem.upper[k]) if k in problem.integers
             else trial.suggest_float(f"x{k}", problem.lower[k], problem.upper[k]) for k in range(len(problem.lower))]
        values = problem.values(x)
        runs.append(values)
        trial.set_user_attr("constraints", values[problem.objectives:])
        return values[0] if problem.objectives == 1 else tuple(values[:problem.objectives])

    limits = (lambda trial: trial.user_attrs["constraints"]) if problem.constraints else None
    sampler = optuna.samplers.TPESampler(seed=seed, constraints_func=limits)
    optuna.create_study(directions=["minimize"] * problem.objectives, sampler=sampler).optimize(objective, n_trials=RUNS)
    return runs


def by_openturns(problem, seed):
    import openturns as ot
    if problem.constraints or problem.integers or problem.objectives > 1:
        return None
    ot.Log.Show(ot.Log.NONE)
    ot.RandomGenerator.SetSeed(seed)
    runs, dimension = [], len(problem.lower)

    def logged(x):
        runs.append(problem.values(list(x)))
        return runs[-1]

    bounds = ot.Interval(problem.lower, problem.upper)
    function = ot.PythonFunction(dimension, 1, logged)
    box = ot.ComposedDistribution([ot.Uniform(a, b) for a, b in zip(problem.lower, problem.upper)])
    X = ot.LHSExperiment(box, RUNS // 2).generate()
    kriging = ot.KrigingAlgorithm(X, function(X), ot.MaternModel([0.5 * (b - a) for a, b in zip(problem.lower, problem.upper)],
                                                                 [1.0], 2.5), ot.ConstantBasisFactory(dimension).build())
    kriging.setOptimizationBounds(ot.Interval([0.01 * (b - a) for a, b in zip(problem.lower, problem.upper)],
                                              [10.0 * (b - a) for a, b in zip(problem.lower, problem.upper)]))
    kriging.run()
    search = ot.OptimizationProblem(function)
    search.setBounds(bounds)
    algorithm = ot.EfficientGlobalOptimization(search, kriging.getResult())
    algorithm.setMaximumEvaluationNumber(RUNS - RUNS // 2)
    try:
        algorithm.run()
    except RuntimeError:  # now and then no search for the next point succeeds: what was run so far counts
        pass
    return runs[:RUNS]


WAYS = {"drawpoint": by_drawpoint, "optuna": by_optuna, "openturns": by_openturns, "latin": by_latin}


def long_front(problem):
    """Ideal point, lengths and hypervolume of a front of 20 000 runs."""
    found = drawpoint.nsga2(problem.values, problem.lower, problem.upper, goals=problem.goals(), population=200,
                            evaluations=20000)
    Y = np.asarray(found.Y)[:, :problem.objectives]
    ideal, length = Y.min(axis=0), np.ptp(Y, axis=0)
    return ideal, length, drawpoint.hypervolume((Y - ideal) / length, [1.1] * problem.objectives)


def gap_of(problem, runs):
    Y = np.array([run[:problem.objectives] for run in runs if all(g <= 0 for g in run[problem.objectives:])])
    if problem.objectives == 1:
        over = abs(problem.optimum) if problem.constraints else 1.0
        return (Y.min() - problem.optimum) / over if len(Y) else math.inf
    ideal, length, whole = problem.front
    inside = [y for y in (Y - ideal) / length if (y < 1.1).all()]
    return 1 - (drawpoint.hypervolume(np.array(inside), [1.1] * problem.objectives) if inside else 0.0) / whole


def main():
    seeds, wanted = int(sys.argv[1]), sys.argv[2:] or list(WAYS)
    print("problem,inputs,constraints,objectives,way,gap median,lower quartile,upper quartile,worst,CPU time [s]")
    for problem in PROBLEMS:
        if problem.objectives > 1:
            problem.front = long_front(problem)
        for way in wanted:
            start = time.process_time()
            runs = [WAYS[way](problem, seed) for seed in range(1, seeds + 1)]
            seconds = (time.process_time() - start) / seeds
            if runs[0] is None:
                continue
            gaps = sorted(gap_of(problem, r) for r in runs)
            quartile = lambda share: gaps[min(len(gaps) - 1, int(share * len(gaps)))]
            print(f"{problem.name},{len(problem.lower)},{problem.constraints},{problem.objectives},{way},"
                  f"{quartile(0.5):.2g},{quartile(0.25):.2g},{quartile(0.75):.2g},{gaps[-1]:.2g},{seconds:.2f}", flush=True)


if __name__ == "__main__":
    main()
