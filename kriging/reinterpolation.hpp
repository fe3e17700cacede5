// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Re-interpolation: the model that interpolates what a regression Kriging model predicts at its runs.
///
/// The mean stays the same everywhere, because C⁻¹(ŷ − Fβ) = α. The variance is that of an interpolating
/// model,
///   s²_ri [1 − rᵀC⁻¹r + uᵀ(FᵀC⁻¹F)⁻¹u],  s²_ri = αᵀC α/n,
/// and vanishes at the runs, so that a search for improvement does not ask for the same run again. C without
/// the nugget may be singular to round-off: the smallest of n·ε·4·10ᵏ that lets it be factored is added to
/// its diagonal, and the variance at the runs stays below that share of s²_ri. θ is taken as known. Cost
/// n³/3. Source: Forrester, Keane, Bressloff 2006, AIAA Journal 44(10), "Design and Analysis of 'Noisy'
/// Computer Experiments".

#include <Eigen/Core>
#include <drawpoint/kriging/detail/cholesky.hpp>
#include <drawpoint/kriging/model.hpp>
#include <limits>
#include <utility>

namespace drawpoint::kriging {

/// The nugget of the result is what had to be added; its likelihood and report are those of `model`. A
/// constant model is returned as it is.
inline Model reinterpolated(const Model& model) {
  detail::ModelState s = model.state();
  if (s.X.rows() == 0) return model;
  const double n = static_cast<double>(s.X.rows()), independent = detail::independent_runs(s);
  const Eigen::VectorXd share =
      detail::entry_products(detail::added_noise(s), s.gls.alpha);  // y − ŷ at the runs
  const detail::LeastSquares regression = s.gls;
  Eigen::MatrixXd C;
  fill_correlation(s.X, s.correlation, C);
  detail::mirror_lower(C);
  // As a form of C, which is never negative: as S − λαᵀα it would be what rounding leaves where noise is
  // most.
  const double process_variance = detail::dot(s.gls.alpha, detail::product(C, s.gls.alpha)) / independent;
  s.nugget = 4.0 * n * std::numeric_limits<double>::epsilon();
  for (;; s.nugget *= 10.0) {
    s.L = C;
    detail::add_to_diagonal(s.L, s.nugget);
    if (detail::factor(detail::block_of(s.L), 1)) break;
  }
  detail::clear_upper(s.L);
  s.y = detail::difference(s.y, share);
  s.noise.resize(0);
  s.parameter_spread.resize(0, 0);
  s.known_noise = 0;
  detail::forget_other(s);
  s.gls = detail::least_squares(s.L, s.F, s.y);
  s.gls.beta = regression.beta;
  s.gls.alpha = regression.alpha;
  s.gls.sum_of_squares = independent * process_variance;
  s.process_variance = process_variance;
  s.report.message += "; re-interpolated";
  return Model(std::move(s));
}

}  // namespace drawpoint::kriging
