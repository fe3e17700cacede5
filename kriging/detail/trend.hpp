// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The trend f(x)ᵀβ that the correlated part of a Kriging model stands on.
///
/// constant: 1. linear: 1, x₁ .. x_d. quadratic: these, the squares and the products xₐx_b. Polynomials are
/// in the inputs scaled to [-1, 1]. user: any functions of x in natural units. blind: the terms of the
/// quadratic that lower the leave-one-out error, chosen by fit (blind.hpp). A category is in no polynomial.
/// Terms that the runs cannot tell apart from earlier ones (an input that never varies, x and x² of two
/// levels) are left out. Cost a point: the number of terms.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <drawpoint/kriging/detail/dense.hpp>
#include <drawpoint/kriging/detail/levels.hpp>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace drawpoint::kriging {

enum class Trend { constant, linear, quadratic, blind, user };

inline std::string_view to_string(Trend trend) {
  switch (trend) {
    case Trend::constant:
      return "constant";
    case Trend::linear:
      return "linear";
    case Trend::quadratic:
      return "quadratic";
    case Trend::blind:
      return "blind";
    case Trend::user:
      return "user";
  }
  return "unknown";
}

/// Functions of one point x of d entries in natural units. The first should be the constant 1.
struct Basis {
  std::function<Eigen::VectorXd(const Eigen::VectorXd&)> values;  ///< q entries, q the same everywhere
  /// q x d, ∂ values/∂x. Empty: central differences with a step of 6e-6 times the half-range of the input,
  /// good to about ten digits of the largest value.
  std::function<Eigen::MatrixXd(const Eigen::VectorXd&)> jacobian;
};

/// One term of a polynomial in the scaled inputs: 1, xₐ or xₐx_b.
struct TrendTerm {
  int a = -1, b = -1;  ///< −1: none

  double at(const Eigen::VectorXd& x) const { return (a < 0 ? 1.0 : x[a]) * (b < 0 ? 1.0 : x[b]); }

  double slope(const Eigen::VectorXd& x, int k) const {
    return (a == k ? (b < 0 ? 1.0 : x[b]) : 0.0) + (b == k ? x[a] : 0.0);
  }

  friend bool operator==(const TrendTerm&, const TrendTerm&) = default;
};

namespace detail {

/// 1; then xₐ when linear; then xₐx_b with a <= b when quadratic; a and b are the numbers among d inputs, all
/// where `levels` is empty.
inline std::vector<TrendTerm> polynomial(int d, Trend trend, const std::vector<int>& levels = {}) {
  std::vector<TrendTerm> terms{{}};
  if (trend == Trend::constant) return terms;
  std::vector<int> numbers;
  for (int a = 0; a < d; ++a)
    if (!is_category(levels, a)) numbers.push_back(a);
  for (const int a : numbers) terms.push_back({a, -1});
  if (trend != Trend::quadratic) return terms;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    for (std::size_t j = i; j < numbers.size(); ++j) terms.push_back({numbers[i], numbers[j]});
  return terms;
}

/// A point in both units; `half_range` is natural units a scaled one, 0 for an input that never varies.
struct TrendPoint {
  const Eigen::VectorXd &natural, &scaled, &half_range;
};

/// The chosen terms, in order.
struct TrendFunction {
  std::vector<TrendTerm> terms{{}};
  Basis basis;                     ///< used instead of the terms when it has values
  std::vector<Eigen::Index> kept;  ///< of the basis

  bool by_user() const { return static_cast<bool>(basis.values); }
  Eigen::Index size() const { return static_cast<Eigen::Index>(by_user() ? kept.size() : terms.size()); }
  bool is_constant() const { return !by_user() && terms.size() == 1; }

  Eigen::VectorXd values(const TrendPoint& x) const {
    if (by_user()) return entries_of(called(x.natural), kept);
    Eigen::VectorXd f(size());
    for (Eigen::Index i = 0; i < size(); ++i) f[i] = terms[i].at(x.scaled);
    return f;
  }

  /// q x d, by the natural inputs.
  Eigen::MatrixXd jacobian(const TrendPoint& x) const {
    const Eigen::Index d = x.natural.size();
    if (by_user()) return basis.jacobian ? given_jacobian(x) : difference_quotients(x);
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(size(), d);
    for (Eigen::Index k = 0; k < d; ++k)
      for (Eigen::Index i = 0; i < size(); ++i)
        if (x.half_range[k] > 0) J(i, k) = terms[i].slope(x.scaled, static_cast<int>(k)) / x.half_range[k];
    return J;
  }

 private:
  [[noreturn]] static void reject(const std::string& what) {
    throw std::invalid_argument("kriging::Basis: " + what);
  }

  Eigen::VectorXd called(const Eigen::VectorXd& x) const {
    Eigen::VectorXd f = basis.values(x);
    if (!kept.empty() && f.size() <= kept.back())
      reject("values has " + std::to_string(f.size()) +
             " entries, fewer than at the runs; allowed is one size; " + "return as many everywhere");
    if (!all_finite(f))
      reject("values holds a number that is not finite; allowed are finite numbers; mend it");
    return f;
  }

  Eigen::MatrixXd given_jacobian(const TrendPoint& x) const {
    const Eigen::MatrixXd J = basis.jacobian(x.natural);
    if (J.rows() <= kept.back() || J.cols() != x.natural.size())
      reject("jacobian is " + std::to_string(J.rows()) + " x " + std::to_string(J.cols()) +
             "; allowed is the size of values x " + std::to_string(x.natural.size()) + "; give ∂values/∂x");
    return rows_of(J, kept);
  }

  Eigen::MatrixXd difference_quotients(const TrendPoint& x) const {
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(size(), x.natural.size());
    for (Eigen::Index k = 0; k < x.natural.size(); ++k) {
      const double step = 6e-6 * x.half_range[k];
      if (!(step > 0)) continue;
      Eigen::VectorXd up = x.natural, down = x.natural;
      up[k] += step;
      down[k] -= step;
      const Eigen::VectorXd at_up = called(up), at_down = called(down);
      for (Eigen::Index i = 0; i < size(); ++i)
        J(i, k) = (at_up[kept[i]] - at_down[kept[i]]) / (up[k] - down[k]);
    }
    return J;
  }
};

/// Indices of the columns of F that are independent of those before them to eight digits.
inline std::vector<Eigen::Index> independent_columns(const Eigen::MatrixXd& F) {
  constexpr double least = 1e-8;
  const Eigen::Index n = F.rows();
  Eigen::MatrixXd Q = F;  // in its first columns those that are kept, made orthonormal
  std::vector<Eigen::Index> kept;
  for (Eigen::Index j = 0; j < F.cols(); ++j) {
    const auto count = static_cast<Eigen::Index>(kept.size());
    const double norm = std::sqrt(dot(column(F, j), column(F, j), n));
    if (!(norm > 0) || count == n) continue;
    double* v = column(Q, count);
    std::transform(column(F, j), column(F, j) + n, v, [=](double entry) { return entry / norm; });
    const double left = orthogonalize(Q, count, v);
    if (!(left > least)) continue;
    for (Eigen::Index i = 0; i < n; ++i) v[i] /= left;
    kept.push_back(j);
  }
  return kept;
}

}  // namespace detail
}  // namespace drawpoint::kriging
