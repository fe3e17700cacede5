# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
"""Fronts of points, their hypervolume, and NSGA-II."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Callable, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._problem import Goal, Kind, add_responses, box, signs
from .kriging import Kriging

Array = npt.NDArray[np.float64]


def front(Y: npt.ArrayLike, goals: Optional[Sequence[str]] = None) -> npt.NDArray[np.int64]:
    """The rows of Y, (n, m), that no other row dominates, in rising order; of equal rows all.

    goals: "minimize" or "maximize" per column; None: all are minimised. Raises ValueError for other shapes and for
    numbers that are NaN.
    """
    return np.sort(np.array(_core.non_dominated(_minimised(Y, goals)), dtype=np.int64))


def fronts(Y: npt.ArrayLike, goals: Optional[Sequence[str]] = None) -> list[npt.NDArray[np.int64]]:
    """The rows of Y, (n, m), by rank: the front, then that of the others, and so on."""
    sorted_rows = _core.non_dominated_sort(_minimised(Y, goals))
    return [np.sort(np.array(rows, dtype=np.int64)) for rows in sorted_rows]


def hypervolume(Y: npt.ArrayLike, reference: npt.ArrayLike, goals: Optional[Sequence[str]] = None) -> float:
    """The volume that the rows of Y, (n, m), dominate up to the reference, (m,); exact, m up to 8.

    Rows that are not better than the reference in every column add nothing. goals: as in front(). Raises ValueError
    for other shapes and for numbers that are not finite.
    """
    return _core.hypervolume(*_with_reference(Y, reference, goals))


def hypervolume_contributions(
    Y: npt.ArrayLike, reference: npt.ArrayLike, goals: Optional[Sequence[str]] = None
) -> Array:
    """By how much the hypervolume falls without each row: (n,). Arguments and errors as hypervolume()."""
    return _core.hypervolume_contributions(*_with_reference(Y, reference, goals))


@dataclass(frozen=True)
class Front:
    """X: (n, d); Y: (n, m) objectives, natural signs; responses: (n, r), all of them; objectives: names of the columns
    of Y. stopped_by: "generations" or "evaluations". status: "completed", "no_feasible_point", "all_failed"."""

    X: Array
    Y: Array
    responses: Array
    objectives: Sequence[str]
    evaluations: int
    failed: int
    generations: int
    stopped_by: str
    status: str
    message: str

    def __len__(self) -> int:
        return len(self.X)


def nsga2(
    function: Union[Callable[..., object], Sequence[Kriging]],
    lower: npt.ArrayLike,
    upper: npt.ArrayLike,
    *,
    goals: Sequence[Goal] = ("minimize", "minimize"),
    population: Optional[int] = None,
    generations: int = 250,
    evaluations: Optional[int] = None,
    seed: int = 1,
    start: Optional[npt.ArrayLike] = None,
    vectorized: bool = False,
    pass_seed: bool = False,
    names: Optional[Sequence[str]] = None,
    kinds: Optional[Sequence[Kind]] = None,
    response_names: Optional[Sequence[str]] = None,
) -> Front:
    """The front of a cheap function, or of fitted models, by NSGA-II.

    function: as in optimize(); or, vectorized, of points (n, d) that gives (n, r), NaN where a point failed, whose
    exceptions are raised; or a list of fitted Kriging, one per goal, whose means are searched without Python. goals:
    as in optimize(). population: 2 or more, 200 unless said. generations: after the first population. evaluations: the
    most in all. start: (k, d), points to begin with. Ctrl-C ends the search and is raised. The same input gives the
    same bits. Raises ValueError for faulty arguments and models of other inputs.
    """
    problem = box(lower, upper, names, kinds)
    add_responses(problem, goals, response_names)
    begin = np.empty((0, len(problem.variables))) if start is None else np.asarray(start, dtype=float)
    return Front(
        **_core.nsga2(
            black_box(function), problem, population, generations, evaluations, seed, begin, vectorized, pass_seed
        )
    )


def black_box(function: Union[Callable[..., object], Sequence[Kriging], Kriging]) -> object:
    """A function as it is, fitted models as the list that the core knows."""
    if isinstance(function, Kriging):
        return [function._fitted()]
    if callable(function):
        return function
    if isinstance(function, Sequence) and all(isinstance(model, Kriging) for model in function):
        return [model._fitted() for model in function]
    raise ValueError(f"drawpoint: {function!r} is not a function, nor a fitted Kriging, nor a list of these")


def _minimised(Y: npt.ArrayLike, goals: Optional[Sequence[str]]) -> Array:
    values = np.asarray(Y, dtype=float)
    if values.ndim != 2:
        raise ValueError(f"drawpoint: Y has the shape {values.shape}; allowed is (points, objectives)")
    return values if goals is None else values * signs(goals, values.shape[1])


def _with_reference(
    Y: npt.ArrayLike, reference: npt.ArrayLike, goals: Optional[Sequence[str]]
) -> tuple[Array, Array]:
    values, point = _minimised(Y, goals), np.asarray(reference, dtype=float)
    return values, point if goals is None else point * signs(goals, values.shape[1])
