// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Mean of a fitted model in the browser, so that the sliders need no table of prepared slices:
//   mean(x) = trend + sum_i w_i exp(-sum_k theta_k (s_k(x) - X_ik)^2),   s_k scales the box to [-1, 1].

export function predictor(surface) {
  const {lower, upper, theta, trend, weights, X} = surface;
  const d = theta.length;
  return (x) => {
    const s = x.map((value, k) => (2 * (value - lower[k])) / (upper[k] - lower[k]) - 1);
    let mean = trend;
    for (let i = 0; i < weights.length; ++i) {
      let distance = 0;
      for (let k = 0; k < d; ++k) distance += theta[k] * (s[k] - X[i][k]) ** 2;
      mean += weights[i] * Math.exp(-distance);
    }
    return mean;
  };
}

export const steps = (lower, upper, count) =>
  Array.from({length: count}, (_, i) => lower + ((upper - lower) * i) / (count - 1));
