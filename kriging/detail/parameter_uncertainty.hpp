// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What the estimates of θ, the exponents and λ leave unknown of the mean.
///
/// With p̂ the maximum of the fit and H = −∂²/∂p∂p of what it maximised, the parameters p = (ln θ, exponents,
/// ln λ) are p̂ ± V, V = (H + D)⁻¹ = S Sᵀ: a normal approximation (Laplace's). D is diagonal and keeps a
/// parameter that the runs do not tell from being unknown without bound: 1/4 for the logarithms, a deviation
/// of 2, and 12 for the exponents, the variance of a uniform number on [1, 2]. Where H + D is not positive
/// definite the Fisher information takes the place of H. Parameters at a bound that holds them are taken as
/// known. To first order the mean then has, beside its variance at p̂, that of
///   gᵀV g,  gₐ = ∂ŷ/∂pₐ = (∂r/∂pₐ)ᵀα + rᵀ∂α/∂pₐ + fᵀ∂β/∂pₐ,  ∂α/∂pₐ = −P Rₐα,  ∂β/∂pₐ = −T⁻¹BᵀRₐα
/// (least_squares.hpp has B and T). Simplification: the variance at p̂ itself is not averaged over p, and s²
/// is taken as known; what that costs is measured in docs/measurements/kriging.md. Beyond 250 runs H is that
/// of 250 of them, which is less information than there is: V is too large, by a factor of 1.3 at 500 and of
/// 1.7 at 1000 noisy runs of three inputs. Cost: a Hessian and 2n² per parameter once, n per parameter and
/// point. Source: Zimmerman, Cressie 1992, Annals of the Institute of Statistical Mathematics 44, "Mean
/// squared prediction error in the spatial linear model with estimated covariance parameters".

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <drawpoint/kriging/correlation.hpp>
#include <drawpoint/kriging/detail/cholesky.hpp>
#include <drawpoint/kriging/detail/climb.hpp>
#include <drawpoint/kriging/detail/least_squares.hpp>
#include <drawpoint/kriging/detail/likelihood.hpp>
#include <drawpoint/kriging/detail/model_state.hpp>
#include <vector>

namespace drawpoint::kriging::detail {

/// (H + D)⁻¹ = S Sᵀ as S, upper triangular; empty where it is not positive definite.
inline Eigen::MatrixXd inverse_root(Eigen::MatrixXd H, const Eigen::VectorXd& floor) {
  Eigen::MatrixXd S;
  for (Eigen::Index k = 0; k < H.rows(); ++k) H(k, k) += floor[k];
  if (!all_finite(H) || !factor(block_of(H), 1)) return S;
  inverse_transposed(H, S);
  return S;
}

/// D: one entry a parameter.
inline Eigen::VectorXd least_curvature(const Likelihood& likelihood) {
  const ParameterPlaces& places = likelihood.places();
  Eigen::VectorXd floor = Eigen::VectorXd::Constant(places.count(), 0.25);
  for (Eigen::Index a = places.theta_count; a < places.weight(0); ++a) floor[a] = 12.0;
  return floor;
}

/// S at p from `likelihood`, one row a parameter, one column for each of `free`; no columns where no
/// information is finite.
inline Eigen::MatrixXd parameter_spread(Likelihood& likelihood, const Eigen::VectorXd& p,
                                        const std::vector<Eigen::Index>& free) {
  if (free.empty()) return Eigen::MatrixXd::Zero(p.size(), 0);
  const auto among_free = [&](const Eigen::MatrixXd& A) { return rows_of(columns_of(A, free), free); };
  const Eigen::VectorXd floor = entries_of(least_curvature(likelihood), free);
  Eigen::MatrixXd H = among_free(likelihood.hessian(p));
  for (double& entry : H.reshaped()) entry = -entry;
  Eigen::MatrixXd S = inverse_root(H, floor);
  if (S.size() == 0) S = inverse_root(among_free(likelihood.fisher(p)), floor);
  Eigen::MatrixXd spread = Eigen::MatrixXd::Zero(p.size(), S.cols());
  for (Eigen::Index j = 0; j < S.cols(); ++j)
    for (Eigen::Index i = 0; i <= j; ++i) spread(free[static_cast<std::size_t>(i)], j) = S(i, j);
  return spread;
}

/// Rows of points against one run, the first of them row `first` of all.
struct AgainstRun {
  const Rows& rows;
  const double* c;  ///< correlations, one per row
  double alpha;     ///< of the run
  Index first;
};

/// Adds α ∂c/∂pₐ of a sum to G: one row per point, one column per parameter.
inline void add_sum_slopes(const CorrelationFunction& f, const ParameterPlaces& places, const AgainstRun& at,
                           Eigen::MatrixXd& G) {
  const auto add = [&](Index a, const Chunk& slope) {
    add_scaled(&G(at.first, a), at.alpha, slope.number, slope.count);
  };
  for (Index k = 0; k < places.variables(); ++k) {
    const Summand summand(f, at.rows, k);
    add(places.theta(k), summand.slope_in_theta());
    if (places.exponents) add(places.exponent(k), summand.slope_in_exponent());
    add(places.weight(k), summand.slope_in_weight(at.c));
  }
}

/// Σⱼ αⱼ ∂c(x, xⱼ)/∂pₐ at the rows of `scaled`: m x d, whose correlations with the runs are R: m x n. Gives m
/// rows, one column a parameter; that of λ is 0.
inline Eigen::MatrixXd parameter_slopes(const ModelState& s, const Eigen::MatrixXd& R,
                                        const Eigen::MatrixXd& scaled) {
  const Eigen::Index d = scaled.cols(), parameters = s.parameter_spread.rows();
  const ParameterPlaces places = places_among(s.correlation, d, parameters);
  const Eigen::MatrixXd runs = s.X.transpose();
  Eigen::MatrixXd G = Eigen::MatrixXd::Zero(scaled.rows(), parameters);
  for (Eigen::Index j = 0; j < s.X.rows(); ++j)
    for (Eigen::Index i = 0; i < scaled.rows(); i += chunk_rows) {
      const Rows rows{scaled, i, std::min(chunk_rows, scaled.rows() - i), &runs(0, j)};
      if (places.weights) {
        add_sum_slopes(s.correlation, places, {rows, &R(i, j), s.gls.alpha[j], i}, G);
        continue;
      }
      Chunk weighted(rows.count);
      for (Index row = 0; row < rows.count; ++row) weighted.number[row] = R(i + row, j) * s.gls.alpha[j];
      for (Eigen::Index k = 0; k < d; ++k) {
        const Chunk h = distances(s.correlation, rows, k),
                    slope = entry_products(weighted, slope_in_theta(s.correlation, k, h));
        add_scaled(&G(i, places.theta(k)), 1.0, slope.number, rows.count);
        if (places.exponents)
          add_scaled(&G(i, places.exponent(k)), 1.0, entry_products(slope, logarithms(h)).number, rows.count);
      }
    }
  return G;
}

/// What one deviation along each column of S does to α: n x k, and β: q x k; no columns when all is known.
struct ParameterEffects {
  Eigen::MatrixXd alpha, beta;

  bool none() const { return alpha.cols() == 0; }
};

inline ParameterEffects parameter_effects(const ModelState& s) {
  ParameterEffects effects;
  if (s.parameter_spread.cols() == 0) return effects;
  Eigen::MatrixXd slopes = parameter_slopes(s, cross_correlation(s.X, s.X, s.correlation), s.X);  // Rₐα
  const Eigen::VectorXd weight = s.noise.size() ? s.noise : Eigen::VectorXd::Ones(s.X.rows());
  const Eigen::VectorXd by_nugget = affine(entry_products(weight, s.gls.alpha), s.nugget);
  std::copy(by_nugget.begin(), by_nugget.end(), column(slopes, slopes.cols() - 1));
  Eigen::MatrixXd along = product(slopes, s.parameter_spread);
  const Eigen::MatrixXd trend = transposed_product(s.gls.B, along);
  solve_lower(s.L, along);
  solve_lower_transposed(s.L, along);
  effects.alpha = product(s.gls.B, trend);
  add_scaled(effects.alpha.data(), -1.0, along.data(), along.size());
  effects.beta.resize(trend.rows(), trend.cols());
  for (Eigen::Index j = 0; j < trend.cols(); ++j)
    effects.beta.col(j) = affine(solve_upper(s.gls.T, trend.col(j)), -1.0);
  return effects;
}

/// Points with their correlations with the runs and terms of the trend.
struct PredictedPoints {
  const Eigen::MatrixXd &scaled, &R, &F;  ///< m x d, m x n, m x q
};

/// Sᵀg of each point, standardised: m x k. Its rows' squares are the variance that the parameters add.
inline Eigen::MatrixXd mean_deviations(const ModelState& s, const ParameterEffects& effects,
                                       const PredictedPoints& points) {
  Eigen::MatrixXd W = product(parameter_slopes(s, points.R, points.scaled), s.parameter_spread);
  const Eigen::MatrixXd by_alpha = product(points.R, effects.alpha),
                        by_beta = product(points.F, effects.beta);
  add_scaled(W.data(), 1.0, by_alpha.data(), W.size());
  add_scaled(W.data(), 1.0, by_beta.data(), W.size());
  return W;
}

/// ∂²ln c/∂pₐ∂xₖ of an input's own θ and exponent at the signed distance `step` = xₖ − runₖ, 0 at the run.
/// ln c depends on θ and h by θ h^p alone, so it follows from the curvature in ln θ.
struct MixedSlopes {
  double theta = 0, exponent = 0;
};

inline MixedSlopes mixed_slopes(const CorrelationFunction& f, Eigen::Index k, double step) {
  if (step == 0.0 || is_category(f.levels, k)) return {};
  Chunk h(1);
  h.number[0] = std::min(std::abs(step), farthest_distance);
  const double curvature = curvature_in_theta(f, k, h)[0];
  if (f.family != Correlation::power_exponential) return {2.0 * curvature / step, 0};
  return {f.exponent[k] * curvature / step, curvature * (f.exponent[k] * std::log(h.number[0]) + 1.0) / step};
}

/// One point with what changes along it, by the natural inputs.
struct PredictedSlopes {
  const Eigen::VectorXd &scaled, &r;             ///< d, n
  const Eigen::MatrixXd &slopes, &trend_slopes;  ///< n x d and q x d
};

/// Σᵢ αᵢ ∂²c/∂pₐ∂x of a sum, where one variable's slope depends on its own θ and exponent, and on all
/// weights.
inline Eigen::MatrixXd mixed_slopes_of_sum(const ModelState& s, const ParameterPlaces& places,
                                           const PredictedSlopes& at) {
  const Eigen::Index d = at.scaled.size();
  Eigen::MatrixXd G = Eigen::MatrixXd::Zero(places.count(), d);
  const Eigen::VectorXd along = transposed_product(at.slopes, s.gls.alpha);
  for (Eigen::Index k = 0; k < d; ++k) {
    for (Eigen::Index i = 0; i < s.X.rows(); ++i) {
      const Summand summand(s.correlation, {s.X, i, 1, at.scaled.data()}, k);
      const MixedSlopes mixed = mixed_slopes(s.correlation, k, at.scaled[k] - s.X(i, k));
      const double slope = slope_in_theta(s.correlation, k, summand.h)[0],
                   own = summand.part[0] * s.input.factor[k];
      G(places.theta(k), k) += s.gls.alpha[i] * (at.slopes(i, k) * slope + own * mixed.theta);
      if (places.exponents)
        G(places.exponent(k), k) +=
            s.gls.alpha[i] * (at.slopes(i, k) * slope * logarithms(summand.h)[0] + own * mixed.exponent);
    }
    for (Eigen::Index l = 0; l < d; ++l)
      G(places.weight(l), k) = ((k == l ? 1.0 : 0.0) - s.correlation.weight[l]) * along[k];
  }
  return G;
}

/// The same of a product.
inline Eigen::MatrixXd mixed_slopes_of_product(const ModelState& s, const ParameterPlaces& places,
                                               const PredictedSlopes& at) {
  const Eigen::Index d = at.scaled.size();
  Eigen::MatrixXd G = Eigen::MatrixXd::Zero(places.count(), d);
  for (Eigen::Index i = 0; i < s.X.rows(); ++i)
    for (Eigen::Index a = 0; a < d; ++a) {
      const double step = at.scaled[a] - s.X(i, a);
      Chunk h(1);
      h.number[0] =
          std::min(distance_between(s.correlation.levels, a, at.scaled[a], s.X(i, a)), farthest_distance);
      const double slope = slope_in_theta(s.correlation, a, h)[0], logarithm = logarithms(h)[0];
      const MixedSlopes mixed = mixed_slopes(s.correlation, a, step);
      const double own = s.gls.alpha[i] * at.r[i] * s.input.factor[a];
      const Eigen::Index by_theta = places.theta(a);
      for (Eigen::Index k = 0; k < d; ++k) G(by_theta, k) += s.gls.alpha[i] * at.slopes(i, k) * slope;
      G(by_theta, a) += own * mixed.theta;
      if (!places.exponents) continue;
      const Eigen::Index by_exponent = places.exponent(a);
      for (Eigen::Index k = 0; k < d; ++k)
        G(by_exponent, k) += s.gls.alpha[i] * at.slopes(i, k) * slope * logarithm;
      G(by_exponent, a) += own * mixed.exponent;
    }
  return G;
}

/// ∂(Sᵀg)/∂x: k x d.
inline Eigen::MatrixXd mean_deviation_slopes(const ModelState& s, const ParameterEffects& effects,
                                             const PredictedSlopes& at) {
  const ParameterPlaces places = places_among(s.correlation, at.scaled.size(), s.parameter_spread.rows());
  const Eigen::MatrixXd G =
      places.weights ? mixed_slopes_of_sum(s, places, at) : mixed_slopes_of_product(s, places, at);
  Eigen::MatrixXd W = transposed_product(s.parameter_spread, G);
  const Eigen::MatrixXd by_alpha = transposed_product(effects.alpha, at.slopes);
  const Eigen::MatrixXd by_beta = transposed_product(effects.beta, at.trend_slopes);
  add_scaled(W.data(), 1.0, by_alpha.data(), W.size());
  add_scaled(W.data(), 1.0, by_beta.data(), W.size());
  return W;
}

}  // namespace drawpoint::kriging::detail
