// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// How good a front is: distances to a reference front, and how evenly its points are spread.
///
/// Y: n x m, the front; Z: k x m, the reference front; every objective minimised. With d(z, Y) the distance
/// of z to its nearest point of Y:
/// * igd = mean over z of d, Euclidean (Coello, Reyes Sierra 2004; the mean as most programs take it);
/// * igd_plus = the same with max(y - z, 0) in the place of y - z: only what is worse counts, so that it
/// never
///   prefers a front that another one dominates (Ishibuchi, Masuda, Tanigaki, Nojima 2015);
/// * additive_epsilon = max_z min_y max_j (y_j - z_j): the least shift by which Y covers Z, negative when Y
/// is
///   better throughout; multiplicative_epsilon the same with y_j / z_j (Zitzler et al. 2003);
/// * spread: Deb's Δ = (d_f + d_l + Σ |d_i - d̄|)/(d_f + d_l + (n-1) d̄), two objectives, d_i the gaps between
///   neighbours and d_f, d_l those from the reference's extremes to the front's; 0 is even (Deb et al. 2002);
/// * moving_spread: gamultiobj's (μ + σ)/(μ + n d̄), d̄ and σ mean and standard deviation of the finite
///   crowding distances, μ the way that the extreme points went since the front before, summed over the
///   objectives; small and steady means settled.
/// Units: scale the objectives first where they differ. Cost O(n k m), no memory beyond the input.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include <drawpoint/doe/problem.hpp>
#include <drawpoint/pareto/crowding.hpp>

namespace drawpoint::pareto {

namespace detail {

inline void check_fronts(const std::string& place, const Eigen::MatrixXd& Y, const Eigen::MatrixXd& Z) {
  if (Y.rows() == 0 || Z.rows() == 0)
    throw std::invalid_argument(place + (Y.rows() == 0 ? "Y" : "Z") +
                                " has no rows; give at least one point");
  if (Y.cols() != Z.cols() || Y.cols() == 0)
    throw std::invalid_argument(place + "Y has " + std::to_string(Y.cols()) + " columns, Z has " +
                                std::to_string(Z.cols()) + "; both need one an objective");
  if (!Y.allFinite() || !Z.allFinite())
    throw std::invalid_argument(place + (Y.allFinite() ? "Z" : "Y") +
                                " holds NaN or infinity; leave out failed runs");
}

/// For each row z of Z: min over the rows y of Y of distance(y, z), both pointers to m numbers.
template <class Distance>
Eigen::VectorXd nearest(const Eigen::MatrixXd& Y, const Eigen::MatrixXd& Z, const Distance& distance) {
  const RowMajor y = Y, z = Z;
  Eigen::VectorXd result(z.rows());
  for (Eigen::Index i = 0; i < z.rows(); ++i) {
    double least = std::numeric_limits<double>::infinity();
    for (Eigen::Index k = 0; k < y.rows(); ++k)
      least = std::min(least, distance(y.data() + k * y.cols(), z.data() + i * z.cols()));
    result[i] = least;
  }
  return result;
}

/// Row of the least value in each objective; the first of equals.
inline std::vector<Eigen::Index> extreme_rows(const Eigen::MatrixXd& Y) {
  std::vector<Eigen::Index> rows(static_cast<std::size_t>(Y.cols()));
  for (std::size_t j = 0; j < rows.size(); ++j) Y.col(static_cast<Eigen::Index>(j)).minCoeff(&rows[j]);
  return rows;
}

}  // namespace detail

/// Inverted generational distance. This and the next three throw std::invalid_argument when a front is empty,
/// the columns differ or a number is not finite.
inline double igd(const Eigen::MatrixXd& Y, const Eigen::MatrixXd& Z) {
  detail::check_fronts("pareto::igd: ", Y, Z);
  const auto square = [m = Y.cols()](const double* y, const double* z) {
    double sum = 0.0;
    for (Eigen::Index j = 0; j < m; ++j) sum += (y[j] - z[j]) * (y[j] - z[j]);
    return sum;
  };
  return detail::nearest(Y, Z, square).cwiseSqrt().mean();
}

inline double igd_plus(const Eigen::MatrixXd& Y, const Eigen::MatrixXd& Z) {
  detail::check_fronts("pareto::igd_plus: ", Y, Z);
  const auto square = [m = Y.cols()](const double* y, const double* z) {
    double sum = 0.0;
    for (Eigen::Index j = 0; j < m; ++j) {
      const double worse = std::max(y[j] - z[j], 0.0);
      sum += worse * worse;
    }
    return sum;
  };
  return detail::nearest(Y, Z, square).cwiseSqrt().mean();
}

inline double additive_epsilon(const Eigen::MatrixXd& Y, const Eigen::MatrixXd& Z) {
  detail::check_fronts("pareto::additive_epsilon: ", Y, Z);
  const auto shift = [m = Y.cols()](const double* y, const double* z) {
    double most = y[0] - z[0];
    for (Eigen::Index j = 1; j < m; ++j) most = std::max(most, y[j] - z[j]);
    return most;
  };
  return detail::nearest(Y, Z, shift).maxCoeff();
}

/// Every value of both fronts must be positive.
inline double multiplicative_epsilon(const Eigen::MatrixXd& Y, const Eigen::MatrixXd& Z) {
  detail::check_fronts("pareto::multiplicative_epsilon: ", Y, Z);
  if (Y.minCoeff() <= 0.0 || Z.minCoeff() <= 0.0)
    throw std::invalid_argument(
        "pareto::multiplicative_epsilon: " + std::string(Y.minCoeff() <= 0.0 ? "Y" : "Z") + " holds " +
        doe::detail::number_text(std::min(Y.minCoeff(), Z.minCoeff())) +
        "; allowed is above 0; shift the objectives or use additive_epsilon");
  const auto factor = [m = Y.cols()](const double* y, const double* z) {
    double most = y[0] / z[0];
    for (Eigen::Index j = 1; j < m; ++j) most = std::max(most, y[j] / z[j]);
    return most;
  };
  return detail::nearest(Y, Z, factor).maxCoeff();
}

/// Deb's Δ. Y: n x 2, n >= 2, mutually non-dominated; Z: a front whose extremes are the ideal ones.
inline double spread(const Eigen::MatrixXd& Y, const Eigen::MatrixXd& Z) {
  const std::string place = "pareto::spread: ";
  detail::check_fronts(place, Y, Z);
  if (Y.cols() != 2 || Y.rows() < 2)
    throw std::invalid_argument(place + "Y is " + std::to_string(Y.rows()) + " x " +
                                std::to_string(Y.cols()) +
                                "; allowed is two objectives and two points or more; use crowding_distance "
                                "or moving_spread for others");
  const std::vector<int> order = detail::sorted_points(Y).order;
  const Eigen::Index n = Y.rows();
  Eigen::VectorXd gaps(n - 1);
  for (Eigen::Index i = 0; i + 1 < n; ++i) gaps[i] = (Y.row(order[i + 1]) - Y.row(order[i])).norm();
  const auto ideal = detail::extreme_rows(Z);
  const double ends =
      (Y.row(order.front()) - Z.row(ideal[0])).norm() + (Y.row(order.back()) - Z.row(ideal[1])).norm();
  const double mean = gaps.mean(), all = ends + static_cast<double>(n - 1) * mean;
  return all > 0.0 ? (ends + (gaps.array() - mean).abs().sum()) / all : 0.0;
}

/// Y: n x m, the front now; before: the front one generation ago.
inline double moving_spread(const Eigen::MatrixXd& Y, const Eigen::MatrixXd& before) {
  detail::check_fronts("pareto::moving_spread: ", Y, before);
  double sum = 0.0, squares = 0.0, count = 0.0, moved = 0.0;
  const Eigen::VectorXd distances = crowding_distance(Y);
  for (const double d : distances)
    if (std::isfinite(d)) sum += d, count += 1.0;
  const double mean = count > 0.0 ? sum / count : 0.0;
  for (const double d : distances)
    if (std::isfinite(d)) squares += (d - mean) * (d - mean);
  const double deviation = count > 0.0 ? std::sqrt(squares / count) : 0.0;
  const auto now = detail::extreme_rows(Y), then = detail::extreme_rows(before);
  for (std::size_t j = 0; j < now.size(); ++j) moved += (Y.row(now[j]) - before.row(then[j])).norm();
  const double all = moved + static_cast<double>(Y.rows()) * mean;
  return all > 0.0 ? (moved + deviation) / all : 0.0;
}

}  // namespace drawpoint::pareto
