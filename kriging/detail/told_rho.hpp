// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Which terms of ρ the runs of a level tell from its trend.
///
/// The column v = g(x) (m(x) − c) of a term, with what f and earlier terms repeat taken out, leaves P v. The
/// mean m has an error e of covariance S, of which P diag(g) e is left, E|P diag(g) e|² = tr P diag(g) S
/// diag(g) P. A term is told where
///   |P v|² > 4 tr P diag(g) S diag(g) P   two standard deviations: else ρ would be fitted to that error
///   |P v|² > (0.001 s⁻)² n                s⁻ the standard deviation of the runs below: else a difference of
/// a thousandth of the true response's spread would move ρ by as much as ρ s⁻ needs to make all of it.
/// Where ρ's constant is not told none of its terms is: the others are relative to it. Cost n² per term.

#include <Eigen/Core>
#include <algorithm>
#include <drawpoint/kriging/detail/cokriging_level.hpp>
#include <vector>

namespace drawpoint::kriging::detail {

/// What told_rho needs of a level above `levels` at its runs. scaled: n x d; f: the trend's values there, n x q;
/// views: of the runs at all of `levels`; rho: g, the constant first; centre: c.
struct RhoAtRuns {
  const Eigen::MatrixXd &scaled, &f;
  const LevelViews& views;
  const std::vector<TrendTerm>& rho;
  double centre;
};

/// tr P A P with P = I − Q Qᵀ, Q the first `count` columns.
inline double trace_left(const Eigen::MatrixXd& A, const Eigen::MatrixXd& Q, Index count) {
  double trace = 0;
  for (Index i = 0; i < A.rows(); ++i) trace += A(i, i);
  for (Index k = 0; k < count; ++k) {
    const Eigen::VectorXd q = Q.col(k);
    trace -= dot(q.data(), product(A, q).data(), q.size());
  }
  return std::max(trace, 0.0);
}

/// Orthonormal columns for what `f` spans, with room for `more`. Its rank is added to `count`.
inline Eigen::MatrixXd basis_of(const Eigen::MatrixXd& f, Index more, Index& count) {
  Eigen::MatrixXd Q = Eigen::MatrixXd::Zero(f.rows(), f.cols() + more);
  for (const Index j : independent_columns(f)) {
    std::copy_n(column(f, j), f.rows(), column(Q, count));
    const double left = orthogonalize(Q, count, column(Q, count));
    for (Index i = 0; i < f.rows(); ++i) Q(i, count) /= left;
    ++count;
  }
  return Q;
}

/// The terms of ρ that are told, in their order.
inline std::vector<TrendTerm> told_rho(const CokrigingLevels& levels, const RhoAtRuns& at) {
  constexpr double deviations = 2, least_share = 1e-3;
  const Index n = at.f.rows();
  const Eigen::MatrixXd S = covariance_of(levels, levels.size(), at.views, at.views),
                        G = term_values(at.rho, at.scaled);
  const double least = least_share * levels.back().s.y_scale;
  Index count = 0;
  Eigen::MatrixXd Q = basis_of(at.f, G.cols(), count);
  std::vector<TrendTerm> told;
  for (Index j = 0; j < G.cols() && count < n; ++j) {
    Eigen::MatrixXd A = S;
    for (Index b = 0; b < n; ++b)
      for (Index a = 0; a < n; ++a) A(a, b) *= G(a, j) * G(b, j);
    double* v = column(Q, count);
    for (Index i = 0; i < n; ++i) v[i] = G(i, j) * (at.views.back().mean[i] - at.centre);
    const double error = trace_left(A, Q, count), left = orthogonalize(Q, count, v);
    const bool is_told =
        left * left > deviations * deviations * error && left * left > least * least * static_cast<double>(n);
    if (!is_told && j == 0) return {};
    if (!is_told) continue;
    for (Index i = 0; i < n; ++i) v[i] /= left;
    ++count;
    told.push_back(at.rho[static_cast<std::size_t>(j)]);
  }
  return told;
}

}  // namespace drawpoint::kriging::detail
