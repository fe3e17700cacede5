# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
"""The compiled part. Arrays are float64; those of the wrong shape raise TypeError, which the package prevents."""

from typing import Any, Callable, Optional, Sequence, Tuple, TypedDict

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]

class PointsParts(TypedDict):
    run: list[int]
    x: Array
    y: Array
    lower: Array
    upper: Array

class Problem:
    def __init__(self, deterministic: bool = ...) -> None: ...
    def add_variable(self, name: str, lower: float, upper: float, integer: bool, levels: Sequence[str]) -> None: ...
    def add_response(self, name: str, goal: str, limit: float) -> None: ...
    def check(self) -> None: ...
    @property
    def variables(self) -> list[str]: ...
    @property
    def responses(self) -> list[str]: ...

class FitOptions:
    may_be_exact: bool
    levels: list[int]
    starts: int
    seed: int
    threads: int
    def set_kind(self, correlation: str, trend: str) -> None: ...
    def set_structure(self, structure: str) -> None: ...
    def set_estimation(self, estimation: str) -> None: ...
    def set_noise(self, kind: str, variance: Array) -> None: ...
    def set_box(self, lower: Array, upper: Array) -> None: ...
    def set_theta_bounds(self, lower: Array, upper: Array) -> None: ...
    def set_nugget_bounds(self, lower: float, upper: float) -> None: ...

class Validation:
    rmse: float
    nrmse: float
    observed: Array
    predicted: Array
    variance: Array
    observation_variance: Array
    def score(self, error: str, level: float = ...) -> float: ...

class _Regression:
    variables: int
    runs: int
    theta: Array
    nugget: float
    process_variance: float
    noise_variance: float
    log_likelihood: float
    status: str
    message: str
    correlation: str
    def mean(self, X: Array) -> Array: ...
    def predict(self, X: Array, observation: bool, threads: int) -> Tuple[Array, Array]: ...
    def validate(self, X: Array, y: Array) -> Validation: ...
    def to_text(self) -> str: ...
    def save(self, path: str) -> None: ...

class Model(_Regression):
    trend: Array
    constant: float
    condition: float
    def covariance(self, X: Array) -> Array: ...
    def gradient(self, x: Array) -> Tuple[Array, Array]: ...
    @staticmethod
    def from_text(text: str) -> Model: ...
    @staticmethod
    def load(path: str) -> Model: ...

class NearestModel(_Regression):
    neighbourhood: int
    error_of_mean: float
    @staticmethod
    def from_text(text: str) -> NearestModel: ...
    @staticmethod
    def load(path: str) -> NearestModel: ...

def latin_hypercube(problem: Problem, runs: int, seed: int, corners: bool, centred: bool) -> Array: ...
def optimized_latin_hypercube(
    problem: Problem, runs: int, seed: int, corners: bool, centred: bool, criterion: str, sweeps: Optional[int]
) -> Array: ...
def scrambled_sobol(problem: Problem, runs: int, seed: int) -> Array: ...
def halton(problem: Problem, runs: int, seed: int, scrambled: bool) -> Array: ...
def uniform_random(problem: Problem, runs: int, seed: int) -> Array: ...
def fit(X: Array, y: Array, options: FitOptions) -> Model: ...
def fit_nearest(X: Array, y: Array, options: FitOptions, neighbourhood: int) -> NearestModel: ...
def choose_fit(
    X: Array, y: Array, kinds: Sequence[FitOptions], noise_variance: Array
) -> Tuple[Model, int, list[Tuple[str, float, float, float, float]]]: ...
def leave_one_out(model: Model) -> Validation: ...
def k_fold(
    X: Array, y: Array, folds: int, options: FitOptions, seed: int, neighbourhood: Optional[int]
) -> Validation: ...
def optimize(
    function: Callable[..., object],
    problem: Problem,
    budget: int,
    seed: int,
    threads: int,
    first: Optional[int],
    journal: str,
    time_limit: float,
    pass_seed: bool,
    callback: Optional[Callable[..., object]],
) -> dict[str, Any]: ...
def nsga2(
    function: object,
    problem: Problem,
    population: Optional[int],
    generations: int,
    evaluations: Optional[int],
    seed: int,
    start: Array,
    vectorized: bool,
    pass_seed: bool,
) -> dict[str, Any]: ...
def non_dominated(Y: Array) -> list[int]: ...
def non_dominated_sort(Y: Array) -> list[list[int]]: ...
def hypervolume(Y: Array, reference: Array) -> float: ...
def hypervolume_contributions(Y: Array, reference: Array) -> Array: ...
def sobol_indices(
    function: object,
    problem: Problem,
    samples: int,
    second_order: bool,
    estimator: str,
    confidence: float,
    seed: int,
    vectorized: bool,
    pass_seed: bool,
) -> list[dict[str, Any]]: ...
def morris_screening(
    function: object, problem: Problem, trajectories: int, levels: int, seed: int, vectorized: bool, pass_seed: bool
) -> list[dict[str, Any]]: ...
def main_effects(
    function: object, problem: Problem, levels: int, samples: int, seed: int, vectorized: bool, pass_seed: bool
) -> list[dict[str, Any]]: ...
