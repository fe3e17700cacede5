# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
import copy
import os
import pickle
import subprocess
import sys
import threading
import time
import warnings

import numpy as np
import pytest

import drawpoint
from drawpoint import Kriging

X = drawpoint.optimized_latin_hypercube(40, [0.1, 10.0], [0.6, 60.0])
NEW = drawpoint.scrambled_sobol(64, [0.1, 10.0], [0.6, 60.0])


def force(X):
    depth, rake = X.T
    return 20 + 300 * depth**1.5 * (1 + ((rake - 30) / 40) ** 2)


@pytest.fixture(scope="module")
def model():
    return Kriging().fit(X, force(X))


def test_two_runs_are_predicted_as_simple_algebra_says():
    # Ordinary Kriging of runs -1 and 1 at the ends of [0, 1], theta 0.1 on [-1, 1]: c(x) = exp(-0.1 (u - u_i)^2), so
    # that by symmetry mean(x) = (c_2 - c_1)/(1 - c_12), u = 2x - 1.
    fixed = Kriging(deterministic=True, theta_bounds=(0.1, 0.1), nugget_bounds=(1e-10, 1e-10)).fit([[0.0], [1.0]], [-1, 1])
    u = np.linspace(-1, 1, 7)
    c_1, c_2, c_12 = np.exp(-0.1 * (u + 1) ** 2), np.exp(-0.1 * (u - 1) ** 2), np.exp(-0.4)
    assert fixed.predict((u[:, None] + 1) / 2) == pytest.approx((c_2 - c_1) / (1 - c_12), abs=1e-8)
    assert fixed.theta_ == pytest.approx([0.1])


def test_predictions_are_those_of_the_cpp_program_to_the_bit(model, tmp_path):
    program = os.environ["DRAWPOINT_COMING_FROM_PYTHON"]
    runs, points, out = (str(tmp_path / name) for name in ("runs", "points", "out"))
    np.savetxt(runs, np.c_[X, force(X)], delimiter=",", header="depth,rake,force", comments="", fmt="%.17g")
    np.savetxt(points, NEW, delimiter=",", header="depth,rake", comments="", fmt="%.17g")
    said = subprocess.run([program, runs, points, out], check=True, capture_output=True, text=True).stdout
    table = np.genfromtxt(out, delimiter=",", names=True)
    mean, std = model.predict(NEW, return_std=True)
    assert (mean == table["mean"]).all() and (std == table["deviation"]).all()
    assert said == f"40 runs, error by leaving out {100 * model.leave_one_out().nrmse:.2f} % of the range\n"


def test_order_and_type_of_the_arrays_change_nothing(model):
    mean = model.predict(NEW)
    assert (mean == model.predict(np.ascontiguousarray(NEW))).all()
    assert (mean == model.predict(np.asfortranarray(NEW))).all()
    assert (mean == model.predict(NEW.tolist())).all()
    assert (mean[::2] == model.predict(np.asfortranarray(NEW)[::2])).all()
    many = np.asfortranarray(np.tile(NEW, (150, 1)))  # more than a block
    assert (model.predict(many) == np.tile(mean, 150)).all()
    assert (model.predict(many, return_std=True)[1] == np.tile(model.predict(NEW, return_std=True)[1], 150)).all()
    assert model.predict(NEW[:0]).shape == (0,)


def test_an_interval_is_that_of_the_normal_distribution(model):
    mean, std, interval = model.predict(NEW, return_std=True, return_interval=0.95)
    assert interval.shape == (64, 2)
    assert interval[:, 1] - mean == pytest.approx(1.959963984540054 * std)
    assert mean - interval[:, 0] == pytest.approx(1.959963984540054 * std)
    assert (model.predict(NEW, return_std=True, observation=True)[1] >= std).all()


def test_attributes_name_what_was_fitted(model):
    assert model.theta_.shape == (2,) and (model.theta_ > 0).all()
    assert model.status_ == "converged" and isinstance(model.message_, str)
    assert model.noise_variance_ == pytest.approx(model.nugget_ * model.process_variance_)
    assert np.isfinite(model.log_likelihood_) and model.n_features_in_ == 2
    assert model.score(NEW, force(NEW)) > 0.9999
    assert abs(model.predict(NEW) - force(NEW)).max() < 0.5


def test_gradients_are_the_slopes_of_predictions(model):
    x, step = NEW[5], np.array([1e-5, 1e-3])
    slope = [(model.predict((x + h)[None]) - model.predict((x - h)[None]))[0] / (2 * h.sum()) for h in np.diag(step)]
    assert model.gradient(x)[0] == pytest.approx(slope, rel=1e-4)
    assert np.diag(model.covariance(NEW[:4])) == pytest.approx(model.predict(NEW[:4], return_std=True)[1] ** 2, rel=1e-4)


def test_parameters_go_in_and_out_as_in_scikit_learn(model):
    other = Kriging(correlation="matern52", lower=[0.1, 10.0], upper=[0.6, 60.0], starts=2)
    twin = type(other)(**other.get_params())
    assert twin.get_params() == other.get_params()
    assert twin.set_params(trend="linear") is twin and twin.trend == "linear"
    assert repr(Kriging(trend="linear")) == "Kriging(trend='linear')"
    assert not (twin.fit(X, force(X)).predict(NEW) == model.predict(NEW)).all()
    with pytest.raises(ValueError, match='"nuget" is no parameter; allowed are correlation, trend'):
        other.set_params(nuget=1)


def test_saved_models_predict_the_same_bits(model, tmp_path):
    model.save(tmp_path / "force.json")
    mean = model.predict(NEW)
    for twin in (
        Kriging.load(tmp_path / "force.json"),
        Kriging.from_text(model.to_text()),
        pickle.loads(pickle.dumps(model)),
        copy.deepcopy(model),
    ):
        assert (twin.predict(NEW) == mean).all() and twin.status_ == "converged"
    (tmp_path / "force.json").write_text(model.to_text()[:-9])
    with pytest.raises(RuntimeError, match="force.json"):
        Kriging.load(tmp_path / "force.json")


def test_a_neighbourhood_fits_many_runs_and_one_of_all_is_exact(tmp_path):
    many = drawpoint.latin_hypercube(1500, [0.1, 10.0], [0.6, 60.0])
    nearest = Kriging(deterministic=True, neighbourhood=200).fit(many, force(many))
    assert abs(nearest.predict(NEW) - force(NEW)).max() < 1e-4 * np.ptp(force(NEW))
    assert 0 <= nearest.error_of_mean_ < 1e-4 * np.ptp(force(NEW)) and not hasattr(nearest, "condition_")
    nearest.save(tmp_path / "nearest.json")
    for twin in (Kriging.load(tmp_path / "nearest.json"), pickle.loads(pickle.dumps(nearest))):
        assert twin.neighbourhood == 200 and (twin.predict(NEW) == nearest.predict(NEW)).all()
    (tmp_path / "cut.json").write_text(nearest.to_text()[:-9])
    with pytest.raises(RuntimeError, match="cut.json") as cut:
        Kriging.load(tmp_path / "cut.json")
    assert "drawpoint Kriging model" not in str(cut.value)
    assert nearest.k_fold(many[:300], force(many[:300])).nrmse < 1e-3
    for call in (nearest.leave_one_out, lambda: nearest.covariance(NEW), lambda: nearest.gradient(NEW[0])):
        with pytest.raises(ValueError, match="not there with neighbourhood=200; "):
            call()
    exact = Kriging(deterministic=True).fit(X, force(X))
    indices = [drawpoint.sobol_indices(m, [0.1, 10.0], [0.6, 60.0], samples=256).first.value for m in (nearest, exact)]
    assert indices[0] == pytest.approx(indices[1], abs=1e-2)
    all_runs = Kriging(neighbourhood=80).fit(X, force(X))
    assert all_runs.error_of_mean_ == 0 and abs(all_runs.predict(NEW) - force(NEW)).max() < 1
    assert not hasattr(all_runs.set_params(neighbourhood=None).fit(X, force(X)), "error_of_mean_")
    with pytest.raises(ValueError, match="neighbourhood"):
        Kriging(neighbourhood=3).fit(X, force(X))


def test_noise_that_is_known_is_not_fitted_through():
    rng = np.random.default_rng(1)
    x = np.repeat(np.linspace(0, 1, 15), 4)[:, None]
    y = np.sin(6 * x[:, 0]) + 0.2 * rng.standard_normal(60)
    new = np.linspace(0, 1, 50)[:, None]
    for noise in (0.04, np.full(60, 0.04)):
        known = Kriging().fit(x, y, noise)
        assert known.noise_variance_ == pytest.approx(0.04, rel=1e-6)
        assert abs(known.predict(new) - np.sin(6 * new[:, 0])).max() < 0.2
    # repeats are left out together: the error at a new place, not less than the noise
    assert known.leave_one_out().rmse > 0.15
    with pytest.raises(ValueError, match="deterministic is True"):
        Kriging(deterministic=True).fit(x, y, 0.04)
    # each fold is fitted with the noise of its own runs: of two runs, one quiet and one loud, the quiet one is believed
    told = np.where(np.arange(60) % 2 == 0, 1e-6, 4.0)
    scattered = np.sin(6 * x[:, 0]) + np.where(told > 1, 2.0, 0.0)
    believing = Kriging().k_fold(x, scattered, noise=told)
    quiet = told < 1
    assert abs(believing.predicted - np.sin(6 * x[:, 0]))[quiet].max() < 0.1
    assert abs(Kriging().k_fold(x, scattered).predicted - np.sin(6 * x[:, 0]))[quiet].max() > 0.5


def test_validation_counts_runs_that_the_model_has_not_seen(model):
    seen = model.validate(NEW, force(NEW))
    error = force(NEW) - model.predict(NEW)
    assert seen.rmse == pytest.approx(np.sqrt(np.mean(error**2)))
    assert seen.score("mae") == pytest.approx(abs(error).mean())
    assert (seen.observed == force(NEW)).all() and (seen.std <= seen.observation_std).all()
    folds = Kriging().k_fold(X, force(X), folds=5)
    assert 0 < folds.nrmse < 0.05 and folds.observed.shape == (40,)
    assert 0.5 < model.leave_one_out().score("coverage", level=0.95) <= 1
    with pytest.raises(ValueError, match='error is "r2"; allowed are rmse, nrmse, mae, q2'):
        seen.score("r2")
    with pytest.raises(ValueError, match="kriging::k_fold: folds is 1"):
        Kriging().k_fold(X, force(X), folds=1)


def test_the_choice_takes_the_rough_kind_for_a_rough_response():
    x = drawpoint.optimized_latin_hypercube(60, [0.0], [1.0])
    rough = abs(x[:, 0] - 0.37) + abs(np.sin(9 * x[:, 0]))
    choice = drawpoint.choose_kriging(x, rough, kinds=[("gaussian", "constant"), ("matern32", "constant")], seed=2)
    assert [standing.name for standing in choice.table] == ["gaussian, constant", "matern32, constant"]
    assert choice.best == 1 and choice.model.correlation == "matern32" and choice.model.seed == 2
    assert choice.table[1].gain > choice.table[1].standard_error > 0
    assert (choice.model.predict(x) == Kriging(correlation="matern32", seed=2).fit(x, rough).predict(x)).all()
    with pytest.raises(ValueError, match="0 ways; allowed is 1 or more"):
        drawpoint.choose_kriging(x, rough, kinds=[])


def test_a_fit_that_did_not_converge_warns():
    with pytest.warns(drawpoint.FitWarning, match="constant_response"):
        flat = Kriging().fit(X, np.full(40, 3.0))
    assert flat.status_ == "constant_response" and (flat.predict(NEW) == 3).all()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        Kriging().fit(X, force(X))


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda m: m.predict([1.0, 2.0]), r"X has the shape \(2,\); allowed is \(points, inputs\)"),
        (lambda m: m.predict(NEW[:, :1]), "columns"),
        (lambda m: m.predict([[np.nan, 1]]), "not finite"),
        (lambda m: m.predict(NEW, return_interval=95), "return_interval is 95; allowed are numbers between 0 and 1"),
        (lambda m: m.gradient([1.0]), "1"),
        (lambda m: m.validate(NEW, [1.0]), "X has 64 rows but y has 1 entries"),
        (lambda m: Kriging().fit(X, force(X)[:3]), "3"),
        (lambda m: Kriging().fit(X, force(X)[:, None]), "one model per response"),
        (lambda m: Kriging().fit(X, np.full(40, np.nan)), r"y\[0\] is nan; allowed are finite numbers"),
        (lambda m: Kriging(correlation="gauss").fit(X, force(X)), 'correlation is "gauss"; allowed are gaussian, power'),
        (lambda m: Kriging(starts=0).fit(X, force(X)), "starts is 0"),
        (lambda m: Kriging(lower=[0, 0]).fit(X, force(X)), "upper"),
        (lambda m: Kriging().fit(X, force(X), [1.0, 2.0]), "2"),
        (lambda m: Kriging().predict(NEW), "not fitted; call fit"),
    ],
)
def test_faulty_input_is_refused_in_words(model, call, message):
    with pytest.raises(ValueError, match=message):
        call(model)


def test_other_threads_of_python_run_while_a_model_is_fitted():
    ticks, fitted = [], threading.Event()

    def tick():
        while not fitted.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.001)

    x = drawpoint.scrambled_sobol(250, [0] * 5, [1] * 5)
    other = threading.Thread(target=tick)
    other.start()
    before = time.perf_counter()
    drawpoint._core.fit(x, np.sin(5 * x).sum(axis=1), drawpoint.Kriging()._options(None))
    after = time.perf_counter()
    fitted.set()
    other.join()
    assert after - before > 0.1
    assert sum(before < t < after for t in ticks) > 10


MEMORY = """
import resource, sys
import numpy as np
import drawpoint
model = drawpoint.Kriging().fit([[0.0, 0.0], [1.0, 0.3], [0.4, 1.0], [0.2, 0.5]], [0.0, 1.0, 3.0, 2.0])
X = np.asarray(np.random.default_rng(1).random((4_000_000, 2)), order=sys.argv[1])
model.predict(X[:5000])
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
model.predict(X)
print((resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) * 1024 / X.nbytes)
"""


@pytest.mark.filterwarnings("ignore")
def test_column_major_arrays_are_read_where_they_lie():
    def added(order):  # as a share of the array; the means are half of it
        run = [sys.executable, "-W", "ignore", "-c", MEMORY, order]
        return float(subprocess.run(run, check=True, capture_output=True, text=True).stdout)

    assert added("F") < 0.75
    assert added("C") > 1.25  # what the measurement says of a copy
