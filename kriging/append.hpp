// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// More runs in a model without a new fit: θ, the exponents, λ, what is unknown of them, and the scales stay;
/// β, α and s² are found anew.
///
/// With R = [R₁₁ R₂₁ᵀ; R₂₁ R₂₂] and R₁₁ = L₁₁L₁₁ᵀ at hand, L₂₁ = R₂₁L₁₁⁻ᵀ and L₂₂L₂₂ᵀ = R₂₂ − L₂₁L₂₁ᵀ: cost
/// n² for each new run, where factoring anew costs n³/3. Equal to the full factor but for round-off. Runs
/// that repeat others so closely that the matrix becomes singular get a little noise of their own, and the
/// report says so.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <drawpoint/kriging/detail/cholesky.hpp>
#include <drawpoint/kriging/model.hpp>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

namespace drawpoint::kriging {

namespace detail {

struct NewRuns {
  const Eigen::MatrixXd& X;
  const Eigen::VectorXd &y, &noise_variance;
};

inline void check_magnitudes(const NewRuns& runs) {
  const auto check = [](double value, const std::string& place) {
    if (!is_usable(value))
      throw std::invalid_argument("kriging::append: " + place + " is " + text(value) +
                                  "; allowed are finite numbers up to 1e150; leave failed runs out");
  };
  for (Eigen::Index i = 0; i < runs.X.rows(); ++i) {
    for (Eigen::Index k = 0; k < runs.X.cols(); ++k)
      check(runs.X(i, k), "X(" + std::to_string(i) + ", " + std::to_string(k) + ")");
    check(runs.y[i], "y[" + std::to_string(i) + "]");
  }
}

inline void check_new_runs(const Model& model, const NewRuns& runs) {
  const auto reject = [](const std::string& what) {
    throw std::invalid_argument("kriging::append: " + what);
  };
  const ModelState& s = model.state();
  if (s.X.rows() == 0 || s.report.status == Status::exact_trend)
    reject(
        "the model is a constant or a trend alone and has no correlation to extend; allowed are fitted ones; "
        "fit all runs anew");
  if (runs.X.cols() != model.variables())
    reject("X has " + std::to_string(runs.X.cols()) + " columns; the model has " +
           std::to_string(model.variables()) + " variables; give one run per row");
  if (runs.X.rows() != runs.y.size())
    reject("X has " + std::to_string(runs.X.rows()) + " rows but y has " + std::to_string(runs.y.size()) +
           " entries; give one response a run");
  check_magnitudes(runs);
  require_levels("kriging::append", runs.X, s.correlation.levels);
  const Eigen::Index wanted = s.noise.size() ? runs.y.size() : 0;
  if (runs.noise_variance.size() != wanted)
    reject("noise_variance has " + std::to_string(runs.noise_variance.size()) + " entries; allowed is " +
           std::to_string(wanted) +
           "; give one per run of a model whose noise differs from run to run, else none");
  check_run_noise(runs.noise_variance, wanted, "kriging::append: ");
}

/// R₂₂ without what the old runs explain, factored; `raised` is what had to be added to its diagonal.
inline Eigen::MatrixXd corner_factor(const Eigen::MatrixXd& corner, double& raised) {
  Eigen::MatrixXd L = corner;
  raised = 0;
  while (!factor(block_of(L), 1)) {
    raised = raised > 0 ? 10 * raised : 1e-12;
    L = corner;
    add_to_diagonal(L, raised);
  }
  clear_upper(L);
  return L;
}

inline Eigen::MatrixXd stacked(const Eigen::MatrixXd& top, const Eigen::MatrixXd& bottom) {
  Eigen::MatrixXd all(top.rows() + bottom.rows(), top.cols());
  all.topRows(top.rows()) = top;
  all.bottomRows(bottom.rows()) = bottom;
  return all;
}

/// Extends L by the runs whose scaled inputs stand last in s.X. Returns what was added to their diagonal.
inline double extend_factor(ModelState& s) {
  const Eigen::Index n = s.L.rows(), m = s.X.rows() - n;
  const Eigen::MatrixXd added = s.X.bottomRows(m);
  Eigen::MatrixXd side = cross_correlation(added, s.X.topRows(n), s.correlation), corner;
  solve_right(block_of(s.L), block_of(side));
  fill_correlation(added, s.correlation, corner);
  const Eigen::VectorXd noise = added_noise(s);
  for (Eigen::Index i = 0; i < m; ++i) corner(i, i) += noise[n + i];
  add_product(block_of(side), block_of(side), -1.0, block_of(corner), Part::lower);
  double raised = 0;
  const Eigen::MatrixXd last = corner_factor(corner, raised);
  s.L.conservativeResize(n + m, n + m);
  s.L.topRightCorner(n, m).setZero();
  s.L.bottomLeftCorner(m, n) = side;
  s.L.bottomRightCorner(m, m) = last;
  return raised;
}

}  // namespace detail

/// X: m x d, y: m, natural units; noise_variance: one entry per run, unit of y squared, when the model was
/// fitted with them, else empty. Throws std::invalid_argument for other sizes, numbers that are not finite
/// and models without a correlation; of magnitudes beyond 1e150 too.
inline Model append(const Model& model, const Eigen::MatrixXd& X, const Eigen::VectorXd& y,
                    const Eigen::VectorXd& noise_variance = {}) {
  detail::check_new_runs(model, {X, y, noise_variance});
  if (y.size() == 0) return model;
  detail::ModelState s = model.state();
  const Eigen::MatrixXd scaled = s.input.apply(X);
  s.F = detail::stacked(s.F, detail::trend_matrix(s.trend, X, scaled, s.input));
  s.X = detail::stacked(s.X, scaled);
  s.y = detail::stacked(s.y, detail::affine(detail::affine(y, 1.0, -s.y_centre), 1.0 / s.y_scale));
  s.observed = detail::stacked(s.observed, y);
  if (s.noise.size()) s.noise = detail::stacked(s.noise, detail::affine(noise_variance, 1.0 / s.noise_unit));
  const double raised = detail::extend_factor(s);
  detail::estimate(s);
  if (s.other) {
    const Model other = append(Model(*s.other), X, y);
    const double of_other = other.log_likelihood() - s.other->log_likelihood,
                 own = s.log_likelihood - model.log_likelihood(),
                 gain = std::log(s.doubt / (1.0 - s.doubt)) + of_other - own;
    s.doubt = detail::doubt_of(gain);
    s.other = std::make_shared<const detail::ModelState>(other.state());
    if (!(gain > detail::hardly_likely)) detail::forget_other(s);
  }
  s.report.message +=
      "; " + std::to_string(y.size()) + (y.size() == 1 ? " run" : " runs") + " appended without a new fit";
  if (raised > 0) {
    s.report.status = Status::ill_conditioned;
    s.report.message +=
        ", with " + detail::text(raised) + " added to their nugget because they repeat other runs";
  }
  return Model(std::move(s));
}

}  // namespace drawpoint::kriging
