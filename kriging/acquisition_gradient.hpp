// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The knowledge gradient: where one more noisy run is expected to lower the best prediction most.
///
/// The value of a noisy response counts at the point that the model recommends, the run with the best mean.
/// A run at x moves all means at once, along one standard normal number Z:
///   μ'(xᵢ) = μ(xᵢ) + bᵢZ,  bᵢ = s²(xᵢ, x)/√(s²(x) + λs²)
///   KG(x)  = minᵢ μ(xᵢ) − E[minᵢ (μ(xᵢ) + bᵢZ)],  xᵢ: all runs and x itself
/// which is a sum over the lower envelope of these lines: Σ (bₖ₊₁ − bₖ) h(−|cₖ|), lines by their slope, cₖ
/// where two of them meet, h in detail/normal.hpp. Unlike the improvement of a re-interpolated model it may
/// ask for the neighbourhood of a run again where noise hides which run is best. Parameters are those of the
/// fit; what is unknown of them is part of s². Cost n² + n ln n per point. Sources: Frazier, Powell, Dayanik
/// 2009, "The knowledge-gradient policy for correlated normal beliefs"; Scott, Frazier, Powell 2011, "The
/// correlated knowledge gradient for simulation optimization of continuous parameters using Gaussian process
/// regression" (runs and x for all points of the box).

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include <drawpoint/kriging/acquisition.hpp>
#include <drawpoint/kriging/detail/covariance_with.hpp>

namespace drawpoint::kriging {

namespace detail {

/// a + b z.
struct Line {
  double a, b;
};

/// The lines that are lowest for some z, from z = ∞ to −∞, that is by rising slope; `meet[k]`: where lines k
/// and k + 1 do, falling.
struct LowerEnvelope {
  std::vector<Line> lines;
  std::vector<double> meet;
};

inline LowerEnvelope lower_envelope(std::vector<Line> all) {
  std::sort(all.begin(), all.end(),
            [](const Line& x, const Line& y) { return x.b < y.b || (x.b == y.b && x.a < y.a); });
  LowerEnvelope e;
  for (const Line& line : all) {
    if (!e.lines.empty() && e.lines.back().b == line.b) continue;  // a parallel one is lower
    const auto meets_last = [&] { return (line.a - e.lines.back().a) / (e.lines.back().b - line.b); };
    while (!e.meet.empty() && meets_last() >= e.meet.back()) {
      e.lines.pop_back();
      e.meet.pop_back();
    }
    if (!e.lines.empty()) e.meet.push_back(meets_last());
    e.lines.push_back(line);
  }
  return e;
}

/// ln(minᵢ aᵢ − E[minᵢ (aᵢ + bᵢZ)]); −∞ where nothing changes.
inline double log_gain_of_lines(std::vector<Line> lines) {
  const LowerEnvelope e = lower_envelope(std::move(lines));
  std::vector<double> terms;
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < e.meet.size(); ++k) {
    const double slope = e.lines[k + 1].b - e.lines[k].b;
    terms.push_back(std::log(slope) + log_normal_improvement(-std::abs(e.meet[k])));
    most = std::max(most, terms.back());
  }
  if (!std::isfinite(most)) return most;
  double sum = 0;
  for (const double t : terms) sum += std::exp(t - most);
  return most + std::log(sum);
}

/// The runs in natural units, n x d.
inline Eigen::MatrixXd natural_runs(const ModelState& s) {
  Eigen::MatrixXd X = s.X;
  for (Index k = 0; k < X.cols(); ++k)
    for (Index i = 0; i < X.rows(); ++i)
      X(i, k) =
          s.input.factor[k] == 0.0 ? s.input.centre[k] : s.input.centre[k] + X(i, k) / s.input.factor[k];
  return X;
}

}  // namespace detail

/// ln KG, goal: minimize or maximize; −∞ where a run can teach nothing, and everywhere for a constant model.
/// Throws std::invalid_argument for another goal.
inline doe::Criterion log_knowledge_gradient(const Model& model, doe::Goal goal) {
  const double sign = detail::sign_of("kriging::log_knowledge_gradient", goal);
  const auto shared = std::make_shared<const Model>(detail::of_one_explanation(model));
  const Eigen::MatrixXd runs = detail::natural_runs(model.state());
  return [shared, sign, covariance = detail::CovarianceWith(shared, runs),
          means = detail::affine(model.mean(runs), sign)](const Eigen::MatrixXd& X) -> Eigen::VectorXd {
    const Prediction p = shared->predict(X);
    const Eigen::MatrixXd C = covariance(X);
    Eigen::VectorXd score(X.rows());
    for (Eigen::Index i = 0; i < score.size(); ++i) {
      const double deviation = std::sqrt(p.variance[i] + shared->noise_variance());
      const double scale = deviation > 0.0 ? 1.0 / deviation : 0.0;
      std::vector<detail::Line> lines{{sign * p.mean[i], p.variance[i] * scale}};
      for (Eigen::Index k = 0; k < means.size(); ++k) lines.push_back({means[k], C(i, k) * scale});
      score[i] = detail::log_gain_of_lines(std::move(lines));
    }
    return score;
  };
}

/// KG, unit of y. Throws as above.
inline doe::Criterion knowledge_gradient(const Model& model, doe::Goal goal) {
  detail::sign_of("kriging::knowledge_gradient", goal);
  return [logarithm = log_knowledge_gradient(model, goal)](const Eigen::MatrixXd& X) -> Eigen::VectorXd {
    Eigen::VectorXd score = logarithm(X);
    for (double& s : score) s = std::exp(s);
    return score;
  };
}

}  // namespace drawpoint::kriging
