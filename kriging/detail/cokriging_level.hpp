// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// One level of co-Kriging given the levels below it, and what all levels together say of points.
///
/// With m and S the mean and the covariance that the levels below leave of their response y⁻ (both after
/// their runs; none at the cheapest level), y(x) = ρ(x) (y⁻(x) − c) + f(x)ᵀβ + Z(x), ρ(x) = g(x)ᵀβ_ρ, and Z
/// of covariance s² c(x, z), the runs of this level have, given the runs below, the mean Hβ and the
/// covariance s² R, where
///   h(x) = (f(x), g(x) (m(x) − c)),  R = C + λ diag(w) + D S(X, X) D/s²,  D = diag ρ(X)
///   k(x) = c(x, X) + D S(X, x) ρ(x)/s²
/// and universal Kriging gives, with α = R⁻¹(y − Hβ) and u = h − HᵀR⁻¹k,
///   mean        h(x)ᵀβ + k(x)ᵀα
///   covariance  ρ(x)ρ(z) S(x, z) + s² [c(x, z) − kₓᵀR⁻¹k_z + uₓᵀ(HᵀR⁻¹H)⁻¹u_z] + wₓᵀw_z
/// wᵀw is what the estimates of θ, the exponents and λ leave unknown (parameter_uncertainty.hpp). So a run
/// need not be repeated below: what is unknown of y⁻ there is in S. Where each run is repeated below and has
/// no noise, S(X, X) = 0, and this is the recursion of Le Gratiet and Garnier. For given ρ, β and covariances
/// it equals co-Kriging of all runs at once (Kennedy, O'Hagan), since conditioning on the runs of one level
/// after the other is conditioning on all. Simplifications: ρ in D and k is that of the fit, taken as known,
/// while ρ in h is estimated with β; θ, λ and s² are taken as independent between levels.
///
/// A view of m points holds Q = k L⁻ᵀ, V = u T⁻¹ and W, so that covariances are products of views. Cost of a
/// view: m n² and, per pair of levels, m n n⁻. Source: Le Gratiet, Garnier 2014, International Journal for
/// Uncertainty Quantification 4(5), "Recursive co-kriging model for design of computer experiments with
/// multiple levels of fidelity"; Kennedy, O'Hagan 2000, Biometrika 87(1).

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <drawpoint/kriging/detail/cholesky.hpp>
#include <drawpoint/kriging/detail/model_state.hpp>
#include <drawpoint/kriging/detail/parameter_uncertainty.hpp>
#include <string>
#include <utility>
#include <vector>

namespace drawpoint::kriging::detail {

/// What a level says of m points, natural units. s²: CokrigingLevel::variance().
struct LevelView {
  Eigen::MatrixXd scaled;   ///< m x d
  Eigen::VectorXd mean;     ///< m
  Eigen::VectorXd rho;      ///< m, of D; zeros at the cheapest level
  Eigen::MatrixXd Q, V, W;  ///< m x n, m x q, m x parameters
};

/// One view per level, all of the same points, from the cheapest level on.
using LevelViews = std::vector<LevelView>;

struct CokrigingLevel {
  std::string name;
  Eigen::MatrixXd X;            ///< n x d, natural units
  ModelState s;                 ///< F = H, L Lᵀ = R; its trend is f alone
  std::vector<TrendTerm> rho;   ///< g, which the runs can tell apart; empty at the cheapest level
  Eigen::VectorXd rho_given;    ///< the coefficients of D
  double below_centre = 0;      ///< c
  Eigen::VectorXd rho_at_runs;  ///< D, n entries
  LevelViews runs_below;        ///< of X at the levels below
  ParameterEffects effects;

  double variance() const { return s.y_scale * s.y_scale * s.process_variance; }  ///< s²
  /// The estimated β_ρ, as long as rho.
  Eigen::VectorXd rho_coefficients() const {
    const auto count = static_cast<Index>(rho.size());
    return s.gls.beta.tail(count);
  }
};

using CokrigingLevels = std::vector<CokrigingLevel>;

/// g of each scaled point: m x terms.
inline Eigen::MatrixXd term_values(const std::vector<TrendTerm>& terms, const Eigen::MatrixXd& scaled) {
  Eigen::MatrixXd G(scaled.rows(), static_cast<Index>(terms.size()));
  for (Index j = 0; j < G.cols(); ++j)
    for (Index i = 0; i < G.rows(); ++i)
      G(i, j) = terms[static_cast<std::size_t>(j)].at(scaled.row(i).transpose());
  return G;
}

/// c of the rows of A and B: m x n.
inline Eigen::MatrixXd correlations_between(const CorrelationFunction& f, const Eigen::MatrixXd& A,
                                            const Eigen::MatrixXd& B) {
  Eigen::MatrixXd C(A.rows(), B.rows());
  if (C.size() == 0) return C;
  const Eigen::MatrixXd points = B.transpose();
  for (Index j = 0; j < C.cols(); ++j) correlate(f, {A, 0, A.rows(), column(points, j)}, column(C, j));
  return C;
}

/// C += factor A Bᵀ.
inline void add_outer_products(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, double factor,
                               Eigen::MatrixXd& C) {
  if (A.cols() > 0) add_product(block_of(A), block_of(B), factor, block_of(C));
}

/// Covariances after the runs of the first `count` levels: m x n for views of m and of n points.
inline Eigen::MatrixXd covariance_of(const CokrigingLevels& levels, std::size_t count, const LevelViews& a,
                                     const LevelViews& b) {
  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(a[0].mean.size(), b[0].mean.size());
  for (std::size_t t = 0; t < count; ++t) {
    const CokrigingLevel& level = levels[t];
    for (Index j = 0; j < S.cols(); ++j)
      for (Index i = 0; i < S.rows(); ++i) S(i, j) *= a[t].rho[i] * b[t].rho[j];
    Eigen::MatrixXd own = correlations_between(level.s.correlation, a[t].scaled, b[t].scaled);
    add_outer_products(a[t].Q, b[t].Q, -1.0, own);
    add_outer_products(a[t].V, b[t].V, 1.0, own);
    add_scaled(S.data(), level.variance(), own.data(), S.size());
    add_outer_products(a[t].W, b[t].W, 1.0, S);
  }
  return S;
}

/// Its diagonal for one set of points.
inline Eigen::VectorXd variance_of(const CokrigingLevels& levels, std::size_t count, const LevelViews& a) {
  Eigen::VectorXd v = Eigen::VectorXd::Zero(a[0].mean.size());
  for (std::size_t t = 0; t < count; ++t) {
    const Eigen::VectorXd explained = row_squares(a[t].Q), missing = row_squares(a[t].V),
                          unknown = row_squares(a[t].W);
    for (Index i = 0; i < v.size(); ++i) {
      const double own = levels[t].variance() * (1.0 - explained[i] + missing[i]);
      v[i] = std::max(a[t].rho[i] * a[t].rho[i] * v[i] + own, 0.0) + unknown[i];  // but for round-off
    }
  }
  return v;
}

/// h of points, standardised: m x q. `below`: the mean m there, unused at the cheapest level.
inline Eigen::MatrixXd regressors(const CokrigingLevel& level, const Eigen::MatrixXd& X,
                                  const Eigen::MatrixXd& scaled, const Eigen::VectorXd& below) {
  const Eigen::MatrixXd f = trend_matrix(level.s.trend, X, scaled, level.s.input);
  if (level.rho.empty()) return f;
  Eigen::MatrixXd H(f.rows(), f.cols() + static_cast<Index>(level.rho.size()));
  const Eigen::MatrixXd g = term_values(level.rho, scaled);
  std::copy_n(f.data(), f.size(), H.data());
  for (Index j = 0; j < g.cols(); ++j)
    for (Index i = 0; i < g.rows(); ++i)
      H(i, f.cols() + j) = g(i, j) * (below[i] - level.below_centre) / level.s.y_scale;
  return H;
}

/// D of points: g(x)ᵀβ_ρ as given; zeros at the cheapest level.
inline Eigen::VectorXd rho_at(const CokrigingLevel& level, const Eigen::MatrixXd& scaled) {
  if (level.rho.empty()) return Eigen::VectorXd::Zero(scaled.rows());
  return product(term_values(level.rho, scaled), level.rho_given);
}

/// k of points with these correlations with the runs of levels[t]: both m x n.
inline Eigen::MatrixXd with_unknown_below(const CokrigingLevels& levels, std::size_t t,
                                          const LevelViews& views, const Eigen::VectorXd& rho,
                                          Eigen::MatrixXd correlations) {
  const CokrigingLevel& level = levels[t];
  if (level.rho.empty()) return correlations;
  const Eigen::MatrixXd S = covariance_of(levels, t, views, level.runs_below);
  for (Index j = 0; j < S.cols(); ++j)
    for (Index i = 0; i < S.rows(); ++i)
      correlations(i, j) += rho[i] * level.rho_at_runs[j] * S(i, j) / level.variance();
  return correlations;
}

/// W, natural units, of points with the correlations c, k and the regressors H.
inline Eigen::MatrixXd deviations_by_parameters(const CokrigingLevel& level, const PredictedPoints& points,
                                                const Eigen::MatrixXd& k) {
  if (level.effects.none()) return Eigen::MatrixXd::Zero(k.rows(), 0);
  Eigen::MatrixXd W = product(parameter_slopes(level.s, points.R, points.scaled), level.s.parameter_spread);
  const Eigen::MatrixXd by_alpha = product(k, level.effects.alpha),
                        by_beta = product(points.F, level.effects.beta);
  add_scaled(W.data(), 1.0, by_alpha.data(), W.size());
  add_scaled(W.data(), 1.0, by_beta.data(), W.size());
  for (double& entry : W.reshaped()) entry *= level.s.y_scale;
  return W;
}

/// The view at levels[t] of the rows of X: m x d, natural units; `views` are those at the t levels below.
inline LevelView view_of(const CokrigingLevels& levels, std::size_t t, const Eigen::MatrixXd& X,
                         const LevelViews& views) {
  const CokrigingLevel& level = levels[t];
  const ModelState& s = level.s;
  LevelView v;
  v.scaled = s.input.apply(X);
  v.rho = rho_at(level, v.scaled);
  const Eigen::MatrixXd H = regressors(level, X, v.scaled, t > 0 ? views.back().mean : Eigen::VectorXd());
  const Eigen::MatrixXd c = correlations_between(s.correlation, v.scaled, s.X);
  v.Q = with_unknown_below(levels, t, views, v.rho, c);
  v.W = deviations_by_parameters(level, {v.scaled, c, H}, v.Q);
  v.mean = product(H, s.gls.beta);
  add_product(v.mean.data(), 1.0, v.Q, s.gls.alpha.data());
  v.mean = affine(v.mean, s.y_scale, s.y_centre);
  const Eigen::MatrixXd triangle = s.gls.T.transpose();
  v.V = H;
  solve_right(block_of(triangle), block_of(v.V));
  for (Index j = 0; j < v.V.cols(); ++j) add_product(column(v.V, j), -1.0, v.Q, column(s.gls.B, j));
  solve_right(block_of(s.L), block_of(v.Q));
  return v;
}

/// The views at the first `count` levels of the rows of X.
inline LevelViews views_of(const CokrigingLevels& levels, std::size_t count, const Eigen::MatrixXd& X) {
  LevelViews views;
  for (std::size_t t = 0; t < count; ++t) views.push_back(view_of(levels, t, X, views));
  return views;
}

/// D S(X, X) D of a level's runs, natural units: n x n.
inline Eigen::MatrixXd unknown_below(const CokrigingLevels& levels, const CokrigingLevel& level) {
  Eigen::MatrixXd S = covariance_of(levels, levels.size(), level.runs_below, level.runs_below);
  for (Index j = 0; j < S.cols(); ++j)
    for (Index i = 0; i < S.rows(); ++i) S(i, j) *= level.rho_at_runs[i] * level.rho_at_runs[j];
  return S;
}

/// Finds what follows from the runs and the parameters: all of s from s.X on but s², and what stands beyond
/// s. `levels`: those below, all of them built. False where R is not numerically positive definite.
inline bool build(const CokrigingLevels& levels, CokrigingLevel& level) {
  ModelState& s = level.s;
  s.X = s.input.apply(level.X);
  s.y = affine(affine(s.observed, 1.0, -s.y_centre), 1.0 / s.y_scale);
  level.rho_at_runs = rho_at(level, s.X);
  level.runs_below = views_of(levels, level.rho.empty() ? 0 : levels.size(), level.X);
  s.F = regressors(level, level.X, s.X, level.rho.empty() ? Eigen::VectorXd() : level.runs_below.back().mean);
  fill_correlation(s.X, s.correlation, s.L);
  const Eigen::VectorXd noise = added_noise(s);
  for (Index i = 0; i < s.L.rows(); ++i) s.L(i, i) += noise[i];
  if (!level.rho.empty()) {
    const Eigen::MatrixXd S = unknown_below(levels, level);
    add_scaled(s.L.data(), 1.0 / level.variance(), S.data(), S.size());
  }
  if (!factor(block_of(s.L), 1)) return false;
  clear_upper(s.L);
  s.gls = least_squares(s.L, s.F, s.y);
  level.effects = parameter_effects(s);
  return true;
}

}  // namespace drawpoint::kriging::detail
