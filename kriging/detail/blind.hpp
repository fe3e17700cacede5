// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The trend that leave-one-out errors choose.
///
/// One more term f of the trend changes the P of left_out.hpp to P − (Pf)(Pf)ᵀ/(fᵀPf), so each candidate
/// costs n².
///
/// Blind selection: starting from the constant, the term of the quadratic that lowers Σ eᵢ² most is added,
/// while it lowers it by 1 % or more and the terms stay below a third of the runs; θ and λ are those of the
/// constant trend meanwhile. fit() then fits anew and keeps the trend if its own leave-one-out error is
/// lower. In the manner of Joseph, Hung, Sudjianto 2008, J. Mechanical Design 130(3), "Blind kriging", with
/// the criterion of Couckuyt et al. 2012, Advances in Engineering Software 49. Cost n³ + terms · (d + 2)²/2 ·
/// n².

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <drawpoint/kriging/detail/cholesky.hpp>
#include <drawpoint/kriging/detail/left_out.hpp>
#include <drawpoint/kriging/detail/model_state.hpp>
#include <limits>
#include <vector>

namespace drawpoint::kriging::detail {

/// P and P y, and what a further term makes of them.
struct Projection {
  Eigen::MatrixXd P;
  Eigen::VectorXd Py;

  /// Σ eᵢ² with the term f; +∞ when the trend has it already.
  double error_with(const Eigen::VectorXd& f) const {
    const Eigen::VectorXd Pf = product(P, f), p = diagonal(P);
    const double size = dot(f, Pf), share = dot(f, Py) / size;
    if (!(size > 1e-8 * square(f) * smallest_entry(p))) return std::numeric_limits<double>::infinity();
    double sum = 0;
    for (Index i = 0; i < f.size(); ++i) {
      const double error = (Py[i] - Pf[i] * share) / (p[i] - Pf[i] * Pf[i] / size);
      sum += error * error;
    }
    return sum;
  }

  void add(const Eigen::VectorXd& f) {
    const Eigen::VectorXd Pf = product(P, f);
    const double size = dot(f, Pf);
    add_scaled(Py.data(), -dot(f, Py) / size, Pf.data(), Py.size());
    add_outer(P, -1.0 / size, Pf, Pf);
  }
};

inline Projection projection_of(const ModelState& s) {
  Eigen::MatrixXd L = s.L, X, K;
  inverse_transposed(L, X);
  product_of_upper(X, K);
  add_product(block_of(s.gls.B), block_of(s.gls.B), -1.0, block_of(K), Part::lower);
  mirror_lower(K);
  return {K, s.gls.alpha};
}

inline Eigen::VectorXd column_of(const TrendTerm& term, const Eigen::MatrixXd& X) {
  Eigen::VectorXd f(X.rows());
  for (Eigen::Index i = 0; i < f.size(); ++i) f[i] = term.at(X.row(i).transpose());
  return f;
}

/// The constant and the chosen terms, from the state of a model with the constant trend.
inline std::vector<TrendTerm> blind_terms(const ModelState& s) {
  constexpr double worth = 0.99;
  Projection now = projection_of(s);
  double error = square(entry_quotients(now.Py, diagonal(now.P)));
  const std::vector<TrendTerm> candidates =
      polynomial(static_cast<int>(s.X.cols()), Trend::quadratic, s.correlation.levels);
  std::vector<TrendTerm> chosen{{}};
  while (3 * static_cast<Eigen::Index>(chosen.size() + 1) < s.X.rows()) {
    double least = std::numeric_limits<double>::infinity();
    TrendTerm best;
    for (const TrendTerm& term : candidates) {
      const double with = now.error_with(column_of(term, s.X));
      if (!(with < least)) continue;
      least = with;
      best = term;
    }
    if (!(least < worth * error)) break;
    now.add(column_of(best, s.X));
    chosen.push_back(best);
    error = least;
  }
  return chosen;
}

}  // namespace drawpoint::kriging::detail
