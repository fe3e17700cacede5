# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
"""Designs, Kriging models, optimisation and fronts of expensive functions.

    X = drawpoint.optimized_latin_hypercube(40, lower, upper)    # where to run
    model = drawpoint.Kriging().fit(X, y)                        # what the runs say
    mean, std = model.predict(X_new, return_std=True)
    found = drawpoint.optimize(function, lower, upper, 60)       # or all of it in one call

Arrays have one point per row, in natural units. Arrays of float64 in Fortran order are predicted where they lie;
others, and whatever a fit keeps, are copied once; results are not copied. Long work releases the GIL; functions are called with it
held. A faulty argument raises ValueError with the library's message.

A study's folder, its runs and models, is read by the package drawpoint_reader, which is pure Python.
"""

from ._problem import Goal, Kind
from .designs import halton, latin_hypercube, optimized_latin_hypercube, scrambled_sobol, uniform_random
from .fronts import Front, front, fronts, hypervolume, hypervolume_contributions, nsga2
from .kriging import Choice, FitWarning, Kriging, Standing, Validation, choose_kriging
from .optimum import Optimum, Points, RunWarning, Runs, optimize
from .sensitivity import (
    ElementaryEffects,
    Estimates,
    MainEffect,
    SobolIndices,
    main_effects,
    morris_screening,
    sobol_indices,
)

__all__ = [
    "Choice",
    "ElementaryEffects",
    "Estimates",
    "FitWarning",
    "Front",
    "Goal",
    "Kind",
    "Kriging",
    "MainEffect",
    "Optimum",
    "Points",
    "RunWarning",
    "Runs",
    "SobolIndices",
    "Standing",
    "Validation",
    "choose_kriging",
    "front",
    "fronts",
    "halton",
    "hypervolume",
    "hypervolume_contributions",
    "latin_hypercube",
    "main_effects",
    "morris_screening",
    "nsga2",
    "optimize",
    "optimized_latin_hypercube",
    "scrambled_sobol",
    "sobol_indices",
    "uniform_random",
]
