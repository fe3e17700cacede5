// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// How good a front is: distances from a reference front.
///
/// Y: n x m, the front; Z: k x m, the reference front. With d(z, Y) the distance of z to its nearest point of
/// Y, objectives minimised:
/// * igd = mean over z of d, Euclidean (Coello, Reyes Sierra 2004; the mean as most programs take it);
/// * igd_plus = the same with max(y - z, 0) in the place of y - z: only what is worse counts, so that it
///   never prefers a front that another one dominates (Ishibuchi, Masuda, Tanigaki, Nojima 2015);
/// * additive_epsilon = max_z min_y max_j (y_j - z_j): the least shift by which Y covers Z, negative when Y
///   is better throughout (Zitzler et al. 2003).
/// The forms with a problem take natural signs, the others minimise every column (minimised.hpp). Units:
/// scale the objectives first where they differ. Cost O(n k m), no memory beyond the input.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <drawpoint/pareto/dominance.hpp>

namespace drawpoint::pareto {

namespace detail {

inline void check_fronts(const std::string& place, const Eigen::MatrixXd& Y, const Eigen::MatrixXd& Z) {
  if (Y.rows() == 0 || Z.rows() == 0)
    throw std::invalid_argument(place + (Y.rows() == 0 ? "Y" : "Z") +
                                " has no rows; give at least one point");
  if (Y.cols() != Z.cols() || Y.cols() == 0)
    throw std::invalid_argument(place + "Y has " + std::to_string(Y.cols()) + " columns, Z has " +
                                std::to_string(Z.cols()) + "; both need one per objective");
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

/// A power of two of the size of the largest difference, so that no square leaves the range.
inline double unit_of(const Eigen::MatrixXd& Y, const Eigen::MatrixXd& Z) {
  const Eigen::RowVectorXd high = Y.colwise().maxCoeff().cwiseMax(Z.colwise().maxCoeff()),
                           low = Y.colwise().minCoeff().cwiseMin(Z.colwise().minCoeff());
  const double range = (high - low).maxCoeff();
  return range > 0.0 ? std::ldexp(1.0, std::ilogb(range)) : 1.0;
}

}  // namespace detail

/// Inverted generational distance. This and the next two minimise every column, and throw
/// std::invalid_argument when a front is empty, the columns differ or a number is not finite.
inline double igd(const Eigen::MatrixXd& Y, const Eigen::MatrixXd& Z) {
  detail::check_fronts("pareto::igd: ", Y, Z);
  const double unit = detail::unit_of(Y, Z);
  const auto square = [m = Y.cols(), unit](const double* y, const double* z) {
    double sum = 0.0;
    for (Eigen::Index j = 0; j < m; ++j) sum += std::pow((y[j] - z[j]) / unit, 2);
    return sum;
  };
  return detail::nearest(Y, Z, square).cwiseSqrt().mean() * unit;
}

inline double igd_plus(const Eigen::MatrixXd& Y, const Eigen::MatrixXd& Z) {
  detail::check_fronts("pareto::igd_plus: ", Y, Z);
  const double unit = detail::unit_of(Y, Z);
  const auto square = [m = Y.cols(), unit](const double* y, const double* z) {
    double sum = 0.0;
    for (Eigen::Index j = 0; j < m; ++j) {
      const double worse = std::max(y[j] - z[j], 0.0) / unit;
      sum += worse * worse;
    }
    return sum;
  };
  return detail::nearest(Y, Z, square).cwiseSqrt().mean() * unit;
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

/// The same in natural signs.
inline double igd(const doe::Problem& problem, const Eigen::MatrixXd& Y, const Eigen::MatrixXd& Z) {
  return igd(minimised(problem, Y), minimised(problem, Z));
}

inline double igd_plus(const doe::Problem& problem, const Eigen::MatrixXd& Y, const Eigen::MatrixXd& Z) {
  return igd_plus(minimised(problem, Y), minimised(problem, Z));
}

inline double additive_epsilon(const doe::Problem& problem, const Eigen::MatrixXd& Y,
                               const Eigen::MatrixXd& Z) {
  return additive_epsilon(minimised(problem, Y), minimised(problem, Z));
}

}  // namespace drawpoint::pareto
