// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The derivatives of the likelihood by the parameters of the correlation, ½ Σ M Rₐ and ½ Σ M R_ab; the
/// equations stand in likelihood.hpp.
///
/// Where c is a product, Rₐ = C∘∂ln c/∂a; where it is a sum, ∂c/∂a (correlation_slopes.hpp). Cost n² per variable.

#include <algorithm>
#include <cmath>
#include <drawpoint/kriging/detail/likelihood.hpp>
#include <vector>

namespace drawpoint::kriging {

// exp(vₖ)/Σ exp(vⱼ) of the inputs that vary; of all where none does.
inline void Likelihood::set_weights(const Eigen::VectorXd& p) {
  std::vector<bool> counts = varying();
  if (std::count(counts.begin(), counts.end(), true) == 0) counts.assign(counts.size(), true);
  f_.weight = Eigen::VectorXd::Zero(variables());
  double largest = -std::numeric_limits<double>::infinity(), sum = 0;
  for (Eigen::Index k = 0; k < variables(); ++k)
    if (counts[static_cast<std::size_t>(k)]) largest = std::max(largest, p[places_.weight(k)]);
  for (Eigen::Index k = 0; k < variables(); ++k)
    if (counts[static_cast<std::size_t>(k)]) sum += f_.weight[k] = std::exp(p[places_.weight(k)] - largest);
  for (double& weight : f_.weight) weight /= sum;
}

// Rows j + first .. of column j of M below the diagonal.
inline detail::Chunk Likelihood::multipliers(Eigen::Index j, const detail::Rows& rows) const {
  const double *alpha = gls_.alpha.data() + rows.first, *K = &K_(rows.first, j);
  const double scale = gls_.alpha[j] / estimates_.process_variance;
  detail::Chunk m(rows.count);
  for (Eigen::Index i = 0; i < rows.count; ++i) m.number[i] = alpha[i] * scale - K[i];
  return m;
}

// The same of M∘C.
inline detail::Chunk Likelihood::weight(Eigen::Index j, const detail::Rows& rows) const {
  const double* alpha = gls_.alpha.data() + rows.first;
  const double *K = &K_(rows.first, j), *C = &C_(rows.first, j),
               scale = gls_.alpha[j] / estimates_.process_variance;
  detail::Chunk w(rows.count);
  for (Eigen::Index i = 0; i < rows.count; ++i) w.number[i] = (alpha[i] * scale - K[i]) * C[i];
  return w;
}

// ½ Σ M Rₐ; that of λ is 0.
inline Eigen::VectorXd Likelihood::correlation_slopes() const {
  constexpr Eigen::Index columns = 64;
  const Eigen::Index n = runs(), last = parameters() - 1;
  const int blocks = static_cast<int>((n + columns - 1) / columns);
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(last, blocks);  // added up in order: equal bits on any threads
  detail::for_each_task(blocks, n < 500 ? 1 : in_.threads, [&](int t) {
    for (Eigen::Index j = t * columns; j < std::min(n, (t + 1) * columns); ++j)
      places_.weights ? add_sum_slopes(j, detail::column(sums, t)) : add_slopes(j, detail::column(sums, t));
  });
  Eigen::VectorXd g = Eigen::VectorXd::Zero(last + 1);
  for (int t = 0; t < blocks; ++t) detail::add_scaled(g.data(), 1.0, detail::column(sums, t), last);
  return g;
}

// ½ Σ M Rₐ of column j, doubled for its mirror; the diagonal of Rₐ is 0 but for the noise.
inline void Likelihood::add_slopes(Eigen::Index j, double* g) const {
  const Eigen::Index d = variables();
  in_chunks(j, [&](const detail::Rows& rows) {
    const detail::Chunk w = weight(j, rows);
    for (Eigen::Index k = 0; k < d; ++k) {
      if (f_.family == Correlation::gaussian && !detail::is_category(f_.levels, k)) {
        g[places_.theta(k)] -=
            f_.theta[k] * detail::weighted_squares(w.number, rows.column(k), rows.x[k], rows.count);
        continue;
      }
      const detail::Chunk h = detail::distances(f_, rows, k);
      g[places_.theta(k)] += dot(w, detail::slope_in_theta(f_, k, h));
      if (places_.exponents) g[places_.exponent(k)] += dot(w, detail::slope_in_exponent(f_, k, h));
    }
  });
}

// The same of a sum.
inline void Likelihood::add_sum_slopes(Eigen::Index j, double* g) const {
  in_chunks(j, [&](const detail::Rows& rows) {
    const detail::Chunk m = multipliers(j, rows);
    for (Eigen::Index k = 0; k < variables(); ++k) {
      const detail::Summand summand(f_, rows, k);
      g[places_.theta(k)] += dot(m, summand.slope_in_theta());
      if (places_.exponents) g[places_.exponent(k)] += dot(m, summand.slope_in_exponent());
      g[places_.weight(k)] += dot(m, summand.slope_in_weight(&C_(rows.first, j)));
    }
  });
}

// ½ Σ M R_ab, lower triangle. R_ab = C (slopeₐ slope_b + second derivative of ln c).
inline void Likelihood::add_second_derivatives_of_product(Eigen::MatrixXd& H) const {
  const Eigen::Index d = variables(), last = parameters() - 1;
  std::vector<detail::Chunk> slopes(static_cast<std::size_t>(last), detail::Chunk(0));
  const auto put = [&](Eigen::Index a, bool first, const detail::Chunk& slope) {
    if (first)
      slopes[a] = slope;
    else
      detail::add_scaled(slopes[a].number, 1.0, slope.number, slope.count);
  };
  for (Eigen::Index j = 0; j < runs(); ++j) {
    in_chunks(j, [&](const detail::Rows& rows) {
      const detail::Chunk w = weight(j, rows);
      for (Eigen::Index k = 0; k < d; ++k) {
        const Eigen::Index a = places_.theta(k);
        const detail::Chunk h = detail::distances(f_, rows, k);
        put(a, places_.leads(k), detail::slope_in_theta(f_, k, h));
        H(a, a) += dot(w, detail::curvature_in_theta(f_, k, h));
        if (!places_.exponents) continue;
        const Eigen::Index b = places_.exponent(k);
        const detail::Chunk slope = detail::slope_in_exponent(f_, k, h);
        put(b, places_.leads(k), slope);
        H(b, a) += dot(w, slope);
        H(b, b) += dot(entry_products(w, slope), detail::logarithms(h));
      }
      for (Eigen::Index a = 0; a < last; ++a) {
        const detail::Chunk v = entry_products(w, slopes[a]);
        for (Eigen::Index b = 0; b <= a; ++b) H(a, b) += dot(v, slopes[b]);
      }
    });
  }
}

// The same of a sum, whose mixed derivatives follow from the first ones.
inline void Likelihood::add_second_derivatives_of_sum(Eigen::MatrixXd& H) const {
  for (Eigen::Index j = 0; j < runs(); ++j)
    in_chunks(j, [&](const detail::Rows& rows) {
      const detail::Chunk m = multipliers(j, rows);
      for (Eigen::Index k = 0; k < variables(); ++k) {
        const detail::Summand summand(f_, rows, k);
        const detail::Chunk w = entry_products(m, summand.part), t = detail::slope_in_theta(f_, k, summand.h);
        const Eigen::Index a = places_.theta(k);
        H(a, a) += dot(entry_products(w, t), t) + dot(w, detail::curvature_in_theta(f_, k, summand.h));
        if (!places_.exponents) continue;
        const Eigen::Index b = places_.exponent(k);
        const detail::Chunk e = detail::slope_in_exponent(f_, k, summand.h), v = entry_products(w, e);
        H(b, a) += dot(v, t) + dot(w, e);
        H(b, b) += dot(v, e) + dot(v, detail::logarithms(summand.h));
      }
    });
  const Eigen::VectorXd g = correlation_slopes();
  for (Eigen::Index k = 0; k < variables(); ++k) {
    const Eigen::Index v = places_.weight(k);
    H(v, v) += g[v];
    for (Eigen::Index l = 0; l < variables(); ++l) {
      const double own = (k == l ? 1.0 : 0.0) - f_.weight[k];
      H(v, places_.theta(l)) += own * g[places_.theta(l)];
      if (places_.exponents) H(v, places_.exponent(l)) += own * g[places_.exponent(l)];
      if (l <= k) H(v, places_.weight(l)) -= f_.weight[l] * g[v] + f_.weight[k] * g[places_.weight(l)];
    }
  }
}

// Rows j + first .. of column j of Rₐ.
inline detail::Chunk Likelihood::slope(Eigen::Index a, Eigen::Index j, const detail::Rows& rows) const {
  const Eigen::Index d = variables(), of_theta = places_.theta_count;
  const double* C = &C_(rows.first, j);
  if (places_.weights) {
    const detail::Summand summand(f_, rows, a % d);
    return a < of_theta            ? summand.slope_in_theta()
           : a < places_.weight(0) ? summand.slope_in_exponent()
                                   : summand.slope_in_weight(C);
  }
  detail::Chunk sum(rows.count);
  for (Eigen::Index k = 0; k < d; ++k) {
    if (places_.theta(k) != a % of_theta) continue;
    const detail::Chunk h = detail::distances(f_, rows, k);
    const detail::Chunk one =
        a < of_theta ? detail::slope_in_theta(f_, k, h) : detail::slope_in_exponent(f_, k, h);
    if (places_.leads(k))
      sum = one;
    else
      detail::add_scaled(sum.number, 1.0, one.number, rows.count);
  }
  for (Eigen::Index i = 0; i < rows.count; ++i) sum.number[i] *= C[i];
  return sum;
}

}  // namespace drawpoint::kriging
