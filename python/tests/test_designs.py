# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
import itertools

import numpy as np
import pytest

import drawpoint

LOWER, UPPER = [-1.0, 10.0, 0.0], [1.0, 30.0, 5.0]
DESIGNS = [
    drawpoint.latin_hypercube,
    drawpoint.optimized_latin_hypercube,
    drawpoint.scrambled_sobol,
    drawpoint.halton,
    drawpoint.uniform_random,
]


def strata(X):
    return np.sort(np.floor((X - LOWER) / (np.array(UPPER) - LOWER) * len(X)), axis=0)


@pytest.mark.parametrize("design", DESIGNS)
def test_a_design_fills_its_box_and_follows_from_its_seed(design):
    X = design(20, LOWER, UPPER, seed=3)
    assert X.shape == (20, 3) and X.dtype == np.float64
    assert (X >= LOWER).all() and (X <= UPPER).all()
    assert (X == design(20, np.array(LOWER), np.array(UPPER), seed=3)).all()
    assert (X != design(20, LOWER, UPPER, seed=4)).any()


@pytest.mark.parametrize("design", DESIGNS[:3])
def test_every_stratum_has_one_run(design):
    assert (strata(design(16, LOWER, UPPER)) == np.arange(16.0)[:, None]).all()


def test_corners_come_first_in_binary_order():
    for design in DESIGNS[:2]:
        X = design(12, LOWER, UPPER, corners=True)
        assert (X[:8] == list(itertools.product(*zip(LOWER, UPPER)))).all()
        assert (strata(X[8:]) == np.arange(4.0)[:, None]).all()


def test_the_plain_halton_points_are_known():
    X = drawpoint.halton(4, [0, 0], [1, 1], scrambled=False)
    assert X == pytest.approx(np.array([[1 / 2, 1 / 3], [1 / 4, 2 / 3], [3 / 4, 1 / 9], [1 / 8, 4 / 9]]))


def test_whole_numbers_and_levels_are_balanced():
    X = drawpoint.latin_hypercube(12, [1, 0], [4, 2], kinds=["integer", ["dry", "wet", "frozen"]])
    assert (np.bincount(X[:, 0].astype(int)) == [0, 3, 3, 3, 3]).all()
    assert (np.bincount(X[:, 1].astype(int)) == [4, 4, 4]).all()


@pytest.mark.parametrize(
    "arguments, options, message",
    [
        ((0, [0], [1]), {}, "doe::latin_hypercube: runs is 0"),
        ((3, [2.0], [1.0]), {"names": ["lip_angle"]}, 'variable "lip_angle": lower bound 2 is not below upper bound 1; swap them'),
        ((3, [0, 0], [1, 1]), {"corners": True}, "fewer than the 2\\^2 corner points"),
        ((3, [0, 0], [1]), {}, r"lower has the shape \(2,\) and upper \(1,\)"),
        ((3, [0], [np.inf]), {}, "upper bound inf is not finite"),
        ((3, [0], [1]), {"names": ["a", "b"]}, "allowed is a sequence of 1, one each"),
        ((3, [0], [1]), {"kinds": ["whole"]}, "allowed are real, integer"),
        ((3, [0], [2]), {"kinds": [["dry", "wet"]]}, "indices of levels, so give 0 and 1"),
    ],
)
def test_a_faulty_box_is_refused_in_words(arguments, options, message):
    with pytest.raises(ValueError, match=message):
        drawpoint.latin_hypercube(*arguments, **options)


def test_an_unknown_criterion_is_refused():
    with pytest.raises(ValueError, match='criterion is "even"; allowed are maximin, phi_p, centred_discrepancy'):
        drawpoint.optimized_latin_hypercube(5, [0], [1], criterion="even")
