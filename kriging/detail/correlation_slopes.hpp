// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Derivatives of the factors cₖ of one variable each (correlation.hpp), as those of ln cₖ, and of the sum
/// Σ wₖcₖ.
///
/// The weights are wₖ = exp(vₖ)/Σ exp(vⱼ). With t = ∂c/∂(ln θₗ) or ∂c/∂pₗ, and eₖ = ∂c/∂vₖ,
///   eₖ = wₖ(cₖ − c),  ∂eₖ/∂vₗ = δₖₗeₖ − wₗeₖ − wₖeₗ,  ∂t/∂vₖ = (δₖₗ − wₖ)t

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <drawpoint/kriging/correlation.hpp>
#include <drawpoint/kriging/detail/dense.hpp>

namespace drawpoint::kriging::detail {

/// ∂ln c/∂(ln θₖ) from the distances h in variable k.
inline Chunk slope_in_theta(const CorrelationFunction& f, Index k, const Chunk& h) {
  using Two = Chunk::Two;
  const double theta = f.theta[k];
  if (f.family == Correlation::gaussian) return mapped(h, [=](const Two& x) { return -theta * x * x; });
  if (f.family == Correlation::power_exponential) return scaled_powers(h, -theta, f.exponent[k]);
  const double rate = matern_rate(f.family, theta);
  if (f.family == Correlation::matern32)
    return mapped(h, [=](const Two& x) { return -0.5 * rate * rate * x * x / (1.0 + rate * x); });
  return mapped(h, [=](const Two& x) {
    const Two u = rate * x;
    return -u * u * (1.0 + u) / (6.0 + 6.0 * u + 2.0 * u * u);
  });
}

/// ∂²ln c/∂(ln θₖ)².
inline Chunk curvature_in_theta(const CorrelationFunction& f, Index k, const Chunk& h) {
  using Two = Chunk::Two;
  if (f.family == Correlation::gaussian || f.family == Correlation::power_exponential)
    return slope_in_theta(f, k, h);
  const double rate = matern_rate(f.family, f.theta[k]);
  if (f.family == Correlation::matern32)
    return mapped(h, [=](const Two& x) {
      const Two u = rate * x;
      return -0.25 * u * u * (2.0 + u) / ((1.0 + u) * (1.0 + u));
    });
  return mapped(h, [=](const Two& x) {
    const Two u = rate * x, bottom = 6.0 + 6.0 * u + 2.0 * u * u;
    return -0.5 * u * u * ((2.0 + 3.0 * u) * bottom - u * (1.0 + u) * (6.0 + 4.0 * u)) / (bottom * bottom);
  });
}

/// ln h, 0 where h = 0.
inline Chunk logarithms(const Chunk& h) {
  Chunk y(h.count);
  for (Index i = 0; i < h.count; ++i) y.number[i] = h.number[i] > 0.0 ? std::log(h.number[i]) : 0.0;
  return y;
}

/// ∂ln c/∂pₖ = −θ Δ^p ln Δ, 0 where Δ = 0.
inline Chunk slope_in_exponent(const CorrelationFunction& f, Index k, const Chunk& h) {
  return entry_products(slope_in_theta(f, k, h), logarithms(h));
}

/// dln c/dxₖ at the point x for one run at a signed distance of `step` = xₖ − runₖ. Simplification: the
/// power_exponential with p = 1 has a kink at a run; 0 is given there. A category has no slope: 0.
inline double slope_in_place(const CorrelationFunction& f, Index k, double step) {
  if (is_category(f.levels, k)) return 0.0;
  const double theta = f.theta[k], h = std::abs(step), sign = step < 0 ? -1.0 : 1.0;
  if (f.family == Correlation::gaussian) return -2.0 * theta * step;
  if (h == 0.0) return 0.0;
  if (f.family == Correlation::power_exponential)
    return -sign * theta * f.exponent[k] * std::pow(h, f.exponent[k] - 1.0);
  const double rate = matern_rate(f.family, theta), u = std::min(rate * h, 1e100);
  if (f.family == Correlation::matern32) return -sign * rate * u / (1.0 + u);
  return -sign * rate * u * (1.0 + u) / (3.0 + 3.0 * u + u * u);
}

/// The term wₖcₖ of a sum of correlations, for rows against a point, and its derivatives.
struct Summand {
  const CorrelationFunction& f;
  Index k;
  Chunk h, part;  ///< Δ and wₖcₖ

  Summand(const CorrelationFunction& function, const Rows& rows, Index variable)
      : f(function), k(variable), h(distances(f, rows, k)), part(correlations_in(f, k, h)) {
    for (Index i = 0; i < part.count; ++i) part.number[i] *= f.weight[k];
  }

  Chunk slope_in_theta() const { return entry_products(part, detail::slope_in_theta(f, k, h)); }
  Chunk slope_in_exponent() const { return entry_products(part, detail::slope_in_exponent(f, k, h)); }
  /// `c`: the whole sum, one number a row.
  Chunk slope_in_weight(const double* c) const {
    Chunk slope(part.count);
    for (Index i = 0; i < part.count; ++i) slope.number[i] = part.number[i] - f.weight[k] * c[i];
    return slope;
  }
};

/// wₖcₖ of the rows of X: n x d, with the point z of d entries.
inline Eigen::VectorXd summands(const CorrelationFunction& f, Index k, const Eigen::MatrixXd& X,
                                const Eigen::VectorXd& z) {
  Eigen::VectorXd c(X.rows());
  for (Index i = 0; i < X.rows(); i += chunk_rows) {
    const Summand summand(f, {X, i, std::min(chunk_rows, X.rows() - i), z.data()}, k);
    std::copy_n(summand.part.number, summand.part.count, c.data() + i);
  }
  return c;
}

}  // namespace drawpoint::kriging::detail
