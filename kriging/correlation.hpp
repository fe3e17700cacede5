// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Correlations of two points a and b, with Δₖ = |aₖ − bₖ|. As products over the variables k:
///
///   gaussian           exp(−Σ θₖ Δₖ²)
///   power_exponential  exp(−Σ θₖ Δₖ^pₖ),  1 <= pₖ <= 2
///   matern32           Π (1 + √3 hₖ) exp(−√3 hₖ),              hₖ = √(2θₖ) Δₖ
///   matern52           Π (1 + √5 hₖ + 5/3 hₖ²) exp(−√5 hₖ)
///
/// The structure says how the factors cₖ of one variable each make the whole, whichever family they are of:
///
///   product    c = Π cₖ, a θ per variable
///   isotropic  the same with one θ, and one exponent, for all variables that are numbers; categories keep
///              their own. Of the Gaussian c depends on the distance |a − b| alone; Matérn's stay products
///   additive   c = Σ wₖcₖ, wₖ >= 0, Σ wₖ = 1: of sums of functions of one variable. Full factorials make
///              C singular: of the corners of a rectangle in two variables, those of its two diagonals sum
///              up to the same (docs/explanation/kriging.md)
///
/// A variable that is a category has Δ = 0 for one level and Δ = 2, the ends of a range, for two different
/// ones (detail/levels.hpp): with the Gaussian its factor is exp(−4θ) then, whichever levels they are.
///
/// Points are on the scale of [-1, 1] a variable, so that the θₖ of different variables compare. For the
/// Gaussian and Matérn's, θₖ = 1/(8 l²) where l is the length scale on [0, 1] of the usual forms
/// exp(−½ (Δ/l)²) and h = Δ/l. Differences are squared one by one; the expanded form |a|² + |b|² − 2a·b would
/// lose the digits of close points, on which a nearly singular matrix depends. Cost O(n² d).
///
/// Sources: Forrester, Sóbester, Keane 2008, "Engineering Design via Surrogate Modelling", section 2.4;
/// Roustant, Ginsbourger, Deville 2012, "DiceKriging, DiceOptim", table 1 (Matérn's as products); Durrande,
/// Ginsbourger, Roustant 2012, Annales de la Faculté des Sciences de Toulouse 21(3), "Additive covariance
/// kernels for high-dimensional Gaussian process modeling".

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include <drawpoint/kriging/detail/dense.hpp>
#include <drawpoint/kriging/detail/levels.hpp>
#include <drawpoint/kriging/detail/parallel.hpp>
#include <drawpoint/kriging/detail/simd.hpp>

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

/// How the factors of the variables make the whole.
enum class Structure { product, isotropic, additive };

inline std::string_view to_string(Structure structure) {
  switch (structure) {
    case Structure::product:
      return "product";
    case Structure::isotropic:
      return "isotropic";
    case Structure::additive:
      return "additive";
  }
  return "unknown";
}

struct CorrelationFunction {
  Correlation family = Correlation::gaussian;
  Eigen::VectorXd theta;     ///< d entries, those that are shared repeated
  Eigen::VectorXd exponent;  ///< pₖ of power_exponential, d entries; unused by the others
  /// Per variable 0 for a number, L for a category of L levels; empty: all are numbers.
  std::vector<int> levels = {};
  Structure structure = Structure::product;
  Eigen::VectorXd weight = {};  ///< wₖ of additive, d entries; unused by the others
};

namespace detail {

inline constexpr Index chunk_rows = 256;
/// Matérn's h beyond which exp(−h) is nothing, and h² must not overflow.
inline constexpr double farthest = 800.0;
/// Scaled distance beyond which nothing is correlated, and whose fifth power must not overflow.
inline constexpr double farthest_distance = 1e50;

/// Up to 256 numbers on the stack, taken two at a time; beside a last odd one stands a 0.
struct Chunk {
  using Two = Pair::Vector;
  Index count;
  alignas(16) double number[chunk_rows];

  explicit Chunk(Index size) : count(size) {
    if (size % 2 == 1) number[size] = 0.0;
  }
  double operator[](Index i) const { return number[i]; }
  Two two(Index i) const { return *reinterpret_cast<const Pair::Unaligned*>(number + i); }
  void set_two(Index i, const Two& value) { *reinterpret_cast<Pair::Unaligned*>(number + i) = value; }
};

/// f of all numbers, given two at a time.
template <class F>
Chunk mapped(const Chunk& x, const F& f) {
  Chunk y(x.count);
  for (Index i = 0; i < x.count; i += 2) y.set_two(i, f(x.two(i)));
  return y;
}

inline double dot(const Chunk& x, const Chunk& y) { return dot(x.number, y.number, x.count); }

/// xᵢyᵢ.
inline Chunk entry_products(const Chunk& x, const Chunk& y) {
  Chunk z(x.count);
  for (Index i = 0; i < x.count; i += 2) z.set_two(i, x.two(i) * y.two(i));
  return z;
}

/// Rows first..first+count of Z against one point.
struct Rows {
  const Eigen::MatrixXd& Z;
  Index first, count;
  const double* x;  // d numbers

  const double* column(Index k) const { return detail::column(Z, k) + first; }
};

/// Δ in variable k.
inline Chunk distances(const CorrelationFunction& f, const Rows& rows, Index k) {
  const double* z = rows.column(k);
  Chunk h(rows.count);
  if (is_category(f.levels, k))
    for (Index i = 0; i < rows.count; ++i) h.number[i] = z[i] == rows.x[k] ? 0.0 : level_distance;
  else
    for (Index i = 0; i < rows.count; ++i)
      h.number[i] = std::min(std::abs(z[i] - rows.x[k]), farthest_distance);
  return h;
}

inline double matern_rate(Correlation family, double theta) {
  return std::sqrt((family == Correlation::matern32 ? 6.0 : 10.0) * theta);
}

/// θ h^p.
inline Chunk scaled_powers(const Chunk& h, double theta, double exponent) {
  Chunk y(h.count);
  for (Index i = 0; i < h.count; ++i) y.number[i] = theta * std::pow(h.number[i], exponent);
  return y;
}

/// Matérn's in variable k at the distances h: c = factor · exp(logarithm).
inline void multiply_matern(const CorrelationFunction& f, Index k, const Chunk& h, Chunk& factor,
                            Chunk& logarithm) {
  using Two = Chunk::Two;
  const double rate = matern_rate(f.family, f.theta[k]);
  const Two most = Two{} + farthest;
  for (Index i = 0; i < h.count; i += 2) {
    Two u = rate * h.two(i);
    u = u > most ? most : u;
    logarithm.set_two(i, logarithm.two(i) - u);
    const Two polynomial = f.family == Correlation::matern32 ? 1.0 + u : 1.0 + u + u * u / 3.0;
    factor.set_two(i, factor.two(i) * polynomial);
  }
}

/// out[i] = c(row first + i of Z, x) of power_exponential or Matérn, for at most chunk_rows rows.
inline void correlate_chunk(const CorrelationFunction& f, const Rows& rows, double* out) {
  Chunk factor(rows.count), logarithm(rows.count);
  std::fill_n(factor.number, rows.count, 1.0);
  std::fill_n(logarithm.number, rows.count, 0.0);
  for (Index k = 0; k < rows.Z.cols(); ++k) {
    const Chunk h = distances(f, rows, k);
    if (f.family == Correlation::power_exponential)
      add_scaled(logarithm.number, -1.0, scaled_powers(h, f.theta[k], f.exponent[k]).number, rows.count);
    else
      multiply_matern(f, k, h, factor, logarithm);
  }
  exp_in_place(logarithm.number, rows.count);
  for (Index i = 0; i < rows.count; ++i) out[i] = logarithm.number[i] * factor.number[i];
}

/// out[i] = c(row first + i of Z, x) for i < count, where no variable is a category.
inline void correlate_numbers(const CorrelationFunction& f, const Rows& all, double* out) {
  if (f.family == Correlation::gaussian)
    return gaussian_column(
        {all.Z.data() + all.first, all.Z.outerStride(), all.Z.cols(), f.theta.data(), all.x}, all.count, out);
  for (Eigen::Index i = 0; i < all.count; i += chunk_rows)
    correlate_chunk(f, {all.Z, all.first + i, std::min(chunk_rows, all.count - i), all.x}, out + i);
}

/// The factor of two different levels of variable k.
inline double between_levels(const CorrelationFunction& f, Index k) {
  CorrelationFunction one{f.family, Eigen::VectorXd::Constant(1, f.theta[k]), {}};
  if (f.family == Correlation::power_exponential) one.exponent.setConstant(1, f.exponent[k]);
  const Eigen::MatrixXd at = Eigen::MatrixXd::Constant(1, 1, level_distance);
  const double origin = 0.0;
  double factor = 0;
  correlate_numbers(one, {at, 0, 1, &origin}, &factor);
  return factor;
}

/// The same where some are: numbers as ever, with θ = 0 for the categories, whose factors follow.
inline void correlate_levels(const CorrelationFunction& f, const Rows& all, double* out) {
  CorrelationFunction numbers{f.family, f.theta, f.exponent};
  for (Index k = 0; k < all.Z.cols(); ++k)
    if (is_category(f.levels, k)) numbers.theta[k] = 0.0;
  correlate_numbers(numbers, all, out);
  for (Index k = 0; k < all.Z.cols(); ++k) {
    if (!is_category(f.levels, k)) continue;
    const double factor = between_levels(f, k), *z = all.column(k);
    for (Index i = 0; i < all.count; ++i) out[i] *= z[i] == all.x[k] ? 1.0 : factor;
  }
}

/// cₖ at the distances h in variable k.
inline Chunk correlations_in(const CorrelationFunction& f, Index k, const Chunk& h) {
  Chunk factor(h.count), logarithm(h.count);
  std::fill_n(factor.number, h.count, 1.0);
  std::fill_n(logarithm.number, h.count, 0.0);
  if (f.family == Correlation::gaussian)
    add_scaled(logarithm.number, -f.theta[k], entry_products(h, h).number, h.count);
  else if (f.family == Correlation::power_exponential)
    add_scaled(logarithm.number, -1.0, scaled_powers(h, f.theta[k], f.exponent[k]).number, h.count);
  else
    multiply_matern(f, k, h, factor, logarithm);
  exp_in_place(logarithm.number, h.count);
  return entry_products(logarithm, factor);
}

/// Σ wₖcₖ.
inline void correlate_sum(const CorrelationFunction& f, const Rows& all, double* out) {
  std::fill_n(out, all.count, 0.0);
  for (Index i = 0; i < all.count; i += chunk_rows) {
    const Rows rows{all.Z, all.first + i, std::min(chunk_rows, all.count - i), all.x};
    for (Index k = 0; k < all.Z.cols(); ++k) {
      if (f.weight[k] == 0.0) continue;
      add_scaled(out + i, f.weight[k], correlations_in(f, k, distances(f, rows, k)).number, rows.count);
    }
  }
}

/// out[i] = c(row first + i of Z, x) for i < count.
inline void correlate(const CorrelationFunction& f, const Rows& all, double* out) {
  if (f.structure == Structure::additive) return correlate_sum(f, all, out);
  f.levels.empty() ? correlate_numbers(f, all, out) : correlate_levels(f, all, out);
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

#include <drawpoint/kriging/detail/correlation_slopes.hpp>
