# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest

import drawpoint

PI = np.pi
# Ishigami with a = 7, b = 0.1: Var = 1/2 + a^2/8 + b pi^4/5 + b^2 pi^8/18.
V1, V2, V13 = 0.5 * (1 + 0.1 * PI**4 / 5) ** 2, 49 / 8, 0.01 * PI**8 * (1 / 18 - 1 / 50)
VARIANCE = V1 + V2 + V13


def ishigami(X):
    return np.sin(X[:, 0]) + 7 * np.sin(X[:, 1]) ** 2 + 0.1 * X[:, 2] ** 4 * np.sin(X[:, 0])


def test_the_indices_of_ishigami_are_known():
    s = drawpoint.sobol_indices(
        ishigami, [-PI] * 3, [PI] * 3, samples=4096, second_order=True, vectorized=True, names=["a", "b", "c"]
    )
    assert s.status == "estimated" and s.message == "" and s.response == "y0"
    assert s.variance == pytest.approx(VARIANCE, rel=0.02) and s.mean == pytest.approx(3.5, abs=0.05)
    assert s.first.value == pytest.approx(np.array([V1, V2, 0]) / VARIANCE, abs=0.02)
    assert s.total.value == pytest.approx(np.array([V1 + V13, V2, V13]) / VARIANCE, abs=0.02)
    assert s.second.value[0, 2] == pytest.approx(V13 / VARIANCE, abs=0.03)
    assert (s.first.lower <= s.first.value).all() and (s.first.value <= s.first.upper).all()


def test_points_arrays_and_models_give_the_same():
    X = drawpoint.optimized_latin_hypercube(25, [0, 0], [1, 1])
    model = drawpoint.Kriging(deterministic=True).fit(X, np.sin(3 * X[:, 0]) + X[:, 1] ** 2)
    of_model = drawpoint.sobol_indices(model, [0, 0], [1, 1], samples=64)
    of_arrays = drawpoint.sobol_indices(model.predict, [0, 0], [1, 1], samples=64, vectorized=True)
    of_points = drawpoint.sobol_indices(lambda x: model.predict(x[None])[0], [0, 0], [1, 1], samples=64)
    assert (of_model.first.value == of_arrays.first.value).all()
    assert of_points.first.value == pytest.approx(of_model.first.value, abs=1e-9)
    both = drawpoint.sobol_indices([model, model], [0, 0], [1, 1], samples=64)
    assert len(both) == 2 and (both[1].total.value == of_model.total.value).all()


def test_lost_runs_and_constants_warn():
    def half(x):
        if x[0] > 0.5:
            raise RuntimeError("too steep")
        return x[0]

    with pytest.warns(drawpoint.RunWarning, match="runs_lost"):
        assert drawpoint.sobol_indices(half, [0, 0], [1, 1], samples=64).status == "runs_lost"
    with pytest.warns(drawpoint.RunWarning, match="constant_response"):
        drawpoint.sobol_indices(lambda x: 2.0, [0], [1], samples=16)


def test_elementary_effects_of_a_plane_are_its_slopes():
    e = drawpoint.morris_screening(lambda x: 3 * x[0] - x[1], [0, 0], [2, 1], names=["a", "b"])
    assert e.status == "estimated" and (e.count == 10).all()
    assert e.mean == pytest.approx([6, -1]) and e.mean_absolute == pytest.approx([6, 1])
    assert e.deviation == pytest.approx([0, 0], abs=1e-12) and e.standard_error == pytest.approx([0, 0], abs=1e-12)


def test_main_effects_of_a_sum_are_its_terms():
    def both(X):
        y = X[:, 0] ** 2 + X[:, 1]
        return np.column_stack([y, -y])

    curves = drawpoint.main_effects(
        both, [0, 0], [1, 1], levels=5, samples=64, vectorized=True, response_names=["y", "minus"]
    )
    assert [(c.variable, c.response) for c in curves] == [("x0", "y"), ("x0", "minus"), ("x1", "y"), ("x1", "minus")]
    assert curves[0].mean - curves[0].mean[0] == pytest.approx(np.linspace(0, 1, 5) ** 2)
    assert (curves[2].mean == -curves[3].mean).all() and (curves[2].low <= curves[2].mean).all()


def test_lost_runs_of_screenings_and_curves_warn():
    def corner(x):
        if x[0] > 0.5 and x[1] > 0.25:
            raise RuntimeError("too steep")
        return x[0]

    with pytest.warns(drawpoint.RunWarning, match="morris_screening: runs_lost"):
        drawpoint.morris_screening(corner, [0, 0], [1, 1], trajectories=40)
    with pytest.warns(drawpoint.RunWarning, match="main_effects: runs_lost"):
        drawpoint.main_effects(corner, [0, 0], [1, 1], levels=3, samples=16)


@pytest.mark.parametrize(
    "options, message",
    [
        ({"samples": 1}, "doe::sobol_indices: samples is 1; allowed is 2 or more"),
        ({"estimator": "sobol"}, 'estimator is "sobol"; allowed are saltelli, jansen, martinez'),
        ({"confidence": 95}, "confidence is 95; allowed is between 0 and 1"),
    ],
)
def test_faulty_options_are_refused_in_words(options, message):
    with pytest.raises(ValueError, match=message):
        drawpoint.sobol_indices(lambda x: x[0], [0], [1], **options)


def test_control_c_is_no_failed_run():
    def interrupted(x):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        drawpoint.sobol_indices(interrupted, [0], [1])
