// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The Hessian and the Fisher information of the likelihood; the equations stand in likelihood.hpp.
///
/// Derivatives of R are computed one at a time, and the matrix products are those of the factorisation. Cost
/// for m parameters: about (2m − 1)·2n³ operations, O(n²) memory.

#include <drawpoint/kriging/detail/likelihood.hpp>
#include <vector>

namespace drawpoint::kriging {

inline Eigen::MatrixXd Likelihood::hessian(const Eigen::VectorXd& p) {
  const Eigen::Index m = parameters();
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(m, m);
  const Eigen::VectorXd g = gradient(p);
  if (!std::isfinite(estimates_.log_likelihood)) return H;
  detail::mirror_lower(K_);
  places_.weights ? add_second_derivatives_of_sum(H) : add_second_derivatives_of_product(H);
  H(m - 1, m - 1) += slope_in_nugget();
  add_traces(H);
  add_trend_and_scale(H);
  detail::mirror_lower(H);
  if (prior_) prior_->add_hessian(p, H);
  if (weight_prior_) weight_prior_->add_hessian(H);
  return H;
}

inline Eigen::MatrixXd Likelihood::fisher(const Eigen::VectorXd& p) {
  const Eigen::Index m = parameters();
  Eigen::MatrixXd F = Eigen::MatrixXd::Zero(m, m);
  if (!invert(p)) return F;
  detail::mirror_lower(K_);
  add_traces(F);
  const Eigen::VectorXd t = traces();
  const double n = static_cast<double>(runs());
  if (in_.known_noise > 0) {
    for (Eigen::Index a = 0; a < m; ++a) F(m - 1, a) -= 0.5 * t[a];
    F(m - 1, m - 1) += 0.5 * n - 0.5 * t[m - 1];
  } else {
    detail::add_outer(F, -0.5 / n, t, t);
  }
  detail::mirror_lower(F);
  return F;
}

// Rₐ of any parameter but λ: n x n, both triangles.
inline void Likelihood::fill_derivative(Eigen::Index a, Eigen::MatrixXd& D) const {
  D.resize(runs(), runs());
  for (Eigen::Index j = 0; j < runs(); ++j)
    in_chunks(j, [&](const detail::Rows& rows) {
      const detail::Chunk one = slope(a, j, rows);
      std::copy_n(one.number, rows.count, &D(rows.first, j));
    });
  detail::mirror_lower(D);
}

// tr(R⁻¹Rₐ); K has both triangles.
inline Eigen::VectorXd Likelihood::traces() const {
  const Eigen::Index last = parameters() - 1;
  Eigen::VectorXd t(last + 1);
  Eigen::MatrixXd D;
  for (Eigen::Index a = 0; a < last; ++a) {
    fill_derivative(a, D);
    t[a] = detail::dot(K_, D);
  }
  t[last] = 0;
  for (Eigen::Index i = 0; i < runs(); ++i) t[last] += nugget_ * noise_weight(i) * K_(i, i);
  return t;
}

// ½ tr(K Rₐ K R_b), lower triangle; K has both triangles.
inline void Likelihood::add_traces(Eigen::MatrixXd& H) {
  const Eigen::Index last = parameters() - 1, n = runs();
  const auto product = [&](Eigen::MatrixXd& A, Eigen::MatrixXd& B, Eigen::MatrixXd& C) {  // A Bᵀ
    C.setZero(n, n);
    detail::add_product(detail::block_of(A), detail::block_of(B), 1.0, detail::block_of(C), detail::Part::all,
                        in_.threads);
  };
  Eigen::MatrixXd D, W, V, noisy = K_;  // λ diag(w) K
  for (Eigen::Index j = 0; j < n; ++j)
    for (Eigen::Index i = 0; i < n; ++i) noisy(i, j) *= nugget_ * noise_weight(i);
  for (Eigen::Index a = 0; a < last; ++a) {
    fill_derivative(a, D);
    product(K_, D, W);
    H(a, a) += 0.5 * detail::dot(W, W.transpose());
    H(last, a) += 0.5 * detail::dot(W, noisy);
    if (a + 1 == last) continue;
    product(W, K_, V);
    for (Eigen::Index b = a + 1; b < last; ++b) {
      fill_derivative(b, D);
      H(b, a) += 0.5 * detail::dot(V, D);
    }
  }
  H(last, last) += 0.5 * detail::dot(noisy, noisy.transpose());
}

// −αᵀRₐ P R_b α/s² and what s² adds, lower triangle.
inline void Likelihood::add_trend_and_scale(Eigen::MatrixXd& H) const {
  const Eigen::Index last = parameters() - 1;
  const double s2 = estimates_.process_variance;
  Eigen::MatrixXd U = Eigen::MatrixXd::Zero(runs(), last + 1), D;
  for (Eigen::Index a = 0; a < last; ++a) {
    fill_derivative(a, D);
    detail::add_product(detail::column(U, a), 1.0, D, gls_.alpha.data());
  }
  for (Eigen::Index i = 0; i < runs(); ++i) U(i, last) = nugget_ * noise_weight(i) * gls_.alpha[i];
  const Eigen::VectorXd q = detail::transposed_product(U, gls_.alpha);
  const Eigen::MatrixXd BU = detail::transposed_product(gls_.B, U);
  const Eigen::MatrixXd UKU = detail::transposed_product(U, detail::product(K_, U));
  const Eigen::MatrixXd UBBU = detail::transposed_product(BU, BU);
  for (Eigen::Index i = 0; i < H.size(); ++i) H.data()[i] -= (UKU.data()[i] - UBBU.data()[i]) / s2;
  if (in_.known_noise > 0) {
    for (Eigen::Index a = 0; a <= last; ++a) H(last, a) += 0.5 * q[a] / s2;
    H(last, last) += 0.5 * q[last] / s2 - 0.5 * gls_.sum_of_squares / s2;
  } else {
    detail::add_outer(H, 0.5 / (static_cast<double>(runs()) * s2 * s2), q, q);
  }
}

}  // namespace drawpoint::kriging
