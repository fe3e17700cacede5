#!/usr/bin/python3
# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
"""The table of fit_quality for scikit-learn and OpenTURNS: fit_quality_peers.py FOLDER [sklearn] [isotropic] [openturns] [linear]

FOLDER: what `fit_quality --write FOLDER` wrote. scikit-learn: constant times squared exponential plus white noise, no
restarts (its default) and five; isotropic the same with one length for all inputs, where asked for. OpenTURNS: squared exponential, constant trend or a linear one, the best of nine nuggets by its own
likelihood, since it does not estimate one. Medians over the seeds; columns as in fit_quality, but the
noise is in the unit of the response."""
import itertools
import re
import sys
import time
import warnings
from pathlib import Path

import numpy

PERCENT = {50: 0.6744898, 80: 1.2815516, 95: 1.9599640}


def sklearn_fits(isotropic=False):
    from sklearn.gaussian_process import GaussianProcessRegressor
    from sklearn.gaussian_process.kernels import RBF, ConstantKernel, WhiteKernel

    def predict(restarts, X, y, Z):
        kernel = ConstantKernel(1.0, (1e-3, 1e6)) * RBF(0.5 if isotropic else [0.5] * X.shape[1], (0.01, 100.0)) + WhiteKernel(1e-3, (1e-10, 10.0))
        model = GaussianProcessRegressor(kernel, alpha=0.0, n_restarts_optimizer=restarts, random_state=1).fit(X, y)
        mean, deviation = model.predict(Z, return_std=True)
        return mean, deviation, numpy.sqrt(model.kernel_.k2.noise_level)

    name = "skl_iso" if isotropic else "sklearn"
    return {f"{name}{r}": lambda X, y, Z, r=r: predict(r, X, y, Z) for r in (0, 5)}


def openturns_fits(linear=False):
    import openturns
    openturns.Log.Show(openturns.Log.NONE)
    openturns.TBB.Disable()  # one thread
    sys.path.insert(0, str(Path(__file__).resolve().parent))
    from kriging_openturns import NUGGETS, fitted
    trend = openturns.LinearBasisFactory if linear else openturns.ConstantBasisFactory

    def predict(X, y, Z):
        sample, response, points = openturns.Sample(X), openturns.Sample(y[:, None]), openturns.Sample(Z)
        _, nugget, result = max((fitted(sample, response, n, trend) for n in NUGGETS), key=lambda fit: fit[0])
        noise = nugget * result.getCovarianceModel().getAmplitude()[0] ** 2
        mean = numpy.array(result.getMetaModel()(points))[:, 0]
        variance = numpy.maximum(numpy.array(result.getConditionalMarginalVariance(points)).ravel(), 0.0)
        return mean, numpy.sqrt(variance + noise), numpy.sqrt(noise)

    return {"ot_linear" if linear else "openturns": predict}


def measured(predict, stem):
    train, test = (numpy.loadtxt(f"{stem}-{part}.csv", delimiter=",") for part in ("train", "test"))
    X, Z, truth, observed = train[:, :-1], test[:, :-2], test[:, -2], test[:, -1]
    centre, scale = train[:, -1].mean(), train[:, -1].std(ddof=1)
    start = time.process_time()
    mean, deviation, noise = predict(X, (train[:, -1] - centre) / scale, Z)
    seconds = time.process_time() - start
    mean, deviation = centre + scale * mean, scale * deviation
    unit = numpy.ptp(truth) or 1.0
    latent = numpy.sqrt(numpy.maximum(deviation**2 - (scale * noise) ** 2, 0.0))
    latent_held = 100.0 * (abs(mean - truth) <= PERCENT[95] * latent).mean()
    held = [100.0 * (abs(mean - observed) <= z * deviation).mean() for z in PERCENT.values()]
    return [numpy.sqrt(((mean - truth) ** 2).mean()) / unit, latent_held, *held, scale * noise, seconds]


def main():
    folder, wanted = Path(sys.argv[1]), sys.argv[2:] or ["sklearn", "openturns", "linear"]
    warnings.simplefilter("ignore")  # of lengths at their bounds, which are expected here
    fits = {}
    for name in wanted:
        fits.update({"sklearn": sklearn_fits, "isotropic": lambda: sklearn_fits(True), "openturns": openturns_fits,
                     "linear": lambda: openturns_fits(True)}[name]())
    stems = sorted(str(path)[:-len("-train.csv")] for path in folder.glob("*-train.csv"))
    print(f"{'function':12} {'design':8} {'runs':>4} {'way':9} {'NRMSE':>9} {'worst':>9}  {'latent':>6} {'50 %':>5} {'80 %':>5} {'95 %':>5}"
          f"  {'noise':>9} {'CPU s':>7} {'not':>4}")
    for case, group in itertools.groupby(stems, key=lambda stem: re.sub(r"-\d+$", "", Path(stem).name)):
        group = list(group)
        for name, predict in fits.items():
            rows, failed = [], 0
            for stem in group:
                try:
                    rows.append(measured(predict, stem))
                except Exception:  # whatever a library throws is a fit that its user does not get
                    failed += 1
            median = numpy.median(rows, axis=0) if rows else [numpy.nan] * 7
            worst = max((row[0] for row in rows), default=numpy.nan)
            function, design, runs = case.split("-")
            print(f"{function:12} {design:8} {runs:>4} {name:9} {median[0]:9.5f} {worst:9.5f}  {median[1]:6.1f} {median[2]:5.1f}"
                  f" {median[3]:5.1f} {median[4]:5.1f}  {median[5]:9.4g} {median[6]:7.3f} {failed:4d}", flush=True)


if __name__ == "__main__":
    main()
