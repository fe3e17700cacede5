# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
"""Kriging with the manners of scikit-learn."""

from __future__ import annotations

import inspect
import os
import warnings
from dataclasses import dataclass
from statistics import NormalDist
from typing import Any, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _core

Array = npt.NDArray[np.float64]
_AnyModel = Union[_core.Model, _core.NearestModel]


class FitWarning(UserWarning):
    """A fit whose status is not "converged"; the model is valid, and the message says what was met."""


class Validation:
    """What was observed beside what was predicted without it, one entry per run, in the unit of y.

    observed, predicted; std: of the response without noise; observation_std: of a noisy run; rmse; nrmse: rmse over the
    range of y, NaN where all are equal.
    """

    def __init__(self, core: _core.Validation) -> None:
        self._core = core
        self.observed: Array = core.observed
        self.predicted: Array = core.predicted
        self.std: Array = np.sqrt(core.variance)
        self.observation_std: Array = np.sqrt(core.observation_variance)
        self.rmse: float = core.rmse
        self.nrmse: float = core.nrmse

    def score(self, error: str, level: float = 0.95) -> float:
        """One of "rmse", "nrmse", "mae", "q2", "nlpd", "coverage" and "crps".

        level: of "coverage", the share of runs within their interval. Raises ValueError for another error, and for a
        level outside (0, 1).
        """
        return self._core.score(error, level)

    def __repr__(self) -> str:
        return f"Validation(runs={self.observed.size}, rmse={self.rmse:.4g}, nrmse={self.nrmse:.4g})"


class Kriging:
    """Kriging (Gaussian process regression) by penalised likelihood: `Kriging().fit(X, y).predict(X_new)`.

    Parameters
    ----------
    correlation : "gaussian", "power_exponential", "matern32" or "matern52".
    trend : "constant", "linear", "quadratic" or "blind" (terms chosen by the runs).
    deterministic : True: the simulator has no noise, and the model meets the runs. False: it has some. None: it may;
        where the runs do not tell, standard deviations hold both, and message_ says so.
    noise_kind : what `noise` of fit() is: "known", the variance of each run; "pooled", estimates of one variance;
        "proportional", variances up to a factor.
    structure : "product"; "isotropic", one theta for all inputs; "additive", a sum of functions of one input.
    estimation : "penalized_likelihood" or "maximum_likelihood".
    lower, upper : (d,), the box that is scaled to [-1, 1], on which theta_ lives. None: the range of the runs.
    levels : d counts, 0 for a number, L for a category of the values 0 .. L - 1. None: all are numbers.
    theta_bounds, nugget_bounds : (least, largest), > 0; those of theta numbers or (d,) each. None: the library's.
    neighbourhood : runs that a prediction rests on, 8 to 4000, such as 400: for thousands of runs, whose exact fit costs
        n cubed. None: all runs. Such a model has no leave_one_out, covariance and gradient, and takes neither the trend
        "blind" nor the structure "additive".
    starts : local searches, 1 or more.
    seed : of the starting points; equal input gives equal bits.
    threads : of the matrix work of 500 runs or more and of predict(); 0: all cores. Results do not depend on it.

    Attributes after fit()
    ----------------------
    theta_ (d,), nugget_ (noise variance over process variance), process_variance_, noise_variance_ (unit of y
    squared), log_likelihood_, status_, message_, n_features_in_; of all runs also trend_ (coefficients) and condition_
    (of the correlation matrix); of a neighbourhood error_of_mean_, what twice the runs would change the mean by.
    """

    def __init__(
        self,
        *,
        correlation: str = "gaussian",
        trend: str = "constant",
        deterministic: Optional[bool] = None,
        noise_kind: str = "known",
        structure: str = "product",
        estimation: str = "penalized_likelihood",
        lower: Optional[npt.ArrayLike] = None,
        upper: Optional[npt.ArrayLike] = None,
        levels: Optional[Sequence[int]] = None,
        theta_bounds: Optional[Tuple[npt.ArrayLike, npt.ArrayLike]] = None,
        nugget_bounds: Optional[Tuple[float, float]] = None,
        neighbourhood: Optional[int] = None,
        starts: int = 8,
        seed: int = 1,
        threads: int = 1,
    ) -> None:
        self.correlation = correlation
        self.trend = trend
        self.deterministic = deterministic
        self.noise_kind = noise_kind
        self.structure = structure
        self.estimation = estimation
        self.lower = lower
        self.upper = upper
        self.levels = levels
        self.theta_bounds = theta_bounds
        self.nugget_bounds = nugget_bounds
        self.neighbourhood = neighbourhood
        self.starts = starts
        self.seed = seed
        self.threads = threads

    def fit(self, X: npt.ArrayLike, y: npt.ArrayLike, noise: Optional[npt.ArrayLike] = None) -> Kriging:
        """Fits the model to runs and returns self. Ctrl-C takes effect when the fit has ended.

        X: (n, d), natural units; y: (n,); noise: variance of the noise of each run, (n,) or one number, unit of y
        squared, None: estimated, the same everywhere; where each is of a few samples take noise_kind="pooled", for some
        are small by chance. Raises ValueError for other shapes, numbers that are not finite
        and parameters out of range. Warns FitWarning where status_ is not "converged".
        """
        runs, response = _runs(X, y)
        options = self._options(_noise(noise, response.size))
        if self.neighbourhood is None:
            self._keep(_core.fit(runs, response, options))
        else:
            self._keep(_core.fit_nearest(runs, response, options, self.neighbourhood))
        return self

    def predict(
        self,
        X: npt.ArrayLike,
        return_std: bool = False,
        return_interval: Optional[float] = None,
        observation: bool = False,
    ) -> Union[Array, Tuple[Array, ...]]:
        """The mean at each row of X, (m, d), in the unit of y: (m,).

        return_std: also the standard deviation, (m,). return_interval: also, of this probability, such as 0.95, the
        interval, (m, 2). observation: both are of one more noisy run, not of the response without its noise. Raises
        ValueError for other columns, numbers that are not finite and a probability outside (0, 1).
        """
        points = _points(X)
        if return_interval is not None and not 0.0 < return_interval < 1.0:
            raise ValueError(
                f"drawpoint.Kriging.predict: return_interval is {return_interval}; allowed are numbers between 0 and 1; "
                "use 0.95"
            )
        if not return_std and return_interval is None:
            return self._fitted().mean(points)
        mean, variance = self._fitted().predict(points, observation, self.threads)
        std = np.sqrt(np.maximum(variance, 0.0))
        result: Tuple[Array, ...] = (mean, std) if return_std else (mean,)
        if return_interval is not None:
            half = NormalDist().inv_cdf(0.5 + 0.5 * return_interval) * std
            result += (np.column_stack((mean - half, mean + half)),)
        return result

    def score(self, X: npt.ArrayLike, y: npt.ArrayLike) -> float:
        """Q2 = 1 - sum of squared errors / that about the mean of y; 1 is perfect. As scikit-learn's R2."""
        return self.validate(X, y).score("q2")

    def validate(self, X: npt.ArrayLike, y: npt.ArrayLike) -> Validation:
        """Predictions of runs that the fit has not seen, X (m, d) and y (m,), beside them."""
        return Validation(self._fitted().validate(*_runs(X, y)))

    def leave_one_out(self) -> Validation:
        """Every run predicted without it and its repeats, in closed form, parameters as fitted."""
        return Validation(_core.leave_one_out(self._of_all_runs("leave_one_out", "use k_fold")))

    def k_fold(
        self,
        X: npt.ArrayLike,
        y: npt.ArrayLike,
        folds: int = 5,
        seed: int = 1,
        noise: Optional[npt.ArrayLike] = None,
    ) -> Validation:
        """Every run predicted by a fit, with these parameters and noise as of fit(), to the other folds.

        The model of self stays. Raises ValueError for folds other than 2 to the number of different rows.
        """
        runs, response = _runs(X, y)
        options = self._options(_noise(noise, response.size))
        return Validation(_core.k_fold(runs, response, folds, options, seed, self.neighbourhood))

    def covariance(self, X: npt.ArrayLike) -> Array:
        """Joint covariance of the response without noise at the rows of X, (m, d): (m, m), unit of y squared."""
        return self._of_all_runs("covariance", "fit a part of the runs exactly").covariance(_points(X))

    def gradient(self, x: npt.ArrayLike) -> Tuple[Array, Array]:
        """Derivatives of the mean and of the variance by the inputs at one point, (d,) each."""
        return self._of_all_runs("gradient", "take differences of predict").gradient(np.asarray(x, dtype=float))

    def save(self, path: Union[str, os.PathLike[str]]) -> None:
        """Writes the model as the library's text, whole or not at all. Raises RuntimeError when the disk refuses."""
        self._fitted().save(os.fspath(path))

    @classmethod
    def load(cls, path: Union[str, os.PathLike[str]]) -> Kriging:
        """What save(), or the C++ library, wrote; it predicts the same bits. Raises RuntimeError for other files.

        The file holds the model, not the parameters of the fit, but for correlation.
        """
        try:
            with open(path, encoding="utf-8", errors="replace") as file:
                kind = _kind(file.read())
        except OSError:
            kind = _core.Model  # which says what the matter is
        return cls._of(kind.load(os.fspath(path)))

    def to_text(self) -> str:
        """The text that save() writes."""
        return self._fitted().to_text()

    @classmethod
    def from_text(cls, text: str) -> Kriging:
        """As load(), from a text."""
        return cls._of(_kind(text).from_text(text))

    def get_params(self, deep: bool = True) -> dict[str, Any]:
        """The parameters, by name."""
        return {name: getattr(self, name) for name in _parameters()}

    def set_params(self, **params: Any) -> Kriging:
        """Sets parameters for the next fit and returns self. Raises ValueError for a name that is none."""
        for name, value in params.items():
            if name not in _parameters():
                raise ValueError(f'drawpoint.Kriging: "{name}" is no parameter; allowed are {", ".join(_parameters())}')
            setattr(self, name, value)
        return self

    def __repr__(self) -> str:
        default = Kriging()
        changed = [
            f"{name}={value!r}" for name, value in self.get_params().items() if value is not getattr(default, name)
            and not np.array_equal(value, getattr(default, name))
        ]
        return f"Kriging({', '.join(changed)})"

    @classmethod
    def _of(cls, core: _AnyModel) -> Kriging:
        model = cls(correlation=core.correlation)
        if isinstance(core, _core.NearestModel):
            model.neighbourhood = core.neighbourhood
        model._take(core)
        return model

    def _options(self, noise: Optional[Array]) -> _core.FitOptions:
        if noise is not None and self.deterministic:
            raise ValueError("drawpoint.Kriging: noise is given and deterministic is True; leave one of them out")
        options = _core.FitOptions()
        options.set_kind(self.correlation, self.trend)
        options.set_structure(self.structure)
        options.set_estimation(self.estimation)
        if noise is not None:
            options.set_noise(self.noise_kind, noise)
        elif self.deterministic:
            options.set_noise("none", np.empty(0))
        options.may_be_exact = self.deterministic is None
        if self.lower is not None or self.upper is not None:
            box = [np.asarray([] if bound is None else bound, dtype=float) for bound in (self.lower, self.upper)]
            options.set_box(*box)
        if self.levels is not None:
            options.levels = [int(count) for count in self.levels]
        if self.theta_bounds is not None:
            options.set_theta_bounds(*(np.atleast_1d(np.asarray(b, dtype=float)) for b in self.theta_bounds))
        if self.nugget_bounds is not None:
            options.set_nugget_bounds(*self.nugget_bounds)
        options.starts, options.seed, options.threads = self.starts, self.seed, self.threads
        return options

    def _keep(self, core: _AnyModel) -> None:
        self._take(core)
        if core.status != "converged":
            warnings.warn(f"drawpoint.Kriging: {core.status}: {core.message}", FitWarning, stacklevel=3)

    def _take(self, core: _AnyModel) -> None:
        self.model_ = core
        self.theta_: Array = core.theta
        self.nugget_: float = core.nugget
        self.process_variance_: float = core.process_variance
        self.noise_variance_: float = core.noise_variance
        self.log_likelihood_: float = core.log_likelihood
        self.status_: str = core.status
        self.message_: str = core.message
        self.n_features_in_: int = core.variables
        for name in ("trend_", "condition_", "error_of_mean_"):
            self.__dict__.pop(name, None)
        if isinstance(core, _core.NearestModel):
            self.error_of_mean_: float = core.error_of_mean
        else:
            self.trend_: Array = core.trend
            self.condition_: float = core.condition

    def _of_all_runs(self, what: str, instead: str) -> _core.Model:
        model = self._fitted()
        if isinstance(model, _core.NearestModel):
            raise ValueError(f"drawpoint.Kriging: {what} is not there with neighbourhood={model.neighbourhood}; {instead}")
        return model

    def _fitted(self) -> _AnyModel:
        model: Optional[_AnyModel] = getattr(self, "model_", None)
        if model is None:
            raise ValueError("drawpoint.Kriging: the model is not fitted; call fit(X, y) first")
        return model


@dataclass(frozen=True)
class Standing:
    """How one way to fit did: log_score, less is better; gain over the first way, with its standard error."""

    name: str
    log_score: float
    gain: float
    standard_error: float
    box_gain: float


@dataclass(frozen=True)
class Choice:
    """The model that leave-one-out and refits prefer, and how all did."""

    model: Kriging
    best: int
    table: Tuple[Standing, ...]


def choose_kriging(
    X: npt.ArrayLike,
    y: npt.ArrayLike,
    noise: Optional[npt.ArrayLike] = None,
    kinds: Optional[Sequence[Tuple[str, str]]] = None,
    **params: Any,
) -> Choice:
    """The Kriging that predicts the runs best, error bars included, of several kinds.

    X, y, noise: as Kriging.fit. kinds: pairs of correlation and trend, the one to keep without a reason first; None:
    "gaussian" and "matern52", each with a "constant" and a "linear" trend. params: of Kriging, for all kinds. Another
    kind takes the place of the first where it is better by more than chance, on runs that it has not seen too. Raises
    ValueError and warns as Kriging.fit, and raises ValueError for no kinds.
    """
    runs, response = _runs(X, y)
    variance = _noise(noise, response.size)
    pairs = [(c, t) for c in ("gaussian", "matern52") for t in ("constant", "linear")] if kinds is None else kinds
    models = [Kriging(**params).set_params(correlation=c, trend=t) for c, t in pairs]
    if variance is not None and any(model.noise_kind != "known" for model in models):
        raise ValueError("drawpoint.choose_kriging: allowed is the noise_kind \"known\"; fit other kinds one by one")
    if any(model.neighbourhood is not None for model in models):
        raise ValueError("drawpoint.choose_kriging: allowed is neighbourhood=None; compare such fits by k_fold")
    options = [model._options(variance) for model in models]
    core, best, table = _core.choose_fit(runs, response, options, np.empty(0) if variance is None else variance)
    models[best]._keep(core)
    return Choice(models[best], best, tuple(Standing(*row) for row in table))


def _kind(text: str) -> Union[type[_core.Model], type[_core.NearestModel]]:
    return _core.NearestModel if '"drawpoint nearest Kriging model"' in text else _core.Model


def _parameters() -> list[str]:
    return [name for name in inspect.signature(Kriging.__init__).parameters if name != "self"]


def _points(X: npt.ArrayLike) -> Array:
    points = np.asarray(X, dtype=float)
    if points.ndim != 2:
        raise ValueError(
            f"drawpoint.Kriging: X has the shape {points.shape}; allowed is (points, inputs); "
            "use X.reshape(-1, 1) for one input and X.reshape(1, -1) for one point"
        )
    return points


def _runs(X: npt.ArrayLike, y: npt.ArrayLike) -> Tuple[Array, Array]:
    response = np.asarray(y, dtype=float)
    if response.ndim != 1:
        raise ValueError(
            f"drawpoint.Kriging: y has the shape {response.shape}; allowed is (runs,); fit one model per response"
        )
    return _points(X), response


def _noise(noise: Optional[npt.ArrayLike], runs: int) -> Optional[Array]:
    if noise is None:
        return None
    variance = np.asarray(noise, dtype=float)
    return np.full(runs, float(variance)) if variance.ndim == 0 else variance
