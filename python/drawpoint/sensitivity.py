# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
"""What each input does to a response: shares of variance, elementary effects, main effects."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import Any, Callable, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._problem import Kind, add_responses, box
from .fronts import black_box
from .kriging import Kriging
from .optimum import RunWarning

Array = npt.NDArray[np.float64]
Function = Union[Callable[..., object], Kriging, Sequence[Kriging]]


@dataclass(frozen=True)
class Estimates:
    """Estimates with their intervals, one entry per input, or (d, d) of two."""

    value: Array
    lower: Array
    upper: Array


@dataclass(frozen=True)
class SobolIndices:
    """first: alone; total: with all interactions; second: of two beyond each alone, empty unless asked for. mean and
    variance: of the response, its unit and that squared. status: "estimated", or "runs_lost", "constant_response",
    "too_few_runs", which the message explains."""

    response: str
    status: str
    message: str
    mean: float
    variance: float
    first: Estimates
    total: Estimates
    second: Estimates


def sobol_indices(
    function: Function,
    lower: npt.ArrayLike,
    upper: npt.ArrayLike,
    *,
    samples: int = 1024,
    second_order: bool = False,
    estimator: str = "saltelli",
    confidence: float = 0.95,
    seed: int = 1,
    vectorized: bool = False,
    pass_seed: bool = False,
    names: Optional[Sequence[str]] = None,
    kinds: Optional[Sequence[Kind]] = None,
    response_names: Optional[Sequence[str]] = None,
) -> Union[SobolIndices, list[SobolIndices]]:
    """Sobol' indices of a function, or of the mean of fitted models, with inputs independent and uniform in the box.

    function: as in nsga2(), at samples * (d + 2) points, 2 d + 2 with second_order. A list of models, or
    response_names, asks for several responses and gives a list. estimator: "saltelli", "jansen" where first-order
    indices are large, "martinez". confidence: of the intervals, by bootstrap. Ctrl-C is raised. Raises ValueError for
    faulty arguments; warns RunWarning where the status is not "estimated".
    """
    problem, several = _asked(function, lower, upper, names, kinds, response_names)
    results = []
    for parts in _core.sobol_indices(
        black_box(function), problem, samples, second_order, estimator, confidence, seed, vectorized, pass_seed
    ):
        _warn("sobol_indices", parts)
        estimates = {name: Estimates(*parts.pop(name)) for name in ("first", "total", "second")}
        results.append(SobolIndices(**parts, **estimates))
    return results if several else results[0]


@dataclass(frozen=True)
class ElementaryEffects:
    """Unit of the response per range of the input, one entry per input, NaN with fewer than two effects. mean: effects of
    both signs cancel; mean_absolute: how much the input matters, standard_error of it; deviation: 0 where the response
    is linear in the input alone; count: effects. status: as of SobolIndices."""

    response: str
    status: str
    message: str
    mean: Array
    mean_absolute: Array
    deviation: Array
    standard_error: Array
    count: npt.NDArray[np.int32]


def morris_screening(
    function: Function,
    lower: npt.ArrayLike,
    upper: npt.ArrayLike,
    *,
    trajectories: int = 10,
    levels: int = 4,
    seed: int = 1,
    vectorized: bool = False,
    pass_seed: bool = False,
    names: Optional[Sequence[str]] = None,
    kinds: Optional[Sequence[Kind]] = None,
    response_names: Optional[Sequence[str]] = None,
) -> Union[ElementaryEffects, list[ElementaryEffects]]:
    """Which of many inputs matter at all, by elementary effects, in trajectories * (d + 1) runs.

    function, response_names, errors and warnings: as of sobol_indices(). levels: of a number, even; 4 is usual.
    """
    problem, several = _asked(function, lower, upper, names, kinds, response_names)
    results = []
    for parts in _core.morris_screening(
        black_box(function), problem, trajectories, levels, seed, vectorized, pass_seed
    ):
        _warn("morris_screening", parts)
        results.append(ElementaryEffects(**parts))
    return results if several else results[0]


@dataclass(frozen=True)
class MainEffect:
    """How the mean of a response moves with one input, one entry per level, natural units. low and high: between which
    80 % of the responses lie. NaN where every run failed. status: as of SobolIndices."""

    variable: str
    response: str
    status: str
    message: str
    x: Array
    mean: Array
    standard_error: Array
    low: Array
    high: Array


def main_effects(
    function: Function,
    lower: npt.ArrayLike,
    upper: npt.ArrayLike,
    *,
    levels: int = 21,
    samples: int = 256,
    seed: int = 1,
    vectorized: bool = False,
    pass_seed: bool = False,
    names: Optional[Sequence[str]] = None,
    kinds: Optional[Sequence[Kind]] = None,
    response_names: Optional[Sequence[str]] = None,
) -> list[MainEffect]:
    """A curve of each input, the others uniform in the box, at d * levels * samples points: for formulas and models.

    function, response_names, errors and warnings: as of sobol_indices(). All responses of the first input come first.
    """
    problem, _ = _asked(function, lower, upper, names, kinds, response_names)
    results = []
    for parts in _core.main_effects(black_box(function), problem, levels, samples, seed, vectorized, pass_seed):
        _warn("main_effects", parts)
        results.append(MainEffect(**parts))
    return results


def _asked(
    function: Function,
    lower: npt.ArrayLike,
    upper: npt.ArrayLike,
    names: Optional[Sequence[str]],
    kinds: Optional[Sequence[Kind]],
    response_names: Optional[Sequence[str]],
) -> Tuple[_core.Problem, bool]:
    """The box with its responses, and whether there are several."""
    problem = box(lower, upper, names, kinds)
    several = response_names is not None or isinstance(function, (list, tuple))
    count = len(response_names) if response_names is not None else len(function) if several else 1  # type: ignore[arg-type]
    add_responses(problem, ["record"] * count, response_names)
    return problem, several


def _warn(name: str, parts: dict[str, Any]) -> None:
    if parts["status"] != "estimated":
        warnings.warn(f"drawpoint.{name}: {parts['status']}: {parts['message']}", RunWarning, stacklevel=3)
