# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
"""The optimum of an expensive function in one call."""

from __future__ import annotations

import math
import os
import warnings
from dataclasses import dataclass
from typing import Callable, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._problem import Goal, Kind, add_responses, box

Array = npt.NDArray[np.float64]


class RunWarning(UserWarning):
    """All runs failed, or the best of them keeps not all limits."""


@dataclass(frozen=True)
class Points:
    """k points with their responses, one per row.

    run: (k,), the row of the table of runs, -1 where the models expect the point; x: (k, d); y: (k, r), without its
    noise where the function is noisy; lower, upper: (k, r), between which y lies with 95 %.
    """

    run: npt.NDArray[np.int64]
    x: Array
    y: Array
    lower: Array
    upper: Array

    def __len__(self) -> int:
        return len(self.run)


@dataclass(frozen=True)
class Runs:
    """All n runs. X: (n, d); Y: (n, r), NaN where a run failed; seconds: (n,); reasons: of failures, else ""."""

    X: Array
    Y: Array
    seconds: Array
    reasons: Sequence[str]

    def __len__(self) -> int:
        return len(self.X)


@dataclass(frozen=True)
class Optimum:
    """best: the best run of one objective, the front of several; where no run keeps all limits the one that breaks
    them least. expected: one objective only, where the models expect the best of all points. feasible: whether the
    best keep all limits. exact: whether the function was taken to be without noise. status: "budget_spent",
    "no_candidate", "nothing_feasible", "nothing_succeeded"."""

    best: Points
    expected: Optional[Points]
    runs: Runs
    feasible: bool
    exact: bool
    status: str
    message: str

    @property
    def x(self) -> Array:
        """The first of the best points, (d,)."""
        return self.best.x[0]

    @property
    def y(self) -> Array:
        """Its responses, (r,)."""
        return self.best.y[0]


def optimize(
    function: Callable[..., object],
    lower: npt.ArrayLike,
    upper: npt.ArrayLike,
    budget: int,
    *,
    goals: Sequence[Goal] = ("minimize",),
    deterministic: bool = False,
    first: Optional[int] = None,
    seed: int = 1,
    threads: int = 1,
    pass_seed: bool = False,
    journal: Union[str, os.PathLike[str], None] = None,
    time_limit: float = math.inf,
    callback: Optional[Callable[[Array, Array], object]] = None,
    names: Optional[Sequence[str]] = None,
    kinds: Optional[Sequence[Kind]] = None,
    response_names: Optional[Sequence[str]] = None,
) -> Optimum:
    """Finds the best of an expensive function in at most `budget` runs, each chosen by models of the runs so far.

    function: f(x) with x (d,), or f(x, seed) with pass_seed, gives one number per goal. An Exception, NaN, an infinite
    number and what is no number are failed runs, which the search keeps away from; another number of values at first
    raises ValueError. goals: "minimize", "maximize", ("at_most", limit), ("at_least", limit) and "record", in the
    order of the values; several objectives give a front. deterministic: equal points give equal values; False: one
    run is made twice to see. first: runs of the first design. threads: runs at once; worth it where the function
    waits or releases the GIL, it is then called from other threads. journal: a file that keeps each run, from which a
    later call goes on. time_limit: of a run, s; a longer one has failed once it has returned. callback: called as
    callback(x, values) after each run. lower, upper, names, kinds: as in drawpoint.designs.

    Ctrl-C, SystemExit and what the callback raises end the search when the runs under way have ended, and are raised;
    the journal keeps the runs. The GIL is released while models are fitted. With one thread equal input gives equal
    bits. Raises ValueError for faulty arguments, RuntimeError for the journal. Warns RunWarning where nothing is
    feasible.
    """
    problem = box(lower, upper, names, kinds, deterministic)
    add_responses(problem, goals, response_names)
    path = "" if journal is None else os.fspath(journal)
    found = _core.optimize(
        function, problem, budget, seed, threads, first, path, time_limit, pass_seed, callback
    )
    runs = Runs(**found["runs"])
    if not found["feasible"]:
        reason = next((reason for reason in runs.reasons if reason), "")
        also = f"; the first failure: {reason}" if reason else ""
        warnings.warn(f"drawpoint.optimize: {found['message']}{also}", RunWarning, stacklevel=2)
    expected = found["expected"]
    return Optimum(
        best=_points(found["best"]),
        expected=None if expected is None else _points(expected),
        runs=runs,
        feasible=found["feasible"],
        exact=found["exact"],
        status=found["status"],
        message=found["message"],
    )


def _points(parts: _core.PointsParts) -> Points:
    return Points(np.array(parts["run"], dtype=np.int64), parts["x"], parts["y"], parts["lower"], parts["upper"])
