// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The Hessian and the Fisher information of the likelihood; the equations stand in likelihood.hpp.
///
/// Derivatives of R are computed one at a time, and the matrix products are those of the factorisation. Cost
/// for m parameters: about (2m − 1)·2n³ operations, O(n²) memory.

#include <drawpoint/kriging/likelihood.hpp>
#include <vector>

namespace drawpoint::kriging {

inline Eigen::MatrixXd Likelihood::hessian(const Eigen::VectorXd& p) {
  const Eigen::Index m = parameters();
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(m, m);
  const Eigen::VectorXd g = gradient(p);
  if (!std::isfinite(estimates_.log_likelihood)) return H;
  K_.triangularView<Eigen::StrictlyUpper>() = K_.transpose();
  add_second_derivatives(H);
  add_traces(H);
  add_trend_and_scale(H);
  H.triangularView<Eigen::StrictlyUpper>() = H.transpose();
  return H;
}

inline Eigen::MatrixXd Likelihood::fisher(const Eigen::VectorXd& p) {
  const Eigen::Index m = parameters();
  Eigen::MatrixXd F = Eigen::MatrixXd::Zero(m, m);
  if (!invert(p)) return F;
  K_.triangularView<Eigen::StrictlyUpper>() = K_.transpose();
  add_traces(F);
  const Eigen::VectorXd t = traces();
  const double n = static_cast<double>(runs());
  if (in_.known_noise > 0) {
    F.row(m - 1) -= 0.5 * t.transpose();
    F(m - 1, m - 1) += 0.5 * n - 0.5 * t[m - 1];
  } else {
    F.triangularView<Eigen::Lower>() -= t * t.transpose() / (2.0 * n);
  }
  F.triangularView<Eigen::StrictlyUpper>() = F.transpose();
  return F;
}

// ½ Σ M R_ab, lower triangle. R_ab = C (slopeₐ slope_b + second derivative of ln c).
inline void Likelihood::add_second_derivatives(Eigen::MatrixXd& H) const {
  const Eigen::Index d = variables(), last = parameters() - 1;
  std::vector<detail::Chunk> slopes(static_cast<std::size_t>(last));
  for (Eigen::Index j = 0; j < runs(); ++j) {
    in_chunks(j, [&](const detail::Rows& rows) {
      const detail::Chunk w = weight(j, rows);
      for (Eigen::Index k = 0; k < d; ++k) {
        const detail::Chunk h = rows.distance(k);
        slopes[k] = detail::slope_in_theta(f_, k, h);
        H(k, k) += (w * detail::curvature_in_theta(f_, k, h)).sum();
        if (!estimated_exponents_) continue;
        slopes[d + k] = detail::slope_in_exponent(f_, k, h);
        const detail::Chunk logarithm = (h > 0.0).select(h.max(1e-300).log(), 0.0);
        H(d + k, k) += (w * slopes[d + k]).sum();
        H(d + k, d + k) += (w * slopes[d + k] * logarithm).sum();
      }
      for (Eigen::Index a = 0; a < last; ++a)
        for (Eigen::Index b = 0; b <= a; ++b) H(a, b) += (w * slopes[a] * slopes[b]).sum();
    });
  }
  const double s2 = estimates_.process_variance;
  H(last, last) += 0.5 * nugget_ * noise_sum(gls_.alpha.array().square() / s2 - K_.diagonal().array());
}

// Rₐ of a θ or an exponent: n x n, both triangles.
inline void Likelihood::fill_derivative(Eigen::Index a, Eigen::MatrixXd& D) const {
  const Eigen::Index d = variables(), k = a % d;
  D.resize(runs(), runs());
  for (Eigen::Index j = 0; j < runs(); ++j)
    in_chunks(j, [&](const detail::Rows& rows) {
      const detail::Chunk h = rows.distance(k);
      D.col(j).segment(rows.first, rows.count) =
          C_.col(j).segment(rows.first, rows.count).array() *
          (a < d ? detail::slope_in_theta(f_, k, h) : detail::slope_in_exponent(f_, k, h));
    });
  D.triangularView<Eigen::StrictlyUpper>() = D.transpose();
}

// tr(R⁻¹Rₐ); K has both triangles.
inline Eigen::VectorXd Likelihood::traces() const {
  const Eigen::Index last = parameters() - 1;
  Eigen::VectorXd t(last + 1);
  Eigen::MatrixXd D;
  for (Eigen::Index a = 0; a < last; ++a) {
    fill_derivative(a, D);
    t[a] = K_.cwiseProduct(D).sum();
  }
  t[last] = nugget_ * noise_sum(K_.diagonal().array());
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
  const Eigen::VectorXd w = in_.noise.size() ? in_.noise : Eigen::VectorXd::Ones(n);
  Eigen::MatrixXd D, W, V;
  for (Eigen::Index a = 0; a < last; ++a) {
    fill_derivative(a, D);
    product(K_, D, W);
    H(a, a) += 0.5 * W.cwiseProduct(W.transpose()).sum();
    H(last, a) += 0.5 * nugget_ * W.cwiseProduct(K_).rowwise().sum().dot(w);
    if (a + 1 == last) continue;
    product(W, K_, V);
    for (Eigen::Index b = a + 1; b < last; ++b) {
      fill_derivative(b, D);
      H(b, a) += 0.5 * V.cwiseProduct(D).sum();
    }
  }
  H(last, last) += 0.5 * nugget_ * nugget_ * w.dot(K_.cwiseAbs2() * w);
}

// −αᵀRₐ P R_b α/s² and what s² adds, lower triangle.
inline void Likelihood::add_trend_and_scale(Eigen::MatrixXd& H) const {
  const Eigen::Index last = parameters() - 1;
  const double s2 = estimates_.process_variance;
  Eigen::MatrixXd U(runs(), last + 1), D;
  for (Eigen::Index a = 0; a < last; ++a) {
    fill_derivative(a, D);
    U.col(a).noalias() = D * gls_.alpha;
  }
  U.col(last) = nugget_ * gls_.alpha;
  if (in_.noise.size()) U.col(last).array() *= in_.noise.array();
  const Eigen::VectorXd q = U.transpose() * gls_.alpha;
  const Eigen::MatrixXd BU = gls_.B.transpose() * U;
  H.triangularView<Eigen::Lower>() -= (U.transpose() * (K_ * U) - BU.transpose() * BU) / s2;
  if (in_.known_noise > 0) {
    H.row(last) += 0.5 * q.transpose() / s2;
    H(last, last) += 0.5 * q[last] / s2 - 0.5 * gls_.sum_of_squares / s2;
  } else {
    H.triangularView<Eigen::Lower>() += q * q.transpose() / (2.0 * static_cast<double>(runs()) * s2 * s2);
  }
}

}  // namespace drawpoint::kriging
