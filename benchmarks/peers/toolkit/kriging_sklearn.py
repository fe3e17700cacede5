#!/usr/bin/python3
# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
"""scikit-learn's Gaussian process on one Kriging case: kriging_sklearn.py TRAIN.csv TEST.csv

Constant times squared exponential with a length scale an input, plus white noise; bounds as in the case: lengths 0.01 to
100, noise 1e-10 to 10 of the variance. One line of JSON for no restarts (its default) and one for five. Its
model has mean zero, so its own likelihood is another one; the lengths and the noise go to the common evaluator."""
import json
import sys
import time
import warnings

import numpy
import sklearn
from sklearn.gaussian_process import GaussianProcessRegressor
from sklearn.gaussian_process.kernels import RBF, ConstantKernel, WhiteKernel

REPEATS = 3


def least_seconds(call, repeats=REPEATS):
    times = []
    for _ in range(repeats):
        start = time.process_time()
        result = call()
        times.append(time.process_time() - start)
    return min(times), result


def fitted(X, y, restarts):
    kernel = ConstantKernel(1.0, (1e-3, 1e6)) * RBF([0.5] * X.shape[1], (0.01, 100.0)) + WhiteKernel(1e-3, (1e-10, 10.0))
    return GaussianProcessRegressor(kernel, alpha=0.0, n_restarts_optimizer=restarts, random_state=1).fit(X, y)


def row(train, test, restarts):
    X, X_test = train[:, :-1], test[:, :-1]
    mean, deviation = train[:, -1].mean(), train[:, -1].std(ddof=1)
    y = (train[:, -1] - mean) / deviation
    seconds, model = least_seconds(lambda: fitted(X, y, restarts), 1 if restarts else REPEATS)
    mean_seconds, prediction = least_seconds(lambda: model.predict(X_test))
    both_seconds, _ = least_seconds(lambda: model.predict(X_test, return_std=True))
    error = mean + deviation * prediction - test[:, -1]
    signal, noise = model.kernel_.k1, model.kernel_.k2
    return {"system": f"scikit-learn {sklearn.__version__}, {restarts} restarts", "cpu_s": seconds,
            "lengths": signal.k2.length_scale.tolist(), "nugget": noise.noise_level / signal.k1.constant_value,
            "nrmse": float(numpy.sqrt((error**2).mean()) / numpy.ptp(test[:, -1])),
            "mean_per_s": len(test) / mean_seconds, "variance_per_s": len(test) / both_seconds}


def main():
    warnings.simplefilter("ignore")  # it warns of lengths at their bounds, which are expected here
    train, test = (numpy.loadtxt(path, delimiter=",") for path in sys.argv[1:3])
    for restarts in (0, 5):
        print(json.dumps(row(train, test, restarts)))


if __name__ == "__main__":
    main()
