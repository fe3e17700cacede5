#!/usr/bin/python3
# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
"""The table of success_table for scikit-learn: success_peers.py FOLDER

FOLDER: what `success_table FOLDER` wrote. GaussianProcessClassifier (Laplace's approximation, logistic) with a constant times
Matern 5/2 of one length scale per input, two restarts, and random forests of 300 trees."""
import sys
import time
import warnings
from pathlib import Path

import numpy
from sklearn.ensemble import RandomForestClassifier
from sklearn.gaussian_process import GaussianProcessClassifier
from sklearn.gaussian_process.kernels import ConstantKernel, Matern


def process(d):
    kernel = ConstantKernel(4.0, (1e-2, 1e4)) * Matern([1.0] * d, (0.05, 50.0), nu=2.5)
    return GaussianProcessClassifier(kernel, n_restarts_optimizer=2, random_state=1)


def forest(_):
    return RandomForestClassifier(300, random_state=1, n_jobs=1)


def chances(classifier, X, y, Z):
    if y.min() == y.max():  # neither takes one class alone
        return numpy.full(len(Z), 1.0 if y[0] else 0.0)
    return classifier.fit(X, y).predict_proba(Z)[:, 1]


def main(folder):
    warnings.simplefilter("ignore")
    names = sorted({f.stem.rsplit("_", 1)[0] for f in Path(folder).glob("*.csv")})
    print(f"{'region':13} {'way':8} {'log score':>9} {'wrong':>6} {'seconds':>7}")
    for name in names:
        for way, make in (("process", process), ("forest", forest)):
            log, wrong, seconds, files = 0.0, 0.0, 0.0, sorted(Path(folder).glob(f"{name}_*.csv"))
            for file in files:
                rows = numpy.loadtxt(file, delimiter=",")
                runs, places = rows[abs(rows[:, -1]) == 2], rows[abs(rows[:, -1]) != 2]
                start, q = time.perf_counter(), places[:, -1]
                P = chances(make(rows.shape[1] - 1), runs[:, :-1], runs[:, -1] > 0, places[:, :-1])
                seconds += time.perf_counter() - start
                p = P.clip(1e-9, 1 - 1e-9)
                log += (q * numpy.log(p) + (1 - q) * numpy.log(1 - p)).mean()
                wrong += numpy.where(P >= 0.5, 1 - q, q).mean()
            n = len(files)
            print(f"{name:13} {way:8} {log / n:9.3f} {wrong / n:6.3f} {seconds / n:7.3f}", flush=True)


if len(sys.argv) != 2:
    sys.exit(__doc__)
main(sys.argv[1])
