// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Criteria of a design that an exchange changes cheaply: two rows swap their values in one variable, so the
/// design stays Latin, and only the terms of these two rows change.
///
/// * PairPotential: S = Σ_{i<k} (s/d_ik)^p = (s·phi_p)^p with the length s = n^(-1/d); smaller is better.
/// * CentredDiscrepancy: the squared centred L2 discrepancy of quality.hpp.
///
/// The rows to be optimised come first; rows after them (corners, runs made before) stay and count. An
/// exchange costs O(n d) time: the products and distances over the other variables are formed anew, which for
/// the usual d is as quick as fetching them, and needs O(n) memory in place of n². Morris, Mitchell 1995;
/// Jin, Chen, Sudjianto 2005, "An efficient algorithm for constructing optimal design of computer
/// experiments".

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <utility>

#include <drawpoint/doe/quality.hpp>

namespace drawpoint::doe::detail {

class PairPotential {
 public:
  /// U: rows x d in the unit box; p even, 2 to 100.
  PairPotential(Eigen::MatrixXd U, int p)
      : U_(std::move(U)),
        half_(p / 2),
        length_(std::pow(static_cast<double>(U_.rows()), -2.0 / static_cast<double>(U_.cols()))),
        floor_(length_ * std::pow(10.0, -560.0 / p)),
        value_(total()) {}

  const Eigen::MatrixXd& design() const { return U_; }
  double value() const { return value_; }

  /// What swapping U(i, j) and U(k, j) adds to the value.
  double change(Eigen::Index i, Eigen::Index k, Eigen::Index j) {
    return row_change(i, k, j) + row_change(k, i, j);
  }

  void exchange(Eigen::Index i, Eigen::Index k, Eigen::Index j, double change) {
    std::swap(U_(i, j), U_(k, j));
    value_ += change;
    if (change < -0.99 * (value_ - change)) value_ = total();  // the difference has lost its digits
  }

  /// Sums anew what many exchanges have rounded.
  void refresh() { value_ = total(); }

 private:
  /// (s²/D)^(p/2), D kept above a floor that keeps the power below 1e280.
  template <class Distances>
  double potential(Distances& D) {
    D = length_ / D.max(floor_);
    if (half_ == 1) return D.sum();
    power_.resize(D.size());
    bool empty = true;
    for (int exponent = half_;; exponent /= 2) {
      if (exponent % 2 == 1) {
        if (empty)
          power_ = D;
        else
          power_ *= D;
        empty = false;
      }
      if (exponent == 1) return power_.sum();
      D = D.square();
    }
  }

  double total() {
    double sum = 0.0;
    Eigen::ArrayXd row;
    for_squared_distances(U_, [&](Eigen::Index, const auto& D) {
      row = D;
      sum += potential(row);
    });
    return sum;
  }

  /// Row i takes the value of row k in variable j; their own distance does not change.
  double row_change(Eigen::Index i, Eigen::Index k, Eigen::Index j) {
    others_.setZero(U_.rows());
    for (Eigen::Index c = 0; c < U_.cols(); ++c)
      if (c != j) others_ += (U_.col(c).array() - U_(i, c)).square();
    others_[i] = others_[k] = std::numeric_limits<double>::infinity();
    moved_ = others_ + (U_.col(j).array() - U_(k, j)).square();
    others_ += (U_.col(j).array() - U_(i, j)).square();
    return potential(moved_) - potential(others_);
  }

  Eigen::MatrixXd U_;
  int half_;
  double length_, floor_;  // squared lengths
  Eigen::ArrayXd others_, moved_, power_;
  double value_;
};

class CentredDiscrepancy {
 public:
  /// U: rows x d in the unit box.
  explicit CentredDiscrepancy(Eigen::MatrixXd U)
      : U_(std::move(U)),
        Z_((U_.array() - 0.5).abs()),
        n_(static_cast<double>(U_.rows())),
        value_(squared_centred_discrepancy(U_)) {}

  const Eigen::MatrixXd& design() const { return U_; }
  double value() const { return value_; }

  double change(Eigen::Index i, Eigen::Index k, Eigen::Index j) {
    products(i, j, of_i_);
    products(k, j, of_k_);
    const double zi = Z_(i, j), zk = Z_(k, j);
    of_i_ -= of_k_;
    of_i_[i] = of_i_[k] = 0.0;  // their own product does not change
    const double pairs = (of_i_ * (0.5 * (zk - zi) - 0.5 * (U_.col(j).array() - U_(k, j)).abs() +
                                   0.5 * (U_.col(j).array() - U_(i, j)).abs()))
                             .sum();
    return (2.0 * pairs + (diagonal(i, j) - diagonal(k, j)) * (zk - zi)) / (n_ * n_) -
           2.0 / n_ * (single(i, j) - single(k, j)) * (one(zk) - one(zi));
  }

  void exchange(Eigen::Index i, Eigen::Index k, Eigen::Index j, double change) {
    std::swap(U_(i, j), U_(k, j));
    std::swap(Z_(i, j), Z_(k, j));
    value_ += change;
  }

  void refresh() { value_ = squared_centred_discrepancy(U_); }

 private:
  static double one(double z) { return 0.5 * z - 0.5 * z * z; }

  /// Π over the variables but j of the pair kernel of row i with every row.
  void products(Eigen::Index i, Eigen::Index j, Eigen::ArrayXd& product) const {
    product.setOnes(U_.rows());
    for (Eigen::Index c = 0; c < U_.cols(); ++c)
      if (c != j)
        product *= (1.0 + 0.5 * Z_(i, c)) + 0.5 * (Z_.col(c) - (U_.col(c).array() - U_(i, c)).abs());
  }

  double diagonal(Eigen::Index i, Eigen::Index j) const {
    double product = 1.0;
    for (Eigen::Index c = 0; c < U_.cols(); ++c)
      if (c != j) product *= 1.0 + Z_(i, c);
    return product;
  }

  double single(Eigen::Index i, Eigen::Index j) const {
    double product = 1.0;
    for (Eigen::Index c = 0; c < U_.cols(); ++c)
      if (c != j) product *= 1.0 + one(Z_(i, c));
    return product;
  }

  Eigen::MatrixXd U_;
  Eigen::ArrayXXd Z_;  // |u - 1/2|
  double n_;
  Eigen::ArrayXd of_i_, of_k_;
  double value_;
};

}  // namespace drawpoint::doe::detail
