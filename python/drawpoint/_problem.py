# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
"""The box and the responses of a problem, from what the functions of the package are given."""

from __future__ import annotations

from typing import Any, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _core

#: Of one variable: "real", "integer", or the names of a category's levels, whose values are their indices.
Kind = Union[str, Sequence[str]]
#: Of one response: "minimize", "maximize", "record", ("at_most", limit) or ("at_least", limit).
Goal = Union[str, Tuple[str, float]]


def box(
    lower: npt.ArrayLike,
    upper: npt.ArrayLike,
    names: Optional[Sequence[str]] = None,
    kinds: Optional[Sequence[Kind]] = None,
    deterministic: bool = False,
) -> _core.Problem:
    """The variables. lower, upper: (d,), natural units; names and kinds: d entries."""
    low, high = (np.asarray(bound, dtype=float) for bound in (lower, upper))
    if low.ndim != 1 or low.shape != high.shape or low.size == 0:
        raise ValueError(
            f"drawpoint: lower has the shape {low.shape} and upper {high.shape}; "
            "allowed are two sequences of one number per variable"
        )
    problem = _core.Problem(deterministic)
    each_name = _one_each("names", names, low.size) or [f"x{k}" for k in range(low.size)]
    each_kind = _one_each("kinds", kinds, low.size) or ["real"] * low.size
    for name, a, b, kind in zip(each_name, low, high, each_kind):
        if isinstance(kind, str) and kind not in ("real", "integer"):
            raise ValueError(
                f'drawpoint: kind of variable "{name}" is "{kind}"; allowed are real, integer or a list of the names '
                "of levels"
            )
        levels = [] if isinstance(kind, str) else [str(level) for level in kind]
        if not isinstance(kind, str) and (a, b) != (0.0, len(levels) - 1.0):
            raise ValueError(
                f'drawpoint: variable "{name}" has {len(levels)} levels and bounds {a:g} and {b:g}; its values are '
                f"indices of levels, so give 0 and {len(levels) - 1}"
            )
        problem.add_variable(name, a, b, kind == "integer", levels)
    return problem


def add_responses(problem: _core.Problem, goals: Sequence[Goal], names: Optional[Sequence[str]] = None) -> None:
    """One response per goal. Raises ValueError for a goal that is none and names of another number."""
    all_goals: list[Goal] = [goals] if isinstance(goals, str) else list(goals)
    each_name = _one_each("response_names", names, len(all_goals)) or [f"y{k}" for k in range(len(all_goals))]
    for name, goal in zip(each_name, all_goals):
        if not isinstance(goal, str) and len(goal) != 2:
            raise ValueError(f'drawpoint: goal is {goal!r}; allowed are a name, or a pair such as ("at_most", 2.0)')
        kind, limit = (goal, float("nan")) if isinstance(goal, str) else (goal[0], float(goal[1]))
        problem.add_response(name, kind, limit)
    problem.check()


def design_box(
    lower: npt.ArrayLike,
    upper: npt.ArrayLike,
    names: Optional[Sequence[str]] = None,
    kinds: Optional[Sequence[Kind]] = None,
) -> _core.Problem:
    """The box of a design, which has no use for responses, with the one that a problem must have."""
    problem = box(lower, upper, names, kinds)
    add_responses(problem, ["record"], ["response of the design"])
    return problem


def signs(goals: Optional[Sequence[str]], columns: int) -> npt.NDArray[np.float64]:
    """1 for an objective that is minimised, -1 for one that is maximised. None: all are minimised."""
    if goals is None:
        return np.ones(columns)
    one_each = _one_each("goals", goals, columns) or []
    for goal in one_each:
        if goal not in ("minimize", "maximize"):
            raise ValueError(f'drawpoint: goal is "{goal}"; allowed are minimize and maximize')
    return np.array([-1.0 if goal == "maximize" else 1.0 for goal in one_each])


def _one_each(what: str, values: Optional[Sequence[Any]], count: int) -> Optional[list[Any]]:
    if values is None:
        return None
    if isinstance(values, str) or len(values) != count:
        raise ValueError(f"drawpoint: {what} is {values!r}; allowed is a sequence of {count}, one each")
    return list(values)
