#!/usr/bin/python3
# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
"""OpenTURNS' Kriging on one case: kriging_openturns.py TRAIN.csv TEST.csv

Constant trend, squared exponential, lengths 0.01 to 100, its default search (TNC from one start). Before 1.23 the
nugget is not estimated, so there is one line of JSON for a nugget of 1e-8 and one for the best of nine nuggets by its
own likelihood, as a user would have to do it."""
import json
import sys
import time

import numpy
import openturns

NUGGETS = [10.0**k for k in range(-8, 1)]


def fitted(X, y, nugget, trend=openturns.ConstantBasisFactory):
    covariance = openturns.SquaredExponential([0.5] * X.getDimension())
    covariance.setNuggetFactor(nugget)
    algorithm = openturns.KrigingAlgorithm(X, y, covariance, trend(X.getDimension()).build())
    algorithm.setOptimizationBounds(openturns.Interval([0.01] * X.getDimension(), [100.0] * X.getDimension()))
    algorithm.run()
    likelihood = algorithm.getReducedLogLikelihoodFunction()
    result = algorithm.getResult()
    return likelihood(result.getCovarianceModel().getScale())[0], nugget, result


def timed(call):
    start = time.process_time()
    result = call()
    return time.process_time() - start, result


def row(name, train, test, nuggets):
    X, X_test = openturns.Sample(train[:, :-1]), openturns.Sample(test[:, :-1])
    mean, deviation = train[:, -1].mean(), train[:, -1].std(ddof=1)
    y = openturns.Sample(((train[:, -1] - mean) / deviation)[:, None])
    seconds, fits = min((timed(lambda: [fitted(X, y, nugget) for nugget in nuggets]) for _ in range(3)),
                        key=lambda pair: pair[0])
    _, nugget, result = max(fits, key=lambda fit: fit[0])
    model = result.getMetaModel()
    mean_seconds, prediction = min((timed(lambda: model(X_test)) for _ in range(3)), key=lambda pair: pair[0])
    variance_seconds = min(timed(lambda: result.getConditionalMarginalVariance(X_test))[0] for _ in range(3))
    error = mean + deviation * numpy.array(prediction)[:, 0] - test[:, -1]
    return {"system": f"OpenTURNS {openturns.__version__}, {name}", "cpu_s": seconds,
            "lengths": list(result.getCovarianceModel().getScale()), "nugget": nugget,
            "nrmse": float(numpy.sqrt((error**2).mean()) / numpy.ptp(test[:, -1])),
            "mean_per_s": len(test) / mean_seconds, "variance_per_s": len(test) / (mean_seconds + variance_seconds)}


def main():
    openturns.Log.Show(openturns.Log.NONE)
    openturns.TBB.Disable()  # one thread
    train, test = (numpy.loadtxt(path, delimiter=",") for path in sys.argv[1:3])
    print(json.dumps(row("nugget 1e-8", train, test, NUGGETS[:1])))
    print(json.dumps(row("best of 9 nuggets", train, test, NUGGETS)))


if __name__ == "__main__":
    main()
