# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
"""Which share of a response's variance each input explains."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import Callable, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._problem import Kind, add_responses, box
from .fronts import black_box
from .kriging import Kriging
from .optimum import RunWarning

Array = npt.NDArray[np.float64]


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
    function: Union[Callable[..., object], Kriging, Sequence[Kriging]],
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
    problem = box(lower, upper, names, kinds)
    several = response_names is not None or isinstance(function, (list, tuple))
    count = len(response_names) if response_names is not None else len(function) if several else 1  # type: ignore[arg-type]
    add_responses(problem, ["record"] * count, response_names)
    results = []
    for parts in _core.sobol_indices(
        black_box(function), problem, samples, second_order, estimator, confidence, seed, vectorized, pass_seed
    ):
        of_response = SobolIndices(
            response=parts["response"],
            status=parts["status"],
            message=parts["message"],
            mean=parts["mean"],
            variance=parts["variance"],
            first=Estimates(*parts["first"]),
            total=Estimates(*parts["total"]),
            second=Estimates(*parts["second"]),
        )
        if of_response.status != "estimated":
            warnings.warn(
                f"drawpoint.sobol_indices: {of_response.status}: {of_response.message}", RunWarning, stacklevel=2
            )
        results.append(of_response)
    return results if several else results[0]
