// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The sums from which Sobol' indices are estimated, so that a bootstrap needs only their weighted means.

#include <Eigen/Core>
#include <cmath>

namespace drawpoint::doe {

enum class SobolEstimator { saltelli, jansen, martinez };

namespace detail {

/// One row per pair of points: columns f(A), f(B), their squares, then for each input the seven of `term`,
/// then for each two inputs one product. Means of columns, weighted or not, give the indices.
class SobolTerms {
 public:
  /// Y: pairs x (d + 2), or x (2d + 2) for the indices of pairs of inputs, columns as the blocks of the
  /// design, their common mean taken off.
  SobolTerms(const Eigen::MatrixXd& Y, Eigen::Index d)
      : d_(d),
        pairs_of_inputs_(Y.cols() > d + 2 ? d * (d - 1) / 2 : 0),
        terms_(Y.rows(), 4 + 7 * d + pairs_of_inputs_) {
    const auto a = Y.col(0).array(), b = Y.col(1).array();
    terms_.col(0) = a;
    terms_.col(1) = b;
    terms_.col(2) = a.square();
    terms_.col(3) = b.square();
    for (Eigen::Index j = 0; j < d_; ++j) {
      const auto c = Y.col(2 + j).array();
      auto term = terms_.middleCols(4 + 7 * j, 7);
      term.col(0) = b * (c - a);
      term.col(1) = (a - c).square();
      term.col(2) = (b - c).square();
      term.col(3) = c;
      term.col(4) = c.square();
      term.col(5) = b * c;
      term.col(6) = a * c;
    }
    if (pairs_of_inputs_ > 0) set_products(Y);
  }

  Eigen::Index pairs() const { return terms_.rows(); }

  Eigen::VectorXd means() const { return terms_.colwise().mean().transpose(); }
  /// weights: one per pair, sum 1.
  Eigen::VectorXd means(const Eigen::VectorXd& weights) const { return terms_.transpose() * weights; }

  /// S_1..S_d, T_1..T_d, S_12, S_13, S_23, S_14, ... from the means; zeros without variance.
  Eigen::VectorXd indices(const Eigen::VectorXd& m, SobolEstimator estimator) const {
    Eigen::VectorXd index = Eigen::VectorXd::Zero(2 * d_ + pairs_of_inputs_);
    const double V = variance(m);
    if (!(V > 0.0)) return index;
    const double var_a = own_variance(m[0], m[2]), var_b = own_variance(m[1], m[3]);
    for (Eigen::Index j = 0; j < d_; ++j) {
      const auto t = m.segment<7>(4 + 7 * j);
      const double var_c = own_variance(t[3], t[4]);
      index[j] = t[0] / V;
      index[d_ + j] = 0.5 * t[1] / V;
      if (estimator == SobolEstimator::jansen) index[j] = 1.0 - 0.5 * t[2] / V;
      if (estimator != SobolEstimator::martinez) continue;
      index[j] = correlation(t[5] - m[1] * t[3], var_b, var_c);
      index[d_ + j] = 1.0 - correlation(t[6] - m[0] * t[3], var_a, var_c);
    }
    for (Eigen::Index j = 0, at = 0; at < pairs_of_inputs_; ++j)
      for (Eigen::Index k = 0; k < j; ++k, ++at)
        index[2 * d_ + at] = m[4 + 7 * d_ + at] / V - index[j] - index[k];
    return index;
  }

  static double variance(const Eigen::VectorXd& m) {
    const double mean = 0.5 * (m[0] + m[1]);
    return 0.5 * (m[2] + m[3]) - mean * mean;
  }

 private:
  /// Sets the product of each two inputs j and k, ½(f(D_j) f(C_k) + f(D_k) f(C_j)) − f(A) f(B), whose mean is the
  /// variance of E[f | x_j, x_k].
  void set_products(const Eigen::MatrixXd& Y) {
    const Eigen::ArrayXd product = Y.col(0).array() * Y.col(1).array();
    for (Eigen::Index j = 0, at = 4 + 7 * d_; j < d_; ++j)
      for (Eigen::Index k = 0; k < j; ++k, ++at)
        terms_.col(at) = 0.5 * (Y.col(2 + d_ + j).array() * Y.col(2 + k).array() +
                                Y.col(2 + d_ + k).array() * Y.col(2 + j).array()) -
                         product;
  }

  /// 0 where it is the round-off of equal values.
  static double own_variance(double mean, double square) {
    const double variance = square - mean * mean;
    return variance > 1e-13 * square ? variance : 0.0;
  }

  static double correlation(double covariance, double u, double v) {
    return u > 0.0 && v > 0.0 ? covariance / (std::sqrt(u) * std::sqrt(v)) : 0.0;
  }

  Eigen::Index d_, pairs_of_inputs_;
  Eigen::MatrixXd terms_;
};

}  // namespace detail

}  // namespace drawpoint::doe
