# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
"""Designs: where to run. Each gives an array of (runs, d), natural units, and the same one for the same seed.

All take the box as `lower` and `upper`, (d,) each, and optionally `names`, for messages, and `kinds` of the variables
(drawpoint.Kind). All raise ValueError for a faulty box and for fewer than one run.
"""

from __future__ import annotations

from typing import Optional, Sequence

import numpy as np
import numpy.typing as npt

from . import _core
from ._problem import Kind, design_box

Array = npt.NDArray[np.float64]


def latin_hypercube(
    runs: int,
    lower: npt.ArrayLike,
    upper: npt.ArrayLike,
    *,
    seed: int = 1,
    corners: bool = False,
    centred: bool = False,
    names: Optional[Sequence[str]] = None,
    kinds: Optional[Sequence[Kind]] = None,
) -> Array:
    """A random Latin hypercube: in every variable each of `runs` equal strata holds one run.

    corners: the 2^d corners of the box come first and count in `runs`. centred: runs in the middle of their strata.
    Raises ValueError also for fewer runs than corners.
    """
    return _core.latin_hypercube(design_box(lower, upper, names, kinds), runs, seed, corners, centred)


def optimized_latin_hypercube(
    runs: int,
    lower: npt.ArrayLike,
    upper: npt.ArrayLike,
    *,
    seed: int = 1,
    corners: bool = False,
    centred: bool = True,
    criterion: str = "maximin",
    sweeps: Optional[int] = None,
    names: Optional[Sequence[str]] = None,
    kinds: Optional[Sequence[Kind]] = None,
) -> Array:
    """A Latin hypercube chosen for how evenly it fills the box: the design to begin with.

    criterion: "maximin", "phi_p" or "centred_discrepancy". sweeps: the budget of the search, 0 or more; None: by size,
    below a second up to 5000 numbers. Raises ValueError as latin_hypercube, and for other criteria.
    """
    return _core.optimized_latin_hypercube(
        design_box(lower, upper, names, kinds), runs, seed, corners, centred, criterion, sweeps
    )


def scrambled_sobol(
    runs: int,
    lower: npt.ArrayLike,
    upper: npt.ArrayLike,
    *,
    seed: int = 1,
    names: Optional[Sequence[str]] = None,
    kinds: Optional[Sequence[Kind]] = None,
) -> Array:
    """Sobol' points with Owen's scrambling, up to 1111 variables. Best with a power of 2; longer ones go on."""
    return _core.scrambled_sobol(design_box(lower, upper, names, kinds), runs, seed)


def halton(
    runs: int,
    lower: npt.ArrayLike,
    upper: npt.ArrayLike,
    *,
    seed: int = 1,
    scrambled: bool = True,
    names: Optional[Sequence[str]] = None,
    kinds: Optional[Sequence[Kind]] = None,
) -> Array:
    """Halton points. scrambled=False: the plain sequence, which ignores the seed and starts behind the origin."""
    return _core.halton(design_box(lower, upper, names, kinds), runs, seed, scrambled)


def uniform_random(
    runs: int,
    lower: npt.ArrayLike,
    upper: npt.ArrayLike,
    *,
    seed: int = 1,
    names: Optional[Sequence[str]] = None,
    kinds: Optional[Sequence[Kind]] = None,
) -> Array:
    """Independent uniform points, for runs that validate a model."""
    return _core.uniform_random(design_box(lower, upper, names, kinds), runs, seed)
