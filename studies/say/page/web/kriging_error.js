// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// How sure a fitted model is of its mean, in the browser: the variance of model/fits/surface_error.h, noise of
// single runs left out.

import {correlations, distanceIn, meanResponse, scaledMean} from './kriging.js';

const normal95 = 1.959963984540054;

/// By family: the derivative of ln c by ln theta, from theta, exponent and distance.
const slopes = {
  gaussian: (theta, _, h) => -theta * h * h,
  power_exponential: (theta, p, h) => -theta * h ** p,
  matern32: (theta, _, h) => {
    const u = Math.sqrt(6 * theta) * h;
    return -(u * u) / (2 * (1 + u));
  },
  matern52: (theta, _, h) => {
    const u = Math.sqrt(10 * theta) * h;
    return (-(u * u) * (1 + u)) / (6 * (1 + u + (u * u) / 3));
  },
};

/// (x) => the ends of the interval that holds the mean with 95 %, or null where the model does not know.
export function meanInterval(surface) {
  if (!surface.error) return null;
  const z = scaledMean(surface),
    back = meanResponse(surface),
    deviation = scaledDeviation(surface);
  return (x) => {
    const middle = z(x),
      half = normal95 * deviation(x);
    return [back(middle - half), back(middle + half)];
  };
}

/// (x) => the standard deviation of z, of surface.error and surface.other.
export function scaledDeviation(surface) {
  const own = scaledVariance(surface);
  if (!surface.other) return (x) => Math.sqrt(own(x));
  const {probability, surface: other} = surface.other,
    byOther = scaledVariance(other),
    z = scaledMean(surface),
    otherZ = scaledMean(other);
  return (x) => {
    const variance = own(x);
    return Math.sqrt(variance + probability * Math.max(0, byOther(x) + (otherZ(x) - z(x)) ** 2 - variance));
  };
}

/// (x) => the variance of z by one explanation of the runs. R is factored when it is asked for the first time.
function scaledVariance(surface) {
  const {centre, factor, X, terms, error} = surface;
  let L = null;
  return (x) => {
    L ??= cholesky(surface);
    const s = x.map((value, k) => (value - centre[k]) * factor[k]);
    const r = X.map((run) => correlation(surface, s, run)),
      f = terms.map(([a, b]) => (a < 0 ? 1 : s[a]) * (b < 0 ? 1 : s[b]));
    const rest = Math.max(1 - square(solved(L, r)) + square(trendPart(error, f, r)), 0);
    return error.process_variance * rest + square(parameterPart(surface, s, f, r));
  };
}

const square = (values) => values.reduce((sum, value) => sum + value * value, 0);

function correlation({correlation: family, theta, exponent, levels = []}, s, run) {
  const c = correlations[family];
  let product = 1;
  for (let k = 0; k < s.length; ++k) product *= c(theta[k], exponent[k], distanceIn(levels, k, s[k], run[k]));
  return product;
}

/// L with L Lᵀ = R, row by row.
function cholesky(surface) {
  const {X, error} = surface,
    L = [];
  X.forEach((run, i) => {
    const row = new Float64Array(i + 1);
    for (let j = 0; j <= i; ++j) {
      let sum = i === j ? 1 + error.noise[i] : correlation(surface, run, X[j]);
      const other = j < i ? L[j] : row;
      for (let k = 0; k < j; ++k) sum -= row[k] * other[k];
      row[j] = i === j ? Math.sqrt(sum) : sum / other[j];
    }
    L.push(row);
  });
  return L;
}

/// L⁻¹ r.
function solved(L, r) {
  const w = new Float64Array(r.length);
  for (let i = 0; i < r.length; ++i) {
    const row = L[i];
    let sum = r[i];
    for (let k = 0; k < i; ++k) sum -= row[k] * w[k];
    w[i] = sum / row[i];
  }
  return w;
}

/// f T⁻¹ − r B.
function trendPart({B, T}, f, r) {
  const v = [];
  f.forEach((value, j) => {
    v.push((value - v.reduce((sum, known, i) => sum + known * T[i][j], 0)) / T[j][j]);
  });
  return v.map((value, j) => value - r.reduce((sum, c, i) => sum + c * B[i][j], 0));
}

/// W: what the parameters leave unknown, by their directions.
function parameterPart({correlation: family, theta, exponent, levels = [], X, weights, error}, s, f, r) {
  const {theta_spread: byTheta, exponent_spread: byExponent, alpha_effects: alpha, beta_effects: beta} = error;
  const W = Array((byTheta[0] ?? []).length).fill(0);
  if (!W.length) return W;
  const add = (share, row) =>
    row.forEach((value, c) => {
      W[c] += share * value;
    });
  const inTheta = s.map(() => 0),
    inExponent = s.map(() => 0);
  X.forEach((run, i) =>
    s.forEach((at, k) => {
      const h = distanceIn(levels, k, at, run[k]),
        slope = weights[i] * r[i] * slopes[family](theta[k], exponent[k], h);
      inTheta[k] += slope;
      if (h > 0) inExponent[k] += slope * Math.log(h);
    }),
  );
  byTheta.forEach((row, k) => add(inTheta[k], row));
  byExponent.forEach((row, k) => add(inExponent[k], row));
  alpha.forEach((row, i) => add(r[i], row));
  beta.forEach((row, t) => add(f[t], row));
  return W;
}
