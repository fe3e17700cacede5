// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Mean of a fitted model in the browser, so that the sliders need no table of prepared slices:
//   z(x) = constant + sum_t beta_t s_a s_b + sum_i w_i prod_k c_k(|s_k - X_ik|),   s = (x - centre) factor.
// Of a category s is the index of its level, the nearest one between them, and two different levels are 2
// apart. It is z itself, or of a model on another scale what noisy runs at z have in the mean: a sum over
// points of noise.

/// By family: the factors of one variable, from its theta, its exponent and the distance.
export const correlations = {
  gaussian: (theta, _, h) => Math.exp(-theta * h * h),
  power_exponential: (theta, p, h) => Math.exp(-theta * h ** p),
  matern32: (theta, _, h) => {
    const u = Math.sqrt(6 * theta) * h;
    return (1 + u) * Math.exp(-u);
  },
  matern52: (theta, _, h) => {
    const u = Math.sqrt(10 * theta) * h;
    return (1 + u + (u * u) / 3) * Math.exp(-u);
  },
};

/// By scale: the response at z.
const responses = {
  linear: (z) => z,
  square_root: (z, {lower}) => lower + Math.max(z, 0) ** 2,
  logarithm: (z, {lower, offset}) => lower - offset + Math.exp(z),
  logit: (z, {lower, upper, offset, upper_offset: above}) =>
    lower - offset + (upper - lower + offset + above) / (1 + Math.exp(-z)),
};

export function predictor(surface) {
  const z = scaledMean(surface),
    mean = meanResponse(surface);
  return (x) => mean(z(x));
}

/// What noisy runs at z have in the mean.
export function meanResponse(surface) {
  const {scale, noise, noise_weights: shares} = surface,
    response = responses[scale];
  if (scale === 'linear') return (z) => z;
  return (z) => noise.reduce((sum, e, k) => sum + shares[k] * response(z + e, surface), 0);
}

/// Of variable k, between a scaled place and that of a run.
export const distanceIn = (levels, k, a, b) => (levels[k] ? (Math.round(a) === b ? 0 : 2) : Math.abs(a - b));

export function scaledMean({
  centre,
  factor,
  correlation,
  theta,
  exponent,
  levels = [],
  X,
  weights,
  terms,
  coefficients,
  constant,
}) {
  const c = correlations[correlation];
  const d = centre.length;
  return (x) => {
    const s = x.map((value, k) => (value - centre[k]) * factor[k]);
    let mean = constant;
    terms.forEach(([a, b], t) => {
      mean += coefficients[t] * (a < 0 ? 1 : s[a]) * (b < 0 ? 1 : s[b]);
    });
    for (let i = 0; i < weights.length; ++i) {
      let product = 1;
      for (let k = 0; k < d; ++k) product *= c(theta[k], exponent[k], distanceIn(levels, k, s[k], X[i][k]));
      mean += weights[i] * product;
    }
    return mean;
  };
}
