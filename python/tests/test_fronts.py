# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest

import drawpoint


def test_the_front_of_points_by_hand():
    Y = np.array([[1, 4], [2, 2], [4, 1], [3, 3], [2, 2], [4, 4]])
    assert drawpoint.front(Y).tolist() == [0, 1, 2, 4]
    assert drawpoint.front(Y, ["maximize", "maximize"]).tolist() == [5]
    assert drawpoint.front(Y, ["minimize", "maximize"]).tolist() == [0]
    assert [rows.tolist() for rows in drawpoint.fronts(Y)] == [[0, 1, 2, 4], [3], [5]]


def test_hypervolumes_by_hand():
    Y = [[1.0, 2.0], [2.0, 1.0], [5.0, 5.0]]
    assert drawpoint.hypervolume(Y, [3, 3]) == 3.0
    assert drawpoint.hypervolume_contributions(Y, [3, 3]).tolist() == [1.0, 1.0, 0.0]
    assert drawpoint.hypervolume([[-1.0, 2.0], [-2.0, 1.0]], [-3, 3], ["maximize", "minimize"]) == 3.0
    # two boxes of 2 x 1 x 1 share 1 x 1 x 1
    assert drawpoint.hypervolume([[0, 1, 1], [1, 0, 1]], [2, 2, 2]) == 3.0


def test_nsga2_finds_a_known_front_and_calls_alike():
    def point(x):  # the front is x in [0, 2], where sqrt f1 + sqrt f2 = 2
        return x[0] ** 2, (x[0] - 2) ** 2

    def points(X):
        return np.c_[X[:, 0] ** 2, (X[:, 0] - 2) ** 2]

    front = drawpoint.nsga2(point, [-5], [5], population=40, generations=40)
    assert front.status == "completed" and front.evaluations == 41 * 40 and front.objectives == ["y0", "y1"]
    assert np.sqrt(front.Y).sum(axis=1) == pytest.approx(np.full(len(front), 2.0), abs=0.01)
    assert drawpoint.hypervolume(front.Y, [4, 4]) > 0.98 * (16 - 8 / 3)
    twin = drawpoint.nsga2(points, [-5], [5], population=40, generations=40, vectorized=True)
    assert (twin.X == front.X).all() and (twin.Y == front.Y).all()


def test_limits_goals_and_failures():
    def fragile(x):
        if x[1] > 0.9:
            raise ValueError("too steep")
        return x[0], x[1], x[0] + x[1]

    front = drawpoint.nsga2(
        fragile, [0, 0], [1, 1], goals=["maximize", "maximize", ("at_most", 1.0)], population=20, generations=30,
        start=[[0.5, 0.5]],
    )
    assert front.failed > 0 and (front.responses[:, 2] <= 1).all() and front.Y.shape[1] == 2
    assert front.Y.sum(axis=1).max() > 0.98


def test_fitted_models_are_searched_as_functions_of_them_are():
    X = drawpoint.optimized_latin_hypercube(20, [0, 0], [1, 1])
    first, second = (drawpoint.Kriging(deterministic=True).fit(X, np.sin(3 * X[:, k]) + X[:, 1]) for k in (0, 1))
    options = {"population": 20, "generations": 10}
    of_models = drawpoint.nsga2([first, second], [0, 0], [1, 1], **options)
    of_means = drawpoint.nsga2(
        lambda X: np.c_[first.predict(X), second.predict(X)], [0, 0], [1, 1], vectorized=True, **options
    )
    assert (of_models.X == of_means.X).all() and (of_models.Y == of_means.Y).all()


def breaks(X):
    raise ZeroDivisionError("in the function")


@pytest.mark.parametrize(
    "call, error, message",
    [
        (lambda: drawpoint.nsga2(breaks, [0], [1], vectorized=True), ZeroDivisionError, "in the function"),
        (lambda: drawpoint.nsga2(lambda X: X[:3], [0], [1], vectorized=True), ValueError, "given 200 points and returned"),
        (lambda: drawpoint.nsga2(lambda x: 1.0, [0], [1]), ValueError, "returned 1 values where the problem has 2"),
        (lambda: drawpoint.nsga2([], [0], [1]), ValueError, "0 models; allowed is 1 or more"),
        (lambda: drawpoint.nsga2("f", [0], [1]), ValueError, "'f' is not a function, nor a fitted Kriging"),
        (lambda: drawpoint.nsga2(breaks, [0], [1], population=1), ValueError, "population is 1; allowed is"),
        (lambda: drawpoint.front([1.0, 2.0]), ValueError, r"Y has the shape \(2,\)"),
        (lambda: drawpoint.front([[1.0, 2.0]], ["minimize"]), ValueError, "a sequence of 2, one each"),
        (lambda: drawpoint.front([[1.0]], ["at_most"]), ValueError, 'goal is "at_most"; allowed are minimize'),
        (lambda: drawpoint.front([[1.0, np.nan]]), ValueError, "the objectives Y hold NaN; leave out failed runs"),
        (lambda: drawpoint.hypervolume([[1.0, 2.0]], [1.0]), ValueError, "pareto::hypervolume: points has 2 columns"),
    ],
)
def test_faulty_calls_are_refused_in_words(call, error, message):
    with pytest.raises(error, match=message):
        call()


def test_models_of_other_inputs_are_refused():
    model = drawpoint.Kriging(deterministic=True).fit(drawpoint.halton(8, [0, 0], [1, 1]), np.arange(8.0))
    with pytest.raises(ValueError, match="a model of 2 variables is given a box of 1"):
        drawpoint.nsga2([model, model], [0], [1])
    with pytest.raises(ValueError, match="1 models for 2 responses"):
        drawpoint.nsga2([model], [0, 0], [1, 1])
