// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Correlations of two points a and b, products over the variables k, with Δₖ = |aₖ − bₖ|:
///
///   gaussian           exp(−Σ θₖ Δₖ²)
///   power_exponential  exp(−Σ θₖ Δₖ^pₖ),  1 <= pₖ <= 2
///   matern32           Π (1 + √3 hₖ) exp(−√3 hₖ),              hₖ = √(2θₖ) Δₖ
///   matern52           Π (1 + √5 hₖ + 5/3 hₖ²) exp(−√5 hₖ)
///
/// Points are on the scale of [-1, 1] a variable, so that the θₖ of different variables compare. For the
/// Gaussian and Matérn's, θₖ = 1/(8 l²) where l is the length scale on [0, 1] of the usual forms
/// exp(−½ (Δ/l)²) and h = Δ/l. Differences are squared one by one; the expanded form |a|² + |b|² − 2a·b would
/// lose the digits of close points, on which a nearly singular matrix depends. Cost O(n² d).
///
/// Sources: Forrester, Sóbester, Keane 2008, "Engineering Design via Surrogate Modelling", section 2.4;
/// Roustant, Ginsbourger, Deville 2012, "DiceKriging, DiceOptim", table 1 (Matérn's as products).

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include <drawpoint/kriging/parallel.hpp>
#include <drawpoint/kriging/simd.hpp>

namespace drawpoint::kriging {

enum class Correlation { gaussian, power_exponential, matern32, matern52 };

inline std::string_view to_string(Correlation family) {
  switch (family) {
    case Correlation::gaussian:
      return "gaussian";
    case Correlation::power_exponential:
      return "power_exponential";
    case Correlation::matern32:
      return "matern32";
    case Correlation::matern52:
      return "matern52";
  }
  return "unknown";
}

struct CorrelationFunction {
  Correlation family = Correlation::gaussian;
  Eigen::VectorXd theta;     ///< d entries
  Eigen::VectorXd exponent;  ///< pₖ of power_exponential, d entries; unused by the others
};

namespace detail {

inline constexpr Eigen::Index chunk_rows = 256;
/// Matérn's h beyond which exp(−h) is nothing, and h² must not overflow.
inline constexpr double farthest = 800.0;
/// Up to 256 numbers on the stack.
using Chunk = Eigen::Array<double, Eigen::Dynamic, 1, 0, chunk_rows, 1>;

/// Rows first..first+count of Z against one point.
struct Rows {
  const Eigen::MatrixXd& Z;
  Eigen::Index first, count;
  const double* x;  // d numbers

  Chunk distance(Eigen::Index k) const { return (Z.col(k).segment(first, count).array() - x[k]).abs(); }
};

inline double matern_rate(Correlation family, double theta) {
  return std::sqrt((family == Correlation::matern32 ? 6.0 : 10.0) * theta);
}

inline void correlate_chunk(const CorrelationFunction& f, const Rows& rows, double* out) {
  Eigen::Map<Eigen::ArrayXd> c(out, rows.count);
  Chunk factor = Chunk::Ones(rows.count);
  c.setZero();
  for (Eigen::Index k = 0; k < rows.Z.cols(); ++k) {
    Chunk h = rows.distance(k);
    if (f.family == Correlation::power_exponential) {
      c -= f.theta[k] * h.pow(f.exponent[k]);
      continue;
    }
    h = (matern_rate(f.family, f.theta[k]) * h).min(farthest);
    c -= h;
    if (f.family == Correlation::matern32)
      factor *= 1.0 + h;
    else
      factor *= 1.0 + h + h.square() / 3.0;
  }
  exp_in_place(out, rows.count);
  c *= factor;
}

/// out[i] = c(row first + i of Z, x) for i < count.
inline void correlate(const CorrelationFunction& f, const Rows& all, double* out) {
  if (f.family == Correlation::gaussian)
    return gaussian_column(
        {all.Z.data() + all.first, all.Z.outerStride(), all.Z.cols(), f.theta.data(), all.x}, all.count, out);
  for (Eigen::Index i = 0; i < all.count; i += chunk_rows)
    correlate_chunk(f, {all.Z, all.first + i, std::min(chunk_rows, all.count - i), all.x}, out + i);
}

/// ∂ln c/∂(ln θₖ) from the distances h in variable k.
inline Chunk slope_in_theta(const CorrelationFunction& f, Eigen::Index k, const Chunk& h) {
  const double theta = f.theta[k];
  if (f.family == Correlation::gaussian) return -theta * h.square();
  if (f.family == Correlation::power_exponential) return -theta * h.pow(f.exponent[k]);
  const Chunk u = matern_rate(f.family, theta) * h;
  if (f.family == Correlation::matern32) return -0.5 * u.square() / (1.0 + u);
  return -u.square() * (1.0 + u) / (6.0 + 6.0 * u + 2.0 * u.square());
}

/// ∂²ln c/∂(ln θₖ)².
inline Chunk curvature_in_theta(const CorrelationFunction& f, Eigen::Index k, const Chunk& h) {
  if (f.family == Correlation::gaussian || f.family == Correlation::power_exponential)
    return slope_in_theta(f, k, h);
  const Chunk u = matern_rate(f.family, f.theta[k]) * h;
  if (f.family == Correlation::matern32) return -0.25 * u.square() * (2.0 + u) / (1.0 + u).square();
  const Chunk bottom = 6.0 + 6.0 * u + 2.0 * u.square();
  return -0.5 * u.square() * ((2.0 + 3.0 * u) * bottom - u * (1.0 + u) * (6.0 + 4.0 * u)) / bottom.square();
}

/// ∂ln c/∂pₖ = −θ Δ^p ln Δ, 0 where Δ = 0.
inline Chunk slope_in_exponent(const CorrelationFunction& f, Eigen::Index k, const Chunk& h) {
  const Chunk logarithm = (h > 0.0).select(h.max(1e-300).log(), 0.0);
  return slope_in_theta(f, k, h) * logarithm;
}

/// dln c/dxₖ at the point x for one run at a signed distance of `step` = xₖ − runₖ. Simplification: the
/// power_exponential with p = 1 has a kink at a run; 0 is given there.
inline double slope_in_place(const CorrelationFunction& f, Eigen::Index k, double step) {
  const double theta = f.theta[k], h = std::abs(step), sign = step < 0 ? -1.0 : 1.0;
  if (f.family == Correlation::gaussian) return -2.0 * theta * step;
  if (h == 0.0) return 0.0;
  if (f.family == Correlation::power_exponential)
    return -sign * theta * f.exponent[k] * std::pow(h, f.exponent[k] - 1.0);
  const double rate = matern_rate(f.family, theta), u = std::min(rate * h, 1e100);
  if (f.family == Correlation::matern32) return -sign * rate * u / (1.0 + u);
  return -sign * rate * u * (1.0 + u) / (3.0 + 3.0 * u + u * u);
}

}  // namespace detail

/// Fills the lower triangle, diagonal included, of C: n x n, with the correlations of the rows of X: n x d.
inline void fill_correlation(const Eigen::MatrixXd& X, const CorrelationFunction& f, Eigen::MatrixXd& C,
                             int threads = 1) {
  constexpr Eigen::Index columns = 64;
  const Eigen::Index n = X.rows();
  const Eigen::MatrixXd points = X.transpose();
  C.resize(n, n);
  if (n < 500) threads = 1;
  detail::for_each_task(static_cast<int>((n + columns - 1) / columns), threads, [&](int t) {
    for (Eigen::Index j = t * columns; j < std::min(n, (t + 1) * columns); ++j)
      detail::correlate(f, {X, j, n - j, points.data() + j * X.cols()}, &C(j, j));
  });
}

/// The same for the Gaussian.
inline void fill_correlation(const Eigen::MatrixXd& X, const Eigen::VectorXd& theta, Eigen::MatrixXd& C) {
  fill_correlation(X, CorrelationFunction{Correlation::gaussian, theta, {}}, C);
}

/// Correlations of the rows of X: n x d with the rows of Z: m x d, as an n x m matrix.
inline Eigen::MatrixXd cross_correlation(const Eigen::MatrixXd& X, const Eigen::MatrixXd& Z,
                                         const CorrelationFunction& f) {
  Eigen::MatrixXd C(X.rows(), Z.rows());
  const Eigen::MatrixXd points = Z.transpose();
  if (X.rows() == 0) return C;
  for (Eigen::Index j = 0; j < Z.rows(); ++j)
    detail::correlate(f, {X, 0, X.rows(), points.data() + j * X.cols()}, &C(0, j));
  return C;
}

/// The same for the Gaussian.
inline Eigen::MatrixXd cross_correlation(const Eigen::MatrixXd& X, const Eigen::MatrixXd& Z,
                                         const Eigen::VectorXd& theta) {
  return cross_correlation(X, Z, CorrelationFunction{Correlation::gaussian, theta, {}});
}

}  // namespace drawpoint::kriging
