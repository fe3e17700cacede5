// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// How good a design is: distances, discrepancies, correlation.
///
/// All measures are taken in the unit box, u = (x - lower)/(upper - lower); U is n x d.
/// * minimum distance: min over pairs of |u_i - u_k|; larger is better (Johnson, Moore, Ylvisaker 1990).
/// * phi_p = (Σ_{i<k} |u_i - u_k|^-p)^(1/p); smaller is better; for p → ∞ 1/(minimum distance) (Morris,
/// Mitchell
///   1995).
/// * squared L2 discrepancies, the mean squared gap between the share of points and the volume of boxes:
/// centred
///   (boxes from the nearest corner), wrap-around (boxes on a torus) and star (boxes from the origin);
///   Hickernell 1998, "A generalized discrepancy and quadrature error bound"; Warnock 1972. They are the
///   *squared* values: those of SciPy's "CD" and "WD", and the square of its "L2-star".
/// * largest |correlation| of two variables.
/// Cost O(n² d) time for all but the correlation, O(n) memory beside the design.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <drawpoint/doe/detail/scaling.hpp>

namespace drawpoint::doe {

namespace detail {

/// Calls f(i, D) for i = 1..n-1, D_k = |u_i - u_k|² for k = 0..i-1.
template <class F>
void for_squared_distances(const Eigen::MatrixXd& U, const F& f) {
  Eigen::ArrayXd buffer(U.rows());
  for (Eigen::Index i = 1; i < U.rows(); ++i) {
    auto D = buffer.head(i);
    D.setZero();
    for (Eigen::Index j = 0; j < U.cols(); ++j) D += (U.col(j).head(i).array() - U(i, j)).square();
    f(i, D);
  }
}

/// Σ over pairs i > k of Π_j kernel(column j, u_ij)_k; the kernel takes an array and a number.
template <class Kernel>
double pair_sum(const Eigen::MatrixXd& U, const Kernel& kernel) {
  Eigen::ArrayXd buffer(U.rows());
  double sum = 0.0;
  for (Eigen::Index i = 1; i < U.rows(); ++i) {
    auto product = buffer.head(i);
    product.setOnes();
    for (Eigen::Index j = 0; j < U.cols(); ++j) product *= kernel(U.col(j).head(i).array(), U(i, j));
    sum += product.sum();
  }
  return sum;
}

inline void check_unit_design(const char* place, const Eigen::MatrixXd& U) {
  if (U.rows() < 1 || U.cols() < 1)
    throw std::invalid_argument(std::string(place) + ": the design is " + std::to_string(U.rows()) + " x " +
                                std::to_string(U.cols()) + "; allowed is 1 x 1 or more; give n x d points");
  if (!U.allFinite() || U.minCoeff() < -1e-9 || U.maxCoeff() > 1.0 + 1e-9)
    throw std::invalid_argument(std::string(place) + ": the points span " + number_text(U.minCoeff()) +
                                " to " + number_text(U.maxCoeff()) +
                                "; allowed is 0 to 1; scale them by the bounds, or call design_quality");
}

}  // namespace detail

/// Smallest Euclidean distance of two points of U (n x d, any box); infinite for one point.
inline double minimum_distance(const Eigen::MatrixXd& U) {
  double least = std::numeric_limits<double>::infinity();
  detail::for_squared_distances(U,
                                [&](Eigen::Index, const auto& D) { least = std::min(least, D.minCoeff()); });
  return std::sqrt(least);
}

/// (Σ d^-p)^(1/p), p > 0; infinite when two points coincide, 0 for one point. Summed in units of the smallest
/// distance, so that no p overflows.
inline double phi_p(const Eigen::MatrixXd& U, double p = 10.0) {
  if (!(p > 0.0))
    throw std::invalid_argument("doe::phi_p: p is " + detail::number_text(p) +
                                "; allowed is above 0; 10 to 50 is usual");
  const double least = minimum_distance(U);
  if (!(least > 0.0)) return std::numeric_limits<double>::infinity();
  double sum = 0.0;
  detail::for_squared_distances(
      U, [&](Eigen::Index, const auto& D) { sum += (D / (least * least)).pow(-0.5 * p).sum(); });
  return std::pow(sum, 1.0 / p) / least;
}

/// Centred L2 discrepancy, squared: with z = u - 1/2
/// (13/12)^d - 2/n Σ_i Π_j (1 + |z_ij|/2 - z_ij²/2) + 1/n² Σ_ik Π_j (1 + |z_ij|/2 + |z_kj|/2 - |z_ij -
/// z_kj|/2). U: n x d in the unit box, else std::invalid_argument.
inline double squared_centred_discrepancy(const Eigen::MatrixXd& U) {
  detail::check_unit_design("doe::squared_centred_discrepancy", U);
  const auto n = static_cast<double>(U.rows());
  const Eigen::ArrayXXd z = (U.array() - 0.5).abs();
  const double single = (1.0 + 0.5 * z - 0.5 * z.square()).rowwise().prod().sum();
  const double diagonal = (1.0 + z).rowwise().prod().sum();
  const double pairs = detail::pair_sum(U, [](const auto& column, double u) {
    return 1.0 + 0.5 * std::abs(u - 0.5) + 0.5 * (column - 0.5).abs() - 0.5 * (column - u).abs();
  });
  return std::pow(13.0 / 12.0, U.cols()) - 2.0 / n * single + (diagonal + 2.0 * pairs) / (n * n);
}

/// Wrap-around L2 discrepancy, squared: -(4/3)^d + 1/n² Σ_ik Π_j (3/2 - δ(1 - δ)), δ = |u_ij - u_kj|.
/// U: n x d in the unit box, else std::invalid_argument.
inline double squared_wrap_around_discrepancy(const Eigen::MatrixXd& U) {
  detail::check_unit_design("doe::squared_wrap_around_discrepancy", U);
  const auto n = static_cast<double>(U.rows());
  const double pairs = detail::pair_sum(
      U, [](const auto& column, double u) { return 1.5 - (column - u).abs() * (1.0 - (column - u).abs()); });
  return -std::pow(4.0 / 3.0, U.cols()) + (n * std::pow(1.5, U.cols()) + 2.0 * pairs) / (n * n);
}

/// Star L2 discrepancy, squared: 3^-d - 2^(1-d)/n Σ_i Π_j (1 - u_ij²) + 1/n² Σ_ik Π_j (1 - max(u_ij, u_kj)).
/// U: n x d in the unit box, else std::invalid_argument.
inline double squared_star_discrepancy(const Eigen::MatrixXd& U) {
  detail::check_unit_design("doe::squared_star_discrepancy", U);
  const auto n = static_cast<double>(U.rows());
  const auto d = static_cast<double>(U.cols());
  const double single = (1.0 - U.array().square()).rowwise().prod().sum();
  const double diagonal = (1.0 - U.array()).rowwise().prod().sum();
  const double pairs = detail::pair_sum(U, [](const auto& column, double u) { return 1.0 - column.max(u); });
  return std::pow(3.0, -d) - std::pow(2.0, 1.0 - d) / n * single + (diagonal + 2.0 * pairs) / (n * n);
}

/// Largest |Pearson correlation| of two columns of X (n x d, any box); a constant column counts as
/// uncorrelated.
inline double largest_correlation(const Eigen::MatrixXd& X) {
  Eigen::MatrixXd centred = X.rowwise() - X.row(0);  // exactly 0 in a constant column
  for (auto column : centred.colwise()) {
    if (const double size = column.cwiseAbs().maxCoeff(); size > 0.0)
      column /= size;  // no square leaves the range
    column.array() -= column.mean();
    if (const double norm = column.norm(); norm > 0.0) column /= norm;
  }
  double largest = 0.0;
  for (Eigen::Index j = 1; j < X.cols(); ++j)
    for (Eigen::Index k = 0; k < j; ++k)
      largest = std::max(largest, std::abs(centred.col(j).dot(centred.col(k))));
  return largest;
}

/// Every measure of one design. Distances and discrepancies are of the unit box.
struct DesignQuality {
  double minimum_distance = 0.0;
  double phi_p = 0.0;
  double squared_centred_discrepancy = 0.0;
  double squared_wrap_around_discrepancy = 0.0;
  double squared_star_discrepancy = 0.0;
  double largest_correlation = 0.0;
  bool latin = false;  ///< each of n equal strata of each real variable holds exactly one run
};

namespace detail {

/// Whether each of n strata of [0, 1] holds one of the n numbers; a number within 1e-9 strata of a border may
/// count on either side.
inline bool one_in_each_stratum(Eigen::VectorXd u) {
  u *= static_cast<double>(u.size());
  std::sort(u.begin(), u.end());
  for (Eigen::Index i = 0; i < u.size(); ++i)
    if (u[i] < static_cast<double>(i) - 1e-9 || u[i] > static_cast<double>(i + 1) + 1e-9) return false;
  return true;
}

}  // namespace detail

/// Measures of X (n x d, natural units) in the box of the problem. Throws std::invalid_argument when X does
/// not match the problem or leaves its bounds, or when p is not above 0.
inline DesignQuality design_quality(const Problem& problem, const Eigen::MatrixXd& X, double p = 10.0) {
  const Eigen::MatrixXd U = detail::to_unit_box(X, problem, "doe::design_quality");
  DesignQuality quality;
  quality.minimum_distance = minimum_distance(U);
  quality.phi_p = phi_p(U, p);
  quality.squared_centred_discrepancy = squared_centred_discrepancy(U);
  quality.squared_wrap_around_discrepancy = squared_wrap_around_discrepancy(U);
  quality.squared_star_discrepancy = squared_star_discrepancy(U);
  quality.largest_correlation = largest_correlation(U);
  quality.latin = true;
  for (Eigen::Index j = 0; j < U.cols(); ++j)
    if (problem.variables[static_cast<std::size_t>(j)].kind == VariableKind::real)
      quality.latin = quality.latin && detail::one_in_each_stratum(U.col(j));
  return quality;
}

}  // namespace drawpoint::doe
